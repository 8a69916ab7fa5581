"""What the tools of a lathe meet that they must not: row after row on the half section of the bar, as areas.

Before each row stands what the rows before it have left. A rapid takes nothing of it; at feed the spindle turns, and the
back of the insert takes nothing that stays when its cycle is over. A thread counts as cut down to its root: what runs in it
later is not judged there.
What an edge that leans leaves on the wall that ends a pass, some tenths for 5 degrees, is cut by what follows and blamed
on no rapid and on no back, as far as it is no thicker than `WEDGE`: cycles run along their walls, by their manual.

Areas are shapely's, in the plane of z and r, mm. A tool is given about its tip; what lies behind its insert is known only
where its table says so.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.sweeps import CHORD_ERROR, broad
from mnclab.path.inserts import EDGE, FACE, angles_of, cutting_part, edge_length, mirror_of, turns, usual
from mnclab.path.listing import Unit
from mnclab.path.tool import CHAMFER, LATHE, Tool
from mnclab.path.toolpath import Index, Kind
from mnclab.text.alarm import Alarm
from mnclab.text.given import shown
from mnclab.workpiece.collision import Collision, Collisions, deep, solid
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.turning.edges import Edges, TooDeep
from mnclab.workpiece.turning.section import SectionDrawing
from mnclab.workpiece.turning.turned import half_section

# What the back of an insert takes away, its auxiliary edge, where the programmed way has it that the tip cuts.
#
# An edge that leads takes material. The auxiliary one may: in facing it does all the work. It must not where it
#
# - runs nearly along the feed and rubs on its whole length (turning towards the tailstock with 5 degrees), or
# - leaves material standing behind it as high as where it went in: a wall steeper than its angle, which it cuts down. ::
#
#         ___         ____
#            |       /          the tip comes down along the wall,
#            |  ==> /           the auxiliary edge leaves this of it
#            |____ /__
#
# The sides of a blade may turn along the axis, but no deeper than the blade is wide. Coordinates (z, r), mm.

ALONG = math.radians(15)  # between feed and edge: below, the edge rubs
WEDGE = 2.5  # mm: a thicker wedge at a wall is material that a rapid meets
BEYOND = 1e5  # mm
TOLERANCE = 0.01  # mm


class Back(NamedTuple):
    """What a back took: the place (z, r) of the deepest point, and how far beyond the way of the nose it is, mm."""

    place: tuple[float, float]
    depth: float


def taken_by_back(tool: Tool, shape: Floats, way: Floats, left: Any) -> Back | None:
    """What the back of an insert takes of an area `left` along a way (m, 2); `shape` (k, 2) is the tool about its tip."""
    tool, mirror = usual(tool), mirror_of(tool)
    if tool.kind in ("thread", FACE) or not (tool.width or tool.auxiliary_angle):
        return None
    places, corners = way * mirror, shape * mirror
    here = shapely.transform(left, lambda each: each * mirror)
    judge = _side if tool.width else _auxiliary
    found = []
    for start, end in zip(places[:-1], places[1:], strict=True):
        if (length := float(np.hypot(*(end - start)))) < 1e-9:
            continue
        hull = shapely.convex_hull(shapely.multipoints(np.concatenate([corners + start, corners + end])))
        taken = shapely.intersection(here, hull)
        if taken.area > 0:
            here = shapely.difference(here, hull)
            found += judge(tool, start, (end - start) / length, taken)
    found = [each for each in found if each.rubs or _stands(here, each.area)]
    if not found:
        return None
    worst = max(found, key=lambda each: each.depth)
    z, r = worst.place * mirror
    return Back((float(z), float(r)), worst.depth)


def left_by_lean(tool: Tool, way: Floats, taken: Any) -> Any:
    """What nose and lean of an edge leave on the wall where a straight cut ends that took an area: a wedge, or nothing."""
    tool = usual(tool)
    if tool.width or tool.kind not in ("", "turning", "boring") or taken.is_empty:
        return shapely.Polygon()
    mirror, (main, auxiliary) = mirror_of(tool), angles_of(tool)
    start, end = way * mirror
    right, top = (shapely.get_coordinates(taken) * mirror).max(axis=0)
    along, down = end - start
    if along < 0 and -along >= abs(down) and main > math.pi / 2 - 1e-9:
        high = min(max(top - end[1], 0.0), WEDGE * abs(math.tan(main)))
        wedge = [(0.0, 0.0), (tool.corner, 0.0), (-high / math.tan(main), high), (0.0, high)]
    elif down < 0 and -down >= abs(along) and tool.auxiliary_angle and auxiliary < math.pi / 2:
        long = min(max(right - end[0], 0.0), WEDGE / math.tan(auxiliary))
        wedge = [(0.0, 0.0), (long, 0.0), (long, long * math.tan(auxiliary)), (0.0, tool.corner)]
    else:
        return shapely.Polygon()
    return shapely.convex_hull(shapely.MultiPoint((np.array(wedge) + end) * mirror))


class _Taken(NamedTuple):
    area: Any
    depth: float
    place: Floats
    rubs: bool


def _auxiliary(tool: Tool, start: Floats, ahead: Floats, taken: Any) -> list[_Taken]:
    """What meets the auxiliary edge first as the tool goes ahead."""
    _, angle = angles_of(tool)
    edge, outwards = np.array([math.cos(angle), math.sin(angle)]), np.array([math.sin(angle), -math.cos(angle)])
    if ahead @ outwards < 1e-9:
        return []
    across = np.array([ahead[1], -ahead[0]])
    across *= math.copysign(1.0, across @ edge)
    nose = start + tool.corner + tool.corner * outwards
    line = nose + TOLERANCE * across
    corners = [line - BEYOND * ahead, line + BEYOND * ahead, line + BEYOND * (across + ahead), line + BEYOND * (across - ahead)]
    area = broad(shapely.intersection(taken, shapely.Polygon(corners)), TOLERANCE)
    if area.is_empty:
        return []
    points = shapely.get_coordinates(area)
    off = (points - nose) @ across
    return [_Taken(area, float(off.max()), points[off.argmax()], abs(float(ahead @ edge)) > math.cos(ALONG))]


def _side(tool: Tool, start: Floats, ahead: Floats, taken: Any) -> list[_Taken]:
    """What a blade takes with its sides, deeper than it is wide."""
    area = broad(taken, TOLERANCE)
    if abs(ahead[0]) < abs(ahead[1]) or area.is_empty:
        return []
    points = shapely.get_coordinates(area)
    deep = points[:, 1] - start[1]
    return [_Taken(area, float(deep.max()), points[deep.argmin()], True)] if deep.max() > tool.width + TOLERANCE else []


def _stands(left: Any, taken: Any) -> bool:
    """Whether behind what was taken material stands as high."""
    _, _, right, top = taken.bounds
    wall = shapely.intersection(left, shapely.box(right - TOLERANCE, top - 2 * TOLERANCE, BEYOND, BEYOND))
    return bool(wall.area > TOLERANCE * TOLERANCE)


NOSE_ERROR = 1e-4  # mm, of a nose
ROUND = 128  # corners of the ball of a probe, its four poles among them
THIN = 0.008  # mm: half a tool that has no width, less than what counts


def area_of(body: Any) -> Any:
    """A body about the spindle above its axis, X 0 Y 0. An Alarm for any other."""
    section, axis, _ = half_section(body)
    if abs(axis) > 1e-9:
        raise Alarm(f"on a lathe a blank and its chuck stand about X 0, got {shown(body)}")
    return SectionDrawing.of(section, (), ()).bar


def outline(tool: Tool, height: float) -> Floats:
    """The cutting part about the tip up to a height (k, 2); a tool without width is a thin one, a probe its ball alone."""
    if tool.kind == "probe" and tool.effective_radius > 0:
        angle = np.linspace(0, 2 * np.pi, ROUND, endpoint=False)
        return np.asarray(tool.effective_radius * np.stack([1 + np.cos(angle), np.sin(angle)], axis=1))
    corners = cutting_part(tool, height).points_within(NOSE_ERROR)
    if len(np.unique(corners, axis=0)) > 2:
        return corners
    return np.array([(-THIN, 0.0), (THIN, 0.0), (THIN, height), (-THIN, height)]) * mirror_of(tool)


def behind(tool: Tool, long: float) -> list[tuple[str, Floats]]:
    """Kind of collision and corners (4, 2) of what the table knows of a tool behind its edges, `long` away from the tip.

    The shank of a drill or a boring bar lies along its axis, that of an outside tool across it; the bar of a boring tool
    runs a fifth of an edge below its tip.
    """
    given = [("insert" if turns(tool) else "shank", tool.shank)] if tool.shank else []
    given += [("holder", each) for each in tool.holder]
    return [(kind, _bar(tool, *each, long) * mirror_of(tool)) for kind, each in given if each]


def _bar(tool: Tool, radius: float, start: float, long: float) -> Floats:
    end = max(long, start + 1.0)
    if tool.kind == "boring":
        middle = 0.2 * EDGE + (tool.shank[0] if tool.shank else radius)
    elif tool.kind in LATHE:
        middle = tool.width / 2 if tool.width else radius
        return np.array([(middle - radius, start), (middle + radius, start), (middle + radius, end), (middle - radius, end)])
    else:
        middle = 0.0
    return np.array([(start, middle - radius), (end, middle - radius), (end, middle + radius), (start, middle + radius)])


AXIS = 1e-6  # mm above the axis, where nothing is outside any more
AREA = 1e-9  # mm², less is rounding
APART = 0.25  # mm between the points of which the deepest is sought
SAID = {
    "rapid": "rapid motion in material",
    "insert": "the back of the insert takes material",
    "spindle": "cutting while the spindle stands",
    "chuck": "the tool in the chuck",
    "shank": "the shank in material",
    "holder": "the holder in material",
    "probe": "the probe in material",
}
HOLDER = "the holder of the insert in material"
BAR = "the bar of the boring tool in material: it stands between its tip and the axis"
FULL = "the boring tool, or its bar, in full material: it needs a bore"
BESIDE = "the {} {:.3f} mm beside the axis of the part, which alone turns: it cuts a ring"
FAR = 1e6  # mm


class Met(NamedTuple):
    """Kind, sentence, place (z, r) and depth, mm."""

    kind: str
    said: str
    place: tuple[float, float]
    depth: float


def collisions_of(cutting: Cutting, step: float | None = None) -> Collisions:
    """What the rows of a cutting meet that they must not, at most one of each row and kind; see `KINDS`.

    What only touches, within 0.01 mm, meets nothing. The depth of the back of an insert is how far beyond the way of the
    nose it cuts, of a cut deeper than its edge how much deeper, along the edge; any other how far inside the material, or the
    chuck, the tool is. Areas need no `step`.
    """
    return Collisions(_collision(cutting, row, met) for row, met in _met(cutting))


def _collision(cutting: Cutting, row: int, met: Met) -> Collision:
    line, program = int(cutting.path.line[row]), int(cutting.path.program[row])
    z, x = met.place
    typed = 2 * x if cutting.across == "diameter" else x
    message = f"{met.said}, {deep(met.depth, 'XZ', (typed, z), cutting.path.unit)} (X is a {cutting.across})"
    file = str(cutting.name(line, program)).rpartition(":")[0]
    return Collision(met.kind, message, line, program, row, (x, 0.0, z), met.depth, file)


def _met(cutting: Cutting) -> Iterator[tuple[int, Met]]:
    path, left, spared = cutting.path, area_of(cutting.stock), shapely.Polygon()
    chucks = [area_of(each) for each in cutting.fixtures]
    rows = np.flatnonzero(cutting.cuts | cutting.probed)
    height = _height(cutting, rows, left)
    shapes = [outline(tool, height) for tool in cutting.tools]
    bodies = [behind(tool, height) for tool in cutting.tools]
    ways = [_way(cutting, row) for row in rows.tolist()]
    areas = _swept([shapes[k] for k in cutting.which[rows].tolist()], ways)
    edges = Edges(cutting, height)
    later = _Later(path.step[rows].tolist(), (cutting.cuts & (path.kind != Kind.RAPID))[rows].tolist(), areas)
    for k, (row, way, covered) in enumerate(zip(rows.tolist(), ways, areas, strict=True)):
        which = int(cutting.which[row])
        tool, shape = cutting.tools[which], shapes[which]
        covered = _folded(covered) if way[:, 1].min() < -AXIS else covered  # a tip beyond the axis meets the other side
        for chuck in chucks:
            if met := _deepest("chuck", chuck, covered):
                yield row, met
        if cutting.probed[row]:  # it takes nothing
            if met := _deeper(left, covered, _folded(_swept([shape], [way[:1]])[0]), len(way) > 1):
                yield row, met
        elif not shapely.intersects(left, covered):
            edges.passed(row, way, covered)
        else:
            rest = shapely.difference(left, covered)
            found = list(_cut(cutting, row, tool, shape, way, left, spared, covered))
            if found and found[-1].kind == "insert":  # again, where nothing is judged that this cycle takes all the same
                stays = shapely.difference(left, shapely.union(spared, later(k)))
                back = taken_by_back(tool, shape, way, stays)
                found = [*found[:-1], *([_backed(back)] if back else [])]
            too_deep = edges.judge(row, way, left, rest, spared, covered)
            if len(way) == 2 and not found and path.kind[row] == Kind.LINE:
                wedge = left_by_lean(tool, way, shapely.intersection(left, covered))
                spared = shapely.union(spared, wedge) if wedge.area > AREA else spared
            if too_deep and not any(each.kind == "holder" for each in found):
                beyond = [each for each in [*found, _beyond(too_deep, path.unit)] if each.kind == "insert"]
                found = [*(each for each in found if each.kind != "insert"), max(beyond, key=lambda each: each.depth)]
            if any(each.kind == "insert" for each in found):
                edges.lacking.pop(row, None)  # one of each row and kind
            yield from ((row, met) for met in found)
            left = _held(rest)
        for kind, body in bodies[which]:
            covered = _folded(_swept([body], [way])[0])
            if met := _deepest(kind, left, covered):
                yield row, met._replace(said=HOLDER) if kind == "insert" else met
                left = _held(shapely.difference(left, covered))
    for row, (_, too_deep) in edges.lacking.items():
        if not cutting.reach:  # where a program stopped, nobody knows what its edges would still take
            yield row, _beyond(too_deep, path.unit)


def _beyond(found: TooDeep, unit: Unit) -> Met:
    return Met("insert", found.told(unit), found.place, found.deep - found.long)


def _swept(shapes: list[Floats], ways: list[Floats]) -> list[Any]:
    """What convex shapes (k, 2) cover, each along a way (m, 2) of its own; all hulls at once."""
    points, owners, parts = [], [], 0
    counts = []
    for shape, way in zip(shapes, ways, strict=True):
        places = way if len(way) > 1 else way[[0, 0]]
        corners = places[:, None] + shape
        pairs = np.concatenate([corners[:-1], corners[1:]], axis=1)
        points.append(pairs.reshape(-1, 2))
        owners.append(parts + np.repeat(np.arange(len(pairs)), pairs.shape[1]))
        parts += len(pairs)
        counts.append(len(pairs))
    if not parts:
        return []
    hulls = shapely.convex_hull(shapely.multipoints(np.concatenate(points), indices=np.concatenate(owners)))
    ends = np.cumsum(counts).tolist()
    pieces = [hulls[end - count : end] for end, count in zip(ends, counts, strict=True)]
    return [each[0] if len(each) == 1 else shapely.union_all(each) for each in pieces]


def _cut(
    cutting: Cutting, row: int, tool: Tool, shape: Floats, way: Floats, left: Any, spared: Any, covered: Any
) -> Iterator[Met]:
    """What is wrong with a row that takes material."""
    path = cutting.path
    if path.kind[row] == Kind.RAPID:
        if met := _deepest("rapid", left, shapely.difference(covered, spared)):
            yield met
        return
    if not path.spindle[row] and (met := _deepest("spindle", left, covered)):
        yield met
    beside = float(np.abs(way[:, 1]).max())
    if not turns(tool) and beside > TOLERANCE and (met := _deepest("axis", left, covered)):
        yield met._replace(said=BESIDE.format(tool.kind, beside))
    else:
        yield from _widened(cutting, tool, way, left, covered)
    yield from _bored(tool, shape, way, left, covered)
    if len(way) > 1 and not path.synchronous[row] and (back := taken_by_back(tool, shape, way, left)):
        yield _backed(back)


def _deeper(left: Any, covered: Any, begun: Any, moves: bool) -> Met | None:
    """Where a probe is in the material, unless it is nowhere deeper than where it `begun`: it withdraws."""
    met, before = _deepest("probe", left, covered), _deepest("probe", left, begun) if moves else None
    return met if met and not (before and before.depth > met.depth - TOLERANCE) else None


def _backed(back: Back) -> Met:
    return Met("insert", SAID["insert"], back.place, back.depth)


class _Later:
    """What the cuts after the k-th one take in the same step: stock that a cycle leaves to its own later passes."""

    def __init__(self, steps: list[int], cuts: list[bool], areas: list[Any]) -> None:
        self.steps, self.cuts, self.areas = steps, cuts, areas
        self._known: dict[int, Any] = {}

    def __call__(self, k: int) -> Any:
        if k not in self._known:
            end = next((i for i in range(k, len(self.steps)) if self.steps[i] != self.steps[k]), len(self.steps))
            found = shapely.Polygon()
            for i in range(end - 1, k - 1, -1):
                self._known[i] = found
                found = shapely.union(found, self.areas[i]) if self.cuts[i] else found
        return self._known[k]


def _bored(tool: Tool, shape: Floats, way: Floats, left: Any, covered: Any) -> Iterator[Met]:
    """What a boring tool takes that cannot be a bore: material on the axis.

    There either the bar, between tip and axis, is in the core that a short edge leaves, or a long one reaches over the axis
    and cuts backwards.
    """
    if tool.kind == "boring" and way[:, 1].min() < -TOLERANCE:  # beyond the axis the bar stands between it and the tip
        bar = shapely.MultiPoint(np.vstack([np.abs(way), way]) * np.repeat([(1, 1), (1, 0)], len(way), axis=0)).convex_hull
        if met := _deepest("holder", left, bar):
            yield met._replace(said=FULL)
            return
    if tool.kind != "boring" or not _on_axis(left, covered):
        return
    if not tool.width:
        below = shapely.box(-FAR, -FAR, FAR, -edge_length(tool))
        bar = shapely.get_coordinates(shapely.intersection(shapely.Polygon(shape), below))
        if len(bar) and (met := _deepest("holder", left, _swept([bar], [way])[0])):
            yield met._replace(said=BAR)
            return
    if way[:, 1].min() > TOLERANCE and (met := _deepest("holder", left, covered)):
        yield met._replace(said=FULL)


def _on_axis(left: Any, covered: Any) -> bool:
    """Whether what is covered has material on the axis of the part: no hole is there."""
    low, _, high, _ = left.bounds
    core = shapely.intersection(shapely.intersection(left, covered), shapely.box(low, 0.0, high, TOLERANCE))
    return bool(core.area > TOLERANCE * TOLERANCE)


def _widened(cutting: Cutting, tool: Tool, way: Floats, left: Any, covered: Any) -> Iterator[Met]:
    """What opens no hole where there is none, and a tap whose core does not fit into the hole."""
    if tool.opens_holes:
        return
    unit = cutting.path.unit
    if _on_axis(left, covered) and (met := _deepest("solid", left, covered)):
        yield met._replace(said=solid(tool, False, unit))
    elif tool.core:
        core = _bar(tool, tool.core, CHAMFER * tool.pitch, float(np.ptp(np.asarray(left.bounds)[[0, 2]]))) * mirror_of(tool)
        if met := _deepest("solid", left, _swept([core], [way])[0]):
            yield met._replace(said=solid(tool, True, unit))


def _height(cutting: Cutting, rows: Index, left: Any) -> float:
    """From a tip to above everything, mm."""
    places = np.abs(np.concatenate([cutting.path.start[rows], cutting.path.end[rows]]))
    low, _, high, top = left.bounds
    return float(2 * max(places.max(initial=0.0), top, abs(low), abs(high)) + 10.0)


def _way(cutting: Cutting, row: int) -> Floats:
    """The places (m, 2) of a row, chords of an arc; one where only its end counts, or where it has no length."""
    path = cutting.path
    start, end = path.start[row][[2, 0]], path.end[row][[2, 0]]
    arc = path.kind[row] == Kind.ARC
    if cutting.from_home[row] or (not arc and np.hypot(*(end - start)) < 1e-9):
        return end[None]
    if not arc:
        return np.array([start, end])
    centre, sweep = path.centre[row][[2, 0]], float(path.sweep[row] * path.axis[row, 1])
    return _arc(start, end, centre, sweep).points_within(CHORD_ERROR)


def _arc(start: Floats, end: Floats, centre: Floats, sweep: float) -> Contour:
    """An arc in quarters, so that a whole circle is one too."""
    parts = max(int(np.ceil(abs(sweep) / (np.pi / 2) - 1e-9)), 1)
    turn, arm = sweep * np.arange(1, parts) / parts, start - centre
    across = np.array([-arm[1], arm[0]])
    between = centre + np.cos(turn)[:, None] * arm + np.sin(turn)[:, None] * across
    return Contour(np.vstack([start, between, end]), [np.tan(sweep / parts / 4)] * parts + [0.0], closed=False)


def _deepest(kind: str, body: Any, covered: Any) -> Met | None:
    """Where an area is deepest in a body, if it is in it deeper than it may touch."""
    met = shapely.intersection(body, covered)
    if met.area < AREA or (met := broad(met, TOLERANCE)).is_empty:
        return None
    circle = shapely.get_coordinates(shapely.maximum_inscribed_circle(met))[:1]
    points = np.vstack([shapely.get_coordinates(shapely.segmentize(met, APART)), circle])
    surface = shapely.intersection(shapely.boundary(body), shapely.box(-1e6, AXIS, 1e6, 1e6))
    depths = shapely.distance(shapely.points(points), surface)
    k = int(np.argmax(depths))
    return Met(kind, SAID.get(kind, HOLDER), (float(points[k, 0]), float(points[k, 1])), float(depths[k]))


def _folded(area: Any) -> Any:
    """An area with what of it lies below the axis turned up: it meets the other side of the bar."""
    return shapely.union(area, shapely.transform(area, lambda each: each * (1.0, -1.0)))


def _held(rest: Any) -> Any:
    """What is still connected to the chuck: a piece that is parted off falls."""
    pieces = [each for each in shapely.get_parts(rest) if each.geom_type == "Polygon" and each.area > AREA]
    return min(pieces, key=lambda each: (each.bounds[0], -each.area)) if pieces else shapely.Polygon()
