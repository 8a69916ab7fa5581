"""Which points of a lattice lie in an area; what must be there is worked out from circles."""

import numpy as np
import pytest

from mnclab.design.model.removals import filled
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region

X, Y = np.arange(-9.5, 10), np.arange(-8.25, 9)
AT, UP = np.meshgrid(X, Y)


def lying_in(region):
    rows, columns, inside = filled(region, X, Y)
    found = np.zeros(AT.shape, dtype=bool)
    found[rows, columns] = inside
    return found


@pytest.mark.parametrize("angle", [15, 90, 180, 225, 270, 345])
@pytest.mark.parametrize("begin", range(0, 360, 45))
@pytest.mark.parametrize("reversed_", [False, True])
def test_the_part_of_a_disc_beside_a_chord(angle, begin, reversed_):
    """An arc goes over a highest and a lowest point, begins or ends at them, or keeps between them."""
    first, last = np.radians([begin, begin + angle])
    ends = 7 * np.array([[np.cos(a), np.sin(a)] for a in (first, last)])
    contour = Contour(ends, [np.tan(np.radians(angle) / 4), 0])
    region = Region.of(contour.reversed() if reversed_ else contour)
    middle = (first + last) / 2
    beyond = AT * np.cos(middle) + UP * np.sin(middle) > 7 * np.cos(np.radians(angle) / 2)
    assert (lying_in(region) == (beyond & (np.hypot(AT, UP) < 7))).all()
