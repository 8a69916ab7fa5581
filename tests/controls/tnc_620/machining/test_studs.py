"""Studs: passes from the stock inwards, checked by formulas and by sweeping the tool along them (shapely)."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mnclab.controls.tnc_620.machining import studs


def half_sides(passes):
    return np.array([np.ptp(contour.bounds, axis=0) / 2 for contour in passes])


def swept(contours, radius):
    lines = [shapely.LineString(contour.points_within(3e-4)) for contour in contours]
    return shapely.union_all(shapely.buffer(lines, radius, quad_segs=48))


def test_rings_of_a_rectangular_stud():
    """Stock 100 × 80, stud 60 × 50, R 5, Q368 0.5, k 7: t = (19.5, 14.5), n = 3, half sizes by the formula."""
    clearing = studs.rectangle(60, 50, (100, 80), 5, 7, corner=3, allowance=0.5)
    expected = [(35.5 + (3 - i) * 6.5, 30.5 + (3 - i) * 14.5 / 3) for i in (1, 2, 3)]
    assert half_sides(clearing.passes) == pytest.approx(np.array(expected))
    assert all(ring.area < 0 for ring in clearing.passes)  # climb: clockwise
    assert {round(r, 6) for ring in clearing.passes for r in ring.radii} == {8.5, np.inf}


@pytest.mark.parametrize(("corner", "left"), [(0.0, 0.0), (3.0, (4 - np.pi) * 9), (-3.0, 2 * 9)])
def test_a_rectangular_stud_is_left_standing(corner, left):
    clearing = studs.rectangle(60, 50, (80, 70), 5, 6, corner=corner)
    stands = shapely.box(-40, -35, 40, 35).difference(swept(clearing.passes, 5))
    assert stands.area == pytest.approx(60 * 50 - left, abs=0.05)


def test_a_circular_stud_is_left_standing():
    clearing = studs.circle(40, 70, 5, 4, allowance=0.2)
    stands = shapely.Point(0, 0).buffer(35, quad_segs=100).difference(swept(clearing.passes, 5))
    assert stands.area == pytest.approx(np.pi * 20.2**2, abs=0.05)
    away = np.hypot(*clearing.passes[0].points.T)
    assert away[0] == pytest.approx(40) and away[-1] == pytest.approx(25.2)
    assert np.diff(away) == pytest.approx(-14.8 / 8)


@pytest.mark.parametrize(
    ("corner", "change"), [(0, 0.0), (4, 6 * 16 * (np.tan(np.pi / 6) - np.pi / 6)), (-2, 6 * 3**0.5)]
)
def test_a_polygon_is_left_standing(corner, change):
    """Hexagon with flats 20 from the centre: 2·√3·20²; a rounding r takes r²·(tan 30° - 30°), a bevel c takes c²·√3/4."""
    clearing = studs.polygon(6, 20, 60, 5, 5, corner=corner, angle=0.3)
    stands = shapely.Point(0, 0).buffer(30, quad_segs=100).difference(swept(clearing.passes, 5))
    assert stands.area == pytest.approx(2 * np.sqrt(3) * 400 - change, abs=0.1)


R = 5.0
SHARES = st.floats(0.2, 1.9999)


def stud_of(corners, radius, corner):
    """A regular polygon by shapely alone: sharp, rounded by a disc, or with its corners cut off by planes."""
    way = 2 * np.pi * np.arange(corners) / corners
    sharp = shapely.Polygon(radius * np.stack([np.cos(way), np.sin(way)], axis=1))
    if corner >= 0:
        return sharp.buffer(-corner).buffer(corner, quad_segs=100)
    return cut_off(sharp, -corner)


def cut_off(figure, leg):
    """A figure of straight sides less a triangle with two sides `leg` at each corner."""
    points = np.array(figure.exterior.coords)[:-1]
    ways = zip(np.roll(points, 1, axis=0), points, np.roll(points, -1, axis=0), strict=True)
    cut = [here + leg * (p - here) / np.hypot(*(p - here)) for before, here, after in ways for p in (before, after)]
    return shapely.Polygon(cut)


def kept_and_cleared(clearing, stud, stock, allowance, bevelled):
    """The stud and its allowance stand, nothing else of the stock does."""
    taken = swept(clearing.passes, R)
    assert taken.intersection(stud.buffer(allowance - 1e-3, quad_segs=100)).area < 1e-6
    around = stud.buffer(allowance + 2e-3, quad_segs=100, join_style="mitre" if bevelled else "round")
    assert stock.difference(taken).difference(around).area < 1e-3


@settings(max_examples=25)
@given(
    st.floats(20, 80), st.floats(20, 80), st.floats(0, 40), st.floats(0, 40), st.floats(-1, 1), st.floats(0, 1), SHARES,
    st.sampled_from([None, 0, 1, 2, 3]), st.booleans(),
)  # fmt: skip
def test_a_rectangle_stands_in_a_cleared_stock(a, b, more, wider, corner, allowance, share, begin, climb):
    corner = round(corner, 3) * 0.98 * min(a, b) / 2
    stock = a + 2 * allowance + more, b + 2 * allowance + wider
    clearing = studs.rectangle(
        a, b, stock, R, share * R, corner=corner, allowance=allowance, climb=climb, begin=begin, angle=0.2
    )
    sharp = shapely.box(-a / 2, -b / 2, a / 2, b / 2)
    inner = a / 2 - max(corner, 0), b / 2 - max(corner, 0)
    stud = (
        cut_off(sharp, -corner)
        if corner < 0
        else shapely.box(-inner[0], -inner[1], *inner).buffer(corner, quad_segs=100)
    )
    turned = [shapely.affinity.rotate(area, 0.2, origin=(0, 0), use_radians=True) for area in (
        stud, shapely.box(-stock[0] / 2, -stock[1] / 2, stock[0] / 2, stock[1] / 2)
    )]  # fmt: skip
    kept_and_cleared(clearing, *turned, allowance, corner < 0)


@settings(max_examples=25)
@given(
    st.integers(3, 12), st.floats(15, 40), st.floats(0, 60), st.floats(-1, 1), st.floats(0, 1), SHARES, st.booleans()
)
def test_a_polygon_stands_in_a_cleared_stock(corners, radius, more, corner, allowance, share, climb):
    inscribed = radius * math.cos(math.pi / corners)
    leg = radius * math.sin(math.pi / corners)
    corner = round(corner, 3) * 0.98 * (inscribed if corner > 0 else leg)
    stock = 2 * (inscribed + allowance) + more
    clearing = studs.polygon(corners, inscribed, stock, R, share * R, corner=corner, allowance=allowance, climb=climb)
    kept_and_cleared(
        clearing,
        stud_of(corners, radius, corner),
        shapely.Point(0, 0).buffer(stock / 2, quad_segs=100),
        allowance,
        corner < 0,
    )


@pytest.mark.parametrize("climb", [True, False])
def test_a_spiral_goes_round_in_its_sense_and_comes_in_evenly(climb):
    """A square of 40 in a stock of 60, R 5, k 5: two turns; each side lies 10/8 farther in than the one before it."""
    clearing = studs.rectangle(40, 40, (60, 60), R, R, corner=2, climb=climb, begin=0)
    spiral, ring = clearing.passes
    assert clearing.labels == ("spiral", "last ring")
    straight = spiral.radii == np.inf
    middle = (spiral.starts + spiral.ends)[straight] / 2
    assert np.abs(middle).max(axis=1) == pytest.approx(35 - np.arange(8) * 10 / 8)
    assert (np.sign(spiral.sweeps[~straight]) == (-1 if climb else 1)).all()
    assert spiral.turns()[:-1] == pytest.approx(0, abs=1e-9)
    assert spiral.points[-1] == pytest.approx(ring.points[0]) and half_sides([ring]) == pytest.approx(
        np.array([[25, 25]])
    )


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: studs.circle(40, 30, 5, 4), "stock"),
        (lambda: studs.rectangle(40, 40, (50, 39), 5, 4), "stock"),
        (lambda: studs.rectangle(40, 40, (50, 50), 5, 4, corner=21), "corner of 21"),
        (lambda: studs.rectangle(40, 40, (50, 50), 0, 4), "radius must be greater than 0"),
        (lambda: studs.polygon(5, 20, 30, 5, 4), "stock"),
        (lambda: studs.polygon(5, 20, 60, 5, 4, allowance=-20), "leaves nothing"),
    ],
)
def test_what_does_not_fit_is_refused(make, message):
    with pytest.raises(ValueError, match=message):
        make()
