"""The laser tool setter: it is calibrated by G470, G471 and G472, tools are measured by G480, G481 and G482 (MNC 12.27 to 12.32).

The beam is that of `Setup(setter=…)`. Places of the steps are those of the tool tip in machine coordinates; the spindle
reference, which the manual speaks of, is above it by the length in the tool table. `w` is the axis across the beam.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator
from dataclasses import replace
from typing import Any, ClassVar

from mnclab.controls.mnc.language import memory
from mnclab.controls.mnc.probing import addresses, cycle
from mnclab.controls.mnc.probing.cycle import Moves, unplaced
from mnclab.machine.control import Setting
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import DIGITS
from mnclab.machine.tool_setting import BEAM, SETS, row_of, unfit, written
from mnclab.machining.steps import RAPID, Go, Measure, Pause, Say, Spin, Step, Touch, Write
from mnclab.path.tool import Tool

CYCLES = CycleTable(runs="definition")
SETTINGS = (
    *(Setting(f"laser_{axis}", None, f"{axis.upper()} of the beam of the tool setter, machine coordinates, until G47{n} finds it",
              f"12.{26 + n}", unit="mm") for axis, n in (("x", 2), ("y", 2), ("z", 1))),
    Setting("laser_axis", None, "axis that the beam lies along, 1 (X) or 2 (Y), until G472 finds it", "12.29", {}, "", 1, 2),
    Setting("laser_clr", 5.0, "safe distance from the beam", "MNC-LASER-CLR", {}, "mm", 0.001),
    Setting("laser_feed", 50.0, "feed to the beam where it counts", "MNC-LASER-CLR", {}, "mm/min", 0.001),
    Setting("laser_search", 300.0, "how far down the beam is looked for", "12.28", {}, "mm", 0.001),
    Setting("spindle_max", 12000.0, "speed at which tools are measured", "12.30", {}, "rev/min", 1),
)  # fmt: skip
FRAMES = ("base rotation", "scaling", "mirror")
ALL = ("laser_z", "laser_x", "laser_y", "laser_axis")
Height = Generator[Step, Any, float]


def known(m: Machine, name: str) -> Any:
    """What is known of the beam: as the last calibration found it, else by the setting; None: nothing."""
    return memory(m).laser.get(name, m.settings[name])


class LaserCycle(Cycle):
    """Base of the six cycles; who inherits declares the parameters."""

    does: ClassVar[str] = SETS
    needs: ClassVar[tuple[str, ...]] = ()
    """What must be known of the beam."""
    refused: ClassVar[tuple[str, ...]] = ()
    """Frames that must not be active."""
    axis: float | None = None
    depth: float | None = None
    kind: float = 2

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from unfit(m, BEAM)
        yield from unplaced(m)
        if m.tool != row_of(m):
            yield "", f"needs T{m.tool.number} with its own corrector: write T without D before it"
        for name in self.refused:
            if name in m.frames:
                yield "", f"cannot run while a {name} is active"
        for name in self.needs:
            if known(m, name) is None:
                how = "G471" if name == "laser_z" else "G472"
                yield "", f"needs {name} of the tool setter: {how} finds it, or the setting says it"
        beam = known(m, "laser_z") if "laser_z" in self.needs else None
        if beam is not None and m.tip[2] <= beam:
            yield "", f"begins above the beam, which is at Z{beam:g} of the machine: the tip is at Z{m.tip[2]:g}"
        if self.depth is not None and self.kind != 1 and self.needs == ALL and not m.tool.effective_radius > 0:
            yield "", f"needs the radius of T{m.tool.number} in the tool table"

    def about(self, m: Machine) -> tuple[float, float]:
        return 0.0, 0.0

    def down(self, m: Machine, feed: float, label: str) -> Height:
        """Down into the beam; returns the height of the spindle reference there."""
        x, y, z = m.tip
        contact = yield Touch(label, x, y, z - float(m.settings["laser_search"]), feed)
        return float(contact.tip[2] + m.tool.effective_length)

    def across(self, m: Machine, w: float, feed: float, label: str) -> Height:
        """Along w into the beam; returns the place of the tool axis there."""
        k = self.w(m)
        x, y, z = m.tip[:k] + (w,) + m.tip[k + 1 :]
        contact = yield Touch(label, x, y, z, feed)
        return float(contact.tip[k])

    def w(self, m: Machine) -> int:
        """The number of the axis across the beam."""
        return 1 if (self.axis or known(m, "laser_axis")) == 1 else 0

    def beside(self, m: Machine, label: str, w: float) -> Go:
        return Go(label, y=w) if self.w(m) else Go(label, x=w)

    def measured(self, m: Machine, length: bool, radius: bool) -> Generator[Step, Any, tuple[float, float]]:
        """Length and radius, nan where one is not measured; the tool ends where it began."""
        (x, y, high), speed, row = m.tip, m.speed, row_of(m)
        clear, feed = float(m.settings["laser_clr"]), float(m.settings["laser_feed"])
        yield Spin("spindle on", 1, float(m.settings["spindle_max"]))
        yield Go("over the beam", x=float(known(m, "laser_x")), y=float(known(m, "laser_y")))
        top = yield from self.down(m, RAPID, "search from above")
        yield Go("back", m.tip[2] + clear)
        found = [math.nan, math.nan]
        if length:
            top = yield from self.down(m, feed, "touch from above")
            found[0] = top - float(known(m, "laser_z"))
            if radius:
                yield Go("back", m.tip[2] + clear)
        if radius:
            found[1] = yield from self.sides(m, top - m.tool.effective_length, row, clear, feed)
        yield Go("to the height of the start", high)
        yield Go("to the start", x=x, y=y)
        yield Spin("spindle off", 0, speed)
        return found[0], found[1]

    def sides(self, m: Machine, top: float, row: Tool, clear: float, feed: float) -> Height:
        """The radius, from both sides; `top` is the tip where it breaks the beam from above."""
        beam = float(known(m, "laser_x" if self.w(m) == 0 else "laser_y"))
        assert self.depth is not None
        found = []
        for side, sense in (("+", 1), ("-", -1)):
            yield self.beside(m, f"to the {side} side", beam + sense * (row.effective_radius + 2 * clear))
            yield Go("down", top - self.depth)
            for how, speed in (("search", RAPID), ("touch", feed)):
                place = yield from self.across(m, beam, speed, f"{how} from {side}")
                yield self.beside(m, "back", place + sense * clear)
            found.append(place)
            if sense > 0:
                yield Go("up", top + clear)
        return (found[0] - found[1]) / 2

    def judged(self, what: str, value: float, row: Tool, tolerance: float) -> Iterator[Step]:
        """The deviation becomes the correction; a greater one than the tolerance stops the program."""
        nominal = getattr(row, what)
        deviation = value - nominal
        yield Measure(what, value, nominal, nominal - tolerance, nominal + tolerance)
        if abs(deviation) > tolerance + 1e-9:
            yield Say(f"finds T{row.number} worn or broken: its {what} is off by {deviation:.4f}, the limit is {tolerance:g}")
            yield Pause("worn or broken")


@CYCLES("G470", "Laser tool setter: level of the beam", source="MNC 12.27")
class BeamSlope(LaserCycle):
    """The beam is broken twice, at two places along it."""

    refused = FRAMES
    axis: float = addresses.choice("L", "axis that the beam lies along", addresses.PLANE_AXES, 1)
    direction: float = addresses.choice("K", "way to the second point", addresses.SENSE, 1)
    distance: float = param("P", "distance of the two points", above=0, incremental=True, example=40)

    def moves(self, m: Machine) -> Moves:
        high, feed = m.tip[2], float(m.settings["laser_feed"])
        first = yield from self.down(m, feed, "touch 1")
        yield Go("up", high)
        along = 1 - self.w(m)
        there = m.tip[along] + self.direction * self.distance
        yield Go("to the second point", x=there) if along == 0 else Go("to the second point", y=there)
        second = yield from self.down(m, feed, "touch 2")
        yield Go("up", high)
        deviation = second - first
        angle = math.degrees(math.atan(self.direction * deviation / self.distance))
        yield Measure("level", deviation, 0.0)
        yield Measure("angle", angle, 0.0, unit="deg")
        values = {"z1": first, "z2": second, "deviation": deviation, "angle": angle}
        yield from report(m, self.code, values)


@CYCLES("G471", "Laser tool setter: calibrate Z", source="MNC 12.28")
class HeightOfBeam(LaserCycle):
    """The beam is broken once from above, by a tool whose length is known."""

    refused = FRAMES
    length: float = addresses.coordinate("H", "length of the reference tool", 100, at_least=0)

    def moves(self, m: Machine) -> Moves:
        high = m.tip[2]
        reference = yield from self.down(m, float(m.settings["laser_feed"]), "touch")
        yield Go("up", high)
        yield from learned(m, laser_z=reference - self.length)


@CYCLES("G472", "Laser tool setter: calibrate X and Y", source="MNC 12.29")
class BeamPlace(LaserCycle):
    """The beam is broken from both sides by a tool that is known; along the beam the place of the call counts."""

    refused, needs = FRAMES, ("laser_z",)
    length: float = addresses.coordinate("H", "length of the reference tool", 100, at_least=0)
    diameter: float = param("D", "diameter of the reference tool", above=0, example=16)
    depth: float = param("Q", "depth below the beam", above=0, incremental=True, example=5)
    axis: float = addresses.choice("L", "axis that the beam lies along", addresses.PLANE_AXES, 1)

    def moves(self, m: Machine) -> Moves:
        k, (x, y, high), feed = self.w(m), m.tip, float(m.settings["laser_feed"])
        w, away = m.tip[k], self.diameter / 2 + float(m.settings["laser_clr"])
        low = float(known(m, "laser_z")) + self.length - self.depth - m.tool.effective_length
        found = []
        for side, sense in (("+", 1), ("-", -1)):
            yield self.beside(m, f"to the {side} side", w + sense * away)
            yield Go("down", low)
            found.append((yield from self.across(m, w - sense * away, feed, f"touch from {side}")))
            yield self.beside(m, "back", w + sense * away)
            yield Go("up", high)
        yield Go("to the start", x=x, y=y)
        place = [x, y]
        place[k] = (found[0] + found[1]) / 2
        yield Measure("width of the beam", found[0] - found[1] - self.diameter, 0.0)
        yield from learned(m, laser_x=place[0], laser_y=place[1], laser_axis=self.axis)


@CYCLES("G480", "Measure length and radius of a tool", source="MNC 12.30")
class MeasureTool(LaserCycle):
    """What is measured stands in the tool table, without corrections."""

    needs = ALL
    kind: float = addresses.choice("P", "what is measured", {1: "length", 2: "radius", 3: "length and radius"}, 1)
    depth: float | None = param(
        "Q", "depth below the beam for the radius", above=0, incremental=True, default=None, default_means="with P1", example=4
    )
    axis: float | None = addresses.choice(
        "L", "axis that the beam lies along", addresses.PLANE_AXES, 1, default=None, default_means="as G472 stored it"
    )

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if self.kind != 1 and self.depth is None:
            yield "depth", f"is missing: P{self.kind:g} needs it"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from super().check(m)
        if self.axis is not None and known(m, "laser_axis") not in (None, self.axis):
            yield "axis", f"must be {known(m, 'laser_axis'):g}, the axis that G472 stored, got {self.axis:g}"

    def moves(self, m: Machine) -> Moves:
        tool = row_of(m)
        length, radius = yield from self.measured(m, self.kind != 2, self.kind != 1)
        if self.kind != 2:
            yield Measure("length", length, tool.length)
            tool = replace(tool, length=length, dl=0.0)
        if self.kind != 1:
            yield Measure("radius", radius, tool.radius)
            tool = tool.of_radius(radius)
        yield from written(m, tool)


@CYCLES("G481", "Check the length of a tool", source="MNC 12.31")
class CheckLength(LaserCycle):
    """The deviation from the length in the table becomes its correction."""

    needs = ALL
    tolerance: float = addresses.coordinate("H", "permissible deviation of the length", 0.05, at_least=0)

    def moves(self, m: Machine) -> Moves:
        row = row_of(m)
        length, _ = yield from self.measured(m, length=True, radius=False)
        yield from written(m, replace(row, dl=length - row.length))
        yield from self.judged("length", length, row, self.tolerance)


@CYCLES("G482", "Check the radius of a tool", source="MNC 12.32")
class CheckRadius(LaserCycle):
    """The deviation from the radius in the table becomes its correction."""

    needs = ALL
    tolerance: float = addresses.coordinate("D", "permissible deviation of the radius", 0.05, at_least=0)
    depth: float = param("Q", "depth below the beam", above=0, incremental=True, example=4)

    def moves(self, m: Machine) -> Moves:
        row = row_of(m)
        _, radius = yield from self.measured(m, length=False, radius=True)
        yield from written(m, replace(row, dr=radius - row.radius))
        yield from self.judged("radius", radius, row, self.tolerance)


def learned(m: Machine, **found: float) -> Iterator[Step]:
    """What a calibration found, until the end of the program."""
    yield from (Measure(name, value, math.nan if known(m, name) is None else known(m, name)) for name, value in found.items())
    yield Write("memory", memory(m).laser | found, "laser")


def report(m: Machine, code: str, values: dict[str, float]) -> Iterator[Step]:
    """The report of G470 in the folder of measurement protocols (MNC-PROT-G470)."""
    lines = [f"{name} = {value:.{DIGITS}f}" for name, value in values.items()]
    yield Write("file", "\n".join([*cycle.head(m, code), *lines, ""]), cycle.name(m, code))
