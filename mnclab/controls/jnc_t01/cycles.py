"""Cycles of one block: deep-hole drilling G73, grooves G74 and G75, stock removal G77 and G78.

All begin where the tool stands, at (X1, Z1), and end there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from mnclab.controls.jnc_t01.feeds import cutting_feed
from mnclab.controls.jnc_t01.motion import coordinate, scale, use_corrector
from mnclab.machine.cycle import Cycle, CycleTable, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import MOST, infeeds
from mnclab.machining.holes.drilling import drill
from mnclab.machining.steps import RAPID, Go, Step
from mnclab.machining.turning.grooving import grooves, places
from mnclab.machining.turning.shoulders import Shoulder, facing, remove_stock
from mnclab.running.performing import perform
from mnclab.text.program import Word

CYCLES = CycleTable()
INCREMENT = "under G91 from the start"


@dataclass(frozen=True)
class LatheCycle(Cycle):
    """What all share: X, Z, U and W become coordinates of the tool, X and U on the radius."""

    @classmethod
    def prepare(
        cls, values: dict[str, Any], given: Mapping[str, Word], m: Machine, kept: dict[str, Any]
    ) -> dict[str, Any]:
        """Increments and diameters become coordinates."""
        for name, word in given.items():
            if word.address in "XZUW":
                values[name] = coordinate(m, word.address, values[name])
        return values

    def moves(self, m: Machine) -> None:
        """The steps, after the offsets of the corrector."""
        feed = cutting_feed(m, None)
        use_corrector(m)
        perform(m, self.code, self.work(m, feed), about=(0.0, 0.0))

    def work(self, m: Machine, feed: float | None) -> Iterable[Step]:
        """The steps from the start and back to it, cut at a feed (None: the modal one)."""
        return ()


@CYCLES("G73", "Deep-hole drilling", runs="definition", source="JNC-T01 8.9")
class DeepHoleDrilling(LatheCycle):
    """Drills along Z at the present X, out to the start after each pass; from the second pass on it returns at rapid to R
    before the depth reached. Each pass makes the hole D deeper, the last one the remainder."""

    bottom: float = param("Z", "bottom of the hole", note=INCREMENT, example=-40)
    peck: float | None = param(
        "D",
        "depth drilled in a pass",
        default=None,
        default_means="the whole depth",
        above=0,
        incremental=True,
        example=15,
    )
    clearance: float = param(
        "R", "distance from the depth reached at the return", default=0, at_least=0, incremental=True, example=5
    )

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Not too many passes."""
        yield from too_many("peck", lambda: infeeds(m.programmed[2], self.bottom, self.peck))

    def work(self, m: Machine, feed: float | None) -> Iterator[Step]:
        """Passes, and the return."""
        start = m.programmed[2]
        if self.bottom == start:
            m.warn(f"G73 Z (bottom of the hole) is where the tool stands, Z{start:g}: nothing is drilled")
            return
        levels = infeeds(start, self.bottom, self.peck)
        yield from drill(levels, above=start, feed=feed, reenter=self.clearance)
        yield Go("retract", start)


@CYCLES("G74", "Face grooves", runs="definition", source="JNC-T01 8.10")
class FaceGrooves(LatheCycle):
    """Plunges along Z at X1 and at places D apart, the last one at X; between them it returns to Z1 at rapid."""

    bottom: float = param("Z", "bottom of the groove", note=INCREMENT, example=-30)
    last_x: float | None = param(
        "X", "place of the last groove or cut", default=None, default_means="one groove at the present X", note=INCREMENT,
        example=20,
    )  # fmt: skip
    step: float | None = param(
        "D", "step between the cuts", default=None, default_means="two cuts, at X1 and at X", above=0, incremental=True,
        example=6,
    )  # fmt: skip

    def cuts(self, m: Machine) -> tuple[float, ...]:
        """Places along X."""
        start = m.programmed[0]
        return places(start, start if self.last_x is None else self.last_x, self.step)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Not too many cuts."""
        yield from too_many("step", lambda: self.cuts(m))

    def work(self, m: Machine, feed: float | None) -> Iterator[Step]:
        """Grooves across Z, side by side along X."""
        return facing(grooves(m.programmed[2], self.bottom, self.cuts(m), feed))


@CYCLES("G75", "Cylindrical grooves", runs="definition", source="JNC-T01 8.11")
class CylindricalGrooves(LatheCycle):
    """Plunges along X at Z1 and at places D apart, the last one at Z; between them it returns to X1 at rapid."""

    bottom: float = param("X", "bottom of the groove", note=INCREMENT, example=25)
    last_z: float | None = param(
        "Z", "place of the last groove or cut", default=None, default_means="one groove at the present Z", note=INCREMENT,
        example=-15,
    )  # fmt: skip
    step: float | None = param(
        "D", "step between the cuts", default=None, default_means="two cuts, at Z1 and at Z", above=0, incremental=True,
        example=6,
    )  # fmt: skip

    def cuts(self, m: Machine) -> tuple[float, ...]:
        """Places along Z."""
        start = m.programmed[2]
        return places(start, start if self.last_z is None else self.last_z, self.step)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Not too many cuts."""
        yield from too_many("step", lambda: self.cuts(m))

    def work(self, m: Machine, feed: float | None) -> Iterator[Step]:
        """Grooves across X, side by side along Z."""
        return grooves(m.programmed[0], self.bottom, self.cuts(m), feed)


