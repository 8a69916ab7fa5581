"""What is put between two path elements: RND, CHF (catalogue: RND, CHF), M97 and M98 at the end of a block."""

from __future__ import annotations

import math

from mnclab.controls.tnc_620.language.checks import above_zero
from mnclab.controls.tnc_620.language.feeds import rate
from mnclab.controls.tnc_620.language.motion import heading, scaled
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.path.corners import Chamfer, Open, Prolonged, Rounding

FUNCTIONS = FunctionTable()
ELEMENTS = ("L", "LP", "C", "CR", "CT", "CP", "CTP", "FL", "FLT", "FC", "FCT")


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
    own_feed = rate(m, words["F"], f"{words.code} F (feed rate)") if "F" in words else math.nan
    if not m.mark_joint(make(size, m.step, own_feed)):
        last = m.recorder.last()
        hint = "M97 or M98 stands there" if last and isinstance(last[1], Prolonged | Open) else ""
        m.alarm(f"{words.code} needs a path element directly before it", words[address], hint)


@FUNCTIONS("M97", "Small contour steps", phase="end", modal=False, collects=True, source="Klartext, not described")
def small_step(m: Machine, words: Words) -> None:
    """At the outside corner that ends the block no arc is put in: the tool goes over the point where the offsets meet."""
    mark(m, words, Prolonged(m.step))


@FUNCTIONS("M98", "Open contour corners", phase="end", modal=False, collects=True, source="Klartext, not described")
def open_corner(m: Machine, words: Words) -> None:
    """The tool goes to the place square to the end of the block; where the contour goes on at an angle that is an alarm."""
    mark(m, words, Open(m.step))


def mark(m: Machine, words: Words, joint: Prolonged | Open) -> None:
    """What the compensation does at the end of the block."""
    word = words.words[0]
    if m.recorded_only:
        m.alarm(f"{words.code} cannot stand in a contour that a cycle reads", word)
    program = m.flow.program
    if program.keywords[program.keyword[m.flow.current]] not in ELEMENTS:
        m.alarm(f"{words.code} stands in the block of a path element", word)
    if m.pending is None:
        heading(m, words)
    if not m.mark_joint(joint):
        m.alarm(f"{words.code} needs a path element that has no joint at its end yet", word)
