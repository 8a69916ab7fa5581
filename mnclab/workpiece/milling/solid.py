"""A milled part as a closed surface: the top with its walls upright, the sides and the lower side of the blank.

The lattice of nodes is one sheet above and one below; both are joined at the rim of the blank and where something goes
through. Cells that lie in one plane and were cut by one row are taken together in squares, each a fan about its middle
that meets every node of its neighbours, so that the surface is closed without a gap.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.columns import Array, Index, Mask
from mnclab.workpiece.milling.divided import divided
from mnclab.workpiece.milling.lattice import Lattice, lattice_of, rows_at
from mnclab.workpiece.workpiece import Solid

if TYPE_CHECKING:
    from mnclab.workpiece.milling.milled import Milled

LARGEST = 6  # times that cells are taken together by twos
SAME = 1e-9  # mm, of heights in one plane

Faces = tuple[Index, Index]  # triangles (t, 3) and their rows (t,)


def solid_of(workpiece: Milled) -> Solid:
    """The closed surface of a milled part."""
    found = lattice_of(workpiece)
    n, w = len(found.z), len(found.place)
    beside = np.stack([n + 2 * np.arange(w), n + 2 * np.arange(w) + 1], axis=1)  # vertices of walls, before and behind
    below = n + 2 * w  # where the lower side begins: nodes, then places of walls
    foot = below + n + np.arange(w)
    first, last = found.edges[found.wall >= 0].T
    solid = found.solid
    for side, node in ((0, first), (1, last)):
        empty = found.through & ~solid[node]
        beside[empty, side] = foot[empty]
    row_of = rows_at(workpiece, found.nodes[:, 0], found.nodes[:, 1], found.z)
    faces = [_top(found, beside, row_of), _bottom(found, foot, below), _rim(found, beside, foot, below)]
    triangles, row = (np.concatenate(column) for column in zip(*faces))
    points = _points(found)
    used, index = np.unique(triangles, return_inverse=True)
    return Solid(points[used], index.reshape(-1, 3), row)


def _points(found: Lattice) -> Array:
    nodes, place = found.nodes, found.place
    first, last = found.edges[found.wall >= 0].T
    foot = np.where(found.solid[first], found.floor[first], found.floor[last])
    return np.concatenate([
        np.column_stack([nodes, found.z]),
        np.column_stack([np.repeat(place, 2, axis=0), found.sides.ravel()]),
        np.column_stack([nodes, found.floor]),
        np.column_stack([place, foot]),
    ])  # fmt: skip


def _divided(
    corners: Index, sides: Index, walls: Index, dividing: Index, diagonal: Index
) -> tuple[Index, Index, Index]:
    """Triangles of cells by the table, and the nodes on both sides of each; `sides` (cells, 4, 2): vertices of walls."""
    local = np.concatenate([corners, sides.reshape(-1, 8)], axis=1)
    key = walls + 16 * dividing + 256 * diagonal
    none = np.empty(0, dtype=np.int64)
    pieces = [(none.reshape(0, 3), none, none)]
    for each in np.unique(key).tolist():
        cells = np.flatnonzero(key == each)
        table = divided(each % 16, each // 16 % 16, each // 256)
        one, other = (corners[cells][:, table.beside[:, k]].ravel() for k in (0, 1))
        pieces.append((local[cells][:, table.corners].reshape(-1, 3), one, other))
    triangles, one, other = (np.concatenate(column) for column in zip(*pieces))
    return triangles, one, other


def _sides(wall: Index, beside: Index) -> Index:
    """Vertices of the walls on the edges of cells (cells, 4, 2) in the sense of the cell: two edges run the other way."""
    if not len(beside):
        return np.full((*wall.shape, 2), -1)
    found = beside[wall]
    found[:, 2:] = found[:, 2:, ::-1]
    return found


def _top(found: Lattice, beside: Index, row_of: Index) -> Faces:
    corners, edges = found.cells()
    wall = found.wall[edges]
    plain = (wall < 0).all(axis=1)
    solid = found.solid[corners]
    triangles, row = _sheet(found, found.z, corners, np.asarray(plain & solid.all(axis=1)), row_of)
    some = ~plain
    cases = found.dividing(corners[some], wall[some])
    cut, one, other = _divided(corners[some], _sides(wall[some], beside), *cases)
    kept = (one != other) | found.solid[one]
    cut, one, other = cut[kept], one[kept], other[kept]
    lower = np.where(found.z[one] <= found.z[other], one, other)
    return np.concatenate([triangles, cut]), np.concatenate([row, row_of[lower]])


def _bottom(found: Lattice, foot: Index, below: int) -> Faces:
    """The lower side, divided only where something goes through; seen from below."""
    corners, edges = found.cells()
    wall = found.wall[edges]
    some = ((wall >= 0) & found.through[wall]).any(axis=1) if len(foot) else np.zeros(len(wall), dtype=bool)
    full = found.solid[corners].all(axis=1)
    triangles, _ = _sheet(found, found.floor, corners, np.asarray(~some & full), np.full(len(found.z), -1))
    _, dividing, diagonal = found.dividing(corners[some], wall[some])
    sides = np.repeat(foot[wall[some]][:, :, None], 2, axis=2) - below if len(foot) else np.empty((0, 4, 2), int)
    cut, one, other = _divided(corners[some], sides, dividing, dividing, diagonal)
    cut = cut[(one == other) & found.solid[one]]
    every = np.concatenate([triangles, cut])[:, ::-1] + below
    return every, np.full(len(every), -1)


def _sheet(found: Lattice, z: Array, corners: Index, which: Mask, row: Index) -> Faces:
    """Cells without a wall as triangles, those in one plane and of one row taken together."""
    ny, nx = len(found.y) - 1, len(found.x) - 1
    blocks = _blocks(z.reshape(ny + 1, nx + 1), which.reshape(ny, nx), row.reshape(ny + 1, nx + 1))
    used = np.zeros((ny + 1, nx + 1), dtype=bool)
    used[[0, -1]] = used[:, [0, -1]] = True
    covered = np.zeros((ny, nx), dtype=bool)
    for size, j, i in blocks:
        for dj, di in ((0, 0), (0, size), (size, 0), (size, size)):
            used[j + dj, i + di] = True
        inside = np.arange(size)
        covered[j[:, None, None] + inside[:, None], i[:, None, None] + inside] = True
    for dj, di in ((0, 0), (0, 1), (1, 0), (1, 1)):
        used[dj : ny + dj, di : nx + di] |= ~covered
    single = corners[which & ~covered.ravel()]
    flat = np.abs(z[single[:, 0]] - z[single[:, 2]]) <= np.abs(z[single[:, 1]] - z[single[:, 3]])
    turned = np.where(flat[:, None], single, np.roll(single, -1, axis=1))  # along the diagonal that is less steep
    pieces = [np.concatenate([turned[:, [0, 1, 2]], turned[:, [0, 2, 3]]])]
    pieces += [_fans(size, j, i, used) for size, j, i in blocks]
    triangles = np.concatenate(pieces)
    return triangles, row[triangles[:, 0]]


def _blocks(z: Array, which: Mask, row: Index) -> list[tuple[int, Index, Index]]:
    """Squares of cells in one plane: their side in cells and the lower left corners of all of that side."""
    east, north = z[:-1, 1:] - z[:-1, :-1], z[1:, :-1] - z[:-1, :-1]
    plane = which & (np.abs(z[1:, 1:] - z[1:, :-1] - east) < SAME)
    for other in (row[:-1, 1:], row[1:, :-1], row[1:, 1:]):
        plane &= other == row[:-1, :-1]
    cut = row[:-1, :-1]
    levels = []
    for _ in range(LARGEST):
        ny, nx = plane.shape[0] // 2 * 2, plane.shape[1] // 2 * 2
        quarters = [(slice(a, ny, 2), slice(b, nx, 2)) for a in (0, 1) for b in (0, 1)]
        first = quarters[0]
        joined = plane[first].copy()
        for each in quarters[1:]:
            joined &= plane[each] & (np.abs(east[each] - east[first]) < SAME) & (cut[each] == cut[first])
            joined &= np.abs(north[each] - north[first]) < SAME
        levels.append(joined)
        plane, east, north, cut = joined, east[first], north[first], cut[first]
        if not joined.any():
            break
    found = []
    for k, joined in enumerate(levels):
        leaf = joined.copy()
        if k + 1 < len(levels):
            above = np.kron(levels[k + 1], np.ones((2, 2), dtype=bool))
            leaf[: above.shape[0], : above.shape[1]] &= ~above
        j, i = np.nonzero(leaf)
        found.append((2 << k, j * (2 << k), i * (2 << k)))
    return found


def _fans(size: int, j: Index, i: Index, used: Mask) -> Index:
    """Squares as fans about their middles, over every node on their outlines that is used."""
    go, stay = np.arange(size), np.zeros(size, dtype=np.int64)
    dj = np.concatenate([stay, go, stay + size, size - go])
    di = np.concatenate([go, stay + size, size - go, stay])
    rows, columns = j[:, None] + dj, i[:, None] + di
    square, place = np.nonzero(used[rows, columns])
    number = (rows * used.shape[1] + columns)[square, place]
    begins = np.searchsorted(square, np.arange(len(j)))
    following = np.roll(number, -1)
    last = np.roll(square, -1) != square
    last[-1:] = True
    following[last] = number[begins]
    middle = (j + size // 2) * used.shape[1] + i + size // 2
    return np.stack([middle[square], number, following], axis=1)


def _rim(found: Lattice, beside: Index, foot: Index, below: int) -> Faces:
    """The sides of the blank between the rims of both sheets, counter-clockwise around it."""
    ny, nx = len(found.y) - 1, len(found.x) - 1
    number = np.arange((ny + 1) * (nx + 1)).reshape(ny + 1, nx + 1)
    round_ = np.concatenate([number[0, :-1], number[:-1, -1], number[-1, :0:-1], number[:0:-1, 0]])
    flat, up = np.arange((ny + 1) * nx).reshape(ny + 1, nx), (ny + 1) * nx + np.arange(ny * (nx + 1)).reshape(ny, nx + 1)
    edge = np.concatenate([flat[0], up[:, -1], flat[-1, ::-1], up[::-1, 0]])
    back = np.arange(len(edge)) >= nx + ny  # the edges of the lattice that are passed backwards
    a, b, wall, solid = round_, np.roll(round_, -1), found.wall[edge], found.solid
    plain = (wall < 0) & solid[a] & solid[b]
    pieces = [_quads(a[plain] + below, b[plain] + below, b[plain], a[plain])]
    k = wall[wall >= 0]
    if len(k):
        a, b, back = a[wall >= 0], b[wall >= 0], back[wall >= 0]
        p, q = np.where(back[:, None], beside[k][:, ::-1], beside[k]).T
        hp, hq = np.where(back[:, None], found.sides[k][:, ::-1], found.sides[k]).T
        through, left, f = found.through[k], solid[a], foot[k]
        one, other = through & left, through & ~left
        pieces.append(_quads(a[one] + below, f[one], p[one], a[one]))
        pieces.append(_quads(f[other], b[other] + below, b[other], q[other]))
        down, rise = ~through & (hp > hq), ~through & (hp <= hq)
        for some, lower in ((down, a + below), (rise, b + below)):
            lower = lower[some]
            pieces.append(np.stack([lower, q[some], p[some]], axis=1))
        pieces.append(np.stack([a[down] + below, p[down], a[down]], axis=1))
        pieces.append(_quads(a[down] + below, b[down] + below, b[down], q[down]))
        pieces.append(np.stack([b[rise] + below, b[rise], q[rise]], axis=1))
        pieces.append(_quads(a[rise] + below, b[rise] + below, p[rise], a[rise]))
    triangles = np.concatenate(pieces)
    return triangles, np.full(len(triangles), -1)


def _quads(a: Index, b: Index, c: Index, d: Index) -> Index:
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
