"""How the functions FN that write and read files are written: FN 15, FN 16, FN 26 to FN 28."""

from __future__ import annotations

import re

from mnclab.controls.tnc_620.reading.formulas import EQUALS, SLASH, TARGET, Read, add_target, operand
from mnclab.controls.tnc_620.reading.words import FLAGS, TEXT, Cursor, Fault

_PRINT, _F_PRINT = re.compile(r"[ \t]*PRINT(?![A-Z])", FLAGS), re.compile(r"[ \t]*F[ \t]*-[ \t]*PRINT(?![A-Z])", FLAGS)
_FILE = re.compile("[^/]+")
_OPEN, _WRITE, _READ = (re.compile(rf"[ \t]*TAB{word}(?![A-Z])", FLAGS) for word in ("OPEN", "WRITE", "READ"))


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
    cursor.expect(_WRITE, "FN 27 needs TABWRITE", f"for example {example}")
    fields(cursor, example)
    cursor.expect(EQUALS, "= and a Q parameter are missing", f"for example {example}")
    several(cursor, "source", f"for example {example}")


def read_table(cursor: Cursor) -> None:
    """FN 28: TABREAD the first parameter = row/"columns"."""
    example = 'FN 28: TABREAD Q5 = 5/"X,Y"'
    cursor.expect(_READ, "FN 28 needs TABREAD", f"for example {example}")
    several(cursor, "target", f"for example {example}")
    cursor.expect(EQUALS, "= and the row are missing", f"for example {example}")
    fields(cursor, example)


FILES: dict[int, Read] = {15: print_values, 16: print_formatted, 26: open_table, 27: write_table, 28: read_table}
