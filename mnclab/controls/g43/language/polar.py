"""Polar coordinates: G15, G16.

The first axis of the plane is the radius, the second the angle in degrees. Under G90 the radius counts from the origin and
the angle from the first axis; under G91 the radius counts from where the tool stands, and the angle from the last one.
"""

from __future__ import annotations

import math

import numpy as np

from mnclab.controls.g43.remarks import ISO
from mnclab.controls.g43.state import Polar, memory
from mnclab.controls.word_address import motion
from mnclab.controls.word_address.motion import AXES
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import PLANES
from mnclab.machine.cycle import Given, Values
from mnclab.machine.machine import Machine

FUNCTIONS = FunctionTable()
POLAR = {"G16": "Polar coordinates on", "G15": "Polar coordinates off"}


@FUNCTIONS("G15 G16", POLAR, group="polar", phase="transformation", power_on="G15", source=ISO)
def polar(m: Machine, words: Words) -> None:
    """No motion; the pole is the origin, under G91 the present point."""
    motion.uncompensated(m, words)
    if words.code == "G15":
        memory(m).polar = None
        return
    first, second, _ = PLANES[m.plane]
    u, v = m.programmed[first], m.programmed[second]
    pole = (0.0, 0.0) if m.modal["dimension"] == "G90" else (u, v)
    du, dv = u - pole[0], v - pole[1]
    memory(m).polar = Polar(pole, math.hypot(du, dv), math.degrees(math.atan2(dv, du)))


def point(m: Machine, radius: float | None, angle: float | None) -> dict[str, float]:
    """Where a radius (mm) and an angle (degrees) lead; what is not written stays. Coordinates by axis."""
    kept, (first, second, _) = memory(m).polar, PLANES[m.plane]
    assert kept is not None
    pole, r, a = kept
    absolute = m.modal["dimension"] == "G90"
    if radius is not None:
        r, pole = radius, (0.0, 0.0) if absolute else (m.programmed[first], m.programmed[second])
    if angle is not None:
        a = angle if absolute else a + angle
    memory(m).polar = Polar(pole, r, a)
    turned = math.radians(a)
    place = pole[0] + r * math.cos(turned), pole[1] + r * math.sin(turned)
    return {AXES[k].lower(): value for k, value in zip((first, second), place, strict=True)}


def targets(m: Machine, words: Words) -> dict[str, float]:
    """Where the axes that are written go."""
    first, second, normal = (AXES[k] for k in PLANES[m.plane])
    to = point(
        m, m.length(words[first]) if first in words else None, m.value(words[second]) if second in words else None
    ) if first in words or second in words else {}  # fmt: skip
    if normal in words:
        value, axis = m.length(words[normal]), AXES.index(normal)
        to[normal.lower()] = value if m.modal["dimension"] == "G90" else m.programmed[axis] + value
    return to


def holes(m: Machine, values: Values, given: Given, kept: Values) -> None:
    """The places of a cycle and of its repeats: X and Y of its values, and more of them in `kept`, if there are."""
    if m.plane != "XY":
        m.alarm(f"a cycle under polar coordinates needs the plane XY, got {m.plane}", hint="write G17 before G16")
    if given.keys().isdisjoint(("x", "y")):
        return
    radius = values["x"] if "x" in given else None
    angle = values["y"] / m.variable_unit if "y" in given else None  # which is no length
    count = int(values.get("repeats", 1))
    places = [tuple(point(m, radius, angle).values()) for _ in range(min(max(count, 1), 9999))]
    values["x"], values["y"] = places[0]
    kept["points"] = np.array(places) if count > 1 else None
