"""Exports of machines whose rotary axes swing the tip: plain blocks are positions of the axes, and lead to the same tips."""

import json
import re
import sys
from pathlib import Path

import numpy as np
import pytest

import mnclab as mnc
from mnclab.show.export_gcode import lines

AUTHORITIES = Path(__file__).parent.parent / "authorities"
RECORDED = json.loads((AUTHORITIES / "exported_axes.json").read_text("utf-8"))
sys.path.insert(0, str(AUTHORITIES))
from read_back import blocks_of  # noqa: E402

sys.path.pop(0)

LENGTH = 90


def made(text, machine="table-ac", **more):
    setup = mnc.Setup(tools={2: mnc.Tool(radius=4, length=LENGTH)}, kinematics=machine, **more)
    run = mnc.run(f"BEGIN PGM T MM\nTOOL CALL 2 Z S3000\n{text}\nEND PGM T MM\n", "tnc-620", setup)
    assert run.ok, run.alarms
    return run


def positions(run):
    """X Y Z A B C (n, 6) after every block of motion of an export."""
    at, found = dict.fromkeys("XYZABC", 0.0), []
    for block in blocks_of(run):
        if words := re.findall(r"([XYZABC])(-?[\d.]+)", block):
            at |= {name: float(number) for name, number in words}
            found.append([*at.values()])
    return np.array(found)


def test_linuxcnc_goes_where_the_program_says_the_axes_stand():
    """By hand: X from 20 to 0 while A goes to 30 and C to 60, down to Z5, half a circle about X10 to X20, and A back."""
    run = made(RECORDED["program"].split("\n", 2)[2].rsplit("\n", 2)[0])
    assert blocks_of(run)[1:] == RECORDED["blocks"][1:], "record again: tests/authorities/generate_exported_axes.py"
    said = RECORDED["said"]
    straight = [numbers for name, *numbers in said if name.startswith("STRAIGHT")]
    ends = [(20, 0, 50, 0, 0, 0), (0, 0, 50, 30, 0, 60), (0, 0, 5, 30, 0, 60), (20, 0, 5, 0, 0, 60)]
    assert all(any(np.allclose(end, each, atol=1e-4) for each in straight) for end in ends)
    swing = np.array(straight[1 : 1 + next(k for k, each in enumerate(straight[1:]) if each[2] == 5)])
    assert np.allclose(20 - 20 / 30 * swing[:, 3], swing[:, 0], atol=1e-4)
    assert np.allclose(2 * swing[:, 3], swing[:, 5], atol=1e-4)
    (arc,) = (numbers for name, *numbers in said if name == "ARC_FEED")
    assert arc[:6] == [20, 0, 10, 0, -1, 5] and arc[6:9] == [30, 0, 60]
    assert [numbers for name, *numbers in said if name == "SET_FEED_RATE"][-4:-1] == [[500], [300], [900]]


@pytest.mark.parametrize("machine", ["table-ac", "head-bc", "head-b-table-c"])
def test_forward_leads_the_blocks_to_the_tips_of_the_run(machine):
    tilt = "A" if machine == "table-ac" else "B"
    text = f"L X+20 Y-10 Z+30 R0 FMAX M3\nL {tilt}+25 C+40 F600\nL X-5 Z+12 F300\nL Y+15 {tilt}+10 F800\nL X+0 C+0 {tilt}+0 FMAX"
    run = made(text, machine)
    found, motion = positions(run), run.toolpath.motion
    chain = run.setup.kinematics
    found[:, 2] += LENGTH
    tips, _ = chain.forward(found, LENGTH)
    arm = 350  # mm from an axis to the tip, at most, that half of a written millionth of a degree turns
    assert len(tips) == len(motion) and np.abs(tips - motion.end).max() < 1e-6 + arm * np.radians(0.5e-6)


def test_a_head_that_turns_alone_writes_no_linear_word():
    blocks = blocks_of(made("L X+20 Y+0 Z+50 R0 FMAX M3\nL B+90 F720\nL Z+40 F100", "head-bc"))
    turning = [block for block in blocks if " B" in block or block.startswith("B")]
    assert turning[0].startswith("G1 B") and turning[0].endswith("F720") and turning[-1] == "B90"
    assert not any(letter in block for block in turning for letter in "XYZ")
    assert blocks[-4] == "Z40 F100"


def test_an_arc_in_a_tilted_pose_stays_an_arc_of_the_axes():
    """Half a circle about X10 with A at 30: what the axes do lies in their XY plane, whatever the part thinks of it."""
    run = made("L X+0 Y+0 Z+50 R0 FMAX M3\nL A+30 FMAX\nCC X+10 Y+0\nC X+20 Y+0 DR+ F300")
    assert blocks_of(run)[-4] == "G3 X20 I10 J0 F300"
    assert "A from -120 to 120 degrees" in "\n".join(lines(run))


def test_where_nothing_turns_the_file_is_that_of_three_axes():
    text = "L X+20 Y+0 Z+50 R0 FMAX M3\nL X+0 F500"
    assert lines(made(text)) == lines(made(text, None))


def test_axes_that_are_not_at_zero_at_home_are_brought_there_first():
    chain = mnc.Kinematics(table=(mnc.Axis("C", home=90),))
    blocks = blocks_of(made("L X+10 Y+0 Z+50 R0 FMAX M3\nL C+180 F500", chain))
    assert blocks[2] == "G0 C90" and not any("C90" in block for block in blocks[3:])


@pytest.mark.parametrize(("machine", "turn"), [("table-ac", "A20"), ("table-ac", "C60"), ("head-bc", "B20"), ("head-bc", "C60")])
def test_the_export_is_proven_the_same_motion(machine, turn):
    """A tip that is led leaves its rows by up to 0.01 mm between them, as in the file, whose axes are the same."""
    run = made(f"L X-30 Y+0 Z-5 R0 FMAX M3\nM128\nL X+30 {turn} F300\nM129\nL Z+50 FMAX", machine)
    text = "\n".join(lines(run))
    found = mnc.prove(run, mnc.run(text, setup=run.setup))
    assert found.verdict == "same motion" and not found.differences, found
    if (machine, turn) == ("head-bc", "C60"):
        return  # which turns the tool about itself alone
    axis, angle = turn[0], int(turn[1:])
    other = mnc.prove(run, mnc.run(re.sub(rf"{axis}{angle}\b", f"{axis}{angle - 0.01}", text), setup=run.setup))
    assert other.verdict != "same motion" and other.first.amount > 0.001
