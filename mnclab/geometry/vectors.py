"""Vectors of the plane in arrays (…, 2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

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
