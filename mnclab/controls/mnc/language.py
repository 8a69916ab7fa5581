"""Motion, planes, dimensions, work offsets, feed, spindle, tool and auxiliary functions (MNC, chapters 1 to 8)."""

from __future__ import annotations

from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import AXES, first_word
from mnclab.geometry import frames
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum

FUNCTIONS = FunctionTable()
PLANES = {"G17": "XY", "G18": "ZX", "G19": "YZ"}
OUTSIDE = "the manual does not list it; it is taken in its ISO meaning"


def absolute(m: Machine) -> bool:
    """Whether coordinates are absolute: G90, and always in a block with G53 (MNC-G53-G91)."""
    return m.modal["dimension"] == "G90" or "machine coordinates" in m.memory


@FUNCTIONS("G0", "Rapid positioning", group="motion", takes="X Y Z", power_on="G0", moves=True, source="3.1")
def rapid(m: Machine, words: Words) -> None:
    """All axes at their greatest speed; F is kept."""
    if to := motion.coordinates(m, words, absolute(m)):
        m.rapid(**to)


@FUNCTIONS("G1", "Linear interpolation", group="motion", takes="X Y Z", moves=True, source="3.2")
def line(m: Machine, words: Words) -> None:
    """A straight line at feed F."""
    if to := motion.coordinates(m, words, absolute(m)):
        m.line(**to, word=first_word(words))


ARCS = {"G2": "Circular interpolation clockwise", "G3": "Circular interpolation counter-clockwise"}


@FUNCTIONS("G2 G3", ARCS, group="motion", takes="X Y Z I J K R", moves=True, source="3.4")
def arc(m: Machine, words: Words) -> None:
    """An arc by R (negative: above 180 degrees) or I J K from the start; without either a straight line."""
    sense = -1 if words.code == "G2" else 1
    motion.arc(m, words, sense, absolute(m), line_without_centre=True)


@FUNCTIONS(
    "G17 G18 G19", {"G17": "Plane XY", "G18": "Plane ZX", "G19": "Plane YZ"},
    group="plane", phase="plane", power_on="G17", source="2.4",
)  # fmt: skip
def plane(m: Machine, words: Words) -> None:
    """The plane of arcs and of radius compensation."""
    motion.set_plane(m, PLANES[words.code], first_word(words))


@FUNCTIONS(
    "G90 G91", {"G90": "Absolute dimensions", "G91": "Incremental dimensions"},
    group="dimension", phase="plane", power_on="G90", source="2.3",
)  # fmt: skip
def dimension(m: Machine, words: Words) -> None:
    """Coordinates of the selected system, or distances from the last programmed point."""


@FUNCTIONS("G54 G55 G56 G57 G58 G59", "Work offset", group="datum", phase="frames", source="2.7")
def work_offset(m: Machine, words: Words) -> None:
    """Rows 1 to 6 of the datum table; cancels G92. No motion."""
    m.frames.set("local", None)
    m.select_datum(m.tables.datums.get(int(words.code[1:]) - 53, Datum()))


@FUNCTIONS("G53", "Machine coordinates", group="datum", phase="frames", power_on="G53", modal=False, source="2.6")
def machine_coordinates(m: Machine, words: Words) -> None:
    """In this block only, work offset and G92 count as zero; active at power-on until a work offset is selected."""
    kept = [(name, m.frames[name]) for name in ("datum", "local")]

    def restore() -> None:
        for name, frame in kept:
            m.set_frame(name, frame)
        m.memory.pop("machine coordinates")

    m.memory["machine coordinates"] = True
    for name, _ in kept:
        m.set_frame(name, None)
    m.at_block_end(restore)


@FUNCTIONS("G92", "Set position", phase="local", takes="X Y Z U V W", still=True, modal=False, source="2.5")
def set_position(m: Machine, words: Words) -> None:
    """The present point gets the coordinates X Y Z; U V W move the origin by that much. No motion."""
    if m.side:
        m.alarm("G92 cannot stand under radius compensation", first_word(words), hint="write G40 first")
    if "machine coordinates" in m.memory:
        m.alarm("G92 and G53 stand in one block: G53 moves, G92 does not", first_word(words), hint="write two blocks")
    move = [0.0, 0.0, 0.0]
    register = list(m.programmed)
    for k, (axis, increment) in enumerate(zip(AXES, "UVW", strict=True)):
        if axis in words and increment in words:
            m.alarm(f"{axis} and {increment} stand in one G92 block", words[increment], hint="keep one of them")
        if axis in words:
            register[k] = m.value(words[axis])
            move[k] = m.programmed[k] - register[k]
        elif increment in words:
            move[k] = m.value(words[increment])
            register[k] -= move[k]
    m.set_frame("local", frames.shift(*(m.frames["local"][:3, 3] + move)))
    m.programmed = (register[0], register[1], register[2])  # exactly as written
    m.log("position", m.programmed)


FUNCTIONS("F", "Feed", phase="feed", source="4.1")(motion.feed)
FUNCTIONS("S", "Spindle speed", phase="spindle", source="1.2")(motion.spindle_speed)
FUNCTIONS("T", "Tool call", phase="tool", source="5.1")(motion.tool)

SPINDLE = {"M3": "Spindle on clockwise", "M4": "Spindle on counter-clockwise", "M5": "Spindle stop"}


@FUNCTIONS("M3 M4 M5", SPINDLE, group="spindle", phase="auxiliary", power_on="M5", source="9")
def spindle(m: Machine, words: Words) -> None:
    """Before the motion of the block."""
    m.spindle(turning={"M3": 1, "M4": -1, "M5": 0}[words.code])


@FUNCTIONS("M0 M1", {"M0": "Program stop", "M1": "Optional stop"}, phase="end", modal=False, source="ISO 6983")
def program_stop(m: Machine, words: Words) -> None:
    """Wait for the operator, after the motion of the block."""
    m.warn(f"{words.code}: {OUTSIDE}", first_word(words))
    m.stop()


@FUNCTIONS("M2 M30", "Program end", phase="end", modal=False, source="ISO 6983")
def program_end(m: Machine, words: Words) -> None:
    """The program ends here, after the motion of the block; without it, at the end of the text."""
    m.warn(f"{words.code}: {OUTSIDE}", first_word(words))
    m.ended = True


@FUNCTIONS("M6", "Tool change", phase="auxiliary", modal=False, source="ISO 6983")
def tool_change(m: Machine, words: Words) -> None:
    """Nothing: T itself changes the tool (5.1)."""
    m.warn(f"M6: {OUTSIDE}; T itself changes the tool", first_word(words))


COOLANT = {"M7": "Coolant 2 on", "M8": "Coolant on", "M9": "Coolant off"}


@FUNCTIONS("M7 M8 M9", COOLANT, group="coolant", phase="auxiliary", power_on="M9", source="ISO 6983")
def coolant(m: Machine, words: Words) -> None:
    """Before the motion of the block."""
    m.warn(f"{words.code}: {OUTSIDE}", first_word(words))
    m.coolant()
