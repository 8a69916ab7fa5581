"""A run in few words: the card that a notebook shows, the lines of a terminal."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from mnclab.path.toolpath import Kind
from mnclab.runs.outcome import outcome
from mnclab.text.alarm import ALARM, card_html, first_of, several
from mnclab.text.tables import html_table

if TYPE_CHECKING:
    from mnclab.runs.run import Run

MOST = 1000  # moves, beyond which a card does not work out what became of the blank
CELLS = 80  # along the longer side of the blank, for a card
MEASURED = 12  # lines of a measuring record on a card


def summary(run: Run) -> dict[str, Any]:
    """Program, control, counts of blocks, moves, alarms and warnings, lengths in mm, seconds at feed."""
    path = run.toolpath
    lengths, rapid = path.lengths, path.kind == Kind.RAPID
    with np.errstate(divide="ignore", invalid="ignore"):
        cutting_time = np.where(~rapid & (lengths > 0), lengths / path.feed * 60, 0.0)
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
