"""What a milled part is compared with, as far as the comparison knows it: two sides, a signed distance, places to look at.

Another milled part, or a body of triangles, has no features, only faces."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from mnclab.design.difference.rays import ways
from mnclab.design.model.measures import Measure
from mnclab.design.model.shapes import on_elements, spread
from mnclab.geometry.contours import Contour
from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.milling.raster import Raster
from mnclab.workpiece.part.mesh import Mesh

if TYPE_CHECKING:
    from mnclab.design.difference.deviations import Seen

BLANK = -1  # the owner of a face that no feature made


class Owner(NamedTuple):
    """A feature: the side that it is on, "top" or "back", its name, and how far its faces may be off, mm."""

    side: str
    name: str
    walls: float = 0.0
    floors: float = 0.0


class Grid(NamedTuple):
    """A target at the middles of cells (ny, nx): its lower and its upper side, nan where there is none of it; `owner` is
    whose face the upper side is, `under` whose the lower."""

    floor: Array
    top: Array
    owner: NDArray[np.int16]
    under: NDArray[np.int16]


class Walls(NamedTuple):
    """Places (m, 2) of upright faces, with unit normals (m, 2) away from the material, whose they are (m,), and whether
    they are far from the ends of their element (m,). Each is looked at in one or more heights: `spot` (k,), `z` (k,); `mid` (k,)
    are those in the middle of the tallest piece, by which sizes are measured."""

    place: Array
    normal: Array
    owner: Index
    middle: Mask
    spot: Index
    z: Array
    mid: Mask


class Slopes(NamedTuple):
    """Places (m, 2) of slanting faces and of floors, their heights (m,), how far they are from the base of the slant (m,),
    whose they are (m,), whether they face upwards (m,), and whether they are far from the ends of the slant (m,)."""

    place: Array
    z: Array
    out: Array
    owner: Index
    up: Mask
    middle: Mask


class Target(Protocol):
    """What a comparison asks of a design; another workpiece or a body from a file may answer it as well.

    `name` is what texts call it, `error` how far its own surface may be off, mm. An owner is a number of `owner(…)`, or
    `BLANK`.
    """

    name: str
    error: float

    @property
    def bounds(self) -> Array:
        """The corners with the least and the greatest coordinates (2, 3)."""

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Lower and upper side at points (m,), nan beside it."""

    def cut(self, plane: str, at: float) -> list[Contour]:
        """A section, as of a workpiece."""

    def grid(self, raster: Raster) -> Grid:
        """Both sides at the middles of cells."""

    def distance(self, points: Array) -> Array:
        """Signed distances (m,) of points (m, 3), negative in its material."""

    def walls(self, spacing: float) -> Walls:
        """Places on its upright faces, about so many mm apart."""

    def slopes(self, spacing: float, step: float) -> Slopes:
        """Places on its slanting faces, and on floors that are small beside a cell of `step` mm."""

    def owners(self, points: Array, off: Array) -> Index:
        """Whose faces are the nearest (m,) to points (m, 3) at distances `off` (m,)."""

    def owner(self, number: int) -> Owner:
        """The feature that an owner is part of."""

    def readings(self, seen: Seen) -> Iterator[Reading]:
        """What a measuring room reads off what was found on its faces."""


NONE = np.zeros(0, dtype=np.int64)


class Reading(NamedTuple):
    """`side` is "top" or "back". `actual` is nan where nothing could be read, and `said` says why. `allowed` is how far it may
    be off where the drawing gives no limits, mm or degrees. `among` are the places that it was read off: the worst of
    them names the row."""

    side: str
    feature: str
    measure: Measure
    actual: float = math.nan
    allowed: float = 0.0
    among: Index = NONE
    said: str = ""


# Another milled part, or a body of triangles.

FLOORS = 8  # levels between which walls are looked at
SHARE = 1e-3  # of the cells: smaller floors have no walls of their own
FEWEST, EDGE = 3, 1e-3  # places of an element, mm beside its ends
ASIDE = 1e-6  # mm, on either side of a wall
CHORDS = 1e-3  # mm, by which lines of sections may be off
NEAR = 1e-9  # mm: middles of cells that are the same


