"""A turned design as a workpiece: the part that a perfect program would leave."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.contours import Contour
from mnclab.path.columns import Array
from mnclab.text.given import check_number
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.turning.turned import Turned

if TYPE_CHECKING:
    from mnclab.workpiece.design.turned_design import TurnedDesign


class DrawnTurned(Turned):
    """A `Turned` part that nothing cut: its section is that of the design."""

    def __init__(self, design: TurnedDesign, step: float | None = None) -> None:
        if step is not None:
            check_number(step, "the step of a workpiece (mm)", above=0)
        self.design = design
        self.cutting = Cutting.of_nothing(design.as_blank(), lathe=True)
        self.blank, self.axis = design.section[0], design.axis_x
        (self.low, _), (self.high, self.radius) = self.blank.bounds.tolist()
        self.method, self.error = "as drawn", 0.0

    @cached_property
    def section(self) -> list[Contour]:
        return self.design.section

    @cached_property
    def rows(self) -> list[NDArray[np.int64]]:
        return [np.full(len(loop.points), -1, dtype=np.int64) for loop in self.section]

    @cached_property
    def parted(self) -> list[Contour]:
        return []

    @property
    def notes(self) -> tuple[str, ...]:  # type: ignore[override]
        return ()

    @property
    def removed(self) -> float:
        """What a program has to take away from the blank of the design, mm³; 0 where it has none."""
        return 0.0 if self.design.blank is None else self.design.blank.volume - self.volume

    def removed_by_row(self) -> Array:
        return np.zeros(0)
