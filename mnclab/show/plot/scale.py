"""A small scale of colours above the views: steps between round numbers, named with their unit."""

from __future__ import annotations

from matplotlib.patches import Rectangle

from mnclab.show.plot import colours
from mnclab.show.plot.classes import Scale, number
from mnclab.show.plot.picture import SMALL, Picture

LONGEST, THICK, TOP, LEFT = 3.6, 0.1, 0.07, 0.12  # inches
LETTER = 0.075  # inches, wider than any at this size


def write_scale(picture: Picture, scale: Scale) -> None:
    """Draw the steps in one row at the top of a picture and a number at as many limits as have room.

    Where a step is a single number, that stands below its middle.
    """
    width, height = float(picture.get_figwidth()), float(picture.get_figheight())
    middle = 1 - (TOP + THICK / 2) / height
    title = picture.text(LEFT / width, middle, scale.title, fontsize=SMALL, va="center", parse_math=False)
    names = [number(limit) for limit in scale.limits[: -1 if scale.single else None]]
    room = LETTER * max(map(len, names))
    begin = LEFT + title.get_window_extent().width / picture.dpi + max(0.15, room / 2)
    step = min(LONGEST, width - begin - max(0.1, room / 2)) / len(scale.colours)
    for k, shade in enumerate(scale.colours):
        corner = ((begin + k * step) / width, middle - THICK / 2 / height)
        box = Rectangle(corner, step / width, THICK / height, facecolor=shade, edgecolor=colours.PAPER, linewidth=0.6)
        box.set_transform(picture.transFigure)
        picture.add_artist(box)
    every = next(n for n in range(1, len(names) + 1) if n * step > room + 0.06 or n == len(names))
    for k in range(0, len(names), every):
        at = (begin + (k + scale.single / 2) * step) / width, middle - (THICK / 2 + 0.02) / height
        picture.text(*at, names[k], fontsize=SMALL, ha="center", va="top", parse_math=False)
