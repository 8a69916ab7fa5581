"""Which tool cuts in a program of a control that has no tool words: every cycle has the one that is made for it.

The operator changed tools at such a control. A control names the tools of its magazine by the codes of cycles
(`Control.cycle_tools`, "" for moves of none, "inside G77" where that cuts away from the axis). A tool 0 that the setup
gives a body stands for all of them.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.tool import Tool
from mnclab.path.toolpath import Index, Kind, Toolpath
from mnclab.workpiece.cutting import tool_exists

if TYPE_CHECKING:
    from mnclab.runs.run import Run

INSIDE, PLAIN = "inside ", ""


def cycle_tools(run: Run, tools: list[Tool], which: Index) -> tuple[list[Tool], Index]:
    """The tools and which of them each row has (n,), with those of cycles where a row has none."""
    by_code, table = run.control.cycle_tools, run.setup.tools or {}
    if not by_code:
        return tools, which
    path, bare = run.toolpath, ~np.array([tool_exists(tool) for tool in tools])[which]
    if tool_exists(own := table.get(0, Tool())):
        return [*tools, own], np.where(bare, len(tools), which)
    place = {code: len(tools) + k for k, code in enumerate(by_code)}
    chosen = np.array([place[code] for code in _codes(path, tuple(by_code))], dtype=np.int64)
    own_ones = [replace(table.get(number, Tool()), number=number) for number in by_code.values()]
    return [*tools, *own_ones], np.where(bare, chosen, which)


def _codes(path: Toolpath, known: tuple[str, ...]) -> list[str]:
    """The code of the cycle that a row (n,) belongs to. A rapid between cycles brings the tool of the next one."""
    of_label = [next((code for code in known if code and label.split(" ")[0] == code), PLAIN) for label in path.labels]
    codes = [of_label[k] for k in path.label.tolist()]
    codes = _inside(path, codes, known)
    ahead = next((code for code in reversed(codes) if code), PLAIN)
    for row in range(len(codes) - 1, -1, -1):
        if codes[row]:
            ahead = codes[row]
        elif path.kind[row] not in (Kind.LINE, Kind.ARC):
            codes[row] = ahead
    return codes


def _inside(path: Toolpath, codes: list[str], known: tuple[str, ...]) -> list[str]:
    """The same, with a name of its own for turning along Z that is never nearer to the axis than where it began."""
    found, step = list(codes), path.step
    for number in np.unique(step[[INSIDE + code in known for code in codes]]):
        rows = np.flatnonzero(step == number)
        cuts = rows[path.kind[rows] == Kind.LINE]
        along = cuts[path.start[cuts, 2] != path.end[cuts, 2]]
        start = path.start[rows[0], 0]
        if len(along) and path.end[along, 0].min() > start:
            for row in rows:
                found[row] = INSIDE + codes[row]
    return found
