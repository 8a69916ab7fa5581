"""Datums from a slot, a ridge, a pocket, an island, a bore, a boss, or a single touch (MNC 12.3 to 12.8, 12.11, 12.12)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mnclab.controls.mnc.probing import addresses
from mnclab.controls.mnc.probing.addresses import APPROACH, TOP
from mnclab.controls.mnc.probing.cycle import TURNS, MeasuringCycle, Moves
from mnclab.controls.mnc.probing.figures import box, middle, ring
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.probing.sequences import Aim, Approach, from_above, in_plane, numbers
from mnclab.machining.steps import Measure

CYCLES = CycleTable(addresses=addresses, runs="definition")
CENTRE = f"{APPROACH} between row x_new y_new {TOP}"


def middle_datum(c: MeasuringCycle, m: Machine) -> Moves:
    """The middle of a slot or a ridge."""
    a, k, centre = c.approach(m), int(c.axis) - 1, (c.x, c.y)
    found, width, contacts = yield from middle(a, centre, c.width, k, c.inside, m.programmed[2])
    yield Measure("width", width, c.width, touches=numbers(contacts))
    yield Measure(f"centre {'XY'[k]}", found, centre[k], touches=numbers(contacts))
    yield from c.finish(m, a, {k: (found, c.new_coordinate)})


@CYCLES(
    "G408", "Datum at the centre of a slot", source="MNC 12.3",
    takes=f"x y width axis {APPROACH} between row new_coordinate {TOP}",
)  # fmt: skip
class DatumInSlot(MeasuringCycle):
    """Two touches from within along an axis; the middle gets the coordinate U of that axis."""

    refused, entered = TURNS, ("width",)
    width: float = addresses.width(meaning="width of the slot, rather too small")
    moves = middle_datum


@CYCLES(
    "G409", "Datum at the centre of a ridge", source="MNC 12.4", takes=f"x y width axis {APPROACH} row new_coordinate {TOP}"
)  # fmt: skip
class DatumOnRidge(MeasuringCycle):
    """Two touches from outside along an axis, over the safe height (MNC-G409-NOP); the middle gets the coordinate U."""

    refused, inside, between = TURNS, False, 1.0
    width: float = addresses.width(meaning="width of the ridge, rather too large")
    moves = middle_datum


def box_datum(c: MeasuringCycle, m: Machine) -> Moves:
    """The centre of a rectangle."""
    a = c.approach(m)
    lengths = c.length_x, c.length_y
    found, contacts = yield from box(a, (c.x, c.y), lengths, c.inside, m.programmed[2])
    yield Measure("length X", found.length, c.length_x, touches=numbers(contacts[:2]))
    yield Measure("length Y", found.width, c.length_y, touches=numbers(contacts[2:]))
    yield from centre_datum(c, m, a, found.centre, numbers(contacts))


@CYCLES("G410", "Datum at the centre of a pocket", source="MNC 12.5", takes=f"x y length_x length_y {CENTRE}")
class DatumInPocket(MeasuringCycle):
    """Four touches of a rectangular pocket along the axes, whose lengths are given rather too small; its centre gets U and V."""

    refused, entered = TURNS, ("length_x", "length_y")
    moves = box_datum


@CYCLES("G411", "Datum at the centre of an island", source="MNC 12.6", takes=f"x y length_x length_y {CENTRE}")
class DatumOnIsland(MeasuringCycle):
    """Four touches of a rectangular island along the axes, whose lengths are given rather too large; its centre gets U and V."""

    refused, inside = TURNS, False
    moves = box_datum


def ring_datum(c: MeasuringCycle, m: Machine) -> Moves:
    """The centre of a circle."""
    a = c.approach(m)
    found, contacts = yield from ring(a, (c.x, c.y), c.diameter, c.inside, m.programmed[2])
    yield Measure("diameter", found.diameter, c.diameter, touches=numbers(contacts))
    yield from centre_datum(c, m, a, found.centre, numbers(contacts))


@CYCLES("G412", "Datum at the centre of a bore", source="MNC 12.7", takes=f"x y diameter {CENTRE}")
class DatumInBore(MeasuringCycle):
    """Four touches of a bore or circular pocket along the axes, given rather too small; its centre gets U and V."""

    refused, entered = TURNS, ("diameter",)
    moves = ring_datum


@CYCLES("G413", "Datum at the centre of a boss", source="MNC 12.8", takes=f"x y diameter {CENTRE}")
class DatumOnBoss(MeasuringCycle):
    """Four touches of a circular island along the axes, given rather too large; its centre gets U and V."""

    refused, inside = TURNS, False
    moves = ring_datum


@CYCLES("G417", "Datum along Z", source="MNC 12.11", takes="x y nominal_z clearance height row z_new apply")
class DatumAlongZ(MeasuringCycle):
    """One touch downwards, past the nominal point until the surface; it gets the coordinate R."""

    refused = TURNS
    x: float = addresses.x(meaning="X of the measuring point")
    y: float = addresses.y(meaning="Y of the measuring point")
    nominal_z: float = addresses.coordinate("Z", "nominal Z of the measuring point", 0)
    z_new: float = addresses.z_new(meaning="Z of the measured point in the new system")

    def low(self, a: Approach) -> Iterator[tuple[str, str]]:
        return self.below(a, self.nominal_z + a.gap)

    def moves(self, m: Machine) -> Moves:
        a = self.approach(m)
        contact = yield from from_above(a, self.x, self.y, self.nominal_z, m.programmed[2])
        z = contact.point[2] - a.ball
        yield Measure("Z", z, self.nominal_z, touches=(contact.number,))
        yield from self.finish(m, a, {2: (z, self.z_new)})


@CYCLES("G419", "Datum along X or Y", source="MNC 12.12", takes=f"x y axis direction {APPROACH} row new_coordinate apply")
class DatumAlongAxis(MeasuringCycle):
    """One touch of a side; the touched surface gets the coordinate U of the axis."""

    refused = TURNS
    x: float = addresses.x(meaning="X of the measuring point", example=0)
    y: float = addresses.y(meaning="Y of the measuring point")
    new_coordinate: float = addresses.new_coordinate(meaning="coordinate of the point in the new system")

    def moves(self, m: Machine) -> Moves:
        a, k, sense = self.approach(m), int(self.axis) - 1, self.direction
        way = (sense, 0.0) if k == 0 else (0.0, sense)
        (contact,) = yield from in_plane(a, [Aim(self.x, self.y, way)], m.programmed[2])
        found = contact.point[k] + sense * a.ball
        yield Measure("XY"[k], found, (self.x, self.y)[k], touches=(contact.number,))
        yield from self.finish(m, a, {k: (found, self.new_coordinate)})


def centre_datum(c: MeasuringCycle, m: Machine, a: Approach, found: Sequence[float], touches: Sequence[int]) -> Moves:
    """Both coordinates of a centre; two touches each."""
    yield Measure("centre X", found[0], c.x, touches=tuple(touches[:2]))
    yield Measure("centre Y", found[1], c.y, touches=tuple(touches[2:]))
    yield from c.finish(m, a, {0: (found[0], c.x_new), 1: (found[1], c.y_new)})
