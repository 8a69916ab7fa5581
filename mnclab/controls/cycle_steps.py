"""A cycle looked at without a program: its steps in a table."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Generator, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any, NamedTuple

from mnclab.controls.choice import help
from mnclab.machine.control import Control
from mnclab.machine.coordinates import MILLS
from mnclab.machine.cycle import Cycle, Definition, Parameter
from mnclab.machine.machine import Machine
from mnclab.machine.setup import AXES, Datum, Setup, tool_line
from mnclab.machine.touching import FEELS, PROBES, Contact
from mnclab.machine.trial import is_text, on_its_machine
from mnclab.machining.steps import (
    Along,
    Blocks,
    Call,
    Coolant,
    Each,
    Go,
    Orient,
    Pause,
    Record,
    Say,
    Spin,
    Step,
    Swivel,
    Thread,
    Touch,
    Turn,
    Wait,
    Write,
)
from mnclab.path.listing import figure, point
from mnclab.running.cycles import Place, instance, run_cycle, store, units_of, value_of
from mnclab.running.interpreter import Interpreter
from mnclab.runs.history import described, said
from mnclab.text.alarm import Alarm, hint
from mnclab.text.given import check_number, fitting, plain, shown
from mnclab.text.program import Word, place_of
from mnclab.text.tables import Listing
from mnclab.workpiece.part import Part

# The steps of a cycle as a table for a person: lengths in mm, and in words what a step does beside going to its end.

Point = tuple[float, float, float]
DECIMALS = 3  # of a length and of a feed, as a control shows them
SPINDLE = {1: "clockwise", -1: "counter-clockwise", 0: "stopped"}
SIDES = {1: "left", -1: "right", 0: "off"}


class StepRow(NamedTuple):
    """A step, where the tool stands after a motion (mm, in the program), and its feed in words."""

    step: Step
    end: Point | None = None
    feed: str = ""


class CycleSteps(Listing, Sequence[Step]):
    """The steps of a cycle from a place on, and the values (by parameter name) that they were made with.

    As a table it leaves out what the control keeps for itself, and for a lathe the column y.
    """

    def __init__(
        self, cycle: type[Cycle], values: Mapping[str, Any], start: Point, rows: Sequence[StepRow], *,
        lathe: bool = False, per_rev: bool = False, part: Part | None = None,
    ) -> None:  # fmt: skip
        self.cycle, self.values, self.start, self.rows = cycle, values, start, tuple(rows)
        self.lathe, self.per_rev, self.part = lathe, per_rev, part

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, index: Any) -> Any:
        return tuple(row.step for row in self.rows[index]) if isinstance(index, slice) else self.rows[index].step

    @property
    def title(self) -> str:
        """The cycle, its values in the order of a program, and where it is called."""
        given = [f"{p.address}={quoted(self.values[p.name])}" for p in self.cycle.parameters() if p.name in self.values]
        name = f"{self.cycle.code} {self.cycle.title}" + (f": {' '.join(given)}" if given else "")
        x, _, z = self.start
        return f"{name}, called at " + (f"X{figure(x)} Z{figure(z)}, X as radius" if self.lathe else point(self.start))

    @property
    def head(self) -> tuple[str, ...]:
        feed = f"feed, {'mm/rev' if self.per_rev else 'mm/min'}"
        return "step", "label", *(("x (radius)", "z") if self.lathe else "xyz"), feed, "detail"

    def cells(self) -> list[tuple[str, ...]]:
        """The table's rows; where nothing but bookkeeping would stand in them, one that names it."""
        found = list(self._told())
        if found or not self.rows:
            return found
        kept = dict.fromkeys(words(row.step.key) for row in self.rows if isinstance(row.step, Write))
        return [("write", *[""] * (len(self.head) - 2), f"kept for later blocks: {', '.join(kept)}")]

    def _told(self) -> Iterator[tuple[str, ...]]:
        names: set[str] = set()
        for step, end, feed in self.rows:
            detail = DETAILS[type(step)](step) if type(step) in DETAILS else ""
            if isinstance(step, Write):
                name = detail.partition(":")[0]
                if not detail or (step.what in ("memory", "history") and name in names):
                    continue  # bookkeeping, or what another row has told
                names.add(name)
            places = [""] * 3 if end is None else [figure(value, DECIMALS) for value in end]
            yield type(step).__name__.lower(), step.label, *places[:: 2 if self.lathe else 1], feed, detail

    texts = cells

    def table(self) -> tuple[tuple[str, ...], list[tuple[str, ...]], Collection[int]]:
        """Heads, rows of texts, and which columns are numbers."""
        return self.head, self.cells(), range(2, len(self.head) - 1)

    @property
    def above(self) -> str:
        return self.title


