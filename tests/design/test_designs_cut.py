"""The sample designs of lathes are what their programs cut: the sections lie within a nanometre of each other."""

import math
from pathlib import Path

import numpy as np
import pytest

import mnclab as mnc
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.machine import setup_file

DATA = Path(__file__).resolve().parents[2] / "data"
SAMPLES = [("jnc-t01", "flange", ".jnc"), ("nc-31", "shaft", ".nc31"), ("nc-31", "square", ".nc31")]
BAND = 1e-6  # mm


def apart(one, other):
    """The farthest that points of one section lie from the other, mm."""
    here, there = Region(tuple(one)), Region(tuple(other))
    spots = [np.vstack([loop.points, loop.point_at(np.linspace(0, loop.length, 2000))[0]]) for loop in here.loops]
    return float(there.distance(np.vstack(spots)).max())


def cut(control, name, suffix):
    setup = setup_file.load(DATA / "setups" / control / f"{name}.toml")
    return mnc.run(DATA / "programs" / control / f"{name}{suffix}", control, setup).workpiece()


@pytest.mark.parametrize(("control", "name", "suffix"), SAMPLES)
def test_a_program_makes_its_design(control, name, suffix):
    design = mnc.TurnedDesign.load(DATA / "designs" / control / f"{name}.toml")
    part = cut(control, name, suffix)
    section = part.section
    for thread in design.threads:  # the teeth, between core and nominal diameter, are filled up
        low, high = thread.band
        teeth = Contour([(thread.end, low), (thread.start, low), (thread.start, high), (thread.end, high)])
        section = Region(tuple(section)).union(Region((teeth,))).loops
    assert apart(section, design.section) < BAND and apart(design.section, section) < BAND
    if not design.threads:
        assert part.volume == pytest.approx(design.volume, rel=1e-8)
        assert part.removed == pytest.approx(design.workpiece().removed, rel=1e-7)


def test_the_teeth_of_a_thread_lie_in_its_band():
    """The insert goes 0.92 deep, 0.613 of the pitch: down to 22.16, not below the core of 24 - 1.2269·1.5 = 22.16."""
    design = mnc.TurnedDesign.load(DATA / "designs" / "nc-31" / "shaft.toml")
    part, (thread,) = cut("nc-31", "shaft", ".nc31"), design.threads
    radii = part.at(np.linspace(thread.end + 0.01, thread.start - 0.01, 5000))
    assert thread.band[0] - 2e-4 <= radii.min() and radii.max() == thread.band[1]
    assert thread.minor == pytest.approx(24 - 17 / 12 * math.sqrt(3) / 2 * 1.5)
    gone = design.volume - part.volume
    assert 0 < gone < math.pi * (144 - thread.band[0] ** 2) * 24


def test_a_design_is_a_blank_of_its_own_program():
    """The finished part in the chuck: the program that made it cuts nothing of it any more."""
    design = mnc.TurnedDesign.load(DATA / "designs" / "nc-31" / "square.toml")
    again = mnc.run(DATA / "programs" / "nc-31" / "square.nc31", "nc-31", mnc.Setup(stock=design)).workpiece()
    assert again.volume == pytest.approx(design.volume, rel=1e-9) and again.removed == pytest.approx(0, abs=1e-3)
