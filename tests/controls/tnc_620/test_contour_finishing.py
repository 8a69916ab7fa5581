"""Cycles 23 and 24: their levels, feeds, sense and arcs, the check of the tool, and the part that they leave."""

import math

import numpy as np
import pytest
from shapely import LineString, Point, Polygon, union_all

import mnclab
from mnclab import Kind, Setup, Tool

#: 80 x 60 from 10 to 90 and 20 to 80, and an island of radius 10 in its middle.
LABELS = """LBL 1
L X+10 Y+20 RR
L Y+80
L X+90
L Y+20
L X+10
LBL 0
LBL 2
CC X+50 Y+50
L X+40 Y+50 RL
C X+40 Y+50 DR-
LBL 0
"""
DATA = dict(Q1=-10, Q2=1, Q3=0.5, Q4=0.2, Q5=0, Q6=2, Q7=50, Q8=0, Q9=1)
ROUGH = dict(Q10=5, Q11=100, Q12=350, Q19=0, Q208=9999)
TOOLS = {1: Tool(radius=5, name="ROUGH"), 2: Tool(radius=4, name="FINE"), 3: Tool(radius=5.5)}


def block(code, values):
    return f"CYCL DEF {code}\n" + "".join(f"{k}={v if isinstance(v, str) else format(v, '+g')}\n" for k, v in values.items())


def program(*parts, labels="1/2", data=None, head="TOOL CALL 1 Z S2000\nL X+0 Y+0 Z+100 R0 FMAX M3\n", contour=LABELS):
    made = f"CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL {labels}\n{block('20 DATA', DATA | (data or {}))}"
    return f"{head}{made}{''.join(parts)}L Z+100 R0 FMAX M2\n{contour}"


def rough(**changed):
    return block("22 ROUGH-OUT", ROUGH | changed) + "CYCL CALL\n"


def floor(**changed):
    return block("23 FLOOR", dict(Q11=120, Q12=300, Q208=8000) | changed) + "CYCL CALL\n"


def side(**changed):
    return block("24 SIDE", dict(Q9=1, Q10=5, Q11=130, Q12=400, Q14=0) | changed) + "CYCL CALL\n"


def run(*parts, tools=None, **given):
    return mnclab.run(program(*parts, **given), "tnc-620", Setup(tools=tools or TOOLS))


def of_cycle(run, number):
    assert run.ok, run.alarms
    path = run.toolpath
    return path[np.array([path.labels[k].startswith(f"CYCL DEF {number} ") for k in path.label])]


def named(path, end):
    return path[np.array([path.labels[k].endswith(end) for k in path.label])]


def passes(path):
    """Rows of a contour itself."""
    return path[np.array([path.labels[k].split(", ")[-1].startswith("infeed") for k in path.label])]


def near(value):
    return pytest.approx(value, abs=1e-6)


def drawn():
    return Polygon([(10, 20), (90, 20), (90, 80), (10, 80)]) - Point(50, 50).buffer(10, 512)


def swept(path, level, radius):
    at = (np.abs(path.end[:, 2] - level) < 1e-9) & (np.abs(path.start[:, 2] - level) < 1e-9) & path.is_motion
    return union_all([LineString(path[k : k + 1].points(1e-4)[0][:, :2]).buffer(radius, 128) for k in np.flatnonzero(at)])


# --- 24 ---------------------------------------------------------------------------------------------------------------


def test_levels_feeds_and_walls():
    """Levels z = Q5 - min(k·Q10, |Q1|) on the island (a circle of 10 + R) and then on the wall, 70 x 50 for R = 5."""
    path = of_cycle(run(rough(), side()), 24)
    downs = named(path, "down")
    assert downs.end[:, 2] == near([-5, -9.92, -5, -9.92]) and set(downs.feed) == {130}
    rings = passes(path)
    assert set(rings.feed) == {400} and sorted(set(rings.end[:, 2])) == [-10, -5]
    circles, lines = rings[rings.kind == Kind.ARC], rings[rings.kind == Kind.LINE]
    assert len(circles) == 2 and np.abs(circles.sweep) == near([math.tau] * 2)
    assert np.hypot(*(circles.end - circles.centre)[:, :2].T) == near([15, 15])
    assert lines.bounds[:, :2] == near(np.array([[15, 25], [85, 75]]))
    assert path[path.kind == Kind.RAPID].end[:2, 2].tolist() == [50, 50]


