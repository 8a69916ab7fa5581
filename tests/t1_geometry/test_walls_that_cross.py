"""Walls that may cross: every pair of a contour that does is among them, and a smooth ring has none."""

import numpy as np
import pytest

from mnclab.geometry.chords import Walls, chunks, may_cross
from mnclab.geometry.curves import Curves, beside, unit_of


def walls_along(points, side=1.0):
    """Lines between points (n, 2), with the tool on one side all the way."""
    n, none = len(points) - 1, np.full(len(points) - 1, np.nan)
    normal = beside(np.zeros((1, 2)), unit_of(np.diff(points, axis=0)), np.full(n, side))
    curves = Curves(points[:-1], points[1:], np.full((n, 2), np.nan), none, np.zeros(n))
    return Walls(curves, normal, normal, np.arange(n) > 0, np.full(n, side), np.zeros(n, np.int64))


def crossing(points):
    """Pairs of lines that cross, each with each: the ends of either lie on both sides of the other."""
    a, b = points[:-1, None], points[1:, None]
    c, d = a.swapaxes(0, 1), b.swapaxes(0, 1)

    def turn(p, q, r):
        return (q[..., 0] - p[..., 0]) * (r[..., 1] - p[..., 1]) - (q[..., 1] - p[..., 1]) * (r[..., 0] - p[..., 0])

    return np.argwhere((turn(a, b, c) * turn(a, b, d) < 0) & (turn(c, d, a) * turn(c, d, b) < 0))


@pytest.mark.parametrize("seed", range(20))
def test_every_pair_that_crosses_is_among_them(seed):
    random = np.random.default_rng(seed)
    bend = random.choice([0.01, 0.03, 0.1, 0.5])  # rad from line to line, in waves
    heading = np.cumsum(bend * np.sin(np.cumsum(random.uniform(0, 0.1, 1500))) + random.normal(0, bend / 10, 1500))
    points = np.cumsum(np.stack([np.cos(heading), np.sin(heading)], axis=1), axis=0)
    walls = walls_along(points, random.choice([-1.0, 1.0]))
    pairs = crossing(points)
    assert set(pairs.ravel().tolist()) <= set(may_cross(walls, chunks(walls)).tolist())


def test_a_smooth_ring_has_none_and_an_eight_has_some():
    angle = np.linspace(0.3, 0.3 + 2 * np.pi, 5001)
    ring = walls_along(1000 * np.stack([np.cos(angle), np.sin(angle)], axis=1)[:-8])
    assert not len(may_cross(ring, chunks(ring)))
    points = 1000 * np.stack([np.sin(angle), np.sin(2 * angle) / 2], axis=1)
    eight = walls_along(points)
    found = may_cross(eight, chunks(eight))
    assert len(crossing(points[:-8])) >= 2 and 0 < len(found) < len(points) / 4


def test_a_gap_between_walls_counts_as_a_place_to_look():
    walls = walls_along(np.stack([np.arange(200.0), np.zeros(200)], axis=1))
    assert not len(may_cross(walls, chunks(walls)))
    walls.joined[100] = False
    assert may_cross(walls, chunks(walls)).tolist() == list(range(64, 128))
