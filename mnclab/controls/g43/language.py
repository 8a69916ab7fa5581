"""Motion, planes, datums, feed, spindle and auxiliary functions.

The source has one chapter, on G43, G44 and G49; its example uses G0, G1, G17, G54, F, T and M6. Of the other chapters there
are only the titles: what they must mean is taken from ISO 6983, and a program that uses it gets a warning (setting
`undescribed`).
"""

from __future__ import annotations

from mnclab.controls.g43.lengths import activate
from mnclab.controls.g43.state import memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.functions import ARCS, SPINDLE, functions
from mnclab.controls.word_address.motion import AXES, first_word
from mnclab.geometry import frames
from mnclab.machine.control import Control, FunctionTable, Modal, Words
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word, digits

FUNCTIONS = FunctionTable()
ISO = "ISO 6983, not described"
DATUMS = {f"G{n}": n - 53 for n in range(54, 60)}
SHIFTS = {"G52": "Local shift", "G92": "Set position"}
LENGTHS = ("G43", "G44", "G49")


def together(control: Control, modal: Modal, keyword: str, words: list[Word]) -> None:
    """The length compensation needs a straight motion."""
    codes = {f"G{digits(word.value)}": word for word in words if word.address == "G" and type(word.value) is float}
    axes = any(word.address in AXES for word in words)
    arcs = [code for code in ARCS if code in codes] or [code for code in ARCS if modal.motion == code and axes]
    for code in LENGTHS:
        if code in codes and arcs and not {"G0", "G1"} & codes.keys():
            message = f"{code} needs a straight motion, got {arcs[0]} in its block"
            raise Alarm(message, codes[code].span, hint="write two blocks")


def undescribed(m: Machine, words: Words) -> None:
    """Say once for each code that its chapter is not there."""
    told = memory(m).undescribed
    if words.code not in told:
        told.add(words.code)
        sentence = f"{words.code}: not described in the manual; it is taken in its ISO meaning"
        motion.remark(m, "undescribed", sentence, first_word(words))


def remark(m: Machine, words: Words) -> None:
    """What stands in the example, or changes nothing, needs no remark; nor do M functions."""
    if words.code[0] == "G" and words.code not in ("G17", "G40", "G90"):
        undescribed(m, words)


def targets(m: Machine, words: Words) -> dict[str, float]:
    """Where the axes that are written go; their offsets count from now on."""
    to = motion.coordinates(m, words, m.modal["dimension"] == "G90")
    if to and not memory(m).machine_coordinates:
        activate(m, "".join(to).upper())
    return to


@FUNCTIONS("G0", "Rapid positioning", group="motion", takes="X Y Z", power_on="G0", moves=True, source="7.1, example")
def rapid(m: Machine, words: Words) -> None:
    """All axes at their greatest speed."""
    if to := targets(m, words):
        m.rapid(**to)


@FUNCTIONS("G1", "Linear interpolation", group="motion", takes="X Y Z", moves=True, source="7.1, example")
def line(m: Machine, words: Words) -> None:
    """A straight line at feed F."""
    if to := targets(m, words):
        m.line(**to, word=first_word(words))


@FUNCTIONS("G2 G3", ARCS, group="motion", takes="X Y Z I J K R", moves=True, source=ISO)
def arc(m: Machine, words: Words) -> None:
    """An arc by R (negative: above 180 degrees) or by I J K from the start."""
    undescribed(m, words)
    targets(m, words)
    motion.arc(m, words, -1 if words.code == "G2" else 1, m.modal["dimension"] == "G90")


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
            value = m.value(words[axis])
            place[k] = value if words.code == "G52" else place[k] + m.programmed[k] - value
    m.set_frame("local", frames.shift(*place))


@FUNCTIONS("G28", "Return to the reference point", takes="X Y Z", still=True, modal=False, source=ISO)
def reference(m: Machine, words: Words) -> None:
    """The axes written go to their points at rapid, then to machine zero; without axes all go at once."""
    undescribed(m, words)
    motion.uncompensated(m, words)
    if to := targets(m, words):
        m.rapid(**to)
    home = m.to_program((0.0, 0.0, -m.tool.effective_length))
    m.rapid(**{axis: home[k] for k, axis in enumerate(AXES.lower()) if axis in to or not to})


FUNCTIONS("F", "Feed", phase="feed", source="7.1, example")(motion.feed)
FUNCTIONS("S", "Spindle speed", phase="spindle", source=ISO)(motion.spindle_speed)


@FUNCTIONS("G4", "Dwell", phase="dwell", takes="P X", still=True, modal=False, source=ISO)
def dwell(m: Machine, words: Words) -> None:
    """A pause of X seconds or P milliseconds."""
    undescribed(m, words)
    if len(words.words) != 2:
        m.alarm("G4 needs P (milliseconds) or X (seconds)", first_word(words))
    word = words.words[1]
    value = m.value(word)
    if not 0 <= value <= 1e6:
        m.alarm(f"G4 {word.address} (dwell) must be at least 0 and at most 1e+06, got {value:g}", word)
    m.dwell(value if word.address == "X" else value / 1000)


FUNCTIONS("M3 M4 M5", SPINDLE, group="spindle", phase="auxiliary", power_on="M5", source=ISO)(motion.spindle)
FUNCTIONS |= functions(remark, ISO, plane="7.1, example")
