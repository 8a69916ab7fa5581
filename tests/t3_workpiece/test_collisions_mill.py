"""What a mill must not meet, put into programs on purpose: found at its line and row, in its place, as deep as it is."""

from math import hypot

import numpy as np
import pytest
from tools.running import lines, run

import mnclab
from mnclab import Limits, Tool
from mnclab.workpiece.blank import cylinder
from mnclab.workpiece.collision import coordinates

STOCK = ((0, 0, -20), (100, 60, 0))
BEFORE = "N10 G17 G90 G54\nN20 T1 S2500 M3\n"  # lines 1 and 2 of every program
TOOLS = {
    "mill": Tool(5, kind="mill"),
    "ball": Tool(4, corner=4, kind="mill"),
    "bull": Tool(6, corner=1.5, kind="mill"),
    "drill": Tool(3, angle=118, kind="drill"),
    "small": Tool(0.05, kind="mill"),
}


def met(text: str, tool: Tool, kind: str | None = None, **given):
    """The collisions of a program of one tool, of one kind or all."""
    setup = {"tools": {1: tool}, "stock": STOCK} | given
    before = setup.pop("before", BEFORE)
    found = run(lines(text), "mnc", before=before, **setup).collisions()
    return [each for each in found if kind in (None, each.kind)]


def only(found, kind: str, line: int, depth: float, tolerance: float = 1e-6):
    """The one collision that there is."""
    (each,) = found
    assert (each.kind, each.line, each.program) == (kind, line, 0)
    assert each.depth == pytest.approx(depth, abs=tolerance)
    return each


# --- rapids ----------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", TOOLS)
@pytest.mark.parametrize("depth", [0.05, 2, 7.25])
def test_a_rapid_into_the_side_of_the_blank(name, depth):
    tool = TOOLS[name]
    each = only(met(f"G0 X-30 Y30.1 Z5|G0 Z-{depth}|G0 X50|G0 Z50", tool), "rapid", 5, depth)
    x, y, z = each.place
    assert -1e-9 <= x <= 50 + tool.radius and abs(y - 30.1) <= tool.radius and z == pytest.approx(-depth)


@pytest.mark.parametrize("name", TOOLS)
@pytest.mark.parametrize("place", [(10, 10), (50.13, 30.07), (99.9, 59.9)])
def test_a_rapid_straight_down(name, place):
    each = only(met(f"G0 X{place[0]} Y{place[1]} Z5|G0 Z-3|G1 X150 F100|G0 Z50", TOOLS[name], "rapid"), "rapid", 4, 3)
    assert each.place == pytest.approx((*place, -3))
    assert "at feed" in each.message


@pytest.mark.parametrize("wall", [0.2, 1, 12])
@pytest.mark.parametrize("depth", [1, 4])
def test_a_rapid_through_the_wall_between_two_slots(wall, depth):
    """Slots of 10 mm that end 5 mm beyond X30 and begin 5 mm before X(40 + wall)."""
    other = 40 + wall
    text = f"G0 X20 Y30 Z5|G1 Z-5 F100|G1 X30|G0 Z5|G0 X{other}|G1 Z-5|G1 X80|G0 Z-{depth}|G0 X20|G0 Z50"
    each = only(met(text, TOOLS["mill"]), "rapid", 11, depth)
    assert 30 <= each.place[0] <= 40 + wall and abs(each.place[1] - 30) <= 5  # the wall is concave on both sides


def test_a_rapid_that_falls_on_its_way():
    """From Z5 to Z-5 over 100 mm: the rim is deepest at the end."""
    each = only(met("G0 X-5 Y30 Z5|G0 X95 Z-5|G0 Z50", TOOLS["mill"]), "rapid", 4, 5, 1e-3)
    assert each.place[2] == pytest.approx(-5, abs=1e-3) and hypot(each.place[0] - 95, each.place[1] - 30) <= 5


