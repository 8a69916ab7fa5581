"""Areas with islands, bounded by lines and arcs: union, difference, intersection, inset.

Insets are cut out of the moved elements themselves (`insets`). Set operations run in shapely on fine polylines, in which
the lines and arcs are found again (`tracing`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property, lru_cache, reduce
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.geometry import shapely
from mnclab.geometry.chords import near
from mnclab.geometry.contours import SEEN, Contour
from mnclab.geometry.curves import Floats, cross, gap, length_of
from mnclab.geometry.cutting import Outlines, boxes, inset, outlines_of
from mnclab.geometry.tracing import GRID, SAME, TaggedPolylines, inset_by_bands
from mnclab.text.alarm import Alarm, Refused
from mnclab.text.given import check_number, refusing_class, shown
from mnclab.text.tables import svg_of


class CrossesItself(Refused):
    """A contour that encloses no area, and where: (x, y) in mm, None where that is not known."""

    def __init__(self, place: tuple[float, float] | None) -> None:
        super().__init__("the contour crosses or touches itself" + (" near ({:.3f}, {:.3f})".format(*place) if place else ""))
        self.where = place


CLEAR = 1e-3  # mm, between loops of which each lies whole within the other area or outside


@refusing_class
@dataclass(frozen=True, eq=False)
class Region:
    """An area of one or more pieces, each a loop counter-clockwise followed by its islands clockwise.

    The area lies to the left of all its loops. `Region(())` is empty.

    >>> mnc.area.Region.of(mnc.area.rectangle(40, 20)).area
    800.0
    """

    loops: tuple[Contour, ...] = ()

    def __post_init__(self) -> None:
        given = self.loops
        loops = (given,) if isinstance(given, Contour) else tuple(given) if isinstance(given, Iterable) else (given,)
        for each in loops:
            if not isinstance(each, Contour):
                raise Alarm(f"the loops of a region must be contours, got {shown(each)}", hint="Region.of(contour, holes=(…,))")
        object.__setattr__(self, "loops", loops)

    def __repr__(self) -> str:
        return f"<Region: {len(self.loops)} loop{'s' * (len(self.loops) != 1)}, {self.area:.3f} mm²>"

    def _repr_svg_(self) -> str | None:
        return svg_of([loop.points_within(SEEN) for loop in self.loops])

    @classmethod
    def of(cls, *outer: Any, holes: Iterable[Contour] = ()) -> Region:
        """The union of what the outer contours enclose, less what the holes enclose; their sense is free.

        A single contour is kept as it is. Raises ValueError where a contour is open or crosses itself; an Alarm for an outer
        contour that lies within another one, where it changes nothing. What is drawn stands for its area: a pocket of a design
        with its islands, a shape, or a design with one pocket.
        """
        drawn, holes = [getattr(each, "region", each) for each in outer], tuple(holes)
        if any(isinstance(each, Region) for each in drawn):
            whole = reduce(Region.union, (each if isinstance(each, Region) else cls.of(each) for each in drawn))
            return whole.difference(cls.union_of(*holes)) if holes else whole
        return cls._of(drawn, holes, nested=False)

    @classmethod
    def union_of(cls, *contours: Contour, holes: Iterable[Contour] = ()) -> Region:
        """The union of what contours enclose, whatever lies within what, less what the holes enclose."""
        return cls._of(contours, tuple(holes), nested=True)

    @classmethod
    def _of(cls, outer: Sequence[Contour], holes: Sequence[Contour], nested: bool) -> Region:
        drawing = TaggedPolylines([_tidy(contour) for contour in (*outer, *holes)])
        areas = [shapely.Polygon(ring) for ring in drawing.rings]
        for area in areas:
            if not area.is_valid:
                place = shapely.is_valid_reason(area).partition("[")[2].rstrip("]").split()
                raise CrossesItself((float(place[0]), float(place[1])) if len(place) >= 2 else None)
        if not nested and len(outer) > 1:
            inner, around = shapely.STRtree(areas[: len(outer)]).query(areas[: len(outer)], "covered_by")
            for k in inner[inner != around][:1].tolist():
                (x, y), number = drawing.contours[k].points[0].tolist(), len(outer)
                raise Alarm(f"outer contour {k + 1} of {number}, from X{x:.3f} Y{y:.3f}, lies within another one",
                            hint="holes=[…] cuts it out; area_of(contours) finds what lies in what")  # fmt: skip
        if len(areas) == len(outer) == 1:
            contour = drawing.contours[0]
            return cls((contour if contour.area > 0 else contour.reversed(),))
        whole = shapely.union_all(areas[: len(outer)], grid_size=GRID)
        gone = shapely.union_all(areas[len(outer) :], grid_size=GRID)
        return cls(drawing.traced(shapely.difference(whole, gone, grid_size=GRID)))

    def union(self, other: Region) -> Region:
        return self._with("union", other)

    def difference(self, other: Region) -> Region:
        return self._with("difference", other)

    def without(self, others: Sequence[Region]) -> Region:
        """The difference from all of some others at once."""
        rest, hard = self, list[Region]()
        for other in others:
            if _clear(rest.loops, other.loops):
                rest = rest.difference(other)
            else:
                hard.append(other)
        if not hard:
            return rest
        drawing = TaggedPolylines([*rest.loops, *(loop for other in hard for loop in other.loops)])
        first, gone = len(rest.loops), []
        for other in hard:
            gone.append(drawing.area(other.loops, first))
            first += len(other.loops)
        whole = shapely.union_all(gone, grid_size=GRID)
        return Region(drawing.traced(shapely.difference(drawing.area(rest.loops, 0), whole, grid_size=GRID)))

    def intersection(self, other: Region) -> Region:
        return self._with("intersection", other)

    def inset(self, distance: float) -> Region:
        """What is farther than `distance` from everything outside; a negative distance lets the area grow."""
        if distance == 0 or not self.loops:
            return self
        faces = self.loops if distance > 0 else [loop.reversed() for loop in self.loops]
        found = inset(outlines_of(faces), abs(distance))
        if found is None:
            return Region(inset_by_bands(self.loops, distance))
        return _arranged(found.contours if distance > 0 else [loop.reversed() for loop in found.contours])

    def insets(self, step: float) -> Iterator[Region]:
        """The area itself, its insets by `step` > 0, twice that and so on, until nothing is left."""
        check_number(step, "the step of insets (mm)", at_least=1e-6)
        here, level = self, 0
        outlines: Outlines | None = outlines_of(self.loops) if self.loops else None
        while here.loops:
            yield here
            level += 1
            outlines = None if outlines is None else inset(outlines, step)
            here = self.inset(level * step) if outlines is None else _arranged(outlines.contours)

    def offset(self, distance: float) -> Region:
        """What is nearer than `distance` to the area: the inset outwards, corners rounded."""
        return self.inset(-distance)

    @cached_property
    def bounds(self) -> Floats:
        """Lower left and upper right corner `(2, 2)`; an Alarm for an empty area, which has none."""
        if not self.loops:
            raise Alarm("an empty area has no bounds", hint="Region.loops and Region.area tell whether there is any")
        return np.array([self._boxes[:, 0].min(axis=0), self._boxes[:, 1].max(axis=0)])

    @cached_property
    def area(self) -> float:
        return sum(loop.area for loop in self.loops)

    @property
    def parts(self) -> tuple[Region, ...]:
        """The connected pieces, each with its islands."""
        first = [i for i, loop in enumerate(self.loops) if loop.area > 0]
        return tuple(Region(self.loops[i:k]) for i, k in pairwise([*first, len(self.loops)]))

    def contains(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Which of the points `(k, 2)` lie inside, `(k,)`; a point on the boundary may count either way."""
        spots = np.asarray(points, dtype=float).reshape(-1, 2)
        rounds = np.zeros(len(spots), dtype=int)
        for loop, (low, high) in zip(self.loops, self._boxes, strict=True):
            near = np.flatnonzero(((spots >= low) & (spots <= high)).all(axis=1))
            if len(near):
                rounds[near] += loop.winding(spots[near])
        return np.asarray(rounds > 0)

    def distance(self, points: ArrayLike) -> Floats:
        """Distance of the boundary from each of the points `(k, 2)`, never negative, `(k,)`."""
        spots = np.asarray(points, dtype=float).reshape(-1, 2)
        low, high = self._boxes[:, 0], self._boxes[:, 1]
        least = length_of(np.maximum(np.maximum(low - spots[:, None], spots[:, None] - high), 0.0))
        found = np.full(len(spots), np.inf)
        for k in np.argsort(least.min(axis=0, initial=np.inf), kind="stable"):
            nearer = np.flatnonzero(least[:, k] < found)
            if len(nearer):
                found[nearer] = np.minimum(found[nearer], self.loops[k].distance(spots[nearer]))
        return found

    def holds(self, start: ArrayLike, end: ArrayLike, tolerance: float = 1e-6) -> bool:
        """Whether the straight way from start to end stays in the area, or within a tolerance of it.

        The way is cut where it meets the whole line or circle of an element; one point of each piece tells.
        """
        a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
        low, high = np.minimum(a, b) - tolerance, np.maximum(a, b) + tolerance
        near = (self._boxes[:, 0] <= high).all(axis=1) & (self._boxes[:, 1] >= low).all(axis=1)
        cuts = np.concatenate([[0.0, 1.0], *(meeting(self.loops[k], a, b - a) for k in np.flatnonzero(near))])
        cuts = np.unique(cuts[(cuts >= 0) & (cuts <= 1)])
        middles = a + (cuts[1:] + cuts[:-1])[:, None] / 2 * (b - a)
        spots = np.vstack([a, b, middles])
        outside = spots[~self.contains(spots)]
        edge = Region(tuple(self.loops[k] for k in np.flatnonzero(near)))
        return not len(outside) or bool((edge.distance(outside) <= tolerance).all())

    @cached_property
    def _boxes(self) -> Floats:
        """Lower left and upper right corners of the loops, `(n, 2, 2)`."""
        return np.array([loop.bounds for loop in self.loops]).reshape(-1, 2, 2)

    def _with(self, operation: str, other: Region) -> Region:
        if _clear(self.loops, other.loops):
            mine, theirs = operation == "intersection", operation != "union"
            loops = [loop for loop in self.loops if other.contains(loop.points[:1])[0] == mine]
            others = [loop for loop in other.loops if self.contains(loop.points[:1])[0] == theirs]
            return _arranged([*loops, *((loop.reversed() for loop in others) if operation == "difference" else others)])
        drawing = TaggedPolylines([*self.loops, *other.loops])
        one, two = drawing.area(self.loops, 0), drawing.area(other.loops, len(self.loops))
        return Region(drawing.traced(getattr(shapely, operation)(one, two, grid_size=GRID)))


