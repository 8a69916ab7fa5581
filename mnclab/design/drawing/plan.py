"""A part as one sees it from above: from its level slabs, the edges that nothing above covers. mm."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from mnclab.design.drawing.elevation import Levels
from mnclab.design.model.removals import Bevel, Sloped
from mnclab.design.model.shapes import stretches
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region, Where, joined, where

NEAR = 1e-6  # mm, within which a line lies on another
SPOTS = np.array([0.02, 0.25, 0.5, 0.75, 0.98])  # of an element, by which is told whether all of it does
SHARP = 1e-3  # rad, of a corner
LONGEST = 4.0  # a mitre line against the width of its chamfer
EMPTY = Region(())


def edges(levels: Levels, below: bool = False) -> list[Contour]:
    """Visible edges in (x, y), lines and arcs as they are: whole loops where all of one is seen; or those seen from below."""
    found = [line for z, loop in _seen(levels, below) for line in _not_within(levels, z, loop)]
    return [*found, *_mitres(levels, below)]


def _sections(levels: Levels, below: bool) -> Iterator[tuple[float, Region]]:
    """Sections from above down, or from below up."""
    for slab in levels.slabs if below else reversed(levels.slabs):
        ends = (slab.low, slab.high) if below else (slab.high, slab.low)
        for z in ends if slab.slants else ends[:1]:
            yield z, levels.section(slab, z)


def _more(levels: Levels, covered: Region, section: Region) -> Region:
    if not covered.loops or not section.loops:
        return section if section.loops else covered
    return section if levels.nested else joined(covered, section)


def _seen(levels: Levels, below: bool) -> Iterator[tuple[float, Contour]]:
    covered = EMPTY
    for z, section in _sections(levels, below):
        if not section.loops:
            continue
        if not covered.loops:
            yield from ((z, loop) for loop in section.loops)
            covered = section
            continue
        yield from ((z, line) for line in _beside(levels, section, covered))
        covered = _more(levels, covered, section)


def _beside(levels: Levels, section: Region, covered: Region) -> Iterator[Contour]:
    """The edges of a section that are not below what covers it, nor on the edge of that."""
    places = [(loop, where(loop, covered)) for loop in section.loops]
    if any(place is Where.ACROSS for _, place in places) and not levels.nested:
        places = [(loop, Where.ACROSS) for loop in section.difference(covered).loops]
    for loop, place in places:
        if place is Where.ACROSS:
            yield from _off(loop, covered)
        elif place is Where.OUTSIDE:
            yield loop


def _mitres(levels: Levels, below: bool) -> Iterator[Contour]:
    """Where two slanting faces meet: lines from the corners of the upper edge to those of the lower one."""
    for slab in levels.slabs:
        for each in slab.slants:
            if isinstance(each, Bevel) and each.up != below:
                upper, lower = (_corners(levels.section(slab, z), each, z) for z in (slab.high, slab.low))
                wide = abs(each.at(slab.high) - each.at(slab.low))
                for corner in upper:
                    off = np.hypot(*(lower - corner).T)
                    if len(off) and off.min() < LONGEST * wide:
                        yield Contour([corner, lower[off.argmin()]], closed=False)


def _corners(section: Region, slant: Sloped, z: float) -> Floats:
    """Sharp corners (n, 2) of a section that lie on a slanting face."""
    spots = [loop.starts[np.abs(loop.turns()) > SHARP] for loop in section.loops]
    found = np.concatenate([np.zeros((0, 2)), *spots])
    return np.asarray(found[np.abs(slant.away(*found.T) - slant.at(z)) < NEAR])


def _not_within(levels: Levels, z: float, line: Contour) -> Iterator[Contour]:
    """The stretches of a line at a height that are edges: not those in the middle of a slanting face."""
    slants = {id(each): each for slab in levels.slabs for each in slab.slants if each.low + NEAR < z < each.high - NEAR}
    if not slants:
        yield line
        return
    x, y = _spots(line).T
    within = np.zeros(len(x), dtype=bool)
    for each in slants.values():
        within |= np.abs(each.away(x, y) - each.at(z)) < NEAR
    yield from _stretches(line, np.logical_not(within).reshape(-1, len(SPOTS)))


def _off(loop: Contour, covered: Region) -> Iterator[Contour]:
    """The stretches of a loop that are not on the edge of what is above: that is drawn already."""
    off = covered.distance(_spots(loop)) >= NEAR
    return _stretches(loop, off.reshape(-1, len(SPOTS)))


def _spots(line: Contour) -> Floats:
    """Places on every element, `(m * 5, 2)`."""
    ways = (np.cumsum(line.lengths) - line.lengths)[:, None] + line.lengths[:, None] * SPOTS
    return line.point_at(ways.ravel())[0]


def _stretches(line: Contour, spots: NDArray[np.bool_]) -> Iterator[Contour]:
    """The elements of which some spots (m, 5) are shown, those that follow each other as one."""
    return stretches(line, np.asarray(spots.any(axis=1)))
