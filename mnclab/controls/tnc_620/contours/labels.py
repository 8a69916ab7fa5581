"""Cycle 14: the labels whose contours are machined (8.2)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Step, Write

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
