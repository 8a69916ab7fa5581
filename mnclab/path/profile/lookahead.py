"""The whole look-ahead without a loop over rows.

With w = v² a constant acceleration changes the speed over a row of length L by at most g = 2 a L. So the greatest
speeds at the nodes between rows, below caps that are known, are a *min-plus* scan:

    forward    w[i] = min(cap[i], w[i-1] + g[i-1])
    backward   w[i] = min(cap[i], w[i+1] + g[i])

With the running sum S of g the first is `minimum.accumulate(cap - S) + S`, and the second its mirror. Sums are taken
anew in every block of `BLOCK` nodes, because the difference of two large sums would lose the digits that a short
row needs; the blocks are then tied together by one number each.
"""

from __future__ import annotations

import numpy as np

from mnclab.path.limits import Limits
from mnclab.path.places import Bends
from mnclab.path.toolpath import Array, Index, Toolpath

BLOCK = 4096  # nodes


def reachable(cap: Array, gain: Array) -> Array:
    """Greatest w (n + 1,) under `cap` that rises and falls by at most `gain` (n,) over a row."""
    return forwards(backwards(cap, gain), gain)


def backwards(cap: Array, gain: Array) -> Array:
    """Greatest w (n + 1,) under `cap` from which each node's successor is within `gain` (n,)."""
    return forwards(cap[::-1], gain[::-1])[::-1]


