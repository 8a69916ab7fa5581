"""Letters and numbers of a whole text, found at once with numpy.

A *clean* line holds nothing but words of one letter and one number (`N10 G1X-2.5 y+03.`), blanks between them or not.
Such lines are most of any long program, and `scan` reads them at several million words a second; every other
line is left to the reader of the control, which words the alarms. The method: the eight characters before the end of
a number are one machine word, the point is squeezed out of it, three multiplications join the digits, and a division
by an exact power of ten rounds as `float()` does.

The text is worked in pieces of some 256 KiB, which stay in the processor's cache.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]
Offsets = NDArray[np.int32]
Places = NDArray[np.int64]
Values = NDArray[np.float64]
Mask = NDArray[np.bool_]

PIECE = 1 << 18
BLANK, DIGIT, END, OTHER = range(4)

_KIND = np.full(256, OTHER, dtype=np.uint8)
_KIND[[ord(c) for c in " \t"]] = BLANK
_KIND[[ord(c) for c in "\r\n"]] = END
_KIND[ord("0") : ord("9") + 1] = DIGIT

_u8 = np.uint64
_ZEROS, _BIT_OF_POINT, _HIGH = _u8(0x3030303030303030), _u8(0x1010101010101010), _u8(0x8080808080808080)
_POWERS = 10.0 ** np.arange(23)
_KEEP = np.array([(2**64 - 1) >> 8 * k << 8 * k for k in range(8, -1, -1)], dtype=np.uint64)  # by number of characters
_POWER_OF_POINT = np.ones(65)  # by the number of bits below the point in a machine word
_POWER_OF_POINT[0:64:8] = _POWERS[7::-1]


@dataclass(frozen=True)
class Scan:
    """Words of the clean lines, and which lines are clean.

    `letter` (w,) upper-case ASCII, `value` (w,), `offset` (w,) of the letter in the text, `length` (w,) in
    characters; `count` (l,) words of each line, 0 where it is not clean; `clean` (l,); `starts` (l,) offsets of the
    lines; `indented` whether any of them begins with a blank.
    """

    letter: Bytes
    value: Values
    offset: Offsets
    length: NDArray[np.int16]
    count: Offsets
    clean: Mask
    starts: Offsets
    indented: bool

    def without(self, lines: Mask) -> Scan:
        """The same, but that some lines (l,) are not clean."""
        keep = np.repeat(~lines, self.count)
        return replace(
            self, letter=self.letter[keep], value=self.value[keep], offset=self.offset[keep], length=self.length[keep],
            count=np.where(lines, 0, self.count).astype(np.int32), clean=self.clean & ~lines,
        )  # fmt: skip

    def lines_of(self, words: Mask) -> Places:
        """The lines, from 0, of the words that a mask (w,) marks."""
        return np.searchsorted(np.cumsum(self.count), np.flatnonzero(words), "right")


def line_starts(data: Bytes) -> Offsets:
    """Offsets of the lines of a text; a line ends with LF, CR LF or CR."""
    return np.concatenate([[0], np.flatnonzero(_line_ends(data)) + 1]).astype(np.int32)


def _line_ends(data: Bytes) -> Mask:
    ends = data == 10
    if (returns := data == 13).any():
        returns[:-1] &= data[1:] != 10  # of CR LF only the second is an end
        ends |= returns
    return ends


def characters(text: str) -> Bytes:
    """One byte a character: ASCII as it is, everything else as `?`, so that offsets stay those of the text."""
    return np.frombuffer(text.encode("ascii", errors="replace"), dtype=np.uint8)


def scan(text: str, leading_number: bool = False, bare: str = "") -> Scan:
    """Find the words of all clean lines.

    `leading_number`: digits may stand before the first letter. `bare`: letters that may begin a line without a
    number of their own, alone (`L X+1`); such a word has the value 0.
    """
    # room for as many words as fit: memory that is never touched costs nothing, what is touched costs more than the work
    most = len(text) // 2 + 1
    columns: list[NDArray[Any]] = [np.empty(most, dtype=kind) for kind in (np.uint8, np.float64, np.int32, np.int16)]
    starts, counts, cleans = list[Offsets](), list[Offsets](), list[Mask]()
    begin = found = 0
    indented = False
    while begin < len(text) or not starts:
        end = _end_of_piece(text, begin)
        piece = _Piece(characters(text[begin:end]), leading_number, bare)
        lines = len(piece.starts) - (end < len(text))  # the last one begins with the next piece
        words = piece.words()
        stop = found + len(words[0])
        for column, part in zip(columns, words, strict=True):
            column[found:stop] = part
        columns[2][found:stop] += begin
        indented |= bool((_KIND[piece.padded[piece.starts + 8]] == BLANK).any())
        starts.append((piece.starts[:lines] + begin).astype(np.int32))
        counts.append((piece.count * piece.clean)[:lines].astype(np.int32))
        cleans.append(piece.clean[:lines])
        found, begin = stop, end
    for column in columns:
        column.resize(found, refcheck=False)  # gives back what was not needed
    letter, value, offset, length = columns
    count, clean = np.concatenate(counts), np.concatenate(cleans)
    return Scan(letter, value, offset, length, count, clean, np.concatenate(starts), indented)


def _end_of_piece(text: str, begin: int) -> int:
    """Where the piece that begins at `begin` ends: behind the last line end within reach, or behind the first one."""
    if begin + PIECE >= len(text):
        return len(text)
    last = max(text.rfind("\n", begin, begin + PIECE), text.rfind("\r", begin, begin + PIECE - 1))
    if last < 0:
        ends = [k for k in (text.find("\n", begin + PIECE), text.find("\r", begin + PIECE)) if k >= 0]
        if not ends:
            return len(text)
        last = min(ends)
    return last + 2 if text[last : last + 2] == "\r\n" else last + 1


class _Piece:
    """The words of some whole lines.

    Nearly every word is a letter, at once its number, and then one blank or the end of the line; all are read as if
    they were. Those that come out wrong are looked at again with care.
    """

    def __init__(self, data: Bytes, leading_number: bool, bare: str) -> None:
        self.data = data
        marks = np.flatnonzero((((data | 0x20) - 97) < 26) | _line_ends(data))
        marked = data[marks]
        newline = np.flatnonzero(marked <= 13)
        self.starts = np.concatenate([[0], marks[newline] + 1])
        self.count = np.diff(newline, prepend=-1, append=len(marks)) - 1  # words of each line
        is_letter = marked > 13
        self.at = marks[is_letter]
        self.letter = marked[is_letter] & 0xDF
        self.words_before = np.concatenate([[0], np.cumsum(self.count)])
        self.filled = np.flatnonzero(self.count)  # lines with words
        after = np.append(self.at, len(data))[1:]
        after[self.words_before[self.filled + 1] - 1] = np.append(marks[newline], len(data))[self.filled]
        self.value, self.end = self.read(after, bare)
        self.clean = self.clean_lines(leading_number, bare)

    def read(self, after: Places, bare: str) -> tuple[Values, Places]:
        """Values and ends of the words, each before `after`; nan where there is no number, end 0 where there is nothing."""
        self.padded = padded = _padded(self.data)
        first, last = padded[self.at + 9], padded[after + 7]
        negative = first == 45
        begin = self.at + 1 + (negative | (first == 43))
        end = after - ((last == 32) | (last == 9) | (last == 13))
        value, good = numbers(self.data, begin, end, padded)
        if bare:  # mostly the letter and one blank
            heads = self.words_before[self.filled]
            alone = (end[heads] == self.at[heads] + 1) & (end[heads] < after[heads])
            heads = heads[alone & np.isin(self.letter[heads], [ord(letter) for letter in bare])]
            value[heads], good[heads] = 0.0, True
        if not good.all():
            odd = np.flatnonzero(~good)
            begin = _skip_blanks(self.data, self.at[odd] + 1, after[odd])
            end[odd] = _drop_blanks(self.data, begin, after[odd])
            first = padded[begin + 8]
            negative[odd] = (first == 45) & (end[odd] > begin)
            signed = negative[odd] | ((first == 43) & (end[odd] > begin))
            value[odd], good = numbers(self.data, begin + signed, end[odd], padded)
            value[odd[~good]] = np.nan
            end[odd[begin == end[odd]]] = 0
        value.view(np.uint64)[:] ^= negative.astype(np.uint64) << _u8(63)  # the bit of the sign
        return value, end

    def clean_lines(self, leading_number: bool, bare: str) -> Mask:
        """Which lines have only good words, and no other character before the first of them."""
        odd = np.flatnonzero(np.isnan(self.value))
        if bare and len(odd):
            first = self.words_before[np.searchsorted(self.words_before, odd, "right") - 1] == odd
            first &= np.isin(_KIND[self.padded[self.at[odd] + 9]], (BLANK, END))
            alone = odd[first & (self.end[odd] == 0) & np.isin(self.letter[odd], [ord(letter) for letter in bare])]
            self.value[alone], self.end[alone] = 0.0, self.at[alone] + 1
            odd = np.flatnonzero(np.isnan(self.value))
        clean = np.ones(len(self.starts), dtype=bool)
        clean[np.searchsorted(self.words_before, odd, "right") - 1] = False
        head = np.append(self.starts[1:], len(self.data))
        head[self.filled] = self.at[self.words_before[self.filled]]
        clean[~_clean_heads(self.data, self.padded, self.starts, head, leading_number)] = False
        return clean

    def words(self) -> tuple[NDArray[Any], ...]:
        """Letter, value, offset and length of the words of the clean lines."""
        columns = self.letter, self.value, self.at, np.minimum(self.end - self.at, 32767)
        if self.clean.all():
            return columns
        keep = np.repeat(self.clean, self.count)
        return tuple(column[keep] for column in columns)


def _padded(data: Bytes) -> Bytes:
    """The text between eight blanks before it and a line end behind it; a slash, which `numbers` would take for a
    one, is replaced."""
    padded = np.empty(len(data) + 9, dtype=np.uint8)
    padded[:8], padded[8:-1], padded[-1] = 32, data, 10
    if (slash := padded == 47).any():
        padded[slash] = 63
    return padded


def _clean_heads(data: Bytes, padded: Bytes, starts: Places, head: Places, leading_number: bool) -> Mask:
    """Which lines have only blanks, or with `leading_number` one whole number, before `head`, their first letter."""
    first = _KIND[padded[starts + 8]]
    good = (head == starts) | ((head == starts + 1) & ((first == BLANK) | (first == END)))
    if leading_number:  # mostly the number and one blank
        end = head - (padded[head + 7] == 32)
        size = end - starts
        digits = np.ndarray((len(data) + 1,), dtype="<u8", buffer=padded, strides=(1,))[end] ^ _ZEROS
        digits &= _KEEP.take(size, mode="clip")
        good |= (size <= 8) & (((digits + _u8(0x7676767676767676) | digits) & _HIGH) == 0)
    if not good.all():
        odd = np.flatnonzero(~good)
        good[odd] = _clean_odd_heads(data, starts[odd], head[odd], leading_number)
    return good


def _clean_odd_heads(data: Bytes, starts: Places, head: Places, leading_number: bool) -> Mask:
    """The same for any blanks before and after the number."""
    kind = _KIND[data]
    filled = np.concatenate([[0], np.cumsum((kind != BLANK) & (kind != END), dtype=np.int32)])
    before = filled[head] - filled[starts]
    if not leading_number or not before.any():
        return before == 0
    digits = np.concatenate([[0], np.cumsum(kind == DIGIT, dtype=np.int32)])
    here = _skip_blanks(data, starts.astype(np.int64), head.astype(np.int64))
    there = np.minimum(here + before, len(data))
    return (before == 0) | ((digits[head] - digits[starts] == before) & (digits[there] - digits[here] == before))


def _blank(data: Bytes, at: Places | slice) -> Mask:
    """Blank, tab, or the CR of a line end CR LF."""
    character = data[at]
    return (character == 32) | (character == 9) | (character == 13)


def _skip_blanks(data: Bytes, at: Places, end: Places) -> Places:
    """First place in [at, end) that is no blank."""
    blank = (at < end) & _blank(data, np.minimum(at, len(data) - 1))
    if not blank.any():
        return at
    solid = np.append(np.flatnonzero(~_blank(data, slice(None))), len(data))
    found = solid[np.searchsorted(solid, at[blank])]
    result = at.copy()
    result[blank] = np.minimum(found, end[blank])
    return result


def _drop_blanks(data: Bytes, begin: Places, end: Places) -> Places:
    """Last place after `begin` behind which [.., end) holds only blanks."""
    result = end - ((end > begin) & _blank(data, end - 1))  # nearly always one
    todo = np.flatnonzero((result > begin) & _blank(data, result - 1))
    if len(todo):
        solid = np.maximum.accumulate(np.where(_blank(data, slice(None)), -1, np.arange(len(data))))
        result[todo] = np.maximum(solid[result[todo] - 1] + 1, begin[todo])
    return result


def numbers(data: Bytes, begin: Places, end: Places, padded: Bytes) -> tuple[Values, Mask]:
    """Values of the unsigned decimal numbers in [begin, end) and which of them are numbers at all."""
    size = end - begin
    window = np.ndarray((len(data) + 1,), dtype="<u8", buffer=padded, strides=(1,))  # the eight characters before a place
    total, below, has_point, good = _eight_digits(window[end], size)
    good &= size > has_point
    value = total.astype(np.float64)
    value /= _POWER_OF_POINT[below]
    if (long := size > 8).any():
        value[long], good[long] = _long_numbers(data, begin[long], end[long], window)
    return value, good


def _eight_digits(word: NDArray[np.uint64], size: Places) -> tuple[NDArray[np.int64], NDArray[np.uint8], Mask, Mask]:
    """Of the last `size` characters of eight: the number without its point, how many bits are below the point, whether
    there is one, and whether all else are digits."""
    word ^= _ZEROS
    word &= _KEEP.take(size, mode="clip")  # a byte for each digit, 0 … 9; a point is 0x1E, nothing else becomes that
    point = word & _BIT_OF_POINT
    has_point = point != 0
    point &= np.negative(point)  # the first one: whatever stays of another is no digit
    point >>= _u8(4)
    word -= (point << _u8(5)) - (point << _u8(1))
    wrong = word + _u8(0x7676767676767676)
    wrong |= word
    wrong &= _HIGH
    below = point - _u8(1)
    bits = np.bitwise_count(below)
    np.minimum(below, point, out=below)  # nothing where there is no point
    below &= word
    word += (below << _u8(8)) - below  # the digits before the point move up by one
    word *= _u8(2561)
    word >>= _u8(8)
    word &= _u8(0x00FF00FF00FF00FF)
    word *= _u8(6553601)
    word >>= _u8(16)
    word &= _u8(0x0000FFFF0000FFFF)
    word *= _u8(42949672960001)
    word >>= _u8(32)
    return word.view(np.int64), bits, has_point, wrong == 0


def _long_numbers(data: Bytes, begin: Places, end: Places, window: NDArray[np.uint64]) -> tuple[Values, Mask]:
    """Numbers of more than eight characters, in two halves; beyond what a double holds exactly, one by one."""
    size = end - begin
    upper, bits, point, good = _eight_digits(window[end - 8], size - 8)
    lower, low_bits, low_point, low_good = _eight_digits(window[end], np.full(len(size), 8))
    good &= low_good & ~(point & low_point)
    total = upper * np.where(low_point, 10**7, 10**8) + lower
    value = total / (np.where(point, _POWERS[8], 1.0) * _POWER_OF_POINT[np.where(low_point, low_bits, bits)])
    for i in np.flatnonzero((size > 16) | (total >= 2**53)):
        piece = data[begin[i] : end[i]].tobytes()
        good[i] = len(piece) < 400 and piece.replace(b".", b"", 1).isdigit()
        value[i] = float(piece) if good[i] else 0.0
        good[i] &= bool(np.isfinite(value[i]))
    return value, good
