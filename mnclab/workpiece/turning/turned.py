"""What the tools of a lathe leave of a bar: its half section, exact in lines and arcs."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.geometry import shapely
from mnclab.geometry.contours import Contour
from mnclab.path.places import along
from mnclab.path.toolpath import Array, Index, Kind
from mnclab.text.alarm import Alarm, several
from mnclab.text.given import check_number, choice, fitting_class, shown
from mnclab.workpiece.ahead import Ahead
from mnclab.workpiece.blank import Blank, Box, Revolved
from mnclab.workpiece.clamped import Placement
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.part import Part
from mnclab.workpiece.turning import revolved
from mnclab.workpiece.turning.revolved import TurnedBlank
from mnclab.workpiece.turning.section import CHORD_ERROR, Edge, SectionDrawing, cuts, held, left_of, moment
from mnclab.workpiece.turning.strokes import Strokes, strokes_of, threads_of
from mnclab.workpiece.workpiece import Solid, Workpiece

if TYPE_CHECKING:
    from mnclab.workpiece.milling.moves import Moves

CHORDS = 9  # of a quarter of a nose
SIDE = 1e-9  # of an edge, by which it goes ahead
NEAR = 1e-6  # mm from an end
PLANES = ("ZX", "XZ", "ZY", "YZ", "XY")


@fitting_class
class Turned(Workpiece):
    """`section`: closed contours (z, r), mm, from the axis of the spindle outwards; outer ones counter-clockwise, holes
    clockwise. `parted` are the pieces that fell off: the bar hangs in a chuck where its z is lowest.
    Nothing is sampled: a `step` changes nothing. Edges are as long as the cut is deep: that a true one is too short is told by
    the collisions, and the part is what the program says.
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
    def _drawing(self) -> SectionDrawing:
        strokes = self.strokes
        return SectionDrawing.of(self.blank, strokes.contours, strokes.rows)

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

    # --- what stands before the tool at places of its way: exact but for the chords of its nose ---------------------------
    #
    # Of the cutting part the edges that go ahead are looked at: what of them lies in the area that the row takes away is in
    # the material. Across the way that is the depth of cut, and times 2 π r the cross-section.

    def reach(self, rows: Index) -> Array:
        """The shares (2, k) of rows between which the tool is in what they take away; arcs may everywhere."""
        found, path = np.zeros((2, len(rows))) + [[0.0], [1.0]], self.cutting.path
        for k, row in enumerate(rows.tolist()):
            if path.kind[row] != Kind.ARC and row in self.areas:
                way = (path.end[row] - path.start[row])[[2, 0]]
                length = float(np.hypot(*way))
                if not length:
                    continue  # out of the plane
                spots, tip = shapely.get_coordinates(self.areas[row]) - self._place(path.start[row]), self._about_tip(row)
                u = way / length
                front, passed = spots @ u - (tip @ u).max(), spots @ (-u[1], u[0])
                ends = front.min(), front.max() + np.ptp(passed)  # it may lean back
                found[:, k] = np.clip(np.array(ends) / length, 0.0, 1.0)
        return found

    def ahead(self, rows: Index, share: Array) -> Ahead:
        """What stands before the tools of rows (k,) when a share (k,) of their way is behind and a turn before.

        The less of both, for a chip is no shorter than a turn.
        """
        path = self.cutting.path
        turn = np.nan_to_num(threads_of(path)[0][rows] / path.lengths[rows])
        now, before = self._at(rows, share), self._at(rows, (share - turn).clip(0.0))
        return Ahead(*np.where(before.area < now.area, before, now))

    def at_most(self, rows: Index) -> Ahead:
        """No less than `ahead` finds anywhere on rows (k,).

        The edges that go ahead are those of a convex body: across the way they lie beside each other, so that what of them is
        in the area reaches no further across than the area does; on an arc, whose way turns, no further than a line through
        its box. No part of it is further from the axis than the area.
        """
        found, path = Ahead.none(len(rows)), self.cutting.path
        for k, row in enumerate(rows.tolist()):
            if row in self.areas:
                spots, way = shapely.get_coordinates(self.areas[row]), (path.end[row] - path.start[row])[[2, 0]]
                length = float(np.hypot(*way))
                across = np.ptp(spots @ (-way[1], way[0])) / length if path.kind[row] != Kind.ARC and length else 0.0
                found.depth[k] = across or math.hypot(*np.ptp(spots, axis=0))
                found.area[k] = 2 * math.pi * found.depth[k] * np.abs(spots[:, 1]).max()
        return found

    def _at(self, rows: Index, share: Array) -> Ahead:
        found, path = Ahead.none(len(rows)), self.cutting.path
        place, way = along(path, rows, share)
        for row in np.unique(rows).tolist():
            if row not in self.areas:
                continue
            which, body, area = np.flatnonzero(rows == row), self._about_tip(row), self.areas[row]
            edge = np.roll(body, -1, axis=0) - body
            across = way[which][:, [2, 0]] @ np.array([edge[:, 1], -edge[:, 0]])
            k, e = np.nonzero(across > SIDE * np.hypot(*edge.T))
            start = self._place(place[which[k]]) + body[e]
            lines = shapely.linestrings(np.stack([start, start + edge[e]], axis=1))
            shapely.prepare(area)
            cut = np.flatnonzero(shapely.intersects(area, lines))
            inside = shapely.intersection(lines[cut], area)
            depth = across[k, e][cut] * shapely.length(inside) / shapely.length(lines[cut])
            np.add.at(found.depth, which[k[cut]], depth)
            np.add.at(found.area, which[k[cut]], 2 * math.pi * depth * np.abs(shapely.get_y(shapely.centroid(inside))))
        return found

    def _place(self, place: Array) -> Array:
        """Places (…, 3) of the path as (z, r)."""
        return np.asarray(place[..., [2, 0]] - (0.0, self.axis))

    def _about_tip(self, row: int) -> Array:
        """The corners (m, 2) of the cutting part about its tip, counter-clockwise, its noses as chords."""
        cutting, ends = self.cutting, (self.cutting.path.start[row], self.cutting.path.end[row])
        start, end = (tuple(self._place(each).tolist()) for each in ends)
        body: list[Edge] = self.strokes.body_of(cutting.tool(row), start, end)
        counts = [math.ceil(abs(each.sweep) * CHORDS * 2 / math.pi) or 1 for each in body]
        return np.array([each.at(k / count) for each, count in zip(body, counts) for k in range(count)])

    # --- what it is ---------------------------------------------------------------------------------------------------

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
