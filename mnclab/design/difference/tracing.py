"""How far level rays go to where the material ends or begins, guessed by the tools: a step is as long as nothing is nearer.

A level move of any cutter is, at one height, a band about its way, and the distance from a band is plain. Where a move
goes up or down there is no guess, and none in a blank that was cut before.
"""

from __future__ import annotations

import numpy as np

from mnclab.path.toolpath import Array, Mask
from mnclab.workpiece.clamped import Clamped
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.milling.moves import Moves
from mnclab.workpiece.milling.sweep import grouped
from mnclab.workpiece.milling.swept import left_by

LONG = 1.0  # mm, up to which a way is guessed
STEPS = 5
LEAST = 1e-12  # mm, of a step
SIDE = 3.0  # mm, of a square whose rays are looked at together
PAIRS = 1 << 18  # rays times moves, beyond which nothing is guessed


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
        if not len(which) or slopes[which].any() or len(which) * len(some) > PAIRS:
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
