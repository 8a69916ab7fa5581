"""What fixed cycles at holes of G-word controls share: their faults, over the hole, to level R, and up again afterwards."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mnclab.controls.word_address.state import memory
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Go
from mnclab.running.performing import perform


def upside_down(bottom: float, r_level: float) -> Iterator[tuple[str, str]]:
    """A fault where the bottom does not lie below level R."""
    if not bottom < r_level:
        yield "bottom", f"must lie below level R, got bottom {bottom:g} and R {r_level:g}"


def out_of_place(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault under radius compensation or in machine coordinates."""
    if m.side:
        yield "", "cannot run under radius compensation"
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
    x, y, _ = m.tip
    return m.to_program((x, y, kept["initial"]))[2]


def approach(m: Machine, code: str, x: float | None, y: float | None, r_level: float) -> None:
    """Movements 1 and 2: over the hole, then to level R; from below R first up to it, for below it a rapid across would cut.

    No source says what happens from below R; LinuxCNC does this.
    """
    if m.programmed[2] < r_level:
        perform(m, code, [Go("to level R", r_level)])
    m.label = f"{code} to the hole"
    m.rapid(x=x, y=y)
    perform(m, code, [Go("to level R", r_level)])


def leave(m: Machine, code: str, r_level: float) -> None:
    """Movements 5 and 6: to level R, and with G98 to the initial level.

    An initial level below R is none to return to: R is where nothing is in the way, and a rapid down from it would end in
    the hole, the next one lead through the workpiece. So the tool stays at R, as ISO controls have it.
    """
    steps = [Go("retract", r_level)]
    if m.modal["return"] == "G98" and m.position_cycle:
        steps.append(Go("to the initial level", max(r_level, initial_level(m, m.position_cycle.extra))))
    perform(m, code, steps)