def _clear(mine: Sequence[Contour], theirs: Sequence[Contour]) -> bool:
    """Whether no loop of one area comes near one of the other: then each lies whole within the other area or outside."""
    if not (mine and theirs):
        return False
    curves = outlines_of([*mine, *theirs]).curves
    first = sum(len(loop.points) for loop in mine)
    pairs = ((i, k) for i, k in ((i[i < first], k[i < first]) for i, k in near(*boxes(curves), CLEAR)))
    return not any((gap(curves.take(i[k >= first]), curves.take(k[k >= first])) < CLEAR).any() for i, k in pairs)


def _arranged(loops: Sequence[Contour]) -> Region:
    """Loops that do not cross, in order: each outer one, from left to right, and the islands in it."""
    outer = sorted((loop for loop in loops if loop.area > 0), key=lambda loop: loop.bounds[0].tolist())
    sizes, within = [loop.area for loop in outer], [[loop] for loop in outer]
    for island in loops if outer and len(outer) < len(loops) else ():
        if island.area < 0:
            middle = island.point_at(island.lengths[: int(island.lengths.argmax())].sum() + island.lengths.max() / 2)[0]
            around = [k for k, loop in enumerate(outer) if loop.winding(middle)[0]] if len(outer) > 1 else [0]
            if not around:  # it touches the loop that it lies in
                around = [int(np.argmin([loop.distance(middle)[0] for loop in outer]))]
            within[min(around, key=sizes.__getitem__)].append(island)
    return Region(tuple(loop for part in within for loop in part))


