"""The profile of a turned part as its drawing has it: the outline, its broken corners, and what is dimensioned of it.

Points are (z, r), mm: r a radius. An open profile is the outside from one end to the other, closed to the axis at its ends;
a closed one is the whole half section.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from mnclab.design.model.measures import Measure
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, cross, dot, length_of, rounded, unit_of
from mnclab.geometry.regions import Region
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, faults_as_alarms, shown, whole

WHAT = "the profile"
SAME = 1e-9  # mm


class Dimension(NamedTuple):
    """What a drawing dimensions, and between which points (z, r) of the section; `centre` that of a radius."""

    measure: Measure
    start: tuple[float, float]
    end: tuple[float, float]
    centre: tuple[float, float] | None = None


@dataclass(frozen=True, eq=False)
class Profile:
    """`contour` as it was given; `roundings` (radius) and `chamfers` (width, or width along the axis and angle) by corner."""

    contour: Contour
    roundings: Mapping[int, float] = field(default_factory=dict)
    chamfers: Mapping[int, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        count = len(self.contour.points)
        object.__setattr__(self, "roundings", check_corners(self.roundings, "roundings", count))
        object.__setattr__(self, "chamfers", check_corners(self.chamfers, "chamfers", count, pairs=True))
        for k in (*self.roundings, *self.chamfers):
            if abs(self.contour.points[k, 1]) <= SAME:
                raise Alarm(f"corner {k} of {WHAT} lies on the axis, where nothing is broken", hint="a ball end is an arc")
        self.section  # noqa: B018  it must exist

    @cached_property
    def _loop(self) -> tuple[Contour, int]:
        """The profile closed to the axis, counter-clockwise, and the number that its first point has as given."""
        line, points = self.contour, self.contour.points
        for below in np.flatnonzero(points[:, 1] < -SAME)[:1].tolist():
            told = f"point {below} of {WHAT} must have a radius of at least 0, got {points[below, 1]:g}"
            raise Alarm(told, hint="points are (z, r)")
        low = float(line.bounds[0, 1])
        if low < -SAME:
            raise Alarm(f"an arc of {WHAT} must stay at radii of at least 0, it goes to {low:.6g}")
        gaps = np.hypot(*(line.ends - line.starts).T)
        if (gaps < SAME).any():
            k, place = int(gaps.argmin()), shown(tuple(points[int(gaps.argmin())].tolist()))
            raise Alarm(f"points {k} and {(k + 1) % len(points)} of {WHAT} are the same place, {place}")
        first = 0
        if not line.closed:
            front, back = [(points[0, 0], 0.0)], [(points[-1, 0], 0.0)]
            front, back = front * bool(points[0, 1] > SAME), back * bool(points[-1, 1] > SAME)
            bulge = [*([0.0] * len(front)), *line.bulge, *([0.0] * len(back))]
            line, first = Contour(np.array([*front, *points, *back]), bulge), -len(front)
        return line, first

    @cached_property
    def pieces(self) -> tuple[ProfilePiece, ...]:
        """The lines and arcs of the section, counter-clockwise from the front end on; `corner` counts as given."""
        return self._pieces(self.roundings, self.chamfers)

    def _pieces(self, roundings: Mapping[int, float], chamfers: Mapping[int, Any]) -> tuple[ProfilePiece, ...]:
        loop, first = self._loop
        found = pieces(loop, roundings, chamfers, WHAT, first)
        if joined(found).area < 0:
            found = [ProfilePiece(each.end, each.start, -each.bulge, each.corner) for each in reversed(found)]
        begin = max(range(len(found)), key=lambda k: (found[k].start[0], -found[k].start[1]))
        return tuple(found[begin:] + found[:begin])

    @cached_property
    def section(self) -> Region:
        """The half section without any feature."""
        contour = joined(list(self.pieces))
        try:
            with faults_as_alarms():
                return Region.of(contour)
        except Alarm as fault:
            hint = "an open profile is closed to the axis at both ends" if not self.contour.closed else ""
            raise Alarm(fault.message.replace("the contour", WHAT), hint=hint) from None

    @property
    def ends(self) -> tuple[float, float]:
        """The lowest and the highest z."""
        (low, _), (high, _) = self.section.loops[0].bounds.tolist()
        return low, high

    def turned_over(self) -> Profile:
        """End for end, in the same stretch of z; corners keep their numbers."""
        middle = sum(self.ends)
        mirrored = Contour(self.contour.points * (-1, 1) + (middle, 0), -self.contour.bulge, self.contour.closed)
        return Profile(mirrored, self.roundings, self.chamfers)

    # ---- what is dimensioned ----

    def dimensions(self) -> Iterator[Dimension]:
        """Length, diameters, lengths from the front end to every corner, radii, chamfers, angles of tapers; counted from 1."""
        low, high = self.ends
        yield Dimension(Measure("length", high - low), (high, 0.0), (low, 0.0))
        sharp = self._pieces({}, {})  # as given, before its corners are broken
        for name, found in (("diameter", _diameters(sharp)), ("length", _lengths(sharp, low, high)),
                            ("angle", _angles(sharp)), ("radius", self._radii()), ("chamfer", self._chamfers())):  # fmt: skip
            for k, each in enumerate(found, 1):
                yield each._replace(measure=each.measure._replace(name=f"{name} {k}"))

    def _radii(self) -> Iterator[Dimension]:
        for each in self.pieces:
            if each.bulge:
                contour = each.contour
                z, r = contour.centres[0].tolist()
                radius = float(contour.radii[0]) if each.corner is None else self.roundings[each.corner]
                yield Dimension(Measure("", radius, "radius"), each.start, each.end, (z, r))

    def _chamfers(self) -> Iterator[Dimension]:
        for each in self.pieces:
            size = None if each.corner is None else self.chamfers.get(each.corner)
            if size is not None:
                lean = math.degrees(math.atan2(abs(each.end[1] - each.start[1]), abs(each.end[0] - each.start[0])))
                width = size if isinstance(size, float) else size[0]
                yield Dimension(Measure("", width, "chamfer", text=f"{width:g}×{lean:.6g}°"), each.start, each.end)


def _level(piece: ProfilePiece) -> bool:
    """A cylinder."""
    return not piece.bulge and abs(piece.start[1] - piece.end[1]) <= SAME


def _diameters(sharp: tuple[ProfilePiece, ...]) -> Iterator[Dimension]:
    """Those of cylinders, and of corners where no cylinder begins or ends."""
    for k, each in enumerate(sharp):
        radius = each.start[1]
        if radius > SAME and not _level(each) and not _level(sharp[k - 1]):
            yield Dimension(Measure("", 2 * radius, "diameter"), each.start, each.start)
        if _level(each) and radius > SAME:
            yield Dimension(Measure("", 2 * radius, "diameter"), each.start, each.end)


def _lengths(sharp: tuple[ProfilePiece, ...], low: float, high: float) -> Iterator[Dimension]:
    """From the front end to every other z of a corner."""
    places = {round(z, 9): (z, r) for each in sharp for z, r in (each.start, each.end)}
    for _, (z, r) in sorted(places.items(), reverse=True):
        if low + SAME < z < high - SAME:
            yield Dimension(Measure("", high - z), (high, r), (z, r))


def _angles(sharp: tuple[ProfilePiece, ...]) -> Iterator[Dimension]:
    """How far tapers lean from the axis, degrees."""
    for each in sharp:
        long, rise = abs(each.end[0] - each.start[0]), abs(each.end[1] - each.start[1])
        if not each.bulge and long > SAME and rise > SAME:
            yield Dimension(Measure("", math.degrees(math.atan2(rise, long)), "angle"), each.start, each.end)


# Corners of a contour rounded and chamfered, as a drawing has them: exact lines and arcs. Lengths in mm.
#              before         the rounding of radius R touches both neighbours, lines or arcs;
#     .------------o          the chamfer w takes w of each of two lines, or, given as (w, angle), w of the line
#   .'            .'| corner  along X (on a lathe Z, the axis) and leans from it by the angle, degrees.

Chamfer = float | tuple[float, float]


class ProfilePiece(NamedTuple):
    """A line or an arc of the finished contour. `corner` is the number of the point that it breaks, None where it was given."""

    start: tuple[float, float]
    end: tuple[float, float]
    bulge: float
    corner: int | None = None

    @property
    def contour(self) -> Contour:
        return Contour([self.start, self.end], [self.bulge, 0.0], closed=False)


class _Cut(NamedTuple):
    """What breaks a corner: it leaves the element before at `first` and joins the one after at `last`."""

    first: Floats
    last: Floats
    bulge: float


def pieces(
    contour: Contour, roundings: Mapping[int, float], chamfers: Mapping[int, Chamfer], what: str, first: int = 0
) -> list[ProfilePiece]:
    """The elements of a closed contour and what breaks its corners, in order.

    `what` is how alarms call the contour, `first` the number by which they call its first point.
    """
    cuts: dict[int, _Cut] = {}
    for k, radius in roundings.items():
        cuts[k - first] = _rounding(contour, k - first, radius, f"the rounding {radius:g} at corner {k} of {what}")
    for k, chamfer in chamfers.items():
        if k - first in cuts:
            raise Alarm(f"corner {k} of {what} is either rounded or chamfered, got both")
        cuts[k - first] = _chamfer(contour, k - first, chamfer, f"the chamfer at corner {k} of {what}")
    n, found = len(contour.points), list[ProfilePiece]()
    for i, (first_point, last_point, has, sweep) in enumerate(
        zip(contour.starts, contour.ends, contour.lengths.tolist(), contour.sweeps.tolist())
    ):
        before, after = cuts.get(i), cuts.get((i + 1) % n)
        start = before.last if before else first_point
        end = after.first if after else last_point
        left = has - (_way(contour, i, start, True) if before else 0.0) - (_way(contour, i, end, False) if after else 0.0)
        if left < -SAME:
            taken = has - left
            corners = " and ".join(str(k + first) for k in (i, (i + 1) % n) if k in cuts)
            raise Alarm(f"what breaks corner {corners} of {what} takes {taken:.6g} mm of an element that has {has:.6g}")
        if before:
            found.append(ProfilePiece(_pair(before.first), _pair(before.last), before.bulge, i + first))
        if left > SAME:
            found.append(ProfilePiece(_pair(start), _pair(end), math.tan(sweep * left / has / 4)))
    return found


def joined(found: list[ProfilePiece], closed: bool = True) -> Contour:
    """Pieces as a contour."""
    last = [] if closed else [found[-1].end]
    points, bulge = [each.start for each in found] + last, [each.bulge for each in found] + [0.0] * len(last)
    return Contour(points, bulge, closed)


def check_corners(given: Any, name: str, count: int, pairs: bool = False) -> dict[int, Any]:
    """What is given for corners by their numbers, 0 to count - 1, as a dict; an Alarm where it is none."""
    if not isinstance(given, Mapping):
        example = "{2: 1.5}"
        raise Alarm(f"{name} are sizes by the number of the corner, got {shown(given)}", hint=f"{name}={example}")
    found: dict[int, Any] = {}
    for key, size in given.items():
        number = whole(int(key) if isinstance(key, str) and key.isascii() and key.isdigit() else key, f"a corner of {name}")
        if not 0 <= number < count:
            raise Alarm(f"a corner of {name} must be 0 to {count - 1}, a point of the profile, got {number}")
        if pairs and isinstance(size, list | tuple) and len(size) == 2:
            for each in size:
                check_number(each, f"the chamfer at corner {number}", above=0)
            found[number] = (float(size[0]), float(size[1]))
        else:
            check_number(size, f"{name[:-1]} {number} (mm)", above=0)
            found[number] = float(size)
    return dict(sorted(found.items()))


def _rounding(contour: Contour, k: int, radius: float, told: str) -> _Cut:
    turn = float(contour.turns()[k])
    if abs(turn) < SAME or abs(turn) > math.pi - SAME:
        raise Alarm(f"{told} needs a corner there, the contour turns by {math.degrees(turn):.6g} degrees")
    before, after = (contour.curves.take(np.array([i])) for i in (k - 1, k))
    side = np.array([math.copysign(radius, turn)])
    if any((each.r - np.sign(each.sweep) * side < 0).any() for each in (before, after)):
        raise Alarm(f"{told} is greater than an arc beside it")
    centre, first, last, sweep = (column[0] for column in rounded(before, after, side, contour.points[k][None]))
    if not max(abs(float(length_of(foot - centre)) - radius) for foot in (first, last)) <= 1e-7:
        raise Alarm(f"{told} does not touch both its neighbours")
    return _Cut(first, last, math.tan(sweep / 4))


def _chamfer(contour: Contour, k: int, chamfer: Chamfer, told: str) -> _Cut:
    if contour.sweeps[k - 1] or contour.sweeps[k]:
        raise Alarm(f"{told} needs two lines, one of its neighbours is an arc")
    corner = contour.points[k]
    arms = unit_of(np.stack([contour.starts[k - 1] - corner, contour.ends[k] - corner]))
    between = math.atan2(abs(float(cross(arms[0], arms[1]))), float(dot(arms[0], arms[1])))
    if between > math.pi - SAME or between < SAME:
        raise Alarm(f"{told} needs a corner there, the contour goes straight on or back")
    legs = [chamfer, chamfer] if isinstance(chamfer, float) else _legs(arms, between, *chamfer, told)
    return _Cut(corner + legs[0] * arms[0], corner + legs[1] * arms[1], 0.0)


def _legs(arms: Floats, between: float, width: float, angle: float, told: str) -> list[float]:
    along = [abs(float(arm[1])) < SAME for arm in arms]
    if along[0] == along[1]:
        raise Alarm(f"{told} with an angle needs one line along the axis, there {'are two' if along[0] else 'is none'}")
    lean = math.radians(angle)
    if lean + between >= math.pi - SAME:
        allowed = math.degrees(math.pi - between)
        raise Alarm(f"{told} must lean by less than {allowed:.6g} degrees, that of the other line, got {angle:g}")
    other = width * math.sin(lean) / math.sin(lean + between)  # the law of sines
    return [width, other] if along[0] else [other, width]


def _way(contour: Contour, i: int, place: Floats, from_start: bool) -> float:
    """How far a place on the curve of an element lies within it from its start or its end, along it; negative before it."""
    start, end, sweep = contour.starts[i], contour.ends[i], float(contour.sweeps[i])
    if not sweep:
        ahead = unit_of(end - start)
        return float(dot(place - start, ahead) if from_start else dot(end - place, ahead))
    arms = [each - contour.centres[i] for each in ((start, place) if from_start else (place, end))]
    turn = math.atan2(float(cross(*arms)), float(dot(*arms))) * math.copysign(1.0, sweep)
    return turn * float(contour.radii[i])


def _pair(point: Floats) -> tuple[float, float]:
    x, y = point.tolist()
    return x, y
