"""Where texts and symbols stand so that none covers another, or a mark."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PathCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.path import Path
from matplotlib.transforms import Affine2D, IdentityTransform
from numpy.typing import NDArray

from mnclab.show.plot import colours
from mnclab.show.plot.classes import Classes
from mnclab.show.plot.datums import crossing
from mnclab.show.plot.picture import SMALL, View
from mnclab.show.plot.strokes import Array, Strokes

# Texts beside their places; one without a free place is left out.

DISTANCES = (7.0, 12.0, 18.0, 26.0, 36.0, 50.0, 66.0)  # points from the edge of a mark to that of its text
TURNS = 16
MARK = 4.0  # points from the middle of another mark to its edge
APART = 4.0  # points between two texts
LINE_COST, BEND_COST = 1.0, 5.0  # of a point of a line under a text, of a text on another side than the one wished
FONT = SMALL - 0.5
CARD = {"boxstyle": "round,pad=0.12", "facecolor": "#ffffffd8", "edgecolor": "none"}


def write_beside(
    ax: Axes, texts: Sequence[Sequence[str]], places: Array, radii: Sequence[float], wishes: Array, lines: Sequence[Array],
    colour: str | Sequence[str] = colours.INK, marks: Array | None = None,
) -> int:  # fmt: skip
    """Write one of the `texts` of each place (n, 2) beside its mark: the first that has room; returns how many have none.

    `radii` are those of the marks in mm, `wishes` (n, 2) the directions in which a text stands best, `lines` what it should
    rather not cover, `marks` (m, 2) what it must not; `colour` is one for all or one for each. The limits of the axes must
    be those of the finished picture.
    """
    figure = ax.get_figure(root=True)
    assert isinstance(figure, Figure)
    pixels = figure.dpi / 72
    spots = ax.transData.transform(places) / pixels
    unit = float(np.hypot(*(ax.transData.transform([[1.0, 0.0]]) - ax.transData.transform([[0.0, 0.0]]))[0])) / pixels
    discs = np.asarray(radii, dtype=float) * unit
    frame = np.asarray(ax.get_window_extent().extents) / pixels + (APART, APART, -APART, -APART)
    drawn = np.vstack([np.empty((0, 2)), *(ax.transData.transform(line) / pixels for line in lines)])
    taken = np.column_stack([spots - discs[:, None], spots + discs[:, None]])  # boxes: left, below, right, above
    if marks is not None and len(marks):
        others = ax.transData.transform(marks) / pixels
        taken = np.vstack([taken, np.column_stack([others - MARK, others + MARK])])
    for other in ax.texts:
        if other.get_text():
            taken = np.vstack([taken, np.ravel(other.get_window_extent().extents) / pixels])
    left_out = 0
    inks = [colour] * len(spots) if isinstance(colour, str) else colour
    for spot, disc, wish, choices, ink in zip(spots, discs, wishes, texts, inks):
        written = False
        for text in choices:
            label = ax.annotate(
                text, (0, 0), (0, 0), textcoords="offset points", fontsize=FONT, color=ink, va="center", ha="center",
                zorder=6, annotation_clip=False, bbox=CARD,
            )  # fmt: skip
            label.set_parse_math(False)
            box = label.get_window_extent()
            half = np.array([box.width, box.height]) / pixels / 2 + APART / 2
            middle = _free(spot, disc, half, wish, taken, frame, drawn)
            if middle is None:
                label.remove()
                continue
            label.xy = tuple(ax.transData.inverted().transform(spot * pixels))
            label.set_position(tuple(middle - spot))
            taken = np.vstack([taken, [*(middle - half), *(middle + half)]])
            drawn = np.vstack([drawn, _lead(ax, spot, disc, middle, half, pixels, ink)])
            written = True
            break
        left_out += not written
    return left_out


def _free(spot: Array, disc: float, half: Array, wish: Array, taken: Array, frame: Array, drawn: Array) -> Array | None:
    """The middle of the best free box beside a spot, in points; None if there is none."""
    turn = np.arange(TURNS) * (2 * math.pi / TURNS)
    way = np.tile(np.column_stack([np.cos(turn), np.sin(turn)]), (len(DISTANCES), 1))
    reach = (half / np.maximum(np.abs(way), 1e-9)).min(axis=1)  # from middle to edge
    away = np.repeat(DISTANCES, TURNS) + reach
    middle = spot + way * (disc + away)[:, None]
    low, high = middle - half, middle + half
    free = ((low >= frame[:2]) & (high <= frame[2:])).all(axis=1)
    free &= ~((low[:, None] < taken[:, 2:]) & (high[:, None] > taken[:, :2])).all(axis=2).any(axis=1)
    under = [((drawn > low[k]) & (drawn < high[k])).all(axis=1).sum() if free[k] else 0 for k in range(len(free))]
    cost = away - reach * 0.75 + LINE_COST * np.minimum(under, 30) + BEND_COST * (1 - way @ wish)
    best = int(np.argmin(np.where(free, cost, math.inf)))
    return middle[best] if free[best] else None


def _lead(ax: Axes, spot: Array, disc: float, middle: Array, half: Array, pixels: float, colour: str) -> Array:
    """A thin line from the edge of the mark to the nearest place of the text's box; points (n, 2) of it."""
    end = np.clip(spot, middle - half + APART / 2, middle + half - APART / 2)
    size = float(np.hypot(*(end - spot)))
    if size - disc < 3:
        return np.empty((0, 2))
    ends = np.array([spot + (end - spot) * disc / size, end])
    line = ax.transData.inverted().transform(ends * pixels)
    ax.plot(*line.T, color=colour, linewidth=0.6, zorder=5.5, scalex=False, scaley=False, label="_leader")
    return dense(ends, 1.0)


