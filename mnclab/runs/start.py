"""Starting at a block, as the block search of a control does: all before it is computed, and nothing of that moves.

The path begins where the tool stands before the block. What the machine has by then done on its own in a whole run (the
tool in the spindle, the speed, the place) is for the operator to do first, and is named; so is what reaches over the
start: a cycle, a radius compensation, a sub-program, measured values.
"""

from __future__ import annotations

from collections.abc import Iterator
from copy import copy
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mnclab.path.listing import point
from mnclab.running.flow import LEFT, RECORDED
from mnclab.runs.history import does_nothing, told
from mnclab.text.alarm import WARNING, Alarm, Span, by_place
from mnclab.text.given import whole
from mnclab.text.tables import Listing

if TYPE_CHECKING:
    from mnclab.runs.run import Run

#: What names of the history an operator sees to, and what is told of the others.
BY_HAND = ("tool", "spindle", "coolant", "position")
UNTOLD = (*BY_HAND, "motion", "cycle", "call", "compensation", "side", "speed", "turning", "stock")
WRITTEN = ("tools ", "datums ", "presets ")
SHOWN = 12  # variables that are told


class Missed(NamedTuple):
    """Something that a start skips: what it is about, what is to be done or known, and the line that says so (0: none)."""

    about: str
    says: str
    line: int = 0

    def __str__(self) -> str:
        return f"{self.about}: {self.says}{f' (line {self.line})' if self.line else ''}"


class MissedOnes(Listing, tuple[Missed, ...]):
    """All that a start skips; shown as a table."""

    HEAD, NUMBERS, NOTHING = ("about", "what", "line"), (2,), "nothing is missed"

    def texts(self) -> list[tuple[str, ...]]:
        """What the table says, row by row."""
        return [(one.about, one.says, str(one.line or "")) for one in self]

    def __repr__(self) -> str:
        return "\n".join(map(str, self)) or self.NOTHING


def start_at(run: Run, line: int, pass_: int = 1, program: int = 0) -> Run:
    """The run from a block on, as after the block search of a control: everything before the `pass_`-th execution of the
    line (of one of `programs`) is computed, and nothing of it moves.

    `.missed` of the result tells what is to be done first, and what reaches over the start; the blank is the whole one. An
    Alarm where no program can start.
    """
    line, pass_, program = whole(line, "the line"), whole(pass_, "pass_"), whole(program, "the number of the program")
    step = _step(run, line, pass_, program)
    span = run.programs[program].span_of_block(int(run.steps.block[step]))._replace(program=program)
    missed = MissedOnes(_missed(run, step))
    started = copy(run)
    for name in ("programmed", "toolpath"):
        path = getattr(run, name)
        setattr(started, name, path[int(np.searchsorted(path.step, step)) :])
    started.gouges = tuple(gouge for gouge in run.gouges if gouge.step >= step)
    started.made, started.missed, started.started = {}, missed, (line, pass_, program)
    started.alarms = by_place([*run.alarms, *_warnings(run, missed, span)])
    return started


def _step(run: Run, line: int, pass_: int, program: int) -> int:
    """The step that executes a line for the so manieth time; an Alarm with the reason where there is none."""
    found = run.executions(line, program)
    if 1 <= pass_ <= len(found):
        step = int(found[pass_ - 1])
        if any(times == RECORDED for _, times in _inside(run, step)):
            hint = "start at the block that calls the cycle"
            raise Alarm(f"line {line} describes a contour for a cycle: no program starts there", hint=hint)
        return step
    if len(found):
        raise Alarm(f"line {line} is executed {len(found)} times, pass_ {pass_} does not exist")
    if not 0 <= program < len(run.programs):
        raise Alarm(f"there is no program {program}: the run has {len(run.programs)}")
    first, last = run.programs[program].lines()
    if not ((first <= line) & (line <= last)).any():
        after = first[first > line]
        raise Alarm(f"line {line} holds no block", hint=f"the next one stands in line {after[0]}" if len(after) else "")
    stop = next((alarm for alarm in run.alarms if alarm.severity != WARNING), None)
    raise Alarm(
        f"the program does not come to line {line}", hint=f"it stops before: {stop.place}: {stop.message}" if stop else ""
    )


