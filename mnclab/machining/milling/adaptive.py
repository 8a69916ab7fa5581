"""Clearing whose engagement a limit bounds: front after front into the material, from what is cleared. Lengths in mm.

The first front is that of a spiral in the greatest circle, or where a `stock` leaves room, what lies beside that; the passes
beyond fronts are those of `fronts`. They leave to the pass along the wall what it can take within the same limit: LEFT of the
stepover along walls and TRIM of it at the ends of passes, less towards corners and narrow places.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from mnclab.geometry import shapely
from mnclab.geometry.biarcs import smoothed
from mnclab.geometry.contours import Contour, joined
from mnclab.geometry.curves import Floats, length_of
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import CHORD_ERROR, polygons
from mnclab.machining.milling.clearing import (
    HOPPED,
    LIFTED,
    LINKED,
    Clearing,
    Piece,
    begin,
    end,
    numbered,
    tool_centres,
)
from mnclab.machining.milling.fronts import (
    FINE,
    TRIM,
    Fronts,
    difference,
    greatest_step,
    intersection,
    only_areas,
    opened,
)
from mnclab.machining.milling.spirals import through
from mnclab.text.alarm import Alarm

UNROUND = math.radians(1.7)  # that a spiral of half circles, whose turns are not concentric, keeps from the limit
WIDEST = 1.5  # of the radius: a greater stepover bounds next to nothing
NARROWEST = 0.05  # of the radius: the smaller, the more of the passes is above the limit, at 0.04 up to 3 %
LEFT = 0.6  # of the stepover: what stands along a wall
TAPER = 2.0  # times the stepover, on which LEFT begins
ENOUGH = 0.6  # of the radius of the greatest circle: that of any circle at the end where a peeling begins
SPARED = 0.01  # of the radius: what stands elsewhere


def adaptive(
    region: Region, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True,
    stock: Region | None = None, smallest: float | None = None,
) -> Clearing:  # fmt: skip
    """An area cleared so that the engagement never is above that of a straight cut with the stepover, arccos(1 - stepover / R).

    The limit holds outside the entries (labels "entry …") and, in the pass along a wall, beside a corner of that pass. Arcs of
    the tool-centre path in the material are not smaller than `smallest`, by default a tenth of the radius. Where a `stock` is
    given there is material in it alone: sides beyond it are open, and the tool comes in from there. Where a pass begins, at the
    edge of what is cleared, its radius may be smaller. An Alarm for a stepover below a twentieth of the radius, where passes are
    too fine to keep the limit.

    >>> pocket = mnc.area.Region.of(mnc.area.rectangle(40, 20))
    >>> len(mnc.strategies.adaptive(pocket, 4, 3).pieces)  # it goes down once
    1
    """
    plan = partial(adaptive_piece, radius=radius, stepover=stepover)
    return in_climb(region, radius, stepover, allowance, climb, smallest, plan, stock)


def peeling(
    region: Region, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True,
    stock: Region | None = None, smallest: float | None = None,
) -> Clearing:  # fmt: skip
    """A slot peeled from one end to the other in bows from wall to wall, with the engagement and options of `adaptive`.

    The tool goes down where the end of the slot is wide enough for a spiral. Any other area is peeled away from there, too.

    >>> slot = mnc.area.Region.of(mnc.area.rectangle(60, 14))
    >>> len(mnc.strategies.peeling(slot, 4, 3).pieces)  # it goes down once
    1
    """
    plan = partial(adaptive_piece, radius=radius, stepover=stepover, name="peeling", first=_farthest)
    return in_climb(region, radius, stepover, allowance, climb, smallest, plan, stock)


def in_climb(
    region: Region, radius: float, stepover: float, allowance: float, climb: bool, smallest: float | None,
    plan: Callable[[Region, float, Any], Piece], stock: Region | None = None,
) -> Clearing:  # fmt: skip
    """An area cleared by the `plan` of each part of where the tool centre may go, the smallest radius, and the stock there.

    It plans climb milling; conventional milling is that in a mirror.
    """
    least = radius / 10 if smallest is None else smallest
    if not 0 < least <= radius:
        raise ValueError(f"the smallest radius must lie above 0 and not above that of the tool, {radius:g}, got {least:g}")
    turn = np.array([[1.0 if climb else -1.0, 0, 0], [0, 1, 0]])
    centres = _turned(tool_centres(region, radius, stepover, allowance), turn)
    solid = None if stock is None else polygons(_turned(stock, turn))
    pieces = [plan(part, least, solid) for part in centres.parts]
    return Clearing(_turned(centres, turn), tuple(_mirrored(piece, turn) for piece in pieces if piece.passes), radius)


def _turned(region: Region, turn: Floats) -> Region:
    """A region as it is, or in a mirror."""
    if turn[0, 0] > 0:
        return region
    return Region(tuple(loop.transformed(turn).reversed() for loop in region.loops))


def _mirrored(piece: Piece, turn: Floats) -> Piece:
    if turn[0, 0] > 0:
        return piece
    passes = tuple(way.transformed(turn) for way in piece.passes)
    return replace(piece, centres=_turned(piece.centres, turn), passes=passes)


def _widest(part: Any, radius: float) -> Floats:
    """The middle of the greatest circle in an area."""
    return np.asarray(shapely.get_coordinates(shapely.maximum_inscribed_circle(part, tolerance=radius / 1000))[0])


def adaptive_piece(
    centres: Region, least: float, stock: Any = None, *, radius: float, stepover: float,
    name: str = "adaptive", first: Callable[[Any, float], Floats] = _widest,
) -> Piece:  # fmt: skip
    """The passes of one piece of where the tool centre may go, climb, from the place in each part where it goes down `first`."""
    if stepover < (1 - 1e-9) * NARROWEST * radius:
        said = f"{name} keeps its engagement from a stepover of {NARROWEST * radius:g} mm on, a twentieth of the tool radius"
        raise Alarm(f"{said}, got {stepover:g}", hint="another strategy, or a smaller tool")
    stepover = min(stepover, WIDEST * radius)
    room, soft = _room_for_passes(centres, radius, stepover, least)
    free = None if stock is None else difference(room, shapely.buffer(stock, radius, quad_segs=32))
    passes, links, labels, from_side = list[Contour](), list[int](), list[str](), False  # links[k] leads to passes[k]
    reached: list[Any] = []  # what is cleared of the room, without what passes have left at their ends
    for part in shapely.get_parts(room):
        if not part.area > 0:
            continue
        fronts = Fronts(part, soft, radius, stepover, stock)
        cleared = None if free is None else intersection(part, free)
        if cleared is None or cleared.area < radius**2 / 100:
            entry, spiral, cleared = _opening(part, first(part, radius), radius, fronts.phi - UNROUND)
            passes += [entry, spiral] if spiral is not None else [entry]
            links += [LIFTED, LINKED][: len(passes) - len(links)]
            labels += ["entry spiral", "spiral"][: len(passes) - len(labels)]
        elif not passes:
            from_side = True
        count = len(passes)
        for line in fronts.passes(cleared, end(passes[-1]) if passes else np.zeros(2)):
            way = smoothed(line, radius / FINE, radius / 1000)
            links.append(LIFTED if not passes else _across(fronts.area, end(passes[-1]), begin(way), radius, fronts))
            passes.append(way)
        labels += numbered("pass", len(passes) - count)
        reached.append(difference(fronts.area, shapely.union_all(fronts.rest)))
    cleared = shapely.union_all(reached)
    for loop in sorted(centres.loops, key=lambda loop: loop.area):
        for way in _along_wall(loop, room, radius, stock):
            links.append(_across(cleared, end(passes[-1]), begin(way), radius) if passes else LIFTED)
            passes.append(way)
            labels.append("island" if loop.area < 0 else "wall")
    return Piece(centres, tuple(passes), tuple(links[1:]), tuple(labels), None, from_side, from_cleared=True)


def _farthest(part: Any, radius: float) -> Floats:
    """The middle of the greatest circle at the end of an area that is farthest from the middle of the greatest of all."""
    line = shapely.maximum_inscribed_circle(part, tolerance=radius / 1000)
    middles = shapely.get_coordinates(shapely.buffer(part, -ENOUGH * line.length))
    farthest = middles[length_of(middles - shapely.get_coordinates(line)[0]).argmax()]
    return _widest(intersection(part, shapely.buffer(shapely.Point(farthest), 1.5 * line.length)), radius)


def _opening(part: Any, centre: Floats, radius: float, phi: float) -> tuple[Contour, Contour | None, Any]:
    """A spiral from a centre in an area until it touches the wall: the part of it within a radius of the centre, the rest, and
    what it clears."""
    line = shapely.shortest_line(shapely.Point(centre), shapely.boundary(part))
    touched = shapely.get_coordinates(line)[1]
    reach, away = float(line.length), [0.0]
    least = radius * min(0.05, (1 - math.cos(phi)) / 4)  # wider from half circle to half circle
    away.append(min(reach, greatest_step(np.array(1e-9), radius, phi).item()))
    while away[-1] < reach:
        wider = away[-2] + greatest_step(np.array(max(away[-2], 1e-9)), radius, phi).item()
        away.append(min(reach, max(wider, away[-1] + least)))
    count = len(away) - 1
    way = through(centre, away, math.atan2(*(touched - centre)[::-1]) - math.pi * count)
    inner = sum(far <= radius for far in away) - 1
    apart = float(way.upto[inner])
    first, rest = way.between(0.0, apart), way.between(apart, way.length) if inner < count else None
    if count < 4:  # there is no turn within the last one
        ring = Contour.circle(centre, reach, math.atan2(*(touched - centre)[::-1]))
        whole = joined(each for each in (rest, ring.between(0.0, ring.length)) if each is not None)
        return first, whole, intersection(shapely.buffer(shapely.Point(centre), reach + 2e-3 * radius, quad_segs=64), part)
    turn = way.between(float(way.upto[-3]), way.length).points_within(CHORD_ERROR)
    return first, rest, intersection(shapely.buffer(shapely.Polygon(turn), 2e-3 * radius), part)


def _along_wall(loop: Contour, room: Any, radius: float, stock: Any) -> Iterator[Contour]:
    """The pass along a wall, begun where passes have cut up to it, else on a quarter circle; in stock alone."""
    ways = np.linspace(0, loop.length, max(8, math.ceil(loop.length * FINE / radius)), endpoint=False)
    spots = loop.point_at(ways)[0]
    if stock is not None:
        cuts = shapely.dwithin(stock, shapely.points(spots), radius)
        if not cuts.all():
            yield from _stretches(loop, ways, cuts)
            return
    off = shapely.distance(room, shapely.points(spots))
    turned = loop.started_at(float(ways[off.argmin()]))
    if off.min() <= 2 * SPARED * radius:
        yield turned
        return
    at, ahead = turned.point_at([0.0])
    inward = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
    size = radius
    while not shapely.contains_xy(room, *(at + size * (inward - ahead))[0]):
        size *= 0.8
        if size < 0.1 * radius:  # a narrow place, where nothing is cleared but along the wall
            yield turned
            return
    lead = Contour([(at + size * (inward - ahead))[0], at[0]], [math.tan(math.pi / 8), 0.0], closed=False)
    yield joined([lead, turned.between(0.0, turned.length)])


def _stretches(loop: Contour, ways: Floats, cuts: Any) -> Iterator[Contour]:
    """The parts of a wall that stand in stock."""
    if not cuts.any():
        return
    first = int(np.flatnonzero(~cuts)[0])
    loop, cuts = loop.started_at(float(ways[first])), np.roll(cuts, -first)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], cuts, [False]]))).reshape(-1, 2)
    for a, b in edges.tolist():
        yield loop.between(float(ways[max(a - 1, 0)]), float(ways[b]) if b < len(ways) else loop.length)


def _across(room: Any, a: Floats, b: Floats, radius: float, fronts: Fronts | None = None) -> int:
    """How the tool gets from the end of a pass to the begin of the next: straight through what is cleared, or it lifts."""
    if length_of(b - a) < 1e-6:
        return LINKED
    inside = shapely.covers(shapely.buffer(room, 2e-3 * radius), shapely.LineString([a, b]))
    return HOPPED if inside and (fronts is None or fronts.clear(a, b)) else LIFTED


def _room_for_passes(centres: Region, radius: float, stepover: float, least: float) -> tuple[Any, Any]:
    """Where passes may go, and the strip along the walls in which their ends may stop short.

    LEFT of the stepover stands along a wall for the pass along it. Where a wall bends so that this would be too much for that
    pass, and beside corners and narrow places, it is less, and nothing where they are.
    """
    whole = polygons(centres)
    most = (LEFT + TRIM) * stepover
    wide, wider = (_roomy(whole, left * stepover, radius, stepover) for left in (LEFT, LEFT + TRIM))
    room, soft = shapely.buffer(whole, -SPARED * radius, quad_segs=32), []
    for loop in centres.loops:
        ways = np.linspace(0, loop.length, max(8, math.ceil(loop.length * FINE / radius)), endpoint=False)
        at, ahead = loop.point_at(ways)
        away = _apart(~shapely.contains_xy(wide, *at.T), loop.length)
        share = np.clip((away - 0.3 * radius) / TAPER / stepover, 0.0, 1.0)
        share = share * share * (3 - 2 * share)
        inward = np.stack([-ahead[:, 1], ahead[:, 0]], axis=1)
        moved = only_areas(shapely.make_valid(shapely.Polygon(at + inward * (share * LEFT * stepover)[:, None])))
        room = intersection(room, moved) if loop.area > 0 else difference(room, moved)
        beyond = _apart(~shapely.contains_xy(wider, *at.T), loop.length) > 0.3 * radius + TAPER * stepover
        edge = np.flatnonzero(np.diff(np.concatenate([[False], beyond, [False]]))).reshape(-1, 2)
        for a, b in edge.tolist():
            ring = np.vstack([at, at[:1]])[a : b + 1] if beyond.all() else at[a:b]
            if len(ring) > 1:
                soft.append(shapely.buffer(shapely.LineString(ring), 1.05 * most, cap_style="flat"))
    return only_areas(shapely.simplify(opened(room, least), 4e-4 * radius)), shapely.union_all(soft)


def _roomy(whole: Any, left: float, radius: float, stepover: float) -> Any:
    """Where walls bend so little that a pass along them can take what is `left`."""
    bend = left * (2 * radius - left) / (2 * (stepover - left))  # the radius of a concave wall with so much at the limit
    area = shapely.buffer(opened(whole, bend), 2e-3 * radius)
    shapely.prepare(area)
    return area


def _apart(marked: Any, length: float) -> Floats:
    """How far places that divide a loop of a length evenly are from the marked ones along it."""
    places = np.flatnonzero(marked)
    if not len(places):
        return np.full(len(marked), np.inf)
    gap = np.abs(np.arange(len(marked))[:, None] - places)
    return np.minimum(gap, len(marked) - gap).min(axis=1) * length / len(marked)
