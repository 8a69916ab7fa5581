"""A blank without what strokes cover, as a half section of lines and arcs, exact; and what each stroke took away, in order."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import shapely
from mnclab.geometry.contours import FULL_TURN, Contour, steps_within
from mnclab.geometry.curves import Floats, at_angle, counted
from mnclab.geometry.cutting import Outlines, outlines_of
from mnclab.geometry.tracing import labels, traced

# What a convex contour covers that moves without turning, exact: bounded by lines and arcs again.
# Along a line the front of the contour stands at the end, its back at the start, two lines join them. Along an arc the
# points farthest to the left and to the right run on arcs of their own, that of a nose on one as much nearer to the centre
# or farther from it as the nose is large; between them lies a ribbon. Where the way is parallel to an edge the farthest
# point changes: there the arc is parted. Lengths in mm; a contour lies to the left of its elements.

SIDE = 1e-12  # an edge that leans less from the way is parallel to it
CHORD_ERROR = 1e-5  # of an arc that is narrower than the nose
NOTHING = 1e-12  # mm²

Point = tuple[float, float]


class Edge(NamedTuple):
    """A line or an arc of a convex contour, its outward normal at the start (rad) and by how much that turns on it."""

    start: Point
    end: Point
    normal: float
    sweep: float

    def at(self, share: float) -> Point:
        """The point where the normal has turned by a share of the sweep."""
        if share in (0.0, 1.0):
            return self.end if share else self.start
        (x, y), radius = self.centre
        angle = self.normal + share * self.sweep
        return x + radius * math.cos(angle), y + radius * math.sin(angle)

    @property
    def centre(self) -> tuple[Point, float]:
        """Centre and radius of an arc; of a line its end, which is a nose of radius 0."""
        if not self.sweep:
            return self.end, 0.0
        (x0, y0), (x1, y1) = self.start, self.end
        chord, middle = math.hypot(x1 - x0, y1 - y0), self.normal + self.sweep / 2
        radius = chord / 2 / math.sin(self.sweep / 2)
        high = radius * math.cos(self.sweep / 2)
        return ((x0 + x1) / 2 - high * math.cos(middle), (y0 + y1) / 2 - high * math.sin(middle)), radius


def edges(contour: Contour) -> list[Edge]:
    """The elements of a convex contour that is walked counter-clockwise, or of a line walked there and back."""
    columns = (each.tolist() for each in (contour.starts, contour.ends, contour.sweeps))
    found = []
    for (x0, y0), (x1, y1), sweep in zip(*columns, strict=True):
        normal = math.atan2(y1 - y0, x1 - x0) - math.pi / 2 - sweep / 2
        found.append(Edge((x0, y0), (x1, y1), normal, sweep))
    return found


def placed(body: list[Edge], at: Point) -> Contour | None:
    """The contour with its own zero at a place; None for a line."""
    contour = Contour([(x + at[0], y + at[1]) for (x, y), *_ in body], [math.tan(each.sweep / 4) for each in body])
    return contour if contour.area > NOTHING else None


def along_line(body: list[Edge], start: Point, end: Point) -> Contour | None:
    """What it covers from one place of its zero to another; None if that is no area."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    if math.hypot(dx, dy) < SIDE:
        return placed(body, start)
    heading = math.atan2(dy, dx)
    pieces = [piece for each in body for piece in _parted(each, heading)]
    facing = [math.cos(each.normal + each.sweep / 2 - heading) for each in pieces]
    sides = [0 if abs(f) < SIDE and not each.sweep else (1 if f > 0 else -1) for f, each in zip(facing, pieces)]
    if 1 not in sides or -1 not in sides:
        return None
    first = next(k for k, side in enumerate(sides) if side == 1 and _before(sides, k) == -1)
    points: list[Point] = []
    bulges: list[float] = []
    for wanted, (x, y) in ((1, end), (-1, start)):
        last = None
        for k in range(len(pieces)):
            k = (first + k) % len(pieces)
            if sides[k] == wanted:
                last = pieces[k]
                points.append((last.start[0] + x, last.start[1] + y))
                bulges.append(math.tan(last.sweep / 4))
        if last is not None:
            points.append((last.end[0] + x, last.end[1] + y))
            bulges.append(0.0)
    return Contour(points, bulges)


def _before(sides: list[int], k: int) -> int:
    """The side of the last piece before one that is not parallel to the way."""
    return next(side for side in (sides[(k - j) % len(sides)] for j in range(1, len(sides) + 1)) if side)


def _parted(edge: Edge, heading: float) -> Iterator[Edge]:
    """An edge, an arc parted where it is parallel to a heading."""
    if not edge.sweep:
        yield edge
        return
    shares = [(heading + side - edge.normal) % (2 * math.pi) / edge.sweep for side in (math.pi / 2, -math.pi / 2)]
    cuts = [0.0, *sorted(share for share in shares if 1e-9 < share < 1 - 1e-9), 1.0]
    for a, b in zip(cuts, cuts[1:]):
        yield Edge(edge.at(a), edge.at(b), edge.normal + a * edge.sweep, (b - a) * edge.sweep)


