"""Mirror image, rotation and scaling (11.5 to 11.8): each acts as soon as it is defined, about the datum that is active then.

The tool is neither mirrored nor scaled: its radius is that of the tool table on the machine, and it stays on the side of the
contour on which it was. The chain of the transformations is in `controls.tnc_620.cycles.chain`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from mnclab.controls.tnc_620.cycles import addresses, chain
from mnclab.controls.tnc_620.cycles.addresses import coordinate, ratio
from mnclab.geometry import frames
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Step, Write
from mnclab.text.program import Word

CYCLES = CycleTable()
NOT_BUILT = "UVW"  # secondary axes


@CYCLES("CYCL DEF 8", "Mirroring", runs="definition", source="11.5")
class Mirroring(Cycle):
    """Coordinates of the named axes change their sign about the active datum; without an axis the mirror image is over."""

    mirrored_axes: tuple[str, ...] | None = param(
        "axes", "mirrored axes", "text", type="text", several=True, default=None, default_means="none: no mirror image",
        modal=True, note="letters: X, Y, X Y; not the tool axis",
    )  # fmt: skip

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        named = self.mirrored_axes or ()
        if len(named) > 3:
            yield "mirrored_axes", f"must be at most three, got {' '.join(named)}"
        if twice := next((axis for axis in named if named.count(axis) > 1), None):
            yield "mirrored_axes", f"names {twice} twice"
        if "Z" in named and m.tool.number:
            yield "mirrored_axes", "cannot be the tool axis Z"
        if absent := next((axis for axis in named if axis in NOT_BUILT), None):
            yield "mirrored_axes", f"cannot be {absent}: this axis is not built yet"

    def moves(self, m: Machine) -> Iterator[Step]:
        named = self.mirrored_axes or ()
        linear = "".join(axis for axis in named if axis in "XYZ")
        yield Write("memory", "".join(axis for axis in named if axis in "ABC"), "rotary_mirror")
        yield from chain.define(m, chain.MIRROR, frames.mirror(linear) if linear else None)


@CYCLES("CYCL DEF 10", "Rotation", runs="definition", source="11.6")
class Rotation(Cycle):
    """Turns the coordinates of the working plane about the active datum; cancels a radius compensation."""

    angle: float = addresses.angle("ROT", "rotation angle", note="IROT adds to the active angle", example=30)

    @classmethod
    def prepare(
        cls, values: dict[str, Any], given: Mapping[str, Word], m: Machine, kept: dict[str, Any]
    ) -> dict[str, Any]:
        """An increment within its range is added to the active angle; the sum has no limit and counts modulo a whole turn."""
        if "angle" in given and given["angle"].incremental and abs(values["angle"]) <= 360:
            values["angle"] = math.fmod(chain.angle_of(m) + values["angle"], 360)
        return values

    def moves(self, m: Machine) -> Iterator[Step]:
        yield Write("side", 0)
        yield from chain.remember_angle(m, self.angle)
        yield from chain.define(m, chain.ROTATION, frames.turn(math.radians(self.angle)) if self.angle % 360 else None)


#: A factor of enlargement or reduction.
factor = partial(ratio, at_least=0.000001, at_most=99.999999)
centre = partial(coordinate, default=None, default_means="the active datum")


@CYCLES("CYCL DEF 11", "Scaling", runs="definition", source="11.7")
class Scaling(Cycle):
    """Multiplies all coordinates, radii and lengths of cycles with a factor about the active datum; 1 is the end of it.

    Feeds, fixed distances and pitches stay: a cycle that cuts a thread is refused under it.
    """

    scaling_factor: float = factor("SCL", "scaling factor", example=0.5)

    def moves(self, m: Machine) -> Iterator[Step]:
        s = self.scaling_factor
        yield from chain.define(m, chain.SCALE, frames.scale(s, s, s) if s != 1 else None)


@CYCLES("CYCL DEF 26", "Axis-specific scaling", runs="definition", source="11.8")
class AxisScaling(Cycle):
    """A factor for each axis, about a centre: coordinates that share an arc must have the same one. An axis left out has 1."""

    x: float = factor("X", "factor along X", default=1, example=1.4)
    y: float = factor("Y", "factor along Y", default=1)
    z: float = factor("Z", "factor along Z", default=1)
    centre_x: float | None = centre("CCX", "centre of the scaling along X")
    centre_y: float | None = centre("CCY", "centre of the scaling along Y")
    centre_z: float | None = centre("CCZ", "centre of the scaling along Z")

    @classmethod
    def prepare(
        cls, values: dict[str, Any], given: Mapping[str, Word], m: Machine, kept: dict[str, Any]
    ) -> dict[str, Any]:
        chain.absolute(m, cls.code, given)
        if not {"x", "y", "z"} & given.keys():
            m.alarm(f"{cls.code} needs an axis and its factor, for example CYCL DEF 26.1 X 1.4 Y 0.6", None)
        return values

    def moves(self, m: Machine) -> Iterator[Step]:
        scales, about = (self.x, self.y, self.z), (self.centre_x or 0.0, self.centre_y or 0.0, self.centre_z or 0.0)
        yield from chain.define(m, chain.FACTORS, frames.scale(*scales, about) if scales != (1, 1, 1) else None)
