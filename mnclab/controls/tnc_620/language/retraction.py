"""Retraction along the tool axis (M140)."""

from __future__ import annotations

import math

from mnclab.controls.tnc_620.cycles.chain import TILT
from mnclab.controls.tnc_620.language.checks import not_negative, one_of, warn_once
from mnclab.controls.tnc_620.language.feeds import rate
from mnclab.controls.tnc_620.language.machine_datum import above_tip
from mnclab.machine.control import FunctionTable, Setting, Words
from mnclab.machine.coordinates import PLANES
from mnclab.machine.machine import INF, Machine
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()
SETTINGS = (
    Setting(
        "retract_to", 500.0, "where M140 MB MAX leads the spindle along the tool axis, if the limits name no travel",
        "Klartext, not described", unit="mm",
    ),
)  # fmt: skip
DISTANCE, FAR = "M140:MB", "M140:MBMAX"
WORDS = {
    DISTANCE: "distance of the retraction", FAR: "to the end of the travel", "M140:F": "feed rate of the retraction",
    "M140:FMAX": "rapid traverse",
}  # fmt: skip


@FUNCTIONS(
    "M140", "Retraction along the tool axis", takes=" ".join(WORDS), phase="start", modal=False, source="Klartext, not described"
)
def retraction(m: Machine, words: Words) -> None:
    """Before the motion of the block: by MB, or with MB MAX to the end of the travel; at rapid, or at the F behind it."""
    word = one_of(m, words, (DISTANCE, FAR), "one distance")
    if word is None:
        m.alarm("M140 needs MB and a distance, or MB MAX", words.words[0], "for example M140 MB MAX or M140 MB 50")
    if TILT in m.frames:
        m.alarm("M140 in a tilted plane is not built yet", words.words[0])
    if word.address == DISTANCE and word.value is None:
        m.alarm("M140 MB needs a number, or MAX", word)
    if word.address == FAR and word.value is not None:
        m.alarm("M140 MB MAX takes no number", word)
    retract(m, "M140", word, own_feed(m, words))


def retract(m: Machine, code: str, word: Word, f: float) -> None:
    """Along the tool axis by the number of a word, or without one to the end of the travel; the plane is not tilted."""
    k, target = PLANES[m.plane][2], list(m.tip)
    if word.value is not None:
        target[k] += not_negative(m, word, f"{code} MB (distance of the retraction)")
    else:
        target[k] = end_of_travel(m, code, k, word) - above_tip(m)[k]
        if target[k] < m.tip[k] - 1e-6:
            m.alarm(f"{code} MB MAX leads up alone: the tool stands {m.tip[k] - target[k]:g} mm above the end already", word)
    x, y, z = m.to_program(target)
    m.line(x, y, z, f=f)


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