def dense(points: Array, step: float) -> Array:
    """Points (n, 2) along strokes (m, 2), which are broken by nan, at most a `step` apart."""
    way = np.diff(points, axis=0)
    count = np.ceil(np.nan_to_num(np.hypot(*way.T)) / step).astype(int)
    k = np.repeat(np.arange(len(count)), count)
    share = (np.arange(len(k)) - np.repeat(np.cumsum(count) - count, count)) / count[k]
    return np.asarray(points[k] + share[:, None] * way[k])


# Symbols that fall on one spot of a view are spread: one stays, the others stand around it, each at the end of a leader.
# The datum keeps its place, and what says where the path is worked before what says how it begins and ends.

#: Who stays, the first of these that is there; what is not named here stands where it is in any case.
STAYS = ("datum", "machine zero", "pole", "plunge", "stop", "dwell", "tool change", "alarm", "end", "start", "from home")
ONE_SPOT, REACH, TURNED = 7.0, 11.0, 50.0  # points between symbols on one spot; to one that is moved; degrees between two
MANY, GROUPS = 400, 12  # symbols that are looked at; spots on which more than the ends of the path are spread
ENDS = (colours.START.name, colours.HOME.name, colours.END.name, colours.ALARM.name)


def spread(ax: Axes, artists: list[Line2D], begin: Array, end: Array) -> Array:
    """Move symbols apart (each artist has those of one kind); returns where all stand (n, 2), in data.

    `begin`, `end` (m, 2) are strokes in pixels, which leaders avoid. The limits of the axes must be final.
    """
    kinds = {str(artist.get_label()).lstrip("_"): artist for artist in artists}
    kinds = {kind: artist for kind, artist in kinds.items() if kind in STAYS}
    xy: dict[str, Array] = {kind: np.array(artist.get_xydata()) for kind, artist in kinds.items()}
    named = [(kind, k) for kind in STAYS if kind in xy for k in range(len(xy[kind]))]
    figure = ax.get_figure(root=True)
    if not 1 < len(named) <= MANY or figure is None:
        return np.concatenate([np.empty((0, 2)), *xy.values()])
    point = figure.dpi / 72
    at = ax.transData.transform([xy[kind][k] for kind, k in named])
    spots = [spot for spot in _spots(at, ONE_SPOT * point) if len({named[k][0] for k in spot}) > 1]
    if len(spots) > GROUPS:
        spots = [spot for spot in spots if any(named[k][0] in ENDS for k in spot)]
    leaders = []
    for spot in spots:
        first, *others = dict.fromkeys(named[k][0] for k in spot)
        place = at[next(k for k in spot if named[k][0] == first)]
        angles = _free_angles(place, len(others), ax.bbox.extents, begin, end, point)
        for kind, angle in zip(others, angles):
            there = place + REACH * point * np.array([np.cos(angle), np.sin(angle)])
            same = [k for k in spot if named[k][0] == kind]
            xy[kind][[named[k][1] for k in same]] = ax.transData.inverted().transform(there)
            at[same] = there
            leaders.append(ax.transData.inverted().transform([place, there]))
    for kind, artist in kinds.items():
        artist.set_data(*xy[kind].T)
    if leaders:
        line = colours.LEADER
        look: dict[str, Any] = {"colors": line.colour, "linewidths": line.width, "zorder": line.order, "label": line.name}
        ax.add_collection(LineCollection(leaders, **look), autolim=False)
    return np.concatenate(list(xy.values()))


