"""Drilling cycles that begin below level R, on the two controls that have them: what LinuxCNC 2.9 makes of it.

Its motion for `G0 Z-5 / G98 G83 X10 Y5 Z-20 R2 Q8 / X20 / G80`: up to Z2, over the hole at Z2, the pecks from Z2 and back to
it; it stays there, as Z-5 is no level to return to.
"""

import numpy as np
import pytest

import mnclab
from mnclab import Kind, Setup

CYCLES = {
    "mnc": ["G83 X10 Y5 Z-20 R2 K8", "G83 X10 Y5 W22 R2", "G84 X10 Y5 Z-20 R2 F100", "G85 X10 Y5 Z-20 R2"],
    "g43": [
        f"{code} X10 Y5 Z-20 R2"
        for code in ("G81", "G82", "G83 Q8", "G73 Q8", "G84", "G74", "G85", "G89", "G86", "G76 Q.2")
    ],
}
CASES = [(control, cycle) for control, cycles in CYCLES.items() for cycle in cycles]


def motion(control, cycle, level, back, more="X20\nX30 Y9\n"):
    text = f"G17 G90 G54 F120 S800 M3\nG0 X0 Y0 Z{level}\n{back} {cycle}\n{more}G80\n"
    run = mnclab.run(text, control, Setup(start=(0, 0, 50)))
    assert run.ok, run.alarms
    return run.toolpath.motion[run.toolpath.motion.line > 2]


@pytest.mark.parametrize("level", [-25, -5, 0, 1.999])
@pytest.mark.parametrize("back", ["G98", "G99"])
@pytest.mark.parametrize(("control", "cycle"), CASES)
def test_no_rapid_goes_across_or_ends_below_r(control, cycle, back, level):
    rows = motion(control, cycle, level, back)
    across = (np.abs(rows.end - rows.start)[:, :2] > 0.5).any(axis=1)
    assert across.sum() == 3 and (rows.start[across, 2] == 2).all() and (rows.end[across, 2] == 2).all()
    assert rows.end[-1].tolist() == [30, 9, 2] and rows[0].end.tolist() == [0, 0, 2]
    assert rows.end[rows.kind != Kind.RAPID, 2].min() == -20


@pytest.mark.parametrize(("control", "cycle"), CASES)
@pytest.mark.parametrize(("level", "back", "end"), [(2, "G98", 2), (2, "G99", 2), (9, "G98", 9), (9, "G99", 2)])
def test_from_level_r_or_above_nothing_is_new(control, cycle, level, back, end):
    rows = motion(control, cycle, level, back)
    assert rows[0].end.tolist() == [10, 5, level] and rows.end[-1].tolist() == [30, 9, end]


def test_the_motion_of_linuxcnc():
    rows = motion("g43", "G83 X10 Y5 Z-20 R2 Q8", -5, "G98", more="")
    clear = 0.254  # mm, 0.01 inch
    setup = Setup(settings={"peck_clearance": clear})
    run = mnclab.run("F120\nG0 Z-5\nG98 G83 X10 Y5 Z-20 R2 Q8\n", "g43", setup)
    heights = [2, 2, -6, 2, -6 + clear, -14, 2, -14 + clear, -20, 2]
    assert run.toolpath.motion[run.toolpath.motion.line == 3].end[:, 2] == pytest.approx(heights)
    assert len(rows) == len(heights)
