"""A turned design as a workpiece: the part that a perfect program would leave."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.toolpath import Array
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.turning.turned import Turned

if TYPE_CHECKING:
    from mnclab.design.model.turned_design import TurnedDesign


class DrawnTurned(Turned):
    """A `Turned` part that nothing cut: its section is that of the design."""

    def __init__(self, design: TurnedDesign, step: float | None = None) -> None:
        super().__init__(Cutting.of_nothing(design.as_blank(), lathe=True), step)
        self.design = design
        self.method, self.error = "as drawn", 0.0

    @property
    def removed(self) -> float:
        """What a program has to take away from the blank of the design, mm³; 0 where it has none."""
        return 0.0 if self.design.blank is None else self.design.blank.volume - self.volume

    def removed_by_row(self) -> Array:
        return np.zeros(0)
