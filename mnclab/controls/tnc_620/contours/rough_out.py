"""Cycle 22: clearing a contour level by level (8.6); `milling.rings` does the geometry."""

from __future__ import annotations

from collections.abc import Iterator

from mnclab.controls.tnc_620.contours.area import contour_terraces
from mnclab.controls.tnc_620.contours.data import ContourData, contour_data, prepared
from mnclab.controls.tnc_620.contours.leaving import leave
from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAR, choice, count, increment, ratio
from mnclab.controls.tnc_620.cycles.faults import Fault, with_radius
from mnclab.controls.tnc_620.cycles.planes import in_program_coordinates, rate
from mnclab.geometry.regions import Region
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.machine import INF, Machine
from mnclab.machine.true_size import MILLS, remark
from mnclab.machining.milling.clearing import Clearing, numbered
from mnclab.machining.milling.residue import left_by
from mnclab.machining.milling.rings import rings
from mnclab.machining.milling.terraces import levels
from mnclab.machining.steps import Along, Go, Say, Step, Write

CYCLES = CycleTable()
STRATEGIES: dict[float, str] = {0: "along the contour at depth", 1: "retract between the areas"}


@CYCLES("CYCL DEF 22", "Rough-out", source="8.6")
class RoughOut(Cycle):
    """Clears the contour level by level, each from the inside outward, islands first; a mirror image keeps its climb (8.3)."""

    does = MILLS
    about = in_program_coordinates
    infeed: float = increment("Q10", "infeed per cut", example=5)
    plunge_feed: float = addresses.feed("Q11", "feed rate for plunging", also=addresses.PLANE, at_most=FAR, example=150)
    feed: float = addresses.feed("Q12", "feed rate for roughing", also=addresses.PLANE, at_most=FAR, example=500)
    coarse_tool: float = count(("Q18", "QS18"), "coarse roughing tool", type="text", default=0)
    swing_feed: float = addresses.feed("Q19", "feed rate for reciprocation", also=addresses.PLANE, at_most=FAR, example=0)
    retract_feed: float | str = addresses.retract_feed(at_most=None, default=INF, default_means="FMAX", note="", example=None)
    factor: float = ratio("Q401", "feed rate factor at full engagement", at_most=100, default=100)
    fine_strategy: float = choice("Q404", "fine roughing strategy", STRATEGIES, default=0)

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from prepared(m)
        if self.infeed == 0:
            yield "infeed", "must not be 0"
        if isinstance(self.retract_feed, float) and FAR < self.retract_feed < INF:
            yield "retract_feed", f"must be at most {FAR:.10g} or FMAX, got {self.retract_feed:g}"
        if self.coarse_tool:
            yield "coarse_tool", "other than 0, fine roughing, is not built yet"
        if self.factor != 100:
            yield "factor", f"other than 100 is not built yet, got {self.factor:g}"
        if self.swing_feed and not m.tool.plunge_angle:
            yield "swing_feed", "needs the plunge angle (ANGLE) of the tool in its table"
        if self.swing_feed and m.tool.plunge_angle != 90:
            yield "swing_feed", "other than 0, a helical or reciprocating plunge, is not built yet"
        yield from with_radius(m)

    def moves(self, m: Machine) -> Iterator[Step]:
        data, before = contour_data(m), m.programmed
        yield Write("memory", m.tool, "rough_out_tool")
        found = yield from contour_terraces(m, data)
        clearings = [clearing(self, m, data, terrace.region) for terrace in found]
        if data.overlap > 1:
            for terrace in found:
                yield from residue(m, terrace.region, data)
        plunge = self.swing_feed or self.plunge_feed
        heights = levels(found, data.surface, data.down, abs(self.infeed), data.floor_allowance)
        for label, level in zip(numbered("level", len(heights)), heights, strict=True):
            for piece in clearings[level.terrace].pieces:
                height = data.height  # for positioning (8.4), from above as from below: nothing stands in the way there
                for ring, linked in zip(piece.passes, (False, *piece.linked)):
                    x, y = ring.points[0].tolist()
                    if linked:
                        yield Go(label, x=x, y=y, feed=self.feed)
                    else:
                        yield Go(label, height)
                        yield Go(label, x=x, y=y)
                        yield Go(label, data.above)
                        yield Go(label, level.height, plunge)
                    yield Along(label, ring, self.feed)
                    height = data.above
        yield from leave(m, before, data.height, rate(self.retract_feed, self.feed))


def clearing(c: Cycle, m: Machine, data: ContourData, region: Region) -> Clearing:
    """The rings that clear an area up to the allowance for side; an Alarm where the tool does not fit."""
    try:
        return rings(
            region, m.radius, data.overlap * m.radius, allowance=data.side_allowance, climb=data.climb(m),
            corner_radius=data.corner,
        )  # fmt: skip
    except ValueError as error:
        m.alarm(f"{c.code}: {error}{remark(m)}", hint="take a smaller tool")


def residue(m: Machine, region: Region, data: ContourData) -> Iterator[Say]:
    """A warning where rings more than a radius apart do not meet in sharp corners."""
    stepover = data.overlap * m.radius
    area = left_by(rings(region, m.radius, stepover, allowance=data.side_allowance)) * m.scale**2
    if area >= 0.001:
        sentence = f"leaves {area:.3f} mm² of each level uncut, where the rings turn sharply"
        yield Say(f"Q2={data.overlap:.10g} {sentence}", "Q2=1 leaves nothing")
