"""What a drawing says of a feature, and a measuring room writes down: names, nominal values, tolerances."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown

Tolerance = float | tuple[float, float] | str

KINDS = ("length", "diameter", "radius", "depth", "angle", "chamfer", "thread", "place")


class Measure(NamedTuple):
    """`name` says what of the feature, `nominal` how much: mm, of an "angle" degrees. `kind` is one of `KINDS`.

    `limits` are the lower and the upper deviation that are allowed, mm, None where the drawing gives none; `fit` is how
    they are written if by a class of ISO 286 ("H7"). `text` stands for the number where it is more than one ("M8x1").
    """

    name: str
    nominal: float
    kind: str = "length"
    limits: tuple[float, float] | None = None
    fit: str = ""
    text: str = ""

    @property
    def value(self) -> str:
        """How much, in words."""
        return self.text or f"{'⌀' if self.kind == 'diameter' else ''}{self.nominal:.6g}{'°' * (self.kind == 'angle')}"

    @property
    def allowed(self) -> str:
        """The deviations that are allowed, in words."""
        if self.limits is None or self.fit:
            return self.fit
        low, high = self.limits
        return f"±{high:.4g}" if low == -high else f"{low:+.4g} {high:+.4g}"


#: ISO 286-1: upper ends of the ranges of sizes, mm; standard tolerances of the grades IT5 to IT12, and how far the zones d
#: to g stand off the nominal size, µm.
RANGES = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
GRADES = {
    5: (4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27),
    6: (6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40),
    7: (10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63),
    8: (14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97),
    9: (25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140, 155),
    10: (40, 48, 58, 70, 84, 100, 120, 140, 160, 185, 210, 230, 250),
    11: (60, 75, 90, 110, 130, 160, 190, 220, 250, 290, 320, 360, 400),
    12: (100, 120, 150, 180, 210, 250, 300, 350, 400, 460, 520, 570, 630),
}
ZONES = {
    "d": (20, 30, 40, 50, 65, 80, 100, 120, 145, 170, 190, 210, 230),
    "e": (14, 20, 25, 32, 40, 50, 60, 72, 85, 100, 110, 125, 135),
    "f": (6, 10, 13, 16, 20, 25, 30, 36, 43, 50, 56, 62, 68),
    "g": (2, 4, 5, 6, 7, 9, 10, 12, 14, 15, 17, 18, 20),
    "h": (0,) * 13,
}
CLASS = re.compile(r"([D-Hd-h]|JS|js)(\d{1,2})")


def limits_of(tolerance: Any, nominal: float, what: str) -> tuple[float, float]:
    """The lower and the upper deviation, mm, of a tolerance: ± a number, two numbers in any order, or a class of ISO 286.

    Classes are D to H and JS for holes, d to h and js for shafts, grades 5 to 12, sizes up to 500 mm.
    """
    if isinstance(tolerance, str):
        return _of_class(tolerance, nominal, what)
    if isinstance(tolerance, tuple | list) and len(tolerance) == 2:
        for each in tolerance:
            check_number(each, f"the tolerance of {what} (mm)")
        return float(min(tolerance)), float(max(tolerance))
    if isinstance(tolerance, tuple | list | Mapping):
        raise Alarm(f"the tolerance of {what} must be ± a number, two numbers or a class such as H7, got {shown(tolerance)}")
    check_number(tolerance, f"the tolerance of {what} (mm)", at_least=0)
    return -float(tolerance), float(tolerance)


def _of_class(written: str, nominal: float, what: str) -> tuple[float, float]:
    found = CLASS.fullmatch(written.strip())
    if not found or int(found[2]) not in GRADES:
        known = "D to H or JS for a hole, d to h or js for a shaft, with a grade from 5 to 12"
        raise Alarm(f"the tolerance class of {what} must be {known}, got {shown(written)}", hint="H7")
    if not 0 < nominal <= RANGES[-1]:
        raise Alarm(f"a tolerance class is for sizes up to {RANGES[-1]} mm, {what} is {nominal:g}")
    place = bisect_left(RANGES, nominal)
    wide = GRADES[int(found[2])][place] / 1000
    if found[1].lower() == "js":
        return -wide / 2, wide / 2
    off = ZONES[found[1].lower()][place] / 1000
    return (off, off + wide) if found[1].isupper() else (-off - wide, -off)


def tolerances_of(given: Any, what: str, example: str) -> dict[str, Tolerance]:
    """Tolerances by the names of measures, as they are kept; an Alarm where that is not what was given."""
    if not isinstance(given, Mapping):
        raise Alarm(f"tolerances of {what} are names and values, got {shown(given)}", hint=example)
    return {name: tuple(each) if isinstance(each, list) else each for name, each in given.items()}


def with_tolerances(measures: list[Measure], tolerances: Mapping[str, Tolerance], where: str) -> tuple[Measure, ...]:
    """Measures with the tolerances given by their names; an Alarm for a name that none of them has."""
    names = [each.name for each in measures]
    if unknown := [name for name in tolerances if name not in names]:
        raise Alarm(f"{where} has no {shown(unknown[0])} for a tolerance", hint=f"it has {', '.join(names)}")
    found = []
    for each in measures:
        if each.name in tolerances:
            given = tolerances[each.name]
            limits = limits_of(given, each.nominal, f"{each.name} of {where}")
            each = each._replace(limits=limits, fit=given if isinstance(given, str) else "")
        found.append(each)
    return tuple(found)


#: The columns of a table of measures.
HEAD = ("what", "measure", "value", "tolerance")


def rows(measures: Iterable[tuple[str, Iterable[Measure]]]) -> list[tuple[str, ...]]:
    """What, measure, value and tolerance of measures by what has them, for a table."""
    return [(name, each.name, each.value, each.allowed) for name, some in measures for each in some]
