"""The course of a program: sections, labels, jumps, repeats, subprograms, other programs; and its loops."""

from __future__ import annotations

from array import array
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.frames import Matrix
from mnclab.machine.flow import Recording
from mnclab.machine.state import COMPARED, REPEAT
from mnclab.running.recording import record, set_aside
from mnclab.text.alarm import Alarm, Span
from mnclab.text.expression import Expression
from mnclab.text.program import Program
from mnclab.text.tables import shapes

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


# Loops of a program: which ones a block stands in, and whether a jump back is made for ever.
# A jump back that is made once more under the same calls and repeats leads the same way again if nothing that was asked on
# the way can have changed: no variable that a condition or the name of a label reads was written since, or all variables have
# the values that they had then, and none was taken from the state of the machine. Such a loop has no end, and is an alarm at
# once. So is one that has run long while all its comparisons moved away, evenly, from being decided otherwise: a counter that
# runs the wrong way. Whether others end, nobody can say: they run up to a limit.

SHOWN, WIDTH = 3, 60  # loops around a block that an alarm names, characters of each
ROUNDS = 10_000  # after which a loop that runs the wrong way is no more believed to turn round
EVEN = 1e-9  # of the difference: what computing leaves uneven
UNKNOWN = ""  # what a decision reads beside variables with numbers


@dataclass
class Loop:
    """A call or a repeat that runs, by the block of a program that says so; `times` 0 for a call.

    `begun` is the step at which it, or its pass `done`, began.
    """

    program: int
    block: int
    times: int
    begun: int
    done: int = 0


@dataclass
class _Seen:
    """A jump back as it was made before: at which step, within which passes; how often; the variables at step `kept`."""

    step: int
    passes: tuple[int, ...]
    values: dict[str, Any]
    kept: int
    count: int = 1
    next_kept: int = 2


@dataclass
class _Comparison:
    """The difference of what a jump compares, at a step; for how many rounds it has evenly grown, by `growth`."""

    step: int
    difference: float
    growth: float = 0.0
    rounds: int = 0


