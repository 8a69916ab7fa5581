"""Rounded rings and rounded zigzag: lengths by hand, tangents, radii, walls; coverage and walls judged by shapely."""

from itertools import product

import numpy as np
import pytest
import shapely
from tools.chance import seeds
from tools.random_regions import random_task
from tools.together import deep_but_one_in

from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.regions import Region
from mnclab.machining.milling.clearing import begin, end
from mnclab.machining.milling.rounded import rounded_rings, rounded_zigzag
from mnclab.machining.milling.strategies import clear
from mnclab.machining.milling.tangent import SENSES, SPOTS, _spots, shortest, way_of

NAMES = ["rounded rings", "rounded zigzag"]
SQUARE = Region.of(rectangle(60, 60))
AREAS = {
    "square": SQUARE,
    "L": Region.of(Contour([(0, 0), (60, 0), (60, 25), (25, 25), (25, 60), (0, 60)])),
    "triangle": Region.of(Contour([(0, 0), (80, 0), (30, 50)])),
    "circle": Region.of(Contour.circle((5, 3), 27)),
    "island": Region.of(rectangle(60, 60), holes=[Contour.circle((0, 0), 8)]),
    "neck": Region.of(Contour([(0, 0), (30, 0), (30, 15), (45, 15), (45, 0), (75, 0), (75, 40), (45, 40), (45, 26), (30, 26),
                               (30, 40), (0, 40)])),
}  # fmt: skip


def angles(a, b):
    """From directions a to b `(n, 2)`."""
    return np.abs(np.arctan2(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0], (a * b).sum(axis=1)))


def tangents(contour):
    """Directions at the begin and the end of a pass, from its first and its last element."""
    begins, ends = contour.tangents()
    return begins[0], ends[-1]


def is_wall(label, contour, centres):
    """Whether a pass runs along the boundary of the tool-centre area."""
    return contour.closed and centres.distance(contour.point_at(np.linspace(0, contour.length, 40))[0]).max() < 1e-6


def judge(clearing, centres, smallest):
    """Tangent, no sharper than `smallest`, and nowhere outside, but for the corners of the passes along the walls."""
    for piece in clearing.pieces:
        if piece.labels[0].startswith("slot"):
            continue
        for contour, label in zip(piece.passes, piece.labels, strict=True):
            spots = contour.points_within(1e-3)
            spots = np.vstack([spots, contour.point_at(np.linspace(0, contour.length, 200))[0]])
            outside = spots[~centres.contains(spots)]
            assert not len(outside) or centres.distance(outside).max() <= 1e-9, label
            if not is_wall(label, contour, centres) and not label.startswith("rest"):
                assert np.abs(contour.turns()).max() < 1e-6, label
                some = contour.lengths > 1e-6  # what is shorter than a nanometre or so has no radius to speak of
                assert contour.radii[some].min() >= smallest - 1e-9, label
        for k, linked in enumerate(piece.linked):
            if linked:
                a, b = piece.passes[k : k + 2]
                assert np.hypot(*(begin(b) - end(a))) < 1e-9
                assert angles(tangents(a)[1][None], tangents(b)[0][None])[0] < 1e-6, piece.labels[k + 1]


def uncovered(clearing, polygon, radius, allowance):
    """The share of what the tool reaches that is left standing."""
    room = polygon.buffer(-(radius + allowance), quad_segs=200)
    reach = room.buffer(radius * (1 - 1e-4), quad_segs=200)
    ways = [shapely.LineString(contour.points_within(2e-4)) for contour in clearing.passes]
    swept = shapely.union_all(shapely.buffer(ways, radius, quad_segs=200))
    return reach.difference(swept).area / reach.area


def polygon_of(region):
    pieces = [[loop.points_within(1e-4) for loop in part.loops] for part in region.parts]
    return shapely.union_all([shapely.Polygon(outer, holes) for outer, *holes in pieces])


