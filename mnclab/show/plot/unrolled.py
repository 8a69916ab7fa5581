"""The path of a cylinder cycle on the developed surface: circumference to the right, in mm and degrees, the axis upwards.

What the tool sweeps of the surface is shaded, as wide as the tool: a slot stands out as the band that it is.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch
from matplotlib.path import Path as Outline
from matplotlib.ticker import MultipleLocator

from mnclab.geometry import shapely
from mnclab.path.cylinder import Cylinder
from mnclab.path.toolpath import Kind, Toolpath
from mnclab.show.plot import colours
from mnclab.show.plot.picture import SIZE, SMALL, VIEWS, Picture, arrange, dress, write_legend
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.strokes import Array, line_of, strokes
from mnclab.text.alarm import Alarm

SWATH = "swept by the tool"
ANGLES, MOST = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 45, 90, 180, 360), 9  # steps of degrees, how many at most
SEEN = 1e-6  # mm: shorter lines are the noise of turning, not moves


@sized()
def plot_unrolled(path: Toolpath, ax: Axes | None = None, size: tuple[float, float] = SIZE) -> Figure:
    """The rows of a path that lie on a cylinder, unrolled; of several cylinders the first one. An Alarm without any.

    `ax`: axes of one's own; `size`: the greatest width and height in inches.
    """
    if not path.cylinders:
        raise Alarm('view="unrolled" shows what lies on a cylinder, and no row does', hint="CYCL DEF 27, 28, 29 and 39 make some")
    one = path.cylinders[0]
    flat = path[path.cylinder == 0].unrolled()
    if len(flat) > 1 and flat.kind[0] == Kind.RAPID:  # from anywhere
        flat = flat[1:]
    view = VIEWS["XY"]._replace(unit=path.unit)
    swath = _swath(flat)
    corners = np.concatenate([flat.start, flat.end, *([_box(swath)] if swath is not None else [])])
    low, high = corners.min(axis=0) * (1, 1, 0), corners.max(axis=0) * (1, 1, 0)
    lines = [(colours.RAPID, line_of(flat, (Kind.RAPID,))), (colours.FEED, line_of(flat, (Kind.LINE, Kind.ARC)))]
    lines = [(look, xyz) for look, xyz in lines if np.nansum(np.abs(np.diff(xyz[:, :2], axis=0))) > SEEN]
    names = [*([SWATH] if swath is not None else []), *(look.name for look, _ in lines), colours.START.name, colours.END.name]
    alt = f"developed cylinder of radius {one.radius / path.unit.length:.4g} {path.unit.short}"
    figure: Any = None
    if ax is None:
        figure, (ax,) = arrange([view], low, high, names, None, alt, size, scale_above=True)  # of degrees
    else:
        dress(ax, view)
    artists: list[Any] = [Line2D(xyz[:, 0], xyz[:, 1], **look.style()) for look, xyz in lines]
    for mark, place in ((colours.START, flat.start[0]), (colours.END, flat.end[-1])):
        artists.append(Line2D([place[0]], [place[1]], **mark.style()))
    for artist in artists:
        ax.add_line(artist)
    if swath is not None:
        artists.insert(0, _shade(ax, swath))
    ax.set_xlabel(f"u along the circumference, {path.unit.short}", fontsize=SMALL + 1)
    ax.set_ylabel(f"y along the axis, {path.unit.short}", fontsize=SMALL + 1)
    if figure is None:
        ax.autoscale_view()
    _degrees(ax, one)
    if figure is None:
        return ax.figure  # type: ignore[return-value]
    picture: Picture = figure
    picture.seen = [(ax, view, flat, strokes(flat))]
    write_legend(picture, artists)
    return picture


def _swath(flat: Toolpath) -> Any:
    """What the tool sweeps at feed below the surface, as a shapely area; None for a tool without a radius."""
    cuts = (flat.kind == Kind.LINE) & (np.minimum(flat.start[:, 2], flat.end[:, 2]) < 0) & (flat.radius > 0)
    if not cuts.any():
        return None
    ways = np.stack([flat.start[cuts, :2], flat.end[cuts, :2]], axis=1)
    ways = np.unique(ways[np.hypot(*(ways[:, 1] - ways[:, 0]).T) > 0].round(6), axis=0)  # levels repeat them
    if not len(ways):
        return None
    return shapely.buffer(shapely.line_merge(shapely.multilinestrings(shapely.linestrings(ways))), float(flat.radius[cuts].max()))


def _box(area: Any) -> Array:
    """The corners (2, 3) of an area."""
    return np.column_stack([np.reshape(area.bounds, (2, 2)), np.zeros(2)])


def _shade(ax: Axes, area: Any) -> Patch:
    """Fill an area, its holes left open; the sample of the legend."""
    points, codes = [], []
    for polygon in shapely.get_parts(area):
        for ring in (polygon.exterior, *polygon.interiors):
            corners = np.asarray(ring.coords)
            points.append(corners)
            codes.append([Outline.MOVETO, *[Outline.LINETO] * (len(corners) - 2), Outline.CLOSEPOLY])
    look: dict[str, Any] = {"facecolor": colours.DISC, "alpha": 0.28, "edgecolor": "none", "label": SWATH}
    patch = PathPatch(Outline(np.concatenate(points), np.concatenate(codes)), zorder=1.2, **look)
    ax.add_artist(patch)  # whose limits, of all corners as of curves, would take long
    ax.update_datalim(np.reshape(area.bounds, (2, 2)))
    return Patch(**look)


def _degrees(ax: Axes, one: Cylinder) -> None:
    """A second scale above: the angle of the rotary axis."""
    per = np.degrees(1 / one.radius)
    above = ax.secondary_xaxis("top", functions=(lambda u: u * per, lambda angle: angle / per))
    low, high = ax.get_xlim()
    wide = (high - low) * per
    above.xaxis.set_major_locator(angle_steps(wide, MOST))
    above.set_xlabel(f"{'ABC'[one.rotary]}, degrees", fontsize=SMALL + 1)
    above.tick_params(labelsize=SMALL)


def angle_steps(wide: float, most: int) -> MultipleLocator:
    """Ticks of an axis of so many degrees, with `most` steps that people count angles in."""
    return MultipleLocator(next((each for each in ANGLES if wide <= most * each), 360 * math.ceil(wide / 360 / most)))
