"""What may meet what on a lathe, as areas in the plane of z and r, mm: bars, chucks, and the bodies behind an insert.

Areas are shapely's. A tool is given about its tip; what lies behind its insert is known only where its table says so.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.geometry.curves import Floats
from mnclab.path.inserts import EDGE, cutting_part, mirror_of, turns
from mnclab.path.tool import LATHE, Tool
from mnclab.text.alarm import Alarm
from mnclab.text.given import shown
from mnclab.workpiece.turning.section import Drawing
from mnclab.workpiece.turning.turned import half_section

CHORD_ERROR = 1e-4  # mm, of a nose
THIN = 0.008  # mm: half a tool that has no width, less than what counts


def area_of(body: Any) -> Any:
    """A body about the spindle above its axis, X 0 Y 0. An Alarm for any other."""
    section, axis, _ = half_section(body)
    if abs(axis) > 1e-9:
        raise Alarm(f"on a lathe a blank and its chuck stand about X 0, got {shown(body)}")
    return Drawing.of(section, (), ()).bar


def outline(tool: Tool, height: float) -> Floats:
    """The cutting part about the tip up to a height (k, 2); a tool without width is a thin one."""
    corners = cutting_part(tool, height).points_within(CHORD_ERROR)
    if len(np.unique(corners, axis=0)) > 2:
        return corners
    return np.array([(-THIN, 0.0), (THIN, 0.0), (THIN, height), (-THIN, height)]) * mirror_of(tool)


def behind(tool: Tool, long: float) -> list[tuple[str, Floats]]:
    """Kind of collision and corners (4, 2) of what the table knows of a tool behind its edges, `long` away from the tip.

    The shank of a drill or a boring bar lies along its axis, that of an outside tool across it; the bar of a boring tool
    runs a fifth of an edge below its tip.
    """
    given = [("insert" if turns(tool) else "shank", tool.shank)] if tool.shank else []
    given += [("holder", each) for each in tool.holder]
    return [(kind, _bar(tool, *each, long) * mirror_of(tool)) for kind, each in given if each]


def _bar(tool: Tool, radius: float, start: float, long: float) -> Floats:
    end = max(long, start + 1.0)
    if tool.kind == "boring":
        middle = 0.2 * EDGE + (tool.shank[0] if tool.shank else radius)
    elif tool.kind in LATHE:
        middle = tool.width / 2 if tool.width else radius
        return np.array([(middle - radius, start), (middle + radius, start), (middle + radius, end), (middle - radius, end)])
    else:
        middle = 0.0
    return np.array([(start, middle - radius), (end, middle - radius), (end, middle + radius), (start, middle + radius)])
