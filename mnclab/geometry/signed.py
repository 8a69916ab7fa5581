"""How far many points are from an area, and which lie in it: of the elements of its edge only those near a point are asked.

Points are taken square by square. An element that is farther from the middle of a square than the nearest one, by more
than the square is wide, is the nearest to none of its points.
"""

from __future__ import annotations

from functools import lru_cache
from types import EllipsisType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region

Index = NDArray[np.intp]
Mask = NDArray[np.bool_]
FEW = 4  # elements that are all asked
TOGETHER = 24  # points of a square, about
PAIRS = 1_000_000  # points times elements that are looked at together
HAIR = 1e-9  # mm, by which a distance may be rounded
KEPT = 256  # regions whose elements are kept


class Edges(NamedTuple):
    """The elements of all loops of a region, columns (e,): start, chord, its square upside down, angle swept, centre, radius
    (0 for lines), and a box about each."""

    x: Floats
    y: Floats
    dx: Floats
    dy: Floats
    less: Floats
    sweep: Floats
    u: Floats
    v: Floats
    radius: Floats
    right: Floats
    low: Floats
    high: Floats


def signed(region: Region, spots: Floats) -> Floats:
    """How far points (m, 2) are from a region, negative within (m,); infinite from an empty one."""
    if not region.loops or not len(spots):
        return np.full(len(spots), np.inf)
    x, y = spots[:, 0], spots[:, 1]
    found = _distance(edges_of(region), x, y)
    return np.where(contains(region, x, y), -found, found)


