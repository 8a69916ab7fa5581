"""How sure a measured number is: the fit repeated with the probe's noise.

A probe that touches a point again finds it a little elsewhere; how much is its repeatability, a standard deviation in mm (makers
state twice that). The standard uncertainty of what is made of the points is the standard deviation it has when every point is
shaken so, many times (propagation of distributions by a Monte Carlo method, JCGM 101). Two thirds of the results lie within once,
95 of 100 within twice the standard uncertainty.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from mnclab.machining.probing.found import DEGREES, Found
from mnclab.machining.probing.given import Points, Vector, numbers
from mnclab.text.alarm import Alarm

Result = Found | Mapping[str, float] | float
MOST = 1_000_000  # repeats


class Uncertainty(dict[str, float]):
    """Standard uncertainties by the names of the numbers, shown with two digits that count: mm, angles in degrees."""

    def __repr__(self) -> str:
        said = (f"{name} ±{value:#.2g}{'°' if name in DEGREES else ' mm'}" for name, value in self.items())
        return f"Uncertainty({', '.join(said)})"


def uncertainty(
    fit: Callable[..., Result], points: Vector | Points, spread: float | Vector | Points, *, seed: int = 0, repeats: int = 1000
) -> Uncertainty:
    """The standard uncertainty of each number of a fit: `uncertainty(circle, points, 0.001)["diameter"]`.

    `fit` takes points like these, any array, and gives a result of this package, numbers by name, or one number ("value"); a
    corner of four touches is `lambda p: corner(line(p[:2]), line(p[2:]))`. `spread` is the probe's standard deviation in mm: one
    number, or numbers that fit the shape of the points, as (0, 0, 0.001) where only Z was probed. Of a touch only the part along
    the surface's normal counts. The same seed shakes alike; a thousand repeats give the uncertainty to some 2 %.
    """
    if not callable(fit):
        raise Alarm(f"a fit is a function of points, as circle is, got {fit!r}")
    at, wide = numbers(points, "points"), numbers(spread, "spread")
    if (wide < 0).any():
        raise Alarm(f"spread must be a standard deviation in mm, 0 or more, got {spread!r}")
    try:
        wide, chance = np.broadcast_to(wide, at.shape), np.random.default_rng(seed)
    except (TypeError, ValueError):
        raise Alarm(f"spread must go with points {at.shape}, and seed be 0 or more, got {spread!r} and {seed!r}") from None
    if not isinstance(repeats, int) or not 2 <= repeats <= MOST:
        raise Alarm(f"repeats must be a whole number from 2 to {MOST}, got {repeats!r}")
    exact = _numbers(fit(at))
    shaken = np.array([list(_numbers(fit(at + chance.normal(size=at.shape) * wide)).values()) for _ in range(repeats)])
    off = shaken - list(exact.values())
    turns = [k for k, name in enumerate(exact) if name in DEGREES]
    off[:, turns] -= 180 * np.round(off[:, turns] / 180)  # 180 is near -180, and a line has no direction
    return Uncertainty(zip(exact, np.std(off, axis=0, ddof=1).tolist(), strict=True))


def _numbers(result: Result) -> Mapping[str, float]:
    if isinstance(result, Found):
        return result.numbers
    return result if isinstance(result, Mapping) else {"value": result}
