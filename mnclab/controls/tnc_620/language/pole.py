"""CC, the circle centre and pole, and points told by their distance and angle from it (catalogue: CC, LP, CP)."""

from __future__ import annotations

import math

from mnclab.controls.tnc_620.language.checks import counted
from mnclab.machine.control import FunctionTable, Words
from mnclab.machine.machine import Machine

FUNCTIONS = FunctionTable()
NEAR = 1e-6  # mm from the pole, where a direction means nothing


@FUNCTIONS("CC", "Circle centre, pole", takes="X Y", source="8.3, example")
def centre(m: Machine, words: Words) -> None:
    """No motion; a coordinate that is not written is that of the last programmed position, which IX and IY count from."""
    here = zip("XY", m.programmed, strict=False)
    x, y = (counted(m, words[axis], at) if axis in words else at for axis, at in here)
    m.pole = (x, y)
    m.log("pole", m.pole)


def pole(m: Machine, words: Words, meaning: str = "pole") -> tuple[float, float]:
    if m.pole is None:
        m.alarm(f"{words.code} needs a {meaning}: no CC was programmed", hint="write CC X… Y… before it")
    return m.pole


def angle_here(m: Machine, words: Words) -> float:
    """The polar angle of the present position, rad; an Alarm at the pole itself."""
    (u, v), (x, y, _) = pole(m, words), m.programmed
    if math.hypot(x - u, y - v) < NEAR:
        what = f"{words.code}: the tool stands at the pole, where it has no polar angle"
        m.alarm(what, words.get("PA"), "write the angle PA, absolute")
    return math.atan2(y - v, x - u)


def polar_point(m: Machine, words: Words) -> tuple[float, float]:
    """The point of PR and PA; one that is not written stays as it is, IPR and IPA count from the present position."""
    (u, v), (x, y, _) = pole(m, words), m.programmed
    if "PR" not in words and "PA" not in words:
        m.alarm(f"{words.code} needs PR (polar radius) or PA (polar angle)")
    radius = math.hypot(x - u, y - v)
    if "PR" in words and (radius := counted(m, words["PR"], radius)) < 0:
        m.alarm(f"{words.code} PR (polar radius) must be at least 0, got {radius:g}", words["PR"])
    if "PA" not in words or words["PA"].incremental:
        turn = m.value(words["PA"]) if "PA" in words else 0.0
        angle = math.degrees(angle_here(m, words)) + turn if radius else 0.0
    else:
        angle = m.value(words["PA"])
    c, s = cosine_and_sine(angle)
    return u + radius * c, v + radius * s


def cosine_and_sine(angle: float) -> tuple[float, float]:
    """Of an angle in degrees, exact at whole quarters of a turn."""
    quarters = angle / 90
    if quarters == round(quarters):
        return ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))[round(quarters) % 4]
    return math.cos(math.radians(angle)), math.sin(math.radians(angle))
