"""M functions: those that move nothing here, and the retraction along the tool axis (M140)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.cycles.chain import TILT
from mnclab.controls.tnc_620.language.auxiliary import above_tip, rate
from mnclab.controls.tnc_620.language.values import not_negative, one_of, warn_once, whole
from mnclab.machine.axes import chain, direction, reference
from mnclab.machine.control import FunctionTable, Setting, Words
from mnclab.machine.coordinates import PLANES
from mnclab.machine.machine import INF, Machine
from mnclab.text.alarm import hint
from mnclab.text.program import Word

# M functions that move nothing here: ends of what cannot be on, and what only tells the drives or the operator.
# The first are accepted without a word: what they end is refused where it begins. The others are named once, for on a machine
# they do something: they are of this control, or of the older ones (TNC 155 to iTNC 530) whose programs still run.

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


# Retraction along the tool axis (M140).

AWAY_SETTINGS = (
    Setting(
        "retract_to", 500.0, "where M140 MB MAX leads the spindle along the tool axis, if the limits name no travel",
        "Klartext, not described", unit="mm",
    ),
)  # fmt: skip
KINEMATICS = 'with the kinematics of the machine it is: Setup(kinematics="table-ac")'
FLAT = 1e-9  # of a direction, along an axis that it does not move
DISTANCE, FAR = "M140:MB", "M140:MBMAX"
AWAY_WORDS = {
    DISTANCE: "distance of the retraction", FAR: "to the end of the travel", "M140:F": "feed rate of the retraction",
    "M140:FMAX": "rapid traverse",
}  # fmt: skip


@FUNCTIONS(
    "M140", "Retraction along the tool axis", takes=" ".join(AWAY_WORDS), phase="start", modal=False,
    source="Klartext, not described",
)  # fmt: skip
def retraction(m: Machine, words: Words) -> None:
    """Before the motion of the block: by MB, or with MB MAX to the end of the travel; at rapid, or at the F behind it."""
    word = one_of(m, words, (DISTANCE, FAR), "one distance")
    if word is None:
        m.alarm("M140 needs MB and a distance, or MB MAX", words.words[0], "for example M140 MB MAX or M140 MB 50")
    if TILT in m.frames and m.tables.kinematics is None:
        m.alarm("M140 in a tilted plane is not built yet", words.words[0], KINEMATICS)
    if word.address == DISTANCE and word.value is None:
        m.alarm("M140 MB needs a number, or MAX", word)
    if word.address == FAR and word.value is not None:
        m.alarm("M140 MB MAX takes no number", word)
    retract(m, "M140", word, own_feed(m, words))


def retract(m: Machine, code: str, word: Word, f: float) -> None:
    """Along the tool axis by the number of a word, or without one to the end of the travel."""
    if m.tables.kinematics is not None:
        tool = direction(m)
        far = room(m, code, tool, word) if word.value is None else not_negative(m, word, f"{code} MB ({AWAY_WORDS[DISTANCE]})")
        x, y, z = m.to_program(np.array(m.tip) + far * tool)
        return m.line(x, y, z, f=f)
    k, target = PLANES[m.plane][2], list(m.tip)
    if word.value is not None:
        target[k] += not_negative(m, word, f"{code} MB (distance of the retraction)")
    else:
        target[k] = end_of_travel(m, code, k, word) - above_tip(m)[k]
        if target[k] < m.tip[k] - 1e-6:
            m.alarm(f"{code} MB MAX leads up alone: the tool stands {m.tip[k] - target[k]:g} mm above the end already", word)
    x, y, z = m.to_program(target)
    m.line(x, y, z, f=f)


def room(m: Machine, code: str, tool: NDArray[np.float64], word: Word) -> float:
    """How far the tool can go along a direction (3,) of the part until the first linear axis is at the end of its travel, mm."""
    here, kinematics = np.array(reference(m)), chain(m)
    along = kinematics.references(np.array(m.tip) + tool, np.array(m.rotary), m.tool.effective_length) - here
    ways, travel = [], m.setup.limits.travel
    for k in range(3):
        if abs(along[k]) < FLAT:
            continue
        if travel is not None and math.isfinite(end := travel[k][int(along[k] > 0)]):
            ways.append((end - here[k]) / along[k])
        elif k == 2 and along[k] > 0:
            ways.append((end_of_travel(m, code, k, word) - here[k]) / along[k])
    if not ways:
        hint = "Setup(limits=mnclab.Limits(travel=…)) says how far X, Y and Z go"
        m.alarm(f"{code} MB MAX: where the axes end that the tool lies along is not known", word, hint)
    if min(ways) < -1e-6:
        m.alarm(f"{code} MB MAX leads away alone: the tool stands {-min(ways):g} mm beyond the end already", word)
    return float(max(min(ways), 0.0))


def end_of_travel(m: Machine, code: str, axis: int, word: Word) -> float:
    """The machine coordinate of the spindle reference where an axis ends: of the limits, else that of the setting."""
    travel = m.setup.limits.travel
    if travel is not None and math.isfinite(travel[axis][1]):
        return travel[axis][1]
    end: float = m.settings["retract_to"]
    if "retract_to" not in m.setup.settings:
        hint = "Setup(limits=mnclab.Limits(travel=…)) or the setting retract_to says where the axis ends"
        warn_once(m, f"{code} MB MAX leads to {'XYZ'[axis]}{end / m.variable_unit:g} of the machine", word, hint)
    return end


def own_feed(m: Machine, words: Words) -> float:
    word = one_of(m, words, ("M140:F", "M140:FMAX"), "one feed")
    if word is None or word.address == "M140:FMAX":
        return INF
    if word.value is None:
        m.alarm("M140 F needs a number", word, "for example M140 MB 50 F750")
    return rate(m, word, "M140 F (feed rate of the retraction)")
