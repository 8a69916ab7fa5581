"""What one block does, in plain words: each word with the function that takes it, where the manual says so, what it
changed; and the way from the programmed point through datum, transformations and compensation to the tool tip.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import frames
from mnclab.machine.control import Control, Function, Modal, switches
from mnclab.machine.coordinates import LOG
from mnclab.machine.cycle import Cycle
from mnclab.path.listing import MM, Unit, figure, point, words
from mnclab.running.dispatch import Action, BlockPlan, Planner
from mnclab.runs.history import Matrix, described, said, unit_of
from mnclab.text.alarm import Alarm, quoted, several
from mnclab.text.expression import Expression
from mnclab.text.program import Program, Word, digits
from mnclab.text.strings import NumberFromText, TextFormula
from mnclab.text.tables import html_table

if TYPE_CHECKING:
    from mnclab.path.toolpath import Toolpath
    from mnclab.runs.history import Moment
    from mnclab.runs.run import Run


class Stage(NamedTuple):
    """A step on the way from the programmed point to the tool: its name and the point (3,) mm there."""

    name: str
    point: tuple[float, float, float]
    note: str = ""


def stages(run: Run, moment: Moment) -> list[Stage]:
    """The programmed point, after every frame from the innermost to the outermost, after compensation."""
    found, unit = [Stage("programmed point", moment.position)], unit_of(moment.state)
    chain = [(name, matrix) for name, matrix in _frames(run, moment) if not np.array_equal(matrix, frames.IDENTITY)]
    here = np.array(moment.position)
    for name, matrix in reversed(chain):
        here = frames.apply(matrix, here)
        found.append(Stage(f"after {name}", _tuple(here), described(matrix, unit)))
    path, last, tip, note = run.toolpath, moment.rows.stop - 1, np.array(moment.point), ""
    if not chain:
        found.append(Stage("machine coordinates", _tuple(here), "no frame is active"))
    if path.origin.any():
        found.append(
            Stage("from the first work offset", _tuple(here - path.origin), f"at machine {point(path.origin, unit)}")
        )
    away = float(np.linalg.norm(tip - (here - path.origin)))
    if last >= 0 and path.side[last] and away > 1e-9:
        side = "left" if path.side[last] > 0 else "right"
        note = f"tool radius {unit.figure(float(path.radius[last]))} to the {side}: {unit.figure(away)} {unit.short} away"
    elif away > 1e-6:
        why = "a frame was changed since, or corners were rounded"
        if path.kinematics is not None:
            why = "rotary axes stand elsewhere than coordinates count with, or a frame was changed"
        note = f"{unit.figure(away)} {unit.short} away: {why}"
    found.append(Stage("tool tip", _tuple(tip), note))
    tool = run.tables.tools.get(int(path.tool[last])) if last >= 0 else None
    if tool is not None and not path.lathe:
        spindle = tip + path.origin
        if path.kinematics is not None:
            spindle = np.array(run.axes())[last, :3]
        else:
            spindle["XYZ".index(run.history.value(LOG, moment.step) or "Z")] += tool.effective_length
        note = f"tool length {unit.figure(tool.effective_length)}"
        found.append(Stage("spindle, machine coordinates", _tuple(spindle), note))
    return found


def _frames(run: Run, moment: Moment) -> list[tuple[str, Matrix]]:
    """The frames after the block, the outermost first."""
    known = [name.removeprefix("frame ") for name in run.history if name.startswith("frame ")]
    names = list(dict.fromkeys([*run.control.frames, *(name for name, _ in run.frames), *known]))
    values = ((name, run.history.value(f"frame {name}", moment.step)) for name in names)
    return [(name, np.array(value)) for name, value in values if value is not None]


def _tuple(xyz: NDArray[np.float64]) -> tuple[float, float, float]:
    x, y, z = np.asarray(xyz, dtype=np.float64).tolist()
    return x, y, z


# What the words of a block mean: each with the function that takes it, where the manual says so, what it changed.

BY_WORD = {"F": "feed", "S": "speed", "T": "tool"}
_UNIT = re.compile(r", ([\d. ]*(?:mm|m|rev|s)(?:/(?:min|rev))?)$")  # at the end of a meaning


class Meaning(NamedTuple):
    """One word of a block: as written, its value, the code that takes it, in plain words, the section of the manual, what
    changed, and of a cycle what the manual calls it."""

    word: str
    value: str
    code: str
    says: str
    source: str
    changed: str
    term: str = ""

    @property
    def shown(self) -> str:
        """What it says, with the term of the manual."""
        return f"{self.says} [{self.term}]" if self.term else self.says


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
            term = "" if isinstance(what, Function) or index != action.head else run.control.term(what.code)
            found[place] = [Meaning(shown, value, action.code, says, source, happened, term)]
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


def _plan(run: Run, moment: Moment) -> BlockPlan | None:
    """How the words were handed out, planned again in the state before the block; None where that is an alarm."""
    program, control = run.programs[run.steps.program[moment.step]], run.control
    if run.steps.block[moment.step] in program.faulty_blocks():
        return None

    def before(name: str) -> Any:
        return run.history.value(name, moment.step - 1)

    cycle = control.cycles.get(str(before("cycle")))
    active = cycle if cycle is not None and cycle.runs == "position" else None
    motion = before(control.motion) or control.power_on().get(control.motion)
    modal = Modal(motion, before("call"), before("pole") is not None, active, *Modal.chosen(run.settings))
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
        says = f"increment along {address}" if word.incremental or here.incremental else f"coordinate {address}"
        return f"{says}, {control.across(here.settings)}" if control.lathe and address == "X" else says
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



SHOWN = 12  # moves, or steps of a cycle
STEP = "  ; "  # before the name of a step


class Explanation:
    """A block explained; `meanings`, `changed` (name, before, after), `stages` and `moves` hold what is shown."""

    def __init__(self, run: Run, moment: Moment, line: int | None = None) -> None:
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
        self.line, self.lines = moment.line, range(span.line, last + 1)
        found = meanings(run, moment, {name: (old, new) for name, old, new in self.changed})
        if line is not None and line in self.lines[1:] and self.program.number_of(line):  # to who reads, a block of its own
            self.line, text = line, "".join(self.program.line_text(line).split())
            found = [each for each in found if "".join(each.word.split()) in text]
        self.meanings = tuple(found)
        self.stages = tuple(stages(run, moment))
        self.moves, self.more_moves = self._moves(run.toolpath[moment.rows])

    @property
    def title(self) -> str:
        text, number = quoted(self.program.line_text(self.line).strip())[0], self.program.number_of(self.line)
        times = _executions(self.run, self.moment.step)
        again = f" (execution {times})" if times > 1 else ""
        within = f", one of lines {self.lines[0]} to {self.lines[-1]}" * (self.line != self.moment.line)
        return f"line {self.line}{f', block {number}' * bool(number)}{within}{again}: {text}"

    def _moves(self, path: Toolpath) -> tuple[tuple[str, ...], int]:
        """The moves, those of one step of a cycle in one line with its name; and how many are not told."""
        first = np.flatnonzero(np.diff(path.label, prepend=-1) != 0) if path.label.any() else np.arange(len(path))
        shown = len(first) if len(first) <= SHOWN + 1 else SHOWN  # a line that says "1 more" is no shorter
        ends, told = np.append(first, len(path)), []
        for a, b in zip(ends[:shown].tolist(), ends[1:].tolist()):
            move, name = path[b - 1], path.labels[path.label[a]]
            said = f"{move.kind.name.lower()} {words(move, self.unit)}".strip()
            said = said if b - a == 1 else f"{b - a} moves, the last {said}"
            told.append(f"{said}{STEP}{name}" if name else said)
        return tuple(told), len(path) - int(ends[shown])

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
            lines.append(f"  {m.word.ljust(wide)}  {m.shown}{changed}{source}")
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
        told = "\n".join(self._moves_told())
        moves = f"<pre>{escape(told)}</pre>" if told else ""
        if STEP in told:
            count = len(self.run.toolpath[self.moment.rows])
            moves = f"<details><summary>{several(count, 'move')} of the cycle</summary>{moves}</details>"
        words = [(m.word, m.shown, m.changed, m.source) for m in self.meanings]
        stages = [(s.name, *map(self.unit.figure, s.point), s.note) for s in self.stages]
        parts = [
            f"<h4>{escape(self.title)}</h4>",
            "<p>passed over: block skip is on</p>" if self.skipped else "",
            *(alarm._repr_html_() for alarm in self.alarms),
            html_table(("word", "means", "changed", "section"), words) if words else "",
            moves,
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
