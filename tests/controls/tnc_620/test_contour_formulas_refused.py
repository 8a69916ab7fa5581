"""Faults of contour formulas stand in the program that has them: the definitions, the description of a contour, or the caller."""

from __future__ import annotations

import pytest

import mnclab
from mnclab import Setup, Tool

SQUARE = ["L X+0 Y+0", "L X+40", "L Y+40", "L X+0", "L Y+0"]
A = 'DECLARE CONTOUR QC1 = "A"'
B = A.replace("QC1", "QC2")
LOST = "tool, spindle and M functions"


def program(name: str, lines: list[str]) -> str:
    return "\n".join((f"BEGIN PGM {name} MM", *lines, f"END PGM {name} MM", ""))


def run_of(model: list[str], described: list[str], main: str = 'SEL CONTOUR "MODEL"') -> mnclab.Run:
    files = {"MODEL.H": program("MODEL", model), "A.H": program("A", described)}
    return mnclab.run(program("MAIN", ["TOOL CALL 1 Z S500", main]), "tnc-620", Setup(tools={1: Tool(radius=2)}, files=files))


#: Blocks of the definitions after `BEGIN PGM`; the line and the column of the fault there, and what is said.
DEFINITIONS = [
    ([A, "QC10 = QC1 | QC2"], (3, 14), "QC2 is no contour yet (write DECLARE CONTOUR QC2 = … before the formula)"),
    ([A, "QC10 = QC10 | QC1"], (3, 8), "QC10 is no contour yet"),
    ([A, A, "QC10 = QC1"], (3, 17), "QC1 is a contour already (take another designator)"),
    ([A, "QC10 = QC1", A.replace("QC1", "QC10")], (4, 17), "QC10 is a contour already"),
    ([A, "QC1 = QC1"], (3, 1), "QC1 is a contour already"),
    ([A, "QC10 = ( ( QC1 )"], (3, 8), "this bracket is not closed"),
    ([A, "QC10 = QC1 \\"], (3, 12), "a designator is missing at the end of the formula"),
    ([A, "QC10 = ("], (3, 8), "a designator is missing at the end of the formula"),
    ([A, "QC10 ="], (3, 1), "a designator is missing at the end of the formula"),
    ([A, "QC10 = QC1 \\ QC1"], (3, 1), "QC10 encloses nothing"),
    ([A, B, "QC10 = ( QC1 & QC2 ) ^ QC1"], (4, 1), "QC10 encloses nothing"),
    ([A + " DEPTH-1", "QC10 = QC1"], (2, 27), "DECLARE CONTOUR QC1 DEPTH (depth of the contour) must be at least 0, got -1"),
    (['DECLARE CONTOUR QC1 = "NONE"', "QC10 = QC1"], (2, 23), "DECLARE CONTOUR QC1 NONE: there is no program of this name"),
    (["DECLARE CONTOUR QC1 = LBL 5", "QC10 = QC1"], (2, 27), "label 5 does not exist"),
    (["DECLARE CONTOUR QC1 = QS7", "QC10 = QC1"], (2, 23), "no text was given to QS7"),
    (["DECLARE CONTOUR QC1 ="], (2, 17), "DECLARE CONTOUR QC1 needs the name of a program, or LBL and a label"),
    (["DECLARE CONTOUR"], (2, 1), "DECLARE CONTOUR needs a designator"),
    (['DECLARE CONTOUR QC1 = "MODEL"'], (2, 23), "is running already"),
    (['SEL CONTOUR "A"'], (2, 13), "SEL CONTOUR cannot stand in a program of contour definitions"),
    (['CONTOUR DEF P1 = "A"'], (2, 13), "CONTOUR DEF cannot stand in a program of contour definitions"),
    ([A, "QC10 = QC1", "L X+5 R0"], (4, 1), "SEL CONTOUR MODEL: a program of contour definitions moves nothing"),
    (["TOOL CALL 1 Y", A], (3, 23), "DECLARE CONTOUR QC1: contours are built for the tool axis Z alone"),
]  # fmt: skip


@pytest.mark.parametrize(("model", "at", "says"), DEFINITIONS, ids=[f"{k} {d[2][:30]}" for k, d in enumerate(DEFINITIONS)])
def test_a_fault_of_the_definitions(model: list[str], at: tuple[int, int], says: str) -> None:
    run = run_of(model, SQUARE)
    (alarm,) = [alarm for alarm in run.alarms if alarm.severity == "alarm"]
    assert (alarm.source.name, alarm.span[:2]) == ("MODEL.H", at)
    assert says in f"{alarm.message} ({alarm.hint})"


