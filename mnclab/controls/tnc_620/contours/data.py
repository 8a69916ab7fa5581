"""Cycles 14 and 20: the labels whose contours are machined, and depths, allowances and clearances (8.2, 8.4)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, NamedTuple, TypeVar

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, distance, increment, length, ratio
from mnclab.controls.tnc_620.cycles.planes import Fault
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.cycle import Cycle, CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.steps import Step, Write
from mnclab.running.cycles import unit_of

# Cycle 14: the labels whose contours are machined (8.2).

CYCLES = CycleTable()
MOST_LABELS = 12


class Labels(NamedTuple):
    """Names of labels, the program that they stand in, and what a length of 1 in its parameters is, mm."""

    names: tuple[str, ...]
    program: int
    unit: float


@CYCLES("CYCL DEF 14", "Contour geometry", runs="definition", source="8.2")
class ContourGeometry(Cycle):
    """The labels whose contours together are the pocket; no motion."""

    labels: tuple[float, ...] = addresses.number(
        "LBL", "label numbers of the contour", at_most=65535, several=True, note="1/2/3, up to 12", example=(1, 2)
    )

    def check(self, m: Machine) -> Iterator[Fault]:
        if m.recorded_only:
            yield "", "cannot stand in a contour that a cycle reads, nor in a program of contour definitions"
        if len(self.labels) > MOST_LABELS:
            yield "labels", f"must be at most {MOST_LABELS} labels, got {len(self.labels)}"
        for number in self.labels:
            if f"{number:g}" not in m.flow.program.labels:
                yield "labels", f"names label {number:g}, which does not exist"

    def moves(self, m: Machine) -> Iterator[Step]:
        names = tuple(f"{number:g}" for number in self.labels)
        yield Write("memory", Labels(names, m.program, m.variable_unit), "contour")


# Cycle 20: depths, allowances and clearances of the cycles 21 to 24 (8.4).

AnyCycle = TypeVar("AnyCycle", bound=Cycle)


@CYCLES("CYCL DEF 20", "Contour data", runs="definition", source="8.4")
class ContourData(Cycle):
    """Depths, allowances and the sense of milling for the cycles that follow; no motion."""

    depth: float = increment("Q1", "milling depth from the surface to the floor", example=-20)
    overlap: float = ratio("Q2", "path overlap factor", at_most=1.9999, example=1)
    side_allowance: float = increment("Q3", "finishing allowance for side", example=0.2)
    floor_allowance: float = increment("Q4", "finishing allowance for floor", example=0.1)
    surface: float = coordinate("Q5", "coordinate of the workpiece surface", example=0)
    clearance: float = distance("Q6", "set-up clearance", example=2)
    height: float = coordinate("Q7", "clearance height", example=50)
    corner: float = length("Q8", "radius at inside corners", example=0.5)
    sense: float = choice("Q9", "direction of machining", {-1: "up-cut milling", 1: "climb milling"})

    def check(self, m: Machine) -> Iterator[Fault]:
        if m.recorded_only:
            yield "", "cannot stand in a contour that a cycle reads, nor in a program of contour definitions"
        if abs(self.depth) < self.floor_allowance:
            yield "depth", f"must be at least Q4 = {self.floor_allowance:g} deep, got {self.depth:g}"
        if self.height < self.surface + self.clearance:
            yield "height", f"must not lie below Q5 + Q6 = {self.surface + self.clearance:g}, got {self.height:g}"

    def moves(self, m: Machine) -> Iterator[Step]:
        """Keep the data; they are read again when a cycle is called, since Q parameters may have changed."""
        yield Write("memory", self, "contour_data")

    @property
    def down(self) -> int:
        """-1 where the cycles work downwards, as at a depth of 0, +1 upwards."""
        return 1 if self.depth > 0 else -1

    @property
    def above(self) -> float:
        """The set-up clearance as a height."""
        return self.surface + self.clearance

    @property
    def floor(self) -> float:
        """The floor after finishing."""
        return self.surface + self.depth

    def climb(self, m: Machine) -> bool:
        """Whether walls are climbed on the machine: no mirror image changes the sense of milling (8.3)."""
        return self.sense * m.orientation > 0


def contour_data(m: Machine) -> ContourData:
    """The data of cycle 20 with the Q parameters as they stand now."""
    data = memory(m).contour_data
    assert data is not None
    return as_they_stand(m, data)


def as_they_stand(m: Machine, kept: AnyCycle) -> AnyCycle:
    """A cycle that was kept, with the Q parameters as they stand now."""
    now: dict[str, Any] = {
        p.name: m.variables[p.address] * unit_of(m, p) for p in kept.parameters() if p.address in m.variables
    }
    return replace(kept, **now)


def prepared(m: Machine) -> Iterator[Fault]:
    """What the cycles 21 to 24 need before them: a contour and its data."""
    if memory(m).contour is None:
        yield "", "needs a contour: CYCL DEF 14 comes before it"
    if memory(m).contour_data is None:
        yield "", "needs its contour data: CYCL DEF 20 comes before it"


def some_infeeds(c: Cycle, m: Machine) -> Iterator[Fault]:
    """An `infeed` of 0, or one that makes more levels than anybody would wait for; the data are there."""
    infeed = abs(getattr(c, "infeed", 0.0))
    if infeed == 0:
        yield "infeed", "must not be 0"
    yield from too_many("infeed", lambda: infeeds(0.0, contour_data(m).depth, infeed))
