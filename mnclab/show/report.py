"""A run as a report to hand in or file: figures, tools, time, picture, alarms and the program, as HTML or PDF.

The HTML file stands alone: its style sheet (`report.css`) and its picture are in it.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from html import escape
from pathlib import Path
from typing import Any

import numpy as np

from mnclab.path.columns import Index
from mnclab.path.kinds import Kind
from mnclab.path.listing import INCHES, Unit, figure
from mnclab.path.tool import Tool
from mnclab.show.given_away import named
from mnclab.show.times import clock
from mnclab.text.alarm import ALARM, Alarm, card_html
from mnclab.text.file import replaced
from mnclab.text.given import shown
from mnclab.text.tables import html_table
from mnclab.workpiece.collision import Collisions
from mnclab.workpiece.outcome import collisions_html
from mnclab.workpiece.removal import HEAD

Table = list[tuple[str, ...]]
Listing = list[tuple[int, str, str]]
PANELS, MOST_PANELS = 6, 60  # of measuring: in a picture, in all of them
BLANKS = ("part", "date", "measured by")  # lines of a measuring record that a person fills in
QUOTED = 84  # characters of a line that stand in the column of the page
TOOL_HEAD = ("tool", "name", "kind", "radius", "corner", "length", "teeth", "time")
SIZES = ("radius", "corner", "length")  # of them the lengths

POLICY = "default-src 'none'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; form-action 'none'"


@dataclass(frozen=True)
class Report:
    """What stands in a report; tables are rows of texts, `listing` holds the lines of the program with their numbers."""

    title: str
    subtitle: str
    facts: Table
    tools: Table
    times: Table
    alarms: tuple[Alarm, ...]
    listing: Listing
    """Number and text of each line, and the severity of what stands in it: "alarm", "warning" or nothing."""
    tool_head: tuple[str, ...] = TOOL_HEAD
    removal: Table = field(default_factory=list)
    """What each tool took away, as `workpiece.removal.HEAD` has it; nothing without a blank."""
    collisions: Collisions = Collisions()
    called: tuple[tuple[str, Listing], ...] = ()
    """Name and listing of the programs that were called."""
    difference: Any = None
    """How the part differs from its design, where one was given."""
    measured: Any = ()
    """The measuring record of a run that probed."""
    measuring: tuple[Any, ...] = ()
    """Its pictures."""
    panels_left_out: int = 0

    def who(self, blank: str = "") -> Table:
        """Head of a measuring record: its program, and lines that a person fills in."""
        return [("program", self.title), *((name, blank) for name in BLANKS)]

    @property
    def programs(self) -> list[tuple[str, Listing]]:
        return [("Program", self.listing), *((f"Program {name}", lines) for name, lines in self.called)]


def report(run: Any, title: str | None = None) -> Report:
    """Gather what a report says of a run."""
    summary, profile = run.summary(), run.profile()
    low, high = run.toolpath.bounds
    facts: Table = [(name, str(summary[name])) for name in ("blocks", "moves")]
    lengths = run.toolpath.unit
    facts += [(name, f"{lengths.figure(summary[name], 1)} {lengths.short}") for name in ("cutting length", "rapid length")]
    facts.append(("time", clock(profile.time)))
    turned = zip("ABC", np.degrees(run.toolpath.rotary).T)
    for axis, least, most in zip("XYZ", low, high) if np.isfinite(low).all() else ():
        if not (run.toolpath.lathe and axis == "Y"):
            facts.append((f"{axis} from, to", f"{lengths.figure(least, 1)}, {lengths.figure(most, 1)} {lengths.short}"))
    for axis, angles in turned:
        if angles.any():
            facts.append((f"{axis} from, to", f"{figure(angles.min(), 3)}, {figure(angles.max(), 3)} degrees"))
    if run.stock:
        size = np.diff(run.stock.bounds, axis=0)[0]
        facts.append(("blank", " x ".join(lengths.figure(length, 1) for length in size) + f" {lengths.short}"))
    became = run.outcome()
    facts += became.facts() if became else []
    removal = became.removal.rows() if became and became.removal else []
    collisions = became.collisions if became else None
    table, numbers = run.tools_that_cut
    seconds = profile.seconds
    tools = [_tool(n, table.get(n, Tool()), float(seconds[numbers == n].sum()), lengths) for n in _used(run, numbers)]
    tool_head = tuple(f"{name}, in" if lengths is INCHES and name in SIZES else name for name in TOOL_HEAD)
    causes = sorted(profile.time_by("cause").items(), key=lambda item: -item[1])
    times: Table = [(str(name), clock(s), f"{100 * s / profile.time:.1f} %") for name, s in causes if s > 0]
    (_, main), *called = ((program.title, _numbered(run, index)) for index, program in enumerate(run.programs))
    texts = title or run.program.title, run.control.title
    alarms = tuple(map(named, run.alarms))
    return Report(
        *texts, facts, tools, times, alarms, main, tool_head,
        removal=removal, collisions=collisions or Collisions(), called=tuple(called), measured=run.measurements,
    )  # fmt: skip


def _numbered(run: Any, index: int) -> Listing:
    marks: dict[int, str] = {}
    for alarm in sorted(run.alarms, key=lambda alarm: alarm.severity == ALARM):  # an alarm stands above a warning
        marks |= {place.line: alarm.severity for place in alarm.places if place.program == index}
    lines = enumerate(run.programs[index].text.splitlines(), 1)
    return [(number, text, marks.get(number, "")) for number, text in lines]


def _used(run: Any, numbers: Index) -> list[int]:
    """The tools of the path, in the order of their first cut or change."""
    path = run.toolpath
    rows = numbers[path.is_motion | (path.kind == Kind.TOOL)]
    return [number for number in dict.fromkeys(rows.tolist()) if number]


def _tool(number: int, tool: Tool, seconds: float, unit: Unit) -> tuple[str, ...]:
    sizes = (unit.figure(size) if size else "" for size in (tool.effective_radius, tool.corner, tool.effective_length))
    return (f"T{number}", tool.name, tool.kind, *sizes, str(tool.teeth or ""), clock(seconds))


def save_report(
    run: Any, path: str | Path, title: str | None = None, *, design: Any = None, tolerance: float = 0.05, **options: Any
) -> Path:
    """Write a report to one file, .html or .pdf; `options` are those of the picture (`Run.plot`).

    With a `design`, or whatever else a part is compared with, it has a measuring record of the part; `tolerance` in mm.
    """
    if not isinstance(path, str | Path):
        raise Alarm(f"a file is written to a path, got {shown(path)}")
    if not isinstance(title, str | None):
        raise Alarm(f"the title of a report must be a text, got {shown(title)}")
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix not in (".html", ".pdf"):
        raise Alarm(f"a report is an .html or a .pdf file, got {path.name!r}")
    with replaced(path) as beside:
        found, picture = report(run, title), run.plot(**options)
        if run.touches:
            from mnclab.show.plot.measured import pages

            pictures, left_out = pages(run, PANELS, MOST_PANELS)
            found = replace(found, measuring=tuple(pictures), panels_left_out=left_out)
        if design is not None:
            found = replace(found, difference=run.workpiece().compare(design, tolerance))
        if suffix == ".html":
            beside.write_text(html(found, picture), "utf-8", errors="replace", newline="\n")
        else:
            from mnclab.show.plot.report import write

            write(found, picture, beside)
    return path


def html(found: Report, picture: Any) -> str:
    """The report as one page."""
    style = Path(__file__).with_name("report.css").read_text("utf-8")
    alarms = card_html(found.alarms, QUOTED) or "<p>none</p>"
    parts = [
        f"<h1>{escape(found.title)}</h1><p>{escape(found.subtitle)}</p>{html_table((), found.facts, numbers=(1,))}",
        f"<h2>Tools</h2>{html_table(found.tool_head, found.tools, numbers=range(3, 8)) if found.tools else '<p>none</p>'}",
        f"<h2>Path</h2><figure>{picture.html(2.0)}</figure>",
        f"<h2>Time</h2>{html_table((), found.times, numbers=(1, 2)) if found.times else '<p>none</p>'}",
        f"<h2>Alarms</h2>{alarms}",
    ]
    if found.removal:
        collided = collisions_html(found.collisions) or "<p>none</p>"
        parts[-1:-1] = [f"<h2>Removal</h2>{html_table(HEAD, found.removal, numbers=range(1, 6))}"]
        parts.append(f"<h2>Collisions</h2>{collided}")
    if found.measured or found.measuring:
        parts.append(f"<h2>Measured by the probe</h2>{_measured(found)}")
    if found.difference is not None:
        from mnclab.show.export_difference import record

        parts.append(f"<h2>Measuring record</h2>{record(found.difference)}")
    parts += [f'<h2>{escape(name)}</h2><pre class="listing">{_listing(lines)}</pre>' for name, lines in found.programs]
    policy = f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
    head = f'<meta charset="utf-8">{policy}<title>{escape(found.title)}</title><style>{style}</style>'
    return f'<!DOCTYPE html>\n<html lang="en"><head>{head}</head><body>\n' + "\n".join(parts) + "\n</body></html>\n"


def _measured(found: Report) -> str:
    """The measuring record: whose it is, its table with verdicts, its pictures."""
    told = [f'<div class="blanks">{html_table((), found.who())}</div>', found.measured._repr_html_()]
    told += [f"<p>{found.measured.verdict}</p>"] if found.measured else []
    told += [f"<figure>{picture.html(2.0)}</figure>" for picture in found.measuring]
    if found.panels_left_out:
        told.append(f"<p>cycles without a picture: {found.panels_left_out}</p>")
    return "".join(told)


def _listing(lines: Listing) -> str:
    wide = len(str(len(lines)))
    rows = []
    for number, text, mark in lines:
        line = f'<span class="number">{number:{wide}d}</span>  {escape(text)}'
        rows.append(f'<span class="{mark}">{line}</span>' if mark else line)
    return "\n".join(rows)
