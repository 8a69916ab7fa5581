"""Constant cutting speed: the formula, the mean time of a turn, and the profile of a row that it governs."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab import Kind, Limits
from mnclab.path.feeds import mean_turn, spindle_speed
from mnclab.path.profile import Profile
from mnclab.path.toolpath import Toolpath

RADIUS = st.floats(-200, 200)


def test_the_speed_follows_the_radius_up_to_its_limit():
    """1000 v / (2 π r): 30 m/min at radius 20 are 238.7324 rev/min, at 10 twice as many, on the axis the limit."""
    found = spindle_speed(30, [20, 10, -10, 0], 3000)
    assert found == pytest.approx([238.7324, 477.4648, 477.4648, 3000], abs=1e-4)
    assert spindle_speed(0, [20, 0], 3000).tolist() == [0, 0]


@given(st.floats(1, 500), RADIUS, RADIUS, st.floats(10, 10_000))
def test_the_mean_time_of_a_turn(surface, a, b, limit):
    """Against the mean of 1 / n at many places of the way."""
    places = a + (np.arange(20_000) + 0.5) / 20_000 * (b - a)
    expected = np.mean(np.maximum(2 * math.pi * np.abs(places) / (1000 * surface), 1 / limit))
    assert mean_turn(surface, np.array([a, b]), limit) == pytest.approx(expected, rel=1e-6)


def test_a_cut_to_the_axis_runs_at_the_limit_near_it():
    """From radius 50 to the axis at 200 m/min, 0.2 mm/rev, at most 2000 rev/min, which are reached at radius r.

    Above r a turn takes 2 π x / 200 000 min, below it 1 / 2000 min; 1 / 0.2 turns for each millimetre. The axis lies at
    X = 3.
    """
    r = 200_000 / (2 * math.pi * 2000)
    minutes = (math.pi * (50**2 - r**2) / 200_000 + r / 2000) / 0.2
    columns = {"kind": [Kind.LINE], "feed": [1.0], "per_rev": [0.2], "surface": [200.0], "speed_limit": [2000.0]}
    columns |= {"spindle": [2000.0], "spindle_x": [3.0]}
    vertices = np.array([(53.0, 0, 0), (3, 0, 0)])
    path = Toolpath.chain(vertices, {name: np.array(value) for name, value in columns.items()})
    assert Profile(path, Limits(acceleration=1e9)).time == pytest.approx(60 * minutes, rel=2e-4)
    assert mean_turn(200, np.array([50.0, 0]), 2000) * 50 / 0.2 == pytest.approx(minutes, rel=1e-12)
