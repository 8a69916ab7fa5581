"""Functions FN of the control: system data, circles through points, signals, datums."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from mnclab.controls.tnc_620.language.parameters import give
from mnclab.controls.tnc_620.language.system_data import COLUMNS, ROWS, TABLES, Asked, Missing, named, written
from mnclab.controls.tnc_620.reading.formulas import GREATEST
from mnclab.controls.tnc_620.state import active_preset, memory
from mnclab.geometry.arcs import circle_through
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.text.alarm import Alarm
from mnclab.text.program import Word

# FN 18 reads system data, FN 17 writes them.

FUNCTIONS = FunctionTable()


def asked(m: Machine, words: Words) -> Asked:
    return Asked(m.value(words["ID"]), m.value(words["NR"]), m.value(words["IDX"]) if "IDX" in words else math.nan)


@FUNCTIONS("FN 18,", "Reading system data", takes="target ID NR IDX", source="Klartext, not described")
def read_system(m: Machine, words: Words) -> None:
    """Reads one of the system data: ID the group, NR the number in it, IDX the index.

    Program (ID10), machine (20), cycle (30), tools (50, 60, 950),
    compensation (35, 200), transformations (210, 220),
    travel (230), positions (240, 270), M128 and its like (280, 310),
    time (320), datums and presets (500 to 530), run (992).
    """
    m.variables.state_read = m.step
    m.flow.spend_again(3)
    found = asked(m, words)
    row = ROWS.get((found.group, found.number), TABLES.get(found.group) if found.number.is_integer() else None)
    what = f"FN 18: SYSREAD {found}"
    if row is None:
        known = ", ".join(f"NR{number:g}" for group, number in ROWS if group == found.group)
        hint = f"of ID{found.group:g}: {known}" if known else ""
        m.alarm(f"{what} is not built yet", words["ID"], hint)
    if math.isnan(found.index):
        found = replace(found, index=row.default)
    if row.indices != () and math.isnan(found.index):
        m.alarm(f"{what} ({row.title}) needs IDX", words["NR"])
    if row.indices == () and found.index > 0:
        m.warn(f"{what} ({row.title}) has no index: IDX{found.index:g} means nothing", words["IDX"])
    elif row.indices and found.index not in row.indices:
        m.alarm(f"{what} ({row.title}) is not built yet for this index", words.get("IDX", words["NR"]))
    try:
        value = row.read(m, found)
    except Missing as why:
        m.alarm(f"{what} ({row.title}) has no value: {why}", words["ID"])
    if value is None:
        m.alarm(f"{what} ({row.title}) has no value", words["ID"])
    give(m, words["target"], value)


@FUNCTIONS("FN 17,", "Writing system data", takes="ID NR IDX value", source="17.2")
def write_system(m: Machine, words: Words) -> None:
    """ID990 NR6: the input of the probe for cycle 3; the probe here answers at either. ID50: a column of the tool table."""
    to, value = asked(m, words), m.value(words["value"])
    what = f"FN 17: SYSWRITE {to}"
    if (to.group, to.number) == (990, 6) and math.isnan(to.index):
        memory(m).probe_input = value
        m.log("probe input", value)
    elif to.group == 50 and to.number in COLUMNS:
        write_tool(m, to, value, what, words)
    else:
        m.alarm(f"{what} is not built yet", words["ID"], "ID990 NR6 is, and columns of the tool table, ID50")


def write_tool(m: Machine, to: Asked, value: float, what: str, words: Words) -> None:
    """A tool that is in the spindle counts with what was written from its next TOOL CALL on."""
    try:
        if not to.index.is_integer():
            raise Missing("needs IDX, the number of the tool")
        column, row = COLUMNS[int(to.number)], named(m, to)
        m.write_table("tools", int(to.index), written(m, row, int(to.number), value))
        if not column.place and value:
            m.warn(f"{what} ({column.title}): it can be read again, and nothing here acts on it", words["NR"])
    except StopIteration:
        m.alarm(f"{what} (TYPE): a tool here has no kind of the number {value:g}", words["value"])
    except (Missing, Alarm) as why:
        m.alarm(f"{what}: {why.message if isinstance(why, Alarm) else why}", words["ID"])


# FN 23 and FN 24: centre and radius of the circle through points that stand in Q parameters (iTNC 530, 9.5).

POINTS = {"FN 23": 3, "FN 24": 4}
TITLES = {"FN 23": "Circle through three points", "FN 24": "Circle through four points"}
APART = 1e-3  # mm; four points that are not nearer to one circle are measured ones


def following(m: Machine, word: Word, count: int) -> list[str]:
    """A parameter and those after it."""
    name = str(word.value)
    kind = name.rstrip("0123456789")
    first = int(name[len(kind) :])
    if first + count - 1 > GREATEST[kind[1:]]:
        m.alarm(f"{count} parameters from {name} on do not exist: the last is {kind}{GREATEST[kind[1:]]}", word)
    return [f"{kind}{first + k}" for k in range(count)]


@FUNCTIONS(", ".join(TITLES), TITLES, takes="target points", source="Klartext, not described")
def circle_data(m: Machine, words: Words) -> None:
    """The points stand in six or eight parameters, x and y in turn; centre and radius come into the target and the two after it.

    Four points that lie on no common circle are evened out by least squares, with a warning: how the control does it nobody says.
    """
    count, source = POINTS[words.code], words["points"]
    found = []
    for name in following(m, source, 2 * count):
        if not isinstance(value := m.variables.get(name), float):
            m.alarm(f"{words.code}: no value was given to {name}", source, f"{count} points stand in {2 * count} parameters")
        found.append(value)
    points = np.array(found).reshape(count, 2)
    try:
        x, y, radius = circle_through(points)
    except ValueError:
        m.alarm(f"{words.code}: the points lie on a line, no circle goes through them", source)
    off = float(np.abs(np.hypot(*(points - (x, y)).T) - radius).max())
    if off * m.variable_unit > APART:
        m.warn(f"{words.code}: the points lie up to {off:.3g} beside one circle, which is that of least squares", source)
    for name, value in zip(following(m, words["target"], 3), (x, y, radius), strict=True):
        give(m, words["target"]._replace(value=name), value)


# What goes out of the control, to its PLC or to a log: here nobody listens, and the program goes on.

PLC_TITLES = {
    "FN 19": "Values to the PLC", "FN 20": "Waiting for the PLC", "FN 29": "Values to the PLC", "FN 37": "Exporting parameters",
    "FN 38": "Sending to a log",
}  # fmt: skip
HAPPENS = {
    "FN 19": "there is no PLC that could take the values", "FN 20": "there is no PLC, and the program goes on at once",
    "FN 29": "there is no PLC that could take the values", "FN 37": "the parameters of a cycle are not exported",
    "FN 38": "there is nobody to send to",
}  # fmt: skip


@FUNCTIONS(", ".join(PLC_TITLES), PLC_TITLES, source="Klartext, not described")
def outwards(m: Machine, words: Words) -> None:
    """Nothing moves and nothing waits; a warning says so."""
    m.warn(f"{words.code} has no effect: {HAPPENS[words.code]}")


# FN 25: the program sets the datum of an axis (iTNC 530).

@FUNCTIONS("FN 25,", "Preset", takes="axis first second", source="Klartext, not described")
def set_datum(m: Machine, words: Words) -> None:
    """PRESET = X/+100/+0: the point that has the coordinate 100 gets 0. The preset becomes row 0, the one set by hand."""
    axis = str(words["axis"].value)
    if axis not in "XYZ":
        m.alarm(f"FN 25: the axis {axis} is not built yet, X, Y and Z are", words["axis"])
    if m.side:
        m.alarm("FN 25 cannot set the datum under radius compensation", words["axis"], "write R0 before")
    if active := [name for name, _ in m.frames if name != "preset" and name in m.frames]:
        m.alarm(f"FN 25 cannot set the datum while a {active[0]} is active", words["axis"])
    by = (m.value(words["first"]) - m.value(words["second"])) * m.variable_unit
    before = m.tables.presets.get(active_preset(m), Datum())
    way = by * m.frames["preset"][:3, "XYZ".index(axis)]
    preset = before._replace(**{name: float(old + along) for name, old, along in zip("xyz", before, way)})
    m.write_table("presets", 0, preset)
    memory(m).preset = 0
    m.select_datum(preset, "preset")
