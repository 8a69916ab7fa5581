"""What a machine, its functions and its cycles may ask of the course of the program that it obeys.

`running.flow` is that course; a machine that nobody runs a program on can do with less.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from mnclab.geometry.frames import FrameChain
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import Span
from mnclab.text.program import Program

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


class Recording(NamedTuple):
    """A contour as its label describes it: `path` in program coordinates from `start` on, and its side (+1 left,
    -1 right, 0 none). `frames` and `memory` are the transformations at its end."""

    path: Toolpath
    side: int
    start: tuple[float, float, float]
    frames: FrameChain
    memory: Any


class Flow(Protocol):
    """Where the program is, and where it goes on."""

    programs: list[Program]
    running: list[int]
    current: int
    watched: Callable[[int], None]
    found: dict[tuple[str, str], int]
    loops: Any
    obey: Callable[[int], None]
    bulk: Callable[[int, int], int]

    def add(self, program: Program) -> int:
        """Another program that may be called; its index."""

    def section(self, first: int, stop: int, least: int = 0) -> None:
        """Run the blocks [first, stop) of the running program."""

    def begin(self, block: int) -> int:
        """Note the execution of a block; the number of its step."""

    def begin_many(self, first: int, count: int) -> int:
        """Note the execution of blocks in a row; the number of the first step."""

    def steps(self) -> Any:
        """All steps so far."""

    @property
    def program(self) -> Program:
        """The running program."""

    @property
    def called(self) -> bool:
        """Whether the running program was called by another."""

    def call(self, label: str, span: Span | None = None) -> None:
        """Run from a label to the end of its subprogram."""

    def call_program(self, index: int, span: Span | None = None) -> None:
        """Run another program."""

    def inside(self, index: int) -> AbstractContextManager[None]:
        """Blocks and labels are those of another program."""

    def jump(self, label: str, span: Span | None = None) -> None:
        """Go on at a label."""

    def ask(self, *values: Any) -> None:
        """A function is about to decide by these values where the program goes on."""

    def repeat(self, first: int, stop: int, times: int, span: Span | None = None) -> None:
        """Run the blocks [first, stop) a number of times more."""

    def leave(self) -> None:
        """End the running subprogram."""

    def end_program(self) -> None:
        """Go back to the calling program."""

    def index_of(self, label: str, span: Span | None = None) -> int:
        """The block of a label."""

    def record(
        self, m: Machine, label: str, span: Span | None = None, after: Recording | None = None
    ) -> Recording:
        """Obey a label for its contour; nothing moves."""

    def spend(self, work: int) -> None:
        """Count the running block as so many more of those that may be executed."""

    def span_of_block(self, block: int) -> Span:
        """The place of a block of the running program."""

    def span_of_step(self, step: int) -> Span | None:
        """The place of the block that a step executed."""
