"""Presets with tools along X and Y: the part and the letters changed round, all else is as along Z (TNC 620, 15.1)."""

import re

import numpy as np
import pytest
from controls.tnc_620.presetting import CASES, PRESET, example, part_of, probing

import mnclab as mnc

ROUND = {"X": {"X": "Y", "Y": "Z", "Z": "X"}, "Y": {"X": "Z", "Y": "X", "Z": "Y"}}  # by tool axis
NAMED = [case for case in CASES if not case["code"].startswith("example")]


@pytest.mark.parametrize("axis", ["X", "Y"])
@pytest.mark.parametrize("case", NAMED, ids=lambda case: f"{case['code']} {case['title'][:12]}")
def test_an_example_along_another_axis(case, axis):
    letters = ROUND[axis]
    order = ["XYZ".index(letters[letter]) for letter in "XYZ"]
    turn = np.zeros((4, 4))
    turn[[*order, 3], range(4)] = 1
    text = example(case) + "\n9 L X+0 Y+0 R0 FMAX\n"
    flat = probing(text, part_of(case))
    other = re.sub(r"[XY](?=\+0)", lambda found: letters[found.group()], text)
    preset = (turn[:3, :3] @ PRESET).tolist()
    run = mnc.run(f"TOOL CALL 69 {axis}\nL {axis}+100 R0 FMAX\n{other}", "tnc-620", mnc.Setup(
        tools={69: mnc.Tool(radius=2, kind="probe")}, presets={1: preset}, settings={"preset": 1},
        part=part_of(case).shifted(*PRESET).placed(turn), probe=mnc.Probe(clearance=2, reach=10),
    ))  # fmt: skip
    assert flat.ok and run.ok, run.alarms
    assert run.toolpath.end[:, order] == pytest.approx(flat.toolpath.end, abs=1e-9)
    for number, row in flat.tables.presets.items():
        assert np.array(run.tables.presets[number][:3])[order] == pytest.approx(np.array(row[:3]), abs=1e-9)
    found = {letters.get(what, what): value for what, value in flat.measured.items()}
    assert run.measured == pytest.approx(found, abs=1e-9)


def test_a_basic_rotation_along_another_axis_is_refused():
    case = next(case for case in CASES if case["code"] == "TCH PROBE 414")
    run = mnc.run("TOOL CALL 6 Y\n" + example(case, Q304=1), "tnc-620")
    alarm = run.alarms[0]
    assert alarm.message.startswith("TCH PROBE 414 Q304 (") and "another tool axis than Z: not built yet" in alarm.message
    assert run.program.text.splitlines()[alarm.span.line - 1].startswith("Q304")
