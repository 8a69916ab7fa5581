"""What features take away, as simple bodies: all above a level within a region, a cone about a point, the bevel of an edge,
and all above a ramp.

The lower side of a part has the same bodies upside down: what they take away lies below.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import contours
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.geometry.signed import contains, signed
from mnclab.geometry.tracing import bands_beside
from mnclab.path.toolpath import Array, Mask

NOTHING = Region(())
TINY = 1e-6  # mm, by which a section is wide that is none
CLEARANCE = "clearance"  # the part of a feature that is the room above a sloped face


@dataclass(frozen=True, eq=False)
class Flat:
    """All of a region above `floor`, mm; with `up` False all below it. `part` is which part of its feature it is."""

    region: Region
    floor: float
    up: bool = True
    part: str = ""
    upright = True

    def reaches(self, z: float) -> bool:
        """Whether material at a height is taken away."""
        return z > self.floor if self.up else z < self.floor

    def section(self, z: float) -> Region:
        """What it takes away at a height that it reaches."""
        return self.region

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

    def from_faces(self, x: Array, y: Array, z: Array) -> Array:
        """How far points (m,) are from the faces that it makes, mm."""
        beside = signed(self.region, np.stack([x, y], axis=1))
        above = z - self.floor if self.up else self.floor - z
        wall = np.hypot(np.abs(beside), np.maximum(-above, 0.0))
        return np.minimum(wall, np.where(beside <= 0, np.abs(above), np.inf))

    def turned_over(self, flip: Array, z: float) -> Flat:
        """The same after the part was turned over: `flip` (3, 3) in the plane, heights count from `z` down."""
        return replace(self, region=flipped(self.region, flip), floor=z - self.floor, up=not self.up)


@dataclass(frozen=True, eq=False, kw_only=True)
class Sloped(ABC):
    """What goes from the height `deep` to the height `open`, where it meets the air: at the distance `near` from its base it
    is at the one, at `far` at the other; mm. `part` is which part of its feature it is.

    `upright`: it has walls besides its sloped face.
    """

    near: float = 0.0
    far: float
    deep: float
    open: float
    part: str = ""
    upright = False

    @property
    def up(self) -> bool:
        return self.open > self.deep

    @property
    def low(self) -> float:
        return min(self.deep, self.open)

    @property
    def high(self) -> float:
        return max(self.deep, self.open)

    def reaches(self, z: float) -> bool:
        """Whether material at a height, or at one beyond it, is taken away."""
        return z > self.deep if self.up else z < self.deep

    def at(self, z: float) -> float:
        """How far out it reaches at a height, mm; `near` where it does not."""
        share = (z - self.deep) / (self.open - self.deep)
        return self.near + (self.far - self.near) * min(max(share, 0.0), 1.0)

    @abstractmethod
    def away(self, x: Array, y: Array) -> Array:
        """How far points (m,) are from the base; negative before its edge."""

    @abstractmethod
    def section(self, z: float) -> Region:
        """What it takes away at a height between both ends."""

    @abstractmethod
    def bands(self, out: float) -> Iterator[Contour]:
        """What lies nearer to the base than a distance, on its side."""

    @property
    @abstractmethod
    def reach(self) -> Region:
        """All that it takes something of, from above."""

    @abstractmethod
    def level(self, x: Array, y: Array) -> Array:
        """How far down (up) it reaches at points (m,); infinite beside it."""

    @abstractmethod
    def turned_over(self, flip: Array, z: float) -> Self:
        """The same after the part was turned over: `flip` (3, 3) in the plane, heights count from `z` down."""

    @cached_property
    def clearance(self) -> Flat:
        """What is above it: no tool comes there without taking it away."""
        return Flat(self.reach, self.open, self.up, CLEARANCE)

    def level_within(self, x: Array, y: Array) -> Array:
        """How far down (up) it reaches at points (m,) within its reach."""
        return self._height(self.away(x, y))

    def _height(self, out: Array) -> Array:
        share = np.clip((out - self.near) / (self.far - self.near), 0.0, 1.0)
        return np.asarray(self.deep + share * (self.open - self.deep))

    def from_faces(self, x: Array, y: Array, z: Array) -> Array:
        """How far points (m,) are from the face that it makes, mm."""
        s, ds, dz = self.away(x, y), self.far - self.near, self.open - self.deep
        share = np.clip(((s - self.near) * ds + (z - self.deep) * dz) / (ds * ds + dz * dz), 0.0, 1.0)
        return np.hypot(s - self.near - share * ds, z - self.deep - share * dz)

    # Distances are those of triangles in the plane of the distance from the base and the height.

    def across(self, along: Array, x: Array, y: Array) -> Array:
        """Distances `along` (m,) in that plane as those of points (m,)."""
        return along

    def taken(self, x: Array, y: Array, z: Array) -> Array:
        """How far points (m,) are from what it takes away, mm; 0 within."""
        return self.across(self.taken_out(self.away(x, y), z), x, y)

    def taken_out(self, out: Array, z: Array) -> Array:
        """The same in the plane, at distances `out` (m,) from the base."""
        return in_triangle((self.near, self.deep), (self.near, self.open), (self.far, self.open), out, z)

    def left(self, low: float, high: float, out: Array, z: Array) -> Array:
        """How far points (m,) of the plane are from the material under the slope between two heights, mm; 0 within."""
        first, last = (low, high) if self.up else (high, low)
        return in_triangle((self.at(first), first), (self.at(last), first), (self.at(last), last), out, z)


@dataclass(frozen=True, eq=False)
class Cone(Sloped):
    """A cone about the point `centre` (x, y)."""

    centre: tuple[float, float]

    def away(self, x: Array, y: Array) -> Array:
        return np.hypot(x - self.centre[0], y - self.centre[1])

    def section(self, z: float) -> Region:
        out = self.at(z)
        return NOTHING if out <= self.near + TINY else Region((Contour.circle(self.centre, out),))

    def bands(self, out: float) -> Iterator[Contour]:
        yield Contour.circle(self.centre, out)

    @property
    def reach(self) -> Region:
        return self.section(self.open)

    def level(self, x: Array, y: Array) -> Array:
        out = self.away(x, y)
        return np.where(out <= self.far, self._height(out), np.inf if self.up else -np.inf)

    def turned_over(self, flip: Array, z: float) -> Self:
        px, py, _ = (flip @ [*self.centre, 1.0]).tolist()
        return replace(self, centre=(px, py), deep=z - self.deep, open=z - self.open)


@dataclass(frozen=True, eq=False)
class Bevel(Sloped):
    """The sloped face about a region, from whose edge distances count outwards (`inside`: inwards), and all between it and the
    feature that it stands on.
    """

    base: Region
    inside: bool = False

    def away(self, x: Array, y: Array) -> Array:
        return signed(self.base, np.stack([x, y], axis=1)) * (-1.0 if self.inside else 1.0)

    def section(self, z: float) -> Region:
        out = self.at(z)
        if out <= self.near + TINY:
            return NOTHING
        grown = self.grown(out)
        return self.base.difference(grown) if self.inside else grown.difference(self.base)

    def bands(self, out: float) -> Iterator[Contour]:
        for edge in self.edges:
            yield from bands_beside(edge.reversed(), out)

    @cached_property
    def reach(self) -> Region:
        return self.section(self.open)

    @property
    def edges(self) -> tuple[Contour, ...]:
        """The edge of its base, the slope to the right of it."""
        return tuple(loop.reversed() for loop in self.base.loops) if self.inside else self.base.loops

    def grown(self, out: float) -> Region:
        """The base with its edge moved by a distance."""
        return self.base.inset(out) if self.inside else self.base.offset(out)

    def level(self, x: Array, y: Array) -> Array:
        found = np.full(len(x), np.inf if self.up else -np.inf)
        (x0, y0), (x1, y1) = self.base.bounds
        box = (x >= x0 - self.far) & (x <= x1 + self.far) & (y >= y0 - self.far) & (y <= y1 + self.far)
        about = np.flatnonzero(box)
        out = self.away(x[about], y[about])
        on = (out > self.near) & (out <= self.far)
        found[about[on]] = self._height(out[on])
        return found

    def level_within(self, x: Array, y: Array) -> Array:
        return self._height(self.base.distance(np.stack([x, y], axis=1)))

    def turned_over(self, flip: Array, z: float) -> Self:
        return replace(self, base=flipped(self.base, flip), deep=z - self.deep, open=z - self.open)


@dataclass(frozen=True, eq=False)
class Ramp(Sloped):
    """All above a plane over a rectangle: its floor rises from the middle of its first edge, `start` (x, y), in the unit
    direction `ahead`; `width` mm across.
    """

    start: tuple[float, float]
    ahead: tuple[float, float]
    width: float
    upright = True

    def away(self, x: Array, y: Array) -> Array:
        (x0, y0), (c, s) = self.start, self.ahead
        return np.asarray(c * (x - x0) + s * (y - y0))

    def outline(self, out: float) -> Contour:
        """The part of the rectangle within `out` mm of the deep edge."""
        (x, y), (c, s) = self.start, self.ahead
        middle = x + c * out / 2, y + s * out / 2
        return contours.rectangle(out, self.width, 0.0, centre=middle, angle=math.atan2(s, c))

    def section(self, z: float) -> Region:
        out = self.at(z)
        return Region((self.outline(out),)) if out > TINY else NOTHING

    def bands(self, out: float) -> Iterator[Contour]:
        yield self.outline(out)

    @cached_property
    def region(self) -> Region:
        """The whole rectangle."""
        return Region((self.outline(self.far),))

    @property
    def reach(self) -> Region:
        return self.region

    def level(self, x: Array, y: Array) -> Array:
        return np.where(within(self.region, x, y), self.level_within(x, y), np.inf if self.up else -np.inf)

    def from_faces(self, x: Array, y: Array, z: Array) -> Array:
        """Outside it the distance from it; within, from its floor, or its walls."""
        above = (z - self.level_within(x, y)) * (1.0 if self.up else -1.0)
        floor = np.abs(above) / np.hypot(1.0, (self.open - self.deep) / self.far)
        beside = signed(self.region, np.stack([x, y], axis=1))
        walls = np.where(above > 0, -beside, np.inf)
        return np.where(beside > 0, np.hypot(beside, np.maximum(-above, 0.0)), np.minimum(floor, walls))

    def across(self, along: Array, x: Array, y: Array) -> Array:
        (x0, y0), (c, s) = self.start, self.ahead
        beside = np.abs(c * (y - y0) - s * (x - x0)) - self.width / 2
        return np.hypot(along, np.maximum(beside, 0.0))

    def turned_over(self, flip: Array, z: float) -> Self:
        x, y, _ = (flip @ [*self.start, 1.0]).tolist()
        c, s = (flip[:2, :2] @ self.ahead).tolist()
        return replace(self, start=(x, y), ahead=(c, s), deep=z - self.deep, open=z - self.open)


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


Removal = Flat | Sloped


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