def test_a_rapid_beside_a_finished_wall_and_over_a_finished_floor_meets_nothing():
    text = "G0 X20 Y30 Z5|G1 Z-5 F100|G1 X80|G0 X20|G0 Y30.009|G0 X80 Y30.009|G0 Z-5.009|G0 X20|G0 Z50"
    assert not met(text, TOOLS["mill"])
    deeper = text.replace("Z-5.009", "Z-5.05").replace("30.009", "30.05")
    assert [(each.kind, each.line) for each in met(deeper, TOOLS["mill"])] == [("rapid", k) for k in (7, 8, 9, 10)]


def test_a_rapid_that_collided_is_not_blamed_for_its_way_back():
    (each,) = met("G0 X50 Y30 Z5|G0 Z-3|G0 Z5|G0 Z-3|G0 Z5", TOOLS["mill"])
    assert each.line == 4


def test_the_first_approach_comes_from_home():
    """The machine starts at 0 0 0, which is a corner of the blank; where its rapid arrives counts."""
    assert not met("G0 X50 Y30|G0 Z5|G1 Z-3 F100|G0 Z50", TOOLS["mill"])
    only(met("G0 X50 Y30|G0 Z-3|G1 X80 F100|G0 Z50", TOOLS["mill"]), "rapid", 4, 3)


@pytest.mark.parametrize("before", ["G0 X-30 Y0 Z5", "G0 Y0|G0 X-30|G0 Z5", "G0 Z5|G0 X-30 Y0"])
def test_an_axis_that_is_named_is_where_the_program_says(before):
    """Y0 is where the machine starts, so that nothing moves; the way of the next rapid counts all the same."""
    found = met(f"{before}|G0 Z-3|G0 X150|G0 Z50", TOOLS["mill"])
    only(found, "rapid", 5 + before.count("|"), 3)


def test_no_deeper_than_the_blank_is_thick():
    each = only(met("G0 X50 Y30 Z5|G0 Z-300|G0 Z50", TOOLS["mill"]), "rapid", 4, 20)
    assert each.place[2] == -20


# --- plunges ---------------------------------------------------------------------------------------------------------

BLUNT = Tool(5, centre_cutting=False, kind="mill")


@pytest.mark.parametrize("place", [(10, 10), (50.13, 30.07), (99.9, 59.9), (0.2, 30), (77, 3)])
@pytest.mark.parametrize("depth", [0.1, 2, 8])
def test_a_plunge_with_a_tool_that_does_not_cut_at_its_centre(place, depth):
    each = only(met(f"G0 X{place[0]} Y{place[1]} Z5|G1 Z-{depth} F100|G1 X50 Y31|G0 Z50", BLUNT), "plunge", 4, depth)
    assert each.place == pytest.approx((*place, -depth))


def test_a_ramp_and_a_hole_that_was_there_are_no_plunge():
    ramp = "G0 X20 Y30 Z0|G1 X40 Z-1 F100|G1 X20|G1 Z-1|G0 Z50"
    assert not met(ramp, BLUNT)
    hole = "G0 X20 Y30 Z5|G1 Z-8 F100|G0 Z5|T2|G0 Z5|G1 Z-8|G0 Z50"
    two = {"tools": {1: Tool(1, kind="drill"), 2: BLUNT}}
    assert not met(hole, BLUNT, **two)
    assert [each.line for each in met(hole.replace("Z-8|G0 Z50", "Z-9|G0 Z50"), BLUNT, **two)] == [8]


@pytest.mark.parametrize("tool", [Tool(5, kind="mill"), Tool(5, kind="mill", centre_cutting=True),
                                  Tool(5, kind="drill", centre_cutting=False)])  # fmt: skip
def test_only_what_is_known_not_to_cut_at_its_centre_is_judged(tool):
    assert not met("G0 X20 Y30 Z5|G1 Z-2 F100|G0 Z50", tool)


# --- shank and holder ------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("edges", [1, 2.5, 6])
@pytest.mark.parametrize("more", [0.05, 1, 5])
def test_a_slot_deeper_than_the_edges_are_long(edges, more):
    """A slot from outside, whose floor is `more` lower than the edges reach up."""
    text = f"G0 X-20 Y30 Z5|G0 Z-{edges + more}|G1 X50 F100|G0 Z50"
    each = only(met(text, Tool(5, cutting_length=edges, kind="mill")), "shank", 5, more)
    assert each.place[2] == pytest.approx(-more)
    assert not met(text, Tool(5, cutting_length=edges + more, kind="mill"))


