"""Trials side by side as a table: a row each, columns with titles, for people and as arrays."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

import numpy as np

from mnclab.path.limits import Limits
from mnclab.path.profile import Profile
from mnclab.path.toolpath import Kind, Toolpath
from mnclab.text.alarm import Alarm, hint
from mnclab.text.file import replaced
from mnclab.text.given import shown
from mnclab.text.opening import require
from mnclab.text.tables import csv_text, html_table

if TYPE_CHECKING:
    from mnclab.show.plot.picture import Picture

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


MORE = ("covered", "removed", "removal")  # columns of which more is better
SUFFIXES = (".csv", ".svg", ".pdf", ".png")


class Table(ABC, Generic[Trial]):
    """Trials by number or by name."""

    titles: ClassVar[Titles]
    trials: tuple[Trial, ...]

    @abstractmethod
    def plot(self, **options: Any) -> Picture:
        """The trials side by side."""

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

    def to_pandas(self) -> Any:
        """The table as a data frame of pandas, its titles as columns."""
        require("pandas", "data frames", "pandas", instead="columns() needs nothing")
        import pandas

        return pandas.DataFrame({title: self.columns()[name] for name, (title, _, _) in self.titles.items()})

    def best(self, by: str = "time") -> Trial:
        """The trial with the least value in a column: its name (`columns()` lists them) or its title; the greatest where more
        is better, as of what is covered and removed."""
        names = list(self.titles)[1:]
        titled = {title: name for name, (title, _, _) in self.titles.items()}
        if titled.get(by, by) not in names:
            near = hint(str(by)[:40], names, 1)
            raise Alarm(f"trials are compared by {', '.join(names)}; got {shown(by)}", hint=near)
        name = titled.get(by, by)
        values = [row[name] for row in self.rows]
        return self.trials[values.index(max(values) if name in MORE else min(values))]

    def save(self, path: str | Path, **options: Any) -> Path:
        """Write the table (.csv) or the picture (.svg, .pdf, .png); `options` are those of `plot`."""
        if not isinstance(path, str | Path):
            raise Alarm(f"a file is written to a path, got {shown(path)}")
        path = Path(path)
        suffix = path.suffix.lower()
        if suffix not in SUFFIXES or options and suffix == ".csv":
            known = f"{', '.join(SUFFIXES[1:])} (the picture)"
            raise Alarm(f"a comparison is saved as .csv (the table, without options), {known}; got {path.name!r}")
        with replaced(path) as beside:
            if suffix == ".csv":
                beside.write_text(self.csv(), "utf-8", newline="")
            else:
                self._write_picture(beside, options)
        return path

    def _write_picture(self, path: Path, options: dict[str, Any]) -> None:
        from mnclab.show.plot.picture import write

        write(self.plot(**options), path)

    def csv(self) -> str:
        """The table as comma-separated values, its titles first, the numbers as they are shown."""
        return csv_text(*self._lines())

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
