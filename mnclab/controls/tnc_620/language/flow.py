"""The course of a program: labels, repeats, jumps, other programs, calls of a cycle (catalogue: LBL, CALL LBL, FN, CALL PGM)."""

from __future__ import annotations

import operator
from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.language.auxiliary import FEED_WORDS, feed
from mnclab.controls.tnc_620.language.motion import coordinates
from mnclab.controls.tnc_620.language.pattern_definitions import Pattern
from mnclab.controls.tnc_620.language.tools import check_cycle, turned
from mnclab.controls.tnc_620.language.values import PREASSIGNED, first, text, whole
from mnclab.controls.tnc_620.state import count_in, memory
from mnclab.geometry import frames
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import PLANES
from mnclab.machine.cycle import Definition
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Call, Each, Go, Step, Write
from mnclab.running import interpreter
from mnclab.running.cycles import as_it_stands, instance, perform, refuse_frame, run_cycle
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()


def label_name(m: Machine, word: Word) -> str:
    """How the reader lists a label: a number as it is, a name in quotes."""
    return f"{word.value:g}" if isinstance(word.value, float) else f'"{text(m, word)}"'


@FUNCTIONS("LBL", "Label", takes="label", source="11.10, example")
def label(m: Machine, words: Words) -> None:
    """Where CALL LBL goes; LBL 0 ends a subprogram and does nothing outside one."""
    if label_name(m, words["label"]) == "0":
        m.flow.leave()


@FUNCTIONS("CALL LBL,", "Call of a subprogram, repeat of a section", takes="label REP", source="11.10, example")
def call_label(m: Machine, words: Words) -> None:
    """Runs from the label to LBL 0; with REP n the section from the label to here n times more."""
    word = words["label"]
    m.flow.ask(word.value, words["REP"].value if "REP" in words else 0)
    name = label_name(m, word)
    if name == "0":
        m.alarm("CALL LBL 0: LBL 0 is the end of a subprogram and cannot be called", word)
    if "REP" not in words:
        m.flow.call(m, name, m.span_of(word))
        return
    first, here = m.flow.index_of(name, m.span_of(word)), m.flow.current
    if first >= here:
        m.alarm(f"CALL LBL {name} REP: the section must begin before this block", word, "REP repeats what stands above")
    times = whole(m, words["REP"], "CALL LBL REP (repeats)", 0, 999_999_999)
    m.flow.repeat(m, first, here, times, m.span_of(word))


CONDITIONS = {"FN 9": operator.eq, "FN 10": operator.ne, "FN 11": operator.gt, "FN 12": operator.lt}
JUMPS = {
    "FN 9": "Jump if equal", "FN 10": "Jump if not equal", "FN 11": "Jump if greater", "FN 12": "Jump if less",
}  # fmt: skip


@FUNCTIONS(", ".join(JUMPS), JUMPS, takes="first second parameter state label", leads_away=True, source="Klartext, not described")
def jump(m: Machine, words: Words) -> None:
    """Goes on at a label if the condition holds; numbers are equal when they are exactly so."""
    word = words["label"]
    m.flow.ask(word.value)
    if "state" in words:
        name = str(words["parameter"].value)
        m.flow.ask_whether(name)
        holds = (name in m.variables or name in PREASSIGNED) == (words["state"].value == "DEFINED")
    else:
        first, second = words["first"], words["second"]
        one, other = m.value(first), m.value(second)
        m.flow.compare(first.value, second.value, one - other)
        holds = CONDITIONS[words.code](one, other)
    name = label_name(m, word)
    if name == "0":
        m.alarm(f"{words.code} GOTO LBL 0: LBL 0 is the end of a subprogram and no place to go to", word)
    m.flow.index_of(name, m.span_of(word))  # a label that is missing is a fault even when the jump is not made
    if holds:
        m.flow.jump(m, name, m.span_of(word))


