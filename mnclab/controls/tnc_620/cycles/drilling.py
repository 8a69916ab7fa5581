"""Drilling cycles (chapter 4).

Planes in the tool axis: S the surface Q203, A = S + Q200 the set-up plane, B the bottom, E the plane at the end of the
cycle. With a positive depth the cycle works upwards, where the setting "depth_error" allows it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

from mnclab.machine.cycle import Cycle, CycleTable, param, too_many
from mnclab.machine.machine import Machine
from mnclab.machine.performing import perform
from mnclab.machining.depths import infeeds
from mnclab.machining.holes import drill
from mnclab.machining.steps import Go

CYCLES = CycleTable()
FAR = 99999.9999  # mm, the largest length of a cycle
TIP: dict[float, str] = {0: "depth refers to the tool tip", 1: "depth refers to the cylindrical part of the tool"}


@CYCLES("CYCL DEF 200", "Drilling", runs="call", source="4.3")
class Drilling(Cycle):
    """Drills in infeeds with full retraction to the set-up plane, a dwell after each infeed, and a rapid to the end plane."""

    clearance: float = param("Q200", "set-up clearance", at_least=0, at_most=FAR, incremental=True, modal=True)
    depth: float = param(
        "Q201", "depth", at_least=-FAR, at_most=FAR, incremental=True, modal=True, note="from the surface; negative is down"
    )  # fmt: skip
    feed: float = param(
        "Q206", "feed rate for plunging", "mm/min", at_least=0, at_most=99999.999, modal=True, also=("FAUTO", "FU")
    )
    infeed: float = param(
        "Q202", "infeed depth", at_least=0, at_most=FAR, incremental=True, modal=True, note="0: in one pass"
    )  # fmt: skip
    dwell_top: float = param("Q210", "dwell at the set-up clearance", "s", at_least=0, at_most=3600, modal=True)
    surface: float = param("Q203", "coordinate of the workpiece surface", at_least=-FAR, at_most=FAR, modal=True)
    second_clearance: float = param(
        "Q204", "second set-up clearance", at_least=0, at_most=FAR, incremental=True, modal=True, note="if greater than Q200"
    )  # fmt: skip
    dwell_bottom: float = param("Q211", "dwell at the bottom of each infeed", "s", at_least=0, at_most=3600, modal=True)
    reference: float = param("Q395", "depth reference", "choice", default=0, choices=TIP, modal=True)

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
