"""Tables and variables that a program writes: G10, and `#1` and the like."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

from mnclab.controls.g43.language import offsets, parameters
from mnclab.controls.g43.language.offsets import FURTHER, MOST, refuse_transformed
from mnclab.controls.g43.language.parameters import Reading, chosen_tool
from mnclab.controls.g43.language.tools import choose, place, want
from mnclab.controls.g43.reading.formulas import FANUC, LINUXCNC, MOST_OF_LINUXCNC, ORDINARY
from mnclab.controls.g43.state import ISO, memory, whole
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import AXES, first_word
from mnclab.geometry import frames
from mnclab.machine.axes import reference
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.path.tool import Tool
from mnclab.text.program import Word

# Tables written by the program: G10, of work offsets (L2, L20) and of tools (L1, L10 to L13).
# A length goes into the row of the corrector where there is one, else into that of the tool, which is then so long: the
# simulation knows no other length than that of the table.

FUNCTIONS = FunctionTable()
RADII = ("radius", "dr")  # of the dimensions of a tool


@FUNCTIONS("G10", "Data setting", phase="data", takes="L P R X Y Z", still=True, modal=False, source=ISO)
def data_setting(m: Machine, words: Words) -> None:
    """Writes into a table, P says which row: L2 and L20 work offsets, L1 and L10 to L13 tools. Under G91 it adds."""
    motion.uncompensated(m, words)
    kind = whole(m, words, "L", 0, 9999)
    wrote = KINDS.get(kind)
    if wrote is None:
        known = " ".join(f"L{n}" for n in KINDS)
        m.alarm(f"G10 L{kind} is refused: not built", words["L"], hint=f"known: {known}")
    wrote(m, words)


def adds(m: Machine) -> bool:
    """Whether numbers of the block are added to what stands in the table: under G91, but not on LinuxCNC."""
    return m.modal["dimension"] == "G91" and m.settings["g10_increment"] == "adds"


def without(m: Machine, words: Words, addresses: str, meaning: str) -> None:
    """An Alarm at a word that this kind of G10 does not have."""
    for address in addresses:
        if address in words:
            m.alarm(f"{words[address]} has no meaning in {meaning}", words[address])


# --- work offsets -----------------------------------------------------------------------------------------------------


def work_offset(m: Machine, words: Words) -> None:
    """L2: P1 to P6 are G54 to G59, P7 to P9 G59.1 to G59.3; P0 as the setting g10_p0 has it. R turns the system."""
    row = whole(m, words, "P", 0, 9)
    if row == 0:
        choice = m.settings["g10_p0"]
        if choice == "refuse":
            m.alarm("G10 L2 P0 is refused: makers differ in what it writes", words["P"], hint="setting g10_p0")
        if choice == "external":
            set_external(m, words)
            return
        row = row_in_use(m, words)
    write(m, row, words)


def row_in_use(m: Machine, words: Words) -> int:
    """The row of the work offset that is active."""
    if not memory(m).row:
        m.alarm("no work offset is active", words["P"], hint="select one first, as G54 does")
    return memory(m).row


def set_external(m: Machine, words: Words) -> None:
    """The offset that stands before all work offsets."""
    refuse_transformed(m, words)
    without(m, words, "R", "G10 L2 P0")
    old = m.frames["external"][:3, 3].tolist()
    m.set_frame("external", frames.shift(*coordinates(m, words, old)))


def coordinates(m: Machine, words: Words, old: list[float]) -> list[float]:
    """Three numbers of a table, those that are written in the block replaced, or added to."""
    found = list(old)
    for k, axis in enumerate(AXES):
        if axis in words:
            found[k] = m.length(words[axis]) + (old[k] if adds(m) else 0.0)
    return found


def write(m: Machine, row: int, words: Words) -> None:
    """Write a work offset; an active one counts at once, and no axis moves."""
    old = m.tables.datums.get(row, Datum())
    x, y, z = coordinates(m, words, [old.x, old.y, old.z])
    turn = m.value(words["R"]) if "R" in words else old.rotation
    put(m, row, old._replace(x=x, y=y, z=z, rotation=turn), words)


def put(m: Machine, row: int, datum: Datum, words: Words) -> None:
    active = row == memory(m).row
    if active:
        refuse_transformed(m, words)
    m.write_table("datums", row, datum)
    if active:
        offsets.select(m, row)


def further_offset(m: Machine, words: Words) -> None:
    """L20: of Fanuc and Haas the offsets of G54.1; of LinuxCNC the offset by which the present point has coordinates."""
    if m.settings["g10_l20"] == "further":
        without(m, words, "R", "G10 L20")
        write(m, FURTHER + whole(m, words, "P", 1, MOST), words)
        return
    without(m, words, "R", "G10 L20")
    row = whole(m, words, "P", 0, 9) or row_in_use(m, words)
    old = m.tables.datums.get(row, Datum())
    m.select_datum(old)
    here, wanted = m.programmed, list(m.programmed)
    for k, axis in enumerate(AXES):
        if axis in words:
            wanted[k] = m.length(words[axis])
    off = m.frames["datum"][:3, :3] @ [now - then for now, then in zip(here, wanted, strict=True)]
    x, y, z = (old[k] + float(off[k]) for k in range(3))
    active = memory(m).row
    m.write_table("datums", row, old._replace(x=x, y=y, z=z))
    offsets.select(m, active)


# --- tools ------------------------------------------------------------------------------------------------------------


def tool(m: Machine, words: Words) -> None:
    """L1: length Z and radius R of tool P."""
    without(m, words, "XY", "G10 L1")
    number = whole(m, words, "P", 1, 9999)
    for address, name in (("Z", "length"), ("R", "radius")):
        if address in words:
            write_tool(m, number, name, m.length(words[address]), words[address])


def one_value(name: str) -> Callable[[Machine, Words], None]:
    """L10 to L13: length, its wear, radius and its wear of row P, each the word R."""

    def obey(m: Machine, words: Words) -> None:
        kind = f"G10 L{int(m.value(words['L']))}"
        if m.settings["g10_l20"] == "position":
            m.alarm(f"{kind} is refused: not built as LinuxCNC has it", words["L"], hint="G10 L1 writes tools there")
        without(m, words, AXES, kind)
        number = whole(m, words, "P", 1, 9999)
        if "R" not in words:
            m.alarm(f"{kind} R (the value) is missing", first_word(words))
        value = m.length(words["R"])
        if name in RADII and m.settings["d_measures"] == "diameter":
            value /= 2
        write_tool(m, number, name, value, words["R"])

    return obey


def write_tool(m: Machine, number: int, name: str, value: float, word: Word) -> None:
    """Write a dimension of a row: a tool in the spindle, and an active corrector, have it from now on."""
    offset = m.tables.correctors.get(number)
    if offset is not None and name not in RADII:
        m.write_table("correctors", number, offset._replace(z=value + (offset.z if adds(m) or name == "dl" else 0.0)))
        want(m, word)
        return
    row = m.tables.tools.get(number) or Tool(number=number)
    value += getattr(row, name) if adds(m) else 0.0
    if name == "radius" and value < 0:
        m.alarm(f"R (radius) must be at least 0, got {value / m.variable_unit:g}", word)
    change: dict[str, Any] = {name: value}
    m.write_table("tools", number, replace(row, **change))
    if name in RADII:
        if memory(m).corrector == number:
            choose(m, number, word)
        return
    if m.tool.number == number:
        m.change_tool(replace(m.tool, **change))
        place(m, "tip")
    want(m, word)


KINDS: dict[int, Callable[[Machine, Words], None]] = {
    1: tool, 2: work_offset, 10: one_value("length"), 11: one_value("dl"), 12: one_value("radius"),
    13: one_value("dr"), 20: further_offset,
}  # fmt: skip


# Variables: `#1` to `#33` of a macro, common ones, named ones, and those by which the control tells what it knows.
# The control's own are those whose meaning public manuals state exactly and the simulation knows: positions (`#5001` …, in the
# unit of the program), work offsets (`#5221` …), active codes (`#4001` …), alarm and stop (`#3000`, `#3006`), tool, offset and
# position (`#5400` …). What LinuxCNC keeps instead stands in `parameters`.

NAMES = re.compile(r"#(?:[1-9]\d{0,2}|<[a-z0-9_.]{1,80}>)")
ROWS = {5221 + 20 * k: k + 1 for k in range(9)} | {7001 + 20 * k: FURTHER + k + 1 for k in range(48)}
OFFSETS = {f"#{first + k}": (row, k) for first, row in ROWS.items() for k in range(3)}
EXTERNAL = {f"#{5201 + k}": k for k in range(3)}  # the offset before all others
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
    if name in parameters.NAMED:
        m.alarm(f"{name} is kept by the control and cannot be written", word)
    if m.settings["macros"] == LINUXCNC and name[1] != "<":
        give_number(m, word, name, value or 0.0)
    elif name[1] == "<" or 1 <= int(name[1:]) <= ORDINARY:
        if value is None:
            m.variables.forget(name)
        else:
            m.variables[name] = value
    else:
        give_own(m, word, name, value, message)


def give_number(m: Machine, word: Word, name: str, value: float) -> None:
    """Write a number on LinuxCNC: of a table, or a free one."""
    if not 1 <= int(name[1:]) <= MOST_OF_LINUXCNC:
        m.alarm(f"{name} is no variable of LinuxCNC", word, f"#1 to #{MOST_OF_LINUXCNC}")
    if parameters.write(m, name, value):
        return
    if name in parameters.NUMBERED:
        m.alarm(f"{name} is kept by the control and cannot be written", word)
    m.variables[name] = value


def give_own(m: Machine, word: Word, name: str, value: float | None, message: str) -> None:
    """Do what writing a number of Fanuc's control means."""
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
    elif name in OFFSETS or name in EXTERNAL:
        if value is None:
            m.alarm(f"{name} needs a number: a work offset is never vacant", word)
        if m.side:
            m.alarm("a work offset cannot change under radius compensation", word, hint="write G40 first")
        write_offset(m, name, value * m.variable_unit, Words((word,), name))
    elif name in PREASSIGNED or name in parameters.PROBED:
        m.alarm(f"{name} is kept by the control and cannot be written", word)
    else:
        m.alarm(f"{name} is a variable of the control that is not built", word, "#1 to #999 are free")


