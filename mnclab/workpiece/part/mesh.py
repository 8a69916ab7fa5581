"""A body of triangles, as a file or pyvista has it: sides, signed distances, sections, places on its walls.

Distances are vtk's. How far facets are off the rounded faces that they stand for is told as the `error`: the rise of an arc
over a facet that leans by as much from its neighbour.
"""

from __future__ import annotations

import logging
import re
import warnings
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import counted
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import outlined
from mnclab.path.toolpath import Array, Index
from mnclab.text.alarm import Alarm
from mnclab.text.file import read
from mnclab.text.given import shown
from mnclab.workpiece.part.part import Part

SUFFIXES = (".stl", ".ply", ".obj", ".vtk", ".vtp", ".glb", ".gltf")
METRES = (".glb", ".gltf")  # in metres, Y upwards
SMOOTH = np.radians(30)  # neighbours that lean less from each other are facets of one face
UPRIGHT = 1e-4  # of a normal: how much it may lean
TINY = 1e-9  # mm², a triangle that has no area
EDGE = 1e-9  # of a triangle: how far beside it a point still is on it
PAIRS = 2_000_000  # of points and triangles that are looked at together
WIDE = (16, 1000)  # squares along the longer side, by which triangles are found
EXACT, SINGLE = 1e-6, 1e-7  # mm, and of a coordinate: the single precision of files
ACROSS = {"XY": 2, "XZ": 1, "YZ": 0}


def is_mesh(given: Any) -> bool:
    """Whether something is a body of pyvista."""
    return hasattr(given, "points") and hasattr(given, "extract_surface")


def read_mesh(path: Path) -> Mesh:
    """A body from a file; an Alarm unless it is one that can be read."""
    if path.suffix.lower() not in SUFFIXES:
        known = ", ".join((".toml", *SUFFIXES))
        raise Alarm(f"a part is compared with the body or the design of a file {known}, got {path.name!r}")
    if not path.exists():
        raise Alarm(f"there is no file {str(path)!r}")
    read(path, path)  # refuses what is no file, or too large
    import pyvista
    from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow

    before, window, disabled = vtkOutputWindow.GetInstance(), vtkStringOutputWindow(), logging.root.manager.disable
    loud = vtkLogger.GetCurrentVerbosityCutoff()
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    vtkOutputWindow.SetInstance(window)  # what vtk says of a broken file is told by the alarm, not on stderr
    logging.disable(logging.CRITICAL)
    try:
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            found = pyvista.read(path)
    except Exception as fault:  # whatever a reader of files trips over
        raise Alarm(f"{path.name} cannot be read as a body: {fault}") from None
    finally:
        logging.disable(disabled)
        vtkOutputWindow.SetInstance(before)
        vtkLogger.SetStderrVerbosity(loud)
    told = re.search(r"ERROR: .*\n(?:.*\((?:0x\w+|nullptr)\): |\(nullptr\): )?(.*)", window.GetOutput())
    if told or any("reader" in str(each.message) for each in said):
        raise Alarm(f"{path.name} cannot be read as a body: {told[1] if told else 'it is cut or damaged'}")
    return mesh_of(found, path.name, metres=path.suffix.lower() in METRES)


def mesh_of(given: Any, name: str = "mesh", metres: bool = False) -> Mesh:
    """A body of pyvista, as closed triangles."""
    if hasattr(given, "combine"):
        given = given.combine()
    surface = given.extract_surface(algorithm="dataset_surface").triangulate().clean()
    points = np.asarray(surface.points, dtype=np.float64)
    triangles = surface.faces.reshape(-1, 4)[:, 1:] if surface.n_cells else np.zeros((0, 3), dtype=np.int64)
    if metres:
        points = 1000 * points[:, [0, 2, 1]] * (1, -1, 1)
    if not len(triangles) or not np.isfinite(points).all():
        raise Alarm(f"{name} has no triangles to compare with")
    if surface.n_open_edges:
        raise Alarm(f"{name} must be a closed body, {surface.n_open_edges} of its edges are open")
    return Mesh(points, np.asarray(triangles, dtype=np.int64), name)


