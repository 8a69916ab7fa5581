"""A rapid through the blank, where no move before it can have taken the material away.

Nothing is cut here: what a move may at most have taken is a box, as wide as the tool beside the move and open upwards (on a
lathe outwards), for below its tip nothing is gone. A place of a rapid that lies in the blank and in none of these boxes is
full. One box around all moves before is asked first, in a few passes over the columns; of short programs each box by itself.
So a rapid in a pocket is none. What a cycle does in a hole that was there before, and a rapid into the middle of a circle
that is milled afterwards (a thread in a drilled hole), is left to `Run.collisions`,
and so is what comes later than the first ten thousand rows: no run is to wait for this.
"""

from __future__ import annotations

from collections.abc import Iterator
from copy import copy
from typing import TYPE_CHECKING, NamedTuple, TypeGuard

import numpy as np

from mnclab.path.limits import extents
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Array, Index, Kind, Mask
from mnclab.runs.lint.once import has, once
from mnclab.runs.material import cutting_of
from mnclab.text.alarm import Alarm
from mnclab.workpiece.blank import Box, Revolved
from mnclab.workpiece.cutting import Cutting

if TYPE_CHECKING:
    from mnclab.runs.run import Run

DEEP = 0.1  # mm, below the surface of the blank and beside what may be cut
PLACES = 8  # of a rapid that are looked at
FIRST = 10_000  # rows that are judged
PAIRS = 1_000_000  # of rapids and moves before them, up to which each move is asked by itself
INSERT = 25.0  # mm, how far along the bar an insert may cut beside its tip
ON_THE_MACHINE = ("M91", "M92", "G53", "G28", "G30")  # places that count from where nobody may have set a datum
OUTER = ("", "turning", "grooving", "thread")  # lathe tools that cut on the side away from the axis, in a full bar
MESSAGE = "a rapid goes through the blank, where nothing has been cut before"


def remarks(run: Run) -> Iterator[Alarm]:
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
    if rows := [row for row in found.tolist() if not has(run, int(path.step[row]), *ON_THE_MACHINE)]:
        down = np.ptp([path.start[rows[0], :2], path.end[rows[0], :2]], axis=0).max() == 0
        hint = "a rapid ends above the material, the rest goes at feed" if down else "first Z above the part, then X and Y"
        if path.lathe:
            hint = "a rapid ends outside the bar, the rest goes at feed"
        yield once(run, np.unique(path.step[rows]).tolist(), MESSAGE, hint)


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
    """Places of rapids in the box around the blank (k, PLACES, 3), and which of them are in the blank, not just at it."""
    stock, end = cutting.stock, cutting.path.end[rows]
    start = np.where(cutting.from_home[rows, None], end, cutting.path.start[rows])
    low, high = stock.bounds + [[DEEP], [-DEEP]]
    way = end - start
    with np.errstate(divide="ignore", invalid="ignore"):
        sides = np.stack([(low - start) / way, (high - start) / way])
    still = way == 0
    begin = np.where(still, 0.0, sides.min(axis=0)).max(axis=1).clip(0, 1)
    over = np.where(still, 1.0, sides.max(axis=0)).min(axis=1).clip(0, 1)
    share = begin[:, None] + (over - begin)[:, None] * ((np.arange(PLACES) + 0.5) / PLACES)
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
