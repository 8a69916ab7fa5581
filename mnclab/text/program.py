"""A part program as columns: a million blocks are no million objects.

A *word* is an address and a value; a *block* is what a control obeys at once. Words stand in columns of equal length,
blocks point into them, and `program[i]` makes a `Block` for people when asked. Lines and columns of words are
found from their offset in the text, number and comment of a block are cut from the text on demand. Labels of blocks are no
words: a reader checks them and keeps those that are jump targets by their place, so that blocks found in bulk can still
be sorted in.
"""

from __future__ import annotations

import re
from array import array
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import wraps
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.text.alarm import ALARM, Alarm, Alarms, Span, card_html, several
from mnclab.text.columns import merged
from mnclab.text.expression import Expression
from mnclab.text.given import shown
from mnclab.text.tables import fixed, html_table
from mnclab.text.words import characters, line_starts

if TYPE_CHECKING:
    from mnclab.text.strings import NumberFromText, TextFormula


NUMBER, EXPRESSION, TEXT, NONE = range(4)  # column `form`
INCREMENTAL, RAPID_MARK, GROUP_MARK, AT_MARK = 1, 2, 4, 8  # bits of column `flag`; the last: written as @

_NUMBER_OF_BLOCK = re.compile(r"\ufeff*[ \t]*(?:/[ \t]*)?(N[ \t]*\+?\d+|\d+)", re.IGNORECASE)


def digits(value: float) -> str:
    """A number as a programmer writes it: without an exponent, and nothing lost."""
    return np.format_float_positional(value, trim="-")


_LENGTH, _COLUMN, _LINE = 15, 23, 25  # bits of a place


def place_of(line: Any, column: Any, length: Any) -> Any:
    """Line, column and length in one integer, or in one array of them: a long program has millions of places."""
    cut = (np.minimum(part, (1 << bits) - 1) for part, bits in ((line, _LINE), (column, _COLUMN), (length, _LENGTH)))
    line, column, length = (np.asarray(part, dtype=np.int64) for part in cut)
    return (line << _COLUMN | column) << _LENGTH | length


def span_at(line_starts: NDArray[np.int32], offset: int, length: int = 1) -> Span:
    """Line and column of a place in a text."""
    line = int(line_starts.searchsorted(np.int32(offset), "right"))  # another type would copy them all
    return Span(line, offset - int(line_starts[line - 1]) + 1, length)


NO_MEANING = "has no meaning in this block"


class Word(NamedTuple):
    """An address with its value, and where it stands."""

    address: str
    value: float | str | Expression | TextFormula | NumberFromText | None
    place: int
    flag: int = 0

    @property
    def span(self) -> Span:
        above = self.place >> _LENGTH
        return Span(above >> _COLUMN, above & (1 << _COLUMN) - 1, self.place & (1 << _LENGTH) - 1)

    @property
    def incremental(self) -> bool:
        """Whether the word carries the mark of an increment (IX, the @ of the NC-31)."""
        return bool(self.flag & INCREMENTAL)

    def __str__(self) -> str:
        value = self.value
        shown = digits(value) if isinstance(value, float) else getattr(value, "text", value)
        if self.address.islower():  # a value that stands without an address in the text
            return f"{shown}"
        equals = "=" if self.address[:1] == "Q" and self.address[-1].isdigit() else ""
        before, after = ("", "@") if self.flag & AT_MARK else ("I" * self.incremental, "")
        return f"{before}{self.address}{equals}{'' if shown is None else shown}{after}"

    @property
    def rounded(self) -> str:
        """For alarms: without what computing leaves behind the twelfth digit."""
        return str(self._replace(value=float(f"{self.value:.12g}")) if isinstance(self.value, float) else self)

    def untaken(self, code: str = "") -> str:
        """The sentence of an alarm on a word that nothing takes; `code` is what its block has and does not take it."""
        return f"{self.rounded} {NO_MEANING}" + (f" ({code} does not take {self.address})" if code else "")

    def __repr__(self) -> str:
        return f"<Word {self}, line {self.span.line}, column {self.span.column}>"


@dataclass(frozen=True)
class Block:
    """What a control obeys at once: a keyword (conversational controls only) and words."""

    number: str
    keyword: str
    words: tuple[Word, ...]
    comment: str
    skip: int
    """The switch by which it is passed over, 0 for none."""
    span: Span

    def __str__(self) -> str:
        skip = f"/{self.skip if self.skip > 1 else ''}" if self.skip else ""
        head = " ".join(part for part in (skip + self.number, self.keyword) if part)
        return " ".join([head, *map(str, self.words)]).strip()

    def __repr__(self) -> str:
        return f"<Block {self}, line {self.span.line}>"


