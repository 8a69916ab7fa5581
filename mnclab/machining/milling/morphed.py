"""One spiral from the middle of an area into its walls, whose turns take the shape of the walls little by little.

Its turns follow the level curves of a membrane, as M. B. Bieterman and D. R. Sandstrom, A curvilinear tool-path method for
pocket machining, J. Manuf. Sci. Eng. 125, 2003, do: smooth curves, round about the middle. The height u of a membrane under
a load, held at the walls, or of one without a load between an island and the wall:

    Δu = -1, u = 0 at the wall, t = √(2·(u_greatest - u))           Δu = 0, u = 1 at the island, 0 at the wall, t = 1 - u

It is a sum of logarithms of the distance from places beyond the walls (G. Fairweather and A. Karageorghis, The method of
fundamental solutions for elliptic boundary value problems, Adv. Comput. Math. 9, 1998). From the middle on, t grows such that no
point of a level curve is more than a stepover from the one a turn before; where the middle has several peaks, level curves part,
and more than one island would divide them: there is no spiral then. Lengths in mm.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np

from mnclab.geometry.biarcs import smoothed
from mnclab.geometry.curves import Floats, at_angle, cross, dot, length_of, unit_of
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import covered, polygons, stays
from mnclab.machining.milling.adaptive import SPARED, adaptive_piece, in_climb
from mnclab.machining.milling.clearing import Clearing, Piece
from mnclab.machining.milling.rounded import Chain
from mnclab.text.alarm import several

SOURCES = 500  # at most, round an area
DEEP = 3.0  # spacings of the sources that they lie beyond the wall
STEPS = 4  # level curves to a turn
BLUNT = (1.3, 2.0, 3.0, 5.0)  # of the smallest radius: what sharper turns get, until arcs through them are not sharper than that
ROUNDS = 300  # in which they get it
EASED = 0.5  # of the last turn, in which the spiral comes up to the wall without an angle
COARSE, FINE = 3, 8  # places to a tool radius, on level curves and on the spiral
ROUND = 0.5  # of the stepover: the radius of corners of what the spiral fills
GRID = 60  # places across an area, among which its middle is looked for
NEAR = 0.55  # of the stepover: no place but corners is farther from a turn,
LEFT = 1e-4  # but for so much of the area
PARTED = "its middle has several peaks, between which turns would part"


class NoSpiral(Exception):
    """Why an area has no spiral, in words."""


def morphed_spiral(
    region: Region, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True,
    stock: Region | None = None, smallest: float | None = None,
) -> Clearing:  # fmt: skip
    """An area cleared on one spiral from its middle, or from round its island, into the wall; no two turns are more than a
    stepover apart. Walls and island are run last.

    An area with several islands, with several middles, or with open sides, where a `stock` fills a part of it, has no such
    spiral: it is cleared as `adaptive` does, and the `note` of the clearing says why. Arcs are not smaller than `smallest` (None:
    a tenth of the tool radius) beyond the entry.

    >>> pocket = mnc.area.Region.of(mnc.area.rectangle(40, 20))
    >>> len(mnc.strategies.morphed_spiral(pocket, 4, 3).pieces)  # it goes down once
    1
    """
    notes = []

    def plan(part: Region, least: float, solid: Any) -> Piece:
        try:
            if solid is not None:
                raise NoSpiral("the stock leaves sides open")
            return _piece(part, radius, stepover, least)
        except (NoSpiral, np.linalg.LinAlgError) as why:
            said = why if isinstance(why, NoSpiral) else "it has no middle"  # where the membrane is as high along a line
            notes.append(f"no spiral, cleared as adaptive does: {said}")
            return adaptive_piece(part, least, solid, radius=radius, stepover=stepover)

    found = in_climb(region, radius, stepover, allowance, climb, smallest, plan, stock)
    return replace(found, note="; ".join(dict.fromkeys(notes)))


def _piece(centres: Region, radius: float, stepover: float, least: float) -> Piece:
    """The spiral of one piece of where the tool centre may go, then its wall and island, climb."""
    if len(centres.loops) > 2:
        raise NoSpiral(f"it would have to go round {several(len(centres.loops) - 1, 'island')}")
    filled = _without_corners(centres, radius, stepover, least)
    points = _Spiral(Membrane(filled, min(radius, stepover) / 3), radius, stepover).points()
    curl = int((length_of(points - points[0]) > radius / 2).argmax())
    for blunt in BLUNT:
        way = smoothed(np.vstack([points[:curl], _blunted(points[curl:], blunt * least)]), radius / FINE, radius / 1000)
        away = np.append(length_of(way.points - way.points[0]) > radius, True)  # the entry ends a radius from where it began
        apart = float(way.upto[min(int(away.argmax()), len(way.points) - 1)])
        rest = way.between(apart, way.length) if apart < way.length else None
        if rest is None or rest.radii.min() >= least:
            break
    else:
        raise NoSpiral(f"it would bend more sharply than a radius of {least:g}")
    if not stays([way], polygons(centres))[0]:
        raise NoSpiral("its turns meet the wall")
    chain = Chain(centres, stepover, least)
    chain.add(way.between(0.0, apart), "entry spiral", False)
    if rest is not None:
        chain.add(rest, "spiral", True)
    for loop in sorted(centres.loops, key=lambda loop: -loop.area):
        chain.ring(loop.started_at(loop.nearest(chain.end)), "wall" if loop.area > 0 else "island")
    broad = polygons(filled.inset(stepover).offset(stepover))  # no turn comes as far into a sharp corner
    if broad.difference(covered(chain.passes, NEAR * stepover)).area > LEFT * centres.area:
        raise NoSpiral(PARTED)
    return chain.piece()


def _blunted(points: Floats, radius: float) -> Floats:
    """Places (n, 2) that are drawn towards their neighbours where the way through them bends more sharply than a radius."""
    for _ in range(ROUNDS):
        a, b = points[1:-1] - points[:-2], points[2:] - points[1:-1]
        turn = np.abs(np.arctan2(cross(a, b), dot(a, b)))
        sharp = turn > (length_of(a) + length_of(b)) / (2 * radius)
        sharp[1:-1] |= sharp[2:] | sharp[:-2]
        if not sharp.any():
            break
        points = points.copy()
        points[1:-1][sharp] += ((b - a) / 4)[sharp]
    return points


def _without_corners(centres: Region, radius: float, stepover: float, least: float) -> Region:
    """What the spiral fills: the area a little smaller and with round corners, the wider the better."""
    room = centres.inset(SPARED * radius)
    for size in (ROUND * stepover, BLUNT[0] * least):
        filled = room.inset(size).offset(size)
        lost = polygons(centres).difference(polygons(filled).buffer(radius)).area
        if len(filled.loops) == len(centres.loops) and lost <= 1e-9 * centres.area:
            return filled
    raise NoSpiral("it is too narrow in places")


class Membrane:
    """The height of a membrane over an area with at most one island, and its slope."""

    def __init__(self, area: Region, spacing: float) -> None:
        self.loops = loops = sorted(area.loops, key=lambda loop: -loop.area)
        self.loaded, self.size = len(loops) == 1, sum(loop.length for loop in loops)
        spacing = max(self.size / SOURCES, spacing)
        counts = [max(24, math.ceil(loop.length / spacing)) for loop in loops]
        spots = [loop.point_at(np.linspace(0, loop.length, 2 * n, endpoint=False)) for loop, n in zip(loops, counts, strict=True)]
        at, ahead = (np.vstack(both) for both in zip(*spots, strict=True))
        outward, deep = np.stack([ahead[:, 1], -ahead[:, 0]], axis=1), np.full(len(at), DEEP * spacing)
        for _ in range(8):  # nearer where a place beyond one wall would lie close to another
            beyond = at + outward * deep[:, None]
            deep[(area.distance(beyond) < 0.7 * deep) | area.contains(beyond)] *= 0.7
        self.middle = at.mean(axis=0)
        self.sources = self._flat(at + outward * deep[:, None])[::2]
        places = self._flat(at)
        held = np.abs(places) ** 2 / 4 if self.loaded else np.repeat([0.0, 1.0], 2 * np.array(counts))
        logs = np.log(np.abs(places[:, None] - self.sources))
        self.shares, *_ = np.linalg.lstsq(np.column_stack([logs, np.ones(len(at))]), held, rcond=1e-11)

    def _flat(self, points: Floats) -> Floats:
        """Points (n, 2) as complex numbers (n,), in lengths of the walls from the middle."""
        return ((points - self.middle) @ [1, 1j]) / self.size

    def at(self, points: Floats) -> tuple[Floats, Floats]:
        """The height at points (n, 2), `(n,)`, and its slope `(n, 2)`."""
        z, shares = self._flat(points), self.shares[:-1]
        x, y = (part(z)[:, None] - part(self.sources) for part in (np.real, np.imag))
        away2 = x * x + y * y  # real numbers: |x + iy| and its reciprocal take three times as long
        u = np.log(away2) @ (shares / 2) + self.shares[-1]
        slope = np.stack([(x / away2) @ shares, (y / away2) @ shares], axis=1)
        if self.loaded:
            u, slope = u - np.abs(z) ** 2 / 4, slope - np.stack([z.real, z.imag], axis=1) / 2
        return u, slope / self.size


class _Spiral:
    """Level curves from the middle to the wall and a spiral between them.

    Every curve (n, 2) goes left round, its points even, the first ones all on one way of steepest descent.
    """

    def __init__(self, membrane: Membrane, radius: float, stepover: float) -> None:
        self.membrane, self.radius, self.step = membrane, radius, stepover / STEPS
        if membrane.loaded:
            self.peak, bends, ways = self._top()
            self.height = float(membrane.at(self.peak[None])[0][0])
            self.wall, first = math.sqrt(2 * self.height), self.step * math.sqrt(bends[0])  # t at the wall and at an ellipse
            turn = at_angle(np.linspace(0, 2 * np.pi, 64, endpoint=False)) * first / np.sqrt(bends)
            self.levels, self.curves = [0.0, first], [self.peak + turn @ ways.T] * 2
        else:
            island = membrane.loops[1].reversed()
            self.wall, self.levels, self.curves = 1.0, [0.0], [self._even(island.points_within(1e-3), COARSE)]
        self._grow()

    def _top(self) -> tuple[Floats, Floats, Floats]:
        """Where the membrane is highest `(2,)`, how much it bends there along two axes `(2,)`, the less first, and these."""
        area, e = Region((self.membrane.loops[0],)), 1e-3 * self.radius
        spots = np.stack(np.meshgrid(*np.linspace(area.bounds[0], area.bounds[1], GRID).T), axis=-1).reshape(-1, 2)
        spots = spots[area.contains(spots)]
        if not len(spots):
            raise NoSpiral("it is too narrow in places")
        at = spots[self.membrane.at(spots)[0].argmax()]
        for _ in range(20):
            slope = self.membrane.at(at + e * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]]))[1]
            second = np.stack([slope[1] - slope[2], slope[3] - slope[4]]) / (2 * e)
            move = np.linalg.solve(second, slope[0])
            at = at - move
        bends, ways = np.linalg.eigh(-(second + second.T) / 2)
        if not (length_of(move) < e and bends[0] > 0):
            raise NoSpiral("it has no middle")
        ways[:, 0] *= np.linalg.det(ways)
        return at, bends, ways

    def _even(self, loop: Floats, fine: int) -> Floats:
        """Even places round a loop of points, so many to a tool radius."""
        loop = np.vstack([loop, loop[:1]])
        upto = np.append(0.0, np.cumsum(length_of(np.diff(loop, axis=0))))
        ways = np.linspace(0, upto[-1], max(64, math.ceil(upto[-1] * fine / self.radius)), endpoint=False)
        return np.stack([np.interp(ways, upto, loop[:, k]) for k in (0, 1)], axis=1)

    def _t(self, points: Floats) -> tuple[Floats, Floats]:
        """t at points (n, 2), `(n,)`, and its slope `(n, 2)`."""
        u, slope = self.membrane.at(points)
        if not self.membrane.loaded:
            return 1 - u, -slope
        t = np.sqrt(np.maximum(2 * (self.height - u), 1e-300))
        return t, -slope / t[:, None]

    def _moved(self, points: Floats, level: Floats | float) -> Floats:
        """Points moved along the slope to where t has a value."""
        for _ in range(8):
            t, slope = self._t(points)
            move = ((level - t) / np.maximum((slope**2).sum(axis=1), 1e-300))[:, None] * slope
            points = points + move
            if not length_of(move).max() < self.membrane.size:
                break
            if length_of(move).max() < 1e-4 * self.radius:
                return points
        raise NoSpiral(PARTED)

    def _grow(self) -> None:
        """Level curves as far as the wall; where the slope is least, each is one step from the last."""
        most = 50 * STEPS + 2 * self.membrane.size / self.step
        while True:
            curve = self.curves[-1]
            here = self._t(curve)[1]
            there = self._t(curve + self.step / 2 * unit_of(here))[1]  # about the least between, where the slope changes evenly
            ahead = self.step * float(np.minimum(length_of(here), length_of(there)).min())
            if self.levels[-1] + ahead >= self.wall:
                break
            if len(self.levels) > most:  # the slope is nothing where level curves part: they come no farther
                raise NoSpiral(PARTED)
            self.levels.append(self.levels[-1] + ahead)
            self.curves.append(self._even(self._moved(curve, self.levels[-1]), COARSE))
        steps = len(self.levels) - 1 + (self.wall - self.levels[-1]) / ahead
        self.turns = math.ceil(steps / STEPS)
        self.numbers = np.append(np.arange(len(self.levels)), steps) * self.turns / steps  # of turns, up to each level
        self.levels.append(self.wall)

    def points(self) -> Floats:
        """The places of the spiral `(n, 2)`: turn k begins on level k, and the way up to the wall ends in a parabola."""
        ways, last = [], self.turns - EASED / 2  # where that begins
        for turn in range(self.turns + 1):
            curve = self._even(self.curves[int(np.searchsorted(self.numbers[:-1], turn, "right")) - 1], FINE)
            number = turn + np.arange(len(curve)) / len(curve)
            curve, number = curve[number <= last + EASED], number[number <= last + EASED]
            eased = self.turns - (last + EASED - number) ** 2 / (2 * EASED)
            level = np.interp(np.where(number > last, eased, number), self.numbers, self.levels)
            beyond = np.full(len(curve), True)
            if self.membrane.loaded:  # the first level is an ellipse
                curve = self.peak + (curve - self.peak) * np.minimum(level / self.levels[1], 1)[:, None]
                beyond = level > self.levels[1]
            curve[beyond] = self._moved(curve[beyond], level[beyond])
            ways.append(curve)
        return np.vstack(ways)
