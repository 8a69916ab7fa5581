"""Measuring cycles: bores and bosses, rectangles, slots and ridges with their limits (MNC 12.14 to 12.19)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

from mnclab.controls.mnc.probing import addresses
from mnclab.controls.mnc.probing.addresses import APPROACH, CENTRE, SIZE
from mnclab.controls.mnc.probing.cycle import Check, MeasuringCycle, Moves, box, centre, conclude, ring, size
from mnclab.machine.cycle import CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machining.probing.found import sketch
from mnclab.machining.probing.sequences import NORMALS, Aim, Approach, in_plane, results
from mnclab.machining.steps import Measure

CYCLES = CycleTable(addresses=addresses, runs="definition")
CIRCLE = f"x y diameter {APPROACH} between {SIZE} {CENTRE}"
BOX = f"x y length_x length_y {APPROACH} between max_size_x min_size_x max_size_y min_size_y {CENTRE}"


def round_measured(c: MeasuringCycle, m: Machine) -> Moves:
    """Centre and diameter, from within or from outside."""
    found, contacts = yield from ring(c.approach(m), (c.x, c.y), c.diameter, c.inside, m.programmed[2])
    yield from results(Q314=found.x, Q315=found.y, Q318=found.diameter)
    yield from results(Q234=found.x - c.x, Q235=found.y - c.y, Q236=found.diameter - c.diameter)
    yield from conclude(
        c, m, contacts, centre("X", found.x, c.x, c.tol_center_x), centre("Y", found.y, c.y, c.tol_center_y),
        size("diameter", found.diameter, c.diameter, c.max_size, c.min_size),
    )  # fmt: skip


@CYCLES("G421", "Measure a bore", source="MNC 12.14", takes=CIRCLE)
class Bore(MeasuringCycle):
    """Four touches give the centre, in the middle between opposite ones, and the diameter."""

    entered = ("diameter",)
    moves = round_measured


@CYCLES("G422", "Measure a boss", source="MNC 12.15", takes=CIRCLE)
class Boss(MeasuringCycle):
    """As G421 from outside; at the measuring height the probe goes round the boss along the axes."""

    inside = False
    moves = round_measured


def box_measured(c: MeasuringCycle, m: Machine) -> Moves:
    """Centre and lengths, from within or from outside."""
    a, lengths = c.approach(m), (c.length_x, c.length_y)
    found, contacts = yield from box(a, (c.x, c.y), lengths, c.inside, m.programmed[2])
    yield from results(Q314=found.x, Q315=found.y, Q316=found.length, Q317=found.width)
    yield from results(Q234=found.x - c.x, Q235=found.y - c.y)
    yield from results(Q237=found.length - c.length_x, Q238=found.width - c.length_y)
    yield from conclude(
        c, m, contacts, centre("X", found.x, c.x, c.tol_center_x), centre("Y", found.y, c.y, c.tol_center_y),
        size("length X", found.length, c.length_x, c.max_size_x, c.min_size_x, "_x"),
        size("length Y", found.width, c.length_y, c.max_size_y, c.min_size_y, "_y"),
    )  # fmt: skip


@CYCLES("G423", "Measure a rectangular pocket", source="MNC 12.16", takes=BOX)
class RectangularPocket(MeasuringCycle):
    """Four touches give the centre and the lengths of the sides, which must lie along the axes."""

    entered = ("length_x", "length_y")
    moves = box_measured


@CYCLES("G424", "Measure a rectangular island", source="MNC 12.17", takes=BOX)
class RectangularIsland(MeasuringCycle):
    """As G423 from outside; at the measuring height the probe goes round the island along the axes."""

    inside = False
    moves = box_measured


def width_measured(c: MeasuringCycle, m: Machine, a: Approach, aims: Sequence[Aim]) -> Moves:
    """The centre along the axis, and the width, by two touches, at the positive side first."""
    k, more = int(c.axis) - 1, a.ball if c.inside else -a.ball
    contacts = yield from in_plane(a, aims, m.programmed[2])
    first, second = contacts[0].point[k] + more, contacts[1].point[k] - more
    middle, wide = (first + second) / 2, first - second
    nominal = math.nan if c.width is None else c.width
    ways = [(each.point, aim.direction) for each, aim in zip(contacts, aims, strict=True)]
    walls = [(at[0] + a.ball * x, at[1] + a.ball * y) for at, (x, y) in ways]
    yield sketch([(aim.x, aim.y) for aim in aims], walls, c.level, contacts)
    yield from results(Q312=middle, Q313=wide, **({} if c.width is None else {"Q239": wide - c.width}))
    expected = sum((aim.x, aim.y)[k] for aim in aims) / 2
    yield from conclude(
        c, m, contacts, Check(Measure(f"centre {'XY'[k]}", middle, expected)),
        size("width", wide, nominal, c.max_size, c.min_size),
    )  # fmt: skip


@CYCLES(
    "G425", "Measure a slot", source="MNC 12.18",
    takes=f"x y offset_2 axis {APPROACH} width between {SIZE} protocol stop_on_error",
)  # fmt: skip
class SlotMeasuring(MeasuringCycle):
    """Two touches from within, first in the positive direction; the second one may be shifted along the slot.

    Without a width, or without room before the sides, both begin in the starting point.
    """

    x: float = addresses.x(meaning="X of the starting point")
    y: float = addresses.y(meaning="Y of the starting point", example=20)
    offset_2: float = param("W", "shift of the second touch across the axis", default=0, incremental=True, example=15)
    width: float | None = addresses.width(default=None, default_means="from the point itself")
    protocol: float = addresses.protocol("M")
    max_size: float | None = addresses.max_size(example=20.05)
    min_size: float | None = addresses.min_size(example=19.95)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        if self.width is not None:
            yield from self.fits(m, width=self.width)

    def moves(self, m: Machine) -> Moves:
        a, half, k = self.approach(m), (self.width or 0.0) / 2, int(self.axis) - 1
        back = None
        if half <= a.away:
            back, a = half, replace(a, over=False).as_far_as(half)
        (x, y), (dx, dy) = NORMALS[k], NORMALS[1 - k]
        first = Aim(self.x + half * x, self.y + half * y, (x, y), back)
        second = Aim(self.x - half * x + self.offset_2 * dx, self.y - half * y + self.offset_2 * dy, (-x, -y), back)
        yield from width_measured(self, m, a, (first, second))


@CYCLES(
    "G426", "Measure a ridge", source="MNC 12.19", takes=f"x y x2 y2 axis {APPROACH} width {SIZE} protocol stop_on_error"
)  # fmt: skip
class Ridge(MeasuringCycle):
    """Two touches from outside, first in the negative direction; between them the probe goes over the safe height."""

    between, inside = 1.0, False
    x: float = addresses.x(meaning="X of the first measuring point", example=65)
    y: float = addresses.y(meaning="Y of the first measuring point", example=40)
    x2: float = addresses.x2(example=35)
    y2: float = addresses.y2(example=40)
    width: float | None = addresses.width(default=None, default_means="no Q239", example=30)
    protocol: float = addresses.protocol("M")

    def contradictions(self) -> Iterator[tuple[str, str]]:
        yield from super().contradictions()
        if self.axis == 1 and self.x <= self.x2:
            yield "x2", f"must be less than X {self.x:g}, got {self.x2:g}: the first point is on the positive side"
        if self.axis == 2 and self.y <= self.y2:
            yield "y2", f"must be less than Y {self.y:g}, got {self.y2:g}: the first point is on the positive side"

    def moves(self, m: Machine) -> Moves:
        x, y = NORMALS[int(self.axis) - 1]
        aims = Aim(self.x, self.y, (-x, -y)), Aim(self.x2, self.y2, (x, y))
        a, apart = self.approach(m), (self.x - self.x2) * x + (self.y - self.y2) * y
        if self.width is not None and (more := apart - self.width) > 0:  # the points are not on the ridge
            a = a.as_far_as(a.away + more)
        yield from width_measured(self, m, a, aims)
