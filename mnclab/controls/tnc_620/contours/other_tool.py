"""The tool that a cycle names beside the one in the spindle: Q13/QS13 of cycle 21, Q18/QS18 of cycle 22 (8.5, 8.6)."""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.machine.machine import Machine
from mnclab.path.tool import Tool

LONGEST = 16  # characters of a name


def row_of(m: Machine, given: float | str) -> Tool | None:
    """The row of the tool table with a number or a name, whatever its case; for 0 that of the tool in the spindle."""
    tools = m.tables.tools
    if isinstance(given, str):
        return next((tool for tool in tools.values() if tool.name.upper() == given.strip().upper()), None)
    return tools.get(given) if given else tools.get(m.tool.number, m.tool)  # type: ignore[call-overload]


def named(m: Machine, name: str, given: float | str) -> Iterator[Fault]:
    """What is wrong with the tool that a parameter names."""
    if isinstance(given, str) and not 0 < len(given.strip()) <= LONGEST:
        yield name, f"must be a name of 1 to {LONGEST} characters, got {len(given.strip())}"
    elif not isinstance(given, str) and given < 0:
        yield name, f"must be a number of a tool or its name, got {given:g}"
    elif (tool := row_of(m, given)) is None:
        shown = f'"{given}"' if isinstance(given, str) else f"{given:g}"
        yield name, f"names tool {shown}, which has no row in the tool table"
    elif tool.radius <= 0:
        yield name, f"names tool {tool.number}, whose radius is {tool.radius:g}"
