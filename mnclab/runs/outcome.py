"""What became of the blank of a run, for its card and its report: not where that would take long."""

from __future__ import annotations

from typing import TYPE_CHECKING

from mnclab.text.alarm import Alarm, several
from mnclab.workpiece.outcome import Outcome

if TYPE_CHECKING:
    from mnclab.runs.run import Run

REPORT = 20_000  # moves, beyond which a report does not work it out


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
