"""Rings on 1,000 random areas, judged by shapely on fine arcs: the same areas, made from the same numbers without our contours.

GEOS simplifies what it buffers by a hundredth of the distance, so areas grow and shrink here piece by piece: the hull of two
equal discs about the ends of every straight piece. Discs are polygons within `HAIR` of the truth, inside it where they stand
for the tool, outside it where they stand for a wall.
"""

import numpy as np
import pytest
import shapely
from random_regions import random_task

from mnclab.machining.milling.rings import rings

pytestmark = pytest.mark.deep
BLOCK = 50
HAIR = 1e-3  # mm, by which polygons may be off
TOUCH = 2e-6  # mm, by which a place may be off


def capsules(ring, distance, outside):
    """What lies within a distance of a ring of straight pieces `(n, 2)`, a hair too much or too little."""
    half = max(8, int(np.ceil(np.pi / np.arccos(1 - HAIR / distance) / 2)))
    angle = np.pi * np.arange(half + 1) / half - np.pi / 2
    after = np.roll(ring, -1, axis=0)
    way = np.arctan2(*(after - ring).T[::-1])[:, None]
    reach = distance / np.cos(np.pi / half / 2) if outside else distance
    caps = [place[:, None] + reach * np.stack([np.cos(a), np.sin(a)], axis=2)
            for place, a in ((after, way + angle), (ring, way + angle + np.pi))]  # fmt: skip
    return shapely.union_all(shapely.polygons(np.concatenate(caps, axis=1)))


def rings_of(area):
    """The rings of a shapely area."""
    polygons = [each for each in shapely.get_parts(area) if each.geom_type == "Polygon"]
    return [shapely.get_coordinates(ring)[:-1] for each in polygons for ring in (each.exterior, *each.interiors)]


def shrunk(area, distance, surely):
    """What of an area is farther than a distance from its edge; `surely` without what may only seem so."""
    gone = [capsules(ring, distance + HAIR * surely, surely) for ring in rings_of(area)]
    return shapely.difference(area, shapely.union_all(gone))


def thicker(area, least):
    """The pieces of an area that are somewhere thicker than `least`."""
    pieces = shapely.get_parts(shapely.get_parts(area))
    pieces = pieces[shapely.area(pieces) > 0]
    return pieces[~shapely.is_empty(shapely.buffer(pieces, -least / 2, join_style="mitre"))]


@pytest.mark.parametrize("first", range(0, 1000, BLOCK))
def test_rings_clear_what_the_tool_reaches_and_nothing_else(first):
    for seed in range(first, first + BLOCK):
        judge(seed)


def judge(seed):
    """All that is asked of the rings of one area."""
    task = random_task(seed)
    area, keep = task.polygon(HAIR), task.radius + task.allowance
    centres = shrunk(area, keep, surely=True)
    try:
        clearing = rings(task.region, task.radius, task.stepover, allowance=task.allowance)
    except ValueError as error:
        assert "does not fit" in str(error), seed
        assert centres.is_empty, seed
        return
    ways = [way.points_within(HAIR)[:-1] for way in clearing.passes]
    assert all(way.closed for way in clearing.passes), seed
    swept = shapely.union_all([capsules(way, task.radius, True) for way in ways])
    reach = shapely.union_all([centres, *(capsules(ring, task.radius, False) for ring in rings_of(centres))])
    left = thicker(shapely.difference(reach, swept), 5 * HAIR)
    assert shapely.area(left).sum() < 1e-3, (seed, "left", shapely.area(left).sum())
    gone = thicker(shapely.difference(swept, area), 5 * HAIR)
    assert shapely.area(gone).sum() < 1e-3, (seed, "outside or island", shapely.area(gone).sum())
    room = task.region
    for way in clearing.passes:
        spots = way.points_within(0.05)
        assert room.distance(spots).min() > keep - TOUCH, (seed, "allowance")
        assert room.contains(spots).all(), (seed, "outside")
    edge = shapely.buffer(shrunk(area, keep, surely=False), 5 * HAIR)
    for piece in clearing.pieces:
        for a, b, linked in zip(piece.passes, piece.passes[1:], piece.linked, strict=False):
            if linked:
                assert edge.covers(shapely.LineString([a.points[0], b.points[0]])), (seed, "link")
