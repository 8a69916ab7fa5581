"""The holes of a run at their diameter, and those of two programs compared.

From above they are circles with a centre cross, from the side dashed walls.

What a hole is says `path.holes`. Walls begin at the top of the blank, or where nobody has said where that is at the height
from which the tool goes at feed; a hole that does not reach into the blank is not drawn, and one that a point makes is as
wide as the point there.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection
from matplotlib.lines import Line2D

from mnclab.path.listing import Unit
from mnclab.path.toolpath import Array, Kind, Mask, Toolpath
from mnclab.show import looks
from mnclab.show.plot import colours
from mnclab.show.plot.overlay import Overlay, across, grown, line
from mnclab.show.plot.picture import SIZE, VIEWS, Foot, Picture, View, arrange, write_legend
from mnclab.show.plot.sizes import sized

POINTED = ("", "drill", "countersink")
MOST, LOOKED = 2000, 20_000  # holes of a picture; places looked at
CROSS = 1.3  # of the radius: how far the centre lines of a hole go
SAME = 1e-4  # mm: holes at one place


class Hole(NamedTuple):
    """Its axis, the heights of mouth, end of the wall and tip, and its radius at the mouth, all mm."""

    x: float
    y: float
    top: float
    wall: float
    tip: float
    radius: float


class Diameter(NamedTuple):
    """The holes of one diameter: their name in the legend, their colour, and points of its sample there."""

    name: str
    holes: list[Hole]
    shade: str
    sample: float


#: How up to five diameters are told apart, in grey print by the size of their samples.
LOOK = ((colours.HOLE.colour, 5.0), ("#ad1457", 6.0), ("#00838f", 7.0), ("#6d7b00", 8.0), ("#5b4bb5", 9.0))


class Holes(NamedTuple):
    """The holes of a run, and the unit that it counts in."""

    holes: list[Hole]
    unit: Unit

    def box(self, low: Array, high: Array) -> tuple[Array, Array]:
        around = [(h.x + s * CROSS * h.radius, h.y + s * CROSS * h.radius, h.tip) for h in self.holes for s in (1, -1)]
        return grown(low, high, np.array([np.min(around, axis=0), np.max(around, axis=0)]))

    def names(self, views: Sequence[View]) -> list[str]:
        return [kind.name for kind in self._kinds] if any(2 in (view.up, across(view)) for view in views) else []

    @property
    def _kinds(self) -> list[Diameter]:
        """The holes by diameter, small ones first; all of them together, from the least to the greatest, where those are many."""
        kinds: dict[str, list[Hole]] = {}
        for hole in sorted(self.holes, key=lambda each: each.radius):
            kinds.setdefault(f"hole \N{DIAMETER SIGN}{self.unit.figure(2 * hole.radius, 1)}", []).append(hole)
        if len(names := [*kinds]) > len(LOOK):
            kinds = {f"{names[0]} to {names[-1].removeprefix('hole ')}": self.holes}
        return [Diameter(name, holes, *look) for (name, holes), look in zip(kinds.items(), LOOK)]

    def hides(self, view: View, places: Array) -> Mask:
        """Which places (n, 2) of a view from above are the middle of a hole, and need no mark of their own."""
        if across(view) != 2 or not len(places):
            return np.zeros(len(places), bool)
        middles = np.array([(hole.x, hole.y) for hole in self.holes])
        order = np.lexsort(middles.T)
        known = {tuple(each) for each in np.round(middles[order] / SAME).astype(np.int64).tolist()}
        return np.array([tuple(each) in known for each in np.round(places / SAME).astype(np.int64).tolist()], bool)

    def draw(self, ax: Axes, view: View) -> list[Any]:
        drawn: list[Any] = []
        for kind in self._kinds if 2 in (across(view), view.up) else []:
            (_from_above if across(view) == 2 else _from_the_side)(ax, view, kind)
            style: dict[str, Any] = {"marker": "o", "markerfacecolor": "none", "markersize": kind.sample, "color": kind.shade}
            drawn.append(Line2D([], [], **style, linestyle="none", label=kind.name))
        return drawn

    def write(self, ax: Axes, view: View, lines: Sequence[Array]) -> None:
        return None


def _from_above(ax: Axes, view: View, kind: Diameter) -> None:
    middles, radii = np.array([hole[:2] for hole in kind.holes]), np.array([hole.radius for hole in kind.holes])
    _circles(ax, middles, 2 * radii, edgecolors=kind.shade, linewidths=1.2, zorder=colours.HOLE.order, label="_holes")
    ends = np.array([[(-1, 0), (1, 0), (np.nan, np.nan), (0, -1), (0, 1), (np.nan, np.nan)]])
    crosses = middles[:, None] + CROSS * radii[:, None, None] * ends
    look = {**colours.CENTRE_LINE.style(), "zorder": colours.HOLE.order, "label": "_hole centres", "linewidth": 0.6}
    ax.add_line(Line2D(*crosses.reshape(-1, 2).T, **look))


def _circles(ax: Axes, middles: Array, diameters: Array, **look: Any) -> None:
    none = np.zeros(len(middles))
    look |= {"units": "xy", "offsets": middles, "offset_transform": ax.transData, "facecolors": "none"}
    ax.add_collection(EllipseCollection(diameters, diameters, none, **look), autolim=False)


def _from_the_side(ax: Axes, view: View, kind: Diameter) -> None:
    seen = np.unique([(hole[view.right], *hole[2:]) for hole in kind.holes], axis=0)
    place, top, wall, tip, radius = seen.T
    left, right, none = place - radius, place + radius, np.full(len(seen), np.nan)
    across_ = np.stack([left, left, place, right, right, none, left, right, none], axis=1)
    heights = np.stack([top, wall, tip, wall, top, none, wall, wall, none], axis=1)
    points = np.full((across_.size, 3), np.nan)
    points[:, view.right], points[:, 2] = across_.ravel(), heights.ravel()
    line(ax, view, points, colours.HOLE._replace(colour=kind.shade), label="_holes")


def holes_of(run: Any) -> Holes | None:
    """The holes of a run; None without any, on a lathe, or with more than a picture has room for."""
    path: Toolpath = run.toolpath
    down = (path.kind == Kind.LINE) & (path.end[:, 2] < path.start[:, 2]) & (path.start[:, :2] == path.end[:, :2]).all(axis=1)
    if path.lathe or len(np.unique(np.round(path.end[down, :2] / SAME), axis=0)) > LOOKED:
        return None
    made, (tools, _), stock = run.holes(), run.tools_that_cut, run.stock
    top = float(stock.bounds[1, 2]) if stock is not None else math.inf
    found = []
    for each, row in zip(made, made.first):
        tool, radius = tools.get(each.tool), each.diameter / 2
        pointed = path.kind[row] == Kind.LINE and tool is not None and tool.kind in POINTED and 0 < tool.angle < 180
        slope = math.tan(math.radians(tool.angle / 2)) if tool and pointed else math.inf
        mouth, tip = min(top, each.top), each.bottom
        if pointed and stock is not None:
            radius = min(radius, (mouth - tip) * slope)
        elif path.labels[path.label[row]].endswith((" centre", " countersink")):
            continue  # how wide it becomes is known with the height of the blank alone
        if radius > 0 and mouth > tip:
            found.append(Hole(each.x, each.y, mouth, min(mouth, tip + radius / slope), tip, radius))
    found = _widest(found)
    return Holes(found, path.unit) if 0 < len(found) <= MOST else None


def _widest(holes: list[Hole]) -> list[Hole]:
    """A hole that is drilled twice with one diameter is one hole: the deepest."""
    found: dict[tuple[float, ...], Hole] = {}
    for hole in holes:
        key = round(hole.x / SAME), round(hole.y / SAME), round(hole.radius / SAME)
        known = found.get(key)
        if known is None or known.tip > hole.tip:
            found[key] = hole
    return list(found.values())


def beside_holes(overlays: Sequence[Overlay], view: View, places: Array) -> Array:
    """Those of some places (m, 2) in a view that are not the middle of a hole."""
    for over in overlays:
        if isinstance(over, Holes):
            places = places[~over.hides(view, places)]
    return places


LOOKS: tuple[tuple[str, str, Any, float], ...] = (
    ("in both", looks.GREY, "-", 1.6), ("only in {}", colours.ALARM.colour, "-", 2.2), ("only in {}", looks.BLUE, "--", 2.2),
)  # fmt: skip
POINT = 0.01  # of the picture: how wide a hole is whose diameter nobody knows


@sized()
def plot_holes(found: Any, size: tuple[float, float] = SIZE) -> Picture:
    """Circles at their diameters with a cross; grey those of both, red and blue dashed those of one."""
    every = [found.both, *found.only]
    rows = np.concatenate(every)
    low, high = np.zeros(3), np.zeros(3)
    if len(rows):
        half = rows[:, 2:] / 2
        low[:2], high[:2] = (rows[:, :2] - half).min(axis=0), (rows[:, :2] + half).max(axis=0)
    least = POINT * max(float((high - low).max()), 1e-3)
    labels = [label.format(name) for (label, *_), name in zip(LOOKS, ("", *found.names))]
    shown = [label for label, holes in zip(labels, every) if len(holes)]
    picture, (ax,) = arrange([VIEWS["XY"]], low, high, shown, Foot(found.sentence), f"holes: {found.sentence}", size)
    handles = []
    for (_, shade, dash, wide), label, holes in zip(LOOKS, labels, every):
        if not len(holes):
            continue
        across = np.where(holes[:, 2] > 0, holes[:, 2], least)
        _circles(ax, holes[:, :2], across, edgecolors=shade, linewidths=wide, linestyles=dash)
        ax.plot(holes[:, 0], holes[:, 1], "+", color=shade, markersize=5)
        handles.append(Line2D([], [], color=shade, linestyle=dash, linewidth=wide, label=label))
    write_legend(picture, handles)
    return picture
