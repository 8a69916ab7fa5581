"""Removing stock: one pass G70, G71, and roughing in passes G77, G78 (source, 3.20.3 to 3.20.6).

G71 and G78 are G70 and G77 with the axes exchanged. The figures of the source are lost: the bevel and the way back are
readings (a closed cycle from its start point, with the shoulder faced on the way out).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from mnclab.controls.nc_31 import discretes, targets
from mnclab.controls.nc_31.targets import FROM_START, FromStart, apart, feed_word, here, rapid_mark, size, start
from mnclab.machine.cycle import CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machining.steps import RAPID, Go, Step, Write
from mnclab.machining.turning.roughing import Shoulder, around, count_of_breaks, count_of_levels, loops, roughing

CYCLES = CycleTable()

MOST_PASSES = 10_000  # beyond any blank: a P1 that is so small is a slip
TO_DIAMETER = "diameter of the finished surface"


def too_far(name: str, bevel: float, room: float) -> Iterator[tuple[str, str]]:
    """A bevel that is longer than the way to the start."""
    if bevel > room * (1 + 1e-9):
        yield name, f"must be at most {room:.10g}, the distance to the start, got {bevel:.10g}"


def back(end: float, bevel: float, begin: float, scale: float) -> float:
    """The coordinate, mm, that lies `bevel` from `end` (both in discretes) towards `begin` (mm).

    Added as whole numbers: a bevel as long as the way to the start ends exactly there.
    """
    return (end + math.copysign(bevel, begin * scale - end)) / scale


def shoulder_of(cycle: LatheCut, bevel: tuple[float, float]) -> Shoulder:
    """The contour to (X, Z) with a bevel through a point (x, z), mm."""
    across, along = cycle.across_along(cycle.x / discretes.X, cycle.z / discretes.Z)
    rim, corner = cycle.across_along(*bevel)
    return Shoulder(finish=across, corner=corner, rim=rim, far=along)


def check_pass(cycle: LongitudinalPass | TransversePass, m: Machine) -> Iterator[tuple[str, str]]:
    """A bevel that fits between the contour and the start, and a way to cut."""
    x1, z1 = here(m)
    yield from apart(cycle.x, cycle.z, m)
    yield from too_far("p1", cycle.p1, abs(x1 - cycle.x))
    yield from too_far("p2", cycle.p2, abs(z1 - cycle.z))
    yield from cycle.needs_feed(m)


def single_pass(cycle: LongitudinalPass | TransversePass, m: Machine) -> Iterable[Step]:
    """Once around the contour."""
    x1, z1 = start(m)
    bevel = back(cycle.x, cycle.p1, x1, discretes.X), back(cycle.z, cycle.p2, z1, discretes.Z)
    infeed = RAPID if cycle.rapid_infeed else None
    return cycle.in_axes(around(cycle.across_along(x1, z1), shoulder_of(cycle, bevel), label="contour", infeed=infeed))


@CYCLES("G70", "Single longitudinal pass", runs="definition", source="NC-31 3.20.3")
class LongitudinalPass(FromStart):
    """In to X, along Z, up the bevel of P1 and P2, out along X to the start diameter, back at rapid.

    Start (X1, Z1); contour (X, Z1) to (X, Z + P2) to (X + P1, Z) to (X1, Z), with P1 and P2 towards the start. For
    finishing: a cone over the whole length has P2 as long as the pass.
    """

    x: float = param("X", TO_DIAMETER, "0.01 mm on diameter", note=FROM_START, example=3000)
    z: float = param("Z", "end of the pass", "0.01 mm", note=FROM_START, example=-2000)
    feed: float | None = feed_word("feed of the cycle")
    p1: float = size("size of the bevel along X", "0.01 mm on diameter", default=0, at_least=0, example=500)
    p2: float = size("size of the bevel along Z", default=0, at_least=0, example=500)
    rapid_infeed: float = rapid_mark("infeed at rapid")

    check, moves = check_pass, single_pass


@CYCLES("G71", "Single transverse pass", runs="definition", source="NC-31 3.20.4")
class TransversePass(FromStart):
    """In to Z, along X, up the bevel of P1 and P2, out along Z to the start, back at rapid: G70 with the axes exchanged.

    Contour (X1, Z) to (X + P1, Z) to (X, Z + P2) to (X, Z1), with P1 and P2 towards the start.
    """

    x: float = param("X", TO_DIAMETER, "0.01 mm on diameter", note=FROM_START, example=3000)
    z: float = param("Z", "end of the pass", "0.01 mm", note=FROM_START, example=-100)
    feed: float | None = feed_word("feed of the cycle")
    p1: float = size("size of the bevel along X", "0.01 mm on diameter", default=0, at_least=0, example=500)
    p2: float = size("size of the bevel along Z", default=0, at_least=0, example=100)
    rapid_infeed: float = rapid_mark("infeed at rapid")

    transverse = True
    check, moves = check_pass, single_pass


def depth_of(cycle: Roughing, m: Machine) -> float:
    """P1 in mm of tool travel."""
    if cycle.transverse:
        return cycle.stock_per_pass / discretes.Z
    return cycle.stock_per_pass * (2 if m.settings["p1_on_radius"] else 1) / discretes.X


def contour_of(cycle: Roughing, m: Machine) -> tuple[tuple[float, float], Shoulder]:
    """Start and contour as (across, along), mm."""
    x1, z1 = start(m)
    bevel = x1, back(cycle.z, cycle.bevel, z1, discretes.Z)
    if bevel_along_x(cycle, m):
        bevel = back(cycle.x, cycle.bevel, x1, discretes.X), z1
    return cycle.across_along(x1, z1), shoulder_of(cycle, bevel)


def bevel_along_x(cycle: Roughing, m: Machine) -> bool:
    """Whether the bevel of G78 counts along X."""
    return cycle.transverse and m.settings["g78_bevel"] == "along_x"


def check_roughing(cycle: Roughing, m: Machine) -> Iterator[tuple[str, str]]:
    """Something to remove, a bevel that fits, a machine parameter that can be used, a feed for the clean-up."""
    if bevel_along_x(cycle, m):
        yield from too_far("bevel", cycle.bevel, abs(here(m)[0] - cycle.x))
    yield from apart(cycle.x, cycle.z, m)
    yield from too_far("bevel", cycle.bevel, abs(here(m)[1] - cycle.z))
    begin, shoulder = contour_of(cycle, m)
    passes = count_of_levels(begin[0], shoulder.finish, depth_of(cycle, m))
    if passes > MOST_PASSES:
        yield "stock_per_pass", f"{cycle.stock_per_pass:.10g} gives {passes} passes, allowed are {MOST_PASSES}"
    breaks = passes * count_of_breaks(begin[1], shoulder.far, m.settings["parameter_10"] / discretes.TRAVEL)
    if breaks > 10 * MOST_PASSES:
        yield "", f"would break the chip {breaks} times: machine parameter 10 is too small"
    if m.feed is None:
        yield "", "needs a feed F before it, for the clean-up pass"


def rough(cycle: Roughing, m: Machine) -> Iterable[Step]:
    """Roughing passes, clean-up, return."""
    return cycle.in_axes(passes_and_clean_up(cycle, m, m.feed))


def passes_and_clean_up(cycle: Roughing, m: Machine, modal: float | None) -> Iterator[Step]:
    """Roughing passes at the feed of the cycle, the clean-up at the `modal` one."""
    begin, shoulder = contour_of(cycle, m)
    passes = roughing(begin[0], shoulder, depth_of(cycle, m))
    chip, retract = (m.settings[f"parameter_{n}"] / discretes.TRAVEL for n in (10, 11))
    infeed = RAPID if cycle.rapid_infeed else None
    yield from loops(begin, passes, infeed=infeed, chip=chip, chip_retract=retract)
    if cycle.feed is not None:
        yield Write("feed", modal)
    yield from around(begin, shoulder, label="clean-up", infeed=infeed)
    if cycle.to_contour:
        yield Go("to point B", x=shoulder.finish)


@CYCLES("G77", "Longitudinal roughing in passes", runs="definition", source="NC-31 3.20.5")
class LongitudinalRoughing(FromStart):
    """Passes along Z from the start diameter to X, each stopping at the bevel; a clean-up along the contour ends it.

    Start (X1, Z1); contour (X, Z1) to (X, Z + P2), then straight to (X1, Z). Roughing passes lie P1 apart while at
    least P1 is left; each ends with 0.5 mm off the contour and back to Z1. Machine parameters 10 and 11 break the chip
    there: after every length of cut a rapid retract. The clean-up, at the feed set before the cycle, has no breaks.
    """

    x: float = param("X", TO_DIAMETER, "0.01 mm on diameter", note=FROM_START, example=3000)
    z: float = param("Z", "end of the passes", "0.01 mm", note=FROM_START, example=-2000)
    feed: float | None = feed_word("feed of the roughing passes")
    stock_per_pass: float = size("stock removed per pass", "0.01 mm on diameter", above=0, example=200)
    bevel: float = size("size of the bevel along Z", default=0, at_least=0, example=500)
    rapid_infeed: float = rapid_mark("infeed at rapid")
    to_contour: float = targets.own_mark("ends at point B (X, Z1) instead of the start")

    check, moves = check_roughing, rough


@CYCLES("G78", "Transverse roughing in passes", runs="definition", source="NC-31 3.20.6")
class TransverseRoughing(FromStart):
    """Passes along X from the start to Z, each stopping at the contour; a clean-up along it ends the cycle.

    Start (X1, Z1); contour (X1, Z) straight to (X, Z + P2), then along Z to (X, Z1): a conical face, for the source says
    that the bevel is along Z here too. The setting `g78_bevel` makes it G77 with the axes exchanged. Chips are broken
    by machine parameters 10 and 11, in true travel of the tool.
    """

    x: float = param("X", TO_DIAMETER, "0.01 mm on diameter", note=FROM_START, example=3000)
    z: float = param("Z", "end of the passes", "0.01 mm", note=FROM_START, example=-500)
    feed: float | None = feed_word("feed of the roughing passes")
    stock_per_pass: float = size("stock removed per pass along Z", above=0, example=200)
    bevel: float = size("size of the bevel along Z", default=0, at_least=0, example=400)
    rapid_infeed: float = rapid_mark("infeed at rapid")
    to_contour: float = targets.own_mark("ends at point B (X1, Z) instead of the start")
    transverse = True
    check, moves = check_roughing, rough


LatheCut = LongitudinalPass | TransversePass | LongitudinalRoughing | TransverseRoughing
Roughing = LongitudinalRoughing | TransverseRoughing
