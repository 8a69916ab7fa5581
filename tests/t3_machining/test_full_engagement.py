"""Where a tool cuts with its whole circumference, against closed forms: slots, corners, cleared bands, circles."""

import numpy as np
import pytest

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour, rectangle
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import covered, polygons
from mnclab.machining.milling.engagement import engagement, stretches
from mnclab.machining.milling.rings import rings
from mnclab.machining.milling.trochoids import trochoidal

R = 5.0
STEP = R / 16  # of the samples


def way(*points):
    return Contour(points, closed=False)


def told(parts):
    return [(part.full, pytest.approx(part.contour.length, abs=STEP)) for part in parts]


def test_a_slot_is_full_and_the_way_back_is_not():
    there, back = stretches([way((0, 0), (40, 0)), way((40, 0), (0, 0))], R)
    assert told(there) == [(True, 40)] and told(back) == [(False, 40)]


def test_out_of_a_cleared_band():
    """Full from where the back of the front half leaves the band |x| < R: at x = R."""
    (first,), parts = stretches([way((0, -30), (0, 30)), way((0, 0), (40, 0))], R)
    assert first.full
    assert told(parts) == [(False, R), (True, 40 - R)]
    assert parts[0].contour.points[0] == pytest.approx([0, 0])
    assert parts[0].contour.points[-1] == pytest.approx(parts[1].contour.points[0])


def test_after_a_corner_of_a_slot():
    """Behind a corner of 90° the slot before it stands open to the side for a way of R."""
    (parts,) = stretches([way((0, 0), (30, 0), (30, 30))], R)
    assert told(parts) == [(True, 30), (False, R), (True, 30 - R)]


def test_beside_a_slot_nothing_is_full():
    """The stepover decides: below 2 R something of the rim is always free."""
    _, (beside,) = stretches([way((-20, 0), (60, 0)), way((0, 1.9 * R), (40, 1.9 * R))], R)
    assert not beside.full


@pytest.mark.parametrize("step", [0.5, 1.0, 2.5, 4.0])
def test_in_the_corner_of_a_ring(step):
    """A ring `step` outside the one before: on the straight arccos(1 - s/R), in its corner π/2 more."""
    inner, outer = (Contour([(0, -12), (0, 0), (-12, 0)], closed=False).points + s for s in (0, step))
    found = engagement([Contour(inner, closed=False), Contour(outer, closed=False)], R, spacing=0.05)
    second = found.chosen((found.move == 1) & (found.heading > 1))
    straight = np.arccos(1 - step / R)
    assert np.degrees(second.angle[len(second.angle) // 2]) == pytest.approx(np.degrees(straight), abs=1)
    upwards = second.chosen(np.abs(second.heading - np.pi / 2) < 0.01)
    assert np.degrees(upwards.angle[-1]) == pytest.approx(np.degrees(straight + np.pi / 2), abs=1)


def test_a_ring_meets_its_own_start():
    """A slot along a circle of radius 20 is full until its start is 2 R off, over an arc of 2·asin(R/20); then all is air."""
    ring, last = Contour.circle((0, 0), 20), 40 * np.arcsin(R / 20)
    parts, again = stretches([ring, ring], R)
    assert told(parts) == [(True, ring.length - last), (False, last)]
    assert again[0].contour is ring and told(again) == [(False, ring.length)]


def test_only_what_stands_engages():
    """In a stock of a strip the tool is full only inside it: the strip is 2 R wide about y = 0, from x = 10 on."""
    stock = Region.of(rectangle(100, 2 * R, centre=(60, 0)))
    (parts,) = stretches([way((-20, 0), (60, 0))], R, stock=stock)
    assert told(parts) == [(False, 30), (True, 50)]


def test_a_short_gap_is_no_stretch():
    """A slot ends 2 R less `deep` from the way: only over sqrt(R² - (R - deep)²) or so is the rim free, too short to tell."""
    for deep, count in ((0.001, 1), (2.0, 3)):
        _, parts = stretches([way((20, -30), (20, -2 * R + deep)), way((0, 0), (40, 0))], R)
        assert len(parts) == count and parts[0].full and parts[-1].full


def test_arcs_stay_arcs_where_a_ring_is_parted():
    hole, wide = Contour.circle((8, 0), 6), Contour.circle((0, 0), 14)
    _, parts = stretches([hole, wide], R)
    assert len(parts) > 1
    assert all(part.contour.radii == pytest.approx(14) for part in parts)
    assert sum(part.contour.length for part in parts) == pytest.approx(wide.length)
    assert [part.full for part in parts] == [bool(k % 2) ^ parts[0].full for k in range(len(parts))]


def test_two_thousand_elements():
    angle = np.linspace(0, 2 * np.pi, 2000, endpoint=False)
    reach = 60 + 5 * np.sin(7 * angle)
    loops = [Contour(f * np.stack([reach * np.cos(angle), reach * np.sin(angle)], axis=1)) for f in np.linspace(0.2, 1, 16)]
    found = stretches(loops, 3.0)
    assert found[0][0].full and not any(part.full for part in found[5])


def test_the_first_ring_of_a_pocket_is_a_slot_and_the_wall_is_not():
    """Steps of 0.9 R: in the corners π/2 + arccos(0.1) = 174°."""
    found = stretches(rings(Region.of(rectangle(60, 60)), R, 0.9 * R).passes, R)
    assert any(part.full for part in found[0]) and not any(part.full for part in found[-1])


@pytest.mark.deep
@pytest.mark.parametrize(("region", "step"), [(rectangle(40, 26), 3.0), (Contour.circle((0, 0), 16), 2.0)])
def test_trochoids_cut_no_wider_than_their_step(region, step):
    """But on the first turn out of the plunged hole, and where a branch leaves a larger disc up to twice as much."""
    clearing = trochoidal(Region.of(region), R, step)
    found = engagement(clearing.passes, R)
    opening = clearing.passes[0].lengths[:3].sum()
    later = found.chosen((found.move > 0) | (np.cumsum(found.step) > opening))
    assert later.width.max() < 2 * step
    assert later.step[later.width > 1.05 * step].sum() < 0.02 * later.step.sum()


def test_trochoids_leave_out_the_ends_of_arcs_that_cut_only_air():
    """Round an island the middle line comes back to the first disc: each arc still meets what those before it have left in
    an eighth of it at one of its ends."""
    region = Region([rectangle(60, 40), rectangle(14, 10, centre=(8, 2)).reversed()])
    clearing = trochoidal(region, 4.0, 2.0)
    left = polygons(region)
    for contour, label in zip(clearing.passes, clearing.labels, strict=True):
        parts = (0, contour.length / 8), (7 / 8 * contour.length, contour.length)
        ends = [covered([contour.between(*part)], 4.0) for part in parts]
        if "arc" in label and "arc 1 " not in label:
            assert any(shapely.intersection(left, end).area > 1e-4 for end in ends), label
        left = shapely.difference(left, covered([contour], 4.0))
