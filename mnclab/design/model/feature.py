"""What all features of a drawing share, and those of a milled part."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields, replace
from typing import ClassVar, NamedTuple, Self

from mnclab.design.model.measures import Measure, Tolerance, tolerances_of, with_tolerances
from mnclab.design.model.removals import Flat, Removal
from mnclab.design.model.shapes import LARGEST, Shape, check_place, shape_of
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, faults_as_alarms, fitting_class, plain, shown
from mnclab.text.tables import exactly

SMALLEST = 1e-6  # mm, of a size
BESIDE = 1e-3  # mm, beside an edge, where material is looked for


class Site(NamedTuple):
    """Where a feature stands: the blank from above, all about it, and the heights of its sides, mm.

    `flats` are what the other features take away, of which a chamfer is told on which side of its edge the material is.
    """

    outline: Region
    around: Region
    top: float
    bottom: float
    flats: tuple[Flat, ...] = ()


@dataclass(frozen=True, repr=False, kw_only=True)
class Named(ABC):
    """What every feature of a drawing has, milled or turned; `kind` is its name in files."""

    kind: ClassVar[str]

    name: str = ""
    tolerances: Mapping[str, Tolerance] = field(default_factory=dict, hash=False)

    def __init_subclass__(cls) -> None:
        fitting_class(cls)

    def __post_init__(self) -> None:
        if not isinstance(self.name, str):
            raise Alarm(f"the name of a {self.kind} must be a text, got {shown(self.name)}")
        object.__setattr__(self, "tolerances", tolerances_of(self.tolerances, f"a {self.kind}", EXAMPLE))
        for each in fields(self):
            object.__setattr__(self, each.name, plain(getattr(self, each.name)))
        self._check()
        self.measures()

    def __repr__(self) -> str:
        return exactly(self)

    @abstractmethod
    def _check(self) -> None:
        """Raises an Alarm for sizes that cannot be."""

    @abstractmethod
    def _measures(self) -> Iterator[Measure]: ...

    def measures(self) -> tuple[Measure, ...]:
        """What a drawing says of it and a measuring room measures, with its tolerances."""
        return with_tolerances(list(self._measures()), self.tolerances, self.name or f"a {self.kind}")


@dataclass(frozen=True, repr=False, kw_only=True)
class Feature(Named):
    """What all features of a milled part share."""

    recess: ClassVar[bool] = False  # whether a section through it shows more than the view from above

    top: float | None = None

    def __post_init__(self) -> None:
        if self.top is not None:
            check_place(self.top, f"the top of a {self.kind} (mm)")
        super().__post_init__()

    @abstractmethod
    def removals(self, site: Site) -> Iterator[Removal]:
        """What it takes away."""

    def moved(self, dx: float, dy: float, dz: float) -> Self:
        """The same elsewhere, by mm: its places and its `top`; what counts from the top of the blank still does."""
        by = {"x": dx, "y": dy, "top": dz}
        given = {each.name: getattr(self, each.name) for each in fields(self)}
        there = {name: given[name] + way for name, way in by.items() if given.get(name) is not None}
        for name in ("start", "end"):
            if name in given:
                there[name] = given[name][0] + dx, given[name][1] + dy
        if "contour" in given:
            there["contour"] = given["contour"].moved(dx, dy)
        if "islands" in given:
            there["islands"] = tuple(each.moved(dx, dy) for each in given["islands"])
        return replace(self, **there)

    def measures(self) -> tuple[Measure, ...]:
        found = list(self._measures())
        if self.top is not None:
            found.append(Measure("top", self.top, "place"))
        return with_tolerances(found, self.tolerances, self.name or f"a {self.kind}")

    @property
    def region(self) -> Region:
        """What a mill has to clear, from above, islands left out; an Alarm for all but pockets, slots and grooves."""
        raise Alarm(f"a {self.kind} is no area to clear", hint="a pocket, a slot and a groove have one: Region.of(pocket)")

    @property
    def shape(self) -> Shape | None:
        """The shape that is dimensioned in its view; None if it has none."""
        return getattr(self, "contour", None)

    @property
    def outline(self) -> Contour | None:
        """What it takes up in its view, a groove the middle of it; None for the whole top."""
        return None if self.shape is None else self.shape.contour

    def from_top(self, site: Site) -> float:
        """The height that its depths count from."""
        return site.top if self.top is None else self.top


EXAMPLE = 'tolerances={"depth": 0.1}'


def check_positive(feature: Named, *names: str) -> None:
    """An Alarm unless sizes of a feature are greater than 0."""
    for name in names:
        size, what = getattr(feature, name), f"the {name} of a {feature.kind} (mm)"
        check_number(size, what, above=0, at_most=LARGEST)
        check_number(size, what, at_least=SMALLEST)


def check_flag(feature: Named, name: str) -> None:
    """An Alarm unless something of a feature is True or False."""
    if not isinstance(getattr(feature, name), bool):
        raise Alarm(f"{name} of a {feature.kind} must be True or False, got {shown(getattr(feature, name))}")


def take_shape(feature: Feature, closed: bool | None = True, name: str = "contour") -> None:
    """Puts a shape in the place of whatever was given for it."""
    found = shape_of(getattr(feature, name), f"the {name} of a {feature.kind}", closed)
    object.__setattr__(feature, name, found)


def area_of(shape: Shape, what: str) -> Region:
    """What lies within a closed shape."""
    try:
        with faults_as_alarms():
            return Region.of(shape.contour)
    except Alarm as fault:
        raise Alarm(f"{what}: {fault.message}") from None
