"""Presets in the middle of a slot, ridge, pocket, stud or hole, or between holes (TNC 620, 15.2 to 15.7, 15.10, 15.12)."""

from __future__ import annotations

from collections.abc import Sequence

from mnclab.controls.tnc_620.cycles.addresses import coordinate, distance
from mnclab.controls.tnc_620.probing import addresses
from mnclab.controls.tnc_620.probing.addresses import CENTRE, CENTRES, HEIGHTS, ROUND, TOP
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, lengths, measured, needed
from mnclab.controls.tnc_620.probing.figures import bolt_circle, box, holes, ring
from mnclab.controls.tnc_620.probing.transfer import finish
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.touching import Contact
from mnclab.machining.probing.fits import centre_of_four, width
from mnclab.machining.probing.found import Width
from mnclab.machining.probing.sequences import Approach, Pair, sides
from mnclab.machining.probing.sketches import sketch

CYCLES = CycleTable(addresses=addresses, runs="definition")
SLOT = f"centre_x centre_y width axis {HEIGHTS}"
BOX = f"centre_x centre_y length width {HEIGHTS} move_to_clearance {CENTRE}"
CIRCLE = f"centre_x centre_y {ROUND} {CENTRE} points traverse"


def middle(c: ProbingCycle, m: Machine) -> Moves:
    """Both walls are touched; the middle between them is the preset of one axis."""
    a, k, centre, half = c.approach(m), int(c.axis) - 1, (c.centre_x, c.centre_y), c.width / 2
    contacts = yield from sides(a, centre, (half, half), (k, k + 2), c.inside, m.programmed[2])
    balls = needed(width, *(each.point[:2] for each in contacts), 90 * k, m=m, code=c.code)
    found = balls.grown(a.ball if c.inside else -a.ball)
    at = found.centre[k]
    yield from measured(contacts, **{"XY"[k]: (at, centre[k]), "width": (found.width, c.width)})
    yield sketch(Width(*centre, c.width), found, c.level, contacts, 90 * k)
    yield from lengths(m, Q157=at, Q166=found.width)
    yield from finish(c, m, a, {k: (at, c.datum)})


@CYCLES("TCH PROBE 408", "Preset at a slot centre", source="15.2", takes=f"{SLOT} move_to_clearance row datum {TOP}")
class PresetInSlot(ProbingCycle):
    """Two touches from within, along an axis; the middle gets the coordinate Q405 of that axis."""

    width: float = distance("Q311", "slot width", example=20)
    transfer: float = addresses.transfer(choices=addresses.TABLES)
    moves = middle


@CYCLES("TCH PROBE 409", "Preset at a ridge centre", source="15.3", takes=f"{SLOT} row datum {TOP}")
class PresetOnRidge(ProbingCycle):
    """Two touches from outside, along an axis, over the clearance height; the middle gets the coordinate Q405."""

    inside, move_to_clearance = False, 1.0
    width: float = distance("Q311", "ridge width", example=20)
    transfer: float = addresses.transfer(choices=addresses.TABLES)
    moves = middle


def box_middle(c: ProbingCycle, m: Machine) -> Moves:
    """All sides are touched; the middle is the preset of both axes."""
    a, centre = c.approach(m), (c.centre_x, c.centre_y)
    found, contacts = yield from box(c, m, a, centre)
    sizes = {"length": (found.length, c.length), "width": (found.width, c.width)}
    results = {"Q154": found.length, "Q155": found.width}
    yield from preset(c, m, a, found.centre, centre, contacts, sizes, results)


@CYCLES("TCH PROBE 410", "Preset from inside a rectangle", source="15.4", takes=BOX)
class PresetInRectangle(ProbingCycle):
    """Four touches from within a pocket; its middle gets the coordinates Q331 and Q332."""

    length: float = distance("Q323", "length along the reference axis", example=40)
    width: float = distance("Q324", "length along the minor axis", example=20)
    moves = box_middle


