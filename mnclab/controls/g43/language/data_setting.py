"""Tables written by the program: G10, of work offsets (L2, L20) and of tools (L1, L10 to L13).

A length goes into the row of the corrector where there is one, else into that of the tool, which is then so long: the
simulation knows no other length than that of the table.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from mnclab.controls.g43.language import offsets
from mnclab.controls.g43.language.lengths import choose, place, want
from mnclab.controls.g43.language.numbers import whole
from mnclab.controls.g43.language.offsets import FURTHER, MOST
from mnclab.controls.g43.language.transformations import refuse_transformed
from mnclab.controls.g43.remarks import ISO
from mnclab.controls.g43.state import memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import AXES, first_word
from mnclab.geometry import frames
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.path.tool import Tool
from mnclab.text.program import Word

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
            external(m, words)
            return
        row = active_row(m, words)
    write(m, row, words)


def active_row(m: Machine, words: Words) -> int:
    """The row of the work offset that is active."""
    if not memory(m).row:
        m.alarm("no work offset is active", words["P"], hint="select one first, as G54 does")
    return memory(m).row


def external(m: Machine, words: Words) -> None:
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
    row = whole(m, words, "P", 0, 9) or active_row(m, words)
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
