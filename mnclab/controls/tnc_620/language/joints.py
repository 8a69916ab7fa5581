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
    join(m, words, Rounding, "R", "rounding radius")


@FUNCTIONS("CHF", "Chamfer", takes="length F", collects=True, source="9.2")
def chamfer(m: Machine, words: Words) -> None:
    """Cuts a corner of two lines off, the length along each of them; F counts for the chamfer alone."""
    join(m, words, Chamfer, "length", "chamfer side length")


def join(m: Machine, words: Words, make: type[Rounding] | type[Chamfer], address: str, meaning: str) -> None:
    shown = f"{words.code} {address}" if address.isupper() else words.code
    if address not in words:
        m.alarm(f"{words.code} needs the {'radius R' if address == 'R' else meaning}")
    size = scaled(m, above_zero(m, words[address], f"{shown} ({meaning})"))
    own_feed = above_zero(m, words["F"], f"{words.code} F (feed rate)") if "F" in words else math.nan
    if not m.mark_joint(make(size, m.step, own_feed)):
        m.alarm(f"{words.code} needs a path element directly before it", words[address])
