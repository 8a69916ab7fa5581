"""Spirals that a control can run: of half circles, or of turns between rings. Lengths in mm.

   .-----.        half circles stand on one line through the centre, alternately on its two sides;
 /  .--.   \\      where one ends, the next begins in the same direction:
|  ( ·  )   |
 \\  `--´---´       radius at the i-th crossing of that line: r_0 + i·(r_1 - r_0) / n
"""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import Contour, steps_within
from mnclab.geometry.curves import Floats, cross
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import covered, polygons, stays
from mnclab.machining.milling import faces
from mnclab.machining.milling.clearing import Clearing, Piece, joined, links, numbered, piecewise
from mnclab.machining.milling.rings import Ring, rings_in_order

CHORD = 5e-4  # mm
LEFT = 1e-3  # of an area: a spiral that leaves more standing is none


def half_circles(
    centre: ArrayLike, begin: float, end: float, count: int, angle: float = 0.0, clockwise: bool = False
) -> Contour:
    """The spiral of `count` half circles from one distance of the centre to another, begun in the direction `angle`."""
    if count < 1 or min(begin, end) < 0:
        raise ValueError(f"a spiral needs a half circle and radii not below 0, got {count}, {begin:g} and {end:g}")
    return through(centre, begin + (end - begin) * np.arange(count + 1) / count, angle, clockwise)


def through(centre: ArrayLike, away: ArrayLike, angle: float = 0.0, clockwise: bool = False) -> Contour:
    """Half circles between places at distances `away` (n,) from a centre, in the direction `angle` and opposite in turn."""
    far = np.asarray(away, dtype=float)
    side = np.where(np.arange(len(far)) % 2, -1.0, 1.0) * far
    way = np.array([np.cos(angle), np.sin(angle)])
    bulge = np.full(len(far), -1.0 if clockwise else 1.0)
    return Contour(np.asarray(centre, dtype=float) + side[:, None] * way, bulge, closed=False)


def turn_between(inner: Contour, outer: Contour, spacing: float) -> Contour:
    """One turn from the start of a closed contour to the start of the next one outside it, by straight lines.

    The point at the share t of the way round lies at the share t of the way from the inner contour to the outer one.
    """
    upto = outer.upto
    fine = steps_within(outer.radii, outer.sweeps, CHORD)
    counts = np.maximum(fine, np.ceil(outer.lengths / spacing).astype(int))
    ways = [a + (b - a) * np.arange(n) / n for a, b, n in zip(upto, upto[1:], counts, strict=False)]
    way = np.append(np.concatenate(ways), upto[-1])
    far = np.vstack([outer.point_at(way[:-1])[0], outer.points[:1]])
    near, share = inner.nearest_points(far), (way / upto[-1])[:, None]
    return Contour(_without_needless(near + share * (far - near)), closed=False)


def _without_needless(points: Floats) -> Floats:
    """A polyline without the points that lie on the straight way between their neighbours."""
    while len(points) > 2:
        a, b = points[1:-1] - points[:-2], points[2:] - points[1:-1]
        whole = points[2:] - points[:-2]
        off = np.abs(cross(a, whole)) / np.maximum(np.hypot(*whole.T), 1e-300)
        idle = (off < CHORD / 100) & ((a * b).sum(axis=1) >= 0)
        idle[1:] &= ~idle[:-1]  # never two neighbours at once
        if not idle.any():
            break
        points = points[np.concatenate([[True], ~idle, [True]])]
    return points


def spiral(region: Region, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True) -> Clearing:
    """An area cleared on spirals that grow from an innermost ring into the wall, without a step from ring to ring.

    A round area is one spiral of true arcs. Elsewhere a turn of straight lines leads from each ring to the next one, and the
    last ring is run as it is. Where rings divide, or a turn would leave the area, one spiral ends and another begins; where
    spirals would leave something standing, the rings are run as they are.

    >>> pocket = mnc.area.Region.of(mnc.area.rectangle(40, 20))
    >>> len(mnc.strategies.spiral(pocket, 4, 3).pieces)  # it goes down once
    1
    """
    return piecewise(region, radius, stepover, allowance, lambda part: _piece(part, radius, stepover, climb))


