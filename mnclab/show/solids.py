"""Bodies as triangles: the tool, a box, tubes along a path. What scenes show and what files of meshes hold.

Points (n, 3) in mm, triangles (m, 3) as indices into them, their outside counter-clockwise.
"""

from __future__ import annotations

from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.path.inserts import as_drawn, holder, insert, lead_of
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Kind, Toolpath
from mnclab.workpiece.blank import Box, Revolved, blank
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.part import Part

SIDES = 48  # of a tool
TUBE_SIDES = 6
SHANK = 3.0  # diameters, of a tool whose cutting length is not known
EDGES, THICK = 0.09, 0.35  # edges of an insert, of what stands beside it; half as thick, of its edges
DRILL_POINT = 118.0  # degrees, of a drill without an angle


class Body(NamedTuple):
    """A closed surface."""

    points: NDArray[np.float64]
    triangles: NDArray[np.int64]

    def at(self, place: ArrayLike) -> Body:
        """The body moved by a vector (3,) mm."""
        return Body(self.points + np.asarray(place, dtype=np.float64), self.triangles)

    def turned(self, turn: NDArray[np.float64]) -> Body:
        """The body turned about 0 0 0 by a matrix (3, 3)."""
        return Body(self.points @ turn.T, self.triangles)

    @property
    def volume(self) -> float:
        """mm³, by the divergence theorem; positive when the outsides are outside."""
        a, b, c = self.points[self.triangles].transpose(1, 0, 2)
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


def box(low: ArrayLike, high: ArrayLike) -> Body:
    """A box between two corners (3,)."""
    points = np.array([*product(*np.array([low, high], dtype=np.float64).T)])
    squares = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return Body(points, np.array([t for a, b, c, d in squares for t in ((a, b, c), (a, c, d))], dtype=np.int64))


def revolved(profile: ArrayLike, sides: int = SIDES, bore: float = 0.0) -> Body:
    """A body of revolution about Z: `profile` (k, 2) holds radius and height from the lower end to the upper one."""
    outline = np.asarray(profile, dtype=np.float64)
    if bore > 0:  # back along the inside, and round to the beginning
        outline = np.concatenate([outline, [(bore, outline[-1, 1]), (bore, outline[0, 1])], outline[:1]])
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    rings = np.concatenate([np.column_stack([radius * ring, np.full(sides, height)]) for radius, height in outline])
    ends = np.array([[0.0, 0.0, outline[0, 1]], [0.0, 0.0, outline[-1, 1]]])
    here, there = np.arange(sides), np.roll(np.arange(sides), -1)
    triangles = []
    last = (len(outline) - 1) * sides
    for low in range(0, last, sides):
        triangles += [np.stack([low + here, low + there, low + sides + there], 1)]
        triangles += [np.stack([low + here, low + sides + there, low + sides + here], 1)]
    if bore > 0:
        return Body(rings, np.concatenate(triangles))
    triangles += [np.stack([np.full(sides, len(rings)), there, here], 1)]
    triangles += [np.stack([np.full(sides, len(rings) + 1), last + here, last + there], 1)]
    return Body(np.concatenate([rings, ends]), np.concatenate(triangles))


def cylinder_body(path: Toolpath, number: int = 0) -> Body:
    """The cylinder that rows of a path lie on, as long as what lies on it and half its radius more at both ends."""
    one = path.cylinders[number]
    cuts = path[(path.cylinder == number) & (path.kind == Kind.LINE)]
    along = (np.concatenate([cuts.start, cuts.end]) - one.point) @ np.array(one.direction) if len(cuts) else np.zeros(1)
    low, high = along.min() - one.radius / 2, along.max() + one.radius / 2
    points, triangles = revolved([(one.radius, low), (one.radius, high)], 2 * SIDES)
    across, direction, zero = one.basis
    return Body(points @ np.stack([zero, across, direction]) + one.point, triangles)


