"""Walls of areas on their own: where the passes lie, how the tool comes to them, that nothing beyond the allowance is cut."""

import math

import numpy as np
import pytest
from shapely import LineString, Polygon, distance, get_coordinates, points, union_all

from mnclab import Kind
from mnclab.controls.tnc_620.machining.finishing import Heights, finish_walls, outside, wall_loops
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.machining.steps import traced

R = 5.0


def box(x, y, width, height):
    return Contour([(x, y), (x + width, y), (x + width, y + height), (x, y + height)])


def fine(contour):
    """A contour as a fine polygon."""
    return Polygon(contour.points_within(1e-5))


def near(value):
    return pytest.approx(value, abs=1e-9)


def test_the_wall_of_a_circle_is_a_circle():
    """Its arcs have the radius asked for; the tool stands at sqrt((24.8 - 2.5)² + 2.5²) from the middle before and after."""
    for climb in (True, False):
        (wall,) = wall_loops(Region.of(Contour.circle((3, 4), 30)), R, allowance=0.2, lead=2.5, climb=climb)
        assert wall.tangential and wall.contour.radii == near([24.8, 24.8]) and (wall.contour.area > 0) == climb
        assert wall.approach.radii == near([2.5]) and wall.departure.radii == near([2.5])
        assert wall.approach.length == near(2.5 * math.pi / 2)
        for place in (wall.start, wall.departure.points[-1]):
            assert math.dist(place, (3, 4)) == near(math.hypot(24.8 - 2.5, 2.5))
        assert wall.approach.tangents()[1][0] == near(wall.contour.tangents()[0][0])
        assert wall.departure.tangents()[0][0] == near(wall.contour.tangents()[1][-1])


def test_a_rectangle_with_an_island():
    """Climbed: the island clockwise on its rounded outline first, then the wall counter-clockwise; both begin at mid-length."""
    region = Region.of(box(0, 0, 100, 60), holes=[box(40, 25, 20, 10)])
    island, wall = wall_loops(region, R, allowance=0.5)
    assert wall.contour.length == near(2 * (100 + 60 - 4 * 5.5)) and wall.contour.area > 0
    assert island.contour.length == near(2 * (20 + 10) + 2 * math.pi * 5.5) and island.contour.area < 0
    assert abs(wall.contour.points[0] - (50, 30)) == near(np.array([0, 24.5]))
    assert abs(island.contour.points[0] - (50, 30)) == near(np.array([0, 10.5]))
    assert wall.approach.radii == island.approach.radii == near([2.5])  # half the tool radius


def test_inside_corners_are_rounded_and_outside_ones_are_not():
    """Q8 = 2 on the tool centre: four quarter circles of 2 in the corners of the wall; the island keeps its arcs of 5."""
    region = Region.of(box(0, 0, 100, 60), holes=[box(40, 25, 20, 10)])
    island, wall = wall_loops(region, R, corner_radius=2)
    assert wall.contour.length == near(2 * (90 + 50) - 4 * (4 - math.pi))
    assert sorted(set(np.round(wall.contour.radii, 9)))[0] == 2 and set(np.round(island.contour.radii, 9)) == {5, np.inf}


@pytest.mark.parametrize(("width", "radius"), [(20, 2.5), (14, 2.0), (12.4, 1.2)])
def test_arcs_are_shortened_to_the_room(width, radius):
    """Between walls the disc about the middle of both arcs has half the way of the tool centre, width - 2·R."""
    (wall,) = wall_loops(Region.of(box(0, 0, 60, width)), R, least=0.5)
    assert wall.tangential and wall.approach.radii == pytest.approx([radius], abs=1e-6)


def test_without_room_the_tool_comes_straight_from_the_middle():
    """2 mm for the tool centre, but arcs of 1.5 at least: 60 x 12 has no place for them; it comes from 1 mm off the wall."""
    (wall,) = wall_loops(Region.of(box(0, 0, 60, 12)), R, least=1.5, lead=2)
    assert not wall.tangential
    assert wall.approach.length == near(1) and wall.departure.length == near(1)
    assert wall.approach.points[0].tolist() == near([30, 6])


def test_a_slot_hardly_wider_than_the_tool_is_entered_between_its_walls():
    (wall,) = wall_loops(Region.of(box(0, 0, 60, 10.0002)), R, least=0.5)
    assert not wall.tangential and 0 < wall.approach.length <= 1e-4
    assert abs(wall.start[1] - 5.0001) < 6e-5


def test_a_pass_begins_where_arcs_have_room():
    """The longest sides are those of a channel 11 wide; the arcs of 2 are in the chamber 40 x 40 at its end."""
    region = Region.of(box(0, 0, 40, 40)).union(Region.of(box(30, 14.5, 200, 11)))
    (wall,) = wall_loops(region, R, least=2, lead=2)
    assert wall.tangential and wall.approach.radii == near([2])
    x, y = wall.contour.points[0]
    assert x == near(5) or y in (near(5), near(35))


