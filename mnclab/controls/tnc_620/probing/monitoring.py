"""Tool monitoring of cycles that inspect (TNC 620, 16.1): the tool that made a figure is compensated, or found broken."""

from __future__ import annotations

from collections.abc import Generator
from dataclasses import replace
from typing import Any

from mnclab.controls.tnc_620.contours.other_tools import Named, named_tool
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import SLACK
from mnclab.machining.steps import Step, Write


def monitored(m: Machine, name: Named, deviation: float, radius: float, length: float) -> Generator[Step, Any, str]:
    """Adds `radius` to DR and `length` to DL; returns what an alarm says of a broken tool, which is locked instead.

    `deviation` (mm) is the greatest one of a size, broken is a tool whose RBREAK is smaller. What changed counts from the next
    TOOL CALL on.
    """
    tool = named_tool(m, name)
    assert tool is not None  # `check` has found it
    number = next(number for number, each in m.tables.tools.items() if each is tool)
    if 0 < tool.wear.break_radius < deviation - SLACK:
        yield Write("tools", replace(tool, locked=True), number)
        return f"tool {number:g} is broken: a deviation of {deviation:.4f} is more than its RBREAK {tool.wear.break_radius:g}"
    if radius or length:
        yield Write("tools", replace(tool, dr=tool.dr + radius, dl=tool.dl + length), number)
    return ""
