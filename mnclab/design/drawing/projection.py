"""A part as one sees it from the front, or cut, and from above: its edges and cut faces, from the level slabs that it is made of.

Within an upright slab nothing changes with the height, so what one sees of it from the front is a function of u, the
coordinate to the right: the nearest piece of the contour of its region, at the depth w, or a cut face, or nothing. Upright
lines stand where that function jumps or bends, level ones where it differs from one slab to the next. Sloped slabs are
looked at in several heights, whose lines are joined. From above one sees the edges that nothing above covers. mm.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.design.model.removals import Bevel, Sloped
from mnclab.design.model.shapes import stretches
from mnclab.design.model.slabs import Slab, Stack
from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region, Where, joined, where

SAME = 1e-6  # mm, within which two places are one
LEAN = 1e-3  # within which two slopes are one
NOTHING, CUT = -2, -1  # what is seen, if not the piece of a contour
INSIDE = 1e-3  # of a slanting slab, how far from its ends it is looked at: there a cone may have no section
STEEP = 0.02  # of a slanting slab, over which faces are followed to its ends; rad, within which two of them go on as one
HEIGHTS = 13  # at which a slanting slab is looked at whose edges are curves


class Step(NamedTuple):
    """A piece of a cutting plane: from u to u at the depth w."""

    begin: float
    end: float
    depth: float


class Seen(NamedTuple):
    """What is seen at one height: between `places` (n + 1,) u the `labels` (n,), and the `pieces` (n, 7) of faces."""

    places: Floats
    labels: NDArray[np.intp]
    pieces: Floats

    def edges(self) -> list[float]:
        """The u of upright lines."""
        if not len(self.labels):
            return []
        kind = np.minimum(self.labels, 0)
        before, after = np.append(NOTHING, kind), np.append(kind, NOTHING)
        jump, bend = np.zeros(len(before)), np.zeros(len(before))
        first, last, inner = self.pieces[:-1], self.pieces[1:], self.places[1:-1]
        jump[1:-1] = _depth(first, inner) - _depth(last, inner)
        bend[1:-1] = _lean(first, inner) - _lean(last, inner)
        face = (before == 0) & (after == 0) & ((np.abs(jump) > SAME) | (np.abs(bend) > LEAN))
        return [float(u) for u in self.places[(before != after) | face]]

    def ends(self) -> Floats:
        """The depths of the pieces at their left and right ends, (n, 2); infinite where there is no face."""
        depths = np.stack([_depth(self.pieces, self.places[:-1]), _depth(self.pieces, self.places[1:])], axis=1)
        return np.where(self.labels[:, None] >= 0, depths, np.inf)

    def cuts(self) -> list[tuple[float, float]]:
        """Stretches of u that are cut."""
        found: list[tuple[float, float]] = []
        for a, b, label in zip(self.places[:-1].tolist(), self.places[1:].tolist(), self.labels.tolist(), strict=True):
            if label == CUT:
                found[-1:] = [(found[-1][0], b)] if found and abs(found[-1][1] - a) < SAME else [*found[-1:], (a, b)]
        return found


Layer = tuple[Floats, list[Seen]]  # heights of a slab, and what is seen there


def look(region: Region, steps: Sequence[Step] = ()) -> Seen:
    """What one sees of a region in the direction of its second coordinate; with `steps` all before these is cut away."""
    pieces = np.array([row for loop in region.loops for row in _pieces(loop)]).reshape(-1, 7)
    if not len(pieces):
        return Seen(np.zeros(0), np.zeros(0, dtype=np.intp), np.zeros((0, 7)))
    places = [*pieces[:, 0], *pieces[:, 1]]
    for step in steps:
        places += [step.begin, step.end, *_crossings(pieces, step)]
    u = np.sort(np.array(places))
    u = u[(u >= pieces[:, 0].min()) & (u <= pieces[:, 1].max())]
    u = u[np.append(True, np.diff(u) > SAME)]
    middle = (u[1:] + u[:-1]) / 2
    depths = _depth(pieces[:, None], middle)
    here = (pieces[:, None, 0] < middle) & (middle < pieces[:, None, 1])
    plane = np.full(len(middle), -np.inf)
    for step in steps:
        plane[(step.begin <= middle) & (middle <= step.end)] = step.depth
    cut = ((here & (depths < plane)).sum(axis=0) % 2) == 1
    depths = np.where(here & (depths >= plane), depths, np.inf)
    labels = np.where(np.isfinite(depths.min(axis=0)), depths.argmin(axis=0), NOTHING)
    labels[cut] = CUT
    return Seen(u, labels, pieces[np.maximum(labels, 0)])


def _pieces(loop: Contour) -> Iterator[tuple[float, ...]]:
    """Pieces that are functions of u: (begin, end, depth at both, centre u and w, ± radius; 0 a line)."""
    for (u0, w0), (u1, w1), sweep, (cu, cw), r in zip(
        loop.starts.tolist(), loop.ends.tolist(), loop.sweeps.tolist(), loop.centres.tolist(), loop.radii.tolist(), strict=True
    ):
        if sweep == 0:
            if abs(u1 - u0) > SAME:
                (a, wa), (b, wb) = sorted([(u0, w0), (u1, w1)])
                yield a, b, wa, wb, 0.0, 0.0, 0.0
            continue
        first = np.arctan2(w0 - cw, u0 - cu)
        low, high = min(first, first + sweep), max(first, first + sweep)
        turns = [k * np.pi for k in range(int(np.ceil(low / np.pi)), int(np.floor(high / np.pi)) + 1)]
        stops = [low, *(t for t in turns if low + 1e-9 < t < high - 1e-9), high]
        for s, e in zip(stops[:-1], stops[1:], strict=True):
            a, b = sorted((cu + r * float(np.cos(s)), cu + r * float(np.cos(e))))
            if b - a > SAME:
                side = 1.0 if np.sin((s + e) / 2) > 0 else -1.0
                yield a, b, 0.0, 0.0, cu, cw, side * r


def _depth(pieces: Floats, u: Floats) -> Floats:
    """The depths of pieces (…, 7) at u."""
    a, b, wa, wb, cu, cw, r = np.moveaxis(pieces, -1, 0)
    bent = cw + np.sign(r) * np.sqrt(np.maximum(r * r - (u - cu) ** 2, 0.0))
    return np.asarray(np.where(r == 0, wa + (wb - wa) * (u - a) / (b - a), bent))


def _lean(pieces: Floats, u: Floats) -> Floats:
    """The directions of pieces (m, 7) at u (m,), rad."""
    a, b, wa, wb, cu, cw, r = pieces.T
    rise = np.sqrt(np.maximum(r * r - (u - cu) ** 2, 0.0))
    return np.asarray(np.where(r == 0, np.arctan2(wb - wa, b - a), np.arctan2(-np.sign(r) * (u - cu), rise)))


def _crossings(pieces: Floats, step: Step) -> list[float]:
    """Where a plane meets the pieces."""
    a, b, wa, wb, cu, cw, r = pieces.T
    with np.errstate(divide="ignore", invalid="ignore"):
        straight = a + (step.depth - wa) / (wb - wa) * (b - a)
        half = np.sqrt(r * r - (step.depth - cw) ** 2)
    found = []
    for at, of in ((straight, r == 0), (cu - half, r != 0), (cu + half, r != 0)):
        inner = of & (at > a) & (at < b)
        on = np.abs(_depth(pieces[inner], at[inner]) - step.depth) < SAME
        found += at[inner][on].tolist()
    return found


@dataclass(frozen=True)
class Elevation:
    """A stack as it is seen in the direction of w: (x, y) of the part are turned into (u, w) by `turn` (3, 3)."""

    levels: Levels
    turn: Floats
    steps: tuple[Step, ...] = ()

    @cached_property
    def _layers(self) -> list[Layer]:
        """The heights at which each slab is looked at, from below, and what is seen there."""
        found = []
        for slab in self.levels.slabs:
            middle = (slab.low + slab.high) / 2
            if not slab.slants:
                found.append((np.array([slab.low, slab.high]), [self._look(slab, middle)] * 2))
                continue
            ends = np.array([INSIDE, STEEP, 0.5, 1 - STEEP, 1 - INSIDE])
            heights = slab.low + ends * (slab.high - slab.low)
            seen = [self._look(slab, float(z)) for z in heights]
            rows = [np.array(each.edges()) for each in seen]
            if len({len(row) for row in rows}) > 1 or np.abs(rows[0] + rows[-1] - 2 * rows[2]).max(initial=0.0) > SAME:
                inner = np.linspace(heights[0], heights[-1], HEIGHTS)[1:-1]
                heights = np.concatenate([heights[:2], inner, heights[-2:]])
                seen = [*seen[:2], *(self._look(slab, float(z)) for z in inner), *seen[-2:]]
            found.append((heights, seen))
        return found

    def _look(self, slab: Slab, z: float) -> Seen:
        region = self.levels.section(slab, z)
        return look(Region(tuple(loop.transformed(self.turn) for loop in region.loops)), self.steps)

    def lines(self) -> list[Contour]:
        """Visible edges, in (u, z)."""
        upright: dict[float, list[tuple[float, float]]] = {}
        level: list[tuple[float, float, float]] = []
        found: list[Contour] = []
        for slab, (heights, seen) in zip(self.levels.slabs, self._layers, strict=True):
            if not slab.slants:
                for u in seen[0].edges():
                    near = next((known for known in upright if abs(known - u) < SAME), u)
                    upright.setdefault(near, []).append((slab.low, slab.high))
            else:
                found += _slanting(slab, heights, seen)
        before: Layer | None = None
        for slab, layer in zip(self.levels.slabs, self._layers, strict=True):
            level += [(slab.low, *stretch) for stretch in _differing(before, layer, slab.low)]
            before = layer
        level += [(self.levels.slabs[-1].high, *stretch) for stretch in _differing(before, None, self.levels.slabs[-1].high)]
        found += [Contour([(u, a), (u, b)], closed=False) for u, spans in upright.items() for a, b in _joined(spans)]
        found += [Contour([(a, z), (b, z)], closed=False) for z, a, b in level]
        return found

    def faces(self) -> tuple[Region, ...]:
        """The cut faces, in (u, z)."""
        areas = []
        for slab, (heights, seen) in zip(self.levels.slabs, self._layers, strict=True):
            z = heights.copy()
            z[0], z[-1] = slab.low, slab.high
            rows = [np.array(each.cuts()).reshape(-1, 2) for each in seen]
            for (a, b), (first, last) in zip(zip(z[:-1], z[1:]), zip(rows[:-1], rows[1:]), strict=True):
                if len(first) != len(last):
                    first = last = min(first, last, key=len)
                for (u0, u1), (v0, v1) in zip(first, last, strict=True):
                    areas.append(shapely.Polygon([(u0, a), (u1, a), (v1, b), (v0, b)]))
        whole = shapely.simplify(shapely.union_all(areas, grid_size=1e-6), 1e-6)
        parts = shapely.get_parts(shapely.get_parts(whole))
        rings = [[part.exterior, *part.interiors] for part in parts if part.geom_type == "Polygon" and not part.is_empty]
        return tuple(Region(tuple(_loop(ring, k == 0) for k, ring in enumerate(each))) for each in rings)


def _loop(ring: object, outer: bool) -> Contour:
    contour = Contour(shapely.get_coordinates(ring)[:-1])
    return contour if (contour.area > 0) == outer else contour.reversed()


def _slanting(slab: Slab, heights: Floats, seen: Sequence[Seen]) -> Iterator[Contour]:
    """Lines through the edges at several heights, as long as there are as many of them; straight ones of two points."""
    rows = [np.array(each.edges()) for each in seen]
    first = 0
    for k in range(1, len(rows) + 1):
        if k < len(rows) and len(rows[k]) == len(rows[first]):
            continue
        stretch, z = np.array(rows[first:k]), heights[first:k].copy()
        if len(z) > 1 and stretch.size:
            if first == 0:
                stretch[0] -= (stretch[1] - stretch[0]) * (z[0] - slab.low) / (z[1] - z[0])
                z[0] = slab.low
            if k == len(rows):
                stretch[-1] += (stretch[-1] - stretch[-2]) * (slab.high - z[-1]) / (z[-1] - z[-2])
                z[-1] = slab.high
            for line in stretch.T:
                points = np.stack([line, z], axis=1)
                straight = np.abs(line - np.interp(z, z[[0, -1]], line[[0, -1]])).max() < SAME
                yield Contour(points[[0, -1]] if straight else points, closed=False)
        first = k


def _differing(below: Layer | None, above: Layer | None, z: float) -> list[tuple[float, float]]:
    """Stretches of u where what is seen is not one face below and above the height z."""
    sides = [side for side in (below and (below, -1), above and (above, 0)) if side]
    maps = [layer[1][end] for layer, end in sides]
    u = np.sort(np.concatenate([seen.places for seen in maps]))
    if not len(u):
        return []
    u = u[np.append(True, np.diff(u) > SAME)]
    middle = (u[1:] + u[:-1]) / 2
    looks = [_at(layer, end, middle, z) for layer, end in sides]
    if len(looks) == 1:
        looks.append((np.full(len(middle), NOTHING), np.full(len(middle), np.inf), np.zeros(len(middle))))
    (kind, depth, slope), (other, far, lean) = looks
    with np.errstate(invalid="ignore"):
        bent = np.abs(np.arctan(slope) - np.arctan(lean)) > STEEP
        face = (kind == 0) & (other == 0) & ((np.abs(depth - far) > 10 * SAME) | bent)
    stretches = [(a, b) for a, b, line in zip(u[:-1].tolist(), u[1:].tolist(), ((kind != other) | face).tolist()) if line]
    return _joined(stretches)


def _at(layer: Layer, end: int, u: Floats, z: float) -> tuple[Floats, Floats, Floats]:
    """Kind, depth and slope (depth over height) of what is seen at u, at the end z of a layer."""
    heights, seen = layer
    kind, depth = _sampled(seen[end], u)
    if seen[0] is seen[-1]:
        return kind, depth, np.zeros(len(u))
    inner = 1 if end == 0 else -2
    _, next_to = _sampled(seen[inner], u)
    with np.errstate(invalid="ignore"):
        slope = (depth - next_to) / (heights[end] - heights[inner])
    slope = np.where(np.isfinite(slope), slope, 1.0)
    return kind, depth + slope * (z - heights[end]), slope


def _sampled(seen: Seen, u: Floats) -> tuple[Floats, Floats]:
    if not len(seen.labels):
        return np.full(len(u), NOTHING), np.full(len(u), np.inf)
    k = np.searchsorted(seen.places, u) - 1
    on = (k >= 0) & (k < len(seen.labels))
    k = np.clip(k, 0, len(seen.labels) - 1)
    kind = np.where(on, np.minimum(seen.labels[k], 0), NOTHING)
    return kind, np.where(kind == 0, _depth(seen.pieces[k], u), np.inf)


def _joined(spans: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Stretches one after the other, those that meet made one."""
    found: list[tuple[float, float]] = []
    for a, b in sorted(spans):
        if found and a <= found[-1][1] + SAME:
            found[-1] = (found[-1][0], max(b, found[-1][1]))
        else:
            found.append((a, b))
    return found


