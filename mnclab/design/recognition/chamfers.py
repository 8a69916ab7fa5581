"""Edges that a pointed tool has broken: it goes along a contour of a feature, or of the blank, always as far from it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from mnclab.design.model.features import Chamfer, Face, Hole
from mnclab.design.recognition.areas import ON_EDGE, samples
from mnclab.design.recognition.figures import Found, drawn
from mnclab.design.recognition.outlines import number
from mnclab.design.recognition.sorting import Cone
from mnclab.design.recognition.tracks import distinct
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array
from mnclab.text.alarm import Alarm


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
