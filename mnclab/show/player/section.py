"""What the page needs to turn the part while it plays: the bar, what each row takes away in the plane of z and r, the inserts.

The areas are those of the kernel, as lines within `OFF` mm; the page only takes them away one after the other. Between two
rows it moves the convex cutting part of the tool itself.
"""

from __future__ import annotations

from bisect import bisect
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour, steps_within
from mnclab.path.inserts import as_drawn, cutting_part, holder, insert, lead_of
from mnclab.path.tool import Tool
from mnclab.show.player.logs import columns, log, parted
from mnclab.show.player.packing import Packer
from mnclab.workpiece.blank import Revolved
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.turning.section import Drawing, cuts, held, left_of
from mnclab.workpiece.turning.strokes import Strokes, strokes_of
from mnclab.workpiece.turning.turned import half_section, room_of

OFF = 0.01  # mm
PARTS = 1e4  # of a millimetre
BEHIND, JAWS = 0.3, 1.55  # of the radius of the bar: how long and how high a chuck is that nobody gave, behind the bar
LONG, FINE = 0.09, 0.01  # edges of an insert, of the greatest side of what is shown; chords of its nose, of its edges
MOST = 200_000  # corners of all areas; the page of more would be too large

Array = NDArray[np.float64]


def section(pack: Packer, cutting: Cutting) -> dict[str, Any]:
    """The section of a lathe's part; corners are (z, r), mm."""
    bar, axis, notes = half_section(cutting.stock)
    low, high, radius = room_of(bar)
    strokes = strokes_of(cutting, low, high, radius, axis)
    rows, areas, fallen = _areas(strokes, bar, low)
    told = [*notes, *strokes.notes]
    count = np.array([len(area) for area in areas], dtype=np.int64)
    kept = int(np.searchsorted(np.cumsum(count), MOST, "right"))
    if kept < len(areas):
        told.append(f"the section is shown up to row {rows[kept]} only")
    corners = np.concatenate(areas[:kept]) if kept else np.empty((0, 2))
    reach = high - low + radius
    leads = [lead_of(cutting.path, cutting.which == k) for k in range(len(cutting.tools))]
    shaped = [as_drawn(tool, lead) for tool, lead in zip(cutting.tools, leads, strict=True)]
    return {
        "bar": [_corners(loop.points_within(OFF)) for loop in bar],
        "axis": axis,
        "parts": PARTS,
        "rows": pack.add(rows[:kept]),
        "count": pack.add(count[:kept]),
        "fallen": fallen,
        "corners": columns(pack, parted(corners, PARTS)),
        "which": log(pack, cutting.which),
        "cuts": log(pack, cutting.cuts & ~cutting.from_home),
        "blades": [_corners(cutting_part(tool, reach).points_within(OFF)) for tool in shaped],
        "chuck": [_corners(loop.points) for each in cutting.fixtures if _turns(each) for loop in half_section(each)[0]]
        or [[[low - BEHIND * radius, 0.0], [low, 0.0], [low, JAWS * radius], [low - BEHIND * radius, JAWS * radius]]],
        "note": "; ".join(told),
    }


def _areas(strokes: Strokes, bar: Sequence[Contour], low: float) -> tuple[list[int], list[Array], list[int]]:
    """Rows and outlines of what goes, in order: of all strokes of a row, then of the pieces that fall; and which these are."""
    rows, areas = list(strokes.rows), _outlines(strokes.contours)
    drawing = Drawing.of(bar, strokes.contours, rows)
    fallen: list[int] = []
    if not areas or not held(left_of(drawing), low)[1]:
        return rows, areas, fallen
    for row, _, off in cuts(drawing, low):
        for piece in off:
            fallen.append(bisect(rows, row))
            areas.insert(fallen[-1], shapely.get_coordinates(shapely.simplify(piece.exterior, OFF / 2))[:-1])
            rows.insert(fallen[-1], row)
    return rows, areas, fallen


def _outlines(contours: Sequence[Contour]) -> list[Array]:
    """The corners of closed contours (m, 2): all at once, as one line."""
    if not contours:
        return []
    points = np.concatenate([part for each in contours for part in (each.points, each.points[:1])])
    bulge = np.concatenate([part for each in contours for part in (each.bulge, [0.0])])
    line = Contour(points, bulge, closed=False)
    steps = np.append(steps_within(line.radii, line.sweeps, OFF), 1)
    size = np.array([len(each.points) + 1 for each in contours])
    return np.split(line.points_within(OFF), np.add.reduceat(steps, np.cumsum(size) - size).cumsum()[:-1])


def _turns(body: Any) -> bool:
    return isinstance(body, Revolved) and body.axis == "Z"


def inserts(pack: Packer, run: Any) -> dict[str, Any]:
    """The insert and the holder of each row about its tip, as long as those of the figures of the run."""
    path, (table, numbers) = run.toolpath, run.tools_that_cut
    ends = [path.bounds] if len(path.motion) else []
    ends += [run.stock.bounds] if run.stock else []
    size = (LONG * float(np.ptp(np.concatenate(ends), axis=0).max()) if ends else 0.0) or 1.0
    known = np.unique(numbers).tolist()
    shapes = [as_drawn(table.get(number, Tool()), lead_of(path, numbers == number)) for number in known]
    tools = [
        {"insert": _corners(insert(tool, size).points_within(FINE * size)), "holder": _corners(holder(tool, size))}
        for tool in shapes
    ]
    return {"which": log(pack, np.searchsorted(known, numbers)), "tools": tools}


def _corners(points: Array | Sequence[Any]) -> list[list[float]]:
    return [[float(z), float(r)] for z, r in np.round(np.asarray(points, dtype=np.float64), 4)]
