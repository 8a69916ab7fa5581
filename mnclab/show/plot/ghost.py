"""What a picture that follows a number keeps of the one before: its limits, and the former path as a thin grey ghost."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from mnclab.path.limits import Limits
from mnclab.path.toolpath import Kind, Toolpath
from mnclab.show.plot import colours
from mnclab.show.plot.picture import View, roomy
from mnclab.show.plot.strokes import Array, line_of

Box = tuple[Array, Array]  # the corners (3,) of what is shown, mm

DIGITS = 6  # of a mm: moves that differ by less are the same
MARGIN = 0.85  # of the room around what is shown may be used before the limits grow
SHRINKS = 5  # times the size of the new picture: limits so large are those of a slip of the finger


def held(low: Array, high: Array, limits: Box | None) -> Box:
    """The box of a picture after one with these limits: the same while the new one fits into it, margin included, else so
    large that both fit; its own where the one before was far larger."""
    if limits is None:
        return low, high
    least, most = (kept + MARGIN * (wide - kept) for kept, wide in zip(limits, roomy(*limits)))
    size, former = float((high - low).max()), float((limits[1] - limits[0]).max())
    if former > SHRINKS * size > 0:
        return low, high
    if (least <= low).all() and (high <= most).all():
        return limits
    return np.fmin(low, limits[0]), np.fmax(high, limits[1])


def held_axes(rows: Sequence[Axes], before: Sequence[Any] | None) -> list[Any]:
    """Set axes to the limits that they had before where what is drawn fits, else so that both fit; returns the limits."""
    if before is not None and len(before) == len(rows):
        for ax, kept in zip(rows, before):
            ax.set_xlim(_both(ax.get_xlim(), kept[0]))
            ax.set_ylim(_both(ax.get_ylim(), kept[1]))
    return [(ax.get_xlim(), ax.get_ylim()) for ax in rows]


def _both(now: tuple[float, float], kept: tuple[float, float]) -> tuple[float, float]:
    """Limits that hold both, unless those before were far larger."""
    return now if kept[1] - kept[0] > SHRINKS * (now[1] - now[0]) else (min(now[0], kept[0]), max(now[1], kept[1]))


def gone(former: Toolpath, path: Toolpath) -> Toolpath:
    """The moves of a former path that are not in the present one."""
    motion = former.motion
    return motion[~np.isin(_moves(motion), _moves(path.motion))]


def draw_ghost(ax: Axes, view: View, rows: Toolpath, rapids: Limits | None = None) -> None:
    """Former moves in one view, behind everything else: cuts and rapids by their dashes, both thin and grey."""
    for look, kinds in ((colours.GHOST, (Kind.LINE, Kind.ARC, Kind.PROBE)), (colours.GHOST_RAPID, (Kind.RAPID,))):
        line = line_of(rows, kinds, rapids)
        if len(line):
            ax.add_line(Line2D(line[:, view.right], line[:, view.up], **look.style()))


def _moves(path: Toolpath) -> np.ndarray:
    """Each row (n,) as one value that can be compared: where it begins and ends, and how it bends."""
    centre = np.nan_to_num(path.centre)
    rows = np.column_stack([path.start, path.end, centre, path.sweep, path.kind]).round(DIGITS) + 0.0
    return np.ascontiguousarray(rows).view(f"V{rows.shape[1] * rows.itemsize}").ravel()
