"""Least distances between lines and arcs, their crossings and parts, against points along them."""

import numpy as np

from mnclab.geometry.curves import Curves, crossings, distance, gap, part


def some(rng, n):
    """Lines and arcs, some of more than half a turn."""
    centre, r = rng.uniform(-10, 10, (n, 2)), rng.uniform(0.5, 12, n)
    begin, sweep = rng.uniform(0, 7, n), rng.uniform(0.1, 6.2, n) * rng.choice([1, -1], n)
    start, end = (centre + r[:, None] * np.stack([np.cos(a), np.sin(a)], 1) for a in (begin, begin + sweep))
    line = rng.random(n) < 0.4
    nan = np.where(line[:, None], np.nan, centre)
    return Curves(start, end, nan, np.where(line, np.nan, r), np.where(line, 0.0, sweep))


def test_the_gap_is_the_least_distance_of_points():
    rng = np.random.default_rng(5)
    a, b = some(rng, 1500), some(rng, 1500)
    exact, least = gap(a, b), np.full(1500, np.inf)
    for t in np.linspace(0, 1, 801):
        least = np.minimum(least, distance(part(a, np.zeros(1500), np.full(1500, t)).end, b))
    step = np.where(a.arc, np.abs(a.sweep) * np.nan_to_num(a.r), np.hypot(*(a.end - a.start).T)) / 800
    assert (exact <= least + 1e-9).all() and (exact >= least - step / 2 - 1e-9).all()
    assert 100 < (exact == 0).sum() < 1400


def test_crossings_lie_on_both():
    rng = np.random.default_rng(6)
    a, b = some(rng, 1500), some(rng, 1500)
    for p in crossings(a, b):
        k = np.flatnonzero(np.isfinite(p[:, 0]))
        assert len(k) > 100
        assert np.maximum(distance(p[k], a.take(k)), distance(p[k], b.take(k))).max() < 1e-6


def test_a_part_of_a_curve():
    """The middle third of a half circle of radius 3 from (3, 0): 60 to 120 degrees."""
    half = Curves(*(np.array([v]) for v in ((3.0, 0.0), (-3.0, 0.0), (0.0, 0.0), 3.0, np.pi)))
    third = part(half, np.array([1 / 3]), np.array([2 / 3]))
    assert np.allclose(third.start, [[1.5, 3 * np.sqrt(0.75)]]) and np.allclose(third.end, [[-1.5, 3 * np.sqrt(0.75)]])
    assert np.allclose(third.sweep, np.pi / 3)
