"""What a mill meets that it must not: a body of the tool goes along a move, and material stands where it passes.

Looked at are points under the body (`judging`), and of each the exact height of the material before that move (`sweep`); no
cells, so nothing is blamed on a grid. Of a large program only the moves are looked at that may collide: rapids below the top
of the blank that do not go where the same tool has been as deep, plunges of tools that do not cut at their centre, drills
that go sideways, cuts with a spindle that is wrong, moves so deep that a shank or a holder comes below the top. The more of a
kind there are, the fewer points each gets, and of more than 20,000 of a kind only every second, third, … is looked at.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from mnclab.path.tool import CHAMFER, Tool
from mnclab.path.toolpath import Array, Index, Kind, Mask
from mnclab.text.alarm import several
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.clamped import Clamped, Placement
from mnclab.workpiece.collision import Collision, Collisions, deep, solid
from mnclab.workpiece.cutting import TURNED, UPRIGHT, Cutting, frames_along
from mnclab.workpiece.milling.judging import (
    MOST,
    TOLERANCE,
    Body,
    Judged,
    Judging,
    Met,
    above_edges,
    apart,
    bodies_of,
    edges,
    holder,
    under,
)
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.milling.moves import Cutter, cut_up, moves_of
from mnclab.workpiece.milling.raster import AT_ONCE
from mnclab.workpiece.milling.swept import left_by
from mnclab.workpiece.milling.tilted import meeting, rows_round, wound
from mnclab.workpiece.part import Part

ROUGH, FEW = 60, 200  # points of a cut, enough to see whether it takes anything, and of what is behind the edges
MOST_ROUND = 100  # rows on which a drum turns that are judged: each over what all before have left
FALL = 0.1  # mm, by which a move may fall before it is cut up: its edges are before its shank
POINTED = ("drill", "reamer", "countersink", "tap")  # tools that go straight down, and may
MIDDLE = Body("middle", Cutter(0.0, 0.0), TOLERANCE)  # the axis of a tool
ALONG = ("drill", "reamer", "tap")  # tools that cut along their axis alone


def collisions_of(cutting: Cutting, step: float | None = None) -> Collisions:
    """What the rows of a cutting meet that they must not, one of each row and kind; see `KINDS`.

    `step` mm between the points that are looked at, a four-hundredth of the longer side of the blank by default. A row
    that only touches, within 0.01 mm, meets nothing. Where the tool turns and may come to the blank, it is not judged, which a
    note says.
    """
    found: dict[tuple[int, str], Collision] = {}
    for own, first, turn in [(cutting, 0, None)] if cutting.tilted is None else clampings(cutting):
        for kind, said, met in _kinds(Judging.of(own, step or apart(cutting))):
            row, place = met.row + first, met.place if turn is None else tuple((turn @ met.place).tolist())
            line, program = int(cutting.path.line[row]), int(cutting.path.program[row])
            message = f"{said}, {deep(met.depth, 'XYZ', place, cutting.path.unit)}{_hint(own, kind, met.row)}"
            each = Collision(kind, message, line, program, row, place, met.depth, _file(cutting, line, program))
            known = found.get((row, kind))
            if known is None or each.depth > known.depth:
                found[row, kind] = each
    return Collisions(found.values(), _not_judged(cutting))


def clampings(cutting: Cutting) -> Iterator[tuple[Cutting, int, Array | None]]:
    """Rows of one direction of the tool that follow each other, as those of an upright tool over what the rows before have
    left; the first row of each, and the frame (3, 3) along the tool, None along Z."""
    assert cutting.directions is not None
    begins = np.append(True, cutting.turning[1:] | cutting.turning[:-1])
    begins[1:] |= (np.abs(np.diff(cutting.directions[:, 2], axis=0)) > TURNED).any(axis=1)
    ends, near = np.append(np.flatnonzero(begins)[1:], len(cutting)), {*_near_drum(cutting)[:MOST_ROUND].tolist()}
    for first, last in zip(np.flatnonzero(begins).tolist(), ends.tolist()):
        if cutting.turning[first] or not cutting.path.is_motion[first:last].any():
            yield from _wound(cutting, first) if first in near else ()
            continue
        turn, own = frames_along(cutting.directions[first : first + 1, 2])[0], cutting.rows(slice(first, last))
        if turn[2, 2] > UPRIGHT:
            bare = not cutting.until(first - 1).cuts.any() if first else True
            stock = cutting.stock if bare else Clamped(_left(cutting, first), Placement(turn.T))
            yield replace(own, directions=None, stock=stock), first, None
        else:
            yield _aslant(own, turn, _left(cutting, first)), first, turn


def _near_drum(cutting: Cutting) -> Index:
    """The rows on which a drum turns and a tool meets it with what must not: not above its farthest place with its rapids, an
    edge that does not cut or stands, its shank and holder."""
    rows, path = rows_round(cutting), cutting.path
    row, (first, _, last), (starts, ends) = wound(cutting, rows)
    if not len(row):
        return row
    lifts = [min((body.lift for body in (*above_edges(tool), *holder(tool))), default=np.inf) for tool in cutting.tools]
    idle = np.array([tool.kind in ALONG for tool in cutting.tools])[cutting.which[row]] | (path.kind[row] == Kind.RAPID)
    turns = np.array([1 if tool.hand == "right" else -1 for tool in cutting.tools])[cutting.which[row]]
    idle |= path.spindle[row] * turns <= 0
    axis, point = path.axis[row], path.centre[row]
    lines, which = np.unique(np.hstack([axis, np.cross(axis, point)]).round(6), axis=0, return_inverse=True)
    places = np.concatenate(cutting.stock.edges())  # a line is its direction and its moment about the origin (Plücker)
    reach = np.array([np.linalg.norm(np.cross(line[:3], places) - line[3:], axis=1).max() for line in lines])
    above = (np.einsum("ij,ij->i", end - path.centre[row], up) for end, up in ((starts, first), (ends, last)))
    low = np.minimum(*above) + np.where(idle, 0.0, np.array(lifts)[cutting.which[row]])
    return rows if len(cutting.fixtures) else np.unique(row[low < reach[which.ravel()] + TOLERANCE])


def _wound(cutting: Cutting, row: int) -> Iterator[tuple[Cutting, int, Array]]:
    """A row on which a drum turns, piece by piece, each in the direction in its middle."""
    own, body = cutting.rows(slice(row, row + 1)), _left(cutting, row)
    columns = {name: getattr(own.path, name) for name in own.path.all_but_ends()}
    columns["kind"] = np.where(own.path.kind == Kind.ARC, Kind.LINE, own.path.kind)
    _, (_, ups, _), (starts, ends) = wound(cutting, np.array([row]))
    for turn, start, end in zip(frames_along(ups), starts, ends):
        piece = replace(own, path=own.path.replace(**columns, start=start[None], end=end[None]))
        yield _aslant(piece, turn, body), row, turn


def _left(cutting: Cutting, row: int) -> Milled:
    """What the rows before a row leave."""
    return Milled(cutting.until(row - 1) if row else replace(Cutting.of_nothing(cutting.stock), origin=cutting.origin))


def _aslant(own: Cutting, turn: Array, body: Milled) -> Cutting:
    """Rows with the tool along Z of a frame (3, 3), over what is left of a blank."""
    place = Placement(turn.T)
    fixtures = tuple(_seen(fixture, place) for fixture in own.fixtures)
    return replace(own.seen_along(turn), stock=Clamped(body, place), fixtures=fixtures)


def _seen(fixture: Blank | Part, place: Placement) -> Blank | Part:
    """A fixture where it stands in another frame."""
    if isinstance(fixture, Part):
        return fixture.placed(np.block([[place.turn, np.zeros((3, 1))], [np.zeros(3), 1.0]]))
    return Clamped(Milled(Cutting.of_nothing(fixture)), place)


def _not_judged(cutting: Cutting) -> Iterator[str]:
    """What is not looked at, in a sentence for people."""
    out = meeting(cutting) & ~cutting.round_
    out[_near_drum(cutting)[MOST_ROUND:]] = True
    if out.any():
        yield f"{several(int(out.sum()), 'row')} on which the tool turns not judged ({cutting.lines(out)})"


def _hint(cutting: Cutting, kind: str, row: int) -> str:
    """What a learner has forgotten, where the mistake is a known one."""
    if kind == "plunge":
        return " (a ramp, a helix or a hole drilled before)"
    if kind != "rapid":
        return ""
    x, y, _ = (cutting.path.end[row] - cutting.path.start[row]).tolist()
    down = x == y == 0
    return " (a rapid ends above the material, the rest goes at feed)" if down else " (first Z above the part, then X and Y)"


def _file(cutting: Cutting, line: int, program: int) -> str:
    return str(cutting.name(line, program)).rpartition(":")[0]


def _kinds(scene: Judging) -> Iterator[tuple[str, str, Met]]:
    """Kind, sentence and place of whatever is met."""
    for met in scene.met(_rapids(scene)):
        yield "rapid", "rapid motion in material", met
    for met in scene.met(_plunges(scene)):
        yield "plunge", "straight down into material with a tool that does not cut at its centre", met
    for met in scene.met(_widened(scene)):
        yield "solid", solid(scene.cutting.tool(met.row), met.body.cutter.radius > 0, scene.cutting.path.unit), met
    for met in scene.met(_sideways(scene), ROUGH):
        yield "sideways", f"the {scene.cutting.tool(met.row).kind} goes sideways in material, where it has no edges", met
    for met in scene.met(_still(scene), ROUGH):
        yield "spindle", _of_spindle(scene.cutting, met.row), met
    cut = _cut_up(scene)
    for kind, bodies in (("shank", above_edges), ("holder", holder)):
        for met in cut.met(_behind(cut, bodies), FEW):
            yield kind, f"the {met.body.name} in material", met
    for met in _probes(scene):
        yield "probe", "the probe in material", met
    yield from in_fixtures(scene)


def _rapids(scene: Judging) -> list[Judged]:
    """Rapids that come below the top of the blank, except where the same tool has stood as deep."""
    chosen = scene.rapid & scene.low_over(0.0)
    chosen &= ~_been_there(scene, chosen & scene.standing)
    bodies = [edges(tool) for tool in scene.cutting.tools]
    return [Judged(int(k), bodies[scene.which[k]], int(k)) for k in np.flatnonzero(chosen)]


def _been_there(scene: Judging, chosen: Mask) -> Mask:
    """Which of the chosen moves, that stand in the plane, go where the same tool has been as deep before (k,)."""
    found, low = np.zeros(len(chosen), dtype=bool), scene.moves.low
    ends = np.stack([scene.moves.start, scene.moves.end])
    for tool in np.unique(scene.which[chosen]):
        mine = np.flatnonzero(scene.which == tool)
        places = np.round(ends[:, mine, 0], 6) + 1j * np.round(ends[:, mine, 1], 6)
        _, spot = np.unique(places, return_inverse=True)
        spot = spot.reshape(places.shape)
        of_interest = np.isin(spot, spot[0, chosen[mine]]).any(axis=0)
        deepest = np.full(int(spot.max()) + 1, np.inf)
        for k, (here, there) in zip(mine[of_interest].tolist(), spot[:, of_interest].T.tolist()):
            found[k] = deepest[here] <= low[k]
            deepest[here] = min(deepest[here], ends[0, k, 2])
            deepest[there] = min(deepest[there], ends[1, k, 2])
    return found & chosen


def _plunges(scene: Judging) -> list[Judged]:
    """Moves straight down at feed with a tool that is known not to cut at its centre: its axis is looked at."""
    blunt = scene.of_tools(lambda tool: float(tool.centre_cutting is False and tool.kind not in POINTED)) > 0
    down = scene.moves.end[:, 2] < scene.moves.start[:, 2]
    chosen = blunt & down & scene.standing & ~scene.rapid & scene.low_over(0.0)
    return [Judged(int(k), MIDDLE, int(k)) for k in np.flatnonzero(chosen)]


def _widened(scene: Judging) -> list[Judged]:
    """Moves straight down at feed of what opens no hole: its axis, and of a tap what does not fit into the hole."""
    down = scene.moves.end[:, 2] < scene.moves.start[:, 2]
    chosen = down & scene.standing & ~scene.rapid & scene.low_over(0.0)
    bodies = [_without_hole(tool) for tool in scene.cutting.tools]
    return [Judged(int(k), body, int(k)) for k in np.flatnonzero(chosen) for body in bodies[scene.which[k]]]


def _without_hole(tool: Tool) -> list[Body]:
    """Of a tool that opens no hole, what must find one. The chamfer of a tap is narrower than its thread."""
    if tool.opens_holes:
        return []
    core = tool.core - TOLERANCE
    return [*([Body("core", Cutter(core, core), CHAMFER * tool.pitch + TOLERANCE)] if core > 0 else []), MIDDLE]


def _sideways(scene: Judging) -> list[Judged]:
    """Moves at feed across the axis of a tool that cuts along it alone."""
    along = scene.of_tools(lambda tool: float(tool.kind in ALONG)) > 0
    chosen = along & ~scene.standing & ~scene.rapid & scene.low_over(0.0)
    bodies = [edges(tool) for tool in scene.cutting.tools]
    return [Judged(int(k), bodies[scene.which[k]], int(k)) for k in np.flatnonzero(chosen)]


def _probes(scene: Judging) -> Iterator[Met]:
    """Where the ball of a probe, its south pole at the tip, goes through material."""
    cutting = scene.cutting
    if not cutting.probed.any():
        return
    among = Judging(cutting, moves_of(cutting, cutting.cuts | cutting.probed, TOLERANCE / 10), scene.step)
    mine = cutting.probed[among.moves.row]
    chosen = mine & ~among.rising & among.low_over(0.0)
    among.boxes[mine] = np.nan  # a ball clears nothing
    radii = [max(tool.effective_radius - TOLERANCE, 0.0) for tool in cutting.tools]
    balls = [Body("probe", Cutter(radius, 0.0, radius), TOLERANCE) for radius in radii]
    yield from among.met([Judged(int(k), balls[among.which[k]], int(k)) for k in np.flatnonzero(chosen)])


def _still(scene: Judging) -> list[Judged]:
    """Moves at feed whose spindle stands or turns against the hand of the tool."""
    sense = np.sign(scene.cutting.path.spindle[scene.moves.row])
    hand = scene.of_tools(lambda tool: 1.0 if tool.hand == "right" else -1.0)
    chosen = ~scene.rapid & (sense != hand) & scene.low_over(0.0)
    bodies = [edges(tool) for tool in scene.cutting.tools]
    return [Judged(int(k), bodies[scene.which[k]], int(k)) for k in np.flatnonzero(chosen)]


def _of_spindle(cutting: Cutting, row: int) -> str:
    if cutting.path.spindle[row] == 0:
        return "cutting with a spindle that stands still"
    hand = cutting.tool(row).hand
    code = "M4" if hand == "right" else "M3"
    return f"cutting with a spindle that turns the wrong way ({code}; the tool cuts {hand}-handed)"


def _cut_up(scene: Judging) -> Judging:
    """The same with falling moves cut up, where a shank or a holder may come below the top of the blank."""
    lift = scene.of_tools(lambda tool: min((body.lift for body in (*above_edges(tool), *holder(tool))), default=np.inf))
    fall = np.abs(scene.moves.end[:, 2] - scene.moves.start[:, 2])
    chosen = np.isfinite(lift) & ~scene.standing & (fall > FALL) & scene.low_over(np.inf, lift)
    if not chosen.any():
        return scene
    return Judging(scene.cutting, cut_up(scene.moves, np.where(chosen, np.ceil(fall / FALL), 1).astype(np.int64)), scene.step)


def _behind(scene: Judging, bodies: Callable[[Tool], list[Body]]) -> list[Judged]:
    """Moves so deep that one of the bodies behind the edges comes below the top of the blank."""
    found = []
    down = scene.moves.end[:, 2] < scene.moves.start[:, 2]
    fall = np.abs(scene.moves.end[:, 2] - scene.moves.start[:, 2])
    for index, tool in enumerate(scene.cutting.tools):
        mine = scene.which == index
        for body in bodies(tool) if mine.any() else ():
            wide = max(body.cutter.radius - tool.effective_radius, 0.0)
            for k in np.flatnonzero(mine & ~scene.rising & scene.low_over(wide, body.lift)):
                upright = bool(scene.standing[k])
                hole = upright and down[k] and not scene.rapid[k] and body.inner == 0
                before = int(scene.stay[k]) if hole else int(k)  # the pecks of a hole do not clear one another
                found.append(Judged(int(k), body, before, 0.0 if upright else float(fall[k])))
    return sorted(found, key=lambda each: each.move)


# A mill in what holds the blank: its edges, its shank or its holder lower than a fixture's top, at points of both.

GRID, FINE = 60, 240  # points along each side of a fixture; of all that the tools reach, where a part is looked for
ABOVE = 1000.0  # mm above the path, from where the top of a part is looked for
CLOSED, STEPS = 1e-6, 400  # mm that count as touched, and steps down to it


class Held(NamedTuple):
    """Points (m,) of a fixture, its top there, and how far the points lie from one another, mm."""

    x: Array
    y: Array
    top: Array
    apart: float


def in_fixtures(scene: Judging) -> Iterator[tuple[str, str, Met]]:
    """Kind, sentence and place of whatever of a tool is in a fixture."""
    for fixture in scene.cutting.fixtures:
        held = _points(scene, fixture)
        if not len(held.x):
            continue
        for index, tool in enumerate(scene.cutting.tools):
            mine = (scene.which == index) & ~scene.rising
            for body in bodies_of(tool) if mine.any() else ():
                for met in _met(scene, fixture, held, np.asarray(mine), body):
                    yield "fixture", f"the {body.name} in a fixture", met


def _met(
    scene: Judging, fixture: Blank | Part, held: Held, mine: Array, body: Body
) -> Iterator[Met]:
    x, y, top, apart = held
    bounds = np.array([[x.min(), y.min(), -np.inf], [x.max(), y.max(), top.max()]])
    ends, wide = scene.boxes, body.cutter.radius - scene.moves.radius
    near = mine & (ends[:, 0] - wide < bounds[1, 0]) & (ends[:, 1] - wide < bounds[1, 1])
    near &= (ends[:, 2] + wide > bounds[0, 0]) & (ends[:, 3] + wide > bounds[0, 1])
    near &= scene.moves.low + body.lift < top.max()
    step = max(apart, TOLERANCE)
    for k in _close(scene, np.flatnonzero(near), held, body):
        move = scene.moves[k : k + 1].with_cutter(np.array(body.cutter), body.lift)
        own = under(move, body.cutter.radius, bounds, step, MOST)
        own_top = _top(fixture, *own, float(scene.moves.low.min()), float(scene.moves.end[:, 2].max()))
        px, py = np.concatenate([own[0], x]), np.concatenate([own[1], y])
        low = left_by(move, px, py)[0]
        deep = np.fmax(np.concatenate([own_top, top]) - low, 0.0)
        deepest = int(np.round(deep, 6).argmax())
        if deep[deepest] > 0:
            place = float(px[deepest]), float(py[deepest]), float(low[deepest]) - TOLERANCE
            yield Met(int(scene.moves.row[k]), body, place, float(deep[deepest]) + TOLERANCE)


def _close(scene: Judging, moves: Index, held: Held, body: Body) -> Iterator[int]:
    """Those of some moves whose body comes as near to a point of the fixture as its points lie to one another."""
    x, y, top, apart = held
    wider = body.cutter.radius + apart
    many = max(AT_ONCE // len(x), 1)
    for first in range(0, len(moves), many):
        chunk = moves[first : first + many]
        discs = scene.moves[chunk].with_cutter(np.array(Cutter(wider, wider)), body.lift)
        yield from chunk[(left_by(discs, x, y) < top).any(axis=1)].tolist()


def _points(scene: Judging, fixture: Blank | Part) -> Held:
    """A fixture at points of its own, its edges among them: a narrow clamp is not missed.

    How far a part goes nobody says: it is looked for wherever a tool comes.
    """
    moves, many = scene.moves, GRID
    if not len(moves):
        return Held(np.empty(0), np.empty(0), np.empty(0), 0.0)
    if isinstance(fixture, Part):
        many = FINE
        wide = max(body.cutter.radius for tool in scene.cutting.tools for body in bodies_of(tool))
        low, high = scene.boxes[:, :2].min(axis=0) - wide, scene.boxes[:, 2:].max(axis=0) + wide
    else:
        low, high = fixture.bounds[:, :2]
    x, y = (axis.ravel() for axis in np.meshgrid(*np.linspace(low, high, many + 1).T))
    top = _top(fixture, x, y, float(moves.low.min()), float(moves.end[:, 2].max()))
    solid = np.isfinite(top)
    return Held(x[solid], y[solid], top[solid], float(np.hypot(*(high - low))) / many)


def _top(fixture: Blank | Part, x: Array, y: Array, low: float, high: float) -> Array:
    """How high a fixture reaches at points (m,); nan beside it. A part is looked for between `low` and far above `high`."""
    if not isinstance(fixture, Part):
        return fixture.faces(x, y)[1]
    z = np.full(len(x), high + ABOVE)
    going = np.arange(len(x))
    for _ in range(STEPS):
        gap = fixture(np.stack([x[going], y[going], z[going]], axis=1))
        z[going] -= np.maximum(gap, CLOSED)
        going = going[(gap > CLOSED) & (z[going] > low)]
        if not len(going):
            break
    z[going] = low  # grazed, not met
    return np.where(z > low, z, np.nan)