@dataclass(frozen=True)
class StockRemoval(LatheCycle):
    """Between the start and (X, Z); the bevel goes through U and W, which are the start where they are left out."""

    end_x: float = param("X", "end of the cut along X", note=INCREMENT, example=20)
    end_z: float = param("Z", "end of the cut along Z", note=INCREMENT, example=-75)
    taper_x: float | None = param(
        "U", "X of the bevel", default=None, default_means="X of the start", note=INCREMENT, example=30
    )
    taper_z: float | None = param(
        "W", "Z of the bevel", default=None, default_means="Z of the start", note=INCREMENT, example=-60
    )
    depth: float | None = param(
        "D", "depth of cut", default=None, default_means="the contour alone", above=0, incremental=True, example=6
    )

    across = "X"  # the axis of the infeed

    def bevel(self, m: Machine) -> tuple[float, float]:
        """U and W."""
        x1, _, z1 = m.programmed
        return x1 if self.taper_x is None else self.taper_x, z1 if self.taper_z is None else self.taper_z

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """Something to cut on both axes, the bevel in between, and not too many passes."""
        x1, _, z1 = m.programmed
        ways = ("x", "X", x1, self.end_x, self.taper_x), ("z", "Z", z1, self.end_z, self.taper_z)
        for name, axis, start, end, taper in ways:
            factor = scale(m, axis)
            if start == end:
                yield f"end_{name}", f"must differ from the {axis} of the start, got {end / factor:.10g}"
            if taper is not None and not min(start, end) <= taper <= max(start, end):
                between = f"{axis}{start / factor:.10g} and {axis}{end / factor:.10g}"
                yield f"taper_{name}", f"must lie between {between}, got {taper / factor:.10g}"
            if axis == self.across and self.depth is not None and abs(end - start) > MOST * self.depth:
                yield "depth", f"{self.depth:g} divides {abs(end - start):g} mm into more than {MOST} passes"

    def wall(self, m: Machine, feed: float | None) -> float | None:
        """The feed from point 4 to point 5."""
        return RAPID if m.settings["wall"] == "rapid" else feed


@CYCLES("G77", "Longitudinal turning", runs="definition", source="JNC-T01 8.12")
class LongitudinalTurning(StockRemoval):
    """Passes along Z, D deep, each up to the contour (X, Z1), (X, W), (U, Z), (X1, Z); the last one is cut along it.

    U = X and W = Z make a square shoulder, neither of them a cone from the start to (X1, Z). Each pass ends with a retract
    both ways; the infeeds, the way from (U, Z) to (X1, Z) and the returns are at rapid.
    """

    def work(self, m: Machine, feed: float | None) -> Iterator[Step]:
        """Infeed across X, cuts along Z."""
        (x1, _, z1), (u, w) = m.programmed, self.bevel(m)
        shoulder = Shoulder(finish=self.end_x, corner=w, rim=u, far=self.end_z)
        retract, wall = m.settings["retract"], self.wall(m, feed)
        return remove_stock((x1, z1), shoulder, self.depth, retract=retract, feed=feed, wall=wall)


@CYCLES("G78", "Facing", runs="definition", source="JNC-T01 8.13")
class Facing(StockRemoval):
    """Passes along X, D deep, each up to the contour (X1, Z), (U, Z), (X, W), (X, Z1); the last one is cut along it.

    U = X and W = Z make a square shoulder, neither of them a cone from the start to (X, Z1). Each pass ends with a retract
    both ways; the infeeds, the way from (X, W) to (X, Z1) and the returns are at rapid.
    """

    across = "Z"

    def work(self, m: Machine, feed: float | None) -> Iterator[Step]:
        """Infeed across Z, cuts along X."""
        (x1, _, z1), (u, w) = m.programmed, self.bevel(m)
        shoulder = Shoulder(finish=self.end_z, corner=u, rim=w, far=self.end_x)
        retract, wall = m.settings["retract"], self.wall(m, feed)
        return facing(remove_stock((z1, x1), shoulder, self.depth, retract=retract, feed=feed, wall=wall))
