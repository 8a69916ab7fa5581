"""Several faults in one program are told at once: those below the one that stops the run are found by reading alone.

The faults are put into programs by hand, and their lines and columns counted there. That nothing right is blamed is shown
by all programs that run: none of their blocks is a fault before it was obeyed.
"""

from pathlib import Path

import pytest
from tools.together import deep_but_one_in

import mnclab
from mnclab import Setup
from mnclab.running.interpreter import Interpreter
from mnclab.runs.faults_ahead import faults_ahead

pytestmark = pytest.mark.lint
ROOT = Path(__file__).parents[2]
FOLDERS = ("data/programs", "tests/programs", "tests/programs_of_shops")
PROGRAMS = sorted(
    path for folder in FOLDERS for path in ROOT.glob(f"{folder}/*/*") if path.is_file() and path.suffix != ".expected"
)


def told(text, control, severity="alarm", **setup):
    found = mnclab.run(text.replace("|", "\n") + "\n", control, Setup(**setup)).alarms
    return [(alarm.span.line, alarm.span.column, alarm.message) for alarm in found if alarm.severity == severity]


FIVE = {
    # missing spindle, wrong address, arc without radius, wrong number, unknown G code
    "mnc": (
        "T1|G1 X5 F100|G1 Q5|G2 X20|G1 X2O|G999|M30",
        [(3, 4, "Q5 has no meaning in this block (G1 does not take Q)"), (5, 6, "O needs a number"),
         (6, 1, "G999 is not a function of this control")],
        [(2, 1, "the tool moves at feed while the spindle stands"),
         (4, 1, "G2 without R and without I J K is obeyed as a straight line")],
    ),
    "g43": (
        "T1 M6|G1 X5 F100|G1 E5|G2 X20|G1 X2O|G999|M30",
        [(3, 4, "E5 has no meaning in this block (G1 does not take E)"), (4, 1, "an arc needs R or I J K"),
         (5, 6, "O needs a number"), (6, 1, "G999 is not a function of this control")],
        [(2, 1, "the tool moves at feed while the spindle stands")],
    ),
    "jnc-t01": (
        "G94 F100|G1 Z-5|G1 I5|G2 X20|G1 X2O|G999",
        [(3, 4, "I5 has no meaning in this block (G1 does not take I)"), (4, 1, "G2 needs R, or I or K"),
         (5, 6, "O needs a number"), (6, 1, "G999 is not a function of this control")],
        [(2, 1, "the tool moves at feed while the spindle stands")],
    ),
    "nc-31": (
        "F20|X4000|Z-200|G2|X2O|G99",
        [(2, 1, "a feed per revolution needs a turning spindle"),
         (4, 1, "G2 is refused: arcs stand in a chapter that the source does not have"), (5, 3, "O needs a whole number"),
         (6, 1, "G99 is not a function of this control")],
        [],
    ),
    "tnc-620": (
        "0 BEGIN PGM A MM|1 TOOL CALL 1 Z S1000|2 L X+5 R0 F100|3 C X+20 Y+0|4 L X+9 Q5|5 CYCL DEF 999|6 L X+1 P5|7 END PGM A MM",
        [(4, 1, "C needs a circle centre: no CC was programmed"), (5, 9, "'Q' has no meaning here"),
         (6, 1, "CYCL DEF 999 is not a function of this control"), (7, 9, "'P' has no meaning here")],
        [(3, 1, "the tool moves at feed while the spindle stands")],
    ),
}  # fmt: skip


@pytest.mark.parametrize("control", FIVE)
def test_five_faults_of_a_student(control):
    text, alarms, warnings = FIVE[control]
    for severity, expected in (("alarm", alarms), ("warning", warnings)):
        found = [each for each in told(text, control, severity) if "M30: " not in each[2]]
        assert [each[:2] for each in found] == [each[:2] for each in expected], found
        assert all(one[2].startswith(other[2]) for one, other in zip(found, expected, strict=True)), found


STOP = "G999|"  # line 1 stops the run, what follows is read alone
TNC = "BEGIN PGM A MM|CYCL DEF 999|{}|END PGM A MM"
HOLE = "Q200=2 Q201=-5 Q206=150 Q202={} Q210=0 Q203=0 Q204=50 Q211=0"


