"""Numbers of words: whole ones, and what depends on a decimal point."""

from __future__ import annotations

from mnclab.controls.word_address.motion import first_word
from mnclab.machine.control import Words
from mnclab.machine.machine import Machine
from mnclab.text.program import Word


def whole(m: Machine, words: Words, address: str, least: int, most: int) -> int:
    """A word of a block that is a whole number."""
    name = address if words.code == address else f"{words.code} {address}"
    if address not in words:
        m.alarm(f"{name} is missing", first_word(words))
    number = m.value(words[address])
    if number != int(number) or not least <= number <= most:
        m.alarm(f"{name} must be a whole number from {least} to {most}, got {number:g}", words[address])
    return int(number)


def written(m: Machine, word: Word) -> str:
    """A word of the running program as it stands there, without its address."""
    line, column, length, _ = word.span
    return m.flow.program.line_text(line)[column - 1 : column - 1 + length][len(word.address) :].strip()


def has_point(m: Machine, word: Word) -> bool:
    """Whether a word of the running program is written with a decimal point."""
    return "." in written(m, word)


def seconds_of_p(m: Machine, word: Word) -> float:
    """What 1 of a P that is a dwell stands for, s."""
    counted = m.settings["dwell_p"]
    if counted == "point":
        counted = "seconds" if has_point(m, word) else "milliseconds"
    return 1.0 if counted == "seconds" else 0.001
