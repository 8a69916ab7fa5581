"""Symbols that fall on one spot of a view are spread: one stays, the others stand around it, each at the end of a leader.

The datum keeps its place, and what says where the path is worked before what says how it begins and ends.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.lines import Line2D

from mnclab.show.plot import colours
from mnclab.show.plot.datums import crossing
from mnclab.show.plot.strokes import Array

#: Who stays, the first of these that is there; what is not named here stands where it is in any case.
STAYS = ("datum", "machine zero", "pole", "plunge", "stop", "dwell", "tool change", "alarm", "end", "start", "from home")
ONE_SPOT, REACH, APART = 7.0, 13.0, 50.0  # points between symbols on one spot; to one that is moved; degrees between two
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
        angles = _free(place, len(others), ax.bbox.extents, begin, end, point)
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


def _free(place: Array, count: int, box: Sequence[float], begin: Array, end: Array, point: float) -> Array:
    """Directions (count,), rad, of a fan from a place that has room in the box and crosses the fewest strokes."""
    apart = np.radians(min(APART, 360 / (count + 1)))
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
