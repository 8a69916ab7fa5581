"""Where along level rays the material of a workpiece ends, or begins: guessed by the tools, or bracketed by doubling and
narrowed down.
"""

from __future__ import annotations

import numpy as np

from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.clamped import Clamped
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.milling.moves import Moves
from mnclab.workpiece.milling.sweep import grouped
from mnclab.workpiece.milling.swept import left_by

NARROW = 1e-9  # mm, to which a place is found
PLACES = 15  # between both ends of a bracket, looked at together
FIRST = 1e-6  # mm, the first step
PAIRS = 1 << 14  # points times moves, up to which all moves that come near are asked
GROUP = 6.0  # mm, the side of a square whose points are looked at together


def sides(workpiece: Milled, x: Array, y: Array) -> tuple[Array, Array]:
    """Lower and upper side of the material at points (m,) anywhere, exact; equal where there is none."""
    if workpiece.sweep.gaps:
        top, floor = workpiece.surface.sides_at(x, y)
        return floor, top
    top, floor = workpiece.blank_at(x, y)
    found, moves, boxes = np.empty(len(x)), workpiece.moves, workpiece.sweep.boxes
    for some in grouped(x, y, max(workpiece.raster.tile, GROUP)):
        px, py = x[some], y[some]
        which = about(moves, boxes, px, py, float(top[some].max()))
        if not len(which):
            found[some] = top[some]
        elif len(which) * len(some) <= PAIRS:
            found[some] = np.minimum(top[some], left_by(moves[which], px, py).min(axis=0))
        else:
            found[some] = workpiece.sweep.within(px, py, top[some], floor[some])
    return floor, np.maximum(found, floor)


def about(moves: Moves, boxes: Array, x: Array, y: Array, below: float) -> Index:
    """The moves whose boxes some points lie in, and which go deeper than a height."""
    meets = (boxes[:, 0] <= x.max()) & (boxes[:, 1] <= y.max()) & (boxes[:, 2] >= x.min()) & (boxes[:, 3] >= y.min())
    return np.flatnonzero(meets & (moves.low < below))


def stands(workpiece: Milled, x: Array, y: Array, z: Array) -> Mask:
    """Whether material is at points (m,)."""
    floor, top = sides(workpiece, x, y)
    return np.asarray((floor <= z) & (z <= top) & (top > floor))


def ways(workpiece: Milled, origin: Array, direction: Array, z: Array, material: Mask, reach: float) -> tuple[Array, Array]:
    """How far along rays (k, 2) at heights z (k,) what is there at first (`material` or none) ends; nan beyond `reach`.

    The second is how far it was still so.
    """
    low, high = np.zeros(len(z)), np.full(len(z), np.nan)
    _guess(workpiece, origin, direction, z, material, low, high)
    steps = FIRST * 2.0 ** np.arange(int(np.ceil(np.log2(reach / FIRST))) + 1)
    for ladder in np.split(steps, [len(steps) - 7]):  # the long steps only where the short ones found no end
        open_ = np.flatnonzero(np.isnan(high))
        if not len(open_):
            break
        _bracket(workpiece, origin, direction, z, material, ladder, open_, low, high)
    some = np.flatnonzero(np.isfinite(high))
    while len(some := some[high[some] - low[some] > NARROW]):
        shares = np.arange(1, PLACES + 1) / (PLACES + 1)
        between = low[some, None] + (high - low)[some, None] * shares
        ends = _ends(workpiece, origin, direction, z, material, between, some)
        first = np.where(ends.any(axis=1), ends.argmax(axis=1), PLACES)
        rungs = np.concatenate([low[some, None], between, high[some, None]], axis=1)
        every = np.arange(len(some))
        low[some], high[some] = rungs[every, first], rungs[every, first + 1]
    return high, low


def _guess(
    workpiece: Milled, origin: Array, direction: Array, z: Array, material: Mask, low: Array, high: Array
) -> None:  # fmt: skip
    """Narrows rays down at once where the guess of the tools is right."""
    way = guessed(workpiece, origin, direction, z, material)
    some = np.flatnonzero(way > NARROW)
    if len(some):
        both = way[some, None] + 0.4 * NARROW * np.array([-1.0, 1.0])
        ends = _ends(workpiece, origin, direction, z, material, both, some)
        good = ~ends[:, 0] & ends[:, 1]
        low[some[good]], high[some[good]] = both[good].T


