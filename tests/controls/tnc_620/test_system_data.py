"""FN 18: SYSREAD and FN 17: SYSWRITE, with the meanings of the lists of system data in public Klartext manuals."""

from __future__ import annotations

import dataclasses
import math

import pytest

import mnclab as mnc
from mnclab.controls.tnc_620.control import CONTROL
from mnclab.controls.tnc_620.language.system_data import ROWS, TABLES

TOOLS = {
    1: mnc.Tool(radius=5, length=80, corner=1, dl=0.2, dr=-0.1, teeth=3, cutting_length=25, plunge_angle=4, kind="mill"),
    2: mnc.Tool(radius=4, length=60, angle=118, kind="drill"),
    6: mnc.Tool(radius=2, length=50, kind="probe"),
}
TRAVEL = ((-10, 500), (-20, 400), (-300, math.inf))
SETUP = mnc.Setup(
    tools=TOOLS, presets={3: (100, 50, -200)}, datums={4: (7, 8, 9)}, limits=mnc.Limits(travel=TRAVEL), start=(0, 0, 0),
    settings={"clock": 1.5e9},
)  # fmt: skip
SPIRAL = "2 CYCL DEF 200 X\nQ200=2\nQ201=-15\nQ206=250\nQ202=5\nQ210=0\nQ203=0\nQ204=50\nQ211=0\nQ395=0\n"
BEFORE = {
    "": "",
    "moved": "2 CYCL DEF 247 X\nQ339=3\n3 L X+11 Y+12 Z+13 FMAX M13\n",
    "deltas": "2 TOOL CALL 1 Z S500 DL+0.5 DR+0.25 DR2-0.5\n3 L F300\n",
    "shifted": "2 CYCL DEF 7.0 X\n3 CYCL DEF 7.1 X+5 Y-6 C+30\n4 L X+1 Y+2 Z+3 FMAX\n",
    "turned": "2 CYCL DEF 10.0 X\n3 CYCL DEF 10.1 ROT+35\n4 CYCL DEF 8.0 X\n5 CYCL DEF 8.1 X Y\n",
    "scaled": "2 CYCL DEF 11.0 X\n3 CYCL DEF 11.1 SCL 0.5\n4 CYCL DEF 26.0 X\n5 CYCL DEF 26.1 Y 1.5\n",
    "tilted": "2 CYCL DEF 19.0 X\n3 CYCL DEF 19.1 A+10 C+20\n",
    "cycle": SPIRAL,
}


