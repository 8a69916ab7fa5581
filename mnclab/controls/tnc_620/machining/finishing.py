"""Finishing: round a figure, the walls of an area, and floors whose depth differs from place to place."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, left
from mnclab.geometry.regions import Region
from mnclab.machining.milling.clearing import Clearing, begin, end, numbered, unfit
from mnclab.machining.milling.pocket_steps import LEAST, LevelFeeds, quarter_circles
from mnclab.machining.milling.rings import rings, rings_within, rounded
from mnclab.machining.milling.terraces import SLIVER, Terrace
from mnclab.machining.steps import RAPID, Along, Dip, Go, Step

# Finishing round a figure from a place beside its wall: down, up to the wall on an arc, round, off it, back; on every level.
# The tool stays on its level between two rounds, for all of that way is clear. Lengths in mm, feeds in mm/min.

Place = tuple[float, float]


def finish_rounds(
    wall: Contour, arcs: Sequence[Contour], start: Place, levels: Sequence[float], feeds: LevelFeeds
) -> Iterator[Step]:
    """Round a closed `wall` on each of the `levels`, from `start` and back to it; `arcs` lead to the wall and off it, if any."""
    x, y = first = begin(arcs[0] if arcs else wall).tolist()
    aside = math.dist(first, start) > LEAST
    for name, level in zip(numbered("finishing", len(levels)), levels, strict=True):
        yield Go(f"{name}, down", level, feeds.plunge)
        if aside:
            yield Go(f"{name}, to the approach", None, feeds.level, x, y)
        names = (f"{name}, to the wall", name, f"{name}, off the wall") if arcs else (name,)
        for label, way in zip(names, (*arcs[:1], wall, *arcs[1:]), strict=True):
            yield Along(label, way, feeds.level)
        if math.dist(end(arcs[-1] if arcs else wall), start) > LEAST:
            yield Go(f"{name}, back to the start", None, feeds.level, *start)


# Finishing the walls of an area: each boundary on its own, up to it and off it on quarter circles that stay inside.
#     C = area inset by R + allowance      where the tool centre may go; its boundaries, corners rounded, are the passes
#     g                                    radius of the quarter circles, with their centre at p + g·n, n from the wall
#                                          into the area; they and the way from end to start lie in the disc about it
# A pass begins in the middle p of its longest element that has room for such a disc. Where none has, the tool comes
# straight along n and leaves the same way. The first way in and the last way out may be helices, from and to a `rise` above
# their level. Lengths in mm, feeds in mm/min.

SLACK = 1e-7  # mm, by which an arc may leave the area
HALVINGS = 40


class Wall(NamedTuple):
    """A closed pass along a boundary and the open ways to it and off it."""

    contour: Contour
    approach: Contour
    departure: Contour
    tangential: bool

    @property
    def start(self) -> tuple[float, float]:
        """Where the tool goes down."""
        x, y = begin(self.approach).tolist()
        return x, y


class Heights(NamedTuple):
    """Along the tool axis: the levels, first to last, how far above the last one its helices begin, where rapids go.

    `first` is the height of the way to the first wall, `above` that of the ways between walls. A `rise` counts upwards,
    where the tool works upwards it is negative.
    """

    levels: Sequence[float]
    rise: float
    first: float
    above: float


def wall_loops(
    region: Region, radius: float, *, allowance: float = 0.0, corner_radius: float = 0.0, climb: bool = True,
    lead: float | None = None, least: float = 0.0, solid: bool = False,
) -> tuple[Wall, ...]:  # fmt: skip
    """The walls of an area for a tool of a radius, islands before the wall about them; a ValueError where it does not fit.

    `lead` is the radius of the quarter circles (None: half the tool radius), shortened down to `least` to stay inside.
    `corner_radius` rounds inside corners, as measured on the tool centre. In climb milling, the spindle turning clockwise,
    walls are followed counter-clockwise and islands clockwise. A `solid` region stays, and is gone round outside.
    """
    if not radius > 0:
        raise ValueError(f"the tool radius must be greater than 0, got {radius:g}")
    wish = max(radius / 2 if lead is None else lead, least)
    free = outside(region, 2 * (radius + abs(allowance) + wish) + 1) if solid else region
    centres = free.inset(radius + allowance)
    loops = [loop for part in centres.parts for loop in (*part.loops[1:], part.loops[0])]
    if solid:
        loops.remove(max(loops, key=lambda loop: loop.area))  # the edge of what is outside
    if not loops:
        raise ValueError(unfit(free, radius, allowance))
    return tuple(_wall(centres, rounded(loop, corner_radius), wish, least, climb) for loop in loops)


def outside(region: Region, margin: float) -> Region:
    """What lies around a region, to a rectangle `margin` away from it."""
    (left_, below), (right, above) = region.bounds + np.array([[-margin], [margin]])
    corners = [(left_, below), (right, below), (right, above), (left_, above)]
    return Region.of(Contour(corners)).difference(region)


def finish_walls(walls: Sequence[Wall], at: Heights, plunge: float, feed: float) -> Iterator[Step]:
    """Every wall on all its levels, one after the other, from above; the tool ends at the last level of the last wall."""
    height = at.first
    for which, wall in zip(numbered("wall", len(walls)), walls, strict=True):
        yield Go(f"{which}, to the clearance height", height)
        yield Go(f"{which}, over the start", None, RAPID, *wall.start)
        yield Go(f"{which}, to the set-up clearance", at.above)
        for label, level in zip(numbered("infeed", len(at.levels)), at.levels, strict=True):
            rise = at.rise if wall.tangential and level == at.levels[-1] else 0.0
            yield Go(f"{which}, {label}, back to the start", None, feed, *wall.start)
            yield Go(f"{which}, {label}, down", level + rise, plunge)
            yield Along(f"{which}, {label}, approach", wall.approach, feed, [level + rise, level])
            yield Along(f"{which}, {label}", wall.contour, feed)
            yield Along(f"{which}, {label}, departure", wall.departure, feed, [level, level + rise])
        height = at.above


def _wall(centres: Region, loop: Contour, wish: float, least: float, climb: bool) -> Wall:
    """A boundary of the tool-centre area, which lies to its left, begun where its arcs have room."""
    upto = np.cumsum(loop.lengths) - loop.lengths / 2
    places, ahead = loop.point_at(upto)
    inwards = left(ahead)
    room = centres.distance(places + least * inwards) >= least - SLACK
    k = int(np.argmax(np.where(room, loop.lengths, 0.0) if room.any() else loop.lengths))
    contour = loop.started_at(float(upto[k]))
    contour = contour if climb else contour.reversed()
    reach = _widest(centres, places[k], inwards[k], wish, least) if room.any() else 0.0
    if reach > LEAST:
        approach, departure = quarter_circles(contour, reach, 1 if climb else -1)
        return Wall(contour, approach, departure, tangential=True)
    straight = _straight(centres, contour.points[0], inwards[k], wish)
    return Wall(contour, straight, straight.reversed(), tangential=False)


def _widest(centres: Region, place: Floats, inwards: Floats, wish: float, least: float) -> float:
    """The greatest radius, from `least` to `wish`, of a disc inside that touches the boundary at a place."""

    def fits(radius: float) -> bool:
        return bool(centres.distance([place + radius * inwards])[0] >= radius - SLACK)

    if fits(wish):
        return wish
    low, high = least, wish  # a disc that fits holds all smaller ones that touch there
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if fits(middle) else (low, middle)
    return low


def _straight(centres: Region, place: Floats, inwards: Floats, wish: float) -> Contour:
    """The straight way to a place from where, along the normal, the tool is clearest of the walls: without room from itself."""
    far = place + wish * np.append(0.5 ** np.arange(HALVINGS), 0.0)[:, None] * inwards
    clear = np.where([centres.holds(spot, place) for spot in far], centres.distance(far), -1.0)
    return Contour([far[int(clear.argmax())], place], closed=False)


# Finishing the floors of an area whose depth differs from place to place: on rings, each floor once. Lengths in mm.
#     ─┐           ┌──    G of a terrace, its tool-centre area C = G inset by R + allowance
#      └──┐     ┌──┘      its floor: what of G the next terrace does not take; the tool may reach out over that one,
#         └─────┘         so the rings lie in C as far as R about the floor
# The tool comes down to a pass on a quarter circle in the plane ZX that touches the floor, from the side that has room for
# it; else straight. Feeds in mm/min.

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
