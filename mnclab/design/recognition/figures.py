"""What an area that was cleared is called on a drawing: face, stud, slot, pocket, groove, hole; an outline where nothing fits."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from mnclab.design.model.feature import Feature
from mnclab.design.model.features import Chamfer, Face, Groove, Pocket, Slot, Stud
from mnclab.design.model.holes import Hole
from mnclab.design.model.shapes import Circle, Outline, Rectangle
from mnclab.design.recognition.areas import ON_EDGE, THIN, Area, samples
from mnclab.design.recognition.naming import Bow, Stadium, named, number, outline_of
from mnclab.design.recognition.sorting import Cone, Plunge, Work
from mnclab.design.recognition.tracks import Track, coarse, distinct, polygon
from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array
from mnclab.text.alarm import Alarm

ALIKE = 1e-6  # mm, of the rim of an area, by which two areas may differ
MOST = 100  # pieces of a line that a groove goes along


@dataclass
class Found:
    """A feature, the row that first cut it, and what of it others need: the region, and how high it begins and ends, mm."""

    feature: Any  # one of `mnclab.design`
    row: int
    region: Region
    top: float
    floor: float


def figures(area: Area, blank: Region, work: Work, top: float, bottom: float) -> Iterator[Found]:
    """The features that make up an area, one or several studs."""
    above = top if area.top is None else area.top
    depth = number(above - area.floor)

    def found(feature: Feature, region: Region = area.region) -> Found:
        return Found(feature, area.row, region, above, area.floor)

    more: dict[str, Any] = {} if area.top is None else {"top": number(area.top)}
    covers = abs(area.region.loops[0].area - blank.area) < ALIKE * blank.loops[0].length and len(blank.loops) == 1
    if covers and not area.islands:
        yield found(Face(depth, **more))
    elif covers:
        for loop in area.islands:
            yield found(Stud(drawn(loop), depth, **more))
    elif not area.islands and isinstance(area.shape, Circle) and (hole := _hole(area, work, depth, bottom, more)):
        yield found(hole)
    elif not area.islands and isinstance(area.shape, Stadium):
        yield found(Slot(area.shape.start, area.shape.end, area.shape.width, depth, **more))
    elif not area.islands and isinstance(area.shape, Bow):
        line = Outline((area.shape.start, area.shape.end), (area.shape.bulge, 0.0), closed=False)
        yield found(Groove(line, area.shape.width, depth, **more))
    elif not area.islands and isinstance(area.shape, Circle | Rectangle):
        yield found(Pocket(area.shape, depth, **more))
    elif groove := _groove(area, blank, depth, more):
        yield found(groove)
    else:
        yield found(Pocket(drawn(area.region.loops[0]), depth, tuple(map(drawn, area.islands)), **more))


def drawn(loop: Contour) -> Circle | Rectangle | Outline:
    """A loop as a shape of a drawing."""
    shape = named(loop)
    if isinstance(shape, Stadium):
        (x0, y0), (x1, y1) = shape.start, shape.end
        long, turned = math.hypot(x1 - x0, y1 - y0), math.degrees(math.atan2(y1 - y0, x1 - x0))
        long, wide = long + shape.width, shape.width
        if abs(turned) > 45 + 1e-9:
            long, wide, turned = wide, long, turned - math.copysign(90, turned)
        middle = number((x0 + x1) / 2), number((y0 + y1) / 2)
        return Rectangle(*middle, number(long), number(wide), shape.width / 2, number(turned))
    return outline_of(loop) if isinstance(shape, Bow) else shape


def _hole(area: Area, work: Work, depth: float, bottom: float, more: dict[str, Any]) -> Hole | None:
    """A round area that was drilled, plunged or bored by a helix, or goes through; else it is a pocket."""
    circle, tracks = area.shape, distinct(area.tracks)
    drill = next((each for each in work.plunges if _drilled(area, each)), None)
    bored = any(math.dist(each, (circle.x, circle.y, circle.diameter / 2)) < ON_EDGE for each in work.helices)
    through = area.floor <= bottom + ON_EDGE
    if not (through or drill or bored or all(each.stands for each in tracks)):
        return None
    if through:
        return Hole(circle.x, circle.y, circle.diameter, **more)
    return Hole(circle.x, circle.y, circle.diameter, depth, round(drill.angle, 9) if drill else 180.0, **more)


def _drilled(area: Area, plunge: Plunge) -> bool:
    """Whether a pointed tool went down to the floor of a round area with its shoulder."""
    same = abs(2 * plunge.radius - area.shape.diameter) < ON_EDGE and abs(plunge.shoulder - area.floor) < ON_EDGE
    return same and plunge.on(area.shape.x, area.shape.y)


def _groove(area: Area, blank: Region, depth: float, more: dict[str, Any]) -> Groove | None:
    """What one tool leaves along one line that it goes once, or along the closed part of it."""
    tracks = distinct(area.tracks)
    width = number(2 * tracks[0].radius)
    if len(tracks) > MOST or any(abs(2 * each.radius - width) > ON_EDGE or each.stands for each in tracks):
        return None
    for chain in _chains(tracks):
        line = _joined(chain)
        shape = named(line) if line.closed else line
        try:
            groove = Groove(line if isinstance(shape, Stadium | Bow) else shape, width, depth, **more)
        except Alarm:  # it crosses itself: no groove of a drawing
            continue
        if len(chain) == len(tracks) or _covers(chain, area, blank):
            return groove
    return None


def _covers(chain: list[Track], area: Area, blank: Region) -> bool:
    """Whether some of the tracks of an area sweep all of it."""
    rest = polygon(area.region).difference(shapely.union_all(coarse(chain)).buffer(THIN))
    return bool(rest.intersection(polygon(blank)).buffer(-THIN / 2).is_empty)


def _chains(tracks: list[Track]) -> Iterator[list[Track]]:
    """All tracks, if each begins where the one before ends; then what of them comes back to where it began."""
    for one, other in pairwise(tracks):
        if math.dist(one.end, other.start) > ON_EDGE:
            return
    yield tracks
    for first in range(len(tracks)):
        for last in range(len(tracks) - 1, first, -1):
            if math.dist(tracks[first].start, tracks[last].end) <= ON_EDGE and (first or last < len(tracks) - 1):
                yield tracks[first : last + 1]
                return


def _joined(chain: list[Track]) -> Contour:
    """The line of a chain of tracks."""
    points, bulge = list[Any](), list[float]()
    for each in chain:
        points += each.line.points[:-1].tolist()
        bulge += each.line.bulge[:-1].tolist()
    if math.dist(chain[0].start, chain[-1].end) <= ON_EDGE:
        return Contour(points, bulge)
    return Contour([*points, chain[-1].end], [*bulge, 0.0], closed=False)


# Edges that a pointed tool has broken: it goes along a contour of a feature, or of the blank, always as far from it.


def chamfers(found: list[Found], cones: list[Cone], blank: Region, top: float) -> tuple[list[Found], list[int]]:
    """The chamfers, and the rows of pointed tools that cut something else."""
    made, rows = list[Found](), list[int]()
    for cone in cones:
        tracks = distinct(list(cone.tracks))
        ways = [each.line for each in tracks]
        edges = list[Found]()
        for loop, above, inside in _edges(found, blank, top):
            reach = min((above - cone.tip) / cone.slope, cone.radius)
            if reach <= 0:
                continue
            off = np.min([way.distance(samples(loop)) for way in ways], axis=0)
            width, deep = reach - float(off.mean()), above - cone.tip
            if np.ptp(off) > ON_EDGE or width < ON_EDGE or deep > cone.radius * cone.slope + ON_EDGE:
                continue
            angle = round(2 * math.degrees(math.atan2(1.0, cone.slope)), 9)
            more: dict[str, Any] = {} if abs(above - top) < ON_EDGE else {"top": number(above)}
            try:
                chamfer = Chamfer(drawn(loop), number(width), angle, inside, **more)
            except Alarm:
                continue
            edges.append(Found(chamfer, min(each.row for each in tracks), Region((loop,)), above, above - chamfer.height))
        made += edges
        if not edges:
            rows += [each.row for each in tracks if _cuts(cone, each.line, found, top)]
    return made, rows


def _edges(found: list[Found], blank: Region, top: float) -> Iterator[tuple[Contour, float, bool]]:
    """Contours with material on one side of their upper rim: their height, and whether the material is within."""
    faced = min((each.floor for each in found if isinstance(each.feature, Face)), default=top)
    for loop in blank.loops:
        yield loop, faced, loop.area > 0
    for each in found:
        if isinstance(each.feature, Face):
            continue
        hole = each.feature if isinstance(each.feature, Hole) else None
        above = each.top - (hole.counterbore[1] if hole and hole.counterbore else 0.0)
        for loop in each.region.loops:
            yield loop, above, loop.area < 0
        if hole and hole.counterbore:
            yield Contour.circle((hole.x, hole.y), hole.counterbore[0] / 2), each.top, False


def _cuts(cone: Cone, way: Contour, found: list[Found], top: float) -> bool:
    """Whether a way goes over material that stands higher than the tip."""
    spots: Array = way.points
    free = np.zeros(len(spots), dtype=bool)
    for each in found:
        if each.floor <= cone.tip + ON_EDGE:
            free |= each.region.contains(spots)
    return not bool(free.all())
