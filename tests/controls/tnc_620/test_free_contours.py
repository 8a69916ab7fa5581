"""Free contour programming: the manual's example, geometry that can be worked out by hand, what is refused."""

import json
import math
import time
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import mnclab as mnc
from mnclab.controls.tnc_620.contours.area import area_of, labelled_shapes
from mnclab.controls.tnc_620.state import memory
from mnclab.running.cycles import perform
from mnclab.running.interpreter import Interpreter

EXAMPLES = Path(__file__).parents[2] / "authorities" / "catalogue" / "tnc620-klartext.json"
(C20,) = [e for e in json.loads(EXAMPLES.read_text(encoding="utf-8")) if e["code"] == "FK"]


def corners(run):
    """Ends (n, 2) of the cutting moves of the programmed contour."""
    path = run.programmed
    return path.end[(path.kind == mnc.Kind.LINE) | (path.kind == mnc.Kind.ARC), :2]


def test_the_example_of_the_manual(tnc):
    run = tnc("TOOL CALL 1 Z S1000 F100\nCALL LBL 1\nM30\n" + C20["program"] + "\n")
    check, found = C20["check"], corners(run)
    assert run.ok and not run.alarms
    expected = [(0, 30), check["P1"], check["P2"], check["P3"], check["P4"], (0, 30)]
    assert found == pytest.approx(np.array(expected), abs=6e-4)
    arcs = run.programmed[run.programmed.kind == mnc.Kind.ARC]
    centres = [check["center_1"], check["center_2"], check["center_1"]]
    assert arcs.centre[:, :2] == pytest.approx(np.array(centres), abs=6e-4)
    assert run.programmed.points(1e-4)[0][:, 1].max() == pytest.approx(check["highest_y"], abs=1e-3)
    # [derived: tnc620-contour, C20] sweeps of the three arcs, and the perimeter
    assert np.degrees(arcs.sweep) == pytest.approx([-100.529, -300, -220.529], abs=1e-3)
    assert sum(move.length for move in cutting(run)[1:]) == pytest.approx(291.616, abs=1e-3)


def cutting(run):
    """One path for each cutting move."""
    path = run.programmed
    return [path[k : k + 1] for k in range(len(path)) if path.kind[k] in (mnc.Kind.LINE, mnc.Kind.ARC)]


def test_the_example_is_the_contour_of_cycle_14():
    text = "CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL 1\nM2\n" + C20["program"] + "\n"
    interpreter = Interpreter(mnc.controls["tnc-620"], mnc.Setup(), mnc.read(text, "tnc-620"))
    interpreter.run()
    machine = interpreter.machine
    machine.ended = False
    region = area_of(machine, *perform(machine, "", labelled_shapes(machine, memory(machine).contour)))
    assert region.area == pytest.approx(4212.730, abs=1e-3)  # [derived: tnc620-contour, C20]
    assert machine.tip == (0, 0, 0) and machine.pending is None


