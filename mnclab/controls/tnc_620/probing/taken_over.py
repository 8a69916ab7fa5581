"""What the cycles 14xx make of a measured place and rotation: the active preset changes, rotary axes turn (TNC 620, 14.2).

A measured point has its nominal coordinates in the new system. In a tilted plane, and for a plane that is not level, the basic
rotation is one in space (SPA, SPB, SPC).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.controls.tnc_620.cycles.tilting import axis_positions, position
from mnclab.controls.tnc_620.probing.aimed import Floats, Found
from mnclab.controls.tnc_620.probing.misalignment import C, align, cannot_turn
from mnclab.controls.tnc_620.probing.transfer import store
from mnclab.controls.tnc_620.state import active_preset
from mnclab.geometry import frames
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.machining.probing import fits
from mnclab.machining.probing.found import spatial_angles
from mnclab.machining.steps import RAPID, Step

BASIC, TABLE = 1, 2  # Q1121
LEVEL = 1e-12  # of a turn that has no part about X and Y


def contradictions(c: Any) -> Iterator[Fault]:
    """Of the cycles with one angle: rotary axes are aligned where the rotary table takes the rotation over."""
    if c.align_rotary_axis and c.confirm_rotation != TABLE:
        yield "align_rotary_axis", "aligns the rotary axis: then Q1121 must be 2, and no basic rotation takes the angle over"


def faults(c: Any, m: Machine) -> Iterator[Fault]:
    if c.confirm_rotation == TABLE:
        yield from cannot_turn(m, C, "confirm_rotation")


def angle(first: Floats, second: Floats) -> float:
    """The direction from a point to another in the plane, degrees."""
    return fits.angle(first[:2].tolist(), second[:2].tolist())


def chosen(c: Any, points: Sequence[Floats]) -> Floats | None:
    """The point that Q1120 names, their mean behind the last; None: no position is taken over."""
    k = int(c.transfer_position)
    return None if k == 0 else np.mean(points, axis=0) if k > len(points) else np.asarray(points[k - 1])


def take_over(c: Any, m: Machine, found: Sequence[Found], nominal: Floats, turned: Floats, by: float) -> Iterator[Step]:
    """Change the active preset: `nominal` (n, 3) are the middles of the tolerances, `turned` (3, 3) is the measured rotation,
    `by` its angle in the plane, degrees, nan in space."""
    here, should = chosen(c, [one.point for one in found]), chosen(c, list(nominal))
    before, axes = m.tables.presets.get(active_preset(m), Datum()), m.frames["preset"][:3, :3]
    inner = frames.inverse(m.frames.before("preset") @ m.frames["preset"]) @ m.matrix  # what acts behind the preset
    new, origin, columns = axes, np.array(before[:3]), {}
    if c.confirm_rotation == BASIC:
        tilt = inner[:3, :3]
        change = tilt @ turned @ tilt.T
        new = axes @ change
        level = not (math.isnan(by) or before.tilt_x or before.tilt_y) and np.abs(change[2, :2]).max() < LEVEL
        space = dict(zip(("tilt_x", "tilt_y", "rotation"), spatial_angles(new), strict=True))
        columns = {"rotation": before.rotation + by} if level else space
    elif c.confirm_rotation == TABLE:
        columns = {"c": before.c + by}
    if here is not None and should is not None:
        is_, gets = origin + axes @ frames.apply(inner, here), new @ frames.apply(inner, should)
        if c.confirm_rotation == TABLE:
            centre = (m.settings["table_x"], m.settings["table_y"], 0.0)
            is_ = frames.apply(frames.turn(-math.radians(by), about=centre), is_)
        columns |= dict(zip("xyz", (is_ - gets).tolist(), strict=True))
    if columns:
        yield from store(m, active_preset(m), **columns)
    if c.align_rotary_axis and c.confirm_rotation == TABLE:
        yield from align(m, C, by)
    elif c.align_rotary_axis:
        yield from position(m, axis_positions(m), RAPID, 0.0)
