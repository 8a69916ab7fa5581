"""FN 18 reads system data, FN 17 writes them."""

from __future__ import annotations

import math
from dataclasses import replace

from mnclab.controls.tnc_620.language.parameters import give
from mnclab.controls.tnc_620.language.system_data import ROWS, TABLES, Asked, Missing, named
from mnclab.controls.tnc_620.language.tool_columns import COLUMNS, written
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine
from mnclab.text.alarm import Alarm

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
