"""Motion, dwell, feed and spindle; planes, dimensions and the like are those of all controls of G words."""

from __future__ import annotations

from mnclab.controls.g43.language.lengths import activate
from mnclab.controls.g43.remarks import ISO, remark, undescribed
from mnclab.controls.g43.state import memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.functions import ARCS, SPINDLE, functions
from mnclab.controls.word_address.motion import AXES, first_word
from mnclab.machine.control import Control, FunctionTable, Modal, Words
from mnclab.machine.machine import Machine
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word, digits

FUNCTIONS = FunctionTable()
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


def seconds_of_p(m: Machine, word: Word) -> float:
    """What 1 of a P that is a dwell stands for, s."""
    in_seconds = m.settings["dwell_p"]
    if in_seconds == "point":
        in_seconds = "seconds" if "." in written(m, word) else "milliseconds"
    return 1.0 if in_seconds == "seconds" else 0.001


def written(m: Machine, word: Word) -> str:
    """A word of the running program as it stands in the text."""
    line, column, length, _ = word.span
    return m.flow.program.line_text(line)[column - 1 : column - 1 + length]


@FUNCTIONS("G4", "Dwell", phase="dwell", takes="P X", still=True, modal=False, source=ISO)
def dwell(m: Machine, words: Words) -> None:
    """A pause of X seconds, or of P as the setting dwell_p has it."""
    undescribed(m, words)
    if len(words.words) != 2:
        m.alarm("G4 needs P or X, the time", first_word(words))
    word = words.words[1]
    value = m.value(word)
    if not 0 <= value <= 1e6:
        m.alarm(f"G4 {word.address} (dwell) must be at least 0 and at most 1e+06, got {value:g}", word)
    m.dwell(value if word.address == "X" else value * seconds_of_p(m, word))


FUNCTIONS("F", "Feed", phase="feed", source="7.1, example")(motion.feed)
FUNCTIONS("S", "Spindle speed", phase="spindle", source=ISO)(motion.spindle_speed)
FUNCTIONS("M3 M4 M5", SPINDLE, group="spindle", phase="auxiliary", power_on="M5", source=ISO)(motion.spindle)
FUNCTIONS |= functions(remark, ISO, plane="7.1, example")
