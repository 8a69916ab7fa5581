"""Areas from loose contours, whatever they were drawn with: pieces joined at their ends, and what lies in what. Lengths in mm."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable, Iterator, Sequence
from functools import reduce

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, faults_as_alarms, shown

EXAMPLE = "mnclab.area.area_of(mnclab.area.svg('drawing.svg'))"
SAME = 1e-3  # mm, below which ends of a drawing count as one point
FARTHEST = 1e6  # mm, of a place in a drawing
SAMPLES = 50  # elements of a contour that tell where it lies
MOST = 200_000  # chords of the curves of a drawing
MANY, LOOPS = 50, 1000  # closed contours that are not laid over each other if they lie apart; that make an area at most
ROUGH = 0.01  # mm, of chords that tell what lies apart


def area_of(contours: Iterable[Contour], tolerance: float = SAME) -> Region:
    """The area that contours describe: those within none are pockets, those in a pocket islands, and so on inwards.

    Open contours are joined where their ends meet within `tolerance`; what stays open bounds nothing, and a warning says
    where it is. An Alarm where nothing is closed, or a contour crosses itself.

    >>> mnc.area.area_of([mnc.area.rectangle(40, 20), mnc.area.rectangle(10, 10)]).area
    700.0
    """
    contours = list(contours) if isinstance(contours, Iterable) else [contours]
    if wrong := [each for each in contours if not isinstance(each, Contour)]:
        raise Alarm(f"an area is made of a list of contours, got {shown(wrong[0])}", hint=EXAMPLE)
    check_number(tolerance, "the tolerance (mm)", above=0)
    strung = joined(contours, tolerance)
    loops = [contour for contour in strung if contour.closed and abs(contour.area) > tolerance**2]
    gaps = [contour for contour in strung if not contour.closed]
    ends = [f"from ({a:.3f}, {b:.3f}) to ({c:.3f}, {d:.3f})" for ((a, b), (c, d)) in (each.points[[0, -1]] for each in gaps)]
    more = f" and {len(ends) - 3} more" if len(ends) > 3 else ""
    left = f"{len(ends)} open contour{'s' * (len(ends) != 1)}, {'; '.join(ends[:3])}{more}"
    if not loops:
        raise Alarm(f"the drawing has no closed contour{f', but {left}' if ends else ''}",
                    hint=f"tolerance={tolerance:g} mm joins ends that are so near each other" if ends else "")  # fmt: skip
    if ends:
        warnings.warn(f"the area is bounded without {left}", stacklevel=2)
    if len(loops) > LOOPS:
        hint = "read fewer layers, or make an area of each part of the drawing"
        raise Alarm(f"the drawing has {len(loops)} closed contours, an area at most {LOOPS}", hint=hint)
    loops = _once(loops, tolerance)
    if len(loops) > MANY and (area := _of_many(loops)):
        return area
    within = np.array([_inside(loop, loops, tolerance) for loop in loops])
    depth = within.sum(axis=0) - np.diag(within)
    levels = [[loop for loop, d in zip(loops, depth, strict=True) if d == level] for level in range(depth.max() + 2)]
    with faults_as_alarms():
        pieces = [Region.of(*outer, holes=holes) for outer, holes in zip(levels[::2], levels[1::2])]
    return reduce(Region.union, pieces)


def _of_many(loops: list[Contour]) -> Region | None:
    """The area of loops that lie apart, as they are: each with those right within it. None where two touch or cross."""
    rings = [shapely.Polygon(np.vstack([loop.points_within(ROUGH), loop.points[:1]])) for loop in loops]
    edges = [ring.exterior for ring in rings]
    one, other = shapely.STRtree(edges).query(edges, "dwithin", 4 * ROUGH)
    if (one != other).any():
        return None
    around, inner = shapely.STRtree([shapely.Point(loop.points[0]) for loop in loops]).query(rings, "contains")
    depth = np.bincount(inner[around != inner], minlength=len(loops))
    kept: list[Contour] = []
    with faults_as_alarms():
        whole = [Region.of(loop).loops[0] for loop in loops]
    for k in np.flatnonzero(depth % 2 == 0).tolist():
        islands = inner[(around == k) & (depth[inner] == depth[k] + 1)]
        kept += [whole[k], *(whole[i].reversed() for i in islands.tolist())]
    return Region(tuple(kept))


def _once(loops: list[Contour], tolerance: float) -> list[Contour]:
    """The loops without those that are drawn again over another one, which a warning tells."""
    kept: list[Contour] = []
    boxes = np.array([loop.bounds for loop in loops]).reshape(-1, 4)
    for k, loop in enumerate(loops):
        near = np.flatnonzero((np.abs(boxes[:k] - boxes[k]) <= tolerance).all(axis=1))
        if not any(loops[i].distance(_places(loop)).max() <= tolerance for i in near.tolist()):
            kept.append(loop)
    if twice := len(loops) - len(kept):
        warnings.warn(f"{twice} contour{'s' * (twice != 1)} drawn again over another one, counted once", stacklevel=3)
    return kept


def _inside(loop: Contour, others: Sequence[Contour], tolerance: float) -> NDArray[np.bool_]:
    """Which of some contours lie within a loop: by a place of each that is not on the loop."""
    spots = np.array([other.points[0] for other in others])
    for k in np.flatnonzero(loop.distance(spots) <= tolerance).tolist():
        if others[k] is loop:
            continue
        places = _places(others[k])
        spots[k] = places[loop.distance(places).argmax()]
    return np.asarray(loop.winding(spots) != 0)


def _places(contour: Contour) -> Floats:
    """Corners of a contour and middles of its elements, all of them or `SAMPLES` of either."""
    some = np.unique(np.linspace(0, len(contour.starts) - 1, SAMPLES).astype(np.int64))
    return np.concatenate([contour.points[some], contour.at(0.5, some)[0]])


def joined(contours: Iterable[Contour], tolerance: float = SAME) -> list[Contour]:
    """Open contours strung together where an end meets another's, turned round if need be; closed ones as they are."""
    contours = list(contours)
    closed = [contour for contour in contours if contour.closed]
    loose = _Loose([contour for contour in contours if not contour.closed and contour.length > tolerance], tolerance)
    for first in loose.each():
        chain = [first]
        while True:
            tail, head = chain[-1].points[-1], chain[0].points[0]
            is_round = math.dist(tail, head) <= tolerance and (len(chain) > 1 or len(chain[0].starts) > 1)
            following = None if is_round else loose.meeting(tail)
            if following is None:
                break
            chain.append(following)
        closed.append(_strung(chain, bool(is_round)))
    return closed


