"""Sections of a milled part: closed contours of the material, on exact heights; level ones of very many moves on the map.

Upright sections are sampled along their line, level ones over the cells; where something bends or jumps between two
samples, it is halved until it is straight within `STRAIGHT`, or until it is a wall within `WALL`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.path.toolpath import Array, Mask
from mnclab.workpiece.milling.sweep import Sweep, grouped

STRAIGHT = 1e-4  # mm
WALL = 1e-9  # mm
RIM = 1e-6  # mm, of a level section
REACH = 4  # tiles of the side of a square whose points are looked at together
HALVINGS = 40

Sides = Callable[[Array], tuple[Array, Array]]  # upper and lower side of the material along a line (m,)


def upright(sides: Sides, low: float, high: float, step: float) -> list[Contour]:
    """The contours (along, height) of what lies between two sides, from `low` to `high` along a line."""
    along = np.linspace(low, high, max(int(np.ceil((high - low) / step)), 1) + 1)
    along, faces = _followed(lambda places: np.stack(sides(places)), along)
    thick = faces[0] > faces[1] + WALL
    return [_between(along[run], *faces[:, run]) for run in _runs(thick)]


def _followed(values: Callable[[Array], Array], along: Array) -> tuple[Array, Array]:
    """Places (m,) and their values (k, m), with more places wherever a line between two misses what lies there."""
    found = values(along)
    open_ = np.arange(len(along) - 1)  # intervals that may not be straight yet, by their first place
    for _ in range(HALVINGS):
        open_ = open_[along[open_ + 1] - along[open_] > WALL]
        if not len(open_):
            break
        middle = (along[open_] + along[open_ + 1]) / 2
        there = values(middle)
        bent = (np.abs(there - (found[:, open_] + found[:, open_ + 1]) / 2) > STRAIGHT).any(axis=0)
        open_, middle, there = open_[bent], middle[bent], there[:, bent]
        along, found = np.insert(along, open_ + 1, middle), np.insert(found, open_ + 1, there, axis=1)
        first = open_ + np.arange(len(open_))
        open_ = np.stack([first, first + 1], axis=1).ravel()
    return along, found


def _runs(inside: Mask) -> list[slice]:
    """The stretches where something is so."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(np.int8)))
    return [slice(a, b) for a, b in edges.reshape(-1, 2).tolist() if b - a > 1]


def _between(along: Array, top: Array, floor: Array) -> Contour:
    """The contour of one piece, counter-clockwise: along its lower side and back along its upper one."""
    along = _walls_upright(along)
    lower, upper = np.stack([along, floor], axis=1), np.stack([along, top], axis=1)[::-1]
    return Contour(merged(np.concatenate([lower, upper])))


def _walls_upright(along: Array) -> Array:
    """Both places of a wall as one."""
    place = along.copy()
    for k in np.flatnonzero(np.diff(along) <= 2 * WALL) + 1:
        place[k] = place[k - 1]
    return place


def merged(points: Array) -> Array:
    """A closed line (n, 2) without the corners that lie within `STRAIGHT` on a straight stretch."""
    points = points[(np.abs(points - np.roll(points, 1, axis=0)) > WALL).any(axis=1)]
    points = np.roll(points, -int(np.lexsort(points.T)[0]), axis=0)  # begins at a corner: nothing lies further left
    return straightened(np.concatenate([points, points[:1]]), STRAIGHT)[:-1]


def straightened(line: Array, within: float) -> Array:
    """A line (k, 2) or (k, 3) without the points that lie within a distance of a straight stretch (Douglas and Peucker)."""
    keep = np.zeros(len(line), dtype=bool)
    keep[[0, -1]] = True
    stack = [(0, len(line) - 1)]
    while stack:
        a, b = stack.pop()
        if b - a < 2:
            continue
        way, off = line[b] - line[a], line[a + 1 : b] - line[a]
        length = float(np.linalg.norm(way))
        if length > within:  # beside the stretch; one that comes back to where it began has no direction
            off = off - np.outer(off @ way / length**2, way)
        away = np.linalg.norm(off, axis=1)
        if away.max() > within:
            k = a + 1 + int(away.argmax())
            keep[k] = True
            stack += [(a, k), (k, b)]
    return line[keep]


