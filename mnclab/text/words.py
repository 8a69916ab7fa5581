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

import numpy as np
from numpy.typing import NDArray

PIECE = 1 << 18
BLANK, LETTER, DIGIT, POINT, SIGN, END, OTHER = range(7)

_KIND = np.full(256, OTHER, dtype=np.uint8)
_KIND[[ord(c) for c in " \t"]] = BLANK
_KIND[[ord(c) for c in "\r\n"]] = END
_KIND[[ord(c) for c in "+-"]] = SIGN
_KIND[ord(".")] = POINT
_KIND[ord("0") : ord("9") + 1] = DIGIT
_KIND[ord("A") : ord("Z") + 1] = LETTER
_KIND[ord("a") : ord("z") + 1] = LETTER

_u8 = np.uint64
_ZEROS, _POINTS, _LOW, _HIGH = _u8(0x3030303030303030), _u8(0x2E2E2E2E2E2E2E2E), _u8(0x0101010101010101), _u8(0x8080808080808080)
_POWERS = 10.0 ** np.arange(23)


@dataclass(frozen=True)
class Scan:
    """Words of the clean lines, and which lines are clean.

    ``letter`` (w,) upper-case ASCII, ``value`` (w,), ``offset`` (w,) of the letter in the text, ``length`` (w,) in
    characters, ``line`` (w,) counted from 0; ``clean`` (l,); ``starts`` (l,) offsets of the lines.
    """

    letter: NDArray[np.uint8]
    value: NDArray[np.float64]
    offset: NDArray[np.int32]
    length: NDArray[np.int32]
    line: NDArray[np.int32]
    clean: NDArray[np.bool_]
    starts: NDArray[np.int32]


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
    data = characters(text)
    starts = line_starts(data)
    pieces = []
    first = 0
    while first < len(starts):
        begin = starts[first]
        after = int(np.searchsorted(starts, begin + PIECE, "right"))
        last = max(after - 1, first + 1) if after < len(starts) else len(starts)
        end = starts[last] if last < len(starts) else len(data)
        pieces.append(_scan_piece(data[begin:end], starts[first:last] - begin, int(begin), first, leading_number, bare))
        first = last
    letter, value, offset, length, line, clean = (np.concatenate(column) for column in zip(*pieces, strict=True))
    return Scan(letter, value, offset, length, line, clean, starts)


def _scan_piece(
    data: NDArray[np.uint8], starts: NDArray[np.int32], begin: int, first_line: int, leading_number: bool, bare: str
) -> tuple[NDArray, ...]:
    kind = _KIND[data]
    marks = np.flatnonzero((kind == LETTER) | (kind == END))
    is_letter = kind[marks] == LETTER
    at = marks[is_letter]
    after = np.append(marks, len(data))[1:][is_letter]

    # the number lies between the letter and the next one, blanks cut off at both ends
    begin_of = _skip_blanks(kind, at + 1, after)
    end_of = _drop_blanks(kind, begin_of, after)
    signed = (end_of > begin_of) & (kind[np.minimum(begin_of, len(data) - 1)] == SIGN)
    value, good = numbers(data, begin_of + signed, end_of)
    negative = signed & (data[np.minimum(begin_of, len(data) - 1)] == ord("-"))
    value = np.where(negative, -value, value)

    # a line is clean when all its words are good and no other character stands before the first of them
    line = np.searchsorted(starts, at, "right") - 1
    lines = len(starts)
    if bare:
        alone = (begin_of == end_of) & (np.diff(line, prepend=-1) != 0)
        alone &= np.isin(data[at] & 0xDF, [ord(letter) for letter in bare])
        value, good, end_of = np.where(alone, 0.0, value), good | alone, np.where(alone, at + 1, end_of)
    clean = np.ones(lines, dtype=bool)
    clean[line[~good]] = False
    ends = np.append(starts[1:], len(data))
    head = ends.copy()
    head[line[::-1]] = at[::-1]
    filled = np.concatenate([[0], np.cumsum((kind != BLANK) & (kind != END), dtype=np.int32)])
    before = filled[head] - filled[starts]
    if leading_number and before.any():
        digits = np.concatenate([[0], np.cumsum(kind == DIGIT, dtype=np.int32)])
        here = _skip_blanks(kind, starts.astype(np.int64), head.astype(np.int64))
        solid = (digits[head] - digits[starts] == before) & (digits[np.minimum(here + before, len(data))] - digits[here] == before)
        clean &= (before == 0) | solid
    else:
        clean &= before == 0
    keep = clean[line]
    return (
        data[at[keep]] & 0xDF,
        value[keep],
        (at[keep] + begin).astype(np.int32),
        (end_of - at)[keep].astype(np.int32),
        (line[keep] + first_line).astype(np.int32),
        clean,
    )


def _skip_blanks(kind: NDArray[np.uint8], at: NDArray[np.int64], end: NDArray[np.int64]) -> NDArray[np.int64]:
    """First place in [at, end) that is no blank."""
    blank = (at < end) & (kind[np.minimum(at, len(kind) - 1)] == BLANK)
    if not blank.any():
        return at
    solid = np.append(np.flatnonzero(kind != BLANK), len(kind))
    found = solid[np.searchsorted(solid, at[blank])]
    result = at.copy()
    result[blank] = np.minimum(found, end[blank])
    return result


def _drop_blanks(kind: NDArray[np.uint8], begin: NDArray[np.int64], end: NDArray[np.int64]) -> NDArray[np.int64]:
    """Last place after ``begin`` behind which [.., end) holds only blanks."""
    result = end.copy()
    todo = np.flatnonzero(result > begin)
    for _ in range(4):  # nearly always one blank
        todo = todo[kind[result[todo] - 1] == BLANK]
        result[todo] -= 1
        todo = todo[result[todo] > begin[todo]]
        if not len(todo):
            return result
    last = np.maximum.accumulate(np.where(kind != BLANK, np.arange(len(kind)), -1))
    result[todo] = np.maximum(last[result[todo] - 1] + 1, begin[todo])
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
