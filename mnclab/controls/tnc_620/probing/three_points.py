"""Probing in a plane, cycle 1420 (TNC 620, 14.3)."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.controls.tnc_620.probing import addresses, aimed, taken_over
from mnclab.controls.tnc_620.probing.addresses import FIRST, SECOND, TAKEN
from mnclab.controls.tnc_620.probing.aimed import Floats, Given
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, needed
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.probing import fits
from mnclab.machining.probing.found import Plane, axes_on
from mnclab.text.alarm import Alarm

CYCLES = CycleTable(addresses=addresses, runs="definition")
SPACE: dict[float, str] = {0: "none", 1: "basic rotation in space"}
OF_THREE: dict[float, str] = {**addresses.TRANSFERS, 3: "point 3", 4: "the mean of the points"}
STEEP = 0.1  # part of a normal across Y, below which a level X does not say where X of the plane is


@CYCLES(
    "TCH PROBE 1420", "Probing in plane", source="14.3",
    takes=f"{FIRST} {SECOND} third_point_ref_axis third_point_minor_axis third_point_tool_axis probing_direction {TAKEN}",
)  # fmt: skip
class ProbingInPlane(ProbingCycle):
    """Three touches along Q372; Q961 to Q963 are the spatial angles of the plane, without a turn in itself."""

    tilted = True
    first_point_tool_axis: Given = addresses.first_point_tool_axis(example=0)
    second_point_tool_axis: Given = addresses.second_point_tool_axis(example=0)
    probing_direction: float = addresses.probing_direction(example=-3)
    align_rotary_axis: float = addresses.align_rotary_axis()
    transfer_position: float = addresses.transfer_position(choices=OF_THREE)
    confirm_rotation: float = addresses.confirm_rotation(choices=SPACE)

    def contradictions(self) -> Iterator[Fault]:
        if self.align_rotary_axis and not self.confirm_rotation:
            yield "align_rotary_axis", "aligns the rotary axes: then Q1121 must be 1, which takes the rotation over"

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from super().check(m)
        yield from aimed.faults(self, m)
        known = aimed.nominals(self, m)
        if all(each.mean is not None for axes in known for each in axes):
            try:
                fits.plane([[each.mean or 0.0 for each in axes] for axes in known])
            except Alarm as alarm:
                yield "third_point_ref_axis", f"makes no plane with the other points: {alarm.message}"

    def moves(self, m: Machine) -> Moves:
        found = yield from aimed.measure(self, m, 2, aimed.touch)
        nominal, points = aimed.means(aimed.nominals(self, m), found), np.array([one.point for one in found])
        is_: Plane = needed(fits.plane, points, m=m, code=self.code)
        should: Plane = needed(fits.plane, nominal, m=m, code=self.code)
        angles = dict(zip((961, 962, 963), is_.spatial, strict=True))
        yield from aimed.report(self, m, found, nominal, aimed.judge_places(self, m, found), angles, {})
        yield from taken_over.take_over(self, m, found, nominal, turn_between(should, is_), math.nan)


def turn_between(first: Plane, second: Plane) -> Floats:
    """The rotation (3, 3) that takes a plane to another: that of their axes with a level X, without a turn in themselves."""
    up = np.array(second.up) * math.copysign(1.0, float(np.dot(first.up, second.up)))
    ahead = (1.0, 0.0, 0.0) if math.hypot(first.up[0], first.up[2]) < STEEP else None
    return np.asarray(axes_on(up, ahead) @ axes_on(first.up, ahead).T)
