"""Where coordinates count from: work offsets, machine coordinates, the local shift, the set position."""

from __future__ import annotations

from mnclab.controls.g43.remarks import ISO, undescribed
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import AXES, first_word
from mnclab.geometry import frames
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum

FUNCTIONS = FunctionTable()
DATUMS = {f"G{n}": n - 53 for n in range(54, 60)}
SHIFTS = {"G52": "Local shift", "G92": "Set position"}


def start(m: Machine) -> None:
    """G54 is active at the start."""
    m.select_datum(m.tables.datums.get(1, Datum()))


@FUNCTIONS(" ".join(DATUMS), "Work offset", group="datum", phase="frames", power_on="G54", source="7.1, example")
def work_offset(m: Machine, words: Words) -> None:
    """Rows 1 to 6 of the datum table; a row that is not there is the machine's zero."""
    if m.side:
        m.alarm("a work offset cannot change under radius compensation", first_word(words), hint="write G40 first")
    m.select_datum(m.tables.datums.get(DATUMS[words.code], Datum()))


@FUNCTIONS("G53", "Machine coordinates", phase="frames", modal=False, source=ISO)
def machine_coordinates(m: Machine, words: Words) -> None:
    """In this block, coordinates are those of the spindle reference: no offset counts."""
    undescribed(m, words)
    motion.uncompensated(m, words)
    motion.leave_frames(m, [name for name, _ in m.frames])
    m.set_frame("length", frames.shift(z=-m.tool.effective_length))


@FUNCTIONS("G52 G92", SHIFTS, phase="local", takes="X Y Z", still=True, modal=False, source=ISO)
def shift(m: Machine, words: Words) -> None:
    """G52 moves the origin from that of the work offset; G92 gives the present point new coordinates. No motion."""
    undescribed(m, words)
    motion.uncompensated(m, words)
    place = m.frames["local"][:3, 3].copy()
    for k, axis in enumerate(AXES):
        if axis in words:
            value = m.length(words[axis])
            place[k] = value if words.code == "G52" else place[k] + m.programmed[k] - value
    m.set_frame("local", frames.shift(*place))
