"""A milled design as what a part is compared with."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from mnclab.design.difference.target import BLANK, Grid, Owner, Slopes, Walls
from mnclab.design.model.design import Design
from mnclab.design.model.measures import Measure
from mnclab.design.model.removals import CLEARANCE, Bevel, Cone, Flat, Ramp, Sloped, within
from mnclab.design.model.shapes import on_elements, spread
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import at_angle
from mnclab.geometry.regions import Region
from mnclab.geometry.signed import signed
from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.milling.raster import Raster
from mnclab.workpiece.workpiece import Workpiece

if TYPE_CHECKING:
    from mnclab.design.difference.deviations import Seen
    from mnclab.design.difference.target import Reading
    from mnclab.workpiece.cutting import Cutting

FEWEST = 5  # places of an element
TURN = np.radians(5)  # of an arc, between two places
EDGE = 1e-3  # mm, from an end or an edge: places lie a hair beside them
ASIDE = 1e-6  # mm, on either side of a face
SAME = 1e-7  # mm: heights of one face
SMALL = 6  # cells: floors that are not wider are looked at between them, too
SHARES = (0.02, 0.15, 0.35, 0.5, 0.65, 0.85, 0.98)  # of a slant, from its foot to its edge


class DrawnTarget:
    """The owner of a face is the number of the body that made it, an index into `design.taken`; `cutting` has the rows that cut
    the part that is compared, those of its threads among them."""

    def __init__(self, design: Design, tolerance: float, cutting: Cutting) -> None:
        self.design, self.tolerance, self.cutting = design, tolerance, cutting
        self.name, self.error = design.title or "design", 0.0

    @property
    def bounds(self) -> Array:
        return self.design.bounds

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        return self.design.faces(x, y)

    def distance(self, points: Array) -> Array:
        return self.design.stack.distance(points)

    def grid(self, raster: Raster) -> Grid:
        return Grid(*self.design.makers_over(raster.x, raster.y))

    def cut(self, plane: str, at: float) -> list[Contour]:
        """A section, as of a workpiece."""
        return list(self.design.section(at).loops) if plane == "XY" else self._workpiece.cut(plane, at)

    @cached_property
    def _workpiece(self) -> Workpiece:
        return self.design.workpiece()

    # --- places to look at -------------------------------------------------------------------------------------------

    @property
    def _upright(self) -> Iterator[tuple[int, Region, float]]:
        """Owner, region, and on which side of its boundary the void is: 1 left."""
        yield BLANK, self.design.outline_of_blank, -1.0
        for k, (_, _, body) in enumerate(self.design.taken):
            if isinstance(body, Flat | Ramp):
                yield k, body.region, 1.0

    def walls(self, spacing: float) -> Walls:
        (x0, y0), (x1, y1) = self.bounds[:, :2].tolist()
        found, owners, wide = list[tuple[Array, Array, Mask]](), list[Index](), EDGE * np.ones(2)
        for number, region, void in self._upright:
            for loop in region.loops:
                spots, aside, mid = _along(loop, spacing)
                near = ((spots >= (x0, y0) - wide) & (spots <= (x1, y1) + wide)).all(axis=1)
                found.append((spots[near], void * aside[near], mid[near]))
                owners.append(np.full(int(near.sum()), number))
        place, normal, middle = (np.concatenate(column) for column in zip(*found, strict=True))
        owner = np.concatenate(owners)
        spots = np.concatenate([place - ASIDE * normal, place + ASIDE * normal])
        spot, heights, talls = list[Index](), list[Array](), list[Array]()
        tallest = np.zeros(len(place))
        for slab in self.design.stack.slabs:  # where what stands upright may change
            low, high = slab.low, slab.high
            tall, hair = high - low, min(EDGE, (high - low) / 4)
            stands = self._material(spots, (low + high) / 2)
            on = stands[: len(place)] & ~stands[len(place) :] & self._reached(owner, (low + high) / 2)
            falls = any(isinstance(body, Ramp) and body.low < high and body.high > low for body in self._slants)
            for z, counts in ((low + hair, 0.0), ((low + high) / 2, tall), (high - hair, 0.0)):
                if falls:
                    stands = self._material(spots, z)
                    on = stands[: len(place)] & ~stands[len(place) :] & self._reached(owner, z)
                here = np.flatnonzero(on)
                for body in self._slants:
                    if not body.upright and body.low < z < body.high:
                        here = here[body.taken(spots[here, 0], spots[here, 1], np.full(len(here), z)) > ASIDE]
                spot.append(here)
                heights.append(np.full(len(here), z))
                talls.append(np.full(len(here), counts))
                tallest[here] = np.maximum(tallest[here], counts)
        index, height = np.concatenate(spot), np.concatenate(talls)
        mid = (height > 0) & (height == tallest[index])
        return Walls(place, normal, owner, middle.astype(bool), index, np.concatenate(heights), mid.astype(bool))

    @cached_property
    def _slants(self) -> list[Sloped]:
        return [each.body for each in self.design.taken if not isinstance(each.body, Flat)]

    def _material(self, spots: Array, z: float) -> Mask:
        """Whether upright material stands at places (m, 2) in a height, with what slants off."""
        found = self.design.outline_of_blank.contains(spots)
        for each in self.design.taken:
            if each.body.upright and each.body.reaches(z):
                some = np.flatnonzero(found)
                found[some[within(each.body.section(z), *spots[some].T)]] = False
        return found

    def _reached(self, owner: Index, z: float) -> Mask:
        """Whether the feature that a wall belongs to (m,) goes as far as a height."""
        reaches = [each.body.upright and bool(each.body.reaches(z)) for each in self.design.taken]
        return np.array([*reaches, True])[owner]

    def slopes(self, spacing: float, step: float) -> Slopes:
        found = []
        for k, (_, _, body) in enumerate(self.design.taken):
            if isinstance(body, Flat):
                for spots in self._inside(body, spacing, step) if body.part != CLEARANCE else ():
                    found.append((spots, *(np.full(len(spots), value) for value in (body.floor, 0.0, k, body.up, True))))
                continue
            for share in SHARES:
                z = body.deep + share * (body.open - body.deep)
                out = body.at(z)
                middle = share not in (SHARES[0], SHARES[-1])
                for spots in self._rings(body, out, spacing):
                    found.append((spots, *(np.full(len(spots), value) for value in (z, out, k, body.up, middle))))
        if not found:
            none = np.zeros(0)
            return Slopes(np.zeros((0, 2)), none, none, none.astype(np.int64), none.astype(bool), none.astype(bool))
        place, height, away, owner, up, far = (np.concatenate(column) for column in zip(*found, strict=True))
        floor, top = self.faces(*place.T)
        on = np.abs(np.where(up, top, floor) - height) <= SAME
        return Slopes(place[on], height[on], away[on], owner[on].astype(np.int64), up[on].astype(bool), far[on].astype(bool))

    def _inside(self, body: Flat, spacing: float, step: float) -> Iterator[Array]:
        """Places within a small region, in which few middles of cells lie."""
        wide = 2 * body.region.area / max(sum(loop.length for loop in body.region.loops), EDGE)
        if wide > SMALL * step:
            return
        low, high = self.bounds[:, :2]
        for loop in body.region.loops:
            spots, aside, _ = _along(loop, spacing)
            for share in (0.1, 0.45):
                inside = spots + share * wide * aside
                yield inside[((inside >= low) & (inside <= high)).all(axis=1)]

    def _rings(self, body: Sloped, out: float, spacing: float) -> Iterator[Array]:
        """Places at a distance from the base of a slant."""
        if isinstance(body, Ramp):
            across = np.linspace(-0.5, 0.5, max(int(np.ceil(body.width / spacing)), FEWEST) + 2)[1:-1, None] * body.width
            (c, s), away = body.ahead, out * np.array(body.ahead)
            yield np.array(body.start) + away + across * (-s, c)
            return
        if isinstance(body, Cone):
            count = max(int(np.ceil(2 * np.pi / (2 * TURN))), 8)
            yield np.array(body.centre) + out * at_angle(2 * np.pi * np.arange(count) / count)
            return
        assert isinstance(body, Bevel)
        low, high = self.bounds[:, :2]
        for loop in body.edges:
            spots, aside, _ = _along(loop, spacing)
            spots = spots - out * aside
            inside = ((spots >= low) & (spots <= high)).all(axis=1)
            spots = spots[inside]
            if len(spots):
                yield spots[np.abs(body.away(*spots.T) - out) <= SAME]

    # --- whose they are ----------------------------------------------------------------------------------------------

    def owner(self, number: int) -> Owner:
        if number == BLANK:
            return Owner("top", "blank")
        feature, back, _ = self.design.taken[number]
        given = self._measures[back][feature]
        wide = {kind: max((abs(each) for m in given if m.limits and m.kind == kind for each in m.limits), default=0.0)
                for kind in ("length", "diameter", "radius", "place", "depth", "chamfer")}  # fmt: skip
        walls = max(wide["length"] / 2, wide["diameter"] / 2, wide["radius"], wide["place"], wide["chamfer"])
        return Owner("back" if back else "top", self.names[back][feature], walls, wide["depth"])

    @cached_property
    def names(self) -> tuple[tuple[str, ...], tuple[str, ...]]:
        """Of the features, and of those of the back."""
        return self.design.drawn_names(), self.design.drawn_names(back=True)

    @cached_property
    def _measures(self) -> tuple[list[tuple[Measure, ...]], ...]:
        return tuple([each.measures() for each in side] for side in (self.design.features, self.design.back))

    def owners(self, points: Array, off: Array) -> Index:
        low, high = self.bounds[:, 2].tolist()
        x, y, z = points.T
        side = np.abs(signed(self.design.outline_of_blank, points[:, :2]))
        best = np.abs(np.minimum(np.minimum(side, np.abs(z - low)), np.abs(high - z)) - off)
        found = np.full(len(points), BLANK)
        for k, (_, _, body) in enumerate(self.design.taken):
            if not len(points) or body.part == CLEARANCE:
                continue
            miss = np.abs(body.from_faces(x, y, z) - off)
            better = miss <= best + SAME
            found[better], best = k, np.minimum(best, miss)
        return found

    def readings(self, seen: Seen) -> Iterator[Reading]:
        from mnclab.design.difference.measuring import readings

        return readings(self, seen)


def _along(loop: Contour, spacing: float) -> tuple[Array, Array, Mask]:
    """Places (m, 2) along a loop, a hair inside the ends of its elements, the direction to the left of it there, and
    whether they are in the middle half of an element."""
    element, share = spread(loop, spacing, FEWEST, TURN, EDGE)
    _, spots, aside = on_elements(loop, element, share)
    return spots, aside, np.abs(share - 0.5) <= 0.25 + SAME