def contains(region: Region, x: Floats, y: Floats) -> Mask:
    """Which points (m,) lie in a region; one on its edge may count either way."""
    if not region.loops:
        return np.zeros(len(x), dtype=bool)
    edges, found = edges_of(region), np.zeros(len(x), dtype=bool)
    many = max(PAIRS // len(edges.x), 1)
    for k in range(0, len(x), many):
        px, py = x[k : k + many, None], y[k : k + many, None]
        point, element = np.nonzero((edges.low <= py) & (py <= edges.high) & (px <= edges.right))
        rounds = winding(edges, element, px[point, 0], py[point, 0])
        found[k : k + many] = np.bincount(point, rounds, minlength=len(px)) > 0.5
    return found


@lru_cache(maxsize=KEPT)
def edges_of(region: Region) -> Edges:
    """The elements of a region, worked out once."""
    columns = []
    for loop in region.loops:
        chord, sweep, bent = loop.ends - loop.starts, loop.sweeps, loop.sweeps != 0
        centre, radius = (np.where(mask, of, 0.0) for mask, of in ((bent[:, None], loop.centres), (bent, loop.radii)))
        low = np.where(bent[:, None], centre - radius[:, None], np.minimum(loop.starts, loop.ends)) - HAIR
        high = np.where(bent[:, None], centre + radius[:, None], np.maximum(loop.starts, loop.ends)) + HAIR
        size = (chord**2).sum(axis=1)
        less = np.divide(1.0, size, out=np.zeros_like(size), where=size > 0)
        columns.append((*loop.starts.T, *chord.T, less, sweep, *centre.T, radius, high[:, 0], low[:, 1], high[:, 1]))
    return Edges(*(np.concatenate(column) for column in zip(*columns, strict=True)))


def _distance(edges: Edges, x: Floats, y: Floats) -> Floats:
    """How far points (m,) are from the nearest element (m,)."""
    count = len(edges.x)
    if count <= FEW or len(x) <= TOGETHER:
        found = np.empty(len(x))
        many = max(PAIRS // count, 1)
        for k in range(0, len(x), many):
            found[k : k + many] = _from_all(edges, x[k : k + many], y[k : k + many]).min(axis=1)
        return found
    order, first = _squares(x, y)
    sx, sy, found = x[order], y[order], np.empty(len(x))
    many = max(PAIRS // max(count, TOGETHER * FEW), 1)
    for k in range(0, len(first) - 1, many):
        ends = first[k : k + many + 1]
        some = slice(int(ends[0]), int(ends[-1]))
        found[order[some]] = _of_squares(edges, sx[some], sy[some], ends - ends[0])
    return found


def _squares(x: Floats, y: Floats) -> tuple[Index, Index]:
    """The order of points in which those of a square follow each other, and where each square begins; the last ends."""
    wide, high = float(np.ptp(x)), float(np.ptp(y))
    side = max(np.sqrt(max(wide * high, 1e-12) * TOGETHER / len(x)), max(wide, high) / 1000, 1e-9)
    square = np.floor((y - y.min()) / side) * (np.floor(wide / side) + 1) + np.floor((x - x.min()) / side)
    order = np.argsort(square, kind="stable")
    return order, np.concatenate([[0], np.flatnonzero(np.diff(square[order])) + 1, [len(x)]])


def _of_squares(edges: Edges, x: Floats, y: Floats, first: Index) -> Floats:
    """Distances of points (m,) that follow each other square by square."""
    (x0, y0), (x1, y1) = (
        [reduce.reduceat(at, first[:-1]) for at in (x, y)] for reduce in (np.minimum, np.maximum)
    )
    half = np.hypot(x1 - x0, y1 - y0) / 2
    to_middle = _from_all(edges, (x0 + x1) / 2, (y0 + y1) / 2)
    near = to_middle <= (to_middle.min(axis=1) + 2 * half + HAIR)[:, None]
    counts = near.sum(axis=1)
    element = np.nonzero(near)[1]
    begin = np.cumsum(counts) - counts
    square = np.repeat(np.arange(len(counts)), np.diff(first))
    pairs = counts[square]
    start = np.cumsum(pairs) - pairs
    which = element[np.arange(int(pairs.sum())) + np.repeat(begin[square] - start, pairs)]
    off = _off(edges, which, np.repeat(x, pairs), np.repeat(y, pairs))
    return np.asarray(np.minimum.reduceat(off, start))


def _from_all(edges: Edges, x: Floats, y: Floats) -> Floats:
    """Distances of points (m,) from all elements (m, e)."""
    count = len(edges.x)
    every = np.tile(np.arange(count), len(x))
    return _off(edges, every, np.repeat(x, count), np.repeat(y, count)).reshape(len(x), count)


def _off(edges: Edges, which: Index, x: Floats, y: Floats) -> Floats:
    """Distances (p,) of points from one element each."""
    bent = edges.sweep[which] != 0
    if not bent.any():
        return from_lines(edges, which, x, y)
    if bent.all():
        return from_arcs(edges, which, x, y)
    found, straight = np.empty(len(x)), ~bent
    found[straight] = from_lines(edges, which[straight], x[straight], y[straight])
    found[bent] = from_arcs(edges, which[bent], x[bent], y[bent])
    return found


def from_lines(edges: Edges, k: Index | EllipsisType, x: Floats, y: Floats) -> Floats:
    """Distances of points from lines: (p,) from those numbered `k`, or of points (m, 1) from all of them with `k` as `...`."""
    px, py, dx, dy = x - edges.x[k], y - edges.y[k], edges.dx[k], edges.dy[k]
    share = np.clip((px * dx + py * dy) * edges.less[k], 0.0, 1.0)
    return np.asarray(np.hypot(px - share * dx, py - share * dy))


def from_arcs(edges: Edges, k: Index | EllipsisType, x: Floats, y: Floats) -> Floats:
    """A point in the sector of an arc is as far from it as from its circle, another one as from its nearer end."""
    ax, ay = x - edges.u[k], y - edges.v[k]
    sx, sy = edges.x[k] - edges.u[k], edges.y[k] - edges.v[k]
    ex, ey = sx + edges.dx[k], sy + edges.dy[k]
    sweep = edges.sweep[k]
    sense = np.sign(sweep)
    after, before = (sx * ay - sy * ax) * sense >= 0, (ax * ey - ay * ex) * sense >= 0
    within = np.where(np.abs(sweep) > np.pi, after | before, after & before)
    found = np.abs(np.hypot(ax, ay) - edges.radius[k])
    rest = ~within
    ends = [np.hypot((ax - at_x)[rest], (ay - at_y)[rest]) for at_x, at_y in ((sx, sy), (ex, ey))]
    found[rest] = np.minimum(*ends)
    return np.asarray(found)


def winding(edges: Edges, k: Index | EllipsisType, x: Floats, y: Floats) -> Floats:
    """By how much an element each adds to the rounds about points (p,): its chord, and the piece between it and an arc."""
    dx, dy, sweep = edges.dx[k], edges.dy[k], edges.sweep[k]
    px, py = x - edges.x[k], y - edges.y[k]
    side, low, high = dx * py - dy * px, py >= 0, edges.y[k] + dy > y
    rounds = (low & high & (side > 0)).astype(float) - (~low & ~high & (side < 0))
    if not sweep.any():
        return np.asarray(rounds)
    on_right = np.where(side == 0, (dy > 0) | ((dy == 0) & (dx < 0)), side < 0)
    within = (sweep != 0) & (np.hypot(x - edges.u[k], y - edges.v[k]) < edges.radius[k])
    return np.asarray(rounds + (within & (on_right == (sweep > 0))) * np.sign(sweep))
