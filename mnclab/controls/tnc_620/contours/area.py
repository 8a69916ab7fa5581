"""The area that a contour describes: the labels of cycle 14 (8.2, 8.3), or a formula of regions (chapter 10).

The path inside its contour is a pocket: clockwise with RR, counter-clockwise with RL; else an island. A further pocket is
united with the area, or intersected with it if the first pocket begins inside it; islands are taken away. Islands alone
are no area, but side finishing takes them as walls that are gone round from outside (8.8).
"""

from __future__ import annotations

from collections.abc import Generator, Sequence
from typing import Any, TypeAlias

from mnclab.controls.tnc_620.contours.data import ContourData
from mnclab.controls.tnc_620.contours.labels import Labels
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.machine.flow import Recording
from mnclab.machine.machine import Machine
from mnclab.machining.milling.terraces import Part, Terrace, terraces
from mnclab.machining.steps import Record, Step
from mnclab.path.kinds import Kind
from mnclab.path.outline import outline
from mnclab.path.toolpath import Toolpath

Pocket: TypeAlias = tuple[Contour, tuple[float, float]]  # and where it begins


def contour_terraces(
    m: Machine, data: ContourData, *, islands_alone: bool = False
) -> Generator[Step, Any, tuple[Terrace, ...]]:
    """The areas of the contour from the surface down to the depth of cycle 20, which the steps read; a depth of 0 is one area.

    With `islands_alone` labels without a pocket are one `solid` terrace, else an Alarm.
    """
    source = memory(m).contour
    assert source is not None
    try:
        if isinstance(source, Labels):
            pockets, islands = yield from labelled_contours(m, source)
            if islands_alone and islands and not pockets:
                return (Terrace(0.0, abs(data.depth), Region.of(*islands), solid=True),)
            source = Part(united(m, pockets, islands))
        found = terraces(source, abs(data.depth) or 1.0)
    except ValueError as error:
        m.alarm(f"the contour is no area: {error}")
    return found if data.depth else (found[0]._replace(bottom=0.0),)


def labelled_contours(m: Machine, labels: Labels) -> Generator[Step, Any, tuple[list[Pocket], list[Contour]]]:
    """The pockets and the islands that labels describe, in coordinates of the program."""
    pockets: list[Pocket] = []
    islands: list[Contour] = []
    recording: Recording | None = None
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
    return pockets, islands


def upright(path: Toolpath) -> bool:
    """Whether there are arcs outside the plane XY."""
    return bool(((path.kind == Kind.ARC) & (abs(path.axis[:, 2]) < 0.5)).any())


def united(m: Machine, pockets: Sequence[Pocket], islands: Sequence[Contour]) -> Region:
    """The area of pockets without islands; a ValueError if one encloses no area, an Alarm without a pocket."""
    if not pockets:
        m.alarm("the contour has no pocket", hint="a pocket is clockwise with RR or counter-clockwise with RL")
    (first, begin), *others = pockets
    region = Region.of(first)
    for contour, _ in others:
        other = Region.of(contour)
        region = region.intersection(other) if other.contains([begin])[0] else region.union(other)
    for contour in islands:
        region = region.difference(Region.of(contour))
    return region
