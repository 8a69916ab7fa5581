"""G160 to G162, the change of side, and what compensation keeps under mirror images, turns, planes and helices."""

import math
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tools import running
from tools.running import lines

import mnclab
from mnclab import Kind, Setup, Tool
from mnclab.path.toolpath import Rule

TOOLS = {1: Tool(radius=2), 2: Tool(radius=1.5, dr=0.5), 3: Tool(dr=-2)}

run = partial(running.run, tools=TOOLS)


def ends(program):
    moves = run(lines(program)).toolpath.motion
    return np.round(moves.end[:, :2], 9).tolist(), [Kind(kind).name for kind in moves.kind]


def test_change_of_side_is_an_entry():
    """MNC-CRC-CHANGE: from (5, 2), square to the end of the left side, to where the right side begins: (9, -2)."""
    points, kinds = ends("T1 G0 X-9|G41 G1 X0 F60|X5|G42 X9|Y5|G40 Y9")
    assert points == [[-9, 0], [0, 2], [5, 2], [9, -2], [11, 0], [11, 5], [9, 9]]
    assert kinds == ["RAPID", "LINE", "LINE", "LINE", "ARC", "LINE", "LINE"]
    rule = run(lines("T1 G0 X-9|G41 G1 X0 F60|X5|G42 X9|Y5|G40 Y9")).toolpath.motion.rule.tolist()
    assert rule == [Rule.NONE, Rule.ENTRY, Rule.SIDE, Rule.CHANGE, Rule.OUTSIDE_ARC, Rule.SIDE, Rule.EXIT]


@pytest.mark.parametrize("code", ["G161", "G162"])
def test_a_straight_corner_is_one_point(code):
    """MNC-G161-POINTS, MNC-G162-OBTUSE: 90 degrees are not acute: the offsets Y2 and X7 go on to (7, 2)."""
    assert ends(f"{code} T1 G0 X-9|G41 G1 X0 F60|X5|Y-5|G40 Y-9")[0] == [[-9, 0], [0, 2], [7, 2], [7, -5], [5, -9]]


def test_where_the_offsets_do_not_meet_the_corner_is_an_arc():
    """MNC-G161-OBTUSE: 90 degrees, arc of radius 3 towards the tool: AB = 3 - 2 = 1 is less than the radius 2."""
    points, kinds = ends("G161 T1 G0 X-20|G41 G1 X-10 F60|X0|G3 X3 Y-3 I3|G1 X9|G40 X15")
    assert points == [[-20, 0], [-10, 2], [0, 2], [2, 0], [3, -1], [9, -1], [15, -3]]
    assert kinds == ["RAPID", "LINE", "LINE", "ARC", "ARC", "LINE", "LINE"]


def test_a_spike_is_worth_a_warning():
    """MNC-G161-SPIKE: atan(5 / 50) = 5.71 degrees, prolonged by 2 / tan(a / 2); G162 makes an arc."""
    program = "{} T1 G0 X-9|G41 G1 X0 F60|X50|X0 Y-5|G40 X-9 Y-9"
    found, half = run(lines(program.format("G161"))), math.atan(0.1) / 2
    assert found.toolpath.end[found.toolpath.line == 3][0, 0] == pytest.approx(50 + 2 / math.tan(half), abs=1e-9)
    assert [alarm.message for alarm in found.alarms] == ["the straight corner of 5.71 degrees reaches 40.15 mm out"]
    assert not run(lines(program.format("G162"))).alarms
    back = run(lines("G161 T1 G0 X-9|G41 G1 X0 F60|X50|X0|G40 X-9")).toolpath  # straight back: an arc of half a turn
    assert np.degrees(back.sweep[back.kind == Kind.ARC]).tolist() == [-180]


def test_the_exit_has_its_own_corner():
    """6.5: G160 in the block of G40 rounds the last corner alone."""
    points, _ = ends("G161 T1 G0 X-9|G41 G1 X0 F60|X5|Y-5|X0|G40 G160 Y4")
    assert points == [[-9, 0], [0, 2], [7, 2], [7, -7], [0, -7], [-2, -5], [0, 4]]


