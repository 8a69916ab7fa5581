"""Sections through a part and its target: the target hatched, the part beside it with the deviation magnified."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import PathPatch

from mnclab.design.difference.difference import Difference
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array
from mnclab.show.plot.classes import number
from mnclab.show.plot.picture import SMALL
from mnclab.show.plot.sections import ACROSS, CARD, FACE, HATCH, Section, outline_of
from mnclab.show.plot.sections import sections_of as sections_of_part
from mnclab.text.alarm import Alarm

PLACES = 1200  # along the longer side
FULL = 10.0  # tolerances: what is off by more has the full colour, and is not magnified
SHARE = 14  # the worst deviation is drawn as this part of the smaller side of a section
LEAST, GREATEST = 1.0, 1000.0
BAND, DASHES = "#8c8778", (0, (2, 2))  # the tolerance on either side


class Magnified(NamedTuple):
    """`section` of the part; its target, what is gone and what is left as regions; the factor.

    Where the part is (k, 2), where it should be, by how much it is off (k,), 0 where that is too much to be magnified;
    `joined` (k - 1,) neighbours on one line; the `true` values (k,).
    """

    section: Section
    target: Region
    gone: Region
    left: Region
    factor: float
    there: Array
    foot: Array
    off: Array
    joined: Array
    tolerance: float
    true: Array


def sections_of(difference: Difference, planes: str | Sequence[str], at: float | Sequence[float] | None) -> list[Magnified]:
    """The sections that are asked for; without a place they go where most is off: through a worst place or the middle."""
    if not planes:
        return []
    if difference.workpiece.cutting.lathe:
        raise Alarm("the picture of a turned part is its section through the axis; it has no other")
    if at is not None:
        return [magnified(difference, each) for each in sections_of_part(difference.workpiece, planes, at)]
    found = []
    for middle in sections_of_part(difference.workpiece, planes, None):
        axis = ACROSS[middle.plane]
        places = [each.place[axis] for each in (difference.worst_gouge, difference.worst_rest) if each.place is not None]
        cuts = [sections_of_part(difference.workpiece, middle.plane, place)[0] for place in places]
        told = [magnified(difference, each._replace(letter=middle.letter)) for each in (middle, *cuts)]
        found.append(max(told, key=lambda each: float(np.abs(each.true).max(initial=0.0))))
    return found


def magnified(difference: Difference, section: Section) -> Magnified:
    """A section with what it should be."""
    target = Region(tuple(difference.compared.cut(section.plane, section.at)))
    view, bounds = section.view, difference.workpiece.cutting.stock.bounds
    span = (bounds[1] - bounds[0])[[view.right, view.up]]
    there, joined = [np.zeros((0, 2))], [np.zeros(0, dtype=bool)]
    for loop in section.contours:
        corners = np.append(np.cumsum(loop.lengths) - loop.lengths, loop.length)
        way = np.unique(np.concatenate([corners, np.arange(0, loop.length, float(span.max()) / PLACES)]))
        there.append(loop.point_at(np.minimum(way, np.nextafter(loop.length, 0)))[0])
        joined.append(np.append(np.ones(len(way) - 1, dtype=bool), False))
    spots = np.concatenate(there)
    if target.loops and len(spots):
        feet = np.stack([loop.nearest_points(spots) for loop in target.loops])
        nearest = np.hypot(*(feet - spots).transpose(2, 0, 1)).argmin(axis=0)
        foot = feet[nearest, np.arange(len(spots))]
        off = np.where(target.contains(spots), -1.0, 1.0) * np.hypot(*(spots - foot).T)
    else:
        foot, off = spots, np.zeros(len(spots))
    off[np.abs(off) <= max(difference.error, 1e-6)] = 0.0
    whole = Region(tuple(section.contours))
    gone, left = (a.difference(b) if a.loops and off.any() else Region(()) for a, b in ((target, whole), (whole, target)))
    worst = float(np.clip(np.abs(off).max(initial=0.0), difference.tolerance, FULL * difference.tolerance))
    factor = float(np.clip(nice(float(span.min()) / SHARE / worst, up=False), LEAST, GREATEST))
    joined_, most = np.concatenate(joined)[:-1], FULL * difference.tolerance
    small = np.where(np.abs(off) > most, 0.0, off)
    return Magnified(section, target, gone, left, factor, spots, foot, small, joined_, difference.tolerance, off)


def nice(value: float, up: bool = True) -> float:
    """The next number 1, 2 or 5 times a power of ten that is not less, or not greater."""
    power = 10.0 ** math.floor(math.log10(value))
    known = [step * power for step in (1.0, 2.0, 5.0, 10.0)]
    if up:
        return min(each for each in known if each >= value * (1 - 1e-9))
    return max(each for each in known if each <= value * (1 + 1e-9))


def draw_magnified(ax: Axes, cut: Magnified, shades: tuple[str, str]) -> None:
    """The target hatched, the part as a line that is off by the factor, what lies between in the colour of its kind."""
    draw_target(ax, cut.target.loops, cut.gone, cut.left, shades)
    drawn = cut.foot + cut.factor * (cut.there - cut.foot)
    quads = np.stack([cut.foot[:-1], cut.foot[1:], drawn[1:], drawn[:-1]], axis=1)
    lines = np.stack([drawn[:-1], drawn[1:]], axis=1)
    joined = cut.joined & (np.hypot(*np.diff(cut.foot, axis=0).T) < 5 * np.hypot(*np.diff(cut.there, axis=0).T) + 1e-9)
    mean = (cut.off[:-1] + cut.off[1:]) / 2
    for sign, shade in zip((-1, 1), shades):
        some = joined & (np.sign(mean) == sign)
        ax.add_collection(PolyCollection(list(quads[some]), facecolors=shade + "66", edgecolors="none", zorder=2.0))
    draw_surface(ax, lines, joined, mean, shades)
    for loop in cut.target.loops:
        area = Region((loop,)) if loop.area > 0 else Region((loop.reversed(),))
        for side in (-1, 1):
            for each in area.inset(side * cut.factor * cut.tolerance).loops:
                ax.plot(*each.points_within(0.02).T, color=BAND, linewidth=0.5, linestyle=DASHES, zorder=1.9)
    write_factor(ax, f"{cut.section.title}, ", cut.factor)


def draw_target(ax: Axes, loops: Sequence[Contour], gone: Region, left: Region, shades: tuple[str, str]) -> None:
    """A target hatched, with the areas that are gone or left as they are."""
    if loops:
        shape = outline_of(loops)
        ax.add_patch(PathPatch(shape, **FACE, zorder=1.5))
        hatch = PathPatch(shape, **(HATCH | {"edgecolor": "#b9b5a8"}), zorder=1.6)
        hatch.set_hatch_linewidth(0.5)
        ax.add_patch(hatch)
    for region, shade in zip((gone, left), shades):
        if region.loops:
            ax.add_patch(PathPatch(outline_of(region.loops), facecolor=shade + "66", edgecolor=shade, linewidth=0.6, zorder=1.7))


def draw_surface(ax: Axes, lines: Array, some: Array, off: Array, shades: tuple[str, str]) -> None:
    """Some of the lines (k, 2, 2) of a part by the sign of what they are off: full where it is gone, dashed where it is left."""
    for sign, shade, dashes in ((-1, shades[0], "-"), (1, shades[1], (0, (4, 1)))):
        mine = some & (np.sign(off) == sign)
        ax.add_collection(LineCollection(list(lines[mine]), colors=shade, linestyles=dashes, linewidths=1.1, zorder=2.2))


def write_factor(ax: Axes, title: str, factor: float) -> None:
    """By how much deviations are magnified, at the upper edge."""
    ax.annotate(
        f"{title}deviation × {number(factor)}", (0.5, 1.0), (0, -2), xycoords="axes fraction", textcoords="offset points",
        ha="center", va="top", fontsize=SMALL + 1, bbox=CARD, zorder=5,
    )  # fmt: skip
