"""What is wrong in the blocks that a stopped run never came to, as far as reading tells it: so that all is mended in one go.

A run stops at its first alarm, as the control would. The blocks below are then judged by their words alone: functions that
do not exist, words that nobody takes, parameters of cycles beyond their range or missing, numbers of F, S and T, labels. What
would be right in some state of the machine is no fault here, and where a block may lead away nothing below it is judged. One
fault, one alarm: of what a block that was not understood may have given (a label, a turning spindle) nothing is said.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from typing import Any

from mnclab.machine.control import Function, Modal, Words
from mnclab.machine.cycle import Cycle, Definition, Parameter
from mnclab.machine.machine import Machine
from mnclab.running.cycles import check_value, fault, value_of
from mnclab.running.dispatch import BlockPlan, Planner
from mnclab.running.flow import Course
from mnclab.running.interpreter import Interpreter
from mnclab.runs.lint.forgotten import HINT, SENTENCE
from mnclab.text.alarm import WARNING, Alarm, Span
from mnclab.text.expression import Expression
from mnclab.text.program import Word, blocks_with

MOST = 5000  # blocks that are judged
#: Functions that judge their numbers whatever the machine does; arcs only do so where nothing gives them a shape.
ALWAYS, TOOLS, ARCS, SHAPES = ("F", "S", "G4"), ("T", "TOOL CALL"), ("G2", "G3", "CR"), frozenset("IJKR")
WRITE_TOOLS = ("TOOL DEF", "G10", "FN 17")
CALL_OTHERS = ("CALL PGM", "CALL SELECTED PGM", "M98", "G65", "G66", "CYCL DEF 12")
STRAIGHT = ("G1", "G2", "G3", "L", "C", "CR", "CT", "LP", "CP", "CTP")


class Ahead:
    """The blocks of the main program that a stopped run would have come to next."""

    def __init__(self, stopped: Interpreter) -> None:
        self.control, self.program, self.skips = stopped.control, stopped.flow.programs[0], stopped.skips
        self.faulty, self.good = stopped.loaded[0].faulty, dict[Any, BlockPlan]()
        self.bad: dict[Any, tuple[Alarm, list[Word]]] = {}
        self.in_inches = stopped.machine.variable_unit != 1
        self.states = list(self._states(stopped))
        self.sections, self.stop = self._sections(stopped.flow)
        self.scratch = Machine(self.control, stopped.machine.setup, Course(self.program))
        for group, code in self.control.power_on().items():
            self.scratch.set_modal(group, code)
        if self.control.start:
            self.control.start(self.scratch)
        self.scratch.feed = 100.0  # that an arc without a shape is judged, not its feed
        self.judges = {*ALWAYS, *(() if blocks_with(self.program, WRITE_TOOLS).any() else TOOLS)}

    def _states(self, stopped: Interpreter) -> Iterator[Modal]:
        """The states that the handing out of words may depend on, that of the machine first."""
        m, functions = stopped.machine, self.control.functions.values()
        motions = [m.modal.get(self.control.motion), *(f.code for f in functions if f.group == self.control.motion and f.modal)]
        calls = [m.modal.get("call"), *(f.code for f in functions if f.group == "call" and f.modal), None]
        cycles = {code: cycle for code, cycle in self.control.cycles.items() if cycle.runs == "position"}
        actives = [m.position_cycle and m.position_cycle.cycle, None, *cycles.values()]
        polar = m.pole is not None
        for motion, call, pole, active in product(dict.fromkeys(motions), dict.fromkeys(calls), (polar, not polar), actives):
            yield Modal(motion, call, pole, active, *stopped.chosen)

    def _sections(self, flow: Course) -> tuple[list[int], int]:
        """Where the blocks begin that come next: the rest of a running sub-program, then what stands below its call.

        And the block where the run stopped, or in the course of which it did.
        """
        at, here = flow.entered_from, flow.running == [0]
        below = flow.current if at is None else at
        inside = here and any(loop.program == 0 for loop in flow.loops.running)
        return [*([flow.current + 1] if inside else []), below + 1], flow.current if here else below

    def blocks(self) -> Iterator[tuple[int, str, list[Word], BlockPlan | Alarm]]:
        """The blocks that the program comes to, with the labels that they call, each once."""
        seen, count, program = set[int](), 0, self.program
        while self.sections:
            block = self.sections.pop(0)
            while block < len(program) and block not in seen and (count := count + 1) <= MOST:
                seen.add(block)
                if block not in self.faulty and not (program.skip[block] and int(program.skip[block]) in self.skips):
                    keyword = program.keywords[program.keyword[block]]
                    words = [program.word(k) for k in range(program.first[block], program.first[block + 1])]
                    plan = self.plan(keyword, words)
                    yield block, keyword, words, plan
                    if self.leads_away(keyword, words, plan):
                        break
                block += 1

    def leads_away(self, keyword: str, words: list[Word], plan: BlockPlan | Alarm) -> bool:
        """Whether nobody knows what comes after a block; a label that it calls is noted."""
        name = label_of(words)
        if keyword == "CALL LBL" and name in self.program.labels and len(words) == 1:
            self.sections.append(self.program.labels[name] + 1)
        functions = [action.what for action, _ in plan.actions] if isinstance(plan, BlockPlan) else []
        return name == "0" or any(isinstance(what, Function) and what.leads_away for what in functions)

    def plan(self, keyword: str, words: list[Word]) -> BlockPlan | Alarm:
        """Who takes the words of a block, or the fault that it has in every state of the machine."""
        if not keyword and self.control.computed and any(isinstance(word.value, Expression) for word in words):
            return BlockPlan((), ())
        kind = keyword, tuple((w[0], w[1]) if w[0] in self.control.codes else w[0] for w in words)
        if kind in self.good:
            return self.good[kind]
        same_words = keyword, tuple((word.address, repr(word.value)) for word in words)
        if same_words in self.bad:  # a faulty block that stands there again and again
            alarm, before = self.bad[same_words]
            spans = {word.span: again.span for word, again in zip(before, words)}
            return alarm.changed(span=spans.get(alarm.span) if alarm.span else None)
        found = self._planned(kind, keyword, words)
        if isinstance(found, Alarm):
            self.bad[same_words] = found, words
        return found

    def _planned(self, kind: Any, keyword: str, words: list[Word]) -> BlockPlan | Alarm:
        """As `plan`, of a block that was not looked at before: in one state of the machine after the other."""
        told: list[Alarm] = []
        for state in self.states:
            try:
                return self.good.setdefault(kind, Planner(self.control, state, keyword, words).plan())
            except Alarm as alarm:
                told.append(alarm)
        same = {alarm.message for alarm in told}
        return told[0] if len(same) == 1 else told[0].changed(message=told[0].message.partition(" (")[0])

    def faults(self) -> Iterator[Alarm]:
        """The alarms below, and a warning where a cut comes and nothing in the program turns the spindle."""
        cuts: Span | None = None
        understood = not any(map(self.may_turn, {*self.faulty, self.stop}))
        for block, keyword, words, plan in self.blocks():
            place = self.program.span_of_block(block)
            if isinstance(plan, Alarm):
                found, understood = [plan], understood and not self.may_turn(block)
            else:
                found = [*self.of_actions(plan, keyword, words), *self.of_label(keyword, words)]
            for alarm in found:
                yield alarm.changed(span=alarm.span or place)
            codes = {keyword, *(f"{word.address}{word.value:g}" for word in words if type(word.value) is float)}
            feeds = not keyword or any(word.address == "F" and type(word.value) is float for word in words)
            cuts = cuts or (place if feeds and not codes.isdisjoint(STRAIGHT) else None)
        if cuts and understood and self.nothing_turns():
            yield Alarm(SENTENCE, cuts, WARNING, HINT)

    def may_turn(self, block: int) -> bool:
        """Whether a block that is not understood may have been meant to turn the spindle."""
        return "M" in self.program.line_text(self.program.span_of_block(block).line).upper()

    def nothing_turns(self) -> bool:
        """Whether no block of the program turns the spindle, itself, by a cycle, or by another program."""
        settings, cycles = self.scratch.settings, self.control.cycles
        said = settings["lint"] == "off" or settings["stopped_spindle"] == "accept" or self.scratch.modal.get("spindle") != "M5"
        turns = {f.code for f in self.control.functions.values() if f.group == "spindle" and f.code != "M5"}
        turns |= {code for code, cycle in cycles.items() if cycle.own_spindle} | {*CALL_OTHERS}
        return not said and not blocks_with(self.program, turns).any()

    # --- one block ----------------------------------------------------------------------------------------------------

    def of_actions(self, plan: BlockPlan, keyword: str, words: list[Word]) -> Iterator[Alarm]:
        for (_, what, code, head, _), pick in plan.actions:
            if isinstance(what, Function):
                yield from self.of_function(what, code, pick(words), head >= 0 or code == keyword)
            else:
                yield from self.of_cycle(what, code, words[head] if head >= 0 else None, pick(words))

    def of_function(self, what: Function, code: str, words: tuple[Word, ...], written: bool) -> Iterator[Alarm]:
        """What a function says of its numbers, on a machine of its own.

        An arc that stands in no word of the block is none for certain: a block above may have begun straight lines.
        """
        bare = written and code in ARCS and what.group == "motion" and SHAPES.isdisjoint(word.address for word in words)
        known = all(isinstance(word.value, float | None) or word.address == "axis" for word in words)
        if not known or not (bare or code in self.judges):
            return
        before = len(self.scratch.alarms)
        try:
            what.obey(self.scratch, Words(words, code))
        except Alarm as alarm:
            yield alarm
        if bare:
            yield from self.scratch.alarms[before:]

    def of_cycle(self, cycle: type[Cycle], code: str, head: Word | None, words: tuple[Word, ...]) -> Iterator[Alarm]:
        """The parameters of a cycle that are out of their range or missing, whatever was programmed before."""
        values: dict[str, Any] = {}
        given: dict[str, Word] = {}
        definition = Definition(cycle, code, values, given, head)
        for word in words:
            fitting = (p for p in cycle.parameters() if word.address in (p.address, *p.aliases) and p.name not in given)
            parameter = next(fitting, None)
            if parameter is None:
                return  # one of several of an address
            given[parameter.name] = word
            if type(word.value) is float:
                values[parameter.name] = word.value
            elif isinstance(word.value, str) and word.value != "PREDEF" and not stands(word.value, parameter.also):
                try:
                    value_of(self.scratch, parameter, code, word)
                except Alarm as alarm:
                    yield alarm
                    return
        try:
            prepared = cycle.prepare(dict(values), given, self.scratch, {}) if len(values) == len(given) else values
        except Alarm:
            return
        for parameter in cycle.parameters():
            value = values.get(parameter.name)
            try:
                if value is not None and prepared.get(parameter.name) == value:  # no level that counts from another
                    check_value(definition, parameter, value / self.read_as(parameter))
                kept = parameter.name in given or parameter.name in prepared or parameter.instead or cycle.runs == "position"
                if parameter.required and not kept and not cycle.shares:
                    raise fault(definition, parameter, "is missing")
            except Alarm as alarm:
                yield alarm
                return

    def read_as(self, parameter: Parameter) -> float:
        """What the reader has made of 1: where cycles live in variables it turns lengths that are none into mm."""
        in_words = self.control.storage == "variables" and not parameter.is_variable
        lengths = parameter.in_units and parameter.unit != "mm/min"
        return 25.4 if in_words and lengths and self.in_inches else 1.0

    def of_label(self, keyword: str, words: list[Word]) -> Iterator[Alarm]:
        """A label that is called and does not exist; not where a fault may hide it."""
        name = label_of(words)
        if keyword == "CALL LBL" and name not in ("", "0") and not self.faulty:
            try:
                self.scratch.flow.index_of(name, words[0].span)
            except Alarm as alarm:
                yield alarm


def stands(text: str, also: tuple[str, ...]) -> bool:
    """Whether a word may stand in place of a number."""
    return text.rstrip("0123456789.") in also


def label_of(words: list[Word]) -> str:
    """How the program lists the label that a block names; empty where it names none, or a variable does."""
    value = next((word.value for word in words if word.address == "label"), None)
    return f"{value:g}" if isinstance(value, float) else f'"{value}"' if isinstance(value, str) else ""


def faults_ahead(stopped: Interpreter) -> list[Alarm]:
    """The alarms in the main program below where a run has stopped."""
    if not len(stopped.flow.programs[0]):
        return []
    try:
        ahead = Ahead(stopped)
    except Alarm:  # the control does not start on this machine: that is what stopped the run
        return []
    return [*ahead.faults()]
