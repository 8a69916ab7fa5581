"""A part as a stack of slabs: between two heights a region, less what slants off; section, volume and exact distance.

A region that does not change with the height makes a slab an upright prism: the distance of a point from it is that
in the plane and that in height together, and the least over all slabs is that from the part. A slab that something
slants off has a core that stands upright and, under each slant, a wedge.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mnclab.design.model.removals import NOTHING, Flat, Removal, Slant, Slanting
from mnclab.design.model.slanted import slanted_off
from mnclab.geometry.regions import Region, less
from mnclab.geometry.signed import signed
from mnclab.path.toolpath import Array, Index, Mask

THIN = 1e-9  # mm, of a slab that is none


@dataclass(frozen=True, eq=False)
class Slab:
    """Material between `low` and `high`, mm: `region`, less what `slants` take away from it."""

    low: float
    high: float
    region: Region
    slants: tuple[Slant, ...] = ()

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

    def away(self, slant: Slant, index: Index) -> Array:
        return self._once(slant, index, lambda some: slant.away(*some.T))

    def taken(self, slant: Slant, index: Index, z: Array) -> Array:
        """How far points are from what a slant takes away; 0 within."""
        return self._across(slant, index, slant.taken_out(self.away(slant, index), z[index]))

    def left(self, slab: Slab, slant: Slant, index: Index, z: Array) -> Array:
        """How far points are from what a slant leaves of a slab, at least."""
        return self._across(slant, index, slant.left(slab.low, slab.high, self.away(slant, index), z[index]))

    def _across(self, slant: Slant, index: Index, along: Array) -> Array:
        return along if isinstance(slant, Slanting) else np.hypot(along, slant.beside(*self._spots[index].T))

    def _once(self, what: Region | Slant, index: Index, of: Callable[[Array], Array]) -> Array:
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
