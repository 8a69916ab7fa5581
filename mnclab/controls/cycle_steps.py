"""A cycle looked at without a program: its steps in a table.

The cycle is bound as a program would bind it, and its steps are carried out on a machine that nobody else has; so the
table shows where each of them ends. What the cycle asks of the machine (a tool, a spindle that turns or stands) is looked
for among the tools of the setup; a touch finds the part of the setup, or one where it is aimed at; what needs a program is
an Alarm.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Generator, Iterable, Iterator
from dataclasses import replace
from itertools import product
from typing import Any

from mnclab.controls.choice import help
from mnclab.controls.cycle_table import DECIMALS, CycleSteps, Point, Row
from mnclab.machine.control import Control
from mnclab.machine.coordinates import MILLS
from mnclab.machine.cycle import Cycle, Definition, Parameter
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Setup
from mnclab.machine.touching import FEELS, PROBES, Contact
from mnclab.machine.trial import is_text
from mnclab.path.listing import figure
from mnclab.running.cycles import Place, instance, run_cycle, store, units_of, value_of
from mnclab.running.interpreter import Interpreter
from mnclab.text.alarm import Alarm, hint
from mnclab.text.given import check_number, fitting, plain, shown
from mnclab.text.program import Word, place_of

from mnclab.machining.steps import (  # isort: skip
    Along, Blocks, Call, Each, Go, Record, Step, Swivel, Thread, Touch, Turn, Wait,
)  # fmt: skip

MOST = 5_000  # steps of a table
FEWER = "take values that make fewer infeeds, passes or repeats; a program runs them all: mnclab.run(…)"
NOWHERE = place_of(1, 1, 1)  # of a word that stands in no program


@fitting
def steps(code: str, control: str, /, setup: Setup | None = None, **values: Any) -> CycleSteps:
    """The steps of a cycle as a table, without a program: `mnclab.steps("CYCL DEF 200", "tnc-620", Q201=-20)`.

    `values` go by address or by name, in the units of programs; those that are not given are the examples of the
    declaration. `setup` is the machine, of whose tools the first that fits is taken.
    """
    if not isinstance(setup, Setup | None):
        raise Alarm(f"setup must be a Setup, got {shown(setup)}", hint="Setup(tools={1: Tool(radius=5)})")
    found = help(code, control)
    cycle: Any = found.entry
    if not (isinstance(cycle, type) and issubclass(cycle, Cycle)):
        known = ", ".join(found.control.cycles)
        raise Alarm(f"{shown(code)} is no cycle of {found.control.name}: only a cycle has steps", hint=f"cycles: {known}")
    given = chosen(cycle, values)
    faults = []
    for machine in situations(found.control, cycle, setup or found.control.trial_setup or Setup()):
        rows: list[Row] = []
        try:
            definition, start = define(machine, cycle, given), machine.programmed
            if (part := instance(definition).figure(machine)) and machine.setup.part is None:
                machine.setup = replace(machine.setup, part=part)
            run_cycle(machine, definition, noting(machine, cycle, rows))
            return CycleSteps(cycle, given, start, rows, lathe=found.control.lathe, per_rev=machine.per_rev, part=part)
        except Alarm as alarm:
            faults.append(Alarm(alarm.message, hint=alarm.hint))  # without its place in a program
            if len(rows) > MOST:
                raise faults[-1] from None
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
        given[known[name].name] = allowed(cycle, known[name], plain(value))
    replaced = {p.instead for p in parameters if p.name in given} | given.keys()
    for p in parameters:
        if p.name in replaced or (p.instead and (p.instead in given or not p.required)):
            continue
        first = next(iter(p.choices or ()), None) if p.required else None
        if (value := first if p.example is None else p.example) is not None:
            given[p.name] = value
    return given


def allowed(cycle: type[Cycle], parameter: Parameter, value: Any) -> Any:
    """A value that a program could write: a text, a finite number, or several where a parameter takes them."""
    what = f"{cycle.code} {parameter.address} ({parameter.meaning})"
    for one in value if isinstance(value, tuple) and parameter.several else (value,):
        if not isinstance(one, str):
            check_number(one, what, at_least=-1e15, at_most=1e15)
            if is_text(parameter):
                raise Alarm(f"{what} must be a text, got {shown(value)}")
    return value


def situations(control: Control, cycle: type[Cycle], setup: Setup) -> Iterator[Machine]:
    """Machines on which a cycle may run: with each tool, first those made for it, with the spindle on and off."""
    wanted = "mill" if cycle.does == MILLS else "probe" if cycle.does in (PROBES, FEELS) else "drill"
    magazine = control.magazine if setup.tools is None else setup.tools
    tools = sorted((n for n in magazine if n), key=lambda number: magazine[number].kind != wanted)
    places = (trial_start(control, cycle, setup), (0.0, 0.0, 5.0)) if control.lathe else ((20.0, 10.0, 20.0),)
    called = next((each for each in control.cycles.values() if each.runs == "call"), None)  # by a pattern
    spindle = (0, 1) if wanted == "probe" else (1, 0)
    for place, turning, number in product(places, spindle, tools):
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


def trial_start(control: Control, cycle: type[Cycle], setup: Setup) -> Point:
    """Where the trial program of a lathe calls the cycle: the examples of its parameters are made for that place."""
    text = control.trial(cycle, []) if control.trial else None
    if text is None:
        return 40.0, 0.0, 5.0
    before = text[: text.rindex(f"\n{cycle.code}") + 1]
    trial = Interpreter(control, Setup(settings=setup.settings), control.read(before, ""))  # tools of its own
    trial.run()
    return trial.machine.programmed


def define(m: Machine, cycle: type[Cycle], given: dict[str, Any]) -> Definition:
    parameters = {p.name: p for p in cycle.parameters()}
    words = {name: word_of(parameters[name], value) for name, value in given.items()}
    values = {name: read(m, parameters[name], cycle, word) for name, word in words.items()}
    definition = Definition(cycle, cycle.code, values, words, None, units=units_of(m))
    definition.values = cycle.prepare(values, words, m, definition.extra)
    if m.control.storage == "variables" and cycle.in_variables:
        store(m, definition)
    if cycle.runs == "position":
        m.position_cycle = definition
    elif cycle.runs == "call":
        m.cycle = definition
    return definition


def word_of(parameter: Parameter, value: Any) -> Word:
    return Word(parameter.address, float(value) if isinstance(value, int) else value, NOWHERE)


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
        own = getattr(step, "feed", None)
        feed = m.feed if own is None else own
        words = "rapid" if feed == math.inf else "" if feed is None or math.isnan(feed) else figure(feed, DECIMALS)
        if isinstance(step, Thread):
            words = figure(step.pitch, DECIMALS) + " mm/rev" * (not m.per_rev)
        rows.append(Row(step, m.programmed, words) if moved else Row(step))
        if len(rows) > MOST:
            raise Alarm(f"{cycle.code} has more than {MOST} steps with these values: nobody would read their table", hint=FEWER)

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
                case Touch() if not (m.felt and (m.felt.setter or m.felt.part)):
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
    return Contact(centre, m.to_machine(centre), hit=True, tip=m.tip)
