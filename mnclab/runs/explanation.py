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
from mnclab.machine.control import Function
from mnclab.machine.cycle import Cycle
from mnclab.machine.machine import Machine
from mnclab.path.listing import figure, point, words
from mnclab.running.flow import Course
from mnclab.running.handing_out import Action, Plan, Planner
from mnclab.text.alarm import Alarm, quoted
from mnclab.text.expression import Expression
from mnclab.text.program import Program, Word, digits
from mnclab.text.strings import NumberFromText, TextFormula
from mnclab.text.tables import html_table

if TYPE_CHECKING:
    from mnclab.runs.run import Moment, Run

BY_WORD = {"F": "feed", "S": "speed", "T": "tool"}
_UNIT = re.compile(r", ([\d. ]*(?:mm|m|rev|s)(?:/(?:min|rev))?)$")  # at the end of a meaning
SHOWN = 12  # rows of the path
Matrix = NDArray[np.float64]


class Meaning(NamedTuple):
    """One word of a block: as written, its value, the code that takes it, in plain words, the section of the manual."""

    word: str
    value: str
    code: str
    says: str
    source: str
    changed: str


class Stage(NamedTuple):
    """A step on the way from the programmed point to the tool: its name and the point (3,) mm there."""

    name: str
    point: tuple[float, float, float]
    note: str = ""


class Explanation:
    """A block explained; `meanings`, `changed` (name, before, after), `stages` and `moves` hold what is shown."""

    def __init__(self, run: Run, moment: Moment) -> None:
        self.run, self.moment = run, moment
        span = moment.block.span
        self.program = run.programs[run.steps.program[moment.step]]
        last = int(self.program.lines()[1][run.steps.block[moment.step]])
        self.alarms = tuple(_alarms(run, self.program, span.line, last))
        history = run.history
        self.changed = [
            (name, _said(name, history.value(name, moment.step - 1)) if moment.step else "", _said(name, value))
            for name, value in moment.changed.items()
        ]
        self.changed = [change for change in self.changed if change[1] != change[2]]
        self.skipped = bool(moment.block.skip and run.settings.get("block_skip"))
        self.meanings = tuple(_meanings(run, moment, dict((name, (a, b)) for name, a, b in self.changed)))
        self.stages = tuple(_stages(run, moment))
        path = run.toolpath[moment.rows]
        shown = len(path) if len(path) <= SHOWN + 1 else SHOWN  # a line that says "1 more" is no shorter
        self.moves = tuple(f"{move.kind.name.lower()} {words(move)}".strip() for move in path[:shown])
        self.more_moves = len(path) - shown

    @property
    def title(self) -> str:
        """The line, and the block as written."""
        text = quoted(self.program.line_text(self.moment.line).strip())[0]
        times = _executions(self.run, self.moment.step)
        again = f" (execution {times})" if times > 1 else ""
        return f"line {self.moment.line}{again}: {text}"

    def __str__(self) -> str:
        lines = [self.title]
        if self.skipped:
            lines.append("  passed over: block skip is on")
        lines += [f"  {alarm.severity}: {alarm.message}{alarm.others}" for alarm in self.alarms]
        wide = max((len(m.word) for m in self.meanings), default=0)
        for m in self.meanings:
            source = f"  [{m.source}]" if m.source else ""
            changed = f"  ({m.changed})" if m.changed else ""
            lines.append(f"  {m.word.ljust(wide)}  {m.says}{changed}{source}")
        if self.moves:
            lines.append("  moves")
            lines += [f"    {move}" for move in self.moves]
            lines += [f"    … {self.more_moves} more"] if self.more_moves else []
        if self.changed:
            lines.append("  changed")
            lines += [
                f"    {name}: {before} -> {after}" if before else f"    {name}: {after}"
                for name, before, after in self.changed
            ]
        lines.append("  from the program to the tool")
        wide = max(len(stage.name) for stage in self.stages)
        lines += [
            f"    {s.name.ljust(wide)}  {point(np.array(s.point))}{'  ' + s.note if s.note else ''}"
            for s in self.stages
        ]
        return "\n".join(lines)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        def table(head: tuple[str, ...], rows: list[tuple[str, ...]], numbers: tuple[int, ...] = ()) -> str:
            return html_table(head, rows, numbers=numbers) if rows else ""

        parts = [f"<h4>{escape(self.title)}</h4>"]
        if self.skipped:
            parts.append("<p>passed over: block skip is on</p>")
        parts += [alarm._repr_html_() for alarm in self.alarms]
        parts.append(
            table(
                ("word", "means", "changed", "section"), [(m.word, m.says, m.changed, m.source) for m in self.meanings]
            )
        )
        if self.moves:
            more = [f"… {self.more_moves} more"] if self.more_moves else []
            parts.append("<pre>" + escape("\n".join([*self.moves, *more])) + "</pre>")
        parts.append(table(("value", "before", "after"), [(n, a, b) for n, a, b in self.changed]))
        parts.append(
            table(
                ("from the program to the tool", "X", "Y", "Z", ""),
                [(s.name, *map(figure, s.point), s.note) for s in self.stages],
                numbers=(1, 2, 3),
            )
        )
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


