"""A design as a workpiece: the part that a perfect program would leave."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.columns import Array
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.part import Part

if TYPE_CHECKING:
    from mnclab.workpiece.design.design import Design


class Drawn(Milled):
    """A `Milled` part that nothing cut: its heights, volume and distances are those of the design."""

    def __init__(self, design: Design, step: float | None = None) -> None:
        super().__init__(Cutting.of_nothing(design), step)
        self.design = design
        self.method, self.error = "as drawn", 0.0

    @property
    def volume(self) -> float:
        return self.design.volume

    @cached_property
    def removed(self) -> float:
        """What a program has to take away from the blank of the design, mm³."""
        return self.design.blank.volume - self.design.volume

    def removed_by_row(self) -> Array:
        return np.zeros(0)

    @property
    def part(self) -> Part:
        return self.design.part
