"""O words of LinuxCNC: `O<slot> sub` … `O<slot> endsub`, `call`, `return`, `if`, `while`, `do`, `repeat`, `break`, `continue`.

They become blocks with a keyword. Where one goes on at another block, its word `END`, `DO` or `ELSE` holds the label of that
block. `elseif` and `else` are two blocks: what was obeyed before them leads past `endif` by the first, and a condition that
did not hold to the second.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from mnclab.controls.g43.reading import formulas
from mnclab.controls.g43.reading.statements import Fault, end_of_operand
from mnclab.text.alarm import hint
from mnclab.text.program import ProgramBuilder

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
            raise Fault(f"{keyword.group(1)} is no O word", place, length, hint(kind, KEYWORDS) or meant)
        if computed and kind != "call":
            raise Fault(
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
            raise Fault(
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
            raise Fault(f"{kind} needs a value in brackets", at, hint=f"for example {kind} [#1 LT 5]")
        end = end_of_operand(line, at)
        self.word(address, formulas.parse(line[at:end], self.builder.span(begin + at)), begin + at, end - at)
        return end

    # --- what belongs together ---------------------------------------------------------------------------------------

    def open(self, kind: str, name: str, at: int, length: int) -> None:
        one = _Open(name, kind, at, length, f"O{name} {kind} in line {self.builder.span(at).line}")
        if kind == "sub":
            one.label = f"O{name} sub"
            if self.opened:
                raise Fault(f"O{name} sub stands inside {self.opened[-1]}", at - self.line_start(at), length)
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
            raise Fault(f"O{name} {word} has no O{name} {kind} before it{inner}", at, length)
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
            raise Fault(f"O{name} {kind} stands behind else", at, place + len(kind) - at)
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
            raise Fault(f"O{name} {kind} stands in no {' or '.join(fitting)} of this name", at, end - at)
        to = ("DO", f"{one.label} again") if kind == "continue" else ("END", f"after {one.label}")
        self.word(*to, self.builder.blocks[-1][0], end - at)

    def inside(self, name: str, at: int, end: int) -> None:
        """A return is that of the sub it stands in, whatever its own name, which is often that of an if."""
        if not self.opened or self.opened[0].kind != "sub":
            raise Fault(f"O{name} return stands outside O{name} sub", at, end - at)

    def close(self) -> None:
        """Nothing may be open where a program ends."""
        for one in self.opened:
            end = LOOPS.get(one.kind, f"end{one.kind}")
            self.builder.alarm(f"{one} has no O{one.name} {end}", one.at, one.length)
        self.opened.clear()