@pytest.mark.parametrize("kind", ["drill", "mill"])
@pytest.mark.parametrize("edges", [3, 8])
def test_a_hole_deeper_than_the_edges_are_long(kind, edges):
    """Its pecks do not clear one another: nothing carries the chips up."""
    tool = Tool(4, cutting_length=edges, kind=kind)
    pecks = f"G0 X50 Y30 Z5|G1 Z-{edges - 1} F100|G0 Z2|G0 Z-{edges - 2}|G1 Z-{edges + 2}|G0 Z50"
    only(met(pecks, tool), "shank", 7, 2)
    only(met(f"G0 X50 Y30 Z5|G1 Z-{edges + 2} F100|G0 Z50", tool), "shank", 4, 2)


@pytest.mark.parametrize("wide", [5.5, 8, 12])
@pytest.mark.parametrize("begin", [2, 6])
def test_a_shank_thicker_than_the_tool(wide, begin):
    """Straight down beside nothing: the ring about the hole stays, and the shank comes down on it."""
    tool = Tool(5, shank=(wide, begin), kind="mill")
    each = only(met(f"G0 X50 Y30 Z5|G1 Z-{begin + 1.5} F100|G0 Z50", tool), "shank", 4, 1.5)
    assert 5 < hypot(each.place[0] - 50, each.place[1] - 30) < wide
    assert not met(f"G0 X50 Y30 Z5|G1 Z-{begin} F100|G0 Z50", tool)


def test_a_thinner_shank_goes_where_the_edges_were():
    tool = Tool(5, cutting_length=3, shank=(4, 3), kind="mill")
    assert not met("G0 X50 Y30 Z5|G1 Z-9 F100|G0 Z50", tool)
    only(met("G0 X-20 Y30 Z5|G0 Z-5|G1 X50 F100|G0 Z50", tool), "shank", 5, 2)


def test_edges_go_before_the_shank_along_a_helix_and_a_ramp():
    """A bore of 18 mm, 10 mm deep, in turns of 1 mm, with edges of 2 mm; and to and fro along a ramp of 1 mm."""
    tool = Tool(5, cutting_length=2, kind="mill")
    helix = "|".join(f"G3 X54 Y30 Z-{k} I-4 J0" for k in range(1, 11))
    assert not met(f"G0 X54 Y30 Z5|G1 Z0 F100|{helix}|G3 X54 Y30 I-4 J0|G1 X50|G0 Z50", tool)
    ramp = "|".join(f"G1 X{40 + 20 * (k % 2)} Z-{k}" for k in range(1, 11))
    assert not met(f"G0 X40 Y30 Z5|G1 Z0 F100|{ramp}|G0 Z50", tool)


@pytest.mark.parametrize("wide", [10, 20, 31.5])
@pytest.mark.parametrize("begin", [3, 8, 15])
@pytest.mark.parametrize("rapid", [False, True])
def test_a_holder_comes_down_on_the_blank(wide, begin, rapid):
    """Past the blank, 2 mm from its side: the tool misses it, and the holder is 1.25 mm lower than its top."""
    tool = Tool(5, holder=((wide, begin), (wide + 5, begin + 20)), kind="mill")
    text = f"G0 X-60 Y-7 Z50|G1 Z-{begin + 1.25} F100|G{0 if rapid else 1} X120|G0 Z50"
    found = met(text, tool)
    assert [(each.kind, each.line) for each in found][-1] == ("holder", 5)
    assert found[-1].depth == pytest.approx(1.25) and 0 <= found[-1].place[1] <= wide - 7
    assert not met(text.replace(f"Z-{begin + 1.25}", f"Z-{begin}"), tool)


# --- fixtures --------------------------------------------------------------------------------------------------------

