"""The rows of a lathe's path as contours (z, r) that take material away: each convex or a ribbon, each of one row.

Outside and inside tools, drills on the axis, threads: a threading insert leaves its profile wherever the spindle comes
round, a tap the profile of its thread. What is cut below the axis is cut on the other side of it as well.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import length_of
from mnclab.path.inserts import FACE, as_drawn, cutting_part, turns
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Array, Kind, Toolpath
from mnclab.text.alarm import several
from mnclab.workpiece.cutting import CUTS, Cutting
from mnclab.workpiece.turning.section import Edge, Point, along_arc, along_line, edges, placed

ON_AXIS = 1e-6  # mm: a tool without a kind that moves there drills
OUTSIDE = 1.0  # mm: how far a tool reaches out of the blank
MOST_TEETH = 20_000  # of one row
FLANK, CREST = 5 / 8, 1 / 8  # of the sharp depth and of the pitch: an ISO thread of 60 degrees


class Strokes(NamedTuple):
    """Contours and the row (n,) of each, in the order of the rows; `notes` say what is left out. `body_of` is the cutting
    part of a tool between two places (z, r)."""

    contours: list[Contour]
    rows: list[int]
    notes: tuple[str, ...]
    body_of: Callable[[Tool, Point, Point], list[Edge]]


@dataclass
class _Room:
    """Where the blank is: from `low` to `high` along z, up to `radius`; `long` and `deep` is what reaches out of it."""

    low: float
    high: float
    radius: float
    long: float
    deep: float

    def meets(self, contour: Contour) -> bool:
        (z0, r0), (z1, r1) = box_of(contour)
        near = r0 < 0 < r1 or min(abs(r0), abs(r1)) < self.radius
        return bool(near and z1 > self.low and z0 < self.high)


def box_of(contour: Contour) -> list[list[float]]:
    """Corners of a box in which a contour lies; arcs may leave some room in it."""
    points, rise = contour.points, 0.0
    if contour.bulge.any():
        rise = float((np.abs(contour.bulge) * length_of(contour.ends - points)).max()) / 2
    return [(points.min(axis=0) - rise).tolist(), (points.max(axis=0) + rise).tolist()]


def strokes_of(cutting: Cutting, low: float, high: float, radius: float, axis: float) -> Strokes:
    """The strokes of a path in a blank from `low` to `high` and of a radius; the spindle turns about x = `axis`, mm."""
    path, rows = cutting.path, np.flatnonzero(cutting.cuts)
    start, end = path.start[rows][:, [2, 0]] - (0, axis), path.end[rows][:, [2, 0]] - (0, axis)
    notes: list[str] = []
    aside = (path.start[rows, 1] != path.end[rows, 1]) | ((path.kind[rows] == Kind.ARC) & (np.abs(path.axis[rows, 1]) < 0.5))
    if aside.any():
        notes.append(f"{several(int(aside.sum()), 'row')} out of the plane of Z and X: not in the section")
    least = float(min(np.min(start[:, 1], initial=0.0), np.min(end[:, 1], initial=0.0)))
    ends = np.concatenate([start[:, 0], end[:, 0], [low, high]])
    most = float(max(np.max(start[:, 1], initial=radius), np.max(end[:, 1], initial=radius)))
    room = _Room(low, high, radius, float(np.ptp(ends)) + OUTSIDE, most - least + OUTSIDE)
    body_of = _Bodies(room)
    pitch, turns = (each.tolist() for each in threads_of(path))
    contours: list[Contour] = []
    owners: list[int] = []
    for k, row in enumerate(rows.tolist()):
        if aside[k] or out_of_thread(path, row):
            continue
        a, b = (float(start[k, 0]), float(start[k, 1])), (float(end[k, 0]), float(end[k, 1]))
        for contour in _of_row(cutting, row, a, b, axis, (pitch[row], turns[row]), body_of):
            if room.meets(contour):
                bored = cutting.tool(row).kind == "boring" and min(a[1], b[1]) >= 0  # prolonged away from the part
                mirrored = not bored and box_of(contour)[0][1] < 0 and contour.bounds[0, 1] < 0
                found = [contour, Contour(contour.points * (1, -1), -contour.bulge).reversed()] if mirrored else [contour]
                contours += found
                owners += [row] * len(found)
    if any(cutting.path.synchronous[row] for row in owners):
        notes.append("a thread is the profile of its insert in rings a pitch apart")
    return Strokes(contours, owners, tuple(notes), body_of)


def out_of_thread(path: Toolpath, row: int) -> bool:
    """Whether a rapid straight across lifts the insert out of the groove that the row before it has cut: it cuts nothing."""
    if not row or path.kind[row] != Kind.RAPID or not path.synchronous[row - 1]:
        return False
    return bool(path.kind[row - 1] in CUTS and path.start[row, 2] == path.end[row, 2])


class _Bodies:
    """The cutting part of every tool, worked out once; a boring bar beyond the axis has its nose alone, a sharp one nothing."""

    def __init__(self, room: _Room) -> None:
        self.room = room
        self._known: dict[tuple[Tool, float], list[Edge]] = {}

    def __call__(self, tool: Tool, start: Point, end: Point) -> list[Edge]:
        if not tool.kind and tool.radius and max(abs(start[1]), abs(end[1])) < ON_AXIS and start[0] != end[0]:
            tool = replace(tool, kind="mill")  # as flat as on a mill: nothing is known of its point
        height = self.room.deep if turns(tool) and tool.kind != FACE else self.room.long
        if tool.kind == "boring" and min(start[1], end[1]) < 0:
            height = 0.0
        key = tool, height
        if key not in self._known:
            self._known[key] = edges(cutting_part(tool, height)) if height or tool.corner or tool.width else []
        return self._known[key]


def _of_row(
    cutting: Cutting, row: int, start: Point, end: Point, axis: float, thread: tuple[float, float], body_of: _Bodies
) -> Iterator[Contour]:
    """The contours of a row; `thread` its pitch and the turns before it."""
    path, tool = cutting.path, cutting.tool(row)
    if cutting.from_home[row]:
        start = end
    if path.synchronous[row] and start != end:
        yield from _thread(as_drawn(tool, thread[0]), start, end, *thread, body_of)
        return
    if not (body := body_of(tool, start, end)):
        return
    sweep = float(path.sweep[row] * path.axis[row, 1]) if path.kind[row] == Kind.ARC else 0.0
    if sweep and not cutting.from_home[row]:
        centre = _centre(start, end, sweep) or (float(path.centre[row, 2]), float(path.centre[row, 0]) - axis)
        yield from along_arc(body, start, end, sweep, centre)
        return
    found = along_line(body, start, end)
    if found is not None:
        yield found


def _centre(start: Point, end: Point, sweep: float) -> Point | None:
    """The centre of an arc by its ends, so that it goes through both; None for a full circle."""
    dz, dr = end[0] - start[0], end[1] - start[1]
    if math.hypot(dz, dr) < 1e-6:
        return None
    share = 0.5 / math.tan(sweep / 2)
    return (start[0] + end[0]) / 2 - share * dr, (start[1] + end[1]) / 2 + share * dz


def threads_of(path: Toolpath) -> tuple[Array, Array]:
    """Of each row (n,) how far it goes in a turn of a locked spindle, mm, 0 where nobody knows, and how often the spindle
    has turned so when the row begins: rows of a thread follow each other."""
    with np.errstate(divide="ignore", invalid="ignore"):
        by_time = np.where(path.spindle != 0, path.feed / np.abs(path.spindle), 0.0)
        pitch = np.nan_to_num(np.where(np.isfinite(path.per_rev), path.per_rev, by_time), posinf=0.0)
        turns = np.linalg.norm(path.end - path.start, axis=1) / pitch
    locked = path.synchronous & np.isin(path.kind, CUTS)
    turns = np.where(locked & (pitch > 0), turns, 0.0)
    before = np.cumsum(turns) - turns
    fresh = ~(locked & np.append(False, locked[:-1]))
    return pitch, before - np.maximum.accumulate(np.where(fresh, before, 0.0))


def _thread(
    tool: Tool, start: Point, end: Point, pitch: float, turned: float, body_of: _Bodies
) -> Iterator[Contour]:
    """The profile of the insert in every whole turn, that of a tap on its way in; `turned`: turns before the start."""
    length = math.hypot(end[0] - start[0], end[1] - start[1])
    tap = not turns(tool)
    if tap and end[0] > start[0]:
        return  # out of the hole again, in the same thread
    body = body_of(tool, start, end)
    if tap and pitch:
        core = replace(tool, radius=max(tool.effective_radius - depth_of(pitch), 0.0), dr=0.0)
        if core.radius:
            body = edges(cutting_part(core, body_of.room.long))
    if tap or not pitch:
        found = along_line(body, start, end)
        if found is not None:
            yield found
    if not pitch or length / pitch > MOST_TEETH or not (body or tap):
        return
    whole = np.arange(math.ceil(turned - 1e-9), math.floor(turned + length / pitch + 1e-9) + 1)
    shares = np.clip(pitch * (whole - turned) / length, 0.0, 1.0)
    for share in shares.tolist():
        place = start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1])
        if tap:
            yield _tooth(tool.effective_radius, pitch, place)
        else:
            found = placed(body, place)
            if found is not None:
                yield found


def depth_of(pitch: float) -> float:
    """The depth of an internal ISO thread, mm: 5/8 of the sharp one."""
    return FLANK * pitch * math.sqrt(3) / 2


def _tooth(radius: float, pitch: float, place: Point) -> Contour:
    """The groove that a tap cuts in one turn: flanks of 30 degrees from its radius down to the core."""
    crest = CREST * pitch / 2
    foot = crest + depth_of(pitch) * math.tan(math.pi / 6)
    core = radius - depth_of(pitch)
    return Contour(np.array([(-foot, core), (foot, core), (crest, radius), (-crest, radius)]) + place)
