"""The chain of transformations (11.1): in the order of definition, one place for each kind before the tilt and one behind.

A new value replaces the old one in its place; a neutral one takes the frame out, and a later definition is appended. What is
defined while the plane is tilted acts in the tilted system; it is a frame of its own, with the mark `TILTED`.

What changes the chain yields steps. Rotary axes have no frame: their shift and their mirror image are kept in the memory of
the machine, see `to_rotary`.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator, Mapping
from typing import Any, TypeAlias

import numpy as np

from mnclab.controls.tnc_620.state import Place, active_preset, memory
from mnclab.geometry.frames import Matrix
from mnclab.machine.machine import Machine
from mnclab.machine.setup import Datum
from mnclab.machining.steps import Write
from mnclab.path.listing import figure
from mnclab.text.program import Word

SHIFT, MIRROR, ROTATION, SCALE, FACTORS = "shift", "mirror", "rotation", "scale", "axis scales"
KINDS = (SHIFT, MIRROR, ROTATION, SCALE, FACTORS)
TILT = "tilt"
CARRIED = "rotary offset"
TILTED = " (tilted)"
ALSO = " (before)"  # what outlived its tilt, beside one of its kind

Values: TypeAlias = dict[str, Any]  # of `Cycle.prepare`, by name of the parameter, as the words are
Given: TypeAlias = Mapping[str, Word]


def absolute(m: Machine, code: str, given: Given) -> None:
    """An alarm at the first word that is incremental."""
    for word in given.values():
        if word.incremental:
            m.alarm(f"{code} takes no incremental value, got I{word.address}", word)


def place(m: Machine, kind: str) -> str:
    """The name of the frame that a definition of a kind sets now."""
    return kind + TILTED if TILT in m.frames else kind


def define(m: Machine, kind: str, matrix: Matrix | None) -> Iterator[Write]:
    """Set the frame of a kind where it belongs, None for a neutral one; the register is read anew from where the tip stands."""
    if memory(m).developed is not None:
        m.alarm("the contour of a cylinder takes no transformation")
    name = place(m, kind)
    if name == kind and kind + ALSO in m.frames:  # one value stands for both
        yield Write("frame", None, kind + ALSO)
    yield Write("frame", matrix, name)


def shift_of(m: Machine) -> tuple[float, float, float]:
    """The datum shift that a new one replaces, mm."""
    name = place(m, SHIFT)
    x, y, z = (m.frames[name][:3, 3] + (m.frames[SHIFT + ALSO][:3, 3] if name == SHIFT else 0.0)).tolist()
    return x, y, z


def angle_of(m: Machine) -> float:
    """The rotation that a new one replaces, degrees."""
    angles = memory(m).rotation_angles
    name = place(m, ROTATION)
    return angles.get(name, 0.0) + (angles.get(ROTATION + ALSO, 0.0) if name == ROTATION else 0.0)


def remember_angle(m: Machine, angle: float) -> Iterator[Write]:
    """Note the rotation that is set now, degrees."""
    name = place(m, ROTATION)
    angles = memory(m).rotation_angles
    kept = {key: value for key, value in angles.items() if key != ROTATION + ALSO or name != ROTATION}
    yield Write("memory", {**kept, name: angle}, "rotation_angles")


def count_with(m: Machine, to: Place | None) -> Iterator[Write]:
    """Coordinates count with the rotary axes at A, B, C, rad, where they must stand for the tilt; None: without one.

    A machine whose kinematics is not known has its coordinates on the part, whatever turns; so has one that leads the tip.
    """
    yield Write("memory", to, "tilt_axes")
    if m.tables.kinematics is None:
        return
    yield from carry(m)
    if m.reckoned is not None:
        yield Write("reckoned", to or (0.0, 0.0, 0.0))
    yield Write("history", None if to is None else solved(m, to), "tilted plane")


def carry(m: Machine) -> Iterator[Write]:
    """A table that counts from elsewhere (C_OFFS of the preset) has turned the part by that before it was measured: where
    coordinates are those of the part, in a tilted plane and while the tip is led, they are turned by it, too."""
    on_the_part = memory(m).tilt_axes is not None or memory(m).led is not None
    matrix = measured_at(m) if on_the_part else None
    if matrix is not None or CARRIED in m.frames:
        yield Write("frame", matrix, CARRIED)


def measured_at(m: Machine) -> Matrix | None:
    """From where a place was measured with the table at its offsets to where it is on the part; None where that is the same."""
    if (kinematics := m.tables.kinematics) is None:
        return None
    angles = np.zeros(3)
    for axis in kinematics.table:
        angles[axis.number] = math.radians(offset(m, axis.number))
    return kinematics.carried(angles, 0.0) if angles.any() else None


def before_tilt(m: Machine) -> Matrix:
    """From the untilted system to the part."""
    before, outer = m.frames.before(TILT), measured_at(m)
    return before if outer is None or CARRIED in m.frames else np.asarray(outer @ before)


def solved(m: Machine, to: Place) -> str:
    """Where the rotary axes must stand, and which way the tool lies on the part then, in words."""
    assert (kinematics := m.tables.kinematics) is not None
    stands = [f"{axis}{figure(math.degrees(to['ABC'.index(axis)]))}" for axis in kinematics.names]
    return f"{' '.join(stands)}, tool axis ({', '.join(map(figure, kinematics.orientation(to)[:, 2].tolist()))})"


def tilted(m: Machine) -> list[str]:
    """The kinds of what is defined behind the tilt."""
    return [kind for kind in KINDS if kind + TILTED in m.frames]


def untilt(m: Machine) -> Generator[Write, None, list[str]]:
    """Take the tilt out; what was defined behind it acts in the untilted system from now on. The kinds of those are told."""
    left = tilted(m)
    for kind in left:
        now = kind if kind not in m.frames else kind + ALSO
        yield Write("renamed", now, kind + TILTED)
        if kind == ROTATION:
            angles = dict(memory(m).rotation_angles)
            angles[now] = angles.pop(kind + TILTED, 0.0)
            yield Write("memory", angles, "rotation_angles")
    yield Write("frame", None, TILT)
    yield from count_with(m, None)
    return left


def reset(m: Machine) -> Iterator[Write]:
    """Take the transformations of cycles 7, 8, 10, 11 and 26 away; a tilt stays (11.4)."""
    for name, _ in list(m.frames):
        if name != TILT and name not in m.frames.slots:
            yield Write("frame", None, name)
    for neutral, name in (({}, "rotation_angles"), ((0.0, 0.0, 0.0), "rotary_shift"), ("", "rotary_mirror")):
        yield Write("memory", neutral, name)


def cancel(m: Machine) -> Iterator[Write]:
    """The end of a program takes every transformation away (11.1)."""
    yield from reset(m)
    yield Write("frame", None, TILT)
    if memory(m).tilt_axes is not None:
        yield from count_with(m, None)


def rotary(m: Machine) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Shift (degrees) and sense (1 or -1) of the axes A, B and C."""
    kept = memory(m)
    return kept.rotary_shift, tuple(-1.0 if axis in kept.rotary_mirror else 1.0 for axis in "ABC")


def offset(m: Machine, axis: int) -> float:
    """Where a rotary axis counts from by the active preset, degrees (A_OFFS, B_OFFS, C_OFFS)."""
    return float(m.tables.presets.get(active_preset(m), Datum())[3 + axis])


def to_rotary(m: Machine, axis: int, angle: float) -> float:
    """The position of a rotary axis, degrees, for an angle of the program."""
    shift, sense = rotary(m)
    return offset(m, axis) + shift[axis] + sense[axis] * angle


def to_angle(m: Machine, axis: int, position: float) -> float:
    """The angle of the program, degrees, for a position of a rotary axis."""
    shift, sense = rotary(m)
    return sense[axis] * (position - offset(m, axis) - shift[axis])
