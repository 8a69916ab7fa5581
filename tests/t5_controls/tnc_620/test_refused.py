"""Programs that must be refused: the alarm, its line and its column.

Blocks stand behind BEGIN PGM and TOOL CALL 1 (radius 5, feed 100) and so begin in line 3.
"""

from __future__ import annotations

import pytest

import mnclab as mnc

D200 = "2 CYCL DEF 200 D\nQ200=2\nQ201=-15\nQ206=250\nQ202=5\nQ210=0\nQ203=0\nQ204=20\nQ211=0\n"

REFUSED = [
    # spelling
    ("2 L X", 3, 5, "X needs a number"),
    ("2 L X+5 X+6", 3, 9, "X is written twice in this block (keep one of them)"),
    ("2 L +250 R0 FMAX", 3, 5, "'+' needs an address before it (the axis letter is missing)"),
    ("2 L \u0425+5", 3, 5, "'\u0425' is a Cyrillic letter (write the Latin letter X)"),
    ("2 L X+5 3", 3, 9, "'3' needs an address before it (a blank inside a number splits it)"),
    ("2 L X+1.2.3", 3, 10, "a number has only one decimal point"),
    ("2 L X=5", 3, 5, "X needs a number, found '=' (no = between an address and its number)"),
    ("2 L X1O", 3, 7, "'O' has no meaning here (the letter O stands where the digit 0 was meant)"),
    ("2 L X+99999999999", 3, 6, "a number must be smaller than 1e+09"),
    ("2 G1 X5", 3, 3, "G has no meaning here (G words belong to DIN/ISO programs; write L, C, CR or CYCL DEF)"),
    ("2 FOO 3", 3, 3, "FOO is no statement of this control"),
    ("2 TCH POBE 417", 3, 3, "TCH is no statement of this control (near: TCH PROBE)"),
    ("2 BEGIN PGM B MM", 3, 3, "BEGIN PGM stands twice: a file holds one program"),
    ("2 END PGM A INCH", 3, 13, "END PGM says INCH, BEGIN PGM MM"),
    # motion
    ("2 L X+5 U+5", 3, 9, "U is refused: the axis U is not built yet"),
    ("2 L X+5\n3 CT X+9 C+5", 4, 10, "C is refused: the rotary axis C is built for L alone"),
    ("2 L X+5 F0", 3, 9, "F (feed rate) must be greater than 0, got 0"),
    ("2 L X+5 FAUTO FMAX", 3, 9, "FMAX and FAUTO stand in one block: one feed is allowed"),
    ("2 L X+5 FU0.2", 3, 1, "a feed per revolution needs a turning spindle (write S and M3 before the move)"),
    ("2 L X+5 RL RR", 3, 12, "RL and RR stand in one block: one of R0, RL, RR is allowed"),
    ("2 L X+5 M3 M4", 3, 12, "M4 and M3 are of one group: only one function of a group may stand in a block"),
    ("2 C X+1 Y+0 DR+", 3, 1, "C needs a circle centre: no CC was programmed (write CC X\u2026 Y\u2026 before it)"),
    ("2 CC X+10 Y+0\n3 C X+20 Y+0", 4, 1,
     "C needs the sense of rotation (write DR+ (counter-clockwise) or DR- (clockwise))"),
    (
        "2 CC X+10 Y+0\n3 C X+21 Y+0 DR+", 4, 1,
        "the end point is not on the circle: radius 10.0000 at the start, 11.0000 at the end, allowed difference 0.016 mm",
    ),
    ("2 CC X+5 Y+0\n3 C X+10 Z+5 DR+", 4, 10, "Z5 has no meaning in this block (C does not take Z)"),
    (
        "2 CR X+10 R+3 DR+", 3, 11,
        "R3 is too small for the distance 10 mm between start and end: at least 5 is needed (too short by 2 mm)",
    ),
    ("2 CR X+10 DR+", 3, 1, "CR needs the radius R"),
    ("2 CR X+0 R5 DR+", 3, 10, "CR needs an end other than its start (a full circle is written with CC and C)"),
    ("2 RND R5", 3, 7, "RND needs a path element directly before it"),
    ("2 L X+10\n3 RND R5", 4, 1, "a rounding of R5 needs a path element after it"),
    ("2 L X+10\n3 RND R2\n4 L Z-5\n5 L Y+10", 4, 1, "a rounding of R2 needs both its elements in the working plane"),
    ("2 L X+4\n3 RND R5\n4 L Y+4", 4, 1,
     "a rounding of R5 does not fit between its elements, which are too short for it"),
    ("2 PLANE SPATIAL SPA+0 SPB+90 SPC+0 TURN MBMAX FMAX", 3, 1,
     "PLANE SPATIAL is refused: tilted plane, not built yet"),
    # compensation
    ("2 C X+5 RL DR+", 3, 9, "RL cannot begin the radius compensation in C (write it in a straight line L)"),
    ("2 APPR LT X+1 Y+2 LEN5", 3, 1, "APPR LT needs RL or RR (the side on which the tool runs beside the contour)"),
    ("2 APPR LT X+1 Y+2 LEN0 RL", 3, 19, "APPR LT LEN (length of the line) must be greater than 0, got 0"),
    ("2 APPR LT X+1 Y+2 LEN5 RL", 3, 1, "APPR LT needs a path element of the contour after it"),
    ("2 L X+5 RL\n3 TOOL CALL 2 Z", 4, 13,
     "TOOL CALL cannot change the tool under radius compensation (write R0 first)"),
    ("2 L X+5 RL\n3 L X+9\n4 C X+9 Y+5 R0 DR+", 5, 13,
     "R0 cannot end the radius compensation in C (write it in a straight line L)"),
    # labels and parameters
    ("2 LBL 1\n3 LBL 0\n4 LBL 1", 5, 7, "LBL 1 is set twice (a label stands for one place in the program)"),
    ("2 CALL LBL 0", 3, 12, "CALL LBL 0: LBL 0 is the end of a subprogram and cannot be called"),
    ("2 CALL LBL 5", 3, 12, "label 5 does not exist (this program has no labels)"),
    ("2 CALL LBL 3 REP 2\n3 LBL 3", 3, 12,
     "CALL LBL 3 REP: the section must begin before this block (REP repeats what stands above)"),
    ("2 LBL 70000", 3, 7, "a label must be a number from 0 to 65535, got 70000"),
    ("2 LBL 1\n3 CALL LBL 1", 4, 12, "calls are nested deeper than 20"),
    ("2 L X+Q5", 3, 7, "no value was given to Q5"),
    ("2 FN 4: Q1 = +5 DIV +0", 3, 17, "division by zero at DIV"),
    ("2 FN 5: Q1 = SQRT -4", 3, 14, "SQRT of -4 has no real value"),
    ("2 FN 0: Q1 = +5 + +3", 3, 14, "the function must have the form FN 0: Q1 = +2"),
    ("2 FN 16: F-PRINT A.A / A.TXT", 3, 1, "FN 16 is refused: formatted output, not built yet"),
    ("2 Q5000 = 3", 3, 3, "Q5000 does not exist: Q0 to Q1999, QL0 to QL499 and QR0 to QR499 are allowed"),
    ("2 Q1 = 3 * (", 3, 12, "the expression ends where a number or a variable was expected"),
    # tools and the blank
    ("2 TOOL CALL 77 Z", 3, 13, "TOOL CALL 77 has no row in the tool table (tools: 0, 1, 2, 3, 4, 5, 6)"),
    ("2 TOOL CALL 1 X", 3, 15, "TOOL CALL: the tool axis X is not built yet, Z is"),
    ("2 BLK FORM 0.1 Z X+0 Y+0", 3, 16, "BLK FORM 0.1 Z (coordinate of the corner) is missing"),
    ("2 BLK FORM 0.2 X+9 Y+9 Z+0", 3, 16, "BLK FORM 0.2 needs BLK FORM 0.1 before it"),
    ("2 BLK FORM 0.1 Z X+0 Y+0 Z-20\n3 BLK FORM 0.2 X+100 X+100 Z+0", 4, 22,
     "X is written twice in this block (keep one of them)"),
    ("2 BLK FORM 0.1 Z X+0 Y+0 Z-20\n3 BLK FORM 0.2 X+100 Y+100 Y+0", 4, 28,
     "Y is written twice in this block (keep one of them)"),
    ("2 BLK FORM 0.1 Z X+0 Y+0 Z-20\n3 BLK FORM 0.2 X+9 Y+0 Z+0", 4, 20,
     "BLK FORM 0.2 Y (greatest corner) must be greater than 0, got 0"),
    # cycles
    ("2 CYCL CALL", 3, 1, "CYCL CALL has no cycle to call (define one before, for example CYCL DEF 200)"),
    ("2 L X+5 M99", 3, 9, "M99 has no cycle to call (define one before, for example CYCL DEF 200)"),
    (D200 + "3 L X+9 RL\n4 L X+10 M3 M99", 13, 13,
     "M99: a cycle is called at a position without radius compensation (write R0 in the block before)"),
    (D200.replace("Q201=-15", "Q201=15") + "3 CYCL CALL M3", 5, 1,
     "CYCL DEF 200 Q201 (depth) must be negative, got 15: a positive depth works upwards"),
    (D200.replace("Q200=2", "Q200=-2"), 4, 1,
     "CYCL DEF 200 Q200 (set-up clearance) must be at least 0 and at most 99999.9999, got -2"),
    (D200.replace("Q204=20\n", ""), 3, 1, "CYCL DEF 200 Q204 (second set-up clearance) is missing"),
    (D200 + "Q395=2", 12, 1, "CYCL DEF 200 Q395 (depth reference) must be one of 0, 1, got 2"),
    (D200 + "Q395=1\n3 CYCL CALL M3", 12, 1,
     "CYCL DEF 200 Q395 (depth reference) needs the point angle of tool 1 (T-ANGLE of the tool table)"),
    (D200 + "Q999=2", 12, 1,
     "Q999=2 has no meaning in this block (CYCL DEF 200 does not take Q999) (a line Q… without a block number belongs to the "
     "definition above it: number it to assign a variable)"),
    (D200 + "Q200=2", 12, 1, "Q200 is written twice in this block (keep one of them)"),
    (D200.replace("Q206=250", "Q206=FMAX"), 6, 1,
     "CYCL DEF 200 Q206 (feed rate for plunging) must be a number, FAUTO, FU, got FMAX"),
    (D200.replace("Q206=250", "Q206="), 6, 1, "Q206 needs a number"),
    (D200.replace("Q206=250", "Q206=0") + "3 CYCL CALL M3", 6, 1,
     "CYCL DEF 200 Q206 (feed rate for plunging) must be greater than 0 to drill with, got 0"),
    (D200.replace("Q202=5", "Q202=.0001") + "3 CYCL CALL M3", 7, 1,
     "CYCL DEF 200 Q202 (infeed depth) 0.0001 divides 15 into more than 10000 infeeds"),
    ("2 CYCL DEF 25.0 CONTUR", 3, 1, "CYCL DEF 25 is refused: Contour train, not built yet"),
    ("2 CYCL DEF 310", 3, 1,
     "CYCL DEF 310 is refused: a cycle of the machine tool builder, whose manual alone describes it"),
    ("2 TCH PROBE 417 X\nQ263=1", 3, 1, "TCH PROBE 417 is refused: Preset in the probe axis, not built yet"),
    ("2 CYCL DEF 7.1 X+5", 3, 3, "CYCL DEF 7.1 stands without CYCL DEF 7.0 before it"),
    ("2 CYCL DEF 7.0 S\n3 CYCL DEF 7.2 X+5\n4 CYCL DEF 7.1 Y+6", 5, 3, "CYCL DEF 7.1 stands after CYCL DEF 7.2"),
    ("2 CYCL DEF 7.0 S\n3 CYCL DEF 7.1 X+5\n4 CYCL DEF 7.2 X+6", 5, 16,
     "X is written twice in this block (keep one of them)"),
    ("2 CYCL DEF 7.0 S\n3 CYCL DEF 7.1 U+5", 4, 16, "U is refused: the axis U is not built yet"),
    ("2 CYCL DEF 7.0 S\n3 L X+5", 3, 1, "CYCL DEF 7 needs an axis, for example CYCL DEF 7.1 X+60"),
    ("2 CYCL DEF 7.0 S\n3 CYCL DEF 7.1 X+100000", 4, 16,
     "CYCL DEF 7 X (datum shift along X) must be at least -99999.9999 and at most 99999.9999, got 100000"),
    ("2 CYCL DEF 10.0 R\n3 CYCL DEF 10.1 ROT+400", 4, 17,
     "CYCL DEF 10 ROT (rotation angle) must be at least -360 and at most 360, got 400"),
    ("2 CYCL DEF 10.0 R\n3 CYCL DEF 10.1 IROT-361", 4, 17,
     "CYCL DEF 10 ROT (rotation angle) must be at least -360 and at most 360, got -361"),
    ("2 CYCL DEF 10.0 R", 3, 1, "CYCL DEF 10 ROT (rotation angle) is missing"),
]  # fmt: skip


