"""Trials side by side as a table: a row each, columns with titles, for people and as arrays."""

from __future__ import annotations

from functools import cached_property
from typing import Any, ClassVar, Generic, Protocol, TypeVar

import numpy as np

from mnclab.text.tables import html_table


class Row(Protocol):
    """What is compared: it has a name, and values by the names of columns."""

    @property
    def name(self) -> str:
        """What it is called."""

    @property
    def row(self) -> dict[str, Any]:
        """The values of the columns."""


def told(row: dict[str, Any], titles: dict[str, tuple[str, str]]) -> str:
    """One row as a page: a title and its value a line."""
    wide = max(len(title) for title, _ in titles.values())
    return "\n".join(f"{title:{wide}}  {form.format(row[name])}" for name, (title, form) in titles.items())


Kind = TypeVar("Kind", bound=Row)


class Table(Generic[Kind]):
    """Trials by number or by name; `titles` says what every column is and how it is written."""

    titles: ClassVar[dict[str, tuple[str, str]]]
    trials: tuple[Kind, ...]

    def __len__(self) -> int:
        return len(self.trials)

    def __getitem__(self, key: int | str) -> Kind:
        if isinstance(key, str):
            found = [trial for trial in self.trials if trial.name == key]
            if not found:
                raise KeyError(f"{key!r} was not compared; there are {', '.join(t.name for t in self.trials)}")
            return found[0]
        return self.trials[key]

    @cached_property
    def rows(self) -> tuple[dict[str, Any], ...]:
        """One dict of the columns a trial."""
        return tuple(trial.row for trial in self.trials)

    def columns(self) -> dict[str, np.ndarray]:
        """The table as arrays, for pandas, polars or matplotlib."""
        return {name: np.array([row[name] for row in self.rows]) for name in self.titles}

    def _lines(self) -> list[list[str]]:
        heads = [title for title, _ in self.titles.values()]
        return [heads, *([form.format(row[name]) for name, (_, form) in self.titles.items()] for row in self.rows)]

    def __repr__(self) -> str:
        lines = self._lines()
        wide = [max(map(len, column)) for column in zip(*lines, strict=True)]
        return "\n".join("  ".join(f"{text:>{w}}" for text, w in zip(line, wide)) for line in lines)

    def _repr_html_(self) -> str:
        head, *rows = self._lines()
        return html_table(head, rows, numbers=range(1, len(head)))
