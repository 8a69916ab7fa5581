"""A sheet of A4 that texts, rules, tables and whole pictures are put on. Places are in points from the upper left corner."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.ft2font import FT2Font, LoadFlags
from matplotlib.patches import Rectangle

from mnclab.show.plot import colours
from mnclab.show.report.document import TextTable
from mnclab.text.file import printable
from mnclab.text.tables import tail

A4 = (595.2, 841.8)  # points
LEFT, RIGHT, TOP, BOTTOM = 56.0, 48.0, 62.0, 58.0  # margins; the left one is for the holes of a binder
WIDE, TALL = A4[0] - LEFT - RIGHT, A4[1] - TOP - BOTTOM
QUIET = "#5f5f5f"
POINTS = 72
SANS, MONO = "DejaVu Sans", "DejaVu Sans Mono"


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
        said = Printed(x, y, printable(text), size, bold, colour, family)
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


# How wide texts are in print, and how they are folded and cut to a width. Widths in points.

EM = 1000  # points at which glyphs are measured


@cache
def _font(family: str, bold: bool) -> FT2Font:
    font: FT2Font = get_font(findfont(FontProperties(family=family, weight="bold" if bold else "normal")))
    return font


@cache
def _advance(letter: str, family: str, bold: bool) -> float:
    """How far one letter goes on, in ems."""
    font = _font(family, bold)
    font.set_size(EM, 72)
    return float(font.load_char(ord(letter), flags=LoadFlags.NO_HINTING).linearHoriAdvance) / 65536 / EM


def width(text: str, size: float, bold: bool = False, family: str = SANS) -> float:
    """How wide a line is."""
    return size * sum(_advance(letter, family, bold) for letter in text)


def fitted(text: str, room: float, size: float, bold: bool = False, family: str = SANS) -> str:
    """A text, cut off with an ellipsis where it is too wide."""
    if width(text, size, bold, family) <= room:
        return text
    kept, used = [], width("…", size, bold, family)
    for letter in text:
        used += width(letter, size, bold, family)
        if used > room:
            break
        kept.append(letter)
    return "".join(kept).rstrip() + "…"


def folded(text: str, room: float, size: float, bold: bool = False) -> list[str]:
    """A text as lines of at most `room`, folded between words, and within a word that is wider than a line."""
    return [line for part in text.split("\n") for line in (*_folded(part, room, size, bold),)] or [""]


def _folded(text: str, room: float, size: float, bold: bool) -> Iterator[str]:
    line, used, space = "", 0.0, width(" ", size, bold)
    for word in text.split(" "):
        more = width(word, size, bold)
        if line and used + space + more > room:
            yield line
            line, used = "", 0.0
        while more > room and len(word) > 1:
            count = len(fitted(word, room, size, bold)) - 1 or 1
            yield (line + " " if line else "") + word[:count]
            line, used, word = "", 0.0, word[count:]
            more = width(word, size, bold)
        line, used = (f"{line} {word}", used + space + more) if line else (word, more)
    yield line


# Tables in print: a rule above and below and one under the heads, numbers under each other by their points.

SIZES = (8.5, 8.0, 7.5, 7.0, 6.5, 6.0)  # points, the first that has room
GAP, NARROW_GAP, MANY = 13.0, 8.0, 8  # between columns, and between those of a table of more
LINE, AIR = 1.32, 3.0  # lines apart, in ems; above and below the rules
NARROW = 46.0  # a column of words is folded to this width at least


class PrintedRow(NamedTuple):
    """One row as it is printed: its cells as lines (text, x of its left end), and how tall it is."""

    cells: list[list[tuple[str, float]]]
    tall: float
    bold: bool


class Setting(NamedTuple):
    """A table that has its places: `head` None without one."""

    head: PrintedRow | None
    rows: list[PrintedRow]
    size: float
    wide: float


def tabled(table: TextTable, room: float) -> Setting:
    """The places of the cells of a table within `room` points: the largest letters that need no folding, else folded words."""
    texts = [list(row) for row in (*([table.head] if any(table.head) else []), *table.rows)]
    count = max(map(len, texts))
    texts = [row + [""] * (count - len(row)) for row in texts]
    heads = 1 if any(table.head) else 0
    bold = {0} if heads else set[int]()
    bold |= {heads + k for k in table.bold}
    gap = GAP if count <= MANY else NARROW_GAP
    for size in SIZES:
        widths = _widths(texts, size, bold)
        if sum(widths) + gap * (count - 1) <= room:
            break
    widths = _folded_widths(widths, room - gap * (count - 1), set(table.numbers))
    longest = {k: max((width(tail(row[k]) or "", size) for row in texts[heads:]), default=0.0) for k in table.numbers}
    left = [sum(widths[:k]) + gap * k for k in range(count)]
    lines = []
    for number, row in enumerate(texts):
        thick, cells = number in bold, []
        for k, text in enumerate(row):
            parts = folded(text, widths[k] + 0.1, size, thick)
            end = tail(text) if number >= heads else None
            shift = longest[k] - width(end, size) if k in longest and end is not None else 0.0
            right = k in longest
            cells.append([(part, left[k] + (widths[k] - shift - width(part, size, thick) if right else 0)) for part in parts])
        lines.append(PrintedRow(cells, size * LINE * max(map(len, cells)) + AIR, thick))
    return Setting(lines[0] if heads else None, lines[heads:], size, sum(widths) + gap * (count - 1))


def _widths(texts: Sequence[Sequence[str]], size: float, bold: set[int]) -> list[float]:
    """How wide each column is, a number with room for the decimals that others have."""
    found = []
    for k in range(len(texts[0])):
        plain = [(row[k], n in bold) for n, row in enumerate(texts)]
        most = max(width(line, size, thick) for text, thick in plain for line in text.split("\n"))
        ends = [(width(text, size, thick), width(tail(text) or "", size)) for text, thick in plain if tail(text) is not None]
        if ends:  # the longest before the point and the longest behind it need not be of one number
            most = max(most, max(all_ - end for all_, end in ends) + max(end for _, end in ends))
        found.append(most)
    return found


def _folded_widths(widths: list[float], room: float, numbers: set[int]) -> list[float]:
    """Widths that have room together: the widest columns of words become narrower, down to one width."""
    widths = widths.copy()
    words = [k for k in range(len(widths)) if k not in numbers] or [*range(len(widths))]
    while (over := sum(widths) - room) > 0.01:
        wide = max(widths[k] for k in words)
        most = [k for k in words if widths[k] > wide - 0.01]
        next_ = max((widths[k] for k in words if widths[k] <= wide - 0.01), default=NARROW)
        less = min(over / len(most), wide - max(next_, NARROW))
        if less <= 0:
            break
        for k in most:
            widths[k] -= less
    return widths