@dataclass
class Loops:
    """The loops that run, the outermost first, and what decides how they go on."""

    running: list[Loop] = field(default_factory=list)
    asked: dict[str, int] = field(default_factory=dict)  # variable: the step at which a decision read it last
    seen: dict[tuple[int, int, int], _Seen] = field(default_factory=dict)  # program, block and target of a jump back
    compared: dict[tuple[int, int], _Comparison] = field(default_factory=dict)  # by program and block
    otherwise: int = -1  # the step of the last decision that read a variable and compared nothing

    def ask(self, step: int, values: Iterable[Any]) -> None:
        for value in values:
            if isinstance(value, Expression):
                self.asked.update((token.text, step) for token in value.tokens if token.kind == "variable")
                self.otherwise = step
            elif not isinstance(value, int | float | str):
                self.asked[UNKNOWN] = self.otherwise = step

    def compare(self, step: int, place: tuple[int, int], values: tuple[Any, Any], difference: float) -> None:
        """A decision in a block of a program (its place) compares the values of two words."""
        before = self.otherwise
        self.ask(step, values)
        if self.otherwise == before:  # two numbers
            return
        self.otherwise = before
        last = self.compared.get(place)
        now = self.compared[place] = _Comparison(step, difference)
        if last is not None:
            now.growth = difference - last.difference
            even = abs(now.growth - last.growth) <= EVEN * max(1.0, abs(difference))
            now.rounds = last.rounds + 1 if even and now.growth * difference > 0 else 0

    def asked_since(self, step: int) -> list[str]:
        return [name for name, last in self.asked.items() if last > step]

    def back(self, m: Machine, key: tuple[int, int, int], span: Span) -> None:
        """A jump back (program, block, target) is made: an Alarm if it is made for ever."""
        passes, seen = tuple(loop.begun for loop in self.running), self.seen.get(key)
        if seen is None or seen.passes != passes:
            self.seen[key] = _Seen(m.step, passes, dict(m.variables), m.step)
            return
        if self._decided(m, seen.step) or (seen.values == m.variables and m.variables.state_read <= seen.kept):
            why = "nothing that decides where it goes on changes from one round to the next"
            hint = "change in the loop what its condition reads, or repeat it with a count"
            raise Alarm(f"the program never gets out of this loop: {why}", span, hint=hint)
        if seen.count >= ROUNDS and self._runs_away(seen.step):
            why = f"in {seen.count} rounds its conditions moved away from being met otherwise"
            hint = "the count runs the wrong way, or the condition asks for the opposite"
            raise Alarm(f"the program does not get out of this loop: {why}", span, hint=hint)
        seen.step, seen.count = m.step, seen.count + 1
        if seen.count == seen.next_kept:  # ever further apart: values that come again after many rounds are found, too
            seen.values, seen.kept, seen.next_kept = dict(m.variables), m.step, 2 * seen.count

    def _runs_away(self, step: int) -> bool:
        """Whether all that was decided after a step was compared, and moves away from being decided otherwise."""
        latest = [one for one in self.compared.values() if one.step > step]
        return self.otherwise <= step and bool(latest) and all(one.rounds >= ROUNDS - 2 for one in latest)

    def _decided(self, m: Machine, step: int) -> bool:
        """Whether nothing that was asked after a step was written after it."""
        for name in self.asked_since(step):
            log = m.logs.by_name.get(name)
            if name == UNKNOWN or name in m.control.preassigned or (log and log.steps and log.steps[-1] > step):
                return False
        return True

    def told(self, programs: Sequence[Program]) -> str:
        """The loops around the block that runs, the innermost first, to be said after a sentence."""
        found = [(loop.program, loop.block, loop.done, loop.times) for loop in reversed(self.running[-SHOWN:])]
        if not found and self.seen:
            (index, at, _), seen = max(self.seen.items(), key=lambda item: item[1].count)
            found = [(index, at, seen.count, 0)]
        said = []
        for index, block, done, times in found:
            program = programs[index]
            line = int(program.line_of(block))
            count = f", pass {done} of {times}" if times else f", made {done} times" if done else ""
            said.append(f"{program.line_text(line).strip()[:WIDTH]} in line {line}{count}")
        return f"; in {', in '.join(said)}" if said else ""


# The course of a program: sections, labels, jumps, repeats, subprograms, other programs.
# A *step* is one execution of a block. A section of blocks is run by a plain loop; a call of a label or of another program
# is a section run inside another; a jump goes on elsewhere in the same section. Functions steer with its
# methods `call`, `call_program`, `jump`, `repeat` and `leave`.

DEEPEST = 20  # nested calls
CERTAIN = 4  # times the limit of blocks: more than what passes along the same way may differ by
LEFT, RECORDED = -1, -1  # in the log of what is entered: the block that means leaving, the times of a recorded contour
ROWS_A_BLOCK = 20  # of the text, beside the rows that the setting most_rows allows


class Steps(NamedTuple):
    """Which block and which program each step executed (s,)."""

    block: NDArray[np.int32]
    program: NDArray[np.int16]

    def __repr__(self) -> str:
        return shapes(self)


def course(m: Machine) -> Course:
    """The course of a machine: on this floor it is known which one that is."""
    assert isinstance(m.flow, Course)
    return m.flow


def _nothing(*blocks: int) -> int:
    """Where nobody listens, and where no blocks are obeyed at once."""
    return 0


