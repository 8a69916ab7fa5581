"""What all touch probe cycles of the TNC 620 share: their positions, what refuses them, how the probe approaches (chapter 13).

Positions of the program are those of the south pole of the ball; nominal points in the plane and measuring heights those of
the ball's center.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Sequence
from typing import Any, ClassVar

from mnclab.controls.tnc_620.contours.other_tools import Named, in_table
from mnclab.controls.tnc_620.cycles.chain import TILT
from mnclab.controls.tnc_620.cycles.faults import Fault
from mnclab.controls.tnc_620.cycles.planes import in_program_coordinates
from mnclab.controls.tnc_620.probing.fast_probing import probe_in_force
from mnclab.machine.coordinates import FRAME, in_mm
from mnclab.machine.cycle import Cycle
from mnclab.machine.machine import Machine
from mnclab.machine.touching import PROBES, Contact, unfit
from mnclab.machining.probing.sequences import Approach, numbers, results
from mnclab.machining.steps import Measure, Step
from mnclab.text.alarm import Alarm

Moves = Generator[Step, Any, None]
LEAST_STEP = 5.0  # degrees (15.6, 16.4)
ALLOWED = ("preset", FRAME)  # frames that a cycle 4xx may find active (13.2)


class ProbingCycle(Cycle):
    """Base of the cycles 4xx: who inherits declares the parameters, the clearance Q320 and the height Q260 among them."""

    does: ClassVar[str] = PROBES
    about = in_program_coordinates
    tilted: ClassVar[bool] = False
    """Whether it may run in a tilted working plane."""
    inside: ClassVar[bool] = True
    """Whether a figure is touched from within."""
    entered: ClassVar[tuple[str, ...]] = ()
    """The sizes of a figure that the ball must enter."""

    x: Any = 0.0  # some cycles can do without these three
    y: Any = 0.0
    z: Any = 0.0
    axis: Any = 1.0
    second_x = second_y = third_x = third_y = centre_x = centre_y = middle_x = middle_y = 0.0
    first_center_axis_1 = first_center_axis_2 = second_center_axis_1 = second_center_axis_2 = 0.0
    diameter = length = width = nominal_length = starting_angle = first_angle = second_angle = third_angle = 0.0
    reference_angle = preset_rotation_angle = compensation = set_to_zero = basic_rotation = spacing_axis_1 = spacing_axis_2 = 0.0
    clearance = height = level = move_to_clearance = row = measuring_log = program_stop = 0.0
    probe_z = top_x = top_y = top_z = datum = datum_x = datum_y = datum_z = 0.0
    maximum_limit = minimum_limit = first_maximum = first_minimum = second_maximum = second_minimum = 0.0
    tolerance_x = tolerance_y = 0.0
    result_parameter = angle = reach = feed = back = system = 0.0
    direction = transfer = traverse = 1.0
    points, stepping_angle = 4.0, 90.0
    monitored_tool: Named = 0.0

    def contradictions(self) -> Iterator[Fault]:
        if abs(self.stepping_angle) < LEAST_STEP:
            yield "stepping_angle", f"must be at least {LEAST_STEP:g} or at most -{LEAST_STEP:g}, got {self.stepping_angle:g}"

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from unfit(m)
        yield from self.transformed(m)
        if self.transfer == -1 and self.row:  # of programs from older controls (15.1)
            yield "transfer", "-1 does not say where row Q305 is: choose 0 (datum table) or 1 (preset table)"
        if self.monitored_tool != 0:
            yield from in_table(self, m, "monitored_tool")
        for name in self.entered:
            if getattr(self, name) <= 2 * m.radius:
                yield name, f"must be greater than the ball, {2 * m.radius:g}, got {getattr(self, name):g}"

    def transformed(self, m: Machine) -> Iterator[Fault]:
        """A transformation that it must not find active (13.2)."""
        allowed = (*ALLOWED, TILT) if self.tilted else ALLOWED
        if active := [name for name, _ in m.frames if name not in allowed and name in m.frames]:
            yield "", f"cannot run while a {active[0].replace('axis scales', 'scale of an axis')} is active"

    def approach(self, m: Machine, **other: Any) -> Approach:
        """How the probe of the table moves in this cycle; `other` values of it."""
        probe = probe_in_force(m)
        found = {
            "ball": m.radius, "gap": probe.clearance + self.clearance, "level": self.level, "height": self.height,
            "reach": probe.reach, "feed": min(probe.feed, m.settings["max_touch_feed"]),
            "positioning": probe.positioning_feed, "over": self.move_to_clearance == 1, "track": probe.track,
        }  # fmt: skip
        return Approach(**{**found, **other})


def lengths(m: Machine, **values: float) -> Iterable[Step]:
    """Q parameters that hold lengths: mm here, the unit of the program there."""
    return results(**{name: value / m.variable_unit for name, value in values.items()})


def measured(contacts: Sequence[Contact], **found: tuple[float, float]) -> Iterable[Step]:
    """Lines of the measuring record without limits: `measured(contacts, X=(actual, nominal))`."""
    return [Measure(what, actual, nominal, touches=numbers(contacts)) for what, (actual, nominal) in found.items()]


def needed(fit: Any, *points: Any, m: Machine, code: str) -> Any:
    """What a fit finds in the touched points; where they do not make the figure, an alarm of the cycle."""
    try:
        return fit(*points)
    except Alarm as alarm:
        m.alarm(in_mm(f"{code}: {alarm.message}", m.variable_unit))