@dataclass(frozen=True, eq=False)
class HeightSection:
    """Whether there is material at points (m,) at a height."""

    sweep: Sweep
    height: float

    def __call__(self, x: Array, y: Array) -> Mask:
        if self.sweep.gaps is None:
            return self._among(x, y, *self.sweep.sides_at(x, y))
        found = np.zeros(len(x), dtype=bool)
        for some in grouped(x, y, self.sweep.raster.tile):
            found[some] = self.nearby(x[some], y[some])
        return found

    def nearby(self, x: Array, y: Array) -> Mask:
        """The same, of points that lie close together."""
        return self._among(x, y, *self.sweep.sides(x, y))

    def _among(self, x: Array, y: Array, heights: Array, floor: Array) -> Mask:
        return self._between(x, y, self.height, heights, floor)

    def _between(self, x: Array, y: Array, z: Array | float, heights: Array, floor: Array) -> Mask:
        """Whether there is material at heights z (m,)."""
        found, gaps = np.asarray((floor <= z) & (z < heights)), self.sweep.gaps
        return found if gaps is None else found & ~gaps.empty(x, y, z)

    def about(self, x: Array, y: Array) -> HeightSection:
        return replace(self, sweep=self.sweep.about(x, y))


class Shadow(HeightSection):
    """Whether there is material at points (m,) at any height."""

    def _among(self, x: Array, y: Array, heights: Array, floor: Array) -> Mask:
        return np.asarray(heights - floor > WALL)


@dataclass(frozen=True, eq=False)
class UprightSection(HeightSection):
    """Whether there is material at points (m,) of an upright plane: `along` 0 for X, 1 for Y, and Z; `height` is where the
    plane stands."""

    along: int

    def nearby(self, x: Array, y: Array) -> Mask:
        beside = np.full_like(x, self.height)
        place = (x, beside) if self.along == 0 else (beside, x)
        return self._between(*place, y, *self.sweep.sides(*place))

    def about(self, x: Array, y: Array) -> UprightSection:
        return self


def level(sweep: Sweep, height: float, x: Array, y: Array) -> list[Contour]:
    """The contours (x, y) of the material at a height; `x` and `y` ascend and reach past it on all sides.

    Material lies to the left of a contour: outlines are counter-clockwise, holes clockwise.
    """
    return traced(HeightSection(replace(sweep, moves=sweep.moves[sweep.moves.low < height]), height), x, y)


def traced(solid: HeightSection, x: Array, y: Array) -> list[Contour]:
    """The contours of where there is material; `x` and `y` as for `level`."""
    grid = solid(*(each.ravel() for each in np.meshgrid(x, y))).reshape(len(y), len(x))
    return [Contour(merged(line)) for line in _rounded(solid, _chains(*_crossings(solid, grid, x, y)))]


