"""The tool touch probe TT (TNC 620, chapter 19): its calibration, 480, 30, 484, and tools measured at it, 481 to 483, 31 to 33.

The TT is the plate of `Setup(setter=…)`, whose nominal place is centerPos. Places of the steps are those of the tool tip in
machine coordinates. A calibration finds where it truly is; it holds for the rest of the program, and with the setting
`tt_calibrated` one from before the program holds.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from types import SimpleNamespace
from typing import Any, ClassVar, NamedTuple

from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate
from mnclab.controls.tnc_620.cycles.chain import FACTORS, MIRROR, SCALE, TILT
from mnclab.controls.tnc_620.cycles.planes import SAME, ParameterFault, in_program_coordinates
from mnclab.controls.tnc_620.probing.cycle import Moves
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import in_mm
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machine.probe import Setter
from mnclab.machine.tool_setting import PLATE, SETS, row_of, unfit, written
from mnclab.machining.probing.fits import circle
from mnclab.machining.steps import Go, Measure, Orient, Pause, Say, Spin, Step, Touch, Write
from mnclab.path.tool import Tool

CYCLES = CycleTable(runs="definition")
SETTINGS = (
    Setting("probing_feed", 100.0, "feed of a standing tool to the TT (probingFeed, no. 122709)", "19.1", {}, "mm/min", 1),
    Setting(
        "probing_feed_calc", "ConstantTolerance", "feed of a turning tool to the TT (no. 122710)", "19.1",
        {"ConstantTolerance": "from measure_tolerance_1, whatever the radius",
         "VariableTolerance": "from so many times measure_tolerance_1 as the radius has 30 mm begun",
         "ConstantFeed": "the same for all radii: the tolerance grows with them"},
    ),
    Setting(
        "max_periph_speed_meas", 120.0, "cutting speed of a turning tool at the TT (no. 122712)", "19.1", {}, "m/min", 0.001,
    ),
    Setting("measure_tolerance_1", 0.005, "permissible error of measuring at the TT (no. 122715)", "19.1", {}, "mm", 0.0001),
    Setting("offset_tool_axis", 5.0, "from the tip up to the upper edge of the TT for radii (no. 122707)", "19.1", {}, "mm", 0),
    Setting("safety_dist_tool_ax", 20.0, "safety zone about the TT (safetyDistToolAx, no. 114203)", "19.2", {}, "mm", 0.001),
    Setting("radius_measured", True, "the TT measures radii and single teeth too (probingCapability, no. 122723)", "19.2"),
    Setting("hide_measure_tt", False, "hides the cycles 480 to 484 (hideMeasureTT, no. 128901)", "19.1"),
    Setting("tt_calibrated", False, "the TT was calibrated before the program, as exactly as it can be", "19.2"),
)  # fmt: skip
BESIDE = 11.0  # mm, from the stylus to the calibrating tool beside the set-up clearance (19.2)
THIN = 15.0  # mm, diameter of a calibrating tool that may bend (19.3)
SIDES = ((1, 0), (0, 1), (-1, 0), (0, -1))
UNFIT = (MIRROR, SCALE, FACTORS, TILT)


class Calibrated(NamedTuple):
    """What the control knows of the TT: its middle and upper side in machine coordinates, and its radius, mm."""

    x: float
    y: float
    top: float
    radius: float


def setter_of(m: Machine) -> Setter:
    """The TT as the machine parameters have it."""
    return m.setup.setter or Setter()


def known(m: Machine) -> Calibrated | None:
    """What the last calibration found."""
    if m.settings["tt_calibrated"] and memory(m).tool_setter is None:
        return Calibrated(*setter_of(m).place, setter_of(m).radius)
    return memory(m).tool_setter


def unfit_for_tt(c: Cycle, m: Machine) -> Iterator[ParameterFault]:
    """What refuses all cycles of chapter 19."""
    yield from unfit(m, PLATE)
    if m.settings["hide_measure_tt"] and int(c.code.split()[-1]) >= 480:
        yield "", "is hidden on this machine (setting hide_measure_tt)"
    if active := [name for name, _ in m.frames if name.partition(" (")[0] in UNFIT]:
        yield "", f"cannot run while a {active[0]} is active"
    for name in ("length", "radius"):
        if not getattr(m.tool, f"effective_{name}") > 0:
            yield "", f"needs the {name} of T{m.tool.number} in the tool table"


def start_height(m: Machine, height: float, top: float) -> float:
    """Where the tip begins: Q260, which counts from the preset, or above an upper side that lies higher."""
    wanted = float(m.frames["preset"][2, 3]) + height
    return wanted if wanted >= top - SAME else top + float(m.settings["safety_dist_tool_ax"])


class Calibrating(Cycle):
    """One touch from above, and four round the stylus with the spindle at 0 and at 180 degrees.

    The calibrating tool is exactly round, its length and radius stand in the tool table.
    """

    does: ClassVar[str] = SETS
    about = in_program_coordinates
    height = 0.0

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from unfit_for_tt(self, m)
        if m.tool.effective_radius > (most := float(m.settings["safety_dist_tool_ax"]) + BESIDE):
            yield "", f"needs a calibrating tool of a radius up to {most:g}, that of T{m.tool.number} is greater"

    def moves(self, m: Machine) -> Moves:
        """From the clearance height; the tool ends above the middle that was found."""
        setter = setter_of(m)
        high = start_height(m, self.height, setter.z)
        yield Go("to the clearance height", high)
        yield Go("over the TT", x=setter.x, y=setter.y)
        tt = yield from calibrated(m, setter.x, setter.y, high)
        yield Go("up", tt.top + float(m.settings["safety_dist_tool_ax"]))
        yield Go("over the middle", x=tt.x, y=tt.y)


def calibrated(m: Machine, x: float, y: float, high: float) -> Generator[Step, Any, Calibrated]:
    """From above the TT, whose middle is taken to be at x and y; the tool is left beside it."""
    setter, clearance, feed = setter_of(m), float(m.settings["safety_dist_tool_ax"]), float(m.settings["probing_feed"])
    radius = m.tool.effective_radius
    yield Orient("spindle at 0", 0.0)
    contact = yield Touch("touch from above", x, y, min(setter.z, high) - clearance, feed)
    top = contact.tip[2]
    yield Go("up", high)
    away, level, middles, found = setter.radius + clearance + BESIDE, top - float(m.settings["offset_tool_axis"]), [], []
    yield Go("beside the TT", x=x + away, y=y)
    yield Go("down", level)
    for turn in (0.0, 180.0):
        points = []
        for k, (u, v) in enumerate(SIDES):
            if turn or k:
                before = SIDES[k - 1]
                yield Go("to the corner", x=x + away * (u + before[0]), y=y + away * (v + before[1]))
                yield Go("beside the TT", x=x + away * u, y=y + away * v)
            if turn and k == 0:
                yield Orient(f"spindle at {turn:g}", turn)
            contact = yield Touch(f"touch {k + 1}", x, y, level, feed)
            points.append(contact.tip[:2])
            yield Go("back", x=x + away * u, y=y + away * v)
        found.append(circle(points))
        middles.append(found[-1].centre)
    (x0, y0), (x1, y1) = middles
    tt = Calibrated((x0 + x1) / 2, (y0 + y1) / 2, top, (found[0].radius + found[1].radius) / 2 - radius)
    nominal = (setter.x, setter.y, setter.z, setter.radius)
    yield from (Measure(f"TT {name}", each, was) for name, each, was in zip(("X", "Y", "Z", "radius"), tt, nominal))
    yield from (Measure(f"runout {name}", (b - a) / 2, 0.0) for name, a, b in (("X", x0, x1), ("Y", y0, y1)))
    yield Write("memory", tt, "tool_setter")
    return tt


@CYCLES("TCH PROBE 480", "Calibrating the TT", source="19.2")
class Calibrate(Calibrating):
    """From the clearance height."""

    height: float = coordinate("Q260", "clearance height", example=100)


@CYCLES("TCH PROBE 30", "Calibrating the TT, old format", source="19.2")
class OldCalibrate(Calibrating):
    """As 480."""

    height: float = coordinate("HEIGHT", "clearance height", modal=False, example=100)


@CYCLES("TCH PROBE 484", "Calibrating a wireless TT", source="19.3")
class CalibrateWireless(Calibrating):
    """From where the tool stands above the TT; it ends above its middle, where it began."""

    stop: float = choice(
        "Q536", "stop before running", {0: "the operator brings the tool over the TT", 1: "the tool stands over it"}, example=1,
    )  # fmt: skip

    def moves(self, m: Machine) -> Moves:
        setter = setter_of(m)
        if 2 * m.tool.effective_radius <= THIN:
            yield Say(f"wants a calibrating tool thicker than {THIN:g} mm: one of {2 * m.tool.effective_radius:g} mm may bend")
        if self.stop == 0:
            yield Pause("bring the tool over the TT")
            high = max(m.tip[2], setter.z + float(m.settings["safety_dist_tool_ax"]))
            yield Go("by hand", high)
            yield Go("by hand", x=setter.x, y=setter.y)
        x, y, high = m.tip
        if (x - setter.x) ** 2 + (y - setter.y) ** 2 > setter.radius**2 or high <= setter.z:
            hint = in_mm(f"bring it over X{setter.x:g} Y{setter.y:g}", m.variable_unit)
            m.alarm(f"{self.code} begins above the TT, the tool stands beside it", hint=hint)
        tt = yield from calibrated(m, x, y, high)
        yield Go("up", high)
        yield Go("over the middle", x=tt.x, y=tt.y)


# Tools measured at the TT: length 481 and 31, radius 482 and 32, both 483 and 33 (TNC 620, 19.4 to 19.6).
#
# A turning tool is touched by its longest edge or its greatest radius. A tool with R-OFFS 0 stands while its length is
# measured, and one without teeth while its radius is. Single teeth are brought to the TT one by one, the spindle standing.

Lengths = Generator[Step, Any, list[float]]
CHECK: dict[float, str] = {
    0: "write what is measured, without deltas",
    1: "compare, write the deltas, and lock the tool beyond its tolerances",
    2: "compare, write nothing into the tool table",
}  # fmt: skip
TEETH: dict[float, str] = {0: "no", 1: "yes"}
MOST_TEETH = 20
WORN, BROKEN = 1.0, 2.0
STATUS_PARAMETER = "Q199"
STATUS = {WORN: "worn", BROKEN: "broken"}
DELTAS = {"length": ("dl", "Q115"), "radius": ("dr", "Q116")}


def spindle_and_feed(m: Machine, radius: float) -> tuple[float, float]:
    """Speed (rev/min) and feed (mm/min) of a turning tool of a radius, mm (19.1)."""
    settings = m.settings
    speed = min(settings["max_periph_speed_meas"] / (radius * 0.0063), m.setup.limits.spindle)
    share = {"ConstantTolerance": 1.0, "VariableTolerance": max(1, math.ceil(radius / 30)), "ConstantFeed": radius / 5}
    return speed, settings["measure_tolerance_1"] * share[settings["probing_feed_calc"]] * speed


def status(deviation: float, worn: float, broken: float) -> float:
    """Whether a tool is worn or broken: beyond a tolerance, on it not yet; one of 0 is not watched."""
    beyond = [limit > 0 and abs(deviation) > limit + 1e-9 for limit in (worn, broken)]
    return BROKEN if beyond[1] else WORN if beyond[0] else 0.0


class ToolMeasuring(Cycle):
    """Base of both formats; who inherits says what it measures, and declares the parameters."""

    does: ClassVar[str] = SETS
    about = in_program_coordinates

    measures: ClassVar[tuple[str, ...]]
    mode = 0.0
    height = 0.0
    teeth = 0.0
    target: Any = STATUS_PARAMETER

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from unfit_for_tt(self, m)
        if known(m) is None:
            yield "", "needs a TT that is calibrated: TCH PROBE 480 before it, or the setting tt_calibrated"
        if self.teeth and not 1 <= (count := row_of(m).teeth) <= MOST_TEETH:
            yield "teeth", f"needs 1 to {MOST_TEETH} teeth in the tool table (CUT), T{m.tool.number} has {count:g}"
        if not m.settings["radius_measured"] and (self.teeth or "radius" in self.measures):
            yield "", "measures lengths without single teeth alone on this machine (setting radius_measured)"

    def moves(self, m: Machine) -> Moves:
        tt, row, speed = known(m), row_of(m), m.speed
        assert tt is not None
        high = start_height(m, self.height, tt.top)
        yield Go("to the clearance height", high)
        found = {}
        for what in self.measures:
            found[what] = yield from (self.lengths if what == "length" else self.radii)(m, row, tt, high)
        yield Spin("spindle off", 0, speed)
        yield from self.evaluate(m, row, found)

    def turn(self, m: Machine, row: Tool, standing: bool) -> Generator[Step, Any, float]:
        """The spindle turns against the cutting edges, or stands; returns the feed."""
        speed, feed = spindle_and_feed(m, row.effective_radius)
        if standing:
            yield Spin("spindle off", 0)
            return float(m.settings["probing_feed"])
        yield Spin("spindle on", -1 if row.hand == "right" else 1, speed)
        return feed

    def lengths(self, m: Machine, row: Tool, tt: Calibrated, high: float) -> Lengths:
        """The length of the tool, or of each tooth."""
        aside = row.effective_radius if row.wear.offset_radius is None else row.wear.offset_radius
        standing = row.wear.offset_radius == 0 or not m.settings["radius_measured"]
        if self.teeth:
            turn = math.tau / row.teeth
            if row.teeth > 1 and math.hypot(aside - row.radius * math.cos(turn), row.radius * math.sin(turn)) < tt.radius:
                alone = "a greater R-OFFS lays one alone on it"
                yield Say("lays several teeth on the TT at once: the longest of them counts", alone)
            yield from self.radius(m, row, tt, high)  # which finds the angle of the first tooth
            yield Go("to the clearance height", high)
        yield Go("over the TT", x=tt.x + aside, y=tt.y)
        feed = yield from self.turn(m, row, standing=bool(self.teeth) or standing)
        found = []
        for k in range(int(row.teeth) if self.teeth else 1):
            if self.teeth:
                yield Orient(f"tooth {k + 1}", 360 * k / row.teeth)
            depth = tt.top - float(m.settings["safety_dist_tool_ax"])
            contact = yield Touch("touch from above", tt.x + aside, tt.y, depth, feed)
            found.append(contact.tip[2] + m.tool.effective_length - tt.top)
            yield Go("to the clearance height", high)
        return found

    def radius(self, m: Machine, row: Tool, tt: Calibrated, high: float, standing: bool = False) -> Lengths:
        """The radius of the turning tool, from beside the TT; the tool stays there."""
        beside = tt.x + tt.radius + row.effective_radius + float(m.settings["safety_dist_tool_ax"])
        level = tt.top - float(m.settings["offset_tool_axis"]) - row.wear.offset_length
        yield Go("beside the TT", x=beside, y=tt.y)
        yield Go("down", level)
        feed = yield from self.turn(m, row, standing)
        return [(yield from self.from_side(tt, beside, level, feed))]

    def from_side(self, tt: Calibrated, beside: float, level: float, feed: float) -> Generator[Step, Any, float]:
        contact = yield Touch("touch from the side", tt.x + tt.radius, tt.y, level, feed)
        yield Go("back", x=beside)
        return float(abs(contact.tip[0] - tt.x) - tt.radius)

    def radii(self, m: Machine, row: Tool, tt: Calibrated, high: float) -> Lengths:
        """The radius of the tool, or of each tooth."""
        found = yield from self.radius(m, row, tt, high, standing=not row.teeth)
        if self.teeth:
            beside, _, level = m.tip
            found = []
            for k in range(int(row.teeth)):
                yield Orient(f"tooth {k + 1}", 360 * k / row.teeth)
                found.append((yield from self.from_side(tt, beside, level, float(m.settings["probing_feed"]))))
        yield Go("to the clearance height", high)
        return found

    def evaluate(self, m: Machine, row: Tool, found: Mapping[str, Sequence[float]]) -> Iterator[Step]:
        """The record, the Q parameters and the tool table; the longest edge counts, the one that is most off judges."""
        tool, worst = row, 0.0
        for what, values in found.items():
            delta, parameter = DELTAS[what]
            nominal, value = getattr(row, what), max(values)
            limits = getattr(row.wear, what), getattr(row.wear, f"break_{what}")
            within = min(filter(None, limits), default=math.nan) if self.mode else math.nan
            for k, each in enumerate(values if len(values) > 1 else ()):
                yield Measure(f"{what} of tooth {k + 1}", each, nominal, nominal - within, nominal + within)
            yield Measure(what, value, nominal, nominal - within, nominal + within)
            yield Write("variable", (value - nominal if self.mode else 0.0) / m.variable_unit, parameter)
            if self.mode == 0:
                tool = replace(tool, length=value, dl=0.0) if what == "length" else tool.of_radius(value)
            else:
                tool = replace(tool, **{delta: value - nominal})
                worst = max(worst, *(status(each - nominal, *limits) for each in values))
        if self.target:
            yield Write("variable", worst, self.target)
        if self.mode == 1 and worst:
            yield Say(f"finds T{m.tool.number} {STATUS[worst]}: it is locked in the tool table")
        if self.mode != 2:
            yield from written(m, replace(tool, locked=row.locked or worst > 0))


measured_values = partial(choice, meaning="what becomes of the measured values", choices=CHECK, example=1)
each_tooth = partial(choice, meaning="whether each tooth is measured", choices=TEETH, example=0)
NEW = CycleTable(addresses=SimpleNamespace(
    mode=partial(measured_values, "Q340"), height=partial(coordinate, "Q260", "clearance height", example=100),
    teeth=partial(each_tooth, "Q341"),
), runs="definition")  # fmt: skip
OLD = CycleTable(addresses=SimpleNamespace(
    mode=partial(measured_values, "CHECK", modal=False), teeth=partial(each_tooth, "PROBING THE TEETH", modal=False),
    height=partial(coordinate, "HEIGHT", "clearance height", modal=False, example=100),
    target=partial(
        param, "status parameter", "Q parameter of the status", "choice", type="text", default=None, default_means="none"
    ),
), runs="definition")  # fmt: skip


@NEW("TCH PROBE 481", "Measuring the tool length", source="19.4", takes="mode height teeth")
class Length(ToolMeasuring):
    """From above."""

    measures = ("length",)


@NEW("TCH PROBE 482", "Measuring the tool radius", source="19.5", takes="mode height teeth")
class Radius(ToolMeasuring):
    """From the side."""

    measures = ("radius",)


@NEW("TCH PROBE 483", "Measuring the tool length and radius", source="19.6", takes="mode height teeth")
class LengthAndRadius(ToolMeasuring):
    """The radius first, then the length."""

    measures = ("radius", "length")


@OLD("TCH PROBE 31", "Measuring the tool length, old format", source="19.4", takes="mode target height teeth")
class OldLength(ToolMeasuring):
    """As 481; the status is a parameter that the block names."""

    measures = ("length",)


@OLD("TCH PROBE 32", "Measuring the tool radius, old format", source="19.5", takes="mode target height teeth")
class OldRadius(ToolMeasuring):
    """As 482; the status is a parameter that the block names."""

    measures = ("radius",)


@OLD("TCH PROBE 33", "Measuring the tool length and radius, old format", source="19.6", takes="mode target height teeth")
class OldLengthAndRadius(ToolMeasuring):
    """As 483; the status is a parameter that the block names."""

    measures = ("radius", "length")


CYCLES |= NEW | OLD
