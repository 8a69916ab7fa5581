"""Clearing an area on parallel lines, to and fro or all one way, and then along its walls. Lengths in mm, angles in rad.

    C = where the tool centre may go      lines cover C inset by m = min(k, R - k/2), their ends lie on its boundary

A point of C farther than R from the boundary of C lies within k/2 of a line and, m being small enough, beside a point
*on* that line within C inset by m. All others are cleared by the passes along the walls. So nothing is left, for every
stepover k ≤ 2·R.
"""

from __future__ import annotations

import numpy as np

from mnclab.geometry.contours import Contour, placed
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import scan
from mnclab.machining.milling.clearing import (
    SLACK,
    Clearing,
    Piece,
    begin,
    end,
    links,
    numbered,
    piecewise,
    round_walls,
)

Segment = tuple[Floats, Floats]


def zigzag(
    region: Region, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True, angle: float = 0.0
) -> Clearing:
    """Lines in the direction `angle`, to and fro, joined along the wall; then walls and islands in one sense.

    >>> pocket = mnc.area.Region.of(mnc.area.rectangle(40, 20))
    >>> len(mnc.strategies.zigzag(pocket, 4, 3).pieces)  # it goes down once
    1
    """
    return piecewise(
        region, radius, stepover, allowance, lambda part: _piece(part, radius, stepover, climb, angle, False)
    )


def one_way(
    region: Region, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True, angle: float = 0.0
) -> Clearing:
    """Lines all in one direction, so that every one is cut in climb milling (or none), the tool lifting between them.

    A frame round them comes first, so that each line begins in the clear. In climb milling the lines run against
    `angle`, the material on their right; else along it.

    >>> pocket = mnc.area.Region.of(mnc.area.rectangle(40, 20))
    >>> len(mnc.strategies.one_way(pocket, 4, 3).pieces)  # it goes down once
    1
    """
    return piecewise(
        region, radius, stepover, allowance, lambda part: _piece(part, radius, stepover, climb, angle, True)
    )


def _piece(centres: Region, radius: float, stepover: float, climb: bool, angle: float, single: bool) -> Piece:
    inner = centres.inset(min(stepover, radius - stepover / 2))
    passes: list[Contour] = []
    labels: list[str] = []
    if inner.loops:
        segments = segments_at(inner, stepover, angle)
        if single:
            rows = [Contour([b, a] if climb else [a, b], closed=False) for a, b in segments]
            passes = [loop if climb else loop.reversed() for loop in inner.loops]
            labels = list(numbered("frame", len(passes)))
        else:
            rows = to_and_fro(segments)
        for line, name in zip(rows, numbered("line", len(rows)), strict=True):
            way = None if single or not passes else _along_wall(inner, end(passes[-1]), begin(line), stepover)
            if way is not None:
                passes.append(way)
                labels.append("link along the wall")
            passes.append(line)
            labels.append(name)
    round_walls(centres, passes, labels, climb)
    linked = list(links(centres, passes, stepover))
    if single:
        for k, name in enumerate(labels[1:]):
            linked[k] = linked[k] and not name.startswith("line")
    return Piece(centres, tuple(passes), tuple(linked), tuple(labels))


def segments_at(region: Region, stepover: float, angle: float) -> list[Segment]:
    """Lines across a region in a direction, at equal distances of at most `stepover`."""
    level = _turned(region, -angle)
    return [(placed(a, (0, 0), angle), placed(b, (0, 0), angle)) for a, b in _segments(level, stepover)]


def _turned(region: Region, angle: float) -> Region:
    c, s = np.cos(angle), np.sin(angle)
    return Region(tuple(loop.transformed([[c, -s, 0], [s, c, 0], [0, 0, 1]]) for loop in region.loops))


def _segments(region: Region, stepover: float) -> list[Segment]:
    """Lines at equal distances of at most `stepover`, half of one from the ends of the region, from below upwards."""
    bounds = np.array([loop.bounds for loop in region.loops])
    low, high = bounds[:, 0, 1].min(), bounds[:, 1, 1].max()
    count = max(1, int(np.ceil((high - low) / stepover - 1e-9)))
    heights = low + (high - low) * (np.arange(count) + 0.5) / count
    return [
        (np.array([a, y]), np.array([b, y]))
        for y, row in zip(heights, scan(region, heights), strict=True)
        for a, b in row
    ]


def to_and_fro(segments: list[Segment]) -> list[Contour]:
    """The lines in an order that goes on to the nearest end not yet cut, first those a step away."""
    ends = np.array(segments).reshape(-1, 2)  # two rows a segment
    todo = np.ones(len(segments), dtype=bool)
    here, rows = ends[0], []
    while todo.any():
        away = np.hypot(*(ends - here).T)
        away[~np.repeat(todo, 2)] = np.inf
        k = int(away.argmin())
        todo[k // 2] = False
        rows.append(Contour([ends[k], ends[k ^ 1]], closed=False))
        here = ends[k ^ 1]
    return rows


def _along_wall(region: Region, a: Floats, b: Floats, stepover: float) -> Contour | None:
    """The shorter way along the boundary from one end of a line to the next, if it is not much longer than straight."""
    straight = float(np.hypot(*(b - a)))
    for loop in region.loops:
        if loop.distance([a, b]).max() > SLACK:
            continue
        there, back = loop.nearest(a), loop.nearest(b)
        forward = (back - there) % loop.length
        ways = ((forward, loop, there), (loop.length - forward, loop.reversed(), loop.length - there))
        length, ring, first = min(ways, key=lambda way: way[0])
        if 1e-6 < length <= 2 * straight + stepover and straight <= 6 * stepover:
            return ring.between(first, first + length)
    return None
