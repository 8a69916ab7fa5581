"""G68, G51, G51.1 and G16 of the ISO mill, each by its closed form."""

import math
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tools import running

from mnclab import Kind

run = partial(running.run, control="g43", stopped_spindle="accept")
lines = running.lines


def places(found):
    return (found.toolpath.end + found.toolpath.origin).round(9).tolist()


def last(text, **given):
    return places(run(lines(text), **given))[-1]


NUMBER = st.integers(-2000, 2000).map(lambda n: n / 10)


@given(NUMBER, NUMBER, NUMBER, NUMBER, st.integers(-3600, 3600).map(lambda n: n / 10))
def test_a_point_is_turned_about_the_centre(cx, cy, x, y, angle):
    a = math.radians(angle)
    expected = cx + (x - cx) * math.cos(a) - (y - cy) * math.sin(a), cy + (x - cx) * math.sin(a) + (y - cy) * math.cos(a)
    found = run(f"X1000 Y1000\nG68 X{cx} Y{cy} R{angle}\nX{x} Y{y}\n")
    assert found.toolpath.end[-1, :2] == pytest.approx(expected, abs=1e-9)


@pytest.mark.parametrize(("text", "end"), [
    ("G18 G68 X0 Z0 R90|Z10 X0", [10, 0, 0]),  # from Z to X
    ("G19 G68 Y0 Z0 R90|Y10 Z0", [0, 0, 10]),  # from Y to Z
    ("X5 Y5|G68 R90|X8 Y5", [5, 8, 0]),  # about the present point
    ("X5 Y5|G68 R90|G91 X3", [5, 8, 0]),
    ("G68 X0 Y0 R30|G91 G68 X0 Y0 R60|G90 X10 Y0", [0, 10, 0]),  # R adds
    ("G68 X0 Y0 R30|G68 X0 Y0 R90|X10 Y0", [0, 10, 0]),
    ("G68 X0 Y0 R90|X10 Y0|G69|X3 Y4", [3, 4, 0]),
    ("G52 X100|G68 X0 Y0 R90|X10 Y0", [100, 10, 0]),
    ("G10 L2 P1 X7 R90|G68 X0 Y0 R-90|X10 Y0", [17, 0, 0]),
])  # fmt: skip
def test_rotations(text, end):
    assert last(text) == end


def test_an_angle_may_replace_under_g91():
    assert last("G68 X0 Y0 R30|G91 G68 X0 Y0 R90|G90 X10 Y0", g68_increment="replaces") == [0, 10, 0]


@pytest.mark.parametrize(("text", "end"), [
    ("G51 X0 Y0 Z0 P500|X10 Y20 Z-4", [5, 10, -2]),
    ("G51 X0 Y0 Z0 P.5|X10 Y20 Z-4", [5, 10, -2]),
    ("G51 X10 Y0 P2000|X12 Y3", [14, 6, 0]),
    ("X10 Y10|G51 P2000|X12 Y10", [14, 10, 0]),  # about the present point
    ("G51 X0 Y0 I2000 J500|X3 Y4", [6, 2, 0]),
    ("G51 X0 Y0 I-1000 J1000|X3 Y4", [-3, 4, 0]),
    ("G51 X0 Y0 P500|G68 X10 Y10 R90|X20 Y10", [5, 10, 0]),  # about (5, 5): the centre is scaled
    ("G51 X0 Y0 Z0 P500|X10 Y20|G50|X1 Y2", [1, 2, 0]),
])  # fmt: skip
def test_scales(text, end):
    assert last(text) == end


def test_factors_of_haas_are_as_they_are_written():
    assert last("G51 X0 Y0 P2|X10 Y5", dialect="haas") == [20, 10, 0]


@pytest.mark.parametrize(("text", "end"), [
    ("G51.1 X0|X3 Y4", [-3, 4, 0]),
    ("G51.1 X10|X3 Y4", [17, 4, 0]),
    ("G51.1 X10|G51.1 Y5|X3 Y4", [17, 6, 0]),
    ("G51.1 X0 Y0|G50.1 X0|X3 Y4", [3, -4, 0]),
    ("G51.1 X0 Y0|G50.1|X3 Y4", [3, 4, 0]),
    ("G51.1 X0|G68 X0 Y0 R90|X10 Y1", [1, 10, 0]),  # the other way round: turned to (-1, 10), then mirrored
])  # fmt: skip
def test_mirror_images(text, end):
    assert last(text) == end


def test_a_mirror_image_turns_arcs_and_sides_over():
    found = run(lines("T1 M6|G51.1 X0|G0 X-30 Y0|G41 D1 G1 X0 F100|G2 X20 Y-20 R20|G40 G1 Y-60"))
    plain = run(lines("T1 M6|G0 X30 Y0|G42 D1 G1 X0 F100|G3 X-20 Y-20 R20|G40 G1 Y-60"))
    assert found.toolpath.end[1:].round(9).tolist() == plain.toolpath.end[1:].round(9).tolist()
    assert np.allclose(found.toolpath.sweep, plain.toolpath.sweep)
    assert found.toolpath.side.tolist() == plain.toolpath.side.tolist()


