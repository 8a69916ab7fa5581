"""The known words nearest to one that is not known, for hints: what the programmer probably meant.

Nearness is counted in slips of the hand: a character left out, added or exchanged is one slip, two neighbours in the
wrong order are a smaller one, and characters that look alike in print half of one. (A count of common characters, as of
difflib, calls G4 and G1 near G144.)
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import lru_cache

#: Cyrillic letters that look like Latin ones.
LATIN = dict(zip("АВСЕНКМОРТХУІавсенкмортхуі", "ABCEHKMOPTXYIabcehkmoptxyi", strict=True))
#: Letters that are taken for digits.
DIGITS = dict(zip("OoОоlI|ІіЗзб", "000011111336", strict=True))
SWAPPED, ALIKE = 0.75, 0.5  # slips
LONGEST = 40  # characters: a longer word is no slip of a known one, and would take long to compare


def nearest(word: str, known: Iterable[str], most: int = 3, slips: float | None = None) -> list[str]:
    """At most `most` known words within some slips of a word: one, and one more for every five characters beyond four.

    The nearest come first; of equally near ones those that share the longest beginning. Nothing is near a word of more
    than `LONGEST` characters.
    """
    return list(_nearest(word, tuple(known), most, slips)) if len(word) <= LONGEST else []


@lru_cache(4096)  # a wrong word often stands in many lines
def _nearest(word: str, known: tuple[str, ...], most: int, slips: float | None) -> tuple[str, ...]:
    allowed = slips if slips is not None else 1 + max(len(word) - 1, 0) // 5
    found = []
    for place, candidate in enumerate(known):
        if abs(len(word) - len(candidate)) > allowed:  # as many characters are too many or missing
            continue
        distance = slips_between(word, candidate, allowed)
        if distance <= allowed:
            shared = next((k for k, (a, b) in enumerate(zip(word, candidate, strict=False)) if a != b), len(word))
            found.append((distance, -shared, place, candidate))
    return tuple(candidate for *_, candidate in sorted(found)[:most])


def hint(word: str, known: Iterable[str], most: int = 3, slips: float | None = None) -> str:
    """The nearest known words as the hint of an alarm; empty if there are none."""
    near = nearest(word, known, most, slips)
    return f"near: {', '.join(near)}" if near else ""


def slips_between(one: str, other: str, most: float = math.inf) -> float:
    """How many slips make one word of the other, whatever the case of their letters.

    The least cost of making the first i characters of one the first j of the other, row by row (Damerau, Levenshtein).
    More than `most` are not counted to the end.
    """
    rows = [[float(j) for j in range(len(other) + 1)]]
    for i, a in enumerate(one, 1):
        row = [float(i)]
        for j, b in enumerate(other, 1):
            cost = min(rows[-1][j] + 1, row[-1] + 1, rows[-1][j - 1] + _exchanged(a, b))
            if i > 1 and j > 1 and a != b and _exchanged(a, other[j - 2]) == _exchanged(one[i - 2], b) == 0:
                cost = min(cost, rows[-2][j - 2] + SWAPPED)
            row.append(cost)
        if min(row) > most and min(rows[-1]) > most:  # later rows build on these two
            return math.inf
        rows.append(row)
    return rows[-1][-1]


def _exchanged(a: str, b: str) -> float:
    """The slips of writing one character for another."""
    if a.upper() == b.upper():
        return 0.0
    return ALIKE if LATIN.get(a, a) == LATIN.get(b, b) or DIGITS.get(a, a) == DIGITS.get(b, b) else 1.0
