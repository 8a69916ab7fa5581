"""Where coordinates count from: work offsets, machine coordinates, the local shift, the set position.

Rows 1 to 6 of the table of datums are G54 to G59, 7 to 9 G59.1 to G59.3, and 101 on G54.1 P1 and so on. The position set by
G92 shifts them all; the local shift of G52 counts inside it, except where a setting makes the two one register.
"""

from __future__ import annotations

from mnclab.controls.g43.language.numbers import whole
from mnclab.controls.g43.language.transformations import refuse_transformed, transformed
from mnclab.controls.g43.remarks import ISO, undescribed
from mnclab.controls.g43.state import NONE, memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import AXES, first_word
from mnclab.geometry import frames
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum

FUNCTIONS = FunctionTable()
FURTHER, MOST = 100, 300  # G54.1 P1 is row 101; so many of them
HAAS = {f"G{n}": n - 109 for n in range(110, 130)}  # codes of the first twenty of them on a Haas
ROWS = {f"G{n}": n - 53 for n in range(54, 60)} | {f"G59.{n}": 6 + n for n in (1, 2, 3)}


def start(m: Machine) -> None:
    """G54 is active at the start, unless the setting start_datum wants none."""
    if m.settings["start_datum"] == "G54":
        select(m, 1)
    else:
        m.set_modal("datum", "")
        memory(m).row = 0


def select(m: Machine, row: int) -> None:
    """Count from a row of the table of datums; a row that is not there is the machine's zero."""
    memory(m).row = row
    m.log("datum row", row)
    m.select_datum(m.tables.datums.get(row, Datum()))


def change(m: Machine, words: Words, row: int) -> None:
    if m.side:
        m.alarm("a work offset cannot change under radius compensation", first_word(words), hint="write G40 first")
    if on := transformed(m):
        m.warn(f"the work offset changes while {on} is active, which now counts from the new one", first_word(words))
    if m.settings["g92_lasts"] == "ends":
        set_shift(m, registers(m)[0], NONE)
    select(m, row)


@FUNCTIONS("G54 G55 G56 G57 G58 G59", "Work offset", group="datum", phase="frames", power_on="G54", source="7.1, example")
@FUNCTIONS("G59.1 G59.2 G59.3", "Work offset", group="datum", phase="frames", source="LinuxCNC")
def work_offset(m: Machine, words: Words) -> None:
    """Rows 1 to 6 of the datum table, on LinuxCNC 7 to 9 too; a row that is not there is the machine's zero."""
    change(m, words, ROWS[words.code])


@FUNCTIONS("G54.1 G154", "Further work offset", group="datum", phase="frames", takes="P", source="Fanuc, Haas")
def further_offset(m: Machine, words: Words) -> None:
    """P1 to P300: rows 101 to 400 of the datum table."""
    change(m, words, FURTHER + whole(m, words, "P", 1, MOST))


@FUNCTIONS(" ".join(HAAS), {code: f"Further work offset, G154 P{number}" for code, number in HAAS.items()}, group="datum",
           phase="frames", source="Haas")  # fmt: skip
def numbered_offset(m: Machine, words: Words) -> None:
    """Rows 101 to 120 of the datum table."""
    change(m, words, FURTHER + HAAS[words.code])


@FUNCTIONS("G53", "Machine coordinates", phase="frames", modal=False, source=ISO)
def machine_coordinates(m: Machine, words: Words) -> None:
    """In this block, coordinates are those of the spindle reference: no offset counts."""
    undescribed(m, words)
    motion.uncompensated(m, words)
    if m.modal["dimension"] == "G91" and (choice := m.settings["g53_increment"]) != "absolute":
        if choice == "refuse":
            m.alarm("G53 cannot stand under G91", first_word(words), hint="setting g53_increment")
        m.warn("G53 counts for nothing under G91: the block moves by its increments", first_word(words))
        return
    motion.leave_frames(m, [name for name, _ in m.frames])
    m.set_frame("length", frames.shift(z=-m.tool.effective_length))


