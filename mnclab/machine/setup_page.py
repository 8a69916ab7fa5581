"""A setup as people read it: one row for each thing on the machine, in words with units."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from typing import TYPE_CHECKING, Any

from mnclab.machine.magazine import LATHES, MILLS
from mnclab.path.limits import Limits
from mnclab.path.listing import figure
from mnclab.path.tool import Tool
from mnclab.path.wear import Wear
from mnclab.text.given import shown
from mnclab.workpiece.blank import Box, Sized, blank

if TYPE_CHECKING:
    from mnclab.machine.setup import Setup

AXES = ("X", "Y", "Z", "A", "B", "C", "rotation ", "tilt about X ", "tilt about Y ")  # of a datum
ROWS = {"datums": "datum", "presets": "preset", "correctors": "corrector"}
NAMED = {"files": "file", "settings": "setting", "variables": "variable"}
UNITS = {
    "angle": "°", "plunge_angle": "°", "main_angle": "°", "auxiliary_angle": "°", "teeth": "",
    "feed": " mm/min", "rapid": " mm/min", "acceleration": " mm/s²", "jerk": " mm/s³", "corner_jump": " mm/min",
    "corner_speed": "", "rapid_motion": "", "spindle": " rev/min", "spindle_acceleration": " rev/min in a second",
    "tool_change": " s", "centre_cutting": "", "hand": "", "shank": " mm", "holder": " mm", "positioning": "", "track": "",
    "seed": "", "locked": "", "edges": " mm", "axis": "", "slope": "", "runout": " mm",
}  # fmt: skip
MM = " mm"  # of all others


def page(setup: Setup) -> list[tuple[str, str]]:
    """What there is and how it is, in the order of declaration."""
    return list(_rows(setup))


def _rows(setup: Setup) -> Iterator[tuple[str, str]]:
    usual = next((each for each in (MILLS, LATHES) if setup.tools == each), None)
    if setup.tools is None:
        yield "tools", "those of the control"
    elif usual is not None:
        yield "tools", f"the usual ones: {', '.join(tool.name for tool in usual.values() if tool.kind)}"
    else:
        yield from ((f"T{number}", tool_line(tool)) for number, tool in setup.tools.items())
    for name, title in ROWS.items():
        yield from ((f"{title} {row}", place(each)) for row, each in getattr(setup, name).items())
    if setup.stock is not None:
        stock = blank(setup.stock)
        if isinstance(stock, Sized):
            wide, deep, high = (figure(float(size)) for size in stock.bounds[1] - stock.bounds[0])
            yield "stock", f"{wide} x {deep} x {high} mm, its corner at the datum, its top at Z0"
        else:
            yield "stock", f"{place(stock.low)} to {place(stock.high)}" if isinstance(stock, Box) else str(stock)
    if setup.part is not None:
        cut = "what the program has cut so far" if setup.part == "cut" else None
        yield "part", cut or repr(setup.part)
    yield from (("fixture", str(each)) for each in setup.fixtures)
    yield from ((f"true T{number}", tool_line(tool)) for number, tool in setup.true_tools.items())
    yield "probe", ", ".join(_different(setup.probe, type(setup.probe)())) or "as usual"
    if setup.setter is not None:
        yield "setter", ", ".join(_different(setup.setter, type(setup.setter)())) or "as usual"
    yield "limits", ", ".join(_different(setup.limits, Limits())) or "as usual"
    yield "start", place(setup.start)
    for name, title in NAMED.items():
        yield from ((f"{title} {key}", shown(each)) for key, each in getattr(setup, name).items())


def tool_line(tool: Tool) -> str:
    """`end mill 10, radius 5 mm, plunge angle 3°`: what is known of a tool, but for its number."""
    sizes = _different(tool, Tool(), leave=("number", "name", "kind"))
    return ", ".join([tool.name or tool.kind or "tool", *sizes])


def place(values: Any) -> str:
    """A point or datum: X, Y and Z in mm, then the angles that are not 0, in degrees."""
    told = zip(AXES, (*values, 0.0, 0.0, 0.0)[: max(len(values), 3)])
    return " ".join(f"{axis}{figure(float(value))}" for k, (axis, value) in enumerate(told) if k < 3 or value)


def _different(record: Any, usual: Any, leave: tuple[str, ...] = ()) -> Iterator[str]:
    """The values of a record that differ from the usual ones, each with its name and unit."""
    names = [each.name for each in fields(record)] if is_dataclass(record) else record._fields
    for name in names:
        value = getattr(record, name)
        if name in leave or value == getattr(usual, name):
            continue
        if isinstance(value, Wear):
            yield from (f"{name} {said}" for said in _different(value, Wear()))
        else:
            yield f"{name.replace('_', ' ')} {_value(value, name == 'travel')}{UNITS.get(name, MM) if value is not None else ''}"


def _value(value: Any, travel: bool = False) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, tuple):  # of each axis; of travel from and to
        if travel:
            return ", ".join(f"{axis} {_value(low)} to {_value(high)}" for axis, (low, high) in zip("XYZ", value))
        return (", " if value and isinstance(value[0], tuple) else " ").join(map(_value, value))
    if value is None:
        return "none"
    return value if isinstance(value, str) else figure(float(value))
