"""The adopted reading of everything that chapters 1 to 8 leave open is the default: a program and its numbers for each.

The names are those of tests/authorities/catalogue/ambiguities.json. Numbers are worked out by hand from the reading; what is
longer than a line is a test below, or stands under the same name in the other files of this folder.
"""

import math
from typing import NamedTuple

import numpy as np
import pytest
from tools.running import lines, run

import mnclab
from mnclab import Kind, Tool

CONTROL = mnclab.controls["mnc"]
DATUMS = {1: (3, 4, 0), 2: (30, 40, 50), 99: (1, 2, 3)}
TOOLS = {0: Tool(), 1: Tool(radius=2), 2: Tool(radius=2, dr=0.5, length=50, dl=-0.5)}
KINDS = {"rapid": Kind.RAPID, "line": Kind.LINE, "arc": Kind.ARC}


class Case(NamedTuple):
    """A program in one line (blocks between bars) and what must come of it: ends of its moves in machine coordinates."""

    name: str
    program: str
    ends: list = None
    kinds: str = ""  # of the moves
    sweeps: tuple = ()  # of the arcs, degrees
    centres: tuple = ()  # of the arcs, in the first two axes
    warns: str = ""  # what the only warning says
    alarm: str = ""  # LINE:COLUMN text


AS_A_LINE = "is obeyed as a straight line"