def running_sum(values: Array) -> Array:
    """Sums (n + 1,) of the first 0, 1, … n values, in blocks: rounding grows with the root of a few hundred terms."""
    n = len(values)
    total = np.empty(n + 1)
    total[0] = 0.0
    if n <= BLOCK:
        np.cumsum(values, out=total[1:])
        return total
    blocks = -(-n // BLOCK)
    table = np.zeros((blocks, BLOCK))
    table.reshape(-1)[:n] = values
    np.cumsum(table, axis=1, out=table)
    table[1:] += np.cumsum(table[:-1, -1])[:, None]
    total[1:] = table.reshape(-1)[:n]
    return total


def forwards(cap: Array, gain: Array) -> Array:
    """w (n + 1,): each the least of its cap and of what can be reached from any node before it; not below 0."""
    w = _scan(cap, gain)
    np.minimum(w, cap, out=w)
    return np.maximum(w, 0.0, out=w)


def _scan(cap: Array, gain: Array) -> Array:
    nodes = len(cap)
    if nodes <= BLOCK:
        total = np.empty(nodes)
        total[0] = 0.0
        np.cumsum(gain, out=total[1:])
        return np.minimum.accumulate(cap - total) + total
    blocks = -(-nodes // BLOCK)
    total, w = np.zeros((blocks, BLOCK)), np.full((blocks, BLOCK), np.inf)
    total.reshape(-1)[1:nodes] = gain
    w.reshape(-1)[:nodes] = cap
    np.cumsum(total, axis=1, out=total)
    w -= total
    np.minimum.accumulate(w, axis=1, out=w)
    w += total
    carry, carries = np.inf, [np.inf]
    for most, least in zip(total[:-1, -1].tolist(), w[:-1, -1].tolist()):  # one step a block
        carry = min(least, carry + most)
        carries.append(carry)
    total += np.array(carries)[:, None]
    np.minimum(w, total, out=w)
    return w.reshape(-1)[:nodes]


# Arcs that do not reach their feed, looked at more closely.
# On an arc the acceleration of an axis is `t_k a + n_k w` (w = v², t the tangent, n the curvature vector), and both change
# along it: where the centripetal part lies on X, the path acceleration has all of Y to itself, and an axis may bear a speed
# only while the tool brakes. So such arcs are cut into parts of at most `PART`, and at least `FEWEST`, with a
# constant a each, and along the parts of one arc, of all arcs at once, the speeds are found as in H. Pham, Q.-C. Pham, "A
# New Approach to Time-Optimal Path Parameterization Based on Reachability Analysis" (2018):
#     backward   the greatest w at the start of a part from which an allowed a leads to no more than w at its end
#     forward    from w at its start the greatest allowed a that leads to no more than that
# Between arcs the scans of the look-ahead do the same. Where an arc changes a speed, they and the arcs it touches are gone
# through again, until nothing changes. What an axis would lack between the ends of a part (a bound of less than 1 %) slows
# the stretch between two stops as a whole: all accelerations fall with v².

PART, FEWEST = np.radians(4.0), 16  # of an arc
FAR = 4  # times the v² that an axis bears without braking: there none bears any
ROUNDS = 1000  # of going through arcs again; three or so are usual
STEPS = 30  # of the solution for one part; three or so are usual


class Turns:
    """The parts (m,) of arcs at `rows` of a path that was cut; `first` (q + 1,) says where each arc begins in them."""

    def __init__(self, path: Toolpath, rows: Index, first: Index, limits: Limits) -> None:
        self.rows, self.length, self.first = rows, path.lengths[rows], first
        self.limits, self.speeds = limits.axes("acceleration"), limits.axes("rapid")
        bends = Bends(path, rows, self.length)
        self.tangents = bends.tangent(0.0), bends.tangent(1.0)
        self.curves = bends.curvature(0.0), bends.curvature(1.0)
        self.between = 1 / np.cos(bends.sweep / 2)  # a sinusoid is nowhere above this times its greater end
        # the axes' accelerations at both ends, as |p a + q w| <= limit with w that at the start
        twice = 2 * self.length[:, None]
        self.p = np.concatenate([self.tangents[0], self.tangents[1] + twice * self.curves[1]], axis=1)
        self.q = np.concatenate(self.curves, axis=1)
        self.most = np.concatenate([self.limits, self.limits])

    @property
    def cap(self) -> Array:
        """The greatest v² (m,) that the axes' speeds allow, not above what `back` begins to look from."""
        slope = np.maximum(*np.abs(self.tangents)) * self.between[:, None]
        with np.errstate(divide="ignore"):
            speed = ((self.speeds / slope) ** 2).min(axis=1)
            return np.minimum(speed, FAR * (self.limits / np.maximum(np.abs(self.curves[0]), 1e-12)).min(axis=1))

    def _range(self, part: Index, w: Array) -> tuple[Array, Array, Array, Array]:
        """Least and greatest a (k,) that the axes allow at w, and how both change with w."""
        p, q = self.p[part], self.q[part]
        size = np.maximum(np.abs(p), 1e-12)
        lean = q * np.sign(p) / size
        high, low = self.most / size - lean * w[:, None], -self.most / size - lean * w[:, None]
        k, l = high.argmin(axis=1), low.argmax(axis=1)
        i = np.arange(len(part))
        return low[i, l], high[i, k], -lean[i, l], -lean[i, k]

    def most_of(self, w0: Array, w1: Array) -> Array:
        """The greatest acceleration, or braking, (m,) that the axes allow on parts from w0 to w1."""
        low, high, _, _ = self._range(np.arange(len(self.rows)), w0)
        return np.where(w1 < w0, -low, high)

    def back(self, part: Index, after: Array, cap: Array) -> Array:
        """The greatest w (k,) at the start of parts, not above `cap`, that can become `after` or less at the end.

        The room for a, from the least allowed to the least of the greatest allowed and (after - w) / 2 L, shrinks with w
        along a concave line: Newton from the right finds in a few steps where it ends.
        """
        twice = 2 * self.length[part]
        w = cap.copy()
        for _ in range(STEPS):
            low, high, low_slope, high_slope = self._range(part, w)
            fall = (after - w) / twice
            less = fall < high
            high, high_slope = np.where(less, fall, high), np.where(less, -1 / twice, high_slope)
            room, slope = high - low, high_slope - low_slope
            tight = room < -1e-12 * np.abs(low)
            if not tight.any():
                break
            w = np.where(tight, np.maximum(w - room / np.minimum(slope, -1e-300), 0.0), w)
        return w

    def on(self, part: Index, before: Array, cap: Array) -> Array:
        """The greatest w (k,) at the end of parts, not above `cap`, that `before` at their start can become."""
        _, high, _, _ = self._range(part, before)
        return np.clip(before + 2 * self.length[part] * high, 0.0, cap)

    def excess(self, w0: Array, w1: Array) -> Array:
        """By what factor (m,) some axis is asked for more than it has, anywhere on a part; at least 1.

        f = t_k a + n_k w with w linear along the part obeys f'' + f = 2 dn/dφ dw/dφ, whose size is at most 4 |a|: above
        the sinusoid through its ends it rises by no more than 4 |a| (1 / cos(Δ/2) - 1).
        """
        a = (w1 - w0) / (2 * self.length)
        most = np.zeros((len(a), 3))
        for t, n, w in zip(self.tangents, self.curves, (w0, w1)):
            np.maximum(most, np.abs(t * a[:, None] + n * w[:, None]), out=most)
        most = most * self.between[:, None] + (4 * np.abs(a) * (self.between - 1))[:, None]
        return np.maximum((most / self.limits).max(axis=1), 1.0)

    def speeds_at(self, corner: Array, a: Array, length: Array) -> Array:
        """v² (n + 1,) at the nodes of the whole path, whose rows have the accelerations `a` off the arcs."""
        gain = 2 * a * length
        w = self._pass(corner, gain, forward=False)
        w = self._pass(w, gain, forward=True)
        chain = np.cumsum(w == 0)  # from stop to stop
        slow = np.ones(chain[-1] + 1)
        np.maximum.at(slow, chain[self.rows], self.excess(w[self.rows], w[self.rows + 1]))
        return w / slow[chain]

    def _pass(self, cap: Array, gain: Array, forward: bool) -> Array:
        """v² (n + 1,) under `cap` after one pass over everything, arcs and what lies between them."""
        w = cap.copy()
        begin, end = self.rows[self.first[:-1]], self.rows[self.first[1:] - 1] + 1  # nodes of the arcs
        free = np.ones(len(cap), dtype=bool)
        free[self.rows] = False
        free[end] = True  # nodes whose row after them, or none, is no part of an arc
        nodes = np.flatnonzero(free | np.isin(np.arange(len(cap)), begin))
        row = np.minimum(nodes[:-1], len(gain) - 1)
        arc = np.isin(row, begin)
        entry = np.full(len(begin), np.inf)
        scan = forwards if forward else backwards
        for _ in range(ROUNDS):
            free_gain = np.where(arc, np.maximum(w[nodes[:-1]], w[nodes[1:]]), gain[row])  # an arc ties nothing here
            w[nodes] = scan(w[nodes], free_gain)
            fixed = w[begin] if forward else w[end]
            todo = np.flatnonzero(fixed < entry * (1 - 1e-12))
            if not len(todo):
                break
            entry[todo] = fixed[todo]
            self._along(w, cap, todo, forward)
        return w

    def _along(self, w: Array, cap: Array, arcs: Index, forward: bool) -> None:
        """Go along some arcs, part by part, all at once."""
        counts = self.first[arcs + 1] - self.first[arcs]
        order = np.argsort(-counts, kind="stable")
        arcs, counts = arcs[order], counts[order]
        lanes = np.searchsorted(-counts, -np.arange(1, counts[0] + 1), "right")  # arcs with at least so many parts
        for k, many in enumerate(lanes):
            here = arcs[:many]
            part = self.first[here] + k if forward else self.first[here + 1] - 1 - k
            node = self.rows[part]
            if forward:
                w[node + 1] = np.minimum(w[node + 1], self.on(part, w[node], cap[node + 1]))
            else:
                w[node] = np.minimum(w[node], self.back(part, w[node + 1], cap[node]))
