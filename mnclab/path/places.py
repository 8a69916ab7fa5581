"""Places along the rows of a path: a row and a share of it, 0 at its start and 1 at its end."""

from __future__ import annotations

import numpy as np

from mnclab.path.toolpath import Array, Index, Kind, Toolpath
from mnclab.text.alarm import Refused


def spokes(path: Toolpath, rows: Index) -> tuple[Array, Array]:
    """Of arcs: from the centre to the start within the plane, and the same a quarter turn on, (n, 3) each."""
    axis = path.axis[rows]
    spoke = path.start[rows] - path.centre[rows]
    spoke = spoke - np.einsum("ij,ij->i", spoke, axis)[:, None] * axis
    return spoke, np.cross(axis, spoke)


def points_at(path: Toolpath, rows: Index, share: Array) -> Array:
    """Points (n, 3) of `rows` (n,) at shares (n,) of their way; of events, where the tool is."""
    start, end = path.start[rows], path.end[rows]
    xyz = start + share[:, None] * (end - start)
    arc = np.flatnonzero((path.kind[rows] == Kind.ARC) & (share != 1))
    xyz[arc] = on_arcs(path, rows[arc], share[arc])
    at_end = share == 1
    xyz[at_end] = end[at_end]
    return xyz


def on_arcs(path: Toolpath, rows: Index, share: Array) -> Array:
    """Points (n, 3) of arcs at shares (n,) of their way."""
    u, v = spokes(path, rows)
    sweep, middle = path.sweep[rows], path.start[rows] - u

    def turned(angle: Array) -> Array:
        return np.cos(angle)[:, None] * u + np.sin(angle)[:, None] * v

    # the end may lie a little off the circle (a rounded program): spread along the arc, like the pitch of a helix
    drift = path.end[rows] - (middle + turned(sweep))
    return middle + turned(share * sweep) + share[:, None] * drift


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
    row = np.repeat(np.arange(len(rows)), pieces)
    k = np.arange(len(row)) - np.repeat(np.cumsum(pieces) - pieces, pieces) + 1
    share = k / pieces[row]
    xyz = end[row]
    bent = np.flatnonzero(arc[row] & (k < pieces[row]))
    if len(bent):
        xyz[bent] = on_arcs(path, rows[row[bent]], share[bent])
    return np.concatenate([path.start[rows[:1]], xyz]), np.concatenate([rows[:1], rows[row]])
