"""Turning cycles: one pass G70, G71, and roughing in passes G77, G78 (source, 3.20.3 to 3.20.6).

G71 and G78 are G70 and G77 with the axes exchanged. The figures of the source are lost: the bevel and the way back are
readings (a closed cycle from its start point, with the shoulder faced on the way out).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from mnclab.controls.nc_31 import discretes
from mnclab.controls.nc_31.targets import FROM_START, SWITCH, FromStart, apart, feed_word, here, in_mm, rapid_mark
from mnclab.machine.cycle import CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machining.steps import RAPID, Go, Step
from mnclab.machining.turning.shoulders import (
    Shoulder,
    around,
    count_of_breaks,
    count_of_levels,
    facing,
    loops,
    roughing,
)
from mnclab.running.performing import perform
from mnclab.text.program import INCREMENTAL

CYCLES = CycleTable()

MOST_PASSES = 10_000  # beyond any blank: a P1 that is so small is a slip


def too_far(name: str, size: float, room: float) -> Iterator[tuple[str, str]]:
    """A bevel that is longer than the way to the start."""
    if size > room * (1 + 1e-9):
        yield name, f"must be at most {room:.10g}, the distance to the start, got {size:.10g}"


def back(end: float, size: float, start: float, scale: float) -> float:
    """The coordinate, mm, that lies `size` from `end` (both in discretes) towards `start` (mm).

    Added as whole numbers: a bevel as long as the way to the start ends exactly there.
    """
    return (end + math.copysign(size, start * scale - end)) / scale


def cut(m: Machine, cycle: LongitudinalPass | LongitudinalRoughing, steps: Iterable[Step]) -> None:
    """Carry out steps with x across and z along, in coordinates of the program; those of a transverse cycle turned over."""
    perform(m, cycle.code, facing(steps) if cycle.facing else steps, (0.0, 0.0))


# --- one pass --------------------------------------------------------------------------------------------------------


@CYCLES("G70", "Single longitudinal pass", runs="definition", source="NC-31 3.20.3")
class LongitudinalPass(FromStart):
    """In to X, along Z, up the bevel of P1 and P2, out along X to the start diameter, back at rapid.

    Start (X1, Z1); contour (X, Z1) to (X, Z + P2) to (X + P1, Z) to (X1, Z), with P1 and P2 towards the start. For
    finishing: a cone over the whole length has P2 as long as the pass.
    """

    x: float = param("X", "diameter of the finished surface", "0.01 mm on diameter", note=FROM_START, example=3000)
    z: float = param("Z", "end of the pass", "0.01 mm", note=FROM_START, example=-2000)
    feed: float | None = feed_word("feed of the cycle")
    p1: float = param(
        "P", "size of the bevel along X", "0.01 mm on diameter", default=0, at_least=0, incremental=True, type="integer",
        example=500,
    )  # fmt: skip
    p2: float = param(
        "P", "size of the bevel along Z", "0.01 mm", default=0, at_least=0, incremental=True, type="integer",
        example=500,
    )  # fmt: skip
    rapid_infeed: float = rapid_mark("infeed at rapid")

    facing = False

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """A bevel that fits between the contour and the start, and a way to cut."""
        x1, z1 = here(m)
        yield from apart(self.x, self.z, m)
        yield from too_far("p1", self.p1, abs(x1 - self.x))
        yield from too_far("p2", self.p2, abs(z1 - self.z))
        if self.feed is None and m.feed is None:
            yield "", "needs a feed: F here, or before it"

    def moves(self, m: Machine) -> None:
        """Once around the contour."""
        x1, _, z1 = m.programmed
        x, z = self.x / discretes.X, self.z / discretes.Z
        bevel = back(self.x, self.p1, x1, discretes.X), back(self.z, self.p2, z1, discretes.Z)
        if self.facing:
            start, shoulder = (z1, x1), Shoulder(finish=z, corner=bevel[0], rim=bevel[1], far=x)
        else:
            start, shoulder = (x1, z1), Shoulder(finish=x, corner=bevel[1], rim=bevel[0], far=z)
        infeed = RAPID if self.rapid_infeed else None
        with m.within(feed=m.feed if self.feed is None else in_mm(self.feed)):
            cut(m, self, around(start, shoulder, label="contour", infeed=infeed))


@CYCLES("G71", "Single transverse pass", runs="definition", source="NC-31 3.20.4")
class TransversePass(LongitudinalPass):
    """In to Z, along X, up the bevel of P1 and P2, out along Z to the start, back at rapid: G70 with the axes exchanged.

    Contour (X1, Z) to (X + P1, Z) to (X, Z + P2) to (X, Z1), with P1 and P2 towards the start.
    """

    facing = True


# --- roughing in passes ----------------------------------------------------------------------------------------------


@CYCLES("G77", "Longitudinal roughing in passes", runs="definition", source="NC-31 3.20.5")
class LongitudinalRoughing(FromStart):
    """Passes along Z from the start diameter to X, each stopping at the bevel; a clean-up along the contour ends it.

    Start (X1, Z1); contour (X, Z1) to (X, Z + P2), then straight to (X1, Z). Roughing passes lie P1 apart while at
    least P1 is left; each ends with 0.5 mm off the contour and back to Z1. Machine parameters 10 and 11 break the chip
    there: after every length of cut a rapid retract. The clean-up, at the feed set before the cycle, has no breaks.
    """

    x: float = param("X", "diameter of the finished surface", "0.01 mm on diameter", note=FROM_START, example=3000)
    z: float = param("Z", "end of the passes", "0.01 mm", note=FROM_START, example=-2000)
    feed: float | None = feed_word("feed of the roughing passes")
    stock_per_pass: float = param(
        "P", "stock removed per pass", "0.01 mm on diameter", above=0, incremental=True, type="integer", example=200,
    )  # fmt: skip
    bevel: float = param(
        "P", "size of the bevel along Z", "0.01 mm", default=0, at_least=0, incremental=True, type="integer",
        example=500,
    )  # fmt: skip
    rapid_infeed: float = rapid_mark("infeed at rapid")
    to_contour: float = param(
        "@", "ends at point B (X, Z1) instead of the start", "mark", default=0, choices=SWITCH, mark=INCREMENTAL
    )

    facing = False

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Something to remove, a bevel that fits, a machine parameter that can be used, a feed for the clean-up."""
        yield from apart(self.x, self.z, m)
        yield from too_far("bevel", self.bevel, abs(here(m)[1] - self.z))
        start, shoulder = self.contour(m)
        passes = count_of_levels(start[0], shoulder.finish, self.depth(m))
        if passes > MOST_PASSES:
            yield "stock_per_pass", f"{self.stock_per_pass:.10g} gives {passes} passes, allowed are {MOST_PASSES}"
        breaks = passes * count_of_breaks(start[1], shoulder.far, m.settings["parameter_10"] / discretes.TRAVEL)
        if breaks > 10 * MOST_PASSES:
            yield "", f"would break the chip {breaks} times: machine parameter 10 is too small"
        if m.feed is None:
            yield "", "needs a feed F before it, for the clean-up pass"

    def depth(self, m: Machine) -> float:
        """P1 in mm of tool travel."""
        return self.stock_per_pass * (2 if m.settings["p1_on_radius"] else 1) / discretes.X

    def contour(self, m: Machine) -> tuple[tuple[float, float], Shoulder]:
        """Start and contour as (across, along), mm."""
        x1, _, z1 = m.programmed
        x, z = self.x / discretes.X, self.z / discretes.Z
        return (x1, z1), Shoulder(finish=x, corner=back(self.z, self.bevel, z1, discretes.Z), rim=x1, far=z)

    def moves(self, m: Machine) -> None:
        """Roughing passes, clean-up, return."""
        start, shoulder = self.contour(m)
        passes = roughing(start[0], shoulder, self.depth(m))
        chip, retract = (m.settings[f"parameter_{n}"] / discretes.TRAVEL for n in (10, 11))
        infeed = RAPID if self.rapid_infeed else None
        with m.within(feed=m.feed if self.feed is None else in_mm(self.feed)):
            cut(m, self, loops(start, passes, infeed=infeed, chip=chip, chip_retract=retract))
        cut(m, self, around(start, shoulder, label="clean-up", infeed=infeed))
        if self.to_contour:
            cut(m, self, [Go("to point B", x=shoulder.finish)])


