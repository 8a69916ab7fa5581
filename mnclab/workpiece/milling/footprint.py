"""Points under a body that goes along a move: where a collision is looked for.

They lie on lines along the move, the outer ones on the rim of the body, on the rim where it begins and on rings where it
ends; so that nothing wider than the distance between them is missed, and nothing at all that the rim or the axis goes over.
"""

from __future__ import annotations

import numpy as np

from mnclab.path.toolpath import Array
from mnclab.workpiece.milling.moves import STILL, Moves

RIM = 1e-6  # mm, by which the outermost points lie inside the body
LANES = 4  # at least, across a body
RINGS = 12  # at most, of an end
STATIONS = 4000  # at most, along a move


def under(move: Moves, radius: float, bounds: Array, step: float, most: int) -> tuple[Array, Array]:
    """x and y (m,) of points under a body of `radius` along one move, from its start to its end.

    They are `step` mm apart, or so far that there are about `most`; a line is looked at where it is over `bounds` (2, 3).
    """
    radius = max(radius - RIM, 0.0)
    first, last = _over(move, radius, bounds)
    way = float(_length(move)) * (last - first)
    apart = max(step, ((way * 2 * radius + 3 * radius * radius) / most) ** 0.5)
    there = _disc(tips(move, np.array([last])), radius, int(np.clip(np.ceil(radius / apart), 2, RINGS)))
    if way <= STILL:
        return there[:, 0], there[:, 1]
    here = _disc(tips(move, np.array([first])), radius, 1)
    share = np.linspace(first, last, min(int(way / apart) + 2, STATIONS))
    lanes = np.linspace(-radius, radius, max(2 * int(np.ceil(radius / apart)), LANES) + 1)
    lanes = lanes[np.argsort(np.abs(lanes), kind="stable")]  # of places that are as deep the axis is named
    between = tips(move, share)[:, None, :2] + lanes[:, None] * _aside(move, share)[:, None]
    found = np.concatenate([here, between.reshape(-1, 2), there])
    return found[:, 0], found[:, 1]


def tips(move: Moves, share: Array) -> Array:
    """Where the tip of one move is (n, 3), 0 at its start and 1 at its end."""
    start, end = move.start[0], move.end[0]
    places = start + np.multiply.outer(share, end - start)
    if move.arc[0]:
        centre, spoke = move.centre[0], start[:2] - move.centre[0]
        cos, sin = np.cos(move.sweep[0] * share), np.sin(move.sweep[0] * share)
        places[:, 0] = centre[0] + spoke[0] * cos - spoke[1] * sin
        places[:, 1] = centre[1] + spoke[0] * sin + spoke[1] * cos
    return np.asarray(places)


def _length(move: Moves) -> float:
    """Of the way in the plane, mm."""
    if move.arc[0]:
        return float(np.hypot(*(move.start[0, :2] - move.centre[0])) * abs(move.sweep[0]))
    return float(np.hypot(*(move.end[0] - move.start[0])[:2]))


def _aside(move: Moves, share: Array) -> Array:
    """The unit vector across the way (n, 2)."""
    if move.arc[0]:
        out = tips(move, share)[:, :2] - move.centre[0]
        return np.asarray(out / np.maximum(np.hypot(*out.T), STILL)[:, None])
    dx, dy = (move.end[0] - move.start[0])[:2]
    return np.broadcast_to(np.array([-dy, dx]) / np.hypot(dx, dy), (len(share), 2))


def _over(move: Moves, radius: float, bounds: Array) -> tuple[float, float]:
    """The share of a line on which the body may be over a box; all of an arc."""
    first, last = 0.0, 1.0
    if move.arc[0]:
        return first, last
    for axis in (0, 1):
        start, way = float(move.start[0, axis]), float(move.end[0, axis] - move.start[0, axis])
        if abs(way) > STILL:
            one, other = sorted((bounds[:, axis] + np.array([-radius, radius]) - start) / way)
            first, last = max(first, float(one)), min(last, float(other))
    return (first, last) if first < last else (min(max(first, 0.0), 1.0),) * 2


def _disc(place: Array, radius: float, rings: int) -> Array:
    """The axis, and rings up to the rim (n, 2)."""
    points = [place[:, :2]]
    for k in range(1, rings + 1):
        angle = np.linspace(0, 2 * np.pi, max(16 if k == rings else 0, 6 * k), endpoint=False)
        points.append(place[:, :2] + radius * k / rings * np.stack([np.cos(angle), np.sin(angle)], axis=1))
    return np.concatenate(points)
