"""Trochoidal slots: full circles one after the other along a centre line, never a full cut. Lengths in mm.

      ______________
     /  (  (  (  (  \\      each circle of the tool centre, of the radius w/2 - R, touches both walls; the next one lies a
    |  O  (  (  (  ( |     step ahead, and the way to it follows the wall on which the circle runs forward
     \\__(__(__(__(__/

All that the tool reaches lies in the discs of w/2 about the points of the line, so that no bend of it, however tight, leads
out of the slot, and none of these discs lies farther than a step from what is cleared: neither does the rim of the tool.
With w ≤ 4·R no core stands within a circle. What roughing leaves are the cusps along the other wall. Lines and arcs of the
centre line stay lines and arcs, as a control runs them; a trochoid in the strict sense would be none.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, cross, left, length_of, turned
from mnclab.geometry.sweeps import strip
from mnclab.machining.depths import TooMany
from mnclab.machining.milling.clearing import Clearing, joined
from mnclab.machining.milling.finishing import half_circles
from mnclab.machining.milling.spirals import half_circles as opening

SAME = 1e-9  # mm and rad
NOTHING = 1e-6  # mm; a slot this much wider than the tool is as wide as the tool
MOST = 20_000  # circles of one slot


class Wall(NamedTuple):
    """A pass along a wall of a slot and where it begins and ends, on the centre line: on half circles to it and off it."""

    place: Floats
    contour: Contour
    arcs: tuple[Contour, ...]


def trochoid(line: Contour, width: float, radius: float, step: float, *, climb: bool = True) -> Clearing:
    """The circles that rough a slot of a `width` about a centre line, opened on a spiral from its begin.

    `step` is the advance of a circle, and the greatest engagement of the tool. A slot as wide as the tool is one pass along
    the line. Raises ValueError where the slot is narrower than the tool, or wider than twice the tool.
    """
    reach = checked(width, radius)
    if reach <= NOTHING:
        return joined([line], ("centre line",), radius, place=line.points[0])
    if width > 4 * radius + NOTHING:
        raise ValueError(f"a slot {width:g} wide is wider than twice a tool of radius {radius:g}")
    if not step > 0:
        raise ValueError(f"the step of a trochoid must be greater than 0, got {step:g}")
    circles = _circles(line, width / 2, reach, step, 1.0 if climb else -1.0)
    begin, halves = circles.points[0] - line.points[0], max(1, int(np.ceil(2 * reach / step - SAME)))
    angle = float(np.arctan2(begin[1], begin[0])) - np.pi * halves
    spiral = opening(line.points[0], 0.0, reach, halves, angle, clockwise=not climb)
    return joined([spiral, circles], ("opening", "trochoid"), radius, place=line.points[0])


def checked(width: float, radius: float) -> float:
    """How far the tool centre goes from the centre line; a ValueError where the tool does not fit."""
    if not radius > 0:
        raise ValueError(f"the tool radius must be greater than 0, got {radius:g}")
    if width / 2 < radius - NOTHING:
        raise ValueError(f"a tool of radius {radius:g} does not fit into a slot {width:g} wide")
    return max(0.0, width / 2 - radius)


def walls(
    line: Contour, width: float, radius: float, *, climb: bool = True, begins_outside: bool = False
) -> tuple[Wall, ...]:
    """The passes along the walls of a slot, with round ends; the first one begins beside the begin of the line.

    A slot that `begins_outside` has no round end there. None where the slot is as wide as the tool.
    """
    reach = checked(width, radius)
    if reach <= NOTHING:
        return ()
    side = 1 if climb else -1
    start = line.points[0] - side * reach * left(line.tangents()[0])[0]
    found = []
    for loop in strip(line, reach).loops:
        way = loop if climb else loop.reversed()
        off = float(way.distance([start])[0])
        begin = way.started_at(_smooth(way, way.nearest(start)))
        found.append((off, _wall(begin, line, reach, side, begins_outside and off <= NOTHING)))
    return tuple(wall for _, wall in sorted(found, key=lambda each: each[0]))


def _wall(way: Contour, line: Contour, reach: float, side: int, begins_outside: bool) -> Wall:
    """A way along a wall; without the half circle about the begin of the line where that lies outside."""
    if begins_outside and not line.closed:
        whole = way.length - np.pi * reach
        end = way.point_at(whole)[0]
        if length_of(end + way.points[0] - 2 * line.points[0]) <= NOTHING:
            return Wall(line.points[0], way.between(0.0, whole), ())
    place = way.points[0] + side * reach * left(way.tangents()[0])[0]
    return Wall(place, way, half_circles(way, reach, side))


def _smooth(loop: Contour, way: float) -> float:
    """A way along a loop, or the middle of its longest element where it would lie at a corner."""
    upto = np.append(0.0, np.cumsum(loop.lengths))
    corners = np.append(np.abs(loop.turns()) > SAME, False)
    corners[-1] = corners[0]
    if not corners[np.abs(upto - way) <= NOTHING].any():
        return way
    longest = int(loop.lengths.argmax())
    return float(upto[longest] + loop.lengths[longest] / 2)


def circle_count(line: Contour, width: float, step: float) -> int:
    """How many circles rough a slot."""
    return int(_ways(line, width / 2, step)[1].sum())


def _ways(line: Contour, half: float, step: float) -> tuple[Floats, NDArray[np.bool_]]:
    """Ways along a line at which its elements begin and end and at which circles lie, and which are circles.

    The outer wall advances by no more than a step: of a bend of the radius r its way counts, 1 + w/2r times as long, and at a
    corner that round it. A closed line has no circle at its end, where the first one is.
    """
    upto, goes_on = np.append(0.0, np.cumsum(line.lengths)), np.append(line.turns(), 0.0)
    outer = line.lengths * (1 + half / line.radii)
    if line.length + outer.sum() > MOST * step:
        raise TooMany(f"a step of {step:.10g} divides the slot into more than {MOST} circles")
    before = np.cumsum(half * np.abs(goes_on)) + np.append(0.0, np.cumsum(outer))  # behind each corner
    counted = np.stack([before - half * np.abs(goes_on), before], axis=1).ravel()
    stops = np.interp(np.arange(0.0, counted[-1] - SAME, step), counted, np.repeat(upto, 2))
    stops = np.append(stops, [] if line.closed else upto[-1:])
    near = upto[np.minimum(np.searchsorted(upto, stops - NOTHING), len(upto) - 1)]
    stops = np.where(np.abs(near - stops) <= NOTHING, near, stops)
    ways = np.union1d(upto, stops)
    return ways, np.isin(ways, stops)


def _circles(line: Contour, half: float, reach: float, step: float, sense: float) -> Contour:
    """Circles joined along the equidistant on which they run forward: on the right of the line where they turn left."""
    ways, stops = _ways(line, half, step)
    upto = np.append(0.0, np.cumsum(line.lengths))
    element = np.searchsorted(upto, ways[:-1], side="right") - 1
    sweep = line.sweeps[element] * np.diff(ways) / line.lengths[element]
    places, ahead = line.point_at(ways[:-1])
    after = np.vstack([places[1:], line.points[:1] if line.closed else line.points[-1:]])
    away, back = ahead, turned(ahead, sweep)
    leave = places - sense * reach * left(away)  # (n, 2), of the n ways from place to place
    come = after - sense * reach * left(back)
    return _assembled(np.vstack([places, after[-1:]]), stops, leave, come, away, back, sweep, sense)


def _assembled(
    places: Floats, stops: NDArray[np.bool_], leave: Floats, come: Floats, away: Floats, back: Floats, sweep: Floats,
    sense: float,
) -> Contour:  # fmt: skip
    """Of each of n + 1 places: the circle, the way round a corner, the way on to the next one."""
    arrive, depart = np.vstack([leave[:1], come]), np.vstack([leave, come[-1:]])
    heading, onward = np.vstack([away[:1], back]), np.vstack([away, back[-1:]])
    turn = np.arctan2(cross(heading, onward), (heading * onward).sum(axis=1))
    outside = np.where(turn * sense > 0, np.tan(turn / 4), 0.0)  # inside it goes straight, through what is cleared
    gap = length_of(depart - arrive) > NOTHING
    circle = np.full(len(places), sense)
    points = np.stack([arrive, 2 * places - arrive, arrive, depart], axis=1)
    bulge = np.stack([circle, circle, outside, np.append(np.tan(sweep / 4), 0.0)], axis=1)
    kept = np.stack([stops, stops, gap, np.ones_like(stops)], axis=1)
    return Contour(points[kept], bulge[kept], closed=False)
