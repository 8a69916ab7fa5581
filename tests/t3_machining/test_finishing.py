"""Arcs up to a wall and off it touch it and lie on one side of it."""

import numpy as np
import pytest

from mnclab.geometry.contours import Contour, rectangle
from mnclab.machining.milling import pocket_steps


def test_approach_and_departure():
    """Wall at (a, 0), ccw: from (a - ρ, -ρ) about (a - ρ, 0) to (a, 0); off to (a - ρ, ρ)."""
    ways = pocket_steps.quarter_circles(rectangle(70, 50), 2.2, 1)
    for way, places in zip(ways, ([(32.8, -2.2), (35, 0)], [(35, 0), (32.8, 2.2)]), strict=True):
        assert way.points == pytest.approx(np.array(places))
        assert way.centres == pytest.approx(np.array([[32.8, 0]]))
        assert way.length == pytest.approx(np.pi * 1.1)
        assert [tangents[0] for tangents in way.tangents()][way is ways[0]] == pytest.approx([0, 1])


def test_round_a_stud_the_arcs_lie_outside():
    to, off = pocket_steps.quarter_circles(Contour.circle((0, 0), 20, clockwise=True), 3, 1)
    assert to.points[0] == pytest.approx((23, 3))
    assert np.hypot(*np.vstack([to.points_within(0.01), off.points_within(0.01)]).T).min() >= 20 - 0.01


def test_leaving():
    off = pocket_steps.leaving(rectangle(70, 50).reversed(), 2, -1)
    assert off.points == pytest.approx(np.array([(35, 0), (33, -2)]))
