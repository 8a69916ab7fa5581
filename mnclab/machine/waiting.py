"""Motion that waits: blocks whose moves can be made only when later blocks have told more.

They stand in `machine.pending`. The interpreter has them made before it obeys anything that does not belong to them,
and at the end of a program or of a recorded label.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


class Pending(Protocol):
    """Blocks that wait."""

    def mark(self, joint: Any) -> bool:
        """Put a joint on the last of their elements; False if it has one already."""

    def make(self, m: Machine) -> None:
        """Make their moves; an Alarm when not enough is known."""


def determine(m: Machine) -> None:
    """Make the moves that wait, if any."""
    pending, m.pending = m.pending, None
    if pending:
        pending.make(m)


class Reading(NamedTuple):
    """What a block that waits was read under."""

    step: int
    source_line: int
    side: int
    label: str


def reading(m: Machine) -> Reading:
    """What a block is read under now."""
    return Reading(m.step, m.source_line, m.side, m.label)


@contextmanager
def as_of(m: Machine, then: Reading) -> Iterator[None]:
    """Rows made within belong to a block that was read earlier, and the history notes their ends there."""
    with m.within(**then._asdict()):
        yield
        m.log("position", m.programmed)
