"""Lines and arcs as plain curves, and how far points and other curves are from them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.offsets import Element, meetings
from mnclab.geometry.vectors import Floats, cross, dot, length_of, turned

SLACK = 1e-9  # of a curve: beyond its ends a point is still on it


class Curves(NamedTuple):
    """n lines and arcs: `start`, `end`, `centre` (n, 2) mm, radius `r` (n,), nan for lines, `sweep` (n,) rad."""

    start: Floats
    end: Floats
    centre: Floats
    r: Floats
    sweep: Floats

    @property
    def arc(self) -> NDArray[np.bool_]:
        return ~np.isnan(self.r)

    def take(self, k: NDArray[np.int64] | NDArray[np.bool_]) -> Curves:
        return Curves(*(column[k] for column in self))


def share(p: Floats, curve: Curves) -> Floats:
    """Where the point of a curve nearest to p (n, 2) lies, 0 at its start and 1 at its end; beyond is not on it.

    For an arc it is where the ray from its centre through p meets its circle. A curve without length has no such point:
    nan or infinite, by which p is on none of it; its ends count alone.
    """
    travel = curve.end - curve.start
    with np.errstate(divide="ignore", invalid="ignore"):
        found = dot(p - curve.start, travel) / dot(travel, travel)
    k = np.flatnonzero(curve.arc)
    if len(k):
        a, b = curve.start[k] - curve.centre[k], p[k] - curve.centre[k]
        sense, sweep = np.sign(curve.sweep[k]), np.abs(curve.sweep[k])
        angle = np.arctan2(cross(a, b), dot(a, b)) * sense
        half = sweep / 2  # seen from the middle of the arc, what lies before the start is negative
        angle = (angle - half + np.pi) % (2 * np.pi) - np.pi + half
        angle = np.where(sweep >= 2 * np.pi, np.minimum(np.maximum(angle, 0), sweep), angle)
        with np.errstate(divide="ignore", invalid="ignore"):
            found[k] = angle / sweep
    return np.asarray(found)


def foot(p: Floats, curve: Curves) -> Floats:
    """The point (n, 2) of the whole line or circle nearest to p (n, 2); for the centre of an arc nan."""
    travel = curve.end - curve.start
    with np.errstate(divide="ignore", invalid="ignore"):
        found = curve.start + (dot(p - curve.start, travel) / dot(travel, travel))[:, None] * travel
        k = np.flatnonzero(curve.arc)
        if len(k):
            spoke = p[k] - curve.centre[k]
            found[k] = curve.centre[k] + spoke * (curve.r[k] / length_of(spoke))[:, None]
    return found


def nearest(p: Floats, curve: Curves) -> Floats:
    """The point (n, 2) of each curve nearest to p (n, 2)."""
    ends = np.where((length_of(p - curve.start) <= length_of(p - curve.end))[:, None], curve.start, curve.end)
    beside, where = foot(p, curve), share(p, curve)
    on = (where >= 0) & (where <= 1) & (length_of(p - beside) <= length_of(p - ends))  # not where beside is nan
    return np.asarray(np.where(on[:, None], beside, ends))


def distance(p: Floats, curve: Curves) -> Floats:
    """Distance (n,) of points p (n, 2) from curves, each from its own."""
    at_ends = np.minimum(length_of(p - curve.start), length_of(p - curve.end))
    where = share(p, curve)
    beside = length_of(p - foot(p, curve))
    on = (where >= 0) & (where <= 1) & np.isfinite(beside)
    return np.asarray(np.where(on, np.minimum(beside, at_ends), at_ends))


def gap(a: Curves, b: Curves) -> Floats:
    """The least distance (n,) between curves a and b, each from its own; 0 where they cross."""
    ends = distance(a.start, b), distance(a.end, b), distance(b.start, a), distance(b.end, a)
    least = np.minimum.reduce(ends)
    for p in crossings(a, b):
        least[np.isfinite(p[:, 0])] = 0.0
    for one, other in ((a, b), (b, a)):
        k = np.flatnonzero(one.arc)
        if len(k):  # square to both: through the centre of the arc
            arc, curve = one.take(k), other.take(k)
            near = foot(arc.centre, curve)
            for q in (near, np.where(curve.arc[:, None], 2 * curve.centre - near, near)):
                p = foot(q, arc)
                there = on(q, curve) & on(p, arc)
                least[k] = np.where(there, np.minimum(least[k], length_of(q - p)), least[k])
    return least


def part(curve: Curves, begin: Floats, end: Floats) -> Curves:
    """What lies between two shares (n,) of curves, 0 at their start and 1 at their end."""
    travel, turn = curve.end - curve.start, np.where(curve.arc, curve.sweep, 0.0)

    def at(where: Floats) -> Floats:
        spoke = turned(curve.start - curve.centre, turn * where)
        return np.where(curve.arc[:, None], curve.centre + spoke, curve.start + travel * where[:, None])

    return Curves(at(begin), at(end), curve.centre, curve.r, curve.sweep * (end - begin))


def crossings(a: Curves, b: Curves) -> tuple[Floats, Floats]:
    """The common points (n, 2) of curves a and b, at most two of each pair; nan where there is none."""
    found = meetings(_whole(a), _whole(b))
    for p in found:
        p[~(on(p, a) & on(p, b))] = np.nan
    return found


def _whole(curve: Curves) -> Element:
    """The whole line or circle."""
    travel = curve.end - curve.start
    with np.errstate(divide="ignore", invalid="ignore"):
        return Element(curve.start, travel / length_of(travel)[:, None], curve.centre, curve.r)


def on(p: Floats, curve: Curves, slack: float = SLACK) -> NDArray[np.bool_]:
    """Whether points p (n, 2) of the whole lines and circles lie on the curves themselves."""
    where = share(p, curve)
    return np.asarray((where >= -slack) & (where <= 1 + slack) & np.isfinite(p[:, 0]))
