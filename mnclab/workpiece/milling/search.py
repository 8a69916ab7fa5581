"""For every cell of a map: which tip of a cutter, of all those around it, leaves the least height there.

Height and place of a tip stand in one whole number, the place below the height, so that a minimum finds both. One search
goes over the footprint as if the cutter were thinner by `SNAP` cells, which is how far a tip may be from the middle of
its cell: there it cuts for certain. Another goes over the rim, where it may.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mnclab.path.toolpath import Array, Mask
from mnclab.workpiece.milling.cutters import Cutter, edge_height

SNAP = math.sqrt(0.5)  # cells from a tip to the middle of its cell, at most
RUN = 4  # cells: longer level runs of a footprint are taken at once
BITS = 31  # of a code

Codes = NDArray[np.int32]
Cells = list[tuple[int, int, float]]


@dataclass(frozen=True)
class Footprint:
    """Cells about the tip of a cutter, all four quarters alike, up to `reach` cells away.

    `level[b]` cells to either side in row b all stand at height 0 (-1: none). `sure` and `rim` are row, column and height
    (mm) of the other cells: where the cutter cuts for certain, and where it may, `least` mm above its tip or more.
    """

    reach: int
    level: list[int]
    sure: Cells
    rim: Cells
    least: float

    @classmethod
    def of(cls, cutter: Cutter, step: float) -> Footprint:
        """That of a cutter on cells of `step` mm."""
        snap, shape = SNAP * step, [np.array(value) for value in cutter[1:]]
        reach = int((cutter.radius + snap) / step) + 1
        b, a = np.mgrid[: reach + 1, : reach + 1]
        rho = np.hypot(a, b) * step
        sure = rho + snap <= cutter.radius
        rim = ~sure & (rho - snap < cutter.radius)
        height = edge_height(np.minimum(rho + snap, cutter.radius), *shape)
        level = [int(row.sum()) - 1 for row in sure & (height <= 0)]
        level = [run if 2 * run + 1 >= RUN else -1 for run in level]
        single = sure & (a > np.array(level)[:, None])
        beyond = height + (rho + snap - cutter.radius)  # of tips at one height the nearest is asked
        least = edge_height(np.array(max(cutter.radius - 2 * snap, 0.0)), *shape)
        return cls(reach, level, _listed(single, height), _listed(rim, beyond), float(least))

    @property
    def highest(self) -> float:
        """The greatest height of a cell, mm."""
        return max((height for _, _, height in self.sure + self.rim), default=0.0)


def _listed(chosen: Mask, height: Array) -> Cells:
    return [(int(b), int(a), float(height[b, a])) for b, a in np.argwhere(chosen)]


@dataclass(frozen=True)
class Search:
    """The cells of a window as codes: how many `unit` mm above the lowest of them, and in `bits` below it their place.

    From `none` on no tip was found.
    """

    codes: Codes
    footprint: Footprint
    unit: float
    bits: int
    none: int

    @classmethod
    def over(cls, low: NDArray[np.float32], here: Mask, footprint: Footprint) -> Search:
        """Of the tips `low` where `here`: around the cells that are asked for `footprint.reach` more."""
        bits = max((low.size - 1).bit_length(), 1)
        least, span = float(low[here].min()), float(low[here].max() - low[here].min())
        unit = (span + 2 * footprint.highest) / ((1 << (BITS - bits)) - 4)
        none = math.ceil((span + footprint.highest) / unit) + 1
        codes = np.full(low.shape, none, dtype=np.int32)
        codes[here] = (low[here] - least) / unit
        codes <<= bits
        codes |= np.arange(low.size, dtype=np.int32).reshape(low.shape)
        return cls(codes, footprint, unit, bits, none << bits)

    @property
    def _inner(self) -> tuple[int, int]:
        around = 2 * self.footprint.reach
        return self.codes.shape[0] - around, self.codes.shape[1] - around

    def _places(self, best: Codes) -> tuple[Mask, NDArray[np.int32]]:
        found = best.reshape(-1)
        return found < self.none, found & ((1 << self.bits) - 1)

    def sure(self) -> tuple[Mask, NDArray[np.int32]]:
        """Whether a tip cuts each of the m inner cells for certain, and the place in the window of the one that leaves least."""
        best = np.full(self._inner, self.none, dtype=np.int32)
        self._level(best)
        self._single(self.footprint.sure, best)
        return self._places(best)

    def rim(self) -> tuple[Mask, NDArray[np.int32]]:
        """The same of tips that may cut."""
        best = np.full(self._inner, self.none, dtype=np.int32)
        self._single(self.footprint.rim, best)
        return self._places(best)

    def _level(self, best: Codes) -> None:
        """Runs at height 0: two overlapping ones, whose length is a power of two, cover each."""
        (ny, nx), reach = best.shape, self.footprint.reach
        runs, length = self.codes, 1
        for b in range(len(self.footprint.level) - 1, -1, -1):  # the longest is in the middle
            run = self.footprint.level[b]
            if run < 0:
                continue
            while 2 * length <= 2 * run + 1:
                runs, length = np.minimum(runs[:, :-length], runs[:, length:]), 2 * length
            for row in {reach - b, reach + b}:
                for column in (reach - run, reach + run + 1 - length):
                    np.minimum(best, runs[row : row + ny, column : column + nx], out=best)

    def _single(self, cells: Cells, best: Codes) -> None:
        """Cells of a quarter one by one, row after row; their mirror images stand at the same height."""
        (ny, nx), reach = best.shape, self.footprint.reach
        row, both, near = -1, self.codes, np.empty_like(best)
        for b, a, height in cells:
            if b != row:
                row, both = b, np.minimum(self.codes[reach - b : reach - b + ny], self.codes[reach + b : reach + b + ny])
            np.minimum(both[:, reach - a : reach - a + nx], both[:, reach + a : reach + a + nx], out=near)
            near += int(height / self.unit) << self.bits
            np.minimum(best, near, out=best)
