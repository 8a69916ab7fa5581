"""Statements of Macro B: `#1=2`, `IF [#1 EQ 2] GOTO 10`, `IF [#1 LT 0] THEN #1=0`, `WHILE [#1 LT 5] DO 1` … `END 1`.

They become blocks with a keyword; their words are `condition`, `target`, `value`, `message`, `GOTO`, and for loops `DO`, the
block that they begin with, and `END`, the one after them.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import NamedTuple

from mnclab.controls.g43.reading import formulas
from mnclab.text.program import ProgramBuilder

HEAD = re.compile(r"#|(?:IF|WHILE|GOTO|DO|END|THEN|ELSE)(?![A-Z])", re.IGNORECASE)
_NUMBER = re.compile(r"[ \t]*(\d{1,9}(?:\.0*)?)(?![.\d])")
_VARIABLE = re.compile(r"#[ \t]*(?:\d{1,9}|<_(?:hal|ini)\[[^<>#]{0,80}>|<[^<>\[\]#]{0,80}>)", re.IGNORECASE)
_SIGNS = re.compile(r"[-+ \t]*")
_SENDER = "a line for Grbl or TinyG itself, no block: leave it out"
_COMMENT, _FORMULA = "a comment stands in round brackets", "a formula stands in square brackets behind its letter: F[1000*60]"
#: What to write in place of characters that mean nothing where they stand.
HINTS = {
    "$": _SENDER, "?": _SENDER, "*": _FORMULA, "=": f"{_FORMULA}; a variable is #101=5", "[": f"{_COMMENT}, {_FORMULA}",
    "/": f"{_COMMENT}, block skip at the beginning",
}  # fmt: skip
_WORD = {word: re.compile(rf"[ \t]*{word}", re.IGNORECASE) for word in ("THEN", "GOTO", "DO", "=")}
_OPERATOR = re.compile(
    rf"(?:{'|'.join(sorted(formulas.NAMES, reverse=True))}|MOD|AND|XOR|OR|EQ|NE|GT|GE|LT|LE)(?=[ \t]*[-+\[#\d.])", re.IGNORECASE
)
DEEPEST = 3  # loops inside each other
MESSAGES = ("#3000", "#3006")  # what is written to them stands in the comment of the block


class Fault(Exception):
    """What is wrong with a line, from one character of it on."""

    def __init__(self, message: str, at: int, length: int = 1, hint: str = "") -> None:
        super().__init__(message)
        self.message, self.at, self.length, self.hint = message, at, length, hint


class _Loop(NamedTuple):
    """A DO that waits for its END: its number, where it stands and how long it is written, the label of its block."""

    number: int
    at: int
    length: int
    label: str


@dataclass
class Statements:
    """The statements of a program, of which loops belong together."""

    builder: ProgramBuilder
    loops: list[_Loop] = field(default_factory=list)
    jumps: bool = False  # whether a block is gone to
    last: int = -1  # where the block begins that a label needs after it

    def read(self, line: str, begin: int, at: int, message: str) -> None:
        """A statement in a line whose comments are blanks; the line begins at `begin` of the text, the statement at `at`."""
        _Line(self, line, begin, at, message).statement()

    def close(self) -> None:
        """No loop may be open where a program ends."""
        for loop in self.loops:
            self.builder.alarm(f"DO {loop.number} has no END {loop.number}", loop.at, loop.length)
        self.loops.clear()


def end_of_operand(line: str, at: int) -> int:
    """Where an operand ends that begins with signs, '#' or '['; -1 where there is none."""
    found = _SIGNS.match(line, at)
    at = found.end() if found else at
    while line[at : at + 1] == "#":
        if variable := _VARIABLE.match(line, at):
            return variable.end()
        at += 1
        at += len(line[at:]) - len(line[at:].lstrip(" \t"))
    if line[at : at + 1] != "[":
        return -1
    depth = 0
    for k in range(at, len(line)):
        depth += (line[k] == "[") - (line[k] == "]")
        if depth == 0:
            return k + 1
    return len(line)


def assignments(line: str, at: int) -> list[tuple[int, int]]:
    """Where the assignments of a line begin and end, from a place on; a word ends the value before it."""
    spans = []
    while (equals := line.find("=", at)) >= 0:
        targets = (k for k in range(at, equals) if line[k] == "#" and line[end_of_operand(line, k) : equals].strip() == "")
        if (begin := next(targets, -1)) < 0:
            break
        at = equals + 1
        while at < len(line) and not _is_target(line, at):
            if line[at] in "#[":
                at = max(end_of_operand(line, at), at + 1)
            elif line[at].isalpha() and (name := _OPERATOR.match(line, at)) is None:
                break
            else:
                at = name.end() if line[at].isalpha() and name else at + 1
        spans.append((begin, len(line[:at].rstrip())))
    return spans


def _is_target(line: str, at: int) -> bool:
    end = end_of_operand(line, at) if line[at] == "#" else -1
    return end >= 0 and line[end:].lstrip(" \t")[:1] == "="


class _Line:
    """A place in a line."""

    def __init__(self, statements: Statements, line: str, begin: int, at: int, message: str) -> None:
        self.all, self.builder, self.line = statements, statements.builder, line.rstrip()
        self.begin, self.at, self.message = begin, at, message

    def statement(self) -> None:
        head = HEAD.match(self.line, self.at)
        assert head is not None
        keyword = head.group().upper()
        if keyword == "#":
            self.assignments()
            return
        self.at = head.end()
        if keyword in ("THEN", "ELSE"):
            raise Fault(f"{keyword} has no IF before it", head.start(), len(keyword))
        if keyword == "IF":
            self.condition("IF")
            if self.skip("THEN"):
                self.assignments()
                return
            if not self.skip("GOTO"):
                raise self.expected("GOTO or THEN")
            self.go_to()
        elif keyword == "GOTO":
            self.go_to()
        elif keyword == "WHILE":
            self.condition("WHILE")
            if not self.skip("DO"):
                raise self.expected("DO")
            self.begin_loop(head.start())
        elif keyword == "DO":
            self.begin_loop(head.start())
        else:
            self.end_loop(head.start())
        self.done()

    def skip(self, word: str) -> bool:
        found = _WORD[word].match(self.line, self.at)
        self.at = found.end() if found else self.at
        return found is not None

    def expected(self, what: str) -> Fault:
        rest = self.line[self.at :].lstrip(" \t")
        place = len(self.line) - len(rest)
        return Fault(f"{what} was expected" + (f", found {rest[:1]!r}" if rest else ""), place)

    def done(self) -> None:
        if self.at < len(self.line):
            rest = self.line[self.at :].lstrip(" \t")
            raise Fault(f"{rest[:1]!r} is too much in this statement", len(self.line) - len(rest), hint="write two blocks")

    def add(self, address: str, value: object, at: int) -> None:
        self.builder.word(address, value, self.begin + at, self.at - at)

    def formula(self, at: int, stop: int) -> formulas.Formula:
        return formulas.parse(self.line[at:stop], self.builder.span(self.begin + at))

    def blanks(self) -> int:
        while self.line[self.at : self.at + 1] in (" ", "\t"):
            self.at += 1
        return self.at

    def condition(self, word: str) -> None:
        at = self.blanks()
        if self.line[at : at + 1] != "[":
            raise Fault(f"{word} needs a condition in brackets", at, hint=f"for example {word} [#1 EQ 2]")
        self.at = end_of_operand(self.line, at)
        self.add("condition", self.formula(at, self.at), at)

    def go_to(self) -> None:
        at = self.blanks()
        if number := _NUMBER.match(self.line, at):
            self.at = number.end()
            self.add("GOTO", float(number.group(1)), at)
        elif (end := end_of_operand(self.line, at)) > 0:
            self.at = end
            self.add("GOTO", self.formula(at, end), at)
        else:
            raise Fault("GOTO needs the number of a block", at, hint="for example GOTO 10 or GOTO #1")
        self.all.jumps = True
        self.done()

    def assignments(self) -> None:
        """One or several, of which none reads what another of them writes: makers do not agree on what it would read."""
        written: set[str] = set()
        while True:
            at = self.blanks()
            end = end_of_operand(self.line, at)
            if self.line[at : at + 1] != "#" or end < 0:
                raise Fault("a variable was expected", at, hint="for example #101=2.5")
            self.at = end
            target = self.formula(at, end)
            self.add("target", target, at)
            if not self.skip("="):
                raise self.expected("'='")
            at = self.blanks()
            stop = self.next_target(at)
            if stop <= at:
                raise Fault("a value was expected", at, hint="a number, a variable or a function of this control: SQRT[#1]")
            value = self.formula(at, stop)
            self.at = at + len(self.line[at:stop].rstrip())
            self.add("value", value, at)
            reads = [token for token in (*target.tokens[1:], *value.tokens) if token.kind == "variable"]
            again = next((t for t in reads if t.text in written or "" in written or (written and not t.text)), None)
            if again:
                place = again.span.column - self.builder.span(self.begin).column
                raise Fault(f"{again.text or '#'} is read and written in one block", place, hint="write two blocks")
            written.add(target.tokens[0].text)
            if target.text.replace(" ", "") in MESSAGES and self.message:
                self.add("message", self.message, at)
            if stop == len(self.line):
                return
            self.at = stop

    def next_target(self, at: int) -> int:
        """Where the next assignment of the line begins, or its end."""
        equals = self.line.find("=", at)
        place = self.line.find("#", at, max(equals, at))
        while place >= 0:
            if self.line[end_of_operand(self.line, place) : equals].strip(" \t") == "":
                return place
            place = self.line.find("#", place + 1, equals)
        return len(self.line)

    # --- loops -------------------------------------------------------------------------------------------------------

    def number(self, word: str, begin: int) -> int:
        number = _NUMBER.match(self.line, self.at)
        if number is None or not 1 <= float(number.group(1)) <= DEEPEST:
            raise Fault(f"{word} needs a number from 1 to {DEEPEST}", begin, max(len(self.line[begin:]), 1))
        self.at = number.end()
        return int(float(number.group(1)))

    def begin_loop(self, begin: int) -> None:
        number, loops = self.number("DO", begin), self.all.loops
        line = self.builder.span(self.begin).line
        label = f"DO {number} in line {line}"
        again = any(loop.number == number for loop in loops)
        loops.append(_Loop(number, self.begin + begin, self.at - begin, label))
        if again:
            hint = "loops inside each other have numbers of their own"
            raise Fault(f"DO {number} stands inside DO {number}", begin, self.at - begin, hint)
        self.builder.labels[label] = self.builder.blocks[-1][0]
        self.add("END", f"after {label}", begin)

    def end_loop(self, begin: int) -> None:
        number, loops = self.number("END", begin), self.all.loops
        if not loops or loops[-1].number != number:
            inner = f": DO {loops[-1].number} is open" if loops else ""
            raise Fault(f"END {number} has no DO {number} before it{inner}", begin, self.at - begin)
        label = loops.pop().label
        self.add("DO", label, begin)
        self.all.last = self.builder.blocks[-1][0]
        self.builder.labels[f"after {label}"] = self.all.last + 1