class _Loose:
    """Open pieces by the cells of a grid, as wide as the tolerance, that their ends lie in; what is taken is gone."""

    def __init__(self, pieces: list[Contour], tolerance: float) -> None:
        self.pieces, self.tolerance = dict(enumerate(pieces)), tolerance
        self.ends = [(tuple(piece.points[0].tolist()), tuple(piece.points[-1].tolist())) for piece in pieces]
        self.cells: dict[tuple[int, int], dict[int, None]] = {}
        for k, ends in enumerate(self.ends):
            for end in ends:
                self.cells.setdefault(self._cell(end), {})[k] = None

    def _cell(self, place: Sequence[float]) -> tuple[int, int]:
        return math.floor(place[0] / self.tolerance), math.floor(place[1] / self.tolerance)

    def each(self) -> Iterator[Contour]:
        """The first piece that is left, as long as there is one."""
        while self.pieces:
            yield self._take(next(iter(self.pieces)))

    def _take(self, k: int) -> Contour:
        for end in self.ends[k]:
            self.cells[self._cell(end)].pop(k, None)
        return self.pieces.pop(k)

    def meeting(self, tail: Floats) -> Contour | None:
        """The piece whose end is nearest to a place, from there on; None where none is within the tolerance."""
        place = tail.tolist()
        x, y = self._cell(place)
        near = {k for i in (-1, 0, 1) for j in (-1, 0, 1) for k in self.cells.get((x + i, y + j), ())}
        away = [(min(math.dist(end, place) for end in self.ends[k]), k) for k in near]
        off, k = min(away, default=(math.inf, 0))
        if off > self.tolerance:
            return None
        forwards = math.dist(self.ends[k][0], place) <= self.tolerance
        piece = self._take(k)
        return piece if forwards else piece.reversed()


def _strung(chain: Sequence[Contour], closed: bool) -> Contour:
    points = np.vstack([contour.points[:-1] for contour in chain])
    bulge = np.concatenate([contour.bulge[:-1] for contour in chain])
    if closed:
        return Contour(points, bulge)
    return Contour(np.vstack([points, chain[-1].points[-1:]]), np.append(bulge, 0.0), closed=False)
