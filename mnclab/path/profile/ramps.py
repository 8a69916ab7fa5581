"""One move by itself: from a speed to a speed over a length, in the least time.

Between two speeds a *ramp* begins and ends with no acceleration. Over a change D it takes

    T = D / a + a / j       when it reaches the acceleration a, D >= a² / j
    T = 2 sqrt(D / j)       when it does not

and, being symmetrical, the length T (v0 + v1) / 2. Without a jerk limit T = D / a. A *move* is a ramp up to a peak speed,
a stretch at that speed, and a ramp down: up to seven phases of constant jerk (L. Biagiotti, C. Melchiorri, *Trajectory
Planning for Automatic Machines and Robots*, 3.4). Everything takes arrays (n,); mm and s; ``j`` may be inf.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

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


def reach(v: Array, length: Array, a: Array, j: Array, most: Array) -> Array:
    """The greatest speed (n,) that a ramp from ``v`` reaches within ``length``, at most ``most`` (>= v)."""
    return _solve([v], length, v, most, a, j)


def peak(length: Array, v0: Array, v1: Array, cap: Array, a: Array, j: Array) -> Array:
    """The greatest speed (n,) of a move; at least that of its ends, which must be within reach of each other."""
    low = np.maximum(v0, v1)
    return _solve([v0, v1], length, low, np.maximum(cap, low), a, j)


def phases(length: Array, v0: Array, v1: Array, top: Array, a: Array, j: Array) -> Array:
    """The seconds (n, 7) of the phases of a move whose peak is ``top``."""
    found = np.zeros((len(length), 7))
    with np.errstate(divide="ignore", invalid="ignore"):
        for at, v in ((0, v0), (4, v1)):
            change = np.maximum(top - v, 0.0)
            full = a * a / j
            bent = np.where(change >= full, a / j, np.sqrt(np.minimum(change, full) / j))
            found[:, at] = found[:, at + 2] = np.where(np.isinf(j), 0.0, bent)
            found[:, at + 1] = np.where(change >= full, change / a - np.where(np.isinf(j), 0.0, a / j), 0.0)
        rest = length - ramp_length(v0, top, a, j) - ramp_length(v1, top, a, j)
        found[:, 3] = np.where(rest > 0, rest / top, 0.0)
    return found


def _need(ends: list[Array], x: Array, a: Array, j: Array) -> tuple[Array, Array]:
    """The length of the ramps between each of the ends and x (which is not below them), and how it grows with x."""
    full = a * a / j
    total, growth = np.zeros(len(x)), np.zeros(len(x))
    for v in ends:
        change = x - v
        bent = np.sqrt(np.minimum(change, full) / j)
        whole = change >= full
        time = np.where(whole, change / a + a / j, 2 * bent)
        with np.errstate(divide="ignore", invalid="ignore"):  # at x = v, where _solve halves instead
            slope = np.where(whole, 1 / a, 1 / (bent * j))
        total += 0.5 * (v + x) * time
        growth += 0.5 * time + 0.5 * (v + x) * slope
    return total, growth


def _solve(ends: list[Array], length: Array, low: Array, high: Array, a: Array, j: Array) -> Array:
    """x (n,) in low … high where the ramps to it need ``length``: Newton's steps, halving where they leave the bracket."""
    found = np.array(high, dtype=np.float64)
    with np.errstate(invalid="ignore"):
        open_ = np.flatnonzero(_need(ends, found, a, j)[0] > length)
    x, low, high, length, a, j = (each[open_] for each in (found, low, high, length, a, j))
    ends = [v[open_] for v in ends]
    for _ in range(STEPS):
        if not len(open_):
            break
        total, growth = _need(ends, x, a, j)
        over = total > length
        high, low = np.where(over, x, high), np.where(over, low, x)
        with np.errstate(invalid="ignore"):
            new = x - (total - length) / growth
        new = np.where((new > low) & (new < high), new, 0.5 * (low + high))
        go_on = np.abs(new - x) > 1e-15 * high
        found[open_] = x = new
        if not go_on.all():
            open_ = open_[go_on]
            x, low, high, length, a, j = (each[go_on] for each in (x, low, high, length, a, j))
            ends = [v[go_on] for v in ends]
    return found


def starts(seconds: Array, v0: Array, a: Array, j: Array) -> tuple[Array, Array, Array, Array]:
    """Place, speed, acceleration and jerk (n, 7) at the start of each phase of moves that begin at speed ``v0``."""
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
