"""Cycles 251 to 254: the manual's examples with the numbers worked out for them, and the steps in their order.

Tool radii and plunge angles are not printed; each test says which it takes. What the cycles take away: test_pockets_swept.
"""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from tools.running import changed, of_cycles, run

import mnclab
from mnclab import Kind, Setup, Tool

FILE = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-pockets.json"
PROGRAMS = {example["code"][-3:]: example["program"] for example in json.loads(FILE.read_text(encoding="utf-8"))}
C210 = PROGRAMS["10)"]
PROGRAMS = {number: PROGRAMS[number] for number in ("251", "252", "253", "254")}

NEAR = {"abs": 1e-4}
LEVELS = [-5, -10, -15, -19.9]


def near(value):
    return pytest.approx(value, **NEAR)


def milled(number, radius, settings=None, height=100.0, **change):
    """The motion of the example of a cycle, its tool of a radius that plunges at 3 degrees; Q parameters may be changed."""
    tool = {name: change.pop(name) for name in ("cutting_length", "plunge_angle") if name in change}
    tools = {1: Tool(**({"radius": radius, "plunge_angle": 3} | tool))}
    program = f"1 TOOL CALL 1 Z S1000\n{changed(PROGRAMS[number], **change)}"
    return of_cycles(run(program, "tnc-620", tools=tools, start=(0, 0, height), settings=settings or {}).toolpath)


def names(rows):
    return [rows.labels[k] for k in rows.label]


def said(rows, *parts):
    """The rows whose label has all these parts."""
    return rows[np.array([all(part in name for part in parts) for name in names(rows)])]


def levels(rows):
    """Heights where passes are cut in the plane, each once, in order."""
    passes = np.array(["entry" not in name for name in names(rows)], dtype=bool)
    level = rows[passes & (rows.kind != Kind.RAPID) & (rows.start[:, 2] == rows.end[:, 2])]
    return list(dict.fromkeys(level.end[:, 2].round(6).tolist()))


def layers(rows):
    """Levels of roughing and of side finishing."""
    return levels(said(rows, "layer")), levels(said(rows, "side finishing"))


def ring(rows, *parts):
    """The radii, about (50, 50), or the half sides of a ring."""
    return np.abs(said(rows, *parts).end[:, :2] - 50).max(axis=0).tolist()


# --- the examples of the manual --------------------------------------------------------------------------------------


def test_example_6_2():
    """R = 5, ANGLE = 3: five stepovers of 4.96, a helix of radius 5 and a lead of 1.64644."""
    rows = milled("251", 5)
    assert layers(rows) == (LEVELS, LEVELS)
    assert levels(said(rows, "floor")) == [-20]
    sides = [ring(rows, f"layer 1 of 4, ring {k} of 6") for k in range(1, 7)]  # the first one is a line there and back
    assert sides == [near([10 + 4.96 * k, 4.96 * k]) for k in range(6)]
    around = said(rows, "side finishing 1 of 4")
    wall = around[[name.endswith("1 of 4") for name in names(around)]]
    assert ring(wall, "") == near([35, 25]) and (wall.kind == Kind.LINE).all()
    assert (said(rows, "ring").feed == 500).all() and (said(rows, "down to what is cut").feed == 150).all()
    helix = said(rows, "layer 1 of 4, entry helix")
    assert np.hypot(*(helix[0].end[:2] - helix[0].centre[:2])) == near(5)
    assert helix[0].sweep / math.tau == near(5 / 1.64644) and helix[1].sweep == near(math.tau)
    assert said(rows, "layer 4 of 4, entry helix")[0].sweep / math.tau == near(4.9 / 1.64644)
    assert helix[0].feed == 150 and helix[1].feed == 500
    assert rows[0].end.tolist() == [50, 50, 2] and rows[-1].end.tolist() == [50, 50, 50]
    assert wall.length == near(2 * (70 + 50))


