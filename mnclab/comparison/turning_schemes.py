"""Roughing schemes of turning on one profile, side by side: strokes, way, time, what is cut and what is left.

Coordinates (z, r) and areas of the half section above the axis, mm and mm²; feeds mm/rev, rapids mm/min, times s.

    material = between profile and blank       rest        = what the tool covers on its way along the profile, and no stroke
    removed  = material under the strokes      unreachable = what is left of the material besides

The source ranks: loop, then semi-finish, then pick-up, whose idle strokes are longer. On the three zones of the
catalogue (10 mm deep, a = 4, 0.3 mm/rev, 800 rev/min, plunges at half, rapids 10 m/min; tool of 95 and 50 degrees) ::

                                   open              semi-open          closed
                                   cut  rapid  s     cut  rapid  s      cut  rapid  s
    loop                           156  177  40.1    134  155  34.4      90   69  26.5
    semi-finish after penultimate  156  178  40.1    148  155  38.0     104   58  30.0
    pick-up                        156  177  40.1    148  170  38.1     104   93  30.2
    semi-finish (after last)       208  230  53.4    190  198  48.7     104   58  30.0

The source has the clean-up "after the last or the penultimate" pass. The ranking holds, by the idle strokes as it says,
where the clean-up takes the place of the last pass. After the last pass it cuts the whole contour once more, and costs
more than all idle strokes at rapid save. So both stand in the table, but for the closed zone, where they are one. In an
open zone there is nothing to pick up, and all others are alike.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, reduce
from typing import TYPE_CHECKING, Any, ClassVar, Unpack

import numpy as np

from mnclab.comparison.tables import Table, Titles, Tried
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import CHORD_ERROR, broad, outlined, swept, under
from mnclab.machining.turning.passes import FRONT, LIFT
from mnclab.machining.turning.profiles import CLOSED, COMBINED, OPEN, SEMI_OPEN, checked, reachable, zone_of
from mnclab.machining.turning.schemes import SCHEMES
from mnclab.machining.turning.strokes import PLUNGE, RAPID, ROLES, Plan
from mnclab.path.inserts import edges_of
from mnclab.path.limits import Limits
from mnclab.path.machines import limits_of
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Kind, Toolpath
from mnclab.text.alarm import Alarm
from mnclab.text.given import ColumnsOptions, check_number, choice, faults_as_alarms, fitting, plain, shown
from mnclab.text.tables import Pictured

if TYPE_CHECKING:
    from mnclab.show.plot.picture import Picture

Schemes = Iterable[str] | Mapping[str, "str | Plan | Callable[[Contour, float, float, Tool], Plan]"]

#: Every column of a comparison: what it is, how it is written, and its value.
COLUMNS: Titles = {
    "scheme": ("scheme", "{}", lambda trial: trial.name),
    "passes": ("passes", "{}", lambda trial: trial.plan.passes),
    "length": ("cutting length, mm", "{:.1f}", lambda trial: trial.length(rapid=False)),
    "rapid": ("rapid length, mm", "{:.1f}", lambda trial: trial.length(rapid=True)),
    "time": ("time, s", "{:.1f}", lambda trial: trial.time),
    "removed": ("removed, mm²", "{:.2f}", lambda trial: trial.removed),
    "rest": ("rest, mm²", "{:.2f}", lambda trial: trial.rest.area),
    "ridge": ("highest ridge, mm", "{:.2f}", lambda trial: trial.ridge),
    "unreachable": ("unreachable, mm²", "{:.2f}", lambda trial: trial.unreachable.area),
}
#: Which schemes the source names for a zone.
SUITED = {
    OPEN: ("loop", "zigzag", "pick-up", "semi-finish", "semi-finish after penultimate"),
    SEMI_OPEN: ("loop", "zigzag", "pick-up", "semi-finish", "semi-finish after penultimate", "equidistant", "contour"),
    CLOSED: ("descent", "zigzag", "pick-up", "semi-finish"),
    COMBINED: ("combined",),
}
LEAST = 1e-6  # mm²
TURNER = Tool(number=1, kind="turning", main_angle=95.0, auxiliary_angle=30.0)


@dataclass(frozen=True, eq=False, repr=False)
class TurningTrial(Pictured, Tried):
    """One scheme on one profile: its plan, the whole path, and what comes of it."""

    titles: ClassVar = COLUMNS
    plan: Plan
    profile: Contour
    blank: float
    tools: tuple[Tool, ...]

    @cached_property
    def reached(self) -> Contour:
        """The lowest way of the first tool's tip over the profile."""
        return reachable(self.profile, self.tools[0])

    @cached_property
    def _outlines(self) -> list[Floats]:
        bottom = min(float(self.profile.points[:, 1].min()), *(s.r for s in self.plan.strokes))
        return [edges_of(tool, self.blank - bottom + 10.0) for tool in self.tools]

    @cached_property
    def _cover(self) -> list[tuple[bool, Any]]:
        """Of every stroke, whether it is a rapid, and what the tool covers on it."""
        return [(s.role == RAPID, swept(self._outlines[s.tool - 1], way)) for s, way in self.plan.ways]

    @cached_property
    def _areas(self) -> tuple[Any, Any, Any]:
        """Material, what of it the tool can reach, and what of it the strokes cover, as shapely areas."""
        material = under(self.profile, self.blank).intersection(self._box(0.0, self.blank))
        reach = material.intersection(swept(self._outlines[0], self.reached))
        cut = reduce(lambda one, other: one.union(other), (cover for rapid, cover in self._cover if not rapid))
        return material, reach if len(self.tools) == 1 else material, cut

    def _box(self, low: float, high: float) -> Any:
        z = self.profile.points[[0, -1], 0]
        return under(Contour([(z[0], low), (z[1], low)], closed=False), high)

    @cached_property
    def removed(self) -> float:
        """The area of material that the strokes take, mm²."""
        material, _, cut = self._areas
        return float(material.intersection(cut).area)

    @cached_property
    def rest(self) -> Region:
        """What the tool could have cut and has left standing."""
        _, reach, cut = self._areas
        return outlined(broad(reach.difference(cut), 2 * CHORD_ERROR))

    @cached_property
    def unreachable(self) -> Region:
        """What the edges of the tool leave behind corners and above open ends, where no stroke has cut it."""
        material, reach, cut = self._areas
        if material.area - reach.area <= LEAST:
            return Region(())
        return outlined(broad(material.difference(reach).difference(cut), 2 * CHORD_ERROR))

    @cached_property
    def ridge(self) -> float:
        """How far the rest stands above the profile at most, mm: 0 is a uniform allowance."""
        corners = [loop.points for loop in self.rest.loops]
        return float(self.reached.distance(np.vstack(corners)).max()) if corners else 0.0

    @cached_property
    def gouged(self) -> float:
        """The area below the profile that the strokes cut, with the tip or a flank, mm²: 0 unless something is wrong."""
        part = self._box(-1.0, self.blank).difference(under(self.profile, self.blank + 1.0))
        return float(broad(part.intersection(self._areas[2]), 2 * CHORD_ERROR).area)

    @cached_property
    def struck(self) -> float:
        """The area of material that rapids run through before it has gone, mm²: 0 unless something is wrong."""
        left, struck = self._box(0.0, self.blank), 0.0
        for rapid, cover in self._cover:
            if rapid:
                struck += float(broad(left.intersection(cover), 2 * CHORD_ERROR).area)
            else:
                left = left.difference(cover)
        return struck

    @fitting
    def plot(self, **options: Unpack[ColumnsOptions]) -> Picture:
        """The picture of a comparison, of this trial alone."""
        return TurningComparison((self,)).plot(**options)


