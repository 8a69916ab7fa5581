"""Exact: how high moves leave the material at points.

The height at a point is the least of `z(t) + h(rho(t))` along a move, where `h` is the lower side of the cutter and `rho`
the distance of the point from the tool's axis. `h` never falls outwards and is convex, so along a straight move the sum
is convex too: its least value lies where the slopes are equal, at the rim of the tool, or at an end of the move.
"""

from __future__ import annotations

import numpy as np

from mnclab.path.toolpath import Array
from mnclab.workpiece.effort import spend
from mnclab.workpiece.milling.cutters import Cutter, edge_height
from mnclab.workpiece.milling.helix import FULL_TURN, helix
from mnclab.workpiece.milling.moves import STILL, Moves

NONE = np.inf  # where a move does not reach
SEARCHED = 20  # times the work of another point: under a helix the place of the least height is searched
HALVINGS = 26  # of the place of the least height under a round corner: 1e-8 of it, and the height to its square
TOUCH = 1e-12  # of a radius, by which a point on the rim is under the tool


def left_by(moves: Moves, x: Array, y: Array) -> Array:
    """The height (k, m) that each of k moves leaves at each of m points, mm; infinite where it does not reach.

    x and y are (m,), or (k, 1): a point for each move.
    """
    each = x.ndim == 2
    found = np.full((len(moves), 1 if each else len(x)), NONE)
    travel = np.hypot(*(moves.end[:, :2] - moves.start[:, :2]).T)
    level = moves.start[:, 2] == moves.end[:, 2]
    standing = ~moves.arc & (travel <= STILL)
    classes = (
        (standing, _standing),
        (~moves.arc & ~standing & level, _level),
        (~moves.arc & ~standing & ~level, _sloping),
        (moves.arc & level, _level_arc),
        (moves.arc & ~level, helix),
    )
    points = found.shape[1]
    spend(points * (len(moves) + SEARCHED * int(np.count_nonzero(classes[-1][0]))))
    for which, sweep in classes:
        if which.all():
            return sweep(moves, x, y)
        if which.any():
            found[which] = sweep(moves[which], *((x[which], y[which]) if each else (x, y)))
    return found


def _raised(moves: Moves, z: Array, rho2: Array) -> Array:
    """Heights under cutters whose tips stand at `z`, at squared distances from their axes (k, m)."""
    radius = moves.radius[:, None]
    reached = rho2 <= radius * radius * (1 + TOUCH)
    if not (moves.flat < moves.radius).any():
        return np.where(reached, z, NONE)
    flat, corner, slope = moves.flat[:, None], moves.corner[:, None], moves.slope[:, None]
    return np.where(reached, z + edge_height(np.sqrt(rho2), flat, corner, slope), NONE)


def _standing(moves: Moves, x: Array, y: Array) -> Array:
    """A plunge, or a tool that stands."""
    rho2 = (x - moves.start[:, :1]) ** 2 + (y - moves.start[:, 1:2]) ** 2
    return _raised(moves, moves.low[:, None], rho2)


def _along(moves: Moves, x: Array, y: Array) -> tuple[Array, Array, Array]:
    """How far points lie ahead of the start and, squared, beside the line (k, m); the length of each move (k, 1)."""
    dx, dy = (moves.end - moves.start)[:, :2].T
    length = np.hypot(dx, dy)
    ux, uy = (dx / length)[:, None], (dy / length)[:, None]
    px, py = x - moves.start[:, :1], y - moves.start[:, 1:2]
    return px * ux + py * uy, (px * uy - py * ux) ** 2, length[:, None]


def _level(moves: Moves, x: Array, y: Array) -> Array:
    """A straight move at one height."""
    ahead, beside2, length = _along(moves, x, y)
    past = ahead - np.clip(ahead, 0.0, length)
    return _raised(moves, moves.start[:, 2:], beside2 + past * past)


