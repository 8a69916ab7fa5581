"""What is put between two path elements: RND, CHF (catalogue: RND, CHF)."""

from __future__ import annotations

import math

from mnclab.controls.tnc_620.language.checks import above_zero
from mnclab.controls.tnc_620.language.motion import scaled
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.path.corners import Chamfer, Rounding

FUNCTIONS = FunctionTable()


@FUNCTIONS("RND", "Corner rounding", takes="R F", collects=True, source="8.13, example")
def rounding(m: Machine, words: Words) -> None:
    """A tangent arc between the element before and the one after; F counts for the rounding alone."""
    mark(m, words, Rounding(size(m, words, "R", "rounding radius"), m.step, own_feed(m, words)), "R")


@FUNCTIONS("CHF", "Chamfer", takes="length F", collects=True, source="9.2")
def chamfer(m: Machine, words: Words) -> None:
    """Cuts a corner of two lines off, the length along each of them; F counts for the chamfer alone."""
    mark(m, words, Chamfer(size(m, words, "length", "chamfer side length"), m.step, own_feed(m, words)), "length")


def size(m: Machine, words: Words, address: str, meaning: str) -> float:
    """The radius or the length, mm on the machine."""
    shown = f"{words.code} {address}" if address.isupper() else words.code
    if address not in words:
        m.alarm(f"{words.code} needs the {'radius R' if address == 'R' else meaning}")
    return scaled(m, above_zero(m, words[address], f"{shown} ({meaning})"))


def own_feed(m: Machine, words: Words) -> float:
    """The feed of the corner alone, mm/min; nan if it has none of its own."""
    return above_zero(m, words["F"], f"{words.code} F (feed rate)") if "F" in words else math.nan


def mark(m: Machine, words: Words, joint: Rounding | Chamfer, address: str) -> None:
    if not m.mark_joint(joint):
        m.alarm(f"{words.code} needs a path element directly before it", words[address])
