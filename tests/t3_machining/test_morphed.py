"""The spiral between level curves of a membrane: closed forms for a disc and a ring; how far turns are apart, by shapely."""

import math

import numpy as np
import pytest
import shapely

import mnclab
from mnclab.geometry.sweeps import polygons
from mnclab.machining.milling.morphed import morphed_spiral

circle, rectangle, Region = mnclab.area.Contour.circle, mnclab.area.rectangle, mnclab.area.Region
ELL = Region.of(mnclab.area.Contour([(0, 0), (60, 0), (60, 25), (25, 25), (25, 60), (0, 60)]))
AREAS = {
    "square": Region.of(rectangle(60, 60)), "ell": ELL, "oblong": Region.of(rectangle(90, 40, 10, angle=0.3)),
    "island": Region.of(rectangle(70, 60), holes=[circle((3, -2), 10)]),
}  # fmt: skip


def way_of(clearing):
    passes = [way for way, label in zip(clearing.passes, clearing.labels, strict=True) if "spiral" in label]
    return np.vstack([way.points_within(1e-4) for way in passes])


def polar(points, centre):
    away = points - centre
    angle = np.unwrap(np.arctan2(away[:, 1], away[:, 0]))
    return np.hypot(*away.T), angle - angle[-1]


@pytest.mark.parametrize("climb", [True, False])
def test_in_a_disc_its_turns_are_even(climb):
    """Δu = -1 in a disc: u = (r_0² - r²) / 4, t = r / √2, so every turn grows by as much, at most the stepover."""
    clearing = morphed_spiral(Region.of(circle((5, 7), 23)), 3.0, 2.0, climb=climb)
    r, angle = polar(way_of(clearing), (5, 7))
    turned = np.sign(angle[-1] - angle[0])
    assert turned == (1 if climb else -1)
    inner = (r > 3) & (r < 17)
    slope, first = np.polyfit(angle[inner], r[inner], 1)
    assert abs(slope * 2 * math.pi * turned - (20 - 0.03) / 10) < 5e-3  # ten turns to 19.97 mm
    assert np.abs(np.polyval([slope, first], angle[inner]) - r[inner]).max() < 0.02


def test_in_a_ring_its_turns_are_circles_of_even_steps():
    """Δu = 0 in a ring: u is a logarithm of r, whose level curves are circles; each turn is at most a stepover wider."""
    clearing = morphed_spiral(Region.of(circle((5, 7), 33), holes=[circle((5, 7), 8)]), 3.0, 2.0)
    r, angle = polar(way_of(clearing), (5, 7))
    turns = np.arange(math.ceil(angle[0] / 2 / math.pi), 1)
    at = np.interp(turns * 2 * math.pi, angle, r)
    assert abs(r[0] - 11.03) < 2e-3 and abs(r[-1] - 29.97) < 4e-3
    assert np.diff(at).max() <= 2.0 and np.diff(at)[:-1].min() > 1.85  # ten turns to 18.94 mm
    assert clearing.labels == ("entry spiral", "spiral", "lead", "wall", "lead", "island")


@pytest.mark.parametrize("climb", [True, False])
@pytest.mark.parametrize("name", AREAS)
def test_turns_lie_a_stepover_apart_and_are_smooth(name, climb):
    region, radius, stepover = AREAS[name], 3.0, 2.4
    clearing = mnclab.strategies.clear("morphed spiral", region, radius, stepover, climb=climb)
    assert not clearing.note and not any("rest" in label for label in clearing.labels)
    (piece,) = clearing.pieces
    assert all(piece.linked)  # nowhere it lifts
    ways = shapely.union_all([shapely.LineString(way.points_within(1e-4)) for way in clearing.passes])
    assert shapely.covers(shapely.buffer(polygons(clearing.centres), 1e-3), ways)
    far = np.array([point for point in np.argwhere(np.ones((90, 90))) - 45.0])
    inner = shapely.buffer(polygons(clearing.centres), -stepover)  # corners apart
    spots = shapely.points(far[shapely.contains_xy(inner, *far.T)])
    assert len(spots) > 500 and shapely.distance(spots, ways).max() <= 0.55 * stepover
    spiral = clearing.passes[clearing.labels.index("spiral")]
    assert np.abs(spiral.turns()).max() < 1e-9 and spiral.radii.min() >= 0.3
    joints = [b.tangents()[0][0] @ a.tangents()[1][-1] for a, b in zip(clearing.passes[:-1], clearing.passes[1:], strict=True)]
    assert min(joints) > 1 - 1e-6


def test_an_area_without_such_a_spiral_is_cleared_as_adaptive_does_and_says_why():
    islands = Region.of(rectangle(80, 50), holes=[circle((-20, 0), 5), circle((20, 0), 5)])
    neck = Region.of(mnclab.area.Contour([(0, 0), (40, 0), (40, 16), (60, 16), (60, 0), (100, 0),
                                          (100, 40), (60, 40), (60, 24), (40, 24), (40, 40), (0, 40)]))  # fmt: skip
    for region, why in ((islands, "2 islands"), (neck, "several peaks")):
        clearing = mnclab.strategies.clear("morphed spiral", region, 3.0, 2.4)
        assert "adaptive" in clearing.note and why in clearing.note
        same = mnclab.strategies.clear("adaptive", region, 3.0, 2.4)
        assert clearing.labels == same.labels and abs(clearing.length - same.length) < 1e-9
    half = Region.of(rectangle(30, 40, centre=(20, 0)))
    clearing = mnclab.strategies.clear("morphed spiral", Region.of(rectangle(60, 40)), 3.0, 2.0, stock=half)
    assert "sides open" in clearing.note and clearing.pieces[0].from_side
    table = mnclab.compare(islands, 3.0, "morphed spiral", stepover=2.4)
    assert "morphed spiral: no spiral" in repr(table) and "2 islands" in table._repr_html_()


@pytest.mark.parametrize("width", [6.05, 6.2, 6.5, 7.0])
@pytest.mark.parametrize("length", [8, 60, 900])
def test_narrow_slots_at_any_angle_are_cleared(width, length):
    for angle in (0.0, 0.3, math.pi / 4):
        clearing = mnclab.strategies.clear("morphed spiral", Region.of(rectangle(length, width, angle=angle)), 3.0, 0.6)
        ways = shapely.union_all([shapely.LineString(way.points_within(1e-4)) for way in clearing.passes])
        reach = shapely.buffer(polygons(clearing.centres), 3.0, quad_segs=64)
        assert reach.difference(shapely.buffer(ways, 3.0, quad_segs=64)).area < 1e-4 * reach.area