def along_arc(body: list[Edge], start: Point, end: Point, sweep: float, centre: Point) -> list[Contour]:
    """What it covers while its zero goes from one place to another about a centre by a sweep (rad), as contours."""
    reach = math.hypot(start[0] - centre[0], start[1] - centre[1])
    sense = math.copysign(1.0, sweep)
    first = math.atan2(start[1] - centre[1], start[0] - centre[0])
    # normal of the way to the right: outwards of a counter-clockwise arc
    turning = {(each.normal + half * each.sweep) % math.pi for each in body for half in (0, 1)}
    angles = [((normal - first) * sense) % math.pi + k * math.pi for normal in turning for k in range(3)]
    count = math.ceil(abs(sweep) / (math.pi / 2) - 1e-9)
    cuts = sorted({0.0, *(abs(sweep) * k / count for k in range(1, count)), *(a for a in angles if a < abs(sweep))})
    cuts = [a for k, a in enumerate(cuts) if not k or a - cuts[k - 1] > 1e-9]
    cuts = [a for a in cuts if a < abs(sweep) - 1e-9] + [abs(sweep)]
    places = [_on(centre, reach, first + sense * angle) for angle in cuts]
    places[0], places[-1] = start, end
    found = [placed(body, place) for place in places]
    for a, b, here, there in zip(cuts, cuts[1:], places, places[1:]):
        found.extend(_ribbon(body, here, there, sense * (b - a), centre, reach, first + sense * (a + b) / 2))
    return [contour for contour in found if contour is not None]


def _ribbon(
    body: list[Edge], start: Point, end: Point, sweep: float, centre: Point, reach: float, outward: float
) -> list[Contour | None]:
    """What lies between the ways of the points farthest to the left and to the right; `outward` is the middle's direction."""
    (inner, hollow), (outer, nose) = (_farthest(body, outward + turn) for turn in (math.pi, 0.0))
    if reach - hollow < 1e-6:  # the nose is larger than the arc: many short lines
        count = int(steps_within(np.array([reach]), np.array([sweep]), CHORD_ERROR)[0])
        here = math.atan2(start[1] - centre[1], start[0] - centre[0])
        ways = [start, *(_on(centre, reach, here + sweep * k / count) for k in range(1, count)), end]
        return [along_line(body, a, b) for a, b in zip(ways, ways[1:])]
    turns = [math.atan2(y - centre[1], x - centre[0]) for x, y in (start, end)]
    rails = [
        [_on((centre[0] + x, centre[1] + y), radius, turn) for turn in turns]
        for (x, y), radius in ((outer, reach + nose), (inner, reach - hollow))
    ]
    bulge = math.tan(sweep / 4)
    points = [*rails[0], *rails[1][::-1]]
    contour = Contour(points, [bulge, 0.0, -bulge, 0.0])
    if contour.area < 0:
        contour = contour.reversed()
    return [contour if contour.area > NOTHING else None]


def _farthest(body: list[Edge], direction: float) -> tuple[Point, float]:
    """The nose that reaches farthest in a direction: its centre and radius, 0 for a corner."""
    noses = [(each.end, 0.0) for each in body]
    noses += [each.centre for each in body if each.sweep and (direction - each.normal) % (2 * math.pi) <= each.sweep + 1e-9]
    c, s = math.cos(direction), math.sin(direction)
    return max(noses, key=lambda nose: nose[0][0] * c + nose[0][1] * s + nose[1])


def _on(centre: Point, radius: float, angle: float) -> Point:
    return centre[0] + radius * math.cos(angle), centre[1] + radius * math.sin(angle)


# As in `geometry.regions` areas are subtracted as fine polylines whose pieces know their lines and circles; from the rest
# these are found again. All strokes are taken away at once. What hangs on the chuck's side, where z is low, stays.

DRAWN_ERROR = 2e-5  # mm, of the polylines: decides only what touches and what does not
PLACES = 9  # decimals to which corners are rounded, so that nearly equal ones become equal
TINY = 1e-7  # mm, a piece narrower than this is none


