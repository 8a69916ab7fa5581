"""SEL CONTOUR, DECLARE CONTOUR, QC10 = …, CONTOUR DEF: contours from formulas of programs and labels (chapter 10).

What the last of SEL CONTOUR, CONTOUR DEF and cycle 14 says is machined by the cycles that follow. Definitions are obeyed
where they stand, on a copy of the Q parameters: the cycles keep theirs.
"""

from __future__ import annotations

from mnclab.controls.tnc_620.contours.area import fault
from mnclab.controls.tnc_620.contours.formulas import Definitions, checked, described, joined
from mnclab.controls.tnc_620.language.flow import call_program
from mnclab.controls.tnc_620.language.parameters import text
from mnclab.controls.tnc_620.reading.definitions import JOINS
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.flow import Recording, determine
from mnclab.machine.machine import Machine
from mnclab.machining.milling.terraces import Formula, Joined, Part
from mnclab.text.program import Word

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
    pockets: list[Part] = []
    islands: list[Part] = []
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


def united(some: list[Part]) -> Formula:
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
