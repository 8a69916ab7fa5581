"""Trochoidal slots, judged by shapely and by numbers worked out here: inside the slot, engagement, coverage, sense."""

import numpy as np
import pytest
import shapely

from mnclab.geometry.contours import Contour
from mnclab.geometry.strips import strip
from mnclab.machining.depths import TooMany
from mnclab.machining.milling.trochoidal_slots import trochoid, walls

STRAIGHT = Contour([(0, 0), (40, 0)], closed=False)
CIRCLE = Contour.circle((0, 0), 20)


def swept(way, radius):
    """What a disc sweeps along a contour, chord by chord: GEOS is not to be trusted with long lines of short chords."""
    spots = way.points_within(1e-3) if isinstance(way, Contour) else way
    chords = shapely.linestrings(np.stack([spots[:-1], spots[1:]], axis=1))
    return shapely.union_all(shapely.buffer(chords, radius, quad_segs=100))


def random_line(seed):
    """A line of lines and arcs that goes on smoothly, or with corners; open, or closed."""
    rng = np.random.default_rng(seed)
    count, closed = int(rng.integers(2, 6)), bool(rng.random() < 0.3)
    if closed:
        angle = 2 * np.pi * (np.arange(count + 2) + rng.uniform(-0.3, 0.3, count + 2)) / (count + 2)
        points = rng.uniform(12, 30, (count + 2, 1)) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        return Contour(points, np.where(rng.random(count + 2) < 0.5, rng.uniform(-0.6, 0.6, count + 2), 0.0))
    if rng.random() < 0.5:
        points = np.cumsum(rng.uniform(-20, 20, (count + 1, 2)), axis=0)
        return Contour(points, np.where(rng.random(count + 1) < 0.5, rng.uniform(-1, 1, count + 1), 0.0), closed=False)
    place, way, points, bulge = np.zeros(2), rng.uniform(0, 6), [np.zeros(2)], []
    for _ in range(count):
        turn = rng.uniform(-2.5, 2.5) if rng.random() < 0.6 else 0.0
        size = rng.uniform(2, 25)
        place = place + size * np.array([np.cos(way + turn / 2), np.sin(way + turn / 2)])
        points, bulge, way = [*points, place], [*bulge, np.tan(turn / 4)], way + turn
    return Contour(points, [*bulge, 0.0], closed=False)


def full_circles(contour):
    """Where a way ends that is a full circle in halves: the index of the point, and its centre."""
    sweeps, centres = np.abs(contour.sweeps), contour.centres
    half = np.isclose(sweeps, np.pi, atol=1e-9)
    pair = half[:-1] & half[1:] & (np.abs(centres[:-1] - centres[1:]).max(axis=1) < 1e-6)
    return np.flatnonzero(pair) + 2, centres[:-1][pair]


@pytest.mark.parametrize("seed", range(220))
def test_random_lines(seed):
    rng = np.random.default_rng(1000 + seed)
    line, radius = random_line(seed), rng.uniform(2, 6)
    width, climb = radius * rng.uniform(2.1, 4), bool(rng.random() < 0.5)
    reach, step = width / 2 - radius, radius * rng.uniform(0.1, 0.9)
    spiral, circles = trochoid(line, width, radius, step, climb=climb).passes
    # never outside: the tool centre keeps w/2 - R from the line
    spots = np.vstack([way.points_within(1e-3) for way in (spiral, circles)])
    assert line.distance(spots).max() <= reach + 1e-6
    # engagement: no farther than a step from the discs that were cleared before
    ends, centres = full_circles(circles)
    upto = np.append(0.0, np.cumsum(circles.lengths))
    ways = np.arange(upto[ends[0]], upto[-1], step / 7)
    away = np.hypot(*(circles.point_at(ways)[0][:, None] - centres).transpose(2, 0, 1)) - reach
    before = upto[ends] <= ways[:, None] + 1e-9
    assert np.where(before, away, np.inf).min(axis=1).max() <= step + 1e-6
    # one sense, and smooth but for the inner side of corners
    half = np.abs(np.abs(circles.sweeps) - np.pi) < 1e-9
    assert (np.sign(circles.sweeps[half]) == (1 if climb else -1)).all()
    assert np.allclose(spiral.points[-1], circles.points[0])


@pytest.mark.parametrize("seed", range(0, 220, 6))
@pytest.mark.deep
def test_random_lines_are_cleared(seed):
    """Roughing leaves only cusps beside the circles, and the walls take them away."""
    rng = np.random.default_rng(1000 + seed)
    line, radius = random_line(seed), rng.uniform(2, 6)
    width, climb = radius * rng.uniform(2.1, 4), bool(rng.random() < 0.5)
    step = radius * rng.uniform(0.1, 0.9)
    slot = swept(line, width / 2)
    passes = trochoid(line, width, radius, step, climb=climb).passes
    rough = shapely.union_all([swept(way, radius) for way in passes])
    assert rough.difference(slot.buffer(2e-3)).area < 1e-3
    cusp = width / 2 - np.sqrt((width / 2) ** 2 - (step / 2) ** 2)
    rest = slot.difference(rough)
    assert rest.difference(slot.boundary.buffer(cusp + 2e-3)).area < 1e-3, rest.area
    finish = shapely.union_all([rough, *(swept(w, radius) for wall in walls(line, width, radius) for w in (wall.contour, *wall.arcs))])
    assert finish.intersection(slot).area >= 0.999 * slot.area
    assert finish.difference(slot.buffer(2e-3)).area < 1e-3
