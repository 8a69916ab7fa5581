"""Tools along X and Y: working planes YZ and ZX (catalogue: TOOL CALL).

A program with its letters changed round, X for Y for Z, draws its path turned in the same way: what other tests work out for
the tool axis Z holds for the others.
"""

from __future__ import annotations

import math
import re

import numpy as np
import pytest

import mnclab as mnc
from mnclab.controls.tnc_620.language.tools import NAMED, TURNED
from mnclab.machine.trial import first_value, program, written_first

ROUND = {"X": {"X": "Y", "Y": "Z", "Z": "X"}, "Y": {"X": "Z", "Y": "X", "Z": "Y"}}  # by tool axis
CONTROL = mnc.controls["tnc-620"]
AXES = pytest.mark.parametrize("axis", ["X", "Y"])
MACHINE = {"tools": {1: mnc.Tool(radius=5, length=50, plunge_angle=30), 2: mnc.Tool(radius=4, length=30, angle=118)}}


def renamed(text: str, axis: str) -> str:
    """Letters changed round, before numbers, in a tool call and behind cycle 8."""
    return re.sub(
        r"(?<=TOOL CALL \d )Z|[XYZ](?=[+-])|(?<=8\.1 )[XYZ]", lambda found: ROUND[axis][found.group()], text
    )


def rolled(points: np.ndarray, axis: str) -> np.ndarray:
    turned = np.empty_like(points)
    turned[:, ["XYZ".index(ROUND[axis][letter]) for letter in "XYZ"]] = points
    return turned


def same_turned(text: str, axis: str, setup: mnc.Setup) -> mnc.Run:
    """The run of the program with its letters changed round, which draws the same."""
    flat, other = mnc.run(text, "tnc-620", setup), mnc.run(renamed(text, axis), "tnc-620", setup)
    assert flat.ok and other.ok, (flat.alarms, other.alarms)
    one, two = flat.toolpath, other.toolpath
    assert len(one) == len(two) > 3 and one.kind.tolist() == two.kind.tolist()
    for name in ("end", "centre", "axis"):
        assert getattr(two, name) == pytest.approx(rolled(getattr(one, name), axis), abs=1e-9, nan_ok=True), name
    for name in ("sweep", "feed", "time", "spindle", "radius", "side"):
        assert getattr(two, name) == pytest.approx(getattr(one, name), abs=1e-9, nan_ok=True), name
    wanted = flat.history.value("position", 10**6)
    assert other.history.value("position", 10**6) == pytest.approx(rolled(np.array([wanted]), axis)[0], abs=1e-9)
    return other


@AXES
def test_contours(axis: str) -> None:
    """Compensation, corners, arcs, polar points, a helix, approaches and departures, under a shift and a rotation."""
    text = """BEGIN PGM A MM
TOOL CALL 1 Z S1000 F200 DL+0.5 DR-0.25
CYCL DEF 7.0 D
CYCL DEF 7.1 X+5
CYCL DEF 7.2 Y-3
CYCL DEF 7.3 Z+1
CYCL DEF 10.0 R
CYCL DEF 10.1 ROT+30
CYCL DEF 8.0 M
CYCL DEF 8.1 X
L X-20 Y-20 Z+20 R0 FMAX M3
L Z-5 F100
APPR LCT X+0 Y+0 Z-6 R6 RL F300
L Y+40
RND R8
L X+40
CHF 5
L Y+20
CR X+20 Y+0 R+20 DR-
CT X+5 Y-8
DEP LCT X-20 Y-20 Z+10 R5 F400
CC X+10 Y+10
LP PR+15 PA+30 FMAX
CP IPA+500 IZ-4 DR+
LP IPA+20 IPR-3
APPR LN X+30 Y+30 LEN5 RR
L X+60 Y+20
DEP CT CCA90 R6 Z+20
APPR CT X+30 Y+30 CCA80 R6 RR
L X+10 Y+35
DEP LN LEN10
L Z+30 FMAX M91
END PGM A MM
"""
    same_turned(text, axis, mnc.Setup(**MACHINE))


def trial(code: str) -> str:
    cycle = CONTROL.cycles[code]
    text = program(CONTROL, cycle, {p.name: first_value(p) for p in cycle.parameters() if p.required or written_first(p)})
    assert text is not None, code
    return text


@pytest.mark.parametrize("code", sorted(code for code in TURNED - {"CYCL DEF 18"} if code.startswith("CYCL")))
def test_every_cycle_runs_along_the_tool(code: str) -> None:
    for axis in "XY":
        same_turned(trial(code), axis, mnc.Setup())


