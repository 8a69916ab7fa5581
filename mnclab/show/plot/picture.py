"""A figure that shows itself in Jupyter, and how views of equal scale stand in it.

A matplotlib `Figure` made without pyplot is not shown by Jupyter (its formatter is registered when pyplot is
imported; tried in JupyterLab 4.6), so `Picture` says itself how it is shown. Sizes are inches, as in matplotlib.
"""

from __future__ import annotations

import base64
import math
import re
from collections.abc import Callable, Collection, Sequence
from contextvars import ContextVar
from functools import partial
from html import escape
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple, cast

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path
from matplotlib.ticker import FuncFormatter, MaxNLocator

from mnclab.path.listing import MM, Unit
from mnclab.show import looks
from mnclab.show.plot import clickable, colours
from mnclab.show.plot.strokes import Array
from mnclab.text.alarm import Alarm
from mnclab.text.file import replaced
from mnclab.text.given import shown

SIZE = (7.0, 6.0)  # the greatest width and height, unless something else is said
LEAST = (4.6, 2.4)
SMALL = 8.0  # points: ticks, legend, alarm
CARD = {"facecolor": colours.PAPER, "edgecolor": "none", "pad": 1.5}  # curves run behind words
SHARE = 0.2  # of a picture that its legend takes at most
LEGEND: ContextVar[bool] = ContextVar("LEGEND", default=True)  # else the views have its room
SUFFIXES = (".svg", ".pdf", ".png")
SPARE = ("part", "blank", "tool change", "from home", "plunge")  # what a legend that is too long leaves out first
GAP, BELOW, RIGHT, ROW, NEXT_ROW, LINE, SCALE, NARROW = 0.14, 0.52, 0.18, 0.22, 0.17, 0.15, 0.34, 1.4


class View(NamedTuple):
    """Which coordinates (0 X, 1 Y, 2 Z) go to the right and up; `diameter` shows the upward one doubled, `head` inches are
    kept free above for a title; numbers at the axes count in `unit`; `names` are the axes of the three coordinates."""

    right: int
    up: int
    diameter: bool = False
    head: float = 0.0
    unit: Unit = MM
    names: str = "XYZ"

    @property
    def labels(self) -> tuple[str, str]:
        unit = self.unit.short
        return f"{self.names[self.right]}, {unit}", f"{self.names[self.up]}{' (diameter)' if self.diameter else ''}, {unit}"

    def fits(self, height: float) -> str:
        """The label of the upward axis, shorter where `height` inches have no room for it."""
        return self.labels[1] if height > 0.08 * len(self.labels[1]) else self.labels[1].replace("(diameter)", "⌀")


class Foot(NamedTuple):
    """Text below the views, line by line."""

    text: str
    colour: str = colours.INK

    @classmethod
    def of(cls, alarm: Alarm) -> Foot:
        """The alarm that stopped a program."""
        return cls(f"line {alarm.span.line}: {alarm.message}" if alarm.span else alarm.message, colours.ALARM.colour)

    @property
    def lines(self) -> list[str]:
        return self.text.split("\n")

    def within(self, width: float) -> Foot:
        """The same with its lines broken where a picture of so many inches ends."""
        return self._replace(text="\n".join(line for sentence in self.lines for line in broken(sentence, width - 0.25)))

    def write(self, picture: Picture, left: float = 0.1, bottom: float = 0.07) -> None:
        """Write the lines, which are `within` the picture, from `left` and up from `bottom` inches."""
        width, height = picture.get_size_inches().tolist()
        for above, sentence in enumerate(reversed(self.lines)):
            place = left / width, (bottom + LINE * above) / height
            picture.text(*place, sentence, fontsize=SMALL, color=self.colour, va="bottom", parse_math=False)


APART = re.compile(r"(?<!\d) | (?!(?:mm|in|µm|s|rev)(?:[²³/;,.]|\s|$))")  # no number goes without its unit


