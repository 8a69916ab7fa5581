"""What every figure takes: `size="a4" | "column" | "slide" | (width, height) inches`, `size_mm=(85, None)`, `legend`, `title`.

A figure is composed for letters of 8 points and then enlarged or reduced as a whole, so that its letters, lines and marks
keep their proportions whatever the paper. The options of every figure are checked here.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from contextvars import ContextVar
from functools import wraps
from inspect import Parameter, signature
from typing import Any, NamedTuple, TypeVar

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import Collection, PathCollection
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrowPatch, Patch, Rectangle
from matplotlib.quiver import Quiver
from matplotlib.text import Annotation, Text

from mnclab.show.plot.picture import LEGEND, SIZE, SMALL, Picture, broken
from mnclab.text.alarm import Alarm
from mnclab.text.file import printable
from mnclab.text.given import check_number, check_point, choice, near_option, shown, whole

MM = 1 / 25.4  # inches
#: Width and height in mm (None: what the figure needs), and the points of its letters.
SIZES: dict[str, tuple[float, float | None, float]] = {
    "a4": (170.0, None, 8.0),  # the text of a page
    "column": (85.0, None, 7.0),  # of two on a page
    "slide": (13.33 / MM, 7.5 / MM, 16.0),
}
NARROW, LETTERS = 100.0, 7.0  # mm: figures below have letters of so many points
TALL = 1.4  # height to width at most, where the height is free
PAGE = 257.0  # mm: the height of the text of an A4 page, which no figure of free height exceeds
LEAST, MOST = 40.0, 2000.0  # mm of a side
TITLE: dict[str, Any] = {"fontsize": SMALL + 2, "fontweight": "bold", "parse_math": False}
EDGE, LINE_HIGH = 0.08, 1.2 * (SMALL + 2) / 72  # inches: around a title, and of a line of it
BOLD = 1.15  # times as wide as plain letters
TRIES, WIDER, NARROWER = 6, 2, 0.6  # times a figure is drawn narrower to fit its height, and in more room; the least share
COLUMNS, NAMED = range(2, 7), 0.55  # of views of a figure that is too high; inches of a view that has room for its name
HINT = 'size="a4", size="column", size="slide", size=(7, 5), size_mm=(85, None)'


class Room(NamedTuple):
    """Inches that a figure has while it is composed, `exact` ones filled; the `factor` to which it is enlarged then."""

    width: float
    height: float | None
    exact: bool
    factor: float


def room(size: Any, size_mm: Any) -> Room | None:
    """What the options of a size mean; None where nothing is said. An Alarm for what is no size."""
    if size is not None and size_mm is not None:
        raise Alarm("a figure has size or size_mm, not both", hint=HINT)
    if size is None and size_mm is None:
        return None
    if isinstance(size, str):
        wide, tall, letters = SIZES[choice(size, "size", SIZES)]
    elif size_mm is not None:
        wide, tall = _pair(size_mm, "size_mm", "mm", 1.0)
        letters = LETTERS if wide < NARROW else SMALL
    else:
        width, height = _pair(size, "size", "inches", MM)
        return Room(width, height, False, 1.0)
    factor = letters / SMALL
    return Room(wide * MM / factor, None if tall is None else tall * MM / factor, True, factor)


def _pair(given: Any, name: str, unit: str, counts: float) -> tuple[float, float | None]:
    """Width and height; the height may be None in mm."""
    if not isinstance(given, tuple | list) or len(given) != 2:
        named = f"{', '.join(SIZES)} or " if name == "size" else ""
        raise Alarm(f"{name} must be {named}(width, height) in {unit}, got {shown(given)}", hint=HINT)
    for value, side in zip(given, ("width", "height")):
        if value is not None or side == "width" or name == "size":
            check_number(value, f"the {side} of a figure ({unit})", at_least=round(LEAST * counts, 1), at_most=MOST * counts)
    return float(given[0]), None if given[1] is None else float(given[1])


LOOKING: ContextVar[bool] = ContextVar("LOOKING", default=False)  # for a size, and not for a picture


class Placed(Exception):
    """A figure whose axes stand, while its size is looked for."""


def placed(figure: Figure) -> None:
    """Said where all axes stand and nothing is drawn in them: who looks for a size needs no more."""
    if LOOKING.get():
        raise Placed(figure)


AnyFigure = TypeVar("AnyFigure", bound=Figure)


def sized(*, also: Any = None, tall: float | None = None) -> Callable[[Callable[..., AnyFigure]], Callable[..., AnyFigure]]:
    """Make a function that draws a figure take the options of every figure, and refuse options that it does not have.

    The function has `size` (inches), `width` (inches) or neither; `also` is another one to which it hands its options;
    `tall` is height to width where the height is free.
    """

    def made(draw: Callable[..., AnyFigure]) -> Callable[..., AnyFigure]:
        parameters = [*signature(draw).parameters.items()][1:]  # the first is what is drawn
        known = {name: each for name, each in parameters if each.kind not in (Parameter.VAR_KEYWORD, Parameter.VAR_POSITIONAL)}
        known = {**getattr(also, "options", {}), **known}

        @wraps(draw)
        def door(
            *given: Any, size: Any = None, size_mm: Any = None, legend: bool = True, title: str | None = None, **options: Any
        ) -> AnyFigure:
            check_options({**options, "legend": legend, "title": title}, known)
            title = " ".join(title.split()) if title else title  # a line end is broken anew
            asked = room(size, size_mm)
            own = [each for each in (*given[1:], options.get("ax")) if isinstance(each, Axes)]
            if own:
                if title:
                    own[0].set_title(printable(title), loc="left", **TITLE)
                return draw(*given, **options)

            def drawn(inches: Room | None, **more: int) -> AnyFigure:
                wanted = LEGEND.set(legend)
                try:
                    return _without_legend(draw(*given, **_inches(known, inches, tall), **{**options, **more}), legend)
                finally:
                    LEGEND.reset(wanted)

            over, above = 1.0, _head(title, asked.width)[1] if title and asked else 0.0
            if asked and asked.height:
                _must(above < asked.height / 2, "the title must be shorter: a figure of this size has no room for it", title)
                asked = asked._replace(height=asked.height - above)
            bare: list[Any] = []  # tries in whose axes nothing is drawn yet

            def tried(inches: Room, **more: int) -> AnyFigure:
                looking = LOOKING.set(legend)
                try:
                    return drawn(inches, **more)
                except Placed as found:
                    bare.append(found.args[0])
                    return bare[-1]
                finally:
                    LOOKING.reset(looking)

            if asked is not None and asked.exact:
                free = "columns" in known and options.get("columns") is None
                figure, rows = tried(asked), dict[str, int]()
                page = PAGE * MM / asked.factor - above
                within = asked._replace(height=page) if asked.height is None and figure.get_figheight() > page else asked
                if free:
                    figure, rows = _in_columns(figure, within, tried)
                figure, inches, over = _fitted(figure, within, lambda inches: tried(inches, **rows))
                figure = drawn(inches, **rows) if bare else figure
                _frame(figure, asked, over)
            else:
                figure = drawn(asked)
            if title:
                _entitle(figure, title, over)
            if asked is not None:
                enlarge(figure, asked.factor / over)

            def again(**more: Any) -> AnyFigure:
                sizes = {} if {"size", "size_mm"} & more.keys() else {"size": size, "size_mm": size_mm}
                return door(*given, **{**sizes, "legend": legend, "title": title, **options, **more})

            if isinstance(figure, Picture):
                figure.again = again
            return figure

        door.options = known  # type: ignore[attr-defined]
        added = [Parameter(name, Parameter.KEYWORD_ONLY, default=usual, annotation=kind) for name, (usual, kind) in ADDED.items()]
        rest = [each for name, each in parameters if each.kind == Parameter.VAR_KEYWORD]
        own = [each for name, each in signature(draw).parameters.items() if name != "size" and each not in rest]
        door.__signature__ = signature(draw).replace(parameters=[*own, *added, *rest])  # type: ignore[attr-defined]
        return door

    return made


def _inches(known: Mapping[str, Parameter], asked: Room | None, tall: float | None) -> dict[str, Any]:
    """The size as the function that draws takes it."""
    if asked is None:
        return {}
    if "width" in known:
        return {"width": asked.width} | ({"height": asked.height} if "height" in known else {})
    if "size" in known:
        usual = known["size"].default if isinstance(known["size"].default, tuple) else SIZE
        ratio = tall or (TALL if usual == SIZE else usual[1] / usual[0])
        return {"size": (asked.width, asked.height or asked.width * ratio)}
    return {}


def _over(figure: Figure, asked: Room) -> float:
    """How many times larger than its room a figure is, at least 1."""
    width, height = figure.get_size_inches().tolist()
    return max(1.0, width / asked.width, height / asked.height if asked.height else 0.0)


def _in_columns(figure: AnyFigure, asked: Room, draw: Callable[..., AnyFigure]) -> tuple[AnyFigure, dict[str, int]]:
    """A figure of several views that is too high, with as many in a row as make them largest in its room; and how many."""

    def area(one: Figure) -> float:
        """That of the axes as they are when what is too high has been taken from the heights of their rows."""
        boxes, size = [ax.get_position() for ax in one.axes], one.get_size_inches()
        rows = {round(box.y0, 3): box.height for box in boxes}
        left = min(1.0, max(0.0, 1 - (1 - (asked.height or size[1]) / size[1]) / sum(rows.values())))
        return sum(box.width * box.height for box in boxes) * float(size.prod()) * left**3  # letters count, too

    found: list[tuple[float, AnyFigure, dict[str, int]]] = [(area(figure), figure, {})]
    views = sum(bool(ax.get_title(loc="left")) for ax in figure.axes)
    for count in COLUMNS:
        if _over(found[-1][1], asked) <= 1:
            break
        if math.ceil(views / math.ceil(views / count)) < count:
            continue  # fewer fill as many rows
        tried = draw(asked, columns=count)
        if tried.axes[0].get_position().width * tried.get_figwidth() < NAMED:
            break
        found.append((area(tried), tried, {"columns": count}))
    return max(found, key=lambda each: each[0])[1:]


def _fitted(figure: AnyFigure, asked: Room, draw: Callable[[Room], AnyFigure]) -> tuple[AnyFigure, Room, float]:
    """A figure that fits, the room in which it was drawn, and how many times larger than what is asked it is.

    It is drawn narrower while that makes it low enough, else in a larger room.
    """
    more, inches, room = _over(figure, asked), asked, asked
    for _ in range(TRIES):
        inches = inches._replace(width=max(inches.width / more, NARROWER * asked.width))
        if more <= 1 + 1e-9 or _over(tried := draw(inches), asked) >= more:
            break
        figure, more, room = tried, _over(tried, asked), inches
    for _ in range(WIDER):
        inches = asked._replace(width=asked.width * more, height=asked.height and asked.height * more)
        if more <= 1 + 1e-9 or _over(tried := draw(inches), asked) > more + 1e-9:
            break
        figure, more, room = tried, _over(tried, asked), inches
    return figure, room, more


def _frame(figure: Figure, asked: Room, more: float) -> None:
    """Give a figure exactly its width, and its height if that is given, so many times; what is left over becomes its margin."""
    width, height = figure.get_size_inches().tolist()
    wide, tall = asked.width * more, asked.height * more if asked.height else height
    reframe(figure, (width - wide) / 2, (height - tall) / 2, wide, tall)


def _head(title: str, width: float) -> tuple[list[str], float]:
    """The lines of a title above a figure of so many inches, and the inches that they take."""
    lines = broken(printable(title), (width - 2 * EDGE) / BOLD, TITLE["fontsize"])
    return lines, LINE_HIGH * len(lines) + EDGE


def _entitle(figure: Figure, title: str, over: float) -> None:
    """Set a title above a figure that will be made so many times smaller."""
    width, height = figure.get_size_inches().tolist()
    lines, above = _head(title, width / over)
    reframe(figure, 0.0, 0.0, width, height + above * over)
    place = EDGE * over / width, 1 - EDGE * over / (height + above * over)
    figure.text(*place, "\n".join(lines), **TITLE | {"fontsize": TITLE["fontsize"] * over}, va="top", linespacing=1.15)
    if isinstance(figure, Picture):
        figure.alt = f"{title}: {figure.alt}"


def _without_legend(figure: AnyFigure, wanted: bool) -> AnyFigure:
    """The figure without the legends above and the room that they had, unless they are wanted."""
    if wanted:
        return figure
    for legend in list(figure.legends):
        legend.remove()
    width, height = figure.get_size_inches().tolist()
    renderer = figure.canvas.get_renderer() if hasattr(figure.canvas, "get_renderer") else None
    boxes = [each.get_tightbbox(renderer) for each in (*figure.axes, *figure.texts, *figure.artists, *figure.patches)]
    top = max((box.y1 for box in boxes if box is not None), default=height * figure.dpi) / figure.dpi
    if top + 0.06 < height:
        reframe(figure, 0.0, 0.0, width, top + 0.06)
    return figure


# The options of a figure: one that it does not have, or of another kind than it says, is an Alarm that names what it takes.

#: Of every figure: default and kind.
ADDED = {"size": (None, "Any"), "size_mm": (None, "Any"), "legend": (True, "bool"), "title": (None, "str | None")}
BOUNDS = {"width": (1.0, 100.0), "columns": (1, 100), "most": (0, None)}  # of numbers, wherever they are options
#: What shows that an object is of its kind, and how an alarm calls that kind, by the annotation of the option.
KINDS = {
    "Toolpath | None": ("is_motion", "a toolpath"),
    "Profile | None": ("pieces", "a profile"),
    "Workpiece | None": ("removed", "a workpiece"),
    "Blank | None": ("bounds", "a blank"),
    "Felt | None": ("places", "what a probe felt"),
    "Limits | None": ("rapid_motion", "limits of a machine"),
    "Sequence[Alarm]": ("severity", "alarms"),
    "Sequence[Place]": ("xyz", "places"),
    "Sequence[Overlay]": ("draw", "overlays"),
    "Iterable[Collision]": ("place", "those of a run"),
}


def check_options(options: Mapping[str, Any], known: Mapping[str, Parameter]) -> None:
    """An Alarm for an option that a figure does not have, with the nearest, or one that is not what it must be."""
    names = list(dict.fromkeys([*known, *ADDED]))
    for name, value in options.items():
        if name not in names:
            raise Alarm(f"this figure has no option {name}", hint=near_option(name, names))
        what = str(known[name].annotation) if name in known else ADDED[name][1]
        if value is not None or "None" not in what:
            _check(name, value, what.removesuffix(" | None"), what)


def _check(name: str, value: Any, what: str, annotation: str) -> None:
    if what == "bool" and not (isinstance(value, bool | int | np.bool_) and value in (0, 1)):
        raise Alarm(f"{name} must be True or False, got {shown(value)}")
    if what in ("float", "int"):
        least, most = BOUNDS.get(name, (None, None))
        check_number(value, "the width of a picture (inches)" if name == "width" else name,
                     at_least=least, at_most=most, endless=what == "float" and most is None)  # fmt: skip
        if what == "int":
            whole(value, name)
    if what == "str" and (isinstance(value, np.ndarray) or name == "title" and not isinstance(value, str)):
        raise Alarm(f"{name} must be a text, got {shown(value)}")
    if what == "Axes" and not isinstance(value, Axes):
        raise Alarm(f"ax must be axes of matplotlib, got {shown(value)}")
    if what == "Box":
        _must(isinstance(value, tuple | list) and len(value) == 2, f"{name} must be two corners of a picture", value)
        for corner in value:
            check_point(corner, f"a corner of {name}")
    if annotation in KINDS:
        shows, called = KINDS[annotation]
        several = "[" in annotation
        right = isinstance(value, tuple | list) and all(hasattr(each, shows) for each in value)
        _must(right if several else hasattr(value, shows), f"{name} must be {called}", value)
    if what.startswith("Mapping["):
        _must(isinstance(value, Mapping), f"{name} must be a dict", value)


def _must(right: bool, said: str, value: Any) -> None:
    if not right:
        raise Alarm(f"{said}, got {shown(value)}")


# A finished figure made larger or smaller with all that is counted in points, or set into a larger or smaller frame.

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
        for each in (ax, *ax.child_axes):  # a second scale
            _enlarge_axes(each, factor)
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
        if isinstance(artist, Annotation) and artist.arrow_patch:
            _enlarge(artist.arrow_patch, factor)
            if "mutation_scale" in (look := artist.arrowprops or {}):  # each drawing takes the size of the head from it
                artist.arrowprops = {**look, "mutation_scale": look["mutation_scale"] * factor}
    elif isinstance(artist, Line2D):
        artist.set_linewidth(artist.get_linewidth() * factor)
        artist.set_markersize(artist.get_markersize() * factor)
        artist.set_markeredgewidth(artist.get_markeredgewidth() * factor)
    elif isinstance(artist, Collection):
        artist.set_linewidth([each * factor for each in np.atleast_1d(artist.get_linewidth()).tolist()])
        if isinstance(artist, PathCollection):
            artist.set_sizes(artist.get_sizes() * factor**2)
        if isinstance(artist, Quiver) and artist.width:
            artist.width *= factor
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
