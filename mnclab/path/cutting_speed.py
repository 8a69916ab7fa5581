"""Constant cutting speed: the nearer a tool is to the spindle axis, the faster the spindle turns.

n = 1000 v / (2 π r) rev/min, with the cutting speed v in m/min and the radius r in mm, but never above a limit.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from mnclab.path.columns import Array


def spindle_speed(surface: ArrayLike, radius: ArrayLike, limit: ArrayLike) -> Array:
    """The spindle speed at radii (n,) of either sign, mm: rev/min, at most `limit`.

    >>> float(spindle_speed(31.41592653589793, -20, 3000))
    250.0
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        speed = 1000 * np.asarray(surface, np.float64) / (2 * np.pi * np.abs(radius))
        return np.asarray(np.fmin(np.where(np.asarray(surface) == 0, 0.0, speed), limit))


def mean_turn(surface: float, radii: Array, limit: float) -> float:
    """Mean time of one turn, min, along a way that is straight between equally distant places at `radii` (k,). A turn
    takes max(2 π |r| / (1000 v), 1 / limit); its integral over r is known, so the mean of a straight way is exact."""
    slope, least = 2 * math.pi / (1000 * surface), 1 / limit
    kink = least / slope
    size = np.abs(radii)
    integral = np.sign(radii) * np.where(size > kink, least * kink + slope * (size**2 - kink**2) / 2, least * size)
    change, here = np.diff(radii), np.maximum(slope * size[:-1], least)
    flat = np.abs(change) < 1e-9 * (1 + size[:-1])
    means = np.where(flat, here, np.diff(integral) / np.where(flat, 1.0, change))
    return float(means.mean())
