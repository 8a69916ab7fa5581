"""The circle through points."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FLAT = 1e-9  # of their spread: points nearer to a line than this lie on it


def circle_through(points: NDArray[np.float64]) -> tuple[float, float, float]:
    """x, y and radius of the circle through three points (3, 2); of more (n, 2), the one that evens them out best.

    Of more than three it has the least squares of (distance² - radius²). A ValueError for points on a line.
    """
    middle = points.mean(axis=0)
    spread = float(np.abs(points - middle).max())
    from_middle = (points - middle) / (spread or 1.0)
    if np.linalg.svd(from_middle, compute_uv=False)[-1] <= FLAT:
        raise ValueError("points on a line")
    columns = np.column_stack([2 * from_middle, np.ones(len(points))])
    (x, y, power), *_ = np.linalg.lstsq(columns, (from_middle**2).sum(axis=1), rcond=None)
    radius = float(np.sqrt(power + x * x + y * y))
    return float(middle[0] + spread * x), float(middle[1] + spread * y), spread * radius
