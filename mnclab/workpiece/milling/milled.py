"""What a mill leaves of a blank: a map of heights, exact at the middles of its cells, and at any point that is asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.geometry.contours import Contour
from mnclab.path.toolpath import Array, Index, Kind
from mnclab.text.alarm import Alarm, several
from mnclab.text.given import check_number, choice, fitting_class, shown
from mnclab.workpiece.blank import Blank, Revolved
from mnclab.workpiece.clamped import Clamped, Placement, from_side
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.milling import volumes
from mnclab.workpiece.milling.engaged import Engaged
from mnclab.workpiece.milling.erosion import ERROR, ManyMoves
from mnclab.workpiece.milling.gaps import Gaps
from mnclab.workpiece.milling.moves import CHORD, STILL, Moves, moves_of
from mnclab.workpiece.milling.raster import NOISE, Raster
from mnclab.workpiece.milling.sections import Shadow, UprightSection, level, traced, upright
from mnclab.workpiece.milling.solid import creases
from mnclab.workpiece.milling.sweep import Mapped, Sweep
from mnclab.workpiece.milling.tilted import error_of, left_out, tilted_groups
from mnclab.workpiece.milling.touched import Touched
from mnclab.workpiece.part import Part
from mnclab.workpiece.turning.revolved import overhangs
from mnclab.workpiece.workpiece import Solid, Workpiece

# What a map of heights cannot hold of a milled part, in sentences for people.

MANY = 20_000  # moves, beyond which undercuts are not looked for
THREADS = ("tap", "thread mill")


def notes_of(cutting: Cutting, sweep: Sweep) -> Iterator[str]:
    """What is left out, and what looks other than it is."""
    yield from cutting.notes()
    cuts = cutting.cuts
    for out, what in left_out(cutting):
        if (out := out & cuts).any():
            number = int(out.sum())
            yield f"{several(number, 'row')} {what} {'is' if number == 1 else 'are'} left out ({cutting.lines(out)})"
    for kind in THREADS:
        numbers = [number for number, tool in enumerate(cutting.tools) if tool.kind == kind]
        if (threads := cuts & (cutting.path.kind != Kind.RAPID) & np.isin(cutting.which, numbers)).any():
            yield f"a thread is shown without its flanks, at the radius of the {kind} ({cutting.lines(threads)})"
    necks = np.array([_neck(tool.shank, tool.effective_radius) for tool in cutting.tools])[cutting.which]
    thin, under = cuts & np.isfinite(necks), np.zeros(len(cutting), dtype=bool)
    if thin.any() and len(sweep.moves) > MANY:
        yield f"undercuts are not looked for; there may be some where a tool is thinner above ({cutting.lines(thin)})"
    elif thin.any():
        under[undercuts(necks, sweep)] = True
    if under.any():
        yield f"what overhangs an undercut is not shown: there the part is open upwards ({cutting.lines(under)})"
    half = cutting.stock.half_section() if hasattr(cutting.stock, "half_section") else None
    if half is not None and overhangs(half[0]):
        yield "what overhangs in the turned blank is not shown: seen from above it is full down to its lowest place"
    if isinstance(cutting.stock, Revolved) and cutting.stock.axis != "Z" and cutting.stock.bore > 0:
        yield "the bore of a lying blank is not shown"


def undercuts(necks: Array, sweep: Sweep) -> Index:
    """Rows that take a tool sideways under material that reaches above its edges, which are `necks` (n,) high, mm."""
    moves, rows = sweep.moves, []
    neck = necks[moves.row]
    sideways = (np.hypot(*(moves.end - moves.start)[:, :2].T) > STILL) | moves.arc
    for tile in sweep.tiles:
        x, y = sweep.raster.middles(tile)
        for which, before, after in sweep.in_order(x, y):
            over = (before > after + neck[which, None] + NOISE).any(axis=1) & sideways[which]
            rows.append(moves.row[which[over]])
    return np.unique(np.concatenate([np.zeros(0, dtype=np.int64), *rows]))


def _neck(shank: tuple[float, float] | None, radius: float) -> float:
    """How far above the tip a tool becomes thinner, mm; infinite where it does not."""
    return shank[1] if shank is not None and shank[0] < radius - NOISE else np.inf



CELLS, FEWEST = 400, 4  # along the longer side by default, and across a strip
EXACT = 20_000  # moves that are swept exactly
PLANES = ("XY", "XZ", "YZ")
COARSE = 150  # cells along the longer side, of the lines that show it in space
HOLLOW = 1e-3  # mm of a column, from which on a gap is one
ALONG = 4  # samples of an upright section for each cell, before it is looked at closer


@fitting_class
class Milled(Engaged):
    """`x` (nx,), `y` (ny,): middles of the cells; `heights` (ny, nx) mm: the top of the material there.

    `floor` (ny, nx) is the lower side of the blank, which the heights do not pass: where nothing is left, both are equal.
    """

    def __init__(
        self, cutting: Cutting, step: float | None = None, whole: Callable[[], Workpiece] | None = None
    ) -> None:
        self.cutting, self.whole = cutting, whole
        bounds = cutting.stock.bounds
        if step is not None:
            check_number(step, "the step of a workpiece (mm)", above=0)
        if step is None:
            shorter, longer = sorted((bounds[1] - bounds[0])[:2].tolist())
            step = min(longer / CELLS, shorter / FEWEST)
        self.raster = Raster.over(bounds, float(step))
        self.step = self.raster.step
        self.moves: Moves = moves_of(cutting)
        self.tilted = tilted_groups(cutting)
        before = cutting.stock.gaps if isinstance(cutting.stock, Clamped) else None
        groups = self.tilted + (before.groups if before else ())
        gaps = Gaps(groups, bounds, before) if groups else None
        self.sweep = Sweep(self.raster, self.moves, self.blank_at, float(bounds[1, 2]), gaps=gaps)
        self.many = ManyMoves(self.sweep) if len(self.moves) > EXACT else None
        self.method, self.error = "exact sweep", CHORD if self.moves.chords else NOISE
        if self.many:
            self.method, self.error = "erosion of the height raster", ERROR * self.step
        self.error = max(self.error, getattr(cutting.stock, "error", 0.0), error_of(cutting))

    @property
    def x(self) -> Array:
        return self.raster.x

    @property
    def y(self) -> Array:
        return self.raster.y

    @cached_property
    def notes(self) -> tuple[str, ...]:  # type: ignore[override]
        of_map = ("level sections, solids and pictures follow the map: a wall stands within a cell",) if self.many else ()
        of_cells = ("what overhangs is shown by cells in solids and scenes, not from above",) if self.hollow else ()
        return *notes_of(self.cutting, self.sweep), *of_map, *of_cells

    @cached_property
    def heights(self) -> Array:
        if self.many and not self.sweep.gaps:
            return self.many.heights
        found = np.empty(self.raster.shape)
        top, floor = self.sweep.blank
        for tile in self.raster.tiles():
            x, y = self.raster.middles(tile)
            if self.many and self.sweep.gaps:
                here = self.sweep.gaps.sides(x, y, self.many.heights[tile].ravel(), floor[tile].ravel())[0]
            else:
                here = self.sweep.within(x, y, top[tile].ravel(), floor[tile].ravel())
            found[tile] = here.reshape(found[tile].shape)
        return found

    @cached_property
    def floor(self) -> Array:
        return np.asarray(self.surface.over(self.surface.sides)[1]) if self.sweep.gaps else self.sweep.blank[1]

    def blank_at(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Upper and lower side of the blank at points (m,); beside it both are its lowest place."""
        low = float(self.cutting.stock.bounds[0, 2])
        floor, top = self.cutting.stock.faces(x, y)
        return np.where(np.isnan(top), low, top), np.where(np.isnan(floor), low, floor)

    @cached_property
    def surface(self) -> Sweep:
        """What sections, solids and pictures ask for heights: the exact sweep, of very many moves the map."""
        sweep = self.sweep
        if not self.many:
            return sweep
        return Mapped(sweep.raster, sweep.moves, sweep.faces, sweep.top, self.many.heights, gaps=sweep.gaps)

    def at(self, x: ArrayLike, y: ArrayLike) -> Array | float:
        """The height of the material at a place or at places, mm: exact, whatever the step."""
        px, py = _places(x, y)
        found = self.sweep.at(px.ravel(), py.ravel())
        return found.reshape(px.shape) if px.ndim else float(found[0])

    @cached_property
    def cut_by(self) -> NDArray[np.int64]:
        """The row of the path that cut a cell last (ny, nx), -1 where none did."""
        if self.many:
            move = self.many.in_order[0]
            return self._of_gaps(np.where(move < 0, -1, self.moves.row[move]))
        found = np.full(self.raster.shape, -1, dtype=np.int64)
        for tile in self.sweep.tiles if len(self.moves) else ():
            x, y = self.raster.middles(tile)
            last = np.full(len(x), -1)
            for which, before, after in self.sweep.in_order(x, y):
                cut = before - after > NOISE
                any_ = cut.any(axis=0)
                last[any_] = self.moves.row[which[len(which) - 1 - cut[::-1].argmax(axis=0)]][any_]
            found[tile] = last.reshape(found[tile].shape)
        return self._of_gaps(found)

    def _of_gaps(self, found: NDArray[np.int64]) -> NDArray[np.int64]:
        """The same where a tilted tool has made the top."""
        if (gaps := self.sweep.gaps) is None:
            return found
        for tile in self.raster.tiles():
            row = gaps.last(*self.raster.middles(tile), self.heights[tile].ravel()).reshape(found[tile].shape)
            found[tile] = np.where(row >= 0, row, found[tile])
        return found

    @property
    def volume(self) -> float:
        return self.blank_volume - self.removed

    @property
    def _removed(self) -> float:
        if not len(self.moves) and not self.tilted:
            return 0.0
        if self.many and self.sweep.gaps:
            return self.many.removed + float(self.sweep.over(self._by_tilted).sum()) * self.step**2
        return self.many.removed if self.many else volumes.removed(self.sweep, self.heights)

    def _by_tilted(self, x: Array, y: Array) -> Array:
        """How much (m,), mm, tilted tools take besides very many upright moves, at points close together."""
        assert self.sweep.gaps is not None
        top, floor = replace(self.surface, gaps=None).sides(x, y)
        return self.sweep.gaps.taken(x, y, top, top, floor)

    @cached_property
    def _by_row(self) -> Array:
        """On a coarser lattice than the whole, whose sum they are scaled to."""
        if self.many:
            found = np.zeros(len(self.cutting))
            np.add.at(found, self.moves.row, self.many.in_order[1])
            return found
        rows = volumes.removed_by_row(self.sweep, len(self.cutting))
        return rows * (self.removed / rows.sum()) if rows.any() else rows

    @cached_property
    def blank_volume(self) -> float:
        return float(self.cutting.stock.volume)

    def cut(self, plane: str, at: float = 0.0) -> list[Contour]:
        plane = choice(plane, "the plane of a section", PLANES)
        check_number(at, f"where the section {plane} is (mm)")
        (x0, y0, _), (x1, y1, _) = self.cutting.stock.bounds.tolist()
        if plane == "XY":
            return level(self.surface, at, *self._around)
        if self.sweep.gaps:
            along = 0 if plane == "XZ" else 1
            return traced(UprightSection(self.surface, at, along), self._around[along], self._upwards)
        if plane == "XZ":
            return upright(lambda x: self._sides(x, np.full_like(x, at)), x0, x1, self.step / ALONG)
        return upright(lambda y: self._sides(np.full_like(y, at), y), y0, y1, self.step / ALONG)

    @property
    def _around(self) -> tuple[Array, Array]:
        """The middles of the cells, and of one more on every side."""
        edges = (self.step * (np.arange(-1, n + 1) + 0.5) for n in reversed(self.raster.shape))
        x, y = (np.asarray(low + places) for low, places in zip(self.raster.low, edges))
        return x, y

    @property
    def _upwards(self) -> Array:
        """Heights a cell apart, from below the part to above it."""
        low, high = self.bounds[:, 2].tolist()
        return np.asarray(low + self.step * (np.arange(-1, int(np.ceil((high - low) / self.step)) + 1) + 0.5))

    @cached_property
    def _shadow(self) -> list[Contour]:
        return traced(Shadow(self.surface, 0.0), *self._around)

    def outline(self, right: int, up: int) -> list[Array]:
        if {right, up} == {0, 1}:
            return [each.points_within(CHORD)[:, [right, up]] for each in self._shadow]
        gone = self.heights - self.floor <= NOISE
        floor, top = (np.where(gone, np.nan, side) for side in (self.floor, self.heights))
        return from_side(self.x, self.y, floor, top, right, up)

    def edges(self) -> list[Array]:
        from mnclab.workpiece.milling.solid import solid_of

        return creases(solid_of(self, max(self.step, float(np.ptp(self.bounds[:, :2], axis=0).max()) / COARSE)))

    def _sides(self, x: Array, y: Array) -> tuple[Array, Array]:
        """The upper and the lower side of the material at points (m,)."""
        return self.sweep.sides_at(x, y)

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """Exact; of very many moves between the middles of the cells."""
        x, y = np.atleast_1d(np.asarray(x, np.float64), np.asarray(y, np.float64))
        if x.shape != y.shape:
            raise Alarm(f"faces are asked for at points (x, y), got {x.size} x and {y.size} y")
        top, floor = self.surface.sides_at(x, y)
        solid = top - floor > NOISE
        return np.where(solid, floor, np.nan), np.where(solid, top, np.nan)

    def made_by(self) -> Iterator[tuple[Moves, Placement]]:
        yield self.moves, Placement()
        yield from self.tilted
        if isinstance(self.cutting.stock, Clamped):
            yield from self.cutting.stock.made_by()

    def _uncut(self, stock: Blank) -> Milled:
        return Milled(self.cutting.uncut(stock), self.step)

    @property
    def part(self) -> Part:
        return Touched(self.cutting.stock, self.moves, self.tilted).part

    @cached_property
    def hollow(self) -> bool:
        """Whether tilted tools have cut so that material stands over what they took."""
        gaps = self.sweep.gaps
        if gaps is None:
            return False
        left = self.sweep.over(lambda x, y: gaps.left(x, y, *self.surface.sides(x, y)))
        least = self.step if self.error > CHORD else HOLLOW  # beside a floor cut piece by piece thin slivers stand
        return bool((self.heights - self.floor - left > least).any())

    def solid(self) -> Solid:
        """The top with its walls at their true places, the sides and the lower side of the blank; of a hollow part cells."""
        from mnclab.workpiece.milling.solid import of_cells, solid_of

        return of_cells(self) if self.hollow else solid_of(self)


def _places(x: ArrayLike, y: ArrayLike) -> tuple[Array, Array]:
    """Places as arrays of one shape; an Alarm unless they are finite numbers."""
    try:
        found = np.broadcast_arrays(np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64))
    except (TypeError, ValueError):
        found = ()
    if not found or not all(np.isfinite(each).all() for each in found):
        raise Alarm(f"a place on a part is finite numbers x and y, mm, or arrays that go together, got {shown(x)} and {shown(y)}")
    return found[0], found[1]