class BodyTarget(ABC):
    """All of its faces have one owner. The walls are places (m, 2), normals and heights, found by `_upright`."""

    name: str
    error: float
    tolerance: float

    @property
    @abstractmethod
    def bounds(self) -> Array: ...

    @abstractmethod
    def faces(self, x: Array, y: Array) -> tuple[Array, Array]: ...

    @abstractmethod
    def distance(self, points: Array) -> Array: ...

    @abstractmethod
    def cut(self, plane: str, at: float) -> list[Contour]:
        """A section, as of a workpiece."""

    @abstractmethod
    def _upright(self, spacing: float) -> tuple[Array, Array, Array]: ...

    def grid(self, raster: Raster) -> Grid:
        x, y = (each.ravel() for each in np.meshgrid(raster.x, raster.y))
        floor, top = (side.reshape(raster.shape) for side in self.faces(x, y))
        return _grid(floor, top)

    def walls(self, spacing: float) -> Walls:
        place, normal, z = self._upright(spacing)
        floor, top = self.faces(*(place - ASIDE * normal).T)
        its_floor, its_top = self.faces(*(place + ASIDE * normal).T)
        with np.errstate(invalid="ignore"):
            stands, beside = (floor < z) & (z < top), (its_floor < z) & (z < its_top)
        on = stands & ~beside
        count = int(on.sum())
        every, yes = np.arange(count), np.ones(count, dtype=bool)
        return Walls(place[on], normal[on], np.full(count, BLANK), yes, every, z[on], yes)

    def slopes(self, spacing: float, step: float) -> Slopes:
        none, no = np.zeros(0), np.zeros(0, dtype=bool)
        return Slopes(np.zeros((0, 2)), none, none, np.zeros(0, dtype=np.int64), no, no)

    def owners(self, points: Array, off: Array) -> Index:
        return np.full(len(points), BLANK)

    def owner(self, number: int) -> Owner:
        return Owner("", self.name)

    def readings(self, seen: Seen) -> Iterator[Reading]:
        """How far its faces are off at the worst."""
        every = np.arange(len(seen.off))
        worst = float(seen.off[np.abs(seen.off).argmax()]) if len(every) else 0.0
        yield Reading("", self.name, Measure("form", 0.0, "form"), worst, self.tolerance, every)


class PartTarget(BodyTarget):
    """Another milled part, moved by `shift` (3,) mm. Beside its edges distances are those from its faces, prolonged."""

    def __init__(self, part: Milled, shift: Array, step: float, tolerance: float) -> None:
        self.part, self.shift, self.step, self.tolerance = part, shift, step, tolerance
        self.name, self.error = "the other workpiece", part.error
        self._touched = part.part

    @property
    def bounds(self) -> Array:
        return self.part.bounds + self.shift

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        floor, top = self.part.faces(x - self.shift[0], y - self.shift[1])
        return floor + self.shift[2], top + self.shift[2]

    def grid(self, raster: Raster) -> Grid:
        part = self.part
        alike = part.heights.shape == raster.shape and all(
            np.abs(a + shift - b).max() <= NEAR for a, b, shift in zip((part.x, part.y), (raster.x, raster.y), self.shift)
        )
        if not alike:
            return super().grid(raster)
        solid = part.heights > part.floor
        floor, top = (np.where(solid, side, np.nan) + self.shift[2] for side in (part.floor, part.heights))
        return _grid(floor, top)

    def distance(self, points: Array) -> Array:
        return np.asarray(self._touched(points - self.shift))

    def cut(self, plane: str, at: float) -> list[Contour]:
        axis = {"XY": 2, "XZ": 1, "YZ": 0}[plane]
        right, up = (k for k in range(3) if k != axis)
        move = np.array([[1.0, 0, self.shift[right]], [0, 1, self.shift[up]], [0, 0, 1]])
        return [each.transformed(move) for each in self.part.cut(plane, at - float(self.shift[axis]))]

    def _upright(self, spacing: float) -> tuple[Array, Array, Array]:
        """Along sections between its floors, of which the largest count."""
        heights = np.concatenate([self.part.heights.ravel(), self.part.floor.ravel()]).round(6)
        levels, count = np.unique(heights, return_counts=True)
        most = np.argsort(-count, kind="stable")[:FLOORS]
        levels = np.sort(levels[most[count[most] >= SHARE * self.part.heights.size]])
        found = [(np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0))]
        for z in (levels[1:] + levels[:-1]) / 2:
            for loop in self.part.cut("XY", float(z)):
                _, place, aside = on_elements(loop, *spread(loop, spacing, FEWEST, aside=EDGE))
                found.append((place + self.shift[:2], -aside, np.full(len(place), z + self.shift[2])))
        place, normal, height = (np.concatenate(column) for column in zip(*found))
        inside = place - self.shift[:2] - CHORDS * normal  # sections are chords: the wall itself is looked for
        way, _ = ways(self.part, inside, normal, height - self.shift[2], np.ones(len(place), dtype=bool), 2 * CHORDS)
        met = np.isfinite(way)
        return place[met] + (way[met] - CHORDS)[:, None] * normal[met], normal[met], height[met]


class MeshTarget(BodyTarget):
    """A body of triangles, in the coordinates of the path."""

    def __init__(self, mesh: Mesh, tolerance: float) -> None:
        self.mesh, self.tolerance = mesh, tolerance
        self.name, self.error = mesh.name, mesh.error

    @property
    def bounds(self) -> Array:
        return self.mesh.bounds

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        return self.mesh.faces(x, y)

    def distance(self, points: Array) -> Array:
        return self.mesh.distance(points)

    def cut(self, plane: str, at: float) -> list[Contour]:
        return self.mesh.cut(plane, at)

    def _upright(self, spacing: float) -> tuple[Array, Array, Array]:
        return self.mesh.upright(spacing)


def _grid(floor: Array, top: Array) -> Grid:
    owner = np.full(top.shape, BLANK, dtype=np.int16)
    return Grid(floor, top, owner, owner)
