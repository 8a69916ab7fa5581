"""Lines and arcs as plain curves, and how far points and other curves are from them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.offsets import Element, meetings
from mnclab.geometry.vectors import cross, dot

Array = NDArray[np.float64]

SLACK = 1e-9  # of a curve: beyond its ends a point is still on it


class Curves(NamedTuple):
    """n lines and arcs: `start`, `end`, `centre` (n, 2) mm, radius `r` (n,), nan for lines, `sweep` (n,) rad."""

    start: Array
    end: Array
    centre: Array
    r: Array
    sweep: Array

    @property
    def arc(self) -> NDArray[np.bool_]:
        """Which of them are arcs (n,)."""
        return ~np.isnan(self.r)

    def take(self, k: NDArray[np.int64] | NDArray[np.bool_]) -> Curves:
        """Some of them."""
        return Curves(*(column[k] for column in self))


def share(p: Array, curve: Curves) -> Array:
    """Where the point of a curve nearest to p (n, 2) lies, 0 at its start and 1 at its end; beyond is not on it.

    A curve without length has no such point: nan or infinite, by which p is on none of it; its ends count alone.

    For an arc the foot is where the ray from its centre through p meets its circle.
    """
    travel = curve.end - curve.start
    with np.errstate(divide="ignore", invalid="ignore"):
        found = dot(p - curve.start, travel) / dot(travel, travel)
    k = np.flatnonzero(curve.arc)
    if len(k):
        a, b = curve.start[k] - curve.centre[k], p[k] - curve.centre[k]
        sense, sweep = np.sign(curve.sweep[k]), np.abs(curve.sweep[k])
        angle = np.arctan2(cross(a, b), dot(a, b)) * sense
        # seen from the middle of the arc, so that what lies before the start is negative
        half = sweep / 2
        angle = (angle - half + np.pi) % (2 * np.pi) - np.pi + half
        angle = np.where(sweep >= 2 * np.pi, np.minimum(np.maximum(angle, 0), sweep), angle)
        with np.errstate(divide="ignore", invalid="ignore"):
            found[k] = angle / sweep
    return np.asarray(found)


def foot(p: Array, curve: Curves) -> Array:
    """The point (n, 2) of the whole line or circle nearest to p (n, 2); for the centre of an arc nan."""
    travel = curve.end - curve.start
    with np.errstate(divide="ignore", invalid="ignore"):
        found = curve.start + (dot(p - curve.start, travel) / dot(travel, travel))[:, None] * travel
        k = np.flatnonzero(curve.arc)
        if len(k):
            spoke = p[k] - curve.centre[k]
            found[k] = curve.centre[k] + spoke * (curve.r[k] / np.hypot(spoke[:, 0], spoke[:, 1]))[:, None]
    return found


def distance(p: Array, curve: Curves) -> Array:
    """Distance (n,) of points p (n, 2) from curves, each from its own."""
    at_ends = np.minimum(np.hypot(*(p - curve.start).T), np.hypot(*(p - curve.end).T))
    where = share(p, curve)
    beside = np.hypot(*(p - foot(p, curve)).T)
    on = (where >= 0) & (where <= 1) & np.isfinite(beside)
    return np.asarray(np.where(on, np.minimum(beside, at_ends), at_ends))


def gap(a: Curves, b: Curves) -> Array:
    """The least distance (n,) between curves a and b, each from its own; 0 where they cross."""
    least = np.minimum(distance(a.start, b), distance(a.end, b))
    least = np.minimum(least, np.minimum(distance(b.start, a), distance(b.end, a)))
    for p in crossings(a, b):
        least[np.isfinite(p[:, 0])] = 0.0
    for one, other in ((a, b), (b, a)):
        k = np.flatnonzero(one.arc)
        if len(k):  # square to both: through the centre of the arc
            arc, curve = one.take(k), other.take(k)
            for q in _square(arc.centre, curve):
                p = _toward(arc, q)
                there = _on(q, curve) & _on(p, arc)
                least[k] = np.where(there, np.minimum(least[k], np.hypot(*(q - p).T)), least[k])
    return least


def part(curve: Curves, begin: Array, end: Array) -> Curves:
    """What lies between two shares (n,) of curves, 0 at their start and 1 at their end."""
    travel, turn = curve.end - curve.start, np.where(curve.arc, curve.sweep, 0.0)

    def at(where: Array) -> Array:
        angle = turn * where
        spoke, cos, sin = curve.start - curve.centre, np.cos(angle), np.sin(angle)
        turned = np.stack([spoke[:, 0] * cos - spoke[:, 1] * sin, spoke[:, 0] * sin + spoke[:, 1] * cos], axis=1)
        return np.where(curve.arc[:, None], curve.centre + turned, curve.start + travel * where[:, None])

    return Curves(at(begin), at(end), curve.centre, curve.r, curve.sweep * (end - begin))


def crossings(a: Curves, b: Curves) -> tuple[Array, Array]:
    """The common points (n, 2) of curves a and b, at most two of each pair; nan where there is none."""
    found = meetings(_whole(a), _whole(b))
    for p in found:
        p[~(_on(p, a) & _on(p, b))] = np.nan
    return found


def _whole(curve: Curves) -> Element:
    """The whole line or circle."""
    travel = curve.end - curve.start
    with np.errstate(divide="ignore", invalid="ignore"):
        return Element(curve.start, travel / np.hypot(travel[:, 0], travel[:, 1])[:, None], curve.centre, curve.r)


def _on(p: Array, curve: Curves) -> NDArray[np.bool_]:
    where = share(p, curve)
    return np.asarray((where >= -SLACK) & (where <= 1 + SLACK) & np.isfinite(p[:, 0]))


def _square(centre: Array, curve: Curves) -> tuple[Array, Array]:
    """Where lines through `centre` (n, 2) meet the whole curves at a right angle: near points and far ones (n, 2)."""
    near = foot(centre, curve)
    return near, np.where(curve.arc[:, None], 2 * curve.centre - near, near)


def _toward(arc: Curves, q: Array) -> Array:
    """The points (n, 2) of the whole circles on the side of q (n, 2)."""
    spoke = q - arc.centre
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(arc.centre + spoke * (arc.r / np.hypot(spoke[:, 0], spoke[:, 1]))[:, None])
