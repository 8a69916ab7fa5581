"""Rings on 200 random areas, judged by distances: the same areas, made from the same numbers without our contours.

    room of a place       its distance from the edge of the area, a polygon within `HAIR` of the truth
    C                     where the tool centre may go: room ≥ R + allowance
    cleared               places within R of a pass

The edge of C lies on passes, so all is cleared that a tool on it reaches; places within C are searched by squares, halved as
long as one of their places may lie too far from all passes. What is nearer to its limit than some `HAIR` is left open.
"""

import numpy as np
import pytest
import shapely
from tools.random_regions import random_task

from mnclab.machining.milling.rings import rings

pytestmark = pytest.mark.deep
BLOCK = 50
HAIR = 1e-3  # mm, by which polygons may be off
TOUCH = 2e-6  # mm, by which a place may be off
SPACING = 0.5  # mm, of the places that are tried along an edge or a pass
CORNERS = np.array([(-1, -1), (1, -1), (-1, 1), (1, 1)]) / 2


class Pieces:
    """Straight pieces from `a` to `b`, each `(n, 2)`."""

    def __init__(self, rings):
        self.a = np.concatenate(rings)
        self.b = np.concatenate([np.roll(ring, -1, axis=0) for ring in rings])
        self.before = np.concatenate([np.roll(ring, 1, axis=0) for ring in rings])
        self.tree = shapely.STRtree(shapely.linestrings(np.stack([self.a, self.b], axis=1)))

    def distance(self, spots):
        """Of places `(k, 2)` from the nearest piece, `(k,)`."""
        (k, _), away = self.tree.query_nearest(shapely.points(spots), return_distance=True, all_matches=False)
        return away[np.argsort(k)]

    def within(self, spots, reach):
        """Which places some piece comes nearer to than `reach`."""
        found = np.zeros(len(spots), dtype=bool)
        found[self.tree.query(shapely.points(spots), predicate="dwithin", distance=reach)[0]] = True
        return found

    def places(self):
        """Places on the pieces, their starts among them, and the piece of each."""
        count = np.ceil(np.hypot(*(self.b - self.a).T) / SPACING).astype(int)
        k = np.repeat(np.arange(len(count)), count)
        share = (np.arange(len(k)) - np.repeat(np.cumsum(count) - count, count)) / count[k]
        return self.a[k] + share[:, None] * (self.b - self.a)[k], k

    def beside(self, distance):
        """Places at a distance to the left of the pieces, and about the corners that turn to the right."""
        along, before = self.b - self.a, self.a - self.before
        spots, k = self.places()
        aside = along / np.hypot(*along.T)[:, None] @ np.array([[0, 1], [-1, 0]])
        turn = np.arctan2(before[:, 0] * along[:, 1] - before[:, 1] * along[:, 0], (before * along).sum(axis=1))
        count = np.where(turn < 0, np.ceil(-turn * distance / SPACING).astype(int), 0)
        corner = np.repeat(np.arange(len(count)), count)
        share = (np.arange(len(corner)) - np.repeat(np.cumsum(count) - count, count) + 0.5) / count[corner]
        way = np.arctan2(aside[corner, 1], aside[corner, 0]) - share * turn[corner]
        fans = self.a[corner] + distance * np.stack([np.cos(way), np.sin(way)], axis=1)
        return np.concatenate([spots + distance * aside[k], fans])


def edge_of(area):
    """The edge of a shapely area, which lies to the left of its pieces."""
    loops = shapely.get_rings(shapely.get_parts(shapely.normalize(area)))  # normal: outer rings clockwise
    return Pieces([shapely.get_coordinates(loop)[:0:-1] for loop in loops])


def place_in(area, edge, keep, passes, radius):
    """A place of room `keep` that is farther than `radius` from all passes (if there are some), or None."""
    low, high = np.array(shapely.bounds(area)).reshape(2, 2)
    size = (high - low).min() / 8 if passes is None else radius
    across, up = (np.arange(low[k] + size / 2, high[k] + size / 2, size) for k in range(2))
    spots = np.stack(np.meshgrid(across, up), axis=-1).reshape(-1, 2)
    while len(spots):
        half = size * np.sqrt(0.5)
        if passes is None:
            far = np.full(len(spots), np.inf)
        else:
            far = passes.distance(spots)
            spots, far = spots[far + half > radius], far[far + half > radius]
        room = edge.distance(spots) * np.where(shapely.contains_xy(area, spots), 1, -1)
        found = (room > keep) & (far > radius)
        if found.any():
            return spots[found][0]
        spots = spots[room + half > keep]
        size /= 2
        if size < HAIR / 2:
            return None
        spots = (spots[:, None] + size * CORNERS).reshape(-1, 2)
    return None


@pytest.mark.parametrize("first", range(0, 200, BLOCK))
def test_rings_clear_what_the_tool_reaches_and_nothing_else(first):
    for seed in range(first, first + BLOCK):
        judge(seed)


def judge(seed):
    """All that is asked of the rings of one area."""
    task = random_task(seed)
    area, keep, room = task.polygon(HAIR / 10), task.radius + task.allowance, task.region
    edge = edge_of(area)
    shapely.prepare(area)
    try:
        clearing = rings(room, task.radius, task.stepover, allowance=task.allowance)
    except ValueError as error:
        assert "does not fit" in str(error), seed
        assert place_in(area, edge, keep + 2 * HAIR, None, 0) is None, seed
        return
    assert all(way.closed for way in clearing.passes), seed
    passes = Pieces([way.points_within(HAIR)[:-1] for way in clearing.passes])
    spots = np.concatenate([passes.a, *(way.point_at(np.arange(0, way.length, SPACING))[0] for way in clearing.passes)])
    assert shapely.contains_xy(area, spots).all(), (seed, "outside")
    assert not edge.within(spots, keep - HAIR - TOUCH).any(), (seed, "allowance")
    close = spots[edge.within(spots, keep + 2 * HAIR)]
    assert room.distance(close).min() > keep - TOUCH, (seed, "allowance")
    rim = edge.beside(keep + 2 * HAIR)
    rim = rim[shapely.contains_xy(area, rim)]
    rim = rim[~edge.within(rim, keep + 2 * HAIR - TOUCH)]
    assert passes.within(rim, 5 * HAIR).all(), (seed, "left at a wall", rim[~passes.within(rim, 5 * HAIR)][0])
    left = place_in(area, edge, keep + 2 * HAIR, passes, task.radius + 3 * HAIR)
    assert left is None, (seed, "left", left)
    ends = [(a.points[0], b.points[0]) for piece in clearing.pieces
            for a, b, linked in zip(piece.passes, piece.passes[1:], piece.linked, strict=False) if linked]  # fmt: skip
    for a, b in ends:
        way = a + np.linspace(0, 1, 2 + int(np.hypot(*(b - a)) / 0.1))[:, None] * (b - a)
        assert shapely.contains_xy(area, way).all(), (seed, "link")
        assert not edge.within(way, keep - HAIR - 2 * TOUCH).any(), (seed, "link")
