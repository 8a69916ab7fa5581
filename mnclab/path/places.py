"""Places along the rows of a path: a row and a share of it, 0 at its start and 1 at its end."""

from __future__ import annotations

import numpy as np

from mnclab.geometry.curves import counted
from mnclab.path.toolpath import COLUMNS, Array, Index, Kind, Toolpath
from mnclab.text.alarm import Refused


def spokes(path: Toolpath, rows: Index) -> tuple[Array, Array]:
    """Of arcs: from the centre to the start within the plane, and the same a quarter turn on, (n, 3) each."""
    axis = path.axis[rows]
    spoke = path.start[rows] - path.centre[rows]
    spoke = spoke - np.einsum("ij,ij->i", spoke, axis)[:, None] * axis
    return spoke, np.cross(axis, spoke)


# Arcs and helices as functions of the share of their length that is behind.
# With the spoke q from the centre to the start, n the normal of the plane and φ = sweep · share:
#     place      p = start - q + cos φ q + sin φ (n × q) + share · drift
#     tangent    p' = (sweep / L) (-sin φ q + cos φ (n × q)) + drift / L
#     curvature  p'' = -(sweep / L)² (cos φ q + sin φ (n × q))
# `drift` is the pitch of a helix, and the little by which a rounded program misses the circle.

class Bends:
    """The arcs of a path at `rows` (m,): vectors are (m, 3), mm. Without their `length` (m,) places alone are known."""

    def __init__(self, path: Toolpath, rows: Index, length: Array | float = 1.0) -> None:
        self.rows, self.length = rows, np.broadcast_to(length, len(rows))
        self.start, axis, self.sweep = path.start[rows], path.axis[rows], path.sweep[rows]
        self.spoke, self.side = spokes(path, rows)
        turned = np.cos(self.sweep)[:, None] * self.spoke + np.sin(self.sweep)[:, None] * self.side
        self.drift = path.end[rows] - (self.start - self.spoke + turned)
        self.rate = self.sweep / self.length  # rad/mm
        #: How much of a circle each axis sees (m, 3): 1 for the axes of the plane, 0 for the axis across it.
        self.seen = np.sqrt(np.maximum(0.0, 1.0 - axis * axis))
        self.radius = np.linalg.norm(self.spoke, axis=1)

    def _turn(self, share: Array | float) -> tuple[Array, Array]:
        angle = self.sweep * share
        return np.cos(angle)[:, None], np.sin(angle)[:, None]

    def place(self, share: Array | float) -> Array:
        c, s = self._turn(share)
        behind = np.broadcast_to(share, len(self.rows))[:, None]
        return self.start - self.spoke + c * self.spoke + s * self.side + behind * self.drift

    def tangent(self, share: Array | float) -> Array:
        """p' (m, 3), of length 1."""
        c, s = self._turn(share)
        return self.rate[:, None] * (c * self.side - s * self.spoke) + self.drift / self.length[:, None]

    def curvature(self, share: Array | float) -> Array:
        """p'' (m, 3), 1/mm, towards the centre."""
        c, s = self._turn(share)
        return -(self.rate**2)[:, None] * (c * self.spoke + s * self.side)

    @property
    def bend(self) -> Array:
        """The curvature (m,), 1/mm."""
        return self.radius * self.rate**2


def along(path: Toolpath, rows: Index, share: Array) -> tuple[Array, Array]:
    """Where rows (k,) of a path are when a share (k,) of their length is behind, and which way they go there (k, 3)."""
    travel, length = path.end[rows] - path.start[rows], path.lengths[rows]
    place, way = path.start[rows] + share[:, None] * travel, travel / length[:, None]
    arcs = np.flatnonzero(path.kind[rows] == Kind.ARC)
    if len(arcs):
        bends = Bends(path, rows[arcs], length[arcs])
        place[arcs], way[arcs] = bends.place(share[arcs]), bends.tangent(share[arcs])
    return place, way


def points_at(path: Toolpath, rows: Index, share: Array) -> Array:
    """Points (n, 3) of `rows` (n,) at shares (n,) of their way; of events, where the tool is."""
    start, end = path.start[rows], path.end[rows]
    xyz = start + share[:, None] * (end - start)
    arc = np.flatnonzero((path.kind[rows] == Kind.ARC) & (share != 1))
    xyz[arc] = Bends(path, rows[arc]).place(share[arc])
    at_end = share == 1
    xyz[at_end] = end[at_end]
    return xyz


