"""A mill in what holds the blank: its edges, its shank or its holder lower than a fixture's top, at points of both."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from mnclab.path.toolpath import Array, Index
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.milling.bodies import TOLERANCE, Body, bodies_of, under
from mnclab.workpiece.milling.cutters import Cutter
from mnclab.workpiece.milling.judging import MOST, Judging, Met
from mnclab.workpiece.milling.raster import AT_ONCE
from mnclab.workpiece.milling.swept import left_by
from mnclab.workpiece.part import Part

GRID, FINE = 60, 240  # points along each side of a fixture; of all that the tools reach, where a part is looked for
ABOVE = 1000.0  # mm above the path, from where the top of a part is looked for
CLOSED, STEPS = 1e-6, 400  # mm that count as touched, and steps down to it


class Held(NamedTuple):
    """Points (m,) of a fixture, its top there, and how far the points lie from one another, mm."""

    x: Array
    y: Array
    top: Array
    apart: float


def in_fixtures(scene: Judging) -> Iterator[tuple[str, str, Met]]:
    """Kind, sentence and place of whatever of a tool is in a fixture."""
    for fixture in scene.cutting.fixtures:
        held = _points(scene, fixture)
        if not len(held.x):
            continue
        for index, tool in enumerate(scene.cutting.tools):
            mine = (scene.which == index) & ~scene.rising
            for body in bodies_of(tool) if mine.any() else ():
                for met in _met(scene, fixture, held, np.asarray(mine), body):
                    yield "fixture", f"the {body.name} in a fixture", met


def _met(
    scene: Judging, fixture: Blank | Part, held: Held, mine: Array, body: Body
) -> Iterator[Met]:
    x, y, top, apart = held
    bounds = np.array([[x.min(), y.min(), -np.inf], [x.max(), y.max(), top.max()]])
    ends, wide = scene.boxes, body.cutter.radius - scene.moves.radius
    near = mine & (ends[:, 0] - wide < bounds[1, 0]) & (ends[:, 1] - wide < bounds[1, 1])
    near &= (ends[:, 2] + wide > bounds[0, 0]) & (ends[:, 3] + wide > bounds[0, 1])
    near &= scene.moves.low + body.lift < top.max()
    step = max(apart, TOLERANCE)
    for k in _close(scene, np.flatnonzero(near), held, body):
        move = scene.moves[k : k + 1].with_cutter(np.array(body.cutter), body.lift)
        own = under(move, body.cutter.radius, bounds, step, MOST)
        own_top = _top(fixture, *own, float(scene.moves.low.min()), float(scene.moves.end[:, 2].max()))
        px, py = np.concatenate([own[0], x]), np.concatenate([own[1], y])
        low = left_by(move, px, py)[0]
        deep = np.fmax(np.concatenate([own_top, top]) - low, 0.0)
        deepest = int(np.round(deep, 6).argmax())
        if deep[deepest] > 0:
            place = float(px[deepest]), float(py[deepest]), float(low[deepest]) - TOLERANCE
            yield Met(int(scene.moves.row[k]), body, place, float(deep[deepest]) + TOLERANCE)


def _close(scene: Judging, moves: Index, held: Held, body: Body) -> Iterator[int]:
    """Those of some moves whose body comes as near to a point of the fixture as its points lie to one another."""
    x, y, top, apart = held
    wider = body.cutter.radius + apart
    many = max(AT_ONCE // len(x), 1)
    for first in range(0, len(moves), many):
        chunk = moves[first : first + many]
        discs = scene.moves[chunk].with_cutter(np.array(Cutter(wider, wider)), body.lift)
        yield from chunk[(left_by(discs, x, y) < top).any(axis=1)].tolist()


def _points(scene: Judging, fixture: Blank | Part) -> Held:
    """A fixture at points of its own, its edges among them: a narrow clamp is not missed.

    How far a part goes nobody says: it is looked for wherever a tool comes.
    """
    moves, many = scene.moves, GRID
    if not len(moves):
        return Held(np.empty(0), np.empty(0), np.empty(0), 0.0)
    if isinstance(fixture, Part):
        many = FINE
        wide = max(body.cutter.radius for tool in scene.cutting.tools for body in bodies_of(tool))
        low, high = scene.boxes[:, :2].min(axis=0) - wide, scene.boxes[:, 2:].max(axis=0) + wide
    else:
        low, high = fixture.bounds[:, :2]
    x, y = (axis.ravel() for axis in np.meshgrid(*np.linspace(low, high, many + 1).T))
    top = _top(fixture, x, y, float(moves.low.min()), float(moves.end[:, 2].max()))
    solid = np.isfinite(top)
    return Held(x[solid], y[solid], top[solid], float(np.hypot(*(high - low))) / many)


def _top(fixture: Blank | Part, x: Array, y: Array, low: float, high: float) -> Array:
    """How high a fixture reaches at points (m,); nan beside it. A part is looked for between `low` and far above `high`."""
    if not isinstance(fixture, Part):
        return fixture.faces(x, y)[1]
    z = np.full(len(x), high + ABOVE)
    going = np.arange(len(x))
    for _ in range(STEPS):
        gap = fixture(np.stack([x[going], y[going], z[going]], axis=1))
        z[going] -= np.maximum(gap, CLOSED)
        going = going[(gap > CLOSED) & (z[going] > low)]
        if not len(going):
            break
    z[going] = low  # grazed, not met
    return np.where(z > low, z, np.nan)
