"""Cycles bound and carried out: from the words of a block to an instance, from its steps to the verbs of the machine."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import replace
from types import GeneratorType
from typing import Any

import numpy as np

from mnclab.geometry.arcs import FULL
from mnclab.geometry.contours import Contour
from mnclab.machine import coordinates
from mnclab.machine.axes import correct, leaning, reckon, roll_over, turn_axes
from mnclab.machine.coordinates import CALLS, FRAME, MILLS, NOTHING, in_mm, roll, tool_axis
from mnclab.machine.cycle import Cycle, Definition, Parameter
from mnclab.machine.flow import put_out
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import Measurement, TouchedFigure, judged
from mnclab.machine.tool_setting import SETS, at_setter
from mnclab.machine.touching import FEELS, PROBES, Contact, Felt, ball_from_axis, guarded, guarded_turn, part_to_touch
from mnclab.machining.depths import TooMany
from mnclab.machining.steps import (
    Along,
    Blocks,
    Call,
    Coolant,
    Dip,
    Each,
    Go,
    Measure,
    Orient,
    Pause,
    Record,
    Rolled,
    Say,
    Sketch,
    Spin,
    Step,
    Swivel,
    Thread,
    Touch,
    Turn,
    Wait,
    Write,
)
from mnclab.running.flow import course
from mnclab.running.repeating import at_each
from mnclab.text.alarm import Alarm
from mnclab.text.expression import Expression
from mnclab.text.program import GROUP_MARK, INCREMENTAL, RAPID_MARK, Word
from mnclab.text.strings import TextFormula

# From the words of a block to a cycle that can run: values by name, defaults, limits, contradictions, faults.
# A word goes to the parameter of its address; the values make a `Definition`, which is bound to
# a frozen cycle when it runs.

def assign(
    m: Machine, cycle: type[Cycle], code: str, given: tuple[Word, ...]
) -> tuple[dict[str, Any], dict[str, Word]]:
    """Values and words by parameter name; repeated addresses go to parameters in their order."""
    values: dict[str, Any] = {}
    words: dict[str, Word] = {}
    for word in given:
        fitting = (p for p in cycle.parameters() if word.address in (p.address, *p.aliases))
        parameter = next((p for p in fitting if p.several or p.name not in words), None)
        if parameter is None:
            m.alarm(f"{word} says again what another word of {code} says", word, hint="keep one of them")
        value = value_of(m, parameter, code, word, cycle.in_variables)
        words.setdefault(parameter.name, word)
        values[parameter.name] = (*values.get(parameter.name, ()), value) if parameter.several else value
    return values, words


def value_of(m: Machine, parameter: Parameter, code: str, word: Word, in_variables: bool = True) -> Any:
    """The number of a parameter; a word in place of a number only where it is allowed."""
    if word.value == "PREDEF" and m.control.predefined:
        return m.control.predefined(m, code, parameter, word)
    if isinstance(word.value, str | TextFormula) and word.address in parameter.aliases:  # a text that holds a number
        return word.value
    if isinstance(word.value, str) and parameter.type != "text":
        if word.value.rstrip("0123456789.") not in parameter.also:
            allowed = f"a number{', ' + ', '.join(parameter.also) if parameter.also else ''}"
            valued = next((also for also in parameter.also if len(also) == 2), "")  # FU, FZ
            hint = f"{valued} has its value behind it, for example {word.address}={valued}0.1" if valued else ""
            m.alarm(f"{code} {parameter.address} ({parameter.meaning}) must be {allowed}, got {word.value}", word, hint)
        return m.control.named(m, word) if m.control.named else word.value
    if parameter.type == "text":  # a number in the place of a text may be computed
        return m.value(word) if isinstance(word.value, Expression) else word.value
    if word.value is None or isinstance(word.value, str):
        return word.value
    value = m.value(word)
    if in_variables and m.control.storage == "variables" and parameter.is_variable:
        m.variables[parameter.address] = value  # exactly as written
    return value * unit_of(m, parameter)


def unit_of(m: Machine, parameter: Parameter) -> float:
    """What a number of a parameter is multiplied with: 25.4 for lengths in inches, the unit of F for feeds.

    Where cycles live in variables, the reader has done so with lengths that are none.
    """
    if parameter.unit == "mm/min":
        return m.feed_unit
    written = parameter.is_variable or m.control.storage != "variables"
    return m.variable_unit if parameter.in_units and written else 1.0


def units_of(m: Machine) -> tuple[float, float]:
    """What a length and a feed of 1 are now, mm and mm/min; per revolution a feed is a length."""
    return m.variable_unit, m.feed_unit


def store(m: Machine, definition: Definition) -> None:
    """Write what was not given as a number (defaults, FAUTO) into its variable; FMAX and texts have none."""
    for parameter in definition.cycle.parameters():
        if not parameter.is_variable:
            continue
        word, value = definition.words.get(parameter.name), definition.values.get(parameter.name, parameter.default)
        if word is not None and isinstance(word.value, float | Expression):
            continue
        if isinstance(value, int | float):
            m.variables[parameter.address] = float(value) / unit_of(m, parameter)
        else:
            m.variables.pop(parameter.address, None)


def verify(definition: Definition) -> None:
    """Range and presence of the parameters, where a cycle is defined."""
    for parameter in definition.cycle.parameters():
        value = definition.values.get(parameter.name)
        check_value(definition, parameter, value)
        if value is None and parameter.required and definition.values.get(parameter.instead) is None:
            raise fault(definition, parameter, "is missing")


def as_it_stands(m: Machine, definition: Definition) -> Definition:
    """A definition with the numbers that its variables have now."""
    if m.control.storage == "variables" and definition.cycle.in_variables:
        numbers = {
            p.name: m.variables[p.address] * unit_of(m, p)
            for p in definition.cycle.parameters()
            if p.is_variable and p.address in m.variables
        }
        return replace(definition, values=definition.values | numbers, units=units_of(m))
    return definition


def bind(definition: Definition, m: Machine) -> Cycle:
    """The frozen cycle with its values, or an Alarm at the word that is wrong.

    What is wrong with the machine and no word of the definition stands where the cycle is called.
    """
    bound = instance(definition)
    refuse_frame(definition, m)
    for name, sentence in bound.check(m):
        sentence += coordinates.remark(m) if "the tool" in sentence else ""
        sentence = with_unit(definition, named(definition, name), sentence)
        if not name and definition.cycle.runs == "call":
            m.alarm(f"{definition.code} {sentence}")
        raise fault(definition, named(definition, name), sentence)
    return bound


def refuse_frame(definition: Definition, m: Machine) -> None:
    """An Alarm at a cycle that cannot run under the frame of the machine."""
    for sentence in (*coordinates.faults(definition.cycle.does, m), *leaning_tool(definition.cycle, m)):
        if definition.cycle.runs == "call":
            m.alarm(f"{definition.code} {sentence}")
        raise fault(definition, None, sentence)


def leaning_tool(cycle: type[Cycle], m: Machine) -> Iterator[str]:
    """A cycle that drills, mills or probes needs the tool along Z of the plane."""
    works = cycle.runs != "definition" or cycle.does in (PROBES, FEELS)
    if works and cycle.does not in (NOTHING, CALLS) and (degrees := leaning(m)):
        yield f"needs the tool square to the working plane, and it leans by {degrees:.4g} degrees"


def with_unit(definition: Definition, parameter: Parameter | None, sentence: str) -> str:
    """What a cycle says of its values: it knows them in mm, so in a program in inches it names that, and what was written."""
    length = parameter is not None and parameter.in_units
    value = definition.values.get(parameter.name) if parameter and length else None
    said = f", the program says {definition.typed(parameter, value):.10g}" if parameter and type(value) is float else ""
    return in_mm(sentence, definition.units[0], length, said)


def instance(definition: Definition) -> Cycle:
    """The frozen cycle with its values, which are there, within their limits and without contradiction."""
    cycle, values = definition.cycle, {}
    for parameter in cycle.parameters():
        value = definition.values.get(parameter.name)
        if value is None and parameter.required and definition.values.get(parameter.instead) is None:
            other = named(definition, parameter.instead)
            raise fault(definition, parameter, "is missing" + (f", and so is {other.address}" if other else ""))
        check_value(definition, parameter, value)
        if value is None:
            value = parameter.default
        values[parameter.name] = value
    made = cycle(**values)
    for name, sentence in made.contradictions():
        of = named(definition, name)
        raise fault(definition, of, with_unit(definition, of, sentence))
    return made


def named(definition: Definition, name: str) -> Parameter | None:
    """The parameter of a name; None for the cycle as a whole."""
    return next((p for p in definition.cycle.parameters() if p.name == name), None)


def check_value(definition: Definition, parameter: Parameter, value: Any) -> None:
    """An Alarm when a number, or one of several, is outside what its parameter allows, in the unit of the program."""
    for number in value if isinstance(value, tuple) else (value,):
        if isinstance(number, int | float) and parameter.refuses(typed := definition.typed(parameter, number)):
            raise fault(definition, parameter, f"must be {parameter.allowed}, got {typed:.10g}")


def refuse_marks(cycle: type[Cycle], code: str, head: Word) -> None:
    """An Alarm at a mark of the calling word that the cycle has no use for; the mark of a group is the reader's."""
    known = GROUP_MARK | sum(p.mark for p in cycle.parameters())
    for mark, sign in ((RAPID_MARK, "~"), (INCREMENTAL, "@")):
        if head.flag & mark & ~known:
            raise Alarm(f"the mark {sign} has no meaning on {code}", head.span)