@pytest.mark.parametrize(("blocks", "line", "column", "text"), REFUSED, ids=[item[3][:40] for item in REFUSED])
def test_refused(blocks: str, line: int, column: int, text: str) -> None:
    run = mnc.run(f"0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n{blocks}\n", "tnc-620")
    alarms = [a for a in run.alarms if a.severity == "alarm"]
    found = [(a.span.line, a.span.column, a.message + (f" ({a.hint})" if a.hint else "")) for a in alarms]
    assert found == [(line, column, text)]


def test_faults_of_the_first_lines() -> None:
    for text, place, message in (
        ("0 BEGIN PGM A\n", (1, 13), "the unit of the program is missing: MM or INCH must follow its name"),
        ("L X+5\n", (1, 1), "no feed rate was programmed before this move"),
        ("1 L X+5 FAUTO\n", (1, 9), "FAUTO needs a feed in the TOOL CALL block"),
    ):
        (alarm,) = mnc.run(text, "tnc-620").alarms
        assert (alarm.span[:2], alarm.message) == (place, message)


def test_warnings_let_the_program_run() -> None:
    run = mnc.run("0 BEGIN PGM A MM\n1 L X+5 F100\n2 END PGM B MM\n3 L X+9\n", "tnc-620")
    assert run.ok and [(a.span.line, a.message) for a in run.alarms] == [
        (3, "END PGM names B, BEGIN PGM A"), (4, "nothing after END PGM is obeyed"),
    ]  # fmt: skip
