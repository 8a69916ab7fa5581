"""Cycles 14 and 20: the labels whose contours are machined, depths and allowances (8.2, 8.4); and the area that they enclose."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from dataclasses import replace
from functools import reduce
from typing import Any, NamedTuple, NoReturn, TypeVar

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate, distance, increment, length, ratio
from mnclab.controls.tnc_620.cycles.planes import ParameterFault
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import CrossesItself, Region
from mnclab.machine.coordinates import in_mm
from mnclab.machine.cycle import Cycle, CycleTable, too_many
from mnclab.machine.flow import Recording
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.milling.terraces import DeepArea, Terrace, parts, terraces
from mnclab.machining.steps import Record, Step, Write
from mnclab.path.plane import PlaneView, chain, outline
from mnclab.path.toolpath import Toolpath
from mnclab.running.cycles import unit_of
from mnclab.text.alarm import Alarm

# Cycle 14: the labels whose contours are machined (8.2).

CYCLES = CycleTable()
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
        "LBL", "label numbers of the contour", at_most=65535, several=True, note="1/2/3, up to 12", example=(1, 2)
    )

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        if m.recorded_only:
            yield "", "cannot stand in a contour that a cycle reads, nor in a program of contour definitions"
        if len(self.labels) > MOST_LABELS:
            yield "labels", f"must be at most {MOST_LABELS} labels, got {len(self.labels)}"
        for number in self.labels:
            if f"{number:g}" not in m.flow.program.labels:
                yield "labels", f"names label {number:g}, which does not exist"

    def moves(self, m: Machine) -> Iterator[Step]:
        names = tuple(f"{number:g}" for number in self.labels)
        yield Write("memory", Labels(names, m.program, m.variable_unit), "contour")


# Cycle 20: depths, allowances and clearances of the cycles 21 to 24 (8.4).

AnyCycle = TypeVar("AnyCycle", bound=Cycle)


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

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        if m.recorded_only:
            yield "", "cannot stand in a contour that a cycle reads, nor in a program of contour definitions"
        if abs(self.depth) < self.floor_allowance:
            yield "depth", f"must be at least Q4 = {self.floor_allowance:g} deep, got {self.depth:g}"
        if self.height < self.surface + self.clearance:
            yield "height", f"must not lie below Q5 + Q6 = {self.surface + self.clearance:g}, got {self.height:g}"

    def moves(self, m: Machine) -> Iterator[Step]:
        """Keep the data; they are read again when a cycle is called, since Q parameters may have changed."""
        yield Write("memory", self, "contour_data")

    @property
    def down(self) -> int:
        """-1 where the cycles work downwards, as at a depth of 0, +1 upwards."""
        return 1 if self.depth > 0 else -1

    @property
    def above(self) -> float:
        """The set-up clearance as a height."""
        return self.surface + self.clearance

    @property
    def floor(self) -> float:
        """The floor after finishing."""
        return self.surface + self.depth

    def climb(self, m: Machine) -> bool:
        """Whether walls are climbed on the machine: no mirror image changes the sense of milling (8.3)."""
        return self.sense * m.orientation > 0


def contour_data(m: Machine) -> ContourData:
    """The data of cycle 20 with the Q parameters as they stand now."""
    data = memory(m).contour_data
    assert data is not None
    return as_they_stand(m, data)


def as_they_stand(m: Machine, kept: AnyCycle) -> AnyCycle:
    """A cycle that was kept, with the Q parameters as they stand now."""
    now: dict[str, Any] = {
        p.name: m.variables[p.address] * unit_of(m, p) for p in kept.parameters() if p.address in m.variables
    }
    return replace(kept, **now)


def prepared(m: Machine) -> Iterator[ParameterFault]:
    """What the cycles 21 to 24 need before them: a contour and its data."""
    if memory(m).contour is None:
        yield "", "needs a contour: CYCL DEF 14 comes before it"
    if memory(m).contour_data is None:
        yield "", "needs its contour data: CYCL DEF 20 comes before it"


def some_infeeds(c: Cycle, m: Machine) -> Iterator[ParameterFault]:
    """An `infeed` of 0, or one that makes more levels than anybody would wait for; the data are there."""
    infeed = abs(getattr(c, "infeed", 0.0))
    if infeed == 0:
        yield "infeed", "must not be 0"
    yield from too_many("infeed", lambda: infeeds(0.0, contour_data(m).depth, infeed))


# A recorded contour as an area of its own; what is wrong with it is told where it stands, in its label or its program.

MOST_ELEMENTS = 16384  # of all contours of a cycle (8.1, 10.1)
NEAR = 1e-3  # mm from where a contour crosses itself, which is told to a thousandth


def fault(m: Machine, step: int, message: str, hint: str = "") -> NoReturn:
    """An alarm at the block of a step, in whatever program it stands."""
    raise Alarm(message, m.flow.span_of_step(step), hint=hint)


def doubt(m: Machine, step: int, message: str, hint: str = "") -> None:
    """A warning there."""
    span = m.flow.span_of_step(step)
    with m.within(**({} if span is None else {"program": span.program})):
        m.warn(message, span, hint)


def upright(path: Toolpath) -> NDArray[np.bool_]:
    """Which moves (n,) are arcs outside the plane XY, or lines where another plane is active."""
    return np.asarray(abs(path.axis[:, 2]) < 0.5)


def level(m: Machine, recording: Recording, what: str) -> None:
    """An Alarm where a contour moves along the tool axis."""
    path = recording.path
    message = f"the contour of {what} moves along the tool axis"
    if abs(recording.start[2]) > 1e-9:
        fault(m, recording.step, message)
    leaves = abs(path.end[:, 2]) > 1e-9
    if leaves.any():
        fault(m, int(path.step[np.argmax(leaves)]), message)


def enclosed(m: Machine, recording: Recording, what: str) -> tuple[Contour, Region]:
    """The contour, closed by a straight line where it is open, and what it encloses; an Alarm where it crosses itself."""
    path = recording.path
    if not len(path):
        fault(m, recording.step, f"{what} describes no contour")
    if (leaves := upright(path)).any():
        fault(m, int(path.step[np.argmax(leaves)]), f"the contour of {what} leaves the plane XY")
    path = path[PlaneView(path).moves]
    if not len(path):
        fault(m, recording.step, f"the contour of {what} encloses nothing: it is a point")
    contour = outline(path)
    if not contour.bulge.any() and np.linalg.matrix_rank(contour.points - contour.points[0], tol=1e-9) < 2:
        fault(m, recording.step, f"the contour of {what} encloses nothing")
    try:
        return contour, Region.of(contour)
    except CrossesItself as error:
        rows = chain(path).rows
        element = _last_at(contour, error.where, len(rows))
        fault(m, int(path.step[rows[element]]), f"the contour of {what}: {error}")
    except ValueError as error:
        fault(m, recording.step, f"the contour of {what}: {error}")


def _last_at(contour: Contour, place: tuple[float, float] | None, count: int) -> int:
    """The last of the first `count` elements that pass through a place."""
    if place is None:
        return 0
    x, y = place
    low = np.minimum(contour.starts, contour.ends) - contour.lengths[:, None] - NEAR
    high = np.maximum(contour.starts, contour.ends) + contour.lengths[:, None] + NEAR
    for k in np.flatnonzero(((low <= place) & (place <= high)).all(axis=1))[::-1].tolist():
        one = Contour([contour.starts[k], contour.ends[k]], [contour.bulge[k], 0.0], closed=False)
        if one.distance([(x, y)])[0] <= NEAR:
            return min(int(k), count - 1)
    return count - 1


# The area that a contour describes: the labels of cycle 14 (8.2, 8.3), or a formula of regions (chapter 10).
# The path inside its contour is a pocket: clockwise with RR, counter-clockwise with RL; else an island. In the order of
# cycle 14 each further pocket is united with the area, or intersected with it if the first pocket that overlaps it begins
# inside it; islands are taken away. Islands alone are no area, but side finishing takes them as walls that are gone round
# from outside (8.8).

ON = 1e-6  # mm from a contour: what is nearer lies on it
SLIVER = 1e-6  # mm²: what overlaps less only touches


class Shape(NamedTuple):
    """What one label encloses, where its contour begins, its name, and the step of its first block."""

    region: Region
    begin: tuple[float, float]
    what: str
    step: int


def contour_terraces(
    m: Machine, data: ContourData, *, islands_alone: bool = False
) -> Generator[Step, Any, tuple[Terrace, ...]]:
    """The areas of the contour from the surface down to the depth of cycle 20, which the steps read; a depth of 0 is one area.

    With `islands_alone` labels without a pocket are one `solid` terrace, else an Alarm.
    """
    source = memory(m).contour
    assert source is not None
    if isinstance(source, Labels):
        pockets, islands = yield from labelled_shapes(m, source)
        if islands_alone and islands and not pockets:
            return (Terrace(0.0, abs(data.depth), joined(islands), solid=True),)
        source = DeepArea(area_of(m, pockets, islands))
    whole = abs(data.depth) or 1.0
    for depth in sorted({part.depth for part in parts(source) if data.depth and part.depth > whole + 1e-9}):
        said = f"DEPTH{depth:.10g} of the contour is deeper than the milling depth Q1 = {data.depth:g}, which counts"
        m.warn(in_mm(said, m.variable_unit))
    try:
        found = terraces(source, whole)
    except ValueError as error:
        m.alarm(in_mm(f"the contour is no area: {error}", m.variable_unit))
    return found if data.depth else (found[0]._replace(bottom=0.0),)


def labelled_shapes(m: Machine, labels: Labels) -> Generator[Step, Any, tuple[list[Shape], list[Shape]]]:
    """The pockets and the islands that labels describe, in coordinates of the program."""
    pockets: list[Shape] = []
    islands: list[Shape] = []
    recording: Recording | None = None
    elements = 0
    for name in labels.names:
        recording = yield Record(name, labels.program, labels.unit, after=recording)
        assert recording is not None
        what = f"label {name}"
        if not len(recording.path):
            fault(m, recording.step, f"{what} describes no contour")
        level(m, recording, what)
        side = one_side(m, recording, what)
        contour, region = enclosed(m, recording, what)
        elements += len(contour.points)
        if elements > MOST_ELEMENTS:
            fault(m, recording.step, f"the contours have more than {MOST_ELEMENTS} elements")
        shape = Shape(region, recording.start[:2], what, recording.step)
        (pockets if contour.area * side > 0 else islands).append(shape)
    return pockets, islands


def area_of(m: Machine, pockets: Sequence[Shape], islands: Sequence[Shape]) -> Region:
    """The area of pockets without islands; an Alarm without a pocket.

    Each cycle reads the labels, and mostly finds the outlines of the cycle before: then the area is that one's, too.
    """
    if not pockets:
        m.alarm("the contour has no pocket", hint="a pocket is clockwise with RR or counter-clockwise with RL")
    outlines = [[(shape.begin, *map(_numbers, shape.region.loops)) for shape in shapes] for shapes in (pockets, islands)]
    kept = memory(m).contour_area
    if kept is None or kept[0] != outlines:
        area = united(m, pockets)
        doubts(m, area, pockets, islands)
        kept = outlines, area.without([island.region for island in islands]) if islands else area
        memory(m).contour_area = kept
    return kept[1]


def _numbers(contour: Contour) -> bytes:
    return contour.points.tobytes() + contour.bulge.tobytes()


def joined(shapes: Sequence[Shape]) -> Region:
    return reduce(Region.union, (shape.region for shape in shapes))


def one_side(m: Machine, recording: Recording, what: str) -> int:
    """The side of the compensation, +1 left, -1 right; an Alarm without one."""
    if not recording.side:
        message = f"the contour of {what} has no RL or RR: pocket or island cannot be told apart"
        fault(m, recording.step, message)
    return recording.side


def united(m: Machine, pockets: Sequence[Shape]) -> Region:
    """The area of pockets (8.3): joined one after the other, as the beginning of the first that overlaps the next one says."""
    area = pockets[0].region
    for k, pocket in enumerate(pockets[1:], 1):
        other = next((one for one in pockets[:k] if overlap(one.region, pocket.region)), None)
        if other is None:
            area = area.union(pocket.region)
            continue
        if pocket.region.distance([other.begin])[0] < ON:
            message = f"the contour of {other.what} begins exactly on that of {pocket.what}: joined or common area is open"
            fault(m, other.step, message, "begin it inside the other contour (common area) or outside (joined)")
        inside = pocket.region.contains([other.begin])[0]
        area = area.intersection(pocket.region) if inside else area.union(pocket.region)
        if not area.loops:
            fault(m, pocket.step, f"{pocket.what} has no area in common with the pockets before it")
    return area


def doubts(m: Machine, area: Region, pockets: Sequence[Shape], islands: Sequence[Shape]) -> None:
    """Warnings where an island that a pocket overlaps does not fulfil the conditions of 8.3."""
    for island in islands:
        met = [pocket for pocket in pockets if overlap(pocket.region, island.region)]
        if not met:
            doubt(m, island.step, f"the island of {island.what} lies outside the pocket: it takes nothing away")
            continue
        for pocket in met:
            if island.region.distance([pocket.begin])[0] < ON:
                doubt(m, pocket.step, f"the pocket of {pocket.what} begins exactly on the island of {island.what}")
            elif island.region.contains([pocket.begin])[0]:
                hint = "begin the pocket outside the island (8.3)"
                doubt(m, pocket.step, f"the pocket of {pocket.what} begins inside the island of {island.what}", hint)
        if area.distance([island.begin])[0] < ON:
            doubt(m, island.step, f"the island of {island.what} begins exactly on the contour of the pocket")
        elif not area.contains([island.begin])[0]:
            hint = "begin the island inside the pocket (8.3)"
            doubt(m, island.step, f"the island of {island.what} begins outside the pocket that it overlaps", hint)


def overlap(one: Region, other: Region) -> bool:
    """Whether two areas have more than a boundary in common."""
    (low, high), (least, most) = one.bounds, other.bounds
    apart = (low >= most).any() or (least >= high).any()
    return not apart and one.intersection(other).area > SLIVER
