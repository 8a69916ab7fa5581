"""Contours from formulas: what describes a part, and how parts are joined (chapter 10).

A part is a whole program or a label; it encloses an area, whichever way round, without radius compensation. While the program
of SEL CONTOUR runs, `Definitions` in the memory of the control hold what its designators QC stand for.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from mnclab.controls.tnc_620.contours.area import MOST_ELEMENTS, doubt, enclosed
from mnclab.controls.tnc_620.language.checks import not_negative
from mnclab.controls.tnc_620.language.flow import call_program, label_name
from mnclab.controls.tnc_620.language.parameters import text
from mnclab.controls.tnc_620.reading.definitions import CLOSED, JOINS, OPEN
from mnclab.geometry.frames import Matrix
from mnclab.machine.flow import Recording
from mnclab.machine.machine import Machine
from mnclab.machining.milling.terraces import Formula, Joined, Known, Part, at_depth, parts
from mnclab.text.program import Word

MOST = 128  # contours of a cycle (10.1)


@dataclass
class Definitions:
    """What a program of contour definitions has said so far; `frame` is that of the program with SEL CONTOUR."""

    frame: Matrix
    named: dict[str, Formula] = field(default_factory=dict)  # by designator
    declared: dict[str, Word] = field(default_factory=dict)  # designators of single contours, and whether …
    deep: dict[str, bool] = field(default_factory=dict)  # … they were given a depth
    whole: Formula | None = None  # of the last formula
    areas: Known = field(default_factory=dict)


def described(
    m: Machine, code: str, word: Word, depth: Word | None, after: Recording | None = None, within: Matrix | None = None
) -> tuple[Part, Recording]:
    """The part that a word names, a program or a label, on a copy of the Q parameters; the recording, for the next part.

    An Alarm where there is none, or where it encloses nothing: in the program or label that describes it.
    """
    deep = not_negative(m, depth, f"{code} DEPTH (depth of the contour)") if depth else 0.0
    place = m.span_of(word)
    if m.plane != "XY":
        m.alarm(f"{code}: contours are built for the tool axis Z alone", word)
    with m.variables.own_values(), m.within(unheard="M"):  # F and M are not obeyed (10.1)
        if word.address == "label":
            m.flow.ask(word.value)
            what = f"label {label_name(m, word)}"
            recording = m.record(label_name(m, word), place, after, within=within)
        else:
            what = text(m, word)
            blocks = partial(call_program, m, what, code, word)
            recording = m.record(what, place, after, blocks=blocks, within=within)
    _, region = enclosed(m, recording, what)
    sided = recording.path.side != 0
    if sided.any() or recording.side:
        step = int(recording.path.step[np.argmax(sided)]) if sided.any() else recording.step
        doubt(m, step, f"RL and RR say nothing in the contour of {what}: the formula makes it a pocket or an island")
    return Part(region, deep), recording


def joined(m: Machine, words: Sequence[Word], named: dict[str, Formula]) -> Formula:
    """The formula that words say: brackets first, all operators of one rank, from left to right.

    A warning where different operators follow each other without brackets; an Alarm for a designator without a contour, an
    end too early, and too many contours.
    """
    waiting: list[tuple[Formula | None, Word | None, str]] = []  # outside of brackets: what is there, the operator after it
    opened: list[Word] = []
    have: Formula | None = None
    operator: Word | None = None
    used = ""  # the operator between the operands of this level
    for word in words:
        if word.address == OPEN:
            waiting.append((have, operator, used))
            opened.append(word)
            have, operator, used = None, None, ""
        elif word.address in JOINS:
            if used not in ("", word.address):
                message = f"{used} and {word.address} without brackets: they are of one rank and joined from left to right"
                m.warn(message, word, "write brackets around what belongs together")
            operator, used = word, word.address
        else:
            operand = have
            if word.address == CLOSED:
                opened.pop()
                have, operator, used = waiting.pop()
            else:
                operand = named.get(name := f"QC{word.value:g}")
                if operand is None:
                    m.alarm(f"{name} is no contour yet", word, f"write DECLARE CONTOUR {name} = … before the formula")
            assert operand is not None
            have = operand if operator is None or have is None else Joined(operator.address, have, operand)
            if sum(1 for _ in parts(have)) > MOST:
                m.alarm(f"the formula has more than {MOST} contours", word)
    if have is None or (words and words[-1].address in (*JOINS, OPEN)):
        m.alarm("a designator is missing at the end of the formula", words[-1] if words else None)
    if opened:
        m.alarm("this bracket is not closed", opened[-1])
    return have


def checked(m: Machine, formula: Formula, word: Word, what: str, known: Known | None = None) -> Formula:
    """The formula, if it cuts something at the surface and has not too many elements; `known` are areas of others."""
    different = {id(part.region): part.region for part in parts(formula)}.values()
    if sum(len(loop.points) for region in different for loop in region.loops) > MOST_ELEMENTS:
        m.alarm(f"the contours of {what} have more than {MOST_ELEMENTS} elements", word)
    deepest = max(part.depth for part in parts(formula)) or 1.0
    shallow = min((part.depth for part in parts(formula) if part.depth), default=deepest) / 2
    if not at_depth(formula, shallow, deepest + 1.0, known=known).loops:
        m.alarm(f"{what} encloses nothing", word)
    return formula
