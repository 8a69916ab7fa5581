"""The words that a misspelt one was meant to be; slips are counted by hand."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mnclab.text.alarm import ALIKE, SWAPPED, hint, nearest, slips_between


@pytest.mark.parametrize(
    ("one", "other", "slips"),
    [
        ("G83", "G83", 0), ("g83", "G83", 0), ("G83", "G38", SWAPPED), ("G83", "G3", 1), ("G8", "G83", 1),
        ("G84", "G83", 1), ("G8O", "G80", ALIKE), ("Gl", "G1", ALIKE), ("\u0425", "X", ALIKE), ("", "G1", 2), ("M3", "G4", 2),
        ("block_skp", "block_skip", 1), ("blokc_skip", "block_skip", SWAPPED), ("kitten", "sitting", 3),
    ],
)  # fmt: skip
def test_slips(one, other, slips):
    assert slips_between(one, other) == slips


word = st.text("GM0123", max_size=6)


@given(word, word, word)
def test_slips_are_symmetric_and_count_what_was_done(one, other, added):
    assert slips_between(one, other) == slips_between(other, one)
    assert abs(len(one) - len(other)) <= slips_between(one, other) <= max(len(one), len(other))
    assert slips_between(one, one + added) == len(added)


@given(word, st.lists(word, unique=True))
def test_the_nearest_come_first_and_nothing_nearer_is_left_out(wrong, known):
    found = nearest(wrong, known, 2, slips=2)
    distances = sorted(slips_between(wrong, one) for one in known if slips_between(wrong, one) <= 2)
    assert [slips_between(wrong, one) for one in found] == distances[:2]


def test_a_hint_names_them_or_is_empty():
    assert hint("G8O", ["G83", "G80"]) == "near: G80, G83" and hint("tool", ["datums"]) == ""


@given(word, word, st.sampled_from([1.0, 2.0, 3.5]))
def test_slips_beyond_a_bound_are_not_counted(one, other, most):
    every = slips_between(one, other)
    assert slips_between(one, other, most) in ((every,) if every <= most else (every, math.inf))


def test_a_word_that_stands_often_is_compared_once(monkeypatch):
    """Six hundred lines of a wrong code: the known codes are gone through once for it."""
    compared = []
    monkeypatch.setattr(
        "mnclab.text.alarm.slips_between", lambda *words: compared.append(words) or slips_between(*words)
    )
    known = [f"G{number}" for number in range(900)]
    assert len({hint("G4907", known) for _ in range(600)}) == 1 and 0 < len(compared) <= len(known)
