"""Texts in programs: `QS1 || " mm"`, `SUBSTR ( SRC_QS10 BEG2 LEN4 )`, and numbers found in them.

Like arithmetic, a text formula is kept as written, with the place of every part, and worked out when its block runs.
The first character of a text has the number 0.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from mnclab.text.alarm import Alarm, Span
from mnclab.text.expression import Expression, parse
from mnclab.text.program import digits

LONGEST = 255  # characters of a text
MOST_DECIMALS = 15

_FLAGS = re.IGNORECASE | re.ASCII
_LITERAL = re.compile(r'"([^"]*)"')
_VARIABLE = re.compile(r"QS[ \t]?(\d{1,6})(?!\d)", _FLAGS)
_FUNCTION = re.compile(r"(TOCHAR|SUBSTR|TONUMB|STRLEN|INSTR|STRCOMP|SYSSTR|CFGREAD)(?![A-Z])[ \t]*\(", _FLAGS)
_ARGUMENT = re.compile(r"(?:(SRC|SEA)_[ \t]*|(BEG|LEN|DAT|DECIMALS|IDX|ID|NR)[ \t]*)", _FLAGS)
_NUMBER = re.compile(r"[+-]?[ \t]*(?:\d+(?:[.,]\d*)?|[.,]\d+|Q[LR]?\d+)", _FLAGS)

#: Functions and their arguments, those that may be left out in small letters.
TEXTS = {"TOCHAR": ("DAT", "decimals"), "SUBSTR": ("SRC", "BEG", "LEN"), "SYSSTR": ("ID", "NR", "idx")}
NUMBERS = {"TONUMB": ("SRC",), "STRLEN": ("SRC",), "INSTR": ("SRC", "SEA", "beg"), "STRCOMP": ("SRC", "SEA")}
REFUSED = {"CFGREAD": "machine parameters"}


class Operand(NamedTuple):
    """A text in quotes ("literal"), a variable ("variable") or a function, with its arguments, and where it stands."""

    kind: str
    text: str
    span: Span
    arguments: Mapping[str, Any]


@dataclass(frozen=True)
class TextFormula:
    """Parts that are joined; `evaluate` gives the text."""

    parts: tuple[Operand, ...]
    text: str

    def __repr__(self) -> str:
        return f"TextFormula({self.text})"

    def evaluate(self, variables: Mapping[str, Any]) -> str:
        """The text with these variables; an Alarm at the part that has none."""
        found = "".join(_text(part, variables) for part in self.parts)
        if len(found) > LONGEST:
            raise Alarm(f"a text has at most {LONGEST} characters, this one {len(found)}", self.parts[0].span)
        return found


@dataclass(frozen=True)
class NumberFromText:
    """A function of texts whose result is a number: TONUMB, STRLEN, INSTR, STRCOMP."""

    part: Operand
    text: str

    def __repr__(self) -> str:
        return f"NumberFromText({self.text})"

    def evaluate(self, variables: Mapping[str, Any]) -> float:
        """The number with these variables; an Alarm at the part that has none."""
        return float(_NUMBER_OF[self.part.text](self.part, variables))


def is_number(text: str) -> bool:
    """Whether a formula begins with a function of texts that gives a number (or is refused)."""
    found = _FUNCTION.match(text.lstrip())
    return found is not None and found.group(1).upper() not in TEXTS


def parse_text(text: str, span: Span) -> TextFormula:
    """Read a formula whose result is a text, and which begins at `span`."""
    reader = _Reader(text, span)
    parts = [reader.part()]
    while not reader.done:
        if not reader.text.startswith("||", reader.at):
            raise Alarm("|| was expected between two texts", reader.place(1))
        reader.at += 2
        parts.append(reader.part())
    for part in parts:
        if part.text in NUMBERS:
            said = f"{part.text} gives a number, a text is wanted here"
            raise Alarm(said, part.span, hint="assign it to a Q parameter")
    return TextFormula(tuple(parts), text.strip())


def parse_number(text: str, span: Span) -> NumberFromText:
    """Read a formula of texts whose result is a number, and which begins at `span`."""
    reader = _Reader(text, span)
    part = reader.part()
    if not reader.done:
        said = f"nothing may follow {part.text} ( … ) here"
        raise Alarm(said, reader.place(1), hint="calculate in a block of its own")
    return NumberFromText(part, text.strip())


class _Reader:
    """A place in a formula."""

    def __init__(self, text: str, span: Span) -> None:
        self.text, self.span, self.at = text.rstrip(), span, 0

    @property
    def done(self) -> bool:
        while self.text[self.at : self.at + 1] in (" ", "\t"):
            self.at += 1
        return self.at >= len(self.text)

    def place(self, length: int, at: int | None = None) -> Span:
        return self.span._replace(column=self.span.column + (self.at if at is None else at), length=length)

    def match(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        found = None if self.done else pattern.match(self.text, self.at)
        self.at = found.end() if found else self.at
        return found

    def part(self, functions: bool = True) -> Operand:
        """A text in quotes, a QS parameter, or a function with its arguments."""
        begin = self.at + len(self.text[self.at :]) - len(self.text[self.at :].lstrip())
        if found := self.match(_LITERAL):
            return Operand("literal", found.group(1), self.place(len(found.group()), begin), {})
        if found := self.match(_VARIABLE):
            return Operand("variable", f"QS{int(found.group(1))}", self.place(len(found.group()), begin), {})
        if functions and (found := self.match(_FUNCTION)):
            return self.function(found.group(1).upper(), self.place(len(found.group(1)), begin))
        shown = self.text[self.at : self.at + 1]
        what = f", found {shown!r}" if shown else ""
        hint = "a function of texts is written with a bracket" if shown.isalpha() else ""
        raise Alarm(f"a text in quotes or a QS parameter was expected{what}", self.place(1), hint=hint)

    def function(self, name: str, span: Span) -> Operand:
        """The arguments of a function, in any order, up to the closing bracket."""
        if name in REFUSED:
            self.at = self.text.find(")", self.at) + 1
            if not self.at:
                raise Alarm(f"{name} has no closing bracket", span)
            return Operand("function", name, span, {})
        known, given = {**TEXTS, **NUMBERS}[name], {}
        while not self.done and self.text[self.at] != ")":
            begin = self.at
            found = self.match(_ARGUMENT)
            word = (found.group(1) or found.group(2)).upper() if found else ""
            if word not in {each.upper() for each in known}:
                takes, place = " ".join(each.upper() for each in known), self.place(max(1, len(word)), begin)
                raise Alarm(f"{word or self.text[begin]} is no part of {name}", place, hint=f"it takes {takes}")
            if word in given:
                raise Alarm(f"{word} is written twice in {name}", self.place(len(word), begin))
            given[word] = self.part(functions=False) if found and found.group(1) else self.number(word, begin)
        if self.done:
            raise Alarm(f"{name} has no closing bracket", span)
        self.at += 1
        for each in known:
            if each.isupper() and each not in given:
                raise Alarm(f"{name} needs {each}", span)
        return Operand("function", name, span, given)

    def number(self, word: str, begin: int) -> Expression:
        blank = self.done
        at, found = self.at, self.match(_NUMBER)
        if blank or found is None:
            raise Alarm(f"{word} needs a number or a Q parameter", self.place(len(word), begin))
        return parse(found.group(), self.place(1, at))


def _text(part: Operand, variables: Mapping[str, Any]) -> str:
    if part.kind == "literal":
        return part.text
    if part.kind == "variable":
        value = variables.get(part.text)
        if value is None:
            raise Alarm(f"no text was given to {part.text}", part.span)
        return str(value)
    if part.text in REFUSED:
        raise Alarm(f"{part.text} is refused: {REFUSED[part.text]} are not built yet", part.span)
    return {"TOCHAR": _tochar, "SUBSTR": _substr, "SYSSTR": _sysstr}[part.text](part, variables)


def _whole(part: Operand, name: str, variables: Mapping[str, Any], most: float) -> int:
    value: float = part.arguments[name].evaluate(variables)
    if value != int(value) or not 0 <= value <= most:
        raise Alarm(f"{part.text} {name} must be a whole number from 0 to {most:g}, got {value:g}", part.span)
    return int(value)


def _tochar(part: Operand, variables: Mapping[str, Any]) -> str:
    """A number as a text: with the decimals that are asked for, or with those that it has."""
    value = part.arguments["DAT"].evaluate(variables)
    if "DECIMALS" not in part.arguments:
        return digits(value)
    return f"{value:.{_whole(part, 'DECIMALS', variables, MOST_DECIMALS)}f}"


def _substr(part: Operand, variables: Mapping[str, Any]) -> str:
    """Characters of a text, which must be there."""
    source = _text(part.arguments["SRC"], variables)
    begin, length = (_whole(part, name, variables, LONGEST) for name in ("BEG", "LEN"))
    if begin + length > len(source):
        what = f"characters {begin} to {begin + length - 1} of a text of {len(source)}"
        raise Alarm(f"SUBSTR cannot take {what}", part.span, hint="the first character has the number 0")
    return source[begin : begin + length]


def _sysstr(part: Operand, variables: Mapping[str, Any]) -> str:
    """What the control keeps in a variable of this name: `SYSSTR ID10950 NR1`."""
    named = (f"{name}{part.arguments[name].evaluate(variables):g}" for name in ("ID", "NR", "IDX") if name in part.arguments)
    name = " ".join(("SYSSTR", *named))
    try:
        return str(variables[name])
    except KeyError:
        raise Alarm(f"{name} is not built yet", part.span) from None


def _tonumb(part: Operand, variables: Mapping[str, Any]) -> float:
    source = _text(part.arguments["SRC"], variables).strip()
    if not re.fullmatch(r"[+-]?(?:\d+(?:[.,]\d*)?|[.,]\d+)", source, re.ASCII) or len(source) > 40:
        raise Alarm(f'TONUMB needs a text that is one number, got "{source[:40]}"', part.span)
    return float(source.replace(",", "."))


def _strlen(part: Operand, variables: Mapping[str, Any]) -> float:
    """How many characters; -1 for a QS parameter that has no text."""
    source = part.arguments["SRC"]
    if source.kind == "variable" and variables.get(source.text) is None:
        return -1
    return len(_text(source, variables))


def _instr(part: Operand, variables: Mapping[str, Any]) -> float:
    """Where a text begins in another, looked for from BEG on; the length of that one if nowhere."""
    source, sought = (_text(part.arguments[name], variables) for name in ("SRC", "SEA"))
    begin = _whole(part, "BEG", variables, LONGEST) if "BEG" in part.arguments else 0
    at = source.find(sought, begin)
    return at if at >= 0 else len(source)


def _strcomp(part: Operand, variables: Mapping[str, Any]) -> float:
    """0 for the same text, -1 if the first comes before the second in the order of the characters, else 1."""
    one, other = (_text(part.arguments[name], variables) for name in ("SRC", "SEA"))
    return (one > other) - (one < other)


_NUMBER_OF: dict[str, Callable[[Operand, Mapping[str, Any]], Any]] = {
    "TONUMB": _tonumb, "STRLEN": _strlen, "INSTR": _instr, "STRCOMP": _strcomp, "CFGREAD": _text,
}  # fmt: skip