@pytest.mark.parametrize(
    ("position", "centre"), [(0, (50, 50)), (1, (90, 80)), (2, (10, 80)), (3, (10, 20)), (4, (90, 20))]
)
def test_positions_of_a_rectangular_pocket(position, centre):
    """The tool at the centre or at a corner; the figure turns about the tool, and there the tool comes back to."""
    rows = milled("251", 5, Q367=position)
    assert said(rows, "layer 1 of 4, down to what is cut").end.tolist() == [[*centre, 0]]
    bounds = said(rows, "side finishing 4 of 4").end
    assert ((bounds.max(axis=0) + bounds.min(axis=0)) / 2)[:2].tolist() == near(centre)
    turned = milled("251", 5, Q367=position, Q224=90)
    x, y = centre[0] - 50, centre[1] - 50
    bounds = said(turned, "side finishing 4 of 4").end
    assert ((bounds.max(axis=0) + bounds.min(axis=0)) / 2)[:2].tolist() == near([50 - y, 50 + x])
    assert turned[-1].end.tolist() == rows[-1].end.tolist() == [50, 50, 50]


def test_example_6_3():
    """R = 10, ANGLE = 3: circles of 9.9 and 19.8, the side on 20 from 17.8; Q439 = 3: 500·20/30 on the finished circle."""
    rows = milled("252", 10)
    assert layers(rows) == (LEVELS, LEVELS) and levels(said(rows, "floor")) == [-20]
    circles = said(rows, "layer 1 of 4, circle")
    assert (circles.sweep == math.tau).all() and (circles.end[:, 0] - 50).tolist() == near([9.9, 19.8])
    assert circles.feed.tolist() == near([500 * 9.9 / 19.9, 500 * 19.8 / 29.8])
    over, down, to, around, off = said(rows, "side finishing 1 of 4")[:5]
    assert over.end.tolist() == near([67.8, 50, -3]) and down.end.tolist() == near([67.8, 50, -5])
    assert to.end[:2].tolist() == near([70, 50]) and to.sweep == near(math.pi)
    assert around.sweep == math.tau and around.feed == near(333.3333)
    assert off.end[:2].tolist() == near([67.8, 50])
    helix = said(rows, "layer 1 of 4, entry helix")[0]
    assert helix.sweep / math.tau == near(5 / 3.29288) and np.hypot(*(helix.end - helix.centre)[:2]) == near(10)
    assert said(rows, "floor", "circle")[-1].end[:2].tolist() == near([70, 50])
    assert rows[-1].end.tolist() == [50, 50, 50]


def test_example_6_4():
    """R = 5: one pass 0.8 round the line, the side at 1; 68 mm for 95.4: two strokes of 2.5, at 2.1055 degrees."""
    rows = milled("253", 5)
    assert layers(rows) == (LEVELS, LEVELS) and levels(said(rows, "floor")) == [-20]
    strokes = said(rows, "layer 1 of 4, entry ramp")
    assert strokes.end.tolist() == [near([84, 50, -2.5]), near([16, 50, -5])] and (strokes.feed == 150).all()
    assert math.degrees(math.atan2(2.5, 68)) == near(2.1055)
    ring = said(rows, "layer 1 of 4, ring")
    assert np.abs(ring.end[:, 1] - 50).max() == near(0.8) and ring.end[:, 0].max() == near(84.8)
    over_to, *_ = said(rows, "side finishing 1 of 4, to the wall")
    assert over_to.start[:2].tolist() == near([16, 50]) and over_to.end[:2].tolist() == near([15, 50])
    assert np.abs(said(rows, "side finishing 1 of 4").end[:, 1] - 50).max() == near(1)
    assert (said(rows, "layer", "lift").end[:, 2] == 2).all()  # out of the slot
    assert rows[-1].end.tolist() == [50, 50, 50]


def test_a_slot_as_wide_as_the_tool():
    """R = 6: the centre line alone, to -19.9, no finishing."""
    rows = milled("253", 6)
    assert layers(rows) == (LEVELS, []) and not len(said(rows, "floor"))
    cut = rows[rows.kind != Kind.RAPID]
    assert (cut.end[:, 1] == 50).all() and set(cut.end[:, 0].round(9)) == {16, 84}
    assert cut.end[:, 2].min() == near(-19.9)


@pytest.mark.parametrize(("position", "left", "right"), [(1, 50, 130), (2, 44, 124), (3, -24, 56), (4, -30, 50)])
def test_positions_of_a_slot(position, left, right):
    """Where it begins and ends along X; after it the tool stays above the left arc."""
    rows = milled("253", 5, Q367=position)
    cut = rows[rows.kind != Kind.RAPID]
    assert cut.end[:, 0].min() - 5 == near(left) and cut.end[:, 0].max() + 5 == near(right)
    assert rows[-1].end.tolist() == near([left + 6, 50, 50])
    turned = milled("253", 5, Q367=position, Q374=90)
    assert turned.end[turned.kind != Kind.RAPID][:, 1].min() - 5 == near(left)
    assert turned[-1].end.tolist() == near([50, left + 6, 50])


