"""A program beside itself in another notation: a row for each line, two columns, as text and as HTML."""

from __future__ import annotations

from html import escape
from typing import NamedTuple

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
        cell = '<td style="text-align:left; vertical-align:top"{span}><code>{text}</code></td>'
        body = []
        for row in self.rows[:SHOWN]:
            span = f' rowspan="{row.lines}"' if row.lines > 1 else ""
            cells = [cell.format(span="", text=escape(row.original))]
            cells += [cell.format(span=span, text=escape(row.modern))] if row.lines else []
            body.append(f"<tr><td>{row.line or ''}</td>{''.join(cells)}</tr>")
        more = f"<p>… {len(self.rows) - SHOWN} more lines</p>" if len(self.rows) > SHOWN else ""
        head = "".join(f'<th style="text-align:left">{escape(title)}</th>' for title in ("line", *self.titles))
        return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(body)}</tbody></table>{more}"
