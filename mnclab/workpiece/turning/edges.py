"""What of a bar meets a tool beyond the end of its edge: a cut deeper than the edge is long.

An insert cuts as far along its edge as `inserts.edge_length` says, from the tip. What meets it further up stands before its
holder. That stands back a little, so that the stock on a high wall passes before it; but an edge must take it later, or
the part that is shown is none that this tool makes.

A blade is too short for a groove both of whose walls are higher than it reaches, the tooth of a thread for crests above
its flanks: these count as they were before the thread. Areas are shapely's, in the plane of z and r, mm.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from mnclab.geometry import shapely
from mnclab.geometry.curves import Floats
from mnclab.geometry.sweeps import broad
from mnclab.path import inserts
from mnclab.path.listing import Unit
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Kind
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.turning.strokes import threads_of

RELIEF = 1.0  # mm, by which what is beyond an edge stands back, and by which a holder is wider than its blade
TOLERANCE, AREA = 0.01, 1e-9  # mm, mm²
LEADS = 1e-9  # of a way: how far a side looks ahead that meets something
FLAT = 0.1  # sine between an edge and the way, below which its depth of cut is not told any longer
CUT = "material beyond the edge of the tool: the cut is {} deep along the edge, the edge is {} long"
GROOVE = "material beyond the edge of the tool: the groove is {} deep, the blade reaches {}"
USUALLY = ", as is usual: its table gives no cutting length"


class TooDeep(NamedTuple):
    """A cut that is `deep` along an edge, mm, and where (z, r) it is deepest; `row` of the path, `tool` as it cuts there."""

    row: int
    tool: Tool
    deep: float
    place: tuple[float, float]

    @property
    def long(self) -> float:
        return inserts.edge_length(self.tool)

    def told(self, unit: Unit) -> str:
        """What was found and what is allowed, by the tool table or as usual."""
        lengths = (f"{unit.figure(each, 1)} {unit.short}" for each in (self.deep, self.long))
        return (GROOVE if _is_blade(self.tool) else CUT).format(*lengths) + ("" if self.tool.cutting_length else USUALLY)


class Edges:
    """Looks at the rows of a cutting one after the other; `height` reaches from a tip to above everything, mm."""

    def __init__(self, cutting: Cutting, height: float) -> None:
        self.cutting, self.height = cutting, height
        self.leads = np.where(cutting.path.synchronous, threads_of(cutting.path)[0], 0.0)
        self.lacking: dict[int, tuple[Any, TooDeep]] = {}  # what only the prolonged edges of a row have taken, and no edge since
        self.unthreaded: Any = None  # what is left without the threads in it, once there is one
        self._known: dict[Tool, Any] = {}

    def judge(self, row: int, way: Floats, left: Any, rest: Any, spared: Any, covered: Any) -> TooDeep | None:
        """What is too deep where a tool goes along a way (m, 2) and leaves the `rest` of an area, without what it `covered`.

        Of what is `spared` nobody is blamed.
        """
        tool = inserts.as_drawn(self.cutting.tool(row), float(self.leads[row]))
        if self.cutting.path.kind[row] == Kind.RAPID or not inserts.turns(tool) or left.area - rest.area < AREA:
            self.passed(row, way, covered)
            return None
        if self.leads[row] and self.unthreaded is None:
            self.unthreaded = left
        if _ends_above(tool):
            crests = left if self.unthreaded is None else self.unthreaded
            found = self._beside(row, tool, way, crests if tool.kind == "thread" else rest)
        else:
            found = self._before(row, tool, way, shapely.difference(left, spared))
        if found:
            self.lacking.pop(row, None)
            self._take(covered)  # it is told once
        self.passed(row, way, covered)
        return max(found, key=lambda each: each.deep, default=None)

    def passed(self, row: int, way: Floats, covered: Any) -> None:
        """A row that meets nothing of what is left, or is judged: its edges may take what others before it have not."""
        tool = self.cutting.tool(row)
        if self.unthreaded is not None and not self.leads[row]:
            self.unthreaded = shapely.difference(self.unthreaded, covered)
        if self.lacking:
            self._take(_swept(self._of(tool)[0], way) if inserts.turns(tool) and not _ends_above(tool) else covered)

    def _take(self, covered: Any) -> None:
        rest = {row: (shapely.difference(area, covered), found) for row, (area, found) in self.lacking.items()}
        self.lacking = {row: each for row, each in rest.items() if not broad(each[0], TOLERANCE).is_empty}

    def _before(self, row: int, tool: Tool, way: Floats, left: Any) -> list[TooDeep]:
        """What stands before the prolonged edges: told where it is thicker than their relief, else remembered."""
        found, (corners, sides) = list[TooDeep](), self._of(tool)
        for ends in np.stack([way[:-1], way[1:]], axis=1):
            ahead = (ends[1] - ends[0]) / (math.hypot(*(ends[1] - ends[0])) or 1.0)
            for side in sides:
                if (leads := float(side.outwards @ ahead)) < LEADS:
                    continue
                before = shapely.intersection(left, _swept(side.line, ends))
                if before.area > AREA:
                    area, deepest = self.lacking.get(row, (before, None))
                    each = _deepest(row, tool, before, ends[0], ahead, side)
                    self.lacking[row] = shapely.union(area, before), max(filter(None, [deepest, each]), key=lambda one: one.deep)
                if self.lacking:
                    behind = _swept(side.line, ends - RELIEF / leads * ahead)
                    thick = shapely.union_all(shapely.intersection([area for area, _ in self.lacking.values()], behind))
                    if not (thick := broad(thick, TOLERANCE)).is_empty:
                        found.append(_deepest(row, tool, thick, ends[0], ahead, side))
            if self.lacking and len(way) > 2:
                self._take(_swept(corners, ends))
        return found

    def _beside(self, row: int, tool: Tool, way: Floats, stands: Any) -> list[TooDeep]:
        """What stands beside a blade on both sides, or before a tooth, higher than it reaches; on the axis a piece falls off."""
        up, slope, boxes = self._of(tool)
        found, tips = list[TooDeep](), way if tool.kind == "boring" else way.clip((-math.inf, 0.0))
        for box in boxes:
            met = broad(shapely.intersection(stands, _swept(box, tips)), TOLERANCE)
            if met.is_empty:
                return []
            points, order = shapely.get_coordinates(met), tips[(tips @ up[::-1]).argsort()]
            tip = np.interp(points @ up[::-1], order @ up[::-1], order @ up) if np.ptp(order @ up[::-1]) else (tips @ up).min()
            high = points @ up - tip
            z, r = points[high.argmax()].tolist()
            found.append(TooDeep(row, tool, float(high.max()) / slope, (z, r)))
        return [min(found, key=lambda each: each.deep)] if found else []

    def _of(self, tool: Tool) -> Any:
        if tool not in self._known:
            self._known[tool] = (_boxes if _ends_above(tool) else inserts.beyond_edges)(tool, self.height)
        return self._known[tool]


def _deepest(row: int, tool: Tool, met: Any, tip: Floats, ahead: Floats, side: inserts.Beyond) -> TooDeep:
    """How deep an area is along an edge that goes ahead from a tip, and where it is met first as deep as that."""
    points, (begin, _), edge = shapely.get_coordinates(met), side.line, side.edge
    off = np.abs(_across(points - tip - begin, ahead)) / max(abs(_across(edge, ahead)), FLAT)
    z, r = points[np.where(off > off.max() - TOLERANCE, points @ ahead, np.inf).argmin()].tolist()
    return TooDeep(row, tool, float(begin @ edge + off.max()), (z, r))


def _ends_above(tool: Tool) -> bool:
    """Whether what is beyond the edges is above them: of a blade and of the tooth of a thread."""
    return _is_blade(tool) or tool.kind == "thread"


def _is_blade(tool: Tool) -> bool:
    return bool(tool.kind in inserts.BLADES or tool.width and tool.kind != "thread")


def _boxes(tool: Tool, height: float) -> tuple[Floats, float, list[Floats]]:
    """Of a blade or a tooth: which way is up (2,), how much of its edge goes there, and what is above: beside it, over it."""
    tool, mirror = inserts.usual(tool), inserts.mirror_of(tool)
    turn = slice(None, None, -1 if tool.kind == inserts.FACE else 1)
    (left, _), (right, _) = sorted((inserts.cutting_part(tool, height).bounds * mirror)[:, turn].tolist())
    slope = 1.0 if _is_blade(tool) else min(math.sin(angle) for angle in inserts.angles_of(tool))
    low = inserts.edge_length(tool) * slope
    spans = [(left - RELIEF, left), (right, right + RELIEF)] if _is_blade(tool) else [(left, right)]
    boxes = [np.array([(a, low), (b, low), (b, height), (a, height)])[:, turn] * mirror for a, b in spans if height > low]
    return np.array([0.0, 1.0])[turn] * mirror, slope, boxes


def _swept(corners: Floats, way: Floats) -> Any:
    """What a convex shape (k, 2) covers along a way (m, 2), a line of it as well."""
    places = corners + (way if len(way) > 1 else way[[0, 0]])[:, None]
    return shapely.union_all(shapely.convex_hull(shapely.multipoints(np.concatenate([places[:-1], places[1:]], axis=1))))


def _across(vectors: Floats, ahead: Floats) -> Any:
    return vectors[..., 0] * ahead[1] - vectors[..., 1] * ahead[0]
