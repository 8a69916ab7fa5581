"""How a cycle declares itself, once: from its class come binding, checks, help, the form and tests.

A defined cycle is a `Definition` (values and the words they came from); it is *bound* to a frozen instance of
its class when it is called, and checked there. `runs` says when: "definition" (as soon as it is read), "call" (by M99,
CYCL CALL, …) or "position" (at each following position while it is active).

One line a parameter, and one address a parameter: a coordinate that may be written as X or as an increment U was meant to
be one declaration with two addresses, but then neither help nor the comparison with the manual's table showed U. Such a
pair is two parameters, `instead` ties them, and `Cycle.prepare` makes one level of both where they are written.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import MISSING, Field, dataclass, field, fields, replace
from functools import cache
from html import escape
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple, TypeVar

from mnclab.machine import coordinates
from mnclab.machine.terms import BETWEEN, beside
from mnclab.machining.depths import TooMany
from mnclab.machining.steps import Step
from mnclab.text.program import Word
from mnclab.text.tables import html_table, text_table, written

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine
    from mnclab.workpiece.part import Part


Values = dict[str, Any]  # by the name of a parameter; or what a cycle keeps while it is active
Given = Mapping[str, Word]  # the words of a block by the name of a parameter


@dataclass(frozen=True)
class Parameter:
    """One address of a cycle: what it means and what is allowed. `meaning` is a short noun phrase; alarms quote it.

    A parameter with a `mark` (a bit of `Word.flag`) has no word of its own: it is 1 when the word that calls the
    cycle carries the mark, and its default when not; its address is the mark's sign.
    """

    address: str
    meaning: str
    unit: str
    name: str = ""
    aliases: tuple[str, ...] = ()
    required: bool = False
    default: Any = None
    default_means: str = ""
    choices: Mapping[float, str] | None = None
    above: float | None = None
    at_least: float | None = None
    below: float | None = None
    at_most: float | None = None
    incremental: bool = False
    modal: bool = False
    instead: str = ""
    also: tuple[str, ...] = ()
    type: str = "number"
    predef: bool = False
    note: str = ""
    mark: int = 0
    several: bool = False
    example: float | str | tuple[float | str, ...] | None = None
    is_variable: bool = field(init=False)
    """Whether it is a variable of the program (Q200), not an address (X)."""
    in_units: bool = field(init=False)
    """Whether it is a length or a feed, in the unit of the program."""

    def __repr__(self) -> str:
        return written(self)

    def __post_init__(self) -> None:
        variable = self.address[0] == "Q" and self.address[1:].isdigit() and self.type != "text"
        object.__setattr__(self, "is_variable", variable)
        object.__setattr__(self, "in_units", self.unit in ("mm", "mm/min", "mm/rev"))

    @property
    def allowed(self) -> str:
        """The limits in words, empty when any number is allowed."""
        if self.choices:
            return "one of " + ", ".join(f"{choice:g}" for choice in self.choices)
        limits = {
            "greater than": self.above, "at least": self.at_least, "less than": self.below, "at most": self.at_most,
        }  # fmt: skip
        parts = ["a whole number"] if self.type == "integer" else []
        parts += [f"{words} {limit:.10g}" for words, limit in limits.items() if limit is not None]
        return " and ".join(parts)

    def refuses(self, value: float) -> bool:
        """Whether a number is outside what is allowed."""
        return (
            (self.choices is not None and value not in self.choices)
            or (self.above is not None and not value > self.above)
            or (self.at_least is not None and not value >= self.at_least)
            or (self.below is not None and not value < self.below)
            or (self.at_most is not None and not value <= self.at_most)
            or (self.type == "integer" and value != int(value))
        )


def param(
    address: str | tuple[str, ...], meaning: str, unit: str = "mm", *, default: Any = MISSING, default_means: str = "",
    choices: Mapping[float, str] | None = None, above: float | None = None, at_least: float | None = None,
    below: float | None = None, at_most: float | None = None, incremental: bool = False, modal: bool = False,
    instead: str = "", also: tuple[str, ...] = (), type: str = "number", predef: bool = False, note: str = "",
    mark: int = 0, several: bool = False, example: float | str | tuple[float | str, ...] | None = None,
) -> Any:  # fmt: skip
    """Declare one parameter of a cycle in one line of its class.

    No `default` means required, unless `instead` of it another is given (a parameter by its name);
    `default_means` says in words what a default of None stands for. `several`: the address may be repeated, and the
    value is a tuple. `also` lists words allowed in place of a number (FAUTO, FMAX, …). `example` is a value to begin
    with where the cycle is tried out; it must obey the limits, or the declaration is a ValueError.
    """
    first, *others = (address,) if isinstance(address, str) else address
    required = default is MISSING
    declared = Parameter(
        first, meaning, unit, "", tuple(others), required, None if required else default, default_means, choices, above,
        at_least, below, at_most, incremental, modal, instead, also, "choice" if choices else type, predef, note, mark, several,
        example,
    )  # fmt: skip
    for one in example if isinstance(example, tuple) else (example,):
        if isinstance(one, int | float) and declared.refuses(one):
            raise ValueError(f"the example of {first} must be {declared.allowed}, got {one:g}")
    return field(default=declared.default, kw_only=True, metadata={"parameter": declared})


@dataclass(frozen=True)
class Cycle:
    """A cycle bound to its values. Subclasses declare parameters, `contradictions`, `check` and `moves`."""

    code: ClassVar[str] = ""
    title: ClassVar[str] = ""
    runs: ClassVar[str] = "call"
    source: ClassVar[str] = ""
    triggers: ClassVar[tuple[str, ...]] = ()
    """Addresses that run a "position" cycle in a later block."""
    in_variables: ClassVar[bool] = True
    """Whether its Q parameters are variables of the program, on a control that has them."""
    shares: ClassVar[bool] = False
    """Whether what is modal holds from one cycle to the next, until they are switched off, and not only for itself."""
    own_spindle: ClassVar[bool] = False
    """Whether it turns the spindle itself, so that none need turn before it."""
    does: ClassVar[str] = coordinates.VISITS
    """What decides whether it can run under a scale; see `machine.coordinates`."""
    tried_on: ClassVar[str] = ""
    """The machine that has the rotary axes which it needs (`mnclab.machines`), where it is tried out."""

    @classmethod
    @cache
    def parameters(cls) -> tuple[Parameter, ...]:
        """The declared parameters, in order."""
        declared = ((item.name, item.metadata.get("parameter")) for item in fields(cls))
        return tuple(replace(parameter, name=name) for name, parameter in declared if parameter)

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        """Turn what a block wrote into what stays; for cycles that resolve levels when they are programmed.

        `kept` lives as long as the cycle is active.
        """
        return values

    def contradictions(self) -> Iterator[tuple[str, str]]:
        """Faults among the values alone, as (name of the parameter to mark, sentence); found where it is defined."""
        yield from ()

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Faults of the values on this machine now: its tool, its spindle, its state; found where the cycle runs.

        Without a name they are faults of the machine alone, which point at the call.
        """
        yield from ()

    def moves(self, m: Machine) -> Iterable[Step]:
        """The steps of the cycle; it reads the machine and changes nothing.

        Steps are made while they are carried out: what is asked of the machine after the first `yield` is asked later.
        """
        return ()

    def about(self, m: Machine) -> tuple[float, float]:
        """Where x and y of the steps count from: where the tool stands at the call."""
        return m.programmed[0], m.programmed[1]

    def figure(self, m: Machine) -> Part | None:
        """What a cycle that calibrates touches, in machine coordinates, so that it can be tried out where nobody gave a part."""
        return None

    def modal_feed(self, m: Machine) -> float | None:
        """The feed of moves that say none, in the units of the modal feed; None: the modal feed itself."""
        return None


