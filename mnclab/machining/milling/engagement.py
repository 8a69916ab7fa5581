"""How much of its rim a tool has in the material, at every place of its way. Lengths in mm, angles in rad.

The material is an area of one depth. At a place p with heading h the front half of the rim can cut; what the tool cleared
before is taken out of it, element by element: the discs about all places c of a line or an arc.

    a disc about c, d = |c - p| < 2·R, takes the directions within arccos(d / (2·R)) of the one from p to c
    along an element both bounds of these change evenly, so that it takes one stretch: it ends where a disc at one of the ends
    of the element ends, or where the rim touches the edge of what the element clears, a line or an arc R beside it

So the engaged part is exact, whatever the `spacing` of the places at which the tool is looked at (by default R/16), but for
chains of short lines, which keep R/4000. Where a stock is given its outline is found on the rim to a quarter of a degree.

The greatest angle often stands where an element ends, in a corner: there the tool is looked at as well, as it comes in, whatever
the phase of the other places. Such a place stands for no length of the way.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Curves, Floats, cross, dot, length_of, unit_of
from mnclab.geometry.regions import Region
from mnclab.text.tables import shapes

FINE = 16  # places to a tool radius
BLOCK = 500  # places that are looked at together
SLACK = 1e-12
TINY = 1e-6  # of the tool radius: so far behind the tool, or before the end of an element, is as good as there
RIM = np.radians(np.arange(-90, 90.01, 0.25))
QUARTER = np.pi / 2
FLAT = 1e8  # tool radii: arcs of a greater radius are lines
FULL = np.radians(178)  # from here on the tool cuts with its whole circumference
SHARP = np.radians(1)  # a turn between two elements from which on it is a corner
SHORT = 0.25  # of the tool radius: a shorter gap between two full stretches is full as well


class Engagement(NamedTuple):
    """Samples along a way: `points` (n, 2), `heading` (n,) rad, `angle` (n,) engaged, `width` (n,) of cut across the
    heading, `step` (n,) the length each stands for (0: a corner, or an end), `move` (n,) the index of its contour.

    `thickness` (n,) is that of the thickest chip as a share of the feed per tooth: the greatest cosine between the heading and
    what is engaged of the rim. For one stretch from a side of the tool on it is sin(angle), and 1 from 90° on. `way` (n,) is
    the length of all contours up to there."""

    points: Floats
    heading: Floats
    angle: Floats
    width: Floats
    step: Floats
    move: NDArray[np.intp]
    thickness: Floats
    way: Floats

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

    def percentile(self, share: float) -> float:
        """The angle that so great a share of the way (0 to 1) does not exceed."""
        order = np.argsort(self.angle)
        upto = np.cumsum(self.step[order])
        if not len(upto) or not upto[-1] > 0:
            return self.most()
        return float(self.angle[order][min(np.searchsorted(upto, share * upto[-1] * (1 - SLACK)), len(order) - 1)])

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
    places = _sampled(moves, step, TINY * radius, corners)
    points, heading, size, move = places.points, places.heading, places.size, places.move
    angle, width, thickness = np.zeros((3, len(points)))
    swept = _Swept(moves, radius)
    for first in range(0, len(points), BLOCK):
        here = np.arange(first, min(first + BLOCK, len(points)))
        sample, low, high = swept.taken(points[here], heading[here], places.way[here] - TINY * radius)
        if stock is not None:
            more = _outside(points[here], heading[here], radius, stock)
            sample, low, high = (np.concatenate(pair) for pair in zip((sample, low, high), more, strict=True))
        angle[here], width[here], thickness[here] = _open(sample, low, high, len(here), radius)
    return Engagement(points, heading, angle, width, size, move, thickness, places.way)


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


class _Places(NamedTuple):
    """Where the tool is looked at: the columns of an `Engagement`, and the `way` (n,) along all contours up to there."""

    points: Floats
    heading: Floats
    size: Floats
    move: NDArray[np.intp]
    way: Floats


def _sampled(moves: Sequence[Contour], step: float, tiny: float, corners: bool) -> _Places:
    """Places in the middle of every step along contours and, of no length, in each of the `corners` and at the ends."""
    none = np.zeros(0)
    found = [_Places(np.zeros((0, 2)), none, none, np.zeros(0, dtype=np.intp), none)]
    before = 0.0  # the way of the contours before
    for k, contour in enumerate(moves):
        upto = contour.upto
        length = upto[-1]
        if length > 1e-9:
            count = int(np.ceil(length / step - 1e-9))
            ways, size = (np.arange(count) + 0.5) * length / count, np.full(count, length / count)
            if corners:
                ends = np.append(upto[1:-1][np.abs(contour.turns()[1:]) > SHARP], length)
                ways, size = np.append(np.maximum(ends - tiny, 0.0), ways), np.append(np.zeros(len(ends)), size)
                order = np.argsort(ways, kind="stable")
                ways, size = ways[order], size[order]
            places, along = contour.point_at(ways)
            heading = np.arctan2(along[:, 1], along[:, 0])
            found.append(_Places(places, heading, size, np.full(len(ways), k), before + ways))
        before += length
    return _Places(*map(np.concatenate, zip(*found, strict=True)))


class _Parts(NamedTuple):
    """The parts of n elements that lie within 2·R of a place, as the tool sees them from there.

    Directions count from that of the `base` (n,), positive on the `side` of +1 or -1: in a frame with one axis that way and one
    across the parts begin and end at `ends` (2, 2, n). The whole line or circle would clear the rim from minus to plus the angle
    `edge` (n,), where it touches its edge; `lower` and `upper` (n,) say whether the part does so as well.
    """

    sample: NDArray[np.intp]
    base: Floats
    side: Floats
    ends: Floats
    edge: Floats
    lower: NDArray[np.bool_]
    upper: NDArray[np.bool_]

    def only(self, which: NDArray[np.bool_]) -> _Parts:
        columns: Any = (column[..., which] for column in self)
        return _Parts(*columns)


class _Swept:
    """What discs of a radius clear along all elements of some contours, one after the other."""

    def __init__(self, moves: Sequence[Contour], radius: float) -> None:
        thin = [_thinned(contour, radius) for contour in moves]
        none = Curves(*np.zeros((3, 0, 2)), *np.zeros((2, 0)))
        self.curves = curves = Curves(*map(np.concatenate, zip(none, *(contour.curves for contour, _ in thin), strict=True)))
        self.radius, self.lengths = radius, np.concatenate([none.r, *(contour.lengths for contour, _ in thin)])
        before = np.cumsum([0.0, *(contour.length for contour in moves)])
        upto = np.concatenate([none.r, *(start + ways for start, (_, ways) in zip(before, thin, strict=False))])
        self.begun = upto - self.lengths  # the way up to where each element begins
        # A chord that stands for some lines clears when the tool is past it: it lies beside the way on which the tool is.
        chord = [np.full(len(ways), len(ways) < len(contour.starts)) for contour, (_, ways) in zip(moves, thin, strict=True)]
        self.least = np.where(np.concatenate([none.r, *chord]), self.lengths - SLACK, 0.0)
        self.line = ~(curves.r < FLAT * radius)
        self.along = unit_of(np.where(self.lengths[:, None] > 0, curves.end - curves.start, (1.0, 0.0)))
        self.ahead, self.aside = dot(curves.start, self.along), cross(self.along, curves.start)
        # Half an arc lies within ρ·(1 - cos(sweep/4)) of its chord: so the box of start, middle and end is widened.
        middle = np.concatenate([none.start, *(contour.at(0.5)[0] for contour, _ in thin)])
        corners = np.stack([curves.start, middle, curves.end])
        wide = np.nan_to_num(curves.r * (1 - np.cos(curves.sweep / 4)))[:, None]
        self.tree = shapely.STRtree(shapely.box(*(corners.min(axis=0) - wide).T, *(corners.max(axis=0) + wide).T))

    def taken(self, points: Floats, heading: Floats, way: Floats) -> tuple[NDArray[np.intp], Floats, Floats]:
        """The stretches of the rims, as angles from the heading, that has cleared what was cut up to some way (n,).

        The place lies exactly on the element that is being cut, and `off` all others by what is worked out.
        """
        # Discs more than R behind the tool take nothing of the front half. What is left of the 2·R about the tool reaches 2·R in
        # directions up to 120° from the heading, and 2·R·cos(δ - 120°) at a greater angle δ.
        ahead = np.stack([np.cos(heading), np.sin(heading)], axis=1)
        low, high = (2 * self.radius * np.cos(np.maximum(np.arccos(side * ahead) - np.radians(120), 0.0)) for side in (-1, 1))
        sample, other = self.tree.query(shapely.box(*(points - low).T, *(points + high).T))
        since = way[sample] - self.begun[other]
        cut = np.minimum(since, self.lengths[other])  # the length of the element that is cut by then
        line, cleared, off = self.line[other], cut >= self.least[other], since > self.lengths[other]
        seen = ((self._lines, cleared & line), (self._arcs, cleared & ~line))
        parts = _together([look(sample[which], points, other[which], cut[which], off[which]) for look, which in seen])
        low, high = _bounds(parts, self.radius)
        # The front half reaches from -90° to 90°: a stretch that begins in it or later may come round into it again.
        first = np.where(parts.side > 0, low, -high) + parts.base - heading[parts.sample]
        begin = np.mod(first + QUARTER, 4 * QUARTER) - QUARTER
        begin, end = np.concatenate([begin, begin - 4 * QUARTER]), np.concatenate([begin, begin - 4 * QUARTER])
        end += np.tile(high - low, 2)
        begin, end, sample = np.maximum(begin, -QUARTER), np.minimum(end, QUARTER), np.tile(parts.sample, 2)
        some = begin < end
        return sample[some], begin[some], end[some]

    def _lines(
        self, sample: NDArray[np.intp], points: Floats, other: NDArray[np.intp], cut: Floats, off: NDArray[np.bool_]
    ) -> _Parts:
        """Lines: the base is the direction to the foot of the place, h away.

        The edge of what a line clears lies R beside it, on the rim at the angle arccos(h/R - 1); the disc that touches it there
        stands R·sin of that from the foot.
        """
        along, here, radius = self.along[other], points[sample], self.radius
        left, first = off * (self.aside[other] - cross(along, here)), self.ahead[other] - dot(along, here)
        height = np.abs(left)
        reach = np.sqrt(np.maximum(4 * radius**2 - height**2, 0.0))
        begin, end = np.maximum(first, -reach), np.minimum(first + cut, reach)
        near = (begin <= end) & (reach > 0)
        sample, along = sample[near], along[near]
        left, height, begin, end = np.array([left, height, begin, end])[:, near]
        edge = np.arccos(height / radius - 1)
        side = np.where(left > 0, -1.0, 1.0)
        base = np.arctan2(along[:, 1], along[:, 0]) - side * QUARTER
        touches = _touching(begin, end, radius * np.sin(edge), SLACK)
        return _Parts(sample, base, side, np.array([[height, begin], [height, end]]), edge, *touches)

    def _arcs(
        self, sample: NDArray[np.intp], points: Floats, other: NDArray[np.intp], cut: Floats, off: NDArray[np.bool_]
    ) -> _Parts:
        """Arcs: the base is the direction to the nearest place of the whole circle.

        With the radius ρ of the arc and e = |p - centre|, a place of the arc at the angle β about the centre, from the one of p:

            d² = (ρ - e)² + 4·ρ·e·sin²(β/2)    within 2·R for |β| up to some angle: once, or twice where the arc goes far round
            edge of what is cleared: r = ρ + R, from inside (e < ρ) r = ρ - R; it is on the rim at the angle whose cosine is
            ±(r² - e² - R²) / (2·e·R) = (|ρ - e|·(ρ + e) - 2·ρ·R) / (2·e·R), and nowhere where that is below -1
        """
        arc, radius = self.curves.take(other), self.radius
        arm, size, sweep = points[sample] - arc.centre, arc.r, arc.sweep * cut / self.lengths[other]
        away, way = length_of(arm), np.arctan2(arm[:, 1], arm[:, 0])
        gap = off * (size - away)
        with np.errstate(divide="ignore", invalid="ignore"):
            far = 2 * np.arcsin(np.sqrt(np.clip((4 * radius**2 - gap**2) / (4 * away * size), 0.0, 1.0)))
            cosine = (np.abs(gap) * (size + away) - 2 * size * radius) / (2 * away * radius)
        edge, side = np.arccos(np.clip(cosine, -1.0, 1.0)), np.where(gap < 0, -1.0, 1.0)
        touch = np.arctan2(radius * np.sin(edge), away + side * radius * np.cos(edge))
        touch[~(cosine >= -1 - SLACK)] = np.inf
        spoke = arc.start - arc.centre
        start = np.arctan2(spoke[:, 1], spoke[:, 0]) + np.minimum(sweep, 0.0) - way  # of two ends the right one
        first = np.mod(start + 2 * QUARTER, 4 * QUARTER) - 2 * QUARTER
        base, parts = way + np.where(side > 0, 0.0, 2 * QUARTER), []
        for turn in (0.0, 4 * QUARTER):
            at = np.array([np.maximum(first - turn, -far), np.minimum(first + np.abs(sweep) - turn, far)])
            ends = np.stack([side * (gap - 2 * size * np.sin(at / 2) ** 2), size * np.sin(at)], axis=1)
            seen = (np.abs(gap) < 2 * radius) & (at[0] <= at[1])
            parts.append(_Parts(sample, base, side, ends, edge, *_touching(at[0], at[1], touch, SLACK / 1000)).only(seen))
        return _together(parts)


def _thinned(contour: Contour, radius: float) -> tuple[Contour, Floats]:
    """A contour, and the ways (n,) up to where its n elements end; of many short lines, such as a curve is told by, those chords
    that stay within R/4000 of them, and the ways along the lines themselves."""
    upto = contour.upto
    if contour.bulge.any() or len(contour.starts) * radius / FINE < upto[-1] or len(contour.starts) < FINE:
        return contour, upto[1:]
    points = np.column_stack([np.vstack([contour.starts, contour.ends[-1:]]), np.arange(len(upto))])
    kept = shapely.get_coordinates(
        shapely.simplify(shapely.LineString(points), radius / 4000, preserve_topology=False), include_z=True
    )
    return Contour(kept[:, :2], closed=False), upto[kept[1:, 2].astype(int)]


def _together(parts: Sequence[_Parts]) -> _Parts:
    columns: Any = (np.concatenate(column, axis=-1) for column in zip(*parts, strict=True))
    return _Parts(*columns)


def _touching(begin: Floats, end: Floats, touch: Floats, slack: float) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Whether parts from `begin` to `end` (n,) hold the places minus and plus `touch` (n,)."""
    begin, end = begin - slack, end + slack
    return (begin <= -touch) & (-touch <= end), (begin <= touch) & (touch <= end)