def divided(path: Toolpath, counts: Index, until: Array | None = None) -> tuple[Toolpath, Index]:
    """The path with each row cut into `counts` (n,) equal parts, or into such as end at the shares `until` (m,) of their
    row, and the row (m,) of the path each part belongs to."""
    row, k = counted(counts)
    many = counts[row]
    until = (k + 1) / many if until is None else until
    since = np.where(k == 0, 0.0, np.append(0.0, until[:-1]))
    columns = {name: getattr(path, name)[row] for name in COLUMNS}
    cut = np.flatnonzero(many > 1)
    start, end = columns["start"], columns["end"]
    travel = end[cut] - start[cut]
    begin = start[cut].copy()
    start[cut] = begin + since[cut, None] * travel
    last = (k + 1 == many)[:, None]
    end[cut] = np.where(last[cut], end[cut], begin + until[cut, None] * travel)
    arcs = cut[columns["kind"][cut] == Kind.ARC]
    if len(arcs):
        bends = Bends(path, row[arcs], path.lengths[row[arcs]])
        start[arcs] = bends.place(since[arcs])
        end[arcs] = np.where(last[arcs], path.end[row[arcs]], bends.place(until[arcs]))
    columns |= {name: columns[name] * (until - since) for name in ("sweep", "time")}
    columns["exact"] = columns["exact"] & last[:, 0]
    return path.replace(**columns), row


def turns_of_sum(cosine: Array, sine: Array, pitch: Array, sweep: Array) -> Array:
    """Shares t (n, k) at which `cosine` cos(sweep t) + `sine` sin(sweep t) + `pitch` t turns back, in any order; 0
    where there are fewer than k. All arguments are (n,)."""
    size = np.hypot(cosine, sine)
    with np.errstate(divide="ignore", invalid="ignore"):
        opening = np.arccos(-pitch / (sweep * size))  # nan where it never turns back
    most = int(np.ceil(np.abs(sweep).max() / (2 * np.pi))) + 1 if len(sweep) else 0
    angle = np.stack([opening, -opening], axis=1)[:, :, None] - np.arctan2(cosine, sine)[:, None, None]
    angle = angle + 2 * np.pi * np.arange(-most, most + 1)
    share = (angle / sweep[:, None, None]).reshape(len(sweep), -1)
    return np.where((share > 0) & (share < 1), share, 0.0)


def turning_points(path: Toolpath, rows: Index) -> Array:
    """Shares (n, k) of arcs where a coordinate turns back, in any order; 0 where there are fewer than k."""
    u, v = spokes(path, rows)
    sweep = path.sweep[rows]
    most = int(np.ceil(np.abs(sweep).max() / np.pi)) + 1 if len(rows) else 0
    # coordinate = a cos t + b sin t has its extremes at t = atan2(b, a) + k pi
    first = np.arctan2(v, u)[:, :, None] + np.pi * np.arange(-most - 1, most + 2)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (first / sweep[:, None, None]).reshape(len(rows), -1)
    return np.where((share > 0) & (share < 1), share, 0.0)


# Arcs and helices as points within a chord error, the last step before pixels.

FINEST = 100_000  # pieces of one arc at most


def points(path: Toolpath, chord_error: float = 0.01) -> tuple[Array, Index]:
    """Points (m, 3) along the motion rows and the row (m,) each belongs to.

    The first point is where the first motion begins; then every row ends with its own end point. An arc of radius r
    is cut into pieces of at most `2 acos(1 - e / r)`, whose sagitta is the chord error e (mm).
    """
    if not chord_error > 0:
        raise Refused(f"chord_error must be greater than 0 mm, got {chord_error:g}")
    rows = np.flatnonzero(path.is_motion)
    if not len(rows):
        return np.empty((0, 3)), np.empty(0, dtype=np.int64)
    every = len(rows) == len(path)
    end = path.end if every else path.end[rows]
    arc = path.kind[rows] == Kind.ARC
    if not arc.any():
        return np.concatenate([path.start[rows[:1]], end]), np.concatenate([rows[:1], rows])
    radius = np.zeros(len(rows))
    radius[arc] = np.linalg.norm(spokes(path, rows[arc])[0], axis=1)
    step = 2 * np.arccos(np.clip(1 - chord_error / np.maximum(radius, chord_error), 0.0, 1.0))
    pieces = np.where(arc, np.ceil(np.abs(path.sweep[rows]) / np.maximum(step, 1e-6)), 1)
    pieces = pieces.clip(1, FINEST).astype(np.int64)
    row, k = counted(pieces)
    share = (k + 1) / pieces[row]
    xyz = end[row]
    bent = np.flatnonzero(arc[row] & (k + 1 < pieces[row]))
    if len(bent):
        xyz[bent] = Bends(path, rows[row[bent]]).place(share[bent])
    return np.concatenate([path.start[rows[:1]], xyz]), np.concatenate([rows[:1], rows[row]])
