"""Cycle 270: how contour trains are approached and left, and on which side the tool runs (8.11)."""

from __future__ import annotations

import math
from collections.abc import Iterator

from mnclab.controls.tnc_620.cycles.addresses import choice, length
from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Step, Write
from mnclab.path.leads import Lead

CYCLES = CycleTable()
APPROACH: dict[float, str] = {1: "tangential, on an arc", 2: "tangential, on a line", 3: "at a right angle"}
SIDES: dict[float, str] = {0: "R0, on the contour", 1: "RL, to the left", 2: "RR, to the right"}


@CYCLES("CYCL DEF 270", "Contour train data", runs="definition", source="8.11")
class TrainData(Cycle):
    """Approach, departure and side for the cycles 25 and 276 that follow; no motion."""

    approach: float = choice("Q390", "type of approach", APPROACH, example=1)
    compensation: float = choice("Q391", "radius compensation", SIDES, example=1)
    radius: float = length("Q392", "radius of the arc", note="where Q390 is 1", example=3)
    angle: float = param("Q393", "centre angle of the arc", "deg", modal=True, at_least=0, at_most=99999.9999, example=45)
    distance: float = length("Q394", "distance of the auxiliary point", note="where Q390 is 2 or 3", example=2)

    def contradictions(self) -> Iterator[Fault]:
        if self.approach == 1 and self.radius == 0:
            yield "radius", "must be greater than 0 for an approach on an arc, got 0"
        if self.approach == 1 and not 0 < self.angle <= 360:
            yield "angle", f"must be greater than 0 and at most 360, got {self.angle:g}"

    def moves(self, m: Machine) -> Iterator[Step]:
        """Keep the data; they are read again when a cycle is called, since Q parameters may have changed."""
        yield Write("memory", self, "train_data")

    @property
    def side(self) -> int:
        """+1 left, -1 right, 0 on the contour."""
        return {0: 0, 1: 1, 2: -1}[int(self.compensation)]

    def lead(self, m: Machine) -> Lead | None:
        """How the tool gets to the contour; without a side it comes from the left (none for a line of no length)."""
        form = {1: "CT", 2: "LT", 3: "LN"}[int(self.approach)]
        if form != "CT" and not self.distance:
            return None
        return Lead(form, m.step, self.side or 1, self.distance, self.radius, math.radians(self.angle))