# --- words -----------------------------------------------------------------------------------------------------------


def _meanings(run: Run, moment: Moment, changed: dict[str, tuple[str, str]]) -> list[Meaning]:
    """Every word of a block, in the order written; the keyword of a conversational block first."""
    block, program = moment.block, run.programs[run.steps.program[moment.step]]
    plan = _plan(run, moment)
    if plan is None:
        return [
            Meaning(written(program, word), _value(run, moment, word), "", "not obeyed: the block is refused", "", "")
            for word in block.words
        ]
    here = _Here(run, moment)

    def before(action: Action, index: int) -> int:
        """How many words of the same address the function takes before one."""
        return sum(block.words[i].address == block.words[index].address for i in action.takes if i < index)

    found: dict[int, list[Meaning]] = {}
    for action, _ in plan.actions:
        what = action.what
        for index in (action.head, *action.takes):
            word = block.words[index] if index >= 0 else None
            if index == action.head and isinstance(what, Function):
                says, source = _title(here, what, word), what.source
            elif index == action.head:
                says, source = f"cycle: {what.title}", what.source
            elif isinstance(what, Function):
                assert word is not None
                told = run.control.told and run.control.told(what, word, before(action, index))
                meaning = told or _UNIT.sub(r" (\1)", _meaning(here, what, word))
                says, source = f"{meaning} of {what.code} ({what.title})", ""
            else:
                assert word is not None
                says, source = _parameter(here, what, action.code, word, before(action, index)), ""
            kept = word is None and action.code != block.keyword  # modal, not written in this block
            shown = written(program, word) if word is not None else f"({action.code})" if kept else block.keyword
            if kept:
                says = f"{says}, active from before"
            value = _value(run, moment, word) if word is not None else ""
            if value:
                says += f" = {value}"
            name = _changes(what, word)
            old, new = changed.get(name, ("", ""))
            happened = f"{name}: {old or 'none'} -> {new}" if name in changed and index == action.head else ""
            if word is not None and word.address.startswith("Q") and word.address in changed:
                old, new = changed[word.address]
                happened = f"{old or 'none'} -> {new}"
            place = len(block.words) if kept and block.keyword else index
            found[place] = [Meaning(shown, value, action.code, says, source, happened)]
            if word is not None and run.control.marks:
                marks = run.control.marks(what, word, index == action.head)
                found[place] += [Meaning(mark, "", action.code, f"on {shown}: {does}", "", "") for mark, does in marks]
    return [meaning for index in sorted(found) for meaning in found[index]]


def written(program: Program, word: Word) -> str:
    """A word as the program writes it."""
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
        """What F is."""
        if self.active("per_time"):
            return "time of the move, s"
        return "feed, mm/rev" if self.active("per_rev") else "feed, mm/min"

    @property
    def speed(self) -> str:
        """What S is."""
        return "spindle speed, rev/min" if self.active("surface") is None else "cutting speed, m/min"