def broken(text: str, room: float, size: float = SMALL) -> list[str]:
    """The lines of a text, broken between words so that they fit into so many inches; a word that does not is broken too."""

    def fits(line: str) -> bool:  # in pixels letters are a little wider than on paper
        wide, _, _ = text_to_path.get_text_width_height_descent(line, FontProperties(size=size), ismath=False)
        return 1.05 / 72 * float(wide) <= room

    lines = [""]
    for word in APART.split(text):
        if not lines[-1] or fits(f"{lines[-1]} {word}"):
            lines[-1] = f"{lines[-1]} {word}" if lines[-1] else word
        else:
            lines.append(word)
        while not fits(lines[-1]) and len(lines[-1]) > 1:
            last = next((k for k in range(len(lines[-1]) - 1, 1, -1) if fits(lines[-1][:k])), 1)
            lines[-1:] = [lines[-1][:last], lines[-1][last:]]
    return lines


VIEWS = {"XY": View(0, 1), "XZ": View(0, 2), "YZ": View(1, 2), "ZX": View(2, 0, diameter=True)}


class Picture(Figure):
    """A figure with a description in words (`alt`), shown by Jupyter as a picture that has this name."""

    def __init__(self, size: tuple[float, float] = SIZE, alt: str = "picture") -> None:
        super().__init__(figsize=size, facecolor=colours.PAPER)
        FigureCanvasAgg(self)
        self.alt = alt
        self.seen: clickable.Seen = ()  # what can be clicked on, and what is said of it
        self.told: clickable.Told | None = None
        self.again: Callable[..., Figure] | None = None  # what draws it with other options
        self.box: Any = None  # what a picture that follows it keeps of this one, see `show.plot.layers`

    def save(self, path: str | Path, **options: Any) -> Path:
        """Write the picture: .svg, .pdf or .png; with options, such as `size="column"`, it is drawn anew."""
        if not isinstance(path, str | Path) or Path(path).suffix.lower() not in SUFFIXES:
            raise Alarm(f"a picture is saved as {', '.join(SUFFIXES)}, got {shown(path)}", hint='.save("figure.pdf")')
        if options and self.again is None:
            raise Alarm(f"this figure has no option {next(iter(options))}", hint="options go to the .plot that draws it")
        with replaced(Path(path)) as beside:
            write(self.again(**options) if options and self.again else self, beside)
        return Path(path)

    def png(self, scale: float = 1.0) -> bytes:
        """The picture as PNG; at `scale` 1 an inch has 100 pixels."""
        data = BytesIO()
        self.savefig(data, format="png", dpi=100 * scale, pil_kwargs={"compress_level": 4})  # by 6 it takes a quarter longer
        return data.getvalue()

    def html(self, scale: float = 1.0) -> str:
        return self._image(base64.b64encode(self.png(scale)).decode())

    def _image(self, data: str) -> str:
        width = f"width:{round(100 * self.get_figwidth())}px;max-width:100%"
        moves = clickable.over(self, self.seen, self.told) if self.seen else ""
        block = f"display:block;{width}" if moves else width  # an inline one has room below it, and strokes would not fit
        image = f'<img alt="{escape(self.alt)}" style="{block}" src="data:image/png;base64,{data}">'
        return f'<div style="position:relative;{width}">{image}{moves}</div>' if moves else image

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, Any]:
        data = base64.b64encode(self.png(2.0)).decode()
        return {"text/html": self._image(data), "image/png": data, "text/plain": repr(self)}

    def __repr__(self) -> str:
        return f"<Picture: {self.alt}>"


def write(figure: Figure, path: Path) -> None:
    """Save a figure; the same figure gives the same bytes, and text in an SVG stays text."""
    steady: Any = {"svg.hashsalt": "mnclab", "svg.fonttype": "none"}
    undated = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}.get(path.suffix.lower())
    data = BytesIO()  # a full disk in the middle of a pdf would be more than an OSError
    with mpl.rc_context(steady):
        figure.savefig(data, format=path.suffix[1:].lower(), dpi=200, metadata=undated)
    path.write_bytes(data.getvalue())


# A table of texts in a figure, such as a measuring record below its picture.

