"""How much work may go into a part: a card does not wait for what a person who asks for it would.

Work is counted in points under moves, so that the same part takes the same, whatever the computer.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from mnclab.text.alarm import Alarm

_left: ContextVar[list[float] | None] = ContextVar("left", default=None)


class TooMuch(Alarm):
    """More work than was allowed."""


@contextmanager
def at_most(work: float) -> Iterator[None]:
    """Inside, so much work is done; what needs more is a TooMuch."""
    before = _left.set([work])
    try:
        yield
    finally:
        _left.reset(before)


def spend(work: float) -> None:
    """Count work that is about to be done."""
    left = _left.get()
    if left is not None:
        left[0] -= work
        if left[0] < 0:
            raise TooMuch("this would take long")
