"""Presets between holes: the middle of a bolt hole circle, or where the lines through four holes cross (TNC 620, 15.10, 15.12).

The cycles know no size of the holes: each is touched from its nominal centre.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from mnclab.controls.tnc_620.cycles.addresses import angle, coordinate
from mnclab.controls.tnc_620.probing import addresses
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, lengths, measured, needed
from mnclab.controls.tnc_620.probing.transfer import finish
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.probing.fits import centre_of_four, circle
from mnclab.machining.probing.found import Circle
from mnclab.machining.probing.sequences import Approach, Pair, Steps, from_centre
from mnclab.machining.probing.sketches import sketch

CYCLES = CycleTable()


@CYCLES("TCH PROBE 416", "Preset at the centre of a bolt hole circle", runs="definition", source="15.10")
class PresetInBoltCircle(ProbingCycle):
    """Four touches of each of three holes; the middle of their circle gets the coordinates Q331 and Q332."""

    centre_x: float = coordinate("Q273", "center, reference axis", example=50)
    centre_y: float = coordinate("Q274", "center, minor axis", example=30)
    diameter: float = addresses.diameter(meaning="nominal diameter of the bolt hole circle", example=40)
    angle_hole_1: float = angle("Q291", "angle of hole 1", example=90)
    angle_hole_2: float = angle("Q292", "angle of hole 2", example=180)
    angle_hole_3: float = angle("Q293", "angle of hole 3", example=270)
    level: float = addresses.level()
    height: float = addresses.height()
    row: float = addresses.row()
    datum_x: float = addresses.datum_x()
    datum_y: float = addresses.datum_y()
    transfer: float = addresses.transfer()
    probe_z: float = addresses.probe_z()
    top_x: float = addresses.top_x()
    top_y: float = addresses.top_y()
    top_z: float = addresses.top_z()
    datum_z: float = addresses.datum_z()
    clearance: float = addresses.clearance()

    def moves(self, m: Machine) -> Moves:
        a, radius = self.approach(m), self.diameter / 2
        angles = [math.radians(each) for each in (self.angle_hole_1, self.angle_hole_2, self.angle_hole_3)]
        places = [(self.centre_x + radius * math.cos(t), self.centre_y + radius * math.sin(t)) for t in angles]
        holes, contacts = yield from each_hole(self, m, a, places)
        found = needed(circle, holes, m=m, code=self.code)
        sizes = {"diameter": (found.diameter, self.diameter)}
        yield from measured(contacts, X=(found.x, self.centre_x), Y=(found.y, self.centre_y), **sizes)
        yield sketch(Circle(self.centre_x, self.centre_y, radius), found, self.level)
        yield from lengths(m, Q151=found.x, Q152=found.y, Q153=found.diameter)
        yield from finish(self, m, a, {0: (found.x, self.datum_x), 1: (found.y, self.datum_y)})


@CYCLES("TCH PROBE 418", "Preset between four holes", runs="definition", source="15.12")
class PresetBetweenHoles(ProbingCycle):
    """Four touches of each of four holes; where the lines 1-3 and 2-4 cross gets the coordinates Q331 and Q332."""

    first_center_axis_1: float = coordinate("Q268", "hole 1, reference axis", example=20)
    first_center_axis_2: float = coordinate("Q269", "hole 1, minor axis", example=20)
    second_center_axis_1: float = coordinate("Q270", "hole 2, reference axis", example=80)
    second_center_axis_2: float = coordinate("Q271", "hole 2, minor axis", example=20)
    third_center_axis_1: float = coordinate("Q316", "hole 3, reference axis", example=80)
    third_center_axis_2: float = coordinate("Q317", "hole 3, minor axis", example=60)
    fourth_center_axis_1: float = coordinate("Q318", "hole 4, reference axis", example=20)
    fourth_center_axis_2: float = coordinate("Q319", "hole 4, minor axis", example=60)
    level: float = addresses.level()
    height: float = addresses.height()
    row: float = addresses.row()
    datum_x: float = addresses.datum_x()
    datum_y: float = addresses.datum_y()
    transfer: float = addresses.transfer()
    probe_z: float = addresses.probe_z()
    top_x: float = addresses.top_x()
    top_y: float = addresses.top_y()
    top_z: float = addresses.top_z()
    datum_z: float = addresses.datum_z()

    def moves(self, m: Machine) -> Moves:
        a = self.approach(m)
        names = ("first", "second", "third", "fourth")
        places = [(getattr(self, f"{name}_center_axis_1"), getattr(self, f"{name}_center_axis_2")) for name in names]
        nominal = needed(centre_of_four, places, m=m, code=self.code)
        holes, contacts = yield from each_hole(self, m, a, places)
        found = needed(centre_of_four, holes, m=m, code=self.code)
        yield from measured(contacts, X=(found.x, nominal.x), Y=(found.y, nominal.y))
        yield sketch([*places, places[0]], [*holes, holes[0]], self.level)
        yield from lengths(m, Q151=found.x, Q152=found.y)
        yield from finish(self, m, a, {0: (found.x, self.datum_x), 1: (found.y, self.datum_y)})


def each_hole(c: ProbingCycle, m: Machine, a: Approach, places: Sequence[Pair]) -> Steps:
    """The centres of holes, touched one after the other over the clearance height, and all contacts."""
    holes, contacts = [], []
    for k, place in enumerate(places):
        touched = yield from from_centre(a, place, a.height if k else m.programmed[2])
        contacts += touched
        holes.append(needed(circle, [each.point[:2] for each in touched], "power", m=m, code=c.code).centre)
    return holes, contacts
