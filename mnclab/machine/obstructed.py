"""A probe that the program drives into the part outside the cycles: on a machine it triggers, and the axes stop.

Cycles that probe guard their own moves; here the blocks between them are judged, once the program is over.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mnclab.machine.cutting_rows import TILT, start_known, tilted_rows
from mnclab.machine.tool_axis import LOG
from mnclab.machine.touching import DEEP, place_of, slack
from mnclab.path.kinds import Kind
from mnclab.path.toolpath import Toolpath, concatenate
from mnclab.text.alarm import Alarm
from mnclab.workpiece.part import Part, contact
from mnclab.workpiece.part.touching import GRAZE

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

CHORD = 1e-3  # mm
MOST = 5000  # rows that are judged


def stop_at_part(m: Machine) -> None:
    """Cut the run at the first block that leads the ball of a probe into the part of the setup: an Alarm.

    Judged is a tool of the kind "probe", from where its place is known, as long as it stands upright.
    """
    part = m.setup.part
    if not isinstance(part, Part) or not m.settled:
        return
    path = concatenate(m.settled)
    probes = [number for number, tool in m.tables.tools.items() if tool.kind == "probe"]
    rows = path.is_motion & (path.kind != Kind.PROBE) & np.isin(path.tool, probes) & (path.label == 0)
    tilts, axes = (m.logs.changed(name, m.step) for name in (TILT, LOG))
    tilted = tilted_rows(path.step, tilts, axes, path.cylinder)
    if tilted is not None:
        rows &= ~tilted
    rows[: start_known(path, m.setup.start)[1]] = False
    for row in np.flatnonzero(rows)[:MOST].tolist():
        place = _met(m, part, path, row)
        if place is not None:
            m.cut = int(path.step[row])
            m.settled = [path[path.step < m.cut]]
            message = f"path obstructed: the probe touches the part near {place_of(m, m.to_program(place))} while positioning"
            hint = "lead it around the part, or over it: it is in Setup(part=…)"
            raise Alarm(message, m.flow.span_of_step(m.cut), hint=hint)


def _met(m: Machine, part: Part, path: Toolpath, row: int) -> tuple[float, float, float] | None:
    """Where the tip stands when the ball meets the part on a row, machine coordinates; None if it does not."""
    tool = m.tables.tools[int(path.tool[row])]
    true = m.setup.true_tools.get(tool.number, tool)
    up = true.effective_radius + tool.effective_length - true.effective_length
    beside = np.array([*m.setup.probe.where, up])
    radius = max(true.effective_radius - DEEP - slack(m), DEEP)
    if path.kind[row] == Kind.ARC:
        places = path[row : row + 1].points(CHORD)[0]
        hit = np.flatnonzero(part(places + beside) < radius)
        found = places[hit[0]] if len(hit) else None
    else:
        way = path.end[row] - path.start[row]
        length = float(np.linalg.norm(way))
        travel = contact(part, path.start[row] + beside, way, radius, length, GRAZE) if length else None
        found = None if travel is None else path.start[row] + way * (travel / length)
    return None if found is None else (float(found[0]), float(found[1]), float(found[2]))
