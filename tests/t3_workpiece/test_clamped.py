"""The second clamping: a part that was cut before is the next blank; expected heights and volumes are worked out by hand."""

import copy
import functools
import math
import pickle

import numpy as np
import pytest
from tools.milled import BALL, BULL, DRILL, MILL, part
from tools.running import run

import mnclab
from mnclab import Tool
from mnclab.workpiece.milling.collisions import collisions_of

# X15 to 45, Y10 to 26, 8 deep, corners of 5: its middle is not that of the block of 60 by 40 by 20
POCKET = "G0 X20 Y15\nG1 Z-8\nG1 X40\nG1 Y21\nG1 X20\nG1 Y15\nG0 Z50\n"
POCKET_AREA = 30 * 16 - (4 - math.pi) * 25
NARROW = Tool(radius=3, number=1, kind="mill")
AXES = {"x": lambda x, y: (x, 40 - y), "y": lambda x, y: (60 - x, y)}  # where a place was before the part was turned over
OTHER = {"x": (20, 22), "y": (40, 18)}  # where the middle of a pocket at 20 18 is then


def places(count=4000, seed=1):
    return np.random.default_rng(seed).uniform([0, 0], [60, 40], (count, 2)).T


def in_pocket(x, y):
    """Whether a place lies in the pocket."""
    dx, dy = np.maximum(np.abs(x - 30) - 10, 0), np.maximum(np.abs(y - 18) - 3, 0)
    return np.hypot(dx, dy) <= 5


@pytest.mark.parametrize("axis", ["x", "y", "X"])
def test_a_pocket_from_above_and_a_hole_from_below(axis):
    """The hole, radius 3 and 15 deep, meets the floor of the pocket, 12 below the new top: what is left of it goes through."""
    (hx, hy) = OTHER[axis.lower()]
    second = part(f"G0 X{hx} Y{hy}\nG1 Z-15\nG0 Z50\nG0 X10 Y5\nG1 Z-7\nG0 Z50\n", NARROW, part(POCKET).turned_over(axis))
    x, y = places()
    was = in_pocket(*AXES[axis.lower()](x, y))
    hole, blind = np.hypot(x - hx, y - hy) <= 3, np.hypot(x - 10, y - 5) <= 3
    floor = np.where(was, -12.0, -20.0)
    expected = np.where(hole, np.maximum(-15.0, floor), np.where(blind, -7.0, 0.0))
    assert np.abs(second.at(x, y) - expected).max() < 1e-9
    below, above = second.faces(x, y)
    assert np.array_equal(np.isnan(above), hole & was)
    assert np.nanmax(np.abs(below - np.where(hole & was, np.nan, floor))) < 1e-9
    assert second.removed == pytest.approx(math.pi * 9 * 12 + math.pi * 9 * 7, rel=1e-3)
    assert second.volume == pytest.approx(48000 - POCKET_AREA * 8 - math.pi * 9 * 19, rel=1e-5)


def test_turned_over_twice_it_is_the_same():
    first = part("G0 X10 Y10\nG1 Z-5\nG2 X30 Y30 Z-9 R20\nG1 X50 Y5 Z-2\nG0 Z50\n", BULL)
    x, y = places()
    for axis in "xy":
        again = first.turned_over(axis).turned_over(axis)
        assert np.abs(again.at(x, y) - first.at(x, y)).max() < 1e-12
    half_round = first.turned_over("x").turned_over("y")  # the same as half a turn about Z
    assert np.abs(half_round.at(60 - x, 40 - y) - first.at(x, y)).max() < 1e-12
    assert again.volume == first.volume and again.bounds.tolist() == [[0, 0, -20], [60, 40, 0]]


def test_turned_about_z_and_moved():
    first, (x, y) = part(POCKET), places()
    quarter = first.turned(90)  # about 30 20
    assert quarter.bounds == pytest.approx(np.array([[10, -10, -20], [50, 50, 0]]))
    assert np.abs(quarter.at(30 - (y - 20), 20 + (x - 30)) - first.at(x, y)).max() < 1e-12
    c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
    turned = first.turned(30).at(30 + c * (x - 30) - s * (y - 20), 20 + s * (x - 30) + c * (y - 20))
    inside = np.minimum(np.minimum(x, 60 - x), np.minimum(y, 40 - y)) > 1e-6
    clear = np.abs(np.hypot(np.maximum(np.abs(x - 30) - 10, 0), np.maximum(np.abs(y - 18) - 3, 0)) - 5) > 1e-6
    assert np.abs(turned - first.at(x, y))[inside & clear].max() < 1e-12
    there = first.moved((100, -50, 7))
    assert np.abs(there.at(x + 100, y - 50) - 7 - first.at(x, y)).max() < 1e-12
    assert there.volume == first.volume == first.turned_over("y").volume


