"""The worst place found, followed to where it is worst: steps about it that get smaller, over the exact heights."""

from __future__ import annotations

import numpy as np

from mnclab.path.columns import Array
from mnclab.workpiece.difference.columns import columns, off
from mnclab.workpiece.difference.rays import sides
from mnclab.workpiece.difference.target import Target
from mnclab.workpiece.milling.milled import Milled

FINEST = 1e-7  # mm, of a step
STEPS = 200  # at most
ABOUT = np.array([(np.cos(angle), np.sin(angle)) for angle in np.arange(16) * np.pi / 8])
LONG, SHORT = 1.0, 0.3  # of a step: rings of places


def followed(workpiece: Milled, target: Target, place: Array, value: float) -> tuple[Array, float]:
    """From a place (3,) that is off by `value`, mm, + or -, to the worst one near it."""
    sign, best, spot, z = np.sign(value), abs(value), place[:2].copy(), float(place[2])
    step, rings = workpiece.step, np.concatenate([LONG * ABOUT, SHORT * ABOUT])
    for _ in range(STEPS):
        x, y = (spot + step * rings).T
        found, heights = off(target, columns(sides(workpiece, x, y), target.faces(x, y), x, y))
        k = int((sign * found).argmax())
        if sign * found[k] > best + FINEST**1.5:
            best, spot, z = float(sign * found[k]), np.array([x[k], y[k]]), float(heights[k])
        else:
            step /= 3
            if step < FINEST:
                break
    return np.array([*spot, z]), float(sign * best)