MOST_PASSES = 5_000  # of one cycle, all its levels together
AnyCycle = TypeVar("AnyCycle", bound=type[Cycle])


class CycleTable(dict[str, type[Cycle]]):
    """Cycles by code; calling it decorates the class of one.

    `addresses` has the parameters that its cycles share, by name; `runs` is when they run that do not say it.
    """

    def __init__(
        self, cycles: Mapping[str, type[Cycle]] = MappingProxyType({}), addresses: Any = None, runs: str = "call"
    ) -> None:
        super().__init__(cycles)
        self._addresses, self._runs = addresses, runs

    def __call__(
        self, codes: str, title: str, *, runs: str = "", source: str = "", triggers: str = "", takes: str = ""
    ) -> Callable[[AnyCycle], AnyCycle]:
        """Register a cycle under its code; further codes, after commas, are aliases.

        `takes` names all its parameters in their order: those that its class and its bases do not declare are shared.
        """
        first, *aliases = (code.strip() for code in codes.split(","))

        def register(cls: AnyCycle) -> AnyCycle:
            if takes:
                self._share(cls, takes.split())
            frozen: Any = dataclass(frozen=True)(cls)
            frozen.code, frozen.title, frozen.runs, frozen.source = first, title, runs or self._runs, source
            frozen.triggers = tuple(triggers.split())
            for code in (first, *aliases):
                self[code] = frozen
            return frozen

        return register

    def _share(self, cls: type[Cycle], names: list[str]) -> None:
        """Give a class the shared parameters among these names, and its parameters this order."""
        own = cls.__dict__.get("__annotations__", {})
        for name in names:
            declared = getattr(cls, name, None)  # by itself, or by a class that is no cycle yet
            setattr(cls, name, declared if isinstance(declared, Field) else getattr(self._addresses, name)())
        cls.__annotations__ = {name: own.get(name, "float") for name in names} | own

    def __repr__(self) -> str:
        return "\n".join(f"{code:15s} {cycle.title}" for code, cycle in self.items())

    def __or__(self, other: Mapping[str, type[Cycle]]) -> CycleTable:  # type: ignore[override]
        return CycleTable({**self, **other})