def _crossings(solid: HeightSection, grid: Mask, x: Array, y: Array) -> tuple[Array, Array]:
    """Where the rim crosses the edges of the squares (n, 2), and which follows which (n,)."""
    ny, nx = grid.shape
    rows, columns = np.nonzero(grid[:, :-1] != grid[:, 1:])
    across = np.full((ny, nx - 1), -1)
    across[rows, columns] = np.arange(len(rows))
    up_rows, up_columns = np.nonzero(grid[:-1] != grid[1:])
    up = np.full((ny - 1, nx), -1)
    up[up_rows, up_columns] = len(rows) + np.arange(len(up_rows))
    across_ends, up_ends = ((x[columns], x[columns + 1]), (y[rows],) * 2), ((x[up_columns],) * 2, (y[up_rows], y[up_rows + 1]))
    one, other = (
        np.concatenate([np.stack([xs[end], ys[end]], axis=1) for xs, ys in (across_ends, up_ends)]) for end in (0, 1)
    )
    inside = np.concatenate([grid[rows, columns], grid[up_rows, up_columns]])
    inner, outer = np.where(inside[:, None], one, other), np.where(inside[:, None], other, one)
    after = np.full(len(one), -1)
    # the sides of a square in turn, counter-clockwise: the rim, with material to its left, runs from a side that leaves the
    # material to the next one that comes into it again
    corners = np.stack([grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]])
    sides = np.stack([across[:-1], up[:, 1:], across[1:], up[:, :-1]])
    leaves = corners & ~np.roll(corners, -1, axis=0)
    enters = ~corners & np.roll(corners, -1, axis=0)
    for side in range(4):
        for turn in (1, 2, 3):
            to = (side + turn) % 4
            there = leaves[side] & enters[to]
            for between in range(1, turn):
                there &= ~enters[(side + between) % 4]
            after[sides[side][there]] = sides[to][there]
    return _halved(solid, inner, outer), after


def _halved(solid: HeightSection, inner: Array, outer: Array) -> Array:
    """Where the material ends between points within it and points outside (n, 2)."""
    inner, outer = inner.copy(), outer.copy()
    for some in grouped(inner[:, 0], inner[:, 1], REACH * solid.sweep.raster.tile):
        a, b = inner[some], outer[some]
        there = solid.about(*np.concatenate([a, b]).T)
        while np.abs(b - a).max() > RIM:
            middle = (a + b) / 2
            within = there.nearby(*middle.T)[:, None]
            a, b = np.where(within, middle, a), np.where(within, b, middle)
        inner[some], outer[some] = a, b
    return (inner + outer) / 2


def _chains(points: Array, after: Array) -> list[Array]:
    """Closed lines (n, 2) of points that follow each other."""
    found, left = [], np.ones(len(points), dtype=bool)
    following = after.tolist()
    for first in range(len(points)):
        if left[first]:
            chain, at = [], first
            while left[at]:
                left[at] = False
                chain.append(at)
                at = following[at]
            found.append(points[chain])
    return found


def _rounded(solid: HeightSection, lines: list[Array]) -> list[Array]:
    """Closed lines with more points wherever they cut off a bend or a corner of the material."""
    points = np.concatenate([np.concatenate([line, line[:1]]) for line in lines] or [np.zeros((0, 2))])
    of = np.repeat(np.arange(len(lines)), [len(line) + 1 for line in lines])
    open_ = np.flatnonzero(np.diff(of) == 0)  # stretches that may not be straight yet, by their first point
    for _ in range(HALVINGS):
        way = points[open_ + 1] - points[open_]
        long = np.hypot(*way.T) > STRAIGHT
        open_, way = open_[long], way[long]
        if not len(open_):
            break
        out = way[:, ::-1] * [1, -1]  # to the right, where there is no material
        middle, near = points[open_] + way / 2, STRAIGHT * out / np.hypot(*way.T)[:, None]
        within = solid(*middle.T)[:, None]
        near, out = np.where(within, near, -near), np.where(within, out, -out)
        bent = solid(*(middle + near).T) == within[:, 0]
        bent &= solid(*(middle + out).T) != within[:, 0]  # else the rim turns away from here: it is left as it is
        open_, middle, far, within = open_[bent], middle[bent], (middle + out)[bent], within[bent]
        there = _halved(solid, np.where(within, middle, far), np.where(within, far, middle))
        points, of = np.insert(points, open_ + 1, there, axis=0), np.insert(of, open_ + 1, of[open_])
        first = open_ + np.arange(len(open_))
        open_ = np.stack([first, first + 1], axis=1).ravel()
    return [points[of == k][:-1] for k in range(len(lines))]
