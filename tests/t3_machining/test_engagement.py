"""Engagement against closed forms to one degree, and removal against the area that shapely finds."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.regions import Region
from mnclab.machining.milling.engagement import engagement
from mnclab.machining.milling.rings import rings

pytestmark = pytest.mark.deep

R = 5.0


def line(y, x0=0.0, x1=40.0):
    return Contour([(x0, y), (x1, y)], closed=False)


def degrees(moves, **more):
    """The angles along the second quarter of the last contour: a round one meets its own start later on."""
    found = engagement(moves, R, **more)
    last = np.degrees(found.angle[found.move == len(moves) - 1])
    return last[len(last) // 4 : len(last) // 2]


def test_a_slot():
    assert degrees([line(0)]) == pytest.approx(180, abs=0.1)


@pytest.mark.parametrize("width", [0.1, 0.5, 1, 2.5, 5, 7.5, 9, 9.9])
def test_a_straight_side_cut(width):
    """A width of cut a engages arccos(1 - a/R)."""
    found = engagement([line(0, -20, 60), line(width)], R)
    middle = found.chosen((found.move == 1) & (np.abs(found.points[:, 0] - 20) < 10))
    assert np.degrees(middle.angle) == pytest.approx(np.degrees(np.arccos(1 - width / R)), abs=1)
    assert middle.width == pytest.approx(width, abs=0.01)


@given(st.floats(6, 40), st.floats(0.3, 8))
def test_inside_a_round_hole(hole, more):
    """Hole of radius B, tool centre on a circle ρ = B - R + a: arccos((B² - ρ² - R²) / (2·ρ·R))."""
    way = hole - R + more
    cosine = (hole**2 - way**2 - R**2) / (2 * way * R)
    found = degrees([Contour.circle((0, 0), hole - R), Contour.circle((0, 0), way)])
    assert found == pytest.approx(np.degrees(np.arccos(max(cosine, -1))), abs=1)


@given(st.floats(15, 50), st.floats(0.3, 8))
def test_round_a_stud(stud, less):
    """Material up to the radius C, tool centre on ρ = C + R - a, clockwise: 180° less the same arccos."""
    way = stud + R - less
    cosine = (stud**2 - way**2 - R**2) / (2 * way * R)
    rounds = [Contour.circle((0, 0), stud + R, clockwise=True), Contour.circle((0, 0), way, clockwise=True)]
    assert degrees(rounds) == pytest.approx(180 - np.degrees(np.arccos(max(cosine, -1))), abs=1)


def test_nothing_is_cut_twice():
    assert degrees([line(0), line(0)]) == pytest.approx(0, abs=1e-9)
    assert degrees([line(0), line(0).reversed()]) == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize("width", [0.5, 2.5, 5, 8])
def test_along_the_edge_of_a_stock(width):
    stock = Region.of(rectangle(200, 60, centre=(0, width - 30)))
    found = degrees([line(R, -40, 40)], stock=stock)
    assert found == pytest.approx(np.degrees(np.arccos(1 - width / R)), abs=1)


@pytest.mark.parametrize("step", [1.0, 4.0, 7.0])
def test_what_is_removed_is_what_is_covered(step):
    """The sum of width times way, and the disc of the plunge, is the swept area, whatever the way."""
    rng = np.random.default_rng(7)
    points = np.cumsum(rng.uniform(-step * 4, step * 4, (12, 2)), axis=0)
    moves = [Contour(points, np.append(rng.uniform(-0.4, 0.4, 11), 0), closed=False)]
    found = engagement(moves, R)
    swept = shapely.LineString(moves[0].points_within(1e-3)).buffer(R, quad_segs=64).area
    assert (found.width * found.step).sum() + np.pi * R**2 == pytest.approx(swept, rel=0.01)


def test_percentiles_are_shares_of_the_way():
    """A slot of 80 (180°) and beside it a cut of 5 (90°) over 40: two thirds are slot; corners and ends have no way."""
    found = engagement([line(0, -20, 60), line(5)], R)
    shares = [np.degrees(found.percentile(share)) for share in (0.2, 0.32, 0.36, 1)]
    assert shares == pytest.approx([90, 90, 180, 180], abs=1e-3)
    assert found.chosen(found.move > 1).percentile(0.95) == 0
    lone = found._replace(step=np.where(found.angle > 2, 0.0, found.step))
    assert np.degrees(lone.percentile(0.999)) == pytest.approx(90, abs=1e-3)


def test_measures():
    found = engagement([line(0, -20, 60), line(5)], R)
    second = found.chosen(found.move == 1)
    assert np.degrees(second.mean()) == pytest.approx(90, abs=2)
    assert second.share_above(np.radians(100)) == pytest.approx(0, abs=0.05)
    assert found.share_above(np.radians(100)) == pytest.approx(80 / 120, abs=0.02)
    with pytest.raises(ValueError, match="radius"):
        engagement([line(0)], 0.0)


# --- the greatest value ------------------------------------------------------------------------------------------------

STATED = 0.3  # degrees: the accuracy that the module states


def ring(a, b, first=0, turned=0.0, parts=1):
    """A rectangle 2a x 2b counter-clockwise from its `first` corner on, each side in `parts`, turned about its middle."""
    corners = np.roll(np.array([(-a, -b), (a, -b), (a, b), (-a, b)], dtype=float), -first, axis=0)
    share = np.arange(parts)[:, None] / parts
    points = np.vstack([p + share * (q - p) for p, q in zip(corners, np.roll(corners, -1, axis=0))])
    c, s = np.cos(turned), np.sin(turned)
    return Contour(points @ np.array([[c, s], [-s, c]]), closed=True)


def most(a, b, stepover, **how):
    """The greatest angle on a ring about another that is smaller by `stepover`, and begins elsewhere."""
    rings = [ring(a - stepover, b - stepover, 2, how.get("turned", 0.0)), ring(a, b, **how)]
    found = engagement(rings, R)
    return np.degrees(found.chosen(found.move == 1).most())


@pytest.mark.parametrize("stepover", [0.5, 1, 2.5, 4])
def test_the_greatest_angle_of_a_ring_stands_in_its_corner(stepover):
    """Coming into the corner the tool has all of its outer quarter in the material and, on the inside, arccos(1 - ae/R)."""
    expected = 90 + np.degrees(np.arccos(1 - stepover / R))
    assert most(17.3, 12.1, stepover) == pytest.approx(expected, abs=STATED)


@given(st.floats(12, 25), st.floats(0.5, 4), st.integers(0, 3), st.floats(-3, 3), st.integers(1, 7))
def test_the_greatest_angle_is_the_same_however_the_ring_is_told(a, stepover, first, turned, parts):
    expected = 90 + np.degrees(np.arccos(1 - stepover / R))
    assert most(a, 12.1, stepover, first=first, turned=turned, parts=parts) == pytest.approx(expected, abs=STATED)


@given(st.integers(1, 9), st.floats(0, 1))
def test_the_greatest_angle_of_a_straight_cut_is_that_of_its_middle(parts, shift):
    x = np.linspace(0, 40 + shift, parts + 1)
    whole = engagement([line(0, -20, 80), *(line(2.5, a, b) for a, b in zip(x, x[1:]))], R)
    assert np.degrees(whole.chosen(whole.move > 0).angle[-20:].max()) == pytest.approx(60, abs=STATED)
    assert np.degrees(engagement([line(0)], R).most()) == pytest.approx(180, abs=STATED)


# --- exactness ---------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("spacing", [None, 0.3, 1.0])
def test_rings_of_a_square_by_closed_forms(spacing):
    """R 3, stepover 2.4: arccos(1 - 0.8) = 78.463° on straights, 90° more where a ring comes into its corner.

    What is engaged on a straight reaches R·sin 78.463° ahead; so the angle rises from there on before the corner of the ring
    within, which comes 2.4 mm before its own."""
    passes = rings(Region.of(rectangle(60, 60)), 3.0, 2.4).passes
    found, straight = engagement(passes, 3.0, spacing=spacing), np.degrees(np.arccos(0.2))
    for k, contour in enumerate(passes[2:], 2):
        of_ring = found.chosen(found.move == k)
        assert np.degrees(of_ring.most()) == pytest.approx(straight + 90, abs=0.001)
        side = contour.length / 4
        from_corner, from_begin = side / 2 - np.abs(of_ring.points).min(axis=1), np.hypot(*(of_ring.points - contour.points[0]).T)
        middle = of_ring.chosen((from_corner > 6) & (from_begin > 9))
        assert np.degrees(middle.angle) == pytest.approx(straight, abs=0.001)
    outer = found.chosen(found.move == len(passes) - 1)
    above = 4 * (2.4 + 3 * np.sin(np.radians(straight)))
    assert outer.share_above(np.radians(straight + 0.001)) * contour.length == pytest.approx(above, abs=4 * (spacing or 0.2))
    assert np.degrees(outer.percentile(0.9 - 0.02)) == pytest.approx(straight, abs=0.001)
    assert straight + 1 < np.degrees(outer.percentile(0.95)) < np.degrees(outer.percentile(1)) <= straight + 90


@pytest.mark.parametrize("width", [0.1, 1, 2.5, 5, 7.5, 9.9])
def test_arcs_and_lines_are_exact(width):
    """The closed forms above: a straight side cut, a round hole, a round stud."""
    assert degrees([line(0, -20, 60), line(width)]) == pytest.approx(np.degrees(np.arccos(1 - width / R)), abs=1e-4)
    hole, way = 20.0, 20.0 - R + width
    cosine = (hole**2 - way**2 - R**2) / (2 * way * R)
    found = degrees([Contour.circle((0, 0), hole - R), Contour.circle((0, 0), way)])
    assert found == pytest.approx(np.degrees(np.arccos(cosine)), abs=1e-4)
    way = hole + R - width
    cosine = (hole**2 - way**2 - R**2) / (2 * way * R)
    found = degrees([Contour.circle((0, 0), rho, clockwise=True) for rho in (hole + R, way)])
    assert found == pytest.approx(180 - np.degrees(np.arccos(cosine)), abs=1e-4)


@pytest.mark.parametrize("bulge", [10.0**-k for k in range(3, 16)])
@pytest.mark.parametrize("place", [(0, 0), (1e4, -2e4)])
def test_flat_arcs_are_nearly_lines(bulge, place):
    """Two arcs over 60 mm, 1.5 mm apart, whose radii are 15 m and more: arccos(1 - 1.5/5)."""
    rows = [Contour(np.array([(-30, y), (30, y)]) + place, [bulge, 0], closed=False) for y in (0, 1.5)]
    assert degrees(rows) == pytest.approx(np.degrees(np.arccos(0.7)), abs=0.02)
    assert degrees(rows[:1]) == pytest.approx(180, abs=0.02)
    assert degrees([rows[0], rows[0]]) == pytest.approx(0, abs=0.05)


def rim_outside(contours, way, place, heading):
    """How many degrees of the front half of a rim lie outside of what is cleared up to a way of the last contour."""
    theta = heading + np.radians(np.arange(-89.95, 90, 0.1))
    spots = place + R * np.stack([np.cos(theta), np.sin(theta)], axis=1)
    done = [*contours[:-1], contours[-1].between(0, way - 1e-6)]
    return 0.1 * (np.min([each.distance(spots) for each in done], axis=0) >= R * (1 - 1e-7)).sum()


@given(st.integers(0, 10**6), st.sampled_from([0.0, 0.3, 1.0, 3.0]), st.sampled_from([2.0, 8.0, 25.0]))
def test_any_way_against_the_distances_of_the_rim(seed, bend, size):
    """Lines, flat arcs and more than half circles, smaller and greater than the tool, over one another."""
    rng = np.random.default_rng(seed)
    ways = [
        Contour(rng.uniform(-size, size, (6, 2)), np.append(rng.uniform(-bend, bend, 5), 0), closed=False) for _ in range(2)
    ]
    found = engagement(ways, R)
    places = np.flatnonzero((found.move == 1) & (found.step > 0))
    upto = np.cumsum(found.step[places]) - found.step[places] / 2
    for k in rng.choice(len(places), 8):
        at = places[k]
        expected = rim_outside(ways, upto[k], found.points[at], found.heading[at])
        assert np.degrees(found.angle[at]) == pytest.approx(expected, abs=0.5)


def test_a_place_where_two_elements_meet_is_one_of_the_way():
    """Two equal halves have a place at their joint where the count is odd: a slot there is a slot."""
    halves = Contour([(0, 0), (5, 0), (10, 0)], closed=False)
    assert np.degrees(engagement([halves], R, spacing=10 / 3).angle) == pytest.approx(180, abs=1e-3)


def test_a_curve_told_by_short_lines_is_the_curve():
    angle = np.linspace(0, 2 * np.pi, 5001)[:-1]
    told = [Contour(rho * np.stack([np.cos(angle), np.sin(angle)], axis=1)) for rho in (20, 22.5)]
    round_one = [Contour.circle((0, 0), rho) for rho in (20, 22.5)]
    assert degrees(told)[0] == pytest.approx(degrees(round_one)[0], abs=0.1)
    assert degrees(told) == pytest.approx(degrees(told)[0], abs=0.1)
