"""Areas that do not meet are joined and taken away without set operations: by closed forms."""

import math

import pytest

from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region, Where, joined, less, where

PLATE = Contour([(0, 0), (40, 0), (40, 30), (0, 30)])


def disc(x, y, r):
    return Region((Contour.circle((x, y), r),))


def plate(*holes):
    return Region((PLATE, *(Contour.circle((x, y), r, clockwise=True) for x, y, r in holes)))


@pytest.mark.parametrize(
    ("holes", "gone", "area"),
    [
        ([(10, 10, 3)], [disc(10, 10, 5)], 1200 - 25 * math.pi),  # swallows the hole
        ([(10, 10, 3)], [disc(30, 10, 5)], 1200 - 34 * math.pi),
        ([(10, 10, 3)], [disc(40, 15, 5)], 1200 - 9 * math.pi - 12.5 * math.pi),  # through the edge, the hole is kept
        ([(10, 10, 3)], [disc(0, 0, 3), disc(10, 10, 3)], 1200 - 9 * math.pi - 2.25 * math.pi),
    ],
)
def test_less(holes, gone, area):
    found = less(plate(*holes), gone)
    assert found.area == pytest.approx(area, abs=1e-6)
    assert sum(loop.area > 0 for loop in found.loops) == 1 and found.loops[0].area > 0


def test_joined():
    a, b = plate((10, 10, 3), (30, 10, 3)), plate((10, 10, 3), (30, 10, 1), (20, 20, 2))
    assert joined(a, b).area == pytest.approx(1200 - 10 * math.pi)
    assert joined(plate((10, 10, 5)), disc(10, 10, 2)).area == pytest.approx(1200 - 21 * math.pi)
    assert joined(disc(0, 0, 5), disc(5, 0, 5)).area == pytest.approx(50 * math.pi - (50 * math.pi / 3 - 12.5 * 3**0.5), abs=1e-5)


def test_where():
    region = plate((10, 10, 3))
    assert where(Contour.circle((30, 10), 3), region) is Where.INSIDE
    assert where(Contour.circle((10, 10), 1), region) is Where.OUTSIDE
    assert where(Contour.circle((40, 10), 1), region) is Where.ACROSS
    assert where(PLATE, region) is Where.EDGE
