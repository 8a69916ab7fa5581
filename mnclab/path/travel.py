"""How far the axes go: the first row of a path on which the spindle reference leaves the travel of the machine.

The reference is the tool tip and the tool above it. It stands still where a row of kind TOOL moves the tip, so that the
distance between both is the sum of those jumps. An arc is judged by its extent, not by its ends alone: along one axis it is
the cosine of the angle, of amplitude r about the phase p, and the share of its pitch, d over the sweep S,

    x(a) = r cos(a - p) + d a / S,    turning where sin(a - p) = d / (r S)

and of several turns the first and the last such place are the farthest.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.path.columns import Array
from mnclab.path.kinds import Kind
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import Alarm

NOISE = 1e-6  # mm


class Beyond(NamedTuple):
    """A row that leaves the travel: which axis (0 to 2), and the position it would reach, mm."""

    row: int
    axis: int
    position: float


class Stopped(NamedTuple):
    """Where a machine stopped before it left its travel: `place` (3,) of the tip that it was led to, `depth` mm beyond."""

    place: tuple[float, float, float]
    depth: float
    alarm: Alarm


def stopped_at(path: Toolpath, found: Beyond, travel: Array, alarm: Alarm) -> Stopped:
    """The farthest place of a row that leaves the travel, in the coordinates of the path."""
    short, over = travel[found.axis, 0] - found.position, found.position - travel[found.axis, 1]
    low, high = extents(path[found.row : found.row + 1])
    place = path.end[found.row].copy()
    place[found.axis] = (low if short > over else high)[0, found.axis]
    x, y, z = place.tolist()
    return Stopped((x, y, z), float(max(short, over)), alarm)


def first_beyond(path: Toolpath, start: Array, travel: Array) -> Beyond | None:
    """The first row that leads out of `travel` (3, 2), mm; None if none does. `start` (3,) is the spindle reference
    before the path, machine coordinates; a machine that stands outside may return."""
    if not len(path):
        return None
    jump = np.where((path.kind == Kind.TOOL)[:, None], path.start - path.end, 0.0)
    offset = start - path.start[0] + np.cumsum(jump, axis=0)
    low, high = (each + offset for each in extents(path))
    short, over = travel[:, 0] - low, high - travel[:, 1]
    out = (np.maximum(short, over) > NOISE) & path.is_motion[:, None]
    if not out.any():
        return None
    row = int(out.any(axis=1).argmax())
    axis = int(np.argmax(np.where(out[row], np.maximum(short[row], over[row]), -np.inf)))
    return Beyond(row, axis, float((low if short[row, axis] > NOISE else high)[row, axis]))


def extents(path: Toolpath) -> tuple[Array, Array]:
    """The least and the greatest coordinates (n, 3) that each row reaches after its start."""
    low, high = path.end.copy(), path.end.copy()
    arcs = np.flatnonzero((path.kind == Kind.ARC) & (path.sweep != 0))
    if not len(arcs):
        return low, high
    axis, centre, size = path.axis[arcs], path.centre[arcs], np.abs(path.sweep[arcs])[:, None]
    spoke = path.start[arcs] - centre
    level = np.einsum("ij,ij->i", spoke, axis)[:, None] * axis
    across = np.cross(axis, spoke - level) * np.sign(path.sweep[arcs])[:, None]
    rise = np.einsum("ij,ij->i", path.end[arcs] - path.start[arcs], axis)[:, None] * axis
    amplitude, phase = np.hypot(spoke - level, across), np.arctan2(across, spoke - level)
    with np.errstate(divide="ignore", invalid="ignore"):
        tilt = np.arcsin(rise / (amplitude * size))  # nan where the pitch never turns back
    for turning in (phase + tilt, phase + np.pi - tilt):
        first = np.mod(turning, 2 * np.pi)
        for angle in (first, first + 2 * np.pi * np.floor((size - first) / (2 * np.pi))):
            place = centre + level + amplitude * np.cos(angle - phase) + rise * angle / size
            reached = (angle > 0) & (angle < size)  # false for nan
            low[arcs] = np.where(reached, np.minimum(low[arcs], place), low[arcs])
            high[arcs] = np.where(reached, np.maximum(high[arcs], place), high[arcs])
    return low, high
