"""Upright prisms along one axis, combined: the exact distance from what is left, in the material and outside.

Between two neighbouring heights the material has one outline: a slab. The distance from a slab is that in the plane and
that in height together, and the least over all slabs is that from the part; the air is a stack of slabs as well.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property, reduce
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.frames import IDENTITY, Matrix, inverse
from mnclab.geometry.regions import Region, joined, less
from mnclab.geometry.signed import Edges, edges_of, from_arcs, from_lines, winding

Floats = NDArray[np.float64]
Operation = Literal["|", "&", "-"]

NOTHING = Region(())
THIN = 1e-9  # mm, of a slab that is none
PARALLEL = 1e-12  # of a direction, by which two axes may differ that are one
DIGITS = 9  # mm: elements that agree in so many are one
PAIRS = 2_000_000  # of points and elements that are looked at together


@dataclass(frozen=True, eq=False)
class Prism:
    """All of a region between two heights, mm, which may be infinite."""

    region: Region
    low: float
    high: float

    def moved(self, frame: Matrix) -> Prism:
        """The same under a frame that leaves its axis upright."""
        loops = [loop.transformed(frame) for loop in self.region.loops]
        if np.linalg.det(frame[:2, :2]) < 0:
            loops = [loop.reversed() for loop in loops]
        low, high = sorted(frame[2, 2] * z + frame[2, 3] for z in (self.low, self.high))
        return Prism(Region(tuple(loops)), float(low), float(high))


class Joint(NamedTuple):
    """Some bodies together, what they share, or the first less all others."""

    operation: Operation
    bodies: tuple[Body, ...]


Body = Prism | Joint


class Slab(NamedTuple):
    """What the material has between two heights, perhaps nothing."""

    low: float
    high: float
    region: Region


class SlabWalls(NamedTuple):
    """The lines, arcs and whole circles of all outlines, each once, u in all. Of those slabs that have an outline: the numbers
    of their elements one after the other, where each slab begins among these, and how often it has an element (u, s)."""

    lines: Edges
    arcs: Edges
    circles: Edges
    element: NDArray[np.intp]
    begin: NDArray[np.intp]
    times: Floats


@dataclass(frozen=True, eq=False)
class Prisms:
    """A body of prisms, upright in its own `frame`, which is None where it was not placed; a function from points (n, 3) to
    distances (n,).

    `taper`: by how much its walls stand out for each mm below its top.
    """

    body: Body
    frame: Matrix | None = None
    taper: float = 0.0

    def combined(self, operation: Operation, other: Prisms) -> Prisms | None:
        """Both together; None where they have no common axis."""
        if self.taper or other.taper:
            return None
        theirs = other.body
        if self.frame is not other.frame:
            between = inverse(self.placing) @ other.placing
            if np.abs([*between[:2, 2], *between[2, :2]]).max() > PARALLEL:
                return None
            theirs = _moved(theirs, between)
        mine, joint = self.body, isinstance(self.body, Joint) and self.body.operation == operation
        return replace(self, body=Joint(operation, (*(mine.bodies if joint else (mine,)), theirs)))  # type: ignore[union-attr]

    def placed(self, frame: Matrix) -> Prisms:
        return replace(self, frame=frame @ self.placing)

    @property
    def placing(self) -> Matrix:
        """Its frame."""
        return IDENTITY if self.frame is None else self.frame

    @cached_property
    def slabs(self) -> tuple[Slab, ...]:
        """From below to above all heights, those without material too."""
        prisms = list(_prisms(self.body))
        heights = sorted({z for each in prisms for z in (each.low, each.high) if np.isfinite(z)})
        levels = [-np.inf, *(z for k, z in enumerate(heights) if k == 0 or z - heights[k - 1] > THIN), np.inf]
        found, known = list[Slab](), dict[tuple[bool, ...], Region]()
        for low, high in zip(levels, levels[1:]):
            z = _between(low, high)
            here = tuple(each.low < z < each.high for each in prisms)
            if here not in known:
                known[here] = _section(self.body, z)
            found.append(Slab(float(low), float(high), known[here]))
        return tuple(found)

    @cached_property
    def solid(self) -> tuple[Slab, ...]:
        """The slabs that have material."""
        return tuple(slab for slab in self.slabs if slab.region.loops)

    @cached_property
    def top(self) -> float:
        """The highest height of the material, mm; infinite where it has no end."""
        return self.solid[-1].high if self.solid else -np.inf

    @cached_property
    def _walls(self) -> SlabWalls:
        every = [_kinds(np.array(edges_of(slab.region)).T) for slab in self.solid]
        sizes = [len(kind) for kind, _ in every]
        kind, columns = (np.concatenate(each) for each in zip(*every))
        keys = np.column_stack([kind, columns[:, [0, 1, 2, 3, 5]].round(DIGITS)])
        once, first, element = np.unique(keys, axis=0, return_index=True, return_inverse=True)  # lines, arcs, circles
        lines, arcs, circles = (Edges(*columns[first[once[:, 0] == each]].T) for each in range(3))
        times, begin = np.zeros((len(once), len(sizes))), np.cumsum([0, *sizes[:-1]])
        np.add.at(times, (element.ravel(), np.repeat(np.arange(len(sizes)), sizes)), 1.0)
        return SlabWalls(lines, arcs, circles, element.ravel(), begin, times)

    @cached_property
    def _ends(self) -> tuple[Floats, Floats, NDArray[np.bool_]]:
        """Lower and upper ends of all slabs, and which have material."""
        low, high, _ = zip(*self.slabs)
        return np.array(low), np.array(high), np.array([bool(slab.region.loops) for slab in self.slabs])

    def __call__(self, points: Floats) -> Floats:
        if not self.solid:
            return np.full(len(points), np.inf)
        many = max(PAIRS // max(len(self._walls.element), len(self.slabs)), 1)
        if len(points) > many:
            return np.concatenate([self(points[k : k + many]) for k in range(0, len(points), many)])
        if self.frame is not None:
            points = (points - self.frame[:3, 3]) @ self.frame[:3, :3]
        x, y, z = points[:, :1], points[:, 1:2], points[:, 2:]
        low, high, filled = self._ends
        aside = np.full((len(points), len(low)), np.inf)
        aside[:, filled] = self._aside(x, y)
        if self.taper:
            aside = (aside - self.taper * (self.top - np.clip(z, low, high))) / np.hypot(1.0, self.taper)
        beyond = np.maximum(np.maximum(low - z, z - high), 0.0)
        inside = ((aside <= 0) & (beyond <= 0)).any(axis=1)
        aside[inside] *= -1.0
        found = np.sqrt((np.maximum(aside, 0.0) ** 2 + beyond**2).min(axis=1))
        return np.where(inside, -found, found)

    def _aside(self, x: Floats, y: Floats) -> Floats:
        """Signed distances (n, s) in the plane from the outlines of those slabs that have one, of points (n, 1)."""
        walls = self._walls
        off, rounds = list[Floats](), list[Floats]()
        for edges, measure in ((walls.lines, from_lines), (walls.arcs, from_arcs)):
            if len(edges.x):
                off.append(measure(edges, ..., x, y))
                rounds.append(winding(edges, ..., x, y))
        if len(walls.circles.x):
            beyond = np.hypot(x - walls.circles.u, y - walls.circles.v) - walls.circles.radius
            off.append(np.abs(beyond))
            rounds.append(np.where(beyond < 0, np.sign(walls.circles.sweep), 0.0))
        near = np.minimum.reduceat(np.concatenate(off, axis=1)[:, walls.element], walls.begin, axis=1)
        return np.where(np.concatenate(rounds, axis=1) @ walls.times > 0.5, -near, near)


def _kinds(columns: Floats) -> tuple[Floats, Floats]:
    """The elements of an outline (e, 12): 0 a line, 1 an arc, 2 a whole circle, which counts once, and their columns."""
    same = (columns == np.roll(columns, -1, axis=0))[:, [5, 6, 7, 8]].all(axis=1)
    whole = np.isclose(np.abs(columns[:, 5]), np.pi, rtol=0, atol=1e-12) & same  # two halves follow each other
    whole[-1] = False
    second = np.roll(whole, 1)
    kind = np.where(whole, 2.0, columns[:, 5] != 0)
    return kind[~second], columns[~second]


def _between(low: float, high: float) -> float:
    """A height between two that may be infinite."""
    if np.isinf(low):
        return 0.0 if np.isinf(high) else high - 1.0
    return low + 1.0 if np.isinf(high) else (low + high) / 2


def _moved(body: Body, frame: Matrix) -> Body:
    if isinstance(body, Prism):
        return body.moved(frame)
    return Joint(body.operation, tuple(_moved(each, frame) for each in body.bodies))


def _prisms(body: Body) -> Iterator[Prism]:
    if isinstance(body, Prism):
        yield body
    else:
        for each in body.bodies:
            yield from _prisms(each)


def _section(body: Body, z: float) -> Region:
    if isinstance(body, Prism):
        return body.region if body.low < z < body.high else NOTHING
    first, *others = (_section(each, z) for each in body.bodies)
    if body.operation == "-":
        return less(first, others)
    if body.operation == "|":
        return reduce(joined, others, first)
    return reduce(_shared, others, first)


def _shared(one: Region, other: Region) -> Region:
    return one.intersection(other) if one.loops and other.loops else NOTHING