def _inside(run: Run, step: int) -> list[tuple[int, int]]:
    """The calls and repeats that a step stands in, outside first: program and block that entered it, and the times."""
    open_: list[tuple[int, int]] = []
    events = np.array(run._nesting, dtype=np.int64).reshape(-1, 3)
    for _, place, times in events[events[:, 0] <= step].tolist():
        if place == LEFT:
            open_.pop()
        else:
            open_.append((place, times))
    return open_


def _missed(run: Run, step: int) -> Iterator[Missed]:
    before = run.history.at(step - 1) if step else {}
    lines, position = run.lines(), run.history.value("position", max(step - 1, 0))

    def line_of(name: str) -> int:
        at = [k for k, _ in run.history.changed(name) if k < step]
        return int(lines[at[-1]]) if at and run.steps.program[at[-1]] == 0 else 0

    power_on = run.control.power_on()
    if "tool" in before:
        yield Missed("tool", f"put in {told({'tool': before['tool']}, before)[0].removeprefix('tool ')}", line_of("tool"))
    if before.get("turning") and before.get("speed"):
        sense = "clockwise" if before["turning"] > 0 else "counter-clockwise"
        yield Missed("spindle", f"turn it {sense} at {before['speed']:g} rev/min", max(line_of("turning"), line_of("speed")))
    if before.get("coolant", power_on.get("coolant")) != power_on.get("coolant"):
        yield Missed("coolant", f"switch on {before['coolant']}", line_of("coolant"))
    if step:
        yield Missed("position", f"go to {point(position, run.toolpath.unit, run.toolpath.lathe)}", line_of("position"))
    active = {
        name: value for name, value in before.items()
        if name not in UNTOLD and name not in run.variables and not name.startswith(("measured ", *WRITTEN))
        and value != power_on.get(name) and not does_nothing(name, value)
    }  # fmt: skip
    if said := told(active, before):
        yield Missed("active", ", ".join(said))
    cycle = run.control.cycles.get(str(before.get("cycle")))
    if cycle is not None:
        runs = cycle.runs == "position" or before.get("call")
        says = "runs at the positions that follow" if runs else "is defined, and runs where it is called"
        yield Missed("cycle" if runs else "defined", f"{cycle.code} ({cycle.title}) {says}", line_of("cycle"))
    if side := before.get("side"):
        where = "left" if side > 0 else "right"
        yield Missed("compensation", f"the path is corrected to the {where}: it begins at a corrected point", line_of("side"))
    yield from _nested(run, step)
    if values := {name: value for name, value in before.items() if name in run.variables}:
        said = [f"{name} = {value:g}" if isinstance(value, float) else f"{name} = {value}" for name, value in values.items()]
        more = f", … {len(said) - SHOWN} more" if len(said) > SHOWN else ""
        yield Missed("variables", f"as computed: {', '.join(said[:SHOWN])}{more}")
    for name in before:
        if name.startswith("measured "):
            says = f"{name.removeprefix('measured ')} is that of the computed run, not of the part on the machine"
            yield Missed("measured", says, line_of(name))
        elif name.startswith(WRITTEN):
            table, _, row = name.partition(" ")
            yield Missed("table", f"row {row} of the {table} is as the program wrote it", line_of(name))


def _nested(run: Run, step: int) -> Iterator[Missed]:
    for place, times in _inside(run, step):
        program, block = place >> 32, place & 0xFFFFFFFF
        line = int(run.programs[program].line_of(block))
        what = f"a repeat ({times} times more)" if times else "a sub-program or a called program"
        yield Missed("inside", f"the block stands in {what}, entered at {run.place_of_line(line, program)}")


def _warnings(run: Run, missed: MissedOnes, span: Span) -> Iterator[Alarm]:
    """What is to be done first, in one sentence, and each thing that reaches over the start."""
    by_hand = [one.says for one in missed if one.about in BY_HAND]
    if by_hand:
        yield Alarm(f"the program starts here: first {', '.join(by_hand)}", span, WARNING, source=run.programs[span.program])
    for one in missed:
        if one.about in ("cycle", "compensation", "inside", "measured"):
            yield Alarm(f"the program starts here: {one}", span, WARNING, source=run.programs[span.program])
