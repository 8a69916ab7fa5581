"""The same program in DIN/ISO and in conversational words makes the same path, to the last bit that counts.

The DIN/ISO forms are those of HEIDENHAIN's manuals "DIN/ISO programming" (TNC 360 to TNC 640: path functions, addresses,
Q parameter functions) and of the headings of this manual's cycles.
"""

from __future__ import annotations

import re

import numpy as np
import pytest

import mnclab as mnc
from mnclab.controls.tnc_620.trial import AREA, LINES
from mnclab.machine.trial import first_value, program, written_first

CONTROL = mnc.controls["tnc-620"]
COLUMNS = ("kind", "start", "end", "centre", "sweep", "feed", "per_rev", "spindle", "time", "tool", "side", "rotary", "axis")

#: What stands inside `%A G71` and BEGIN PGM, behind the call of tool 1 with F100.
PAIRS = {
    "lines": ("G00 G40 G90 X+10 Y+5 Z+2 M3 *\nG01 Z-3 F200 *\nG91 X+5 G90 Y+8 *\nX+1 *\nG91 Y+1 Z+0.5*\nY-2*",
              "L X+10 Y+5 Z+2 R0 FMAX M3\nL Z-3 F200\nL IX+5 Y+8\nL X+1\nL IY+1 IZ+0.5\nL IY-2"),
    "one axis": ("G07 X+30 F300 M3*\nY-5*", "L X+30 F300 M3\nL Y-5"),
    "feed beside a rapid line": ("G00 X+10 F333 M3*\nG01 Y+5*", "L X+10 FMAX M3\nL Y+5 F333"),
    "feeds": ("G01 X+10 FAUTO M3*\nX+20 FU0.3*\nFZ0.05*\nX+30*", "L X+10 FAUTO M3\nL X+20 FU0.3\nL X+30 FZ0.05"),
    "arcs about a centre": ("G00 X+10 Y+0 M3*\nI+0 J+0*\nG03 X+0 Y+10*\nG02 X+10 Y+0*\nX+10*",
                            "L X+10 Y+0 FMAX M3\nCC X+0 Y+0\nC X+0 Y+10 DR+\nC X+10 Y+0 DR-\nC X+10 DR-"),
    "centre in the block of the arc": ("G00 X+10 M3*\nG90 G02 I+0 J+0 X-10*", "L X+10 FMAX M3\nCC X+0 Y+0\nC X-10 DR-"),
    "centre by increments": ("G00 X+10 Y+3 M3*\nG91 I-10 G90 J+3*\nG03 X+0 Y+13*\nG29*\nG11 R+7 H+30*",
                             "L X+10 Y+3 FMAX M3\nCC IX-10 Y+3\nC X+0 Y+13 DR+\nCC\nLP PR+7 PA+30"),
    "arcs by radius": ("G00 X+10 Y+0 M3*\nG03 X+0 Y+10 R+10*\nG05 X-10 Y+0 R+10*\nG02 X+0 Y+10 R-10*",
                       "L X+10 Y+0 FMAX M3\nCR X+0 Y+10 R+10 DR+\nCR X-10 Y+0 R+10 DR+\nCR X+0 Y+10 R-10 DR-"),
    "tangent arcs": ("G01 X+0 Y+25 M3*\nX+25 Y+30*\nG06 X+45 Y+20*\nG01 Y+0*",
                     "L X+0 Y+25 M3\nL X+25 Y+30\nCT X+45 Y+20\nL Y+0"),
    "polar lines": ("I+45 J+25*\nG10 R+30 H+0 M3*\nG11 H+60 F150*\nG91 H+60*\nG90 R+20*",
                    "CC X+45 Y+25\nLP PR+30 PA+0 FMAX M3\nLP PA+60 F150\nLP IPA+60\nLP PR+20"),
    "polar arcs": ("I+25 J+25*\nG11 R+20 H+0 F250 M3*\nG13 H+180*\nG15 H+270*\nG12 H+90*\nG16 R+30 H+30*",
                   "CC X+25 Y+25\nLP PR+20 PA+0 F250 M3\nCP PA+180 DR+\nCP PA+270 DR+\nCP PA+90 DR-\nCTP PR+30 PA+30"),
    "helix": ("I+0 J+0*\nG00 X+15 Y+0 Z+2 M3*\nG12 G91 H-1080 Z-13.5 F200*\nG90 G13 G91 H+90*",
              "CC X+0 Y+0\nL X+15 Y+0 Z+2 FMAX M3\nCP IPA-1080 IZ-13.5 DR- F200\nCP IPA+90 DR+"),
    "compensated": ("G00 X-20 Y-20 M3*\nG01 G42 X+0 Y+0*\nX+50*\nG25 R5 F40*\nY+30*\nG24 R3*\nX+0*\nY+0*\nG40 X-20 Y-20*",
                    "L X-20 Y-20 FMAX M3\nL X+0 Y+0 RR\nL X+50\nRND R5 F40\nL Y+30\nCHF 3\nL X+0\nL Y+0\nL X-20 Y-20 R0"),
    "approach and departure": (
        "G00 G40 X-20 Y+30 Z-5 M3*\nG01 G41 X+0 Y+30 F350*\nG26 R5*\nY+60*\nX+60*\nY+0*\nX+0*\nY+30*\nG27 R5*\n"
        "G01 G40 X-20 Y+20*",
        "L R0 X-20 Y+30 Z-5 FMAX M3\nAPPR LCT X+0 Y+30 R5 RL F350\nL Y+60\nL X+60\nL Y+0\nL X+0\nL Y+30\n"
        "DEP LCT X-20 Y+20 R5"),
    "rotary axes": ("G01 X+5 C+30 F500 M3*\nG91 C-10*", "L X+5 C+30 F500 M3\nL IC-10"),
    "machine datum": ("G00 G40 Z+100 M91*\nG01 X+1 M3*", "L Z+100 R0 FMAX M91\nL X+1 M3"),
    "plane ZX": ("T1 G18 S1000 F100*\nG00 X+1 Z+2 Y+3 M3*\nK+0 I+0*\nG02 X+1 Z+2*\nG01 G41 X+10 Z+0*\nX+30*\nG40 Z+50*",
                 "TOOL CALL 1 Y S1000 F100\nL X+1 Z+2 Y+3 FMAX M3\nCC Z+0 X+0\nC X+1 Z+2 DR-\nL X+10 Z+0 RL\nL X+30\nL Z+50 R0"),
    "plane YZ": ("T1 G19 S1000 F100*\nG00 Y+10 Z+0 X+5 M3*\nJ+0 K+0*\nG13 H+90*\nG03 Y+10 Z+0 R10*",
                 "TOOL CALL 1 X S1000 F100\nL Y+10 Z+0 X+5 FMAX M3\nCC Y+0 Z+0\nCP PA+90 DR+\nCR Y+10 Z+0 R10 DR+"),
    "pole outside the plane": ("G00 X+10 Z+0 M3*\nI+0 K+0*\nG13 G91 H+90*",
                               "L X+10 Z+0 FMAX M3\nCC X+0 Z+0\nCP IPA+90 DR+"),
    "tool call": ("T2 G17 S2000 F150 DL+0.5 DR-0.1*\nG01 X+5 M13*\nS3000*\nX+6 S500*",
                  "TOOL CALL 2 Z S2000 F150 DL+0.5 DR-0.1\nL X+5 M13\nTOOL CALL S3000\nTOOL CALL S500\nL X+6"),
    "subprogram": ("M3*\nL1*\nG01 Y+50*\nL1,0*\nG00 Z+100 M2*\nG98 L1*\nG01 G91 X+5*\nY+5*\nG90*\nG98 L0*",
                   "M3\nCALL LBL 1\nL Y+50\nCALL LBL 1\nL Z+100 FMAX M2\nLBL 1\nL IX+5\nL IY+5\nLBL 0"),
    "repeats": ('G01 X+0 M3*\nG98 L"A"*\nG91 X+3*\nG90 Y+1*\nG91 Y+1*\nL"A",3*\nG90 Z+9*',
                'L X+0 M3\nLBL "A"\nL IX+3\nL Y+1\nL IY+1\nCALL LBL "A" REP3\nL Z+9'),
    "jumps": ("D00 Q1 P01 +0*\nM3*\nG98 L1*\nD01 Q1 P01 +Q1 P02 +2*\nG01 X+Q1*\nD12 P01 +Q1 P02 +9 P03 1*\nY+Q1*",
              "FN 0: Q1 = +0\nM3\nLBL 1\nFN 1: Q1 = +Q1 + +2\nL X+Q1\nFN 12: IF +Q1 LT +9 GOTO LBL 1\nL Y+Q1"),
    "Q functions": (
        "D02 Q2 P01 +10 P02 +4*\nD03 Q3 P01 +Q2 P02 -3*\nD04 Q4 P01 +Q3 P02 +4*\nD05 Q5 P01 +16*\nD06 Q6 P01 +30*\n"
        "D07 Q7 P01 -Q5*\nD08 Q9 P01 +3 P02 +4*\nD13 Q10 P01 +10 P02 -Q9*\nG01 X+Q2 Y+Q3 Z+Q4 M3*\nX+Q5 Y+Q6 Z+Q7*\nX+Q9 Y+Q10*",
        "FN 2: Q2 = +10 - +4\nFN 3: Q3 = +Q2 * -3\nFN 4: Q4 = +Q3 DIV +4\nFN 5: Q5 = SQRT +16\nFN 6: Q6 = SIN +30\n"
        "FN 7: Q7 = COS -Q5\nFN 8: Q9 = +3 LEN +4\nFN 13: Q10 = +10 ANG -Q9\nL X+Q2 Y+Q3 Z+Q4 M3\nL X+Q5 Y+Q6 Z+Q7\n"
        "L X+Q9 Y+Q10"),
    "formulas": ("Q1 = 3 * (4 + SQRT 9) *\nQS1 = \"A\" || \"B\" *\nQ2 = STRLEN ( SRC_QS1 ) *\nG01 X+Q1 Y-Q2 M3*",
                 "Q1 = 3 * (4 + SQRT 9)\nQS1 = \"A\" || \"B\"\nQ2 = STRLEN ( SRC_QS1 )\nL X+Q1 Y-Q2 M3"),
    "drilling": (
        "G00 Z+50 M3*\nG200 Q200=2 Q201=-20 Q206=150 Q202=5 Q210=0 Q203=+0 Q204=50 Q211=0.2*\nX+10 Y+10 M99*\nX+30*\nG79*\n"
        "G79:G00 X+50 Y+20 Z-3*\nG00 X+70 M89*\nY+30*\nX+80 M99*",
        "L Z+50 FMAX M3\nCYCL DEF 200 Q200=2 Q201=-20 Q206=150 Q202=5 Q210=0 Q203=+0 Q204=50 Q211=0.2\n"
        "L X+10 Y+10 FMAX M99\nL X+30 FMAX\nCYCL CALL\nCYCL CALL POS X+50 Y+20 Z-3 FMAX\nL X+70 FMAX M89\nL Y+30 FMAX\n"
        "L X+80 FMAX M99"),
    "definition over several lines": (
        "G00 Z+50 M3*\nN40 G201 REAMING\n  Q200=2 ;CLEARANCE\n  Q201=-15\n  Q206=FAUTO\n  Q211=0.5\n  Q208=750\n  Q203=+0\n"
        "  Q204=20*\nN50 G79 M8*",
        "L Z+50 FMAX M3\nCYCL DEF 201 Q200=2 Q201=-15 Q206=FAUTO Q211=0.5 Q208=750 Q203=+0 Q204=20\nCYCL CALL M8"),
    "point patterns": (
        "G00 Z+50 M3*\nPATTERN DEF POS1 (X+5 Y+6 Z+0) POS2 (X+20 Y+6 Z-2)*\n"
        "G200 Q200=2 Q201=-9 Q206=150 Q202=5 Q210=0 Q203=+0 Q204=50 Q211=0*\nG79 PAT FMAX*",
        "L Z+50 FMAX M3\nPATTERN DEF POS1 (X+5 Y+6 Z+0) POS2 (X+20 Y+6 Z-2)\n"
        "CYCL DEF 200 Q200=2 Q201=-9 Q206=150 Q202=5 Q210=0 Q203=+0 Q204=50 Q211=0\nCYCL CALL PAT FMAX"),
    "transformations": (
        "G54 X+20 Y+30*\nG73 H+30*\nG28 X*\nG72 F0.5*\nG01 X+10 Y+5 M3*\nG54 G91 X+5*\nG90 X+0 Y+0*\nG73 G91 H+15*\nG90 X+7*\n"
        "G28*\nG72 F1*\nG73 G90 H+0*\nG54 X+0 Y+0*\nX+1*",
        "CYCL DEF 7.0\nCYCL DEF 7.1 X+20\nCYCL DEF 7.2 Y+30\nCYCL DEF 10.0\nCYCL DEF 10.1 ROT+30\nCYCL DEF 8.0\n"
        "CYCL DEF 8.1 X\nCYCL DEF 11.0\nCYCL DEF 11.1 SCL 0.5\nL X+10 Y+5 M3\nCYCL DEF 7.0\nCYCL DEF 7.1 IX+5\nL X+0 Y+0\n"
        "CYCL DEF 10.0\nCYCL DEF 10.1 IROT+15\nL X+7\nCYCL DEF 8.0\nCYCL DEF 8.1\nCYCL DEF 11.0\nCYCL DEF 11.1 SCL 1\n"
        "CYCL DEF 10.0\nCYCL DEF 10.1 ROT+0\nCYCL DEF 7.0\nCYCL DEF 7.1 X+0\nCYCL DEF 7.2 Y+0\nL X+1"),
    "tilted plane": ("G80 A+0 B+45 C+0*\nG01 X+10 Z+5 M3*\nG80*\nX+0*",
                     "CYCL DEF 19.0\nCYCL DEF 19.1 A+0 B+45 C+0\nL X+10 Z+5 M3\nCYCL DEF 19.0\nCYCL DEF 19.1\nL X+0"),
    "special cycles": (
        "G04 F1.5*\nG36 S+90*\nM19*\nG62 T0.05 P01 1 P02 5*\nG01 X+10 M3*\nG38 M5*\nG86 P01 -20 P02 +1.5*\nG79*",
        "CYCL DEF 9.0\nCYCL DEF 9.1 DWELL 1.5\nCYCL DEF 13.0\nCYCL DEF 13.1 ANGLE 90\nM19\nCYCL DEF 32.0\n"
        "CYCL DEF 32.1 T0.05\nCYCL DEF 32.2 HSC-MODE:1 TA5\nL X+10 M3\nSTOP M5\nCYCL DEF 18.0\nCYCL DEF 18.1 DEPTH -20\n"
        "CYCL DEF 18.2 PITCH +1.5\nCYCL CALL"),
    "contours": (
        "G00 Z+50 M3*\nG37 P01 11 P02 12*\nG120 Q1=-6 Q2=1 Q3=+0.2 Q4=+0.1 Q5=+0 Q6=2 Q7=+50 Q8=0 Q9=+1*\n"
        "G122 Q10=-3 Q11=100 Q12=350 Q18=0 Q19=0 Q208=FMAX Q401=100 Q404=0*\nG79*\nG00 Z+100 M2*\n"
        "G98 L11*\nG01 G42 X+0 Y+0*\nY+60*\nX+80*\nY+0*\nX+0*\nG98 L0*\n"
        "G98 L12*\nG01 G41 X+30 Y+20*\nY+40*\nX+50*\nY+20*\nX+30*\nG98 L0*",
        "L Z+50 FMAX M3\nCYCL DEF 14.0\nCYCL DEF 14.1 LBL 11/12\n"
        "CYCL DEF 20 Q1=-6 Q2=1 Q3=+0.2 Q4=+0.1 Q5=+0 Q6=2 Q7=+50 Q8=0 Q9=+1\n"
        "CYCL DEF 22 Q10=-3 Q11=100 Q12=350 Q18=0 Q19=0 Q208=FMAX Q401=100 Q404=0\nCYCL CALL\nL Z+100 FMAX M2\n"
        "LBL 11\nL X+0 Y+0 RR\nL Y+60\nL X+80\nL Y+0\nL X+0\nLBL 0\n"
        "LBL 12\nL X+30 Y+20 RL\nL Y+40\nL X+50\nL Y+20\nL X+30\nLBL 0"),
    "pecking": ("G00 X+0 Y+0 Z+2 M3*\nG83 P01 -2 P02 -20 P03 -5 P04 0.5 P05 150*\nG79*",
                "L X+0 Y+0 Z+2 FMAX M3\nCYCL DEF 1.0 PECKING\nCYCL DEF 1.1 SET UP-2\nCYCL DEF 1.2 DEPTH-20\n"
                "CYCL DEF 1.3 PECKG-5\nCYCL DEF 1.4 DWELL 0.5\nCYCL DEF 1.5 F150\nCYCL CALL"),
    "old tapping": ("G00 Z+2 M3*\nG84 P01 -2 P02 -20 P03 0 P04 150*\nG79 M5*\nG85 P01 -2 P02 -20 P03 +1.5*\nG79*",
                    "L Z+2 FMAX M3\nCYCL DEF 2.0\nCYCL DEF 2.1 SET UP-2\nCYCL DEF 2.2 DEPTH-20\nCYCL DEF 2.3 DWELL 0\n"
                    "CYCL DEF 2.4 F150\nCYCL CALL M5\nCYCL DEF 17.0\nCYCL DEF 17.1 SET UP-2\nCYCL DEF 17.2 DEPTH-20\n"
                    "CYCL DEF 17.3 PITCH +1.5\nCYCL CALL"),
    "old slot and pockets": (
        "G00 X+0 Y+0 Z+2 M3*\nG74 P01 -2 P02 -20 P03 -20 P04 100 P05 X+30 P06 Y+12 P07 250*\nG79*\n"
        "G76 P01 -2 P02 -20 P03 -20 P04 100 P05 X+30 P06 Y+20 P07 250 P08 6*\nG79*\n"
        "G77 P01 -2 P02 -20 P03 -20 P04 100 P05 15 P06 250*\nG79*",
        "L X+0 Y+0 Z+2 FMAX M3\nCYCL DEF 3.0\nCYCL DEF 3.1 SET UP-2\nCYCL DEF 3.2 DEPTH-20\nCYCL DEF 3.3 PECKG-20 F100\n"
        "CYCL DEF 3.4 X+30\nCYCL DEF 3.5 Y+12\nCYCL DEF 3.6 F250\nCYCL CALL\nCYCL DEF 4.0\nCYCL DEF 4.1 SET UP-2\n"
        "CYCL DEF 4.2 DEPTH-20\nCYCL DEF 4.3 PECKG-20 F100\nCYCL DEF 4.4 X+30\nCYCL DEF 4.5 Y+20\n"
        "CYCL DEF 4.6 F250 DR+ RADIUS6\nCYCL CALL\nCYCL DEF 5.0\nCYCL DEF 5.1 SET UP-2\nCYCL DEF 5.2 DEPTH-20\n"
        "CYCL DEF 5.3 PECKG-20 F100\nCYCL DEF 5.4 RADIUS15\nCYCL DEF 5.5 F250 DR-\nCYCL CALL"),
    "M functions": ("M3*\nG01 X+10 F300 M103 F20*\nZ-5 M8*\nX+20 M109*", "M3\nL X+10 F300 M103 F20\nL Z-5 M8\nL X+20 M109"),
}  # fmt: skip


