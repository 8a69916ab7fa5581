"""What all features of a turned part share: sizes of its drawing, what each takes away of the half section, and that section.

Places z are those of the toolpath, mm, the front end is where z is highest: what has a length goes from its `z` or its
`start` backwards. Sizes across the axis are diameters. `from_end` ("front", "back") is the end that a hole is made from. All
features take `name` (what drawing and tables call it) and `tolerances`: the name of a measure and ± mm, two deviations or a
class of ISO 286, `{"diameter": "H7"}`.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields, replace
from typing import NamedTuple, Self

import numpy as np

from mnclab.design.model.feature import Named
from mnclab.design.model.removals import flipped
from mnclab.design.model.shapes import LARGEST
from mnclab.design.model.turned_profile import Dimension, joined, pieces
from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, choice
from mnclab.workpiece.turning import revolved

ENDS = ("front", "back")
PLACES = ("z", "start", "end")  # of features that stand somewhere along the axis
MIRROR = np.diag([-1.0, 1.0, 1.0])  # z reversed
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

    def moved(self, dz: float) -> Self:
        """The same farther along the axis, mm; what counts from an end stays."""
        places = [each.name for each in fields(self) if each.name in PLACES]
        return replace(self, **{name: getattr(self, name) + dz for name in places})


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
        return None if found is None else found.transformed(MIRROR).reversed()

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


# A half section while features take away of it: what a feature asks of the body that it is cut into.

BEYOND = 1.0  # mm, by which what is taken away sticks out of the part
SAME = 1e-7  # mm, within which two places are one
BESIDE = 1e-6  # mm, beside an edge, where the wall is measured
NOTHING = 1e-7  # mm², less is none


class TurnedBody(NamedTuple):
    """The material (z, r), mm."""

    section: Region

    @property
    def low(self) -> float:
        return self._bounds[0]

    @property
    def high(self) -> float:
        return self._bounds[1]

    @property
    def radius(self) -> float:
        """The largest one."""
        return self._bounds[2]

    @property
    def _bounds(self) -> tuple[float, float, float]:
        boxes = np.array([loop.bounds for loop in self.section.loops])
        return float(boxes[:, 0, 0].min()), float(boxes[:, 1, 0].max()), float(boxes[:, 1, 1].max())

    def mirrored(self) -> TurnedBody:
        """The same with z reversed: its back end is the front."""
        return TurnedBody(flipped(self.section, MIRROR))

    def ends_at(self, radius: float) -> tuple[float, float]:
        """The lowest and the highest z of the material at a radius; nan where there is none."""
        low, high = revolved.ends_at(self.section.loops, np.array([radius]))
        return float(low[0]), float(high[0])

    def outer(self, z: Floats) -> Floats:
        """The radius of the outside at places; 0 where there is none."""
        return np.array([radii[-1] if len(radii) else 0.0 for radii in revolved.radii_at(self.section.loops, z)])

    def inner(self, z: Floats) -> Floats:
        """The radius of the bore at places; 0 where there is none."""
        return np.array([radii[0] if len(radii) else 0.0 for radii in revolved.radii_at(self.section.loops, z)])

    def check_within(self, front: float, back: float, ends: bool = True) -> None:
        """An Alarm unless the part reaches from one place to the other; without its `ends` it must reach beyond."""
        low, high, room = self.low, self.high, SAME if ends else -SAME
        if front > high + room or back < low - room:
            told = "it must lie within the part" if ends else "it must lie between the ends of the part"
            raise Alarm(f"{told}, Z {high:g} to {low:g}, got {front:g} to {back:g}")

    def walls(self, front: float, back: float, inside: bool) -> tuple[float, float]:
        """The radius of the surface just within two places, from the outside or in the bore."""
        found = (self.inner if inside else self.outer)(np.array([front - BESIDE, back + BESIDE])).tolist()
        if inside and min(found) < SAME:
            raise Alarm(f"there is no bore from Z {front:g} to {back:g}")
        return found[0], found[1]

    def places(self, front: float, back: float) -> Floats:
        """The middles (n,) and lengths (n,) of the stretches between corners from one place to another, (2, n)."""
        corners = np.concatenate([loop.points[:, 0] for loop in self.section.loops])
        inside = corners[(corners > back + SAME) & (corners < front - SAME)]
        cuts = np.unique(np.concatenate([[back, front], inside]).round(9))
        return np.stack([(cuts[1:] + cuts[:-1]) / 2, np.diff(cuts)])

    def without(self, cut: Contour) -> TurnedBody:
        """What is left; an Alarm where nothing is taken away, or more than a feature may."""
        rest = TurnedBody(self.section.difference(Region((cut,))))
        if self.section.area - rest.section.area < NOTHING:
            raise Alarm("it takes nothing away")
        if not rest.section.loops:
            raise Alarm("it takes the whole part away")
        if len(rest.section.parts) > 1:
            raise Alarm(f"it cuts the part in {len(rest.section.parts)} pieces")
        for name, has, had in (("front", rest.high, self.high), ("back", rest.low, self.low)):
            if abs(has - had) > SAME:
                raise Alarm(f"it takes away the {name} end, Z {had:g} becomes {has:g}", hint="give the profile that end")
        return rest
