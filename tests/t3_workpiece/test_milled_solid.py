"""The closed surface of a milled part: no gap, upright walls at their true places, volumes in closed form."""

import math

import numpy as np
import pytest
from tools.milled import is_closed

import mnclab
from mnclab import Setup, Tool
from mnclab.workpiece.blank import cylinder
from mnclab.workpiece.milling.sweep import Mapped

STOCK = ((0, 0, -20), (60, 40, 0))
TOOLS = {
    1: Tool(radius=4, kind="mill"), 2: Tool(radius=3, kind="drill", angle=118), 3: Tool(radius=3, corner=3, kind="mill"),
    4: Tool(radius=5, kind="chamfer", angle=90),
}  # fmt: skip
HEAD = "G17 G90 G54\nS3000 M3\n"
ANNULUS = "T1 M6\nG0 X15 Y20 Z5\nG1 Z-6 F300\nG3 I8 J0\nG0 Z5\n"  # centre 23 20, radii 4 and 12, 6 deep
THROUGH = "T2 M6\nG0 X50 Y10 Z5\nG1 Z-30 F300\nG0 Z5\n"
GROOVE = "T3 M6\nG0 X-10 Y36 Z5\nG1 Z-2 F300\nX70\nG0 Z5\n"
CHAMFER = "T4 M6\nG0 X-10 Y0 Z5\nG1 Z-2 F300\nX70\nG0 Z5\n"


def part(text, stock=STOCK, step=None):
    done = mnclab.run(HEAD + text, "g43", Setup(tools=TOOLS, stock=stock, start=(0, 0, 50)))
    assert done.ok
    return done.workpiece(step=step)


SEGMENT = 9 * math.acos(1 / 3) - math.sqrt(8)  # of a ball of radius 3 that cuts 2 deep
VOLUMES = {
    "annulus": (ANNULUS, math.pi * (12**2 - 4**2) * 6),
    "through": (THROUGH, math.pi * 9 * 20),
    "groove": (GROOVE, 60 * SEGMENT),
    "chamfer": (CHAMFER, 60 * 2 * 2 / 2),
}


@pytest.mark.parametrize("name", VOLUMES)
def test_volumes_in_closed_form(name):
    text, taken = VOLUMES[name]
    solid = part(text).solid()
    assert is_closed(solid)
    assert 60 * 40 * 20 - solid.volume == pytest.approx(taken, rel=0.005)


def test_walls_stand_where_they_are():
    """Corners of the wall lie on the circles of radius 4 and 12, nowhere between them and the next node."""
    points = part(ANNULUS, step=1.0).solid().points
    out = np.hypot(points[:, 0] - 23, points[:, 1] - 20)
    wall = (points[:, 2] == -6) & (points[:, 0] % 0.5 > 1e-3) & (points[:, 0] % 0.5 < 0.499) & (points[:, 1] % 1 < 1e-9)
    assert wall.sum() > 20
    assert np.minimum(np.abs(out[wall] - 12), np.abs(out[wall] - 4)).max() < 1e-4


@pytest.mark.parametrize("step", [0.3, 1.1, 7.0])
@pytest.mark.parametrize("stock", [STOCK, cylinder(18, -20, 0, at=(23, 20, 0)), cylinder(15, 0, 60, axis="X", at=(0, 20, -15))])
def test_a_part_is_closed_whatever_is_cut(stock, step):
    found = part(ANNULUS + THROUGH + GROOVE + CHAMFER, stock, step)
    solid = found.solid()
    assert is_closed(solid) and solid.volume > 0
    if step < 1:
        assert solid.volume == pytest.approx(found.volume, rel=0.005)


@pytest.mark.parametrize("seed", range(12))
def test_a_part_of_any_moves_is_closed(seed):
    """Slots at random, many of them thinner apart than a node, over the rim and through."""
    chance = np.random.default_rng(seed)
    rows = [f"G1 X{x:.3f} Y{y:.3f} Z{z:.3f} F500" for x, y, z in chance.uniform((-5, -5, -24), (65, 45, 3), (40, 3))]
    tools = [f"T{tool} M6" for tool in chance.integers(1, 5, 40)]
    text = "G0 X-10 Y-10 Z10\n" + "\n".join(line for pair in zip(tools, rows) for line in pair)
    assert is_closed(part(text + "\n", step=float(chance.uniform(0.8, 3))).solid())


def test_triangles_know_the_row_that_cut_them():
    """The floor of the annulus belongs to its arc, the top to nothing."""
    found = part(ANNULUS)
    points, triangles, row = found.solid()
    middle = points[triangles].mean(axis=1)
    floor = (np.abs(points[triangles][:, :, 2] + 6) < 1e-9).all(axis=1) & (middle[:, 0] > 24)
    arc = int(np.flatnonzero(found.cutting.path.kind == mnclab.Kind.ARC)[0])
    assert floor.any() and set(row[floor].tolist()) == {arc}
    top = (points[triangles][:, :, 2] == 0).all(axis=1)
    assert top.any() and set(row[top].tolist()) == {-1}


def test_flat_places_have_few_triangles():
    """A blank that nothing cuts has its rim, and squares within it."""
    solid = part("G0 X0 Y0 Z5\n").solid()
    assert len(solid.triangles) < 12_000 and solid.volume == pytest.approx(48_000)


def test_very_many_moves_are_taken_from_the_map():
    """Between the cells of a chamfer of 45 degrees, 2 wide, heights are those of its plane."""
    found = part(CHAMFER, step=0.25)
    found.surface = Mapped(found.raster, found.moves, found.blank_at, 0.0, found.heights)
    x, y = np.linspace(0, 60, 40), np.linspace(0.125, 1.875, 40)
    assert np.abs(found.surface.at(x, y) - (y - 2)).max() < 1e-9
    assert is_closed(found.solid())
