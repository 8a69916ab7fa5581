"""Finishing the floors of an area whose depth differs from place to place: on rings, each floor once. Lengths in mm.

    ─┐           ┌──    G of a terrace, its tool-centre area C = G inset by R + allowance
     └──┐     ┌──┘      its floor: what of G the next terrace does not take; the tool may reach out over that one,
        └─────┘         so the rings lie in C as far as R about the floor

The tool comes down to a pass on a quarter circle in the plane ZX that touches the floor, from the side that has room for
it; else straight. Feeds in mm/min.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

from mnclab.geometry.regions import Region
from mnclab.machining.milling.clearing import Clearing, begin
from mnclab.machining.milling.rings import rings, rings_within
from mnclab.machining.milling.terraces import SLIVER, Terrace
from mnclab.machining.steps import RAPID, Along, Dip, Go, Step


class Floor(NamedTuple):
    """A floor at a depth below the surface, positive, and what clears it: no piece where the tool does not reach it."""

    depth: float
    clearing: Clearing


class Descent(NamedTuple):
    """How the tool comes down: from the height `first` to the first pass, from `above` to the others, on an arc of a radius.

    `up` is 1 where it works downwards, -1 upwards; an arc of the radius 0 is a straight way.
    """

    first: float
    above: float
    arc: float
    up: int
    feed: float


def floor_passes(
    found: Sequence[Terrace], radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True,
    corner_radius: float = 0.0,
) -> Iterator[Floor]:  # fmt: skip
    """The floors of terraces from the top down; a ValueError where the tool does not fit into the last one."""
    for upper, lower in pairwise(found):
        floor = upper.region.difference(lower.region)
        if floor.area > SLIVER:
            about = floor.offset(radius).intersection(upper.region.inset(radius + allowance))
            yield Floor(upper.bottom, rings_within(about, radius, stepover, climb=climb))
    last = rings(
        found[-1].region, radius, stepover, allowance=allowance, climb=climb, corner_radius=corner_radius
    )
    yield Floor(found[-1].bottom, last)


def finish_floor(name: str, clearing: Clearing, level: float, down: Descent, feed: float) -> Iterator[Step]:
    """All passes of a clearing on one level; the tool ends on the last one."""
    height = down.first
    for piece in clearing.pieces:
        for contour, label, linked in zip(piece.passes, piece.labels, (False, *piece.linked), strict=True):
            x, y = begin(contour).tolist()
            if linked:
                yield Go(f"{name}, link", None, feed, x, y)
            else:
                from_x = _begin_of_arc(piece.centres, x, y, down.arc)
                yield Go(f"{name}, to the clearance height", height)
                yield Go(f"{name}, over the start", None, RAPID, from_x, y)
                yield Go(f"{name}, to the set-up clearance", down.above)
                yield Go(f"{name}, down", level + down.up * abs(x - from_x), down.feed)
                if from_x != x:
                    yield Dip(f"{name}, approach", x, level, down.feed)
                height = down.above
            yield Along(f"{name}, {label}", contour, feed)


def _begin_of_arc(centres: Region, x: float, y: float, radius: float) -> float:
    """Where along X the arc to a place begins: the side from which it stays inside, or the place itself."""
    sides = (x - radius, x + radius) if radius > 0 else ()
    return next((side for side in sides if centres.holds((side, y), (x, y))), x)
