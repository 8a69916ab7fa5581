"""The lower side of a mill, and the rows of a path as moves of it: straight ones and arcs about Z, in the order of the rows.

Arcs in other planes, and arcs whose ends do not lie on one circle, become chords within `CHORD` mm.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from mnclab.geometry.curves import counted
from mnclab.path.places import points
from mnclab.path.tool import POINTED, Tool
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath
from mnclab.workpiece.cutting import Cutting

# The lower side of a mill, turned about its axis: a flat disc, then a round corner or a cone, up to its radius.
#
# The height of the edge above the tip at a distance rho from the axis is 0 up to `flat`, from there
# `corner - sqrt(corner² - (rho - flat)²)` or `slope (rho - flat)`. A ball has `flat` 0, a drill its point's slope.

class Cutter(NamedTuple):
    """Lengths in mm; `slope` is the rise of the cone for each mm outwards."""

    radius: float
    flat: float
    corner: float = 0.0
    slope: float = 0.0


def cutter_of(tool: Tool) -> Cutter:
    """The lower side of a tool as its table gives it; one without radius has none."""
    radius = max(tool.effective_radius, 0.0)
    if tool.kind in POINTED:
        half = math.radians(min(tool.angle or POINTED[tool.kind], 180.0)) / 2
        return Cutter(radius, 0.0, 0.0, max(math.cos(half) / math.sin(half), 0.0))
    corner = min(tool.corner, radius)
    return Cutter(radius, radius - corner, corner)


def edge_height(rho: Array, flat: Array | float, corner: Array | float, slope: Array | float) -> Array:
    """Height of the edge above the tip at distances from the axis; all of them broadcast."""
    out = np.maximum(rho - flat, 0.0)
    return np.asarray(corner - np.sqrt(np.maximum(corner * corner - out * out, 0.0)) + slope * out)


CHORD = 1e-4  # mm, of arcs that are not about Z
ROUND = 1e-6  # mm, by which both ends of an arc may miss its circle
STILL = 1e-12  # mm, below which a move does not go on in the plane


@dataclass(frozen=True, eq=False)
class Moves:
    """k moves: `start` and `end` (k, 3) of the tip, `row` (k,) of the path, ascending.

    Of arcs (`arc`) `centre` (k, 2) in the plane and `sweep` (k,) rad. `radius`, `flat`, `corner`, `slope` (k,) are those
    of the `Cutter`.
    """

    row: Index
    start: Array
    end: Array
    arc: Mask
    centre: Array
    sweep: Array
    radius: Array
    flat: Array
    corner: Array
    slope: Array

    def __len__(self) -> int:
        return len(self.row)

    def __getitem__(self, which: Index | Mask | slice) -> Moves:
        if isinstance(which, np.ndarray) and which.dtype == bool:
            which = np.flatnonzero(which)  # once, and not again for every column
        taken = isinstance(which, np.ndarray)  # of rows of three numbers much faster
        columns = vars(self).items()
        return Moves(**{name: column.take(which, 0) if taken and column.ndim > 1 else column[which] for name, column in columns})

    def with_cutter(self, cutters: Array, lift: Array | float = 0.0) -> Moves:
        """The same moves of other cutters (k, 4), as `Cutter` has its fields, `lift` mm (k,) above the tip."""
        radius, flat, corner, slope = np.broadcast_to(cutters, (len(self), 4)).T
        start, end = self.start, self.end
        if np.any(lift):
            up = np.zeros((len(self), 3))
            up[:, 2] = lift
            start, end = start + up, end + up
        return replace(self, start=start, end=end, radius=radius, flat=flat, corner=corner, slope=slope)

    @property
    def chords(self) -> bool:
        """Whether some of them are chords of an arc."""
        return len(self.row) > 1 and bool((np.diff(self.row) == 0).any())

    @property
    def shape(self) -> tuple[Array, Array, Array, Array]:
        """The columns of the cutters: radius, flat, corner, slope, each (k,)."""
        return self.radius, self.flat, self.corner, self.slope

    def by_cutter(self, which: Index) -> list[tuple[Cutter, Index]]:
        """Some moves by the shape of their cutters."""
        columns = [column[which] for column in self.shape]
        if len(which) and all((column == column[0]).all() for column in columns):
            return [(Cutter(*(float(column[0]) for column in columns)), which)]
        shapes, shape = np.unique(np.stack(columns, axis=1), axis=0, return_inverse=True)
        return [(Cutter(*each), which[shape.reshape(-1) == k]) for k, each in enumerate(shapes.tolist())]

    @property
    def ways(self) -> Array:
        """How far each move goes in the plane (k,), mm."""
        way = self.end - self.start
        flat = np.hypot(way[:, 0], way[:, 1])
        if self.arc.any():
            spoke = self.start[self.arc, :2] - self.centre[self.arc]
            flat[self.arc] = np.hypot(spoke[:, 0], spoke[:, 1]) * np.abs(self.sweep[self.arc])
        return flat

    def tips(self, which: Index, share: Array) -> Array:
        """Where the tips of moves `which` (m,) are (m, 3) after shares (m,) of their ways."""
        places = self.start[which] + (self.end - self.start)[which] * share[:, None]
        on = self.arc[which]
        if on.any():
            arc = which[on]
            spoke, angle = self.start[arc, :2] - self.centre[arc], self.sweep[arc] * share[on]
            cos, sin = np.cos(angle), np.sin(angle)
            places[on, 0] = self.centre[arc, 0] + spoke[:, 0] * cos - spoke[:, 1] * sin
            places[on, 1] = self.centre[arc, 1] + spoke[:, 0] * sin + spoke[:, 1] * cos
        return np.asarray(places)

    @property
    def low(self) -> Array:
        """The lowest place of each tip (k,)."""
        return np.minimum(self.start[:, 2], self.end[:, 2])

    @property
    def boxes(self) -> Array:
        """What each move reaches in the plane (k, 4): least x, least y, greatest x, greatest y."""
        low = np.minimum(self.start[:, :2], self.end[:, :2])
        high = np.maximum(self.start[:, :2], self.end[:, :2])
        if self.arc.any():
            centre, spoke = self.centre[self.arc], self.start[self.arc, :2] - self.centre[self.arc]
            round_ = np.hypot(spoke[:, 0], spoke[:, 1])[:, None]
            low[self.arc], high[self.arc] = centre - round_, centre + round_
        wide = self.radius[:, None]
        return np.concatenate([low - wide, high + wide], axis=1)


def moves_of(cutting: Cutting, rows: Mask | None = None, chord: float = CHORD) -> Moves:
    """The moves of the rows that cut, or of other ones; a tilted tool has none. `chord` mm: see `CHORD`."""
    path = cutting.path
    chosen = cutting.cuts if rows is None else rows
    if cutting.tilted is not None:
        chosen = chosen & ~cutting.tilted
    cutters = np.array([cutter_of(tool) for tool in cutting.tools], dtype=np.float64).reshape(-1, len(Cutter._fields))
    index = np.flatnonzero(chosen)
    arc = path.kind[index] == Kind.ARC
    bent = arc.copy()
    bent[arc] = ~_about_z(path, index[arc])
    row, start, end = _plain(path, index[~bent])
    if bent.any():
        pieces = [(row, start, end), *(_chords(path, int(row), chord) for row in index[bent])]
        row, start, end = (np.concatenate(column) for column in zip(*pieces, strict=True))
        order = np.argsort(row, kind="stable")
        row, start, end = row[order], start[order], end[order]
    unknown = cutting.from_home[row]
    start[unknown] = end[unknown]
    known = np.zeros(len(path), dtype=bool)
    known[index[arc & ~bent]] = True
    known &= ~cutting.from_home
    arcs = known[row]
    centre = np.where(arcs[:, None], path.centre[row, :2], 0.0)
    sweep = np.where(arcs, path.sweep[row] * np.sign(path.axis[row, 2]), 0.0)
    radius, flat, corner, slope = cutters[cutting.which[row]].T.copy()
    return Moves(row, start, end, arcs, centre, sweep, radius, flat, corner, slope)


def joined(pieces: Sequence[Moves]) -> Moves:
    """Moves one after the other."""
    return Moves(**{name: np.concatenate([getattr(each, name) for each in pieces]) for name in vars(pieces[0])})


def _about_z(path: Toolpath, rows: Index) -> Mask:
    """Which arcs turn about Z on a true circle."""
    centre = path.centre[rows, :2]
    one, other = (np.hypot(*(ends[rows, :2] - centre).T) for ends in (path.start, path.end))
    upright = np.abs(path.axis[rows, 2]) > 1 - 1e-12
    return np.asarray(upright & (np.abs(one - other) <= ROUND))


def _plain(path: Toolpath, rows: Index) -> tuple[Index, Array, Array]:
    return rows, path.start[rows], path.end[rows]


def _chords(path: Toolpath, row: int, chord: float) -> tuple[Index, Array, Array]:
    places = points(path[row : row + 1], chord)[0]
    return np.full(len(places) - 1, row), places[:-1], places[1:]


# Moves cut up into equal pieces, so that a later piece finds what an earlier one has left.

def cut_up(moves: Moves, pieces: Index) -> Moves:
    """Each of k moves in so many pieces (k,)."""
    owner, rank = counted(pieces)
    count = pieces[owner]
    share = rank / count
    found = moves[owner]
    start, end = moves.tips(owner, share), moves.tips(owner, share + 1 / count)
    last = share + 1 / count > 1 - 1e-12
    end[last] = found.end[last]
    return Moves(**{**vars(found), "start": start, "end": end, "sweep": found.sweep / count})
