"""Presetting cycles (TNC 620, chapter 15): touches say where the datum lies."""

from __future__ import annotations

from mnclab.controls.tnc_620.cycles.addresses import coordinate
from mnclab.controls.tnc_620.probing import addresses
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, lengths
from mnclab.controls.tnc_620.probing.transfer import save
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.probing.sequences import from_above, in_one_axis
from mnclab.machining.steps import Measure

CYCLES = CycleTable()


@CYCLES("TCH PROBE 417", "Preset in the touch probe axis", runs="definition", source="15.11")
class PresetInProbeAxis(ProbingCycle):
    """One touch downwards; the touched point gets the coordinate Q333."""

    x: float = addresses.first_x()
    y: float = addresses.first_y()
    z: float = coordinate("Q294", "touch point, touch probe axis", example=0)
    clearance: float = addresses.clearance()
    height: float = addresses.height()
    row: float = addresses.row()
    datum: float = addresses.datum_z()
    transfer: float = addresses.transfer()

    def moves(self, m: Machine) -> Moves:
        a = self.approach(m)
        contact = yield from from_above(a, self.x, self.y, self.z, m.programmed[2])
        z = contact.point[2] - a.ball
        yield Measure("Z", z, self.z, touches=(contact.number,))
        yield from lengths(m, Q160=z)
        yield from save(m, {2: (z, self.datum)}, self.row, self.transfer)


@CYCLES("TCH PROBE 419", "Preset in one axis", runs="definition", source="15.13")
class PresetInOneAxis(ProbingCycle):
    """One touch along an axis; the touched point gets the coordinate Q333."""

    x: float = addresses.first_x()
    y: float = addresses.first_y()
    level: float = addresses.level()
    clearance: float = addresses.clearance()
    height: float = addresses.height()
    axis: float = addresses.axis(choices=addresses.AXES)
    direction: float = addresses.direction()
    row: float = addresses.row()
    datum: float = addresses.datum_z(meaning="new coordinate of the touched point")
    transfer: float = addresses.transfer()

    def moves(self, m: Machine) -> Moves:
        a, k = self.approach(m), int(self.axis) - 1
        (contact,) = yield from in_one_axis(a, k, self.direction, [(self.x, self.y, self.level)], m.programmed[2])
        found = contact.point[k] + self.direction * a.ball
        yield Measure("XYZ"[k], found, (self.x, self.y, self.level)[k], touches=(contact.number,))
        yield from save(m, {k: (found, self.datum)}, self.row, self.transfer)