@dataclass(frozen=True, eq=False)
class Program:
    """Words in columns (w,) and blocks in columns (b,).

    `address` indexes `addresses`; `value` is the number, or for other forms an index into `payload`; `first`
    (b + 1,) says where the words of a block begin. `plain` marks blocks that are textually candidates for bulk work.

    >>> len(mnc.read("N10 G0 X5 Y2\\nN20 M30\\n", "mnc"))
    2
    """

    text: str
    name: str
    control: str
    addresses: tuple[str, ...]
    address: NDArray[np.integer[Any]]
    value: NDArray[np.float64]
    form: NDArray[np.uint8]
    flag: NDArray[np.uint8]
    offset: NDArray[np.int32]
    length: NDArray[np.int16]
    first: NDArray[np.int32]
    keywords: tuple[str, ...]
    keyword: NDArray[np.int16]
    skip: NDArray[np.uint8]
    plain: NDArray[np.bool_]
    start: NDArray[np.int32]
    """Offset of each block in the text."""
    line_starts: NDArray[np.int32]
    payload: tuple[Any, ...] = ()
    alarms: tuple[Alarm, ...] = ()
    untold: tuple[int, ...] | array[int] = ()
    """Places of faults that `alarms` only counts: line * 2**32 + column."""
    comment_mark: str = "//"
    """What a comment begins with, as a regular expression."""
    encoding: str = "utf-8"
    folder: str = ""
    """Where the file lies that the program was read from; empty for a text. Programs that it calls are sought there."""
    labels: Mapping[str, int] = field(default_factory=dict)
    """Block index of each jump target, as the reader of the control found them."""
    said: Callable[[Alarm, Program], Alarm] | None = None
    """Words an alarm of a run anew, for a program that has other names than those of its control's language (DIN/ISO)."""

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if isinstance(value, np.ndarray):
                object.__setattr__(self, name, fixed(value))

    @property
    def title(self) -> str:
        return Path(self.name).name

    def __len__(self) -> int:
        return len(self.keyword)

    def __getitem__(self, index: int) -> Block:
        index = range(len(self))[index]
        comments = (self._parted(line)[1].strip() for line in self._lines_of(index))
        return Block(
            number=self.number_at(int(self.start[index])),
            keyword=self.keywords[self.keyword[index]],
            words=tuple(self.word(i) for i in range(self.first[index], self.first[index + 1])),
            comment=" ".join(comment for comment in comments if comment),
            skip=int(self.skip[index]),
            span=self.span_of_block(index),
        )

    def __iter__(self) -> Iterator[Block]:
        return (self[i] for i in range(len(self)))

    def number_at(self, offset: int) -> str:
        """The number of a block that begins at a place of the text, such as "N40" or "12"; empty without one."""
        number = _NUMBER_OF_BLOCK.match(self.text, offset)
        return re.sub(r"[\s+]", "", number.group(1)).upper() if number else ""

    def number_of(self, line: int) -> str:
        """The number of the block that a line begins with; empty where it is the line of a block begun before."""
        return self.number_at(int(self.line_starts[line - 1])) if 1 <= line <= len(self.line_starts) else ""

    def line_of_number(self, number: int | str) -> int:
        """The first line whose block has a number, 40 or "N40" of N40; an Alarm where none has."""
        bare, wanted = re.compile(r"^N?0*(?=\d)"), str(number).strip().upper()
        for line in range(1, len(self.line_starts) + 1):
            if (written := self.number_of(line)) and bare.sub("", written) == bare.sub("", wanted):
                return line
        raise Alarm(f"no block has the number {shown(number)}")

    def word(self, index: int) -> Word:
        form, value = self.form[index], self.value[index]
        kept: Any = float(value) if form == NUMBER else None if form == NONE else self.payload[int(value)]
        span = self.span(int(self.offset[index]), int(self.length[index]))
        return Word(self.addresses[self.address[index]], kept, int(place_of(*span[:3])), int(self.flag[index]))

    def span(self, offset: int, length: int = 1) -> Span:
        return span_at(self.line_starts, offset, length)

    def span_of_block(self, index: int) -> Span:
        """The first line of a block, from its first character to its end."""
        span = self.span(int(self.start[index]))
        text = self._parted(self.line_text(span.line))[0].rstrip()
        return span._replace(length=max(1, len(text) - span.column + 1))

    def line_of(self, index: int | slice | NDArray[np.integer[Any]]) -> Any:
        """Source line of a block, 1-based; an array of blocks gives an array of lines."""
        start = self.start[index]
        if isinstance(index, slice) and len(start):  # mostly one block a line
            first = int(np.searchsorted(self.line_starts, start[0], "right"))
            lines = self.line_starts[first - 1 : first + len(start)]
            if len(lines) > len(start) and (start >= lines[:-1]).all() and (start < lines[1:]).all():
                return np.arange(first, first + len(start), dtype=np.int32)
        return np.searchsorted(self.line_starts, start, "right")

    def lines(self) -> tuple[NDArray[np.integer[Any]], NDArray[np.integer[Any]]]:
        """The first and the last line (b,) of each block, which may go over several."""
        first = np.asarray(self.line_of(slice(None)))
        last, some = first.copy(), np.flatnonzero(np.diff(self.first) > 0)
        word = self.offset[self.first[some + 1] - 1]
        last[some] = np.maximum(first[some], np.searchsorted(self.line_starts, word, "right"))
        return first, last

    def faulty_blocks(self) -> NDArray[np.int64]:
        """The blocks in which the reader found faults, told one by one or not: a run stops there."""
        told = [a.span.line << 32 | a.span.column for a in self.alarms if a.severity == ALARM and a.span]
        place = np.concatenate([np.array(told, dtype=np.int64), np.array(self.untold, dtype=np.int64)])
        offset = self.line_starts[(place >> 32) - 1] + (place & 0xFFFFFFFF) - 1
        return np.unique(np.maximum(np.searchsorted(self.start, offset, "right") - 1, 0))

    def line_text(self, line: int) -> str:
        """The characters of one line, without its end; empty beyond the program."""
        if not 1 <= line <= len(self.line_starts):
            return ""
        begin = self.line_starts[line - 1]
        end = self.line_starts[line] if line < len(self.line_starts) else len(self.text)
        return self.text[begin:end].rstrip("\r\n")

    def _parted(self, line: str) -> tuple[str, str]:
        """A line with blanks in the place of its comments, and these; one that begins with a bracket ends with one."""
        code, said, at = [], [], 0
        pattern = re.compile(self.comment_mark)
        while mark := pattern.search(line, at):
            closed = line.find(")", mark.end()) if mark[0] == "(" else -1
            end = closed + 1 or len(line)
            said.append(line[mark.end() : end - (closed >= 0)].strip())
            code += [line[at : mark.start()], " " * (end - mark.start())]
            at = end
        return "".join([*code, line[at:]]), " ".join(filter(None, said))

    def code_of(self, index: int) -> list[str]:
        """The lines of a block without its comments."""
        return [self._parted(line)[0] for line in self._lines_of(index)]

    def _lines_of(self, index: int) -> list[str]:
        first = int(self.line_of(index))
        last = int(self.line_of(index + 1)) if index + 1 < len(self) else len(self.line_starts) + 1
        return [self.line_text(line) for line in range(first, max(last, first + 1))]

    def __repr__(self) -> str:
        alarms = several(sum(alarm.count for alarm in self.alarms), "alarm")
        return f"<Program {self.name}: {self.control}, {several(len(self), 'block')}, {alarms}>"

    def _repr_html_(self) -> str:
        blocks = [self[i] for i in range(min(len(self), 40))]
        words = (" ".join(filter(None, [block.keyword, *map(str, block.words)])) for block in blocks)
        named = ("/" * bool(block.skip) + block.number for block in blocks)
        rows = [(str(block.span.line), *row, block.comment) for block, *row in zip(blocks, named, words)]
        more = f"<p>… {len(self) - 40} more blocks</p>" if len(self) > 40 else ""
        table = html_table(("line", "block", "words", "comment"), rows, numbers=(0,), code=(2,))
        return table + more + card_html(self.alarms)


