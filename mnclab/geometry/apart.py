"""Areas taken from an area: what lies clear of all edges needs no set operation, its loops become those of the rest.

Set operations trace every loop again, which is most of the time that a plate with many holes takes.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from mnclab.geometry import shapely
from mnclab.geometry.regions import Region

ROUGH = 1e-3  # mm, how far the polygons that are looked at may be off
CLEAR = 1e-2  # mm, between edges that do not meet


def less(region: Region, gone: Sequence[Region]) -> Region:
    """A region less some others, exact."""
    near = [each for each in gone if each.loops and region.loops and not _beside(region, each)]
    if not near:
        return region
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
    return found.without(hard) if hard else found


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
