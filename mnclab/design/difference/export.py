"""A difference as a file: the picture (svg, pdf, png), the table of measures (csv), all numbers (json), a record (html)."""

from __future__ import annotations

import json
from collections.abc import Callable
from html import escape
from pathlib import Path
from typing import Any

from mnclab.design.difference.difference import HEAD, Difference
from mnclab.show.report.document import page
from mnclab.text.file import save_as
from mnclab.text.tables import csv_text, write_picture


def save(difference: Difference, path: str | Path, **options: Any) -> Path:
    """Write a difference to one file and return its path; pictures and records take the options of `Difference.plot`."""
    return save_as(difference, path, WRITERS, "cannot write a difference as {}", **options)


def write_csv(difference: Difference, path: Path) -> None:
    """The table of measures, numbers in full, with the places of what is worst."""
    rows = ([*row[:9], row.line, row.program, *(row.place or ("", "", ""))] for row in difference.features)
    path.write_text(csv_text([*HEAD[:-1], "line", "program", "x", "y", "z"], *rows), "utf-8", newline="")


def write_json(difference: Difference, path: Path) -> None:
    """What `Difference.as_dict` says."""
    path.write_text(json.dumps(difference.as_dict(), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def write_html(difference: Difference, path: Path, **options: Any) -> None:
    """The record on a page that stands alone: verdict, worst places, picture, table."""
    title = f"Difference from {difference.target}"
    body = f"<h1>{escape(title)}</h1>{record(difference, **options)}"
    path.write_text(page(title, body), "utf-8", errors="replace", newline="\n")


def record(difference: Difference, **options: Any) -> str:
    """The measuring record as a piece of a page: what was found, the picture, the table."""
    from mnclab.design.difference.plot import plot_difference

    picture: Any = plot_difference(difference, **options)
    first, *rest = difference.html_parts()
    return f"{first}<figure>{picture.html(2.0)}</figure>{''.join(rest)}"


WRITERS: dict[str, Callable[..., None]] = {
    **dict.fromkeys((".svg", ".pdf", ".png"), write_picture),
    ".csv": write_csv,
    ".json": write_json,
    ".html": write_html,
}