def tool_body(tool: Tool, size: float = 10.0) -> Body:
    """A tool with its tip at 0 0 0 and its shank along +Z; a small peak where the table knows no radius (`size` mm)."""
    radius = tool.effective_radius
    if radius <= 0:
        return revolved([(0.0, 0.0), (size / 16, size / 8), (size / 16, size / 4)], 16)
    length = max(tool.cutting_length or SHANK * 2 * radius, 2 * radius)
    angle = tool.angle or (DRILL_POINT if tool.kind == "drill" else 0.0)
    neck, top = 0.9 * radius, max(1.3 * length, tool.holder[0][1] if tool.holder else 0.0)  # up to the holder
    wide, above = tool.shank or (neck, length)
    above = min(max(above, length), top)
    shank = [(neck, length), (neck, above)] * (above > length) + [(wide, above), (wide, top)] * (above < top)
    if 0 < angle < 180:
        point = [(0.0, 0.0), (radius, radius / np.tan(np.radians(angle / 2))), (radius, length)]
        return revolved(point + shank if tool.holder else point)
    corner = min(max(tool.corner, 0.0), radius)
    bend = np.linspace(0, np.pi / 2, 9 if corner else 1)
    rounding = [(radius - corner + corner * np.sin(a), corner - corner * np.cos(a)) for a in bend]
    return revolved([*rounding, (radius, length), *shank])


