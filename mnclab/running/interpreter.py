"""The loop over blocks: words are handed out, each function takes its own, and what is left is an alarm."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from mnclab.machine.control import Control, Function, Modal, Remark, Words, switches
from mnclab.machine.cycle import Cycle, Definition
from mnclab.machine.flow import determine
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Setup
from mnclab.running.bulk import Bulk
from mnclab.running.cycles import assign, instance, refuse_marks, run_cycle, store, units_of, verify
from mnclab.running.dispatch import BlockPlan, Planner
from mnclab.running.flow import Course, course
from mnclab.text.alarm import ALARM, WARNING, Alarm, Span
from mnclab.text.file import decode, read
from mnclab.text.opening import progress
from mnclab.text.program import EXPRESSION, NONE, NUMBER, Program, Word, place_of

# Other programs and tables, found by their name: in `Setup.files`, then beside the calling file, never elsewhere.
# Names are compared without regard to case. A type that is not written is that of the control; a directory counts only for
# `Setup.files`, where a name may be a whole path of the control, since the folders of the control are not those here.

def called(m: Machine, name: str, what: str, span: Span | None = None) -> int:
    """The index in `flow.programs` of the program of a name, read when it is first called; an Alarm if there is none.

    `what` begins the sentence of the alarm: the statement that calls.
    """
    flow = course(m)
    index = flow.found.get((flow.program.folder, name))
    if index is None:
        key, text, folder = found(m, name, what, span)
        same = (k for k, known in enumerate(flow.programs) if known.name == key and (k or known.folder))
        index = next(same, None)
        if index is None:
            program = m.control.read(text, key)
            object.__setattr__(program, "folder", folder)
            index = flow.add(m, program)
        flow.found[flow.program.folder, name] = index
    return index


class OpenedFile(NamedTuple):
    """A file: its name, its text, its folder, "" for none."""

    name: str
    text: str
    folder: str


def found(m: Machine, name: str, what: str, span: Span | None, kind: str = "program") -> OpenedFile:
    """The file that a statement (`what`) names; an Alarm if there is none. A `kind` other than programs names its type."""
    caller = m.flow.program
    types = sorted(m.control.suffixes, key=lambda suffix: not caller.name.lower().endswith(suffix)) or [""]  # its own first
    for wanted, suffix in ((_spelt(name, suffix), suffix) for suffix in types):
        files = {_spelt(known, suffix): (known, source) for known, source in m.setup.files.items()}
        for key in (wanted, _last(wanted)):
            if key in files:
                known, source = files[key]
                if isinstance(source, str):
                    return OpenedFile(known, source, caller.folder)
                return OpenedFile(str(source), _text(source, what, span), str(source.parent))
    file = next(filter(None, (_beside(caller, _last(_spelt(name, suffix))) for suffix in (*types, ""))), None)
    if file is not None and not Path(os.path.realpath(file)).is_relative_to(os.path.realpath(caller.folder)):
        elsewhere = "it is a symbolic link to another folder, and files are taken from the folder of the program alone"
        raise Alarm(f"{what} {name}: {elsewhere}", span, hint="Setup(files=…) names files that lie elsewhere")
    if file is None:
        where = f"the folder of {caller.title}" if caller.folder else "a program without a file has no folder"
        names = ", ".join(sorted(m.setup.files)[:8])
        hint = f"Setup(files=…) has {names or 'no files'}; {where}{' has none' if caller.folder else ''}"
        raise Alarm(f"{what} {name}: there is no {kind} of this name", span, hint=hint)
    return OpenedFile(str(file), _text(file, what, span), caller.folder)


def _beside(caller: Program, wanted: str) -> Path | None:
    if not caller.folder:
        return None
    try:
        names = sorted(name for name in os.listdir(caller.folder) if name.lower() == wanted)
    except OSError:
        return None
    return next((path for name in names if os.path.isfile(path := Path(caller.folder, name))), None)


def _text(path: Path, what: str, span: Span | None) -> str:
    try:
        return decode(read(path, f"{what}: {path.name}"))[0]
    except Alarm as alarm:
        alarm.span = span
        raise


def _spelt(name: str, suffix: str) -> str:
    """A name as it is compared: small letters, one kind of slash, with a type of the control."""
    name = name.strip().replace("\\", "/").lower()
    return name if "." in _last(name) else name + suffix


def _last(name: str) -> str:
    return name.replace(":", "/").rpartition("/")[2]


def alarms_of(program: Program, index: int) -> Iterator[Alarm]:
    """The alarms that a reader found in a program, at their places in a run."""
    for alarm in program.alarms:
        yield alarm.changed(span=alarm.span and alarm.span._replace(program=index), source=program)


WINDOW = 256  # blocks whose words are made at once; more would keep the garbage collector busy
RECENT = 4  # windows that are kept
#: What stops a run where the reader found so many faults of a kind that it only counts them.
UNTOLD = "this block is faulty: it has one of the many faults that are only counted"


class Stop(Exception):
    """The run stops at an alarm that the reader has already reported, in the block at `span`."""

    def __init__(self, span: Span | None = None) -> None:
        super().__init__()
        self.span = span


class Loaded:
    """A program ready to run: its alarms as a run shows them, the blocks that a fault stands in, its bulk tier."""

    def __init__(self, machine: Machine, flow: Course, program: Program, index: int) -> None:
        self.program, self.skips = program, switches(machine.settings)
        self.alarms = [self._passed_over(alarm) for alarm in alarms_of(program, index)]
        self.told = {self._block_of(alarm) for alarm in self.alarms if alarm.severity == ALARM and alarm.span}
        self.faulty = set(program.faulty_blocks().tolist())
        self.bulk = Bulk(machine, flow, program, self.faulty)

    def _block_of(self, alarm: Alarm) -> int:
        """The block in which the reader found a fault: the run stops there."""
        assert alarm.span is not None
        offset = int(self.program.line_starts[alarm.span.line - 1]) + alarm.span.column - 1
        return max(int(np.searchsorted(self.program.start, offset, "right")) - 1, 0)

    def _passed_over(self, alarm: Alarm) -> Alarm:
        """An alarm of the reader; no more than a warning in a block that is passed over."""
        if not (self.skips and alarm.span and len(self.program)):
            return alarm
        if int(self.program.skip[self._block_of(alarm)]) not in self.skips:
            return alarm
        return alarm.changed(severity=WARNING)


class Interpreter:
    """Runs a program, and those it calls, on a machine of its own."""

    def __init__(self, control: Control, setup: Setup, program: Program) -> None:
        self.control, self.program = control, program
        self.flow = Course(program, self.obey, self.switch)
        self.machine = machine = Machine(control, setup, self.flow)
        self.plans: dict[Any, BlockPlan] = {}
        self.window = range(0)
        self.blocks: list[tuple[int, int, str, list[Word], tuple[Any, ...] | None]] = []
        """Of the blocks in the window: line, skip, keyword, words, and of each word its address, with the value where that
        makes another function; nothing where a control works its formulas out before it hands the words out."""
        self.recent: deque[tuple[int, range, list[Any]]] = deque(maxlen=RECENT)  # of which program; window, blocks
        self.skips = switches(machine.settings)
        self.chosen = Modal.chosen(machine.settings)
        self.loaded: dict[int, Loaded] = {}
        self.alarms: list[Alarm] = []  # that readers found
        self.switch(0)
        self.flow.allow(int(machine.settings["most_blocks"]))
        machine.recorder.expected = len(program)
        machine.recorder.most = self.flow.most_rows(machine)
        machine.recorder.refuse = partial(self.flow.too_many_rows, machine)

    def switch(self, index: int) -> None:
        self.program = self.flow.programs[index]
        if index not in self.loaded:
            self.loaded[index] = Loaded(self.machine, self.flow, self.program, index)
            self.alarms += self.loaded[index].alarms
        self.flow.bulk, self.faulty = self.loaded[index].bulk.obey, self.loaded[index].faulty
        self.window = range(0)

    def run(self) -> None:
        """From the first block to the end, or to the first alarm."""
        for group, code in self.control.power_on().items():
            self.machine.set_modal(group, code)
        if self.machine.setup.variables and not self.control.preassigned:
            self.machine.alarm(f"Setup(variables=…): programs of {self.control.name} have no variables")
        if self.control.start:
            self.control.start(self.machine)
        with progress("running", len(self.program), "blocks") as self.flow.watched:
            self.flow.section(self.machine, 0, len(self.program))
        determine(self.machine)
        if self.control.finish and not self.machine.ended:
            self.control.finish(self.machine)

    def placed(self, alarm: Alarm) -> Alarm:
        """An alarm at the block where it came; most know their place."""
        alarm.span = alarm.span or self.flow.span_of_step(self.machine.step)
        return alarm

    # --- one block -----------------------------------------------------------------------------------------------------

    def obey(self, index: int) -> None:
        machine, window = self.machine, self.window
        machine.step = self.flow.begin(index)
        if index not in window:
            window = self.open_window(index)
        machine.source_line, skip, keyword, words, kinds = self.blocks[index - window.start]
        if skip and skip in self.skips:
            return
        if index in self.faulty:
            here = self.flow.span_of_block(index)
            raise Stop(here) if index in self.loaded[machine.program].told else Alarm(UNTOLD, here)
        before = machine.programmed
        if kinds is None:
            assert self.control.computed is not None
            words = self.control.computed(machine, words)
            kinds = tuple(self.kinds(words))
        plan = self.plan_for(keyword, kinds, words)
        if plan.remarks:
            self.remark(plan.remarks, words)
        for (_, what, code, head, _), pick in plan.actions:
            if machine.unheard and code.startswith(machine.unheard):
                continue
            if machine.pending and not (isinstance(what, Function) and what.collects):
                determine(machine)
                before = machine.programmed
            if isinstance(what, Function):
                if what.group and what.modal and machine.modal.get(what.group) != what.code:
                    machine.set_modal(what.group, what.code)
                what.obey(machine, Words(pick(words), what.code))
            else:
                self.take_cycle(what, code, words[head] if head >= 0 else None, pick(words))
        machine.end_block()
        if machine.programmed != before:
            machine.log("position", machine.programmed)
            if machine.side:  # it will be compensated
                self.flow.spend_again(1)

    def open_window(self, index: int) -> range:
        """Make the next blocks: columns as lists, for plain Python is faster on those. A loop finds them once more."""
        running = self.machine.program
        for which, window, blocks in self.recent:
            if which == running and index in window:
                self.window, self.blocks = window, blocks
                return window
        program, new = self.program, tuple.__new__
        window = range(index, min(index + WINDOW, len(program)))
        here = slice(index, window.stop)
        a, b = int(program.first[index]), int(program.first[window.stop])
        offset = program.offset[a:b]
        line = np.searchsorted(program.line_starts, offset, "right")
        column = offset - program.line_starts[line - 1] + 1
        place = place_of(line, column, program.length[a:b])
        columns = program.address[a:b], program.value[a:b], program.form[a:b], place, program.flag[a:b]
        names, payload = program.addresses, program.payload
        words = [
            new(Word, (names[k], v if form == NUMBER else None if form == NONE else payload[int(v)], at, flag))
            for k, v, form, at, flag in zip(*(part.tolist() for part in columns), strict=True)
        ]
        kinds = self.kinds(words)
        bounds = (program.first[index : window.stop + 1] - a).tolist()
        heads = zip(
            np.asarray(program.line_of(here)).tolist(), program.skip[here].tolist(), program.keyword[here].tolist(),
            bounds[:-1], bounds[1:], strict=True,
        )  # fmt: skip
        keys = program.keywords
        odd = {}
        if self.control.computed:
            odd = dict.fromkeys(np.searchsorted(program.first, a + np.flatnonzero(columns[2] == EXPRESSION), "right") - 1)
        self.blocks = [
            (n, skip, keys[k], words[i:j], None if block in odd and not keys[k] else tuple(kinds[i:j]))
            for block, (n, skip, k, i, j) in enumerate(heads, index)
        ]
        self.window = window
        self.recent.append((running, window, self.blocks))
        return window

    def kinds(self, words: list[Word]) -> list[Any]:
        """What a plan depends on in words: their addresses, and of G and M the values."""
        codes = self.control.codes
        return [(w[0], w[1]) if w[0] in codes else w[0] for w in words]

    # --- planning ----------------------------------------------------------------------------------------------------

    def plan_for(self, keyword: str, kinds: tuple[Any, ...], words: list[Word]) -> BlockPlan:
        machine = self.machine
        active = machine.position_cycle.cycle if machine.position_cycle else None
        motion, call = machine.modal.get(self.control.motion), machine.modal.get("call")
        modal = motion, call, machine.pole is not None, active, *self.chosen
        plan = self.plans.get((keyword, kinds, modal))
        if plan is None:
            planner = Planner(self.control, Modal._make(modal), keyword, words)
            try:
                plan = self.plans[keyword, kinds, modal] = planner.plan()
            except Alarm as alarm:
                self.remark(planner.strange, words)
                machine.alarm(alarm.message, alarm.span, alarm.hint)  # at its place in the running program
        return plan

    def remark(self, remarks: Iterable[Remark], words: list[Word]) -> None:
        for which, sentence, hint in remarks:
            self.machine.warn(sentence, words[which], hint)

    # --- cycles --------------------------------------------------------------------------------------------------------

    def take_cycle(self, cycle: type[Cycle], code: str, head: Word | None, given: tuple[Word, ...]) -> None:
        """A block that defines a cycle, or runs the active one again."""
        machine = self.machine
        self.flow.spend_again(len(given))
        values, words = assign(machine, cycle, code, given)
        head = head or Word(code, None, int(place_of(*self.program.span_of_block(self.flow.current)[:3])))
        if head.flag:
            refuse_marks(cycle, code, head)
        marks = {p.name: head for p in cycle.parameters() if head.flag & p.mark}
        values, words = values | dict.fromkeys(marks, 1.0), words | marks
        definition = Definition(cycle, code, values, words, head, program=machine.program, units=units_of(machine))
        again = machine.position_cycle
        if again and (again.cycle is cycle or (cycle.shares and again.cycle.shares)):  # what is modal holds
            modal = {p.name for p in cycle.parameters() if p.modal}
            values = {k: v for k, v in again.values.items() if k in modal} | values
            definition.extra = again.extra
        definition.values = cycle.prepare(values, words, machine, definition.extra)
        if self.control.storage == "variables" and cycle.in_variables:
            store(machine, definition)
        if cycle.runs == "definition":
            run_cycle(machine, definition)
            return
        machine.set_modal("cycle", cycle.code)
        if code != cycle.code:
            machine.warn(f"{code} is another name of {cycle.code} ({cycle.title})", head)
        if cycle.runs == "call":
            if self.control.storage == "variables":  # which may still change
                verify(definition)
            else:
                instance(definition)
            machine.cycle, machine.position_cycle = definition, None
            if machine.modal.get("call"):
                machine.set_modal("call", "")  # a new cycle ends the modal call of the old one
        else:
            machine.cycle, machine.position_cycle = None, definition
            run_cycle(machine, definition)
