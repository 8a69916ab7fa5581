"""Another tool than the one in the spindle, as a cycle names it by number or name: the rough-out tool of 21, 22, 24 and 25."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.machine.cycle import Cycle
from mnclab.machine.machine import Machine
from mnclab.path.tool import Tool
from mnclab.text.alarm import Alarm
from mnclab.text.strings import TextFormula

LONGEST = 16  # characters of a name
Named: TypeAlias = float | str | TextFormula  # a number, a name, or a text parameter that holds a name


def named_tool(m: Machine, tool: Named) -> Tool | None:
    """The tool of a number (5.1 is a row of its own), or of a name whatever its case; None where the table has none."""
    if isinstance(tool, TextFormula):
        tool = tool.evaluate(m.variables)
    if not isinstance(tool, str):
        return m.tables.tools.get(tool)  # type: ignore[call-overload]
    same = (each for each in m.tables.tools.values() if each.name and each.name.upper() == tool.strip().upper())
    return next(same, None)


def in_table(c: Cycle, m: Machine, name: str) -> Iterator[Fault]:
    """A tool that the table does not have, or one that cuts nothing."""
    given: Named = getattr(c, name)
    if isinstance(given, TextFormula):
        try:
            given = given.evaluate(m.variables)
        except Alarm as alarm:
            yield name, f"names no tool: {alarm.message}"
            return
    written = f'"{given}"' if isinstance(given, str) else f"{given:g}"
    tool = named_tool(m, given)
    if isinstance(given, str) and len(given) > LONGEST:
        yield name, f"must have at most {LONGEST} characters, got {len(given)}"
    elif tool is None:
        yield name, f"names tool {written}, which has no row in the tool table"
    elif tool.effective_radius <= 0:
        yield name, f"names tool {written}, which has no radius"
