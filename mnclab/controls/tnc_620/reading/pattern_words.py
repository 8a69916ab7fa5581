"""How PATTERN DEF is written: elements such as `ROW1 (X+25 Y+33.5 D+8 NUM5 ROT+0 Z+0)`, over as many lines as one likes.

An element becomes the word of its form with its number (`ROW` 1), its parameters, and the word `)`. A line may end
anywhere between two words, and between an address and its number.
"""

from __future__ import annotations

import re

from mnclab.controls.tnc_620.reading.words import FLAGS, Cursor, Fault
from mnclab.text.program import INCREMENTAL

GRID = ("X", "Y", "DX", "DY", "NUMX", "NUMY", "ROT", "ROTX", "ROTY", "Z")
#: The addresses of each form; of STEP and END of PITCHCIRC one is written.
FORMS: dict[str, tuple[str, ...]] = {
    "POS": ("X", "Y", "Z"), "ROW": ("X", "Y", "D", "NUM", "ROT", "Z"), "PAT": GRID, "FRAME": GRID,
    "CIRC": ("X", "Y", "D", "START", "NUM", "Z"), "PITCHCIRC": ("X", "Y", "D", "START", "STEP", "END", "NUM", "Z"),
}  # fmt: skip
ADDRESSES = tuple(dict.fromkeys(address for form in FORMS.values() for address in form))
CLOSED = ")"

_FORM = re.compile(rf"({'|'.join(sorted(FORMS, key=len, reverse=True))})[ \t]*(\d*)", FLAGS)
_OPEN = re.compile(r"\(")
_CLOSE = re.compile(r"\)")
_NAME = re.compile(r"[A-Z]+", FLAGS)
_ADDRESS = re.compile(rf"(I?)({'|'.join(sorted(ADDRESSES, key=len, reverse=True))})(?![A-PR-Z])", FLAGS)


class PatternWords:
    """Reads the lines of one PATTERN DEF; keeps between two lines what the first one left open."""

    def __init__(self) -> None:
        self.form = ""  # of the element being read
        self.opened = False  # its bracket
        self.pending: tuple[str, int, int] | None = None  # an address without its number: name, offset, flag

    def __call__(self, cursor: Cursor) -> None:
        while not cursor.done:
            begin = cursor.at
            if self.pending:
                self.number(cursor)
            elif not self.form:
                self.head(cursor)
            elif not self.opened:
                cursor.expect(_OPEN, f"{self.form} needs its words in brackets", f"write {self.form}1 (X+… Y+…)")
                self.opened = True
            elif cursor.match(_CLOSE):
                cursor.add(CLOSED, None, begin)
                self.form, self.opened = "", False
            else:
                self.address(cursor)

    def head(self, cursor: Cursor) -> None:
        begin = cursor.at
        what, hint = f"a pattern must be one of {', '.join(FORMS)}", "for example POS1 (X+10 Y+20 Z+0)"
        found = cursor.expect(_FORM, what, hint)
        self.form = found.group(1).upper()
        if not found.group(2):
            raise Fault(f"{self.form} needs its number", begin, len(found.group()), f"write {self.form}1")
        cursor.add(self.form, float(found.group(2)), begin)

    def address(self, cursor: Cursor) -> None:
        """An address inside the brackets, and its number if that stands in the same line."""
        begin = cursor.at
        found = cursor.match(_ADDRESS)
        if found is None:
            name = cursor.match(_NAME)
            if name is None:
                raise cursor.unexpected()
            raise Fault(f"{name.group()} is no word of a pattern", begin, len(name.group()), " ".join(FORMS[self.form]))
        self.pending = found.group(2).upper(), begin, INCREMENTAL if found.group(1) else 0
        if cursor.done:  # completed in the next line, or a word without a number
            cursor.add(self.pending[0], None, begin, self.pending[2])
        else:
            self.number(cursor, same_line=True)

    def number(self, cursor: Cursor, same_line: bool = False) -> None:
        assert self.pending is not None
        address, begin, flag = self.pending
        value = cursor.value()
        if value is None:
            raise Fault(f"{address} needs a number", *((begin, len(address)) if same_line else (cursor.at, 1)))
        self.pending = None
        if not same_line:
            cursor.builder.words.pop()  # the word without a number
        cursor.add(address, value, begin, flag)
