"""A slope compared: what differs is measured across its floor, and read off as its depths."""

from math import hypot

import pytest

from mnclab import Design
from mnclab.design.model.features import Slope

BLANK = ((0, 0, -20), (100, 60, 0))
SLOPE = Slope(40, 30, 40, 20, 2, 8)
DESIGN = Design(BLANK, SLOPE)


def compared(slope, step=0.5):
    return Design(BLANK, slope).workpiece(step).compare(DESIGN)


def actual(found, name):
    return next(row.actual for row in found.features if row.measure == name and row.feature == "slope")


def test_as_drawn():
    found = compared(SLOPE)
    assert found.ok
    assert found.worst_gouge.value == found.worst_rest.value == 0


def test_too_deep():
    """A floor 0.1 mm lower is 0.1 mm times the cosine of its fall off."""
    found = compared(Slope(40, 30, 40, 20, 2.1, 8.1))
    assert not found.ok
    assert found.worst_gouge.value == pytest.approx(0.1 * 40 / hypot(40, 6), abs=1e-9)
    assert found.gouge_volume == pytest.approx(0.1 * 800, abs=1e-6)
    assert actual(found, "start depth") == pytest.approx(2.1, abs=1e-6)
    assert actual(found, "end depth") == pytest.approx(8.1, abs=1e-6)


def test_too_narrow_and_too_steep():
    found = compared(Slope(40, 30, 40, 19.8, 2, 8.2))
    assert actual(found, "width") == pytest.approx(19.8, abs=1e-3)
    assert actual(found, "length") == pytest.approx(40, abs=1e-3)
    assert actual(found, "end depth") == pytest.approx(8.2, abs=1e-3)
    assert found.worst_rest.value == pytest.approx(0.1, abs=1e-3)
