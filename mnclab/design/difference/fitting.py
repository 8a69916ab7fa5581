"""Circles and lines through measured points."""

from __future__ import annotations

import numpy as np

from mnclab.path.toolpath import Array

ROUNDS = 20


def circle(points: Array, centre: Array) -> tuple[float, float, float]:
    """x, y and radius of the circle with the least squares of distances from points (m, 2); `centre` (2,) is a first guess."""
    x, y = (float(each) for each in centre)
    radius = float(np.hypot(*(points - centre).T).mean())
    for _ in range(ROUNDS):
        dx, dy = (points - [x, y]).T
        out = np.maximum(np.hypot(dx, dy), 1e-12)
        columns = np.stack([dx / out, dy / out, np.ones(len(out))], axis=1)
        by_x, by_y, _ = change = np.linalg.lstsq(columns, out - radius, rcond=None)[0]
        x, y, radius = x + by_x, y + by_y, radius + change[2]
        if np.abs(change).max() < 1e-12:
            break
    return x, y, radius


def line(s: Array, z: Array) -> tuple[float, float]:
    """Height at s = 0 and slope of the line with the least squares of heights z (m,) over places s (m,)."""
    middle = s.mean()
    spread = float(((s - middle) ** 2).sum())
    slope = float(((s - middle) * (z - z.mean())).sum()) / spread if spread > 0 else 0.0
    return float(z.mean() - slope * middle), slope
