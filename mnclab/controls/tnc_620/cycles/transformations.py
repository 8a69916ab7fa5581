"""Coordinate transformations (chapter 11): the datum shift and the rotation.

Each acts as soon as it is defined, about the datum that is active then: the frames form a chain in the order of
definition. A new value replaces the old one in its place; a neutral one takes the frame out of the chain.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from mnclab.geometry import frames
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.text.program import Word

CYCLES = CycleTable()
FAR = 99999.9999  # mm


@CYCLES("CYCL DEF 7", "Datum shift", runs="definition", source="11.2")
class DatumShift(Cycle):
    """Moves the datum; IX counts from the shift that was valid before, an axis that is not named keeps its shift."""

    x: float | None = param(
        "X", "datum shift along X", default=None, default_means="as it is", at_least=-FAR, at_most=FAR, modal=True
    )
    y: float | None = param(
        "Y", "datum shift along Y", default=None, default_means="as it is", at_least=-FAR, at_most=FAR, modal=True
    )
    z: float | None = param(
        "Z", "datum shift along Z", default=None, default_means="as it is", at_least=-FAR, at_most=FAR, modal=True
    )

    @classmethod
    def prepare(
        cls, values: dict[str, Any], given: Mapping[str, Word], m: Machine, kept: dict[str, Any]
    ) -> dict[str, Any]:
        """Increments are added to the shift as it is."""
        for name, before in zip("xyz", shift(m), strict=True):
            if name in given and given[name].incremental:
                values[name] += before
        return values

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        """At least one axis."""
        if self.x is self.y is self.z is None:
            yield "", "needs an axis, for example CYCL DEF 7.1 X+60"

    def moves(self, m: Machine) -> None:
        """No motion: the register is read anew from where the tip stands."""
        x, y, z = (
            before if new is None else new for new, before in zip((self.x, self.y, self.z), shift(m), strict=True)
        )
        m.set_frame("shift", frames.shift(x, y, z) if (x, y, z) != (0, 0, 0) else None, keep="tip")


def shift(m: Machine) -> tuple[float, float, float]:
    """The active datum shift, mm."""
    x, y, z = m.frames["shift"][:3, 3].tolist()
    return x, y, z


@CYCLES("CYCL DEF 10", "Rotation", runs="definition", source="11.6")
class Rotation(Cycle):
    """Turns the coordinates of the working plane about the active datum; cancels a radius compensation."""

    angle: float = param(
        "ROT", "rotation angle", "deg", at_least=-360, at_most=360, modal=True, note="IROT adds to the active angle"
    )

    @classmethod
    def prepare(
        cls, values: dict[str, Any], given: Mapping[str, Word], m: Machine, kept: dict[str, Any]
    ) -> dict[str, Any]:
        """An increment within its range is added to the active angle; the sum has no limit and counts modulo a whole turn."""
        if "angle" in given and given["angle"].incremental and abs(values["angle"]) <= 360:
            values["angle"] = math.fmod(m.memory.get("rotation", 0.0) + values["angle"], 360)
        return values

    def moves(self, m: Machine) -> None:
        """No motion: the register is read anew from where the tip stands."""
        m.change("side", 0)
        m.memory["rotation"] = self.angle
        m.set_frame("rotation", frames.turn(math.radians(self.angle)) if self.angle % 360 else None, keep="tip")


def cancel(m: Machine) -> None:
    """The end of a program takes every transformation away (11.1)."""
    for name, _ in list(m.frames):
        if name not in m.frames.slots:
            m.set_frame(name, None)
    m.memory.pop("rotation", None)
