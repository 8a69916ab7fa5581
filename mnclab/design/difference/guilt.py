"""Which row of a path made a place of a surface: the first one that cut the void just before it."""

from __future__ import annotations

import numpy as np

from mnclab.design.difference.rays import PAIRS, about, ways
from mnclab.design.difference.target import Target
from mnclab.path.toolpath import Array, Index
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.milling.raster import near
from mnclab.workpiece.milling.sweep import grouped
from mnclab.workpiece.milling.swept import left_by

BEFORE = 1e-6  # mm, before the surface
SLANT = 1e-4  # mm, over which a direction is felt
GROUP = 2.0  # mm, the side of a square whose places are looked at together
BESIDE = 2.0  # times as far as a place is off, and a mm: where a row that stopped short is looked for


def first_cuts(workpiece: Milled, places: Array) -> Index:
    """The first rows that took the material at places (m, 3) away (m,), -1 for none."""
    moves, found = workpiece.moves, np.full(len(places), -1, dtype=np.int64)
    if not len(moves) or not len(places):
        return found
    x, y, z = places.T
    for some in grouped(x, y, GROUP):
        below = float(z[some].max()) + 2 * BEFORE
        which = about(moves, workpiece.sweep.boxes, x[some], y[some], below)
        if len(which) * len(some) > PAIRS:
            which = near(moves, workpiece.sweep.boxes, x[some], y[some], below)
        if not len(which):
            continue
        cut = left_by(moves[which], x[some], y[some]) <= z[some]
        hit = cut.any(axis=0)
        found[some[hit]] = moves.row[which[cut[:, hit].argmax(axis=0)]]
    return found


def guilty(workpiece: Milled, target: Target, place: Array, void: Array, value: Array) -> Index:
    """The rows (m,) that made the surface at places (m, 3), off by `value` (m,), in whose void `void` (m, 3) lies; -1 where
    nothing was cut there.

    Material that stands where no row came is the fault of the one that cut beside it, if one did within its feature.
    """
    rows = first_cuts(workpiece, void)
    some = np.flatnonzero((rows < 0) & (value > 0))
    if not len(some) or not len(workpiece.moves):
        return rows
    around = SLANT * np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)])
    right, left, ahead, behind = target.distance((place[some] + around[:, None]).reshape(-1, 3)).reshape(4, -1)
    aside = np.stack([right - left, ahead - behind], axis=1)
    size = np.hypot(*aside.T)
    some, aside = some[size >= SLANT * 0.1], (aside / np.maximum(size, BEFORE * SLANT)[:, None])[size >= SLANT * 0.1]
    if not len(some):
        return rows
    start = place[some].copy()
    start[:, 2] -= np.minimum(value[some], 1.0) / 2
    reach = BESIDE * (value[some] + 1.0)
    way, _ = ways(workpiece, start[:, :2], aside, start[:, 2], np.ones(len(some), dtype=bool), float(reach.max()))
    met = way <= reach
    some = some[met]
    beside = start[met] + np.pad((way[met, None] + BEFORE) * aside[met], ((0, 0), (0, 1)))
    if len(some):
        its = target.distance(beside) > 0
        rows[some[its]] = first_cuts(workpiece, beside[its])
    return rows