@pytest.mark.parametrize(
    ("control", "text", "expected"),
    [
        ("mnc", STOP + "S500 M3 F0", [(2, 9, "F (feed rate) must be greater than 0, got 0")]),
        ("mnc", STOP + "S-5 M3", [(2, 1, "S (spindle speed) must be at least 0, got -5")]),
        ("mnc", STOP + "T88", [(2, 1, "T88 has no row in the tool table")]),
        ("mnc", STOP + "G4", [(2, 1, "G4 P (dwell) is missing")]),
        ("mnc", STOP + "G4 P0", [(2, 4, "G4 P (dwell) must be at least 0.01 and at most 99999.999 s, got 0")]),
        ("mnc", STOP + "G302 X5 Y0 Q2 D1", [(2, 6, "X5 has no meaning in this block (G302 does not take X)")]),
        ("mnc", STOP + "G0 G1 X5", [(2, 4, "G1 and G0 are of one group: only one function of a group may stand in a block")]),
        ("mnc", STOP + "G83 X5 Y5 Z-5 R2 K0 F100", [(2, 18, "G83 K (depth of one peck) must be greater than 0, got 0")]),
        ("g43", STOP + "#1=5|G1 X5 E7", [(3, 7, "E7 has no meaning in this block (G1 does not take E)")]),
        ("jnc-t01", STOP + "F0", [(2, 1, "F")]),
        ("tnc-620", TNC.format("CALL LBL 7"), [(3, 10, "label 7 does not exist")]),
        ("tnc-620", TNC.format('CALL LBL "ROW"'), [(3, 10, 'label "ROW" does not exist')]),
        ("tnc-620", TNC.format("CYCL DEF 200 DRILLING " + HOLE.format(-5)),
         [(3, 47, "CYCL DEF 200 Q202 (infeed depth) must be at least 0 and at most 99999.9999, got -5")]),
        ("tnc-620", TNC.format("CYCL DEF 200 DRILLING " + HOLE.format("").replace("Q202= ", "")),
         [(3, 1, "CYCL DEF 200 Q202 (infeed depth) is missing")]),
        # a sub-program is read where it is called
        ("tnc-620", TNC.format("CALL LBL 1|M30|LBL 1|CYCL DEF 998|LBL 0"),
         [(6, 1, "CYCL DEF 998 is not a function of this control")]),
    ],
)  # fmt: skip
def test_what_reading_tells(control, text, expected):
    _, *more = told(text, control)
    assert [(line, column) for line, column, _ in more] == [each[:2] for each in expected], more
    assert all(message.startswith(sentence) for (*_, message), (*_, sentence) in zip(more, expected, strict=True)), more


@pytest.mark.parametrize(
    ("control", "text"),
    [
        ("g43", STOP + "#1=5|G1 X#1 E7"),  # a formula may leave its word out
        ("g43", STOP + "X5 R2"),  # under G81 its level
        ("g43", STOP + "GOTO 9|G998|N9 G0 X5"),  # a jump passes over it
        ("g43", STOP + "IF [#1 EQ 5] GOTO 9|G998|N9 G0 X5"),
        ("g43", STOP + "M30|G998"),
        ("g43", STOP + "G10 L1 P88 R5|T88 M6"),  # the row is written first
        ("tnc-620", TNC.format("TOOL DEF 88 L+0 R+5|TOOL CALL 88 Z S500")),
        ("tnc-620", TNC.format("FN 9: IF +1 EQU +1 GOTO LBL 1|CYCL DEF 998|LBL 1")),
        ("tnc-620", TNC.format("M30|LBL 1|CYCL DEF 998|LBL 0")),  # nobody calls it
        ("tnc-620", TNC.format("L X+2O|CALL LBL 1|LBBL 1|LBL 0")),  # its label stands in a block that was not understood
    ],
)
def test_what_reading_does_not_tell(control, text):
    read = {alarm.span.line for alarm in mnclab.read(text.replace("|", "\n") + "\n", control).alarms}
    _, *more = told(text, control)
    assert {line for line, *_ in more} <= read, more


