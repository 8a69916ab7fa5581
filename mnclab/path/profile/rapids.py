"""Rapids whose axes are not coordinated: each runs its own profile from stop to stop (MNC 3.1).

The row takes as long as its slowest axis. While the axes are uneven the tool leaves the straight line; a place on it, s,
is the projection of the tool on the line from start to end, so that the pieces of the profile join as they do elsewhere.
"""

from __future__ import annotations

import numpy as np

from mnclab.path.columns import Array, Index
from mnclab.path.kinds import Kind
from mnclab.path.limits import Limits
from mnclab.path.profile import ramps
from mnclab.path.toolpath import Toolpath

SAME = 1e-12  # s
PARTS = 4  # of the time in which no axis changes its phase, for a picture
MANY = 2000  # rapids that are sampled at once


class Rapids:
    """The rapid rows (m,) of a path: `seconds` (m,), `top` speed (m,) and what each axis does."""

    def __init__(self, path: Toolpath, rows: Index, limits: Limits, motion: str) -> None:
        self.rows = rows
        self.start, self.travel = path.start[rows], path.end[rows] - path.start[rows]
        distance = np.abs(self.travel)
        self.length = np.linalg.norm(self.travel, axis=1)
        speeds = np.broadcast_to(limits.axes("rapid"), distance.shape)
        cruise = (distance / speeds).max(axis=1)  # seconds at full speed
        if motion == "proportional":
            with np.errstate(divide="ignore", invalid="ignore"):
                speeds = np.where(cruise[:, None] > 0, distance / cruise[:, None], speeds)
        self.ideal = cruise
        flat = distance.ravel()
        moves = np.flatnonzero(flat > 0)
        a, j = (np.tile(limits.axes(name), len(rows)) for name in ("acceleration", "jerk"))
        still, v = np.zeros(len(moves)), speeds.ravel()[moves]
        above = ramps.peak(flat[moves], still, still, v, a[moves], j[moves])
        seconds = np.zeros((len(flat), 7))
        seconds[moves] = ramps.phases(flat[moves], still, still, above, a[moves], j[moves])
        #: Seconds (m, 3, 7) of the phases of each axis.
        self.phases = seconds.reshape(-1, 3, 7)
        begin = ramps.starts(seconds, np.zeros(len(flat)), np.where(flat > 0, a, 0.0), j)
        self._starts = [each.reshape(-1, 3, 7) for each in begin]
        self.seconds = self.phases.sum(axis=2).max(axis=1)

    def breaks(self) -> Array:
        """Seconds (m, 22) from the start of each row at which any axis changes its phase, in rising order."""
        ends = np.cumsum(self.phases, axis=2).reshape(len(self.rows), -1)
        ends = np.minimum(ends, self.seconds[:, None])  # the sums of the slowest axis are rounded in another order
        breaks = np.sort(np.concatenate([np.zeros((len(self.rows), 1)), ends], axis=1), axis=1)
        for k in range(breaks.shape[1] - 2, 0, -1):  # what rounding alone keeps apart is one
            breaks[:, k] = np.where(breaks[:, k + 1] - breaks[:, k] < SAME, breaks[:, k + 1], breaks[:, k])
        return breaks

    def state(self, which: Index, t: Array) -> tuple[Array, Array, Array, Array]:
        """Place, velocity, acceleration and jerk (q, 3) of some of the rows, `t` (q,) seconds after their start."""
        ends = np.cumsum(self.phases[which], axis=2)
        phase = (ends <= t[:, None, None]).sum(axis=2)  # 7: the axis has arrived
        done = phase == 7
        phase = np.minimum(phase, 6)[:, :, None]
        dt = t[:, None] - np.take_along_axis(ends - self.phases[which], phase, 2)[..., 0]
        s, v, a, j = (np.take_along_axis(each[which], phase, 2)[..., 0] for each in self._starts)
        sign, distance = np.sign(self.travel[which]), np.abs(self.travel[which])
        place = np.where(done, distance, s + dt * (v + dt * (a / 2 + dt * j / 6)))
        speed = np.where(done, 0.0, v + dt * (a + dt * j / 2))
        rate = np.where(done, 0.0, a + dt * j)
        return self.start[which] + sign * place, sign * speed, sign * rate, sign * np.where(done, 0.0, j)


def courses(path: Toolpath, limits: Limits, fine: float, least: float = 0.0) -> tuple[Index, Array]:
    """Places (k, 3) that rapids pass between their ends, and the row (k,) of each, for pictures of their true course.

    `limits.rapid_motion` says how they go. A rapid that stays within `fine` mm of its straight line has none, nor has one
    shorter than `least` mm.
    """
    if limits.rapid_motion in (None, "line"):
        return np.empty(0, np.int64), np.empty((0, 3))
    travel = path.end - path.start
    far = np.einsum("ij,ij->i", travel, travel) > least**2
    rows = np.flatnonzero((path.kind == Kind.RAPID) & far & (np.count_nonzero(travel, axis=1) > 1))
    found = [_course(path, rows[k : k + MANY], limits, fine) for k in range(0, len(rows), MANY)]
    which, places = zip(*found) if found else ([np.empty(0, np.int64)], [np.empty((0, 3))])
    return np.concatenate(which), np.concatenate(places)


def _course(path: Toolpath, rows: Index, limits: Limits, fine: float) -> tuple[Index, Array]:
    rapids = Rapids(path, rows, limits, str(limits.rapid_motion))
    breaks = rapids.breaks()
    times = breaks[:, :-1, None] + np.diff(breaks, axis=1)[:, :, None] * np.arange(1, PARTS + 1) / PARTS
    times = times.reshape(len(rows), -1)
    which, at = np.nonzero((np.diff(times, axis=1, prepend=0.0) > SAME) & (times < rapids.seconds[:, None] - SAME))
    place = rapids.state(which, times[which, at])[0]
    straight = rapids.travel[which] / rapids.length[which, None]
    beside = np.linalg.norm(np.cross(place - rapids.start[which], straight), axis=1)
    off = np.zeros(len(rows))
    np.maximum.at(off, which, beside)
    keep = off[which] > fine
    return rows[which[keep]], place[keep]
