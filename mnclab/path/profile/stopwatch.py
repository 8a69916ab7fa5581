"""The limits of an axis, learned from moves that were timed with a stop-watch.

A move of length L from stop to stop, with the greatest speed V, acceleration A and, under a jerk limit, J takes

    T = L / V + V / A + A / J     where V and A are reached
    T = 2 sqrt(L / A)             where V is not, without a jerk limit

so long moves say V, and short ones A and J. V, A and J are those whose times are nearest to what was read, by least squares
(Gauss, Newton; damped as by Levenberg and Marquardt) in the logarithms of V, A and J. How sure they are follows from how much
each time changes with each of them, as in JCGM 100 (GUM): C = u² (Jᵀ J)⁻¹, times a factor that has the true value within ± in
95 cases of 100. Few times tell u badly, so the factor is then larger than 2 (Student).
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import Any, ClassVar

import numpy as np

from mnclab.path.limits import Limits
from mnclab.path.profile import ramps
from mnclab.path.toolpath import Array
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, fitting, shown
from mnclab.text.tables import Listing

STEPS = 200  # of the solution; ten or so are usual
SPEEDS, ACCELERATIONS, RISES = 10 ** np.arange(0, 4.1, 0.4), 10 ** np.arange(0, 5.1, 0.5), 10 ** np.arange(-3, 0.6, 0.5)
FACTORS = (13.97, 4.53, 3.31, 2.87, 2.65, 2.52, 2.43, 2.37, 2.32, 2.28)  # times more than limits: 1 … 10; GUM, table G.2
TELLS = 1e-3  # times that change by less than this part of a change of a limit do not say it


class LearnedLimits(Listing):
    """`limits`, and how sure each is: `uncertainty` by name (mm/min, mm/s², mm/s³), for 95 cases of 100; `lengths` mm and the
    `seconds` of the moves, and `off` (m,), what was read less what the limits give, s."""

    HEAD = ("limit", "value", "±", "unit")
    NUMBERS: ClassVar[tuple[int, ...]] = (1, 2)
    UNITS: ClassVar[dict[str, str]] = {"rapid": "mm/min", "acceleration": "mm/s²", "jerk": "mm/s³"}

    def __init__(self, limits: Limits, uncertainty: dict[str, float], lengths: Array, seconds: Array, off: Array) -> None:
        self.limits, self.uncertainty = limits, uncertainty
        self.lengths, self.seconds, self.off = lengths, seconds, off

    def texts(self) -> list[tuple[str, ...]]:
        """Limit, value and uncertainty, to the second digit of the uncertainty."""
        rows = [(name, getattr(self.limits, name), u) for name, u in self.uncertainty.items()]
        digits = [int(np.clip(1 - np.floor(np.log10(max(u, 1e-9))), 0, 3)) for _, _, u in rows]
        return [(name, f"{value:.{n}f}", f"{u:.{n}f}", self.UNITS[name]) for (name, value, u), n in zip(rows, digits)]


@fitting
def fit_limits(times: Mapping[float, float], *, jerk: bool = False, reading: float | None = None) -> LearnedLimits:
    """The limits of one axis from `times`: {length mm: seconds} of rapids from stop to stop, one axis at a time.

    Two times and more, five are a good choice: two long moves, three short ones. `jerk`: learn a jerk limit too. `reading` is
    the standard uncertainty of a time, s (0.05 of a stop-watch in the hand: time ten moves, divide both by ten); None: what
    the times themselves are off, of which there must be more than limits. An Alarm where the times do not say a limit.

    A way s takes s / v + v / a; here v is 100 mm/s and v / a one second:

    >>> mnc.fit_limits({100: 2.0, 200: 3.0, 300: 4.0}).limits
    Limits(rapid=6000, acceleration=100)
    """
    names = ("rapid", "acceleration", "jerk")[: 3 if jerk else 2]
    lengths, seconds = _read(times, len(names), reading)
    x = _solved(lengths, seconds, len(names))
    slopes, off = _slopes(lengths, x), seconds - _times(lengths, x)
    if (untold := np.abs(slopes).max(axis=0) < TELLS * seconds.max()).any():
        longer = "longer" if untold[0] else "shorter"
        raise Alarm(f"these times do not say the {names[int(untold.argmax())]} of the axis", hint=f"time a {longer} move too")
    sizes = np.linalg.svd(slopes / np.linalg.norm(slopes, axis=0), compute_uv=False)
    if sizes[-1] < TELLS * sizes[0]:
        raise Alarm(f"these times do not tell {names[-2]} and {names[-1]} apart", hint="time a shorter move too")
    free = len(seconds) - len(x)
    spread, factor = reading, 2.0
    if spread is None:
        spread, factor = np.sqrt(np.sum(off**2) / free), FACTORS[free - 1] if free <= len(FACTORS) else 2 + 2.7 / free
    sure = factor * spread * np.sqrt(np.diag(np.linalg.inv(slopes.T @ slopes))) * np.exp(x)
    per_minute = np.array([60.0, 1.0, 1.0])[: len(x)]
    rapid, acceleration, *third = (np.exp(x) * per_minute).tolist()
    limits = Limits(rapid, acceleration, third[0] if third else None)
    return LearnedLimits(limits, dict(zip(names, (sure * per_minute).tolist())), lengths, seconds, off)


def _read(times: Any, count: int, reading: float | None) -> tuple[Array, Array]:
    """Lengths and seconds (m,), checked."""
    if not isinstance(times, Mapping):
        raise Alarm(f"times must be {{length mm: seconds}}, got {shown(times)}", hint="fit_limits({100: 0.78, 400: 2.58})")
    for length, time in times.items():
        check_number(length, "the length of a move, mm", at_least=1e-3, at_most=1e6)
        check_number(time, f"the time of the move of {length:g} mm, s", at_least=1e-3, at_most=1e6)
    if reading is not None:
        check_number(reading, "reading, s", above=0, at_most=1e3)
    need = count + (reading is None)
    if len(times) < need:
        why = "" if reading is not None else ", or say how well a time is read: reading=0.05"
        raise Alarm(f"{count} limits need {need} times of different lengths, got {len(times)}", hint=f"time more moves{why}")
    rows = np.array(sorted(times.items()), dtype=np.float64)
    if (shrinks := np.flatnonzero(np.diff(rows[:, 1]) <= 0)).size:
        (a, ta), (b, tb) = rows[shrinks[0]], rows[shrinks[0] + 1]
        raise Alarm(f"{b:g} mm take {tb:g} s and {a:g} mm {ta:g} s: a longer move takes longer", hint="time these two again")
    return rows[:, 0], rows[:, 1]


def _times(lengths: Array, x: Array) -> Array:
    """Seconds (…, m) of moves from stop to stop; `x` (…, k) the logarithms of mm/s, mm/s² and, if there is a third, mm/s³."""
    shape, infinite = (*x.shape[:-1], len(lengths)), np.full((*x.shape[:-1], 1), np.inf)
    rows = np.concatenate([np.exp(x), infinite], axis=-1)
    way, v, a, j = (np.broadcast_to(each, shape).ravel() for each in (lengths, *(rows[..., [k]] for k in range(3))))
    still = np.zeros(len(way))
    return ramps.phases(way, still, still, ramps.peak(way, still, still, v, a, j), a, j).sum(axis=1).reshape(shape)


def _slopes(lengths: Array, x: Array) -> Array:
    """How the times change with x (m, k), by central differences."""
    steps = 1e-5 * np.eye(len(x))
    return (_times(lengths, x + steps) - _times(lengths, x - steps)).T / 2e-5


def _solved(lengths: Array, seconds: Array, count: int) -> Array:
    """The logarithms (k,) of the limits whose times are nearest: the best of a grid, then Gauss and Newton."""
    rises = RISES if count > 2 else RISES[:1]
    starts = np.log([(v, a, a / rise)[:count] for v, a, rise in product(SPEEDS, ACCELERATIONS, rises)])
    x = starts[np.sum((seconds - _times(lengths, starts)) ** 2, axis=1).argmin()]
    off, damping = seconds - _times(lengths, x), 1e-3
    for _ in range(STEPS):
        slopes = _slopes(lengths, x)
        square = slopes.T @ slopes
        step = np.linalg.solve(square + damping * np.diag(np.diag(square) + 1e-12), slopes.T @ off)
        new = x + np.clip(step, -1.0, 1.0)
        left = seconds - _times(lengths, new)
        better = float(left @ left) < float(off @ off)
        damping = max(damping / 10, 1e-15) if better else damping * 10
        if better:
            x, off = new, left
        if np.abs(step).max() < 1e-13 or damping > 1e12:
            break
    return x