CLAMPS = {
    "box": ((40, 20, -20), (45, 40, 12)),
    "narrow": ((40, 29.9, -20), (40.05, 30.15, 12)),
    "bolt": cylinder(4, -20, 12, at=(44, 30, 0)),
    "part": mnclab.part.box((40, 20, -20), (45, 40, 12)),
    "other part": mnclab.part.cylinder((44, 30, -20), (44, 30, 12), 4),
}


@pytest.mark.parametrize("name", CLAMPS)
@pytest.mark.parametrize("rapid", [False, True])
@pytest.mark.parametrize("height", [0.1, 5, 11])
def test_a_tool_in_a_fixture(name, rapid, height):
    """A clamp 12 mm high that begins at X40."""
    text = f"G0 X-20 Y30 Z50|G0 Z{height}|G{0 if rapid else 1} X70 {'' if rapid else 'F100'}|G0 Z50"
    each = only(met(text, Tool(3, kind="mill"), fixtures=(CLAMPS[name],)), "fixture", 5, 12 - height, 1e-5)
    assert each.place[2] == pytest.approx(height) and 40 - 1e-9 <= each.place[0] <= 48 and "the tool in" in each.message
    assert not met(text.replace(f"Z{height}", "Z12"), Tool(3, kind="mill"), fixtures=(CLAMPS[name],))


@pytest.mark.parametrize("name", ["box", "bolt", "part"])
@pytest.mark.parametrize("body", ["shank", "holder"])
def test_what_is_behind_the_edges_in_a_fixture(name, body):
    """The tool passes the clamp at Y47; what is 15 mm wide, 8 mm above its tip, does not."""
    tool = Tool(3, shank=(15, 8)) if body == "shank" else Tool(3, holder=((15, 8),))
    found = met("G0 X-20 Y47 Z50|G0 Z1|G0 X120|G0 Z50", tool, fixtures=(CLAMPS[name],))
    each = only(found, "fixture", 5, 3, 1e-5)
    assert body in each.message


def test_a_fixture_that_is_passed_is_none():
    text = "G0 X-20 Y47 Z50|G0 Z1|G0 X120|G0 Z50"
    assert not met(text, Tool(3), fixtures=tuple(CLAMPS.values()))


# --- spindle ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("place", [(10, 10), (50.13, 30.07), (99.9, 59.9), (0.2, 30)])
@pytest.mark.parametrize("turning", ["", "M4", "M5"])
@pytest.mark.parametrize("depth", [0.2, 3])
def test_cutting_with_a_spindle_that_stands_or_turns_the_wrong_way(place, turning, depth):
    text = f"G0 X{place[0]} Y{place[1]} Z5|G1 Z-{depth} F100|G0 Z50"
    before = f"N10 G17 G90 G54\nN20 T1 S2500 {turning}\n"
    each = only(met(text, TOOLS["mill"], before=before), "spindle", 4, depth)
    assert ("wrong way" in each.message) == (turning == "M4")
    assert each.place[2] == pytest.approx(-depth)


def test_a_left_handed_tool_turns_with_m4():
    text = "G0 X50 Y30 Z5|G1 Z-1 F100|G0 Z50"
    left = Tool(5, hand="left", kind="mill")
    assert [each.kind for each in met(text, left)] == ["spindle"]
    assert not met(text, left, before="N10 G17 G90 G54\nN20 T1 S2500 M4\n")


def test_over_what_is_cut_already_the_spindle_may_stand():
    assert not met("G0 X50 Y30 Z5|G1 Z-1 F100|G1 X60|M5|G1 X50|G1 Z5|G1 X70|G0 Z50", TOOLS["mill"])


def test_many_cuts_of_one_line_are_shown_as_one_and_can_be_counted():
    text = "G0 X10 Y10 Z5|" + "|".join(f"G1 X{10 + k} Z-1 F100" for k in range(30))
    found = run(lines(text), "mnc", before="N10 G17 G90 G54\nN20 T1 S2500\n", stock=STOCK, tools={1: TOOLS["mill"]})
    found = found.collisions()
    assert len(found) == 30 == sum(n for _, n in found.by_line)
    assert "… and 10 more collisions, 30 in all" in repr(found) and len(repr(found).splitlines()) == 21
    again = mnclab.workpiece.collision.Collisions(each._replace(line=4) for each in found)
    assert repr(again).endswith("29 more like it in this line") and "29 more" in again._repr_html_()


