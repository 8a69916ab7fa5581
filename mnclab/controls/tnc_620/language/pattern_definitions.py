"""PATTERN DEF and SEL PATTERN: the points at which CYCL CALL PAT runs a cycle (3.3, 3.4).

What is defined or selected last counts, also where a called program did it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.reading.pattern_words import ADDRESSES, CLOSED, FORMS
from mnclab.controls.tnc_620.state import memory
from mnclab.controls.tnc_620.tables.point_tables import PointTable, read_points
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machining import patterns
from mnclab.text.program import Word

FUNCTIONS = FunctionTable()

LARGEST_NUMBER = 9  # POS1 to POS9
MOST = 100_000  # points
POINTS_A_BLOCK = 50  # points that take as long as a block
Floats = NDArray[np.float64]

COUNTS = {"NUM": "number of positions", "NUMX": "number of columns", "NUMY": "number of rows"}
MEANINGS = COUNTS | {
    "X": "coordinate", "Y": "coordinate", "Z": "workpiece surface", "D": "spacing or diameter", "DX": "spacing along X",
    "DY": "spacing along Y", "ROT": "rotation", "ROTX": "rotation of the first axis", "ROTY": "rotation of the second axis",
    "START": "starting angle", "STEP": "stepping angle", "END": "stopping angle", "POS": "single position", "ROW": "row",
    "PAT": "grid", "FRAME": "frame of a grid", "CIRC": "circle", "PITCHCIRC": "part of a circle", CLOSED: "end of an element",
}  # fmt: skip


class Pattern(NamedTuple):
    """Points (n, 3), z the workpiece surface there, and clearance heights (n,) or nan; `table`: they came from a file."""

    points: Floats
    clearance: Floats
    table: bool


def activate(m: Machine, pattern: Pattern) -> None:
    """The pattern of the following CYCL CALL PAT."""
    memory(m).pattern = pattern
    m.log("pattern", len(pattern.points))


TAKES = " ".join(f"{address}*" for address in (*FORMS, *ADDRESSES, CLOSED))


@FUNCTIONS("PATTERN DEF,", "Point pattern", takes=TAKES, source="3.3")
def pattern_def(m: Machine, words: Words) -> None:
    """Positions, rows, grids, frames and circles, one after the other; nothing moves."""
    points = np.empty((0, 3))
    for head, given in elements(m, words):
        more = FORM[head.address](m, Element(head, given), points[-1] if len(points) else None)
        if len(points) + len(more) > MOST:
            m.alarm(f"PATTERN DEF has more than {MOST} points", head)
        points = np.concatenate([points, more])
    if not len(points):
        m.alarm(f"PATTERN DEF needs at least one of {', '.join(FORMS)}", None)
    m.flow.spend(len(points) // POINTS_A_BLOCK)
    activate(m, Pattern(points, np.full(len(points), np.nan), False))


class Element(NamedTuple):
    """One element: the word of its form, and its parameters by address."""

    head: Word
    given: Mapping[str, Word]

    @property
    def name(self) -> str:
        """As it is written: POS1."""
        return f"{self.head.address}{self.head.value:g}"

    def say(self, address: str) -> str:
        """How an alarm names a parameter."""
        return f"PATTERN DEF {self.name} {address} ({MEANINGS[address]})"

    def number(self, m: Machine, address: str) -> float:
        """A parameter that must be there."""
        if address not in self.given:
            m.alarm(f"{self.say(address)} is missing", self.head)
        return m.value(self.given[address])

    def radians(self, m: Machine, address: str) -> float:
        """An angle."""
        return math.radians(self.number(m, address))

    def whole(self, m: Machine, address: str) -> int:
        """A number of positions, from 1."""
        value = self.number(m, address)
        if not 1 <= value <= MOST or value != int(value):
            m.alarm(f"{self.say(address)} must be a whole number from 1 to {MOST}, got {value:g}", self.given[address])
        return int(value)


def elements(m: Machine, words: Words) -> Iterator[tuple[Word, dict[str, Word]]]:
    """The elements of a block in the order written, each with its words."""
    head: Word | None = None
    given: dict[str, Word] = {}
    seen: dict[str, int] = {}
    for word in sorted(words.words, key=lambda word: word.place):
        if head is None:
            head, given = word, {}
            check_number(m, word, seen)
        elif word.address == CLOSED:
            yield head, given
            head = None
        else:
            check_word(m, head, word, given)
            given[word.address] = word
    if head is not None:
        m.alarm(f"PATTERN DEF {head.address}{head.value:g}: its bracket is not closed", head, hint="write )")


def check_number(m: Machine, head: Word, seen: dict[str, int]) -> None:
    """Elements of a form are numbered from 1 to 9, in their order."""
    expected = seen.get(head.address, 0) + 1
    if expected > LARGEST_NUMBER:
        m.alarm(f"PATTERN DEF has more than {LARGEST_NUMBER} elements {head.address}", head)
    if head.value != expected:
        m.alarm(f"PATTERN DEF {head.address}{head.value:g} stands where {head.address}{expected} is expected", head)
    seen[head.address] = expected


def check_word(m: Machine, head: Word, word: Word, given: Mapping[str, Word]) -> None:
    """A parameter of the form, once; increments only from one position to the next."""
    name = f"PATTERN DEF {head.address}{head.value:g}"
    if word.address not in FORMS[head.address]:
        m.alarm(f"{name} does not take {word.address}", word, hint=f"it takes {' '.join(FORMS[head.address])}")
    if word.address in given:
        m.alarm(f"{name} {word.address} is written twice", word, hint="keep one of them")
    if word.incremental and (head.address != "POS" or head.value == 1):
        m.alarm(f"{name} {word.address} must be absolute", word, hint="POS2 to POS9 may count from the one before")


# --- forms: the points (n, 3) of an element ---------------------------------------------------------------------------


def position(m: Machine, element: Element, before: Floats | None) -> Floats:
    """POS: one point, absolute or counted from the one before, axis by axis."""
    point = [element.number(m, axis) for axis in "XYZ"]
    for k, axis in enumerate("XYZ"):
        if element.given[axis].incremental and before is not None:
            point[k] += before[k]
    return np.array([point])


def row(m: Machine, element: Element, before: Floats | None) -> Floats:
    """ROW: from a starting point in one direction."""
    start = element.number(m, "X"), element.number(m, "Y")
    return level(
        m,
        element,
        patterns.row(start, element.number(m, "D"), element.whole(m, "NUM"), element.radians(m, "ROT")),
    )


def grid(m: Machine, element: Element, before: Floats | None) -> Floats:
    """PAT and FRAME: columns and rows, of FRAME the outer ones."""
    start = element.number(m, "X"), element.number(m, "Y")
    spacing = element.number(m, "DX"), element.number(m, "DY")
    count = element.whole(m, "NUMX"), element.whole(m, "NUMY")
    if count[0] * count[1] > MOST:
        m.alarm(f"PATTERN DEF {element.name} has more than {MOST} positions", element.head)
    lean = element.radians(m, "ROTX"), element.radians(m, "ROTY")
    make = patterns.grid if element.head.address == "PAT" else patterns.frame
    return level(m, element, make(start, spacing, count, element.radians(m, "ROT"), lean))


def circle(m: Machine, element: Element, before: Floats | None) -> Floats:
    """CIRC: a whole circle; PITCHCIRC: part of one, by its step or by the angle of its last point."""
    centre, diameter = (element.number(m, "X"), element.number(m, "Y")), element.number(m, "D")
    if diameter < 0:
        m.alarm(f"PATTERN DEF {element.name} D (diameter) must be at least 0, got {diameter:g}", element.given["D"])
    start, count = element.radians(m, "START"), element.whole(m, "NUM")
    if element.head.address == "CIRC":
        step = patterns.TURN / count
    elif "STEP" in element.given and "END" in element.given:
        m.alarm(f"PATTERN DEF {element.name} has both STEP and END", element.given["END"], hint="keep one of them")
    elif "END" in element.given:
        step = patterns.step_between(start, element.radians(m, "END"), count)
    else:
        step = element.radians(m, "STEP")
    return level(m, element, patterns.circle(centre, diameter / 2, start, step, count))


def level(m: Machine, element: Element, points: Floats) -> Floats:
    """Points of the plane (n, 2) on the workpiece surface of their element."""
    return np.column_stack([points, np.full(len(points), element.number(m, "Z"))])


FORM = {"POS": position, "ROW": row, "PAT": grid, "FRAME": grid, "CIRC": circle, "PITCHCIRC": circle}


# --- point tables -----------------------------------------------------------------------------------------------------


@FUNCTIONS("SEL PATTERN,", "Point table", takes="file", source="3.4")
def sel_pattern(m: Machine, words: Words) -> None:
    """The points of a file NAME.PNT; nothing moves."""
    table: PointTable = read_points(m, words["file"])
    m.flow.spend(len(table.points))
    shown = table.points[~table.hidden], table.clearance[~table.hidden]
    activate(m, Pattern(*shown, True))
