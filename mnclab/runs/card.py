"""A run in few words: the card that a notebook shows, the lines of a terminal, what became of the blank."""

from __future__ import annotations

from collections.abc import Callable
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from mnclab.path.toolpath import Kind
from mnclab.text.alarm import ALARM, Alarm, Span, card_html, first_of, several
from mnclab.text.tables import html_table
from mnclab.workpiece.outcome import Outcome, TooMuch, at_most

if TYPE_CHECKING:
    from mnclab.runs.run import Run


# What became of the blank of a run, for its card and its report: not where that would take long.

REPORT = 20_000  # moves, beyond which a report does not work it out
EFFORT = 120_000_000  # points under moves, beyond which a card does not; a report takes ten times as many


def reach(halt: Span | None, place_of_line: Callable[[int, int], str]) -> str:
    """How far the run went whose block `halt` stopped it: so far goes whatever is judged of it. Empty for a whole run."""
    if halt is None:
        return ""
    place = place_of_line(halt.line, halt.program) if halt.program else f"line {halt.line}"
    return f"up to {place}, where the run stopped"


def outcome(run: Run, most: int, cells: int | None = None, machine: Any = None) -> Outcome | None:
    """What became of the blank of a run; None without one.

    Of a path of more than `most` moves, or of one that is much work, only why it was not worked out. `cells` along the
    longer side of the blank, of a card; `machine` as in `Run.profile`.
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
            found = Outcome(run.removal(machine=machine, step=step), run.collisions())
            found.facts()  # works them out
            return found
    except TooMuch:
        return Outcome(None, None, "not worked out, which would take long: see run.removal(), run.collisions()")
    except Alarm as alarm:
        return Outcome(None, None, f"not worked out: {alarm.message}")



MOST = 1000  # moves, beyond which a card does not work out what became of the blank
CELLS = 80  # along the longer side of the blank, for a card
MEASURED = 12  # lines of a measuring record on a card


def summary(run: Run) -> dict[str, Any]:
    """Program, control, counts of blocks, moves, alarms and warnings, lengths in mm, seconds at feed."""
    path = run.toolpath
    lengths, rapid = path.lengths, path.kind == Kind.RAPID
    with np.errstate(divide="ignore", invalid="ignore"):
        cutting_time = np.where(~rapid & (lengths > 0), lengths / path.feed * 60, 0.0)
    turning = (path.kind == Kind.LINE) & (lengths == 0) & np.isfinite(path.time)  # rotary axes alone
    cutting_time[turning] = path.time[turning]
    dwell = np.nansum(np.where(path.kind == Kind.DWELL, path.time, 0.0))
    return {
        "program": run.program.title,
        "control": run.control.title,
        "blocks": len(run.program),
        "moves": int(path.is_motion.sum()),
        "cutting length": float(lengths[~rapid].sum()),
        "rapid length": float(lengths[rapid].sum()),
        "time at feed": float(np.nansum(cutting_time) + dwell),
        "alarms": sum(alarm.count for alarm in run.alarms if alarm.severity == ALARM),
        "warnings": sum(alarm.count for alarm in run.alarms if alarm.severity != ALARM),
    }


def _lengths(run: Run, told: dict[str, Any]) -> list[str]:
    """How long the moves at feed and at rapid are, in the unit of the program."""
    unit = run.toolpath.unit
    return [f"{told[name] / unit.length:.3f} {unit.short}" for name in ("cutting length", "rapid length")]


def in_words(run: Run) -> str:
    """One line, and the first alarms."""
    told = run.summary()
    counts = f"{several(told['blocks'], 'block')}, {several(told['moves'], 'move')}"
    cutting, rapid = _lengths(run, told)
    lengths = f"cutting {cutting}, rapid {rapid}"
    head = f"<Run {told['program']} on {run.control.name}: {counts}, {lengths}, {told['time at feed']:.1f} s at feed>"
    shown, more = first_of(run.alarms)
    return "\n".join([head, *map(str, shown), *filter(None, [more])])


def html(run: Run) -> str:
    """The figures, the usual tools that were taken, the alarms, what was measured, what became of the blank."""
    told = run.summary()
    cells = str(told["blocks"]), str(told["moves"]), *_lengths(run, told), f"{told['time at feed']:.1f} s"
    table = html_table(("blocks", "moves", "cutting", "rapid", "time at feed"), [cells], numbers=range(len(cells)))
    title = f"<strong>{escape(told['program'])}</strong> on {escape(told['control'])}"
    verdict = "" if run.alarms else "<p>no alarms</p>"
    return f"<div>{title}{table}{_usual_tools(run)}{verdict}{card_html(run.alarms)}{_measured(run)}{_became(run)}</div>"


def _usual_tools(run: Run) -> str:
    """The tools of the control that were taken because none were given."""
    path, given = run.toolpath, run.setup.tools
    if given != run.control.magazine:
        return ""
    used = dict.fromkeys(path.tool[path.is_motion].tolist())
    taken = ", ".join(f"T{number} {given[number].name}" for number in used if number and number in given)
    return f"<p>no tools were given, so the usual ones: {escape(taken)}</p>" if taken else ""


def _measured(run: Run) -> str:
    rows = run.measurements
    more = len(rows) - MEASURED
    return (rows[:MEASURED]._repr_html_() if rows else "") + (
        f"<p>{more} more: <code>run.measurements</code></p>" if more > 0 else ""
    )


def _became(run: Run) -> str:
    found = outcome(run, MOST, CELLS)
    return found.html() if found else ""
