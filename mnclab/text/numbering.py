"""Numbers of blocks written anew: each in its place, and those that name them follow; nothing else of a text changes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from mnclab.text.alarm import Alarm


class Numbered(NamedTuple):
    """The digits of the number of a block: where they stand, and which they are; `length` 0 where they are to be put in.

    `counted` blocks after it have no number, and are counted on from it.
    """

    offset: int
    length: int
    old: str
    counted: int = 0


class Reference(NamedTuple):
    """Digits that name blocks. Each target is an index into the numbered blocks (-1: the beginning, which counts from 0),
    and how many to count on from there; `write` makes the digits of the new numbers."""

    offset: int
    length: int
    targets: tuple[tuple[int, int], ...]
    write: Callable[[Sequence[int]], str]


class Numbers(NamedTuple):
    """The numbers of a program and what names them; the first number and the step where the user says none.

    `before` blocks at the beginning have no number and are counted from 0.
    """

    blocks: Sequence[Numbered]
    references: Sequence[Reference] = ()
    first: int = 10
    step: int = 10
    before: int = 0


def renumbered(text: str, numbers: Numbers, first: int, step: int) -> str:
    """The text with new numbers: `first`, and so many more each time; over those that are counted a step is left out."""
    new: list[int] = []
    number = first
    while number < numbers.before:
        number += step
    for block in numbers.blocks:
        new.append(number)
        number += step * max(1, -(-(block.counted + 1) // step))
    changes = [(one.offset, one.length, _digits(one, value)) for one, value in zip(numbers.blocks, new, strict=True)]
    for reference in numbers.references:
        values = [(new[index] if index >= 0 else 0) + more for index, more in reference.targets]
        changes.append((reference.offset, reference.length, reference.write(values)))
    parts, at = [], 0
    for offset, length, digits in sorted(changes):
        parts += [text[at:offset], digits]
        at = offset + length
    return "".join([*parts, text[at:]])


def _digits(one: Numbered, value: int) -> str:
    """As wide as before where it was filled with zeros."""
    if not one.length:
        return f"{value} "
    return str(value).zfill(one.length) if one.old.startswith("0") and one.length > 1 else str(value)


def one_number(values: Sequence[int]) -> str:
    """The digits of a reference to one block."""
    return str(values[0])


def unknown(what: str, number: object) -> Alarm:
    """The Alarm about a number that names no block: after renumbering it could name one by chance."""
    hint = "correct it first: after renumbering it could name another block by chance"
    return Alarm(f"{what} names block {number}, which does not exist", hint=hint)