@pytest.mark.parametrize(
    ("before", "asked", "expected"),
    [
        ("", "ID10 NR1", 0), ("", "ID10 NR2", 1), ("cycle", "ID10 NR3", 200),
        ("", "ID20 NR1", 1), ("", "ID20 NR3", 2), ("", "ID20 NR4", 1000), ("", "ID20 NR5", -1), ("moved", "ID20 NR5", 0),
        ("moved", "ID20 NR8", 1), ("", "ID20 NR9", 100), ("deltas", "ID20 NR9", 300), ("", "ID20 NR11", 0),
        ("cycle", "ID30 NR1", 2), ("cycle", "ID30 NR2", -15), ("cycle", "ID30 NR3", 5), ("cycle", "ID30 NR4", 250),
        ("", "ID35 NR2", 0),
        ("", "ID50 NR1 IDX2", 60), ("", "ID50 NR2 IDX2", 4), ("", "ID50 NR3 IDX1", 1), ("", "ID50 NR4 IDX1", 0.2),
        ("", "ID50 NR5 IDX1", -0.1), ("", "ID50 NR13 IDX1", 25), ("", "ID50 NR14 IDX1", 4), ("", "ID50 NR15 IDX1", 3),
        ("", "ID50 NR32 IDX2", 118), ("", "ID50 NR36 IDX1", 0), ("", "ID50 NR36 IDX2", 1), ("", "ID50 NR36 IDX6", 21),
        ("deltas", "ID950 NR1", 80), ("", "ID950 NR15", 3),
        ("", "ID60 NR1", 1), ("", "ID60 NR2", 2), ("deltas", "ID60 NR3", 500), ("deltas", "ID60 NR4", 0.5),
        ("deltas", "ID60 NR5", 0.25), ("deltas", "ID60 NR7", -0.5), ("", "ID60 NR4", 0),
        ("deltas", "ID200 NR1 IDX1", 5), ("deltas", "ID200 NR1 IDX2", 4.9), ("deltas", "ID200 NR1 IDX3", 5.15),
        ("deltas", "ID200 NR1", 5.15), ("deltas", "ID200 NR2 IDX1", 80), ("deltas", "ID200 NR2 IDX3", 80.7),
        ("deltas", "ID200 NR3 IDX1", 1), ("deltas", "ID200 NR3 IDX3", 0.5),
        ("", "ID210 NR1", 0), ("turned", "ID210 NR2", 35), ("turned", "ID210 NR3", 3), ("", "ID210 NR3", 0),
        ("scaled", "ID210 NR4 IDX1", 0.5), ("scaled", "ID210 NR4 IDX2", 0.75), ("", "ID210 NR4", 1),
        ("tilted", "ID210 NR5 IDX1", 10), ("tilted", "ID210 NR5 IDX2", 0), ("tilted", "ID210 NR5 IDX3", 20),
        ("tilted", "ID210 NR6", -1), ("", "ID210 NR6", 0), ("tilted", "ID210 NR10", 2), ("", "ID210 NR10", 0),
        ("shifted", "ID220 NR2 IDX1", 5), ("shifted", "ID220 NR2 IDX2", -6), ("shifted", "ID220 NR2 IDX6", 30),
        ("", "ID230 NR2 IDX1", -10), ("", "ID230 NR3 IDX2", 400), ("", "ID230 NR2 IDX3", -300), ("", "ID230 NR5 IDX1", 0),
        ("moved", "ID240 NR1 IDX1", 111), ("moved", "ID240 NR1 IDX2", 62),
        ("moved", "ID240 NR1 IDX3", -200 + 13 + 80.2), ("moved", "ID240 NR8 IDX1", 111),
        ("moved", "ID270 NR1 IDX1", 11), ("moved", "ID270 NR1 IDX3", 13), ("shifted", "ID270 NR1 IDX2", 2),
        ("shifted", "ID240 NR1 IDX2", -4), ("shifted", "ID270 NR1 IDX6", -30), ("shifted", "ID240 NR1 IDX6", 0),
        ("", "ID280 NR1", 0), ("", "ID310 NR116", 0), ("", "ID320 NR1 IDX0", 1.5e9),
        ("", "ID500 NR4 IDX2", 8), ("", "ID505 NR1", 1), ("", "ID503 NR3 IDX1", 100), ("", "ID507 NR3 IDX3", -200),
        ("", "ID530 NR1", 0), ("moved", "ID530 NR1", 3), ("", "ID992 NR16", 1), ("", "ID990 NR10 IDX0", 0),
        ("", "ID992 NR10", 0),
    ],
)  # fmt: skip
def test_what_is_read(before: str, asked: str, expected: float, inside) -> None:
    run = inside(f"{BEFORE[before]}90 FN 18: SYSREAD QR1 = {asked}", SETUP)
    assert run.ok, run.alarms
    assert run.variables["QR1"] == pytest.approx(expected, abs=1e-12)


def test_every_row_is_asked_for_above() -> None:
    (mark,) = test_what_is_read.pytestmark
    asked = {tuple(float(word.lstrip("IDNRX")) for word in case[1].split()[:2]) for case in mark.args[1]}
    groups = {group for group, _ in asked}
    assert groups == {group for group, _ in ROWS} | set(TABLES)


def test_lengths_are_metric_in_a_program_in_inches(tnc) -> None:
    """The manual: the control always outputs system data in the metric system; Q114 is in the unit of the program."""
    text = (
        "0 BEGIN PGM A INCH\n1 TOOL CALL 1 Z S1000 F10\n2 L X+2 FMAX\n3 FN 18: SYSREAD Q1 = ID270 NR1 IDX1\n4 Q2 = Q114\n"
        "5 FN 18: SYSREAD Q3 = ID200 NR2\n6 FN 18: SYSREAD Q4 = ID10 NR1\n7 FN 18: SYSREAD Q5 = ID20 NR9\n"
        + SPIRAL.replace("Q201=-15", "Q201=-1") + "8 FN 18: SYSREAD Q6 = ID30 NR2\n9 END PGM A INCH\n"
    )  # fmt: skip
    run = tnc(text, mnc.Setup(tools={1: mnc.Tool(radius=2.54, length=50.8)}))
    assert run.ok, run.alarms
    found = [run.variables[f"Q{k}"] for k in range(1, 7)]
    assert found == pytest.approx([50.8, 2, 50.8, 1, 25.4, -25.4], rel=1e-15)