LETTER, BETWEEN = 0.073, 0.16  # inches: of a letter, and between two columns
LETTER_EM = 0.64  # of the size of letters: the width of a figure


def column_widths(rows: Sequence[Sequence[str]]) -> list[float]:
    """Inches of each column of a table, with the room behind it."""
    return [LETTER * max(map(len, column)) + BETWEEN for column in zip(*rows)]


def write_table(
    picture: Picture, rows: Sequence[Sequence[str]], left: float, bottom: float, numbers: Collection[int], out: Collection[int]
) -> None:
    """Heads and rows of texts from `left` and up from `bottom` inches; `numbers` are columns that stand to the right, the rows
    `out` are bold and red."""
    width, height = picture.get_size_inches().tolist()
    wide = column_widths(rows)
    for line, row in enumerate(rows):
        look: dict[str, Any] = {"weight": "bold" if line in out or not line else "normal", "parse_math": False}
        look["color"] = looks.WRONG if line in out else colours.INK
        y = (bottom + LINE * (len(rows) - 1 - line)) / height
        for k, text in enumerate(row):
            x = left + sum(wide[: k + (k in numbers)]) - BETWEEN * (k in numbers)
            picture.text(x / width, y, text, fontsize=SMALL, ha="right" if k in numbers else "left", va="bottom", **look)


# --- layout ----------------------------------------------------------------------------------------------------------


def arrange(
    views: Sequence[View], low: Array, high: Array, names: Sequence[str], foot: Foot | None, alt: str,
    size: tuple[float, float], scale_above: bool = False,
) -> tuple[Picture, list[Axes]]:  # fmt: skip
    """A picture of at most `size` with one axes a view, all at one scale, around the box `low` to `high` (3,) mm.

    The views stand above one another, side by side or in columns, whichever is largest. `names` get room for a legend above,
    and `scale_above` keeps room for a scale of colours above that; `foot` is text below.
    """
    names = names if LEGEND.get() else ()
    low, high = roomy(low, high, views)
    span, digits = high - low, digits_of(low, high, views)
    left = beside_ticks(digits)
    most_wide, most_high = size
    bottom = BELOW + (ROW + LINE * (len(foot.within(most_wide).lines) - 1) if foot else 0)

    def top(width: float) -> float:
        return 0.12 + (SCALE if scale_above else 0.0) + legend_height(len(legend_rows(names, width)))

    free = most_high - bottom - top(most_wide)
    layout, scale = _layout(views, span, most_wide, left + RIGHT, free)
    beside = len(layout) * (left + RIGHT)

    # boxes in inches, from the upper left corner of the views; what a box has beyond its data widens the view
    widths = [scale * max(float(span[views[k].right]) for k in column) for column in layout]
    widths = [max(each, NARROW) for each in widths] if len(layout) > 1 else widths
    width = min(most_wide, max(LEAST[0], beside + sum(widths)))
    widths = [each * (width - beside) / sum(widths) for each in widths]
    row = scale * max(float(span[each.up]) for each in views) if len(layout) == len(views) else 0.0
    boxes: dict[int, tuple[float, float, float, float]] = {}
    for place, column in enumerate(layout):
        ups = [max(scale * float(span[views[k].up]), row) + views[k].head for k in column]
        gaps = _gaps(views, column)
        share = max(1.0, (min(LEAST[1], most_high) - bottom - top(width) - sum(gaps)) / sum(ups))
        begin, under = left * (place + 1) + RIGHT * place + sum(widths[:place]), 0.0
        for k, up, gap in zip(column, ups, (0.0, *gaps)):
            under += gap + up * share
            boxes[k] = begin, under, widths[place], up * share
    if foot:
        foot = foot.within(width)
        bottom = BELOW + ROW + LINE * (len(foot.lines) - 1)
    deep = max(under for _, under, _, _ in boxes.values())
    rest = bottom + 0.12 + (SCALE if scale_above else 0.0) + deep
    rows = min(len(legend_rows(names, width)), rows_within(SHARE / (1 - SHARE) * rest))
    height = rest + legend_height(rows)

    picture = Picture((width, height), alt)
    joined = {k for column in layout for k, gap in zip(column, _gaps(views, column)) if gap == GAP}
    axes = []
    for k, view in enumerate(views):
        x, under, w, h = boxes[k]
        ax = picture.add_axes((x / width, (bottom + deep - under) / height, w / width, h / height))
        dress(ax, view, (w, h), digits)
        x, y = ((low + high) / 2)[[view.right, view.up]] + (0.0, view.head / scale / 2)
        ax.set_xlim(x - w / scale / 2, x + w / scale / 2)
        ax.set_ylim(y - h / scale / 2, y + h / scale / 2)
        if k in joined:
            ax.set_xlabel("")
            ax.tick_params(labelbottom=False)
        axes.append(ax)
    if foot:
        foot.write(picture)
    return picture, axes


