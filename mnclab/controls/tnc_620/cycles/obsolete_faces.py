"""Obsolete faces, which still run (1.2): multipass milling 230 of a level surface, and the ruled surface 231.

They are those of earlier manuals (TNC 426/430 8.8, iTNC 530). R is the tool radius. Readings where they are silent: the lines
of 230 lie evenly from R inside the near edge to R inside the far one, or as the setting "multipass" says; the first step of
231, at half the feed, is the way to point 1 and the first line; the way back of 231 runs a tool diameter over its line.
"""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import coordinate, increment, number
from mnclab.controls.tnc_620.cycles.planes import Fault, at_least, in_program_coordinates, not_zero, with_radius
from mnclab.controls.tnc_620.machining.ruled import mill_ruled, passes
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import MILLS
from mnclab.machine.cycle import Cycle, CycleTable, few_passes
from mnclab.machine.machine import Machine
from mnclab.machining.milling.faces import Layer, face, lines
from mnclab.machining.steps import Go, Say, Step

CYCLES = CycleTable()
SETTINGS = (
    Setting(
        "multipass", "within", "how far apart the lines of cycle 230 lie, of which the first is R inside the edge", "",
        {"within": "(Q219 - 2 R) / (Q240 - 1): the last one is R inside the far edge", "width": "Q219 / Q240: the whole width"},
    ),
)  # fmt: skip


@CYCLES("CYCL DEF 230", "Multipass milling", source="1.2")
class MultipassMilling(Cycle):
    """Mills a level surface once, on parallel lines to and fro."""

    does = MILLS
    about = in_program_coordinates
    start_1st_axis: float = coordinate("Q225", "starting point, first axis", example=10)
    start_2nd_axis: float = coordinate("Q226", "starting point, second axis", example=12)
    start_3rd_axis: float = coordinate("Q227", "coordinate of the milled surface", example=2.5)
    first_side_length: float = increment("Q218", "first side length", at_least=0, example=150)
    second_side_length: float = increment("Q219", "second side length", at_least=0, example=75)
    cuts: float = number("Q240", "number of cuts", note="over the width", example=10)
    plunging_feed: float = addresses.plunge_feed()
    milling_feed: float = addresses.milling_feed()
    stepover_feed: float = addresses.feed("Q209", "feed rate for the stepover", also=addresses.PLANE, example=200)
    clearance: float = addresses.clearance()

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from with_radius(m)
        yield from not_zero(self, "plunging_feed", "milling_feed", "stepover_feed", purpose="to mill with")
        yield from few_passes("cuts", 1, int(self.cuts))
        if self.cuts > 1:
            yield from at_least(self, "second_side_length", 2 * m.radius, "the tool diameter")

    def stepover(self, m: Machine) -> float:
        if m.settings["multipass"] == "width":
            return self.second_side_length / self.cuts
        return (self.second_side_length - 2 * m.radius) / (self.cuts - 1) if self.cuts > 1 else 0.0

    def moves(self, m: Machine) -> Iterator[Step]:
        step, first, above = self.stepover(m), self.start_2nd_axis + m.radius, self.start_3rd_axis + self.clearance
        if step > 2 * m.radius:
            yield Say(f"Q240={self.cuts:g} leaves strips between the lines, which are {step:g} mm apart")
        near, far = self.start_1st_axis - m.radius, self.start_1st_axis + self.first_side_length + m.radius
        way = lines([first + k * step for k in range(int(self.cuts))], near, far, m.radius)
        yield from face([Layer("", self.start_3rd_axis, way, self.milling_feed, self.stepover_feed, self.plunging_feed)], above)
        yield Go("retract", above)


@CYCLES("CYCL DEF 231", "Ruled surface", source="1.2")
class RuledSurface(Cycle):
    """Mills the surface between the lines 1-2 and 4-3 with the tip of the tool on straight lines, all the same way."""

    does = MILLS
    about = in_program_coordinates
    x_1: float = coordinate("Q225", "starting point, first axis", example=0)
    y_1: float = coordinate("Q226", "starting point, second axis", example=5)
    z_1: float = coordinate("Q227", "starting point, tool axis", example=-2)
    x_2: float = coordinate("Q228", "second point, first axis", example=100)
    y_2: float = coordinate("Q229", "second point, second axis", example=15)
    z_2: float = coordinate("Q230", "second point, tool axis", example=5)
    x_3: float = coordinate("Q231", "third point, first axis", example=95)
    y_3: float = coordinate("Q232", "third point, second axis", example=65)
    z_3: float = coordinate("Q233", "third point, tool axis", example=-1)
    x_4: float = coordinate("Q234", "fourth point, first axis", example=5)
    y_4: float = coordinate("Q235", "fourth point, second axis", example=70)
    z_4: float = coordinate("Q236", "fourth point, tool axis", example=3)
    cuts: float = number("Q240", "number of cuts", note="from 1-2 to 4-3", example=20)
    milling_feed: float = addresses.milling_feed()

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from with_radius(m)
        yield from not_zero(self, "milling_feed", purpose="to mill with")
        yield from few_passes("cuts", 1, int(self.cuts))

    def moves(self, m: Machine) -> Iterator[Step]:
        first, second = (self.x_1, self.y_1, self.z_1), (self.x_2, self.y_2, self.z_2)
        third, fourth = (self.x_3, self.y_3, self.z_3), (self.x_4, self.y_4, self.z_4)
        begins, ends = passes(first, second, third, fourth, int(self.cuts))
        return mill_ruled(begins, ends, 2 * m.radius, self.milling_feed, self.milling_feed / 2)
