"""Arithmetic and variables inside words: `Q1`, `-Q2`, `3 * (Q5 + 1)`."""

from __future__ import annotations

import math
import re
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Generic, NamedTuple, NoReturn, TypeVar

from mnclab.text.alarm import Alarm, Span

# Reading parts that are joined by operators, those that bind tighter first: precedence climbing.
#     2 * x + 1 < 5     `*` joins before `+`, and `+` before `<`
# A notation gives a table of its operators with their levels (the tighter, the greater), says what an operand is and what
# becomes of two operands that are joined. Depth is bounded, so that no text exhausts Python's stack.

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


# An expression is kept as it was written, with the place of every part, and evaluated when its block runs.
# The notation here is the one that conversational controls share: numbers, variables, `+ - * / DIV % ^`, brackets, PI
# and named functions in degrees. A reader that needs less simply refuses what it does not know.

_TOKEN = re.compile(r"\s*(?:(\d+(?:[.,]\d*)?|[.,]\d+)|(Q[LR]?\d+)|(DIV|[A-Z]+)|([-+*/^()%]))", re.IGNORECASE | re.ASCII)

#: Functions of one argument, angles in degrees.
FUNCTIONS: dict[str, Callable[[float], float]] = {
    "SQ": lambda a: a * a,
    "SQRT": math.sqrt,
    "SIN": lambda a: math.sin(math.radians(a)),
    "COS": lambda a: math.cos(math.radians(a)),
    "TAN": lambda a: math.tan(math.radians(a)),
    "ASIN": lambda a: math.degrees(math.asin(a)),
    "ACOS": lambda a: math.degrees(math.acos(a)),
    "ATAN": lambda a: math.degrees(math.atan(a)),
    "LN": math.log,
    "LOG": math.log10,
    "EXP": math.exp,
    "NEG": lambda a: -a,
    "ABS": abs,
    "INT": math.trunc,
    "FRAC": lambda a: math.fmod(a, 1.0),
    "SGN": lambda a: float((a > 0) - (a < 0)),
}

KINDS = ("number", "variable", "name", "mark")  # of the groups of `_TOKEN`
SUM, PRODUCT, POWER = range(3)
LEVELS = {"+": SUM, "-": SUM, "*": PRODUCT, "/": PRODUCT, "DIV": PRODUCT, "%": PRODUCT, "^": POWER}


@dataclass(frozen=True)
class Expression:
    """Tokens with their places; `evaluate` gives the number."""

    tokens: tuple[Token, ...]
    text: str
    scale: float = 1.0  # turns the result into the unit of its word: 25.4 in a program in inches
    steps: tuple[Token, ...] = ()
    """The tokens in the order in which they are worked out: an operator comes after what it joins."""

    def __repr__(self) -> str:
        return f"Expression({self.text})"

    def evaluate(self, variables: Mapping[str, Any]) -> float:
        """The value with these variables; an Alarm at the part that has none."""
        values: list[float] = []
        for token in self.steps:
            if token.kind == "number":
                values.append(finite(float(token.text), token))
            elif token.kind == "variable":
                try:
                    values.append(float(variables[token.text]))
                except KeyError:
                    refuse("no value was given to", token)
            elif token.kind == "sign":
                values[-1] = -values[-1]
            elif token.text in LEVELS:
                right = values.pop()
                values[-1] = finite(_joined(values[-1], token, right), token)
            elif token.text == "PI":
                values.append(math.pi)
            else:
                values[-1] = finite(_function(token, values[-1]), token)
        return self.scale * values[0]


def parse(text: str, span: Span, further: Sequence[tuple[str, Span]] = ()) -> Expression:
    """Read an expression that starts at `span`, and goes on in `further` lines with their places; an Alarm at the first
    character that is no part of one."""
    tokens: list[Token] = []
    for part, place in ((text, span), *further):
        tokens += split(part, _TOKEN, KINDS, place, "an expression", lambda part: part.upper().replace(",", "."))
    text = " ".join((text.strip(), *(part.strip() for part, _ in further)))
    return Expression(tuple(tokens), text.strip(), steps=_Reader(tokens).ordered())


class Orderer(Climber[None]):
    """Puts the tokens into the order in which they are worked out."""

    deepest = 100

    def __init__(self, tokens: list[Token]) -> None:
        super().__init__(tokens)
        self.steps: list[Token] = []

    def ordered(self) -> tuple[Token, ...]:
        self.climb()
        if self.at < len(self.tokens):
            refuse("an operator was expected before", self.tokens[self.at])
        return tuple(self.steps)

    def take(self) -> Token:
        if self.at >= len(self.tokens):
            last = self.tokens[-1] if self.tokens else None
            raise Alarm("the expression ends where a number or a variable was expected", last.span if last else None)
        self.at += 1
        return self.tokens[self.at - 1]

    def join(self, mark: str, left: None, first: int) -> None:
        operator = self.tokens[self.at - 1]
        self.right(mark)
        self.steps.append(operator)

    def too_deep(self) -> None:
        refuse(f"the expression is nested deeper than {self.deepest} at", self.tokens[self.at - 1])


class _Reader(Orderer):
    """That of this notation."""

    levels = LEVELS

    def operand(self, level: int) -> None:
        token = self.take()
        self.deeper()
        if token.text == "(":
            self.climb()
            closing = self.take()
            if closing.text != ")":
                refuse("')' was expected before", closing)
        elif token.text in ("+", "-"):
            self.climb(POWER)  # -2^2 is -(2^2)
            if token.text == "-":
                self.steps.append(token._replace(kind="sign"))
        elif token.kind in ("number", "variable") or token.text == "PI":
            self.steps.append(token)
        elif token.text in FUNCTIONS:
            self.operand(POWER)  # the next part only
            self.steps.append(token)
        else:
            refuse("a number or a variable was expected, found", token)
        self.depth -= 1


def _joined(left: float, operator: Token, right: float) -> float:
    """The value of two operands."""
    match operator.text:
        case "+":
            return left + right
        case "-":
            return left - right
        case "*":
            return left * right
        case "^":
            try:
                return float(left**right)
            except (ZeroDivisionError, OverflowError, TypeError):
                refuse("no real power at", operator)
    if right == 0:
        refuse("division by zero at", operator)
    return math.fmod(left, right) if operator.text == "%" else left / right


def _function(name: Token, argument: float) -> float:
    try:
        return FUNCTIONS[name.text](argument)
    except (ValueError, OverflowError):
        raise Alarm(f"{name.text} of {argument:g} has no real value", name.span) from None


def finite(value: float, token: Token) -> float:
    """A result, which an Alarm refuses where it is none."""
    if not math.isfinite(value):
        refuse("the result is out of range at", token)
    return float(value)


def refuse(what: str, token: Token) -> NoReturn:
    """Raise the Alarm at a token."""
    raise Alarm(f"{what} {token.text}", token.span)