def test_radius_with_corrections_of_t_or_d_and_a_negative_one():
    program = "{} G0 X-9|{} G1 X0 F60|X5|Y-5|G40 Y-9"
    first = ends(program.format("T1", "G41"))
    assert ends(program.format("T2", "G41")) == ends(program.format("T1 D2", "G41")) == first
    assert ends(program.format("T3", "G42")) == first


def test_helix_and_full_circle():
    """Inside a circle of radius 10 about (0, 0): full turns of radius 8, the pitch stays."""
    path = run(lines("T1 G0 X2|G41 G1 X10 F60|G3 I-10 Z-3|G3 I-10|G40 G1 X2")).toolpath
    arcs = path[path.kind == Kind.ARC]
    assert np.allclose(arcs.sweep, 2 * math.pi) and np.allclose(arcs.end, [[8, 0, -3], [8, 0, -3]])
    assert np.allclose(arcs.start, [[8, 0, 0], [8, 0, -3]])


CONTOUR = st.lists(st.tuples(st.integers(-30, 30), st.integers(-30, 30)), min_size=3, max_size=6, unique=True)


def blocks(points, side, code):
    """An open contour with an entry and an exit along its first and last line."""
    p = np.array(points, dtype=float)
    first, last = p[0] + 30 * unit(p[0] - p[1]), p[-1] + 30 * unit(p[-1] - p[-2])
    words = [f"X{x:.9f} Y{y:.9f}" for x, y in [first, *p, last]]
    return [
        f"{code} T1 G0 {words[0]}",
        f"G{41 if side > 0 else 42} G1 {words[1]} F60",
        *words[2:-1],
        f"G40 {words[-1]}",
    ]


def unit(v):
    return v / np.hypot(*v)


def result(program):
    """Ends and rules of the path cut anyway, so that random contours need not fit."""
    found = mnclab.run("\n".join(program) + "\n", "mnc", Setup(tools=TOOLS, settings={"gouge": "mark"}))
    assert found.ok, found.alarms
    return found.toolpath.motion


@pytest.mark.deep
@pytest.mark.parametrize("code", ["G160", "G161", "G162"])
@settings(max_examples=40)
@given(points=CONTOUR, side=st.sampled_from([1, -1]), turn=st.sampled_from([30.0, 90.0, -77.5]))
def test_turned_and_mirrored(code, points, side, turn):
    """The program under G39 and G51 gives the turned and the mirrored path."""
    program = blocks(points, side, code)
    plain = result(program)
    turned = result([f"G39 A{turn}", *program])
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    assert np.allclose(turned.end[:, :2], plain.end[:, :2] @ np.array([[c, s], [-s, c]]), atol=1e-7)
    mirrored = result(["G51 X0", *program])
    assert np.allclose(mirrored.end[:, :2], plain.end[:, :2] * [-1, 1], atol=1e-7)
    assert mirrored.rule.tolist() == plain.rule.tolist() and (mirrored.side == -plain.side).all()


@pytest.mark.parametrize("code", ["G160", "G161", "G162"])
@settings(max_examples=40)
@given(points=CONTOUR, side=st.sampled_from([1, -1]))
def test_reversed_with_the_other_side(code, points, side):
    """Run backwards on the other side the tool passes the same points, between entry and exit."""
    there, back = (result(blocks(way, s, code)) for way, s in ((points, side), (points[::-1], -side)))
    assert len(there) == len(back)
    assert np.allclose(there.end[1:-1], back.end[1:-1][::-1], atol=1e-7)


@pytest.mark.parametrize("plane, first, second", [("G18", "Z", "X"), ("G19", "Y", "Z")])
def test_planes(plane, first, second):
    """Every plane shows what G17 shows."""
    text = "\n".join(blocks([(0, 0), (20, 0), (25, 20), (-10, 15)], -1, "G161"))
    axes = {"X": 0, "Y": 1, "Z": 2}
    other = text.replace("X", "a").replace("Y", "b").replace("a", first).replace("b", second)
    one, two = run(lines(text)).toolpath.motion, run(lines(plane + "\n" + other)).toolpath.motion
    assert np.allclose(one.end[:, :2], two.end[:, [axes[first], axes[second]]], atol=1e-12)
