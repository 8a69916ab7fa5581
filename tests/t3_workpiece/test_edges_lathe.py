"""Cuts deeper than an edge is long, on both lathes: found at their line, as deep as the closed form of each test says.

Along an edge at the angle a to the axis a cut of the depth d (on the radius) is d / sin(a) long. An edge is 12 mm long where
the table gives no `cutting_length`, a blade reaches 8 times its width.
"""

import random
from math import cos, radians, sin, tan

import pytest

import mnclab
from mnclab import Setup, Tool
from mnclab.workpiece.blank import cylinder

BAR = cylinder(60, -100, 0)
HEAD = "M3 S500 G97 G94 F100 T1\nG00 X70 Z80\n"  # lines 1 and 2
EDGE, WIDTHS = 12.0, 8.0
TURNING = Tool(kind="turning", main_angle=90, auxiliary_angle=10)


def met(text, tool=TURNING, stock=BAR, head=HEAD, control="jnc-t01", tools=None):
    setup = Setup(stock=stock, start=(90, 0, 60), tools=tools or {0: tool, 1: tool}, settings={"lint": "off"})
    run = mnclab.run(head + text.replace("|", "\n") + "\n", control, setup)
    assert run.ok, run.alarms
    return run.collisions()


def only(found, line, deep, long=EDGE):
    """One collision, at a line, of a cut so deep along an edge that is so long."""
    (each,) = found
    assert (each.kind, each.line) == ("insert", line), each
    assert each.depth == pytest.approx(deep - long, abs=2e-3)
    figures = [float(word) for word in each.message.split() if word.replace(".", "").isdigit()]
    assert figures[:2] == pytest.approx([deep, long], abs=2e-3)
    return each


# --- the edge of an insert -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("tool", [None, Tool(kind="turning"), Tool(kind="turning", corner=0.8, main_angle=95, auxiliary_angle=5)])
def test_a_face_cannot_be_cut_away_in_one_pass(tool):
    """A bar of radius 60, straight into its middle; the insert of the magazine, and usual ones."""
    setup = Setup(stock=BAR, start=(90, 0, 60), tools={1: tool} if isinstance(tool, Tool) else None)
    run = mnclab.run("M3 S500 G97 G94 F100 T1\nG00 X0 Z2\nG01 Z-20\nG00 Z5\n", "jnc-t01", setup)
    (each,) = run.collisions()
    assert (each.kind, each.line) == ("insert", 3) and 48 - 1e-3 < each.depth < 60 / sin(radians(95)) + 0.08 - 12  # of a nose
    assert each.place[0] == pytest.approx(60) and "its table gives no cutting length" in each.message


@pytest.mark.parametrize("deep", [4, 11.9, 12.1, 15, 42, 60])
def test_the_nc_31_judges_as_the_jnc(deep):
    """Diameters in hundredths."""
    text = f"F20\nX{round(200 * (60 - deep))}~*\nZ200~\nZ-2000\n"
    found = met(text, head="S500\nM3\n", control="nc-31")
    if deep > EDGE:
        assert "X is a diameter" in only(found, 6, deep).message
    else:
        assert not found


@pytest.mark.parametrize("main", [30, 45, 75, 90, 95, 100])
@pytest.mark.parametrize("long", [0, 5, 9])
@pytest.mark.parametrize("hand", ["right", "left"])
@pytest.mark.parametrize("kind", ["turning", "boring"])
def test_just_below_the_edge_none_and_just_above_one(main, long, hand, kind):
    """Outside and inside, towards the chuck and away from it."""
    tool = Tool(kind=kind, main_angle=main, auxiliary_angle=8, cutting_length=long, hand=hand)
    edge = long or EDGE
    z, end = (40, -30) if hand == "right" else (-150, -70)
    for off in (-0.1, 0.05, 0.5, 4):
        deep = edge * sin(radians(main)) + off
        x, away = (60 - deep, 70) if kind == "turning" else (20 + deep, 19)
        stock = BAR if kind == "turning" else cylinder(60, -100, 0, bore=20)
        way = f"G00 X{away} Z80|Z{z}|X{x:.6f}|G01 Z{end}|X{away}|G00 Z{z}"
        found = met(way, tool, stock)
        if off < 0:
            assert not found, found
        else:
            only([each for each in found if each.line == 6], 6, deep / sin(radians(main)), edge)  # the way out may meet a wedge


def test_in_passes_a_bar_is_turned_down_and_a_bore_turned_out():
    assert not met("G00 X62 Z2|G77 X10 Z-60 U10 W-60 D4", TURNING)
    assert not met("G00 X62 Z2|G77 X0 Z-60 U60 W-60 D11.9", TURNING)
    bored = Tool(kind="boring", main_angle=95, auxiliary_angle=10)
    assert not met("G00 X9 Z2|G77 X50 Z-60 U50 W-60 D4", bored, cylinder(60, -100, 0, bore=10))


