"""A tool along X or Y lies in the pictures as it does on the machine."""

import pytest

import mnclab as mnc
from mnclab.show import solids

PROGRAM = "BEGIN PGM A MM\nTOOL CALL 1 {axis} S1000 F200\nL X+10 Y+20 Z+30 R0 F200 M3\nEND PGM A MM"


@pytest.mark.parametrize("k, axis", list(enumerate("XYZ")))
def test_the_body_stands_above_its_tip_along_the_tool_axis(k, axis):
    run = mnc.run(PROGRAM.format(axis=axis), "tnc-620")
    body, radius = solids.tool_of(run), run.tables.tools[1].radius
    low, high = body.points.min(axis=0) - (10, 20, 30), body.points.max(axis=0) - (10, 20, 30)
    assert low[k] == pytest.approx(0) and high[k] > 2 * radius
    across = [i for i in range(3) if i != k]
    assert low[across] == pytest.approx([-radius] * 2, rel=0.02) and high[across] == pytest.approx([radius] * 2, rel=0.02)
    assert body.volume > 0  # the triangles look outwards