class Course:
    """Where the program is: the running section, the depth of calls, the log of steps.

    `programs` are the main program and those it has called, each once. `obey` obeys a block, `bulk` as many as it can of
    the blocks from one on; `switch` is called with the index of a program when blocks are to be those of it.
    """

    def __init__(
        self, program: Program, obey: Callable[[int], Any] = _nothing, switch: Callable[[int], Any] = _nothing
    ) -> None:
        self.programs, self.obey, self.switch = [program], obey, switch
        self.bulk: Callable[[int, int], int] = _nothing
        self.spent = 0  # of the limit, by blocks that take as long as many
        self.depth, self.calls = 0, 0  # calls: subprograms alone, without repeats
        self.most, self.limit = 0, len(program)  # blocks that repeats and calls may add, one by one; all in all
        self.in_bulk = 0  # steps obeyed in bulk do not count for it: they end by themselves
        self.watched: Callable[[int], Any] = _nothing  # hears now and then how many steps were begun
        self.returning = self.over = False  # the subprogram, the called program ends
        self.target = -1  # block to go on at, after a jump
        self.found: dict[tuple[str, str], int] = {}  # indices of programs by folder of the caller, and name
        self.running = [0]  # the main program and those called, the innermost last
        self.current = 0  # block being obeyed
        self.loops = Loops()
        self.nesting = array("q")  # what was entered and left: step, program and block that entered it (-1: left), times
        self._chunks: list[tuple[int, NDArray[np.int64] | range]] = []  # program, blocks
        self._blocks: list[int] = []
        self._counted = 0

    def standing(self) -> tuple[object, ...]:
        """Where the program stands; the same before and after what neither calls, jumps nor finds a program."""
        entered = len(self.nesting)
        return self.depth, self.calls, self.returning, self.over, self.target, entered, *self.running, *self.found

    @property
    def program(self) -> Program:
        return self.programs[self.running[-1]]

    @property
    def entered_from(self) -> int | None:
        """The block of the main program from which what runs now was called, repeated or recorded; None: it runs itself."""
        entries = np.frombuffer(self.nesting, np.int64).reshape(-1, 3)[:, 1]
        depth = np.where(entries == LEFT, -1, 1).cumsum()
        if not len(depth) or not depth[-1]:
            return None
        outermost = int(np.flatnonzero(depth == 0)[-1]) + 1 if (depth == 0).any() else 0
        return int(entries[outermost]) & 0xFFFFFFFF

    # --- running -----------------------------------------------------------------------------------------------------

    def section(self, m: Machine, first: int, stop: int, least: int = 0) -> None:
        """Run the blocks [first, stop) of the running program; a jump to one outside [least, stop) ends the section."""
        block = first
        while block < stop and not (m.ended or self.over):
            done = self.bulk(block, stop)
            if not done:
                self.current, done = block, 1
                self.obey(block)
            if self.returning:
                return
            block += done
            if self.target >= 0:
                if not least <= self.target < stop:
                    return
                block, self.target = self.target, -1

    def call(self, m: Machine, label: str, span: Span | None = None) -> None:
        here = self.enter(span).block
        self.calls += 1
        self.section(m, self.index_of(label, span) + 1, len(self.program))
        self.calls -= 1
        self.returning = False
        self.go_back(here)

    def call_program(self, m: Machine, index: int, span: Span | None = None) -> None:
        """Run another program, from its first block to its end; its rows have no label of a cycle that called it."""
        if index in self.running:
            name = self.programs[index].name
            raise Alarm(f"{name} is running already: a program cannot call itself, nor one that calls it", span)
        here, kept = self.enter(span).block, (self.calls, m.source_line, m.label)
        self.calls, m.label = 0, ""
        with self.inside(m, index):
            self.section(m, 0, len(self.program))
        self.calls, m.source_line, m.label = kept
        self.over = False
        self.go_back(here)

    def record(
        self, m: Machine, name: str, span: Span | None = None, after: Recording | None = None,
        blocks: Callable[[], None] | None = None, within: Matrix | None = None, in_space: bool = False,
    ) -> Recording:  # fmt: skip
        if blocks is not None:
            return record(m, self, name, blocks, span, after, within, in_space)
        place = span or self.span_of_block(self.index_of(name))
        return record(m, self, f"label {name}", partial(self.call, m, name, span), place, after, within, in_space)

    @contextmanager
    def aside(self, m: Machine, in_space: bool = False) -> Iterator[None]:
        step = m.step
        self.nesting.extend((self.begun, self.running[-1] << 32 | self.current, RECORDED))
        with set_aside(m, in_space):
            yield
        self.nesting.extend((self.begun, LEFT, 0))
        m.step = step  # what follows belongs to the block that asked; after an alarm the place stays where it happened

    @contextmanager
    def inside(self, m: Machine, index: int) -> Iterator[None]:
        if index == self.running[-1]:
            yield
            return
        self._flush()
        self.running.append(index)
        self._change_program(m)
        yield  # after an alarm the place stays where it happened: the run is over
        self._flush()
        self.running.pop()
        self._change_program(m)

    def _change_program(self, m: Machine) -> None:
        m.put(program=self.running[-1])
        self.switch(m.program)

    def add(self, m: Machine, program: Program) -> int:
        """Another program that may be called; its index."""
        self.programs.append(program)
        self.limit += len(program)
        m.recorder.most = self.most_rows(m)
        return len(self.programs) - 1

    def said(self, alarm: Alarm) -> Alarm:
        """An alarm in the words of the program that it is about."""
        program = self.programs[alarm.span.program if alarm.span else 0]
        return program.said(alarm, program) if program.said else alarm

    @property
    def called(self) -> bool:
        return len(self.running) > 1

    def end_program(self) -> None:
        self.over = True

    def jump(self, m: Machine, label: str, span: Span | None = None) -> None:
        self.target = self.index_of(label, span)
        if self.target <= self.current:
            self.loops.back(m, (self.running[-1], self.current, self.target), span or self.span_of_block(self.current))

    def ask(self, *values: Any) -> None:
        self.loops.ask(self.begun - 1, values)

    def ask_whether(self, variable: str) -> None:
        self.loops.asked[variable] = self.loops.otherwise = self.begun - 1

    def compare(self, one: Any, other: Any, difference: float) -> None:
        self.loops.compare(self.begun - 1, (self.running[-1], self.current), (one, other), difference)

    def repeat(self, m: Machine, first: int, stop: int, times: int, span: Span | None = None) -> None:
        """Run the blocks [first, stop) a number of times more; a jump out of them ends that."""
        loop, recorder, before = self.enter(span, times), m.recorder, None
        for loop.done in range(1, times + 1):
            loop.begun, begin, made = self.begun - 1, self.begun - self.in_bulk, recorder.made
            self.section(m, first, stop, least=first)
            if self.returning or self.over or self.target >= 0 or m.ended:
                break
            if loop.done > 2:
                continue
            blocks = (self.begun - self.in_bulk - begin) * times
            rows = made + (recorder.made - made) * (times - loop.done)
            if blocks > CERTAIN * self.limit and not self.loops.asked_since(loop.begun):
                self._too_long(loop.block)
            if rows > recorder.most:  # and will be, if this pass was like the one before
                now = m.snapshot(COMPARED[REPEAT])
                if before == now:
                    self.current = loop.block
                    self.too_many_rows(m, rows)
                before = now
        self.go_back(loop.block)

    def enter(self, span: Span | None, times: int = 0) -> Loop:
        """Go one call or repeat deeper."""
        if self.depth >= DEEPEST:
            raise Alarm(f"calls are nested deeper than {DEEPEST}", span or self.span_of_step(self.begun - 1))
        self.depth += 1
        self.loops.running.append(Loop(self.running[-1], self.current, times, self.begun - 1))
        self.nesting.extend((self.begun, self.running[-1] << 32 | self.current, times))
        return self.loops.running[-1]

    def go_back(self, block: int) -> None:
        """Be again where the last call or repeat was entered."""
        self.loops.running.pop()
        self.nesting.extend((self.begun, LEFT, 0))
        self.depth, self.current = self.depth - 1, block

    def leave(self) -> None:
        self.returning = self.calls > 0

    def index_of(self, label: str, span: Span | None = None) -> int:
        if label not in self.program.labels:
            known = ", ".join(list(self.program.labels)[:8])
            hint = f"labels of this program: {known}" if known else "this program has no labels"
            raise Alarm(f"label {label} does not exist", span or self.span_of_step(self.begun - 1), hint=hint)
        return self.program.labels[label]

    # --- steps -------------------------------------------------------------------------------------------------------

    def span_of_block(self, block: int) -> Span:
        return self.program.span_of_block(block)._replace(program=self.running[-1])

    @property
    def begun(self) -> int:
        """How many blocks were executed so far."""
        return self._counted + len(self._blocks)

    def begin(self, block: int) -> int:
        """Note the execution of a block; the number of its step."""
        blocks = self._blocks
        step = self._counted + len(blocks)
        if step - self.in_bulk >= self.limit:
            self._too_long(block)
        if not step & 1023:
            self.watched(step)
        blocks.append(block)
        return step

    def spend(self, work: int) -> None:
        """Count a block as so many more of the limit: it takes as long as they do."""
        self.limit, self.spent = self.limit - work, self.spent + work

    def allow(self, blocks: int) -> None:
        """Let repeats and calls add so many blocks to those of the text."""
        self.most, self.limit = blocks, self.limit + blocks

    def spend_again(self, work: int) -> None:
        """Count a block as so many more, if more were obeyed than the text has: what stands there once is no loop."""
        if self.begun > sum(map(len, self.programs)):
            self.spend(work)

    def _too_long(self, block: int) -> NoReturn:
        """Stop at a block: there are too many to obey."""
        work = f"{self.most} blocks" if self.spent < self.most // 10 else f"as much work as {self.most} blocks"
        message = f"jumps, repeats and calls ran {work} without an end{self.loops.told(self.programs)}"
        raise Alarm(message, self.span_of_block(block), hint="if they do end: the setting most_blocks allows more")

    def most_rows(self, m: Machine) -> int:
        """How many rows a run may have."""
        blocks = sum(len(program) for program in self.programs)
        return int(m.settings["most_rows"]) + ROWS_A_BLOCK * blocks

    def too_many_rows(self, m: Machine, count: int) -> NoReturn:
        """Stop where the path would have so many rows."""
        allowed = (
            f"the setting most_rows ({int(m.settings['most_rows'])}) and {ROWS_A_BLOCK} for each block of the text"
        )
        message = f"the path would have {count} rows, more than {allowed} allow{self.loops.told(self.programs)}"
        raise Alarm(message, self.span_of_block(self.current))

    def begin_many(self, m: Machine, first: int, count: int) -> int:
        """Note the execution of blocks in a row; the number of the first step."""
        if self.begun + count > self.most_rows(m) + self.limit:  # that move nothing
            self._too_long(first)
        self._flush()
        self.watched(self._counted)
        self._chunks.append((self.running[-1], range(first, first + count)))
        self._counted += count
        self.in_bulk += count
        return self._counted - count

    def _flush(self) -> None:
        if self._blocks:
            self._chunks.append((self.running[-1], np.array(self._blocks, dtype=np.int64)))
            self._counted += len(self._blocks)
            self._blocks = []

    def steps(self) -> Steps:
        self._flush()
        blocks, programs = np.empty(self._counted, dtype=np.int32), np.zeros(self._counted, dtype=np.int16)
        at = 0
        for program, chunk in self._chunks:
            part = np.arange(chunk.start, chunk.stop) if isinstance(chunk, range) else chunk
            blocks[at : at + len(part)] = part
            programs[at : at + len(part)] = program
            at += len(part)
        alone = len(self.programs) == 1  # a constant column costs nothing
        return Steps(blocks, np.broadcast_to(np.int16(0), (len(blocks),)) if alone else programs)

    def span_of_step(self, step: int) -> Span | None:
        if step < 0:
            return None
        self._flush()
        for program, chunk in self._chunks:
            if step < len(chunk):
                return self.programs[program].span_of_block(int(chunk[step]))._replace(program=program)
            step -= len(chunk)
        return None
