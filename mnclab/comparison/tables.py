"""Trials side by side as a table, a row each."""

from __future__ import annotations

from collections.abc import Callable, Collection
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, Generic, TypeVar

import numpy as np

from mnclab.path.limits import Limits
from mnclab.path.profile import Profile
from mnclab.path.toolpath import Kind, Toolpath
from mnclab.text.alarm import Alarm, hint
from mnclab.text.given import choice, shown
from mnclab.text.tables import Listing, Pictured, data_frame

Titles = dict[str, tuple[str, str, Callable[[Any], Any]]]  # of every column what it is, how it is written, and its value


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
        """Every column by its name, but those of which nothing is known."""
        known = ((name, value(self)) for name, (_, _, value) in self.titles.items())
        return {name: value for name, value in known if value is not None}

    def __repr__(self) -> str:
        row, wide = self.row, max(len(title) for title, _, _ in self.titles.values())
        said = ((*self.titles[name][:2], value) for name, value in row.items())
        return "\n".join(f"{title:{wide}}  {form.format(value)}" for title, form, value in said)

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


One = TypeVar("One", bound=Tried)


MORE = ("covered", "removed", "removal")  # columns of which more is better


class Table(Pictured, Listing, Generic[One]):
    """Trials by number or by name."""

    titles: ClassVar[Titles]
    trials: tuple[One, ...]

    def __len__(self) -> int:
        return len(self.trials)

    def __getitem__(self, key: int | str) -> One:
        if not isinstance(key, str):
            return self.trials[key]
        for trial in self.trials:
            if trial.name == key:
                return trial
        raise KeyError(f"{key!r} was not compared; there are {', '.join(trial.name for trial in self.trials)}")

    @cached_property
    def rows(self) -> tuple[dict[str, Any], ...]:
        return tuple(trial.row for trial in self.trials)

    @property
    def told(self) -> Titles:
        """The columns of which something is known."""
        return {name: told for name, told in self.titles.items() if all(name in row for row in self.rows)}

    def only(self, *columns: str) -> Table[One]:
        """The same table with these columns alone (`columns()` lists their names)."""
        found = copy(self)
        vars(found)["titles"] = {name: self.titles[name] for name in (choice(each, "a column", self.titles) for each in columns)}
        return found

    def columns(self) -> dict[str, np.ndarray]:
        """The table as arrays, for pandas, polars or matplotlib."""
        return {name: np.array([row[name] for row in self.rows]) for name in self.told}

    def to_pandas(self) -> Any:
        """The table as a data frame of pandas, its titles as columns."""
        return data_frame(dict(zip(self.head, self.columns().values())))

    def best(self, by: str = "time") -> One:
        """The trial with the least value in a column: its name (`columns()` lists them) or its title; the greatest where more
        is better, as of what is covered and removed."""
        titled = {title: name for name, (title, _, _) in self.titles.items()}
        name = titled.get(by, by)
        value = self.titles[name][2] if name in [*self.titles][1:] else lambda trial: None
        values: list[Any] = [value(trial) for trial in self.trials]
        if None in values:
            names = [*self.told][1:]
            near = hint(str(by)[:40], names, 1)
            raise Alarm(f"trials are compared by {', '.join(names)}; got {shown(by)}", hint=near)
        return self.trials[values.index(max(values) if name in MORE else min(values))]

    @property
    def head(self) -> tuple[str, ...]:
        return tuple(title for title, _, _ in self.told.values())

    def texts(self) -> list[tuple[str, ...]]:
        """What the table says, row by row, the numbers as they are shown."""
        return [tuple(form.format(row[name]) for name, (_, form, _) in self.told.items()) for row in self.rows]

    def table(self) -> tuple[tuple[str, ...], list[tuple[str, ...]], Collection[int]]:
        """Titles, rows of texts, and which columns are numbers."""
        return self.head, self.texts(), range(1, len(self.told))
