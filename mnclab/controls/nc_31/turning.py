"""Turning cycles (source, chapter 3.20): G77 so far."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from mnclab.controls.nc_31 import discretes
from mnclab.controls.nc_31.functions import refuse_rapid
from mnclab.machine.cycle import Cycle, CycleTable, own_feed, param
from mnclab.machine.machine import Machine
from mnclab.machining.turning import Pass, Shoulder, chip_breaks, count_of_breaks, count_of_levels, roughing
from mnclab.text.program import INCREMENTAL, RAPID_MARK, Word

CYCLES = CycleTable()

LOOP = 0.5  # mm in both axes at the end of a roughing pass (3.20.2)
MOST_PASSES = 10_000  # beyond any blank: a P1 that is so small is a slip
SWITCH = {0.0: "no", 1.0: "yes"}


@CYCLES("G77", "Longitudinal roughing in passes", runs="definition", source="NC-31 3.20.5")
class LongitudinalRoughing(Cycle):
    """Passes along Z from the start diameter to X, each stopping at the bevel; a clean-up along the contour ends it.

    Start (X1, Z1); contour (X, Z1) to (X, Z + P2), then straight to (X1, Z). Roughing passes lie P1 apart while at
    least P1 is left; each ends with 0.5 mm off the contour and back to Z1. Machine parameters 10 and 11 break the chip
    there: after every length of cut a rapid retract. The clean-up, at the feed set before the cycle, has no breaks.
    """

    x: float = param("X", "diameter of the finished surface", "0.01 mm", note="@: from the start point")
    z: float = param("Z", "end of the passes", "0.01 mm", note="@: distance from the start point")
    feed: float | None = param(
        "F", "feed of the roughing passes", "0.0001 mm/rev", default=None, default_means="the modal feed",
        at_least=1, at_most=999_999, type="integer",
    )  # fmt: skip
    stock_per_pass: float = param(
        "P", "stock removed per pass", "0.01 mm", above=0, incremental=True, type="integer", note="on the diameter",
    )  # fmt: skip
    bevel: float = param(
        "P", "size of the bevel along Z", "0.01 mm", default=0, at_least=0, incremental=True, type="integer"
    )
    rapid_infeed: float = param("~", "infeed at rapid", "mark", default=0, choices=SWITCH, mark=RAPID_MARK)
    to_contour: float = param(
        "@", "ends at point B (X, Z1) instead of the start", "mark", default=0, choices=SWITCH, mark=INCREMENTAL
    )

    @classmethod
    def prepare(
        cls, values: dict[str, Any], given: Mapping[str, Word], m: Machine, kept: dict[str, Any]
    ) -> dict[str, Any]:
        """Increments become coordinates, in discretes."""
        ends = [given[name] for name in ("x", "z") if name in given]
        refuse_rapid(m, ends, "G77")
        if "x" in given and given["x"].incremental:
            values["x"] += m.programmed[0] * discretes.X
        if "z" in given and given["z"].incremental:
            values["z"] += m.programmed[2] * discretes.Z
        return values

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Something to remove, a bevel that fits, a machine parameter that can be used, a feed for the clean-up."""
        x1, z1 = m.programmed[0] * discretes.X, m.programmed[2] * discretes.Z
        stock, length = abs(x1 - self.x), abs(z1 - self.z)
        if stock == 0:
            yield "x", f"must differ from the start diameter, got {self.x:g}"
        if length == 0:
            yield "z", f"must differ from the Z of the start, got {self.z:g}"
        if self.bevel > length * (1 + 1e-9):
            yield "bevel", f"must be at most {length:g}, the distance to the start, got {self.bevel:g}"
        passes = count_of_levels(x1, self.x, self.depth(m))
        if passes > MOST_PASSES:
            yield "stock_per_pass", f"{self.stock_per_pass:g} gives {passes} passes, allowed are {MOST_PASSES}"
        breaks = passes * count_of_breaks(z1, self.z, m.settings["parameter_10"])
        if breaks > 10 * MOST_PASSES:
            yield "", f"would break the chip {breaks} times: machine parameter 10 is too small"
        if m.feed is None:
            yield "", "needs a feed F before it, for the clean-up pass"

    def depth(self, m: Machine) -> float:
        """P1 in discretes on the diameter."""
        return self.stock_per_pass * (2 if m.settings["p1_on_radius"] else 1)

    def moves(self, m: Machine) -> None:
        """Roughing passes, clean-up, return."""
        x1, _, z1 = m.programmed
        x, z = self.x / discretes.X, self.z / discretes.Z
        back = math.copysign(1.0, z1 - z)
        corner = z + back * self.bevel / discretes.Z
        passes = roughing(x1, Shoulder(finish=x, corner=corner, rim=x1, far=z), self.depth(m) / discretes.X)
        feed = None if self.feed is None else self.feed / discretes.CYCLE_FEED
        for number, cut in enumerate(passes, 1):
            m.label = f"G77 pass {number} of {len(passes)}"
            with own_feed(m, feed):
                self.rough(m, cut, z1, back)
            m.rapid(x=cut.level + math.copysign(LOOP, x1 - x), z=cut.stop + back * LOOP)
            m.rapid(z=z1)
        m.label = "G77 clean-up"
        self.infeed(m, x)
        m.line(z=corner)
        m.line(x=x1, z=z)
        m.rapid(z=z1)
        if self.to_contour:
            m.label = "G77 to point B"
            m.rapid(x=x)

    def rough(self, m: Machine, cut: Pass, z1: float, back: float) -> None:
        """One pass, interrupted where the chip is to break; the tool cuts the retracted length again."""
        length, retract = (m.settings[f"parameter_{n}"] / discretes.TRAVEL for n in (10, 11))
        self.infeed(m, cut.level)
        for place in chip_breaks(z1, cut.stop, length):
            m.line(z=place)
            m.rapid(z=place + back * retract)
        m.line(z=cut.stop)

    def infeed(self, m: Machine, x: float) -> None:
        """To the depth of a pass."""
        if self.rapid_infeed:
            m.rapid(x=x)
        else:
            m.line(x=x)