@pytest.mark.parametrize("smallest", [0.3, 1.0])
def test_rings_of_a_square(smallest):
    """Sides of 54 - 2·2.4·k, less 2 rho each; their corners are four quarters of a circle: 2·pi·rho. The wall has its corners."""
    clearing = rounded_rings(SQUARE, 3, 2.4, smallest=smallest)
    rings = [c for c, name in zip(clearing.passes, clearing.labels, strict=True) if name.startswith("ring")]
    sides = [54 - 4.8 * k for k in range(12)]
    sides = sides[: 1 + sum(side > 2 * smallest for side in sides[1:])]
    by_hand = [4 * (side - 2 * smallest) + 2 * np.pi * smallest for side in sides[:0:-1]]
    assert [ring.length for ring in rings] == pytest.approx([*by_hand, 4 * 54], abs=1e-9)
    for ring in rings[:-1]:
        arcs = np.isfinite(ring.radii)
        assert arcs.sum() == 4 and ring.radii[arcs] == pytest.approx(smallest, abs=1e-9)
    assert all(all(piece.linked) for piece in clearing.pieces)


def test_a_tenth_of_the_tool_radius_is_the_smallest():
    rings = rounded_rings(SQUARE, 5, 4).passes
    assert min(c.radii.min() for c in rings) == pytest.approx(0.5, abs=1e-9)
    for wrong in (0, -1, float("nan")):
        with pytest.raises(ValueError, match="the smallest radius of the path must be greater than 0"):
            rounded_rings(SQUARE, 5, 4, smallest=wrong)


def test_lines_of_a_square():
    """C of 54 inset by min(2.4, 3 - 1.2) = 1.8 is 50.4: 21 lines of 50.4, 2.4 apart, and half circles of 1.2 between them."""
    clearing = rounded_zigzag(SQUARE, 3, 2.4)
    named = list(zip(clearing.passes, clearing.labels, strict=True))
    lines, turns = ([c for c, name in named if name.startswith(kind)] for kind in ("line", "turn"))
    assert len(lines) == 21 and len(turns) == 20
    assert [line.length for line in lines[:-1]] == pytest.approx([50.4] * 20)
    assert [turn.length for turn in turns] == pytest.approx([np.pi * 1.2] * 20)
    assert all(turn.radii == pytest.approx(1.2) for turn in turns)
    assert clearing.passes[-1].length == pytest.approx(216) and all(clearing.pieces[0].linked)


@pytest.mark.parametrize("seed", range(20))
def test_shortest_ways(seed):
    """They arrive where they should, and none is shorter than the straight way; the shortest is no longer than that of a
    circle less in radius."""
    rng = np.random.default_rng(seed)
    start, end_ = rng.uniform(-5, 5, (2, 50, 2))
    a, b = rng.uniform(-np.pi, np.pi, (2, 50))
    size = rng.uniform(0.3, 3, 50)
    spans = shortest(start, a, end_, b, size)
    lengths = spans.sum(axis=2) * size[:, None]
    assert np.isfinite(lengths[:, [0, 3]]).all() and (spans[np.isfinite(spans)] >= 0).all()
    assert (np.nanmin(lengths, axis=1) >= np.hypot(*(end_ - start).T) - 1e-9).all()
    smaller = np.nanmin(shortest(start, a, end_, b, size * 0.9).sum(axis=2), axis=1) * size * 0.9
    assert (smaller <= np.nanmin(lengths, axis=1) + 1e-9).all()
    for n, j in zip(*np.nonzero(np.isfinite(lengths)), strict=True):
        way = way_of(start[n], a[n], end_[n], SENSES[j], spans[n, j], size[n])
        begins, ends = way.tangents()
        want = np.array([(np.cos(a[n]), np.sin(a[n])), (np.cos(b[n]), np.sin(b[n]))])
        assert angles(np.stack([begins[0], ends[-1]]), want).max() < 1e-5
        assert np.abs(way.turns()).max() < 1e-5 and way.length == pytest.approx(lengths[n, j], abs=1e-5)


