"""What fixed cycles at holes of G-word controls share: their addresses, their faults, and the way to a hole and away from it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any, ClassVar

import numpy as np

from mnclab.controls.word_address.motion import memory
from mnclab.geometry import frames
from mnclab.machine.axes import in_machine
from mnclab.machine.cycle import Given, Values, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.state import Place
from mnclab.machining.depths import infeeds
from mnclab.machining.steps import Go, Step
from mnclab.path.toolpath import Array


def position(axis: str, example: float) -> Any:
    """X and Y: the hole."""
    return param(
        axis, f"hole position along {axis}", default=None, default_means="the present point",
        note="under G91 from the present point", example=example,
    )  # fmt: skip


x, y = partial(position, "X", 20), partial(position, "Y", 10)
bottom = partial(param, "Z", "bottom of the hole", modal=True, note="under G91 from level R, signed", example=-20)
r_level = partial(param, "R", "level R", modal=True, note="under G91 from the initial level, signed", example=2)
feed = partial(
    param, "F", "feed rate", "mm/min", default=None, default_means="the modal feed", above=0, modal=True, example=120
)  # fmt: skip


def take_feed(m: Machine, values: Values, given: Given) -> None:
    """F of a cycle becomes the modal feed."""
    if "feed" in given and values["feed"] > 0:
        m.change("feed", values["feed"])


def out_of_place(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault under radius compensation or in machine coordinates."""
    if m.side:
        yield "", "cannot run under radius compensation"
    if m.per_time:
        yield "", "cannot run under G93: F is the time of one move there"
    if memory(m).machine_coordinates:
        yield "", "and G53 stand in one block: the cycle counts from the workpiece"


def spindle_stands(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault where the spindle does not turn."""
    if not m.spindle_speed:
        yield "", "needs a turning spindle: write S and M3 or M4 before"


def no_pitch(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault where a tap has no pitch to move by."""
    yield from spindle_stands(m)
    if m.feed is None:
        yield "", "has no feed rate: the pitch is F under G95, and F divided by S under G94"


def initial_level(m: Machine, kept: dict[str, Any]) -> float:
    """Z of the program where the tool stood when the cycle was first called (`kept["initial"]`, of the machine)."""
    if m.shift is not None and m.tables.kinematics is None:
        return float(kept["initial"]) - m.shift[2]
    along, frame = _up(m)
    return float((kept["initial"] - along @ frame[:3, 3]) / (along @ frame[:3, 2]))


def level_of(m: Machine, point: Place) -> float:
    """The height of a point of the program on the machine: along Z of the program, counted where the linear axes count from."""
    if m.shift is not None and m.tables.kinematics is None:
        return m.to_machine(point)[2]
    along, frame = _up(m)
    return float(along @ frames.apply(frame, point))


def _up(m: Machine) -> tuple[Array, Array]:
    """The direction (3,) of Z of the program as the linear axes go, on the side of their Z, and the map (4, 4) to them."""
    frame = in_machine(m)
    along = frame[:3, 2] / np.linalg.norm(frame[:3, 2])
    return (along if along[2] >= 0 else -along), frame


class AtHole(ABC):
    """The way of a cycle to a hole and away from it; the cycle declares the parameters named here."""

    x: float | None
    y: float | None
    bottom: float
    r_level: float
    needs: ClassVar[tuple[Callable[[Machine], Iterator[tuple[str, str]]], ...]] = ()
    """What may be wrong with the machine for the work."""
    pecks: ClassVar[str] = "peck"
    """The parameter that says how deep one is, where there is one."""

    @abstractmethod
    def work(self, m: Machine) -> Iterator[Step]:
        """The steps from level R and back to it."""

    def levels(self) -> tuple[float, ...]:
        """The depths of the pecks, from level R."""
        return infeeds(self.r_level, self.bottom, getattr(self, self.pecks, None))

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if not self.bottom < self.r_level:
            yield "bottom", f"must lie below level R, got bottom {self.bottom:g} and R {self.r_level:g}"
        yield from too_many(self.pecks, self.levels)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        for faults in (out_of_place, *self.needs):
            yield from faults(m)

    def about(self, m: Machine) -> tuple[float, float]:
        return m.programmed[0] if self.x is None else self.x, m.programmed[1] if self.y is None else self.y

    def approach(self, m: Machine) -> Iterator[Step]:
        """Over the hole, and to level R.

        From below R the tool goes up to it first, for a rapid across would cut; no source says so, LinuxCNC does this.
        """
        if m.programmed[2] < self.r_level:
            yield Go("to level R", self.r_level)
        yield self.across()
        yield Go("to level R", self.r_level)

    def across(self) -> Go:
        """Over the hole, from where the axes that are not written stand."""
        return Go("to the hole", x=None if self.x is None else 0.0, y=None if self.y is None else 0.0)

    def moves(self, m: Machine) -> Iterator[Step]:
        """Movements 1 to 6: over the hole, to level R, the work, to level R, and with G98 to the initial level.

        An initial level below R is none to return to: R is where nothing is in the way, and a rapid down from it would
        end in the hole, the next one lead through the workpiece. So the tool stays at R, as ISO controls have it.
        """
        work, r_level = self.work(m), self.r_level
        yield from self.approach(m)
        yield from work
        yield Go("retract", r_level)
        if m.modal["return"] == "G98" and m.position_cycle:
            yield Go("to the initial level", max(r_level, initial_level(m, m.position_cycle.extra)))
