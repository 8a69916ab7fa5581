"""Boring cycles: G76 and G85 to G89, in and out at feed or with the spindle at rest."""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.g43.cycles import POSITION, HoleCycle, dwell, repeats
from mnclab.controls.g43.remarks import ISO
from mnclab.controls.word_address import holes
from mnclab.machine.cycle import CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machining.holes.drilling import back_bore, back_to_axis, bore_and_stop, ream
from mnclab.machining.steps import RAPID, Go, Step

CYCLES = CycleTable()


def initial_level_alone(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault where a cycle that cannot stay at level R is to do so."""
    if m.modal["return"] == "G99":
        yield "", "always comes back to the initial level: write G98"


def not_of_linuxcnc(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault of a cycle that LinuxCNC's documentation calls unimplemented."""
    if m.settings["dialect"] == "linuxcnc":
        yield "", "is not built as LinuxCNC has it"


def shift_scaled(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault where it is not known whether the shift off the wall is scaled."""
    if "scaling" in m.frames:
        yield "", "cannot run under G51: whether the shift is scaled is a matter of the maker"


@CYCLES("G85", "Boring, feed out", runs="position", source=ISO, triggers=POSITION)
class Reaming(HoleCycle):
    """In and out at feed."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    feed: float | None = holes.feed()
    repeats: float = repeats()

    def work(self, m: Machine) -> Iterator[Step]:
        return ream(self.bottom, above=self.r_level, feed=None, retract=None)


@CYCLES("G89", "Boring, dwell, feed out", runs="position", source=ISO, triggers=POSITION)
class DwellReaming(HoleCycle):
    """In at feed, a dwell, out at feed."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    dwell: float = dwell()
    feed: float | None = holes.feed()
    repeats: float = repeats()

    def work(self, m: Machine) -> Iterator[Step]:
        return ream(self.bottom, above=self.r_level, feed=None, retract=None, dwell=self.seconds)

    def hole(self, m: Machine) -> Iterator[Step]:
        """On LinuxCNC the way out is at feed up to the initial level."""
        up = None if m.settings["dialect"] == "linuxcnc" else RAPID
        for step in super().hole(m):
            yield step._replace(feed=up) if isinstance(step, Go) and step.label == "to the initial level" else step


@CYCLES("G86", "Boring, spindle stop, rapid out", runs="position", source=ISO, triggers=POSITION)
class StoppedBoring(HoleCycle):
    """In at feed, spindle stop, out at rapid."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    dwell: float = dwell()
    feed: float | None = holes.feed()
    repeats: float = repeats()
    needs = (holes.spindle_stands,)

    def work(self, m: Machine) -> Iterator[Step]:
        return bore_and_stop(self.bottom, above=self.r_level, dwell=self.seconds, turning=m.turning)


@CYCLES("G76", "Fine boring", runs="position", source=ISO, triggers=POSITION)
class FineBoring(HoleCycle):
    """In at feed, oriented spindle stop, away from the wall by Q along -X or by I and J, out at rapid, back to the axis."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    shift: float | None = param(
        "Q", "shift off the wall", default=None, default_means="by I and J", above=0, incremental=True, modal=True,
        example=0.2,
    )  # fmt: skip
    shift_x: float = param("I", "shift along X", default=0, modal=True, note="of Haas, without Q")
    shift_y: float = param("J", "shift along Y", default=0, modal=True, note="of Haas, without Q")
    dwell: float = dwell()
    feed: float | None = holes.feed()
    repeats: float = repeats()
    needs = (holes.spindle_stands, shift_scaled)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        yield from super().contradictions()
        by_both = self.shift_x or self.shift_y
        if self.shift is None and not by_both:
            yield "shift", "is missing"
        if self.shift is not None and by_both:
            yield "shift", "and I J are two ways to say the shift"

    def work(self, m: Machine) -> Iterator[Step]:
        shift = (self.shift_x, self.shift_y) if self.shift is None else (-self.shift, 0.0)
        return bore_and_stop(self.bottom, above=self.r_level, dwell=self.seconds, turning=m.turning, shift=shift)


@CYCLES("G87", "Back boring", runs="position", source=f"{ISO}; FANUC", triggers=POSITION)
class BackBoring(HoleCycle):
    """Off the axis by Q along -X with the spindle oriented, at rapid through the hole to level R, on the axis again up to Z.

    R lies below Z. The tool always comes back to the initial level, the way it came.
    """

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = param("Z", "depth of the counterbore from below", modal=True, example=-10)
    r_level: float = param("R", "level R, below the workpiece", modal=True, example=-25)
    shift: float = param("Q", "shift off the axis", above=0, incremental=True, modal=True, example=0.2)
    dwell: float = dwell()
    feed: float | None = holes.feed()
    repeats: float = repeats()
    needs = (holes.spindle_stands, not_of_linuxcnc, initial_level_alone, shift_scaled)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if not self.bottom > self.r_level:
            yield "bottom", f"must lie above level R, got Z {self.bottom:g} and R {self.r_level:g}"

    def hole(self, m: Machine) -> Iterator[Step]:
        yield Go("to the hole", x=0.0, y=0.0)
        yield from self.work(m)

    def work(self, m: Machine) -> Iterator[Step]:
        above, turning = m.programmed[2], m.turning
        yield from back_bore(
            above=above, below=self.r_level, bottom=self.bottom, eccentricity=self.shift, direction=1, angle=0.0,
            feed=None, travel=RAPID, dwell=self.seconds, turning=turning, leave=False,
        )  # fmt: skip
        yield from back_to_axis(above, turning)


@CYCLES("G88", "Boring, spindle stop, out by hand", runs="position", source=f"{ISO}; FANUC", triggers=POSITION)
class HandBoring(HoleCycle):
    """In at feed, spindle stop, program stop: the operator draws the tool out, and the program goes on above the hole."""

    x: float | None = holes.position("X", 20)
    y: float | None = holes.position("Y", 10)
    bottom: float = holes.bottom()
    r_level: float = holes.r_level()
    dwell: float = dwell()
    feed: float | None = holes.feed()
    repeats: float = repeats()
    needs = (holes.spindle_stands, not_of_linuxcnc)

    def work(self, m: Machine) -> Iterator[Step]:
        return bore_and_stop(self.bottom, above=self.r_level, dwell=self.seconds, turning=m.turning, by_hand=True)
