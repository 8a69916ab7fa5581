"""Ways beside contours: closed forms of corners, arcs and helices, what a tool without room leaves, what a coarse tool left."""

import math

import numpy as np
import pytest
from shapely import LineString

from mnclab.controls.tnc_620.machining.train_passes import Feeds, Train, leading_off, leading_to, mill
from mnclab.controls.tnc_620.machining.trains import beside, cuts_into, rests
from mnclab.geometry.contours import Contour
from mnclab.machining.steps import traced
from mnclab.path.leads import Lead
from mnclab.path.toolpath import PathFault

RECTANGLE = Contour([(0, 0), (40, 0), (40, 30), (0, 30)])
CORNER = Contour([(0, 0), (50, 0), (50, 50)], closed=False)
#: Two half circles of radius 20 that make an S.
S_SHAPE = Contour([(0, 0), (40, 0), (80, 0)], [1, -1, 0], closed=False)


def only(found):
    (way,) = found.ways
    assert found.fault is None
    return way


def test_inside_a_rectangle():
    way = only(beside(RECTANGLE, 5, 1))
    assert way.contour.points == pytest.approx(np.array([(5, 5), (35, 5), (35, 25), (5, 25), (5, 5)]))
    assert way.closes


def test_outside_a_rectangle_corners_are_arcs():
    way = only(beside(RECTANGLE, 5, -1))
    assert way.contour.length == pytest.approx(2 * (40 + 30) + 2 * math.pi * 5)
    assert way.begin == pytest.approx((0, -5)) and way.closes
    assert sorted(way.contour.sweeps) == pytest.approx([0] * 4 + [math.pi / 2] * 4)


@pytest.mark.parametrize("side", [1, -1])
def test_a_clockwise_contour_is_run_clockwise(side):
    there, back = only(beside(RECTANGLE, 5, side)), only(beside(RECTANGLE.reversed(), 5, -side))
    assert back.contour.length == pytest.approx(there.contour.length)
    assert there.contour.area == pytest.approx(-back.contour.area)


def test_a_closed_contour_may_begin_on_its_longest_element():
    """Begun on an edge the way begins square to that place; the element with the beginning is the first or any other."""
    for points in ([(20, 0), (40, 0), (40, 30), (0, 30), (0, 0)], [(10, 0), (40, 0), (40, 30), (0, 30), (0, 0)]):
        way = only(beside(Contour(points), 5, 1))
        assert way.begin == pytest.approx(points[0] + np.array([0, 5])) and way.closes
        assert way.contour.length == pytest.approx(2 * (30 + 20))


@pytest.mark.parametrize(("side", "first", "second"), [(1, 15, 25), (-1, 25, 15)])
def test_arcs_stay_arcs(side, first, second):
    way = only(beside(S_SHAPE, 5, side))
    assert way.contour.radii == pytest.approx([first, second])
    assert way.contour.length == pytest.approx(math.pi * (first + second))


def test_negative_distance_is_the_other_side():
    assert only(beside(CORNER, -5, 1)).contour.points == pytest.approx(only(beside(CORNER, 5, -1)).contour.points)


@pytest.mark.parametrize(("distance", "side"), [(0, 1), (5, 0)])
def test_on_the_contour(distance, side):
    assert only(beside(CORNER, distance, side)).contour.points == pytest.approx(CORNER.points)
    assert only(beside(RECTANGLE, distance, side)).contour.length == pytest.approx(140)


def test_heights_are_those_of_the_contour():
    way = only(beside(CORNER, 5, 1, [0, -2, -7]))
    assert way.contour.points == pytest.approx(np.array([(0, 5), (45, 5), (45, 50)]))
    assert way.heights == pytest.approx([0, -2, -7])
    outside = only(beside(CORNER, 5, -1, [0, -2, -7]))
    assert outside.heights == pytest.approx([0, -2, -2, -7])  # level about the corner


def test_a_helix_stays_one():
    turns = Contour([(10 * (-1) ** k, 0) for k in range(7)], [1] * 6 + [0], closed=False)
    way = only(beside(turns, 3, 1, -np.arange(7.0)))
    assert way.contour.radii == pytest.approx(np.full(6, 7)) and way.contour.sweeps == pytest.approx(np.full(6, math.pi))
    assert way.heights == pytest.approx(-np.arange(7.0))


