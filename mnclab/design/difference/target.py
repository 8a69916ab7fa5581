"""What a milled part is compared with, as far as the comparison knows it: two sides, a signed distance, places to look at."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from mnclab.design.model.measures import Measure
from mnclab.geometry.contours import Contour
from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.milling.raster import Raster

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