def call_program(m: Machine, name: str, what: str, word: Word | None = None) -> None:
    """Run another program here, with its own QL parameters; `what` is the statement that calls it."""
    place = m.span_of(word)
    index = interpreter.called(m, name, what, place)
    kept, length = (memory(m).name, memory(m).unit), m.variable_unit
    memory(m).name = memory(m).unit = None
    with m.variables.own_level():
        m.flow.call_program(m, index, place)
    memory(m).name, memory(m).unit = kept
    if length != m.variable_unit:
        count_in(m, length)


@FUNCTIONS("CALL PGM,", "Program call", takes="name", source="3.4")
def call_named(m: Machine, words: Words) -> None:
    """Runs another program up to its END PGM: of Setup(files=…), or beside the calling file."""
    m.flow.ask(words["name"].value)
    call_program(m, text(m, words["name"]), "CALL PGM", words["name"])


@FUNCTIONS("SEL PGM,", "Choice of a program", takes="name", source="Klartext, not described")
def select(m: Machine, words: Words) -> None:
    """The program that CALL SELECTED PGM runs; its name may stand in a QS parameter."""
    m.flow.ask(words["name"].value)
    memory(m).selected_program = text(m, words["name"])
    m.log("selected program", memory(m).selected_program)


@FUNCTIONS("CALL SELECTED PGM,", "Call of the chosen program", source="Klartext, not described")
def call_selected(m: Machine, words: Words) -> None:
    """Runs the program that SEL PGM has chosen."""
    name = memory(m).selected_program
    if name is None:
        m.alarm("CALL SELECTED PGM: no program was chosen", hint='write SEL PGM "NAME" before it')
    call_program(m, name, "CALL SELECTED PGM")


# Calls of a defined cycle: CYCL CALL, M99, M89, CYCL CALL POS, CYCL CALL PAT (3.1, 3.3, 3.4; catalogue: cycle call).
#
# At a point of a pattern with surface Z the cycle works from S = Q203 + Z. Between the points the tool is at its clearance
# height H: where it stood at the call, or the second set-up clearance, whichever is greater; from a lower point to a higher
# one it goes up first, and from a higher one to a lower one it goes down last. The second set-up clearance is one level, for
# the way between the points and for the cycle, which retracts to it; where it does not count, for neither.

CODE = "CYCL CALL PAT"
Floats = NDArray[np.float64]

#: Statements that position the tool, and the free contours that M89 does not go with.
POSITIONING = ("L", "LP", "C", "CR", "CT", "CP", "CTP")
FREE = ("FPOL", "FL", "FLT", "FC", "FCT")
PLACES = frozenset("X Y Z U V W A B C PR PA".split())
#: Cycles whose contours stand in the program: a point shifts their datum (SL cycles and the program call).
PLACED_BY_DATUM = frozenset(f"CYCL DEF {n}" for n in (12, *range(21, 26), 27, 28, 29, 39, 275, 276))
#: Cycles with a position of their own, to which the one of the call is added (3.1).
WITH_POSITION = frozenset(f"CYCL DEF {n}" for n in (*range(210, 216), 230, 231))
#: Cycles at a surface that they know from where the tool stands, which a pattern does not say.
FROM_THE_TOOL = frozenset(f"CYCL DEF {n}" for n in (1, 2, 3, 4, 5, 17))


@FUNCTIONS("CYCL CALL,", "Cycle call", group="call", modal=False, phase="call", takes=FEED_WORDS, source="3.1")
def cycle_call(m: Machine, words: Words) -> None:
    """Runs the cycle defined last where the tool stands; F sets the feed of the following blocks, not that of the cycle."""
    feed(m, words)
    run_cycle(m, ready(m, "CYCL CALL"))


@FUNCTIONS("M99", "Cycle call in its block", group="call", modal=False, phase="call", source="3.1")
def call_here(m: Machine, words: Words) -> None:
    """Runs the cycle defined last at the end of the block; ends M89."""
    run_cycle(m, ready(m, "M99", words.words[0]))
    if m.modal.get("call"):
        m.set_modal("call", "")


