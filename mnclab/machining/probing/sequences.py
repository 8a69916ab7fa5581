"""How a touch probe goes about a workpiece, whatever the control (MNC 12, TNC 620 13.1 and 13.2): steps with answers.

x and y of the steps are those of the ball's centre, z that of its south pole. A touch begins where the ball's centre stands
`ball + gap` away from the nominal point, against the direction; it ends at the contact, and the probe goes back to where it
began. Between the touches it stays at the measuring height, or goes over the clearance height.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from mnclab.machining.steps import RAPID, Go, Orient, Say, Step, Touch, Turn, Write

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
    stands: float | None = None

    @property
    def away(self) -> float:
        """From the nominal point to the ball's centre where a touch begins."""
        return self.ball + self.gap

    @property
    def pole(self) -> float:
        """The south pole at the measuring height; where the probe `stands` there already, that."""
        return self.level - self.ball if self.stands is None else self.stands

    def as_far_as(self, wall: float) -> Approach:
        """How it touches where the nominal wall is known to be `wall` away from the ball's centre, and no clearance before it.

        DIST and MAX_DIST are the longest way to a touch point, from where a touch begins in front of it (TNC 620 13.2, MNC
        12.21). From a start that is farther away the nominal wall must be in reach all the same, or the examples of TNC 620
        16.9 and 16.10 and of MNC 12.18 would not measure: a touch may then go as far as the wall, and the clearance more.
        """
        return replace(self, reach=max(self.reach, wall + self.gap if wall else 0.0))

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
    if a.height < a.pole:
        yield Say("has a clearance height below the measuring height", "between figures the probe goes down to it")
    for k, aim in enumerate(aims):
        x, y = aim.start(a)
        dx, dy = aim.direction
        if a.track:
            yield Orient("turn the probe", math.degrees(math.atan2(dy, dx)) % 360)
        if k == 0:
            yield from over_to(a, x, y, now)
        else:
            yield from between(a, x, y, ways[k - 1] if ways else (), aims[k - 1].start(a))
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


def between(a: Approach, x: float, y: float, way: Way, at: Pair | None = None) -> Iterator[Step]:
    """From one start, `at` which the probe stands, to the next."""
    if a.over:
        yield a.go("to the clearance height", a.height)
    for place in way:
        if isinstance(place, Turn):
            yield place
            at = x, y  # where an arc ends
        elif place != at:
            yield a.go("around", x=place[0], y=place[1])
            at = place
    if (x, y) != at:
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


def in_one_axis(a: Approach, axis: int, sense: float, points: Sequence[tuple[float, float, float]], now: float) -> Steps:
    """Touches along an axis (0, 1, or 2: that of the tool) at nominal points, in the plane at `Approach.level`; the contacts."""
    if axis < 2:
        direction = (sense, 0.0) if axis == 0 else (0.0, sense)
        return (yield from in_plane(a, [Aim(x, y, direction) for x, y, _ in points], now))
    contacts = []
    for k, (x, y, z) in enumerate(points):
        begin = z - sense * a.away - a.ball
        if k == 0:
            yield from over_to(a, x, y, now, begin)
        else:
            if a.over:
                yield a.go("to the clearance height", a.height)
            yield a.go("to the next starting point", x=x, y=y)
            yield a.go("to the starting point", begin)
        contacts.append((yield Touch(f"touch {k + 1}", x, y, begin + sense * a.reach, a.feed, a.ball)))
        yield a.go("back", begin)
    yield a.go("to the clearance height", a.height)
    return contacts


# --- what contacts tell --------------------------------------------------------------------------------------------------


def numbers(contacts: Iterable[Any]) -> tuple[int, ...]:
    """Which touches these are, for the measuring record."""
    return tuple(contact.number for contact in contacts)


def results(**values: float) -> Iterable[Step]:
    """Variables of the program: `results(Q312=x)`."""
    return [Write("variable", float(value), name) for name, value in values.items()]


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