def test_arcs_are_helices_on_the_last_infeed_alone():
    """h = min(Q6/25, last infeed) = 0.08; the radius is max(R/2, Q3 - Q14 + 0.5) = 2.5."""
    path = of_cycle(run(rough(), side()), 24)
    for end, sign in (("approach", -1), ("departure", 1)):
        arcs = named(path, end)
        assert arcs.kind.tolist() == [Kind.ARC] * 4 and np.abs(arcs.sweep) == near([math.pi / 2] * 4)
        assert (arcs.end - arcs.start)[:, 2] == near([0, sign * 0.08] * 2)
        assert np.hypot(*(arcs.end - arcs.centre)[:, :2].T) == near([2.5] * 4)
    wide = named(of_cycle(run(rough(), side(), data=dict(Q3=3)), 24), "approach")
    assert np.hypot(*(wide.end - wide.centre)[:, :2].T) == near([3.5] * 4)
    shallow = named(of_cycle(run(rough(), side(Q10=9.95), data=dict(Q6=10)), 24), "approach")
    assert (shallow.end - shallow.start)[:, 2] == near([0, -0.05] * 2)  # the last infeed is smaller than 10/25


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("frame", ["", "CYCL DEF 8.0 M\nCYCL DEF 8.1 X\n", "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+30\n"])
def test_walls_are_climbed_or_cut_up_under_every_frame(sense, frame):
    """Climb: the wall counter-clockwise, the island clockwise, as the machine sees it; a mirror image changes nothing (8.3)."""
    path = passes(of_cycle(run(rough(), frame, side(Q9=sense)), 24))
    arcs, lines = path[path.kind == Kind.ARC], path[path.kind == Kind.LINE]
    assert (np.sign(arcs.sweep * arcs.axis[:, 2]) == -sense).all()
    lines = lines[lines.end[:, 2] == -5]
    ring = Polygon(lines.end[:, :2])
    assert ring.exterior.is_ccw == (sense > 0) and ring.area == near(70 * 50)


def test_the_allowance_of_24_stays():
    """Q14 = 0.2: the island gets the radius 10 + 0.2 + R; corners of the tool path are rounded by Q8 = 2."""
    path = passes(of_cycle(run(rough(), side(Q14=0.2), data=dict(Q8=2)), 24))
    radii = np.hypot(*(path.end - path.centre)[path.kind == Kind.ARC, :2].T)
    assert sorted(set(np.round(radii, 6))) == [2, 15.2]


def test_the_tool_goes_on_at_the_set_up_clearance_and_ends_where_it_was():
    path = of_cycle(run(rough(), side()), 24)
    rapids = path[path.kind == Kind.RAPID]
    assert rapids.end[:, 2].tolist() == [50, 50, 2, 2, 2, 50, 100, 100] and rapids.end[-1, :2].tolist() == [0, 0]
    setup = Setup(tools=TOOLS, settings={"position_after_contour": "height"})
    stays = mnclab.run(program(rough(), side()), "tnc-620", setup)
    assert of_cycle(stays, 24).end[-1, 2] == 50 and of_cycle(stays, 24).end[-1, 0] > 1


CONTOUR_MILLING = dict(labels="2", data=dict(Q3=6))


def test_contour_milling_round_an_island_alone():
    """8.8: no pocket, Q3 = 6 greater than Q14 + R = 5, no roughing: clockwise in climb on a circle of 15, from arcs of 6.5."""
    path = of_cycle(run(side(Q438=0), **CONTOUR_MILLING), 24)
    (first, second), arcs = passes(path), named(path, "approach")
    assert first.sweep == second.sweep == near(-math.tau) and math.dist(first.end[:2], (50, 50)) == near(15)
    assert np.hypot(*(arcs.end - arcs.centre)[:, :2].T) == near([6.5, 6.5])
    assert (np.hypot(*(path.end - (50, 50, 0))[path.end[:, 2] < 0, :2].T) > 15 - 1e-6).all()


def test_other_cycles_want_a_pocket():
    for cycle in (rough(), floor()):
        (alarm,) = run(cycle, **CONTOUR_MILLING).alarms
        assert alarm.message == "the contour has no pocket"


#: The check of the catalogue, with its numbers: Q3, R of rough-out, Q14, R, Q438 -> allowed or not; d) is c) without Q3.
CHECK = {"a": (0.5, 6, 0, 6, -1, True), "b": (0, 6, 0, 6, -1, False), "c": (6.5, 0, 0, 6, 0, True), "d": (0.5, 0, 0, 6, 0, False)}


