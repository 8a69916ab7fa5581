"""Arrowheads that say which way the tool goes: a few a path, on long moves, all of them one artist."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.path import Path
from matplotlib.transforms import Affine2D, IdentityTransform
from numpy.typing import NDArray

from mnclab.show.plot import colours
from mnclab.show.plot.classes import Classes
from mnclab.show.plot.picture import View
from mnclab.show.plot.strokes import Array, Strokes

MANY = 300  # moves of a path beyond which arrows say nothing and are not drawn
MOST = 16  # arrows in one view
LONG, APART, CLEAR = 0.1, 0.4, 0.06  # of the view's greatest side: a move with an arrow, way between two, distance
HEAD = Path([(0.55, 0.0), (-0.45, 0.4), (-0.2, 0.0), (-0.45, -0.4), (0.55, 0.0)], closed=True)
SIZE = 8.0  # points
ARRIVAL = 0.07  # of the view's greatest side: the way that is drawn from home


def draw(ax: Axes, view: View, drawn: Strokes, found: Classes, low: Array, high: Array) -> Array:
    """Add the arrowheads of one view that lie in its box `low` to `high` (3,), mm; returns their places (n, 2)."""
    axes = [view.right, view.up]
    at, angle, look = places(drawn.xyz[:, axes], drawn.row, found.group, low[axes], high[axes])
    if len(at):
        heads = [HEAD.transformed(Affine2D().rotate(each)) for each in angle]
        looks = [found.lines[k] for k in look]  # divided cuts may lie on each other: their heads take no side
        plain = (colours.RAPID, colours.PROBING, colours.FEED)
        shades = [line.colour if line in plain else colours.INK for line in looks]
        artist = PathCollection(
            heads, sizes=[SIZE**2], offsets=at, offset_transform=ax.transData, facecolors=shades,
            edgecolors=colours.PAPER, linewidths=0.5, zorder=3.3, label="_arrows",
        )  # fmt: skip
        artist.set_transform(IdentityTransform())
        ax.add_collection(artist, autolim=False)
    return at


def places(
    xy: Array, row: NDArray[np.int64], group: NDArray[np.int16], low: Array, high: Array
) -> tuple[Array, Array, list[int]]:
    """Where arrows stand (n, 2), their angles (n,) rad and classes; points (m, 2) and their rows and classes (m,)."""
    found: list[tuple[Array, float, int]] = []
    size = float((high - low).max())
    limits = np.append(np.flatnonzero(np.diff(row, prepend=-1) != 0), len(row))
    moves = np.stack([limits[:-1], limits[1:]], axis=1)[row[limits[:-1]] >= 0]
    if size > 0:
        last, since = -1, 0.0
        for first, after in moves.tolist():
            steps = np.diff(xy[first - 1 : after], axis=0)
            way = np.cumsum(np.hypot(*steps.T))
            since = since + way[-1] if group[first] == last else np.inf
            last = group[first]
            if way[-1] < LONG * size or since < APART * size:
                continue
            k = int(np.searchsorted(way, way[-1] / 2))
            share = (way[-1] / 2 - (way[k - 1] if k else 0.0)) / (way[k] - (way[k - 1] if k else 0.0))
            middle = xy[first - 1 + k] + share * steps[k]
            inside = ((middle >= low) & (middle <= high)).all()
            if inside and all(np.hypot(*(middle - other)) > CLEAR * size for other, _, _ in found):
                found.append((middle, float(np.arctan2(steps[k, 1], steps[k, 0])), int(group[first])))
                since = 0.0
    keep = np.unique(np.linspace(0, len(found) - 1, min(MOST, len(found))).round().astype(int))
    at, angle, look = ([found[k][column] for k in keep] for column in range(3))
    return np.array(at).reshape(-1, 2), np.array(angle), look


def arrival(view: View, place: Array, size: float) -> Array:
    """A short way (2, 3) to a place (3,) from home: from above, on a lathe from the right too."""
    home = place.copy()
    home[[view.right, view.up]] += ARRIVAL * size * np.array([1.0 if view.diameter else 0.0, 1.0])
    return np.stack([home, place])


def draw_arrival(ax: Axes, view: View, place: Array, size: float) -> None:
    """The way to a place (3,) from home; seen from above there is none."""
    if 2 not in (view.right, view.up):
        return
    home, end = arrival(view, place, size)[:, [view.right, view.up]].tolist()
    look = {"arrowstyle": "-|>", "color": colours.RAPID.colour, "linewidth": 1.2, "linestyle": (0, (3, 1.5)), "shrinkB": 4}
    ax.annotate("", end, home, arrowprops=look, zorder=3.3, annotation_clip=False)
