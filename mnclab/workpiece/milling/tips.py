"""Where the tips of a cutter went: for every cell the lowest place that one of them had over it, and whose move it was.

A move is cut into pieces no longer than half a cell; the middle of each stands for it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mnclab.path.toolpath import Array, Index
from mnclab.workpiece.milling.moves import STILL, Moves
from mnclab.workpiece.milling.raster import Raster

PIECES = 2.0  # of a move for each cell that it goes on
AT_ONCE = 1 << 17  # pieces that are laid down together


@dataclass(frozen=True)
class Tips:
    """`low` (ny + 2 margin, nx + 2 margin) mm, infinite where no tip came; `move` the same cells, -1 there."""

    margin: int
    low: NDArray[np.float32]
    move: NDArray[np.int32]


def tips_of(raster: Raster, moves: Moves, which: Index, margin: int) -> Tips:
    """The tips of some moves over a raster and `margin` cells around it; the first of equally low ones counts."""
    shape = raster.shape[0] + 2 * margin, raster.shape[1] + 2 * margin
    low, move = np.full(shape, np.inf, dtype=np.float32), np.full(shape, -1, dtype=np.int32)
    flat_low, flat_move = low.reshape(-1), move.reshape(-1)
    origin = np.array(raster.low) - margin * raster.step
    for chunk, own, x, y, z in _pieces(moves, which, raster.step):
        i, j = np.floor((x - origin[0]) / raster.step), np.floor((y - origin[1]) / raster.step)
        inside = (i >= 0) & (i < shape[1]) & (j >= 0) & (j < shape[0])
        cell = (j * shape[1] + i)[inside].astype(np.int64)
        z, own = z[inside].astype(np.float32), own[inside]
        lower = z < flat_low[cell]
        cell, z, own = cell[lower], z[lower], own[lower]
        np.minimum.at(flat_low, cell, z)
        lowest = z == flat_low[cell]
        flat_move[cell[lowest][::-1]] = chunk[own[lowest][::-1]]
    return Tips(margin, low, move)


def engaged(raster: Raster, moves: Moves, material: Array, margin: int) -> Array:
    """The way of each move (k,) times the depth of its tip in `material` (ny, nx), mm²; up to `margin` cells beside it too."""
    found, step = np.zeros(len(moves)), raster.step
    for chunk, own, x, y, z in _pieces(moves, np.arange(len(moves)), step):
        i, j = np.floor((x - raster.low[0]) / step), np.floor((y - raster.low[1]) / step)
        on_i, on_j = (np.clip(at, 0, n - 1).astype(np.int64) for at, n in ((i, raster.shape[1]), (j, raster.shape[0])))
        near = np.maximum(np.abs(i - on_i), np.abs(j - on_j)) <= margin
        depth = np.where(near, np.maximum(material[on_j, on_i] - z, 0.0), 0.0)
        length = np.hypot(_flat(moves[chunk]), moves.end[chunk, 2] - moves.start[chunk, 2])
        found[chunk] = np.bincount(own, depth, len(chunk)) * length / np.bincount(own, minlength=len(chunk))
    return found


def _pieces(moves: Moves, which: Index, step: float) -> Iterator[tuple[Index, Index, Array, Array, Array]]:
    """Some moves, which of them each piece belongs to (k,), x, y and z of its middle (k,)."""
    for many in range(0, len(which), AT_ONCE):
        part = which[many : many + AT_ONCE]
        count = _count(moves, part, step)
        ends = np.cumsum(count)
        first = 0
        while first < len(part):
            done = ends[first - 1] if first else 0
            last = max(int(np.searchsorted(ends, done + AT_ONCE, "right")), first + 1)
            chunk, counts = part[first:last], count[first:last]
            own = np.repeat(np.arange(last - first), counts)
            share = (np.arange(len(own)) - np.repeat(ends[first:last] - counts - done, counts) + 0.5) / counts[own]
            yield chunk, own, *_places(moves[chunk], own, share)
            first = last


def _count(moves: Moves, which: Index, step: float) -> Index:
    """Into how many pieces each move is cut (k,); one that stands in the plane is one."""
    flat, rise = _flat(moves[which]), moves.end[which, 2] - moves.start[which, 2]
    return np.maximum(np.ceil(np.where(flat > STILL, np.hypot(flat, rise), 0.0) / step * PIECES), 1).astype(np.int64)


def _flat(moves: Moves) -> Array:
    """How far each move goes in the plane (k,), mm."""
    way = moves.end - moves.start
    flat = np.hypot(way[:, 0], way[:, 1])
    if moves.arc.any():
        spoke = moves.start[moves.arc, :2] - moves.centre[moves.arc]
        flat[moves.arc] = np.hypot(spoke[:, 0], spoke[:, 1]) * np.abs(moves.sweep[moves.arc])
    return flat


def _places(moves: Moves, own: Index, share: Array) -> tuple[Array, Array, Array]:
    """x, y and z (k,) of tips at shares of their moves; what only goes up or down stands at its lower end."""
    way = moves.end - moves.start
    x, y, z = (moves.start[own, axis] + way[own, axis] * share for axis in range(3))
    still = ~moves.arc & (np.hypot(way[:, 0], way[:, 1]) <= STILL)
    if still.any():
        plunged = still[own]
        z[plunged] = moves.low[own[plunged]]
    if moves.arc.any():
        on = moves.arc[own]
        arc, centre = own[on], moves.centre
        spoke = moves.start[:, :2] - centre
        angle = np.arctan2(spoke[:, 1], spoke[:, 0])[arc] + moves.sweep[arc] * share[on]
        out = np.hypot(spoke[:, 0], spoke[:, 1])[arc]
        x[on], y[on] = centre[arc, 0] + out * np.cos(angle), centre[arc, 1] + out * np.sin(angle)
    return x, y, z
