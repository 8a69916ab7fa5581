"""What the MNC keeps beside the common state of a machine."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from mnclab.controls.word_address import state


class Polar(NamedTuple):
    """The last polar position: radius, mm, and angle, degrees, about the pole; and the point that it is."""

    radius: float
    angle: float
    place: tuple[float, float, float]


@dataclass
class Memory(state.Memory):
    """Of the MNC."""

    polar: Polar | None = None  # while a pole is active
    run_up: int = -1  # the step that last waited for the spindle
    base_rotation: float = 0.0  # degrees, counter-clockwise
    laser: dict[str, float] = field(default_factory=dict)  # what calibrations found of the tool setter
    angled: frozenset[int] = frozenset()  # rows of the datum table that hold an angle


memory = Memory.of