CASES = [
    Case("MNC-PROG-END", "G0 X1|M30|X2", [(1, 0, 0)], warns="M30: the manual does not list it"),
    Case("MNC-PROG-END", "G0 X1|X2 M2|X3", [(1, 0, 0), (2, 0, 0)], warns="M2: the manual does not list it"),
    Case("MNC-PROG-END", "G0 X1", [(1, 0, 0)]),
    Case("MNC-CH11", "N1 G0 X1|L1", alarm="2:1 L1 has no meaning"),
    Case("MNC-CH11", "N1 G0 X1|N1 X2", alarm="2:1 N1 labels two blocks"),
    Case("MNC-WORD-SEP", "g90g0x1y2s100m3m8", [(1, 2, 0)], warns="M8: the manual does not list it"),
    Case("MNC-WORD-SEP", "G0 X1 X1", alarm="1:7 X is written twice"),
    Case("MNC-DECIMAL-COMMA", "G0 X1,5", alarm="1:6 ',' is no part of a number"),
    Case("MNC-AXIS-LETTERS", "G0 X1 U2", alarm="1:7 U2 has no meaning"),
    Case("MNC-AXIS-LETTERS", "G0 X1 B2", alarm="1:7 B2 has no meaning"),
    Case("MNC-AXIS-LETTERS", "G0 X1 A2", alarm="1:7 A2 has no meaning"),
    Case("MNC-MODAL-G", "G54|G0 X0 Y0|G53 X5|X6|G4 P1|X7", [(3, 4, 0), (5, 4, 0), (9, 4, 0), (10, 4, 0)]),
    Case("MNC-SKIP-COMMENT", "//G0 X9|/G0 X1|/ X2|/N5 X3", [(1, 0, 0), (2, 0, 0), (3, 0, 0)]),
    Case("MNC-COMMENT-SPACE", "/ /G0 X9|G0 X1 / /X2", [(1, 0, 0)]),
    Case("MNC-G13-GROUP", "G13 G1 X5", alarm="1:5 G1 and G13 are of one group"),
    Case("MNC-G0-GROUP", "G9 G0 X1", [(1, 0, 0)]),
    Case("MNC-BLOCK-ORDER", "G0 X5|G91|X7 G90|G1 X8 F60|X1 G91", [(k, 0, 0) for k in (5, 7, 8, 9)]),
    Case("MNC-XFORM-ORDER", "G39 A90|G51 X10|G37 X2 Y3|G0 X1 Y1", [(-3, 18, 0)]),  # 2, 3 -> 18, 3 -> -3, 18
    Case("MNC-XFORM-ORDER", "G37 X2 Y2|G51 X10|G39 X10 A90|G0 X1 Y1", [(8, 8, 0)]),  # 2, 2 -> 18, 2 -> 10 - 2, 18 - 10
    Case("MNC-XFORM-SWITCH", "G0 X10|G39 A90|Y5", [(10, 0, 0), (-5, 10, 0)]),
    Case("MNC-XFORM-SWITCH", "G0 X10|G51 X0|G91|Y5|X1", [(10, 0, 0), (-10, 5, 0), (-11, 5, 0)]),
    Case("MNC-G39-START", "G0 X30 Y10|G39 A90|Y20", [(30, 10, 0), (-20, 30, 0)]),
    Case(
        "MNC-OFFSET-SWITCH", "G0 X10 Y5|G54|X0|G92 Y1|X1|G53 Z2|X2",
        [(10, 5, 0), (3, 5, 0), (4, 5, 0), (4, 5, 2), (5, 5, 2)],
    ),
    Case("MNC-XFORM-ARC", "G51 X0|G1 X5 F60|G3 X0 Y5 R5", [(-5, 0, 0), (0, 5, 0)], sweeps=(-90,)),
    Case("MNC-XFORM-ARC", "G51 X0 Y0|G1 X5 F60|G3 X0 Y5 R5", [(-5, 0, 0), (0, -5, 0)], sweeps=(90,)),
    Case("MNC-XFORM-ARC", "G37 X2 Y2|G1 X5 F60|G3 X0 Y5 R5", [(10, 0, 0), (0, 10, 0)], sweeps=(90,), centres=((0, 0),)),
    Case("MNC-XFORM-ARC", "G37 X2|G1 X5 F60|G3 X0 Y5 R5", alarm="3:10 an arc under unequal scales"),
    Case("MNC-G51-ARCS", "G51 Y0|G2 X10 R5 F60", [(10, 0, 0)], sweeps=(180,), centres=((5, 0),)),
    Case("MNC-G51-NONE", "G51 X5|G51|G0 X1", [(1, 0, 0)], warns="G51 without coordinates mirrors nothing"),
    Case("MNC-G39-ABSANGLE", "G39 A30|G39 A90|G0 X1", [(0, 1, 0)]),
    Case("MNC-G17-DEFAULT", "G3 I5 F60", [(0, 0, 0)], sweeps=(360,), centres=((5, 0),)),
    Case("MNC-G90-OMITTED", "G0 X1 Y2 Z3|X5", [(1, 2, 3), (5, 2, 3)]),
    Case("MNC-G91-BASE", "G39 A90|G0 X10|G91|X5", [(0, 10, 0), (0, 15, 0)]),
    Case(
        "MNC-G91-BASE", "T1 G0 X-9|G41 G1 X0 F60|G91|X5|X5|G90|G40 X19",
        [(-9, 0, 0), (0, 2, 0), (5, 2, 0), (10, 2, 0), (19, 0, 0)],
    ),
    Case("MNC-G92-U", "G0 X10 Y10|G92 U3 V-1|X0 Y0", [(10, 10, 0), (3, -1, 0)]),  # 7, 11 there
    Case("MNC-G92-POINT", "T2|G0 Z10|G92 Z0|Z5", [(0, 0, 10), (0, 0, 15)]),
    Case("MNC-G92-POINT", "T1 F60|G41 G1 X5|X9|G92 X0", alarm="4:1 G92 cannot stand under radius compensation"),
    Case("MNC-G92-STACK", "G54|G0 X7 Y0|G92 X5|X0|G54|X0", [(10, 4, 0), (5, 4, 0), (3, 4, 0)]),
    Case("MNC-G92-STACK", "G54|G0 X7 Y0|G92 X5|X0|G147 Q1|X0", [(10, 4, 0), (5, 4, 0), (3, 4, 0)]),
    Case("MNC-G53-KEEP", "G54|G39 A90|G51 X0|G53 G0 X10 Y0", [(0, -10, 0)]),
    Case("MNC-G53-KEEP", "T2|G53 G0 Z7|Z8", [(0, 0, 7), (0, 0, 8)]),
    Case("MNC-G53-G91", "G54|G91|G0 X4|G53 X9|X1", [(4, 0, 0), (9, 0, 0), (10, 0, 0)]),
    Case(
        "MNC-G53-MOTION", "G53 X5|G1 X6 F60|G53 X5|G53 G0 X0",
        [(5, 0, 0), (6, 0, 0), (5, 0, 0), (0, 0, 0)], "rapid line line rapid",
    ),
    Case("MNC-DATUM-ROWS", "G147 Q99|G0 X0 Y0 Z0", [(1, 2, 3)]),
    Case("MNC-DATUM-ROWS", "G147 Q0", alarm="1:6 G147 Q (datum number) must be a whole number from 1"),
    Case("MNC-DATUM-ROWS", "G147 Q1.5", alarm="1:6 G147 Q (datum number) must be a whole number from 1"),
    Case("MNC-G147-G247", "G247 Q2|G0 X0", [(30, 0, 0)], warns="G247 is another name of G147"),
    Case("MNC-POLAR-SIGN", "G16|G10 R10 A90|A-90", [(0, 10, 0), (0, -10, 0)]),
    Case("MNC-POLAR-CART", "G16 X5|G0 X1 Y2|G10 R3 A0|G15|X0", [(1, 2, 0), (8, 0, 0), (0, 0, 0)]),
    Case("MNC-POLAR-CART", "G16|G10 R3 A0|G15|R4 A9", alarm="4:1 R4 has no meaning"),
    Case("MNC-POLAR-START", "G0 Y10|G16|G91|G10 R5 A-90", [(0, 10, 0), (15, 0, 0)]),
    Case("MNC-POLAR-START", "G16|G91|G10 R5", [(5, 0, 0)]),
    Case("MNC-POLAR-THIRD", "G16|G10 R5 A0 Z5|G11 A90 Z1 F60", [(5, 0, 5), (0, 5, 1)]),
    Case(
        "MNC-POLAR-THIRD", "G16|G10 R5 A0|G13 A90 K5 Z1 F60",
        [(5, 0, 0), (0, 5, 1)], sweeps=(90,), warns="Z in an arc of the plane XY makes a helix",
    ),
    Case("MNC-G16-ABS", "G0 X100 Y50|G91|G16 X20|G90|G10 R5 A0", [(100, 50, 0), (25, 0, 0)]),
    Case("MNC-G12-K", "G16|G10 R5 A0|G12 A90 K5 F60", [(5, 0, 0), (0, 5, 0)], sweeps=(-270,), centres=((0, 0),)),
    Case("MNC-G12-K", "G16|G10 R5 A0|G12 A90 K-5 F60", [(5, 0, 0), (0, 5, 0)], sweeps=(-270,), centres=((0, 0),)),
    Case(
        "MNC-G12-K", "G16|G10 R5 A0|G13 R15 A180 K10 F60",
        [(5, 0, 0), (-15, 0, 0)], sweeps=(180,), centres=((-5, 0),),
    ),
    Case("MNC-G13-GROUP2", "G16|G10 R0 A0|G13 R10 A90 K5 F60", [(0, 10, 0)], sweeps=(180,), centres=((0, 5),)),
    Case("MNC-G12-NOK", "G16|G10 R5 A0|G12 A90 F60", [(5, 0, 0), (0, 5, 0)], "rapid line", warns=AS_A_LINE),
    Case("MNC-G12-FULL", "G16|G10 R5 A0|G12 K5 F60", [(5, 0, 0), (5, 0, 0)], sweeps=(-360,), centres=((0, 0),)),
    Case("MNC-G12-FULL", "G16|G10 R5 A0|G12 K4 F60", alarm="3:5 a full circle needs K equal to the polar radius"),
    Case("MNC-G37-OMIT", "G37 X2 Y3|G37 Z4|G0 X1 Y1 Z1", [(1, 1, 4)]),
    Case(
        "MNC-G37-SCOPE", "G37 X2 Y2|G16 X1|G10 R5 A0|G13 A180 K5 F60",
        [(12, 0, 0), (-8, 0, 0)], sweeps=(180,), centres=((2, 0),),
    ),
    Case("MNC-G37-SCOPE", "G37 Z2|G0 Z5|G83 Z-5 R1 F60", [(0, 0, z) for z in (10, 2, -10, 2, 10)]),
    Case(
        "MNC-G37-SCOPE", "G37 X2 Y2|G54|T1 G0 X-9 Y0|G41 G1 X0 F60|X5|G40 X9",
        [(-15, 4, 0), (3, 6, 0), (13, 6, 0), (21, 4, 0)],
    ),
    Case("MNC-G0-PATH", "G0 X30 Y10", [(30, 10, 0)], "rapid"),
    Case("MNC-33", "G1 X5 A30 F60", alarm="1:7 A30 has no meaning"),
    Case("MNC-ARC-TOL", "G2 X10.0099 I5 F60", [(10.0099, 0, 0)], "arc"),
    Case("MNC-ARC-TOL", "G2 X10.0101 I5 F60", alarm="1:13 the end point is not on the circle"),
    Case(
        "MNC-ARC-RIJK", "G2 X10 R5 I3 J4 F60",
        [(10, 0, 0)], sweeps=(-180,), centres=((5, 0),), warns="R and I J K stand in one block: R counts",
    ),
    Case("MNC-ARC-180", "G2 X10 R5 F60", [(10, 0, 0)], sweeps=(-180,), centres=((5, 0),)),
    Case("MNC-ARC-180", "G2 X10 R-5 F60", [(10, 0, 0)], sweeps=(-180,), centres=((5, 0),)),
    Case("MNC-ARC-LINE", "G2 X5 F60|X10 R2.5", [(5, 0, 0), (10, 0, 0)], "line arc", sweeps=(-180,), warns=AS_A_LINE),
    Case("MNC-ARC-MODAL", "G2 X5 R2.5 F60|X10", [(5, 0, 0), (10, 0, 0)], "arc line", warns=AS_A_LINE),
    Case(
        "MNC-HELIX", "G2 X10 Z1 I5 F60",
        [(10, 0, 1)], sweeps=(-180,), warns="Z in an arc of the plane XY makes a helix",
    ),
    Case("MNC-IJK-FULLTOL", "G3 X0.0009 I5 F60", [(0.0009, 0, 0)], sweeps=(360,)),
    Case("MNC-IJK-FULLTOL", "G2 Y0.0011 I5 F60", [(0, 0.0011, 0)], sweeps=(-math.degrees(0.0011 / 5),)),
    Case("MNC-G64-GEOM", "G64|G1 X5 F60|Y5|G61|X0", [(5, 0, 0), (5, 5, 0), (0, 5, 0)]),
    Case("MNC-T-CHANGE", "T1|M6|G0 X1", [(1, 0, 0)], warns="T itself changes the tool"),
    Case("MNC-T-CRC", "T1 F60|G41 G1 X5|X9|T2", alarm="4:1 the tool cannot change while radius compensation is active"),
    Case("MNC-TLC-ONCALL", "T2 G0 X1|Z0", [(1, 0, -49.5), (1, 0, 0)]),
    Case("MNC-TLC-G18", "G18|T2 G0 X1|G19 Z0", [(1, 0, -49.5), (1, 0, 0)]),
    Case("MNC-TT-RADCORR", "T2 Z0 G0 X-9|G41 G1 X0 F60|X5|G40 X9", [(-9, 0, 0), (0, 2.5, 0), (5, 2.5, 0), (9, 0, 0)]),
    Case("MNC-CRC-SIDE", "T1 G0 Y-9|G42 G1 Y0 F60|Y5|G40 Y9", [(0, -9, 0), (2, 0, 0), (2, 5, 0), (0, 9, 0)]),
    Case(
        "MNC-CRC-BETWEEN", "T1 G0 X-9|G41 G1 X0 F60|X5|Z-3|Y-5|G40 Y-9",
        [(-9, 0, 0), (0, 2, 0), (5, 2, 0), (5, 2, -3), (7, 0, -3), (7, -5, -3), (5, -9, -3)],
        "rapid line line line arc line line",
    ),
    Case("MNC-CRC-GOUGE", "T1 G0 X-9|G41 G1 X0 F60|X5|G3 X9 R2|G1 X20|G40 X30", alarm="4:1"),
    Case("MNC-ENTRY-INSIDE", "T1 G0 X-9 Y9|G41 G1 X0 Y0 F60|X5|G40 X9", [(-9, 9, 0), (0, 2, 0), (5, 2, 0), (9, 0, 0)]),
    Case("MNC-ENTRY-180", "T1 G0 X-9|G41 G1 X0 F60|X5|G40 X9", [(-9, 0, 0), (0, 2, 0), (5, 2, 0), (9, 0, 0)]),
    Case("MNC-G40-RAPID", "T1 G0 X-9|G41 G1 X0 F60|X5|G40 G0 X9", alarm="4"),
    Case("MNC-G4-RANGE", "G4 P0.001", alarm="1:4 G4 P (dwell) must be at least 0.01"),
    Case("MNC-G4-RANGE", "G4 P100000", alarm="1:4 G4 P (dwell) must be at least 0.01 and at most 99999.999"),
]  # fmt: skip


