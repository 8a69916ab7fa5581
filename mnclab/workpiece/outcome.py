"""What became of the blank, in a few figures, for the card of a run and for its report; and how much work may go into it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from html import escape
from typing import NamedTuple

from mnclab.text.alarm import Alarm, several
from mnclab.workpiece.collision import Collisions
from mnclab.workpiece.removal import Removal

# How much work may go into a part: a card does not wait for what a person who asks for it would.
# Work is counted in points under moves, so that the same part takes the same, whatever the computer.

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


# What became of the blank, in a few figures: for the card of a run, and for its report.

TOLD = 5  # collisions of a card
RED = "color:#b3261e;font-weight:600"  # as alarms have it


class Outcome(NamedTuple):
    """What went and what collided; where it was not worked out, both are None and `why` says why."""

    removal: Removal | None
    collisions: Collisions | None
    why: str = ""

    def facts(self) -> list[tuple[str, str]]:
        """Names and figures, as a table has them."""
        if self.removal is None or self.collisions is None:
            return [("removed", self.why)]
        most, mean, told = self.removal.largest, self.removal.mean, self.removal.told
        found = [("removed", told(self.removal.volume))]
        if most is not None:
            rates = f"{told(mean)}/min, {self.removal.at_most} {told(most.rate)}/min in line {self.removal.place(most)}"
            found.append(("removal rate", rates))
        met = f"{len(self.collisions) or 'none'}{' where judged' * bool(self.collisions.notes)} {self.collisions.reach}".rstrip()
        return [*found, ("collisions", "; ".join([met, *self.collisions.notes]))]

    def html(self) -> str:
        """The lines of a card."""
        told = "; ".join(f"{name}: {said}" for name, said in self.facts() if name != "collisions")
        clean = ""
        if self.collisions is not None and (self.collisions.reach or not len(self.collisions)):
            clean = "; ".join(["", self.collisions.sentence, *self.collisions.notes])
        return f"<p>{escape(told + clean)}</p>{collisions_html(self.collisions or Collisions(), TOLD)}"


def collisions_html(found: Collisions, most: int | None = None) -> str:
    """Collisions in red, a line each; nothing where there is none."""
    lines = "".join(
        f'<div role="alert"><span style="{RED}">collision</span> {escape(f"{each.file}:{each.line}: {each.message}")}</div>'
        for each in found[:most]
    )
    more = f"<p>… {several(len(found) - most, 'more collision')}</p>" if most and len(found) > most else ""
    return lines + more
