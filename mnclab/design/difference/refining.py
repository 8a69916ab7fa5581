"""The worst places found, followed to where they are worst: steps about them that get smaller, over the exact heights."""

from __future__ import annotations

import numpy as np

from mnclab.design.difference.columns import columns, off
from mnclab.design.difference.rays import sides
from mnclab.design.difference.target import Target
from mnclab.path.toolpath import Array
from mnclab.workpiece.milling.milled import Milled

FINEST = 1e-7  # mm, of a step
LEAST = 1e-10  # mm: less is no gain
STEPS = 100  # at most
RING = np.array([(np.cos(angle), np.sin(angle)) for angle in np.arange(12) * np.pi / 6])
ABOUT = np.concatenate([RING, 0.3 * RING])  # of a step


def followed(workpiece: Milled, target: Target, places: Array, values: Array) -> tuple[Array, float]:
    """From places (n, 3) that are off by `values` (n,) mm, all + or all -, to the worst one near one of them."""
    sign, best, at = float(np.sign(values[0])), np.abs(values), places.copy()
    step = np.full(len(at), workpiece.step)
    every = np.arange(len(at))
    for _ in range(STEPS):
        x, y = (at[:, None, :2] + step[:, None, None] * ABOUT).reshape(-1, 2).T
        found, heights = off(target, columns(sides(workpiece, x, y), target.faces(x, y), x, y))
        found, spots = sign * found.reshape(len(at), -1), np.stack([x, y, heights], axis=1).reshape(len(at), -1, 3)
        k = found.argmax(axis=1)
        better = found[every, k] > best + LEAST
        best[better], at[better] = found[every, k][better], spots[every, k][better]
        step[~better] /= 3
        if step.max() < FINEST:
            break
    worst = int(best.argmax())
    return at[worst], sign * float(best[worst])