def meeting(loop: Contour, start: Floats, way: Floats) -> Floats:
    """Fractions of a straight way at which it meets the whole lines and circles of a loop."""
    with np.errstate(divide="ignore", invalid="ignore"):
        chord = loop.ends - loop.starts
        lines = cross(loop.starts - start, chord) / cross(way, chord)
        arm, size2 = start - loop.centres, way @ way
        half = (arm @ way) / size2
        root = np.sqrt(half**2 - ((arm**2).sum(axis=1) - loop.radii**2) / size2)
    cuts: Floats = np.concatenate([np.where(loop.sweeps == 0, lines, np.nan), -half - root, -half + root])
    return cuts[np.isfinite(cuts)]


def _tidy(given: Any) -> Contour:
    """A closed contour, or that of a shape, without elements of no length."""
    contour = getattr(given, "contour", given)
    if not isinstance(contour, Contour):
        raise Alarm(f"an area is what contours enclose, got {shown(given)}", hint="area.rectangle(60, 40), area.dxf(path) …")
    if not contour.closed:
        raise ValueError("only a closed contour encloses an area")
    some = contour.lengths > SAME
    if some.sum() < 2 or some.sum() == 2 and not contour.bulge[some].any():  # a line to and fro
        raise ValueError("the contour encloses nothing")
    return contour if some.all() else Contour(contour.points[some], contour.bulge[some])


