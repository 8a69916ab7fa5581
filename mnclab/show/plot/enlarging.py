"""A finished figure made larger or smaller with all that is counted in points, or set into a larger or smaller frame."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axis import Axis
from matplotlib.collections import Collection, PathCollection
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrowPatch, Patch, Rectangle
from matplotlib.text import Annotation, Text

LOOKS = "borderpad labelspacing handlelength handleheight handletextpad borderaxespad columnspacing".split()
PAD = 4.0  # points between axes and their titles, as they are written everywhere


def enlarge(figure: Figure, factor: float) -> None:
    """Multiply the size of a figure, of its letters, lines and marks; what it shows stays the same."""
    if factor == 1:
        return
    legends = [each for each in figure.findobj(Legend) if isinstance(each, Legend)]
    inside = {id(artist) for legend in legends for artist in legend.findobj()}
    for artist in _artists(figure):
        if id(artist) not in inside:
            _enlarge(artist, factor)
    for ax in figure.axes:
        _enlarge_axes(ax, factor)
    for legend in legends:
        _again(figure, legend, factor)
    figure.set_size_inches(*(figure.get_size_inches() * factor))


def reframe(figure: Figure, left: float, bottom: float, width: float, height: float) -> None:
    """Give a figure another frame, inches, whose lower left corner lies at `left`, `bottom` of the old one."""
    old = figure.get_size_inches()

    def place(x: float, y: float) -> tuple[float, float]:
        return (x * old[0] - left) / width, (y * old[1] - bottom) / height

    boxes = [ax.get_position(original=True) for ax in figure.axes]  # before: axes over each other move together
    for ax, box in zip(figure.axes, boxes):
        ax.set_position((*place(box.x0, box.y0), box.width * old[0] / width, box.height * old[1] / height))
    for text in figure.texts:
        text.set_position(place(*text.get_position()))
    for patch in (*figure.patches, *figure.artists):
        if isinstance(patch, Rectangle) and patch is not figure.patch:
            corner = place(*patch.get_xy())
            patch.set_bounds(*corner, patch.get_width() * old[0] / width, patch.get_height() * old[1] / height)
    for legend in figure.legends:
        at = figure.transFigure.inverted().transform(legend.get_bbox_to_anchor().p0)
        legend.set_bbox_to_anchor(place(*at), transform=figure.transFigure)
    figure.set_size_inches(width, height)


def _artists(artist: Artist) -> Iterator[Artist]:
    """All artists of a figure but the axis with its ticks, and legends."""
    for child in artist.get_children():
        if not isinstance(child, Axis | Legend):
            yield child
            yield from _artists(child)


def _enlarge(artist: Any, factor: float) -> None:
    if isinstance(artist, Text):
        artist.set_fontsize(float(artist.get_fontsize()) * factor)
        if isinstance(artist, Annotation) and "points" in str(artist.anncoords):
            x, y = artist.xyann
            artist.xyann = (x * factor, y * factor)
    elif isinstance(artist, Line2D):
        artist.set_linewidth(artist.get_linewidth() * factor)
        artist.set_markersize(artist.get_markersize() * factor)
        artist.set_markeredgewidth(artist.get_markeredgewidth() * factor)
    elif isinstance(artist, Collection):
        artist.set_linewidth([each * factor for each in np.atleast_1d(artist.get_linewidth()).tolist()])
        if isinstance(artist, PathCollection):
            artist.set_sizes(artist.get_sizes() * factor**2)
    elif isinstance(artist, Patch):
        artist.set_linewidth(artist.get_linewidth() * factor)
        if isinstance(artist, FancyArrowPatch):
            artist.set_mutation_scale(artist.get_mutation_scale() * factor)
            artist.shrinkA, artist.shrinkB = artist.shrinkA * factor, artist.shrinkB * factor


def _enlarge_axes(ax: Any, factor: float) -> None:
    """Ticks with their numbers, labels and titles."""
    for axis in (ax.xaxis, ax.yaxis):
        one = axis.get_major_ticks(1)[0]
        line = one.tick1line
        axis.set_tick_params(
            labelsize=one.label1.get_fontsize() * factor, length=line.get_markersize() * factor, pad=one.get_pad() * factor,
            width=line.get_markeredgewidth() * factor, grid_linewidth=one.gridline.get_linewidth() * factor,
        )  # fmt: skip
        axis.label.set_fontsize(axis.label.get_fontsize() * factor)
        axis.labelpad *= factor
        axis.offsetText.set_fontsize(axis.offsetText.get_fontsize() * factor)
    for where, title in (("left", ax._left_title), ("center", ax.title), ("right", ax._right_title)):
        if said := title.get_text():
            ax.set_title(said, loc=where, pad=PAD * factor, fontsize=title.get_fontsize())


def _again(figure: Figure, legend: Any, factor: float) -> None:
    """The same legend with larger letters and samples."""
    handles, words = legend.legend_handles, [text.get_text() for text in legend.get_texts()]
    for handle in handles:
        if handle is not None:
            _enlarge(handle, factor)
    look = {name: getattr(legend, name) for name in LOOKS}
    at = figure.transFigure.inverted().transform(legend.get_bbox_to_anchor().p0)
    size = legend.get_texts()[0].get_fontsize() if words else 8.0
    whole = legend.axes is None
    legend.remove()
    owner = figure if whole else legend.axes
    look |= {"loc": legend._loc, "ncols": legend._ncols, "frameon": legend.get_frame_on(), "fontsize": size * factor}
    look |= {"bbox_to_anchor": tuple(at)} if whole else {}
    new = owner.legend(handles, words, **look)
    new.set_zorder(legend.get_zorder())
