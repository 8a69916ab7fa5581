"""Fine roughing against closed forms, and on random areas against shapely: what is left, what covers it, and whence."""

import numpy as np
import pytest
import shapely
from tools.random_regions import random_task

from mnclab.geometry.contours import Contour, polygon, rectangle
from mnclab.geometry.regions import Region
from mnclab.machining.milling.clearing import begin, end
from mnclab.machining.milling.entries import Entry, descent
from mnclab.machining.milling.rest import left_between, rest_passes, touching

BOX = Region.of(rectangle(100, 60))
CORNER = 1 - np.pi / 4  # of a square about a disc's quarter, in radii squared
DUMBBELL_REST = 20 * 9.39522 - 2 * (225 * np.arcsin(2 / 3) - 10 * np.sqrt(125))  # the neck less two pieces of a disc


def dumbbell():
    """The pocket of a control's manual (TNC 620, 8.13): discs of 30 and 20, 55 apart at 60°, a neck of 20 between them."""
    along, across = np.array([0.5, np.sqrt(0.75)]), np.array([-np.sqrt(0.75), 0.5])
    one, a, b = np.array([30.0, 30.0]), np.sqrt(800), 55 - np.sqrt(300)
    points = [one + a * along - 10 * across, one + b * along - 10 * across]
    points += [one + b * along + 10 * across, one + a * along + 10 * across]
    sweeps = [0, 2 * np.pi - 2 * np.arcsin(0.5), 0, 2 * np.pi - 2 * np.arcsin(1 / 3)]
    return Region.of(Contour(points, np.tan(np.array(sweeps) / 4)))


def swept(contours, radius):
    lines = [shapely.LineString(contour.points_within(1e-4)) for contour in contours]
    return shapely.union_all(shapely.buffer(lines, radius, quad_segs=64))


def area_of(region):
    parts = []
    for part in region.parts:
        wall, *holes = (shapely.make_valid(shapely.Polygon(loop.points_within(1e-4))) for loop in part.loops)
        parts.append(wall - shapely.union_all(holes))
    return shapely.union_all(parts)


def links(piece):
    return [Contour([end(a), begin(b)], closed=False) for a, b in zip(piece.passes, piece.passes[1:], strict=False)]


def test_the_neck_of_the_manual():
    """Tool of 15, then of 7.5: one piece in the neck, which is then clear, cut from the side without a plunge."""
    region = dumbbell()
    left = left_between(region, 7.5, 15)
    assert len(left.parts) == 1 and left.area == pytest.approx(DUMBBELL_REST, abs=1e-3)
    found = rest_passes(region, 7.5, 7.5, 15)
    (piece,) = found.pieces
    assert piece.from_side and all(not contour.closed for contour in piece.passes)
    assert area_of(left).difference(swept(found.passes, 7.5 + 1e-3)).area < 1e-3


@pytest.mark.parametrize(("coarse", "allowance"), [(10, 0), (12, 0.5), (15, 1)])
def test_four_corners(coarse, allowance):
    """In every corner (1 - π/4)·(R_c² - R²) is left; at the walls the allowance."""
    assert left_between(BOX, 5, coarse, allowance).area == pytest.approx(4 * CORNER * (coarse**2 - 25))
    apart = rest_passes(BOX, 5, 4, coarse, allowance=allowance, connect=False)
    assert len(apart.pieces) == 4 and all(piece.from_side for piece in apart.pieces)
    assert all(piece.linked == (True,) * (len(piece.passes) - 1) for piece in apart.pieces)
    reach = np.array([50, 30]) - 5 - allowance
    assert np.abs(np.vstack([contour.points for contour in apart.passes])).max(axis=0) == pytest.approx(reach)


def test_from_corner_to_corner_at_depth():
    joined, apart = (rest_passes(BOX, 5, 4, 12, connect=connect) for connect in (True, False))
    assert len(joined.pieces) == 1 and len(apart.pieces) == 4
    ways = [*links(joined.pieces[0]), *(c for c, name in zip(joined.passes, joined.labels, strict=True) if "way" in name)]
    (left,) = [area_of(left_between(BOX, 5, 12))]
    for contour in apart.passes:
        assert any(np.array_equal(contour.points, other.points) for other in joined.passes)
    assert swept(ways, 4.9).intersection(left.difference(swept(apart.passes, 5))).area < 1e-3
    assert all(BOX.inset(5).holds(begin(way), end(way)) for way in links(joined.pieces[0]))


def test_where_the_coarse_tool_does_not_fit_everything_is_left():
    """All is left, all rings are whole, and the first one must be plunged into."""
    left = left_between(BOX, 5, 31)
    assert left.area == pytest.approx(6000 - 4 * CORNER * 25)
    found = rest_passes(BOX, 5, 5, 31)
    (piece,) = found.pieces
    assert not piece.from_side and all(contour.closed for contour in piece.passes) and len(piece.passes) == 5
    entry = descent(piece, Entry("ramp", 5), 5, 0, -1)
    assert entry.label != "entry"


