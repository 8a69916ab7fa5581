"""What holds the blank: clamps and vices hatched, in every view."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch, Polygon

from mnclab.path.toolpath import Array
from mnclab.show.plot.overlay import fits, grown
from mnclab.show.plot.picture import View
from mnclab.show.plot.sections import FIXTURE
from mnclab.workpiece.blank import Blank, blank
from mnclab.workpiece.part import Part

NAME = "fixture"
LOOK: dict[str, Any] = {**FIXTURE, "hatch": "\\\\\\", "linestyle": "-", "edgecolor": "#77736a"}


class Fixtures(NamedTuple):
    """Bodies in the coordinates of the path."""

    bodies: list[Blank]

    def box(self, low: Array, high: Array) -> tuple[Array, Array]:
        for each in self.bodies:
            if fits(low, high, each.bounds):  # else it is cut off at the border
                low, high = grown(low, high, each.bounds)
        return low, high

    def names(self, views: Sequence[View]) -> list[str]:
        return [NAME]

    def draw(self, ax: Axes, view: View) -> list[Any]:
        for each in self.bodies:
            for outline in each.outline(view.right, view.up):
                ax.add_patch(Polygon(outline, **LOOK, zorder=1.2))
        return [Patch(**LOOK, label=NAME)]

    def write(self, ax: Axes, view: View, lines: Sequence[Array]) -> None:
        return None


def fixtures_of(run: Any) -> Fixtures | None:
    """The fixtures of a mill whose outline is known; of a lathe the picture of the part has them."""
    if run.toolpath.lathe:
        return None
    found = [blank(each) for each in run.setup.fixtures if not isinstance(each, Part)]
    bodies = [each.moved(-np.asarray(run.toolpath.origin)) for each in found if each is not None]
    return Fixtures(bodies) if bodies else None
