"""Tangential approach and departure: APPR LT, DEP LT (catalogue: APPR, DEP)."""

from __future__ import annotations

from mnclab.controls.tnc_620.language.motion import coordinates, feed, refuse_rapid, side
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import PLANES, Machine
from mnclab.path.corners import Approach

FUNCTIONS = FunctionTable()


def length(m: Machine, words: Words) -> float:
    """LEN, mm."""
    if "LEN" not in words:
        m.alarm(f"{words.code} needs the length LEN", None)
    value = m.value(words["LEN"])
    if value <= 0:
        m.alarm(f"{words.code} LEN (length of the line) must be greater than 0, got {value:g}", words["LEN"])
    return value


@FUNCTIONS("APPR LT,", "Approach on a tangent line", takes="X Y Z LEN R0 RL RR F FMAX FAUTO", source="APPR")
def approach(m: Machine, words: Words) -> None:
    """To the first contour point over a line tangent to the first element, with compensation from there on."""
    f = feed(m, words)
    refuse_rapid(m, words)
    if "RL" not in words and "RR" not in words:
        m.alarm("APPR LT needs RL or RR", None, hint="the side on which the tool runs beside the contour")
    if m.side:
        m.alarm("APPR LT begins radius compensation, which is active already", None, hint="end it with DEP or R0 first")
    distance, to = length(m, words), coordinates(m, words)
    if "x" not in to or "y" not in to:
        m.alarm("APPR LT needs X and Y of the first contour point", None)
    side(m, words, begins=True)
    m.line(**to, f=f, joint=Approach(distance, m.step))


@FUNCTIONS("DEP LT,", "Departure on a tangent line", takes="LEN F FAUTO", source="DEP")
def departure(m: Machine, words: Words) -> None:
    """A line tangent to the last element; at its end the compensation is off, and the register is where the tool stands."""
    f = feed(m, words)
    distance = length(m, words)
    if not m.side:
        m.alarm(
            "DEP LT ends radius compensation, and none is active", None, hint="begin it with APPR LT or with RL, RR"
        )
    heading, normal = m.heading(), PLANES[m.plane][2]
    if heading is None or abs(heading[normal]) > 1e-9:
        m.alarm("DEP LT needs a path element in the working plane directly before it", None)
    end = m.to_program(t + distance * d for t, d in zip(m.tip, heading, strict=True))
    m.line(*end, f=f)
    m.observe()
    m.change("side", 0)