def write_offset(m: Machine, name: str, value: float, words: Words) -> None:
    """One axis of an offset, mm; where it is active, coordinates count from there at once."""
    if name in EXTERNAL:
        refuse_transformed(m, words)
        place = m.frames["external"][:3, 3].tolist()
        place[EXTERNAL[name]] = value
        m.set_frame("external", frames.shift(*place))
        return
    row, k = OFFSETS[name]
    put(m, row, m.tables.datums.get(row, Datum())._replace(**{"xyz"[k]: value}), words)


def read_offset(m: Machine, row: int, k: int) -> float:
    return float(m.tables.datums.get(row, Datum())[k]) / m.variable_unit


def external(m: Machine, k: int) -> float:
    return float(m.frames["external"][k, 3]) / m.variable_unit


def end_of_block(m: Machine, k: int) -> float | None:
    """Where the last block ended; not known in a turned or scaled system."""
    return None if m.shift is None else m.programmed[k] / m.variable_unit


def on_machine(m: Machine, k: int) -> float | None:
    """The spindle reference, with the length of the tool; not known in a compensated contour."""
    if m.side:
        return None
    return reference(m)[k] / m.variable_unit


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


def length_offset(m: Machine, k: int) -> float:
    return memory(m).active_offsets[k] / m.variable_unit