def test_an_island_alone_is_gone_round_from_outside():
    """Contour milling: clockwise in climb, on the outline rounded by R, from arcs of 7 that keep off the island."""
    block = box(10, 20, 40, 30)
    (wall,) = wall_loops(Region.of(block), R, lead=7, least=6.5, solid=True)
    assert wall.contour.length == near(2 * 70 + 2 * math.pi * R) and wall.contour.area < 0
    assert wall.approach.radii == near([7])
    ways = union_all([LineString(each.points_within(1e-4)) for each in (wall.approach, wall.contour, wall.departure)])
    assert ways.distance(fine(block)) == pytest.approx(R, abs=2e-4)  # chords
    (reverse,) = wall_loops(Region.of(block), R, solid=True, climb=False)
    assert reverse.contour.area > 0


def test_islands_alone_keep_their_inner_walls():
    """A ring of four bars encloses a court 30 x 30: it is a wall of its own, the edge of what is looked at is none."""
    ring = Region.of(box(0, 0, 50, 50), holes=[box(10, 10, 30, 30)])
    walls = wall_loops(ring, R, solid=True)
    assert sorted(round(wall.contour.length, 6) for wall in walls) == [80, round(200 + 10 * math.pi, 6)]
    assert outside(ring, 20).area == near(90 * 90 - 1600)


def test_a_tool_too_large_is_refused():
    with pytest.raises(ValueError, match="a tool of radius 5 with an allowance of 1.01 does not fit into the contour"):
        wall_loops(Region.of(box(0, 0, 60, 12)), R, allowance=1.01)
    with pytest.raises(ValueError, match="the tool radius must be greater than 0"):
        wall_loops(Region.of(box(0, 0, 60, 12)), 0)


def figure(seed):
    """Boxes and discs united, with islands in them."""
    rng = np.random.default_rng(seed)
    parts = [box(*rng.uniform(0, 60, 2), *rng.uniform(15, 60, 2)) for _ in range(3)]
    parts += [Contour.circle(rng.uniform(10, 70, 2), rng.uniform(8, 30)) for _ in range(3)]
    holes = [box(*rng.uniform(0, 90, 2), *rng.uniform(2, 12, 2)) for _ in range(2)]
    return parts, [*holes, Contour.circle(rng.uniform(10, 80, 2), rng.uniform(1, 8))]


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(40))
def test_random_walls_are_finished_and_none_is_gouged(seed):
    """Passes keep their distance from the drawing everywhere, none of its edge is left out, and no disc leaves the area.

    Both edges are chains of chords, 1e-5 off; shapely's own inset of so many chords is farther off in places.
    """
    rng = np.random.default_rng(1000 + seed)
    parts, holes = figure(seed)
    radius, allowance, least = rng.uniform(1, 6), rng.uniform(0, 0.5), rng.uniform(0, 1)
    region = Region.union_of(*parts, holes=holes)
    walls = wall_loops(region, radius, allowance=allowance, lead=radius / 2 + 0.5, least=least, climb=bool(seed % 2))
    area = union_all([fine(each) for each in parts]) - union_all([fine(each) for each in holes])
    passes = np.vstack([wall.contour.points_within(1e-4) for wall in walls])
    assert abs(distance(points(passes), area.boundary) - radius - allowance).max() < 5e-5
    edge = points(get_coordinates(area.buffer(-radius - allowance, 256).boundary))
    assert distance(edge, union_all([LineString(wall.contour.points_within(1e-4)) for wall in walls])).max() < 5e-4
    ways = [each for wall in walls for each in (wall.approach, wall.contour, wall.departure)]
    cut = union_all([LineString(each.points_within(1e-4)).buffer(radius, 256) for each in ways])
    assert (cut - area).area < 1e-3
    for wall in walls:
        if wall.tangential:
            assert least - 1e-6 <= wall.approach.radii[0] <= max(radius / 2 + 0.5, least) + 1e-6
        else:
            assert least > 0


def test_steps_of_walls():
    """Levels -5 and -8: down outside, arcs on the level; at the last one a helix from 0.08 above, and back up to there."""
    walls = wall_loops(Region.of(Contour.circle((0, 0), 30)), R, lead=2)
    path = traced(finish_walls(walls, Heights([-5, -8], 0.08, 50, 2), 100, 400), (0, 0, 60), R)
    assert [(row.kind.name, round(float(row.end[2]), 6), row.feed) for row in path] == [
        ("RAPID", 50, math.inf), ("RAPID", 50, math.inf), ("RAPID", 2, math.inf),
        ("LINE", -5, 100), ("ARC", -5, 400), ("ARC", -5, 400), ("ARC", -5, 400), ("ARC", -5, 400),
        ("LINE", -5, 400), ("LINE", -7.92, 100), ("ARC", -8, 400), ("ARC", -8, 400), ("ARC", -8, 400), ("ARC", -7.92, 400),
    ]  # fmt: skip
    arcs = path[path.kind == Kind.ARC]
    assert (arcs.sweep > 0).all() and np.isclose(arcs.sweep[[0, 3, 4, 7]], math.pi / 2).all()
    assert {row.label for row in path} >= {"wall, infeed 1 of 2, approach", "wall, infeed 2 of 2, departure"}
