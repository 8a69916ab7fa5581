"""Where a tool goes down to clear an area: in every piece of the tool-centre area as far from its boundary as can be.

    C = area inset by R + allowance         where the centre of a tool of radius R may go
    infeed point of a piece of C            the middle of the largest disc in it

So a helix has the most room there, and so has the drill of a pilot hole; the place depends neither on the stepover nor, where
the piece stays one, on the radius. Of many such places, in the middle of a slot, the one nearest to the mean of all is taken.
Lengths in mm.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from mnclab.geometry import shapely
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import polygons
from mnclab.machining.milling.terraces import Terrace

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
        rooms = np.where(piece.contains(round_about), piece.distance(round_about), 0.0)
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
