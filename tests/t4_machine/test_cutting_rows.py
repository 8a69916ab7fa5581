"""What rows cut with: tools as their table stands, tilted rows, the blank in the coordinates of a path."""

import math

import numpy as np
import pytest

import mnclab
from mnclab import Setup, Tool
from mnclab.machine.cutting import directions_of_rows, start_known, stock_of, tools_of_rows
from mnclab.workpiece.blank import Box, cylinder

STEPS = np.array([0, 1, 2, 3, 4])


def test_a_row_has_the_tool_as_its_table_stands():
    """A call with DL 0.5 lifts the tip by as much; what the program wrote into the table before counts."""
    table, worn = Tool(radius=5, length=80, number=1), Tool(radius=4.9, length=80, number=1)
    called = Tool(radius=5, length=80, number=1, dl=0.5, dr=0.2)

    def value(name, step):
        return worn if name == "tools 1" and step >= 3 else None

    tools, which, lift = tools_of_rows(STEPS, [(1, called), (3, called)], {1: table}, value)
    assert [tools[k].radius for k in which] == [0, 5, 5, 4.9, 4.9]
    assert lift.tolist() == [0, 0.5, 0.5, 0.5, 0.5]


def test_a_tool_of_no_table_is_itself():
    held = Tool(radius=3, length=50, number=9)
    tools, which, lift = tools_of_rows(STEPS, [(2, held)], {}, lambda name, step: None)
    assert [tools[k].radius for k in which] == [0, 0, 3, 3, 3] and not lift.any()


def test_a_tool_that_is_not_as_its_table_says():
    """0.3 shorter than the table, so its tip stands 0.3 higher, and 0.5 more with DL 0.5 in the call; 0.1 thinner."""
    table, true = Tool(radius=5, length=80, number=1), {1: Tool(radius=4.9, length=79.7)}
    calls = [(1, table), (3, Tool(radius=5, length=80, number=1, dl=0.5))]
    tools, which, lift = tools_of_rows(STEPS, calls, {1: table}, lambda name, step: None, true)
    assert [tools[k].radius for k in which] == [0, 4.9, 4.9, 4.9, 4.9] and tools[1].number == 1
    assert lift == pytest.approx([0, 0.3, 0.3, 0.8, 0.8])


def path_of(rotary=None, kinematics=None):
    """Five lines, one a step."""
    columns = {"kind": np.full(5, int(mnclab.Kind.LINE), dtype=np.uint8), "step": STEPS}
    return mnclab.Toolpath(columns | ({"rotary": rotary} if rotary is not None else {}), kinematics=kinematics)


def test_only_a_frame_that_leans_turns_the_tool_on_the_part():
    """About X by 0.3 the tool stands along (0, -sin 0.3, cos 0.3); a tool axis Y lies along Y of the frame."""
    leaning, turned = np.eye(4), np.eye(4)
    c, s = np.cos(0.3), np.sin(0.3)
    leaning[1:3, 1:3] = turned[:2, :2] = [[c, -s], [s, c]]
    assert directions_of_rows(path_of(), [(1, np.eye(4)), (2, turned), (3, None)]) is None
    found = directions_of_rows(path_of(), [(1, leaning), (3, None)])
    assert found.shape == (5, 3, 3) and np.allclose(found[[0, 3, 4]], (0, 0, 1)) and np.allclose(found[1:3], (0, -s, c))
    assert np.allclose(directions_of_rows(path_of(), [(2, leaning)], [(3, "Y")])[3:], (0, c, s))


def test_with_a_kinematics_the_axes_turn_it_while_they_move():
    """A to 30 degrees on the second row: from upright to (0, -0.5, cos 30), and so it stays."""
    rotary = np.zeros((5, 3))
    rotary[1:, 0] = np.radians(30)
    kinematics = mnclab.Kinematics(table=(mnclab.Axis("A"),))
    found = directions_of_rows(path_of(rotary, kinematics), [])
    leant = (0, -0.5, np.cos(np.radians(30)))
    assert np.allclose(found[:2, 0], (0, 0, 1)) and np.allclose(found[1:, 2], leant) and np.allclose(found[2:], leant)


@pytest.mark.parametrize(
    "blocks, arrived, known",
    [
        ("G0 Z5\nG0 X1 Y1\nG1 X9 F100", 0, 2),  # the height first, then the place
        ("G0 X1 Y1\nG0 Z5\nG1 X9 F100", 1, 2),
        ("G1 X9 F100\nG0 Z5", 1, 1),  # what moves at feed says where it begins
        ("G0 X1", 1, 1),  # nobody ever says it
    ],
)
def test_from_where_on_a_start_is_known(blocks, arrived, known):
    path = mnclab.run(blocks + "\n", "g43").toolpath.motion
    assert start_known(path, (0.0, 0.0, 0.0)) == (arrived, known)
    assert start_known(path, (0.0, 0.0, 300.0)) == (0, 0)


def test_the_blank_of_the_setup_goes_before_that_of_the_program():
    origin, given = np.array([10.0, 0, 0]), ((0, 0, -5), (20, 20, 0))
    program = [(1, cylinder(5, -9, 0)), (2, cylinder(6, -9, 0))]
    assert stock_of(given, program, origin) == Box((-10, 0, -5), (10, 20, 0))
    assert stock_of(None, program, origin) == cylinder(6, -9, 0)
    assert stock_of(None, [], origin) is None


def test_a_part_that_was_never_tilted_has_no_note_of_it():
    form = "BLK FORM 0.1 Z X+0 Y+0 Z-20\nBLK FORM 0.2 X+60 Y+40 Z+0\n"
    moves = "TOOL CALL 1 Z S1000\nL Z+50 R0 FMAX M3\nM30\n"  # M30 takes back what tilts, without there being anything
    run = mnclab.run(f"BEGIN PGM A MM\n{form}{moves}END PGM A MM\n", "tnc-620", Setup())
    assert run.workpiece().notes == ()


def test_an_axis_that_is_named_where_it_stands_is_known():
    """`G0 X0 Y0 Z0` moves nothing on a machine that starts there, and the helix after it is cut whole, not at its end alone."""
    text = "G54 G17 G90 T1 S1000 M3\nG0 X0 Y0 Z0\nG2 X0 Y0 Z-5 I8 J0 F100\nG0 Z50\n"
    found = mnclab.run(text, "mnc", mnclab.Setup(tools={1: mnclab.Tool(2)}, stock=((-20, -20, -20), (40, 20, 0)))).workpiece()
    assert found.at(8, 8) == pytest.approx(-1.25 - 5 * math.asin(0.125) / math.pi, abs=1e-9)  # until its rim has left
