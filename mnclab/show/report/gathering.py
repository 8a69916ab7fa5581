"""What a report says of a run: figures, tools, times, alarms, collisions, cutting data, measures and the programs.

Reports and sheets are written to files, .html or .pdf.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path
from typing import Any

import numpy as np

from mnclab.path.listing import Unit, figure
from mnclab.path.machines import limits_of
from mnclab.path.tool import LATHE, Tool
from mnclab.path.toolpath import Kind
from mnclab.show.report.document import (
    BAD,
    DOUBTFUL,
    GOOD,
    Alarms,
    Blanks,
    Compared,
    Document,
    Image,
    Listing,
    Piece,
    Section,
    TextTable,
    Words,
    html,
)
from mnclab.text.alarm import ALARM, WARNING, Alarm, amounts, several
from mnclab.text.file import named, replaced
from mnclab.text.given import choice, shown
from mnclab.text.tables import clock
from mnclab.workpiece.blank import Revolved
from mnclab.workpiece.collision import Collisions
from mnclab.workpiece.removal import Removal

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
    tools: TextTable
    times: Rows
    alarms: tuple[Alarm, ...]
    listing: Lines
    """Number and text of each line, and the severity of what stands in it: "alarm", "warning" or nothing."""
    removal: Removal | None = None
    """What each tool took away; None without a blank."""
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
        met = self.collisions
        said += [] if met is None else ["; ".join([met.sentence, *met.notes])]
        worst = BAD if counts[ALARM] or met is not None and (len(met) or met.reach) else DOUBTFUL
        return Words(", ".join(said), worst if worst == BAD or counts[WARNING] or met else GOOD)


def report(run: Any, title: str | None = None, machine: Any = None) -> Report:
    """Gather what a report says of a run, its times on a machine as in `Run.profile`."""
    profile, became = run.profile(machine=machine), run.outcome(machine)
    facts = [*_facts(run, run.toolpath.unit, profile.time), *(became.facts() if became else [])]
    causes = sorted(profile.time_by("cause").items(), key=lambda item: -item[1])
    times: Rows = [(str(name), clock(s), f"{100 * s / profile.time:.1f} %") for name, s in causes if s > 0]
    (_, main), *called = ((program.title, _numbered(run, index)) for index, program in enumerate(run.programs))
    return Report(
        title or run.program.title, run.control.title, facts, tools_table(run, used_tools(run), profile), times,
        tuple(map(Alarm.without_folders, run.alarms)), main, removal=became.removal if became else None,
        collisions=became.collisions if became else None, called=tuple(called),
        measured=run.measurements, cutting=run.cutting_data(machine=machine),
    )  # fmt: skip


def _facts(run: Any, unit: Unit, time: float) -> Iterator[tuple[str, str]]:
    summary, path = run.summary(), run.toolpath
    yield from ((name, str(summary[name])) for name in ("blocks", "moves"))
    yield from ((name, f"{unit.figure(summary[name], 1)} {unit.short}") for name in ("cutting length", "rapid length"))
    yield "time", clock(time)
    low, high = path.bounds
    known, chain = bool(np.isfinite(low).all()), path.kinematics
    if known and chain is not None:  # the tip goes along other ways than the axes
        for name, found in (("tip on the part", np.array([low, high])), ("axes of the machine", run.axes().course()[0])):
            spans = [(unit.figure(a, 1), unit.figure(b, 1)) for a, b in zip(found.min(axis=0)[:3], found.max(axis=0)[:3])]
            said = ", ".join(f"{axis} {a} to {b}" for axis, (a, b) in zip("XYZ", spans))
            turns = ((axis, column) for axis, column in zip("ABC", found.T[3:]) if axis in chain.names)
            turned = ", ".join(f"{axis} {figure(each.min(), 3)} to {figure(each.max(), 3)}" for axis, each in turns)
            yield name, f"{said} {unit.short}" + f"; {turned} degrees" * bool(turned)
    for axis, least, most in zip("XYZ", low, high) if known and chain is None else ():
        double = 2 if path.lathe and axis == "X" else 1
        if not (path.lathe and axis == "Y"):
            said = f"{unit.figure(double * least, 1)}, {unit.figure(double * most, 1)} {unit.short}"
            yield f"{axis}{' (diameter)' if double == 2 else ''} from, to", said
    for axis, angles in zip("ABC", np.degrees(path.rotary).T):
        if angles.any() and chain is None:
            yield f"{axis} from, to", f"{figure(angles.min(), 3)}, {figure(angles.max(), 3)} degrees"
    if run.stock:
        yield "blank", size_of(run.stock, path.lathe, unit)


def _numbered(run: Any, index: int) -> Lines:
    marks: dict[int, str] = {}
    for alarm in sorted(run.alarms, key=lambda alarm: alarm.severity == ALARM):  # an alarm stands above a warning
        marks |= {place.line: alarm.severity for place in alarm.places if place.program == index}
    lines = enumerate(run.programs[index].text.splitlines(), 1)
    return [(number, text, marks.get(number, "")) for number, text in lines]


def document(run: Any, found: Report, picture: Any, difference: Any = None, profile: Any = None) -> Document:
    """The report as it is printed, the path as its first picture."""
    moved = bool(run.toolpath.is_motion.any())
    card: list[Piece] = [found.verdict(), _card(found.facts)]
    card.append(Image(picture, path_caption(run)) if moved else Words("The tool does not move."))
    none = Words("none")
    sections = [Section("", card), Section("Tools", [found.tools if found.tools.rows else none])]
    if found.removal:
        left = f"what is left of the blank{f', {run.reach}' if run.reach else ''}"
        sections.append(Section("Part", [Image(found.removal.workpiece.plot(size=PICTURE), left)]))
    feed = [Image(profile.plot(size=FEED), "the feed over time")] if moved and profile is not None else []
    sections.append(Section("Time", [TextTable((), found.times, (1, 2)) if found.times else none, *feed]))
    if found.cutting:
        sections.append(Section("Cutting data", [TextTable(*found.cutting.table()), *map(Words, found.cutting.notes)]))
    if found.removal:
        sections.append(Section("Removal", [TextTable(*found.removal.table())]))
    sections.append(Section("Alarms", [Alarms(found.alarms) if found.alarms else none]))
    if found.removal and found.collisions is not None:
        told = [Words(f"{each.file}:{each.line}: collision: {each.message}", BAD) for each in found.collisions]
        open_ = [found.collisions.sentence, *found.collisions.notes] if found.collisions.reach or found.collisions.notes else []
        told += [Words(each, DOUBTFUL) for each in open_]
        sections.append(Section("Collisions", told or [none]))
    sections.append(set_up(run))
    if found.measured or run.touches:
        sections.append(measuring(run, found.title))
    if difference is not None:
        sections.append(Section("Measuring record", [Compared(difference)]))
    sections += [Section(name, [Listing(lines)]) for name, lines in found.programs]
    return Document(found.title, found.subtitle, sections)


def _card(facts: Rows) -> TextTable:
    """Facts in two columns, long ones below them; the extents along the axes stand in one column."""
    short = [each for each in facts if len("".join(each)) <= LONGEST // 2]
    half = (len(short) + 1) // 2
    extents = [k for k, (name, _) in enumerate(short) if name.endswith("from, to")]
    if extents and extents[0] < half <= extents[-1]:
        half = extents[0]
    rows = [(*a, *b) for a, b in zip_longest(short[:half], short[half:], fillvalue=("", ""))]
    return TextTable((), rows + [each for each in facts if each not in short])


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
    if rows:
        head, texts, numbers = rows.table()
        pieces += [TextTable(head, texts, numbers, rows.bold), Words(rows.verdict, BAD if rows.bold else "")]
    pictures, left_out = pages(run, PANELS, MOST_PANELS)
    pieces += [Image(picture, "what was measured, deviations magnified as each panel says") for picture in pictures]
    if left_out:
        pieces.append(Words(f"cycles without a picture: {left_out}; run.plot_measured(line=…) draws them"))
    return Section("Measured by the probe", pieces)


PICTURE, FEED = (6.8, 5.6), (6.8, 4.4)  # inches: the path on the first page and the part; the feed
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
        write(document(run, report(run, title, machine), picture, difference, run.profile(machine=machine)), beside)
    return path


def save_sheet(run: Any, which: str, path: str | Path, title: str | None = None, **known: str) -> Path:
    """Write one sheet of a run, "setup", "tools" or "measuring", to an .html or a .pdf file; `known` of what stands above it."""
    which, path = choice(which, "a sheet", SHEETS), checked(path, title)
    if which == "measuring" and not run.touches and not run.measurements:
        so_far = f", {run.reach}" if run.halt else ""
        raise Alarm(f"nothing was measured{so_far}", hint="touch probe cycles measure, with Setup(part=…)")
    with replaced(path) as beside:
        write(_sheet(run, which, title or run.program.title, known), beside)
    return path


def _sheet(run: Any, which: str, title: str, known: Mapping[str, str]) -> Document:
    if which == "measuring":
        return Document(title, f"Measuring record, {run.control.title}", [measuring(run, title)])
    return set_up_sheet(run, title, known) if which == "setup" else tool_sheet(run, title)


def checked(path: str | Path, title: str | None) -> Path:
    """The path of a file that can be written; an Alarm for one that cannot, or a title that is no text."""
    if not isinstance(title, str | None):
        raise Alarm(f"the title of a report must be a text, got {shown(title)}")
    return named(path, (".html", ".pdf"), "a report is an .html or a .pdf file, got {}")[0]


def write(document: Document, path: Path) -> None:
    """A document as a page or as pages, as the suffix of its file says."""
    if path.suffix.lower() == ".html":
        path.write_text(html(document), "utf-8", errors="replace", newline="\n")
        return
    from mnclab.show.plot.pages import write as write_pages

    write_pages(document, path)


# The sheets that a shop takes to the machine: the set-up with its datums, blank and fixtures, and the tools.

TOOLS = (
    "tool", "name", "kind", "diameter", "corner radius", "width", "length", "edges", "point angle", "teeth", "H", "D", "time",
)  # fmt: skip
TOOL_NUMBERS = range(3, 13)
SHIFTS = ("A", "B", "C", "rotation")  # of a datum, beside X, Y and Z
DATUMS = 8  # rows of the table


def used_tools(run: Any) -> list[int]:
    """The tools of the path, in the order of their first cut or change."""
    path, (_, numbers) = run.toolpath, run.tools_that_cut
    rows = numbers[path.is_motion | (path.kind == Kind.TOOL)]
    return [number for number in dict.fromkeys(rows.tolist()) if number]


def tools_table(run: Any, numbers: Sequence[int], profile: Any) -> TextTable:
    """A row for each tool; columns in which nothing stands are left out."""
    (tools, which), unit = run.tools_that_cut, run.toolpath.unit
    h, d = (_offsets(run, name) for name in ("length corrector", "corrector"))
    rows = []
    for number in numbers:
        tool: Tool = tools.get(number, Tool())
        lathe = tool.kind in LATHE
        sizes = (0.0 if lathe else 2 * tool.effective_radius, tool.corner, tool.width, tool.effective_length, tool.cutting_length)
        said = (unit.figure(size, 1) if size else "" for size in sizes)
        angle, teeth = figure(tool.angle, 3) if tool.angle else "", str(tool.teeth or "")
        seconds = float(profile.seconds[which == number].sum())
        offsets = h.get(number, ""), d.get(number, "")
        rows.append((f"T{number}", tool.name, tool.kind, *said, angle, teeth, *offsets, clock(seconds)))
    kept = [k for k in range(len(TOOLS)) if k < 2 or any(row[k] for row in rows)]
    units = {"diameter", "corner radius", "width", "length", "edges"}
    heads = [f"{TOOLS[k]}, {unit.short}" if TOOLS[k] in units else TOOLS[k].replace("angle", "angle, °") for k in kept]
    return TextTable(heads, [[row[k] for k in kept] for row in rows], [i for i, k in enumerate(kept) if k in TOOL_NUMBERS])


def _offsets(run: Any, name: str) -> dict[int, str]:
    """The numbers of correctors that were chosen with each tool, such as `2` or `2, 12`."""
    found: dict[int, list[str]] = {}
    path = run.toolpath
    for step, value in run.history.changed(name):
        row = min(int(np.searchsorted(path.step, step, "right")), len(path) - 1)
        if value and row >= 0:
            said = found.setdefault(int(path.tool[row]), [])
            said += [f"{value:g}"] if f"{value:g}" not in said else []
    return {number: ", ".join(said) for number, said in found.items()}


def correctors(run: Any) -> TextTable:
    """What stands in the correctors that the program chooses, a row for each; what nobody knows is left free."""
    unit, rows = run.toolpath.unit, Rows()
    for letter, name, what in (("H", "length corrector", "length"), ("D", "corrector", "radius")):
        for tool, chosen in sorted(_offsets(run, name).items()):
            for number in chosen.split(", "):
                entry = run.tables.tools.get(float(number))
                sizes = (getattr(entry, f"effective_{what}"), getattr(entry, f"d{what[0]}")) if entry else (0.0, 0.0)
                rows.append((f"{letter}{number}", f"T{tool}", what, *(unit.figure(size, 1) if size else "" for size in sizes)))
    return TextTable(("corrector", "with", "is a", f"value, {unit.short}", f"wear in it, {unit.short}"), rows, (3, 4))


def size_of(stock: Any, lathe: bool, unit: Unit) -> str:
    """A blank by its sizes: X x Y x Z, a bar by its diameter and length."""
    low, high = stock.bounds
    x, y, z = (high - low).tolist()
    if lathe or (isinstance(stock, Revolved) and getattr(stock, "axis", "z").lower() == "z"):
        return f"⌀{unit.figure(x, 1)} x {unit.figure(z, 1)} {unit.short}"
    return f"{unit.figure(x, 1)} x {unit.figure(y, 1)} x {unit.figure(z, 1)} {unit.short}"


def set_up(run: Any) -> Section:
    """Where the datum stands, what is clamped and how: tables and a drawing."""
    from mnclab.show.plot.set_up import plot_set_up, zero_points

    path = run.toolpath
    unit, places = path.unit, zero_points(run)
    pieces: list[Piece] = []
    if places and run.program.text.strip():
        pieces += [Words(f"Zero points in machine coordinates, {unit.short}{', X as radius' if path.lathe else ''}:")]
        pieces += [_datums(run, places[:DATUMS], unit)]
    facts = [*_blank(run, places, unit), *(("fixture", _fixture(each, path.lathe, unit)) for each in run.setup.fixtures)]
    ends = zip("XYZ", run.setup.start)
    start = " ".join(f"{axis}{unit.figure(value, 1)}" for axis, value in ends if not (path.lathe and axis == "Y"))
    facts.append(("spindle at the start", f"{start}, machine coordinates{', X as radius' if path.lathe else ''}"))
    if (chain := run.setup.kinematics) is not None:
        facts.append(("kinematics", f"{chain.title}: {chain}" if chain.title else str(chain)))
    pieces.append(TextTable((), facts))
    if run.stock is not None:
        caption = "the blank as it is clamped" + (", and its datum" if places else "")
        pieces.append(Image(plot_set_up(run), caption))
    return Section("Set-up", pieces)


def _datums(run: Any, places: Sequence[tuple[str, Any]], unit: Unit) -> TextTable:
    """Each zero point of the program: where it stands, and how it is turned."""
    rows = []
    turned = {tuple(np.round(datum[:3], 6)): datum for datum in (*run.tables.datums.values(), *run.tables.presets.values())}
    for name, xyz in places:
        machine = np.asarray(xyz) + run.toolpath.origin
        datum = turned.get(tuple(np.round(machine, 6)))
        turns = [figure(value, 3) if value else "" for value in datum[3:7]] if datum else [""] * len(SHIFTS)
        rows.append([name, *(f"{value / unit.length:.3f}" if np.isfinite(value) else "" for value in machine), *turns])
    head = ["datum", "X", "Y", "Z", *(f"{name}, °" for name in SHIFTS)]
    kept = [k for k in range(len(head)) if any(row[k] for row in rows) and not (run.toolpath.lathe and head[k] == "Y")]
    return TextTable([head[k] for k in kept], [[row[k] for k in kept] for row in rows], range(1, len(kept)))


def _blank(run: Any, places: Sequence[tuple[str, Any]], unit: Unit) -> Iterator[tuple[str, str]]:
    """The sizes of a blank, and how far its first datum stands from its sides."""
    stock, lathe = run.stock, run.toolpath.lathe
    if stock is None:
        yield "blank", "none was given"
        return
    yield "blank", size_of(stock, lathe, unit)
    low, high = stock.bounds
    name, xyz = places[0] if places else ("zero", np.zeros(3))
    x, y, z = (np.asarray(xyz) - (low[0], low[1], high[2])).tolist()
    depth = f"{unit.figure(abs(z), 1)} {unit.short} {'below' if z < 0 else 'above'} its top" if abs(z) > 1e-6 else "on its top"
    if lathe:
        face = f"{unit.figure(abs(z), 1)} {unit.short} {'behind' if z < 0 else 'before'} its face"
        yield f"{name} stands", f"on the axis of the spindle, {face if abs(z) > 1e-6 else 'on its face'}"
    else:
        from_ = ((x, "left"), (y, "front"))
        sides = ", ".join(f"{unit.figure(value, 1)} {unit.short} from its {side} side" for value, side in from_)
        yield f"{name} stands", f"{sides}, {depth}"


def _fixture(fixture: Any, lathe: bool, unit: Unit) -> str:
    """A fixture by its place and size, machine coordinates."""
    bounds = np.asarray(getattr(fixture, "bounds", fixture), dtype=float)
    if isinstance(fixture, Revolved) and lathe:
        (_, _, z0), (x, _, z1) = bounds
        return f"chuck ⌀{unit.figure(2 * x, 1)}, Z from {unit.figure(z0, 1)} to {unit.figure(z1, 1)} {unit.short}"
    axes = (f"{axis} {unit.figure(a, 1)} to {unit.figure(b, 1)}" for axis, a, b in zip("XYZ", *bounds))
    return f"{', '.join(axes)} {unit.short}"


def set_up_sheet(run: Any, title: str, known: Mapping[str, str]) -> Document:
    """Whose it is, the set-up, the tools that it needs and their correctors; what is not `known` a person fills in."""
    tools, filled = tools_table(run, used_tools(run), run.profile()), correctors(run)
    sections = [Section("", [Blanks([("program", run.program.title), *known.items()])]), set_up(run)]
    sections.append(Section("Tools", [*_as_far(run), tools if tools.rows else Words("none")]))
    if filled.rows:
        sections.append(Section("Correctors", [filled]))
    return Document(title, f"Set-up sheet, {run.control.title}", sections)


def _as_far(run: Any) -> Iterator[Words]:
    """That more may be needed than a run has come to, if it stopped before its end."""
    if run.reach:
        yield Words(f"Known only {run.reach}.", BAD)


def tool_sheet(run: Any, title: str) -> Document:
    """The tools of a program, and how they cut."""
    tools, data = tools_table(run, used_tools(run), run.profile()), run.cutting_data()
    sections = [Section("Tools", [*_as_far(run), tools if tools.rows else Words("none")])]
    if data:
        sections.append(Section("Cutting data", [TextTable(*data.table()), *map(Words, data.notes)]))
    return Document(title, f"Tool sheet, {run.control.title}", sections)
