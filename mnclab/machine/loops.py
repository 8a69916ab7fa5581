"""Loops of a program: which ones a block stands in, and whether a jump back is made for ever.

A jump back that is made once more under the same calls and repeats leads the same way again if nothing that was asked on
the way can have changed: no variable that a condition or the name of a label reads was written since, or all variables have
the values that they had then, and none was taken from the state of the machine. Such a loop has no end, and is an alarm at
once. Whether others end, nobody can say: they run up to a limit.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from mnclab.text.alarm import Alarm, Span
from mnclab.text.expression import Expression

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

SHOWN, WIDTH = 3, 60  # loops around a block that an alarm names, characters of each
UNKNOWN = ""  # what a decision reads beside variables with numbers


@dataclass
class Loop:
    """A call or a repeat that runs, by the block of a program that says so; ``times`` 0 for a call.

    ``begun`` is the step at which it, or its pass ``done``, began.
    """

    program: int
    block: int
    times: int
    begun: int
    done: int = 0


@dataclass
class _Seen:
    """A jump back as it was made before: at which step, within which passes; how often; the variables at step ``kept``."""

    step: int
    passes: tuple[int, ...]
    values: dict[str, Any]
    kept: int
    count: int = 1
    next_kept: int = 2


@dataclass
class Loops:
    """The loops that run, the outermost first, and what decides how they go on."""

    running: list[Loop] = field(default_factory=list)
    asked: dict[str, int] = field(default_factory=dict)  # variable: the step at which a decision read it last
    seen: dict[tuple[int, int, int], _Seen] = field(default_factory=dict)  # program, block and target of a jump back

    def ask(self, step: int, values: Iterable[Any]) -> None:
        """A decision where to go reads these values of words."""
        for value in values:
            if isinstance(value, Expression):
                self.asked.update((token.text, step) for token in value.tokens if token.kind == "variable")
            elif not isinstance(value, int | float | str):
                self.asked[UNKNOWN] = step

    def asked_since(self, step: int) -> list[str]:
        """The variables that decided something after a step."""
        return [name for name, last in self.asked.items() if last > step]

    def back(self, m: Machine, target: int, span: Span | None) -> None:
        """A jump back is made: an Alarm if it is made for ever."""
        key = m.program, m.flow.current, target
        passes, seen = tuple(loop.begun for loop in self.running), self.seen.get(key)
        if seen is None or seen.passes != passes:
            self.seen[key] = _Seen(m.step, passes, dict(m.variables), m.step)
            return
        if self._decided(m, seen.step) or (seen.values == m.variables and m.variables.state_read <= seen.kept):
            raise Alarm(
                "the program never gets out of this loop: nothing that decides where it goes on changes from one round to "
                "the next",
                span or m.flow.span_of_block(m.flow.current),
                hint="change in the loop what its condition reads, or repeat it with a count",
            )
        seen.step, seen.count = m.step, seen.count + 1
        if seen.count == seen.next_kept:  # ever further apart: values that come again after many rounds are found, too
            seen.values, seen.kept, seen.next_kept = dict(m.variables), m.step, 2 * seen.count

    def _decided(self, m: Machine, step: int) -> bool:
        """Whether nothing that was asked after a step was written after it."""
        for name in self.asked_since(step):
            log = m.logs.by_name.get(name)
            if name == UNKNOWN or name in m.control.preassigned or (log and log.steps and log.steps[-1] > step):
                return False
        return True

    def told(self, m: Machine) -> str:
        """The loops around the block that runs, the innermost first, to be said after a sentence."""
        found = [(loop.program, loop.block, loop.done, loop.times) for loop in reversed(self.running[-SHOWN:])]
        if not found and self.seen:
            (index, at, _), seen = max(self.seen.items(), key=lambda item: item[1].count)
            found = [(index, at, seen.count, 0)]
        said = []
        for index, block, done, times in found:
            program = m.flow.programs[index]
            line = int(program.line_of(block))
            count = f", pass {done} of {times}" if times else f", made {done} times" if done else ""
            said.append(f"{program.line_text(line).strip()[:WIDTH]} in line {line}{count}")
        return f"; in {', in '.join(said)}" if said else ""
