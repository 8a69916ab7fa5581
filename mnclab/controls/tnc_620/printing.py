"""Texts that a program writes: FN 16 by a mask, FN 15."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

from mnclab.controls.tnc_620.state import memory, time_of_day
from mnclab.machine.control import FunctionTable, Setting, Words
from mnclab.machine.flow import put_out
from mnclab.machine.machine import Machine
from mnclab.running.interpreter import found as found_file
from mnclab.text.alarm import Alarm
from mnclab.text.expression import Expression
from mnclab.text.program import Word, digits

# The mask of FN 16: how texts and values are put out, a line for each statement.
#     "MEASURED AT %02d:%02d",HOUR,MIN;
#     "X1 = %9.3lf",Q31;
#     * no more than a comment
#     L_GERMAN;
#     "Werkzeug %S",QS1;
# As public Klartext manuals describe it (TNC 620, "FN 16: F-PRINT"): between the quotes %F, %D and %I stand for numbers with
# their width and decimals, %S and %RS for texts; what is put out there follows behind commas. A keyword is a statement.

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


class MaskFault(Exception):
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
    """The statements of a mask; a MaskFault names the line that is none."""
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
            raise MaskFault("a statement ends with ;", line)
        yield _statement(found.group().strip(), line)
        line += text.count("\n", at, found.end())
        at = found.end() + 1


def _statement(text: str, line: int) -> Statement:
    if not text.startswith('"'):
        keyword = text.upper()
        if any(keyword.startswith(name) for name in REFUSED):
            raise MaskFault(f"{keyword[:20]} is not built yet", line)
        if keyword not in MODES and keyword not in SPOKEN:
            raise MaskFault(f"{text[:20]} is no keyword of a mask", line)
        return Statement(line, keyword)
    found = _FORMAT.match(text)
    assert found is not None
    parts = tuple(_parts(found.group(1), line))
    rest = text[found.end() :].strip()
    if rest and not rest.startswith(","):
        raise MaskFault("a comma stands between the text and what is put out in it", line)
    values = tuple(_value(each.strip(), line) for each in rest.split(",")[1:])
    fields = [part for part in parts if isinstance(part, Field)]
    if len(values) != len(fields):
        raise MaskFault(f"{len(fields)} places in the text, and {len(values)} values", line)
    for field, value in zip(fields, values, strict=True):
        if (field.kind == "S") != (value.startswith("QS") or value == "CALL_PATH"):
            raise MaskFault(f"%{field.kind} does not put out {value}: %S is for texts, %F and %D are for numbers", line)
    return Statement(line, "", parts, values)


def _parts(text: str, line: int) -> Iterator[str | Field]:
    at = 0
    for found in _PLACE.finditer(text):
        yield text[at : found.start()]
        at = found.end()
        whole, align, zeros, width, decimals, kind, escaped, alone = found.groups()
        if alone:
            raise MaskFault(f"{text[found.start() : found.start() + 6]} is no format", line)
        if escaped:
            yield "\n" if escaped == "n" else escaped
        elif kind is None:
            yield whole
        elif int(width or 0) > WIDEST:
            raise MaskFault(f"a field has at most {WIDEST} characters", line)
        else:
            kind = {"I": "D"}.get(kind[-1].upper(), kind[-1].upper())
            yield Field(kind, int(width or 0), int(decimals or 6), align == "-", bool(zeros))
    yield text[at:]


def _value(text: str, line: int) -> str:
    name = text.upper()
    if name in TIMES or name == "CALL_PATH":
        return name
    if name in REFUSED:
        raise MaskFault(f"{name} is not built yet", line)
    if not _PARAMETER.fullmatch(name):
        raise MaskFault(f"{text[:20] or 'nothing'} cannot be put out", line)
    kind = name.rstrip("0123456789")
    return f"{kind}{int(name[len(kind) :])}"


# FN 16: F-PRINT puts texts and values out by a mask, FN 15: PRINT values alone; into `Run.files`.

FUNCTIONS = FunctionTable()
SETTINGS = (
    Setting(
        "language", "english", "language of the dialog, of which FN 16 puts the lines out", "Klartext, not described",
        {language: f"lines of L_{language.upper()}" for language in LANGUAGES},
    ),
)  # fmt: skip
WINDOW, CLEAR = "SCREEN:", "SCLR:"
PRINTED = "%FN15RUN.A"
_IN_A_NAME = re.compile(r":'(QS\d{1,4})'", re.IGNORECASE | re.ASCII)


@FUNCTIONS("FN 16,", "Formatted output", takes="mask output", source="Klartext, not described")
def print_formatted(m: Machine, words: Words) -> None:
    """Puts the lines of a mask out; the mask is a file as programs are. What is put out to one file during a run stands one
    behind the other until M_CLOSE; then the file begins anew, unless the mask says M_APPEND. SCREEN: is a window.
    """
    output = named(m, words["output"])
    if output.upper().startswith(CLEAR):
        memory(m).closed_files |= {WINDOW.lower()}
        return
    if m.recorded_only:
        m.warn("FN 16 writes nothing while a contour is read", words["mask"])
        return
    name = named(m, words["mask"])
    file = name.replace("\\", "/").rpartition("/")[2]
    try:
        text = found_file(m, name if "." in file else f"{name}.A", "FN 16", m.span_of(words["mask"]), "mask").text
    except Alarm as missing:  # which concerns the text alone, not the path
        m.warn(f"{missing.message}: nothing is written", words["mask"], missing.hint)
        return
    try:
        statements = parse(text)
    except MaskFault as fault:
        m.alarm(f"FN 16: mask {name}, {fault}", words["mask"])
    lines = "".join(line for statement in spoken(m, statements) for line in put(m, statement, words["mask"]))
    keywords, key = {statement.keyword for statement in statements}, output.lower()
    closed = memory(m).closed_files
    put_out(m, output, lines, "M_TRUNCATE" in keywords or (key in closed and "M_APPEND" not in keywords))
    memory(m).closed_files = closed | {key} if "M_CLOSE" in keywords else closed - {key}


def named(m: Machine, word: Word) -> str:
    """The name of a file; :'QS1' in it is the text of QS1."""

    def text(match: re.Match[str]) -> str:
        name = match.group(1).upper()
        if not isinstance(value := m.variables.get(name), str):
            m.alarm(f"no text was given to {name}", word)
        return value

    return _IN_A_NAME.sub(text, str(word.value)).strip()


def spoken(m: Machine, statements: tuple[Statement, ...]) -> Iterator[Statement]:
    """The lines of all languages and of that of the dialog; without those that have no text, while the mask hides them."""
    language, hides = "", False
    for statement in statements:
        if not statement.keyword:
            if language in ("", m.settings["language"]) and not (hides and empty(m, statement)):
                yield statement
        elif statement.keyword.startswith("M_EMPTY"):
            hides = statement.keyword == "M_EMPTY_HIDE"
        else:
            language = SPOKEN.get(statement.keyword, language)


def empty(m: Machine, statement: Statement) -> bool:
    """Whether nothing but texts are put out, and none of them was given."""
    names = statement.values
    alone = not any(part.strip() for part in statement.parts if isinstance(part, str))
    return bool(names) and alone and all(name.startswith("QS") and not m.variables.get(name) for name in names)


def put(m: Machine, statement: Statement, word: Word) -> Iterator[str]:
    """A line, with its end."""
    values = iter(statement.values)
    for part in statement.parts:
        yield part.filled(value(m, next(values), part, word)) if isinstance(part, Field) else part
    yield "\n"


def value(m: Machine, name: str, field: Field, word: Word) -> float | str:
    """What is put out under a name."""
    if name == "CALL_PATH":
        return m.flow.program.title
    if name in TIMES:
        return time(m, name, word)
    try:
        found = m.variables[name]
    except KeyError:
        if name.startswith("QS"):
            return ""
        m.alarm(f"FN 16: no value was given to {name}", word)
    if field.kind == "D" and found != round(found):
        m.warn(f"FN 16: {name} is put out as a whole number and is none: it is rounded", word)
    return float(found) if field.kind != "S" else str(found)


def time(m: Machine, name: str, word: Word) -> float:
    now = time_of_day(m)
    if now is None:
        m.alarm(f"FN 16: {name} asks for the time, which a run does not have", word, "the setting clock gives it one")
    parts = (now.hour, now.minute, now.second, now.day, now.month, now.year % 100, now.year)
    return float(dict(zip(TIMES, parts, strict=True))[name])


@FUNCTIONS("FN 15,", "Unformatted output", takes="item*", source="Klartext, not described")
def print_values(m: Machine, words: Words) -> None:
    """Puts parameters out into %FN15RUN.A, a line for each; a number names a text of the control, which is not known here."""
    m.warn(f"FN 15: how the control sets out its values is not known, a line each in {PRINTED} is our own way")
    lines = []
    for word in words.all("item"):
        name = word.value.text.strip(" \t+") if isinstance(word.value, Expression) else "text"
        lines.append(f"{name} {'= ' if name != 'text' else ''}{digits(m.value(word))}\n")
    put_out(m, PRINTED, "".join(lines))
