"""A path seen in its plane: two coordinates in it, one along its normal."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import turned
from mnclab.path.toolpath import Array, Index, Kind, Toolpath
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown


def basis(axis: Array) -> Array:
    """Unit vectors (n, 3, 3): first and second axis of the plane and its normal. For a normal along Z, X or Y the first
    axis is X, Y or Z: the planes XY, YZ and ZX of the controls."""
    first = np.roll(axis, 1, axis=-1)
    skew = np.abs((first * axis).sum(axis=-1)) > 1e-12
    if skew.any():
        along = np.eye(3)[np.argmin(np.abs(axis[skew]), axis=-1)]
        flat = along - (along * axis[skew]).sum(axis=-1, keepdims=True) * axis[skew]
        first[skew] = flat / np.linalg.norm(flat, axis=-1, keepdims=True)
    return np.stack([first, np.cross(axis, first), axis], axis=-2)


PIECE = 1 << 14  # rows worked on at once


class PlaneView:
    """Rows of a path in the coordinates (u, v, w) of their planes."""

    def __init__(self, path: Toolpath) -> None:
        same = path.axis.strides[0] == 0 or bool((path.axis == path.axis[:1]).all())
        self.basis = basis(path.axis[:1] if same and len(path) else path.axis)  # one plane for all, or one a row
        self.flat = len(self.basis) == 1 and bool((self.basis[0] == np.eye(3)).all())
        self.start, self.end = self.to_plane(path.start), self.to_plane(path.end)
        self.arc = path.kind == Kind.ARC
        self.sweep = path.sweep
        n = len(path)
        self.moves, line = np.empty(n, dtype=bool), np.empty((n, 2))
        for first in range(0, n, PIECE):  # a piece at a time stays in the cache
            piece = slice(first, first + PIECE)
            travel = self.end[piece, :2] - self.start[piece, :2]
            length = np.hypot(travel[:, 0], travel[:, 1])
            self.moves[piece] = length > 1e-9
            np.divide(travel, np.where(length > 0, length, 1.0)[:, None], out=line[piece])
        self.moves = path.is_motion & (self.arc | self.moves)
        self.radius = np.broadcast_to(np.nan, (n,))
        self.tangent_start, self.tangent_end = line, line
        if not self.arc.any():
            self.centre = np.broadcast_to(np.array([np.nan, np.nan]), (len(path), 2))
            return
        self.centre = self.to_plane(path.centre)[:, :2]
        self.radius = np.where(self.arc, np.hypot(*(self.start[:, :2] - self.centre).T), np.nan)
        self.tangent_start = np.where(self.arc[:, None], self._along_arc(self.start), line)
        self.tangent_end = np.where(self.arc[:, None], self._along_arc(self.end), line)

    def to_plane(self, points: Array) -> Array:
        """Points (n, 3) of all rows in the coordinates of their planes."""
        if self.flat:
            return points
        if len(self.basis) == 1:
            return np.asarray(points @ self.basis[0].T)
        return np.asarray(np.einsum("nij,nj->ni", self.basis, points))

    def _along_arc(self, at: Array) -> Array:
        spoke = at[:, :2] - self.centre
        length = np.hypot(spoke[:, 0], spoke[:, 1])[:, None]
        sense = np.sign(self.sweep)[:, None]
        return sense * np.stack([-spoke[:, 1], spoke[:, 0]], axis=-1) / np.where(length > 0, length, 1.0)

    def to_space(self, rows: Index, uvw: Array) -> Array:
        """Points (m, 3) of the planes of `rows` in machine axes."""
        if self.flat:
            return uvw
        if len(self.basis) == 1:
            return np.asarray(uvw @ self.basis[0])
        return np.asarray(np.einsum("nji,nj->ni", self.basis[rows], uvw))


# A path in its plane as a contour of lines and arcs, for what works on areas.

class Chain(NamedTuple):
    """A path as an open contour, the heights (n,) of its n points along the normal of the plane, and the row (m,) of each of
    its m elements."""

    contour: Contour
    heights: np.ndarray
    rows: np.ndarray


def outline(path: Toolpath) -> Contour:
    """The closed contour along the moves of a path in the plane of its first row; a gap is closed by a straight line.

    Arcs of more than half a turn become several, since a bulge tan(sweep / 4) has no whole circle.

    >>> mnc.area.outline(mnc.run("G1 X40 F100\\nY20\\nX0\\nY0\\n", "mnc").toolpath).area
    800.0
    """
    _check_path(path)
    view = PlaneView(path)
    whole = _chained(path, view, np.flatnonzero(view.moves)).contour
    if np.hypot(*(whole.points[-1] - whole.points[0])) > 1e-6:
        return Contour(whole.points, whole.bulge)
    return Contour(whole.points[:-1], whole.bulge[:-1])


def chain(path: Toolpath) -> Chain:
    """The open contour along all moves of a path, those along the normal of its plane as elements without length."""
    _check_path(path)
    return _chained(path, PlaneView(path), np.flatnonzero(path.is_motion))


def _chained(path: Toolpath, view: PlaneView, rows: np.ndarray) -> Chain:
    points, bulges, heights, source = list[np.ndarray](), list[float](), list[float](), list[int]()
    for row in rows.tolist():
        sweep, start = float(view.sweep[row]) if view.arc[row] else 0.0, view.start[row, :2]
        count = max(1, int(np.ceil(abs(sweep) / np.pi - 1e-9)))
        angles = sweep * np.arange(1, count)[:, None] / count
        points += [start, *(view.centre[row] + turned(start - view.centre[row], angles).reshape(-1, 2))]
        bulges += [float(np.tan(sweep / count / 4))] * count
        heights += np.linspace(view.start[row, 2], view.end[row, 2], count, endpoint=False).tolist()
        source += [row] * count
    contour = Contour([*points, view.end[rows[-1], :2]], [*bulges, 0.0], closed=False)
    return Chain(contour, np.array([*heights, view.end[rows[-1], 2]]), np.array(source))


def _check_path(path: Toolpath) -> None:
    if not isinstance(path, Toolpath):
        raise Alarm(f"an outline is that of a Toolpath, got {shown(path)}", hint="the toolpath of a run: run.toolpath")


def outlines(path: Toolpath, tolerance: float = 0.01) -> tuple[Contour, ...]:
    """Every closed contour that a path cuts: runs of cuts in the plane that end within `tolerance` of their start.

    A rapid or a move along the tool axis parts runs. What is cut and does not close, an approach for one, is left out.

    >>> path = mnc.run("G1 X40 F100\\nY20\\nX0\\nY0\\nG0 Z5\\nX80\\n", "mnc").toolpath
    >>> [contour.area for contour in mnc.area.outlines(path)]
    [800.0]
    """
    _check_path(path)
    check_number(tolerance, "the tolerance (mm)", above=0)
    view = PlaneView(path)
    cuts = view.moves & (path.kind != Kind.RAPID) & (path.kind != Kind.PROBE)
    level = np.abs(view.end[:, 2] - view.start[:, 2]) < tolerance
    edges = np.diff(np.concatenate([[0], (cuts & level).astype(int), [0]]))
    found = []
    for first, last in zip(np.flatnonzero(edges == 1), np.flatnonzero(edges == -1), strict=True):
        gap = view.end[last - 1, :2] - view.start[first, :2]
        if np.hypot(*gap) <= tolerance and (last - first > 1 or view.arc[first]):
            found.append(outline(path[int(first) : int(last)]))
    return tuple(found)
