"""Tools measured at the TT: length 481 and 31, radius 482 and 32, both 483 and 33 (TNC 620, 19.4 to 19.6).

A turning tool is touched by its longest edge or its greatest radius. A tool with R-OFFS 0 stands while its length is
measured, and one without teeth while its radius is. Single teeth are brought to the TT one by one, the spindle standing.
"""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from types import SimpleNamespace
from typing import Any, ClassVar

from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate
from mnclab.controls.tnc_620.cycles.planes import Fault, in_program_coordinates
from mnclab.controls.tnc_620.probing.cycle import Moves
from mnclab.controls.tnc_620.probing.tool_setter import Calibrated, known, start_height, unfit_for_tt
from mnclab.machine.cycle import Cycle, CycleTable, param
from mnclab.machine.machine import Machine
from mnclab.machine.tool_setting import SETS, row_of, written
from mnclab.machining.steps import Go, Measure, Orient, Say, Spin, Step, Touch, Write
from mnclab.path.tool import Tool

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

    def check(self, m: Machine) -> Iterator[Fault]:
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


CYCLES = NEW | OLD
