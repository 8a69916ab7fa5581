"""Least distances between lines and arcs, their crossings and parts, against points along them."""

import numpy as np

from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.curves import Curves, Element, at_levels, crossed, crossings, distance, gap, meet, part, rounded


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


def test_whole_lines_and_circles_meet():
    """y = 3, circles of 5 about (0, 0) and (8, 0), the line through 0 by 3 : 4; then y = 6, which misses a circle by 1."""
    none = (np.nan, np.nan), np.nan
    line, slope, high = ((0.0, 3.0), (1.0, 0.0), *none), ((0.0, 0.0), (0.6, 0.8), *none), ((0.0, 6.0), (1.0, 0.0), *none)
    circle, other = ((5.0, 0.0), (0.0, 1.0), (0.0, 0.0), 5.0), ((13.0, 0.0), (0.0, 1.0), (8.0, 0.0), 5.0)
    one, two = (Element(*(np.array(column) for column in zip(*rows))) for rows in (
        (line, circle, circle, slope, high), (circle, line, other, line, circle)))  # fmt: skip
    near = np.array([(3.0, 3.0), (-3.0, 3.0), (4.0, -1.0), (9.0, 9.0), (0.0, 0.0)])
    places = [(4.0, 3.0), (-4.0, 3.0), (4.0, -3.0), (2.25, 3.0)]
    assert np.allclose(meet(one, two, near)[:4], places) and np.isnan(meet(one, two, near)[4]).all()
    assert np.allclose(meet(one, two, near, touching=True), [*places, (0.0, 6.0)])


def test_the_rounding_of_a_square_corner():
    """Of two lines at a right angle the centre lies a radius beside both, and the arc is a quarter to the left."""
    corner = Contour([(0, 0), (10, 0), (10, 10)], closed=False).curves
    found = rounded(corner.take(np.array([0])), corner.take(np.array([1])), np.array([2.0]), np.array([[10.0, 0.0]]))
    assert np.allclose(found.centre, [[8.0, 2.0]]) and np.allclose(found.sweep, np.pi / 2)
    assert np.allclose(found.first, [[8.0, 0.0]]) and np.allclose(found.last, [[10.0, 2.0]])


def test_where_an_outline_crosses_levels():
    """A circle of 5 about (1, 2): x = 1 ± 4 at y = 5 and -1, ± 5 at y = 2; nothing at 8. Of a rectangle the upper side counts."""
    ring, levels = Contour.circle((1.0, 2.0), 5.0, start=0.3).curves, np.array([5.0, 2.0, 8.0, -1.0])
    assert [row.round(9).tolist() for row in crossed(ring, levels)] == [[-3, 5], [-4, 6], [], [-3, 5]]
    assert [row.round(9).tolist() for row in crossed(ring, np.array([4.0]), axis=0)] == [[-2, 6]]
    square = rectangle(4.0, 2.0).curves
    assert [row.tolist() for row in crossed(square, np.array([1.0, 0.0, -1.0]))] == [[-2, 2], [-2, 2], []]


def test_levels_at_corners_are_crossed_an_even_number_of_times():
    rng = np.random.default_rng(7)
    for _ in range(200):
        outline = Contour(rng.uniform(-9, 9, (7, 2)), rng.uniform(-1.5, 1.5, 7))
        for axis in (0, 1):
            number, place = at_levels(outline.curves, outline.points[:, axis], axis)
            assert not (np.bincount(number, minlength=7) % 2).any() and np.isfinite(place).all()
            across = np.empty((len(number), 2))
            across[:, axis], across[:, 1 - axis] = outline.points[number, axis], place
            assert outline.distance(across).max(initial=0.0) < 1e-6
