"""Areas taken from an area, or put to it: what lies clear of all edges needs no set operation, its loops become those of
the rest.

Set operations trace every loop again, which is most of the time that a plate with many holes takes.
"""

from __future__ import annotations

from collections.abc import Sequence
from enum import Enum
from typing import Any

import numpy as np

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region

ROUGH = 1e-3  # mm, how far the polygons that are looked at may be off
CLEAR = 1e-2  # mm, between edges that do not meet
SAME = 1e-9  # mm, within which two loops are one


class Where(Enum):
    """Where a loop lies against a region: on a loop of it, clear of all of them, or none of these."""

    EDGE, INSIDE, OUTSIDE, ACROSS = range(4)


def where(loop: Contour, region: Region) -> Where:
    """Where a loop lies against a region."""
    if any(_same(loop, other) for other in region.loops):
        return Where.EDGE
    edges = [shapely.LinearRing(other.points_within(ROUGH)) for other in region.loops]
    line = shapely.LinearRing(loop.points_within(ROUGH))
    if shapely.dwithin(line, edges, CLEAR).any():
        return Where.ACROSS
    return Where.INSIDE if region.contains(loop.points[:1])[0] else Where.OUTSIDE


def joined(a: Region, b: Region) -> Region:
    """What two regions cover together, exact."""
    if not (a.loops and b.loops):
        return a if a.loops else b
    mine, theirs = ([where(loop, other) for loop in one.loops] for one, other in ((a, b), (b, a)))
    if Where.ACROSS in (*mine, *theirs):
        return a.union(b)
    loops = [loop for loop, place in zip(a.loops, mine) if place is not Where.INSIDE]
    loops += [loop for loop, place in zip(b.loops, theirs) if place is Where.OUTSIDE]
    outer = [loop for loop in loops if loop.area > 0]
    return _with_holes([Region((loop,)) for loop in outer], [loop for loop in loops if loop.area < 0])


def less(region: Region, gone: Sequence[Region]) -> Region:
    """A region less some others, exact."""
    near = [each for each in gone if each.loops and region.loops and not _beside(region, each)]
    if not near:
        return region
    region = _unswallowed(region, near)
    parts = region.parts
    bodies = [rough(part) for part in parts]
    filled = [[rough(Region(piece.loops[:1])) for piece in each.parts] for each in near]
    holes: list[list[Region]] = [[] for _ in parts]
    hard = list[Region]()
    for k, each in enumerate(near):
        inside = [_inside(bodies, outline) for outline in filled[k]]
        others = [outline for i, row in enumerate(filled) if i != k for outline in row]
        if None in inside or any(shapely.dwithin(outline, others, CLEAR).any() for outline in filled[k]):
            if any(shapely.dwithin(outline, bodies, CLEAR).any() for outline in filled[k]):
                hard.append(each)
            continue
        for where, piece in zip(inside, each.parts):
            holes[where].append(piece)  # type: ignore[index]
    loops = []
    for part, taken in zip(parts, holes):
        loops += [*part.loops, *(piece.loops[0].reversed() for piece in taken)]
        for piece in taken:  # its islands stay
            loops += [loop.reversed() for loop in piece.loops[1:]]
    found = Region(tuple(loops))
    return _cut(found, hard) if hard else found


def _unswallowed(region: Region, gone: Sequence[Region]) -> Region:
    """A region without those of its holes that one of some areas takes away with all around them."""
    holes = [loop for loop in region.loops if loop.area < 0]
    if not holes:
        return region
    areas = [rough(each) for each in gone]
    within = [shapely.contains_properly(areas, _filled(hole).buffer(CLEAR, quad_segs=2)).any() for hole in holes]
    swallowed = [hole for hole, found in zip(holes, within) if found and not _holds_parts(hole, region)]
    return Region(tuple(loop for loop in region.loops if not any(loop is hole for hole in swallowed)))


def _cut(region: Region, gone: Sequence[Region]) -> Region:
    """A region less others that meet its edges; holes clear of these are not looked at."""
    areas = [rough(each) for each in gone]
    kept, clear = list[Contour](), list[Contour]()
    for loop in region.loops:
        aside = loop.area < 0 and not shapely.dwithin(_filled(loop), areas, CLEAR).any() and not _holds_parts(loop, region)
        (clear if aside else kept).append(loop)
    return _with_holes(Region(tuple(kept)).without(gone).parts, clear)


def _with_holes(parts: Sequence[Region], holes: Sequence[Contour]) -> Region:
    """Parts, and holes each of which lies in one of them: in the smallest where one is around the other."""
    loops = [list(part.loops) for part in parts]
    for hole in holes:
        around = [k for k, part in enumerate(parts) if part.contains(hole.points[:1])[0]]
        loops[min(around, key=lambda k: parts[k].area)].append(hole)
    return Region(tuple(loop for each in loops for loop in each))


def _holds_parts(hole: Contour, region: Region) -> bool:
    """Whether there is material again within a hole."""
    inner = [loop.points[0] for loop in region.loops if loop.area > 0]
    return bool(np.any(hole.winding(inner)))


def _filled(loop: Contour) -> Any:
    return shapely.Polygon(loop.points_within(ROUGH))


def _same(a: Contour, b: Contour) -> bool:
    """Whether two loops are one, walked the same way."""
    return a is b or (len(a.points) == len(b.points) and bool(
        (np.abs(a.points - b.points) < SAME).all() and (np.abs(a.bulge - b.bulge) < SAME).all()
    ))  # fmt: skip


def _beside(region: Region, other: Region) -> bool:
    """Whether the boxes about two regions are clear of each other."""
    (a, b), (c, d) = region.bounds, other.bounds
    return bool((b + CLEAR < c).any() or (d + CLEAR < a).any())


def _inside(bodies: list[Any], outline: Any) -> int | None:
    """Which of some bodies an outline lies in, clear of its edges."""
    found = np.flatnonzero(shapely.contains_properly(bodies, outline.buffer(CLEAR, quad_segs=2)))
    return int(found[0]) if len(found) else None


def rough(region: Region) -> Any:
    """A region as a rough shapely area."""
    rings = [[loop.points_within(ROUGH) for loop in part.loops] for part in region.parts]
    return shapely.MultiPolygon([shapely.Polygon(first, rest) for first, *rest in rings])
