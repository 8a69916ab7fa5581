"""What the course of a program, parameters and texts refuse: the alarm, its line and its column.

Blocks stand behind BEGIN PGM and TOOL CALL 1 (radius 5, feed 100) and so begin in line 3; S is a program that can be called.
"""

from __future__ import annotations

import pytest

import mnclab as mnc

SUB = "0 BEGIN PGM S MM\n1 L X+1\n2 M30\n3 END PGM S MM\n"
NO_PROGRAM = "there is no program of this name (Setup(files=…) has iso.i, s; a program without a file has no folder)"
CYCLE_12 = "2 CYCL DEF 12.0 PGM CALL\n3 CYCL DEF 12.1 PGM {}\n"
FN9 = "(for example FN 9: IF +Q1 EQU +Q3 GOTO LBL 5)"

REFUSED = [
    # FN
    ("2 FN 0: Q1 = Q2", 3, 14, "no value was given to Q2"),
    ("2 FN 0: Q1", 3, 11, "FN 0 needs a Q parameter and = (FN 0: Q1 = +2)"),
    ("2 FN 0: 5 = 3", 3, 9, "FN 0 needs a Q parameter and = (FN 0: Q1 = +2)"),
    ("2 FN 0: QS1 = 3", 3, 9, "FN 0 gives a number: QS1 cannot hold it (take a Q, QL or QR parameter)"),
    ("2 FN 1: Q1 = +1", 3, 14, "the function must have the form FN 1: Q1 = +2 + +3"),
    ("2 FN 2: Q1 = 3 - 4 - 5", 3, 14, "the function must have the form FN 2: Q1 = +2 - +3"),
    ("2 FN 4: Q1 = +5 DIV +Q2", 3, 22, "no value was given to Q2"),
    ("2 FN 4: Q1 = +5 / 0", 3, 17, "division by zero at /"),
    ("2 FN 6: Q1 = SIN(30)", 3, 14, "the function must have the form FN 6: Q1 = SIN -Q5"),
    ("2 FN 8: Q1 = +5 LEN", 3, 20, "a number or a Q parameter was expected (for example FN 8: Q1 = +5 LEN +4)"),
    ("2 FN 8: Q1 = +5 + +4", 3, 14, "the function must have the form FN 8: Q1 = +5 LEN +4"),
    ("2 FN 13: Q1 = +0 ANG +0", 3, 15, "FN 13: two sides of length 0 have no angle"),
    ("2 FN 14: ERROR = 1200", 3, 18, "FN 14 ERROR must be a whole number from 0 to 1199, got 1200"),
    ("2 FN 14: 1000", 3, 10, "FN 14 needs ERROR = and a number (for example FN 14: ERROR = 1000)"),
    ("2 FN 17: SYSWRITE ID 990 NR 5 = +1", 3, 19, "FN 17: SYSWRITE ID990 NR5 is not built yet (ID990 NR6 is)"),
    ("2 FN 17: SYSWRITE ID 990 = +1", 3, 26, "NR is missing (for example FN 17: SYSWRITE ID 990 NR 6 = +1)"),
    ("2 FN 18: SYSREAD Q1 = ID990 NR6", 3, 23, "FN 18: SYSREAD ID990 NR6 IDX1 is not built yet, or has no value"),
    ("2 FN 18: SYSREAD Q1 = ID210 NR4 IDX9", 3, 23, "FN 18: SYSREAD ID210 NR4 IDX9 is not built yet, or has no value"),
    ("2 FN 18: SYSREAD Q1 = NR4", 3, 23, "ID is missing (for example FN 18: SYSREAD Q25 = ID210 NR4 IDX3)"),
    ("2 FN 19: PLC=+10/+Q3", 3, 1, "FN 19 is refused: values to the PLC, not built yet"),
    ("2 FN 26: TABOPEN A.TAB", 3, 1, "FN 26 is refused: opening a table, not built yet"),
    ("2 FN 99: Q1 = 3", 3, 1, "FN 99 is not a function of this control (near: FN 9)"),
    # parameters
    ("2 QL500 = 3", 3, 3, "QL500 does not exist: Q0 to Q1999, QL0 to QL499 and QR0 to QR499 are allowed"),
    ("2 FN 0: QR500 = 3", 3, 9, "QR500 does not exist: Q0 to Q1999, QL0 to QL499 and QR0 to QR499 are allowed"),
    ('2 QS2000 = "A"', 3, 3, "QS2000 does not exist: QS0 to QS1999 are allowed"),
    ("2 Q108 = 3", 3, 3,
     "Q108 (radius of the active tool with its deltas) is kept by the control and cannot be assigned (take another parameter)"),
    ("2 FN 0: Q113 = 1", 3, 9,
     "Q113 (unit of the main program) is kept by the control and cannot be assigned (take another parameter)"),
    ("2 Q1 =", 3, 7, "Q1 = needs a value"),
    ("2 Q1 = 2 +", 3, 10, "the expression ends where a number or a variable was expected"),
    ("2 Q1 = 2 MOD 3", 3, 10, "an operator was expected before MOD"),
    ("2 Q1 = 2 ^ 0.5 / (1 - 1)", 3, 16, "division by zero at /"),
    ("2 Q1 = ASIN 2", 3, 8, "ASIN of 2 has no real value"),
    ("2 QC1 = QC2 | QC3", 3, 1, "QC is refused: contour formula, not built yet"),
    # texts
    ('2 Q1 = "A"', 3, 8, "Q1 holds a number, not a text (texts stand in QS parameters)"),
    ("2 QS1 = 5", 3, 9, "a text in quotes or a QS parameter was expected, found '5'"),
    ("2 QS1 = QS2", 3, 9, "no text was given to QS2"),
    ('2 QS1 = "A" "B"', 3, 13, "|| was expected between two texts"),
    ("2 DECLARE STRING Q1 = 5", 3, 18, 'DECLARE STRING needs a QS parameter and = (for example DECLARE STRING QS1 = "A")'),
    ('2 Q1 = TONUMB ( SRC_"8A" )', 3, 8, 'TONUMB needs a text that is one number, got "8A"'),
    ('2 Q1 = STRLEN(SRC_"A") + 1', 3, 24, "nothing may follow STRLEN ( … ) here (calculate in a block of its own)"),
    ('2 Q1 = CFGREAD ( KEY_QS1 TAG_QS2 ATR_"A" )', 3, 8, "CFGREAD is refused: machine parameters are not built yet"),
    ("2 QS1 = SYSSTR ( ID321 NR 8 )", 3, 9, "SYSSTR is refused: system texts are not built yet"),
    # jumps
    ("2 FN 9: Q1 EQU 3", 3, 9, f"FN 9 needs IF {FN9}"),
    ("2 FN 9: IF EQU +3 GOTO LBL 5", 3, 12, f"a number or a Q parameter was expected {FN9}"),
    ("2 FN 9: IF +1 GT +3 GOTO LBL 5", 3, 15, f"FN 9 compares with EQU {FN9}"),
    ("2 FN 10: IF +1 NE +3 LBL 5", 3, 22, "GOTO LBL is missing (for example FN 10: IF +Q1 NE +Q3 GOTO LBL 5)"),
    ("2 FN 10: IF Q1 IS DEFINED GOTO LBL 5", 3, 16,
     "FN 10 compares with NE (for example FN 10: IF +Q1 NE +Q3 GOTO LBL 5)"),
    ("2 FN 9: IF +1 EQU +3 GOTO LBL 5", 3, 31, "label 5 does not exist (this program has no labels)"),
    ("2 LBL 1\n3 FN 11: IF +1 GT +0 GOTO LBL 5", 4, 31, "label 5 does not exist (labels of this program: 1)"),
    ("2 FN 12: IF +1 LT +3 GOTO LBL 0", 3, 31,
     "FN 12 GOTO LBL 0: LBL 0 is the end of a subprogram and no place to go to"),
    ("2 FN 9: IF +Q1 EQU +3 GOTO LBL 1\n3 LBL 1", 3, 13, "no value was given to Q1"),
    ("2 FN 9: IF +1 EQU +1 GOTO LBL QS1", 3, 31, "no text was given to QS1"),
    ("2 FN 9: IF +1 EQU +1 GOTO LBL 1 X5\n3 LBL 1", 3, 33, "X5 has no meaning in this block"),
    # labels
    ('2 LBL "A"\n3 LBL "A"', 4, 7, 'LBL "A" is set twice (a label stands for one place in the program)'),
    ('2 LBL ""', 3, 7, "the name of a label is empty"),
    ("2 LBL QS1", 3, 7, 'a label must be a whole number or a name in quotes (for example LBL 1 or LBL "HOLES")'),
    ("2 LBL 1 X", 3, 9, "X needs a number"),
    ('2 CALL LBL "B"', 3, 12, 'label "B" does not exist (this program has no labels)'),
    ('2 QS1 = "B"\n3 CALL LBL QS1', 4, 12, 'label "B" does not exist (this program has no labels)'),
    ("2 CALL LBL 1 REP\n3 LBL 1", 3, 14, "REP needs a number"),
    ("2 LBL 1\n3 CALL LBL 1 REP -2", 4, 14, "REP-2 has no meaning in this block"),
    # other programs
    ("2 CALL PGM", 3, 11, "CALL PGM needs the name of a program"),
    ("2 CALL PGM X5", 3, 12, f"CALL PGM X5: {NO_PROGRAM}"),
    ("2 CALL PGM ISO.I", 3, 12, "CALL PGM ISO.I: DIN/ISO programs (.I) are not built yet"),
    ("2 CALL SELECTED PGM", 3, 1, 'CALL SELECTED PGM: no program was chosen (write SEL PGM "NAME" before it)'),
    ("2 SEL PGM\n", 3, 10, "SEL PGM needs the name of a program"),
    ("2 SEL PGM QS1", 3, 11, "no text was given to QS1"),
    ('2 SEL PGM "X5"\n3 CALL SELECTED PGM', 4, 1, f"CALL SELECTED PGM X5: {NO_PROGRAM}"),
    (CYCLE_12.format("X5") + "4 M3\n5 CYCL CALL", 4, 21,
     "CYCL DEF 12 PGM (name of the program) X5: there is no program of this name"),
    (CYCLE_12.format("ISO.I") + "4 M3\n5 CYCL CALL", 4, 21,
     "CYCL DEF 12 PGM (name of the program) ISO.I: DIN/ISO programs (.I) are not built yet"),
    ("2 CYCL DEF 12.0 PGM CALL\n3 L X+5", 3, 1, "CYCL DEF 12 PGM (name of the program) is missing"),
    ("2 CYCL DEF 12.0 PGM CALL\n3 CYCL DEF 12.1 PGM", 4, 20, "CYCL DEF 12 needs the name of a program"),
]  # fmt: skip


@pytest.mark.parametrize(("blocks", "line", "column", "text"), REFUSED, ids=[item[0][:40] for item in REFUSED])
def test_refused(blocks: str, line: int, column: int, text: str) -> None:
    setup = mnc.Setup(files={"s": SUB, "iso.i": "%\n"})
    run = mnc.run(f"0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n{blocks}\n", "tnc-620", setup)
    alarms = [a for a in run.alarms if a.severity == "alarm"]
    found = [(a.span.line, a.span.column, a.message + (f" ({a.hint})" if a.hint else "")) for a in alarms]
    assert found == [(line, column, text)]


@pytest.mark.parametrize(
    "call", ["2 CALL PGM S", '2 SEL PGM "S"\n3 CALL SELECTED PGM', CYCLE_12.format("S") + "4 L X+5 M3 M99"]
)
def test_the_end_of_the_run_in_a_called_program(call: str) -> None:
    run = mnc.run(f"0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n{call}\n", "tnc-620", mnc.Setup(files={"s": SUB}))
    (alarm,) = run.alarms
    assert alarm.headline == (
        "s:3:3: alarm: M30 ends the run and cannot stand in a program that was called (a called program ends with END PGM)"
    )
