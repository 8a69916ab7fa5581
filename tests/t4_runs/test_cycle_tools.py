"""A control without tool words: every cycle is cut with the tool that is made for it."""

import numpy as np
import pytest

import mnclab
from mnclab import Setup, Tool
from mnclab.machine.setup import LATHES
from mnclab.runs.material import cutting_of
from mnclab.show.report import report
from mnclab.workpiece.blank import cylinder

HEAD = "S800\nM3\nF20\nZ200~\nX4000~\n"
BAR = cylinder(20, -60, 0)
OUTSIDE = "G77*~\nX3000*\nZ-2000*\nF2000*\nP300\n"
CYCLES = {
    "G77": (OUTSIDE, 1),
    "G70": ("G70*~\nX3600*\nZ-2000*\nF2000\n", 2),
    "G78": ("G78*~\nX0*\nZ-200*\nF2000*\nP80\n", 1),
    "G73": ("X0~\nG73*\nZ-3000*\nF1000*\nP1000\n", 6),
    "inside G77": ("X1000~\nG77*~\nX2000*\nZ-1500*\nF1000*\nP200\n", 5),
    "G74": ("X2000~\nG74*~\nX3000*\nZ-200*\nF500*\nP400\n", 7),
    "G75": ("X4400~\nZ-1000~\nG75*~\nX3000*\nZ-2000*\nF500*\nP400\n", 3),
    "G32": ("X3800\nG32*\nZ-2000*\nF15000\n", 4),
    "G33": ("X0~\nG33*\nZ-2000*\nF15000\n", 8),
    "G31": ("X4400~\nZ450~\nG31*\nX4000*\nZ-2000*\nF15000*\nP92*\nP25\n", 4),
}


def tools(text, setup=None):
    run = mnclab.run(HEAD + text, "nc-31", setup or Setup(stock=BAR))
    assert run.ok
    cutting = cutting_of(run)
    return run.toolpath, [cutting.tool(row) for row in range(len(cutting))]


@pytest.mark.parametrize("code", CYCLES)
def test_a_cycle_has_its_tool(code):
    text, number = CYCLES[code]
    path, held = tools(text)
    rows = [row for row, move in enumerate(path) if move.label.startswith(code.split(" ")[-1])]
    assert rows and {held[row] for row in rows} == {LATHES[number]}


def test_a_move_of_no_cycle_is_a_roughing_one_and_a_rapid_brings_the_next_tool():
    path, held = tools("X3800\nZ-1000\nX4400~\nZ200~\nX0~\n" + CYCLES["G73"][0])
    cut = (path.label == 0) & (path.kind == mnclab.Kind.LINE)
    assert {held[row] for row in np.flatnonzero(cut)} == {LATHES[1]}
    assert {held[row] for row in np.flatnonzero(path.is_motion & ~cut)} == {LATHES[6]}


def test_a_tool_0_that_cuts_stands_for_all_and_a_number_that_is_missing_for_none():
    blade = Tool(width=2, kind="grooving")
    assert set(tools(OUTSIDE, Setup(tools={0: blade}, stock=BAR))[1]) == {blade}
    _, held = tools(OUTSIDE + CYCLES["G73"][0], Setup(tools={1: LATHES[1]}, stock=BAR))
    assert {tool.kind for tool in held} == {"turning", ""}


def test_a_control_with_tool_words_says_itself_what_cuts():
    run = mnclab.run("M3 S500\nG94 F100\nG00 X18 Z2\nG01 Z-10\n", "jnc-t01", Setup(stock=BAR))
    assert run.workpiece().removed == 0


def test_a_blade_for_faces_leaves_a_groove_beside_its_tip():
    """The tip is the corner nearer to the axis: a groove from 12 to 15, 4 deep, is π (15² − 12²) 4 mm³."""
    run = mnclab.run("M3 S500 T7\nG94 F100\nG00 X12 Z2\nG01 Z-4\nG00 Z2\n", "jnc-t01", Setup(stock=BAR))
    assert run.workpiece().removed == pytest.approx(np.pi * (15**2 - 12**2) * 4) and run.collisions() == ()


def test_volumes_are_those_of_the_tools_of_cycles():
    """A tool that is listed under a number without having one too."""
    setup = Setup(tools={1: Tool(kind="turning", main_angle=90)}, stock=BAR)
    run = mnclab.run(HEAD + OUTSIDE, "nc-31", setup)
    assert list(run.workpiece().removed_by("tool")) == [1] == list(run.removal().by("tool"))


def test_rows_without_a_tool_are_told():
    run = mnclab.run("M3 S500\nG94 F100\nG00 X18 Z2\nG01 Z-10\nT1\nG01 X30\n", "jnc-t01", Setup(stock=BAR))
    assert run.workpiece().notes == ("rows without a tool cut nothing (program:4)",)
    assert run.workpiece(line=3).notes == () == mnclab.run(HEAD + OUTSIDE, "nc-31", Setup(stock=BAR)).workpiece().notes


@pytest.mark.parametrize(("control", "text"), [
    ("jnc-t01", "M3 S500 T1\nG94 F100\nG00 X0 Z2\nG01 Z-4\nG00 Z2\n"),
    ("mnc", "T1\nS500 M3 F100\nG0 X0 Y0 Z2\nG1 Z-4\nG0 Z2\n"),
])  # fmt: skip
def test_a_drill_without_a_radius_is_a_tool(control, text):
    run = mnclab.run(text, control, Setup(tools={1: Tool(kind="drill", angle=118)}, stock=BAR))
    said = ("T1 (drill) has no radius: it cuts nothing (program:4)",)
    assert run.workpiece().notes == said == run.collisions().notes and run.workpiece().removed == 0


def test_moves_of_a_mill_without_a_tool_are_told():
    setup = Setup(stock=((0, 0, -10), (40, 40, 0)))
    cut = "S500 M3\nG0 X-9 Y9 Z2 F100\nG1 Z-3\nX30\n"
    bare, held = (mnclab.run(head + cut, "mnc", setup).workpiece().notes for head in ("", "T1\n"))
    assert bare == ("rows without a tool cut nothing (program:4)",) and held == ()


def test_pictures_and_reports_have_the_tool_of_the_cycle():
    run = mnclab.run(HEAD + CYCLES["G74"][0], "nc-31", Setup(stock=BAR))
    tools, numbers = run.tools_that_cut
    assert set(numbers[run.toolpath.label > 0].tolist()) == {7} and tools[7].kind == "face grooving"
    assert [tuple(row[:2]) for row in report(run).tools.rows][-1] == ("T7", LATHES[7].name)


def test_a_hole_from_the_side_is_left_out_and_noted():
    """The radial drill of G72 makes no body of revolution."""
    text = "S800\nM3\nF20\nZ200~\nX4400~\nZ-3000~\nG72*\nX2000*\nF1000*\nP600\n"
    run = mnclab.run(text, "nc-31", mnclab.Setup(stock=mnclab.blank.cylinder(20, -60, 0)))
    found = run.workpiece()
    assert run.ok and found.removed == 0 and any("without a tool" in note for note in found.notes)
    assert len(run.collisions()) == 0 and not run.collisions().ok  # what nothing cut is not judged
