"""Tool length compensation: the examples of its chapter, when offsets act, and what is refused."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import mnclab
from mnclab import Setup, Tool

# The example of the manual (7.1), its run-together lines parted; numbers chosen: D2 = 120, D7 = 85.
EXAMPLE = """T2M6
G54 G17 X20 Y20 {code}
G0 Z30 ; activation of corrector D2, by tool number
G1 F200 Z-50
G0Z30
T5M6
{code} D7 Z20 ; activation of corrector D7
G0 Z30
G1 F200 Z-50
"""
TOOLS = {2: Tool(radius=4, length=120), 5: Tool(radius=5, length=85)}
SETUP = Setup(tools=TOOLS, correctors={2: (0, 0, 120), 7: (0, 0, 85)}, start=(0, 0, 200))


def tip(run, line):
    """Machine coordinates of the tip after a line."""
    rows = run.toolpath[run.toolpath.line <= line]
    return tuple((rows.end[-1] + run.toolpath.origin).tolist())


def base(run, line):
    """Coordinates of the spindle after a line: the tip, above it the length of the tool."""
    x, y, z = tip(run, line)
    return x, y, z + TOOLS[5 if line >= 6 else 2].length


def bases(code):
    run = mnclab.run(EXAMPLE.format(code=code), "g43", SETUP)
    assert run.ok and not run.alarms
    return [base(run, line) for line in range(2, 10)]


def test_the_example_of_the_manual():
    assert bases("G43") == [
        (20, 20, 200),  # Z is not moved by the block of G43
        (20, 20, 30 + 120),
        (20, 20, -50 + 120),
        (20, 20, 30 + 120),
        (20, 20, 30 + 120),  # the spindle stands still at the tool change
        (20, 20, 20 + 85),
        (20, 20, 30 + 85),
        (20, 20, -50 + 85),
    ]


def test_g44_subtracts():
    found = bases("G44")
    assert found[1] == (20, 20, 30 - 120) and found[5] == (20, 20, 20 - 85)


def test_with_the_length_of_the_tool_as_offset_the_tip_goes_where_the_program_says():
    run = mnclab.run(EXAMPLE.format(code="G43"), "g43", SETUP)
    ends = [move.end[2] for move in run.toolpath.motion]
    assert ends == [80, 30, -50, 30, 20, 30, -50]  # at first no offset: the tip hangs 120 below the programmed 200


def test_cancelled_with_the_next_z():
    run = mnclab.run("G0 Z150\nG43 D2 G0 Z30\nG49\nX5\nG0 Z40\n", "g43", SETUP)
    assert [tip(run, k)[2] for k in range(1, 6)] == [150, 150, 150, 150, 40]
    assert list(run.history["length compensation"]) == ["G49", "G43", "G49", "G49", "G49"]


def test_d0_has_no_offsets_and_d_without_values_is_said():
    run = mnclab.run("G43 D0 Z7\nG43 D9 Z8\n", "g43", SETUP)
    assert run.toolpath.end[:, 2].tolist() == [7, 8]
    assert [str(alarm).split("\n")[0] for alarm in run.alarms] == [
        "program:2:5: warning: D9 (corrector) has no offsets: they count as 0 (Setup(correctors={…}) gives them)"
    ]


def test_d_may_stand_anywhere_and_stays():
    run = mnclab.run("D2\nG0 X1\nG43 Z10\nG49 Z10\nG43 Z10\nD7\nX2\nZ10\n", "g43", SETUP)
    assert [tip(run, k)[2] for k in (3, 4, 5, 6, 7, 8)] == [130, 10, 130, 130, 130, 95]


def test_without_a_row_the_corrector_is_the_length_of_the_tool():
    run = mnclab.run("G43 D5 Z10\n", "g43", Setup(tools={5: Tool(length=85, dl=0.5)}))
    assert run.toolpath.end[0, 2] == 95.5


def test_offsets_along_x_and_y_count_with_their_axes():
    run = mnclab.run("G0 X10 Y10 Z10\nG43 D3\nX10\nZ10\nY20 X20\n", "g43", Setup(correctors={3: (1, 2, 3)}))
    assert run.toolpath.end.tolist() == [[10, 10, 10], [11, 10, 10], [11, 10, 13], [21, 22, 13]]


def test_incremental_motion_takes_the_offset_up():
    run = mnclab.run("G0 Z100\nG91 G43 D2 Z-10\nZ-10\n", "g43", SETUP)
    assert run.toolpath.end[:, 2].tolist() == [100, 210, 200]  # programmed 90 and 80, each + 120


@given(st.floats(-200, 200), st.floats(-200, 200), st.floats(-300, 300))
def test_base_is_programmed_plus_offset(offset, z, length):
    setup = Setup(tools={1: Tool(length=length)}, correctors={1: (0, 0, offset)})
    for code, sign in (("G43", 1), ("G44", -1), ("G49", 0)):
        run = mnclab.run(f"T1 M6\nG0 Z1\n{code} Z{z:.4f}\n", "g43", setup)
        assert tip(run, 3)[2] + length == pytest.approx(round(z, 4) + sign * offset, abs=1e-9)


@given(st.lists(st.tuples(st.sampled_from("XYZ"), st.integers(-50, 50)), min_size=1, max_size=8))
def test_equal_tools_make_equal_paths(moves):
    """With G43 and the true length every tool's tip runs the same way, once each axis has moved."""
    text = "T{0} M6\nG43 G0 X0 Y0 Z0\n" + "".join(f"G1 {axis}{value} F100\n" for axis, value in moves)
    paths = [mnclab.run(text.format(n), "g43", SETUP).toolpath.motion.end[1:] for n in (2, 5)]
    assert np.abs(paths[0] - paths[1]).max(initial=0) < 1e-9
