"""The views of a milled part: from above, from the front or cut, from the left where it is cut again, from below.

First-angle projection: the view from the front is above that from above, the view from the left to its right, the view from
below above it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from mnclab.design.drawing.ledger import BLANK, DIAMETER, Claim, Draft, Ledger, valued
from mnclab.design.drawing.milled_features import DepthLine, Side
from mnclab.design.drawing.projection import Elevation, Levels, Step, edges_from_above
from mnclab.design.drawing.section import Item, Plane, chosen
from mnclab.design.drawing.view import Axis, Cross, Cut, Diameter, Kind, Linear, Point, value
from mnclab.design.model.design import Design
from mnclab.design.model.feature import Feature
from mnclab.design.model.features import Groove, Pocket, Slope
from mnclab.design.model.holes import Hole, core_of
from mnclab.design.model.shapes import Circle, Rectangle
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.workpiece.blank import Box

FRONT = np.eye(3)
LEFT = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])  # to the right what is in front
SAME = 1e-6  # mm
DEEP = 3.0  # worth of a feature whose depth is told by a section only
LEAST = 2  # features that a second section must tell the depth of: a single one has it at a leader


def drafts(design: Design, ledger: Ledger, tabled: int = 0, beside: bool = False) -> list[Draft]:
    """The views with all that is written to them; `tabled` 1 puts holes into a table, 2 all features. The view from below
    stands above the one from the front, or `beside` that from above.
    """
    levels = Levels(design.stack, nested=not design.back)
    (x0, y0, _), (x1, y1, _) = design.bounds.tolist()
    items = list(_items(design, FRONT))
    along = {each.key for each in items if each.begin < x0 + SAME and each.end > x1 - SAME}  # without walls in a section along it
    first = chosen([each for each in items if each.key not in along])
    shows = first.shows if first else frozenset[tuple[bool, int]]()
    top = Draft("from above", (0, 1))
    top.draw(edges_from_above(levels))
    front = _elevation(design, levels, FRONT, first, "A", (0, 0))
    found = [front, top]
    if first:
        top.cuts.append(Cut(first.way(x0, x1), "A", (0.0, 1.0)))
    second = _second(design, [each for each in items if each.key not in shows], along)
    letter = "B" if first else "A"
    if second:
        side = _elevation(design, levels, LEFT, second, letter, (1, 0))
        found.append(side)
        top.cuts.append(Cut(tuple((depth, -u) for u, depth in second.way(-y1, -y0)), letter, (1.0, 0.0)))
    sides = [Side(design, False, top, ledger, shows, second.shows if second else frozenset(), tabled)]
    if design.back:
        said = "from below" + (" (turned over about Y)" if design.turn == "y" else "")
        below = Draft("from below", (1, 1) if beside else (0, -1), said, free=beside or design.turn == "y")
        below.draw([line.transformed(design.flip[0]) for line in edges_from_above(levels, below=True)])
        below.axes += _through(design)
        found.append(below)
        sides.append(Side(design, True, below, ledger, shows, second.shows if second else frozenset(), tabled))
    for each in sides:
        _blank_seen(design, each, ledger)
        each.write()
    _depths(design, front, [level for each in sides for level in each.levels], ledger)
    if second:
        _depths(design, found[2], [level for each in sides for level in each.side_levels], ledger)
    _height(design, front, ledger)
    return found


# ---- sections ----


def _items(design: Design, turn: Floats) -> Iterator[Item]:
    """What a section can show: pockets, slots, grooves and holes; one of several equal ones is worth most."""
    told = set[object]()
    for back, features in ((False, design.features), (True, design.back)):
        for k, each in enumerate(features):
            if not each.recess:
                continue
            key = type(each), back, tuple(m for m in each.measures() if m.kind != "place" or m.name == "top")
            worth = _worth(each) if key not in told else 0.1
            told.add(key)
            line = _placed(design, each, back, turn)
            (u0, v0), (u1, v1) = line.bounds.tolist()
            low = high = (v0 + v1) / 2
            shape = each.contour if isinstance(each, Pocket | Slope) else None
            if isinstance(shape, Rectangle) and abs(shape.turned) < SAME:
                low, high = v0 + shape.corner + 1e-3, v1 - shape.corner - 1e-3
                low, high = (low, high) if low < high else ((v0 + v1) / 2,) * 2
            yield Item((back, k), u0, u1, low, high, (v0, v1), worth)


def _worth(feature: Feature) -> float:
    if isinstance(feature, Hole):
        plain = feature.depth is None and not (feature.counterbore or feature.countersink or feature.thread)
        return 1.0 if plain else 2.0
    return 2.5 if isinstance(feature, Pocket) and isinstance(feature.contour, Circle) else DEEP


def _placed(design: Design, feature: Feature, back: bool, turn: Floats) -> Contour:
    """What a feature takes up in the plane, in the frame of a view."""
    line: Contour | None
    if isinstance(feature, Hole):
        line = Contour.circle((feature.x, feature.y), feature.mouth / 2)
    else:
        line = feature.region.loops[0] if isinstance(feature, Groove) else feature.outline
    assert line is not None  # of a recess
    return line.transformed(turn @ design.flip[0] if back else turn)


def _second(design: Design, left: Sequence[Item], along: set[tuple[bool, int]]) -> Plane | None:
    """A section from the left for what the first one does not show, where only that tells its depth, or it goes `along` that."""
    keys = {each.key for each in left if each.worth >= DEEP}
    if not keys:
        return None
    mine = {each.key for each in left}
    items = [each for each in _items(design, LEFT) if each.key in mine]
    plane = chosen([each if each.key in keys else each._replace(worth=0.1) for each in items])
    return plane if plane and (len(plane.shows & keys) >= LEAST or plane.shows & along) else None


def _elevation(
    design: Design, levels: Levels, turn: Floats, plane: Plane | None, letter: str, cell: tuple[int, int]
) -> Draft:
    steps: tuple[Step, ...] = plane.steps if plane else ()
    seen = Elevation(levels, turn, steps)
    draft = Draft("from the front" if turn is FRONT else "from the left", cell, f"{letter}–{letter}" if plane else "")
    draft.draw(seen.lines())
    draft.hatches = seen.faces() if plane else ()
    low, high = design.bounds[:, 2].tolist()
    shape = _extent(draft)
    corners = (turn @ [*design.bounds[0, :2], 1.0])[0], (turn @ [*design.bounds[1, :2], 1.0])[0]
    u0, u1 = min(corners), max(corners)
    if np.abs(shape - [[u0, low], [u1, high]]).max() > SAME:
        draft.draw([Contour([(u0, low), (u1, low), (u1, high), (u0, high)])], Kind.PHANTOM)
    for back, k in sorted(plane.shows) if plane else ():
        feature = (design.back if back else design.features)[k]
        _cut_marks(design, draft, feature, back, turn)
    return draft


def _cut_marks(design: Design, draft: Draft, feature: Feature, back: bool, turn: Floats) -> None:
    """The axis of what is round, and the thin lines of a thread."""
    low, high = design.bounds[:, 2].tolist()
    flip, turned = design.flip
    top = high if feature.top is None else feature.top

    def at(u: float, z: float) -> Point:
        return u, (turned - z if back else z)

    (u0, _), (u1, _) = _placed(design, feature, back, turn).bounds.tolist()
    u = (u0 + u1) / 2
    if isinstance(feature, Hole):
        deep = low if feature.depth is None else top - feature.depth - feature.tip
        draft.axes.append(Axis(at(u, deep), at(u, top)))
        if feature.thread:
            half = core_of(feature.thread, 0.0) / 2
            end = deep if feature.depth is None else top - feature.depth
            end = end if feature.thread_depth is None else top - feature.thread_depth
            start = top - _above_thread(feature, half)
            draft.draw([Contour([at(u + s * half, start), at(u + s * half, end)], closed=False) for s in (-1, 1)], Kind.THIN)
            if end > low + SAME:
                for s in (-1, 1):
                    draft.draw([Contour([at(u + s * feature.wide / 2, end), at(u + s * half, end)], closed=False)])
    elif isinstance(feature, Pocket) and isinstance(feature.contour, Circle):
        draft.axes.append(Axis(at(u, top - feature.depth), at(u, top)))


def _above_thread(hole: Hole, half: float) -> float:
    """How deep a thread begins: below a counterbore, and where a countersink is as narrow as it."""
    deep = hole.counterbore[1] if hole.counterbore else 0.0
    if hole.countersink:
        wide, angle = hole.countersink
        deep += max(0.0, wide / 2 - half) / math.tan(math.radians(angle / 2))
    return deep


def _extent(draft: Draft) -> Floats:
    corners = np.array([line.contour.bounds for line in draft.lines])
    return np.array([corners[:, 0].min(axis=0), corners[:, 1].max(axis=0)])


def _through(design: Design) -> Iterator[Cross]:
    """The centre lines of holes that go through, seen from below."""
    for each in design.features:
        if isinstance(each, Hole) and each.depth is None:
            x, y, _ = (design.flip[0] @ [each.x, each.y, 1.0]).tolist()
            yield Cross((x, y), each.wide / 2)


# ---- the blank, depths and heights ----


def _blank_seen(design: Design, side: Side, ledger: Ledger) -> None:
    """The outline of the blank where the part is smaller, and its sizes in the view from above."""
    (x0, y0, _), (x1, y1, _) = design.bounds.tolist()
    draft = side.draft
    if np.abs(_extent(draft) - design.bounds[:, :2]).max() > SAME:
        draft.draw(design.outline_of_blank.loops, Kind.PHANTOM)
    if isinstance(design.blank, Box):
        if not side.back:
            ledger.say(draft, Linear((x0, y0), (x1, y0), value(x1 - x0), "x", "below"), [_of_blank("length")])
            ledger.say(draft, Linear((x0, y0), (x0, y1), value(y1 - y0), "y", "left"), [_of_blank("width")])
        return
    centre, radius = ((x0 + x1) / 2, (y0 + y1) / 2), (x1 - x0) / 2
    draft.axes.append(Cross(centre, radius))
    if side.back:
        return
    ledger.say(draft, Diameter(centre, radius, value(2 * radius, DIAMETER)), [_of_blank("diameter")])
    if bore := design.blank.bore:
        ledger.say(draft, Diameter(centre, bore, value(2 * bore, DIAMETER)), [_of_blank("bore")])


def _of_blank(name: str) -> Claim:
    return Claim(False, BLANK, 0, name)


def _height(design: Design, front: Draft, ledger: Ledger) -> None:
    (x0, _, low), (x1, _, high) = design.bounds.tolist()
    ledger.say(front, Linear((x1, low), (x1, high), value(high - low), "y", "right"), [_of_blank("height")])


def _depths(design: Design, draft: Draft, levels: Sequence[DepthLine], ledger: Ledger) -> None:
    """One dimension for each step from a height to another; where depths begin a floor may tell, or a flight of them."""
    told: dict[object, DepthLine] = {}
    for each in levels:
        key = round(each.start, 6), round(each.end, 6), each.measure.limits, each.measure.fit
        if key in told:
            told[key].claims += each.claims
        else:
            told[key] = each
    for each in _said_by_others(list(told.values())):
        if abs(each.start - each.end) < SAME:  # the top of the blank, where all depths begin
            other = next(level for level in told.values() if abs(level.start - each.end) < SAME and level is not each)
            other.claims += each.claims
            continue
        said = valued(each.measure, "", abs(each.start - each.end))
        ledger.say(draft, Linear((each.u, each.start), (each.u, each.end), said, "y"), each.claims)



def _said_by_others(levels: list[DepthLine]) -> list[DepthLine]:
    """Levels without those that only say where depths begin, and end where others lead to one after the other: these have
    their claims."""
    floors = [each for each in levels if each.measure.name != "top"]
    kept = list[DepthLine]()
    for each in levels:
        heights, last = {round(each.start, 6)}, None
        for _ in floors if each.measure.name == "top" and each.measure.limits is None else ():
            for floor in floors:
                if round(floor.start, 6) in heights:
                    heights.add(round(floor.end, 6))
                    last = floor if abs(floor.end - each.end) < SAME else last
        if last is None or abs(each.start - each.end) < SAME:
            kept.append(each)
        else:
            last.claims += each.claims
    return kept
