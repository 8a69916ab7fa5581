"""Arcs under a jerk limit, entered and left in stages, so that between them they reach the speed of uniform motion.

Uniform motion on a circle has the jerk v³ / r² itself. What turning leaves of the jerk is there for speeding up and
braking, so with one jerk for all of an arc either the speed is low or the ramps are long. So an arc is cut where the part
that turning may take grows, by `STAGES`: in each stage there is just room for the ramp from the speed of the one before.

    stage      0    1    2 ... 2    1    0
    turning   0.3  0.6    0.85     0.6  0.3     of the jerk

Arcs that go on in each other with the same curvature are entered and left as one.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.path.columns import Array, Index, Mask
from mnclab.path.kinds import Kind
from mnclab.path.limits import Limits
from mnclab.path.profile import ramps
from mnclab.path.profile.bends import Bends, divided
from mnclab.path.profile.corner_speeds import TANGENT
from mnclab.path.profile.motions import TURNING, Rows, allowed
from mnclab.path.toolpath import Toolpath

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
    k = np.arange(len(until)) - np.repeat(last + 1 - counts, counts)
    part = np.repeat(np.arange(len(path)), counts)
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