def test_arcs_and_the_tool_under_an_equal_scale():
    """The contour has twice the size, the tool its own: the arc of radius 20 beside a tool of radius 5 has 25."""
    found = run(lines("T1 M6|G51 X0 Y0 P2000|G0 X-30 Y0|G41 D1 G1 X0 F100|G2 X10 Y-10 R10|G40 G1 Y-40"))
    arc = found.toolpath[found.toolpath.kind == Kind.ARC]
    assert np.hypot(*(arc.end - arc.centre)[0, :2]) == pytest.approx(25) and arc.end[0, :2] == pytest.approx([25, -20])


def test_an_axis_that_the_first_motion_leaves_out_is_named():
    text = "X10 Y0|G68 X0 Y0 R90|{}"
    told = run(lines(text.format("X5")))
    assert "Y is not written in the first motion after G68" in told.alarms[0].message
    assert places(told)[-1] == [10, 5, 0]  # along the turned X, from where the tool stands: its Y is -10
    assert "Y is not written" in run(lines(text.format("F100|G81 X5 Z-5 R2"))).alarms[0].message
    for first in ("F100 G81 X5 Y0 Z-5 R2", "X5 Y0", "G91 X5", "Z5", "Z5|X5 Y0"):
        assert not run(lines(text.format(first))).alarms


def test_a_work_offset_that_changes_under_a_rotation_is_named():
    found = run(lines("G68 X0 Y0 R90|X1 Y0|G55 X1 Y0"), datums={2: (100, 0, 0)})
    assert "which now counts from the new one" in found.alarms[0].message and places(found)[-1] == [100, 1, 0]


# --- polar coordinates ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("text", "end"), [
    ("G16|X10 Y30", [10 * math.cos(math.pi / 6), 5, 0]),
    ("G16|X10 Y30|G91 Y60", [0, 10, 0]),  # the angle counts from the last one
    ("X5 Y5|G91 G16|X10 Y90", [5, 15, 0]),  # the radius from the present point
    ("X5 Y0|G16|Y90", [0, 5, 0]),
    ("G16|X10 Y90|X20", [0, 20, 0]),
    ("G18 G16|Z10 X90", [10, 0, 0]),  # Z is the radius, X the angle
    ("G16|X10 Y90 Z-3|G15 X1 Y2", [1, 2, -3]),
    ("G52 X100|G16|X10 Y90", [100, 10, 0]),
    ("G20 G16|X1 Y90", [0, 25.4, 0]),
    ("G16|G0 X10 Y0|G3 X10 Y90 R10 F100", [0, 10, 0]),
])  # fmt: skip
def test_polar_coordinates(text, end):
    assert last(text) == pytest.approx(end, abs=1e-9)


def test_a_bolt_circle():
    """Three holes on a circle, as one count of holes under G91 and as three positions."""
    begin = "F100 G16|G99 G81 X50 Y90 Z-20 R5|"
    angles = [math.radians(a) for a in (90, 210, 330)]
    for holes in ("Y210|Y330", "G91 Y120 K2", "G91 Y120|Y120"):
        rows = run(lines(begin + holes + "|G80 G15")).toolpath.motion
        bottoms = rows.end[rows.kind == Kind.LINE]
        assert bottoms[:, :2] == pytest.approx(np.array([[50 * math.cos(a), 50 * math.sin(a)] for a in angles]))
        assert (bottoms[:, 2] == -20).all()


# --- many blocks ------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("before", [
    "G68 X3 Y4 R37.5", "G51 X1 Y2 P1500", "G51.1 X9", "G10 L2 P1 X5 R12", "G20", "G16", "G90.1", "G93", "G52 X5 Y6",
])  # fmt: skip
def test_many_blocks_are_the_same_at_once_and_one_by_one(before):
    feed = " F30" if before == "G93" else ""
    blocks = [f"X{k % 9} Y{k % 7 + 1} Z{k % 5}{feed}" for k in range(200)]
    if before in ("G90.1",):
        blocks = [f"G{2 + k % 2} X{10 * (k % 2)} Y0 I5 J0" for k in range(200)]
    text = lines(f"{before}|G1 X10 Y0 F200|") + "\n".join(blocks)
    paths = [run(text, settings={"bulk": bulk}).toolpath for bulk in (True, False)]
    assert len(paths[0]) == len(paths[1]) > 190
    for name in ("end", "kind", "sweep", "feed", "time", "line"):
        assert np.array_equal(*(getattr(path, name) for path in paths), equal_nan=True), name
