"""What the back of an insert takes away, its auxiliary edge, where the programmed way has it that the tip cuts.

An edge that leads takes material. The auxiliary one may: in facing it does all the work. It must not where it

- runs nearly along the feed and rubs on its whole length (turning towards the tailstock with 5 degrees), or
- leaves material standing behind it as high as where it went in: a wall steeper than its angle, which it cuts down. ::

        ___         ____
           |       /          the tip comes down along the wall,
           |  ==> /           the auxiliary edge leaves this of it
           |____ /__

The sides of a blade may turn along the axis, but no deeper than the blade is wide. Coordinates (z, r), mm.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from mnclab.geometry import shapely
from mnclab.geometry.curves import Floats
from mnclab.geometry.sweeps import broad
from mnclab.path.inserts import FACE, angles_of, mirror_of, usual
from mnclab.path.tool import Tool

ALONG = math.radians(15)  # between feed and edge: below, the edge rubs
FAR = 1e5  # mm
TOLERANCE = 0.01  # mm


class Back(NamedTuple):
    """What a back took: the place (z, r) of the deepest point, and how far beyond the way of the nose it is, mm."""

    place: tuple[float, float]
    depth: float


def taken_by_back(tool: Tool, shape: Floats, way: Floats, left: Any) -> Back | None:
    """What the back of an insert takes of an area `left` along a way (m, 2); `shape` (k, 2) is the tool about its tip."""
    mirror = mirror_of(tool)
    if tool.kind in ("thread", FACE) or not (tool.width or tool.auxiliary_angle):
        return None
    places, corners = way * mirror, shape * mirror
    here = shapely.transform(left, lambda each: each * mirror)
    judge = _side if tool.width else _auxiliary
    found = []
    for start, end in zip(places[:-1], places[1:], strict=True):
        if (length := float(np.hypot(*(end - start)))) < 1e-9:
            continue
        hull = shapely.convex_hull(shapely.multipoints(np.concatenate([corners + start, corners + end])))
        taken = shapely.intersection(here, hull)
        if taken.area > 0:
            here = shapely.difference(here, hull)
            found += judge(tool, start, (end - start) / length, taken)
    found = [each for each in found if each.rubs or _stands(here, each.area)]
    if not found:
        return None
    worst = max(found, key=lambda each: each.depth)
    z, r = worst.place * mirror
    return Back((float(z), float(r)), worst.depth)


def left_by_lean(tool: Tool, way: Floats, taken: Any) -> Any:
    """What nose and lean of an edge leave on the wall where a straight cut ends that took an area: a wedge, or nothing."""
    tool = usual(tool)
    if tool.width or tool.kind not in ("", "turning", "boring") or taken.is_empty:
        return shapely.Polygon()
    mirror, (main, auxiliary) = mirror_of(tool), angles_of(tool)
    start, end = way * mirror
    right, top = (shapely.get_coordinates(taken) * mirror).max(axis=0)
    along, down = end - start
    if along < 0 and -along >= abs(down) and main > math.pi / 2 - 1e-9:
        high = max(top - end[1], 0.0)
        wedge = [(0.0, 0.0), (tool.corner, 0.0), (-high / math.tan(main), high), (0.0, high)]
    elif down < 0 and -down >= abs(along) and tool.auxiliary_angle and auxiliary < math.pi / 2:
        long = max(right - end[0], 0.0)
        wedge = [(0.0, 0.0), (long, 0.0), (long, long * math.tan(auxiliary)), (0.0, tool.corner)]
    else:
        return shapely.Polygon()
    return shapely.convex_hull(shapely.MultiPoint((np.array(wedge) + end) * mirror))


class _Taken(NamedTuple):
    area: Any
    depth: float
    place: Floats
    rubs: bool


def _auxiliary(tool: Tool, start: Floats, ahead: Floats, taken: Any) -> list[_Taken]:
    """What meets the auxiliary edge first as the tool goes ahead."""
    _, angle = angles_of(tool)
    edge, outwards = np.array([math.cos(angle), math.sin(angle)]), np.array([math.sin(angle), -math.cos(angle)])
    if ahead @ outwards < 1e-9:
        return []
    across = np.array([ahead[1], -ahead[0]])
    across *= math.copysign(1.0, across @ edge)
    nose = start + tool.corner + tool.corner * outwards
    line = nose + TOLERANCE * across
    corners = [line - FAR * ahead, line + FAR * ahead, line + FAR * (across + ahead), line + FAR * (across - ahead)]
    area = broad(shapely.intersection(taken, shapely.Polygon(corners)), TOLERANCE)
    if area.is_empty:
        return []
    points = shapely.get_coordinates(area)
    off = (points - nose) @ across
    return [_Taken(area, float(off.max()), points[off.argmax()], abs(float(ahead @ edge)) > math.cos(ALONG))]


def _side(tool: Tool, start: Floats, ahead: Floats, taken: Any) -> list[_Taken]:
    """What a blade takes with its sides, deeper than it is wide."""
    area = broad(taken, TOLERANCE)
    if abs(ahead[0]) < abs(ahead[1]) or area.is_empty:
        return []
    points = shapely.get_coordinates(area)
    deep = points[:, 1] - start[1]
    return [_Taken(area, float(deep.max()), points[deep.argmin()], True)] if deep.max() > tool.width + TOLERANCE else []


def _stands(left: Any, taken: Any) -> bool:
    """Whether behind what was taken material stands as high."""
    _, _, right, top = taken.bounds
    wall = shapely.intersection(left, shapely.box(right - TOLERANCE, top - 2 * TOLERANCE, FAR, FAR))
    return bool(wall.area > TOLERANCE * TOLERANCE)
