"""Words of a block and their numbers: which is given, from where it counts, within which limits it lies."""

from __future__ import annotations

from collections.abc import Iterable

from mnclab.controls.tnc_620.reading.words import LENGTHS
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import Words
from mnclab.machine.machine import INF, Machine
from mnclab.text.program import Word


def first(words: Words) -> Word | None:
    """The word that an alarm about the whole block points at."""
    return words.words[0] if words.words else None


def one_of(m: Machine, words: Words, addresses: Iterable[str], allowed: str) -> Word | None:
    """The word that is written of several that exclude each other."""
    given = [words[address] for address in addresses if address in words]
    if len(given) > 1:
        one, other = (str(word).rpartition(":")[2] for word in given[:2])
        m.alarm(f"{one} and {other} stand in one block: {allowed} is allowed", given[1])
    return given[0] if given else None


def counted(m: Machine, word: Word, before: float, unit: float = 1.0) -> float:
    """The value of a word, which is told in units of so many mm; an incremental one counts from `before`."""
    value = m.value(word) * unit
    return before + value if word.incremental else value


def written(m: Machine, word: Word, value: float) -> float:
    """A length in mm as the program writes it; what is no length stays."""
    in_units = word.address in LENGTHS and m.variable_unit != 1
    return float(f"{value / m.variable_unit:.12g}") if in_units else value


def above_zero(m: Machine, word: Word, name: str, most: float = INF) -> float:
    value = m.value(word)
    if not 0 < value <= most:
        limit = f" and at most {most:g}" if most < INF else ""
        m.alarm(f"{name} must be greater than 0{limit}, got {written(m, word, value):g}", word)
    return value


def not_negative(m: Machine, word: Word, name: str) -> float:
    value = m.value(word)
    if value < 0:
        m.alarm(f"{name} must be at least 0, got {written(m, word, value):g}", word)
    return value


def whole(m: Machine, word: Word, name: str, least: int, most: int) -> int:
    value = m.value(word)
    if value != int(value) or not least <= value <= most:
        m.alarm(f"{name} must be a whole number from {least} to {most}, got {value:g}", word)
    return int(value)


def warn_once(m: Machine, message: str, word: Word | None = None, hint: str = "") -> None:
    """A warning at the first of its places alone: what a program says in every block is not told for every block."""
    if message not in memory(m).told:
        memory(m).told |= {message}
        m.warn(message, word, hint)


def refuse_on_cylinder(m: Machine, words: Words) -> None:
    """An alarm where the contour of a cylinder is read, which has elements of its own (9.2)."""
    if memory(m).developed is not None:
        m.alarm(f"{words.code} cannot stand in the contour of a cylinder", first(words), "L, CHF, RND, CR and CT can")
