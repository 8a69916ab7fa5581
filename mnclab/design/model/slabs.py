"""A part as a stack of slabs: between two heights a region, less what slants off; section, volume and exact distance.

A region that does not change with the height makes a slab an upright prism: the distance of a point from it is that
in the plane and that in height together, and the least over all slabs is that from the part. A slab that something
slants off has a core that stands upright and, under each slant, a wedge.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce
from itertools import combinations
from typing import Any

import numpy as np

from mnclab.design.model.removals import NOTHING, TINY, Bevel, Cone, Flat, Ramp, Removal, Sloped
from mnclab.geometry import shapely
from mnclab.geometry.regions import EDGES_APART, Region, less, rough
from mnclab.geometry.signed import signed
from mnclab.geometry.tracing import covered, polygons_of
from mnclab.path.toolpath import Array, Index, Mask

THIN = 1e-9  # mm, of a slab that is none


@dataclass(frozen=True, eq=False)
class Slab:
    """Material between `low` and `high`, mm: `region`, less what `slants` take away from it."""

    low: float
    high: float
    region: Region
    slants: tuple[Sloped, ...] = ()

    def section(self, z: float) -> Region:
        return less(self.region, [each.section(z) for each in self.slants])

    @cached_property
    def core(self) -> Region:
        """What stands all through the slab."""
        return less(self.region, [each.section(self.high if each.up else self.low) for each in self.slants])

    @cached_property
    def volume(self) -> float:
        """mm³."""
        return self.region.area * (self.high - self.low) - slanted_off(self.region, self.slants, self.low, self.high)


@dataclass(frozen=True, eq=False)
class Stack:
    """Slabs from below upwards, one on the other, from `low` to `high`."""

    slabs: tuple[Slab, ...]

    @classmethod
    def of(cls, outline: Region, low: float, high: float, removals: Sequence[Removal]) -> Stack:
        """A blank that stands upright on an outline, and what is taken away from it."""
        flats = [each for each in removals if isinstance(each, Flat)]
        slants = [each for each in removals if not isinstance(each, Flat)]
        heights = [low, high, *(each.floor for each in flats)]
        heights += [z for each in slants for z in (each.low, each.high)]
        levels = sorted(z for z in heights if low <= z <= high)
        levels = [z for k, z in enumerate(levels) if k == 0 or z - levels[k - 1] > THIN]
        slabs, known = [], dict[tuple[int, ...], Region]()
        for a, b in zip(levels, levels[1:]):
            middle = (a + b) / 2
            gone = tuple(k for k, each in enumerate(flats) if each.reaches(middle))
            if gone not in known:
                known[gone] = less(outline, [flats[k].region for k in gone])
            here = tuple(each for each in slants if each.low < middle < each.high)
            slabs.append(Slab(a, b, known[gone], here))
        return cls(tuple(slabs))

    @cached_property
    def volume(self) -> float:
        return float(sum(slab.volume for slab in self.slabs))

    def section(self, z: float) -> Region:
        """What a level plane cuts; at the height of a step that below it."""
        for slab in self.slabs:
            if slab.low < z <= slab.high:
                return slab.section(z)
        return NOTHING

    def distance(self, points: Array) -> Array:
        """Signed distances (m,) of points (m, 3): negative in the material, exact; at corners of a chamfer as if rounded.

        The slab of a point comes first, then those above and below it, as long as they may be nearer.
        """
        z, known = points[:, 2], _Planes(points[:, :2])
        inside, found = np.zeros(len(z), dtype=bool), np.full(len(z), np.inf)
        low, high = self.slabs[0].low, self.slabs[-1].high
        for slab in self.slabs:
            here = np.flatnonzero((slab.low <= z) & (z <= slab.high))
            here = here[known.signed(slab.region, here) <= 0]
            for each in slab.slants:
                here = here[known.taken(each, here, z) > 0]
            inside[here] = True
        found[inside] = np.minimum(np.abs(z - low), np.abs(high - z))[inside]
        for slab in self.slabs:
            _nearer(slab, np.flatnonzero((slab.low <= z) & (z <= slab.high)), z, inside, found, known)
        for slab in reversed(self.slabs):
            _nearer(slab, np.flatnonzero((z > slab.high) & (z - slab.high < found)), z, inside, found, known)
        for slab in self.slabs:
            _nearer(slab, np.flatnonzero((z < slab.low) & (slab.low - z < found)), z, inside, found, known)
        return np.where(inside, -found, found)


class _Planes:
    """Signed distances of points (m, 2) from regions and from the bases of slants, each worked out once, where asked for."""

    def __init__(self, spots: Array) -> None:
        self._spots = spots
        self._known: dict[int, Array] = {}

    def signed(self, region: Region, index: Index) -> Array:
        return self._once(region, index, lambda some: signed(region, some))

    def away(self, slant: Sloped, index: Index) -> Array:
        return self._once(slant, index, lambda some: slant.away(*some.T))

    def taken(self, slant: Sloped, index: Index, z: Array) -> Array:
        """How far points are from what a slant takes away; 0 within."""
        return slant.across(slant.taken_out(self.away(slant, index), z[index]), *self._spots[index].T)

    def left(self, slab: Slab, slant: Sloped, index: Index, z: Array) -> Array:
        """How far points are from what a slant leaves of a slab, at least."""
        along = slant.left(slab.low, slab.high, self.away(slant, index), z[index])
        return slant.across(along, *self._spots[index].T)

    def _once(self, what: Region | Sloped, index: Index, of: Callable[[Array], Array]) -> Array:
        known = self._known.setdefault(id(what), np.full(len(self._spots), np.nan))
        new = index[np.isnan(known[index])]
        if len(new):
            known[new] = of(self._spots[new])
        return known[index]


def _nearer(slab: Slab, index: Index, z: Array, inside: Mask, found: Array, known: _Planes) -> None:
    """Lowers the distances of some points to what a slab leaves: of those outside that from its material, of those inside
    that from what was taken of it."""
    if not len(index):
        return
    beyond = np.maximum(np.maximum(slab.low - z, z - slab.high), 0.0)
    outer, inner = index[~inside[index]], index[inside[index]]
    if len(outer):
        found[outer] = np.minimum(found[outer], np.hypot(np.maximum(known.signed(slab.core, outer), 0.0), beyond[outer]))
    if len(inner):
        found[inner] = np.minimum(found[inner], np.hypot(np.maximum(-known.signed(slab.region, inner), 0.0), beyond[inner]))
    for each in slab.slants:
        if len(outer):
            whole = np.hypot(np.maximum(known.signed(slab.region, outer), 0.0), beyond[outer])
            found[outer] = np.minimum(found[outer], np.maximum(known.left(slab, each, outer, z), whole))
        if len(inner):
            found[inner] = np.minimum(found[inner], known.taken(each, inner, z))


# How much cones and chamfers take away of a slab: in closed form where nothing else meets them, else by quadrature.
# The section of a cone, and of a chamfer along lines and arcs, is a quadratic function of how far it reaches out.

SAME = 1e-9  # of an area, and mm
ROUNDED = 1e-8  # of an area, by which corners that are rounded to 1e-9 mm may change it
MEETING = 3e-9  # of the volume of a slab, by which what is taken of it may be off where slants meet other edges
HALVINGS = 12


def slanted_off(region: Region, slants: Sequence[Sloped], low: float, high: float) -> float:
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


def _alone(region: Region, slant: Sloped, widest: Region, far: float) -> Callable[[float], float] | None:
    """The area that a slant takes of a region, by how far it reaches, at most `far`; None where anything else is in its way."""
    if isinstance(slant, Cone):
        return _cone(region, slant, widest)
    if abs(region.intersection(widest).area - widest.area) > SAME * max(widest.area, 1.0):
        return None
    if isinstance(slant, Ramp):
        width = slant.width
        return lambda out: width * out
    assert isinstance(slant, Bevel)
    base, sign = slant.base.area, -1 if slant.inside else 1
    whole = widest.area
    half, part = (sign * (slant.grown(far * share).area - base) for share in (0.5, 0.75))
    c = 2 * whole - 4 * half
    b = whole - c
    if abs(0.75 * b + 0.5625 * c - part) > ROUNDED * max(widest.area, 1.0):
        return None
    return lambda out: out / far * (b + c * out / far)


def _cone(region: Region, slant: Cone, widest: Region) -> Callable[[float], float] | None:
    """The same of a cone about a point, with its own hole in the middle or none."""
    centre, far, hole = np.array([slant.centre]), np.sqrt(widest.area / np.pi), 0.0
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


def _together(near: Region, slants: Sequence[Sloped]) -> Callable[[float], float]:
    """The area that some slants take together of a region, by the height: of fine polygons, none of which is traced."""
    places = [_open_to(near, each) for each in slants]

    def area(z: float) -> float:
        gone = []
        for each, place in zip(slants, places):
            if (out := each.at(z)) > each.near + TINY:
                gone.append(shapely.intersection(place, covered(list(each.bands(out)))))
        return float(shapely.union_all(gone).area)

    return area


def _open_to(near: Region, slant: Sloped) -> Any:
    """Where a slant may take something of a region: on its side of the edge."""
    place = polygons_of(near.loops)
    if not isinstance(slant, Bevel):
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
