"""Point patterns: rows, grids, frames and circles of points in the order in which a tool goes to them, and cycles 220 and 221.

Lengths in mm, angles in rad, counter-clockwise from the first axis; the functions give points (n, 2).
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, increment, length, number
from mnclab.controls.tnc_620.cycles.planes import ParameterFault, in_program_coordinates
from mnclab.machine.coordinates import faults, is_round
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Call, Each, Go, Step, Turn

Points = NDArray[np.float64]
Pair = tuple[float, float]

TURN = 2 * math.pi


def row(start: Pair, spacing: float, count: int, rotation: float = 0.0) -> Points:
    """Points on a straight line from `start`, `spacing` apart in the direction `rotation`."""
    along = np.arange(count)[:, None] * spacing
    return np.array(start) + along * [math.cos(rotation), math.sin(rotation)]


def grid(start: Pair, spacing: Pair, count: tuple[int, int], rotation: float = 0.0, lean: Pair = (0.0, 0.0)) -> Points:
    """Columns along the first axis, rows along the second, row by row, to and fro.

    The whole is turned about `start` by `rotation`; `lean` turns each of its two axes further, and the spacing
    along them stays.
    """
    i, j = (index.ravel() for index in np.meshgrid(np.arange(count[0]), np.arange(count[1])))
    i = np.where(j % 2 == 0, i, count[0] - 1 - i)
    return _placed(i, j, start, spacing, rotation, lean)


def frame(start: Pair, spacing: Pair, count: tuple[int, int], rotation: float = 0.0, lean: Pair = (0.0, 0.0)) -> Points:
    """The outer points of a grid, once around from `start`, the first row first."""
    last, top = count[0] - 1, count[1] - 1
    if last == 0 or top == 0:
        return grid(start, spacing, count, rotation, lean)
    across, up = np.arange(last), np.arange(top)
    i = np.concatenate([across, np.full(top, last), last - across, np.zeros(top, dtype=int)])
    j = np.concatenate([np.zeros(last, dtype=int), up, np.full(last, top), top - up])
    return _placed(i, j, start, spacing, rotation, lean)


def _placed(
    i: NDArray[np.integer], j: NDArray[np.integer], start: Pair, spacing: Pair, rotation: float, lean: Pair
) -> Points:
    """The points of columns `i` and rows `j` of a grid."""
    first, second = rotation + lean[0], rotation + lean[1]
    u = np.array([math.cos(first), math.sin(first)]) * spacing[0]
    v = np.array([-math.sin(second), math.cos(second)]) * spacing[1]
    return np.array(start) + i[:, None] * u + j[:, None] * v


def circle(centre: Pair, radius: float, start: float, step: float, count: int) -> Points:
    """Points on a circle from the angle `start`, each turned by `step` from the one before."""
    angle = start + np.arange(count) * step
    return np.array(centre) + radius * np.column_stack([np.cos(angle), np.sin(angle)])


def step_between(start: float, end: float, count: int, closed: bool = False) -> float:
    """The angle from point to point of `count` from `start` to `end`; on a `closed` circle the last lies one step before it."""
    gaps = count if closed else count - 1
    return (end - start) / gaps if gaps else 0.0


# Point patterns (chapter 7): cycles 220 and 221 run the cycle defined last at points on a circle or on lines, at once.
#
# Their Q200, Q203, Q204 (and Q224) are those of that cycle from then on: it reads the same Q parameters.
#
# With Q301 = 0 the tool traverses at the set-up clearance *between the operations*, and that is where it stops (step 3): so
# the cycle retracts to it, and to the second set-up clearance only after the last point. To rise there at every point and
# come down again before the way across would make Q301 = 0 the longer way of the two, and protect nothing.

CYCLES = CycleTable()
MOST = 100_000  # points
MOST_ON_ARCS = 10_000  # where each way is another arc, and no visit is the one before, moved

_BOTH = (*range(200, 210), 240, 251, 252, 253, 256, 257, 262, 263, 264, 265, 267)
TRAVERSE: dict[float, str] = {0: "at the set-up clearance", 1: "at the second set-up clearance"}
WAY: dict[float, str] = {0: "straight", 1: "on the pitch circle"}
Floats = NDArray[np.float64]


class PointPattern(Cycle, ABC):
    """What both have in common: heights, the machining cycle, the way from point to point."""

    about = in_program_coordinates
    combines: ClassVar[frozenset[str]] = frozenset(f"CYCL DEF {n}" for n in _BOTH)
    clearance: float
    surface: float
    second_clearance: float
    move_to_clearance: float

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        if m.cycle is None:
            yield "", "has no machining cycle to run: define one before it, for example CYCL DEF 200"
            return
        run = m.cycle.cycle
        if run.code not in self.combines:
            sentence = f"cannot be combined with {run.code} ({run.title})"
            if m.settings["pattern_cycles"] == "refuse" or run.code == "CYCL DEF 254":
                yield "", sentence
            else:
                m.warn(f"{self.code} {sentence}")
        for sentence in faults(run.does, m):
            yield "", f"cannot run {run.code} here, which {sentence}"
        if m.side:
            yield "", "cannot run under radius compensation: write R0 before it"

    @property
    def above(self) -> float:
        """The set-up clearance over the surface."""
        return self.surface + self.clearance

    @property
    def end(self) -> float:
        """The second set-up clearance, where it is the greater one."""
        return self.surface + max(self.second_clearance, self.clearance)

    @property
    def between(self) -> float:
        """The level from point to point."""
        return self.above if self.move_to_clearance == 0 else self.end

    @abstractmethod
    def points(self) -> Floats:
        """Where the cycle runs, (n, 2)."""

    def moves(self, m: Machine) -> Iterator[Step]:
        points = self.points()
        (x, y), others = points[0].tolist(), points[1:]
        yield Go("to the second set-up clearance", self.end)
        yield Go("to the first point", x=x, y=y)
        yield from self.work(last=not len(others))
        yield from self.others(m, others)

    def others(self, m: Machine, points: Floats) -> Iterator[Step]:
        yield Each(points[:-1], self.visit)
        for x, y in points[-1:].tolist():
            yield from self.visit(x, y, last=True)

    def visit(self, x: float, y: float, last: bool = False) -> Iterator[Step]:
        yield Go("to the level between the points", self.between)
        yield Go("to the next point", x=x, y=y)
        yield from self.work(last)

    def work(self, last: bool) -> Iterator[Step]:
        """At a point: to the set-up clearance, and the machining cycle; it ends at the level between the points."""
        yield Go("to the set-up clearance", self.above)
        yield Call({"second_clearance": (self.end if last else self.between) - self.surface})


@CYCLES("CYCL DEF 220", "Polar pattern", runs="definition", source="7.2")
class PolarPattern(PointPattern):
    """Runs the cycle defined last at points on a circle or an arc."""

    center_in_1st_axis: float = coordinate("Q216", "centre along the first axis", example=50)
    center_in_2nd_axis: float = coordinate("Q217", "centre along the second axis", example=50)
    pitch_circle_diameter: float = length("Q244", "diameter of the pitch circle", example=80)
    starting_angle: float = addresses.angle("Q245", "starting angle", example=0)
    stopping_angle: float = addresses.angle("Q246", "stopping angle", example=360, note="where Q247 is 0")
    stepping_angle: float = addresses.angle(
        "Q247", "stepping angle", incremental=True, note="0: from the other angles and the number", example=0
    )
    nr_of_repetitions: float = number("Q241", "number of operations", example=8)
    clearance: float = addresses.clearance()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    move_to_clearance: float = choice("Q301", "level between the points", TRAVERSE)
    type_of_traverse: float = choice("Q365", "way between the points", WAY, default=0)  # older programs lack it: lines

    def check(self, m: Machine) -> Iterator[ParameterFault]:
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
        return step_between(start, end, int(self.nr_of_repetitions), closed)

    def centre(self) -> tuple[float, float]:
        return self.center_in_1st_axis, self.center_in_2nd_axis

    def points(self) -> Floats:
        start, radius = math.radians(self.starting_angle), self.pitch_circle_diameter / 2
        return circle(self.centre(), radius, start, self.step(), int(self.nr_of_repetitions))

    def others(self, m: Machine, points: Floats) -> Iterator[Step]:
        """Straight, or along the pitch circle, as fast as each axis may go: an arc has a feed rate."""
        if self.type_of_traverse == 0:
            yield from super().others(m, points)
            return
        rapid = float(np.min(m.setup.limits.rapid))
        for k in range(len(points)):
            yield Go("to the level between the points", self.between)
            if self.pitch_circle_diameter:
                yield Turn("along the pitch circle", self.step(), feed=rapid, centre=self.centre())
            yield from self.work(last=k == len(points) - 1)


@CYCLES("CYCL DEF 221", "Cartesian pattern", runs="definition", source="7.3")
class CartesianPattern(PointPattern):
    """Runs the cycle defined last at points on lines, to and fro."""

    combines = PointPattern.combines | {"CYCL DEF 254"}

    starting_point_1st_axis: float = coordinate("Q225", "starting point along the first axis", example=15)
    starting_point_2nd_axis: float = coordinate("Q226", "starting point along the second axis", example=15)
    spacing_in_1st_axis: float = increment("Q237", "spacing along a line", example=10)
    spacing_in_2nd_axis: float = increment("Q238", "spacing of the lines", example=8)
    number_of_columns: float = number("Q242", "number of operations on a line", example=6)
    number_of_lines: float = number("Q243", "number of lines", example=4)
    angle_of_rotation: float = addresses.angle("Q224", "rotation about the starting point", example=15)
    clearance: float = addresses.clearance()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    move_to_clearance: float = choice("Q301", "level between the points", TRAVERSE)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        if m.cycle is not None and m.cycle.cycle.code == "CYCL DEF 254" and m.variables.get("Q367") == 0:
            yield "", "cannot be combined with CYCL DEF 254 and Q367 = 0"
        if (many := self.number_of_columns * self.number_of_lines) > MOST:
            yield "number_of_lines", f"makes {many:g} points, more than {MOST}"

    def points(self) -> Floats:
        start = self.starting_point_1st_axis, self.starting_point_2nd_axis
        spacing = self.spacing_in_1st_axis, self.spacing_in_2nd_axis
        count = int(self.number_of_columns), int(self.number_of_lines)
        return grid(start, spacing, count, math.radians(self.angle_of_rotation))
