"""Regions against closed forms: two discs and a dumbbell from a control's manual, rings, frames."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mnclab import Alarm
from mnclab.geometry import cutting
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region

A = Contour.circle((35, 50), 25, start=np.pi, clockwise=True)
B = Contour.circle((65, 50), 25, clockwise=True)
LENS = 1250 * np.arccos(0.6) - 600  # what two discs r = 25 share whose centres are 30 apart
QUARTER = np.tan(np.pi / 8)


def box(x0, y0, x1, y1):
    return Contour([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def perimeter(region):
    return sum(loop.length for loop in region.loops)


def dumbbell():
    """Discs r = 30 about (30, 30) and r = 20, 55 mm off at 60°, with a neck 20 mm wide (TNC 620, 8.13).

    Along the neck the discs end sqrt(r² - 10²) from their centres; their arcs are 2π less twice asin(10/r).
    """
    along, across = np.array([0.5, np.sqrt(0.75)]), np.array([-np.sqrt(0.75), 0.5])
    one, two = np.array([30.0, 30.0]), np.array([30.0, 30.0]) + 55 * along
    a, b = np.sqrt(800), np.sqrt(300)
    points = [one + a * along - 10 * across, two - b * along - 10 * across]
    points += [two - b * along + 10 * across, one + a * along + 10 * across]
    sweeps = [0, 2 * np.pi - 2 * np.arcsin(0.5), 0, 2 * np.pi - 2 * np.arcsin(1 / 3)]
    return Contour(points, np.tan(np.array(sweeps) / 4))


def caps(radius):
    """The piece of a disc beyond a chord of 20 mm."""
    angle = 2 * np.arcsin(10 / radius)
    return radius**2 * (angle - np.sin(angle)) / 2


@pytest.mark.parametrize(
    ("region", "area", "around"),
    [
        (Region.of(A, B), 1250 * np.pi - LENS, 100 * (np.pi - np.arccos(0.6))),  # 3367.872, 221.430
        (Region.of(A, holes=[B]), 625 * np.pi - LENS, 50 * np.pi),  # 1404.376, 157.080
        (Region.of(A).intersection(Region.of(B)), LENS, 100 * np.arccos(0.6)),  # 559.119, 92.730
    ],
)
def test_two_overlapping_discs(region, area, around):
    assert region.area == pytest.approx(area, abs=1e-8)
    assert perimeter(region) == pytest.approx(around, abs=1e-8)
    assert len(region.loops) == 1
    corners = region.loops[0].points[np.argsort(region.loops[0].points[:, 1])]
    assert corners == pytest.approx(np.array([[50, 30], [50, 70]]), abs=1e-8)
    assert region.loops[0].radii == pytest.approx([25, 25], abs=1e-8)  # arcs again


def test_union_and_difference_of_regions():
    a, b = Region.of(A), Region.of(B)
    assert a.union(b).area == pytest.approx(1250 * np.pi - LENS, abs=1e-8)
    assert b.difference(a).area == pytest.approx(625 * np.pi - LENS, abs=1e-8)
    assert a.difference(a).loops == ()
    assert a.union(Region()).area == pytest.approx(625 * np.pi)
    assert Region().union(Region()).loops == ()


def test_sense_of_loops_and_parts():
    outer = [box(0, 0, 100, 90), box(200, 0, 220, 20).reversed()]
    frame = Region.of(*outer, holes=[box(10, 10, 20, 20), A.reversed()])
    assert [np.sign(loop.area) for loop in frame.loops] == [1, -1, -1, 1]
    assert [part.area for part in frame.parts] == pytest.approx([9000 - 100 - 625 * np.pi, 400], abs=1e-7)


def test_a_single_contour_is_kept():
    region = Region.of(A)
    assert region.loops[0].area == -A.area
    assert region.loops[0].points[0].tolist() == A.points[0].tolist()


def test_coinciding_arcs_leave_nothing_behind():
    disc = Region.of(Contour.circle((0, 0), 22))
    assert Region.of(Contour.circle((0, 0), 25)).inset(3).difference(disc).loops == ()
    half = Region.of(Contour([(25, 0), (0, 25), (-25, 0)], [QUARTER, QUARTER, 0]))
    whole = Region.of(Contour.circle((0, 0), 25, start=1))
    rest = whole.difference(half)
    assert [len(loop.points) for loop in rest.loops] == [2]
    assert rest.area == pytest.approx(625 * np.pi / 2, abs=1e-8)


def test_inset_of_a_rounded_rectangle():
    points = [(5, 0), (45, 0), (50, 5), (50, 25), (45, 30), (5, 30), (0, 25), (0, 5)]
    region = Region.of(Contour(points, [0, QUARTER] * 4))
    for d in (0.5, 3, 4.9999):  # the corners keep their centres, with radius 5 - d
        expected = (50 - 2 * d) * (30 - 2 * d) - (4 - np.pi) * (5 - d) ** 2
        assert region.inset(d).area == pytest.approx(expected, rel=1e-9)
        assert len(region.inset(d).loops[0].points) == 8
    for d in (5, 7, 14.99):  # now the corners are sharp
        assert region.inset(d).area == pytest.approx((50 - 2 * d) * (30 - 2 * d), abs=1e-7)
        assert len(region.inset(d).loops[0].points) == 4
    assert region.inset(15).loops == ()
    assert region.offset(2).area == pytest.approx(54 * 34 - (4 - np.pi) * 49, rel=1e-9)


def test_inset_past_islands():
    """A square island in a rectangle: the inset goes round the corners of the island on arcs of radius d."""
    region = Region.of(box(0, 0, 100, 60), holes=[box(40, 25, 50, 35)])
    for d in (1, 5, 12):
        island = 100 + 40 * d + np.pi * d * d
        assert region.inset(d).area == pytest.approx((100 - 2 * d) * (60 - 2 * d) - island, rel=1e-9)
    outer, hole = region.inset(5).loops
    assert sorted(hole.radii) == pytest.approx([5] * 4 + [np.inf] * 4)
    assert outer.area > 0 > hole.area
    assert len(region.inset(13).parts) == 2  # of the 25 mm between wall and island none are left
    assert len(region.inset(13).loops) == 2


def test_inset_of_a_ring_to_nothing():
    ring = Region.of(Contour.circle((0, 0), 30), holes=[Contour.circle((0, 0), 10)])
    for d in (1, 9.999):
        assert ring.inset(d).area == pytest.approx(np.pi * ((30 - d) ** 2 - (10 + d) ** 2), rel=1e-6)
    assert ring.inset(10).loops == ()
    assert ring.offset(4).area == pytest.approx(np.pi * (34**2 - 6**2), rel=1e-9)
    assert ring.offset(11).area == pytest.approx(np.pi * 41**2, rel=1e-9)


def test_the_dumbbell_falls_apart():
    """The coarse tool, r = 15, does not pass the neck (TNC 620, example C20)."""
    region = Region.of(dumbbell())
    neck = 20 * (55 - np.sqrt(800) - np.sqrt(300))
    assert region.area == pytest.approx(1300 * np.pi - caps(30) - caps(20) + neck, rel=1e-12)  # 4212.730
    centres = region.inset(15)
    assert [part.area for part in centres.parts] == pytest.approx([713.69, 80.47], abs=0.05)
    beak = max(np.hypot(*(centres.parts[0].loops[0].points - [30, 30]).T))
    assert beak == pytest.approx(np.sqrt(800) - np.sqrt(125), abs=1e-6)  # 17.104: 15 from both corners
    left_over = region.difference(centres.offset(15))
    swept = 225 * np.arcsin(2 / 3) - 10 * np.sqrt(125)  # of the neck, from each beak
    assert left_over.area == pytest.approx(neck - 2 * swept, abs=1e-6)  # 83.134
    assert len(left_over.parts) == 1


@pytest.mark.deep
def test_inset_keeps_its_distance():
    region = Region.of(dumbbell(), box(-20, 20, 80, 40), holes=[Contour.circle((30, 30), 6)])
    for d in (0.1, 2, 8, -1, -15):
        result = region.inset(d)
        assert result.loops
        for loop in result.loops:
            assert region.distance(loop.points_within(0.1)) == pytest.approx(abs(d), abs=1e-7)


def test_contains():
    ring = Region.of(Contour.circle((0, 0), 30), holes=[Contour.circle((0, 0), 10)])
    angle = np.linspace(0, 2 * np.pi, 50)
    rays = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    assert ring.contains(10.001 * rays).all()
    assert ring.contains(29.999 * rays).all()
    assert not ring.contains(9.999 * rays).any()
    assert not ring.contains(30.001 * rays).any()
    assert not Region().contains(rays).any()


def test_a_straight_way_stays_inside_or_not():
    ring = Region.of(Contour.circle((0, 0), 30), holes=[Contour.circle((0, 0), 10)])
    assert ring.holds((20, -15), (20, 15))
    assert ring.holds((-28, 10), (28, 10))  # just touches the island
    assert not ring.holds((-28, 9.9), (28, 9.9))
    assert not ring.holds((0, -29), (0, 29))
    assert not ring.holds((20, 0), (31, 0))
    square = Region.of(box(0, 0, 10, 10))
    assert square.holds((0, 0), (10, 0))  # along a side
    assert not square.holds((0, 0), (10, -0.001))


def test_what_encloses_no_area_is_refused():
    with pytest.raises(ValueError, match=r"crosses or touches itself near \(5\.000, 5\.000\)"):
        Region.of(Contour([(0, 0), (10, 10), (10, 0), (0, 10)]))
    with pytest.raises(ValueError, match="closed"):
        Region.of(Contour([(0, 0), (10, 10), (10, 0)], closed=False))
    with pytest.raises(ValueError, match="nothing"):
        Region.of(Contour([(0, 0), (0, 0), (0, 0)]))


def test_elements_of_no_length_do_no_harm():
    doubled = Contour([(0, 0), (10, 0), (10, 0), (10, 10), (0, 10), (0, 0)])
    assert Region.of(doubled).inset(1).area == pytest.approx(64)


@st.composite
def tangent_polygons(draw):
    """Polygons whose sides all touch one circle: an inset by d is the polygon for the radius less d.

    Area = r² · Σ tan(turn / 2): a kite of two right triangles for each corner.
    """
    count = draw(st.integers(3, 8))
    gaps = np.array(draw(st.lists(st.floats(1, 1.8), min_size=count, max_size=count)))
    turns = 2 * np.pi * gaps / gaps.sum()
    radius = draw(st.floats(5, 50))
    normal = np.cumsum(turns) + draw(st.floats(0, 6))
    middle = normal - turns / 2  # a corner lies between two sides
    reach = radius / np.cos(turns / 2)
    points = np.stack([reach * np.cos(middle), reach * np.sin(middle)], axis=1)
    return Contour(points), radius, np.tan(turns / 2).sum()


@settings(max_examples=40, deadline=None)
@given(tangent_polygons(), st.floats(0.01, 0.95))
def test_inset_of_a_convex_polygon(polygon, part):
    contour, radius, shape = polygon
    d = part * radius
    assert Region.of(contour).inset(d).area == pytest.approx((radius - d) ** 2 * shape, abs=1e-6)


@settings(max_examples=40, deadline=None)
@given(tangent_polygons(), st.floats(0.1, 20))
def test_offset_of_a_convex_polygon(polygon, d):
    """Outwards: area + d · perimeter + π·d², the perimeter being 2·r·Σ tan(turn / 2)."""
    contour, radius, shape = polygon
    expected = radius**2 * shape + d * 2 * radius * shape + np.pi * d * d
    assert Region.of(contour).offset(d).area == pytest.approx(expected, rel=1e-9)


def test_islands_that_touch_grow_together():
    """Two discs r = 6 and 7 that touch, grown by 1.5: two circles with a lens in common, whose middle is 1.5 from both edges."""
    region = Region.of(box(-40, -40, 40, 40), holes=[Contour.circle((-6, 0), 6), Contour.circle((7, 0), 7)])
    (loop,) = [loop for loop in region.inset(1.5).loops if loop.area < 0]
    a, b, c = 7.5, 8.5, 13.0
    at = np.arccos([(a * a + c * c - b * b) / (2 * a * c), (b * b + c * c - a * a) / (2 * b * c)])
    lens = (np.array([a, b]) ** 2 * (at - np.sin(2 * at) / 2)).sum()
    assert -loop.area == pytest.approx(np.pi * (a * a + b * b) - lens, abs=1e-9)


def test_elements_that_have_passed_each_other_are_not_crossed(monkeypatch):
    """A polygon of 300 sides, r = 40, in steps of 17: at 51 all have passed the centre, where each would cross all others."""
    seen = []
    crossed = cutting.pieces_of
    monkeypatch.setattr(cutting, "pieces_of", lambda moved, joints: seen.append(len(moved.r)) or crossed(moved, joints))
    turns = 2 * np.pi * np.arange(300) / 300
    region = Region.of(Contour(40 * np.stack([np.cos(turns), np.sin(turns)], axis=1)))
    apothem = 40 * np.cos(np.pi / 300)
    expected = [300 * np.tan(np.pi / 300) * (apothem - 17 * k) ** 2 for k in range(3)]
    assert [each.area for each in region.insets(17)] == pytest.approx(expected)
    assert seen == [300, 300, 0]


def test_an_outer_contour_within_another_is_said():
    """It changes nothing in a union; who gives it means an island or a second level."""
    outer, inner = box(0, 0, 100, 90), box(10, 10, 20, 20)
    with pytest.raises(Alarm, match=r"outer contour 2 of 2, from X10.000 Y10.000, lies within another one .*holes=.*area_of"):
        Region.of(outer, inner)
    assert Region.union_of(outer, inner).area == pytest.approx(9000)
    assert Region.of(outer, holes=[inner]).area == pytest.approx(8900)
    assert Region.of(box(0, 0, 10, 10), box(5, 5, 15, 15)).area == pytest.approx(175)  # crossing ones are joined


def test_an_empty_area_answers_in_words():
    """Every attribute and method: a value, or an Alarm; the bounds are what it has not."""
    empty, square = Region.of(), Region.of(box(0, 0, 10, 10))
    with pytest.raises(Alarm, match="an empty area has no bounds"):
        empty.bounds  # noqa: B018
    assert empty.area == 0 and empty.parts == () and "0 loops" in repr(empty)
    assert not empty.contains([(0, 0)]).any() and np.isinf(empty.distance([(0, 0)])).all()
    assert not empty.holds((0, 0), (1, 1))
    for made in (empty.inset(1), empty.offset(1), empty.difference(square), empty.intersection(square), empty.without([square])):
        assert made.loops == ()
    for made in (empty.union(square), square.union(empty), square.difference(empty), square.without([empty])):
        assert made.area == pytest.approx(100)
    assert list(empty.insets(1)) == [] and square.intersection(empty).loops == ()


@pytest.mark.parametrize("wrong", [None, 3, "abc", [], [[1]], float])
def test_an_area_of_anything_else_is_refused(wrong):
    with pytest.raises(Alarm, match="an area is what contours enclose, got"):
        Region.of(wrong)