# Areas taken from an area, or put to it: what lies clear of all edges needs no set operation, its loops become those of
# the rest.
# Set operations trace every loop again, which is most of the time that a plate with many holes takes.

ROUGH = 1e-3  # mm, how far the polygons that are looked at may be off
EDGES_APART = 1e-2  # mm, between edges that do not meet
SAME_LOOP = 1e-9  # mm, within which two loops are one


class Where(Enum):
    """Where a loop lies against a region: on a loop of it, clear of all of them, or none of these."""

    EDGE, INSIDE, OUTSIDE, ACROSS = range(4)


def where(loop: Contour, region: Region) -> Where:
    """Where a loop lies against a region."""
    if any(_same(loop, other) for other in region.loops):
        return Where.EDGE
    edges = [shapely.LinearRing(_ring(other)) for other in region.loops]
    line = shapely.LinearRing(_ring(loop))
    if shapely.dwithin(line, edges, EDGES_APART).any():
        return Where.ACROSS
    return Where.INSIDE if region.contains(loop.points[:1])[0] else Where.OUTSIDE


def joined(a: Region, b: Region) -> Region:
    """What two regions cover together, exact."""
    if not (a.loops and b.loops):
        return a if a.loops else b
    mine, theirs = ([where(loop, other) for loop in one.loops] for one, other in ((a, b), (b, a)))
    if Where.ACROSS in (*mine, *theirs):
        return a.union(b)
    loops = [loop for loop, place in zip(a.loops, mine) if place is not Where.INSIDE]
    loops += [loop for loop, place in zip(b.loops, theirs) if place is Where.OUTSIDE]
    outer = [loop for loop in loops if loop.area > 0]
    return _with_holes([Region((loop,)) for loop in outer], [loop for loop in loops if loop.area < 0])


