"""Which row of a path made a place of a surface: the first one that cut the void just before it."""

from __future__ import annotations

import numpy as np

from mnclab.path.columns import Array
from mnclab.workpiece.difference.rays import ways
from mnclab.workpiece.difference.target import Target
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.milling.raster import near
from mnclab.workpiece.milling.swept import left_by

BEFORE = 1e-6  # mm, before the surface
SLANT = 1e-4  # mm, over which a direction is felt
BESIDE = 2.0  # times as far as a place is off, and a mm: where a row that stopped short is looked for


def first_cut(workpiece: Milled, place: Array) -> int:
    """The first row that took the material at a place (3,) away, -1 for none."""
    moves, (x, y, z) = workpiece.moves, place[:, None]
    if not len(moves):
        return -1
    found = near(moves, workpiece.sweep.boxes, x, y, float(z[0]) + 2 * BEFORE)
    cut = left_by(moves[found], x, y)[:, 0] <= z[0]
    return int(moves.row[found[cut.argmax()]]) if cut.any() else -1


def guilty(workpiece: Milled, target: Target, place: Array, void: Array, value: float) -> int:
    """The row that made the surface at a place (3,), in whose void `void` (3,) lies; -1 where nothing was cut there.

    Material that stands where no row came is the fault of the one that cut beside it, if one did within its feature.
    """
    row = first_cut(workpiece, void)
    if row >= 0 or value <= 0:
        return row
    around = SLANT * np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)])
    right, left, ahead, behind = target.distance(place + around)
    aside = np.array([right - left, ahead - behind])
    size = float(np.hypot(*aside))
    if size < SLANT * 0.1:
        return -1
    aside /= size
    start = place - [0.0, 0.0, min(value, 1.0) / 2]
    reach = BESIDE * (value + 1.0)
    way, _ = ways(workpiece, start[None, :2], aside[None], start[2:], np.ones(1, dtype=bool), reach)
    if not way[0] <= reach:
        return -1
    beside = start + np.append((way[0] + BEFORE) * aside, 0.0)
    return first_cut(workpiece, beside) if target.distance(beside[None])[0] > 0 else -1
