"""A part for pictures: what a level plane cuts, and triangles of its surface. Exact for upright prisms, else over a grid."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region, less
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown
from mnclab.workpiece.part.part import AT_ONCE, Floats, Part
from mnclab.workpiece.part.prisms import Prism, Prisms, Slab

Triangles = NDArray[np.int64]

CELLS, BLOCKS = 240, 60  # of a grid without a step: squares along the longer side of a section, cubes of a surface
COARSER = 4  # where a distance costs more
MOST = 20_000_000  # places of a grid
CHORD_ERROR = 0.01  # mm, of the arcs of a surface
UPRIGHT = 1e-9


def section(part: Part, z: float, step: float | None = None, within: ArrayLike | None = None) -> list[Contour]:
    """What a level plane cuts of the material, as closed contours, outer ones counter-clockwise, holes clockwise.

    Of upright prisms and designs exact, lines and arcs, of meshes theirs. Of others polygons over squares of `step` mm;
    `within` are two corners (x, y) or (x, y, z) of where to look, the bounds of the part if it has none.
    """
    check_number(z, "the height of a section (mm)")
    body = _body(part)
    if isinstance(body, Prisms) and abs(abs(body.placing[2, 2]) - 1) < UPRIGHT:
        own = (z - body.placing[2, 3]) * body.placing[2, 2]
        here = [slab.region for slab in body.solid if slab.low < own <= slab.high]
        return [loop for region in here for loop in Prism(region, own, own).moved(body.placing).region.loops]
    if hasattr(body, "section"):
        return list(body.section(z).loops)
    found = _zeros(part, *_grid(part, step, within, CELLS, 2), z).strip(join=True)
    loops, lines = list[Contour](), found.lines
    while len(lines):
        ring, lines = lines[1 : lines[0] + 1], lines[lines[0] + 1 :]
        if len(ring) > 3:
            loops.append(Contour(np.asarray(found.points, dtype=float)[ring[:-1], :2]))
    holes = [sum(bool(other.winding(loop.points[:1])[0]) for other in loops if other is not loop) % 2 for loop in loops]
    return [loop if (loop.area > 0) != hole else loop.reversed() for loop, hole in zip(loops, holes)]


def surface(part: Part, step: float | None = None, within: ArrayLike | None = None) -> tuple[Floats, Triangles]:
    """Points (n, 3) and triangles (m, 3), seen counter-clockwise from outside.

    Of upright prisms exact but for the chords of arcs, else by pyvista over cubes of `step` mm; `within` are two corners
    (x, y, z) of where to look, the bounds of the part if it has none.
    """
    body = _body(part)
    if hasattr(body, "triangles"):
        return body.points, body.triangles
    if isinstance(body, Prisms) and np.isfinite([*part.bounds.ravel(), body.top]).all():
        points, triangles = _of_prisms(body)
        return points @ body.placing[:3, :3].T + body.placing[:3, 3], triangles
    return _triangles(_zeros(part, *_grid(part, step, within, BLOCKS, 3)))


def _body(part: Part) -> Any:
    """What a part is made of, which may know its own sections or triangles."""
    own = getattr(part.distance, "__self__", part.distance)
    return None if isinstance(own, Prisms) and own.taper else own


def _zeros(part: Part, axes: list[Floats], ends: Floats, z: float = 0.0) -> Any:
    """Where the distance is 0 on a grid, as pyvista has it: triangles, or lines of a level grid at a height. Cut off at the
    ends of where to look."""
    import pyvista

    grid = pyvista.RectilinearGrid(*axes, *([np.array([z])] if len(axes) == 2 else []))
    points = np.asarray(grid.points, dtype=float)
    beyond = np.abs(points[:, : len(axes)] - ends.mean(axis=0)) - (ends[1] - ends[0]) / 2
    field = np.maximum(part(points), beyond.max(axis=1))
    return grid.contour([0.0], scalars=field) if (field < 0).any() else pyvista.PolyData()


def _grid(part: Part, step: float | None, within: ArrayLike | None, cells: int, many: int) -> tuple[list[Floats], Floats]:
    """Places along `many` axes, around the part or where it is looked for, and the two corners of that (2, many)."""
    if step is not None:
        check_number(step, "the step of a grid (mm)", above=0)
    if within is None:
        ends = part.bounds[:, :many]
    else:
        try:
            ends = np.sort(np.asarray(within, dtype=float)[:, :many], axis=0)
        except (TypeError, ValueError, IndexError):
            ends = np.zeros(0)
        if ends.shape != (2, many):
            raise Alarm(f"where to look for a part is two corners, got {shown(within)}")
    if not np.isfinite(ends).all():
        raise Alarm(f"{part.name} has no end: say where to look, two corners", hint="within=((0, 0, -20), (100, 60, 0))")
    cells = cells if part.at_once == AT_ONCE else cells // COARSER
    step = step or float((ends[1] - ends[0]).max()) / cells or 1.0
    counts = np.ceil((ends[1] - ends[0]) / step) + 1
    if counts.prod() > MOST:
        raise Alarm(f"a grid of {step:g} mm has too many places, {counts.prod():.3g}", hint="give a larger step")
    middle = ends.mean(axis=0)
    return [m + step * (np.arange(n + 2) - (n + 1) / 2) for m, n in zip(middle, counts.astype(int))], ends


def _of_prisms(body: Prisms) -> tuple[Floats, Triangles]:
    """Walls of every slab, and the faces in which neighbours differ, in its own coordinates."""
    pieces = []
    for below, above in zip(body.slabs, body.slabs[1:]):
        pieces += [_face(less(below.region, [above.region]), below.high, True)]
        pieces += [_face(less(above.region, [below.region]), below.high, False)]
    pieces += [_wall(loop, slab) for slab in body.solid for loop in slab.region.loops]
    first = np.cumsum([0, *(len(points) for points, _ in pieces)])
    points = np.concatenate([np.zeros((0, 3)), *(points for points, _ in pieces)])
    return points, np.concatenate([np.zeros((0, 3), dtype=np.int64), *(faces + n for (_, faces), n in zip(pieces, first))])


def _wall(loop: Contour, slab: Slab) -> tuple[Floats, Triangles]:
    ring = loop.points_within(CHORD_ERROR)[:-1]
    count = len(ring)
    k = np.arange(count)
    after = (k + 1) % count
    points = np.concatenate([np.column_stack([ring, np.full(count, z)]) for z in (slab.low, slab.high)])
    return points, np.concatenate([np.stack([k, after, after + count], 1), np.stack([k, after + count, k + count], 1)])


def _face(region: Region, z: float, up: bool) -> tuple[Floats, Triangles]:
    """A level face with its holes: between two of its sides a trapezoid reaches from corner to corner, two triangles."""
    rings = [loop.points_within(CHORD_ERROR) for loop in region.loops]
    if not rings:
        return np.zeros((0, 3)), np.zeros((0, 3), dtype=np.int64)
    sides = np.concatenate([np.stack([ring[:-1], ring[1:]], axis=1) for ring in rings])
    sides = np.where((sides[:, 0, 1] > sides[:, 1, 1])[:, None, None], sides[:, ::-1], sides)
    (x, y), (x1, y1) = sides[:, 0].T, sides[:, 1].T
    levels, begun, found = np.unique(sides[..., 1]), dict[tuple[int, int], float](), list[tuple[int, int, float, float]]()
    for k, level in enumerate(levels.tolist()):
        across = np.flatnonzero((y <= level) & (y1 > level))
        if len(across):
            share = ((level + levels[k + 1]) / 2 - y[across]) / (y1 - y)[across]
            across = across[np.argsort(x[across] + share * (x1 - x)[across])]
        now = set(zip(across[::2].tolist(), across[1::2].tolist()))
        found += [(*pair, begun.pop(pair), level) for pair in begun.keys() - now]
        begun |= {pair: level for pair in now - begun.keys()}
    corners = []
    for side, at in ((0, 2), (1, 2), (1, 3), (0, 3)):
        side_of, height = np.array([each[side] for each in found]), np.array([each[at] for each in found])
        share = (height - y[side_of]) / (y1 - y)[side_of]
        corners.append(np.stack([x[side_of] + share * (x1 - x)[side_of], height, np.full(len(found), z)], axis=1))
    first = np.arange(len(found))
    triangles = np.stack([np.stack([first + k * len(found) for k in each], axis=1) for each in ((0, 1, 2), (0, 2, 3))])
    return np.concatenate(corners), triangles.reshape(-1, 3)[:, :: 1 if up else -1]


def zeros_of(axes: list[Floats], field: Floats) -> tuple[Floats, Triangles]:
    """Points (n, 3) and triangles (m, 3) where a field over places along X, Y and Z, X running fastest, is 0: seen
    counter-clockwise from where it is greater (by pyvista)."""
    import pyvista

    return _triangles(pyvista.RectilinearGrid(*axes).contour([0.0], scalars=field))


def _triangles(found: Any) -> tuple[Floats, Triangles]:
    faces = found.triangulate().faces.reshape(-1, 4)[:, 1:] if found.n_cells else np.zeros((0, 3))
    return np.asarray(found.points, dtype=float).reshape(-1, 3), np.array(faces[:, ::-1], dtype=np.int64)
