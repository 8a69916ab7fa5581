"""The travel of the machine: a run stops at the block that would leave it, as a limit switch stops it."""

from functools import partial

import pytest
from tools import running
from tools.running import lines

import mnclab
from mnclab import Limits, Tool

LIMITS = Limits(travel=((-50, 50), (-30, 30), (-100, 0)))
MILL = {1: Tool(radius=3, length=50)}

run = partial(running.run, ok=None, limits=LIMITS, tools=MILL)


@pytest.mark.parametrize(
    ("program", "line", "told"),
    [
        ("T1|G0 X10 Z-60|G1 X60 F100|X20|Q", 3, "X leaves the travel of the machine: the spindle would be at X60.000"),
        ("T1|G0 X10 Z-60|G0 X50|Y-30|Z-150|Z-151", 6, "at Z-101.000"),  # tip and 50 mm of tool; X50 Y-30 is the edge
        ("T1|G0 Z-40", 2, "at Z10.000"),
        ("T1|G0 X20 Y25 Z-60|G2 X40 Y25 I10 J0 F100", 3, "at Y35.000"),  # both ends inside, the top of the arc is not
        ("T1|G0 X20 Y25 Z-60|G3 X40 Y25 I10 J0 F100", None, ""),  # the bottom is
        ("T1|G0 Z-60|G54|G0 X40", 4, "at X60.000"),  # the work offset counts
        ("T1|G0 Z-60|G0 X30 Y28|G41 G1 X40 F100|G1 X45 Y28|X48", 4, "at Y31.000"),  # the tool's centre leaves it
    ],
)
def test_a_run_stops_where_the_travel_ends(program, line, told):
    found = run(lines(program), datums={1: (20, 0, 0)})
    if line is None:
        assert found.ok
        return
    alarm = next(each for each in found.alarms if "travel" in each.message)
    assert alarm.span.line == line and told in alarm.message and "goes from" in alarm.message and not found.ok
    assert found.toolpath.line.max() < line and len(found.steps.block) == line - 1  # what was done before stays


def test_history_and_variables_stop_with_the_path():
    found = run(lines("TOOL CALL 1 Z S1000 F100|L Z-60 R0 FMAX M3|Q1 = 1|L X+60|Q1 = 2|L X+0"), "tnc-620")
    assert found.variables == {"Q1": 1} and found.at(3).position[0] == 0 and found.alarms[-1].span.line == 4


def test_repeated_blocks_stop_at_the_pass_that_leaves():
    text = "TOOL CALL 1 Z S1000 F100|L Z-60 R0 FMAX M3|LBL 1|L IX+20|CALL LBL 1 REP 5|L X+0"
    found = run(lines(text), "tnc-620")
    assert found.toolpath.end[-1, 0] == 40 and "X60.000" in found.alarms[-1].message and found.alarms[-1].span.line == 4


def test_a_length_that_a_program_selects_counts():
    """G43 takes the length 85: tip at Z-160, the reference at -75; at Z-190 it is at -105."""
    found = run(lines("T5 M6|G43 G0 Z-160|G0 Z-190"), "g43", tools={5: Tool(length=85)})
    assert "Z-105.000" in found.alarms[-1].message and found.alarms[-1].span.line == 3


def test_without_a_travel_nothing_ends():
    assert mnclab.run("G0 X1000000\n", "mnc").ok


def test_a_lathe_counts_x_as_radius():
    """NC-31: X8000 is a diameter of 80 mm, radius 40, inside 50; 120 mm is outside."""
    start = {"start": (0, 0, -10), "tools": {}}
    assert run(lines("S800|M3|F20|X8000 ~ *|Z-200 ~"), "nc-31", **start).ok
    assert "X60.000" in run(lines("S800|M3|F20|X12000 ~ *|Z-200 ~"), "nc-31", **start).alarms[-1].message
