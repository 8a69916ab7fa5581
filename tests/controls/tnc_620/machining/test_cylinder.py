"""Contours on the developed surface of a cylinder: closed forms of the offsets, the feet, the slot and its remachining."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely

from mnclab.controls.tnc_620.machining.cylinder import (
    beside,
    lead,
    opened,
    remachining,
    round_about,
    shrunk,
    slot_round,
    standing,
    way_along,
)
from mnclab.geometry.contours import Contour
from mnclab.path.toolpath import PathFault

SQUARE = Contour([(0, 0), (50, 0), (50, 50), (0, 50)])
S_SHAPE = Contour([(60, 0), (60, -35), (40, -52.5), (40, -70)], closed=False)  # of the manual's program C28
RADIUS, FLOOR = 25.0, 18.0


def test_inside_of_a_square_that_begins_at_a_corner():
    """5 mm inside of a square of 50: a square of 40, begun where its first and last side meet."""
    found = beside(SQUARE, 5.0)
    assert found.points.tolist() == [[5, 5], [45, 5], [45, 45], [5, 45], [5, 5]] and not found.bulge.any()


def test_outside_of_a_square():
    """Its corners are arcs of a quarter circle about them; the path begins and ends where the first side does."""
    found = beside(SQUARE, -5.0)
    assert found.points[0].tolist() == [0, -5] == found.points[-1].tolist()
    assert found.length == pytest.approx(4 * 50 + 2 * math.pi * 5)


def test_a_distance_of_nothing_is_the_contour_itself():
    assert beside(SQUARE, 0.0).length == 200 and opened(S_SHAPE) is S_SHAPE


def test_the_place_that_is_too_narrow_is_named():
    """An offset of 5 between walls 6 mm apart, and inside of an arc of 3: the largest one is 3 mm."""
    narrow = Contour([(0, 0), (50, 0), (50, 6), (0, 6)], closed=False)
    arc = Contour([(0, 0), (50, 0), (53, 3), (53, 50)], [0, math.tan(math.pi / 8), 0, 0], closed=False)
    for contour, step in ((narrow, 70), (arc, 71)):
        with pytest.raises(PathFault) as caught:
            beside(contour, 5.0, steps=[70, 71, 72])
        assert caught.value.step == step and "the largest distance for the whole contour is 3 mm" in caught.value.message


@pytest.mark.parametrize("turned", range(3))
def test_a_closed_contour_that_begins_at_any_corner(turned):
    """The same way, begun elsewhere; its area is that of shapely, with fine arcs."""
    points = np.roll([(0, 0), (50, 0), (20, 40)], turned, axis=0)
    for distance in (4.0, -4.0):
        way = beside(Contour(points), distance)
        assert way.points[0] == pytest.approx(way.points[-1])
        area = abs(Contour(way.points[:-1], way.bulge[:-1]).area)
        assert area == pytest.approx(shapely.Polygon(points).buffer(-distance, quad_segs=2000, join_style=1).area, abs=1e-3)


def test_a_loop_round_a_straight_ridge():
    """2 L + 2 pi d (9.4): twice 50 and a circle of 10; clockwise with the ridge on the right."""
    line = Contour([(0, 0), (50, 0)], closed=False)
    loop = round_about(line, 10.0)
    assert loop.length == pytest.approx(2 * 50 + 2 * math.pi * 10)
    assert Contour(loop.points[:-1], loop.bulge[:-1]).area == pytest.approx(-(50 * 20 + math.pi * 100))
    assert round_about(line, -10.0).points[0].tolist() == [0, -10]


def test_a_loop_is_the_outline_of_a_swept_disc():
    """Shapely, with fine arcs, is the authority of the area."""
    loop = round_about(S_SHAPE, 9.5)
    area = abs(Contour(loop.points[:-1], loop.bulge[:-1]).area)
    assert area == pytest.approx(shapely.LineString(S_SHAPE.points).buffer(9.5, quad_segs=2000).area, abs=1e-3)


def test_feet_of_a_wall_path_lie_on_the_contour():
    bent = Contour([(0, 0), (30, 0), (50, 20), (50, 60)], [0, math.tan(math.pi / 8), 0, 0], closed=False)
    for distance in (4.0, -4.0):
        way = way_along(beside(bent, distance), distance)
        assert bent.distance(way.feet).max() < 1e-9
        assert np.hypot(*way.shifts.T) == pytest.approx(4.0, abs=1e-9)
        assert bent.distance(way.centres) == pytest.approx(4.0, abs=1e-9)


def test_chords_of_arcs_keep_to_a_tenth_of_a_micrometre_and_their_points_to_the_arc():
    path = Contour.circle((0, 0), 20)
    way = way_along(opened(path))
    assert np.hypot(*way.feet.T) == pytest.approx(20, abs=1e-12)
    middle = (way.feet[1:] + way.feet[:-1]) / 2
    assert (20 - np.hypot(*middle.T)).max() < 1e-4
    assert len(way_along(Contour([(0, 0), (3, 4)], closed=False)).feet) == 2  # a line is one piece


def test_at_a_corner_the_foot_turns_about_the_tool():
    """Inside, on the way of C28: the tool stands at (58.5, -34.319) while its foot goes over the bend."""
    way = way_along(beside(S_SHAPE, -1.5), -1.5)
    still = np.flatnonzero(np.hypot(*np.diff(way.centres, axis=0).T) < 1e-9)
    assert len(still) == 1 and way.centres[still[0]] == pytest.approx([58.5, -34.319], abs=1e-3)
    assert way.ways[still[0] + 1] == pytest.approx(2 * 1.5 * math.sin(math.radians(48.814) / 2), abs=1e-4)


def test_the_shift_alone_moves_where_the_foot_stands():
    way = standing((10, 5), Contour([(10, 5), (10, 8)], [1.0, 0.0], closed=False))
    assert (way.feet == (10, 5)).all() and way.shifts[-1] == pytest.approx([0, 3])


def test_once_round_in_a_slot():
    """The centre lines of C28 (9.6): right forward, left back; it ends where it began."""
    ways = dict(slot_round(S_SHAPE, -1.5))
    right, left = ways["first wall"].centres, ways["second wall"].centres
    for path, expected in (
        (right, [(58.5, 0), (58.5, -34.319), (38.5, -70)]), (left, [(41.5, -70), (41.5, -53.181), (61.5, 0)]),
    ):  # fmt: skip
        for point in expected:
            assert np.hypot(*(path - point).T).min() < 1e-3
    assert ways["approach"].centres[0].tolist() == [60, 0] == pytest.approx(ways["departure"].centres[-1].tolist())
    ends = [way.centres[[0, -1]] for way in ways.values()]
    assert all(np.allclose(one[1], other[0]) for one, other in zip(ends, ends[1:], strict=False))


@pytest.mark.parametrize("gap", [3.0, -3.0])
def test_a_lead_touches_the_wall(gap):
    """It begins a gap beside the wall, and its quarter circle ends in the direction of the path; off it is the mirror image."""
    wall = Contour([(0, 0), (20, 0)], closed=False)
    on, off = lead(wall, gap, arrives=True), lead(wall, gap, arrives=False)
    assert on.points[0].tolist() == [0, gap] and off.points[-1].tolist() == [20, gap]
    assert on.radii[-1] == pytest.approx(3) and on.tangents()[1][-1] == pytest.approx([1, 0])
    assert off.radii[0] == pytest.approx(3) and off.tangents()[0][0] == pytest.approx([1, 0])
    assert lead(wall, gap, arrives=True, straight=True).points.tolist() == [[0, gap], [0, 0]]


def bend(slope: float, rho: float) -> float:
    """By how much the direction of a line turns from the surface down to rho."""
    return math.atan(RADIUS / rho * slope) - math.atan(slope)


def test_c28_needs_no_remachining_by_a_hair():
    """1.5 (1 - cos(atan(25/18 * 0.875) - atan 0.875)) = 0.019991 mm: just within 0.02."""
    assert 1.5 * (1 - math.cos(bend(0.875, FLOOR))) == pytest.approx(0.019991, abs=1e-6)
    assert remachining(S_SHAPE, 1.5, RADIUS, FLOOR, 0.02) == ()
    assert len(remachining(S_SHAPE, 1.5, RADIUS, FLOOR, 0.01999)) == 1
    assert remachining(S_SHAPE, 1.5, RADIUS, FLOOR, 0.0) == () == remachining(S_SHAPE, 0.0, RADIUS, FLOOR, 0.02)


@pytest.mark.parametrize("tolerance", [0.015, 0.005, 0.001, 0.0001])
def test_remachining_leaves_no_wall_beyond_the_tolerance(tolerance):
    """At every depth the best pass lies within the tolerance, and one pass less would not do: their number is that of the
    closed form of a single direction."""
    found = remachining(S_SHAPE, 1.5, RADIUS, FLOOR, tolerance)
    half = math.acos(1 - tolerance / 1.5)
    assert len(found) == math.ceil((bend(0.875, FLOOR) - half) / (2 * half))
    for rho in np.linspace(FLOOR, RADIUS, 200):
        missing = min(1.5 * (1 - math.cos(bend(0.875, rho) - bend(0.875, at))) for at in (RADIUS, *found))
        assert missing < tolerance * (1 + 1e-6)


def test_remachining_holds_for_every_direction_of_an_arc():
    arc = Contour([(0, 0), (20, 20)], [math.tan(math.pi / 8), 0], closed=False)
    found = remachining(arc, 1.5, RADIUS, FLOOR, 0.001)
    for slope in np.tan(np.linspace(0.01, math.pi / 2 - 0.01, 60)):
        for rho in np.linspace(FLOOR, RADIUS, 60):
            assert min(1.5 * (1 - math.cos(bend(slope, rho) - bend(slope, at))) for at in (RADIUS, *found)) < 1.001e-3


def test_a_shrunk_contour():
    assert shrunk(S_SHAPE, 0.5).points[:, 0].tolist() == [30, 30, 20, 20]
    circle = shrunk(Contour.circle((0, 0), 10), 0.5)
    assert circle.closed and circle.area == pytest.approx(math.pi * 50, abs=0.01)