#: name -> blocks, ends of the elements as worked out in the comment
KNOWN = {
    # 50 mm at atan2(3, 4), the rest from the triangle 3-4-5
    "polar": ("2 FPOL X+10 Y+10\n3 FL PR+50 PA+36.86989764584402\n4 FL IPR-25 PA+36.86989764584402",
              [(50, 40), (30, 25)]),
    "polar angle": ("2 L X+20\n3 FPOL X+0 Y+0\n4 FL PR+20 IPA+90\n5 FL PR+20 IPA+90", [(20, 0), (0, 20), (-20, 0)]),
    "length and angle": ("2 FL LEN10 AN+90\n3 FL LEN10 IAN-90\n4 FL LEN10 IAN-90", [(0, 10), (10, 10), (10, 0)]),
    "angle of a block": ("2 FL LEN10 AN+90\n3 FL LEN10 AN+0\n4 FL LEN5 IAN+90 RAN 2", [(0, 10), (10, 10), (5, 10)]),
    "relative": ("2 FL X+10 Y+5\n3 FL X+20 Y+5\n4 FL IX+30 RX 2 IY+1 RY3", [(10, 5), (20, 5), (40, 6)]),
    # a line into a quarter of a circle of radius 10 that ends upwards
    "rounded corner": ("2 FL AN+0\n3 FCT DR+ R10\n4 FLT AN+90 X+50 Y+60", [(40, 0), (50, 10), (50, 60)]),
    # the tangent common to two equal circles is parallel to the line of centres
    "belt": ("2 FC DR+ R10 CCX+0 CCY+10\n3 FLT\n4 FCT DR+ R10 CCX+0 CCY+50\n5 FLT\n6 FCT DR+ R10 CCX+0 CCY+10 X+0 Y+0",
             [(10, 10), (10, 50), (-10, 50), (-10, 10), (0, 0)]),
    # circle of radius 5 between a line at y = 0 and one at x = 30: its centre is (25, 5)
    "point beside": ("2 FL AN+0 \n3 FL AN+90 PDX+35 PDY+0 D5\n4 FSELECT 2\n5 FL Y+20 X+0 AN+180",
                     [(30, 0), (30, 20), (0, 20)]),
    "points on the element": ("2 FL P1X+30 P1Y+0 X+40\n3 FL P1X+40 P1Y+3 P2X+40 P2Y+8 Y+20", [(40, 0), (40, 20)]),
    # Thales: the circle through (0, 0), (20, 0) and (10, 10) has its centre at (10, 0)
    "arc through points": ("2 FC DR- P1X+10 P1Y+10 X+20 Y+0", [(20, 0)]),
    "three points": ("2 FC DR- P1X+10 P1Y+10 P2X+20 P2Y+0 P3X+10 P3Y-10 X+10 Y-10", [(10, -10)]),
    "central angle": ("2 FC DR+ CCX+0 CCY+10 CCA90\n3 FLT LEN5", [(10, 10), (10, 15)]),
    "chord and tangent": ("2 FC DR+ R10 AN+0 LEN20", [(0, 20)]),  # the chord is the diameter
    "circle": ("2 FC DR+ CCX+0 CCY+10 CCA360", [(0, 0)]),
    "centre relative": ("2 FL X+10 Y+0\n3 FC DR+ ICCX+0 ICCY+5 CCA180\n4 FC DR- ICCX+0 RCCX2 ICCY+15 RCCY2 CCA180",
                        [(10, 0), (10, 10), (10, 20)]),
    "centre polar": ("2 FPOL X+0 Y+0\n3 FC DR+ CCPR+10 CCPA+90 CCA180", [(0, 20)]),
    "parallel": ("2 FL LEN20 AN+0\n3 FL AN+90\n4 FL PAR2 DP15 X+0 AN+180", [(20, 0), (20, 15), (0, 15)]),
    "closed": ("2 FL CLSD+ X+30 Y+0\n3 FL AN+90 LEN20\n4 FL CLSD-", [(30, 0), (30, 20), (0, 0)]),
    "closed after others": ("2 FL CLSD+ X+30 Y+0\n3 L Y+20\n4 FL CLSD-", [(30, 0), (30, 20), (0, 0)]),
    # the triangle 3-4-5 again: two lengths settle the corner, clockwise or not
    "two lengths": ("2 FL LEN30\n3 FL LEN40 X+50 Y+0\n4 FSELECT 2", [(18, 24), (50, 0)]),
    # nothing but tangency: the line leaves a circle about (0, 10) at height 10 + 6 and meets one of radius 10 about (50, 10)
    "crossed belt": ("2 FC DR+ R10 CCX+0 CCY+10\n3 FLT\n4 FCT DR- R10 CCX+50 CCY+10 X+60 Y+10",
                     [(4, 10 - math.sqrt(84)), (46, 10 + math.sqrt(84)), (60, 10)]),
    "after a line": ("2 L X+10\n3 FCT DR+ R5 CCA90\n4 FLT LEN5", [(10, 0), (15, 5), (15, 10)]),
    "chamfer and formula in an open chain": ("2 FL AN+0\n3 CHF2\n4 Q1=20\n5 FL AN+90 X+30 Y+Q1", [(30, 0), (30, 20)]),
    "rounding between": ("2 FL X+30 Y+0\n3 RND R5\n4 Q1=20\n5 FL AN+90 Y+Q1", [(30, 0), (30, 20)]),
}  # fmt: skip


