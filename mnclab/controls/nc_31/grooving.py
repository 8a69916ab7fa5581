"""Grooving cycles G74 and G75 (source, 3.20.9 and 3.20.10): one groove beside the other, or one wide groove."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from mnclab.controls.nc_31 import discretes
from mnclab.controls.nc_31.targets import FROM_START, FromStart, apart, feed_word, here, rapid_mark, size, start
from mnclab.machine.cycle import CycleTable, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.steps import RAPID, Step
from mnclab.machining.turning.grooving import grooves, places

CYCLES = CycleTable()

FEED = "feed of the cycle"


def check_grooves(cycle: Grooving, m: Machine) -> Iterator[tuple[str, str]]:
    """A depth, a pitch that is not longer than the way to the last groove, not too many grooves."""
    x1, z1 = here(m)
    yield from apart(None, cycle.z, m) if cycle.transverse else apart(cycle.x, None, m)
    way, axis = (abs(cycle.x - x1), "X") if cycle.transverse else (abs(cycle.z - z1), "Z")
    if cycle.pitch > way * (1 + 1e-9):
        yield "pitch", f"must be at most {way:.10g}, the way along {axis} to the last groove, got {cycle.pitch:.10g}"
    yield from too_many("pitch", lambda: places(0, way, cycle.pitch))
    yield from cycle.needs_feed(m)


def plunge(cycle: Grooving, m: Machine) -> Iterable[Step]:
    """The grooves, then back to the start."""
    across, along = cycle.across_along(*start(m))
    bottom, last = cycle.across_along(cycle.x / discretes.X, cycle.z / discretes.Z)
    pitch = cycle.pitch / (discretes.X if cycle.transverse else discretes.Z)
    shift = RAPID if cycle.rapid_step else None
    return cycle.in_axes(grooves(across, bottom, places(along, last, pitch), shift=shift))


@CYCLES("G74", "Face grooving in cuts", runs="definition", source="NC-31 3.20.9")
class FaceGrooving(FromStart):
    """Plunges along Z, P apart along X, the first at the start and the last at X; back at rapid after each.

    Concentric grooves, or one wide groove where P is less than the width of the tool. Ends at the start point.
    """

    x: float = param("X", "start of the last groove", "0.01 mm on diameter", note=FROM_START, example=2000)
    z: float = param("Z", "bottom of the groove", "0.01 mm", note=FROM_START, example=-500)
    feed: float | None = feed_word(FEED)
    pitch: float = size("pitch of the grooves", "0.01 mm on diameter", above=0, example=600)
    rapid_step: float = rapid_mark("side step at rapid")

    transverse = True
    check, moves = check_grooves, plunge


@CYCLES("G75", "Cylindrical grooving in cuts", runs="definition", source="NC-31 3.20.10")
class CylindricalGrooving(FromStart):
    """Plunges along X, P apart along Z, the first at the start and the last at Z; back at rapid after each.

    A group of grooves, or one wide groove where P is less than the width of the tool. Ends at the start point.
    """

    x: float = param("X", "bottom of the groove", "0.01 mm on diameter", note=FROM_START, example=3000)
    z: float = param("Z", "start of the last groove", "0.01 mm", note=FROM_START, example=-1500)
    feed: float | None = feed_word(FEED)
    pitch: float = size("pitch of the grooves", above=0, example=500)
    rapid_step: float = rapid_mark("side step at rapid")

    check, moves = check_grooves, plunge


Grooving = FaceGrooving | CylindricalGrooving
