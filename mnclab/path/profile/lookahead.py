"""The whole look-ahead without a loop over rows.

With w = v² a constant acceleration changes the speed over a row of length L by at most g = 2 a L. So the greatest
speeds at the nodes between rows, below caps that are known, are a *min-plus* scan:

    forward    w[i] = min(cap[i], w[i-1] + g[i-1])
    backward   w[i] = min(cap[i], w[i+1] + g[i])

With the running sum S of g the first is `minimum.accumulate(cap - S) + S`, and the second its mirror. Sums are taken
anew in every block of `BLOCK` nodes, because the difference of two large sums would lose the digits that a short
row needs; the blocks are then tied together by one number each.
"""

from __future__ import annotations

import numpy as np

from mnclab.path.columns import Array

BLOCK = 4096  # nodes


def reachable(cap: Array, gain: Array) -> Array:
    """Greatest w (n + 1,) under `cap` that rises and falls by at most `gain` (n,) over a row."""
    return forward(backward(cap, gain), gain)


def backward(cap: Array, gain: Array) -> Array:
    """Greatest w (n + 1,) under `cap` from which each node's successor is within `gain` (n,)."""
    return forward(cap[::-1], gain[::-1])[::-1]


def running_sum(values: Array) -> Array:
    """Sums (n + 1,) of the first 0, 1, … n values, in blocks: rounding grows with the root of a few hundred terms."""
    n = len(values)
    total = np.empty(n + 1)
    total[0] = 0.0
    if n <= BLOCK:
        np.cumsum(values, out=total[1:])
        return total
    blocks = -(-n // BLOCK)
    table = np.zeros((blocks, BLOCK))
    table.reshape(-1)[:n] = values
    np.cumsum(table, axis=1, out=table)
    table[1:] += np.cumsum(table[:-1, -1])[:, None]
    total[1:] = table.reshape(-1)[:n]
    return total


def forward(cap: Array, gain: Array) -> Array:
    """w (n + 1,): each the least of its cap and of what can be reached from any node before it; not below 0."""
    w = _scan(cap, gain)
    np.minimum(w, cap, out=w)
    return np.maximum(w, 0.0, out=w)


def _scan(cap: Array, gain: Array) -> Array:
    nodes = len(cap)
    if nodes <= BLOCK:
        total = np.empty(nodes)
        total[0] = 0.0
        np.cumsum(gain, out=total[1:])
        return np.minimum.accumulate(cap - total) + total
    blocks = -(-nodes // BLOCK)
    total, w = np.zeros((blocks, BLOCK)), np.full((blocks, BLOCK), np.inf)
    total.reshape(-1)[1:nodes] = gain
    w.reshape(-1)[:nodes] = cap
    np.cumsum(total, axis=1, out=total)
    w -= total
    np.minimum.accumulate(w, axis=1, out=w)
    w += total
    carry, carries = np.inf, [np.inf]
    for most, least in zip(total[:-1, -1].tolist(), w[:-1, -1].tolist()):  # one step a block
        carry = min(least, carry + most)
        carries.append(carry)
    total += np.array(carries)[:, None]
    np.minimum(w, total, out=w)
    return w.reshape(-1)[:nodes]
