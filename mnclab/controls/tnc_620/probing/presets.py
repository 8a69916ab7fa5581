"""Presetting cycles (TNC 620, chapter 15): a touch says where the datum lies.

Programmed positions are those of the south pole of the ball; the nominal point of a touch in the plane and its measuring
height are those of the ball's centre.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from typing import Any

from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, count, distance
from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.controls.tnc_620.cycles.planes import in_program_coordinates
from mnclab.controls.tnc_620.state import active_preset
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.machining.steps import Go, Step, Touch, Write

CYCLES = CycleTable()
TRANSFER: dict[float, str] = {-1: "do not use", 0: "datum table", 1: "preset table"}


@CYCLES("TCH PROBE 419", "Preset in one axis", runs="definition", source="15.13")
class PresetInOneAxis(Cycle):
    """One touch along an axis; the touched point gets the coordinate Q333."""

    about = in_program_coordinates
    x: float = coordinate("Q263", "first touch point, reference axis", example=20)
    y: float = coordinate("Q264", "first touch point, minor axis", example=10)
    z: float = coordinate("Q261", "measuring height of the ball's centre", example=-5)
    clearance: float = distance("Q320", "set-up clearance", example=2)
    height: float = coordinate("Q260", "clearance height", example=20)
    axis: float = choice("Q272", "measuring axis", {1: "reference axis", 2: "minor axis", 3: "touch probe axis"})
    direction: float = choice("Q267", "traverse direction", {-1: "negative", 1: "positive"})
    row: float = count("Q305", "number in table", at_most=9999, example=0)
    datum: float = coordinate("Q333", "new coordinate of the touched point", default=0)
    transfer: float = choice("Q303", "measured value transfer", TRANSFER, example=1)

    def check(self, m: Machine) -> Iterator[Fault]:
        if not m.tool.number:
            yield "", "needs a tool call before it, which names the probe and its axis"
        if active := [name for name, _ in m.frames if name != "preset" and name in m.frames]:
            yield "", f"cannot run while a {active[0]} is active"
        if self.transfer == -1 and self.row:
            yield "transfer", "-1 does not say where row Q305 is: choose 0 (datum table) or 1 (preset table)"

    def moves(self, m: Machine) -> Generator[Step, Any, None]:
        k, ball, probe = int(self.axis) - 1, m.radius, m.setup.probe
        start = [self.x, self.y, self.z]  # of the ball's centre
        start[k] -= self.direction * (probe.clearance + self.clearance + ball)
        pole = start[2] - ball
        if m.programmed[2] < self.height:
            yield Go("to the clearance height", self.height)
        yield Go("over the starting point", x=start[0], y=start[1])
        yield Go("to the starting point", pole)
        x, y, z = (place + self.direction * probe.reach * (axis == k) for axis, place in enumerate((*start[:2], pole)))
        contact = yield Touch("touch", x, y, z, probe.feed, ball)
        yield Go("back", pole, x=start[0], y=start[1])
        yield Go("to the clearance height", self.height)
        yield from self.preset(m, k, contact.point[k] + self.direction * ball)

    def preset(self, m: Machine, k: int, found: float) -> Iterator[Step]:
        """Write the row, and activate it where it is row 0 or the active one (TNC 15.1)."""
        axis, shift, number, active = "xyz"[k], found - self.datum, int(self.row), active_preset(m)
        if self.transfer == 0 and number:
            row = m.tables.datums.get(number, Datum())
            yield Write("datums", row._replace(**{axis: shift}), number)
            return
        before = m.tables.presets.get(active, Datum())
        row = before if number in (0, active) else m.tables.presets.get(number, Datum())
        preset = row._replace(**{axis: before[k] + found - self.datum})
        yield Write("presets", preset, number)
        if number in (0, active):
            yield Write("memory", number, "preset")
            yield Write("datum", preset, "preset")