def test_places_on_ways_are_those_of_their_contours():
    """Worked out for all ways at once, and by the contour of each."""
    rng = np.random.default_rng(1)
    start, end_ = rng.uniform(-5, 5, (2, 60, 2))
    a, b = rng.uniform(-np.pi, np.pi, (2, 60))
    size = rng.uniform(0.3, 3, 60)
    spans = shortest(start, a, end_, b, size)
    n, j = np.nonzero(np.isfinite(spans).all(axis=2))
    places = _spots(start[n], a[n], SENSES[j], spans[n, j], size[n]).reshape(-1, SPOTS, 2)
    for k, found in enumerate(places):
        way = way_of(start[n[k]], a[n[k]], end_[n[k]], SENSES[j[k]], spans[n[k], j[k]], size[n[k]])
        assert found == pytest.approx(way.point_at(np.linspace(0, way.length, SPOTS))[0], abs=1e-6)


def test_a_shortest_way_by_hand():
    """From (0, 0) to (10, 0) and back in the opposite direction, 4 beside: straight on and half a circle of 2."""
    spans = shortest(np.zeros((1, 2)), np.zeros(1), np.array([[10.0, 4.0]]), np.array([np.pi]), np.array([2.0]))
    assert np.nanmin(spans.sum(axis=2)) * 2 == pytest.approx(10 + 2 * np.pi)


@pytest.mark.parametrize("name, area, climb, stepover", deep_but_one_in(3, product(NAMES, AREAS, [True, False], [0.8, 2.4])))
def test_known_areas(name, area, climb, stepover):
    region = AREAS[area]
    clearing = clear(name, region, 3.0, stepover, climb=climb)
    judge(clearing, region.inset(3.0), 0.3)
    assert uncovered(clearing, polygon_of(region), 3.0, 0) < 1e-4


@pytest.mark.parametrize("name, area, climb, stepover", deep_but_one_in(17, product(NAMES, AREAS, [True, False], [0.8, 2.4])))
def test_twice_the_same(name, area, climb, stepover):
    one, other = (clear(name, AREAS[area], 3.0, stepover, climb=climb) for _ in "ab")
    assert one.labels == other.labels and all((a.points == b.points).all() for a, b in zip(one.passes, other.passes, strict=True))


WIDE = deep_but_one_in(5, product(["square", "triangle", "island"], [3.2, 4.5, 5.7], NAMES))


@pytest.mark.parametrize("area, stepover, name", WIDE)
def test_what_stands_after_wide_steps_is_cleared_as_well(name, area, stepover):
    """A stepover above the tool radius leaves cores and corners; a pass goes through each, and the tool lifts before it."""
    clearing = clear(name, AREAS[area], 3.0, stepover)
    judge(clearing, AREAS[area].inset(3.0), 0.3)
    assert uncovered(clearing, polygon_of(AREAS[area]), 3.0, 0) < 1e-4
    for piece in clearing.pieces:
        rests = [k for k, label in enumerate(piece.labels) if k and label.startswith("rest")]
        assert not any(piece.linked[k - 1] for k in rests)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("seed", seeds(5, deep=120))
def test_random_areas(name, seed):
    task = random_task(seed)
    region = task.region
    centres = region.inset(task.radius + task.allowance)
    try:
        clearing = clear(name, region, task.radius, task.stepover, allowance=task.allowance, climb=seed % 2 == 0)
    except ValueError as error:
        assert "does not fit" in str(error) or "exactly as wide" in str(error)
        assert not centres.loops
        return
    judge(clearing, centres, 0.1 * task.radius)
    for stroke in [c for c, label in zip(clearing.passes, clearing.labels, strict=True) if label.startswith("slot")]:
        room = region.distance(stroke.points_within(1e-3)) - task.radius - task.allowance
        assert -1.1e-5 < room.min() and room.max() < 1e-4
    if not centres.loops:
        return
    reach = polygon_of(centres)
    ways = [shapely.LineString(contour.points_within(2e-4)) for contour in clearing.passes]
    swept = shapely.union_all(shapely.buffer(ways, task.radius, quad_segs=200))
    whole = reach.buffer(task.radius * (1 - 1e-4), quad_segs=200)
    assert whole.difference(swept).area < 1e-4 * whole.area
