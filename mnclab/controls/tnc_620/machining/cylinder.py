"""Contours on the developed surface of a cylinder, and how a tool follows them. Lengths in mm, angles in rad.

A contour lies in the plane (u, y): u along the circumference, y along the axis. The tool is square to the cylinder. Where its
axis meets the axis of the cylinder is said by its *foot*, a point (u, y) whose angle u / radius the rotary axis has; from
there it is displaced by a *shift* (s, t), s along the circumference and t along the axis, which the linear axes make:

    tip = rho e_r(u / radius) + s e_t(u / radius) + (y + t) e_a

With a shift that is the whole offset the walls are parallel to the radial direction at the contour; without any, to that at
the tool centre.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.controls.tnc_620.machining import trains
from mnclab.geometry.contours import QUARTER, Contour
from mnclab.geometry.curves import Floats, left, length_of
from mnclab.path.toolpath import PathFault

CHORD = 1e-4  # mm, between an arc on the developed surface and the rows along it
LEAST = 1e-9  # mm: an offset or a radius below is none
Steps = Sequence[int] | NDArray[np.int64]


class RolledWay(NamedTuple):
    """n places of a tool on the developed surface: feet (n, 2), shifts (n, 2); `ways` (n,) lead there, 0 the first one."""

    feet: Floats
    shifts: Floats
    ways: Floats

    @property
    def last(self) -> RolledWay:
        """Its last place."""
        return RolledWay(self.feet[-1:], self.shifts[-1:], np.zeros(1))

    @property
    def centres(self) -> Floats:
        """Where the tool is, (n, 2)."""
        return self.feet + self.shifts


def beside(contour: Contour, distance: float, steps: Steps = ()) -> Contour:
    """The way of a tool centre beside a contour, `distance` to its left (or with a minus right), as `trains.beside` finds it.

    `steps` (m,) are those of the m elements, which a PathFault names where the tool does not fit.
    """
    if abs(distance) < LEAST:
        return opened(contour)
    try:
        found = trains.beside(contour, distance, 1)
        if found.fault is not None:
            raise found.fault
    except PathFault as fault:
        k = min(max(fault.step, 0), len(contour.starts) - 1)
        raise PathFault(_worded(fault.message), int(steps[k]) if len(steps) else k, fault.hint) from None
    return found.ways[0].contour


def _worded(text: str) -> str:
    """A fault of a tool radius as one of a distance, which more than the tool makes; the elements have no lines here."""
    for one, other in (
        ("tool radius", "distance"), ("tool of radius", "tool at the distance"), ("largest radius", "largest distance"),
    ):  # fmt: skip
        text = text.replace(one, other)
    return re.sub(r"that of line \d++", "another one", re.sub(r"the element of line \d++", "another element", text))


def opened(contour: Contour) -> Contour:
    """The same way as an open contour that ends where it began."""
    if not contour.closed:
        return contour
    return Contour(np.vstack([contour.points, contour.points[:1]]), np.append(contour.bulge, 0.0), closed=False)


def round_about(contour: Contour, distance: float, steps: Steps = ()) -> Contour:
    """The closed loop round an open contour at a `distance` to its left (or with a minus right): along it on this side, round
    its end, back on the other side and round its begin. The ends are half circles about its own ends."""
    there = beside(contour, distance, steps)
    back = beside(contour.reversed(), distance, steps[::-1])
    turn = -math.copysign(1.0, distance)  # with the contour on the right the loop turns to the right
    pieces = [there, Contour([there.points[-1], back.points[0]], [turn, 0.0], closed=False), back]
    pieces.append(Contour([back.points[-1], there.points[0]], [turn, 0.0], closed=False))
    return joined(pieces)


def joined(pieces: Sequence[Contour]) -> Contour:
    """One open contour of open ones that follow each other."""
    points = np.vstack([*(piece.points[:-1] for piece in pieces), pieces[-1].points[-1:]])
    return Contour(points, np.concatenate([*(piece.bulge[:-1] for piece in pieces), [0.0]]), closed=False)


def way_along(path: Contour, shift: float = 0.0, about: float = 1.0) -> RolledWay:
    """The places of a tool whose centre runs along a contour, with the foot `shift` to the right of it (to the left with a
    minus): a wall path `beside` a contour at that distance to the left has its feet on the contour.

    Lines are one piece; arcs are cut so that chords stay within `CHORD`, of the tool and of its feet. Where the path has a
    corner, the foot turns about the tool while the centre stands; `ways` then are those of the foot. `about` is how much
    longer the circumference is than in the contour, for contours that are `shrunk`.
    """
    centres, tangents = _sampled(path, abs(shift))
    shifts = shift * left(tangents)
    return _way((centres - shifts) * [about, 1.0], shifts)


def standing(foot: ArrayLike, path: Contour, about: float = 1.0) -> RolledWay:
    """The places of a tool whose centre runs along a contour while its foot stands: the linear axes alone move."""
    here = np.asarray(foot, dtype=float)
    shifts = _sampled(path, 0.0)[0] - here
    return _way(np.broadcast_to(here * [about, 1.0], shifts.shape), shifts)


def _sampled(path: Contour, reserve: float) -> tuple[Floats, Floats]:
    """Points and tangents (n, 2) of a contour, corners twice; good for a curve up to `reserve` beside it as well."""
    radius = np.where(path.sweeps == 0, np.inf, path.radii + reserve)
    step = 2 * np.arccos(np.clip(1 - CHORD / radius, -1.0, 1.0))
    with np.errstate(divide="ignore", invalid="ignore"):
        counts = np.where(path.sweeps == 0, 1, np.ceil(np.abs(path.sweeps) / step)).astype(np.int64)
    element = np.repeat(np.arange(len(counts)), counts + 1)
    share = np.concatenate([np.linspace(0.0, 1.0, count + 1) for count in counts.tolist()])
    return path.at(share, element)


def _way(feet: Floats, shifts: Floats) -> RolledWay:
    """Places without those where nothing moves."""
    centre_ways = np.append(0.0, length_of(np.diff(feet + shifts, axis=0)))
    foot_ways = np.append(0.0, length_of(np.diff(feet, axis=0)))
    ways = np.where(centre_ways > LEAST, centre_ways, foot_ways)
    keep = np.append(True, ways[1:] > LEAST)
    return RolledWay(feet[keep], shifts[keep], ways[keep])


def slot_round(
    contour: Contour, distance: float, straight: bool = False, about: float = 1.0, steps: Steps = ()
) -> list[tuple[str, RolledWay]]:
    """Once round inside a slot, from the begin of its midpoint path and back there: along the wall `distance` to its left (or
    with a minus right), across at its end, back along the other wall. On to the walls and off them the tool goes on half
    circles, or `straight`.
    """
    if abs(distance) < LEAST:
        return [("slot", way_along(opened(contour), 0.0, about)), ("back", way_along(opened(contour.reversed()), 0.0, about))]
    there, back = beside(contour, distance, steps), beside(contour.reversed(), distance, steps[::-1])
    begin, end = contour.points[0], contour.ends[-1]
    bend = 0.0 if straight else -math.copysign(1.0, distance)
    on = Contour([begin, there.points[0]], [bend, 0.0], closed=False)
    across = Contour([there.points[-1], back.points[0]], closed=False)
    off = Contour([back.points[-1], begin], [bend, 0.0], closed=False)
    return linked(
        [
            ("approach", standing(begin, on, about)), ("first wall", way_along(there, distance, about)),
            ("across", standing(end, across, about)), ("second wall", way_along(back, distance, about)),
            ("departure", standing(begin, off, about)),
        ]
    )  # fmt: skip


def linked(pieces: Sequence[tuple[str, RolledWay]]) -> list[tuple[str, RolledWay]]:
    """Ways that follow each other, each with the way from the end of the one before to its first place."""
    found = [*pieces[:1]]
    for (_, before), (label, way) in pairwise(pieces):
        gap = max(length_of(way.centres[0] - before.centres[-1]), length_of(way.feet[0] - before.feet[-1]))
        found.append((label, way._replace(ways=np.append(gap if gap > LEAST else 0.0, way.ways[1:]))))
    return found


def shrunk(contour: Contour, ratio: float) -> Contour:
    """A contour of the surface where the circumference is `ratio` times as long: lines stay lines, arcs become chords."""
    if not contour.bulge.any():
        return Contour(contour.points * [ratio, 1.0], closed=contour.closed)
    points = contour.points_within(CHORD)
    return Contour((points[:-1] if contour.closed else points) * [ratio, 1.0], closed=contour.closed)


def lead(path: Contour, gap: float, arrives: bool, straight: bool = False) -> Contour:
    """The way on to an open wall path (it `arrives`), or off it, from the place `gap` to the left of its end (or with a minus
    right): along a line and a quarter circle of this radius that touches the wall, or `straight`.
    """
    ahead = path.tangents()[0][0] if arrives else -path.tangents()[1][-1]
    wall = path.points[0] if arrives else path.points[-1]
    out = gap * left(ahead) * (1.0 if arrives else -1.0)
    if straight:
        found = Contour([wall + out, wall], closed=False)
    else:
        bend = math.copysign(QUARTER, gap) * (1.0 if arrives else -1.0)
        found = Contour([wall + out, wall + out - abs(gap) * ahead, wall], [0.0, bend, 0.0], closed=False)
    return found if arrives else found.reversed()


def remachining(contour: Contour, shift: float, radius: float, floor: float, tolerance: float) -> tuple[float, ...]:
    """The radii from whose slot walls further passes take their direction, so that no wall misses the ideal one by more than
    a `tolerance`; none where the first pass is good enough.

    The ideal slot is that of a tool as wide as the slot. At the radius rho it runs along the contour shrunk by rho / radius
    along the circumference: where the contour has the direction a, the wall there has b, tan b = (radius / rho) tan a. A
    smaller tool, displaced by e = `shift` square to a, makes a wall that lies e (1 - cos(b - a)) inside of the ideal one,
    never outside; b grows from the surface down to the `floor`. A pass displaced square to the direction at another radius is
    good where b differs by at most h = acos(1 - tolerance / e) from the direction there. So each pass reaches from the last
    good b up to h above its own, and the next one stands h further: for the direction a alone, from which b bends by B, these
    are ceil((B - h) / 2h) passes.
    """
    if not tolerance or abs(shift) <= tolerance or floor >= radius:
        return ()
    half, deepest = math.acos(1 - tolerance / abs(shift)), radius / floor
    slopes = np.abs(np.tan(_directions(contour)))
    slopes = slopes[(slopes > LEAST) & (slopes < 1 / LEAST)]
    found = []
    good = _steeper(slopes, 1.0, half)
    while good < deepest:
        at = min(_steeper(slopes, good, half), deepest)
        found.append(radius / at)
        good = _steeper(slopes, at, half)
    return tuple(found)


def _steeper(slopes: Floats, ratio: float, angle: float) -> float:
    """How often shorter the circumference is where the first of directions with `slopes` (n,) has bent by an angle more than
    where it is `ratio` times shorter; inf where none does."""
    bent = np.arctan(ratio * slopes) + angle
    return float(np.min(np.where(bent < np.pi / 2, np.tan(bent) / slopes, np.inf), initial=np.inf))


def _directions(contour: Contour) -> Floats:
    """Directions (n,) of the contour: of lines, and close together along arcs."""
    begin, _ = contour.tangents()
    first = np.arctan2(begin[:, 1], begin[:, 0])
    along = [a + sweep * np.linspace(0.0, 1.0, 257) for a, sweep in zip(first, contour.sweeps, strict=True) if sweep]
    return np.concatenate([first, *along])
