"""A difference of two programs: those in a row as one, and the block that says it. Lengths in mm."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from mnclab.comparison.motion import NO_WAY, Motion
from mnclab.path.listing import figure
from mnclab.path.toolpath import Array, Index, Kind, Toolpath

RATE = 0.005  # of a feed, a speed or a dwell: as much goes by rounding in inches
CENTRE = 20  # as far apart may be the centres of arcs, in tolerances of their ends
NONE = "none before this block"
AHEAD = 4  # rows of a contour: as far as compensation looks
NEAR = 2  # tolerances: so far off its radius a tool still touches a corner


class Found(NamedTuple):
    """One difference: its `kind`, `rows` of both paths (-1: there is none), by how much, what each has, for how many moves."""

    kind: str
    rows: tuple[int, int]
    amount: float
    unit: str
    values: tuple[str, str]
    moves: int = 1


def rows_of(one: Motion, i: int, other: Motion, j: int) -> tuple[int, int]:
    """The rows of two cuts by their ranks."""
    return int(one.row[one.cuts[i]]), int(other.row[other.cuts[j]])


def tilts(one: Motion, i: int, other: Motion, j: int) -> tuple[str, str]:
    """How the tools stand at the end of the blocks of two moves, in words, and how far they lean from each other."""
    paths, moves = (one.path, other.path), (one.row[i], other.row[j])
    rows = [int(np.searchsorted(path.step, path.step[row], "right")) - 1 for path, row in zip(paths, moves)]
    a, b = (path.directions[row] for path, row in zip(paths, rows))
    turned = np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b))
    angles = (zip("ABC", np.degrees(path.rotary[row]).tolist()) for path, row in zip(paths, rows))
    here, there = (" ".join(f"{name}{figure(angle)}" for name, angle in each if angle) or "upright" for each in angles)
    return f"tool {here}", f"{there}, tilted otherwise by {figure(float(turned), 3)}°" if turned > 0 else there


def grouped(
    kind: str, one: Motion, i: Index, other: Motion, j: Index, said: Callable[[int], tuple[str, str]], off: Any = None,
    unit: str = "mm", values: tuple[Array, ...] = (),
) -> list[Found]:  # fmt: skip
    """Differences of a kind at cuts by their ranks (k,): those that follow each other, with the same `values`, are one."""
    if not len(i):
        return []
    off = np.zeros(len(i)) if off is None else off
    new = (np.diff(i) != 1) | (np.diff(j) != 1)
    for each in values:
        new |= (each[1:] != each[:-1]) & ~(np.isnan(each[1:]) & np.isnan(each[:-1]))
    first = np.flatnonzero(np.append(True, new))
    moves = np.diff(np.append(first, len(i)))
    return [
        Found(kind, rows_of(one, int(i[k]), other, int(j[k])), float(much), unit, said(k), many)
        for k, much, many in zip(first.tolist(), off[first].tolist(), moves.tolist())
    ]


def from_where(one: Motion, other: Motion, rows: tuple[int, int], tolerance: float) -> tuple[int, int]:
    """The rows from which on two moves are not the same that are made of several blocks, which may be alike at first."""
    looks = [motion.last[np.searchsorted(motion.row, row, "right") - 1] - row + 1 for motion, row in zip((one, other), rows)]
    return first_apart((one.path, other.path), rows, tolerance, int(max(looks)))


def first_apart(
    paths: tuple[Toolpath, Toolpath], rows: tuple[int, int], tolerance: float, look: int, sides: bool = False
) -> tuple[int, int]:
    """The first two of so many rows of two paths that are not the same, with their `sides` if asked, else the first of all."""
    found = []
    for path, row in zip(paths, rows):
        some = path[row : row + look]
        found.append(row + np.flatnonzero(some.is_motion & (some.lengths > NO_WAY)))
    many = min(map(len, found))
    a, b = (each[:many] for each in found)
    one, other = paths
    odd = np.linalg.norm(one.end[a] - other.end[b], axis=1) > tolerance
    odd |= (one.kind[a] != other.kind[b]) | (np.sign(one.sweep[a]) != np.sign(other.sweep[b]))
    odd |= sides & (one.side[a] != other.side[b])
    odd |= np.linalg.norm(np.nan_to_num(one.centre[a] - other.centre[b]), axis=1) > CENTRE * tolerance
    return (int(a[odd.argmax()]), int(b[odd.argmax()])) if odd.any() else rows


# Of compensated cuts that differ the block that says so: where the tool leaves a block, the contour of the next one decides.

def of_contour(found: Found, one: Motion, other: Motion, tolerance: float) -> Found:
    """What was found in cuts at the blocks whose contour is not the same."""
    rows = _rows(one, other, found.rows, tolerance)
    if min(rows) >= 0 and one.path.side[rows[0]] and other.path.side[rows[1]]:
        ends = (motion.contour.end[_row(motion.contour, motion.path.step[row])] for motion, row in zip((one, other), rows))
        off = float(np.linalg.norm(np.subtract(*ends)))
        if NONE in found.values and off <= tolerance:  # one block, which corners make more cuts of
            return found._replace(rows=rows, values=("", ""), amount=float("nan"), moves=1)
        if rows != found.rows and not any(found.values):  # it differs by what it says, not by what the tool makes of the corner
            return found._replace(rows=rows, amount=off if off > tolerance else found.amount)
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
