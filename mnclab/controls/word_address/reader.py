"""Reading blocks of one-letter words: `N40 G83 X20 Z-30 R2 // a hole`.

Lines that hold nothing but good words are found for the whole text at once (`text.words`); the others, with comments,
block skip or faults, are read one by one here, and this is where mistakes get their names.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.text.alarm import DIGITS, LATIN, Alarm
from mnclab.text.dialect import Numbered, Numbers
from mnclab.text.given import LARGEST
from mnclab.text.program import (
    MOST_FAULTS,
    MOST_WORDS,
    NUMBER,
    BulkBlocks,
    Program,
    ProgramBuilder,
    TooManyFaults,
    first_words,
    readable,
)
from mnclab.text.words import Scan, characters, scan

PIECE = 1 << 16
LONGEST_NAME = 24  # letters of a word that is none
PLAIN_LETTERS = "GXYZIJKRF"
Labels = list[tuple[int, int]]  # offset and number of the N words
Other = Callable[[ProgramBuilder, str, int, int], int]
ALPHABET = tuple(chr(c) for c in range(65, 91))
_BITS = np.zeros(128, dtype=np.int32)
_BITS[65:91] = 1 << np.arange(26)

_WORD = re.compile(r"([A-Za-z])[ \t]*([+-]?(?:\d+(?:\.\d*)?|\.\d+))?")


class Marks(NamedTuple):
    """What may stand in a line beside words: comments, which begin with a regular expression, and three marks.

    Without `labels` N is an address like others. Without `skip` a slash at the start of a line means nothing. A line
    that begins with one of the characters of `headers` is one word of that address, without a number. `other` reads a word
    that is no letter with a number, in a text from one place to another: its end, or -1 if it is none; it may raise an Alarm.
    `hints` say of characters without a meaning what to write in their place.
    """

    comment: re.Pattern[str]
    labels: bool = True
    skip: bool = True
    headers: str = ""
    other: Other | None = None
    hints: Mapping[str, str] = {}


def reader(
    control: str, comment: str = r"/[ \t]?/", *, labels: bool = True, skip: bool = True, headers: str = ""
) -> Callable[[str, str], Program]:
    """A function (text, name) -> Program for a control whose lines hold words and such `Marks`."""
    mark = Marks(re.compile(comment), labels, skip, headers)

    @readable
    def read(text: str, name: str = "program") -> Program:
        found = scan(text)
        builder = ProgramBuilder(text, name, control, found.starts, comment)
        labels: Labels = []
        if (long := found.count > MOST_WORDS).any():
            found = found.without(long)
        bulk = clean_blocks(builder, found, labels, mark.labels)
        for line in np.flatnonzero(~found.clean):
            _read_line(builder, text, int(found.starts[line]), mark, labels)
        _check_labels(builder, labels)
        return builder.build(bulk)

    return read


def clean_blocks(builder: ProgramBuilder, found: Scan, labels: Labels, labelled: bool) -> BulkBlocks:
    """Blocks of the clean lines; N words are checked and left out where they label blocks."""
    count = found.count[found.count > 0]
    first = first_words(count)  # of each block
    starts = found.offset[first[:-1]]
    letter, value, offset, length = found.letter, found.value, found.offset, found.length
    is_label = letter == ord("N")
    if labelled and is_label.any():
        _note_labels(builder, found, is_label, first[:-1], labels)
        words = ~is_label
        first = first_words(count - np.add.reduceat(is_label, first[:-1], dtype=np.int32))
        letter, value, offset, length = (column[words] for column in (letter, value, offset, length))
    if len(value) and max(value.max(), -value.min()) >= LARGEST:
        for i in np.flatnonzero(np.abs(value) >= LARGEST):
            builder.alarm(f"a number must be smaller than {LARGEST:g}", int(offset[i]), int(length[i]))
    plain = plain_blocks(letter, value, first, PLAIN_LETTERS)
    address = np.subtract(letter, 65, out=letter)  # in place: nobody else has the letters
    return BulkBlocks(ALPHABET, address, value, offset, length, "", starts, first, plain)


def _note_labels(
    builder: ProgramBuilder, found: Scan, is_label: NDArray[np.bool_], begins: NDArray[np.int32], labels: Labels
) -> None:
    """N must be first in its block, a positive whole number, and (checked at the end) unique."""
    first = np.zeros(len(is_label), dtype=bool)
    first[begins] = True
    whole = (found.value > 0) & (found.value == np.floor(found.value))
    good = is_label & first & whole
    for i in np.flatnonzero(is_label & ~good):
        builder.alarm(_label_fault(first[i], found.value[i]), int(found.offset[i]), int(found.length[i]))
    labels += zip(found.offset[good].tolist(), found.value[good].tolist(), strict=True)


def _label_fault(first: bool, number: float) -> str:
    return f"N must be a positive whole number, got {number:g}" if first else "N must be the first word of its block"


def plain_blocks(
    letter: NDArray[np.uint8], value: NDArray[np.float64], first: NDArray[np.int32], letters: str
) -> NDArray[np.bool_]:
    """Which blocks (b,) hold only these letters, each once, and of the G words only plain motion.

    Every letter is a bit: a block with a letter twice has a sum of bits that differs from their union. `first` (b + 1,)
    says where the words of a block begin.
    """
    plain = np.zeros(len(first) - 1, dtype=bool)
    allowed = np.int32(sum(1 << (ord(c) - 65) for c in letters))
    for k in range(0, len(plain), PIECE):  # in pieces that stay in the cache
        bounds = first[k : k + PIECE + 1]
        filled = np.flatnonzero(bounds[1:] > bounds[:-1])
        if not len(filled):
            continue
        a, b = bounds[0], bounds[-1]
        edges = bounds[filled] - a
        bits = _BITS[letter[a:b]]
        union, total = np.bitwise_or.reduceat(bits, edges), np.add.reduceat(bits, edges)
        good = ((union & ~allowed) == 0) & (union == total)
        of_g = np.flatnonzero(letter[a:b] == ord("G"))
        g = value[a:b][of_g]
        if (strange := of_g[(g != 0) & (g != 1) & (g != 2) & (g != 3)]).size:
            good[np.searchsorted(edges, strange, "right") - 1] = False
        plain[k + filled] = good
    return plain


def _read_line(builder: ProgramBuilder, text: str, begin: int, mark: Marks, labels: Labels) -> None:
    """One line that is not clean: comment, block skip, words, and the first fault."""
    line = int(np.searchsorted(builder.line_starts, np.int32(begin), "right"))
    end = int(builder.line_starts[line]) if line < len(builder.line_starts) else len(text)
    end = begin + len(text[begin:end].rstrip("\r\n"))
    comment = mark.comment.search(text, begin, end)
    stop = comment.start() if comment else end
    at = skip_blanks(text, begin + (text[begin : begin + 1] == "\ufeff"), stop)
    if at >= stop:
        if comment:
            builder.block(stop)
        return
    if text[at] in mark.headers:
        builder.block(at)
        builder.word(text[at], None, at, len(text[at:stop].rstrip()))
        return
    skip = mark.skip and text[at] == "/"
    builder.block(at, skip=skip)
    at = skip_blanks(text, at + skip, stop)
    read_words(builder, text, at, stop, mark, labels)


def read_words(
    builder: ProgramBuilder, text: str, at: int, stop: int, mark: Marks, labels: Labels, first: bool = True
) -> bool:
    """The words of a block up to `stop`; False at the first fault. `first`: nothing of the block stands before them."""
    while (at := skip_blanks(text, at, stop)) < stop:
        match = _WORD.match(text, at, stop)
        if match is None or match.group(2) is None:
            end = mark.other(builder, text, at, stop) if mark.other else -1
            if end < 0:
                _refuse(builder, text, at, stop, mark)
                return False
            at, first = end, False
            continue
        address, number = match.group(1).upper(), float(match.group(2))
        length = match.end() - at
        after = text[match.end() : match.end() + 1]
        if match.end() < stop and (after in ".,+-" or after.isdigit()) and not (after == "," and mark.other):
            _refuse(builder, text, match.end(), stop, mark)
            return False
        if address == "N" and mark.labels:
            if first and 0 < number < math.inf and number == int(number):
                labels.append((at, int(number)))
            else:
                builder.alarm(_label_fault(first, number), at, length)
        else:
            if abs(number) >= LARGEST:
                builder.alarm(f"a number must be smaller than {LARGEST:g}", at, length)
            builder.word(address, number, at, length)
            if builder.blocks and builder.full == builder.blocks[-1][0]:
                return False
        at, first = match.end(), False
    return True


def skip_blanks(text: str, at: int, stop: int) -> int:
    while at < stop and text[at] in " \t\ufeff":
        at += 1
    return at


def _refuse(builder: ProgramBuilder, text: str, at: int, stop: int, mark: Marks) -> None:
    """The fault at a character that is no part of a good word, with the repair where the mistake is known."""
    c = text[at]
    if c == ",":
        builder.alarm("',' is no part of a number", at, hint="the decimal mark is a point")
    elif c.isascii() and c.isalpha():
        following = text[at + 1 : stop].lstrip(" \t")[:1]
        hint = _digit_meant(text, at, stop) or (f"write {c.upper()}0, a point alone is no number" if following == "." else "")
        found = f", found {following!r}" if following and not hint else ""
        if (letters := re.match(r"[A-Z]{4,}", text[at : min(stop, at + LONGEST_NAME)], re.IGNORECASE)) and not hint:
            hint = f"{letters.group().upper()} is no word of this control: a word is one letter and its number"
        builder.alarm(f"{c.upper()} needs a number{found}", at, hint=hint)
    elif c in LATIN or c in DIGITS and c.isalpha():
        latin = f"write the Latin letter {LATIN[c]}" if c in LATIN else ""
        builder.alarm(f"{c!r} is a Cyrillic letter", at, hint=_digit_meant(text, at, stop) or latin)
    elif c == ".":
        builder.alarm("a number has only one decimal point", at)
    elif c in "+-":
        builder.alarm(f"{c!r} must stand between an address and its digits", at)
    elif c.isdigit():
        builder.alarm(f"{c!r} needs an address letter before it", at, hint="a blank inside a number splits it")
    else:
        pattern = mark.comment.pattern
        foreign = f"a comment begins with {pattern if len(pattern) == 1 else '//'}" if c in "(;'" else ""
        builder.alarm(f"{c!r} has no meaning here", at, hint=mark.hints.get(c, foreign))


def _digit_meant(text: str, at: int, stop: int) -> str:
    """The hint about a letter in place of a digit: the one at `at` inside a number, or the one after that address.

    What follows it must be digits: TOOL is a word.
    """
    begin = at
    c = text[at]
    if c not in DIGITS or not text[at - 1 : at].isdigit():
        c = text[at + 1 : at + 2] if c.isascii() else ""
        if c in " \t":
            begin = at + 1
            c = text[at + 1 : stop].lstrip(" \t")[:1]
            c = c if c in "Oo" else ""  # the others may begin the next word
    rest = text[text.find(c, begin, stop) : stop].lstrip(f"{c}0123456789.")
    if c not in DIGITS or (rest[:1].isalpha() and not re.match(r"[-+.\d]", rest[1:])):
        return ""
    return f"the letter {c.upper() if c in 'Oo' else c} stands where the digit {DIGITS[c]} was meant"


def _check_labels(builder: ProgramBuilder, labels: Labels) -> None:
    """N numbers must be unique; the second of two is at fault."""
    if len({number for _, number in labels}) == len(labels):
        return
    seen: set[int] = set()
    for offset, number in sorted(labels):
        if number in seen:
            builder.alarm(f"N{int(number)} labels two blocks", offset, 1 + len(str(int(number))))
        seen.add(number)


# Formats of words: which numbers may carry a sign or a decimal point, and blanks between an address and its number.
# A format is written as manuals of such controls write it: `n` digits, `n.n` digits with a point or not, `±n` and
# `±n.n` the same with a sign or not.

MEANING = {"n": "digits alone", "n.n": "a number without sign", "±n": "a whole number", "±n.n": "a number"}


def misformed(program: Program, formats: Mapping[str, str]) -> list[Alarm]:
    """An Alarm for each word with a blank inside, or that is not of the format of its address."""
    data = characters(program.text)
    length = program.length.astype(np.int64)
    alarms = []

    def refuse(which: NDArray[np.bool_], what: str, repair: str = "") -> None:
        for i in np.flatnonzero(which & (program.form == NUMBER)):
            address = program.addresses[program.address[i]]
            hint = repair or f"{address} takes {MEANING[formats[address]]}"
            span = program.span(int(program.offset[i]), int(length[i]))
            alarms.append(Alarm(f"{address} has {what}", span, hint=hint))
            if len(alarms) > MOST_FAULTS:
                raise TooManyFaults(span.line)

    def count(found: NDArray[np.bool_]) -> NDArray[np.int64]:
        before = np.concatenate([[0], np.cumsum(found)])
        begin = program.offset.astype(np.int64)
        return np.asarray(before[np.minimum(begin + length, len(data))] - before[begin])

    plain, whole = (
        np.isin(program.address, [k for k, name in enumerate(program.addresses) if formats.get(name, "±n.n") in kinds])
        for kinds in (("n", "n.n"), ("n", "±n"))
    )
    blanks = count((data == ord(" ")) | (data == ord("\t")))
    refuse(blanks > 0, "a blank before its number", "write the number directly after the address")
    refuse(plain & (count((data == ord("+")) | (data == ord("-"))) > 0), "a sign")
    refuse(whole & (count(data == ord(".")) > 0), "a decimal point")
    return alarms


# The numbers of blocks of ISO words: N at the beginning of a line, before or behind the mark of block skip.

_NUMBER = re.compile(
    r"[ \t\ufeff]*+(?:\([^()\r\n]*+\)[ \t]*+)*+(?:/[ \t]*+[1-9]?[ \t]*+)?N[ \t]*+\+?(\d++)(?!\.)", re.IGNORECASE
)
_LAST_OF_DIN = re.compile(r"[ \t]*%")  # N99999999 %NAME, the end of a DIN/ISO program


def numbered(program: Program) -> list[Numbered]:
    """The numbers of all lines, in their order."""
    matches = (_NUMBER.match(program.text, int(begin)) for begin in program.line_starts)
    found = [match for match in matches if match and not _LAST_OF_DIN.match(program.text, match.end())]
    return [Numbered(match.start(1), match.end(1) - match.start(1), match[1]) for match in found]


def numbers(program: Program) -> Numbers:
    """The numbers of a program in which no word names a block."""
    return Numbers(numbered(program))
