"""One moment of a run: the machine after a block, or on the way through it."""

from __future__ import annotations

from html import escape
from textwrap import wrap
from typing import Any, NamedTuple

from mnclab.path.listing import point
from mnclab.runs.values import does_nothing, told, unit_of, with_feed
from mnclab.text.program import Block
from mnclab.text.tables import html_table

WIDTH, SHOWN = 100, 60  # characters of a line; values that are listed


class Moment(NamedTuple):
    """The machine after one step: the block, the programmed point (program coordinates, mm), what was active and what
    the block changed; `rows` are the rows of the toolpath that it made.

    A moment inside a block (`Run.when`) has the row of the toolpath, the share of it (0 to 1) that was done, and
    the tool tip there, mm; -1 for a row where the block moved nothing. `text` is the line as written.
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
    text: str = ""
    lathe: bool = False

    @property
    def title(self) -> str:
        return f"line {self.line}: {self.text or self.block}"

    def page(self) -> list[tuple[str, str]]:
        changed = with_feed(self.changed, self.state)
        active = {
            name: value for name, value in self.state.items() if name not in changed and not does_nothing(name, value)
        }
        first, stop = self.rows.start, self.rows.stop
        rows = "none" if first == stop else f"{first}" if stop == first + 1 else f"{first} to {stop - 1}"
        inside = f", {100 * self.share:.4g} % of row {self.row}" if self.share != 1 else ""
        return [
            ("programmed point", point(self.position, unit_of(self.state), self.lathe)),
            ("tool tip", point(self.point, unit_of(self.state), self.lathe)),
            ("rows of the path", rows + inside),
            ("changed", _listed(told(changed, self.state))),
            ("active", _listed(told(active, self.state))),
        ]

    def __repr__(self) -> str:
        page = self.page()
        wide = max(len(title) for title, _ in page) + 4
        lines = [self.title]
        for title, value in page:
            lines += wrap(value, WIDTH, initial_indent=f"  {title:{wide - 2}}", subsequent_indent=" " * wide)
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        title = f"line {self.line}: <code>{escape(self.text or str(self.block))}</code>"
        return f"<h4>{title}</h4>{html_table((), self.page())}"


def _listed(words: list[str]) -> str:
    more = [f"… {len(words) - SHOWN} more"] if len(words) > SHOWN else []
    return ", ".join(words[:SHOWN] + more) or "nothing"
