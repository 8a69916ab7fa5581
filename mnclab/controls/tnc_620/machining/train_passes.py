"""Passes along contour trains: up to the contour and off it, level after level, all in one sense or to and fro. Lengths in mm.

A *train* is a way along a contour with the ways that lead to it and off it. In one sense the tool comes up to the clearance
height after every level; to and fro it sinks to the next level at the end of the contour where it is:

    one sense     ╮ to   along   off ╭        to and fro    ╮ to   along  │ down
                  ╰─────────────────▶╯                      ╰────────────▶│
                                                                 ◀────────╯
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from mnclab.controls.tnc_620.machining.trains import SpaceWay
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, turned
from mnclab.machining.milling.clearing import numbered
from mnclab.machining.steps import Along, Go, Step
from mnclab.path.leads import Lead, way

SAME = 1e-9  # mm


class Train(NamedTuple):
    """A way along a contour, and those that lead to its beginning and off its end, if any; on which `side` of the contour
    the tool runs (+1 left, -1 right, 0 on it)."""

    along: SpaceWay
    to: SpaceWay | None = None
    off: SpaceWay | None = None
    side: int = 0

    @property
    def begin(self) -> Floats:
        """Where the tool goes down, `(2,)`."""
        return (self.to or self.along).begin

    @property
    def begin_height(self) -> float:
        """The height of the way where the tool goes down."""
        return float((self.to or self.along).heights[0])

    def reversed(self) -> Train:
        """The same way backwards: what led to the contour leads off it."""
        return Train(
            self.along.reversed(), None if self.off is None else self.off.reversed(),
            None if self.to is None else self.to.reversed(), -self.side,
        )  # fmt: skip


class Feeds(NamedTuple):
    """Feeds, mm/min: `plunge` down and `level` along the contour; and heights: `clearance` above everything, and `rapid_to`, to
    which the tool goes down at rapid (infinite: nowhere).

    `edge` says on which arcs of the contour the level feed counts at the cutting edge of a tool of a `radius`: on none (""),
    "inside", where the edge has the longer way, or "everywhere".
    """

    plunge: float
    level: float
    clearance: float
    rapid_to: float = math.inf
    edge: str = ""
    radius: float = 0.0


def leading_to(along: SpaceWay, lead: Lead, start: tuple[float, float, float] | None = None) -> SpaceWay:
    """The way to the beginning of a way, on its height: by the auxiliary point of the lead, or from `start` by it.

    From the height of `start` the tool comes along the straight piece before the auxiliary point, without one along the whole.
    Raises PathFault where a lead of the form LCT does not reach.
    """
    contour, side, place = along.contour, lead.side or 1, along.begin
    t = contour.tangents()[0][np.flatnonzero(contour.lengths > SAME)[0]]
    found = way(lead._replace(side=side), place if start is None else np.array(start[:2]), place, t)
    sweep = found.sweep if found.centre is not None else 0.0
    pieces = max(1, math.ceil(abs(sweep) / np.pi - 1e-9))
    points = [found.by] if found.centre is None else _round(found.by, found.centre, sweep, pieces)
    bulge = [math.tan(sweep / pieces / 4)] * pieces
    height = along.heights[0]
    heights = np.full(len(points) + 1, height)
    if start is not None and math.dist(start[:2], found.by) > SAME:
        points, bulge, heights = [np.array(start[:2]), *points], [0.0, *bulge], np.append(start[2], heights)
    elif start is not None:
        heights = np.linspace(start[2], height, len(heights))
    return SpaceWay(Contour([*points, place], [*bulge, 0.0], closed=False), heights)


def leading_off(along: SpaceWay, lead: Lead, end: tuple[float, float, float] | None = None) -> SpaceWay:
    """The way off the end of a way: an approach to the way back, backwards."""
    return leading_to(along.reversed(), lead._replace(side=-(lead.side or 1)), end).reversed()


def _round(point: Floats, centre: Floats, sweep: float, pieces: int) -> list[Floats]:
    """Where equal pieces of an arc from a point on begin."""
    arms = np.tile(point - centre, (pieces, 1))
    return list(centre + turned(arms, sweep / pieces * np.arange(pieces)))


def mill(trains: Sequence[Train], levels: Sequence[float], feeds: Feeds, to_and_fro: bool = False) -> Iterator[Step]:
    """Every train on each of the levels, which are added to the heights of its way; begins and ends at the clearance height."""
    for name, train in zip(numbered("stretch", len(trains)), trains, strict=True):
        prefix = f"{name}, " if len(trains) > 1 else ""
        last = len(levels) - 1
        for k, (label, level) in enumerate(zip(numbered(f"{prefix}level", len(levels)), levels, strict=True)):
            run = train.reversed() if to_and_fro and k % 2 else train
            if k == 0 or not to_and_fro:
                yield from _down(label, run, level, feeds)
                yield from _follow(f"{label}, to the contour", run.to, level, feeds.level)
            else:
                yield Go(f"{label}, down", float(run.along.heights[0]) + level, feeds.plunge)
            for piece, feed in _at_edge(run, feeds):
                yield from _follow(label, piece, level, feed)
            if k == last or not to_and_fro:
                yield from _follow(f"{label}, off the contour", run.off, level, feeds.level)
                yield Go(f"{label}, retract", feeds.clearance)


def _down(label: str, train: Train, level: float, feeds: Feeds) -> Iterator[Step]:
    """At the clearance height over the beginning, and down to it."""
    x, y = train.begin.tolist()
    yield Go(f"{label}, to the start", feeds.clearance)
    yield Go(f"{label}, to the start", x=x, y=y)
    goal = train.begin_height + level
    if goal < feeds.rapid_to < feeds.clearance:
        yield Go(f"{label}, down", feeds.rapid_to)
    yield Go(f"{label}, down", goal, feeds.plunge)


def _follow(label: str, run: SpaceWay | None, level: float, feed: float) -> Iterator[Step]:
    if run is not None:
        heights = run.heights + level
        yield Along(label, run.contour, feed, None if np.ptp(heights) <= SAME else tuple(heights.tolist()))


def _at_edge(train: Train, feeds: Feeds) -> Iterator[tuple[SpaceWay, float]]:
    """The pieces of a way that have one feed of the tool centre each."""
    contour, heights = train.along
    inside = train.side * contour.sweeps > 0
    counts = (contour.sweeps != 0) & (train.side != 0) & (inside | (feeds.edge == "everywhere")) & (feeds.edge != "")
    at_contour = np.where(inside, contour.radii + feeds.radius, contour.radii - feeds.radius)
    with np.errstate(divide="ignore", invalid="ignore"):
        factor = np.where(counts & (at_contour > SAME), contour.radii / at_contour, 1.0)
    ends = np.flatnonzero(factor[1:] != factor[:-1]) + 1
    for a, b in pairwise([0, *ends.tolist(), len(factor)]):
        piece = Contour(contour.points[a : b + 1], contour.bulge[a : b + 1], closed=False)
        yield SpaceWay(piece, heights[a : b + 1]), feeds.level * float(factor[a])
