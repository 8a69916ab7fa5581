"""Stretches of a contour train where a coarser tool has left material: an inside corner for one. Lengths in mm.

The tool of a way touches the finished wall in the foot of each place. The rest there is as thick as the foot is far from what the
coarse tool has covered on its own way. In an inside corner of a right angle a coarse tool of radius C leaves, s from the corner,

    thickness = √((C - s)² + C²) - C            more than t where s < C - √(2·C·t + t²)
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.machining.trains import Way, away, part
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, left

Bools: TypeAlias = NDArray[np.bool_]

SAME = 1e-9  # mm
STEP = 0.05  # of the tool radius: between the places that are looked at
MOST = 40_000  # places
HALVINGS = 40


def rests(
    along: Way, radius: float, side: int, coarse: Sequence[Contour], coarse_radius: float, accepted: float,
    connected: float = 0.0, extended: float = 0.0,
) -> tuple[Way, ...]:  # fmt: skip
    """The stretches of a way, with the tool of a `radius` to its `side`, where more than `accepted` stands after a coarse tool.

    `coarse` are the ways of that tool along the same contour. Stretches at most `connected` apart are joined, each is
    `extended` at both ends: along the way, and beyond its end straight on.
    """
    length = along.contour.length
    places = _places(along.contour, radius)
    thick = np.full(len(places), True)
    if coarse:
        thick = away(coarse, _feet(along.contour, places, radius, side)) - coarse_radius > accepted
    if thick.all():
        return (part(along, -extended, length + extended),) if not along.closes else (along,)

    def still(way: Floats) -> Bools:
        feet = _feet(along.contour, way, radius, side)
        return np.asarray(np.min([one.distance(feet) for one in coarse], axis=0) - coarse_radius > accepted)

    edges = np.flatnonzero(thick[1:] != thick[:-1])
    found = _edges(still, places[edges], places[edges + 1], thick[edges])
    ends = np.concatenate([[0.0] * bool(thick[0]), found, [length] * bool(thick[-1])]).reshape(-1, 2)
    return tuple(part(along, a, b) for a, b in _joined(ends, length, along.closes, connected, extended))


def _places(contour: Contour, radius: float) -> Floats:
    """Ways along a contour to places on it, in order, the ends of all elements from both sides among them."""
    lengths = contour.lengths
    upto = np.append(0.0, np.cumsum(lengths))
    step = max(STEP * radius, contour.length / MOST)
    found = [
        a + size * np.clip(np.linspace(0, 1, int(np.ceil(size / step)) + 2), 1e-7, 1 - 1e-7)
        for a, size in zip(upto, lengths, strict=False)
        if size > SAME
    ]
    return np.concatenate(found)


def _feet(contour: Contour, places: Floats, radius: float, side: int) -> Floats:
    """Where the tool touches the finished wall at places (k,) along its way, `(k, 2)`."""
    spots, tangents = contour.point_at(places)
    return np.asarray(spots - side * radius * left(tangents))


def _edges(still: Callable[[Floats], Bools], low: Floats, high: Floats, begins: Bools) -> Floats:
    """Where stretches end and begin between places, by halving; `begins` (k,): there is a rest at the lower one."""
    low, high = low.copy(), high.copy()
    for _ in range(HALVINGS if len(low) else 0):
        middle = (low + high) / 2
        same = still(middle) == begins
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return (low + high) / 2


def _joined(ends: Floats, length: float, closes: bool, connected: float, extended: float) -> list[tuple[float, float]]:
    """Stretches (n, 2) joined where they are near each other, and extended; of a way that closes one may begin below 0."""
    found = [(float(a), float(b)) for a, b in ends]
    if closes and len(found) > 1 and found[0][0] + length - found[-1][1] <= connected:
        found[0] = (found.pop()[0] - length, found[0][1])
    joined: list[tuple[float, float]] = []
    for a, b in found:
        if joined and a - joined[-1][1] <= max(connected, 2 * extended):
            joined[-1] = (joined[-1][0], b)
        else:
            joined.append((a, b))
    if closes and len(joined) == 1 and joined[0][0] + length - joined[0][1] <= max(connected, 2 * extended):
        return [(0.0, length)]
    return [(a - extended, b + extended) for a, b in joined]
