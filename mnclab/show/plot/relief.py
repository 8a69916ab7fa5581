"""A milled part from above as light and shadow: pixels with their exact heights, lit from the upper left.

A pixel takes the smaller of the slopes to its neighbours, so that an edge stays crisp; where they differ much the edge is
drawn dark. A wall throws a short shadow.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mnclab.path.toolpath import Array, Mask
from mnclab.workpiece.milling.lattice import THIN, Lattice, heights_at, lattice_of, rows_at

if TYPE_CHECKING:
    from mnclab.workpiece.milling.milled import Milled

CELLS, PARTS = 360, 3  # of the longer side, and pixels of the side of a cell
LIGHT = np.array([-0.55, 0.6, 1.0])  # towards the light
LONG = 30  # pixels, of the longest shadow
DARK, DIM, BRIGHT = 0.62, 0.72, 1.1  # the darkest slope, a shadow, the brightest slope; a level floor is 1
CREASE, LINE = 0.45, 0.6  # difference of two slopes at an edge, and how light that is
CURVED = 0.08  # of a cell: how far its corners may lie off one plane before its pixels are exact


class Relief(NamedTuple):
    """Heights (ny, nx) of pixels, mm, how light they are, where there is material; `box` x0, x1, y0, y1."""

    z: Array
    light: Array
    solid: Mask
    box: tuple[float, float, float, float]
    lattice: Lattice
    x: Array
    y: Array

    def rows(self, workpiece: Milled) -> NDArray[np.int64]:
        """The row that cut each pixel last (ny, nx), -1 where none did."""
        y, x = (each.ravel() for each in np.meshgrid(self.y, self.x, indexing="ij"))
        return rows_at(workpiece, x, y, self.z.ravel()).reshape(self.z.shape)


def relief(workpiece: Milled) -> Relief:
    """The part from above."""
    low, high = workpiece.cutting.stock.bounds[:, :2]
    found = lattice_of(workpiece, float((high - low).max()) / CELLS)
    z = _pixels(workpiece, found)
    size = np.array([found.x[1] - found.x[0], found.y[1] - found.y[0]]) / PARTS
    x, y = (ends[0] + side * (np.arange(count) + 0.5) for ends, side, count in zip((found.x, found.y), size, z.shape[::-1]))
    floor = workpiece.blank_at(*(each.ravel() for each in np.meshgrid(x, y)))[1].reshape(z.shape)
    box = (float(low[0]), float(high[0]), float(low[1]), float(high[1]))
    return Relief(z, _lit(z, *size.tolist()), z - floor > THIN, box, found, x, y)


def _pixels(workpiece: Milled, found: Lattice) -> Array:
    """Heights of pixels: between the nodes of a cell, and exact in a cell that a wall or an edge crosses."""
    ny, nx = len(found.y) - 1, len(found.x) - 1
    z, share = found.z.reshape(ny + 1, nx + 1), (np.arange(PARTS) + 0.5) / PARTS
    across = (z[:, :-1, None] * (1 - share) + z[:, 1:, None] * share).reshape(ny + 1, nx * PARTS)
    fine = across[:-1, None] * (1 - share[:, None]) + across[1:, None] * share[:, None]
    corners, edges = found.cells()
    bent, most = np.zeros(z.shape, dtype=bool), CURVED * float(found.x[1] - found.x[0])
    bent[1:-1] |= np.abs(np.diff(z, 2, axis=0)) > most
    bent[:, 1:-1] |= np.abs(np.diff(z, 2, axis=1)) > most
    broken = ((found.wall[edges] >= 0).any(axis=1) | bent.ravel()[corners].any(axis=1)).reshape(ny, nx)
    broken = np.repeat(np.repeat(broken, PARTS, axis=0), PARTS, axis=1)
    j, i = np.nonzero(broken)
    low, side = (found.x[0], found.y[0]), (found.x[1] - found.x[0], found.y[1] - found.y[0])
    fine = fine.reshape(ny * PARTS, nx * PARTS)
    px, py = (start + (k + 0.5) / PARTS * each for start, k, each in zip(low, (i, j), side))
    fine[j, i] = heights_at(workpiece, px, py)
    return fine


def _lit(z: Array, dx: float, dy: float) -> Array:
    """How light pixels are: a level floor in the light is 1."""
    (across, up), (right, higher) = zip(*(_slopes(z, step, axis) for step, axis in ((dx, 1), (dy, 0))))
    normal = np.stack([-across, -up, np.ones_like(z)])
    towards = LIGHT / LIGHT[2]
    light = np.tensordot(towards, normal, 1) / np.sqrt((normal * normal).sum(axis=0))
    light = np.clip(0.4 + 0.6 * light, DARK, BRIGHT)
    light[np.maximum(right, higher) > CREASE] *= LINE
    return np.asarray(light * (1 - (1 - DIM) * _shadow(z)))


def _slopes(z: Array, step: float, axis: int) -> tuple[Array, Array]:
    """The smaller of the slopes to both neighbours, and by how much they differ."""
    rise = np.diff(z, axis=axis) / step
    if not rise.size:
        return np.zeros_like(z), np.zeros_like(z)
    ends = [[(0, 0), (0, 0)], [(0, 0), (0, 0)]]
    ends[0][axis], ends[1][axis] = (1, 0), (0, 1)
    before, behind = (np.pad(rise, each, mode="edge") for each in ends)
    return np.where(np.abs(before) < np.abs(behind), before, behind), np.abs(before - behind)


def _shadow(z: Array) -> Array:
    """0 in the light to 1 in the shadow of something higher towards the light, softer farther away from it."""
    found = np.zeros_like(z)
    low, high = float(z.min()), float(z.max())
    if high - low <= THIN:
        return found
    reach = min(LONG, *(side - 1 for side in z.shape))
    rise = (high - low) / max(reach, 1)  # a ray rises by the whole depth over the longest shadow
    for k in range(1, reach + 1):
        there = z[: z.shape[0] - k, k:], z[k:, : z.shape[1] - k]  # a pixel, and the one above it to the left
        above = np.clip((there[1] - there[0] - k * rise) / (2 * rise), 0.0, 1.0) * (1 - 0.4 * k / reach)
        part = found[: z.shape[0] - k, k:]
        np.maximum(part, above, out=part)
    return found
