"""Drilling cycles (chapter 4).

Planes in the tool axis: S the surface Q203, A = S + Q200 the set-up plane, B the bottom, E the plane at the end of the
cycle. With a positive depth the cycle works upwards, where the setting "depth_error" allows it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.machine.cycle import Cycle, CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.performing import perform
from mnclab.machining.depths import infeeds
from mnclab.machining.holes import drill
from mnclab.machining.steps import Go

CYCLES = CycleTable()


@CYCLES("CYCL DEF 200", "Drilling", runs="call", source="4.3")
class Drilling(Cycle):
    """Drills in infeeds with full retraction to the set-up plane, a dwell after each infeed, and a rapid to the end plane."""

    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    feed: float = addresses.plunge_feed()
    infeed: float = addresses.infeed()
    dwell_top: float = addresses.seconds("Q210", "dwell at the set-up clearance")
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance()
    dwell_bottom: float = addresses.dwell_bottom()
    reference: float = addresses.reference()

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """The sign of the depth, the point angle for Q395=1, a feed to drill with."""
        if self.depth > 0 and m.settings["depth_error"]:
            yield "depth", f"must be negative, got {self.depth:g}: a positive depth works upwards"
        if self.reference == 1 and not 0 < m.tool.angle < 180:
            yield "reference", f"needs the point angle of tool {m.tool.number} (T-ANGLE of the tool table)"
        yield from too_many("infeed", lambda: infeeds(0.0, self.depth, self.infeed))
        if self.feed == 0:
            yield "feed", "must be greater than 0 to drill with, got 0"

    def moves(self, m: Machine) -> None:
        """Set-up plane; infeed, dwell, set-up plane, dwell, back above the last depth; end plane."""
        if self.depth == 0:
            return  # not executed
        down = -math.copysign(1.0, self.depth)  # +1 downwards
        above = self.surface + down * self.clearance
        bottom = self.surface + self.depth - down * self.point(m)
        code = self.code
        perform(m, code, [Go("to the set-up clearance", above)])
        steps = drill(
            infeeds(self.surface, bottom, self.infeed or None), above=above, feed=self.feed, reenter=self.clearance,
            dwell_top=self.dwell_top, dwell_each=self.dwell_bottom, dwell_bottom=self.dwell_bottom,
        )  # fmt: skip
        perform(m, code, steps)
        self.leave(m, above, down)

    def point(self, m: Machine) -> float:
        """The length of the drill point, mm: half the diameter over the tangent of half the point angle."""
        return m.radius / math.tan(math.radians(m.tool.angle / 2)) if self.reference == 1 else 0.0

    def leave(self, m: Machine, above: float, down: float) -> None:
        """To the second set-up clearance if it is greater than the first, upwards drilling over the set-up plane."""
        end = self.surface + max(self.second_clearance, self.clearance)
        levels = [above, end] if down < 0 else [end]
        perform(m, self.code, [Go("retract", level) for level in levels])
