"""Where the tool goes at the end of a contour cycle (posAfterContPocket, no. 201007; 8.5 to 8.9)."""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.machine.control import Setting
from mnclab.machine.machine import Machine
from mnclab.machining.steps import RAPID, Go

SETTINGS = (
    Setting(
        "position_after_contour", "before", "where a contour cycle leaves the tool (posAfterContPocket, no. 201007)", "8.5",
        {
            "before": "at the position programmed last before the cycle",
            "height": "at the clearance height, in the plane where the cycle ended (ToolAxClearanceHeight)",
        },
    ),
)  # fmt: skip

Place = tuple[float, float, float]


def leave(m: Machine, before: Place, height: float, feed: float = RAPID) -> Iterator[Go]:
    """Up to the clearance height, and as the setting says to the place `before`, where the tool stood at the call."""
    yield Go("retract", height, feed)
    if m.settings["position_after_contour"] == "before":
        x, y, z = before
        if z > height:
            yield Go("back", z)
        yield Go("back", x=x, y=y)
        if z < height:
            yield Go("back", z)
