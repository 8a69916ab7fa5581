"""Blocks that must be refused, with line and column: feeds, tools, blank, M functions, forms of lines.

They stand behind BEGIN PGM and TOOL CALL 1 (radius 5, 3 teeth, feed 100) and so begin in line 3.
"""

from __future__ import annotations

import pytest

import mnclab as mnc

LEAST = "2 BLK FORM 0.1 Z X+0 Y+0 Z-20\n"
REFUSED = [
    # feeds
    ("2 L X+5 FU0", 3, 9, "FU (feed per revolution) must be greater than 0, got 0"),
    ("2 L X+5 FZ-1", 3, 9, "FZ (feed per tooth) must be greater than 0, got -1"),
    ("2 L X+5 F100 FU0.1", 3, 14, "F100 and FU0.1 stand in one block: one feed is allowed"),
    ("2 L X+5 FAUTO FZ,1", 3, 15, "FAUTO and FZ0.1 stand in one block: one feed is allowed"),
    ("2 TOOL CALL 6 Z\n3 L X+1 FZ0.1 M3", 4, 9, "FZ0.1 needs the number of teeth of tool 6 (column CUT of the tool table)"),
    ("2 L X+5 FU0.2 M3\n3 L X+6 M5\n4 L X+7", 5, 1,
     "a feed per revolution needs a turning spindle (write S and M3 before the move)"),
    ("2 L X+5 FZ0.1 M3\n3 TOOL CALL 6\n4 L X+9", 5, 1,
     "no feed rate was programmed before this move (write F or FMAX; with the setting feed_needed = False such a move is at "
     "rapid, with a warning)"),
    ("2 L X+5 F MAXX", 3, 9, "F needs a number, found 'M'"),
    ("2 L X+5 FMX", 3, 9, "F needs a number, found 'M' (near: FMAX)"),
    ("2 L X-Q1/2", 3, 9, "'/' has no meaning here (a formula stands in a block of its own, for example Q10 = Q1 / 2)"),
    ("2 CYCL DEF 200 D\nQ206=FU0", 4, 1, "Q206=FU (feed per revolution) must be greater than 0, got 0"),
    ("2 CYCL DEF 200 D\nQ206=FZ.1", 4, 1, "CYCL DEF 200 Q206 (feed rate for plunging) must be a number, FAUTO, FU, got FZ.1"),
    ("2 TOOL CALL S0\n3 CYCL DEF 200 D\nQ206=FU0.1", 5, 1,
     "Q206=FU0.1 needs a spindle speed (write S in the TOOL CALL block before the definition)"),
    ("2 TOOL CALL 6\n3 CYCL DEF 22 D\nQ12=FZ.1", 5, 1,
     "Q12=FZ.1 needs the number of teeth of tool 6 (column CUT of the tool table)"),
    # tools
    ("2 TOOL CALL 1 Z S-5", 3, 17, "TOOL CALL S (spindle speed) must be at least 0, got -5"),
    ("2 TOOL CALL 1 Z F0", 3, 17, "TOOL CALL F (feed rate) must be greater than 0, got 0"),
    ("2 TOOL CALL 1 Z FMAX", 3, 17, "FMAX has no meaning in this block (TOOL CALL does not take FMAX)"),
    ("2 TOOL CALL 1.5 Z", 3, 13, "TOOL CALL 1.5 has no row in the tool table (tools: 0, 1, 2, 3, 4, 5, 6)"),
    ("2 TOOL CALL 1 W S5", 3, 15, "TOOL CALL: the tool axis W is not built yet, Z is"),
    ("2 TOOL CALL 1 Z DR2-1", 3, 17,
     "TOOL CALL DR2 (delta corner radius) must be at least 0, got -1: the corner radius is 0"),
    ("2 TOOL CALL Q7 Z", 3, 13, "no value was given to Q7"),
    ("2 TOOL CALL QS7 Z", 3, 13, "TOOL CALL: no text was given to QS7"),
    ("2 TOOL DEF 5 L+10 R+4", 3, 14, "TOOL DEF L: the tool table is active, it holds the dimensions of the tools"),
    ("2 TOOL DEF 77", 3, 12, "TOOL DEF 77 has no row in the tool table (tools: 0, 1, 2, 3, 4, 5, 6)"),
    ("2 TOOL DEF", 3, 1, "TOOL DEF needs the number of the tool (for example TOOL DEF 5 L+100 R+4)"),
    # the blank
    ("2 BLK FORM CYLINDER Z R50 L100", 3, 1, "BLK FORM CYLINDER is refused: blank, not built yet"),
    ("2 BLK FORM ROTATION Z DIM_R LBL1", 3, 1, "BLK FORM ROTATION is refused: blank, not built yet"),
    ('2 BLK FORM FILE "A.STL"', 3, 1, "BLK FORM FILE is refused: blank, not built yet"),
    ("2 BLK FORM 0.1 W X+0 Y+0 Z-20", 3, 16, "BLK FORM 0.1: the tool axis must be X, Y or Z, got W"),
    ("2 BLK FORM 0.1 X+0 Y+0 Z-20", 3, 1,
     "BLK FORM 0.1 needs the tool axis (for example BLK FORM 0.1 Z X+0 Y+0 Z-20)"),
    ("2 BLK FORM 0.1 Z IX+0 Y+0 Z-20", 3, 18, "BLK FORM 0.1 X (coordinate of the corner) must be absolute"),
    ("2 BLK FORM 0.3 Z X+0", 3, 1,
     "BLK FORM 0.3 is not a function of this control (near: BLK FORM 0.1, BLK FORM 0.2)"),
    (2 * LEAST, 4, 16, "BLK FORM 0.1 stands twice: BLK FORM 0.2 belongs behind the first"),
    (LEAST + 2 * "3 BLK FORM 0.2 X+1 Y+1 Z+0\n", 5, 16, "BLK FORM 0.2 needs BLK FORM 0.1 before it"),
    # M functions
    ("2 L X+5 M91 RL", 3, 9, "M91 cannot begin radius compensation (write RL or RR in the block after)"),
    ("2 L X+5 RL\n3 L X+6 M91", 4, 9, "M91 cannot stand under radius compensation (write R0 in the block before)"),
    ("2 CC X+1 Y+1 M91", 3, 14, "M91 stands in a straight line L alone"),
    ("2 C X+1 Y+2 DR+ M92", 3, 17, "M92 stands in a straight line L alone"),
    ("2 L X+5 M91 M92", 3, 13, "M92 and M91 are of one group: only one function of a group may stand in a block"),
    ("2 L X+5 M103 F0", 3, 14, "M103 F (percent of the feed downwards) must be greater than 0, got 0"),
    ("2 L X+5 M103 F", 3, 14, "M103 F needs a number (for example M103 F20: 20 percent)"),
    ("2 L X+5 M94 C5", 3, 13, "M94 names an axis without a number, got C5"),
    ("2 L X+5 M109 M110", 3, 14,
     "M110 and M109 are of one group: only one function of a group may stand in a block"),
    ("2 L X+5 M30 M2", 3, 13, "M2 and M30 are of one group: only one function of a group may stand in a block"),
    ("2 L X+5 M3 M13", 3, 12, "M13 and M3 are of one group: only one function of a group may stand in a block"),
    ("2 L X+5 RL M120 LA5", 3, 12, "M120 is refused: look-ahead, not built yet"),
    ("2 L X+5 F9 M128 F500", 3, 12, "M128 is refused: tool centre point management, not built yet"),
    ("2 L X+5 F9 M140 MB MAX", 3, 12, "M140 is refused: retraction, not built yet"),
    ("2 L X+5 F9 M140 MB50 F9", 3, 12, "M140 is refused: retraction, not built yet"),
    ("2 L X+5 M138 A C", 3, 9, "M138 is refused: choice of tilting axes, not built yet"),
    ("2 L X+5 M999", 3, 9, "M999 is not a function of this control (near: M99)"),
    ("2 L X+5 M", 3, 9, "M needs a number"),
    ("2 M6 M6", 3, 6, "M6 is written twice in this block (keep one of them)"),
    ("2 STOP X+5", 3, 8, "X5 has no meaning in this block"),
    # lines and numbers
    ("2 L X FMAX", 3, 5, "X needs a number, found 'F'"),
    ("2 L X+1 /", 3, 9, "'/' has no meaning here"),
    ("2 L X++5", 3, 5, "X needs a number, found '+'"),
    ('2 L X"5"', 3, 5, "X needs a number, found '\"'"),
    ("2 LX+5 Y", 3, 3, "LX is no statement of this control (near: L)"),
    ("2 END PGM B", 3, 11, "the unit of the program is missing: MM or INCH must follow its name"),
    ("2 CYCL DEF", 3, 11, "CYCL DEF needs the number of a cycle"),
    ("2 CYCL DEF 7.0 D\n/3 CYCL DEF 7.1 X+5", 4, 4, "all sub-blocks of a cycle must be marked with / or none"),
    ("2 CYCL DEF 200 D\nQ200=2 5", 4, 8, "'5' needs an address before it (a blank inside a number splits it)"),
    ("2 CYCL DEF 200 D\nQ200=1,2,3", 4, 9, "a number has only one decimal point"),
    ("2 TCH PROBE", 3, 12, "TCH PROBE needs the number of a cycle"),
]  # fmt: skip


@pytest.mark.parametrize(("blocks", "line", "column", "text"), REFUSED, ids=[item[0][2:42] for item in REFUSED])
def test_refused(blocks: str, line: int, column: int, text: str) -> None:
    run = mnc.run(f"0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n{blocks}\n", "tnc-620")
    alarms = [a for a in run.alarms if a.severity == "alarm"]
    found = [(a.span.line, a.span.column, a.message + (f" ({a.hint})" if a.hint else "")) for a in alarms]
    assert found == [(line, column, text)]


@pytest.mark.parametrize("code", ["CYCL DEF 9999", "TCH PROBE 9999", "CYCL DEF 6", "FN 99"])
def test_numbers_that_nobody_knows(code: str) -> None:
    (alarm,) = mnc.run(f"1 {code} X\n", "tnc-620").alarms
    assert (alarm.span[:2], alarm.message) == ((1, 1), f"{code} is not a function of this control")


def test_a_blank_without_its_second_corner_is_remarked() -> None:
    run = mnc.run(LEAST + "3 L X+1 FMAX\n4 M30\n", "tnc-620")
    assert run.ok and [(a.span.line, a.message) for a in run.alarms] == [
        (3, "the blank has no greatest corner: BLK FORM 0.2 is missing")
    ]
