"""Tables in print: a rule above and below and one under the heads, numbers under each other by their points."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from mnclab.show.plot.pages.letters import folded, width
from mnclab.show.report.contents import Table
from mnclab.text.tables import tail

SIZES = (8.5, 8.0, 7.5, 7.0, 6.5, 6.0)  # points, the first that has room
GAP, LINE, AIR = 13.0, 1.32, 3.0  # between columns; lines apart, in ems; above and below the rules
NARROW = 46.0  # a column of words is folded to this width at least


class Line(NamedTuple):
    """One row as it is printed: its cells as lines (text, x of its left end), and how tall it is."""

    cells: list[list[tuple[str, float]]]
    tall: float
    bold: bool


class Setting(NamedTuple):
    """A table that has its places: `head` None without one."""

    head: Line | None
    rows: list[Line]
    size: float
    wide: float


def tabled(table: Table, room: float) -> Setting:
    """The places of the cells of a table within `room` points: the largest letters that need no folding, else folded words."""
    texts = [list(row) for row in (*([table.head] if any(table.head) else []), *table.rows)]
    count = max(map(len, texts))
    texts = [row + [""] * (count - len(row)) for row in texts]
    heads = 1 if any(table.head) else 0
    bold = {0} if heads else set[int]()
    bold |= {heads + k for k in table.bold}
    for size in SIZES:
        widths = _widths(texts, size, bold)
        if sum(widths) + GAP * (count - 1) <= room:
            break
    gap = GAP if sum(widths) + GAP * (count - 1) <= room else GAP / 2
    widths = _folded_widths(widths, room - gap * (count - 1), set(table.numbers))
    longest = {k: max((width(tail(row[k]) or "", size) for row in texts[heads:]), default=0.0) for k in table.numbers}
    left = [sum(widths[:k]) + gap * k for k in range(count)]
    lines = []
    for number, row in enumerate(texts):
        thick, cells = number in bold, []
        for k, text in enumerate(row):
            parts = folded(text, widths[k] + 0.1, size, thick)
            end = tail(text) if number >= heads else None
            shift = longest[k] - width(end, size) if k in longest and end is not None else 0.0
            right = k in longest
            cells.append([(part, left[k] + (widths[k] - shift - width(part, size, thick) if right else 0)) for part in parts])
        lines.append(Line(cells, size * LINE * max(map(len, cells)) + AIR, thick))
    return Setting(lines[0] if heads else None, lines[heads:], size, sum(widths) + gap * (count - 1))


def _widths(texts: Sequence[Sequence[str]], size: float, bold: set[int]) -> list[float]:
    """How wide each column is, a number with room for the decimals that others have."""
    found = []
    for k in range(len(texts[0])):
        plain = [(row[k], n in bold) for n, row in enumerate(texts)]
        most = max(width(line, size, thick) for text, thick in plain for line in text.split("\n"))
        ends = [(width(text, size, thick), width(tail(text) or "", size)) for text, thick in plain if tail(text) is not None]
        if ends:  # the longest before the point and the longest behind it need not be of one number
            most = max(most, max(all_ - end for all_, end in ends) + max(end for _, end in ends))
        found.append(most)
    return found


def _folded_widths(widths: list[float], room: float, numbers: set[int]) -> list[float]:
    """Widths that have room together: the widest columns of words become narrower, down to one width."""
    widths = widths.copy()
    words = [k for k in range(len(widths)) if k not in numbers] or [*range(len(widths))]
    while (over := sum(widths) - room) > 0.01:
        wide = max(widths[k] for k in words)
        most = [k for k in words if widths[k] > wide - 0.01]
        next_ = max((widths[k] for k in words if widths[k] <= wide - 0.01), default=NARROW)
        less = min(over / len(most), wide - max(next_, NARROW))
        if less <= 0:
            break
        for k in most:
            widths[k] -= less
    return widths
