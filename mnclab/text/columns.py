"""Columns of numbers as text, some rows at a time: the million rows of a long program are never a million objects."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import chain
from typing import Any

import numpy as np
from numpy.typing import NDArray

ROWS = 1 << 14  # that are written at a time


def parts(count: int) -> Iterator[slice]:
    """Slices that cover so many rows, `ROWS` each."""
    return (slice(first, min(first + ROWS, count)) for first in range(0, count, ROWS))


def filled(template: str, columns: Iterable[NDArray[Any]]) -> str:
    """A `template` for each row, whose every `%s` is the value of one of the `columns` (n,), not empty, as `str` writes it: of
    a float the shortest text that reads back as the same number."""
    varying, once = [], []
    count = 0
    for column in columns:
        count = len(column)
        alike = column.strides == (0,) or column.dtype.kind != "f" and bool((column == column[0]).all())
        once.append(str(column[:1].tolist()[0]).replace("%", "%%") if alike else "%s")
        varying += [] if alike else [column.tolist()]
    return template % tuple(once) * count % tuple(chain.from_iterable(zip(*varying)))


def spelled(names: Iterable[str], index: NDArray[np.integer[Any]]) -> NDArray[np.object_]:
    """The names (n,) that an index has."""
    return np.array([*names], dtype=object)[index]


# Two sets of columns in one order.

FEW = 1000  # stretches of rows that are copied one after the other


def merged(some: list[Any], others: list[Any], by: int) -> list[Any]:
    """Two sets of columns sorted together by one of them."""
    places = np.searchsorted(others[by], some[by])
    steps = np.diff(places, prepend=-1)
    cuts = np.flatnonzero(steps)  # where `some` goes on at another place of the others
    if len(cuts) <= FEW and (steps >= 0).all():  # whole stretches are copied faster than single rows
        return [_between(*pair, cuts, places[cuts]) for pair in zip(some, others, strict=True)]
    order = np.argsort(np.concatenate([some[by], others[by]]), kind="stable")
    return [np.concatenate(pair)[order] for pair in zip(some, others, strict=True)]


def _between(some: NDArray[Any], others: NDArray[Any], cuts: NDArray[Any], places: NDArray[Any]) -> NDArray[Any]:
    """Stretches of one column between those of another, which is used up: its own are moved where they are, from the last one
    on, because new memory would cost more than the work."""
    stretches, ends = np.split(some, cuts)[1:], [*places, len(others)][1:]
    others = others.astype(np.promote_types(some.dtype, others.dtype), copy=not others.flags.owndata)
    others.resize(len(others) + len(some), refcheck=False)
    for stretch, place, end, before in reversed([*zip(stretches, places, ends, cuts, strict=True)]):
        behind = before + len(stretch)
        others[place + behind : end + behind] = others[place:end]
        others[place + before : place + behind] = stretch
    return others
