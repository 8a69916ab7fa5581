"""SL cycles (TNC 620, chapter 8): contours from labels, their data, and clearing them.

A contour is read from its labels when a cycle that machines it is called; `pockets.rings` does the geometry.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import FAR, choice, coordinate, count, distance, increment, length, ratio
from mnclab.controls.tnc_620.cycles.faults import Fault, with_radius
from mnclab.controls.tnc_620.cycles.planes import in_program_coordinates, rate
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.flow import Recording
from mnclab.machine.machine import INF, Machine
from mnclab.machine.true_size import MILLS, remark
from mnclab.machining.depths import infeeds
from mnclab.machining.milling.residue import left_by
from mnclab.machining.milling.rings import rings
from mnclab.machining.steps import Along, Go, Record, Say, Step, Write
from mnclab.path.kinds import Kind
from mnclab.path.outline import outline
from mnclab.path.toolpath import Toolpath
from mnclab.running.binding import unit_of

CYCLES = CycleTable()
STRATEGIES: dict[float, str] = {0: "along the contour at depth", 1: "retract between the areas"}
MOST_LABELS = 12


class Labels(NamedTuple):
    """Names of labels, the program that they stand in, and what a length of 1 in its parameters is, mm."""

    names: tuple[str, ...]
    program: int
    unit: float


@CYCLES("CYCL DEF 14", "Contour geometry", runs="definition", source="8.2")
class ContourGeometry(Cycle):
    """The labels whose contours together are the pocket; no motion."""

    labels: tuple[float, ...] = addresses.number(
        "LBL", "label numbers of the contour", at_most=65535, several=True, note="1/2/3, up to 12", example=1
    )

    def check(self, m: Machine) -> Iterator[Fault]:
        if len(self.labels) > MOST_LABELS:
            yield "labels", f"must be at most {MOST_LABELS} labels, got {len(self.labels)}"
        for number in self.labels:
            if f"{number:g}" not in m.flow.program.labels:
                yield "labels", f"names label {number:g}, which does not exist"

    def moves(self, m: Machine) -> Iterator[Step]:
        names = tuple(f"{number:g}" for number in self.labels)
        yield Write("memory", Labels(names, m.program, m.variable_unit), "contour_labels")


@CYCLES("CYCL DEF 20", "Contour data", runs="definition", source="8.4")
class ContourData(Cycle):
    """Depths, allowances and the sense of milling for the cycles that follow; no motion."""

    depth: float = increment("Q1", "milling depth from the surface to the floor", example=-20)
    overlap: float = ratio("Q2", "path overlap factor", at_most=1.9999, example=1)
    side_allowance: float = increment("Q3", "finishing allowance for side", example=0.2)
    floor_allowance: float = increment("Q4", "finishing allowance for floor", example=0.1)
    surface: float = coordinate("Q5", "coordinate of the workpiece surface", example=0)
    clearance: float = distance("Q6", "set-up clearance", example=2)
    height: float = coordinate("Q7", "clearance height", example=50)
    corner: float = length("Q8", "radius at inside corners", example=0.5)
    sense: float = choice("Q9", "direction of machining", {-1: "up-cut milling", 1: "climb milling"})

    def check(self, m: Machine) -> Iterator[Fault]:
        if abs(self.depth) < self.floor_allowance:
            yield "depth", f"must be at least Q4 = {self.floor_allowance:g} deep, got {self.depth:g}"
        if self.height < self.surface + self.clearance:
            yield "height", f"must not lie below Q5 + Q6 = {self.surface + self.clearance:g}, got {self.height:g}"

    def moves(self, m: Machine) -> Iterator[Step]:
        """Keep the data; they are read again when a cycle is called, since Q parameters may have changed."""
        yield Write("memory", self, "contour_data")


def contour_data(m: Machine) -> ContourData:
    """The data of cycle 20 with the Q parameters as they stand now."""
    data = memory(m).contour_data
    assert data is not None
    now: dict[str, Any] = {
        p.name: m.variables[p.address] * unit_of(m, p) for p in data.parameters() if p.address in m.variables
    }
    return replace(data, **now)


def contour_region(m: Machine) -> Generator[Step, Any, Region]:
    """The area that the labels of cycle 14 describe (TNC 8.3), which the steps read.

    The path inside its contour is a pocket: clockwise with RR, counter-clockwise with RL; else an island. A further
    pocket is united with the area, or intersected with it if the first pocket begins inside it; islands are taken away.
    """
    pockets: list[tuple[Contour, tuple[float, float]]] = []
    islands: list[Contour] = []
    recording: Recording | None = None
    labels = memory(m).contour_labels
    assert labels is not None
    for label in labels.names:
        recording = yield Record(label, labels.program, labels.unit, after=recording)
        assert recording is not None
        if not len(recording.path):
            m.alarm(f"label {label} describes no contour")
        if (abs(recording.path.end[:, 2] - recording.start[2]) > 1e-9).any() or upright(recording.path):
            m.alarm(f"the contour of label {label} moves along the tool axis")
        if not recording.side:
            m.alarm(f"the contour of label {label} has no RL or RR: pocket or island cannot be told apart")
        contour = outline(recording.path)
        if contour.area * recording.side > 0:
            pockets.append((contour, recording.start[:2]))
        else:
            islands.append(contour)
    if not pockets:
        m.alarm("the contour has no pocket", hint="a pocket is clockwise with RR or counter-clockwise with RL")
    try:
        return united(pockets, islands)
    except ValueError as error:
        m.alarm(f"the contour is no area: {error}")


def upright(path: Toolpath) -> bool:
    """Whether there are arcs outside the plane XY."""
    return bool(((path.kind == Kind.ARC) & (abs(path.axis[:, 2]) < 0.5)).any())


def united(pockets: Sequence[tuple[Contour, tuple[float, float]]], islands: Sequence[Contour]) -> Region:
    """The area of pockets, each with the point where it begins, without islands; a ValueError if one encloses no area."""
    (first, begin), *others = pockets
    region = Region.of(first)
    for contour, _ in others:
        other = Region.of(contour)
        region = region.intersection(other) if other.contains([begin])[0] else region.union(other)
    for contour in islands:
        region = region.difference(Region.of(contour))
    return region


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
        if memory(m).contour_labels is None:
            yield "", "needs a contour: CYCL DEF 14 comes before it"
        if memory(m).contour_data is None:
            yield "", "needs its contour data: CYCL DEF 20 comes before it"
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
        data = contour_data(m)
        region = yield from contour_region(m)
        down = -1 if data.depth < 0 else 1
        floor = data.surface + down * (abs(data.depth) - data.floor_allowance)
        climb = data.sense * m.orientation > 0  # on the machine: no mirror image changes it
        try:
            clearing = rings(
                region, m.radius, data.overlap * m.radius, allowance=data.side_allowance, climb=climb,
                corner_radius=data.corner,
            )  # fmt: skip
        except ValueError as error:
            m.alarm(f"{self.code}: {error}{remark(m)}", hint="take a smaller tool")
        if data.overlap > 1:
            yield from residue(m, region, data)
        above, plunge = data.surface + data.clearance, self.swing_feed or self.plunge_feed
        levels = infeeds(data.surface, floor, abs(self.infeed))
        for number, level in enumerate(levels, 1):
            label = f"level {number} of {len(levels)}"
            for piece in clearing.pieces:
                height = data.height  # for positioning (8.4), from above as from below: nothing stands in the way there
                for ring, linked in zip(piece.passes, (False, *piece.linked)):
                    x, y = ring.points[0].tolist()
                    if linked:
                        yield Go(label, x=x, y=y, feed=self.feed)
                    else:
                        yield Go(label, height)
                        yield Go(label, x=x, y=y)
                        yield Go(label, above)
                        yield Go(label, level, plunge)
                    yield Along(label, ring, self.feed)
                    height = above
        yield Go("retract", data.height, rate(self.retract_feed, self.feed))


def residue(m: Machine, region: Region, data: ContourData) -> Iterator[Say]:
    """A warning where rings more than a radius apart do not meet in sharp corners."""
    stepover = data.overlap * m.radius
    area = left_by(rings(region, m.radius, stepover, allowance=data.side_allowance)) * m.scale**2
    if area >= 0.001:
        sentence = f"leaves {area:.3f} mm² of each level uncut, where the rings turn sharply"
        yield Say(f"Q2={data.overlap:.10g} {sentence}", "Q2=1 leaves nothing")
