"""A control: a reader, its functions, its cycles, the order inside a block, its settings.

Functions register themselves in a `FunctionTable`; the table *is* the help. `group` gives modality: functions
of one group replace each other and only one may stand in a block. `takes` names the addresses that a function uses
in its block; the interpreter hands out the words and refuses those that nobody takes.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from html import escape
from numbers import Real
from pathlib import Path
from textwrap import wrap
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from mnclab.machine.setup import MILLS, Magazine
from mnclab.machine.terms import plain, terms
from mnclab.text.alarm import Alarm, hint
from mnclab.text.dialect import Notation, Numbers, Sign
from mnclab.text.file import MOST_MEGABYTES
from mnclab.text.given import shown
from mnclab.text.opening import opened
from mnclab.text.program import Program, Word
from mnclab.text.tables import html_table, text_table, written

if TYPE_CHECKING:
    from contextlib import AbstractContextManager

    from mnclab.machine.cycle import Cycle, CycleTable, Definition, Parameter
    from mnclab.machine.machine import Machine
    from mnclab.machine.setup import Setup
    from mnclab.path.compensation import Compensation


Obey = Callable[["Machine", "Words"], None]
AnyObey = TypeVar("AnyObey", bound=Callable[..., None])
Reader = Callable[[str, str], Program]
Remark = tuple[int, str, str]  # the word that it is about, a sentence, a hint


class Modal(NamedTuple):
    """What the handing out of the words of a block depends on besides the block: the modal motion and the modal call of
    a cycle, whether there is a pole, the cycle that runs at every position, whether a function of motion ends it, and whose
    dialect a program is written in, where a control has several."""

    motion: str | None
    call: str | None
    polar: bool
    active: type[Cycle] | None
    ends: bool = False
    dialect: str = ""

    @staticmethod
    def chosen(settings: Mapping[str, Any]) -> tuple[bool, str]:
        """`ends` and `dialect` as the settings of a control have them."""
        return settings.get("motion_in_cycle") == "ends", str(settings.get("dialect", ""))


class Words(dict[str, Word]):
    """The words handed to a function: the word that called it, and those it takes. `words["X"]` is the first X.

    `words.words` has all of them in the order handed out, `code` is the code that was called.
    """

    __slots__ = ("code", "words")

    def __init__(self, words: tuple[Word, ...], code: str = "") -> None:
        for word in reversed(words):
            self[word[0]] = word
        self.words, self.code = words, code

    def all(self, address: str) -> list[Word]:
        return [word for word in self.words if word.address == address]


@dataclass(frozen=True)
class Function:
    """A preparatory, auxiliary or word function of a control.

    `moves`: belongs to the motion of the block, and runs for later blocks while it is modal. `still`: a block with it
    moves nothing. `ends_cycle`: an active cycle is over before the motion of the block. `owns`: the words of the block
    are its own, and a motion function beside it only becomes active. `collects`: motion that waits for later blocks may
    go on waiting; before any other function it is made. `leads_away`: what comes next is not the block below, or not always.
    `listed`: tables of the functions have it; not one that is only known to be refused, or is called of its own accord.
    """

    code: str
    title: str
    obey: Obey
    group: str | None = None
    phase: str = "motion"
    takes: tuple[str, ...] = ()
    power_on: bool = False
    modal: bool = True
    moves: bool = False
    still: bool = False
    ends_cycle: bool = False
    owns: bool = False
    collects: bool = False
    leads_away: bool = False
    listed: bool = True
    source: str = ""
    doc: str = ""

    def __repr__(self) -> str:
        return f"<Function {self.code}: {self.title}>"


class FunctionTable(dict[str, Function]):
    """Functions by code; calling it decorates the function that obeys these codes."""

    def __call__(
        self, codes: str, title: str | Mapping[str, str], *, group: str | None = None, phase: str = "motion",
        takes: str = "", power_on: str = "", source: str = "", **marks: bool,
    ) -> Callable[[AnyObey], AnyObey]:  # fmt: skip
        """Register one function for several codes; `title` may differ by code, `marks` are those of a `Function`.

        Codes are separated by blanks, or by commas where one holds a blank: `"CALL LBL,"` is one code.
        """

        def register(obey: AnyObey) -> AnyObey:
            split = codes.split(",") if "," in codes else codes.split()
            for code in filter(None, (part.strip() for part in split)):
                named, active = title if isinstance(title, str) else title[code], code in power_on.split()
                self[code] = Function(
                    code, named, obey, group, phase, tuple(takes.split()), active,
                    source=source, doc=(obey.__doc__ or "").strip(), **marks,
                )  # fmt: skip
            return obey

        return register

    def __repr__(self) -> str:
        return "\n".join(f"{code:8s} {function.title}" for code, function in self.items())

    def __or__(self, other: Mapping[str, Function]) -> FunctionTable:  # type: ignore[override]
        return FunctionTable({**self, **other})


def _known(name: str) -> Control:
    """The control of a name, in whatever process it is wanted."""
    control: Control = opened("mnclab.controls", "CONTROLS")[name]
    return control


@dataclass(frozen=True)
class Control:
    """A control as one value; nothing is inherited, two controls that agree share a function.

    `codes` are the addresses whose value makes a code (G and M). `word_functions`: an address may be a function by
    itself (F, S, T), which a control of keywords does not want, where C is a statement and an axis. `motion` is the
    group whose modal function runs when axis words are left over. `storage` says where cycle parameters live until
    the call ("instance" or "variables"). `together` raises alarms for a keyword and words that may not stand in one
    block, and gives remarks about them; it is asked once for each kind of block. `refused` maps codes that are known but
    not built, or do not exist, to the sentence that says so. `one_command`: a block is a single command, and no words of
    another stand beside it (else S, F, M … may stand in any block). `meanings` says what the words of functions are, by
    address ("DR") or, where that is not enough, by code and address ("G4 P"). `relative` are words so written that count
    from the last position under G91, beside coordinates, `absolute_with` codes in whose block coordinates are absolute
    even then. `told` says what the value of a word of a function means (the last argument: how many of its address stand
    before), `marks` what the marks on a word of a function or cycle do (the last argument: whether the word calls it).
    `to_turn` is the hint what makes the spindle turn. `names` leads from other names of cycles (DIN/ISO) to their codes.
    `named` gives the number (mm/min) that a word such as FAUTO stands for in a cycle, or the word itself; `predefined`
    what PREDEF stands for in a parameter of a cycle of a code; `calls_again` whether a modal call of a cycle (a modal
    function of the group "call") calls it in a block with a keyword and words; `turned` makes what a cycle runs in, where
    the tool axis is another than Z. `memory` makes what the control keeps beside the common state of a machine, a dataclass.
    `computed` works the formulas of a block without a keyword out before
    its words are handed out: one of them may be a code, or leave its word out. `preassigned` are variables that the control
    keeps itself; names that begin with `local_variables` belong to one program. `modern` writes a program in the notation
    of today, where the control's own is another. `trial` writes a short program around a cycle and its words (address and
    value), for its form; None where it cannot; `trial_files` are programs that it may call, by name, `trial_setup` is the
    machine that it runs on. `magazine` are the tools of a setup that was given none; of a control without tool words
    `cycle_tools` says which of them cut, by the code of a cycle (`mnclab.runs.material`).
    `signs` tell its programs from those of others; `numbers` finds the numbers of blocks, and what names them. `terms` is the
    file of what its manual calls all these (`mnclab.machine.terms`).
    """

    name: str
    title: str
    read: Reader
    functions: FunctionTable
    cycles: CycleTable
    phases: tuple[str, ...]
    suffixes: tuple[str, ...] = ()
    axes: str = "XYZ"
    codes: tuple[str, ...] = ("G", "M")
    word_functions: bool = True
    motion: str = "motion"
    settings: tuple[Setting, ...] = ()
    storage: str = "instance"
    frames: tuple[str, ...] = ()
    memory: Callable[[], Any] | None = None
    compensation: Compensation | None = None
    start: Callable[[Machine], None] | None = None
    finish: Callable[[Machine], None] | None = None
    signs: tuple[Sign, ...] = ()
    numbers: Callable[[Program], Numbers] | None = None
    refused: Mapping[str, str] = field(default_factory=dict)
    meanings: Mapping[str, str] = field(default_factory=dict)
    relative: tuple[str, ...] = ()
    absolute_with: tuple[str, ...] = ()
    told: Callable[[Function, Word, int], str] | None = None
    marks: Callable[[Function | type[Cycle], Word, bool], Iterator[tuple[str, str]]] | None = None
    names: Mapping[str, str] = field(default_factory=dict)
    together: Callable[[Control, Modal, str, list[Word]], Iterable[Remark] | None] | None = None
    bulk: Any = None
    one_command: bool = False
    named: Callable[[Machine, Word], float | str] | None = None
    predefined: Callable[[Machine, str, Parameter, Word], float | str] | None = None
    calls_again: Callable[[str, list[Word]], bool] | None = None
    turned: Callable[[Machine, Definition], AbstractContextManager[None]] | None = None
    lathe: bool = False
    to_turn: str = "write S and M3 before the move"
    computed: Callable[[Machine, list[Word]], list[Word]] | None = None
    preassigned: Mapping[str, Callable[[Machine], float | str | None]] = field(default_factory=dict)
    local_variables: str = ""
    trial: Callable[[type[Cycle], list[tuple[str, Any]]], str | None] | None = None
    trial_files: Mapping[str, str] = field(default_factory=dict)
    trial_setup: Setup | None = None
    modern: Callable[[Program], Notation] | None = None
    magazine: Magazine = field(default_factory=lambda: MILLS)
    cycle_tools: Mapping[str, int] = field(default_factory=dict)
    terms: Path | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "settings", with_every(self.settings))

    def __reduce__(self) -> tuple[Callable[[str], Control], tuple[str]]:
        """By its name, so that a run can go from one process to another."""
        return _known, (self.name,)

    def __copy__(self) -> Control:
        return self

    def __deepcopy__(self, memo: Any) -> Control:
        return self

    def power_on(self) -> dict[str, str]:
        """The modal state at the start: group -> code."""
        return {f.group: f.code for f in self.functions.values() if f.group and f.power_on}

    def term(self, code: str) -> str:
        """What the manual calls a code, empty where it has no term of its own."""
        found = terms(self.terms).get(plain(code))
        return found.shown.partition("; ")[0] if found else ""

    def across(self, settings: Mapping[str, Any]) -> str:
        """What X is in the programs of a lathe, where its settings are these: a "diameter" or a "radius"."""
        typed = settings.get("diameter") or self.meanings.get("X", "").startswith("diameter")
        return "diameter" if typed else "radius"

    def __repr__(self) -> str:
        return f"<Control {self.name}: {self.title}; {len(self.functions)} functions, {len(self.cycles)} cycles>"

    @property
    def listed(self) -> dict[str, Function]:
        """The functions by code, without those that are none of the control by itself."""
        return {code: each for code, each in self.functions.items() if each.listed}

    def _repr_html_(self) -> str:
        rows = [
            (f.code, f.title, f.group or "", "●" if f.power_on else "", f.source, self.term(f.code)) for f in self.listed.values()
        ]
        rows += [(code, c.title, "cycle", "", c.source, self.term(c.code)) for code, c in self.cycles.items()]
        head = ["code", "title", "group", "at power-on", "source", "in the manual"][: 6 if self.terms else 5]
        table = html_table(head, [row[: len(head)] for row in rows], code=(0,))
        settings = f"<h5>Settings</h5>{settings_html(self.settings)}" if self.settings else ""
        return f"<h4>{escape(self.title)}</h4>{table}{settings}"


# Settings: what a control leaves to its parameters, to the operator, or to the reader of its manual.
# A setting is declared once, in the `settings` of its control; from there come the check of what a Setup says, the table
# of `mnclab.help("settings", control)` and the values that functions and cycles find in `Machine.settings`.

class Setting(NamedTuple):
    """One choice. Its kind is that of the default: true or false, a number (None: unknown), a mapping, or one of `choices`
    (value -> meaning).

    `source` is the section of the manual, or the name of the reading where the manual leaves it open. `chooses`: what a
    choice makes of other settings, as long as nobody gives them (choice -> name -> value).
    """

    name: str
    default: Any
    meaning: str
    source: str = ""
    choices: Mapping[str, str] = MappingProxyType({})
    unit: str = ""
    at_least: float | None = None
    at_most: float | None = None
    chooses: Mapping[str, Mapping[str, Any]] = MappingProxyType({})

    def __repr__(self) -> str:
        return written(self)

    @property
    def allowed(self) -> str:
        if self.choices:
            return "one of " + ", ".join(self.choices)
        if isinstance(self.default, bool):
            return "true or false"
        if isinstance(self.default, Mapping):
            return "a mapping"
        least = "" if self.at_least is None else f" from {self.at_least:g}"
        most = "" if self.at_most is None else f" to {self.at_most:.10g}"
        return f"a {'whole ' if self.whole else ''}number{least}{most}"

    @property
    def whole(self) -> bool:
        """Whether it counts something: its default, or its least, is whole and has no unit."""
        return not self.unit and isinstance(self.at_least if self.default is None else self.default, int)

    def check(self, value: Any) -> Any:
        """The value as functions read it; an Alarm when it is not allowed."""
        if self.choices:
            good = isinstance(value, str) and value in self.choices
        elif isinstance(self.default, bool):
            good = isinstance(value, bool)
        elif value is None:
            good = self.default is None
        elif isinstance(self.default, Mapping):
            good = isinstance(value, Mapping)
        else:
            good = isinstance(value, Real) and not isinstance(value, bool)
            good = good and not value < -sys.float_info.max and value <= sys.float_info.max  # nor an int beyond any float
            good = good and not (self.whole and float(value) % 1)
            good = good and (self.at_least is None or float(value) >= self.at_least)
            good = good and (self.at_most is None or float(value) <= self.at_most)
        if not good:
            near = hint(value, self.choices, 1) if isinstance(value, str) else ""
            raise Alarm(f"setting {self.name} ({self.meaning}) must be {self.allowed}, got {shown(value)}", hint=near)
        return value


def one_of(name: str, meaning: str, source: str = "", /, **choices: str) -> Setting:
    """A setting with choices, of which the first is the default."""
    return Setting(name, next(iter(choices)), meaning, source, choices)


#: What every control has, unless it declares the same name itself.
EVERY = (
    Setting(
        "lint", "on", "what a teacher would say of a program that runs", "every control",
        {"on": "warnings, none of which stops a run", "off": "no word"},
    ),
    Setting(
        "stopped_spindle", "warn", "moves at feed while the spindle stands", "every control",
        {"warn": "one warning, at the first of them", "accept": "no word"},
    ),
    Setting(
        "most_blocks", 200_000, "blocks that jumps, repeats and calls may add to those of the text, one by one",
        "the patience of a reader", unit="blocks", at_least=1000, at_most=1_000_000_000,
    ),
    Setting(
        "most_rows", 500_000, "rows of the path beyond which a run ends, with 20 more for each block of the text",
        "the memory of the computer", unit="rows", at_least=1000, at_most=1_000_000_000,
    ),
    Setting(
        "most_megabytes", MOST_MEGABYTES, "size of the file of a program beyond which it is not read",
        "the memory of the computer", unit="MB", at_least=1, at_most=2000,
    ),
)  # fmt: skip


def with_every(declared: Iterable[Setting]) -> tuple[Setting, ...]:
    """The settings of a control, and those that every control has."""
    own = tuple(declared)
    names = {setting.name for setting in own}
    return own + tuple(setting for setting in EVERY if setting.name not in names)


def chosen(declared: Iterable[Setting], given: Mapping[str, Any], control: str, source: Any = None) -> dict[str, Any]:
    """Values by name: the defaults, and what a Setup gives instead. An Alarm names what is unknown or not allowed.

    `source` is the file of the setup, if there is one: the alarm shows the line of the setting in it.
    """
    known = {setting.name: setting for setting in declared}
    for name in given:
        if name not in known:
            listed = f"mnclab.help('settings', {control!r}) lists them" if known else "it has none"
            told = hint(str(name)[:40], known, 1) or listed
            place = source and source.place_of("settings", name)
            raise Alarm(f"{control} has no setting {shown(name)}", place, hint=told, source=source)
    found: dict[str, Any] = {}
    by_others: dict[str, Any] = {}
    for name, setting in sorted(known.items(), key=lambda item: not item[1].chooses):  # the choosing ones first
        try:
            found[name] = setting.check(given.get(name, by_others.get(name, setting.default)))
            by_others |= setting.chooses.get(found[name], {}) if setting.chooses else {}
        except Alarm as alarm:
            alarm.source, alarm.span = source, source and source.place_of("settings", name)
            raise
    return found


def rows(settings: Iterable[Setting]) -> list[tuple[str, str, str, str, str]]:
    """Name, default, allowed, meaning and source, a row for each setting and one below it for each of its choices."""
    table = []
    for one in settings:
        default = str(one.default).lower() if isinstance(one.default, bool) else str(one.default)
        default = "unknown" if one.default is None else default
        counted = one.unit[:1].isdigit()  # a unit such as 0.01 mm would be read as a second number
        unit = f" × {one.unit}" if counted else f" {one.unit}" if one.unit else ""
        table.append((one.name, default + unit, "" if one.choices else one.allowed, one.meaning, one.source))
        for choice, meaning in one.choices.items():
            others = ", ".join(f"{name}={value}" for name, value in one.chooses.get(choice, {}).items())
            table.append(("", "", choice, f"{meaning}:" if others else meaning, ""))
            table += [("", "", "", line, "") for line in wrap(others, WIDE)]
    return table


def switches(settings: Mapping[str, Any]) -> frozenset[int]:
    """The switches of block skip that are on: where the setting `block_skip` is, those among the digits of `skip_switches`."""
    on = settings.get("block_skip") and str(int(settings.get("skip_switches", 1)))
    return frozenset(map(int, on or ""))


WIDE = 70  # characters of a line of what a choice makes of other settings
HEAD = ("setting", "default", "allowed", "meaning", "source")


def settings_text(settings: Iterable[Setting]) -> str:
    """The settings as text."""
    return text_table(HEAD, rows(settings))


def settings_html(settings: Iterable[Setting]) -> str:
    """The settings as HTML."""
    return html_table(HEAD, rows(settings), code=(0, 1, 2))
