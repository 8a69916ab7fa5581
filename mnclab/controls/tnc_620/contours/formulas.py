"""Contours from formulas: SEL CONTOUR, DECLARE CONTOUR, QC10 = …, CONTOUR DEF; what describes a part, how parts are joined (10).

A part is a whole program or a label; it encloses an area, whichever way round, without radius compensation. While the program
of SEL CONTOUR runs, `Definitions` in the memory of the control hold what its designators QC stand for.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from mnclab.controls.tnc_620.contours.area import MOST_ELEMENTS, doubt, enclosed, fault
from mnclab.controls.tnc_620.language.flow import call_program, label_name
from mnclab.controls.tnc_620.language.values import not_negative, text
from mnclab.controls.tnc_620.reading.definitions import CLOSED, JOINS, OPEN
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.frames import Matrix
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.flow import Recording, determine
from mnclab.machine.machine import Machine
from mnclab.machining.milling.terraces import DeepArea, Formula, Joined, Known, at_depth, parts
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
) -> tuple[DeepArea, Recording]:
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
    return DeepArea(region, deep), recording


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


# SEL CONTOUR, DECLARE CONTOUR, QC10 = …, CONTOUR DEF: contours from formulas of programs and labels (chapter 10).
#
# What the last of SEL CONTOUR, CONTOUR DEF and cycle 14 says is machined by the cycles that follow. Definitions are obeyed
# where they stand, on a copy of the Q parameters: the cycles keep theirs.

FUNCTIONS = FunctionTable()
MOST_PARTS = 9  # of CONTOUR DEF
LASTING = ("tool", "turning", "speed", "modal")  # what a program of definitions does not change
MEANINGS = {
    "QC": "contour of a designator", "&": "common area", "|": "joined", "^": "joined without the common area",
    "\\": "without", "(": "begin of a group", ")": "end of a group", "P": "pocket", "I": "island",
    "DEPTH": "depth of the contour, of an island that of its top", "DECLARE CONTOUR target": "designator",
    "QC target": "designator",
}  # fmt: skip


@FUNCTIONS("SEL CONTOUR,", "Selection of contour definitions", takes="file", source="10.1")
def select(m: Machine, words: Words) -> None:
    """Runs a program of DECLARE CONTOUR and formulas, whose last formula is the contour from now on; nothing moves."""
    word = words["file"]
    outside(m, "SEL CONTOUR", word)
    m.flow.ask(word.value)
    name = text(m, word)
    with m.flow.aside(m), m.variables.own_values():
        memory(m).defining = Definitions(m.matrix)
        before = m.snapshot(LASTING)
        call_program(m, name, "SEL CONTOUR", word)
        definitions = memory(m).defining
        determine(m)
        rows, changed = m.recorder.take().motion, before.differences(m.snapshot(LASTING))
    assert definitions is not None
    if len(rows):
        fault(m, int(rows.step[0]), f"SEL CONTOUR {name}: a program of contour definitions moves nothing")
    if changed:
        m.warn(f"SEL CONTOUR {name}: tool, spindle and M functions of a program of contour definitions do not stay", word)
    if definitions.whole is None:
        m.alarm(f"SEL CONTOUR {name}: the program has no contour formula", word, "for example QC10 = QC1 | QC2")
    memory(m).contour = definitions.whole
    m.log("contour", name)


def outside(m: Machine, code: str, word: Word | None) -> None:
    """An Alarm where contours are being defined or recorded."""
    if memory(m).defining is not None:
        m.alarm(f"{code} cannot stand in a program of contour definitions", word)
    if m.recorded_only:
        m.alarm(f"{code} cannot stand in the description of a contour", word)


def definitions_of(m: Machine, code: str, word: Word) -> Definitions:
    """The definitions of the running program; an Alarm where it has none."""
    found = memory(m).defining
    if found is None:
        hint = 'SEL CONTOUR "NAME" names that program; for a single block there is CONTOUR DEF'
        m.alarm(f"{code} stands in a program of contour definitions alone", word, hint)
    return found


@FUNCTIONS("DECLARE CONTOUR,", "Contour designator", takes="target file label DEPTH", source="10.1")
def declare(m: Machine, words: Words) -> None:
    """A program or a label is the contour of a designator, with the Q parameters as they stand here."""
    if "target" not in words:
        m.alarm("DECLARE CONTOUR needs a designator", hint='for example DECLARE CONTOUR QC1 = "CIRCLE"')
    target = words["target"]
    name = str(target.value)
    named = f"DECLARE CONTOUR {name}"
    definitions = definitions_of(m, "DECLARE CONTOUR", target)
    if name in definitions.named:
        m.alarm(f"{name} is a contour already", target, "take another designator")
    word = words.get("file", words.get("label"))
    if word is None:
        m.alarm(f"{named} needs the name of a program, or LBL and a label", target)
    memory(m).defining = None  # what describes a contour defines none
    part, recording = described(m, named, word, words.get("DEPTH"), within=definitions.frame)
    definitions.named[name] = part
    definitions.declared[name], definitions.deep[name] = target, "DEPTH" in words
    m.put(frames=recording.frames, memory=recording.memory)  # transformations go on
    memory(m).defining = definitions
    if len(set(definitions.deep.values())) > 1:
        without = next(name for name, deep in definitions.deep.items() if not deep)
        message = f"{without} has no DEPTH, although another contour has one: it counts as DEPTH0"
        m.warn(message, definitions.declared[without], "give every contour its DEPTH, or none")


@FUNCTIONS("QC,", "Contour formula", takes=" ".join(("target QC* (* )*", *(f"{join}*" for join in JOINS))), source="10.1")
def formula(m: Machine, words: Words) -> None:
    """Joins contours; the last formula of the program is the contour."""
    target, *rest = in_order(words)
    definitions = definitions_of(m, f"{target.value} =", target)
    name = str(target.value)
    if name in definitions.declared:
        m.alarm(f"{name} is a contour already", target, "take another designator")
    found = checked(m, joined(m, rest, definitions.named), target, name, definitions.areas)
    definitions.named[name] = definitions.whole = found


@FUNCTIONS("CONTOUR DEF,", "Simple contour formula", takes="P* I* file* label* DEPTH*", source="10.2")
def simple(m: Machine, words: Words) -> None:
    """Pockets joined, and without the islands, each with its depth: the contour from now on; nothing moves."""
    outside(m, "CONTOUR DEF", words.words[0] if words.words else None)
    pockets: list[DeepArea] = []
    islands: list[DeepArea] = []
    recording: Recording | None = None
    for head, word, depth in of_parts(m, words):
        code = f"CONTOUR DEF {head.address}{head.value:g}"
        part, recording = described(m, code, word, depth, recording)
        (pockets if head.address == "P" else islands).append(part)
        deepest = pockets[0].depth
        if head.address == "P" and deepest and (part.depth > deepest or not part.depth):
            m.warn(f"{code} is deeper than P1, which must be the deepest pocket", depth or head)
    whole = united(pockets)
    if islands:
        whole = Joined("\\", whole, united(islands))
    memory(m).contour = checked(m, whole, in_order(words)[0], "CONTOUR DEF")
    m.log("contour", "CONTOUR DEF")


def in_order(words: Words) -> list[Word]:
    """The words as they are written."""
    return sorted(words.words, key=lambda word: word.place)


def united(some: list[DeepArea]) -> Formula:
    found: Formula = some[0]
    for part in some[1:]:
        found = Joined("|", found, part)
    return found


def of_parts(m: Machine, words: Words) -> list[tuple[Word, Word, Word | None]]:
    """The words of each part: its letter and number, what describes it, its depth; an Alarm where one is missing or twice."""
    found: list[tuple[Word, list[Word]]] = []
    for word in in_order(words):
        if word.address in ("P", "I"):
            found.append((word, []))
        elif not found:
            m.alarm(f"CONTOUR DEF: {word} stands before its part", word, 'for example P1 = "POCKET"')
        else:
            found[-1][1].append(word)
    if not found:
        m.alarm("CONTOUR DEF needs at least one pocket", hint='for example CONTOUR DEF P1 = "POCKET"')
    made: list[tuple[Word, Word, Word | None]] = []
    numbers: set[float] = set()
    for head, rest in found:
        name, number = f"{head.address}{head.value:g}", float(str(head.value))
        if len(made) == MOST_PARTS or not 1 <= number <= MOST_PARTS:
            m.alarm(f"CONTOUR DEF {name}: there are at most {MOST_PARTS} parts, 1 to {MOST_PARTS}", head)
        if number in numbers:
            m.alarm(f"CONTOUR DEF {name}: the number {number:g} stands twice", head)
        numbers.add(number)
        if not made and head.address == "I":
            m.alarm(f"CONTOUR DEF {name}: the first part must be a pocket, the deepest one", head)
        if not made and number != 1:
            m.alarm(f"CONTOUR DEF {name}: the first part is P1, the deepest pocket", head)
        if not rest or rest[0].address == "DEPTH":
            m.alarm(f"CONTOUR DEF {name} needs the name of a program, or LBL and a label", head)
        strange = next((word for word in rest[1:] if word.address != "DEPTH"), rest[2] if len(rest) > 2 else None)
        if strange:
            twice = strange.address == "DEPTH" and strange is not rest[1]
            said = "the depth stands twice" if twice else f"{strange} has no meaning here"
            m.alarm(f"CONTOUR DEF {name}: {said}", strange)
        made.append((head, rest[0], rest[1] if len(rest) > 1 else None))
    return made
