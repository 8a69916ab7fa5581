"""Rapids that run over one another are drawn once: two dashed lines on one line would fill each other's gaps.

What is left would be a thin solid line, which grey print cannot tell from a cut.
"""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from mnclab.show.plot.classes import Classes
from mnclab.show.plot.strokes import Array, Strokes, parted

RAPID = 0  # the class of rapids
LONG = 5.0  # points, of a rapid at least; pieces of a bent one are shorter
SHARED = 3.0  # points of the way over another at least
TURN, ASIDE = 1e-3, 0.15  # rad and points, by which strokes on one line may differ


def once(ax: Axes, drawn: Strokes, found: Classes, axes: list[int]) -> Array:
    """The rapids of a view as one line (k, 2) broken by nan, none of it over another; the limits of `ax` are final."""
    rapids = np.flatnonzero(found.group == RAPID)
    figure = ax.get_figure(root=True)
    flat = ax.transData.transform(drawn.xyz[:, axes]) / ((figure.dpi if figure else 72) / 72)
    rapids = rapids[np.hypot(*(flat[rapids] - flat[rapids - 1]).T) > LONG]
    if not len(rapids):
        return parted(drawn.xyz, found.group, 1)[0][:, axes]
    low, high, ends = _on_lines(flat, rapids)
    order = np.argsort(low)
    reached = np.maximum.accumulate(high[order])
    runs = np.split(order, np.flatnonzero(low[order][1:] > reached[:-1] - SHARED) + 1)
    group, pieces = found.group.copy(), []
    for run in runs:
        if len(run) > 1:
            group[rapids[run]] = -1
            whole = [ends[run[0], 0], ends[run[np.argmax(high[run])], 1]]
            pieces.append(np.concatenate([np.full((1, 2), np.nan), drawn.xyz[whole][:, axes]]))
    line = np.concatenate([parted(drawn.xyz, group, 1)[0][:, axes], *pieces])
    return line[1:] if len(line) and np.isnan(line[0]).all() else line


def _on_lines(flat: Array, rapids: NDArray[np.intp]) -> tuple[Array, Array, NDArray[np.intp]]:
    """Where each rapid (m,) begins and ends on its line, and the points (m, 2) there; each line has a range of its own."""
    begin, way = flat[rapids - 1], flat[rapids] - flat[rapids - 1]
    turn = np.arctan2(way[:, 1], way[:, 0])
    turn = (turn + TURN) % np.pi - TURN  # there and back are one line
    x, y = np.cos(turn), np.sin(turn)
    turned = _clusters(turn, np.zeros(len(turn)), TURN)
    line = _clusters(begin[:, 1] * x - begin[:, 0] * y, turned, ASIDE)
    places = np.stack([x * flat[each][:, 0] + y * flat[each][:, 1] for each in (rapids - 1, rapids)], axis=1)
    ends = np.stack([rapids - 1, rapids], axis=1)
    ends = np.where((places[:, 0] > places[:, 1])[:, None], ends[:, ::-1], ends)
    places = np.sort(places, axis=1) - places.min()
    places += (line * (places.max() + 2 * SHARED))[:, None]
    return places[:, 0], places[:, 1], ends


def _clusters(values: Array, within: NDArray[np.float64], gap: float) -> Array:
    """Numbers (m,) of values that follow one another by less than a gap, apart for each number of `within`."""
    order = np.lexsort((values, within))
    new = (np.diff(values[order]) > gap) | (np.diff(within[order]) > 0)
    found = np.empty(len(values))
    found[order] = np.concatenate([[0], np.cumsum(new)])
    return found
