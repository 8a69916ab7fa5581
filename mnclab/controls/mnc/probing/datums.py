"""Datums from a slot, a ridge, a pocket, an island, a bore, a boss, or a single touch (MNC 12.3 to 12.8, 12.11, 12.12)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import ClassVar

from mnclab.controls.mnc.probing import addresses
from mnclab.controls.mnc.probing.cycle import TURNS, MeasuringCycle, Moves, numbers
from mnclab.controls.mnc.probing.figures import box, middle, ring
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.probing.sequences import Aim, Approach, Pair, from_above, in_plane
from mnclab.machining.steps import Measure

CYCLES = CycleTable()


@CYCLES("G408", "Datum at the centre of a slot", runs="definition", source="MNC 12.3")
class DatumInSlot(MeasuringCycle):
    """Two touches from within along an axis; the middle gets the coordinate U of that axis."""

    refused: ClassVar[tuple[str, ...]] = TURNS

    x: float = addresses.coordinate("X", "X of the centre of the slot", 50)
    y: float = addresses.coordinate("Y", "Y of the centre of the slot", 30)
    width: float = addresses.width(meaning="width of the slot, rather too small")
    axis: float = addresses.axis()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    between: float = addresses.between()
    row: float = addresses.row()
    new_coordinate: float = addresses.new("U")
    apply: float = addresses.apply()
    probe_z: float = addresses.probe_z()
    z_probe_x: float | None = addresses.z_probe_x()
    z_probe_y: float | None = addresses.z_probe_y()
    z_probe_z: float | None = addresses.z_probe_z()
    z_new: float = addresses.z_new()

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        yield from self.fits(m, width=self.width)

    def moves(self, m: Machine) -> Moves:
        return middle_datum(self, m, (self.x, self.y), self.width, self.axis, self.new_coordinate, inside=True)


@CYCLES("G409", "Datum at the centre of a ridge", runs="definition", source="MNC 12.4")
class DatumOnRidge(MeasuringCycle):
    """Two touches from outside along an axis, over the safe height; the middle gets the coordinate U of that axis."""

    refused: ClassVar[tuple[str, ...]] = TURNS

    x: float = addresses.coordinate("X", "X of the centre of the ridge", 50)
    y: float = addresses.coordinate("Y", "Y of the centre of the ridge", 30)
    width: float = addresses.width(meaning="width of the ridge, rather too large")
    axis: float = addresses.axis()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    row: float = addresses.row()
    new_coordinate: float = addresses.new("U")
    apply: float = addresses.apply()
    probe_z: float = addresses.probe_z()
    z_probe_x: float | None = addresses.z_probe_x()
    z_probe_y: float | None = addresses.z_probe_y()
    z_probe_z: float | None = addresses.z_probe_z()
    z_new: float = addresses.z_new()

    def moves(self, m: Machine) -> Moves:
        return middle_datum(self, m, (self.x, self.y), self.width, self.axis, self.new_coordinate, inside=False)


@CYCLES("G410", "Datum at the centre of a pocket", runs="definition", source="MNC 12.5")
class DatumInPocket(MeasuringCycle):
    """Four touches of a rectangular pocket along the axes; its centre gets the coordinates U and V."""

    refused: ClassVar[tuple[str, ...]] = TURNS

    x: float = addresses.coordinate("X", "X of the centre of the pocket", 50)
    y: float = addresses.coordinate("Y", "Y of the centre of the pocket", 30)
    length_x: float = addresses.length_x()
    length_y: float = addresses.length_y()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    between: float = addresses.between()
    row: float = addresses.row()
    x_new: float = addresses.new_x()
    y_new: float = addresses.new_y()
    apply: float = addresses.apply()
    probe_z: float = addresses.probe_z()
    z_probe_x: float | None = addresses.z_probe_x()
    z_probe_y: float | None = addresses.z_probe_y()
    z_probe_z: float | None = addresses.z_probe_z()
    z_new: float = addresses.z_new()

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        yield from self.fits(m, length_x=self.length_x, length_y=self.length_y)

    def moves(self, m: Machine) -> Moves:
        a, centre, lengths = self.approach(m), (self.x, self.y), (self.length_x, self.length_y)
        found, contacts = yield from box(a, centre, lengths, True, m.programmed[2])
        touches = numbers(contacts)
        yield Measure("length X", found.length, self.length_x, touches=touches[:2])
        yield Measure("length Y", found.width, self.length_y, touches=touches[2:])
        yield from centre_datum(self, m, a, centre, found.centre, (self.x_new, self.y_new), touches)


@CYCLES("G411", "Datum at the centre of an island", runs="definition", source="MNC 12.6")
class DatumOnIsland(MeasuringCycle):
    """Four touches of a rectangular island along the axes; its centre gets the coordinates U and V."""

    refused: ClassVar[tuple[str, ...]] = TURNS

    x: float = addresses.coordinate("X", "X of the centre of the island", 50)
    y: float = addresses.coordinate("Y", "Y of the centre of the island", 30)
    length_x: float = addresses.length_x()
    length_y: float = addresses.length_y()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    between: float = addresses.between()
    row: float = addresses.row()
    x_new: float = addresses.new_x()
    y_new: float = addresses.new_y()
    apply: float = addresses.apply()
    probe_z: float = addresses.probe_z()
    z_probe_x: float | None = addresses.z_probe_x()
    z_probe_y: float | None = addresses.z_probe_y()
    z_probe_z: float | None = addresses.z_probe_z()
    z_new: float = addresses.z_new()

    def moves(self, m: Machine) -> Moves:
        a, centre, lengths = self.approach(m), (self.x, self.y), (self.length_x, self.length_y)
        found, contacts = yield from box(a, centre, lengths, False, m.programmed[2])
        touches = numbers(contacts)
        yield Measure("length X", found.length, self.length_x, touches=touches[:2])
        yield Measure("length Y", found.width, self.length_y, touches=touches[2:])
        yield from centre_datum(self, m, a, centre, found.centre, (self.x_new, self.y_new), touches)


@CYCLES("G412", "Datum at the centre of a bore", runs="definition", source="MNC 12.7")
class DatumInBore(MeasuringCycle):
    """Four touches of a bore or circular pocket along the axes; its centre gets the coordinates U and V."""

    refused: ClassVar[tuple[str, ...]] = TURNS

    x: float = addresses.coordinate("X", "X of the centre of the bore", 50)
    y: float = addresses.coordinate("Y", "Y of the centre of the bore", 30)
    diameter: float = addresses.diameter()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    between: float = addresses.between()
    row: float = addresses.row()
    x_new: float = addresses.new_x()
    y_new: float = addresses.new_y()
    apply: float = addresses.apply()
    probe_z: float = addresses.probe_z()
    z_probe_x: float | None = addresses.z_probe_x()
    z_probe_y: float | None = addresses.z_probe_y()
    z_probe_z: float | None = addresses.z_probe_z()
    z_new: float = addresses.z_new()

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        yield from self.fits(m, diameter=self.diameter)

    def moves(self, m: Machine) -> Moves:
        a, centre = self.approach(m), (self.x, self.y)
        found, contacts = yield from ring(a, centre, self.diameter, True, m.programmed[2])
        touches = numbers(contacts)
        yield Measure("diameter", found.diameter, self.diameter, touches=touches)
        yield from centre_datum(self, m, a, centre, found.centre, (self.x_new, self.y_new), touches)


@CYCLES("G413", "Datum at the centre of a boss", runs="definition", source="MNC 12.8")
class DatumOnBoss(MeasuringCycle):
    """Four touches of a circular island along the axes; its centre gets the coordinates U and V."""

    refused: ClassVar[tuple[str, ...]] = TURNS

    x: float = addresses.coordinate("X", "X of the centre of the boss", 50)
    y: float = addresses.coordinate("Y", "Y of the centre of the boss", 30)
    diameter: float = addresses.diameter()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    between: float = addresses.between()
    row: float = addresses.row()
    x_new: float = addresses.new_x()
    y_new: float = addresses.new_y()
    apply: float = addresses.apply()
    probe_z: float = addresses.probe_z()
    z_probe_x: float | None = addresses.z_probe_x()
    z_probe_y: float | None = addresses.z_probe_y()
    z_probe_z: float | None = addresses.z_probe_z()
    z_new: float = addresses.z_new()

    def moves(self, m: Machine) -> Moves:
        a, centre = self.approach(m), (self.x, self.y)
        found, contacts = yield from ring(a, centre, self.diameter, False, m.programmed[2])
        touches = numbers(contacts)
        yield Measure("diameter", found.diameter, self.diameter, touches=touches)
        yield from centre_datum(self, m, a, centre, found.centre, (self.x_new, self.y_new), touches)


@CYCLES("G417", "Datum along Z", runs="definition", source="MNC 12.11")
class DatumAlongZ(MeasuringCycle):
    """One touch downwards, past the nominal point until the surface; it gets the coordinate R."""

    refused: ClassVar[tuple[str, ...]] = TURNS

    x: float = addresses.coordinate("X", "X of the measuring point", 30)
    y: float = addresses.coordinate("Y", "Y of the measuring point", 20)
    nominal_z: float = addresses.coordinate("Z", "nominal Z of the measuring point", 0)
    clearance: float = addresses.clearance()
    height: float = addresses.height()
    row: float = addresses.row()
    z_new: float = addresses.z_new(meaning="Z of the measured point in the new system")
    apply: float = addresses.apply()

    def low(self, a: Approach) -> Iterator[tuple[str, str]]:
        return self.below(a, self.nominal_z + a.gap)

    def moves(self, m: Machine) -> Moves:
        a = self.approach(m)
        contact = yield from from_above(a, self.x, self.y, self.nominal_z, m.programmed[2])
        z = contact.point[2] - a.ball
        yield Measure("Z", z, self.nominal_z, touches=(contact.number,))
        yield from self.finish(m, a, {2: (z, self.z_new)})


@CYCLES("G419", "Datum along X or Y", runs="definition", source="MNC 12.12")
class DatumAlongAxis(MeasuringCycle):
    """One touch of a side; the touched surface gets the coordinate U of the axis."""

    refused: ClassVar[tuple[str, ...]] = TURNS

    x: float = addresses.coordinate("X", "X of the measuring point", 0)
    y: float = addresses.coordinate("Y", "Y of the measuring point", 30)
    axis: float = addresses.axis()
    direction: float = addresses.direction()
    clearance: float = addresses.clearance()
    level: float = addresses.level()
    height: float = addresses.height()
    row: float = addresses.row()
    new_coordinate: float = addresses.new("U", meaning="coordinate of the point in the new system")
    apply: float = addresses.apply()

    def moves(self, m: Machine) -> Moves:
        a, k, sense = self.approach(m), int(self.axis) - 1, self.direction
        way = (sense, 0.0) if k == 0 else (0.0, sense)
        (contact,) = yield from in_plane(a, [Aim(self.x, self.y, way)], m.programmed[2])
        found = contact.point[k] + sense * a.ball
        yield Measure("XY"[k], found, (self.x, self.y)[k], touches=(contact.number,))
        yield from self.finish(m, a, {k: (found, self.new_coordinate)})


def middle_datum(
    cycle: MeasuringCycle, m: Machine, centre: Pair, size: float, axis: float, new: float, *, inside: bool
) -> Moves:  # fmt: skip
    """The middle of a slot or a ridge; about a ridge the probe goes over the safe height (MNC-G409-NOP)."""
    a, k = cycle.approach(m, **({} if inside else {"over": True})), int(axis) - 1
    found, width, contacts = yield from middle(a, centre, size, k, inside, m.programmed[2])
    yield Measure("width", width, size, touches=numbers(contacts))
    yield Measure(f"centre {'XY'[k]}", found, centre[k], touches=numbers(contacts))
    yield from cycle.finish(m, a, {k: (found, new)})


def centre_datum(
    cycle: MeasuringCycle, m: Machine, a: Approach, nominal: Pair, found: Sequence[float], new: Pair, touches: Sequence[int]
) -> Moves:  # fmt: skip
    """The centre of a figure."""
    for k in range(2):
        yield Measure(f"centre {'XY'[k]}", found[k], nominal[k], touches=tuple(touches[2 * k : 2 * k + 2]))
    yield from cycle.finish(m, a, {k: (found[k], new[k]) for k in range(2)})
