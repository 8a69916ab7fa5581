"""Moves cut up into equal pieces, so that a later piece finds what an earlier one has left."""

from __future__ import annotations

import numpy as np

from mnclab.path.toolpath import Array, Index
from mnclab.workpiece.milling.moves import Moves


def cut_up(moves: Moves, pieces: Index) -> Moves:
    """Each of k moves in so many pieces (k,)."""
    owner = np.repeat(np.arange(len(moves)), pieces)
    first = np.repeat(np.cumsum(pieces) - pieces, pieces)
    count = pieces[owner]
    share = (np.arange(len(owner)) - first) / count
    found = moves[owner]
    start, end = _tips(found, share), _tips(found, share + 1 / count)
    last = share + 1 / count > 1 - 1e-12
    end[last] = found.end[last]
    return Moves(**{**vars(found), "start": start, "end": end, "sweep": found.sweep / count})


def _tips(moves: Moves, share: Array) -> Array:
    """Where the tip of each move is (k, 3) after a share of its way."""
    places = moves.start + (moves.end - moves.start) * share[:, None]
    arc = moves.arc
    centre, spoke = moves.centre[arc], moves.start[arc, :2] - moves.centre[arc]
    cos, sin = np.cos(moves.sweep[arc] * share[arc]), np.sin(moves.sweep[arc] * share[arc])
    places[arc, 0] = centre[:, 0] + spoke[:, 0] * cos - spoke[:, 1] * sin
    places[arc, 1] = centre[:, 1] + spoke[:, 0] * sin + spoke[:, 1] * cos
    return np.asarray(places)