def test_a_blind_arm_is_entered_from_the_side():
    """An arm 16 wide and 40 long beside a disc of 30: the coarse tool stays out; the rings at its end are reached through it."""
    region = Region.of(Contour.circle((0, 0), 30), Contour([(20, -8), (70, -8), (70, 8), (20, 8)]))
    found = rest_passes(region, 3, 2.5, 10)
    assert all(piece.from_side for piece in found.pieces)
    left = area_of(left_between(region, 3, 10))
    assert left.difference(swept(found.passes, 3 + 1e-3)).area < 1e-3
    piece = found.pieces[0]
    assert not left.buffer(-1e-6).intersects(shapely.Point(*piece.entry).buffer(2.95))
    assert descent(piece, Entry("helix", 5), 3, 0, -5).label == "entry"


def test_a_widening_behind_a_neck():
    """Behind a neck that the coarse tool does not pass whole rings are needed; a pass through the neck leads to them."""
    region = Region.of(
        Contour.circle((0, 0), 25), Contour.circle((50, 0), 20), Contour([(20, -5), (40, -5), (40, 5), (20, 5)])
    )
    found = rest_passes(region, 3, 3, 21)
    whole = [contour for contour in found.passes if contour.closed]
    assert whole and all(piece.from_side for piece in found.pieces)
    assert area_of(left_between(region, 3, 21)).difference(swept(found.passes, 3 + 1e-3)).area < 1e-3


def test_nothing_is_left():
    round_one = Region.of(Contour.circle((5, 5), 30))
    for region, coarse in ((round_one, 12), (BOX, 5), (BOX, 4)):
        assert left_between(region, 5, coarse).area == pytest.approx(0, abs=1e-6)
        found = rest_passes(region, 5, 5, coarse)
        assert found.pieces == () and found.passes == () and found.length == 0


def test_what_is_thinner_than_asked_is_left():
    """In each corner of a polygon of n the coarse tool leaves (R_c - R)·(1/cos(π/n) - 1): of 60 corners it is 7.7e-3."""
    region = Region.of(polygon(60, 40))
    assert 5.6 * (1 / np.cos(np.pi / 60) - 1) == pytest.approx(7.7e-3, abs=1e-4)
    assert len(rest_passes(region, 4, 4, 9.6).passes) > 0
    assert rest_passes(region, 4, 4, 9.6, least=8e-3).passes == ()


def test_no_sensible_tool_is_refused():
    with pytest.raises(ValueError, match="does not fit"):
        rest_passes(BOX, 31, 5, 40)
    with pytest.raises(ValueError, match="stepover"):
        rest_passes(BOX, 5, 0, 10)
    with pytest.raises(ValueError, match="radius"):
        rest_passes(BOX, 0, 1, 10)


@pytest.mark.parametrize(("climb", "sense"), [(True, 1), (False, -1)])
def test_sense_of_the_passes(climb, sense):
    """In climb milling every corner turns to the left on the way round the wall."""
    for piece in rest_passes(BOX, 5, 5, 12, climb=climb, connect=False).pieces:
        assert (piece.passes[-1].turns()[1:] * sense > 1).all()


def test_inside_corners_are_rounded():
    """The last pass goes round the corner on an arc of 2, and what the coarse tool left by its own arc is cut as well."""
    found = rest_passes(BOX, 5, 4, 12, corner_radius=2, connect=False)
    for piece in found.pieces:
        radii = piece.passes[-1].radii
        assert radii[np.isfinite(radii)] == pytest.approx(2)
    more = left_between(BOX, 5, 12, corner_radius=2).area - left_between(BOX, 5, 12).area
    assert more == pytest.approx(4 * CORNER * (14**2 - 12**2 - 7**2 + 5**2))


def test_stretches_that_touch():
    """A line 3 off the middle of a disc of 10 touches it with a tool of 5 over 2·sqrt(15² - 3²), on a step of R/32 more."""
    disc = Region.of(Contour.circle((0, 0), 10))
    line = Contour([(-50, 3), (50, 3)], closed=False)
    (found,) = touching(line, disc, 5)
    assert found.length == pytest.approx(2 * np.sqrt(216), abs=5 / 8)
    assert found.points[0, 0] == pytest.approx(-np.sqrt(216), abs=5 / 16)
    (longer,) = touching(line, disc, 5, overlap=2)
    assert longer.length == pytest.approx(found.length + 4)
    two = Region.of(Contour.circle((-20, 0), 3), Contour.circle((20, 0), 3))
    assert len(touching(line, two, 5)) == 2 and len(touching(line, two, 5, gap=30)) == 1
    assert touching(Contour.circle((0, 0), 12), disc, 5)[0].closed
    assert touching(Contour.circle((0, 0), 16), disc, 5) == () == touching(line, Region(), 5)


