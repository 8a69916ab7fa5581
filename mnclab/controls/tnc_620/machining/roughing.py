"""Areas cleared level by level, each piece from its infeed point outwards, on ways that never leave the area."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import chain, pairwise
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import Contour, joined
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region, meeting
from mnclab.machining.milling.clearing import Clearing, Piece, begin, end, numbered
from mnclab.machining.milling.engagement import stretches
from mnclab.machining.milling.entries import Descent, along, descend, helix, vertical
from mnclab.machining.milling.terraces import ClearingLevel
from mnclab.machining.steps import Along, Go, Step

# The way of a tool from one place to another that never leaves an area: straight, and round what stands in between.
#             ┌───┐
#     a ──────┤   ├────── b         a stretch of the straight way that leaves the area is replaced by the way
#             └─►─┘                 along its boundary, on the shorter side
# Arcs stay arcs. Lengths in mm.

TOUCH = 1e-6  # mm, within which a place lies on a boundary


def route(area: Region, start: ArrayLike, end: ArrayLike) -> Contour | None:
    """An open contour from start to end, both `(2,)`, in a connected area; None where they are one, or not both in it."""
    a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    if np.hypot(*(b - a)) <= TOUCH:
        return None
    if area.holds(a, b):
        return Contour([a, b], closed=False)
    met = [_meetings(loop, a, b) for loop in area.loops]
    shares = np.unique(np.concatenate([[0.0, 1.0], *met]))
    pieces: list[Contour] = []
    here = 0.0
    while here < 1:
        beyond = float(shares[shares > here][0])
        if _within(area, a + (here + beyond) / 2 * (b - a)):
            pieces.append(Contour([a + here * (b - a), a + beyond * (b - a)], closed=False))
            here = beyond
            continue
        loops = [k for k, each in enumerate(met) if (each == here).any() and each.max() > here]
        if not loops:
            return None
        k = max(loops, key=lambda k: float(met[k].max()))
        there = float(met[k].max())
        pieces.append(_along(area.loops[k], a + here * (b - a), a + there * (b - a)))
        here = there
    return joined(pieces)


def _meetings(loop: Contour, a: Floats, b: Floats) -> Floats:
    """Fractions of the way from a to b at which it meets a loop; its ends, where they lie on it."""
    found = np.append(meeting(loop, a, b - a), [0.0, 1.0])
    found = found[(found >= 0) & (found <= 1)]
    return np.unique(found[loop.distance(a + found[:, None] * (b - a)) <= TOUCH])


def _within(area: Region, spot: Floats) -> bool:
    return bool(area.contains([spot])[0] or area.distance([spot])[0] <= TOUCH)


def _along(loop: Contour, start: Floats, end: Floats) -> Contour:
    """The shorter way along a loop between two places on it."""
    there, back = loop.nearest(start), loop.nearest(end)
    forward = (back - there) % loop.length
    if 2 * forward <= loop.length:
        return loop.between(there, there + forward)
    return loop.between(back, back + loop.length - forward).reversed()


# Areas cleared level by level, each piece from its infeed point outwards without lifting the tool. Lengths in mm, mm/min.
# Between two passes that do not lead on to one another the tool stays down as well: it goes round what stands, in the area
# where its centre may go. So a piece has one way down on each level: straight, on a helix, or to and fro along its first pass.

NARROWEST = 0.1  # of the tool radius: no helix is smaller
SHORT = 1e-6  # mm
WayDown: TypeAlias = Callable[[Piece, float, float], Descent]


class Heights(NamedTuple):
    """Coordinates along the tool axis: of ways over everything, of the surface, of the set-up clearance above it."""

    height: float
    surface: float
    above: float
    down: int

    @property
    def clearance(self) -> float:
        return self.above - self.surface


class Cut(NamedTuple):
    """Passes, and what stands where they run; None: material everywhere."""

    clearing: Clearing
    material: Region | None = None


class Feeds(NamedTuple):
    """Down, along the passes, and where the tool cuts a full slot."""

    plunge: float
    level: float
    slot: float


def straight_down(piece: Piece, top: float, bottom: float) -> Descent:
    """At the infeed point."""
    return vertical(piece.entry, top, bottom)


def sloping_down(
    piece: Piece, top: float, bottom: float, *, radius: float, angle: float, stroke: float, climb: bool, helical: bool = True
) -> Descent:  # fmt: skip
    """On a helix about the infeed point, as wide as the tool or as the room there; in a slot to and fro along its first pass.

    `angle` is the steepest in degrees, `stroke` the longest way to or fro; a ValueError where one is needed and it is 0.
    Straight beside the material; never on a helix if not `helical`.
    """
    if top == bottom or piece.from_side:
        return straight_down(piece, top, bottom)
    room = float(piece.centres.distance([piece.entry])[0]) if helical else 0.0
    if room >= NARROWEST * radius:
        return helix(piece.entry, min(radius, room), top, bottom, angle, clockwise=not climb)
    if not stroke > 0:
        raise ValueError("where a helix has no room the tool goes to and fro, for which it needs the length of its edges")
    first = piece.passes[0]
    return along(first.between(0.0, min(stroke, first.length)), top, bottom, angle)


class WaysBetween:
    """Ways of the tool at a level from one place of a piece to another; they keep off the walls as far as they can.

    The farthest from them that joins both places is found among the distances of the rings.
    """

    def __init__(self, piece: Piece) -> None:
        begins = np.array([begin(ring) for ring in piece.passes])
        self.piece = piece
        self.depths = np.unique(np.round(piece.centres.distance(begins), 6))[::-1]
        self.areas: dict[float, Region] = {0.0: piece.centres}

    def between(self, a: Floats, b: Floats, straight: bool = False) -> Contour | None:
        """None where both are one place."""
        if np.hypot(*(b - a)) <= SHORT:
            return None
        if straight or self.piece.centres.holds(a, b):
            return Contour([a, b], closed=False)
        most = float(self.piece.centres.distance([a, b]).min()) + SHORT
        for depth in (*self.depths[(self.depths <= most) & (self.depths > SHORT)].tolist(), 0.0):
            if depth not in self.areas:
                self.areas[depth] = self.piece.centres.inset(depth)
            if (found := route(self.areas[depth], a, b)) is not None:
                return found
        raise ValueError(f"there is no way from {a} to {b} in the contour")

    @property
    def passes(self) -> Iterator[Contour]:
        """The passes of the piece and the ways between them."""
        yield self.piece.passes[0]
        for (one, other), straight in zip(pairwise(self.piece.passes), self.piece.linked, strict=True):
            if (way := self.between(end(one), begin(other), bool(straight))) is not None:
                yield way
            yield other


def rough_out(
    cuts: Sequence[Cut], levels: Sequence[ClearingLevel], heights: Heights, feeds: Feeds, way_down: WayDown
) -> Iterator[Step]:
    """Each level with the passes of its terrace, piece by piece.

    At rapid the tool goes down to the set-up clearance, or in a place where it has been down before to as much above that.
    """
    ways = [[WaysBetween(piece) for piece in cut.clearing.pieces] for cut in cuts]
    planned = [[list(_with_feeds(each, cut, feeds)) for each in some] for cut, some in zip(cuts, ways, strict=True)]
    before: ClearingLevel | None = None
    height = heights.height
    for label, level in zip(numbered("level", len(levels)), levels, strict=True):
        top = heights.surface if before is None else before.height
        for here, passes in zip(ways[level.terrace], planned[level.terrace], strict=True):
            way = way_down(here.piece, top, level.height)
            x, y = begin(way.contour).tolist()
            yield Go(label, height)
            yield Go(label, x=x, y=y)
            yield Go(label, heights.above)
            if before is not None and before.terrace == level.terrace and heights.down < 0:
                yield Go(label, min(heights.above, top + heights.clearance))
            yield from _down(label, way, feeds)
            first = here.between(end(way.contour), begin(here.piece.passes[0]))
            if first is not None:
                yield Along(label, first, feeds.slot)
            for contour, feed in passes:
                yield Along(label, contour, feed)
            height = heights.above
        before = level


def _down(label: str, way: Descent, feeds: Feeds) -> Iterator[Step]:
    top, bottom = float(way.heights[0]), float(way.heights[-1])
    if len(way.heights) == 2:
        yield Go(label, bottom, feeds.plunge)
    else:
        yield Go(label, top, feeds.plunge)
        yield from descend(way._replace(label=f"{label}, {way.label}"), feeds.plunge, feeds.slot)


def _with_feeds(ways: WaysBetween, cut: Cut, feeds: Feeds) -> Iterator[tuple[Contour, float]]:
    """The passes of a piece and the ways between them, each with its feed, in stretches where that changes."""
    moves = list(ways.passes)
    if feeds.slot == feeds.level:
        yield from ((move, feeds.level) for move in moves)
        return
    _, *found = stretches([Contour([ways.piece.entry] * 2, closed=False), *moves], cut.clearing.radius, stock=cut.material)
    for stretch in chain.from_iterable(found):
        yield stretch.contour, feeds.slot if stretch.full else feeds.level
