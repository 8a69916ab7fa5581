"""How a touch probe goes about a workpiece, whatever the control (MNC 12, TNC 620 13.1 and 13.2): steps with answers.

x and y of the steps are those of the ball's centre, z that of its south pole. A touch begins where the ball's centre stands
`ball + gap` away from the nominal point, against the direction; it ends at the contact, and the probe goes back to where it
began. Between the touches it stays at the measuring height, or goes over the clearance height.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from mnclab.machining.steps import RAPID, Go, Orient, Step, Touch, Turn

Pair = tuple[float, float]
Way = Iterable["Pair | Turn"]  # places of the ball's centre, or turns, from one start to the next; none: straight
Steps = Generator[Step, Any, Any]
X, Y, MINUS_X, MINUS_Y = range(4)  # sides of a figure, counter-clockwise
NORMALS: tuple[Pair, ...] = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))
ROUND = (X, Y, MINUS_X, MINUS_Y)  # counter-clockwise
OPPOSITE = (X, MINUS_X, Y, MINUS_Y)  # pair by pair


@dataclass(frozen=True)
class Approach:
    """How the probe moves, mm and mm/min: its `ball`, the `gap` between ball and nominal point where a touch begins, the
    `level` of the ball's centre when it measures, the clearance `height` of its south pole, how far a touch may `reach`, the
    feeds of touching and of `positioning`, whether it goes `over` the clearance height between touches, and whether the
    spindle turns the probe into each direction (`track`)."""

    ball: float
    gap: float
    level: float
    height: float
    reach: float
    feed: float
    positioning: float = RAPID
    over: bool = False
    track: bool = False

    @property
    def away(self) -> float:
        """From the nominal point to the ball's centre where a touch begins."""
        return self.ball + self.gap

    @property
    def pole(self) -> float:
        """The south pole at the measuring height."""
        return self.level - self.ball

    def go(self, label: str, z: float | None = None, x: float | None = None, y: float | None = None) -> Go:
        """Position."""
        return Go(label, z, self.positioning, x, y)


class Aim(NamedTuple):
    """A touch in the plane: the nominal point, the direction (a unit vector), and how far before the point the ball's centre
    begins (None: `Approach.away`)."""

    x: float
    y: float
    direction: Pair
    back: float | None = None

    def start(self, a: Approach) -> Pair:
        back = a.away if self.back is None else self.back
        return self.x - back * self.direction[0], self.y - back * self.direction[1]


def in_plane(a: Approach, aims: Sequence[Aim], now: float, ways: Sequence[Way] = (), leave: bool = True) -> Steps:
    """Touch after touch at the measuring height, then up to the clearance height; returns the contacts.

    `now` is where the south pole stands before: below the clearance height it goes up first. `ways[k]` leads from the start of
    touch k to that of the next.
    """
    contacts = []
    for k, aim in enumerate(aims):
        x, y = aim.start(a)
        dx, dy = aim.direction
        if a.track:
            yield Orient("turn the probe", math.degrees(math.atan2(dy, dx)) % 360)
        if k == 0:
            yield from over_to(a, x, y, now)
        else:
            yield from between(a, x, y, ways[k - 1] if ways else ())
        contacts.append((yield Touch(f"touch {k + 1}", x + a.reach * dx, y + a.reach * dy, a.pole, a.feed, a.ball)))
        yield a.go("back", a.pole, x, y)
    if leave:
        yield a.go("to the clearance height", a.height)
    return contacts


def over_to(a: Approach, x: float, y: float, now: float, z: float | None = None) -> Iterator[Go]:
    """Over a first start and down to it (the measuring height, or a z): in the plane never below the clearance height."""
    if now < a.height:
        yield a.go("to the clearance height", a.height)
    yield a.go("over the starting point", x=x, y=y)
    yield a.go("to the starting point", a.pole if z is None else z)


def between(a: Approach, x: float, y: float, way: Way) -> Iterator[Step]:
    """From one start to the next."""
    if a.over:
        yield a.go("to the clearance height", a.height)
    for place in way:
        yield place if isinstance(place, Turn) else a.go("around", x=place[0], y=place[1])
    yield a.go("to the next starting point", x=x, y=y)
    if a.over:
        yield a.go("to the measuring height", a.pole)


def from_above(a: Approach, x: float, y: float, z: float, now: float, *, leave: str = "clearance") -> Steps:
    """One touch downwards on the nominal height z; returns the contact, whose south pole is `z - ball` below.

    Never in the plane below the start of the touch. At the end it goes to the clearance height ("clearance"), or stays where
    it began if that is higher ("higher").
    """
    begin = z + a.gap
    high = max(a.height, begin)
    if now < high:
        yield a.go("to the clearance height", high)
    yield a.go("over the starting point", x=x, y=y)
    yield a.go("to the starting point", begin)
    contact = yield Touch("touch from above", x, y, begin - a.reach, a.feed, a.ball)
    yield a.go("back", begin)
    if leave == "clearance" or a.height > begin:
        yield a.go("to the clearance height", a.height)
    return contact


# --- figures -------------------------------------------------------------------------------------------------------------


def side(centre: Pair, half: Pair, which: int, inside: bool, room: float | None = None) -> Aim:
    """A touch in the middle of a side of a figure of half sizes about a centre, from within or from outside.

    `room` is how far before the side it may begin at most: from within no farther than the centre.
    """
    nx, ny = NORMALS[which]
    size = half[which % 2]
    direction = (nx, ny) if inside else (-nx, -ny)
    return Aim(centre[0] + size * nx, centre[1] + size * ny, direction, room)


def ways_round(centre: Pair, reach: Pair, order: Sequence[int], inside: bool) -> list[list[Pair]]:
    """Along the axes from start to start: within through the centre, outside around the corners.

    `reach` are the distances of the starts from the centre along X and Y.
    """
    return [_way(centre, reach, one, other, inside) for one, other in zip(order, order[1:])]


def _way(centre: Pair, reach: Pair, one: int, other: int, inside: bool) -> list[Pair]:
    (x, y), (e, f) = centre, reach
    opposite = one % 2 == other % 2
    if inside:
        return [] if opposite else [(x, y)]
    if not opposite:
        a, b = NORMALS[one], NORMALS[other]
        return [(x + e * (a[0] + b[0]), y + f * (a[1] + b[1]))]
    if one % 2 == 0:  # from one end of X to the other, on the side of +Y
        return [(x + e * NORMALS[one][0], y + f), (x + e * NORMALS[other][0], y + f)]
    return [(x + e, y + f * NORMALS[one][1]), (x + e, y + f * NORMALS[other][1])]


def on_circle(centre: Pair, radius: float, first: float, step: float, count: int, inside: bool, back: float | None) -> list[Aim]:
    """Touches along the radius, at angles (degrees) from `first` on, `step` apart."""
    aims = []
    for k in range(count):
        angle = math.radians(first + k * step)
        ux, uy = math.cos(angle), math.sin(angle)
        direction = (ux, uy) if inside else (-ux, -uy)
        aims.append(Aim(centre[0] + radius * ux, centre[1] + radius * uy, direction, back))
    return aims