@dataclass(frozen=True, eq=False, repr=False)
class TurningComparison(Table[TurningTrial]):
    """Trials of several schemes on one profile; a table when shown."""

    titles: ClassVar = COLUMNS
    trials: tuple[TurningTrial, ...]

    @fitting
    def plot(self, **options: Unpack[ColumnsOptions]) -> Picture:
        """The strokes side by side, rapids dashed, what is left hatched (needs matplotlib)."""
        from mnclab.show.plot.turning_schemes import plot_schemes

        return plot_schemes(self, **options)


@fitting
@faults_as_alarms()
def compare(
    profile: Contour, blank: float, tool: Tool | tuple[Tool, ...] = TURNER, schemes: Schemes | None = None, *, depth: float = 2.0,
    step: float | None = None, feed: float = 0.3, feeds: Mapping[str, float] | None = None, spindle: float = 800.0,
    surface: float | None = None, rapid: float = 10_000.0, lift: float = LIFT, front: float = FRONT,
    limits: Limits | str | None = None, machine: Limits | str | None = None,
) -> TurningComparison:  # fmt: skip
    """Try roughing schemes on a profile (z, r) under a blank of a radius and put what comes of it side by side.

    `schemes` are names of `SCHEMES` (by default those `SUITED` to the zone), or a mapping from names to a
    scheme, a `Plan`, or a function of profile, blank, depth and tool; a plan for two tools needs both. `depth` of a pass
    and `step` of the descent (by default the width of the tool, or the depth) in mm; `feed` in mm/rev, `feeds` by
    role; `spindle` in rev/min: with a cutting speed `surface` in m/min it is the greatest speed. With axis `limits`
    (or those of a `machine` by its name) the time comes from the feed-rate profile.

    >>> shoulder = mnc.area.Contour([(0, 10), (-30, 10), (-30, 20)], closed=False)
    >>> [trial.name for trial in mnc.compare_turning(shoulder, 20, schemes=["loop", "zigzag"], depth=5)]
    ['loop', 'zigzag']
    """
    limits = limits_of(limits, machine)
    tools = tool if isinstance(tool, tuple) else (tool,)
    if not isinstance(profile, Contour):
        example = "mnclab.area.Contour([(0, 20), (-40, 20), (-50, 30)], closed=False): points (z, r) from the face on"
        raise Alarm(f"schemes are compared on a Contour, got {shown(profile)}", hint=example)
    if not all(isinstance(each, Tool) for each in tools):
        raise Alarm(f"the tool must be a Tool, got {shown(tool)}", hint='mnclab.Tool(kind="turning", main_angle=95)')
    check_number(blank, "the radius of the blank (mm)", above=0)
    contour = checked(profile)
    _check_numbers(depth, step, surface, lift, front)
    check_number(feed, "the feed (mm/rev)", above=0)
    if not isinstance(feeds, Mapping | None):
        raise Alarm(f"feeds must be a dict of roles and feeds, got {shown(feeds)}", hint=f"roles: {', '.join(ROLES)}")
    blank, depth, step, feed, spindle, surface, rapid, lift, front = plain(
        [blank, depth, step, feed, spindle, surface, rapid, lift, front]
    )
    by_role = {role: feed for role in ROLES} | {PLUNGE: feed / 2} | dict(feeds or {})
    if unknown := set(by_role) - set(ROLES):
        raise Alarm(f"there is no role {shown(min(unknown, key=str))}; known: {', '.join(ROLES)}")
    rates = {"spindle speed": spindle, "rapid rate": rapid} | {f"feed of {k}": v for k, v in by_role.items()}
    for name, value in rates.items():
        check_number(value, f"the {name}", above=0)
    by_role = {role: plain(value) for role, value in by_role.items()}
    wanted = SUITED[zone_of(contour, blank)] if schemes is None else schemes
    if isinstance(wanted, str) or not isinstance(wanted, Iterable):
        example = f'["loop", "zigzag"], or a dict of names; known: {", ".join(SCHEMES)}'
        raise Alarm(f"schemes must be a list of names, got {shown(wanted)}", hint=example)
    values = wanted.values() if isinstance(wanted, Mapping) else wanted
    for how in (values := tuple(values)):
        if not isinstance(how, Plan) and not callable(how):
            choice(how, "a scheme", SCHEMES)
    named = dict(zip(wanted if isinstance(wanted, Mapping) else values, values, strict=True))
    trials = []
    for name, how in named.items():
        if isinstance(how, str):
            along = (tools[0].width or depth) if step is None else step
            plan = SCHEMES[how](contour, blank, along if how == "descent" else depth, tools[0], lift=lift, front=front)
        else:
            plan = how if isinstance(how, Plan) else how(contour, blank, depth, tools[0])
        path = toolpath(plan, by_role, spindle, surface, tools)
        trials.append(TurningTrial(name, path, limits, rapid, plan, contour, blank, tools))
    return TurningComparison(tuple(trials))


