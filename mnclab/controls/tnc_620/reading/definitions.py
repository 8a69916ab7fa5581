"""How contours and patterns are defined: SEL CONTOUR, DECLARE CONTOUR, QC10 = …, CONTOUR DEF, PATTERN DEF."""

from __future__ import annotations

import re

from mnclab.controls.tnc_620.reading.labels import label
from mnclab.controls.tnc_620.reading.words import FLAGS, TEXT, Cursor, Fault
from mnclab.text import strings
from mnclab.text.program import INCREMENTAL

# How contours are defined by formulas: SEL CONTOUR, DECLARE CONTOUR, QC10 = …, CONTOUR DEF (chapter 10).
# A part is a program by its name (`file`), or a label of this one (`label`); `DEPTH` is its own depth. A formula becomes the
# words `QC` with their numbers, and its operators and brackets as words of their own, each with its place. `|+|`, as later
# versions of the control write it, is `^`.

JOINS = ("&", "|", "^", "\\")
OPEN, CLOSED = "(", ")"
PROGRAM_OR_LABEL = "the name of a program, or LBL and a label"

_QC = re.compile(r"QC[ \t]?(\d{1,4})(?!\d)", FLAGS)
_EQUALS = re.compile(r"[ \t]*=", FLAGS)
_LABEL = re.compile(r"LBL(?![A-Z])", FLAGS)
_TEXT_PARAMETER = re.compile(r"QS[ \t]?\d{1,6}(?!\d)", FLAGS)
_BARE = re.compile(r"(?!DEPTH[ \t]*+[\d.,+Q-])[^\s\"=]++", FLAGS)
_DEPTH = re.compile(r"DEPTH(?![A-PR-Z])", FLAGS)
_PART = re.compile(r"([PI])[ \t]?(\d{1,3})(?!\d)", FLAGS)
_JOIN = re.compile(r"\|\+\||[&|^\\]")
_BRACKET = re.compile(r"[()]")
_SUM = re.compile(r"[+*]")
_MEANT = {"*": "&", "+": "|"}
_FORMULA = "for example QC10 = ( QC1 | QC2 ) \\ QC3"


def selected(cursor: Cursor) -> None:
    """SEL CONTOUR: the name of the program with the definitions."""
    described_by(cursor, "SEL CONTOUR", "the name of a program", 'for example SEL CONTOUR "MODEL"', labels=False)


class DeclaredWords:
    """Reads the lines of one DECLARE CONTOUR: a designator, what describes its contour, perhaps its own depth."""

    def __init__(self) -> None:
        self.waits = "designator"

    def __call__(self, cursor: Cursor) -> None:
        hint = 'for example DECLARE CONTOUR QC1 = "CIRCLE" DEPTH5'
        while not cursor.done:
            match self.waits:
                case "designator":
                    found = cursor.expect(_QC, "DECLARE CONTOUR needs a designator QC and its number", hint)
                    cursor.add("target", f"QC{designator(found.group(1), found.start(), len(found.group()))}", found.start())
                    cursor.expect(_EQUALS, "= is missing", hint)
                    self.waits = "contour"
                case "contour":
                    described_by(cursor, "DECLARE CONTOUR", PROGRAM_OR_LABEL, hint)
                    self.waits = "depth"
                case "depth":
                    if not depth(cursor):
                        raise cursor.unexpected()
                    self.waits = ""
                case _:
                    begin = cursor.blanks()
                    if depth(cursor):
                        raise Fault("the depth stands twice", begin, cursor.at - begin, "keep one of them")
                    raise cursor.unexpected()


def designator(number: str, begin: int, length: int) -> int:
    """The number of a designator; a Fault at 0."""
    if not int(number):
        raise Fault("QC0: the designators of contours count from QC1", begin, length)
    return int(number)


def described_by(cursor: Cursor, what: str, needs: str, hint: str, labels: bool = True) -> None:
    """A program by its name, in quotes or in a text parameter, or a label."""
    begin = cursor.blanks()
    if labels and cursor.match(_LABEL):
        label(cursor, parameter=True)
    elif found := cursor.match(TEXT):
        if not found.group(1).strip():
            raise Fault("the name of a program is empty", begin, cursor.at - begin, hint)
        cursor.add("file", found.group(1).strip(), begin)
    elif found := cursor.match(_TEXT_PARAMETER):
        cursor.add("file", strings.parse_text(found.group(), cursor.builder.span(begin)), begin)
    elif found := cursor.match(_BARE):
        cursor.add("file", found.group(), begin)
    else:
        raise Fault(f"{what} needs {needs}", begin, hint=hint)