@pytest.mark.parametrize("name", KNOWN)
def test_by_hand(inside, name):
    blocks, expected = KNOWN[name]
    run = inside(blocks)
    assert not run.alarms
    assert corners(run) == pytest.approx(np.array(expected, dtype=float), abs=1e-9)


def test_rows_and_history_belong_to_their_blocks(inside):
    run = inside("2 FL AN+0 F50 M3\n3 FCT DR+ R10\n4 FLT AN+90 X+50 Y+60 F70\n5 L X+0 M5")
    path = run.toolpath
    moves = path[path.is_motion]
    assert moves.line.tolist() == [3, 4, 5, 6] and moves.feed.tolist() == [50, 50, 70, 70]
    assert run.at(3).position == (40, 0, 0) and run.at(5).position == (50, 60, 0)
    assert [int(kind) for kind in path.kind[-2:]] == [mnc.Kind.LINE, mnc.Kind.SPINDLE]


def test_the_tool_runs_beside_free_elements(inside):
    free = inside("2 L X+0 Y+0 RL\n3 FL AN+0\n4 RND R8\n5 FL AN+90 X+50 Y+60\n6 FL X+0 AN+180\n7 L X-20 R0")
    plain = inside("2 L X+0 Y+0 RL\n3 L X+50\n4 RND R8\n5 L Y+60\n6 L X+0\n7 L X-20 R0")
    assert free.ok and free.toolpath.end == pytest.approx(plain.toolpath.end, abs=1e-9)
    assert free.toolpath.side.tolist() == plain.toolpath.side.tolist()


def test_free_elements_are_turned_with_the_frame(inside):
    blocks = "10 FL AN+0\n11 FCT DR+ R10\n12 FLT AN+90 X+50 Y+60"
    straight, turned = inside(blocks), inside("2 CYCL DEF 10.0 R\n3 CYCL DEF 10.1 ROT+90\n" + blocks)
    assert corners(turned) == pytest.approx(corners(straight) @ np.array([[0, 1], [-1, 0]]), abs=1e-9)


def test_inches(tnc):
    run = tnc("BEGIN PGM A INCH\nFL AN+0 F10\nFCT DR+ R1\nFLT AN+90 X+5 Y+6\nFL PAR2 DP1 X+0\nEND PGM A INCH\n")
    assert [a.message for a in run.alarms] == ["PAR2 must name an earlier block of a free contour, block 2 is none"]
    run = tnc("0 BEGIN PGM A INCH\n1 FL AN+0 F10\n2 FCT DR+ R1\n3 FLT AN+90 X+5 Y+6\n4 FL PAR1 DP6 X+0\n5 END PGM A INCH\n")
    assert corners(run) == pytest.approx(25.4 * np.array([(4, 0), (5, 1), (5, 6), (0, 6)]), abs=1e-9)


def test_a_repeated_free_contour(inside):
    run = inside("2 LBL 1\n3 FL LEN10 IAN+90\n4 CALL LBL 1 REP 2", None)
    assert [a.span[:2] for a in run.alarms] == [(4, 12)]  # nothing arrives at the first element
    run = inside("2 L X+10\n3 LBL 1\n4 FL LEN10 IAN+90\n5 CALL LBL 1 REP 2")
    assert corners(run) == pytest.approx(np.array([(10, 0), (10, 10), (0, 10), (0, 0)]), abs=1e-9)


BLANK = "BLK FORM 0.1 Z X-5 Y-5 Z-5\nBLK FORM 0.2 X+60 Y+30 Z+0\n"