def _layout(views: Sequence[View], span: Array, wide: float, beside: float, free: float) -> tuple[list[list[int]], float]:
    """Columns of views, by number, and the scale (inches to a mm) at which they are largest.

    `wide` inches have all columns with `beside` for the labels of each, `free` is the height.
    """
    rights = sorted({view.right for view in views}, key=[view.right for view in views].index)
    layouts = [[[k for k, view in enumerate(views) if view.right == right] for right in rights]]
    layouts += [[list(range(len(views)))[k::count] for k in range(count)] for count in range(1, len(views) + 1)]
    found = []
    for layout in layouts:
        room = wide - len(layout) * beside
        across = [max(float(span[views[k].right]) for k in column) for column in layout]
        scale = room / sum(across)
        for narrow in range(1, len(across)):  # a column is never narrower than the title of a section
            if scale * sorted(across)[narrow - 1] < NARROW:
                scale = (room - narrow * NARROW) / sum(sorted(across)[narrow:])
        down = (
            (free - sum(_gaps(views, each)) - sum(views[k].head for k in each)) / sum(float(span[views[k].up]) for k in each)
            for each in layout
        )
        found.append((min(scale, *down), layout))
    scale, layout = max(found, key=lambda each: each[0])
    return layout, scale


def _gaps(views: Sequence[View], column: Sequence[int]) -> list[float]:
    """Inches between the views of a column: those that share what goes to the right share its numbers."""
    return [GAP if views[a].right == views[b].right else BELOW for a, b in pairwise(column)]


def digits_of(low: Array, high: Array, views: Sequence[View]) -> int:
    """How many characters the longest number at the axes has."""
    low, high = low / views[0].unit.length, high / views[0].unit.length
    return max(len(f"{end[k]:.{_decimals(high[k] - low[k])}f}") for k in _seen(views) for end in (low, high))


def beside_ticks(digits: int) -> float:
    """Inches to the left of an axis whose numbers have so many characters."""
    return 0.42 + 0.068 * digits


def _decimals(span: float) -> int:
    """How many decimals ticks need at most on an axis of this length."""
    return max(0, math.ceil(-math.log10(span / 9)))


def _seen(views: Sequence[View]) -> list[int]:
    """The coordinates that go to the right or up in a view; all three where there is none."""
    return sorted({k for view in views for k in (view.right, view.up)}) or [0, 1, 2]


def roomy(low: Array, high: Array, views: Sequence[View] = ()) -> tuple[Array, Array]:
    """A box with a margin around it, and no side much thinner than the others that are seen."""
    span = np.zeros(3)
    span[_seen(views)] = (high - low)[_seen(views)]
    largest = max(float(span.max()), 1e-3, 1e-6 * float(np.abs([low, high]).max()))
    if span.max() == 0:
        largest = max(largest, 10.0)
    margin = np.maximum(0.06 * largest, (0.22 * largest - span) / 2)
    return low - margin, high + margin


