"""Passes of simple pockets and studs against the numbers of the catalogue, and against formulas."""

from itertools import pairwise

import numpy as np
import pytest
import shapely

from mnclab.geometry.contours import Contour
from mnclab.machining.milling import faces


def half_sides(passes):
    return np.array([np.ptp(contour.bounds, axis=0) / 2 for contour in passes])


def starts(passes):
    return np.array([contour.points[0] for contour in passes])


def swept(contours, radius):
    lines = [shapely.LineString(contour.points_within(1e-4)) for contour in contours]
    return shapely.union_all(shapely.buffer(lines, radius, quad_segs=100))


def box(x, y, corner=0.0):
    """A rectangle about the origin by shapely alone, its half sides x and y."""
    return shapely.box(corner - x, corner - y, x - corner, y - corner).buffer(corner, quad_segs=400)


def test_rings_of_a_rectangular_pocket():
    """80 × 60, R 5, U 0.2, K 1: half sides as in the check of G343."""
    clearing = faces.rectangle(80, 60, 5, 5, corner=5, allowance=0.2)
    expected = [(10, 0), (14.96, 4.96), (19.92, 9.92), (24.88, 14.88), (29.84, 19.84), (34.8, 24.8)]
    assert half_sides(clearing.passes) == pytest.approx(np.array(expected))
    assert starts(clearing.passes) == pytest.approx(np.array([(a, 0) for a, _ in expected]))
    assert all(ring.area > 0 for ring in clearing.passes[1:])
    assert clearing.pieces[0].entry == pytest.approx((0, 0))
    assert clearing.labels[0] == "ring 1 of 6"


def test_corner_radius_and_rotation():
    """80 × 60, R 10, E 30 with U 0.2: the last ring has corners of 4.8 and begins at (30.1377, 17.4)."""
    last = faces.rectangle(80, 60, 5, 5, corner=10, allowance=0.2, angle=np.radians(30)).passes[-1]
    assert last.points[0] == pytest.approx((30.1377, 17.4), abs=1e-4)
    assert sorted(set(np.round(last.radii, 6))) == [4.8, np.inf]


def test_a_pocket_higher_than_wide_begins_above():
    passes = faces.rectangle(60, 80, 5, 5).passes
    assert passes[0].points.tolist() == [[0, 10], [0, -10], [0, 10]]
    assert starts(passes[1:]) == pytest.approx(np.array([(0, 15), (0, 20), (0, 25), (0, 30), (0, 35)]))
    assert faces.rectangle(60, 80, 5, 5, begin=0).passes[-1].points[0] == pytest.approx((25, 0))


def test_circles_of_a_circular_pocket():
    """Diameter 60, R 5, U 0.2, K 1: circles as in the check of G344."""
    clearing = faces.circle(60, 5, 5, allowance=0.2, centre=(50, 50))
    radii = [4.96, 9.92, 14.88, 19.84, 24.8]
    assert [ring.length / (2 * np.pi) for ring in clearing.passes] == pytest.approx(radii)
    assert starts(clearing.passes) == pytest.approx(np.array([(50 + r, 50) for r in radii]))
    assert faces.circle(10, 5, 5).passes == ()  # the tool fills the pocket
    assert faces.circle(60, 5, 5, climb=False).passes[0].area < 0


@pytest.mark.parametrize("share", [0.3, 1.0, 1.4])
@pytest.mark.parametrize("corner", [0, 9])
def test_a_rectangle_is_cleared(share, corner):
    """What a tool of radius 4 reaches of 70 × 46 has corners of at least 4."""
    clearing = faces.rectangle(70, 46, 4, 4 * share, corner=corner, allowance=0.3)
    covered = swept([Contour([(0, 0), clearing.passes[0].points[0]], closed=False), *clearing.passes], 4)
    reach = box(34.7, 22.7, max(corner - 0.3, 4))
    assert covered.intersection(reach).area >= 0.999 * reach.area
    assert covered.difference(reach.buffer(1e-3)).area < 1e-6


@pytest.mark.parametrize("step", [1.2, 4.0, 5.5])
def test_a_circle_is_cleared(step):
    clearing = faces.circle(61, 4, step, allowance=0.25, centre=(3, -2), angle=0.4)
    start = Contour([(3, -2), clearing.passes[0].points[0]], closed=False)
    covered, reach = swept([start, *clearing.passes], 4), shapely.Point(3, -2).buffer(30.25, quad_segs=400)
    assert covered.intersection(reach).area >= 0.999 * reach.area
    assert covered.difference(shapely.Point(3, -2).buffer(30.25 + 1e-3, quad_segs=4000)).area == 0


@pytest.mark.parametrize(
    "line", [Contour([(0, 0), (40, 10)], closed=False), Contour([(25, 0), (0, 25)], [0.41421356237, 0], closed=False)]
)
@pytest.mark.parametrize("width", [8, 10, 21])
def test_a_slot_is_cleared(line, width):
    clearing = faces.slot(line, width, 4, allowance=0.0)
    covered = swept(clearing.passes, 4)
    wall = shapely.LineString(line.points_within(1e-5)).buffer(width / 2, quad_segs=400)
    assert covered.intersection(wall).area >= 0.999 * wall.area
    assert covered.difference(wall.buffer(1e-3)).area == 0
    assert all(ring.area > 0 for ring in clearing.passes[1:])


def test_a_slot_as_wide_as_the_tool_is_one_pass():
    line = Contour([(0, 0), (40, 0)], closed=False)
    assert faces.slot(line, 8, 4, allowance=0.3).passes == (line,)
    assert [len(faces.slot(line, w, 4).passes) for w in (9, 16, 16.1, 24.1)] == [2, 2, 3, 4]


def test_passes_are_joined_end_to_start():
    for clearing in (faces.rectangle(50, 40, 4, 3), faces.circle(50, 4, 3)):
        for before, after in pairwise(clearing.passes[1:]):
            assert np.hypot(*(after.points[0] - before.points[0])) <= 3 + 1e-9


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: faces.rectangle(9, 40, 5, 4), "radius 5 does not fit into a pocket of 9 by 40"),
        (lambda: faces.rectangle(40, 30, 5, 4, corner=16), "corner radius of 16"),
        (lambda: faces.circle(11, 5, 4, allowance=1), "allowance of 1 does not fit"),
        (lambda: faces.circle(20, 5, 0), "stepover"),
        (lambda: faces.slot(Contour([(0, 0), (9, 0)], closed=False), 7, 4), "a slot 7 wide"),
    ],
)
def test_what_does_not_fit_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()
