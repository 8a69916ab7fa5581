"""Fronts in a piece of material, and the passes beyond them whose engagement a limit bounds. Lengths in mm, angles in rad.

A *front* is the boundary of K, the places of the tool centre that are cleared, towards the others. The next pass lies d(l)
beyond it along its normals. At a front of the radius r, round which the rim came to r + R,

    cos ψ = ((r + R)² - (r + d)² - R²) / (2·(r + d)·R)          straight: cos ψ = 1 - d/R

is the engagement ahead of the normal; a pass that leaves the front at an angle β, tan β = d', has β more. So the longest step
into the material is d' = tan(φ - ψ(d)), until ψ = φ or the wall is reached. What else there is on the rim is measured along the
pass and put right. In the code R is the radius of the tool, b, n, r are places, normals and radii of a front.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mnclab.geometry import shapely
from mnclab.geometry.biarcs import evened
from mnclab.geometry.curves import Floats, length_of

FINE = 10  # places on a front to a tool radius
MARGIN = math.radians(1.0)  # that a pass keeps from the limit
GENTLE = math.radians(6)  # more, where it begins, until it is a radius on
ROUNDS = 4  # of putting a pass right
TRIM = 0.25  # of the stepover: what a pass may leave along a wall at its end
SLIVER = 0.015  # of the radius: what is narrower is none
FLATTEST = 1e6  # times the radius
WINDOW, HALVINGS = math.radians(24), 7  # about the limit, in which the engagement of a pass is measured
GRID = 1e-5  # mm, on which areas are cut: never in doubt on which side a place lies
MET = 0.05  # of the stepover: so far from what is cleared a pass begins and ends
STEEPEST = 1.2  # rad, between a pass and its front
FINER = 4  # steps from place to place
BLUNT = (0.7, 0.5, 0.35, 0.25, 0.15, 0.1)  # of the radius: what the corner of a pass is rounded with, the first that leaves most


class Fronts:
    """What is left of an area of tool centres, and the passes that have been taken."""

    def __init__(self, area: Any, soft: Any, radius: float, stepover: float, stock: Any = None) -> None:
        self.area, self.soft, self.radius, self.stepover, self.stock = area, soft, radius, stepover, stock
        self.phi = math.acos(1 - stepover / radius) - MARGIN
        self.rest: list[Any] = []
        self.before: list[Any] = []  # what was left before the last passes
        self.edge = shapely.boundary(area)
        self.dead: set[tuple[float, ...]] = set()  # fronts beyond which there is nothing to cut
        shapely.prepare(self.edge)

    def passes(self, cleared: Any, start: Floats) -> Iterator[Floats]:
        """Pass after pass (n, 2), each the one that begins nearest to the end of the last."""
        self._keep(difference(self.area, cleared), [])
        while self.rest:
            fronts = [(length_of(line[0] - start), k, line) for k, piece in enumerate(self.rest) for line in self._fronts(piece)]
            fronts = [each for each in fronts if (*each[2][0], *each[2][-1]) not in self.dead]
            if not fronts:
                break
            _, k, line = min(fronts, key=lambda each: each[:2])
            self.before = self.rest
            found = self._advance(line)
            if not found:  # the rim has been everywhere there, or nothing broader than a sliver is left
                self.dead.add((*line[0], *line[-1]))
                self.rest = [piece for piece in self.rest if piece is not self.rest[k] or piece.area > self.radius**2 / 10]
            for way in found:
                yield way
                start = way[-1]

    def clear(self, a: Floats, b: Floats) -> bool:
        """Whether nothing stood straight between two places before the last passes."""
        way = shapely.LineString([a, b])
        return all(shapely.intersection(way, piece).length < 0.02 * self.radius for piece in self.before)

    def _keep(self, more: Any, kept: list[Any]) -> None:
        thin = SLIVER * self.radius
        self.rest = kept + [
            piece for piece in shapely.get_parts(more)
            if piece.area > 50 * thin**2 and not shapely.is_empty(shapely.buffer(piece, -thin, quad_segs=2))
        ]  # fmt: skip

    def _fronts(self, piece: Any) -> Iterator[Floats]:
        """The boundaries of a piece of material towards what is cleared, that on the left."""
        for k, ring in enumerate((piece.exterior, *piece.interiors)):
            points = shapely.get_coordinates(ring)
            points = points[::-1] if shapely.is_ccw(ring) == (k == 0) else points
            free = ~shapely.dwithin(self.edge, shapely.points((points[1:] + points[:-1]) / 2), 1e-4 * self.radius)
            if free.all():
                yield points
                continue
            first = int(np.flatnonzero(~free)[0])
            loop, free = np.roll(points[:-1], -first, axis=0), np.roll(free, -first)
            change = np.flatnonzero(np.diff(np.concatenate([[False], free, [False]])))
            for a, b in change.reshape(-1, 2).tolist():
                line = np.vstack([loop, loop[:1]])[a : b + 1]
                if length_of(np.diff(line, axis=0)).sum() > 0.02 * self.radius:
                    yield line

    def _advance(self, line: Floats) -> list[Floats]:
        """The next passes beyond a front; what they clear is no longer left."""
        R = self.radius
        line, begun = _past_step(line, 1.2 * self.stepover)
        b, n, r, step = _described(line, R)
        far = np.minimum(greatest_step(r, R, self.phi), 4 * self.stepover)
        room = self._room(b, n, 1.2 * far)
        ends = b + n * np.minimum(1.2 * far, room)[:, None]
        box = shapely.box(*(np.minimum(b, ends).min(axis=0) - 3.2 * R), *(np.maximum(b, ends).max(axis=0) + 3.2 * R))
        beside = [each for each in self.rest if shapely.intersects(each, box)]
        inside = intersection(self.area, box)
        near = difference(inside, shapely.buffer(shapely.union_all(beside), 2e-4 * R, join_style="mitre"))
        d, p = self._pass(b, n, r, step, begun, far, room, near)
        outer = p + n * np.where(d >= room - 1e-3 * R, 0.03 * R, 0.0)[:, None]
        strip = only_areas(shapely.make_valid(shapely.Polygon(np.vstack([b - 0.05 * R * n, outer[::-1]]))))
        grown = self._rounded(_union(shapely.buffer(near, 1e-4), strip), inside, near)
        found = self._new(grown, near, box, line)
        if found:
            found, spared = self._trimmed(found, near, grown)
            grown = difference(grown, spared)
            self.area = difference(self.area, spared)
            self.edge = shapely.boundary(self.area)
            shapely.prepare(self.edge)
            beside = [difference(each, spared) for each in beside]
        if found:
            frame = shapely.buffer(shapely.boundary(box), R)
            gone = difference(shapely.simplify(_closed(grown, inside, 0.99 * R), 4e-4 * R), frame)
            kept = [each for each in self.rest if not shapely.intersects(each, box)]
            self._keep(difference(shapely.union_all(beside), gone), kept)
        return found

    def _trimmed(self, found: list[Floats], near: Any, grown: Any) -> tuple[list[Floats], Any]:
        """Passes that end where they have come to the strip along a wall with little left to cut, and what they leave there."""
        kept, spared = [], []
        for way in (_led_in(way, near, 0.05 * self.radius) for way in found):
            upto = np.append(0.0, np.cumsum(length_of(np.diff(way, axis=0))))
            finer = np.linspace(0, upto[-1], max(2, math.ceil(upto[-1] * FINE / self.radius)))
            at = np.stack([np.interp(finer, upto, way[:, k]) for k in (0, 1)], axis=1)
            thick = shapely.distance(near, shapely.points(at))
            more = (thick > TRIM * self.stepover) | (thick == 0.0) | ~shapely.contains_xy(self.soft, *at.T)
            last = int(np.flatnonzero(more)[-1]) + 1 if more.any() else 0
            if last >= len(at) - 1:
                kept.append(way)
                continue
            tail = shapely.LineString(at[max(last - 1, 0):])
            spared.append(shapely.buffer(tail, 1.1 * TRIM * self.stepover, cap_style="flat"))
            if last > 1:
                kept.append(at[:last])
        new = difference(grown, shapely.buffer(near, 1e-4))
        return kept, (intersection(new, shapely.union_all(spared)))

    def _pass(
        self, b: Floats, n: Floats, r: Floats, step: float, begun: float, far: Floats, room: Floats, near: Any
    ) -> tuple[Floats, Floats]:
        """How far beyond a front the next pass lies, `begun` at its begin, and its places."""
        old, off = shapely.buffer(near, self.radius * (1 - 1e-3), quad_segs=24), np.zeros(len(b))
        if self.stock is not None:
            old = _union(old, difference(shapely.envelope(old), self.stock))
        shapely.prepare(old)
        gentle = min(GENTLE, self.phi / 5)
        phi = self.phi - gentle * np.clip((1.6 if begun else 1.0) - np.arange(len(b)) * step / self.radius, 0.0, 1.0)
        for k in range(ROUNDS + 1):
            d = _swept(step, begun, r, self.radius, phi - off, np.minimum(1.15 * far, room))
            p = evened(b + n * d[:, None], 1.0)
            over = np.where(d > 1e-9, _engaged(p, self.radius, old, phi) - phi, 0.0)
            if k == ROUNDS or over.max() < math.radians(0.2):
                break
            free = (d < room - 1e-6) | (over > 0)
            off = np.clip(off + evened(np.where(free, np.clip(over, -0.1, 0.4), 0.0), 1.5), -0.2, 0.9 * phi)
        return d, p

    def _room(self, b: Floats, n: Floats, far: Floats) -> Floats:
        """How far along the normals the area goes, inf where it goes farther than `far`."""
        low, high, blocked = np.zeros(len(b)), far.copy(), np.zeros(len(b), dtype=bool)
        for share in np.linspace(0, 1, 9)[1:]:
            holds = shapely.contains_xy(self.area, *(b + n * (far * share)[:, None]).T)
            low, high = np.where(~blocked & holds, far * share, low), np.where(~blocked & ~holds, far * share, high)
            blocked |= ~holds
        for _ in range(12):
            middle = (low + high) / 2
            holds = shapely.contains_xy(self.area, *(b + n * middle[:, None]).T)
            low, high = np.where(blocked & holds, middle, low), np.where(blocked & ~holds, middle, high)
        return np.where(blocked, low, np.inf)

    def _rounded(self, joined: Any, inside: Any, near: Any) -> Any:
        """What is cleared after a pass whose corners are rounded, as far as that leaves most of what is new."""
        before = shapely.buffer(near, 2e-4)
        new = difference(joined, before).area
        for share in BLUNT:
            grown = opened(joined, share * self.radius)
            if difference(grown, before).area >= 0.9 * new:
                break
        return intersection(_union(near, grown), inside)

    def _new(self, grown: Any, near: Any, box: Any, front: Floats) -> list[Floats]:
        """The boundary of what is cleared where it is new, what is cleared on the left."""
        frame = shapely.buffer(shapely.boundary(box), self.radius)
        known = _union(shapely.buffer(near, MET * self.stepover, quad_segs=8), frame)
        new = shapely.difference(shapely.boundary(grown), known)
        lines = [each for each in shapely.get_parts(new) if each.geom_type == "LineString" and not each.is_empty]
        if not lines:
            return []
        along = shapely.LineString(front)
        found = []
        for line in shapely.get_parts(shapely.line_merge(shapely.union_all(lines))):
            if line.length < 0.05 * self.radius:
                continue
            middle = shapely.line_interpolate_point(line, line.length / 2 + np.array([0, 1e-3]))
            (ax, ay), (bx, by) = shapely.get_coordinates(middle)
            at = ax - 10 * (by - ay), ay + 10 * (bx - ax)
            points = shapely.get_coordinates(line)
            found.append(points if shapely.contains_xy(grown, *at) else points[::-1])
        return sorted(found, key=lambda way: along.project(shapely.Point(way[0])))


def _led_in(way: Floats, near: Any, before: float) -> Floats:
    """A pass (n, 2) from a place that lies so far within what is cleared."""
    at = shapely.Point(way[0])
    foot = shapely.get_coordinates(shapely.shortest_line(at, near))[1]
    off = length_of(foot - way[0])
    return np.vstack([foot + (foot - way[0]) * before / max(off, 1e-9), way]) if off > 1e-6 else way


def _past_step(line: Floats, high: float) -> tuple[Floats, float]:
    """A front behind a step into the cleared at its begin, such as a spiral leaves where it ends, and how high that is."""
    upto = np.cumsum(length_of(np.diff(line, axis=0)))
    way = np.diff(line, axis=0)
    turn = np.arctan2(way[:-1, 0] * way[1:, 1] - way[:-1, 1] * way[1:, 0], (way[:-1] * way[1:]).sum(axis=1))
    corner = np.flatnonzero((turn < -1.0) & (upto[:-1] < high))
    return (line[corner[0] + 1 :], float(upto[corner[0]])) if len(corner) else (line, 0.0)


def _described(line: Floats, radius: float) -> tuple[Floats, Floats, Floats, float]:
    """Places on a front `radius` / FINE apart, the normals into the material, radii of curvature, and the spacing."""
    way = shapely.LineString(line)
    count = max(3, math.ceil(way.length * FINE / radius))
    b = shapely.get_coordinates(shapely.line_interpolate_point(way, np.linspace(0, way.length, count + 1)))
    pad = min(8, count - 1) if length_of(b[0] - b[-1]) < 1e-6 else 0
    b = evened(np.vstack([b[-pad - 1 : -1], b, b[1 : pad + 1]]) if pad else b, 1.0)
    t = np.gradient(b, axis=0)
    t /= np.maximum(length_of(t), 1e-12)[:, None]
    bend = evened(np.gradient(np.unwrap(np.arctan2(t[:, 1], t[:, 0]))) * count / way.length, 2.0)
    r = 1 / np.where(np.abs(bend) < 1 / (FLATTEST * radius), 1 / (FLATTEST * radius), bend)
    kept = slice(pad, len(b) - pad)
    return b[kept], np.stack([t[:, 1], -t[:, 0]], axis=1)[kept], r[kept], way.length / count


def greatest_step(r: Floats, R: float, phi: float) -> Floats:
    """The d at which ψ = φ beside fronts of the radii r, inf where ψ stays below."""
    root = (r + R) ** 2 - (R * math.sin(phi)) ** 2
    d = np.where(r > 0, 1.0, -1.0) * np.sqrt(np.maximum(root, 0.0)) - R * math.cos(phi) - r
    return np.where((r < 0) & ((root < 0) | (-r <= R)), np.inf, np.maximum(d, 0.0))


def _swept(step: float, begun: float, r: Floats, R: float, phi: Floats, most: Floats) -> Floats:
    """d along a front by d' = tan(φ - ψ(d)) from what it is `begun` with, at most `most`."""
    now = min(begun, float(most[0]))
    d = [now]
    for bend, limit, cap in zip(r.tolist(), phi.tolist(), most[1:].tolist(), strict=False):
        whole = (bend + R) ** 2 - R * R
        for _ in range(FINER):
            away = bend + now
            cosine = 1.0 if -R <= bend < 0 or not away else (whole - away * away) / (2 * away * R)
            beta = min(limit - math.acos(min(1.0, max(-1.0, cosine))), STEEPEST)
            now += math.tan(max(beta, -STEEPEST)) * step / FINER * max(away / bend, 0.1)
            now = 0.0 if now < 0 else cap if now > cap else now
        d.append(now)
    return np.array(d)


