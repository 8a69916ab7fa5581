"""What is left of a blank after some rows of a path: the face that the milled and the turned part share."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Self, Unpack

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.path.toolpath import Array, Index
from mnclab.text.alarm import Alarm
from mnclab.text.given import PartBodyOptions, PartOptions, check_point, choice, fitting_class
from mnclab.text.opening import opened
from mnclab.text.tables import Rounded
from mnclab.workpiece.ahead import Ahead
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.clamped import Clamped, Placement
from mnclab.workpiece.cutting import Cutting

if TYPE_CHECKING:
    import pyvista
    from matplotlib.figure import Figure

    from mnclab.design.difference.difference import Difference
    from mnclab.geometry.contours import Contour
    from mnclab.workpiece.milling.moves import Moves
    from mnclab.workpiece.part import Part

SHARES = ("line", "tool", "row")
ROUNDING = 1e-6  # mm: errors up to here are those of numbers, not of a method


class Solid(NamedTuple):
    """A closed surface: `points` (n, 3) mm, `triangles` (m, 3) seen counter-clockwise from outside.

    `row` (m,) is the row of the path that cut a triangle, -1 where the blank is untouched.
    """

    points: Array
    triangles: NDArray[np.int64]
    row: NDArray[np.int64]

    @property
    def volume(self) -> float:
        """mm³, by the divergence theorem."""
        a, b, c = self.points[self.triangles].transpose(1, 0, 2)
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6)


@fitting_class
class Workpiece(ABC):
    """What is left of `cutting.stock`, in the coordinates of the path. It does not change; a copy is itself.

    `method` says how it was found, `error` (mm) how far a surface may be off, `notes` what this picture of the part
    cannot hold and which rows it leaves out. It is the next blank where a Setup is given it as its stock: as it stands, or
    `turned_over`, `turned` about Z, `moved`.

    >>> slot = "T1 S800 M3\\nG0 X-10 Y10 Z-5\\nG1 X90 F100\\n"
    >>> run = mnc.run(slot, "mnc", tools={1: mnc.Tool(diameter=10)}, stock=(80, 60, 20))
    >>> print(f"{run.workpiece().removed:.3f}")  # 80 x 10 x 5
    4000.000
    """

    cutting: Cutting
    whole: Callable[[], Workpiece] | None = None  # the part at the end of the run, of one that is told after a row before
    method: str
    error: float
    notes: tuple[str, ...]

    @property
    @abstractmethod
    def volume(self) -> float:
        """What is left, mm³."""

    @cached_property
    def removed(self) -> float:
        """What was taken away, mm³; of a turned part without what fell off."""
        return self._removed if self.whole is None else float(self.removed_by_row().sum())

    @property
    @abstractmethod
    def _removed(self) -> float:
        """What all rows took away, as exactly as it is known."""

    @property
    @abstractmethod
    def _by_row(self) -> Array:
        """What each row took away (n,), scaled to that sum."""

    def removed_by_row(self) -> Array:
        """What each row of the path took away (n,), mm³; the sum is `removed`.

        A row took away the same whether it is asked at the end of a run or of the part after a row: that part has its share of
        the volumes of the whole, so that what was removed up to a line is the sum over the lines before.
        """
        return self._by_row if self.whole is None else self.whole().removed_by_row()[: len(self.cutting)]

    @abstractmethod
    def reach(self, rows: Index) -> Array:
        """The shares (2, k) of rows of the path between which a tool may meet material."""

    @abstractmethod
    def ahead(self, rows: Index, share: Array) -> Ahead:
        """What stands before the tool when a share (k,) of rows of the path is behind; nothing where it is not known."""

    @abstractmethod
    def at_most(self, rows: Index) -> Ahead:
        """No less than `ahead` tells anywhere on rows (k,) of the path."""

    @abstractmethod
    def cut(self, plane: str, at: float = 0.0) -> list[Contour]:
        """A section: closed contours of the material in a plane "XY", "XZ" or "YZ" (a lathe: "ZX") at a coordinate, mm."""

    @property
    @abstractmethod
    def part(self) -> Part:
        """What a probe touches."""

    @abstractmethod
    def solid(self) -> Solid:
        """The part as a closed surface."""

    # --- as the next blank -------------------------------------------------------------------------------------------

    @property
    def bounds(self) -> Array:
        """The box of the blank (2, 3): what is left lies within it."""
        return np.asarray(self.cutting.stock.bounds)

    @abstractmethod
    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """How low and how high the material reaches at points (m,), exact; nan where there is none."""

    @abstractmethod
    def outline(self, right: int, up: int) -> list[Array]:
        """What a view along an axis shows: closed lines (k, 2) in the coordinates `right` and `up` (0 to 2)."""

    @abstractmethod
    def edges(self) -> list[Array]:
        """Lines (k, 3) that show it in space."""

    def half_section(self) -> tuple[list[Contour], float] | None:
        """Of a turned part: closed contours (z, r), mm, and where its axis stands in x."""
        return None

    @abstractmethod
    def made_by(self) -> Iterator[tuple[Moves, Placement]]:
        """The moves of a mill that cut it, the last clamping first, and where each of these clampings stands now."""

    @abstractmethod
    def _uncut(self, stock: Blank) -> Self:
        """Another blank on the same machine, before anything cuts it."""

    def __deepcopy__(self, memo: Any) -> Self:
        return self

    def _clamped(self) -> Clamped:
        """As a blank, in the coordinates of the path."""
        stock = self.cutting.stock
        return stock if isinstance(stock, Clamped) and not len(self.cutting) else Clamped(self)

    def as_blank(self) -> Blank:
        """As a blank, in machine coordinates: where the part stood when it was cut."""
        return self._clamped().moved(self.cutting.origin)

    def turned_over(self, axis: str = "x") -> Self:
        """The part turned by half a turn about X or Y, through the middle of the box of its blank.

        It takes up the same box as before, so that a program with the same datum reaches its other side; on a lathe it is
        turned end for end.
        """
        return self._uncut(self._clamped().turned_over(axis))

    def turned(self, degrees: float) -> Self:
        """The part turned about Z, counter-clockwise seen from above, about the middle of the box of its blank."""
        return self._uncut(self._clamped().turned(degrees))

    def moved(self, by: ArrayLike) -> Self:
        """The part clamped elsewhere, (3,) mm away."""
        check_point(by, "how far a part is moved (mm)")
        return self._uncut(self._clamped().moved(by))

    def removed_by(self, what: str = "line") -> dict[int, float]:
        """mm³ by "line" (of the main program or a called one), "tool" or "row"; the values sum to `removed`."""
        choice(what, "what removed_by sums over", SHARES)
        volumes = self.removed_by_row()
        keys = self.cutting.numbers if what == "tool" else np.arange(len(volumes))
        if what == "line":
            keys = self.cutting.path.line.astype(np.int64)
        known, index = np.unique(keys, return_inverse=True)
        sums = np.bincount(index, volumes, minlength=len(known))
        return Rounded({int(key): float(total) for key, total in zip(known, sums) if total != 0})

    def compare(self, target: Any, tolerance: float = 0.05) -> Difference:
        """How it differs from a design, or from that of a TOML file; see `design.difference`. `tolerance` in mm."""
        found: Difference = opened("mnclab.design.difference.comparing", "compare")(self, target, tolerance)
        return found

    # --- doors -------------------------------------------------------------------------------------------------------

    def plot(self, **options: Unpack[PartOptions]) -> Figure:
        """The part from above in shaded relief, or the half section of a lathe; see `show.plot.part.plot_part`."""
        from mnclab.show.plot.part import plot_part

        return plot_part(self, **options)

    def scene(self, colour: str = "depth", **options: Unpack[PartBodyOptions]) -> pyvista.Plotter:
        """The part as a body (needs pyvista); see `show.scene.part_body`."""
        from mnclab.show.scene import part_body

        return part_body(self, colour, **options)

    def save(self, path: str | Path, **options: Unpack[PartOptions]) -> Path:
        """Write one file; the suffix says what: stl, gltf, glb, vtk (the body), svg, pdf, png (the picture), csv."""
        from mnclab.show.export_mesh import save

        return save(self, path, **options)

    @property
    def error_told(self) -> str:
        """How far a surface may be off, in words; nothing where it is no more than the rounding of numbers."""
        return f", within {1000 * self.error:.3g} µm" if self.error > ROUNDING else ""

    def _repr_html_(self) -> str:
        picture: Any = self.plot()
        return str(picture.html(2.0))

    def __repr__(self) -> str:
        told = f"{self.volume:.3f} mm³ left, {self.removed:.3f} mm³ removed"
        head = f"<{type(self).__name__}: {told}; {self.method}{self.error_told}>"
        return "\n".join([head, *(f"  note: {note}" for note in self.notes)])


def no_blank() -> Alarm:
    """The alarm of a workpiece without a blank."""
    hint = "the blank is two corners or a cylinder: Setup(stock=((0, 0, -20), (60, 40, 0))), or BLK FORM in the program"
    return Alarm("there is no blank to cut", hint=hint)
