"""Reading conversational programs: lines into blocks.

A block is a number, a statement and its words; `/` before or after the number marks a block that may be passed over,
`;` begins a comment, which goes on behind a `~` at its end, `*` a structure block. What was wrapped into the line after a
comment, words that are no block and look like none, is passed over with a warning. A block goes on over several lines when
a line ends in `~`, in a definition whose further lines carry no number, and in the sub-blocks n.0, n.1, … of older cycles,
which become one block.
So `Q200=5` without a number below a definition is a parameter of it; with a number it is an assignment, and so it is
where the lines of the definition were joined by ~ and the last one has none. `Q1 = -5`, the way an assignment is
written, below parameters that are written `Q200=5`: a parameter too, for the manual numbers assignments, with a warning.
Plain straight lines (`12 L X+1.5 Y-2 F500 R0`) are found for the whole text at once; every other line is read one by
one, and a fault ends the reading of its block alone.
"""

from __future__ import annotations

import re
from difflib import get_close_matches
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.reading import din_reader, statements
from mnclab.controls.tnc_620.reading.words import FLAGS, INCH, Cursor, Fault, bounds
from mnclab.text.alarm import KEPT, Alarm
from mnclab.text.given import LARGEST
from mnclab.text.program import NONE, BulkBlocks, Program, ProgramBuilder, first_words, readable
from mnclab.text.words import Scan, characters, scan

_UNIT = re.compile(r"(?<![^\r\n])[ \t\ufeff]*(?:/[ \t]*)?(?:N?\d+[ \t]*)?BEGIN[ \t]+PGM[ \t]([^\r\n;~]*)", FLAGS)
_HEAD = re.compile(r"[ \t]*(/?)[ \t]*(?:N(?=\d))?(\d*)[ \t]*(/?)[ \t]*", FLAGS)
_SPACED = re.compile(r"Q(\d+)[ \t]+=", FLAGS)
_WORD = re.compile(r"[A-Z]+|\S", re.IGNORECASE)
_ASSIGNED = re.compile(r"Q[LR]?[ \t]?\d+[ \t]*=", FLAGS)
_CYCLE = re.compile(r"CYCLE(?![A-Z])", FLAGS)
_PROSE = re.compile(r"[^\W\d_]{2,}(?![\w+=-])")  # a word of a sentence
WRAPPED = "begin it with ; or join it to the comment with ~"
#: What to write for words that are no statement.
_MEANT = {
    "DWELL": "a dwell is FUNCTION DWELL TIME2 or cycle 9", "PROGRAM": "a program begins with BEGIN PGM",
    "ERROR": "a control writes ERROR = before a block that it could not read: write the block anew, formulas in one of their own",
    "IF": "a jump is FN 9: IF +Q1 EQU +Q3 GOTO LBL 5", "SPINDLE": "M3, M4 and M5 are the spindle", "COOLANT": "write M8 or M9",
}  # fmt: skip
_PLAIN = "FXYZRKM"  # letters of plain lines: K stands for FMAX, M for M99
_FEED, _M = _PLAIN.index("F"), _PLAIN.index("M")
_NAMES = "F", "X", "Y", "Z", "R0", "FMAX", "M"
_RAPID, _SCANNED = "FMAX", "K000"  # what the words of a whole text are found in has a word with a number in its place
_CALL = 99.0  # M99 calls the cycle where the line ends
MOST_LETTERS = 30  # of a word that may have been meant as a statement
PIECE = 1 << 14  # lines whose words are looked at together

# A hexadecimal digit for each letter: added over a line of so few words that none overflows, 1 says that a letter stands once.
_STRANGE = 1 << 4 * len(_PLAIN)
_ONCE = int("1" * len(_PLAIN), 16)
_DIGIT_OF_LETTER = np.full(256, _STRANGE, np.int32)
_PLACE_OF_LETTER, _FORM_OF_LETTER = np.zeros(256, np.int16), np.zeros(256, np.uint8)
for _place, _letter in enumerate(_PLAIN):
    _DIGIT_OF_LETTER[ord(_letter)], _PLACE_OF_LETTER[ord(_letter)] = 1 << 4 * _place, _place
_LOOKED_AT = _DIGIT_OF_LETTER[ord("R")]  # from this letter on the number counts too
_TWO_FEEDS = _DIGIT_OF_LETTER[ord("F")] | _DIGIT_OF_LETTER[ord("K")]
_FORM_OF_LETTER[[ord("R"), ord("K")]] = NONE


