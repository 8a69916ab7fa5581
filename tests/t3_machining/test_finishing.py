"""Finishing passes: arcs that touch the wall, walls followed exactly, nothing cut beyond them."""

import numpy as np
import pytest

from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.geometry.shapes import rectangle
from mnclab.machining.milling import finishing


def test_approach_and_departure():
    """Wall at (a, 0), ccw: from (a - ρ, -ρ) about (a - ρ, 0) to (a, 0); off to (a - ρ, ρ)."""
    way = finishing.tangential(rectangle(70, 50), 2.2, 1)
    assert way.points[0] == pytest.approx((35 - 2.2, -2.2))
    assert way.points[1] == pytest.approx((35, 0))
    assert way.points[-1] == pytest.approx((35 - 2.2, 2.2))
    assert way.centres[[0, -1]] == pytest.approx(np.array([[32.8, 0], [32.8, 0]]))
    assert way.turns()[[1, -1]] == pytest.approx([0, 0], abs=1e-9)
    assert way.length == pytest.approx(240 + np.pi * 2.2)


def test_round_a_stud_the_arcs_lie_outside():
    way = finishing.tangential(Contour.circle((0, 0), 20, clockwise=True), 3, 1)
    assert way.points[0] == pytest.approx((23, 3))
    assert np.hypot(*way.points_within(0.01).T).min() >= 20 - 0.01


def test_leaving():
    off = finishing.leaving(rectangle(70, 50).reversed(), 2, -1)
    assert off.points == pytest.approx(np.array([(35, 0), (33, -2)]))


@pytest.mark.deep
@pytest.mark.parametrize("climb", [True, False])
def test_walls_and_islands(climb):
    region = Region.of(rectangle(80, 60, 8), holes=[Contour.circle((5, 0), 10)])
    clearing = finishing.walls(region, 4, 3.0, allowances=(0.3, 0.0), climb=climb)
    assert clearing.labels == tuple(f"side finishing {k} of 2 {i} of 2" for k in (1, 2) for i in (1, 2))
    for contour, wide in zip(clearing.passes, (4.3, 4.3, 4, 4), strict=True):
        gap = region.distance(contour.points_within(0.001))
        assert gap.min() == pytest.approx(wide, abs=1e-3)
        assert gap[[0, -1]].min() > wide + 1
    outer = clearing.passes[0]
    inner = Contour(outer.points[1:-1], outer.bulge[1:-1])
    assert (inner.area > 0) == climb


def test_in_a_narrow_slot_the_arcs_get_smaller():
    region = Region.of(rectangle(60, 9, 4.5))
    (way,) = finishing.walls(region, 4, 5.0).passes
    assert region.distance(way.points_within(0.001)).min() == pytest.approx(4, abs=1e-3)
