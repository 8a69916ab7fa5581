"""What controls differ in when they compensate the radius, and the words that all parts of the pass share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

import numpy as np

from mnclab.path.fault import PathFault

TANGENT = np.radians(0.001)  # corners that turn less are none (setting tangent_tolerance of the MNC)
CUSP = np.radians(170)  # where arcs turn back by more, not the turn but what the elements do beside it counts
CLEAR = 1e-6  # mm: nearer to its neighbours than its radius less this the tool cuts into them
ACUTE_TURN = np.pi / 2 + TANGENT  # a corner that turns more is acute
SPIKE_TURN = np.radians(170)  # straight corners that turn more are worth a notice (MNC-G161-SPIKE)
CORNER = "outside corner"  # label of inserted arcs

#: Values of the column `corner_rule`: how outside corners are joined (MNC: G160, G161, G162).
ROUND, STRAIGHT, ACUTE = 0, 1, 2


@dataclass(frozen=True)
class Compensation:
    """How a control enters, leaves and changes the equidistant.

    `approach` "perpendicular": the entry ends, and the exit begins, square to the contour; "corner": outside, the
    first and last corners are built like any other (MNC tables 7.1 and 7.3). `rapid`: entry and exit may run at
    rapid. `change`: the side may change on the way, by a straight line that leads over like an entry. `arc_entry`: it
    may begin with an arc, which becomes one about another centre that ends square to the contour. `straight_exit`: the exit
    begins where the offset of the last element ends, whatever the corner. `look_ahead`: the whole contour is looked at, else
    each element with its neighbours only (and always what a cusp leads back to). A joint counts as tangent below `TANGENT`,
    0.001 degrees; any greater turn is a corner and is built exactly.
    """

    approach: str = "perpendicular"
    rapid: bool = False
    change: bool = False
    look_ahead: bool = False
    arc_entry: bool = False
    straight_exit: bool = False

    def chosen(self, settings: Mapping[str, Any]) -> Compensation:
        """These rules as the settings of a control have them."""
        own = settings.get("compensation_leads") == "linuxcnc"
        return replace(self, arc_entry=True, straight_exit=True) if own else self


class Gouge(NamedTuple):
    """A place where the tool does not fit.

    `kind` is "arc", "element", "neighbour", "bottleneck", "end", "corner", "entry" or "exit"; `line` and `step` are
    those of the block in which the tool would cut into the contour, `other` is the line that it would cut into.
    `place` (x, y, z) is the point of the contour, mm; `width` mm is what there is and `missing` mm what it lacks;
    `largest` is the largest radius for the whole contour, from its entry to its exit or change of side.
    """

    kind: str
    line: int
    step: int
    other: int
    place: tuple[float, float, float]
    radius: float
    width: float
    missing: float
    largest: float
    message: str
    hint: str = ""

    def __repr__(self) -> str:
        return f"<Gouge line {self.line}: {self.message}>"


@dataclass
class Report:
    """What the pass has to say: places that do not fit, and remarks at a step."""

    gouges: list[Gouge] = field(default_factory=list)
    notices: list[PathFault] = field(default_factory=list)

    def remarks(self) -> list[tuple[str, int, str]]:
        return [(g.message, g.step, g.hint) for g in self.gouges] + [(n.message, n.step, n.hint) for n in self.notices]
