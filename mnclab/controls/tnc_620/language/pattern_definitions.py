"""PATTERN DEF and SEL PATTERN: the points at which CYCL CALL PAT runs a cycle (3.3, 3.4).

What is defined or selected last counts, also where a called program did it.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.cycles import patterns
from mnclab.controls.tnc_620.language.values import counted, not_negative, whole
from mnclab.controls.tnc_620.reading.definitions import ADDRESSES, CLOSING, FORMS
from mnclab.controls.tnc_620.state import memory
from mnclab.controls.tnc_620.tables import parse_points, read_table
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
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
    "PAT": "grid", "FRAME": "frame of a grid", "CIRC": "circle", "PITCHCIRC": "part of a circle", CLOSING: "end of an element",
}  # fmt: skip


class Pattern(NamedTuple):
    """Points (n, 3), z the workpiece surface there, and clearance heights (n,) or nan; `table`: they came from a file."""

    points: Floats
    clearance: Floats
    table: bool


TAKES = " ".join(f"{address}*" for address in (*FORMS, *ADDRESSES, CLOSING))


@FUNCTIONS("PATTERN DEF,", "Point pattern", takes=TAKES, source="3.3")
def pattern_def(m: Machine, words: Words) -> None:
    """Positions, rows, grids, frames and circles, one after the other; nothing moves."""
    points = np.empty((0, 3))
    for element in elements(m, words):
        more = FORM[element.head.address](element, points[-1] if len(points) else None)
        if len(points) + len(more) > MOST:
            m.alarm(f"PATTERN DEF has more than {MOST} points", element.head)
        points = np.concatenate([points, more])
    if not len(points):
        m.alarm(f"PATTERN DEF needs at least one of {', '.join(FORMS)}")
    m.flow.spend(len(points) // POINTS_A_BLOCK)
    activate(m, Pattern(points, np.full(len(points), np.nan), False))


@FUNCTIONS("SEL PATTERN,", "Point table", takes="file", source="3.4")
def sel_pattern(m: Machine, words: Words) -> None:
    """The points of a file NAME.PNT; nothing moves."""
    _, table = read_table(m, words["file"], "SEL PATTERN", "point table", ".PNT", parse_points)
    m.flow.spend(len(table.points))
    activate(m, Pattern(table.points[~table.hidden], table.clearance[~table.hidden], True))


def activate(m: Machine, pattern: Pattern) -> None:
    memory(m).pattern = pattern
    m.log("pattern", len(pattern.points))


class Element(NamedTuple):
    """One element: the word of its form, and its parameters by address."""

    m: Machine
    head: Word
    given: dict[str, Word]

    @property
    def name(self) -> str:
        """As it is written: PATTERN DEF POS1."""
        return f"PATTERN DEF {self.head.address}{self.head.value:g}"

    def say(self, address: str) -> str:
        return f"{self.name} {address} ({MEANINGS[address]})"

    def add(self, word: Word) -> None:
        """A parameter of the form, once; increments only from one position to the next."""
        form, name = self.head.address, f"{self.name} {word.address}"
        if word.address not in FORMS[form]:
            self.m.alarm(f"{self.name} does not take {word.address}", word, f"it takes {' '.join(FORMS[form])}")
        if word.address in self.given:
            self.m.alarm(f"{name} is written twice", word, "keep one of them")
        if word.incremental and (form != "POS" or self.head.value == 1):
            self.m.alarm(f"{name} must be absolute", word, "POS2 to POS9 may count from the one before")
        self.given[word.address] = word

    def word(self, address: str) -> Word:
        if address not in self.given:
            self.m.alarm(f"{self.say(address)} is missing", self.head)
        return self.given[address]

    def number(self, address: str) -> float:
        return self.m.value(self.word(address))

    def radians(self, address: str) -> float:
        return math.radians(self.number(address))

    def count(self, address: str) -> int:
        return whole(self.m, self.word(address), self.say(address), 1, MOST)

    def place(self) -> tuple[float, float]:
        return self.number("X"), self.number("Y")

    def at_surface(self, points: Floats) -> Floats:
        """Points of the plane (n, 2) on the workpiece surface of the element (n, 3)."""
        return np.column_stack([points, np.full(len(points), self.number("Z"))])


def elements(m: Machine, words: Words) -> Iterator[Element]:
    element: Element | None = None
    seen: Counter[str] = Counter()
    for word in sorted(words.words, key=lambda word: word.place):
        if element is None:
            element = Element(m, word, {})
            seen[word.address] += 1
            check_number(element, seen[word.address])
        elif word.address == CLOSING:
            yield element
            element = None
        else:
            element.add(word)
    if element is not None:
        m.alarm(f"{element.name}: its bracket is not closed", element.head, "write )")


def check_number(element: Element, expected: int) -> None:
    """Elements of a form are numbered from 1 to 9, in their order."""
    m, head = element.m, element.head
    if expected > LARGEST_NUMBER:
        m.alarm(f"PATTERN DEF has more than {LARGEST_NUMBER} elements {head.address}", head)
    if head.value != expected:
        m.alarm(f"{element.name} stands where {head.address}{expected} is expected", head)


def position(element: Element, before: Floats | None) -> Floats:
    """POS: one point, absolute or counted from the one before, axis by axis."""
    begin = np.zeros(3) if before is None else before
    return np.array([[counted(element.m, element.word(axis), at) for axis, at in zip("XYZ", begin, strict=True)]])


def row(element: Element, before: Floats | None) -> Floats:
    """ROW: from a starting point in one direction."""
    start, step, count = element.place(), element.number("D"), element.count("NUM")
    return element.at_surface(patterns.row(start, step, count, element.radians("ROT")))


def grid(element: Element, before: Floats | None) -> Floats:
    """PAT and FRAME: columns and rows, of FRAME the outer ones."""
    start, spacing = element.place(), (element.number("DX"), element.number("DY"))
    count = element.count("NUMX"), element.count("NUMY")
    if count[0] * count[1] > MOST:
        element.m.alarm(f"{element.name} has more than {MOST} positions", element.head)
    lean = element.radians("ROTX"), element.radians("ROTY")
    make = patterns.grid if element.head.address == "PAT" else patterns.frame
    return element.at_surface(make(start, spacing, count, element.radians("ROT"), lean))


def circle(element: Element, before: Floats | None) -> Floats:
    """CIRC: a whole circle; PITCHCIRC: part of one, by its step or by the angle of its last point."""
    centre = element.place()
    diameter = not_negative(element.m, element.word("D"), f"{element.name} D (diameter)")
    start, count = element.radians("START"), element.count("NUM")
    if element.head.address == "CIRC":
        step = patterns.TURN / count
    elif "STEP" in element.given and "END" in element.given:
        element.m.alarm(f"{element.name} has both STEP and END", element.given["END"], "keep one of them")
    elif "END" in element.given:
        step = patterns.step_between(start, element.radians("END"), count)
    else:
        step = element.radians("STEP")
    return element.at_surface(patterns.circle(centre, diameter / 2, start, step, count))


#: Each makes the points (n, 3) of an element.
FORM = {"POS": position, "ROW": row, "PAT": grid, "FRAME": grid, "CIRC": circle, "PITCHCIRC": circle}
