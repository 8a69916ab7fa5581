"""Whether the tool fits: against shapely's offsets, and the largest radius against trying radii on both sides of it."""

import numpy as np
import pytest
import shapely

from mnclab.path.toolpath import Rule

pytestmark = pytest.mark.deep

SHARP = 1e-6  # mm


def cases(closed, seed, count):
    """Contours, sides and radii."""
    rng = np.random.default_rng(seed)
    while count:
        points = closed.shape(rng)
        if points is not None:
            count -= 1
            yield points, int(rng.choice([1, -1])), round(float(rng.uniform(0.2, 8)), 3)


def clear(closed, points, path, radius):
    """Whether the tool centre keeps its distance from the contour: at its points, and between within the chord error."""
    ring, way = shapely.LinearRing(points), closed.body(path)
    least = shapely.distance(shapely.points(way.coords), ring).min()
    return least > radius - 1e-9 and shapely.distance(way, ring) > radius - 2e-6


def test_what_is_accepted_keeps_its_distance_and_what_is_refused_cannot(closed):
    """What is refused: shapely's offset loses an edge, because no place of the tool touches it."""
    seen = {True: 0, False: 0}
    for points, side, radius in cases(closed, 1, 160):
        path, gouge = closed.compensated(closed.contour(points, side, radius))
        seen[gouge is None] += 1
        if gouge is None:
            assert clear(closed, points, path, radius)
            continue
        # every edge must be touched: where its whole offset lies in the part grown by the radius it cannot be
        ring = shapely.LinearRing(points)
        grown = ring.buffer(radius - 1e-6, quad_segs=24)
        ends = np.concatenate([points, points[:1]])
        normal = side * np.diff(ends, axis=0)[:, ::-1] * [-1, 1]
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        offsets = shapely.linestrings(np.stack([ends[:-1] + radius * normal, ends[1:] + radius * normal], axis=1))
        covered = shapely.length(shapely.intersection(offsets, grown.buffer(1e-9)))
        assert (covered > 1e-7).any(), (points.tolist(), side, radius, gouge)
    assert min(seen.values()) >= 40


@pytest.mark.parametrize("corner", [0, 1, 2])
def test_no_false_alarm(closed, corner):
    """Two thousand contours with a tool below what shapely's distances say: half the least way across fits."""
    rng, good = np.random.default_rng(2 + corner), []
    while len(good) < 700:
        n = int(rng.integers(4, 12))
        angles = np.sort(rng.uniform(0, 2 * np.pi, n))
        if np.diff(np.append(angles, angles[0] + 2 * np.pi)).max() > 2.4 or np.diff(angles).min() < 0.2:
            continue
        r = rng.uniform(30, 60, n)
        points, side = np.round(np.stack([r * np.cos(angles), r * np.sin(angles)], axis=1), 3), int(rng.choice([1, -1]))
        # each edge keeps more than its corners take, and the walls that are no neighbours stay far apart
        around = np.diff(np.concatenate([points[-1:], points, points[:1]]), axis=0)
        turn = np.arctan2(*[f(around[:-1], around[1:]) for f in (_cross, _dot)])
        take = np.tan(np.abs(turn) / 2)
        edge = np.linalg.norm(around[1:], axis=1)
        room = (edge / (take + np.roll(take, -1))).min()
        room = min(room, edge[0] / 2 / max(take[0], take[1]))  # the tool arrives in the middle of the first
        rings = shapely.linestrings(np.stack([points, np.roll(points, -1, axis=0)], axis=1))
        far = [shapely.distance(rings[i], rings[j]) for i in range(n) for j in range(i + 2, n) if (j + 1) % n != i]
        radius = 0.98 * min(room, min(far, default=np.inf) / 2 / (1 if corner == 0 else 1 + take.max()))
        good.append((points, closed.contour(points, side, radius, corner), radius))
    path, gouge = closed.compensated(closed.joined([contour for _, contour, _ in good]))
    assert gouge is None, gouge
    assert (path.rule == Rule.ENTRY).sum() == 700
    for points, contour, radius in good[::20]:
        assert clear(closed, points, closed.compensated(contour)[0], radius)


def _cross(a, b):
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _dot(a, b):
    return (a * b).sum(axis=1)


@pytest.mark.parametrize("corner", [0, 1, 2])
def test_the_largest_radius_is_where_it_begins_to_fail(closed, corner):
    """At the largest radius less a micrometre's thousandth it fits, at as much more it does not; and by halving."""
    kinds, halving = {}, 0
    for points, side, radius in cases(closed, 10 + corner, 160):
        gouge = closed.compensated(closed.contour(points, side, radius, corner))[1]
        if gouge is None or gouge.largest < 1e-3:
            continue
        kinds[gouge.kind] = kinds.get(gouge.kind, 0) + 1

        def fits(r, points=points, side=side):
            return closed.compensated(closed.contour(points, side, r, corner))[1] is None

        assert fits(gouge.largest - SHARP) and not fits(gouge.largest + SHARP)
        if halving < 10 and corner == 0:
            halving += 1
            low, high = 0.0, radius
            while high - low > 1e-8:
                middle = (low + high) / 2
                low, high = (middle, high) if fits(middle) else (low, middle)
            assert low == pytest.approx(gouge.largest, abs=SHARP)
    assert sum(kinds.values()) >= 70 and {"element", "bottleneck"} <= kinds.keys()


def test_rules_of_a_square_outside(closed):
    """Corners of 90 degrees: arcs (G160), else one point."""
    square = np.array([[0, 0], [40, 0], [40, 40], [0, 40.0]])
    for corner, expected in ((0, Rule.OUTSIDE_ARC), (1, Rule.OUTSIDE_STRAIGHT), (2, Rule.OUTSIDE_STRAIGHT)):
        rule = closed.compensated(closed.contour(square, -1, 2.0, corner))[0].rule
        assert (rule == expected).sum() == 4 and rule[0] == Rule.ENTRY and rule[-1] == Rule.EXIT
        inside = closed.compensated(closed.contour(square, 1, 2.0, corner))[0].rule
        assert (inside == Rule.INSIDE).sum() == 4 and not (inside == expected).any()
