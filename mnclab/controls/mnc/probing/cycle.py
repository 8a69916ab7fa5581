"""What all measuring cycles of the MNC share: approach, datum, figures that are touched, and what is said of a measure."""

from __future__ import annotations

import math
from collections.abc import Generator, Iterator, Mapping, Sequence
from typing import Any, ClassVar, NamedTuple

import numpy as np

from mnclab.controls.mnc.language import memory
from mnclab.controls.word_address.holes import out_of_place
from mnclab.geometry import frames
from mnclab.machine.cycle import Cycle
from mnclab.machine.flow import FILE
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import DIGITS, OUT, judged
from mnclab.machine.setup import Datum
from mnclab.machine.touching import PROBES, Contact, unfit
from mnclab.machining.probing.fits import circle, rectangle
from mnclab.machining.probing.found import Circle, Rectangle, Width, sketch
from mnclab.machining.probing.sequences import (
    MINUS_X,
    MINUS_Y,
    OPPOSITE,
    Approach,
    Pair,
    X,
    Y,
    from_above,
    numbers,
    sides,
)
from mnclab.machining.steps import Measure, Pause, Say, Step, Write

# The base rotation and the datum from a measurement (MNC 12: "base rotation", "datum from measurement").
# The base rotation turns the plane about the datum point, outside the shift of G92 and the rotation of G39. A row of the
# datum table holds an angle only once one was stored, 0 included; selecting a row without one keeps the base rotation.

BASE = "base rotation"  # the frame
AXES = "xyz"
SAME = 1e-12


def base_rotation(m: Machine) -> float:
    """Degrees, counter-clockwise."""
    return memory(m).base_rotation


def turn_base(angle: float) -> Iterator[Step]:
    """Make an angle the base rotation; nothing moves, the place is read anew."""
    yield Write("frame", frames.turn(math.radians(angle)) if angle else None, BASE)
    yield Write("memory", angle, "base_rotation")


def store_angle(m: Machine, row: float, angle: float) -> Iterator[Step]:
    """Write the column rotation of a row of the datum table; row 0 is none."""
    if row:
        yield Write("datums", m.tables.datums.get(int(row), Datum())._replace(rotation=angle), int(row))
        yield Write("memory", memory(m).angled | {int(row)}, "angled")


def set_datum(
    m: Machine, found: Mapping[int, tuple[float, float]], row: float, apply: bool, turned: float | None = None
) -> Iterator[Step]:  # fmt: skip
    """Make a measured point the datum: by axis (0, 1, 2) its measured coordinate and the one that it gets.

    `apply`: the working datum becomes it, until the next row is selected. `row` > 0: its measured columns are written. `turned`
    (degrees) is added to the base rotation where it is applied, and written too.
    """
    measured, new, mask = np.zeros(3), np.zeros(3), np.zeros(3)
    for k, (is_, gets) in found.items():
        measured[k], new[k], mask[k] = is_, gets, 1.0
    datum, local = m.frames["datum"][:3, 3], m.frames["local"][:3, 3]
    before = base_rotation(m)
    angle = before + turned if apply and turned is not None else before
    old, turn = (frames.turn(math.radians(each))[:3, :3] for each in (before, angle))
    origin = datum + old @ ((measured + local) * mask) - turn @ (new * mask)
    changed = [k for k in range(3) if np.abs(old[k] * mask).max() > SAME]
    if row:
        kept = m.tables.datums.get(int(row), Datum())
        yield Write("datums", kept._replace(**{AXES[k]: float(origin[k]) for k in changed}), int(row))
    if row or apply:
        for k in changed:
            yield Measure(f"datum {'XYZ'[k]}", float(origin[k]))
    if apply:
        if turned is not None:
            yield from turn_base(angle)
            yield from store_angle(m, row, angle)
        rest = (local * (1 - mask)).tolist()  # of the shift of G92, on the axes that were not measured
        if "local" in m.frames:
            yield Write("frame", frames.shift(*rest) if any(rest) else None, "local")
        yield Write("datum", Datum(*(float(origin[k] if k in changed else datum[k]) for k in range(3))), "datum")


