"""Studs of simple shape, cut free on passes of the same shape from the stock inwards. Lengths in mm, angles in rad.

    t = way from the edge of the stock to the stud and its allowance, R = tool radius, k = greatest stepover

*Rings* are closed passes, n = ceil(t / k) of them, t / n apart. A *spiral* begins where the tool just touches the stock,
comes in by t / n each turn, a share on every side, and ends with a round along the stud. In climb milling, the spindle
turning clockwise, both go round clockwise.

All passes have the corner of the stud, parallel to it. Where a wide one would leave the corners of the stock standing,
passes farther out have smaller ones, and where steps are long across the corners there are more of them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import Contour, placed
from mnclab.geometry.curves import Floats
from mnclab.machining.milling.clearing import Clearing, begin, end, joined, numbered
from mnclab.machining.milling.faces import DRIFT, steps
from mnclab.machining.milling.pocket_steps import LEAST, LevelFeeds, PocketWork, onto, outwards
from mnclab.machining.milling.spirals import half_circles
from mnclab.machining.steps import Along, Go, Step

ACROSS = 1.96  # times R, the longest step across a corner
BEVEL = 2 - math.sqrt(2)  # a right corner moved outwards by 1 has a bevel longer by this on each side


class Figure(NamedTuple):
    """A convex path: the directions of its sides' normals `(n,)`, their distances `(n,)`, and its corners.

    A corner is a radius, or with `bevels` the length that is cut off each of its sides.
    """

    normals: Floats
    reach: Floats
    corner: float
    bevels: bool

    def towards(self, other: Figure, share: Floats) -> tuple[Floats, Floats]:
        """Distances and corners of sides in turn, each its share (0 to 1) of the way to another figure."""
        side = np.arange(len(share)) % len(self.normals)
        reach = self.reach[side] + (other.reach - self.reach)[side] * share
        return reach, self.corner + (other.corner - self.corner) * share

    def apex(self, k: int = 0) -> Floats:
        """The middle of the corner before side k, `(2,)`."""
        two = np.array([k - 1, k])
        before, after, bulge = _corners(self.normals[two], self.reach[two], np.array([self.corner]), self.bevels, 1)
        return np.asarray(_middles(before, after, bulge)[0])


@lru_cache(16)  # checks and every level ask for the same
def rectangle(
    length: float, width: float, stock: tuple[float, float], radius: float, stepover: float, *, corner: float = 0.0,
    allowance: float = 0.0, climb: bool = True, centre: ArrayLike = (0, 0), angle: float = 0.0, begin: int | None = None,
) -> Clearing:  # fmt: skip
    """A rectangular stud out of a stock of length and width: rings begun in the middle of its right side, or a spiral.

    `corner` rounds the corners of the stud, or with a minus sign bevels them. A spiral begins at the corner `begin`: 0 the
    lower left one, then counter-clockwise.
    """
    spare = [(whole - part) / 2 - allowance for whole, part in zip(stock, (length, width), strict=True)]
    if min(spare) < -DRIFT:
        raise ValueError(f"a stock of {stock[0]:g} by {stock[1]:g} does not hold the stud and its allowance")
    if 2 * abs(corner) > min(length, width) + DRIFT:
        raise ValueError(f"a corner of {abs(corner):g} does not fit on a stud of {length:g} by {width:g}")
    if not radius > 0:
        raise ValueError(f"the tool radius must be greater than 0, got {radius:g}")
    out, bevels = radius + allowance, corner < 0
    half = np.array([width, length, width, length]) / 2 + out  # below, right, above, left
    normals = np.arange(-1, 3) * np.pi / 2
    last = Figure(normals, half, -corner + out * BEVEL if bevels else corner + out, bevels)
    first = last._replace(reach=half + np.maximum(np.tile(spare[::-1], 2), 0))
    n = max(steps(max(spare), stepover), steps(math.hypot(*spare), ACROSS * radius))
    edge = first.reach[[3, 0]] * -1 + radius  # the lower left corner of the stock
    if _path(_part(first, last, 1 / max(n, 1))).distance([edge])[0] > radius - DRIFT:
        first = first._replace(corner=radius * BEVEL if bevels else radius)
        n = max(n, steps(math.dist(first.apex(), last.apex()), ACROSS * radius * 0.9))
    if begin is not None:
        return _spiral(first, last, n if max(spare) > DRIFT else 0, radius, climb, centre, angle, begin, apex=False)
    passes = []
    for i in range(1, max(n, 1) + 1):
        ring = _path(_part(first, last, i / max(n, 1)), begin=1)
        ring = Contour(placed(ring.points, centre, angle), ring.bulge)
        passes.append(ring.reversed() if climb else ring)
    return joined(passes, numbered("ring", len(passes)), radius)


def circle(
    diameter: float, stock: float, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True,
    centre: ArrayLike = (0, 0), angle: float = 0.0,
) -> Clearing:  # fmt: skip
    """A circular stud out of a round stock: a spiral inwards, whole turns, then a full circle; both begin at `angle`."""
    last = diameter / 2 + allowance + radius
    spare = (stock - diameter) / 2 - allowance
    if spare < -DRIFT:
        raise ValueError(f"a stock of diameter {stock:g} does not hold the stud and its allowance")
    n = steps(spare, stepover)
    ring = Contour.circle(centre, last, angle, clockwise=climb)
    if not n:
        return joined([ring], ("last circle",), radius)
    spiral = half_circles(centre, last + spare, last, 2 * n, angle, clockwise=climb)
    return joined([spiral, ring], ("spiral", "last circle"), radius)


def polygon(
    corners: int, inscribed: float, stock: float, radius: float, stepover: float, *, corner: float = 0.0,
    allowance: float = 0.0, climb: bool = True, centre: ArrayLike = (0, 0), angle: float = 0.0,
) -> Clearing:  # fmt: skip
    """A regular polygon, given by its inscribed radius, out of a round stock: a spiral begun at its corner at `angle`.

    `corner` rounds its corners, or with a minus sign bevels them; a sharp one is gone round on an arc. The spiral begins
    as round as the stock, where the stud fits into that, and gets its corners on the way.
    """
    spare = stock / 2 - inscribed - allowance
    if spare < -DRIFT:
        raise ValueError(f"a stock of diameter {stock:g} does not hold the stud and its allowance")
    if inscribed + allowance <= 0:
        raise ValueError(f"an allowance of {allowance:g} leaves nothing of a radius of {inscribed:g}")
    out, bevels, half = radius + allowance, corner < 0, math.pi / corners
    normals = np.array([half * (2 * k + 1) for k in range(corners)])
    grown = out * math.tan(half / 2) / math.cos(half) if bevels else out  # the bevel and the sides move outwards alike
    last = Figure(normals, np.full(corners, inscribed + out), max(0.0, abs(corner) + grown), bevels)
    edge = max(stock / 2 + radius, inscribed + out)  # the spiral begins there, or as far out as the corners reach
    beyond = edge / math.cos(half) - max(edge, float(np.hypot(*last.apex())))
    size = beyond / (math.sin(half) if bevels else 1 / math.cos(half) - 1)
    first = last._replace(reach=np.full(corners, edge), corner=size)
    return _spiral(first, last, steps(spare, stepover), radius, climb, centre, angle, 0, apex=True)


def _part(first: Figure, last: Figure, share: float) -> Figure:
    reach = first.reach + (last.reach - first.reach) * share
    return last._replace(reach=reach, corner=first.corner + (last.corner - first.corner) * share)


def _corners(normals: Floats, reach: Floats, size: Floats, bevels: bool, sense: int) -> tuple[Floats, Floats, Floats]:
    """Where m lines in turn bend into the next one: before and after `(m-1, 2)`, and the bulge between `(m-1,)`."""
    n = np.stack([np.cos(normals), np.sin(normals)], axis=1)
    a, b, h, k = n[:-1], n[1:], reach[:-1], reach[1:]
    across = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    sharp = np.stack([h * b[:, 1] - k * a[:, 1], a[:, 0] * k - b[:, 0] * h], axis=1) / across[:, None]
    turn = np.arccos(np.clip((a * b).sum(axis=1), -1, 1))
    ahead = sense * np.stack([-n[:, 1], n[:, 0]], axis=1)
    off = (size if bevels else size * np.tan(turn / 2))[:, None]
    bulge = np.zeros(len(turn)) if bevels else sense * np.tan(turn / 4)
    return sharp - off * ahead[:-1], sharp + off * ahead[1:], bulge


def _middles(before: Floats, after: Floats, bulge: Floats) -> Floats:
    chord = after - before
    return (before + after) / 2 + (bulge / 2)[:, None] * np.stack([chord[:, 1], -chord[:, 0]], axis=1)


def _path(figure: Figure, begin: int | None = None) -> Contour:
    """A figure as a closed contour, counter-clockwise; perhaps begun where the normal of a side meets it."""
    turned = np.append(np.arange(len(figure.normals)), 0)
    size = np.full(len(figure.normals), figure.corner)
    before, after, bulge = _corners(figure.normals[turned], figure.reach[turned], size, figure.bevels, 1)
    points = np.stack([before, after], axis=1).reshape(-1, 2)
    bulges = np.stack([bulge, np.zeros(len(bulge))], axis=1).reshape(-1)
    if begin is not None:
        angle = figure.normals[begin]
        middle = figure.reach[begin] * np.array([np.cos(angle), np.sin(angle)])
        points = np.vstack([middle, np.roll(points, -2 * begin, axis=0)])
        bulges = np.append(0.0, np.roll(bulges, -2 * begin))
    some = np.hypot(*(np.roll(points, -1, axis=0) - points).T) > DRIFT
    return Contour(points[some], bulges[some])


def _spiral(
    first: Figure, last: Figure, turns: int, radius: float, climb: bool, centre: ArrayLike, angle: float, begin: int,
    *, apex: bool,
) -> Clearing:  # fmt: skip
    """From the corner `begin` of the first figure, or from its apex, inwards in a number of turns; then round the last one."""
    n, sense = len(first.normals), -1 if climb else 1
    side = (begin + np.arange(n)) % n if sense > 0 else (begin - 1 - np.arange(n)) % n
    first, last = (f._replace(normals=f.normals[side], reach=f.reach[side]) for f in (first, last))
    share = np.append(np.arange(turns * n) / max(turns * n, 1), np.ones(n + 1))
    reach, size = first.towards(last, share)
    outer = first if turns else last
    line = np.arange(-1, len(share)) % n  # a corner is as on the figure of the side that follows: it holds that one
    before, after, bulge = _corners(outer.normals[line], np.append(outer.reach[-1], reach), size, first.bevels, sense)
    start = _middles(before[:1], after[:1], bulge[:1]) if apex else after[:1]
    points = np.vstack([start, np.stack([before, after], axis=1).reshape(-1, 2)[1:]])
    bulges = np.append(np.stack([bulge, np.zeros(len(bulge))], axis=1).reshape(-1)[1:], 0.0)
    bulges = np.append(math.tan(math.atan(bulge[0]) / 2) if apex else 0.0, bulges)[: len(points)]
    if not apex:
        points, bulges = points[1:], bulges[1:]
    cut = 2 * turns * n + (1 if apex else 0)
    ways = [slice(0, cut + 1), slice(cut, None)] if turns else [slice(0, None)]
    passes = []
    for way in ways:
        some = np.append(np.hypot(*np.diff(points[way], axis=0).T) > DRIFT, True)
        bends = np.append(bulges[way][some][:-1], 0.0)
        passes.append(Contour(placed(points[way][some], centre, angle), bends, closed=False))
    labels = ("spiral", "last ring") if turns else ("last ring",)
    return joined(passes, labels, radius)


# Milling a stud step by step: down beside the stock, up to the passes on an arc, round, off them, back; level by level.
# x and y count from the middle of the stud. Lengths in mm, feeds in mm/min.

class Stud(NamedTuple):
    """The shape of a stud for one tool, which goes down at `start`, in the clear, and comes back there from every level.

    `clearing` gives the passes for an allowance, from the blank inwards or along the stud alone. The tool leaves the last
    one on a half circle that leads it `off` to the side, or to the start; then it goes back on the level, or at the height
    `high`, from which it comes down to the clearance level at rapid.
    """

    clearing: Callable[[float, bool], Clearing]
    start: tuple[float, float]
    off: float | None = None
    high: float | None = None


def mill_stud(stud: Stud, work: PocketWork) -> Iterator[Step]:
    """Roughing in layers, the side in infeeds, the floor at once, each where it has levels."""
    roughing, finishing, last = work.feeds
    for name, levels, allowance, blank, feeds in (
        ("layer", work.layers, work.allowance, True, roughing),
        ("side finishing", work.walls, 0.0, False, finishing),
        ("floor finishing", work.floor, min(work.allowance, 0.0), True, last),
    ):
        if not levels:
            continue
        passes = stud.clearing(allowance, blank)
        yield Go(f"{name}, to the clearance level", work.above)
        for k, (label, level) in enumerate(zip(numbered(name, len(levels)), levels, strict=True)):
            if k and stud.high is not None:
                yield Go(f"{label}, to the clearance level", work.above)
            yield Go(f"{label}, down", level, feeds.plunge)
            yield from _round(label, stud, passes, feeds, work.side)
            if stud.high is not None:
                yield Go(f"{label}, lift", stud.high)
            yield Go(f"{label}, back to the start", x=stud.start[0], y=stud.start[1])


def _round(name: str, stud: Stud, passes: Clearing, feeds: LevelFeeds, side: int) -> Iterator[Step]:
    """Up to the passes, along them and off the last one; the stud is on their right for `side` 1."""
    first, last = passes.passes[0], passes.passes[-1]
    if (way := onto(stud.start, first)) is not None:
        yield Along(f"{name}, approach", way, feeds.level)
    for label, contour in zip(passes.labels, passes.passes, strict=True):
        yield Go(f"{name}, link", None, feeds.level, *begin(contour).tolist())
        yield Along(f"{name}, {label}", contour, feeds.level)
    away = math.dist(stud.start, end(last)) if stud.off is None else stud.off
    if away > LEAST:
        yield Along(f"{name}, departure", outwards(last, away, side), feeds.level)
