"""Reports and sheets as files, .html or .pdf."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from mnclab.path.limits import limits_of
from mnclab.show.report import gathering, sheets
from mnclab.show.report.contents import Document
from mnclab.show.report.page import html
from mnclab.text.alarm import Alarm
from mnclab.text.file import replaced
from mnclab.text.given import choice, shown

PICTURE = (6.8, 5.6)  # inches: the path on the first page
SHEETS = ("setup", "tools", "measuring")


def save_report(
    run: Any, path: str | Path, title: str | None = None,
    *, design: Any = None, tolerance: float = 0.05, limits: Any = None, machine: Any = None, **options: Any,
) -> Path:  # fmt: skip
    """Write a report to one file, .html or .pdf; `options` are those of the picture (`Run.plot`).

    With a `design`, or whatever else a part is compared with, it has a measuring record of the part; `tolerance` in mm.
    Times and limits are those of `limits` or of a `machine`, as in `Run.profile`.
    """
    path, machine = checked(path, title), limits_of(limits, machine)
    with replaced(path) as beside:
        picture = run.plot(**{"size": PICTURE} | options)
        difference = None if design is None else run.workpiece().compare(design, tolerance)
        write(gathering.document(run, gathering.report(run, title, machine), picture, difference), beside)
    return path


def save_sheet(run: Any, which: str, path: str | Path, title: str | None = None) -> Path:
    """Write one sheet of a run, "setup", "tools" or "measuring", to an .html or a .pdf file."""
    which, path = choice(which, "a sheet", SHEETS), checked(path, title)
    if which == "measuring" and not run.touches and not run.measurements:
        so_far = f", {run.reach}" if run.halt else ""
        raise Alarm(f"nothing was measured{so_far}", hint="touch probe cycles measure, with Setup(part=…)")
    with replaced(path) as beside:
        write(_sheet(run, which, title or run.program.title), beside)
    return path


def _sheet(run: Any, which: str, title: str) -> Document:
    if which == "measuring":
        return Document(title, f"Measuring record, {run.control.title}", [gathering.measuring(run, title)])
    return (sheets.set_up_sheet if which == "setup" else sheets.tool_sheet)(run, title)


def checked(path: str | Path, title: str | None) -> Path:
    """The path of a file that can be written; an Alarm for one that cannot, or a title that is no text."""
    if not isinstance(path, str | Path):
        raise Alarm(f"a file is written to a path, got {shown(path)}")
    if not isinstance(title, str | None):
        raise Alarm(f"the title of a report must be a text, got {shown(title)}")
    path = Path(path)
    if path.suffix.lower() not in (".html", ".pdf"):
        raise Alarm(f"a report is an .html or a .pdf file, got {path.name!r}")
    return path


def write(document: Document, path: Path) -> None:
    """A document as a page or as pages, as the suffix of its file says."""
    if path.suffix.lower() == ".html":
        path.write_text(html(document), "utf-8", errors="replace", newline="\n")
        return
    from mnclab.show.plot.pages import write as write_pages

    write_pages(document, path)
