"""The tool's width as a light band under its path, and when a path needs it: where its passes would run into a blot."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from mnclab.path.toolpath import Mask, Toolpath
from mnclab.show.plot.picture import View
from mnclab.show.plot.strokes import Array, Strokes, parted

NAME, SHADE, ORDER = "width of the tool", "#d6e3f1", 1.2
THIN = 0.45  # of the usual width of a line: where passes lie close
CELL, DENSE, SHARE = 6, 1.7, 0.11  # points; ways through a cell that is dense; share of such cells in a dense path
MOST, SAMPLES, CELLS = 20_000, 400_000, 100_000  # strokes under which a band is drawn unasked; points and cells looked at
MANY = 12  # radii of tools that have a band each


class Band(Line2D):
    """A line as wide as the tool, in data, whatever the scale is when it is drawn."""

    def __init__(self, xy: Array, radius: float) -> None:
        look: dict[str, Any] = {"color": SHADE, "solid_capstyle": "round", "solid_joinstyle": "round", "zorder": ORDER}
        super().__init__(*xy.T, label=f"_{NAME}", **look)
        self.radius = radius

    def draw(self, renderer: Any) -> None:
        """As any line, in the width that the scale gives it now."""
        if self.axes is not None and self.figure is not None:
            (x0, _), (x1, _) = self.axes.transData.transform([(0, 0), (2 * self.radius, 0)])
            self.set_linewidth(abs(x1 - x0) * 72 / self.figure.dpi)
        super().draw(renderer)


def draw_bands(ax: Axes, view: View, path: Toolpath, drawn: Strokes, cuts: Mask) -> None:
    """Add the bands of the strokes `cuts` (m,) of one view, largest tools first."""
    radii = path.radius[drawn.row]
    for radius in radii_of(path, drawn, cuts):
        (xyz,) = parted(drawn.xyz, np.where(cuts & np.isclose(radii, radius), 0, -1), 1)
        ax.add_line(Band(xyz[:, [view.right, view.up]], radius))


def radii_of(path: Toolpath, drawn: Strokes, cuts: Mask) -> list[float]:
    """The radii of the tools that cut, mm, largest first; none where no tool has a width."""
    radii = path.radius[drawn.row[cuts]]
    found = np.unique(np.round(radii[(radii > 0) & np.isfinite(radii)], 6))[::-1][:MANY].tolist()
    return list(found)


def around(low: Array, high: Array, path: Toolpath, drawn: Strokes, cuts: Mask) -> tuple[Array, Array]:
    """A box (3,), mm, with the bands in it."""
    if not cuts.any():
        return low, high
    room = np.nan_to_num(path.radius[drawn.row[cuts]])[:, None] * (1, 1, 0)
    return np.fmin(low, (drawn.xyz[cuts] - room).min(axis=0)), np.fmax(high, (drawn.xyz[cuts] + room).max(axis=0))


def sample() -> Patch:
    """What the legend shows."""
    return Patch(facecolor=SHADE, edgecolor="none", label=NAME)


def dense(xy: Array, cuts: Mask, scale: float) -> bool:
    """Whether strokes to points `xy` (m, 2), mm, lie so close, at `scale` points to a mm, that they run into each other.

    They are sampled a point apart; where a cell of 6 points holds the points of nearly two ways, they do.
    """
    end = np.flatnonzero(cuts)
    if not len(end):
        return False
    begin, way = xy[end - 1], xy[end] - xy[end - 1]
    count = np.ceil(np.hypot(*way.T) * scale).astype(np.int64)
    if count.sum() > SAMPLES:
        return True
    which = np.repeat(np.arange(len(end)), count)
    share = (np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)) / count[which]
    low = np.nanmin(xy, axis=0)
    wide, tall = (int(side) // CELL + 1 for side in (np.nanmax(xy, axis=0) - low) * scale)
    if wide * tall > CELLS:
        return True
    x, y = (((begin[which, k] + share * way[which, k]) - low[k]) * scale for k in (0, 1))
    ink = np.zeros((wide * CELL, tall * CELL), bool)
    ink[x.astype(np.int64), y.astype(np.int64)] = True
    held = ink.reshape(wide, CELL, tall, CELL).sum(axis=(1, 3))
    return bool((held[held > 0] > DENSE * CELL).mean() > SHARE) if held.any() else False
