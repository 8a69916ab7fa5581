"""The loop over blocks: words are handed out, each function takes its own, and what is left is an alarm.

What a block means depends on its keyword, its addresses, its G and M words, and on little of the machine's state: the
modal motion and an active cycle. So the handing out is *planned* once for each kind of block and kept; obeying a block
is then a walk through its plan, in the order of the control's phases.
"""

from __future__ import annotations

from difflib import get_close_matches
from typing import Any, NamedTuple

import numpy as np

from mnclab.machine.bulk import Bulk
from mnclab.machine.calls import Flow
from mnclab.machine.control import Control, Function, Words
from mnclab.machine.cycle import Cycle, Definition, Parameter, bind, fault
from mnclab.machine.machine import Machine
from mnclab.text.alarm import ALARM, Span
from mnclab.text.program import NONE, NUMBER, Program, Word, digits

WINDOW = 4096  # blocks whose words are held as lists


class Action(NamedTuple):
    """One part of a plan: a function or a cycle, the word that called it (or -1), and the words it takes."""

    phase: int
    what: Function | type[Cycle]
    code: str
    head: int
    takes: tuple[int, ...]


class Plan(NamedTuple):
    """What to do with a kind of block, in order, and remarks about it."""

    actions: tuple[Action, ...]
    remarks: tuple[tuple[int, str, str], ...]  # word, sentence, hint


class Stop(Exception):
    """The run stops at an alarm that the reader has already reported."""


