"""Questions about a run: `z < -5`, `Q5 > 3 and not tool == 2`. Read and worked out here, never by `eval`.

Numbers, names, `+ - * / ^`, brackets, functions of one argument (angles in degrees), the comparisons
`< <= > >= == !=` (also in a chain: `0 < x < 5`), and `and`, `or`, `not`. Values are numpy arrays, one number a
place; a comparison with a value that is not known (nan) is neither true nor false. Numbers within `SAME` are equal.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple, NoReturn

import numpy as np
from numpy.typing import NDArray

from mnclab.text.alarm import Alarm, Span, hint
from mnclab.text.expression import Climber, split

SAME = 1e-9  # a millionth of a micrometre, where lengths are compared
DEEPEST = 50
MOST = 200  # operators of arithmetic: a tree of them is as deep as they are many
Values = Mapping[str, NDArray[np.float64]]
Array = NDArray[Any]

_TOKEN = re.compile(r"\s*(?:(\d+(?:\.\d*)?|\.\d+)|([A-Za-z_#]\w*)|(<=|>=|==|!=|[-+*/^()<>=]))", re.ASCII)
FUNCTIONS: dict[str, Callable[[Array], Array]] = {
    "abs": np.abs, "sqrt": np.sqrt, "sin": lambda a: np.sin(np.radians(a)),
    "cos": lambda a: np.cos(np.radians(a)), "tan": lambda a: np.tan(np.radians(a)),
}  # fmt: skip
COMPARISONS: dict[str, Callable[[Array], Array]] = {
    "<": lambda gap: gap < -SAME, "<=": lambda gap: gap <= SAME, "==": lambda gap: np.abs(gap) <= SAME,
    ">": lambda gap: gap > SAME, ">=": lambda gap: gap >= -SAME, "!=": lambda gap: np.abs(gap) > SAME,
}  # fmt: skip
ARITHMETIC: dict[str, Callable[[Array, Array], Array]] = {
    "+": np.add, "-": np.subtract, "*": np.multiply, "^": np.power,
    "/": lambda a, b: np.where(b == 0, np.nan, np.divide(a, b)),
}  # fmt: skip
OR, AND, NOT, COMPARISON, SUM, PRODUCT, POWER = range(7)
LEVELS = {
    "or": OR, "and": AND, "=": COMPARISON, **dict.fromkeys(COMPARISONS, COMPARISON),
    "+": SUM, "-": SUM, "*": PRODUCT, "/": PRODUCT, "^": POWER,
}  # fmt: skip


class Truth(NamedTuple):
    """Where a condition is true and where it is false; where neither, it is not known."""

    true: NDArray[np.bool_]
    false: NDArray[np.bool_]


@dataclass(frozen=True)
class Node:
    """A part of a condition: `what` it is, its parts, and whether it is true or false instead of a number."""

    what: str
    parts: tuple[Node, ...] = ()
    logical: bool = False
    number: float = 0.0
    name: str = ""

    def value(self, values: Values) -> Array:
        if self.what == "number":
            return np.float64(self.number)  # type: ignore[return-value]
        if self.what == "name":
            return values[self.name]
        with np.errstate(all="ignore"):
            numbers = [part.value(values) for part in self.parts]
            return FUNCTIONS[self.name](*numbers) if self.what == "function" else ARITHMETIC[self.name](*numbers)

    def truth(self, values: Values) -> Truth:
        if self.what == "comparison":
            with np.errstate(all="ignore"):
                gap = np.asarray(self.gap(values))
            known, found = ~np.isnan(gap), COMPARISONS[self.name](gap)
            return Truth(found & known, ~found & known)
        one, *others = [part.truth(values) for part in self.parts]
        for other in others:
            if self.what == "and":
                one = Truth(one.true & other.true, one.false | other.false)
            else:
                one = Truth(one.true | other.true, one.false & other.false)
        return Truth(one.false, one.true) if self.what == "not" else one

    def gap(self, values: Values) -> Array:
        return self.parts[0].value(values) - self.parts[1].value(values)

    def degree(self, names: Collection[str]) -> float:
        """The degree of a number in some names: 0 without them, 1 where it is linear in them, infinite beyond products."""
        if self.what == "name":
            return float(self.name in names)
        degrees = [part.degree(names) for part in self.parts]
        if self.what == "comparison" or self.name in ("+", "-"):
            return max(degrees)
        if self.name == "*":
            return sum(degrees)
        return (degrees[0] if self.name == "/" and not degrees[1] else np.inf) if any(degrees) else 0.0

    def walk(self) -> Iterator[Node]:
        yield self
        for part in self.parts:
            yield from part.walk()


@dataclass(frozen=True)
class Condition:
    """What was asked, as text and as a tree."""

    text: str
    tree: Node
    names: frozenset[str] = field(default_factory=frozenset)

    @property
    def comparisons(self) -> list[Node]:
        return [node for node in self.tree.walk() if node.what == "comparison"]

    def truth(self, values: Values) -> Truth:
        """Where it is true and where it is false; the shapes are those of the values, which must include a name."""
        return self.tree.truth(values)


def parse(text: str, known: Collection[str]) -> Condition:
    """Read a condition; names are taken as they are in `known`, in any case of letters. An Alarm shows what is wrong."""
    try:
        tree = _Reader(text, known).whole()
    except Alarm as alarm:
        alarm.source = _Question(text)
        raise
    return Condition(text, tree, frozenset(node.name for node in tree.walk() if node.what == "name"))


class _Question:
    """The text of a condition as what an alarm stands in."""

    name = "condition"

    def __init__(self, text: str) -> None:
        self.text = text

    def line_text(self, line: int) -> str:
        return self.text if line == 1 else ""


class _Reader(Climber[Node]):
    """Makes the tree of a condition; what is joined must be numbers or comparisons, as its operator asks."""

    levels, deepest = LEVELS, DEEPEST

    def __init__(self, text: str, known: Collection[str]) -> None:
        super().__init__(split(text, _TOKEN, ("number", "name", "mark"), Span(1, 1), "a condition"))
        self.known = {name.lower(): name for name in known}
        self.operators = 0
        self.end = Span(1, max(1, len(text.rstrip())))

    def whole(self) -> Node:
        tree = self.climb()
        if self.at < len(self.tokens):
            self.refuse("an operator was expected before")
        if not tree.logical:
            raise Alarm("a condition compares something", self.end, hint="such as z < -5")
        return tree

    def peek(self) -> str:
        return super().peek().lower()

    def refuse(self, what: str) -> NoReturn:
        if self.at >= len(self.tokens):
            raise Alarm(f"{what} the end of the condition", self.end)
        raise Alarm(f"{what} {self.tokens[self.at].text!r}", self.tokens[self.at].span)

    def too_deep(self) -> None:
        self.refuse(f"the condition is nested deeper than {DEEPEST} at")

    def join(self, mark: str, left: Node, first: int) -> Node:
        place = self.at
        if mark in ("and", "or"):
            parts = [left, self.right(mark)]
            while self.peek() == mark:
                self.at += 1
                parts.append(self.right(mark))
            return Node(mark, tuple(self.logical(part, first) for part in parts), logical=True)
        if mark == "^":
            right = self.numeric(self.right(mark), first)
            return Node("arithmetic", (self.numeric(left, first), right), name=mark)
        if mark in ARITHMETIC:
            self.operators += 1
            if self.operators > MOST:
                self.at -= 1
                self.refuse(f"the condition has more than {MOST} operators at")
            left = self.numeric(left, first)
            return Node("arithmetic", (left, self.numeric(self.right(mark), place)), name=mark)
        return self.compared(mark, self.numeric(left, first))

    def compared(self, mark: str, left: Node) -> Node:
        """A comparison, or a chain of them: all must be true."""
        found: list[Node] = []
        while True:
            place = self.at
            right = self.numeric(self.right(mark), place)
            found.append(Node("comparison", (left, right), logical=True, name="==" if mark == "=" else mark))
            mark, left = self.peek(), right
            if self.levels.get(mark) != COMPARISON:
                return found[0] if len(found) == 1 else Node("and", tuple(found), logical=True)
            self.at += 1

    def operand(self, level: int) -> Node:
        word, place = self.peek(), self.at + 1
        if word not in ("+", "-") and (word != "not" or level > NOT):
            return self.part()
        self.at += 1
        self.deeper()
        inner = self.climb(NOT if word == "not" else POWER)
        self.depth -= 1
        if word == "not":
            return Node("not", (self.logical(inner, place),), logical=True)
        return Node("arithmetic", (Node("number"), self.numeric(inner, place)), name=word)

    def part(self) -> Node:
        if self.at >= len(self.tokens):
            self.refuse("a number or a name was expected at")
        kind, text, span = self.tokens[self.at]
        word = text.lower()
        if kind == "number":
            self.at += 1
            return Node("number", number=float(text))
        if text == "(" or word in FUNCTIONS:
            self.at += 1
            return self.bracket(word if kind == "name" else "")
        if kind == "mark" or word in ("and", "or", "not"):
            self.refuse("a number or a name was expected, found")
        if word not in self.known:
            near = hint(text, tuple(self.known.values()), 3)
            raise Alarm(f"there is nothing of the name {text!r} in this run", span, hint=near)
        self.at += 1
        return Node("name", name=self.known[word])

    def bracket(self, function: str) -> Node:
        if function and self.peek() != "(":
            self.refuse(f"{function} needs a bracket, found")
        self.at += bool(function)
        self.deeper()
        place, inner = self.at, self.climb()
        self.depth -= 1
        if self.peek() != ")":
            self.refuse("')' was expected before")
        self.at += 1
        return Node("function", (self.numeric(inner, place),), name=function) if function else inner

    def logical(self, node: Node, place: int, wanted: bool = True) -> Node:
        if node.logical != wanted:
            expected = "a comparison was expected here" if wanted else "a number was expected here, not a comparison"
            raise Alarm(expected, self.tokens[place].span)
        return node

    def numeric(self, node: Node, place: int) -> Node:
        return self.logical(node, place, wanted=False)
