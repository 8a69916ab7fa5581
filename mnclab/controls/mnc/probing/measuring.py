"""Measuring cycles: an angle, bores and bosses, rectangles, slots and ridges with their limits (MNC 12.13 to 12.19)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from mnclab.controls.mnc.cycles.addresses import choice, kind
from mnclab.controls.mnc.probing import addresses
from mnclab.controls.mnc.probing.cycle import MeasuringCycle, Moves, numbers, results
from mnclab.controls.mnc.probing.figures import box, ring
from mnclab.controls.mnc.probing.protocol import Check, centre, conclude, size
from mnclab.machine.cycle import CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machine.touching import Contact
from mnclab.machining.probing.fits import line, reduced
from mnclab.machining.probing.sequences import NORMALS, Aim, Approach, Pair, in_plane
from mnclab.machining.probing.sketches import sketch
from mnclab.machining.steps import Measure, Step

CYCLES = CycleTable()
PROTOCOL: dict[float, str] = {0: "none", 1: "write a file into the folder meas_prot"}
STOP: dict[float, str] = {0: "no stop, no message", 1: "program interrupted, message"}

limit = kind(default=None, default_means="not checked", note="0: not checked")
deviation = kind(default=None, default_means="not checked", at_least=0, note="both ways; 0: not checked")
off_x = partial(deviation, "U", "permissible deviation of the centre along X", 0.05)
off_y = partial(deviation, "V", "permissible deviation of the centre along Y", 0.05)


def protocol(address: str) -> Any:
    return choice(address, "measuring protocol", PROTOCOL, 1, default=0)


def stop() -> Any:
    return choice("E", "what happens beyond a limit", STOP, 1, default=0)


def in_order(name: str, least: float | None, most: float | None) -> Iterator[tuple[str, str]]:
    """A least size above the greatest one."""
    if least and most and least > most:
        yield name, f"must be at most the greatest permissible size {most:g}, got {least:g}"


def touched(a: Approach, contacts: Sequence[Contact], ways: Sequence[Pair]) -> list[Pair]:
    """Where the balls touched, along their directions."""
    return [(c.point[0] + a.ball * x, c.point[1] + a.ball * y) for c, (x, y) in zip(contacts, ways, strict=True)]


def written(c: MeasuringCycle, m: Machine, contacts: Sequence[Contact], *checks: Check) -> Iterator[Step]:
    """The record, the protocol and the stop of a cycle, as its parameters say; its datum and base rotation stay."""
    yield from conclude(m, c.code, checks, numbers(contacts), c.protocol == 1, c.stop_on_error == 1)


@CYCLES("G420", "Measure an angle in the XY plane", runs="definition", source="MNC 12.13")
class Angle(MeasuringCycle):
    """Two touches of a straight side give its angle to X; a base rotation stays, and the angle counts from its X."""

    x: float = addresses.coordinate("X", "X of the first measuring point", 20)
    y: float = addresses.coordinate("Y", "Y of the first measuring point", 0)
    x2: float = addresses.coordinate("U", "X of the second measuring point", 80)
    y2: float = addresses.coordinate("V", "Y of the second measuring point", 0)
    axis: float = addresses.axis(example=2)
    direction: float = addresses.direction()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    between: float = addresses.between()
    protocol: float = protocol("M")

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if self.axis == 1 and self.y2 == self.y:
            yield "y2", f"must differ from Y, got {self.y2:g}: both points are one along the side"
        if self.axis == 2 and self.x2 == self.x:
            yield "x2", f"must differ from X, got {self.x2:g}: both points are one along the side"

    def moves(self, m: Machine) -> Moves:
        a, way = self.approach(m), (self.direction, 0.0) if self.axis == 1 else (0.0, self.direction)
        points = (self.x, self.y), (self.x2, self.y2)
        contacts = yield from in_plane(a, [Aim(x, y, way) for x, y in points], m.programmed[2])
        found = line([contact.point[:2] for contact in contacts])
        angle = found.angle % 180 if self.axis == 1 else reduced(found.angle)  # of a line (MNC-G420-RANGE)
        yield sketch(points, touched(a, contacts, (way, way)), self.level, numbers(contacts))
        yield from results(Q319=angle)
        yield from written(self, m, contacts, Check(Measure("angle", angle, unit="deg")))


@CYCLES("G421", "Measure a bore", runs="definition", source="MNC 12.14")
class Bore(MeasuringCycle):
    """Four touches give the centre, in the middle between opposite ones, and the diameter."""

    x: float = addresses.coordinate("X", "X of the centre", 10)
    y: float = addresses.coordinate("Y", "Y of the centre", -5)
    diameter: float = addresses.diameter()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    between: float = addresses.between()
    max_size: float | None = limit("R", "greatest permissible diameter", 30.05)
    min_size: float | None = limit("T", "least permissible diameter", 29.95)
    tol_center_x: float | None = off_x()
    tol_center_y: float | None = off_y()
    protocol: float = protocol("L")
    stop_on_error: float = stop()

    def contradictions(self) -> Iterator[tuple[str, str]]:
        yield from in_order("min_size", self.min_size, self.max_size)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        yield from self.fits(m, diameter=self.diameter)

    def moves(self, m: Machine) -> Moves:
        yield from round_measured(self, m, True)


@CYCLES("G422", "Measure a boss", runs="definition", source="MNC 12.15")
class Boss(MeasuringCycle):
    """As G421 from outside; at the measuring height the probe goes round the boss along the axes."""

    x: float = addresses.coordinate("X", "X of the centre", 10)
    y: float = addresses.coordinate("Y", "Y of the centre", -5)
    diameter: float = addresses.diameter()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    between: float = addresses.between()
    max_size: float | None = limit("R", "greatest permissible diameter", 30.05)
    min_size: float | None = limit("T", "least permissible diameter", 29.95)
    tol_center_x: float | None = off_x()
    tol_center_y: float | None = off_y()
    protocol: float = protocol("L")
    stop_on_error: float = stop()

    def contradictions(self) -> Iterator[tuple[str, str]]:
        yield from in_order("min_size", self.min_size, self.max_size)

    def moves(self, m: Machine) -> Moves:
        yield from round_measured(self, m, False)


@CYCLES("G423", "Measure a rectangular pocket", runs="definition", source="MNC 12.16")
class RectangularPocket(MeasuringCycle):
    """Four touches give the centre and the lengths of the sides, which must lie along the axes."""

    x: float = addresses.coordinate("X", "X of the centre", 60)
    y: float = addresses.coordinate("Y", "Y of the centre", 40)
    length_x: float = addresses.length_x()
    length_y: float = addresses.length_y()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    between: float = addresses.between()
    max_size_x: float | None = limit("R", "greatest permissible length along X", 80.05)
    min_size_x: float | None = limit("T", "least permissible length along X", 79.95)
    max_size_y: float | None = limit("J", "greatest permissible length along Y", 50.05)
    min_size_y: float | None = limit("K", "least permissible length along Y", 49.95)
    tol_center_x: float | None = off_x()
    tol_center_y: float | None = off_y()
    protocol: float = protocol("L")
    stop_on_error: float = stop()

    def contradictions(self) -> Iterator[tuple[str, str]]:
        yield from in_order("min_size_x", self.min_size_x, self.max_size_x)
        yield from in_order("min_size_y", self.min_size_y, self.max_size_y)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        yield from self.fits(m, length_x=self.length_x, length_y=self.length_y)

    def moves(self, m: Machine) -> Moves:
        yield from rectangle_measured(self, m, True)


@CYCLES("G424", "Measure a rectangular island", runs="definition", source="MNC 12.17")
class RectangularIsland(MeasuringCycle):
    """As G423 from outside; at the measuring height the probe goes round the island along the axes."""

    x: float = addresses.coordinate("X", "X of the centre", 60)
    y: float = addresses.coordinate("Y", "Y of the centre", 40)
    length_x: float = addresses.length_x()
    length_y: float = addresses.length_y()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    between: float = addresses.between()
    max_size_x: float | None = limit("R", "greatest permissible length along X", 80.05)
    min_size_x: float | None = limit("T", "least permissible length along X", 79.95)
    max_size_y: float | None = limit("J", "greatest permissible length along Y", 50.05)
    min_size_y: float | None = limit("K", "least permissible length along Y", 49.95)
    tol_center_x: float | None = off_x()
    tol_center_y: float | None = off_y()
    protocol: float = protocol("L")
    stop_on_error: float = stop()

    def contradictions(self) -> Iterator[tuple[str, str]]:
        yield from in_order("min_size_x", self.min_size_x, self.max_size_x)
        yield from in_order("min_size_y", self.min_size_y, self.max_size_y)

    def moves(self, m: Machine) -> Moves:
        yield from rectangle_measured(self, m, False)


@CYCLES("G425", "Measure a slot", runs="definition", source="MNC 12.18")
class Slot(MeasuringCycle):
    """Two touches from within, first in the positive direction; the second one may be shifted along the slot.

    Without a width, or without room before the sides, both begin in the starting point.
    """

    x: float = addresses.coordinate("X", "X of the starting point", 50)
    y: float = addresses.coordinate("Y", "Y of the starting point", 20)
    offset_2: float = param("W", "shift of the second touch across the axis", default=0, incremental=True, example=15)
    axis: float = addresses.axis()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    width: float | None = addresses.width(meaning="nominal width", default=None, default_means="from the point itself")
    between: float = addresses.between()
    max_size: float | None = limit("R", "greatest permissible width", 20.05)
    min_size: float | None = limit("T", "least permissible width", 19.95)
    protocol: float = protocol("M")
    stop_on_error: float = stop()

    def contradictions(self) -> Iterator[tuple[str, str]]:
        yield from in_order("min_size", self.min_size, self.max_size)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        if self.width is not None:
            yield from self.fits(m, width=self.width)

    def moves(self, m: Machine) -> Moves:
        a, half, k = self.approach(m), (self.width or 0.0) / 2, int(self.axis) - 1
        back = None
        if half <= a.away:
            back, a = half, replace(a, over=False, reach=max(a.reach, half + a.gap if half else 0.0))
        (x, y), (dx, dy) = NORMALS[k], NORMALS[1 - k]
        first = Aim(self.x + half * x, self.y + half * y, (x, y), back)
        second = Aim(self.x - half * x + self.offset_2 * dx, self.y - half * y + self.offset_2 * dy, (-x, -y), back)
        yield from width_measured(self, m, a, (first, second), True)


@CYCLES("G426", "Measure a ridge", runs="definition", source="MNC 12.19")
class Ridge(MeasuringCycle):
    """Two touches from outside, first in the negative direction; between them the probe goes over the safe height."""

    between = 1.0

    x: float = addresses.coordinate("X", "X of the first measuring point", 65)
    y: float = addresses.coordinate("Y", "Y of the first measuring point", 40)
    x2: float = addresses.coordinate("U", "X of the second measuring point", 35)
    y2: float = addresses.coordinate("V", "Y of the second measuring point", 40)
    axis: float = addresses.axis()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    width: float | None = addresses.width(meaning="nominal width", default=None, default_means="no Q239", example=30)
    max_size: float | None = limit("R", "greatest permissible width", 30.05)
    min_size: float | None = limit("T", "least permissible width", 29.95)
    protocol: float = protocol("M")
    stop_on_error: float = stop()

    def contradictions(self) -> Iterator[tuple[str, str]]:
        yield from in_order("min_size", self.min_size, self.max_size)
        if self.axis == 1 and self.x <= self.x2:
            yield "x2", f"must be less than X {self.x:g}, got {self.x2:g}: the first point is on the positive side"
        if self.axis == 2 and self.y <= self.y2:
            yield "y2", f"must be less than Y {self.y:g}, got {self.y2:g}: the first point is on the positive side"

    def moves(self, m: Machine) -> Moves:
        x, y = NORMALS[int(self.axis) - 1]
        aims = Aim(self.x, self.y, (-x, -y)), Aim(self.x2, self.y2, (x, y))
        yield from width_measured(self, m, self.approach(m), aims, False)


def round_measured(c: Bore | Boss, m: Machine, inside: bool) -> Moves:
    """Centre and diameter, from within or from outside."""
    a, now = c.approach(m), m.programmed[2]
    found, contacts = yield from ring(a, (c.x, c.y), c.diameter, inside, now)
    yield from results(Q314=found.x, Q315=found.y, Q318=found.diameter)
    yield from results(Q234=found.x - c.x, Q235=found.y - c.y, Q236=found.diameter - c.diameter)
    yield from written(
        c, m, contacts, centre("X", found.x, c.x, c.tol_center_x), centre("Y", found.y, c.y, c.tol_center_y),
        size("diameter", found.diameter, c.diameter, c.max_size, c.min_size),
    )  # fmt: skip


def rectangle_measured(c: RectangularPocket | RectangularIsland, m: Machine, inside: bool) -> Moves:
    """Centre and lengths, from within or from outside."""
    a, now = c.approach(m), m.programmed[2]
    found, contacts = yield from box(a, (c.x, c.y), (c.length_x, c.length_y), inside, now)
    yield from results(Q314=found.x, Q315=found.y, Q316=found.length, Q317=found.width)
    yield from results(Q234=found.x - c.x, Q235=found.y - c.y)
    yield from results(Q237=found.length - c.length_x, Q238=found.width - c.length_y)
    yield from written(
        c, m, contacts, centre("X", found.x, c.x, c.tol_center_x), centre("Y", found.y, c.y, c.tol_center_y),
        size("length X", found.length, c.length_x, c.max_size_x, c.min_size_x, "_x"),
        size("length Y", found.width, c.length_y, c.max_size_y, c.min_size_y, "_y"),
    )  # fmt: skip


def width_measured(c: Slot | Ridge, m: Machine, a: Approach, aims: Sequence[Aim], inside: bool) -> Moves:
    """Both touches, at the positive side first; the centre along the axis and the width."""
    k, more = int(c.axis) - 1, a.ball if inside else -a.ball
    contacts = yield from in_plane(a, aims, m.programmed[2])
    first, second = contacts[0].point[k] + more, contacts[1].point[k] - more
    middle, wide = (first + second) / 2, first - second
    nominal = math.nan if c.width is None else c.width
    walls = touched(a, contacts, [aim.direction for aim in aims])
    yield sketch([(aim.x, aim.y) for aim in aims], walls, c.level, numbers(contacts))
    yield from results(Q312=middle, Q313=wide, **({} if c.width is None else {"Q239": wide - c.width}))
    expected = sum((aim.x, aim.y)[k] for aim in aims) / 2
    yield from written(
        c, m, contacts, Check(Measure(f"centre {'XY'[k]}", middle, expected)),
        size("width", wide, nominal, c.max_size, c.min_size),
    )  # fmt: skip
