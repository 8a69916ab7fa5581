"""What keeps its true size under a frame: the tool, a thread, a boring bar, the direction of an oriented spindle.

The lengths of a cycle are those of the program, so a scale makes them longer or shorter on the machine; what is not scaled
is told in lengths of the program instead. A cycle for which that cannot be is refused before it moves.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from mnclab.geometry.frames import IDENTITY, Matrix
from mnclab.machine.tool_axis import tool_axis
from mnclab.machining.steps import Go, Step
from mnclab.path.tool import Tool

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

#: What a cycle does (`Cycle.does`), as far as its frame must care.
VISITS, MILLS, TAPS, MILLS_THREADS, SHIFTS = "visits points", "mills", "taps", "mills threads", "shifts a boring bar"
NOTHING = "moves nothing"
SAME = 1e-9


def faults(does: str, m: Machine) -> Iterator[str]:
    """Why a cycle that does this cannot run under the frame of the machine: the end of a sentence."""
    if m.shift is not None or does == NOTHING:
        return
    if is_upside_down(m):
        yield "cannot run under a mirror image of Z: it would work from below the table"
        return
    if does not in (MILLS, TAPS, MILLS_THREADS, SHIFTS):
        return
    if does == MILLS:
        if not is_round(m):
            yield "cannot run under unequal scales of the plane"
        return
    x, y, z = np.linalg.norm(m.matrix[:3, :3], axis=0).tolist()
    kept = "bar keeps its size" if does == SHIFTS else "thread keeps its pitch"
    if abs(z - 1) > SAME:
        yield f"cannot run under a scale of Z other than 1, got {z:g}: a {kept}"
    elif does != TAPS and max(abs(x - 1), abs(y - 1)) > SAME:
        yield f"cannot run under a scale other than 1, got {x:g} and {y:g} in the plane: a {kept}"


def is_round(m: Machine) -> bool:
    """Whether circles of the plane XY stay circles on the machine."""
    u, v = m.matrix[:3, 0], m.matrix[:3, 1]
    return bool(abs(np.linalg.norm(u) - np.linalg.norm(v)) <= SAME and abs(u @ v) <= SAME)


def is_upside_down(m: Machine) -> bool:
    """Whether one of the frames mirrors the tool axis; a tilt turns it."""
    linear, k = (frame[:3, :3] for _, frame in m.frames), tool_axis(m)
    return any(part[k, k] < 0 and not (part - np.diag(part.diagonal())).any() for part in linear)


def plane_scale(m: Machine) -> float:
    """How long 1 mm of the program in the plane XY is on the machine; 1 where that depends on the direction."""
    return math.hypot(*m.matrix[:3, 0].tolist()) if is_round(m) else 1.0


def depth_scale(m: Machine) -> float:
    """How long 1 mm of the program along Z is on the machine."""
    return math.hypot(*m.matrix[:3, 2].tolist())


def tool(m: Machine) -> Tool:
    """The tool in lengths of the program: where Z has another scale than the plane, its angles are others there, too."""
    if m.shift is not None:
        return m.tool
    plane, depth = plane_scale(m), depth_scale(m)
    own, steeper = m.tool, plane / depth
    return replace(
        own, radius=own.radius / plane, dr=own.dr / plane, corner=own.corner / plane,
        cutting_length=own.cutting_length / depth, plunge_angle=_angle(own.plunge_angle, steeper),
        angle=2 * _angle(own.angle / 2, 1 / steeper),
    )  # fmt: skip


def _angle(degrees: float, factor: float) -> float:
    """The angle (0 to 90 degrees) whose tangent is so many times as great; no angle (0) and a right one stay."""
    return math.degrees(math.atan(math.tan(math.radians(degrees)) * factor)) if 0 < degrees < 90 else degrees


def remark(m: Machine) -> str:
    """What to add to a sentence that names sizes of the tool: in which lengths they count."""
    if abs((scale := plane_scale(m)) - 1) < SAME:
        return ""
    size = 2 * m.tool.effective_radius
    return (
        f", in lengths of the program: under the scale {scale:g} the tool diameter {size:g} counts as {size / scale:g}"
    )


def with_the_spindle(m: Machine, steps: Iterable[Step], frame: Matrix = IDENTITY) -> Iterator[Step]:
    """Steps off the axis of a hole as far as they are long, in the direction of the oriented spindle.

    `frame` is the part of the frame that the direction follows; none of it: it is one of the machine.
    """
    whole = m.matrix[:3, :3]
    for step in steps:
        if isinstance(step, Go) and step.x is not None and step.y is not None and (step.x or step.y):
            way = np.linalg.solve(whole, frame[:3, :2] @ (step.x, step.y))[:2]
            way /= np.abs(way).max()  # whose square is no number where it is very short
            x, y = (way * (math.hypot(step.x, step.y) / np.linalg.norm(whole[:, :2] @ way))).tolist()
            step = step._replace(x=x, y=y)
        yield step
