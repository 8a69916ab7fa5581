"""What became of the blank, in a few figures: for the card of a run, and for its report."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, NamedTuple

from mnclab.text.alarm import Alarm, several
from mnclab.workpiece.collision import Collisions
from mnclab.workpiece.removal import Removal

if TYPE_CHECKING:
    from mnclab.runs.run import Run

CARD, REPORT = 1000, 20_000  # moves of a path, beyond which they do not work it out
CELLS = 80  # along the longer side of the blank, for a card
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
        most, mean = self.removal.largest, self.removal.mean
        found = [("removed", volume(self.removal.volume))]
        if most is not None:
            rates = f"{volume(mean)}/min, at most {volume(most.rate)}/min in line {self.removal.place(most)}"
            found.append(("removal rate", rates))
        return [*found, ("collisions", str(len(self.collisions) or "none"))]


def outcome(run: Run, most: int, cells: int | None = None) -> Outcome | None:
    """What became of the blank of a run; None without one.

    Of a path of more than `most` moves only why it was not worked out. `cells` along the longer side of the blank.
    """
    if run.stock is None:
        return None
    moves = int(run.toolpath.is_motion.sum())
    if moves > most:
        return Outcome(None, None, f"not worked out for {several(moves, 'move')}: see run.workpiece(), run.collisions()")
    sides = run.stock.bounds[1] - run.stock.bounds[0]
    step = float(sides[:2].max()) / cells if cells and not run.toolpath.lathe else None
    try:
        return Outcome(run.removal(step=step), run.collisions())
    except Alarm as alarm:
        return Outcome(None, None, f"not worked out: {alarm.message}")


def card(run: Run) -> str:
    """The lines of a card about the part; nothing without a blank."""
    found = outcome(run, CARD, CELLS)
    if found is None:
        return ""
    told = "; ".join(f"{name}: {said}" for name, said in found.facts() if name != "collisions")
    clean = "; no collisions" if found.collisions == () else ""
    return f"<p>{escape(told)}{clean}</p>{collisions_html(found.collisions or Collisions(), TOLD)}"


def collisions_html(found: Collisions, most: int | None = None) -> str:
    """Collisions in red, a line each; nothing where there is none."""
    lines = "".join(
        f'<div role="alert"><span style="{RED}">collision</span> {escape(f"{each.file}:{each.line}: {each.message}")}</div>'
        for each in found[:most]
    )
    more = f"<p>… {several(len(found) - most, 'more collision')}</p>" if most and len(found) > most else ""
    return lines + more


def volume(value: float) -> str:
    """mm³ as people say it: three figures, in cm³ from one on."""
    return f"{value / 1000:.3g} cm³" if value >= 1000 else f"{value:.3g} mm³"

