"""The steps of a cycle without a program: `steps("CYCL DEF 200", "tnc-620", Q201=-20, Q202=5)`.

The cycle gets its words, a tool, and a machine that stands at the zero point and turns its spindle; it is not carried
out. So a touch is answered as if the probe met the part where the touch leads, and of what is done at many points the
first is shown.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from mnclab.controls.choice import help as help_on
from mnclab.geometry.contours import Contour
from mnclab.machine.cycle import Cycle, Definition
from mnclab.machine.machine import Machine
from mnclab.machine.setup import MAGAZINE, Setup
from mnclab.machine.touching import Contact
from mnclab.machining.steps import RAPID, Each, Record, Step, Touch
from mnclab.path.tool import Tool
from mnclab.running.binding import as_it_stands, assign, fault, instance, named, store
from mnclab.running.flow import Course
from mnclab.runs.values import said
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown
from mnclab.text.nearest import hint
from mnclab.text.program import Word
from mnclab.text.tables import html_table, text_table

MOST = 20_000  # steps


class StepTable(tuple[Step, ...]):
    """The steps of a cycle, in order; shown as a table."""

    def rows(self) -> list[tuple[str, str, str]]:
        """What the table shows of each: its kind, its values, what is happening."""
        return [(type(step).__name__, _said(step), step.label) for step in self]

    def __repr__(self) -> str:
        return text_table(("step", "values", "what is happening"), self.rows())

    def _repr_html_(self) -> str:
        return html_table(("step", "values", "what is happening"), self.rows())


def steps(
    code: str, control: str | None = None, /, *, tool: Tool = MAGAZINE[1],
    start: tuple[float, float, float] | None = None, **words: float | str,
) -> StepTable:  # fmt: skip
    """The steps of a cycle as a table: `steps("G83", "mnc", X=20, Y=10, Z=-30, R=2, K=5, F=120)`.

    `words` are those of the cycle, by their addresses, in its units; x and y of the steps count from where the tool
    stands, or from the middle of what it makes. It stands at `start`, by default (0, 0, 0), on a lathe (30, 0, 20) mm; the
    spindle turns at 1000 rev/min and the feed is 100 mm/min.
    """
    page = help_on(code, control)
    cycle = page.entry
    if not (isinstance(cycle, type) and issubclass(cycle, Cycle)):
        raise Alarm(f"{code} is no cycle: it has no steps", hint=f"cycles: {', '.join(page.control.cycles)}")
    if not isinstance(tool, Tool):
        raise Alarm(f"the tool must be a Tool, got {shown(tool)}", hint="mnclab.Tool(radius=5)")
    setup = Setup(tools={1: tool}, start=start or ((30, 0, 20) if page.control.lathe else (0, 0, 0)))
    m = Machine(page.control, setup, Course(page.control.read("", "steps")))
    m.modal.update(page.control.power_on())
    m.put(tool=m.tables.tools[1], speed=1000.0, turning=1, feed=100.0)
    try:
        bound = _bound(m, cycle, tuple(_words(cycle, words)))
        return StepTable(_walked(bound.moves(m) or ()))
    except Alarm as alarm:  # there is no program to show a place of
        raise Alarm(alarm.message, hint=alarm.hint) from None


def _words(cycle: type[Cycle], given: dict[str, float | str]) -> Iterator[Word]:
    """What was given as the words of a block."""
    known = [address for p in cycle.parameters() for address in (p.address, *p.aliases) if not p.mark]
    for address, value in given.items():
        if address not in known:
            near = hint(address, known) or f"known: {', '.join(known)}"
            raise Alarm(f"{cycle.code} has no {address}", hint=near)
        if not isinstance(value, str):
            check_number(value, f"{cycle.code} {address}")
        yield Word(address, value if isinstance(value, str) else float(value), 0)


def _bound(m: Machine, cycle: type[Cycle], words: tuple[Word, ...]) -> Cycle:
    """The cycle with its values, as the interpreter makes it of a block."""
    values, given = assign(m, cycle, cycle.code, words)
    definition = Definition(cycle, cycle.code, values, given, None)
    definition.values = cycle.prepare(values, given, m, definition.extra)
    if m.control.storage == "variables" and cycle.in_variables:
        store(m, definition)
    bound = instance(as_it_stands(m, definition))
    for name, sentence in bound.check(m):
        raise fault(definition, named(definition, name), sentence)
    return bound


def _walked(found: Iterable[Step]) -> Iterator[Step]:
    """Steps in order, each that has an answer given one."""
    asking = found if isinstance(found, Generator) else (step for step in found)
    answer: Any = None
    for _ in range(MOST):
        try:
            step = asking.send(answer)
        except StopIteration:
            return
        yield step
        answer = None
        if isinstance(step, Touch):
            answer = Contact((step.x, step.y, step.z), (step.x, step.y, step.z), hit=True)
        elif isinstance(step, Record):
            raise Alarm(f"the contour {step.name} stands in a program: its steps cannot be shown without one")
        elif isinstance(step, Each) and len(step.points):
            yield from _walked(step.visit(*step.points[0]))


def _said(step: Step) -> str:
    """The values of a step that say something."""
    values = step._asdict()
    feed = ["rapid"] if values.get("feed") == RAPID else []
    told = ((name, _value(each)) for name, each in values.items() if name != "label" and each is not None)
    return ", ".join([f"{name} {said}" for name, said in told if said and (name, feed) != ("feed", ["rapid"])] + feed)


def _value(value: Any) -> str:
    """A value in short: of many points how many, of a function nothing."""
    if isinstance(value, Mapping):
        return ", ".join(f"{name} {_value(each)}" for name, each in value.items())
    if isinstance(value, np.ndarray | list):
        return f"({len(value)})" if np.shape(value) != (4, 4) else said("", tuple(map(tuple, value)))
    return "" if callable(value) and not isinstance(value, Contour) else said("", value)
