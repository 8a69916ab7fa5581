"""Tools of the ISO mill: T and M6, H and D, and what a radius compensation is told by."""

from functools import partial

import numpy as np
import pytest
from tools import running

import mnclab
from mnclab import Setup, Tool

run = partial(running.run, control="g43", stopped_spindle="accept")
lines = running.lines
TOOLS = {1: Tool(radius=5, length=80), 2: Tool(radius=3, length=50), 21: Tool(radius=4)}


def heights(text, **given):
    found = run(lines(text), tools=TOOLS, start=(0, 0, 200), **given)
    return (found.toolpath.end[:, 2] + found.toolpath.origin[2]).tolist()


@pytest.mark.parametrize(("text", "z"), [
    ("T1 M6|G43 H1 Z5", 5),
    ("T1 M6|G43 Z5 H1", 5),
    ("M6 T1|G43 H1|G0 Z5", 5),
    ("T1|M6|G43 Z5. H1", 5),
    ("T01 M06|G43 H01|Z5", 5),
    ("T1 M6|G43 H2 Z5", 5 + 50 - 80),  # another's length: the tip is too low by the difference
    ("T1 M6|G44 H1 Z5", 5 - 80 - 80),
    ("T1 M6|G43 H0 Z5", 5 - 80),
    ("T1 M6|G43 H1 Z5|G49 Z5", 5 - 80),
    ("T1 M6|G43 H1 Z5|T2 M6|Z6", 6 + 80 - 50),  # H1 stays until it is written anew
    ("T1 M6|G43 H1 Z5|T2 M6|G43 H2 Z6", 6),
    ("T1 M6|G43 H1 D21 Z5|D2 Z6", 6),  # with H, D is the radius alone
    ("T1 M6|G43 Z5|D2 Z6", 6 + 50 - 80),  # without, it is the length too (7.1)
    ("T1 M6|G91 G43 H1 Z-10", 120 - 10 + 80 - 0),  # the offset is taken up with the increment
])  # fmt: skip
def test_lengths(text, z):
    assert heights(text)[-1] == z


def test_a_length_of_the_tool_before_is_named():
    """Also by G43 alone; not where H or G49 stands before the next motion along Z."""
    text = lines("T1 M6|G43 H1 Z50|T2 M6|{}|Z9")
    said = "H1 is from before the change to T2: its length still counts"
    for between, told in (("X1", 1), ("G43", 1), ("G43 H2", 0), ("G49", 0), ("G91 G28 Z0", 1), ("G53 Z0", 1)):
        found = run(text.format(between), tools=TOOLS, start=(0, 0, 200)).alarms
        assert [alarm.message for alarm in found] == [said] * told, between


def test_on_linuxcnc_the_length_counts_at_once():
    """The coordinates are read anew, so that an increment is no longer than it says."""
    assert heights("G0 T1 M6|G43 H1|G91 Z-10", dialect="linuxcnc")[-1] == 120 - 10
    assert heights("G0 T1 M6|G43 H1|X5|G90 Z5", dialect="linuxcnc")[-1] == 5


@pytest.mark.parametrize(("text", "z"), [
    ("G10 L10 P1 R90|T1 M6|G43 H1 Z5", 5),
    ("T1 M6|G10 L10 P1 R90|G49 Z5", 5 - 90),  # the tool in the spindle is so long
    ("G10 L11 P1 R-0.5|T1 M6|Z5", 5 - 79.5),
    ("G10 L1 P1 Z70|T1 M6|Z5", 5 - 70),
    ("G91 G10 L10 P1 R10|G90 T1 M6|Z5", 5 - 90),
    ("G20 G10 L10 P1 R2|G21 T1 M6|Z5", 5 - 50.8),
    ("G10 L10 P77 R30|G43 H77 Z5", 35),
])  # fmt: skip
def test_g10_writes_lengths(text, z):
    assert heights(text)[-1] == pytest.approx(z, abs=1e-12)


def test_a_row_of_correctors_is_what_g10_writes():
    found = run(lines("G10 L10 P5 R33|G43 H5 Z1"), correctors={5: (0, 0, 20)})
    assert found.toolpath.end[-1, 2] == 34


# --- the radius -------------------------------------------------------------------------------------------------------