def test_example_6_5():
    """About (50, 50) on a radius of 40 from 45 to 135 degrees: two strokes of 62.832 mm for 5 mm."""
    rows = milled("254", 5)
    assert layers(rows) == (LEVELS, LEVELS) and levels(said(rows, "floor")) == [-20]
    first, second = said(rows, "layer 1 of 4, entry ramp")
    assert first.start.tolist() == near([78.2843, 78.2843, 0]) and first.end.tolist() == near([21.7157, 78.2843, -2.5])
    assert first.centre[:2].tolist() == near([50, 50]) and first.sweep * 40 == pytest.approx(62.832, abs=1e-3)
    assert second.sweep == near(-first.sweep) and second.end.tolist() == near([78.2843, 78.2843, -5])
    assert rows[-1].end.tolist() == [50, 50, 50]


@pytest.mark.parametrize(("position", "angle"), [(1, 45), (2, 0), (3, -45)])
def test_positions_of_a_circular_slot(position, angle):
    """The tool stands at 45 degrees on the circle, at the beginning, in the middle or at the end of the centre line."""
    rows = milled("254", 5, Q367=position, Q216=-900, Q217=-900)
    middle = np.array([50, 50]) - 40 * np.array([math.cos(math.pi / 4), math.sin(math.pi / 4)])
    begin = middle + 40 * np.array([math.cos(math.radians(angle)), math.sin(math.radians(angle))])
    ramp = said(rows, "layer 1 of 4, entry ramp")[0]
    assert ramp.start[:2].tolist() == near(begin.tolist()) and ramp.centre[:2].tolist() == near(middle.tolist())
    assert ramp.sweep == near(math.pi / 2)
    assert rows[-1].end.tolist() == near([*begin.tolist(), 50])


def test_repetitions_turn_the_slot_about_the_pitch_circle():
    rows = milled("254", 5, Q377=3, Q378=120)
    over = rows[[name.endswith("over the start") for name in names(rows)]]
    ways = np.degrees(np.arctan2(over.end[:, 1] - 50, over.end[:, 0] - 50)) % 360
    assert ways.tolist() == near([45, 165, 285])
    assert over.end[1:, 2].tolist() == [50, 50]  # in the second set-up plane
    assert rows[-1].end.tolist() == [50, 50, 50]


def test_pgm_c210():
    """The program of 6.10 with R = 10 and R = 3, ANGLE 3: stud, pocket and slots.

    Block 6 moves before any feed was programmed; the setting takes it as FMAX, with a warning.
    """
    tools = {1: Tool(radius=10, plunge_angle=3), 2: Tool(radius=3, plunge_angle=3)}
    found = mnclab.run(C210, "tnc-620", Setup(tools=tools, settings={"feed_needed": False}))
    (warning,) = found.alarms
    assert found.ok and "no feed rate" in warning.message and warning.span[:2] == (25, 1)
    path = found.toolpath[found.toolpath.is_motion]
    stud = said(path, "CYCL DEF 256")
    assert levels(stud) == [-5, -10, -15, -20, -25, -30]
    assert ring(stud, "layer 1 of 6, ring") == near([55, 50])
    assert said(stud, "over the start").end[0, :2].tolist() == near([112, 50]) and stud[-1].end[2] == 20
    pocket, slots = said(path, "CYCL DEF 252"), said(path, "CYCL DEF 254")
    deep = [-5, -10, -15, -20, -25, -29.9]
    assert layers(pocket) == (deep, deep) and levels(said(pocket, "floor")) == [-30]
    assert (said(pocket, "layer 1 of 6, circle").end[:, 0] - 50).tolist() == near([7.4, 14.8])
    assert said(pocket, "side finishing 1 of 6, down")[0].end[0] - 50 == near(12.8)
    assert said(pocket, "side finishing 1 of 6")[3].end[0] - 50 == near(15)
    assert pocket[-1].end.tolist() == [50, 50, 50]
    over = slots[[name.endswith("over the start") for name in names(slots)]]
    assert over.end[:, :2].tolist() == [near([74.7487, 74.7487]), near([25.2513, 25.2513])]
    ramps = said(slots, "layer 1 of 4, entry ramp")
    assert len(ramps) == 4 and abs(ramps.sweep * 35).tolist() == pytest.approx([54.978] * 4, abs=1e-3)
    from_centre = np.hypot(*(said(slots, "side finishing").end[:, :2] - 50).T)
    assert from_centre.max() + 3 == pytest.approx(39, abs=0.03) and layers(slots)[0] == [-5, -10, -15, -19.9]
    assert found.toolpath[-1].end.tolist() == near([50, 50, 250]) and slots[-1].end.tolist() == near([50, 50, 50])


