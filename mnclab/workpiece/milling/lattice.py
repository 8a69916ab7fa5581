"""The top of a milled part over a lattice of nodes, and where it falls off between two of them: the walls."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.path.toolpath import Array, Index, Mask

if TYPE_CHECKING:
    from mnclab.workpiece.milling.milled import Milled


# A cell of a lattice divided by the walls that cross it: a table of triangles for every case.
#           e2              corners c0 … c3 and edges e0 … e3 run counter-clockwise, edge k from corner k on;
#       c3 ---- c2          a wall on edge k has two local vertices: 4 + 2k on the side of corner k,
#     e3 |      | e1        5 + 2k on the side of the next corner.
#       c0 ---- c1
#           e0
# Two walls divide a cell in two, and between the two stands the wall itself; four cut off two opposite corners. A
# wall that does not divide its cell is an upright edge of its outline, so that neighbouring cells always meet.

class Triangles(NamedTuple):
    """Local vertices (t, 3), and two corners for each (t, 2): where both are one, that of the piece, else those on both
    sides of the wall that the triangle is a piece of."""

    corners: NDArray[np.int64]
    beside: NDArray[np.int64]


@cache
def divided(walls: int, dividing: int, diagonal: int) -> Triangles:
    """The triangles of a cell: `walls` and `dividing` have a bit for each edge; `diagonal` 0 or 1 is the corner that stays
    joined to the opposite one where all four edges divide."""
    parts = [k for k in range(4) if dividing >> k & 1]
    pieces: list[tuple[list[int], int, int]] = []
    if not parts:
        pieces.append((_outline(walls, 0, 3), 0, 0))
    elif len(parts) == 2:
        p, q = parts
        pieces.append(([5 + 2 * p, *_inside(walls, p + 1, q), 4 + 2 * q], p + 1, p + 1))
        pieces.append(([5 + 2 * q, *_inside(walls, q + 1, p + 4), 4 + 2 * p], p, p))
        pieces.append(([4 + 2 * p, 5 + 2 * p, 4 + 2 * q, 5 + 2 * q], p, p + 1))
    else:
        d = diagonal
        pieces.append(([d, 4 + 2 * d, 7 + 2 * d, d + 2, 8 + 2 * d, 5 + 2 * ((d + 3) % 4)], d, d))
        for c in (d + 1, (d + 3) % 4):
            before = (c - 1) % 4
            pieces.append(([5 + 2 * before, c, 4 + 2 * c], c, c))
            pieces.append(([4 + 2 * before, 5 + 2 * before, 4 + 2 * c, 5 + 2 * c], before, c))
    fans = [((poly[0], a, b), one, other) for poly, one, other in pieces for a, b in zip(poly[1:], poly[2:])]
    beside = [(one % 4, other % 4) for _, one, other in fans]
    return Triangles(np.array([fan for fan, _, _ in fans]), np.array(beside))


def _outline(walls: int, first: int, last: int) -> list[int]:
    """Corners from one to another, each with the wall on the edge behind it."""
    found = []
    for corner in range(first, last + 1):
        k = corner % 4
        found += [k, 4 + 2 * k, 5 + 2 * k] if walls >> k & 1 else [k]
    return found


def _inside(walls: int, first: int, last: int) -> list[int]:
    """The same without what is on the edge behind the last one."""
    return [*_outline(walls, first, last - 1), last % 4]


# A raster alone makes stairs of a round wall. Between two neighbouring nodes whose heights differ steeply the wall is
# found by halving with the exact sweep, and a wall point stands there, once for the height on either side of it. The lower
# side, where it is one that was cut before, is a lattice of the same nodes seen from below.

STEEP = 0.5  # rise between two nodes, of their distance, from which a wall is looked for
SUDDEN = 0.25  # of that rise: what is left of it between the last halves when it is a wall, and no steep slope
HALVINGS = 14
THIN = 1e-9  # mm, of material that is none


@dataclass(frozen=True, eq=False)
class Lattice:
    """Nodes `x` (nx + 1,), `y` (ny + 1,) over the box of the blank; `z`, `floor` (nodes,) row by row, mm.

    `edges` (e, 2) are neighbouring nodes: first all to the right, then all upwards. Of the edges with a wall (`wall` is
    the number of it, -1 for none) `place` (w, 2) says where it stands and `sides` (w, 2) how high the material is before
    and behind it; `through` (w,) that there is none on one side.
    """

    x: Array
    y: Array
    z: Array
    floor: Array
    edges: Index
    wall: Index
    place: Array
    sides: Array
    through: Mask

    @property
    def solid(self) -> Mask:
        """Nodes with material (nodes,)."""
        return np.asarray(self.z - self.floor > THIN)

    @property
    def nodes(self) -> Array:
        """Their places (nodes, 2)."""
        y, x = np.meshgrid(self.y, self.x, indexing="ij")
        return np.stack([x.ravel(), y.ravel()], axis=1)


    def cells(self) -> tuple[Index, Index]:
        """Corners (cells, 4) and edges (cells, 4) of every cell, counter-clockwise from its lower left corner."""
        ny, nx = len(self.y) - 1, len(self.x) - 1
        j, i = (each.ravel() for each in np.meshgrid(np.arange(ny), np.arange(nx), indexing="ij"))
        node, flat, up = j * (nx + 1) + i, j * nx + i, (ny + 1) * nx + j * (nx + 1) + i
        corners = np.stack([node, node + 1, node + nx + 2, node + nx + 1], axis=1)
        return corners, np.stack([flat, up + 1, flat + nx, up], axis=1)

    def dividing(self, corners: Index, wall: Index) -> tuple[Index, Index, Index]:
        """Of cells with the walls (k, 4) on their edges: which edges have one, which of those divide the cell (bits), and
        the corner, 0 or 1, that stays joined to the opposite one where all four do."""
        bits = 1 << np.arange(4)
        walls = ((wall >= 0) * bits).sum(axis=1)
        if not len(self.place):
            return walls, walls, walls
        through = (wall >= 0) & self.through[wall]
        jump = np.where(wall >= 0, np.abs(self.sides[wall, 0] - self.sides[wall, 1]), -1.0)
        count = (wall >= 0).sum(axis=1)
        least = np.argsort(jump, axis=1)[:, 1]  # of three, the smallest does not divide
        dividing = np.where(count == 1, 0, walls)
        dividing = np.where(count == 3, walls & ~(1 << least), dividing)
        full, z = self.solid[corners], self.z[corners]
        dividing = np.where(~full.all(axis=1), (through * bits).sum(axis=1), dividing)
        other = np.where(full.all(axis=1), np.abs(z[:, 0] - z[:, 2]) > np.abs(z[:, 1] - z[:, 3]), full[:, 0])
        return walls, dividing, other.astype(np.int64)  # what is open stays joined, from above and from below

    def crests(self) -> tuple[Array, Array]:
        """The walls from above: lines (k, 2, 2), mm, and how high the wall is there (k,)."""
        corners, edges = self.cells()
        wall = self.wall[edges]
        some = (wall >= 0).any(axis=1)
        wall = wall[some]
        _, dividing, diagonal = self.dividing(corners[some], wall)
        pairs = []
        for a in range(4):
            for b in range(a + 1, 4):
                alone = dividing == (1 << a) + (1 << b)
                corner = b if b - a == 1 else 0 if (a, b) == (0, 3) else -1  # that both edges meet at
                cut_off = (dividing == 15) & (corner >= 0) & (corner % 2 != diagonal)
                pairs.append(wall[alone | cut_off][:, [a, b]])
        chosen = np.concatenate(pairs)
        if not len(chosen):
            return np.empty((0, 2, 2)), np.empty(0)
        return self.place[chosen], np.abs(self.sides[chosen, 0] - self.sides[chosen, 1]).max(axis=1)


Sides = Callable[[Array, Array], tuple[Array, Array]]  # a side of the material at points (m,), and the one behind it


def lattice_of(workpiece: Milled, step: float | None = None) -> Lattice:
    """The lattice of a milled part, as fine as its map, or of about `step` mm."""
    (x0, y0), (x1, y1) = workpiece.cutting.stock.bounds[:, :2].tolist()
    step = workpiece.step if step is None else step
    rows, columns = (max(int(np.ceil((high - low) / step - 1e-9)), 1) for low, high in ((y0, y1), (x0, x1)))
    x, y = np.linspace(x0, x1, columns + 1), np.linspace(y0, y1, rows + 1)
    py, px = (each.ravel() for each in np.meshgrid(y, x, indexing="ij"))
    z, floor = workpiece.surface.sides_at(px, py)
    number = np.arange(len(px)).reshape(rows + 1, columns + 1)
    right = np.stack([number[:, :-1].ravel(), number[:, 1:].ravel()], axis=1)
    up = np.stack([number[:-1].ravel(), number[1:].ravel()], axis=1)
    return _walled(workpiece.surface.sides_at, x, y, z, floor, np.concatenate([right, up]))


def from_below(workpiece: Milled, found: Lattice) -> Lattice:
    """The lower side of a part over the nodes of its lattice, turned upside down: `z` and `floor` are negative."""

    def sides(x: Array, y: Array) -> tuple[Array, Array]:
        top, floor = workpiece.surface.sides_at(x, y)
        return -floor, -top

    return _walled(sides, found.x, found.y, -found.floor, -found.z, found.edges)


def _walled(at: Sides, x: Array, y: Array, z: Array, floor: Array, edges: Index) -> Lattice:
    """A lattice of nodes with the walls between them."""
    solid = z - floor > THIN
    first, last = edges.T
    nodes = np.stack([each.ravel() for each in np.meshgrid(x, y)], axis=1)
    long = np.abs(nodes[first] - nodes[last]).sum(axis=1)
    through = solid[first] != solid[last]
    some = np.flatnonzero(through | (solid[first] & solid[last] & (np.abs(z[first] - z[last]) > STEEP * long)))
    through = through[some]
    ends = np.stack([nodes[first[some]], nodes[last[some]]])
    heights = np.stack([z[first[some]], z[last[some]]])
    rise = np.abs(heights[0] - heights[1])
    full = np.stack([solid[first[some]], solid[last[some]]])
    for _ in range(HALVINGS):
        middle = ends.mean(axis=0)
        here, behind_it = at(middle[:, 0], middle[:, 1])
        there = here - behind_it > THIN
        behind = np.where(through, there != full[0], np.abs(heights[0] - here) >= np.abs(here - heights[1]))
        for end, moves in ((1, behind), (0, ~behind)):
            ends[end][moves], heights[end][moves], full[end][moves] = middle[moves], here[moves], there[moves]
    stands = through | (np.abs(heights[0] - heights[1]) > SUDDEN * rise)
    wall = np.full(len(edges), -1, dtype=np.int64)
    wall[some[stands]] = np.arange(int(stands.sum()))
    return Lattice(x, y, z, floor, edges, wall, ends.mean(axis=0)[stands], heights.T[stands], through[stands])


def rows_at(workpiece: Milled, x: Array, y: Array, z: Array) -> Index:
    """The rows (m,) that cut points last: each that of the cell around it whose height is nearest to `z`."""
    heights, cut_by, step = workpiece.heights, workpiece.cut_by, workpiece.step
    best, found = np.full(len(x), np.inf), np.full(len(x), -1, dtype=np.int64)
    for dx, dy in ((0.5, 0.5), (-0.5, 0.5), (0.5, -0.5), (-0.5, -0.5)):
        i = np.clip(np.round((x - workpiece.x[0]) / step + dx * 0.98), 0, heights.shape[1] - 1).astype(np.int64)
        j = np.clip(np.round((y - workpiece.y[0]) / step + dy * 0.98), 0, heights.shape[0] - 1).astype(np.int64)
        off = np.abs(heights[j, i] - z)
        nearer = off < best - THIN
        best[nearer], found[nearer] = off[nearer], cut_by[j, i][nearer]
    return found