BY_TOOLS = ("contours", "old slot and pockets")  # of millimetres, for pockets of millimetres


def din(text: str, unit: str = "G71") -> str:
    return f"%A {unit} *\nN10 T1 G17 S1000 F100 *\n{text}\nN99999999 %A {unit} *\n"


def klartext(text: str, unit: str = "MM") -> str:
    """Numbered, for an assignment below a definition would be a parameter of it."""
    lines = [f"BEGIN PGM A {unit}", "TOOL CALL 1 Z S1000 F100", *text.split("\n"), f"END PGM A {unit}"]
    return "\n".join(f"{k} {line}" for k, line in enumerate(lines)) + "\n"


def assert_same(one: mnc.Run, other: mnc.Run) -> None:
    assert one.ok and other.ok, (one.alarms, other.alarms)
    assert [(a.severity, a.message) for a in one.alarms] == [(a.severity, a.message) for a in other.alarms]
    a, b = one.toolpath, other.toolpath
    assert len(a) == len(b) > 0
    for name in COLUMNS:
        assert np.allclose(getattr(a, name), getattr(b, name), rtol=0, atol=1e-12, equal_nan=True), name
    assert one.variables == other.variables


@pytest.mark.parametrize("name", PAIRS)
def test_the_same_path(tnc, name: str) -> None:
    one, other = PAIRS[name]
    assert_same(tnc(din(one)), tnc(klartext(other)))


