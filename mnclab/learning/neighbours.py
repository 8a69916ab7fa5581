"""Neighbours with other dimensions: the same task, its numbers drawn from the pupil's name, so that a copy fits nobody else."""

from __future__ import annotations

import hashlib
import re
import unicodedata
from collections.abc import Iterator, Mapping
from copy import deepcopy
from typing import Any

from mnclab.text.alarm import Alarm
from mnclab.text.file import File, as_table
from mnclab.text.given import check_number, shown

STEPS = 1000  # values from which one is drawn, at most


def varied(table: Mapping[str, Any], name: str, pupil: str, file: File) -> dict[str, Any]:
    """The table of an exercise with the dimensions of a pupil, where `[vary]` lets them differ; as it is for nobody.

    `"pocket.length" = [46, 54, 2]` are the values 46, 48 … 54 of a dimension of a feature; `"r 12" = [11, 13, 1]` those of
    every radius of a turned profile that is 12, `"z -30"` of every such place.
    """
    found = deepcopy(dict(table))
    ranges = as_table(found.pop("vary", {}), "vary")
    for key, values in ranges.items():
        with file.at("vary", key):
            choices, places = _values(values), list(_places(found.get("design", {}), key))
            if not places:
                raise Alarm(f"the design has no {shown(key)}", hint='"pocket.length", or of a turned profile "r 12" or "z -30"')
        if pupil.strip():
            same = unicodedata.normalize("NFC", pupil.strip()).lower()  # as one letter or as letter and sign, by the system
            drawn = hashlib.sha256(f"{same}/{name}/{key}".encode()).digest()
            for owner, field in places:
                owner[field] = choices[int.from_bytes(drawn[:4], "big") % len(choices)]
    return found


def told(table: Mapping[str, Any]) -> Iterator[str]:
    """The dimensions that vary and whose number stands in the task all the same, where it is nobody's but one pupil's."""
    for key in table.get("vary", {}):
        for owner, field in _places(table.get("design", {}), key):
            number = f"{abs(owner[field]):g}"
            if re.search(rf"(?<![\w.]){re.escape(number)}(?!\.?\w)", table["task"]):
                yield f"[vary]: {key} is a pupil's own, and the task names {number}"


def _values(given: Any) -> list[float]:
    least, greatest, step = given if isinstance(given, list) and len(given) == 3 else (0, 0, 0)
    for value in (least, greatest, step):
        check_number(value, "a dimension that varies")
    if not 0 < step <= greatest - least <= STEPS * step:
        raise Alarm(f"a dimension varies as [least, greatest, step], got {shown(given)}")
    return [least + k * step for k in range(int((greatest - least) / step + 1e-9) + 1)]


def _places(design: Any, key: str) -> Iterator[tuple[dict[str, Any], str]]:
    """The tables and fields of a design that a key names."""
    if not isinstance(design, dict):
        return
    axis, _, number = key.partition(" ")
    if axis in ("r", "z") and number:
        yield from ((point, axis) for point in design.get("profile", []) if f"{point.get(axis):g}" == number)
        return
    feature, _, field = key.rpartition(".")
    yield from ((each, field) for each in design.get("features", []) if each.get("name") == feature and field in each)
