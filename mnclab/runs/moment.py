"""One moment of a run: the machine after a block, or on the way through it."""

from __future__ import annotations

from html import escape
from textwrap import wrap
from typing import Any, NamedTuple

import numpy as np

from mnclab.path.listing import point
from mnclab.runs.values import said
from mnclab.text.program import Block
from mnclab.text.tables import html_table

WIDTH, SHOWN = 100, 60  # characters of a line; values that are listed


class Moment(NamedTuple):
    """The machine after one step: the block, the programmed point (program coordinates, mm), what was active and what
    the block changed; `rows` are the rows of the toolpath that it made.

    A moment inside a block (`Run.when`) has the row of the toolpath, the share of it (0 to 1) that was done, and
    the tool tip there, mm; -1 for a row where the block moved nothing.
    """

    step: int
    line: int
    block: Block
    position: tuple[float, float, float]
    state: dict[str, Any]
    changed: dict[str, Any]
    rows: slice
    row: int = -1
    share: float = 1.0
    point: tuple[float, float, float] = (0.0, 0.0, 0.0)

    def page(self) -> list[tuple[str, str]]:
        first, stop = self.rows.start, self.rows.stop
        rows = "none" if first == stop else f"{first}" if stop == first + 1 else f"{first} to {stop - 1}"
        inside = f", {100 * self.share:.4g} % of row {self.row}" if self.share != 1 else ""
        return [
            ("programmed point", point(np.array(self.position))),
            ("tool tip", point(np.array(self.point))),
            ("rows of the path", rows + inside),
            ("changed", _listed(self.changed)),
            ("active", _listed({name: value for name, value in self.state.items() if name not in self.changed})),
        ]

    def __repr__(self) -> str:
        page = self.page()
        wide = max(len(title) for title, _ in page) + 4
        lines = [f"line {self.line}: {self.block}"]
        for title, value in page:
            lines += wrap(
                value or "nothing", WIDTH, initial_indent=f"  {title:{wide - 2}}", subsequent_indent=" " * wide
            )
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        title = f"line {self.line}: <code>{escape(str(self.block))}</code>"
        return f"<h4>{title}</h4>{html_table((), self.page())}"


def _listed(values: dict[str, Any]) -> str:
    """Names with their values, but for the place of the tool, which is told anyway."""
    told = [f"{name} {said(name, value)}".rstrip() for name, value in values.items() if name != "position"]
    more = [f"… {len(told) - SHOWN} more"] if len(told) > SHOWN else []
    return ", ".join(told[:SHOWN] + more)