def _engaged(p: Floats, R: float, old: Any, phi: Floats) -> Floats:
    """Where the cut ends on the rim, counted from abeam to ahead, along places (n, 2), within WINDOW of φ (n,)."""
    h = np.gradient(p, axis=0)
    abeam = np.arctan2(h[:, 1], h[:, 0]) - math.pi / 2
    low, high = phi - WINDOW, phi + WINDOW
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        out = ~shapely.contains_xy(old, p[:, 0] + R * np.cos(abeam + middle), p[:, 1] + R * np.sin(abeam + middle))
        low, high = np.where(out, middle, low), np.where(out, high, middle)
    return low


def opened(area: Any, size: float) -> Any:
    """Without what a disc of a size does not reach."""
    return shapely.buffer(shapely.buffer(area, -size, quad_segs=16), size, quad_segs=16)


def _closed(area: Any, within: Any, size: float) -> Any:
    """With the clefts and holes that a disc of a size does not get into."""
    more = shapely.buffer(shapely.buffer(area, size, quad_segs=16), -size, quad_segs=16)
    return intersection(_union(area, more), within)


def difference(a: Any, b: Any) -> Any:
    """What of an area is not in another, cut on a grid."""
    return only_areas(shapely.difference(a, b, grid_size=GRID))


def intersection(a: Any, b: Any) -> Any:
    """What two areas share, cut on a grid."""
    return only_areas(shapely.intersection(a, b, grid_size=GRID))


def _union(a: Any, b: Any) -> Any:
    return only_areas(shapely.union(a, b, grid_size=GRID))


def only_areas(found: Any) -> Any:
    """The polygons of what is found, without lines and points."""
    if found.geom_type in ("Polygon", "MultiPolygon"):
        return found
    return shapely.union_all([part for part in shapely.get_parts(shapely.get_parts(found)) if part.geom_type == "Polygon"])