@dataclass(frozen=True, eq=False)
class Levels:
    """A stack of slabs; `nested` where no section has material above that a lower one lacks."""

    stack: Stack
    nested: bool = False
    known: dict[tuple[int, float], Region] = field(default_factory=dict)

    @property
    def slabs(self) -> tuple[Slab, ...]:
        return self.stack.slabs

    def section(self, slab: Slab, z: float) -> Region:
        if not slab.slants:
            return slab.region
        key = id(slab), z
        if key not in self.known:
            self.known[key] = slab.section(z)
        return self.known[key]


# From above, or from below: the edges of each level that nothing nearer covers.

NEAR = 1e-6  # mm, within which a line lies on another
SPOTS = np.array([0.02, *np.arange(1, 40) / 40, 0.98])  # of an element, by which is told whether all of it does
SHARP = 1e-3  # rad, of a corner
LONGEST = 4.0  # a mitre line against the width of its chamfer
EMPTY = Region(())


def edges_from_above(levels: Levels, below: bool = False) -> list[Contour]:
    """Visible edges in (x, y), lines and arcs as they are: whole loops where all of one is seen; or those seen from below."""
    found = [line for z, loop in _seen(levels, below) for line in _not_within(levels, z, loop)]
    return [*found, *_mitres(levels, below)]


