"""Rapids of axes that do not wait for each other: each runs at its own speed until it arrives, and the path breaks there.

::

    Y  |        ____________ end          X and Y at equal speed: both until Y has arrived, then X alone
       |      /
       |____/___________________  X
"""

from __future__ import annotations

import numpy as np

from mnclab.path.columns import Array, Mask
from mnclab.path.kinds import Kind
from mnclab.path.limits import PerAxis
from mnclab.path.toolpath import Toolpath


def broken(path: Toolpath, speed: PerAxis) -> Toolpath:
    """The path with every rapid along several axes divided where one of them arrives; `speed` mm/min, per axis or all.
    Speeds alone count: acceleration is left to the profile. The path itself where nothing is divided."""
    speeds = np.broadcast_to(np.asarray(speed, dtype=np.float64), (3,)) if np.ndim(speed) == 0 else np.array(speed)[:3]
    travel = path.end - path.start
    arrival = np.sort(np.abs(travel) / speeds, axis=1)  # (n, 3): when an axis, the second and the last has arrived
    last = arrival[:, 2] * (1 - 1e-12)
    rapid = path.kind == Kind.RAPID
    first_stop = rapid & (arrival[:, 0] > 0) & (arrival[:, 0] < last)
    second_stop = rapid & (arrival[:, 1] > arrival[:, 0] * (1 + 1e-12)) & (arrival[:, 1] < last)
    if not (first_stop | second_stop).any():
        return path

    def points(rows: Mask, when: Array) -> Array:
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.minimum(when[rows, None] * speeds / np.abs(travel[rows]), 1.0)
        return path.start[rows] + travel[rows] * np.where(travel[rows] == 0, 0.0, share)

    where = np.concatenate([np.flatnonzero(first_stop), np.flatnonzero(second_stop)])
    places = np.concatenate([points(first_stop, arrival[:, 0]), points(second_stop, arrival[:, 1])])
    columns = {name: np.insert(each, where, each[where], axis=0) for name, each in path.all_but_ends().items()}
    vertices = np.concatenate([path.start[:1], np.insert(path.end, where, places, axis=0)])
    return path.through(vertices, columns)