@FUNCTIONS("M89", "Cycle call in every positioning block", group="call", phase="call", source="3.1")
def call_everywhere(m: Machine, words: Words) -> None:
    """Runs the cycle defined last at the end of this and of each positioning block, until M99 or a new cycle."""
    run_cycle(m, ready(m, "M89", first(words)))


def calls_again(keyword: str, words: Sequence[Word]) -> bool:
    """Whether M89 of a block before calls its cycle in a block of this kind; it does not go with free contours."""
    if keyword in FREE:
        raise Alarm(f"M89 and {keyword}: a modal cycle call does not go with free contours", hint="end it with M99")
    if keyword.startswith(("APPR", "DEP")):
        raise Alarm(f"M89 and {keyword}: a cycle is called without radius compensation", hint="end it with M99")
    return keyword in POSITIONING and (keyword[0] == "C" or any(word.address in PLACES for word in words))


def ready(m: Machine, code: str, word: Word | None = None) -> Definition:
    if m.recorded_only:
        m.alarm(f"{code} cannot stand in a contour that a cycle reads", word)
    if m.cycle is None:
        m.alarm(f"{code} has no cycle to call", word, hint="define one before, for example CYCL DEF 200")
    if m.side:
        m.alarm(
            f"{code}: a cycle is called at a position without radius compensation", word, "write R0 in the block before"
        )
    if m.tool.number == 0:
        m.warn(f"{code}: no tool was called", word)
    if not m.turning and not m.cycle.cycle.own_spindle:
        m.warn(f"{code}: the spindle does not turn", word, hint="write M3 or M4 before the call")
    check_cycle(m, m.cycle.cycle)
    if m.plane == "XY":  # else its frame is turned first
        refuse_frame(m.cycle, m)
    return m.cycle


@FUNCTIONS(
    "CYCL CALL POS,", "Cycle call at a position", group="call", modal=False, phase="call", takes=f"X Y Z {FEED_WORDS}",
    source="3.1",
)  # fmt: skip
def cycle_call_at(m: Machine, words: Words) -> None:
    """Runs the cycle defined last at X Y, its surface shifted by Z; F is the feed of the approach alone."""
    definition = ready(m, "CYCL CALL POS")
    for axis in "XYZ":
        if axis not in words:
            m.alarm(f"CYCL CALL POS {axis} is missing: all three coordinates are programmed")
    to = coordinates(m, words)
    x, y, z = (to["xyz"[axis]] for axis in PLANES[m.plane])
    kept = m.feed, m.per_rev
    f = feed(m, words)
    surface, clearance, second = planes(m, definition)
    with turned(m, definition):
        over, label = m.programmed[2] > surface + z, "to the position"
        across, down = (
            Go(label, x=x, y=y, feed=f),
            Go(label, surface + z + (clearance if over else max(clearance, second)), f),
        )
        perform(m, "CYCL CALL POS", (across, down) if over else (down, across), about=(0.0, 0.0))
        m.change("feed", kept[0])
        m.change("per_rev", kept[1])
        perform(m, "CYCL CALL POS", call_at(definition, x, y, z))


def planes(m: Machine, definition: Definition) -> tuple[float, float, float]:
    """Surface, set-up clearance and second set-up clearance of a cycle, mm: Q203, Q200, Q204.

    Face milling has its surface in Q227; a contour cycle has the surface Q5, the clearance Q6 and the absolute height Q7
    instead; what a cycle lacks is 0.
    """
    cycle = instance(as_it_stands(m, definition))
    found = {p.address: getattr(cycle, p.name) for p in cycle.parameters()}
    if definition.cycle.code in PLACED_BY_DATUM:
        surface, clearance, height = (m.variables.get(q, 0.0) * m.variable_unit for q in ("Q5", "Q6", "Q7"))
        return surface, clearance, height - surface
    surface, clearance, second = (float(found.get(q) or 0.0) for q in ("Q203", "Q200", "Q204"))
    return float(found.get("Q227", surface)), clearance, second