def _check_numbers(depth: float, step: float | None, surface: float | None, lift: float, front: float) -> None:
    check_number(depth, "the depth of a pass (mm)", above=0)
    if step is not None:
        check_number(step, "the step of the descent (mm)", above=0)
    if surface is not None:
        check_number(surface, "the cutting speed (surface, m/min)", above=0)
    check_number(lift, "the lift (mm)", at_least=0)
    check_number(front, "the way in front of the face (front, mm)", at_least=0)


def toolpath(
    plan: Plan, feeds: Mapping[str, float], spindle: float = 800.0, surface: float | None = None,
    tools: tuple[Tool, ...] = (TURNER,),
) -> Toolpath:  # fmt: skip
    """A plan as the path of a lathe: X the radius; feeds in mm/rev by role, speeds as in `compare`."""
    ends = np.array([(s.r, 0.0, s.z) for s in plan.strokes])
    vertices = np.vstack([(plan.start[1], 0.0, plan.start[0]), ends])
    rapid = np.array([s.role == RAPID for s in plan.strokes])
    bulge = np.array([s.bulge for s in plan.strokes])
    z, r = np.array([way.centres[0] for _, way in plan.ways]).T  # nan for lines
    middle = np.maximum((vertices[1:, 0] + vertices[:-1, 0]) / 2, 1e-6)
    speed = np.full(len(ends), spindle)
    if surface is not None:
        speed = np.minimum(spindle, 1000 * surface / (2 * np.pi * middle))
    per_rev = np.array([np.nan if s.role == RAPID else feeds[s.role] for s in plan.strokes])
    labels = [f"{s.role} {s.number}" if s.number else s.role for s in plan.strokes]
    known = list(dict.fromkeys(labels))
    numbers = [tool.number or k for k, tool in enumerate(tools, 1)]
    columns = {
        "kind": np.where(rapid, np.uint8(Kind.RAPID), np.where(bulge != 0, np.uint8(Kind.ARC), np.uint8(Kind.LINE))),
        "centre": np.column_stack([r, 0 * r, z]),
        "sweep": 4 * np.arctan(bulge),
        "axis": np.broadcast_to((0.0, 1.0, 0.0), (len(ends), 3)),
        "feed": np.where(rapid, np.inf, per_rev * speed),
        "per_rev": per_rev,
        "surface": np.full(len(ends), np.nan if surface is None else surface),
        "spindle": speed,
        "tool": np.array([numbers[min(s.tool, len(numbers)) - 1] for s in plan.strokes]),
        "label": np.array([known.index(label) for label in labels]),
        "synchronous": np.array([s.role == "thread" for s in plan.strokes]),
    }
    return Toolpath.chain(vertices, columns, labels=known, lathe=True)
