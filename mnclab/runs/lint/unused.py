"""What a program gets ready and never uses: a cycle that nothing calls, a tool that is changed again before it cuts, a radius
compensation of a tool without radius."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.toolpath import Kind, Mask, Toolpath
from mnclab.runs.lint.once import once
from mnclab.runs.written import blocks_with
from mnclab.text.alarm import WARNING, Alarm

if TYPE_CHECKING:
    from mnclab.runs.run import Run

WORK = (Kind.LINE, Kind.ARC, Kind.PROBE, Kind.DWELL, Kind.STOP)  # at a stop somebody may measure, or deburr


def remarks(run: Run) -> Iterator[Alarm]:
    """A warning for the cycles, and one for the tools, of a program that came to its end; one about the setup."""
    if strange := [f"T{number}" for number in run.setup.true_tools if number not in run.tables.tools]:
        hint = "a true tool says how a tool of the table really is; write it in Setup(tools=…) too"
        message = f"the setup knows {', '.join(strange)} as true tools, which have no row in the tool table"
        yield Alarm(message, None, WARNING, hint)
    yield from _compensation(run)
    if run.ok:
        yield from _cycles(run)
        yield from _tools(run)


def _cycles(run: Run) -> Iterator[Alarm]:
    """Cycles for a call that none came to before the next definition, or the end."""
    control = run.control
    calls = {code for code, function in control.functions.items() if function.phase == "call"}
    waiting = {code for code, cycle in control.cycles.items() if cycle.runs == "call"}
    if "cycle" not in run.history or waiting.isdisjoint(run.history.log("cycle")[1]):
        return
    defines, called = (_executed(run, codes) for codes in (waiting, calls))
    called[run.toolpath.step[run.toolpath.label > 0]] = True  # patterns, and positions under a modal call, run it too
    steps = np.flatnonzero(defines)
    before = np.concatenate([[0], np.cumsum(called)])  # of a step; a call in the block of the definition counts for it
    idle = steps[before[steps] == before[np.append(steps[1:], len(called))]]
    if len(idle):
        how = "M99" if "CYCL CALL" not in calls else "CYCL CALL or M99"
        message = "a cycle is defined here and never called: it does nothing"
        yield once(run, idle.tolist(), message, f"a cycle of this kind works where {how} stands")


def _compensation(run: Run) -> Iterator[Alarm]:
    """Moves beside a contour whose tool has no radius, and lies on it; the ISO mill says it at its word G41 or G42."""
    path, message = run.toolpath, "compensates nothing"
    idle = path.is_motion & (path.side != 0) & (path.radius == 0)
    if idle.any() and not any(message in alarm.message or "has no row in" in alarm.message for alarm in run.alarms):
        message = f"the radius compensation {message}: the radius of T{int(path.tool[idle][0])} is 0"
        yield once(run, path.step[idle].tolist(), message, "call a tool, or give it its radius")


def _executed(run: Run, codes: set[str]) -> Mask:
    """Which steps (s,) executed a block with one of some codes."""
    found = np.zeros(len(run.steps.block), dtype=bool)
    for index, program in enumerate(run.programs):
        blocks, here = blocks_with(program, codes), run.steps.program == index
        found |= here & blocks[np.where(here, run.steps.block, 0)] if len(blocks) else False
    return found


def _tools(run: Run) -> Iterator[Alarm]:
    """Tools that are changed again before anything is done with them; the last one may wait for the next part."""
    changes = [(step, tool.number) for step, tool in run.history.changed("tool")]
    taken = [change for k, change in enumerate(changes) if not k or change[1] != changes[k - 1][1]]
    steps = np.array([step for step, _ in taken], dtype=run.toolpath.step.dtype)  # another type would copy them all
    rows = np.searchsorted(run.toolpath.step, steps)
    pairs = zip(taken, rows[:-1].tolist(), rows[1:].tolist())
    idle = [(step, number) for (step, number), a, b in pairs if number and step >= 0 and not _works(run.toolpath, a, b)]
    if idle:
        numbers = ", ".join(dict.fromkeys(f"T{number}" for _, number in idle))
        hint = "is it the tool that was meant, and is a part of the program missing?"
        message = f"a tool is changed again before it is used ({numbers})"
        yield once(run, [step for step, _ in idle], message, hint, *(f"T{number}" for _, number in idle))


def _works(path: Toolpath, first: int, stop: int) -> bool:
    """Whether rows of a path do something."""
    return bool((np.isin(path.kind[first:stop], WORK) | (path.label[first:stop] > 0)).any())
