"""Presets in the middle of a hole or a round stud (TNC 620, 15.6 and 15.7)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.controls.tnc_620.probing import addresses
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, lengths, measured, needed, numbers, too_fine
from mnclab.controls.tnc_620.probing.transfer import finish
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.probing.fits import circle
from mnclab.machining.probing.found import Circle
from mnclab.machining.probing.sequences import around
from mnclab.machining.probing.sketches import sketch

CYCLES = CycleTable()


@dataclass(frozen=True)
class Round:
    """The parameters of 412 and 413."""

    centre_x: float = addresses.center_x()
    centre_y: float = addresses.center_y()
    diameter: float = addresses.diameter()
    starting_angle: float = addresses.starting_angle()
    stepping_angle: float = addresses.stepping_angle()
    level: float = addresses.level()
    clearance: float = addresses.clearance()
    height: float = addresses.height()
    move_to_clearance: float = addresses.move_to_clearance()
    row: float = addresses.row()
    datum_x: float = addresses.datum_x()
    datum_y: float = addresses.datum_y()
    transfer: float = addresses.transfer()
    probe_z: float = addresses.probe_z()
    top_x: float = addresses.top_x()
    top_y: float = addresses.top_y()
    top_z: float = addresses.top_z()
    datum_z: float = addresses.datum_z()
    points: float = addresses.points()
    traverse: float = addresses.traverse()


@CYCLES("TCH PROBE 412", "Preset from inside a circle", runs="definition", source="15.6")
class PresetInCircle(Round, ProbingCycle):
    """Three or four touches from within a hole; its middle gets the coordinates Q331 and Q332."""

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        yield from too_fine(self.stepping_angle)

    def moves(self, m: Machine) -> Moves:
        return all_around(self, m, inside=True)


@CYCLES("TCH PROBE 413", "Preset from outside a circle", runs="definition", source="15.7")
class PresetOnCircle(Round, ProbingCycle):
    """Three or four touches of a round stud from outside; its middle gets the coordinates Q331 and Q332."""

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        yield from too_fine(self.stepping_angle)

    def moves(self, m: Machine) -> Moves:
        return all_around(self, m, inside=False)


def all_around(c: PresetInCircle | PresetOnCircle, m: Machine, inside: bool) -> Moves:
    """Touch all around; the middle is the preset of both axes."""
    a, centre, radius = c.approach(m), (c.centre_x, c.centre_y), c.diameter / 2
    angles = c.starting_angle, c.stepping_angle, int(c.points)
    contacts = yield from around(a, centre, radius, *angles, inside, m.programmed[2], c.traverse == 1)
    balls = needed(circle, [each.point[:2] for each in contacts], "power", m=m, code=c.code)
    found = balls.grown(a.ball if inside else -a.ball)
    yield from measured(contacts, X=(found.x, c.centre_x), Y=(found.y, c.centre_y), diameter=(found.diameter, c.diameter))
    yield sketch(Circle(*centre, radius), found, c.level, numbers(contacts))
    yield from lengths(m, Q151=found.x, Q152=found.y, Q153=found.diameter)
    yield from finish(c, m, a, {0: (found.x, c.datum_x), 1: (found.y, c.datum_y)})