def obeyed(program, **setup):
    return run(lines(program), ok=None, datums=DATUMS, tools=TOOLS, **setup)


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case.name} {case.program}")
def test_the_default_is_the_adopted_reading(case):
    found = obeyed(case.program)
    if case.alarm:
        place, _, text = case.alarm.partition(" ")
        first = next(alarm for alarm in found.alarms if alarm.severity == "alarm")
        assert text in first.message and f"{first.span.line}:{first.span.column}".startswith(place), first
        return
    assert found.ok, found.alarms
    assert [case.warns in alarm.message for alarm in found.alarms] == [True] * bool(case.warns), found.alarms
    moves = found.toolpath.motion
    assert moves.end + moves.origin == pytest.approx(np.array(case.ends, dtype=float), abs=1e-9)
    if case.kinds:
        assert moves.kind.tolist() == [KINDS[kind] for kind in case.kinds.split()]
    arcs = moves[moves.kind == Kind.ARC]
    if case.sweeps:
        assert np.degrees(arcs.sweep).tolist() == pytest.approx(case.sweeps, rel=1e-6)
    if case.centres:
        assert (arcs.centre + arcs.origin)[:, :2] == pytest.approx(np.array(case.centres, dtype=float), abs=1e-9)


def codes(found):
    """Kind names of all rows, events too."""
    return [Kind(kind).name for kind in found.toolpath.kind]


