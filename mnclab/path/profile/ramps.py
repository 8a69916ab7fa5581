"""One move by itself: from a speed to a speed over a length, in the least time.

Between two speeds a *ramp* begins and ends with no acceleration. Over a change D it takes

    T = D / a + a / j       when it reaches the acceleration a, D >= a² / j
    T = 2 sqrt(D / j)       when it does not

and, being symmetrical, the length T (v0 + v1) / 2. Without a jerk limit T = D / a. A *move* is a ramp up to a peak speed,
a stretch at that speed, and a ramp down: up to seven phases of constant jerk (L. Biagiotti, C. Melchiorri, *Trajectory
Planning for Automatic Machines and Robots*, 3.4). Everything takes arrays (n,); mm and s; `j` may be inf.
"""

from __future__ import annotations

import numpy as np

from mnclab.path.limits import Limits
from mnclab.path.toolpath import Array, Index, Kind, Toolpath

STEPS = 80  # of a solution; seven or so are usual

#: The sign of the jerk in the seven phases of a move.
SIGNS = np.array([1.0, 0.0, -1.0, 0.0, -1.0, 0.0, 1.0])


def ramp_time(change: Array, a: Array, j: Array) -> Array:
    """Seconds (n,) for a change of speed >= 0."""
    full = a * a / j
    return np.where(change >= full, change / a + a / j, 2 * np.sqrt(np.minimum(change, full) / j))


def ramp_length(v0: Array, v1: Array, a: Array, j: Array) -> Array:
    """Millimetres (n,) of a ramp."""
    return 0.5 * (v0 + v1) * ramp_time(np.abs(v1 - v0), a, j)


def gain(v: Array, length: Array, a: Array, j: Array) -> Array:
    """By how much (n,) a ramp from `v` changes the speed upwards within `length`.

    With D the change and y = sqrt D the length is (2 v + D) y / sqrt j below D = a² / j, so y solves the cubic equation
    y³ + 2 v y = L sqrt j; above, (2 v + D) (D + a² / j) = 2 a L.
    """
    full = a * a / j
    with np.errstate(divide="ignore", invalid="ignore"):
        q = length * np.sqrt(j)
        root = np.sqrt(2 * v / 3)
        y = 2 * root * np.sinh(np.arcsinh(q / (2 * root**3)) / 3)
        bent = np.where(2 * v * np.cbrt(q) < 1e-9 * q, np.cbrt(q), y) ** 2
    half = v + 0.5 * full
    rest = 2 * (a * length - v * full)
    straight = rest / (half + np.sqrt(np.maximum(half * half + rest, 0.0)))
    return np.where(full > 0, np.where(straight >= full, straight, np.minimum(bent, full)), straight)


def peak(length: Array, v0: Array, v1: Array, cap: Array, a: Array, j: Array) -> Array:
    """By how much (n,) the greatest speed of a move is above the greater of its ends, which a ramp must be able to
    join. That number, not the speed, because a ramp over a change of 1e-14 still takes 1e-9 s."""
    low, other = np.maximum(v0, v1), np.minimum(v0, v1)
    found = np.maximum(cap - low, 0.0)
    room = length - ramp_length(other, low, a, j)
    open_ = np.flatnonzero(_need(low, other, found, a, j)[0] > length)
    low, other, length, a, j, room = (each[open_] for each in (low, other, length, a, j, room))
    most = np.minimum(found[open_], gain(low, np.maximum(room, 0.0), a, j))
    least, x = np.zeros(len(open_)), most
    for _ in range(STEPS):
        if not len(open_):
            break
        total, growth = _need(low, other, x, a, j)
        over = total > length
        most, least = np.where(over, x, most), np.where(over, least, x)
        with np.errstate(invalid="ignore"):
            new = x - (total - length) / growth
        new = np.where((new > least) & (new < most), new, 0.5 * (least + most))
        go_on = np.abs(new - x) > 1e-15 * most
        found[open_] = new
        open_ = open_[go_on]
        still_open = (low, other, length, a, j, new, most, least)
        low, other, length, a, j, x, most, least = (each[go_on] for each in still_open)
    return found


