"""Trochoidal clearing: circular cuts one after the other along a middle line, never a full slot. Lengths in mm.

    ┌──────────────────────      every disc of tool centres about a point of the middle line touches the walls of the
    │ (((((((((((((  ─►          tool-centre area; the tool cuts only the arc of its rim that lies outside the disc
    └──────────────────────      before it, and goes straight back through what is cleared

The next disc is the farthest on that line on which the tool is engaged no wider than one stepover k. Its rim may then lie so
far outside the disc before it, both about one centre and r being its radius:

    |m' - m| + r' - r = k·r / (r + R)        width of cut across the way: a·(1 + R/r) - a²/(2·r) for a step of a

So what lies within the rim is always cleared, if k ≤ R. Where a branch leaves a larger disc its first arcs cut up to twice
as much; on the first turn out of the plunged hole the tool works with nearly its whole rim, whatever the step. The spiral of
the first disc grows by k·r / (r + R) a turn. Where a line comes back to what others have cleared, as behind an island, the
ends of an arc that lie within their discs would cut air and are left out. In the end the walls are followed, which takes away
the cusps between the arcs.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, cross, left, length_of, turned
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import Skeleton, skeleton, strip
from mnclab.machining.depths import TooMany
from mnclab.machining.milling.clearing import Clearing, Piece, joined, links, numbered, piecewise, round_walls
from mnclab.machining.milling.pocket_steps import half_circles
from mnclab.machining.milling.spirals import half_circles as opening
from mnclab.machining.milling.spirals import through

SAMPLES = 33  # of an arc that may lie in what is cleared
SMALLEST = 0.05  # of the tool radius: discs of tool centres below that are left to the passes along the walls
FINEST = 1 / 32  # of the stepover: the places on the middle line that are tried; in the smallest disc 1/21 is gone on


def trochoidal(
    region: Region, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True
) -> Clearing:
    """An area cleared by arcs along its middle line, from its widest place on; `stepover` is the width of cut on them.

    >>> pocket = mnc.area.Region.of(mnc.area.rectangle(40, 20))
    >>> len(mnc.strategies.trochoidal(pocket, 4, 3).pieces)  # it goes down once
    1
    """
    return piecewise(
        region, radius, stepover, allowance, lambda part: _piece(part, radius, min(stepover, radius), climb)
    )


def _piece(centres: Region, radius: float, stepover: float, climb: bool) -> Piece:
    passes: list[Contour] = []
    labels: list[str] = []
    found, cleared = skeleton(centres, min(stepover, radius) / 2), np.empty((0, 3))
    for number, (branch, fresh) in enumerate(_branches(found, SMALLEST * radius), 1):
        arcs, cleared = _discs(found.points[branch], centres, radius, stepover, climb, fresh, cleared)
        passes += arcs
        labels += [f"branch {number}, {name}" for name in numbered("arc", len(arcs))]
    place = passes[0].points[0] if passes else None
    round_walls(centres, passes, labels, climb)
    return Piece(centres, tuple(passes), links(centres, passes, stepover), tuple(labels), place)


def _discs(
    points: Floats, centres: Region, radius: float, stepover: float, climb: bool, first: bool, cleared: Floats
) -> tuple[list[Contour], Floats]:
    """The arcs along a branch `(n, 2)` of the middle line, and the discs of tool centres `(m, 3)` that are `cleared` behind it;
    the first branch opens on a spiral."""
    arcs = []
    centre, reach = points[0], float(centres.distance(points[:1])[0])
    if first:
        away = _widening(reach, radius, stepover)
        arcs.append(through(centre, away, clockwise=not climb))
        arcs.append(Contour.circle(centre, reach, np.pi * (len(away) - 1), clockwise=not climb))
        cleared = np.vstack([cleared, (*centre, reach)])
    middles = _finer(points, stepover * FINEST) if len(points) > 1 else points
    rooms = centres.distance(middles)
    while len(middles) > 1:
        beyond = np.hypot(*(middles - centre).T) + rooms - reach
        over = np.flatnonzero(beyond > stepover * rooms / (rooms + radius))
        last = max(int(over[0]) - 1, 1) if len(over) else len(middles) - 1
        new, size = middles[last], float(rooms[last])
        arc = _outside(new, size, centre, reach, climb) if size >= SMALLEST * radius else None
        arcs += [] if arc is None else _beyond(arc, cleared)
        cleared = np.vstack([cleared, (*new, size)])
        centre, reach = new, size
        middles, rooms = middles[last:], rooms[last:]
    return arcs, cleared


def _beyond(arc: Contour, discs: Floats) -> list[Contour]:
    """An arc without the ends that lie within discs `(m, 3)`, each place in one of them; nothing where all of it does."""
    ways = np.linspace(0, arc.length, SAMPLES)
    off = np.hypot(*(arc.point_at(ways)[0][:, None] - discs[:, :2]).transpose(2, 0, 1)) - discs[:, 2]
    out = np.flatnonzero(off.min(axis=1, initial=np.inf) > SAME)
    return [arc.between(ways[max(out[0] - 1, 0)], ways[min(out[-1] + 1, SAMPLES - 1)])] if len(out) else []


def _widening(reach: float, radius: float, stepover: float) -> list[float]:
    """Distances from the middle of a spiral, half a turn apart, up to `reach`; the first step is half a stepover."""
    away = [0.0, min(stepover / 2, reach)]
    while away[-1] < reach:
        away.append(min(reach, away[-1] * (1 + stepover / 2 / (away[-1] + radius))))
    return away


def _finer(points: Floats, spacing: float) -> Floats:
    """A line of points with points at most `spacing` apart."""
    line = Contour(points, closed=False)
    return line.point_at(np.linspace(0, line.length, max(2, int(np.ceil(line.length / spacing)) + 1)))[0]


def _outside(middle: Floats, size: float, before: Floats, reach: float, climb: bool) -> Contour | None:
    """The arc of a circle outside another one, counter-clockwise in climb milling; None if there is none."""
    apart = float(np.hypot(*(middle - before)))
    if apart + size <= reach + 1e-9 or apart < 1e-12:
        return None
    ahead = float(np.arctan2(*(middle - before)[::-1]))
    cosine = (reach**2 - apart**2 - size**2) / (2 * apart * size)
    half = min(float(np.arccos(np.clip(cosine, -1.0, 1.0))), np.pi - 1e-6)
    ways = ahead + np.array([-half, 0.0, half]) * (1 if climb else -1)
    spots = middle + size * np.stack([np.cos(ways), np.sin(ways)], axis=1)
    bulge = np.tan(half / 4) * (1 if climb else -1)
    return Contour(spots, [bulge, bulge, 0.0], closed=False)


def _branches(found: Skeleton, least: float) -> Iterator[tuple[np.ndarray, bool]]:
    """The middle line as chains of points, from its widest one on, and whether a chain begins where none has been.

    Any other begins on one that came before. A line that a narrow place has parted is taken piece by piece.
    """
    neighbours: dict[int, list[int]] = {}
    for a, b in found.edges.tolist():
        neighbours.setdefault(a, []).append(b)
        neighbours.setdefault(b, []).append(a)
    seen = np.array([bool(neighbours) and k not in neighbours for k in range(len(found.points))])
    done: set[tuple[int, int]] = set()
    while not seen.all():
        widest = int(np.where(seen, -np.inf, found.room).argmax())
        if found.room[widest] <= least:
            return
        if not neighbours:  # of a round area only its centre is left
            yield np.array([widest]), True
            return
        waiting, fresh = [widest], True
        while waiting:
            start = waiting[-1]
            free = [k for k in neighbours[start] if (start, k) not in done]
            if not free:
                waiting.pop()
                continue
            chain = [start]
            while free:
                step = max(free, key=lambda k: found.room[k])
                done |= {(chain[-1], step), (step, chain[-1])}
                chain.append(step)
                free = [k for k in neighbours[step] if (step, k) not in done]
                if len(free) > 1:
                    waiting.append(step)
            seen[chain] = True
            yield np.array(chain), fresh
            fresh = False


# Trochoidal slots: full circles one after the other along a centre line, never a full cut. Lengths in mm.
#       ______________
#      /  (  (  (  (  \      each circle of the tool centre, of the radius w/2 - R, touches both walls; the next one lies a
#     |  O  (  (  (  ( |     step ahead, and the way to it follows the wall on which the circle runs forward
#      \__(__(__(__(__/
# All that the tool reaches lies in the discs of w/2 about the points of the line, so that no bend of it, however tight, leads
# out of the slot, and none of these discs lies farther than a step from what is cleared: neither does the rim of the tool.
# With w ≤ 4·R no core stands within a circle. What roughing leaves are the cusps along the other wall. Lines and arcs of the
# centre line stay lines and arcs, as a control runs them; a trochoid in the strict sense would be none.

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
    upto = loop.upto
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
    upto, goes_on = line.upto, np.append(line.turns(), 0.0)
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
    upto = line.upto
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
