"""The tables of the machine as a run leaves them."""

from __future__ import annotations

from mnclab.machine.machine import Machine
from mnclab.machine.setup import ROWS, Tables
from mnclab.runs.history import History


def tables_at_end(m: Machine, history: History, steps: int) -> Tables:
    """What the program wrote; of a run that was cut off only what came before the fault."""
    if m.cut is None:
        return m.tables
    tables, last = Tables(m.setup, m.control.magazine), steps - 1
    for name in history:
        table, _, row = name.partition(" ")
        if table in ROWS and row:
            getattr(tables, table)[int(row)] = history.value(name, last)
    if "probe" in history:
        tables.probe = history.value("probe", last) or tables.probe
    return tables