def _need(low: Array, other: Array, x: Array, a: Array, j: Array) -> tuple[Array, Array]:
    """The length of the ramps from both ends to low + x, and how it grows with x."""
    full = a * a / j
    total, growth = np.zeros(len(x)), np.zeros(len(x))
    top = low + x
    for v, change in ((low, x), (other, x + (low - other))):
        bent = np.sqrt(np.minimum(change, full) / j)
        whole = change >= full
        time = np.where(whole, change / a + a / j, 2 * bent)
        with np.errstate(divide="ignore", invalid="ignore"):  # at x = 0, where peak halves instead
            growth += 0.5 * (time + (v + top) * np.where(whole, 1 / a, 1 / (bent * j)))
        total += 0.5 * (v + top) * time
    return total, growth


def phases(length: Array, v0: Array, v1: Array, above: Array, a: Array, j: Array) -> Array:
    """The seconds (n, 7) of the phases of a move whose peak is `above` the greater of its ends."""
    low = np.maximum(v0, v1)
    top = low + above
    found = np.zeros((len(length), 7))
    smooth, full = np.isfinite(j), a * a / j
    rest = length.copy()
    for at, v in ((0, v0), (4, v1)):
        change = above + (low - v)
        whole = change >= full
        bent = np.where(smooth, np.where(whole, a / j, np.sqrt(np.minimum(change, full) / j)), 0.0)
        found[:, at] = found[:, at + 2] = bent
        found[:, at + 1] = np.where(whole, change / a - bent, 0.0)
        rest -= 0.5 * (v + top) * (2 * bent + found[:, at + 1])
    np.divide(rest, top, out=found[:, 3], where=rest > 0)
    return found


def starts(seconds: Array, v0: Array, a: Array, j: Array) -> tuple[Array, Array, Array, Array]:
    """Place, speed, acceleration and jerk (n, 7) at the start of each phase of moves that begin at speed `v0`."""
    smooth = np.isfinite(j)
    jerk = np.where(smooth, j, 0.0)[:, None] * SIGNS
    rise, fall = (np.where(smooth, np.where(smooth, j, 0.0) * seconds[:, k], a) for k in (0, 4))
    none = np.zeros(len(seconds))
    before = np.stack([none, rise, rise, none, none, -fall, -fall], axis=1)
    s, v = np.zeros_like(seconds), np.empty_like(seconds)
    v[:, 0] = v0
    for k in range(6):
        dt = seconds[:, k]
        s[:, k + 1] = s[:, k] + dt * (v[:, k] + dt * (before[:, k] / 2 + dt * jerk[:, k] / 6))
        v[:, k + 1] = v[:, k] + dt * (before[:, k] + dt * jerk[:, k] / 2)
    return s, v, before, jerk


# Rapids whose axes are not coordinated: each runs its own profile from stop to stop (MNC 3.1).
# The row takes as long as its slowest axis. While the axes are uneven the tool leaves the straight line; a place on it, s,
# is the projection of the tool on the line from start to end, so that the pieces of the profile join as they do elsewhere.

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
        #: The greatest acceleration (m,) along the straight line, of all axes together.
        self.most = distance @ limits.axes("acceleration") / self.length
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
        above = peak(flat[moves], still, still, v, a[moves], j[moves])
        seconds = np.zeros((len(flat), 7))
        seconds[moves] = phases(flat[moves], still, still, above, a[moves], j[moves])
        #: Seconds (m, 3, 7) of the phases of each axis.
        self.phases = seconds.reshape(-1, 3, 7)
        begin = starts(seconds, np.zeros(len(flat)), np.where(flat > 0, a, 0.0), j)
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


def bent(path: Toolpath, limits: Limits, fine: float) -> Toolpath:
    """The same path, whose rapids are cut into straight rows along their true course where that is `fine` mm beside the line."""
    which, places = courses(path, limits, fine)
    row = np.sort(np.concatenate([np.arange(len(path)), which]), kind="stable")
    goes_on = np.append(row[1:] == row[:-1], False) if len(row) else np.zeros(0, dtype=bool)
    start, end = path.start[row].copy(), path.end[row].copy()
    end[goes_on] = places
    start[1:][goes_on[:-1]] = places
    return path[row].replace(start=start, end=end)


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
