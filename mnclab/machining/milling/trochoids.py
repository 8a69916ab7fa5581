"""Trochoidal clearing: circular cuts one after the other along a middle line, never a full slot. Lengths in mm.

    ┌──────────────────────      every disc of tool centres about a point of the middle line touches the walls of the
    │ (((((((((((((  ─►          tool-centre area; the tool cuts only the arc of its rim that lies outside the disc
    └──────────────────────      before it, and goes straight back through what is cleared

The next disc is the farthest on that line on which the tool is engaged no wider than one stepover k. Its rim may then lie so
far outside the disc before it, both about one centre and r being its radius:

    |m' - m| + r' - r = k·r / (r + R)        width of cut across the way: a·(1 + R/r) - a²/(2·r) for a step of a

So what lies within the rim is always cleared, if k ≤ R. Where a branch leaves a larger disc its first arcs cut up to twice
as much; on the first turn out of the plunged hole the tool works with nearly its whole rim, whatever the step. The spiral of
the first disc grows by k·r / (r + R) a turn. In the end the walls are followed, which takes away the cusps between the arcs.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import Skeleton, skeleton
from mnclab.machining.milling.clearing import Clearing, Piece, links, numbered, piecewise, round_walls
from mnclab.machining.milling.spirals import through

SMALLEST = 0.05  # of the tool radius: discs of tool centres below that are left to the passes along the walls
FINEST = 1 / 32  # of the stepover: the places on the middle line that are tried; in the smallest disc 1/21 is gone on


def trochoidal(
    region: Region, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True
) -> Clearing:
    """An area cleared by arcs along its middle line, from its widest place on; `stepover` is the width of cut on them."""
    return piecewise(
        region, radius, stepover, allowance, lambda part: _piece(part, radius, min(stepover, radius), climb)
    )


def _piece(centres: Region, radius: float, stepover: float, climb: bool) -> Piece:
    passes: list[Contour] = []
    labels: list[str] = []
    found = skeleton(centres, min(stepover, radius) / 2)
    for number, (branch, fresh) in enumerate(_branches(found, SMALLEST * radius), 1):
        arcs = _discs(found.points[branch], centres, radius, stepover, climb, fresh)
        passes += arcs
        labels += [f"branch {number}, {name}" for name in numbered("arc", len(arcs))]
    place = passes[0].points[0] if passes else None
    round_walls(centres, passes, labels, climb)
    return Piece(centres, tuple(passes), links(centres, passes, stepover), tuple(labels), place)


def _discs(points: Floats, centres: Region, radius: float, stepover: float, climb: bool, first: bool) -> list[Contour]:
    """The arcs along a branch `(n, 2)` of the middle line; the first branch opens on a spiral."""
    arcs = []
    centre, reach = points[0], float(centres.distance(points[:1])[0])
    if first:
        away = _widening(reach, radius, stepover)
        arcs.append(through(centre, away, clockwise=not climb))
        arcs.append(Contour.circle(centre, reach, np.pi * (len(away) - 1), clockwise=not climb))
    middles = _finer(points, stepover * FINEST) if len(points) > 1 else points
    rooms = centres.distance(middles)
    while len(middles) > 1:
        beyond = np.hypot(*(middles - centre).T) + rooms - reach
        over = np.flatnonzero(beyond > stepover * rooms / (rooms + radius))
        last = max(int(over[0]) - 1, 1) if len(over) else len(middles) - 1
        new, size = middles[last], float(rooms[last])
        arc = _outside(new, size, centre, reach, climb) if size >= SMALLEST * radius else None
        if arc is not None:
            arcs.append(arc)
        centre, reach = new, size
        middles, rooms = middles[last:], rooms[last:]
    return arcs


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
