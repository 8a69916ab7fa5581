"""Vectors of the plane in arrays (…, 2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


def left(vectors: Floats) -> Floats:
    """Vectors `(…, 2)` turned a quarter to the left."""
    return np.stack([-vectors[..., 1], vectors[..., 0]], axis=-1)


def cross(a: Floats, b: Floats) -> Floats:
    """The third component of a × b, for vectors `(…, 2)`."""
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def dot(a: Floats, b: Floats) -> Floats:
    """The scalar product of vectors `(…, 2)`."""
    return np.asarray(a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1])


def length_of(vectors: Floats) -> Floats:
    """The lengths of vectors `(…, 2)`."""
    return np.hypot(vectors[..., 0], vectors[..., 1])


def unit_of(vectors: Floats) -> Floats:
    """Vectors `(…, 2)` brought to the length 1; those without length stay so."""
    return np.asarray(vectors / np.maximum(length_of(vectors), 1e-300)[..., None])


def turned(vectors: Floats, angle: ArrayLike) -> Floats:
    """Vectors `(…, 2)` turned counter-clockwise by an angle (rad), or each by its own."""
    c, s = np.cos(angle), np.sin(angle)
    x, y = vectors[..., 0], vectors[..., 1]
    return np.stack([c * x - s * y, s * x + c * y], axis=-1)


def at_angle(angle: ArrayLike) -> Floats:
    """Unit vectors `(…, 2)` in the direction of angles (rad)."""
    return np.stack([np.cos(angle), np.sin(angle)], axis=-1)
