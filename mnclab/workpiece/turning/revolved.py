"""A half section turned about its axis: volume, radii over a place, distance, surface; and such a body as a blank."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.geometry.contours import Contour, steps_within
from mnclab.geometry.curves import Floats, at_levels, crossed
from mnclab.geometry.cutting import outlines_of
from mnclab.geometry.regions import Region
from mnclab.workpiece.blank import CORNERS, Array
from mnclab.workpiece.part import Part
from mnclab.workpiece.workpiece import Solid

# Sections are closed contours (z, r), mm: outer ones counter-clockwise, holes clockwise.

AXIS = 1e-9  # mm: what lies nearer lies on the axis
CHORD_ERROR = 0.01  # mm, of the arcs of a surface
ROUND = 144  # corners of a circle of a surface: its volume is 0.03 % less than that of the part


def moment(contour: Contour) -> float:
    """The area within times the radius of its middle, mm³: by Pappus the volume of a full turn over 2π, exact.

    Lines by Green's theorem; of an arc the piece between it and its chord has its middle on the line across the chord.
    """
    p, q = contour.points, np.roll(contour.points, -1, axis=0)
    lines = -(q[:, 0] - p[:, 0]) * (p[:, 1] ** 2 + p[:, 1] * q[:, 1] + q[:, 1] ** 2) / 6
    bent = np.flatnonzero(contour.bulge)
    if not len(bent):
        return float(lines.sum())
    b, sweep, dz = contour.bulge[bent], 4 * np.arctan(contour.bulge[bent]), (q - p)[bent, 0]
    chord2 = ((q - p)[bent] ** 2).sum(axis=1)
    middle = (p + q)[bent, 1] / 2
    radius = np.sqrt(chord2) * (1 + b * b) / (4 * np.abs(b))
    high = middle + dz * (1 - b * b) / (4 * b)  # of the centre
    area = radius**2 / 2 * (sweep - np.sin(sweep))
    away = -dz / np.sqrt(chord2) * 2 / 3 * radius**3 * np.abs(np.sin(sweep / 2)) ** 3
    flat = np.abs(b) < 1e-3  # there both cancel; the piece is a parabola's, its middle at 3/5 of the height
    low = chord2 * b * (1 + b * b / 5) / 3
    pieces = np.where(flat, low * (middle - 0.3 * b * dz), area * high + away)
    return float(lines.sum() + pieces.sum())


def radii_at(section: Sequence[Contour], z: Floats) -> list[Floats]:
    """Over each place z (k,) the radii at which the material begins and ends, growing; at a shoulder those on its left."""
    return crossed(outlines_of(section).curves, z, axis=0)


def ends_at(section: Sequence[Contour], radius: Floats) -> tuple[Floats, Floats]:
    """The lowest and the highest z of the material at each radius, in its shape; nan where there is none."""
    curves, at = outlines_of(section).curves, radius.ravel()
    level, z = at_levels(curves, at)
    corner = curves.start[np.isin(curves.start[:, 1], at)]
    of, number = np.nonzero(corner[:, 1:] == at)
    level, z = np.concatenate([level, number]), np.concatenate([z, corner[of, 0]])
    low, high = np.full(len(at), np.inf), np.full(len(at), -np.inf)
    np.minimum.at(low, level, z)
    np.maximum.at(high, level, z)
    found = (np.where(np.isfinite(ends), ends, np.nan).reshape(radius.shape) for ends in (low, high))
    return next(found), next(found)


def both_halves(section: Sequence[Contour]) -> tuple[Contour, ...]:
    """The whole section through the axis, closed contours (z, x), x from the axis on."""
    other = [Contour(loop.points * (1, -1), -loop.bulge).reversed() for loop in section]
    return Region(tuple(section)).union(Region(tuple(other))).loops


def overhangs(section: Sequence[Contour]) -> bool:
    """Whether seen along the axis one part of the material stands over another, with air between them."""
    corners = np.unique(np.concatenate([contour.points[:, 1] for contour in section] or [np.zeros(0)]))
    middles = (corners[:-1] + corners[1:])[np.diff(corners) > AXIS] / 2
    return any(len(places) > 2 for places in crossed(outlines_of(section).curves, middles))


def volume(section: Sequence[Contour]) -> float:
    """mm³, by Pappus."""
    return 2 * math.pi * sum(moment(contour) for contour in section)


def part(section: Sequence[Contour], axis: float) -> Part:
    """The body about x = `axis`, y = 0 as a probe meets it; in the material the axis counts as a face."""
    region = Region(tuple(section))
    (low, _), (high, wide) = region.bounds if section else np.zeros((2, 2))
    bounds = np.array([(axis - wide, -wide, low), (axis + wide, wide, high)])
    return Part(partial(_distance, region, axis), "turned part", bounds=bounds)


def _distance(region: Region, axis: float, points: Floats) -> Floats:
    spots = np.stack([points[:, 2], np.hypot(points[:, 0] - axis, points[:, 1])], axis=1)
    return np.where(region.contains(spots), -1.0, 1.0) * region.distance(spots)


def solid(section: Sequence[Contour], rows: Sequence[NDArray[np.int64]], axis: float) -> Solid:
    """The closed surface; `rows` say for each contour which row cut its elements."""
    points: list[Floats] = []
    triangles: list[NDArray[np.int64]] = []
    owners: list[NDArray[np.int64]] = []
    angle = 2 * np.pi * np.arange(ROUND) / ROUND
    count = 0
    for contour, row in zip(section, rows):
        line = contour.points_within(CHORD_ERROR)[:-1]
        owner = np.repeat(row, steps_within(contour.radii, contour.sweeps, CHORD_ERROR))
        on = line[:, 1] < AXIS
        ring = np.where(on, 1, ROUND)
        first = count + np.cumsum(ring) - ring
        for (z, r), axial in zip(line, on):
            turn = angle[:1] if axial else angle
            r = 0.0 if axial else r
            points.append(np.stack([axis + r * np.cos(turn), r * np.sin(turn), np.full(len(turn), z)], axis=1))
        count += int(ring.sum())
        k = np.arange(ROUND)
        for i in range(len(line)):
            j = (i + 1) % len(line)
            a, b = (first[e] + (0 if on[e] else k) for e in (i, j))
            c, d = (first[e] + (0 if on[e] else (k + 1) % ROUND) for e in (i, j))
            if on[i] and on[j]:
                continue
            faces = [] if on[j] else [np.stack(np.broadcast_arrays(a, b, d), axis=1)]
            faces += [] if on[i] else [np.stack(np.broadcast_arrays(a, d, c), axis=1)]
            triangles += faces
            owners += [np.full(ROUND, owner[i])] * len(faces)
    empty = np.empty((0, 3), dtype=np.int64)
    return Solid(
        np.vstack([np.empty((0, 3)), *points]), np.concatenate([empty, *triangles]).astype(np.int64),
        np.concatenate([empty[:, 0], *owners]).astype(np.int64),
    )  # fmt: skip


# A body that was turned, or is to be, as the blank of what comes next: any half section about an axis along Z.

class TurnedBlank(NamedTuple):
    """`section`: closed contours (z, r), mm, outer ones counter-clockwise, holes clockwise. `axis`: x and y of the axis.

    What asks for its sides from above (a mill) sees no grooves: between the lower and the upper side it counts as full.
    """

    section: tuple[Contour, ...]
    axis: tuple[float, float] = (0.0, 0.0)

    def __repr__(self) -> str:
        (_, _, low), (_, _, high) = self.bounds.tolist()
        widest = max(float(loop.bounds[1, 1]) for loop in self.section)
        return f"<TurnedBlank: diameter {2 * widest:g}, Z {low:g} to {high:g}, {self.volume:.3f} mm³>"

    @property
    def axis_x(self) -> float:
        """Where the axis of the spindle stands in x, mm."""
        return self.axis[0]

    def half_section(self) -> tuple[tuple[Contour, ...], float]:
        """What a lathe asks for: the contours (z, r) and where the axis stands in x, mm."""
        return self.section, self.axis_x

    @property
    def bounds(self) -> Array:
        """The corners with the least and the greatest coordinates (2, 3)."""
        boxes = np.array([loop.bounds for loop in self.section])
        (low, _), (high, wide) = boxes[:, 0].min(axis=0).tolist(), boxes[:, 1].max(axis=0).tolist()
        x, y = self.axis
        return np.array([(x - wide, y - wide, low), (x + wide, y + wide, high)])

    @property
    def volume(self) -> float:
        """mm³, by Pappus."""
        return volume(self.section)

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """How low and how high it reaches at points (m,); nan beside it."""
        return ends_at(self.section, np.hypot(x - self.axis[0], y - self.axis[1]))

    def moved(self, by: ArrayLike) -> TurnedBlank:
        """The same elsewhere."""
        dx, dy, dz = np.asarray(by, dtype=np.float64).tolist()
        section = tuple(Contour(loop.points + (dz, 0.0), loop.bulge) for loop in self.section)
        return TurnedBlank(section, (self.axis[0] + dx, self.axis[1] + dy))

    def outline(self, right: int, up: int) -> list[Array]:
        """What a view along an axis shows, the bore with it: closed lines (k, 2) in the coordinates `right` and `up`."""
        x, y = self.axis
        middle = np.array([x, y, 0.0])[[right, up]]
        if 2 not in (right, up):
            turn = np.linspace(0, 2 * np.pi, CORNERS + 1)
            radii = {float(loop.points[:, 1].max()) for loop in self.section}
            radii |= {float(loop.points[:, 1].min()) for loop in self.section if loop.area > 0}
            ring = np.stack([np.cos(turn), np.sin(turn)], axis=1)
            return [middle + radius * ring for radius in sorted(radii, reverse=True) if radius > AXIS]
        lines = [loop.points_within(CHORD_ERROR) for loop in both_halves(self.section)]
        return [middle + (line if right == 2 else line[:, ::-1]) for line in lines]

    def edges(self) -> list[Array]:
        """The edges that go round and four lines along the surface, each (k, 3)."""
        turn = np.linspace(0, 2 * np.pi, CORNERS + 1)
        quarters = np.pi / 2 * np.arange(4)
        found = []
        for loop in self.section:
            line = loop.points_within(CHORD_ERROR)
            rims = loop.points[(np.abs(loop.turns()) > 1e-6) & (loop.points[:, 1] > AXIS)]
            found += [self._points(float(rim[1]), turn, float(rim[0])) for rim in rims]
            found += [self._points(line[:, 1], float(quarter), line[:, 0]) for quarter in quarters]
        return found

    def solid(self) -> Solid:
        """Its closed surface; no row cut it."""
        found = solid(self.section, [np.full(len(loop.points), -1) for loop in self.section], self.axis_x)
        return found._replace(points=found.points + (0.0, self.axis[1], 0.0))

    def _points(self, radius: Array | float, turn: Array | float, z: Array | float) -> Array:
        """Points (k, 3) at radii and angles about the axis and heights."""
        x, y = self.axis[0] + radius * np.cos(turn), self.axis[1] + radius * np.sin(turn)
        return np.stack(np.broadcast_arrays(x, y, z), axis=1)