@pytest.mark.parametrize("control", ["jnc-t01", "nc-31"])
@pytest.mark.parametrize("infeed", [0.5, 2, 5])
def test_facing_is_as_deep_as_its_infeed_however_thick_the_bar(control, infeed):
    nc_31 = f"F20\nX14000~\nZ{round(-100 * infeed)}~\nX0\nZ2000~\n"
    jnc = f"G00 X62 Z{-infeed}|G01 X-1|G00 Z20"
    if control == "jnc-t01":
        assert not met(jnc)
    else:
        assert not met(nc_31, head="S500\nM3\n", control=control)


@pytest.mark.parametrize("infeed", [8, 11.5, 12.1, 14, 17, 25])
def test_facing_deeper_than_the_other_edge_is_long(infeed):
    """Its depth lies along Z: infeed / cos(5)."""
    tool = Tool(kind="turning", main_angle=95, auxiliary_angle=5)
    found = met(f"G00 X62 Z{-infeed}|G01 X0|G00 Z20", tool)
    assert [(each.kind, each.line) for each in found] == [("insert", 4)] * (infeed / cos(radians(5)) > EDGE)
    if 12 < infeed < 18:  # beyond, where the insert ends, its back is told
        only(found, 4, infeed / cos(radians(5)))


def test_a_slope_is_as_deep_as_what_stands_above_the_tip():
    """A cone of 45 degrees out of a full bar: 12.5 mm, first met at its beginning, though the insert comes up there later."""
    only(met("G00 X47.5 Z1|G01 Z0|X62 Z-14.5", TURNING), 5, 12.5)
    assert not met("G00 X48.1 Z1|G01 Z0|X62 Z-13.9", TURNING)
    assert [each.line for each in met("G00 X40 Z1|G01 Z0|X62 Z-22", TURNING)] == [5]


def test_an_arc_is_judged_as_a_line():
    assert [each.line for each in met("G00 X40 Z1|G01 Z0|G03 X60 Z-20 R20|G01 X62", TURNING)] == [5]
    assert not met("G00 X50 Z1|G01 Z0|G03 X60 Z-10 R10|G01 X62", TURNING)


# --- what is thinner than the relief ---------------------------------------------------------------------------------

ROUGHED = "G00 X62 Z2|G77 X20 Z-40 U20 W-40 D5|"  # a wall 40 mm high; lines 3 and 4


def test_stock_on_a_high_wall_is_taken_on_the_way_out():
    assert not met(ROUGHED + "G00 X20 Z-38|G01 Z-40.3|X62|G00 Z20", TURNING)


def test_stock_on_a_high_wall_that_no_edge_takes_is_told():
    """The main edge stands square to the axis: it would need all of 40 mm to take the wall at once."""
    only(met(ROUGHED + "G00 X20 Z-38|G01 Z-40.3|G00 Z20", TURNING), 6, 40)


def test_a_face_in_small_steps_is_found_when_the_relief_is_used_up():
    text = "G00 X0 Z1|G01 Z0|" + "|".join(f"Z-{0.4 * k:.1f}" for k in range(1, 6))
    found = met(text, TURNING)
    assert found[0].line == 7  # after 1.2 mm, more than the relief
    assert [each.depth for each in found] == pytest.approx([60 - EDGE] * len(found))
    assert not met("G00 X0 Z1|G01 Z-0.4|Z-0.8|G00 Z5|X62|Z-0.8|G01 X-1", TURNING)  # faced afterwards


def test_a_stopped_program_is_not_blamed_for_what_it_had_not_cut_yet():
    setup = Setup(stock=BAR, start=(90, 0, 60), tools={1: TURNING})
    run = mnclab.run(HEAD + "G00 X0 Z1\nG01 Z-0.5\nG99999\nG01 X62\n", "jnc-t01", setup)
    assert run.collisions().reach and not len(run.collisions())


def test_tools_that_turn_about_their_axis_are_judged_as_before():
    assert not met("G00 X0 Z2|G01 Z-80|G00 Z20", Tool(kind="drill", radius=5, cutting_length=10))


# --- blades ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("width", [2, 3, 4])
@pytest.mark.parametrize("long", [0, 10])
@pytest.mark.parametrize("kind", ["grooving", "face grooving"])
def test_a_groove_is_no_deeper_than_its_blade_reaches(width, long, kind):
    tool, reach = Tool(kind=kind, width=width, cutting_length=long), long or WIDTHS * width
    for off in (-0.1, 0.1, 5):
        deep = reach + off
        way = f"G00 X62 Z-30|G01 X{60 - deep}|G00 X62" if kind == "grooving" else f"G00 X30 Z2|G01 Z-{deep}|G00 Z2"
        found = met(way, tool)
        if off < 0:
            assert not found
        else:
            assert "groove" in only(found, 4, deep, reach).message


