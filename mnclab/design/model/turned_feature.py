"""What all features of a turned part share: sizes of its drawing, and what each takes away of the half section.

Places z are those of the toolpath, mm, the front end is where z is highest: what has a length goes from its `z` or its
`start` backwards. Sizes across the axis are diameters. `from_end` ("front", "back") is the end that a hole is made from. All
features take `name` (what drawing and tables call it) and `tolerances`: the name of a measure and ± mm, two deviations or a
class of ISO 286, `{"diameter": "H7"}`.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import Self

from mnclab.design.model.corners import joined, pieces
from mnclab.design.model.feature import Named
from mnclab.design.model.shapes import LARGEST
from mnclab.design.model.turned_body import TurnedBody
from mnclab.design.model.turned_profile import Dimension
from mnclab.geometry.contours import Contour
from mnclab.text.given import check_number, choice

ENDS = ("front", "back")
Point = tuple[float, float]
Place = tuple[Point, Point, Point | None]  # from where to where, (z, r), and the centre of a radius


@dataclass(frozen=True, repr=False, kw_only=True)
class TurnedFeature(Named):
    """What all features of a turned part have."""

    def __post_init__(self) -> None:
        super().__post_init__()
        for each in fields(self):
            if isinstance(value := getattr(self, each.name), int | float):
                check_number(value + 0.0, f"the {each.name} of a {self.kind}", at_least=-LARGEST, at_most=LARGEST)

    @abstractmethod
    def places(self, body: TurnedBody) -> dict[str, Place]:
        """Where its measures are on the body that it is cut into."""

    def dimensions(self, body: TurnedBody) -> tuple[Dimension, ...]:
        """What a drawing says of it, and where, on the body that it is cut into."""
        places = self.places(body)
        return tuple(Dimension(each, *places[each.name]) for each in self.measures())

    @abstractmethod
    def cut(self, body: TurnedBody) -> Contour | None:
        """What it takes away of a body, closed, (z, r), reaching out of it; None for nothing."""

    @abstractmethod
    def turned_over(self, middle: float) -> Self:
        """The same on the part turned end for end: z becomes `middle` less z."""

    @abstractmethod
    def moved(self, dz: float) -> Self:
        """The same farther along the axis."""


def _back(point: Point) -> Point:
    return -point[0], point[1]


def given(feature: TurnedFeature, *names: str) -> list[str]:
    """Those of some sizes that are not None."""
    return [name for name in names if getattr(feature, name) is not None]


def outline(points: Sequence[tuple[float, float]], roundings: Mapping[int, float], what: str) -> Contour:
    """A closed contour of points (z, r), some corners rounded, counter-clockwise."""
    found = joined(pieces(Contour(points), roundings, {}, what))
    return found if found.area > 0 else found.reversed()


@dataclass(frozen=True, repr=False, kw_only=True)
class FromEnd(TurnedFeature):
    """A feature of one end: made as if from the front, then mirrored."""

    from_end: str = "front"

    def __post_init__(self) -> None:
        end = choice(self.from_end, f"the from_end of a {self.kind}", ENDS)
        object.__setattr__(self, "from_end", end)
        super().__post_init__()

    def cut(self, body: TurnedBody) -> Contour | None:
        if self.from_end == "front":
            return self._from_front(body)
        found = self._from_front(body.mirrored())
        return None if found is None else Contour(found.points * (-1, 1), -found.bulge).reversed()

    def places(self, body: TurnedBody) -> dict[str, Place]:
        if self.from_end == "front":
            return self._places(body)
        found = self._places(body.mirrored())
        return {name: (_back(a), _back(b), c and _back(c)) for name, (a, b, c) in found.items()}

    @abstractmethod
    def _from_front(self, body: TurnedBody) -> Contour: ...

    @abstractmethod
    def _places(self, body: TurnedBody) -> dict[str, Place]: ...

    def turned_over(self, middle: float) -> Self:
        return replace(self, from_end=ENDS[self.from_end == "front"])

    def moved(self, dz: float) -> Self:
        return self