def depth(cursor: Cursor) -> bool:
    """Takes DEPTH and its number, if that comes next."""
    begin = cursor.blanks()
    if found := cursor.match(_DEPTH):
        value = cursor.needed("DEPTH needs a number", begin, len(found.group()))
        cursor.add("DEPTH", value, begin)
    return found is not None


class PartWords:
    """Reads the lines of one CONTOUR DEF: P1 = "NAME" I2 = LBL 3 DEPTH5 …; a line may end anywhere between two words."""

    def __init__(self) -> None:
        self.open = ""  # the part that waits for what describes it
        self.equals = False

    def __call__(self, cursor: Cursor) -> None:
        hint = 'for example CONTOUR DEF P1 = "POCKET" I2 = "ISLAND" DEPTH5'
        while not cursor.done:
            begin = cursor.at
            if self.open:
                if not self.equals and cursor.match(_EQUALS):
                    self.equals = True
                    continue
                described_by(cursor, self.open, PROGRAM_OR_LABEL, hint)
                self.open, self.equals = "", False
            elif found := cursor.match(_PART):
                self.open = found.group(1).upper() + str(int(found.group(2)))
                cursor.add(found.group(1).upper(), float(found.group(2)), begin)
            elif not depth(cursor):
                raise Fault("a part must begin with P or I and its number", begin, hint=hint)


class FormulaWords:
    """Reads the lines of `QC10 = …`; the target was read already, at `begin`. That it is complete is seen when it is obeyed."""

    def __init__(self, target: int, begin: int, length: int) -> None:
        self.target = (designator(str(target), begin, length), begin, length)
        self.begun = False
        self.operand = True  # whether one comes next, or a bracket before one
        self.opened = 0  # brackets that are not closed yet

    def __call__(self, cursor: Cursor) -> None:
        if not self.begun:
            number, begin, length = self.target
            cursor.builder.word("target", f"QC{number}", begin, length)
            self.begun = True
        while not cursor.done:
            at = cursor.at
            if found := cursor.match(_QC):
                if not self.operand:
                    raise Fault("an operator is missing", at, len(found.group()), f"one of {' '.join(JOINS)}")
                cursor.add("QC", float(designator(found.group(1), at, len(found.group()))), at)
                self.operand = False
            elif found := cursor.match(_JOIN):
                if self.operand:
                    raise Fault("a designator is missing before the operator", at, len(found.group()), _FORMULA)
                cursor.add("^" if found.group() == "|+|" else found.group(), None, at)
                self.operand = True
            elif found := cursor.match(_BRACKET):
                self.bracket(found.group(), at)
                cursor.add(found.group(), None, at)
            elif found := cursor.match(_SUM):
                what = f"{found.group()} joins no contours"
                raise Fault(what, at, 1, f"write {_MEANT[found.group()]}, or another one of {' '.join(JOINS)}")
            else:
                raise Fault("a formula of contours holds QC, operators and brackets", at, hint=_FORMULA)

    def bracket(self, which: str, at: int) -> None:
        if which == OPEN and not self.operand:
            raise Fault("an operator is missing before the bracket", at, hint=f"one of {' '.join(JOINS)}")
        if which == CLOSED and self.opened == 0:
            raise Fault("this bracket was not opened", at)
        if which == CLOSED and self.operand:
            raise Fault("a designator is missing before the bracket", at, hint=_FORMULA)
        self.opened += 1 if which == OPEN else -1


# How PATTERN DEF is written: elements such as `ROW1 (X+25 Y+33.5 D+8 NUM5 ROT+0 Z+0)`, over as many lines as one likes.
# An element becomes the word of its form with its number (`ROW` 1), its parameters, and the word `)`. A line may end
# anywhere between two words, and between an address and its number.

GRID = ("X", "Y", "DX", "DY", "NUMX", "NUMY", "ROT", "ROTX", "ROTY", "Z")
#: The addresses of each form; of STEP and END of PITCHCIRC one is written.
FORMS: dict[str, tuple[str, ...]] = {
    "POS": ("X", "Y", "Z"), "ROW": ("X", "Y", "D", "NUM", "ROT", "Z"), "PAT": GRID, "FRAME": GRID,
    "CIRC": ("X", "Y", "D", "START", "NUM", "Z"), "PITCHCIRC": ("X", "Y", "D", "START", "STEP", "END", "NUM", "Z"),
}  # fmt: skip
ADDRESSES = tuple(dict.fromkeys(address for form in FORMS.values() for address in form))
CLOSING = ")"

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
                cursor.add(CLOSING, None, begin)
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
            where, length = (begin, len(address)) if same_line else (cursor.at, 1)
            raise Fault(f"{address} needs a number", where, length)
        self.pending = None
        if not same_line:
            cursor.builder.words.pop()  # the word without a number
        cursor.add(address, value, begin, flag)
