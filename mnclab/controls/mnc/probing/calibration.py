"""Calibration of the touch probe: its length on a surface, offsets and radius in a ring or on a boss (MNC 12.24 to 12.26).

The ball stands off the spindle axis by the offsets at 0 degrees, and the other way at 180: the centres that both positions find
lie apart by twice the offsets (MNC-G461-180). The probe moves along the axes of the machine.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from mnclab.controls.mnc.probing import addresses
from mnclab.controls.mnc.probing.cycle import TURNS, MeasuringCycle, Moves
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.touching import FEELS, length_touched, offset_written, ring, stud, with_radius
from mnclab.machining.probing.fits import circle
from mnclab.machining.probing.sequences import Approach, Pair
from mnclab.machining.steps import Measure, Orient, Touch
from mnclab.workpiece.part import Part

CYCLES = CycleTable(addresses=addresses, runs="definition")
WORN = 0.5  # mm, by which no ball wears: the figure is another than the program says
MISPLACED = 5.0  # mm, by which the probe may stand off the centre (12.25, 12.26)


@CYCLES("G460", "Calibrate the length of the probe", source="MNC 12.24")
class Length(MeasuringCycle):
    """One touch downwards on a surface whose height is known; the length gets what it is off, its correction becomes 0."""

    does, refused = FEELS, TURNS

    reference_z: float = addresses.coordinate("Z", "height of the reference surface", 0)

    def moves(self, m: Machine) -> Moves:
        x, y, _ = m.programmed
        yield from length_touched(m, self.approach(m), x, y, self.reference_z)


@CYCLES("G461", "Calibrate the probe in a ring", source="MNC 12.25")
class Ring(MeasuringCycle):
    """Offsets and radius from a ring, in which the probe stands at the measuring height, at most 5 mm off the centre."""

    does, refused = FEELS, TURNS

    diameter: float = addresses.size("D", "diameter of the ring", 50)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        yield from self.fits(m, diameter=self.diameter)

    def figure(self, m: Machine) -> Part:
        return ring(m, self.diameter / 2)

    def moves(self, m: Machine) -> Moves:
        a = self.approach(m, height=m.programmed[2], stands=m.programmed[2], track=False)
        yield from offsets_and_radius(self, m, replace(a, reach=max(a.reach, self.diameter / 2 + MISPLACED)), inside=True)


@CYCLES("G462", "Calibrate the probe on a boss", source="MNC 12.26", takes="diameter clearance level")
class CalibrationBoss(MeasuringCycle):
    """Offsets and radius from a boss, over which the probe stands at a safe height, at most 5 mm off its centre."""

    does, refused = FEELS, TURNS

    diameter: float = addresses.size("D", "diameter of the boss", 30)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        if m.programmed[2] < self.level - m.radius:
            yield "level", f"must be below the start, whose ball is at {m.programmed[2] + m.radius:g}, got {self.level:g}"

    def low(self, a: Approach) -> Iterator[tuple[str, str]]:
        yield from ()  # the safe height is where the probe stands

    def figure(self, m: Machine) -> Part:
        return stud(m, self.diameter / 2, m.to_machine((0.0, 0.0, self.level))[2] + m.radius)

    def moves(self, m: Machine) -> Moves:
        a = self.approach(m, height=m.programmed[2], track=False)
        yield from offsets_and_radius(self, m, replace(a, reach=max(a.reach, a.gap + MISPLACED)), inside=False)


def offsets_and_radius(c: Ring | CalibrationBoss, m: Machine, a: Approach, inside: bool) -> Moves:
    """Four touches, and four more with the spindle turned by 180 degrees; what they tell is written."""
    out = 0.0 if inside else c.diameter / 2 + a.away
    start, angle = m.tip[:2], m.tables.probe.angle
    place, found, touches = start, [], []
    for turn in (0.0, 180.0):
        yield Orient("turn the probe", (angle + turn) % 360)
        points = []
        for k in (0, 1):
            for sense in (1, -1):
                contact = yield from touched(m, a, place, (k, sense), out)
                points.append(contact.tip[:2])
                touches.append(contact.number)
            middle = (points[-2][k] + points[-1][k]) / 2
            place = (middle, place[1]) if k == 0 else (place[0], middle)
        yield a.go("to the middle", None, *at(m, place))
        found.append(circle(points, "opposite"))
    yield a.go("to the starting point", None, *at(m, start))
    yield Orient("turn the probe back", angle)
    off = math.dist(start, np.mean([each.centre for each in found], axis=0))
    if off > MISPLACED:
        m.warn(f"{c.code} began {off:.4f} mm off the centre of the figure, farther than {MISPLACED:g}")
    radius = (found[0].radius + found[1].radius) / 2
    radius = c.diameter / 2 - radius if inside else radius - c.diameter / 2
    if radius <= 0:
        m.alarm(f"{c.code} finds a ball of radius {radius:.4f}: the diameter {c.diameter:g} is not that of the figure")
    if abs(radius - m.tool.effective_radius) > WORN:
        asked, kind = f"{radius:.4f}, and its row says {m.tool.effective_radius:g}", "ring" if inside else "boss"
        m.warn(f"{c.code} finds a ball of radius {asked}: is the {kind} of the diameter {c.diameter:g}?")
    yield Measure("radius", radius, m.tool.effective_radius, touches=tuple(touches))
    yield from offset_written(m, found[0].centre, found[1].centre, touches)
    yield from with_radius(m, radius)


def at(m: Machine, place: Pair) -> Pair:
    """A place of the machine in program coordinates."""
    x, y, _ = m.to_program((*place, m.tip[2]))
    return x, y


def touched(m: Machine, a: Approach, place: Pair, side: tuple[int, int], out: float) -> Any:
    """A touch along an axis of the machine on its positive or negative side: from `out` beside the place inwards, or from there
    outwards; returns the contact."""
    k, sense = side
    begin, end = list(place), list(place)
    begin[k] += sense * out
    end[k] = begin[k] + (-sense if out else sense) * a.reach
    x, y = at(m, (begin[0], begin[1]))
    yield a.go("over the starting point", x=x, y=y)
    yield a.go("to the starting point", a.pole)
    contact = yield Touch("touch", *at(m, (end[0], end[1])), a.pole, a.feed, a.ball)
    yield a.go("back", a.pole, x, y)
    yield a.go("to the safe height", a.height)
    return contact
