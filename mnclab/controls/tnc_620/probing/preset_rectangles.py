"""Presets in the middle of a slot, a ridge, a pocket or a stud with straight walls (TNC 620, 15.2 to 15.5)."""

from __future__ import annotations

from dataclasses import dataclass

from mnclab.controls.tnc_620.cycles.addresses import coordinate, distance
from mnclab.controls.tnc_620.probing import addresses
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, lengths, measured, needed, numbers
from mnclab.controls.tnc_620.probing.transfer import finish
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.probing.fits import rectangle, width
from mnclab.machining.probing.found import Rectangle, Width
from mnclab.machining.probing.sequences import ROUND, sides
from mnclab.machining.probing.sketches import sketch

CYCLES = CycleTable()


@CYCLES("TCH PROBE 408", "Preset at a slot centre", runs="definition", source="15.2")
class PresetInSlot(ProbingCycle):
    """Two touches from within, along an axis; the middle gets the coordinate Q405 of that axis."""

    centre_x: float = addresses.center_x()
    centre_y: float = addresses.center_y()
    width: float = distance("Q311", "slot width", example=20)
    axis: float = addresses.axis()
    level: float = addresses.level()
    clearance: float = addresses.clearance()
    height: float = addresses.height()
    move_to_clearance: float = addresses.move_to_clearance()
    row: float = addresses.row()
    datum: float = coordinate("Q405", "new coordinate in the measuring axis", default=0)
    transfer: float = addresses.transfer(choices=addresses.TABLES)
    probe_z: float = addresses.probe_z()
    top_x: float = addresses.top_x()
    top_y: float = addresses.top_y()
    top_z: float = addresses.top_z()
    datum_z: float = addresses.datum_z()

    def moves(self, m: Machine) -> Moves:
        return middle(self, m, inside=True)


@CYCLES("TCH PROBE 409", "Preset at a ridge centre", runs="definition", source="15.3")
class PresetOnRidge(ProbingCycle):
    """Two touches from outside, along an axis, over the clearance height; the middle gets the coordinate Q405."""

    centre_x: float = addresses.center_x()
    centre_y: float = addresses.center_y()
    width: float = distance("Q311", "ridge width", example=20)
    axis: float = addresses.axis()
    level: float = addresses.level()
    clearance: float = addresses.clearance()
    height: float = addresses.height()
    row: float = addresses.row()
    datum: float = coordinate("Q405", "new coordinate in the measuring axis", default=0)
    transfer: float = addresses.transfer(choices=addresses.TABLES)
    probe_z: float = addresses.probe_z()
    top_x: float = addresses.top_x()
    top_y: float = addresses.top_y()
    top_z: float = addresses.top_z()
    datum_z: float = addresses.datum_z()
    move_to_clearance = 1.0

    def moves(self, m: Machine) -> Moves:
        return middle(self, m, inside=False)


def middle(c: PresetInSlot | PresetOnRidge, m: Machine, inside: bool) -> Moves:
    """Touch both walls; the middle between them is the preset of one axis."""
    a, k, centre, half = c.approach(m), int(c.axis) - 1, (c.centre_x, c.centre_y), c.width / 2
    contacts = yield from sides(a, centre, (half, half), (k, k + 2), inside, m.programmed[2])
    balls = needed(width, *(each.point[:2] for each in contacts), 90 * k, m=m, code=c.code)
    found = balls.grown(a.ball if inside else -a.ball)
    at = found.centre[k]
    yield from measured(contacts, **{"XY"[k]: (at, centre[k]), "width": (found.width, c.width)})
    yield sketch(Width(*centre, c.width), found, c.level, numbers(contacts), 90 * k)
    yield from lengths(m, Q157=at, Q166=found.width)
    yield from finish(c, m, a, {k: (at, c.datum)})


@dataclass(frozen=True)
class Rectangular:
    """The parameters of 410 and 411."""

    centre_x: float = addresses.center_x()
    centre_y: float = addresses.center_y()
    length: float = distance("Q323", "length along the reference axis", example=40)
    width: float = distance("Q324", "length along the minor axis", example=20)
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


@CYCLES("TCH PROBE 410", "Preset from inside a rectangle", runs="definition", source="15.4")
class PresetInRectangle(Rectangular, ProbingCycle):
    """Four touches from within a pocket; its middle gets the coordinates Q331 and Q332."""

    def moves(self, m: Machine) -> Moves:
        return four_sides(self, m, inside=True)


@CYCLES("TCH PROBE 411", "Preset from outside a rectangle", runs="definition", source="15.5")
class PresetOnRectangle(Rectangular, ProbingCycle):
    """Four touches of a stud from outside; its middle gets the coordinates Q331 and Q332."""

    def moves(self, m: Machine) -> Moves:
        return four_sides(self, m, inside=False)


def four_sides(c: PresetInRectangle | PresetOnRectangle, m: Machine, inside: bool) -> Moves:
    """Touch all sides; the middle is the preset of both axes."""
    a, centre, half = c.approach(m), (c.centre_x, c.centre_y), (c.length / 2, c.width / 2)
    contacts = yield from sides(a, centre, half, ROUND, inside, m.programmed[2])
    right, back, left, front = (each.point[:2] for each in contacts)
    found = needed(rectangle, [right, left, back, front], m=m, code=c.code).grown(a.ball if inside else -a.ball)
    sizes = {"length": (found.length, c.length), "width": (found.width, c.width)}
    yield from measured(contacts, X=(found.x, c.centre_x), Y=(found.y, c.centre_y), **sizes)
    yield sketch(Rectangle(*centre, c.length, c.width), found, c.level, numbers(contacts))
    yield from lengths(m, Q151=found.x, Q152=found.y, Q154=found.length, Q155=found.width)
    yield from finish(c, m, a, {0: (found.x, c.datum_x), 1: (found.y, c.datum_y)})