def _sections(levels: Levels, below: bool) -> Iterator[tuple[float, Region]]:
    """Sections from above down, or from below up."""
    for slab in levels.slabs if below else reversed(levels.slabs):
        ends = (slab.low, slab.high) if below else (slab.high, slab.low)
        for z in ends if slab.slants else ends[:1]:
            yield z, levels.section(slab, z)


def _more(levels: Levels, covered: Region, section: Region) -> Region:
    if not covered.loops or not section.loops:
        return section if section.loops else covered
    return section if levels.nested else joined(covered, section)


def _seen(levels: Levels, below: bool) -> Iterator[tuple[float, Contour]]:
    covered = EMPTY
    for z, section in _sections(levels, below):
        if not section.loops:
            continue
        if not covered.loops:
            yield from ((z, loop) for loop in section.loops)
            covered = section
            continue
        yield from ((z, line) for line in _beside(levels, section, covered))
        covered = _more(levels, covered, section)


def _beside(levels: Levels, section: Region, covered: Region) -> Iterator[Contour]:
    """The edges of a section that are not below what covers it, nor on the edge of that."""
    places = [(loop, where(loop, covered)) for loop in section.loops]
    if any(place is Where.ACROSS for _, place in places) and not levels.nested:
        places = [(loop, Where.ACROSS) for loop in section.difference(covered).loops]
    for loop, place in places:
        if place is Where.ACROSS:
            yield from _off(loop, covered)
        elif place is Where.OUTSIDE:
            yield loop


