"""The erosion of the map of tips beside the exact sweep, and beside tools set down one by one."""

import numpy as np
import pytest

from mnclab.workpiece.milling import erosion
from mnclab.workpiece.milling.erosion import BITS
from mnclab.workpiece.milling.moves import Cutter, Moves, edge_height
from mnclab.workpiece.milling.raster import Raster, lowered

CUTTERS = {
    "flat": Cutter(3.1, 3.1),
    "ball": Cutter(2.7, 0.0, 2.7),
    "bull-nosed": Cutter(3.3, 2.2, 1.1),
    "drill": Cutter(2.0, 0.0, 0.0, 0.6),
    "finer than a cell": Cutter(0.2, 0.2),
    "wide": Cutter(9.0, 8.0, 1.0),
}
STEP = 0.4
RASTER = Raster((-1.0, 2.0), STEP, (75, 101))


def random_moves(rng, cutters, count=40):
    """Lines, ramps, plunges, arcs and helices all over the raster and beyond it."""
    start = rng.uniform((-6, -3, -6), (46, 37, -0.5), (count, 3))
    end = start + rng.normal(0, (8, 8, 1), (count, 3))
    kind = rng.integers(0, 5, count)  # level, ramp, plunge, level arc, helix
    end[:, 2] = np.where(np.isin(kind, (0, 3)), start[:, 2], end[:, 2])
    end[kind == 2, :2] = start[kind == 2, :2]
    arc = kind >= 3
    centre, sweep = start[:, :2] + rng.normal(0, 4, (count, 2)), rng.uniform(-9, 9, count)
    spoke = start[:, :2] - centre
    turned = np.stack([spoke[:, 0] * np.cos(sweep) - spoke[:, 1] * np.sin(sweep),
                       spoke[:, 0] * np.sin(sweep) + spoke[:, 1] * np.cos(sweep)], axis=1)  # fmt: skip
    end[arc, :2] = (centre + turned)[arc]
    shapes = np.array(cutters)[rng.integers(0, len(cutters), count)]
    return Moves(np.arange(count), start, end, arc, centre, sweep, *shapes.T.copy())


def exact(raster, moves, top):
    found = np.empty(raster.shape)
    for tile in raster.tiles():
        left = lowered(moves, moves.boxes, *raster.middles(tile), top[tile].ravel())
        found[tile] = left.reshape(found[tile].shape)
    return found


def set_down(raster, moves, top, thinner):
    """Tools that are thinner by so many mm, set down at 400 places of each move."""
    found = top.copy()
    y, x = np.meshgrid(raster.y, raster.x, indexing="ij")
    for k in range(len(moves)):
        one = moves[np.array([k])]
        for share in np.linspace(0, 1, 400):
            px, py, pz = (one.start + share * (one.end - one.start))[0]
            if one.arc[0]:
                dx, dy = one.start[0, :2] - one.centre[0]
                angle = share * one.sweep[0]
                px = one.centre[0, 0] + dx * np.cos(angle) - dy * np.sin(angle)
                py = one.centre[0, 1] + dx * np.sin(angle) + dy * np.cos(angle)
            rho = np.hypot(x - px, y - py) + thinner
            height = pz + edge_height(rho, one.flat, one.corner, one.slope)
            np.minimum(found, np.where(rho <= one.radius, height, np.inf), out=found)
    return found


@pytest.mark.deep
@pytest.mark.parametrize("cutters", [[name] for name in CUTTERS] + [list(CUTTERS)], ids=" ".join)
@pytest.mark.parametrize("seed", range(2))
def test_between_the_tools_and_thinner_tools(cutters, seed):
    rng = np.random.default_rng(seed)
    moves = random_moves(rng, [CUTTERS[name] for name in cutters])
    top = np.where(rng.random(RASTER.shape) < 0.9, 0.0, -2.0)
    found = erosion.eroded(RASTER, moves, top)
    true, most = exact(RASTER, moves, top), set_down(RASTER, moves, top, erosion.ERROR * STEP)
    assert (found.heights >= true - 1e-9).all()
    coarse = 20 / 2 ** (BITS - 18)  # of the code of a height
    assert (found.heights <= most + coarse).all()
    assert (true < top).mean() > 0.05
    untouched = found.move < 0
    assert (found.heights[untouched] == top[untouched]).all()
    assert (found.heights[~untouched] < top[~untouched]).all()


def wavy(passes, pieces, apart):
    """A surface in straight passes there and back."""
    way, along = np.divmod(np.arange(passes * pieces), pieces)
    u = np.where(way % 2 == 0, along, pieces - 1 - along) / (pieces - 1) * 38
    points = np.stack([u, 3 + apart * way, 2 * np.sin(u / 5) + np.cos(way * apart / 3) - 5], axis=1)
    return points[:-1], points[1:]


@pytest.mark.parametrize(("name", "least", "mean"), [("ball", 0.6, 0.01), ("bull-nosed", 0.6, 0.01), ("flat", 0.6, 0.02)])
def test_a_surface_is_nearly_everywhere_exact(name, least, mean):
    start, end = wavy(40, 80, 0.7)
    count = len(start)
    columns = (np.full(count, value) for value in CUTTERS[name])
    moves = Moves(np.arange(count), start, end, np.zeros(count, bool), np.zeros((count, 2)), np.zeros(count), *columns)
    top = np.zeros(RASTER.shape)
    found, true = erosion.eroded(RASTER, moves, top).heights, exact(RASTER, moves, top)
    off = (found - true)[true < 0]
    assert off.min() >= -1e-9 and off.mean() < mean and (off < 1e-9).mean() > least


def test_the_level_floor_of_a_pocket_is_exact():
    """Concentric squares at one depth: the floor stands at it, the rest at the top."""
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)])
    points = np.concatenate([np.column_stack([(12, 15) + half * corners, np.full(5, -3.0)]) for half in (2, 5, 8)])
    count = len(points) - 1
    columns = (np.full(count, value) for value in Cutter(3.0, 3.0))
    moves = Moves(
        np.arange(count), points[:-1], points[1:], np.zeros(count, bool), np.zeros((count, 2)), np.zeros(count), *columns
    )
    found = erosion.eroded(RASTER, moves, np.zeros(RASTER.shape)).heights
    y, x = np.meshgrid(RASTER.y, RASTER.x, indexing="ij")
    dx, dy = np.maximum(np.abs(x - 12) - 8, 0), np.maximum(np.abs(y - 15) - 8, 0)
    floor = np.hypot(dx, dy) <= 3
    assert (found == np.where(floor, -3.0, 0.0)).all()