def _piece(centres: Region, radius: float, stepover: float, climb: bool) -> Piece:
    round_one = _circle(centres)
    if round_one is not None:
        middle, reach = round_one
        halves = max(1, int(np.ceil(2 * reach / stepover - 1e-9)))
        way = half_circles(middle, 0.0, reach, halves, clockwise=not climb)
        last = Contour.circle(middle, reach, np.pi * halves, clockwise=not climb)
        return Piece(centres, (way, last), (True,), ("spiral", "wall"), middle)
    rings = list(rings_in_order(centres, radius, stepover))
    chains = _chains(rings, centres, stepover, climb)
    reach = polygons(centres).buffer(radius)
    cover = covered([way for turns, ring in chains for way in (*turns, ring.contour)], radius)
    if reach.difference(cover).area > LEFT * reach.area:
        chains = [([], ring if climb else replace(ring, contour=ring.contour.reversed())) for ring in rings]
    passes = [way for turns, ring in chains for way in (*turns, ring.contour)]
    labels: list[str] = []
    for name, (turns, ring) in zip(numbered("spiral", len(chains)), chains, strict=True):
        face = "island" if ring.island else "wall"
        labels += [name] * len(turns) + [f"{name}, last ring" if ring.level else face]
    return Piece(centres, tuple(passes), links(centres, passes, stepover), tuple(labels))


def _circle(centres: Region) -> tuple[Floats, float] | None:
    """Centre and radius of a region that is one circle."""
    loop = centres.loops[0]
    if len(centres.loops) > 1 or not loop.bulge.all():
        return None
    same = max(np.ptp(loop.radii), np.ptp(loop.centres, axis=0).max()) <= 1e-6
    return (loop.centres[0], float(loop.radii[0])) if same else None


def _chains(rings: list[Ring], centres: Region, stepover: float, climb: bool) -> list[tuple[list[Contour], Ring]]:
    """Rings in the order of cutting as spirals: the way from the first to the last, and the last ring."""
    rings = rings if climb else [replace(ring, contour=ring.contour.reversed()) for ring in rings]
    grows = [_grows(ring, following, rings) for ring, following in pairwise(rings)]
    for k in reversed(range(len(grows))):
        if grows[k]:  # a turn begins where the ring within comes nearest to its end
            inner, outer = rings[k].contour, rings[k + 1].contour
            rings[k] = replace(rings[k], contour=inner.started_at(inner.nearest(outer.points[0])))
    steps = enumerate(pairwise(ring.contour for ring in rings))
    ways = {k: turn_between(*two, stepover / 2) for k, two in steps if grows[k]}
    inside = dict(zip(ways, stays(ways.values(), polygons(centres)), strict=True))
    chains: list[tuple[list[Contour], Ring]] = []
    parts: list[Contour] = []
    for k, ring in enumerate(rings):
        if inside.get(k):
            parts = [*(parts or [ring.contour]), ways[k]]
        else:
            chains.append((_one_way(parts), ring))
            parts = []
    return chains


def _grows(ring: Ring, following: Ring, rings: list[Ring]) -> bool:
    """Whether the next ring goes round the same as this one, and nothing else of its kind."""
    if ring.island != following.island or not 0 < ring.level - following.level <= 1:
        return False
    outer, inner = (ring, following) if ring.island else (following, ring)
    alike = [other.contour for other in rings if (other.level, other.island) == (inner.level, inner.island)]
    within = outer.contour.winding(np.array([contour.points[0] for contour in alike])) != 0
    return int(within.sum()) == 1 and bool(outer.contour.winding(inner.contour.points[:1])[0])


def _one_way(parts: list[Contour]) -> list[Contour]:
    """The first ring and the turns after it as one open contour."""
    if not parts:
        return []
    *_, last = parts
    points = [parts[0].points, *(turn.points[:-1] for turn in parts[1:]), last.points[-1:]]
    bulge = [parts[0].bulge, *(turn.bulge[:-1] for turn in parts[1:]), np.zeros(1)]
    return [Contour(np.vstack(points), np.concatenate(bulge), closed=False)]


def round_pocket(diameter: float, radius: float, stepover: float, *, climb: bool = True) -> Clearing:
    """A circular pocket about (0, 0) on one spiral of half circles from its middle, and the full circle of its wall.

    Each turn is at most a `stepover` wider than the one before; no pass where the tool fills the pocket.
    """
    reach = diameter / 2 - radius
    turns = faces.steps(reach, stepover)
    if not turns:
        return joined([], (), radius, place=np.zeros(2))
    ring = Contour.circle((0, 0), reach, clockwise=not climb)
    way = half_circles((0, 0), 0.0, reach, 2 * turns, clockwise=not climb)
    return joined([way, ring], ("spiral", "last circle"), radius, place=np.zeros(2))
