"""The circle through points."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

FLAT = 1e-9  # of their spread: points nearer to a line than this lie on it


def circle_through(points: NDArray[np.float64]) -> tuple[float, float, float]:
    """x, y and radius of the circle through three points (3, 2); of more (n, 2), the one that evens them out best.

    Of more than three it has the least squares of (distance² - radius²). A ValueError for points on a line.
    """
    begin = points[0] if len(points) == 3 else points.mean(axis=0)
    spread = float(np.abs(points - begin).max())
    if not spread or np.linalg.svd((points - points.mean(axis=0)) / spread, compute_uv=False)[-1] <= FLAT:
        raise ValueError("points on a line")
    if len(points) == 3:
        (bx, by), (cx, cy) = (points[1:] - begin).tolist()
        b, c, twice = bx * bx + by * by, cx * cx + cy * cy, 2 * (bx * cy - by * cx)
        x, y = (cy * b - by * c) / twice, (bx * c - cx * b) / twice
        radius = math.hypot(x, y)
    else:
        places = (points - begin) / spread
        columns = np.column_stack([2 * places, np.ones(len(points))])
        x, y, power = spread * np.linalg.lstsq(columns, (places**2).sum(axis=1), rcond=None)[0]
        radius = math.sqrt(power * spread + x * x + y * y)
    return float(begin[0] + x), float(begin[1] + y), radius
