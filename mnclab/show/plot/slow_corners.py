"""Corners at which the tool is slower than before and behind, over the path: a triangle and the feed that is left."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes

from mnclab.path.profile import Profile
from mnclab.show.plot import colours
from mnclab.show.plot.overlay import line, texts
from mnclab.show.plot.picture import View
from mnclab.show.plot.strokes import Array

MOST, NAMED = 60, 12  # corners that are marked; with a number


class SlowCorners(NamedTuple):
    """Places (n, 3), mm, slowest first, and what is written there."""

    places: Array
    said: Sequence[str]

    def box(self, low: Array, high: Array) -> tuple[Array, Array]:
        return low, high

    def names(self, views: Sequence[View]) -> list[str]:
        return [colours.SLOW_CORNER.name] if len(self.places) else []

    def draw(self, ax: Axes, view: View) -> list[Any]:
        return [line(ax, view, self.places, colours.SLOW_CORNER)] if len(self.places) else []

    def write(self, ax: Axes, view: View, lines: Sequence[Array]) -> None:
        """The feed at the slowest of them, in the unit of the path a minute."""
        places = self.places[: len(self.said)]
        out = (places - places.mean(axis=0))[:, [view.right, view.up]] if len(places) else np.empty((0, 2))
        texts(ax, view, self.said, places, out, lines, colours.SLOW_CORNER.colour, mark=3.0)


def slow_at(profile: Profile) -> np.ndarray:
    """Nodes (k,) of the pieces at which a corner slows the tool without stopping it."""
    p = profile.pieces
    turn = np.zeros(len(p.v), dtype=bool)
    turn[1:-1] = (p.row[1:] != p.row[:-1]) & (p.v[1:-1] > 1e-9) & (p.v[1:-1] < p.v[:-2]) & (p.v[1:-1] < p.v[2:])
    return np.flatnonzero(turn)


def slow_corners(profile: Profile) -> SlowCorners:
    """The slow corners of a profile; none where they are too many to be told apart."""
    p, at = profile.pieces, slow_at(profile)
    at = at[np.argsort(p.v[at], kind="stable")] if len(at) <= MOST else at[:0]
    places = profile.path.start[p.row[at]]
    feeds = p.v[at][:NAMED] * 60 / profile.path.unit.length
    return SlowCorners(places, [f"{round(feed, 3 if feed < 10 else 0):g}" for feed in feeds.tolist()])