# What all measuring cycles of the MNC share: what refuses them, how the probe approaches (MNC 12: probe table, probe motion).
# Coordinates are absolute under G90 and G91; the ball's centre runs on the stated lines, z is the south pole of the ball.

Moves = Generator[Step, Any, None]
Found = dict[int, tuple[float, float]]  # by axis: its measured coordinate and the one that it gets
SCALES = ("scaling", "mirror")
TURNS = (*SCALES, "rotation")
LIMITS = (("min_size", "max_size"), ("min_size_x", "max_size_x"), ("min_size_y", "max_size_y"))
NEEDED_WITH_F = ("z_probe_x", "z_probe_y", "z_probe_z")

ROWS = 99  # of the datum table, at least (MNC-DATUM-ROWS)


class MeasuringCycle(Cycle):
    """Base of the cycles of chapter 12: who inherits declares the parameters, Q and H among them."""

    does: ClassVar[str] = PROBES
    refused: ClassVar[tuple[str, ...]] = SCALES
    """Frames that must not be active."""
    entered: ClassVar[tuple[str, ...]] = ()
    """The sizes of a figure that the ball must enter."""
    inside: ClassVar[bool] = True
    """Whether a figure is touched from within."""

    x: Any = 0.0  # some cycles can do without these three
    y: Any = 0.0
    width: Any = 0.0
    diameter = length_x = length_y = 0.0
    axis = direction = 1.0
    x_new = y_new = new_coordinate = rotate = 0.0
    clearance = level = height = between = row = apply = probe_z = z_new = protocol = stop_on_error = 0.0
    x2 = y2 = 0.0
    z_probe_x: Any = None
    z_probe_y: Any = None
    z_probe_z: Any = None
    max_size: Any = None
    min_size: Any = None
    max_size_x: Any = None
    min_size_x: Any = None
    max_size_y: Any = None
    min_size_y: Any = None
    tol_center_x: Any = None
    tol_center_y: Any = None

    def contradictions(self) -> Iterator[tuple[str, str]]:
        for name in NEEDED_WITH_F if self.probe_z else ():
            if getattr(self, name) is None:
                yield name, "is missing: F1 needs it"
        for name, other in LIMITS:
            least, most = getattr(self, name), getattr(self, other)
            if least and most and least > most:
                yield name, f"must be at most the greatest permissible size {most:g}, got {least:g}"

    def check(self, m: Machine) -> Iterator[tuple[str, str]]:
        yield from unplaced(m)
        yield from unfit(m, still=True)
        for name in self.refused:
            if name in m.frames:
                yield "", f"cannot run while a {name} is active"
        rows = max(int(m.settings["datum_rows"]), ROWS)
        if self.row > rows and int(self.row) not in m.tables.datums:
            yield "row", f"must be at most {rows}, the rows that the datum table has, got {self.row:g}"
        yield from self.low(self.approach(m))
        yield from self.fits(m, **{name: getattr(self, name) for name in self.entered})

    def about(self, m: Machine) -> tuple[float, float]:
        return 0.0, 0.0

    def approach(self, m: Machine, **other: Any) -> Approach:
        """How the probe of the table moves in this cycle; `other` values of it."""
        probe = m.tables.probe
        found = {
            "ball": m.radius, "gap": probe.clearance + self.clearance, "level": self.level, "height": self.height,
            "reach": probe.reach, "feed": probe.feed, "positioning": probe.positioning_feed, "over": self.between == 1,
            "track": probe.track,
        }  # fmt: skip
        return Approach(**{**found, **other})

    def low(self, a: Approach) -> Iterator[tuple[str, str]]:
        """A safe height below the measuring height, or below where the touch along Z begins."""
        yield from self.below(a, a.pole)
        if self.z_probe_z is not None and self.probe_z:
            yield from self.below(a, self.z_probe_z + a.gap)

    def below(self, a: Approach, z: float) -> Iterator[tuple[str, str]]:
        if a.height < z:
            yield "height", f"must not lie below the ball's lowest point where a touch begins, {z:g}, got {a.height:g}"

    def fits(self, m: Machine, **sizes: float) -> Iterator[tuple[str, str]]:
        """A figure that the ball does not enter."""
        for name, given in sizes.items():
            if given <= 2 * m.radius:
                yield name, f"must be greater than the diameter of the ball, {2 * m.radius:g}, got {given:g}"

    def finish(self, m: Machine, a: Approach, found: Found, turned: float | None = None) -> Moves:
        """With F1 the touch from above, at the safe height before and after; then the datum of the axes that were `found`."""
        if self.probe_z and self.z_probe_x is not None and self.z_probe_y is not None and self.z_probe_z is not None:
            contact = yield from from_above(a, self.z_probe_x, self.z_probe_y, self.z_probe_z, a.height)
            z = contact.point[2] - a.ball
            yield Measure("Z", z, self.z_probe_z, touches=(contact.number,))
            found = {**found, 2: (z, self.z_new)}
        yield from set_datum(m, found, self.row, self.apply == 1, turned)