@AXES
def test_cycles_under_transformations_and_at_positions(axis: str) -> None:
    """CYCL CALL POS, M89, a shifted and turned datum, a thread."""
    definition = "CYCL DEF 251 P\nQ215=0\nQ218=40\nQ219=30\nQ220=6\nQ368=0\nQ224=20\nQ367=0\nQ207=300\nQ351=1\nQ201=-6\nQ202=3\n"
    definition += "Q369=0\nQ206=100\nQ338=0\nQ385=400\nQ200=2\nQ203=+1\nQ204=20\nQ370=1\nQ366=1\n"
    text = f"""BEGIN PGM A MM
TOOL CALL 1 Z S1000 F200
CYCL DEF 7.0 D
CYCL DEF 7.1 X+5
CYCL DEF 7.2 Z+2
CYCL DEF 10.0 R
CYCL DEF 10.1 ROT-25
L X+0 Y+0 Z+50 R0 FMAX M3
{definition}CYCL CALL POS X+30 Y+20 Z-3 FMAX
CYCL DEF 200 D
Q200=2
Q201=-5
Q206=100
Q202=3
Q210=0
Q203=+0
Q204=20
Q211=0
L X+5 Y+5 R0 FMAX M89
L X+15
L Y+15 M99
CYCL DEF 18.0 T
CYCL DEF 18.1 DEPTH-8
CYCL DEF 18.2 PITCH+1
L X+25 R0 FMAX M5
L Y+25 R0 FMAX M99
END PGM A MM
"""
    same_turned(text, axis, mnc.Setup(**MACHINE))


@AXES
def test_many_holes_at_once(axis: str) -> None:
    """As many as are made as columns, on lines and one by one."""
    holes = "\n".join(f"L X+{k} Y+{3 * k % 7} R0 FMAX M99" for k in range(1, 60))
    definition = "CYCL DEF 200 D\nQ200=2\nQ201=-5\nQ206=100\nQ202=3\nQ210=0\nQ203=+0\nQ204=20\nQ211=0\n"
    lines = "CYCL DEF 221 P\nQ225=1\nQ226=2\nQ237=3\nQ238=4\nQ242=20\nQ243=20\nQ224=10\nQ200=2\nQ203=0\nQ204=20\nQ301=1\n"
    start = "BEGIN PGM A MM\nTOOL CALL 2 Z S1000 F200\nL X+0 Y+0 Z+50 R0 FMAX M3\n"
    same_turned(f"{start}{definition}{lines}{definition}{holes}\nEND PGM A MM\n", axis, mnc.Setup(**MACHINE))


def test_the_length_lies_along_the_tool_axis(tnc) -> None:
    """The spindle stands while tools and axes change: its reference is the tip and the length along the axis."""
    calls = "TOOL CALL 1 Z S1\nTOOL CALL 2 X\nTOOL CALL Y\nTOOL CALL 1 Y DL+2\nTOOL CALL 2 Z\n"
    run = tnc(f"BEGIN PGM A MM\n{calls}END PGM A MM\n", mnc.Setup(**MACHINE))
    tips = run.toolpath.end[run.toolpath.kind == mnc.Kind.TOOL]
    assert run.ok and tips.tolist() == [[0, 0, -50], [-30, 0, 0], [0, -30, 0], [0, -52, 0], [0, 0, -30]]
    stood = [str(run.explain(line=line)).splitlines()[-1].split() for line in (2, 3, 4, 6)]
    assert [words[3:6] for words in stood] == [["X0", "Y0", "Z0"]] * 4


@pytest.mark.parametrize(("axis", "number"), [("X", 0), ("Y", 1), ("Z", 2)])
def test_q109_and_the_plane(axis: str, number: int, tnc) -> None:
    run = tnc(f"BEGIN PGM A MM\nTOOL CALL 1 {axis} S1\nQ1 = Q109\nEND PGM A MM\n")
    assert run.ok and run.variables["Q1"] == number
    assert run.history.value("plane", 3) in ({"X": "YZ", "Y": "ZX", "Z": "XY"}[axis], None)


def test_what_a_lying_tool_cuts(tnc) -> None:
    """It comes from +Y, and its tip to Y-20 at rapid: right through the block, 40 mm long."""
    text = "BEGIN PGM A MM\nBLK FORM 0.1 Y X+0 Y+0 Z-20\nBLK FORM 0.2 X+60 Y+40 Z+0\nTOOL CALL 1 {} S1000 F100\n"
    text += "L X+30 Y-20 Z-10 R0 FMAX M3\nL Y+30\nL Y-20 FMAX\nEND PGM A MM\n"
    lying = tnc(text.format("Y"), mnc.Setup(**MACHINE))
    assert lying.workpiece().removed == pytest.approx(math.pi * 25 * 40, rel=1e-3)
    (met,) = lying.collisions()
    assert (met.kind, met.line, met.depth) == ("rapid", 5, pytest.approx(40))
    assert tnc(text.format("Z")).workpiece().volume < 60 * 40 * 20


def test_every_cycle_is_sorted() -> None:
    """Of those that run with other tool axes each exists, and none is in both lists."""
    assert {*TURNED, *NAMED} <= CONTROL.cycles.keys() and not TURNED & NAMED
