"""Reading parts that are joined by operators, those that bind tighter first: precedence climbing.

    2 * x + 1 < 5     `*` joins before `+`, and `+` before `<`

A notation gives a table of its operators with their levels (the tighter, the greater), says what an operand is and what
becomes of two operands that are joined. Depth is bounded, so that no text exhausts Python's stack.
"""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from typing import ClassVar, Generic, NamedTuple, TypeVar

from mnclab.text.alarm import Alarm, Span

T = TypeVar("T")


class Token(NamedTuple):
    """One part of an expression and where it stands."""

    kind: str
    text: str
    span: Span


def split(
    text: str, pattern: re.Pattern[str], kinds: tuple[str, ...], span: Span, what: str, spell: Callable[[str], str] = str,
    hint: str = "",
) -> list[Token]:  # fmt: skip
    """The tokens of a text that starts at `span`; every group of the pattern is one of the kinds.

    `spell` gives a token the letters of the tables. An Alarm at the first character that is no part of `what`.
    """
    tokens, at, end = [], 0, len(text.rstrip())
    while at < end:
        match = pattern.match(text, at)
        if match is None:
            rest = text[at:].lstrip()
            place = span._replace(column=span.column + len(text) - len(rest), length=1)
            raise Alarm(f"{rest[:1]!r} is no part of {what}", place, hint=hint)
        group = match.lastindex or 1
        part = match[group]
        place = span._replace(column=span.column + match.end() - len(part), length=len(part))
        tokens.append(Token(kinds[group - 1], spell(part), place))
        at = match.end()
    return tokens


class Climber(ABC, Generic[T]):
    """A place in the tokens; `climb` reads on from there and gives what `operand` and `join` make of it."""

    levels: ClassVar[Mapping[str, int]]
    """How tight each operator binds; `^` joins from the right, all others from the left."""
    deepest: ClassVar[int]

    def __init__(self, tokens: list[Token]) -> None:
        self.tokens, self.at, self.depth = tokens, 0, 0

    def peek(self) -> str:
        """The next token as the tables spell it, empty at the end."""
        return self.tokens[self.at].text if self.at < len(self.tokens) else ""

    def climb(self, level: int = 0) -> T:
        """An operand and all that operators of a level or a tighter one join to it."""
        first, left = self.at, self.operand(level)
        while self.levels.get(mark := self.peek(), -1) >= level:
            self.at += 1
            left = self.join(mark, left, first)
        return left

    def right(self, mark: str) -> T:
        """What stands to the right of an operator that was just read."""
        level = self.levels[mark]
        if mark != "^":
            return self.climb(level + 1)
        self.deeper()
        found = self.climb(level)
        self.depth -= 1
        return found

    def deeper(self) -> None:
        self.depth += 1
        if self.depth > self.deepest:
            self.too_deep()

    @abstractmethod
    def operand(self, level: int) -> T:
        """A part, with the signs and words before it that may stand to the right of an operator of a level."""

    @abstractmethod
    def join(self, mark: str, left: T, first: int) -> T:
        """What an operator makes of `left`, which begins at the token `first`, and of its `right`, still to be read."""

    @abstractmethod
    def too_deep(self) -> None:
        """Raise the Alarm at what is nested too deep."""