def dress(ax: Axes, view: View, box: Sequence[float] | None = None, digits: int = 4) -> None:
    """Labels, ticks, grid and equal scales of one view; `box` is its size in inches, if it is known."""
    ax.set_aspect("equal", adjustable="datalim")
    for axis, label, doubled, length, room in (
        (ax.xaxis, view.labels[0], False, box and box[0], 0.3 + 0.08 * digits),
        (ax.yaxis, view.fits(box[1]) if box else view.labels[1], view.diameter, box and box[1], 0.32),
    ):
        axis.set_label_text(label, fontsize=SMALL + 1)
        counts = view.unit.length / (2 if doubled else 1)  # mm of the path to 1 at the axis
        axis.set_major_formatter(FuncFormatter(partial(_plain, counts=counts)))
        if length or view.unit is not MM:
            axis.set_major_locator(Round(max(1, min(9, int(length / room))) if length else 9, view.unit.length))
    calm(ax)


def calm(ax: Axes) -> None:
    """Small numbers, a faint grid below everything else, and a grey frame."""
    ax.tick_params(labelsize=SMALL)
    ax.set_axisbelow(True)
    ax.grid(True, color=colours.FAINT, linewidth=0.6)
    ax.spines[:].set_color("#9a9a9a")


class Round(MaxNLocator):
    """At most `most` steps between round numbers of a unit of `length` mm."""

    def __init__(self, most: int, length: float) -> None:
        super().__init__(nbins=most, steps=[1, 2, 5, 10] if most > 1 else [1, 2, 4, 5, 10])  # 40 rather than 20
        self.length = length

    def tick_values(self, vmin: float, vmax: float) -> Any:
        return self.length * np.asarray(super().tick_values(vmin / self.length, vmax / self.length))


class Sparse(MaxNLocator):
    """As many steps to the right as numbers have room, however long they are; none is cut at the border."""

    def __init__(self) -> None:
        super().__init__(nbins=9, steps=[1, 2, 2.5, 5, 10])

    def tick_values(self, vmin: float, vmax: float) -> Any:
        axis: Any = self.axis
        letter = LETTER_EM * float(axis.get_tick_params()["labelsize"]) / 72
        number, room = letter * len(f"{vmax:.0f}"), axis.axes.bbox.width / figure_of(axis.axes).dpi
        self.set_params(nbins=int(np.clip(room / max(5 * letter, number + 2 * letter), 1, 9)))
        ticks = np.asarray(super().tick_values(vmin, vmax))
        cut = max(number / 2 - 2 * letter, 0) / room  # beside the axes there is room for about two letters
        return ticks[(ticks <= vmax - cut * (vmax - vmin)) | (ticks > vmax)]


def _plain(value: float, _: int | None = None, counts: float = 1.0) -> str:
    return f"{round(value / counts, 9) + 0.0:.10g}".replace("-", "\N{MINUS SIGN}")


def figure_of(ax: Axes) -> Figure:
    """The figure that axes of one's own stand in."""
    return cast(Figure, ax.get_figure(root=True))


def stacked(
    picture: Picture, heights: Sequence[float], top: float, *, left: float = 0.85, ticks: int = 5, one_scale: bool = False
) -> list[Axes]:
    """Axes under one another over one axis to the right, of heights in these proportions; `top` and `left` inches are free.

    `ticks` are the steps of an axis upwards at most, which `one_scale` makes the same for all.
    """
    width, height = picture.get_size_inches().tolist()
    grid = picture.add_gridspec(
        len(heights), 1, height_ratios=heights, left=left / width, right=1 - 0.15 / width, bottom=0.5 / height,
        top=1 - top / height, hspace=0.1,
    )  # fmt: skip
    rows: list[Axes] = []
    for k in range(len(heights)):
        first = rows[0] if rows else None
        ax = picture.add_subplot(grid[k, 0], sharex=first, sharey=first if one_scale else None)
        ax.yaxis.set_major_locator(MaxNLocator(nbins=ticks, steps=[1, 2, 5, 10]))
        ax.xaxis.set_major_locator(Sparse())
        ax.tick_params(labelbottom=k + 1 == len(heights))
        calm(ax)
        rows.append(ax)
    return rows


