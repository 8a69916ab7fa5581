"""Variables: `#1` to `#33` of a macro, common ones, named ones, and those by which the control tells what it knows.

The control's own are those whose meaning public manuals state exactly and the simulation knows: positions (`#5001` …, in the
unit of the program), work offsets (`#5221` …), active codes (`#4001` …), alarm and stop (`#3000`, `#3006`), and of LinuxCNC
tool, offset and position (`#5400` …).
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import partial

from mnclab.controls.g43.reading.formulas import LINUXCNC, ORDINARY
from mnclab.controls.g43.state import memory
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.text.program import Word

Reading = Callable[[Machine], float | None]
LOCAL = tuple(f"#{n}" for n in range(1, 34))
NAMES = re.compile(r"#(?:[1-9]\d{0,2}|<[a-z0-9_.]{1,80}>)")
OFFSETS = {f"#{5221 + 20 * row + k}": (row + 1, "xyz"[k]) for row in range(6) for k in range(3)}
GROUPS = {
    "#4001": "motion", "#4002": "plane", "#4003": "dimension", "#4005": "feed mode", "#4007": "compensation",
    "#4008": "length compensation", "#4010": "return", "#4014": "datum", "#4015": "blending",
}  # fmt: skip
WITHOUT_EFFECT = {"#3003": "single block and M functions", "#3004": "feed hold and override"}


def start(m: Machine) -> None:
    """The values that were there before the program."""
    if m.settings["macros"] == LINUXCNC:
        m.log("macros", LINUXCNC)
    for name, value in m.setup.variables.items():
        known = NAMES.fullmatch(name) and (name[1] == "<" or int(name[1:]) <= ORDINARY)
        if not known or isinstance(value, str | bool) or not math.isfinite(value):
            m.alarm(f"Setup(variables=…): {name} cannot be {value!r}", hint="numbers in #1 to #999 and #<names>")
        m.variables[name] = float(value)


def give(m: Machine, word: Word, name: str, value: float | None, message: str) -> None:
    """Write a variable, or do what writing it means."""
    if name[1] == "<" or 1 <= int(name[1:]) <= ORDINARY:
        if value is None:
            m.variables.forget(name)
        else:
            m.variables[name] = value
        return
    if name == "#0":
        m.alarm("#0 is always vacant and cannot be written", word)
    said = message or "without a message"
    if name == "#3000":
        m.alarm(f"#3000 = {value or 0:g}: the program stops with an alarm: {said}", word)
    if name == "#3006":
        m.stop()
        m.message(f"#3006 = {value or 0:g}: the program waits for the operator: {said}")
    elif name in WITHOUT_EFFECT:
        m.warn(f"{name} ({WITHOUT_EFFECT[name]}) changes nothing here", word)
    elif name in OFFSETS:
        if value is None:
            m.alarm(f"{name} needs a number: a work offset is never vacant", word)
        write_offset(m, *OFFSETS[name], value * m.variable_unit, word)
    elif name in PREASSIGNED:
        m.alarm(f"{name} is kept by the control and cannot be written", word)
    else:
        m.alarm(f"{name} is a variable of the control that is not built", word, "#1 to #999 are free")


def write_offset(m: Machine, row: int, axis: str, value: float, word: Word) -> None:
    """One axis of a work offset, mm; where it is active, coordinates count from there at once."""
    active = m.modal.get("datum") == f"G{53 + row}"
    if active and m.side:
        m.alarm("a work offset cannot change under radius compensation", word, hint="write G40 first")
    datum = m.tables.datums.get(row, Datum())._replace(**{axis: value})
    m.write_table("datums", row, datum)
    if active:
        m.select_datum(datum)


def read_offset(m: Machine, row: int, axis: str) -> float:
    return float(getattr(m.tables.datums.get(row, Datum()), axis)) / m.variable_unit


def end_of_block(m: Machine, k: int) -> float:
    return m.programmed[k] / m.variable_unit


def on_machine(m: Machine, k: int) -> float | None:
    """The spindle reference, with the length of the tool; not known in a compensated contour."""
    if m.side:
        return None
    return (m.tip[k] + (m.tool.effective_length if k == 2 else 0.0)) / m.variable_unit


def in_program(m: Machine, k: int) -> float | None:
    """The same counted from the work offset: with the offset of the length compensation; not known in a turned system."""
    if m.side or m.shift is None:
        return None
    return (m.programmed[k] + memory(m).active_offsets[k]) / m.variable_unit


def active_code(m: Machine, group: str) -> float | None:
    code = m.modal.get(group, "")
    return float(code[1:]) if code[1:].replace(".", "", 1).isdigit() else None


def active_cycle(m: Machine) -> float:
    return float(m.position_cycle.code[1:]) if m.position_cycle else 80.0


def chosen_tool(m: Machine) -> float:
    """The number of the last T."""
    row = memory(m).next_tool
    return float((row or m.tool).number)


def length_offset(m: Machine, k: int) -> float:
    return memory(m).active_offsets[k] / m.variable_unit


def active_offset(m: Machine) -> float | None:
    code = active_code(m, "datum")
    return None if code is None or code != int(code) else code - 53


PREASSIGNED: dict[str, Reading] = (
    {f"#{5001 + k}": partial(end_of_block, k=k) for k in range(3)}
    | {f"#{5021 + k}": partial(on_machine, k=k) for k in range(3)}
    | {f"#{5041 + k}": partial(in_program, k=k) for k in range(3)}
    | {name: partial(read_offset, row=row, axis=axis) for name, (row, axis) in OFFSETS.items()}
    | {name: partial(active_code, group=group) for name, group in GROUPS.items()}
    | {"#4006": lambda m: 21.0 if m.variable_unit == 1 else 20.0, "#4009": active_cycle, "#4120": chosen_tool}
    | {"#4109": lambda m: (m.feed or 0.0) / m.variable_unit, "#4119": lambda m: m.speed}
    | {"#5400": lambda m: float(m.tool.number), "#5410": lambda m: 2 * m.tool.radius / m.variable_unit}
    | {f"#{5401 + k}": partial(length_offset, k=k) for k in range(3)}
    | {f"#{5420 + k}": partial(end_of_block, k=k) for k in range(3)}
    | {"#5220": active_offset}
)
