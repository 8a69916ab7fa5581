"""The positions of the axes of a machine at the end of every row of a path."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Unpack

import numpy as np
from numpy.typing import NDArray

from mnclab.machine.axes import CHAIN, lengths_of_rows, references
from mnclab.path.listing import figure
from mnclab.path.toolpath import Array, Toolpath
from mnclab.runs.history import History
from mnclab.text.alarm import Absent, several
from mnclab.text.given import FigureOptions, choice, fitting_class, shown
from mnclab.text.tables import Columned, Pictured, html_table, text_table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from mnclab.path.profile import Profile

NAMES = "XYZABC"
SHOWN = 20  # rows, of more the first and the last


@fitting_class
class AxisPositions(Pictured, Columned):
    """`X`, `Y`, `Z` (n,) of the spindle reference, mm, `A`, `B`, `C`, degrees, never reduced to a turn: machine coordinates.

    As an array (n, 6). `line` (n,) is that of the row of the path, `lengths` (n,), mm, those of the tool.

    >>> run = mnc.run("T1\\nG0 X10 Z5\\n", "mnc", tools={1: mnc.Tool(length=80)})
    >>> run.axes().Z.tolist()
    [0.0, 85.0]
    """

    def __init__(self, path: Toolpath, history: History, first: float) -> None:
        changes = history.changed("tool")
        self.lengths, self._chains = lengths_of_rows(path.step, changes, first), history.changed(CHAIN)
        found = references(path, path.end, np.arange(len(path)), self.lengths, self._chains)
        self.path, self.line = path, path.line
        self._axes = np.concatenate([found, np.degrees(path.rotary).round(12)], axis=1)  # 30 degrees in rad and back are not 30
        self.X, self.Y, self.Z, self.A, self.B, self.C = self._axes.T

    def __len__(self) -> int:
        return len(self._axes)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> Array:
        return np.array(self._axes, dtype=dtype)

    def __getitem__(self, which: Any) -> Array:
        """A column by its name, or rows (…, 6) by their numbers."""
        if not isinstance(which, str):
            try:
                return np.asarray(self._axes[which])
            except IndexError:
                raise Absent(f"the axes have {several(len(self), 'row')}: there is no row {shown(which)}") from None
        column: Array = getattr(self, choice(which, "an axis", NAMES))
        return column

    def course(self) -> tuple[Array, Array]:
        """X Y Z A B C (m, 6) along the rows, within arcs too, and the row (m,) with the part of it that is done by then."""
        points, row = self.path.points()
        found = references(self.path, points, row, self.lengths, self._chains)
        _, which, count = np.unique(row, return_inverse=True, return_counts=True)
        count[:1] -= 1  # the path begins at the first point
        done = (np.arange(len(row)) - (np.cumsum(count) - count)[which]) / count[which]
        return np.concatenate([found, np.degrees(self.path.rotary[row])], axis=1), row + done

    def columns(self) -> dict[str, NDArray[Any]]:
        return {"line": self.line, **{name: self[name] for name in NAMES}}

    def rows(self) -> list[tuple[str, ...]]:
        """The first and the last, as people read them."""
        n = len(self)
        shown = range(n) if n <= SHOWN else [*range(SHOWN // 2), *range(n - SHOWN // 2, n)]
        found = [(str(self.line[k]), *(figure(value, 4) for value in self._axes[k].tolist())) for k in shown]
        if n > SHOWN:
            found.insert(SHOWN // 2, ("…",) * 7)
        return found

    def __str__(self) -> str:
        return text_table(("line", *NAMES), self.rows(), range(7))

    def __repr__(self) -> str:
        return f"<AxisPositions: {several(len(self), 'row')}>"

    def _repr_html_(self) -> str:
        return html_table(("line", *NAMES), self.rows(), numbers=range(7))

    def plot(self, profile: Profile | None = None, **options: Unpack[FigureOptions]) -> Figure:
        """A small curve of every axis that moves, over the rows, or over the time, s, of a `profile` of the run."""
        from mnclab.show.plot.axes import plot_axes

        return plot_axes(self, profile, **options)
