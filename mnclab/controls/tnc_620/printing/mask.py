"""The mask of FN 16: how texts and values are put out, a line for each statement.

    "MEASURED AT %02d:%02d",HOUR,MIN;
    "X1 = %9.3lf",Q31;
    * no more than a comment
    L_GERMAN;
    "Werkzeug %S",QS1;

As public Klartext manuals describe it (TNC 620, "FN 16: F-PRINT"): between the quotes %F, %D and %I stand for numbers with
their width and decimals, %S and %RS for texts; what is put out there follows behind commas. A keyword is a statement.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

LANGUAGES = (
    "english german czech french italian spanish portugue swedish danish finnish dutch polish hungaria russian chinese "
    "chinese_trad slovenian korean norwegian romanian slovak turkish"
).split()
TIMES = ("HOUR", "MIN", "SEC", "DAY", "MONTH", "YEAR2", "YEAR4")
MODES = ("M_CLOSE", "M_APPEND", "M_TRUNCATE", "M_EMPTY_HIDE", "M_EMPTY_SHOW")
REFUSED = ("M_APPEND_MAX", "STR_MONTH")
SPOKEN = {"L_ALL": "", **{f"L_{language.upper()}": language for language in LANGUAGES}}
WIDEST = 255  # characters of a field

_BLANKS = re.compile(r"\s*+")
_STATEMENT = re.compile(r'(?:%"|[^";]|"(?:%"|[^"])*+")*+')
_FORMAT = re.compile(r'"((?:%"|[^"])*+)"')
_PLACE = re.compile(r"%(%|\"|([+-]?)(0?)(\d{0,3})(?:\.(\d{1,2}))?(L?F|L?D|I|R?S))|\\([\\n])|([%\\])", re.IGNORECASE | re.ASCII)
_PARAMETER = re.compile(r"Q[LRS]?\d{1,4}", re.IGNORECASE | re.ASCII)


class Fault(Exception):
    """What is wrong in a line of the mask."""

    def __init__(self, message: str, line: int) -> None:
        super().__init__(f"line {line}: {message}")


class Field(NamedTuple):
    """A place for a value: "F", "D" or "S", its width, its decimals, whether it stands to the left, and with zeros before."""

    kind: str
    width: int
    decimals: int
    left: bool
    zeros: bool

    def filled(self, value: float | str) -> str:
        if isinstance(value, str):
            text = value
        elif self.kind == "F":
            text = f"{value:{'0' if self.zeros else ''}{self.width}.{self.decimals}f}"
        else:
            text = f"{round(value):{'0' if self.zeros else ''}{self.width}d}"
        return text.strip().ljust(self.width) if self.left else text.rjust(self.width)


class Statement(NamedTuple):
    """A line to put out: texts and fields in turn, and what fills the fields; or a keyword. `line` is that of the mask."""

    line: int
    keyword: str
    parts: tuple[str | Field, ...] = ()
    values: tuple[str, ...] = ()


@lru_cache(maxsize=16)
def parse(text: str) -> tuple[Statement, ...]:
    """The statements of a mask; a Fault names the line that is none."""
    return tuple(_statements(text.lstrip("\ufeff")))


def _statements(text: str) -> Iterator[Statement]:
    at, line = 0, 1
    while (begin := _BLANKS.match(text, at).end()) < len(text):  # type: ignore[union-attr]
        line += text.count("\n", at, begin)
        at = begin
        if text[at] == "*":
            end = text.find("\n", at)
            at = len(text) if end < 0 else end
            continue
        found = _STATEMENT.match(text, at)
        assert found is not None
        if text[found.end() : found.end() + 1] != ";":
            raise Fault("a statement ends with ;", line)
        yield _statement(found.group().strip(), line)
        line += text.count("\n", at, found.end())
        at = found.end() + 1


def _statement(text: str, line: int) -> Statement:
    if not text.startswith('"'):
        keyword = text.upper()
        if any(keyword.startswith(name) for name in REFUSED):
            raise Fault(f"{keyword[:20]} is not built yet", line)
        if keyword not in MODES and keyword not in SPOKEN:
            raise Fault(f"{text[:20]} is no keyword of a mask", line)
        return Statement(line, keyword)
    found = _FORMAT.match(text)
    assert found is not None
    parts = tuple(_parts(found.group(1), line))
    rest = text[found.end() :].strip()
    if rest and not rest.startswith(","):
        raise Fault("a comma stands between the text and what is put out in it", line)
    values = tuple(_value(each.strip(), line) for each in rest.split(",")[1:])
    fields = [part for part in parts if isinstance(part, Field)]
    if len(values) != len(fields):
        raise Fault(f"{len(fields)} places in the text, and {len(values)} values", line)
    for field, value in zip(fields, values, strict=True):
        if (field.kind == "S") != (value.startswith("QS") or value == "CALL_PATH"):
            raise Fault(f"%{field.kind} does not put out {value}: %S is for texts, %F and %D are for numbers", line)
    return Statement(line, "", parts, values)


def _parts(text: str, line: int) -> Iterator[str | Field]:
    at = 0
    for found in _PLACE.finditer(text):
        yield text[at : found.start()]
        at = found.end()
        whole, align, zeros, width, decimals, kind, escaped, alone = found.groups()
        if alone:
            raise Fault(f"{text[found.start() : found.start() + 6]} is no format", line)
        if escaped:
            yield "\n" if escaped == "n" else escaped
        elif kind is None:
            yield whole
        elif int(width or 0) > WIDEST:
            raise Fault(f"a field has at most {WIDEST} characters", line)
        else:
            kind = {"I": "D"}.get(kind[-1].upper(), kind[-1].upper())
            yield Field(kind, int(width or 0), int(decimals or 6), align == "-", bool(zeros))
    yield text[at:]


def _value(text: str, line: int) -> str:
    name = text.upper()
    if name in TIMES or name == "CALL_PATH":
        return name
    if name in REFUSED:
        raise Fault(f"{name} is not built yet", line)
    if not _PARAMETER.fullmatch(name):
        raise Fault(f"{text[:20] or 'nothing'} cannot be put out", line)
    kind = name.rstrip("0123456789")
    return f"{kind}{int(name[len(kind) :])}"
