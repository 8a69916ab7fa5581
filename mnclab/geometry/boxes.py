"""Which of many boxes lie near each other: a grid of cells, so that far ones are never compared."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.vectors import Floats

Index = NDArray[np.int64]

BATCH = 1 << 18  # pairs handed out at once


def near(low: Floats, high: Floats, gap: float) -> Iterator[tuple[Index, Index]]:
    """Pairs a < b of boxes (n, 2) nearer than `gap` mm along both axes, each pair once, in batches."""
    n = len(low)
    if n < 2:
        return
    low, high = low - gap / 2, high + gap / 2
    size = float(np.maximum(np.median(high - low), 1e-9))
    origin = low.min(axis=0)
    while True:  # every box lies in all the cells that it touches, in about four of them on average
        first = np.floor((low - origin) / size).astype(np.int64)
        count = np.floor((high - origin) / size).astype(np.int64) - first + 1
        cells = count[:, 0] * count[:, 1]
        if cells.sum() <= 8 * n + 64:
            break
        size *= 1.5
    box = np.repeat(np.arange(n), cells)
    nth = np.arange(len(box)) - np.repeat(np.cumsum(cells) - cells, cells)
    column = first[box, 0] + nth % count[box, 0]
    row = first[box, 1] + nth // count[box, 0]
    key = row * (int(first[:, 0].max() + count[:, 0].max()) + 1) + column
    order = np.argsort(key, kind="stable")
    box, key, column, row = box[order], key[order], column[order], row[order]
    # each entry is compared with those after it in its cell
    partners = np.searchsorted(key, key, "right") - np.arange(len(key)) - 1
    begin, before = 0, np.append(0, np.cumsum(partners))  # pairs of all entries before each
    while begin < len(key):
        stop = max(begin + 1, int(np.searchsorted(before, before[begin] + BATCH, "right")) - 1)
        here = np.repeat(np.arange(begin, stop), partners[begin:stop])
        there = here + 1 + np.arange(before[begin], before[stop]) - before[here]
        a, b = box[here], box[there]
        corner = np.maximum(first[a], first[b])  # of all cells that both lie in only the first counts
        meet = (low[a] <= high[b]).all(axis=1) & (low[b] <= high[a]).all(axis=1)
        meet &= (column[here] == corner[:, 0]) & (row[here] == corner[:, 1])
        if meet.any():
            yield np.minimum(a[meet], b[meet]), np.maximum(a[meet], b[meet])
        begin = stop
