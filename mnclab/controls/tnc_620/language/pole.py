"""CC, the circle centre and pole, and points told by their distance and angle from it (catalogue: CC, LP, CP).

The pole lies in the plane of the axes that CC names: the working plane, or with the tool axis among them another one. Angles
count from X in XY, from Y in YZ and from Z in ZX, positive towards the other axis of the plane (angle reference axes of the
HEIDENHAIN pilots; DR+ turns the same way).
"""

from __future__ import annotations

import math
from contextlib import AbstractContextManager
from typing import Any

from mnclab.controls.tnc_620.language.checks import counted, refuse_on_cylinder, written
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.coordinates import PLANES
from mnclab.machine.machine import Machine

FUNCTIONS = FunctionTable()
NEAR = 1e-6  # mm from the pole, where a direction means nothing
AXES = "XYZ"


def axes_of(plane: str) -> tuple[str, str]:
    """The letters of the first and the second axis of a plane."""
    return plane[0], plane[1]


def plane_of(m: Machine, words: Words) -> str:
    """The plane of the axes that a block names: the working plane, unless the tool axis is one of two."""
    named = [axis for axis in AXES if axis in words]
    if set(named) <= set(m.plane):
        return m.plane
    outside = next(words[axis] for axis in named if axis not in m.plane)
    if len(named) != 2:
        what = f"{words.code} {outside}: outside the working plane {m.plane} a circle names the two axes of its plane"
        m.alarm(what, outside, f"for example {words.code} {m.plane[0]}… {outside.address}…")
    return next(plane for plane in ("XY", "YZ", "ZX") if set(plane) == set(named))


def within_plane(m: Machine, words: Words, plane: str) -> AbstractContextManager[None]:
    """Inside, arcs lie in a plane that need not be the working plane."""
    if plane == m.plane:
        return m.within()
    if m.side:
        what = f"{words.code}: an arc in {plane} cannot stand under radius compensation, which lies in {m.plane}"
        m.alarm(what, hint="write R0 in a straight line before it")
    return m.within(plane=plane)


@FUNCTIONS("CC", "Circle centre, pole", takes="X Y Z", source="8.3, example")
def centre(m: Machine, words: Words) -> None:
    """No motion; a coordinate that is not written is that of the last programmed position, which IX and IY count from.

    X and Z, or Y and Z, make a centre in the plane ZX or YZ.
    """
    refuse_on_cylinder(m, words)
    plane = plane_of(m, words)
    here = ((axis, m.programmed[AXES.index(axis)]) for axis in axes_of(plane))
    u, v = (counted(m, words[axis], at) if axis in words else at for axis, at in here)
    m.pole = u, v
    m.log("pole", m.pole)
    if plane != memory(m).pole_plane:
        memory(m).pole_plane = plane
        m.log("pole plane", plane)


def pole(m: Machine, words: Words, meaning: str = "pole") -> tuple[str, tuple[float, float]]:
    """The plane of the pole and the pole in it."""
    refuse_on_cylinder(m, words)
    if m.pole is None:
        m.alarm(f"{words.code} needs a {meaning}: no CC was programmed", hint="write CC X… Y… before it")
    plane = memory(m).pole_plane
    return plane, m.pole


def away(m: Machine, plane: str, about: tuple[float, float]) -> tuple[float, float]:
    """From the pole to the present position."""
    first, second, _ = PLANES[plane]
    return m.programmed[first] - about[0], m.programmed[second] - about[1]


def angle_here(m: Machine, words: Words) -> float:
    """The polar angle of the present position, rad; an Alarm at the pole itself."""
    u, v = away(m, *pole(m, words))
    if math.hypot(u, v) < NEAR:
        what = f"{words.code}: the tool stands at the pole, where it has no polar angle"
        m.alarm(what, words.get("PA"), "write the angle PA, absolute")
    return math.atan2(v, u)


def polar_point(m: Machine, words: Words) -> dict[str, Any]:
    """The point of PR and PA, by axes of its plane (`x=`, …); one that is not written stays as it is.

    IPR and IPA count from the present position.
    """
    plane, (u, v) = pole(m, words)
    if "PR" not in words and "PA" not in words:
        m.alarm(f"{words.code} needs PR (polar radius) or PA (polar angle)")
    radius = math.hypot(*away(m, plane, (u, v)))
    if "PR" in words and (radius := counted(m, words["PR"], radius)) < 0:
        m.alarm(f"{words.code} PR (polar radius) must be at least 0, got {written(m, words['PR'], radius):g}", words["PR"])
    if "PA" not in words or words["PA"].incremental:
        turn = m.value(words["PA"]) if "PA" in words else 0.0
        angle = math.degrees(angle_here(m, words)) + turn if radius else 0.0
    else:
        angle = m.value(words["PA"])
    c, s = cosine_and_sine(angle)
    first, second = axes_of(plane.lower())
    return {first: u + radius * c, second: v + radius * s}


def cosine_and_sine(angle: float) -> tuple[float, float]:
    """Of an angle in degrees, exact at whole quarters of a turn."""
    quarters = angle / 90
    if quarters == round(quarters):
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[round(quarters) % 4]
    return math.cos(math.radians(angle)), math.sin(math.radians(angle))
