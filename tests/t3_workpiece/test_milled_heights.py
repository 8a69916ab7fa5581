"""Heights of a milled part against closed forms."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from tools.milled import BALL, BLOCK, BULL, DRILL, MILL, part
from tools.running import run

from mnclab import Alarm, Tool
from mnclab.workpiece.blank import cylinder


def test_an_uncut_blank_is_as_it_was():
    left = part("G0 X10 Y10 Z5\nG1 X50")
    assert (left.heights == 0).all() and left.removed == 0 and left.volume == 60 * 40 * 20
    assert (left.cut_by == -1).all() and not left.removed_by_row().any() and left.notes == ()


def test_a_slot_has_a_flat_floor_and_round_ends():
    left = part("G0 X15 Y20\nG1 Z-3\nG1 X45\nG0 Z50")
    x, y = np.meshgrid(left.x, left.y)
    inside = np.hypot(x - np.clip(x, 15, 45), y - 20)
    assert np.array_equal(left.heights, np.where(inside <= 5, -3.0, 0.0))
    assert left.at(30, 24.999) == -3 and left.at(30, 25.001) == 0 and left.at(50.001, 20) == 0


def test_crossing_slots_are_as_deep_as_the_deeper_one():
    left = part("G0 X-10 Y20\nG1 Z-3\nG1 X70\nG0 Z5\nG0 X30 Y-10\nG1 Z-5\nG1 Y50\nG0 Z50")
    assert left.at([10, 30, 30, 10], [20, 20, 5, 5]).tolist() == [-3, -5, -5, 0]


def test_a_flat_mill_on_a_ramp_cuts_with_its_leading_rim():
    left = part("G0 X0 Y20 Z5\nG0 Z0\nG1 X60 Z-6\nG0 Z50")
    x, y = np.linspace(10, 50, 41), np.linspace(15.5, 24.5, 41)
    tip = x + np.sqrt(25 - (y - 20) ** 2)  # where the tool stands when its rim passes, on its way down, for the last time
    assert left.at(x, y) == pytest.approx(-tip / 10, abs=1e-9)


def test_a_ball_leaves_a_groove_and_scallops():
    lines = "".join(f"G0 X-10 Y{y}\nG1 Z-2\nG1 X70\nG0 Z5\n" for y in (15, 18, 21))
    left = part(lines, BALL)
    y = np.linspace(12, 24, 49)
    away = np.abs(y[:, None] - [15, 18, 21]).min(axis=1)
    assert left.at(30, y) == pytest.approx(-2 + 4 - np.sqrt(16 - away**2), abs=1e-9)
    scallop = 4 - math.sqrt(4**2 - (3 / 2) ** 2)
    assert left.at(30, 16.5) == pytest.approx(-2 + scallop, abs=1e-12)


def test_a_ball_on_a_slope_leaves_a_tilted_round_groove():
    left = part("G0 X-30 Y20\nG0 Z3\nG1 X90 Z-9\nG0 Z50", BALL)  # the tip falls 1 mm in 10
    x, y = np.linspace(20, 50, 21), np.linspace(17, 23, 21)
    # a ball swept along a line is a cylinder about the way of its centre: its lower side over each point
    centre = 3 - (x + 30) / 10 + 4
    assert left.at(x, y) == pytest.approx(centre - math.sqrt(1.01) * np.sqrt(16 - (y - 20) ** 2), abs=1e-9)


def test_a_bull_nose_leaves_a_flat_floor_with_round_corners():
    left = part("G0 X-10 Y20\nG1 Z-3\nG1 X70\nG0 Z50", BULL)
    y = np.linspace(15.01, 25, 60)
    out = np.maximum(np.abs(y - 20) - 3.5, 0)
    assert left.at(30, y) == pytest.approx(-3 + 1.5 - np.sqrt(1.5**2 - out**2), abs=1e-9)


def test_a_bull_nose_on_a_ramp_agrees_with_its_places():
    left = part("G0 X-30 Y20\nG0 Z3\nG1 X90 Z-9\nG0 Z50", BULL)
    place = np.linspace(-30, 90, 2_400_001)
    for x, y in ((30.0, 20.0), (20.0, 23.9), (25.0, 16.2), (40.0, 24.9)):
        rho = np.hypot(x - place, y - 20)
        tip, out = 3 - (place + 30) / 10, np.maximum(rho - 3.5, 0)
        under = rho <= 5
        height = tip[under] + 1.5 - np.sqrt(np.maximum(1.5**2 - out[under] ** 2, 0))
        assert left.at(x, y) == pytest.approx(height.min(), abs=1e-8)


@pytest.mark.parametrize("angle", [90, 118, 140])
def test_a_drill_leaves_its_point(angle):
    left = part("G0 X30 Y20\nG1 Z-10\nG0 Z50", Tool(radius=3, number=1, kind="drill", angle=angle))
    rho = np.linspace(0, 2.999, 50)
    assert left.at(30 + rho * 0.6, 20 + rho * 0.8) == pytest.approx(-10 + rho / math.tan(math.radians(angle / 2)), abs=1e-9)
    assert left.at(33.001, 20) == 0


def test_a_drill_through_the_blank_leaves_nothing_under_it():
    left = part("G0 X30 Y20\nG1 Z-25\nG0 Z50", DRILL)
    assert left.at(30, 20) == -20 and left.at(30, 22.9) == -20
    assert left.removed == pytest.approx(math.pi * 9 * 20, rel=1e-3)


@pytest.mark.parametrize("sense", ["G2", "G3"])
def test_a_full_circle_is_a_ring(sense):
    left = part(f"G0 X40 Y20\nG1 Z-3\n{sense} X40 Y20 I-10 J0\nG0 Z50", Tool(radius=3, number=1))
    x, y = np.meshgrid(left.x, left.y)
    ring = np.abs(np.hypot(x - 30, y - 20) - 10) <= 3
    assert np.array_equal(left.heights, np.where(ring, -3.0, 0.0))


@pytest.mark.parametrize("sweep", [90, 180, 181, 270, 359])
def test_an_arc_ends_where_it_ends(sweep):
    end = math.radians(sweep)
    x, y = 30 + 10 * math.cos(end), 20 + 10 * math.sin(end)
    left = part(f"G0 X40 Y20\nG1 Z-3\nG3 X{x:.9f} Y{y:.9f} I-10 J0\nG0 Z50", Tool(radius=3, number=1))
    px, py = np.meshgrid(left.x, left.y)
    angle = np.mod(np.arctan2(py - 20, px - 30), 2 * np.pi)
    near = np.minimum(np.hypot(px - 40, py - 20), np.hypot(px - x, py - y))
    cut = np.where(angle <= end, np.abs(np.hypot(px - 30, py - 20) - 10), near) <= 3
    assert np.array_equal(left.heights, np.where(cut, -3.0, 0.0))


def test_a_helical_bore_has_the_level_of_its_last_turn():
    turns = "".join(f"G3 X33 Y20 Z{-2 * (k + 1)} I-3 J0\n" for k in range(4))
    left = part(f"G0 X33 Y20\nG1 Z0\n{turns}G0 Z50", MILL)
    # a point at (30 - 7.5, 20) is last under the rim when the tool's leading rim leaves it: cosine rule in the triangle
    # of centre, tool and point
    half = math.acos((7.5**2 + 3**2 - 5**2) / (2 * 7.5 * 3))
    assert left.at(22.5, 20) == pytest.approx(-6 - 2 * (math.pi + half) / (2 * math.pi), abs=1e-9)
    assert left.at(30, 20) == pytest.approx(-8, abs=1e-12)  # always under the tool
    assert left.at(38.001, 20) == 0


@pytest.mark.parametrize("tool", [MILL, BALL, BULL, DRILL], ids=["flat", "ball", "bull", "drill"])
@pytest.mark.parametrize("round_", [2.0, 7.0])
def test_a_helix_agrees_with_its_places(tool, round_):
    turns = "".join(f"G3 X{30 + round_} Y20 Z{-1.5 * (k + 1)} I-{round_} J0\n" for k in range(2))
    left = part(f"G0 X{30 + round_} Y20\nG1 Z0\n{turns}G0 Z50", tool)
    angle = np.linspace(0, 4 * np.pi, 1_000_001)
    spots = np.array([(30, 20.5), (24, 22), (36.5, 18), (31, 13.5), (33, 25.2), (30 + round_, 20)])
    for x, y in spots:
        rho = np.hypot(x - 30 - round_ * np.cos(angle), y - 20 - round_ * np.sin(angle))
        tip = -1.5 * angle / (2 * np.pi)
        if tool.kind == "drill":
            edge = rho / math.tan(math.radians(59))
        else:
            edge = tool.corner - np.sqrt(np.maximum(tool.corner**2 - np.maximum(rho - tool.radius + tool.corner, 0) ** 2, 0))
        height = np.where(rho <= tool.radius, tip + edge, 0.0).min()
        assert left.at(x, y) == pytest.approx(height, abs=2e-5)  # a place of the sampled way is 3 µm of tip and 0.1 mm of none
        assert left.at(x, y) <= height + 1e-9


def test_an_arc_in_another_plane_is_cut_by_chords_and_says_so():
    left = part("G0 X20 Y20\nG1 Z0\nG18 G2 X40 Z0 I10 K0\nG17 G0 Z50", Tool(radius=0.5, corner=0.5, number=1))
    assert left.error == 1e-4
    x = np.array([24, 27, 30, 33.5])
    # the way of the ball's centre is the circle 0.5 mm higher, the groove one of 10.5 mm about the same centre
    assert left.at(x, 20) == pytest.approx(0.5 - np.sqrt(10.5**2 - (x - 30) ** 2), abs=1.5e-4)


def test_dl_and_dr_of_the_table_belong_to_the_tool():
    left = part("G0 X15 Y20\nG1 Z-3\nG1 X45\nG0 Z50", Tool(radius=5, dr=0.5, number=1))
    assert left.at(30, 25.499) == -3 and left.at(30, 25.501) == 0


def test_blanks_that_are_turned_bodies():
    upright = part("G0 X-30 Y0\nG1 Z-2\nG1 X30\nG0 Z50", stock=cylinder(20, -10, 0))
    assert upright.at([0, 19, 0, 15], [0, 0, 10, 15]).tolist() == [-2, -2, 0, -10]
    tube = part("G0 X-30 Y0\nG1 Z-2\nG1 X30\nG0 Z50", stock=cylinder(20, -10, 0, bore=8))
    assert tube.at([0, 19, 0], [0, 0, 10]).tolist() == [-10, -2, 0] and tube.at(0, 5) == tube.floor.min()
    lying = part("G0 X0 Y0\nG0 Z5\nG1 Z2\nG1 X40\nG0 Z50", stock=cylinder(6, 0, 40, axis="X"))
    y = np.array([-5.5, -4.9, 0, 4.9, 5.5])
    assert lying.at(20, y) == pytest.approx(np.where(abs(y) <= 5, np.minimum(2, np.sqrt(36 - y**2)), np.sqrt(36 - y**2)))


def test_what_was_left_after_a_row_or_a_pass_of_a_line():
    text = "G17 G90 G54\nT1\nS1000 M3 F500\nG0 Z50\nG0 X15 Y20\nG1 Z-3\nG1 X45\nG1 Z-5\nG1 X15\nG0 Z50"
    done = run(text, tools={1: MILL}, stock=BLOCK)
    assert [done.workpiece(line=line).at(30, 20) for line in (6, 7, 8, 9)] == [0, -3, -3, -5]
    rows = done.toolpath.line.tolist()
    assert done.workpiece(row=rows.index(7)).at(30, 20) == -3
    assert done.workpiece(row=-1).at(30, 20) == -5


def test_the_row_that_cut_last_is_named_and_retracts_are_not():
    done = run("G17 G90 G54\nT1\nS1000 M3 F500\nG0 Z50\nG0 X15 Y20\nG1 Z-3\nG1 X45\nG1 Z-5\nG1 X15\nG0 Z50", tools={1: MILL},
               stock=BLOCK)  # fmt: skip
    left = done.workpiece()
    rows = np.unique(left.cut_by)
    lines = [done.toolpath.line[row] for row in rows if row >= 0]
    assert lines == [8, 9]  # all that was cut higher was cut again, and the retract touches its own floor alone


@pytest.mark.parametrize("wrong", ["x", None, math.nan, math.inf, [1, 2, "a"]])
def test_a_place_that_is_none_is_refused(wrong):
    left = part("G0 X10 Y10")
    with pytest.raises(Alarm, match="finite numbers"):
        left.at(wrong, 0)


def test_places_that_do_not_go_together_and_steps_that_are_none_are_refused():
    done = run("G17 G90 G54\nG0 Z50", tools={1: MILL}, stock=BLOCK)
    with pytest.raises(Alarm, match="go together"):
        done.workpiece().at([1, 2, 3], [1, 2])
    for step in (0, -1, math.nan, "fine"):
        with pytest.raises(Alarm, match="the step of a workpiece"):
            done.workpiece(step=step)
    with pytest.raises(Alarm, match="at most 25,000,000 cells"):
        done.workpiece(step=1e-4)
    with pytest.raises(Alarm, match="there is no blank"):
        run("G17 G90 G54\nG0 Z50", tools={1: MILL}).workpiece()


moves = st.lists(st.tuples(st.integers(-50, 50), st.integers(-50, 50), st.integers(-40, 10)), min_size=2, max_size=6)
tools = st.sampled_from([MILL, BALL, BULL, DRILL])
SQUARE = ((-6, -6, -5), (6, 6, 0))


def lines_of(points):
    """Straight moves through points in tenths of a millimetre."""
    (x, y, z), *others = points
    first = f"G0 X{x / 10} Y{y / 10}\nG1 Z{z / 10}\n"
    return first + "".join(f"G1 X{x / 10} Y{y / 10} Z{z / 10}\n" for x, y, z in others) + "G0 Z50\n"


def heights(points, tool, stock=SQUARE):
    return part(lines_of(points), tool, stock, step=1.0).heights


@settings(max_examples=25, deadline=None)
@given(moves, tools)
def test_turned_mirrored_and_shifted_programs_make_turned_mirrored_and_shifted_parts(points, tool):
    plain = heights(points, tool)
    assert np.allclose(heights([(-y, x, z) for x, y, z in points], tool), np.rot90(plain, -1), atol=1e-8)
    assert np.allclose(heights([(-x, y, z) for x, y, z in points], tool), plain[:, ::-1], atol=1e-8)
    shifted = heights([(x + 30, y - 20, z - 10) for x, y, z in points], tool, ((-3, -8, -6), (9, 4, -1)))
    assert np.allclose(shifted + 1, plain, atol=1e-8)


@settings(max_examples=25, deadline=None)
@given(moves, tools)
def test_backwards_or_in_two_pieces_a_way_leaves_the_same(points, tool):
    start = [(points[0][0], points[0][1], 20)]
    plain = heights(start + points + [(*points[-1][:2], 20)], tool)
    assert np.allclose(heights([(*points[-1][:2], 20)] + points[::-1] + start, tool), plain, atol=1e-8)
    doubled = [each for a, b in zip(points, points[1:]) for each in (a, tuple((p + q) / 2 for p, q in zip(a, b)))]
    assert np.allclose(heights(start + doubled + [points[-1]] + [(*points[-1][:2], 20)], tool), plain, atol=1e-7)