def fault(definition: Definition, parameter: Parameter | None, sentence: str) -> Alarm:
    """An alarm that names code, address and meaning, at the word or, when it is missing, at the cycle's own word."""
    word = definition.words.get(parameter.name) if parameter else None
    word = word or definition.head
    name = f" {parameter.address} ({parameter.meaning})" if parameter else ""
    return Alarm(
        f"{definition.code}{name} {sentence}", word.span._replace(program=definition.program) if word else None
    )


# Cycles carried out: a cycle is bound, and each of its steps becomes a verb of the machine.
# Rows are labelled with the code of the cycle and the label of the step. The holes of every control lie along Z of its frame.

AXES = ("X", "Y", "Z")
AGAIN = 8  # blocks of the limit that a cycle counts as in a loop
Place = tuple[float, float]
Through = Callable[[Iterable[Step], Place], Iterable[Step]]


def run_cycle(m: Machine, definition: Definition, through: Through | None = None, /, **instead: float) -> None:
    """Bind a definition with the values as they stand now, check it, and carry its steps out.

    `instead` are values by name that count for this call in place of its own, where the cycle has such parameters.
    `through` is what the steps go through on their way, with the place that they count from.
    """
    with m.control.turned(m, definition) if m.control.turned else nullcontext():
        _run(m, definition, through, instead)


