"""What a mill takes away of each level: the discs that moves of flat cutters sweep, as exact regions with lines and arcs, and
the connected areas that they clear, from below upwards, without what lies deeper anyway.

A move sweeps a band, as wide as the cutter, and a disc at either end. Discs are split where bands touch them, so that
what touches smoothly has its corners in the same places. Most of a cleared area lies deep within it: a coarse union tells
which bands and discs come near the rim, and only these are joined exactly.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mnclab.design.recognition.naming import StraightSlot, named
from mnclab.geometry import shapely
from mnclab.geometry.contours import FULL_TURN, Contour
from mnclab.geometry.curves import at_angle
from mnclab.geometry.regions import Region

ROUND = 1e-7  # mm, within which places are one
STRIP = 0.01  # mm, of half a strip that does not matter
FEW = 30  # pieces that are joined at once, without a look at which matter
COARSE = 32  # chords of a quarter circle
NEAR = 0.0005  # of a radius, from the rim of the coarse union: what comes so near matters
SPLIT = 1e-8  # rad, between places where bands touch a disc
SLIGHT = 0.3  # rad, of a bend
ALONG = 0.045  # rad, in which a disc leaves a band that it touches by more than that


@dataclass(frozen=True)
class Track:
    """One move of a flat cutter in the plane, mm: from `start` to `end` (x, y), about `centre` by `sweep` rad if it is an
    arc; `row` of the path."""

    start: tuple[float, float]
    end: tuple[float, float]
    radius: float
    row: int
    centre: tuple[float, float] = (0.0, 0.0)
    sweep: float = 0.0

    @property
    def stands(self) -> bool:
        return not self.sweep and bool(np.hypot(*np.subtract(self.end, self.start)) < ROUND)

    @property
    def bend(self) -> float:
        """The radius of the arc, mm."""
        return float(np.hypot(*np.subtract(self.start, self.centre))) if self.sweep else 0.0

    @property
    def line(self) -> Contour:
        """The way of its axis, open; a full turn in two halves."""
        if not self.sweep:
            return Contour([self.start, self.end], closed=False)
        parts = 1 if abs(self.sweep) < np.pi * 1.5 else 2
        sweep = np.clip(self.sweep, -FULL_TURN, FULL_TURN)
        arm = np.subtract(self.start, self.centre)
        angles = np.arctan2(arm[1], arm[0]) + sweep * np.arange(parts + 1) / parts
        points = self.centre + self.bend * at_angle(angles)
        points[0] = self.start
        if abs(self.sweep) < FULL_TURN:
            points[-1] = self.end
        return Contour(points, [*[np.tan(sweep / parts / 4)] * parts, 0.0], closed=False)

    @property
    def key(self) -> tuple[Any, ...]:
        """What is the same of moves that sweep the same, there or back."""
        ends = sorted((_near(self.start), _near(self.end)))
        middle = self.line.point_at(self.line.length / 2)[0] if self.sweep else self.start
        return *ends, _near(self.centre), _near(middle) if self.sweep else (), round(self.radius, 6)

    @property
    def touched(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """The directions, rad, in which the rims of its band leave the discs at its start and at its end."""
        if self.stands:
            return (), ()
        if not self.sweep:
            (x0, y0), (x1, y1) = self.start, self.end
            ahead = math.atan2(y1 - y0, x1 - x0)
            both = ahead - math.pi / 2, ahead + math.pi / 2
            return both, both
        (x, y), found = self.centre, []
        for px, py in (self.start, self.end):
            spoke = math.atan2(py - y, px - x)
            found.append((spoke, spoke + math.pi))
        return found[0], found[1]

    @property
    def places(self) -> Any:
        """Points along its way (m, 2)."""
        return self.line.points_within(0.0003 * self.radius) if self.sweep else [self.start, self.end]


def _near(point: Any) -> tuple[float, float]:
    x, y = (round(float(each), 6) + 0.0 for each in point)
    return x, y


def distinct(tracks: list[Track]) -> list[Track]:
    """Each of them once, in their order; none that stands where another goes on, or that a full turn begins at."""
    found: dict[tuple[Any, ...], Track] = {}
    for each in tracks:
        found.setdefault(each.key, each)
    moving = [each for each in found.values() if not each.stands]
    ends = {(_near(place), round(each.radius, 6)) for each in moving for place in (each.start, each.end)}
    return [each for each in found.values() if not each.stands or (_near(each.start), round(each.radius, 6)) not in ends]


def coarse(tracks: list[Track]) -> Any:
    """What each of some tracks sweeps, polygons a little within it (k,)."""
    ways = [shapely.Point(each.start) if each.stands else shapely.LineString(each.places) for each in tracks]
    return shapely.buffer(ways, [each.radius for each in tracks], quad_segs=COARSE)


def swept(tracks: list[Track]) -> Region:
    """What tracks sweep, exact."""
    tracks = distinct(tracks)
    bands = [piece for each in tracks for piece in _bands(each)]
    discs = [(radius, piece) for radius, piece in _discs(tracks)]
    if len(bands) + len(discs) <= FEW:
        return Region.union_of(*bands, *(piece for _, piece in discs))
    whole = shapely.union_all(coarse(tracks))
    shapely.prepare(rim := whole.boundary)
    wide = NEAR * max(each.radius for each in tracks)
    outlines = [shapely.Polygon(piece.points_within(wide / 4) if piece.bulge.any() else piece.points) for piece in bands]
    chosen = [piece for piece, near in zip(bands, shapely.dwithin(rim, outlines, wide)) if near]
    for along in (ALONG, 0.0):  # steps that are short beside the cutter leave only the ends of their discs at the rim
        arcs = [shapely.LineString(_arc_of(piece, along)) for _, piece in discs]
        near = shapely.dwithin(rim, arcs, [NEAR * radius for radius, _ in discs])
        seen = chosen + [piece for (_, piece), matters in zip(discs, near) if matters]
        loops = (loop for loop in Region.union_of(*seen).loops if loop.area > 0 or not whole.contains(_inner_point(loop)))
        found = Region(tuple(loops))
        if not differ(whole, polygon(found)):
            return found
    return Region.union_of(*bands, *(piece for _, piece in discs))  # a piece that matters was not seen to


def differ(one: Any, other: Any) -> bool:
    """Whether two areas differ by more than thin strips."""
    return not one.symmetric_difference(other).buffer(-STRIP).is_empty


def _arc_of(piece: Contour, along: float) -> Any:
    """The bent edge of a piece of a disc, without what runs along with a band at its ends, so many rad."""
    if len(piece.points) == 2:
        return piece.points_within(NEAR)
    (x, y), (px, py), _ = piece.points.tolist()
    bend = 4 * math.atan(piece.bulge[1])
    off = min(along, bend / 2 - 1e-9)
    angles = math.atan2(py - y, px - x) + np.linspace(off, bend - off, 2 + int(bend / ALONG))
    return (x, y) + math.hypot(px - x, py - y) * at_angle(angles)


def _inner_point(loop: Contour) -> Any:
    return shapely.Polygon(loop.points_within(1e-4)).representative_point()


def _bands(track: Track) -> Iterator[Contour]:
    """What a move sweeps besides the discs at its ends: on its right and on its left."""
    r = track.radius
    if track.stands:
        return
    if not track.sweep:
        (x0, y0), (x1, y1) = track.start, track.end
        long = math.hypot(x1 - x0, y1 - y0)
        nx, ny = -(y1 - y0) / long * r, (x1 - x0) / long * r
        yield Contour([(x0 - nx, y0 - ny), (x1 - nx, y1 - ny), (x1, y1), (x0, y0)])
        yield Contour([(x0, y0), (x1, y1), (x1 + nx, y1 + ny), (x0 + nx, y0 + ny)])
        return
    line, bend, centre = track.line, track.bend, np.asarray(track.centre)
    for start, end, bulge in zip(line.starts, line.ends, line.bulge):
        for most, least in ((bend + r, bend), (bend, bend - r)):
            a, b = centre + (start - centre) * (most / bend), centre + (end - centre) * (most / bend)
            if least <= ROUND:
                yield Contour([a, b, centre], [bulge, 0.0, 0.0])
            else:
                c, d = centre + (end - centre) * (least / bend), centre + (start - centre) * (least / bend)
                yield Contour([a, b, c, d], [bulge, 0.0, -bulge, 0.0])


def _discs(tracks: list[Track]) -> Iterator[tuple[float, Contour]]:
    """The discs at the ends of moves, each once, in pieces where bands touch it: their radius, and (centre, arc).

    The piece on the inside of a slight bend of straight moves is left out: their bands cover it.
    """
    places: dict[tuple[Any, ...], tuple[Any, float, list[float], list[Any]]] = {}
    for each in tracks:
        if abs(each.sweep) >= FULL_TURN - 1e-9:
            continue  # its band is a ring without ends
        for place, angles, other in zip((each.start, each.end), each.touched, (each.end, each.start)):
            known = places.setdefault((*_near(place), round(each.radius, 6)), (place, each.radius, [], []))
            known[2].extend(angles)
            known[3].append(None if each.sweep else other)
    for (x, y), radius, found, others in places.values():
        if not found:
            yield radius, Contour.circle((x, y), radius)
            continue
        around = sorted(angle % FULL_TURN for angle in found)
        turned = [b for a, b in zip([around[-1] - FULL_TURN, *around], around) if b - a > SPLIT] or around[:1]
        gaps = [b - a for a, b in zip(turned, [*turned[1:], turned[0] + FULL_TURN])]
        for first, gap in zip(turned, gaps):
            last, middle = first + gap, first + gap / 2
            if gap < SLIGHT and all(
                other and (other[0] - x) * math.cos(middle) + (other[1] - y) * math.sin(middle) > 0
                and math.dist(other, (x, y)) > radius * gap for other in others
            ):  # fmt: skip
                continue
            one = x + radius * math.cos(first), y + radius * math.sin(first)
            other = x + radius * math.cos(last), y + radius * math.sin(last)
            yield radius, Contour([(x, y), one, other], [0.0, math.tan(gap / 4), 0.0])


def polygon(region: Region, chord: float = 1e-3) -> Any:
    """A region as an area of shapely, for questions that need no exactness."""
    areas = []
    for part in region.parts:
        outer, *holes = (loop.points_within(chord) for loop in part.loops)
        areas.append(shapely.Polygon(outer, [hole for hole in holes if len(hole) > 3]))
    return shapely.union_all([area if area.is_valid else area.buffer(0) for area in areas])


# The connected areas at each height.

THIN = 2e-3  # mm, of a strip that is none: what is coarse here is off by less
SAMPLES = 24  # points of a contour, of which each asks what is there
ON_EDGE = 1e-6  # mm


@dataclass
class Area:
    """A connected area cleared down to `floor`, mm: `region` within the blank, `whole` with what lies beside it; what swept it.

    `top` is the height of the material around it, None the top of the blank. `shape` is what its only contour is called.
    """

    floor: float
    region: Region
    whole: Region
    tracks: list[Track]
    top: float | None = None
    shape: Any = field(init=False)

    def __post_init__(self) -> None:
        self.shape = named(self.region.loops[0])
        if isinstance(whole := named(self.whole.loops[0]), StraightSlot) and len(self.whole.loops) == 1 and self._ends_in(whole):
            self.shape = whole

    def _ends_in(self, slot: StraightSlot) -> bool:
        """Whether a round end of a slot lies in the blank."""
        return bool(self.region.contains([slot.start, slot.end]).any())

    @property
    def row(self) -> int:
        """The row of the path that first cut it to this depth."""
        return min(each.row for each in self.tracks)

    @property
    def islands(self) -> tuple[Contour, ...]:
        return self.region.loops[1:]

    def holds(self, other: Region) -> bool:
        """Whether a region lies within it."""
        spots = np.concatenate([samples(loop) for loop in other.loops])
        return bool((self.region.contains(spots) | (self.region.distance(spots) < ON_EDGE)).all())


def samples(loop: Contour) -> Any:
    """Points along a closed contour (m, 2), corners among them."""
    way = np.linspace(0, loop.length, SAMPLES, endpoint=False)
    return np.concatenate([loop.points, loop.point_at(way)[0]])


def areas_of(
    levels: dict[float, list[Track]], slopes: list[tuple[float, Track]], blank: Region
) -> tuple[list[Area], list[int]]:
    """The areas that tracks clear by their heights, and the rows of `slopes`, each with its lowest height, that stay: no level
    area covers them."""
    stock = polygon(blank)
    gone, found, rows = shapely.Polygon(), list[Area](), list[int]()
    slopes = sorted(slopes, key=lambda each: each[0])
    for z in [*levels, np.inf]:
        while slopes and slopes[0][0] < z - ON_EDGE:  # all that is cleared below and at its lowest place is known
            track = slopes.pop(0)[1]
            if _matters(coarse([track])[0].intersection(stock), gone):
                rows.append(track.row)
        if not np.isfinite(z):
            break
        tracks = levels[z]
        here = coarse(tracks)
        fresh = []
        for piece in shapely.get_parts(shapely.union_all(here)):
            if _matters(piece.intersection(stock), gone):
                inside = shapely.intersects(piece, here)
                fresh.append([track for track, on in zip(tracks, inside) if on])
        for some in fresh:
            for area in _areas(z, some, blank, gone):
                if _matters(polygon(area.region), gone):
                    found.append(area)
        gone = shapely.union_all([gone, *(polygon(area.region) for area in found if area.floor == z)])
    for area in found:
        above = [other.floor for other in found if other.floor > area.floor + ON_EDGE and other.holds(area.region)]
        area.top = min(above) if above else None
    return found, rows


def _matters(area: Any, gone: Any) -> bool:
    """Whether more of an area than a thin strip is not gone."""
    rest = area.difference(gone.buffer(THIN))
    return not rest.is_empty and not rest.buffer(-THIN / 2).is_empty


def _areas(z: float, tracks: list[Track], blank: Region, gone: Any) -> list[Area]:
    """What some tracks clear at a height, in connected areas; an island that is gone deeper is none."""
    found = []
    for whole in swept(tracks).parts:
        region = whole if _within(whole, blank) else whole.intersection(blank)
        for part in region.parts:
            part = Region(tuple(loop for loop in part.loops if loop.area > 0 or _matters(_island(loop), gone)))
            places = polygon(part)
            mine = [track for track, piece in zip(tracks, coarse(tracks)) if piece.intersects(places)]
            found.append(Area(z, part, whole, mine))
    return found


def _island(loop: Contour) -> Any:
    return shapely.Polygon(loop.points_within(THIN / 2))


def _within(region: Region, blank: Region) -> bool:
    """Whether a region lies clear of the edges of the blank."""
    spots = np.concatenate([np.concatenate([loop.points, loop.bounds]) for loop in region.loops])
    (x0, y0), (x1, y1) = np.min(spots, axis=0), np.max(spots, axis=0)
    box = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    return len(blank.loops) == 1 and all(blank.holds(a, b, 0.0) for a, b in zip(box, box[1:] + box[:1]))
