"""Finishing the walls of an area: each boundary on its own, up to it and off it on quarter circles that stay inside.

    C = area inset by R + allowance      where the tool centre may go; its boundaries, corners rounded, are the passes
    g                                    radius of the quarter circles, with their centre at p + g·n, n from the wall
                                         into the area; they and the way from end to start lie in the disc about it

A pass begins in the middle p of its longest element that has room for such a disc. Where none has, the tool comes
straight along n and leaves the same way. The first way in and the last way out may be helices, from and to a `rise` above
their level. Lengths in mm, feeds in mm/min.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, left
from mnclab.geometry.regions import Region
from mnclab.machining.milling.clearing import begin, numbered, unfit
from mnclab.machining.milling.finishing import LEAST, quarter_circles
from mnclab.machining.milling.rings import rounded
from mnclab.machining.steps import RAPID, Along, Go, Step

SLACK = 1e-7  # mm, by which an arc may leave the area
HALVINGS = 40


class Wall(NamedTuple):
    """A closed pass along a boundary and the open ways to it and off it."""

    contour: Contour
    approach: Contour
    departure: Contour
    tangential: bool

    @property
    def start(self) -> tuple[float, float]:
        """Where the tool goes down."""
        x, y = begin(self.approach).tolist()
        return x, y


class Heights(NamedTuple):
    """Along the tool axis: the levels, first to last, how far above the last one its helices begin, where rapids go.

    `first` is the height of the way to the first wall, `above` that of the ways between walls. A `rise` counts upwards,
    where the tool works upwards it is negative.
    """

    levels: Sequence[float]
    rise: float
    first: float
    above: float


def wall_loops(
    region: Region, radius: float, *, allowance: float = 0.0, corner_radius: float = 0.0, climb: bool = True,
    lead: float | None = None, least: float = 0.0, solid: bool = False,
) -> tuple[Wall, ...]:  # fmt: skip
    """The walls of an area for a tool of a radius, islands before the wall about them; a ValueError where it does not fit.

    `lead` is the radius of the quarter circles (None: half the tool radius), shortened down to `least` to stay inside.
    `corner_radius` rounds inside corners, as measured on the tool centre. In climb milling, the spindle turning clockwise,
    walls are followed counter-clockwise and islands clockwise. A `solid` region stays, and is gone round outside.
    """
    if not radius > 0:
        raise ValueError(f"the tool radius must be greater than 0, got {radius:g}")
    wish = max(radius / 2 if lead is None else lead, least)
    free = outside(region, 2 * (radius + abs(allowance) + wish) + 1) if solid else region
    centres = free.inset(radius + allowance)
    loops = [loop for part in centres.parts for loop in (*part.loops[1:], part.loops[0])]
    if solid:
        loops.remove(max(loops, key=lambda loop: loop.area))  # the edge of what is outside
    if not loops:
        raise ValueError(unfit(free, radius, allowance))
    return tuple(_wall(centres, rounded(loop, corner_radius), wish, least, climb) for loop in loops)


def outside(region: Region, margin: float) -> Region:
    """What lies around a region, to a rectangle `margin` away from it."""
    (left_, below), (right, above) = region.bounds + np.array([[-margin], [margin]])
    corners = [(left_, below), (right, below), (right, above), (left_, above)]
    return Region.of(Contour(corners)).difference(region)


def finish_walls(walls: Sequence[Wall], at: Heights, plunge: float, feed: float) -> Iterator[Step]:
    """Every wall on all its levels, one after the other, from above; the tool ends at the last level of the last wall."""
    height = at.first
    for which, wall in zip(numbered("wall", len(walls)), walls, strict=True):
        yield Go(f"{which}, to the clearance height", height)
        yield Go(f"{which}, over the start", None, RAPID, *wall.start)
        yield Go(f"{which}, to the set-up clearance", at.above)
        for label, level in zip(numbered("infeed", len(at.levels)), at.levels, strict=True):
            rise = at.rise if wall.tangential and level == at.levels[-1] else 0.0
            yield Go(f"{which}, {label}, back to the start", None, feed, *wall.start)
            yield Go(f"{which}, {label}, down", level + rise, plunge)
            yield Along(f"{which}, {label}, approach", wall.approach, feed, [level + rise, level])
            yield Along(f"{which}, {label}", wall.contour, feed)
            yield Along(f"{which}, {label}, departure", wall.departure, feed, [level, level + rise])
        height = at.above


def _wall(centres: Region, loop: Contour, wish: float, least: float, climb: bool) -> Wall:
    """A boundary of the tool-centre area, which lies to its left, begun where its arcs have room."""
    upto = np.cumsum(loop.lengths) - loop.lengths / 2
    places, ahead = loop.point_at(upto)
    inwards = left(ahead)
    room = centres.distance(places + least * inwards) >= least - SLACK
    k = int(np.argmax(np.where(room, loop.lengths, 0.0) if room.any() else loop.lengths))
    contour = loop.started_at(float(upto[k]))
    contour = contour if climb else contour.reversed()
    reach = _widest(centres, places[k], inwards[k], wish, least) if room.any() else 0.0
    if reach > LEAST:
        approach, departure = quarter_circles(contour, reach, 1 if climb else -1)
        return Wall(contour, approach, departure, tangential=True)
    straight = _straight(centres, contour.points[0], inwards[k], wish)
    return Wall(contour, straight, straight.reversed(), tangential=False)


def _widest(centres: Region, place: Floats, inwards: Floats, wish: float, least: float) -> float:
    """The greatest radius, from `least` to `wish`, of a disc inside that touches the boundary at a place."""

    def fits(radius: float) -> bool:
        return bool(centres.distance([place + radius * inwards])[0] >= radius - SLACK)

    if fits(wish):
        return wish
    low, high = least, wish  # a disc that fits holds all smaller ones that touch there
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if fits(middle) else (low, middle)
    return low


def _straight(centres: Region, place: Floats, inwards: Floats, wish: float) -> Contour:
    """The straight way to a place from where, along the normal, the tool is clearest of the walls: without room from itself."""
    far = place + wish * np.append(0.5 ** np.arange(HALVINGS), 0.0)[:, None] * inwards
    clear = np.where([centres.holds(spot, place) for spot in far], centres.distance(far), -1.0)
    return Contour([far[int(clear.argmax())], place], closed=False)