def _bracket(
    workpiece: Milled, origin: Array, direction: Array, z: Array, material: Mask, ladder: Array, which: Index, low: Array,
    high: Array,
) -> None:  # fmt: skip
    ends = _ends(workpiece, origin, direction, z, material, np.broadcast_to(ladder, (len(which), len(ladder))), which)
    hit, first = ends.any(axis=1), ends.argmax(axis=1)
    high[which[hit]] = ladder[first[hit]]
    before = np.where(hit, first - 1, len(ladder) - 1)
    low[which] = np.where(before >= 0, ladder[before], low[which])


def _ends(
    workpiece: Milled, origin: Array, direction: Array, z: Array, material: Mask, way: Array, which: Index
) -> Mask:
    """Whether what is at first is no longer there after ways (k, n) along some rays (k,)."""
    places = origin[which, None] + way[..., None] * direction[which, None]
    heights = np.broadcast_to(z[which, None], way.shape)
    there = stands(workpiece, places[..., 0].ravel(), places[..., 1].ravel(), heights.ravel()).reshape(way.shape)
    return there != material[which, None]


# How far level rays go to where the material ends or begins, guessed by the tools: a step is as long as nothing is nearer.
# A level move of any cutter is, at one height, a band about its way, and the distance from a band is plain. Where a move
# goes up or down there is no guess, and none in a blank that was cut before.

LONG = 1.0  # mm, up to which a way is guessed
STEPS = 5
LEAST = 1e-12  # mm, of a step
SIDE = 3.0  # mm, of a square whose rays are looked at together
GUESSED_PAIRS = 1 << 18  # rays times moves, beyond which nothing is guessed


def guessed(workpiece: Milled, origin: Array, direction: Array, z: Array, material: Mask) -> Array:
    """How far along rays (k, 2) at heights z (k,) what is there at first (`material` or none) goes on; nan where none is known.

    It may end a little later, or earlier where a blank ends: a guess is looked at by who takes it.
    """
    found, moves, boxes = np.full(len(z), np.nan), workpiece.moves, workpiece.sweep.boxes
    if isinstance(workpiece.cutting.stock, Clamped) or not len(moves):
        return found
    slopes = moves.start[:, 2] != moves.end[:, 2]
    slopes &= moves.arc | (np.hypot(*(moves.end - moves.start)[:, :2].T) > 0)
    for some in grouped(origin[:, 0], origin[:, 1], SIDE):
        low, high = origin[some].min(axis=0) - LONG, origin[some].max(axis=0) + LONG
        meets = (boxes[:, :2] <= high).all(axis=1) & (boxes[:, 2:] >= low).all(axis=1) & (moves.low < z[some].max())
        which = np.flatnonzero(meets)
        if not len(which) or slopes[which].any() or len(which) * len(some) > GUESSED_PAIRS:
            continue
        near, way = moves[which], np.zeros(len(some))
        wide, cones = _sections(near, z[some]), _cones(near)
        for _ in range(STEPS):
            x, y = (origin[some] + way[:, None] * direction[some]).T
            beside = (left_by(cones, x, y) - near.low[:, None] - wide).min(axis=0)
            ahead = np.clip(np.where(material[some], beside, -beside), 0.0, LONG)  # none cuts at a height: endless
            way += ahead
            if ahead.max() < LEAST:
                break
        found[some] = np.where((way > 0) & (way < LONG), way, np.nan)
    return found


def _sections(moves: Moves, z: Array) -> Array:
    """The radii (k, m) of tools at heights z (m,) when they cut deepest; less than nothing where they are above."""
    high = z - moves.low[:, None]
    flat, corner, slope = moves.flat[:, None], moves.corner[:, None], moves.slope[:, None]
    bent = np.sqrt(np.maximum(corner**2 - np.maximum(corner - high, 0.0) ** 2, 0.0))
    out = np.where(slope > 0, high / np.where(slope > 0, slope, 1.0), bent)
    round_ = np.where((corner > 0) | (slope > 0), np.minimum(flat + out, moves.radius[:, None]), moves.radius[:, None])
    return np.where(high >= 0, round_, -np.inf)


def _cones(moves: Moves) -> Moves:
    """Pointed tools on the same ways: they leave material as high above their tips as it is far from the way."""
    none = np.zeros(len(moves))
    return moves.with_cutter(np.stack([none + 1e6, none, none, none + 1.0], axis=1))
