"""Roughing in passes: counts by whole numbers, stops on the bevel by hand, chip breaks at multiples."""

import math
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Setup
from mnclab.machining.turning.roughing import Pass, Shoulder, chip_breaks, count_of_levels, levels, roughing

COORDINATE = st.integers(-20_000, 20_000)


def test_the_example_of_the_catalogue():
    """NC-31 G77: X60 to X40, Z2 to Z-50, bevel 10, P1 6 on the diameter; here on the radius."""
    shoulder = Shoulder(finish=20, corner=-40, rim=30, far=-50)
    assert roughing(30, shoulder, 3) == (Pass(27, -47), Pass(24, -44), Pass(21, -41))


def test_beside_the_bevel():
    """A bevel from (20, -40) to (25, -50): beyond its rim a pass runs to the far end, at the finish to the corner."""
    shoulder = Shoulder(finish=20, corner=-40, rim=25, far=-50)
    assert [shoulder.stop(x) for x in (30, 25, 22.5, 20, 19)] == [-50, -50, -45, -40, -40]
    assert Shoulder(20, -50, 20, -50).stop(20) == -50  # no bevel


@given(COORDINATE, COORDINATE, st.integers(1, 5_000))
def test_the_number_of_passes(start, finish, depth):
    """floor(|X1 - X| / P1) in discretes, whatever the scale; a pass on the finish counts or not."""
    whole, rest = divmod(abs(start - finish), depth)
    for scale in (1, 100, 200):
        x1, x, p1 = start / scale, finish / scale, depth / scale
        assert count_of_levels(x1, x, p1) == len(levels(x1, x, p1)) == whole
        assert count_of_levels(x1, x, p1, with_finish=False) == whole - (rest == 0 and whole > 0)


@given(COORDINATE, COORDINATE, st.integers(1, 5_000))
def test_levels_go_towards_the_finish_and_not_beyond(start, finish, depth):
    found = [start / 200, *levels(start / 200, finish / 200, depth / 200)]
    sense = math.copysign(1, finish - start)
    assert all((b - a) * sense == pytest.approx(depth / 200, abs=1e-9) for a, b in zip(found, found[1:]))
    assert (finish / 200 - found[-1]) * sense >= 0


@given(COORDINATE, COORDINATE, st.integers(0, 5_000))
def test_chips_break_at_multiples_and_not_at_the_end(begin, end, length):
    found = chip_breaks(begin / 100, end / 100, length / 100)
    if length == 0:
        assert found == ()
        return
    assert len(found) == max(math.ceil(Fraction(abs(end - begin), length)) - 1, 0)
    sense = 1 if end > begin else -1
    assert all(abs(at - (begin + sense * i * length) / 100) < 1e-9 for i, at in enumerate(found, 1))


@given(
    start=st.integers(1, 40_000),
    finish=st.integers(1, 40_000),
    length=st.integers(1, 20_000),
    share=st.floats(0, 1),
    passes=st.integers(1, 40),
    chip=st.sampled_from([0, 300, 1000]),
)
def test_a_whole_cycle(start, finish, length, share, passes, chip):
    """NC-31 G77 from any start: as many passes as whole P1 fit, never deeper than X or Z, and back to the start."""
    if start == finish:
        finish += 1
    depth, bevel = max(abs(start - finish) // passes, 1), int(share * length)
    frames = ["S500", "F20", "G77*~", f"X{finish}*", f"Z{200 - length}*", f"P{depth}*", f"P{bevel}"]
    setup = Setup(start=(start / 200, 0, 2), settings={"parameter_10": chip})
    run = mnclab.run("\n".join(frames) + "\n", "nc-31", setup)
    assert not run.alarms
    path = run.toolpath.motion
    assert (
        len({label.split(",")[0] for label in run.toolpath.labels if "pass" in label}) == abs(start - finish) // depth
    )
    sense = 1 if start > finish else -1
    assert ((path.end[:, 0] - finish / 200) * sense > -1e-9).all()
    assert path.end[:, 2].min() == pytest.approx(2 - length / 100, abs=1e-9)
    assert path.end[-1] == pytest.approx((start / 200, 0, 2), abs=1e-9)
    # no roughing pass crosses the bevel: on it, Z and X fall together from (X, W) to (X1, Z)
    corner, far, x1, x = 2 - (length - bevel) / 100, 2 - length / 100, start / 200, finish / 200
    for row in path[path.kind == 1]:
        share_across = (row.end[0] - x) / (x1 - x)
        assert row.end[2] >= corner + share_across * (far - corner) - 1e-9