def _sloping(moves: Moves, x: Array, y: Array) -> Array:
    """Straight moves that go up or down, those of one cutter at a time."""
    columns = moves.radius, moves.flat, moves.corner, moves.slope
    if all((column == column[0]).all() for column in columns):
        return _of_cutter(moves, Cutter(*(float(column[0]) for column in columns)), x, y)
    shapes, shape = np.unique(np.stack(columns, axis=1), axis=0, return_inverse=True)
    found = np.empty((len(moves), x.shape[-1]))
    for k, each in enumerate(shapes.tolist()):
        which = shape.reshape(-1) == k
        found[which] = _of_cutter(moves[which], Cutter(*each), *((x[which], y[which]) if x.ndim == 2 else (x, y)))
    return found


def _of_cutter(moves: Moves, cutter: Cutter, x: Array, y: Array) -> Array:
    """Straight moves of one cutter that go up or down: where the tool stood that cut deepest at a point."""
    ahead, beside2, length = _along(moves, x, y)
    reach2 = cutter.radius * cutter.radius * (1 + TOUCH)
    over = (beside2 <= reach2) & (np.abs(ahead - length / 2) <= length / 2 + cutter.radius)
    move = np.nonzero(over)[0]
    slope, length = ((moves.end[:, 2] - moves.start[:, 2]) / length[:, 0])[move], length[move, 0]
    found = np.full(ahead.shape, NONE)
    ahead, beside2 = ahead[over], beside2[over]
    behind = _lowest(cutter, beside2, np.abs(slope))  # how far the tool was past, or before, the point
    place = np.minimum(np.maximum(ahead - np.copysign(behind, slope), 0.0), length)
    rho2 = beside2 + (ahead - place) ** 2
    heights = moves.start[move, 2] + slope * place
    if cutter.flat < cutter.radius:
        heights += edge_height(np.sqrt(rho2), *cutter[1:])
    found[over] = np.where(rho2 <= reach2, heights, NONE)
    return found


def _lowest(cutter: Cutter, beside2: Array, slope: Array) -> Array:
    """How far along its move from a point (p,) the cutter is that leaves it lowest, were the move without ends."""
    radius, flat, corner, cone = cutter
    if corner and not flat:
        free = np.sqrt(np.maximum(corner * corner - beside2, 0.0))
        return np.asarray(free * slope / np.sqrt(1 + slope * slope))
    rim = np.sqrt(np.maximum(radius * radius - beside2, 0.0))
    if flat >= radius or not (corner or cone):
        return rim
    inner = np.sqrt(np.maximum(flat * flat - beside2, 0.0))
    if not cone:
        return _under_corner(inner, rim, beside2, slope, flat, corner)
    steep = slope >= cone
    out = slope / np.sqrt(np.where(steep, 1.0, cone * cone - slope * slope))
    return np.clip(np.where(steep, rim, np.sqrt(beside2) * out), inner, rim)


def _under_corner(low: Array, high: Array, beside2: Array, slope: Array, flat: float, corner: float) -> Array:
    """The place between two where the corner rises as the move does."""
    low, width, slope2, corner2 = low.copy(), high - low, slope * slope, corner * corner
    for _ in range(HALVINGS):
        width /= 2
        place2 = np.square(low + width)
        rho2 = beside2 + place2
        out2 = np.square(np.sqrt(rho2) - flat)
        falls = out2 * place2 <= slope2 * rho2 * (corner2 - out2)
        low += width * falls
    return np.asarray(low + width / 2)


def _level_arc(moves: Moves, x: Array, y: Array) -> Array:
    """An arc at one height: a point in its sector is as far from it as from its circle, another one as from an end."""
    px, py = x - moves.centre[:, :1], y - moves.centre[:, 1:]
    (sx, sy), (ex, ey) = ((ends[:, :2] - moves.centre).T[:, :, None] for ends in (moves.start, moves.end))
    sense, swept = np.sign(moves.sweep)[:, None], np.abs(moves.sweep)[:, None]
    after, before = (sx * py - sy * px) * sense >= 0, (px * ey - py * ex) * sense >= 0
    on = np.where(swept > np.pi, after | before, after & before) | (swept >= FULL_TURN)
    rho2 = (np.sqrt(px * px + py * py) - np.sqrt(sx * sx + sy * sy)) ** 2
    if not on.all():
        ends = (px - sx) ** 2 + (py - sy) ** 2, (px - ex) ** 2 + (py - ey) ** 2
        rho2 = np.where(on, rho2, np.minimum(*ends))
    return _raised(moves, moves.start[:, 2:], rho2)
