"""How deep and how wide a mill is in the material that stands before it, at places of its way.

At a place the front half of the rim is looked at, degree by degree: what stands higher there than the tip, before the row
began, is cut. With θ from the heading and the radius R the width of cut is ae = R ∫ cos θ dθ over the engaged part. Exact but
for the degree, and where an arc is tighter than the tool.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.path.columns import Array, Index
from mnclab.path.kinds import Kind
from mnclab.path.toolpath import Toolpath
from mnclab.workpiece.milling.before import Points, depths
from mnclab.workpiece.milling.milled import Milled

STATIONS = 60  # places, one a row
RIM = np.radians(np.arange(-89.5, 90.0, 1.0))
STEP, INSIDE, LEAST = np.radians(1.0), 1 - 1e-6, 1e-3


class Engaged(NamedTuple):
    """Of some rows (k,) in their middles: the engaged `angle` rad, the `width` ae and the `depth` ap of cut, mm."""

    row: Index
    angle: Array
    width: Array
    depth: Array


def engaged(part: Milled, rows: Index, most: int = STATIONS) -> Engaged:
    """Of at most so many of some rows, those at equal distances of the way; places where nothing is cut are left out."""
    path, moves = part.cutting.path, part.moves
    rows = rows[np.isin(rows, moves.row)]
    if len(rows) > most:
        way = np.cumsum(path.lengths[rows])
        rows = rows[np.unique(np.searchsorted(way, way[-1] * (np.arange(most) + 0.5) / most).clip(0, len(rows) - 1))]
    place, heading = _middles(path, rows)
    radius = np.array([tool.effective_radius for tool in part.cutting.tools])[part.cutting.which[rows]]
    angle = np.arctan2(heading[:, 1], heading[:, 0])[:, None] + RIM
    x = place[:, :1] + INSIDE * radius[:, None] * np.cos(angle)
    y = place[:, 1:2] + INSIDE * radius[:, None] * np.sin(angle)
    first = np.searchsorted(moves.row, rows)
    count = np.ones(x.shape, dtype=np.int64)
    at = Points(x.ravel(), y.ravel(), np.repeat(place[:, 2], len(RIM)), (first[:, None] * count).ravel(), count.ravel())
    floor, top = part.cutting.stock.faces(at.x, at.y)
    at = at._replace(low=np.fmax(at.low, floor))
    deep = depths(moves, moves.boxes, at, np.where(np.isnan(top), -np.inf, top)).reshape(x.shape)
    cuts = deep > LEAST
    width = radius * (cuts * np.cos(RIM)).sum(axis=1) * STEP
    found = Engaged(rows, cuts.sum(axis=1) * STEP, width, deep.max(axis=1, initial=0.0))
    return Engaged._make(column[cuts.any(axis=1)] for column in found)


def _middles(path: Toolpath, rows: Index) -> tuple[Array, Array]:
    """Where the tip is in the middle of rows, and which way it goes (k, 3)."""
    start, end = path.start[rows], path.end[rows]
    place, heading = (start + end) / 2, end - start
    for k in np.flatnonzero(path.kind[rows] == Kind.ARC):
        row = rows[k]
        axis, half = path.axis[row], path.sweep[row] / 2
        arm = start[k] - path.centre[row]
        arm = arm - (arm @ axis) * axis
        turned = arm * np.cos(half) + np.cross(axis, arm) * np.sin(half)
        place[k] += turned - ((start[k] + end[k]) / 2 - path.centre[row])
        place[k] += ((start[k] + end[k]) / 2 - path.centre[row]) @ axis * axis
        heading[k] = np.cross(axis, turned) * np.sign(half)
    return place, heading
