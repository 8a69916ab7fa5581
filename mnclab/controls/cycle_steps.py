"""A cycle looked at without a program: its steps in a table.

The cycle is bound as a program would bind it, and its steps are carried out on a machine that nobody else has; so the
table shows where each of them ends. What the cycle asks of the machine (a tool, a spindle that turns or stands) is looked
for among the tools of the setup; a touch finds the part where it is aimed at; what needs a program is an Alarm.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from itertools import product
from typing import Any, NamedTuple

from mnclab.controls.choice import help
from mnclab.machine.control import Control
from mnclab.machine.cycle import Cycle, Definition, Parameter
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Setup
from mnclab.machine.touching import Contact
from mnclab.machine.true_size import MILLS
from mnclab.path.listing import figure, point
from mnclab.running.binding import store, value_of
from mnclab.running.interpreter import Interpreter
from mnclab.running.performing import Place, run_cycle
from mnclab.text.alarm import Alarm
from mnclab.text.given import plain, shown
from mnclab.text.nearest import hint
from mnclab.text.program import Word, place_of
from mnclab.text.tables import html_table, text_table

from mnclab.machining.steps import (  # isort: skip
    Along, Blocks, Call, Coolant, Each, Go, Orient, Record, Say, Spin, Step, Swivel, Thread, Touch, Turn, Wait, Write,
)  # fmt: skip

Point = tuple[float, float, float]
HEAD = ("step", "label", "x", "y", "z", "feed", "")
SPINDLE = {1: "clockwise", -1: "counter-clockwise", 0: "stopped"}


class Row(NamedTuple):
    """A step, where the tool stands after a motion (mm, in the program), and its feed in words."""

    step: Step
    end: Point | None = None
    feed: str = ""


class CycleSteps(Sequence[Step]):
    """The steps of a cycle from a place on, and the values (by address) that they were made with; shown as a table."""

    def __init__(self, cycle: type[Cycle], values: dict[str, Any], start: Point, rows: Sequence[Row]) -> None:
        self.cycle, self.values, self.start, self.rows = cycle, values, start, tuple(rows)

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, index: Any) -> Any:
        return tuple(row.step for row in self.rows[index]) if isinstance(index, slice) else self.rows[index].step

    @property
    def title(self) -> str:
        given = {address: v if isinstance(v, str) else shown(v) for address, v in self.values.items()}
        said = " ".join((f"{self.cycle.code} {self.cycle.title}:", *map("=".join, given.items())))
        return f"{said}, called at {point(self.start)}"

    def cells(self) -> Iterator[tuple[str, ...]]:
        for step, end, feed in self.rows:
            places = ("", "", "") if end is None else map(figure, end)
            detail = DETAILS[type(step)](step) if type(step) in DETAILS else ""
            yield type(step).__name__.lower(), step.label, *places, feed, detail

    def __str__(self) -> str:
        return f"{self.title}\n{text_table(HEAD, self.cells())}"

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return f"<p>{self.title}</p>{html_table(HEAD, self.cells(), numbers=(2, 3, 4, 5))}"


#: What a step does beside going to its end.
DETAILS: dict[type[Step], Callable[[Any], str]] = {
    Turn: lambda step: f"{figure(math.degrees(step.angle))}°",
    Thread: lambda step: f"{figure(step.pitch)} mm/rev",
    Wait: lambda step: f"{figure(step.seconds)} s",
    Spin: lambda s: SPINDLE[s.turning] + (f", {figure(s.speed)} rev/min" if s.turning and s.speed else ""),
    Orient: lambda step: f"at {figure(step.angle)}°",
    Coolant: lambda step: "on" if step.on else "off",
    Swivel: lambda step: " ".join(f"{axis}{figure(angle)}°" for axis, angle in zip("ABC", step.angles, strict=True)),
    Say: lambda step: step.text,
    Write: lambda step: f"{step.what} {'' if step.key is None else step.key} = {shown(step.value)}",
}


def steps(code: str, control: str, /, setup: Setup | None = None, **values: Any) -> CycleSteps:
    """The steps of a cycle as a table, without a program: `mnclab.steps("CYCL DEF 200", "tnc-620", Q201=-20)`.

    `values` go by address or by name, in the units of programs; those that are not given are the examples of the
    declaration. `setup` is the machine, of whose tools the first that fits is taken.
    """
    found = help(code, control)
    cycle: Any = found.entry
    if not (isinstance(cycle, type) and issubclass(cycle, Cycle)):
        known = ", ".join(found.control.cycles)
        raise Alarm(f"{code} is no cycle of {found.control.name}: only a cycle has steps", hint=f"cycles: {known}")
    given = chosen(cycle, values)
    faults = []
    for machine in situations(found.control, cycle, setup or Setup()):
        rows: list[Row] = []
        try:
            definition, start = define(machine, cycle, given), machine.programmed
            run_cycle(machine, definition, noting(machine, cycle, rows))
            shown_values = {p.address: given[p.name] for p in cycle.parameters() if p.name in given}
            return CycleSteps(cycle, shown_values, start, rows)
        except Alarm as alarm:
            faults.append(Alarm(alarm.message, hint=alarm.hint))  # without its place in a program
    raise faults[0]


def chosen(cycle: type[Cycle], values: dict[str, Any]) -> dict[str, Any]:
    """Values by name: those that are given by address or name, and the examples of parameters that need one."""
    parameters = cycle.parameters()
    known = {each: p for p in reversed(parameters) for each in (*p.aliases, p.address, p.name)}
    given: dict[str, Any] = {}
    for name, value in values.items():
        if name not in known:
            addresses = ", ".join(p.address for p in parameters) or "none"
            raise Alarm(f"{cycle.code} has no parameter {name}; it has {addresses}", hint=hint(name, known))
        if known[name].name in given:
            raise Alarm(f"{cycle.code} {known[name].address} is given twice, as an address and as {known[name].name}")
        given[known[name].name] = plain(value)
    replaced = {p.instead for p in parameters if p.name in given} | given.keys()
    for p in parameters:
        if p.name in replaced or (p.instead and (p.instead in given or not p.required)):
            continue
        first = next(iter(p.choices or ()), None) if p.required else None
        if (value := first if p.example is None else p.example) is not None:
            given[p.name] = value
    return given


def situations(control: Control, cycle: type[Cycle], setup: Setup) -> Iterator[Machine]:
    """Machines on which a cycle may run: with each tool, first those made for it, with the spindle on and off."""
    wanted = "mill" if cycle.does == MILLS else "probe" if "PROBE" in cycle.code else "drill"
    tools = sorted((n for n in setup.tools if n), key=lambda number: setup.tools[number].kind != wanted)
    places = ((40.0, 0.0, 5.0), (0.0, 0.0, 5.0)) if control.lathe else ((20.0, 10.0, 20.0),)
    called = next((each for each in control.cycles.values() if each.runs == "call"), None)  # by a pattern
    for place, turning, number in product(places, (1, 0), tools):
        machine = Interpreter(control, setup, control.read("", "")).machine
        for group, code in control.power_on().items():
            machine.set_modal(group, code)
        if control.start:
            control.start(machine)
        machine.change_tool(machine.tables.tools[number])
        machine.spindle(1000.0, turning)
        machine.rapid(*place)
        machine.change("feed", 0.2 if machine.per_rev else 100.0)
        machine.cycle = Definition(called, called.code, {}, {}, None) if called else None
        yield machine


def define(m: Machine, cycle: type[Cycle], given: dict[str, Any]) -> Definition:
    parameters = {p.name: p for p in cycle.parameters()}
    words = {name: word_of(parameters[name], value) for name, value in given.items()}
    values = {name: read(m, parameters[name], cycle, word) for name, word in words.items()}
    definition = Definition(cycle, cycle.code, values, words, None)
    definition.values = cycle.prepare(values, words, m, definition.extra)
    if m.control.storage == "variables" and cycle.in_variables:
        store(m, definition)
    return definition


def word_of(parameter: Parameter, value: Any) -> Word:
    return Word(parameter.address, float(value) if isinstance(value, int) else value, place_of(1, 1, 1))


def read(m: Machine, parameter: Parameter, cycle: type[Cycle], word: Word) -> Any:
    if not parameter.several:
        return value_of(m, parameter, cycle.code, word, cycle.in_variables)
    several = word.value if isinstance(word.value, tuple) else (word.value,)
    return tuple(value_of(m, parameter, cycle.code, word_of(parameter, one), cycle.in_variables) for one in several)


def noting(m: Machine, cycle: type[Cycle], rows: list[Row]) -> Callable[[Iterable[Step], Place], Iterable[Step]]:
    """What notes the steps on their way, with where they end; it obeys the steps that a machine alone cannot."""

    def note(step: Step) -> None:
        if isinstance(step, Wait) and not step.seconds:
            return
        moved = isinstance(step, Go | Turn | Along | Thread | Swivel | Touch)
        feed = getattr(step, "feed", None) if not isinstance(step, Thread) else math.nan
        feed = m.feed if feed is None else feed
        words = "rapid" if feed == math.inf else "" if feed is None or math.isnan(feed) else figure(feed)
        rows.append(Row(step, m.programmed, words) if moved else Row(step))

    def through(steps: Iterable[Step], about: Place) -> Generator[Step, Any, Any]:
        asking = steps if isinstance(steps, Generator) else (step for step in steps)
        answer: Any = None
        while True:
            try:
                step = asking.send(answer)
            except StopIteration:
                return
            match step:
                case Each():
                    for x, y in step.points.tolist():
                        yield from through(step.visit(x, y), about)
                case Touch():
                    yield Go(step.label, step.z, step.feed, step.x, step.y)
                    note(step)
                    answer = touched(m, step)
                case Call():
                    note(step)
                case Blocks() | Record():
                    raise Alarm(f"{cycle.code} needs a program, whose blocks it runs", hint="mnclab.run(…) runs one")
                case _:
                    answer = yield step
                    note(step)

    return through


def touched(m: Machine, step: Touch) -> Contact:
    """The answer of a part that stands where the probe was sent."""
    x, y, z = m.programmed
    centre = x, y, z + (m.radius if step.ball is None else step.ball)
    return Contact(centre, m.to_machine(centre), hit=True)