def _spots(at: Array, near: float) -> list[list[int]]:
    """Numbers of points (n, 2) that lie within `near` of the first of them."""
    left, found = list(range(len(at))), []
    while left:
        away = np.hypot(*(at[left] - at[left[0]]).T)
        found.append([k for k, far in zip(left, away) if far < near])
        left = [k for k, far in zip(left, away) if far >= near]
    return found


def _free_angles(place: Array, count: int, box: Sequence[float], begin: Array, end: Array, point: float) -> Array:
    """Directions (count,), rad, of a fan from a place that has room in the box and crosses the fewest strokes."""
    apart = np.radians(min(TURNED, 360 / (count + 1)))
    fan = (np.arange(count) - (count - 1) / 2) * apart
    low, high = np.array(box[:2]), np.array(box[2:])
    best, least = fan, np.inf
    for middle in np.radians(np.arange(45, 405, 15)):
        there = place + REACH * point * np.stack([np.cos(middle + fan), np.sin(middle + fan)], axis=1)
        outside = int(((there < low + 6 * point) | (there > high - 6 * point)).any(axis=1).sum())
        half = 5 * point
        met = sum(crossing(np.concatenate([one - half, one + half]), begin, end) for one in there)
        if (cost := 1000 * outside + met) < least:
            best, least = middle + fan, cost
    return best


# Arrowheads that say which way the tool goes: a few a path, on long moves, all of them one artist.

MANY_MOVES = 300  # moves of a path beyond which arrows say nothing and are not drawn
MOST_HEADS = 16  # arrows in one view
LONG, ARROWS_APART, CLEAR = 0.1, 0.4, 0.06  # of the view's greatest side: a move with an arrow, way between two, distance
HEAD = Path([(0.55, 0.0), (-0.45, 0.4), (-0.2, 0.0), (-0.45, -0.4), (0.55, 0.0)], closed=True)
SIZE = 8.0  # points
ARRIVAL = 0.07  # of the view's greatest side: the way that is drawn from home


def draw_heads(ax: Axes, view: View, drawn: Strokes, found: Classes, low: Array, high: Array) -> Array:
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
            if way[-1] < LONG * size or since < ARROWS_APART * size:
                continue
            k = int(np.searchsorted(way, way[-1] / 2))
            share = (way[-1] / 2 - (way[k - 1] if k else 0.0)) / (way[k] - (way[k - 1] if k else 0.0))
            middle = xy[first - 1 + k] + share * steps[k]
            inside = ((middle >= low) & (middle <= high)).all()
            if inside and all(np.hypot(*(middle - other)) > CLEAR * size for other, _, _ in found):
                found.append((middle, float(np.arctan2(steps[k, 1], steps[k, 0])), int(group[first])))
                since = 0.0
    keep = np.unique(np.linspace(0, len(found) - 1, min(MOST_HEADS, len(found))).round().astype(int))
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
    ax.annotate("", end, home, arrowprops=look | {"clip_box": ax.bbox}, zorder=3.3)  # none where the place is cut off
