"""Nominal values of the cycles 14xx: numbers, or texts with tolerances, an actual value, or a question (TNC 620, 14.2).

    10          the nominal value                     10+0.02     the band from 10 to 10.02
    +9-1-0,5    the band from 8 to 8.5                10@10.0123  not touched: it was found to be 10.0123
    ?10         the operator puts the probe there     ?           … and what is found is the nominal value

Deviations count from the middle of the band.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

from mnclab.controls.tnc_620.cycles.addresses import FAR
from mnclab.text.strings import TextFormula

_NUMBER = r"(?:\d+(?:\.\d*)?|\.\d+)"
_TEXT = re.compile(rf"(\?)?([+-]?{_NUMBER})?((?:[+-]{_NUMBER})*)(?:@(?:([+-]?{_NUMBER})|(Q19\d\d)))?", re.ASCII)
_TOLERANCE = re.compile(rf"[+-]{_NUMBER}", re.ASCII)
MOST_TOLERANCES = 2


class Nominal(NamedTuple):
    """A nominal value with its limits, mm; None: what is found is the nominal value."""

    value: float | None
    lower: float = 0.0
    upper: float = 0.0
    actual: float | None = None
    asked: bool = False

    @property
    def mean(self) -> float | None:
        """The middle of the band."""
        return None if self.value is None else (self.lower + self.upper) / 2

    @property
    def limited(self) -> bool:
        return self.value is not None and self.lower < self.upper


def read(given: float | str | TextFormula, variables: Mapping[str, Any], unit: float) -> Nominal:
    """What a parameter says; numbers are mm, those of a text `unit` mm. ValueError with a sentence where it says nothing."""
    if isinstance(given, int | float):
        return Nominal(given, given, given)
    text = given if isinstance(given, str) else given.evaluate(variables)
    found = _TEXT.fullmatch(re.sub(r"\s", "", text).replace(",", ".").upper())
    if found is None or not text.strip():
        raise ValueError(f'is no nominal value such as "?10", "10+0.02-0.01" or "10@10.01", got "{text}"')
    asks, value, tolerances, actual, variable = found.groups()
    offsets = [float(each) for each in _TOLERANCE.findall(tolerances)]
    if len(offsets) > MOST_TOLERANCES:
        raise ValueError(f'takes {MOST_TOLERANCES} tolerances at most, got "{text}"')
    if value is None and (offsets or not asks):
        raise ValueError(f'needs a nominal value, got "{text}"')
    if asks and (actual or variable):
        raise ValueError(f'asks for a position (?) and gives it (@) in one, got "{text}"')
    if variable and not isinstance(variables.get(variable), int | float):
        raise ValueError(f"takes its actual value from {variable}, which has none")
    found_value = float(variables[variable]) if variable else None if actual is None else float(actual)
    is_ = None if found_value is None else found_value * unit
    if value is None:
        return Nominal(None, asked=True)
    nominal = float(value) * unit
    low, high = (min(offsets), max(offsets)) if len(offsets) == MOST_TOLERANCES else (min(0, *offsets, 0), max(0, *offsets, 0))
    limits = nominal + low * unit, nominal + high * unit
    for each in (nominal, *limits, is_ or 0.0):
        if not abs(each) <= FAR:
            raise ValueError(f"must be at least {-FAR:.10g} and at most {FAR:.10g}, got {each:.10g}")
    return Nominal(nominal, *limits, is_, bool(asks))
