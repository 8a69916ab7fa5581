"""Datums, mirror image, rotation and scaling (11.2 to 11.8): each acts as soon as it is defined, about the datum active then.

The tool is neither mirrored nor scaled: its radius is that of the tool table on the machine, and it stays on the side of the
contour on which it was. The chain of the transformations is in `controls.tnc_620.cycles.chain`.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial

from mnclab.controls.tnc_620.cycles import addresses, chain
from mnclab.controls.tnc_620.cycles.addresses import coordinate, count, ratio
from mnclab.controls.tnc_620.cycles.chain import Given, Values
from mnclab.controls.tnc_620.cycles.planes import ParameterFault
from mnclab.controls.tnc_620.tables import row_of
from mnclab.geometry import frames
from mnclab.machine.coordinates import tool_axis
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.machining.steps import Step, Write

CYCLES = CycleTable()
NOT_BUILT = "UVW"  # secondary axes
AXES = "xyzabc"
linear = partial(coordinate, default=None, default_means="as it is")
rotary = partial(linear, unit="deg")
factor = partial(ratio, at_least=0.000001, at_most=99.999999)  # of enlargement or reduction
centre = partial(coordinate, default=None, default_means="the active datum")


@CYCLES("CYCL DEF 8", "Mirroring", runs="definition", source="11.5")
class Mirroring(Cycle):
    """Coordinates of the named axes change their sign about the active datum; without an axis the mirror image is over."""

    mirrored_axes: tuple[str, ...] | None = param(
        "axes", "mirrored axes", "text", type="text", several=True, default=None, default_means="none: no mirror image",
        modal=True, note="letters: X, Y, X Y; not the tool axis", example=("X",),
    )  # fmt: skip

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        named = self.mirrored_axes or ()
        if len(named) > 3:
            yield "mirrored_axes", f"must be at most three, got {' '.join(named)}"
        if twice := next((axis for axis in named if named.count(axis) > 1), None):
            yield "mirrored_axes", f"names {twice} twice"
        if (axis := "XYZ"[tool_axis(m)]) in named and m.tool.number:
            yield "mirrored_axes", f"cannot be the tool axis {axis}"
        if absent := next((axis for axis in named if axis in NOT_BUILT), None):
            yield "mirrored_axes", f"cannot be {absent}: this axis is not built yet"

    def moves(self, m: Machine) -> Iterator[Step]:
        named = self.mirrored_axes or ()
        mirrored = "".join(axis for axis in named if axis in "XYZ")
        yield Write("memory", "".join(axis for axis in named if axis in "ABC"), "rotary_mirror")
        yield from chain.define(m, chain.MIRROR, frames.mirror(mirrored) if mirrored else None)


@CYCLES("CYCL DEF 10", "Rotation", runs="definition", source="11.6")
class Rotation(Cycle):
    """Turns the coordinates of the working plane about the active datum; cancels a radius compensation."""

    angle: float = addresses.angle("ROT", "rotation angle", note="IROT adds to the active angle", example=30)

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        """An increment within its range is added to the active angle; the sum has no limit and counts modulo a whole turn."""
        if "angle" in given and given["angle"].incremental and abs(values["angle"]) <= 360:
            values["angle"] = math.fmod(chain.angle_of(m) + values["angle"], 360)
        return values

    def moves(self, m: Machine) -> Iterator[Step]:
        yield Write("side", 0)
        yield from chain.remember_angle(m, self.angle)
        matrix = frames.turn(math.radians(self.angle), "xyz"[tool_axis(m)]) if self.angle % 360 else None
        yield from chain.define(m, chain.ROTATION, matrix)


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
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        chain.absolute(m, cls.code, given)
        if not {"x", "y", "z"} & given.keys():
            m.alarm(f"{cls.code} needs an axis and its factor, for example CYCL DEF 26.1 X 1.4 Y 0.6", None)
        return values

    def moves(self, m: Machine) -> Iterator[Step]:
        scales, about = (self.x, self.y, self.z), (self.centre_x or 0.0, self.centre_y or 0.0, self.centre_z or 0.0)
        yield from chain.define(m, chain.FACTORS, frames.scale(*scales, about) if scales != (1, 1, 1) else None)


@CYCLES("CYCL DEF 7", "Datum shift", runs="definition", source="11.2")
class DatumShift(Cycle):
    """Moves the datum; IX counts from the shift that was valid before, an axis that is not named keeps its shift.

    `#5` takes the shift from a row of the active datum table; an empty field there leaves its axis as it is.
    """

    x: float | None = linear("X", "datum shift along X", example=60)
    y: float | None = linear("Y", "datum shift along Y", example=25)
    z: float | None = linear("Z", "datum shift along Z")
    a: float | None = rotary("A", "datum shift of A")
    b: float | None = rotary("B", "datum shift of B")
    c: float | None = rotary("C", "datum shift of C")
    datum_number: float | None = count(
        "#", "row of the datum table", at_most=9999, default=None, default_means="the shift is written"
    )

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        for name, before in zip(AXES, (*chain.shift_of(m), *chain.rotary(m)[0]), strict=True):
            if name in given and given[name].incremental:
                values[name] += before
        return values

    @property
    def written(self) -> dict[str, float]:
        """The axes that are named, with their values."""
        return {axis: value for axis in AXES if (value := getattr(self, axis)) is not None}

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        if not self.written and self.datum_number is None:
            yield "", "needs an axis, for example CYCL DEF 7.1 X+60"
        if self.written and self.datum_number is not None:
            yield "datum_number", "and shifts of axes cannot stand in one definition"
        elif self.datum_number is not None:
            try:
                row_of(m, int(self.datum_number))
            except LookupError as error:
                yield "datum_number", str(error.args[0])

    def moves(self, m: Machine) -> Iterator[Step]:
        new = self.written if self.datum_number is None else row_of(m, int(self.datum_number))
        x, y, z = (new.get(axis, before) for axis, before in zip("xyz", chain.shift_of(m), strict=True))
        turned = tuple(new.get(axis, before) for axis, before in zip("abc", chain.rotary(m)[0], strict=True))
        yield Write("memory", turned, "rotary_shift")
        yield from chain.define(m, chain.SHIFT, frames.shift(x, y, z) if (x, y, z) != (0, 0, 0) else None)


@CYCLES("CYCL DEF 247", "Presetting", runs="definition", source="11.4")
class Presetting(Cycle):
    """Makes a row of the preset table the datum of the program; cycles 7, 8, 10, 11 and 26 are over, a tilt stays.

    A setup without presets is a machine whose presets are all zero.
    """

    preset_number: float = count("Q339", "number of the preset", at_most=65535, note="0: the one set by hand", example=0)

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        row = int(self.preset_number)
        if row and m.setup.presets and row not in m.tables.presets:
            known = ", ".join(map(str, sorted(m.tables.presets))) or "none but 0"
            yield "preset_number", f"names row {row}, which the preset table does not have (rows: {known})"

    def moves(self, m: Machine) -> Iterator[Step]:
        row = int(self.preset_number)
        yield from chain.reset(m)
        yield Write("memory", row, "preset")
        yield Write("chosen datum", m.tables.presets.get(row, Datum()), "preset")
        yield from chain.carry(m)
