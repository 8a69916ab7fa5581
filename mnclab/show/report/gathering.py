"""What a report says of a run: figures, tools, times, alarms, collisions, cutting data, measures and the programs.

Reports and sheets are written to files, .html or .pdf.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import zip_longest
from pathlib import Path
from typing import Any

import numpy as np

from mnclab.path.limits import limits_of
from mnclab.path.listing import Unit, figure
from mnclab.show.given_away import named
from mnclab.show.report import sheets
from mnclab.show.report.document import (
    BAD,
    GOOD,
    Alarms,
    Blanks,
    Compared,
    Document,
    Image,
    Listing,
    Piece,
    Section,
    Table,
    Words,
    html,
)
from mnclab.show.report.sheets import set_up, size_of, tools_table, used_tools
from mnclab.show.times import clock
from mnclab.text.alarm import ALARM, WARNING, Alarm, amounts, several
from mnclab.text.file import replaced
from mnclab.text.given import choice, shown
from mnclab.workpiece.collision import Collisions
from mnclab.workpiece.removal import HEAD

Rows = list[tuple[str, ...]]
Lines = list[tuple[int, str, str]]
BLANKS = ("part", "date", "measured by")  # lines of a measuring record that a person fills in
PANELS, MOST_PANELS = 6, 12  # of measuring: in a picture, in all of them
LONGEST = 76  # letters of a fact beside another


@dataclass(frozen=True)
class Report:
    """What stands in a report; tables are rows of texts, `listing` holds the lines of the program with their numbers."""

    title: str
    subtitle: str
    facts: Rows
    tools: Table
    times: Rows
    alarms: tuple[Alarm, ...]
    listing: Lines
    """Number and text of each line, and the severity of what stands in it: "alarm", "warning" or nothing."""
    removal: Rows = field(default_factory=list)
    """What each tool took away, as `workpiece.removal.HEAD` has it; nothing without a blank."""
    collisions: Collisions | None = None
    """None where they were not looked for."""
    called: tuple[tuple[str, Lines], ...] = ()
    """Name and listing of the programs that were called."""
    measured: Any = ()
    """The measuring record of a run that probed."""
    cutting: Any = ()
    """Its cutting data, tool by tool."""

    @property
    def programs(self) -> list[tuple[str, Lines]]:
        return [("Program", self.listing), *((f"Program {name}", lines) for name, lines in self.called)]

    def verdict(self) -> Words:
        """Whether all is well, in one line."""
        counts = amounts(self.alarms)
        said = [several(counts[name], name) if counts[name] else f"no {name}s" for name in (ALARM, WARNING)]
        if self.collisions is not None:
            said.append(self.collisions.sentence)
        return Words(", ".join(said), BAD if counts[ALARM] or self.collisions else GOOD if not counts[WARNING] else "")


def report(run: Any, title: str | None = None, machine: Any = None) -> Report:
    """Gather what a report says of a run, its times on a machine as in `Run.profile`."""
    profile, became = run.profile(machine=machine), run.outcome()
    facts = [*_facts(run, run.toolpath.unit, profile.time), *(became.facts() if became else [])]
    removal = became.removal.rows() if became and became.removal else []
    causes = sorted(profile.time_by("cause").items(), key=lambda item: -item[1])
    times: Rows = [(str(name), clock(s), f"{100 * s / profile.time:.1f} %") for name, s in causes if s > 0]
    (_, main), *called = ((program.title, _numbered(run, index)) for index, program in enumerate(run.programs))
    return Report(
        title or run.program.title, run.control.title, facts, tools_table(run, used_tools(run), profile), times,
        tuple(map(named, run.alarms)), main, removal=removal, collisions=became.collisions if became else None,
        called=tuple(called), measured=run.measurements, cutting=run.cutting_data(machine=machine),
    )  # fmt: skip


def _facts(run: Any, unit: Unit, time: float) -> Iterator[tuple[str, str]]:
    summary, path = run.summary(), run.toolpath
    yield from ((name, str(summary[name])) for name in ("blocks", "moves"))
    yield from ((name, f"{unit.figure(summary[name], 1)} {unit.short}") for name in ("cutting length", "rapid length"))
    yield "time", clock(time)
    low, high = path.bounds
    for axis, least, most in zip("XYZ", low, high) if np.isfinite(low).all() else ():
        double = 2 if path.lathe and axis == "X" else 1
        if not (path.lathe and axis == "Y"):
            said = f"{unit.figure(double * least, 1)}, {unit.figure(double * most, 1)} {unit.short}"
            yield f"{axis}{' (diameter)' if double == 2 else ''} from, to", said
    for axis, angles in zip("ABC", np.degrees(path.rotary).T):
        if angles.any():
            yield f"{axis} from, to", f"{figure(angles.min(), 3)}, {figure(angles.max(), 3)} degrees"
    if run.stock:
        yield "blank", size_of(run.stock, path.lathe, unit)


def _numbered(run: Any, index: int) -> Lines:
    marks: dict[int, str] = {}
    for alarm in sorted(run.alarms, key=lambda alarm: alarm.severity == ALARM):  # an alarm stands above a warning
        marks |= {place.line: alarm.severity for place in alarm.places if place.program == index}
    lines = enumerate(run.programs[index].text.splitlines(), 1)
    return [(number, text, marks.get(number, "")) for number, text in lines]


def document(run: Any, found: Report, picture: Any, difference: Any = None) -> Document:
    """The report as it is printed, the path as its first picture."""
    moved = bool(run.toolpath.is_motion.any())
    card: list[Piece] = [found.verdict(), _card(found.facts)]
    card.append(Image(picture, path_caption(run)) if moved else Words("The tool does not move."))
    none = Words("none")
    sections = [Section("", card), Section("Tools", [found.tools if found.tools.rows else none])]
    sections.append(Section("Time", [Table((), found.times, (1, 2)) if found.times else none]))
    if found.cutting:
        sections.append(Section("Cutting data", [Table(*found.cutting.table()), *map(Words, found.cutting.notes)]))
    if found.removal:
        sections.append(Section("Removal", [Table(HEAD, found.removal, range(1, 6))]))
    sections.append(Section("Alarms", [Alarms(found.alarms) if found.alarms else none]))
    if found.removal and found.collisions is not None:
        told = [Words(f"{each.file}:{each.line}: collision: {each.message}", BAD) for each in found.collisions]
        told += [Words(found.collisions.sentence)] if found.collisions.reach else []
        sections.append(Section("Collisions", told or [none]))
    sections.append(set_up(run, breaks=run.stock is not None))
    if found.measured or run.touches:
        sections.append(measuring(run, found.title))
    if difference is not None:
        sections.append(Section("Measuring record", [Compared(difference)]))
    sections += [Section(name, [Listing(lines)], not k) for k, (name, lines) in enumerate(found.programs)]
    return Document(found.title, found.subtitle, sections)


def _card(facts: Rows) -> Table:
    """Facts in two columns, long ones below them; the extents along the axes stand in one column."""
    short = [each for each in facts if len("".join(each)) <= LONGEST // 2]
    half = (len(short) + 1) // 2
    extents = [k for k, (name, _) in enumerate(short) if name.endswith("from, to")]
    if extents and extents[0] < half <= extents[-1]:
        half = extents[0]
    rows = [(*a, *b) for a, b in zip_longest(short[:half], short[half:], fillvalue=("", ""))]
    return Table((), rows + [each for each in facts if each not in short])


def path_caption(run: Any) -> str:
    """What stands below the picture of the path."""
    lathe = "X as diameter, " if run.toolpath.lathe else ""
    said = f"the path of the tool tip, {lathe}in {run.toolpath.unit.name}"
    return f"{said}; it goes {run.reach}" if run.reach else said


def measuring(run: Any, title: str) -> Section:
    """The measuring record: whose it is, what was measured with its verdicts, and its pictures."""
    from mnclab.show.plot.measured import pages

    rows = run.measurements
    pieces: list[Piece] = [Blanks([("program", title), *((name, "") for name in BLANKS)])]
    bold = [k for k, row in enumerate(rows) if row.verdict not in ("", "ok")]
    if rows:
        pieces += [Table(rows.head, rows.texts(), range(3, 8), bold)]
        pieces += [Words(rows.verdict, BAD if bold else "")]
    pictures, left_out = pages(run, PANELS, MOST_PANELS)
    pieces += [Image(picture, "what was measured, deviations magnified as each panel says") for picture in pictures]
    if left_out:
        pieces.append(Words(f"cycles without a picture: {left_out}; run.plot_measured(line=…) draws them"))
    return Section("Measured by the probe", pieces)


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
        write(document(run, report(run, title, machine), picture, difference), beside)
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
        return Document(title, f"Measuring record, {run.control.title}", [measuring(run, title)])
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