class Mesh:
    """`points` (n, 3) mm, `triangles` (m, 3), closed."""

    def __init__(self, points: Array, triangles: Index, name: str) -> None:
        a, b, c = points[triangles].transpose(1, 0, 2)
        normal = np.cross(b - a, c - a)
        if np.einsum("ij,ij->", a, normal) < 0:
            triangles, normal = triangles[:, ::-1], -normal
        area = np.linalg.norm(normal, axis=1)
        some = area > TINY
        self.points, self.triangles, self.name = points, triangles[some], name
        self.normal, self.area = normal[some] / area[some, None], area[some] / 2
        self.bounds = np.array([points.min(axis=0), points.max(axis=0)])

    def __repr__(self) -> str:
        return f"<Mesh {self.name}: {len(self.triangles)} triangles, within {self.error:.3g} mm>"

    def __getstate__(self) -> dict[str, Any]:
        """What vtk made of it stays: another process makes its own."""
        return {name: value for name, value in vars(self).items() if name not in ("surface", "_implicit")}

    @cached_property
    def surface(self) -> Any:
        """As pyvista has it."""
        import pyvista

        return pyvista.PolyData.from_regular_faces(self.points, self.triangles)

    @cached_property
    def error(self) -> float:
        """How far facets may be off the rounded faces that they stand for, mm."""
        ends = np.sort(np.concatenate([self.triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
        owner = np.tile(np.arange(len(self.triangles)), 3)
        order = np.lexsort(ends.T)
        ends, owner = ends[order], owner[order]
        pair = np.flatnonzero((ends[1:] == ends[:-1]).all(axis=1))
        one, other = owner[pair], owner[pair + 1]
        lean = np.arccos(np.clip((self.normal[one] * self.normal[other]).sum(axis=1), -1.0, 1.0))
        long = np.linalg.norm(np.diff(self.points[ends[pair]], axis=1)[:, 0], axis=1)
        wide = 2 * np.minimum(self.area[one], self.area[other]) / np.maximum(long, TINY)
        smooth = (lean > EXACT) & (lean < SMOOTH)
        rise = (wide * np.tan(lean / 4) / 2)[smooth].max(initial=0.0)
        return max(EXACT, SINGLE * float(np.abs(self.points).max()), float(rise))

    @cached_property
    def _implicit(self) -> Any:
        from vtkmodules.vtkFiltersCore import vtkImplicitPolyDataDistance

        found = vtkImplicitPolyDataDistance()
        found.SetInput(self.surface)
        return found

    def distance(self, points: Array) -> Array:
        """Signed distances (m,) of points (m, 3), negative in the material."""
        from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
        from vtkmodules.vtkCommonCore import vtkDoubleArray

        if not len(points):
            return np.zeros(0)
        found = vtkDoubleArray()
        self._implicit.FunctionValue(numpy_to_vtk(np.ascontiguousarray(points)), found)
        return np.array(vtk_to_numpy(found), dtype=np.float64)

    @cached_property
    def _squares(self) -> tuple[Array, float, tuple[int, int], Index, Index]:
        """Lower corner and side of squares seen from above, how many, the triangles in each and where they begin."""
        low, high = self.bounds[:, :2]
        level = np.flatnonzero(np.abs(self.normal[:, 2]) > UPRIGHT)
        side = float((high - low).max()) / np.clip(np.sqrt(len(level)), *WIDE) * (1 + 1e-9)
        shape = tuple(int(n) for n in np.floor((high - low) / side).astype(int) + 1)
        corners = self.points[self.triangles[level]][..., :2]
        first = np.floor((corners.min(axis=1) - low) / side).astype(int)
        last = np.floor((corners.max(axis=1) - low) / side).astype(int)
        wide, deep = (last - first + 1).T
        which, rank = counted(wide * deep)
        i, j = first[which, 0] + rank % wide[which], first[which, 1] + rank // wide[which]
        a = corners[which] - low - side * np.stack([i, j], axis=1)[:, None]  # from the lower corner of the square
        met = np.ones(len(which), dtype=bool)
        for k in range(3):  # a square that lies beyond an edge, seen from the third corner, is not met
            edge, third = a[:, (k + 1) % 3] - a[:, k], a[:, (k + 2) % 3] - a[:, k]
            across = np.stack([-edge[:, 1], edge[:, 0]], axis=1)
            across *= np.sign((third * across).sum(axis=1))[:, None]
            met &= (np.maximum(across, 0).sum(axis=1) * side - (a[:, k] * across).sum(axis=1)) >= -TINY
        square, which = (j * shape[0] + i)[met], which[met]
        order = np.argsort(square, kind="stable")
        begins = np.searchsorted(square[order], np.arange(shape[0] * shape[1] + 1))
        return low, side, (shape[0], shape[1]), level[which[order]], begins

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Lower and upper side at points (m,), nan beside it; what overhangs counts as full."""
        low, side, shape, owner, begins = self._squares
        spots = np.stack([x, y], axis=1)
        i, j = np.floor((spots - low) / side).astype(int).T
        inside = (i >= 0) & (j >= 0) & (i < shape[0]) & (j < shape[1])
        square = np.where(inside, j * shape[0] + i, 0)
        many = np.where(inside, begins[square + 1] - begins[square], 0)
        floor, top = np.full(len(x), np.inf), np.full(len(x), -np.inf)
        upto = np.cumsum(many)
        start = 0
        while start < len(x):
            stop = max(int(np.searchsorted(upto, (upto[start - 1] if start else 0) + PAIRS)), start + 1)
            point, rank = counted(many[start:stop])
            point += start
            triangle = owner[begins[square[point]] + rank]
            z = self._height(triangle, spots[point])
            hit = np.isfinite(z)
            np.minimum.at(floor, point[hit], z[hit])
            np.maximum.at(top, point[hit], z[hit])
            start = stop
        return np.where(np.isfinite(floor), floor, np.nan), np.where(np.isfinite(top), top, np.nan)

    @cached_property
    def _planes(self) -> Array:
        """Of every triangle two coordinates in it and the height (3, 3, m): each a number and its growth along x and y."""
        a, b, c = self.points[self.triangles].transpose(1, 2, 0)
        u, v = b - a, c - a
        with np.errstate(divide="ignore", invalid="ignore"):
            whole = u[0] * v[1] - u[1] * v[0]
            s, t = np.stack([v[1], -v[0]]) / whole, np.stack([-u[1], u[0]]) / whole
            rise = s * u[2] + t * v[2]
            bases = ((0.0, s), (0.0, t), (a[2], rise))
            return np.array([[base - way[0] * a[0] - way[1] * a[1], *way] for base, way in bases])

    def _height(self, triangle: Index, spots: Array) -> Array:
        """How high triangles (k,) stand over points (k, 2), nan beside them."""
        (x, y), planes = spots.T, self._planes
        s, t = (plane[0][triangle] + plane[1][triangle] * x + plane[2][triangle] * y for plane in planes[:2])
        found = np.full(len(triangle), np.nan)
        on = np.flatnonzero((s >= -EDGE) & (t >= -EDGE) & (s + t <= 1 + EDGE))
        base, along, up = planes[2][:, triangle[on]]
        found[on] = base + along * x[on] + up * y[on]
        return found

    def upright(self, spacing: float) -> tuple[Array, Array, Array]:
        """Places (m, 2) in upright triangles, their normals and heights."""
        some = np.flatnonzero(np.abs(self.normal[:, 2]) <= UPRIGHT)
        count = np.clip(np.ceil(np.sqrt(2 * self.area[some]) / spacing).astype(int), 1, 40)
        found = []
        for n in np.unique(count):  # the middles of n² triangles in each
            steps = [(i, j, 1 / 3) for i in range(n) for j in range(n - i)]
            steps += [(i, j, 2 / 3) for i in range(n - 1) for j in range(n - 1 - i)]
            s, t = np.array([((i + part) / n, (j + part) / n) for i, j, part in steps]).T
            mine = some[count == n]
            a, b, c = self.points[self.triangles[mine]].transpose(1, 0, 2)
            spots = a[:, None] + s[:, None] * (b - a)[:, None] + t[:, None] * (c - a)[:, None]
            found.append((spots.reshape(-1, 3), np.repeat(self.normal[mine, :2], len(s), axis=0)))
        if not found:
            return np.zeros((0, 2)), np.zeros((0, 2)), np.zeros(0)
        spots, normal = (np.concatenate(column) for column in zip(*found))
        return spots[:, :2], normal / np.linalg.norm(normal, axis=1)[:, None], spots[:, 2]

    def cut(self, plane: str, at: float) -> list[Contour]:
        """A section: closed contours, outer ones counter-clockwise, holes clockwise."""
        axis = ACROSS[plane]
        normal, origin = np.eye(3)[axis], np.array(self.bounds.mean(axis=0))
        origin[axis] = at
        return _contours(self._area(normal, origin, [k for k in range(3) if k != axis]))

    def section(self, z: float) -> Region:
        """What a level plane cuts."""
        return Region(tuple(self.cut("XY", z)))

    def half_section(self, axis: float) -> list[Contour]:
        """The section through the axis of a spindle at x = `axis`, y = 0, from there outwards: contours (z, r)."""
        area = self._area(np.array([0.0, 1.0, 0.0]), np.array([axis, 0.0, 0.0]), [2, 0])
        (_, _, z0), (x1, _, z1) = self.bounds.tolist()
        above = shapely.intersection(area, shapely.box(z0 - 1, axis, z1 + 1, x1 + 1))
        return [Contour(loop.points - (0.0, axis), loop.bulge) for loop in _contours(above)]

    def _area(self, normal: Array, origin: Array, axes: list[int]) -> Any:
        """What a plane cuts, as a shapely area."""
        lines = self.surface.slice(normal=normal, origin=origin)
        ends = np.asarray(lines.points)[:, axes][lines.lines.reshape(-1, 3)[:, 1:]] if lines.n_cells else np.zeros((0, 2, 2))
        net = shapely.node(shapely.MultiLineString(list(ends.round(7))))
        found = shapely.Polygon()
        for face in shapely.get_parts(shapely.polygonize([net])):
            x, y = shapely.get_coordinates(shapely.point_on_surface(face))[0].tolist()
            spot = np.array(origin)
            spot[axes] = x, y
            if self.distance(spot[None])[0] < 0:
                found = shapely.union(found, face)
        return found


def _contours(area: Any) -> list[Contour]:
    """The rings of a shapely area."""
    pieces = shapely.get_parts(area)
    return list(outlined(pieces[shapely.area(pieces) > TINY]).loops)


# A body of triangles as a part: a file (STL and others), or what pyvista has.

AT_ONCE = 16  # places that a probe looks at in one go: each of them searches the triangles


def mesh(given: Any) -> Part:
    """A closed body of triangles as a part, mm: the path of a file (STL, PLY, OBJ …), or a mesh of pyvista."""

    if isinstance(given, str | Path):
        if Path(given).suffix.lower() not in SUFFIXES:
            raise Alarm(f"a mesh is a file {', '.join(SUFFIXES)}, got {shown(str(given))}")
        body = read_mesh(Path(given))
    elif is_mesh(given):
        body = mesh_of(given)
    else:
        raise Alarm(f"a mesh is the path of a file or a body of pyvista, got {shown(given)}")
    return Part(body.distance, body.name, AT_ONCE, body.bounds)
