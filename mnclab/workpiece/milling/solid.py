"""A milled part as a closed surface, and its edges: both sides with their walls upright, and what stands between their rims.

The lattice of nodes is one sheet above and one below, each with the walls of its side; both are joined at the rim of the
blank and where something goes through. Cells that lie in one plane and were cut by one row are taken together in squares,
each a fan about its middle that meets every node of its neighbours, so that the surface is closed without a gap.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.milling.lattice import Lattice, divided, from_below, lattice_of, rows_at
from mnclab.workpiece.milling.sections import straightened
from mnclab.workpiece.part.pictures import zeros_of
from mnclab.workpiece.workpiece import Solid

if TYPE_CHECKING:
    from mnclab.workpiece.milling.milled import Milled

LARGEST = 6  # times that cells are taken together by twos
SAME = 1e-9  # mm, of heights in one plane

Faces = tuple[Index, Index]  # triangles (t, 3) and their rows (t,)


def solid_of(workpiece: Milled, step: float | None = None) -> Solid:
    """The closed surface of a milled part, on a lattice as fine as its map, or of about `step` mm."""
    above = lattice_of(workpiece, step)
    below = from_below(workpiece, above)
    points = [_points(above, 1.0), _points(below, -1.0)]
    upper, lower = np.arange(len(points[0])), len(points[0]) + np.arange(len(points[1]))
    _join(above, below, upper, lower)
    over, row = _sheet_of(above, upper, rows_at(workpiece, above.nodes[:, 0], above.nodes[:, 1], above.z))
    under, _ = _sheet_of(below, lower, np.full(len(below.z), -1))
    every = np.concatenate(points)
    round_ = _rim(above, below, upper, lower, every)
    triangles = np.concatenate([over, under[:, ::-1], round_])
    used, index = np.unique(triangles, return_inverse=True)
    return Solid(every[used], index.reshape(-1, 3), np.concatenate([row, np.full(len(under) + len(round_), -1)]))


BLOCKS, THIN = 120, 1e-4  # cells along the longest side of a hollow part; half of one, mm, in which a side of its box lies


def of_cells(workpiece: Milled) -> Solid:
    """The closed surface of a part with overhangs: heights are exact, and upright walls right within a cell (by pyvista)."""
    sweep, (low, high) = workpiece.sweep, workpiece.bounds
    step = max(workpiece.step, float((high - low).max()) / BLOCKS)
    x, y, z = (_places(a, b, step) for a, b in zip(low.tolist(), high.tolist()))
    px, py = (each.ravel() for each in np.meshgrid(x, y))
    top, floor = workpiece.surface.sides_at(px, py)
    off = np.maximum(z[:, None] - top, floor - z[:, None])  # how far each place is from the material, up or down
    off[:, top - floor <= SAME] = step
    for some, _, lower, upper in sweep.gaps.spans(px, py) if sweep.gaps else ():
        for begin, end in zip(lower, upper):
            off[:, some] = np.maximum(off[:, some], np.minimum(z[:, None] - begin, end - z[:, None]))
    points, faces = zeros_of([x, y, z], np.clip(off, -step, step).ravel())
    a, b, c = points[faces].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    beside = (a + b + c) / 3 + step * normal / np.maximum(np.linalg.norm(normal, axis=1), SAME)[:, None]
    row = rows_at(workpiece, *beside.T) if len(workpiece.moves) else np.full(len(faces), -1)
    row = np.where(beside[:, 2] > replace(sweep, gaps=None).at(*beside[:, :2].T), row, -1)
    row = np.maximum(row, sweep.gaps.rows_at(*beside.T)) if sweep.gaps else row
    return Solid(points, faces, np.where(((beside > low) & (beside < high)).all(axis=1), row, -1))


def _places(a: float, b: float, step: float) -> Array:
    """Nodes about a step apart, whose first cell and last one are so thin that the ends of a box stand in their middles."""
    inner = np.linspace(a, b, max(int(np.ceil((b - a) / step)), 1) + 1)[1:-1]
    return np.concatenate([[a - THIN, a + THIN], inner, [b - THIN, b + THIN]])


def _join(above: Lattice, below: Lattice, upper: Index, lower: Index) -> None:
    """Both sheets share a vertex wherever something goes through: the lower side there. The upper sheet has it on the side
    without material, the lower one on both."""
    edge = np.flatnonzero((above.wall >= 0) & (above.solid[above.edges[:, 0]] != above.solid[above.edges[:, 1]]))
    full = np.where(above.solid[above.edges[edge, 0]], 0, 1)
    n = len(above.z)
    foot = lower[n + 2 * below.wall[edge] + full]
    lower[n + 2 * below.wall[edge] + 1 - full] = foot
    upper[n + 2 * above.wall[edge] + 1 - full] = foot


def _points(found: Lattice, sign: float) -> Array:
    """Nodes, then the walls, once for either side."""
    walls = np.column_stack([np.repeat(found.place, 2, axis=0), sign * found.sides.ravel()])
    return np.concatenate([np.column_stack([found.nodes, sign * found.z]), walls])


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


def _sheet_of(found: Lattice, vertices: Index, row_of: Index) -> Faces:
    """One side of the part, seen from above; `vertices`: those of the nodes, then two of each wall."""
    corners, edges = found.cells()
    wall = found.wall[edges]
    plain = (wall < 0).all(axis=1)
    solid = found.solid[corners]
    triangles, row = _sheet(found, found.z, corners, np.asarray(plain & solid.all(axis=1)), row_of)
    some = ~plain
    cases = found.dividing(corners[some], wall[some])
    beside = len(found.z) + np.arange(2 * len(found.place)).reshape(-1, 2)
    cut, one, other = _divided(corners[some], _sides(wall[some], beside), *cases)
    cut = vertices[cut]
    kept = ((one != other) | found.solid[one]) & (cut != np.roll(cut, 1, axis=1)).all(axis=1)
    cut, one, other = cut[kept], one[kept], other[kept]
    lower = np.where(found.z[one] <= found.z[other], one, other)
    return np.concatenate([vertices[triangles], cut]), np.concatenate([row, row_of[lower]])


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


def _rim(above: Lattice, below: Lattice, upper: Index, lower: Index, points: Array) -> Index:
    """The sides of the blank between the rims of both sheets, counter-clockwise around it."""
    ny, nx = len(above.y) - 1, len(above.x) - 1
    number = np.arange((ny + 1) * (nx + 1)).reshape(ny + 1, nx + 1)
    round_ = np.concatenate([number[0, :-1], number[:-1, -1], number[-1, :0:-1], number[:0:-1, 0]])
    flat, up = np.arange((ny + 1) * nx).reshape(ny + 1, nx), (ny + 1) * nx + np.arange(ny * (nx + 1)).reshape(ny, nx + 1)
    edge = np.concatenate([flat[0], up[:, -1], flat[-1, ::-1], up[::-1, 0]])
    back = np.arange(len(edge)) >= nx + ny  # the edges of the lattice that are passed backwards
    a, b, solid = round_, np.roll(round_, -1), above.solid
    walls = np.stack([above.wall[edge], below.wall[edge]])
    plain = (walls < 0).all(axis=0) & solid[a] & solid[b]
    quads = lower[a[plain]], lower[b[plain]], upper[b[plain]], upper[a[plain]]
    pieces = [np.stack([quads[k] for k in corners], axis=1) for corners in ((0, 1, 2), (0, 2, 3))]
    n = len(above.z)
    for k in np.flatnonzero((walls >= 0).any(axis=0)).tolist():
        chains = []
        for wall, vertices in zip(walls[:, k].tolist(), (upper, lower)):
            here = vertices[n + 2 * wall : n + 2 * wall + 2].tolist() if wall >= 0 else []
            ends = [vertices[[end]].tolist() if solid[end] else [] for end in (a[k], b[k])]
            chains.append([*ends[0], *(here[::-1] if back[k] else here), *ends[1]])
        polygon = list(dict.fromkeys([*chains[1], *chains[0][::-1]]))
        along = np.abs(points[polygon, :2] - above.nodes[a[k]]).sum(axis=1)
        sheet = np.isin(polygon, chains[0])
        found = fewest(sheet, np.stack([along, points[polygon, 2]], axis=1))
        pieces.append(np.array(polygon)[np.array(found, dtype=np.int64).reshape(-1, 3)])
    return np.concatenate(pieces)


def fewest(sheet: Mask, places: Array) -> list[tuple[int, int, int]]:
    """The triangles of a polygon of a few vertices, counter-clockwise at `places` (k, 2), with the fewest diagonals from one
    vertex of a sheet (k,) to another of it, which may be an edge of its own already."""
    n, best = len(sheet), dict[tuple[int, int], tuple[float, list[tuple[int, int, int]]]]()
    for wide in range(1, n):
        for i in range(n - wide):
            j, found = i + wide, [(0.0, list[tuple[int, int, int]]())] if wide == 1 else []
            own = float(wide > 1 and (i, j) != (0, n - 1) and sheet[i] == sheet[j])
            for k in range(i + 1, j):
                one, other = best[i, k], best[k, j]
                bad = 0.0 if _is_free((i, k, j), places) else n
                found.append((one[0] + other[0] + own + bad, [*one[1], *other[1], (i, k, j)]))
            best[i, j] = min(found, key=lambda each: each[0])
    return best[0, n - 1][1]


def _is_free(corners: tuple[int, int, int], places: Array) -> bool:
    """Whether three vertices turn left, with no other one in their triangle."""
    a, b, c = places[list(corners)]
    others = np.delete(places, corners, axis=0)

    def turn(p: Array, q: Array, r: Array) -> Array:
        return np.asarray((q[0] - p[0]) * (r[..., 1] - p[1]) - (q[1] - p[1]) * (r[..., 0] - p[0]))

    if turn(a, b, c) <= 0:
        return False
    return not ((turn(a, b, others) >= 0) & (turn(b, c, others) >= 0) & (turn(c, a, others) >= 0)).any()


# The edges of a body: lines where two of its faces meet at an angle.

SHARP = np.cos(np.radians(25.0))  # of the angle between two faces from which on their edge is one
STRAIGHT = 0.02  # mm, within which a line is straight


def creases(solid: Solid) -> list[Array]:
    """Lines (k, 3), mm; those that go round end where they begin."""
    a, b, c = solid.points[solid.triangles].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    sides = np.concatenate([solid.triangles[:, [i, j]] for i, j in ((0, 1), (1, 2), (2, 0))])
    face = np.tile(np.arange(len(solid.triangles)), 3)
    order = np.lexsort(np.sort(sides, axis=1).T)
    one, other = face[order[::2]], face[order[1::2]]  # every edge is one of two triangles
    sharp = (normal[one] * normal[other]).sum(axis=1) < SHARP
    return [straightened(solid.points[line], STRAIGHT) for line in _lines(np.sort(sides[order[::2]][sharp], axis=1))]


def _lines(edges: Index) -> list[list[int]]:
    """Edges (e, 2) as lines of vertices, from one where more or fewer than two meet to the next."""
    beside: dict[int, list[int]] = {}
    for p, q in edges.tolist():
        beside.setdefault(p, []).append(q)
        beside.setdefault(q, []).append(p)
    found, left = [], set(map(tuple, edges.tolist()))
    ends = sorted(beside, key=lambda vertex: len(beside[vertex]) == 2)  # what goes round has no end: it is left to the last
    for first in ends:
        for following in beside[first]:
            line, here = [first], following
            while (edge := (min(line[-1], here), max(line[-1], here))) in left:
                left.remove(edge)
                line.append(here)
                if len(beside[here]) != 2:
                    break
                here = next((each for each in beside[here] if each != line[-2]), here)
            if len(line) > 1:
                found.append(line)
    return found