def _title(here: _Here, what: Function, word: Word | None) -> str:
    """The title of a function; of a word that is a function by itself also what it is in this block."""
    if word is None or word.address != what.code:
        return what.title
    says = _meaning(here, what, word)
    kind, _, unit = says.rpartition(", ")
    if kind.lower() == what.title.partition(",")[0].lower():
        return f"{what.title}, {unit}"
    return what.title if says.startswith("word ") else f"{what.title}: {says}"


def _plan(run: Run, moment: Moment) -> Plan | None:
    """How the words were handed out: planned anew in the state before the block; None where that is an alarm."""
    program = run.programs[run.steps.program[moment.step]]
    if run.steps.block[moment.step] in program.faulty_blocks():
        return None
    control, history, before = run.control, run.history, moment.step - 1
    machine = Machine(control, run.setup, Course(program))
    groups = {function.group for function in control.functions.values() if function.group} | {control.motion}
    machine.modal.update(control.power_on())
    if before >= 0:
        machine.modal.update({g: str(v) for g in groups if (v := history.value(g, before)) is not None})
        machine.pole = history.value("pole", before)
    cycle = control.cycles.get(str(history.value("cycle", before))) if before >= 0 else None
    active = cycle if cycle is not None and cycle.runs == "position" else None
    phases = {name: k for k, name in enumerate(control.phases)}
    block = moment.block
    try:
        return Planner(control, machine, phases, block.keyword, list(block.words), active).plan()
    except Alarm:  # the run has the same alarm at this block, and the explanation shows it
        return None


def _meaning(here: _Here, what: Function, word: Word) -> str:
    """What a word of a function is in this block."""
    address, own, control = word.address, f"{what.code} {word.address}", here.control
    says = control.meanings.get(own) or control.meanings.get(address)
    if says:
        relative = word.incremental or (here.incremental and own in control.relative)
        return _increment(says) if relative else says
    if address in ("X", "Y", "Z"):
        lathe = f", {'diameter' if here.settings.get('diameter') else 'radius'}" if control.lathe and address == "X" else ""
        relative = word.incremental or here.incremental
        return (f"increment along {address}" if relative else f"coordinate {address}") + lathe
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
    if relative != parameter.note:
        meaning = f"{parameter.meaning}, {relative}"
    else:
        meaning = _increment(parameter.meaning) if word.incremental else parameter.meaning
    unit = "mm/rev" if parameter.unit == "mm/min" and here.active("per_rev") else parameter.unit
    return f"{meaning}{f', {unit}' if unit else ''} ({code})"


def _increment(meaning: str) -> str:
    """What a word is that counts from the last position: no coordinate and no diameter."""
    if meaning.startswith("coordinate "):
        return "increment " + meaning.removeprefix("coordinate ")
    return f"increment on the {meaning}" if meaning.startswith("diameter") else f"{meaning}, incremental"


def _changes(what: Function | type[Cycle], word: Word | None) -> str:
    """The name in the history that a function changes."""
    if isinstance(what, Function):
        return what.group or BY_WORD.get(what.code, "")
    return "cycle"


def _value(run: Run, moment: Moment, word: Word | None) -> str:
    """The number or the text that a formula had."""
    if word is None or not isinstance(word.value, Expression | TextFormula | NumberFromText):
        return ""
    known = {name: run.history.value(name, moment.step - 1) for name in run.history}
    try:
        value = word.value.evaluate({name: value for name, value in known.items() if value is not None})
        return figure(value, 6) if isinstance(value, float) else f'"{value}"'
    except Alarm:  # a variable without a value: the run says so
        return ""


# --- the way to the tool -----------------------------------------------------------------------------------------------


