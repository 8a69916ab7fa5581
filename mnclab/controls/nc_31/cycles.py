"""Cycles of the NC-31: stock removal, grooves and deep holes (source, 3.20.3 to 3.20.10), and what they have alike."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Any

from mnclab.controls.nc_31 import functions
from mnclab.controls.nc_31.functions import refuse_rapid
from mnclab.machine.cycle import Cycle, CycleTable, Given, Values, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.holes import drill
from mnclab.machining.steps import RAPID, Go, Step, Write
from mnclab.machining.turning.roughing import (
    Crosswise,
    Shoulder,
    around,
    count_of_breaks,
    count_of_levels,
    grooves,
    loops,
    places,
    roughing,
)
from mnclab.text.program import INCREMENTAL, RAPID_MARK

# What the cycles have alike: X and Z as coordinates or increments, the feed of a cycle, and the marks of their frames.

SWITCH = {0.0: "no", 1.0: "yes"}
FROM_START = "@: from the start point"


class FromStart(Crosswise, Cycle):
    """A cycle whose X and Z count from the start point where they have the mark @, with a feed of its own."""

    feed: float | None

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        ends = {name: given[name] for name in ("x", "z") if name in given}
        refuse_rapid(m, list(ends.values()), cls.code)
        for name, axis, scale in (("x", 0, functions.X), ("z", 2, functions.Z)):
            if name in ends and ends[name].incremental:
                values[name] += round(m.programmed[axis] * scale, 6)
        return values

    def modal_feed(self, m: Machine) -> float | None:
        """F of the cycle, mm/rev or mm."""
        return None if self.feed is None else self.feed / functions.CYCLE_FEED

    def needs_feed(self, m: Machine) -> Iterator[tuple[str, str]]:
        if self.feed is None and m.feed is None:
            yield "", "needs a feed: F here, or before it"


def start(m: Machine) -> tuple[float, float]:
    """The start point (X, Z) in mm, X on the radius."""
    return m.programmed[0], m.programmed[2]


def here(m: Machine) -> tuple[float, float]:
    """The start point in discretes: X on the diameter, Z."""
    return m.programmed[0] * functions.X, m.programmed[2] * functions.Z


def apart(x: float | None, z: float | None, m: Machine) -> Iterator[tuple[str, str]]:
    """Faults of ends that lie at the start."""
    x1, z1 = here(m)
    if x is not None and abs(x - x1) < 1e-6:
        yield "x", f"must differ from the start diameter, got {x:.10g}"
    if z is not None and abs(z - z1) < 1e-6:
        yield "z", f"must differ from the Z of the start, got {z:.10g}"


def aside(axis: str, meaning: str, left_out: str, example: float) -> Any:
    """Where the tool goes afterwards, if it does."""
    unit = "0.01 mm on diameter" if axis == "X" else "0.01 mm"
    return param(axis, meaning, unit, default=None, default_means=left_out, note=FROM_START, example=example)


def feed_word(meaning: str, unit: str = "0.0001 mm/rev", default: str = "the modal feed", example: float = 2000) -> Any:
    """F of a cycle: six digits, and left out what was set before it."""
    digits: dict[str, Any] = {"at_least": 1, "at_most": 999_999, "type": "integer"}
    return param("F", meaning, unit, default=None, default_means=default, example=example, **digits)


def size(meaning: str, unit: str = "0.01 mm", **options: Any) -> Any:
    """A P frame: a length of its own, never a coordinate."""
    return param("P", meaning, unit, incremental=True, type="integer", **options)


def rapid_mark(meaning: str) -> Any:
    """The mark ~ on the G frame."""
    return param("~", meaning, "mark", default=0, choices=SWITCH, mark=RAPID_MARK, example=1)


def own_mark(meaning: str, **options: Any) -> Any:
    """The mark @ on the G frame, where it means something of its own."""
    return param("@", meaning, "mark", default=0, choices=SWITCH, mark=INCREMENTAL, **options)


# Removing stock: one pass G70, G71, and roughing in passes G77, G78 (source, 3.20.3 to 3.20.6).
# G71 and G78 are G70 and G77 with the axes exchanged. The figures of the source are lost: the bevel and the way back are
# readings (a closed cycle from its start point, with the shoulder faced on the way out).

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
    across, along = cycle.across_along(cycle.x / functions.X, cycle.z / functions.Z)
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
    bevel = back(cycle.x, cycle.p1, x1, functions.X), back(cycle.z, cycle.p2, z1, functions.Z)
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
        return cycle.stock_per_pass / functions.Z
    return cycle.stock_per_pass * (2 if m.settings["p1_on_radius"] else 1) / functions.X


def contour_of(cycle: Roughing, m: Machine) -> tuple[tuple[float, float], Shoulder]:
    """Start and contour as (across, along), mm."""
    x1, z1 = start(m)
    bevel = x1, back(cycle.z, cycle.bevel, z1, functions.Z)
    if bevel_along_x(cycle, m):
        bevel = back(cycle.x, cycle.bevel, x1, functions.X), z1
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
    breaks = passes * count_of_breaks(begin[1], shoulder.far, m.settings["parameter_10"] / functions.TRAVEL)
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
    chip, retract = (m.settings[f"parameter_{n}"] / functions.TRAVEL for n in (10, 11))
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
    to_contour: float = own_mark("ends at point B (X, Z1) instead of the start")

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
    to_contour: float = own_mark("ends at point B (X1, Z) instead of the start")
    transverse = True
    check, moves = check_roughing, rough


LatheCut = LongitudinalPass | TransversePass | LongitudinalRoughing | TransverseRoughing
Roughing = LongitudinalRoughing | TransverseRoughing


# Grooving cycles G74 and G75 (source, 3.20.9 and 3.20.10): one groove beside the other, or one wide groove.

FEED = "feed of the cycle"


def check_grooves(cycle: Grooving, m: Machine) -> Iterator[tuple[str, str]]:
    """A depth, a pitch that is not longer than the way to the last groove, not too many grooves."""
    x1, z1 = here(m)
    yield from apart(None, cycle.z, m) if cycle.transverse else apart(cycle.x, None, m)
    way, axis = (abs(cycle.x - x1), "X") if cycle.transverse else (abs(cycle.z - z1), "Z")
    if cycle.pitch > way * (1 + 1e-9):
        yield "pitch", f"must be at most {way:.10g}, the way along {axis} to the last groove, got {cycle.pitch:.10g}"
    yield from too_many("pitch", lambda: places(0, way, cycle.pitch))
    yield from cycle.needs_feed(m)


def plunge(cycle: Grooving, m: Machine) -> Iterable[Step]:
    """The grooves, then back to the start."""
    across, along = cycle.across_along(*start(m))
    bottom, last = cycle.across_along(cycle.x / functions.X, cycle.z / functions.Z)
    pitch = cycle.pitch / (functions.X if cycle.transverse else functions.Z)
    shift = RAPID if cycle.rapid_step else None
    return cycle.in_axes(grooves(across, bottom, places(along, last, pitch), shift=shift))


@CYCLES("G74", "Face grooving in cuts", runs="definition", source="NC-31 3.20.9")
class FaceGrooving(FromStart):
    """Plunges along Z, P apart along X, the first at the start and the last at X; back at rapid after each.

    Concentric grooves, or one wide groove where P is less than the width of the tool. Ends at the start point.
    """

    x: float = param("X", "start of the last groove", "0.01 mm on diameter", note=FROM_START, example=2000)
    z: float = param("Z", "bottom of the groove", "0.01 mm", note=FROM_START, example=-500)
    feed: float | None = feed_word(FEED)
    pitch: float = size("pitch of the grooves", "0.01 mm on diameter", above=0, example=600)
    rapid_step: float = rapid_mark("side step at rapid")

    transverse = True
    check, moves = check_grooves, plunge


@CYCLES("G75", "Cylindrical grooving in cuts", runs="definition", source="NC-31 3.20.10")
class CylindricalGrooving(FromStart):
    """Plunges along X, P apart along Z, the first at the start and the last at Z; back at rapid after each.

    A group of grooves, or one wide groove where P is less than the width of the tool. Ends at the start point.
    """

    x: float = param("X", "bottom of the groove", "0.01 mm on diameter", note=FROM_START, example=3000)
    z: float = param("Z", "start of the last groove", "0.01 mm", note=FROM_START, example=-1500)
    feed: float | None = feed_word(FEED)
    pitch: float = size("pitch of the grooves", above=0, example=500)
    rapid_step: float = rapid_mark("side step at rapid")

    check, moves = check_grooves, plunge


Grooving = FaceGrooving | CylindricalGrooving


# Deep-hole drilling G73 along Z and G72 along X (source, 3.20.7).

AFTER = "left out: it stays on the axis of the hole"


def faults(cycle: FromStart, m: Machine, peck: float, depth: float) -> Iterator[tuple[str, str]]:
    """A peck that is not deeper than the hole, not too many of them, and a feed."""
    if peck > depth * (1 + 1e-9):
        yield "peck", f"must be at most {depth:.10g}, the depth of the hole, got {peck:.10g}"
    yield from too_many("peck", lambda: infeeds(0, depth, peck))
    yield from cycle.needs_feed(m)


def deep_hole(m: Machine, begin: float, bottom: float, peck: float, after: float | None) -> Iterator[Step]:
    """Drill along in pecks, each from a gap before the last depth, each followed by a retract to the start; then aside."""
    gap = m.settings["parameter_8"] / functions.TRAVEL
    yield from drill(infeeds(begin, bottom, peck), above=begin, feed=None, reenter=gap)
    yield Go("retract", begin)
    if after is not None:
        yield Go("aside", x=after)


@CYCLES("G73", "Deep-hole drilling", runs="definition", source="NC-31 3.20.7")
class DeepDrilling(FromStart):
    """Pecks of P along Z to the bottom, the last one the rest; after each a retract to the start point at rapid.

    The drill returns at rapid to where it was interrupted but for a gap, machine parameter 8. Then, where X is given, it
    goes there at rapid.
    """

    x: float | None = aside("X", "X of the drill afterwards", AFTER, 6000)
    z: float = param("Z", "bottom of the hole", "0.01 mm", note=FROM_START, example=-3000)
    feed: float | None = feed_word("feed of the cycle")
    peck: float = size("depth drilled per pass", above=0, example=1000)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from apart(None, self.z, m)
        yield from faults(self, m, self.peck, abs(self.z - here(m)[1]))

    def moves(self, m: Machine) -> Iterable[Step]:
        after = None if self.x is None else self.x / functions.X
        return deep_hole(m, start(m)[1], self.z / functions.Z, self.peck / functions.Z, after)


@CYCLES("G72", "Deep-hole drilling along X", runs="definition", source="NC-31 3.20.7")
class RadialDrilling(FromStart):
    """G73 with the axes exchanged: pecks of P along X; then, where Z is given, to Z at rapid.

    P counts on the diameter (setting `p1_on_radius`), machine parameter 8 in true travel of the tool.
    """

    x: float = param("X", "bottom of the hole", "0.01 mm on diameter", note=FROM_START, example=2000)
    z: float | None = aside("Z", "Z of the drill afterwards", AFTER, 1000)
    feed: float | None = feed_word("feed of the cycle")
    peck: float = size("depth drilled per pass", "0.01 mm on diameter", above=0, example=600)

    transverse = True

    def depth(self, m: Machine) -> float:
        """P in discretes on the diameter."""
        return self.peck * (2 if m.settings["p1_on_radius"] else 1)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from apart(self.x, None, m)
        yield from faults(self, m, self.depth(m), abs(self.x - here(m)[0]))

    def moves(self, m: Machine) -> Iterable[Step]:
        after = None if self.z is None else self.z / functions.Z
        return self.in_axes(deep_hole(m, start(m)[0], self.x / functions.X, self.depth(m) / functions.X, after))
