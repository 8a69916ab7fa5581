"""What a turned part is compared with: a half section, and of a design which feature made a place of it.

Its surface has places, distances and rays that meet it; the worst of them are narrowed down to a true maximum.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np

from mnclab.design.model.shapes import on_elements, spread, stretches
from mnclab.design.model.turned_design import TurnedDesign
from mnclab.design.model.turned_threads import Thread
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array, Index, Mask
from mnclab.text.alarm import Alarm

SAME = 1e-6  # mm: a place on what a feature takes away is its
PROFILE = "profile"


class HalfTarget:
    """`section`: closed contours (z, r), mm; `error` mm: how far they may be off. Of a design also its features and `bands`,
    areas in which threads have their teeth: there nothing is judged."""

    def __init__(self, name: str, section: Sequence[Contour], error: float = 0.0, design: TurnedDesign | None = None) -> None:
        if not section:
            raise Alarm(f"{name} has no material to compare with")
        self.name, self.error, self.design = name, error, design
        self.surface = HalfSurface(section)

    @property
    def section(self) -> tuple[Contour, ...]:
        return self.surface.region.loops

    @property
    def ends(self) -> tuple[float, float]:
        """The lowest and the highest z."""
        (low, _), (high, _) = self.surface.region.bounds.tolist()
        return low, high

    @property
    def bounds_3d(self) -> Array:
        """The box (2, 3) of the half section: from the axis out, about x = 0."""
        (low, _), (high, radius) = self.surface.region.bounds.tolist()
        return np.array([(0.0, 0.0, low), (radius, 0.0, high)])

    @cached_property
    def names(self) -> tuple[str, ...]:
        """The profile and the features."""
        return (PROFILE, *self.design.drawn_names()) if self.design else (self.name,)

    @cached_property
    def bands(self) -> list[Region]:
        return [_band(self.design, each) for each in self.design.threads] if self.design else []

    @cached_property
    def core(self) -> HalfSurface:
        """What no tooth of a thread may go below."""
        return HalfSurface(self.surface.region.without(self.bands).loops) if self.bands else self.surface

    def toothed(self, points: Array) -> Mask:
        """Which points (m, 2) lie where a thread has its teeth."""
        found = np.zeros(len(points), dtype=bool)
        for band in self.bands:
            found |= band.contains(points) | (band.distance(points) <= SAME)
        return found

    def owners(self, points: Array) -> Index:
        """Whose face, by the numbers of `names`, is nearest to each of the points (m, 2)."""
        found = np.zeros(len(points), dtype=np.int64)
        if self.design is None or not len(points):
            return found
        feet = self.surface.feet(points)
        for number, cut in enumerate(self._cuts, 1):
            if cut is not None:
                found[cut.distance(feet) <= SAME] = number
        return found

    @cached_property
    def _cuts(self) -> list[Contour | None]:
        """What each feature takes away."""
        if self.design is None:
            return []
        return [each.cut(body) for each, body in zip(self.design.features, self.design.bodies)]

    def allowed(self, owner: int, tolerance: float) -> float:
        """How far faces may be off, mm: the tolerance, or as far as the drawing gives for them."""
        if self.design is None:
            return tolerance
        given = self.design.measures() if owner == 0 else self.design.features[owner - 1].measures()
        wide = [max(map(abs, m.limits)) / (2 if m.kind == "diameter" else 1) for m in given if m.limits and m.kind != "angle"]
        return max([tolerance, *wide])


def _band(design: TurnedDesign, thread: Thread) -> Region:
    """Where a thread has its teeth; half a tooth goes on beyond its ends, where nothing stands in its way."""
    low, high = thread.band
    body, half = design.bodies[-1], thread.pitch / 2
    ends = []
    for place, way in ((thread.start, half), (thread.end, -half)):
        at = np.array([place + way / 2])
        clear = body.outer(at)[0] <= high + SAME if not thread.inside else body.inner(at)[0] >= low - SAME
        ends.append(place + way if clear else place)
    front, back = ends
    return Region((Contour([(back, low), (front, low), (front, high), (back, high)]),))


# Its surface: the half section without the lines on the axis; places on it, distances, rays that meet it.

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
    """`section`: closed contours (z, r), mm, the material to their left. `lines` are those without what lies on the axis."""

    def __init__(self, section: Sequence[Contour]) -> None:
        self.region = Region(tuple(section))
        self.lines = [line for loop in section for line in _off_axis(loop)]

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
            found.append(self.at(number, *spread(line, spacing, FEWEST, TURN, aside)))
        return Places(*(np.concatenate(column) for column in zip(*found))) if found else _none()

    def at(self, line: int, element: Index, share: Array) -> Places:
        """Places on elements of a line, at shares (m,) of them."""
        way, spots, aside = on_elements(self.lines[line], element, share)
        return Places(spots, -aside, np.full(len(element), line), element, share, way)

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


def _off_axis(loop: Contour) -> Iterator[Contour]:
    """The pieces of a closed contour between its lines on the axis."""
    on = (np.maximum(loop.starts[:, 1], loop.ends[:, 1]) <= AXIS) & (loop.sweeps == 0)
    return stretches(loop, ~on)


def _cross(a: Array, b: Array) -> Array:
    return np.asarray(a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0])


def _none() -> Places:
    none, whole = np.zeros(0), np.zeros(0, dtype=np.int64)
    return Places(np.zeros((0, 2)), np.zeros((0, 2)), whole, whole, none, none)


# The true maximum of a distance along a surface and within an area, not only at the places that were looked at.

GOLDEN = (np.sqrt(5) - 1) / 2
ROUNDS = 60  # a bracket shrinks to 3e-13 of itself
MOST = 200  # brackets that are narrowed down
GRID = 40  # places across an area
LEAST = 1e-6  # mm: less is no gain

Distance = Callable[[Array], Array]


def narrowed(surface: HalfSurface, at: Places, value: Array, group: Index, distance: Distance) -> tuple[Array, Array]:
    """Places (k, 2) on a surface where a distance is greatest between those that were looked at, and how far (k,).

    It changes by no more than the way: only where it is greater than the greatest of a group (m,) less a step can a greater
    one lie.
    """
    if not len(value):
        return np.zeros((0, 2)), np.zeros(0)
    same = (np.diff(at.element) == 0) & (np.diff(at.line) == 0)
    before, after = np.append(False, same), np.append(same, False)
    peak = (~before | (value >= np.roll(value, 1))) & (~after | (value >= np.roll(value, -1)))
    gap = np.where(after, np.roll(at.way, -1) - at.way, np.where(before, at.way - np.roll(at.way, 1), 0.0))
    most = np.zeros(int(group.max()) + 1)
    np.maximum.at(most, group, value)
    some = np.flatnonzero(peak & (value > 0) & (value >= most[group] - gap))
    some = some[np.argsort(-value[some], kind="stable")][:MOST]
    low = np.where(before[some], at.share[some - 1], at.share[some])
    high = np.where(after[some], at.share[(some + 1) % len(value)], at.share[some])

    def look(share: Array) -> tuple[Array, Array]:
        spots = np.empty((len(some), 2))
        for line in np.unique(at.line[some]):
            mine = at.line[some] == line
            spots[mine] = surface.at(int(line), at.element[some[mine]], share[mine]).place
        return spots, distance(spots)

    one, other = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
    at_one, at_other = look(one)[1], look(other)[1]
    for _ in range(ROUNDS):
        right = at_one < at_other
        low, high = np.where(right, one, low), np.where(right, high, other)
        fresh = np.where(right, low + GOLDEN * (high - low), high - GOLDEN * (high - low))
        found = look(fresh)[1]
        one, other = np.where(right, other, fresh), np.where(right, fresh, one)
        at_one, at_other = np.where(right, at_other, found), np.where(right, found, at_one)
    return look((low + high) / 2)


def deepest(region: Region, distance: Distance, least: float) -> tuple[Array, float] | None:
    """The place within an area where a distance is greatest, if that is more than `least`; None if it is not."""
    best: tuple[Array, float] | None = None
    for part in region.parts:
        low, high = part.bounds
        x, y = (a + (np.arange(GRID) + 0.5) / GRID * (b - a) for a, b in zip(low, high))
        spots = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
        spots = spots[part.contains(spots)]
        if not len(spots):
            continue
        value = distance(spots)
        k = int(value.argmax())
        place, found, step = spots[k], float(value[k]), float((high - low).max()) / GRID
        ring = np.array([(np.cos(a), np.sin(a)) for a in np.arange(16) * np.pi / 8])
        while step > LEAST**2 and found + 2 * step > (best[1] if best else least):
            around = place + step * ring
            around = around[part.contains(around)]
            there = distance(around) if len(around) else np.full(1, -np.inf)
            if there.max() > found + 1e-13:
                place, found = around[there.argmax()], float(there.max())
            else:
                step /= 2
        if found > (best[1] if best else least) + LEAST:
            best = place, found
    return best
