"""Datums, the reference point, radius compensation, and the bulk tier of the G43 control."""

from functools import partial

import numpy as np
import pytest
from tools import running

import mnclab
from mnclab import Tool
from mnclab.controls.g43.refused import REFUSED

run = partial(running.run, control="g43")


def test_work_offsets_and_machine_coordinates():
    found = run("X1 Y2 Z3\nG55 X1 Y2 Z3\nG53 X0 Y0 Z0\nX1 Y2 Z3\n", datums={1: (10, 20, 30), 2: (100, 200, 300)})
    machine = (found.toolpath.end + found.toolpath.origin).tolist()
    assert machine == [[11, 22, 33], [101, 202, 303], [0, 0, 0], [101, 202, 303]]


def test_g53_is_the_spindle_reference():
    found = run("T1 M6\nG43 Z100\nG53 Z0\n", tools={1: Tool(length=80)}, start=(0, 0, 500))
    assert found.toolpath.end[-1, 2] == -80


def test_local_shift_and_set_position():
    assert run("G52 X10 Y20\nX1 Y1\n").toolpath.end.tolist() == [[11, 21, 0]]
    assert run("X5\nG92 X0\nX1\n").toolpath.end[:, 0].tolist() == [5, 6]


def test_reference_point():
    found = run("X5 Y6 Z7\nG28 Z50\nG28\n", datums={1: (1, 2, 3)})
    machine = (found.toolpath.end + found.toolpath.origin).tolist()
    assert machine == [[6, 8, 10], [6, 8, 53], [6, 8, 0], [0, 0, 0]]


def test_the_radius_comes_from_the_corrector():
    square = "T1 M6\nD{0}\nG0 X-30 Y0 F300\nG1 G41 X0\nY40\nX40\nG40 X60\n"
    tools = {1: Tool(radius=5), 2: Tool(radius=3)}
    for number, radius in ((1, 5), (2, 3)):
        path = run(square.format(number), tools=tools).toolpath
        assert (-radius, 40.0) in {(round(x, 9), round(y, 9)) for x, y, _ in path.end.tolist()}


def test_many_plain_blocks_are_the_same_in_bulk():
    text = "T1 M6\nG43 D7\n" + "".join(f"G{1 + k % 2} X{k % 9} Y{k % 7} Z{k % 5} R20 F100\n" for k in range(300))
    text = text.replace("G1 X0", "G1 X0")  # lines carry no R
    text = "".join(line.replace(" R20", "") if line.startswith("G1") else line for line in text.splitlines(True))
    paths = [run(text, correctors={7: (1, 2, 85)}, settings={"bulk": bulk}).toolpath for bulk in (True, False)]
    assert len(paths[0]) == len(paths[1])
    assert np.array_equal(paths[0].end, paths[1].end) and np.array_equal(paths[0].kind, paths[1].kind)


def test_the_control_is_known_by_its_words():
    assert mnclab.read("T2 M6\nG43 D2 Z5\n").control == "g43"
    with pytest.raises(mnclab.Alarm):
        mnclab.read("hello\n")


@pytest.mark.parametrize("code", [code for code, text in REFUSED.items() if text.startswith("not built")])
def test_what_is_not_built_says_what_is_written_instead(code):
    assert any(verb in REFUSED[code] for verb in ("write ", "the tnc-620 has", "locked", "whose length is")), REFUSED[code]
