"""A part as one sees it from above: from its level slabs, the edges that nothing above covers. mm."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.geometry.vectors import Floats
from mnclab.workpiece.design.slabs import Stack

NEAR = 1e-6  # mm, within which a line lies on another
SPOTS = np.array([0.02, 0.25, 0.5, 0.75, 0.98])  # of an element, by which is told whether all of it does
EMPTY = Region(())


def edges(stack: Stack) -> list[Contour]:
    """Visible edges in (x, y), lines and arcs as they are: whole loops where all of one is seen."""
    return [line for z, loop in _seen(stack) for line in _not_within(stack, z, loop)]


def outline(stack: Stack) -> Region:
    """All that the part takes up, seen from above."""
    covered = EMPTY
    for _, section in _levels(stack):
        covered = _more(covered, section)
    return covered


def _levels(stack: Stack) -> Iterator[tuple[float, Region]]:
    """Sections from above down, each where it differs from that before."""
    for slab in reversed(stack.slabs):
        if slab.slants:
            yield slab.high, slab.section(slab.high)
            yield slab.low, slab.section(slab.low)
        else:
            yield slab.high, slab.region


def _more(covered: Region, section: Region) -> Region:
    if not covered.loops or not section.loops:
        return section if section.loops else covered
    return covered.union(section)


def _seen(stack: Stack) -> Iterator[tuple[float, Contour]]:
    covered = EMPTY
    for z, section in _levels(stack):
        if not section.loops:
            continue
        if not covered.loops:
            yield from ((z, loop) for loop in section.loops)
            covered = section
            continue
        for loop in section.difference(covered).loops:
            yield from ((z, line) for line in _off(loop, covered))
        covered = _more(covered, section)


def _not_within(stack: Stack, z: float, line: Contour) -> Iterator[Contour]:
    """The stretches of a line at a height that are edges: not those in the middle of a slanting face."""
    slants = {id(each): each for slab in stack.slabs for each in slab.slants if each.low + NEAR < z < each.high - NEAR}
    if not slants:
        yield line
        return
    x, y = _spots(line).T
    within = np.zeros(len(x), dtype=bool)
    for each in slants.values():
        within |= np.abs(each.away(x, y) - each.at(z)) < NEAR
    yield from _stretches(line, ~within.reshape(-1, len(SPOTS)).all(axis=1))


def _off(loop: Contour, covered: Region) -> Iterator[Contour]:
    """The stretches of a loop that are not on the edge of what is above: that is drawn already."""
    lies = covered.distance(_spots(loop)) < NEAR
    return _stretches(loop, ~lies.reshape(-1, len(SPOTS)).all(axis=1))


def _spots(line: Contour) -> Floats:
    """Places on every element, `(m * 5, 2)`."""
    ways = (np.cumsum(line.lengths) - line.lengths)[:, None] + line.lengths[:, None] * SPOTS
    return line.point_at(ways.ravel())[0]


def _stretches(line: Contour, shown: NDArray[np.bool_]) -> Iterator[Contour]:
    """The elements that are shown, those that follow each other as one."""
    count = len(shown)
    if shown.all():
        yield line
        return
    if not shown.any():
        return
    first = int(np.flatnonzero(shown & ~np.roll(shown, 1))[0]) if line.closed else 0
    run: list[int] = []
    for k in [*((first + k) % count for k in range(count)), None]:
        if k is not None and shown[k]:
            run.append(k)
        elif run:
            points = [*line.starts[run], line.ends[run[-1]]]
            yield Contour(points, [*line.bulge[run], 0.0], closed=False)
            run = []
