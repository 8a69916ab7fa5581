"""What a control says of its texts: signs that tell them from others, numbers of blocks, another notation beside them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import NamedTuple

from mnclab.text.alarm import Alarm
from mnclab.text.tables import html_table

# Signs by which a text is told from others: a pattern, how much it says, and in which words.
# Signs are sought in the code of a program. What stands inside comments is blanked there, since people write about every
# control; the characters that begin and end a comment are left, since these are signs themselves.

FLAGS = re.IGNORECASE | re.MULTILINE
QUOTED = 24  # characters of a finding that are shown
_COMMENTS = re.compile(r"(\(|;|//)(?:(?<=\()[^)\n]*|[^\n]*)")


class Sign(NamedTuple):
    """A pattern, what it weighs each time it is found (less than nothing: it speaks against), and what it is.

    It counts `most` times at most. In `whole` texts comments are not blanked.
    """

    pattern: re.Pattern[str]
    weight: float
    says: str
    most: int = 1
    whole: bool = False


class Finding(NamedTuple):
    """What a sign was found to weigh in a text, and where first: line (from 1), and the characters there."""

    weight: float
    says: str
    line: int
    text: str

    def __str__(self) -> str:
        return f"{self.says} (line {self.line}: {self.text})" if self.text else self.says


def sign(pattern: str, weight: float, says: str, most: int = 1, *, whole: bool = False) -> Sign:
    """A sign whose pattern has ^ and $ at the ends of lines, and letters of either case."""
    return Sign(re.compile(pattern, FLAGS), weight, says, most, whole)


def code_of(text: str) -> str:
    """A text of the same length whose comments are blank."""
    return _COMMENTS.sub(lambda match: match[1].ljust(len(match[0])), text)


def found(signs: Iterable[Sign], text: str, code: str) -> list[Finding]:
    """The signs that a text has; `code` is its `code_of`."""
    findings = []
    for each in signs:
        where, count, first = text if each.whole else code, 0, None
        for match in each.pattern.finditer(where):
            first, count = first or match, count + 1
            if count == each.most:
                break
        if first is not None:
            shown = " ".join(first[0].split())
            line = text.count("\n", 0, first.start() + len(first[0]) - len(first[0].lstrip())) + 1
            short = shown if len(shown) <= QUOTED else shown[: QUOTED - 1] + "…"
            findings.append(Finding(each.weight * count, each.says, line, short))
    return findings


# Numbers of blocks written anew: each in its place, and those that name them follow; nothing else of a text changes.

class Numbered(NamedTuple):
    """The digits of the number of a block: where they stand, and which they are; `length` 0 where they are to be put in.

    `counted` blocks after it have no number, and are counted on from it.
    """

    offset: int
    length: int
    old: str
    counted: int = 0


class Reference(NamedTuple):
    """Digits that name blocks. Each target is an index into the numbered blocks (-1: the beginning, which counts from 0),
    and how many to count on from there; `write` makes the digits of the new numbers."""

    offset: int
    length: int
    targets: tuple[tuple[int, int], ...]
    write: Callable[[Sequence[int]], str]


class Numbers(NamedTuple):
    """The numbers of a program and what names them; the first number and the step where the user says none.

    `before` blocks at the beginning have no number and are counted from 0.
    """

    blocks: Sequence[Numbered]
    references: Sequence[Reference] = ()
    first: int = 10
    step: int = 10
    before: int = 0


def renumbered(text: str, numbers: Numbers, first: int, step: int) -> str:
    """The text with new numbers: `first`, and so many more each time; over those that are counted a step is left out."""
    new: list[int] = []
    number = first
    while number < numbers.before:
        number += step
    for block in numbers.blocks:
        new.append(number)
        number += step * max(1, -(-(block.counted + 1) // step))
    changes = [(one.offset, one.length, _digits(one, value)) for one, value in zip(numbers.blocks, new, strict=True)]
    for reference in numbers.references:
        values = [(new[index] if index >= 0 else 0) + more for index, more in reference.targets]
        changes.append((reference.offset, reference.length, reference.write(values)))
    parts, at = [], 0
    for offset, length, digits in sorted(changes):
        parts += [text[at:offset], digits]
        at = offset + length
    return "".join([*parts, text[at:]])


def _digits(one: Numbered, value: int) -> str:
    """As wide as before where it was filled with zeros."""
    if not one.length:
        return f"{value} "
    return str(value).zfill(one.length) if one.old.startswith("0") and one.length > 1 else str(value)


def one_number(values: Sequence[int]) -> str:
    """The digits of a reference to one block."""
    return str(values[0])


def unknown(what: str, number: object) -> Alarm:
    """The Alarm about a number that names no block: after renumbering it could name one by chance."""
    hint = "correct it first: after renumbering it could name another block by chance"
    return Alarm(f"{what} names block {number}, which does not exist", hint=hint)


# A program beside itself in another notation: a row for each line, two columns, as text and as HTML.

SHOWN = 200  # lines of a long program that HTML has


class NotationRow(NamedTuple):
    """A line of the program (0: before the first), its text, and what it says in the other notation.

    A command of several lines is told at its first; `lines` is how many it takes, 0 for those after the first.
    """

    line: int
    original: str
    modern: str
    lines: int = 1


class Notation:
    """A program in two columns; `rows` has them one by one, `modern` is the right column alone."""

    def __init__(
        self, rows: tuple[NotationRow, ...], name: str, titles: tuple[str, str] = ("program", "modern")
    ) -> None:
        self.rows, self.name, self.titles = rows, name, titles

    @property
    def modern(self) -> str:
        """The text of the right column, without the lines where it says nothing."""
        return "\n".join(row.modern for row in self.rows if row.modern)

    def __str__(self) -> str:
        told = [row.original for row in self.rows if row.modern or not row.lines]  # a remark alone may be wider
        wide = max(map(len, [self.titles[0], *told]))
        lines = [f"{self.titles[0]:{wide}}  {self.titles[1]}", f"{'-' * wide}  {'-' * len(self.titles[1])}"]
        return "\n".join([*lines, *(f"{row.original:{wide}}  {row.modern}".rstrip() for row in self.rows)])

    __repr__ = __str__

    def _repr_html_(self) -> str:
        rows = [(str(row.line or ""), row.original, row.modern if row.lines else None) for row in self.rows[:SHOWN]]
        more = f"<p>… {len(self.rows) - SHOWN} more lines</p>" if len(self.rows) > SHOWN else ""
        return html_table(("line", *self.titles), rows, code=(1, 2)) + more