# --- travel ----------------------------------------------------------------------------------------------------------

TRAVEL = ((-30.0, 120.0), (-20.0, 80.0), (-40.0, 60.0))


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("end", [0, 1])
@pytest.mark.parametrize("beyond", [0.01, 2, 55.5])
def test_beyond_the_travel(axis, end, beyond):
    """Along one axis from the middle of the travel; the alarm of the run names the same line."""
    target = [50.0, 30.0, 20.0]
    target[axis] = TRAVEL[axis][end] + (beyond if end else -beyond)
    words = " ".join(f"{name}{value}" for name, value in zip("XYZ", target))
    found = run(lines(f"G0 X50 Y30 Z20|G0 {words}|G0 Z50"), "mnc", ok=False, before=BEFORE, stock=STOCK,
                tools={1: TOOLS["mill"]}, limits=Limits(travel=TRAVEL))  # fmt: skip
    each = only(found.collisions(), "travel", 4, beyond)
    assert each.place == pytest.approx(target) and each.row == len(found.toolpath) - 1
    assert found.alarms[0].span.line == 4


def test_an_arc_leaves_the_travel_between_its_ends():
    """A half circle of 40 mm about X90: its farthest place is X130."""
    text = "G0 X90 Y-10 Z20|G1 F500 Z10|G3 X90 Y70 I0 J40|G0 Z50"
    found = run(lines(text), "mnc", ok=False, before=BEFORE, stock=STOCK, limits=Limits(travel=TRAVEL))
    each = only(found.collisions(), "travel", 5, 10)
    assert each.place == pytest.approx((130, 70, 10))


# --- all of them -----------------------------------------------------------------------------------------------------


KLARTEXT = "BEGIN PGM A MM|BLK FORM 0.1 Z X+0 Y+0 Z-20|BLK FORM 0.2 X+100 Y+60 Z+0|TOOL CALL 1 Z S1000|"
OTHER = {
    "tnc-620": KLARTEXT + "L X-30 Y+30 Z+5 R0 FMAX M3|L Z-3 FMAX|L X+50 FMAX|L Z+50 FMAX|END PGM A MM",
    "g43": "T1 M6|G54 G17 G90 G0 X-30 Y30 S1200 M3|G43 D1 Z5|G0 Z-3||||G0 X50|G0 Z50",
}


@pytest.mark.parametrize("control", OTHER)
@pytest.mark.parametrize("length", [0, 62.5])
def test_every_control_and_any_length_of_the_tool(control, length):
    tools = {1: Tool(5, length=length, kind="mill")}
    found = run(lines(OTHER[control]), control, stock=STOCK, tools=tools).collisions()
    each = only(found, "rapid", 7 if control == "tnc-620" else 8, 3)
    assert str(each).startswith(f"program:{each.line}: collision: rapid motion in material, 3.000 mm deep at X")


def test_a_collision_in_a_called_program_stands_there():
    called = "BEGIN PGM SUB MM|L Z-3 FMAX|L Z+5 FMAX|END PGM SUB MM"
    text = KLARTEXT + "L X+50 Y+30 Z+5 R0 FMAX M3|CALL PGM SUB.H|END PGM A MM"
    (each,) = run(lines(text), "tnc-620", files={"SUB.H": lines(called) + "\n"}).collisions()
    assert (each.kind, each.line, each.program, each.depth) == ("rapid", 2, 1, pytest.approx(3))
    assert each.as_dict()["file"] == each.file == "SUB.H"