def test_the_travel_leads_to_the_end_of_the_axis(inside) -> None:
    """How programs retract: the limit switch of Z is read, and M91 goes there."""
    limits = mnc.Limits(travel=((-500, 500), (-500, 500), (-400, 0)))
    setup = mnc.Setup(tools=TOOLS, limits=limits, start=(0, 0, -100))
    run = inside("2 FN 18: SYSREAD Q30 = ID230 NR3 IDX3\n3 L Z+Q30 R0 FMAX M91", setup)
    assert run.ok, run.alarms
    assert run.toolpath.motion.end[-1, 2] == pytest.approx(0 - 80.2)


def test_the_reference_lies_above_the_tip_along_the_tool_axis(inside) -> None:
    """The tool axis X: its length lies along X, and Z is that of the tip."""
    run = inside(
        "2 TOOL CALL 2 X S100\n3 L X+1 Y+2 Z+3 FMAX\n4 FN 18: SYSREAD Q1 = ID240 NR1 IDX1\n"
        "5 FN 18: SYSREAD Q3 = ID240 NR1 IDX3\n6 FN 18: SYSREAD Q4 = ID20 NR3", SETUP,
    )  # fmt: skip
    assert run.ok and [run.variables[name] for name in ("Q1", "Q3", "Q4")] == [61, 3, 0], run.alarms


def test_the_spindle_of_a_feed_a_revolution(inside) -> None:
    run = inside("2 L X+5 FU0.2 M3\n3 FN 18: SYSREAD Q1 = ID20 NR9")
    assert run.ok and run.variables["Q1"] == pytest.approx(200)


def test_an_index_that_means_nothing_is_named(inside) -> None:
    run = inside("2 FN 18: SYSREAD Q1 = ID20 NR1 IDX2\n3 FN 18: SYSREAD Q2 = ID20 NR1 IDX0")
    (warning,) = run.alarms
    assert (warning.severity, warning.span[:2]) == ("warning", (3, 32)) and run.variables["Q2"] == 1


@pytest.mark.parametrize(("code", "asked"), [("M116", "ID310 NR116"), ("M128", "ID280 NR1"), ("M128", "ID310 NR128")])
def test_what_holds_for_rotary_axes_is_told(code: str, asked: str, inside) -> None:
    """-1 while it is active, 0 before and behind its end."""
    read = "FN 18: SYSREAD Q{} = " + asked
    end = f"M{int(code[1:]) + 1}"
    run = inside(f"2 {read.format(1)}\n3 {code}\n4 {read.format(2)}\n5 {end}\n6 {read.format(3)}")
    assert [run.variables[name] for name in ("Q1", "Q2", "Q3")] == [0, -1, 0]


def test_what_is_never_active_is_refused() -> None:
    """ID310 says that M144 is not active, which is true as long as it cannot be."""
    assert "M144" in CONTROL.refused


def test_a_column_of_the_tool_table_is_written(inside) -> None:
    run = inside(
        "2 FN 17: SYSWRITE ID 50 NR4 IDX2 = +0.5\n3 FN 17: SYSWRITE ID50 NR2 IDX+2 = +3.75\n4 TOOL CALL 2 Z\n"
        "5 Q1 = Q114\n6 Q2 = Q108\n7 FN 18: SYSREAD Q3 = ID50 NR4 IDX2", SETUP,
    )  # fmt: skip
    assert run.ok, run.alarms
    assert [run.variables[name] for name in ("Q1", "Q2", "Q3")] == [60.5, 3.75, 0.5]
    assert (run.tables.tools[2].dl, run.tables.tools[2].radius) == (0.5, 3.75)
    assert run.setup.tools[2].dl == 0


def test_the_tool_in_the_spindle_counts_as_it_was_called(inside) -> None:
    run = inside("2 FN 17: SYSWRITE ID 50 NR2 IDX1 = +3\n3 Q1 = Q108\n4 TOOL CALL 1 Z\n5 Q2 = Q108", SETUP)
    assert run.ok and (run.variables["Q1"], run.variables["Q2"]) == pytest.approx((4.9, 2.9))


