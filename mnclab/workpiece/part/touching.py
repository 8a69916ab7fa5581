"""Where a ball touches a part, and with which place of the surface."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from mnclab.text.given import check_number, check_point
from mnclab.workpiece.part.part import Floats, Part
from mnclab.workpiece.part.shapes import unit

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
OFF = 1e-4  # mm: a foot farther from the surface than this is none


def contact(
    part: Part, start: ArrayLike, direction: ArrayLike, radius: float, reach: float, creep: float = CREEP
) -> float | None:
    """How far a ball travels from `start` along `direction` until it touches: distance(centre) = radius.

    0 if it touches already, None if it does not within `reach`. A gap changes by no more than the way, so
    nothing stands between two places no farther apart than their gaps together: the ball goes ahead by its
    gap, and on as long as this holds. Where the gap is small it creeps by steps of `creep` mm, and may miss a
    graze of less than a nanometre. Then it settles between the last free place and the first one that is not.
    """
    check_point(start, "where a ball starts")
    check_point(direction, "the direction of a probe")
    check_number(radius, "the radius of a ball", at_least=0)
    check_number(reach, "how far a ball travels (mm)", at_least=0)
    origin, ahead = np.asarray(start, dtype=float), unit(direction, "the direction of a probe")

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
    """
    check_point(centre, "the centre of a ball")
    here = np.asarray(centre, dtype=float)
    around = part(np.vstack([here, here + SMALL * np.eye(3), here - SMALL * np.eye(3)]))
    away = (around[1:4] - around[4:]) / (2 * SMALL)
    size = float(np.linalg.norm(away))
    found = here - around[0] * away / size if size > 0.5 else here
    return found, abs(float(part(found)[0])) <= OFF + 2 * (part.steep - 1) * abs(float(around[0]))
