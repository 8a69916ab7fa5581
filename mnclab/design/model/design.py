"""A part as a drawing has it: a blank and features, on one side or on both; its exact body, and that as a workpiece."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.design.model.feature import Feature, Site
from mnclab.design.model.features import FEATURES, Chamfer, Groove, Pocket, Slot, Stud
from mnclab.design.model.measures import HEAD, rows
from mnclab.design.model.removals import Flat, Removal, filled
from mnclab.design.model.slabs import Stack
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array
from mnclab.text.alarm import Alarm
from mnclab.text.given import DesignFileOptions, DrawingOptions, check_number, check_point, choice, fitting_class, shown
from mnclab.text.tables import exactly, html_table
from mnclab.workpiece.blank import Blank, Box, Revolved, blank
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling.milled import Milled
from mnclab.workpiece.part import Part

if TYPE_CHECKING:
    import pyvista
    from matplotlib.figure import Figure

    from mnclab.workpiece.workpiece import Workpiece

TEXTS = ("title", "number", "material", "general", "author", "date")
ROOM = 3.0  # sizes of the blank, beyond which nothing stands


class Taken(NamedTuple):
    """What a feature takes away: `feature` and whether it is one of the `back`, the body, in the frame of the design."""

    feature: int
    back: bool
    body: Removal


@fitting_class
class AsDrawn(ABC):
    """A part as drawn, milled or turned: its doors."""

    def check_texts(self) -> None:
        """An Alarm unless what stands in the title block is text."""
        for name in TEXTS:
            if not isinstance(getattr(self, name), str):
                raise Alarm(f"the {name} of a design must be a text, got {shown(getattr(self, name))}")

    @abstractmethod
    def workpiece(self, step: float | None = None) -> Workpiece:
        """The finished part, as `run.workpiece()` would have it of a perfect program; `step` mm of its cells."""

    @staticmethod
    def load(path: str | Path) -> Any:
        """The design of a TOML file, a `Design` or a `TurnedDesign`; an Alarm shows the line that is wrong."""
        from mnclab.design.model.design_file import load

        return load(path)

    def save(self, path: str | Path, **options: Unpack[DesignFileOptions]) -> Path:
        """Write one file: toml the design; svg, pdf, png, dxf its drawing; stl, gltf, glb, vtk, csv its body."""
        from mnclab.design.model.design_file import save

        return save(self, path, **options)

    def plot(self, **options: Unpack[DrawingOptions]) -> Figure:
        """The dimensioned drawing in true size; `size` "A4", "A4 landscape", "A3" or "A2", `scale` 0.5 for 1:2, and `sheet`."""
        from mnclab.design.drawing import plot

        return plot(self, **options)

    def scene(self, **options: Any) -> pyvista.Plotter:
        """The part as a body (needs pyvista)."""
        return self.workpiece().scene(**{"colour": "none"} | options)


@fitting_class
@dataclass(frozen=True, repr=False)
class Design(AsDrawn):
    """A part as drawn. `blank`: two corners, a box or an upright cylinder, in the frame of the toolpath, mm; `features`:
    those of `mnclab.design`, in any order.

    `back` are features of the lower side, as a program sees them after the part was turned over about X (or Y: `turn`)
    in its place: it takes up the same box as before. `title`, `number`, `material`, `general` (the general tolerance),
    `author` and `date` stand in the title block of the drawing.

    `plot()` is that drawing, `volume` exact, `part` what a probe touches; `workpiece.compare(design)` measures a part by it.
    In files it is a TOML, which `mnclab help design` explains; `data/designs` has some.

    >>> plate = mnc.Design(mnc.box(100, 60, 20), [mnc.design.Pocket(mnc.design.Rectangle(50, 30, 30, 20), 10)])
    >>> plate.volume  # 100 x 60 x 20 less 30 x 20 x 10
    114000.0
    """

    blank: Any
    features: Sequence[Feature] = ()
    back: Sequence[Feature] = ()
    turn: str = field(default="x", kw_only=True)
    title: str = field(default="", kw_only=True)
    number: str = field(default="", kw_only=True)
    material: str = field(default="", kw_only=True)
    general: str = field(default="ISO 2768-m", kw_only=True)
    author: str = field(default="", kw_only=True)
    date: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        object.__setattr__(self, "blank", _blank(self.blank))
        for name in ("features", "back"):
            object.__setattr__(self, name, MILLED.features(getattr(self, name), name))
        object.__setattr__(self, "turn", choice(self.turn, "the axis that a design is turned over about", ("x", "y")))
        self.check_texts()
        self.taken  # noqa: B018  every feature must fit

    def __repr__(self) -> str:
        return exactly(self)

    def _repr_html_(self) -> str:
        sides = ((self.features, False), (self.back, True))
        named = [(name, each.measures()) for some, back in sides for name, each in zip(self.drawn_names(back), some)]
        return html_table(HEAD, rows(named), numbers=(2, 3))

    # --- what it is made of ------------------------------------------------------------------------------------------

    @property
    def bounds(self) -> Array:
        """The corners of the blank with the least and the greatest coordinates (2, 3)."""
        return np.asarray(self.blank.bounds)

    @cached_property
    def outline_of_blank(self) -> Region:
        """The blank from above."""
        if isinstance(self.blank, Box):
            (x0, y0), (x1, y1) = self.bounds[:, :2].tolist()
            return Region((Contour([(x0, y0), (x1, y0), (x1, y1), (x0, y1)]),))
        body, centre = self.blank, self.blank.at[:2]
        rings = [Contour.circle(centre, body.profile[0][0])]
        return Region((*rings, *([Contour.circle(centre, body.bore, clockwise=True)] if body.bore else [])))

    @cached_property
    def flip(self) -> tuple[Array, float]:
        """What turns it over: a mirror (3, 3) of the plane, and the sum of a height before and after."""
        low, high = self.bounds
        k = 1 if self.turn == "x" else 0
        flip = np.eye(3)
        flip[k, k], flip[k, 2] = -1.0, low[k] + high[k]
        return flip, float(low[2] + high[2])

    @cached_property
    def taken(self) -> tuple[Taken, ...]:
        """What every feature takes away, those of the back turned over."""
        found = [Taken(k, False, body) for k, body in self._taken(self.features, "features")]
        for k, body in self._taken(self.back, "back"):
            found.append(Taken(k, True, body.turned_over(*self.flip)))
        return tuple(found)

    def _taken(self, features: Sequence[Feature], where: str) -> Iterator[tuple[int, Removal]]:
        """The bodies of the features of one side, in its own frame."""
        site, late = self._site(where == "back"), list[int]()
        found: list[tuple[int, Removal]] = []
        for k, each in enumerate(features):
            if isinstance(each, Chamfer):
                late.append(k)
            else:
                found += [(k, body) for body in self._removals(features, k, site, where)]
        site = site._replace(flats=tuple(body for _, body in found if isinstance(body, Flat)))
        for k in late:
            found += [(k, body) for body in self._removals(features, k, site, where)]
        yield from found

    def _removals(self, features: Sequence[Feature], k: int, site: Site, where: str) -> list[Removal]:
        each = features[k]
        top = site.top if each.top is None else each.top
        if isinstance(each, Stud) and any(_stands_in(each, other) for other in features):
            return []  # an island of the pocket, which leaves it
        try:
            found = list(each.removals(site))
            if isinstance(each, Pocket | Stud):
                stay = [other for other in features if isinstance(other, Stud) and _same_floor(each, other) and other is not each]
                if isinstance(each, Pocket):
                    stay = [other for other in stay if _stands_in(other, each)]
                for other in stay:
                    found = [replace(body, region=body.region.difference(other.area)) for body in found if isinstance(body, Flat)]
        except (Alarm, ValueError) as fault:
            said = fault.message if isinstance(fault, Alarm) else str(fault)
            hint = fault.hint if isinstance(fault, Alarm) else ""
            raise Alarm(f"{name_of(features, k)} ({where}[{k}]): {said}", hint=hint) from None
        if not top > site.bottom:
            raise Alarm(f"{name_of(features, k)} ({where}[{k}]): its top {top:g} is not above the lower side, {site.bottom:g}")
        if not any(_takes(body, site) for body in found):
            raise Alarm(f"{name_of(features, k)} ({where}[{k}]) takes nothing away: it lies beside the blank, or above it")
        return found

    def _site(self, back: bool) -> Site:
        (x0, y0, low), (x1, y1, high) = self.bounds.tolist()
        outline = self.outline_of_blank
        if back:
            outline = Region(tuple(loop.transformed(self.flip[0]).reversed() for loop in outline.loops))
        wide = ROOM * max(x1 - x0, y1 - y0)
        corners = [(x0 - wide, y0 - wide), (x1 + wide, y0 - wide), (x1 + wide, y1 + wide), (x0 - wide, y1 + wide)]
        return Site(outline, Region((Contour(corners),)), high, low)

    # --- its body ----------------------------------------------------------------------------------------------------

    @cached_property
    def stack(self) -> Stack:
        low, high = self.bounds[:, 2].tolist()
        return Stack.of(self.outline_of_blank, low, high, [each.body for each in self.taken])

    @property
    def volume(self) -> float:
        """mm³: exact, from the areas of its level sections."""
        return self.stack.volume

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """How low and how high it reaches at points (m,), exact; nan beside it and where something goes through.

        Where it overhangs all below its top counts as material, as far as the lowest face from below.
        """
        floor, top = (side.copy() for side in self.blank.faces(x, y))
        for each in self.taken:
            level = each.body.level(x, y)
            if each.body.up:
                top = np.minimum(top, level)
            else:
                floor = np.maximum(floor, level)
        gone = ~(top > floor)
        floor[gone] = top[gone] = np.nan
        return floor, top

    def faces_over(self, x: Array, y: Array) -> tuple[Array, Array]:
        """The same over a lattice x (nx,), y (ny,) of many points: two arrays (ny, nx)."""
        return self.makers_over(x, y)[:2]

    def makers_over(self, x: Array, y: Array) -> tuple[Array, Array, NDArray[np.int16], NDArray[np.int16]]:
        """The faces over a lattice, and which of `taken` made the upper and the lower one, -1 for none: four arrays (ny, nx)."""
        x, y = np.atleast_1d(x, y)
        shape = len(y), len(x)
        sides = {False: np.full(shape, np.nan), True: np.full(shape, np.nan)}
        makers = {up: np.full(shape, -1, dtype=np.int16) for up in sides}
        rows, columns, inside = filled(self.outline_of_blank, x, y)
        for up, height in zip(sides, self.bounds[:, 2].tolist()):
            sides[up][rows, columns][inside] = height
        for k, (_, _, body) in enumerate(self.taken):
            rows, columns, inside = filled(body.reach, x, y)
            j, i = np.nonzero(inside)
            level = body.level_within(x[columns][i], y[rows][j])
            here, made = sides[body.up][rows, columns], makers[body.up][rows, columns]
            cut = level < here[inside] if body.up else level > here[inside]
            here[inside] = np.where(cut, level, here[inside])
            made[inside] = np.where(cut, k, made[inside])
        floor, top = sides.values()
        with np.errstate(invalid="ignore"):
            gone = ~(top > floor)
        floor[gone] = top[gone] = np.nan
        return floor, top, makers[True], makers[False]

    @property
    def regions(self) -> dict[str, Region]:
        """What a mill has to clear of each pocket, slot and groove, by its name, islands and studs in it left out."""
        names = self.drawn_names()
        areas = {k: body.region for k, back, body in self.taken if isinstance(body, Flat) and not back}
        return {names[k]: areas[k] for k, each in enumerate(self.features) if isinstance(each, Pocket | Slot | Groove)}

    @property
    def region(self) -> Region:
        """That of the only one; an Alarm where there are several or none."""
        if len(found := self.regions) != 1:
            said = f"{len(found)} areas to clear: {', '.join(found)}" if found else "no pocket, slot or groove"
            raise Alarm(f"the design has {said}", hint=f"design.regions[{next(iter(found))!r}]" if found else "")
        return next(iter(found.values()))

    def section(self, z: float) -> Region:
        """What a level plane cuts, exact; at the height of a step what is below it."""
        check_number(z, "the height of a section (mm)")
        return self.stack.section(float(z))

    @property
    def part(self) -> Part:
        """What a probe touches: signed distances, exact but for the corners of chamfers."""
        return Part(self.stack.distance, self.title or "design", bounds=np.array(self.bounds))

    def workpiece(self, step: float | None = None) -> Workpiece:
        """The finished part, as `run.workpiece()` would have it of a perfect program; `step` mm of its cells."""

        return Drawn(self, step)

    def turned_over(self) -> Design:
        """The same with its lower side up: features and `back` change places."""
        return replace(self, features=self.back, back=self.features, blank=self.blank)

    def moved(self, by: ArrayLike) -> Design:
        """The same elsewhere, mm."""
        check_point(by, "how far a design is moved (mm)")
        dx, dy, dz = np.asarray(by, dtype=np.float64).tolist()
        there = (dx, -dy, -dz) if self.turn == "x" else (-dx, dy, -dz)  # the back as it is seen from its own side
        flip, z = self.flip
        moved = replace(self, blank=self.blank.moved((dx, dy, dz)), features=(), back=())
        shift = moved.flip[0][:2, 2] - flip[:2, 2]
        back = tuple(each.moved(there[0] + shift[0], there[1] + shift[1], moved.flip[1] - z + there[2]) for each in self.back)
        return replace(moved, features=tuple(each.moved(dx, dy, dz) for each in self.features), back=back)

    def outline(self, right: int, up: int) -> list[Array]:
        return self.blank.outline(right, up)

    def edges(self) -> list[Array]:
        return self.blank.edges()

    def as_blank(self) -> Blank:
        """The finished part as a blank, for a Setup."""
        return self

    def drawn_names(self, back: bool = False) -> tuple[str, ...]:
        """What drawing and tables call the features of a side: their names, else their kinds, numbered."""
        features = self.back if back else self.features
        return tuple(name_of(features, k) for k in range(len(features)))


def name_of(features: Sequence[Any], k: int) -> str:
    """The name of a feature, else its kind, with a number where there are several."""
    each = features[k]
    same = [i for i, other in enumerate(features) if other.kind == each.kind and not other.name]
    return each.name or (each.kind if len(same) == 1 else f"{each.kind} {same.index(k) + 1}")


def _takes(body: Removal, site: Site) -> bool:
    """Whether a body takes something of the blank."""
    region = body.reach
    if not body.reaches(site.top) or not region.loops:
        return False
    (x0, y0), (x1, y1) = site.outline.bounds
    (left, low), (right, high) = region.bounds
    if len(site.outline.loops) == 1 and not site.outline.loops[0].bulge.any():
        if x0 <= left and right <= x1 and y0 <= low and high <= y1:
            return True
    return bool(site.outline.intersection(region).loops)


def _same_floor(one: Any, other: Any) -> bool:
    return bool(one.top == other.top and one.depth == other.depth)


def _stands_in(stud: Feature, pocket: Feature) -> bool:
    """Whether a stud is an island of a pocket: of one top and depth, all of it within."""
    if not isinstance(stud, Stud) or not isinstance(pocket, Pocket) or not _same_floor(stud, pocket):
        return False
    (low, high), (least, most) = stud.area.bounds, pocket.area.bounds
    return bool((low >= least).all() and (high <= most).all() and pocket.area.contains(stud.contour.contour.points).all())


def _blank(given: Any) -> Blank:
    found = blank(given)
    if found is None:
        hint = "Design(blank=((0, 0, -20), (60, 40, 0)))"
        raise Alarm(f"the blank of a design must be two corners, a box or a cylinder, got {shown(given)}", hint=hint)
    upright = isinstance(found, Revolved) and found.axis == "Z" and len({radius for radius, _ in found.profile}) == 1
    if not isinstance(found, Box) and not upright:
        raise Alarm(f"the blank of a milled design is a box or an upright cylinder, got {shown(given)}")
    if not found.volume > 0:
        raise Alarm(f"the blank of a design has no volume: {shown(given)}")
    if isinstance(found, Box):
        low, high = found.bounds.tolist()
        return Box(tuple(low), tuple(high))
    return found


class Taking(NamedTuple):
    """Which features a design takes: its own name, their class, those that there are, how alarms call one, an example."""

    design: str
    kind: type[Any]
    known: Mapping[str, type[Any]]
    one: str
    example: str

    def features(self, given: Any, name: str) -> tuple[Any, ...]:
        """What was given as features, one, several or patterns of them, as a tuple; an Alarm for all else."""
        given = (given,) if isinstance(given, self.kind) else list(given) if isinstance(given, Iterator | np.ndarray) else given
        if not isinstance(given, tuple | list):
            hint = f"mnclab.design.{self.example}"
            raise Alarm(f"{name} of a {self.design} must be features, got {shown(given)}", hint=hint)
        found = [one for each in given for one in (each if isinstance(each, tuple | list) else [each])]  # patterns are tuples
        for k, each in enumerate(found):
            if not isinstance(each, self.kind):
                known = ", ".join(cls.__name__ for cls in self.known.values())
                fault = f"{name}[{k}] of a {self.design} must be {self.one}, got {shown(each)}"
                raise Alarm(fault, hint=f"mnclab.design has {known}")
        return tuple(found)


MILLED = Taking("design", Feature, FEATURES, "a feature", "Pocket.circle(30, 20, 12, 5)")


class Drawn(Milled):
    """A `Milled` part that nothing cut: its heights, volume and distances are those of the design."""

    def __init__(self, design: Design, step: float | None = None) -> None:
        super().__init__(Cutting.of_nothing(design), step)
        self.design = design
        self.method, self.error = "as drawn", 0.0

    @cached_property
    def sides(self) -> tuple[Array, Array]:
        """The lower and the upper side at the middles of the cells (ny, nx); its lowest place where there is nothing."""
        low = float(self.design.bounds[0, 2])
        floor, top = (np.where(np.isnan(side), low, side) for side in self.design.faces_over(self.x, self.y))
        return floor, top

    @cached_property
    def heights(self) -> Array:
        return self.sides[1]

    @cached_property
    def floor(self) -> Array:
        return self.sides[0]

    @property
    def volume(self) -> float:
        return self.design.volume

    @cached_property
    def removed(self) -> float:
        """What a program has to take away from the blank of the design, mm³."""
        return self.design.blank.volume - self.design.volume

    def removed_by_row(self) -> Array:
        return np.zeros(0)

    @property
    def part(self) -> Part:
        return self.design.part
