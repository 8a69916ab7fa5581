"""Whether two programs leave the same part of one blank: by heights beside all walls and all over it, or by the section."""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.comparison.diff import _strokes
from mnclab.comparison.found import Found
from mnclab.comparison.motion import Motion
from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array, Kind
from mnclab.workpiece.blank import Box

STROKES = 6000  # of each path: beside their middles the walls are looked at
GRID = 120  # places of the longer side
MOST = 20_000  # cuts: a part of more takes too long
ROUND = np.array([(0, 0), (1, 0), (0, 1), (-1, 0), (0, -1), (0.7, 0.7), (-0.7, 0.7), (0.7, -0.7), (-0.7, -0.7)])


def not_comparable(runs: tuple[Any, Any], motions: tuple[Motion, Motion]) -> str:
    """Why the parts of two runs are not compared, in words; empty if they can be."""
    stocks = [run.stock for run in runs]
    if None in stocks:
        return "there is no blank in either" if stocks == [None, None] else "only one of them has a blank"
    if max(len(motion.cuts) for motion in motions) > MOST:
        return f"there are more than {MOST:,} cuts"
    if any(isinstance(stock, Box) for stock in stocks) and np.abs(stocks[0].bounds - stocks[1].bounds).max() > 1e-6:
        return "they have two blanks"
    return ""


def part_apart(runs: tuple[Any, Any], motions: tuple[Motion, Motion], tolerance: float) -> str:
    """Where the parts of two runs differ by more than the tolerance, in words; empty if they do not.

    A place of the one part has the height of the other, or what lies within the tolerance about it has.
    """
    parts = [run.workpiece() for run in runs]
    sections = [part.half_section() for part in parts]
    if sections[0] is not None and sections[1] is not None:
        one, other = (Region.of(*section[0]) for section in sections)
        for over, under in ((one, other), (other, one)):
            more = over.difference(under).inset(tolerance / 2)
            if more.loops:
                z, r = more.bounds.mean(axis=0)
                return f"the turned parts differ at Z{z:.3f}, diameter {2 * r:.3f}"
        return ""
    points = np.concatenate([*(_beside(motion, tolerance) for motion in motions), _all_over(parts[0].bounds)])
    off = np.zeros(len(points))
    for a, b in (parts, parts[::-1]):
        for side in (0, 1):
            heights = [_height(part, points, side) for part in (a, b)]
            apart = np.abs(heights[0] - heights[1])
            ask = np.flatnonzero(apart > tolerance)
            if len(ask):
                about = (points[ask, None] + tolerance * ROUND).reshape(-1, 2)
                near = _height(b, about, side).reshape(-1, len(ROUND))
                here = heights[0][ask]
                apart[ask] = np.maximum.reduce([np.zeros(len(ask)), near.min(axis=1) - here, here - near.max(axis=1)])
            off = np.maximum(off, apart)
    worst = int(off.argmax())
    if off[worst] <= tolerance:
        return ""
    return f"the parts differ by {off[worst]:.3f} mm in height at X{points[worst, 0]:.3f} Y{points[worst, 1]:.3f}"


def _height(part: Any, points: Array, side: int) -> Array:
    """The upper or the lower face (m,); where there is no material, far below or above."""
    found = part.faces(points[:, 0], points[:, 1])[1 - side]
    return np.where(np.isnan(found), 1e6 if side else -1e6, found)


def _beside(motion: Motion, tolerance: float) -> Array:
    """Points (m, 2) at the middle of the tool and just within and without its walls."""
    cuts = motion.path[np.isin(motion.path.kind, (Kind.LINE, Kind.ARC))]
    start, end, row = _strokes(cuts, max(tolerance, 1e-3))
    if not len(row):
        return np.empty((0, 2))
    some = np.unique(np.linspace(0, len(row) - 1, STROKES).astype(int))
    start, end, row = start[some], end[some], row[some]
    way = (end - start)[:, :2]
    long = np.linalg.norm(way, axis=1)
    normal = np.where(long[:, None] > 0, way[:, ::-1] * [-1, 1] / np.maximum(long, 1e-12)[:, None], [1.0, 0.0])
    radius = np.abs(cuts.radius[row])[:, None]
    found = []
    for share in (0.21, 0.5, 0.79):
        middle = start[:, :2] + share * way
        beyond = (radius - 1.3 * tolerance, radius + 1.3 * tolerance)
        found += [middle, *(middle + sign * each * normal for sign in (1, -1) for each in beyond)]
    return np.concatenate(found)


def _all_over(bounds: Array) -> Array:
    low, high = bounds[:, :2]
    step = (high - low).max() / GRID
    grid = np.meshgrid(*(np.arange(a + step / 3, b, step) for a, b in zip(low, high)))
    return np.stack([each.ravel() for each in grid], axis=1)


def collided(runs: tuple[Any, Any]) -> list[Found]:
    """Collisions of a kind that only one of two runs has."""
    both = [run.collisions() for run in runs]
    found = []
    for kind in dict.fromkeys(each.kind for each in (*both[0], *both[1])):
        first = [next((each for each in one if each.kind == kind), None) for one in both]
        if None in first:
            rows = tuple(-1 if each is None else each.row for each in first)
            said = tuple("none" if each is None else each.message for each in first)
            depth = max(each.depth for each in first if each is not None)
            found.append(Found("collision", rows, depth, "mm", said))  # type: ignore[arg-type]
    return found