def test_g18_turns_from_z_to_x():
    """MNC-G18-ORDER: a quarter from (Z5, X0) to (Z0, X5), counter-clockwise about +Y."""
    row = obeyed("G18 G0 Z5|G3 X5 Z0 K-5 F60").toolpath[-1]
    assert row.axis.tolist() == [0, 1, 0] and math.degrees(row.sweep) == pytest.approx(90)


def test_the_tool_starts_at_the_machine_zero_or_where_the_caller_says():
    """MNC-HOME"""
    assert obeyed("G0 X5").toolpath.start.tolist() == [[0, 0, 0]]
    assert obeyed("G0 X5", start=(1, 2, 3)).toolpath.end.tolist() == [[5, 2, 3]]


def test_numbers_of_table_1_2_are_other_names():
    """MNC-G2xx-NUMBERS: titles agree one to one; 240 and 207 are not in the table."""
    names = {
        "G200": "G300",
        "G201": "G301",
        "G202": "G302",
        "G203": "G303",
        "G204": "G304",
        "G208": "G306",
        "G241": "G307",
    }
    for other, code in names.items():
        assert CONTROL.cycles.get(other) is CONTROL.cycles.get(code)
        assert (other in CONTROL.refused) == (code in CONTROL.refused)
    assert not {"G240", "G207"} & {*CONTROL.functions, *CONTROL.cycles, *CONTROL.refused}
    notices = [alarm.message for alarm in obeyed("F60|G200 Q1 H-5 Z0").alarms]
    assert notices == ["G200 is another name of G300 (Drilling)"]


