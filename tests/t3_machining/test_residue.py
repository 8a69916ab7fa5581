"""What passes leave: closed forms, shapely on fine polygons, and the two against each other."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.machining.milling.faces import lines, rows
from mnclab.machining.milling.rest import beside_disc, left_by, within
from mnclab.machining.milling.rings import rings


def swept(points, radius):
    return shapely.LineString(points).buffer(radius, quad_segs=512)


def test_beside_a_disc():
    """A corner of a square leaves R² (1 - π/4); a strip R deep and R/2 wide: R²/2 less the sector and the triangle under it."""
    assert beside_disc(10, 10, 10) == pytest.approx(100 * (1 - math.pi / 4))
    assert beside_disc(5, 10, 10) == pytest.approx(50 - (100 * math.pi / 12 + 25 * math.sqrt(3) / 2))
    assert beside_disc(6, 8, 10) == pytest.approx(0, abs=1e-12)  # its far corner lies on the disc


def test_a_face_milled_within_it():
    """100 x 50, R 10, steps of 15: four corners and the one cusp at the near end, between the joined pairs 1-2 and 2-3."""
    corner, half = 100 * (1 - math.pi / 4), 7.5
    cusp = 2 * (half * 10 - (half * math.sqrt(100 - half**2) + 100 * math.asin(half / 10)) / 2)
    assert within(100, 50, 10, (10, 25, 40)) == pytest.approx(4 * corner + 2 * cusp)
    assert within(100, 50, 10, (10, 25, 40), outside=True) == pytest.approx(3 * corner + beside_disc(5, 10, 10) + cusp)


@pytest.mark.deep
@given(
    length=st.floats(3, 200), width=st.floats(3, 120), radius=st.floats(1, 20), factor=st.floats(0.1, 1.999),
    outside=st.booleans(),
)  # fmt: skip
def test_against_polygons(length, width, radius, factor, outside):
    """The same face swept by a polygon of 2048 corners: off by some millionths of the disc at each end."""
    assume(not 2 * radius < length < 3 * radius)  # one end reaches the other
    places = rows(radius, width - radius, factor * radius) if width > 2 * radius else (width / 2,)
    near, far = (radius, length - radius) if length > 2 * radius else (length / 2, length / 2)
    way = []
    for k, place in enumerate(places):
        start = -radius - 5 if outside and not k else near
        way += [(start, place), (far, place)] if k % 2 == 0 else [(far, place), (near, place)]
    rest = shapely.box(0, 0, length, width).difference(swept(way, radius)).area
    assert within(length, width, radius, places, outside) == pytest.approx(
        rest, abs=2e-5 * radius**2 * (1 + len(places))
    )


@pytest.mark.parametrize("factor", [0.8, 1.0, 1.5, 1.7])
def test_rings_that_leave_nothing(factor):
    """In the corner of a square rings k apart leave nothing as long as (k - R) √2 is at most R: k up to 1.707 R."""
    square = Region.of(Contour([(0, 0), (80, 0), (80, 80), (0, 80)]))
    assert left_by(rings(square, 5, factor * 5)) == pytest.approx(0, abs=1e-6)


@pytest.mark.parametrize("factor", [1.8, 1.9, 1.99])
def test_rings_that_leave_corners(factor):
    """Each corner between two rings keeps a square k - R wide less what the disc about the inner corner covers of it."""
    radius, size = 5.0, 2 * 5.0 + 4 * factor * 5.0  # rings of C at 0, k and, as a point, 2 k
    square = Region.of(Contour([(0, 0), (size, 0), (size, size), (0, size)]))
    free = factor * radius - radius
    x = math.sqrt(radius**2 - free**2)  # where the disc leaves the square

    def under(u):
        return (u * math.sqrt(radius**2 - u * u) + radius**2 * math.asin(u / radius)) / 2

    corner = free * (free - x) - (under(free) - under(x))
    linked = left_by(rings(square, radius, factor * radius))
    assert 4 * corner < linked + 1e-3 and linked < 8 * corner + 1e-3 and corner > 0


def test_a_zigzag_by_polygons_is_the_closed_form():
    places = rows(10, 40, 15)
    clearing = lines(places, 10, 90, 10)
    way = [p for contour in clearing.passes for p in np.vstack([contour.points[:1], contour.ends[-1:]]).tolist()]
    rest = shapely.box(0, 0, 100, 50).difference(swept(way, 10)).area
    assert within(100, 50, 10, places) == pytest.approx(rest, abs=1e-3)
