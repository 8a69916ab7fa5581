"""How much of its rim a tool has in the material, at every place of its way. Lengths in mm, angles in rad.

The material is an area of one depth. At a place p with heading h the front half of the rim can cut; what discs of the same
radius R cleared before is taken out of it:

    a disc about c, d = |c - p| < 2·R, takes the directions within arccos(d / (2·R)) of the one from p to c

So the engaged part is exact for discs, and no grid is needed. The way itself is a row of discs `spacing` apart, by default
R/16. To close the cusps between them each is taken greater by spacing²/(4·R), that is R/1024: engagement angles are too
small by at most a tenth of that over sin(angle), 0.3° at an angle of 10° and less than 0.1° from 40° on. Where a stock is given
its outline is found on the rim to a quarter of a degree.

The greatest angle often stands where an element ends, in a corner: there the tool is looked at as well, as it comes in, whatever
the phase of the discs. Such a place stands for no length of the way, clears nothing, and the disc just behind it is not taken
greater: it would stick out in front.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, counted
from mnclab.geometry.regions import Region
from mnclab.text.tables import shapes

FINE = 16  # discs to a tool radius
BLOCK = 500
RIM = np.radians(np.arange(-90, 90.01, 0.25))
QUARTER = np.pi / 2
FULL = np.radians(178)  # from here on the tool cuts with its whole circumference
SHARP = np.radians(1)  # a turn between two elements from which on it is a corner
SHORT = 0.25  # of the tool radius: a shorter gap between two full stretches is full as well


class Engagement(NamedTuple):
    """Samples along a way: `points` (n, 2), `heading` (n,) rad, `angle` (n,) engaged, `width` (n,) of cut across the
    heading, `step` (n,) the length each stands for (0: a corner, or an end), `move` (n,) the index of its contour."""

    points: Floats
    heading: Floats
    angle: Floats
    width: Floats
    step: Floats
    move: NDArray[np.intp]

    def __repr__(self) -> str:
        return shapes(self)

    def along_the_way(self, values: Floats) -> float:
        """The mean of values (n,), each weighted with the way that it stands for."""
        return float(np.average(values, weights=self.step)) if self.step.sum() > 0 else 0.0

    def mean(self) -> float:
        """The mean angle along the way."""
        return self.along_the_way(self.angle)

    def most(self) -> float:
        return float(self.angle.max(initial=0.0))

    def share_above(self, limit: float) -> float:
        """The share of the way on which the angle is above a limit."""
        whole = float(self.step.sum())
        return float(self.step[self.angle > limit + 1e-9].sum()) / whole if whole else 0.0

    def chosen(self, mask: NDArray[np.bool_]) -> Engagement:
        return Engagement._make(column[mask] for column in self)


def engagement(
    moves: Sequence[Contour], radius: float, *, spacing: float | None = None, stock: Region | None = None,
    corners: bool = True,
) -> Engagement:  # fmt: skip
    """The engagement along contours cut one after the other; without a `stock` there is material everywhere.

    A contour of no length is a plunge: it only clears. So does the start of every contour. Without `corners` places are looked
    at in equal steps alone.
    """
    if not radius > 0:
        raise ValueError(f"the tool radius must be greater than 0, got {radius:g}")
    step = radius / FINE if spacing is None else spacing
    points, heading, size, move, told = _sampled(moves, step, corners)
    angle, width = np.zeros(len(points)), np.zeros(len(points))
    cells = _Cells(points, 2 * radius)
    for first in range(0, len(points), BLOCK):
        here = np.arange(first, min(first + BLOCK, len(points)))
        sample, low, high = _taken(points, heading, here, cells, radius, step, told & (size == 0), move)
        if stock is not None:
            more = _outside(points[here], heading[here], radius, stock)
            sample, low, high = (np.concatenate(pair) for pair in zip((sample, low, high), more, strict=True))
        angle[here], width[here] = _open(sample, low, high, len(here), radius)
    return Engagement(points[told], heading[told], angle[told], width[told], size[told], move[told])


class Stretch(NamedTuple):
    """A part of a pass, and whether the tool cuts on it with its whole circumference: the whole front half of its rim."""

    contour: Contour
    full: bool


def stretches(
    moves: Sequence[Contour], radius: float, *, stock: Region | None = None, limit: float = FULL
) -> tuple[tuple[Stretch, ...], ...]:
    """Each of some contours, cut one after the other, parted where the engagement rises above `limit` (rad) or falls below it.

    All that the tool runs through belongs to `moves`: links, and a contour of no length where it plunged. A contour that is
    the same all along stays whole, and closed. Without a `stock` there is material everywhere.
    """
    found = engagement(moves, radius, stock=stock, corners=False)
    full, first = found.angle >= limit, np.searchsorted(found.move, np.arange(len(moves) + 1))
    return tuple(
        _parted(contour, full[a:b], SHORT * radius) for contour, a, b in zip(moves, first, first[1:], strict=False)
    )


def _parted(contour: Contour, full: NDArray[np.bool_], short: float) -> tuple[Stretch, ...]:
    """A contour cut where the flags of its equal steps change."""
    if not len(full) or full.all() or not full.any():
        return (Stretch(contour, bool(full.any())),)
    step = contour.length / len(full)
    change = np.flatnonzero(full[1:] != full[:-1]) + 1
    edges = np.concatenate([[0], change, [len(full)]])
    gap = ~full[edges[:-1]] & (np.diff(edges) * step < short)
    gap[[0, -1]] = False
    kept = np.concatenate([[True], ~(gap[1:] | gap[:-1]), [True]])  # a gap goes with both of its edges
    ways = edges[kept] * step
    flags = full[edges[:-1]][kept[:-1]]
    if len(flags) == 1:
        return (Stretch(contour, bool(flags[0])),)
    return tuple(
        Stretch(contour.between(a, b), bool(flag)) for a, b, flag in zip(ways, ways[1:], flags, strict=False)
    )


def _sampled(
    moves: Sequence[Contour], step: float, corners: bool
) -> tuple[Floats, Floats, Floats, NDArray[np.intp], NDArray[np.bool_]]:
    """Discs along contours: one at the start of each, which only clears, then one in the middle of every step and, of no
    length, one in each of its `corners` and at its end, as the tool comes in; the last column says what is looked at."""
    points, heading, size, move = [np.zeros((0, 2))], [np.zeros(0)], [np.zeros(0)], [np.zeros(0, dtype=np.intp)]
    told = [np.zeros(0, dtype=bool)]
    for k, contour in enumerate(moves):
        length = contour.length
        count = int(np.ceil(length / step - 1e-9)) if length > 1e-9 else 0
        ways = (np.arange(count) + 0.5) * length / max(count, 1)
        places, along = contour.point_at(ways) if count else (np.zeros((0, 2)), np.zeros((0, 2)))
        sizes = np.full(count, length / max(count, 1))
        if count and corners:
            ends = np.append(np.flatnonzero(np.abs(contour.turns()[1:]) > SHARP), len(contour.lengths) - 1)
            order = np.argsort(np.concatenate([np.cumsum(contour.lengths)[ends] - 1e-9, ways]), kind="stable")
            places = np.vstack([contour.ends[ends], places])[order]
            along = np.vstack([contour.tangents()[1][ends], along])[order]
            sizes = np.concatenate([np.zeros(len(ends)), sizes])[order]
        points += [contour.points[:1], places]
        heading += [np.zeros(1), np.arctan2(along[:, 1], along[:, 0])]
        size += [np.zeros(1), sizes]
        move.append(np.full(len(sizes) + 1, k, dtype=np.intp))
        told += [np.zeros(1, dtype=bool), np.ones(len(sizes), dtype=bool)]
    return np.vstack(points), np.concatenate(heading), np.concatenate(size), np.concatenate(move), np.concatenate(told)


class _Cells:
    """Points by the square of a grid in which they lie."""

    def __init__(self, points: Floats, size: float) -> None:
        low = points.min(axis=0) if len(points) else np.zeros(2)
        self.at = np.floor((points - low) / size).astype(np.int64) + 1
        self.width = int(self.at[:, 1].max(initial=0)) + 2
        key = self.at[:, 0] * self.width + self.at[:, 1]
        self.order = np.argsort(key, kind="stable")
        self.key = key[self.order]

    def near(self, here: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
        """Pairs (position in `here`, other point) of points in the same or a neighbouring square, the other one earlier."""
        pairs = []
        for i in (-1, 0, 1):  # three squares of one column are neighbours in the order of keys
            key = (self.at[here, 0] + i) * self.width + self.at[here, 1]
            first, last = np.searchsorted(self.key, key - 1), np.searchsorted(self.key, key + 1, side="right")
            count = last - first
            mine, within = counted(count)
            other = self.order[np.repeat(first, count) + within]
            earlier = other < here[mine]
            pairs.append((mine[earlier], other[earlier]))
        return np.concatenate([a for a, _ in pairs]), np.concatenate([b for _, b in pairs])


def _taken(
    points: Floats, heading: Floats, here: NDArray[np.intp], cells: _Cells, radius: float, step: float,
    corner: NDArray[np.bool_], move: NDArray[np.intp],
) -> tuple[NDArray[np.intp], Floats, Floats]:
    """The stretches of the rims, as angles from the heading, that earlier discs have cleared; a `corner` clears nothing."""
    mine, other = cells.near(here)
    mine, other = mine[~corner[other]], other[~corner[other]]
    x, y = (points[other] - points[here[mine]]).T
    away2 = x * x + y * y
    behind = corner[here[mine]] & (move[other] == move[here[mine]]) & (away2 < step**2)
    wide = np.where(behind, radius, radius + step**2 / (4 * radius))
    near = away2 < (radius + wide) ** 2
    mine, x, y, away2, wide = mine[near], x[near], y[near], away2[near], wide[near]
    cosine, sine = np.cos(heading[here])[mine], np.sin(heading[here])[mine]
    ahead, aside = x * cosine + y * sine, y * cosine - x * sine
    half2 = 1.02 - away2 / (radius + wide) ** 2  # sin² of half the stretch, and a little more
    front = (ahead >= 0) | (ahead * ahead <= away2 * half2)  # some of it lies in front
    mine, ahead, aside, away2, wide = mine[front], ahead[front], aside[front], away2[front], wide[front]
    with np.errstate(divide="ignore", invalid="ignore"):
        cosine = (away2 + radius**2 - wide**2) / (2 * radius * np.sqrt(away2))
    half = np.arccos(np.clip(np.where(away2 > 0, cosine, -1.0), -1.0, 1.0))
    towards = np.where(half >= np.pi - 1e-9, 0.0, np.arctan2(aside, ahead))
    low, high = np.maximum(towards - half, -QUARTER), np.minimum(towards + half, QUARTER)
    some = low < high
    return mine[some], low[some], high[some]


def _outside(points: Floats, heading: Floats, radius: float, stock: Region) -> tuple[NDArray[np.intp], Floats, Floats]:
    """The stretches of the rims that lie outside the stock."""
    edge = np.flatnonzero((stock.distance(points) < radius) | ~stock.contains(points))
    way = heading[edge, None] + RIM
    rim = points[edge, None] + radius * np.stack([np.cos(way), np.sin(way)], axis=-1)
    free = ~stock.contains(rim.reshape(-1, 2)).reshape(len(edge), len(RIM))
    change = np.diff(np.pad(free, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    sample, first = np.nonzero(change == 1)
    _, last = np.nonzero(change == -1)
    half = (RIM[1] - RIM[0]) / 2
    return edge[sample], np.maximum(RIM[first] - half, -QUARTER), np.minimum(RIM[last - 1] + half, QUARTER)


def _open(sample: NDArray[np.intp], low: Floats, high: Floats, count: int, radius: float) -> tuple[Floats, Floats]:
    """What the stretches leave of the front half of each rim: its angle, and its width across the heading."""
    sample = np.concatenate([sample, np.arange(count)])  # a last stretch of no length ends every rim
    low, high = np.append(low, np.full(count, QUARTER)), np.append(high, np.full(count, QUARTER))
    order = np.argsort(low + 4.0 * sample)
    sample, low, high = sample[order], low[order], high[order]
    lift = 4.0 * sample  # sets the rims apart, so that one running maximum serves them all
    reach = np.maximum.accumulate(high + lift)
    before = np.maximum(np.concatenate([[-np.inf], reach[:-1]]), lift - QUARTER) - lift
    gap = low - before > 1e-12
    angle = np.bincount(sample[gap], (low - before)[gap], count)
    width = np.bincount(sample[gap], radius * (np.sin(low) - np.sin(before))[gap], count)
    return np.asarray(angle, dtype=float), np.asarray(width, dtype=float)
