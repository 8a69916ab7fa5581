"""Distances of many points from an area are those that every element, asked one by one, gives."""

import numpy as np
import pytest

from mnclab.geometry import contours
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.geometry.signed import signed


@pytest.mark.parametrize("seed", range(12))
def test_many_points_and_few(seed):
    dice = np.random.default_rng(seed)
    holes = [Contour.circle(dice.uniform(-25, 25, 2), dice.uniform(1, 12)) for _ in range(dice.integers(0, 5))]
    holes += [contours.rectangle(12, 8, 2, centre=dice.uniform(-25, 25, 2), angle=dice.uniform(0, 6)) for _ in range(2)]
    region = Region.of(contours.rectangle(100, 80, dice.uniform(0, 20), angle=dice.uniform(0, 6)), holes=holes)
    for count in (1, 10, 3000):
        spots = dice.uniform(-70, 70, (count, 2))
        expected = np.where(region.contains(spots), -1.0, 1.0) * region.distance(spots)
        assert np.abs(signed(region, spots) - expected).max() < 1e-11


def test_of_an_empty_area():
    assert np.isinf(signed(Region(()), np.zeros((2, 2)))).all()
