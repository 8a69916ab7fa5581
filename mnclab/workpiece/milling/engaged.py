"""What stands before a mill, at places of its way: how deep and how wide it is in the material, and the cross-section.

At a place the front half of the rim is looked at, degree by degree: what stands higher there than the edge, before the row
began, is cut. With θ from the heading and the radius R the width of cut is ae = R ∫ cos θ dθ over the engaged part, and the
cross-section R ∫ a cos θ dθ of the depths a. The lower side adds its faces that go ahead into the material, ring by ring:
those of round corners and cones, and of discs that go down. Exact but for the degree and the rings.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from mnclab.path.profile.motions import along
from mnclab.path.toolpath import Array, Index, Kind
from mnclab.workpiece.ahead import Ahead
from mnclab.workpiece.milling.before import Points, depths
from mnclab.workpiece.milling.cutters import edge_height
from mnclab.workpiece.milling.moves import Moves, moves_of

if TYPE_CHECKING:
    from mnclab.workpiece.milling.milled import Milled

RIM, AROUND = np.radians(np.arange(-89.5, 90.0, 1.0)), np.radians(np.arange(-172.5, 180.0, 15.0))
STEP, TURN = np.radians(1.0), np.radians(15.0)
INSIDE, LEAST, UPRIGHT = 1 - 1e-6, 1e-3, 1e-6
SPOTS = np.array([0.15, 0.5, 0.85, INSIDE])  # of the radius, where it is seen how high material stands
FLAT, BENT = 4, 12  # rings of the flat and of the rising part of the lower side


def reach(part: Milled, rows: Index) -> Array:
    """The shares (2, k) of rows between which their tools may meet the blank; arcs may everywhere."""
    path, (low, high) = part.cutting.path, part.bounds
    radius = np.array([tool.effective_radius for tool in part.cutting.tools])[part.cutting.which[rows]]
    wide, start = radius[:, None] * (1.0, 1.0, 0.0), path.start[rows]
    with np.errstate(divide="ignore", invalid="ignore"):
        ends = np.stack([(low - (0, 0, np.inf)) - wide - start, high + wide - start]) / (path.end[rows] - start)
    ends.sort(axis=0)
    found = np.stack([np.fmax.reduce(ends[0], axis=1), np.fmin.reduce(ends[1], axis=1)]).clip(0.0, 1.0)
    found[:, path.kind[rows] == Kind.ARC] = [[0.0], [1.0]]
    return np.maximum.accumulate(found)


def quarters(part: Milled) -> tuple[Moves, Index, Index]:
    """The moves, arcs that come round to where they have cut in quarters; the first part of each row and how many it has."""
    path = part.cutting.path
    round_ = (path.kind == Kind.ARC) & (np.abs(path.sweep) > np.pi + 1e-9)
    counts = np.where(round_, np.ceil(np.abs(path.sweep) / (np.pi / 2)), 1).astype(np.int64)
    moves = moves_of(part.cutting.divided(counts)) if round_.any() else part.moves
    return moves, np.cumsum(counts) - counts, counts


def ahead(part: Milled, rows: Index, share: Array) -> Ahead:
    """What stands before the tools of rows (k,) when a share (k,) of their way is behind."""
    (moves, first, counts), found = part.quarters, Ahead.none(len(rows))
    own = first[rows] + np.minimum(share * counts[rows], counts[rows] - 1).astype(np.int64)
    move = np.searchsorted(moves.row, own)
    known = np.flatnonzero(np.append(moves.row, -1)[move] == own)  # a tilted tool has no move
    place, way = along(part.cutting.path, rows[known], share[known])
    move, across = move[known], np.hypot(way[:, 0], way[:, 1])
    flat, radius = moves.flat[move], moves.radius[move]

    def deep(some: Index, rho: Array, angle: Array, low: Array) -> tuple[Array, Array]:
        """How deep points about the axis are in the material, and whether the blank begins above them."""
        turned = np.arctan2(way[some, 1], way[some, 0])[:, None, None] + angle
        x, y = (place[some, k, None, None] + rho[:, :, None] * f(turned) for k, f in enumerate((np.cos, np.sin)))
        z = np.broadcast_to(low[:, :, None], x.shape).ravel()
        floor, top = part.cutting.stock.faces(x.ravel(), y.ravel())
        count = np.ones(x.shape, dtype=np.int64)
        at = Points(x.ravel(), y.ravel(), np.fmax(z, floor), (move[some, None, None] * count).ravel(), count.ravel())
        met = depths(moves, part.boxes, at, np.where(np.isnan(top), -np.inf, top))
        return np.where(met > LEAST, met, 0.0).reshape(x.shape), (floor > z).reshape(x.shape)

    def height(some: Index, rho: Array) -> Array:
        return edge_height(rho, *(column[move[some], None] for column in (moves.flat, moves.corner, moves.slope)))

    some = np.flatnonzero(across > UPRIGHT)
    rim = np.zeros((len(known), len(RIM)))
    rim[some] = deep(some, radius[some, None] * INSIDE, RIM, place[some, 2:] + height(some, radius[some, None]))[0][:, 0]
    found.area[known] = across * radius * (rim @ np.cos(RIM)) * STEP
    plain, cuts = (flat == radius) & (across > UPRIGHT), rim > 0
    for column, values in zip(found[1:], (rim.max(axis=1), radius * (cuts @ np.cos(RIM)) * STEP, cuts.sum(axis=1) * STEP)):
        column[known] = np.where(plain, values, 0.0)
    some = np.flatnonzero((flat < radius) | (way[:, 2] < -UPRIGHT))
    stands = deep(some, radius[some, None] * SPOTS, AROUND[::3], place[some, 2:])[0].max(axis=(1, 2), initial=0.0)
    edges = _rings(moves[move[some]], stands)
    low, middle, high = (height(some, edges)[:, k::2] for k in (0, 1, 2))
    inner, at, outer = (edges[:, k::2] for k in (0, 1, 2))
    low, inner = low[:, :-1], inner[:, :-1]
    met, off = deep(some, at, AROUND, place[some, 2:] + middle)
    rising = ((inner + at) * (middle - low) + (at + outer) * (high - middle))[:, :, None] / 2
    full = np.divide(met + (middle - low)[:, :, None], (high - low)[:, :, None], out=np.ones_like(met), where=rising > 0)
    rising = rising * full.clip(0.0, 1.0) * np.cos(AROUND) * 2 * np.sin(TURN / 2) * across[some, None, None]
    faces = rising - (way[some, 2, None] * (outer**2 - inner**2) / 2 * TURN)[:, :, None]
    found.area[known[some]] += np.where((met > 0) & (off == 0), faces, 0.0).clip(0.0).sum(axis=(1, 2))
    return found


def _rings(moves: Moves, stands: Array) -> Array:
    """Where rings of the lower sides begin, have their middles, and end (k, 2 m + 1), as far as material stands above tips."""
    bent = np.sqrt(np.maximum(moves.corner**2 - np.maximum(moves.corner - stands, 0.0) ** 2, 0.0))
    out = np.where(moves.slope > 0, stands / np.where(moves.slope > 0, moves.slope, 1.0), bent)
    wide = np.minimum(out, moves.radius - moves.flat)[:, None]
    inner, outer = np.arange(2 * FLAT) / (2 * FLAT), np.arange(2 * BENT + 1) / (2 * BENT)
    return np.concatenate([moves.flat[:, None] * inner, moves.flat[:, None] + wide * outer], axis=1)
