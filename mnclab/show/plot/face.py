"""The face of a turning workpiece: what a tool that moves across it at a feed per revolution draws there, a spiral.

Only moves are drawn of which the angle is known: those that wait for the zero mark of the spindle begin at angle 0. Seen
against Z, from the tailstock.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mnclab.path.toolpath import Array, Kind, Toolpath
from mnclab.show.plot import colours
from mnclab.show.plot.classes import ramp
from mnclab.show.plot.picture import SMALL, Picture, calm, figure_of, stacked, write_legend
from mnclab.show.plot.sizes import sized
from mnclab.text.alarm import Alarm

STEPS, MOST = 72, 200  # points of a turn, turns of a picture
NAMED = 6


def spiral(path: Toolpath, row: int) -> Array:
    """The way of the tip on the workpiece (n, 3) in a row at a feed per revolution: it begins at angle 0.

    The workpiece turns by 2 pi for each `per_rev` mm of the way; the tip goes round it the other way about.
    """
    turns = float(path.lengths[row] / path.per_rev[row])
    share = np.linspace(0.0, 1.0, max(2, math.ceil(STEPS * min(turns, MOST)) + 1))
    angle = -2 * math.pi * turns * share * (1 if path.spindle[row] >= 0 else -1)
    begin, end = path.start[row], path.end[row]
    radius, height = (begin[k] + (end[k] - begin[k]) * share for k in (0, 2))
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), height])


def faces(path: Toolpath) -> list[int]:
    """The rows of a lathe that begin at the zero mark of the spindle and cross a face."""
    begun = [number for number, label in enumerate(path.labels) if "synchronised start" in label]
    level = path.start[:, 2] == path.end[:, 2]
    cuts = (path.kind == Kind.LINE) & np.isfinite(path.per_rev) & (path.per_rev > 0) & level
    return [int(row) for row in np.flatnonzero(cuts & np.isin(path.label, begun) & (path.start[:, 0] != path.end[:, 0]))]


@sized()
def plot_face(run: Any, ax: Axes | None = None, *, size: tuple[float, float] = (5.2, 5.4)) -> Figure:
    """The spirals that a run cuts in a face, from the tailstock: each height in its own shade, the first below.

    An Alarm where no move begins at the zero mark of the spindle: at which angle a cut begins is not known then.
    """
    path: Toolpath = run.toolpath
    rows = faces(path)
    if not rows:
        raise Alarm("no cut across a face begins at the zero mark of the spindle: where it begins is not known")
    unit = path.unit
    heights = list(dict.fromkeys(float(path.end[row, 2]) for row in rows))
    turns = float(path.lengths[rows[0]] / path.per_rev[rows[0]])
    most = max(float(np.abs(path.start[rows, 0]).max()), float(np.abs(path.end[rows, 0]).max()))
    picture = None
    if ax is None:
        widest = f"{unit.figure(2 * most, 1)} {unit.short}"
        said = f"face from the tailstock: spirals of {turns:.4g} turns in diameter {widest}, {len(rows)} cuts"
        picture = Picture(size, said)
        (ax,) = stacked(picture, [1.0], 0.5, ticks=9)
    handles = []
    for height, shade, width in zip(heights, ramp(len(heights)), np.linspace(2.0, 0.7, len(heights))):
        mine = [spiral(path, row) for row in rows if path.end[row, 2] == height]
        points = np.concatenate([np.vstack([each, np.full((1, 3), np.nan)]) for each in mine])
        name = f"Z {unit.figure(height, 1)} {unit.short}".replace("-", "\N{MINUS SIGN}")
        look: dict[str, Any] = {"color": shade, "linewidth": width, "label": name if len(heights) <= NAMED else "_layer"}
        handles.append(ax.add_line(Line2D(points[:, 0] / unit.length, points[:, 1] / unit.length, **look)))
    reach = 1.08 * most / unit.length
    ax.axhline(0.0, **{**colours.CENTRE_LINE.style(), "label": "_centre"})
    ax.axvline(0.0, **{**colours.CENTRE_LINE.style(), "label": "_centre"})
    ax.annotate("zero mark", (reach, 0), (-2, 3), textcoords="offset points", fontsize=SMALL, ha="right", zorder=5,
                bbox={"boxstyle": "square,pad=0.1", "facecolor": colours.PAPER, "edgecolor": "none"})  # fmt: skip
    ax.set(aspect="equal", xlim=(-reach, reach), ylim=(-reach, reach))
    ax.set_xlabel(f"X (radius), {unit.short}", fontsize=SMALL + 1)
    ax.set_ylabel(f"Y, {unit.short}", fontsize=SMALL + 1)
    calm(ax)
    if picture is None:
        return figure_of(ax)
    write_legend(picture, handles if len(heights) <= NAMED else [])
    return picture
