"""Paths on a cylinder: the rotary axis turns the workpiece while the tool stands square to it.

Rows name their `Cylinder` (column `cylinder`) and the angle that they begin at (`from_angle`); their points are where the
machine has the tool tip, as it is for all rows. Two other views follow from it: the developed surface, and the path as it
lies on the workpiece.

            e_a (direction)          the workpiece point of a tip p at the angle t is p turned about e_a by t;
             |   / e_r (zero)        developed: u = radius * t + (p - point) e_t along the circumference,
             |  /                    y = (p - point) e_a along the axis, w = (p - point) e_r - radius above the surface
             | /
             +------- e_t = e_a x e_r
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mnclab.geometry.curves import counted
from mnclab.geometry.frames import Matrix
from mnclab.path import places
from mnclab.path.toolpath import COLUMNS, Array, Index, Kind

if TYPE_CHECKING:
    from mnclab.path.toolpath import Toolpath

Place = tuple[float, float, float]
NONE = -1  # the index of rows that lie on no cylinder
STILL = 1e-9  # rad
MOST = 4096  # pieces of one row
SHARE = (3 - 5**0.5) / 2  # of the way of a row, where whole turns do not look as if nothing had turned: no fraction


class Cylinder(NamedTuple):
    """A cylinder about a rotary axis: a `point` of the axis, unit vectors along it and to the tool, where the angle is 0.

    `radius` mm is that of the surface; `rotary` is the number of the axis, 0 for A, 1 for B, 2 for C, which turns in the
    positive sense about `direction`.
    """

    point: Place
    direction: Place
    zero: Place
    radius: float
    rotary: int

    @property
    def basis(self) -> Array:
        """The rows e_t, e_a, e_r (3, 3): along the circumference, along the axis, away from it."""
        return np.array([np.cross(self.direction, self.zero), self.direction, self.zero])

    def moved(self, way: Iterable[float]) -> Cylinder:
        """The same elsewhere."""
        x, y, z = (p + d for p, d in zip(self.point, way, strict=True))
        return self._replace(point=(float(x), float(y), float(z)))

    def behind(self, frame: Matrix) -> Cylinder:
        """The same seen from outside a frame that turns, shifts and scales equally."""
        linear = frame[:3, :3]
        point = linear @ self.point + frame[:3, 3]
        direction, zero = (tuple((v / np.linalg.norm(v)).tolist()) for v in (linear @ self.direction, linear @ self.zero))
        size = float(np.linalg.norm(linear @ self.zero))
        return Cylinder(tuple(point.tolist()), direction, zero, self.radius * size, self.rotary)

    def developed(self, points: Array, angles: Array) -> Array:
        """Tips (n, 3) at angles (n,) rad in coordinates (n, 3) of the developed surface: u, y, w mm."""
        found = (points - self.point) @ self.basis.T
        return np.asarray(found + np.multiply.outer(angles, [self.radius, 0.0, 0.0]) - [0.0, 0.0, self.radius])

    def on_workpiece(self, points: Array, angles: Array) -> Array:
        """Tips (n, 3) at angles (n,) rad where they are on the workpiece, as it lies at the angle 0."""
        t, y, r = ((points - self.point) @ self.basis.T).T
        c, s = np.cos(angles), np.sin(angles)
        return np.asarray(np.stack([c * t + s * r, y, c * r - s * t], axis=1) @ self.basis + self.point)


def unrolled(path: Toolpath) -> Toolpath:
    """The rows that lie on a cylinder on its developed surface: X along the circumference, Y along the axis, Z above it, mm.

    X is 0 where the rotary axis stands at 0; the feed is that along the developed surface.
    """
    mine = path[path.cylinder >= 0]
    start, end = mine.start.copy(), mine.end.copy()
    for number, one in enumerate(path.cylinders):
        rows = np.flatnonzero(mine.cylinder == number)
        start[rows] = one.developed(mine.start[rows], mine.from_angle[rows])
        end[rows] = one.developed(mine.end[rows], mine.rotary[rows, one.rotary])
    n = len(mine)
    flat = {"rotary": np.zeros((n, 3)), "cylinder": np.full(n, NONE), "from_angle": np.full(n, np.nan)}
    up = np.broadcast_to([0.0, 0.0, 1.0], (n, 3))
    feed = _speeds(mine, np.linalg.norm(end - start, axis=1))
    return mine.replace(start=start, end=end, axis=up, feed=feed, **flat).annotated(origin=(0.0, 0.0, 0.0), cylinders=())


def _speeds(path: Toolpath, way: Array) -> Array:
    """Feeds (n,) along a way (n,) mm of each row: of rows with a time they follow from it."""
    timed = np.isfinite(path.time) & ((path.kind == Kind.LINE) | (path.kind == Kind.ARC))
    return np.where(timed, 60 * way / np.where(timed, path.time, 1.0), path.feed)


def on_workpiece(path: Toolpath) -> Toolpath:
    """The same rows where they are on the workpiece, which turns with the axis of the cylinder, before its rows and after
    them, too; itself without a cylinder.

    A row at feed that turns is a helix about the axis, any other a straight line from end to end; rapids that turn have the
    `centre`, `axis` and `sweep` of theirs beside it. The rotary axes stand, and the feed is that along the workpiece.
    """
    if not path.cylinders or not len(path):
        return path
    start, end, centre, axis = (np.array(getattr(path, name)) for name in ("start", "end", "centre", "axis"))
    kind, sweep = path.kind.copy(), path.sweep.copy()
    for one, rows, before, after in _turns(path):
        start[rows] = one.on_workpiece(path.start[rows], before)
        end[rows] = one.on_workpiece(path.end[rows], after)
        arcs = kind[rows] == Kind.ARC  # the workpiece stands while they are made, or they would be no arcs
        centre[rows[arcs]] = one.on_workpiece(path.centre[rows[arcs]], before[arcs])
        axis[rows[arcs]] = one.on_workpiece(path.axis[rows[arcs]] + one.point, before[arcs]) - one.point
        turns = rows[(np.abs(after - before) > STILL) & np.isin(kind[rows], (Kind.LINE, Kind.RAPID))]
        along = np.array(one.direction)
        kind[turns[kind[turns] == Kind.LINE]], axis[turns] = Kind.ARC, along
        sweep[turns] = path.rotary[turns, one.rotary] - before[np.searchsorted(rows, turns)]
        centre[turns] = one.point + ((start[turns] - one.point) @ along)[:, None] * along
    n = len(path)
    still = {"rotary": np.zeros((n, 3)), "cylinder": np.full(n, NONE), "from_angle": np.full(n, np.nan)}
    columns = {name: getattr(path, name) for name in COLUMNS} | still
    columns |= {"start": start, "end": end, "centre": centre, "axis": axis, "kind": kind, "sweep": sweep}
    found = path.replace(**columns).annotated(cylinders=())
    return found.replace(**columns | {"feed": _speeds(found, found.lengths)})


def on_drum(path: Toolpath, directions: Array) -> Array:
    """Directions (n, 3, 3) of the tool at the start of rows, on their way and at the end, on a workpiece that turns, as it lies
    at the angle 0."""
    found = directions.copy()
    for one, rows, before, after in _turns(path):
        for place, share in enumerate((0.0, SHARE, 1.0)):
            angle = before + share * (after - before)
            found[rows, place] = one.on_workpiece(directions[rows, place] + one.point, angle) - one.point
    return found


def _turns(path: Toolpath) -> Iterator[tuple[Cylinder, Index, Array, Array]]:
    """The cylinders, the rows about whose axis the workpiece turns, and the angles (k,) before and after these, rad."""
    which, previous = _cylinder_of(path), np.concatenate([np.zeros((1, 3)), path.rotary[:-1]])
    for number, one in enumerate(path.cylinders):
        mine = which == number if path.kinematics is None else path.cylinder == number  # of others it says where they are
        rows = np.flatnonzero(mine)
        before = np.where(path.cylinder[rows] == number, path.from_angle[rows], previous[rows, one.rotary])
        yield one, rows, before, path.rotary[rows, one.rotary]


def divided(path: Toolpath, turn: float) -> Toolpath:
    """The path with its rapids that turn on a cylinder parted where the axis has turned by so many rad."""
    return parted_rapids(path, turn)[0]


def parted_rapids(path: Toolpath, turn: float) -> tuple[Toolpath, Index]:
    """The same, and the row (m,) of the path that each of its rows is a piece of."""
    before = np.where(np.isfinite(path.from_angle), path.from_angle, 0.0)
    last = np.zeros(len(path))
    for number, one in enumerate(path.cylinders):
        rows = path.cylinder == number
        last[rows] = path.rotary[rows, one.rotary]
    way = np.where((path.cylinder >= 0) & (path.kind == Kind.RAPID), np.abs(last - before), 0.0)
    pieces = np.clip(np.ceil(way / turn), 1, MOST).astype(np.int64)
    found, row = places.divided(path, pieces)
    share = counted(pieces)[1] / pieces[row]
    rotary, many = found.rotary.copy(), np.flatnonzero(pieces[row] > 1)
    of = np.array([one.rotary for one in path.cylinders], dtype=np.int64)[found.cylinder[many]] if len(many) else many
    begin = before[row[many]] + (last - before)[row[many]] * share[many]
    from_angle = found.from_angle.copy()
    from_angle[many] = begin
    rotary[many, of] = begin + (last - before)[row[many]] / pieces[row[many]]
    return found.replace(rotary=rotary, from_angle=from_angle), row


def _cylinder_of(path: Toolpath) -> Index:
    """The cylinder (n,) about whose axis the workpiece turns: that of the row, else the last one before it, else the first."""
    on = np.flatnonzero(path.cylinder >= 0)
    if not len(on):
        return np.zeros(len(path), dtype=np.int64)
    last = np.clip(np.searchsorted(on, np.arange(len(path)), "right") - 1, 0, None)
    return path.cylinder[on[last]].astype(np.int64)
