"""From the words of a block to a cycle that can run: values by name, defaults, limits, contradictions, faults.

A word goes to the parameter of its address; the values make a `Definition`, which is bound to
a frozen cycle when it runs.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from mnclab.machine import coordinates
from mnclab.machine.coordinates import in_mm
from mnclab.machine.cycle import Cycle, Definition, Parameter
from mnclab.machine.machine import Machine
from mnclab.text.alarm import Alarm
from mnclab.text.expression import Expression
from mnclab.text.program import GROUP_MARK, INCREMENTAL, RAPID_MARK, Word
from mnclab.text.strings import TextFormula


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
    for sentence in coordinates.faults(definition.cycle.does, m):
        if definition.cycle.runs == "call":
            m.alarm(f"{definition.code} {sentence}")
        raise fault(definition, None, sentence)


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
