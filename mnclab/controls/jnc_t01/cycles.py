"""Cycles of one block: deep-hole drilling G73, grooves G74 and G75, stock removal G77 and G78.

All begin where the tool stands, at (X1, Z1), and end there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from mnclab.controls.jnc_t01.functions import coordinate, cutting_feed, scale, standing_feed, use_corrector
from mnclab.machine.cycle import Cycle, CycleTable, Given, Values, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import MOST, infeeds
from mnclab.machining.holes import drill
from mnclab.machining.steps import RAPID, Go, Say, Step
from mnclab.machining.turning.roughing import Crosswise, Shoulder, grooves, places, remove_stock

CYCLES = CycleTable()
INCREMENT = "under G91 from the start"
ACROSS = f"a radius, under the setting diameter a diameter; {INCREMENT}"  # of X and U


def optional(address: str, meaning: str, left_out: str, example: float) -> Any:
    """A coordinate, and in words what it is where it is left out."""
    note = ACROSS if address in "XU" else INCREMENT
    return param(address, meaning, default=None, default_means=left_out, note=note, example=example)


def pass_of(meaning: str, left_out: str, example: float = 6) -> Any:
    """D: the depth of a pass, or the way to the next one."""
    return param("D", meaning, default=None, default_means=left_out, above=0, incremental=True, example=example)


class LatheCycle(Crosswise, Cycle):
    """What all share: X, Z, U and W become coordinates of the tool, X and U on the radius."""

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        """Increments and diameters become coordinates; a corrector chosen before counts from now on."""
        for name, word in given.items():
            if word.address in "XZUW":
                values[name] = coordinate(m, word.address, values[name])
        use_corrector(m)
        return values

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        cutting_feed(m, None)
        yield from ()


@CYCLES("G73", "Deep-hole drilling", runs="definition", source="JNC-T01 8.9")
class DeepHoleDrilling(LatheCycle):
    """Drills along Z at the present X, out to the start after each pass; from the second pass on it returns at rapid to R
    before the depth reached. Each pass makes the hole D deeper, the last one the remainder."""

    bottom: float = param("Z", "bottom of the hole", note=INCREMENT, example=-40)
    peck: float | None = pass_of("depth drilled in a pass", "the whole depth", 15)
    clearance: float = param(
        "R", "distance from the depth reached at the return", default=0, at_least=0, incremental=True, example=5
    )

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from too_many("peck", lambda: infeeds(m.programmed[2], self.bottom, self.peck))
        yield from super().check(m)

    def moves(self, m: Machine) -> Iterator[Step]:
        start, feed = m.programmed[2], standing_feed(m)
        if self.bottom == start:
            yield Say(f"Z (bottom of the hole) is where the tool stands, Z{start:g}: nothing is drilled")
            return
        levels = infeeds(start, self.bottom, self.peck)
        yield from drill(levels, above=start, feed=feed, reenter=self.clearance)
        yield Go("retract", start)


def cuts(cycle: FaceGrooves | CylindricalGrooves, m: Machine) -> tuple[float, ...]:
    """Where to plunge, along the cut."""
    _, start = cycle.across_along(m.programmed[0], m.programmed[2])
    last = cycle.last_x if isinstance(cycle, FaceGrooves) else cycle.last_z
    return places(start, start if last is None else last, cycle.step)


def check_grooves(cycle: FaceGrooves | CylindricalGrooves, m: Machine) -> Iterator[tuple[str, str]]:
    """Not too many cuts."""
    yield from too_many("step", lambda: cuts(cycle, m))
    yield from LatheCycle.check(cycle, m)


def plunge(cycle: FaceGrooves | CylindricalGrooves, m: Machine) -> Iterable[Step]:
    """Grooves side by side."""
    across, _ = cycle.across_along(m.programmed[0], m.programmed[2])
    return cycle.in_axes(grooves(across, cycle.bottom, cuts(cycle, m), feed=standing_feed(m)))


@CYCLES("G74", "Face grooves", runs="definition", source="JNC-T01 8.10")
class FaceGrooves(LatheCycle):
    """Plunges along Z at X1 and at places D apart, the last one at X; between them it returns to Z1 at rapid."""

    bottom: float = param("Z", "bottom of the groove", note=INCREMENT, example=-20)
    last_x: float | None = optional("X", "place of the last groove or cut", "one groove at the present X", 20)
    step: float | None = pass_of("step between the cuts", "two cuts, at X1 and at X")

    transverse = True
    check, moves = check_grooves, plunge


@CYCLES("G75", "Cylindrical grooves", runs="definition", source="JNC-T01 8.11")
class CylindricalGrooves(LatheCycle):
    """Plunges along X at Z1 and at places D apart, the last one at Z; between them it returns to X1 at rapid."""

    bottom: float = param("X", "bottom of the groove", note=ACROSS, example=25)
    last_z: float | None = optional("Z", "place of the last groove or cut", "one groove at the present Z", -15)
    step: float | None = pass_of("step between the cuts", "two cuts, at Z1 and at Z")

    check, moves = check_grooves, plunge


def check_removal(cycle: LongitudinalTurning | Facing, m: Machine) -> Iterator[tuple[str, str]]:
    """Something to cut on both axes, the taper in between, and not too many passes."""
    x1, _, z1 = m.programmed
    infeed = "Z" if cycle.transverse else "X"
    ways = ("x", "X", x1, cycle.end_x, cycle.taper_x), ("z", "Z", z1, cycle.end_z, cycle.taper_z)
    for name, axis, start, end, taper in ways:
        factor = scale(m, axis)
        if start == end:
            yield f"end_{name}", f"must differ from the {axis} of the start, got {end / factor:.10g}"
        if taper is not None and not min(start, end) <= taper <= max(start, end):
            between = f"{axis}{start / factor:.10g} (the start) and {axis}{end / factor:.10g} ({axis} of this block)"
            yield f"taper_{name}", f"must lie between {between}, got {taper / factor:.10g}"
        if axis == infeed and cycle.depth is not None and abs(end - start) > MOST * cycle.depth:
            yield "depth", f"{cycle.depth:g} divides {abs(end - start):g} mm into more than {MOST} passes"
    yield from LatheCycle.check(cycle, m)


def removal(cycle: LongitudinalTurning | Facing, m: Machine) -> Iterator[Step]:
    """Infeed across, cuts along; the taper goes through U and W."""
    x1, _, z1 = m.programmed
    finish, far = cycle.across_along(cycle.end_x, cycle.end_z)
    taper = x1 if cycle.taper_x is None else cycle.taper_x, z1 if cycle.taper_z is None else cycle.taper_z
    rim, corner = cycle.across_along(*taper)
    retract, feed = m.settings["retract"], standing_feed(m)
    wall = RAPID if m.settings["wall"] == "rapid" else feed
    shoulder, start = Shoulder(finish, corner, rim, far), cycle.across_along(x1, z1)
    if cycle.taper_x is None and cycle.taper_z is None:
        yield Say("without U and W the taper begins at the start: a cone is cut (U = X and W = Z make a square shoulder)")
    yield from cycle.in_axes(remove_stock(start, shoulder, cycle.depth, retract=retract, feed=feed, wall=wall))


@CYCLES("G77", "Longitudinal turning", runs="definition", source="JNC-T01 8.12")
class LongitudinalTurning(LatheCycle):
    """Passes along Z, D deep, each up to the contour (X, Z1), (X, W), (U, Z), (X1, Z); the last one is cut along it.

    U = X and W = Z make a square shoulder, neither of them a cone from the start to (X1, Z). Each pass ends with a retract
    both ways; the infeeds, the way from (U, Z) to (X1, Z) and the returns are at rapid.
    """

    end_x: float = param("X", "end of the cut along X", note=ACROSS, example=20)
    end_z: float = param("Z", "end of the cut along Z", note=INCREMENT, example=-75)
    taper_x: float | None = optional("U", "X of the taper", "X of the start", 30)
    taper_z: float | None = optional("W", "Z of the taper", "Z of the start", -60)
    depth: float | None = pass_of("depth of cut", "the contour alone")

    check, moves = check_removal, removal


@CYCLES("G78", "Facing", runs="definition", source="JNC-T01 8.13")
class Facing(LatheCycle):
    """Passes along X, D deep, each up to the contour (X1, Z), (U, Z), (X, W), (X, Z1); the last one is cut along it.

    U = X and W = Z make a square shoulder, neither of them a cone from the start to (X, Z1). Each pass ends with a retract
    both ways; the infeeds, the way from (X, W) to (X, Z1) and the returns are at rapid.
    """

    end_x: float = param("X", "end of the cut along X", note=ACROSS, example=20)
    end_z: float = param("Z", "end of the cut along Z", note=INCREMENT, example=-75)
    taper_x: float | None = optional("U", "X of the taper", "X of the start", 30)
    taper_z: float | None = optional("W", "Z of the taper", "Z of the start", -60)
    depth: float | None = pass_of("depth of cut", "the contour alone", 5)  # a pass at W: the wall is free up to there

    transverse = True
    check, moves = check_removal, removal
