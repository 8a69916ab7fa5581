"""A path seen in its plane: two coordinates in it, one along its normal."""

from __future__ import annotations

import numpy as np

from mnclab.path.columns import Array, Index
from mnclab.path.kinds import Kind
from mnclab.path.toolpath import Toolpath


def basis(axis: Array) -> Array:
    """Unit vectors (n, 3, 3): first and second axis of the plane and its normal. For a normal along Z, X or Y the first
    axis is X, Y or Z: the planes XY, YZ and ZX of the controls."""
    first = np.roll(axis, 1, axis=-1)
    skew = np.abs((first * axis).sum(axis=-1)) > 1e-12
    if skew.any():
        along = np.eye(3)[np.argmin(np.abs(axis[skew]), axis=-1)]
        flat = along - (along * axis[skew]).sum(axis=-1, keepdims=True) * axis[skew]
        first[skew] = flat / np.linalg.norm(flat, axis=-1, keepdims=True)
    return np.stack([first, np.cross(axis, first), axis], axis=-2)


PIECE = 1 << 14  # rows worked on at once


class PlaneView:
    """Rows of a path in the coordinates (u, v, w) of their planes."""

    def __init__(self, path: Toolpath) -> None:
        same = path.axis.strides[0] == 0 or bool((path.axis == path.axis[:1]).all())
        self.basis = basis(path.axis[:1] if same and len(path) else path.axis)  # one plane for all, or one a row
        self.flat = len(self.basis) == 1 and bool((self.basis[0] == np.eye(3)).all())
        self.start, self.end = self.to_plane(path.start), self.to_plane(path.end)
        self.arc = path.kind == Kind.ARC
        self.sweep = path.sweep
        n = len(path)
        self.moves, line = np.empty(n, dtype=bool), np.empty((n, 2))
        for first in range(0, n, PIECE):  # a piece at a time stays in the cache
            piece = slice(first, first + PIECE)
            travel = self.end[piece, :2] - self.start[piece, :2]
            length = np.hypot(travel[:, 0], travel[:, 1])
            self.moves[piece] = length > 1e-9
            np.divide(travel, np.where(length > 0, length, 1.0)[:, None], out=line[piece])
        self.moves = path.is_motion & (self.arc | self.moves)
        self.radius = np.broadcast_to(np.nan, (n,))
        self.tangent_start, self.tangent_end = line, line
        if not self.arc.any():
            self.centre = np.broadcast_to(np.array([np.nan, np.nan]), (len(path), 2))
            return
        self.centre = self.to_plane(path.centre)[:, :2]
        self.radius = np.where(self.arc, np.hypot(*(self.start[:, :2] - self.centre).T), np.nan)
        self.tangent_start = np.where(self.arc[:, None], self._along_arc(self.start), line)
        self.tangent_end = np.where(self.arc[:, None], self._along_arc(self.end), line)

    def to_plane(self, points: Array) -> Array:
        """Points (n, 3) of all rows in the coordinates of their planes."""
        if self.flat:
            return points
        if len(self.basis) == 1:
            return np.asarray(points @ self.basis[0].T)
        return np.asarray(np.einsum("nij,nj->ni", self.basis, points))

    def _along_arc(self, at: Array) -> Array:
        spoke = at[:, :2] - self.centre
        length = np.hypot(spoke[:, 0], spoke[:, 1])[:, None]
        sense = np.sign(self.sweep)[:, None]
        return sense * np.stack([-spoke[:, 1], spoke[:, 0]], axis=-1) / np.where(length > 0, length, 1.0)

    def to_space(self, rows: Index, uvw: Array) -> Array:
        """Points (m, 3) of the planes of `rows` in machine axes."""
        if self.flat:
            return uvw
        if len(self.basis) == 1:
            return np.asarray(uvw @ self.basis[0])
        return np.asarray(np.einsum("nji,nj->ni", self.basis[rows], uvw))