@readable
def read(text: str, name: str = "program") -> Program:
    """The blocks of a program: DIN/ISO where its first block says so, or the type of its file, else conversational."""
    unit = _UNIT.search(text)
    if unit is None and (din_reader.begins(text) or name.lower().endswith(".i")):
        return din_reader.read(text, name)
    found = scan(text.replace(_RAPID, _SCANNED), leading_number=True, bare="L")
    builder = ProgramBuilder(text, name, "tnc-620", found.starts, ";")
    inch = unit is not None and unit.group(1).upper().split()[-1:] == ["INCH"]
    plain, bulk = _plain_lines(found, text, inch)
    lines = _Lines(builder, inch)
    for line in np.flatnonzero(~plain).tolist():
        lines.read(line)
    if lines.end is not None:
        heads = builder.heads
        starts = np.append(heads[heads[:, 1] > 0, 0], bulk.start)
        if (after := starts[starts > lines.end]).size:
            builder.alarm("nothing after END PGM is obeyed", int(after.min()), severity="warning")
    return builder.build(bulk)


class _Lines:
    """Reads lines one by one and remembers which block the next one may belong to."""

    def __init__(self, builder: ProgramBuilder, inch: bool) -> None:
        self.builder, self.text, self.inch = builder, builder.text, inch
        self.last = -1  # the line read last
        self.statement: statements.Statement | None = None  # of the block that may go on
        self.tilde = False  # the line before ended in ~
        self.remark = False  # and stood in a comment, which goes on
        self.over = False  # the last line of a block was joined by a ~ and has none itself
        self.skip = self.faulty = self.begun = self.bracketed = self.numbered = False
        self.tight = False  # a parameter of the block is written without blanks
        self.taken = -1  # the last line that was read with one before it
        self.wrapped = -1  # the line that was read last as the rest of a comment
        self.end: int | None = None  # place of END PGM

    def read(self, line: int) -> None:
        """One line: a block, a part of the block before it, a comment, or nothing."""
        if line != self.last + 1:
            self.statement, self.tilde, self.over, self.remark = None, False, False, False  # plain lines stand between
        self.last = line
        if line <= self.taken:
            return
        begin, stop, comment, tilde = bounds(self.builder, line)
        joined, self.tilde = self.tilde, tilde
        remark, self.remark = self.remark, tilde and comment >= 0
        head = _HEAD.match(self.text, begin, stop)
        assert head is not None
        self.numbered = bool(head.group(2))
        if head.end() >= stop and not head.group(2):
            self.tilde = tilde or (joined and comment >= 0)
            if comment >= 0 and self.statement is None:
                self.builder.block(comment)
            return
        at = begin if joined else head.end()
        if joined and remark and (self.statement is None or self.statement.more is None):
            self.remark = tilde
            statements.passed_over(Cursor(self.builder, at, stop, self.inch), what="the comment above")
            return
        goes_on = self.statement is not None and self.statement.keyword == "PATTERN DEF" and not head.group(2)
        if at < stop and self.text[at] == "(" and not joined and not goes_on:
            self.bracket(at, stop)
            return
        try:
            if not joined and not head.group(2) and self.rest_of_comment(line, at, stop):
                return
            if joined or (not head.group(2) and self.goes_on(at, stop)):
                self.over = joined and not tilde
                self.go_on(Cursor(self.builder, at, stop, self.inch))
            else:
                self.over = False
                start = begin + len(head.group()) - len(head.group().lstrip(" \t"))
                cursor = Cursor(self.builder, at, stop, self.inch)
                if tilde and comment < 0 and _ASSIGNED.match(self.text, at, stop):
                    self.take_further(cursor, line)
                self.block(start, bool(head.group(1) or head.group(3)), cursor)
        except Fault as fault:
            self.faulty = True
            self.builder.alarm(fault.message, fault.offset, fault.length, fault.hint)
        except Alarm as alarm:  # from the reader of formulas, which knows its place
            self.faulty = True
            self.builder.note(alarm)

    def bracket(self, at: int, stop: int) -> None:
        """A line in brackets is a comment of other controls; it ends what goes on over several lines."""
        self.builder.block(at)
        self.statement = None
        if not self.bracketed:
            message, hint = "lines that begin with a bracket are read as comments", "a comment of this control begins with ;"
            self.builder.alarm(message, at, stop - at, hint, "warning")
        self.bracketed = True

    def take_further(self, cursor: Cursor, line: int) -> None:
        """The lines on which a formula goes on, up to one that does not end in ~."""
        tilde = True
        while tilde and line + 1 < len(self.builder.line_starts):
            line += 1
            begin, stop, comment, tilde = bounds(self.builder, line)
            cursor.further.append((begin, stop))
            if comment >= 0:  # which may go on itself
                break
        self.taken, self.tilde, self.remark = line, tilde, tilde

    def rest_of_comment(self, line: int, at: int, stop: int) -> bool:
        """Whether the line, without a number, is passed over as what was wrapped out of the comment above it."""
        reads = self.statement.more if self.statement else None
        if reads not in (None, statements.cycle_parameters):
            return False
        if not _PROSE.match(self.text, at, stop) or not self.below_comment(line):
            return False
        try:
            if statements.recognize(Cursor(self.builder, at, stop, self.inch)) is not None:
                return False
        except Fault:
            return False
        if statements.like_a_block(self.text, at, stop) or near(self.text[at:stop], 0.75):
            return False
        self.wrapped = line
        self.builder.alarm("this line is read as the rest of the comment above", at, stop - at, WRAPPED, "warning")
        return True

    def below_comment(self, line: int) -> bool:
        return line > 0 and (self.wrapped == line - 1 or bounds(self.builder, line - 1)[2] >= 0)

    def goes_on(self, at: int, stop: int) -> bool:
        if self.statement is None or self.statement.more is None or self.over or self.text[at] == "*":
            return False
        try:
            begins = statements.recognize(Cursor(self.builder, at, stop, self.inch))
        except Fault:
            return False
        return begins is None or (begins.keyword in ("Q", "QS") and self.statement.more is statements.cycle_parameters)

    def go_on(self, cursor: Cursor) -> None:
        if self.statement is None or self.faulty:
            return
        if self.statement.more is statements.cycle_parameters:
            spaced = _SPACED.match(self.text, cursor.at, cursor.stop)
            if spaced and self.tight:
                message = f"Q{spaced.group(1)} is read as a parameter of the {self.statement.keyword} above it"
                hint = "an assignment has a block number, for example 5 Q1 = -9"
                self.builder.alarm(message, cursor.at, cursor.stop - cursor.at, hint, "warning")
            self.tight = self.tight or not spaced
        (self.statement.more or self.statement.read)(cursor)
        self.close(cursor)

    def block(self, start: int, skip: bool, cursor: Cursor) -> None:
        """A line that begins a block, or is the next sub-block of one."""
        before, self.statement = self.statement, None
        was_faulty, self.faulty, self.tight = self.faulty, False, False
        if cursor.done or self.text[cursor.at] == "*":
            self.builder.block(start, skip=skip)
            return
        begin = cursor.at
        try:
            statement = statements.recognize(cursor)
        except Fault:
            self.builder.block(start, skip=skip)
            raise
        if statement is not None and _CYCLE.match(self.text, begin):
            self.builder.alarm("CYCLE is read as CYCL, as the control writes it", begin, 5, "write CYCL", "warning")
        if statement is not None and statement.part > 0 and before is not None and before.keyword == statement.keyword:
            self.statement, self.faulty = statement, was_faulty
            if was_faulty:
                return
            if statement.part <= before.part:
                what = f"{statement.keyword}.{statement.part} stands after {before.keyword}.{before.part}"
                raise Fault(what, begin, cursor.at - begin)
            if skip != self.skip:
                raise Fault("all sub-blocks of a cycle must be marked with / or none", begin, cursor.at - begin)
        else:
            self.builder.block(start, statement.keyword if statement else "", skip)
            self.statement, self.skip = statement, skip
            if statement is None:
                raise self.unknown(cursor)
            if statement.keyword == "BEGIN PGM":
                if self.begun:
                    raise Fault("BEGIN PGM stands twice: a file holds one program", begin, cursor.at - begin)
                self.begun = True
            if statement.keyword == "END PGM" and self.end is None:
                self.end = begin
            if statement.part > 0:
                what = f"{statement.keyword}.{statement.part} stands without {statement.keyword}.0 before it"
                raise Fault(what, begin, cursor.at - begin)
        statement.read(cursor)
        self.close(cursor)

    def close(self, cursor: Cursor) -> None:
        if not cursor.done:
            raise cursor.unexpected()

    def unknown(self, cursor: Cursor) -> Fault:
        found = _WORD.match(self.text, cursor.at, cursor.stop)
        word = found.group().upper() if found else ""
        if not word.isascii() or not word.isalpha() or word == "G":
            return cursor.unexpected()
        if len(word) == 1:
            return Fault(f"{word} begins no statement", cursor.at, hint="a straight line begins with L")
        hints = [_MEANT[word]] if word in _MEANT else []
        if not hints and self.builder.alarms.total < KEPT:  # those that follow are only counted
            hints = [f"near: {', '.join(found_near)}"] if (found_near := near(cursor.rest())) else []
            if not self.numbered and self.below_comment(self.last):
                hints.append("if it is the rest of the comment above, begin it with ;")
        return Fault(f"{word} is no statement of this control", cursor.at, len(word), "; ".join(hints))


