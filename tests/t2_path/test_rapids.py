"""Rapids of uncoordinated axes against a clock: at every time each axis stands where its own speed has brought it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab import Kind, Limits
from mnclab.path.feeds import broken
from mnclab.path.profile.ramps import courses
from mnclab.path.toolpath import Toolpath


def path_of(points, kinds):
    columns = {"kind": np.array(kinds), "line": np.arange(1, len(points))}
    return Toolpath.chain(np.array(points, dtype=float), columns)


@pytest.mark.parametrize(
    ("target", "speed", "corners"),
    [
        ((30, 10, 0), 1000, [(10, 10, 0)]),
        ((-30, 10, 0), (2000, 1000, 500), [(-20, 10, 0)]),
        ((30, 20, -10), 1000, [(10, 10, -10), (20, 20, -10)]),
        ((20, 10, 0), (2000, 1000, 500), []),  # both arrive together
        ((20, 20, 5), 1000, [(5, 5, 5)]),
        ((0, 0, 7), 1000, []),
    ],
)
def test_it_breaks_where_an_axis_arrives(target, speed, corners):
    found = broken(path_of([(0, 0, 0), target], [Kind.RAPID]), speed)
    assert found.end.tolist() == pytest.approx(np.array([*corners, target], dtype=float))
    assert (found.line == 1).all() and (found.kind == Kind.RAPID).all()
    assert (found.start[1:] == found.end[:-1]).all()


number = st.integers(-500, 500).map(lambda n: n / 10)
point = st.tuples(number, number, number)


@given(
    st.lists(st.tuples(point, st.sampled_from([Kind.RAPID, Kind.LINE])), min_size=1, max_size=8),
    st.tuples(*[st.sampled_from([500.0, 1000.0, 1500.0])] * 3),
)
def test_every_axis_keeps_its_own_time(todo, speed):
    whole = path_of([(0, 0, 0), *(p for p, _ in todo)], [k for _, k in todo])
    found = broken(whole, speed)
    for row in whole:
        pieces = found[found.line == row.line]
        assert pieces.start[0].tolist() == row.start.tolist() and pieces.end[-1].tolist() == row.end.tolist()
        if row.kind != Kind.RAPID:
            assert len(pieces) == 1
            continue
        clock = 0.0
        for piece in pieces:
            clock += (abs(piece.end - piece.start) / speed).max()
            reach = np.minimum(clock * np.array(speed), abs(row.end - row.start))
            assert piece.end == pytest.approx(row.start + np.sign(row.end - row.start) * reach, abs=1e-9)


def test_the_course_of_a_picture_is_that_of_the_axes():
    """98 mm of X and 34 of Y at 10,000 mm/min (500/3 mm/s) and 1000 mm/s²: each axis takes way / speed + speed / acceleration,
    Y so 34 / v + v / a; X has gone v t - v² / 2a by then. Until Y brakes, at 34 / v, both are equally far."""
    whole = path_of([(78, 14, 20), (-20, -20, 20)], [Kind.RAPID])
    row, places = courses(whole, Limits(rapid_motion="axes"), fine=0.01)
    v, a = 10_000 / 60, 1000
    arrived = places[np.isclose(places[:, 1], -20)]
    assert arrived[:, 0].max() == pytest.approx(78 - (v * (34 / v + v / a) - v**2 / 2 / a))
    gone = np.abs(places - whole.start)[:, :2]
    together = gone[gone[:, 0] <= 34 - v**2 / 2 / a]
    assert len(together) > 4 and together[:, 0] == pytest.approx(together[:, 1])
    assert (row == 0).all() and (np.diff(gone, axis=0) >= -1e-9).all() and (places[:, 2] == 20).all()


@pytest.mark.parametrize("limits", [Limits(), Limits(rapid_motion="line")])
def test_coordinated_axes_have_a_straight_course(limits):
    assert not len(courses(path_of([(0, 0, 0), (30, 10, 0)], [Kind.RAPID]), limits, fine=0.01)[0])


def test_only_rapids_leave_their_line_and_only_where_the_axes_differ():
    points = [(0, 0, 0), (30, 10, 0), (60, 40, 0), (0, 40, 0), (0.3, 40.1, 0), (50, 0, 0)]
    kinds = [Kind.LINE, Kind.RAPID, Kind.RAPID, Kind.RAPID, Kind.RAPID]
    row, _ = courses(path_of(points, kinds), Limits(rapid_motion="axes"), fine=0.01, least=1)
    assert set(row.tolist()) == {4}  # a cut, 45 degrees, along X, too short