def test_groups_that_the_table_leaves_out():
    """MNC-GROUP-FIX, MNC-G13-GROUP, MNC-G0-GROUP"""
    group = {code: CONTROL.functions[code].group for code in ("G0", "G1", "G13", "G9", "G54", "G147", "G92")}
    assert group["G0"] == group["G1"] == group["G13"] != group["G9"]
    assert group["G147"] == group["G54"] and group["G92"] is None
    assert "are of one group" in obeyed("F60|G80 G83 Z-5 R1").alarms[0].message


def test_fields_of_the_tool_table():
    """MNC-TT-PLUNGE, MNC-TT-LIFE: an angle that is 0 unless given; no life."""
    assert Tool().plunge_angle == 0 and Tool(plunge_angle=3).plunge_angle == 3 and not hasattr(Tool(), "life")


def test_the_corrector():
    """MNC-D: T1 is 0 long and has radius 2; row 2 corrects the length by -0.5 and has the radius 2.5."""
    found = obeyed("T1|D2|T1")
    assert [found.at(line).position[2] for line in (1, 2, 3)] == [0, 0.5, 0]
    assert found.toolpath.radius.tolist() == [2, 2.5, 2]


def test_the_feed_of_a_corner_is_that_of_the_next_block():
    """MNC-CRC-FEED"""
    path = obeyed("T1 G0 X-9|G41 G1 X0 F60|X5|Y-5 F80|G40 Y-9").toolpath
    assert path.feed[path.kind == Kind.ARC].tolist() == [80]


