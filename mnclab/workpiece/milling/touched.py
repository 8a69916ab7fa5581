"""What moves leave of a blank, as a probe meets it: the distance of points from the material, to the tools that cut it.

A tool takes away its own body and all that stands above it. How deep a point lies in the body of a tool is told by the
shape alone, and where the surface is that near: if material stands there, that is the distance, exactly. Where another
move has taken it away (between two passes, at the rim of a step), the point looks round itself, over the true heights,
for the nearest material: along rays, narrowed down to 1e-9 mm; what is thinner than a ray is wide, it may miss. Of a blank
that was cut before, the tools of its former clampings tell as well, where they stand now.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import chain

import numpy as np

from mnclab.path.toolpath import Array, Mask
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.clamped import Clamped
from mnclab.workpiece.milling.gaps import Gaps, Group
from mnclab.workpiece.milling.moves import STILL, Moves
from mnclab.workpiece.milling.raster import lowered
from mnclab.workpiece.part import Part

FAR = 8.0  # mm, beyond which a distance is no longer looked for, and only bounded from below
BEHIND = 1e-6  # mm, how far behind a surface material must stand
AT_ONCE = 8  # places that a probe looks at in one go: each of them may have to look round
RAYS, ALONG = 64, 41  # around a point, and places of each
ZOOMS, WINDOW = 10, 17  # how often a place on a ray is narrowed down, and among how many
ROUGH = 3  # … as often before the rays are compared
TURNS = 7  # how often the direction is narrowed down
NARROWINGS = 60  # of the place on a slope where a tool stands deepest about a point


@dataclass(frozen=True, eq=False)
class Touched:
    """A blank and the moves that cut it, in the same coordinates; those of `tilted` tools by their directions."""

    stock: Blank
    moves: Moves
    tilted: tuple[Group, ...] = ()

    @cached_property
    def gaps(self) -> Gaps | None:
        """What tilted tools took away, of the blank too."""
        before = self.stock.gaps if isinstance(self.stock, Clamped) else None
        groups = self.tilted + (before.groups if before else ())
        return Gaps(groups, np.asarray(self.stock.bounds)) if groups else None

    @property
    def part(self) -> Part:
        bounds = np.array(self.stock.bounds)
        return Part(self.distance, "what is left of the blank", AT_ONCE, bounds, bound=self.at_least)

    def distance(self, points: Array) -> Array:
        """Signed distances (m,) of points (m, 3) from the material; from `FAR` on they may be too small."""
        found = self._off_blank(points)
        near = np.flatnonzero(found < FAR)
        if not len(near):
            return found
        moves = _about(self.moves, points[near], FAR)
        found[near] = self._among(moves, points[near], found[near])
        return found

    def at_least(self, points: Array) -> Array:
        """The same without looking round: where several moves have cut, a distance that may be too small."""
        found = self._off_blank(points)
        near = np.flatnonzero(found < FAR)
        if len(near):
            moves = _about(self.moves, points[near], FAR)
            for depth, _ in chain([depths(moves, points[near])] if len(moves) else [], self._before(points[near])):
                found[near] = np.maximum(found[near], depth.max(axis=0))
        return found

    def _off_blank(self, points: Array) -> Array:
        """Signed distances from the box about the blank."""
        low, high = self.stock.bounds
        beyond = np.maximum(low - points, points - high)
        return np.asarray(np.linalg.norm(np.maximum(beyond, 0.0), axis=1) + np.minimum(beyond.max(axis=1), 0.0))

    def _before(self, points: Array) -> Iterator[tuple[Array, Array]]:
        """As `depths` has it of the moves of tilted tools, and of those that cut the blank in former clampings."""
        plain = self.stock.made_by() if isinstance(self.stock, Clamped) else ()
        around = points.min(axis=0) - FAR, points.max(axis=0) + FAR
        for moves, placement in self.gaps.near(*around) if self.gaps else plain:
            own = placement.back(points)
            if len(moves := _about(moves, own, FAR)):
                depth, feet = depths(moves, own)
                yield depth, placement.there(feet)

    def _among(self, moves: Moves, points: Array, outside: Array) -> Array:
        """Distances from the blank less some moves; `outside` (m,) are those from the box about the blank."""
        found, feet, known = outside.copy(), np.clip(points, *self.stock.bounds)[None], outside[None] > 0
        for depth, on_tools in chain([depths(moves, points)] if len(moves) else [], self._before(points)):
            found = np.maximum(found, depth.max(axis=0))
            feet, known = np.concatenate([feet, on_tools]), np.concatenate([known, depth > 0])
        free = ~self._material(moves, points) & (found < FAR)
        sure = np.full(len(points), FAR)
        which, at = np.nonzero(known & free)
        way = feet[which, at] - points[at]
        size = np.linalg.norm(way, axis=1)
        behind = feet[which, at] + BEHIND * way / np.maximum(size, 1e-300)[:, None]
        stands = self._material(moves, behind)
        np.minimum.at(sure, at[stands], size[stands])
        search = np.flatnonzero(free & (sure > found + 1e-12))
        found[free] = sure[free]
        if len(search):
            found[search] = self._looking_round(moves, points[search], sure[search])
        return found

    def _material(self, moves: Moves, points: Array) -> Mask:
        """Which points stand in the material."""
        floor, top = self._columns(moves, points[:, 0], points[:, 1])
        found = np.asarray((floor <= points[:, 2]) & (points[:, 2] <= top))
        return found & ~self.gaps.empty(*points.T) if self.gaps else found

    def _columns(self, moves: Moves, x: Array, y: Array) -> tuple[Array, Array]:
        """From where to where the material reaches at points (m,); empty columns are upside down."""
        floor, top = self.stock.faces(x, y)
        inside = np.isfinite(top)
        found = np.where(inside, top, -np.inf)
        if inside.any() and len(moves):
            found[inside] = lowered(moves, moves.boxes, x[inside], y[inside], top[inside])
        if inside.any() and self.gaps:
            found[inside], floor[inside] = self.gaps.sides(x[inside], y[inside], np.fmax(found, floor)[inside], floor[inside])
        stands = found > floor
        return np.where(stands, floor, np.inf), np.where(stands, found, -np.inf)

    def _looking_round(self, moves: Moves, points: Array, reach: Array) -> Array:
        """The distances of points (m, 3) from the nearest material; `reach` (m,) where there is none within it."""
        every = np.arange(len(points))

        def along(angle: Array, zooms: int) -> Array:
            """The least distances on rays (m, a)."""
            out = np.linspace(0.0, 1.0, ALONG) * np.broadcast_to(reach[:, None, None], (*angle.shape, 1))
            step = reach[:, None, None] / (ALONG - 1)
            for zoom in range(zooms + 1):
                here = self._off(moves, points, angle, out)
                if zoom < zooms:
                    middle = np.take_along_axis(out, here.argmin(axis=2)[..., None], axis=2)
                    out = np.maximum(middle + step * np.linspace(-1.0, 1.0, WINDOW), 0.0)
                    step = step / ((WINDOW - 1) / 2)
            return np.asarray(here.min(axis=2))

        angle, step = np.linspace(0.0, 2 * np.pi, RAYS, endpoint=False), 2 * np.pi / RAYS
        best, least = angle[along(angle + np.zeros((len(points), 1)), ROUGH).argmin(axis=1)], reach
        for _ in range(TURNS):
            angle = best[:, None] + step * np.linspace(-1.0, 1.0, WINDOW)
            here = along(angle, ZOOMS)
            best, least = angle[every, here.argmin(axis=1)], np.minimum(least, here.min(axis=1))
            step /= (WINDOW - 1) / 2
        return least

    def _off(self, moves: Moves, points: Array, angle: Array, out: Array) -> Array:
        """How far the material is (m, a, r) that stands at some places `out` (m, a, r) on rays (m, a) from points."""
        x = points[:, :1, None] + out * np.cos(angle)[..., None]
        y = points[:, 1:2, None] + out * np.sin(angle)[..., None]
        floor, top = self._columns(moves, x.ravel(), y.ravel())
        height = np.broadcast_to(points[:, 2:, None], out.shape).ravel()
        if self.gaps:
            up_or_down = self.gaps.off(x.ravel(), y.ravel(), height, top, floor)
        else:
            up_or_down = np.maximum(np.maximum(height - top, floor - height), 0.0)
        return np.hypot(out, up_or_down.reshape(out.shape))


def _about(moves: Moves, points: Array, reach: float) -> Moves:
    """The moves that come within reach of some points."""
    boxes = moves.boxes
    low, high = points.min(axis=0) - reach, points.max(axis=0) + reach
    keep = (boxes[:, 0] <= high[0]) & (boxes[:, 1] <= high[1]) & (boxes[:, 2] >= low[0]) & (boxes[:, 3] >= low[1])
    return moves[keep & (moves.low <= high[2])]


def depths(moves: Moves, points: Array) -> tuple[Array, Array]:
    """How deep points (m, 3) lie in what k moves sweep (k, m), mm, and the place of the surface that near (k, m, 3).

    Never too deep; beside the tools negative, and then the place means nothing. On slopes and helices it may be less.
    """
    found = np.full((len(moves), len(points)), -np.inf)
    feet = np.zeros((len(moves), len(points), 3))
    for which, places in ((~moves.arc, _straight), (moves.arc, _round)):
        index = np.flatnonzero(which)
        if not len(index):
            continue
        some = moves[index]
        for axis, aside in places(some, points):
            depth, foot = _in_cutter(some, points, axis, aside)
            better = depth > found[index]
            found[index] = np.where(better, depth, found[index])
            feet[index] = np.where(better[..., None], foot, feet[index])
    return found, feet


def _straight(moves: Moves, points: Array) -> list[tuple[Array, Array]]:
    """Where on each straight move the tool stood deepest about each point (k, m, 3), and a direction aside (k, m, 2)."""
    way = moves.end - moves.start
    size = np.hypot(way[:, 0], way[:, 1])
    goes = np.where(size > STILL, size, 1.0)
    ahead = np.einsum("kmi,ki->km", points[None, :, :2] - moves.start[:, None, :2], way[:, :2]) / (goes * goes)[:, None]
    place = np.clip(np.where(size[:, None] > STILL, ahead, way[:, 2:] < 0), 0.0, 1.0)
    sloping = np.flatnonzero((size > STILL) & (way[:, 2] != 0))
    if len(sloping):
        place[sloping] = _deepest(moves[sloping], points)
    aside = np.stack([-way[:, 1], way[:, 0]], axis=1) / goes[:, None]
    aside[size <= STILL] = 1.0, 0.0
    return [(moves.start[:, None] + place[..., None] * way[:, None], np.broadcast_to(aside[:, None], (*place.shape, 2)))]


def _deepest(moves: Moves, points: Array) -> Array:
    """The share of a slope at which the tool has a point deepest in it; the depth rises to it and falls from it."""
    way = (moves.end - moves.start)[:, None]
    low, high = np.zeros((len(moves), len(points))), np.ones((len(moves), len(points)))
    aside = np.zeros((*low.shape, 2))
    for _ in range(NARROWINGS):
        third = (high - low) / 3
        one, other = (
            _in_cutter(moves, points, moves.start[:, None] + at[..., None] * way, aside)[0]
            for at in (low + third, high - third)
        )
        low, high = np.where(one < other, low + third, low), np.where(one < other, high, high - third)
    return (low + high) / 2


def _round(moves: Moves, points: Array) -> list[tuple[Array, Array]]:
    """Where on each arc the tool stood next to each point, on the lowest turn that comes there and the one above it."""
    out = points[None, :, :2] - moves.centre[:, None]
    spoke = moves.start[:, :2] - moves.centre
    first, radius = np.arctan2(spoke[:, 1], spoke[:, 0])[:, None], np.hypot(spoke[:, 0], spoke[:, 1])[:, None]
    sense, whole = np.sign(moves.sweep)[:, None], np.abs(moves.sweep)[:, None]
    turned = np.mod((np.arctan2(out[..., 1], out[..., 0]) - first) * sense, 2 * np.pi)
    falls = moves.end[:, 2:] <= moves.start[:, 2:]
    last = np.where(falls, turned + 2 * np.pi * np.floor((whole - turned) / (2 * np.pi)), turned)
    found = []
    for place in (last, last + np.where(falls, -2 * np.pi, 2 * np.pi), 0.0 * turned, whole + 0.0 * turned):
        place = np.clip(place, 0.0, whole)
        angle = first + sense * place
        aside = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        height = moves.start[:, 2:] + (moves.end - moves.start)[:, 2:] * place / whole
        found.append((np.concatenate([moves.centre[:, None] + radius[..., None] * aside, height[..., None]], axis=-1), aside))
    return found


def _in_cutter(moves: Moves, points: Array, tips: Array, aside: Array) -> tuple[Array, Array]:
    """How deep points lie in tools whose tips stand at (k, m, 3), and the nearest place of their surface."""
    radius, flat, corner, slope = (c[:, None] for c in (moves.radius, moves.flat, moves.corner, moves.slope))
    out = points[None, :, :2] - tips[..., :2]
    rho, high = np.hypot(out[..., 0], out[..., 1]), points[None, :, 2] - tips[..., 2]
    wall, steep = radius - rho, np.hypot(1.0, slope)
    under = (high - slope * np.maximum(rho - flat, 0.0)) / steep
    bent = (corner > 0) & (rho > flat) & (high < corner)
    beyond, rise = rho - flat, high - corner
    size = np.where(bent, np.hypot(beyond, rise), 1.0)
    by_wall = wall <= under
    depth = np.where(bent, corner - size, np.minimum(wall, under))
    size = np.maximum(size, 1e-300)
    foot_rho = np.where(bent, flat + corner * beyond / size, np.where(by_wall, radius, rho + under * slope / steep))
    foot_high = np.where(bent, corner + corner * rise / size, np.where(by_wall, high, high - under / steep))
    towards = np.where((rho > STILL)[..., None], out / np.maximum(rho, STILL)[..., None], aside)
    foot = tips[..., :2] + foot_rho[..., None] * towards
    return depth, np.concatenate([foot, (tips[..., 2] + foot_high)[..., None]], axis=-1)

