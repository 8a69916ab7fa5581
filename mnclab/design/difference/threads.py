"""Threads as the rows of a path cut them, of which a shape says little: pitch, depth, length, where their passes begin.

On a lathe they are passes along Z towards the chuck with a locked spindle; on a mill what taps and thread mills do in a hole.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from mnclab.design.model.holes import Hole, metric
from mnclab.design.model.turned_threads import Thread
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Array, Index, Kind, Toolpath
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.milled import THREADS, Milled
from mnclab.workpiece.turning.strokes import threads_of

SLACK = 0.02  # mm along Z, by which a pass may lie beside the groove of the deepest one
EXACT = 1e-3  # mm, of a pitch
LONGER = 2.0  # pitches that a hole may have of thread below what is drawn: the chamfer of a tap


class Passes(NamedTuple):
    """Rows (k,) that cut a thread, each with its `pitch` (k,) and how far it lies `beside` the groove of the deepest one (k,),
    mm along Z, 0 within it; the `deepest` row, its `radius` and where it begins and ends along Z, mm."""

    rows: Index
    pitch: Array
    beside: Array
    deepest: int
    radius: float
    start: float
    end: float

    def length(self, thread: Thread) -> float:
        """How much of the thread as drawn they cut; they run in and out beyond it."""
        return max(min(self.start, thread.start) - max(self.end, thread.end), 0.0)

    def shallow(self, thread: Thread) -> float:
        """By how much the deepest pass is too shallow, mm; negative: within its core."""
        low, high = thread.band
        return high - self.radius if thread.inside else self.radius - low

    def worst_pitch(self, thread: Thread) -> float:
        """The pitch that is farthest from the one drawn."""
        return float(self.pitch[np.abs(self.pitch - thread.pitch).argmax()])


def passes_of(path: Toolpath, thread: Thread) -> Passes | None:
    """The passes of a thread of a turned part, those of a tap, which runs on the axis, among them; None where there are none."""
    r0, r1, z0, z1 = np.abs(path.start[:, 0]), np.abs(path.end[:, 0]), path.start[:, 2], path.end[:, 2]
    low, high = thread.band
    near = path.synchronous & path.is_motion & (path.program == 0) & (r0 == r1) & (z1 < z0)
    tap = (r0 == 0) & thread.inside
    near &= (z1 < thread.start) & (z0 > thread.end) & (tap | ((r0 > low - thread.pitch) & (r0 < high + thread.pitch)))
    rows = np.flatnonzero(near)
    if not len(rows):
        return None
    r0 = np.where(tap, high, r0)  # a tap has the whole profile
    deepest = int(rows[np.lexsort((-z1[rows], r0[rows] if thread.inside else -r0[rows]))[-1]])
    away = np.abs((z0[rows] - z0[deepest] + thread.pitch / 2) % thread.pitch - thread.pitch / 2)
    room = np.abs(r0[rows] - r0[deepest]) * math.tan(math.radians(30)) + SLACK
    ends = float(r0[deepest]), float(z0[deepest]), float(z1[deepest])
    return Passes(rows, threads_of(path)[0][rows], np.where(tap[rows], 0.0, np.maximum(away - room, 0.0)), deepest, *ends)


# Holes of milled parts. A map of heights shows a thread as the cylinder of its tap: the hole itself is measured as it was before.


def in_hole(cutting: Cutting, hole: Hole) -> Index:
    """The rows on which a tap or a thread mill moves about the axis of a hole."""
    path, tools = cutting.path, np.array([tool.kind in THREADS for tool in cutting.tools] or [False])
    near = np.hypot(*(path.end[:, :2] - (hole.x, hole.y)).T) < metric(hole.thread)[0] / 2
    return np.flatnonzero(near & tools[cutting.which] & path.is_motion)


def before_threads(part: Milled, features: Sequence[object]) -> Milled:
    """The part as it was before the threads of those holes were cut that are drawn with their core."""
    cutting = part.cutting
    holes = [each for each in features if isinstance(each, Hole) and each.thread and each.wide < metric(each.thread)[0]]
    rows = [in_hole(cutting, each) for each in holes if len(cutting)]
    if not rows or not len(found := np.concatenate(rows)):
        return part
    which = cutting.which.copy()
    which[found] = len(cutting.tools)
    return Milled(replace(cutting, which=which, tools=[*cutting.tools, Tool(kind="probe")]), part.step)


def thread_of(cutting: Cutting, hole: Hole, top: float) -> tuple[float, float, float] | None:
    """Nominal diameter, depth below `top` and pitch of the thread in a hole, mm; None where none was cut."""
    rows = in_hole(cutting, hole)
    rows = rows[cutting.path.kind[rows] != Kind.RAPID]
    if not len(rows):
        return None
    path, tool = cutting.path, cutting.tool(int(rows[0]))
    rises = np.abs(path.end[rows, 2] - path.start[rows, 2])
    if tool.kind == "tap":
        pitch, away = threads_of(path)[0][rows], 0.0
    else:
        turns = np.abs(path.sweep[rows]) / math.tau
        pitch = rises / np.where(turns > 0, turns, np.nan)
        away = float(np.hypot(*(path.end[rows, :2] - (hole.x, hole.y)).T).max())
    deep = top - float(np.fmin(path.start[rows, 2], path.end[rows, 2]).min())
    known = pitch[(rises > 0) & (pitch > 0)]
    return 2 * (away + tool.effective_radius), deep, float(np.median(known)) if len(known) else math.nan
