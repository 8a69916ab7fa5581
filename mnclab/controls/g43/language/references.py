"""Reference points of the machine: G27 to G30, and G28.1 and G30.1, which set them.

The first is machine zero, the others are settings; all are places of the spindle.
"""

from __future__ import annotations

from mnclab.controls.g43.language import rotary
from mnclab.controls.g43.language.motion import targets
from mnclab.controls.g43.language.numbers import whole
from mnclab.controls.g43.language.transformations import transformed
from mnclab.controls.g43.remarks import ISO, undescribed
from mnclab.controls.g43.settings import REFERENCES
from mnclab.controls.g43.state import Offsets, memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import AXES, first_word
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine

FUNCTIONS = FunctionTable()
TITLES = {"G28": "Return to the reference point", "G30": "Return to the second, third or fourth reference point"}
SETTING = {"G28.1": "Set the first reference point", "G30.1": "Set the second reference point"}
NEAR = 1e-3  # mm from a reference point


def tip_at(m: Machine, number: int) -> Offsets:
    """Where the tip is while the spindle stands at a reference point, machine coordinates."""
    x, y, z = memory(m).references.get(number, (0.0, 0.0, 0.0))
    if number > 1 and number not in memory(m).references:
        x, y, z = (float(m.settings[f"{REFERENCES[number]}_reference_{axis}"]) for axis in "xyz")
    return x, y, z - m.tool.effective_length


@FUNCTIONS("G28", TITLES, takes="X Y Z A B C", still=True, owns=True, modal=False, source=ISO)
@FUNCTIONS("G30", TITLES, takes="X Y Z A B C P", still=True, owns=True, modal=False, source=ISO)
def reference(m: Machine, words: Words) -> None:
    """The axes written go to their points at rapid, then to the reference point (G30: of number P); without axes all go."""
    undescribed(m, words)
    motion.uncompensated(m, words)
    number = 1 if words.code == "G28" else whole(m, words, "P", 2, 4) if "P" in words else 2
    to, turned = targets(m, words), rotary.angles_of(m, words)
    refuse_crooked(m, words, to)
    if to or turned is not None:
        rotary.go(m, to, turned, rapid=True)
    memory(m).intermediate = dict(to)
    home = m.to_program(tip_at(m, number))
    every = not to and turned is None
    rotary.go(m, {axis: home[k] for k, axis in enumerate(AXES.lower()) if axis in to or every},
              rotary.at_zero(m, words), rapid=True)  # fmt: skip


def refuse_crooked(m: Machine, words: Words, to: dict[str, float]) -> None:
    """An Alarm where an axis of the program is none of the machine's: it could not go to its reference point alone."""
    if m.shift is not None or not to or len(to) == 3:
        return
    for axis in to:
        k = "xyz".index(axis)
        row, column = m.matrix[k, :3].tolist(), m.matrix[:3, k].tolist()
        if any(row[j] or column[j] for j in range(3) if j != k):
            by = transformed(m) or "a turned work offset"
            m.alarm(f"{words.code} {axis.upper()} cannot stand while {by} is active: the axis is turned", words[axis.upper()])


@FUNCTIONS("G29", "Return from the reference point", takes="X Y Z", still=True, modal=False, source=ISO)
def back(m: Machine, words: Words) -> None:
    """The axes written go at rapid to the point that the last G28 or G30 went over, then to their own."""
    motion.uncompensated(m, words)
    over = memory(m).intermediate
    written = [axis for axis in AXES.lower() if axis.upper() in words]
    for axis in written:
        if axis not in over:
            m.alarm(f"G29 {axis.upper()}: no G28 or G30 has moved this axis before", words[axis.upper()])
    if not written:
        m.alarm("G29 needs X, Y or Z", first_word(words))
    m.rapid(**{axis: over[axis] for axis in written})
    m.rapid(**targets(m, words))


@FUNCTIONS("G27", "Reference point check", takes="X Y Z", still=True, modal=False, source=ISO)
def check(m: Machine, words: Words) -> None:
    """The axes written go to their points at rapid; an alarm if that is not the reference point."""
    motion.uncompensated(m, words)
    to = targets(m, words)
    if not to:
        m.alarm("G27 needs X, Y or Z", first_word(words))
    m.rapid(**to)
    home = tip_at(m, 1)
    for axis in to:
        k = "xyz".index(axis)
        if abs(off := m.tip[k] - home[k]) > NEAR:
            m.alarm(f"G27: {axis.upper()} is not at its reference point, but {off:.4g} mm away", words[axis.upper()])


@FUNCTIONS("G28.1 G30.1", SETTING, phase="local", still=True, modal=False, source="LinuxCNC")
def set_reference(m: Machine, words: Words) -> None:
    """The present place of the spindle becomes the reference point. No motion."""
    x, y, z = m.tip
    memory(m).references[1 if words.code == "G28.1" else 2] = (x, y, z + m.tool.effective_length)
