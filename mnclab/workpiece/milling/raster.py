"""The map of a milled part: square cells over the blank, and the sweep of moves over them, tile by tile.

In a tile few moves are looked at, all of them at once. What is asked for decides the order: only the heights (`lowered`:
deep moves first, those that cannot reach the material any more are left out), or what each move took away (`in_order`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mnclab.path.toolpath import Array, Index
from mnclab.text.alarm import Alarm
from mnclab.workpiece.milling.moves import Moves
from mnclab.workpiece.milling.swept import left_by

TILE, SMALL = 32, 8  # cells of a tile's side, and of one where the moves go in order and are many
AT_ONCE = 1 << 17  # points times moves that are looked at together
FEW, PAIRS = 64, 1 << 14  # points, and points times moves, beyond which points are looked at quarter by quarter
NOISE = 1e-9  # mm: less than this is rounding, and nothing taken away
CELLS, ROW = 25_000_000, 25_000  # at most


@dataclass(frozen=True)
class Raster:
    """Square cells of `step` mm from a corner `low` (x, y); `shape` is (ny, nx)."""

    low: tuple[float, float]
    step: float
    shape: tuple[int, int]

    @classmethod
    def over(cls, bounds: Array, step: float) -> Raster:
        """Cells over a box (2, 3), no wider than its shorter side; the last of a row or column may stand over."""
        (x0, y0), (x1, y1) = bounds[:, :2].tolist()
        step = min(step, x1 - x0, y1 - y0)
        wanted = [float(np.ceil(side / step - 1e-9)) for side in (y1 - y0, x1 - x0)]
        if not wanted[0] * wanted[1] <= CELLS:
            least = float(np.sqrt((x1 - x0) * (y1 - y0) / CELLS))
            found = f"{step:g} mm makes {wanted[0] * wanted[1]:.3g} over {x1 - x0:g} × {y1 - y0:g} mm"
            hint = f"step={2 * least:.2g} is possible"
            raise Alarm(f"a workpiece has at most {CELLS:,} cells, and a step of {found}", hint=hint)
        if max(wanted) > ROW:
            found = f"{max(wanted):.3g} cells of {step:g} mm in a row over {x1 - x0:g} × {y1 - y0:g} mm"
            raise Alarm(f"a workpiece has at most {ROW:,} cells in a row, and would have {found}", hint="take a wider blank")
        count = [int(number) for number in wanted]
        return cls((x0, y0), step, (count[0], count[1]))

    @property
    def x(self) -> Array:
        """The middles of the cells of a row (nx,)."""
        return np.asarray(self.low[0] + self.step * (np.arange(self.shape[1]) + 0.5))

    @property
    def y(self) -> Array:
        """The middles of the cells of a column (ny,)."""
        return np.asarray(self.low[1] + self.step * (np.arange(self.shape[0]) + 0.5))

    def tiles(self, side: int = TILE) -> Iterator[tuple[slice, slice]]:
        """Rows and columns of every tile of so many cells a side."""
        for j in range(0, self.shape[0], side):
            for i in range(0, self.shape[1], side):
                yield slice(j, min(j + side, self.shape[0])), slice(i, min(i + side, self.shape[1]))

    @property
    def tile(self) -> float:
        """The side of a tile, mm."""
        return self.step * TILE

    def middles(self, tile: tuple[slice, slice]) -> tuple[Array, Array]:
        """x and y of the cells of a tile (m,), row by row."""
        y, x = np.meshgrid(self.y[tile[0]], self.x[tile[1]], indexing="ij")
        return x.ravel(), y.ravel()


def near(moves: Moves, boxes: Array, x: Array, y: Array, below: float) -> Index:
    """The moves that may reach one of some points lower than `below`; `boxes` are those of the moves."""
    return _reaching(moves, boxes, x, y, below)[0]


def _reaching(moves: Moves, boxes: Array, x: Array, y: Array, below: float) -> tuple[Index, Array]:
    """Those moves, and what they leave at least (k,)."""
    found = _over(moves, boxes, x, y, below)
    least = _least(moves, found, x, y)
    reach = least < below
    return found[reach], least[reach]


def _over(moves: Moves, boxes: Array, x: Array, y: Array, below: float) -> Index:
    """The moves that are somewhere lower than `below` and whose boxes meet that of the points."""
    low, high = boxes[:, :2] <= (x.max(), y.max()), boxes[:, 2:] >= (x.min(), y.min())
    return np.flatnonzero(low.all(axis=1) & high.all(axis=1) & (moves.low < below))


def _least(moves: Moves, which: Index, x: Array, y: Array) -> Array:
    """What some moves (k,) leave at least at points, infinite where they reach none of them (k,).

    A cutter that is wider by the way from the middle of the points to their corners leaves no less in the middle.
    """
    if not len(which):
        return np.zeros(0)
    x0, y0, x1, y1 = x.min(), y.min(), x.max(), y.max()
    some, more = moves[which], np.hypot(x1 - x0, y1 - y0) / 2 + 1e-9
    wide = some.with_cutter(np.stack([some.radius + more, some.flat + more, some.corner, some.slope], axis=1))
    return left_by(wide, np.array([(x0 + x1) / 2]), np.array([(y0 + y1) / 2]))[:, 0] - NOISE


def chunks(found: Index, points: int) -> Iterator[Index]:
    """Moves, so many of them at a time as may be looked at together at a number of points."""
    many = max(AT_ONCE // max(points, 1), 1)
    return (found[first : first + many] for first in range(0, len(found), many))


def lowered(moves: Moves, boxes: Array, x: Array, y: Array, top: Array) -> Array:
    """The heights (m,) that all moves leave together at points whose material reaches up to `top` (m,)."""
    found, heights = _over(moves, boxes, x, y, float(top.max())), top.copy()
    if len(found) * len(x) <= PAIRS:  # what all leave is found sooner than which of them count
        return np.minimum(heights, left_by(moves[found], x, y).min(axis=0, initial=np.inf))
    _lower(moves, found, _least(moves, found, x, y), x, y, heights, np.arange(len(x)))
    return heights


def _lower(moves: Moves, found: Index, least: Array, x: Array, y: Array, heights: Array, points: Index) -> None:
    """Lowers heights at points to what the found moves leave, at `least` each; quarter by quarter where both are many."""
    px, py = x[points], y[points]
    order = np.argsort(least, kind="stable")
    order = order[: np.searchsorted(least[order], heights[points].max())]
    found, least = found[order], least[order]
    apart = len(points) > FEW and max(np.ptp(px), np.ptp(py)) > NOISE
    if apart and len(found) * len(points) > PAIRS:
        right, upper = px > (px.min() + px.max()) / 2, py > (py.min() + py.max()) / 2
        for quarter in (right & upper, right & ~upper, ~right & upper, ~right & ~upper):
            if quarter.any():
                _lower(moves, found, _least(moves, found, px[quarter], py[quarter]), x, y, heights, points[quarter])
        return
    here = heights[points]
    for first in range(0, len(found), many := max(PAIRS // len(points), 1)):
        if least[first] >= here.max():
            break
        np.minimum(here, left_by(moves[found[first : first + many]], px, py).min(axis=0), out=here)
    heights[points] = here


def in_order(moves: Moves, boxes: Array, x: Array, y: Array, top: Array) -> Iterator[tuple[Index, Array, Array]]:
    """For some moves after the other: which (k,), the heights before each of them and what each leaves (k, m).

    A move may leave more than was there: it took nothing.
    """
    heights = top.copy()
    found, least = _reaching(moves, boxes, x, y, float(top.max()))
    many = max(PAIRS // len(x), FEW)
    for first in range(0, len(found), many):
        chunk = found[first : first + many][least[first : first + many] < heights.max()]
        if not len(chunk):
            continue
        left = left_by(moves[chunk], x, y)
        upto = np.minimum.accumulate(np.concatenate([heights[None], left]), axis=0)
        yield chunk, upto[:-1], left
        heights = upto[-1]
