"""Trials side by side as a table: a row each, columns with titles, for people and as arrays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, Generic, TypeVar

import numpy as np

from mnclab.path.kinds import Kind
from mnclab.path.limits import Limits
from mnclab.path.profile import Profile
from mnclab.path.toolpath import Toolpath
from mnclab.text.tables import html_table

Titles = dict[
    str, tuple[str, str, Callable[[Any], Any]]
]  # of every column what it is, how it is written, and its value


@dataclass(frozen=True, eq=False, repr=False)
class Tried:
    """What is compared: a path under axis limits, or else with rapids at a rate in mm/min."""

    titles: ClassVar[Titles]
    name: str
    path: Toolpath
    limits: Limits | None
    rapid_rate: float

    @property
    def row(self) -> dict[str, Any]:
        return {name: value(self) for name, (_, _, value) in self.titles.items()}

    def __repr__(self) -> str:
        row, wide = self.row, max(len(title) for title, _, _ in self.titles.values())
        return "\n".join(f"{title:{wide}}  {form.format(row[name])}" for name, (title, form, _) in self.titles.items())

    @cached_property
    def time(self) -> float:
        """Seconds: by the feed-rate profile where axis limits are given, else length over feed."""
        if self.limits is not None:
            return Profile(self.path, self.limits).time
        feed = np.where(np.isinf(self.path.feed), self.rapid_rate, self.path.feed)
        return float((self.path.lengths / feed).sum() * 60)

    def length(self, rapid: bool) -> float:
        """Millimetres at rapid, or of everything else."""
        return float(self.path.lengths[(self.path.kind == Kind.RAPID) == rapid].sum())


Trial = TypeVar("Trial", bound=Tried)


class Table(Generic[Trial]):
    """Trials by number or by name."""

    titles: ClassVar[Titles]
    trials: tuple[Trial, ...]

    def __len__(self) -> int:
        return len(self.trials)

    def __getitem__(self, key: int | str) -> Trial:
        if not isinstance(key, str):
            return self.trials[key]
        for trial in self.trials:
            if trial.name == key:
                return trial
        raise KeyError(f"{key!r} was not compared; there are {', '.join(trial.name for trial in self.trials)}")

    @cached_property
    def rows(self) -> tuple[dict[str, Any], ...]:
        return tuple(trial.row for trial in self.trials)

    def columns(self) -> dict[str, np.ndarray]:
        """The table as arrays, for pandas, polars or matplotlib."""
        return {name: np.array([row[name] for row in self.rows]) for name in self.titles}

    def _lines(self) -> list[list[str]]:
        heads = [title for title, _, _ in self.titles.values()]
        return [heads, *([form.format(row[name]) for name, (_, form, _) in self.titles.items()] for row in self.rows)]

    def __repr__(self) -> str:
        lines = self._lines()
        wide = [max(map(len, column)) for column in zip(*lines, strict=True)]
        return "\n".join("  ".join(f"{text:>{w}}" for text, w in zip(line, wide)) for line in lines)

    def _repr_html_(self) -> str:
        head, *rows = self._lines()
        return html_table(head, rows, numbers=range(1, len(head)))
