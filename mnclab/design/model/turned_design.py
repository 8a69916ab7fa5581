"""A turned part as a drawing has it: a profile and features about one axis; its exact half section, and that as a workpiece."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from mnclab.design.model.design import AsDrawn, Taking, name_of
from mnclab.design.model.measures import HEAD, Measure, Tolerance, rows, tolerances_of, with_tolerances
from mnclab.design.model.shapes import Outline
from mnclab.design.model.turned_feature import SAME, TurnedBody, TurnedFeature
from mnclab.design.model.turned_features import TURNED_FEATURES
from mnclab.design.model.turned_profile import Dimension, Profile
from mnclab.design.model.turned_threads import Thread
from mnclab.geometry.contours import Contour
from mnclab.path.toolpath import Array
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_point, faults_as_alarms, fitting_class, plain, shown
from mnclab.text.tables import exactly, html_table
from mnclab.workpiece.blank import Revolved, blank
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.part import Part
from mnclab.workpiece.turning import revolved
from mnclab.workpiece.turning.revolved import TurnedBlank
from mnclab.workpiece.turning.turned import Turned

if TYPE_CHECKING:
    from mnclab.workpiece.workpiece import Workpiece

TURNED = Taking("turned design", TurnedFeature, TURNED_FEATURES, "one that turns", "Bore(12, 30)")
EXAMPLE = "TurnedDesign([(0, 10), (-30, 10), (-30, 20), (-50, 20)])"


@fitting_class
@dataclass(frozen=True, repr=False)
class TurnedDesign(AsDrawn):
    """A turned part as drawn, in the frame of the toolpath, mm.

    `profile`: points (z, r) of the outside from one end to the other, r a radius, closed to the axis at both; or a
    `Contour`, whose arcs are arcs: open, or closed for the whole half section. `roundings` and `chamfers` break its corners by
    their number: a radius; a width at 45°, or (width along the axis, angle from it). `features` are those of
    `mnclab.design` that turn, in the order in which they are made. `blank`: a cylinder that it is turned from.
    `tolerances` are of the measures of the profile ("diameter 1", counted from the front; see `measures`).

    >>> pin = mnc.TurnedDesign([(0, 10), (-30, 10)])
    >>> print(f"{pin.volume:.1f}")  # pi x 10 x 10 x 30
    9424.8
    """

    profile: Any
    features: Sequence[TurnedFeature] = ()
    blank: Any = field(default=None, kw_only=True)
    roundings: Mapping[int, float] = field(default_factory=dict, kw_only=True, hash=False)
    chamfers: Mapping[int, Any] = field(default_factory=dict, kw_only=True, hash=False)
    tolerances: Mapping[str, Tolerance] = field(default_factory=dict, kw_only=True, hash=False)
    title: str = field(default="", kw_only=True)
    number: str = field(default="", kw_only=True)
    material: str = field(default="", kw_only=True)
    general: str = field(default="ISO 2768-m", kw_only=True)
    author: str = field(default="", kw_only=True)
    date: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        self.check_texts()
        tolerances = tolerances_of(self.tolerances, "a design", 'tolerances={"diameter 1": "h6"}')
        object.__setattr__(self, "tolerances", tolerances)
        object.__setattr__(self, "profile", _profile(self.profile))
        outline = self.outline_as_drawn
        object.__setattr__(self, "roundings", outline.roundings)
        object.__setattr__(self, "chamfers", outline.chamfers)
        object.__setattr__(self, "features", TURNED.features(self.features, "features"))
        object.__setattr__(self, "blank", _blank(self.blank))
        self.measures()
        self.bodies  # noqa: B018  every feature must fit
        self._check_blank()

    def __repr__(self) -> str:
        return exactly(self)

    def _repr_html_(self) -> str:
        measured = (self.measures(), *(each.measures() for each in self.features))
        return html_table(HEAD, rows(zip(("profile", *self.drawn_names()), measured)), numbers=(2, 3))

    # --- its body ----------------------------------------------------------------------------------------------------

    @cached_property
    def outline_as_drawn(self) -> Profile:
        """The profile with its corners broken, and what is dimensioned of it."""
        return Profile(self.profile.contour, self.roundings, self.chamfers)

    @cached_property
    def bodies(self) -> tuple[TurnedBody, ...]:
        """The half section after the profile and after each feature."""
        found = [TurnedBody(self.outline_as_drawn.section)]
        for k, each in enumerate(self.features):
            try:
                with faults_as_alarms():
                    cut = each.cut(found[-1])
                    found.append(found[-1] if cut is None else found[-1].without(cut))
            except Alarm as fault:
                raise Alarm(f"{name_of(self.features, k)} (features[{k}]): {fault.message}", hint=fault.hint) from None
        return tuple(found)

    @property
    def section(self) -> list[Contour]:
        """The half section, closed contours (z, r): outer ones counter-clockwise, holes clockwise; exact, arcs are arcs."""
        return list(self.bodies[-1].section.loops)

    @property
    def axis_x(self) -> float:
        """Where the axis stands in x, mm: at 0."""
        return 0.0

    @property
    def bounds(self) -> Array:
        """The corners with the least and the greatest coordinates (2, 3)."""
        return self.as_blank().bounds

    @property
    def volume(self) -> float:
        """mm³, in closed form: by Pappus, of lines and arcs."""
        return revolved.volume(self.section)

    @property
    def part(self) -> Part:
        """What a probe touches; exact."""
        return revolved.part(self.section, self.axis_x)

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """How low and how high it reaches at points (m,); nan beside it. What is undercut counts as full."""
        return self.as_blank().faces(x, y)

    def as_blank(self) -> TurnedBlank:
        """The finished part as a blank, for a Setup."""
        return TurnedBlank(tuple(self.section))

    def workpiece(self, step: float | None = None) -> Workpiece:
        """The finished part, as `run.workpiece()` would have it of a perfect program; a `step` changes nothing."""

        return DrawnTurned(self, step)

    def turned_over(self) -> TurnedDesign:
        """The same end for end, in the same stretch of z. Tolerances of lengths from what was the front end are lost."""
        outline = self.outline_as_drawn
        over, middle = outline.turned_over(), sum(outline.ends)
        names = {_place(each): each.measure.name for each in over.dimensions()}
        stays = {each.measure.name: names.get(_place(each, middle)) for each in outline.dimensions()}
        tolerances = {name: each for old, each in self.tolerances.items() if (name := stays[old])}
        return replace(
            self, profile=over.contour, blank=_turned_over(self.blank, middle), tolerances=tolerances,
            features=tuple(each.turned_over(middle) for each in self.features),
        )  # fmt: skip

    def moved(self, by: ArrayLike) -> TurnedDesign:
        """The same farther along the axis, (0, 0, dz) mm."""
        check_point(by, "how far a design is moved (mm)")
        dx, dy, dz = np.asarray(by, dtype=np.float64).tolist()
        if dx or dy:
            raise Alarm(f"a turned design stands about X 0, Y 0: it is moved along Z alone, got {shown(by)}")
        profile = Contour(self.profile.contour.points + (dz, 0.0), self.profile.contour.bulge, self.profile.closed)
        return replace(
            self, profile=profile, blank=None if self.blank is None else self.blank.moved((0, 0, dz)),
            features=tuple(each.moved(dz) for each in self.features),
        )  # fmt: skip

    # --- what a drawing says of it -----------------------------------------------------------------------------------

    def dimensions(self) -> tuple[Dimension, ...]:
        """What is dimensioned of the profile, with its tolerances, and where."""
        found = list(self.outline_as_drawn.dimensions())
        named = with_tolerances([each.measure for each in found], self.tolerances, "the profile")
        return tuple(each._replace(measure=measure) for each, measure in zip(found, named))

    def dimensions_of_features(self) -> tuple[tuple[Dimension, ...], ...]:
        """The same of each feature."""
        return tuple(each.dimensions(body) for each, body in zip(self.features, self.bodies))

    def measures(self) -> tuple[Measure, ...]:
        """Length, diameters, lengths from the front end, angles, radii and chamfers of the profile, with their tolerances."""
        return tuple(each.measure for each in self.dimensions())

    def drawn_names(self) -> tuple[str, ...]:
        """What drawing and tables call the features: their names, else their kinds, numbered."""
        return tuple(name_of(self.features, k) for k in range(len(self.features)))

    @property
    def threads(self) -> tuple[Thread, ...]:
        return tuple(each for each in self.features if isinstance(each, Thread))

    def _check_blank(self) -> None:
        if self.blank is None:
            return
        (low, radius, bore), body = _cylinder(self.blank), self.bodies[-1]
        for name, has, allowed, inside in (
            ("Z from", body.low, low[0], body.low >= low[0] - SAME),
            ("Z to", body.high, low[1], body.high <= low[1] + SAME),
            ("radius", body.radius, radius, body.radius <= radius + SAME),
            ("bore of radius", float(min(loop.points[:, 1].min() for loop in self.section)), bore,
             min(loop.points[:, 1].min() for loop in self.section) >= bore - SAME),
        ):  # fmt: skip
            if not inside:
                raise Alarm(f"the design does not lie within its blank, whose {name} is {allowed:g}: it has {has:g}")


def _place(dimension: Dimension, middle: float | None = None) -> tuple[Any, ...]:
    """What a dimension is of, to tell it again; that of its mirror image where z becomes `middle` less z."""
    ends = (dimension.start, dimension.end)
    return dimension.measure.kind, *sorted((round(z if middle is None else middle - z, 6), round(r, 6)) for z, r in ends)


def _cylinder(given: Revolved) -> tuple[tuple[float, float], float, float]:
    """From where to where in z a cylinder goes, its radius and its bore."""
    (radius, low), (_, high) = given.profile
    return (low + given.at[2], high + given.at[2]), radius, given.bore


def _turned_over(given: Revolved | None, middle: float) -> Revolved | None:
    if given is None:
        return None
    (low, high), radius, _ = _cylinder(given)
    return given._replace(profile=((radius, middle - high), (radius, middle - low)), at=(0.0, 0.0, 0.0))


def _profile(given: Any) -> Outline:
    if isinstance(given, Outline):
        return given
    if isinstance(given, Contour):
        contour = given
    else:
        try:
            points = np.array(given, dtype=np.float64)
        except (TypeError, ValueError, OverflowError):
            points = np.zeros(0)
        if points.ndim != 2 or points.shape[1] != 2:
            raise Alarm(f"the profile of a turned design must be points (z, r) or a contour, got {shown(given)}", hint=EXAMPLE)
        with faults_as_alarms():
            contour = Contour(points, closed=False)
    bulge = tuple(contour.bulge.tolist()) if contour.bulge.any() else ()
    return Outline(plain(contour.points.tolist()), bulge, contour.closed)


def _blank(given: Any) -> Revolved | None:
    """The blank, a cylinder about Z."""
    if given is None:
        return None
    found = blank(given)
    straight = isinstance(found, Revolved) and len(found.profile) == 2 and found.profile[0][0] == found.profile[1][0]
    if not isinstance(found, Revolved) or not straight or found.axis != "Z" or found.at[:2] != (0.0, 0.0):
        raise Alarm(f"the blank of a turned design must be a cylinder about Z, got {shown(given)}",
                    hint="mnclab.blank.cylinder(25, -60, 0)")  # fmt: skip
    return found


class DrawnTurned(Turned):
    """A `Turned` part that nothing cut: its section is that of the design."""

    def __init__(self, design: TurnedDesign, step: float | None = None) -> None:
        super().__init__(Cutting.of_nothing(design.as_blank(), lathe=True), step)
        self.design = design
        self.method, self.error = "as drawn", 0.0

    @property
    def removed(self) -> float:
        """What a program has to take away from the blank of the design, mm³; 0 where it has none."""
        return 0.0 if self.design.blank is None else self.design.blank.volume - self.volume

    def removed_by_row(self) -> Array:
        return np.zeros(0)