@pytest.mark.parametrize("name", [name for name in PAIRS if name not in BY_TOOLS])
def test_the_same_path_in_inches(tnc, name: str) -> None:
    one, other = PAIRS[name]
    assert_same(tnc(din(one, "G70")), tnc(klartext(other, "INCH")))


def with_blanks_left_out(text: str) -> str:
    return "\n".join(line if '"' in line or "DEF" in line or "=" in line else line.replace(" ", "") for line in text.split("\n"))


@pytest.mark.parametrize("name", PAIRS)
def test_blanks_numbers_case_and_stars_do_not_matter(tnc, name: str) -> None:
    text, plain = PAIRS[name][0], tnc(din(PAIRS[name][0]))
    numbered = "\n".join(
        line if line.startswith("  ") or line[0] == "N" else f"N{10 * k}{line}" for k, line in enumerate(text.split("\n"), 5)
    )
    starless = re.sub(r"[ ]*\*(?=\n|$)", "", numbered)
    for other in (numbered, starless, with_blanks_left_out(numbered), numbered.lower(), numbered.replace("\n", "\r\n")):
        again = tnc(din(other))
        assert again.ok, (other, again.alarms)
        assert np.array_equal(again.toolpath.end, plain.toolpath.end)
        assert np.array_equal(again.toolpath.feed, plain.toolpath.feed, equal_nan=True)