# --- what is done, and in which order --------------------------------------------------------------------------------


@pytest.mark.parametrize("number", PROGRAMS)
@pytest.mark.parametrize(
    ("operation", "side", "floor", "parts"),
    [
        (0, 0.2, 0.1, ["layer", "side finishing", "floor finishing"]), (0, 0, 0, ["layer"]),
        (0, 0.2, 0, ["layer", "side finishing"]), (0, 0, 0.1, ["layer", "floor finishing"]),
        (1, 0.2, 0.1, ["layer"]), (2, 0.2, 0.1, ["side finishing", "floor finishing"]),
        (2, 0.2, 0, ["side finishing"]), (2, 0, 0.1, ["floor finishing"]),
    ],
)  # fmt: skip
def test_what_is_done(number, operation, side, floor, parts):
    """Side and floor are finished where an allowance was left for it; always in this order."""
    rows = milled(number, 5, Q215=operation, Q368=side, Q369=floor)
    found = [part for name in names(rows) for part in ("layer", "side finishing", "floor finishing") if part in name]
    assert list(dict.fromkeys(found)) == parts
    deepest = rows.end[:, 2].min()
    assert deepest == near(-20 if "floor finishing" in parts or not floor else -20 + floor)


@pytest.mark.parametrize("number", PROGRAMS)
def test_only_finishing_without_allowances_does_nothing_and_says_so(number):
    program = PROGRAMS[number].replace("Q215=0", "Q215=2").replace("Q368=0.2", "Q368=0")
    program = program.replace("Q369=0.1", "Q369=0").replace("Q369=0,1", "Q369=0")
    found = mnclab.run(f"TOOL CALL 1 Z S1000\n{program}\n", "tnc-620")
    assert found.ok and "finishes nothing" in found.alarms[-1].message
    assert not any(name.startswith("CYCL DEF") for name in found.toolpath.labels)


@pytest.mark.parametrize("number", PROGRAMS)
def test_depth_zero_is_not_executed_whatever_else_is_wrong(number):
    rows = milled(number, 5, Q201=0, Q202=0, Q207=0)
    assert len(rows) == 0


@pytest.mark.parametrize("number", PROGRAMS)
def test_finishing_alone_goes_at_rapid_to_the_clearance_above_its_first_level(number):
    """Rapid down to Q203 - Q338 + Q200 = -3: the collision that the manual warns of."""
    rows = milled(number, 5, Q215=2)
    down = rows[(rows.kind == Kind.RAPID) & (rows.end[:, 2] < rows.start[:, 2])]
    assert down.end[:2, 2].tolist() == near([2, -3])


@pytest.mark.parametrize(("height", "ways"), [(100.0, [(100, 2)]), (10.0, [(10, 50), (50, 2)])])
def test_the_way_to_the_pocket(height, ways):
    """Up to the second set-up plane only from below it; then over the centre, down to the set-up plane."""
    rows = milled("251", 5, height=height, Q367=1)
    rapid = [row for row in rows[:4] if row.kind == Kind.RAPID and row.start[2] != row.end[2]]
    assert [(row.start[2], row.end[2]) for row in rapid] == ways
    over = said(rows, "over the start")[0]
    assert over.end.tolist() == [90, 80, max(height, 50)]


def test_the_second_set_up_clearance_counts_if_it_is_the_greater_one():
    assert milled("251", 5, Q204=1)[-1].end[2] == 2


def test_infeeds_are_never_deeper_than_the_edges():
    """LCUTS = 2 for Q202 = 5: ten infeeds of 2, the last one smaller."""
    rows = milled("252", 5, cutting_length=2)
    assert layers(rows)[0] == near([*np.arange(-2, -19, -2.0), -19.9])
    assert layers(milled("252", 5, cutting_length=25))[0] == LEVELS
    assert layers(milled("252", 5, cutting_length=25, Q202=99999))[0] == [-19.9]


def test_finishing_in_one_infeed():
    assert layers(milled("253", 5, Q338=0)) == (LEVELS, [-19.9])


