"""What of a bar meets a tool beyond the end of its edge: a cut deeper than the edge is long.

An insert cuts as far along its edge as `inserts.edge_of` says, from the tip. What meets it further up stands before its
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
from mnclab.path.inserts import BLADES, FACE, angles_of, as_drawn, beyond_edges, cutting_part, edge_of, mirror_of, turns, usual
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Kind
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.turning.strokes import threads_of

RELIEF = 1.0  # mm, by which what is beyond an edge stands back, and by which a holder is wider than its blade
TOLERANCE = 0.01  # mm
LEADS = 1e-9  # of a way: how far a side looks ahead that meets something
FLAT = 0.1  # sine between an edge and the way, below which its depth of cut is not told any longer


class TooDeep(NamedTuple):
    """A cut that is `deep` along an edge, mm, and where (z, r) it is deepest; `row` of the path, `tool` as it cuts there."""

    row: int
    tool: Tool
    deep: float
    place: tuple[float, float]


class Edges:
    """Looks at the rows of a cutting one after the other; `height` reaches from a tip to above everything, mm."""

    def __init__(self, cutting: Cutting, height: float) -> None:
        self.cutting, self.height = cutting, height
        self.leads = np.where(cutting.path.synchronous, threads_of(cutting.path)[0], 0.0)
        self.lacking: list[tuple[Any, TooDeep]] = []  # areas that only the prolonged edges of a row have taken, and no edge since
        self.unthreaded: Any = None  # what is left without the threads in it, once there is one
        self._known: dict[Tool, Any] = {}

    def judge(self, row: int, way: Floats, left: Any, covered: Any) -> TooDeep | None:
        """What is too deep where a tool goes along a way (m, 2) and takes what it covered of the area that is `left`."""
        tool = as_drawn(self.cutting.tool(row), float(self.leads[row]))
        found = list[TooDeep]()
        if self.cutting.path.kind[row] != Kind.RAPID and turns(tool):
            if self.leads[row] and self.unthreaded is None:
                self.unthreaded = left
            if tool.kind == "thread" or _is_blade(tool):
                stands = left if self.unthreaded is None else self.unthreaded
                found = self._beside(row, tool, way, stands if tool.kind == "thread" else shapely.difference(left, covered))
            else:
                found = self._before(row, tool, way, left)
        self._take(row, tool, way, covered, bool(found))
        return max(found, key=lambda each: each.deep, default=None)

    def passed(self, row: int, way: Floats, covered: Any) -> None:
        """A row that meets nothing of what is left: it may take what edges before it have not."""
        if self.lacking or self.unthreaded is not None:
            self._take(row, self.cutting.tool(row), way, covered, False)

    def _take(self, row: int, tool: Tool, way: Floats, covered: Any, told: bool) -> None:
        """What was told once lacks no longer, and what an edge takes does not either."""
        if self.unthreaded is not None and not self.leads[row]:
            self.unthreaded = shapely.difference(self.unthreaded, covered)
        if self.lacking and not told and turns(tool) and not (_is_blade(tool) or tool.kind == "thread"):
            covered = _swept(self._of(tool)[0], way)
        rest = [(broad(shapely.difference(area, covered), TOLERANCE), found) for area, found in self.lacking]
        self.lacking = [(area, found) for area, found in rest if not area.is_empty]

    def _before(self, row: int, tool: Tool, way: Floats, left: Any) -> list[TooDeep]:
        """What stands before the prolonged edges: told where it is thicker than their relief, else remembered."""
        found, thin = list[TooDeep](), list[tuple[Any, TooDeep]]()
        for start, end in zip(way[:-1], way[1:]):
            ahead = (end - start) / math.hypot(*(end - start))
            for line, outwards, edge in self._of(tool)[1]:
                if (leads := float(outwards @ ahead)) < LEADS:
                    continue
                before = shapely.intersection(left, _swept(line, np.stack([start, end])))
                if before.is_empty and not self.lacking:
                    continue
                behind = _swept(line, np.stack([start, end]) - RELIEF / leads * ahead)
                thick = shapely.intersection([before, *(area for area, _ in self.lacking)], behind)
                for area, into in ((shapely.union_all(thick), found), (before, thin)):
                    if (met := broad(area, TOLERANCE)).is_empty:
                        continue
                    points = shapely.get_coordinates(met)
                    off = np.abs(_across(points - start - line[0], ahead)) / max(abs(_across(edge, ahead)), FLAT)
                    deep = TooDeep(row, tool, float(line[0] @ edge + off.max()), tuple(points[off.argmax()].tolist()))
                    into.append(deep if into is found else (met, deep))
        if not found:
            self.lacking += thin
        return found

    def _beside(self, row: int, tool: Tool, way: Floats, stands: Any) -> list[TooDeep]:
        """What stands beside a blade on both sides, or before a tooth, higher than it reaches; on the axis a piece falls off."""
        up, slope, boxes = self._of(tool)
        found, tips = list[TooDeep](), way if tool.kind == "boring" else way.clip((-math.inf, 0.0))
        for box in boxes:
            met = broad(shapely.intersection(stands, _swept(box, tips)), TOLERANCE)
            if met.is_empty:
                return []
            points = shapely.get_coordinates(met)
            z, r = points[(points @ up).argmax()].tolist()
            found.append(TooDeep(row, tool, float((points @ up).max() - (tips @ up).min()) / slope, (z, r)))
        return [min(found, key=lambda each: each.deep)] if found else []

    def _of(self, tool: Tool) -> Any:
        if tool not in self._known:
            besides = _is_blade(tool) or tool.kind == "thread"
            self._known[tool] = _boxes(tool, self.height) if besides else beyond_edges(tool, self.height)
        return self._known[tool]


def _is_blade(tool: Tool) -> bool:
    return bool(tool.kind in BLADES or tool.width and tool.kind != "thread")


def _boxes(tool: Tool, height: float) -> tuple[Floats, float, list[Floats]]:
    """Of a blade or a tooth: which way is up (2,), how much of its edge goes there, and what is above: beside it, over it."""
    tool, mirror = usual(tool), mirror_of(tool)
    turn = slice(None, None, -1 if tool.kind == FACE else 1)
    (left, _), (right, _) = sorted((cutting_part(tool, height).bounds * mirror)[:, turn].tolist())
    slope = 1.0 if _is_blade(tool) else min(math.sin(angle) for angle in angles_of(tool))
    low = edge_of(tool) * slope
    spans = [(left - RELIEF, left), (right, right + RELIEF)] if _is_blade(tool) else [(left, right)]
    boxes = [np.array([(a, low), (b, low), (b, height), (a, height)])[:, turn] * mirror for a, b in spans if height > low]
    return np.array([0.0, 1.0])[turn] * mirror, slope, boxes


def _swept(corners: Floats, way: Floats) -> Any:
    """What a convex shape (k, 2) covers along a way (m, 2), a line of it as well."""
    places = corners + (way if len(way) > 1 else way[[0, 0]])[:, None]
    return shapely.union_all(shapely.convex_hull(shapely.multipoints(np.concatenate([places[:-1], places[1:]], axis=1))))


def _across(vectors: Floats, ahead: Floats) -> Any:
    return vectors[..., 0] * ahead[1] - vectors[..., 1] * ahead[0]
