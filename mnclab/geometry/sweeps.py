"""What a disc or an outline covers that moves along contours, what it leaves of an area, and the middle line of an area.

Polylines and polygons, by shapely: near, where `regions` is exact. What is covered is a little less than the truth: a
disc is a polygon in it, off by R/13 000 at most, a path keeps `CHORD_ERROR`. Lengths in mm.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, crossed, length_of
from mnclab.geometry.cutting import outlines_of
from mnclab.geometry.regions import Region
from mnclab.geometry.tracing import bands_beside

CHORD_ERROR = 1e-3
QUARTER_STEPS = 64  # corners of a quarter circle


def covered(passes: Iterable[Contour], radius: float) -> Any:
    """What a disc covers along contours, as a shapely area."""
    lines = [shapely.LineString(contour.points_within(CHORD_ERROR)) for contour in passes]
    return shapely.union_all(shapely.buffer(lines, radius, quad_segs=QUARTER_STEPS))


def swept(outline: Floats, way: Contour) -> Any:
    """What a convex outline (k, 2) covers that is moved along a contour without turning, as a shapely area.

    `outline` counts from the moved point. Arcs are chords, off by `CHORD_ERROR` at most.
    """
    places = way.points_within(CHORD_ERROR)
    corners = places[:, None] + outline
    hulls = shapely.convex_hull(shapely.multipoints(np.concatenate([corners[:-1], corners[1:]], axis=1)))
    return shapely.union_all(hulls[shapely.get_type_id(hulls) == 3])


def under(contour: Contour, level: float) -> Any:
    """The area between a contour (x, y) and a level of y, as a shapely area; arcs as in `swept`."""
    points = contour.points_within(CHORD_ERROR)
    return shapely.make_valid(shapely.Polygon([*points, (points[-1, 0], level), (points[0, 0], level)]))


def polygons(region: Region) -> Any:
    """A region as a shapely area. Holes are taken away one by one: chords of one that touches its wall may cross it."""
    areas = []
    for part in region.parts:
        wall, *holes = (shapely.make_valid(shapely.Polygon(loop.points_within(CHORD_ERROR))) for loop in part.loops)
        areas.append(shapely.difference(wall, shapely.union_all(holes)) if holes else wall)
    return shapely.union_all(areas)


def stays(passes: Iterable[Contour], area: Any) -> list[bool]:
    """Which contours lie in a shapely area, or within twice `CHORD_ERROR` of it."""
    lines = [shapely.LineString(contour.points_within(CHORD_ERROR)) for contour in passes]
    room = shapely.buffer(area, 2 * CHORD_ERROR)
    shapely.prepare(room)
    return [bool(one) for one in shapely.covers(room, lines)]


def left_over(area: Any, cover: Any, least: float) -> Region:
    """What of a shapely area is not covered, without what is narrower than `least`."""
    rest = shapely.difference(area, cover)
    kept = shapely.buffer(shapely.buffer(rest, -least / 2, join_style="mitre"), least / 2, join_style="mitre")
    return outlined(shapely.intersection(rest, kept))


def broad(area: Any, least: float) -> Any:
    """The pieces of a shapely area that are somewhere wider than `least`, whole."""
    pieces = shapely.get_parts(area)
    pieces = pieces[shapely.area(pieces) > 0]
    return shapely.union_all(pieces[~shapely.is_empty(shapely.buffer(pieces, -least / 2, join_style="mitre"))])


def outlined(area: Any) -> Region:
    """A shapely area as a region of polylines."""
    loops: list[Contour] = []
    for polygon in shapely.get_parts(shapely.get_parts(area)):
        if polygon.geom_type != "Polygon" or polygon.is_empty:
            continue
        for k, ring in enumerate((polygon.exterior, *polygon.interiors)):
            corners = Contour(shapely.get_coordinates(ring)[:-1])
            loops.append(corners if (corners.area > 0) == (k == 0) else corners.reversed())
    return Region(tuple(loops))


class Skeleton(NamedTuple):
    """The middle line of an area: points `(n, 2)`, their distance from the boundary `(n,)`, edges `(m, 2)` between them."""

    points: Floats
    room: Floats
    edges: NDArray[np.intp]


def skeleton(region: Region, spacing: float) -> Skeleton:
    """The centres of discs that touch the boundary in two places, from points `spacing` apart on it.

    A branch is cut back while its last disc lies within its neighbour's but for a tenth of `spacing`: what is left are
    the branches that reach somewhere.
    """
    spots = [_spaced(loop, spacing) for loop in region.loops]
    cells = shapely.voronoi_polygons(shapely.MultiPoint(np.vstack(spots)), only_edges=True)
    lines, owner = shapely.get_coordinates(shapely.get_parts(cells), return_index=True)
    points, index = np.unique(np.round(lines, 9), axis=0, return_inverse=True)
    edges = np.stack([index.reshape(-1)[:-1], index.reshape(-1)[1:]], axis=1)[owner[1:] == owner[:-1]]
    edges = np.unique(np.sort(edges[edges[:, 0] != edges[:, 1]], axis=1), axis=0)
    inside = region.contains(points)
    edges = edges[inside[edges].all(axis=1)]
    room = np.zeros(len(points))
    room[inside] = region.distance(points[inside])
    return _pruned(Skeleton(points, room, edges), spacing / 10)


def _spaced(loop: Contour, spacing: float) -> Floats:
    """Points on a contour, at most `spacing` apart, its corners among them."""
    upto = loop.upto
    counts = np.maximum(np.ceil(loop.lengths / spacing).astype(int), 1)
    ways = [a + (b - a) * np.arange(n) / n for a, b, n in zip(upto, upto[1:], counts, strict=False)]
    return loop.point_at(np.concatenate(ways))[0]


def _pruned(found: Skeleton, slack: float) -> Skeleton:
    points, room, edges = found
    while len(edges):
        degree = np.bincount(edges.ravel(), minlength=len(points))
        tip = np.where(degree[edges] == 1, edges, -1)
        gone = np.zeros(len(edges), dtype=bool)
        for column in (0, 1):
            leaf, stem = edges[:, column], edges[:, 1 - column]
            apart = length_of(points[leaf] - points[stem])
            gone |= (tip[:, column] >= 0) & (apart + room[leaf] <= room[stem] + slack * np.minimum(1, apart))
        if not gone.any():
            break
        edges = edges[~gone]
    return Skeleton(points, room, edges)


def long_axes(rest: Region) -> Sequence[Floats]:
    """For each piece of a region the line `(2, 2)` between its two corners farthest apart."""
    axes = []
    for part in rest.parts:
        corners = part.loops[0].points
        for _ in range(2):  # from any corner to the farthest, from there to the farthest
            corners = np.roll(corners, -int(length_of(corners - corners[0]).argmax()), axis=0)
        axes.append(corners[[0, int(length_of(corners - corners[0]).argmax())]])
    return axes


# Strips: what lies within a distance of a line of lines and arcs, open or closed. Lengths in mm.
#  .----------.       every element has a band on either side of it, every corner a fan on its outer side, and
# (  --------  )      the ends of an open line are round: what a disc sweeps along the line, with exact arcs
#  `----------´

def strip(line: Contour, reach: float) -> Region:
    """What lies within `reach` of a line, which may cross itself; a ValueError where `reach` is not greater than 0."""
    if not reach > 0:
        raise ValueError(f"a strip reaches more than 0 to either side of its line, got {reach:g}")
    return Region.union_of(*_pieces(line, reach))


def _pieces(line: Contour, reach: float) -> Iterator[Contour]:
    yield from bands_beside(line, reach)
    yield from bands_beside(line.reversed(), reach)
    for place in () if line.closed else line.points[[0, -1]]:
        yield Contour.circle(place, reach)


# Parallel lines across an area: where each of them lies inside. Lengths in mm.

LEVEL = 1e-9


def scan(region: Region, heights: Floats) -> list[Floats]:
    """For each height y the stretches `(k, 2)` of x where the line at y lies in the region, from left to right."""
    found = []
    for row in crossed(outlines_of(region.loops).curves, np.asarray(heights, dtype=float)):
        kept = np.ones(len(row), dtype=bool)
        least = np.where(np.arange(len(row) - 1) % 2, 0.0, LEVEL)  # of a gap between two stretches, and of a stretch
        for k in np.flatnonzero(np.diff(row) <= least).tolist():
            if kept[k]:
                kept[k : k + 2] = False
        found.append(row[kept].reshape(-1, 2))
    return found
