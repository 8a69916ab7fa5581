"""Rings on 1,000 random areas, judged by shapely on fine arcs: the same areas, made from the same numbers without our contours.

Where a sharp corner makes polygons of one hair too coarse a judge, finer ones decide.
"""

import numpy as np
import pytest
import shapely
from random_regions import random_task
from swept_areas import capsules, grown, ring_pieces, shrunk

from mnclab.machining.milling.rings import rings

pytestmark = pytest.mark.deep
BLOCK = 50
HAIRS = 1e-3, 1e-4  # mm, by which polygons may be off: the finer ones decide where the coarse ones find a fault
TOUCH = 2e-6  # mm, by which a place may be off


def thicker(area, least):
    """The pieces of an area that are somewhere thicker than `least`."""
    pieces = shapely.get_parts(shapely.get_parts(area))
    pieces = pieces[shapely.area(pieces) > 0]
    return pieces[~shapely.is_empty(shapely.buffer(pieces, -least / 2, join_style="mitre"))]


@pytest.mark.parametrize("first", range(0, 1000, BLOCK))
def test_rings_clear_what_the_tool_reaches_and_nothing_else(first):
    for seed in range(first, first + BLOCK):
        try:
            judge(seed, HAIRS[0])
        except AssertionError:
            judge(seed, HAIRS[1])


def judge(seed, hair):
    """All that is asked of the rings of one area."""
    task = random_task(seed)
    area, keep = task.polygon(hair), task.radius + task.allowance
    centres = shrunk(area, keep, hair, surely=True)
    try:
        clearing = rings(task.region, task.radius, task.stepover, allowance=task.allowance)
    except ValueError as error:
        assert "does not fit" in str(error), seed
        assert centres.is_empty, seed
        return
    ways = [way.points_within(hair)[:-1] for way in clearing.passes]
    assert all(way.closed for way in clearing.passes), seed
    swept = capsules(np.concatenate([ring_pieces(way) for way in ways]), task.radius, True, hair)
    reach = grown(centres, task.radius, hair)
    left = thicker(shapely.difference(reach, swept), 5 * hair)
    assert shapely.area(left).sum() < 1e-3, (seed, "left", shapely.area(left).sum())
    gone = thicker(shapely.difference(swept, area), 5 * hair)
    assert shapely.area(gone).sum() < 1e-3, (seed, "outside or island", shapely.area(gone).sum())
    room = task.region
    for way in clearing.passes:
        spots = way.points_within(0.05)
        assert room.distance(spots).min() > keep - TOUCH, (seed, "allowance")
        assert room.contains(spots).all(), (seed, "outside")
    edge = shapely.buffer(shrunk(area, keep, hair, surely=False), 5 * hair)
    for piece in clearing.pieces:
        for a, b, linked in zip(piece.passes, piece.passes[1:], piece.linked, strict=False):
            if linked:
                assert edge.covers(shapely.LineString([a.points[0], b.points[0]])), (seed, "link")