def call_at(definition: Definition, x: float, y: float, z: float, **instead: float) -> Iterator[Step]:
    """The cycle where the tool stands, x y, its surface shifted by z; one with a place of its own with its datum there.

    `instead` are values that count in place of its own.
    """
    shift = (x, y, z) if definition.cycle.code in PLACED_BY_DATUM | WITH_POSITION else (0.0, 0.0, z)
    if any(shift):
        yield Write("frame", frames.shift(*shift), "point")
    yield Call(instead)
    if any(shift):
        yield Write("frame", None, "point")


@FUNCTIONS(f"{CODE},", "Cycle call at a pattern", group="call", modal=False, phase="call", takes=FEED_WORDS, source="3.1")
def cycle_call_pattern(m: Machine, words: Words) -> None:
    """Runs the cycle defined last at every point of the pattern; F is the feed from point to point."""
    definition = ready(m, CODE)
    pattern = memory(m).pattern
    if pattern is None:
        m.alarm(f"{CODE} has no pattern", hint="write PATTERN DEF or SEL PATTERN before it")
    if definition.code in FROM_THE_TOOL:
        m.alarm(f"{CODE}: {definition.code} begins where the tool stands, at no surface", hint="call it with M99 or M89")
    if m.plane != "XY":
        m.alarm(f"{CODE}: the points of a pattern lie in X and Y, the tool axis must be Z")
    perform(m, CODE, at_points(m, definition, pattern, feed(m, words)), about=(0.0, 0.0))


def at_points(m: Machine, definition: Definition, pattern: Pattern, f: float | None) -> Iterator[Step]:
    """Visits, told together for points that differ in their place alone."""
    heights, second = clearance_heights(m, definition, pattern)
    surface = pattern.points[:, 2]
    last = np.flatnonzero((np.diff(surface) != 0) | (np.diff(heights) != 0)) + 1
    for run in np.split(np.arange(len(surface)), last):
        if len(run):
            one = (float(column[run[0]]) for column in (surface, heights, second))
            yield Each(pattern.points[run, :2], partial(visit, m, definition, f, *one))


def visit(
    m: Machine, definition: Definition, f: float | None, z: float, height: float, second: float, x: float, y: float
) -> Iterator[Step]:
    """What happens at a point: up if need be, over it, the cycle with its second set-up clearance, up."""
    if m.programmed[2] < height:
        yield Go("to the point", height)
    yield Go("to the point", x=x, y=y, feed=f)
    yield from call_at(definition, x, y, z, second_clearance=second)
    yield Go("to the clearance height", height)


def clearance_heights(m: Machine, definition: Definition, pattern: Pattern) -> tuple[Floats, Floats]:
    """Of each point the clearance height (n,), never below its set-up clearance, and the Q204 of the cycle there (n,).

    In a PATTERN DEF above the surface of the cycle, Q204 counts from the surface of the pattern alone. Where a point
    table holds clearance heights, Q204 does not count, unless GLOBAL DEF 125 asks for it.
    """
    own, clearance, second = planes(m, definition)
    at_call, choice = m.programmed[2], memory(m).defaults.get("Q345")
    z = pattern.points[:, 2]
    surface = own + z
    whole = pattern.table or definition.cycle.code in PLACED_BY_DATUM
    above = second + (surface if whole else np.where(z > own, z, surface))
    end = surface  # where the second set-up clearance does not count
    if choice == 1:
        heights, end = np.fmax(above, pattern.clearance), above
    elif not np.isnan(pattern.clearance).all():
        heights = np.where(np.isnan(pattern.clearance), at_call, pattern.clearance)
    elif choice == 0:
        heights = np.full(len(z), at_call)
    else:
        heights, end = np.maximum(at_call, above), above
    return np.maximum(heights, surface + clearance), np.maximum(end - surface, 0.0)