def test_pecks_parting_and_a_wall_on_one_side_alone():
    blade = Tool(kind="grooving", width=3)
    assert {each.line for each in met("G00 X62 Z-30|G75 X30 Z-30 D4", blade)} == {4}
    assert not met("G00 X26 Z-30|G01 X-1|G00 X70", blade, cylinder(24, -100, 0))  # on the axis the piece falls
    only(met("G00 X28 Z-30|G01 X-1|G00 X70", blade, cylinder(26, -100, 0)), 4, 26, 24)
    assert not met("G00 X62 Z-2.5|G01 X20|G00 X62", blade)  # the face, nothing stands to its right


def test_a_blade_inside_a_bore():
    blade = Tool(kind="boring", width=3)
    stock = cylinder(60, -100, 0, bore=20)
    assert not met("G00 X18 Z2|Z-30|G01 X43.9|X18|Z2", blade, stock)
    only(met("G00 X18 Z2|Z-30|G01 X45|X18|Z2", blade, stock), 5, 25, 24)


# --- threads ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("tool", "long"), [
    (Tool(kind="thread", main_angle=60, auxiliary_angle=60, cutting_length=2), 2),
    (Tool(kind="thread", cutting_length=1.5), 1.5),
    (Tool(kind="thread"), 3),  # a sharp V of the pitch
])  # fmt: skip
def test_a_thread_is_no_deeper_than_the_flanks_of_its_insert(tool, long):
    """In passes: the crest counts, not what the pass before has left."""
    high = long * sin(radians(60))
    passes = [f"G00 X{60 - share * high:.5f}|G32 Z-20 F3|G00 X62|Z6" for share in (0.4, 0.7, 0.9, 0.99)]
    assert not met("G00 X62 Z6|" + "|".join(passes), tool)
    last = f"G00 X{60 - high - 0.1:.5f}|G32 Z-20 F3|G00 X62"
    only(met("G00 X62 Z6|" + "|".join([*passes, last]), tool), 21, long + 0.1 / sin(radians(60)), long)


def test_turning_before_a_thread_counts_for_its_crests():
    """Down to 58, then a thread 1.5 mm deep: 3.5 mm under the bar, and within a tooth of 1.73 mm."""
    tools = {1: TURNING, 4: Tool(kind="thread", cutting_length=2)}
    turned = "G00 X58 Z2|G01 Z-40|X62|G00 Z20|T4|G00 X62 Z6|X56.5|G32 Z-20 F2|G00 X62|Z6"
    assert not met(turned, tools=tools)
    again = "|T1|G00 X57.3 Z2|G01 Z-40|X62|G00 Z20|T4|G00 X62 Z6|X55.7|G32 Z-20 F2|G00 X62"  # crests turned off between
    assert not met(turned + again, tools=tools)
    assert [each.line for each in met(turned.replace("X56.5", "X55.5"), tools=tools)] == [10]


@pytest.mark.parametrize("seed", range(12))
def test_random_cuts_within_and_beyond_the_edge(seed):
    chance = random.Random(seed)
    radius, length, main = chance.uniform(20, 70), chance.uniform(4, 16), chance.uniform(40, 100)
    tool = Tool(kind="turning", main_angle=main, auxiliary_angle=chance.uniform(4, 60), cutting_length=length)
    most = length * sin(radians(main))
    for share in (chance.uniform(0.2, 0.99), chance.uniform(1.01, 1.2)):
        x = radius - share * most
        found = met(f"G00 X{x:.6f} Z20|G01 Z-{chance.uniform(5, 30):.3f}|X{radius + 2}", tool, cylinder(radius, -100, 0))
        if share < 1:
            assert not found
        else:
            only(found, 4, share * length, length)


def test_a_thread_on_a_cone_is_as_deep_as_it_stands_under_it():
    """A cone of 1 : 16 on the diameter, its thread 1 mm and 2 mm under it: the flanks are 1.73 mm high."""
    cone, tools = "G00 X50 Z2|G01 X52 Z-62|X62|G00 Z20|T4|", {1: Tool(kind="turning"), 4: Tool(kind="thread", cutting_length=2)}
    assert not met(cone + "G00 X49 Z2|G32 X50.625 Z-50 F2|G00 X62", tools=tools)
    (each,) = met(cone + "G00 X48 Z2|G32 X49.625 Z-50 F2|G00 X62", tools=tools)
    half = cos(radians(60))  # the tooth is as wide as its edge: the cone rises beside its tip
    assert each.line == 9 and each.depth + 2 == pytest.approx((2 + 2 * half / 32) / sin(radians(60)), abs=0.05)


@pytest.mark.parametrize("deep, lean, collides", [(3, 30, False), (8, 30, True), (11, 10, False), (11, 14, True)])
def test_a_rapid_through_a_thick_wedge_collides(deep, lean, collides):
    """An auxiliary edge of so many degrees leaves deep x tan(lean) on the wall of a facing cut: up to 2.5 mm are excused."""
    assert (deep * tan(radians(lean)) > 2.5) is collides
    tool = Tool(kind="turning", corner=0.4, main_angle=93, auxiliary_angle=lean, cutting_length=40)
    found = met(f"G00 X62 Z{-deep}|G01 X1|G00 Z5", tool, BAR)
    assert [each.kind for each in found] == ["rapid"] * collides
