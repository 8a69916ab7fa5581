"""The tool touch probe TT: what all its cycles share, and its calibration, 480, 30 and 484 (TNC 620, 19.1 to 19.3).

The TT is the plate of `Setup(setter=…)`, whose nominal place is centerPos. Places of the steps are those of the tool tip in
machine coordinates. A calibration finds where it truly is; it holds for the rest of the program, and with the setting
`tt_calibrated` one from before the program holds.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from typing import Any, ClassVar, NamedTuple

from mnclab.controls.tnc_620.cycles.addresses import choice, coordinate
from mnclab.controls.tnc_620.cycles.chain import FACTORS, MIRROR, SCALE, TILT
from mnclab.controls.tnc_620.cycles.planes import SAME, Fault, in_program_coordinates
from mnclab.controls.tnc_620.probing.cycle import Moves
from mnclab.controls.tnc_620.state import memory
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import in_mm
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.probe import Setter
from mnclab.machine.tool_setting import PLATE, SETS, unfit
from mnclab.machining.probing.fits import circle
from mnclab.machining.steps import Go, Measure, Orient, Pause, Say, Step, Touch, Write

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


def unfit_for_tt(c: Cycle, m: Machine) -> Iterator[Fault]:
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

    def check(self, m: Machine) -> Iterator[Fault]:
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
