"""Checks that are made together: none is left out, each that fails is named, and fixtures come through."""

import pytest
from tools.together import together

SEEN = []


@together("number half", [(2, 1), (3, 1), (4, 3), (5, 2), (6, 3)], lambda number, half: "odd" if number % 2 else "even")
def halves(number, half):
    SEEN.append(number)
    assert number == 2 * half


@together("text", ["1", "a", "2"], lambda text: "all", lambda text: f"text {text}")
def numbers(text, where):
    assert int(text) and where


def test_every_case_is_checked_and_those_that_fail_are_listed():
    SEEN.clear()
    with pytest.raises(pytest.fail.Exception) as raised:
        halves("even")
    head, *wrong = str(raised.value).splitlines()
    assert SEEN == [2, 4, 6] and head == "1 of 3 in even:"
    assert wrong[0].startswith("4 3: line 12: ") and sum(": line" in line for line in wrong) == 1
    with pytest.raises(pytest.fail.Exception, match="2 of 2 in odd"):
        halves("odd")


def test_what_is_raised_is_told_with_the_name_of_its_case():
    with pytest.raises(pytest.fail.Exception, match="1 of 3 in all:\ntext a: line 17: ValueError: invalid literal"):
        numbers("all", where="here")


@together("number", [1, 2, 3], lambda number: f"below {number // 3 * 3 + 3}")
def test_fixtures_come_through(number, tmp_path):
    assert tmp_path.is_dir() and number
