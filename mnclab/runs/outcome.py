"""What became of the blank of a run, for its card and its report: not where that would take long; what it measured."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mnclab.text.alarm import Alarm, several
from mnclab.workpiece.outcome import Outcome

if TYPE_CHECKING:
    from mnclab.runs.run import Run

CARD, REPORT = 1000, 20_000  # moves, beyond which a card and a report do not work it out
MEASURED = 12  # lines of a measuring record on a card
CELLS = 80  # along the longer side of the blank, for a card


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
    """The lines of the card of a run about its part: what was measured, and what became of the blank; nothing without one."""
    found, rows = outcome(run, CARD, CELLS), run.measurements
    more = len(rows) - MEASURED
    measured = rows[:MEASURED]._repr_html_() if rows else ""
    measured += f"<p>{more} more: <code>run.measurements</code></p>" if more > 0 else ""
    return measured + (found.html() if found else "")