def test_without_fselect_the_blank_decides_with_a_warning(inside):
    run = inside(BLANK + "2 FL LEN30\n3 FL LEN40 X+50 Y+0")
    (warning,) = run.alarms
    assert (warning.severity, warning.span.line, warning.hint) == ("warning", 6, "FSELECT 2 says so")
    assert corners(run) == pytest.approx(np.array([(18, 24), (50, 0)]), abs=1e-9)


def test_without_fselect_the_contour_that_closes_is_taken(inside):
    # the line at y = 0 meets the circle about (20, 0) again at x = 40 and at its start, where the contour closes
    run = inside("2 FC DR+ R20 CCX+20 CCY+0 X+40 Y+0\n3 FC DR+ R20 CCX+20 CCY+0 Y+0")
    assert [a.severity for a in run.alarms] == ["warning"]
    assert corners(run) == pytest.approx(np.array([(40, 0), (0, 0)]), abs=1e-9)


HEAD = "0 BEGIN PGM A MM\n1 TOOL CALL 1 Z S1000 F100\n"





@pytest.mark.deep
@pytest.mark.parametrize("pairs", [1, 6, 40])
@pytest.mark.parametrize("pair", ["FC DR- R15\nFLT\nRND R2", "FCT R7\nFCT R7\nRND R1", "FC\nFL", "FL LEN20\nFCT DR+ R5"])
def test_what_is_missing_is_said_soon(pair, pairs):
    begin = time.thread_time()
    blocks = "\n".join([pair] * pairs)
    run = mnc.run(f"{HEAD}L X+0 Y+0 F100\nL X+1\n{blocks}\nL X+50\n", "tnc-620")
    assert time.thread_time() - begin < 15  # a second or less; it was up to a minute
    (alarm,) = (alarm for alarm in run.alarms if alarm.severity == "alarm")
    assert "the free contour is not determined" in alarm.message or "too many solutions to follow" in alarm.message


def test_a_contour_needs_a_start(tnc):
    run = tnc("CYCL DEF 14.0 C\nCYCL DEF 14.1 LABEL 1\nLBL 1\nFL X+5 Y+0 F100\nLBL 0\n")
    assert run.ok  # outside a recording the tool stands somewhere
    text = "LBL 1\nFL X+0 Y+0\nLBL 0\n"
    interpreter = Interpreter(mnc.controls["tnc-620"], mnc.Setup(), mnc.read("M2\n" + text, "tnc-620"))
    interpreter.run()
    machine = interpreter.machine
    machine.ended = False
    with pytest.raises(mnc.Alarm, match="needs a point to begin from"):
        machine.record("1")


MUTATED = HEAD + "2 L X+10 Y+5\n" + "\n".join(blocks for blocks, _ in list(KNOWN.values())[:12]) + "\n" + C20["program"] + "\n"
SCRAPS = st.sampled_from([
    "X", "+", "-", ".", "9", "0", " ", "\n", "I", "Q1", "RL", "FMAX", "DR-", "DR+", "R10 ", "AN+45 ", "LEN5 ", "CLSD+ ", "CLSD- ",
    "FLT\n", "FCT R5 DR+\n", "FL\n", "FC\n", "FSELECT 2\n", "FPOL X+0 Y+0\n",
    "PAR3 ", "RX2 ", "D5 ", "CCX", "PR", "PA", "CCA", "RND R1\n",
    "M3 ", "LBL 0\n", "CALL LBL 1\n", "99999999", "P1X+1 P1Y+2 ", "L X+5\n", "0.0000001",
])  # fmt: skip


@pytest.mark.deep
@settings(max_examples=60, deadline=None)
@given(edits=st.lists(st.tuples(st.integers(0, len(MUTATED)), st.integers(0, 25), SCRAPS), min_size=1, max_size=6))
def test_mutated_programs_raise_only_alarms(edits):
    text = MUTATED
    for at, cut, scrap in edits:
        text = text[:at] + scrap + text[at + cut :]
    run = mnc.run(text, "tnc-620")
    str(run.toolpath), repr(run)
