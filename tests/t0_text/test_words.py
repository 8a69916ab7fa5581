"""Numbers found in bulk against Python's own float(), and the bulk reader against the one that reads line by line."""

import re

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import mnclab
from mnclab.text import words
from mnclab.text.words import line_starts, scan

digits = st.text("0123456789", min_size=1, max_size=20)
unsigned = st.one_of(
    digits,
    st.builds("{}.{}".format, digits, st.text("0123456789", max_size=20)),
    st.builds(".{}".format, digits),
)
decimal = st.builds("{}{}".format, st.sampled_from(["", "", "+", "-"]), unsigned)


@given(st.lists(decimal, min_size=1, max_size=40))
@example(["9007199254740993", "9007199254740992.5", "0.1", "12345678", "123456789", "1234567.8", "00000000.1", "-0"])
@example(["99999999999999999999.99999999999999999999", ".00000000000000000001", "179769313486231570000", "8."])
def test_every_decimal_is_the_float_that_python_reads(numbers):
    found = scan("X" + " Y".join(numbers))
    assert found.clean.tolist() == [True]
    assert found.value.tolist() == [float(number) for number in numbers]
    assert np.signbit(found.value).tolist() == [number.startswith("-") for number in numbers]
    assert bytes(found.letter).decode() == "X" + "Y" * (len(numbers) - 1)
    assert found.length.tolist() == [1 + len(number) for number in numbers]


@pytest.mark.parametrize(
    "word",
    [
        *("", ".", "+", "-", "+.", "-.", "--1", "+-1", "1-", "1+", "1.2.3", "..1", "1..", "1,5", "1 5", "- 5", ". 5"),
        *("1_000", "5\u00a0", "\u0665", "1\0", "1/2", "1e", "9" * 400, "9" * 1_000_000),
    ],
)  # fmt: skip
def test_what_is_no_number_leaves_its_line_to_the_reader(word):
    found = scan(f"Y1\nX{word}\nZ2\n")
    assert found.clean.tolist() == [True, False, True, True]
    assert bytes(found.letter) == b"YZ"


@pytest.mark.parametrize("blanks", [" ", "\t", " \t ", " " * 9, " " * 50_000])
def test_blanks_between_and_inside_words(blanks):
    text = f"{blanks}X{blanks}-1.5{blanks}y{blanks}2{blanks}\nZ3"
    found = scan(text)
    assert found.value.tolist() == [-1.5, 2, 3]
    assert found.offset.tolist() == [text.index("X"), text.index("y"), text.index("Z")]
    lengths = [len(blanks) + len("X-1.5"), len(blanks) + len("y2"), len("Z3")]
    assert found.length.tolist() == [min(length, 32767) for length in lengths]


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_line_ends(end):
    text = end.join(["X1", "", "Y2", "Z3"]) + end
    found = scan(text)
    assert found.lines_of(found.letter > 0).tolist() == [0, 2, 3]
    starts = line_starts(words.characters(text))
    assert starts.tolist() == [0, 2 + len(end), 2 + 2 * len(end), 4 + 3 * len(end), 6 + 4 * len(end)]


good_words = st.tuples(st.sampled_from("GXYZIJKRFSTMxyzgn"), st.sampled_from(["", " ", "\t"]), decimal).map("".join)
line = st.lists(good_words, max_size=5).flatmap(
    lambda found: st.sampled_from([" ", "", "  "]).map(lambda blank: blank.join(found))
)
labelled = st.tuples(st.sampled_from(["", "N10", "n5 ", "N0", "N1.5 ", "N-2", "N99999999999 "]), line).map("".join)
odd = st.sampled_from(
    ["/X5", "X1 Y", "// text", "X1,5", "(", "\ufeffX1", "Ж", "X1 N7", "", "  ", "N" + "9" * 400, "X" + "9" * 400]
)


LOOKS = re.compile(r"this looks like [^;]*(; |$)")


def as_read(program):
    """Everything a reader says of a program, comments left out, and what it looks like, of which comments are a sign."""
    blocks = [(b.number, b.skip, b.words, b.span[:2]) for b in program]
    return blocks, [(a.message, LOOKS.sub("", a.hint), a.severity, a.span) for a in program.alarms]


@given(st.lists(st.one_of(labelled, labelled, odd), max_size=12), st.sampled_from(["\n", "\r\n", "\r"]))
def test_both_readers_read_the_same(lines, end):
    """A comment sends a line to the reader that goes word by word; lines without words have no block either way."""
    plain = mnclab.read(end.join(lines) + end, "mnc")
    slow = mnclab.read(end.join(text if not text.strip() else f"{text} // slow" for text in lines) + end, "mnc")
    blocks, alarms = as_read(plain)
    slow_blocks, slow_alarms = as_read(slow)
    assert blocks == slow_blocks
    assert alarms == slow_alarms


@given(st.lists(st.one_of(labelled, odd), min_size=1, max_size=12), st.integers(1, 40))
def test_the_size_of_a_piece_does_not_show(lines, size):
    text = "\n".join(lines)
    whole, kept = scan(text), words.PIECE
    try:
        words.PIECE = size
        pieces = scan(text)
    finally:
        words.PIECE = kept
    for name in ("letter", "value", "offset", "length", "count", "clean", "starts"):
        assert np.array_equal(getattr(whole, name), getattr(pieces, name)), name


@pytest.mark.parametrize("end", [" \r\n", "\t \r\n", "\r", "\r\n\r\n"])
def test_blanks_before_a_line_end_belong_to_no_word(end):
    found = scan(f"X1{end}Y-2.5  Z3{end}M{end}")
    assert found.value.tolist() == [1, -2.5, 3]
    assert found.length.tolist() == [2, 5, 2]
    assert found.clean.sum() == len(found.clean) - 1
