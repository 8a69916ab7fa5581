"""A lathe's way in a test: places (z, r), one tool, a bar; no machine."""

import numpy as np

from mnclab.path.tool import Tool
from mnclab.path.toolpath import Kind, Toolpath
from mnclab.workpiece.blank import cylinder
from mnclab.workpiece.cutting import Cutting
from mnclab.workpiece.turning.turned import Turned

BAR = cylinder(30, -60, 0)
SHARP = Tool(number=1, kind="turning", main_angle=90, auxiliary_angle=60)
NOSED = Tool(number=1, kind="turning", main_angle=95, auxiliary_angle=30, corner=0.8)


def cutting(tools, ways, stock=BAR, threads=(), pitch=0.0, rapids=()):
    """`ways` has one list for each tool: (z, r), or (z, r, sweep in rad) of an arc that ends there; `rapids` are rows."""
    vertices, sweeps, which, synchronous = [], [], [], []
    for k, way in enumerate(ways):
        for place in way:
            vertices.append((place[1], 0.0, place[0]))
            sweeps.append(place[2] if len(place) == 3 else 0.0)
            which.append(k)
            synchronous.append(k in threads)
    points, sweep = np.array(vertices, dtype=float), np.array(sweeps[1:])
    start, end = points[:-1][:, [2, 0]], points[1:][:, [2, 0]]
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(sweep != 0, 0.5 / np.tan(sweep / 2), np.nan)[:, None]
    across = np.stack([-(end - start)[:, 1], (end - start)[:, 0]], axis=1)
    middle = (start + end) / 2 + share * across
    n = len(sweep)
    arc = sweep != 0
    fresh = np.diff(which) != 0  # from one tool to the next: not cut
    kind = np.where(fresh, Kind.TOOL, np.where(arc, Kind.ARC, Kind.LINE))
    rapid = np.isin(np.arange(n), rapids)
    columns = {
        "kind": np.where(rapid, Kind.RAPID, kind),
        "sweep": sweep,
        "centre": np.stack([middle[:, 1], np.zeros(n), middle[:, 0]], axis=1),
        "axis": np.broadcast_to([0.0, 1.0, 0.0], (n, 3)),
        "synchronous": np.array(synchronous[1:], dtype=bool) & ~rapid,
        "per_rev": np.full(n, pitch or np.nan),
        "line": np.arange(n),
    }
    return Cutting(Toolpath.chain(points, columns, lathe=True), tools, np.array(which[1:]), stock)


def turned(tool, *way, stock=BAR, **more):
    return Turned(cutting([tool], [way], stock, **more))