def test_the_kind_of_corner_of_the_exit_stays():
    """MNC-G40-CORNERMODE"""
    assert obeyed("T1 G0 X-9|G41 G1 X0 F60|X5|G40 G160 X9|Y5").at(5).state["corners"] == "G160"


def test_the_spindle_has_its_speed_at_once():
    """MNC-G26-TIME: no time passes."""
    assert codes(obeyed("G26 S500 M3|G0 X1")) == ["SPINDLE", "RAPID"]


def test_spindle_and_coolant_act_before_the_motion_what_ends_after_it():
    """MNC-M-ORDER, MNC-M5, MNC-PROG-END: M3 M4 M7 M8 before; M5, M9 (ISO 6983), M0 and M99 after it."""
    assert codes(obeyed("G0 X1 S500 M3|X2 M5")) == ["SPINDLE", "RAPID", "RAPID", "SPINDLE"]
    path = obeyed("S500 M3|G0 X2 M5").toolpath
    assert path.spindle.tolist() == [500, 500, 0]
    assert codes(obeyed("G0 X1 M8|X2 M9|X3 M0")) == ["COOLANT", "RAPID", "RAPID", "COOLANT", "RAPID", "STOP"]


@pytest.mark.parametrize(
    ("motion", "place"),
    [("M99", (0, 0)), ("G0 X3 M99", (3, 0)), ("G1 X3 Y4 M99", (3, 4)), ("G2 X4 R2 M99", (4, 0)), ("M99 X3", (3, 0))],
)
def test_a_prepared_cycle_runs_where_the_block_ends(motion, place):
    """MNC-M99-MOTION: clearance level 1, bottom -5, back to where Z stood."""
    path = obeyed(f"F60|G0 Z9|G300 Q1 H-5 Z0|{motion}").toolpath
    assert path.end[-3:].tolist() == [[*place, 1], [*place, -5], [*place, 9]]


def test_a_prepared_cycle_runs_after_a_polar_motion():
    """MNC-M99-MOTION"""
    path = obeyed("F60|G300 Q1 H-5 Z0|G16|G10 R3 A90|G11 R4 M99").toolpath
    assert path.end[-2].tolist() == pytest.approx([0, 4, -5])
    alarm = obeyed("F60|G300 Q1 H-5 Z0|T1|G41 G1 X5|X9 M99").alarms[0]
    assert alarm.message == "a cycle cannot run under radius compensation" and alarm.span[:2] == (5, 4)
