"""Engagement against closed forms to one degree, and removal against the area that shapely finds."""

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.regions import Region
from mnclab.machining.milling.engagement import engagement

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