def active_row(m: Machine) -> float | None:
    """1 to 6 for G54 to G59, 7 to 9 for G59.1 to G59.3."""
    row = memory(m).row
    return float(row) if row < FURTHER else None


#: What Fanuc and Haas keep in numbers.
NUMBERED: dict[str, Reading] = (
    {f"#{5001 + k}": partial(end_of_block, k=k) for k in range(3)}
    | {f"#{5021 + k}": partial(on_machine, k=k) for k in range(3)}
    | {f"#{5041 + k}": partial(in_program, k=k) for k in range(3)}
    | {name: partial(read_offset, row=row, k=k) for name, (row, k) in OFFSETS.items()}
    | {name: partial(external, k=k) for name, k in EXTERNAL.items()}
    | {name: partial(active_code, group=group) for name, group in GROUPS.items()}
    | {"#4006": lambda m: 21.0 if m.variable_unit == 1 else 20.0, "#4009": active_cycle, "#4120": chosen_tool}
    | {"#4109": lambda m: (m.feed or 0.0) / m.variable_unit, "#4119": lambda m: m.speed}
    | {"#5400": lambda m: float(m.tool.number), "#5410": lambda m: 2 * m.tool.radius / m.variable_unit}
    | {f"#{first + k}": partial(length_offset, k=k) for first in (5081, 5401) for k in range(3)}
    | {f"#{5420 + k}": partial(parameters.here, k=k) for k in range(3)}
    | {"#5220": active_row, "#4107": lambda m: float(memory(m).corrector)}
    | {"#4111": lambda m: float(memory(m).length_corrector or 0)}
)
NUMBERS = {FANUC: NUMBERED, LINUXCNC: parameters.NUMBERED}


def kept_by(m: Machine, name: str) -> float | None:
    """The value of a number that the control keeps, None if it is none of its maker's."""
    reading = NUMBERS[m.settings["macros"]].get(name)
    return None if reading is None else reading(m)


PREASSIGNED: dict[str, Reading] = {
    name: partial(kept_by, name=name) for name in NUMBERED | parameters.NUMBERED
} | parameters.NAMED
