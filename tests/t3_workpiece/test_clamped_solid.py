"""The closed surface of parts that were cut on both sides: walls of either side at their true places, volumes, outlines."""

import math

import numpy as np
import pytest
from tools.milled import BALL, BULL, DRILL, MILL, is_closed, part

from mnclab import Tool
from mnclab.geometry.contours import Contour
from mnclab.workpiece.milling.solid import creases

NARROW = Tool(radius=3, number=1, kind="mill")
RING = "G0 X20 Y15\nG1 Z-8\nG2 X20 Y15 I10 J5\nG0 Z50\n"  # about 30 20, radii √125 ± 5
HOLES = "G0 X30 Y20\nG1 Z-15\nG0 Z50\nG0 X8 Y8\nG1 Z-25\nG0 Z50\n"


def slots(seed, count=12):
    chance = np.random.default_rng(seed)
    ends = chance.uniform((-4, -4), (64, 44), (count, 2, 2))
    return "".join(
        f"G0 X{a:.3f} Y{b:.3f}\nG1 Z{z:.3f}\nX{c:.3f} Y{d:.3f}\nG0 Z50\n"
        for ((a, b), (c, d)), z in zip(ends, chance.uniform(-16, -1, count))
    )


def thickness(body, count=900):
    """The volume between both sides at the points of a fine lattice."""
    low, high = body.bounds[:, :2]
    x, y = (a + (np.arange(count) + 0.5) / count * (b - a) for a, b in zip(low, high))
    found = 0.0
    for some in np.array_split(y, 30):
        below, above = body.faces(*(each.ravel() for each in np.meshgrid(x, some)))
        found += float(np.nansum(above - below))
    return found * float(np.prod((high - low) / count))


def test_walls_of_both_sides_stand_at_their_places():
    """A ring from above, now below; a hole of radius 3 that ends in its middle, one of radius 3 through beside it."""
    second = part(HOLES, NARROW, part(RING).turned_over("x"), step=1.0)
    solid, radius = second.solid(), math.sqrt(125)
    assert is_closed(solid)
    taken = math.pi * ((radius + 5) ** 2 - (radius - 5) ** 2) * 8 + math.pi * 9 * (15 + 20)
    assert 48000 - solid.volume == pytest.approx(taken, rel=0.005)
    x, y, z = solid.points.T
    between = (np.abs(x - np.round(x)) > 1e-3) | (np.abs(y - np.round(y)) > 1e-3)  # no node: a wall
    out = np.hypot(x - 30, y - 20)
    for place, radii in ((-12, (radius - 5, radius + 5)), (-15, (3,))):
        wall = between & (z == place) & (out < 18)
        assert wall.sum() > 10
        assert np.abs(out[wall][:, None] - radii).min(axis=1).max() < 2e-4
    assert (solid.row == -1).any() and (solid.row >= 0).any()


@pytest.mark.deep
@pytest.mark.parametrize("seed", range(6))
def test_parts_of_any_moves_on_both_sides_are_closed(seed):
    tools = [MILL, BALL, BULL, DRILL]
    first = part(slots(seed), tools[seed % 4])
    second = part(slots(seed + 50), tools[(seed + 1) % 4], first.turned_over("xy"[seed % 2]))
    third = part(slots(seed + 90, 5), tools[(seed + 2) % 4], second.turned_over("x"))
    for body in (second, third):
        assert is_closed(body.solid())
        assert body.volume == pytest.approx(thickness(body), abs=48000 * 1e-4)
        assert body.solid().volume == pytest.approx(body.volume, rel=1e-3)
        assert sum(body.removed_by("row").values()) == pytest.approx(body.removed)


def test_outlines_are_silhouettes():
    """From above the block with its hole, from the side what reaches highest and lowest, turned with the part."""
    first = part("G0 X-10 Y0\nG1 Z-4\nX70\nG0 Z50\nG0 X30 Y24\nG1 Z-25\nG0 Z50\n" + "".join(
        f"G0 X60 Y{y}\nG1 Z-6\nY{y + 8}\nG0 Z50\n" for y in range(-4, 44, 8)
    ))  # fmt: skip
    blank = first.turned_over("x").as_blank()
    outer, hole = sorted((Contour(line[:-1]) for line in blank.outline(0, 1)), key=lambda each: -abs(each.area))
    assert abs(outer.area) == pytest.approx(2400, rel=1e-4)  # seen from the other side they run the other way
    assert hole.area / outer.area == pytest.approx(-25 * math.pi / 2400, rel=1e-3)
    assert hole.bounds.mean(axis=0) == pytest.approx((30, 16), abs=1e-3)
    (side,) = blank.outline(0, 2)
    assert abs(Contour(side[:-1]).area) == pytest.approx(60 * 20 - 5 * 6, rel=2e-3)  # 6 deep for 5 mm at the end, now below
    turned = first.turned(90).as_blank()
    (front,) = turned.outline(1, 2)
    assert abs(Contour(front[:-1]).area) == pytest.approx(60 * 20 - 5 * 6, rel=2e-3)
    assert len(turned.outline(0, 1)) == 2 and Contour(turned.outline(0, 1)[0][:-1]).bounds == pytest.approx(turned.bounds[:, :2])
    askew = first.turned(30).as_blank()
    assert askew.outline(0, 2)[0][:, 0].max() == pytest.approx(askew.bounds[1, 0], abs=0.5)


def test_edges_of_a_block_with_a_hole():
    """Twelve edges and two rims: lines that end where three meet, and such that go round."""
    lines = creases(part("G0 X30 Y24\nG1 Z-25\nG0 Z50\n", step=0.4).solid())
    assert len(lines) == 14
    straight = [float(np.ptp(line, axis=0).max()) for line in lines if len(line) == 2]
    assert sorted(straight) == pytest.approx([20] * 4 + [40] * 4 + [60] * 4)
    rims = [line for line in lines if len(line) > 2]
    assert all(np.array_equal(rim[0], rim[-1]) for rim in rims) and sorted(rim[0, 2] for rim in rims) == [-20, 0]
    assert max(float(np.abs(np.hypot(rim[:, 0] - 30, rim[:, 1] - 24) - 5).max()) for rim in rims) < 0.01
