"""What one view of a tool path shows, layer by layer: lines, marks, crosses, the part; then what depends on the scale."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Polygon

from mnclab.path.toolpath import Kind, Toolpath
from mnclab.show.felt import Felt
from mnclab.show.plot import arrows as heads
from mnclab.show.plot import colours
from mnclab.show.plot.beside import beside
from mnclab.show.plot.classes import Classes
from mnclab.show.plot.colours import Line, Mark
from mnclab.show.plot.datums import Place, crosses, segments, write_names
from mnclab.show.plot.felt import draw_felt
from mnclab.show.plot.holes import beside_holes
from mnclab.show.plot.lathe import Lathe, draw_blank, draw_chucks, draw_insert
from mnclab.show.plot.once import once
from mnclab.show.plot.overlay import Overlay
from mnclab.show.plot.picture import View
from mnclab.show.plot.strokes import Array, Strokes, parted
from mnclab.show.plot.symbols import spread
from mnclab.show.plot.under import draw_under
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.workpiece import Workpiece

MARKS = {Kind.DWELL: colours.DWELL, Kind.TOOL: colours.TOOL, Kind.STOP: colours.STOP}
MANY, SMALL, THIN = 30, 4.0, 0.7  # plunges; points of the crosses of more: those of an engraving would cover its letters
INSERT = 0.09  # edges of an insert, of the greatest side of the picture


class Drawing(NamedTuple):
    """What is drawn of a path in every view: lines (m, 3) broken by nan, marks (m, 3), crosses with names."""

    strokes: Strokes
    classes: Classes
    lines: list[tuple[Line, Array]]
    marks: list[tuple[Mark, Array]]
    places: list[Place]
    plunges: dict[View, Array]
    plunge: Mark
    arrows: bool
    stock: Blank | None
    lathe: Lathe | None
    part: Workpiece | None
    home: bool
    felt: Felt | None
    overlays: Sequence[Overlay] = ()

    def seen(self, mark: Mark, view: View) -> Array:
        """Where a mark stands in a view (m, 2); a hole that is seen from above needs none for its dwell."""
        found = np.concatenate([xyz[:, [view.right, view.up]] for one, xyz in self.marks if one is mark])
        return beside_holes(self.overlays, view, found) if mark is colours.DWELL else found


def marks_of(path: Toolpath, stopped: bool, home: bool, gouged: Array | None = None) -> list[tuple[Mark, Array]]:
    """Marks and where they stand (m, 3); a path alone knows only in which rows it cuts into its contour."""
    found = [(mark, path.end[path.kind == kind]) for kind, mark in MARKS.items()]
    found += [(colours.GOUGED, path.end[path.gouge] if gouged is None else gouged)]
    found += [(colours.HOME if home else colours.START, path.start[:1])]
    found += [(colours.ALARM if stopped else colours.END, path.end[-1:])]
    return [(mark, places) for mark, places in found if len(places)]


def plunges_of(path: Toolpath, view: View) -> Array:
    """Where cuts go down along the tool and the line of sight, and would be invisible (m, 2)."""
    rows = np.flatnonzero(path.start[:, view.right] == path.end[:, view.right])
    rows = rows[(path.start[rows, view.up] == path.end[rows, view.up]) & (path.kind[rows] == Kind.LINE)]
    rows = rows[(np.abs(path.axis[rows][:, [view.right, view.up]]) < 1e-9).all(axis=1)]
    deep = 3 - view.right - view.up
    above = path.axis[rows, deep] if deep != 2 else 1.0  # a spindle stands above the table
    rows = rows[(path.end[rows, deep] - path.start[rows, deep]) * above < 0]
    return np.unique(path.end[rows][:, [view.right, view.up]], axis=0)


def draw_stock(ax: Axes, view: View, stock: Blank) -> list[Line2D]:
    """Fill the blank behind everything; returns its outlines, which are not added yet. A lathe's picture ends at its axis."""
    found = []
    for outline in stock.outline(view.right, view.up):
        line = np.maximum(outline, [-np.inf, 0]) if view.diameter else outline
        ax.add_patch(Polygon(line, facecolor=colours.BLANK_FACE, edgecolor="none", zorder=0.5, label="_blank"))
        found.append(Line2D(line[:, 0], line[:, 1], **colours.BLANK.style()))
    return found


def draw(ax: Axes, view: View, drawing: Drawing) -> list[Line2D]:
    """Add lines, marks and crosses to an axes; returns those that a legend names."""
    artists = [Line2D(xyz[:, view.right], xyz[:, view.up], **line.style()) for line, xyz in drawing.lines]
    artists += draw_stock(ax, view, drawing.stock) if drawing.stock else []
    plunges = drawing.plunges[view]
    if len(plunges):
        small = {"markersize": SMALL, "markeredgewidth": THIN} if len(plunges) > MANY else {}
        artists.append(Line2D(plunges[:, 0], plunges[:, 1], **drawing.plunge.style() | small))
    artists += [Line2D(*drawing.seen(mark, view).T, **mark.style()) for mark, _ in drawing.marks]
    artists += crosses(drawing.places, view)
    for artist in artists:
        ax.add_line(artist)
    artists += [artist for over in drawing.overlays for artist in over.draw(ax, view)]
    if drawing.part is not None:
        draw_under(ax, view, drawing.part)
    elif drawing.lathe is not None:
        draw_blank(ax, drawing.lathe)
    if drawing.lathe is not None:
        draw_chucks(ax, drawing.lathe.chucks)
    if view.diameter:
        ax.axhline(0.0, **{**colours.CENTRE_LINE.style(), "label": "_centre line"})
    return artists


def write(ax: Axes, view: View, drawing: Drawing, low: Array, high: Array) -> None:
    """Add what depends on the scale: rapids beside cuts, symbols beside each other, arrowheads and names."""
    axes = [view.right, view.up]
    moved, divided = beside(ax, drawing.strokes, drawing.classes, axes)
    for line in ax.lines:
        if line.get_label() == colours.RAPID.name:
            line.set_data(*once(ax, moved, divided, axes).T)
    occupied = [xyz[:, axes] for mark, xyz in drawing.marks if mark is colours.TOUCH]
    strokes = parted(moved.xyz, np.minimum(divided.group, 0), 1)
    if drawing.home:
        strokes.append(heads.arrival(view, drawing.strokes.xyz[0], float((high - low).max())))
    occupied.append(spread(ax, list(ax.lines), *segments(ax, view, strokes)))
    if drawing.home:
        heads.draw_arrival(ax, view, drawing.strokes.xyz[0], float((high - low).max()))
    if drawing.felt is not None:
        draw_felt(ax, view, drawing.felt, [xyz for _, xyz in drawing.lines], [xyz for _, xyz in drawing.marks])
    if drawing.lathe is not None:
        draw_insert(ax, drawing.lathe, INSERT * float((high - low).max()))
    if drawing.arrows:
        occupied.append(heads.draw(ax, view, moved, divided, low, high))
    for over in drawing.overlays:
        over.write(ax, view, [xyz for _, xyz in drawing.lines])
    if drawing.places:
        around = np.concatenate([np.empty((0, 2)), *occupied])
        write_names(ax, view, drawing.places, around, [xyz for _, xyz in drawing.lines])