def unplaced(m: Machine) -> Iterator[tuple[str, str]]:
    """A fault in machine coordinates, under radius compensation, or in another plane."""
    yield from out_of_place(m)
    if m.plane != "XY":
        yield "", f"needs the plane G17, {m.modal.get('plane', m.plane)} is active"


# Figures that are touched from opposite sides, +X, -X, +Y, -Y: what is found, and the contacts (MNC 12, "probe motion").
# A ball that has no room before a side begins in the centre, on all sides then (MNC-PROBE-CENTRE). The middle lies between
# opposite contacts; the diameter is twice the mean distance of the ball from the centre, less or more the ball (MNC-G412-FIT).

Contacts = Sequence[Contact]
PAIRS = ((X, MINUS_X), (Y, MINUS_Y))


def middle(
    a: Approach, centre: Pair, size: float, k: int, inside: bool, now: float
) -> Generator[Step, Any, tuple[float, float, Contacts]]:  # fmt: skip
    """A slot or a ridge, across the axis `k` (0 X, 1 Y): its middle along the axis, its width."""
    contacts = yield from sides(a, centre, (size / 2, size / 2), PAIRS[k], inside, now, each=False)
    ball = a.ball if inside else -a.ball
    high, low = contacts[0].point[k] + ball, contacts[1].point[k] - ball
    found = (high + low) / 2
    x, y = (centre[0], found) if k else (found, centre[1])
    yield sketch(Width(*centre, size), Width(x, y, high - low), a.level, contacts, 90 * k)
    return found, high - low, contacts


def box(
    a: Approach, centre: Pair, lengths: Pair, inside: bool, now: float
) -> Generator[Step, Any, tuple[Rectangle, Contacts]]:  # fmt: skip
    """A rectangular pocket or island, its sides along the axes."""
    contacts = yield from sides(a, centre, (lengths[0] / 2, lengths[1] / 2), OPPOSITE, inside, now, each=False)
    found = rectangle([contact.point[:2] for contact in contacts]).grown(a.ball if inside else -a.ball)
    yield sketch(Rectangle(*centre, *lengths), found, a.level, contacts)
    return found, contacts


def ring(
    a: Approach, centre: Pair, diameter: float, inside: bool, now: float
) -> Generator[Step, Any, tuple[Circle, Contacts]]:  # fmt: skip
    """A bore or a boss."""
    contacts = yield from sides(a, centre, (diameter / 2, diameter / 2), OPPOSITE, inside, now, each=False)
    found = circle([contact.point[:2] for contact in contacts], "opposite").grown(a.ball if inside else -a.ball)
    yield sketch(Circle(*centre, diameter / 2), found, a.level, contacts)
    return found, contacts


