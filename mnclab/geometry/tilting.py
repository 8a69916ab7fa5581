"""Tilted planes: the turn that spatial angles make, and where two rotary axes must stand for a direction of the tool.

A pair of axes is named with the one that carries the other first, seen from the workpiece: "CA" is t = Rz(C) Rx(A) ez. Angles
in rad.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.geometry.frames import Matrix, turn

PAIRS = ("CA", "CB", "AB", "BA")
ABOUT = {"A": "x", "B": "y", "C": "z"}
SINGULAR = 1e-9  # a direction so near to the axis of the carrier does not say where that axis stands

Angles = dict[str, float]


def spatial(a: float, b: float, c: float) -> Matrix:
    """The turn about the fixed axes X, then Y, then Z: its columns are the axes of the tilted system."""
    return turn(c, "z") @ turn(b, "y") @ turn(a, "x")


def angles_of(axes: ArrayLike) -> tuple[float, float, float]:
    """The turns a, b, c about the fixed axes X, Y, Z that `spatial` makes axes (3, 3) of: b within a quarter turn, and a 0 where
    it is one."""
    (xx, xy, _), (yx, yy, _), (zx, zy, zz) = np.asarray(axes, dtype=np.float64)[:3, :3].tolist()
    level = math.hypot(xx, yx)
    if level < SINGULAR:
        return 0.0, math.atan2(-zx, level), math.atan2(-xy, yy)
    return math.atan2(zy, zz), math.atan2(-zx, level), math.atan2(yx, xx)


def of_axes(pair: str, angles: Mapping[str, float]) -> Matrix:
    """The turn that the two rotary axes make, the carrier first."""
    outer, inner = pair[0], pair[1]
    return turn(angles[outer], ABOUT[outer]) @ turn(angles[inner], ABOUT[inner])


def direction(pair: str, angles: Mapping[str, float]) -> NDArray[np.float64]:
    """The direction (3,) of the tool axis, from the tip to the spindle."""
    return np.asarray(of_axes(pair, angles)[:3, 2])


def positions(pair: str, tool_axis: ArrayLike, now: Mapping[str, float]) -> list[Angles]:
    """Both ways to turn the tool axis into a direction (3,), each angle from -pi to pi; first the one with the inner axis from
    0 to pi (or, where the carrier lies across the tool, within a quarter turn). An angle that is free stays as it is `now`.
    """
    x, y, z = np.asarray(tool_axis, dtype=np.float64) / np.linalg.norm(tool_axis)
    outer, inner = pair[0], pair[1]
    if outer == "C":
        tilt = math.atan2(math.hypot(x, y), z)
        free = math.hypot(x, y) < SINGULAR
        swing = math.atan2(x, -y) if inner == "A" else math.atan2(y, x)
        found = [(swing, tilt), (swing + math.pi, -tilt)]
    else:
        along, across = (x, -y) if inner == "B" else (-y, x)  # the axis of the carrier, and to its side
        tilt = math.atan2(along, math.hypot(z, across))
        free = math.hypot(z, across) < SINGULAR
        swing = math.atan2(across, z)
        found = [(swing, tilt), (swing + math.pi, math.pi - tilt)]
    return [{outer: now[outer] if free else wrapped(one), inner: wrapped(two)} for one, two in found]


def nearest(found: list[Angles], now: Mapping[str, float]) -> Angles:
    """The positions with the shortest way of the axis that has the longest; the first of them where several are."""

    def way(angles: Angles) -> float:
        return round(max(abs(angle - now[axis]) for axis, angle in angles.items()), 12)

    return min(found, key=way)


def wrapped(angle: float) -> float:
    """The same angle from -pi (left out) to pi; a rounding error beside -pi is pi."""
    rest = math.remainder(angle, 2 * math.pi)
    return math.pi if rest <= -math.pi + 1e-12 else rest
