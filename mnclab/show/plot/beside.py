"""Rapids that run over a cut are drawn beside it, to the right of their way, so that both are seen.

Where several of them run the same way over one cut, each has a lane of its own, up to `LANES`.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from mnclab.show.plot.classes import Classes
from mnclab.show.plot.strokes import Array, Strokes

RAPID, CUTS = 0, 1  # classes: rapids, and from here on what they do not cover
MOST, AT_ONCE = 500, 400_000  # rapids of a view that are looked at; pairs of rapid and cut looked at together
ON, LONG, SHARED = 1.2, 5.0, 3.0  # points: from line to line; of a rapid at least; of the way over a cut at least
OFF, NEXT, LANES = 2.4, 2.0, 2  # points from the cut to the first lane, and from lane to lane; how many lanes


def beside(ax: Axes, drawn: Strokes, found: Classes, axes: list[int]) -> tuple[Strokes, Classes]:
    """The strokes of a view whose coordinates `axes` are seen, with rapids beside the cuts; the limits of `ax` are final."""
    rapids = np.flatnonzero(found.group == RAPID)
    cuts = np.flatnonzero(found.group >= CUTS)
    figure = ax.get_figure(root=True)
    if not len(rapids) or not len(cuts) or figure is None:
        return drawn, found
    point = figure.dpi / 72
    flat = ax.transData.transform(drawn.xyz[:, axes]) / point
    rapids = rapids[np.hypot(*(flat[rapids] - flat[rapids - 1]).T) > LONG]
    if not 0 < len(rapids) <= MOST:
        return drawn, found
    over = _over(flat, rapids, cuts)
    rapids = rapids[over]
    if not len(rapids):
        return drawn, found
    off = OFF + NEXT * _lanes(flat, rapids)
    begin, way = flat[rapids - 1], flat[rapids] - flat[rapids - 1]
    length = np.hypot(*way.T)
    along = way / length[:, None]
    aside = off[:, None] * np.stack([along[:, 1], -along[:, 0]], axis=1)
    slant = np.minimum(off, length / 4)[:, None] * along
    places = np.stack([begin + aside + slant, begin + way + aside - slant], axis=1).reshape(-1, 2)
    xyz = np.repeat(drawn.xyz[rapids], 2, axis=0)
    xyz[:, axes] = ax.transData.inverted().transform(places * point)
    at = np.repeat(rapids, 2)
    moved = Strokes(np.insert(drawn.xyz, at, xyz, axis=0), np.insert(drawn.row, at, drawn.row[at]))
    return moved, found._replace(group=np.insert(found.group, at, RAPID))


def _over(flat: Array, rapids: NDArray[np.intp], cuts: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Which rapids (m,) run over a cut."""
    low, high = np.minimum(flat[cuts], flat[cuts - 1]), np.maximum(flat[cuts], flat[cuts - 1])
    seen = cuts[(high - low).max(axis=1) > SHARED]
    found = np.zeros(len(rapids), bool)
    step = max(1, AT_ONCE // max(len(seen), 1))
    for k in range(0, len(rapids), step):
        found[k : k + step] = (_shared(flat, rapids[k : k + step], seen) > SHARED).any(axis=1)
    return found


def _shared(flat: Array, some: NDArray[np.intp], others: NDArray[np.intp]) -> Array:
    """How much of the way strokes share with others on the same line (m, n), points; 0 on another line."""
    begin, way = flat[some - 1], flat[some] - flat[some - 1]
    length = np.hypot(*way.T)
    x, y = (way / length[:, None]).T[:, :, None]
    ends = [flat[each] - begin[:, None] for each in (others - 1, others)]
    a, b = (x * each[..., 0] + y * each[..., 1] for each in ends)
    aside = np.maximum(*(np.abs(x * each[..., 1] - y * each[..., 0]) for each in ends))
    shared = np.minimum(np.maximum(a, b), length[:, None]) - np.maximum(np.minimum(a, b), 0.0)
    return np.where(aside < ON, np.maximum(shared, 0.0), 0.0)


def _lanes(flat: Array, rapids: NDArray[np.intp]) -> NDArray[np.int64]:
    """The lane of each rapid (m,): the first that none before it has on the same line and in the same direction."""
    way = flat[rapids] - flat[rapids - 1]
    together = (_shared(flat, rapids, rapids) > 0) & (way @ way.T > 0)
    lanes = np.zeros(len(rapids), np.int64)
    for k in range(len(rapids)):
        taken = set(lanes[:k][together[k, :k]].tolist())
        lanes[k] = next((lane for lane in range(LANES) if lane not in taken), LANES - 1)
    return lanes