def _run(m: Machine, definition: Definition, through: Through | None, instead: Mapping[str, float]) -> None:
    flow = course(m)
    flow.spend_again(AGAIN)
    definition = as_it_stands(m, definition)
    elsewhere = definition.cycle.does == MILLS and m.plane != "XY"  # than where m.radius and m.scale count
    try:
        with m.within(**({"plane": "XY"} if elsewhere else {})):
            bound = bind(definition, m)
            if instead:
                names = {p.name for p in definition.cycle.parameters()} & instead.keys()
                bound = replace(bound, **{name: instead[name] for name in names})
            feed, steps, about = bound.modal_feed(m), bound.moves(m), bound.about(m)
            with m.within(**({} if feed is None else {"feed": feed}), **feels(m, definition.cycle.does)):
                perform(m, bound.code, through(steps, about) if through else steps, about)
    except TooMany as error:
        raise fault(definition, None, with_unit(definition, None, str(error))) from None


def feels(m: Machine, does: str) -> dict[str, Felt]:
    """What a cycle feels while it runs, if it probes or sets tools."""
    if does == SETS:
        return {"felt": Felt(None, by_ball=False, setter=True)}
    if does not in (PROBES, FEELS):
        return {}
    return {"felt": Felt(part_to_touch(m), does == PROBES)}