def less(region: Region, gone: Sequence[Region]) -> Region:
    """A region less some others, exact."""
    near = [each for each in gone if each.loops and region.loops and not _beside(region, each)]
    if not near:
        return region
    region = _unswallowed(region, near)
    parts = region.parts
    bodies = [rough(part) for part in parts]
    filled = [[rough(Region(piece.loops[:1])) for piece in each.parts] for each in near]
    holes: list[list[Region]] = [[] for _ in parts]
    hard = list[Region]()
    for k, each in enumerate(near):
        inside = [_inside(bodies, outline) for outline in filled[k]]
        others = [outline for i, row in enumerate(filled) if i != k for outline in row]
        if None in inside or any(shapely.dwithin(outline, others, EDGES_APART).any() for outline in filled[k]):
            if any(shapely.dwithin(outline, bodies, EDGES_APART).any() for outline in filled[k]):
                hard.append(each)
            continue
        for where, piece in zip(inside, each.parts):
            holes[where].append(piece)  # type: ignore[index]
    loops = []
    for part, taken in zip(parts, holes):
        loops += [*part.loops, *(piece.loops[0].reversed() for piece in taken)]
        for piece in taken:  # its islands stay
            loops += [loop.reversed() for loop in piece.loops[1:]]
    found = Region(tuple(loops))
    return _cut(found, hard) if hard else found


def _unswallowed(region: Region, gone: Sequence[Region]) -> Region:
    """A region without those of its holes that one of some areas takes away with all around them."""
    holes = [loop for loop in region.loops if loop.area < 0]
    if not holes:
        return region
    areas = [rough(each) for each in gone]
    within = [shapely.contains_properly(areas, _filled(hole).buffer(EDGES_APART, quad_segs=2)).any() for hole in holes]
    swallowed = [hole for hole, found in zip(holes, within) if found and not _holds_parts(hole, region)]
    return Region(tuple(loop for loop in region.loops if not any(loop is hole for hole in swallowed)))


def _cut(region: Region, gone: Sequence[Region]) -> Region:
    """A region less others that meet its edges; holes clear of these are not looked at."""
    areas = [rough(each) for each in gone]
    kept, clear = list[Contour](), list[Contour]()
    for loop in region.loops:
        aside = loop.area < 0 and not shapely.dwithin(_filled(loop), areas, EDGES_APART).any() and not _holds_parts(loop, region)
        (clear if aside else kept).append(loop)
    return _with_holes(Region(tuple(kept)).without(gone).parts, clear)


def _with_holes(parts: Sequence[Region], holes: Sequence[Contour]) -> Region:
    """Parts, and holes each of which lies in one of them: in the smallest where one is around the other."""
    loops = [list(part.loops) for part in parts]
    for hole in holes:
        around = [k for k, part in enumerate(parts) if part.contains(hole.points[:1])[0]]
        loops[min(around, key=lambda k: parts[k].area)].append(hole)
    return Region(tuple(loop for each in loops for loop in each))


def _holds_parts(hole: Contour, region: Region) -> bool:
    """Whether there is material again within a hole."""
    inner = [loop.points[0] for loop in region.loops if loop.area > 0]
    return bool(np.any(hole.winding(inner)))


def _filled(loop: Contour) -> Any:
    return shapely.Polygon(_ring(loop))


def _same(a: Contour, b: Contour) -> bool:
    """Whether two loops are one, walked the same way."""
    return a is b or (len(a.points) == len(b.points) and bool(
        (np.abs(a.points - b.points) < SAME_LOOP).all() and (np.abs(a.bulge - b.bulge) < SAME_LOOP).all()
    ))  # fmt: skip


def _beside(region: Region, other: Region) -> bool:
    """Whether the boxes about two regions are clear of each other."""
    (a, b), (c, d) = region.bounds, other.bounds
    return bool((b + EDGES_APART < c).any() or (d + EDGES_APART < a).any())


def _inside(bodies: list[Any], outline: Any) -> int | None:
    """Which of some bodies an outline lies in, clear of its edges."""
    found = np.flatnonzero(shapely.contains_properly(bodies, outline.buffer(EDGES_APART, quad_segs=2)))
    return int(found[0]) if len(found) else None


def rough(region: Region) -> Any:
    """A region as a rough shapely area."""
    rings = [[_ring(loop) for loop in part.loops] for part in region.parts]
    return shapely.MultiPolygon([shapely.Polygon(first, rest) for first, *rest in rings])


@lru_cache(512)
def _ring(loop: Contour) -> Floats:
    return loop.points_within(ROUGH)
