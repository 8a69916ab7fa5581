"""What became of the blank of a run, for its card and its report: not where that would take long."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from mnclab.text.alarm import Alarm, Span, several
from mnclab.workpiece.effort import TooMuch, at_most
from mnclab.workpiece.outcome import Outcome

if TYPE_CHECKING:
    from mnclab.runs.run import Run

REPORT = 20_000  # moves, beyond which a report does not work it out
EFFORT = 120_000_000  # points under moves, beyond which a card does not; a report takes ten times as many


def reach(halt: Span | None, place_of_line: Callable[[int, int], str]) -> str:
    """How far the run went whose block `halt` stopped it: so far goes whatever is judged of it. Empty for a whole run."""
    if halt is None:
        return ""
    place = place_of_line(halt.line, halt.program) if halt.program else f"line {halt.line}"
    return f"up to {place}, where the run stopped"


def outcome(run: Run, most: int, cells: int | None = None) -> Outcome | None:
    """What became of the blank of a run; None without one.

    Of a path of more than `most` moves, or of one that is much work, only why it was not worked out. `cells` along the
    longer side of the blank, of a card.
    """
    if run.stock is None:
        return None
    moves = int(run.toolpath.is_motion.sum())
    if moves > most:
        return Outcome(None, None, f"not worked out for {several(moves, 'move')}: see run.workpiece(), run.collisions()")
    sides = run.stock.bounds[1] - run.stock.bounds[0]
    step = float(sides[:2].max()) / cells if cells and not run.toolpath.lathe else None
    try:
        with at_most(EFFORT if cells else 10 * EFFORT):
            found = Outcome(run.removal(step=step), run.collisions())
            found.facts()  # works them out
            return found
    except TooMuch:
        return Outcome(None, None, "not worked out, which would take long: see run.removal(), run.collisions()")
    except Alarm as alarm:
        return Outcome(None, None, f"not worked out: {alarm.message}")