def test_it_stands_on_the_machine_where_it_stood():
    """The first program counts from G54 at 100 50 -200; the second from machine zero."""
    stock, tools = ((100, 50, -220), (160, 90, -200)), {1: MILL}
    first = run(f"G17 G90 G54\nT1\nS1000 M3 F500\nG0 Z50\n{POCKET}", stock=stock, tools=tools, datums={1: (100, 50, -200)})
    assert first.workpiece().bounds.tolist() == [[0, 0, -20], [60, 40, 0]]
    assert first.workpiece().as_blank().bounds.tolist() == [[100, 50, -220], [160, 90, -200]]
    moves = "G17 G90\nT1\nS1000 M3 F500\nG0 Z-150\nG0 X105 Y52\nG1 Z-203\nG0 Z-100\n"
    over = first.workpiece().turned_over("x")
    second = run(moves, stock=over, tools=tools).workpiece()
    x, y = places()
    was, slot = in_pocket(x, 40 - y), np.hypot(x - 5, y - 2) <= 5
    assert np.abs(second.at(x + 100, y + 50) - np.where(slot, -203.0, -200.0)).max() < 1e-9
    assert np.nanmax(np.abs(second.faces(x + 100, y + 50)[0] - np.where(was, -212.0, -220.0))) < 1e-9
    same = first.workpiece(stock=over.as_blank())  # the first program over again, on the other side
    assert np.abs(same.at(x, y) - np.where(in_pocket(x, y), -8, 0)).max() < 1e-9
    assert same.volume == pytest.approx(48000 - 2 * POCKET_AREA * 8, rel=1e-5)


@pytest.mark.parametrize("tool", [MILL, BALL])
def test_walls_of_the_old_pocket_that_are_cut_across_weigh_their_share(tool):
    """A slot 4 deep along Y18 over the pocket, 8 deep between X15 and X45 there: only what stands beside it is removed.

    The ends of the pocket are straight for 6 mm about Y18 and round beyond: as far as the mill is wider the slot meets them.
    """
    second = part("G0 X-10 Y18\nG1 Z-4\nG1 X70\nG0 Z50\n", tool, part(POCKET))
    beside = np.linspace(-tool.radius, tool.radius, 200_001)
    deep = 4 - (tool.corner - np.sqrt(tool.corner**2 - beside**2)) if tool.corner else np.full(len(beside), 4.0)
    out = np.maximum(np.abs(beside) - 3, 0)
    long = 60 - 2 * (10 + np.sqrt(25 - out**2))
    assert second.removed == pytest.approx(float(np.trapezoid(long * deep, beside)), rel=1e-3)
    assert sum(second.removed_by("row").values()) == pytest.approx(second.removed)
    assert second.at([5, 30, 5], [18, 18, 30]) == pytest.approx([-4, -8, 0])


def test_sections_through_both_sides():
    """Pocket from below, 8 deep, and a hole of radius 3 that meets it: areas by hand."""
    hx, hy = OTHER["x"]
    second = part(f"G0 X{hx} Y{hy}\nG1 Z-15\nG0 Z50\n", NARROW, part(POCKET).turned_over("x"))
    for z, area in ((-16, 2400 - POCKET_AREA), (-5, 2400 - 9 * math.pi)):
        assert sum(each.area for each in second.cut("XY", z)) == pytest.approx(area, abs=0.01)
    pieces = second.cut("XZ", hy)
    assert sum(each.area for each in pieces) == pytest.approx(60 * 20 - 30 * 8 - 6 * 12, abs=1e-3) and len(pieces) == 2
    assert sorted(p for each in pieces for p in each.bounds[:, 0].tolist()) == pytest.approx([0, 17, 23, 60], abs=1e-6)


@functools.cache
def with_a_pocket_below():
    return part("G0 X50 Y35\nG1 Z-2\nG0 Z50\n", MILL, part(POCKET).turned_over("x")).part


@pytest.mark.parametrize(("start", "way", "expected"), [
    ((30, 22, -30), (0, 0, 1), 17),  # the floor of the old pocket, now from below: z -12, less the ball
    ((30, 22, -16), (1, 0, 0), 14), ((30, 22, -16), (-1, 0, 0), 14),  # its walls at X45 and X15
    ((30, 22, -16), (0, 1, 0), 7), ((30, 22, -16), (0, -1, 0), 7),  # at Y30 and Y14
    ((30, 22, 10), (0, 0, -1), 9), ((-5, 22, -16), (1, 0, 0), 4),
])  # fmt: skip
def test_a_probe_touches_the_walls_of_a_former_clamping(start, way, expected):
    assert mnclab.part.contact(with_a_pocket_below(), start, way, 1.0, 60) == pytest.approx(expected, abs=1e-9)


def test_a_rapid_over_a_former_pocket_is_none_into_what_is_left_is_one():
    blank = part(POCKET)
    clear = part("G0 X30 Y18\nG0 Z-7\nG0 X35\nG0 Z50\n", MILL, blank)
    assert collisions_of(clear.cutting) == ()
    (met,) = collisions_of(part("G0 X30 Y18\nG0 Z-7\nG0 X50\nG0 Z50\n", MILL, blank).cutting)
    assert met.kind == "rapid" and met.depth == pytest.approx(7, abs=0.02)
    (met,) = collisions_of(part("G0 X30 Y18\nG0 Z-7\nG0 Z50\n", MILL, blank.turned_over("x")).cutting)
    assert met.depth == pytest.approx(7, abs=0.02)


