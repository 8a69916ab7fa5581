"""A sheet of A4 that texts, rules and whole pictures are put on. Places are in points from the upper left corner."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.patches import Rectangle

from mnclab.show.given_away import whole
from mnclab.show.plot import colours
from mnclab.show.plot.pages.letters import SANS, width

A4 = (595.2, 841.8)  # points
LEFT, RIGHT, TOP, BOTTOM = 56.0, 48.0, 62.0, 58.0  # margins; the left one is for the holes of a binder
WIDE, TALL = A4[0] - LEFT - RIGHT, A4[1] - TOP - BOTTOM
QUIET = "#5f5f5f"
POINTS = 72


class Printed(NamedTuple):
    """A line of text: its left end and its base line."""

    x: float
    y: float
    text: str
    size: float
    bold: bool = False
    colour: str = colours.INK
    family: str = SANS

    @property
    def wide(self) -> float:
        return width(self.text, self.size, self.bold, self.family)


class Sheet(Figure):
    """One page; `texts_on_it` are its lines of text, in the order they were put there."""

    def __init__(self, size: tuple[float, float] = A4) -> None:
        super().__init__(figsize=(size[0] / POINTS, size[1] / POINTS), facecolor=colours.PAPER)
        FigureCanvasAgg(self)
        self.size = size
        self.texts_on_it: list[Printed] = []
        self.pictures_on_it: list[tuple[Figure, float, float]] = []
        self.add_artist(_Ink(self))

    def write(
        self, x: float, y: float, text: str, size: float, *, bold: bool = False, colour: str = colours.INK,
        family: str = SANS, side: str = "left",
    ) -> None:  # fmt: skip
        """A line of text whose base line is `y` points below the upper edge."""
        said = Printed(x, y, whole(text), size, bold, colour, family)
        self.texts_on_it.append(said if side == "left" else said._replace(x=x - said.wide))

    def band(self, x: float, y: float, wide: float, tall: float, colour: str) -> None:
        """A filled rectangle below the text: a rule, where it is thin."""
        scale = self.dpi_scale_trans
        corner = x / POINTS, (self.size[1] - y - tall) / POINTS
        self.add_artist(Rectangle(corner, wide / POINTS, tall / POINTS, facecolor=colour, linewidth=0, transform=scale, zorder=0))

    def rule(self, x: float, y: float, wide: float, thick: float = 0.5, colour: str = "#8c8c8c") -> None:
        self.band(x, y - thick / 2, wide, thick, colour)

    def put(self, picture: Figure, x: float, y: float) -> None:
        """A whole picture, in its size, its upper left corner there."""
        self.pictures_on_it.append((picture, x, y))
        self.add_artist(_Inset(picture, x, self.size[1] - y - POINTS * picture.get_figheight()))


class _Ink(Artist):
    """The texts of a sheet, drawn line by line as they are: nothing is to be laid out any more."""

    def __init__(self, sheet: Sheet) -> None:
        super().__init__()
        self.sheet = sheet
        self.set_zorder(5)
        self.fonts: dict[tuple[str, float, bool], FontProperties] = {}

    def draw(self, renderer: Any) -> None:
        scale, high = renderer.points_to_pixels(1.0), self.sheet.size[1]
        gc = renderer.new_gc()
        for x, y, text, size, bold, colour, family in self.sheet.texts_on_it:
            if not text.strip():
                continue
            key = family, size, bold
            if key not in self.fonts:
                self.fonts[key] = FontProperties(family=family, size=size, weight="bold" if bold else "normal")
            gc.set_foreground(colour)
            up = scale * (y if renderer.flipy() else high - y)
            renderer.draw_text(gc, scale * x, up, text, self.fonts[key], 0)
        gc.restore()


class _Inset(Artist):
    """A whole figure on another: while it is drawn, its page begins at another corner."""

    def __init__(self, picture: Figure, x: float, y: float) -> None:
        super().__init__()
        self.picture, self.place = picture, (x / POINTS, y / POINTS)

    def draw(self, renderer: Any) -> None:
        picture, page, (x, y) = self.picture, self.get_figure(root=True), self.place
        assert page is not None
        wide, tall = picture.get_size_inches().tolist()
        before = picture.dpi
        picture.dpi = page.dpi
        picture.bbox_inches.set_points(np.array([(x, y), (x + wide, y + tall)]))
        try:
            picture.draw(renderer)
        finally:
            picture.bbox_inches.set_points(np.array([(0, 0), (wide, tall)]))
            picture.dpi = before