def sides(a: Approach, centre: Pair, half: Pair, order: Sequence[int], inside: bool, now: float, *, each: bool = True) -> Steps:
    """Touches of a slot, ridge, pocket or stud in the middle of its sides, in an order such as `ROUND`; returns the contacts.

    Where a touch from within has no room before it, it begins in the centre, and the probe stays at the measuring height: on the
    axis that is too short (`each`, TNC 620 15.4 and 16.6), or on all (MNC 12, "probe motion").
    """
    short = [inside and (size < a.away if each else size <= a.away) for size in (half[which % 2] for which in order)]
    if any(short):
        short = short if each else [True] * len(short)
        a = replace(a, over=False).as_far_as(max(half[which % 2] for which, near in zip(order, short) if near))
    aims = [side(centre, (0.0, 0.0) if near else half, k, inside, 0.0 if near else None) for k, near in zip(order, short)]
    ways = () if a.over else ways_round(centre, (half[0] + a.away, half[1] + a.away), order, inside)
    return (yield from in_plane(a, aims, now, ways))


def around(
    a: Approach, centre: Pair, radius: float, first: float, step: float, count: int, inside: bool, now: float, arc: bool = True,
    leave: bool = True,
) -> Steps:  # fmt: skip
    """Touches of a hole or a round stud, from an angle on in steps (degrees); returns the contacts (TNC 620 15.6, 15.7, 16.4).

    From start to start on an arc, over the clearance height also straight (`arc` False). Where a touch from within has no room it
    begins in the centre, and the probe stays at the measuring height.
    """
    begin = radius + (-a.away if inside else a.away)
    if begin < 0:
        a, begin = replace(a, over=False).as_far_as(radius), 0.0
    aims = on_circle(centre, radius, first, step, count, inside, None if begin else radius)
    turn = Turn("around", math.radians(step), feed=a.positioning, centre=centre)
    ways = [[turn]] * (count - 1) if begin and (arc or not a.over) else ()
    return (yield from in_plane(a, aims, now, ways, leave))


def from_centre(a: Approach, centre: Pair, now: float) -> Steps:
    """Four touches of a hole that nobody gave a size, from its centre, `ROUND`; returns the contacts."""
    aims = [Aim(*centre, NORMALS[which], 0.0) for which in ROUND]
    return (yield from in_plane(replace(a, over=False), aims, now))


def corner(a: Approach, first: Sequence[Aim], second: Sequence[Aim], now: float) -> Steps:
    """Touches along one side of a corner, then along the other; returns the contacts.

    From side to side it goes along X first, then along Y.
    """
    aims = [*first, *second]
    ways: list[Way] = [()] * (len(aims) - 1)
    if not a.over:
        ways[len(first) - 1] = [(second[0].start(a)[0], first[-1].start(a)[1])]
    return (yield from in_plane(a, aims, now, ways))


def on_sphere(a: Approach, centre: tuple[float, float, float], radius: float, first: float, count: int) -> Steps:
    """Touches of a sphere of a radius: the pole, then points of the equator from an angle on (degrees); returns the contacts.

    The probe begins over the pole, goes round on an arc, and ends over the pole (TNC 620 18.4).
    """
    (x, y, z), out, end = centre, radius + a.away, radius + a.away - a.reach
    pole, turn = z - a.ball, math.tau / count
    contacts = [(yield Touch("touch the pole", x, y, pole + end, a.feed, a.ball))]
    yield a.go("back", pole + out)
    for k in range(count):
        angle = math.radians(first) + k * turn
        cos, sin = math.cos(angle), math.sin(angle)
        if k:
            yield Turn("round the sphere", turn, feed=a.positioning, centre=(x, y))
        else:
            yield a.go("beside the sphere", x=x + out * cos, y=y + out * sin)
            yield a.go("down to the equator", pole)
        if a.track:
            yield Orient("turn the probe", (math.degrees(angle) + 180) % 360)
        contacts.append((yield Touch("touch the equator", x + end * cos, y + end * sin, pole, a.feed, a.ball)))
        yield a.go("back", pole, x + out * cos, y + out * sin)
    yield a.go("up", pole + out)
    yield a.go("over the pole", x=x, y=y)
    return contacts
