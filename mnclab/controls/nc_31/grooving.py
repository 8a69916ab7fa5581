"""Grooving cycles G74 and G75 (source, 3.20.9 and 3.20.10): one groove beside the other, or one wide groove."""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.nc_31 import discretes
from mnclab.controls.nc_31.targets import FROM_START, FromStart, apart, feed_word, here, in_mm, rapid_mark
from mnclab.machine.cycle import CycleTable, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.steps import RAPID, Step
from mnclab.machining.turning.grooving import grooves, places
from mnclab.machining.turning.shoulders import facing
from mnclab.running.performing import perform

CYCLES = CycleTable()

FEED = "feed of the cycle"


class Grooving(FromStart):
    """What both cycles check and do; `face` says which way they plunge."""

    x: float
    z: float
    feed: float | None
    pitch: float
    rapid_step: float
    face = False

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """A depth, a pitch that is not longer than the way to the last groove, not too many grooves."""
        x1, z1 = here(m)
        yield from apart(None, self.z, m) if self.face else apart(self.x, None, m)
        way, axis = (abs(self.x - x1), "X") if self.face else (abs(self.z - z1), "Z")
        if self.pitch > way * (1 + 1e-9):
            yield "pitch", f"must be at most {way:.10g}, the way along {axis} to the last groove, got {self.pitch:.10g}"
        yield from too_many("pitch", lambda: places(0, way, self.pitch))
        if self.feed is None and m.feed is None:
            yield "", "needs a feed: F here, or before it"

    def moves(self, m: Machine) -> None:
        """The grooves, then back to the start."""
        x1, _, z1 = m.programmed
        x, z = self.x / discretes.X, self.z / discretes.Z
        shift = RAPID if self.rapid_step else None
        with m.within(feed=m.feed if self.feed is None else in_mm(self.feed)):
            if self.face:
                cuts: Iterator[Step] = facing(grooves(z1, z, places(x1, x, self.pitch / discretes.X), shift=shift))
            else:
                cuts = grooves(x1, x, places(z1, z, self.pitch / discretes.Z), shift=shift)
            perform(m, self.code, cuts, (0.0, 0.0))


@CYCLES("G74", "Face grooving in cuts", runs="definition", source="NC-31 3.20.9")
class FaceGrooving(Grooving):
    """Plunges along Z, P apart along X, the first at the start and the last at X; back at rapid after each.

    Concentric grooves, or one wide groove where P is less than the width of the tool. Ends at the start point.
    """

    x: float = param("X", "start of the last groove", "0.01 mm on diameter", note=FROM_START, example=2000)
    z: float = param("Z", "bottom of the groove", "0.01 mm", note=FROM_START, example=-500)
    feed: float | None = feed_word(FEED)
    pitch: float = param(
        "P", "pitch of the grooves", "0.01 mm on diameter", above=0, incremental=True, type="integer", example=600,
    )  # fmt: skip
    rapid_step: float = rapid_mark("side step at rapid")

    face = True


@CYCLES("G75", "Cylindrical grooving in cuts", runs="definition", source="NC-31 3.20.10")
class CylindricalGrooving(Grooving):
    """Plunges along X, P apart along Z, the first at the start and the last at Z; back at rapid after each.

    A group of grooves, or one wide groove where P is less than the width of the tool. Ends at the start point.
    """

    x: float = param("X", "bottom of the groove", "0.01 mm on diameter", note=FROM_START, example=3000)
    z: float = param("Z", "start of the last groove", "0.01 mm", note=FROM_START, example=-1500)
    feed: float | None = feed_word(FEED)
    pitch: float = param("P", "pitch of the grooves", "0.01 mm", above=0, incremental=True, type="integer", example=500)
    rapid_step: float = rapid_mark("side step at rapid")
