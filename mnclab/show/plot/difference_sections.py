"""Sections through a part and its target: the target hatched, the part beside it with the deviation magnified."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import PathPatch

from mnclab.geometry.regions import Region
from mnclab.path.columns import Array
from mnclab.show.plot.classes import number
from mnclab.show.plot.picture import SMALL
from mnclab.show.plot.sections import ACROSS, CARD, FACE, HATCH, Section, outline_of
from mnclab.show.plot.sections import sections_of as sections_of_part
from mnclab.text.alarm import Alarm
from mnclab.workpiece.difference.difference import Difference

PLACES = 1200  # along the longer side
SHARE = 14  # the worst deviation is drawn as this part of the smaller side of a section
LEAST, GREATEST = 1.0, 1000.0


class Magnified(NamedTuple):
    """`section` of the part, its target as a region, the factor; where the part is (k, 2), where it should be, and by how
    much it is off (k,); `joined` (k - 1,) neighbours on one line."""

    section: Section
    target: Region
    factor: float
    there: Array
    foot: Array
    off: Array
    joined: Array
    tolerance: float
    error: float


def sections_of(difference: Difference, planes: str | Sequence[str], at: float | Sequence[float] | None) -> list[Magnified]:
    """The sections that are asked for; without a place they go through the worst one."""
    if not planes:
        return []
    if difference.workpiece.cutting.lathe:
        raise Alarm("the picture of a turned part is its section through the axis; it has no other")
    several = [planes] if isinstance(planes, str) else planes
    worst = max(difference.worst_gouge, difference.worst_rest, key=lambda each: each.value).place
    if at is None and worst is not None and isinstance(several, Sequence):
        at = [worst[ACROSS[plane]] for plane in several if plane in ACROSS]
        at = at if len(at) == len(several) else None  # what is no plane is refused by name
    return [magnified(difference, each) for each in sections_of_part(difference.workpiece, planes, at)]


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
    worst = max(float(np.abs(off).max(initial=0.0)), difference.tolerance)
    factor = float(np.clip(_nice(float(span.min()) / SHARE / worst), LEAST, GREATEST))
    return Magnified(section, target, factor, spots, foot, off, np.concatenate(joined)[:-1], difference.tolerance, difference.error)


def _nice(value: float) -> float:
    """The number 1, 2 or 5 times a power of ten that is not greater."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(step * power for step in (1, 2, 5) if step * power <= value * (1 + 1e-9)))


def draw_magnified(ax: Axes, cut: Magnified, shades: tuple[str, str]) -> None:
    """The target hatched, the part as a line that is off by the factor, what lies between in the colour of its kind."""
    if cut.target.loops:
        shape = outline_of(cut.target.loops)
        ax.add_patch(PathPatch(shape, **FACE, zorder=1.5))
        hatch = PathPatch(shape, **(HATCH | {"edgecolor": "#b9b5a8"}), zorder=1.6)
        hatch.set_hatch_linewidth(0.5)
        ax.add_patch(hatch)
    drawn = cut.foot + cut.factor * (cut.there - cut.foot)
    quads = np.stack([cut.foot[:-1], cut.foot[1:], drawn[1:], drawn[:-1]], axis=1)
    lines = np.stack([drawn[:-1], drawn[1:]], axis=1)
    joined = cut.joined & (np.hypot(*np.diff(cut.foot, axis=0).T) < 5 * np.hypot(*np.diff(cut.there, axis=0).T) + 1e-9)
    mean = (cut.off[:-1] + cut.off[1:]) / 2
    for sign, shade, dashes in ((-1, shades[0], "-"), (1, shades[1], (0, (4, 1)))):
        some = joined & (np.sign(mean) == sign)
        ax.add_collection(PolyCollection(list(quads[some]), facecolors=shade + "66", edgecolors="none", zorder=2.0))
        ax.add_collection(LineCollection(list(lines[some]), colors=shade, linestyles=dashes, linewidths=1.1, zorder=2.2))
    for loop in cut.target.loops:
        points = loop.points_within(0.02)
        for side in (-1, 1):
            band = Region((loop,)) if loop.area > 0 else Region((loop.reversed(),))
            grown = band.inset(side * cut.factor * cut.tolerance)
            for each in grown.loops:
                points = each.points_within(0.02)
                ax.plot(*points.T, color="#8c8778", linewidth=0.5, linestyle=(0, (2, 2)), zorder=1.9)
    ax.annotate(
        f"{cut.section.title}, deviation × {number(cut.factor)}", (0.5, 1.0), (0, -2), xycoords="axes fraction",
        textcoords="offset points", ha="center", va="top", fontsize=SMALL + 1, bbox=CARD, zorder=5,
    )  # fmt: skip