def near(text: str, least: float = 0.6) -> list[str]:
    """The statements that the first words of a line are nearly; a single word is alike by `least`, 0 to 1."""
    first = " ".join(text.upper().split(maxsplit=2)[:2])[: 2 * MOST_LETTERS]
    word = found.group().upper() if (found := _WORD.match(text)) else ""
    if not 0 < len(word) <= MOST_LETTERS:
        return []
    known = [*statements.WORDS, *statements.KEYWORDS_ONLY]
    return get_close_matches(first, [*known, "CYCL DEF", "TCH PROBE"], 1, 0.7) or get_close_matches(word, known, 2, least)


def _plain_lines(found: Scan, text: str, inch: bool) -> tuple[NDArray[np.bool_], BulkBlocks]:
    """Which lines (l,) are plain straight lines, and their blocks.

    The columns of `found` are used up: the words that stay are moved to their beginning, in pieces that stay in the
    cache, because new columns would cost more than the work on them.
    """
    with_words, data = np.flatnonzero(found.count), characters(text)  # lines
    count = found.count[with_words]
    first = first_words(count)
    good = (count > 1) & (count <= 1 + len(_PLAIN))
    if "~" in text:  # the line after it goes on with a block
        tildes = np.flatnonzero(data == ord("~"))
        good &= ~np.isin(with_words, np.searchsorted(found.starts, tildes, "right"))

    address, form = np.empty(len(found.letter), np.int16), np.empty(len(found.letter), np.uint8)
    columns: list[NDArray[Any]] = [found.value, found.offset, found.length]
    kept = 0
    for i in range(0, len(count), PIECE):
        here = slice(int(first[i]), int(first[min(i + PIECE, len(count))]))
        letter, heads = found.letter[here], first[i : i + PIECE][: len(count) - i] - first[i]
        good[i : i + PIECE] &= _are_plain(letter, found.value[here], found.length[here], found.offset[here], heads, data)
        keep = np.repeat(good[i : i + PIECE], count[i : i + PIECE])
        keep[heads] = False
        letter = letter[keep]
        to = slice(kept, kept + len(letter))
        address[to], form[to] = _PLACE_OF_LETTER[letter], _FORM_OF_LETTER[letter]
        for column in columns:
            column[to] = column[here][keep]
        kept = to.stop
    for column in (*columns, address, form):
        column.resize(kept, refcheck=False)

    plain = np.zeros(len(found.starts), dtype=bool)
    plain[with_words[good]] = True
    starts = found.starts[with_words[good]]
    if found.indented:
        while (indented := (data[starts] == 32) | (data[starts] == 9)).any():
            starts = starts + indented
    return plain, BulkBlocks(
        addresses=_NAMES[: int(address.max(initial=-1)) + 1],
        address=address,
        value=np.where((address == _FEED) | (address == _M), found.value, found.value * INCH) if inch else found.value,
        offset=found.offset,
        length=found.length,
        keyword="L",
        start=starts,
        first=first_words(count[good] - 1),
        plain=np.ones(int(good.sum()), dtype=bool),
        form=form,
    )


