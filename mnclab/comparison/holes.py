"""The holes of two programs side by side: the same places and diameters, whatever the order and the heights."""

from __future__ import annotations

from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from mnclab.path.holes import Holes, places
from mnclab.path.listing import figure
from mnclab.path.toolpath import Array
from mnclab.text.alarm import several
from mnclab.text.tables import html_table, text_table

if TYPE_CHECKING:
    from mnclab.show.plot.picture import Picture

TOLERANCE = 0.001  # mm
HEAD = ("", "x, mm", "y, mm", "diameter, mm")
MOST = 20  # rows of a table in a notebook


@dataclass(frozen=True, eq=False, repr=False)
class HolesCompared:
    """Holes that both have and that only one has, rows (x, y, diameter) in mm; a table of these when shown."""

    names: tuple[str, str]
    both: Array
    only: tuple[Array, Array]
    tolerance: float
    reaches: tuple[str, str] = ("", "")

    @property
    def same(self) -> bool:
        """Whether both have the same holes; not known of a run that stopped before its end, so False."""
        return not any(map(len, self.only)) and not any(self.reaches)

    def __bool__(self) -> bool:
        """Whether they differ, or a run that stopped has not shown that they do not."""
        return not self.same

    def __len__(self) -> int:
        """How many holes only one of the two has."""
        return sum(map(len, self.only))

    @property
    def sentence(self) -> str:
        stops = "".join(f"; {name} {reach}" for name, reach in zip(self.names, self.reaches) if reach)
        if not any(map(len, self.only)):
            return (f"the same {several(len(self.both), 'hole')}" if len(self.both) else "no holes in either") + stops
        told = (f"{len(rows)} only in {name}" for rows, name in zip(self.only, self.names) if len(rows))
        return f"{several(len(self.both), 'hole')} in both, {', '.join(told)}{stops}"

    def rows(self) -> list[tuple[str, ...]]:
        """The holes that only one of the two has."""
        found = ((name, row) for name, rows in zip(self.names, self.only) for row in rows.tolist())
        return [(f"only in {name}", *(figure(value) for value in row)) for name, row in found]

    def __repr__(self) -> str:
        head = f"{self.names[0]} and {self.names[1]}: {self.sentence}"
        return f"{head}\n{text_table(HEAD, self.rows())}" if self.rows() else head

    def _repr_html_(self) -> str:
        rows = self.rows()
        table = html_table(HEAD, rows[:MOST], numbers=(1, 2, 3)) if rows else ""
        more = f"<p>{len(rows) - MOST} more: <code>.rows()</code></p>" if len(rows) > MOST else ""
        return f"<p>{escape(' and '.join(self.names))}: {escape(self.sentence)}</p>{table}{more}"

    def plot(self, **options: Any) -> Picture:
        """The holes from above at their diameters, told apart by what has them."""
        from mnclab.show.plot.holes import plot_holes

        return plot_holes(self, **options)


def compare_holes(one: Holes, other: Holes, names: tuple[str, str], tolerance: float = TOLERANCE) -> HolesCompared:
    """Which holes of one the other has too: centre and diameter within `tolerance` mm."""
    first, second = places(one), places(other)
    taken = np.zeros(len(second), dtype=bool)
    order = np.argsort(second[:, 0], kind="stable")
    across = second[order, 0]
    both = []
    for k, row in enumerate(first):
        near = order[np.searchsorted(across, row[0] - tolerance) : np.searchsorted(across, row[0] + tolerance, "right")]
        near = near[~taken[near]]
        fit = near[(np.hypot(*(second[near, :2] - row[:2]).T) <= tolerance) & (abs(second[near, 2] - row[2]) <= tolerance)]
        if len(fit):
            taken[fit[0]] = True
            both.append(k)
    found = np.isin(np.arange(len(first)), both)
    return HolesCompared(names, first[found], (first[~found], second[~taken]), tolerance, (one.reach, other.reach))