# --- shifts of all work offsets ---------------------------------------------------------------------------------------


def shift_of(m: Machine, name: str) -> list[float]:
    found: list[float] = m.frames[name][:3, 3].tolist()
    return found


def set_shift(m: Machine, name: str, place: list[float] | tuple[float, ...]) -> None:
    m.set_frame(name, frames.shift(*place) if any(place) else None)


def registers(m: Machine) -> tuple[str, str]:
    """The frames of G92 and of G52."""
    return ("set", "local") if m.settings["g52_g92"] == "apart" else ("set", "set")


@FUNCTIONS("G52", "Local shift", phase="local", takes="X Y Z", still=True, owns=True, modal=False, source=ISO)
def local_shift(m: Machine, words: Words) -> None:
    """The origin moves so far from that of the work offset; an axis that is not written keeps its shift. No motion."""
    undescribed(m, words)
    motion.uncompensated(m, words)
    refuse_transformed(m, words)
    name = registers(m)[1]
    place = shift_of(m, name)
    for k, axis in enumerate(AXES):
        if axis in words:
            place[k] = m.length(words[axis])
    set_shift(m, name, place)


@FUNCTIONS("G92", "Set position", phase="local", takes="X Y Z", still=True, owns=True, modal=False, source=ISO)
def set_position(m: Machine, words: Words) -> None:
    """The present point has these coordinates, in all work offsets; the local shift of these axes is over. No motion."""
    undescribed(m, words)
    motion.uncompensated(m, words)
    refuse_transformed(m, words)
    written = [(k, axis) for k, axis in enumerate(AXES) if axis in words]
    if not written:
        m.alarm("G92 needs X, Y or Z: the coordinates that the present point is to have", first_word(words))
    of_g92, of_g52 = registers(m)
    place, local, here = shift_of(m, of_g92), shift_of(m, of_g52), m.programmed
    for k, axis in written:
        place[k] += here[k] - m.length(words[axis])
        if of_g52 != of_g92:
            place[k] += local[k]
            local[k] = 0.0
    if of_g52 != of_g92:
        set_shift(m, of_g52, local)
    set_shift(m, of_g92, place)
    memory(m).set_aside = None


@FUNCTIONS("G92.1", "Set position off", phase="local", takes="X Y Z", still=True, modal=False, source=ISO)
def set_position_off(m: Machine, words: Words) -> None:
    """The shifts of G92 and G52 are over, of the axes that are written or, without any, of all. No motion."""
    motion.uncompensated(m, words)
    refuse_transformed(m, words)
    axes = [k for k, axis in enumerate(AXES) if axis in words] or [0, 1, 2]
    for k in axes:
        if AXES[k] in words and m.value(words[AXES[k]]) != 0:
            m.alarm(f"G92.1 {AXES[k]} must be 0: it names the axis", words[AXES[k]])
    for name in dict.fromkeys(registers(m)):
        set_shift(m, name, [0.0 if k in axes else value for k, value in enumerate(shift_of(m, name))])
    memory(m).set_aside = None


@FUNCTIONS("G92.2 G92.3", {"G92.2": "Set position aside", "G92.3": "Set position back"}, phase="local", still=True, modal=False,
           source="LinuxCNC")  # fmt: skip
def set_position_aside(m: Machine, words: Words) -> None:
    """G92.2: the shift of G92 counts no more, but is kept; G92.3: it counts again. No motion."""
    motion.uncompensated(m, words)
    refuse_transformed(m, words)
    name, kept = registers(m)[0], memory(m)
    if words.code == "G92.2":
        x, y, z = shift_of(m, name)
        kept.set_aside = (x, y, z) if (x, y, z) != NONE else kept.set_aside
        set_shift(m, name, NONE)
    elif kept.set_aside is not None:
        set_shift(m, name, kept.set_aside)
