"""A turned part as a drawing has it: above the centre line hatched in section, below it from outside, in its chuck.

Z goes to the right, the numbers beside the picture are diameters. The insert stands where the last cut leaves it.
"""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch, Polygon

from mnclab.geometry.contours import Contour
from mnclab.path.inserts import as_drawn, lead_of
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Array
from mnclab.show.plot import colours
from mnclab.show.plot.classes import number, ramp
from mnclab.show.plot.lathe import BAR, CHUCK, FINISHED, chucks_of, insert_patches, named_insert
from mnclab.show.plot.picture import SIZE, SMALL, VIEWS, Foot, arrange, dress, write_legend
from mnclab.show.plot.sections import CARD, CHORD, FACE, HATCH, outline_of
from mnclab.workpiece.cutting import CUTS
from mnclab.workpiece.turning.turned import Turned
from mnclab.workpiece.workpiece import Workpiece

OUTSIDE = "#e9e5d8"
JAW = (0.3, 0.55)  # length and height of a jaw that nobody gave, in radii of the bar
INSERT = 0.09  # edges of the insert, of the greatest side of the picture
BEYOND = 0.04  # of the length: how far the centre line goes on
LABELLED = 0.07  # of the length: the shortest cylinder with its diameter beside it
VIEW = VIEWS["ZX"]
FEW = 6


def plot_turned(
    part: Turned, ax: Axes | None, marks: Array, mark: dict[str, Any], colour: str = "depth", size: tuple[float, float] = SIZE
) -> Figure:
    """Section and view of a turned part; `marks` (n, 3) are drawn as `mark`; `colour` "tool" or "line" on its outline."""
    radius, span = part.radius, part.high - part.low
    low, high = np.array([-radius, 0.0, part.low]), np.array([radius, 0.0, part.high])
    chucks = chucks_of(part.cutting.fixtures)
    known = bool(chucks) or not len(part.cutting)  # a part as drawn hangs in no chuck
    chucks = chucks if known else [_jaw(part)]
    for each in chucks:
        (z0, _), (z1, r1) = each.min(axis=0), each.max(axis=0)
        low, high = np.fmin(low, (-r1, 0, z0)), np.fmax(high, (r1, 0, z1))
    tip, tool = _last_cut(part)
    if tip is not None:
        low, high = np.fmin(low, tip), np.fmax(high, tip + 2.5 * INSERT * max(span, 2 * radius) * np.array([1.0, 0.0, 1.0]))
    names = [] if colour == "depth" else _colours(part, colour)
    handles: list[Any] = [
        Line2D([], [], **_BLANK),
        *([Patch(**CHUCK, label="chuck")] if chucks else []),
        *([named_insert()] if tip is not None else []),
        *(Line2D([], [], color=shade, linewidth=2.2, label=name) for name, shade, _ in names),
        *([Line2D([], [], **mark)] if len(marks) else []),
    ]
    unit = part.cutting.path.unit
    view = VIEW._replace(unit=unit)
    if ax is None:
        labels = [str(each.get_label()) for each in handles]
        picture, (own,) = arrange([view], low, high, labels, Foot(told(part)), in_words(part), size)
        write_legend(picture, handles)
    else:
        own = ax
        dress(own, view)
    own.yaxis.set_major_formatter(lambda value, _: number(abs(round(2 * value / unit.length, 9))))
    _draw(own, part, chucks, known)
    for _, shade, lines in names:
        own.add_collection(LineCollection(lines, colors=shade, linewidths=2.2, capstyle="butt", zorder=2.6))
    if tip is not None:
        for patch in insert_patches(tool, (float(tip[2]), float(tip[0])), INSERT * max(span, 2 * radius)):
            own.add_patch(patch)
    if len(marks):
        own.add_line(Line2D(marks[:, 2], marks[:, 0] - part.axis, **mark))
    if ax is not None:
        own.autoscale_view()
    return cast(Figure, own.get_figure(root=True))


_BLANK = {**colours.BLANK.style(), "linestyle": (0, (6, 2)), "linewidth": 0.9}


def _last_cut(part: Turned) -> tuple[Array | None, Tool]:
    """Where the tip stands after the last cut (3,), from the axis on, and its tool."""
    cutting = part.cutting
    rows = np.flatnonzero(cutting.cuts & np.isin(cutting.path.kind, CUTS))
    if not len(rows):
        return None, Tool()
    row = int(rows[-1])
    tool = as_drawn(cutting.tool(row), lead_of(cutting.path, np.arange(len(cutting)) == row))
    return cutting.path.end[row] - (part.axis, 0.0, 0.0), tool


def draw_half(ax: Axes, part: Turned) -> None:
    """The bar under a path, pale, and the finished profile in it."""
    for line in part.cutting.stock.outline(2, 0):
        line = np.maximum(line, [-np.inf, 0.0])
        ax.add_patch(Polygon(line, **BAR, zorder=0.6, label="blank"))
    if part.section:
        shape = outline_of(part.section)
        ax.add_patch(PathPatch(shape, **FINISHED, zorder=0.8, label="part"))


def _jaw(part: Turned) -> Array:
    """A jaw outside the left end of the bar, where the setup has no chuck."""
    long, high = JAW[0] * part.radius, JAW[1] * part.radius
    left, inner = part.low - long, part.grip
    return np.array([(left, inner), (part.low, inner), (part.low, inner + high), (left, inner + high)])


