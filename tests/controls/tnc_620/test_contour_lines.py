"""The one contour of a train, a slot or a cylinder surface: how it is read, with its approach and departure apart."""

import numpy as np
import pytest

import mnclab
from mnclab import Setup
from mnclab.controls.tnc_620.contours.line import contour_line
from mnclab.running.cycles import perform
from mnclab.running.interpreter import Interpreter


def line(blocks, before="", in_space=False):
    """The contour that the blocks of label 1 describe."""
    text = f"TOOL CALL 1 Z S1000 F100\n{before}CYCL DEF 14.0 CONTOUR\nCYCL DEF 14.1 CONTOUR LABEL 1\nM2\nLBL 1\n{blocks}\nLBL 0\n"
    interpreter = Interpreter(mnclab.controls["tnc-620"], Setup(), mnclab.read(text, "tnc-620"))
    interpreter.run()
    machine = interpreter.machine
    machine.ended = False
    return perform(machine, "", contour_line(machine, in_space))


def test_open_contour():
    found = line("L X+0 Y+0 RL\nL X+40\nCR X+60 Y+20 R+20 DR+\nL Y+50")
    assert not found.contour.closed and found.side == 1
    assert found.contour.points == pytest.approx(np.array([(0, 0), (40, 0), (60, 20), (60, 50)]))
    assert found.contour.sweeps == pytest.approx([0, np.pi / 2, 0])
    assert found.approach is None and found.departure is None


def test_contour_that_ends_at_its_beginning_is_closed():
    found = line("L X+0 Y+0 RR\nL Y+30\nL X+50\nL X+0 Y+0")
    assert found.contour.closed and len(found.contour.points) == 3 and found.side == -1


@pytest.mark.parametrize(
    ("blocks", "points"),
    [
        ("L X+0 Y+0 RL\nL X+20\nRND R5\nL Y+20", [(0, 0), (15, 0), (20, 5), (20, 20)]),
        ("L X+0 Y+0 RL\nL X+20\nCHF 5\nL Y+20", [(0, 0), (15, 0), (20, 5), (20, 20)]),
        ("L X+0 Y+0 RL\nL X+20\nCT X+30 Y+10", [(0, 0), (20, 0), (30, 10)]),
        ("CC X+0 Y+0\nLP PR+10 PA+0 RL\nCP PA+90 DR+\nLP PR+20 PA+90", [(10, 0), (0, 10), (0, 20)]),
        ("L X+0 Y+0 RL\nFL AN+0 LEN20\nFL AN+90 LEN20", [(0, 0), (20, 0), (20, 20)]),
        ("QL1=20\nL X+0 Y+0 RL\nL IX+QL1\nL IY+QL1", [(0, 0), (20, 0), (20, 20)]),
    ],
)
def test_all_ways_to_write_a_contour(blocks, points):
    assert line(blocks).contour.points == pytest.approx(np.array(points), abs=1e-9)


@pytest.mark.parametrize("first", ["", "L X-30 Y-40 R0\n"])
def test_approach_and_departure_stand_apart(first):
    found = line(f"{first}APPR LT X+0 Y+0 LEN8 RL\nL X+40\nL Y+30\nDEP CT CCA90 R+5")
    assert found.contour.points == pytest.approx(np.array([(0, 0), (40, 0), (40, 30)]))
    assert found.side == 1
    assert (found.approach.lead.form, found.approach.lead.length, found.approach.lead.side) == ("LT", 8, 1)
    assert found.approach.place == (pytest.approx((-30, -40, 0)) if first else None)
    assert (found.departure.lead.form, found.departure.lead.radius) == ("CT", 5)


def test_leads_of_a_mirrored_and_scaled_program_count_as_written():
    """The recording is told in the coordinates of the program that calls, and so are sides and lengths of its leads."""
    before = "CYCL DEF 8.0 MIRROR\nCYCL DEF 8.1 X\nCYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 2\n"
    found = line("APPR LN X+0 Y+0 LEN8 RL\nL X+40\nDEP CT CCA90 R+5", before)
    assert found.contour.points == pytest.approx(np.array([(0, 0), (40, 0)]))
    assert found.side == found.approach.lead.side == 1
    assert found.approach.lead.length == pytest.approx(8) and found.departure.lead.radius == pytest.approx(5)


def test_helix_keeps_its_heights():
    """Three turns and a half of pitch 2: seven halves of a circle, each 1 mm lower."""
    found = line("L X+10 Y+0 Z+0 RL\nCC X+0 Y+0\nCP IPA+1260 DR+ Z-7", in_space=True)
    assert found.contour.sweeps == pytest.approx(np.full(7, np.pi))
    assert found.heights == pytest.approx(-np.arange(8.0))
    assert len(set(found.steps.tolist())) == 1


@pytest.mark.parametrize(
    ("blocks", "in_space", "place", "message"),
    [
        ("L X+0 Y+0 RL\nL X+20\nAPPR LT X+40 Y+0 LEN8 RL\nL X+60", False, 8, "APPR LT must begin the contour of label 1"),
        ("L X+0 Y+0 RL\nL X+20\nDEP LT LEN5\nL X+60", False, 9, "the contour of label 1 ends with DEP LT, this block stands"),
        ("APPR LT X+40 Y+0 LEN8 RL", False, None, "label 1 describes no contour"),
        ("L X+0 Y+0 RL\nL X+20 Z-3", False, None, "the contour of label 1 moves along the tool axis"),
        ("L X+0 Y+0 Z-3 RL\nL X+20", False, None, "the contour of label 1 moves along the tool axis"),
        ("L X+0 Y+0 RL\nL X+20 Z-3", True, None, "the contour of label 1 must begin with X, Y and Z"),
        ("L X+0 Y+0 Z+0 RL\nL Z-3", True, None, "the contour of label 1 has no length in the plane XY"),
        ("L X+0 RL\nL Y+20", False, None, "the contour of label 1 must begin with both coordinates of the plane"),
    ],
)
def test_refused(blocks, in_space, place, message):
    with pytest.raises(mnclab.Alarm, match=message) as fault:
        line(blocks, in_space=in_space)
    assert place is None or fault.value.span.line == place
