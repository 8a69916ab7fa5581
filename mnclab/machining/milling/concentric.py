"""Pockets of simple shape, cleared on passes of the same shape. Lengths in mm, angles in rad.

    t = way from the first to the last pass, k = greatest stepover:  n = ceil(t / k) steps of t / n each

All steps are equal and none is above k. A pocket is cleared from its centre outwards; in climb milling, the spindle
turning clockwise, its wall is followed counter-clockwise. What stands in the middle is cut free by `studs`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry import contours
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.machining.depths import TooMany
from mnclab.machining.milling.clearing import Clearing, joined, numbered

DRIFT = 1e-9  # a number of steps this little above a whole one is that whole one
MOST = 2_000  # steps from the middle to the wall, beyond any tool and pocket
NOTHING = 1e-6  # mm; a shorter way needs no step


def steps(way: float, stepover: float, most: int = MOST) -> int:
    """How many equal steps of at most `stepover` a way needs; TooMany where nobody would wait for them."""
    if not stepover > 0:
        raise ValueError(f"the stepover must be greater than 0, got {stepover:g}")
    if way > most * stepover:
        raise TooMany(f"{stepover:g} divides {way:g} into more than {most} steps")
    return math.ceil(way / stepover - DRIFT) if way > NOTHING else 0


def rectangle(
    length: float, width: float, radius: float, stepover: float, allowance: float = 0.0, *, corner: float = 0.0,
    climb: bool = True, centre: ArrayLike = (0, 0), angle: float = 0.0, begin: int | None = None,
) -> Clearing:  # fmt: skip
    """A rectangular pocket on rectangles; the first one is a line there and back if the sides differ.

    Each begins where the longer axis, or the one that `begin` names (0 the length, 1 the width), leaves it. `corner`
    is the radius at the corners of the pocket, at least that of the tool. `angle` turns the pocket about its centre.
    """
    a, b = length / 2 - radius - allowance, width / 2 - radius - allowance
    _must_fit(min(a, b), radius, allowance, f"a pocket of {length:g} by {width:g}")
    inner = max(corner, radius) - radius - allowance
    if inner > min(a, b) + DRIFT:
        raise ValueError(f"a corner radius of {corner:g} does not fit into {length:g} by {width:g}")
    axis, n, least = (int(a < b) if begin is None else begin), steps(min(a, b), stepover), min(a, b)
    passes = []
    if abs(a - b) > DRIFT:
        far = np.array([(a - least, 0.0), (0.0, b - least)][int(a < b)])
        passes.append(Contour(contours.placed(np.array([far, -far, far]), centre, angle), closed=False))
    for i in range(1, n + 1):
        back = least * (n - i) / n
        sides, round_off = (2 * (a - back), 2 * (b - back)), max(0.0, inner - back)
        ring = contours.rectangle(*sides, round_off, centre=centre, angle=angle, begin=axis)
        passes.append(ring if climb else ring.reversed())
    return _from_the_centre(passes, "ring", radius, centre)


def circle(
    diameter: float, radius: float, stepover: float, allowance: float = 0.0, *, climb: bool = True,
    centre: ArrayLike = (0, 0), angle: float = 0.0,
) -> Clearing:  # fmt: skip
    """A circular pocket on full circles, each begun at `angle`; no pass where the tool fills the pocket."""
    reach = diameter / 2 - radius - allowance
    _must_fit(reach, radius, allowance, f"a pocket of diameter {diameter:g}")
    n = steps(reach, stepover)
    circles = [Contour.circle(centre, reach * i / n, angle, clockwise=not climb) for i in range(1, n + 1)]
    return _from_the_centre(circles, "circle", radius, centre)


def slot(
    line: Contour, width: float, radius: float, stepover: float | None = None, *, allowance: float = 0.0,
    climb: bool = True,
) -> Clearing:  # fmt: skip
    """Along the straight or bent line of a slot, then round it ever wider; just along the line where the tool fills the slot."""
    exact = abs(width - 2 * radius) <= DRIFT
    reach = 0.0 if exact else width / 2 - radius - allowance
    _must_fit(reach, radius, allowance, f"a slot {width:g} wide")
    if not contours.is_smooth(line):
        raise ValueError("a slot has a centre line of one straight line or one arc")
    n = steps(reach, stepover or radius)
    rounds = [contours.slot(line, 2 * reach * i / n) for i in range(1, n + 1)]
    passes = [line, *(ring if climb else ring.reversed() for ring in rounds)]
    return joined(passes, ("centre line", *numbered("ring", n)), radius, Region(tuple(rounds[-1:])))


def _must_fit(room: float, radius: float, allowance: float, what: str) -> None:
    if not radius > 0:
        raise ValueError(f"the tool radius must be greater than 0, got {radius:g}")
    if room < -DRIFT:
        rest = f" and an allowance of {allowance:g}" if allowance else ""
        raise ValueError(f"a tool of radius {radius:g}{rest} does not fit into {what}")


def _from_the_centre(passes: list[Contour], name: str, radius: float, centre: ArrayLike) -> Clearing:
    outer = Region(tuple(ring if ring.area > 0 else ring.reversed() for ring in passes[-1:] if ring.closed))
    return joined(passes, numbered(name, len(passes)), radius, outer, np.asarray(centre, dtype=float))
