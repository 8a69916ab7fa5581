"""Clearing on rings, judged by what a disc swept along them covers, and by lengths worked out by hand."""

from itertools import pairwise

import numpy as np
import pytest
import shapely

from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.machining.milling.rings import rings, rounded

pytestmark = pytest.mark.deep


def box(x0, y0, x1, y1):
    return Contour([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def star(points, outer, inner):
    angle = np.pi * np.arange(2 * points) / points
    reach = np.where(np.arange(2 * points) % 2, inner, outer)
    return Contour(np.stack([reach * np.cos(angle), reach * np.sin(angle)], axis=1))


def dumbbell(neck):
    """Two discs r = 20 whose centres are 50 apart, joined by a neck."""
    half, reach = neck / 2, np.sqrt(400 - neck**2 / 4)
    bulge = np.tan((2 * np.pi - 2 * np.arcsin(half / 20)) / 4)
    points = [(reach, -half), (50 - reach, -half), (50 - reach, half), (reach, half)]
    return Contour(points, [0, bulge, 0, bulge])


POCKETS = {
    "rectangle": Region.of(box(0, 0, 60, 40)),
    "islands": Region.of(box(0, 0, 100, 70), holes=[Contour.circle((30, 35), 8), box(60, 25, 75, 45)]),
    "star": Region.of(star(5, 45, 18)),
    "discs": Region.of(Contour.circle((35, 50), 25), Contour.circle((65, 50), 25)),
    "narrow": Region.of(dumbbell(9)),
    "wide": Region.of(dumbbell(13)),
    "slot": Region.of(Contour([(0, 0), (40, 0), (40, 11), (0, 11)], [0, 1, 0, 1])),
    "close islands": Region.of(box(0, 0, 80, 50), holes=[box(25, 15, 30, 35), box(36, 15, 41, 35)]),
}


def swept(contours, radius):
    """What discs of a radius cover along contours, by shapely: polylines within 1e-4 mm, 400 corners each."""
    lines = [shapely.LineString(contour.points_within(1e-4)) for contour in contours]
    return shapely.union_all(shapely.buffer(lines, radius, quad_segs=100))


def area_of(region):
    pieces = [[loop.points_within(1e-4) for loop in part.loops] for part in region.parts]
    return shapely.union_all([shapely.Polygon(outer, holes) for outer, *holes in pieces])


@pytest.mark.parametrize("name", POCKETS)
@pytest.mark.parametrize("share", [0.3, 0.8, 1.0])
def test_all_that_the_tool_can_reach_is_cleared_and_nothing_else(name, share):
    radius = 5.0
    clearing = rings(POCKETS[name], radius, share * radius)
    covered = swept(clearing.passes, radius)
    reachable = shapely.union(area_of(clearing.centres), swept(clearing.centres.loops, radius))
    assert covered.intersection(reachable).area >= 0.999 * reachable.area
    assert covered.difference(area_of(POCKETS[name]).buffer(1e-3)).area == 0


@pytest.mark.parametrize("name", ["rectangle", "islands", "discs", "slot"])
def test_a_wide_step_leaves_no_core(name):
    """With k = 1.9·R material may stand in corners between two rings, but none within a last ring."""
    radius = 5.0
    clearing = rings(POCKETS[name], radius, 1.9 * radius)
    covered = swept(clearing.passes, radius)
    starts = [ring.points[0] for ring in clearing.passes]
    last = [ring for ring in clearing.passes if ring.area > 0 and sum(ring.winding(starts) != 0) <= 1]
    assert last
    for ring in last:
        assert shapely.Polygon(ring.points_within(1e-4)).difference(covered).area < 1e-3


def test_a_wide_step_needs_a_ring_for_the_core():
    """60 × 40, R = 5, k = 9.5: rings 50 × 30 and 31 × 11; a core 21 × 1 stands, its outline is the third."""
    clearing = rings(POCKETS["rectangle"], 5, 9.5)
    assert [ring.area for ring in clearing.passes] == pytest.approx([21, 31 * 11, 1500])


def test_rings_of_a_rectangle():
    """60 × 40 with R = 5: the centre goes on 50 × 30, 40 × 20 and 30 × 10; 20 × 0 would be the next."""
    clearing = rings(POCKETS["rectangle"], 5, 5)
    assert [ring.length for ring in clearing.passes] == pytest.approx([80, 120, 160])
    assert [ring.area for ring in clearing.passes] == pytest.approx([300, 800, 1500])
    assert clearing.length == pytest.approx(360)
    assert clearing.pieces[0].linked == (True, True)


def test_the_allowance_stays_at_the_walls():
    clearing = rings(POCKETS["islands"], 4, 4, allowance=0.5)
    outside = POCKETS["islands"]
    nearest = min(outside.distance(ring.points_within(0.01)).min() for ring in clearing.passes)
    assert nearest == pytest.approx(4.5, abs=1e-7)


def test_each_pass_begins_near_the_one_before():
    for name in ("rectangle", "islands", "star"):
        piece = rings(POCKETS[name], 5, 4).pieces[0]
        for before, after in pairwise(piece.passes):
            way = np.hypot(*(after.points[0] - before.points[0]))
            assert way == pytest.approx(after.distance(before.points[:1])[0], abs=1e-9)


def test_climb_and_up_cut():
    """In climb milling the ring along the wall goes counter-clockwise, those along islands go clockwise."""
    for climb, sense in ((True, 1), (False, -1)):
        clearing = rings(POCKETS["islands"], 4, 4, climb=climb)
        wall, island = [], []
        for ring in clearing.passes:
            gap = POCKETS["islands"].distance(ring.points_within(0.1))
            if np.allclose(gap, 4, atol=1e-6):
                at_wall = np.allclose(ring.bounds, [[4, 4], [96, 66]])
                (wall if at_wall else island).append(ring.area * sense > 0)
        assert wall == [True]
        assert island == [False, False]


def test_islands_first_and_from_the_inside_out():
    """A ring-shaped pocket, r = 50 with an island r = 10, R = 5 and k = 4: centres from r = 15 to r = 45.

    Insets by 0, 4, 8, 12 give two circles each. Island rings come first, down to the island, then the wall
    rings, out to the wall.
    """
    region = Region.of(Contour.circle((0, 0), 50), holes=[Contour.circle((0, 0), 10)])
    radii = [ring.length / (2 * np.pi) for ring in rings(region, 5, 4).passes]
    assert radii == pytest.approx([27, 23, 19, 15, 33, 37, 41, 45], abs=1e-7)


def test_one_plunge_for_each_piece():
    assert len(rings(POCKETS["narrow"], 5, 5).pieces) == 2  # the neck of 9 is too narrow for 10
    assert len(rings(POCKETS["wide"], 5, 5).pieces) == 1


def test_a_way_across_an_island_is_not_linked():
    """From the last ring round two islands the nearest ring of the wall lies behind one of them."""
    for name, links in (("rectangle", True), ("close islands", False)):
        piece = rings(POCKETS[name], 2.9, 2.5).pieces[0]
        assert len(piece.linked) == len(piece.passes) - 1
        assert all(piece.linked) == links
        allowed = area_of(piece.centres).buffer(1e-3)
        for (before, after), linked in zip(pairwise(piece.passes), piece.linked, strict=True):
            way = shapely.LineString([before.points[0], after.points[0]])
            assert allowed.covers(way) == linked


def test_inside_corners_of_the_last_pass_are_rounded():
    clearing = rings(POCKETS["rectangle"], 5, 5, corner_radius=1.5)
    lengths = [ring.length for ring in clearing.passes]
    assert lengths == pytest.approx([80, 120, 160 - 8 * 1.5 + 3 * np.pi])
    assert sorted(set(np.round(clearing.passes[-1].radii, 9))) == [1.5, np.inf]


def test_rounding_between_lines_and_arcs():
    """Half a disc r = 10: arcs r = 2 have their centres 8 from the middle, 2 above the diameter.

    So they begin sqrt(8² - 2²) from the middle and end at asin(2/8) above the diameter.
    """
    half = rounded(Contour([(-10, 0), (10, 0)], [0, 1]), 2.0)
    rise = np.arcsin(2 / 8)
    expected = 2 * np.sqrt(60) + 2 * 2 * (np.pi / 2 + rise) + 10 * (np.pi - 2 * rise)
    assert half.length == pytest.approx(expected)
    assert half.turns() == pytest.approx(np.zeros(4), abs=1e-9)
    hollow = Contour([(0, 0), (40, 0), (40, 20), (0, 20)], [0, -0.5, 0, 0])
    assert hollow.turns().max() > 2
    assert rounded(hollow, 1.0).turns().max() == pytest.approx(0, abs=1e-7)
    assert len(rounded(box(0, 0, 3, 3), 1.6).points) < 8  # two arcs of 1.6 do not fit on a side of 3
    assert rounded(box(0, 0, 3, 3), 1.5).length == pytest.approx(3 * np.pi)  # two of 1.5 just do: a circle


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"radius": 21}, "a tool of radius 21 does not fit into the contour"),
        ({"radius": 19, "allowance": 1.5}, "with an allowance of 1.5 does not fit"),
        ({"stepover": 0}, "stepover"),
        ({"stepover": 10.1}, "stepover"),
        ({"stepover": 1e-4}, "more than 2000 rings"),
        ({"radius": 0}, "radius must be greater than 0"),
        ({"corner_radius": -1}, "corner radius"),
    ],
)
def test_what_cannot_be_cleared_is_refused(values, message):
    with pytest.raises(ValueError, match=message):
        rings(POCKETS["rectangle"], **({"radius": 5, "stepover": 5} | values))
