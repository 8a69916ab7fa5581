"""Cycle 19, the tilted working plane (11.9): rotation, shift and cycles act in a system that is tilted about the active datum.

Positions are those of the tool tip on the workpiece, so heads and tables look the same. Which axes the machine has (setting
"rotary_axes") and whether the angles of the cycle are spatial or those of the axes ("tilt_angles") is up to its builder.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from mnclab.controls.tnc_620.cycles import chain
from mnclab.controls.tnc_620.cycles.addresses import angle, distance, feed
from mnclab.controls.tnc_620.cycles.chain import Given, Values
from mnclab.controls.tnc_620.cycles.faults import Fault, not_zero
from mnclab.controls.tnc_620.cycles.planes import in_program_coordinates
from mnclab.controls.tnc_620.state import memory
from mnclab.geometry import frames
from mnclab.geometry.frames import Matrix
from mnclab.machine.control import Setting
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.machine import Machine
from mnclab.machining.steps import Go, Say, Step, Swivel, Write

CYCLES = CycleTable()
SETTINGS = (
    Setting(
        "rotary_axes", "CA", "which rotary axes there are, the one that carries the other first", "11.9",
        {pair: f"{pair[0]} carries {pair[1]}" for pair in frames.PAIRS},
    ),
    Setting(
        "tilt_angles", "spatial", "what the angles of cycle 19 are", "11.9",
        {"spatial": "turns about the fixed axes X, then Y, then Z", "axes": "positions of the rotary axes"},
    ),
)  # fmt: skip
AXES = "ABC"
RESULTS = {"A": "Q120", "B": "Q121", "C": "Q122"}
STILL: dict[str, Any] = {"default": None, "default_means": "they are not moved"}
tilt = partial(angle, default=None, default_means="as it is")


@CYCLES("CYCL DEF 19", "Working plane", runs="definition", source="11.9")
class WorkingPlane(Cycle):
    """Tilts the working plane about the active datum and writes where the rotary axes must stand into Q120 to Q122.

    F and ABST move them there while the point ABST below the tip stands still; without them the program does. Without a word
    the function is off.
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
    def angles(self) -> dict[str, float]:
        return {"A": self.angle_a or 0.0, "B": self.angle_b or 0.0, "C": self.angle_c or 0.0}

    def check(self, m: Machine) -> Iterator[Fault]:
        if m.side:
            yield "", "cannot tilt the plane under radius compensation: write R0 before"
        if (self.rotary_feed is None) != (self.set_up_clearance is None):
            name = "rotary_feed" if self.rotary_feed is None else "set_up_clearance"
            yield name, "is missing: to position the rotary axes both F and ABST are needed"
        yield from not_zero(self, "rotary_feed", purpose="to position the rotary axes")
        pair: str = m.settings["rotary_axes"]
        for axis, value in self.angles.items() if m.settings["tilt_angles"] == "axes" else ():
            if value and axis not in pair:
                there = f"the rotary axes are {' and '.join(sorted(pair))}"
                yield f"angle_{axis.lower()}", f"must be 0, got {value:g}: {there}"

    def moves(self, m: Machine) -> Iterator[Step]:
        if self.angle_a is None:  # no word was written: the function is off
            yield Write("memory", {}, "tilt_angles")
            if chain.TILT in m.frames and (left := (yield from chain.untilt(m))):
                sentence = f"is switched off, and {', '.join(left)} defined behind it act in the untilted system"
                yield Say(sentence, "reset in the reverse order of definition")
            return
        yield Write("memory", {axis.lower(): angle for axis, angle in self.angles.items()}, "tilt_angles")
        yield Write("frame", self.matrix(m), chain.TILT)
        to = self.positions(m)
        yield from results(to)
        if self.rotary_feed is not None:
            assert self.set_up_clearance is not None
            yield from position(m, to, self.rotary_feed, self.set_up_clearance)

    def matrix(self, m: Machine) -> Matrix:
        """The tilted system in the untilted one."""
        radians = {axis: math.radians(angle) for axis, angle in self.angles.items()}
        if m.settings["tilt_angles"] == "axes":
            return frames.of_axes(m.settings["rotary_axes"], radians)
        return frames.spatial(*radians.values())

    def positions(self, m: Machine) -> dict[str, float]:
        """Where A, B and C must stand, rad."""
        now, pair = dict(zip(AXES, m.rotary, strict=True)), m.settings["rotary_axes"]
        if m.settings["tilt_angles"] == "axes":
            return now | {axis: math.radians(angle) for axis, angle in self.angles.items() if axis in pair}
        return axis_positions(m)


def axis_positions(m: Machine) -> dict[str, float]:
    """Where A, B and C must stand, rad, for the tool to lie along Z of the tilted system."""
    now, pair = dict(zip(AXES, m.rotary, strict=True)), m.settings["rotary_axes"]
    tool_axis = (m.frames.before(chain.TILT) @ m.frames[chain.TILT])[:3, 2]
    return now | frames.nearest(frames.positions(pair, tool_axis, now), now)


def results(to: Mapping[str, float]) -> Iterator[Write]:
    """Positions (rad) as the parameters that hold them, degrees."""
    for axis, name in RESULTS.items():
        yield Write("variable", round(math.degrees(to[axis]), 12), name)


def position(m: Machine, to: Mapping[str, float], rotary_feed: float, distance: float) -> Iterator[Step]:
    """Turn the axes together, at degrees a minute; the point at a `distance` below the tip stands still, so the tip goes
    round it."""
    pair = m.settings["rotary_axes"]
    now = dict(zip(AXES, m.rotary, strict=True))
    travel = distance * (frames.direction(pair, to) - frames.direction(pair, now))
    way = math.degrees(max(abs(to[axis] - now[axis]) for axis in AXES))
    a, b, c = (math.degrees(to[axis]) for axis in AXES)
    if length := way and math.hypot(*travel):
        yield Write("rotary", tuple(map(math.radians, (a, b, c))))
        x, y, z = m.to_program(p + d for p, d in zip(m.tip, travel, strict=True))
        yield Go("tilt", z, length * rotary_feed / way, x, y)
    elif way:
        yield Swivel("tilt", (a, b, c), rotary_feed)
