"""FN 16: F-PRINT puts texts and values out by a mask, FN 15: PRINT values alone; into `Run.files`."""

from __future__ import annotations

import re
from collections.abc import Iterator

from mnclab.controls.tnc_620.clock import time_of_day
from mnclab.controls.tnc_620.printing.mask import LANGUAGES, SPOKEN, TIMES, Fault, Field, Statement, parse
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import FunctionTable, Setting, Words
from mnclab.machine.flow import put_out
from mnclab.machine.machine import Machine
from mnclab.running.interpreter import found
from mnclab.text.alarm import Alarm
from mnclab.text.expression import Expression
from mnclab.text.program import Word, digits

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
        text = found(m, name if "." in file else f"{name}.A", "FN 16", m.span_of(words["mask"]), "mask").text
    except Alarm as missing:  # which concerns the text alone, not the path
        m.warn(f"{missing.message}: nothing is written", words["mask"], missing.hint)
        return
    try:
        statements = parse(text)
    except Fault as fault:
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
