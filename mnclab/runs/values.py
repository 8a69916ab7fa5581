"""Values of the history in words: each alone (`said`), or with its field name and unit (`told`)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import frames
from mnclab.path.listing import INCHES, MM, TENTHS, Unit, figure, point
from mnclab.workpiece.blank import is_blank

Matrix = NDArray[np.float64]


#: How values print whose names in the history are short: the words before the number, its unit.
MEASURED = {
    "speed": ("speed", "rev/min"),
    "surface": ("cutting speed", "m/min"),
    "speed_limit": ("speed limit", "rev/min"),
}
WORDS = {
    "turning": ("spindle", {1: "clockwise", -1: "counter-clockwise", 0: "stopped"}),
    "side": ("compensation", {1: "left", -1: "right", 0: "off"}),
}
#: By what the history holds of the unit of a program.
UNITS = {"G20": INCHES, "G70": INCHES, "INCH": TENTHS, "INCH, F in inches": INCHES}
UNTOLD = ("position", "per_rev", "per_time")  # the place is told anyway, how the feed counts is told by its unit


def unit_of(state: Mapping[str, Any]) -> Unit:
    """What lengths of the program counted in then."""
    return UNITS.get(str(state.get("unit")), MM)


def told(values: Mapping[str, Any], state: Mapping[str, Any]) -> list[str]:
    """Some values of a moment in words with units; `state` holds all that was active then."""
    return [_told(name, value, state) for name, value in values.items() if name not in UNTOLD]


def with_feed(changed: Mapping[str, Any], state: Mapping[str, Any]) -> Mapping[str, Any]:
    """What a step changed, with the feed where the same number now counts in another unit."""
    counts_otherwise = not {"per_rev", "per_time"}.isdisjoint(changed) and "feed" in state
    return {"feed": state["feed"], **changed} if counts_otherwise else changed


def _told(name: str, value: Any, state: Mapping[str, Any]) -> str:
    if name in WORDS:
        title, words = WORDS[name]
        return f"{title} {words[int(value)]}"
    title, unit = MEASURED.get(name, (name, ""))
    if name == "feed":
        own = unit_of(state).for_feed(state.get("per_rev"))
        value = value if value is None or state.get("per_time") else value / own.feed
        unit = "s" if state.get("per_time") else own.rate
    if value is None or does_nothing(name, value):
        return f"{title} none"
    if isinstance(value, int | float):
        return f"{title} {short(value)} {'x ' * unit[:1].isdigit()}{unit}".rstrip()  # such as 40 x 0.1 in/min
    return f"{title} {said(name, value, unit_of(state))}".rstrip()


def does_nothing(name: str, value: Any) -> bool:
    """Whether a value is that of something switched off, which need not be told of a machine at rest."""
    still = name in ("side", "rotation angle") and value == 0 or name == "speed_limit" and value == np.inf
    return still or (name.startswith("frame ") and value is not None and np.array_equal(value, frames.IDENTITY))


def short(value: float) -> str:
    """A number with three decimals at most; one that is smaller with three digits."""
    return figure(value, 3) if abs(value) >= 5e-4 or not value else f"{value:.3g}"


def said(name: str, value: Any, unit: Unit = MM) -> str:
    """A value of the history in words: angles of the rotary axes in degrees."""
    if name == "feed" and value is not None:
        value /= unit.feed
    if name == "rotary" and value is not None:
        return " ".join(f"{axis}{figure(np.degrees(angle), 6)}" for axis, angle in zip("ABC", value, strict=True))
    return _plain(value, unit if name in ("position", "pole", "stock") or name.startswith("frame ") else MM)


def _plain(value: Any, unit: Unit) -> str:
    if value is None:
        return ""
    if isinstance(value, int | float):
        return figure(float(value), 6)
    if isinstance(value, str):
        return value
    if isinstance(value, tuple) and len(value) == 4 and np.shape(value[-1]) == (4,):
        return described(np.array(value), unit) or "none"
    if is_blank(value):
        return " to ".join(point(corner, unit) for corner in value.bounds)
    if hasattr(value, "corners"):  # of a blank of which half may be missing
        return " to ".join(point(corner, unit) for corner in value.corners)
    if isinstance(value, tuple) and type(value).__str__ is not tuple.__str__:  # it says itself what it is
        return str(value)
    if isinstance(value, tuple):
        return " ".join(unit.figure(each) if isinstance(each, int | float) else _plain(each, unit) for each in value)
    number = getattr(value, "number", None)
    return f"T{number} {value.name}".strip() if number is not None else str(value)


def described(matrix: Matrix, unit: Unit = MM) -> str:
    """A frame in words."""
    if frames.is_shift(matrix):
        return f"shift {point(matrix[:3, 3], unit)}"
    linear = matrix[:3, :3]
    scales = np.linalg.norm(linear, axis=0)
    if np.allclose(np.abs(linear), np.diag(scales)):
        signs = "".join(axis for axis, factor in zip("XYZ", np.diag(linear)) if factor < 0)
        said = [f"mirror {signs}"] if signs else []
        said += [f"scale {' '.join(map(figure, scales))}"] if not np.allclose(scales, 1) else []
        return ", ".join(said)
    angle = np.degrees(np.arccos(np.clip((np.trace(linear) - 1) / 2, -1, 1)))
    return f"turn by {figure(angle if linear[1, 0] >= 0 else -angle)}°" if np.allclose(scales, 1) else "turn and scale"
