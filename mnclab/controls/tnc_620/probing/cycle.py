"""What all touch probe cycles of the TNC 620 share: positions, figures that are touched, and where a measured point is saved."""

from __future__ import annotations

import math
from collections.abc import Generator, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from mnclab.controls.tnc_620.contours.line import Named, in_table
from mnclab.controls.tnc_620.cycles.addresses import FAR, POSITIONING, choice, feed
from mnclab.controls.tnc_620.cycles.chain import TILT, carry
from mnclab.controls.tnc_620.cycles.planes import ParameterFault, in_program_coordinates
from mnclab.controls.tnc_620.state import active_preset, memory
from mnclab.machine.coordinates import FRAME, in_mm
from mnclab.machine.cycle import Cycle, CycleTable
from mnclab.machine.machine import INF, Machine
from mnclab.machine.probe import Probe
from mnclab.machine.setup import Datum
from mnclab.machine.touching import PROBES, Contact, unfit
from mnclab.machining.probing import fits, sequences
from mnclab.machining.probing.found import Circle, Rectangle, sketch
from mnclab.machining.probing.sequences import (
    Approach,
    Pair,
    Steps,
)
from mnclab.machining.steps import Measure, Step, Write
from mnclab.text.alarm import Alarm

# What all touch probe cycles of the TNC 620 share: their positions, what refuses them, how the probe approaches (chapter 13).
# Positions of the program are those of the south pole of the ball; nominal points in the plane and measuring heights those of
# the ball's center.

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

    def contradictions(self) -> Iterator[ParameterFault]:
        if abs(self.stepping_angle) < LEAST_STEP:
            yield "stepping_angle", f"must be at least {LEAST_STEP:g} or at most -{LEAST_STEP:g}, got {self.stepping_angle:g}"

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        yield from unfit(m)
        yield from self.transformed(m)
        if self.transfer == -1 and self.row:  # of programs from older controls (15.1)
            yield "transfer", "-1 does not say where row Q305 is: choose 0 (datum table) or 1 (preset table)"
        if self.monitored_tool != 0:
            yield from in_table(self, m, "monitored_tool")
        for name in self.entered:
            if getattr(self, name) <= 2 * m.radius:
                yield name, f"must be greater than the ball, {2 * m.radius:g}, got {getattr(self, name):g}"

    def transformed(self, m: Machine) -> Iterator[ParameterFault]:
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
    return sequences.results(**{name: value / m.variable_unit for name, value in values.items()})


def measured(contacts: Sequence[Contact], **found: tuple[float, float]) -> Iterable[Step]:
    """Lines of the measuring record without limits: `measured(contacts, X=(actual, nominal))`."""
    return [Measure(what, actual, nominal, touches=sequences.numbers(contacts)) for what, (actual, nominal) in found.items()]


def needed(fit: Any, *points: Any, m: Machine, code: str) -> Any:
    """What a fit finds in the touched points; where they do not make the figure, an alarm of the cycle."""
    try:
        return fit(*points)
    except Alarm as alarm:
        m.alarm(in_mm(f"{code}: {alarm.message}", m.variable_unit))


# Figures as presetting and inspecting cycles touch them: what is found, and the contacts (TNC 620, chapters 14 to 16).

def circle(c: ProbingCycle, m: Machine, contacts: Sequence[Contact]) -> Circle:
    """Of the ball's centres."""
    found: Circle = needed(fits.circle, [each.point for each in contacts], "power", m=m, code=c.code)
    return found


def ring(c: ProbingCycle, m: Machine, a: Approach, centre: Pair, leave: bool = True) -> Steps:
    """A hole or a round stud, as its angles say."""
    angles, over = (c.starting_angle, c.stepping_angle, int(c.points)), c.traverse == 1
    contacts = yield from sequences.around(a, centre, c.diameter / 2, *angles, c.inside, m.programmed[2], over, leave)
    found = circle(c, m, contacts).grown(a.ball if c.inside else -a.ball)
    yield sketch(Circle(*centre, c.diameter / 2), found, c.level, contacts)
    return found, contacts


def box(c: ProbingCycle, m: Machine, a: Approach, centre: Pair) -> Steps:
    """A pocket or a stud with straight sides along the axes."""
    contacts = yield from sequences.sides(a, centre, (c.length / 2, c.width / 2), sequences.ROUND, c.inside, m.programmed[2])
    right, back, left, front = (each.point for each in contacts)
    found = needed(fits.rectangle, [right, left, back, front], m=m, code=c.code).grown(a.ball if c.inside else -a.ball)
    yield sketch(Rectangle(*centre, c.length, c.width), found, c.level, contacts)
    return found, contacts


def holes(c: ProbingCycle, m: Machine, a: Approach, places: Sequence[Pair]) -> Steps:
    """The centres of holes, touched one after the other over the clearance height, and all contacts."""
    found, contacts = [], []
    for k, place in enumerate(places):
        touched = yield from sequences.from_centre(a, place, a.height if k else m.programmed[2])
        contacts += touched
        found.append(circle(c, m, touched).centre)
    return found, contacts


def bolt_circle(c: ProbingCycle, m: Machine, a: Approach) -> Steps:
    """The circle through three holes at their angles."""
    x, y, radius = c.middle_x, c.middle_y, c.diameter / 2
    turns = map(math.radians, (c.first_angle, c.second_angle, c.third_angle))
    places = [(x + radius * math.cos(turn), y + radius * math.sin(turn)) for turn in turns]
    centres, contacts = yield from holes(c, m, a, places)
    found = needed(fits.circle, centres, m=m, code=c.code)
    yield sketch(Circle(x, y, radius), found, c.level, contacts)
    return found, contacts


