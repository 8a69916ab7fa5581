"""Of compensated cuts that differ the block that says so: where the tool leaves a block, the contour of the next one decides."""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.comparison.found import NONE, Found, first_apart
from mnclab.comparison.motion import Motion
from mnclab.path.toolpath import Array, Kind, Toolpath

AHEAD = 4  # rows of a contour: as far as compensation looks
NEAR = 2  # tolerances: so far off its radius a tool still touches a corner


def of_contour(found: Found, one: Motion, other: Motion, tolerance: float) -> Found:
    """What was found in cuts at the blocks whose contour is not the same."""
    rows = _rows(one, other, found.rows, tolerance)
    if NONE in found.values and min(rows) >= 0 and one.path.side[rows[0]] and other.path.side[rows[1]]:
        ends = (motion.contour.end[_row(motion.contour, motion.path.step[row])] for motion, row in zip((one, other), rows))
        if np.linalg.norm(np.subtract(*ends)) <= tolerance:  # one block, which corners make more cuts of
            return found._replace(rows=rows, values=("", ""), amount=float("nan"), moves=1)
    return found._replace(rows=rows)


def _rows(one: Motion, other: Motion, rows: tuple[int, int], tolerance: float) -> tuple[int, int]:
    """The rows of the blocks whose contour is not the same, from rows of both paths on that are not."""
    motions = one, other
    sides = [min(rows) >= 0 and motion.path.side[row] != 0 for motion, row in zip(motions, rows)]
    if not any(sides):
        return rows
    at = [_row(motion.contour, motion.path.step[row]) for motion, row in zip(motions, rows)]
    if all(sides):
        found = first_apart((one.contour, other.contour), (at[0], at[1]), tolerance, AHEAD, sides=True)
        a, b = (_row(motion.path, motion.contour.step[row]) for motion, row in zip(motions, found))
        return (a, b) if a >= rows[0] or one.path.step[a] == one.path.step[rows[0]] else rows
    k = sides.index(True)  # the other one has the way of the centre
    contour, bare, row = motions[k].contour, motions[1 - k].path, rows[1 - k]
    behind, corner = _next(bare, row), contour.end[at[k]]
    off = np.array([_beside(bare, row, corner), np.linalg.norm(bare.end[row] - corner), _beside(bare, behind, corner)])
    right, *touched = np.abs(off - abs(motions[k].path.radius[rows[k]])) <= NEAR * tolerance
    if not (right and any(touched) and _alike(contour, at[k], bare, row, tolerance)):
        return rows
    there = _row(motions[k].path, contour.step[_next(contour, at[k])])
    return (there, behind) if k == 0 else (behind, there)


def _alike(contour: Toolpath, at: int, bare: Toolpath, row: int, tolerance: float) -> bool:
    """Whether both are lines, or both arcs about one centre the same way round."""
    if contour.kind[at] != bare.kind[row] or contour.kind[at] != Kind.ARC:
        return bool(contour.kind[at] == bare.kind[row])
    off = np.linalg.norm(contour.centre[at] - bare.centre[row])
    return bool(contour.sweep[at] * bare.sweep[row] > 0 and off <= NEAR * tolerance)


def _row(path: Toolpath, step: Any) -> int:
    """The last row of a step, behind what leads there about a corner."""
    return max(int(np.searchsorted(path.step, step, "right")) - 1, 0)


def _next(path: Toolpath, row: int) -> int:
    """The motion behind a row, itself where there is none."""
    behind = np.flatnonzero(path.is_motion[row + 1 :])
    return row + 1 + int(behind[0]) if len(behind) else row


def _beside(path: Toolpath, row: int, place: Array) -> float:
    """How far a place is from the whole line or circle of a row, mm."""
    if path.kind[row] == Kind.ARC:
        return abs(float(np.linalg.norm(place - path.centre[row]) - np.linalg.norm(path.end[row] - path.centre[row])))
    way = path.end[row] - path.start[row]
    return float(np.linalg.norm(np.cross(way, place - path.start[row])) / max(float(np.linalg.norm(way)), 1e-12))
