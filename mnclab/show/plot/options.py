"""The options of a figure: one that it does not have, or of another kind than it says, is an Alarm that names what it takes."""

from __future__ import annotations

from collections.abc import Mapping
from inspect import Parameter
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, check_point, near_option, shown, whole

ADDED = ("size", "size_mm", "legend")  # of every figure
BOUNDS = {"width": (1.0, 100.0), "columns": (1, 100), "most": (0, None)}  # of numbers, wherever they are options
#: What shows that an object is of its kind, and how an alarm calls that kind, by the annotation of the option.
KINDS = {
    "Toolpath | None": ("is_motion", "a toolpath"),
    "Profile | None": ("pieces", "a profile"),
    "Workpiece | None": ("removed", "a workpiece"),
    "Blank | None": ("bounds", "a blank"),
    "Felt | None": ("places", "what a probe felt"),
    "Limits | None": ("rapid_motion", "limits of a machine"),
    "Sequence[Alarm]": ("severity", "alarms"),
    "Sequence[Place]": ("xyz", "places"),
    "Sequence[Overlay]": ("draw", "overlays"),
    "Iterable[Collision]": ("place", "those of a run"),
}


def check_options(options: Mapping[str, Any], known: Mapping[str, Parameter]) -> None:
    """An Alarm for an option that a figure does not have, with the nearest, or one that is not what it must be."""
    names = list(dict.fromkeys([*known, *ADDED]))
    for name, value in options.items():
        if name not in names:
            raise Alarm(f"this figure has no option {name}", hint=near_option(name, names))
        what = str(known[name].annotation) if name in known else "bool"
        if value is not None or "None" not in what:
            _check(name, value, what.removesuffix(" | None"), what)


def _check(name: str, value: Any, what: str, annotation: str) -> None:
    if what == "bool" and not (isinstance(value, bool | int | np.bool_) and value in (0, 1)):
        raise Alarm(f"{name} must be True or False, got {shown(value)}")
    if what in ("float", "int"):
        least, most = BOUNDS.get(name, (None, None))
        check_number(value, "the width of a picture (inches)" if name == "width" else name,
                     at_least=least, at_most=most, endless=what == "float")  # fmt: skip
        if what == "int":
            whole(value, name)
    if what == "str" and isinstance(value, np.ndarray):
        raise Alarm(f"{name} must be a text, got {shown(value)}")
    if what == "Axes" and not isinstance(value, Axes):
        raise Alarm(f"ax must be axes of matplotlib, got {shown(value)}")
    if what == "ghost.Box":
        _must(isinstance(value, tuple | list) and len(value) == 2, f"{name} must be two corners of a picture", value)
        for corner in value:
            check_point(corner, f"a corner of {name}")
    if annotation in KINDS:
        shows, called = KINDS[annotation]
        several = "[" in annotation
        right = isinstance(value, tuple | list) and all(hasattr(each, shows) for each in value)
        _must(right if several else hasattr(value, shows), f"{name} must be {called}", value)
    if what.startswith("Mapping["):
        _must(isinstance(value, Mapping), f"{name} must be a dict", value)


def _must(right: bool, said: str, value: Any) -> None:
    if not right:
        raise Alarm(f"{said}, got {shown(value)}")
