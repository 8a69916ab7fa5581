"""A blank without what strokes cover, as a half section of lines and arcs; and what each stroke took away, in order.

As in `geometry.regions` areas are subtracted as fine polylines whose pieces know their lines and circles; from the rest
these are found again. All strokes are taken away at once. What hangs on the chuck's side, where z is low, stays.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import shapely
from mnclab.geometry.contours import FULL_TURN, Contour, steps_within
from mnclab.geometry.curves import Curve, Floats, at_angle, unit_of
from mnclab.geometry.tracing import labels, traced

CHORD_ERROR = 2e-5  # mm, of the polylines: decides only what touches and what does not
PLACES = 9  # decimals to which corners are rounded, so that nearly equal ones become equal
TINY = 1e-7  # mm, a piece narrower than this is none


@dataclass(frozen=True)
class Drawing:
    """Closed contours as rings of straight pieces; the first `bars` of them are the blank's, row -1.

    `rings` (m,): the first piece of each contour; of the k pieces `starts`, `ends` (k, 2), `tags` (k,) the curve that it
    lies on and `rows` (k,) the row that it belongs to.
    """

    contours: Sequence[Contour]
    owners: NDArray[np.int64]
    bars: int = 1

    @classmethod
    def of(cls, blank: Sequence[Contour], strokes: Sequence[Contour], rows: Sequence[int]) -> Drawing:
        """Of the loops of a blank and of what is taken away, with the row of each stroke."""
        return cls([*blank, *strokes], np.array([-1] * len(blank) + list(rows), dtype=np.int64), len(blank))

    @cached_property
    def elements(self) -> tuple[Floats, Floats, Floats, Floats, Floats, NDArray[np.int64]]:
        """Starts, ends, sweeps, centres, radii and contour of all elements."""
        which = np.repeat(np.arange(len(self.contours)), [len(each.points) for each in self.contours])
        points = np.concatenate([each.points for each in self.contours])
        ends = np.concatenate([each.ends for each in self.contours])
        bulge = np.concatenate([each.bulge for each in self.contours])
        chord = ends - points
        b = np.where(bulge == 0, 1.0, bulge)[:, None]
        normal = np.stack([-chord[:, 1], chord[:, 0]], axis=1)
        centres = (points + ends) / 2 + normal * (1 - b * b) / (4 * b)
        radii = np.hypot(*chord.T) * (1 + b[:, 0] ** 2) / (4 * np.abs(b[:, 0]))
        return points, ends, 4 * np.arctan(bulge), centres, np.where(bulge == 0, np.inf, radii), which

    @cached_property
    def pieces(self) -> tuple[Floats, Floats, NDArray[np.intp], NDArray[np.int64], NDArray[np.int64]]:
        """Starts, ends, tags and contours of the straight pieces, and the first piece of every contour."""
        starts, _, sweeps, centres, radii, which = self.elements
        step = np.zeros(len(starts))
        bent = np.flatnonzero(sweeps)
        step[bent] = FULL_TURN / steps_within(radii[bent], np.full(len(bent), FULL_TURN), CHORD_ERROR)
        first = np.zeros(len(starts))
        first[bent] = np.arctan2(*(starts - centres)[bent].T[::-1])
        inner = np.zeros(len(starts), dtype=np.int64)
        sense = np.sign(sweeps)
        with np.errstate(divide="ignore", invalid="ignore"):  # places of the grid of every circle that lie on the arc
            begin = np.where(sweeps != 0, np.floor(sense * first / step + 1e-6) + 1, 0.0)
            end = np.where(sweeps != 0, np.ceil(sense * (first + sweeps) / step - 1e-6) - 1, -1.0)
        inner[bent] = np.maximum(end - begin + 1, 0)[bent].astype(np.int64)
        element = np.repeat(np.arange(len(starts)), inner + 1)
        rank = np.arange(len(element)) - np.repeat(np.cumsum(inner + 1) - inner - 1, inner + 1)
        angle = sense[element] * (begin[element] + rank - 1) * step[element]
        with np.errstate(invalid="ignore"):
            on_circle = centres[element] + np.where(np.isinf(radii), 0.0, radii)[element, None] * at_angle(angle)
        points: Floats = np.where((rank == 0)[:, None], starts[element], on_circle).round(PLACES)
        contour = which[element]
        heads = np.searchsorted(contour, np.arange(len(self.contours)))
        after = np.arange(1, len(points) + 1)
        after[np.append(heads[1:], len(points)) - 1] = heads
        return points, points[after], element, contour, heads

    @cached_property
    def curves(self) -> list[Curve]:
        """The line or circle of every element."""
        starts, ends, _, centres, radii, _ = self.elements
        columns = zip(starts, unit_of(ends - starts), centres, radii)
        return [Curve(s, u, r) if np.isinf(r) else Curve(c, u, r) for s, u, c, r in columns]

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
        return traced(area, starts, ends, labels(self.curves)[element], self.curves)

    @cached_property
    def _tree(self) -> Any:
        starts, ends = self.pieces[:2]
        return shapely.STRtree(shapely.linestrings(np.stack([starts, ends], axis=1)))

    def rows_of(self, contour: Contour) -> NDArray[np.int64]:
        """The last row (k,) that has cut each element of a traced contour, -1 of the blank."""
        upto = np.cumsum(contour.lengths) - contour.lengths / 2
        spots = shapely.points(contour.point_at(upto)[0])
        element, piece = self._tree.query(spots, predicate="dwithin", distance=2 * CHORD_ERROR)
        found = np.full(len(contour.points), -1, dtype=np.int64)
        np.maximum.at(found, element, self.owners[self.pieces[3][piece]])
        return found


def left_of(drawing: Drawing) -> Any:
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


def cuts(drawing: Drawing, low: float) -> Iterator[tuple[int, Any, list[Any]]]:
    """The row of each stroke that takes something away, the area that it takes, and the pieces that fall then."""
    rest = drawing.bar
    for number, area in enumerate(drawing.strokes):
        if not shapely.intersects(rest, area):
            continue
        cut, off = shapely.intersection(rest, area), list[Any]()
        if cut.area:
            rest, off = held(shapely.difference(rest, area), low)
        yield int(drawing.owners[drawing.bars + number]), cut, off