# Saving a measured point as preset or datum (TNC 620, 15.1): Q305 says which row, Q303 which table.
# Q305 = 0 is row 0 of the preset table, a copy of the active row, which becomes active. Row n is written in the columns that
# were measured; it counts at once if it is the active one. In the datum table (Q303 = 0) stands the shift from the preset.

AXES = ("x", "y", "z")
SAME = 1e-12


def finish(c: ProbingCycle, m: Machine, a: Approach, found: dict[int, tuple[float, float]], turned: float = 0.0) -> Moves:
    """Touch from above too, if the cycle asks for it (Q381), in the system that it began with; then save the preset."""
    if c.probe_z:
        contact = yield from sequences.from_above(a, c.top_x, c.top_y, c.top_z, a.height, leave="higher")
        found[2] = contact.point[2] - a.ball, c.datum_z
        yield from measured([contact], Z=(found[2][0], c.top_z))
    yield from save(m, found, c.row, c.transfer, turned)


def save(
    m: Machine, found: Mapping[int, tuple[float, float]], row: float, transfer: float, turned: float = 0.0,
) -> Iterator[Step]:  # fmt: skip
    """Write what was measured: by axis (0, 1, 2 of the cycle) its measured coordinate and the one that it gets.

    `turned` (degrees) is added to the basic rotation of the row: the point keeps its new coordinates in the turned system.
    """
    number = int(row)
    measured, new = np.zeros(3), np.zeros(3)
    for k, (is_, gets) in found.items():
        measured[k], new[k] = is_, gets
    if transfer == 0 and number:
        shift, sets = _along(m.frames[FRAME][:3, :3], measured - new, found)
        before = m.tables.datums.get(number, Datum())
        yield Write("datums", before._replace(**{AXES[k]: float(shift[k]) for k in sets}), number)
        return
    linear = m.frames.matrix[:3, :3]
    angle = np.radians(turned)
    turn = np.array([[np.cos(angle), -np.sin(angle), 0.0], [np.sin(angle), np.cos(angle), 0.0], [0.0, 0.0, 1.0]])
    shift, sets = _along(linear, measured - turn @ new, found)
    before = m.tables.presets.get(active_preset(m), Datum())
    columns = {AXES[k]: float(before[k] + shift[k]) for k in sets}
    if turned:
        columns["rotation"] = before.rotation + turned
    yield from store(m, number, **columns)


def store(m: Machine, row: float, **columns: float) -> Iterator[Step]:
    """Write columns of a preset row: row 0 is a copy of the active row that becomes active; the active row counts at once."""
    number, active = int(row), active_preset(m)
    copied = number in (0, active)
    preset = m.tables.presets.get(active if copied else number, Datum())._replace(**columns)
    yield Write("presets", preset, number)
    if copied:
        yield Write("memory", number, "preset")
        yield Write("datum", preset, "preset")
        yield from carry(m)


def _along(linear: np.ndarray, by: np.ndarray, found: Mapping[int, tuple[float, float]]) -> tuple[np.ndarray, list[int]]:
    """A shift of the axes of the cycle in those behind a frame, and which of these it can change."""
    mask = np.zeros(3)
    mask[list(found)] = 1.0
    changed = [k for k in range(3) if np.abs(linear[k] * mask).max() > SAME]
    return linear @ (by * mask), changed


# Cycle 441 FAST PROBING: how all touch probe cycles after it position, until the program ends (TNC 620, 17.10).

CYCLES = CycleTable(runs="definition")
SWITCH: dict[float, str] = {0: "no", 1: "yes"}
PREPOSITION: dict[float, str] = {0: "at the feed rate of Q396", 1: "at the rapid traverse of the machine"}
TABLE: dict[str, Any] = {"default": None, "default_means": "as the touch probe table has it"}
OWN: dict[str, Any] = {"default": None, "default_means": "as the measuring cycle says"}


@CYCLES("TCH PROBE 441", "Fast probing", source="17.10")
class FastProbing(Cycle):
    """Nothing moves; what is left out stays as the touch probe table has it."""

    positioning: float | str | None = feed("Q396", "positioning feed rate", also=POSITIONING, at_most=FAR, example=3000, **TABLE)
    rapid: float | None = choice("Q397", "pre-positioning", PREPOSITION, example=0, **TABLE)
    track: float | None = choice("Q399", "orienting the probe before each touch", SWITCH, example=1, **TABLE)
    interruption: float | None = choice("Q400", "stop with the results of a measuring cycle", SWITCH, example=1, **OWN)

    def contradictions(self) -> Iterator[tuple[str, str]]:
        if self.positioning == 0 and not self.rapid:
            yield "positioning", "must be greater than 0 where Q397 is 0"

    def moves(self, m: Machine) -> Iterator[Step]:
        yield Write("memory", self, "fast_probing")


def probe_in_force(m: Machine) -> Probe:
    """The touch probe table with what cycle 441 put in its place."""
    probe, fast = m.tables.probe, memory(m).fast_probing
    if fast is None:
        return probe
    if fast.rapid is not None:
        probe = replace(probe, positioning="machine" if fast.rapid else "probe")
    if fast.positioning is not None and not fast.rapid:
        probe = replace(probe, rapid=INF if fast.positioning == "FMAX" else float(fast.positioning), positioning="probe")
    return probe if fast.track is None else replace(probe, track=fast.track == 1)


def shows_results(m: Machine, chosen: bool) -> bool:
    """Whether a measuring cycle stops with its results: as it was `chosen` in it (Q281 = 2), or as Q400 says for all of them."""
    fast = memory(m).fast_probing
    return chosen if fast is None or fast.interruption is None else fast.interruption == 1
