"""What features take away, as simple bodies: all above a level within a region, what a cone or a chamfer slants off, and
all above a plane that falls.

The lower side of a part has the same bodies upside down: what they take away lies below.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import contours
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.geometry.signed import contains, signed
from mnclab.path.toolpath import Array, Mask

NOTHING = Region(())
TINY = 1e-6  # mm, by which a section is wide that is none


@dataclass(frozen=True, eq=False)
class Flat:
    """All of a region above `floor`, mm; with `up` False all below it."""

    region: Region
    floor: float
    up: bool = True

    def reaches(self, z: float) -> bool:
        """Whether material at a height is taken away."""
        return z > self.floor if self.up else z < self.floor

    def level(self, x: Array, y: Array) -> Array:
        """How far down (up) it reaches at points (m,); infinite beside it."""
        return np.where(within(self.region, x, y), self.floor, np.inf if self.up else -np.inf)

    @property
    def reach(self) -> Region:
        """All that it takes something of, from above."""
        return self.region

    def level_within(self, x: Array, y: Array) -> float | Array:
        """The same at points (m,) within its reach."""
        return self.floor

    def turned_over(self, flip: Array, z: float) -> Flat:
        """The same after the part was turned over: `flip` (3, 3) in the plane, heights count from `z` down."""
        return Flat(flipped(self.region, flip), z - self.floor, not self.up)


class _Sloped:
    """What goes from the height `deep` to the height `open`, where it meets the air; mm."""

    deep: float
    open: float

    @property
    def up(self) -> bool:
        return self.open > self.deep

    def reaches(self, z: float) -> bool:
        """Whether material at a height, or at one beyond it, is taken away."""
        return z > self.deep if self.up else z < self.deep

    @property
    def low(self) -> float:
        return min(self.deep, self.open)

    @property
    def high(self) -> float:
        return max(self.deep, self.open)


@dataclass(frozen=True, eq=False)
class Slanting(_Sloped):
    """A slanting face about a contour, or a cone about a point, and all between it and the feature that it stands on.

    At a distance `near` from `base`, mm, it is at the height `deep`, at `far` at the height `open`. The base is a region,
    from whose edge distances count outwards (`inside`: inwards), or a point.
    """

    base: Region | tuple[float, float]
    near: float
    far: float
    deep: float
    open: float
    inside: bool = False

    def away(self, x: Array, y: Array) -> Array:
        """How far points (m,) are from the base; negative before its edge."""
        if isinstance(self.base, Region):
            return signed(self.base, np.stack([x, y], axis=1)) * (-1.0 if self.inside else 1.0)
        return np.hypot(x - self.base[0], y - self.base[1])

    def at(self, z: float) -> float:
        """How far out it reaches at a height, mm; `near` where it does not."""
        share = (z - self.deep) / (self.open - self.deep)
        return self.near + (self.far - self.near) * min(max(share, 0.0), 1.0)

    def section(self, z: float) -> Region:
        """What it takes away at a height between both ends."""
        out = self.at(z)
        if out <= self.near + TINY:
            return NOTHING
        if isinstance(self.base, Region):
            grown = self.grown(out)
            return self.base.difference(grown) if self.inside else grown.difference(self.base)
        return self.grown(out)

    @property
    def edges(self) -> tuple[Contour, ...]:
        """The edge of its base, the slant to the right of it; none of a cone."""
        loops = self.base.loops if isinstance(self.base, Region) else ()
        return tuple(loop.reversed() for loop in loops) if self.inside else loops

    def grown(self, out: float) -> Region:
        """The base with its edge moved by a distance."""
        if isinstance(self.base, Region):
            return self.base.inset(out) if self.inside else self.base.offset(out)
        return Region((Contour.circle(self.base, out),))

    @cached_property
    def sky(self) -> Flat:
        """What is above it: no tool comes there without taking it away."""
        return Flat(self.section(self.open), self.open, self.up)

    def level(self, x: Array, y: Array) -> Array:
        """How far down (up) it reaches at points (m,); infinite beside it."""
        found = np.full(len(x), np.inf if self.up else -np.inf)
        about = np.flatnonzero(self._box(x, y))
        out = self.away(x[about], y[about])
        least = self.near if isinstance(self.base, Region) else -np.inf
        on = (out > least) & (out <= self.far)
        found[about[on]] = self._height(out[on])
        return found

    @property
    def reach(self) -> Region:
        """All that it takes something of, from above."""
        return self.sky.region

    def level_within(self, x: Array, y: Array) -> Array:
        """The same at points (m,) within its reach."""
        if isinstance(self.base, Region):
            return self._height(np.minimum(self.base.distance(np.stack([x, y], axis=1)), self.far))
        return self._height(np.minimum(self.away(x, y), self.far))

    def _height(self, out: Array) -> Array:
        share = np.maximum(out - self.near, 0.0) / (self.far - self.near)
        return np.asarray(self.deep + share * (self.open - self.deep))

    def _box(self, x: Array, y: Array) -> Mask:
        if isinstance(self.base, Region):
            (x0, y0), (x1, y1) = self.base.bounds
        else:
            (x0, y0), (x1, y1) = self.base, self.base
        return (x >= x0 - self.far) & (x <= x1 + self.far) & (y >= y0 - self.far) & (y <= y1 + self.far)

    def turned_over(self, flip: Array, z: float) -> Slanting:
        base: Region | tuple[float, float]
        if isinstance(self.base, Region):
            base = flipped(self.base, flip)
        else:
            px, py, _ = (flip @ [*self.base, 1.0]).tolist()
            base = px, py
        return replace(self, base=base, deep=z - self.deep, open=z - self.open)

    # Distances are those of triangles in the plane of the distance from the base and the height.

    def taken(self, x: Array, y: Array, z: Array) -> Array:
        """How far points (m,) are from what it takes away, mm; 0 within."""
        return self.taken_out(self.away(x, y), z)

    def taken_out(self, out: Array, z: Array) -> Array:
        """The same at distances `out` (m,) from the base."""
        return in_triangle((self.near, self.deep), (self.near, self.open), (self.far, self.open), out, z)

    def left(self, low: float, high: float, out: Array, z: Array) -> Array:
        """How far points (m,), `out` from the base, are from the material under the slant between two heights, mm; 0 within."""
        if self.up:
            corners = (self.at(low), low), (self.at(high), low), (self.at(high), high)
        else:
            corners = (self.at(high), high), (self.at(low), high), (self.at(low), low)
        return in_triangle(*corners, out, z)


@dataclass(frozen=True, eq=False)
class Wedge(_Sloped):
    """All above a plane over a rectangle, up to the height `open`: its floor rises from `deep` at the middle of its first
    edge, `start` (x, y), over `far` mm in the unit direction `ahead`; `width` mm across. Upside down with `open` below.
    """

    start: tuple[float, float]
    ahead: tuple[float, float]
    far: float
    width: float
    deep: float
    open: float
    near = 0.0

    def away(self, x: Array, y: Array) -> Array:
        """How far points (m,) are from the deep edge, along."""
        (x0, y0), (c, s) = self.start, self.ahead
        return np.asarray(c * (x - x0) + s * (y - y0))

    def beside(self, x: Array, y: Array) -> Array:
        """How far points (m,) are beside the rectangle, across."""
        (x0, y0), (c, s) = self.start, self.ahead
        return np.maximum(np.abs(c * (y - y0) - s * (x - x0)) - self.width / 2, 0.0)

    def at(self, z: float) -> float:
        """How far out it reaches at a height, mm."""
        return self.far * min(max((z - self.deep) / (self.open - self.deep), 0.0), 1.0)

    def outline(self, out: float) -> Contour:
        """The part of the rectangle within `out` mm of the deep edge."""
        (x, y), (c, s) = self.start, self.ahead
        middle = x + c * out / 2, y + s * out / 2
        return contours.rectangle(out, self.width, 0.0, centre=middle, angle=math.atan2(s, c))

    def section(self, z: float) -> Region:
        """What it takes away at a height between both ends."""
        out = self.at(z)
        return Region((self.outline(out),)) if out > TINY else NOTHING

    @cached_property
    def region(self) -> Region:
        """The whole rectangle."""
        return Region((self.outline(self.far),))

    @property
    def reach(self) -> Region:
        """All that it takes something of, from above."""
        return self.region

    @cached_property
    def sky(self) -> Flat:
        """What is above it."""
        return Flat(self.region, self.open, self.up)

    def level(self, x: Array, y: Array) -> Array:
        """How far down (up) it reaches at points (m,); infinite beside it."""
        return np.where(within(self.region, x, y), self.level_within(x, y), np.inf if self.up else -np.inf)

    def level_within(self, x: Array, y: Array) -> Array:
        """The same at points (m,) within its reach."""
        share = np.clip(self.away(x, y) / self.far, 0.0, 1.0)
        return np.asarray(self.deep + share * (self.open - self.deep))

    def turned_over(self, flip: Array, z: float) -> Wedge:
        x, y, _ = (flip @ [*self.start, 1.0]).tolist()
        c, s = (flip[:2, :2] @ self.ahead).tolist()
        return replace(self, start=(x, y), ahead=(c, s), deep=z - self.deep, open=z - self.open)

    # Distances along it are those of triangles in the plane of the way along and the height; `beside` stands across them.

    def taken(self, x: Array, y: Array, z: Array) -> Array:
        """How far points (m,) are from what it takes away, mm; 0 within."""
        return np.hypot(self.taken_out(self.away(x, y), z), self.beside(x, y))

    def taken_out(self, out: Array, z: Array) -> Array:
        """The same along, at distances `out` (m,) from the deep edge."""
        return in_triangle((0.0, self.deep), (0.0, self.open), (self.far, self.open), out, z)

    def left(self, low: float, high: float, out: Array, z: Array) -> Array:
        """How far points (m,), `out` from the deep edge, are along from the material under the slant between two heights."""
        first, last = (low, high) if self.up else (high, low)
        return in_triangle((self.at(first), first), (self.at(last), first), (self.at(last), last), out, z)


def in_triangle(a: tuple[float, float], b: tuple[float, float], c: tuple[float, float], s: Array, z: Array) -> Array:
    """How far points (m,) of a plane are from a triangle, 0 within."""
    sides, inside = [], np.ones(len(s), dtype=bool)
    turn = np.sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    for (s0, z0), (s1, z1) in ((a, b), (b, c), (c, a)):
        ds, dz = s1 - s0, z1 - z0
        share = np.clip(((s - s0) * ds + (z - z0) * dz) / max(ds * ds + dz * dz, 1e-300), 0.0, 1.0)
        sides.append(np.hypot(s - s0 - share * ds, z - z0 - share * dz))
        inside &= (ds * (z - z0) - dz * (s - s0)) * turn >= 0
    return np.where(inside, 0.0, np.min(sides, axis=0))


def within(region: Region, x: Array, y: Array) -> Mask:
    """Which points (m,) lie in a region: only those in the box about it are looked at."""
    found = np.zeros(len(x), dtype=bool)
    if region.loops:
        (x0, y0), (x1, y1) = region.bounds
        about = np.flatnonzero((x >= x0) & (x <= x1) & (y >= y0) & (y <= y1))
        found[about] = contains(region, x[about], y[about])
    return found


def flipped(region: Region, flip: Array) -> Region:
    """A region under a mirror (3, 3) of the plane."""
    return Region(tuple(loop.transformed(flip).reversed() for loop in region.loops))


Slant = Slanting | Wedge
Removal = Flat | Slant


# Which of many points on a lattice lie in an area: row by row, from where its edge crosses the rows.


def filled(region: Region, x: Floats, y: Floats) -> tuple[slice, slice, Mask]:
    """Rows and columns of the box about a region in a lattice x (nx,), y (ny,), ascending, and which points there lie in it.

    A point on the edge may count either way.
    """
    if not region.loops:
        return slice(0, 0), slice(0, 0), np.zeros((0, 0), dtype=bool)
    (x0, y0), (x1, y1) = region.bounds
    rows, columns = (slice(*np.searchsorted(at, ends)) for at, ends in ((y, (y0, y1)), (x, (x0, x1))))
    across, up = x[columns], y[rows]
    turns = np.zeros((len(up), len(across) + 1), dtype=np.int16)
    for loop in region.loops:
        for row, place, sense in _crossings(loop, up):
            np.add.at(turns, (row, np.searchsorted(across, place)), sense)
    return rows, columns, np.cumsum(turns, axis=1, dtype=np.int16)[:, :-1] > 0


def _crossings(loop: Contour, y: Floats) -> list[tuple[NDArray[np.intp], Floats, NDArray[np.int16]]]:
    """Where elements cross rows: the rows, the places along them, +1 where they cross downwards and the area begins."""
    found = []
    for start, end, sweep, centre, radius in zip(loop.starts, loop.ends, loop.sweeps, loop.centres, loop.radii):
        for (xa, ya), (xb, yb) in _rising(start, end, sweep, centre, radius):
            low, high = np.searchsorted(y, (min(ya, yb), max(ya, yb)))
            if low == high:
                continue
            row = np.arange(low, high)
            if sweep:
                half = np.sqrt(np.maximum(radius * radius - (y[row] - centre[1]) ** 2, 0.0))
                right = (yb > ya) == (sweep > 0)  # counter-clockwise an arc rises on the right of its centre
                place = centre[0] + (half if right else -half)
            else:
                place = xa + (y[row] - ya) / (yb - ya) * (xb - xa)
            found.append((row, place, np.full(len(row), 1 if yb < ya else -1, dtype=np.int16)))
    return found


def _rising(start: Floats, end: Floats, sweep: float, centre: Floats, radius: float) -> list[tuple[Floats, Floats]]:
    """An element in pieces that only rise or only fall."""
    if not sweep:
        return [(start, end)]
    first = np.arctan2(*(start - centre)[::-1])
    tops = np.pi * np.arange(-3, 4) + np.pi / 2
    ahead = (tops - first) * np.sign(sweep)
    ahead = np.sort(ahead[(ahead > 0) & (ahead < abs(sweep))])
    places = [centre + (0.0, radius * np.sign(np.sin(first + each * np.sign(sweep)))) for each in ahead]
    corners = [start, *places, end]
    return list(zip(corners, corners[1:]))
