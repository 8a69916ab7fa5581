"""Trochoidal slots, judged by shapely and by numbers worked out here: inside the slot, engagement, coverage, sense."""

import numpy as np
import pytest
import shapely
from tools.chance import seeds

from mnclab.geometry.contours import Contour
from mnclab.machining.depths import TooMany
from mnclab.machining.milling.trochoids import circle_count, trochoid, walls

STRAIGHT = Contour([(0, 0), (40, 0)], closed=False)
CIRCLE = Contour.circle((0, 0), 20)


def swept(way, radius):
    """What a disc sweeps along a contour, chord by chord: GEOS is not to be trusted with long lines of short chords."""
    spots = way.points_within(1e-3) if isinstance(way, Contour) else way
    chords = shapely.linestrings(np.stack([spots[:-1], spots[1:]], axis=1))
    return shapely.union_all(shapely.buffer(chords, radius, quad_segs=100))


def random_line(seed):
    """A line of lines and arcs that goes on smoothly, or with corners; open, or closed."""
    rng = np.random.default_rng(seed)
    count, closed = int(rng.integers(2, 6)), bool(rng.random() < 0.3)
    if closed:
        angle = 2 * np.pi * (np.arange(count + 2) + rng.uniform(-0.3, 0.3, count + 2)) / (count + 2)
        points = rng.uniform(12, 30, (count + 2, 1)) * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        return Contour(points, np.where(rng.random(count + 2) < 0.5, rng.uniform(-0.6, 0.6, count + 2), 0.0))
    if rng.random() < 0.5:
        points = np.cumsum(rng.uniform(-20, 20, (count + 1, 2)), axis=0)
        return Contour(points, np.where(rng.random(count + 1) < 0.5, rng.uniform(-1, 1, count + 1), 0.0), closed=False)
    place, way, points, bulge = np.zeros(2), rng.uniform(0, 6), [np.zeros(2)], []
    for _ in range(count):
        turn = rng.uniform(-2.5, 2.5) if rng.random() < 0.6 else 0.0
        size = rng.uniform(2, 25)
        place = place + size * np.array([np.cos(way + turn / 2), np.sin(way + turn / 2)])
        points, bulge, way = [*points, place], [*bulge, np.tan(turn / 4)], way + turn
    return Contour(points, [*bulge, 0.0], closed=False)


def full_circles(contour):
    """Where a way ends that is a full circle in halves: the index of the point, and its centre."""
    sweeps, centres = np.abs(contour.sweeps), contour.centres
    half = np.isclose(sweeps, np.pi, atol=1e-9)
    pair = half[:-1] & half[1:] & (np.abs(centres[:-1] - centres[1:]).max(axis=1) < 1e-6)
    return np.flatnonzero(pair) + 2, centres[:-1][pair]


@pytest.mark.parametrize("seed", seeds(30, deep=220))
def test_random_lines(seed):
    rng = np.random.default_rng(1000 + seed)
    line, radius = random_line(seed), rng.uniform(2, 6)
    width, climb = radius * rng.uniform(2.1, 4), bool(rng.random() < 0.5)
    reach, step = width / 2 - radius, radius * rng.uniform(0.1, 0.9)
    spiral, circles = trochoid(line, width, radius, step, climb=climb).passes
    # never outside: the tool centre keeps w/2 - R from the line
    spots = np.vstack([way.points_within(1e-3) for way in (spiral, circles)])
    assert line.distance(spots).max() <= reach + 1e-6
    # engagement: no farther than a step from the discs that were cleared before
    ends, centres = full_circles(circles)
    upto = np.append(0.0, np.cumsum(circles.lengths))
    ways = np.arange(upto[ends[0]], upto[-1], step / 7)
    away = np.hypot(*(circles.point_at(ways)[0][:, None] - centres).transpose(2, 0, 1)) - reach
    before = upto[ends] <= ways[:, None] + 1e-9
    assert np.where(before, away, np.inf).min(axis=1).max() <= step + 1e-6
    # and so on the spiral before them, half circle by half circle
    for k in range(len(spiral.points) - 1):
        half = Contour(spiral.points[k : k + 2], [spiral.bulge[k], 0], closed=False)
        cleared = Contour(spiral.points[: max(k, 1) + 1], [*spiral.bulge[:k], 0.0] if k else [0, 0], closed=False)
        spots = half.points_within(1e-3)
        off = cleared.distance(spots) if k else np.hypot(*(spots - spiral.points[0]).T)
        assert off.max() <= step + 1e-6
    # one sense, and but for corners of the line on the inner side nothing turns sharply
    half = np.abs(np.abs(circles.sweeps) - np.pi) < 1e-9
    assert (np.sign(circles.sweeps[half]) == (1 if climb else -1)).all()
    assert np.allclose(spiral.points[-1], circles.points[0])
    if line.radii.min() > reach and (np.abs(line.turns()) < 1e-6).all():
        assert np.abs(circles.turns()).max() < 1e-6


