"""A part as a stack of slabs: between two heights a region, less what slants off; section, volume and exact distance.

A region that does not change with the height makes a slab an upright prism: the distance of a point from it is that
in the plane and that in height together, and the least over all slabs is that from the part. A slab that something
slants off has a core that stands upright and, under each slant, a wedge.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mnclab.geometry.apart import less
from mnclab.geometry.regions import Region
from mnclab.path.columns import Array
from mnclab.workpiece.design.removals import NOTHING, Flat, Removal, Slant, signed
from mnclab.workpiece.design.slanted import slanted_off

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
        """Signed distances (m,) of points (m, 3): negative in the material, exact; at corners of a chamfer as if rounded."""
        x, y, z = points.T
        plane = self._in_plane(points[:, :2])
        inside, out, deep = np.zeros(len(z), dtype=bool), np.full(len(z), np.inf), np.full(len(z), np.inf)
        for slab in self.slabs:
            off = np.maximum(np.maximum(slab.low - z, z - slab.high), 0.0)
            region, core = plane[id(slab.region)], plane[id(slab.core)]
            whole = np.hypot(np.maximum(region, 0.0), off)
            out = np.minimum(out, np.hypot(np.maximum(core, 0.0), off))
            deep = np.minimum(deep, np.hypot(np.maximum(-region, 0.0), off))
            here = (region <= 0) & (off == 0)
            for each in slab.slants:
                out = np.minimum(out, np.maximum(each.left(slab.low, slab.high, x, y, z), whole))
                taken = each.taken(x, y, z)
                deep = np.minimum(deep, taken)
                here &= taken > 0
            inside |= here
        low, high = self.slabs[0].low, self.slabs[-1].high
        deep = np.minimum(deep, np.minimum(np.abs(z - low), np.abs(high - z)))
        return np.where(inside, -deep, out)

    def _in_plane(self, spots: Array) -> dict[int, Array]:
        """Signed distances from every region of the slabs, each worked out once."""
        found: dict[int, Array] = {}
        for slab in self.slabs:
            for region in (slab.region, slab.core):
                if id(region) not in found:
                    found[id(region)] = signed(region, spots)
        return found
