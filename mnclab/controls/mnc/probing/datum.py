"""The base rotation and the datum from a measurement (MNC 12: "base rotation", "datum from measurement").

The base rotation turns the plane about the datum point, outside the shift of G92 and the rotation of G39. A row of the
datum table holds an angle only once one was stored, 0 included; selecting a row without one keeps the base rotation.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from mnclab.controls.mnc.state import memory
from mnclab.geometry import frames
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.machining.steps import Measure, Step, Write

BASE = "base rotation"  # the frame
AXES = "xyz"
SAME = 1e-12


def base_rotation(m: Machine) -> float:
    """Degrees, counter-clockwise."""
    return memory(m).base_rotation


def turn_base(angle: float) -> Iterator[Step]:
    """Make an angle the base rotation; nothing moves, the place is read anew."""
    yield Write("frame", frames.turn(math.radians(angle)) if angle else None, BASE)
    yield Write("memory", angle, "base_rotation")


def store_angle(m: Machine, row: float, angle: float) -> Iterator[Step]:
    """Write the column rotation of a row of the datum table; row 0 is none."""
    if row:
        yield Write("datums", m.tables.datums.get(int(row), Datum())._replace(rotation=angle), int(row))
        yield Write("memory", memory(m).angled | {int(row)}, "angled")


def set_datum(
    m: Machine, found: Mapping[int, tuple[float, float]], row: float, apply: bool, turned: float | None = None
) -> Iterator[Step]:  # fmt: skip
    """Make a measured point the datum: by axis (0, 1, 2) its measured coordinate and the one that it gets.

    `apply`: the working datum becomes it, until the next row is selected. `row` > 0: its measured columns are written. `turned`
    (degrees) is added to the base rotation where it is applied, and written too.
    """
    measured, new, mask = np.zeros(3), np.zeros(3), np.zeros(3)
    for k, (is_, gets) in found.items():
        measured[k], new[k], mask[k] = is_, gets, 1.0
    datum, local = m.frames["datum"][:3, 3], m.frames["local"][:3, 3]
    before = base_rotation(m)
    angle = before + turned if apply and turned is not None else before
    old, turn = (frames.turn(math.radians(each))[:3, :3] for each in (before, angle))
    origin = datum + old @ ((measured + local) * mask) - turn @ (new * mask)
    changed = [k for k in range(3) if np.abs(old[k] * mask).max() > SAME]
    if row:
        kept = m.tables.datums.get(int(row), Datum())
        yield Write("datums", kept._replace(**{AXES[k]: float(origin[k]) for k in changed}), int(row))
    if row or apply:
        for k in changed:
            yield Measure(f"datum {'XYZ'[k]}", float(origin[k]))
    if apply:
        if turned is not None:
            yield from turn_base(angle)
            yield from store_angle(m, row, angle)
        rest = (local * (1 - mask)).tolist()  # of the shift of G92, on the axes that were not measured
        if "local" in m.frames:
            yield Write("frame", frames.shift(*rest) if any(rest) else None, "local")
        yield Write("datum", Datum(*(float(origin[k] if k in changed else datum[k]) for k in range(3))), "datum")
