"""Arcs and helices as functions of the share of their length that is behind.

With the spoke q from the centre to the start, n the normal of the plane and φ = sweep · share:

    place      p = start - q + cos φ q + sin φ (n × q) + share · drift
    tangent    p' = (sweep / L) (-sin φ q + cos φ (n × q)) + drift / L
    curvature  p'' = -(sweep / L)² (cos φ q + sin φ (n × q))

`drift` is the pitch of a helix, and the little by which a rounded program misses the circle.
"""

from __future__ import annotations

import numpy as np

from mnclab.path.columns import COLUMNS, Array, Index
from mnclab.path.kinds import Kind
from mnclab.path.toolpath import Toolpath


class Bends:
    """The arcs of a path at `rows` (m,): vectors are (m, 3), mm."""

    def __init__(self, path: Toolpath, rows: Index, length: Array) -> None:
        self.rows, self.length = rows, length
        self.start, axis, self.sweep = path.start[rows], path.axis[rows], path.sweep[rows]
        spoke = self.start - path.centre[rows]
        self.spoke = spoke - np.einsum("ij,ij->i", spoke, axis)[:, None] * axis
        self.side = np.cross(axis, self.spoke)
        turned = np.cos(self.sweep)[:, None] * self.spoke + np.sin(self.sweep)[:, None] * self.side
        self.drift = path.end[rows] - (self.start - self.spoke + turned)
        self.rate = self.sweep / length  # rad/mm
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


def divided(path: Toolpath, counts: Index, until: Array | None = None) -> tuple[Toolpath, Index]:
    """The path with each row cut into `counts` (n,) equal parts, or into such as end at the shares `until` (m,) of their
    row, and the row (m,) of the path each part belongs to."""
    row = np.repeat(np.arange(len(path)), counts)
    k = np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)
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