# What a measuring cycle says of its measures: the record, the protocol file, and the stop beyond a limit (MNC 12.13 to 12.19).
# Nobody says how the file looks; adopted are a running number in the folder and a line `name = value` for each number,
# with four
# decimals, as the table of the record shows them (MNC-PROT-FORMAT). There is no date, so that two equal runs write equal files.

FOLDER = "meas_prot"
OK = "ok"
SAID = {"too_large": "is too large, the limit is", "too_small": "is too small, the limit is", "center": "is off, the limit is"}


class Check(NamedTuple):
    """A measure, and the status that it has above and below its limits."""

    measure: Measure
    above: str = ""
    below: str = ""

    @property
    def status(self) -> str:
        """Empty within the limits; a value on its limit is within."""
        found = self.measure
        if judged(found.actual, found.lower, found.upper) != OUT:
            return ""
        return self.above if found.actual > found.upper else self.below

    @property
    def said(self) -> str:
        """The feature, its value and its limit."""
        found = self.measure
        limit = found.upper if found.actual > found.upper else found.lower
        words = next(words for name, words in SAID.items() if self.status.startswith(name))
        return f"{found.what} {found.actual:.{DIGITS}f} {words} {limit:.{DIGITS}f}"


def size(what: str, actual: float, nominal: float, most: float | None, least: float | None, axis: str = "") -> Check:
    """A size with its greatest and least permissible value; left out or 0 means that it is not checked (MNC-TOL-ZERO)."""
    found = Measure(what, actual, nominal, least or math.nan, most or math.nan)
    return Check(found, f"too_large{axis}", f"too_small{axis}")


def centre(axis: str, actual: float, nominal: float, by: float | None) -> Check:
    """A coordinate of a centre, which may deviate both ways."""
    off = by or math.nan
    status = f"center_{axis.lower()}"
    return Check(Measure(f"centre {axis}", actual, nominal, nominal - off, nominal + off), status, status)


def conclude(c: MeasuringCycle, m: Machine, contacts: Sequence[Contact], *checks: Check) -> Iterator[Step]:
    """The record, the protocol, and then the check of the limits: a warning and a stop that needs the operator, as the
    parameters of the cycle say; its datum and base rotation stay."""
    for check in checks:
        yield check.measure._replace(touches=numbers(contacts))
    beyond = [check for check in checks if check.status]
    if c.protocol:
        yield Write("file", text(m, c.code, checks, [check.status for check in beyond]), name(m, c.code))
    if beyond and c.stop_on_error:
        yield Say(f"{'; '.join(check.said for check in beyond)}: the program stops")
        yield Pause("limit exceeded")


def name(m: Machine, code: str) -> str:
    """The next file of the folder."""
    written = sum(each.startswith(f"{FILE}{FOLDER}/") for each in m.logs.by_name)
    return f"{FOLDER}/{code}_{written + 1:04d}.txt"


def head(m: Machine, code: str) -> list[str]:
    """The first lines of every file."""
    program = m.flow.program
    number = program[m.flow.current].number if len(program) else ""
    where = number or f"line {m.source_line}"
    return [f"cycle = {code}", f"program = {program.name}", f"block = {where}", f"tool = {m.tool.number}"]


def text(m: Machine, code: str, checks: Sequence[Check], status: Sequence[str]) -> str:
    """A file, line by line: what has no nominal value or no limit has no line of it."""
    lines = head(m, code)
    for measure, *_ in checks:
        numbers = {
            "nominal": measure.nominal, "measured": measure.actual, "deviation": measure.actual - measure.nominal,
            "least": measure.lower, "greatest": measure.upper,
        }  # fmt: skip
        lines += [f"{measure.what} {key} = {value:.{DIGITS}f}" for key, value in numbers.items() if not math.isnan(value)]
    return "\n".join([*lines, f"status = {' '.join(status) or OK}", ""])
