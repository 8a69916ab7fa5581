"""What one block does, in plain words: each word with the function that takes it, where the manual says so, what it
changed; and the way from the programmed point through datum, transformations and compensation to the tool tip.
"""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING

import numpy as np

from mnclab.machine.control import switches
from mnclab.path.listing import MM, point, words
from mnclab.runs.meanings import meanings
from mnclab.runs.stages import stages
from mnclab.runs.values import said, unit_of
from mnclab.text.alarm import Alarm, quoted
from mnclab.text.program import Program
from mnclab.text.tables import html_table

if TYPE_CHECKING:
    from mnclab.runs.moment import Moment
    from mnclab.runs.run import Run

SHOWN = 12  # rows of the path


class Explanation:
    """A block explained; `meanings`, `changed` (name, before, after), `stages` and `moves` hold what is shown."""

    def __init__(self, run: Run, moment: Moment) -> None:
        self.run, self.moment = run, moment
        span = moment.block.span
        self.program = run.programs[run.steps.program[moment.step]]
        last = int(self.program.lines()[1][run.steps.block[moment.step]])
        self.alarms = tuple(_alarms(run, self.program, span.line, last))
        self.unit = unit_of(moment.state)
        self.radii = ", X as radius" if run.toolpath.lathe else ""
        self.changed = []
        for name, value in moment.changed.items():
            unit = MM if name == "feed" and moment.state.get("per_time") else self.unit.for_feed(moment.state.get("per_rev"))
            old = said(name, run.history.value(name, moment.step - 1), unit) if moment.step else ""
            if (new := said(name, value, unit)) != old:
                self.changed.append((name, old, new))
        self.skipped = moment.block.skip in switches(run.settings)
        self.meanings = tuple(meanings(run, moment, {name: (old, new) for name, old, new in self.changed}))
        self.stages = tuple(stages(run, moment))
        path = run.toolpath[moment.rows]
        shown = len(path) if len(path) <= SHOWN + 1 else SHOWN  # a line that says "1 more" is no shorter
        self.moves = tuple(f"{move.kind.name.lower()} {words(move, self.unit)}".strip() for move in path[:shown])
        self.more_moves = len(path) - shown

    @property
    def title(self) -> str:
        text = quoted(self.program.line_text(self.moment.line).strip())[0]
        times = _executions(self.run, self.moment.step)
        again = f" (execution {times})" if times > 1 else ""
        return f"line {self.moment.line}{again}: {text}"

    def _moves_told(self) -> list[str]:
        return [*self.moves, *([f"… {self.more_moves} more"] if self.more_moves else [])]

    def __str__(self) -> str:
        lines = [self.title]
        if self.skipped:
            lines.append("  passed over: block skip is on")
        lines += [f"  {alarm.severity}: {alarm.message}{alarm.others}" for alarm in self.alarms]
        wide = max((len(m.word) for m in self.meanings), default=0)
        for m in self.meanings:
            source = f"  [{m.source}]" if m.source else ""
            changed = f"  ({m.changed})" if m.changed else ""
            lines.append(f"  {m.word.ljust(wide)}  {m.says}{changed}{source}")
        wide = max(len(stage.name) for stage in self.stages)
        parts = {
            f"moves{self.radii}": self._moves_told(),
            "changed": [
                f"{name}: {before} -> {now}" if before else f"{name}: {now}" for name, before, now in self.changed
            ],
            f"from the program to the tool{self.radii}": [
                f"{s.name.ljust(wide)}  {point(np.array(s.point), self.unit)}  {s.note}".rstrip() for s in self.stages
            ],
        }
        for title, told in parts.items():
            lines += [f"  {title}", *(f"    {line}" for line in told)] if told else []
        return "\n".join(lines)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        moves = "\n".join(self._moves_told())
        words = [(m.word, m.says, m.changed, m.source) for m in self.meanings]
        stages = [(s.name, *map(self.unit.figure, s.point), s.note) for s in self.stages]
        parts = [
            f"<h4>{escape(self.title)}</h4>",
            "<p>passed over: block skip is on</p>" if self.skipped else "",
            *(alarm._repr_html_() for alarm in self.alarms),
            html_table(("word", "means", "changed", "section"), words) if words else "",
            f"<pre>{escape(moves)}</pre>" if moves else "",
            html_table(("value", "before", "after"), self.changed) if self.changed else "",
            html_table((f"from the program to the tool{self.radii}", "X", "Y", "Z", ""), stages, numbers=(1, 2, 3)),
        ]
        return f"<div>{''.join(parts)}</div>"


def _alarms(run: Run, program: Program, first: int, last: int) -> Iterator[Alarm]:
    """The alarms that have a place in some lines, told there."""
    for alarm in run.alarms:
        if not alarm.span or alarm.source is not program:
            continue
        if first <= alarm.span.line <= last:
            yield alarm
            continue
        here = [p for p in alarm.places if p.program == alarm.span.program and first <= p.line <= last]
        yield from (alarm.at(place) for place in here[:1])


def _executions(run: Run, step: int) -> int:
    """How often the block of a step was executed up to it."""
    steps = run.steps
    same = (steps.block[: step + 1] == steps.block[step]) & (steps.program[: step + 1] == steps.program[step])
    return int(same.sum())