def perform(m: Machine, name: str, steps: Iterable[Step], about: Place | None = None) -> Any:
    """Carry the steps out; rows are labelled `name` and the label of the step.

    x and y count from `about`, which is where the tool stands if nothing else is said. A generator is sent the answer of
    a step that has one: the contact of a Touch, the contour of a Record. What it returns is returned.
    """
    x, y = m.programmed[:2] if about is None else about
    label = m.label
    answer: Any = None
    asking = steps if isinstance(steps, GeneratorType) else (step for step in steps)
    while True:
        try:
            step = asking.send(answer)
        except StopIteration as end:
            m.label = label
            return end.value
        m.label, answer = f"{name} {step.label}", None
        match step:
            case Go() | Turn() | Touch() if m.felt:
                answer = probing(m, m.felt, step, (x, y))
            case Go():
                to = None if step.x is None else x + step.x, None if step.y is None else y + step.y, step.z
                m.line(*to, f=step.feed)
            case Along():
                with m.within(plane="XY"):
                    follow(m, step.contour, step.feed, step.heights, about=(x + step.at[0], y + step.at[1]))
            case Wait():
                m.dwell(step.seconds)
            case Thread():
                with m.within(feed=step.pitch, per_rev=True, synchronous=True):
                    m.line(x=None if step.x is None else x + step.x, z=step.z)
            case Turn():
                with m.within(plane="XY"):
                    m.turn((x + step.centre[0], y + step.centre[1]), step.angle, step.z, step.feed)
            case Dip():
                with m.within(plane="ZX"):
                    dip(m, x + step.x, step.z, step.feed)
            case Spin():
                m.spindle(step.speed, step.turning)
            case Orient():
                m.orient(step.angle)
            case Pause():
                m.stop()
            case Coolant():
                m.coolant()
            case Touch():
                answer = m.touch(x + step.x, y + step.y, step.z, f=step.feed, ball=step.ball, miss=step.miss)
            case Swivel():
                turn_axes(m, step.angles, step.feed, below=step.below)
            case Rolled():
                follow_axis = roll if m.tables.kinematics is None else roll_over
                follow_axis(m, step.cylinder, step.points, step.angles, step.ways, step.feed)
            case Each():
                at_each(m, step.points, lambda *point, visit=step.visit: perform(m, name, visit(*point), (x, y)))
            case Call():
                assert m.cycle is not None
                run_cycle(m, m.cycle, **step.instead)
            case Blocks():
                step.run()
            case Record():
                with m.flow.inside(m, step.program), m.within(variable_unit=step.unit):
                    answer = m.record(step.name, after=step.after, in_space=step.in_space)
            case Measure() | Sketch():
                measured(m, name, step)
            case Say():
                m.warn(in_mm(f"{name} {step.text}", m.variable_unit), step.word, step.hint)
            case Write():
                write(m, step)


def probing(m: Machine, felt: Felt, step: Go | Turn | Touch, about: Place) -> Contact | None:
    """A step of a cycle that probes: positioning stops at what is in the way; places may be those of the ball."""
    if felt.setter and not isinstance(step, Turn):
        return at_setter(m, step)
    beside = ball_from_axis(m) if felt.by_ball else (0.0, 0.0)
    x, y = about[0] - beside[0], about[1] - beside[1]
    match step:
        case Turn():
            centre = x + step.centre[0], y + step.centre[1]
            if felt.part is None:
                m.turn(centre, step.angle, step.z, step.feed)
            else:
                guarded_turn(m, felt.part, centre, step.angle, step.feed)
        case Touch():
            return m.touch(x + step.x, y + step.y, step.z, f=step.feed, ball=step.ball, miss=step.miss)
        case Go():
            target = m.target(None if step.x is None else x + step.x, None if step.y is None else y + step.y, step.z)
            if felt.part is None:
                m.line(*target, f=step.feed)
            else:
                guarded(m, felt.part, target, step.feed)
    return None


