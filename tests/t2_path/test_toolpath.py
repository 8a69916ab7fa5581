"""The columns of a toolpath: continuity, slices, lengths, points of arcs and helices, the listing."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab import Kind
from mnclab.path.recorder import NAN, Recorder, State
from mnclab.path.toolpath import COLUMNS, Toolpath, concatenate


def path_of(*rows, start=(0.0, 0.0, 0.0), axis=(0.0, 0.0, 1.0)):
    """A path from (kind, end, centre, sweep)."""
    recorder = Recorder(start)
    state = recorder.state(State(axis=axis))
    for number, (kind, end, centre, sweep) in enumerate(rows):
        recorder.add((int(kind), number + 1, number, 0, *end, *centre, sweep, 100.0, NAN, -1, state))
    return recorder.take()


NOWHERE = (NAN, NAN, NAN)
HELIX = (Kind.ARC, (10, 0, 5), (0, 0, 0), 4 * np.pi)  # two turns of radius 10, 5 mm up


def test_vertices_are_one_array():
    path = path_of((Kind.RAPID, (10, 0, 0), NOWHERE, 0), HELIX)
    assert path.start.base is path.end.base
    assert np.array_equal(path.start[1:], path.end[:-1])


def test_rows_by_a_piece_of_their_label():
    plain = path_of(*((Kind.LINE, (x, 0, 0), NOWHERE, 0) for x in range(4)))
    path = plain.replace(label=np.array([0, 1, 2, 1])).annotated(labels=("", "layer 1, ring", "lift"))
    assert path.labelled("ring").end[:, 0].tolist() == [1, 3]
    assert len(path.labelled("")) == 4 and len(path.labelled("helix")) == 0


def test_length_of_a_helix():
    """sqrt((2 pi r turns)² + pitch²)."""
    path = path_of((Kind.RAPID, (10, 0, 0), NOWHERE, 0), HELIX)
    assert path.lengths[1] == pytest.approx(np.hypot(2 * np.pi * 10 * 2, 5), abs=1e-12)
    assert path.length == pytest.approx(10 + path.lengths[1])
    assert np.allclose(path.bounds, [[-10, -10, 0], [10, 10, 5]], atol=0.01)


@given(st.floats(0.5, 200), st.floats(-12, 12), st.floats(0.001, 0.5))
def test_points_keep_the_chord_error(radius, sweep, error):
    end = (radius * np.cos(sweep), radius * np.sin(sweep), 3.0)
    path = path_of((Kind.RAPID, (radius, 0, 0), NOWHERE, 0), (Kind.ARC, end, (0, 0, 0), sweep))
    xyz, row = path.points(error)
    arc = xyz[np.flatnonzero(row == 1)]
    assert np.allclose(np.hypot(arc[:, 0], arc[:, 1]), radius, atol=1e-9)
    middle = (xyz[1:-1] + xyz[2:])[:, :2] / 2
    assert (radius - np.hypot(*middle.T) <= error + 1e-9).all()
    assert np.allclose(xyz[-1], end)


def test_events_have_no_length_and_no_points():
    path = path_of(
        (Kind.DWELL, (0, 0, 0), NOWHERE, 0), (Kind.LINE, (3, 4, 0), NOWHERE, 0), (Kind.SPINDLE, (3, 4, 0), NOWHERE, 0)
    )
    assert path.lengths.tolist() == [0, 5, 0] and len(path.motion) == 1
    assert path.points()[0].tolist() == [[0, 0, 0], [3, 4, 0]]


@pytest.mark.parametrize("chosen", [slice(1, 3), np.array([2, 0]), np.array([True, False, True])])
def test_slices_and_masks_take_every_column(chosen):
    path = path_of(*[(Kind.LINE, (k, 0, 0), NOWHERE, 0) for k in (1, 2, 3)])
    part = path[chosen]
    for name in COLUMNS:
        assert np.array_equal(getattr(part, name), getattr(path, name)[chosen], equal_nan=True)


def test_an_empty_path_is_a_path():
    path = Recorder((0.0, 0.0, 0.0)).take()
    assert len(path) == 0 and path.start.shape == (0, 3) and path.length == 0
    assert path.points()[0].shape == (0, 3) and str(path) == "" and np.isnan(path.bounds).all()
    assert "0 rows" in path._repr_html_() and all(len(c) == 0 for c in path.columns().values())


def test_a_row_is_plain_python():
    move = path_of((Kind.LINE, (1, 2, 3), NOWHERE, 0))[0]
    assert type(move.line) is int and type(move.feed) is float and move.kind is Kind.LINE and move.label == ""
    assert move.end.tolist() == [1, 2, 3] and move.joint is None


def test_pieces_join_without_a_gap():
    first = path_of((Kind.LINE, (1, 0, 0), NOWHERE, 0))
    second = path_of((Kind.LINE, (2, 0, 0), NOWHERE, 0), start=(1.0, 0.0, 0.0))
    whole = concatenate([first, second])
    assert np.array_equal(whole.start[1:], whole.end[:-1]) and whole.start.base is whole.end.base


def test_columns_for_tables_are_flat():
    path = path_of(HELIX)
    columns = path.columns()
    assert columns["end_z"].tolist() == [5] and columns["rotary_c"].tolist() == [0]
    assert all(column.shape == (1,) for column in columns.values())


def test_constant_columns_cost_nothing():
    path = path_of(*[(Kind.LINE, (k, 0, 0), NOWHERE, 0) for k in range(100)])
    assert path.tool.strides == (0,) and path.axis.strides[0] == 0


def test_listing():
    path = path_of((Kind.RAPID, (10, 0, 0), NOWHERE, 0), HELIX)
    assert str(path).splitlines() == [
        "   1 rapid   X10 Y0 Z0",
        "   2 arc     X10 Y0 Z5 centre X0 Y0 Z0 sweep 720 F100",
    ]
    assert isinstance(path, Toolpath)


def test_only_rows_at_feed_have_a_feed_per_revolution():
    recorder = Recorder((0.0, 0.0, 0.0))
    state = recorder.state(State(per_rev=0.2))
    for kind, feed in ((Kind.RAPID, np.inf), (Kind.LINE, 60.0), (Kind.DWELL, NAN)):
        recorder.add((int(kind), 1, 0, 0, 1.0, 0.0, 0.0, *NOWHERE, 0.0, feed, NAN, -1, state))
    assert np.array_equal(recorder.take().per_rev, [np.nan, 0.2, np.nan], equal_nan=True)


def test_bounds_of_arcs_are_exact():
    """A circle about (20, 0), and a helix of a turn and a half that climbs 9: both reach 10 mm on every side."""
    import mnclab

    path = mnclab.run("G17 G90 F100\nG0 X10\nG3 I10\n", "mnc").toolpath
    np.testing.assert_allclose(path.bounds, [[0, -10, 0], [30, 10, 0]], atol=1e-12)
    path = mnclab.run("G17 G90 G16 F100\nG10 R10 A-90\nG13 A90 K10\nG13 A45 K10\n", "mnc").toolpath
    np.testing.assert_allclose(path[1:].bounds[:, :2], [[-10, -10], [10, 10]], atol=1e-9)