# How a reader makes a program: it begins blocks, adds words and notes faults; all become columns at the end.

CHUNK = 65_536  # words that a builder holds one by one
MOST_WORDS = 1000  # of a block: what has more is no block of any control, and a long line must not fill the memory
MOST_FAULTS = 5000  # of a text, which is read no further: each takes its time, and nobody mends so many


class TooManyFaults(Exception):
    """A text has more than `MOST_FAULTS`; in which line the first beyond stands."""

    def __init__(self, line: int) -> None:
        super().__init__(line)
        self.line = line


class ProgramBuilder:
    """What a reader fills: blocks, their words, alarms; `build` makes the columns.

    Readers that find plain words in bulk hand them over as arrays with `build`'s `bulk`.
    """

    def __init__(self, text: str, name: str, control: str, line_starts: NDArray[np.int32], comment_mark: str) -> None:
        self.text, self.name, self.control = text, name, control
        self.line_starts, self.comment_mark = line_starts, comment_mark
        self.addresses: dict[str, int] = {}
        self.keywords: dict[str, int] = {"": 0}
        self.words: list[tuple[int, float, int, int, int, int]] = []  # address, value, form, flag, offset, length; …
        self.put_away: list[tuple[NDArray[np.float64], NDArray[np.float64]]] = []  # … earlier ones, with their blocks
        self.before = 0  # how many words those are
        self.blocks: list[tuple[int, int, int, bool, int]] = []  # offset, keyword, skip, plain, first word
        self.payload: list[Any] = []
        self.alarms, self.faults = Alarms(), 0
        self.labels: dict[str, int] = {}  # jump target -> offset of its block
        self.full = -1  # where the block begins that was told to be too long

    def span(self, offset: int, length: int = 1) -> Span:
        return span_at(self.line_starts, offset, length)

    def alarm(self, message: str, offset: int, length: int = 1, hint: str = "", severity: str = "alarm") -> None:
        """Note a fault of the text; reading goes on."""
        self.note(Alarm(message, self.span(offset, length), severity, hint))

    def note(self, alarm: Alarm) -> None:
        """Note a fault; one too many ends the reading."""
        self.alarms.append(alarm)
        self.faults += alarm.severity == ALARM
        if self.faults > MOST_FAULTS:
            raise TooManyFaults(alarm.span.line if alarm.span else 1)

    def block(self, offset: int, keyword: str = "", skip: int = 0, plain: bool = False) -> None:
        """Begin a block at `offset`; `skip` is the number of the switch by which it is passed over."""
        if len(self.words) >= CHUNK:
            self.put_away.append((np.array(self.words, dtype=np.float64), np.array(self.blocks, dtype=np.float64)))
            self.before += len(self.words)
            self.words.clear()
            self.blocks.clear()
        key = self.keywords.setdefault(keyword, len(self.keywords))
        self.blocks.append((offset, key, skip, plain, self.before + len(self.words)))

    @property
    def heads(self) -> NDArray[np.float64]:
        """The blocks so far (b, 5): offset, keyword, skip, plain, first word."""
        last = np.array(self.blocks, dtype=np.float64).reshape(-1, 5)
        return np.concatenate([*(blocks for _, blocks in self.put_away), last])

    @property
    def block_words(self) -> list[tuple[int, float, int, int, int, int]]:
        """The words that the block begun last has so far."""
        return self.words[self.blocks[-1][4] - self.before :]

    def word(self, address: str, value: Any, offset: int, length: int, flag: int = 0) -> None:
        """Add a word to the block begun last; an alarm at the first of too many, and none of them is kept."""
        size = self.before + len(self.words) - (self.blocks[-1][4] if self.blocks else 0)
        if size >= MOST_WORDS:
            if self.full != self.blocks[-1][0]:
                self.full = self.blocks[-1][0]
                self.alarm(f"a block holds at most {MOST_WORDS} words, this one has more", offset, length)
            return
        index = self.addresses.setdefault(address, len(self.addresses))
        if isinstance(value, int | float):
            form, number = NUMBER, float(value)
        elif value is None:
            form, number = NONE, 0.0
        else:
            form, number = TEXT if isinstance(value, str) else EXPRESSION, float(len(self.payload))
            self.payload.append(value)
        self.words.append((index, number, form, flag, offset, length))

    def build(self, bulk: BulkBlocks | None = None) -> Program:
        """The program; blocks found in bulk are sorted in by their place in the text."""
        last = np.array(self.words, dtype=np.float64).reshape(-1, 6)
        words, blocks = np.concatenate([*(words for words, _ in self.put_away), last]), self.heads
        count = np.diff(np.append(blocks[:, 4], len(words)))
        words[:, 5] = np.minimum(words[:, 5], 32767)
        kinds = (np.int16, np.float64, np.uint8, np.uint8, np.int32, np.int16)
        columns = [words[:, k].astype(kind) for k, kind in enumerate(kinds)]
        heads = [column.astype(np.int32) for column in blocks[:, :4].T]
        first = first_words(count)
        if bulk is not None and len(bulk.start):
            names = [self.addresses.setdefault(a, len(self.addresses)) for a in bulk.addresses]
            same_names = names == list(range(len(names)))  # then no copy is needed
            address = bulk.address if same_names else np.array(names, dtype=np.int16)[bulk.address]
            key = np.int16(self.keywords.setdefault(bulk.keyword, len(self.keywords)))
            zero = np.broadcast_to(np.uint8(0), (len(bulk.value),))  # a constant column costs nothing
            form = zero if bulk.form is None else bulk.form
            more = [address, bulk.value, form, zero, bulk.offset, bulk.length]
            same = [np.broadcast_to(constant, (len(bulk.start),)) for constant in (key, np.False_)]
            more_heads, first = [bulk.start, *same, bulk.plain], bulk.first
            if len(blocks):
                sizes = [count, np.diff(first)]
                columns, heads = merged(columns, more, 4), merged([*heads, sizes[0]], [*more_heads, sizes[1]], 0)
                first = first_words(heads[4])
            else:
                columns, heads = more, more_heads
        address, value, form, flag, offset, length = columns
        start, keyword, skip, plain, *_ = heads
        return Program(
            text=self.text, name=self.name, control=self.control, comment_mark=self.comment_mark,
            addresses=tuple(self.addresses), address=address, value=value, form=form, flag=flag,
            offset=offset.astype(np.int32, copy=False), length=length.astype(np.int16, copy=False), first=first,
            keywords=tuple(self.keywords), keyword=keyword.astype(np.int16, copy=False),
            skip=skip.astype(np.uint8, copy=False), plain=plain.astype(bool, copy=False),
            start=start.astype(np.int32, copy=False), line_starts=self.line_starts, payload=tuple(self.payload),
            alarms=tuple(sorted(self.alarms, key=lambda alarm: (alarm.span or Span(0, 0))[:2])),
            untold=self.alarms.untold,
            labels={name: int(np.searchsorted(start, at)) for name, at in self.labels.items()},
        )  # fmt: skip