def measured(m: Machine, cycle: str, step: Measure | Sketch) -> None:
    """Write what was measured into the record, or a figure for its picture."""
    line, program, touches = m.source_line, m.program, tuple(step.touches)
    if isinstance(step, Sketch):
        figure = TouchedFigure(m.step, line, program, cycle, step.nominal, step.actual, step.height, m.matrix, touches)
        m.figures.append(figure)
        return
    what, actual, nominal, lower, upper, unit, verdict, *_ = step
    if what in AXES and FRAME in m.frames:  # an axis of the turned cycle
        what = AXES[int(np.argmax(m.frames[FRAME][:3, AXES.index(what)]))]
    verdict = verdict or judged(actual, lower, upper)
    row = Measurement(line, cycle, what, nominal, actual, lower, upper, unit, verdict, touches, m.step, program)
    m.measurements.append(row)
    m.measured[what] = actual


def write(m: Machine, step: Write) -> None:
    """Change what a cycle says that it changes."""
    match step.what:
        case "variable" | "measured":
            (m.variables if step.what == "variable" else m.measured)[step.key] = step.value
        case "tools" | "datums" | "presets":
            m.write_table(step.what, step.key, step.value)
        case "tool":
            m.change_tool(step.value, tool_axis(m), tool_axis(m))
        case "probe":
            m.tables.probe = step.value
            m.log("probe", step.value)
        case "kinematics":
            correct(m, step.value)
        case "reckoned":
            reckon(m, step.value)
        case "file" | "appended":
            put_out(m, step.key, step.value, anew=step.what == "file")
        case "frame":
            m.set_frame(step.key, step.value)
        case "renamed":
            m.frames.rename(step.key, step.value)
        case "datum" | "chosen datum":
            m.select_datum(step.value, step.key, chosen=step.what == "chosen datum")
        case "modal":
            m.set_modal(step.key, step.value)
        case "memory":
            if not hasattr(m.memory, step.key):
                raise AttributeError(f"{m.control.name} keeps no {step.key}")
            setattr(m.memory, step.key, step.value)
        case "kept":
            assert m.cycle is not None
            m.cycle.extra[step.key] = step.value
        case "history":
            m.log(step.key, step.value)
        case _:
            m.change(step.what, step.value)


def dip(m: Machine, x: float, z: float, feed: float | None) -> None:
    """A quarter circle of the plane ZX, off along Z and to a place along X."""
    before, _, height = m.programmed
    sense = 1 if (before - x) * (height - z) > 0 else -1
    m.arc(x, None, z, sense=sense, centre={0: x, 2: height}, f=feed)


def follow(
    m: Machine, contour: Contour, feed: float | None, heights: Sequence[float] | np.ndarray | None = None,
    about: Place = (0.0, 0.0),
) -> None:  # fmt: skip
    """Run along a contour at a feed (None: the modal one) from where it begins: the tool must be there.

    `heights` are the tool-axis coordinates of its n points, or none for a level contour; its own coordinates count from
    `about`. A circle of two halves is one full circle; an arc so short that its ends would count as one place is a line.
    """
    elements, (x0, y0) = contour.walk, about
    whole = contour.closed and len(elements) == 2 and np.array_equal(np.abs(contour.bulge), [1.0, 1.0])
    if whole:
        elements = elements[1:]
    for k, ((x, y), sweep, (cx, cy)) in enumerate(elements):
        z = None if heights is None else float(heights[(k + 1) % len(heights)])
        here = m.programmed
        if sweep and (whole or abs(sweep) > math.pi or math.dist(here[:2], (x0 + x, y0 + y)) >= FULL):
            m.arc(x0 + x, y0 + y, z, sense=1 if sweep > 0 else -1, centre={0: x0 + cx, 1: y0 + cy}, f=feed)
        else:
            m.line(x0 + x, y0 + y, z, f=feed)
