"""What became of the blank, in a few figures: for the card of a run, and for its report."""

from __future__ import annotations

from html import escape
from typing import NamedTuple

from mnclab.text.alarm import several
from mnclab.workpiece.collision import Collisions
from mnclab.workpiece.removal import Removal

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
            rates = f"{told(mean)}/min, at most {told(most.rate)}/min in line {self.removal.place(most)}"
            found.append(("removal rate", rates))
        met = f"{len(self.collisions) or 'none'} {self.collisions.reach}".rstrip()
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
