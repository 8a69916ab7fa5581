"""What a caller gives, checked: numbers in arrays, or an alarm that says what is wrong."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from mnclab.text.alarm import Alarm

Floats = NDArray[np.float64]
Vector = Floats | Sequence[float]
Points = Floats | Sequence[Vector]
SAME = 1e-9  # mm: nearer points are one
FARTHEST = 1e9  # mm


def numbers(given: object, what: str) -> Floats:
    """An array of finite numbers."""
    try:
        found = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        found = np.array(np.nan)
    if not (np.abs(found) <= FARTHEST).all():
        raise Alarm(f"{what} must be numbers, none beyond {FARTHEST:g}, got {given!r}")
    return found


def number(given: object, what: str) -> float:
    """One finite number."""
    found = numbers(given, what)
    if found.ndim:
        raise Alarm(f"{what} must be one number, got {given!r}")
    return float(found)


def unit(given: object, what: str) -> Floats:
    """Vectors (…, k) brought to the length 1."""
    found = numbers(given, what)
    length = np.linalg.norm(found, axis=-1, keepdims=True) if found.ndim else np.zeros(1)
    if not (found.size and (length > SAME).all()):
        raise Alarm(f"{what} must have a length, got {given!r}")
    return np.asarray(found / length)


def points_of(given: object, least: int, what: str, wide: int = 2, most: int | None = None) -> Floats:
    """Points (n, wide), at least two of them different: of points in space those in the plane take x and y."""
    found = numbers(given, f"the points of {what}")
    if found.ndim != 2 or found.shape[1] not in (wide, 3):
        raise Alarm(f"the points of {what} must be an array (n, {wide}), got one {found.shape}")
    if len(found) < least or most is not None and len(found) > most:
        raise Alarm(f"{what} needs {least} points{'' if most else ' or more'}, got {len(found)}")
    found = found[:, :wide]
    if not np.ptp(found, axis=0).max() > SAME:
        raise Alarm(f"the points of {what} are all one: {found[0].tolist()}")
    return found
