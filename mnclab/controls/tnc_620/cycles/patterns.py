"""Point patterns (chapter 7): cycles 220 and 221 run the cycle defined last at points on a circle or on lines, at once.

Their Q200, Q203, Q204 (and Q224) are those of that cycle from then on: it reads the same Q parameters.

With Q301 = 0 the tool traverses at the set-up clearance *between the operations*, and that is where it stops (step 3): so
the cycle retracts to it, and to the second set-up clearance only after the last point. To rise there at every point and
come down again before the way across would make Q301 = 0 the longer way of the two, and protect nothing.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.true_size import faults, is_round
from mnclab.machining import patterns
from mnclab.running.performing import run_cycle
from mnclab.running.repeating import at_each

CYCLES = CycleTable()
MOST = 100_000  # points
MOST_ON_ARCS = 10_000  # where each way is another arc, and no visit is the one before, moved

_BOTH = (*range(200, 210), 240, 251, 252, 253, 256, 257, 262, 263, 264, 265, 267)
TRAVERSE: dict[float, str] = {0: "at the set-up clearance", 1: "at the second set-up clearance"}
WAY: dict[float, str] = {0: "straight", 1: "on the pitch circle"}
Floats = NDArray[np.float64]


class PointPattern(Cycle):
    """What both have in common: heights, the machining cycle, the way from point to point."""

    combines: ClassVar[frozenset[str]] = frozenset(f"CYCL DEF {n}" for n in _BOTH)
    clearance: float
    surface: float
    second_clearance: float
    move_to_clearance: float

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """A machining cycle that may be combined, a tool position without compensation."""
        if m.cycle is None:
            yield "", "has no machining cycle to run: define one before it, for example CYCL DEF 200"
            return
        if m.cycle.cycle.code not in self.combines:
            sentence = f"cannot be combined with {m.cycle.cycle.code} ({m.cycle.cycle.title})"
            if m.settings["pattern_cycles"] == "refuse" or m.cycle.cycle.code == "CYCL DEF 254":
                yield "", sentence
            else:
                m.warn(f"{self.code} {sentence}")
        for sentence in faults(m.cycle.cycle.does, m):
            yield "", f"cannot run {m.cycle.cycle.code} here, which {sentence}"
        if m.side:
            yield "", "cannot run under radius compensation: write R0 before it"

    @property
    def between(self) -> float:
        """The level from point to point."""
        return self.above if self.move_to_clearance == 0 else self.high

    @property
    def above(self) -> float:
        """The set-up clearance."""
        return self.surface + self.clearance

    @property
    def high(self) -> float:
        """The second set-up clearance, where it is the greater one."""
        return self.surface + max(self.clearance, self.second_clearance)

    def run(self, m: Machine, points: Floats) -> None:
        """At the second set-up clearance over the first of the points (n, 2); then the cycle at each."""
        self.go(m, z=self.high, to="the second set-up clearance")
        (x, y), others = points[0], points[1:]
        self.go(m, x=float(x), y=float(y), to="the first point")
        self.work(m, last=not len(others))
        self.run_others(m, others)

    def run_others(self, m: Machine, points: Floats) -> None:
        """All points but the first, on straight lines."""

        def visit(x: float, y: float, last: bool = False) -> None:
            self.go(m, z=self.between, to="the level between the points")
            self.go(m, x=x, y=y, to="the next point")
            self.work(m, last)

        at_each(m, points[:-1], visit)
        for x, y in points[-1:].tolist():
            visit(x, y, last=True)

    def work(self, m: Machine, last: bool) -> None:
        """At a point: to the set-up clearance, and the machining cycle; it ends at the level between the points."""
        self.go(m, z=self.above, to="the set-up clearance")
        assert m.cycle is not None
        run_cycle(m, m.cycle, second_clearance=(self.high if last else self.between) - self.surface)

    def go(
        self, m: Machine, x: float | None = None, y: float | None = None, z: float | None = None, to: str = ""
    ) -> None:
        """A rapid move with its label."""
        label, m.label = m.label, f"{self.code} to {to}"
        m.rapid(x, y, z)
        m.label = label


@CYCLES("CYCL DEF 220", "Polar pattern", runs="definition", source="7.2")
class PolarPattern(PointPattern):
    """Runs the cycle defined last at points on a circle or an arc."""

    center_in_1st_axis: float = addresses.coordinate("Q216", "centre along the first axis", example=50)
    center_in_2nd_axis: float = addresses.coordinate("Q217", "centre along the second axis", example=50)
    pitch_circle_diameter: float = addresses.length("Q244", "diameter of the pitch circle", example=80)
    starting_angle: float = addresses.angle("Q245", "starting angle", example=0)
    stopping_angle: float = addresses.angle("Q246", "stopping angle", example=360, note="where Q247 is 0")
    stepping_angle: float = addresses.angle(
        "Q247", "stepping angle", incremental=True, note="0: from the other angles and the number"
    )
    nr_of_repetitions: float = addresses.number("Q241", "number of operations", example=8)
    clearance: float = addresses.clearance()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    move_to_clearance: float = addresses.choice("Q301", "level between the points", TRAVERSE)
    type_of_traverse: float = addresses.choice("Q365", "way between the points", WAY)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """As both; and an arc to divide."""
        yield from super().check(m)
        if self.type_of_traverse == 1 and not is_round(m):
            yield "type_of_traverse", "must be 0 under unequal scales of the plane, got 1: the way would be an ellipse"
        if self.type_of_traverse == 1 and self.nr_of_repetitions > MOST_ON_ARCS:
            many = f"must be at most {MOST_ON_ARCS} on the pitch circle (Q365 = 1)"
            yield "nr_of_repetitions", f"{many}, got {self.nr_of_repetitions:.10g}"
        if self.stepping_angle == 0 and self.stopping_angle == self.starting_angle:
            yield "stopping_angle", f"must differ from the starting angle Q245, got {self.stopping_angle:g}"

    def step(self) -> float:
        """From point to point, rad, positive counter-clockwise."""
        if self.stepping_angle:
            return math.radians(self.stepping_angle)
        start, end = math.radians(self.starting_angle), math.radians(self.stopping_angle)
        closed = abs(abs(self.stopping_angle - self.starting_angle) - 360) <= 1e-9
        return patterns.step_between(start, end, int(self.nr_of_repetitions), closed)

    def centre(self) -> tuple[float, float]:
        """Of the pitch circle."""
        return self.center_in_1st_axis, self.center_in_2nd_axis

    def moves(self, m: Machine) -> None:
        """Points on the circle, from the starting angle."""
        start, radius = math.radians(self.starting_angle), self.pitch_circle_diameter / 2
        self.run(m, patterns.circle(self.centre(), radius, start, self.step(), int(self.nr_of_repetitions)))

    def run_others(self, m: Machine, points: Floats) -> None:
        """Straight, or along the pitch circle, as fast as each axis may go: an arc has a feed rate."""
        if self.type_of_traverse == 0:
            super().run_others(m, points)
            return
        for number in range(len(points)):
            self.go(m, z=self.between, to="the level between the points")
            label, m.label = m.label, f"{self.code} along the pitch circle"
            if self.pitch_circle_diameter:
                m.turn(self.centre(), self.step(), f=float(np.min(m.setup.limits.rapid)))
            m.label = label
            self.work(m, last=number == len(points) - 1)


@CYCLES("CYCL DEF 221", "Cartesian pattern", runs="definition", source="7.3")
class CartesianPattern(PointPattern):
    """Runs the cycle defined last at points on lines, to and fro."""

    combines = PointPattern.combines | {"CYCL DEF 254"}

    starting_point_1st_axis: float = addresses.coordinate("Q225", "starting point along the first axis", example=15)
    starting_point_2nd_axis: float = addresses.coordinate("Q226", "starting point along the second axis", example=15)
    spacing_in_1st_axis: float = addresses.coordinate("Q237", "spacing along a line", example=10, incremental=True)
    spacing_in_2nd_axis: float = addresses.coordinate("Q238", "spacing of the lines", example=8, incremental=True)
    number_of_columns: float = addresses.number("Q242", "number of operations on a line", example=6)
    number_of_lines: float = addresses.number("Q243", "number of lines", example=4)
    angle_of_rotation: float = addresses.angle("Q224", "rotation about the starting point", example=15)
    clearance: float = addresses.clearance()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    move_to_clearance: float = addresses.choice("Q301", "level between the points", TRAVERSE)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """As both; a circular slot must have a place in the pattern (Q367); no more points than any plate has."""
        yield from super().check(m)
        if m.cycle is not None and m.cycle.cycle.code == "CYCL DEF 254" and m.variables.get("Q367") == 0:
            yield "", "cannot be combined with CYCL DEF 254 and Q367 = 0"
        if self.number_of_columns * self.number_of_lines > MOST:
            many = self.number_of_columns * self.number_of_lines
            yield "number_of_lines", f"makes {many:g} points, more than {MOST}"

    def moves(self, m: Machine) -> None:
        """Line by line, to and fro."""
        points = patterns.grid(
            (self.starting_point_1st_axis, self.starting_point_2nd_axis),
            (self.spacing_in_1st_axis, self.spacing_in_2nd_axis),
            (int(self.number_of_columns), int(self.number_of_lines)),
            math.radians(self.angle_of_rotation),
        )
        self.run(m, points)