def strokes(path: Toolpath, chord_error: float) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The motion as straight strokes (n, 2, 3), mm, and the row (n,) of each."""
    points, row = path.points(chord_error)
    if not len(row):
        return np.empty((0, 2, 3)), row
    start = points[:-1].copy()
    first = row[1:] != row[:-1]
    first[0] = True
    start[first] = path.start[row[1:][first]]  # after a tool change the tip begins elsewhere
    return np.stack([start, points[1:]], axis=1), row[1:]


def tubes(path: Toolpath, radius: float, chord_error: float = 0.02, sides: int = TUBE_SIDES) -> Body:
    """The cuts of a path as prisms of `radius` mm around every stroke, each closed by itself."""
    pieces, row = strokes(path, chord_error)
    start, end = pieces[np.isin(path.kind[row], (Kind.LINE, Kind.ARC))].transpose(1, 0, 2)
    travel = end - start
    length = np.linalg.norm(travel, axis=1)
    long = length > 0
    start, end, along = start[long], end[long], travel[long] / length[long, None]
    across = np.cross(along, np.eye(3)[np.argmin(np.abs(along), axis=1)])
    across /= np.linalg.norm(across, axis=1)[:, None]
    other = np.cross(along, across)
    angle = 2 * np.pi * np.arange(sides) / sides
    cosine, sine = np.cos(angle)[:, None], np.sin(angle)[:, None]
    ring = radius * (cosine * across[:, None] + sine * other[:, None])  # (n, sides, 3)
    vertices = np.concatenate([start[:, None] + ring, end[:, None] + ring], axis=1)
    here, there = np.arange(sides), np.roll(np.arange(sides), -1)
    walls = [np.stack([here, there, sides + there], 1), np.stack([here, sides + there, sides + here], 1)]
    fan = np.arange(1, sides - 1)
    lids = [np.stack([0 * fan, fan + 1, fan], 1), np.stack([0 * fan, fan, fan + 1], 1) + sides]
    one = np.concatenate([*walls, *lids])
    every = one[None] + 2 * sides * np.arange(len(start))[:, None, None]
    return Body(vertices.reshape(-1, 3), every.reshape(-1, 3))


def size_of(path: Toolpath) -> float:
    """The greatest side of the box around a path, mm; 1 for a path without motion."""
    low, high = path.bounds
    span = float((high - low).max()) if len(path) else 0.0
    return span if np.isfinite(span) and span > 0 else 1.0


def body_of(stock: Any) -> Body:
    """A blank as a body."""
    if isinstance(stock, Box):
        return box(*stock.bounds)
    if not isinstance(stock, Revolved):  # a part that was cut before, a design
        solid = stock.solid() if hasattr(stock, "solid") else Milled(Cutting.of_nothing(stock)).solid()
        return Body(solid.points, solid.triangles)
    profile = np.array(stock.profile, dtype=np.float64)
    points, triangles = revolved(profile if profile[-1, 1] > profile[0, 1] else profile[::-1], 2 * SIDES, stock.bore)
    along = stock.along  # Z, X, Y of the body in turn lie there
    return Body(np.roll(points, along + 1, axis=1), triangles).at(stock.at)


def stock_of(run: Any) -> Body | None:
    """The blank of a run in the coordinates of its path."""
    return body_of(run.stock) if run.stock else None


def fixtures_of(run: Any) -> list[Body]:
    """What holds the blank of a run, in the coordinates of its path; a part that only a probe knows has no body here."""
    held = [blank(each) for each in run.setup.fixtures if not isinstance(each, Part)]
    return [body_of(each.moved(-run.toolpath.origin)) for each in held if each is not None]


def bent(strokes: NDArray[np.float64], row: NDArray[np.int64], which: NDArray[np.int64], places: NDArray[np.float64]) -> Any:
    """The strokes (n, 2, 3) and their rows, where those of the rows `which` (k,), one each, go through `places` (k, 3)."""
    if not len(which):
        return strokes, row
    vertices = np.concatenate([strokes[:, 0], places])
    of = np.concatenate([row, which])
    order = np.argsort(of, kind="stable")
    start, of = vertices[order], of[order]
    last = np.append(of[1:] != of[:-1], True)
    end = np.concatenate([start[1:], start[-1:]])
    kept = np.append(row[1:] != row[:-1], True)
    end[last] = strokes[kept, 1]
    return np.stack([start, end], axis=1), of


def turning_tool_of(run: Any, row: int, size: float) -> dict[str, Body]:
    """The insert, as "tool", and the holder of a lathe where a row ends, beside something of a `size`, mm: flat bodies."""
    path, (table, numbers) = run.toolpath, run.tools_that_cut
    number, up_to = int(numbers[row]), np.arange(len(path)) <= (row if row >= 0 else len(path) + row)
    tool = as_drawn(table.get(number, Tool()), lead_of(path, up_to & (numbers == number)))
    edges = EDGES * size
    outlines = {"tool": insert(tool, edges).points_within(edges / 100), "holder": holder(tool, edges)}
    thick = {"tool": THICK * edges, "holder": 0.8 * THICK * edges}
    return {name: prism(corners, thick[name]).at(path.end[row]) for name, corners in outlines.items()}


def prism(corners: ArrayLike, thick: float) -> Body:
    """A body over a convex outline (k, 2) of z and r, as thick to both sides of the plane of X and Z."""
    flat = np.asarray(corners, dtype=np.float64)
    flat = flat[np.linalg.norm(np.roll(flat, -1, axis=0) - flat, axis=1) > 0]
    if (flat[:, 0] * np.roll(flat[:, 1], -1) - flat[:, 1] * np.roll(flat[:, 0], -1)).sum() < 0:
        flat = flat[::-1]
    count = len(flat)
    points = np.concatenate([np.column_stack([flat[:, 1], np.full(count, y), flat[:, 0]]) for y in (-thick, thick)])
    here, there, fan = np.arange(count), np.roll(np.arange(count), -1), np.arange(1, count - 1)
    walls = [np.stack([here, there, count + there], 1), np.stack([here, count + there, count + here], 1)]
    lids = [np.stack([0 * fan, fan + 1, fan], 1), np.stack([0 * fan, fan, fan + 1], 1) + count]
    return Body(points, np.concatenate([*walls, *lids]))


def tool_of(run: Any, row: int = -1) -> Body | None:
    """The tool where a row of the toolpath ends, by default the last; None for a path without rows.

    On a lathe the tip is a small peak with its shank along +X: a turning tool has no outline in the table.
    """
    path = run.toolpath
    if not len(path):
        return None
    if path.lathe:
        points, triangles = tool_body(Tool(), size_of(path))
        return Body(points[:, [2, 1, 0]], triangles[:, ::-1]).at(path.end[row])
    body = tool_body(run.tables.tools.get(int(path.tool[row]), Tool()), size_of(path))
    lies = run.history.value("tool axis", int(path.step[row])) or "Z"
    body = Body(np.roll(body.points, "XYZ".index(lies) - 2, axis=1), body.triangles)
    return body.turned(turn_of(path, row)).at(path.end[row])


def holder_of(run: Any, row: int = -1) -> Body | None:
    """What holds the tool where a row of a machine with rotary axes ends, up to the spindle; None where no tool says."""
    path = run.toolpath
    tool = run.tables.tools.get(int(path.tool[row]), Tool())
    if path.kinematics is None or not tool.holder:
        return None
    radii, heights = np.array(tool.holder, dtype=np.float64).T
    tops = np.append(heights[1:], max(tool.effective_length, heights[-1] + radii[-1]))
    outline = np.column_stack([np.repeat(radii, 2), np.column_stack([heights, tops]).ravel()])
    return revolved(outline).turned(turn_of(path, row)).at(path.end[row])


def turn_of(path: Toolpath, row: int) -> NDArray[np.float64]:
    """How the tool is turned on the part at the end of a row (3, 3)."""
    return np.eye(3) if path.kinematics is None else path.kinematics.orientation(path.rotary[row])
