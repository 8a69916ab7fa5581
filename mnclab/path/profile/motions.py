"""What each row allows: its length, greatest speed and acceleration along the path, and the speeds at its ends."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from mnclab.path.feeds import spindle_speed
from mnclab.path.limits import Limits
from mnclab.path.places import Bends
from mnclab.path.profile.lookahead import running_sum
from mnclab.path.profile.ramps import gain
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath
from mnclab.text.tables import shapes

# How fast a corner is taken: the square of the speed from the two tangents that meet there.
# With Δu the difference of the unit tangents (per axis Δu_k), a_k and j_k the limits of the axes, ε the corner tolerance:
# **tolerance**
#     The corner is replaced by a piece in which the velocity changes from v u1 to v u2 in a time T. A constant
#     acceleration needs T = v max(|Δu_k| / a_k) and leaves the corner by e = v |Δu| T / 8, so
#     `v² = 8 ε / (|Δu| max(|Δu_k| / a_k))`. This is the parabolic blend of J. J. Craig, *Introduction to Robotics*,
#     ch. 7. Under a jerk limit the acceleration rises and falls in a triangle, T = 2 v max(|Δu_k| / a_k) or
#     2 sqrt(v max(|Δu_k| / j_k)), whichever is longer, and e = v |Δu| T / 12. The piece must fit into half of either
#     neighbour: `v T <= the shorter one`.
# **deviation**
#     A circle touches both legs and leaves the corner by ε; it is run with v² = a r:
#     `v² = a ε sin(β/2) / (1 - sin(β/2))`, β the angle between the legs (180° is straight on) and a the least of the
#     path accelerations of the two rows and of what the axes bear along Δu. S. K. Jeon, "Improving Grbl: Cornering
#     Algorithm" (2011). The circle touches neither leg beyond its middle, `v² <= a l tan(β/2) / 2` with l the shorter
#     one: so plan Klipper (move_centripetal_v2) and Marlin (limit_sqr), and short lines of a curve keep to v² = a r.
# **grbl**
#     The same as Grbl 1.1 plans it (planner.c): a along Δu alone, and however short the legs are. On short lines of a
#     curve the axes are asked for more than they have.
# **jump**
#     The speed of an axis may jump by s_k: `v = min(s_k / |Δu_k|)`. Marlin calls this classic jerk.
#     Many short lines that stand for a curve, |Δu| l / 8 <= ε with l the mean length of the neighbours, may share their
#     acceleration: it follows the curvature κ = Δu / l of each corner, goes over into that of the next corner within the
#     row between them, and so `v² <= min(a_k / |κ_k|)` and `v³ <= min(j_k L / |κ_k' - κ_k|)`. The greater speed counts
#     under "tolerance", the smaller one under "deviation".
# Tangents that differ by less than `TANGENT` are no corner: rounded coordinates make tangent joints miss by that. But where
# they follow each other in short rows they are a curve: but for "grbl" and "jump" `v² <= l / max(|Δu_k| / a_k)` holds.
# Under a jerk limit a joint of line and arc is a corner too, for the centripetal acceleration v² Δκ begins at once. Spread
# over the time T = v² max(|Δκ_k| / j_k) it leaves the path by v² |Δκ| T² / 24, hence
# `v⁶ = 24 ε / (|Δκ| max(|Δκ_k| / j_k)²)`.

TANGENT = 5e-4  # rad

Columns = Sequence[Array]  # X, Y and Z
Slack = float | Array  # how far a corner may be cut, mm; one for all, or one a corner
Pair = tuple[Array, Array]  # of the row before the corner and the row after it
Rule = Callable[[Columns, Columns, Pair, Pair, Slack], Array]


def corner_rule(limits: Limits) -> Rule:
    """v² (m,) from the tangents before and after, the path accelerations and the lengths of both rows, and the tolerance."""
    jerks, jumps = limits.axes("jerk"), limits.axes("corner_jump")
    smooth, own = bool(np.isfinite(jerks).any()), limits.corner_speed == "grbl"

    def tolerance(before: Columns, after: Columns, accelerations: Pair, lengths: Pair, slack: Slack) -> Array:
        turn, slow, slower = _changes(before, after, limits.axes("acceleration"), jerks if smooth else None)
        short = np.minimum(*lengths)
        with np.errstate(divide="ignore", invalid="ignore"):  # straight on, or a row of no length
            room = np.fmin(short / slow, np.inf)
            if not np.any(slack):
                return np.where(turn < TANGENT, room, 0.0)
            if not smooth:
                w = np.minimum(8 * slack / (turn * slow), room)
            else:
                w = np.minimum(6 * slack / (turn * slow), short / (2 * slow))
                w = np.minimum(w, (6 * slack / (turn * np.sqrt(slower))) ** (4 / 3))
                w = np.minimum(w, (short / (2 * np.sqrt(slower))) ** (4 / 3))
        straight = turn < TANGENT
        w[straight] = room[straight]
        return w

    def deviation(before: Columns, after: Columns, accelerations: Pair, lengths: Pair, slack: Slack) -> Array:
        turn, slow, _ = _changes(before, after, limits.axes("acceleration"), None)
        half = turn * turn
        half *= -0.25
        half += 1.0
        np.sqrt(np.maximum(half, 0.0, out=half), out=half)  # sin(β/2) = cos(turn / 2)
        with np.errstate(divide="ignore", invalid="ignore"):  # straight on
            w = np.fmin(turn / slow, 1e12 if own else np.minimum(*accelerations))
            room = np.minimum(*lengths) * half / slow
        straight = np.flatnonzero(turn < TANGENT)
        half[straight] = 1.0 - TANGENT**2 / 8
        w *= slack
        w *= half
        w /= 1.0 - half
        w[straight[np.broadcast_to(slack, len(w))[straight] == 0]] = np.inf
        return w if own else np.fmin(w, room, out=w)

    def jump(before: Columns, after: Columns, accelerations: Pair, lengths: Pair, slack: Slack) -> Array:
        w, turn = np.full(len(before[0]), np.inf), np.zeros(len(before[0]))
        with np.errstate(divide="ignore", invalid="ignore"):
            for b, c, most in zip(before, after, jumps):
                change = np.abs(c - b)
                turn += change**2
                w = np.fmin(w, (most / change) ** 2)
        w[turn < TANGENT**2] = np.inf
        return w

    return {"tolerance": tolerance, "deviation": deviation, "grbl": deviation, "jump": jump}[limits.corner_speed]


def _changes(before: Columns, after: Columns, accelerations: Array, jerks: Array | None) -> tuple[Array, Array, Array]:
    """|Δu|, max(|Δu_k| / a_k) and max(|Δu_k| / j_k), each (m,)."""
    turn, slow, slower = (np.zeros(len(before[0])) for _ in range(3))
    for k in range(3):
        change = after[k] - before[k]
        turn += change * change
        np.abs(change, out=change)
        np.maximum(slow, change / accelerations[k], out=slow)
        if jerks is not None:
            np.maximum(slower, change / jerks[k], out=slower)
    return np.sqrt(turn, out=turn), slow, slower


def tolerances(path: Toolpath, limits: Limits) -> Slack:
    """How far the corners (n - 1,) between rows may be cut: what the program allows on both rows, or else the limits."""
    if np.isnan(path.tolerance).all():
        return limits.corner_tolerance
    own = np.where(np.isnan(path.tolerance), limits.corner_tolerance, path.tolerance)
    return np.minimum(own[1:], own[:-1])


def bend_joints(before: Array, after: Array, limits: Limits, slack: Slack) -> Array:
    """v² (m,) where the curvature vector (m, 3) changes, under a jerk limit."""
    change = np.abs(after - before)
    slow = (change / limits.axes("jerk")).max(axis=1)
    size = np.linalg.norm(change, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        w = np.cbrt(24 * slack / (size * slow**2))
    largest = np.maximum(np.linalg.norm(before, axis=1), np.linalg.norm(after, axis=1))
    return np.where(size <= TANGENT * largest, np.inf, w)


def curves(path: Toolpath, length: Array, limits: Limits, slack: Slack) -> Array:
    """v² (n - 1,) at the corners between rows that are short lines of a curve, 0 elsewhere; under a jerk limit.
    `length` (n,) is that of the rows."""
    n, lines = len(length), (path.kind == Kind.LINE) & (length > 0)
    w = np.zeros(max(n - 1, 0))
    for i in range(0, n - 1, PIECE):
        j = min(n - 1, i + PIECE)
        first, last = max(i - 1, 0), min(j + 2, n)  # rows, those beside the ones about the corners too
        rows, here = length[first:last], slice(i - first, j - first)
        corner = lines[first + 1 : last] & lines[first : last - 1]
        mean = np.where(corner, (rows[1:] + rows[:-1]) / 2, 1.0)
        turned, slow, slower = np.zeros(len(mean)), np.zeros(len(mean)), np.zeros(len(rows))
        with np.errstate(divide="ignore", invalid="ignore"):
            for k, (acceleration, jerk) in enumerate(zip(limits.axes("acceleration"), limits.axes("jerk"))):
                turn = np.where(corner, np.diff((path.end[first:last, k] - path.start[first:last, k]) / rows), 0.0)
                turned += turn * turn
                turn /= mean  # the curvature
                np.maximum(slow, np.abs(turn) / acceleration, out=slow)
                np.maximum(slower, np.abs(np.diff(turn, prepend=0.0, append=0.0)) / jerk, out=slower)
            cubed = rows / slower
            found = np.minimum(1 / slow, np.cbrt(np.minimum(cubed[1:], cubed[:-1])) ** 2)
        cut = slack[first : last - 1] if isinstance(slack, np.ndarray) else slack
        fits = corner & (np.sqrt(turned) * mean <= 8 * cut)
        w[i:j] = np.where(fits, found, 0.0)[here]
    return w


# Speeds are squared, w = v², in mm²/s²; lengths mm; accelerations mm/s². A straight row with the unit vector u is held by
# its slowest axis: v <= min(V_k / |u_k|), a <= min(A_k / |u_k|). On an arc each axis sees the path acceleration a and the
# centripetal one, v² / r, at a phase that turns, so that over a full turn `(c a)² + (v²/r)² <= A_k²` must hold (c the
# share of the motion in the plane). `path.profile.lookahead` looks closer where that costs time.
# Rows are worked on in pieces that stay in the processor's cache.

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
    rule, slack = corner_rule(limits), tolerances(path, limits)
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
            w = curves(path, rows.length, limits, slack)
            corner = rows.corner[1:-1]
            if limits.corner_speed == "tolerance":
                np.maximum(corner, np.minimum(w, np.minimum(rows.cap[1:], rows.cap[:-1])), out=corner)
            else:
                np.minimum(corner, w, out=corner, where=w > 0)
        _bend_joints(path, rows, limits, slack)
    _stops(path, rows)
    _swing_evenly(path, rows)
    return rows


def _slowest(size: list[Array], limits: Array) -> Array:
    """max(|u_k| / limit_k) (m,)."""
    most = size[0] * (1 / limits[0])
    np.maximum(most, size[1] * (1 / limits[1]), out=most)
    return np.maximum(most, size[2] * (1 / limits[2]), out=most)


def swings(path: Toolpath) -> Mask:
    """The rows (n,) in which rotary axes turn that swing the tip."""
    if path.kinematics is None:
        return np.zeros(len(path), bool)
    return np.asarray((np.diff(path.rotary, axis=0, prepend=path.rotary[:1]) != 0).any(axis=1))


def _swing_evenly(path: Toolpath, rows: Rows) -> None:
    """No corners within a block that swings the tip: its rows are chords, while all axes run evenly."""
    some = swings(path)
    within = some[1:] & some[:-1] & (path.step[1:] == path.step[:-1])
    rows.corner[1:-1][within] = np.minimum(rows.cap[1:], rows.cap[:-1])[within]


def _stops(path: Toolpath, rows: Rows) -> None:
    """No speed at the ends, at exact stops, about events, and about rapids and probing (MNC 3.5.2: G64 leaves them out)."""
    rows.corner[0] = rows.corner[-1] = 0.0
    if path.exact.any():
        rows.corner[1:][path.exact] = 0.0
    alone = (path.kind == Kind.RAPID) | (path.kind >= Kind.PROBE)
    if alone.any():
        rows.corner[:-1][alone] = rows.corner[1:][alone] = 0.0


def in_sight(rows: Rows, block: Index | None, ahead: int | None) -> None:
    """Hold the nodes at speeds from which the tool can stop where the blocks end that the control knows.

    It knows the block that it runs and `ahead` more (None: all of them), and what comes then may be a stop. `block` (n,)
    says which block each row is a part of, None: the rows are the blocks. Under a jerk limit the least acceleration and
    jerk among these rows hold for all of them.
    """
    if ahead is None or not len(rows.length):
        return
    ends = np.arange(1, len(rows.corner)) if block is None else np.flatnonzero(np.diff(block, append=-1)) + 1
    nodes = np.flatnonzero(rows.corner)
    last = ends[np.minimum(np.searchsorted(ends, nodes) + ahead, len(ends) - 1)]
    stops = np.flatnonzero(rows.corner == 0)
    unseen = last < stops[np.searchsorted(stops, nodes)]  # a stop that is seen is planned as it is
    nodes, last = nodes[unseen], last[unseen]
    behind = running_sum(rows.length if len(rows.j) else 2 * rows.a * rows.length)
    w = behind[last] - behind[nodes]
    if len(rows.j) and len(nodes):
        a, j = np.minimum.reduceat((rows.a, rows.j), np.stack([nodes, last], axis=1).ravel(), axis=1)[:, ::2]
        w = np.where(w > 0, gain(np.zeros(len(w)), w, a, j), 0.0) ** 2
    rows.corner[nodes] = np.minimum(rows.corner[nodes], w)


def _bend_joints(path: Toolpath, rows: Rows, limits: Limits, slack: Slack) -> None:
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
    held = bend_joints(at_end[nodes], at_start[nodes], limits, slack)
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
