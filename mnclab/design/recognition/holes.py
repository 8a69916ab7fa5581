"""Holes put together: what several tools do on one axis is one hole with its counterbore, countersink and thread."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from mnclab.design.model.features import Groove, Pocket
from mnclab.design.model.holes import Hole, core_of
from mnclab.design.model.shapes import Circle
from mnclab.design.recognition.areas import ON_EDGE
from mnclab.design.recognition.figures import Found
from mnclab.design.recognition.naming import designation, number
from mnclab.design.recognition.sorting import Plunge, Threaded, Work
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region

WIDER = 1.15, 2.5  # by which a counterbore is wider than its hole
FLAT = 180.0


def together(found: list[Found], work: Work, top: float, bottom: float) -> tuple[list[Found], list[str], list[int]]:
    """The features with their holes put together; notes; rows of points that no hole has."""
    found = [each for each in found if not (isinstance(each.feature, Hole) and _swallowed(each, found))]
    found = _counterbored(found)
    rows = [each.row for each in work.plunges if not _taken(each, found, top)]
    found = [_countersunk(each, work) for each in found]
    notes = list[str]()
    for thread in work.threads:
        notes += _thread(thread, found, top, bottom)
    return found, notes, rows


def _profile(hole: Hole, found: Found, away: float) -> float:
    """The height of the bottom of a hole at a distance from its axis, mm."""
    if hole.depth is None:
        return -math.inf
    return found.floor - hole.tip * (1 - 2 * away / hole.wide)


def _swallowed(one: Found, found: list[Found]) -> bool:
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


def _round(each: Found) -> tuple[Hole | Circle, float] | None:
    """The axis and diameter of a flat round recess."""
    feature = each.feature
    if isinstance(feature, Pocket) and isinstance(feature.contour, Circle) and not feature.islands:
        return feature.contour, feature.contour.diameter
    if isinstance(feature, Hole) and feature.depth is not None and feature.point == FLAT:
        return feature, feature.wide
    return None


def _counterbored(found: list[Found]) -> list[Found]:
    """Holes with the flat recess that is a little wider, from which they begin."""
    gone = list[Found]()
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


def _seat(each: Found) -> float:
    """The height at which the hole itself begins, in its counterbore."""
    return each.top - (each.feature.counterbore[1] if each.feature.counterbore else 0.0)


def _countersunk(each: Found, work: Work) -> Found:
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


def _is_drill_of(each: Found, plunge: Plunge) -> bool:
    """Whether it is the tool that made the hole."""
    return abs(2 * plunge.radius - each.feature.wide) < ON_EDGE


def _taken(plunge: Plunge, found: list[Found], top: float) -> bool:
    """Whether what a pointed tool takes away on its axis is told by a feature."""
    for each in found:
        hole = each.feature
        if isinstance(hole, Hole) and plunge.on(hole.x, hole.y) and hole.wide > 2 * plunge.radius - ON_EDGE:
            return plunge.shoulder < top - ON_EDGE or each.floor <= plunge.tip + ON_EDGE
        if each.floor <= plunge.tip + ON_EDGE and each.region.contains([(plunge.x, plunge.y)])[0]:
            return True
    return False


def _thread(thread: Threaded, found: list[Found], top: float, bottom: float) -> list[str]:
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
    found.append(Found(hole, thread.row, region, above, max(thread.tip, bottom)))
    return []


def _round_of(each: Found) -> tuple[Hole | Circle, float]:
    """Axis and outer diameter of a hole, a round pocket or a ring."""
    feature = each.feature
    if isinstance(feature, Hole):
        return feature, feature.wide
    return feature.contour, feature.contour.diameter + (feature.width if isinstance(feature, Groove) else 0.0)


def _on_axis(each: Found, thread: Threaded) -> bool:
    feature = each.feature
    if not isinstance(feature, Hole) and not (isinstance(feature, Pocket | Groove) and isinstance(feature.contour, Circle)):
        return False
    axis = _round_of(each)[0]
    return math.hypot(axis.x - thread.x, axis.y - thread.y) < ON_EDGE