@pytest.mark.parametrize("case", CHECK)
def test_the_sum_rule_of_allowances_and_radii(case):
    allowance, roughing, q14, radius, q438, allowed = CHECK[case]
    tools = {1: Tool(radius=roughing or radius), 2: Tool(radius=radius)}
    parts = ([rough()] if roughing else []) + ["TOOL CALL 2 Z S2000\n", side(Q14=q14, Q438=q438)]
    made = run(*parts, tools=tools, data=dict(Q3=allowance))
    assert made.ok == allowed
    if not allowed:
        found = f"Q14 + R = {q14 + radius:g} must be less than Q3 + R = {allowance + roughing:g} of the rough-out tool"
        assert made.alarms[0].message == f"CYCL DEF 24 cannot finish the side, the tool radius is too large: {found}"


@pytest.mark.parametrize(
    ("named", "radius"), [("Q438=-1", 5), ("", 5), ("Q438=2", 4), ('QS438="fine"', 4), ("Q438=3", 5.5), ("Q438=0", 0)]
)
def test_the_rough_out_tool(named, radius):
    """-1 is that of the last 22, though others came after it; a number or a name is a row of the table; 0 is none."""
    cycle = side().replace("CYCL CALL", f"{named}\nCYCL CALL" if named else "CYCL CALL")
    made = run(rough(), "TOOL CALL 2 Z S9\nTOOL CALL 3 Z S2000 DR+2\n", cycle)  # R = 7.5 never fits the rule: it tells both
    assert f"must be less than Q3 + R = {0.5 + radius:g} of the rough-out tool" in made.alarms[0].message


def test_the_rough_out_tool_may_be_named_by_a_text_parameter():
    """R = 5.5 of tool 3 allows what the 5 of ROUGH do not: Q14 + R = 5.7 < Q3 + R = 6."""
    tools = TOOLS | {3: Tool(radius=5.5, name="COARSE")}
    for name, fits in (("COARSE", True), ("ROUGH", False)):
        made = run(f'9 QS9 = "{name}"\n', side(Q14=0.7, QS438="QS9"), tools=tools)
        assert made.ok == fits, made.alarms


def test_without_22_the_tool_before_counts():
    """The tool before TOOL CALL 3 is number 1 with the DR of its call."""
    made = run("TOOL CALL 1 Z S9 DR+1\nTOOL CALL 3 Z S2000 DR+2\n", side())
    assert "must be less than Q3 + R = 6.5 of the rough-out tool" in made.alarms[0].message


def test_an_allowance_that_leaves_nothing_to_finish_is_said():
    """A smaller tool than the rough-out one keeps the sum rule: 4 + 0.6 < 5 + 0.5."""
    made = run(rough(), "TOOL CALL 2 Z S2000\n", side(Q14=0.6))
    (warning,) = made.alarms
    assert warning.severity == "warning" and made.ok
    assert warning.message == "CYCL DEF 24 Q14=0.6 is not less than Q3=0.5: what the rough-out tool reached is not finished"


def test_a_neck_without_room_for_an_arc_is_said():
    """A slot 10.4 wide leaves 0.4 for the centre of R = 5, the arcs need Q3 - Q14 = 0.5: straight from 0.2 off the wall."""
    slot = "LBL 1\nL X+0 Y+0 RL\nL X+60\nL Y+10.4\nL X+0\nL Y+0\nLBL 0\n"
    made = run(side(Q438=3), labels="1", contour=slot)
    (warning,) = made.alarms
    assert warning.message == "CYCL DEF 24 has no room for an arc to the wall at X30.000 Y5.000: the tool comes straight to it"
    path = of_cycle(made, 24)
    assert len(path[path.kind == Kind.ARC]) == 0
    assert named(path, "down").end[:, 1] == pytest.approx([5.2, 5.2], abs=0.06)
    assert (swept(path, -10, 5) - Polygon([(0, 0), (60, 0), (60, 10.4), (0, 10.4)]).buffer(1e-4)).area < 1e-6


# --- 23 ---------------------------------------------------------------------------------------------------------------


def test_the_floor_is_cleared_once_up_to_the_allowance_for_side():
    """z = Q5 + Q1 alone; plunge Q11, rings Q12, retraction Q208; the area inset by Q3 + R, swept by R."""
    path = of_cycle(run(rough(), floor()), 23)
    assert path.end[:, 2].min() == -10 and set(path[path.kind == Kind.LINE].feed) == {120, 300, 8000}
    cut, room = swept(path, -10, 5), drawn().buffer(-5.5, 128)
    assert room.buffer(5, 128).symmetric_difference(cut).area < 0.2  # polygons of 512 corners
    assert (cut - drawn().buffer(-0.5 + 1e-3, 128)).area < 1e-2
    assert path[path.feed == 8000].end[:, 2].tolist() == [50]


