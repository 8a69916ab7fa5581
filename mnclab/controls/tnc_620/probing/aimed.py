"""What the cycles 14xx share (TNC 620, 14.2): nominal places, the way of touching, and what becomes of a measure."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.controls.tnc_620.cycles.addresses import FAR
from mnclab.controls.tnc_620.cycles.planes import ParameterFault
from mnclab.controls.tnc_620.cycles.tilting import axis_positions, position
from mnclab.controls.tnc_620.probing.cycle import store
from mnclab.controls.tnc_620.probing.rotation import C, align, cannot_turn
from mnclab.controls.tnc_620.state import active_preset
from mnclab.geometry import frames
from mnclab.machine.control import Setting
from mnclab.machine.coordinates import in_mm
from mnclab.machine.machine import Machine
from mnclab.machine.measuring import OK, REWORK, SCRAP, SLACK
from mnclab.machine.setup import Datum
from mnclab.machine.touching import Contact
from mnclab.machining.probing import fits
from mnclab.machining.probing.found import spatial_angles
from mnclab.machining.probing.sequences import Approach, numbers, over_to
from mnclab.machining.steps import RAPID, Go, Measure, Orient, Pause, Step, Touch, Write
from mnclab.text.strings import TextFormula
from mnclab.text.tables import html_table

# Nominal values of the cycles 14xx: numbers, or texts with tolerances, an actual value, or a question (TNC 620, 14.2).
#     10          the nominal value                     10+0.02     the band from 10 to 10.02
#     +9-1-0,5    the band from 8 to 8.5                10@10.0123  not touched: it was found to be 10.0123
#     ?10         the operator puts the probe there     ?           … and what is found is the nominal value
# Deviations count from the middle of the band.

_NUMBER = r"(?:\d+(?:\.\d*)?|\.\d+)"
_TEXT = re.compile(rf"(\?)?([+-]?{_NUMBER})?((?:[+-]{_NUMBER})*)(?:@(?:([+-]?{_NUMBER})|(Q19\d\d)))?", re.ASCII)
_TOLERANCE = re.compile(rf"[+-]{_NUMBER}", re.ASCII)
MOST_TOLERANCES = 2


class Nominal(NamedTuple):
    """A nominal value with its limits, mm; None: what is found is the nominal value."""

    value: float | None
    lower: float = 0.0
    upper: float = 0.0
    actual: float | None = None
    asked: bool = False

    @property
    def mean(self) -> float | None:
        """The middle of the band."""
        return None if self.value is None else (self.lower + self.upper) / 2

    @property
    def limited(self) -> bool:
        return self.value is not None and self.lower < self.upper


def read(given: float | str | TextFormula, variables: Mapping[str, Any], unit: float) -> Nominal:
    """What a parameter says; numbers are mm, those of a text `unit` mm. ValueError with a sentence where it says nothing."""
    if isinstance(given, int | float):
        return Nominal(given, given, given)
    text = given if isinstance(given, str) else given.evaluate(variables)
    found = _TEXT.fullmatch(re.sub(r"\s", "", text).replace(",", ".").upper())
    if found is None or not text.strip():
        raise ValueError(f'is no nominal value such as "?10", "10+0.02-0.01" or "10@10.01", got "{text}"')
    asks, value, tolerances, actual, variable = found.groups()
    offsets = [float(each) for each in _TOLERANCE.findall(tolerances)]
    if len(offsets) > MOST_TOLERANCES:
        raise ValueError(f'takes {MOST_TOLERANCES} tolerances at most, got "{text}"')
    if value is None and (offsets or not asks):
        raise ValueError(f'needs a nominal value, got "{text}"')
    if asks and (actual or variable):
        raise ValueError(f'asks for a position (?) and gives it (@) in one, got "{text}"')
    if variable and not isinstance(variables.get(variable), int | float):
        raise ValueError(f"takes its actual value from {variable}, which has none")
    found_value = float(variables[variable]) if variable else None if actual is None else float(actual)
    is_ = None if found_value is None else found_value * unit
    if value is None:
        return Nominal(None, asked=True)
    nominal = float(value) * unit
    low, high = (min(offsets), max(offsets)) if len(offsets) == MOST_TOLERANCES else (min(0, *offsets, 0), max(0, *offsets, 0))
    limits = nominal + low * unit, nominal + high * unit
    for each in (nominal, *limits, is_ or 0.0):
        if not abs(each) <= FAR:
            raise ValueError(f"must be at least {-FAR:.10g} and at most {FAR:.10g}, got {each:.10g}")
    return Nominal(nominal, *limits, is_, bool(asks))


# What the cycles 14xx share (TNC 620, 14.2): nominal places, the way of the probe from one to the next, results, tolerances.
# Places are nominal coordinates of the input system, also in a tilted plane. What is found goes to Q950 and on, deviations from
# the middle of the tolerances to Q980 and on; the status Q183 is worked out before the preset changes.

Floats = NDArray[np.float64]
Given = float | str | TextFormula
SETTINGS = (
    Setting("manual_points", {}, "where the operator puts the center of the ball, or 1411 that of the circle, for a ? in a "
            "cycle 14xx: number of the place -> (x, y, z) of the program, mm", "14.2"),
    Setting("table_x", 0.0, "X of the center of the rotary table in machine coordinates", "14.2", unit="mm"),
    Setting("table_y", 0.0, "Y of the center of the rotary table in machine coordinates", "14.2", unit="mm"),
)  # fmt: skip
AXES = ("ref_axis", "minor_axis", "tool_axis")
PLACES = ("first_point", "second_point", "third_point")
STATUS = {OK: 0, REWORK: 1, SCRAP: 2}
LOG = "TCHPRAUTO.html"


class FoundPlace(NamedTuple):
    """A place as it was found, and the diameter of a circle there, mm."""

    point: Floats
    diameter: float = math.nan
    contacts: Sequence[Contact] = ()


class Judged(NamedTuple):
    """A measured value beside its limits; `verdict` as in the record, "" without limits."""

    what: str
    actual: float
    nominal: Nominal
    verdict: str
    contacts: Sequence[Contact]


Finding = Generator[Step, Any, FoundPlace]


def names(c: Any) -> list[tuple[str, str, str]]:
    """The parameters of each place."""
    return [(f"{p}_{AXES[0]}", f"{p}_{AXES[1]}", f"{p}_{AXES[2]}") for p in PLACES if hasattr(c, f"{p}_{AXES[0]}")]


def nominal(c: Any, m: Machine, name: str) -> Nominal:
    """What a parameter says."""
    return read(getattr(c, name), m.variables, m.variable_unit)


def nominals(c: Any, m: Machine) -> list[list[Nominal]]:
    """Of each place its three coordinates."""
    return [[nominal(c, m, name) for name in axes] for axes in names(c)]


def faults(c: Any, m: Machine, *others: str) -> Iterator[ParameterFault]:
    """Texts that say nothing, points that are half known, questions that nobody answers; `others` are further texts."""
    for name in (*others, *(name for axes in names(c) for name in axes)):
        try:
            nominal(c, m, name)
        except ValueError as fault:
            yield name, str(fault)
            return
    for k, (axes, known) in enumerate(zip(names(c), nominals(c, m), strict=True)):
        given = [each.actual is not None for each in known]
        if any(given) and not all(given):
            yield axes[given.index(False)], "needs an actual value (@) as the others of the point: it has all three, or none"
        if any(each.asked for each in known) and by_hand(m, k) is None:
            asked = next(name for name, each in zip(axes, known, strict=True) if each.asked)
            yield asked, f"asks for a position (?): the setting manual_points says it, {{{k + 1}: (x, y, z)}}"


def by_hand(m: Machine, k: int) -> Floats | None:
    """Where the operator puts the probe for place number k."""
    points: Mapping[Any, Any] = m.settings["manual_points"]
    try:
        found = np.array(points.get(k + 1, points.get(str(k + 1))), dtype=np.float64)
    except (TypeError, ValueError):
        return None
    return found if found.shape == (3,) and np.isfinite(found).all() else None


def measure(c: Any, m: Machine, apart: float, find: Callable[..., Finding]) -> Generator[Step, Any, list[FoundPlace]]:
    """Find each place (`touch`, or what has its parameters), except those whose actual values are given; between them it goes
    to the clearance height from the mode `apart` on."""
    a, mode = c.approach(m, over=c.clearance_height_mode == 2), c.clearance_height_mode
    found, known = [], nominals(c, m)
    first, moved = True, [k for k, each in enumerate(known) if each[0].actual is None]
    for k, each in enumerate(known):
        if k not in moved:
            found.append(FoundPlace(np.array([one.actual for one in each], dtype=np.float64)))
            continue
        asked = any(one.asked for one in each)
        where = by_hand(m, k) if asked else np.array([one.value for one in each], dtype=np.float64)
        assert where is not None
        if asked:
            yield Pause("until the operator has put the probe there")
        rises = asked or mode >= (0 if first else apart)
        found.append((yield from find(c, m, a, k, where, m.programmed[2] if rises else math.inf)))
        first = False
        if not asked and mode >= (0 if k == moved[-1] else apart):
            yield a.go("to the clearance height", a.height)
    return found


def touch(c: Any, m: Machine, a: Approach, k: int, where: Floats, rise: float) -> Finding:
    """Place number k, from 0, by one touch along Q372; a place that the operator chose is where it begins. `rise` is the height
    of the probe now, or infinite where it goes there as it is."""
    way = along(c.probing_direction)
    x, y, z = (where if any(each.asked for each in nominals(c, m)[k]) else where - a.away * way).tolist()
    if a.track and way[2] == 0:
        yield Orient("turn the probe", math.degrees(math.atan2(way[1], way[0])) % 360)
    yield from arrive(a, k, x, y, z - a.ball, rise)
    to_x, to_y, to_z = (np.array([x, y, z - a.ball]) + a.reach * way).tolist()
    contact = yield Touch(f"touch {k + 1}", to_x, to_y, to_z, a.feed, a.ball)
    yield a.go("back", z - a.ball, x, y)
    return FoundPlace(np.array(contact.point) + a.ball * way, contacts=(contact,))


def along(number: float) -> Floats:
    """The unit vector of Q372: 1 is +X, -3 is -Z."""
    way = np.zeros(3)
    way[int(abs(number)) - 1] = math.copysign(1.0, number)
    return way


def arrive(a: Approach, k: int, x: float, y: float, z: float, rise: float) -> Iterator[Go]:
    """To a first start over the clearance height, or as it stands (`rise` infinite); to a further one straight."""
    if k and math.isinf(rise):
        yield a.go("to the next starting point", z, x, y)
    else:
        yield from over_to(a, x, y, rise, z)


# --- results --------------------------------------------------------------------------------------------------------------


def means(known: Sequence[Sequence[Nominal]], found: Sequence[FoundPlace]) -> Floats:
    """The middles of the tolerances (n, 3); what has no nominal value is where it was found."""
    return np.array([[at if each.mean is None else each.mean for each, at in zip(axes, one.point, strict=True)]
                     for axes, one in zip(known, found, strict=True)])  # fmt: skip


def judge(what: str, actual: float, limits: Nominal, contacts: Sequence[Contact], below: str, above: str) -> Judged:
    """A value beside its limits, and what it means if it lies below or above."""
    verdict = OK if limits.limited else ""
    if limits.limited and not limits.lower - SLACK <= actual <= limits.upper + SLACK:
        verdict = below if actual < limits.lower else above
    return Judged(what, float(actual), limits, verdict, contacts)


def judge_places(c: Any, m: Machine, found: Sequence[FoundPlace]) -> list[Judged]:
    """The coordinates of the places. Where it was touched along an axis, material that is left is rework; anything else is
    scrap, and what a touch across it did not measure is not judged."""
    way = along(c.probing_direction) if hasattr(c, "probing_direction") else np.zeros(3)
    judged = []
    for k, (known, one) in enumerate(zip(nominals(c, m), found, strict=True)):
        for axis, limits, actual, sense in zip("XYZ", known, one.point, way, strict=True):
            if one.contacts and not sense and (way.any() or axis == "Z"):
                limits = limits._replace(lower=limits.mean or 0.0, upper=limits.mean or 0.0)
            below, above = (REWORK, SCRAP) if sense > 0 else (SCRAP, REWORK) if sense < 0 else (SCRAP, SCRAP)
            judged.append(judge(f"point {k + 1} {axis}", actual, limits, one.contacts, below, above))
    return judged


def report(
    c: Any, m: Machine, found: Sequence[FoundPlace], nominal: Floats, judged: Sequence[Judged], angles: Mapping[int, float],
    lengths: Mapping[int, float],
) -> Iterator[Step]:  # fmt: skip
    """The places and their deviations, further angles and lengths by the numbers of their Q parameters, the status, the record,
    its file; then the reaction to a violated tolerance."""
    points = np.array([one.point for one in found])
    measured, errors = enumerate(points.ravel(), 950), enumerate((points - nominal).ravel(), 980)
    for number, value in (*measured, *errors, *lengths.items()):
        yield Write("variable", float(value) / m.variable_unit, f"Q{number}")
    for number, value in angles.items():
        yield Write("variable", float(value), f"Q{number}")
    status = max((STATUS[each.verdict] for each in judged if each.verdict), default=-1)
    yield Write("variable", float(status), "Q183")
    rows = []
    for what, actual, limits, verdict, contacts in judged:
        middle = actual if limits.mean is None else limits.mean
        edges = (limits.lower, limits.upper) if limits.limited else (math.nan, math.nan)
        yield Measure(what, actual, middle, *edges, verdict=verdict, touches=numbers(contacts))
        rows.append((what, *(f"{v:.4f}" for v in (middle, actual, actual - middle)), verdict))
    yield Write("file", html_table(("", "nominal", "actual", "deviation", "status"), rows), LOG)
    if c.error_reaction and status >= c.error_reaction:
        worst = next(each for each in judged if each.verdict and STATUS[each.verdict] == status)
        allowed = f"{worst.nominal.lower:.4f} to {worst.nominal.upper:.4f}"
        said = f"{c.code}: {worst.verdict}: {worst.what} is {worst.actual:.4f}, allowed {allowed}"
        m.alarm(in_mm(said, m.variable_unit, length=True))


# What the cycles 14xx make of a measured place and rotation: the active preset changes, rotary axes turn (TNC 620, 14.2).
# A measured point has its nominal coordinates in the new system. In a tilted plane, and for a plane that is not level,
# the basic
# rotation is one in space (SPA, SPB, SPC).

BASIC, TABLE = 1, 2  # Q1121
LEVEL = 1e-12  # of a turn that has no part about X and Y


def contradictions(c: Any) -> Iterator[ParameterFault]:
    """Of the cycles with one angle: rotary axes are aligned where the rotary table takes the rotation over."""
    if c.align_rotary_axis and c.confirm_rotation != TABLE:
        yield "align_rotary_axis", "aligns the rotary axis: then Q1121 must be 2, and no basic rotation takes the angle over"


def turn_faults(c: Any, m: Machine) -> Iterator[ParameterFault]:
    if c.confirm_rotation == TABLE:
        yield from cannot_turn(m, C, "confirm_rotation")


def angle(first: Floats, second: Floats) -> float:
    """The direction from a point to another in the plane, degrees."""
    return fits.angle(first[:2].tolist(), second[:2].tolist())


def chosen(c: Any, points: Sequence[Floats]) -> Floats | None:
    """The point that Q1120 names, their mean behind the last; None: no position is taken over."""
    k = int(c.transfer_position)
    return None if k == 0 else np.mean(points, axis=0) if k > len(points) else np.asarray(points[k - 1])


def take_over(c: Any, m: Machine, found: Sequence[FoundPlace], nominal: Floats, turned: Floats, by: float) -> Iterator[Step]:
    """Change the active preset: `nominal` (n, 3) are the middles of the tolerances, `turned` (3, 3) is the measured rotation,
    `by` its angle in the plane, degrees, nan in space."""
    here, should = chosen(c, [one.point for one in found]), chosen(c, list(nominal))
    before, axes = m.tables.presets.get(active_preset(m), Datum()), m.frames["preset"][:3, :3]
    inner = frames.inverse(m.frames.before("preset") @ m.frames["preset"]) @ m.frames.matrix  # what acts behind the preset
    new, origin, columns = axes, np.array(before[:3]), {}
    if c.confirm_rotation == BASIC:
        tilt = inner[:3, :3]
        change = tilt @ turned @ tilt.T
        new = axes @ change
        level = not (math.isnan(by) or before.tilt_x or before.tilt_y) and np.abs(change[2, :2]).max() < LEVEL
        space = dict(zip(("tilt_x", "tilt_y", "rotation"), spatial_angles(new), strict=True))
        columns = {"rotation": before.rotation + by} if level else space
    elif c.confirm_rotation == TABLE:
        columns = {"c": before.c + by}
    if here is not None and should is not None:
        is_, gets = origin + axes @ frames.apply(inner, here), new @ frames.apply(inner, should)
        if c.confirm_rotation == TABLE:
            known = m.tables.kinematics
            centre = known.axis("C").centre if known else (m.settings["table_x"], m.settings["table_y"], 0.0)
            is_ = frames.apply(frames.turn(-math.radians(by), about=centre), is_)
        columns |= dict(zip("xyz", (is_ - gets).tolist(), strict=True))
    if columns:
        yield from store(m, active_preset(m), **columns)
    if c.align_rotary_axis and c.confirm_rotation == TABLE:
        yield from align(m, C, by)
    elif c.align_rotary_axis:
        yield from position(m, axis_positions(m, c.code), RAPID, 0.0)
