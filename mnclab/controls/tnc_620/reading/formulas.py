"""How Q parameters, texts and the functions FN are written (catalogue: Q parameters, Q formula, QS, FN).

A formula becomes the words `target` and `value`. FN 0 to 7 are formulas of a fixed form; FN 8 and FN 13 join two
operands, `first` and `second`; FN 17 and FN 18 name system data by `ID`, `NR` and `IDX`.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import NamedTuple

from mnclab.controls.tnc_620.reading.words import FLAGS, NUMBER, TEXT, Cursor, Fault
from mnclab.text import strings
from mnclab.text.alarm import Span

Read = Callable[[Cursor], None]

GREATEST = {"": 1999, "L": 499, "R": 499, "S": 1999}

OPERAND = re.compile(rf"[ \t]*(?:[+-][ \t]*)?(?:{NUMBER}|Q[LR]?\d+)", FLAGS)
_OPERAND = rf"(?:[+-]\s*)?(?:{NUMBER}|Q[LR]?\d+)"
TARGET = re.compile(r"Q([LRSC]?)[ \t]?(\d{1,6})(?!\d)[ \t]*", FLAGS)
EQUALS = re.compile(r"=[ \t]*", FLAGS)
_UNDEFINED = re.compile(r"SET[ \t]+UNDEFINED", FLAGS)
_ERROR = re.compile(r"[ \t]*ERROR[ \t]*=", FLAGS)
_WRITE, _READ = re.compile(r"[ \t]*SYSWRITE(?![A-Z])", FLAGS), re.compile(r"[ \t]*SYSREAD(?![A-Z])", FLAGS)
_CDATA = re.compile(r"CDATA(?![A-Z])", FLAGS)
_PRESET, _AXIS, SLASH = re.compile(r"PRESET[ \t]*=", FLAGS), re.compile("[A-CU-Z]", FLAGS), re.compile("/")
_SYSTEM = [(name, re.compile(rf"[ \t]*{name}", FLAGS)) for name in ("ID", "NR", "IDX")]


class Form(NamedTuple):
    """What must follow `FN n: Q1 =`, and how it looks."""

    pattern: re.Pattern[str]
    example: str


FORMS = {
    number: Form(re.compile(pattern, FLAGS), f"FN {number}: Q1 = {example}")
    for number, (pattern, example) in enumerate([
        (_OPERAND, "+2"),
        (rf"{_OPERAND}\s*\+\s*{_OPERAND}", "+2 + +3"),
        (rf"{_OPERAND}\s*-\s*{_OPERAND}", "+2 - +3"),
        (rf"{_OPERAND}\s*\*\s*{_OPERAND}", "+2 * +3"),
        (rf"{_OPERAND}\s*(?:DIV|/)\s*{_OPERAND}", "+2 DIV +3"),
        (rf"SQRT\s*{_OPERAND}", "SQRT +2"),
        (rf"SIN\s*{_OPERAND}", "SIN -Q5"),
        (rf"COS\s*{_OPERAND}", "COS -Q5"),
    ])
}  # fmt: skip
PAIRS = {8: "LEN", 13: "ANG"}


def assignment(target: str, begin: int) -> Read:
    """The formula of `Q1 = …`; its target was read already."""

    def read(cursor: Cursor) -> None:
        formula(cursor, target, begin)

    return read


def formula(cursor: Cursor, target: str, begin: int, form: Form | None = None) -> None:
    """A Q parameter takes the value of a formula."""
    start = value_begins(cursor, target, begin)
    rest = cursor.rest().rstrip()
    if form and not form.pattern.fullmatch(rest):
        raise Fault(f"the function must have the form {form.example}", start, len(rest))
    if form is None and strings.is_number(rest):
        value: object = strings.parse_number(rest, span(cursor, start))
    elif rest.startswith('"'):
        raise Fault(f"{target} holds a number, not a text", start, len(rest), "texts stand in QS parameters")
    else:
        value = cursor.expression(start, cursor.stop)
    cursor.at = cursor.stop
    cursor.add("value", value, start)


def text_assignment(target: str, begin: int) -> Read:
    """The texts of `QS1 = …`; its target was read already."""

    def read(cursor: Cursor) -> None:
        start = value_begins(cursor, target, begin)
        value = strings.parse_text(cursor.rest(), span(cursor, start))
        cursor.at = cursor.stop
        cursor.add("value", value, start)

    return read


def text_formula(cursor: Cursor, begin: int, end: int) -> strings.TextFormula:
    """The text between two places: that of a QS parameter."""
    return strings.parse_text(cursor.text[begin:end].strip(), span(cursor, begin))


def declared_text(cursor: Cursor) -> None:
    """DECLARE STRING QS1 = …"""
    begin = cursor.blanks()
    found = cursor.match(TARGET)
    if found is None or found.group(1).upper() != "S" or not cursor.match(EQUALS):
        raise Fault("DECLARE STRING needs a QS parameter and =", begin, hint='for example DECLARE STRING QS1 = "A"')
    text_assignment(f"QS{int(found.group(2))}", begin)(cursor)


def value_begins(cursor: Cursor, target: str, begin: int) -> int:
    """Add the target; the place where its value begins, which must be there."""
    add_target(cursor, target, begin)
    start = cursor.blanks()
    if cursor.done:
        raise Fault(f"{target} = needs a value", start)
    return start


def add_target(cursor: Cursor, target: str, begin: int) -> None:
    """The word of a parameter that gets a value, if there is one of this number."""
    kind = target[1] if target[1].isalpha() else ""
    if int(target[1 + len(kind) :]) > GREATEST[kind]:
        allowed = "QS0 to QS1999 are" if kind == "S" else "Q0 to Q1999, QL0 to QL499 and QR0 to QR499 are"
        raise Fault(f"{target} does not exist: {allowed} allowed", begin, len(target))
    cursor.builder.word("target", target, begin, len(target))


def span(cursor: Cursor, offset: int) -> Span:
    """The place in the text where a formula begins."""
    return cursor.builder.span(offset)


# --- FN ---------------------------------------------------------------------------------------------------------------


def numeric_target(cursor: Cursor, number: int, example: str) -> tuple[str, int]:
    """The parameter that FN gives a value, and where it stands."""
    begin = cursor.blanks()
    found = cursor.match(TARGET)
    if found is None:
        raise Fault(f"FN {number} needs a Q parameter and =", begin, hint=example)
    name = f"Q{found.group(1).upper()}{int(found.group(2))}"
    if name[1] in "SC":
        raise Fault(
            f"FN {number} gives a number: {name} cannot hold it", begin, len(name), "take a Q, QL or QR parameter"
        )
    return name, begin


def needs_equals(cursor: Cursor, number: int, example: str) -> None:
    """The = after the parameter."""
    if not cursor.match(EQUALS):
        raise Fault(f"FN {number} needs a Q parameter and =", cursor.blanks(), hint=example)


def target_of(cursor: Cursor, number: int, example: str) -> tuple[str, int]:
    """The parameter that FN gives a value, where it stands, and the = behind it."""
    found = numeric_target(cursor, number, example)
    needs_equals(cursor, number, example)
    return found


def arithmetic(number: int) -> Read:
    """FN 0 to FN 7; FN 0 can also take a value away."""

    def read(cursor: Cursor) -> None:
        example = FORMS[number].example
        name, begin = numeric_target(cursor, number, example)
        if number == 0 and (found := cursor.match(_UNDEFINED)):
            add_target(cursor, name, begin)
            cursor.add("undefined", None, found.start())
            return
        needs_equals(cursor, number, example)
        formula(cursor, name, begin, FORMS[number])

    return read


def pair(number: int) -> Read:
    """FN 8 and FN 13: an operand, a word, an operand."""

    def read(cursor: Cursor) -> None:
        word = PAIRS[number]
        example = f"FN {number}: Q1 = +5 {word} +4"
        start = value_begins(cursor, *target_of(cursor, number, example))
        operand(cursor, "first", example)
        if not cursor.match(re.compile(rf"[ \t]*{word}(?![A-Z])", FLAGS)):
            raise Fault(f"the function must have the form {example}", start, max(1, cursor.stop - start))
        operand(cursor, "second", example)

    return read


def operand(cursor: Cursor, address: str, example: str) -> None:
    """A number or a Q parameter with its sign."""
    begin = cursor.blanks()
    found = cursor.match(OPERAND)
    if found is None:
        raise Fault("a number or a Q parameter was expected", begin, hint=f"for example {example}")
    cursor.add(address, cursor.expression(found.start(), found.end()), begin)


def error(cursor: Cursor) -> None:
    """FN 14: ERROR = number."""
    if not cursor.match(_ERROR):
        raise Fault("FN 14 needs ERROR = and a number", cursor.blanks(), hint="for example FN 14: ERROR = 1000")
    operand(cursor, "number", "FN 14: ERROR = 1000")


def circle_data(number: int) -> Read:
    """FN 23 and FN 24: the parameter that gets the centre, and the first of those with the points."""

    def read(cursor: Cursor) -> None:
        example = f"FN {number}: Q20 = CDATA Q30"
        add_target(cursor, *target_of(cursor, number, example))
        cursor.expect(_CDATA, f"FN {number} needs CDATA", f"for example {example}")
        points, begin = numeric_target(cursor, number, example)
        cursor.add("points", points, begin)

    return read


def preset(cursor: Cursor) -> None:
    """FN 25: PRESET = axis / coordinate that it has / coordinate that it gets."""
    example = "FN 25: PRESET = X/+100/+0"
    hint = f"for example {example}"
    cursor.expect(_PRESET, "FN 25 needs PRESET =", hint)
    axis = cursor.expect(_AXIS, "FN 25 needs an axis", hint)
    cursor.add("axis", axis.group().upper(), axis.start())
    for address in ("first", "second"):
        cursor.expect(SLASH, "/ is missing", hint)
        operand(cursor, address, example)


def system_data(cursor: Cursor, example: str) -> None:
    """ID, NR and, where there are several, IDX."""
    for name, pattern in _SYSTEM:
        begin = cursor.blanks()
        if cursor.match(pattern):
            at = cursor.at
            found = cursor.match(OPERAND)
            if found is None:
                raise Fault(f"{name} needs a number", begin, at - begin)
            cursor.add(name, cursor.expression(found.start(), found.end()), begin)
        elif name != "IDX":
            raise Fault(f"{name} is missing", begin, hint=f"for example {example}")


def system_write(cursor: Cursor) -> None:
    """FN 17: SYSWRITE ID n NR n = value."""
    example = "FN 17: SYSWRITE ID 990 NR 6 = +1"
    if not cursor.match(_WRITE):
        raise Fault("FN 17 needs SYSWRITE", cursor.blanks(), hint=f"for example {example}")
    system_data(cursor, example)
    needs = cursor.blanks()
    if not cursor.match(EQUALS):
        raise Fault("= and a value are missing", needs, hint=f"for example {example}")
    operand(cursor, "value", example)


def system_read(cursor: Cursor) -> None:
    """FN 18: SYSREAD Q1 = ID n NR n IDX n."""
    example = "FN 18: SYSREAD Q25 = ID210 NR4 IDX3"
    if not cursor.match(_READ):
        raise Fault("FN 18 needs SYSREAD", cursor.blanks(), hint=f"for example {example}")
    add_target(cursor, *target_of(cursor, 18, example))
    system_data(cursor, example)


FN: dict[int, Read] = {
    **{number: arithmetic(number) for number in FORMS},
    **{number: pair(number) for number in PAIRS},
    14: error,
    17: system_write,
    18: system_read,
    23: circle_data(23),
    24: circle_data(24),
    25: preset,
}


# How the functions FN that write and read files are written: FN 15, FN 16, FN 26 to FN 28.

_PRINT, _F_PRINT = re.compile(r"[ \t]*PRINT(?![A-Z])", FLAGS), re.compile(r"[ \t]*F[ \t]*-[ \t]*PRINT(?![A-Z])", FLAGS)
_FILE = re.compile("[^/]+")
_OPEN, _WRITE_ROW, _READ_ROW = (re.compile(rf"[ \t]*TAB{word}(?![A-Z])", FLAGS) for word in ("OPEN", "WRITE", "READ"))


def print_values(cursor: Cursor) -> None:
    """FN 15: PRINT numbers and parameters, with / between them."""
    example = "FN 15: PRINT 1/Q1/Q2"
    cursor.expect(_PRINT, "FN 15 needs PRINT", f"for example {example}")
    while True:
        begin = cursor.blanks()
        value = cursor.value()
        if value is None:
            raise Fault("a number or a Q parameter was expected", begin, hint=f"for example {example}")
        cursor.add("item", value, begin)
        if cursor.done:
            return
        cursor.expect(SLASH, "/ was expected between what is put out", f"for example {example}")


def print_formatted(cursor: Cursor) -> None:
    """FN 16: F-PRINT mask / file."""
    hint = "for example FN 16: F-PRINT TNC:\\MASK.A / TNC:\\LOG.TXT"
    cursor.expect(_F_PRINT, "FN 16 needs F-PRINT", hint)
    for address, what in (("mask", "the file with the mask"), ("output", "the file that is written")):
        begin = cursor.blanks()
        found = cursor.expect(_FILE, f"{what} is missing", hint)
        cursor.at = begin + len(found.group().rstrip())
        cursor.add(address, found.group().strip().strip('"').strip(), begin)
        if address == "mask":
            cursor.expect(SLASH, "/ and the file that is written are missing", hint)


def open_table(cursor: Cursor) -> None:
    """FN 26: TABOPEN file."""
    hint = "for example FN 26: TABOPEN TNC:\\TAB1.TAB"
    cursor.expect(_OPEN, "FN 26 needs TABOPEN", hint)
    begin = cursor.blanks()
    name = cursor.rest().strip().strip('"').strip()
    if not name:
        raise Fault("the name of a file is missing", begin, hint=hint)
    cursor.at = begin + len(cursor.rest().rstrip())
    cursor.add("file", name, begin)


def fields(cursor: Cursor, example: str) -> None:
    """A row and its columns: 5/"X,Y"."""
    hint = f"for example {example}"
    operand(cursor, "row", example)
    cursor.expect(SLASH, "/ and the columns are missing", hint)
    begin = cursor.blanks()
    columns = cursor.expect(TEXT, "the columns in quotes are missing", hint).group(1).strip()
    if not columns.replace(",", "").strip():
        raise Fault("the columns in quotes are missing", begin, cursor.at - begin, hint)
    cursor.add("columns", columns, begin)


def several(cursor: Cursor, address: str, hint: str) -> None:
    """The first of the parameters that are read or written."""
    begin = cursor.blanks()
    found = cursor.expect(TARGET, "a Q parameter is missing", hint)
    kind = found.group(1).upper()
    if kind == "C":
        raise Fault("a Q parameter is missing", begin, hint=hint)
    name = f"Q{kind}{int(found.group(2))}"
    if address == "target":
        add_target(cursor, name, begin)
    else:
        cursor.add(address, name, begin)


def write_table(cursor: Cursor) -> None:
    """FN 27: TABWRITE row/"columns" = the first parameter."""
    example = 'FN 27: TABWRITE 5/"X,Y" = Q5'
    cursor.expect(_WRITE_ROW, "FN 27 needs TABWRITE", f"for example {example}")
    fields(cursor, example)
    cursor.expect(EQUALS, "= and a Q parameter are missing", f"for example {example}")
    several(cursor, "source", f"for example {example}")


def read_table(cursor: Cursor) -> None:
    """FN 28: TABREAD the first parameter = row/"columns"."""
    example = 'FN 28: TABREAD Q5 = 5/"X,Y"'
    cursor.expect(_READ_ROW, "FN 28 needs TABREAD", f"for example {example}")
    several(cursor, "target", f"for example {example}")
    cursor.expect(EQUALS, "= and the row are missing", f"for example {example}")
    fields(cursor, example)


FILES: dict[int, Read] = {15: print_values, 16: print_formatted, 26: open_table, 27: write_table, 28: read_table}
