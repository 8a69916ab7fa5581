"""Fine roughing: what a coarse tool left standing, and the passes of a finer tool through it. Lengths in mm.

    rest = what discs of radius R reach less what discs of the coarse radius reach

The finer tool runs on its rings, but only where its disc touches the rest, and a little before and behind. So a pass
begins where the coarse tool has cleared, and cuts in from the side; a ring that lies in the rest all round has no such
place. It waits for a pass beside it, a stepover away, to lead to it; if there is none, the tool must plunge.

An area is what is connected of the rest. Between two passes the tool goes straight or along a ring or a wall, through
what is cleared: the shortest of these ways, if there is one; else it lifts.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour, joined
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import broad, covered, left_over, polygons
from mnclab.machining.milling.clearing import Clearing, Piece, begin, end, numbered, tool_centres
from mnclab.machining.milling.rings import rings_in_order, rounded

LEAST = 1e-3  # mm: rest that is nowhere thicker counts as none
OVERLAP = 0.1  # of the tool radius, along a pass before and behind the rest
GAP = 1.0  # of the tool radius: a shorter way through air parts no pass
SAMPLES = 32  # to a tool radius, along a pass
SLACK = 0.01  # of the tool radius that a way through what is cleared may scrape off


def left_between(
    region: Region, radius: float, coarse_radius: float, allowance: float = 0.0, *, corner_radius: float = 0.0
) -> Region:
    """What a tool of `radius` reaches of an area and one of `coarse_radius` left, as rings clear it; empty if there is nothing.

    `corner_radius` is that of the inside corners of the passes of both, as measured on the tool centre.
    """
    if coarse_radius <= radius:
        return Region()
    return reached(region, radius, allowance, corner_radius).difference(
        reached(region, coarse_radius, allowance, corner_radius)
    )


def reached(region: Region, radius: float, allowance: float = 0.0, corner_radius: float = 0.0) -> Region:
    """What rings of a tool clear of an area, if they leave nothing between them."""
    centres = region.inset(radius + allowance)
    return Region(tuple(rounded(loop, corner_radius) for loop in centres.loops)).offset(radius)


def rest_passes(
    region: Region, radius: float, stepover: float, coarse_radius: float, *, allowance: float = 0.0, climb: bool = True,
    corner_radius: float = 0.0, connect: bool = True, least: float = LEAST,
) -> Clearing:  # fmt: skip
    """Passes that clear what a tool of `coarse_radius` left, in the order of `rings`; no piece where it left nothing.

    Each piece is run at depth from its begin to its end; `from_side` tells whether it begins in what is cleared. `connect`
    lets it go on from area to area, where a way through what is cleared leads there, else each area is a piece of its own.
    Rest that is nowhere thicker than `least` is left. A ValueError where the tool does not fit.
    """
    centres = tool_centres(region, radius, stepover, allowance)
    left = left_between(region, radius, coarse_radius, allowance, corner_radius=corner_radius)
    plan = _Plan(centres, radius, stepover, connect, _thick(left, least))
    for number, part in enumerate(centres.parts if plan.stands else ()):
        for ring in rings_in_order(part, radius, stepover, corner_radius):
            plan.add(number, ring.contour if climb else ring.contour.reversed())
    return Clearing(centres, tuple(plan.pieces()), radius)


def touching(
    contour: Contour, left: Region, radius: float, *, overlap: float = 0.0, gap: float = 0.0, least: float = LEAST
) -> tuple[Contour, ...]:
    """The stretches of a contour on which a disc of `radius` about it touches an area, grown by `overlap` at their ends.

    Gaps shorter than `gap` are closed. The contour itself where it touches all along; stretches are too long by R/16 at most.
    """
    standing = _thick(left, least)
    return tuple(cut.contour for cut in _cuts(contour, standing, radius, overlap, gap)) if len(standing) else ()


def _thick(left: Region, least: float) -> NDArray[Any]:
    """The pieces of an area that are somewhere thicker, as shapely areas."""
    return np.asarray(shapely.get_parts(broad(polygons(left), least)) if left.loops else [], dtype=object)


@dataclass(frozen=True, eq=False)
class _Cut:
    """A pass, the whole contour `along` which it runs, and the area of the rest that it belongs to."""

    contour: Contour
    along: Contour
    area: tuple[int, int] = (0, 0)


def _cuts(contour: Contour, standing: NDArray[Any], radius: float, overlap: float, gap: float) -> Iterator[_Cut]:
    """The stretches of a contour that touch what stands.

    The middle of each of its steps, h long, is asked whether it is nearer than R + h/2: then no place on it that touches
    is missed, and what is not marked lies at R or farther.
    """
    length = contour.length
    count = max(8, int(np.ceil(length * SAMPLES / radius)))
    step = length / count
    middles = shapely.points(contour.point_at((np.arange(count) + 0.5) * step)[0])
    tree = shapely.STRtree(middles)
    near = np.zeros(count, dtype=bool)
    near[tree.query(standing, predicate="dwithin", distance=radius + step / 2)[1]] = True
    if near.all():
        yield _Cut(contour, contour)
        return
    if not near.any():
        return
    shift = int(np.flatnonzero(~near)[0]) if contour.closed else 0  # so that no stretch goes over the begin
    change = np.flatnonzero(np.diff(np.concatenate([[False], np.roll(near, -shift), [False]])))
    first, last = (change.reshape(-1, 2).T + shift) * step
    first, last = first - overlap, last + overlap
    far = first[1:] - last[:-1] > gap
    first, last = first[np.append(True, far)], last[np.append(far, True)]
    for a, b in zip(first, last, strict=True):
        yield _Cut(contour.between(a, b), contour)


@dataclass
class _Plan:
    """The passes of fine roughing as they come, and what of the rest still stands."""

    centres: Region
    radius: float
    stepover: float
    connect: bool
    standing: NDArray[Any]  # of shapely areas
    cuts: dict[tuple[int, int], list[_Cut]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        grown = shapely.buffer(self.standing, self.radius * (1 + OVERLAP + 1 / SAMPLES))
        self.areas = shapely.get_parts(shapely.union_all(grown))

    @property
    def stands(self) -> bool:
        return len(self.standing) > 0

    def add(self, part: int, ring: Contour) -> None:
        """The stretches of a ring, each put to its area."""
        for cut in _cuts(ring, self.standing, self.radius, OVERLAP * self.radius, GAP * self.radius):
            middle = shapely.Point(*cut.contour.point_at(cut.contour.length / 2)[0])
            area = int(shapely.distance(self.areas, middle).argmin())
            self.cuts.setdefault((part, area), []).append(replace(cut, area=(part, area)))

    def pieces(self) -> Iterator[Piece]:
        """The passes area by area, each the nearest to the last, in pieces that are run without lifting."""
        names = iter(numbered("area", len(self.cuts)))
        run: list[tuple[Contour, str]] = []
        last: _Cut | None = None
        from_side = False
        while self.cuts:
            area = self._nearest(last)
            todo, name = self.cuts.pop(area), next(names)
            for label in numbered(f"{name}, pass", len(todo)):
                here = last if last is not None and (self.connect or last.area == area) else None
                cut, way = self._next(todo, here)
                if here is None or way is None:
                    if run:
                        yield self._piece(run, from_side)
                    run, from_side = [], self._is_free(begin(cut.contour))
                elif len(way):
                    run.append((joined(way), "way along the contour"))
                run.append((cut.contour, label))
                self._clear(cut.contour)
                last = cut
        if run:
            yield self._piece(run, from_side)

    def _piece(self, run: list[tuple[Contour, str]], from_side: bool) -> Piece:
        passes, labels = zip(*run, strict=True)
        return Piece(self.centres, passes, (True,) * (len(passes) - 1), labels, from_side=from_side)

    def _nearest(self, last: _Cut | None) -> tuple[int, int]:
        """The next area: one of the same part of the tool-centre area if there is one left, of these the nearest."""
        if last is None:
            return next(iter(self.cuts))
        here = end(last.contour)

        def away(area: tuple[int, int]) -> tuple[bool, float]:
            spots = np.array([begin(cut.contour) for cut in self.cuts[area]])
            return area[0] != last.area[0], float(np.hypot(*(spots - here).T).min())

        return min(self.cuts, key=away)

    def _next(self, todo: list[_Cut], last: _Cut | None) -> tuple[_Cut, list[Contour] | None]:
        """The next pass of an area: the first that the tool can go on to, else one that begins beside the material."""
        for k, cut in enumerate(todo if last is not None else ()):
            assert last is not None
            met = self._met(last, cut)
            way = self._way(last, met)
            if way is not None:
                todo.pop(k)
                return met, way
        free = [k for k, cut in enumerate(todo) if self._is_free(begin(cut.contour))]
        return todo.pop(free[0] if free else 0), None

    def _met(self, last: _Cut, cut: _Cut) -> _Cut:
        """A ring begun where it is nearest to the last pass, and of such places to its end; a stretch as it is."""
        if not cut.contour.closed:
            return cut
        back = last.contour.reversed().points_within(0.01 * self.radius)
        off = cut.contour.distance(back)
        spot = back[int(np.flatnonzero(off <= off.min() + 0.01 * self.radius)[0])]
        ring = cut.contour.started_at(cut.contour.nearest(spot))
        return replace(cut, contour=ring, along=ring)

    def _way(self, last: _Cut, cut: _Cut) -> list[Contour] | None:
        """The shortest way at depth to a pass: straight, or along a ring or a wall with a straight way on and off."""
        a, b = end(last.contour), begin(cut.contour)
        ways = [[_straight(a, b)]]
        for track in (last.along, cut.along, *self.centres.parts[cut.area[0]].loops):
            there, back = track.nearest(a), track.nearest(b)
            if track.closed:
                forward = (back - there) % track.length
                pieces = [track.between(there, there + forward), track.between(back, back + track.length - forward).reversed()]
            else:
                pieces = [track.between(there, back) if there < back else track.between(back, there).reversed()]
            ways += [[_straight(a, begin(piece)), piece, _straight(end(piece), b)] for piece in pieces]
        for way in sorted(ways, key=lambda way: sum(piece.length for piece in way)):
            if self._is_clear(way):
                return [] if len(way) == 1 else [piece for piece in way if piece.length > 0]
        return None

    def _is_clear(self, way: list[Contour]) -> bool:
        """Whether a way leads through what is cleared, but for a last step into the material, of a stepover at most."""
        *before, final = way
        asked = before if final.length <= self.stepover * (1 + SLACK) else way
        lines = [shapely.LineString(piece.points_within(SLACK * self.radius / 4)) for piece in asked if piece.length > 0]
        near = self.radius * (1 - SLACK)
        if any(shapely.dwithin(self.standing, line, near).any() for line in lines):
            return False
        straight = way if len(way) == 1 else way[::2]
        return all(self.centres.holds(*piece.points) for piece in straight if piece.length > 0)

    def _is_free(self, spot: Floats) -> bool:
        return not shapely.dwithin(self.standing, shapely.Point(*spot), self.radius * (1 - SLACK)).any()

    def _clear(self, contour: Contour) -> None:
        """Takes away what a pass has cut."""
        cut = covered([contour], self.radius)
        touched = shapely.intersects(self.standing, cut)
        less = shapely.get_parts(shapely.difference(self.standing[touched], cut))
        self.standing = np.concatenate([self.standing[~touched], less])


def _straight(a: Floats, b: Floats) -> Contour:
    return Contour([a, b], closed=False)


# What passes leave of an area that should be cut: areas, mm². Lengths in mm.
# line ends within a surface       a disc of radius R leaves ╭ and ╮ in the corners and, where two lines are not joined
#                                  at their ends, a cusp ◠ between them

def beside_disc(a: float, b: float, radius: float) -> float:
    """The area of a rectangle, `a` by `b` (at most the radius), that a disc about one of its corners does not cover.

    >>> round(beside_disc(10, 10, 10), 6) == round(100 - 25 * math.pi, 6)
    True
    """

    def under(x: float) -> float:  # the disc from 0 to x
        return (
            x * math.sqrt(max(radius * radius - x * x, 0.0)) + radius * radius * math.asin(min(x / radius, 1.0))
        ) / 2

    covered = min(a, math.sqrt(max(radius * radius - b * b, 0.0)))  # as far as the disc is higher than b
    return b * (a - covered) - (under(a) - under(covered))


def within(length: float, width: float, radius: float, places: Sequence[float], outside: bool = False) -> float:
    """The area of a `length` by `width` that a zigzag leaves whose ends lie a radius within the surface.

    Lines run along the length at `places` from one edge of the width, joined in turn at the far and the near end; those of
    a surface shorter than the tool are a point. Of a surface from 2 R to 3 R long the area is a hair too large: there one end
    of the lines reaches what stands at the other. `outside`: the first line begins outside.
    """
    a, b = min(radius, length / 2), min(radius, width / 2)
    covered = places[0] + radius if outside else -math.inf  # at the near end the first line comes over all below this

    def left(deep: float, below: float = 0.0) -> float:  # beside the disc at an end of a line, to this distance from it
        return beside_disc(deep, a, radius) - beside_disc(min(max(below, 0.0), deep), a, radius)

    near = left(b, covered - places[-1]) + (0.0 if outside else left(b))
    far = 2 * left(b)
    for k, (one, other) in enumerate(pairwise(places if length > 2 * radius else ())):
        half, middle = (other - one) / 2, (one + other) / 2
        if k % 2:  # joined at the near end
            far += 2 * left(half)
        else:
            near += left(half, covered - one) + left(min(half, max(0.0, other - max(covered, middle))))
    return near + far


def left_by(clearing: Clearing, material: Region | None = None) -> float:
    """The area that the passes of a clearing leave of all that the tool could reach, or of some material in its reach.

    Slivers of a thousandth of R do not count.
    """
    radius, ways = clearing.radius, list(clearing.passes)
    for piece in clearing.pieces:
        for linked, (a, b) in zip(piece.linked, pairwise(piece.passes), strict=True):
            if linked:
                ways.append(Contour([end(a), begin(b)], closed=False))
    reach = polygons(clearing.centres.offset(radius) if material is None else material)
    return left_over(reach, covered(ways, radius), radius * 1e-3).area