def _are_plain(
    letter: NDArray[np.uint8], value: NDArray[np.float64], length: NDArray[np.int16], offset: NDArray[np.int32],
    heads: NDArray[np.int32], data: NDArray[np.uint8],
) -> NDArray[np.bool_]:  # fmt: skip
    """Which lines are an L alone and plain words, each once and one feed; of their words (w,), `heads` are the first ones."""
    digits = _DIGIT_OF_LETTER[letter]
    digits[heads] = 0
    of = np.flatnonzero(digits >= _LOOKED_AT)  # an R that is not R0, a K that is written, an M that calls no cycle
    if len(of):
        what, number, size, at = letter[of], value[of], length[of], offset[of]
        plain = (what == ord("R")) & (number == 0) & (size == 2) | (what == ord("M")) & (number == _CALL) & (size == 3)
        rapid = (what == ord("K")) & (size == len(_RAPID)) & (data[at] == ord(_RAPID[0]))
        behind = at + len(_RAPID)
        rapid &= (behind >= len(data)) | (data.take(behind, mode="clip") | 32 < ord("a"))
        digits[of[~plain & ~rapid]] = _STRANGE
    if max(value.max(), -value.min()) >= LARGEST:
        digits[np.abs(value) >= LARGEST] = _STRANGE
    good = (letter[heads] == ord("L")) & (length[heads] == 1)
    total = np.add.reduceat(digits, heads)
    return good & (total & ~_ONCE == 0) & (total & _TWO_FEEDS != _TWO_FEEDS)
