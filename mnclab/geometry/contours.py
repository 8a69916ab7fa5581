"""A contour: a chain of lines and circular arcs in the plane, exact in length, area, sense and place.

An arc is a chord with a *bulge* b = tan(sweep / 4), as in DXF: 0 for a line, 1 for half a circle
counter-clockwise, -1 for half a circle clockwise. Lengths in mm, angles in rad, arrays `(n, 2)`.

     s ----- e      chord c, sagitta c·b/2, radius c·(1 + b²) / (4·|b|); drawn for b > 0
      `.___.'       the centre lies c·(1 - b²) / (4·b) to the left of the middle of the chord
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property, wraps
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.geometry.curves import Curves, Floats, at_angle, counted, cross, left, length_of, turned
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, check_point, refusing_class, shown, whole
from mnclab.text.tables import svg_of

NOISE = 1e-9  # mm, by which two ways that are equally far may differ
FULL_TURN = 2 * np.pi
CUSP = 1e-8  # rad, by which opposite directions may be off
SHORTEST = 1e-9  # mm, of a piece
SEEN = 0.01  # mm, by which a drawn arc may be off
FLAT = 1e-9  # a smaller bulge is a line: over a chord of 1 m it would rise by half a nanometre


def column(worked_out: Callable[[Any], Floats]) -> cached_property[Floats]:
    """An array that a thing has for good: worked out when first asked for, and nobody writes into it."""

    @wraps(worked_out)
    def once(of: Any) -> Floats:
        (found := worked_out(of)).flags.writeable = False
        return found

    return cached_property(once)


@refusing_class
@dataclass(frozen=True, eq=False)
class Contour:
    """Points `(n, 2)` joined by lines and arcs; element i runs from point i to point i + 1.

    A closed contour has n elements, the last one back to point 0. An open one has n - 1, but `bulge` has n
    entries, so that columns stay columns; the last is set to 0 and not used. No element sweeps a full turn: a
    full circle is two halves (`Contour.circle`).
    """

    points: Floats
    bulge: Floats
    closed: bool = True

    def __init__(self, points: ArrayLike, bulge: ArrayLike | None = None, closed: bool = True) -> None:
        corners = np.array(points, dtype=float).reshape(-1, 2)
        bent = np.zeros(len(corners)) if bulge is None else np.array(bulge, dtype=float)
        if len(corners) < 2:
            raise ValueError(f"a contour needs at least two points, got {len(corners)}")
        if bent.shape != (len(corners),):
            raise ValueError(f"a contour needs a bulge for each of {len(corners)} points, got {bent.size}")
        if not (np.isfinite(corners).all() and np.isfinite(bent).all()):
            raise ValueError("a contour has finite points and bulges only (a full circle is two arcs)")
        bent[np.abs(bent) < FLAT] = 0.0
        if not closed:
            bent[-1] = 0.0
        corners.flags.writeable = bent.flags.writeable = False
        vars(self).update(points=corners, bulge=bent, closed=bool(closed))

    @classmethod
    def circle(cls, centre: ArrayLike, radius: float, start: float = 0.0, clockwise: bool = False) -> Contour:
        """The full circle that begins at the angle `start`, as two half circles."""
        arm, middle = abs(radius) * at_angle(start), np.asarray(centre, dtype=float)
        return cls([middle + arm, middle - arm], [-1.0, -1.0] if clockwise else [1.0, 1.0])

    def __repr__(self) -> str:
        return f"<Contour {'closed' if self.closed else 'open'}, {len(self.starts)} elements, {self.length:.3f} mm>"

    def _repr_svg_(self) -> str | None:
        return svg_of([self.points_within(SEEN)], filled=self.closed)

    # ---- elements, as columns ----

    @property
    def starts(self) -> Floats:
        """Where the m elements begin, `(m, 2)`."""
        return self.points if self.closed else self.points[:-1]

    @column
    def ends(self) -> Floats:
        """Where the m elements end, `(m, 2)`."""
        return np.concatenate([self.points[1:], self.points[:1]]) if self.closed else self.points[1:]

    @column
    def chords(self) -> Floats:
        """From where the m elements begin to where they end, `(m, 2)`."""
        return self.ends - self.starts

    @column
    def sweeps(self) -> Floats:
        """Signed angles of the m elements, + counter-clockwise, 0 for lines, `(m,)`."""
        return 4 * np.arctan(self.bulge if self.closed else self.bulge[:-1])

    @column
    def radii(self) -> Floats:
        """Radii of the m elements, inf for lines, `(m,)`."""
        b = np.abs(self.bulge[: len(self.starts)])
        with np.errstate(divide="ignore", invalid="ignore"):
            radius: Floats = length_of(self.chords) * (1 + b * b) / (4 * b)
            return np.where(b == 0, np.inf, radius)

    @column
    def centres(self) -> Floats:
        """Centres of the m elements, nan for lines, `(m, 2)`."""
        b = self.bulge[: len(self.starts), None]
        with np.errstate(divide="ignore", invalid="ignore"):
            offset: Floats = left(self.chords) * (1 - b * b) / (4 * b)
            return np.where(b == 0, np.nan, (self.starts + self.ends) / 2 + offset)

    @column
    def lengths(self) -> Floats:
        """Lengths of the m elements, `(m,)`: chord · (1 + b²) · atan(b) / b."""
        b = self.bulge[: len(self.starts)]
        ratio = np.divide(np.arctan(b), b, out=np.ones_like(b), where=b != 0)
        return length_of(self.chords) * (1 + b * b) * ratio

    @column
    def upto(self) -> Floats:
        """The ways along the contour to where its m elements begin, and to its end, `(m + 1,)`."""
        return np.append(0.0, np.cumsum(self.lengths))

    @cached_property
    def walk(self) -> list[tuple[tuple[float, float], float, tuple[float, float]]]:
        """End, sweep and centre of the m elements as plain numbers, for a walk one by one; worked out once."""
        ends, centres = self.ends.tolist(), self.centres.tolist()
        return [((x, y), s, (u, v)) for (x, y), s, (u, v) in zip(ends, self.sweeps.tolist(), centres, strict=True)]

    @property
    def curves(self) -> Curves:
        """The m elements as curves."""
        radii = np.where(np.isinf(self.radii), np.nan, self.radii)
        return Curves(self.starts, self.ends, self.centres, radii, self.sweeps)

    def tangents(self) -> tuple[Floats, Floats]:
        """Unit tangents at the start and at the end of every element, each `(m, 2)`."""
        half, size = self.sweeps / 2, np.maximum(length_of(self.chords), 1e-300)[:, None]
        return turned(self.chords, -half) / size, turned(self.chords, half) / size

    def turns(self) -> Floats:
        """Angle by which the contour turns at the start of every element, + to the left, 0 at an open start, `(m,)`."""
        begin, end = self.tangents()
        bend = np.sign(self.sweeps) / self.radii
        angle = turning(np.roll(end, 1, axis=0), begin, np.roll(bend, 1) + bend)
        if not self.closed:
            angle[0] = 0.0
        return angle

    # ---- the whole ----

    @cached_property
    def length(self) -> float:
        return float(self.lengths.sum())

    @property
    def area(self) -> float:
        """Area within, + counter-clockwise; an open contour counts as closed by a straight line.

        The area within the chords, and for every arc the piece between it and its chord: r²·(s - sin s) / 2.
        """
        p, b = self.points - self.points[0], self.bulge
        q, sweep = np.roll(p, -1, axis=0), 4 * np.arctan(b)
        chord2 = ((q - p) ** 2).sum(axis=1)
        flat = np.abs(b) < 1e-3  # there the difference cancels; the series c²·b·(1 + b²/5) / 3 is exact
        with np.errstate(divide="ignore", invalid="ignore"):
            round_piece = chord2 * (1 + b * b) ** 2 / (32 * b * b) * (sweep - np.sin(sweep))
        pieces = np.where(flat, chord2 * b * (1 + b * b / 5) / 3, round_piece)
        return float(cross(p, q).sum() / 2 + pieces.sum())

    @column
    def bounds(self) -> Floats:
        """Lower left and upper right corner, `(2, 2)`; arcs bulge out to their quadrant points."""
        bent = self.sweeps != 0
        axes = np.array([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]])
        quadrants = self.centres[bent, None] + self.radii[bent, None, None] * axes
        first, sweep = self._first_angles()[bent, None], self.sweeps[bent, None]
        ahead = _ahead(np.arange(4) * np.pi / 2, first, sweep)
        corners = np.vstack([self.points, quadrants[ahead <= np.abs(sweep)]])
        return np.array([corners.min(axis=0), corners.max(axis=0)])

    def reversed(self) -> Contour:
        """The same way walked backwards; a closed contour keeps its first point."""
        if self.closed:
            return Contour(np.roll(self.points[::-1], 1, axis=0), -self.bulge[::-1])
        return Contour(self.points[::-1], np.append(-self.bulge[-2::-1], 0.0), closed=False)

    def transformed(self, matrix: ArrayLike) -> Contour:
        """Moved by a 3×3 matrix of the plane, or by x and y of a 4×4 frame; under a mirror arcs turn over.

        Raises ValueError where an arc would become an ellipse.
        """
        frame = np.asarray(matrix, dtype=float)
        turn, shift = frame[:2, :2], frame[:2, -1]
        if self.bulge.any() and not keeps_circles(turn):
            raise ValueError("an arc stays an arc only under equal scales and without a tilt of its plane")
        sign = -1.0 if np.linalg.det(turn) < 0 else 1.0
        return Contour(self.points @ turn.T + shift, sign * self.bulge, self.closed)

    # ---- places on it ----

    def point_at(self, distance: ArrayLike) -> tuple[Floats, Floats]:
        """Point and unit tangent after a way along the contour: `(2,)` each, or `(k, 2)` for k distances.

        A closed contour goes round and round; an open one stops at its ends.
        """
        way = np.asarray(distance, dtype=float)
        element, fraction = self._element_at(np.atleast_1d(way))
        place, tangent = self.at(fraction, element)
        return (place, tangent) if way.ndim else (place[0], tangent[0])

    def points_within(self, chord_error: float) -> Floats:
        """A polyline `(m, 2)` with its points on the contour, nowhere farther off than `chord_error`; the first point of a closed
        one comes again."""
        steps = steps_within(self.radii, self.sweeps, chord_error)
        element, rank = counted(steps)
        places = self.at(rank / steps[element], element)[0]
        return np.vstack([places, self.ends[-1]])

    def distance(self, points: ArrayLike) -> Floats:
        """Distance of the contour from each of the points `(k, 2)`, never negative, `(k,)`."""
        return np.concatenate([self._feet(spots)[0].min(axis=1) for spots in self._blocks(points)])

    def nearest(self, point: ArrayLike) -> float:
        """The way along the contour to its point nearest to `point` (the first of several)."""
        off, fraction = self._feet(np.asarray(point, dtype=float).reshape(1, 2))
        i = int((off[0] <= off[0].min() + NOISE).argmax())
        return float(self.lengths[:i].sum() + fraction[0, i] * self.lengths[i])

    def nearest_points(self, points: ArrayLike) -> Floats:
        """The point of the contour nearest to each of the points `(k, 2)`, `(k, 2)`."""
        feet = []
        for spots in self._blocks(points):
            off, fraction = self._feet(spots)
            element = off.argmin(axis=1)
            feet.append(self.at(fraction[np.arange(len(element)), element], element)[0])
        return np.vstack(feet)

    def winding(self, points: ArrayLike) -> NDArray[np.int_]:
        """Rounds of a closed contour about each of the points `(k, 2)`, + counter-clockwise, `(k,)`."""
        return np.concatenate([self._winding(spots) for spots in self._blocks(points)])

    def started_at(self, distance: float) -> Contour:
        """The same closed contour begun after a way along it; the element met there is split, but of a circle in halves."""
        if not self.closed:
            raise ValueError("only a closed contour can begin anywhere")
        elements, fractions = self._element_at(np.array([float(distance)]))
        i, u = int(elements[0]), float(fractions[0])
        place = self.at(np.array([u]), elements)[0]
        if len(self.points) == 2 and (np.abs(np.abs(self.bulge) - 1) < FLAT).all():
            return Contour([place[0], self.points.sum(axis=0) - place[0]], np.sign(self.bulge))
        if min(u, 1 - u) * self.lengths[i] < 1e-9:
            i = (i + round(u)) % len(self.points)
            return Contour(np.roll(self.points, -i, axis=0), np.roll(self.bulge, -i))
        points = np.vstack([place, np.roll(self.points, -i - 1, axis=0)])
        bulge = np.append(0.0, np.roll(self.bulge, -i - 1))
        bulge[[0, -1]] = np.tan(self.sweeps[i] * np.array([1 - u, u]) / 4)
        return Contour(points, bulge)

    def between(self, first: float, last: float) -> Contour:
        """The open piece from one way along the contour to a later one; past the begin of a closed one, once round at most."""
        upto = self.upto
        if self.closed:
            start = float(np.mod(first, upto[-1]))
            first, last = start, start + min(last - first, float(upto[-1]))
            upto = np.concatenate([upto, upto[-1] + upto[1:]])
        low, high = np.maximum(first, upto[:-1]), np.minimum(last, upto[1:])
        some = np.flatnonzero(high - low > SHORTEST)
        if not len(some):
            return Contour(self.point_at([first, last])[0], closed=False)
        element, span = some % len(self.lengths), np.diff(upto)[some]
        shares = np.where(high == upto[1:], np.inf, high - upto[:-1])[some] / span
        begin = self.at((low - upto[:-1])[some[:1]] / span[:1], element[:1])[0]
        points = np.vstack([begin, self.at(np.minimum(shares, 1.0), element)[0]])
        bulge = np.tan(self.sweeps[element] * (high - low)[some] / span / 4)
        return Contour(points, np.append(bulge, 0.0), closed=False)

    def _blocks(self, points: ArrayLike) -> Iterator[Floats]:
        """Points `(k, 2)` in blocks, one at least: points by elements must fit into memory."""
        spots = np.asarray(points, dtype=float).reshape(-1, 2)
        size = max(1, 2_000_000 // len(self.starts))
        return (spots[i : i + size] for i in range(0, max(1, len(spots)), size))

    def _winding(self, spots: Floats) -> NDArray[np.int_]:
        """Rounds of the chords and of the pieces between arcs and chords; a spot on a chord counts as a little farther in x."""
        ends, chord, sweep, centres, radii, _ = self._elements
        side, y = cross(chord, spots[:, None] - self.starts), spots[:, 1, None]
        low, high = self.starts[:, 1], ends[:, 1]
        up, down = (low <= y) & (y < high), (high <= y) & (y < low)
        rounds = (up & (side > 0)).sum(axis=1) - (down & (side < 0)).sum(axis=1)
        k = np.flatnonzero(sweep)
        dx, dy = chord[k, 0], chord[k, 1]
        on_right = np.where(side[:, k] == 0, (dy > 0) | ((dy == 0) & (dx < 0)), side[:, k] < 0)
        within = length_of(spots[:, None] - centres[k]) < radii[k]
        pieces = (within & (on_right == (sweep[k] > 0))) * np.sign(sweep[k])
        return np.asarray(rounds + pieces.sum(axis=1), dtype=int)

    @cached_property
    def _elements(self) -> tuple[Floats, ...]:
        """Ends, chords, sweeps, centres, radii and first angles of the m elements, worked out once."""
        return self.ends, self.chords, self.sweeps, self.centres, self.radii, self._first_angles()

    def _first_angles(self) -> Floats:
        """Direction from the centre to the start of every element; nan for lines."""
        arm = self.starts - self.centres
        return np.arctan2(arm[:, 1], arm[:, 0])

    def _element_at(self, way: Floats) -> tuple[NDArray[np.intp], Floats]:
        """Element and fraction of it after each way along the contour."""
        upto = self.upto
        way = np.mod(way, upto[-1]) if self.closed else np.clip(way, 0.0, upto[-1])
        element = np.clip(np.searchsorted(upto, way, side="right") - 1, 0, len(self.starts) - 1)
        span = np.where(self.lengths > 0, self.lengths, 1.0)[element]
        return element, np.clip((way - upto[element]) / span, 0.0, 1.0)

    def at(self, fraction: float | Floats, element: NDArray[np.intp] | None = None) -> tuple[Floats, Floats]:
        """Points and tangents at fractions u of elements.

        The chord from the start to the fraction u of a sweep s has the length c·sin(u·s/2) / sin(s/2) and is
        turned by (u - 1)·s/2 against the whole chord: true of lines too, and of flat arcs with a far centre.
        """
        pick: Any = slice(None) if element is None else element
        chord, s = self.chords[pick], self.sweeps[pick]
        u = np.broadcast_to(np.asarray(fraction, dtype=float), s.shape)
        bent = np.abs(s) > 1e-8
        ratio = np.divide(np.sin(u * s / 2), np.sin(s / 2), out=u.copy(), where=bent)
        place = self.starts[pick] + ratio[:, None] * turned(chord, (u - 1) * s / 2)
        place = np.where((u == 1.0)[:, None], self.ends[pick], place)
        return place, turned(chord, (u - 0.5) * s) / np.maximum(length_of(chord), 1e-300)[:, None]

    def _feet(self, spots: Floats) -> tuple[Floats, Floats]:
        """Distance and fraction of the foot on each of m elements for each of k spots, `(k, m)` each."""
        ends, chord, s, centres, radii, first = self._elements
        to_start = spots[:, None] - self.starts
        size2 = np.where((chord**2).sum(axis=1) > 0, (chord**2).sum(axis=1), 1.0)
        u = np.clip((to_start * chord).sum(axis=2) / size2, 0.0, 1.0)
        off = length_of(to_start - u[..., None] * chord)
        k = np.flatnonzero(s)
        if len(k):
            arm = spots[:, None] - centres[k]
            ahead = _ahead(np.arctan2(arm[..., 1], arm[..., 0]), first[k], s[k])
            inside = ahead <= np.abs(s[k])
            at_start, at_end = length_of(to_start[:, k]), length_of(spots[:, None] - ends[k])
            off[:, k] = np.where(inside, np.abs(length_of(arm) - radii[k]), np.minimum(at_start, at_end))
            u[:, k] = np.where(inside, ahead / np.abs(s[k]), np.where(at_start <= at_end, 0.0, 1.0))
        return off, u


def turning(before: Floats, after: Floats, bends: Floats) -> Floats:
    """Angles from the directions `before` to those `after`, `(m, 2)`, + to the left.

    In a cusp, where they are opposite, `bends` tells to which side: the sum of 1 / radius on both sides, + to the left.
    """
    angle: Floats = np.arctan2(cross(before, after), (before * after).sum(axis=1))
    back = np.abs(angle) > np.pi - CUSP
    angle[back] = np.where(bends[back] > 0, -np.pi, np.pi)
    return angle


def joined(pieces: Iterable[Contour | None]) -> Contour:
    """Contours that follow each other as one, with straight lines across gaps."""
    points: list[Floats] = []
    bulges: list[float] = []
    for piece in filter(None, pieces):
        if points and length_of(piece.points[0] - points[-1]) <= SHORTEST:
            points.pop()
        elif points:
            bulges.append(0.0)
        points.extend(piece.points)
        bulges.extend(piece.bulge[:-1])
    return Contour(np.array(points), [*bulges, 0.0], closed=False)


def keeps_circles(matrix: Floats) -> bool:
    """Whether a 2×2 matrix makes circles of circles."""
    gram = matrix.T @ matrix
    return np.allclose(gram, gram[0, 0] * np.eye(2), rtol=1e-9, atol=1e-9 * np.trace(gram))


def steps_within(radii: Floats, sweeps: Floats, chord_error: float) -> NDArray[np.intp]:
    """Into how many chords each element is cut; one over the angle a is off by 2·r·sin²(a/4)."""
    if not chord_error > 0:
        raise ValueError(f"the chord error must be greater than 0, got {chord_error}")
    largest = 4 * np.arcsin(np.sqrt(np.minimum(chord_error / (2 * np.maximum(radii, 1e-300)), 0.5)))
    chords = np.divide(np.abs(sweeps), largest, out=np.ones_like(sweeps), where=sweeps != 0)
    return np.maximum(np.ceil(chords - 1e-9), 1.0).astype(np.intp)


def _ahead(angle: Floats, first: Floats, sweep: Floats) -> Floats:
    """How far an angle lies ahead of the first one in the sense of the sweep, 0 to 2π."""
    return np.mod((angle - first) * np.sign(sweep), FULL_TURN)


# Contours of simple figures from numbers: rectangle, slot, regular polygon. Lengths in mm, angles in rad.
# All are closed and run counter-clockwise. They begin where a tool likes to begin: in the middle of a side.

QUARTER = float(np.tan(np.pi / 8))  # the bulge of a quarter circle
MOST_CORNERS = 1_000_000  # of a polygon


def rectangle(
    length: float, width: float, corner: float = 0.0, *, centre: ArrayLike = (0, 0), angle: float = 0.0, begin: int = 0
) -> Contour:
    """A rectangle with corners of a radius; it begins where the axis `begin` (0 X, 1 Y) leaves it on the positive side.

    Raises ValueError where a side is not greater than 0 or the corners do not fit.
    """
    for name, number in (("length", length), ("width", width), ("corner radius", corner)):
        check_number(number, f"the {name} of a rectangle (mm)")
    _check_place("a rectangle", centre, angle)
    if whole(begin, "the axis at which a rectangle begins") not in (0, 1):
        raise Alarm(f"a rectangle begins at the axis 0 (X) or 1 (Y), got {shown(begin)}")
    a, b, corner = float(length) / 2, float(width) / 2, float(corner)
    if not (a > 0 and b > 0):
        raise Alarm(f"the sides of a rectangle must be greater than 0, got {length:g} and {width:g}")
    if not 0 <= corner <= min(a, b) + 1e-9:
        raise Alarm(f"a corner radius of {corner:g} does not fit into {length:g} by {width:g}")
    corner = min(corner, a, b)
    points = np.roll(np.array([(a, b), (-a, b), (-a, -b), (a, -b)]), -begin, axis=0)
    ahead = np.roll(np.array([(0, 1), (-1, 0), (0, -1), (1, 0)]), -begin, axis=0)
    bulge = np.zeros(5)
    if corner:
        points = np.stack([points - corner * ahead, points + corner * left(ahead)], axis=1).reshape(-1, 2)
        bulge = np.append(0.0, np.tile([QUARTER, 0.0], 4))
    points = np.vstack([[(a, 0.0), (0.0, b)][begin], points])
    some = length_of(np.roll(points, -1, axis=0) - points) > 1e-9  # two roundings may use up a side
    return Contour(placed(points[some], centre, angle), bulge[some])


def slot(line: Contour, width: float) -> Contour:
    """What lies within width / 2 of one straight line or one arc; it begins beyond the end of the line.

    An arc may come in pieces, so that it can go all the way round. Raises ValueError where the line has a corner, or is
    bent too much for the width.
    """
    if not isinstance(line, Contour):
        raise Alarm(f"the centre line of a slot must be a Contour, got {shown(line)}")
    check_number(width, "the width of a slot (mm)")
    if not is_smooth(line):
        raise Alarm("a slot has a centre line of one straight line or one arc")
    half, bulge = width / 2, line.bulge[:-1]
    if not 0 < half < line.radii.min():
        raise Alarm(f"a slot {width:g} wide does not fit its centre line")
    begins, ends = line.tangents()
    aside = half * left(np.vstack([begins, ends[-1:]]))
    beyond, before = line.points[-1] + half * ends[-1], line.points[0] - half * begins[0]
    points = np.vstack([beyond, (line.points + aside)[::-1], before, line.points - aside])
    return Contour(points, np.concatenate([[QUARTER], -bulge[::-1], [QUARTER, QUARTER], bulge, [QUARTER]]))


def is_smooth(line: Contour) -> bool:
    """Whether an open contour is one straight line or one arc, in any number of pieces."""
    begins, ends = line.tangents()
    bends = np.sign(line.bulge[:-1]) / line.radii
    one_way = np.allclose(begins[1:], ends[:-1], atol=1e-6) and np.allclose(bends, bends[0], rtol=1e-6)
    return not line.closed and bool(one_way)


def arc(radius: float, begin: float, sweep: float) -> Contour:
    """An arc about (0, 0) from the angle `begin` (rad) on, at most a full turn; above half a turn in two pieces."""
    check_number(radius, "the radius of an arc (mm)")
    check_number(begin, "the angle at which an arc begins (rad)")
    check_number(sweep, "the angle that an arc goes through (rad)")
    count = 1 if abs(sweep) <= np.pi else 2
    way = begin + sweep * np.arange(count + 1) / count
    bulge = np.append(np.full(count, np.tan(sweep / count / 4)), 0.0)
    return Contour(radius * at_angle(way), bulge, closed=False)


def polygon(corners: int, radius: float, *, centre: ArrayLike = (0, 0), angle: float = 0.0) -> Contour:
    """A regular polygon in a circle of a radius, its first corner at `angle`."""
    check_number(corners, "the number of corners of a polygon", at_most=MOST_CORNERS)
    corners = whole(corners, "the number of corners of a polygon")
    check_number(radius, "the radius of a polygon (mm)")
    _check_place("a polygon", centre, angle)
    if corners < 3 or not radius > 0:
        raise Alarm(f"a polygon has at least 3 corners and a radius above 0, got {corners} and {radius:g}")
    way = angle + 2 * np.pi * np.arange(corners) / corners
    return Contour(placed(radius * at_angle(way), centre, 0.0))


def _check_place(figure: str, centre: ArrayLike, angle: float) -> None:
    check_point(centre, f"the centre of {figure} (mm)", flat=True)
    check_number(angle, f"the angle of {figure} (rad)")


def placed(points: Floats, centre: ArrayLike, angle: float) -> Floats:
    """Points `(n, 2)` turned about the origin, then moved to a centre."""
    return np.asarray((turned(points, angle) if angle else points) + np.asarray(centre, dtype=float))
