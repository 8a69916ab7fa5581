"""Cylinders in pictures: the developed surface with its band of the tool, and the body that the path lies on."""

from __future__ import annotations

import math

import numpy as np
import pytest

import mnclab as mnc
from mnclab.path.cylinder import divided
from mnclab.show import solids

SLOT = """0 BEGIN PGM A MM
TOOL CALL 1 Z S2000
L X+0 Y+0 Z+100 R0 FMAX M3
CYCL DEF 14.0 CONTOUR
CYCL DEF 14.1 CONTOUR LABEL 1
CYCL DEF 28 SLOT
 Q1=-5
 Q3=+0
 Q6=20
 Q10=+5
 Q11=100
 Q12=200
 Q16=+25
 Q17=0
 Q20=+14
CYCL CALL
M2
LBL 1
L X+90 Y+0 RL
L Y+40
LBL 0
END PGM A MM
"""


@pytest.fixture(scope="module")
def run() -> mnc.Run:
    found = mnc.run(SLOT, "tnc-620")
    assert found.ok, found.alarms
    return found


def test_the_band_is_as_wide_as_the_slot(run):
    """Q20 = 14 about u = 25 pi / 2 = 39.270; the scale above counts degrees."""
    picture = run.plot(view="unrolled")
    axes = picture.axes[0]
    band = axes.patches[0].get_path().get_extents()
    assert (band.x0, band.x1) == (pytest.approx(25 * math.pi / 2 - 7, abs=1e-3), pytest.approx(25 * math.pi / 2 + 7, abs=1e-3))
    assert band.y1 == pytest.approx(45, abs=1e-3)  # the tool of radius 5 at Y40
    picture.draw_without_rendering()
    above = axes.child_axes[0]
    assert above.get_xlabel() == "A, degrees"
    low, high = axes.get_xlim()
    assert above.get_xlim() == (pytest.approx(math.degrees(low / 25)), pytest.approx(math.degrees(high / 25)))


def test_degrees_are_round_numbers(run):
    """About 34 mm of a radius of 25 are 78°: 15, 30, 45 … and not 9, 18, 27; no line of the legend is too short to be seen."""
    picture = run.plot(view="unrolled", size=(5.0, 5.0))
    picture.draw_without_rendering()
    ticks = picture.axes[0].child_axes[0].get_xticks()
    assert set(np.round(np.diff(ticks) / 15, 9)) <= {1, 2}
    drawn = [line for line in picture.axes[0].lines if line.get_linestyle() == "--"]
    assert all(np.ptp(line.get_xdata()) + np.ptp(line.get_ydata()) > 1e-6 for line in drawn)


def test_a_path_on_a_cylinder_is_unrolled_unasked(run):
    """In the coordinates of the machine it would be a line; another view, or a colour, is what was asked for."""
    assert run.plot().axes[0].get_xlabel() == "u along the circumference, mm"
    for other in (run.plot(view="XY"), run.plot(colour="feed")):
        assert {axes.get_xlabel() for axes in other.axes} - {"", "Y, mm"} == {"X, mm"}


def test_without_a_cylinder():
    with pytest.raises(mnc.Alarm, match="no row does"):
        mnc.run("0 BEGIN PGM A MM\nL X+1 R0 FMAX\n", "tnc-620").plot(view="unrolled")


def test_the_body_is_that_of_the_cylinder(run):
    """Radius 25 about X, from half a radius before the cuts at -1 to half a radius behind them at 40: its volume."""
    body = solids.cylinder_body(run.toolpath)
    assert np.hypot(body.points[:-2, 1], body.points[:-2, 2]) == pytest.approx(25)
    low, high = body.points[:, 0].min(), body.points[:, 0].max()
    assert high == pytest.approx(52.5) and body.volume == pytest.approx(math.pi * 625 * (high - low), rel=1e-2)


def test_rapids_that_turn_are_parted(run):
    """Over the start the axis turns by 90 degrees; in parts of 0.1 rad that are 16, which meet end to end."""
    whole, parted = run.toolpath, divided(run.toolpath, 0.1)
    assert len(parted) - len(whole) == 15
    wrapped = parted.on_workpiece()
    assert np.abs(wrapped.start[1:] - wrapped.end[:-1]).max() < 1e-9
    over = wrapped.labelled("over the start")
    assert np.hypot(over.end[:, 1], over.end[:, 2]) == pytest.approx(100)
