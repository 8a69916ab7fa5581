"""The connected areas that a mill clears at each height, from below upwards: exact regions, without what lies deeper anyway."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mnclab.design.recognition.naming import Stadium, named
from mnclab.design.recognition.sorting import Work
from mnclab.design.recognition.tracks import Track, coarse, polygon, swept
from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region

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
        if isinstance(whole := named(self.whole.loops[0]), Stadium) and len(self.whole.loops) == 1 and self._ends_in(whole):
            self.shape = whole

    def _ends_in(self, slot: Stadium) -> bool:
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


def areas_of(work: Work, blank: Region) -> tuple[list[Area], list[int]]:
    """The areas, and the rows of slopes that stay: no level area covers them."""
    stock = polygon(blank)
    gone, found, rows = shapely.Polygon(), list[Area](), list[int]()
    slopes = sorted(work.slopes, key=lambda each: each[0])
    for z in [*work.levels, np.inf]:
        while slopes and slopes[0][0] < z - ON_EDGE:  # all that is cleared below and at its lowest place is known
            track = slopes.pop(0)[1]
            if _matters(coarse([track])[0].intersection(stock), gone):
                rows.append(track.row)
        if not np.isfinite(z):
            break
        tracks = work.levels[z]
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
