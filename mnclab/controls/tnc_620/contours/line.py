"""The one contour of a train, a trochoidal slot or a cylinder, the tool that cuts it, and where that goes at the end."""

from __future__ import annotations

from collections.abc import Generator, Iterator
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.contours.area import MOST_ELEMENTS, Labels, fault
from mnclab.controls.tnc_620.cycles.planes import ParameterFault
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.machine.control import Setting
from mnclab.machine.cycle import Cycle
from mnclab.machine.flow import RecordedLead, Recording
from mnclab.machine.machine import Machine
from mnclab.machining.steps import RAPID, Go, Record, Step
from mnclab.path.plane import chain
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Kind
from mnclab.text.alarm import Alarm
from mnclab.text.strings import TextFormula

# Another tool than the one in the spindle, as a cycle names it by number or name: the rough-out tool of 21, 22, 24 and 25.

LONGEST = 16  # characters of a name
Named: TypeAlias = float | str | TextFormula  # a number, a name, or a text parameter that holds a name


def named_tool(m: Machine, tool: Named) -> Tool | None:
    """The tool of a number (5.1 is a row of its own), or of a name whatever its case; None where the table has none."""
    if isinstance(tool, TextFormula):
        tool = tool.evaluate(m.variables)
    if not isinstance(tool, str):
        return m.tables.tools.get(tool)  # type: ignore[call-overload]
    same = (each for each in m.tables.tools.values() if each.name and each.name.upper() == tool.strip().upper())
    return next(same, None)


def in_table(c: Cycle, m: Machine, name: str) -> Iterator[ParameterFault]:
    """A tool that the table does not have, or one that cuts nothing."""
    given: Named = getattr(c, name)
    if isinstance(given, TextFormula):
        try:
            given = given.evaluate(m.variables)
        except Alarm as alarm:
            yield name, f"names no tool: {alarm.message}"
            return
    written = f'"{given}"' if isinstance(given, str) else f"{given:g}"
    tool = named_tool(m, given)
    if isinstance(given, str) and len(given) > LONGEST:
        yield name, f"must have at most {LONGEST} characters, got {len(given)}"
    elif tool is None:
        yield name, f"names tool {written}, which has no row in the tool table"
    elif tool.effective_radius <= 0:
        yield name, f"names tool {written}, which has no radius"


# Where the tool goes at the end of a contour cycle (posAfterContPocket, no. 201007; 8.5 to 8.9).

SETTINGS = (
    Setting(
        "position_after_contour", "before", "where a contour cycle leaves the tool (posAfterContPocket, no. 201007)", "8.5",
        {
            "before": "at the position programmed last before the cycle",
            "height": "at the clearance height, in the plane where the cycle ended (ToolAxClearanceHeight)",
        },
    ),
)  # fmt: skip

Place = tuple[float, float, float]


def leave(m: Machine, before: Place, height: float, feed: float = RAPID) -> Iterator[Go]:
    """Up to the clearance height, and as the setting says to the place `before`, where the tool stood at the call."""
    yield Go("retract", height, feed)
    if m.settings["position_after_contour"] == "before":
        x, y, z = before
        if z > height:
            yield Go("back", z)
        yield Go("back", x=x, y=y)
        if z < height:
            yield Go("back", z)


# The one contour of a contour train, of a trochoidal slot and of the cylinder surfaces: the first label of cycle 14.
# Unlike an area it need not be closed: it is where it ends at its beginning. APPR and DEP blocks are no part of it.

CLOSED = 1e-6  # mm, from the end to the beginning of a closed contour
FLAT = 1e-9  # mm


class ContourLine(NamedTuple):
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


def with_labels(m: Machine, single: bool = False) -> Iterator[ParameterFault]:
    """The labels of cycle 14, and but one of them where it must be a `single` one."""
    labels = memory(m).contour
    if not isinstance(labels, Labels):
        yield "", "needs a contour: CYCL DEF 14 comes before it"
    elif single and len(labels.names) > 1:
        yield "", f"takes a single contour, but CYCL DEF 14 names {len(labels.names)} labels"


def contour_line(m: Machine, in_space: bool = False) -> Generator[Step, Any, ContourLine]:
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
    ends = recording.approach, recording.departure
    return ContourLine(contour, recording.side, heights, path.step[rows], path.line[rows], *ends)