@pytest.mark.parametrize(("control", "severity"), [("g43", "alarm"), ("mnc", "warning")])
def test_an_arc_in_force_where_the_run_stopped_says_nothing_of_straight_lines_below(control, severity):
    begin = "G17 G90 G54|T1|G0 X0 Y0 S500 M3|G2 X10 Y10 R10 F100|G999|" + ("" if control == "mnc" else "G43 H1|")
    where = begin.count("|")
    assert all(line < where + 1 for line, *_ in told(begin + "G1 X20|X30|Y30", control, severity))
    assert where + 3 in [line for line, *_ in told(begin + "G1 X20|X30|G3 X40 Y20|Y30", control, severity)]


def test_a_skipped_block_is_no_fault():
    text = STOP + "/ G998|G0 X5"
    assert len(told(text, "mnc")) == 2 and len(told(text, "mnc", settings={"block_skip": True})) == 1


def test_a_spindle_that_nothing_starts_is_told_though_the_run_never_came_there():
    still = "the tool moves at feed while the spindle stands"
    assert told("G4|S500|G0 Z5|G1 X5 F100", "mnc", "warning") == [(4, 1, still)]
    for text in ("G4|S500 M3|G0 Z5|G1 X5 F100", "G4|S500 M33|G1 X5 F100", "G4|G0 X5"):  # M33 may have been M3
        assert not told(text, "mnc", "warning"), text
    assert not told("G4|G1 X5 F100", "mnc", "warning", settings={"lint": "off"})


@pytest.mark.parametrize(("block", "count"), [("G1 X1O", 1), ("G1 X10 Q5", 1), ("M33", 0), ("S500 MO3", 0)])
def test_a_faulty_block_that_may_have_been_meant_to_turn_the_spindle(block, count):
    found = told(f"T1|{block}|G1 X5 F100|M30", "mnc", "warning")
    assert [each[:2] for each in found] == [(3, 1)] * count, found


CONTOUR = """0 BEGIN PGM MODEL MM
1 DECLARE CONTOUR QC1 = "SHAPE"
2 QC10 = QC1
3 END PGM MODEL MM
"""
SHAPE = "0 BEGIN PGM SHAPE MM\n" + "1 L X+5\n" * 30 + "2 L X+5 Q5\n3 END PGM SHAPE MM\n"


def test_below_a_stop_in_another_program_that_is_no_call():
    """The place of the stop is one of the other program, far beyond the end of this one."""
    text = (
        '0 BEGIN PGM A MM|1 TOOL CALL 1 Z S1000|2 CALL LBL 1|3 CYCL DEF 999|4 STOP M30|5 LBL 1|6 SEL CONTOUR "MODEL"'
        "|7 CYCL DEF 20 CONTOUR DATA Q1=-5 Q2=1 Q3=0 Q4=0 Q5=0 Q6=2 Q7=50 Q8=1 Q9=1|8 CYCL CALL M3|9 L X+1 P5|10 LBL 0"
        "|11 END PGM A MM"
    )
    files = {"MODEL.H": CONTOUR, "SHAPE.H": SHAPE}
    run = mnclab.run(text.replace("|", "\n") + "\n", "tnc-620", files=files)
    assert [alarm.span.line for alarm in run.alarms if alarm.severity == "alarm" and not alarm.span.program][:2] == [4, 10]


def test_the_first_alarm_is_still_the_one_that_is_raised():
    with pytest.raises(mnclab.Alarm, match="G999 is not a function"):
        mnclab.run("G999\nG998\n", "mnc", strict=True)


@pytest.mark.parametrize("path", deep_but_one_in(4, PROGRAMS), ids=lambda path: "/".join(path.parts[-3:]))
def test_a_program_that_runs_has_no_fault_ahead(path):
    control = mnclab.controls[path.parent.name]
    program, ran = mnclab.read(path, control.name), mnclab.run(path, control.name)
    found = faults_ahead(Interpreter(control, Setup().kept(control.magazine), program))
    known = {alarm.message for alarm in ran.alarms}
    assert not ran.ok or all(alarm.severity == "warning" and alarm.message in known for alarm in found), found