def _draw(ax: Axes, part: Turned, chucks: list[Array], known: bool) -> None:
    for ring in chucks:
        for side in (1, -1):
            ax.add_patch(Polygon(ring * (1, side), **CHUCK, zorder=2.0, label="chuck"))
    stub = part.low - (0.0 if known else JAW[0] * part.radius)  # in a chuck that nobody gave the bar goes on
    ax.add_patch(Polygon(
        [(stub, -part.grip), (part.low, -part.grip), (part.low, part.grip), (stub, part.grip)],
        facecolor="#e6e2d6", edgecolor="#8c8778", linewidth=0.7, zorder=1.2,
    ))  # fmt: skip
    for loop in part.blank:
        points = loop.points_within(CHORD)
        for side in (1, -1):
            ax.add_line(Line2D(*(np.concatenate([points, points[:1]]) * (1, side)).T, **{**_BLANK, "label": "_blank"}))
    if part.section:
        shape = outline_of(part.section)
        ax.add_patch(PathPatch(shape, **FACE, zorder=1.5, label="part"))
        hatch = PathPatch(shape, **HATCH, zorder=1.6)
        hatch.set_hatch_linewidth(0.6)
        ax.add_patch(hatch)
        _outside(ax, part)
    reach = BEYOND * (part.high - part.low)
    ends = [stub - reach, part.high + reach]
    ax.add_line(Line2D(ends, [0, 0], **{**colours.CENTRE_LINE.style(), "zorder": 2.8, "label": "_centre line"}))


def _outside(ax: Axes, part: Turned) -> None:
    """The lower half as one sees it: its outline, its edges across, and the diameters of its cylinders."""
    places = np.unique(np.concatenate([loop.points_within(CHORD)[:, 0] for loop in part.section]))
    around = np.repeat(places, 2) + np.tile([-1e-7, 1e-7], len(places))
    around = around[1:-1]
    outer = np.asarray(part.at(around))
    profile = np.concatenate([[(around[0], 0.0)], np.stack([around, -outer], axis=1), [(around[-1], 0.0)]])
    ax.add_patch(Polygon(profile, facecolor=OUTSIDE, edgecolor=colours.INK, linewidth=1.1, zorder=1.5, label="_outside"))
    edges, span, unit = [], part.high - part.low, part.cutting.path.unit
    for loop in part.section:
        ends = loop.points
        after = np.asarray(part.at(ends[:, 0] + 1e-7)), np.asarray(part.at(ends[:, 0] - 1e-7))
        for (z, r), *beside in zip(ends.tolist(), *after):
            if r > 0 and min(abs(r - each) for each in beside) < 1e-6:
                edges.append([(z, 0.0), (z, -r)])
        for (z0, r0), (z1, r1), sweep in zip(ends.tolist(), np.roll(ends, -1, axis=0).tolist(), loop.sweeps.tolist()):
            if sweep or abs(r0 - r1) > 1e-9 or abs(z1 - z0) < LABELLED * span or r0 <= 0:
                continue
            middle = (z0 + z1) / 2
            if abs(float(part.at(middle)) - r0) < 1e-6:
                text = f"⌀{number(round(2 * r0 / unit.length, unit.decimals - 1))}"
                card = CARD | {"facecolor": OUTSIDE}
                ax.annotate(text, (middle, -r0 / 2), ha="center", va="center", fontsize=SMALL, bbox=card, zorder=3.0)
    ax.add_collection(LineCollection(edges, colors=colours.INK, linewidths=0.6, zorder=1.7))


def _colours(part: Turned, colour: str) -> list[tuple[str, str, list[Array]]]:
    """Name, colour and pieces of the outline by the tool or the line that cut them."""
    column = getattr(part.cutting.path, colour)
    found: dict[int, list[Array]] = {}
    for loop, rows in zip(part.section, part.rows):
        for k, row in enumerate(rows.tolist()):
            if row >= 0:
                element = Contour([loop.starts[k], loop.ends[k]], [loop.bulge[k], 0.0], closed=False)
                found.setdefault(int(column[row]), []).append(element.points_within(CHORD))
    values = sorted(found)
    shades = ramp(len(values))
    if len(values) <= FEW:
        return [(f"{colour} {value}", shade, found[value]) for value, shade in zip(values, shades)]
    groups = np.array_split(np.array(values), FEW)
    return [
        (f"{colour}s {group[0]} to {group[-1]}", shade, [piece for value in group.tolist() for piece in found[value]])
        for group, shade in zip(groups, ramp(FEW))
    ]


def told(part: Workpiece) -> str:
    """How a part was found, how exact it is, what was removed, and what is to be noted."""
    return "\n".join([f"{part.method}{part.error_told}; {_volume(part, part.removed)} removed", *part.notes])


def in_words(part: Workpiece) -> str:
    """What a person who cannot see the picture is told."""
    return f"the part: {_volume(part, part.volume)} left, {_volume(part, part.removed)} removed"


def _volume(part: Workpiece, volume: float) -> str:
    """A volume in mm³ with three decimals; of a program in inches in in³, with as many figures."""
    unit = part.cutting.path.unit
    return f"{volume:.3f} mm³" if unit.length == 1 else f"{volume / unit.length**3:.6g} {unit.short}³"
