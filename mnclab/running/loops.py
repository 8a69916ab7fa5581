"""Loops of a program: which ones a block stands in, and whether a jump back is made for ever.

A jump back that is made once more under the same calls and repeats leads the same way again if nothing that was asked on
the way can have changed: no variable that a condition or the name of a label reads was written since, or all variables have
the values that they had then, and none was taken from the state of the machine. Such a loop has no end, and is an alarm at
once. So is one that has run long while all its comparisons moved away, evenly, from being decided otherwise: a counter that
runs the wrong way. Whether others end, nobody can say: they run up to a limit.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from mnclab.text.alarm import Alarm, Span
from mnclab.text.expression import Expression
from mnclab.text.program import Program

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

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