def test_a_closed_contour_with_heights():
    way = only(beside(RECTANGLE, 5, 1, [0, -1, -3, -1]))
    assert way.closes and way.heights == pytest.approx([0, -1, -3, -1, 0])


def test_a_step_too_small_for_the_tool_is_left_and_told():
    """A disc of radius 5 does not get into a groove 8 wide."""
    contour = Contour([(0, 0), (36, 0), (36, -3), (44, -3), (44, 0), (80, 0)], closed=False)
    found = beside(contour, 5, 1)
    assert "the largest radius for the whole contour is 3 mm" in found.fault.message
    (way,) = found.ways
    # on the edges of the groove, 8 apart, the disc stands 5 - 3 = sqrt(25 - 16) lower: 3 above the upper edge
    assert way.contour.distance([(40, 3)])[0] == pytest.approx(0, abs=1e-6)
    assert way.contour.bounds == pytest.approx(np.array([(0, 3), (80, 5)]))
    line = LineString(contour.points)
    assert min(line.distance(LineString([p, p])) for p in way.contour.points_within(0.01)) > 5 - 1e-3
    # the corner (36, -3) is hypot(4, 6) from (40, 3)
    assert found.left == pytest.approx(math.hypot(4, 6) - 5) and found.place[1] == pytest.approx(-3)


def test_a_neck_parts_a_closed_contour():
    neck = Contour([(0, 0), (30, 0), (30, 11), (50, 11), (50, 0), (80, 0), (80, 30), (50, 30), (50, 19), (30, 19), (30, 30),
                    (0, 30)])  # fmt: skip
    found = beside(neck, 5, 1)
    assert len(found.ways) == 2 and "they are 8 mm apart" in found.fault.message
    assert found.ways[0].begin == pytest.approx((5, 5))
    # each room reaches into the neck until the disc touches both its edges, 4 off the middle: 3 in front of them
    assert [way.contour.bounds[:, 0].tolist() for way in found.ways] == [pytest.approx([5, 27]), pytest.approx([53, 75])]
    assert found.left == pytest.approx(math.hypot(13, 4) - 5, abs=1e-3)  # in the middle of the wall of the neck


@pytest.mark.parametrize(
    ("contour", "radius", "message"),
    [
        (RECTANGLE, 15.1, "they are 30 mm apart"),
        (Contour.circle((0, 0), 4), 5, "the inside arc of radius 4"),
        (Contour([(0, 0), (40, 0), (40, 20), (20, 20), (20, -10)], closed=False), 5, "the contour crosses itself"),
        (Contour([(0, 0), (30, 30), (30, 0), (0, 30)]), 2, "the contour crosses itself"),
        (Contour([(0, 0), (0, 60), (8, 60), (8, 0)], closed=False), 5, "they are 8 mm apart"),
    ],
)
def test_no_way(contour, radius, message):
    side = -1 if not contour.closed and contour.points[1, 1] else 1
    with pytest.raises(PathFault, match=message):
        beside(contour, radius, side)


def test_no_room_on_a_slope_is_a_fault_at_its_element():
    steps = Contour([(0, 0), (40, 0), (40, 3), (48, 3), (80, 3)], closed=False)
    with pytest.raises(PathFault) as fault:
        beside(steps, 5, 1, [0, 0, -1, -1, -1])
    assert fault.value.step == 1


# --- approaches ------------------------------------------------------------------------------------------------------

LINE = only(beside(Contour([(0, 0), (30, 0)], closed=False), 0, 1))


@pytest.mark.parametrize(
    ("lead", "begins", "length"),
    [
        (Lead("CT", 0, 1, radius=3, angle=math.radians(45)), (-2.121, 0.879), 2.356),  # the example of cycle 270
        (Lead("LT", 0, 1, length=2), (-2, 0), 2),
        (Lead("LN", 0, 1, length=2), (0, 2), 2),
        (Lead("LN", 0, -1, length=2), (0, -2), 2),
        (Lead("CT", 0, -1, radius=3, angle=2 * math.pi), (0, 0), 6 * math.pi),
    ],
)
def test_approach_and_departure(lead, begins, length):
    to, off = leading_to(LINE, lead), leading_off(LINE, lead)
    assert to.begin == pytest.approx(begins, abs=1e-3) and to.end == pytest.approx((0, 0))
    assert to.contour.length == pytest.approx(length, abs=1e-3)
    assert off.end == pytest.approx((30 - begins[0], begins[1]), abs=1e-3) and off.begin == pytest.approx((30, 0))
    assert off.contour.length == pytest.approx(length, abs=1e-3)


