"""Values of the history in words."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import frames
from mnclab.path.listing import figure, point

Matrix = NDArray[np.float64]


def said(name: str, value: Any) -> str:
    """A value of the history in words: angles of the rotary axes in degrees."""
    if name == "rotary" and value is not None:
        return " ".join(f"{axis}{figure(np.degrees(angle), 6)}" for axis, angle in zip("ABC", value, strict=True))
    return _plain(value)


def _plain(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, int | float):
        return figure(float(value), 6)
    if isinstance(value, str):
        return value
    if isinstance(value, tuple) and len(value) == 4 and np.shape(value[-1]) == (4,):
        return described(np.array(value)) or "none"
    if isinstance(value, tuple) and type(value).__str__ is not tuple.__str__:  # it says itself what it is
        return str(value)
    if isinstance(value, tuple):
        return " ".join(figure(each, 4) if isinstance(each, int | float) else _plain(each) for each in value)
    number = getattr(value, "number", None)
    return f"T{number} {value.name}".strip() if number is not None else str(value)


def described(matrix: Matrix) -> str:
    """A frame in words."""
    if frames.is_shift(matrix):
        return f"shift {point(matrix[:3, 3])}"
    linear = matrix[:3, :3]
    scales = np.linalg.norm(linear, axis=0)
    if np.allclose(np.abs(linear), np.diag(scales)):
        signs = "".join(axis for axis, factor in zip("XYZ", np.diag(linear)) if factor < 0)
        said = [f"mirror {signs}"] if signs else []
        said += [f"scale {' '.join(map(figure, scales))}"] if not np.allclose(scales, 1) else []
        return ", ".join(said)
    angle = np.degrees(np.arccos(np.clip((np.trace(linear) - 1) / 2, -1, 1)))
    return f"turn by {figure(angle if linear[1, 0] >= 0 else -angle)}°" if np.allclose(scales, 1) else "turn and scale"
