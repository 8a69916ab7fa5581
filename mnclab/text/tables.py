"""A table for people as HTML: words to the left, numbers to the right, also where a notebook would set all to the right."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence


def html_table(head: Sequence[str], rows: Iterable[Sequence[str]], numbers: Collection[int] = ()) -> str:
    """Cells of HTML under their heads; `numbers` are the columns that stand to the right."""

    def line(kind: str, cells: Sequence[str]) -> str:
        sides = ("right" if k in numbers else "left" for k in range(len(cells)))
        return "".join(f'<{kind} style="text-align:{side}">{cell}</{kind}>' for side, cell in zip(sides, cells))

    body = "".join(f"<tr>{line('td', row)}</tr>" for row in rows)
    return f"<table><tr>{line('th', head)}</tr>{body}</table>"
