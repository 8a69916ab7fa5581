"""The one contour of a contour train, of a trochoidal slot and of the cylinder surfaces: the first label of cycle 14.

Unlike an area it need not be closed: it is where it ends at its beginning. APPR and DEP blocks are no part of it.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.contours.labels import Labels
from mnclab.controls.tnc_620.contours.outlines import MOST_ELEMENTS, fault
from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.machine.flow import RecordedLead, Recording
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Record, Step
from mnclab.path.plane import chain
from mnclab.path.toolpath import Kind

CLOSED = 1e-6  # mm, from the end to the beginning of a closed contour
FLAT = 1e-9  # mm


class Line(NamedTuple):
    """A contour with the side that its compensation says: +1 left, -1 right, 0 none.

    `heights` (n,) are those of its n points; `steps` and `lines` (m,) name the blocks of its m elements, for alarms.
    `approach` and `departure` lead to it and away, where the label has APPR and DEP; a label without APPR begins with a
    straight line.
    """

    contour: Contour
    side: int
    heights: Floats
    steps: NDArray[np.int64]
    lines: NDArray[np.int64]
    approach: RecordedLead | None = None
    departure: RecordedLead | None = None


def with_labels(m: Machine, single: bool = False) -> Iterator[Fault]:
    """The labels of cycle 14, and but one of them where it must be a `single` one."""
    labels = memory(m).contour
    if not isinstance(labels, Labels):
        yield "", "needs a contour: CYCL DEF 14 comes before it"
    elif single and len(labels.names) > 1:
        yield "", f"takes a single contour, but CYCL DEF 14 names {len(labels.names)} labels"


def contour_line(m: Machine, in_space: bool = False) -> Generator[Step, Any, Line]:
    """The contour of the first label of cycle 14, in coordinates of the program.

    An Alarm where it leaves its plane; `in_space` it may have heights, and its first block needs all three coordinates.
    """
    labels = memory(m).contour
    assert isinstance(labels, Labels)
    label = labels.names[0]
    recording: Recording = yield Record(label, labels.program, labels.unit, in_space=in_space)
    path = recording.path
    if not len(path):
        fault(m, recording.step, f"label {label} describes no contour")
    if len(path) > MOST_ELEMENTS:
        fault(m, int(path.step[-1]), f"the contour of label {label} has {len(path)} elements, more than {MOST_ELEMENTS}")
    leads = [lead for lead in (recording.approach, recording.departure) if lead and lead.place]
    aside = [lead.lead.step for lead in leads if lead.place and abs(lead.place[2]) > FLAT]
    steep = np.abs(path.start[:, 2]) + np.abs(path.end[:, 2]) > FLAT
    for steps, what in (
        (path.step[(path.kind == Kind.ARC) & (np.abs(path.axis[:, 2]) < 0.5)], "has an arc outside the plane XY"),
        (() if in_space else (*aside, *path.step[steep]), "moves along the tool axis"),
        (path.step[path.side != recording.side], "changes its radius compensation in this block"),
    ):
        if len(steps):
            fault(m, int(steps[0]), f"the contour of label {label} {what}")
    contour, heights, rows = chain(path)
    if contour.length <= CLOSED:
        fault(m, int(path.step[-1]), f"the contour of label {label} has no length in the plane XY")
    if np.hypot(*(contour.points[-1] - contour.points[0])) <= CLOSED and abs(heights[-1] - heights[0]) <= CLOSED:
        contour, heights = Contour(contour.points[:-1], contour.bulge[:-1]), heights[:-1]
    return Line(contour, recording.side, heights, path.step[rows], path.line[rows], recording.approach, recording.departure)
