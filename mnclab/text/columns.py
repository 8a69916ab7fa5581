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
