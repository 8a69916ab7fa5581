"""The planner under a jerk limit: S-curves over groups of rows.

A jerk limit is not additive in v², so the scans of the look-ahead do not carry over. Instead:

1. Nodes at which the acceleration is zero, the *knots*, are chosen: stops, ends of rows that are long against a ramp,
   sharp corners among gentle ones, changes of feed, and otherwise one in every `SHARE` of the length of a ramp
   from rest to the greatest speed between two stops. The rows between two knots are a *group*; it has the least speed,
   acceleration and jerk of its rows and of the corners inside it.
2. The acceleration alone bounds the speeds at the knots from above, by the two scans.
3. Where a ramp between two knots does not fit into its group, its faster end is slowed to what does; this may unsettle
   the neighbours, so it is repeated for these. Should `ROUNDS` not be enough, a scan that needs no repetition
   settles the stretches that are left: within the time that a group takes at its greatest speed, any change of speed
   that is possible at all fits into its length.
4. Every group is one move of up to seven phases (`path.profile.ramps`).

No limit is exceeded, but it costs time against the optimum: the acceleration is zero at every knot, a group is as slow as
its slowest part, and arcs share their jerk between turning and braking by fixed parts, in stages. A single move is optimal; on
contours with long rows only corners that are taken at speed cost a little; on chains of short rows the ramps from and to
stops take about 1.2 to 2 times as long as the best, and what runs at its feed costs nothing.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.curves import counted
from mnclab.path.limits import Limits
from mnclab.path.places import Bends, divided
from mnclab.path.profile import ramps
from mnclab.path.profile.lookahead import reachable, running_sum
from mnclab.path.profile.motions import TANGENT, TURNING, Rows, allowed
from mnclab.path.toolpath import Array, Index, Kind, Mask, Toolpath

SHARE = 0.5  # of a ramp from rest to the greatest speed: the least length of a group of short rows
SHARP = 0.64  # of its neighbours: a corner with less v² gets a knot
ROUNDS = 200
STEPS = 60  # of Newton for the time at a place; seven or so are usual


class Groups:
    """Moves over groups of rows: `knots` (g + 1,) are nodes of the path, with the speeds `v` (g + 1,).

    `length`, `a`, `j` (g,) are those of the groups, and `above` by how much their peak is above the greater of
    their ends. For the rows (n,) of the path: `group`, and `since`, the time from its start to that of the row.
    """

    def __init__(self, knots: Index, length: Array, v: Array, cap: Array, a: Array, j: Array) -> None:
        self.knots, self.length, self.v, self.a, self.j = knots, length, v, a, j
        self.above = ramps.peak(length, v[:-1], v[1:], cap, a, j)
        self.top = np.maximum(v[:-1], v[1:]) + self.above
        many = np.diff(knots)
        self.group: Index = np.arange(len(many)) if len(many) == knots[-1] else np.repeat(np.arange(len(many)), many)
        self.since = np.zeros(knots[-1])

    def phases(self, which: Index | slice = slice(None)) -> tuple[Array, tuple[Array, Array, Array, Array]]:
        """Seconds (k, 7) of the phases of some groups; place, speed, acceleration and jerk at the start of each."""
        v0, a, j = self.v[:-1][which], self.a[which], self.j[which]
        seconds = ramps.phases(self.length[which], v0, self.v[1:][which], self.above[which], a, j)
        return seconds, ramps.starts(seconds, v0, a, j)

    def times(self) -> tuple[Array, Array, Array]:
        """Seconds (g,) of the groups, and from when to when they are at their greatest speed."""
        up, down = (ramps.ramp_time(self.top - v, self.a, self.j) for v in (self.v[:-1], self.v[1:]))
        rest = self.length - 0.5 * ((self.v[:-1] + self.top) * up + (self.v[1:] + self.top) * down)
        cruise = np.divide(rest, self.top, out=np.zeros(len(rest)), where=rest > 0)
        return up + cruise + down, up, up + cruise

    def items(self, row_seconds: Array, left_out: Index) -> tuple[NDArray[np.generic], ...]:
        """Pieces: row, seconds, length, speed, acceleration, jerk; `left_out` rows have none. `row_seconds` (n,)
        is the time of the rows, which for rows without length is not in the groups."""
        seconds, starts = self.phases()
        ends = np.cumsum(seconds, axis=1)
        begins = ends - seconds
        used = seconds > 0
        phase = np.flatnonzero(used)  # of all phases of all groups, in order
        first = self.knots[:-1]
        inside = np.delete(np.arange(len(self.group)), first)  # rows that begin within a group
        at = np.concatenate([begins.ravel()[phase], self.since[inside]])
        group = np.concatenate([phase // 7, self.group[inside]])
        which = np.concatenate([phase, np.full(len(inside), -1)])
        row = np.concatenate([np.where(begins.ravel()[phase] == 0, first[phase // 7], -1), inside])
        order = np.lexsort((which < 0, at, group))
        at, group, which, row = at[order], group[order], which[order], row[order]
        which, row = np.maximum.accumulate(which), np.maximum.accumulate(row)
        until = np.append(at[1:], 0.0)
        last = np.append(group[1:] != group[:-1], True)[: len(group)]
        until[last] = ends[group[last], 6]
        dt = np.maximum(until - at, 0.0)
        tau = np.maximum(at - begins.ravel()[which], 0.0)
        v, a, j = (each.ravel()[which] for each in starts[1:])
        v, a = v + tau * (a + tau * j / 2), a + tau * j
        ds = dt * (v + dt * (a / 2 + dt * j / 6))
        kept = (dt > 0) & ~np.isin(row, left_out)
        found = [each[kept] for each in (row, dt, ds, v, a, j)]
        still = np.flatnonzero((seconds.sum(axis=1) == 0)[self.group] & (row_seconds > 0))
        still = still[~np.isin(still, left_out)]
        none = np.zeros(len(still))
        rest = [still, row_seconds[still], none, none, none, none]
        return tuple(np.concatenate(each) for each in zip(found, rest))


def smooth(
    rows: Rows, w: Array, given: Index | slice = slice(0), bound: Mask | bool = False
) -> tuple[Array, Array, Array, Groups]:
    """Speeds at the nodes (n + 1,), top speeds and times (n,) and the groups; `w` bounds v² at the nodes. Some knots may be
    `given`, between which the `bound` rows (n,) need no others."""
    n = len(rows.length)
    knots = _knots(rows, w, given, bound)
    first = knots[:-1]
    behind = running_sum(rows.length)
    length = np.diff(behind[knots])
    single = np.diff(knots) == 1
    length[single] = rows.length[first[single]]
    corner = rows.corner.copy()
    corner[knots] = np.inf
    cap = np.minimum(np.minimum.reduceat(rows.cap, first), np.minimum.reduceat(corner[:-1], first))
    a, j = np.minimum.reduceat(rows.a, first), np.minimum.reduceat(rows.j, first)
    edge = rows.corner[knots]
    edge[:-1] = np.minimum(edge[:-1], cap)
    edge[1:] = np.minimum(edge[1:], cap)
    v = _settle(np.sqrt(reachable(edge, 2 * a * length)), length, np.sqrt(cap), a, j)
    groups = Groups(knots, length, v, np.sqrt(cap), a, j)
    whole, peak_from, peak_to = groups.times()
    if len(first) == n:
        return v, groups.top, whole, groups
    nodes = np.zeros(n + 1)
    nodes[knots] = v
    at = np.delete(np.arange(n + 1), knots)
    groups.since[at], nodes[at] = _when(groups, groups.group[at], behind[at] - behind[first[groups.group[at]]])
    end = np.append(groups.since[1:], 0.0)
    end[knots[1:] - 1] = whole
    highest = (groups.since <= peak_to[groups.group]) & (end >= peak_from[groups.group])
    top = np.where(highest, groups.top[groups.group], np.maximum(nodes[:-1], nodes[1:]))
    return nodes, top, np.maximum(end - groups.since, 0.0), groups


def _knots(rows: Rows, w: Array, given: Index | slice, bound: Mask | bool) -> Index:
    """Nodes (g + 1,) at which the acceleration is zero, the first and the last among them."""
    n = len(rows.length)
    stops = np.flatnonzero(w[:-1] == 0)  # node 0 is one
    fastest = np.repeat(np.maximum.reduceat(w, stops), np.diff(np.append(stops, n)))  # between two stops
    v = np.sqrt(np.minimum(rows.cap, fastest))
    with np.errstate(divide="ignore", invalid="ignore"):
        share = rows.length / (SHARE * np.maximum(ramps.ramp_length(np.zeros(n), v, rows.a, rows.j), 1e-9))
    share = np.where(bound, 0.0, np.minimum(np.nan_to_num(share), 1.0))
    grid = np.floor(running_sum(share))
    chosen = np.zeros(n + 1, dtype=bool)
    chosen[0] = chosen[n] = True
    chosen[given] = True
    chosen[1:] |= grid[1:] != grid[:-1]
    chosen |= rows.corner == 0
    corner, cap = rows.corner, rows.cap
    chosen[1:n] |= np.minimum(cap[1:], cap[:-1]) < SHARP * np.maximum(cap[1:], cap[:-1])
    chosen[1:n] |= (corner[1:n] < SHARP * np.maximum(corner[:-2], corner[2:])) & (corner[1:n] <= w[1:n])
    alone = (share >= 1.0) | (rows.length == 0)  # an event is a group of its own
    chosen[:-1] |= alone
    chosen[1:] |= alone
    return np.flatnonzero(chosen)


def _settle(v: Array, length: Array, cap: Array, a: Array, j: Array) -> Array:
    """Speeds (g + 1,) not above `v` such that a ramp fits between any two neighbours."""
    v = v.copy()
    active = np.arange(len(length))
    for _ in range(ROUNDS):
        v0, v1 = v[active], v[active + 1]
        tight = ramps.ramp_length(v0, v1, a[active], j[active]) > length[active] * (1 + 1e-12)
        active, v0, v1 = active[tight], v0[tight], v1[tight]
        if not len(active):
            return v
        low, high = np.minimum(v0, v1), np.maximum(v0, v1)
        slower = np.minimum(low + ramps.gain(low, length[active], a[active], j[active]), high)
        node = active + (v1 > v0)
        np.minimum.at(v, node, slower)
        near = np.zeros(len(v) + 1, bool)  # the last stands for what is before the first
        near[node], near[node - 1] = True, True
        active = np.flatnonzero(near[: len(length)])
    with np.errstate(divide="ignore", invalid="ignore"):
        time = np.where(cap > 0, length / cap, 0.0)
    change = np.where(time > 2 * a / j, a * (time - a / j), j * time**2 / 4)
    settled = reachable(v, change)
    chain = np.cumsum(v == 0)
    left = np.isin(chain, np.unique(np.concatenate([chain[active], chain[active + 1]])))
    return np.where(left, settled, v)


def _when(groups: Groups, group: Index, place: Array) -> tuple[Array, Array]:
    """Time since the start of a group, and the speed, at places (k,) mm behind its start."""
    which, group = np.unique(group, return_inverse=True)
    seconds, starts = groups.phases(which)
    phase = np.maximum((starts[0][group] <= place[:, None]).sum(axis=1) - 1, 0)
    begins = (np.cumsum(seconds, axis=1) - seconds)[group, phase]
    s, v, a, j = (each[group, phase] for each in starts)
    most, rest = seconds[group, phase], place - s
    tau = np.where(phase < 3, most, 0.0)  # speeding up, s(t) is convex: Newton comes from the right; else from the left
    todo = np.flatnonzero(most > 0)
    for _ in range(STEPS):
        t, s_, v_, a_, j_ = tau[todo], rest[todo], v[todo], a[todo], j[todo]
        miss = t * (v_ + t * (a_ / 2 + t * j_ / 6)) - s_
        speed = v_ + t * (a_ + t * j_ / 2)
        with np.errstate(divide="ignore", invalid="ignore"):
            new = np.clip(np.where(speed > 0, t - miss / speed, t), 0.0, most[todo])
        tau[todo] = new
        todo = todo[np.abs(new - t) > 1e-15 * most[todo]]
        if not len(todo):
            break
    return begins + tau, v + tau * (a + tau * j / 2)


# Arcs under a jerk limit, entered and left in stages, so that between them they reach the speed of uniform motion.
# Uniform motion on a circle has the jerk v³ / r² itself. What turning leaves of the jerk is there for speeding up and
# braking, so with one jerk for all of an arc either the speed is low or the ramps are long. So an arc is cut where the part
# that turning may take grows, by `STAGES`: in each stage there is just room for the ramp from the speed of the one before.
#     stage      0    1    2 ... 2    1    0
#     turning   0.3  0.6    0.85     0.6  0.3     of the jerk
# Arcs that go on in each other with the same curvature are entered and left as one.

STAGES = np.array([TURNING, 0.6, 0.85, 0.96, 0.99])  # of the jerk


class Staged(NamedTuple):
    """A path whose arcs were cut: `part` (m,) the row each row was part of, `turning` (m,) the part of the jerk that it may
    turn with, `inner` the nodes at which arcs were cut. `knots` are these and the ends of what was entered in stages, and
    `bound` the rows (m,) between them, which need no other knots."""

    path: Toolpath
    part: Index
    turning: Array
    inner: Index
    knots: Index
    bound: Mask


def staged(path: Toolpath, rows: Rows, limits: Limits) -> Staged | None:
    """The path with its arcs cut into stages; None where none is long enough to gain by it."""
    arcs = np.flatnonzero((path.kind == Kind.ARC) & (rows.length > 0) & (rows.cap < rows.feed**2 * (1 - 1e-9)))
    if not len(arcs):
        return None
    length = rows.length[arcs]
    bends = Bends(path, arcs, length)
    each = [allowed(bends, rows.feed[arcs], limits, share) for share in STAGES]
    v = np.sqrt([w for w, _, _ in each])  # (stages, m), as all that follows
    before = np.concatenate([np.zeros((1, len(arcs))), v[:-1]])
    needed = np.cumsum([ramps.ramp_length(low, high, a, j) for low, high, (_, a, j) in zip(before, v, each)], axis=0)
    # arcs that go on in each other
    first, second = np.flatnonzero(np.diff(arcs) == 1), np.flatnonzero(np.diff(arcs) == 1) + 1
    at_end, at_start = bends.curvature(1.0)[first], bends.curvature(0.0)[second]
    goes_on = np.zeros(len(arcs), dtype=bool)
    goes_on[second] = np.linalg.norm(at_end - at_start, axis=1) <= TANGENT * np.linalg.norm(at_end, axis=1)
    goes_on[second] &= rows.corner[arcs[second]] >= np.minimum(rows.cap[arcs[first]], rows.cap[arcs[second]]) * (1 - 1e-9)
    goes_on[second] &= np.abs(v[-1, second] - v[-1, first]) <= TANGENT * v[-1, first]
    chain = np.cumsum(~goes_on) - 1
    start = np.flatnonzero(~goes_on)
    whole = np.add.reduceat(length, start)
    behind = np.cumsum(length) - length
    behind -= behind[start][chain]
    ends = needed[:, start]
    gains = np.concatenate([np.ones((1, len(start)), dtype=bool), v[1:, start] > v[:-1, start] * (1 + 1e-6)])
    top = np.logical_and.accumulate(gains & (2 * ends <= whole), axis=0).sum(axis=0) - 1
    if not (top > 0).any():
        return None
    ends = np.where(np.arange(len(STAGES))[:, None] < top, ends, np.inf)  # of the stages below the greatest
    cuts = np.concatenate([ends, whole - ends])[:, chain]
    shares = (cuts - behind) / length
    shares = np.sort(np.where((shares > 1e-6) & (shares < 1 - 1e-6), shares, np.inf), axis=0)
    counts = np.ones(len(path), dtype=np.int64)
    counts[arcs] += np.isfinite(shares).sum(axis=0)
    until = np.ones(counts.sum())
    last = np.cumsum(counts) - 1
    part, k = counted(counts)
    which = np.full(len(path), -1)
    which[arcs] = np.arange(len(arcs))
    open_ = np.flatnonzero(k + 1 < counts[part])
    until[open_] = shares[k[open_], which[part[open_]]]
    inner = open_ + 1
    middle = (until + np.where(k == 0, 0.0, np.append(0.0, until[:-1]))) / 2
    bent = np.flatnonzero(which[part] >= 0)
    arc = which[part[bent]]
    place = behind[arc] + middle[bent] * length[arc]
    place = np.minimum(place, whole[chain[arc]] - place)
    turning = np.full(len(part), TURNING)
    turning[bent] = STAGES[(ends[:, chain[arc]] < place).sum(axis=0)]
    bound = np.zeros(len(part), dtype=bool)
    bound[bent] = top[chain[arc]] > 0
    border = np.concatenate([last[arcs[start]] + 1 - counts[arcs[start]], last[arcs[np.append(start[1:], len(arcs)) - 1]] + 1])
    knots = np.union1d(inner, border[np.tile(top > 0, 2)])
    return Staged(divided(path, counts, until)[0], part, turning, inner, knots, bound)
