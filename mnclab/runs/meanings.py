"""What the words of a block mean: each with the function that takes it, where the manual says so, what it changed."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, NamedTuple

from mnclab.machine.control import Control, Function, Modal
from mnclab.machine.cycle import Cycle
from mnclab.path.listing import Unit, figure
from mnclab.running.dispatch import Action, Plan, Planner
from mnclab.runs.values import unit_of
from mnclab.text.alarm import Alarm
from mnclab.text.expression import Expression
from mnclab.text.program import Program, Word, digits
from mnclab.text.strings import NumberFromText, TextFormula

if TYPE_CHECKING:
    from mnclab.runs.moment import Moment
    from mnclab.runs.run import Run

BY_WORD = {"F": "feed", "S": "speed", "T": "tool"}
_UNIT = re.compile(r", ([\d. ]*(?:mm|m|rev|s)(?:/(?:min|rev))?)$")  # at the end of a meaning


class Meaning(NamedTuple):
    """One word of a block: as written, its value, the code that takes it, in plain words, the section of the manual."""

    word: str
    value: str
    code: str
    says: str
    source: str
    changed: str


def meanings(run: Run, moment: Moment, changed: dict[str, tuple[str, str]]) -> list[Meaning]:
    """Every word of a block, in the order written; the keyword of a conversational block first."""
    block, program = moment.block, run.programs[run.steps.program[moment.step]]
    plan, here = _plan(run, moment), _Here(run, moment)
    if plan is None:
        refused = "", "not obeyed: the block is refused", "", ""
        return [Meaning(_written(program, word), _value(run, moment, word), *refused) for word in block.words]

    def before(action: Action, index: int) -> int:
        """How many words of the same address the function takes before one."""
        return sum(block.words[i].address == block.words[index].address for i in action.takes if i < index)

    found: dict[int, list[Meaning]] = {}
    for action, _ in plan.actions:
        what = action.what
        for index in (action.head, *action.takes):
            word = block.words[index] if index >= 0 else None
            source = what.source if index == action.head else ""
            if index == action.head:
                says = _title(here, what, word) if isinstance(what, Function) else f"cycle: {what.title}"
            elif isinstance(what, Function):
                assert word is not None
                told = run.control.told and run.control.told(what, word, before(action, index))
                meaning = told or _UNIT.sub(r" (\1)", _meaning(here, what, word))
                says = f"{meaning} of {what.code} ({what.title})"
            else:
                assert word is not None
                says = _parameter(here, what, action.code, word, before(action, index))
            kept = word is None and action.code != block.keyword  # modal, not written in this block
            unwritten = kept or program.said  # which has other names
            shown = _written(program, word) if word is not None else f"({action.code})" if unwritten else block.keyword
            value = _value(run, moment, word)
            says += (", active from before" if kept else "") + (f" = {value}" if value else "")
            name, happened = _changes(what), ""  # in the history
            if word is not None and word.address.startswith("Q") and word.address in changed:
                happened = _became(*changed[word.address])
            elif name in changed and index == action.head:
                happened = f"{name}: {_became(*changed[name])}"
            place = len(block.words) if kept and block.keyword else index
            found[place] = [Meaning(shown, value, action.code, says, source, happened)]
            if word is not None and run.control.marks:
                marks = run.control.marks(what, word, index == action.head)
                found[place] += [Meaning(mark, "", action.code, f"on {shown}: {does}", "", "") for mark, does in marks]
    return [meaning for index in sorted(found) for meaning in found[index]]


def _became(old: str, new: str) -> str:
    return f"{old or 'none'} -> {new}"


def _written(program: Program, word: Word) -> str:
    line, column, length, _ = word.span
    return program.line_text(line)[column - 1 : column - 1 + length].strip() or str(word)


class _Here:
    """How words are read in one block: the control, its settings, what is active in it."""

    def __init__(self, run: Run, moment: Moment) -> None:
        self.control, self.settings = run.control, run.settings
        self.active = lambda name: run.history.value(name, moment.step)
        codes = {f"{word.address}{digits(word.value)}" for word in moment.block.words if isinstance(word.value, float)}
        self.incremental = self.active("dimension") == "G91" and not codes & set(run.control.absolute_with)

    @property
    def feed(self) -> str:
        if self.active("per_time"):
            return "time of the move, s"
        return f"feed, {self.unit.for_feed(self.active('per_rev')).rate}"

    @property
    def unit(self) -> Unit:
        """What lengths and feeds count in."""
        return unit_of({"unit": self.active("unit")})

    @property
    def speed(self) -> str:
        return "spindle speed, rev/min" if self.active("surface") is None else "cutting speed, m/min"


def _title(here: _Here, what: Function, word: Word | None) -> str:
    if word is None or word.address != what.code:
        return what.title
    says = _meaning(here, what, word)
    kind, _, unit = says.rpartition(", ")
    if kind.lower() == what.title.partition(",")[0].lower():
        return f"{what.title}, {unit}"
    return what.title if says.startswith("word ") else f"{what.title}: {says}"


def _plan(run: Run, moment: Moment) -> Plan | None:
    """How the words were handed out, planned again in the state before the block; None where that is an alarm."""
    program, control = run.programs[run.steps.program[moment.step]], run.control
    if run.steps.block[moment.step] in program.faulty_blocks():
        return None

    def before(name: str) -> Any:
        return run.history.value(name, moment.step - 1)

    cycle = control.cycles.get(str(before("cycle")))
    active = cycle if cycle is not None and cycle.runs == "position" else None
    motion = before(control.motion) or control.power_on().get(control.motion)
    modal = Modal(motion, before("call"), before("pole") is not None, active, Modal.ends_cycle(run.settings))
    try:
        return Planner(control, modal, moment.block.keyword, list(moment.block.words)).plan()
    except Alarm:  # the run has the same alarm at this block, and the explanation shows it
        return None


def meant(control: Control, code: str, address: str) -> str:
    """What the tables of a control say of a word of a function; empty where they are silent."""
    return control.meanings.get(f"{code} {address}") or control.meanings.get(address) or ""


def _meaning(here: _Here, what: Function, word: Word) -> str:
    """What a word of a function is in this block."""
    address, own, control = word.address, f"{what.code} {word.address}", here.control
    if says := meant(control, what.code, address):
        relative = word.incremental or (here.incremental and own in control.relative)
        return _increment(says) if relative else says
    if address in ("X", "Y", "Z"):
        across = "diameter" if here.settings.get("diameter") else "radius"
        says = f"increment along {address}" if word.incremental or here.incremental else f"coordinate {address}"
        return f"{says}, {across}" if control.lathe and address == "X" else says
    if address in ("F", "S"):
        return here.feed if address == "F" else here.speed
    if (axis := address.rpartition(":")[2]) in ("A", "B", "C"):
        return f"increment about {axis}" if word.incremental else f"rotary axis {axis}"
    return f"word {address}" if address.isalpha() and address.isupper() else "part"


def _parameter(here: _Here, cycle: type[Cycle], code: str, word: Word, which: int = 0) -> str:
    """The parameter of a cycle that a word gives: of several with the same address, by their order."""
    alike = [p for p in cycle.parameters() if word.address in (p.address, *p.aliases) and not p.mark]
    if not alike:
        return f"word of {code}"
    parameter = alike[min(which, len(alike) - 1)]
    relative = parameter.note.removeprefix("under G91 ") if here.incremental else parameter.note
    meaning = _increment(parameter.meaning) if word.incremental else parameter.meaning
    if relative != parameter.note:
        meaning = f"{parameter.meaning}, {relative}"
    unit = "mm/rev" if parameter.unit == "mm/min" and here.active("per_rev") else parameter.unit
    if parameter.in_units:
        unit = here.unit.rate if unit == "mm/min" else unit.replace("mm", here.unit.short)
    return f"{meaning}{f', {unit}' if unit else ''} ({code})"


def _increment(meaning: str) -> str:
    """What a word is that counts from the last position: no coordinate and no diameter."""
    if meaning.startswith("coordinate "):
        return "increment " + meaning.removeprefix("coordinate ")
    return f"increment on the {meaning}" if meaning.startswith("diameter") else f"{meaning}, incremental"


def _changes(what: Function | type[Cycle]) -> str:
    """The name in the history that a function changes."""
    return (what.group or BY_WORD.get(what.code, "")) if isinstance(what, Function) else "cycle"


def _value(run: Run, moment: Moment, word: Word | None) -> str:
    """The number or the text that a formula had; the variable that takes a value is no formula."""
    if word is None or word.address == "target" or not isinstance(word.value, Expression | TextFormula | NumberFromText):
        return ""
    known = {name: run.history.value(name, moment.step - 1) for name in run.history}
    try:
        value = word.value.evaluate({name: value for name, value in known.items() if value is not None})
        return figure(value, 6) if isinstance(value, float) else f'"{value}"'
    except Alarm:  # a variable without a value: the run says so
        return ""
