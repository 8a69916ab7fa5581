"""Rings and lines without sharp corners: rounded rings with tangent leads from one to the next, lines with round turns.

The area within a ring is made smaller by the smallest radius r and larger again: every corner is an arc then, no arc is
smaller, and all else stays what it was. In a corner of the interior angle α the ring keeps r·(1 / sin(α/2) - 1) from it, which
the next ring outside clears as long as stepover and r together stay below the tool radius; the wall is run as it is.
Leads and turns are the shortest tangent ways (`tangent`) of a few large radii; where none fits the tool lifts. Lengths in mm.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

import numpy as np

from mnclab.geometry.contours import Contour, joined
from mnclab.geometry.curves import Floats, cross, length_of
from mnclab.geometry.regions import Region
from mnclab.machining.milling.clearing import Clearing, Piece, end, numbered, piecewise, round_walls
from mnclab.machining.milling.lines import segments_at, to_and_fro
from mnclab.machining.milling.rings import Ring, in_order, rings_of, rounded
from mnclab.machining.milling.tangent import Place, is_smooth, tangent_way

TENTH = 0.1  # of the tool radius: the smallest radius of a path, if none is given
AHEAD = (1.5, 2.5, 4.0, 1.0, 0.0, -1.5)  # stepovers from the nearest place of a ring to where a lead meets it
FURTHER = (0.0, 1.0, 2.0, 4.0)  # stepovers that a ring is run beyond its end
ASIDE = 3.0  # stepovers up to which a turn may go through what stands, as a line does
TRIMS = (0.0, 0.5, 1.0)  # stepovers by which a line may end earlier to give its turn room


def rounded_rings(
    region: Region, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True, smallest: float | None = None
) -> Clearing:
    """Rings from the inside out without a corner sharper than `smallest` (None: a tenth of the tool radius) but in the last
    pass along walls and islands; from each a tangent lead goes to the next one.

    >>> pocket = mnc.area.Region.of(mnc.area.rectangle(40, 20))
    >>> len(mnc.strategies.rounded_rings(pocket, 4, 3).pieces)  # it goes down once
    1
    """
    least = _least(smallest, radius)
    return piecewise(region, radius, stepover, allowance, lambda part: _rings(part, radius, stepover, climb, least))


def rounded_zigzag(
    region: Region, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True, angle: float = 0.0,
    smallest: float | None = None,
) -> Clearing:  # fmt: skip
    """Lines in the direction `angle`, to and fro, with round turns; then walls and islands in one sense, with tangent leads.

    No turn is sharper than `smallest` (None: a tenth of the tool radius); between straight walls it is a half circle.

    >>> pocket = mnc.area.Region.of(mnc.area.rectangle(40, 20))
    >>> len(mnc.strategies.rounded_zigzag(pocket, 4, 3).pieces)  # it goes down once
    1
    """
    least = _least(smallest, radius)
    return piecewise(region, radius, stepover, allowance, lambda part: _zigzag(part, radius, stepover, climb, angle, least))


def _least(smallest: float | None, radius: float) -> float:
    if smallest is not None and not smallest > 0:
        raise ValueError(f"the smallest radius of the path must be greater than 0, got {smallest:g}")
    return TENTH * radius if smallest is None else smallest


def _rings(centres: Region, radius: float, stepover: float, climb: bool, least: float) -> Piece:
    rings = [ring.contour for ring in in_order(_without_corners(rings_of(centres, radius, stepover), least))]
    chain = Chain(centres, stepover, least)
    for ring, name in zip(rings, numbered("ring", len(rings)), strict=True):
        chain.ring(ring if climb else ring.reversed(), name)
    return chain.piece()


def _without_corners(rings: Iterator[Ring], least: float) -> Iterator[Ring]:
    """Rings with an arc in every corner, but for those at the walls, which are as they are."""
    for level, alike in groupby(rings, key=lambda ring: ring.level):
        if not level:
            yield from alike
            continue
        round_ = Region(tuple(ring.contour for ring in alike)).inset(least).offset(least)
        for loop in round_.loops:  # what meets again on the way out makes corners to the other side
            smooth = rounded(loop.reversed(), least).reversed()
            yield Ring(level, smooth.area < 0, smooth)


def _zigzag(centres: Region, radius: float, stepover: float, climb: bool, angle: float, least: float) -> Piece:
    inner = centres.inset(min(stepover, radius - stepover / 2))
    rows = to_and_fro(segments_at(inner, stepover, angle)) if inner.loops else []
    chain = Chain(centres, stepover, least)
    for line, name in zip(rows, numbered("line", len(rows)), strict=True):
        chain.line(line, name)
    walls: list[Contour] = chain.passes[-1:]
    names: list[str] = []
    round_walls(centres, walls, names, climb)
    for ring, name in zip(walls[-len(names) :], names, strict=True):
        chain.ring(ring, name)
    return chain.piece()


class Chain:
    """Passes one after the other, with tangent ways between them where such fit."""

    def __init__(self, centres: Region, stepover: float, least: float) -> None:
        self.centres, self.stepover, self.least = centres, stepover, least
        self.radii = np.unique(np.maximum(least, stepover * np.array([1.5, 0.5, 0.25, 0.0])))[::-1].tolist()
        self.passes: list[Contour] = []
        self.labels: list[str] = []
        self.linked: list[bool] = []

    def piece(self) -> Piece:
        return Piece(self.centres, tuple(self.passes), tuple(self.linked[1:]), tuple(self.labels))

    @property
    def end(self) -> Floats:
        return end(self.passes[-1])

    def add(self, contour: Contour, label: str, linked: bool) -> None:
        self.passes.append(contour)
        self.labels.append(label)
        self.linked.append(linked)

    def ring(self, ring: Contour, label: str) -> None:
        """A closed pass, begun where a tangent way meets it."""
        if self.passes:
            last = self.passes[-1]
            leave = self.beyond(last) if last.closed else self.trimmed(last, True)
            near = ring.nearest(self.end)
            ways = [near + f * self.stepover for f in AHEAD]
            arrive = [Place(*ring.point_at(way), 0.0) for way in ways]
            found = tangent_way(self.centres, leave, arrive, self.radii, self.stepover, self.passes)
            if found:
                i, k, way = found
                if last.closed:
                    way = joined([last.between(0.0, leave[i].cost), way]) if i else way
                else:
                    self.passes[-1] = last.between(0.0, last.length - leave[i].cost)
                self.add(way, "lead", True)
                self.add(ring.started_at(ways[k]), label, True)
                return
        self.add(ring, label, False)

    def line(self, line: Contour, label: str) -> None:
        """A line, begun where a turn from the line before meets it."""
        if self.passes:
            last = self.passes[-1]
            leave, arrive = self.trimmed(last, True), self.trimmed(line, False)
            way = line.points[0] - last.points[-1]
            half = float(abs(cross(last.tangents()[1][-1], way))) / 2  # the radius of a turn between straight walls
            radii = [half, *self.radii] if half > self.least else self.radii
            cleared = self.passes if length_of(way) > ASIDE * self.stepover else None
            found = tangent_way(self.centres, leave, arrive, radii, self.stepover, cleared)
            if found:
                i, k, turn = found
                self.passes[-1] = last.between(0.0, last.length - leave[i].cost)
                self.add(turn, "turn", True)
                self.add(line.between(arrive[k].cost, line.length), label, True)
                return
        self.add(line, label, False)

    def beyond(self, ring: Contour) -> list[Place]:
        """Where a ring may be left that is run on beyond its end: at a wall not after a corner."""
        runs = [f * self.stepover for f in FURTHER if f * self.stepover < ring.length]
        smooth = [run for run in runs if is_smooth(ring.between(0.0, run), self.least)]
        return [Place(*ring.point_at(run), run) for run in smooth]

    def trimmed(self, line: Contour, end: bool) -> list[Place]:
        """Where a line may be left, or met, so that it loses no more than a third of its length."""
        cuts = [cut * self.stepover for cut in TRIMS if cut * self.stepover <= line.length / 3]
        return [Place(*line.point_at(line.length - cut if end else cut), cut) for cut in cuts]