@CYCLES("TCH PROBE 411", "Preset from outside a rectangle", source="15.5", takes=BOX)
class PresetOnRectangle(ProbingCycle):
    """Four touches of a stud from outside; its middle gets the coordinates Q331 and Q332."""

    inside = False
    length: float = distance("Q323", "length along the reference axis", example=40)
    width: float = distance("Q324", "length along the minor axis", example=20)
    moves = box_middle


def ring_middle(c: ProbingCycle, m: Machine) -> Moves:
    """It is touched all around; the middle is the preset of both axes."""
    a, centre = c.approach(m), (c.centre_x, c.centre_y)
    found, contacts = yield from ring(c, m, a, centre)
    size = {"diameter": (found.diameter, c.diameter)}
    yield from preset(c, m, a, found.centre, centre, contacts, size, {"Q153": found.diameter})


@CYCLES("TCH PROBE 412", "Preset from inside a circle", source="15.6", takes=CIRCLE)
class PresetInCircle(ProbingCycle):
    """Three or four touches from within a hole; its middle gets the coordinates Q331 and Q332."""

    moves = ring_middle


@CYCLES("TCH PROBE 413", "Preset from outside a circle", source="15.7", takes=CIRCLE)
class PresetOnCircle(ProbingCycle):
    """Three or four touches of a round stud from outside; its middle gets the coordinates Q331 and Q332."""

    inside = False
    moves = ring_middle


@CYCLES(
    "TCH PROBE 416", "Preset at the centre of a bolt hole circle", source="15.10",
    takes=f"middle_x middle_y diameter first_angle second_angle third_angle level height {CENTRE} clearance",
)  # fmt: skip
class PresetInBoltCircle(ProbingCycle):
    """Four touches of each of three holes from their nominal centres; the middle of their circle gets Q331 and Q332."""

    diameter: float = addresses.diameter(meaning="nominal diameter of the bolt hole circle", example=40)

    def moves(self, m: Machine) -> Moves:
        a = self.approach(m)
        found, contacts = yield from bolt_circle(self, m, a)
        size = {"diameter": (found.diameter, self.diameter)}
        yield from preset(self, m, a, found.centre, (self.middle_x, self.middle_y), contacts, size, {"Q153": found.diameter})


@CYCLES(
    "TCH PROBE 418", "Preset between four holes", source="15.12",
    takes=f"{CENTRES} third_center_axis_1 third_center_axis_2 fourth_center_axis_1 fourth_center_axis_2 level height {CENTRE}",
)  # fmt: skip
class PresetBetweenHoles(ProbingCycle):
    """Four touches of each of four holes from their nominal centres; where the lines 1-3 and 2-4 cross gets Q331 and Q332."""

    third_center_axis_1: float = coordinate("Q316", "third center, reference axis", example=80)
    third_center_axis_2: float = coordinate("Q317", "third center, minor axis", example=60)
    fourth_center_axis_1: float = coordinate("Q318", "fourth center, reference axis", example=20)
    fourth_center_axis_2: float = coordinate("Q319", "fourth center, minor axis", example=60)

    def moves(self, m: Machine) -> Moves:
        a, names = self.approach(m), ("first", "second", "third", "fourth")
        places = [(getattr(self, f"{name}_center_axis_1"), getattr(self, f"{name}_center_axis_2")) for name in names]
        nominal = needed(centre_of_four, places, m=m, code=self.code)
        centres, contacts = yield from holes(self, m, a, places)
        found = needed(centre_of_four, centres, m=m, code=self.code)
        yield sketch([*places, places[0]], [*centres, centres[0]], self.level)
        yield from preset(self, m, a, found.centre, nominal.centre, contacts, {}, {})


def preset(
    c: ProbingCycle, m: Machine, a: Approach, found: Pair, nominal: Pair, contacts: Sequence[Contact],
    sizes: dict[str, Pair], results: dict[str, float],
) -> Moves:  # fmt: skip
    """The place that was found, and `sizes` (measured and nominal) by name: the record, Q151, Q152 and further results."""
    yield from measured(contacts, X=(found[0], nominal[0]), Y=(found[1], nominal[1]), **sizes)
    yield from lengths(m, Q151=found[0], Q152=found[1], **results)
    yield from finish(c, m, a, {0: (found[0], c.datum_x), 1: (found[1], c.datum_y)})