@pytest.mark.parametrize("seed", range(0, 220, 6))
@pytest.mark.deep
def test_random_lines_are_cleared(seed):
    """Roughing leaves only cusps beside the circles, and the walls take them away."""
    rng = np.random.default_rng(1000 + seed)
    line, radius = random_line(seed), rng.uniform(2, 6)
    width, climb = radius * rng.uniform(2.1, 4), bool(rng.random() < 0.5)
    step = radius * rng.uniform(0.1, 0.9)
    slot = swept(line, width / 2)
    passes = trochoid(line, width, radius, step, climb=climb).passes
    rough = shapely.union_all([swept(way, radius) for way in passes])
    assert rough.difference(slot.buffer(2e-3)).area < 1e-3
    cusp = width / 2 - np.sqrt((width / 2) ** 2 - (step / 2) ** 2)
    rest = slot.difference(rough)
    assert rest.difference(slot.boundary.buffer(cusp + 2e-3)).area < 1e-3, rest.area
    ways = [way for wall in walls(line, width, radius, climb=climb) for way in (wall.contour, *wall.arcs)]
    closed = [Contour([*way.points, way.points[0]], [*way.bulge, 0], closed=False) if way.closed else way for way in ways]
    finish = shapely.union_all([rough, *(swept(way, radius) for way in closed)])
    assert finish.intersection(slot).area >= 0.999 * slot.area
    assert finish.difference(slot.buffer(2e-3)).area < 1e-3


def test_numbers_of_a_straight_slot():
    """40 / 2 = 20 steps: 21 circles of 16 / 2 - 5 = 3, on the right of the line where they turn left."""
    spiral, circles = trochoid(STRAIGHT, 16, 5, 2).passes
    ends, centres = full_circles(circles)
    assert centres == pytest.approx(np.stack([np.arange(0, 41, 2), np.zeros(21)], axis=1))
    assert circles.length == pytest.approx(21 * 2 * np.pi * 3 + 40)
    assert circles.points[[0, -1]] == pytest.approx(np.array([(0, -3), (40, -3)]))
    assert len(spiral.points) - 1 == 3 and circle_count(STRAIGHT, 16, 2) == 21
    mirrored = trochoid(STRAIGHT, 16, 5, 2, climb=False).passes[1]
    assert mirrored.points == pytest.approx(circles.points * (1, -1))


def test_a_bend_counts_at_its_outer_wall():
    """A quarter circle of 20 in a slot of 16: its outer wall is 28 · pi / 2 long, so 22 steps of 2 and one that is left."""
    bend = Contour([(20, 0), (0, 20)], [np.tan(np.pi / 8), 0], closed=False)
    assert circle_count(bend, 16, 2) == 23
    _, centres = full_circles(trochoid(bend, 16, 5, 2).passes[1])
    turned = np.arctan2(centres[:, 1], centres[:, 0])
    assert np.diff(turned)[:-1] == pytest.approx(2 / 28) and np.hypot(*centres.T) == pytest.approx(20)


def test_a_closed_line_ends_where_it_began():
    _, circles = trochoid(CIRCLE, 16, 5, 2).passes
    ends, centres = full_circles(circles)
    assert len(centres) == int(np.ceil(28 * 2 * np.pi / 2)) and circles.points[-1] == pytest.approx(circles.points[0])


def test_walls_of_straight_and_round_slots():
    """3 beside the line, with half circles; of a circle of 20 those of 23 and 17. They begin on the side that is climbed."""
    (wall,) = walls(STRAIGHT, 16, 5)
    assert wall.contour.length == pytest.approx(80 + 6 * np.pi) and wall.contour.area > 0
    assert wall.contour.points[0] == pytest.approx((0, -3)) and wall.place == pytest.approx((0, 0))
    assert [abs(way.sweeps[0]) for way in wall.arcs] == pytest.approx([np.pi, np.pi])
    assert wall.arcs[0].points[0] == pytest.approx(wall.place) and wall.arcs[1].points[-1] == pytest.approx(wall.place)
    (up_cut,) = walls(STRAIGHT, 16, 5, climb=False)
    assert up_cut.contour.area < 0 and up_cut.contour.points[0] == pytest.approx((0, 3))
    outer, inner = walls(CIRCLE, 16, 5)
    assert [outer.contour.area, inner.contour.area] == pytest.approx([23**2 * np.pi, -(17**2) * np.pi])
    assert outer.place == pytest.approx((20, 0)) and inner.place == pytest.approx((20, 0))


def test_a_wall_that_begins_outside_has_no_round_end_there():
    (wall,) = walls(STRAIGHT, 16, 5, begins_outside=True)
    assert wall.contour.length == pytest.approx(80 + 3 * np.pi) and not wall.contour.closed and not wall.arcs
    assert wall.contour.points[[0, -1]] == pytest.approx(np.array([(0, -3), (0, 3)]))


def test_a_slot_as_wide_as_the_tool_is_its_line():
    assert trochoid(STRAIGHT, 10, 5, 2).passes == (STRAIGHT,) and not walls(STRAIGHT, 10, 5)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ((9, 5, 2), "a tool of radius 5 does not fit into a slot 9 wide"),
        ((21, 5, 2), "a slot 21 wide is wider than twice a tool of radius 5"),
        ((16, 5, 0), "the step of a trochoid must be greater than 0, got 0"),
        ((16, 0, 2), "the tool radius must be greater than 0, got 0"),
    ],
)
def test_what_cannot_be(given, said):
    with pytest.raises(ValueError, match=said):
        trochoid(STRAIGHT, *given)


def test_too_many_circles():
    with pytest.raises(TooMany, match="a step of 0.001 divides the slot into more than 20000 circles"):
        trochoid(STRAIGHT, 16, 5, 0.001)
