"""Ways down to a level: straight, on a helix, to and fro on a ramp. Lengths in mm, plunge angles in degrees (as `Tool`).

A *descent* is a contour in the plane with the height of each of its points; between two points the tool sinks evenly.

    lead of a helix = 2·π·r·tan(angle)          drop of a stroke s ≤ s·tan(angle)

At 90 degrees every descent is straight down. What a slope leaves standing is cleared by a last move at the level: a
full circle, or one more stroke; a descent along a pass leaves that to the pass.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import Contour, joined
from mnclab.geometry.curves import Floats
from mnclab.machining.depths import MOST, TooMany
from mnclab.machining.milling.clearing import HOPPED, Clearing, Piece, begin
from mnclab.machining.steps import RAPID, Along, Go, Step, Turn, traced
from mnclab.path.toolpath import Toolpath
from mnclab.text.given import check_number, refusing_class

DRIFT = 1e-9
HOP = 0.3  # mm above the level, of a way through what is cleared
CHORDS = 16  # of a quarter circle in a vertical plane: a hundredth of a millimetre off at a radius of 8 mm


class Descent(NamedTuple):
    """An open contour and the heights `(n,)` of its n points; `label` names it: "entry helix"."""

    contour: Contour
    heights: Floats
    label: str

    @property
    def clears(self) -> bool:
        """Whether it ends with a level move that leaves nothing of its slope."""
        return len(self.heights) < 3 or bool(self.heights[-2] == self.heights[-1])


@refusing_class
@dataclass(frozen=True)
class Entry:
    """How to go down: `kind` is "vertical", "helix" or "ramp"; `angle` the steepest plunge in degrees.

    `size`: the radius of the helix (None: of the tool), or the shortest stroke of the ramp (None: two tool diameters).

    >>> mnc.strategies.Entry("helix", 3)
    Entry(kind='helix', angle=3, size=None)
    """

    kind: str = "vertical"
    angle: float = 90.0
    size: float | None = None

    def __post_init__(self) -> None:
        if self.kind not in ("vertical", "helix", "ramp"):
            raise ValueError(f'an entry is "vertical", "helix" or "ramp", got {self.kind!r}')
        check_number(self.angle, "the plunge angle of an entry (degrees)")
        if self.size is not None:
            check_number(self.size, "the size of an entry (mm)", above=0)
        if self.kind != "vertical" and not 0 < self.angle <= 90:
            raise ValueError(f"the plunge angle must lie above 0 and not above 90 degrees, got {self.angle:g}")


VERTICAL = Entry()


def vertical(place: ArrayLike, top: float, bottom: float) -> Descent:
    """Straight down at a place."""
    spot = np.asarray(place, dtype=float)
    return Descent(Contour([spot, spot], closed=False), np.array([top, bottom], dtype=float), "entry")


def helix(
    centre: ArrayLike, radius: float, top: float, bottom: float, angle: float, *, start: float = 0.0,
    clockwise: bool = False,
) -> Descent:  # fmt: skip
    """A helix about a centre from the direction `start` (rad) on, and a full circle at the bottom."""
    if not radius > 0:
        raise ValueError(f"there is no room for a helix: its radius is {radius:g}")
    if not 0 < angle <= 90:
        raise ValueError(f"the plunge angle must lie above 0 and not above 90 degrees, got {angle:g}")
    drop, middle, sense = abs(top - bottom), np.asarray(centre, dtype=float), -1.0 if clockwise else 1.0
    if angle == 90:
        return vertical(middle + radius * np.array([np.cos(start), np.sin(start)]), top, bottom)
    total = drop / (radius * math.tan(math.radians(angle)))
    if total > MOST * 2 * math.pi:
        raise TooMany(f"a helix of radius {radius:g} at {angle:g} degrees has more than {MOST} turns in {drop:g}")
    count = max(1, math.ceil(total / math.pi - DRIFT)) if drop else 0
    turned = np.append(total * np.arange(count + 1) / max(count, 1), total + math.pi * np.array([1, 2]))
    way = start + sense * turned
    points = middle + radius * np.stack([np.cos(way), np.sin(way)], axis=1)
    bulge = np.tan(sense * np.append(np.diff(turned), 0.0) / 4)
    heights = np.append(np.linspace(top, bottom, count + 1), [bottom, bottom])
    return Descent(Contour(points, bulge, closed=False), heights, "entry helix")


def strokes(a: ArrayLike, b: ArrayLike, top: float, bottom: float, angle: float) -> Descent:
    """To and fro between a and b, from a on, in equal drops, and a last stroke at the bottom."""
    first, last = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    stroke = float(np.hypot(*(last - first)))
    if not stroke > 0 or not 0 < angle <= 90:
        raise ValueError(f"a ramp needs a stroke and an angle up to 90 degrees, got {stroke:g} and {angle:g}")
    if angle == 90:
        return vertical(first, top, bottom)
    count = stroke_count(stroke, top, bottom, angle)
    points = np.where(np.arange(count + 2)[:, None] % 2, last, first)
    heights = np.append(np.linspace(top, bottom, count + 1), bottom)
    return Descent(Contour(points, closed=False), heights, "entry ramp")


def swing(line: Contour, top: float, bottom: float, angle: float) -> Descent:
    """To and fro along an open contour, from its start, in equal drops; a pass along it takes what the last stroke leaves."""
    length = line.length
    if not length > DRIFT or not 0 < angle <= 90:
        raise ValueError(f"a ramp needs a stroke and an angle up to 90 degrees, got {length:g} and {angle:g}")
    if angle == 90 or top == bottom:
        return vertical(line.points[0], top, bottom)
    return _sloping(_to_and_fro(line, stroke_count(length, top, bottom, angle)), top, bottom, "entry ramp")


def stroke_count(length: float, top: float, bottom: float, angle: float) -> int:
    """How many equal drops a ramp of a length needs; TooMany where nobody would wait for them."""
    drop = abs(top - bottom)
    drops = drop / (length * math.tan(math.radians(angle)))
    if drops > MOST:
        raise TooMany(f"a ramp {length:g} long at {angle:g} degrees has more than {MOST} strokes in {drop:g}")
    return math.ceil(drops - DRIFT)


def onto_floor(place: ArrayLike, direction: float, top: float, bottom: float) -> Descent:
    """Down on a quarter circle that touches the floor at a place, in the vertical plane of a direction (rad).

    Its radius is the height to go down; it is a chain of chords, as the plane is none of those in which arcs lie.
    """
    share, radius = np.linspace(0, np.pi / 2, CHORDS + 1), abs(top - bottom)
    ahead = np.array([math.cos(direction), math.sin(direction)])
    points = np.asarray(place, dtype=float) - radius * np.cos(share)[:, None] * ahead
    return Descent(Contour(points, closed=False), top + (bottom - top) * np.sin(share), "entry arc")


def pendulum(
    centre: ArrayLike, direction: float, top: float, bottom: float, angle: float, *, least: float, room: float
) -> Descent:
    """To and fro along a direction (rad) with the middle of the stroke at the centre, begun and ended there.

    The stroke is as long as one drop needs, at least `least` and at most `room`; a ValueError where that is too short.
    """
    if room < least - DRIFT:
        raise ValueError(f"there is no room for a ramp: {room:g} is less than {least:g}")
    middle = np.asarray(centre, dtype=float)
    if angle == 90:
        return vertical(middle, top, bottom)
    need = abs(top - bottom) / math.tan(math.radians(angle))
    half = min(max(least, need), room) / 2 * np.array([math.cos(direction), math.sin(direction)])
    swing = strokes(middle - half, middle + half, top, bottom, angle)
    points = np.vstack([middle, swing.contour.points, middle])
    return Descent(Contour(points, closed=False), np.concatenate([[top], swing.heights, [bottom]]), "entry ramp")


def descend(down: Descent, plunge: float | None, feed: float | None) -> Iterator[Step]:
    """A descent from its start, slopes at the plunge feed; arcs that go on about one centre are one turn, a helix of many."""
    (_, *points), (_, *heights) = down.contour.points.tolist(), down.heights.tolist()
    turn, level, before = None, False, float(down.heights[0])
    columns = down.contour.sweeps.tolist(), down.contour.centres.tolist(), points, heights
    for sweep, centre, (x, y), z in zip(*columns, strict=True):
        other = turn and (sweep * turn.angle <= 0 or level != (z == before) or math.dist(turn.centre, centre) > 1e-6)
        if turn and other:
            yield turn
            turn = None
        level, before = z == before, z
        rate = feed if level else plunge
        if sweep:
            turn = Turn(down.label, sweep + (turn.angle if turn else 0.0), z, rate, turn.centre if turn else (*centre,))
        else:
            yield Go(down.label, z, rate, x, y)
    if turn:
        yield turn


def along(contour: Contour, top: float, bottom: float, angle: float) -> Descent:
    """Down along a pass: round and round, or to and fro on an open one; ends where the pass begins, which clears the slope."""
    slope = math.tan(math.radians(angle))
    rounds = max(1, math.ceil(abs(top - bottom) / (contour.length * slope) - DRIFT)) if top != bottom else 0
    if contour.closed:
        points = np.vstack([np.tile(contour.points, (rounds, 1)), contour.points[:1]])
        way = Contour(points, np.append(np.tile(contour.bulge, rounds), 0.0), closed=False)
    else:
        way = _to_and_fro(contour, rounds + rounds % 2)  # an even number of strokes ends where the pass begins
    return _sloping(way, top, bottom, "entry along the pass")


def descent(
    piece: Piece, entry: Entry, radius: float, top: float, bottom: float, climb: bool = True, number: int = 0
) -> Descent:
    """The way down to a pass of a piece (the first, or that of a `number`) as wished for, ending near its start.

    Straight where the pass begins on an earlier one or beside the material; along the pass where a helix or a ramp has no room.
    """
    place = begin(piece.passes[number]) if number else piece.entry
    straight = entry.kind == "vertical" or entry.angle == 90 or top <= bottom
    if straight or (piece.passes and piece.begins_cleared(number)):
        return vertical(place, top, bottom)
    if entry.kind == "helix":
        wish = radius if entry.size is None else entry.size
        room = float(piece.centres.distance([place])[0]) if piece.centres.contains([place])[0] else 0.0
        if room >= wish / 2 and room > 0.05 * radius:
            return helix(place, min(wish, room), top, bottom, entry.angle, clockwise=not climb)
    else:
        least = 4 * radius if entry.size is None else entry.size
        for way in np.pi / 4 * np.array([0, 2, 1, 3]):
            reach = least / 2 * np.array([np.cos(way), np.sin(way)])
            if piece.centres.holds(place - reach, place + reach):
                return pendulum(place, float(way), top, bottom, entry.angle, least=least, room=least)
    if not piece.passes or piece.passes[number].length <= 0:
        return vertical(place, top, bottom)
    return along(piece.passes[number], top, bottom, entry.angle)


def _to_and_fro(line: Contour, count: int) -> Contour:
    """So many strokes along an open contour, from its start."""
    return joined(line if k % 2 == 0 else line.reversed() for k in range(count))


def _sloping(way: Contour, top: float, bottom: float, label: str) -> Descent:
    """Evenly down along a way."""
    upto = way.upto
    return Descent(way, top + (bottom - top) * upto / upto[-1], label)


# Passes of a strategy step by step: down, along, up again, level by level. Lengths in mm, feeds in mm/min.
# The plain way, for comparing strategies and for a path without a program; a cycle has an order of its own. Labels name every
# row: "entry helix", "ring 3 of 7", "link", "lift".

def toolpath(
    clearing: Clearing | Sequence[Clearing], levels: Sequence[float] = (-1.0,), *, surface: float = 0.0, clearance: float = 2.0,
    entry: Entry = VERTICAL, feed: float = 500.0, plunge_feed: float = 150.0, climb: bool = True,
) -> Toolpath:  # fmt: skip
    """Every pass of a clearing on every level, or of one for each, from `surface` down by `entry`; lifts go to `clearance` above
    the surface, rapid."""
    each = [clearing] * len(levels) if isinstance(clearing, Clearing) else clearing
    todo = [
        (top, level, piece) for top, level, one in zip((surface, *levels), levels, each)
        for piece in one.pieces if piece.passes or piece.place is not None
    ]  # fmt: skip
    if not todo:
        raise ValueError("there is nothing to clear")
    above, radius = surface + clearance, each[0].radius

    def steps() -> Iterator[Step]:
        for top, level, piece in todo:
            for k in range(max(1, len(piece.passes))):
                if not k or not piece.linked[k - 1]:
                    down = descent(piece, entry, radius, top, level, climb, k)
                    yield Go("lift", above)
                    yield Go("to the entry", None, RAPID, *begin(down.contour).tolist())
                    yield Go(down.label, top, plunge_feed)
                    yield Along(down.label, down.contour, plunge_feed, down.heights.tolist())
                elif piece.linked[k - 1] == HOPPED:
                    yield Go("small lift", level + HOP, RAPID)
                    yield Go("link", None, RAPID, *begin(piece.passes[k]).tolist())
                    yield Go("link", level, RAPID)
                if piece.passes:
                    yield Go("link", level, feed, *begin(piece.passes[k]).tolist())
                    yield Along(piece.labels[k], piece.passes[k], feed)
            yield Go("lift", above)

    return traced(steps(), (*todo[0][2].entry.tolist(), above), radius)
