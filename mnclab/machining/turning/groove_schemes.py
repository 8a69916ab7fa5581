"""Grooves by the seven schemes of the textbook (NC-31, 3.20.8): strokes of a grooving tool of width B.

A groove lies between z `right` and `right - width` at its bottom; its rim is the radius of the blank. The tip is the left
corner of the tool, so that at the right wall it stands at right - B. Coordinates (z, r), mm; for a face groove both are
exchanged. The strokes were drawn in a figure that is missing: for schemes 1 to 4 and 7 the
source gives no more than their number and the tools, and the order of strokes is the reading adopted.

    1 corner groove for a grinding wheel: 1 or 3      4 sloping walls, face grooves: 3
    2 undercut behind a thread: 2 or 3                5 straight: k + 1 plunges, then walls and bottom if fine
    3 groove for a ring: 3                            6, 7 wide: two tools
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.machining.turning.profiles import SAME
from mnclab.machining.turning.roughing import grooves
from mnclab.machining.turning.schemes import loop, semi_finish
from mnclab.machining.turning.strokes import FINISH, PLUNGE, Pen, Plan
from mnclab.path.tool import Tool
from mnclab.text.given import refusing_class

OUT = 1.0  # mm outside the blank
OVERLAP = 1.0  # mm that two neighbouring plunges have in common at least
ALLOWANCE = 0.5  # mm on each wall, and on the bottom, for finishing strokes
WIDE = 6  # tool widths from which on a groove counts as wide
MARGIN = 28.0  # degrees: the line that bounds what a contour tool of 95 and 30 degrees cuts
CONTOUR_TOOL = Tool(main_angle=95.0, auxiliary_angle=30.0, kind="turning")
SHOULDER_TOOL = Tool(main_angle=90.0, auxiliary_angle=30.0, kind="turning")


@refusing_class
@dataclass(frozen=True)
class Groove:
    """`right` and `width` at the bottom, radii of the `bottom` and of the `rim`, mm; slopes of the walls from radial, degrees.

    >>> mnc.schemes.Groove(right=-20, width=10, bottom=8, rim=12).rim
    12
    """

    right: float
    width: float
    bottom: float
    rim: float
    slope_right: float = 0.0
    slope_left: float = 0.0

    def __post_init__(self) -> None:
        if not self.width > 0:
            raise ValueError(f"the width of a groove must be greater than 0, got {self.width:g}")
        if not self.rim > self.bottom >= 0:
            raise ValueError(f"the bottom must lie between the axis and the rim, got {self.bottom:g} and {self.rim:g}")
        if not (0 <= self.slope_right < 90 and 0 <= self.slope_left < 90):
            raise ValueError("a wall slopes by 0 to less than 90 degrees from radial")

    @property
    def left(self) -> float:
        return self.right - self.width

    def wall(self, slope: float, r: float) -> float:
        return (r - self.bottom) * math.tan(math.radians(slope))

    @property
    def profile(self) -> Contour:
        """The groove as a contour (z, r), from the right rim to the left one."""
        right, left = self.wall(self.slope_right, self.rim), self.wall(self.slope_left, self.rim)
        points = [(self.right + right, self.rim), (self.right, self.bottom), (self.left, self.bottom)]
        return Contour([*points, (self.left - left, self.rim)], closed=False)


def side_steps(width: float, tool: float, finish: bool = False) -> float:
    """n = (b - B) / (B - 1), or (b - B - 1) / (B - 1) with 0.5 mm on both walls: the number that the source prints.

    n strokes of step B - 1 would not cover the groove: rounded up it is the number of side steps, one less than plunges.
    Raises ValueError where the tool is wider than the groove, or too narrow for an overlap of 1 mm.

    >>> mnc.schemes.grooves.side_steps(10, 4)  # (10 - 4) / 3
    2.0
    """
    room = width - tool - (2 * ALLOWANCE if finish else 0.0)
    if not tool > OVERLAP:
        raise ValueError(f"the tool must be wider than {OVERLAP:g} mm, the overlap of its strokes, got {tool:g}")
    if room < -SAME:
        rest = " less the allowance" if finish else ""
        raise ValueError(f"a tool of width {tool:g} is wider than the groove{rest}, {width:g}")
    return max(room, 0.0) / (tool - OVERLAP)


def plunges(right: float, width: float, tool: float, finish: bool = False) -> tuple[float, ...]:
    """z of the tip at every plunge, from the right: as many as `side_steps` rounded up, and one.

    >>> mnc.schemes.grooves.plunges(-20, 10, 4)
    (-24.0, -27.0, -30.0)
    """
    count = math.ceil(side_steps(width, tool, finish) - 1e-9)
    spare = ALLOWANCE if finish else 0.0
    step = (width - tool - 2 * spare) / count if count else 0.0
    return tuple(right - tool - spare - k * step for k in range(count + 1))


class _Blade(Pen):
    """The grooving tool over its groove; every stroke begins and ends outside the rim."""

    def __init__(self, groove: Groove, tool: float, z: float, r: float | None = None) -> None:
        super().__init__(z, groove.rim + OUT if r is None else r)
        self.groove, self.width = groove, tool

    def check(self) -> None:
        """A tool that fits into the groove, and needs three strokes at most."""
        width, tool = self.groove.width, self.width
        if not 0 < tool <= width + SAME:
            raise ValueError(f"the tool must be at most as wide as the groove, {width:g}, got {tool:g}")
        if width > 3 * tool + SAME:
            raise ValueError(f"3 strokes need a tool of at least {width / 3:g} mm, got {tool:g}")

    @property
    def right(self) -> float:
        return self.groove.right - self.width

    @property
    def middle(self) -> float:
        return self.groove.left + (self.groove.width - self.width) / 2

    def plunge(self, *places: float, role: str = PLUNGE, bottom: float | None = None) -> None:
        depth = self.groove.bottom if bottom is None else bottom
        for z in places:
            self.number += 1
            self.follow(grooves(self.groove.rim + OUT, depth, [z]), role)

    def along_bottom(self, begin: float, end: float, slope: float = 0.0, side: float = 1.0) -> None:
        """Down a wall at one place, along the bottom to another, up there.

        Outside the rim the stroke is already at feed, on the line of the wall: `side` 1 is the right one.
        """
        self.number += 1
        outside = self.groove.rim + OUT
        self.rapid(begin + side * self.groove.wall(slope, outside), outside)
        self.feed(begin, self.groove.bottom, FINISH)
        self.feed(end, self.groove.bottom, FINISH)
        self.rapid(end, outside)

    def finish(self, walls: bool, bottom: bool) -> None:
        """Strokes n + 1 and n + 2, right wall first; with a fine bottom a stroke along it from the left."""
        if walls:
            self.plunge(self.right, self.groove.left, role=FINISH)
        if bottom:
            self.along_bottom(self.groove.left, self.right)


def scheme_1(groove: Groove, tool: float) -> Plan:
    """Corner groove, shoulder on the left: a plunge of its width, or one at the shoulder, one beside it, and along the bottom."""
    pen = _Blade(groove, tool, groove.left)
    pen.plunge(groove.left)
    if abs(tool - groove.width) > SAME:
        pen.check()
        pen.plunge(pen.middle if groove.width > 2 * tool else pen.right)
        pen.along_bottom(pen.right, groove.left, groove.slope_right)
    return pen.plan("groove 1")


def scheme_2(groove: Groove, tool: float, bottom: bool = False) -> Plan:
    """Undercut for a thread: two or three plunges side by side, then along the bottom if wanted."""
    pen = _Blade(groove, tool, groove.right - tool)
    pen.check()
    count = max(2, math.ceil(groove.width / tool - 1e-9))
    pen.plunge(*np.linspace(pen.right, groove.left, count))
    pen.finish(walls=False, bottom=bottom)
    return pen.plan("groove 2")


def scheme_3(groove: Groove, tool: float) -> Plan:
    """Groove for a ring: a plunge in the middle, one along the right wall, one along the left wall and the bottom."""
    plan = scheme_4(replace(groove, slope_right=0.0, slope_left=0.0), tool)
    return replace(plan, name="groove 3")


def scheme_4(groove: Groove, tool: float) -> Plan:
    """Sloping walls: a plunge in the middle, then down the right slope, then down the left one and along the bottom."""
    pen = _Blade(groove, tool, groove.left + (groove.width - tool) / 2)
    pen.check()
    for slope in (groove.slope_right, groove.slope_left):
        gap = (groove.width - tool) / 2 + groove.wall(slope, groove.rim)
        if gap > tool + SAME:
            raise ValueError(
                f"three strokes leave {gap - tool:g} mm at the rim: the tool must be at least {gap:g} wide"
            )
    pen.plunge(pen.middle)
    pen.along_bottom(pen.right, pen.right, groove.slope_right)
    pen.along_bottom(groove.left, pen.right, groove.slope_left, -1.0)
    return pen.plan("groove 4")


def scheme_5(groove: Groove, tool: float, finish: bool = False, bottom: bool = False) -> Plan:
    """Straight groove: plunges side by side; with `finish` stroke n + 1 down the right wall and n + 2 down the left one.

    `finish` is for walls of Rz 20 µm and finer, `bottom` for a bottom that is as fine: 0.5 mm are left for both.
    """
    places = plunges(groove.right, groove.width, tool, finish)
    pen = _Blade(groove, tool, places[0])
    pen.plunge(*places, bottom=groove.bottom + (ALLOWANCE if bottom else 0.0))
    pen.finish(finish, bottom)
    return pen.plan("groove 5")


def scheme_6(
    groove: Groove, tool: float, depth: float, contour_tool: Tool = CONTOUR_TOOL, finish: bool = True, bottom: bool = False,
    slope: float = MARGIN,
) -> Plan:  # fmt: skip
    """Wide and deep: a contour tool up to a line of 28 degrees behind the right wall, then the grooving tool there.

    `depth` is that of the contour tool's passes. The grooving tool (tool 2) takes the triangle, then finishes. Which wall
    has the slope is the reading adopted: the one where the contour tool goes in, as 95 degrees reach the other one.
    """
    if groove.width < WIDE * tool - SAME:
        raise ValueError(
            f"scheme 6 is for grooves of at least {WIDE * tool:g} mm, six tool widths, got {groove.width:g}"
        )
    if contour_tool.auxiliary_angle and slope > contour_tool.auxiliary_angle:
        raise ValueError(f"the line of {slope:g} degrees is steeper than the auxiliary angle of the tool")
    spare, low = (ALLOWANCE if finish else 0.0), (ALLOWANCE if bottom else 0.0)
    wedge = (groove.rim - groove.bottom - low) / math.tan(math.radians(slope))
    right, left, floor = groove.right - spare, groove.left + spare, groove.bottom + low
    if right - wedge <= left:
        raise ValueError(f"the groove is too deep for its width: the line needs {wedge:g} mm")
    pocket = [(right, groove.rim), (right - wedge, floor), (left, floor), (left, groove.rim)]
    first = semi_finish(Contour(pocket, closed=False), groove.rim, depth, contour_tool)
    pen = _Blade(groove, tool, *first.start)
    pen.append(first, groove.rim + OUT)
    pen.tool = 2
    pen.plunge(*plunges(right, max(wedge, tool), tool), bottom=floor)
    pen.finish(finish, bottom)
    return pen.plan("groove 6")


def scheme_7(groove: Groove, tool: float, depth: float, shoulder_tool: Tool = SHOULDER_TOOL) -> Plan:
    """Wide: the grooving tool (tool 1) opens the groove at its right wall, the shoulder-turning tool (2) takes the rest.

    The opening is as wide as the auxiliary edge of the second tool needs, whose passes, `depth` mm each, run to the left.
    """
    angle = math.radians(shoulder_tool.auxiliary_angle or 90.0)
    opening = max(tool, (groove.rim - groove.bottom) / math.tan(angle))
    if opening >= groove.width:
        raise ValueError(f"the second tool needs an opening of {opening:g} mm, the groove is {groove.width:g} wide")
    places = plunges(groove.right, opening, tool)
    pen = _Blade(groove, tool, places[0])
    pen.plunge(*places)
    begin = (groove.right - opening, groove.bottom)
    rest = Contour([begin, (groove.left, groove.bottom), (groove.left, groove.rim)], closed=False)
    pen.tool = 2
    pen.append(loop(rest, groove.rim, depth, shoulder_tool, front=0.0), groove.rim + OUT)
    pen.rapid(pen.z, groove.rim + OUT)
    return pen.plan("groove 7")


#: The schemes by their numbers.
SCHEMES = {1: scheme_1, 2: scheme_2, 3: scheme_3, 4: scheme_4, 5: scheme_5, 6: scheme_6, 7: scheme_7}
