"""The blank as it is clamped, from above and from the side: its sizes, the datum as a quartered circle, what holds it."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon
from matplotlib.path import Path

from mnclab.geometry.frames import shift
from mnclab.path.toolpath import Array
from mnclab.show.plot import colours
from mnclab.show.plot.datums import places_of
from mnclab.show.plot.material import draw_material
from mnclab.show.plot.picture import SMALL, VIEWS, Picture, View, arrange, write_legend
from mnclab.workpiece.blank import blank
from mnclab.workpiece.part import Part

LENGTH = "frame length"  # of a control that compensates the length of tools
SIZE = (6.8, 4.6)  # inches, at most
BLANK: dict[str, Any] = {"facecolor": "#f4f1e8", "edgecolor": "#8c8778", "linewidth": 1.0}
FIXTURE: dict[str, Any] = {"facecolor": "#d0d0d0", "edgecolor": "#6b6b6b", "linewidth": 0.8, "hatch": "////"}
QUARTERS = Path.make_compound_path(Path.wedge(0, 90), Path.wedge(180, 270))
ROOM = 0.2  # of the greatest side, around the blank for its dimensions
DIMENSION: dict[str, Any] = {"arrowstyle": "<|-|>", "color": colours.INK, "linewidth": 0.7, "mutation_scale": 7}
DIMENSION |= {"shrinkA": 0, "shrinkB": 0}


def zero_points(run: Any) -> list[tuple[str, Array]]:
    """The zero points of a program by name, (3,) mm in the coordinates of its path, each once; the nearest to the blank first."""
    found = [(each.name, np.array(each.xyz)) for each in places_of(run) if each.mark is colours.DATUM]
    if run.stock is not None:  # one that was active at power-on alone stands at the machine's zero, far away
        low, high = run.stock.bounds
        found.sort(key=lambda each: float(np.linalg.norm(np.fmax(np.fmax(low - each[1], each[1] - high), 0.0))))
    return found or [("zero", np.zeros(3))]


def plot_set_up(run: Any, size: tuple[float, float] = SIZE) -> Picture:
    """Views of a blank with its fixtures and zero points; of a lathe Z to the right and the diameter up."""
    stock, lathe, origin = run.stock, run.toolpath.lathe, np.array(run.toolpath.origin)
    views = [VIEWS["ZX"]] if lathe else [VIEWS["XY"], VIEWS["XZ"]]
    views = [view._replace(unit=run.toolpath.unit) for view in views]
    low, high = (np.array(each, dtype=float) for each in stock.bounds)
    room = ROOM * float((high - low).max())
    around = low - room, high + room
    if lathe:
        around[0][0], around[0][1] = 0.0, 0.0
    near = around[0] - room, around[1] + room
    places = [(name, xyz) for name, xyz in zero_points(run) if ((xyz >= near[0]) & (xyz <= near[1])).all()]
    for _, xyz in places:
        around = np.fmin(around[0], xyz - room / 2), np.fmax(around[1], xyz + room / 2)
    if lathe:
        around[0][0] = 0.0
    names = ["blank", *(["fixture"] if run.setup.fixtures else [])]
    said = f"set-up: blank {' x '.join(f'{side:.4g}' for side in (high - low).tolist())} mm"
    said += "".join(f", {name} at {' '.join(f'{axis}{v:.4g}' for axis, v in zip('XYZ', xyz.tolist()))}" for name, xyz in places)
    picture, axes = arrange(views, *around, names, None, said, size)
    for ax, view in zip(axes, views):
        for each in run.setup.fixtures:
            _body(ax, view, each, origin, FIXTURE)
        _body(ax, view, stock, None, BLANK)
        _dimensions(ax, view, low, high)
        for name, xyz in places:
            _datum(ax, view, name, xyz)
    artists = {"blank": Patch(**BLANK, label="blank"), "fixture": Patch(**FIXTURE, label="fixture")}
    write_legend(picture, [artists[name] for name in names])
    return picture


def _body(ax: Axes, view: View, body: Any, origin: Array | None, look: dict[str, Any]) -> None:
    """The outline of a blank, or of a fixture in machine coordinates."""
    if isinstance(body, Part):
        draw_material(ax, body, view, shift(*(origin if origin is not None else np.zeros(3))), 0.0)
        return
    found = blank(body)
    if found is None:
        return
    found = found if origin is None else found.moved(-origin)
    for outline in found.outline(view.right, view.up):
        points = np.maximum(outline, [-np.inf, 0]) if view.diameter else outline
        ax.add_patch(Polygon(np.asarray(points), **look, zorder=0.8 if look is FIXTURE else 1.0))


def _dimensions(ax: Axes, view: View, low: Array, high: Array) -> None:
    """The length of the blank below it and its height to the right, with dimension lines as on drawings."""
    unit, (a, b) = view.unit, (view.right, view.up)
    off = ROOM * 0.45 * float((high - low).max())
    x0, x1, y0, y1 = low[a], high[a], max(low[b], 0.0) if view.diameter else low[b], high[b]
    across = f"{unit.figure(x1 - x0, 1)}"
    up = f"⌀{unit.figure(2 * y1, 1)}" if view.diameter else unit.figure(y1 - y0, 1)
    y = y1 + off if view.diameter else y0 - off
    thin: dict[str, Any] = {"color": colours.INK, "linewidth": 0.4}
    if view.up != 2:  # the view from the side has the same length
        ax.annotate("", (x0, y), (x1, y), arrowprops=DIMENSION, annotation_clip=False)
        ax.annotate(across, ((x0 + x1) / 2, y), (0, 2), textcoords="offset points", ha="center", va="bottom", fontsize=SMALL)
        for x in (x0, x1):
            ax.add_line(Line2D([x, x], [y1 if view.diameter else y0, y + (0.15 if view.diameter else -0.15) * off], **thin))
    ax.annotate("", (x1 + off, y0), (x1 + off, y1), arrowprops=DIMENSION, annotation_clip=False)
    ax.annotate(
        up, (x1 + off, (y0 + y1) / 2), (-2, 0), textcoords="offset points", ha="right", va="center", fontsize=SMALL, rotation=90,
    )  # fmt: skip
    for h in (y0, y1):
        ax.add_line(Line2D([x1, x1 + 1.15 * off], [h, h], **thin))


def _datum(ax: Axes, view: View, name: str, xyz: Array) -> None:
    """The symbol of a zero point: a circle with two quarters filled, and its name."""
    x, y = xyz[view.right], xyz[view.up]
    for order, marker, fill, edge in ((4.0, "o", colours.PAPER, 1.0), (4.1, QUARTERS, colours.INK, 0.0)):
        look: dict[str, Any] = {"marker": marker, "markerfacecolor": fill, "markeredgewidth": edge}
        look |= {"markeredgecolor": colours.INK}
        ax.add_line(Line2D([x], [y], linestyle="none", markersize=11, zorder=order, **look))
    card: dict[str, Any] = {"facecolor": colours.PAPER, "edgecolor": "none", "pad": 0.6, "alpha": 0.85}
    below = view.diameter and y <= 0.0  # there the blank ends, and a dimension stands to the right
    off, side = ((0, -9), "center") if below else ((8, 8), "left")
    where: dict[str, Any] = {"textcoords": "offset points", "ha": side, "va": "top" if below else "baseline"}
    ax.annotate(name, (x, y), off, fontsize=SMALL, zorder=4.2, bbox=card, **where)