def clear(ax: Axes, high: float, below: float = 0.0) -> float:
    """The upper limit of axes in whose upper corner words stand clear of what reaches up to `high`; the lower limit lies
    `below` 0 by that share of the upper one.
    """
    words = (SMALL + 6) / 72 / (ax.get_position().height * figure_of(ax).get_figheight())
    return high / max(1 - words * (1 + below), 0.4)


def write_cut_off(ax: Axes, said: str) -> None:
    """What is beyond the upper border of axes, in their corner."""
    look: dict[str, Any] = {"fontsize": SMALL - 1, "color": looks.RED, "bbox": CARD, "zorder": 5}
    ax.text(0.995, 0.98, said, transform=ax.transAxes, ha="right", va="top", **look)


def columns(names: Sequence[str], width: float) -> int:
    """How many columns of a legend fit into a width; it is filled column by column."""
    for count in range(len(names), 1, -1):
        rows, taller = divmod(len(names), count)  # the first columns get what is left over
        begin = [k * rows + min(k, taller) for k in range(count + 1)]
        longest = [max(map(len, names[a:b])) for a, b in pairwise(begin)]
        if sum(map(_wide, longest)) < width - 0.1:
            return count
    return 1


def _wide(letters: int) -> float:
    """Inches of an entry of a legend with its sample."""
    return 0.54 + 0.062 * letters


def legend_rows(names: Sequence[str], width: float) -> list[list[int]]:
    """The rows of a legend, by numbers of its entries: in columns where that needs no more rows than one after another."""
    rows: list[list[int]] = []
    free = 0.0
    for k, name in enumerate(names):
        wide = _wide(len(name))
        if wide > free or not rows:
            rows.append([])
            free = width - 0.25
        rows[-1].append(k)
        free -= wide
    lines = math.ceil(len(names) / columns(names, width))
    return [list(range(k, len(names), lines)) for k in range(lines)] if lines <= len(rows) else rows


def legend_height(rows: int) -> float:
    """Inches of so many rows of a legend."""
    return ROW + NEXT_ROW * (rows - 1) if rows else 0.0


def rows_within(height: float) -> int:
    """How many rows of a legend so many inches hold; one at least."""
    return 1 + max(0, int((height - ROW) / NEXT_ROW + 1e-6))


def _shortened(names: Sequence[str], width: float, most: int) -> list[int]:
    """The entries that a legend of at most so many rows holds: what explains itself goes first, last that a curve is thinned."""
    kept, rank = list(range(len(names))), {name: k for k, name in enumerate(SPARE)}
    spare = sorted(kept, key=lambda k: (names[k].startswith("thinned"), rank.get(names[k], len(SPARE)), -k))
    while len(legend_rows([names[k] for k in kept], width)) > most and len(kept) > 1:
        kept.remove(spare.pop(0))
    return kept


def write_legend(picture: Picture, artists: Sequence[Any], below: float = 0.0, sample: float = 2.6) -> None:
    """The names of lines and marks in the room above the views, `below` inches from the top; `sample` letters of each.

    It takes a fifth of the picture at most, but one row at least; what it has no room for is told in words.
    """
    width, height = picture.get_size_inches().tolist()
    names = [str(artist.get_label()) for artist in artists]
    kept = _shortened(names, width, rows_within(SHARE * height))
    if left := [name for k, name in enumerate(names) if k not in kept]:
        picture.alt += f"; not in the legend: {', '.join(left)}"
    shown = [names[k] for k in kept]
    rows, across = legend_rows(shown, width), columns(shown, width)
    pieces = [(list(range(len(kept))), across)] if across * len(rows) >= len(kept) else [(row, len(row)) for row in rows]
    for line, (entries, count) in enumerate(pieces if kept else []):
        picture.legend(
            handles=[artists[kept[k]] for k in entries], loc="upper left", ncols=count, fontsize=SMALL, frameon=False,
            bbox_to_anchor=(0.06 / width, 1 - (0.03 + below + NEXT_ROW * line) / height),
            borderaxespad=0, borderpad=0.2, handlelength=sample, columnspacing=1.2,
        )  # fmt: skip
