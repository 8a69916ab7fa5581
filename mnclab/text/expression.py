"""Arithmetic and variables inside words: `Q1`, `-Q2`, `3 * (Q5 + 1)`.

An expression is kept as it was written, with the place of every part, and evaluated when its block runs.
The notation here is the one that conversational controls share: numbers, variables, `+ - * / DIV % ^`, brackets, PI
and named functions in degrees. A reader that needs less simply refuses what it does not know.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from mnclab.text.alarm import Alarm, Span

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


class Token(NamedTuple):
    """One part of an expression and where it stands."""

    kind: str  # "number", "variable", "name", "mark"
    text: str
    span: Span


@dataclass(frozen=True)
class Expression:
    """Tokens with their places; `evaluate` gives the number."""

    tokens: tuple[Token, ...]
    text: str
    scale: float = 1.0  # turns the result into the unit of its word: 25.4 in a program in inches

    def __repr__(self) -> str:
        return f"Expression({self.text})"

    def evaluate(self, variables: Mapping[str, Any]) -> float:
        """The value with these variables; an Alarm at the part that has none."""
        return self.scale * _Evaluation(self.tokens, variables).whole()


def parse(text: str, span: Span) -> Expression:
    """Read an expression that starts at `span`; an Alarm at the first character that is no part of one."""
    tokens, at, end = [], 0, len(text.rstrip())
    while at < end:
        match = _TOKEN.match(text, at)
        if match is None:
            blank = len(text[at:]) - len(text[at:].lstrip())
            place = span._replace(column=span.column + at + blank, length=1)
            raise Alarm(f"{text[at:].strip()[:1]!r} is no part of an expression", place)
        kind = ("number", "variable", "name", "mark")[(match.lastindex or 1) - 1]
        part = match.group(match.lastindex or 1)
        place = span._replace(column=span.column + match.end() - len(part), length=len(part))
        tokens.append(Token(kind, part.upper().replace(",", "."), place))
        at = match.end()
    expression = Expression(tuple(tokens), text.strip())
    _Evaluation(expression.tokens, _Anything()).whole(reading=True)  # the grammar; values come when it runs
    return expression


class _Anything(dict[str, float]):
    """Every variable is 1: enough to walk through the grammar."""

    def __missing__(self, key: str) -> float:
        return 1.0


class _Evaluation:
    """Recursive descent: sum of products of powers of signed parts."""

    def __init__(self, tokens: tuple[Token, ...], variables: Mapping[str, Any]) -> None:
        self.tokens, self.variables, self.at, self.reading, self.depth = tokens, variables, 0, False, 0

    def whole(self, reading: bool = False) -> float:
        self.reading = reading
        value = self.sum()
        if self.at < len(self.tokens):
            self.refuse("an operator was expected before", self.tokens[self.at])
        return value

    def peek(self) -> str:
        return self.tokens[self.at].text if self.at < len(self.tokens) else ""

    def take(self) -> Token:
        if self.at >= len(self.tokens):
            last = self.tokens[-1] if self.tokens else None
            raise Alarm("the expression ends where a number or a variable was expected", last.span if last else None)
        self.at += 1
        return self.tokens[self.at - 1]

    def refuse(self, what: str, token: Token) -> None:
        raise Alarm(f"{what} {token.text}", token.span)

    def sum(self) -> float:
        value = self.product()
        while self.peek() in ("+", "-"):
            sign = self.take()
            value = self.finite(value + self.product() if sign.text == "+" else value - self.product(), sign)
        return value

    def product(self) -> float:
        value = self.power()
        while self.peek() in ("*", "/", "DIV", "%"):
            operator = self.take()
            other = self.power()
            if operator.text == "*":
                value = self.finite(value * other, operator)
            elif other == 0 and not self.reading:
                self.refuse("division by zero at", operator)
            elif operator.text == "%":
                value = math.fmod(value, other or 1.0)
            else:
                value = self.finite(value / (other or 1.0), operator)
        return value

    def power(self) -> float:
        value = self.part()
        if self.peek() == "^":
            operator = self.take()
            self.deeper(operator)
            exponent = self.power()
            self.depth -= 1
            if self.reading:
                return 1.0
            try:
                value = self.finite(float(value**exponent), operator)
            except (ZeroDivisionError, OverflowError, TypeError):
                self.refuse("no real power at", operator)
        return value

    def deeper(self, token: Token) -> None:
        self.depth += 1
        if self.depth > 100:
            self.refuse("the expression is nested deeper than 100 at", token)

    def part(self) -> float:
        token = self.take()
        self.deeper(token)
        value = self.value_of(token)
        self.depth -= 1
        return value

    def value_of(self, token: Token) -> float:
        if token.kind == "number":
            return self.finite(float(token.text), token)
        if token.kind == "variable":
            try:
                return float(self.variables[token.text])
            except KeyError:
                self.refuse("no value was given to", token)
        if token.text in ("+", "-"):
            return self.power() if token.text == "+" else -self.power()  # -2^2 is -(2^2)
        if token.text == "(":
            value = self.sum()
            closing = self.take()
            if closing.text != ")":
                self.refuse("')' was expected before", closing)
            return value
        if token.text == "PI":
            return math.pi
        if token.text in FUNCTIONS:
            return self.function(token)
        self.refuse("a number or a variable was expected, found", token)
        raise AssertionError

    def function(self, token: Token) -> float:
        argument = self.part()
        if self.reading:
            return 1.0
        try:
            return self.finite(FUNCTIONS[token.text](argument), token)
        except (ValueError, OverflowError):
            raise Alarm(f"{token.text} of {argument:g} has no real value", token.span) from None

    def finite(self, value: float, token: Token) -> float:
        if not math.isfinite(value) and not self.reading:
            self.refuse("the result is out of range at", token)
        return value
