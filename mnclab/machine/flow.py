"""What a machine, its functions and its cycles ask of the course of the program that is obeyed; `running.flow` is that course.

Where the program goes on changes the machine, so that the machine is handed over with what is asked.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from mnclab.geometry.frames import FrameChain, Matrix
from mnclab.path.leads import Lead
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import Span
from mnclab.text.program import Program

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


class RecordedLead(NamedTuple):
    """An approach or a departure in a recorded contour, in program coordinates: its row in the path, and where the tool comes
    from (None: the contour begins with the approach) or ends."""

    lead: Lead
    row: int
    place: tuple[float, float, float] | None


class Recording(NamedTuple):
    """A contour as a label or a program describes it: `path` in program coordinates from `start` on, and its side (+1
    left, -1 right, 0 none). `frames` and `memory` are the transformations at its end, `step` executed its first block;
    `approach` and `departure` lead to it and away, where the label has them."""

    path: Toolpath
    side: int
    start: tuple[float, float, float]
    frames: FrameChain
    memory: Any
    step: int
    approach: RecordedLead | None = None
    departure: RecordedLead | None = None


class Flow(Protocol):
    """Where the program is, and where it goes on."""

    current: int
    """The block being obeyed, of the running program."""

    @property
    def program(self) -> Program:
        """The running program."""

    @property
    def called(self) -> bool:
        """Whether the running program was called by another."""

    def span_of_step(self, step: int) -> Span | None:
        """The place of the block that a step executed."""

    def index_of(self, label: str, span: Span | None = None) -> int:
        """The block of a label; an Alarm if there is none."""

    def spend(self, work: int) -> None:
        """Count the running block as so many more of those that may be executed."""

    def spend_again(self, work: int) -> None:
        """The same in loops: nothing while no more blocks were executed than the text has."""

    def call(self, m: Machine, label: str, span: Span | None = None) -> None:
        """Run from a label to the end of its subprogram."""

    def call_program(self, m: Machine, index: int, span: Span | None = None) -> None:
        """Run another program."""

    def inside(self, m: Machine, index: int) -> AbstractContextManager[None]:
        """Blocks and labels are those of another program."""

    def jump(self, m: Machine, label: str, span: Span | None = None) -> None:
        """Go on at a label."""

    def repeat(self, m: Machine, first: int, stop: int, times: int, span: Span | None = None) -> None:
        """Run the blocks [first, stop) a number of times more."""

    def record(
        self, m: Machine, name: str, span: Span | None = None, after: Recording | None = None,
        blocks: Callable[[], None] | None = None, within: Matrix | None = None, in_space: bool = False,
    ) -> Recording:  # fmt: skip
        """Obey a label for its contour, or `blocks` for that of what has a name; nothing moves. See `running.recording`."""

    def aside(self, m: Machine, in_space: bool = False) -> AbstractContextManager[None]:
        """Blocks inside move nothing, and what they change does not stay, but for variables."""

    def leave(self) -> None:
        """End the running subprogram."""

    def end_program(self) -> None:
        """Go back to the calling program."""

    def ask(self, *values: Any) -> None:
        """A function is about to decide by these values of words where the program goes on."""

    def ask_whether(self, variable: str) -> None:
        """The same by whether a variable has a value."""

    def compare(self, one: Any, other: Any, difference: float) -> None:
        """The same by two values of words, whose numbers differ by so much."""
