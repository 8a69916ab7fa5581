"""A path in its plane as a contour of lines and arcs, for what works on areas."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.path.kinds import Kind
from mnclab.path.plane import PlaneView
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown


class Chain(NamedTuple):
    """A path as an open contour, the heights (n,) of its n points along the normal of the plane, and the row (m,) of each of
    its m elements."""

    contour: Contour
    heights: np.ndarray
    rows: np.ndarray


def outline(path: Toolpath) -> Contour:
    """The closed contour along the moves of a path in the plane of its first row; a gap is closed by a straight line.

    Arcs of more than half a turn become several, since a bulge tan(sweep / 4) has no whole circle.
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
        points += [start, *(_turned(start, view.centre[row], sweep * k / count) for k in range(1, count))]
        bulges += [float(np.tan(sweep / count / 4))] * count
        heights += np.linspace(view.start[row, 2], view.end[row, 2], count, endpoint=False).tolist()
        source += [row] * count
    contour = Contour([*points, view.end[rows[-1], :2]], [*bulges, 0.0], closed=False)
    return Chain(contour, np.array([*heights, view.end[rows[-1], 2]]), np.array(source))


def _check_path(path: Toolpath) -> None:
    if not isinstance(path, Toolpath):
        raise Alarm(f"an outline is that of a Toolpath, got {shown(path)}", hint="the toolpath of a run: run.toolpath")


def _turned(point: np.ndarray, centre: np.ndarray, angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    x, y = point - centre
    return centre + np.array([c * x - s * y, s * x + c * y])


def outlines(path: Toolpath, tolerance: float = 0.01) -> tuple[Contour, ...]:
    """Every closed contour that a path cuts: runs of cuts in the plane that end within `tolerance` of their start.

    A rapid or a move along the tool axis parts runs. What is cut and does not close, an approach for one, is left out.
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