CONTOUR = "{0}|G0 X-30 Y-20|{1}|G1 Y30 F100|X40|G0 G40 X70"


def beside(text, **given):
    """How far left of X0 the tool runs."""
    found = run(lines(text), tools=TOOLS, **given)
    return -float(found.toolpath.end[found.toolpath.end[:, 1] == 30][0, 0]), found


@pytest.mark.parametrize(("tool", "begin", "radius"), [
    ("T1 M6", "G0 G41 X0 Y-10 D1", 5),
    ("T1 M6", "G0 G41 X0 Y-10", 5),
    ("T1 M6", "G0 G41 X0 Y-10 D21", 4),
    ("T1 M6", "G41 D2|G0 X0 Y-10", 3),
    ("T1 M6|D2", "G41|G0 X0 Y-10", 3),
    ("T1 M6|G10 L12 P1 R6.5", "G0 G41 X0 Y-10 D1", 6.5),
    ("T1 M6|G10 L13 P1 R-0.25", "G0 G41 X0 Y-10 D1", 4.75),
    ("T4 M6|G10 L12 P4 R1", "G0 G41 X0 Y-10 D4", 1),
])  # fmt: skip
def test_the_radius_is_that_of_d(tool, begin, radius):
    given = {} if "T4" not in tool else {"tools": TOOLS | {4: Tool()}}
    text = lines(CONTOUR.format(tool, begin))
    found = run(text, **({"tools": TOOLS} | given))
    assert -found.toolpath.end[found.toolpath.end[:, 1] == 30][0, 0] == radius and not found.alarms


def test_g10_writes_diameters_on_a_haas():
    assert beside(CONTOUR.format("T1 M6|G10 L12 P1 R13", "G0 G41 X0 Y-10 D1"), dialect="haas")[0] == 6.5


def test_the_diameter_of_linuxcnc_stands_in_the_block():
    assert beside(CONTOUR.format("T1 M6", "G41.1 D9|G0 X0 Y-10"), dialect="linuxcnc")[0] == 4.5


@pytest.mark.parametrize(("tool", "begin", "said"), [
    ("T1", "G0 G41 X0 Y-10", "G41 compensates nothing: T1 is chosen, but not in the spindle"),
    ("T1 M6", "G0 G41 X0 Y-10 D0", "G41 compensates nothing: the radius of D0 is 0"),
    ("T1 M6", "G0 G41 X0 Y-10 D33", "D33 has no row in the tool table: the radius of T1 counts, 5 mm"),
])  # fmt: skip
def test_a_doubtful_radius_is_named(tool, begin, said):
    assert [alarm.message for alarm in beside(CONTOUR.format(tool, begin))[1].alarms] == [said]


def test_compensation_begins_and_ends_at_rapid():
    """The block that begins it ends beside the start of the contour, square to it; the rapid that ends it on its point."""
    found = run(lines("T1 M6|G0 X-30 Y-20|G0 G41 X0 Y-10 D1|G1 Y30 F100|X40|G0 G40 X70 Y40"), tools=TOOLS).toolpath.motion
    assert found.end[1, :2].tolist() == [-5, -10] and found.end[-1, :2].tolist() == [70, 40]


# --- tools that are not there -----------------------------------------------------------------------------------------


def test_without_tools_of_its_own_a_setup_lets_any_tool_run():
    found = mnclab.run("T14 M6\nG43 H14 Z5\n", "g43")
    assert found.ok and found.toolpath.end[-1, 2] == 5 and found.toolpath.tool[-1] == 14
    assert [alarm.message for alarm in found.alarms] == [
        "T14 has no row in the tool table: it counts as a tool without radius and length"
    ]


def test_with_a_tool_table_a_missing_tool_is_an_alarm():
    alarm = mnclab.run("T7 M6\n", "g43", Setup(tools=TOOLS)).alarms[0]
    assert alarm.message == "T7 has no row in the tool table" and alarm.hint == "tools: T0, T1, T2, T21"


def test_a_tool_may_have_a_great_number():
    found = run("T205 M6\nG43 H205 Z3\n", tools={205: Tool(length=10)})
    assert found.toolpath.end[-1, 2] == 3 and np.isin(205, found.toolpath.tool)
