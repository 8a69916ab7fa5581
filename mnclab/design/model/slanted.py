"""How much cones and chamfers take away of a slab: in closed form where nothing else meets them, else by quadrature.

The section of a cone, and of a chamfer along lines and arcs, is a quadratic function of how far it reaches out.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import reduce
from itertools import combinations
from typing import Any

import numpy as np

from mnclab.design.model.removals import TINY, Slant, Slanting, Wedge
from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import EDGES_APART, Region, rough
from mnclab.geometry.tracing import bands_beside, covered, polygons_of

SAME = 1e-9  # of an area, and mm
ROUNDED = 1e-8  # of an area, by which corners that are rounded to 1e-9 mm may change it
MEETING = 3e-9  # of the volume of a slab, by which what is taken of it may be off where slants meet other edges
HALVINGS = 12


def slanted_off(region: Region, slants: Sequence[Slant], low: float, high: float) -> float:
    """mm³ that slants take away of a slab that stands on a region."""
    if not region.loops or not slants:
        return 0.0
    outs = [each.at(high if each.up else low) for each in slants]
    widest = [each.section(high if each.up else low) for each in slants]
    total = 0.0
    for group in _groups(widest):
        some = [slants[k] for k in group]
        area = _alone(region, some[0], widest[group[0]], outs[group[0]]) if len(group) == 1 else None
        if area is None:
            near = region.intersection(reduce(Region.union, (widest[k] for k in group)))
            least = MEETING * region.area * (high - low)
            total += _integral(_together(near, some), low, high, least) if near.loops else 0.0
        else:  # quadratic in the height: Simpson's rule is exact
            at = some[0].at
            total += (high - low) / 6 * (area(at(low)) + 4 * area(at((low + high) / 2)) + area(at(high)))
    return total


def _groups(widest: list[Region]) -> list[list[int]]:
    """The numbers of regions that meet one another, directly or through others."""
    bodies = [rough(each) for each in widest]
    group = list(range(len(widest)))
    for i, k in combinations(range(len(widest)), 2):
        if group[i] != group[k] and shapely.dwithin(bodies[i], bodies[k], EDGES_APART):
            group = [group[i] if each == group[k] else each for each in group]
    return [[k for k, each in enumerate(group) if each == which] for which in dict.fromkeys(group)]


def _alone(region: Region, slant: Slant, widest: Region, far: float) -> Callable[[float], float] | None:
    """The area that a slant takes of a region, by how far it reaches, at most `far`; None where anything else is in its way."""
    if isinstance(slant, Slanting) and not isinstance(slant.base, Region):
        return _cone(region, slant, widest)
    if abs(region.intersection(widest).area - widest.area) > SAME * max(widest.area, 1.0):
        return None
    if isinstance(slant, Wedge):
        width = slant.width
        return lambda out: width * out
    assert isinstance(slant.base, Region)
    base, sign = slant.base.area, -1 if slant.inside else 1
    whole = widest.area
    half, part = (sign * (slant.grown(far * share).area - base) for share in (0.5, 0.75))
    c = 2 * whole - 4 * half
    b = whole - c
    if abs(0.75 * b + 0.5625 * c - part) > ROUNDED * max(widest.area, 1.0):
        return None
    return lambda out: out / far * (b + c * out / far)


def _cone(region: Region, slant: Slanting, widest: Region) -> Callable[[float], float] | None:
    """The same of a cone about a point, with its own hole in the middle or none."""
    centre, far, hole = np.array([slant.base]), np.sqrt(widest.area / np.pi), 0.0
    for loop in region.loops:
        if loop.distance(centre)[0] > far + SAME:
            continue
        about = np.hypot(*(loop.points - centre).T)
        if hole or np.ptp(about) > SAME or np.abs(np.abs(loop.bulge) - 1).max() > SAME or abs(about[0] - slant.near) > SAME:
            return None
        hole = slant.near
    if not region.contains(centre + [[far * (1 - SAME), 0.0]])[0]:
        return None
    return lambda out: np.pi * (out * out - hole * hole)


def _together(near: Region, slants: Sequence[Slant]) -> Callable[[float], float]:
    """The area that some slants take together of a region, by the height: of fine polygons, none of which is traced."""
    places = [_open_to(near, each) for each in slants]

    def area(z: float) -> float:
        gone = []
        for each, place in zip(slants, places):
            if (out := each.at(z)) > each.near + TINY:
                gone.append(shapely.intersection(place, covered(list(_bands(each, out)))))
        return float(shapely.union_all(gone).area)

    return area


def _bands(slant: Slant, out: float) -> Iterator[Contour]:
    """What lies nearer to the edge of its base than a distance, on its side."""
    if isinstance(slant, Wedge):
        yield slant.outline(out)
    elif isinstance(slant.base, Region):
        for edge in slant.edges:
            yield from bands_beside(edge.reversed(), out)
    else:
        yield Contour.circle(slant.base, out)


def _open_to(near: Region, slant: Slant) -> Any:
    """Where a slant may take something of a region: on its side of the edge."""
    place = polygons_of(near.loops)
    if isinstance(slant, Wedge) or not isinstance(slant.base, Region):
        return place
    cut = shapely.intersection if slant.inside else shapely.difference
    return cut(place, polygons_of(slant.base.loops))


def _integral(area: Callable[[float], float], low: float, high: float, least: float) -> float:
    """By Simpson's rule, exact up to cubic functions, in halves until they agree within `least` mm³."""

    def whole(a: float, fa: float, fm: float, b: float, fb: float, deep: int) -> float:
        m = (a + b) / 2
        fl, fr = area((a + m) / 2), area((m + b) / 2)
        one, two = (b - a) / 6 * (fa + 4 * fm + fb), (b - a) / 12 * (fa + 4 * fl + 2 * fm + 4 * fr + fb)
        if deep == 0 or abs(two - one) <= max(15 * least * (b - a) / (high - low), SAME * (b - a)):
            return two + (two - one) / 15
        return whole(a, fa, fl, m, fm, deep - 1) + whole(m, fm, fr, b, fb, deep - 1)

    return whole(low, area(low), area((low + high) / 2), high, area(high), HALVINGS)
