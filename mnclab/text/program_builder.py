"""How a reader makes a program: it begins blocks, adds words and notes faults; all become columns at the end."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import wraps
from itertools import chain
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.text.alarm import ALARM, Alarm, Alarms, Span
from mnclab.text.program import EXPRESSION, NONE, NUMBER, TEXT, Program, span_at
from mnclab.text.words import characters, line_starts

CHUNK = 65_536  # words that a builder holds one by one
MOST_WORDS = 1000  # of a block: what has more is no block of any control, and a long line must not fill the memory
MOST_FAULTS = 5000  # of a text, which is read no further: each takes its time, and nobody mends so many
FEW = 1000  # stretches of blocks that are copied one after the other


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
                columns, heads = _merged(columns, more, 4), _merged([*heads, sizes[0]], [*more_heads, sizes[1]], 0)
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


def _merged(some: list[Any], others: list[Any], by: int) -> list[Any]:
    """Two sets of columns sorted together by one of them."""
    places = np.searchsorted(others[by], some[by])
    steps = np.diff(places, prepend=-1)
    cuts = np.flatnonzero(steps)  # where `some` goes on at another place of the others
    if len(cuts) <= FEW and (steps >= 0).all():  # whole stretches are copied faster than single rows
        some = [np.split(column, cuts) for column in some]
        others = [np.split(column, places[cuts]) for column in others]
        return [np.concatenate([*chain(*zip(a, b, strict=True))]) for a, b in zip(some, others)]
    order = np.argsort(np.concatenate([some[by], others[by]]), kind="stable")
    return [np.concatenate(pair)[order] for pair in zip(some, others, strict=True)]


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