@dataclass
class Definition:
    """A cycle as a program defined it: values by parameter name, and the words they came from."""

    cycle: type[Cycle]
    code: str
    values: dict[str, Any]
    words: dict[str, Word]
    head: Word | None
    extra: dict[str, Any] = field(default_factory=dict)
    program: int = 0  # which of Run.programs the words stand in
    units: tuple[float, float] = (1.0, 1.0)  # mm of a length and mm/min of a feed that the program writes as 1

    def typed(self, parameter: Parameter, value: float) -> float:
        """A value as the program writes it: what is allowed is said in that unit, as the manual prints it."""
        unit = self.units[parameter.unit == "mm/min"] if parameter.in_units else 1.0
        return value if unit == 1 else float(f"{value / unit:.12g}")

    def __repr__(self) -> str:
        return f"<Definition {' '.join([self.code, *map(str, self.words.values())])}>"


def too_many(name: str, levels: Callable[[], object]) -> Iterator[tuple[str, str]]:
    """A fault of the parameter that makes more levels or turns than any hole has."""
    try:
        levels()
    except TooMany as error:
        yield name, str(error)


def too_many_passes(name: str, levels: int, passes: int) -> Iterator[tuple[str, str]]:
    """A fault where nobody would wait for so many passes."""
    if levels * passes > MOST_PASSES:
        yield name, f"makes {levels} levels of {passes} passes, more than {MOST_PASSES} together"


# The parameters of a cycle as people read them: one row each, for help as text, help as HTML and the boxes of a form.

class ParameterRow(NamedTuple):
    """What is said of one parameter; `default` is what holds where its word is left out."""

    address: str
    meaning: str
    unit: str
    allowed: str
    default: str
    note: str


def row(p: Parameter) -> ParameterRow:
    """The row of a parameter; its choices stand one in a line, each with its meaning."""
    allowed = "\n".join(f"{choice:g} {meaning}" for choice, meaning in p.choices.items()) if p.choices else limits(p)
    return ParameterRow(p.address, p.meaning, p.unit, allowed, "required" if p.required else left_out(p), p.note)


def limits(p: Parameter) -> str:
    """What is allowed, in words; a note that says "greater than 0" stands in place of the 0 that a range begins with."""
    return p.allowed.removeprefix("at least 0 and ") if p.note.startswith("greater than 0") else p.allowed


def left_out(p: Parameter) -> str:
    """What holds where the word is left out, empty where nothing does."""
    default = f"{p.default:g}" if isinstance(p.default, int | float) else p.default or ""
    return p.default_means or default


def _filled(cycle: type[Cycle]) -> tuple[tuple[str, ...], list[tuple[str, ...]]]:
    """The heads and rows of the parameters of a cycle, without notes where there is none."""
    rows = [row(p) for p in cycle.parameters()]
    width = len(ParameterRow._fields) - (not any(each.note for each in rows))
    return ParameterRow._fields[:width], [each[:width] for each in rows]


def help_text(cycle: type[Cycle], term: str = "") -> str:
    """The title of a cycle, what the manual calls it, what it does, and its parameters."""
    table = text_table(*_filled(cycle))
    title = BETWEEN.join(filter(None, (cycle.title, term)))
    return f"{cycle.code}  {title}  ({cycle.source})\n{(cycle.__doc__ or '').strip()}\n\n{table}"


def help_html(cycle: type[Cycle], term: str = "") -> str:
    """The same as HTML."""
    table = html_table(*_filled(cycle), code=(0,))
    about = f"<p>{escape(cycle.__doc__ or '')} ({escape(cycle.source)})</p>"
    return f"<h4><code>{cycle.code}</code> {escape(cycle.title)}{beside(term)}</h4>{about}{table}"