class Interpreter:
    """Runs one program on one machine."""

    def __init__(self, control: Control, machine: Machine, program: Program) -> None:
        self.control, self.machine, self.program = control, machine, program
        self.phases = {name: k for k, name in enumerate(control.phases)}
        self.plans: dict[Any, Plan] = {}
        self.window, self.bounds = (0, 0), [0]
        self.lines: list[int] = []
        self.line_bounds: list[tuple[int, int]] = []
        self.rows: list[tuple[int, float, int, int, int, int]] = []
        self.faulty = self._faulty_blocks()
        self.bulk = Bulk(control, machine, program, self.faulty)
        machine.flow = Flow(program, self.obey, self.bulk.obey)
        machine.flow.machine = machine

    def _faulty_blocks(self) -> set[int]:
        """Blocks in which the reader found a fault: the run stops there."""
        found = set()
        for alarm in self.program.alarms:
            if alarm.severity == ALARM and alarm.span is not None:
                offset = int(self.program.line_starts[alarm.span.line - 1]) + alarm.span.column - 1
                found.add(max(int(np.searchsorted(self.program.start, offset, "right")) - 1, 0))
        return found

    def run(self) -> None:
        """From the first block to the end, or to the first alarm."""
        for group, code in self.control.power_on().items():
            self.machine.set_modal(group, code)
        if self.control.start:
            self.control.start(self.machine)
        self.machine.flow.section(0, len(self.program))
        if self.control.finish and not self.machine.ended:
            self.control.finish(self.machine)

    # --- one block -----------------------------------------------------------------------------------------------------

    def obey(self, index: int) -> None:
        """Obey one block."""
        machine, program = self.machine, self.program
        machine.step = machine.flow.begin(index)
        if not self.window[0] <= index < self.window[1]:
            self.open_window(index)
        machine.source_line = self.lines[index - self.window[0]]
        if program.skip[index] and machine.settings.get("block_skip"):
            return
        if index in self.faulty:
            raise Stop
        before = machine.programmed
        words = self.words_of(index)
        plan = self.plan_for(program.keywords[program.keyword[index]], words)
        for at, sentence, hint in plan.remarks:
            machine.warn(sentence, words[at], hint)
        for action in plan.actions:
            head = words[action.head] if action.head >= 0 else None
            given = tuple(words[k] for k in action.takes)
            if isinstance(action.what, Function):
                self.call(action.what, head, given)
            else:
                self.take_cycle(action.what, action.code, head, given)
        machine.end_block()
        if machine.programmed != before:
            machine.log("position", machine.programmed)

    def call(self, function: Function, head: Word | None, given: tuple[Word, ...]) -> None:
        """Let a function act on its words."""
        if function.group and function.modal:
            self.machine.set_modal(function.group, function.code)
        function.obey(self.machine, Words((head, *given) if head else given, function.code))

    def words_of(self, index: int) -> list[Word]:
        """The words of a block. Columns become lists for many blocks at a time: plain Python is faster on those."""
        program, at = self.program, index - self.window[0]
        a, b = self.bounds[at], self.bounds[at + 1]
        line = self.lines[at]
        begin, end = self.line_bounds[at]
        words = []
        for k in range(a, b):
            address, number, form, flag, offset, length = self.rows[k]
            value: Any = number
            span = Span(line, offset - begin + 1, length) if offset < end else program.span(offset, length)
            if form != NUMBER:
                value = None if form == NONE else program.payload[int(number)]
            words.append(Word(program.addresses[address], value, span, flag))
        return words

    def open_window(self, index: int) -> None:
        """Take the columns of the next blocks as lists."""
        program = self.program
        stop = min(index + WINDOW, len(program))
        a, b = int(program.first[index]), int(program.first[stop])
        columns = (program.address, program.value, program.form, program.flag, program.offset, program.length)
        self.rows = list(zip(*(column[a:b].tolist() for column in columns), strict=True))
        self.bounds = (program.first[index : stop + 1] - a).tolist()
        ends = np.append(program.line_starts, 1 << 30)
        lines = np.asarray(program.line_of(slice(index, stop)))
        self.lines = lines.tolist()
        self.line_bounds = list(zip(program.line_starts[lines - 1].tolist(), ends[lines].tolist(), strict=True))
        self.window = (index, stop)

    # --- planning ----------------------------------------------------------------------------------------------------

    def plan_for(self, keyword: str, words: list[Word]) -> Plan:
        """The plan for this kind of block, made when it is first met."""
        machine, codes = self.machine, self.control.codes
        active = machine.position_cycle.cycle if machine.position_cycle else None
        kinds = tuple([w[0] if w[0] not in codes else (w[0], w[1]) for w in words])
        key = (keyword, kinds, machine.modal.get(self.control.motion), active, machine.pole is None)
        plan = self.plans.get(key)
        if plan is None:
            plan = self.plans[key] = _Planner(self.control, machine, self.phases, keyword, words, active).plan()
        return plan

    # --- cycles --------------------------------------------------------------------------------------------------------

    def take_cycle(self, cycle: type[Cycle], code: str, head: Word | None, given: tuple[Word, ...]) -> None:
        """A block that defines a cycle, or runs the active one again."""
        machine = self.machine
        values, words = self.assign(cycle, code, given)
        head = head or Word(code, None, self.span_here())
        marks = {p.name: head for p in cycle.parameters() if head.flag & p.mark}
        values, words = values | dict.fromkeys(marks, 1.0), words | marks
        again = machine.position_cycle
        if again is not None and again.cycle is cycle:  # written again or not, what is modal holds
            modal = {p.name for p in cycle.parameters() if p.modal}
            values = {k: v for k, v in again.values.items() if k in modal} | values
            definition = Definition(cycle, code, values, words, head, again.extra)
        else:
            definition = Definition(cycle, code, values, words, head)
        definition.values = cycle.prepare(values, words, machine, definition.extra)
        if cycle.runs == "definition":
            self.execute(definition)
            return
        machine.set_modal("cycle", cycle.code)
        if code != cycle.code:
            machine.warn(f"{code} is another name of {cycle.code} ({cycle.title})", head)
        if cycle.runs == "call":
            verify(definition)
            machine.cycle, machine.position_cycle = definition, None
        else:
            machine.cycle, machine.position_cycle = None, definition
            self.execute(definition)

    def span_here(self) -> Span:
        """The place of the block being obeyed."""
        return self.program.span_of_block(self.machine.flow.current)

    def assign(self, cycle: type[Cycle], code: str, given: tuple[Word, ...]) -> tuple[dict[str, Any], dict[str, Word]]:
        """Values and words by parameter name; repeated addresses go to parameters in their order."""
        values: dict[str, Any] = {}
        words: dict[str, Word] = {}
        for word in given:
            parameter = next(p for p in cycle.parameters() if word.address in (p.address, *p.aliases) and p.name not in words)
            words[parameter.name] = word
            values[parameter.name] = self.value_of(parameter, code, word)
        return values, words

    def value_of(self, parameter: Parameter, code: str, word: Word) -> Any:
        """The number of a parameter; a word in place of a number only where it is allowed."""
        if isinstance(word.value, str) and parameter.type != "text":
            if word.value not in parameter.also:
                allowed = f"a number{', ' + ', '.join(parameter.also) if parameter.also else ''}"
                self.machine.alarm(f"{code} {parameter.address} ({parameter.meaning}) must be {allowed}, got {word.value}", word)
            return word.value
        if word.value is None or isinstance(word.value, str):
            return word.value
        value = self.machine.value(word)
        if self.control.storage == "variables":
            self.machine.variables[parameter.address] = value
        return value

    def execute(self, definition: Definition) -> None:
        """Bind a definition and make its moves."""
        run_cycle(self.machine, definition)


def verify(definition: Definition) -> None:
    """Range and presence of the parameters, where a cycle is defined."""
    for parameter in definition.cycle.parameters():
        value = definition.values.get(parameter.name)
        if isinstance(value, int | float) and parameter.refuses(value):
            raise fault(definition, parameter, f"must be {parameter.allowed}, got {value:g}")
        if value is None and parameter.required and definition.values.get(parameter.instead) is None:
            raise fault(definition, parameter, "is missing")


