"""The spatial angles of a tilted system: the inverse of the turns about X, then Y, then Z."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab.geometry.arcs import circle_through, round_through
from mnclab.geometry.frames import angles_of, spatial

TURN = st.floats(-math.pi, math.pi)


@given(a=TURN, b=st.floats(-1.57, 1.57), c=TURN)
def test_angles_that_were_turned_by_come_back(a, b, c):
    back = np.array(angles_of(spatial(a, b, c))) - (a, b, c)
    assert np.remainder(back + 1, math.tau) == pytest.approx(1, abs=1e-10)


@given(a=TURN, b=st.sampled_from([math.pi / 2, -math.pi / 2]), c=TURN)
def test_a_quarter_turn_about_y_leaves_a_free(a, b, c):
    """X and Z are one axis then: A is 0, and the same system comes of it."""
    found = angles_of(spatial(a, b, c))
    assert found[0] == 0 and found[1] == pytest.approx(b)
    assert spatial(*found) == pytest.approx(spatial(a, b, c), abs=1e-9)


def test_the_circle_of_least_powers_of_four_points_and_of_three():
    """(±3, 0), (0, ±4): by symmetry the middle, and radius² their mean, 12.5; three points of (x-1)² + (y+2)² = 25."""
    assert circle_through(np.array([[3, 0], [-3, 0], [0, 4], [0, -4.0]])) == pytest.approx((0, 0, math.sqrt(12.5)), abs=1e-12)
    assert circle_through(np.array([[6, -2], [1, 3], [-3, -5.0]])) == pytest.approx((1, -2, 5))


def test_the_ball_through_four_points():
    """(x-1)² + (y-2)² + (z-3)² = 49, at 2 3 6."""
    centre, radius = round_through(np.array([[8, 2, 3], [1, 9, 3], [1, 2, -4], [3, 5, 9.0]]))
    assert centre == pytest.approx([1, 2, 3]) and radius == pytest.approx(7)
    with pytest.raises(ValueError, match="points on a line"):
        round_through(np.array([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0.0]]))