#: Blocks of the description after `BEGIN PGM`, the same of them.
DESCRIPTIONS = [
    (["L X+0", "L X+40 Y+0", "L Y+40"], (2, 1), "the contour of A must begin with both coordinates of the plane"),
    (["L X+0 Y+0"], (2, 1), "A describes no contour"),
    (["L X+0 Y+0", "L X+0 Y+0 Z-5"], (2, 1), "the contour of A encloses nothing: it is a point"),
    (["L X+0 Y+0", "L X+40", "L X+20"], (2, 1), "the contour of A encloses nothing"),
    (["L X+0 Y+0", "L X+40 Y+40", "L X+40 Y+0", "L X+0 Y+30"], (5, 1), "crosses or touches itself near (17.143, 17.143)"),
    (["CC X+0 Y+0", "L X+20 Y+0", "C X+0 Y+20 DR+", "L Y-5", "L X+20 Y+15"], (6, 1), "crosses or touches itself near"),
    (["L X+0 Y+0", "TOOL CALL 1 X", "L Y+40 Z+10", "L Z+0"], (4, 1), "the contour of A leaves the plane XY"),
    (["L X+0 Y+0", "L X+Q99", "L Y+40"], (3, 5), "no value was given to Q99"),
    (["L X+0 Y+0", "L X+", "L Y+40"], (3, 3), "X needs a number"),
    (["L X+0 Y+0", "L X+40", "RND R45", "L Y+40", "L X+0"], (4, 1), "does not fit"),
    (["L X+0 Y+0", "FL X+40", "FL LEN5"], (3, 1), "free contour"),
    ([A, *SQUARE], (2, 17), "DECLARE CONTOUR stands in a program of contour definitions alone"),
    (["QC10 = QC1", *SQUARE], (2, 1), "QC10 = stands in a program of contour definitions alone"),
    (["CALL PGM A", *SQUARE], (2, 10), "is running already"),
    (["CALL LBL 4", *SQUARE], (2, 10), "label 4 does not exist"),
    ([*SQUARE, "CYCL CALL"], (7, 1), "CYCL CALL cannot stand in a contour that a cycle reads"),
]  # fmt: skip


@pytest.mark.parametrize(("described", "at", "says"), DESCRIPTIONS, ids=[f"{k} {d[2][:30]}" for k, d in enumerate(DESCRIPTIONS)])
def test_a_fault_of_a_description(described: list[str], at: tuple[int, int], says: str) -> None:
    """Wherever it is named: by the definitions, or by CONTOUR DEF in the program itself."""
    for main in ('SEL CONTOUR "MODEL"', 'CONTOUR DEF P1 = "A"'):
        run = run_of([A, "QC10 = QC1"], described, main)
        (alarm,) = [alarm for alarm in run.alarms if alarm.severity == "alarm"]
        assert (alarm.source.name, alarm.span[:2]) == ("A.H", at)
        assert says in alarm.message


def test_nothing_described_at_all() -> None:
    """There is no block to point at: the one that names the program has the alarm."""
    (alarm,) = run_of([A, "QC10 = QC1"], []).alarms
    assert (alarm.source.name, alarm.span[:2], alarm.message) == ("MODEL.H", (2, 23), "A describes no contour")


def test_faults_of_the_program_that_selects() -> None:
    """No formula in the definitions, and a program that selects itself."""
    (alarm,) = run_of([A], SQUARE).alarms
    assert alarm.message == "SEL CONTOUR MODEL: the program has no contour formula" and alarm.span[:3] == (3, 13, 7)
    text = program("MAIN", ['SEL CONTOUR "MAIN"'])
    (alarm,) = mnclab.run(text, "tnc-620", Setup(files={"MAIN.H": text})).alarms
    assert "SEL CONTOUR cannot stand in a program of contour definitions" in alarm.message
    assert alarm.source.name == "MAIN.H" and alarm.span.line == 2


def test_remarks() -> None:
    """Mixed operators without brackets, a depth that is missing, a part deeper than P1, M functions of the definitions."""
    run = run_of([A + " DEPTH3", B, "M3", "QC10 = QC1 | QC2 & QC1"], SQUARE)
    assert run.ok and [(a.source.name, a.span[:2], a.severity, a.message) for a in run.alarms] == [
        ("program", (3, 13), "warning", f"SEL CONTOUR MODEL: {LOST} of a program of contour definitions do not stay"),
        ("MODEL.H", (3, 17), "warning", "QC2 has no DEPTH, although another contour has one: it counts as DEPTH0"),
        ("MODEL.H", (5, 18), "warning", "| and & without brackets: they are of one rank and joined from left to right"),
    ]  # fmt: skip
    label = "LBL 1\nL X+5 Y+5\nL X+9\nL Y+9\nLBL 0"
    run = run_of([], SQUARE, f'CONTOUR DEF P1 = "A" DEPTH5 P2 = "A" DEPTH7 P3 = "A" I4 = LBL 1\nM2\n{label}')
    assert run.ok and [(a.span[:2], a.message) for a in run.alarms] == [
        ((3, 38), "CONTOUR DEF P2 is deeper than P1, which must be the deepest pocket"),
        ((3, 45), "CONTOUR DEF P3 is deeper than P1, which must be the deepest pocket"),
    ]  # fmt: skip
