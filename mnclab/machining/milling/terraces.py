r"""Areas whose depth differs from place to place: contour formulas of parts with depths of their own. Lengths in mm.

A formula joins areas by `&` (common), `|` (united), `^` (united without what is common) and `\` (without). A part that
is cut counts down to its depth; a part that is taken away, right of `\`, is an island whose top lies at its depth below the
surface. So the area that is cut is another one at every depth:

    ─┐           ┌─┐          ┌──   surface
     │           │ │island    │     terrace 1: its area counts from the surface down to its bottom
     └──┐      ┌─┴─┴──────────┘     bottom of terrace 1 = top of terrace 2
        └──────┘                    bottom of the last terrace = the milling depth
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from mnclab.geometry import shapely
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import polygons
from mnclab.machining.depths import DRIFT, infeeds

SLIVER = 1e-6  # mm², an area that counts as none


class DeepArea(NamedTuple):
    """An area of a formula and its own depth; 0 is as deep as the whole, or for an island up to the surface.

    >>> mnc.area.Part(mnc.area.Region.of(mnc.area.rectangle(40, 20)), 5).depth
    5
    """

    region: Region
    depth: float = 0.0


class Joined(NamedTuple):
    """Two sides of a formula and what joins them: one of `& | ^ \\`."""

    operator: str
    left: Formula
    right: Formula


Formula: TypeAlias = DeepArea | Joined
#: Areas that were found before: a formula (kept, since its `id` is the key), and what it is at a depth.
Known: TypeAlias = dict[tuple[int, float, float, bool], tuple[Formula, Region]]


class Terrace(NamedTuple):
    """The area that is cut between two depths, counted from the surface and positive; a `solid` one stays, cut free around."""

    top: float
    bottom: float
    region: Region
    solid: bool = False


class ClearingLevel(NamedTuple):
    """One level of a clearing: its coordinate along the tool axis and which terrace it clears."""

    height: float
    terrace: int


def at_depth(
    formula: Formula, depth: float, whole: float, taken_away: bool = False, known: Known | None = None
) -> Region:
    """The area that is cut at a depth, where the formula as a whole is `whole` deep.

    `known` keeps the areas of its parts, for formulas that are made of each other.
    """
    if isinstance(formula, DeepArea):
        reach = formula.depth or (0.0 if taken_away else whole)
        return formula.region if (depth > reach) == taken_away else Region()
    known = {} if known is None else known
    key = id(formula), depth, whole, taken_away
    if key not in known:
        left = at_depth(formula.left, depth, whole, taken_away, known)
        right = at_depth(formula.right, depth, whole, taken_away != (formula.operator == "\\"), known)
        known[key] = formula, combined(formula.operator, left, right)
    return known[key][1]


def combined(operator: str, left: Region, right: Region) -> Region:
    """Two areas as an operator of a formula joins them."""
    match operator:
        case "&":
            return left.intersection(right)
        case "|":
            return left.union(right)
        case "^":
            return left.union(right).difference(left.intersection(right))
        case _:
            return left.difference(right)


def terraces(formula: Formula, whole: float) -> tuple[Terrace, ...]:
    """The terraces of a formula from the surface down, those of one area joined; `whole` > 0 is the milling depth.

    A ValueError where nothing is cut at the surface, or where the area grows with the depth, which no cutter reaches.

    >>> deep = mnc.area.Part(mnc.area.Region.of(mnc.area.rectangle(40, 20)))
    >>> [(terrace.top, terrace.bottom, terrace.region.area) for terrace in mnc.area.terraces(deep, 5)]
    [(0.0, 5, 800.0)]
    """
    depths = sorted({min(part.depth, whole) for part in parts(formula)} - {0.0} | {whole})
    found: list[Terrace] = []
    top = 0.0
    for bottom in depths:
        region = at_depth(formula, (top + bottom) / 2, whole)
        if not region.loops:
            break
        if found and region.difference(found[-1].region).area > SLIVER:
            raise ValueError(f"it is wider below {top:.10g} mm than above, where no cutter gets")
        if found and found[-1].region.difference(region).area <= SLIVER:
            found[-1] = found[-1]._replace(bottom=bottom)
        else:
            found.append(Terrace(top, bottom, region))
        top = bottom
    if not found:
        raise ValueError("it encloses nothing")
    return tuple(found)


def parts(formula: Formula) -> Iterator[DeepArea]:
    """The parts of a formula, from left to right."""
    if isinstance(formula, DeepArea):
        yield formula
    else:
        yield from parts(formula.left)
        yield from parts(formula.right)


def levels(
    found: Sequence[Terrace], surface: float, down: int, infeed: float, allowance: float = 0.0
) -> tuple[ClearingLevel, ...]:
    """The levels that clear terraces, `infeed` apart from the surface on, and one on each floor above its `allowance`.

    `down` is -1 where the depth is negative. No floor lies above the surface: an allowance as deep as a terrace is cut off.
    """
    made: list[ClearingLevel] = []
    reached = 0.0
    for number, terrace in enumerate(found):
        floor = max(terrace.bottom - allowance, 0.0)
        for depth in infeeds(0.0, floor, infeed) if floor > 0 or len(found) == 1 else ():
            if depth > reached + DRIFT or len(found) == 1:
                made.append(ClearingLevel(surface + down * depth, number))
        reached = max(reached, floor)
    return tuple(made)


# Where a tool goes down to clear an area: in every piece of the tool-centre area as far from its boundary as can be.
#     C = area inset by R + allowance         where the centre of a tool of radius R may go
#     infeed point of a piece of C            the middle of the largest disc in it
# So a helix has the most room there, and so has the drill of a pilot hole; the place depends neither on the stepover nor, where
# the piece stays one, on the radius. Of many such places, in the middle of a slot, the one nearest to the mean of all is taken.
# Lengths in mm.

FINE = 0.01  # of the radius of the largest disc: how much smaller one may be that is found
LEAST = 1e-3  # of the size of a piece: narrower than that it has a place within, but not the best one
SAME = 1e-6
TOGETHER = 1e-3  # mm, within which two infeed points of different depths are one hole
CORNERS = np.array([(-1, -1), (1, -1), (-1, 1), (1, 1)]) / 2
AROUND = np.linspace(0, 2 * np.pi, 8, endpoint=False)
TOP = 1e-5  # mm, how near a place is to the top that is found


def infeed_points(region: Region, reach: float) -> Floats:
    """The places `(k, 2)` where a tool goes down that keeps `reach` away from the walls: one in each of the k pieces."""
    return np.array([roomiest(part) for part in region.inset(reach).parts]).reshape(-1, 2)


def roomiest(piece: Region) -> Floats:
    """The place `(2,)` of a connected area that is farthest from its boundary.

    Squares are halved as long as a better place may lie in them; the best one found then climbs to the top.
    """
    area = polygons(piece)
    middle = shapely.get_coordinates(shapely.point_on_surface(area))
    low, high = piece.bounds
    edge = shapely.STRtree(_edges(area))
    slack = LEAST * float((high - low).max())
    size = max(float((high - low).min()), slack)
    counts = np.maximum(np.ceil((high - low) / size).astype(int), 1)
    across, up = (low[k] + (np.arange(counts[k]) + 0.5) * size for k in range(2))
    squares = np.stack(np.meshgrid(across, up), axis=-1).reshape(-1, 2)
    spots, rooms = middle, _rooms(area, edge, middle)
    while len(squares):
        room = _rooms(area, edge, squares)
        spots, rooms = np.vstack([spots, squares]), np.append(rooms, room)
        best = float(rooms.max())
        promising = room + size * np.sqrt(0.5) > best + max(FINE * best, slack)
        squares = (squares[promising, None] + size / 2 * CORNERS).reshape(-1, 2)
        size /= 2
    top = spots[rooms >= rooms.max() - 2 * FINE * abs(rooms.max())]
    return _climbed(piece, top[np.hypot(*(top - top.mean(axis=0)).T).argmin()], FINE * abs(float(rooms.max())))


def _climbed(piece: Region, here: Floats, step: float) -> Floats:
    """From a place to the top near by, where lines and arcs count as they are; no ridge is in line with all the tries."""
    room, turn = float(piece.distance([here])[0]), 0.0
    while step > TOP:
        round_about = here + step * np.stack([np.cos(AROUND + turn), np.sin(AROUND + turn)], axis=1)
        rooms = piece.distance(round_about)
        if step >= room:  # else all of them lie in the disc around the place
            rooms = np.where(piece.contains(round_about), rooms, 0.0)
        if rooms.max() > room + 1e-3 * step:
            here, room, step = round_about[rooms.argmax()], float(rooms.max()), 2 * step
        else:
            step, turn = step / 2, turn + 1
    return here


def _edges(area: Any) -> Any:
    """The straight pieces of the boundary of a shapely area."""
    rings = shapely.get_rings(area)
    points, ring = shapely.get_coordinates(rings, return_index=True)
    joined = ring[1:] == ring[:-1]
    return shapely.linestrings(np.stack([points[:-1], points[1:]], axis=1)[joined])


def _rooms(area: Any, edge: Any, spots: Floats) -> Floats:
    """How far places `(k, 2)` lie within the boundary, `(k,)`; below 0 outside."""
    points = shapely.points(spots)
    (index, _), away = edge.query_nearest(points, return_distance=True, all_matches=False)
    found = np.empty(len(spots))
    found[index] = away
    inside = shapely.contains_xy(area, spots)
    return np.where(inside, found, -found)


def pilot_holes(
    found: Sequence[Terrace], reach: float, room: float, allowance: float = 0.0
) -> tuple[tuple[float, float, float], ...]:
    """Where to drill before terraces are cleared: (x, y, depth) of each infeed point of a tool that keeps `reach` off the walls.

    A hole ends `allowance` above the floor; of two at one place the deeper one is drilled. A ValueError where such a tool does
    not fit, or where the drill has less than the `room` that it takes.
    """
    holes: dict[tuple[float, float], float] = {}
    for terrace in found:
        spots = infeed_points(terrace.region, reach)
        if not len(spots):
            raise ValueError(f"the rough-out tool and the allowance for side, {reach:g}, do not fit into the contour")
        rooms = terrace.region.distance(spots)
        for (x, y), here in zip(spots.tolist(), rooms.tolist(), strict=True):
            if here < room - SAME:
                place = f"at ({x:.3f}, {y:.3f}) only {here:.3f} of room"
                raise ValueError(f"the drill has {place}: with the allowance for side it needs {room:g}")
            at = next((old for old in holes if math.dist(old, (x, y)) < TOGETHER), (x, y))
            holes[at] = max(terrace.bottom - allowance, holes.get(at, 0.0), 0.0)
    return tuple((x, y, depth) for (x, y), depth in holes.items())
