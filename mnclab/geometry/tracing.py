"""Areas as fine polylines whose pieces know their lines and arcs, so that these are found again in what shapely makes of them.

Every straight piece of a result lies on a piece of an operand, and each of those knows its curve:

    operands, arcs and all  ──►  polylines, every piece tagged with its whole line or circle
    shapely                 ──►  rings of straight pieces: their order is right, their corners are near
    runs of pieces with one tag  ──►  one element on the exact curve
    corners                 ──►  where neighbouring curves meet

Equal circles are cut at equal places, so that boundaries which coincide do so exactly. Lengths in mm.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import shapely
from mnclab.geometry.contours import FULL_TURN, Contour, steps_within
from mnclab.geometry.curves import Curves, Floats, at_angle, cross, foot, left, length_of, meet, turned, unit_of, whole
from mnclab.geometry.cutting import outlines_of

CHORD_ERROR = 2e-5  # mm, of the polylines: decides only what touches and what does not
GRID = 1e-9  # mm, on which shapely rounds corners, so that nearly equal ones become equal
SAME = 1e-7  # mm, below which places and radii count as equal
SMOOTH = 1e-9  # rad, below which a corner is none


@dataclass
class TaggedPolylines:
    """Contours as polylines whose pieces know their curves."""

    contours: Sequence[Contour]
    rings: list[Floats] = field(default_factory=list)  # (k, 2) each, not closed
    tags: list[NDArray[np.intp]] = field(default_factory=list)  # (k,) each: which of the curves
    curves: Curves = field(init=False)  # the elements of all contours

    def __post_init__(self) -> None:
        self.curves = c = outlines_of(self.contours).curves
        label, arcs = labels(c).tolist(), np.flatnonzero(c.arc).tolist()
        arcs_on: dict[int, list[Floats]] = {}
        for k in arcs:
            arcs_on.setdefault(label[k], []).extend([c.start[k], c.end[k]])
        between = {k: _arc_points(c, label[k], c.start[k], c.sweep[k], np.array(arcs_on[label[k]])) for k in arcs}
        first = 0
        for contour in self.contours:
            elements = range(first, first + len(contour.points))
            pieces = [np.vstack([c.start[k : k + 1], *([between[k]] if k in between else [])]) for k in elements]
            self.rings.append(np.vstack(pieces))
            self.tags.append(np.repeat(label[first : elements.stop], [len(piece) for piece in pieces]))
            first = elements.stop

    def area(self, loops: Sequence[Contour], first: int) -> Any:
        """Loops of a region, which stand in the drawing from `first` on, as a shapely area."""
        pieces: list[tuple[Floats, list[Floats]]] = []
        for loop, ring in zip(loops, self.rings[first:], strict=False):
            if len(ring) < 3:
                continue  # a circle smaller than what counts as equal
            if loop.area > 0:
                pieces.append((ring, []))
            else:
                pieces[-1][1].append(ring)
        whole = shapely.MultiPolygon([shapely.Polygon(*piece) for piece in pieces])
        return whole if whole.is_valid else shapely.union_all(_polygons(shapely.make_valid(whole)))

    def traced(self, result: Any) -> tuple[Contour, ...]:
        """The loops of a shapely result, with lines and arcs found again."""
        starts = np.vstack([np.zeros((0, 2)), *self.rings])
        ends = np.vstack([np.zeros((0, 2)), *(np.roll(ring, -1, axis=0) for ring in self.rings)])
        return traced(result, starts, ends, np.concatenate([np.zeros(0, dtype=int), *self.tags]), self.curves)


def polygons_of(loops: Sequence[Contour]) -> Any:
    """The loops of a region as a shapely area of fine polylines, `CHORD_ERROR` mm from it."""
    return TaggedPolylines(loops).area(loops, 0)


def covered(contours: Sequence[Contour]) -> Any:
    """What closed contours cover together, as a shapely area of such polylines."""
    return shapely.union_all([shapely.Polygon(ring) for ring in TaggedPolylines(contours).rings if len(ring) > 2])


def traced(
    result: Any, starts: Floats, ends: Floats, tags: NDArray[np.intp], curves: Curves
) -> tuple[Contour, ...]:
    """The loops of a shapely area, with lines and arcs found again.

    It was made of straight pieces from `starts` to `ends` (k, 2), each on one of the curves, which its tag names.
    """
    tree = shapely.STRtree(shapely.linestrings(np.stack([starts, ends], axis=1)))
    loops: list[Contour] = []
    for polygon in _polygons(result):
        for ring, sense in [(polygon.exterior, 1.0), *((ring, -1.0) for ring in polygon.interiors)]:
            corners = shapely.get_coordinates(ring)[:-1]
            after = np.roll(corners, -1, axis=0)
            middles, way = shapely.points((corners + after) / 2), after - corners
            piece, source = tree.query(middles, predicate="dwithin", distance=10 * GRID)
            skew = np.abs(cross(way[piece], unit_of(ends - starts)[source]))
            order = np.lexsort((source, skew, piece))
            piece, chosen = np.unique(piece[order], return_index=True)
            tag = np.full(len(corners), -1)
            tag[piece] = tags[source[order][chosen]]
            loop = _found_again(corners, tag, curves)
            if loop is not None:
                loops.append(loop if loop.area * sense > 0 else loop.reversed())
            elif sense > 0:
                break  # a sliver, and so are its holes
    return tuple(loops)


def _found_again(ring: Floats, tag: NDArray[np.intp], curves: Curves) -> Contour | None:
    """A ring `(m, 2)` of straight pieces with tags `(m,)` as lines and arcs; None for a sliver."""
    raw = Contour(ring)
    if abs(raw.area) < SAME * 10 * raw.length:
        return None
    runs = _runs(raw, tag, curves)
    mine = curves.take(np.array([which for which, _, _ in runs], dtype=np.int64))
    if len(runs) == 1 and mine.arc[0]:
        arm = ring[0] - mine.centre[0]
        return Contour.circle(mine.centre[0], float(mine.r[0]), np.arctan2(arm[1], arm[0]), clockwise=raw.area < 0)
    corners = _corners(mine.take(np.arange(len(runs)) - 1), mine, ring[[first for _, first, _ in runs]])
    points: list[Floats] = []
    bulge: list[float] = []
    columns = zip(runs, corners, np.roll(corners, -1, axis=0), mine.centre, mine.r, mine.arc, strict=True)
    for (_, first, last), start, end, centre, radius, arc in columns:
        sweeps = [0.0]
        if arc:
            seen = _angle_swept(np.vstack([ring, ring])[first : last + 1] - centre)
            exact = _angle_swept(np.array([start, end]) - centre)
            sweep = seen + np.remainder(exact - seen + np.pi, FULL_TURN) - np.pi
            sweeps = [sweep] if abs(sweep) < 6 else [sweep / 2, sweep / 2]
        if length_of(end - start) < SAME and len(sweeps) == 1:
            continue
        arm = start - centre
        for k, sweep in enumerate(sweeps):
            points.append(start if k == 0 else centre + radius * unit_of(turned(arm, sweep)))
            bulge.append(float(np.tan(sweep / 4)))
    exact_loop = Contour(points, bulge) if len(points) > 1 else raw
    plausible = abs(exact_loop.area - raw.area) < 10 * CHORD_ERROR * raw.length
    return exact_loop if plausible else raw


def _runs(raw: Contour, tag: NDArray[np.intp], curves: Curves) -> list[tuple[int, int, int]]:
    """Runs of pieces on one curve: (curve, first point, last point), the last one counted on past the end."""
    kept = np.flatnonzero((raw.lengths > 10 * SAME) & (tag >= 0))
    mine = tag[kept]
    before, here = curves.take(np.roll(mine, 1)), curves.take(mine)
    in_line = np.abs(cross(unit_of(before.end - before.start), unit_of(here.end - here.start))) < SMOOTH
    in_line &= ~(before.arc | here.arc) & (length_of(foot(here.start, before) - here.start) < SAME)
    fresh = np.flatnonzero((np.roll(mine, 1) != mine) & ~in_line).tolist()
    if not fresh:
        return [(int(mine[0]), 0, len(tag))] if len(kept) else []
    found = []
    for j, k in zip(fresh, [*fresh[1:], fresh[0] + len(kept)], strict=True):
        first, last = int(kept[j]), int(kept[(k - 1) % len(kept)]) + 1
        found.append((int(mine[j]), first, last if last > first else last + len(tag)))
    return found


def _corners(a: Curves, b: Curves, near: Floats) -> Floats:
    """Where neighbours meet `(m, 2)`; of those that touch smoothly the places found by shapely are the better ones."""
    off = np.maximum(length_of(foot(near, a) - near), length_of(foot(near, b) - near))
    smooth = (off < 10 * GRID) & (np.abs(cross(_along(a, near), _along(b, near))) < 1e-3)
    met = meet(whole(a), whole(b), near, touching=True)
    with np.errstate(invalid="ignore"):  # parallel lines meet nowhere
        on_both = np.maximum(length_of(foot(met, a) - met), length_of(foot(met, b) - met)) < SAME
    return np.where((on_both & ~smooth)[:, None], met, near)


def labels(curves: Curves) -> NDArray[np.intp]:
    """For each curve the first one that is on the same circle; a line is its own."""
    label, bent = np.arange(len(curves.r)), np.flatnonzero(curves.arc)
    if len(bent):
        centres, radius = shapely.points(curves.centre[bent]), curves.r[bent]
        i, k = shapely.STRtree(centres).query(centres, predicate="dwithin", distance=SAME)
        alike = np.abs(radius[i] - radius[k]) < SAME
        np.minimum.at(label, bent[i[alike]], bent[k[alike]])
    return label


def _arc_points(curves: Curves, circle: int, start: Floats, sweep: float, ends: Floats) -> Floats:
    """Points strictly between the ends of an arc: those of a fixed grid on its circle, that of a curve, and all `ends` there.

    They depend on the circle alone, so that two arcs over the same stretch have the same points.
    """
    centre, radius = curves.centre[circle], float(curves.r[circle])
    count = int(steps_within(np.array([radius]), np.array([FULL_TURN]), CHORD_ERROR)[0])
    step, arm = FULL_TURN / count, start - centre
    low = np.arctan2(arm[1], arm[0]) + min(sweep, 0.0)
    grid = np.arange(np.ceil(low / step), np.floor((low + abs(sweep)) / step) + 1)
    angle = np.mod(grid, count) * step
    spots = centre + radius * at_angle(angle)
    arms = ends - centre
    fixed = np.unique(np.mod(np.arctan2(arms[:, 1], arms[:, 0]) - low, FULL_TURN), return_index=True)
    places = np.concatenate([fixed[0], grid * step - low])
    spots = np.vstack([ends[fixed[1]], spots])
    near = SAME / radius
    clear = (places > near) & (places < abs(sweep) - near)
    gap = np.abs(np.remainder(places[len(fixed[0]) :, None] - fixed[0] + np.pi, FULL_TURN) - np.pi)
    clear[len(fixed[0]) :] &= (gap > near).all(axis=1)
    clear[1 : len(fixed[0])] &= np.diff(fixed[0]) > near
    order = np.flatnonzero(clear)[np.argsort(places[clear])]
    return spots[order if sweep > 0 else order[::-1]]


def _polygons(geometry: Any) -> list[Any]:
    """The polygons of any shapely geometry, from left to right; loose points and lines are no area."""
    flat = shapely.get_parts(shapely.get_parts(geometry))
    found = [g for g in flat if g.geom_type == "Polygon" and not g.is_empty]
    return sorted(found, key=lambda g: g.bounds[:2])


def _along(curve: Curves, p: Floats) -> Floats:
    """The directions of curves at points (n, 2)."""
    with np.errstate(invalid="ignore"):
        round_ = left(p - curve.centre) / curve.r[:, None]
    return np.where(curve.arc[:, None], round_, unit_of(curve.end - curve.start))


def _angle_swept(arms: Floats) -> float:
    """The signed angle swept by arms `(k, 2)` from the first to the last."""
    before, after = arms[:-1], arms[1:]
    return float(np.arctan2(cross(before, after), (before * after).sum(axis=1)).sum())


# Insets by taking away bands along the elements: slower than cutting, for loops that touch in too many places to be cut.
# The inset by d loses bands of width d along the inner side of every element, and a fan of radius d at each corner that
# points inwards. They are made of lines and arcs as well, so that an inset is one more difference. Lengths in mm.

def inset_by_bands(loops: Sequence[Contour], distance: float) -> tuple[Contour, ...]:
    """The loops of a region inset by a distance, or grown by a negative one."""
    faces = loops if distance > 0 else [loop.reversed() for loop in loops]
    bands = [band for face in faces for band in bands_beside(face, abs(distance))]
    drawing = TaggedPolylines([*loops, *bands])
    strips = [shapely.Polygon(ring) for ring in drawing.rings[len(loops) :]]
    strip = shapely.union_all(strips, grid_size=GRID)
    change = shapely.difference if distance > 0 else shapely.union
    return drawing.traced(change(drawing.area(loops, 0), strip, grid_size=GRID))


def bands_beside(line: Contour, width: float) -> Iterator[Contour]:
    """Bands along the left side of each element, and fans where the line turns to the right."""
    begin, end = line.tangents()
    first, last = line.starts + width * left(begin), line.ends + width * left(end)
    turns, bulge = line.turns(), line.bulge[: len(line.starts)]
    smooth = np.abs(turns) <= SMOOTH
    smooth[0] &= line.closed
    first[smooth] = np.roll(last, 1, axis=0)[smooth]  # no gap as wide as a rounding error
    to_centre = np.where(bulge > 0, line.radii, np.inf)
    for i, (start, stop, centre) in enumerate(zip(line.starts, line.ends, line.centres, strict=True)):
        if to_centre[i] <= width + SAME:
            yield Contour([start, stop, centre], [bulge[i], 0.0, 0.0])
        else:
            yield Contour([start, stop, last[i], first[i]], [bulge[i], 0.0, -bulge[i], 0.0])
        if turns[i] < -SMOOTH:
            yield Contour([start, last[i - 1], first[i]], [0.0, np.tan(turns[i] / 4), 0.0])
