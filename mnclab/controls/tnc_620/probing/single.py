"""Single touches: the cycles 0, 1, 3 and 4 (TNC 620, 16.2, 16.3, 17.2, 17.3).

They run in the active system, shifted or turned; X and Y are those of the ball's centre, Z that of its south pole. The results of
1, 3 and 4 are not compensated.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.cycles.addresses import FAR, choice, coordinate, increment
from mnclab.controls.tnc_620.cycles.planes import ParameterFault, not_zero
from mnclab.controls.tnc_620.language.values import KEPT
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, measured
from mnclab.machine.cycle import CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machine.touching import Contact, ball_from_axis, deflected, unfit
from mnclab.machining.probing.sequences import Steps, results
from mnclab.machining.steps import Touch
from mnclab.text.given import shown

LAST = 1999  # number of a Q parameter
FASTEST = 3000  # mm/min
MACHINE: dict[float, str] = {0: "the active system", 1: "the machine (REF)"}
SILENT: dict[float, str] = {0: "an alarm", 1: "-1 in the fourth result"}
Vector = NDArray[np.float64]

result = partial(param, "Q", unit="count", at_least=0, at_most=LAST, type="integer", example=5)
system = partial(choice, "SYSTEM", modal=False, choices=MACHINE, example=0)
pre = partial(coordinate, default=None, modal=False, default_means="stays")
CYCLES = CycleTable(addresses=SimpleNamespace(
    result_parameter=partial(result, meaning="first Q parameter of the results"),
    x=partial(pre, "X", "pre-position X", example=20), y=partial(pre, "Y", "pre-position Y", example=10),
    z=partial(pre, "Z", "pre-position Z", example=-5),
    axis=partial(param, "axis", "probing axis", "choice", type="text", example="X"),
    angle=partial(param, "ANGLE", "angle from the probing axis", "deg", at_least=-180, at_most=180, example=30),
    reach=partial(increment, "ABST", "farthest way", modal=False, note="negative: the other way", example=10),
    feed=partial(param, "F", "feed of the touch", "mm/min", at_least=0, at_most=FASTEST, example=100),
    back=partial(param, "MB", "way back, at most to the start", at_least=0, at_most=FAR, incremental=True, example=1),
    system=partial(system, meaning="system of direction and result"),
), runs="definition")  # fmt: skip


def in_plane_of(letter: str, degrees: float) -> Vector:
    """A direction (3,): from X towards Y, from Y towards Z, from Z towards X."""
    found, k = np.zeros(3), "XYZ".index(letter)
    found[k], found[(k + 1) % 3] = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return found


def one_of(name: str, given: str, allowed: tuple[str, ...]) -> Iterator[ParameterFault]:
    """A fault of a text that names nothing; a program that says it is refused where it is read."""
    if given not in allowed:
        yield name, f"must be one of {', '.join(allowed)}, got {shown(given)}"


def south_pole(m: Machine) -> Vector:
    """Where the probe stands, as steps have it."""
    return np.array(m.programmed) + (*ball_from_axis(m), 0.0)


def unscaled(c: ProbingCycle, m: Machine) -> Iterator[ParameterFault]:
    """What refuses a single touch."""
    yield from unfit(m)
    sizes = np.linalg.norm(m.matrix[:3, :3], axis=0)
    if np.abs(sizes - 1).max() > 1e-9:
        yield "", "cannot run under a scale other than 1: the ball keeps its size"


def placed(c: Any, m: Machine) -> Iterator[ParameterFault]:
    """The same; a program that is half typed names no pre-position."""
    if c.x is None and c.y is None and c.z is None:
        last = 1 if c.code.endswith(" 0") else 2
        yield "", f"needs its pre-position, X, Y or Z in {c.code}.{last}"
    yield from unscaled(c, m)


def kept(c: Any, count: int = 1) -> Iterator[ParameterFault]:
    """Results that would overwrite what the control keeps itself."""
    names = [f"Q{int(c.result_parameter) + k}" for k in range(count)]
    yield from (("result_parameter", f"cannot be {name}: {KEPT[name][0]}, kept by the control") for name in names if name in KEPT)


def from_place(c: ProbingCycle, m: Machine, way: Vector) -> Steps:
    """To the pre-position at rapid, a touch as the probe table has it, and back; returns the contact.

    Where it was goes into Q115 to Q119, as the spindle stands, without length and radius.
    """
    a, unit = c.approach(m), m.variable_unit
    yield a.go("to the pre-position", c.z, c.x, c.y)
    start = south_pole(m)
    x, y, z = (start + a.reach * way).tolist()
    contact = yield Touch("touch", x, y, z, a.feed, a.ball)
    yield a.go("back", *np.roll(start, 1).tolist())
    (dx, dy), (x, y, z) = ball_from_axis(m), contact.point
    spindle = x - dx, y - dy, z - a.ball + m.tool.effective_length
    yield from results(**{f"Q{115 + k}": value / unit for k, value in enumerate(spindle)})
    yield from results(Q118=math.degrees(m.rotary[0]), Q119=math.degrees(m.rotary[1]))
    return contact


@CYCLES("TCH PROBE 0", "Reference plane", source="16.2", takes="result_parameter probing x y z")
class ReferencePlane(ProbingCycle):
    """A coordinate along an axis, compensated by the ball, for a Q parameter."""

    result_parameter: float = result(meaning="Q parameter of the result")
    probing: str = param("axis", "probing axis and direction", "choice", type="text", example="X+")

    check = placed

    def contradictions(self) -> Iterator[ParameterFault]:
        yield from kept(self)
        yield from one_of("probing", self.probing, tuple(letter + sign for letter in "XYZ" for sign in "+-"))

    def moves(self, m: Machine) -> Moves:
        sense, k, ball = float(f"{self.probing[1]}1"), "XYZ".index(self.probing[0]), m.radius
        contact = yield from from_place(self, m, sense * np.eye(3)[k])
        found = contact.point[k] + sense * ball
        yield from measured([contact], **{self.probing[0]: (found, math.nan)})
        yield from results(**{f"Q{self.result_parameter:.0f}": found / m.variable_unit})


@CYCLES("TCH PROBE 1", "Polar preset", source="16.3", takes="axis angle x y z")
class PolarPreset(ProbingCycle):
    """A touch at an angle to an axis: where the ball stood, in Q115 to Q119."""

    check = placed

    def contradictions(self) -> Iterator[ParameterFault]:
        yield from one_of("axis", self.axis, tuple("XYZ"))

    def moves(self, m: Machine) -> Moves:
        contact = yield from from_place(self, m, in_plane_of(self.axis, self.angle))
        yield from measured([contact], **{name: (place, math.nan) for name, place in zip("XYZ", contact.point)})


def impossible(c: Any) -> Iterator[ParameterFault]:
    """What 3 and 4 refuse whatever the machine."""
    yield from kept(c, 4)
    yield from not_zero(c, "feed", purpose="to touch with")
    if c.reach == 0:
        yield "reach", "must not be 0: a touch needs a way"
    if c.result_parameter + 3 > LAST:
        yield "result_parameter", f"must be at most {LAST - 3}, got {c.result_parameter:g}: four parameters get results"


def from_here(c: Any, m: Machine, way: Vector, silent: bool = False) -> Moves:
    """A touch from where the probe stands, and back; four Q parameters get the ball's centre, and 1, or -1 without a contact.

    `silent`: a stylus that is deflected before makes no alarm, and no touch.
    """
    a, start, way = c.approach(m), south_pole(m), way * math.copysign(1.0, c.reach)
    x, y, z = (start + (0.0, 0.0, a.ball)).tolist()
    contact = Contact((x, y, z), m.to_machine((x, y, z)), hit=False)
    if not (silent and m.felt and deflected(m, m.felt.part, a.ball)):
        x, y, z = (start + abs(c.reach) * way).tolist()
        contact = yield Touch("touch", x, y, z, c.feed, a.ball, "return")
        end = south_pole(m)
        yield a.go("back", *np.roll(end - way * min(c.back, float(np.linalg.norm(end - start))), 1).tolist())
    first, place = int(c.result_parameter), contact.machine_point if c.system else contact.point
    yield from results(**{f"Q{first + k}": value / m.variable_unit for k, value in enumerate(place)})
    yield from results(**{f"Q{first + 3}": 1 if contact.hit else -1})
    if contact.hit:
        yield from measured([contact], **{name: (value, math.nan) for name, value in zip("XYZ", place)})


@CYCLES(
    "TCH PROBE 3", "Measuring", source="17.2", takes="result_parameter axis angle reach feed back system error_mode"
)  # fmt: skip
class MeasuringInPlane(ProbingCycle):
    """A touch at an angle to an axis, in the active system or in that of the machine."""

    error_mode: float = choice("ERRORMODE", "where the stylus is deflected at the start", SILENT, modal=False, example=0)

    check = unscaled

    def contradictions(self) -> Iterator[ParameterFault]:
        yield from impossible(self)
        yield from one_of("axis", self.axis, tuple("XYZ"))

    def moves(self, m: Machine) -> Moves:
        way = in_plane_of(self.axis, self.angle)
        return from_here(self, m, m.matrix[:3, :3].T @ way if self.system else way, silent=self.error_mode == 1)


@CYCLES(
    "TCH PROBE 4", "Measuring in three dimensions", source="17.3",
    takes="result_parameter direction_x direction_y direction_z reach feed back system",
)  # fmt: skip
class MeasuringInSpace(ProbingCycle):
    """A touch along a direction of the active system."""

    direction_x: float = increment("IX", "direction, X", modal=False, example=-0.5)
    direction_y: float = increment("IY", "direction, Y", modal=False, example=-1)
    direction_z: float = increment("IZ", "direction, Z", modal=False, example=-1)
    system: float = system(meaning="system of the result")

    def contradictions(self) -> Iterator[ParameterFault]:
        yield from impossible(self)
        if not (self.direction_x or self.direction_y or self.direction_z):
            yield "direction_x", "must not be 0 with IY and IZ: they are the direction"

    check = unscaled

    def moves(self, m: Machine) -> Moves:
        way = np.array([self.direction_x, self.direction_y, self.direction_z])
        return from_here(self, m, way / np.linalg.norm(way))