def test_roughing_alone_leaves_a_circular_pocket_by_its_wall():
    """6.3 step 6: off the wall, at rapid to the second set-up clearance, and then to the centre."""
    rows = milled("252", 10, Q215=1)
    assert rows[-2].end[2] == 50 and rows[-2].end[:2].tolist() != [50, 50] and rows[-1].end.tolist() == [50, 50, 50]


@pytest.mark.parametrize("number", PROGRAMS)
@pytest.mark.parametrize(("mode", "sense"), [(1, 1), (0, 1), (-1, -1)])
def test_climb_is_counter_clockwise_inside(number, mode, sense):
    wall = said(milled(number, 4, Q351=mode), "side finishing 1 of 4")
    around = wall[["wall" not in name and "down" not in name and "4, over" not in name for name in names(wall)]]
    around = around[around.kind != Kind.RAPID]
    area = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(around.start - 50, around.end - 50))
    assert np.sign(area or around.sweep.sum()) == sense


def test_a_positive_depth_works_upwards_where_it_is_allowed():
    """The set-up plane lies below: Q203 - Q200 = -2, the levels above, the end in the second set-up plane."""
    for number in PROGRAMS:
        rows = milled(number, 5, {"depth_error": False}, Q201=20)
        assert layers(rows) == ([5, 10, 15, 19.9], [5, 10, 15, 19.9]) and levels(said(rows, "floor")) == [20]
        assert said(rows, "to the set-up clearance").end[:, 2].tolist() == [-2]
        assert rows[-1].end[2] == 50


# --- the way down ----------------------------------------------------------------------------------------------------


def test_vertical_plunges():
    for number, angle in (("251", 3), ("252", 0), ("252", 90), ("253", 3), ("254", 3)):
        rows = milled(number, 5, Q366=0, plunge_angle=angle)
        down = rows[(rows.kind != Kind.RAPID) & (rows.end[:, 2] < rows.start[:, 2])]
        down = down[["floor" not in name for name in names(down)]]
        assert (down.start[:, :2] == down.end[:, :2]).all() and (down.feed == 150).all()
        same = milled(number, 5, Q366=1, plunge_angle=90)  # straight down as well
        assert np.array_equal(same.end, rows.end)


def test_a_rectangular_pocket_swings_along_its_first_side():
    """R = 5: 5 / tan 3° = 95.4 is more than the 69.6 there is: two strokes of 2.5; at 30° the least length, 20, counts."""
    swing = said(milled("251", 5, Q366=2), "layer 1 of 4, entry ramp")
    assert swing.end[:4, 0].tolist() == near([15.2, 84.8, 15.2, 84.8])
    assert swing.end[:4, 2].tolist() == near([0, -2.5, -5, -5])  # from one end on, and back at the level
    swing = said(milled("251", 5, Q366=2, plunge_angle=30), "layer 1 of 4, entry ramp")
    assert (swing.end[:, 0].max(), swing.end[:, 0].min()) == near((60, 40)) and swing.end[1:3, 2].tolist() == near(
        [-5, -5]
    )
    high = milled("251", 5, Q366=2, Q218=60, Q219=80)  # along the first side, though it is the shorter one
    assert (said(high, "layer 1 of 4, entry ramp").end[:, 1] == 50).all()


@pytest.mark.parametrize(("number", "address", "narrow"), [("251", "Q219", 19), ("252", "Q223", 19)])
def test_a_narrow_helix_without_its_monitoring(number, address, narrow):
    """suppressPlungeErr: the helix has the radius of the room, 9.5 - 0.2 - 5 = 4.3; without room the way is straight."""
    rows = milled(number, 5, {"plunge_error": False}, **{address: narrow})
    helix = said(rows, "layer 1 of 4, entry helix")[0]
    assert np.hypot(*(helix.end - helix.centre)[:2]) == near(4.3)
    rows = milled(number, 5, {"plunge_error": False}, **{address: 10.4})
    assert not len(said(rows, "helix")) and layers(rows)[1] == LEVELS


def test_an_odd_number_of_strokes_is_followed_by_the_line_backwards():
    """ANGLE = 5: 57 mm of 68 are enough for one stroke; the line is cleared on the way back, the ring begins on the left."""
    rows = milled("253", 5, plunge_angle=5)
    ramp, line = said(rows, "layer 1 of 4, entry ramp")[-1], said(rows, "layer 1 of 4, centre line")[0]
    assert ramp.end.tolist() == near([84, 50, -5]) and line.end.tolist() == near([16, 50, -5])
    assert said(rows, "layer 1 of 4, link")[0].end.tolist() == near([15.2, 50, -5])


