"""Exact: how high arcs about Z that go up or down leave the material at points.

Of a point and a helix only that turn matters on which the tool comes over it last, on its way down, and the turn before:
the last may be cut short. While the tool is over the point its tip falls evenly, and the edge above it rises with the
distance; where both are equal the point is left lowest.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.milling.cutters import edge_height
from mnclab.workpiece.milling.moves import Moves

FULL_TURN = 2 * np.pi
SAMPLES = 25  # of a turn, between which the edge begins to rise faster than the tip falls
HALVINGS = 24  # of the place between two of them: 1e-8 rad


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
        for _ in range(HALVINGS):
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
    cutter = (each[which] for each in (moves.radius, moves.flat, moves.corner, moves.slope))
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
