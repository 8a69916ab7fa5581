"""Exact: how high moves leave the material at points."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.milling.moves import STILL, Cutter, Moves, edge_height
from mnclab.workpiece.outcome import spend

# Exact: how high arcs about Z that go up or down leave the material at points.
# Of a point and a helix only that turn matters on which the tool comes over it last, on its way down, and the turn before:
# the last may be cut short. While the tool is over the point its tip falls evenly, and the edge above it rises with the
# distance; where both are equal the point is left lowest.

FULL_TURN = 2 * np.pi
SAMPLES = 25  # of a turn, between which the edge begins to rise faster than the tip falls
TURN_HALVINGS = 24  # of the place between two of them: 1e-8 rad


class Pairs(NamedTuple):
    """Moves over points (p,): the tip's height when it is in line with a point, its fall in mm for each rad, distances of
    point and path from the centre, and the cutter."""

    z: Array
    fall: Array
    out: Array
    round_: Array
    radius: Array
    flat: Array
    corner: Array
    slope: Array

    def of(self, which: Index | Mask) -> Pairs:
        return Pairs(*(column[which] for column in self))

    def heights(self, angle: Array) -> Array:
        """What is left under a tool that is an angle past its point."""
        rho = np.minimum(self._rho(angle), self.radius)
        return np.asarray(self.z - self.fall * angle + edge_height(rho, self.flat, self.corner, self.slope))

    def _rho(self, angle: Array) -> Array:
        rho2 = self.out**2 + self.round_**2 - 2 * self.out * self.round_ * np.cos(angle)
        return np.sqrt(np.maximum(rho2, 0.0))

    def rises(self, angle: Array) -> Mask:
        """Whether the edge over the point rises faster than the tip falls."""
        rho = self._rho(angle)
        beyond = np.maximum(rho - self.flat, 0.0)
        room = np.sqrt(np.maximum(self.corner**2 - beyond**2, 0.0))
        away = self.out * self.round_ * np.sin(angle)  # rho times how fast it grows
        bent = self.corner > 0
        return np.asarray(np.where(bent, beyond, self.slope) * away > self.fall * rho * np.where(bent, room, 1.0))

    def lowest(self, low: Array, high: Array) -> Array:
        """Between which angles it is left lowest: where the edge begins to rise faster, or at the end."""
        low = np.minimum(np.maximum(low, 0.0), high)
        width = (high - low) / (SAMPLES - 1)
        first = np.full(len(low), SAMPLES)
        for k in reversed(range(SAMPLES)):
            first[self.rises(low + width * k)] = k
        a, b = low + width * np.maximum(first - 1, 0), low + width * first
        a, b = np.where(first == 0, low, a), np.where(first == SAMPLES, high, np.where(first == 0, low, b))
        a = np.where(first == SAMPLES, high, a)
        for _ in range(TURN_HALVINGS):
            middle = (a + b) / 2
            rises = self.rises(middle)
            a, b = np.where(rises, a, middle), np.where(rises, middle, b)
        place = (a + b) / 2
        return np.where(self.heights(high) < self.heights(place), high, place)


def helix(moves: Moves, x: Array, y: Array) -> Array:
    """The height (k, m) that each arc leaves at each point, infinite where it does not reach."""
    down = moves.end[:, 2] < moves.start[:, 2]  # looked at in the sense in which it goes down
    top, bottom = np.where(down[:, None], moves.start, moves.end), np.where(down[:, None], moves.end, moves.start)
    sense, whole = np.where(down, 1, -1) * np.sign(moves.sweep), np.abs(moves.sweep)
    spoke = top[:, :2] - moves.centre
    round_ = np.hypot(spoke[:, 0], spoke[:, 1])
    px, py = x - moves.centre[:, :1], y - moves.centre[:, 1:]
    out = np.hypot(px, py)
    which, at = np.nonzero(np.abs(out - round_[:, None]) <= moves.radius[:, None])
    found = np.full(out.shape, np.inf)
    if not len(which):
        return found
    out, px, py, round_ = out[which, at], px[which, at], py[which, at], round_[which]
    half = _half(out, round_, moves.radius[which])
    turned = np.mod((np.arctan2(py, px) - np.arctan2(spoke[:, 1], spoke[:, 0])[which]) * sense[which], FULL_TURN)
    fall = ((top[:, 2] - bottom[:, 2]) / whole)[which]
    cutter = (each[which] for each in moves.shape)
    pairs = Pairs(top[which, 2], fall, out, round_, *cutter)
    bent = pairs.flat < pairs.radius
    last = np.floor((whole[which] - turned + half) / FULL_TURN)
    for turn in (last, last - 1):
        passed = turned + FULL_TURN * turn  # how far round the tool is when it is in line with the point
        low, high = np.maximum(-half, -passed), np.minimum(half, whole[which] - passed)
        over = low <= high
        some, place = pairs._replace(z=pairs.z - fall * passed), high.copy()
        if (both := over & bent).any():  # a flat cutter leaves least where it goes
            place[both] = some.of(both).lowest(low[both], high[both])
        left = some.of(over).heights(place[over])
        spots = which[over], at[over]
        found[spots] = np.minimum(found[spots], left)
    return found


def _half(out: Array, round_: Array, radius: Array) -> Array:
    """How far before and after it is in line with a point a tool is over it, rad."""
    product = 2 * out * round_
    with np.errstate(divide="ignore", invalid="ignore"):
        cosine = (out * out + round_ * round_ - radius * radius) / product
    return np.arccos(np.clip(np.where(product > 0, cosine, -1.0), -1.0, 1.0))


# The height at a point is the least of `z(t) + h(rho(t))` along a move, where `h` is the lower side of the cutter and `rho`
# the distance of the point from the tool's axis. `h` never falls outwards and is convex, so along a straight move the sum
# is convex too: its least value lies where the slopes are equal, at the rim of the tool, or at an end of the move.

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
    cutters = moves.by_cutter(np.arange(len(moves)))
    if len(cutters) == 1:
        return _of_cutter(moves, cutters[0][0], x, y)
    found = np.empty((len(moves), x.shape[-1]))
    for cutter, which in cutters:
        found[which] = _of_cutter(moves[which], cutter, *((x[which], y[which]) if x.ndim == 2 else (x, y)))
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
