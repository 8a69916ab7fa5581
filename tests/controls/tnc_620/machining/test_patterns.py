"""Patterns of points: counts, spacings and borders by their definitions, for any numbers."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab.controls.tnc_620.cycles import patterns

PLACE = st.tuples(st.floats(-100, 100), st.floats(-100, 100))
SPACING = st.floats(0.5, 20).flatmap(lambda d: st.sampled_from([d, -d]))
ANGLE = st.floats(-7, 7)
COUNT = st.integers(1, 9)


@given(PLACE, SPACING, COUNT, ANGLE)
def test_a_row_is_straight_and_even(start, spacing, count, rotation):
    points = patterns.row(start, spacing, count, rotation)
    step = spacing * np.array([math.cos(rotation), math.sin(rotation)])
    assert points.shape == (count, 2) and points[0].tolist() == list(start)
    assert np.diff(points, axis=0) == pytest.approx(np.tile(step, (count - 1, 1)), abs=1e-9)


@given(PLACE, st.tuples(SPACING, SPACING), st.tuples(COUNT, COUNT), ANGLE, ANGLE, ANGLE)
def test_a_grid_goes_to_and_fro(start, spacing, count, rotation, first, second):
    """Every neighbour is one spacing away, along the first axis in a row, along the second between two rows."""
    points = patterns.grid(start, spacing, count, rotation, (first, second))
    assert len(points) == count[0] * count[1]
    steps = np.diff(points, axis=0)
    u = spacing[0] * np.array([math.cos(rotation + first), math.sin(rotation + first)])
    v = spacing[1] * np.array([-math.sin(rotation + second), math.cos(rotation + second)])
    for k, step in enumerate(steps):
        row, column = divmod(k, count[0])
        expected = v if column == count[0] - 1 else u if row % 2 == 0 else -u
        assert step == pytest.approx(expected, abs=1e-9)


@given(PLACE, st.tuples(SPACING, SPACING), st.tuples(COUNT, COUNT), ANGLE, ANGLE, ANGLE)
def test_a_frame_is_the_border_of_the_grid(start, spacing, count, rotation, first, second):
    """2 (n + m) - 4 different points of the grid, n m if one row or column is all; each one spacing from the next."""
    args = (start, spacing, count, rotation, (first, second))
    frame, grid = patterns.frame(*args), patterns.grid(*args)
    n, m = count
    assert len(frame) == (n * m if 1 in count else 2 * (n + m) - 4)
    index = [int(np.argmin(np.hypot(*(grid - point).T))) for point in frame]
    assert grid[index] == pytest.approx(frame, abs=1e-9)
    places = [(k // n, k % n if (k // n) % 2 == 0 else n - 1 - k % n) for k in index]
    assert len(set(places)) == len(frame) and all(row in (0, m - 1) or column in (0, n - 1) for row, column in places)
    assert all(abs(a[0] - b[0]) + abs(a[1] - b[1]) == 1 for a, b in zip(places, places[1:], strict=False))
    assert places[0] == (0, 0)


@given(PLACE, st.floats(0.5, 50), ANGLE, ANGLE, st.integers(1, 12))
def test_points_of_a_circle(centre, radius, start, step, count):
    points = patterns.circle(centre, radius, start, step, count) - centre
    assert np.hypot(*points.T) == pytest.approx(np.full(count, radius))
    assert points[0] == pytest.approx([radius * math.cos(start), radius * math.sin(start)])
    turned = np.arctan2(
        points[:-1, 0] * points[1:, 1] - points[:-1, 1] * points[1:, 0], (points[:-1] * points[1:]).sum(1)
    )
    assert np.cos(turned - step) == pytest.approx(np.ones(count - 1))


def test_the_step_between_two_angles():
    """Seven gaps of 30 degrees from 45 to 255; a whole circle of eight has eight gaps; one point has none."""
    start, end = math.radians(45), math.radians(255)
    assert patterns.step_between(start, end, 8) == pytest.approx(math.radians(30))
    assert patterns.step_between(0, patterns.TURN, 8, closed=True) == pytest.approx(math.radians(45))
    assert patterns.step_between(start, end, 1) == 0


def test_the_order_of_a_frame():
    points = patterns.frame((0.0, 0.0), (1.0, 1.0), (3, 3))
    assert points.tolist() == [[0, 0], [1, 0], [2, 0], [2, 1], [2, 2], [1, 2], [0, 2], [0, 1]]
