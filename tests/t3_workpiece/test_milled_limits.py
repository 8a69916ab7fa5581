"""What a map of heights cannot hold is said with the lines it comes from."""

from dataclasses import replace

import numpy as np
import pytest
from tools.milled import BLOCK, MILL, part
from tools.running import run

from mnclab import Tool
from mnclab.workpiece.blank import cylinder
from mnclab.workpiece.milling import tilted
from mnclab.workpiece.milling.milled import Milled

SLOT = "G0 X-10 Y20\nG1 Z-8\nG1 X70\nG0 Z50"
HOLE = "G0 X30 Y20\nG1 Z-8\nG0 Z50"


def test_a_plain_part_has_no_notes_and_is_exact():
    left = part(SLOT)
    assert left.notes == () and left.method == "exact sweep" and left.error == 1e-9
    assert repr(left).startswith("<Milled: ") and "note" not in repr(left)


@pytest.mark.parametrize("kind", ["tap", "thread mill"])
def test_a_thread_is_shown_without_its_flanks(kind):
    left = part(HOLE, Tool(radius=3, number=1, kind=kind, pitch=1))
    (note,) = left.notes
    assert note == f"a thread is shown without its flanks, at the radius of the {kind} (program:6)"
    assert left.at(32.99, 20) == -8
    assert "note: a thread" in repr(left)


def test_a_cutter_with_a_thin_neck_may_leave_an_overhang():
    slotter = Tool(radius=5, number=1, kind="mill", shank=(2, 3))
    (note,) = part(SLOT, slotter).notes
    assert note == "what overhangs an undercut is not shown: there the part is open upwards (program:7)"
    shallow = SLOT.replace("Z-8", "Z-3")
    assert part(shallow, slotter).notes == ()  # the neck stays above the blank
    assert part(HOLE, slotter).notes == ()  # it takes all that is above it on its way down
    assert part(SLOT, Tool(radius=5, number=1, kind="mill", shank=(6, 3))).notes == ()


def test_a_pass_under_what_is_cut_already_is_no_undercut():
    deeper = "G0 X-10 Y20\nG1 Z-3\nG1 X70\nG1 Z-6\nG1 X-10\nG0 Z50"
    assert part(deeper, Tool(radius=5, number=1, kind="mill", shank=(2, 3))).notes == ()


def test_the_bore_of_a_lying_tube_is_not_shown():
    (note,) = part("G0 X0", stock=cylinder(6, 0, 40, axis="X", bore=3)).notes
    assert note == "the bore of a lying blank is not shown"


def test_rows_of_too_many_tilted_moves_are_left_out_and_told(monkeypatch):
    text = """TOOL CALL 1 Z S1000 F500
L X+10 Y+20 Z+50 R0 FMAX M3
L Z-2 F500
L X+50
L Z+50 FMAX
CYCL DEF 19.0 WORKING PLANE
CYCL DEF 19.1 A+0 B+45 C+0 F5000 ABST50
L X+10 Y+20 Z+50 R0 FMAX
L Z-2 F500
"""
    monkeypatch.setattr(tilted, "MOST", 1)
    left = run(text, "tnc-620", tools={1: MILL}, stock=BLOCK).workpiece()
    (note,) = left.notes
    assert note == "2 rows of tilted tools, more than 1, are left out (program:8, program:9)"
    assert left.at(30, 20) == -2 and left.removed == pytest.approx((10 * 40 + 25 * 3.14159265) * 2, rel=1e-3)


def test_one_row_of_a_tool_that_turns_is_one_row():
    text = "TOOL CALL 1 Z S1000 F500\nL X+10 Y+20 Z+50 R0 FMAX M3\nL Z+20 FMAX\nL Z-2 F500\n"
    cutting = run(text, "tnc-620", tools={1: MILL}, stock=BLOCK).workpiece().cutting
    directions = np.zeros((len(cutting), 3, 3)) + (0.0, 0.0, 1.0)
    directions[-1, 2] = 0.0, 0.6, 0.8
    (note,) = Milled(replace(cutting, directions=directions)).notes
    assert note == "1 row on which the tool turns is left out (program:4)"