def test_places_are_those_of_the_path_whatever_the_datum():
    """The same program on a datum far away: the blank and the clamp in machine coordinates, the answer in the path's."""
    text = "G0 X-30 Y30 Z5|G0 Z-3|G0 X50|G0 Z50"
    at = np.array([200, 100, -50])
    here = met(text, TOOLS["mill"], fixtures=(CLAMPS["box"],))
    moved = [tuple(tuple(np.add(corner, at).tolist()) for corner in box) for box in (STOCK, CLAMPS["box"])]
    there = met(text, TOOLS["mill"], datums={1: tuple(at.tolist())}, presets={}, stock=moved[0], fixtures=(moved[1],))
    assert [each.kind for each in here] == ["fixture", "rapid"]
    for one, other in zip(here, there, strict=True):
        assert one[:5] == other[:5] or one.message != other.message
        assert np.allclose(one.place, other.place, atol=1e-9) and one.depth == pytest.approx(other.depth)


def test_a_place_beside_zero_has_no_sign():
    assert coordinates("XYZ", (-1e-5, 0.0, -2.5)) == "X0.000 Y0.000 Z-2.500"


def test_a_note_names_what_is_not_judged():
    """Whoever reads that nothing was met, reads of what this holds."""
    text = "TOOL CALL 3 Z S1000\nL Z+91 R0 FMAX M3\nPLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY\nL Z+95 R0 F100\n"
    found = mnclab.run(text, "tnc-620").collisions(((-20, -20, -20), (20, 20, 90)))
    assert found == () and found.notes == ("1 row on which the tool turns not judged (program:4)",)
    assert repr(found) == "no collisions where judged\n  note: 1 row on which the tool turns not judged (program:4)"
    assert "<p>1 row on which the tool turns not judged (program:4)</p>" in found._repr_html_()


PROBED = "G54 G17 G90 T1 S800 M3\nG0 X20 Y20 Z5\nG1 Z-6 F100\nG0 Z5\nM5\nT2\n{way}\nG0 Z20\n"


@pytest.mark.parametrize(("way", "depth"), [
    ("G0 X-10 Y10\nZ-5\nX20", 5),  # in from the side, its pole 5 mm under the top
    ("G0 X40 Y20\nG1 Z-3 F500", 3),
    ("G0 X20 Y20\nZ-6", 0),  # into the hole of 12 mm that the mill has cut
    ("G0 X24 Y20\nZ-6", 0),  # 4 mm beside its middle: the ball touches the wall
    ("G0 X40 Y20\nZ0", 0),
])  # fmt: skip
def test_a_probe_driven_into_material(way, depth):
    """What the program does with a probe between its cycles: the ball meets what stands there, and clears nothing."""
    tools = {1: Tool(radius=6, number=1), 2: Tool(radius=2, number=2, kind="probe")}
    run = mnclab.run(PROBED.format(way=way), "mnc", mnclab.Setup(tools=tools))
    met = [each for each in run.collisions(stock=((0, 0, -20), (60, 40, 0))) if each.kind == "probe"]
    assert [each.depth for each in met] == ([pytest.approx(depth, abs=1e-6)] if depth else [])
    assert all(each.message.startswith("the probe in material") for each in met)


@pytest.mark.parametrize("kind", ["drill", "reamer", "tap", "mill", "countersink"])
def test_a_drill_goes_along_its_axis(kind):
    """A slot with a drill breaks it; beside the part, in a slot that a mill has cut before, and straight down it is well."""
    slot = "G54 G17 G90 T1 S800 M3\nG0 X-10 Y10 Z5\nG0 Z-5\nG1 X70 F100\nG0 Z5\n"
    drilled = "T2 S800 M3\nG0 X{x} Y{y} Z2\nG1 Z-4 F100\nG1 X50\nG0 Z20\n"
    tools = {1: Tool(radius=6, number=1), 2: Tool(radius=3, number=2, kind=kind, pitch=1 if kind == "tap" else 0)}
    through, milled, beside = drilled.format(x=10, y=30), slot + drilled.format(x=10, y=10), drilled.format(x=10, y=-9)
    for text, bad in ((through, True), (milled, False), (beside, False)):
        found = mnclab.run(text, "mnc", mnclab.Setup(tools=tools)).collisions(stock=((0, 0, -20), (60, 40, 0)))
        met = [each.line for each in found if each.kind == "sideways"]
        assert met == ([4] if bad and kind in ("drill", "reamer", "tap") else [])


