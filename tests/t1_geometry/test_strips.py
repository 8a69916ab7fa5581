"""Strips about lines: closed forms, and shapely where lines bend tightly or cross themselves."""

import math

import numpy as np
import pytest
import shapely

from mnclab.geometry.contours import Contour
from mnclab.geometry.sweeps import strip


def test_about_a_straight_line():
    """A rectangle of 40 by 12 and two half circles of 6; arcs stay arcs."""
    found = strip(Contour([(0, 0), (40, 0)], closed=False), 6)
    assert found.area == pytest.approx(40 * 12 + 36 * math.pi, abs=1e-9)
    assert sorted(found.loops[0].radii) == pytest.approx([6, 6, math.inf, math.inf])


def test_about_a_circle():
    """A ring from 14 to 26."""
    found = strip(Contour.circle((3, -2), 20), 6)
    assert found.area == pytest.approx(math.pi * (26**2 - 14**2), abs=1e-9)
    assert len(found.loops) == 2


def test_about_a_circle_smaller_than_the_reach():
    assert strip(Contour.circle((3, -2), 5), 6).area == pytest.approx(math.pi * 11**2, abs=1e-9)


def test_about_a_corner():
    """Two rectangles of 20 by 4, a quarter circle outside the corner, less the square that both have, and round ends."""
    found = strip(Contour([(0, 0), (20, 0), (20, 20)], closed=False), 2)
    assert found.area == pytest.approx(2 * 80 + math.pi + 4 * math.pi - 4, abs=1e-9)


def test_no_reach():
    with pytest.raises(ValueError, match="reaches more than 0 to either side of its line, got 0"):
        strip(Contour([(0, 0), (1, 0)], closed=False), 0)


@pytest.mark.parametrize("seed", range(30))
def test_lines_that_cross_themselves(seed):
    """What chords sweep one by one, which is less by the sagitta of a chord at most."""
    rng = np.random.default_rng(seed)
    count, closed = int(rng.integers(3, 7)), bool(rng.random() < 0.4)
    bulge = np.where(rng.random(count) < 0.5, rng.uniform(-1, 1, count), 0.0)
    line, reach = Contour(np.cumsum(rng.uniform(-30, 30, (count, 2)), axis=0), bulge, closed), rng.uniform(0.5, 12)
    spots = line.points_within(1e-3)
    chords = shapely.linestrings(np.stack([spots[:-1], spots[1:]], axis=1))
    area = shapely.union_all(shapely.buffer(chords, reach, quad_segs=64)).area
    found = strip(line, reach)
    assert -1e-3 * line.length - 1e-4 * area < area - found.area < 1e-3 * line.length
