"""Closed contours out of a path that a program made."""

import numpy as np
import pytest

import mnclab as mnc
from mnclab.geometry.drawings import area_of
from mnclab.path.plane import outlines

PROGRAM = """N10 G17 G90 G54
N20 T2 F500
N30 G0 X0 Y0 Z5
N40 G1 Z-1
N50 X60
N60 Y40
N70 X0
N80 Y0
N90 G0 Z5
N100 X40 Y20
N110 G1 Z-1
N120 G3 X40 Y20 I-10 J0
N130 G0 Z5
N140 G1 X90 Y90
"""


def test_a_program_draws_a_pocket_with_an_island():
    """60 × 40 with a full circle r = 10; the last cut does not close and is no contour."""
    run = mnc.run(PROGRAM, "mnc", mnc.Setup(tools={2: mnc.Tool(number=2, radius=3)}))
    found = outlines(run.toolpath)
    assert [contour.area for contour in found] == pytest.approx([2400, 100 * np.pi])
    assert area_of(found).area == pytest.approx(2400 - 100 * np.pi)
