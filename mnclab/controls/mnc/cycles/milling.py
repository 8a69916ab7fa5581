"""What the milling cycles share (MNC, chapter 10), and facing: G320 and G321.

They run at once, in the block that they stand in; coordinates are absolute under G90 and G91 (MNC-MILL-ABS).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar

from mnclab.controls.mnc.cycles import addresses
from mnclab.controls.word_address.holes import out_of_place
from mnclab.machine.coordinates import MILLS, remark
from mnclab.machine.cycle import Cycle, CycleTable, few_passes, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import MOST
from mnclab.machining.milling.clearing import Clearing, numbered
from mnclab.machining.milling.face_lines import lines, rows
from mnclab.machining.milling.face_steps import Layer, face
from mnclab.machining.milling.residue import within
from mnclab.machining.steps import Go, Say, Step

CYCLES = CycleTable()
ORIGIN = (0.0, 0.0)
STRATEGY: dict[float, str] = {
    0: "meander, stepover outside the surface",
    1: "meander, stepover within the surface",
    2: "one way, back above the surface",
}


class MillingCycle(Cycle):
    """What all of them need of the machine: a tool with a radius, a feed, no radius compensation."""

    does: ClassVar[str] = MILLS

    feed: float | None

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from out_of_place(m)
        if m.radius <= 0:
            yield "", f"needs a tool with a radius, got {m.radius:g}"
        if self.feed is None and m.feed is None:
            yield "feed", "is missing, and no feed rate was programmed before"


@CYCLES("G320", "Line-by-line milling", runs="definition", source="MNC 10.1")
class LineMilling(MillingCycle):
    """Mills a surface at one height on a given number of lines along X, to and fro."""

    start_x: float = addresses.coordinate("X", "start corner along X", 0)
    start_y: float = addresses.coordinate("Y", "start corner along Y", 0)
    level: float = addresses.coordinate("Z", "height of the milled surface", -1)
    length_x: float = addresses.side("A", "length along X", 60)
    length_y: float = addresses.side("B", "length along Y", 40)
    passes: float = addresses.count("K", "number of lines", 6, note="0 mills nothing")
    plunge_feed: float = addresses.own_feed("V", "feed down to the height", 150)
    feed: float | None = addresses.feed("milling feed", example=500)
    stepover_feed: float | None = addresses.other_feed("T", "feed to the next line", 250)
    clearance: float = addresses.clearance(meaning="clearance above the milling height")

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if self.passes > MOST:
            yield "passes", f"must be at most {MOST}, got {self.passes:g}"

    def across(self, radius: float) -> tuple[float, ...]:
        """Where the lines lie: the first and the last one flush with the edges (MNC-G320-STEP)."""
        first, last, count = self.start_y + radius, self.start_y + self.length_y - radius, int(self.passes)
        if count == 1 or last <= first:
            return (first,)
        return tuple(first + (last - first) * k / (count - 1) for k in range(count))

    def remarks(self, radius: float) -> Iterator[str]:
        width, count = self.length_y, int(self.passes)
        if not count:
            yield "K (number of lines) is 0: nothing is milled"
        elif count > 1 and width <= 2 * radius:
            yield f"one line is as wide as B{width:g}: K{count} lines are not needed"
        elif count == 1 and width > 2 * radius:
            yield f"one line leaves strips uncut: B{width:g} is wider than the tool, {2 * radius:g} mm"
        elif count > 1 and (step := (width - 2 * radius) / (count - 1)) > 2 * radius:
            yield f"K{count} lines leave strips uncut: they lie {round(step, 3):g} mm apart, the tool is {2 * radius:g} mm wide"

    def about(self, m: Machine) -> tuple[float, float]:
        return ORIGIN

    def moves(self, m: Machine) -> Iterator[Step]:
        """Steps 1 to 7 of the manual; the tool stays at the clearance level."""
        radius, above = m.radius, self.level + self.clearance
        yield from (Say(sentence + remark(m)) for sentence in self.remarks(radius))
        if not self.passes:
            return
        passes = lines(self.across(radius), self.start_x - radius, self.start_x + self.length_x + radius, radius)
        layer = Layer("", self.level, passes, self.feed, self.stepover_feed or self.feed, self.plunge_feed)
        yield Go("to the clearance level", max(m.programmed[2], above))
        yield from face([layer], above)
        yield Go("to the clearance level", above)


@CYCLES("G321", "Face milling", runs="definition", source="MNC 10.2")
class FaceMilling(MillingCycle):
    """Mills a surface in several infeeds, the last of them a finishing cut; each level backwards over the one before."""

    strategy: float = addresses.choice("L", "machining strategy", STRATEGY, 0, default=0)
    start_x: float = addresses.coordinate("X", "start corner along X", 0)
    start_y: float = addresses.coordinate("Y", "start corner along Y", 0)
    level_from: float = addresses.coordinate("Z", "height from which to mill", 0)
    level_to: float = addresses.coordinate("W", "height down to which to mill", -5)
    length_x: float = addresses.side("A", "length along X", 60)
    length_y: float = addresses.side("B", "length along Y", 40)
    clearance: float = addresses.clearance(meaning="clearance above the milling height")
    max_infeed: float = addresses.distance("P", "greatest infeed", 2)
    overlap: float = addresses.overlap(1.999, 1.5)
    feed: float | None = addresses.feed("milling feed", example=500)
    positioning_feed: float = addresses.own_feed("V", "positioning feed", 2000)
    side_clearance: float = addresses.distance("I", "clearance at the side", 3)
    allowance: float = addresses.allowance("U", "finishing allowance", 0.5, note="the last infeed")
    finish_feed: float | None = addresses.other_feed("T", "finishing feed", 800)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        height = self.level_from - self.level_to
        if height < 0:
            yield "level_to", f"must not lie above Z, got W {self.level_to:g} and Z {self.level_from:g}"
        if self.allowance > height:
            yield "allowance", f"must be at most Z - W = {height:g}, got {self.allowance:g}"
        yield from too_many("max_infeed", self.levels)

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        yield from too_many("overlap", lambda: self.across(m.radius))
        yield from few_passes("max_infeed", len(self.levels()), len(self.across(m.radius)))

    def levels(self) -> tuple[float, ...]:
        """Equal infeeds down to the allowance, and then the allowance."""
        roughing = rows(self.level_from, self.level_to + self.allowance, self.max_infeed)[1:]
        return (*roughing, self.level_to) if self.allowance else roughing

    def across(self, radius: float) -> tuple[float, ...]:
        """Where the lines lie: flush with the edges, or in the middle of a narrow surface."""
        first, last = self.start_y + radius, self.start_y + self.length_y - radius
        if last <= first:
            return (self.start_y + self.length_y / 2,)
        return rows(first, last, self.overlap * radius)

    def clearings(self, radius: float) -> tuple[Clearing, Clearing]:
        """The lines of the first level, and those of all others, where a stepover within the surface stays in it."""
        across, outside = self.across(radius), radius + self.side_clearance
        left, right = self.start_x - outside, self.start_x + self.length_x + outside
        if self.strategy != 1:
            found = lines(across, left, right, radius, one_way=self.strategy == 2)
            return found, found
        near, far = self.start_x + radius, self.start_x + self.length_x - radius
        if far < near:  # narrower than the tool: up and down in the middle
            near = far = self.start_x + self.length_x / 2
        return lines(across, left, right, radius, within=(near, far)), lines(across, near, far, radius)

    def residue(self, radius: float) -> float:
        """What of the finished surface lines that end within it leave, mm² (MNC-G321-L1END)."""
        if self.strategy != 1:
            return 0.0
        return within(self.length_x, self.length_y, radius, self.across(radius), outside=len(self.levels()) == 1)

    def layers(self, radius: float) -> Iterator[Layer]:
        """Every second level backwards; the finishing infeed at its own feed."""
        first, other = self.clearings(radius)
        levels, inside = self.levels(), self.strategy == 1
        for k, (name, level) in enumerate(zip(numbered("layer", len(levels)), levels, strict=True)):
            finishing = bool(self.allowance) and k == len(levels) - 1
            feed = (self.finish_feed or self.feed) if finishing else self.feed
            passes = other.reversed() if k % 2 else other if k else first
            link = feed if inside else self.positioning_feed
            down = self.feed if inside and k else self.positioning_feed
            yield Layer("finishing" if finishing else name, level, passes, feed, link, down)

    def about(self, m: Machine) -> tuple[float, float]:
        return ORIGIN

    def moves(self, m: Machine) -> Iterator[Step]:
        if not self.levels():
            yield Say("Z and W are the same height: nothing is milled")
            return
        if (area := self.residue(m.radius) * m.scale**2) > 1e-9:
            where = "the lines end within it, in the corners and between two lines the tool is round"
            yield Say(f"L1 leaves {area:.3f} mm² of the surface uncut: {where}", "L0 and L2 mill all of it")
        above = self.level_from + self.clearance
        end = max(m.programmed[2], above)
        yield Go("to the clearance level", end)
        yield from face(list(self.layers(m.radius)), above, self.clearance)
        yield Go("to the start level", end)
