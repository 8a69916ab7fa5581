"""A blank as people write it in a file: two corners, or a cylinder."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mnclab.text.alarm import Alarm
from mnclab.text.file import File, check_names
from mnclab.text.given import check_number, shown
from mnclab.workpiece.blank import Blank, Box, Revolved, cylinder


def blank_of(table: Mapping[str, Any], where: str, file: File, *keys: str) -> Blank:
    """The blank that a table writes, a cylinder where it has a radius, else a box; `keys` lead to it in the file."""
    if "radius" not in table:
        check_names(table, ("low", "high"), f"{where} without a radius", file, *keys)
        corners = []
        for name in ("low", "high"):
            with file.at(*keys, name):
                if name not in table:
                    needs = "needs low and high, two corners [x, y, z], or a radius"
                    raise Alarm(f"{where} {needs}: {where}.{name} is missing")
                corners.append(point_of(table[name], f"{where}.{name}"))
        return Box(*corners)
    check_names(table, ("radius", "low", "high", "bore", "axis", "at"), where, file, *keys)
    numbers = {name: table.get(name, 0.0) for name in ("radius", "low", "high", "bore")}
    for name, number in numbers.items():
        with file.at(*keys, name):
            check_number(number, f"{where}.{name}")
    with file.at(*keys, "at"):
        at = point_of(table.get("at", [0.0, 0.0, 0.0]), f"{where}.at")
    try:
        return cylinder(**numbers, axis=table.get("axis", "Z"), at=at)
    except Alarm as fault:
        raise Alarm(f"{where}: {fault.message}") from None


def point_of(value: Any, where: str) -> tuple[float, float, float]:
    """Three numbers of a list."""
    if not isinstance(value, list) or len(value) != 3:
        raise Alarm(f"{where} must be three numbers [x, y, z], got {shown(value)}")
    for item in value:
        check_number(item, where)
    x, y, z = map(float, value)
    return x, y, z


def table_of(blank: Box | Revolved) -> dict[str, Any]:
    """The table of a box, or of a cylinder: a body of one radius."""
    if isinstance(blank, Box):
        return {"low": blank.low, "high": blank.high}
    (radius, low), *_, (_, high) = blank.profile
    table: dict[str, Any] = {"radius": radius, "low": low, "high": high}
    rest = {"bore": (blank.bore, 0.0), "axis": (blank.axis, "Z"), "at": (blank.at, (0.0, 0.0, 0.0))}
    return table | {name: value for name, (value, usual) in rest.items() if value != usual}
