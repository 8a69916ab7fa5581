"""Look-ahead over a whole path: when the tool is where, and how fast.

1. `path.profile.motions`: what each row and each corner allows by itself, and what a look-ahead of some blocks does.
2. `path.profile.lookahead`: from that the speeds at the nodes between rows, by two scans.
3. `path.profile.lookahead`: arcs that do not reach their feed are cut finer and planned again.
4. `path.profile.smooth`: under a jerk limit, S-curves over groups of rows instead of trapezoids; arcs are cut into
   stages before (`path.profile.smooth`).
5. Rows without motion take their own time; rapids may run axis by axis (`path.profile.ramps`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mnclab.path.limits import Limits
from mnclab.path.places import divided
from mnclab.path.profile.lookahead import FEWEST, PART, Turns, reachable
from mnclab.path.profile.motions import PIECE, Rows, in_sight, measure, swings
from mnclab.path.profile.ramps import Rapids
from mnclab.path.profile.smooth import Groups, smooth, staged
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath
from mnclab.text.given import check_number
from mnclab.text.tables import shapes

SURFACE = 64  # parts of a row at constant cutting speed, in each of which the feed is constant


@dataclass
class PlannedRows:
    """The planned rows (n,) of `path`; `row` (n,) of the path that was asked for, None if they are the same.

    `v` (n + 1,) the speeds at the nodes, `top` (n,) the greatest speed within a row (mm, s), `seconds` (n,); `groups`
    under a jerk limit. `ramps` are rows that are one ramp from end to end, the others speed up and brake with `rows.a`, which no
    row goes beyond: of a ramp it is the most in its direction, of a rapid whose axes go by themselves that of all together.
    """

    path: Toolpath
    row: Index | None
    rows: Rows
    v: Array
    top: Array
    seconds: Array
    rapids: Rapids | None = None
    ramps: Index | None = None
    groups: Groups | None = None

    __repr__ = shapes


def plan(
    path: Toolpath, limits: Limits, override: float = 1.0, rapid_motion: str = "line", waits: Mask | None = None
) -> PlannedRows:  # fmt: skip
    """Plan a path under limits; `override` is the feed override, 1 for 100 %.

    `rapid_motion` holds unless the limits say otherwise; `waits` (n,) says which SPINDLE rows wait until the spindle
    has its speed (MNC: G26), all by default. An Alarm for an override outside 0.001 … 100.
    """
    check_number(override, "the feed override (1 for 100 %)", above=0, at_least=0.001, at_most=100)
    override = float(override)
    row = None
    turning = np.isfinite(path.surface) & np.isfinite(path.per_rev)
    if turning.any():
        path, row = divided(path, np.where(turning & path.is_motion, SURFACE, 1))
        waits = None if waits is None else waits[row]
    rows = measure(path, limits, override)
    in_sight(rows, row, limits.look_ahead)
    if len(rows.j):
        if (cut := staged(path, rows, limits)) is not None:
            path, inner = cut.path, cut.inner
            row, waits = cut.part if row is None else row[cut.part], None if waits is None else waits[cut.part]
            rows = measure(path, limits, override, turning=cut.turning)
            rows.corner[inner] = np.minimum(rows.cap[inner - 1], rows.cap[inner])
            in_sight(rows, row, limits.look_ahead)
        w = reachable(rows.corner, 2 * rows.a * rows.length)
        v, top, seconds, groups = smooth(rows, w) if cut is None else smooth(rows, w, cut.knots, cut.bound)
        found = PlannedRows(path, row, rows, v, top, seconds, groups=groups)
    else:
        found = _trapezoids(path, row, rows)
        slow = (path.kind == Kind.ARC) & (rows.length > 0)
        slow[slow] = found.top[slow] < rows.feed[slow] * (1 - 1e-12)
        if slow.any():  # arcs that do not reach their feed
            found, parts = _turned(found, slow, limits, override)
            waits = None if waits is None else waits[parts]
            path, rows = found.path, found.rows
    _events(found, limits, waits)
    motion = limits.rapid_motion or rapid_motion
    if motion != "line" and (rapid := np.flatnonzero((path.kind == Kind.RAPID) & (rows.length > 0) & ~swings(path))).size:
        found.rapids = Rapids(path, rapid, limits, motion)
        found.seconds[rapid], rows.a[rapid] = found.rapids.seconds, found.rapids.most
    return found


def _trapezoids(path: Toolpath, row: Index | None, rows: Rows, w: Array | None = None) -> PlannedRows:
    """Speeds at the nodes (v² may be given) and times of the rows, each up, along and down at constant acceleration."""
    n = len(path)
    gain = 2 * rows.a
    gain *= rows.length
    if w is None:
        w = reachable(rows.corner, gain)
    v, top, seconds = np.sqrt(w), np.empty(n), np.empty(n)
    for i in range(0, n, PIECE):
        part = slice(i, min(n, i + PIECE))
        w0, w1, g, a = w[i:-1][:PIECE], w[i + 1 :][:PIECE], gain[part], rows.a[part]
        both = w0 + w1
        high = np.minimum(rows.cap[part], 0.5 * (both + g))
        np.maximum(high, np.maximum(w0, w1), out=high)
        root = np.sqrt(high, out=top[part])
        rest = g - (2 * high - both)  # 2 a times what is run at the top
        np.maximum(rest, 0.0, out=rest)
        with np.errstate(divide="ignore", invalid="ignore"):
            rest /= 2 * root
        rest += 2 * root - v[i:-1][:PIECE] - v[i + 1 :][:PIECE]
        np.divide(rest, a, out=seconds[part])
    seconds[rows.length == 0] = 0.0
    return PlannedRows(path, row, rows, v, top, seconds)


def _turned(found: PlannedRows, slow: Mask, limits: Limits, override: float) -> tuple[PlannedRows, Index]:
    """The plan with some arcs cut finer, and the row (m,) that each of its rows was part of."""
    counts = np.where(slow, np.maximum(np.ceil(np.abs(found.path.sweep) / PART), FEWEST), 1).astype(np.int64)
    path, part = divided(found.path, counts)
    turns = Turns(path, np.flatnonzero(slow[part]), np.append(0, np.cumsum(counts[slow])), limits)
    caps = np.full(len(path), np.nan)
    caps[turns.rows] = turns.cap
    rows = measure(path, limits, override, caps)
    inner = np.setdiff1d(turns.rows, turns.rows[turns.first[:-1]])  # no corners, if both ends of an arc miss its circle
    rows.corner[inner] = np.minimum(rows.cap[inner - 1], rows.cap[inner])
    row = part if found.row is None else found.row[part]
    in_sight(rows, row, limits.look_ahead)
    w = turns.speeds_at(rows.corner, rows.a, rows.length)
    w0, w1 = w[turns.rows], w[turns.rows + 1]
    again = _trapezoids(path, row, rows, w)
    again.ramps, again.rows.a[turns.rows] = turns.rows, turns.most_of(w0, w1)
    again.top[turns.rows] = np.sqrt(np.maximum(w0, w1))
    again.seconds[turns.rows] = 2 * turns.length / (np.sqrt(w0) + np.sqrt(w1))
    return again, part


def _events(found: PlannedRows, limits: Limits, waits: Mask | None) -> None:
    """Time for dwells, tool changes and for the spindle to reach its speed."""
    kind, seconds = found.path.kind, found.seconds
    if (turns := (found.rows.length == 0) & np.isfinite(found.path.time)).any():  # rotary axes alone
        seconds[turns] = found.path.time[turns]
    events = np.flatnonzero(kind > Kind.PROBE)
    if not len(events):
        return
    seconds[events] = 0.0
    kinds = kind[events]
    dwell = events[kinds == Kind.DWELL]
    seconds[dwell] = np.nan_to_num(found.path.time[dwell])
    seconds[events[kinds == Kind.TOOL]] = limits.tool_change
    if limits.spindle_acceleration is not None:
        starts = events[kinds == Kind.SPINDLE]
        speed = np.clip(found.path.spindle, -limits.spindle, limits.spindle)
        before = np.where(starts > 0, speed[starts - 1], 0.0)
        time = np.abs(speed[starts] - before) / limits.spindle_acceleration
        seconds[starts] = time if waits is None else np.where(waits[starts], time, 0.0)
