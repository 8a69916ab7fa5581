"""What may meet what on a lathe, as areas in the plane of z and r, mm: bars, chucks, and the bodies behind an insert.

Areas are shapely's. A tool is given about its tip; what lies behind its insert is known only where its table says so.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from mnclab.geometry import shapely
from mnclab.geometry.contours import Floats
from mnclab.path.inserts import EDGE, cutting_part, turns
from mnclab.path.tool import LATHE, Tool
from mnclab.text.alarm import Alarm
from mnclab.text.given import shown
from mnclab.workpiece.blank import Box, Revolved

CHORD_ERROR = 1e-4  # mm, of a nose
THIN = 0.008  # mm: half a tool that has no width, less than what counts


def half_section(body: Any) -> Any:
    """A body about the spindle above its axis; a box counts by its X. An Alarm for any other."""
    if isinstance(body, Box):
        (x0, _, z0), (x1, _, z1) = body.bounds
        return shapely.box(z0, max(x0, 0.0), z1, max(abs(x0), abs(x1)))
    if not isinstance(body, Revolved) or body.axis != "Z" or any(np.abs(body.at[:2]) > 1e-9):
        raise Alarm(f"on a lathe a blank and its chuck are boxes or bodies about Z, got {shown(body)}")
    outer = [(z + body.at[2], r) for r, z in body.profile]
    whole = shapely.make_valid(shapely.Polygon([*outer, (outer[-1][0], body.bore), (outer[0][0], body.bore)]))
    return whole


def mirror_of(tool: Tool) -> Floats:
    """What z and r are multiplied with so that a tool becomes a right-hand one for outside (2,)."""
    return np.array([-1.0 if tool.hand == "left" else 1.0, -1.0 if tool.kind == "boring" else 1.0])


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