#: A tool with a number of its own in each column that a `Tool` has; "System data" of the conversational manual of the TNC 620
#: (10/2017): NR18 is 0 for positive and -1 for negative, which TOOL.T says of M3; NR19 is 99999.9999 for R, the tool radius.
WORN = mnc.Tool(
    radius=5, length=80, corner=1, dl=0.2, dr=-0.1, teeth=3, cutting_length=25, plunge_angle=4, kind="tap", angle=118, pitch=1.25,
    locked=True, wear=mnc.Wear(0.1, 0.2, 0.03, 0.4, 0.5, 6.0, 7.0),
)  # fmt: skip
IN_COLUMNS = {
    1: 80, 2: 5, 3: 1, 4: 0.2, 5: -0.1, 7: 1, 13: 25, 14: 4, 15: 3, 16: 0.1, 17: 0.2, 18: -1, 19: 7, 20: 6, 21: 0.4, 22: 0.5,
    32: 118, 33: 1.25, 35: 0.03, 36: 2, 40: 1.25,
}  # fmt: skip
NO_PLACE = {
    6: "DR2", 8: "RT", 9: "TIME1", 10: "TIME2", 11: "CUR.TIME", 12: "PLC", 28: "NMAX", 34: "LIFTOFF", 37: "TP_NO", 39: "ACC",
}  # fmt: skip
TABLE = mnc.Setup(tools={1: TOOLS[1], 4: WORN, 5: mnc.Tool(hand="left"), 9: mnc.Tool()}, start=(0, 0, 0))


@pytest.mark.parametrize("group", ["ID50 NR{} IDX4", "ID950 NR{}"])
def test_every_column_of_the_tool_table_is_read(group: str, inside) -> None:
    lock = "FN 17: SYSWRITE ID50 NR7 IDX4 = +"
    call = "" if "IDX" in group else f"2 {lock}0\n3 TOOL CALL 4 Z S500\n4 {lock}1\n"
    run = inside(call + "\n".join(f"{k} FN 18: SYSREAD Q{k} = {group.format(k)}" for k in IN_COLUMNS), TABLE)
    assert run.ok, run.alarms
    assert {k: run.variables[f"Q{k}"] for k in IN_COLUMNS} == pytest.approx(IN_COLUMNS, abs=1e-12)
    assert not [alarm for alarm in run.alarms if "SYSREAD" in alarm.message]


def test_what_a_new_tool_and_a_left_one_have_in_their_columns(inside) -> None:
    """R-OFFS is R by itself; a left one turns with M4, +."""
    run = inside("2 FN 18: SYSREAD Q1 = ID50 NR19 IDX9\n3 FN 18: SYSREAD Q2 = ID50 NR18 IDX5", TABLE)
    assert run.ok and (run.variables["Q1"], run.variables["Q2"]) == (99999.9999, 0)


def test_a_tool_is_copied_column_by_column(inside) -> None:
    """As workshops copy a row: what is read of one and written to another is the same tool."""
    lines = [f"FN 18: SYSREAD Q1 = ID50 NR{k} IDX4\nFN 17: SYSWRITE ID50 NR{k} IDX9 = Q1" for k in IN_COLUMNS]
    run = inside("\n".join(lines), TABLE)
    assert run.ok, run.alarms
    assert run.tables.tools[9] == dataclasses.replace(WORN, number=run.tables.tools[9].number)


@pytest.mark.parametrize(("number", "title"), NO_PLACE.items())
def test_a_column_that_tools_here_do_not_have(number: int, title: str, inside) -> None:
    """An empty field until the program writes it, of this tool alone; both are told."""
    read = "FN 18: SYSREAD Q{} = ID50 NR{} IDX{}"
    run = inside(
        f"2 {read.format(1, number, 1)}\n3 FN 17: SYSWRITE ID50 NR{number} IDX1 = +3\n4 {read.format(2, number, 1)}\n"
        f"5 {read.format(3, number, 4)}", TABLE,
    )  # fmt: skip
    assert run.ok and [run.variables[name] for name in ("Q1", "Q2", "Q3")] == [0, 3, 0]
    told = [(alarm.severity, alarm.span.line) for alarm in run.alarms]
    assert told == [("warning", 3), ("warning", 4), ("warning", 6)] and all(title in alarm.message for alarm in run.alarms)