def _mitres(levels: Levels, below: bool) -> Iterator[Contour]:
    """Where two slanting faces meet: lines from the corners of the upper edge to those of the lower one."""
    for slab in levels.slabs:
        for each in slab.slants:
            if isinstance(each, Bevel) and each.up != below:
                upper, lower = (_corners(levels.section(slab, z), each, z) for z in (slab.high, slab.low))
                wide = abs(each.at(slab.high) - each.at(slab.low))
                for corner in upper:
                    off = np.hypot(*(lower - corner).T)
                    if len(off) and off.min() < LONGEST * wide:
                        yield Contour([corner, lower[off.argmin()]], closed=False)


def _corners(section: Region, slant: Sloped, z: float) -> Floats:
    """Sharp corners (n, 2) of a section that lie on a slanting face."""
    spots = [loop.starts[np.abs(loop.turns()) > SHARP] for loop in section.loops]
    found = np.concatenate([np.zeros((0, 2)), *spots])
    return np.asarray(found[np.abs(slant.away(*found.T) - slant.at(z)) < NEAR])


def _not_within(levels: Levels, z: float, line: Contour) -> Iterator[Contour]:
    """The stretches of a line at a height that are edges: not those in the middle of a slanting face."""
    slants = {id(each): each for slab in levels.slabs for each in slab.slants if each.low + NEAR < z < each.high - NEAR}
    if not slants:
        yield line
        return
    x, y = _spots(line).T
    within = np.zeros(len(x), dtype=bool)
    for each in slants.values():
        within |= np.abs(each.away(x, y) - each.at(z)) < NEAR
    yield from _stretches(line, np.logical_not(within).reshape(-1, len(SPOTS)))


def _off(loop: Contour, covered: Region) -> Iterator[Contour]:
    """The stretches of a loop that are not on the edge of what is above: that is drawn already."""
    off = covered.distance(_spots(loop)) >= NEAR
    return _stretches(loop, off.reshape(-1, len(SPOTS)))


def _spots(line: Contour) -> Floats:
    """Places on every element, `(m * len(SPOTS), 2)`."""
    ways = (np.cumsum(line.lengths) - line.lengths)[:, None] + line.lengths[:, None] * SPOTS
    return line.point_at(ways.ravel())[0]


def _stretches(line: Contour, spots: NDArray[np.bool_]) -> Iterator[Contour]:
    """The elements of which some spots (m, len(SPOTS)) are shown, those that follow each other as one."""
    return stretches(line, np.asarray(spots.any(axis=1)))
