"""A ruled surface between two lines: straight passes from the one to the other. Lengths in mm, feeds in mm/min.

    4 ────────► 3        passes i = 0 … n - 1 from  P1 + (P4 - P1)·i/(n - 1)  to  P2 + (P3 - P2)·i/(n - 1)
    1 ────────► 2
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from mnclab.geometry.curves import Floats
from mnclab.machining.milling.clearing import numbered
from mnclab.machining.steps import RAPID, Go, Step

Point = Sequence[float]


def passes(first: Point, second: Point, third: Point, fourth: Point, count: int) -> tuple[Floats, Floats]:
    """Where the passes begin and where they end, `(count, 3)` each."""
    share = np.linspace(0, 1, count)[:, None]
    one, two, three, four = (np.asarray(point, dtype=float) for point in (first, second, third, fourth))
    return one + (four - one) * share, two + (three - two) * share


def mill_ruled(begins: Floats, ends: Floats, lift: float, feed: float, slow: float) -> Iterator[Step]:
    """Along all passes the same way, the first one and the way to it at the feed `slow`; back at rapid, `lift` over the pass."""
    above = None
    for k, label in enumerate(numbered("line", len(begins))):
        x, y, z = begins[k].tolist()
        if above is not None:
            bx, by, bz = begins[k - 1].tolist()
            yield Go(f"{label}, lift", above)
            yield Go(f"{label}, back", bz + lift, RAPID, bx, by)
            yield Go(f"{label}, down", bz, feed)
        yield Go(f"{label}, to its begin", z, feed if k else slow, x, y)
        x, y, z = ends[k].tolist()
        yield Go(label, z, feed if k else slow, x, y)
        above = z + lift
    yield Go("retract", float(max(begins[:, 2].max(), ends[:, 2].max())) + lift)