def _bounds(parts: _Parts, radius: float) -> tuple[Floats, Floats]:
    """The angles from which on and up to which parts of elements have cleared the rim."""
    towards, across = parts.ends[:, 0], parts.ends[:, 1]
    way, half = np.arctan2(across, towards), np.arccos(np.minimum(np.hypot(towards, across) / (2 * radius), 1.0))
    low, high = (way - half).min(axis=0), (way + half).max(axis=0)
    return np.where(parts.lower, np.minimum(low, -parts.edge), low), np.where(parts.upper, np.maximum(high, parts.edge), high)


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


def _open(sample: NDArray[np.intp], low: Floats, high: Floats, count: int, radius: float) -> tuple[Floats, ...]:
    """What the stretches leave of the front half of each rim: its angle, its width across the heading, its greatest cosine."""
    sample = np.concatenate([sample, np.arange(count)])  # a last stretch of no length ends every rim
    low, high = np.append(low, np.full(count, QUARTER)), np.append(high, np.full(count, QUARTER))
    order = np.argsort(low + 4.0 * sample)
    sample, low, high = sample[order], low[order], high[order]
    lift = 4.0 * sample  # sets the rims apart, so that one running maximum serves them all
    reach = np.maximum.accumulate(high + lift)
    before = np.maximum(np.concatenate([[-np.inf], reach[:-1]]), lift - QUARTER) - lift
    gap = low - before > TINY
    angle = np.bincount(sample[gap], (low - before)[gap], count)
    width = np.bincount(sample[gap], radius * (np.sin(low) - np.sin(before))[gap], count)
    thickness = np.zeros(count)
    np.maximum.at(thickness, sample[gap], np.cos(np.clip(0.0, before[gap], low[gap])))
    return np.asarray(angle, dtype=float), np.asarray(width, dtype=float), thickness