@pytest.mark.parametrize("number", ["251", "252"])
def test_the_floor_is_touched_tangentially(number):
    """A quarter circle of radius Q369 in the vertical plane along X: the chords are sixteen."""
    rows = said(milled(number, 5, Q369=2), "floor finishing, entry arc")
    rows = rows[rows.end[:, 2] < rows.start[:, 2]]
    arms = rows.end[:, [0, 2]] - (50, -18)
    assert np.hypot(*arms.T) == near(2) and rows[-1].end.tolist() == near([50, 50, -20])
    x, _, z = rows[-1].end - rows[-1].start
    assert math.degrees(math.atan2(-z, x)) == near(90 / 32)


# --- feeds at the cutting edge ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(("reference", "where"), [(0, ""), (1, "side"), (2, "side floor"), (3, "layer side floor")])
def test_feeds_at_the_cutting_edge(reference, where):
    """A circle of radius r: F·r / (r + R) where Q439 says so, F elsewhere."""
    rows = milled("252", 5, Q439=reference, Q385=700)
    for part, feed in (("layer", 500), ("side", 700), ("floor", 700)):
        circles = said(rows, f"{part} ", "")
        circles = circles[circles.sweep == math.tau]
        circles = circles[[("entry" not in name) for name in names(circles)]]
        radius = np.hypot(*(circles.end - circles.centre)[:, :2].T)
        assert circles.feed == near(feed * radius / (radius + 5) if part in where else np.full(len(radius), feed))


def test_the_inner_wall_of_a_circular_slot_is_gone_round_faster():
    """e = 1, R = 5: the outer wall 500·41/46, the inner one 500·39/34, the ends 500·1/6."""
    wall = said(milled("254", 5, Q439=1), "side finishing 1 of 4")
    around = wall[[name.endswith("side finishing 1 of 4") for name in names(wall)]]
    radius = np.hypot(*(around.end - around.centre)[:, :2].T).round(6)
    feeds = {41.0: 500 * 41 / 46, 39.0: 500 * 39 / 34, 1.0: 500 / 6}
    assert around.feed == near([feeds[r] for r in radius]) and set(radius) == set(feeds)


def test_corners_of_a_rectangular_pocket_are_gone_round_slower():
    """Q220 = 8, R = 5: corners of radius 3 at 500·3/8, sides at 500."""
    wall = said(milled("251", 5, Q439=1, Q220=8), "side finishing 1 of 4")
    around = wall[[name.endswith("side finishing 1 of 4") for name in names(wall)]]
    assert (
        around.feed == near(np.where(around.kind == Kind.ARC, 500 * 3 / 8, 500))
        and (around.kind == Kind.ARC).sum() == 4
    )


# --- odd figures -----------------------------------------------------------------------------------------------------


def test_a_slot_all_the_way_round():
    """Q248 = 360: the ring between the radii 34 and 46."""
    rows = milled("254", 5, Q248=360)
    reach = np.hypot(*(said(rows, "side finishing 1 of 4").end[:, :2] - 50).T)
    assert reach.max() == near(41) and reach.min() == near(39)
    assert abs(said(rows, "layer 1 of 4, entry ramp")[0].sweep) == near(math.tau)


@pytest.mark.parametrize(("number", "change"), [("253", {"Q218": 12}), ("254", {"Q248": 0})])
def test_a_slot_without_length_is_a_round_pocket(number, change):
    rows = milled(number, 5, Q366=0, **change)
    wall = said(rows, "side finishing 1 of 4")
    around = wall[wall.sweep == math.tau]
    assert len(around) == 1 and np.hypot(*(around.end - around.centre)[0, :2]) == near(1)


def test_a_pocket_is_milled_in_turned_coordinates():
    text = f"1 CYCL DEF 10.0 R\n2 CYCL DEF 10.1 ROT+90\n{PROGRAMS['251']}"
    found = mnclab.run(f"TOOL CALL 1 Z S1000\n{text}\n", "tnc-620")
    assert found.ok and found.toolpath[-1].end.tolist() == near([-50, 50, 50])
    wall = said(found.toolpath, "side finishing 4 of 4").end
    assert np.ptp(wall, axis=0)[:2].tolist() == near([50, 70])
