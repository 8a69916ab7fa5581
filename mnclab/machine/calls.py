"""The course of a program: sections, labels, repeats, subprograms.

A *step* is one execution of a block. A section of blocks is run by a plain loop; a call or a repeat is a section run
inside another. Functions steer with :meth:`Flow.call`, :meth:`Flow.repeat` and :meth:`Flow.leave`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.text.alarm import Alarm, Span
from mnclab.text.program import Program

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

DEEPEST = 20  # nested calls
LONGEST = 1_000_000  # blocks that repeats and calls may add, one by one


class Steps(NamedTuple):
    """Which block and which program each step executed (s,)."""

    block: NDArray[np.int32]
    program: NDArray[np.int16]


class Flow:
    """Where the program is: the running section, the depth of calls, the log of steps."""

    def __init__(self, program: Program, obey: Callable[[int], None], bulk: Callable[[int, int], int]) -> None:
        self.programs = [program]
        self.obey, self.bulk = obey, bulk
        self.machine: Machine
        self.depth, self.calls = 0, 0  # calls: subprograms alone, without repeats
        self.limit, self.in_bulk = (
            LONGEST + len(program),
            0,
        )  # steps obeyed in bulk do not count: they end by themselves
        self.watched: Callable[[int], None] = lambda steps: None  # hears now and then how many steps were begun
        self.returning = False
        self.current = 0  # block being obeyed
        self._chunks: list[NDArray[np.int64] | range] = []
        self._blocks: list[int] = []
        self._counted = 0

    @property
    def program(self) -> Program:
        """The running program."""
        return self.programs[self.machine.program]

    # --- running -----------------------------------------------------------------------------------------------------

    def section(self, first: int, stop: int) -> None:
        """Run the blocks [first, stop) of the running program."""
        machine, block = self.machine, first
        while block < stop and not machine.ended:
            done = self.bulk(block, stop)
            if done:
                block += done
                continue
            self.current = block
            self.obey(block)
            if self.returning:
                return
            block += 1

    def call(self, label: str, span: Span | None = None) -> None:
        """Run from a label to the end of its subprogram."""
        self.enter(span)
        here = self.current
        self.calls += 1
        self.section(self.index_of(label, span) + 1, len(self.program))
        self.calls -= 1
        self.depth, self.returning, self.current = self.depth - 1, False, here

    def repeat(self, first: int, stop: int, times: int, span: Span | None = None) -> None:
        """Run the blocks [first, stop) a number of times more."""
        self.enter(span)
        here = self.current
        for _ in range(times):
            self.section(first, stop)
            if self.returning or self.machine.ended:
                break
        self.depth, self.current = self.depth - 1, here

    def enter(self, span: Span | None) -> None:
        """Go one call deeper."""
        if self.depth >= DEEPEST:
            raise Alarm(f"calls are nested deeper than {DEEPEST}", span or self.span_of_step(self.machine.step))
        self.depth += 1

    def leave(self) -> None:
        """End the running subprogram; nothing in the main program."""
        self.returning = self.calls > 0

    def index_of(self, label: str, span: Span | None = None) -> int:
        """The block of a label."""
        if label not in self.program.labels:
            known = ", ".join(list(self.program.labels)[:8])
            hint = f"labels of this program: {known}" if known else "this program has no labels"
            raise Alarm(f"label {label} does not exist", span or self.span_of_step(self.machine.step), hint=hint)
        return self.program.labels[label]

    # --- steps -------------------------------------------------------------------------------------------------------

    def begin(self, block: int) -> int:
        """Note the execution of a block; the number of its step."""
        blocks = self._blocks
        step = self._counted + len(blocks)
        if step - self.in_bulk >= self.limit:
            raise Alarm(f"repeats and calls ran {LONGEST} blocks without an end", self.program.span_of_block(block))
        if not step & 1023:
            self.watched(step)
        blocks.append(block)
        return step

    def begin_many(self, first: int, count: int) -> int:
        """Note the execution of blocks in a row; the number of the first step."""
        self._flush()
        self.watched(self._counted)
        self._chunks.append(range(first, first + count))
        self._counted += count
        self.in_bulk += count
        return self._counted - count

    def _flush(self) -> None:
        self._chunks.append(np.array(self._blocks, dtype=np.int64))
        self._counted += len(self._blocks)
        self._blocks = []

    def steps(self) -> Steps:
        """All steps so far."""
        self._flush()
        blocks = np.empty(self._counted, dtype=np.int32)
        at = 0
        for chunk in self._chunks:
            part = np.arange(chunk.start, chunk.stop) if isinstance(chunk, range) else chunk
            blocks[at : at + len(part)] = part
            at += len(part)
        return Steps(blocks, np.broadcast_to(np.int16(0), (len(blocks),)))

    def span_of_step(self, step: int) -> Span | None:
        """The place of the block that a step executed."""
        if step < 0:
            return None
        self._flush()
        for chunk in self._chunks:
            if step < len(chunk):
                return self.program.span_of_block(int(chunk[step]))
            step -= len(chunk)
        return None