def test_a_lead_from_a_place_comes_by_its_auxiliary_point():
    to = leading_to(LINE, Lead("LT", 0, 1, length=5), (-10, 20, 4.0))
    assert to.contour.points == pytest.approx(np.array([(-10, 20), (-5, 0), (0, 0)]))
    assert to.heights == pytest.approx([4, 0, 0])


def test_a_lead_into_the_contour_is_found():
    wall = Contour([(0, 0), (0, 20), (30, 20)], closed=False)
    way = only(beside(wall, 5, -1))
    assert way.begin == pytest.approx((5, 0))
    assert cuts_into(wall, leading_to(way, Lead("LT", 0, -1, length=6)), 5) is None
    assert cuts_into(wall, leading_off(way, Lead("LT", 0, -1, length=6)), 5) is None
    assert cuts_into(wall, leading_to(way, Lead("LN", 0, 1, length=6)), 5) == pytest.approx((0, 0), abs=0.7)


# --- passes ----------------------------------------------------------------------------------------------------------


def heights_of(steps):
    return [round(float(z), 6) for z in traced(steps, (0, 0, 50), 5).end[:, 2]]


def test_passes_in_one_sense_and_to_and_fro():
    train = Train(LINE)
    feeds = Feeds(100, 300, 50, 2)
    path = traced(mill([train], (-5, -10), feeds), (0, 0, 50), 5)
    assert path.end[:, 2].tolist() == [2, -5, -5, 50, 50, 2, -10, -10, 50]
    both = traced(mill([train], (-5, -10), feeds, to_and_fro=True), (0, 0, 50), 5)
    assert both.end.tolist() == [[0, 0, 2], [0, 0, -5], [30, 0, -5], [30, 0, -10], [0, 0, -10], [0, 0, 50]]
    assert np.isinf(both.feed).tolist() == [True, False, False, False, False, True]


# --- what a coarse tool left ------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("accepted", "extended"), [(0.01, 2), (0.5, 0), (1, 3)])
def test_rest_in_a_corner(accepted, extended):
    """Thicker than t stands where s < C - sqrt(2 C t + t²) from the corner, C = 10 being the coarse radius."""
    fine, coarse = only(beside(CORNER, 3, 1)), only(beside(CORNER, 10, 1))
    (rest,) = rests(fine, 3, 1, [coarse.contour], 10, accepted, 10, extended)
    reach = 10 - math.sqrt(20 * accepted + accepted**2) + extended
    assert rest.contour.points == pytest.approx(np.array([(50 - reach, 3), (47, 3), (47, reach)]), abs=1e-6)


def test_rests_are_joined_and_end_where_the_contour_ends():
    square = Contour([(0, 0), (60, 0), (60, 60), (0, 60)])
    fine, coarse = only(beside(square, 3, 1)), [only(beside(square, 10, 1)).contour]
    assert len(rests(fine, 3, 1, coarse, 10, 0.01, 36, 0)) == 4  # 60 - 2 · 9.553 + … = 40.9 - 2 · 2 apart and more
    assert len(rests(fine, 3, 1, coarse, 10, 0.01, 42, 0)) == 1
    assert rests(fine, 3, 1, coarse, 10, 8, 36, 0) == ()
    assert rests(fine, 3, 1, [], 10, 8, 0, 0) == (fine,)


def test_a_whole_rest_is_extended_straight_on():
    (rest,) = rests(only(beside(CORNER, 3, 1, [1, 2, 3])), 3, 1, [], 10, 0.01, 0, 2)
    assert rest.contour.points == pytest.approx(np.array([(-2, 3), (0, 3), (47, 3), (47, 50), (47, 52)]))
    assert rest.heights == pytest.approx([1, 1, 2, 3, 3])


def test_a_tight_arc_is_a_rest():
    """In an inside arc of radius 6 a tool of radius 10 has no room; a tool of radius 3 finishes it."""
    bay = Contour([(0, 0), (30, 0), (36, 6), (36, 40)], [0, math.tan(math.pi / 8), 0, 0], closed=False)
    coarse = beside(bay, 10, 1)
    assert coarse.fault is not None
    (rest,) = rests(only(beside(bay, 3, 1)), 3, 1, [way.contour for way in coarse.ways], 10, 0.05, 0, 0)
    assert rest.contour.radii == pytest.approx([np.inf, 3, np.inf])
