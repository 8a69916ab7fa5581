"""What fixed cycles at holes of G-word controls share: over the hole, to level R, and up again afterwards."""

from __future__ import annotations

from typing import Any

from mnclab.machine.machine import Machine
from mnclab.machine.performing import perform
from mnclab.machining.steps import Go


def initial_level(m: Machine, kept: dict[str, Any]) -> float:
    """Z of the program where the tool stood when the cycle was first called (``kept["initial"]``, of the machine)."""
    x, y, _ = m.tip
    return m.to_program((x, y, kept["initial"]))[2]


def approach(m: Machine, code: str, x: float | None, y: float | None, r_level: float) -> None:
    """Movements 1 and 2: over the hole, then to level R."""
    m.label = f"{code} to the hole"
    m.rapid(x=x, y=y)
    perform(m, code, [Go("to level R", r_level)])


def leave(m: Machine, code: str, r_level: float) -> None:
    """Movements 5 and 6: to level R, and with G98 to the initial level."""
    steps = [Go("retract", r_level)]
    if m.modal["return"] == "G98" and m.position_cycle:
        steps.append(Go("to the initial level", initial_level(m, m.position_cycle.extra)))
    perform(m, code, steps)
