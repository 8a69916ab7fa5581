"""Random closed contours, and their compensation as a path of rows, for the tests of the pass."""

from types import SimpleNamespace

import numpy as np
import pytest
import shapely
from shapely import affinity

from mnclab import Kind
from mnclab.path import compensation
from mnclab.path.compensation import Compensation, Report
from mnclab.path.toolpath import PathFault, Toolpath

RULES = Compensation("corner", change=True, look_ahead=True)


def contour(points, side, radius, corner=0):
    """Lines round a polygon (n, 2) from the middle of its first edge, with tangential entry and exit."""
    t = (points[1] - points[0]) / np.linalg.norm(points[1] - points[0])
    middle, lead = (points[0] + points[1]) / 2, (radius + 20) * t
    way = np.concatenate([[middle - lead, middle], points[1:], points[:1], [middle, middle + lead]])
    n = len(way) - 1
    columns = {
        "kind": np.full(n, Kind.LINE, np.uint8),
        "side": np.append(np.full(n - 1, side, np.int8), np.int8(0)),
        "radius": np.broadcast_to(float(radius), (n,)),
        "corner_rule": np.broadcast_to(np.uint8(corner), (n,)),
        "line": np.arange(n),
        "step": np.arange(n),
    }
    return Toolpath.chain(np.column_stack([way, np.zeros(n + 1)]), columns)


def joined(paths):
    """One path of many contours, with rapids between them."""
    vertices, columns = [paths[0].start[:1]], {name: [] for name in ("kind", "side", "radius", "corner_rule")}
    for path in paths:
        rapid = np.zeros(1)
        for name, found in columns.items():
            found += [rapid.astype(getattr(path, name).dtype), getattr(path, name)]
        vertices += [path.start[:1], path.end]
    columns = {name: np.concatenate(found) for name, found in columns.items()}
    return Toolpath.chain(np.concatenate(vertices), columns | {"step": np.arange(len(columns["kind"]))})


def compensated(path):
    """The tool-centre path and None, or None and what does not fit."""
    report = Report()
    try:
        return compensation.apply(path, RULES, report=report), None
    except PathFault:
        return None, report.gouges[0]


def body(path):
    """The tool-centre path from the end of the entry to the start of the exit as a line of shapely."""
    return shapely.LineString(path[1:-1].points(1e-6)[0][:, :2])


def shape(rng):
    """A polygon with slots, pegs and bays: bars and discs added to a plate and taken away; None if it fell apart."""
    plate = shapely.box(-40, -30, 40, 30)
    for _ in range(rng.integers(2, 7)):
        x, y = rng.uniform(-45, 45), rng.uniform(-35, 35)
        if rng.random() < 0.35:
            part = shapely.Point(x, y).buffer(rng.uniform(4, 15), quad_segs=int(rng.integers(2, 9)))
        else:
            w, h = rng.uniform(2, 60) / 2, rng.uniform(2, 16) / 2
            angle = rng.uniform(0, 180) if rng.random() < 0.5 else 90 * rng.integers(0, 2)
            part = affinity.translate(affinity.rotate(shapely.box(-w, -h, w, h), angle), x, y)
        plate = plate.union(part) if rng.random() < 0.5 else plate.difference(part)
    if plate.geom_type != "Polygon":
        return None
    points = np.round(np.array(plate.exterior.coords)[:-1], 3)
    edges = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    if edges.min() < 1e-2 or not shapely.Polygon(points).is_valid:
        return None
    return np.roll(points, -int(np.argmax(edges)), axis=0)


@pytest.fixture
def closed():
    """The functions above."""
    return SimpleNamespace(contour=contour, joined=joined, compensated=compensated, body=body, shape=shape)