def quoted(value: Any) -> str:
    """A value as the title shows it."""
    if isinstance(value, tuple):
        return ",".join(map(quoted, value))
    return figure(value) if isinstance(value, int | float) else str(value)


def words(name: Any) -> str:
    return str(name).replace("_", " ")


def called(step: Call) -> str:
    """What a call calls, and the values that count in place of the defined ones."""
    instead = ", ".join(f"{words(name)} {figure(value)}" for name, value in step.instead.items())
    return "the cycle defined before" + (f", with {instead}" if instead else "")


def zero_point(datum: Datum, *, whole: bool) -> str:
    """A zero point: all of X, Y and Z if `whole`, else only what is not zero."""
    pairs = zip(AXES, datum, strict=True)
    told = [f"{name}{figure(value)}" for k, (name, value) in enumerate(pairs) if value or (whole and k < 3)]
    return " ".join(told) or "all zero"


def written(step: Write) -> str:
    """What stays, in words; nothing for what the control keeps for itself."""
    value, key = step.value, step.key
    match step.what:
        case "kept" | "reckoned":
            return ""
        case "kinematics":
            return f"kinematics: {value}"
        case "memory" | "history":
            return f"{words(key)}: {quoted(value)}" if isinstance(value, int | float | str) and value != "" else ""
        case "modal":
            return f"{key} {value}"
        case "frame":
            told = "" if value is None else described(value).removeprefix(f"{key} ")
            return f"frame {key}: {told or 'none'}"
        case "renamed":
            return f"frame {key}: now called {value}"
        case "datum":
            return f"datum: {zero_point(value, whole=True)}"
        case "tool" | "tools":
            return f"{step.what}{'' if key is None else f' row {key}'}: {tool_line(value)}"
        case "file":
            return f"file {key}"
        case "presets" | "datums":
            row = zero_point(value, whole=False) if isinstance(value, Datum) else str(value)
            return f"{step.what} row {key}: {row}"
        case "variable" | "measured":
            return f"{step.what} {key} = {quoted(value)}"
        case "file" | "appended":
            return f"file {key}"
        case "tolerance":
            return f"tolerance: {'as the limits have it' if math.isnan(value) else figure(value)}"
        case "side":
            return f"radius compensation: {SIDES[value]}"
        case _:
            return f"{step.what}: {said(step.what, value)}"


#: What a step does beside going to its end.
DETAILS: dict[type[Step], Callable[[Any], str]] = {
    Turn: lambda step: f"{figure(math.degrees(step.angle))}°",
    Wait: lambda step: f"{figure(step.seconds)} s",
    Pause: lambda s: "program stop",
    Spin: lambda s: SPINDLE[s.turning] + (f", {figure(s.speed)} rev/min" if s.turning and s.speed else ""),
    Orient: lambda step: f"at {figure(step.angle)}°",
    Coolant: lambda step: "on" if step.on else "off",
    Swivel: lambda step: " ".join(f"{axis}{figure(angle)}°" for axis, angle in zip("ABC", step.angles, strict=True)),
    Call: called,
    Say: lambda step: step.text,
    Write: written,
}


# The cycle is bound as a program would bind it, and its steps are carried out on a machine that nobody else has; so the
# table shows where each of them ends. What the cycle asks of the machine (a tool, a spindle that turns or stands) is looked
# for among the tools of the setup; a touch finds the part of the setup, or one where it is aimed at; what needs a program is
# an Alarm.

MOST = 5_000  # steps of a table
FEWER = "take values that make fewer infeeds, passes or repeats; a program runs them all: mnclab.run(…)"
NOWHERE = place_of(1, 1, 1)  # of a word that stands in no program


@fitting
def steps(code: str, control: str, /, setup: Setup | None = None, **values: Any) -> CycleSteps:
    """The steps of a cycle as a table, without a program: `mnclab.steps("CYCL DEF 200", "tnc-620", Q201=-20)`.

    `values` go by address or by name, in the units of programs; those that are not given are the examples of the
    declaration. `setup` is the machine, of whose tools the first that fits is taken.

    >>> [step.label for step in mnc.steps("G83", "mnc", Z=-10, R=2, K=6)][2:4]
    ['peck 1 of 2', 'clear the chips']
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
    machine_of_trial = on_its_machine(cycle, setup or found.control.trial_setup or Setup())
    for machine in situations(found.control, cycle, machine_of_trial):
        rows: list[StepRow] = []
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


def noting(m: Machine, cycle: type[Cycle], rows: list[StepRow]) -> Callable[[Iterable[Step], Place], Iterable[Step]]:
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
        rows.append(StepRow(step, m.programmed, words) if moved else StepRow(step))
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
