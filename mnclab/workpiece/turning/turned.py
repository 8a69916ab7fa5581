"""What the tools of a lathe leave of a bar: its half section, exact in lines and arcs."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.path.toolpath import Array, Index
from mnclab.text.alarm import Alarm, several
from mnclab.text.given import check_number, choice, fitting_class, shown
from mnclab.workpiece.ahead import Ahead
from mnclab.workpiece.blank import Blank, Box, Revolved
from mnclab.workpiece.clamped import Placement
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.part import Part
from mnclab.workpiece.turning import engaged, revolved
from mnclab.workpiece.turning.revolved import TurnedBlank
from mnclab.workpiece.turning.section import CHORD_ERROR, Drawing, cuts, held, left_of, moment
from mnclab.workpiece.turning.strokes import Strokes, strokes_of
from mnclab.workpiece.workpiece import Solid, Workpiece

if TYPE_CHECKING:
    from mnclab.workpiece.milling.moves import Moves

NEAR = 1e-6  # mm from an end
PLANES = ("ZX", "XZ", "ZY", "YZ", "XY")


@fitting_class
class Turned(Workpiece):
    """`section`: closed contours (z, r), mm, from the axis of the spindle outwards; outer ones counter-clockwise, holes
    clockwise. `parted` are the pieces that fell off: the bar hangs in a chuck where its z is lowest.
    Nothing is sampled: a `step` changes nothing.
    """

    def __init__(
        self, cutting: Cutting, step: float | None = None, whole: Callable[[], Workpiece] | None = None
    ) -> None:
        if step is not None:
            check_number(step, "the step of a workpiece (mm)", above=0)
        self.cutting, self.whole = cutting, whole
        self.blank, self.axis, told = half_section(cutting.stock)
        self.low, self.high, self.radius = room_of(self.blank)
        self.method, self.error = "exact sweep of the half section", CHORD_ERROR
        self._told = told

    @cached_property
    def strokes(self) -> Strokes:
        return strokes_of(self.cutting, self.low, self.high, self.radius, self.axis)

    @cached_property
    def _drawing(self) -> Drawing:
        strokes = self.strokes
        return Drawing.of(self.blank, strokes.contours, strokes.rows)

    @cached_property
    def _pieces(self) -> tuple[Any, list[Any]]:
        return held(left_of(self._drawing), self.low)

    @cached_property
    def section(self) -> list[Contour]:
        return list(self._drawing.traced(self._pieces[0])) if self.strokes.contours else self.blank

    @property
    def grip(self) -> float:
        """The radius of the blank at the end that hangs in the chuck, mm."""
        return float(revolved.radii_at(self.blank, np.array([self.low + NEAR]))[0].max(initial=0.0))

    @cached_property
    def rows(self) -> list[NDArray[np.int64]]:
        """For each contour of the section the row of the path that cut its elements, -1 where the blank is untouched."""
        return [self._drawing.rows_of(contour) for contour in self.section]

    @cached_property
    def _cuts(self) -> list[tuple[int, Any, list[Any]]]:
        return list(cuts(self._drawing, self.low))

    @cached_property
    def areas(self) -> dict[int, Any]:
        """What each row that cuts took away, as shapely areas (z, r)."""
        found: dict[int, list[Any]] = {}
        for row, cut, _ in self._cuts:
            found.setdefault(row, []).append(cut)
        return {row: pieces[0] if len(pieces) == 1 else shapely.union_all(pieces) for row, pieces in found.items()}

    def reach(self, rows: Index) -> Array:
        return engaged.reach(self, rows)

    def ahead(self, rows: Index, share: Array) -> Ahead:
        return engaged.ahead(self, rows, share)

    def at_most(self, rows: Index) -> Ahead:
        return engaged.at_most(self, rows)

    @cached_property
    def parted(self) -> list[Contour]:
        return [loop for _, _, off in self._cuts for area in off for loop in self._drawing.traced(area)]

    @property
    def notes(self) -> tuple[str, ...]:  # type: ignore[override]
        fell = (f"{several(len(self.parted), 'piece')} fell off",) if self.parted else ()
        return (*self._told, *self.cutting.notes(), *self.strokes.notes, *fell)

    @property
    def volume(self) -> float:
        return revolved.volume(self.section)

    @property
    def _removed(self) -> float:
        return revolved.volume(self.blank) - self.volume - revolved.volume(self.parted)

    @cached_property
    def _by_row(self) -> Array:
        """Arcs are chords of the section, and the sum is exact."""
        shares = np.zeros(len(self.cutting))
        for row, cut, _ in self._cuts:
            shares[row] += moment(cut)
        total = float(shares.sum())
        return shares * (self.removed / total) if total else shares

    def at(self, z: ArrayLike) -> Array | float:
        """The outer radius over a z or over many, mm; 0 where nothing is left, at a shoulder that on its left."""
        return self._radius(z, -1)

    def bore_at(self, z: ArrayLike) -> Array | float:
        """The radius of the hole over a z or over many, mm; 0 where there is none."""
        return self._radius(z, 0)

    def _radius(self, z: ArrayLike, which: int) -> Array | float:
        places = np.asarray(z, dtype=np.float64)
        found = np.array([r[which] if len(r) else 0.0 for r in revolved.radii_at(self.section, places.ravel())])
        return found.reshape(places.shape) if places.ndim else float(found[0])

    def cut(self, plane: str, at: float = 0.0) -> list[Contour]:
        """A section: along the axis ("ZX", "ZY" with z first, "XZ", "YZ" with it last) both halves; "XY" rings over a z."""
        plane = choice(plane, "the plane of a section", PLANES)
        check_number(at, "the place of a section (mm)")
        if plane == "XY":
            radii = revolved.radii_at(self.section, np.array([float(at)]))[0]
            rings = [Contour.circle((self.axis, 0.0), r, clockwise=k % 2 == 0) for k, r in enumerate(radii) if r > 0]
            return rings[::-1]
        if at != 0:
            raise Alarm(f"a section along the axis of a turned part goes through the axis, at 0, got {at:g}")
        whole = revolved.both_halves(self.section)
        frame = np.array([[1.0, 0, 0], [0, 1, self.axis if "X" in plane else 0.0], [0, 0, 1]])
        swap = np.array([[0.0, 1, 0], [1, 0, 0], [0, 0, 1]])
        if plane[0] == "Z":
            return [loop.transformed(frame) for loop in whole]
        return [loop.transformed(swap @ frame).reversed() for loop in whole]

    # --- as the next blank -------------------------------------------------------------------------------------------

    def half_section(self) -> tuple[list[Contour], float]:
        return self.section, self.axis

    @property
    def _body(self) -> TurnedBlank:
        return TurnedBlank(tuple(self.section), (self.axis, 0.0))

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """What overhangs counts as filled: from the lowest place to the highest one."""
        return self._body.faces(x, y)

    def outline(self, right: int, up: int) -> list[Array]:
        return self._body.outline(right, up)

    def edges(self) -> list[Array]:
        return self._body.edges()

    def made_by(self) -> Iterator[tuple[Moves, Placement]]:
        return iter(())

    def _uncut(self, stock: Blank) -> Turned:
        return Turned(self.cutting.uncut(stock))

    @property
    def part(self) -> Part:
        return revolved.part(self.section, self.axis)

    def solid(self) -> Solid:
        return revolved.solid(self.section, self.rows, self.axis)


def turns(body: Any) -> bool:
    """Whether a lathe can turn a blank: a bar, a body about Z, a part that was turned before."""
    if hasattr(body, "half_section"):
        return body.half_section() is not None
    return isinstance(body, Box) or (isinstance(body, Revolved) and body.axis == "Z")


def half_section(body: Any) -> tuple[list[Contour], float, tuple[str, ...]]:
    """The contours (z, r) of a lathe's blank or chuck, where its axis stands in x, mm, and what is to be said of it.

    A box counts as a bar, or beside the axis as a ring, by its X. A part that was turned before says its own.
    """
    if not turns(body):
        hint = "what a mill has cut does not turn true" if hasattr(body, "half_section") else ""
        raise Alarm(f"on a lathe a blank and its chuck are boxes or bodies about Z, got {shown(body)}", hint=hint)
    if hasattr(body, "half_section"):
        section, axis = body.half_section()
        return list(section), float(axis), ()
    if isinstance(body, Box):
        (x0, _, z0), (x1, _, z1) = body.bounds.tolist()
        inner, outer = max(x0, -x1, 0.0), max(abs(x0), abs(x1))
        told = (f"the box counts as a bar of radius {outer:g}",)
        return [Contour([(z0, inner), (z1, inner), (z1, outer), (z0, outer)])], 0.0, told
    profile = [(place + body.at[2], radius) for radius, place in body.profile]
    points = np.array([*profile, (profile[-1][0], body.bore), (profile[0][0], body.bore)])
    some = np.hypot(*(np.roll(points, -1, axis=0) - points).T) > 0
    contour = Contour(points[some])
    return [contour if contour.area > 0 else contour.reversed()], float(body.at[0]), ()


def room_of(section: Sequence[Contour]) -> tuple[float, float, float]:
    """From where to where along z a section reaches, and how far from the axis, mm."""
    boxes = np.array([each.bounds for each in section])
    return float(boxes[:, 0, 0].min()), float(boxes[:, 1, 0].max()), float(boxes[:, 1, 1].max())