@pytest.mark.parametrize(
    ("number", "expected"),
    [
        (0, "05.09.2018 07:08:09"), (1, "5.09.2018 7:08:09"), (4, "2018-09-05 07:08:09"), (8, "05.09.2018"), (12, "18-09-05"),
        (13, "07:08:09"), (15, "7:08"),
    ],
)  # fmt: skip
def test_the_time_as_a_text(number: int, expected: str, inside) -> None:
    """SYSSTR ID321 has the formats of %time in cycle 225 (12.6); 17779 days after the first of 1970 is 5 September 2018."""
    clock = 17779 * 86400 + 7 * 3600 + 8 * 60 + 9
    run = inside(f'2 Q5 = {number}\n3 QS1 = "T: " || SYSSTR( ID321 NRQ5 )', clock=clock)
    assert run.ok and run.variables["QS1"] == f"T: {expected}"


def test_the_name_of_the_tool_as_a_text(inside) -> None:
    run = inside("2 QS1 = SYSSTR(ID 10950 NR 1)\n3 TOOL CALL 2 Z\n4 QS2 = SYSSTR( NR1 ID10950 )\n5 Q1 = STRLEN ( SRC_QS2 )")
    assert run.ok and [run.variables[name] for name in ("QS1", "QS2", "Q1")] == ["end mill 10", "drill 8", 7]


def test_a_program_that_asks_whether_it_is_simulated(inside) -> None:
    """Programs jump over probing where ID992 NR16 is 0; the setting says what they are told."""
    blocks = "2 FN 18: SYSREAD Q1 = ID992 NR16\n3 FN 9: IF +Q1 EQU +0 GOTO LBL 9\n4 L X+5\n5 LBL 9\n6 L Y+5"
    assert len(inside(blocks).toolpath.motion) == 2 and len(inside(blocks, execution=False).toolpath.motion) == 1


def test_a_warm_up_goes_ten_millimetres_inside_its_limits(tnc) -> None:
    """In the manner of warm-up programs: limits into QL parameters, targets from them, moves with M91."""
    limits = [(-500, 1000), (-250, 300), (-400, 0)]
    reads = "".join(
        f"FN 18: SYSREAD QL{2 * k + side} = ID230 NR{2 + side} IDX{k + 1}\nQL{10 + 2 * k + side} = QL{2 * k + side} {sign} 10\n"
        for k in range(3) for side, sign in enumerate("+-")
    )  # fmt: skip
    text = (
        f"0 BEGIN PGM W MM\nTOOL CALL 2 Z S500\n{reads}FN 12: IF +QL0 LT -9999 GOTO LBL 9\n"
        "L Z+QL15 R0 FMAX M91\nL X+QL10 Y+QL12 R0 FMAX M91\nLBL 1\nL X+QL11 Y+QL13 R0 F2000 M91\nL X+QL10 Y+QL12 R0 F2000 M91\n"
        "CALL LBL 1 REP 1\nLBL 9\nEND PGM W MM\n"
    )
    run = tnc(text, mnc.Setup(tools=TOOLS, limits=mnc.Limits(travel=tuple(limits)), start=(0, 0, -100)))
    assert run.ok, run.alarms
    low, high = [-490, -240, -10 - 60], [990, 290, -10 - 60]  # the tip is 60 below the spindle
    assert run.toolpath.motion.end[1:].tolist() == [low, high, low, high, low]


@pytest.mark.parametrize(("length", "error"), [(60.5, False), (60, True)])
def test_a_tool_without_a_measured_length_is_found(length: float, error: bool, tnc) -> None:
    """In the manner of tool checks: a length that is a whole number was never measured."""
    text = (
        "0 BEGIN PGM T MM\n1 TOOL CALL 2 Z S500\n2 FN 18: SYSREAD Q1 = ID20 NR1\n3 FN 18: SYSREAD Q4 = ID50 NR1 IDXQ1\n"
        "4 Q5 = INT Q4\n5 FN 10: IF +Q4 NE +Q5 GOTO LBL 1\n6 FN 14: ERROR = 45\n7 LBL 1\n8 L Z+50 FMAX\n9 END PGM T MM\n"
    )
    run = tnc(text, mnc.Setup(tools={2: mnc.Tool(radius=4, length=length)}))
    assert run.ok is not error
    assert [alarm.message for alarm in run.alarms] == ["FN 14: the program stops with error 45"] * error
