"""M functions that move nothing here: ends of what cannot be on, and what only tells the drives or the operator.

The first are accepted without a word: what they end is refused where it begins. The others are named once, for on a machine
they do something: they are of this control, or of the older ones (TNC 155 to iTNC 530) whose programs still run.
"""

from __future__ import annotations

from mnclab.controls.tnc_620.cycles.chain import TILT
from mnclab.controls.tnc_620.language.checks import warn_once, whole
from mnclab.machine.control import FunctionTable, Setting, Words
from mnclab.machine.machine import Machine
from mnclab.text.alarm import hint

FUNCTIONS = FunctionTable()
SOURCE = "Klartext, not described"
LAST = 999  # M function of a machine tool builder
SETTINGS = (
    Setting(
        "machine_functions", "warn", "M functions of the machine tool builder, which no manual of the control names", SOURCE,
        {"warn": "a warning, and nothing happens", "refuse": "an alarm"},
    ),
)  # fmt: skip
ENDS = {
    "M102": "End of M101", "M107": "No error with replacement tools", "M108": "End of M107", "M113": "End of M112",
    "M115": "End of M114", "M135": "End of M134", "M137": "End of M136", "M141": "No probe monitoring",
    "M143": "Cancelling a basic rotation", "M145": "End of M144", "M149": "End of M148",
}  # fmt: skip
NAMED = {
    "M90": "Constant speed at corners", "M101": "Replacement tool", "M105": "Second gain of the drives",
    "M106": "First gain of the drives", "M134": "Exact stop of rotary axes", "M148": "Lift-off at stop",
    "M200": "Laser: voltage", "M201": "Laser: voltage by distance", "M202": "Laser: voltage by speed",
    "M203": "Laser: voltage by time", "M204": "Laser: pulse",
}  # fmt: skip
WHY = {
    "M90": "corners are taken as the limits of the machine say", "M101": "no tool wears out", "M148": "nothing stops the program",
    "M134": "rotary axes stop by themselves", "M105": "drives follow exactly", "M106": "drives follow exactly",
}  # fmt: skip
OUTPUT = "what a laser or a plasma torch does is not simulated"
WORDS = {
    "M101:BT": "blocks until the tool is changed", "M120:LA": "blocks that are looked at in advance",
    "M200:V": "voltage", "M201:V": "voltage", "M202:FNR": "number of the characteristic", "M203:V": "voltage",
    "M203:TIME": "time", "M204:V": "voltage", "M204:TIME": "time",
}  # fmt: skip


@FUNCTIONS(" ".join(ENDS), ENDS, phase="end", modal=False, source=SOURCE)
def nothing(m: Machine, words: Words) -> None:
    """What it ends was never on, and what it allows was never forbidden: nothing changes."""


def told(m: Machine, words: Words) -> None:
    """Nothing moves; a warning says so once in a program."""
    warn_once(m, f"{words.code} changes nothing here: {WHY.get(words.code, OUTPUT)}", words.words[0])


for code, title in NAMED.items():
    own = " ".join(word for word in WORDS if word.startswith(f"{code}:"))
    FUNCTIONS(code, title, phase="start", modal=False, takes=own, source=SOURCE)(told)


@FUNCTIONS("M120", "Look-ahead of the compensated contour", takes="M120:LA", phase="start", source="11.9")
def look_ahead(m: Machine, words: Words) -> None:
    """It would leave out what a tool that does not fit damages: such a contour is refused, or marked, however long."""
    if (word := words.get("M120:LA")) is None:
        return
    if word.value is None:
        m.alarm("M120 LA needs a number", word, "for example M120 LA5")
    if whole(m, word, "M120 LA (blocks looked at in advance)", 0, 99):
        m.change("look_ahead", True)
        warn_once(m, "M120 leaves nothing out: contours in which the tool does not fit are refused", words.words[0])


@FUNCTIONS("M130", "Positions in the untilted system", phase="start", modal=False, source="11.9")
def untilted(m: Machine, words: Words) -> None:
    """Nothing changes where the plane is not tilted."""
    if TILT in m.frames:
        m.alarm("M130 in a tilted plane is not built yet", words.words[0])


@FUNCTIONS("M", "Function of the machine tool builder", phase="end", modal=False, source=SOURCE)
def machine_function(m: Machine, words: Words) -> None:
    """What the machine tool builder may have added: it has no effect here."""
    word, code = words.words[0], words.code
    if m.value(word) > LAST or m.settings["machine_functions"] == "refuse":
        m.alarm(f"{code} is not a function of this control", word, hint(code, m.control.functions))
    warn_once(m, f"{code} is no function of the control, but of the machine tool builder: it has no effect here", word)
