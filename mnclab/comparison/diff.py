"""Two paths laid over one another: how far each is from the other, and where they are farthest apart.

The distance of a place is that to the nearest place of the other path, whatever its number or order of moves; the
greatest of all, in both directions, is the Hausdorff distance. Arcs are chords within `chord_error`; a path is looked at
every `step` mm, so the result is too small by less than half a step, and wrong by the chord error at most besides.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from numpy.typing import NDArray

from mnclab.comparison.pairs import same_places
from mnclab.geometry.curves import counted
from mnclab.path.holes import Holes, places
from mnclab.path.limits import Limits
from mnclab.path.listing import MM, Unit, figure, point
from mnclab.path.places import points
from mnclab.path.profile.ramps import bent
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import several
from mnclab.text.given import FigureOptions, check_number, fitting
from mnclab.text.tables import Listing, Pictured, html_table, shapes

if TYPE_CHECKING:
    from mnclab.show.plot.picture import Picture


Array = NDArray[np.float64]
PLACES = 4000  # of a path, if no step is given
MOST = 10_000_000  # of a path, whatever the step
SAME = 1e-9  # mm; paths no farther apart than this are the same
FINE = 0.01  # mm, beside its straight line: a rapid that goes no farther goes straight
CHUNK, GROUP, SPARSE = 64, 64, 16  # places at a time; strokes that share a box; every which of them is tried first


@dataclass(frozen=True)
class Traces:
    """One path as seen from the other: places (m, 3) mm, their rows (m,), the nearest places (m, 3) of the other."""

    places: Array
    row: NDArray[np.int64]
    nearest: Array

    __repr__ = shapes

    @property
    def distance(self) -> Array:
        """mm (m,)."""
        return np.asarray(np.linalg.norm(self.places - self.nearest, axis=1))


@dataclass(frozen=True)
class Deviation(Pictured):
    """Where two paths differ: `one` and `other` are the traces, `names` and `paths` what was compared, `times` s of both.

    `reaches` are "up to line 12, where the run stopped" for a path that ends before its program, else empty: `complete` is
    whether both are whole, for two that stop alike have not shown that they are the same. Under the limits of `rapids` those of
    each path are drawn; what is measured are the straight lines between their ends, whatever the machines make of them.
    """

    paths: tuple[Toolpath, Toolpath]
    names: tuple[str, str]
    one: Traces
    other: Traces
    step: float
    times: tuple[float, float] | None = None
    reaches: tuple[str, str] = ("", "")
    rapids: tuple[Limits | None, Limits | None] = (None, None)

    @property
    def complete(self) -> bool:
        """Whether both programs ran to their ends."""
        return not any(self.reaches)

    def __bool__(self) -> bool:
        """Whether the paths differ, or a run that stopped has not shown that they do not."""
        return not (self.complete and self.largest < SAME)

    @property
    def unit(self) -> Unit:
        """In what it is told: the unit of both paths, mm where they have two."""
        one, other = self.paths
        return one.unit if one.unit.length == other.unit.length else MM

    @property
    def largest(self) -> float:
        """The largest deviation, mm; nan when one path has no motion and the other has."""
        if not (len(self.one.row) and len(self.other.row)):
            return 0.0 if len(self.one.row) == len(self.other.row) else float("nan")
        return float(max(self.one.distance.max(), self.other.distance.max()))

    @property
    def where(self) -> tuple[Array, Array, int, int] | None:
        """The two places (3,) that are farthest apart, on the first and the second path, and the line of the one from
        which it was measured with the number of its path (0 or 1); None without motion."""
        if not len(self.one.row) or not len(self.other.row):
            return None
        k = 0 if self.one.distance.max() >= self.other.distance.max() else 1
        trace = (self.one, self.other)[k]
        at = int(trace.distance.argmax())
        pair = trace.places[at], trace.nearest[at]
        return *(pair if k == 0 else pair[::-1]), int(self.paths[k].line[trace.row[at]]), k

    def first(self, tolerance: float = 0.001) -> int | None:
        """The first row of the second path that is more than `tolerance` mm away from the first; None if there is none."""
        away = np.flatnonzero(self.other.distance > tolerance)
        return int(self.other.row[away[0]]) if len(away) else None

    def rows(self) -> list[tuple[str, ...]]:
        """What the table shows: a quantity, and its value on each path."""
        far, unit = self.where[:2] if self.where and not self.largest < SAME else (), self.unit
        quantities = [
            ("farthest apart", (point(each, self.unit) for each in far)),
            ("moves", (str(int(path.is_motion.sum())) for path in self.paths)),
            ("length", (f"{unit.figure(path.length, 1)} {unit.short}" for path in self.paths)),
            ("time", (f"{figure(time, 3)} s" for time in self.times or ())),
        ]
        return [(name, *pair) for name, values in quantities if (pair := tuple(values))]

    @property
    def sentence(self) -> str:
        return self._found + "".join(f"; {name} {reach}" for name, reach in zip(self.names, self.reaches) if reach)

    @property
    def _found(self) -> str:
        where = self.where
        if where is None:
            return "no motion on either path" if self.largest == 0 else "only one of the paths has motion"
        if self.largest < SAME:
            if self.rapids_apart < FINE:
                return "the paths are the same"
            return f"the cuts are the same; the axes lead the rapids up to {self._length(self.rapids_apart)} apart"
        straight = ", rapids taken as straight lines" if self.rapids_apart >= FINE else ""
        return f"largest deviation {self._length(self.largest)} at line {where[2]} of {self.names[where[3]]}{straight}"

    @cached_property
    def rapids_apart(self) -> float:
        """How far the paths are apart, mm, where their rapids go as two machines lead them; 0 where both lead them alike."""
        one, other = self.rapids
        if one is None or other is None or one == other:
            return 0.0
        led = [bent(path, limits, FINE) for path, limits in zip(self.paths, (one, other))]
        bends = any(len(path) > len(straight) for path, straight in zip(led, self.paths))
        return deviation(led[0], led[1], step=self.step).largest if bends else 0.0

    def _length(self, length: float) -> str:
        unit = self.unit
        return f"{figure(length / unit.length, unit.decimals - 1 if length >= 0.001 else unit.decimals + 2)} {unit.short}"

    def __str__(self) -> str:
        head = f"{self.names[0]} and {self.names[1]}: {self.sentence}"
        return "\n".join([head, *(f"  {name}: {one}; {other}" for name, one, other in self.rows())])

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return f"<p>{escape(self.sentence)}</p>{html_table(('', *self.names), self.rows())}"

    @fitting
    def plot(self, view: str = "auto", **options: Unpack[FigureOptions]) -> Picture:
        """Both paths in one `view`, with the largest deviation marked."""
        from mnclab.show.plot.side_by_side import plot_deviation

        return plot_deviation(self, view, **options)


def deviation(
    one: Toolpath, other: Toolpath, names: tuple[str, str] = ("first", "second"),
    step: float | None = None, chord_error: float = 1e-4, times: tuple[float, float] | None = None,
    reaches: tuple[str, str] = ("", ""), rapids: tuple[Limits | None, Limits | None] = (None, None),
) -> Deviation:  # fmt: skip
    """Lay two paths over one another; `step` mm, by default a four-thousandth of the longer one."""
    longest = max(one.length, other.length, 1e-3)
    step = longest / PLACES if step is None else step
    check_number(step, "step (mm)", above=0, at_least=longest / MOST)
    strokes = [strokes_of(path, chord_error) for path in (one, other)]
    looks = [_places(*parts, step) for parts in strokes]
    first, second = (Traces(*look, nearest_of(look[0], *against[:2])) for look, against in zip(looks, strokes[::-1]))
    return Deviation((one, other), names, first, second, step, times, reaches, rapids)


def strokes_of(path: Toolpath, chord_error: float) -> tuple[Array, Array, NDArray[np.int64]]:
    """Straight pieces of the motion: starts and ends (n, 3) and rows (n,)."""
    xyz, row = points(path, chord_error)
    start, row = xyz[:-1].copy(), row[1:]
    first = np.diff(row, prepend=-1) > 0
    start[first] = path.start[row[first]]
    return start, xyz[1:], row


def _places(start: Array, end: Array, row: NDArray[np.int64], step: float) -> tuple[Array, NDArray[np.int64]]:
    """Places (m, 3) along the strokes of each row, its both ends among them, and their rows (m,)."""
    if not len(row):
        return start, row
    first = np.flatnonzero(np.diff(row, prepend=-1))
    last = np.append(first[1:], len(row)) - 1
    length = np.linalg.norm(end - start, axis=1)
    upto = np.cumsum(length)
    begin = upto[first] - length[first]
    count = np.maximum(np.ceil((upto[last] - begin) / step), 1).astype(np.int64) + 1
    which, rank = counted(count)
    share = rank / (count[which] - 1)
    way = begin[which] + share * (upto[last] - begin)[which]
    stroke = np.clip(np.searchsorted(upto, way), first[which], last[which])
    part = np.clip((way - upto[stroke] + length[stroke]) / np.where(length[stroke] > 0, length[stroke], 1.0), 0.0, 1.0)
    part[share == 1] = 1.0
    return start[stroke] + part[:, None] * (end - start)[stroke], row[stroke]


def nearest_of(places: Array, start: Array, end: Array) -> Array:
    """The nearest place on any stroke (m, 3).

    Strokes are put into boxes in their order. The box of the nearest of some strokes gives a distance; only boxes that come
    nearer than that can hold a nearer stroke. Neighbouring places share them, so they are looked at together.
    """
    if not len(start) or not len(places):
        return np.full_like(places, np.nan)
    groups = np.arange(0, len(start), GROUP)
    low = np.minimum.reduceat(np.minimum(start, end), groups)
    high = np.maximum.reduceat(np.maximum(start, end), groups)
    found = np.empty_like(places)
    for at in range(0, len(places), CHUNK):
        here = places[at : at + CHUNK]
        off = (np.maximum(np.maximum(a - p[:, None], p[:, None] - b), 0) for a, p, b in zip(low.T, here.T, high.T))
        gap = np.sqrt(sum(each**2 for each in off))
        some = start[::SPARSE] - here[0]
        nearest = (np.einsum("ij,ij->i", some, some) - 2 * (here - here[0]) @ some.T).argmin(axis=1)
        best = np.unique(nearest * SPARSE // GROUP)
        near = _on_strokes(here, start, end, best)
        reach = np.linalg.norm(here - near, axis=1)
        needed = np.flatnonzero((gap < reach[:, None] + 1e-12).any(axis=0))
        found[at : at + CHUNK] = near if np.isin(needed, best).all() else _on_strokes(here, start, end, needed)
    return found


def _on_strokes(here: Array, start: Array, end: Array, boxes: NDArray[np.int64]) -> Array:
    """The nearest place (m, 3) on the strokes of some boxes. Which stroke is nearest is found with matrix products,
    which are quick and lose half of the digits; where on that stroke, with differences."""
    which = (boxes[:, None] * GROUP + np.arange(GROUP)).ravel()
    which = which[which < len(start)]
    middle = here.mean(axis=0)
    a, along, seen = start[which] - middle, (end - start)[which], here - middle
    square = np.einsum("ij,ij->i", along, along)
    square[square == 0] = 1.0
    forward = seen @ along.T - np.einsum("ij,ij->i", a, along)
    share = np.clip(forward / square, 0.0, 1.0)
    away = np.einsum("ij,ij->i", a, a) - 2 * (seen @ a.T) + share * (share * square - 2 * forward)
    nearest = away.argmin(axis=1)
    chosen, stroke = along[nearest], a[nearest]
    exact = np.einsum("ij,ij->i", seen - stroke, chosen) / square[nearest]
    return middle + stroke + np.clip(exact, 0.0, 1.0)[:, None] * chosen


# The holes of two programs side by side: the same places and diameters, whatever the order and the heights.

TOLERANCE = 0.001  # mm


@dataclass(frozen=True, eq=False, repr=False)
class HolesCompared(Pictured, Listing):
    """Holes that both have and that only one has, rows (x, y, diameter) in mm; a table of these when shown."""

    HEAD, NUMBERS, MOST = ("", "x, mm", "y, mm", "diameter, mm"), range(1, 4), 20

    names: tuple[str, str]
    both: Array
    only: tuple[Array, Array]
    tolerance: float
    reaches: tuple[str, str] = ("", "")

    @property
    def same(self) -> bool:
        """Whether both have the same holes; not known of a run that stopped before its end, so False."""
        return not any(map(len, self.only)) and not any(self.reaches)

    def __bool__(self) -> bool:
        """Whether they differ, or a run that stopped has not shown that they do not."""
        return not self.same

    def __len__(self) -> int:
        """How many holes only one of the two has."""
        return sum(map(len, self.only))

    @property
    def sentence(self) -> str:
        stops = "".join(f"; {name} {reach}" for name, reach in zip(self.names, self.reaches) if reach)
        if not any(map(len, self.only)):
            return (f"the same {several(len(self.both), 'hole')}" if len(self.both) else "no holes in either") + stops
        told = (f"{len(rows)} only in {name}" for rows, name in zip(self.only, self.names) if len(rows))
        return f"{several(len(self.both), 'hole')} in both, {', '.join(told)}{stops}"

    @property
    def above(self) -> str:
        return f"{self.names[0]} and {self.names[1]}: {self.sentence}"

    def rows(self) -> list[tuple[str, ...]]:
        """The holes that only one of the two has."""
        found = ((name, row) for name, rows in zip(self.names, self.only) for row in rows.tolist())
        return [(f"only in {name}", *(figure(value) for value in row)) for name, row in found]

    texts = rows

    @fitting
    def plot(self, **options: Unpack[FigureOptions]) -> Picture:
        """The holes from above at their diameters, told apart by what has them."""
        from mnclab.show.plot.holes import plot_holes

        return plot_holes(self, **options)


def compare_holes(one: Holes, other: Holes, names: tuple[str, str], tolerance: float = TOLERANCE) -> HolesCompared:
    """Which holes of one the other has too: centre and diameter within `tolerance` mm."""
    first, second = places(one), places(other)
    both = same_places(first[:, :3], second[:, :3], tolerance, (slice(2), slice(2, 3)))
    only = np.delete(first, both[:, 0], axis=0), np.delete(second, both[:, 1], axis=0)
    return HolesCompared(names, first[both[:, 0]], only, tolerance, (one.reach, other.reach))


def names_of(one: Any, other: Any) -> tuple[str, str]:
    """What both are called: their programs, and where these are called alike, their controls or their order too."""
    first, second = ("path" if isinstance(each, Toolpath) else str(each.program.title) for each in (one, other))
    if first != second:
        return first, second
    marks = ["" if isinstance(each, Toolpath) else each.control.name for each in (one, other)]
    marks = ["first", "second"] if marks[0] == marks[1] else marks
    return f"the {marks[0]} {first}", f"the {marks[1]} {second}"
