"""A design as a workpiece: the part that a perfect program would leave."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.toolpath import Array
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.part import Part

if TYPE_CHECKING:
    from mnclab.design.model.design import Design


class Drawn(Milled):
    """A `Milled` part that nothing cut: its heights, volume and distances are those of the design."""

    def __init__(self, design: Design, step: float | None = None) -> None:
        super().__init__(Cutting.of_nothing(design), step)
        self.design = design
        self.method, self.error = "as drawn", 0.0

    @cached_property
    def sides(self) -> tuple[Array, Array]:
        """The lower and the upper side at the middles of the cells (ny, nx); its lowest place where there is nothing."""
        low = float(self.design.bounds[0, 2])
        floor, top = (np.where(np.isnan(side), low, side) for side in self.design.faces_over(self.x, self.y))
        return floor, top

    @cached_property
    def heights(self) -> Array:
        return self.sides[1]

    @cached_property
    def floor(self) -> Array:
        return self.sides[0]

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
