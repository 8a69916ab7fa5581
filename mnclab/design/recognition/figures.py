"""What an area that was cleared is called on a drawing: face, stud, slot, pocket, groove, hole; an outline where nothing fits."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np

from mnclab.design.model.feature import Feature
from mnclab.design.model.features import Chamfer, Face, Groove, Pocket, Slot, Stud
from mnclab.design.model.holes import Hole, core_of
from mnclab.design.model.shapes import Circle, Outline, Rectangle
from mnclab.design.recognition.areas import ON_EDGE, THIN, Area, Track, coarse, distinct, polygon, samples
from mnclab.design.recognition.naming import ArcSlot, StraightSlot, designation, named, number, outline_of
from mnclab.design.recognition.sorting import Cone, MillWork, Plunge, Threaded
from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array
from mnclab.text.alarm import Alarm

ALIKE = 1e-6  # mm, of the rim of an area, by which two areas may differ
MOST = 100  # pieces of a line that a groove goes along


@dataclass
class Recognised:
    """A feature, the row that first cut it, and what of it others need: the region, and how high it begins and ends, mm."""

    feature: Any  # one of `mnclab.design`
    row: int
    region: Region
    top: float
    floor: float


def figures(area: Area, blank: Region, work: MillWork, top: float, bottom: float) -> Iterator[Recognised]:
    """The features that make up an area, one or several studs."""
    above = top if area.top is None else area.top
    depth = number(above - area.floor)

    def found(feature: Feature, region: Region = area.region) -> Recognised:
        return Recognised(feature, area.row, region, above, area.floor)

    more: dict[str, Any] = {} if area.top is None else {"top": number(area.top)}
    covers = abs(area.region.loops[0].area - blank.area) < ALIKE * blank.loops[0].length and len(blank.loops) == 1
    if covers and not area.islands:
        yield found(Face(depth, **more))
    elif covers:
        for loop in area.islands:
            yield found(Stud(drawn(loop), depth, **more))
    elif not area.islands and isinstance(area.shape, Circle) and (hole := _hole(area, work, depth, bottom, more)):
        yield found(hole)
    elif not area.islands and isinstance(area.shape, StraightSlot):
        yield found(Slot(area.shape.start, area.shape.end, area.shape.width, depth, **more))
    elif not area.islands and isinstance(area.shape, ArcSlot):
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
    if isinstance(shape, StraightSlot):
        (x0, y0), (x1, y1) = shape.start, shape.end
        long, turned = math.hypot(x1 - x0, y1 - y0), math.degrees(math.atan2(y1 - y0, x1 - x0))
        long, wide = long + shape.width, shape.width
        if abs(turned) > 45 + 1e-9:
            long, wide, turned = wide, long, turned - math.copysign(90, turned)
        middle = number((x0 + x1) / 2), number((y0 + y1) / 2)
        return Rectangle(*middle, number(long), number(wide), shape.width / 2, number(turned))
    return outline_of(loop) if isinstance(shape, ArcSlot) else shape


def _hole(area: Area, work: MillWork, depth: float, bottom: float, more: dict[str, Any]) -> Hole | None:
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
            groove = Groove(line if isinstance(shape, StraightSlot | ArcSlot) else shape, width, depth, **more)
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


def chamfers(found: list[Recognised], cones: list[Cone], blank: Region, top: float) -> tuple[list[Recognised], list[int]]:
    """The chamfers, and the rows of pointed tools that cut something else."""
    made, rows = list[Recognised](), list[int]()
    for cone in cones:
        tracks = distinct(list(cone.tracks))
        ways = [each.line for each in tracks]
        edges = list[Recognised]()
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
            edges.append(Recognised(chamfer, min(each.row for each in tracks), Region((loop,)), above, above - chamfer.height))
        made += edges
        if not edges:
            rows += [each.row for each in tracks if _cuts(cone, each.line, found, top)]
    return made, rows


def _edges(found: list[Recognised], blank: Region, top: float) -> Iterator[tuple[Contour, float, bool]]:
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


def _cuts(cone: Cone, way: Contour, found: list[Recognised], top: float) -> bool:
    """Whether a way goes over material that stands higher than the tip."""
    spots: Array = way.points
    free = np.zeros(len(spots), dtype=bool)
    for each in found:
        if each.floor <= cone.tip + ON_EDGE:
            free |= each.region.contains(spots)
    return not bool(free.all())


# Holes put together: what several tools do on one axis is one hole with its counterbore, countersink and thread.

WIDER = 1.15, 2.5  # by which a counterbore is wider than its hole
FLAT = 180.0


def together(found: list[Recognised], work: MillWork, top: float, bottom: float) -> tuple[list[Recognised], list[str], list[int]]:
    """The features with their holes put together; notes; rows of points that no hole has."""
    found = [each for each in found if not (isinstance(each.feature, Hole) and _swallowed(each, found))]
    found = _counterbored(found)
    rows = [each.row for each in work.plunges if not _taken(each, found, top)]
    found = [_countersunk(each, work) for each in found]
    notes = list[str]()
    for thread in work.threads:
        notes += _thread(thread, found, top, bottom)
    return found, notes, rows


def _profile(hole: Hole, found: Recognised, away: float) -> float:
    """The height of the bottom of a hole at a distance from its axis, mm."""
    if hole.depth is None:
        return -math.inf
    return found.floor - hole.tip * (1 - 2 * away / hole.wide)


def _swallowed(one: Recognised, found: list[Recognised]) -> bool:
    """Whether a wider hole on the same axis is as deep all over."""
    hole = one.feature
    for other in found:
        wider = other.feature
        if other is one or not isinstance(wider, Hole) or not _coaxial(hole, wider) or wider.wide < hole.wide + ON_EDGE:
            continue
        if all(_profile(wider, other, away) <= _profile(hole, one, away) + ON_EDGE for away in (0.0, hole.wide / 2)):
            return True
    return False


def _coaxial(one: Hole | Circle, other: Hole | Circle) -> bool:
    return math.hypot(one.x - other.x, one.y - other.y) < ON_EDGE


def _round(each: Recognised) -> tuple[Hole | Circle, float] | None:
    """The axis and diameter of a flat round recess."""
    feature = each.feature
    if isinstance(feature, Pocket) and isinstance(feature.contour, Circle) and not feature.islands:
        return feature.contour, feature.contour.diameter
    if isinstance(feature, Hole) and feature.depth is not None and feature.point == FLAT:
        return feature, feature.wide
    return None


def _counterbored(found: list[Recognised]) -> list[Recognised]:
    """Holes with the flat recess that is a little wider, from which they begin."""
    gone = list[Recognised]()
    for each in sorted(found, key=lambda each: each.floor):
        hole = each.feature
        if not isinstance(hole, Hole) or each in gone:
            continue
        for other in found:
            flat = _round(other)
            if flat is None or other is each or not _coaxial(hole, flat[0]) or abs(other.floor - each.top) > ON_EDGE:
                continue
            if WIDER[0] <= flat[1] / hole.wide <= WIDER[1]:
                depth = None if hole.depth is None else number(other.top - each.floor)
                bore = flat[1], number(other.top - other.floor)
                each.feature = replace(hole, depth=depth, counterbore=bore, top=other.feature.top)
                each.top = other.top
                gone.append(other)
                break
    return [each for each in found if not any(each is other for other in gone)]


def _seat(each: Recognised) -> float:
    """The height at which the hole itself begins, in its counterbore."""
    return each.top - (each.feature.counterbore[1] if each.feature.counterbore else 0.0)


def _countersunk(each: Recognised, work: MillWork) -> Recognised:
    """A hole with the cone of a pointed tool at its rim, the widest."""
    hole = each.feature
    if isinstance(hole, Hole):
        for plunge in work.plunges:
            wide = number(2 * (_seat(each) - plunge.tip) / plunge.slope) if plunge.on(hole.x, hole.y) else 0.0
            known = hole.countersink[0] if hole.countersink else hole.wide
            most = hole.counterbore[0] if hole.counterbore else math.inf
            if known + ON_EDGE < wide <= min(2 * plunge.radius, most) + ON_EDGE and not _is_drill_of(each, plunge):
                hole = replace(hole, countersink=(wide, round(plunge.angle, 9)))
        each.feature = hole
    return each


def _is_drill_of(each: Recognised, plunge: Plunge) -> bool:
    """Whether it is the tool that made the hole."""
    return abs(2 * plunge.radius - each.feature.wide) < ON_EDGE


def _taken(plunge: Plunge, found: list[Recognised], top: float) -> bool:
    """Whether what a pointed tool takes away on its axis is told by a feature."""
    for each in found:
        hole = each.feature
        if isinstance(hole, Hole) and plunge.on(hole.x, hole.y) and hole.wide > 2 * plunge.radius - ON_EDGE:
            return plunge.shoulder < top - ON_EDGE or each.floor <= plunge.tip + ON_EDGE
        if each.floor <= plunge.tip + ON_EDGE and each.region.contains([(plunge.x, plunge.y)])[0]:
            return True
    return False


def _thread(thread: Threaded, found: list[Recognised], top: float, bottom: float) -> list[str]:
    """Gives a thread to the hole that it is cut in; a note where there is none and it is cut outside."""
    name, here = designation(thread.diameter, thread.pitch), [each for each in found if _on_axis(each, thread)]
    if not name:
        return [f"a thread {thread.diameter:g} at ({thread.x:g}, {thread.y:g}) has no pitch that is known"]
    holes = [each for each in here if not isinstance(each.feature, Groove)]
    fitting = [each for each in holes if core_of(name, 2) - ON_EDGE <= _round_of(each)[1] < thread.diameter + ON_EDGE]
    if fitting:
        each = max(fitting, key=lambda each: _round_of(each)[1])
        axis, wide = _round_of(each)
        hole = each.feature if isinstance(each.feature, Hole) else None
        depth = None if each.floor <= bottom + ON_EDGE else number(each.top - each.floor)
        deep = number(each.top - thread.tip)
        whole = depth is not None and deep >= depth - ON_EDGE or thread.tip <= bottom + ON_EDGE
        if hole is None:
            hole = Hole(axis.x, axis.y, wide, depth, FLAT, top=each.feature.top)
        each.feature = replace(hole, thread=name, thread_depth=None if whole else deep)
        return []
    if thread.bend > thread.radius + ON_EDGE:
        outside = designation(2 * (thread.bend - thread.radius), thread.pitch)
        return [f"the thread {outside} at ({thread.x:g}, {thread.y:g}) is cut outside: no feature has it"]
    over = [each.floor for each in found if each.floor > thread.tip and each.region.contains([(thread.x, thread.y)])[0]]
    above = min(over, default=top)
    through = thread.tip <= bottom + ON_EDGE
    more: dict[str, Any] = {} if above == top else {"top": number(above)}
    depth = None if through else number(above - thread.tip)
    hole = Hole(thread.x, thread.y, None, depth, FLAT, thread=name, **more)
    for ring in here:  # what was milled about the hole before it, or after
        if isinstance(ring.feature, Groove) and _round_of(ring)[1] - 2 * ring.feature.width < hole.wide and ring.top == above:
            hole = replace(hole, counterbore=(_round_of(ring)[1], number(above - ring.floor)))
            found[:] = [each for each in found if each is not ring]
    region = Region((Contour.circle((thread.x, thread.y), hole.wide / 2),))
    found.append(Recognised(hole, thread.row, region, above, max(thread.tip, bottom)))
    return []


def _round_of(each: Recognised) -> tuple[Hole | Circle, float]:
    """Axis and outer diameter of a hole, a round pocket or a ring."""
    feature = each.feature
    if isinstance(feature, Hole):
        return feature, feature.wide
    return feature.contour, feature.contour.diameter + (feature.width if isinstance(feature, Groove) else 0.0)


def _on_axis(each: Recognised, thread: Threaded) -> bool:
    feature = each.feature
    if not isinstance(feature, Hole) and not (isinstance(feature, Pocket | Groove) and isinstance(feature.contour, Circle)):
        return False
    axis = _round_of(each)[0]
    return math.hypot(axis.x - thread.x, axis.y - thread.y) < ON_EDGE
