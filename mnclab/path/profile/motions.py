"""What each row allows: its length, greatest speed and acceleration along the path, and the speeds at its ends.

Speeds are squared, w = v², in mm²/s²; lengths mm; accelerations mm/s². A straight row with the unit vector u is held by
its slowest axis: v <= min(V_k / |u_k|), a <= min(A_k / |u_k|). On an arc each axis sees the path acceleration a and the
centripetal one, v² / r, at a phase that turns, so that over a full turn `(c a)² + (v²/r)² <= A_k²` must hold (c the
share of the motion in the plane). `path.profile.turns` looks closer where that costs time.

Rows are worked on in pieces that stay in the processor's cache.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mnclab.path.columns import Array
from mnclab.path.cutting_speed import spindle_speed
from mnclab.path.kinds import Kind
from mnclab.path.limits import Limits
from mnclab.path.profile import corner_speeds
from mnclab.path.profile.bends import Bends
from mnclab.path.toolpath import Toolpath
from mnclab.text.tables import shapes

PIECE = 1 << 15  # rows worked on at a time
FULL = 0.9  # of an arc's acceleration may be centripetal; the rest is left for speeding up and braking
TURNING, BRAKING = 0.3, 0.6  # of the jerk on an arc: the part that turning takes at most, and that turning while braking takes


@dataclass
class Rows:
    """Columns (n,) of a path for the planner, and `corner` (n + 1,): the greatest w at the nodes between its rows.

    `feed` is what the program asks for, mm/s (inf for rapids); `cap` the greatest w, `a` the greatest acceleration
    either way, `j` the jerk mm/s³ along the path (empty without a jerk limit). Events have no length and cap 0.
    """

    length: Array
    feed: Array
    cap: Array
    a: Array
    j: Array
    corner: Array

    __repr__ = shapes


def feeds(path: Toolpath, begin: int, end: int, length: Array, limits: Limits, override: float) -> Array:
    """The programmed feed of some rows, mm/s; inf where the axes alone decide.

    Per minute, per revolution (with the speed that the spindle has: the programmed one, not above its limit), in a given
    time (inverse time feed), or at constant cutting speed, with the spindle speed of the middle of the row.
    """
    part = slice(begin, end)
    feed = path.feed[part] * (override / 60)
    per_rev = path.per_rev[part]
    if not np.isnan(per_rev).all():
        turning = np.abs(path.spindle[part])
        surface = path.surface[part]
        if not np.isnan(surface).all():
            middle = (path.start[part, 0] + path.end[part, 0]) / 2 - path.spindle_x[part]
            turning = np.where(np.isnan(surface), turning, spindle_speed(surface, middle, path.speed_limit[part]))
        turning = np.minimum(turning, limits.spindle)
        feed = np.where(np.isfinite(per_rev), per_rev * turning * (override / 60), feed)
    time = path.time[part]
    if not np.isnan(time).all():
        with np.errstate(divide="ignore", invalid="ignore"):
            feed = np.where(time > 0, length / time * override, feed)
    synchronous = path.synchronous[part]
    if synchronous.any():
        feed = np.where(synchronous, path.feed[part] / 60, feed)
    return np.where(np.isnan(feed), np.inf, feed)


def measure(
    path: Toolpath, limits: Limits, override: float = 1.0, caps: Array | None = None, turning: Array | None = None
) -> Rows:  # fmt: skip
    """What the rows of a path allow; `caps` (n,), where they are numbers, replace what all of an arc would allow, and
    `turning` (n,) says which part of the jerk an arc may turn with."""
    n = len(path)
    speeds, slowest, jerks = (limits.axes(name) for name in ("rapid", "acceleration", "jerk"))
    jerky = bool(np.isfinite(jerks).any())
    rows = Rows(np.empty(n), np.empty(n), np.empty(n), np.empty(n), np.empty(n if jerky else 0), np.zeros(n + 1))
    rule, slack = corner_speeds.rule(limits), corner_speeds.tolerances(path, limits)
    last: list[Array] = []  # the tangent at the end of the piece before
    for i in range(0, n, PIECE):
        j = min(n, i + PIECE)
        kind = path.kind[i:j]
        d = [path.end[i:j, k] - path.start[i:j, k] for k in range(3)]
        length = d[0] * d[0]
        length += d[1] * d[1]
        length += d[2] * d[2]
        np.sqrt(length, out=length)
        arcs = np.flatnonzero(kind == Kind.ARC)
        if len(arcs):
            length[arcs] = path.lengths[i:j][arcs]
        if kind.max() > Kind.PROBE:
            length[kind > Kind.PROBE] = 0.0
        still = None if length.all() else np.flatnonzero(length == 0)  # events, and what does not move
        if still is not None:
            length[still] = 1.0
        for each in d:
            each /= length
        size = [np.abs(each) for each in d]
        feed = feeds(path, i, j, length, limits, override)
        with np.errstate(divide="ignore", over="ignore"):
            cap = np.minimum(1 / _slowest(size, speeds), feed)
            a = 1 / _slowest(size, slowest)
            if jerky:
                rows.j[i:j] = 1 / _slowest(size, jerks)
        cap *= cap
        before = after = d
        if len(arcs):
            bends = Bends(path[i:j], arcs, length[arcs])
            share = TURNING if turning is None else turning[i:j][arcs]
            cap[arcs], a[arcs], found = allowed(bends, feed[arcs], limits, share)
            if jerky:
                rows.j[i:j][arcs] = found
            if caps is not None:
                cap = np.where(np.isnan(caps[i:j]), cap, np.minimum(caps[i:j], feed * feed))
            after = [each.copy() for each in d]
            for k, (at_start, at_end) in enumerate(zip(bends.tangent(0.0).T, bends.tangent(1.0).T)):
                after[k][arcs], before[k][arcs] = at_start, at_end
        if still is not None:
            cap[still], a[still], length[still] = 0.0, 1.0, 0.0
        rows.length[i:j], rows.feed[i:j], rows.cap[i:j], rows.a[i:j] = length, feed, cap, a
        first, second = (
            slice(max(i - 1, 0), j - 1),
            slice(max(i - 1, 0) + 1, j),
        )  # the rows before and after the corners
        joined = [np.concatenate([one, each[:-1]]) for one, each in zip(last, before)] or [each[:-1] for each in before]
        accelerations, lengths = (rows.a[first], rows.a[second]), (rows.length[first], rows.length[second])
        cut = slack[first] if isinstance(slack, np.ndarray) else slack
        w = rule(joined, after if i else [each[1:] for each in after], accelerations, lengths, cut)
        np.minimum(w, rows.cap[first], out=w)
        np.minimum(w, rows.cap[second], out=rows.corner[second])
        last = [each[-1:].copy() for each in before]
    if jerky:
        if limits.corner_speed in ("tolerance", "deviation") and np.any(slack):
            lines = (path.kind == Kind.LINE) & (rows.length > 0)
            with np.errstate(divide="ignore", invalid="ignore"):
                tangent = (path.end - path.start) / rows.length[:, None]
            w = corner_speeds.curves(tangent, rows.length, lines, limits, slack)
            corner = rows.corner[1:-1]
            if limits.corner_speed == "tolerance":
                np.maximum(corner, np.minimum(w, np.minimum(rows.cap[1:], rows.cap[:-1])), out=corner)
            else:
                np.minimum(corner, w, out=corner, where=w > 0)
        _bend_joints(path, rows, limits, slack)
    _stops(path, rows)
    return rows


def _slowest(size: list[Array], limits: Array) -> Array:
    """max(|u_k| / limit_k) (m,)."""
    most = size[0] * (1 / limits[0])
    np.maximum(most, size[1] * (1 / limits[1]), out=most)
    return np.maximum(most, size[2] * (1 / limits[2]), out=most)


def _stops(path: Toolpath, rows: Rows) -> None:
    """No speed at the ends, at exact stops, about events, and about rapids and probing (MNC 3.5.2: G64 leaves them out)."""
    rows.corner[0] = rows.corner[-1] = 0.0
    if path.exact.any():
        rows.corner[1:][path.exact] = 0.0
    alone = (path.kind == Kind.RAPID) | (path.kind >= Kind.PROBE)
    if alone.any():
        rows.corner[:-1][alone] = rows.corner[1:][alone] = 0.0


def _bend_joints(path: Toolpath, rows: Rows, limits: Limits, slack: corner_speeds.Slack) -> None:
    """Under a jerk limit, hold the nodes where an arc begins or ends."""
    arcs = np.flatnonzero((path.kind == Kind.ARC) & (rows.length > 0))
    if not len(arcs):
        return
    bends = Bends(path, arcs, rows.length[arcs])
    at_start, at_end = np.zeros((len(path) + 1, 3)), np.zeros((len(path) + 1, 3))
    at_start[arcs], at_end[arcs + 1] = bends.curvature(0.0), bends.curvature(1.0)
    nodes = np.unique(np.concatenate([arcs, arcs + 1]))
    if isinstance(slack, np.ndarray):  # nobody passes the ends at speed
        slack = np.pad(slack, 1, mode="edge")[nodes] if len(slack) else 0.0
    held = corner_speeds.bend_joints(at_end[nodes], at_start[nodes], limits, slack)
    rows.corner[nodes] = np.minimum(rows.corner[nodes], held)


def allowed(bends: Bends, feed: Array, limits: Limits, turning: Array | float = TURNING) -> tuple[Array, Array, Array]:
    """w, a and jerk (m,) along arcs that no axis can object to, wherever on the arc; `turning`: the part of the jerk
    that turning at w may take.

    With h the part of a circle that an axis sees, c h and p its slopes on circle and pitch, κ the curvature, ω = sweep/L:
    `v (c h + p) <= V`, `(c h a)² + (h κ v²)² <= (A - p a)²`, and for the jerk j along the path
    `(c h + p)² [(j + ω² v³)² + (3 ω v a)²] <= J²`, or p j <= J on an axis that sees nothing of the circle.
    """
    speeds, accelerations, jerks = (limits.axes(name) for name in ("rapid", "acceleration", "jerk"))
    h = np.maximum(bends.seen, 1e-12)
    turn = np.abs(bends.rate)
    circle = (bends.radius * turn)[:, None] * h
    pitch = np.abs(bends.drift) / bends.length[:, None]
    bend = bends.bend[:, None] * h
    v = np.minimum(feed, (speeds / (circle + pitch)).min(axis=1))
    full = FULL + (1 - FULL) * (turning - TURNING) / (1 - TURNING)
    v = np.minimum(v, np.sqrt(full * (accelerations / bend).min(axis=1)))
    each = jerks / (circle + pitch)
    across = h < 1e-6
    most = np.where(across, np.inf, each).min(axis=1)
    v = np.minimum(v, np.cbrt(turning * most / turn**2))
    w = v * v
    left = accelerations**2 - (bend * w[:, None]) ** 2
    both = accelerations * pitch
    root = np.sqrt(np.maximum(both**2 + (circle**2 - pitch**2) * left, 0.0))
    a = (left / (both + root)).min(axis=1)
    if not np.isfinite(jerks).any():
        return w, a, most
    straight = np.where(across, each, np.inf).min(axis=1)
    a = np.minimum(a, BRAKING * np.sqrt((1 - np.square(turning)) / (1 - TURNING**2)) * most / (3 * turn * v))
    with np.errstate(invalid="ignore"):  # none of the jerks in the plane is limited
        j = most * (np.sqrt(1 - (3 * turn * v * a / most) ** 2) - turn**2 * v**3 / most)
    return w, a, np.fmin(j, straight)
