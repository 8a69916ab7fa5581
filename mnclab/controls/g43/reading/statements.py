"""Statements of Macro B: `#1=2`, `IF [#1 EQ 2] GOTO 10`, `IF [#1 LT 0] THEN #1=0`, `WHILE [#1 LT 5] DO 1` … `END 1`.

They become blocks with a keyword; their words are `condition`, `target`, `value`, `message`, `GOTO`, and for loops `DO`, the
block that they begin with, and `END`, the one after them.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import NamedTuple

from mnclab.controls.g43.reading import formulas
from mnclab.text.alarm import hint
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


class LineFault(Exception):
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
            raise LineFault(f"{keyword} has no IF before it", head.start(), len(keyword))
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

    def expected(self, what: str) -> LineFault:
        rest = self.line[self.at :].lstrip(" \t")
        place = len(self.line) - len(rest)
        return LineFault(f"{what} was expected" + (f", found {rest[:1]!r}" if rest else ""), place)

    def done(self) -> None:
        if self.at < len(self.line):
            rest = self.line[self.at :].lstrip(" \t")
            raise LineFault(f"{rest[:1]!r} is too much in this statement", len(self.line) - len(rest), hint="write two blocks")

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
            raise LineFault(f"{word} needs a condition in brackets", at, hint=f"for example {word} [#1 EQ 2]")
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
            raise LineFault("GOTO needs the number of a block", at, hint="for example GOTO 10 or GOTO #1")
        self.all.jumps = True
        self.done()

    def assignments(self) -> None:
        """One or several, of which none reads what another of them writes: makers do not agree on what it would read."""
        written: set[str] = set()
        while True:
            at = self.blanks()
            end = end_of_operand(self.line, at)
            if self.line[at : at + 1] != "#" or end < 0:
                raise LineFault("a variable was expected", at, hint="for example #101=2.5")
            self.at = end
            target = self.formula(at, end)
            self.add("target", target, at)
            if not self.skip("="):
                raise self.expected("'='")
            at = self.blanks()
            stop = self.next_target(at)
            if stop <= at:
                raise LineFault("a value was expected", at, hint="a number, a variable or a function of this control: SQRT[#1]")
            value = self.formula(at, stop)
            self.at = at + len(self.line[at:stop].rstrip())
            self.add("value", value, at)
            reads = [token for token in (*target.tokens[1:], *value.tokens) if token.kind == "variable"]
            again = next((t for t in reads if t.text in written or "" in written or (written and not t.text)), None)
            if again:
                place = again.span.column - self.builder.span(self.begin).column
                raise LineFault(f"{again.text or '#'} is read and written in one block", place, hint="write two blocks")
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
            raise LineFault(f"{word} needs a number from 1 to {DEEPEST}", begin, max(len(self.line[begin:]), 1))
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
            raise LineFault(f"DO {number} stands inside DO {number}", begin, self.at - begin, hint)
        self.builder.labels[label] = self.builder.blocks[-1][0]
        self.add("END", f"after {label}", begin)

    def end_loop(self, begin: int) -> None:
        number, loops = self.number("END", begin), self.all.loops
        if not loops or loops[-1].number != number:
            inner = f": DO {loops[-1].number} is open" if loops else ""
            raise LineFault(f"END {number} has no DO {number} before it{inner}", begin, self.at - begin)
        label = loops.pop().label
        self.add("DO", label, begin)
        self.all.last = self.builder.blocks[-1][0]
        self.builder.labels[f"after {label}"] = self.all.last + 1


# O words of LinuxCNC: `O<slot> sub` … `O<slot> endsub`, `call`, `return`, `if`, `while`, `do`, `repeat`, `break`, `continue`.
# They become blocks with a keyword. Where one goes on at another block, its word `END`, `DO` or `ELSE` holds the label of that
# block. `elseif` and `else` are two blocks: what was obeyed before them leads past `endif` by the first, and a condition that
# did not hold to the second.

O_WORD = re.compile(r"O[ \t]*(\d+|<[^<>]{0,80}>|(?=[\[#]))", re.IGNORECASE)
_KEYWORD = re.compile(  # blanks mean nothing: `else if` is elseif
    r"(END[ \t]+(?:SUB|IF|WHILE|REPEAT)\b|ELSE[ \t]+IF\b|[A-Z]{2,})[ \t]*", re.IGNORECASE
)
LOOPS = {"while": "endwhile", "do": "while", "repeat": "endrepeat"}
CLOSES = {"endsub": "sub", "endif": "if", "endwhile": "while", "endrepeat": "repeat"}
KEYWORDS = ("sub", "call", "return", "if", "elseif", "else", *LOOPS, "break", "continue", *CLOSES)
CONDITIONS = ("if", "elseif", "while", "repeat")


def spelled(name: str) -> str:
    """A name as it is compared: without blanks and brackets, in small letters, a number without zeros before it."""
    bare = re.sub(r"[<>\s]", "", name).lower()
    return str(int(bare)) if bare.isdecimal() else bare


@dataclass
class _Open:
    """What waits for its end: its name and kind, where it stands and how long it is written, the label of its block."""

    name: str
    kind: str
    at: int
    length: int
    label: str
    branches: int = 1  # of an if, the one that is sought next; 0 after else

    def __str__(self) -> str:
        return f"O{self.name} {self.kind}"


@dataclass
class OWords:
    """The O words of a program, of which many belong together."""

    builder: ProgramBuilder
    opened: list[_Open] = field(default_factory=list)
    last: int = -1  # where the block begins that a label needs after it

    def read(self, line: str, begin: int, at: int, start: int, skip: int) -> bool:
        """The O word at `at` of a line that begins at `begin` of the text, its block at `start`; False if it is none."""
        name = O_WORD.match(line, at)
        end = end_of_operand(line, name.end()) if name and not name.group(1) else name.end() if name else -1
        blanks = len(line[end:]) - len(line[end:].lstrip(" \t"))
        keyword = _KEYWORD.match(line, end + blanks) if name and end >= 0 else None
        if name is None or keyword is None:
            return False
        line, kind, computed = line.rstrip(), re.sub(r"[ \t]", "", keyword.group(1)).lower(), not name.group(1)
        place, length = keyword.start(1), len(keyword.group(1))
        if kind not in KEYWORDS or computed and kind != "call":
            self.block(start, "", skip)
        if kind not in KEYWORDS:
            meant = next((f"write {word}" for word in KEYWORDS if kind.startswith(word)), "")
            raise LineFault(f"{keyword.group(1)} is no O word", place, length, hint(kind, KEYWORDS) or meant)
        if computed and kind != "call":
            raise LineFault(
                f"only a call may work out the name of {kind}", at, place + length - at, "write a number or O<name>"
            )
        own = "" if computed else spelled(name.group(1))
        closes = kind == "while" and any(o.name == own and o.kind == "do" for o in self.opened[-1:])
        self.block(start, "O LOOP" if closes else "O SKIP" if kind in ("else", "elseif") else f"O {kind.upper()}", skip)
        whole = (own, begin + at, len(line[at : place + length]))
        if kind in ("sub", "if", *LOOPS) and not closes:
            self.open(kind, *whole)
        elif closes or kind in CLOSES:
            self.close_one("do" if closes else CLOSES[kind], kind, own, at, place + length - at)
        elif kind in ("else", "elseif"):
            self.branch(kind, own, at, place, begin, skip)
        elif kind in ("break", "continue"):
            self.leave(kind, own, at, place + length)
        elif kind == "return":
            self.inside(own, at, place + length)
        at = keyword.end()
        if kind in CONDITIONS:
            at = self.formula(line, begin, at, "condition", kind)
        elif kind in ("return", "endsub") and line[at : at + 1] == "[":
            at = self.formula(line, begin, at, "value", kind)
        elif kind == "call":
            if computed:
                self.word(
                    "name", formulas.parse(line[name.end() : end], self.builder.span(begin + name.end())), *whole[1:]
                )
            else:
                self.word("name", own, *whole[1:])
            while line[at : at + 1] == "[":
                at = self.formula(line, begin, at, "argument", kind)
                at += len(line[at:]) - len(line[at:].lstrip(" \t"))
        if line[at:].strip():
            rest = line[at:].lstrip(" \t")
            raise LineFault(
                f"{rest[:1]!r} is too much behind {kind}", len(line) - len(rest), hint="a value stands in brackets"
            )
        self.last = self.builder.blocks[-1][0]
        return True

    def block(self, start: int, keyword: str, skip: int) -> None:
        self.builder.block(start, keyword, skip)

    def word(self, address: str, value: object, at: int, length: int) -> None:
        self.builder.word(address, value, at, length)

    def label(self, name: str, after: bool = False) -> None:
        """A label at the block begun last, or at the one after it."""
        self.builder.labels[name] = self.builder.blocks[-1][0] + after

    def formula(self, line: str, begin: int, at: int, address: str, kind: str) -> int:
        if line[at : at + 1] != "[":
            raise LineFault(f"{kind} needs a value in brackets", at, hint=f"for example {kind} [#1 LT 5]")
        end = end_of_operand(line, at)
        self.word(address, formulas.parse(line[at:end], self.builder.span(begin + at)), begin + at, end - at)
        return end

    # --- what belongs together ---------------------------------------------------------------------------------------

    def open(self, kind: str, name: str, at: int, length: int) -> None:
        one = _Open(name, kind, at, length, f"O{name} {kind} in line {self.builder.span(at).line}")
        if kind == "sub":
            one.label = f"O{name} sub"
            if self.opened:
                raise LineFault(f"O{name} sub stands inside {self.opened[-1]}", at - self.line_start(at), length)
            if one.label in self.builder.labels:
                self.builder.alarm(f"O{name} sub stands twice", at, length, "a name is that of one subprogram")
        self.opened.append(one)
        self.label(one.label)
        self.word("END", f"after {one.label}", at, length)
        if kind == "if":
            self.word("ELSE", f"{one.label} branch 1", at, length)

    def line_start(self, at: int) -> int:
        return int(self.builder.line_starts[self.builder.span(at).line - 1])

    def innermost(self, kind: str, word: str, name: str, at: int, length: int) -> _Open:
        """The one opened last, which must be of a kind and a name."""
        if not self.opened or (self.opened[-1].kind, self.opened[-1].name) != (kind, name):
            inner = f": {self.opened[-1]} is open" if self.opened else ""
            raise LineFault(f"O{name} {word} has no O{name} {kind} before it{inner}", at, length)
        return self.opened[-1]

    def close_one(self, kind: str, word: str, name: str, at: int, length: int) -> None:
        one = self.innermost(kind, word, name, at, length)
        self.opened.pop()
        place = self.builder.blocks[-1][0]
        if kind == "if":
            if one.branches:
                self.label(f"{one.label} branch {one.branches}")
            self.label(f"after {one.label}")
            return
        if kind in LOOPS:
            self.label(f"{one.label} again") if kind == "do" else self.builder.labels.setdefault(
                f"{one.label} again", self.builder.labels[one.label]
            )
            self.word("DO", one.label, place, length)
        self.label(f"after {one.label}", after=True)

    def branch(self, kind: str, name: str, at: int, place: int, begin: int, skip: int) -> None:
        one = self.innermost("if", kind, name, at, place + len(kind) - at)
        if not one.branches:
            raise LineFault(f"O{name} {kind} stands behind else", at, place + len(kind) - at)
        where = begin + place
        self.word("END", f"after {one.label}", begin + at, place + len(kind) - at)
        self.block(where, "O IF" if kind == "elseif" else "O ELSE", skip)
        self.label(f"{one.label} branch {one.branches}")
        one.branches = one.branches + 1 if kind == "elseif" else 0
        if kind == "elseif":
            self.word("END", f"after {one.label}", where, len(kind))
            self.word("ELSE", f"{one.label} branch {one.branches}", where, len(kind))

    def leave(self, kind: str, name: str, at: int, end: int) -> None:
        fitting = ("while", "do") if kind == "continue" else tuple(LOOPS)
        one = next((o for o in reversed(self.opened) if o.name == name and o.kind in fitting), None)
        if one is None:
            raise LineFault(f"O{name} {kind} stands in no {' or '.join(fitting)} of this name", at, end - at)
        to = ("DO", f"{one.label} again") if kind == "continue" else ("END", f"after {one.label}")
        self.word(*to, self.builder.blocks[-1][0], end - at)

    def inside(self, name: str, at: int, end: int) -> None:
        """A return is that of the sub it stands in, whatever its own name, which is often that of an if."""
        if not self.opened or self.opened[0].kind != "sub":
            raise LineFault(f"O{name} return stands outside O{name} sub", at, end - at)

    def close(self) -> None:
        """Nothing may be open where a program ends."""
        for one in self.opened:
            end = LOOPS.get(one.kind, f"end{one.kind}")
            self.builder.alarm(f"{one} has no O{one.name} {end}", one.at, one.length)
        self.opened.clear()