@CYCLES("G78", "Transverse roughing in passes", runs="definition", source="NC-31 3.20.6")
class TransverseRoughing(LongitudinalRoughing):
    """Passes along X from the start to Z, each stopping at the contour; a clean-up along it ends the cycle.

    Start (X1, Z1); contour (X1, Z) straight to (X, Z + P2), then along Z to (X, Z1): a conical face, for the source says
    that the bevel is along Z here too. The setting `g78_bevel` makes it G77 with the axes exchanged. Chips are broken
    by machine parameters 10 and 11, in true travel of the tool.
    """

    stock_per_pass: float = param(
        "P", "stock removed per pass along Z", "0.01 mm", above=0, incremental=True, type="integer", example=200
    )
    to_contour: float = param(
        "@", "ends at point B (X1, Z) instead of the start", "mark", default=0, choices=SWITCH, mark=INCREMENTAL
    )

    facing = True

    def depth(self, m: Machine) -> float:
        """P1 in mm."""
        return self.stock_per_pass / discretes.Z

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """As G77; a bevel along X must fit there."""
        if m.settings["g78_bevel"] == "along_x":
            yield from too_far("bevel", self.bevel, abs(here(m)[0] - self.x))
        yield from super().check(m)

    def contour(self, m: Machine) -> tuple[tuple[float, float], Shoulder]:
        """Start and contour as (across, along), mm."""
        x1, _, z1 = m.programmed
        x, z = self.x / discretes.X, self.z / discretes.Z
        if m.settings["g78_bevel"] == "along_x":
            return (z1, x1), Shoulder(finish=z, corner=back(self.x, self.bevel, x1, discretes.X), rim=z1, far=x)
        return (z1, x1), Shoulder(finish=z, corner=x1, rim=back(self.z, self.bevel, z1, discretes.Z), far=x)