def test_the_arc_to_the_floor():
    """A quarter circle of ZX with the radius Q4 + 1 = 1.2 at Q11, level at the floor; with R = 1 the radius is 1."""
    for tool, radius in (({1: Tool(radius=5)}, 1.2), ({1: Tool(radius=1)}, 1)):
        (arc, *_) = named(of_cycle(run(floor(), tools=tool), 23), "approach")
        assert arc.kind == Kind.ARC and abs(arc.sweep) == near(math.pi / 2) and abs(arc.axis[1]) == near(1)
        assert np.abs(arc.end - arc.start) == near([radius, 0, radius]) and arc.end[2] == -10
        assert arc.centre == near([arc.end[0], arc.end[1], -10 + radius]) and arc.feed == 120


def test_under_another_scale_of_z_the_way_to_the_floor_is_straight():
    """The arc would be an ellipse. Under one scale its radius is Q4·2 and 1 mm of the machine."""
    scaled = "CYCL DEF 26.0 S\nCYCL DEF 26.1 X2 Y2 Z1\n"
    assert len(named(of_cycle(run(scaled, floor()), 23), "approach")) == 0
    even = named(of_cycle(run("CYCL DEF 11.0 S\nCYCL DEF 11.1 SCL 2\n", floor()), 23), "approach")
    assert len(even) and np.hypot(*(even.end - even.centre)[:, [0, 2]].T) == near([1.4] * len(even))


def test_q208_of_0_is_the_feed_for_milling_and_without_it_is_rapid():
    assert named(of_cycle(run(floor(Q208=0)), 23), "retract").feed.tolist() == [300]
    without = block("23 FLOOR", dict(Q11=120, Q12=300)) + "CYCL CALL\n"
    assert named(of_cycle(run(without), 23), "retract").feed.tolist() == [math.inf]


def test_a_depth_of_0_is_finished_at_the_surface():
    made = run(floor(), side(Q438=3), data=dict(Q1=0, Q4=0))
    for number, feed in ((23, 300), (24, 400)):
        path = of_cycle(made, number)
        assert set(path[path.feed == feed].end[:, 2]) == {0}
        assert path.end[:, 2].min() == 0  # the ways to the floor and to the walls come from above


# --- both, and the part -------------------------------------------------------------------------------------------------

BLANK = "BLK FORM 0.1 Z X+0 Y+0 Z-20\nBLK FORM 0.2 X+100 Y+100 Z+0\n"


@pytest.mark.deep
def test_the_part_is_the_drawing():
    """After 22, 23 and 24 nothing stands of pocket less island but the corners of R = 5, (4 - π)·25 mm²; nothing collides."""
    made = run(rough(), floor(), side(), head=f"{BLANK}TOOL CALL 1 Z S2000\nL X+0 Y+0 Z+100 R0 FMAX M3\n")
    assert made.ok and not made.collisions()
    part = made.workpiece()
    expected = drawn().area - (4 - math.pi) * 25
    outline, wall, island = sorted(part.cut("XY", -9.5), key=lambda each: -abs(each.area))
    assert outline.area - abs(wall.area) + island.area == pytest.approx(10000 - expected, abs=0.5)
    assert abs(wall.bounds - [[10, 20], [90, 80]]).max() < 0.01 and abs(island.bounds - [[40, 40], [60, 60]]).max() < 0.01
    x, y = np.meshgrid(np.arange(16, 85, 4.0), np.arange(26, 75, 4.0))
    away = np.hypot(x - 50, y - 50) > 10.5
    assert part.at(x[away], y[away]) == near(np.full(away.sum(), -10.0))
    assert part.removed == pytest.approx(10 * expected, rel=2e-3)


def test_without_23_the_allowance_for_the_floor_stays():
    """But where 24 comes, which goes down to the floor: not at (30, 40), 20 from the wall and 22.4 from the island's middle."""
    made = run(rough(), side(), head=f"{BLANK}TOOL CALL 1 Z S2000\nL X+0 Y+0 Z+100 R0 FMAX M3\n")
    assert made.workpiece(step=1).at([30, 30], [40, 29]) == near([-9.8, -10])
