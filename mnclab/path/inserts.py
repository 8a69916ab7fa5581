"""The tool of a lathe in the plane of z and r, about its programmed tip: what of it cuts, and the holder behind it.

The programmed tip is the imaginary sharp point: the nose touches the z and the r of the tip. The main edge leans from
the axis by the main angle, against the feed towards the chuck; the other one by the auxiliary angle. Between them lies
the insert, an area to the left of its contour:

    main 95, auxiliary 5:      Q----.       a blade:  |    |      r
       an insert of 80        /    /                  |    |      |
                             L---R´                   T----'      +-- z
                            T                         T is its left corner

Boring bars cut outwards and are mirrored in r, left-hand tools in z; of a threading insert the tip is the middle of its V.
A drill lies on both sides of its axis. Lengths in mm, angles of a tool in degrees; contours have points (z, r).
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, at_angle, length_of
from mnclab.path.tool import LATHE, POINTED, Tool
from mnclab.path.toolpath import Kind, Mask, Toolpath

EDGE = 12.0  # length of an edge that the table does not give: the usual insert, a C of 12 (ISO 1832)
BLADE = 8.0  # widths: how deep a blade reaches whose table does not say it, as catalogues have it for grooving and parting
USUAL = (95.0, 5.0)  # degrees, where the table has none: an insert of 80 degrees (ISO 1832, C) in its holder (ISO 5608, L)
SAME = 1e-12
FACE = "face grooving"  # a blade across: what is Z of another one is its r
BLADES = ("grooving", FACE)
THREAD = 60.0  # degrees between the flanks of a metric or a unified thread (ISO 68-1)


def turns(tool: Tool) -> bool:
    """Whether a tool has an insert; else it turns about its own axis, as a drill does."""
    return tool.kind in LATHE or not tool.kind


def as_drawn(tool: Tool, lead: float = 0.0) -> Tool:
    """A tool with the shape that it cuts and is drawn with, where it makes a thread of a `lead`, mm (0: not known).

    A threading insert is a V of its `angle`, else of `THREAD`, about the axis of the thread, or beside the one angle that
    it gives. As wide as its `width`, else its flanks are as long as `cutting_length` or the lead: a sharp thread of 60
    degrees. With both angles and a width it is a trapezoid. A tool without kind and shape that cuts a thread has this V.
    """
    main, auxiliary = tool.main_angle, tool.auxiliary_angle
    shaped = main and auxiliary if tool.kind == "thread" else tool.kind or tool.width or main or auxiliary or not lead > 0
    if shaped:
        return tool
    rest = 180 - (tool.angle if 0 < tool.angle < 180 else THREAD)
    if main or auxiliary:
        other = 180 - (main or auxiliary)
        main, auxiliary = (each or max(rest - (main or auxiliary), min(USUAL[1], other / 2)) for each in (main, auxiliary))
    else:
        main = auxiliary = rest / 2
    across = math.cos(math.radians(main)) + math.cos(math.radians(auxiliary))
    wide = tool.width / across if tool.width and across > SAME else 0.0
    edges = wide or tool.cutting_length or (lead if lead > 0 else 0.0)
    return replace(tool, kind="thread", main_angle=main, auxiliary_angle=auxiliary, cutting_length=edges, width=0.0)


def usual(tool: Tool) -> Tool:
    """An insert with the angles that its table leaves out: those of `USUAL`, or of the V of a thread; blades have none."""
    tool = as_drawn(tool)
    if not turns(tool) or tool.width or tool.kind in (*BLADES, "thread") or tool.main_angle and tool.auxiliary_angle:
        return tool
    auxiliary = tool.auxiliary_angle or min(USUAL[1], (180 - tool.main_angle) / 2)
    return replace(tool, main_angle=tool.main_angle or min(USUAL[0], 0.9 * (180 - auxiliary)), auxiliary_angle=auxiliary)


def edgeless(tool: Tool, lathe: bool) -> str:
    """What a tool lacks so that it has no edge to cut with, in words; empty where it has one."""
    if lathe and turns(tool):
        blade = tool.kind in BLADES and not (tool.width or tool.corner or tool.main_angle or tool.auxiliary_angle)
        return "no width" if blade else ""
    return "" if tool.effective_radius > 0 or tool.kind == "probe" else "no radius"


def lead_of(path: Toolpath, rows: Mask) -> float:
    """The lead, mm, of the thread that the last cut of some rows (n,) makes; 0 where it makes none."""
    cuts = np.flatnonzero(((path.kind == Kind.LINE) | (path.kind == Kind.ARC)) & rows)
    if not len(cuts) or not path.synchronous[cuts[-1]]:
        return 0.0
    return float(np.nan_to_num(path.per_rev[cuts[-1]], posinf=0.0))


def angles_of(tool: Tool) -> tuple[float, float]:
    """Main and auxiliary cutting-edge angle, rad; one that the tool table does not give restricts nothing.

    It is 90 degrees, or what the other one leaves of 180.
    """
    main, auxiliary = tool.main_angle, tool.auxiliary_angle
    main, auxiliary = main or min(90.0, 180 - auxiliary), auxiliary or min(90.0, 180 - main)
    return math.radians(main), math.radians(auxiliary)


def edges_of(tool: Tool, height: float) -> Floats:
    """What a sharp tool covers above its tip up to a height, (k, 2) from the tip; without angles and width it is a line."""
    main, auxiliary = angles_of(tool)
    lean = [0.0 if abs(math.tan(a)) > 1e12 else height / math.tan(a) for a in (main, auxiliary)]
    return np.array([(0.0, 0.0), (tool.width, 0.0), (tool.width + lean[1], height), (-lean[0], height)])


def cutting_part(tool: Tool, height: float) -> Contour:
    """What of a tool takes material away, prolonged away from the part up to a height above its tip: convex.

    An edge is as long as `edge_length` says; beyond it the insert goes on, straight up where it leaned out. So the part is what
    the way of the tip makes of it, however deep: what only the prolonged edges take is a collision of the tool, not a step
    in the part. A blade without width and nose is a line, a contour of two points.
    """
    if not turns(tool):
        return _round(tool, height)
    points, bulges, ahead, behind = _sides(usual(tool), height)
    return _placed(tool, np.vstack([points, behind, ahead[::-1]]), bulges)


def edge_length(tool: Tool) -> float:
    """The length of the edges of an insert, mm, from the tip; of a blade how deep it reaches. Usual ones where none is given."""
    blade = tool.kind != "thread" and BLADE * tool.width
    return tool.cutting_length or blade or EDGE


class Beyond(NamedTuple):
    """A side of a tool where its edge has ended: the `line` from there on (2, 2), which way it looks and its edge runs (2,)."""

    line: Floats
    outwards: Floats
    edge: Floats


def beyond_edges(tool: Tool, height: float) -> tuple[Floats, list[Beyond]]:
    """Of an insert: the corners (k, 2) of its nose and its edges, and what of its cutting part goes on where these end."""
    tool, sides = usual(tool), list[Beyond]()
    points, _, *rays = _sides(tool, height)
    corners, long, mirror = points, edge_length(tool), mirror_of(tool)
    main, auxiliary = angles_of(tool)
    for start, ray, angle, turn in zip(points[[0, -1]], rays, (math.pi - main, auxiliary), (1.0, -1.0)):
        edge = at_angle(angle)
        end = start + min(max(long - float(start @ edge), 0.0), float((ray[0] - start) @ edge)) * edge
        corners = np.vstack([corners, end])
        for line in np.stack([np.vstack([end, ray[:-1]]), ray], axis=1):
            if length := float(np.hypot(*(line[1] - line[0]))):
                outwards = turn * (line[1] - line[0])[::-1] * (-1, 1) / length
                sides.append(Beyond(line * mirror, outwards * mirror, edge * mirror))
    return corners * mirror, sides


def _sides(tool: Tool, height: float) -> tuple[Floats, list[float], Floats, Floats]:
    """The nose, its points (k, 2) and their bulges, and from its ends the main edge and the other one, each (k, 2)."""
    main, auxiliary = angles_of(tool)
    points, bulges = _nose(tool, main, auxiliary)
    height = max(height, float(points[:, 1].max()))
    behind = _ray(points[-1], auxiliary, 1.0, edge_length(tool), height)
    ahead = _ray(points[0], math.pi - main, -1.0, edge_length(tool), height)
    if (far := float(ahead[-1, 0])) > behind[-1, 0]:  # a main edge that leans back over the insert: the other one is longer
        behind = np.array([(far, points[-1, 1] + (far - points[-1, 0]) * math.tan(auxiliary)), (far, height)])
    return points, bulges, ahead, behind


def insert(tool: Tool, size: float = 0.0, reach: float = 0.0) -> Contour:
    """The insert itself, its edges `size` long (0: as in `cutting_part`), a blade at least `reach`; a drill that long."""
    tool = usual(tool)
    size = size or tool.cutting_length or EDGE
    if not turns(tool):
        return _round(tool, max(size, reach))
    if tool.width or tool.kind in BLADES:
        high = max(1.6 * size, min(1.5 * tool.width, 2.4 * size), reach)
        return cutting_part(replace(tool, cutting_length=max(high, 1.0)), high)
    if tool.kind == "thread" and tool.cutting_length:  # ground down beside its teeth, so that it comes near a shoulder
        return cutting_part(tool, max(size, 1.5 * tool.cutting_length))
    main, auxiliary = angles_of(tool)
    points, bulges = _nose(tool, main, auxiliary)
    lead, trail = size * at_angle(math.pi - main), size * at_angle(auxiliary)
    return _placed(tool, np.vstack([points, points[-1] + trail, points[0] + lead + trail, points[0] + lead]), bulges)


def holder(tool: Tool, size: float = 0.0, reach: float = 0.0) -> Floats:
    """The holder behind the insert, corners (k, 2), as far as a picture of this size shows it.

    Of an outside tool it stands across the axis, of a boring bar it lies along it.
    """
    tool = usual(tool)
    size = size or tool.cutting_length or EDGE
    if not turns(tool):
        wide = tool.shank[0] if tool.shank else tool.effective_radius
        return np.array([(0.0, -wide), (size, -wide), (size, wide), (0.0, wide)]) + (max(size, reach), 0.0)
    if tool.width or tool.kind in BLADES:
        high = max(1.6 * size, min(1.5 * tool.width, 2.4 * size), reach)
        left, right = np.array([0.0, high]), np.array([tool.width, high])
        corners = np.array([left, right, right + (0.7 * size, 0.3 * size), right + (0.7 * size, size), left + (0.0, size)])
    elif tool.kind == "boring":
        deep = 2 * tool.shank[0] if tool.shank else 1.2 * size
        corners = np.array([(0.3 * size, 0.2 * size), (4 * size, 0.2 * size), (4 * size, 0.2 * size + deep)])
        corners = np.vstack([corners, (0.3 * size, 0.2 * size + deep)])
    elif tool.kind == "thread" and tool.cutting_length:
        front, high = float(insert(tool, size).bounds[0, 0]), 0.8 * max(size, 1.5 * tool.cutting_length)
        back = front + 0.8 * size
        corners = np.array([(front, high), (back, high), (back, 2.5 * high), (front, 2.5 * high)])
    else:
        outline = insert(replace(tool, corner=0.0, kind="turning", hand="right"), size).points
        corners = outline.mean(axis=0) + size * np.array([(-0.25, 0.0), (0.55, 0.0), (0.55, 1.5), (-0.25, 1.5)])
    return (corners[:, ::-1] if tool.kind == FACE else corners) * mirror_of(tool)


def _nose(tool: Tool, main: float, auxiliary: float) -> tuple[Floats, list[float]]:
    """The lower side from the main edge to the other one: points (k, 2), and the bulges between them."""
    nose = tool.corner if not tool.width else min(tool.corner, tool.width / 2)
    first, last = np.array([nose, nose]), np.array([max(tool.width - nose, nose), nose])
    if tool.kind == "thread" and not tool.width:
        first = last = np.array([0.0, nose])
    ends = [first + nose * at_angle(-math.pi / 2 - main), last + nose * at_angle(auxiliary - math.pi / 2)]
    if first[0] == last[0]:
        return (np.array(ends), [math.tan((main + auxiliary) / 4)]) if nose else (np.array(ends[:1]), [])
    below = [first - (0.0, nose), last - (0.0, nose)]
    if not nose:
        return np.array(below), [0.0]
    return np.array([ends[0], *below, ends[1]]), [math.tan(main / 4), 0.0, math.tan(auxiliary / 4)]


def _ray(start: Floats, angle: float, side: float, edge: float, height: float) -> Floats:
    """An edge from its beginning away from the tip: one that leans out to its side ends and goes on straight up.

    Its length counts from the tip.
    """
    ahead = at_angle(angle)
    ahead = np.where(np.abs(ahead) < SAME, 0.0, ahead)
    way, edge = (height - start[1]) / ahead[1], max(edge - float(start @ ahead), 0.0)
    if side * ahead[0] < SAME or way <= edge:
        return np.array([start + way * ahead])
    knee = start + edge * ahead
    return np.array([knee, (knee[0], height)])


def _round(tool: Tool, height: float) -> Contour:
    """Half a section of a tool that turns about its own axis, on both sides of it: its tip, its point, straight back."""
    radius = tool.effective_radius
    angle = tool.angle or POINTED.get(tool.kind, 0.0)
    point = radius / math.tan(math.radians(angle) / 2) if 0 < angle < 180 else 0.0
    long = max(height, point + 1.0)
    corners = [(point, -radius), (long, -radius), (long, radius), (point, radius)]
    return Contour([*corners, (0.0, 0.0)] if point else corners)


def mirror_of(tool: Tool) -> Floats:
    """What z and r are multiplied with so that a tool becomes a right-hand one for outside, and back (2,)."""
    return np.array([-1.0 if tool.hand == "left" else 1.0, -1.0 if tool.kind == "boring" else 1.0])


def _placed(tool: Tool, points: Floats, bulges: list[float]) -> Contour:
    """A contour that begins with the nose, without points that come twice, mirrored as its tool is."""
    bulge = np.zeros(len(points))
    bulge[: len(bulges)] = bulges
    some = length_of(np.roll(points, -1, axis=0) - points) > 1e-9
    mirror, points = mirror_of(tool), points[:, ::-1] if tool.kind == FACE else points
    turned = mirror.prod() * (-1 if tool.kind == FACE else 1)
    contour = Contour(points[some] * mirror, bulge[some] * turned)
    return contour if turned > 0 else contour.reversed()
