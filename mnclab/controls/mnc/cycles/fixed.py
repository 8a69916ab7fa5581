"""Fixed cycles (MNC, 9.1 to 9.3): G83, G84, G85 run at each position until G80; holes lie along Z whatever the plane."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from types import SimpleNamespace
from typing import Any, ClassVar

from mnclab.controls.mnc.cycles import addresses
from mnclab.controls.word_address import holes
from mnclab.machine.coordinates import TAPS, depth_scale
from mnclab.machine.cycle import Cycle, CycleTable, Given, Values, param
from mnclab.machine.machine import Machine
from mnclab.machining.holes import drill, ream, tap
from mnclab.machining.steps import Step

POSITION = "X Y U V Z W R"
PAIRS = (("x", "x_increment"), ("y", "y_increment"), ("bottom", "depth_from_r"))


def increment(address: str, axis: str, example: float) -> Any:
    """U and V: from the present point."""
    meaning = f"increment to the hole along {axis}"
    return param(address, meaning, default=None, instead=axis.lower(), incremental=True, example=example)


CYCLES = CycleTable(addresses=SimpleNamespace(
    x=holes.x, x_increment=partial(increment, "U", "X", 15), y=holes.y, y_increment=partial(increment, "V", "Y", 10),
    bottom=partial(holes.bottom, instead="depth_from_r"), r_level=holes.r_level, feed=holes.feed,
    depth_from_r=partial(
        param, "W", "depth below level R", default=None, instead="bottom", above=0, incremental=True, modal=True, example=22
    ),
    dwell=partial(param, "P", "dwell at the bottom", "s", default=0, at_least=0, example=0.5),
), runs="position")  # fmt: skip
HOLE = "x x_increment y y_increment bottom depth_from_r r_level"


class FixedCycle(holes.AtHole, Cycle):
    """A cycle at a hole whose levels may be increments."""

    pecks = "peck_depth"
    dwell: float

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        """Levels are worked out when they are programmed: bottom and r_level become coordinates, x and y the hole."""
        for one, other in PAIRS:
            if one in given and other in given:
                both = f"{given[one].address} and {given[other].address}"
                m.alarm(f"{cls.code} {both} stand in one block", given[other])
        absolute = m.modal["dimension"] == "G90"
        kept.setdefault("initial", m.tip[2])  # of the machine: a new datum does not move it
        for axis, (one, other) in enumerate(PAIRS[:2]):
            if other in given:
                values[one] = m.programmed[axis] + values[other]
            elif one in given and not absolute:
                values[one] += m.programmed[axis]
        known = values.get("bottom") is not None and values.get("r_level") is not None
        depth = kept.get("depth") if known else None
        if "r_level" in given and not absolute:
            values["r_level"] += holes.initial_level(m, kept)
        if "depth_from_r" in given:
            kept["depth"] = depth = values["depth_from_r"]
        elif "bottom" in given:
            kept["depth"] = depth = None if absolute else -values["bottom"]
        if depth is not None and values.get("r_level") is not None:
            values["bottom"] = values["r_level"] - depth
        if values.get("depth_from_r") is not None and not values["depth_from_r"] > 0:
            return values  # refused by its limit
        if values.get("bottom") is not None:
            values["depth_from_r"] = None
        holes.take_feed(m, values, given)
        return values


@CYCLES("G83", "Deep-hole drilling", source="MNC 9.1", triggers=POSITION, takes=f"{HOLE} peck_depth dwell feed")
class DeepHoleDrilling(FixedCycle):
    """Drills at each position with rapid withdrawal to level R after every peck, until G80."""

    peck_depth: float | None = addresses.distance("K", "depth of one peck", 5, **addresses.ONE_PASS)

    @classmethod
    def prepare(cls, values: Values, given: Given, m: Machine, kept: Values) -> Values:
        """The first hole without K after one with K is remarked on: K is not modal."""
        if "peck_depth" not in given and kept.get("pecked"):
            fault = "G83 K (depth of one peck) is not modal: this hole is drilled in one pass"
            m.warn(fault, None, "write K for each hole")
        kept["pecked"] = "peck_depth" in given
        return super().prepare(values, given, m, kept)

    def work(self, m: Machine) -> Iterator[Step]:
        """Pecks and a dwell; the clearance above the last depth is one of the control, no length of the program."""
        clearance = m.settings["peck_clearance"] / depth_scale(m)
        return drill(self.levels(), above=self.r_level, feed=None, reenter=clearance, dwell_bottom=self.dwell)


@CYCLES("G84", "Tapping", source="MNC 9.2", triggers=POSITION, takes=f"{HOLE} dwell feed")
class Tapping(FixedCycle):
    """Taps at each position with the spindle as it turns, reversed at the bottom and again at level R, until G80."""

    does: ClassVar[str] = TAPS
    needs = (holes.no_pitch,)

    def work(self, m: Machine) -> Iterator[Step]:
        """The cycle runs at a feed per revolution; F in mm/min is divided by the speed."""
        pitch, sense = m.feed_of(None) / abs(m.speed), m.turning
        return tap([self.bottom], above=self.r_level, pitch=pitch, sense=sense, end=sense, dwell=self.dwell)


@CYCLES("G85", "Boring and reaming", source="MNC 9.3", triggers=POSITION, takes=f"{HOLE} dwell feed")
class Reaming(FixedCycle):
    """Reams or bores at each position, in and out at feed, until G80."""

    def work(self, m: Machine) -> Iterator[Step]:
        return ream(self.bottom, above=self.r_level, feed=None, retract=None, dwell=self.dwell)
