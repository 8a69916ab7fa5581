"""Letters and numbers of a whole text, found at once with numpy.

A *clean* line holds nothing but words of one letter and one number (``N10 G1X-2.5 y+03.``), blanks between them or not.
Such lines are most of any long program, and :func:`scan` reads them at several million words a second; every other
line is left to the reader of the control, which words the alarms. The method: the eight characters before the end of
a number are one machine word, the point is squeezed out of it, three multiplications join the digits, and a division
by an exact power of ten rounds as ``float()`` does.

The text is worked in pieces of some 256 KiB, which stay in the processor's cache.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

PIECE = 1 << 18
BLANK, DIGIT, END, OTHER = range(4)

_KIND = np.full(256, OTHER, dtype=np.uint8)
_KIND[[ord(c) for c in " \t"]] = BLANK
_KIND[[ord(c) for c in "\r\n"]] = END
_KIND[ord("0") : ord("9") + 1] = DIGIT

_u8 = np.uint64
_ZEROS, _POINTS = _u8(0x3030303030303030), _u8(0x2E2E2E2E2E2E2E2E)
_LOW, _HIGH = _u8(0x0101010101010101), _u8(0x8080808080808080)
_POWERS = 10.0 ** np.arange(23)


@dataclass(frozen=True)
class Scan:
    """Words of the clean lines, and which lines are clean.

    ``letter`` (w,) upper-case ASCII, ``value`` (w,), ``offset`` (w,) of the letter in the text, ``length`` (w,) in
    characters; ``count`` (l,) words of each line, 0 where it is not clean; ``clean`` (l,); ``starts`` (l,) offsets of the
    lines.
    """

    letter: NDArray[np.uint8]
    value: NDArray[np.float64]
    offset: NDArray[np.int32]
    length: NDArray[np.int16]
    count: NDArray[np.int32]
    clean: NDArray[np.bool_]
    starts: NDArray[np.int32]

    @property
    def line(self) -> NDArray[np.int64]:
        """The line (w,) of each word, from 0."""
        return np.repeat(np.arange(len(self.count)), self.count)


def line_starts(data: NDArray[np.uint8]) -> NDArray[np.int32]:
    """Offsets of the lines of a text; a line ends with LF, CR LF or CR."""
    ends = data == 10
    if (returns := data == 13).any():
        alone = returns.copy()
        alone[:-1] &= data[1:] != 10
        ends |= alone
    return np.concatenate([[0], np.flatnonzero(ends) + 1]).astype(np.int32)


def characters(text: str) -> NDArray[np.uint8]:
    """One byte a character: ASCII as it is, everything else as ``?``, so that offsets stay those of the text."""
    return np.frombuffer(text.encode("ascii", errors="replace"), dtype=np.uint8)


def scan(text: str, leading_number: bool = False, bare: str = "") -> Scan:
    """Find the words of all clean lines.

    ``leading_number``: digits may stand before the first letter. ``bare``: letters that may begin a line without a
    number of their own (``L X+1``); such a word has the value 0.
    """
    # room for as many words as fit: memory that is never touched costs nothing, what is touched costs more than the work
    most = len(text) // 2 + 1
    columns: list[NDArray[Any]] = [np.empty(most, dtype=kind) for kind in (np.uint8, np.float64, np.int32, np.int16)]
    starts: list[NDArray[np.int32]] = []
    counts: list[NDArray[np.int64]] = []
    cleans: list[NDArray[np.bool_]] = []
    begin = found = 0
    while begin < len(text) or not starts:
        end = _end_of_piece(text, begin)
        data = characters(text[begin:end])
        local = line_starts(data)
        if end < len(text):
            local = local[:-1]  # the line that begins the next piece
        *words, count, clean = _scan_piece(data, local, begin, leading_number, bare)
        for column, part in zip(columns, words, strict=True):
            column[found : found + len(part)] = part
        starts.append(local + begin)
        counts.append(count)
        cleans.append(clean)
        found, begin = found + len(words[0]), end
    letter, value, offset, length = (column[:found] for column in columns)
    return Scan(
        letter, value, offset, length,
        np.concatenate(counts).astype(np.int32), np.concatenate(cleans), np.concatenate(starts).astype(np.int32),
    )  # fmt: skip


def _end_of_piece(text: str, begin: int) -> int:
    """Where the piece that begins at ``begin`` ends: behind the last line end within reach, or behind the first one."""
    if begin + PIECE >= len(text):
        return len(text)
    last = max(text.rfind("\n", begin, begin + PIECE), text.rfind("\r", begin, begin + PIECE - 1))
    if last < 0:
        ends = [k for k in (text.find("\n", begin + PIECE), text.find("\r", begin + PIECE)) if k >= 0]
        if not ends:
            return len(text)
        last = min(ends)
    return last + 2 if text[last : last + 2] == "\r\n" else last + 1


def _letters(data: NDArray[np.uint8]) -> NDArray[np.bool_]:
    return (data | 0x20) - 97 < 26


def _scan_piece(
    data: NDArray[np.uint8], starts: NDArray[np.int32], begin: int, leading_number: bool, bare: str
) -> tuple[NDArray, ...]:
    marks = np.flatnonzero(_letters(data) | (data == 10) | (data == 13))
    marked = data[marks]
    is_letter = marked > 13
    at = marks[is_letter]
    after = np.append(marks[1:], len(data))[is_letter]

    # the number lies between the letter and the next one, blanks cut off at both ends
    begin_of = _skip_blanks(data, at + 1, after)
    end_of = _drop_blanks(data, begin_of, after)
    first_of = data[np.minimum(begin_of, len(data) - 1)]
    negative = (first_of == ord("-")) & (end_of > begin_of)
    signed = negative | ((first_of == ord("+")) & (end_of > begin_of))
    value, good = numbers(data, begin_of + signed, end_of)
    value = np.where(negative, -value, value)

    if (marked == 13).any():
        line = np.searchsorted(starts, at, "right") - 1
    else:
        line = np.cumsum(~is_letter).astype(np.int64)[is_letter]
    # a line is clean when all its words are good and no other character stands before the first of them
    if bare:
        alone = (begin_of == end_of) & (np.diff(line, prepend=-1) != 0)
        alone &= np.isin(data[at] & 0xDF, [ord(letter) for letter in bare])
        value, good, end_of = np.where(alone, 0.0, value), good | alone, np.where(alone, at + 1, end_of)
    clean = np.ones(len(starts), dtype=bool)
    clean[line[~good]] = False
    ends = np.append(starts[1:], len(data))
    head = ends.copy()
    head[line[::-1]] = at[::-1]
    clean &= _clean_heads(data, starts, head, leading_number)
    keep = slice(None) if clean.all() else clean[line]
    return (
        data[at[keep]] & 0xDF,
        value[keep],
        at[keep] + begin,
        np.minimum(end_of[keep] - at[keep], 32767),
        np.bincount(line[keep], minlength=len(starts)),
        clean,
    )


def _clean_heads(
    data: NDArray[np.uint8], starts: NDArray[np.int32], head: NDArray[np.int32], leading_number: bool
) -> NDArray[np.bool_] | bool:
    """Which lines have only blanks, or with ``leading_number`` one whole number, before ``head``, their first letter."""
    if (head - starts <= 1).all() and not leading_number and not (data[starts[head > starts]] > 32).any():
        return True  # nothing, or an empty line's end
    kind = _KIND[data]
    filled = np.concatenate([[0], np.cumsum((kind != BLANK) & (kind != END), dtype=np.int32)])
    before = filled[head] - filled[starts]
    if not leading_number or not before.any():
        return before == 0
    digits = np.concatenate([[0], np.cumsum(kind == DIGIT, dtype=np.int32)])
    here = _skip_blanks(data, starts.astype(np.int64), head.astype(np.int64))
    there = np.minimum(here + before, len(data))
    return (before == 0) | ((digits[head] - digits[starts] == before) & (digits[there] - digits[here] == before))


def _blank(data: NDArray[np.uint8], at: NDArray[np.int64]) -> NDArray[np.bool_]:
    character = data[at]
    return (character == 32) | (character == 9)


def _skip_blanks(data: NDArray[np.uint8], at: NDArray[np.int64], end: NDArray[np.int64]) -> NDArray[np.int64]:
    """First place in [at, end) that is no blank."""
    blank = (at < end) & _blank(data, np.minimum(at, len(data) - 1))
    if not blank.any():
        return at
    solid = np.append(np.flatnonzero((data != 32) & (data != 9)), len(data))
    found = solid[np.searchsorted(solid, at[blank])]
    result = at.copy()
    result[blank] = np.minimum(found, end[blank])
    return result


def _drop_blanks(data: NDArray[np.uint8], begin: NDArray[np.int64], end: NDArray[np.int64]) -> NDArray[np.int64]:
    """Last place after ``begin`` behind which [.., end) holds only blanks."""
    result = end - ((end > begin) & _blank(data, end - 1))  # nearly always one
    todo = np.flatnonzero((result > begin) & _blank(data, result - 1))
    if len(todo):
        solid = np.maximum.accumulate(np.where((data != 32) & (data != 9), np.arange(len(data)), -1))
        result[todo] = np.maximum(solid[result[todo] - 1] + 1, begin[todo])
    return result


def numbers(
    data: NDArray[np.uint8], begin: NDArray[np.int64], end: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Values of the unsigned decimal numbers in [begin, end) and which of them are numbers at all."""
    size = end - begin
    padded = np.concatenate([np.full(8, ord(" "), dtype=np.uint8), data])
    window = np.ndarray((len(data) + 1,), dtype="<u8", buffer=padded, strides=(1,))
    word = window[end]  # the eight characters before the end
    spare = np.clip(8 - size, 0, 7).astype(np.uint64) * _u8(8)
    low = (_u8(1) << spare) - _u8(1)
    word = (word & ~low) | (_ZEROS & low)

    # the byte of the point (the lowest zero byte of word ^ points), and the digits below it moved up by one
    away = word ^ _POINTS
    found = (away - _LOW) & ~away & _HIGH
    mark = found & (~found + _u8(1))
    has_point = mark != 0
    below = np.where(has_point, (mark >> _u8(7)) - _u8(1), _u8(0))
    above = np.where(has_point, ~((mark << _u8(1)) - _u8(1)), ~_u8(0))
    word = (word & above) | ((word & below) << _u8(8)) | np.where(has_point, _u8(0x30), _u8(0))
    decimals = np.where(has_point, 7 - (np.bitwise_count(mark - _u8(1)).astype(np.int64) >> 3), 0)

    is_digits = (((word + _u8(0x4646464646464646)) | (word - _ZEROS)) & _HIGH) == 0
    good = is_digits & (size >= 1) & (size <= 8) & ~(has_point & (size == 1))
    word &= _u8(0x0F0F0F0F0F0F0F0F)
    word = (word * _u8(2561)) >> _u8(8)
    word = ((word & _u8(0x00FF00FF00FF00FF)) * _u8(6553601)) >> _u8(16)
    word = ((word & _u8(0x0000FFFF0000FFFF)) * _u8(42949672960001)) >> _u8(32)
    value = word.astype(np.float64) / _POWERS[decimals]
    if (long := size > 8).any():
        value[long], good[long] = _long_numbers(data, begin[long], end[long])
    return value, good


def _long_numbers(
    data: NDArray[np.uint8], begin: NDArray[np.int64], end: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Numbers of more than eight characters, digit by digit; beyond what a double holds exactly, one by one."""
    size = end - begin
    total = np.zeros(len(begin), dtype=np.int64)
    digits, points, after = (np.zeros(len(begin), dtype=np.int64) for _ in range(3))
    for k in range(min(int(size.max()), 17)):
        inside = k < size
        byte = data[np.minimum(begin + k, len(data) - 1)]
        digit = inside & (byte >= 48) & (byte <= 57)
        total = np.where(digit, total * 10 + (byte.astype(np.int64) - 48), total)
        digits += digit
        after += digit & (points > 0)
        points += inside & (byte == 46)
    good = (size <= 17) & (digits + points == size) & (points <= 1) & (digits >= 1)
    value = total / _POWERS[np.minimum(after, 22)]
    for i in np.flatnonzero((size > 16) | (total >= 2**53)):
        piece = data[begin[i] : end[i]].tobytes()
        good[i] = len(piece) < 400 and piece.replace(b".", b"", 1).isdigit()
        value[i] = float(piece) if good[i] else 0.0
        good[i] &= bool(np.isfinite(value[i]))
    return value, good
