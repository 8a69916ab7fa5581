"""Clearing an area with islands on rings that follow its contours, from the inside out. Lengths in mm.

    C = area inset by R + allowance         where the centre of a tool of radius R may go
    rings = boundaries of C inset by 0, k, 2·k …        until nothing is left

With a stepover k ≤ R the tool clears all that it can reach: what a last ring encloses is nearer to it than k.
With k > R a core may stand inside a last ring; it gets a ring of its own, at R from the last one. What still
stands then, in sharp corners and along narrow arms between two rings, is the price of so wide a step.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import count

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Curves, Floats, cross, dot, left, length_of, unit_of
from mnclab.geometry.curves import rounded as arcs_between
from mnclab.geometry.regions import Region
from mnclab.machining.milling.clearing import NOWHERE, Clearing, Piece, links, numbered, piecewise
from mnclab.machining.milling.terraces import roomiest

MOST_RINGS = 2000
SHARP = 1e-6  # rad and mm, the least turn of a corner and the shortest element


@dataclass(frozen=True, eq=False)
class Ring:
    """A closed pass: its `level` in stepovers inward from the boundary of the tool-centre area, and what it goes round."""

    level: float
    island: bool
    contour: Contour


def rings(
    region: Region, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True,
    corner_radius: float = 0.0, roomiest_first: bool = False,
) -> Clearing:  # fmt: skip
    """Passes that clear `region` with a tool of `radius`, leaving `allowance` at its walls.

    Rings round islands come first, then those along the walls. In climb milling, the spindle turning clockwise, walls are
    followed counter-clockwise. `corner_radius` rounds the inside corners of the last passes, as measured on the tool centre.
    `roomiest_first` enters each piece at its infeed point and goes on at the ring nearest to it.

    >>> pocket = mnc.area.Region.of(mnc.area.rectangle(40, 20))
    >>> print(f"{mnc.strategies.rings(pocket, 4, 4).length:.3f}")  # rings of 32 x 12 and 24 x 4 mm
    144.000
    """
    if corner_radius < 0:
        raise ValueError(f"the corner radius must not be negative, got {corner_radius:g}")
    return piecewise(
        region, radius, stepover, allowance,
        lambda part: _piece(part, radius, stepover, climb, corner_radius, roomiest(part) if roomiest_first else None),
    )  # fmt: skip


def rings_within(
    centres: Region, radius: float, stepover: float, *, climb: bool = True, corner_radius: float = 0.0
) -> Clearing:
    """The same where the area in which the tool centre may go is known."""
    parts = tuple(_piece(part, radius, stepover, climb, corner_radius, None) for part in centres.parts)
    return Clearing(centres, parts, radius)


def rounded(loop: Contour, radius: float) -> Contour:
    """A closed contour with an arc in place of every corner to the left in which an arc of this radius fits."""
    turns, curves, sweeps, lengths = loop.turns(), loop.curves, loop.sweeps, loop.lengths
    sharp = np.flatnonzero((turns > SHARP) & (turns < np.pi - SHARP) & (radius > 0))
    before, after = curves.take(sharp - 1), curves.take(sharp)
    half = (np.pi - turns[sharp]) / 2
    ahead = loop.tangents()[0][sharp]
    bisector = np.cos(half)[:, None] * ahead + np.sin(half)[:, None] * left(ahead)
    corner = loop.points[sharp]
    found = arcs_between(before, after, np.full(len(sharp), radius), corner + (radius / np.sin(half))[:, None] * bisector)
    off = [np.abs(length_of(foot - found.centre) - radius) for foot in (found.first, found.last)]
    fits = (np.maximum(*off) <= 1e-6) & (_reach(before, radius) > 0) & (_reach(after, radius) > 0)
    cut = _way(before, found.first, corner), _way(after, corner, found.last)
    taken = np.zeros((2, len(lengths)))  # of each element, at its start and at its end
    arcs: dict[int, tuple[Floats, Floats, float]] = {}  # corner: where the arc begins and ends, its bulge
    for k in np.flatnonzero(fits).tolist():
        i, first, last = int(sharp[k]), float(cut[0][k]), float(cut[1][k])
        if 0 < first <= lengths[i - 1] - taken[0, i - 1] and 0 < last <= lengths[i] - taken[1, i]:
            taken[1, i - 1], taken[0, i] = first, last
            arcs[i] = found.first[k], found.last[k], float(np.tan(found.sweep[k] / 4))
    if not arcs:
        return loop
    kept = np.tan(sweeps * np.clip(1 - taken.sum(axis=0) / lengths, 0, 1) / 4)
    points, bulge = [], []
    for i, corner in enumerate(loop.points):
        first, last, bent = arcs.get(i, (corner, corner, 0.0))
        points += [first, last]
        bulge += [bent, kept[i]]
    full = Contour(points, bulge)
    some = full.lengths > SHARP  # two arcs may use up what was between them
    return Contour(full.points[some], full.bulge[some])


def _reach(curve: Curves, distance: float) -> Floats:
    """The radii (n,) of curves at a distance to their left, infinite for lines."""
    return np.where(curve.arc, curve.r - np.sign(curve.sweep) * distance, np.inf)


def _way(curve: Curves, start: Floats, end: Floats) -> Floats:
    """The signed ways (n,) from start to end (n, 2) along lines, or along arcs in the sense of their sweeps."""
    arms = start - curve.centre, end - curve.centre
    round_ = curve.r * np.sign(curve.sweep) * np.arctan2(cross(*arms), dot(*arms))
    return np.where(curve.arc, round_, dot(end - start, unit_of(curve.end - curve.start)))


def _piece(
    centres: Region, radius: float, stepover: float, climb: bool, corner_radius: float, place: Floats | None
) -> Piece:
    """The rings of one connected piece of the tool-centre area, in order and joined."""
    passes = tuple(ring.contour for ring in rings_in_order(centres, radius, stepover, corner_radius, place))
    linked = links(centres, passes, stepover)
    turned = passes if climb else tuple(ring.reversed() for ring in passes)
    return Piece(centres, turned, linked, numbered("ring", len(passes)), place)


def rings_in_order(
    centres: Region, radius: float, stepover: float, corner_radius: float = 0.0, begin: Floats | None = None
) -> Iterator[Ring]:
    """The rings of a connected piece of the tool-centre area from the inside out, each begun nearest to the end of the last.

    A ring round an island waits for the deeper rings about it; a ring along a wall for all islands and for
    the deeper rings within it. Of those that need not wait the nearest comes next: one branch at a time.
    """
    return in_order(rings_of(centres, radius, stepover, corner_radius), begin)


def in_order(rings: Iterable[Ring], begin: Floats | None = None) -> Iterator[Ring]:
    """Rings of a connected piece in the order of `rings_in_order`, each begun nearest to the end of the last."""
    todo = list(rings)
    if not todo:
        return
    starts = np.array([ring.contour.points[0] for ring in todo])
    level = np.array([ring.level for ring in todo])
    island = np.array([ring.island for ring in todo])
    within = np.array([ring.contour.winding(starts) != 0 for ring in todo])  # [i, k]: k lies within i
    deeper = level[None, :] > level[:, None]
    waits = np.where(island[:, None], within.T & island & deeper, island | (within & deeper))
    boxes = np.array([ring.contour.bounds for ring in todo])
    left_over = np.ones(len(todo), dtype=bool)
    here = begin
    while left_over.any():
        free = np.flatnonzero(left_over & ~(waits & left_over).any(axis=1))
        if here is None:
            k = free[np.argmax(level[free])]
            lengths = todo[k].contour.lengths
            way = float(lengths[: int(lengths.argmax())].sum() + lengths.max() / 2)
        else:
            k = _nearest(todo, boxes, free, here)
            way = todo[k].contour.nearest(here)
        left_over[k] = False
        ring = replace(todo[k], contour=todo[k].contour.started_at(way))
        here = ring.contour.points[0]
        yield ring


def _nearest(todo: Sequence[Ring], boxes: Floats, free: NDArray[np.intp], here: Floats) -> int:
    """Which of the free rings is nearest to a place; `boxes` (n, 2, 2) are about the rings."""
    outside = np.maximum(boxes[free, 0] - here, here - boxes[free, 1]).max(axis=1)
    order = np.argsort(outside, kind="stable")
    best, least = int(free[order[0]]), np.inf
    for k, off in zip(free[order].tolist(), outside[order].tolist(), strict=True):
        if off > least:
            break
        way = float(todo[k].contour.distance(here)[0])
        if (way, k) < (least, best):
            best, least = k, way
    return best


def rings_of(centres: Region, radius: float, stepover: float, corner_radius: float = 0.0) -> Iterator[Ring]:
    """The rings of a piece, level by level, with a core ring wherever one more step would leave a core standing."""
    if np.ptp(centres.loops[0].bounds, axis=0).min() / 2 > MOST_RINGS * stepover:
        raise ValueError(f"a stepover of {stepover:g} makes more than {MOST_RINGS} rings")
    found = centres.insets(stepover)
    deeper = next(found)
    for level in count():
        here, deeper = deeper, next(found, NOWHERE)
        for loop in here.loops:
            yield Ring(level, loop.area < 0, loop if level else rounded(loop, corner_radius))
        for core in here.inset(radius).parts if stepover > radius else ():
            if not any(core.contains(loop.points[:1])[0] for loop in deeper.loops):
                yield from (Ring(level + radius / stepover, loop.area < 0, loop) for loop in core.loops)
        if not deeper.loops:
            return
