"""The one contour of a contour train, of a trochoidal slot and of the cylinder surfaces: the first label of cycle 14.

Unlike an area it need not be closed: it is where it ends at its beginning.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from typing import Any, NamedTuple

import numpy as np

from mnclab.controls.tnc_620.contours.area import upright
from mnclab.controls.tnc_620.contours.labels import Labels
from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.contours import Contour
from mnclab.machine.flow import Recording
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Record, Step
from mnclab.path.outline import outline

CLOSED = 1e-6  # mm, from the end to the beginning of a closed contour


class Line(NamedTuple):
    """A contour with the side that its compensation says: +1 left, -1 right, 0 none."""

    contour: Contour
    side: int


def with_labels(m: Machine, single: bool = False) -> Iterator[Fault]:
    """The labels of cycle 14, and but one of them where it must be a `single` one."""
    labels = memory(m).contour
    if not isinstance(labels, Labels):
        yield "", "needs a contour: CYCL DEF 14 comes before it"
    elif single and len(labels.names) > 1:
        yield "", f"takes a single contour, but CYCL DEF 14 names {len(labels.names)} labels"


def contour_line(m: Machine) -> Generator[Step, Any, Line]:
    """The contour of the first label of cycle 14, in coordinates of the program; an Alarm where it leaves its plane."""
    labels = memory(m).contour
    assert isinstance(labels, Labels)
    label = labels.names[0]
    recording: Recording = yield Record(label, labels.program, labels.unit)
    if (abs(recording.path.end[:, 2] - recording.start[2]) > 1e-9).any() or upright(recording.path):
        m.alarm(f"the contour of label {label} moves along the tool axis")
    contour = outline(recording.path)
    first, last = recording.path.start[0, :2], recording.path.end[-1, :2]
    if np.hypot(*(last - first)) > CLOSED:
        contour = Contour(contour.points, contour.bulge, closed=False)
    return Line(contour, recording.side)
