"""Pockets of simple shape, cleared on passes of the same shape. Lengths in mm, angles in rad.

    t = way from the first to the last pass, k = greatest stepover:  n = ceil(t / k) steps of t / n each

All steps are equal and none is above k. A pocket is cleared from its centre outwards; in climb milling, the spindle
turning clockwise, its wall is followed counter-clockwise. What stands in the middle is cut free by `studs`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry import shapes
from mnclab.geometry.contours import Contour, Floats
from mnclab.geometry.regions import Region
from mnclab.machining.depths import TooMany
from mnclab.machining.milling.clearing import Clearing, Piece, numbered
from mnclab.machining.milling.spirals import half_circles

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
    length: float, width: float, radius: float, stepover: float, *, corner: float = 0.0, allowance: float = 0.0,
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
        passes.append(Contour(shapes.placed(np.array([far, -far, far]), centre, angle), closed=False))
    for i in range(1, n + 1):
        back = least * (n - i) / n
        ring = shapes.rectangle(
            2 * (a - back), 2 * (b - back), max(0.0, inner - back), centre=centre, angle=angle, begin=axis
        )
        passes.append(ring if climb else ring.reversed())
    return _from_the_centre(passes, "ring", radius, np.asarray(centre, dtype=float))


def circle(
    diameter: float, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True,
    centre: ArrayLike = (0, 0), angle: float = 0.0,
) -> Clearing:  # fmt: skip
    """A circular pocket on full circles, each begun at `angle`; no pass where the tool fills the pocket."""
    reach = diameter / 2 - radius - allowance
    _must_fit(reach, radius, allowance, f"a pocket of diameter {diameter:g}")
    n = steps(reach, stepover)
    circles = [Contour.circle(centre, reach * i / n, angle, clockwise=not climb) for i in range(1, n + 1)]
    return _from_the_centre(circles, "circle", radius, np.asarray(centre, dtype=float))


def circular_spiral(
    diameter: float, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True,
    centre: ArrayLike = (0, 0), angle: float = 0.0,
) -> Clearing:  # fmt: skip
    """A circular pocket on one spiral of half circles from the centre, and a full circle at the end."""
    reach = diameter / 2 - radius - allowance
    _must_fit(reach, radius, allowance, f"a pocket of diameter {diameter:g}")
    middle, halves = np.asarray(centre, dtype=float), steps(2 * reach, stepover)
    if not halves:
        return Clearing(Region(), (Piece(Region(), (), (), (), middle),), radius)
    spiral = half_circles(middle, 0.0, reach, halves, angle, clockwise=not climb)
    last = Contour.circle(middle, reach, angle + np.pi * halves, clockwise=not climb)
    return joined([spiral, last], ("spiral", "last circle"), radius, Region((_turned_left(last),)), middle)


def rectangular_spiral(
    length: float, width: float, radius: float, stepover: float, *, corner: float = 0.0, allowance: float = 0.0,
    climb: bool = True, centre: ArrayLike = (0, 0), angle: float = 0.0,
) -> Clearing:  # fmt: skip
    """A rectangular pocket on one spiral of lines and quarter circles, and the last rectangle of `rectangle` at the end.

    Every round lies one step farther out than the one before; it takes the step in its corners.
    """
    if width > length:  # it begins along the longer axis
        length, width, angle = width, length, angle + np.pi / 2
    rings = rectangle(length, width, radius, stepover, corner=corner, allowance=allowance)
    a, b = length / 2 - radius - allowance, width / 2 - radius - allowance
    least, n = min(a, b), steps(min(a, b), stepover)
    out = least * np.arange(n + 1) / max(n, 1)
    x, y = a - least + out, b - least + out
    corners = [(-x[0], -y[0])]
    for i in range(n):
        corners += [(x[i + 1], -y[i]), (x[i + 1], y[i + 1]), (-x[i + 1], y[i + 1]), (-x[i + 1], -y[i + 1])]
    last = rings.passes[-1] if n else None
    if last is None:
        corners.append((x[0], y[0]))
    else:
        corners += [(0.0, -y[-1])]
        last = last.started_at(last.nearest((0.0, -y[-1])))
    sharp = np.array(corners)[np.append(True, np.hypot(*np.diff(corners, axis=0).T) > DRIFT)]
    way = _softened(sharp, max(corner - radius - allowance, least / max(n, 1)))
    passes = [way] if last is None else [way, last]
    flip = np.array([1.0, 1.0 if climb else -1.0])
    turned = [
        Contour(shapes.placed(p.points * flip, centre, angle), p.bulge * flip[1], closed=p.closed) for p in passes
    ]
    outer = Region((_turned_left(turned[-1]),)) if last is not None else Region()
    return joined(turned, ("spiral", "last ring")[: len(turned)], radius, outer, turned[0].points[0])


def slot(
    line: Contour, width: float, radius: float, stepover: float | None = None, *, allowance: float = 0.0,
    climb: bool = True,
) -> Clearing:  # fmt: skip
    """A slot about a straight or bent centre line: along the line, then round it ever wider, by `radius` at most.

    A slot as wide as the tool is one pass along the line, whatever the allowance.
    """
    exact = abs(width - 2 * radius) <= DRIFT
    reach = 0.0 if exact else width / 2 - radius - allowance
    _must_fit(reach, radius, allowance, f"a slot {width:g} wide")
    if not shapes.is_smooth(line):
        raise ValueError("a slot has a centre line of one straight line or one arc")
    n = steps(reach, stepover or radius)
    rounds = [shapes.slot(line, 2 * reach * i / n) for i in range(1, n + 1)]
    outer = Region(tuple(rounds[-1:]))
    passes = [line, *(ring if climb else ring.reversed() for ring in rounds)]
    return joined(passes, ("centre line", *numbered("ring", n)), radius, outer, line.points[0])


# ---- beneath ----


def _softened(corners: Floats, radius: float) -> Contour:
    """An open way of lines that turn left by a quarter, with a quarter circle at each turn, as large as there is room."""
    side = np.hypot(*np.diff(corners, axis=0).T)
    size = np.minimum(radius, np.minimum(side[:-1], side[1:]) / 2)
    ahead = np.diff(corners, axis=0) / side[:, None]
    before, after = corners[1:-1] - size[:, None] * ahead[:-1], corners[1:-1] + size[:, None] * ahead[1:]
    points = np.vstack([corners[:1], np.stack([before, after], axis=1).reshape(-1, 2), corners[-1:]])
    bulge = np.concatenate([[0.0], np.tile([shapes.QUARTER, 0.0], len(size)), [0.0]])
    some = np.append(np.hypot(*np.diff(points, axis=0).T) > DRIFT, True)
    return Contour(points[some], bulge[some], closed=False)


def _must_fit(room: float, radius: float, allowance: float, what: str) -> None:
    if not radius > 0:
        raise ValueError(f"the tool radius must be greater than 0, got {radius:g}")
    if room < -DRIFT:
        rest = f" and an allowance of {allowance:g}" if allowance else ""
        raise ValueError(f"a tool of radius {radius:g}{rest} does not fit into {what}")


def _turned_left(ring: Contour) -> Contour:
    return ring if ring.area > 0 else ring.reversed()


def _from_the_centre(passes: list[Contour], name: str, radius: float, centre: Floats) -> Clearing:
    outer = Region((_turned_left(passes[-1]),)) if passes and passes[-1].closed else Region()
    return joined(passes, numbered(name, len(passes)), radius, outer, centre)


def joined(passes: list[Contour], labels: tuple[str, ...], radius: float, centres: Region, place: Floats) -> Clearing:
    """Passes that lead on to one another, the tool coming in at a place."""
    piece = Piece(centres, tuple(passes), (True,) * max(0, len(passes) - 1), labels, np.asarray(place))
    return Clearing(centres, (piece,), radius)
