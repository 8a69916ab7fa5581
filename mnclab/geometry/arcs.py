"""Arcs in a plane: the centre from a radius, the sweep from a centre.

Points are (..., 2) in mm in the axes of the plane, angles in radians, positive counter-clockwise. There are two of each:
for a million arcs, and for one in plain numbers, to the last bit the same (so `arctan2` and `hypot` are numpy's).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Pair = Sequence[float]
FULL = 1e-3  # mm: a start and an end that are closer are a whole turn
STRAIGHT = 1e-6  # mm: an arc that is flatter is a line


def sweep(start: ArrayLike, end: ArrayLike, centre: ArrayLike, sense: ArrayLike) -> Array:
    """Angle (...) from start to end about centre, in the sense +1 (counter-clockwise) or -1."""
    start, end, centre = (np.asarray(p, dtype=np.float64) for p in (start, end, centre))
    a, b = start - centre, end - centre
    angle = np.arctan2(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0], (a * b).sum(axis=-1))
    sense = np.asarray(sense, dtype=np.float64)
    angle = np.where(angle * sense < 0, angle + sense * 2 * np.pi, angle)
    return np.where(np.hypot(*np.moveaxis(end - start, -1, 0)) < FULL, sense * 2 * np.pi, angle)


def sweep_of_one(start: Pair, end: Pair, centre: Pair, sense: int) -> float:
    """`sweep` of one arc."""
    (sx, sy), (ex, ey), (cx, cy) = start, end, centre
    ax, ay, bx, by = sx - cx, sy - cy, ex - cx, ey - cy
    if math.hypot(ex - sx, ey - sy) < FULL:
        return sense * 2 * math.pi
    angle = float(np.arctan2(ax * by - ay * bx, ax * bx + ay * by))
    return angle + sense * 2 * math.pi if angle * sense < 0 else angle


def centre_from_radius(start: ArrayLike, end: ArrayLike, radius: ArrayLike, sense: ArrayLike) -> tuple[Array, Array]:
    """Centre (..., 2) of the arc of a signed radius, and by how much |radius| falls short of half the chord.

    With s, e start and end, d = e - s, n = d turned by +90 degrees: centre = (s + e)/2 ± sqrt(R² - |d|²/4) n/|d|,
    plus for a counter-clockwise arc below 180 degrees; a negative radius is the arc above 180 degrees. Where the radius
    is too small the centre is the middle of the chord and the shortage is positive.
    """
    start, end = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    radius, sense = np.asarray(radius, dtype=np.float64), np.asarray(sense, dtype=np.float64)
    d = end - start
    half = np.hypot(d[..., 0], d[..., 1]) / 2
    # (R - h)(R + h) keeps digits that R² - h² would lose near half a turn
    height = np.sqrt(np.maximum((np.abs(radius) - half) * (np.abs(radius) + half), 0.0))
    side = sense * np.sign(radius) * height / np.where(half > 0, 2 * half, 1.0)
    normal = np.stack([-d[..., 1], d[..., 0]], axis=-1)
    return (start + end) / 2 + side[..., None] * normal, half - np.abs(radius)


def centre_of_one(start: Pair, end: Pair, radius: float, sense: int) -> tuple[tuple[float, float], float]:
    """`centre_from_radius` of one arc."""
    (sx, sy), (ex, ey) = start, end
    dx, dy = ex - sx, ey - sy
    half = float(np.hypot(dx, dy)) / 2
    height = math.sqrt(max((abs(radius) - half) * (abs(radius) + half), 0.0))
    side = sense * float(np.sign(radius)) * height / (2 * half if half > 0 else 1.0)
    return ((sx + ex) / 2 + side * -dy, (sy + ey) / 2 + side * dx), half - abs(radius)


def tangent_arc_of_one(start: Pair, end: Pair, travel: Pair) -> tuple[tuple[float, float], int] | None:
    """Centre and sense of the arc from start to end that begins along the unit vector `travel`; None if there is none.

    With alpha from the travel to the chord d, the radius is |d| / (2 sin alpha). The sense is 0 for a straight line: where
    the end lies ahead, within a millionth of a millimetre; straight behind the start no arc leads there.
    """
    dx, dy = end[0] - start[0], end[1] - start[1]
    across, along = travel[0] * dy - travel[1] * dx, travel[0] * dx + travel[1] * dy  # |d| sin alpha, |d| cos alpha
    if abs(across) / 4 <= STRAIGHT:  # the height of a flat arc is |d| alpha / 4
        return ((math.nan, math.nan), 0) if along > 0 else None
    radius = (dx * dx + dy * dy) / (2 * across)  # positive to the left
    return (start[0] - radius * travel[1], start[1] + radius * travel[0]), 1 if across > 0 else -1


# The circle and the ball through points.

Floats = NDArray[np.float64]
FLAT = 1e-9  # of their spread: points nearer to a line than this lie on it


def circle_through(points: Floats) -> tuple[float, float, float]:
    """x, y and radius of the circle through three points (3, 2); of more (n, 2), the one that evens them out best.

    Of more than three it has the least squares of (distance² - radius²). A ValueError for points on a line.
    """
    if len(points) != 3:
        (x, y), radius = round_through(points)
        return float(x), float(y), radius
    begin = points[0]
    _refuse_flat(points, float(np.abs(points - begin).max()))
    (bx, by), (cx, cy) = (points[1:] - begin).tolist()
    b, c, twice = bx * bx + by * by, cx * cx + cy * cy, 2 * (bx * cy - by * cx)
    x, y = (cy * b - by * c) / twice, (bx * c - cx * b) / twice
    return float(begin[0] + x), float(begin[1] + y), math.hypot(x, y)


def round_through(points: Floats) -> tuple[Floats, float]:
    """Centre (k,) and radius of the circle or ball with the least squares of (distance² - radius²) to points (n, k), n > k.

    A ValueError for points on a line, or in space on a plane.
    """
    middle = points.mean(axis=0)
    spread = float(np.abs(points - middle).max())
    _refuse_flat(points, spread)
    places = (points - middle) / spread
    columns = np.column_stack([2 * places, np.ones(len(points))])
    found = np.linalg.lstsq(columns, (places**2).sum(axis=1), rcond=None)[0]
    return middle + spread * found[:-1], spread * math.sqrt(found[-1] + found[:-1] @ found[:-1])


def _refuse_flat(points: Floats, spread: float) -> None:
    if not spread or np.linalg.svd((points - points.mean(axis=0)) / spread, compute_uv=False)[-1] <= FLAT:
        raise ValueError("points on a line")
