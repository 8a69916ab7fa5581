"""What stands before the tool of a lathe, at places of its way: exact but for the chords of its nose.

Of the cutting part the edges that go ahead are looked at: what of them lies in the area that the row takes away is in the
material. Across the way that is the depth of cut, and times 2 π r the cross-section.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from mnclab.geometry import shapely
from mnclab.path.profile.motions import along
from mnclab.path.toolpath import Array, Index, Kind
from mnclab.workpiece.ahead import Ahead
from mnclab.workpiece.turning.section import Edge
from mnclab.workpiece.turning.strokes import threads_of

if TYPE_CHECKING:
    from mnclab.workpiece.turning.turned import Turned

CHORDS = 9  # of a quarter of a nose
SIDE = 1e-9  # of an edge, by which it goes ahead


def reach(part: Turned, rows: Index) -> Array:
    """The shares (2, k) of rows between which the tool is in what they take away; arcs may everywhere."""
    found, path = np.zeros((2, len(rows))) + [[0.0], [1.0]], part.cutting.path
    for k, row in enumerate(rows.tolist()):
        if path.kind[row] != Kind.ARC and row in part.areas:
            way = (path.end[row] - path.start[row])[[2, 0]]
            length = float(np.hypot(*way))
            if not length:
                continue  # out of the plane
            spots, tip = shapely.get_coordinates(part.areas[row]) - _place(part, path.start[row]), _body(part, row)
            u = way / length
            front, passed = spots @ u - (tip @ u).max(), spots @ (-u[1], u[0])
            found[:, k] = np.clip(np.array([front.min(), front.max() + np.ptp(passed)]) / length, 0.0, 1.0)  # it may lean back
    return found


def ahead(part: Turned, rows: Index, share: Array) -> Ahead:
    """What stands before the tools of rows (k,) when a share (k,) of their way is behind and a turn before: the less of both,
    for a chip is no shorter than a turn."""
    path = part.cutting.path
    turn = np.nan_to_num(threads_of(path)[0][rows] / path.lengths[rows])
    now, before = _at(part, rows, share), _at(part, rows, (share - turn).clip(0.0))
    return Ahead(*np.where(before.area < now.area, before, now))


def at_most(part: Turned, rows: Index) -> Ahead:
    """No less than `ahead` finds anywhere on rows (k,).

    The edges that go ahead are those of a convex body: across the way they lie beside each other, so that what of them is in
    the area reaches no further across than the area does; on an arc, whose way turns, no further than a line through its box.
    No part of it is further from the axis than the area.
    """
    found, path = Ahead.none(len(rows)), part.cutting.path
    for k, row in enumerate(rows.tolist()):
        if row in part.areas:
            spots, way = shapely.get_coordinates(part.areas[row]), (path.end[row] - path.start[row])[[2, 0]]
            length = float(np.hypot(*way))
            across = np.ptp(spots @ (-way[1], way[0])) / length if path.kind[row] != Kind.ARC and length else 0.0
            found.depth[k] = across or math.hypot(*np.ptp(spots, axis=0))
            found.area[k] = 2 * math.pi * found.depth[k] * np.abs(spots[:, 1]).max()
    return found


def _at(part: Turned, rows: Index, share: Array) -> Ahead:
    found, path = Ahead.none(len(rows)), part.cutting.path
    place, way = along(path, rows, share)
    for row in np.unique(rows).tolist():
        if row not in part.areas:
            continue
        which, body, area = np.flatnonzero(rows == row), _body(part, row), part.areas[row]
        edge = np.roll(body, -1, axis=0) - body
        across = way[which][:, [2, 0]] @ np.array([edge[:, 1], -edge[:, 0]])
        k, e = np.nonzero(across > SIDE * np.hypot(*edge.T))
        start = _place(part, place[which[k]]) + body[e]
        lines = shapely.linestrings(np.stack([start, start + edge[e]], axis=1))
        shapely.prepare(area)
        cut = np.flatnonzero(shapely.intersects(area, lines))
        inside = shapely.intersection(lines[cut], area)
        depth = across[k, e][cut] * shapely.length(inside) / shapely.length(lines[cut])
        np.add.at(found.depth, which[k[cut]], depth)
        np.add.at(found.area, which[k[cut]], 2 * math.pi * depth * np.abs(shapely.get_y(shapely.centroid(inside))))
    return found


def _place(part: Turned, place: Array) -> Array:
    """Places (…, 3) of the path as (z, r)."""
    return np.asarray(place[..., [2, 0]] - (0.0, part.axis))


def _body(part: Turned, row: int) -> Array:
    """The corners (m, 2) of the cutting part about its tip, counter-clockwise, its noses as chords."""
    cutting, ends = part.cutting, (part.cutting.path.start[row], part.cutting.path.end[row])
    start, end = (tuple(_place(part, each).tolist()) for each in ends)
    body: list[Edge] = part.strokes.body_of(cutting.tool(row), start, end)
    counts = [math.ceil(abs(each.sweep) * CHORDS * 2 / math.pi) or 1 for each in body]
    return np.array([each.at(k / count) for each, count in zip(body, counts) for k in range(count)])
