"""Motion that the axes cannot follow, or that meets the blank: threads, and rapids in it."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from copy import copy
from typing import TYPE_CHECKING, NamedTuple, TypeGuard

import numpy as np

from mnclab.path.feeds import spindle_speed
from mnclab.path.limits import extents
from mnclab.path.listing import figure
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath
from mnclab.runs.lint.once import warn_once, word_span
from mnclab.runs.material import cutting_of
from mnclab.text.alarm import Alarm
from mnclab.workpiece.blank import Box, Revolved
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.turning.turned import Turned

if TYPE_CHECKING:
    from mnclab.runs.run import Run


# A thread that the axes cannot follow: the spindle turns so fast that an axis would have to go faster than it can.
#
# A locked move goes pitch times speed along its way, v = P n. Every control takes its threads and taps from the same rows, and
# each axis k has its own share of v: |d_k| v against `Limits.rapid`. On a lathe the axis begins from rest, so that the first
# v² / 2a of a thread have another pitch, and as much at its end: they belong into the air. A tap follows a spindle that speeds up
# and slows down with it, so of that nothing is said. Nor can it jump to another lead where one thread goes on from another:
# controls take that without a word. What a cycle makes of one thread, its run-out, is no other thread.
#
# Passes of one thread meet when each begins at the same angle of the spindle. But the axis lags behind the spindle by a time of
# the drive, so by an angle that grows with the speed, and so does the way in which it gets up to its own: at another speed, or
# another sense of turning, a pass does not run in the groove of the one before.

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
    floating = np.array([FLOATING in label for label in path.labels])
    rows = np.flatnonzero(path.synchronous | floating[path.label] if floating.any() else path.synchronous)
    if not len(rows):
        return
    rows = rows[np.isin(path.kind[rows], (Kind.LINE, Kind.ARC)) & (path.lengths[rows] > SMALL)]
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
        mend = f"at most {int(slower)} rev/min, or other limits of the machine"
        yield warn_once(run, path.step[rows[fast]].tolist(), message, mend)
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
        yield warn_once(run, path.step[rows[1:][jumps]].tolist(), message, hint)


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
        yield warn_once(run, [each for each, *_ in late], message, "begin farther from the material, or turn slower")


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
        yield warn_once(run, [step for step, *_ in apart], message, "one speed (G97) for all passes of a thread")


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


# A rapid through the blank, where no move before it can have taken the material away.
#
# Nothing is cut here: what a move may at most have taken is a box, as wide as the tool beside the move and open upwards (on a
# lathe outwards), for below its tip nothing is gone. A place of a rapid that lies in the blank and in none of these boxes is
# full. One box around all moves before is asked first, in a few passes over the columns; of short programs each box by itself.
# So a rapid in a pocket is none. What a cycle does in a hole that was there before, and a rapid into the middle of a circle
# that is milled afterwards (a thread in a drilled hole), is left to `Run.collisions`,
# and so is what comes later than the first ten thousand rows: no run is to wait for this.

DEEP = 0.1  # mm, below the surface of the blank and beside what may be cut
RAPID_PLACES = 8  # of a rapid that are looked at
FIRST = 10_000  # rows that are judged
PAIRS = 1_000_000  # of rapids and moves before them, up to which each move is asked by itself
INSERT = 25.0  # mm, how far along the bar an insert may cut beside its tip
ON_THE_MACHINE = ("M91", "M92", "G53", "G28", "G30")  # places that count from where nobody may have set a datum
OUTER = ("", "turning", "grooving", "thread")  # lathe tools that cut on the side away from the axis, in a full bar
MESSAGE = "a rapid goes through the blank, where nothing has been cut before"


def rapids_in_blank(run: Run) -> Iterator[Alarm]:
    """A warning at the first such rapid, which counts the others."""
    stock, path = run.stock, run.toolpath[:FIRST]
    if stock is None or not stock.volume > 0 or path.lathe and not _turns(stock):
        return
    low, high = stock.bounds + [[DEEP], [-DEEP]]
    rapid = np.flatnonzero((path.kind == Kind.RAPID) & (path.label == 0))
    start, end = path.start[rapid], path.end[rapid]
    near = ((np.minimum(start, end) < high) & (np.maximum(start, end) > low)).all(axis=1)
    if not near.any():
        return
    begun = copy(run)
    begun.toolpath = path
    found = _full(cutting_of(begun, named=len(run.toolpath) <= FIRST), rapid[near])
    if rows := [row for row in found.tolist() if not word_span(run, int(path.step[row]), *ON_THE_MACHINE)]:
        down = np.ptp([path.start[rows[0], :2], path.end[rows[0], :2]], axis=0).max() == 0
        hint = "a rapid ends above the material, the rest goes at feed" if down else "first Z above the part, then X and Y"
        if path.lathe:
            hint = "a rapid ends outside the bar, the rest goes at feed"
        yield warn_once(run, np.unique(path.step[rows]).tolist(), MESSAGE, hint)


def _turns(stock: object) -> TypeGuard[Revolved]:
    return isinstance(stock, Revolved) and stock.axis == "Z" and not any(stock.at[:2])


class Taken(NamedTuple):
    """What rows of a path may have taken at most: boxes (n, 3), infinite where nothing is known; empty of other rows."""

    low: Array
    high: Array


def _full(cutting: Cutting, rows: Index) -> Index:
    """Which of some rapids go through material that nothing can have taken."""
    judged = cutting.cuts & (np.arange(len(cutting)) >= cutting.known - 1)  # of the row that arrives from home its end
    if cutting.tilted is not None:
        judged &= ~np.logical_or.accumulate(cutting.tilted)
    judged = judged & ~np.logical_or.accumulate(cutting.bare)
    rows = rows[judged[rows]]
    if not len(rows):
        return rows
    points, inside = _places(cutting, rows)
    taken = _taken(cutting)
    before = Taken(np.minimum.accumulate(taken.low, axis=0), np.maximum.accumulate(taken.high, axis=0))
    earlier = np.maximum(rows - 1, 0)
    gone = _within(points, Taken(before.low[earlier][:, None], before.high[earlier][:, None])) & (rows > 0)[:, None]
    found = np.array((inside & ~gone).any(axis=1))
    rest = np.flatnonzero(inside.any(axis=1) & ~found)
    if len(rest) * len(cutting) <= PAIRS:
        for k in rest.tolist():
            each = Taken(taken.low[: rows[k], None], taken.high[: rows[k], None])
            found[k] = (inside[k] & ~_within(points[k][None], each).any(axis=0)).any()
    return rows[found & ~_in_circle(cutting, rows)]


def _in_circle(cutting: Cutting, rows: Index) -> Mask:
    """Which of some rapids end in the middle of an arc that follows: they go into a hole that was there."""
    path = cutting.path
    arcs = np.flatnonzero(path.kind == Kind.ARC)
    middles = np.round(path.centre[arcs, :2], 3) @ [1, 1j]
    last = dict(zip(middles.tolist(), arcs.tolist()))
    return np.array([last.get(end, -1) > row for end, row in zip((np.round(path.end[rows, :2], 3) @ [1, 1j]).tolist(), rows)])


def _within(points: Array, taken: Taken) -> Mask:
    return np.asarray(((points >= taken.low - DEEP) & (points <= taken.high + DEEP)).all(axis=-1))


def _places(cutting: Cutting, rows: Index) -> tuple[Array, Mask]:
    """Places of rapids in the box around the blank (k, RAPID_PLACES, 3), and which of them are in the blank, not just at it."""
    stock, end = cutting.stock, cutting.path.end[rows]
    start = np.where(cutting.from_home[rows, None], end, cutting.path.start[rows])
    low, high = stock.bounds + [[DEEP], [-DEEP]]
    way = end - start
    with np.errstate(divide="ignore", invalid="ignore"):
        sides = np.stack([(low - start) / way, (high - start) / way])
    still = way == 0
    begin = np.where(still, 0.0, sides.min(axis=0)).max(axis=1).clip(0, 1)
    over = np.where(still, 1.0, sides.max(axis=0)).min(axis=1).clip(0, 1)
    share = begin[:, None] + (over - begin)[:, None] * ((np.arange(RAPID_PLACES) + 0.5) / RAPID_PLACES)
    points = start[:, None] + way[:, None] * share[..., None]
    inside: Mask = ((points > low) & (points < high)).all(axis=-1)
    if _turns(stock) and cutting.lathe:
        across, along = points[..., 0], points[..., 2] - stock.at[2]
        profile = np.array(stock.profile, dtype=np.float64)
        wide = np.min([_radius(profile, along + aside) for aside in (-DEEP, DEEP)], axis=0)
        inside &= (across > max(stock.bore, 0.0) + DEEP * (stock.bore > 0)) & (across < wide - DEEP)
    elif not isinstance(stock, Box):
        bottom, top = stock.faces(points[..., 0].ravel(), points[..., 1].ravel())
        with np.errstate(invalid="ignore"):
            inside &= (points[..., 2] > bottom.reshape(inside.shape) + DEEP) & (points[..., 2] < top.reshape(inside.shape) - DEEP)
    return points, inside


def _radius(profile: Array, along: Array) -> Array:
    """The radius of a bar at places along its axis, the smaller one at a shoulder; 0 beyond its ends."""
    order = np.argsort(profile[:, 1], kind="stable")
    radius, place = profile[order].T
    left, right = np.searchsorted(place, along, "left"), np.searchsorted(place, along, "right")
    beyond = (left == 0) & (right == 0) | (left == len(place)) & (right == len(place))
    ends = radius[np.clip(left - 1, 0, len(place) - 1)], radius[np.clip(right, 0, len(place) - 1)]
    return np.where(beyond, 0.0, np.minimum(*ends))


def _taken(cutting: Cutting) -> Taken:
    path, stock = cutting.path, cutting.stock
    begin = np.where(cutting.from_home[:, None], path.end, path.start)
    low, high = extents(path)
    low, high = np.minimum(low, begin), np.maximum(high, begin)
    tools, which = cutting.tools, cutting.which
    if path.lathe and _turns(stock):
        beside = np.array([_beside(tool) for tool in tools])[which]
        inner = np.logical_or.accumulate(np.array([tool.kind not in OUTER for tool in tools])[which]) | (stock.bore > 0)
        low[:, 0] = np.where(inner, -np.inf, low[:, 0] - beside[:, 0])
        low[:, 2] -= beside[:, 1]
        high[:, 2] += beside[:, 1]
        low[:, 1], high[:, :2] = -np.inf, np.inf
        touches = low[:, 0] < stock.bounds[1, 0]
    else:
        radius = np.array([max(tool.effective_radius, 0.0) for tool in tools])[which]
        low[:, :2] -= radius[:, None]
        high[:, :2] += radius[:, None]
        high[:, 2] = np.inf
        touches = low[:, 2] < stock.bounds[1, 2]
    moved = (cutting.cuts & touches)[:, None]
    return Taken(np.where(moved, low, np.inf), np.where(moved, high, -np.inf))


def _beside(tool: Tool) -> tuple[float, float]:
    """How far a lathe tool may cut nearer to the axis than its tip, and along the bar."""
    return 2 * tool.corner + tool.width + 1, INSERT + tool.width + tool.effective_radius
