"""Lines that begin with a letter of no number: the statement L of conversational programs."""

from __future__ import annotations

from mnclab.text.words import scan

TEXT = "L X+1 Y2\nL\nX1 L\n12 L X3\nL5 X1\nM X1\n"


def test_a_bare_letter_only_begins_a_line() -> None:
    found = scan(TEXT, leading_number=True, bare="L")
    assert found.clean.tolist() == [True, True, False, True, True, False, True]
    assert bytes(found.letter).decode() == "LXYLLXLX"
    assert found.value.tolist() == [0, 1, 2, 0, 0, 3, 5, 1]
    assert found.length.tolist() == [1, 3, 2, 1, 1, 2, 2, 2]


def test_without_it_such_lines_are_not_clean() -> None:
    assert scan(TEXT, leading_number=True).clean.tolist() == [False, False, False, False, True, False, True]