def _stages(run: Run, moment: Moment) -> list[Stage]:
    """The programmed point, after every frame from the innermost to the outermost, after compensation."""
    stages = [Stage("programmed point", moment.position)]
    chain = [(name, matrix) for name, matrix in _frames(run, moment) if not np.array_equal(matrix, frames.IDENTITY)]
    here = np.array(moment.position)
    for name, matrix in reversed(chain):
        here = frames.apply(matrix, here)
        stages.append(Stage(f"after {name}", _tuple(here), _describe(matrix)))
    origin = run.toolpath.origin
    machine = here
    if not chain:
        stages.append(Stage("machine coordinates", _tuple(machine), "no frame is active"))
    if origin.any():
        stages.append(Stage("from the first work offset", _tuple(machine - origin), f"at machine {point(origin)}"))
    tip = np.array(moment.point)
    path, last = run.toolpath, moment.rows.stop - 1
    note = ""
    away = float(np.linalg.norm(tip - (machine - origin)))
    if last >= 0 and path.side[last] and away > 1e-9:
        side = "left" if path.side[last] > 0 else "right"
        note = f"tool radius {figure(float(path.radius[last]))} to the {side}: {figure(away)} mm away"
    elif away > 1e-6:
        note = f"{figure(away)} mm away: a frame was changed since, or corners were rounded"
    stages.append(Stage("tool tip", _tuple(tip), note))
    tool = run.tables.tools.get(int(path.tool[last])) if last >= 0 else None
    if tool is not None and not path.lathe:
        length = np.array([0.0, 0.0, tool.effective_length])
        stages.append(
            Stage(
                "spindle, machine coordinates",
                _tuple(tip + origin + length),
                f"tool length {figure(tool.effective_length)}",
            )
        )
    return stages


def _frames(run: Run, moment: Moment) -> list[tuple[str, Matrix]]:
    """The frames after the block, the outermost first."""
    names = list(dict.fromkeys([*run.control.frames, *(name for name, _ in run.frames)]))
    values = ((name, run.history.value(f"frame {name}", moment.step)) for name in names)
    return [(name, np.array(value)) for name, value in values if value is not None]


def _describe(matrix: Matrix) -> str:
    """A frame in words."""
    if frames.is_shift(matrix):
        return f"shift {point(matrix[:3, 3])}"
    linear = matrix[:3, :3]
    scales = np.linalg.norm(linear, axis=0)
    if np.allclose(np.abs(linear), np.diag(scales)):
        signs = "".join(axis for axis, factor in zip("XYZ", np.diag(linear)) if factor < 0)
        said = [f"mirror {signs}"] if signs else []
        said += [f"scale {' '.join(map(figure, scales))}"] if not np.allclose(scales, 1) else []
        return ", ".join(said)
    angle = np.degrees(np.arccos(np.clip((np.trace(linear) - 1) / 2, -1, 1)))
    return f"turn by {figure(angle if linear[1, 0] >= 0 else -angle)}°" if np.allclose(scales, 1) else "turn and scale"


def _tuple(xyz: NDArray[np.float64]) -> tuple[float, float, float]:
    x, y, z = np.asarray(xyz, dtype=np.float64).tolist()
    return x, y, z


def _said(name: str, value: Any) -> str:
    """A value of the history in words: angles of the rotary axes in degrees."""
    if name == "rotary" and value is not None:
        return " ".join(f"{axis}{figure(np.degrees(angle), 6)}" for axis, angle in zip("ABC", value, strict=True))
    return _plain(value)


def _plain(value: Any) -> str:
    """A value of the history in words."""
    if value is None:
        return ""
    if isinstance(value, int | float):
        return figure(float(value), 6)
    if isinstance(value, str):
        return value
    if isinstance(value, tuple) and len(value) == 4 and np.shape(value[-1]) == (4,):
        return _describe(np.array(value)) or "none"
    if isinstance(value, tuple) and type(value).__str__ is not tuple.__str__:  # it says itself what it is
        return str(value)
    if isinstance(value, tuple):
        return " ".join(figure(each, 4) if isinstance(each, int | float) else _plain(each) for each in value)
    number = getattr(value, "number", None)
    return f"T{number} {value.name}".strip() if number is not None else str(value)
