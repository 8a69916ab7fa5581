"""Q parameters: formulas, texts, and the functions FN that calculate (catalogue: Q parameters, FN, Q formula, QS).

What the control keeps in Q108 to Q114 cannot be assigned; the rest of Q100 to Q199 it overwrites with results.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable

from mnclab.controls.tnc_620.language.checks import whole
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import tool_axis
from mnclab.machine.machine import Machine
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word
from mnclab.text.strings import TextFormula

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
