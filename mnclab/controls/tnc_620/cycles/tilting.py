"""The tilted working plane: cycle 19 (11.9), and where the rotary axes must stand for a plane, however it was told.

Rotation, shift and cycles act in a system that is tilted about the active datum, and the tool must lie along its Z. Which axes
turn it there says the kinematics of the machine. Without one positions are those of the tip on the workpiece, so that heads and
tables look the same, and the setting "rotary_axes" names the axes. Whether the angles of the cycle are spatial or those of the
axes ("tilt_angles") is up to the builder of the machine.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np

from mnclab.controls.tnc_620.cycles import chain
from mnclab.controls.tnc_620.cycles.addresses import angle, distance, feed
from mnclab.controls.tnc_620.cycles.chain import Given, Values
from mnclab.controls.tnc_620.cycles.planes import ParameterFault, in_program_coordinates, not_zero
from mnclab.controls.tnc_620.state import Place, memory
from mnclab.geometry import frames
from mnclab.geometry.frames import Matrix
from mnclab.geometry.kinematics import NAMES, Axis, Kinematics, shorter
from mnclab.machine.control import Setting
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Go, Say, Step, Swivel, Write
from mnclab.text.program import Word

CYCLES = CycleTable()
PAIRS = ("CA", "CB", "AB", "BA")
SETTINGS = (
    Setting(
        "rotary_axes", "CA", "which rotary axes there are, the one that carries the other first, if Setup.kinematics says none",
        "11.9", {pair: f"{pair[0]} carries {pair[1]}" for pair in PAIRS},
    ),
    Setting(
        "tilt_angles", "spatial", "what the angles of cycle 19 are", "11.9",
        {"spatial": "turns about the fixed axes X, then Y, then Z", "axes": "positions of the rotary axes"},
    ),
)  # fmt: skip
RESULTS = ("Q120", "Q121", "Q122")
REVERSE = "reset in the reverse order of definition"
LEVEL = 1e-12  # by which Z of a plane may differ from Z before it
STILL: dict[str, Any] = {"default": None, "default_means": "they are not moved"}
tilt = partial(angle, default=None, default_means="as it is")


@CYCLES("CYCL DEF 19", "Working plane", runs="definition", source="11.9")
class WorkingPlane(Cycle):
    """Tilts the working plane about the active datum and writes where the rotary axes must stand into Q120 to Q122.

    F and ABST move them there while the point ABST below the tip stands still; without them the program does. Three angles of
    0 are the rotary axes at 0, as the reset wants them before the function is switched off; without a word it is off.
    """

    about = in_program_coordinates
    angle_a: float | None = tilt("A", "tilt angle A")
    angle_b: float | None = tilt("B", "tilt angle B", example=30)
    angle_c: float | None = tilt("C", "tilt angle C")
    rotary_feed: float | None = feed("F", "feed of the rotary axes", unit="deg/min", **STILL)
    set_up_clearance: float | None = distance(
        "ABST", "set-up clearance", **STILL, note="how far below the tip the point is that stands still"
    )

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        """Angles are absolute; one that is not written is that of the cycle before."""
        chain.absolute(m, cls.code, given)
        if given:
            before = memory(m).tilt_angles
            values |= {f"angle_{axis}": before.get(axis, 0.0) for axis in "abc" if f"angle_{axis}" not in given}
        return values

    @property
    def angles(self) -> Place:
        """A, B, C, degrees."""
        return self.angle_a or 0.0, self.angle_b or 0.0, self.angle_c or 0.0

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        if m.side:
            yield "", "cannot tilt the plane under radius compensation: write R0 before"
        if (self.rotary_feed is None) != (self.set_up_clearance is None):
            name = "rotary_feed" if self.rotary_feed is None else "set_up_clearance"
            yield name, "is missing: to position the rotary axes both F and ABST are needed"
        yield from not_zero(self, "rotary_feed", purpose="to position the rotary axes")
        there = rotary_axes(m).names
        for axis, value in zip(NAMES, self.angles, strict=True) if m.settings["tilt_angles"] == "axes" else ():
            if value and axis not in there:
                yield f"angle_{axis.lower()}", f"must be 0, got {value:g}: the rotary axes are {' and '.join(there)}"

    def moves(self, m: Machine) -> Iterator[Step]:
        if self.angle_a is None:  # no word was written: the function is off
            yield from over(m)
            return
        if m.settings["tilt_angles"] == "axes":
            to = yield from begin_by_axes(m, with_axes(m, m.rotary, self.angles))
        elif not any(self.angles) and m.tables.kinematics is not None and level(m):
            to = yield from _begin(m, frames.IDENTITY, self.angles, at_zero(m), False)
        else:
            to = yield from begin(m, self.code, frames.spatial(*map(math.radians, self.angles)), self.angles)
        if self.rotary_feed is not None:
            assert self.set_up_clearance is not None
            yield from position(m, to, self.rotary_feed, self.set_up_clearance)


class Choice(NamedTuple):
    """Which of two ways to turn, a word SEQ or SYM with its sign, and what a free axis does: "TABLE", "COORD", "" it stays."""

    way: Word | None = None
    free: str = ""


def over(m: Machine) -> Iterator[Step]:
    """No tilt from now on."""
    yield Write("memory", {}, "tilt_angles")
    if chain.TILT in m.frames and (left := (yield from chain.untilt(m))):
        sentence = f"is switched off, and {', '.join(left)} defined behind it act in the untilted system"
        yield Say(sentence, REVERSE)


SHORTER = Choice()


def begin(
    m: Machine, code: str, matrix: Matrix, angles: Place, choice: Choice = SHORTER
) -> Generator[Step, Any, Place]:  # fmt: skip
    """Tilt by a matrix, of spatial `angles` (degrees) that system data tell; returns where A, B, C must stand, rad."""
    to = solution(m, code, matrix, choice)
    return (yield from _begin(m, matrix, angles, to, False))


def begin_by_axes(m: Machine, to: Place) -> Generator[Step, Any, Place]:
    """Tilt so that the plane is that of the tool where A, B, C stand at positions, rad."""
    tool = np.eye(4)
    tool[:3, :3] = rotary_axes(m).orientation(to)
    matrix = tool
    if m.tables.kinematics is not None:  # what turns the datum does not turn these axes, and a mirror image stays one
        before = chain.before_tilt(m)[:3, :3]
        matrix = np.eye(4)
        matrix[:3, :3] = np.linalg.solve(before / np.linalg.norm(before, axis=0), tool[:3, :3]) @ m.frames[chain.MIRROR][:3, :3]
    a, b, c = (math.degrees(angle) if axis in rotary_axes(m).names else 0.0 for axis, angle in zip(NAMES, to, strict=True))
    return (yield from _begin(m, matrix, (a, b, c), to, True))


def _begin(m: Machine, matrix: Matrix, angles: Place, to: Place, by_axes: bool) -> Generator[Step, Any, Place]:
    if (left := chain.tilted(m)) and not np.allclose(matrix, m.frames[chain.TILT]):
        yield Say(f"tilts about the datum before the plane, and {', '.join(left)} defined in that act in the new one", REVERSE)
    yield Write("memory", dict(zip("abc", angles, strict=True)), "tilt_angles")
    yield Write("memory", by_axes, "tilt_by_axes")
    yield Write("frame", matrix, chain.TILT)
    yield from chain.count_with(m, to)
    yield from results(m, to)
    return to


@cache
def _in_a_head(pair: str) -> Kinematics:
    return Kinematics(head=(Axis(pair[0]), Axis(pair[1])))


def rotary_axes(m: Machine) -> Kinematics:
    """The rotary axes of the machine; where its kinematics is not known as a head, which turns the tool as a table does."""
    return m.tables.kinematics or _in_a_head(m.settings["rotary_axes"])


def with_axes(m: Machine, before: Place, degrees: Place) -> Place:
    """A, B, C, rad: an angle for every axis that there is, the others as they were."""
    there = rotary_axes(m).names
    a, b, c = (math.radians(new) if axis in there else old for axis, new, old in zip(NAMES, degrees, before, strict=True))
    return a, b, c


def at_zero(m: Machine) -> Place:
    """A, B, C, rad, where the rotary axes show 0: without a tilt that is how coordinates count, so that none is free."""
    return with_axes(m, m.rotary, (chain.offset(m, 0), chain.offset(m, 1), chain.offset(m, 2)))


def level(m: Machine) -> bool:
    """Whether Z of the untilted system is that of the machine, as far as its kinematics is known."""
    x, y, z = chain.before_tilt(m)[:3, 2].tolist()
    return m.tables.kinematics is None or math.hypot(x, y) < LEVEL * abs(z)


def solution(m: Machine, code: str, matrix: Matrix, choice: Choice = SHORTER) -> Place:
    """Where A, B and C must stand, rad, for the tool to lie along Z of a tilted system: of both ways within the limits that of
    SEQ or SYM, else the shorter one. An Alarm where there is none."""
    axes, using = rotary_axes(m), memory(m).tilting
    tool, near = (chain.before_tilt(m) @ matrix)[:3, 2], np.array(m.rotary)
    free = axes.free(tool, near, using) if choice.free else None
    if free is not None and (choice.free == "COORD" or not (m.tables.kinematics and free in axes.head)):
        turns = choice.free == "TABLE" and matrix[2, 2] > 1 - LEVEL
        near[free.number] = math.atan2(matrix[1, 0], matrix[0, 0]) if turns else 0.0
        near[free.number] += math.radians(chain.offset(m, free.number)) if m.tables.kinematics else 0.0
    both = axes.solutions(tool, near, using)
    allowed = both.copy()
    if choice.way is not None:
        sign = 1 if choice.way.value == "+" else -1
        tilting = both[:, 0, axes.tilting(using)[-1].number]
        wrong = _on_the_other_side(tilting, sign) if choice.way.address == "SEQ" else np.array([sign < 0, sign > 0])
        allowed[wrong] = np.nan
    a, b, c = shorter(allowed, np.array(m.rotary)[None])[0].tolist()
    if math.isnan(a):
        other = choice.way is not None and not np.isnan(both).all()
        what = f"{code} {choice.way.address}{choice.way.value}" if choice.way is not None else code
        names = " and ".join(axis for axis in axes.names if using is None or axis in using)
        hint = f"without {choice.way.address} there is one" if other and choice.way is not None else f"the machine: {axes}"
        m.alarm(f"{what}: no position of {names} turns the tool square to this plane", choice.way, hint)
    return a, b, c


def _on_the_other_side(angles: Any, sign: int) -> Any:
    """Angles (n,) rad whose sign is the other one; 0 and half a turn have both."""
    side = np.sin(angles)
    return sign * np.where(np.abs(side) < 1e-9, 0.0, side) < 0


def axis_positions(m: Machine, code: str) -> Place:
    """Where A, B and C must stand, rad, for the system that is active."""
    return solution(m, code, m.frames[chain.TILT])


def results(m: Machine, to: Place) -> Iterator[Write]:
    """Positions (rad) as the parameters that hold them, degrees, as a block would name them."""
    for k, name in enumerate(RESULTS):
        yield Write("variable", round(chain.to_angle(m, k, math.degrees(to[k])), 12), name)


def position(m: Machine, to: Place, rotary_feed: float, below: float | None = None) -> Iterator[Step]:
    """Turn the axes together, at degrees a minute; the point `below` the tip stands still, so that the tip goes round it. None:
    they turn alone, and without a kinematics the tip stands."""
    a, b, c = map(math.degrees, to)
    way = math.degrees(max(abs(new - old) for new, old in zip(to, m.rotary, strict=True)))
    if not way:
        return
    if m.tables.kinematics is not None:
        yield Swivel("tilt", (a, b, c), rotary_feed, below)
        return
    after, before = (rotary_axes(m).orientation(angles)[:, 2] for angles in (to, m.rotary))
    travel = (below or 0.0) * (after - before)
    if length := math.hypot(*travel):
        yield Write("rotary", tuple(map(math.radians, (a, b, c))))
        x, y, z = m.to_program(p + d for p, d in zip(m.tip, travel, strict=True))
        yield Go("tilt", z, length * rotary_feed / way, x, y)
    else:
        yield Swivel("tilt", (a, b, c), rotary_feed)
