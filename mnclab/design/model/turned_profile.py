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

from mnclab.design.model.corners import Piece, check_corners, joined, pieces
from mnclab.design.model.measures import Measure
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.text.alarm import Alarm
from mnclab.text.given import faults_as_alarms, shown

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
    def pieces(self) -> tuple[Piece, ...]:
        """The lines and arcs of the section, counter-clockwise from the front end on; `corner` counts as given."""
        return self._pieces(self.roundings, self.chamfers)

    def _pieces(self, roundings: Mapping[int, float], chamfers: Mapping[int, Any]) -> tuple[Piece, ...]:
        loop, first = self._loop
        found = pieces(loop, roundings, chamfers, WHAT, first)
        if joined(found).area < 0:
            found = [Piece(each.end, each.start, -each.bulge, each.corner) for each in reversed(found)]
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


def _level(piece: Piece) -> bool:
    """A cylinder."""
    return not piece.bulge and abs(piece.start[1] - piece.end[1]) <= SAME


def _diameters(sharp: tuple[Piece, ...]) -> Iterator[Dimension]:
    """Those of cylinders, and of corners where no cylinder begins or ends."""
    for k, each in enumerate(sharp):
        radius = each.start[1]
        if radius > SAME and not _level(each) and not _level(sharp[k - 1]):
            yield Dimension(Measure("", 2 * radius, "diameter"), each.start, each.start)
        if _level(each) and radius > SAME:
            yield Dimension(Measure("", 2 * radius, "diameter"), each.start, each.end)


def _lengths(sharp: tuple[Piece, ...], low: float, high: float) -> Iterator[Dimension]:
    """From the front end to every other z of a corner."""
    places = {round(z, 9): (z, r) for each in sharp for z, r in (each.start, each.end)}
    for _, (z, r) in sorted(places.items(), reverse=True):
        if low + SAME < z < high - SAME:
            yield Dimension(Measure("", high - z), (high, r), (z, r))


def _angles(sharp: tuple[Piece, ...]) -> Iterator[Dimension]:
    """How far tapers lean from the axis, degrees."""
    for each in sharp:
        long, rise = abs(each.end[0] - each.start[0]), abs(each.end[1] - each.start[1])
        if not each.bulge and long > SAME and rise > SAME:
            yield Dimension(Measure("", math.degrees(math.atan2(rise, long)), "angle"), each.start, each.end)
