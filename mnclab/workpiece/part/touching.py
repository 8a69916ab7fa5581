"""Where a ball touches a part, with which place of the surface, and whether a probe meets it on a row where it should not."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from mnclab.text.given import check_number, check_point
from mnclab.workpiece.part.part import Floats, Part
from mnclab.workpiece.part.shapes import unit_vector

# Where a ball touches a part, and with which place of the surface.

TOUCHING = 1e-10  # mm, a gap that counts as closed
SETTLED = 1e-13  # mm, a gap that is none
CREEP = 1e-4  # mm, the step where the gap gets smaller than this
GRAZE = 0.05  # mm, the step of a ball that is only positioned: one of 2 mm sinks in by 0.2 µm between two places
FEW = 8  # places looked at first, then twice as many each time
CLOSER = 0.3 ** np.arange(1, 24)  # of the rest of a way: how far before its end it is looked at
FAR = 10.0  # gaps: a contact that is not farther off is gone for
ASIDE = 10.0 ** -np.arange(1, 9)  # of a span: how far beside the place that the secant tells others are tried
EVENLY = np.arange(1, 8) / 8
SMALL = 1e-5  # mm, between places whose distances are compared for a direction
FREE = 2e-10  # mm, a gap that is surely one: numbers are no better
OFF = 1e-4  # mm: a foot farther from the surface than this is none


def contact(
    part: Part, start: ArrayLike, direction: ArrayLike, radius: float, reach: float, creep: float = CREEP
) -> float | None:
    """How far a ball travels from `start` along `direction` until it touches: distance(centre) = radius.

    0 if it touches already, None if it does not within `reach`. A gap changes by no more than the way, so
    nothing stands between two places no farther apart than their gaps together: the ball goes ahead by its
    gap, and on as long as this holds. Where the gap is small it creeps by steps of `creep` mm, and may miss a
    graze of less than a nanometre. Then it settles between the last free place and the first one that is not.

    >>> block = mnc.part.box((0, 0, -20), (60, 40, 0))
    >>> print(f"{mnc.part.contact(block, (75, 20, -5), (-1, 0, 0), 3, 50):.3f}")  # 75 - 60 - 3
    12.000
    """
    check_point(start, "where a ball starts")
    check_point(direction, "the direction of a probe")
    check_number(radius, "the radius of a ball", at_least=0)
    check_number(reach, "how far a ball travels (mm)", at_least=0)
    origin, ahead = np.asarray(start, dtype=float), unit_vector(direction, "the direction of a probe")

    def gap(travel: Floats) -> Floats:
        return np.asarray((part(origin + travel[:, None] * ahead) - radius) / part.steep)

    closer = CLOSER[:: max(1, 24 // part.at_once)]
    free, room, look, nearer = 0.0, float(gap(np.zeros(1))[0]), FEW, np.zeros(0)
    while room > TOUCHING:
        if free > reach:
            return None
        step = max(room, creep)
        many = int(np.clip(np.ceil((reach - free) / step), 1, min(look, part.at_once)))
        places = np.union1d(free + step * np.arange(1.0, many + 1), nearer)
        gaps = gap(places)
        sure = np.append(room, gaps[:-1]) + gaps >= np.diff(places, prepend=free) - TOUCHING
        known = len(places) if room <= creep or sure.all() else max(int(sure.argmin()), 1)
        hit = np.flatnonzero(gaps[:known] <= TOUCHING)
        if len(hit):
            k = int(hit[0])
            while gaps[k] > SETTLED and k + 1 < known and gaps[k + 1] < gaps[k]:  # it is about to close
                k += 1
            last, at_last = (float(places[k - 1]), float(gaps[k - 1])) if k else (free, room)
            free = _settled(gap, last, at_last, float(places[k]), float(gaps[k]), part.at_once)
            break
        before, room_before = (float(places[known - 2]), float(gaps[known - 2])) if known > 1 else (free, room)
        free, room, look = float(places[known - 1]), float(gaps[known - 1]), 2 * look
        rest = room * (free - before) / max(room_before - room, TOUCHING)  # to the contact, by the secant
        there = np.append(rest * (1 - closer[closer * rest > TOUCHING]), rest + TOUCHING / 4)
        nearer = free + there if rest < FAR * room else np.zeros(0)
    return free if free <= reach + TOUCHING else None


def released(part: Part, start: ArrayLike, direction: ArrayLike, radius: float, reach: float) -> float | None:
    """How far a ball that touches, or that stands in the material, travels from `start` along `direction` until it is free:
    distance(centre) = radius. None if it still touches after `reach`."""
    origin, ahead = np.asarray(start, dtype=float), unit_vector(direction, "the direction of a probe")
    inside = Part(lambda p: radius + FREE - part(p), at_once=part.at_once, steep=part.steep)
    free = contact(inside, origin, ahead, 0.0, reach)
    touches = 0.0
    while free is not None and free - touches > SETTLED and touches < (half := (touches + free) / 2) < free:
        if float(part(origin + half * ahead)[0]) - radius > SETTLED:
            free = half
        else:
            touches = half
    return free


def _settled(
    gap: Callable[[Floats], Floats], free: float, at_free: float, blocked: float, at_blocked: float, at_once: int
) -> float:
    """The place between two at which the gap closes first: where the secant tells it, places ever nearer to that on both
    sides, and others evenly."""
    aside, evenly = (each[:: max(1, 24 // at_once)] for each in (ASIDE, EVENLY))
    while blocked - free > TOUCHING and abs(at_blocked) > SETTLED:
        here = at_free / (at_free - at_blocked)
        shares = np.unique(np.concatenate([here - aside, [here], here + aside, evenly]))
        places = free + (blocked - free) * shares[(shares > 0) & (shares < 1)]
        places = places[(places > free) & (places < blocked)]
        if not len(places):
            break
        gaps = gap(places)
        closed = np.flatnonzero(gaps <= SETTLED)
        k = int(closed[0]) if len(closed) else len(places)
        if k < len(places):
            blocked, at_blocked = float(places[k]), float(gaps[k])
        if k:
            free, at_free = float(places[k - 1]), float(gaps[k - 1])
    return blocked


def foot(part: Part, centre: ArrayLike) -> tuple[Floats, bool]:
    """The place (3,) of the surface that is next to a point, by the distance there, and whether the surface is there.

    It is not where a part is not `exact` and the point lies off a cut edge: a ball of that radius then stands farther off
    the part than its distance says.

    >>> place, found = mnc.part.foot(mnc.part.box((0, 0, -20), (60, 40, 0)), (30, 20, 5))
    >>> place.round(3).tolist(), found
    ([30.0, 20.0, 0.0], True)
    """
    check_point(centre, "the centre of a ball")
    here = np.asarray(centre, dtype=float)
    around = part(np.vstack([here, here + SMALL * np.eye(3), here - SMALL * np.eye(3)]))
    away = (around[1:4] - around[4:]) / (2 * SMALL)
    size = float(np.linalg.norm(away))
    found = here - around[0] * away / size if size > 0.5 else here
    return found, abs(float(part(found)[0])) <= OFF + 2 * (part.steep - 1) * abs(float(around[0]))


# Whether a probe meets the part on a straight row where it should not: its ball, or the stem above it.

RESTING = 1e-3  # mm: a ball that is no deeper in the material only rests on it
FINE = 0.01  # mm, within which a place is told
AT_FIRST = 6  # times that all is halved before anything is looked at


def blocked(
    part: Part, start: ArrayLike, end: ArrayLike, ball: float, stem: float = 0.0, length: float = 0.0,
    up: ArrayLike = (0.0, 0.0, 1.0),
) -> float | None:  # fmt: skip
    """How far a ball of a radius gets from start to end, (x, y, z) of its centre, before it meets the part; None if it never
    does. So does its `stem`, a cylinder of that radius and `length` from the centre of the ball `up`."""
    for place, name in ((start, "the start of a row"), (end, "the end of a row"), (up, "the direction of a stem")):
        check_point(place, name)
    check_number(ball, "the radius of a ball", above=0)
    check_number(stem, "the radius of a stem", at_least=0)
    check_number(length, "the length of a stem", at_least=0)
    origin, way = np.asarray(start, dtype=float), np.asarray(end, dtype=float) - np.asarray(start, dtype=float)
    reach = float(np.linalg.norm(way))
    ahead, axis = way / reach if reach else np.zeros(3), unit_vector(up, "the direction of a stem") * length
    found = _met(part, origin, ahead, reach, np.zeros(3), ball)
    by_stem = _met(part, origin, ahead, reach if found is None else found, axis, stem) if stem and length else None
    return found if by_stem is None else by_stem


def _met(part: Part, origin: Floats, ahead: Floats, reach: float, axis: Floats, radius: float) -> float | None:
    """How far all that is no farther than a radius from an axis (3,) goes before it meets the part; None within `reach` if it
    never does.

    The row times the axis is an area; of a cell of it nothing touches if the middle is farther off the part than the corners
    are from the middle, else it is looked at in halves, cut across its longer side.
    """
    halves = np.array([max(reach, FINE), float(axis.any())]) / 2  # of the way, mm, and of the axis
    sides, cells, first = np.array([1.0, float(np.linalg.norm(axis))]), halves[None], np.inf
    for _ in range(AT_FIRST):
        cells, halves = _halved(cells, halves, sides)
    while len(cells):
        wide = max(float(np.linalg.norm(halves[0] * ahead + sign * halves[1] * axis)) for sign in (1, -1))
        middles = origin + cells[:, :1] * ahead + cells[:, 1:] * axis
        beside = np.maximum(np.maximum(part.bounds[0] - middles, middles - part.bounds[1]), 0.0)  # the box around the part
        near = (beside**2).sum(axis=1) <= (radius + wide) ** 2
        cells, gaps = cells[near], (part(middles[near]) - radius) / part.steep if near.any() else np.zeros(0)
        met = gaps < -RESTING
        first = min(first, float(cells[met, 0].min(initial=np.inf)))
        if wide < FINE:
            break
        cells, halves = _halved(cells[(gaps <= wide) & (cells[:, 0] - halves[0] < first)], halves, sides)
    return float(np.clip(first, 0.0, reach)) if np.isfinite(first) else None


def _halved(cells: Floats, halves: Floats, sides: Floats) -> tuple[Floats, Floats]:
    """The middles (2 n, 2) and the halves (2,) of the cells (n, 2) after a cut; `sides` are mm for each unit of a half."""
    half = halves * (halves * sides == (halves * sides).max()) / 2
    if half.all():  # as long as wide
        half[1] = 0.0
    return (cells[:, None] + half * [[-1], [1]]).reshape(-1, 2), halves - half