CYCLES = [
    code for code, cycle in CONTROL.cycles.items()
    if code.startswith("CYCL DEF") and cycle.parameters() and all(p.address[0] == "Q" for p in cycle.parameters())
    and code not in (*AREA, *LINES)  # which machine contours of blocks
]  # fmt: skip


@pytest.mark.parametrize("code", CYCLES)
def test_every_cycle_of_parameters(tnc, code: str) -> None:
    """The program that shows a cycle, its lines turned into G words one by one."""
    cycle = CONTROL.cycles[code]
    text = program(CONTROL, cycle, {p.name: first_value(p) for p in cycle.parameters() if p.required or written_first(p)})
    assert text is not None
    rules = (
        (r"BEGIN PGM (\w+) MM", r"%\1 G71 *"), (r"END PGM (\w+) MM", r"N99999999 %\1 G71 *"),
        (r"TOOL CALL (\d+) Z S(\d+)", r"T\1 G17 S\2 *"), (r"CYCL DEF (\d\d)\b(?!\d)", r"G1\1"), (r"CYCL DEF (\d+)", r"G\1"),
        (r"(?m)^L (.*?) R0 FMAX(.*)$", r"G00 G40 \1\2 *"),
    )  # fmt: skip
    other = text
    for pattern, by in rules:
        other = re.sub(pattern, by, other)
    assert "CYCL" not in other and "FMAX M" not in other
    one, two = tnc(other), tnc(text)
    assert [a.severity for a in one.alarms] == [a.severity for a in two.alarms]
    assert len(one.toolpath) == len(two.toolpath)
    assert np.array_equal(one.toolpath.end, two.toolpath.end)
    assert one.variables == two.variables