@dataclass(frozen=True)
class SectionDrawing:
    """Closed contours as rings of straight pieces; the first `bars` of them are the blank's, row -1.

    `rings` (m,): the first piece of each contour; of the k pieces `starts`, `ends` (k, 2), `tags` (k,) the curve that it
    lies on and `rows` (k,) the row that it belongs to.
    """

    contours: Sequence[Contour]
    owners: NDArray[np.int64]
    bars: int = 1

    @classmethod
    def of(cls, blank: Sequence[Contour], strokes: Sequence[Contour], rows: Sequence[int]) -> SectionDrawing:
        """Of the loops of a blank and of what is taken away, with the row of each stroke."""
        return cls([*blank, *strokes], np.array([-1] * len(blank) + list(rows), dtype=np.int64), len(blank))

    @cached_property
    def outlines(self) -> Outlines:
        """All elements, and the contour of each."""
        return outlines_of(self.contours)

    @cached_property
    def pieces(self) -> tuple[Floats, Floats, NDArray[np.intp], NDArray[np.int64], NDArray[np.int64]]:
        """Starts, ends, tags and contours of the straight pieces, and the first piece of every contour."""
        (starts, _, centres, radii, sweeps), which = self.outlines
        step = np.zeros(len(starts))
        bent = np.flatnonzero(sweeps)
        step[bent] = FULL_TURN / steps_within(radii[bent], np.full(len(bent), FULL_TURN), DRAWN_ERROR)
        first = np.zeros(len(starts))
        first[bent] = np.arctan2(*(starts - centres)[bent].T[::-1])
        inner = np.zeros(len(starts), dtype=np.int64)
        sense = np.sign(sweeps)
        with np.errstate(divide="ignore", invalid="ignore"):  # places of the grid of every circle that lie on the arc
            begin = np.where(sweeps != 0, np.floor(sense * first / step + 1e-6) + 1, 0.0)
            end = np.where(sweeps != 0, np.ceil(sense * (first + sweeps) / step - 1e-6) - 1, -1.0)
        inner[bent] = np.maximum(end - begin + 1, 0)[bent].astype(np.int64)
        element, rank = counted(inner + 1)
        angle = sense[element] * (begin[element] + rank - 1) * step[element]
        with np.errstate(invalid="ignore"):
            on_circle = centres[element] + radii[element, None] * at_angle(angle)
        points: Floats = np.where((rank == 0)[:, None], starts[element], on_circle).round(PLACES)
        contour = which[element]
        heads = np.searchsorted(contour, np.arange(len(self.contours)))
        after = np.arange(1, len(points) + 1)
        after[np.append(heads[1:], len(points)) - 1] = heads
        return points, points[after], element, contour, heads

    @cached_property
    def areas(self) -> NDArray[Any]:
        """The contours (m,) as shapely areas."""
        points, _, _, contour, _ = self.pieces
        rings = shapely.linearrings(points, indices=contour)
        areas: NDArray[Any] = shapely.polygons(rings)
        bad = ~shapely.is_valid(areas)
        areas[bad] = shapely.make_valid(areas[bad])
        return areas

    @cached_property
    def bar(self) -> Any:
        """The blank as a shapely area: what an odd number of its loops encloses."""
        return reduce(shapely.symmetric_difference, self.areas[: self.bars])

    @property
    def strokes(self) -> NDArray[Any]:
        """What is taken away, as shapely areas."""
        return self.areas[self.bars :]

    def traced(self, area: Any) -> tuple[Contour, ...]:
        """A shapely area that was made of the contours, as lines and arcs."""
        starts, ends, element, _, _ = self.pieces
        return traced(area, starts, ends, labels(self.outlines.curves)[element], self.outlines.curves)

    @cached_property
    def _tree(self) -> Any:
        starts, ends = self.pieces[:2]
        return shapely.STRtree(shapely.linestrings(np.stack([starts, ends], axis=1)))

    def rows_of(self, contour: Contour) -> NDArray[np.int64]:
        """The last row (k,) that has cut each element of a traced contour, -1 of the blank."""
        upto = np.cumsum(contour.lengths) - contour.lengths / 2
        spots = shapely.points(contour.point_at(upto)[0])
        element, piece = self._tree.query(spots, predicate="dwithin", distance=2 * DRAWN_ERROR)
        found = np.full(len(contour.points), -1, dtype=np.int64)
        np.maximum.at(found, element, self.owners[self.pieces[3][piece]])
        return found


def left_of(drawing: SectionDrawing) -> Any:
    """The blank without all strokes, as a shapely area."""
    return shapely.difference(drawing.bar, shapely.union_all(drawing.strokes))


def held(area: Any, low: float) -> tuple[Any, list[Any]]:
    """The piece of an area that hangs on the chuck, the largest that begins at z = `low`, and the others."""
    pieces = [each for each in shapely.get_parts(shapely.get_parts(area)) if each.geom_type == "Polygon"]
    pieces = [each for each in pieces if each.area > TINY * each.length]
    if len(pieces) < 2:
        return shapely.MultiPolygon(pieces), []
    kept = max(pieces, key=lambda each: (each.bounds[0] <= low + TINY, each.area))
    return kept, [each for each in pieces if each is not kept]


def moment(area: Any) -> float:
    """The area times the radius of its middle, mm³, of a shapely area of straight pieces."""
    return float(sum(each.area * each.centroid.y for each in shapely.get_parts(area) if each.area))


def cuts(drawing: SectionDrawing, low: float) -> Iterator[tuple[int, Any, list[Any]]]:
    """The row of each stroke that takes something away, the area that it takes, and the pieces that fall then."""
    rest = drawing.bar
    for number, area in enumerate(drawing.strokes):
        if not shapely.intersects(rest, area):
            continue
        cut, off = shapely.intersection(rest, area), list[Any]()
        if cut.area:
            rest, off = held(shapely.difference(rest, area), low)
        yield int(drawing.owners[drawing.bars + number]), cut, off
