"""A report on pages of A4: figures, tools, time and alarms, the picture, and the program in columns of plain text."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure

from mnclab.show.given_away import whole
from mnclab.show.plot import colours
from mnclab.text.alarm import ALARM, WARNING, first_of
from mnclab.workpiece.removal import HEAD

A4 = (8.27, 11.69)  # inches
LEFT, TOP, LINE = 0.8, 0.8, 0.165  # inches: margins, and the height of a line
LINES = int((A4[1] - 2 * TOP) / LINE)
WIDTH = 92  # characters of a line
QUOTED = WIDTH - 8  # of a quoted line, which is set in and may begin and end with an ellipsis
LISTED = 2000  # lines of the programs
HEADS = ("", "", "", "nominal", "actual", "deviation", "lower", "upper", "verdict")
MARKS = {"": " ", ALARM: "!", WARNING: "?"}


def write(found: Any, picture: Figure, path: Path) -> None:
    """Write the pages; the same report gives the same bytes."""
    data = BytesIO()
    undated = {"CreationDate": None, "Title": whole(found.title)}
    with mpl.rc_context({"pdf.fonttype": 42}), PdfPages(data, metadata=undated) as pages:
        measured = [*map(_page, chunks([*measuring(found)]))] if found.measured else []
        record = [] if found.difference is None else [found.difference.plot(table=True)]
        pictures = picture, *measured, *found.measuring, *record
        for page in (*map(_page, chunks([*front(found)])), *pictures, *map(_page, chunks([*texts(found)]))):
            pages.savefig(page)
    path.write_bytes(data.getvalue())


def chunks(lines: list[tuple[str, bool]]) -> Iterator[list[tuple[str, bool]]]:
    """Lines (text, bold) a page."""
    yield from (lines[at : at + LINES] for at in range(0, max(len(lines), 1), LINES))


def front(found: Any) -> Iterator[tuple[str, bool]]:
    """What stands before the picture."""
    yield from [(found.title, True), (found.subtitle, False), ("", False)]
    yield from table(found.facts)
    tables = [("Tools", [found.tool_head, *found.tools] if found.tools else []), ("Time", found.times)]
    tables += [("Removal", [HEAD, *found.removal])] if found.removal else []
    for name, rows in tables:
        yield from [("", False), (name, True)]
        yield from table(rows) if rows else [("none", False)]
    yield from [("", False), ("Alarms", True)]
    shown, more = first_of(found.alarms)
    for told in (*(alarm.text(QUOTED) for alarm in shown), *filter(None, [more])):
        for line in told.split("\n"):
            yield from ((part, False) for part in textwrap.wrap(line, WIDTH, drop_whitespace=False) or [""])
    if not found.alarms:
        yield "none", False
    if found.removal:
        yield from [("", False), ("Collisions", True)]
        for each in found.collisions:
            yield from ((part, False) for part in textwrap.wrap(str(each), WIDTH))
        if not found.collisions:
            yield "none", False


def measuring(found: Any) -> Iterator[tuple[str, bool]]:
    """The record of what the probe measured, execution by execution of a cycle."""
    yield from [("Measured by the probe", True), ("", False)]
    yield from table(found.who("_" * 40))
    rows = [row.texts() for row in found.measured]
    head, *lines = (text for text, _ in table([_columns(HEADS), *map(_columns, rows)]))
    before = None
    for row, (where, cycle, *_), line in zip(found.measured, rows, lines):
        if row.step != before:
            yield from [("", False), (f"{where}  {cycle}", True), (head, False)]
        before = row.step
        yield line, False
    yield from [("", False), (found.measured.verdict, False)]
    if found.panels_left_out:
        yield f"cycles without a picture: {found.panels_left_out}", False


def _columns(row: Sequence[str]) -> tuple[str, ...]:
    """What a line of a measuring record says, numbers to the right."""
    return row[2], *(text.rjust(10) for text in row[3:8]), row[8]


def table(rows: list[tuple[str, ...]]) -> Iterator[tuple[str, bool]]:
    """Rows as text in columns."""
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    for row in rows:
        yield "  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip(), False


def texts(found: Any) -> Iterator[tuple[str, bool]]:
    """The first lines of all programs, each under its name."""
    room = LISTED
    for k, (name, program) in enumerate(found.programs):
        yield from [("", False)] * (2 if k else 0)
        yield name, True
        if any(mark for _, _, mark in program):
            yield "! an alarm, ? a warning stands in the line", False
        yield "", False
        yield from ((line, False) for line in listing(program[:room]))
        if room < len(program):
            yield f"… {len(program) - room} of {len(program)} lines are left out; an .html report has them all", False
        room = max(0, room - len(program))


def listing(program: Any) -> Iterator[str]:
    """A program with its line numbers; a mark where an alarm or a warning stands, long lines folded."""
    wide = len(str(len(program)))
    for number, text, mark in program:
        parts = textwrap.wrap(text.expandtabs(4), WIDTH - wide - 3, drop_whitespace=False) or [""]
        yield f"{number:{wide}d} {MARKS[mark]} {parts[0]}"
        yield from (" " * (wide + 3) + part for part in parts[1:])


def _page(lines: list[tuple[str, bool]]) -> Figure:
    page = Figure(figsize=A4, facecolor=colours.PAPER)
    for k, (text, bold) in enumerate(lines):
        place = LEFT / A4[0], 1 - (TOP + k * LINE) / A4[1]
        weight = "bold" if bold else "normal"
        page.text(*place, whole(text), fontsize=9, family="DejaVu Sans Mono", weight=weight, va="top", parse_math=False)
    return page