def test_the_table_of_an_inch_program_tells_inches_alone():
    """-.25 in below the top: what stands beside the message would be the same in mm."""
    tools, stock = {1: Tool(diameter=12.7)}, ((0, 0, -25.4), (101.6, 76.2, 0))
    setup = mnclab.Setup(tools=tools, stock=stock)
    found = mnclab.run("G20 G54\nT1 M6\nS900 M3\nG0 X1 Y1 Z1\nG0 Z-.25\n", "g43", setup).collisions()
    shown = found._repr_html_()
    assert "0.250 in deep at X1.000 Y1.000 Z-0.250" in shown and "mm" not in shown


HOLE = "N30 G54 G17 G90 T1 S500 M3\nG0 X30 Y20 Z2\n{drill}G0 Z20\nT2 S200 M3\nG0 X30 Y20 Z2\n{into}\nG1 Z2\nG0 Z20\n"
NARROW = "narrower than 8.3762 mm, the minor diameter of its thread"
FULL = "in full material, where it needs a hole"


@pytest.mark.parametrize(("tool", "drilled", "met", "said"), [
    ("reamer", 9.8, None, ""),
    ("reamer", 0, 12, FULL),
    ("tap", 8.5, None, ""),  # the drill of a thread M10
    ("tap", 8.38, None, ""),
    ("tap", 8.2, 12 - 3 * 1.5, NARROW),  # its chamfer of three turns goes before
    ("tap", 0, 12, FULL),
    ("end-cutting", 0, None, ""),  # a reamer that cuts at its centre, by its table
    ("countersink", 0, None, ""),
])  # fmt: skip
def test_a_reamer_and_a_tap_need_a_hole(tool, drilled, met, said):
    """ISO 724: the minor diameter of M10 is 10 - 1.082532 * 1.5 = 8.3762 mm."""
    tools = {
        "reamer": Tool(diameter=10, kind="reamer"),
        "end-cutting": Tool(diameter=10, kind="reamer", centre_cutting=True),
        "tap": Tool(diameter=10, kind="tap", pitch=1.5),
        "countersink": Tool(diameter=10, kind="countersink"),
    }
    drill = "G1 Z-18 F100\n" if drilled else ""
    text = HOLE.format(drill=drill, into="G1 Z-12 F100")
    setup = mnclab.Setup(tools={1: Tool(diameter=drilled or 1, kind="drill"), 2: tools[tool]}, stock=((0, 0, -20), (60, 40, 0)))
    run = mnclab.run(text, "mnc", setup)
    found = run.collisions()
    assert run.ok and [(each.kind, each.line) for each in found] == [("solid", 6 + bool(drill))] * (met is not None)
    assert all(said in each.message and each.depth == pytest.approx(met, abs=1e-6) for each in found)


def test_a_tap_that_goes_deeper_than_its_hole():
    """8 mm drilled with a point of 118 degrees, 8.5 / 2 / tan 59 high: at Z-12 the tap is 4 mm in full material."""
    tools = {1: Tool(diameter=8.5, kind="drill", angle=118), 2: Tool(diameter=10, kind="tap", pitch=1.5)}
    text = HOLE.format(drill="G1 Z-8 F100\n", into="G1 Z-12 F100")
    (each,) = mnclab.run(text, "mnc", mnclab.Setup(tools=tools, stock=((0, 0, -20), (60, 40, 0)))).collisions()
    assert each.kind == "solid" and FULL in each.message and each.depth == pytest.approx(4, abs=1e-6)


def test_a_tap_without_a_pitch_is_judged_by_its_axis_alone():
    tools = {1: Tool(diameter=3, kind="drill"), 2: Tool(diameter=10, kind="tap")}
    text = HOLE.format(drill="G1 Z-18 F100\n", into="G1 Z-12 F100")
    assert not len(mnclab.run(text, "mnc", mnclab.Setup(tools=tools, stock=((0, 0, -20), (60, 40, 0)))).collisions())