def run_cycle(machine: Machine, definition: Definition) -> None:
    """Bind a definition with the values as they stand now, check it, and make its moves."""
    if machine.control.storage == "variables":
        numbers = {
            p.name: machine.variables[p.address]
            for p in definition.cycle.parameters()
            if isinstance(definition.values.get(p.name), float) and p.address in machine.variables
        }
        definition = Definition(
            definition.cycle, definition.code, definition.values | numbers, definition.words, definition.head, definition.extra
        )
    label, machine.label = machine.label, f"{definition.cycle.code} {definition.cycle.title}"
    bind(definition, machine).moves(machine)
    machine.label = label


class _Planner:
    """Hands the words of one block out."""

    def __init__(
        self, control: Control, machine: Machine, phases: dict[str, int], keyword: str, words: list[Word],
        active: type[Cycle] | None,
    ) -> None:  # fmt: skip
        self.control, self.machine, self.phases, self.words, self.active = control, machine, phases, words, active
        self.keyword = keyword
        self.owner: list[str] = [""] * len(words)  # who takes a word
        self.actions: list[Action] = []
        self.remarks: list[tuple[int, str, str]] = []

    def alarm(self, message: str, index: int, hint: str = "") -> None:
        self.machine.alarm(message, self.words[index] if index >= 0 else None, hint)

    def plan(self) -> Plan:
        if self.control.together:
            self.control.together(self.machine, self.words)
        codes = self.codes()
        cycle = next(((c, i) for c, i in codes if c in self.control.cycles), None)
        if cycle:
            self.claim(self.control.cycles[cycle[0]], cycle[0], cycle[1])
            codes = [(c, i) for c, i in codes if i < 0 or self.owner[i] == ""]
            codes = [(c, i) for c, i in codes if i != cycle[1]]
            for code, index in codes:
                other = self.control.functions.get(code)
                if code in self.control.cycles or (other and other.ends_cycle):
                    self.alarm(f"{code} and {cycle[0]} are of one group: only one of it may stand in a block", index)
        functions = [(self.function(code, index), index) for code, index in codes]
        self.check_groups([f for f, _ in functions], [i for _, i in functions])
        for function, index in functions:
            if index >= 0:
                self.owner[index] = function.code
        for function, index in functions:
            if not function.moves:
                self.hand_out(function, index)
        ending = any(f.ends_cycle for f, _ in functions)
        if self.active and not cycle and not ending:
            self.claim_again([f for f, _ in functions if f.moves])
        for function, index in functions:
            if function.moves:
                self.hand_out(function, index)
        self.refuse_motion([f for f, _ in functions])
        self.word_functions()
        if self.control.one_command and self.actions:
            self.refuse_strangers(self.actions[0])
        self.modal_motion([f for f, _ in functions])
        self.refuse_leftovers([f for f, _ in functions])
        self.refuse_repeated()
        order = sorted(self.actions, key=lambda action: action.phase)
        return Plan(tuple(order), tuple(self.remarks))

    def codes(self) -> list[tuple[str, int]]:
        """The codes of a block: its keyword, and its G and M words."""
        found = [(self.keyword, -1)] if self.keyword else []
        for i, word in enumerate(self.words):
            if word.address in self.control.codes and type(word.value) is float:
                found.append((f"{word.address}{digits(word.value)}", i))
        return found

    def function(self, code: str, index: int) -> Function:
        found = self.control.functions.get(code)
        if found is None:
            if code in self.control.refused:
                self.alarm(f"{code} is refused: {self.control.refused[code]}", index)
            near = get_close_matches(code, [*self.control.functions, *self.control.cycles], 3, 0.6)
            self.alarm(f"{code} is not a function of this control", index, f"near: {', '.join(near)}" if near else "")
        assert found is not None
        return found

    def check_groups(self, functions: list[Function], indices: list[int]) -> None:
        seen: dict[str, Function] = {}
        for function, index in zip(functions, indices, strict=True):
            if function.group and function.group in seen:
                other = seen[function.group].code
                what = "is written twice" if other == function.code else f"and {other} are of one group"
                self.alarm(f"{function.code} {what}: only one function of a group may stand in a block", index)
            if function.group:
                seen[function.group] = function

    def claim(self, cycle: type[Cycle], code: str, index: int) -> None:
        """A cycle takes its addresses before any function sees them."""
        room: dict[str, int] = {}
        for parameter in cycle.parameters():
            for address in (parameter.address, *parameter.aliases):
                room[address] = room.get(address, 0) + 1
        taken = []
        for i, word in enumerate(self.words):
            if i != index and not self.owner[i] and room.get(word.address, 0):
                room[word.address] -= 1
                self.owner[i] = code
                taken.append(i)
        if index >= 0:
            self.owner[index] = code
        self.actions.append(Action(self.phases["motion"], cycle, code, index, tuple(taken)))

    def claim_again(self, moving: list[Function]) -> None:
        """An active cycle runs again where one of its trigger addresses stands."""
        assert self.active is not None
        if any(not owner and word.address in self.active.triggers for word, owner in zip(self.words, self.owner, strict=True)):
            self.claim(self.active, self.active.code, -1)
            action = self.actions.pop()
            self.actions.append(action._replace(head=-1))
            for function in moving:
                index = next(i for i, owner in enumerate(self.owner) if owner == function.code)
                sentence = f"{function.code} is kept for later: {self.active.code} is active and runs at this position"
                self.remarks.append((index, sentence, "write G80 first to end the cycle"))

    def hand_out(self, function: Function, index: int) -> None:
        taken = []
        for address in function.takes:
            several, address = address.endswith("*"), address.rstrip("*")
            for i, word in enumerate(self.words):
                if word.address != address or i == index:
                    continue
                if self.owner[i] and self.owner[i] != function.code:
                    if function.moves and self.owner[i] in self.control.cycles:
                        continue
                    if self.owner[i] in self.control.functions and word.address not in self.control.codes:
                        self.alarm(f"{self.owner[i]} and {function.code} both take {word}", i, "write them in two blocks")
                    continue
                if not self.owner[i]:
                    self.owner[i] = function.code
                    taken.append(i)
                    if not several:
                        break
        self.actions.append(Action(self.phases[function.phase], function, function.code, index, tuple(taken)))

    def word_functions(self) -> None:
        """F, S, T and the like: addresses that are functions by themselves."""
        for i, word in enumerate(self.words):
            if not self.owner[i] and word.address not in self.control.codes and word.address in self.control.functions:
                function = self.control.functions[word.address]
                if any(a.what is function for a in self.actions):
                    continue  # a second one is a repeated address
                self.owner[i] = function.code
                self.hand_out(function, i)

    def refuse_strangers(self, command: Action) -> None:
        """Where a block is one command: words that it does not take."""
        own = {command.head, *command.takes}
        for i, word in enumerate(self.words):
            if i in own:
                continue
            alike = sum(self.words[k].address == word.address for k in own)
            if alike:
                times = "once" if alike == 1 else f"{alike} times"
                self.alarm(f"{command.code} takes {word.address} {times}: {word} is one too many", i)
            what = command.what
            takes = what.takes if isinstance(what, Function) else [p.address for p in what.parameters() if not p.mark]
            whose = f", which takes {' '.join(takes).replace('*', '')}" if takes else ""
            self.alarm(f"{word} does not belong to the command {command.code}{whose}", i)

    def modal_motion(self, functions: list[Function]) -> None:
        """Axis words that are left belong to the modal motion."""
        code = self.machine.modal.get(self.control.motion)
        function = self.control.functions.get(code) if code else None
        if function is None or self.keyword or any(f.still or f.moves for f in functions):
            return
        if any(not owner and word.address in function.takes for word, owner in zip(self.words, self.owner, strict=True)):
            self.hand_out(function, -1)

    def refuse_motion(self, functions: list[Function]) -> None:
        """A function that moves nothing beside one that moves: words of the motion."""
        still = next((f.code for f in functions if f.still), None)
        moved = next((a.takes[0] for a in self.actions if a.takes and isinstance(a.what, Function) and a.what.moves), -1)
        if still and moved >= 0:
            word = self.words[moved]
            self.alarm(f"{still} stands in a block without motion, {word} does not belong to it", moved, "write two blocks")

    def refuse_leftovers(self, functions: list[Function]) -> None:
        still = next((f.code for f in functions if f.still), None)
        for i, word in enumerate(self.words):
            if self.owner[i] or any(w.address == word.address and self.owner[k] for k, w in enumerate(self.words)):
                continue
            code = f"{word.address}{digits(word.value)}" if type(word.value) is float else ""
            if code in self.control.refused:
                self.alarm(self.control.refused[code], i)
            if word.address in self.control.refused:
                self.alarm(f"{word.address} is refused: {self.control.refused[word.address]}", i)
            if still and word.address in self.control.axes:
                self.alarm(f"{still} stands in a block without motion, {word} does not belong to it", i, "write two blocks")
            actors = " ".join(dict.fromkeys(a.code for a in self.actions if a.phase == self.phases["motion"]))
            self.alarm(f"{word} has no meaning in this block" + (f" ({actors} does not take {word.address})" if actors else ""), i)

    def refuse_repeated(self) -> None:
        for i, word in enumerate(self.words):
            if not self.owner[i]:
                self.alarm(f"{word.address} is written twice in this block", i, "keep one of them")
