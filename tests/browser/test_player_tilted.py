"""The player cuts with tools that stand tilted: its map of heights against the part in Python, which is exact."""

import numpy as np
import pytest

import mnclab as mnc

BLOCK = ((-30, -30, -20), (30, 30, 0))
ALL = """n => {
    const {carving} = window.player.part, {grid} = carving, found = [];
    carving.aim(n, 0);
    carving.work(Infinity);
    for (let j = 0; j < grid.ny; j++) for (let i = 0; i < grid.nx; i++) found.push(carving.map.height(i, j));
    return [grid.nx, grid.ny, grid.step, ...grid.low, found];
}"""
TOOLS = {
    1: mnc.Tool(radius=4, length=90, cutting_length=40, kind="mill"),
    2: mnc.Tool(radius=4, corner=4, length=90, cutting_length=40, kind="mill"),
    3: mnc.Tool(radius=4, corner=1, length=90, cutting_length=40, kind="mill"),
    4: mnc.Tool(radius=4, angle=118, length=90, cutting_length=40, kind="drill"),
}
GROOVE = "L X+5 Y-40 Z+5 FMAX\nL Z-4 F200\nL Y+40 F500\nL Z+50 FMAX"
SLOPE = "L X-20 Y-40 Z-2 FMAX\nL X+20 Y+40 Z-6 F500\nL Z+50 FMAX"
CIRCLE = "L X+12 Y+0 Z+5 FMAX\nL Z-3 F200\nCC X+0 Y+0\nCP IPA+360 DR+ F500\nL Z+50 FMAX"
HOLE = "L X+0 Y+0 Z+5 FMAX\nL Z-9 F200\nL Z+50 FMAX"
CASES = {
    "a groove": (1, "SPA+0 SPB+25 SPC+0", GROOVE), "a groove of a ball": (2, "SPA+0 SPB+25 SPC+0", GROOVE),
    "a falling way": (1, "SPA-20 SPB+10 SPC+30", SLOPE), "a falling way of a bull nose": (3, "SPA-20 SPB+10 SPC+30", SLOPE),
    "a circle": (1, "SPA+15 SPB+0 SPC+0", CIRCLE), "a hole": (4, "SPA+35 SPB+0 SPC+0", HOLE),
    "a rabbet, the tool level": (1, "SPA+90 SPB+0 SPC+0", "L X-50 Y+0 Z+60 FMAX\nL Z+22 FMAX\nL X+50 F500\nL Z+60 FMAX"),
    "a tunnel below the top": (4, "SPA+90 SPB+0 SPC+0", "L X+0 Y-10 Z+60 FMAX\nL Z+10 F500\nL Z+60 FMAX"),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_columns_fall_as_far_as_the_part_says(opened, name):
    tool, plane, blocks = CASES[name]
    text = f"TOOL CALL {tool} Z S3000\nL X+0 Y+0 Z+100 R0 FMAX M3\nPLANE SPATIAL {plane} TURN MB100 FMAX\n{blocks}"
    setup = mnc.Setup(tools=TOOLS, kinematics="table-ac", stock=BLOCK)
    run = mnc.run(f"BEGIN PGM T MM\n{text}\nL Z+100 FMAX\nPLANE RESET STAY\nEND PGM T MM\n", "tnc-620", setup)
    assert run.ok, run.alarms
    part = run.workpiece()
    nx, ny, step, x0, y0, heights = opened(run).evaluate(ALL, len(run.toolpath))
    x, y = (each.ravel() for each in np.meshgrid(x0 + step * (np.arange(nx) + 0.5), y0 + step * (np.arange(ny) + 0.5)))
    expected = np.maximum(part.at(x, y), -20)
    off = np.abs(np.array(heights) - expected)
    inner = off < (0.02 if "CC" in blocks else 1e-3)  # chords of an arc lie 2 µm off it, which a leaning wall makes more
    assert (np.array(heights) < -1e-3).any() == (name != "a tunnel below the top")
    assert inner.mean() > 0.995, off.max()  # cells that a wall goes through may be on either side of it
