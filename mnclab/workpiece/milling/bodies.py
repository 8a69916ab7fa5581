"""What of a mill may meet something: its edges, what is above them, the shank, the holder; and points under it along a move."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.path.tool import Tool
from mnclab.path.toolpath import Array
from mnclab.workpiece.milling.cutters import Cutter, cutter_of
from mnclab.workpiece.milling.moves import STILL, Moves

# A body is a little smaller than it is, by `TOLERANCE` all round, so that a tool that touches a finished wall or floor, a
# program that is written in micrometres and a chord of an arc are no collision.

TOLERANCE = 0.01  # mm
HOLES = ("drill", "mill", "face mill", "")  # what clears a hole as far up as its edges go


class Body(NamedTuple):
    """A part of a tool: its lower side (smaller than it is), `lift` mm above the tip.

    Within `inner` of the axis the edges have been before, when the tool goes straight down.
    """

    name: str
    cutter: Cutter
    lift: float
    inner: float = 0.0


def edges(tool: Tool) -> Body:
    """What cuts, and all that is as wide above it."""
    radius, flat, corner, slope = cutter_of(tool)
    smaller = max(radius - TOLERANCE, radius / 2)
    corner = max(corner - TOLERANCE, 0.0)
    flat = min(flat, smaller) if slope or corner else smaller
    return Body("tool", Cutter(smaller, flat, min(corner, smaller - flat) if not slope else 0.0, slope), TOLERANCE)


def above_edges(tool: Tool) -> list[Body]:
    """The tool above its edges, where their length is given, and the shank behind."""
    radius, found = tool.effective_radius, []
    thin, begin = tool.shank or (radius, 0.0)
    if tool.cutting_length > 0 and (tool.shank is None or begin > tool.cutting_length):
        inner = 0.0 if tool.kind in HOLES else radius
        found.append(_upright("tool above its edges", radius, tool.cutting_length, inner))
    if tool.shank is not None:
        found.append(_upright("shank", thin, begin, radius))
    return found


def holder(tool: Tool) -> list[Body]:
    """The discs that the holder begins with, from the tip up."""
    return [_upright("holder", radius, begin, tool.effective_radius) for radius, begin in tool.holder]


def bodies_of(tool: Tool) -> list[Body]:
    """All of them, from the tip up."""
    return [edges(tool), *above_edges(tool), *holder(tool)]


def _upright(name: str, radius: float, lift: float, inner: float) -> Body:
    smaller = max(radius - TOLERANCE, radius / 2)
    return Body(name, Cutter(smaller, smaller), lift + TOLERANCE, inner)


# Points under a body that goes along a move: where a collision is looked for.
# They lie on lines along the move, the outer ones on the rim of the body, on the rim where it begins and on rings where it
# ends; so that nothing wider than the distance between them is missed, and nothing at all that the rim or the axis goes over.

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
