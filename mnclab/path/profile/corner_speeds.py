"""How fast a corner is taken: the square of the speed from the two tangents that meet there.

With Δu the difference of the unit tangents (per axis Δu_k), a_k and j_k the limits of the axes, ε the corner tolerance:

**tolerance**
    The corner is replaced by a piece in which the velocity changes from v u1 to v u2 in a time T. A constant
    acceleration needs T = v max(|Δu_k| / a_k) and leaves the corner by e = v |Δu| T / 8, so
    `v² = 8 ε / (|Δu| max(|Δu_k| / a_k))`. This is the parabolic blend of J. J. Craig, *Introduction to Robotics*,
    ch. 7. Under a jerk limit the acceleration rises and falls in a triangle, T = 2 v max(|Δu_k| / a_k) or
    2 sqrt(v max(|Δu_k| / j_k)), whichever is longer, and e = v |Δu| T / 12. The piece must fit into half of either
    neighbour: `v T <= the shorter one`.
**deviation**
    A circle touches both legs and leaves the corner by ε; it is run with v² = a r:
    `v² = a ε sin(β/2) / (1 - sin(β/2))`, β the angle between the legs (180° is straight on) and a the least of the
    path accelerations of the two rows and of what the axes bear along Δu. S. K. Jeon, "Improving Grbl: Cornering
    Algorithm" (2011). The circle touches neither leg beyond its middle, `v² <= a l tan(β/2) / 2` with l the shorter
    one: so plan Klipper (move_centripetal_v2) and Marlin (limit_sqr), and short lines of a curve keep to v² = a r.
**grbl**
    The same as Grbl 1.1 plans it (planner.c): a along Δu alone, and however short the legs are. On short lines of a
    curve the axes are asked for more than they have.
**jump**
    The speed of an axis may jump by s_k: `v = min(s_k / |Δu_k|)`. Marlin calls this classic jerk.

    Many short lines that stand for a curve, |Δu| l / 8 <= ε with l the mean length of the neighbours, may share their
    acceleration: it follows the curvature κ = Δu / l of each corner, goes over into that of the next corner within the
    row between them, and so `v² <= min(a_k / |κ_k|)` and `v³ <= min(j_k L / |κ_k' - κ_k|)`. The greater speed counts
    under "tolerance", the smaller one under "deviation".

Tangents that differ by less than `TANGENT` are no corner: rounded coordinates make tangent joints miss by that. But where
they follow each other in short rows they are a curve: but for "grbl" and "jump" `v² <= l / max(|Δu_k| / a_k)` holds.
Under a jerk limit a joint of line and arc is a corner too, for the centripetal acceleration v² Δκ begins at once. Spread
over the time T = v² max(|Δκ_k| / j_k) it leaves the path by v² |Δκ| T² / 24, hence
`v⁶ = 24 ε / (|Δκ| max(|Δκ_k| / j_k)²)`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from mnclab.path.columns import Array, Mask
from mnclab.path.limits import Limits
from mnclab.path.toolpath import Toolpath

TANGENT = 5e-4  # rad

Columns = Sequence[Array]  # X, Y and Z
Slack = float | Array  # how far a corner may be cut, mm; one for all, or one a corner
Pair = tuple[Array, Array]  # of the row before the corner and the row after it
Rule = Callable[[Columns, Columns, Pair, Pair, Slack], Array]


def rule(limits: Limits) -> Rule:
    """v² (m,) from the tangents before and after, the path accelerations and the lengths of both rows, and the tolerance."""
    jerks, jumps = limits.axes("jerk"), limits.axes("corner_jump")
    smooth, own = bool(np.isfinite(jerks).any()), limits.corner_speed == "grbl"

    def tolerance(before: Columns, after: Columns, accelerations: Pair, lengths: Pair, slack: Slack) -> Array:
        turn, slow, slower = _changes(before, after, limits.axes("acceleration"), jerks if smooth else None)
        short = np.minimum(*lengths)
        with np.errstate(divide="ignore", invalid="ignore"):  # straight on, or a row of no length
            room = np.fmin(short / slow, np.inf)
            if not np.any(slack):
                return np.where(turn < TANGENT, room, 0.0)
            if not smooth:
                w = np.minimum(8 * slack / (turn * slow), room)
            else:
                w = np.minimum(6 * slack / (turn * slow), short / (2 * slow))
                w = np.minimum(w, (6 * slack / (turn * np.sqrt(slower))) ** (4 / 3))
                w = np.minimum(w, (short / (2 * np.sqrt(slower))) ** (4 / 3))
        straight = turn < TANGENT
        w[straight] = room[straight]
        return w

    def deviation(before: Columns, after: Columns, accelerations: Pair, lengths: Pair, slack: Slack) -> Array:
        turn, slow, _ = _changes(before, after, limits.axes("acceleration"), None)
        half = turn * turn
        half *= -0.25
        half += 1.0
        np.sqrt(np.maximum(half, 0.0, out=half), out=half)  # sin(β/2) = cos(turn / 2)
        with np.errstate(divide="ignore", invalid="ignore"):  # straight on
            w = np.fmin(turn / slow, 1e12 if own else np.minimum(*accelerations))
            room = np.minimum(*lengths) * half / slow
        straight = np.flatnonzero(turn < TANGENT)
        half[straight] = 1.0 - TANGENT**2 / 8
        w *= slack
        w *= half
        w /= 1.0 - half
        w[straight[np.broadcast_to(slack, len(w))[straight] == 0]] = np.inf
        return w if own else np.fmin(w, room, out=w)

    def jump(before: Columns, after: Columns, accelerations: Pair, lengths: Pair, slack: Slack) -> Array:
        w, turn = np.full(len(before[0]), np.inf), np.zeros(len(before[0]))
        with np.errstate(divide="ignore", invalid="ignore"):
            for b, c, most in zip(before, after, jumps):
                change = np.abs(c - b)
                turn += change**2
                w = np.fmin(w, (most / change) ** 2)
        w[turn < TANGENT**2] = np.inf
        return w

    return {"tolerance": tolerance, "deviation": deviation, "grbl": deviation, "jump": jump}[limits.corner_speed]


def _changes(before: Columns, after: Columns, accelerations: Array, jerks: Array | None) -> tuple[Array, Array, Array]:
    """|Δu|, max(|Δu_k| / a_k) and max(|Δu_k| / j_k), each (m,)."""
    turn, slow, slower = (np.zeros(len(before[0])) for _ in range(3))
    for k in range(3):
        change = after[k] - before[k]
        turn += change * change
        np.abs(change, out=change)
        np.maximum(slow, change / accelerations[k], out=slow)
        if jerks is not None:
            np.maximum(slower, change / jerks[k], out=slower)
    return np.sqrt(turn, out=turn), slow, slower


def tolerances(path: Toolpath, limits: Limits) -> Slack:
    """How far the corners (n - 1,) between rows may be cut: what the program allows on both rows, or else the limits."""
    if np.isnan(path.tolerance).all():
        return limits.corner_tolerance
    own = np.where(np.isnan(path.tolerance), limits.corner_tolerance, path.tolerance)
    return np.minimum(own[1:], own[:-1])


def bend_joints(before: Array, after: Array, limits: Limits, slack: Slack) -> Array:
    """v² (m,) where the curvature vector (m, 3) changes, under a jerk limit."""
    change = np.abs(after - before)
    slow = (change / limits.axes("jerk")).max(axis=1)
    size = np.linalg.norm(change, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        w = np.cbrt(24 * slack / (size * slow**2))
    largest = np.maximum(np.linalg.norm(before, axis=1), np.linalg.norm(after, axis=1))
    return np.where(size <= TANGENT * largest, np.inf, w)


def curves(tangent: Array, length: Array, lines: Mask, limits: Limits, slack: Slack) -> Array:
    """v² (n - 1,) at the corners between rows that are short lines of a curve, 0 elsewhere; under a jerk limit.
    `tangent` (n, 3) and `length` (n,) of all rows; `lines` (n,) says which of them are lines."""
    mean = (length[1:] + length[:-1]) / 2
    corner = lines[1:] & lines[:-1]
    turn = np.where(corner[:, None], tangent[1:] - tangent[:-1], 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        bend = np.where(corner[:, None], turn / mean[:, None], 0.0)
        around = np.concatenate([np.zeros((1, 3)), bend, np.zeros((1, 3))])
        change = np.abs(np.diff(around, axis=0)) / limits.axes("jerk")  # over each row
        cubed = length / change.max(axis=1)
        w = np.cbrt(np.minimum(cubed[1:], cubed[:-1])) ** 2
        w = np.minimum((limits.axes("acceleration") / np.abs(bend)).min(axis=1), w)
    fits = corner & (np.linalg.norm(turn, axis=1) * mean <= 8 * slack)
    return np.where(fits, np.nan_to_num(w, nan=0.0, posinf=np.inf), 0.0)
