"""A program beside itself in another notation: a row for each line, two columns, as text and as HTML."""

from __future__ import annotations

from typing import NamedTuple

from mnclab.text.tables import html_table

SHOWN = 200  # lines of a long program that HTML has


class NotationRow(NamedTuple):
    """A line of the program (0: before the first), its text, and what it says in the other notation.

    A command of several lines is told at its first; `lines` is how many it takes, 0 for those after the first.
    """

    line: int
    original: str
    modern: str
    lines: int = 1


class Notation:
    """A program in two columns; `rows` has them one by one, `modern` is the right column alone."""

    def __init__(
        self, rows: tuple[NotationRow, ...], name: str, titles: tuple[str, str] = ("program", "modern")
    ) -> None:
        self.rows, self.name, self.titles = rows, name, titles

    @property
    def modern(self) -> str:
        """The text of the right column, without the lines where it says nothing."""
        return "\n".join(row.modern for row in self.rows if row.modern)

    def __str__(self) -> str:
        told = [row.original for row in self.rows if row.modern or not row.lines]  # a remark alone may be wider
        wide = max(map(len, [self.titles[0], *told]))
        lines = [f"{self.titles[0]:{wide}}  {self.titles[1]}", f"{'-' * wide}  {'-' * len(self.titles[1])}"]
        return "\n".join([*lines, *(f"{row.original:{wide}}  {row.modern}".rstrip() for row in self.rows)])

    __repr__ = __str__

    def _repr_html_(self) -> str:
        rows = [(str(row.line or ""), row.original, row.modern if row.lines else None) for row in self.rows[:SHOWN]]
        more = f"<p>… {len(self.rows) - SHOWN} more lines</p>" if len(self.rows) > SHOWN else ""
        return html_table(("line", *self.titles), rows, code=(1, 2)) + more