def test_three_clampings():
    """On its side X: 3 mm off the top, turned over: 2 mm off the other side, turned about Z: a hole through."""
    face = "".join(f"G0 X-10 Y{y}\nG1 Z{{z}}\nG1 X70\nG0 Z50\n" for y in range(0, 45, 8))
    first = part(face.format(z=-3))
    second = part(face.format(z=-2), MILL, first.turned_over("x"))
    third = part("G0 X20 Y10\nG1 Z-30\nG0 Z50\n", NARROW, second.turned(180))
    x, y = places()
    below, above = third.faces(x, y)
    hole = np.hypot(x - 20, y - 10) <= 3
    assert np.array_equal(np.isnan(above), hole)
    assert np.nanmax(np.abs(above + 2)) < 1e-9 and np.nanmax(np.abs(below + 17)) < 1e-9
    assert third.volume == pytest.approx(2400 * 15 - math.pi * 9 * 15, rel=1e-5)
    assert len(list(third.cutting.stock.made_by())) == 2


def test_copies_and_pickles_and_words():
    first = part(POCKET)
    blank = first.turned_over("x").as_blank()
    assert copy.deepcopy(blank) is blank and copy.deepcopy(first) is first
    again, (x, y) = pickle.loads(pickle.dumps(blank)), places(50)
    assert np.array_equal(again.faces(x, y)[0], blank.faces(x, y)[0])
    assert repr(blank).startswith("a part cut before (X0 Y0 Z-20 to X60 Y40 Z0, ") and "turned over" in repr(blank)
    assert "turned 30 degrees" in repr(first.turned(30).as_blank())
    setup = mnclab.Setup(stock=first)
    assert "a part cut before" in repr(setup) and mnclab.run("G0 X1\n", "g43", setup).setup.stock is first


@pytest.mark.parametrize(("asked", "said"), [
    (lambda w: w.turned_over("z"), "the axis that a part is turned over about must be x or y, got 'z'"),
    (lambda w: w.turned_over(None), "must be x or y, got None"),
    (lambda w: w.turned("a"), r"the angle by which a part is turned about Z \(degrees\)"),
    (lambda w: w.moved((1, 2)), r"how far a part is moved \(mm\) must be three numbers"),
    (lambda w: w.moved((1, 2, float("nan"))), r"how far a part is moved \(mm\) must be a finite number"),
])  # fmt: skip
def test_what_cannot_be_clamped(asked, said):
    with pytest.raises(mnclab.Alarm, match=said):
        asked(part(POCKET))


def test_notes_of_a_blank_are_told_once_more():
    tap = Tool(radius=3, number=1, kind="tap", pitch=1)
    first = part("G0 X10 Y10\nG1 Z-8\nG0 Z50\n", tap)
    third = part("G0 X30 Y10\nG1 Z-8\nG0 Z50\n", MILL, part(POCKET, MILL, first.turned_over("x")).turned_over("y"))
    (note,) = third.notes
    assert note.startswith("of the blank: a thread is shown without its flanks")
    assert first.turned_over("x").notes == (note,)


def test_a_drilled_cone_from_below_keeps_its_slope():
    """A drill of radius 3 and 118 degrees, its tip 9 deep: now a cone in the lower side."""
    over = part("G0 X20 Y18\nG1 Z-9\nG0 Z50\n", DRILL).turned_over("x")
    rho = np.linspace(0, 2.999, 50)
    floor = over.faces(20 + rho, np.full(50, 22.0))[0]
    assert np.abs(floor - (-20 + 9 - rho / math.tan(math.radians(59)))).max() < 1e-9


@pytest.mark.deep
def test_what_very_many_moves_left_is_a_blank_too():
    """A plate 3 mm thick gone in 20,005 moves; turned over it is the lower side, and a slot 5 deep weighs its box."""
    from t3_workpiece.test_many_moves import FLAT, cutting, passes

    from mnclab.workpiece.milling.milled import EXACT, Milled

    first = Milled(cutting(passes(-3.0, EXACT + 5)))
    second = part("G0 X-10 Y30\nG1 Z-5\nX90\nG0 Z50\n", MILL, first.turned_over("x"))
    assert second.faces(np.array([10.0, 40.0]), np.array([10.0, 30.0]))[0] == pytest.approx([-17, -17])
    assert second.at([40, 40], [30, 10]) == pytest.approx([-5, 0])
    assert second.removed == pytest.approx(80 * 10 * 5, rel=1e-3)
    assert second.volume == pytest.approx(80 * 60 * 17 - 4000, rel=1e-5)
    assert second.error == first.error and any(note.startswith("of the blank: level sections") for note in second.notes)
    third = Milled(cutting(passes(-1.0, EXACT + 5), (FLAT,), stock=second.turned_over("x").as_blank()))
    assert third.method == "erosion of the height raster"
    assert third.at(40, 30) == -3 and third.volume == pytest.approx(second.volume, rel=1e-6)  # 1 mm down there is nothing