@pytest.mark.deep
@pytest.mark.parametrize("first", range(0, 200, 20))
def test_random_areas(first):
    """What both tools reach by shapely, 5 µm and more inside the truth, is no rest uncovered; nothing beyond the allowance."""
    for seed in range(first, first + 20, 4):
        task, random = random_task(seed), np.random.default_rng(seed)
        radius, allowance = task.radius, task.allowance
        coarse = radius * random.uniform(1.2, 3)
        region, wall = task.region, task.polygon(1e-3)
        if not region.inset(radius + allowance).loops:
            continue
        left = left_between(region, radius, coarse, allowance)
        found = rest_passes(region, radius, task.stepover, coarse, allowance=allowance, connect=bool(seed % 3))

        def reach(size, more, wall=wall, allowance=allowance):
            return wall.buffer(-(size + allowance + more), quad_segs=64).buffer(size, quad_segs=64)

        def is_left(spot, slack=0.0, task=task, radius=radius, coarse=coarse, allowance=allowance):
            reached = room(task, spot, radius) > radius + allowance - slack
            return reached and room(task, spot, coarse) < coarse + allowance + slack

        surely = reach(radius, 5e-3).difference(reach(coarse, -5e-3))
        perhaps = reach(radius, -5e-3).difference(reach(coarse, 5e-3))
        missing = surely.difference(area_of(left).buffer(1e-4)), surely.difference(swept(found.passes, radius + 1e-3))
        for area in missing:
            assert sum(piece.area for piece in pieces(area) if is_left(inside(piece))) < 1e-3, seed
        more = area_of(left).difference(perhaps.buffer(1e-4))
        assert sum(piece.area for piece in pieces(more) if not is_left(inside(piece), 5e-3)) < 1e-3, seed
        if found.pieces:
            _stays_inside(found, region, wall, allowance, seed)
            _cuts_only_the_rest(found, area_of(left), task.stepover, seed)


def pieces(area):
    """The polygons of an area that are more than noise."""
    return [piece for piece in shapely.get_parts(area) if piece.area > 1e-5]


def inside(piece):
    return np.array(piece.representative_point().coords[0])


def room(task, spot, size):
    """How far from the walls the centre of a tool of a `size` may stand that reaches a spot, by distances alone.

    Buffers of shapely simplify what they grow and shrink, and lose narrow places by that: this decides in their stead.
    """
    wall, random = task.polygon(1e-5), np.random.default_rng(1)
    centre, span, most = spot, size, -np.inf
    for _ in range(40):
        tried = centre + span * random.uniform(-1, 1, (400, 2))
        tried = tried[np.hypot(*(tried - spot).T) <= size]
        sense = np.where(shapely.contains_xy(wall, *tried.T), 1.0, -1.0)
        found = sense * shapely.distance(wall.boundary, shapely.points(tried))
        if len(found) and found.max() > most:
            most, centre = found.max(), tried[found.argmax()]
        span *= 0.8
    return most


def _stays_inside(found, region, wall, allowance, seed):
    """By shapely inside the area, and by the distance of lines and arcs at no place nearer to its walls than it may be."""
    for way in (*found.passes, *(way for piece in found.pieces for way in links(piece))):
        assert wall.contains(shapely.LineString(way.points_within(1e-4))), seed
        spots = way.point_at(np.linspace(0, way.length, 200))[0]
        assert region.distance(spots).min() > found.radius + allowance - 1e-6, seed


def _cuts_only_the_rest(found, left, stepover, seed):
    """Every pass stays near the rest; what is said to begin at the side does; ways between scrape off 1 % of R at most."""
    radius, whole = found.radius, left
    for piece in found.pieces:
        if piece.from_side:
            assert left.intersection(shapely.Point(*piece.entry).buffer(0.985 * radius)).area < 1e-3, seed
        for k, contour in enumerate(piece.passes):
            way = "way" in piece.labels[k]
            if k and way:
                before = contour.between(0, contour.length - 1.02 * stepover) if contour.length > 1.02 * stepover else None
                between = [before] if before is not None else []
            else:
                between = [step for step in links(piece)[k - 1 : k] if k and step.length > 1.02 * stepover]
                spots = contour.point_at(np.arange(0, contour.length, radius / 8))[0]
                assert shapely.distance(whole, shapely.points(spots)).max(initial=0) < 1.7 * radius, seed
            if between:
                assert swept(between, 0.98 * radius).intersection(left).area < 1e-3, seed
            left = left.difference(swept([contour], radius))
