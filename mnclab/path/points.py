"""Arcs and helices as points within a chord error, the last step before pixels."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.columns import Array, Index
from mnclab.path.kinds import Kind
from mnclab.path.places import on_arcs, spokes

if TYPE_CHECKING:
    from mnclab.path.toolpath import Toolpath

FINEST = 100_000  # pieces of one arc at most


def points(path: Toolpath, chord_error: float = 0.01) -> tuple[Array, Index]:
    """Points (m, 3) along the motion rows and the row (m,) each belongs to.

    The first point is where the first motion begins; then every row ends with its own end point. An arc of radius r
    is cut into pieces of at most `2 acos(1 - e / r)`, whose sagitta is the chord error e (mm).
    """
    if not chord_error > 0:
        raise ValueError(f"chord_error must be greater than 0 mm, got {chord_error:g}")
    rows = np.flatnonzero(path.is_motion)
    if not len(rows):
        return np.empty((0, 3)), np.empty(0, dtype=np.int64)
    every = len(rows) == len(path)
    end = path.end if every else path.end[rows]
    arc = path.kind[rows] == Kind.ARC
    if not arc.any():
        return np.concatenate([path.start[rows[:1]], end]), np.concatenate([rows[:1], rows])
    radius = np.zeros(len(rows))
    radius[arc] = np.linalg.norm(spokes(path, rows[arc])[0], axis=1)
    step = 2 * np.arccos(np.clip(1 - chord_error / np.maximum(radius, chord_error), 0.0, 1.0))
    pieces = np.where(arc, np.ceil(np.abs(path.sweep[rows]) / np.maximum(step, 1e-6)), 1)
    pieces = pieces.clip(1, FINEST).astype(np.int64)
    row = np.repeat(np.arange(len(rows)), pieces)
    k = np.arange(len(row)) - np.repeat(np.cumsum(pieces) - pieces, pieces) + 1
    share = k / pieces[row]
    xyz = end[row]
    bent = np.flatnonzero(arc[row] & (k < pieces[row]))
    if len(bent):
        xyz[bent] = on_arcs(path, rows[row[bent]], share[bent])
    return np.concatenate([path.start[rows[:1]], xyz]), np.concatenate([rows[:1], rows[row]])
