"""Floors of terraces: each is cleared once as far as the tool reaches, no wall is touched; the arc down to a floor."""

import math

import numpy as np
import pytest
from shapely import LineString, union_all
from shapely.geometry import box

from mnclab import Kind
from mnclab.controls.tnc_620.machining.finishing import Descent, finish_floor, floor_passes
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.machining.milling.terraces import DeepArea, Joined, terraces
from mnclab.machining.steps import traced

R, ALLOWANCE = 4.0, 0.3


def part(x, y, width, height, depth=0.0):
    return DeepArea(Region.of(Contour([(x, y), (x + width, y), (x + width, y + height), (x, y + height)])), depth)


WHOLE, MIDDLE, BESIDE = box(0, 0, 80, 60), box(20, 20, 60, 40), box(0, 0, 79, 20)
#: formula and whole depth; then depths of the floors and what they are.
CASES = {
    "pocket in a pocket": (Joined("|", part(0, 0, 80, 60, 10), part(20, 20, 40, 20, 20)), [(10, WHOLE - MIDDLE), (20, MIDDLE)]),
    "island below the surface": (
        Joined("\\", part(0, 0, 80, 60), part(20, 20, 40, 20, 8)), [(8, MIDDLE), (20, WHOLE - MIDDLE)],
    ),
    "a ledge narrower than the tool": (
        Joined("|", part(0, 0, 80, 60, 10), part(0, 0, 79, 20, 20)), [(10, WHOLE - BESIDE), (20, BESIDE)],
    ),
}  # fmt: skip


def covered(clearing):
    ways = [LineString(each.points_within(1e-4)) for each in clearing.passes]
    return union_all([way.buffer(R, 64) for way in ways]), union_all(ways)


@pytest.mark.parametrize("name", CASES)
def test_each_floor_is_cleared_once(name):
    """What discs in the inset area reach of a floor is covered; centres stay within R of the floor that they clear."""
    formula, floors = CASES[name]
    found = terraces(formula, 20)
    made = list(floor_passes(found, R, R, allowance=ALLOWANCE))
    assert [floor.depth for floor in made] == [depth for depth, _ in floors]
    for floor, (_, area), above in zip(made, floors, (WHOLE, floors[-1][1]), strict=True):
        cut, ways = covered(floor.clearing)
        room = above.buffer(-ALLOWANCE - R, 64)
        reachable = room.buffer(R, 64) & area
        assert reachable.area > 0 and (reachable - cut).area < 2e-2  # discs are polygons of 256 corners
        assert (ways - room.buffer(1e-3)).is_empty
        assert (ways - area.buffer(R + 1e-3, 64)).is_empty


def test_a_floor_out_of_reach_has_no_piece():
    """In a court 7 wide the tool of 8 does not fit, in the deeper pocket beside it does."""
    formula = Joined("|", part(0, 0, 50, 50, 20), part(60, 0, 7, 50, 10))
    upper, lower = floor_passes(terraces(formula, 20), R, R)
    assert upper.clearing.pieces == () and len(lower.clearing.pieces) == 1


def down(arc, up=1, first=50.0, above=2.0):
    return Descent(first, above, arc, up, 100)


def test_the_tool_comes_down_on_a_quarter_circle_of_zx():
    """A ring begun at x0 on the floor -20: from (x0 - 1.5, -18.5) about (x0, -18.5)."""
    (floor,) = floor_passes(terraces(part(0, 0, 80, 60), 20), R, R)
    path = traced(finish_floor("floor", floor.clearing, -20, down(1.5), 300), (0, 0, 60), R)
    (k,) = [i for i, row in enumerate(path) if row.label == "floor, approach"]
    arc = path[k]
    x0, y0, _ = arc.end
    assert arc.kind == Kind.ARC and arc.feed == 100 and tuple(arc.axis) == (0, 1, 0)
    assert arc.start == pytest.approx((x0 - 1.5, y0, -18.5)) and arc.centre == pytest.approx((x0, y0, -18.5))
    assert arc.sweep == pytest.approx(-math.pi / 2)  # about +Y from -X down to -Z
    assert path[k - 1].end == pytest.approx(arc.start) and path[k - 1].feed == 100
    assert path[k + 1].start == pytest.approx((x0, y0, -20)) and path[k + 1].feed == 300
    assert [row.end[2] for row in path[:3]] == [50, 50, 2]


def test_without_room_along_x_the_way_is_straight():
    """0.5 mm wide for the centre: along Y there is no arc of 1.5, along X there is."""
    (floor,) = floor_passes(terraces(part(0, 0, 8.5, 60), 20), R, R)
    path = traced(finish_floor("floor", floor.clearing, -20, down(1.5), 300), (0, 0, 60), R)
    assert not any(row.label.endswith("approach") for row in path)
    assert path[3].start[2] == 2 and path[3].end[2] == -20 and path[3].feed == 100
    (flat,) = floor_passes(terraces(part(0, 0, 60, 8.5), 20), R, R)
    (row,) = [each for each in traced(finish_floor("", flat.clearing, 0, down(1.5), 9), (0, 0, 9), R) if "approach" in each.label]
    assert abs(row.end[0] - row.start[0]) == pytest.approx(1.5) and row.start[2] == pytest.approx(1.5)


def test_working_upwards_the_arc_comes_from_below():
    (floor,) = floor_passes(terraces(part(0, 0, 80, 60), 20), R, R)
    path = traced(finish_floor("floor", floor.clearing, 20, down(1.5, up=-1), 300), (0, 0, 60), R)
    (arc,) = [row for row in path if row.label == "floor, approach"]
    assert arc.start[2] == pytest.approx(18.5) and arc.end[2] == 20 and arc.sweep == pytest.approx(math.pi / 2)


def test_every_pass_runs_on_the_level():
    (floor,) = floor_passes(terraces(part(0, 0, 80, 60), 20), R, R)
    path = traced(finish_floor("floor", floor.clearing, -20, down(0), 300), (0, 0, 60), R)
    rings = path[np.array(["ring" in row.label for row in path])]
    assert set(rings.end[:, 2]) == {-20} and set(rings.feed) == {300}
