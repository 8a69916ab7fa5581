"""The sheets that a shop takes to the machine: the set-up with its datums, blank and fixtures, and the tools."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from mnclab.path.listing import Unit, figure
from mnclab.path.tool import LATHE, Tool
from mnclab.path.toolpath import Kind
from mnclab.show.report.document import BAD, Document, Image, Piece, Section, Table, Words
from mnclab.show.times import clock
from mnclab.workpiece.blank import Revolved

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


def tools_table(run: Any, numbers: Sequence[int], profile: Any) -> Table:
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
    return Table(heads, [[row[k] for k in kept] for row in rows], [i for i, k in enumerate(kept) if k in TOOL_NUMBERS])


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


def size_of(stock: Any, lathe: bool, unit: Unit) -> str:
    """A blank by its sizes: X x Y x Z, a bar by its diameter and length."""
    low, high = stock.bounds
    x, y, z = (high - low).tolist()
    if lathe or (isinstance(stock, Revolved) and getattr(stock, "axis", "z").lower() == "z"):
        return f"⌀{unit.figure(x, 1)} x {unit.figure(z, 1)} {unit.short}"
    return f"{unit.figure(x, 1)} x {unit.figure(y, 1)} x {unit.figure(z, 1)} {unit.short}"


def set_up(run: Any, breaks: bool = True) -> Section:
    """Where the datum stands, what is clamped and how: tables and a drawing."""
    from mnclab.show.plot.set_up import plot_set_up, zero_points

    path = run.toolpath
    unit, places = path.unit, zero_points(run)
    pieces: list[Piece] = []
    if places and run.program.text.strip():
        pieces += [Words(f"Zero points in machine coordinates, {unit.short}{', X as radius' if path.lathe else ''}:")]
        pieces += [_datums(run, places[:DATUMS], unit)]
    facts = [*_blank(run, places, unit), *(("fixture", _fixture(each, path.lathe, unit)) for each in run.setup.fixtures)]
    start = " ".join(f"{axis}{unit.figure(value, 1)}" for axis, value in zip("XYZ", run.setup.start))
    facts.append(("spindle at the start", f"{start}, machine coordinates{', X as radius' if path.lathe else ''}"))
    pieces.append(Table((), facts))
    if run.stock is not None:
        caption = "the blank as it is clamped" + (", and its datum" if places else "")
        pieces.append(Image(plot_set_up(run), caption))
    return Section("Set-up", pieces, breaks)


def _datums(run: Any, places: Sequence[tuple[str, Any]], unit: Unit) -> Table:
    """Each zero point of the program: where it stands, and how it is turned."""
    rows = []
    turned = {tuple(np.round(datum[:3], 6)): datum for datum in (*run.tables.datums.values(), *run.tables.presets.values())}
    for name, xyz in places:
        machine = np.asarray(xyz) + run.toolpath.origin
        datum = turned.get(tuple(np.round(machine, 6)))
        turns = [figure(value, 3) if value else "" for value in datum[3:7]] if datum else [""] * len(SHIFTS)
        rows.append([name, *(f"{value / unit.length:.3f}" if np.isfinite(value) else "" for value in machine), *turns])
    kept = [k for k in range(4 + len(SHIFTS)) if k < 4 or any(row[k] for row in rows)]
    head = ["datum", "X", "Y", "Z", *(f"{name}, °" for name in SHIFTS)]
    return Table([head[k] for k in kept], [[row[k] for k in kept] for row in rows], range(1, len(kept)))


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


def set_up_sheet(run: Any, title: str) -> Document:
    """The set-up and the tools that it needs."""
    tools = tools_table(run, used_tools(run), run.profile())
    sections = [set_up(run, breaks=False), Section("Tools", [*_as_far(run), tools if tools.rows else Words("none")])]
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
        sections.append(Section("Cutting data", [Table(*data.table()), *map(Words, data.notes)]))
    return Document(title, f"Tool sheet, {run.control.title}", sections)
