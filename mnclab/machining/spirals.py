"""Spirals that a control can run: of half circles, each a little wider than the one before. Lengths in mm.

   .-----.        half circles stand on one line through the centre, alternately on its two sides;
 /  .--.   \\      where one ends, the next begins in the same direction:
|  ( ·  )   |
 \\  `--´---´       radius at the i-th crossing of that line: r_0 + i·(r_1 - r_0) / n
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import Contour


def half_circles(
    centre: ArrayLike, begin: float, end: float, count: int, angle: float = 0.0, clockwise: bool = False
) -> Contour:
    """The spiral of `count` half circles from one distance of the centre to another, begun in the direction `angle`."""
    if count < 1 or min(begin, end) < 0:
        raise ValueError(f"a spiral needs a half circle and radii not below 0, got {count}, {begin:g} and {end:g}")
    away = begin + (end - begin) * np.arange(count + 1) / count
    side = np.where(np.arange(count + 1) % 2, -1.0, 1.0) * away
    way = np.array([np.cos(angle), np.sin(angle)])
    bulge = np.full(count + 1, -1.0 if clockwise else 1.0)
    return Contour(np.asarray(centre, dtype=float) + side[:, None] * way, bulge, closed=False)
