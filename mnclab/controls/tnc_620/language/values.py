"""Values: which word of a block is given, from where its number counts, within which limits it lies; Q parameters and texts."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable

from mnclab.controls.tnc_620.reading.words import LENGTHS
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import tool_axis
from mnclab.machine.machine import INF, Machine
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word
from mnclab.text.strings import TextFormula


def first(words: Words) -> Word | None:
    """The word that an alarm about the whole block points at."""
    return words.words[0] if words.words else None


def one_of(m: Machine, words: Words, addresses: Iterable[str], allowed: str) -> Word | None:
    """The word that is written of several that exclude each other."""
    given = [words[address] for address in addresses if address in words]
    if len(given) > 1:
        one, other = (str(word).rpartition(":")[2] for word in given[:2])
        m.alarm(f"{one} and {other} stand in one block: {allowed} is allowed", given[1])
    return given[0] if given else None


def counted(m: Machine, word: Word, before: float, unit: float = 1.0) -> float:
    """The value of a word, which is told in units of so many mm; an incremental one counts from `before`."""
    value = m.value(word) * unit
    return before + value if word.incremental else value


def in_units(m: Machine, word: Word, value: float) -> float:
    """A length in mm as the program writes it; what is no length stays."""
    is_told = word.address in LENGTHS and m.variable_unit != 1
    return float(f"{value / m.variable_unit:.12g}") if is_told else value


def above_zero(m: Machine, word: Word, name: str, most: float = INF) -> float:
    value = m.value(word)
    if not 0 < value <= most:
        limit = f" and at most {most:g}" if most < INF else ""
        m.alarm(f"{name} must be greater than 0{limit}, got {in_units(m, word, value):g}", word)
    return value


def not_negative(m: Machine, word: Word, name: str) -> float:
    value = m.value(word)
    if value < 0:
        m.alarm(f"{name} must be at least 0, got {in_units(m, word, value):g}", word)
    return value


def whole(m: Machine, word: Word, name: str, least: int, most: int) -> int:
    value = m.value(word)
    if value != int(value) or not least <= value <= most:
        m.alarm(f"{name} must be a whole number from {least} to {most}, got {value:g}", word)
    return int(value)


def warn_once(m: Machine, message: str, word: Word | None = None, hint: str = "") -> None:
    """A warning at the first of its places alone: what a program says in every block is not told for every block."""
    if message not in memory(m).told:
        memory(m).told |= {message}
        m.warn(message, word, hint)


def refuse_on_cylinder(m: Machine, words: Words) -> None:
    """An alarm where the contour of a cylinder is read, which has elements of its own (9.2)."""
    if memory(m).developed is not None:
        m.alarm(f"{words.code} cannot stand in the contour of a cylinder", first(words), "L, CHF, RND, CR and CT can")


# Q parameters: formulas, texts, and the functions FN that calculate (catalogue: Q parameters, FN, Q formula, QS).
#
# What the control keeps in Q108 to Q114 cannot be assigned; the rest of Q100 to Q199 it overwrites with results.

FUNCTIONS = FunctionTable()

TITLES = {
    "FN 0": "Assignment", "FN 1": "Addition", "FN 2": "Subtraction", "FN 3": "Multiplication", "FN 4": "Division",
    "FN 5": "Square root", "FN 6": "Sine", "FN 7": "Cosine", "Q": "Formula",
}  # fmt: skip


def text(m: Machine, word: Word) -> str:
    """The text of a word: as it is written, or that of a QS parameter."""
    if not isinstance(word.value, TextFormula):
        return str(word.value)
    try:
        return word.value.evaluate(m.variables)
    except Alarm as alarm:
        alarm.span = alarm.span and alarm.span._replace(program=m.program)
        raise


def give(m: Machine, word: Word, value: float | str) -> None:
    name = str(word.value)
    if name in PREASSIGNED:
        m.alarm(
            f"{name} ({KEPT[name][0]}) is kept by the control and cannot be assigned", word, "take another parameter"
        )
    m.variables[name] = value


@FUNCTIONS(", ".join(TITLES), TITLES, takes="target value undefined", collects=True, source="10.1, example")
def assign(m: Machine, words: Words) -> None:
    """A Q parameter takes the value of its formula, with the variables as they stand; SET UNDEFINED takes it away."""
    if "undefined" in words:
        m.variables.forget(str(words["target"].value))
    else:
        give(m, words["target"], m.value(words["value"]))


@FUNCTIONS("QS, DECLARE STRING", "Text", takes="target value", source="12.6")
def assign_text(m: Machine, words: Words) -> None:
    """A QS parameter takes a text: texts in quotes and QS parameters joined with ||, TOCHAR, SUBSTR."""
    m.variables[str(words["target"].value)] = text(m, words["value"])


@FUNCTIONS("FN 8,", "Root of a sum of squares", takes="target first second", source="Klartext, not described")
def root_of_squares(m: Machine, words: Words) -> None:
    """FN 8: Q1 = +5 LEN +4 is the hypotenuse of 5 and 4."""
    give(m, words["target"], math.hypot(m.value(words["first"]), m.value(words["second"])))


@FUNCTIONS("FN 13,", "Angle", takes="target first second", source="Klartext, not described")
def angle(m: Machine, words: Words) -> None:
    """FN 13: Q1 = +25 ANG +50 is the angle, 0 to 360 degrees, of which 25 is the opposite side and 50 the adjacent one."""
    opposite, adjacent = m.value(words["first"]), m.value(words["second"])
    if opposite == adjacent == 0:
        m.alarm("FN 13: two sides of length 0 have no angle", words["first"])
    give(m, words["target"], math.degrees(math.atan2(opposite, adjacent)) % 360)


@FUNCTIONS("FN 14,", "Error", takes="number", source="Klartext, not described")
def error(m: Machine, words: Words) -> None:
    """The program itself finds something wrong and stops."""
    number = whole(m, words["number"], "FN 14 ERROR", 0, 1199)
    m.alarm(f"FN 14: the program stops with error {number}", words["number"])


def spindle_status(m: Machine) -> float:
    """0 M3, 1 M4, 2 M5 after M3, 3 M5 after M4, -1 before the first of them."""
    if m.turning:
        return 0.0 if m.turning > 0 else 1.0
    log = m.logs.by_name.get("turning")
    senses = [value for value in log.close(m.step)[1] if value] if log else []
    return -1.0 if not senses else 2.0 if senses[-1] > 0 else 3.0


KEPT: dict[str, tuple[str, Callable[[Machine], float | None]]] = {
    "Q108": ("radius of the active tool with its deltas", lambda m: m.tool.effective_radius / m.variable_unit),
    "Q109": ("tool axis", lambda m: float(tool_axis(m)) if m.tool.number else -1.0),  # X Y Z: 0 1 2; -1 while no tool was called
    "Q110": ("spindle status", spindle_status),
    "Q111": ("coolant", lambda m: 0.0 if m.modal.get("coolant", "M9") == "M9" else 1.0),
    "Q112": ("overlap factor of pockets", lambda m: float(m.settings["overlap"])),
    "Q113": ("unit of the main program", lambda m: 1.0 if memory(m).main_unit == "INCH" else 0.0),
    "Q114": ("length of the active tool with its deltas", lambda m: m.tool.effective_length / m.variable_unit),
}
PREASSIGNED = {name: value for name, (_, value) in KEPT.items()}

NAMES = re.compile(r"(?:Q1?\d{1,3}|Q[LR][1-4]?\d{1,2}|QS1?\d{1,3})")


def start(m: Machine) -> None:
    """The values that were there before the program; QL parameters belong to a program and have none."""
    for name, value in m.setup.variables.items():
        if name.startswith("QS"):
            fits = isinstance(value, str)
        else:
            fits = type(value) in (int, float) and math.isfinite(value)  # type: ignore[arg-type]
        if not NAMES.fullmatch(name) or not fits:
            m.alarm(f"Setup(variables=…): {name} cannot be {value!r}", hint="numbers in Q and QR, texts in QS")
        if name not in PREASSIGNED and not name.startswith("QL"):
            m.variables[name] = value if isinstance(value, str) else float(value)
