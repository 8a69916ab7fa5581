"""A thread that the axes cannot follow: the spindle turns so fast that an axis would have to go faster than it can. And one
whose passes are cut at different speeds.

A locked move goes pitch times speed along its way, v = P n. Every control takes its threads and taps from the same rows, and
each axis k has its own share of v: |d_k| v against `Limits.rapid`. On a lathe the axis begins from rest, so that the first
v² / 2a of a thread have another pitch, and as much at its end: they belong into the air. A tap follows a spindle that speeds up
and slows down with it, so of that nothing is said. Nor can it jump to another lead where one thread goes on from another:
controls take that without a word. What a cycle makes of one thread, its run-out, is no other thread.

Passes of one thread meet when each begins at the same angle of the spindle. But the axis lags behind the spindle by a time of
the drive, so by an angle that grows with the speed, and so does the way in which it gets up to its own: at another speed, or
another sense of turning, a pass does not run in the groove of the one before.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.feeds import spindle_speed
from mnclab.path.listing import figure
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath
from mnclab.runs.lint.once import once
from mnclab.text.alarm import Alarm
from mnclab.workpiece.turning.turned import Turned

if TYPE_CHECKING:
    from mnclab.runs.run import Run

MORE = 1 + 1e-9
SMALL = 1e-9  # mm
SAME = 1e-6  # of a lead
ON_AXIS = 1e-6  # mm: a tool that threads there is a tap
PASSES = 100  # of a thread that are looked back to
FLOATING = "cut the thread"  # the label of a tap, in a holder that floats too: there the axis runs at the feed
PLACES = 400  # of a thread that are looked at for where its material begins


def remarks(run: Run) -> Iterator[Alarm]:
    """A warning for the threads that an axis is too slow for, and one for those without room to get up to speed."""
    path, limits = run.toolpath, run.setup.limits
    floating = np.array([FLOATING in label for label in path.labels])[path.label]
    rows = np.flatnonzero((path.synchronous | floating) & np.isin(path.kind, (Kind.LINE, Kind.ARC)) & (path.lengths > SMALL))
    if not len(rows):
        return
    speed = _speed(path, rows, limits.spindle)
    share = np.abs(path.end[rows] - path.start[rows]) / path.lengths[rows][:, None]
    needs, most = speed[:, None] * share, limits.axes("rapid")
    over = needs > most * MORE
    unit, short = path.unit.length, path.unit.short
    if (fast := over.any(axis=1)).any():
        k = int(fast.argmax())
        axis = int((needs[k] / most).argmax())
        turning = f"{figure(float(abs(path.spindle[rows[k]])), 0)} rev/min"
        along = 60 * speed[k] * share[k].max() / min(abs(path.spindle[rows[k]]), limits.spindle)  # as F says it
        lead = f"{figure(along / unit, 4)} {short}"
        wanted, allowed = (f"{figure(60 * float(each) / unit, 1)} {short}/min" for each in (needs[k, axis], most[axis]))
        slower = float(abs(path.spindle[rows[k]]) * (most / np.maximum(needs[k], SMALL)).min())
        message = (
            f"the thread needs {wanted} along {'XYZ'[axis]}, which goes {allowed} at most: at {turning} its lead is never {lead}"
        )
        yield once(run, path.step[rows[fast]].tolist(), message, f"at most {int(slower)} rev/min, or other limits of the machine")
    if path.lathe:
        yield from _jumps(run)
        yield from _without_run_in(run, rows[~fast], speed[~fast], share[~fast])
        yield from _passes_apart(run, rows)


def _jumps(run: Run) -> Iterator[Alarm]:
    """Threads that go on from another one, in another block, with another lead along the axis of the longer way."""
    path = run.toolpath
    rows = np.flatnonzero((path.is_motion & (path.lengths > 0)) | np.isin(path.kind, (Kind.DWELL, Kind.STOP)))
    locked = path.synchronous[rows] & np.isin(path.kind[rows], (Kind.LINE, Kind.ARC))
    way = np.abs(path.end[rows] - path.start[rows]).max(axis=1)
    lead = path.per_rev[rows] * way / np.maximum(path.lengths[rows], SMALL)  # as F says it
    jumps = locked[1:] & locked[:-1] & (path.step[rows[1:]] != path.step[rows[:-1]])
    jumps &= np.abs(lead[1:] - lead[:-1]) > SAME * lead[:-1]
    if jumps.any():
        k = int(jumps.argmax())
        before, after = (figure(float(each) / path.unit.length, 4) for each in lead[k : k + 2])
        message = f"the lead jumps from {before} to {after} {path.unit.short} where one thread goes on from another"
        hint = "no axis changes its speed at once: leave the material before the next thread"
        yield once(run, path.step[rows[1:][jumps]].tolist(), message, hint)


def _speed(path: Toolpath, rows: Index, spindle: float) -> Array:
    """How fast the locked rows go along their way (k,), mm/s: not faster than the spindle turns."""
    turning = np.abs(path.spindle[rows])
    slowed = np.minimum(1.0, spindle / np.maximum(turning, SMALL))
    by_lead = path.per_rev[rows] * np.minimum(turning, spindle)
    return np.asarray(np.where(np.isfinite(by_lead), by_lead, np.nan_to_num(path.feed[rows]) * slowed)) / 60


def _without_run_in(run: Run, rows: Index, speed: Array, share: Array) -> Iterator[Alarm]:
    """Threads of a lathe that cut before the axis has their speed."""
    path = run.toolpath
    acceleration = (run.setup.limits.axes("acceleration") / np.maximum(share, SMALL)).min(axis=1)
    needs = speed**2 / (2 * acceleration)
    tapped = _tapped(run, rows)
    begins = np.flatnonzero(~np.isin(rows - 1, rows))  # rows of one thread follow each other
    late: list[tuple[int, float, float]] = []
    seen = set[int]()
    for k, end in zip(begins.tolist(), [*begins[1:].tolist(), len(rows)]):
        step = int(path.step[rows[k]])
        if tapped[k] or step in seen:  # the passes of a cycle begin at one place
            continue
        seen.add(step)
        way = float(path.lengths[rows[k:end]].sum())
        air = way - needs[k] if way < 2 * needs[k] else _air(run, int(rows[k]), float(needs[k]))
        if air < needs[k] * (1 - 1e-6) - SMALL:
            late.append((step, float(needs[k]), max(air, 0.0)))
    if late:
        step, need, air = late[0]
        unit, short = path.unit.length, path.unit.short
        message = (
            f"the thread begins with another pitch: the axis needs {figure(need / unit, 2)} {short} of run-in (v² / 2a), "
            f"and there {'are' if air else 'is'} {figure(air / unit, 2) if air else 'none'}{f' {short}' if air else ''}"
        )
        yield once(run, [each for each, *_ in late], message, "begin farther from the material, or turn slower")


def _tapped(run: Run, rows: Index) -> Mask:
    """Which rows (k,) of a lathe are cut by a tap: along the axis of the bar, or by a tool of this kind."""
    path, (tools, numbers) = run.toolpath, run.tools_that_cut
    on_axis = (np.abs(path.start[rows, 0]) < ON_AXIS) & (np.abs(path.end[rows, 0]) < ON_AXIS)
    return np.asarray(on_axis | np.isin(numbers[rows], [number for number, tool in tools.items() if tool.kind == "tap"]))


def _passes_apart(run: Run, rows: Index) -> Iterator[Alarm]:
    """Passes of one thread, of one tool, one lead and one stretch of the bar, whose spindle turns at another speed."""
    path, numbers = run.toolpath, run.tools_that_cut[1]
    rows = rows[~_tapped(run, rows) & np.isfinite(path.per_rev[rows])]
    turning = path.spindle[rows]
    surface = np.isfinite(path.surface[rows])
    if surface.any():  # at a constant cutting speed it turns as where the pass begins
        speeds = spindle_speed(path.surface[rows], path.start[rows, 0] - path.spindle_x[rows], path.speed_limit[rows])
        turning = np.where(surface, np.copysign(speeds, turning), turning)
    turning = turning.clip(-run.setup.limits.spindle, run.setup.limits.spindle)
    along = np.abs(np.diff(np.stack([path.start[rows], path.end[rows]]), axis=0)[0]).argmax(axis=1)
    lead = path.per_rev[rows] * np.abs(path.end[rows] - path.start[rows]).max(axis=1) / path.lengths[rows]
    cut: dict[tuple[int, int, int], deque[tuple[float, float, float]]] = {}  # where passes went, and how fast the spindle was
    apart: list[tuple[int, float, float]] = []
    for k, row in enumerate(rows.tolist()):
        axis = int(along[k])
        low, high = sorted((float(path.start[row, axis]), float(path.end[row, axis])))
        before = cut.setdefault((int(numbers[row]), axis, round(float(lead[k]) / (SAME * 10))), deque(maxlen=PASSES))
        speed = float(turning[k])
        other = next((was for begin, end, was in before if begin < high - SMALL and low < end - SMALL), speed)
        if abs(other - speed) > SAME * abs(other):
            apart.append((int(path.step[row]), other, speed))
        elif (low, high, speed) not in before:
            before.append((low, high, speed))
    if apart:
        _, was, speed = apart[0]
        sense = ("", " counter-clockwise")
        before_said, said = (f"{figure(abs(each), 1)} rev/min{sense[each < 0]}" for each in (was, speed))
        message = f"a pass of the thread is cut at {said}, the one before it at {before_said}: they do not meet in one groove"
        yield once(run, [step for step, *_ in apart], message, "one speed (G97) for all passes of a thread")


def _air(run: Run, row: int, enough: float) -> float:
    """How far a row goes before it meets material, mm; infinite where nobody knows, or where it is farther than enough."""
    path, stock = run.toolpath, run.stock
    if stock is None or not stock.volume > 0 or not row:
        return np.inf
    start, heading = path.start[row], (path.end[row] - path.start[row]) / path.lengths[row]
    first, last = 0.0, min(float(path.lengths[row]), enough)
    if not min(start[2], (start + last * heading)[2]) < stock.bounds[1, 2]:
        return np.inf
    try:
        part = run.workpiece(row=row - 1)
    except Alarm:  # a blank that no lathe turns: what cuts says it
        return np.inf
    if not isinstance(part, Turned):
        return np.inf
    for _ in range(2):  # the second time between two places of the first
        way = np.linspace(first, last, PLACES)
        places = start + way[:, None] * heading
        r = np.abs(places[:, 0] - part.axis)
        inside = (r < np.asarray(part.at(places[:, 2])) - ON_AXIS) & (r > np.asarray(part.bore_at(places[:, 2])) + ON_AXIS)
        if not inside.any():
            return np.inf
        met = int(inside.argmax())
        first, last = float(way[max(met - 1, 0)]), float(way[met])
    return last