def readable(read: Callable[[str, str], Program]) -> Callable[[str, str], Program]:
    """A reader that reads a text only down to the line in which it has more than `MOST_FAULTS` faults, and says so there."""

    @wraps(read)
    def readable_part(text: str, name: str = "program") -> Program:
        part, line = text, 0
        while True:
            try:
                program = read(part, name)
                break
            except TooManyFaults as stop:
                starts = line_starts(characters(text))
                line = max(stop.line, line // 2)  # what is found last, as labels of two blocks, may stand far above
                part = text[: int(starts[line - 1])]
        if not line:
            return program
        message = f"the text has more than {MOST_FAULTS} faults and is not read from this line on"
        alarms = (*program.alarms, Alarm(message, Span(line, 1)))
        return replace(program, text=text, line_starts=starts, alarms=alarms)

    return readable_part


def first_words(size: NDArray[Any]) -> NDArray[np.int32]:
    """Where the words of each block begin (b + 1,), from their number (b,)."""
    first = np.zeros(len(size) + 1, dtype=np.int32)
    np.cumsum(size, out=first[1:])
    return first


class BulkBlocks(NamedTuple):
    """Blocks found for a whole text at once: words (w,) with `address` into `addresses`, blocks (b,), `first` (b + 1,).

    `form` (w,) may say that some words have no value; without it all are numbers.
    """

    addresses: tuple[str, ...]
    address: NDArray[np.integer[Any]]
    value: NDArray[np.float64]
    offset: NDArray[np.int32]
    length: NDArray[np.int16]
    keyword: str
    start: NDArray[np.int32]
    first: NDArray[np.int32]
    plain: NDArray[np.bool_]
    form: NDArray[np.uint8] | None = None


# Where a program has certain codes, found in its columns.

WITH_NUMBERS = "GM"  # addresses that make codes with their numbers


def blocks_with(program: Program, codes: Collection[str]) -> NDArray[np.bool_]:
    """The blocks (b,) with one of some codes, as their keyword ("CYCL CALL") or as a word ("M99")."""
    found = np.isin(program.keyword, [k for k, keyword in enumerate(program.keywords) if keyword in codes])
    for k, address in enumerate(program.addresses):
        values = [float(code[1:]) for code in codes if code[0] == address and address in WITH_NUMBERS and code[1:].isdigit()]
        if values:
            words = (program.address == k) & (program.form == NUMBER) & np.isin(program.value, values)
            found[np.searchsorted(program.first, np.flatnonzero(words), "right") - 1] = True
    return found
