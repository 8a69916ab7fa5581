"""Contour trains: the way of the tool centre beside an open or a closed contour, in the plane or with heights. Lengths in mm.

The way is the machine's own radius compensation (`path.compensation`), with arcs about outside corners; each place of it is as
high as the place of the contour that it is square to. A closed contour is followed until the way closes:

        open                              closed, begun at P
    S───────────────────E             ╭──S─────────╮      S lies square beside P; at an inside corner it is where
    P ───────────────── Q             │  P───────┐ │      the offsets before and behind P meet
                                      ╰──────────╯ ╯

Where the tool has no room beside the contour, what it cannot reach is left standing if the contour is level, and told.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, left, length_of
from mnclab.geometry.regions import Region
from mnclab.geometry.tracing import bands_beside
from mnclab.path import compensation
from mnclab.path.compensation.elements import CORNER, Compensation
from mnclab.path.plane import chain
from mnclab.path.toolpath import Kind, PathFault, Toolpath

SAME = 1e-6  # mm
DRIFT = 1e-9  # mm
CHORD_ERROR = 1e-3  # mm, of what is only measured
CUTS = 1e-4  # mm, by which measured ways may be off their arcs
RULES = Compensation(approach="perpendicular", rapid=True, look_ahead=True)


class SpaceWay(NamedTuple):
    """An open contour and the heights (n,) of its n points."""

    contour: Contour
    heights: Floats

    @property
    def begin(self) -> Floats:
        return np.asarray(self.contour.points[0])

    @property
    def end(self) -> Floats:
        return np.asarray(self.contour.points[-1])

    @property
    def closes(self) -> bool:
        """Whether it ends where it begins."""
        apart = np.hypot(*(self.end - self.begin)) <= SAME
        return bool(apart and abs(self.heights[-1] - self.heights[0]) <= SAME)

    def reversed(self) -> SpaceWay:
        return SpaceWay(self.contour.reversed(), self.heights[::-1])


def part(along: SpaceWay, first: float, last: float) -> SpaceWay:
    """The part of a way between two ways along it; beyond the ends straight on, or round where the way closes."""
    contour, heights = along
    length = contour.length
    if along.closes and (first < 0 or last > length):
        twice = Contour(
            np.vstack([contour.points[:-1], contour.points]), np.append(contour.bulge[:-1], contour.bulge), closed=False
        )
        shift = length if first < 0 else 0.0
        return part(SpaceWay(twice, np.append(heights[:-1], heights)), first + shift, last + shift)
    upto = np.append(0.0, np.cumsum(contour.lengths))
    a, b = max(first, 0.0), min(last, length)
    inner = np.flatnonzero((upto > a + DRIFT) & (upto < b - DRIFT))
    points = np.vstack([contour.point_at(a)[0], contour.points[inner], contour.point_at(b)[0]])
    cuts = np.concatenate([[a], upto[inner], [b]])
    element = np.clip(np.searchsorted(upto, (cuts[1:] + cuts[:-1]) / 2, side="right") - 1, 0, len(contour.starts) - 1)
    bulge = np.tan(contour.sweeps[element] * np.diff(cuts) / contour.lengths[element] / 4)
    z = np.interp(cuts, upto, heights)
    begin, end = contour.tangents()
    for beyond, at_end in ((a - first, False), (last - b, True)):
        if beyond > DRIFT:
            corner, t = (points[-1], end[-1]) if at_end else (points[0], -begin[0])
            more = corner + beyond * t / length_of(t)
            points = np.vstack([points, more]) if at_end else np.vstack([more, points])
            bulge = np.append(bulge, 0.0) if at_end else np.append(0.0, bulge)
            z = np.append(z, z[-1]) if at_end else np.append(z[0], z)
    return SpaceWay(Contour(points, np.append(bulge, 0.0), closed=False), z)


class Beside(NamedTuple):
    """The ways beside a contour, and where the tool has no room, why, and how thick what is left is at which place (x, y)."""

    ways: tuple[SpaceWay, ...]
    fault: PathFault | None = None
    left: float = 0.0
    place: tuple[float, float] = (0.0, 0.0)


WIDEST = 1000.0  # mm, of a radius for which rooms are looked for; circles so large have very many chords


class Crossed(PathFault):
    """A contour that crosses itself has no way beside it."""


def beside(
    contour: Contour, distance: float, side: int, heights: Sequence[float] | Floats | None = None,
    lines: Sequence[int] | NDArray[np.int64] | None = None,
) -> Beside:  # fmt: skip
    """The ways of the tool centre at a `distance` to the left (`side` 1) or right (-1); a negative one is the other side.

    `heights` (n,) are those of the n points of the contour, `lines` (m,) what its m elements are called in messages. One way,
    but where a closed contour has a neck that the tool cannot pass: one in each room. A PathFault, whose step is the
    number of the element, where there is no way, or where the tool has no room and the contour is not level.
    """
    level = np.zeros(len(contour.points)) if heights is None else np.asarray(heights, dtype=float)
    name = np.arange(1, len(contour.starts) + 1) if lines is None else np.asarray(lines)
    if side * distance == 0:
        return Beside((_opened(contour, level),))
    size, outwards = abs(distance), int(np.sign(side * distance))
    try:
        way = (_closed if contour.closed else _open)(contour, size, outwards, level, name)
        if (spot := cuts_into(contour, way, size)) is not None:
            raise Crossed(f"the contour crosses itself near X{spot[0]:.3f} Y{spot[1]:.3f}", 0)
        return Beside((way,))
    except Crossed:
        raise
    except PathFault as fault:
        if np.ptp(level) > SAME or size > WIDEST:
            raise
        ways = (_rooms if contour.closed else _room)(contour, size, outwards, fault)
        thickness, (x, y) = _left(contour, size, ways)
        return Beside(tuple(SpaceWay(way, np.full(len(way.points), level[0])) for way in ways), fault, thickness, (x, y))


def cuts_into(contour: Contour, way: SpaceWay, distance: float) -> tuple[float, float] | None:
    """The place (x, y) of a way that lies nearest to a contour, if the tool centre comes nearer there than `distance`."""
    chords = way.contour.points_within(CUTS)
    pieces = shapely.linestrings(np.stack([chords[:-1], chords[1:]], axis=1))
    nearest, room = _nearest([contour], pieces)
    k = int(room.argmin())
    if room[k] >= distance - 3 * CUTS:
        return None
    x, y = shapely.get_coordinates(shapely.shortest_line(pieces[k], nearest[k]))[0].tolist()
    return x, y


def away(contours: Sequence[Contour], spots: Floats) -> Floats:
    """How far spots (k, 2) are from the nearest of some contours, but for `CUTS`, `(k,)`; of many elements fast."""
    return _nearest(contours, shapely.points(spots))[1]


def _nearest(contours: Sequence[Contour], shapes: NDArray[np.object_]) -> tuple[NDArray[np.object_], Floats]:
    """The chord of some contours nearest to each of k shapes, and how far away it is, each `(k,)`."""
    lines = [contour.points_within(CUTS) for contour in contours]
    chords = shapely.linestrings(np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in lines]))
    (_, found), room = shapely.STRtree(chords).query_nearest(shapes, return_distance=True, all_matches=False)
    return chords[found], np.asarray(room)


def _opened(contour: Contour, heights: Floats) -> SpaceWay:
    """A contour as an open one; a closed one ends at its first point."""
    if not contour.closed:
        return SpaceWay(contour, heights)
    points, bulge = np.vstack([contour.points, contour.points[:1]]), np.append(contour.bulge, 0.0)
    return SpaceWay(Contour(points, bulge, closed=False), np.append(heights, heights[0]))


def _open(contour: Contour, distance: float, side: int, heights: Floats, lines: Any) -> SpaceWay:
    """The compensated way of an open contour, whose elements have `lines`, from square to its beginning to square to its end."""
    path = _compensated(SpaceWay(contour, heights), distance, side, lines, np.arange(len(lines)))
    return _way(path)


def _closed(contour: Contour, distance: float, side: int, heights: Floats, lines: Any) -> SpaceWay:
    """The compensated way of a closed contour, worked out from the middle of its longest element on and begun where it does."""
    k, n = int(contour.lengths.argmax()), len(lines)
    whole = _opened(contour, heights)
    half = np.tan(contour.sweeps[k] / 8)
    middle = contour.point_at(contour.lengths[:k].sum() + contour.lengths[k] / 2)[0]
    order = (k + 1 + np.arange(n)) % n
    points = np.vstack([middle, contour.points[order], middle])
    bulge = np.concatenate([[half], contour.bulge[order[:-1]], [half, 0.0]])
    z = (whole.heights[k] + whole.heights[k + 1]) / 2
    round_ = SpaceWay(Contour(points, bulge, closed=False), np.concatenate([[z], heights[order], [z]]))
    element = np.append(k, order)
    path = _halves_joined(_compensated(round_, distance, side, lines[element], element))
    own = np.flatnonzero((path.step == 0) & (np.array(path.labels)[path.label] != CORNER))
    return _way(path[np.roll(np.arange(len(path)), -int(own[0]))])


def _halves_joined(path: Toolpath) -> Toolpath:
    """A path that ends and begins within one element, which becomes one row."""
    start, sweep = path.start.copy(), path.sweep.copy()
    start[0], sweep[0] = path.start[-1], path.sweep[0] + path.sweep[-1]
    return path.replace(start=start, sweep=sweep)[:-1]


def _compensated(way: SpaceWay, distance: float, side: int, lines: Any, steps: Any) -> Toolpath:
    """The rows of the tool centre; their steps tell the element. The straight move square to the contour, by which the
    compensation begins, is left out."""
    contour, heights = way
    moving = int(np.flatnonzero(contour.lengths > SAME)[0])
    normal = side * left(contour.tangents()[0][moving])
    flat = np.vstack([contour.points[0] + 2 * distance * normal, contour.points])
    z = np.append(heights[0], heights)
    sweep = np.append(0.0, contour.sweeps)
    columns: dict[str, Any] = {
        "kind": np.where(sweep != 0, np.uint8(Kind.ARC), np.uint8(Kind.LINE)),
        "centre": np.vstack([np.full(3, np.nan), np.column_stack([contour.centres, heights[:-1]])]),
        "sweep": sweep,
        "side": np.full(len(sweep), side, np.int8),
        "radius": np.full(len(sweep), distance),
        "line": np.append(lines[0], lines).astype(np.int32),
        "step": np.append(-1, steps).astype(np.int32),
    }
    path = compensation.apply(Toolpath.chain(np.column_stack([flat, z]), columns), RULES)
    return path[1:]


def _way(path: Toolpath) -> SpaceWay:
    found = chain(path)
    return SpaceWay(found.contour, found.heights)


def _rooms(contour: Contour, distance: float, side: int, fault: PathFault) -> list[Contour]:
    """The boundaries of where the tool centre may be beside a closed contour, in its sense, the one near its beginning first."""
    try:
        area = Region.of(contour)
    except ValueError as error:
        raise PathFault(str(error), fault.step) from None
    free = area.inset(distance) if contour.area * side > 0 else area.offset(distance)
    if not free.loops:
        raise fault
    loops = [loop if contour.area > 0 else loop.reversed() for loop in free.loops]
    start = contour.points[0] + distance * side * left(contour.tangents()[0][0])
    loops.sort(key=lambda loop: float(loop.distance(start[None])[0]))
    begun = [loop.started_at(loop.nearest(start)) for loop in loops]
    return [_opened(loop, np.zeros(len(loop.points))).contour for loop in begun]


def _room(contour: Contour, distance: float, side: int, fault: PathFault) -> list[Contour]:
    """The boundary of where the tool centre may be beside an open contour, from square to its beginning to square to its end."""
    line = shapely.LineString(contour.points_within(CHORD_ERROR))
    begin, end = contour.tangents()
    first = contour.points[0] + distance * side * left(begin[0])
    last = contour.points[-1] + distance * side * left(end[-1])
    if not line.is_simple:
        raise PathFault("the contour crosses itself", fault.step)
    back = contour.reversed()
    there = Contour(
        np.vstack([contour.points, back.points[1:-1]]), np.concatenate([contour.bulge[:-1], back.bulge[:-1]])
    )
    discs = (Contour.circle(point, distance) for point in (contour.points[0], contour.points[-1]))
    near = Region.union_of(*bands_beside(there, distance), *discs)
    loop = next((loop for loop in near.loops if loop.distance([first, last]).max() < 1e-4), None)
    if loop is None:
        raise fault
    ring = loop.reversed() if side > 0 else loop
    start = ring.started_at(ring.nearest(first))
    whole = _opened(start, np.zeros(len(start.points)))
    return [part(whole, 0.0, start.nearest(last)).contour]


def _left(contour: Contour, distance: float, ways: Sequence[Contour]) -> tuple[float, tuple[float, float]]:
    """How thick what the tool leaves on a contour is where it is thickest, and where that is."""
    upto = np.append(0.0, np.cumsum(contour.lengths))
    places = np.linspace(0, contour.length, int(np.clip(10 * contour.length / distance, 10, 20_000)))
    step = places[1]
    places = np.concatenate([places, upto])
    for _ in range(3):  # ever closer about the thickest
        spots = contour.point_at(places)[0]
        thick = away(ways, spots) - distance
        best = int(thick.argmax())
        places, step = places[best] + np.linspace(-step, step, 65), step / 32
    x, y = spots[best].tolist()
    return float(thick[best]), (x, y)


# Stretches of a contour train where a coarser tool has left material: an inside corner for one. Lengths in mm.
# The tool of a way touches the finished wall in the foot of each place. The rest there is as thick as the foot is far
# from what the
# coarse tool has covered on its own way. In an inside corner of a right angle a coarse tool of radius C leaves, s from
# the corner,
#     thickness = √((C - s)² + C²) - C            more than t where s < C - √(2·C·t + t²)

Bools: TypeAlias = NDArray[np.bool_]
SAME_STRETCH = 1e-9  # mm
STEP = 0.05  # of the tool radius: between the places that are looked at
MOST = 40_000  # places
HALVINGS = 40


def rests(
    along: SpaceWay, radius: float, side: int, coarse: Sequence[Contour], coarse_radius: float, accepted: float,
    connected: float = 0.0, extended: float = 0.0,
) -> tuple[SpaceWay, ...]:  # fmt: skip
    """The stretches of a way, with the tool of a `radius` to its `side`, where more than `accepted` stands after a coarse tool.

    `coarse` are the ways of that tool along the same contour. Stretches at most `connected` apart are joined, each is
    `extended` at both ends: along the way, and beyond its end straight on.
    """
    length = along.contour.length
    places = _places(along.contour, radius)
    thick = np.full(len(places), True)
    if coarse:
        thick = away(coarse, _feet(along.contour, places, radius, side)) - coarse_radius > accepted
    if thick.all():
        return (part(along, -extended, length + extended),) if not along.closes else (along,)

    def still(way: Floats) -> Bools:
        feet = _feet(along.contour, way, radius, side)
        return np.asarray(np.min([one.distance(feet) for one in coarse], axis=0) - coarse_radius > accepted)

    edges = np.flatnonzero(thick[1:] != thick[:-1])
    found = _edges(still, places[edges], places[edges + 1], thick[edges])
    ends = np.concatenate([[0.0] * bool(thick[0]), found, [length] * bool(thick[-1])]).reshape(-1, 2)
    return tuple(part(along, a, b) for a, b in _joined(ends, length, along.closes, connected, extended))


def _places(contour: Contour, radius: float) -> Floats:
    """Ways along a contour to places on it, in order, the ends of all elements from both sides among them."""
    lengths = contour.lengths
    upto = np.append(0.0, np.cumsum(lengths))
    step = max(STEP * radius, contour.length / MOST)
    found = [
        a + size * np.clip(np.linspace(0, 1, int(np.ceil(size / step)) + 2), 1e-7, 1 - 1e-7)
        for a, size in zip(upto, lengths, strict=False)
        if size > SAME_STRETCH
    ]
    return np.concatenate(found)


def _feet(contour: Contour, places: Floats, radius: float, side: int) -> Floats:
    """Where the tool touches the finished wall at places (k,) along its way, `(k, 2)`."""
    spots, tangents = contour.point_at(places)
    return np.asarray(spots - side * radius * left(tangents))


def _edges(still: Callable[[Floats], Bools], low: Floats, high: Floats, begins: Bools) -> Floats:
    """Where stretches end and begin between places, by halving; `begins` (k,): there is a rest at the lower one."""
    low, high = low.copy(), high.copy()
    for _ in range(HALVINGS if len(low) else 0):
        middle = (low + high) / 2
        same = still(middle) == begins
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return (low + high) / 2


def _joined(ends: Floats, length: float, closes: bool, connected: float, extended: float) -> list[tuple[float, float]]:
    """Stretches (n, 2) joined where they are near each other, and extended; of a way that closes one may begin below 0."""
    found = [(float(a), float(b)) for a, b in ends]
    if closes and len(found) > 1 and found[0][0] + length - found[-1][1] <= connected:
        found[0] = (found.pop()[0] - length, found[0][1])
    joined: list[tuple[float, float]] = []
    for a, b in found:
        if joined and a - joined[-1][1] <= max(connected, 2 * extended):
            joined[-1] = (joined[-1][0], b)
        else:
            joined.append((a, b))
    if closes and len(joined) == 1 and joined[0][0] + length - joined[0][1] <= max(connected, 2 * extended):
        return [(0.0, length)]
    return [(a - extended, b + extended) for a, b in joined]
