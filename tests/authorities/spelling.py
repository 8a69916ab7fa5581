"""The same line of an ISO program written otherwise: letters, blanks, zeros, points, signs, comments."""

from __future__ import annotations

import random
import re

_WORD = re.compile(r"([A-Z])(-?)(\d*)(\.\d+)?(?=\s|$)")


def spelled(line: str, rng: random.Random) -> str:
    """One of the many spellings of a line."""
    if "[" in line or "#" in line or rng.random() < 0.4:
        return line
    if rng.random() < 0.6:
        line = " ".join(word(part, rng) for part in line.split())
    if rng.random() < 0.3:
        line = line.replace(" ", rng.choice(("", "  ", "\t")))
    if rng.random() < 0.2:
        line = line.lower()
    if rng.random() < 0.2:
        line += rng.choice((" (a comment)", " ; a comment", "(G0 X1)"))
    return line


def word(text: str, rng: random.Random) -> str:
    """A word: G0 as G00, X5 as X5., X+5 or X05.0."""
    found = _WORD.fullmatch(text)
    if found is None:
        return text
    letter, sign, whole, fraction = found.group(1), found.group(2), found.group(3), found.group(4) or ""
    if letter in "GM":
        return f"{letter}{whole:0>2}{fraction}"
    if letter in "NPLOSTHD":
        return text
    sign = sign or rng.choice(("", "+"))
    if fraction:
        return f"{letter}{sign}{'' if whole == '0' else whole}{fraction}{'0' * rng.randint(0, 2)}"
    return f"{letter}{sign}{'0' * rng.randint(0, 1)}{whole}{rng.choice(('', '.', '.0'))}"
