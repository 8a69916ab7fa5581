"""The circle and the ball through points."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

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
