"""Measuring the kinematics with a sphere on the table (TNC 620, 18.4 and 18.5): cycles 451 and 452.

At each angle of a rotary axis the probe finds the middle of the sphere, by its pole and its equator; by where it was found the
axis is put in its place. Coordinates of the steps are those of the tool at these angles, its axis is Z, about the active preset,
which is the middle of the sphere. The last row corrects the kinematics, so that all before it count by the old one.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any, ClassVar

import numpy as np

from mnclab.controls.tnc_620.cycles.chain import TILT
from mnclab.controls.tnc_620.cycles.planes import ParameterFault, rate
from mnclab.controls.tnc_620.probing import addresses
from mnclab.controls.tnc_620.probing.addresses import MEASURED_BY, OF_AXES, OPTIMIZING
from mnclab.controls.tnc_620.probing.cycle import Moves, ProbingCycle, lengths, needed, store
from mnclab.controls.tnc_620.probing.saved_kinematics import headed, no_kinematics
from mnclab.controls.tnc_620.state import active_preset, memory
from mnclab.geometry import frames
from mnclab.geometry.kinematics import NAMES, Kinematics
from mnclab.machine.axes import chain, orientation
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import STILL, angles, in_mm, tool_axis
from mnclab.machine.cycle import CycleTable
from mnclab.machine.machine import Machine
from mnclab.machine.state import Place
from mnclab.machining.probing import fits
from mnclab.machining.probing.found import Floats
from mnclab.machining.probing.rotary_axes import AxisReadings, MeasuredAxis, Reading, evaluated
from mnclab.machining.probing.sequences import Approach, Steps, numbers, on_sphere, results
from mnclab.machining.steps import Go, Measure, Pause, Say, Step, Swivel, Write
from mnclab.workpiece.part import Part
from mnclab.workpiece.part import ball as sphere

CYCLES = CycleTable(addresses=addresses, runs="definition")
SETTINGS = (
    Setting("kinematics_comp", True, "software option 52, KinematicsComp: cycle 451 can optimize angles", "18.4"),
    Setting("software_option_2", True, "451 and 452 may lead the probe round the sphere, without a retraction height", "18.4"),
    Setting(
        "max_modification", 0.05, "greater changes of the kinematics must be confirmed (maxModification, no. 204801)", "18.2",
        unit="mm", at_least=0,
    ),
    Setting(
        "max_dev_cal_ball", 0.02, "how far the radius of the calibration sphere may be off (maxDevCalBall, no. 204802)", "18.2",
        unit="mm", at_least=0,
    ),
    Setting(
        "m_strobe_rot_ax_pos", -1, "M function that positions the rotary axes, -1: none (mStrobeRotAxPos, no. 204803)", "18.2",
    ),
    *(Setting(f"hirth_{k.lower()}", 0.0, f"grid of the axis {k} with a Hirth coupling, 0: it has none", "18.4", unit="deg",
              at_least=0) for k in NAMES),
)  # fmt: skip
CHECK, POSITION, POSE, DATUM = OPTIMIZING
BEFORE, AFTER = (1, 3), (2, 3)  # of Q431
NEVER = -1.0  # of a result that there is none of
SLACK = 1e-9  # mm, of numbers alone
first_angle = partial(addresses.reference_angle, meaning="angle of the first touch on the equator", at_least=0)


@dataclass
class Measuring:
    """What a cycle has found so far: the readings by axis, all of them in their order."""

    axes: dict[str, AxisReadings] = field(default_factory=dict)
    all: list[Reading] = field(default_factory=list)
    touches: list[int] = field(default_factory=list)


class MeasuringKinematics(ProbingCycle, ABC):
    """Base of 451 and 452: the axes are measured one after the other, the others at their angles of incidence."""

    tilted: ClassVar[bool] = True
    tried_on = "table-ac"
    mode: float = POSITION
    preset: float = 0.0
    sphere_radius: float = 0.0
    retraction_height: float = 0.0
    feed_pre_positioning: Any = 0.0
    number_of_touch_points: float = 4.0
    backlash_angular_range: float = 0.0

    def of(self, what: str, axis: str) -> float:
        """A parameter of an axis."""
        return float(getattr(self, f"{what}_{axis.lower()}"))

    def positions(self, m: Machine, axis: str) -> list[float]:
        """The angles, degrees, at which an axis is measured, but for the reference at 0."""
        count = int(self.of("measuring_points", axis))
        start, end = self.of("start_angle", axis), self.of("end_angle", axis)
        grid = float(m.settings[f"hirth_{axis.lower()}"])
        at = [start + k * (end - start) / max(count - 1, 1) for k in range(count)]
        return [each for each in (in_grid(each, grid) for each in at) if abs(each) > STILL]

    def measured(self, m: Machine) -> list[str]:
        """The axes that are there and are measured."""
        return [axis for axis in chain(m).names if self.positions(m, axis)]

    def reverses(self, m: Machine, axis: str) -> float:
        """The angle by which the backlash of an axis is measured, degrees; 0: it is not."""
        can = m.settings["m_strobe_rot_ax_pos"] == -1 and not m.settings[f"hirth_{axis.lower()}"]
        return self.backlash_angular_range if can else 0.0

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        missing = list(no_kinematics(m))
        if missing or m.tables.kinematics is None:
            yield from missing
            return
        if tool_axis(m) != 2:
            yield "", f"needs the tool axis Z, and the tool lies along {'XYZ'[tool_axis(m)]}"
        if m.reckoned is None:
            yield "", "cannot run while the tip of the tool is led: switch off M128 or FUNCTION TCPM before it"
        if m.settings["m_strobe_rot_ax_pos"] != -1 and any(abs(each) > STILL for each in m.rotary):
            yield "", "needs all rotary axes at 0: an M function positions them (setting m_strobe_rot_ax_pos)"
        if any(memory(m).rotary_shift) or memory(m).rotary_mirror:
            yield "", "cannot run while a rotary axis is shifted or mirrored"
        yield from self.turning(m)

    def turning(self, m: Machine) -> Iterator[ParameterFault]:
        """What does not allow to turn the axes."""
        if not self.retraction_height:
            if hirth := next((axis for axis in self.measured(m) if m.settings[f"hirth_{axis.lower()}"]), None):
                yield "retraction_height", f"must be greater than 0 for the axis {hirth} with a Hirth coupling"
            if not m.settings["software_option_2"]:
                yield "retraction_height", "must be greater than 0 without the software option 2 (setting software_option_2)"
        for axis in chain(m).names:
            low, high = chain(m).axis(axis).limits
            reverse, at = abs(self.reverses(m, axis)), self.positions(m, axis)
            ends = [("start_angle", at[0], reverse), ("end_angle", at[-1], reverse)] if at else []
            if any(other != axis for other in self.measured(m)):
                ends.append(("incidence_angle", self.of("incidence_angle", axis), 0.0))
            for what, angle, more in ends:
                if not low <= angle - more <= angle + more <= high:
                    room = f"the axis goes from {low:g} to {high:g}" + (f", and the backlash needs {more:g}" if more else "")
                    yield f"{what}_{axis.lower()}", f"leads to {angle:g}: {room}"

    def figure(self, m: Machine) -> Part:
        """The sphere, where the cycle looks for it first."""
        x, y, z = m.programmed
        under = x, y, z - self.approach(m).gap - self.sphere_radius
        return sphere(m.to_machine(under if self.preset in BEFORE else (0.0, 0.0, 0.0)), self.sphere_radius)

    # --- how the probe goes about it ---------------------------------------------------------------------------------

    @property
    def rate(self) -> float:
        """The feed Q253, mm/min and degrees a minute."""
        return rate(self.feed_pre_positioning)

    def moves(self, m: Machine) -> Moves:
        a, before = self.approach(m), chain(m)
        found = Measuring()
        yield Write("memory", {}, "tilt_angles")
        yield from with_axes(m)
        if self.preset in BEFORE:
            x, y, z = m.programmed
            about, _ = yield from self.touched(m, a, (x, y, z - a.gap - self.sphere_radius), watched=False)
            centre, _ = yield from self.touched(m, a, about)
            yield from self.set_preset(m, np.array(m.to_machine(centre)))
        for axis in self.measured(m):
            found.axes[axis] = yield from self.one_axis(m, a, axis, found)
        if not found.all or self.preset in AFTER:
            found.all.append((yield from self.reading(m, a, found)))
        after, axes = evaluated(before, below(m), found.axes, askew=self.mode in (POSE, DATUM))
        drift = self.drift(m, found, after)
        after = replace(after, shift=tuple((after.shift - drift).tolist()))
        yield from self.told(m, axes, found, after, drift)
        if self.mode != CHECK and after != before:
            yield from self.confirmed(m, before, after)
            yield Write("kinematics", after, label="the kinematics is corrected")
            yield from with_axes(m)
        if self.preset in AFTER:
            yield from self.set_preset(m, self.seen(m, chain(m), found.all[-1]))

    def touched(self, m: Machine, a: Approach, centre: Place, watched: bool = True) -> Steps:
        """The middle of the sphere, measured about a place of it (x, y, z), and the contacts."""
        yield from self.over_pole(m, a, centre)
        contacts = yield from on_sphere(a, centre, self.sphere_radius, self.reference_angle, int(self.number_of_touch_points))
        ball = needed(fits.sphere, [each.point for each in contacts], m=m, code=self.code)
        off, most = ball.radius - a.ball - self.sphere_radius, m.settings["max_dev_cal_ball"]
        if watched and abs(off) > most:
            said = f"is {self.sphere_radius:g}, and {self.sphere_radius + off:.4f} was measured: it may be off by {most:g}"
            sentence = f"{self.code} Q407 (exact radius of the calibration sphere) {said}"
            m.alarm(in_mm(sentence, m.variable_unit), hint="setting max_dev_cal_ball")
        return (ball.x, ball.y, ball.z), contacts

    def over_pole(self, m: Machine, a: Approach, centre: Place) -> Iterator[Step]:
        """From where the probe stands, and not below that height."""
        x, y, z = centre
        top, slower = z - a.ball + self.sphere_radius + a.away, min(self.rate, a.positioning)
        if m.programmed[2] < top - STILL:
            yield Go("up", top, slower)
        if math.dist(m.programmed[:2], (x, y)) > STILL:
            yield Go("over the sphere", None, slower, x, y)
        if abs(m.programmed[2] - top) > STILL:
            yield Go("over the pole", top, slower)

    def reading(self, m: Machine, a: Approach, found: Measuring) -> Steps:
        """The sphere, which is where the preset is, measured with the axes as they stand."""
        centre, contacts = yield from self.touched(m, a, (0.0, 0.0, 0.0))
        found.touches += numbers(contacts)
        stands = np.array(m.rotary)
        return Reading(stands, chain(m).references(np.array(m.to_machine(centre)), stands, -below(m)[2]))

    def one_axis(self, m: Machine, a: Approach, axis: str, found: Measuring) -> Steps:
        """The reference, with the axis at 0 and the others at their angles of incidence, and its positions."""
        yield from self.turn(m, a, {other: self.of("incidence_angle", other) for other in chain(m).names} | {axis: 0.0})
        readings: list[list[Reading]] = [[], []]
        reference = yield from self.reading(m, a, found)
        found.all.append(reference)
        by = self.reverses(m, axis)
        for at in self.positions(m, axis):
            for k, coming in enumerate((at - by, at + by) if by else (at,)):
                yield from self.turn(m, a, {axis: coming})
                yield from self.turn(m, a, {axis: at})
                readings[k].append((yield from self.reading(m, a, found)))
                found.all.append(readings[k][-1])
        return AxisReadings(reference, *readings)

    def turn(self, m: Machine, a: Approach, to: Mapping[str, float]) -> Iterator[Step]:
        """Rotary axes, one after the other, to angles (degrees) by their names: at the retraction height, or round the sphere."""
        to = {axis: at for axis, at in to.items() if abs(at - angles(m)[NAMES.index(axis)]) > math.degrees(STILL)}
        if not to:
            return
        away: float | None = None  # the linear axes stand
        if self.retraction_height:
            yield from with_axes(m, turned=False)
            if abs(m.programmed[2] + a.ball - self.retraction_height) > STILL:
                yield Go("to the retraction height", self.retraction_height - a.ball, self.rate)
            if math.hypot(*m.programmed[:2]) > STILL:
                yield Go("over the datum", None, self.rate, 0.0, 0.0)
        else:
            yield from self.over_pole(m, a, (0.0, 0.0, 0.0))
            away = self.sphere_radius + a.away - a.ball
        for axis in NAMES:
            if axis in to:
                stands = list(angles(m))
                stands[NAMES.index(axis)] = to[axis]
                yield Swivel(f"{axis} to {to[axis]:.10g}", (stands[0], stands[1], stands[2]), self.rate, away)
        yield from with_axes(m)

    def set_preset(self, m: Machine, place: Floats) -> Iterator[Step]:
        """The active preset is a place on the part."""
        x, y, z = (frames.inverse(m.frames.before("preset")) @ (*place, 1.0))[:3].tolist()
        yield from store(m, active_preset(m), x=x, y=y, z=z)

    # --- what comes of it --------------------------------------------------------------------------------------------

    def seen(self, m: Machine, kinematics: Kinematics, reading: Reading) -> Floats:
        """Where the middle of the sphere is on the part (3,), as a kinematics has it."""
        return kinematics.tips(reading.place, reading.angles, -below(m)[2])

    def drift(self, m: Machine, found: Measuring, after: Kinematics) -> Floats:
        """By how much the sphere is off the preset on the part (3,), as far as the kinematics takes that in."""
        return np.zeros(3)

    @abstractmethod
    def offset_error(self, m: Machine, axes: Mapping[str, MeasuredAxis], drift: Floats) -> Floats:
        """Q147 to Q149 (3,), mm."""

    def told(
        self, m: Machine, axes: Mapping[str, MeasuredAxis], found: Measuring, after: Kinematics, drift: Floats
    ) -> Iterator[Step]:
        """Results, measuring record and log."""
        measured = {q: axes[axis].scatter for q, axis in zip(("Q141", "Q142", "Q143"), NAMES) if axis in axes}
        optimized = {q: axes[axis].optimized for q, axis in zip(("Q144", "Q145", "Q146"), NAMES) if axis in axes}
        yield from results(**{f"Q{n}": NEVER for n in range(141, 147)})
        yield from lengths(m, **measured, **(optimized if self.mode != CHECK else {}))
        yield from lengths(m, **dict(zip(("Q147", "Q148", "Q149"), self.offset_error(m, axes, drift).tolist())))
        for name, axis in axes.items():
            touches = tuple(found.touches)
            yield Measure(f"{name} scatter", axis.scatter, 0.0, touches=touches)
            for k, along in enumerate("XYZ"):
                yield Measure(f"{name} {along}", axis.after.centre[k], axis.before.centre[k], touches=touches)
        yield Write("file", "\n".join([*self.log(m, axes, after), ""]), f"TCHPR{self.code.split()[-1]}.TXT")

    def log(self, m: Machine, axes: Mapping[str, MeasuredAxis], after: Kinematics) -> Iterator[str]:
        """Its lines; lengths are in mm, whatever the program counts in."""
        yield from headed(m, self, after)
        yield from self.log_of_mode()
        yield f"Radius of the calibration sphere: {self.sphere_radius:.4f}"
        for name, axis in axes.items():
            compensation, before, now = (
                " ".join(f"{along}{value:z.6f}" for along, value in zip("XYZ", each))
                for each in (axis.compensation.tolist(), axis.before.centre, axis.after.centre)
            )
            yield f"Axis {name}:"
            for what, value in {
                "Start angle": f"{self.of('start_angle', name):.4f}", "End angle": f"{self.of('end_angle', name):.4f}",
                "Angle of incidence": f"{self.of('incidence_angle', name):.4f}",
                "Measuring points": f"{len(axis.angles)}", "Standard deviation": f"{axis.scatter:z.6f}",
                "Maximum error": f"{axis.worst:z.6f}", "Angular error": f"{axis.angular:z.6f}",
                "Averaged backlash": known(axis.backlash), "Averaged positioning error": known(axis.positioning),
                "Measuring circle radius": f"{axis.radius:.4f}", "Compensation": compensation,
                **self.further(axis), "Position before": before, "Position after": now,
            }.items():  # fmt: skip
                yield f"  {what}: {value}"
        yield "End of measuring log"

    def log_of_mode(self) -> Iterator[str]:
        yield from ()

    def further(self, axis: MeasuredAxis) -> dict[str, str]:
        """Of an axis, in the log."""
        return {}

    def confirmed(self, m: Machine, before: Kinematics, after: Kinematics) -> Iterator[Step]:
        """The operator confirms great changes with NC start."""
        most = m.settings["max_modification"]
        changes = {
            f"{along} of {axis.name}": new - old for axis in before.sequence
            for along, old, new in zip("XYZ", axis.centre, after.axis(axis.name).centre)
        } | {f"{along} of the datum": new - old for along, old, new in zip("XYZ", before.shift, after.shift)}  # fmt: skip
        which = max(changes, key=lambda name: abs(changes[name]))
        if abs(changes[which]) > most + SLACK:
            said = f"changes {which} by {changes[which]:.4f}, more than {most:g}"
            yield Say(said, "setting max_modification; NC start confirms it")
            yield Pause("the change is confirmed")


def in_grid(angle: float, grid: float) -> float:
    """An angle in the grid of a Hirth coupling, counted from 0; half of it away from 0."""
    return math.copysign(math.floor(abs(angle) / grid + 0.5) * grid, angle) if grid else angle


def known(value: float) -> str:
    return "not measured" if math.isnan(value) else f"{value:z.6f}"


def below(m: Machine) -> Floats:
    """The middle of the ball from the spindle reference (3,)."""
    return np.array([0.0, 0.0, m.tool.effective_radius - m.tool.effective_length])


def with_axes(m: Machine, turned: bool = True) -> Iterator[Step]:
    """Coordinates are those of the tool as the rotary axes stand, about the preset (3D-ROT); or as if they stood at zero."""
    before = m.frames.before(TILT)[:3, :3]
    level = frames.turn(math.atan2(before[1, 0], before[0, 0]), "z")
    tilt = np.eye(4)
    tilt[:3, :3] = before.T @ (orientation(m) if turned else np.eye(3)) @ level[:3, :3]
    stands = turned and bool(np.abs(tilt[:3, :3] - np.eye(3)).max() > STILL)
    yield Write("frame", tilt if stands else None, TILT)
    yield Write("reckoned", m.rotary if turned else (0.0, 0.0, 0.0))


@CYCLES(
    "TCH PROBE 451", "Measure kinematics", source="18.4",
    takes=f"mode {MEASURED_BY} {OF_AXES} number_of_touch_points preset backlash_angular_range",
)  # fmt: skip
class MeasureKinematics(MeasuringKinematics):
    """Checks the rotary axes, or puts them where a sphere shows them: 4 to 9 touches at each of their positions."""

    clearance: float = addresses.clearance(predef=True)
    reference_angle: float = first_angle()

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from super().check(m)
        if self.mode in (POSE, DATUM) and not m.settings["kinematics_comp"]:
            what = "needs the software option KinematicsComp, which is switched off (setting kinematics_comp)"
            yield "mode", f"{self.mode:g} {what}"
        if self.mode == DATUM and (machine := m.tables.kinematics) is not None:
            sides = ([axis.name for axis in side if axis.name in self.measured(m)] for side in (machine.head, machine.table))
            if not any(len(side) > 1 for side in sides):
                yield "mode", "3 needs two axes that are measured, one upon the other in the head or in the table"

    def drift(self, m: Machine, found: Measuring, after: Kinematics) -> Floats:
        """What is common to all measurements, the references included."""
        if self.mode != DATUM:
            return np.zeros(3)
        return np.asarray(np.mean([self.seen(m, after, each) for each in found.all], axis=0) - m.to_machine((0.0, 0.0, 0.0)))

    def offset_error(self, m: Machine, axes: Mapping[str, MeasuredAxis], drift: Floats) -> Floats:
        """The compensation of the last axis."""
        return [np.zeros(3), *(axis.compensation for axis in axes.values())][-1]

    def log_of_mode(self) -> Iterator[str]:
        yield f"Mode: {self.mode:g}, {OPTIMIZING[self.mode]}"


@CYCLES(
    "TCH PROBE 452", "Preset compensation", source="18.5",
    takes=f"{MEASURED_BY} {OF_AXES} number_of_touch_points backlash_angular_range",
)  # fmt: skip
class PresetCompensation(MeasuringKinematics):
    """Puts the rotary axes where a sphere shows them, and the part so that the active preset is in the middle of the sphere."""

    reference_angle: float = first_angle()

    def drift(self, m: Machine, found: Measuring, after: Kinematics) -> Floats:
        """The middle of the sphere from the preset, at the first reference position."""
        return self.seen(m, after, found.all[0]) - m.to_machine((0.0, 0.0, 0.0))

    def offset_error(self, m: Machine, axes: Mapping[str, MeasuredAxis], drift: Floats) -> Floats:
        """The middle of the sphere as the preset had it."""
        return np.asarray(m.frames.before(TILT)[:3, :3].T @ drift)

    def further(self, axis: MeasuredAxis) -> dict[str, str]:
        return {"Measurement uncertainty": known(axis.uncertainty)}
