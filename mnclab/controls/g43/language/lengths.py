"""Tool length compensation: G43, G44, G49 and the corrector D (7.1).

What goes to the axes is base = programmed + sign · offset(D), with the sign +1 for G43, -1 for G44 and 0 for G49; the tip
of a tool of length L is then at base - L. The manual moves nothing in the block of G43: an offset counts along an axis from
the next word of that axis on. So the offsets that count (`Memory.active_offsets`) follow the wanted ones axis by axis.
"""

from __future__ import annotations

from mnclab.controls.g43.state import NONE, Offsets, memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import AXES, first_word
from mnclab.geometry import frames
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
SIGNS = {"G43": 1, "G44": -1, "G49": 0}
WAYS = {"G43": ", positive", "G44": ", negative", "G49": " off"}
TITLES = {code: f"Tool length compensation{way}" for code, way in WAYS.items()}


@FUNCTIONS("G43 G44 G49", TITLES, group="length compensation", phase="length", power_on="G49", source="7.1")
def compensation(m: Machine, words: Words) -> None:
    """The offsets of corrector D count from the next motion along each axis on; without D the corrector stays."""
    motion.uncompensated(m, words)
    memory(m).sign = SIGNS[words.code]
    want(m, first_word(words))


@FUNCTIONS("D", "Corrector", phase="corrector", source="7.1")
def corrector(m: Machine, words: Words) -> None:
    """Offsets for G43 and G44, and the radius for G41 and G42; no axis moves."""
    word = words["D"]
    number = m.value(word)
    if number != int(number) or not 0 <= number <= 99:
        m.alarm(f"D (corrector) must be a whole number from 0 to 99, got {number:g}", word)
    motion.refuse_change(m, "corrector", word)
    choose(m, int(number), word)


def choose(m: Machine, number: int, word: Word | None) -> None:
    """Corrector `number` from now on: its offsets, and its radius where the tool table has such a row."""
    memory(m).corrector = number
    m.log("corrector", number)
    row = m.tables.tools.get(number)
    if number and row is not None:
        m.change("tool", m.tables.tools[m.tool.number].of_radius(row.radius, row.dr))
    want(m, word)


def want(m: Machine, word: Word | None) -> None:
    """Work out the offsets that G43 and D ask for."""
    sign = memory(m).sign
    x, y, z = offsets(m, memory(m).corrector, word) if sign else NONE
    memory(m).wanted_offsets = (sign * x, sign * y, sign * z)


def offsets(m: Machine, number: int, word: Word | None) -> Offsets:
    """The offsets of a corrector: its row, or else the length of the tool of that number; D0 has none."""
    if number == 0:
        return NONE
    if number in m.tables.correctors:
        return m.tables.correctors[number][:3]
    if number in m.tables.tools:
        return 0.0, 0.0, m.tables.tools[number].effective_length
    if number not in (told := memory(m).empty_correctors):
        told.add(number)
        m.warn(f"D{number} (corrector) has no offsets: they count as 0", word, hint="Setup(correctors={…}) gives them")
    return NONE


def pending(m: Machine) -> bool:
    """Whether an offset waits for the next motion of its axis."""
    return memory(m).wanted_offsets != memory(m).active_offsets


def activate(m: Machine, axes: str) -> None:
    """The offsets along axes that move now count: programmed coordinates stay, and the next motion takes them up."""
    wanted, active = memory(m).wanted_offsets, memory(m).active_offsets
    x, y, z = (wanted[k] if axis in axes else active[k] for k, axis in enumerate(AXES))
    if (x, y, z) != active:
        memory(m).active_offsets = (x, y, z)
        place(m, "programmed")


def place(m: Machine, keep: str) -> None:
    """The frame from programmed coordinates to the tip: the offsets that count, less the length of the tool."""
    x, y, z = memory(m).active_offsets
    shift = (x, y, z - m.tool.effective_length)
    m.set_frame("length", frames.shift(*shift) if any(shift) else None, keep)


FUNCTIONS("T", "Tool", phase="tool", source="7.1")(motion.choose_tool)


@FUNCTIONS("M6", "Tool change", phase="change", modal=False, source="7.1")
def tool_change(m: Machine, words: Words) -> None:
    """The tool of T comes into the spindle and D becomes its number; no axis moves."""
    motion.change_tool(m, words)
    place(m, "tip")
    choose(m, m.tool.number, first_word(words))
