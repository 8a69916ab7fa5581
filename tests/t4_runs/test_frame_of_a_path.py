"""A path counts from the first work offset that its program selects before it moves, else from the one of the start."""

import numpy as np
import pytest

import mnclab
from mnclab import Setup, Tool

TOOLS = {1: Tool(radius=4)}
TABLE = {1: (10, 10, -50), 2: (100, 50, -50)}
CUT = "G0 X-10 Y20 Z5 S900 M3\nZ-3\nG1 X70 F200\nG0 Z5\nM30\n"
KLARTEXT = """BEGIN PGM A MM
BLK FORM 0.1 Z X+0 Y+0 Z-20
BLK FORM 0.2 X+60 Y+40 Z+0
{}
TOOL CALL 1 Z S900
L X-10 Y+20 Z+5 R0 FMAX M3
L Z-3 FMAX
L X+70 F200
L Z+5 FMAX M30
END PGM A MM
"""


@pytest.mark.parametrize("control", ["mnc", "g43"])
@pytest.mark.parametrize(("head", "row"), [
    ("G90 G54\n", 1), ("G90 G55\n", 2), ("G90 T1 M6\nG55\n", 2), ("G90 G54\nG0 X0 Y0 Z50\nG55\n", 1),
    ("G90 G55\nG0 X0 Y0 Z50\nG54\n", 2),
])  # fmt: skip
def test_the_first_offset_of_the_program(control, head, row):
    if control == "mnc":
        head = head.replace(" M6", "")
    run = mnclab.run(head + CUT, control, setup=Setup(tools=TOOLS, datums=TABLE))
    assert run.ok, run.alarms
    assert tuple(run.toolpath.origin) == TABLE[row]
    last = TABLE[2 if head.rpartition("G55")[2] == "\n" else 1]  # the one in which is cut
    assert np.add(run.toolpath.end[-1], run.toolpath.origin) == pytest.approx(np.add(last, (70, 20, 5)), abs=1e-9)


@pytest.mark.parametrize("head", ["", "G0 X1 Y1\nG55\n"])
def test_where_none_is_selected_before_it_moves_the_one_of_the_start_counts(head):
    run = mnclab.run("G90 T1 M6\n" + head + CUT, "g43", setup=Setup(tools=TOOLS, datums=TABLE))
    assert tuple(run.toolpath.origin) == TABLE[1]


@pytest.mark.parametrize("row", [0, 1, 2])
def test_a_part_is_the_same_in_whatever_preset_it_is_cut(row):
    said = f"CYCL DEF 247 DATUM SETTING Q339=+{row}"
    run = mnclab.run(KLARTEXT.format(said), "tnc-620", setup=Setup(tools=TOOLS, presets=TABLE))
    assert run.ok, run.alarms
    assert tuple(run.toolpath.origin) == TABLE.get(row, (0, 0, 0))
    assert run.stock.bounds.tolist() == [[0, 0, -20], [60, 40, 0]]
    assert run.workpiece().volume == pytest.approx(60 * 40 * 20 - 60 * 8 * 3, rel=1e-5)
