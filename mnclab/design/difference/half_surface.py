"""The surface of a turned part: its half section without the lines on the axis; places on it, distances, rays that meet it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, left
from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array, Index, Mask

AXIS = 1e-9  # mm: what lies nearer lies on the axis
BESIDE = 1e-7  # mm, above the axis, where material on it is looked for
FEWEST = 9  # places of an element
TURN = np.radians(2)  # of an arc, between two places
CHUNK = 400_000  # rays times elements that are looked at together


class Places(NamedTuple):
    """Places (m, 2) on a surface, unit normals (m, 2) out of the material, their line and element (m,), how far along the
    element they are (m,), 0 to 1, and how far along the line, mm."""

    place: Array
    normal: Array
    line: Index
    element: Index
    share: Array
    way: Array


class HalfSurface:
    """`section`: closed contours (z, r), mm, the material to their left. `lines` are those without what lies on the axis,
    `origins` (k,) for each line which contour and which element its elements were, (k, 2)."""

    def __init__(self, section: Sequence[Contour]) -> None:
        self.region = Region(tuple(section))
        found = [each for k, loop in enumerate(section) for each in _off_axis(k, loop)]
        self.lines = [line for line, _ in found]
        self.origins = [origin for _, origin in found]

    def contains(self, points: Array) -> Mask:
        """Whether points (m, 2) lie in the material; those on the axis, too."""
        spots = np.stack([points[:, 0], np.maximum(points[:, 1], BESIDE)], axis=1)
        return np.asarray(self.region.contains(spots))

    def distance(self, points: Array) -> Array:
        """Signed distance of points (m, 2), negative in the material; far away where there is no surface."""
        away = np.min([np.full(len(points), 1e9), *(line.distance(points) for line in self.lines)], axis=0)
        return np.where(self.contains(points), -away, away)

    def feet(self, points: Array) -> Array:
        """The place of the surface nearest to each point (m, 2)."""
        feet = np.stack([line.nearest_points(points) for line in self.lines])
        nearest = np.hypot(*(feet - points).transpose(2, 0, 1)).argmin(axis=0)
        return np.asarray(feet[nearest, np.arange(len(points))])

    def places(self, spacing: float, aside: float = 0.0) -> Places:
        """Places on all elements, about so many mm apart; `aside` (mm) from their ends, which are places themselves at 0."""
        found: list[Places] = []
        for number, line in enumerate(self.lines):
            lengths = line.lengths
            count = np.maximum(np.ceil(lengths / spacing), np.ceil(np.abs(line.sweeps) / TURN)).astype(int)
            count = np.maximum(count, FEWEST)
            element = np.repeat(np.arange(len(count)), count)
            rank = np.arange(len(element)) - np.repeat(np.cumsum(count) - count, count)
            hair = np.minimum(aside / np.maximum(lengths, AXIS), 0.01)[element]
            share = hair + (1 - 2 * hair) * rank / (count[element] - 1)
            found.append(self.at(number, element, share))
        return Places(*(np.concatenate(column) for column in zip(*found))) if found else _none()

    def at(self, line: int, element: Index, share: Array) -> Places:
        """Places on elements of a line, at shares (m,) of them."""
        lengths = self.lines[line].lengths
        way = (np.cumsum(lengths) - lengths)[element] + share * lengths[element]
        spots, ahead = self.lines[line].point_at(np.minimum(way, np.nextafter(lengths.sum(), 0)))
        return Places(spots, -left(ahead), np.full(len(element), line), element, share, way)

    @cached_property
    def _elements(self) -> tuple[Floats, ...]:
        names = ("starts", "ends", "sweeps", "centres", "radii")
        return tuple(np.concatenate([getattr(line, name) for line in self.lines]) for name in names)

    def ways_out(self, origin: Array, ahead: Array) -> Array:
        """How far along lines (m, 2) through places, both ways, the material ends nearest (m,): where one comes out of it.

        From within the material it is the next end ahead, from outside the last one behind; nan where there is none.
        """
        if not self.lines:
            return np.full(len(origin), np.nan)
        some = max(CHUNK // len(self._elements[0]), 1)
        parts = range(0, max(len(origin), 1), some)
        return np.concatenate([self._ways_out(origin[k : k + some], ahead[k : k + some]) for k in parts])

    def _ways_out(self, origin: Array, ahead: Array) -> Array:
        starts, ends, sweeps, centres, radii = self._elements
        straight = sweeps == 0
        chord = (ends - starts)[None]
        way, spot = ahead[:, None], origin[:, None]
        with np.errstate(divide="ignore", invalid="ignore"):
            det = way[..., 0] * chord[..., 1] - way[..., 1] * chord[..., 0]
            gap = starts - spot
            t = (gap[..., 0] * chord[..., 1] - gap[..., 1] * chord[..., 0]) / det
            s = (gap[..., 0] * way[..., 1] - gap[..., 1] * way[..., 0]) / det
            room = AXIS / np.hypot(*chord[0].T)
            out = np.where(straight & (s >= -room) & (s <= 1 + room) & (det > 0), t, np.nan)  # out of what lies to the left
            found = [out]
            arm = spot - centres
            half = (arm * way).sum(axis=2)
            root = np.sqrt(half**2 - (arm**2).sum(axis=2) + radii**2)
            for t in (-half - root, -half + root):
                out_of = spot + t[..., None] * way - centres
                first = starts - centres
                angle = np.arctan2(_cross(first, out_of), (first * out_of).sum(axis=2))
                back = (np.sign(angle) != np.sign(sweeps)) & (np.abs(angle) > 1e-9)
                angle = np.where(back, angle + 2 * np.pi * np.sign(sweeps), angle)
                on = ~straight & (np.abs(angle) <= np.abs(sweeps) + 1e-9)
                leaving = np.sign(sweeps) * (out_of * way).sum(axis=2) >= 0  # material is inside arcs that turn left
                found.append(np.where(on & leaving, t, np.nan))
        every = np.concatenate(found, axis=1)
        inside = self.contains(origin)
        ahead_ = np.where(every >= -BESIDE, every, np.inf).min(axis=1)
        behind = np.where(every <= BESIDE, every, -np.inf).max(axis=1)
        chosen = np.where(inside | (np.abs(ahead_) <= BESIDE), ahead_, behind)
        return np.where(np.isfinite(chosen), chosen, np.nan)


def _off_axis(number: int, loop: Contour) -> Iterator[tuple[Contour, Index]]:
    """The pieces of a closed contour between its lines on the axis, and which elements of it they are (k, 2)."""
    on = (np.maximum(loop.starts[:, 1], loop.ends[:, 1]) <= AXIS) & (loop.sweeps == 0)
    count = len(on)
    if not on.any():
        yield loop, np.stack([np.full(count, number), np.arange(count)], axis=1)
        return
    first = int(on.argmax())
    run: list[int] = []
    for k in [*((first + 1 + np.arange(count)) % count).tolist()]:
        if not on[k]:
            run.append(k)
            continue
        if run:
            points = np.vstack([loop.points[run], loop.ends[run[-1]]])
            yield Contour(points, np.append(loop.bulge[run], 0.0), closed=False), np.array([(number, each) for each in run])
        run = []


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def _none() -> Places:
    none, whole = np.zeros(0), np.zeros(0, dtype=np.int64)
    return Places(np.zeros((0, 2)), np.zeros((0, 2)), whole, whole, none, none)
