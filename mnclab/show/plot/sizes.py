"""Figures in the sizes of a report: `size="a4" | "column" | "slide" | (width, height) inches`, `size_mm=(85, None)`, `legend`.

A figure is composed for letters of 8 points and then enlarged or reduced as a whole, so that its letters, lines and marks
keep their proportions whatever the paper.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import wraps
from inspect import Parameter, signature
from typing import Any, NamedTuple, TypeVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from mnclab.show.plot.enlarging import enlarge, reframe
from mnclab.show.plot.options import check_options
from mnclab.show.plot.picture import SIZE, SMALL
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, choice, shown

MM = 1 / 25.4  # inches
#: Width and height in mm (None: what the figure needs), and the points of its letters.
SIZES: dict[str, tuple[float, float | None, float]] = {
    "a4": (170.0, None, 8.0),  # the text of a page
    "column": (85.0, None, 7.0),  # of two on a page
    "slide": (13.33 / MM, 7.5 / MM, 16.0),
}
NARROW, LETTERS = 100.0, 7.0  # mm: figures below have letters of so many points
TALL = 1.4  # height to width at most, where the height is free
LEAST, MOST, TRIES = 40.0, 2000.0, 6  # mm of a side; times a figure is drawn to fit its height
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
        def door(*given: Any, size: Any = None, size_mm: Any = None, legend: bool = True, **options: Any) -> AnyFigure:
            check_options({**options, "legend": legend}, known)
            asked = room(size, size_mm)
            if options.get("ax") is not None or any(isinstance(each, Axes) for each in given[1:]):
                return draw(*given, **options)

            def drawn(inches: Room | None) -> AnyFigure:
                return _without_legend(draw(*given, **_inches(known, inches, tall), **options), legend)

            figure = drawn(asked)
            if asked is not None and asked.exact:
                figure, factor = _fitted(figure, asked, drawn)
                enlarge(figure, asked.factor * factor)
            return figure

        door.options = known  # type: ignore[attr-defined]
        return door

    return made


def _inches(known: Mapping[str, Parameter], asked: Room | None, tall: float | None) -> dict[str, Any]:
    """The size as the function that draws takes it."""
    if asked is None:
        return {}
    if "size" in known:
        usual = known["size"].default if isinstance(known["size"].default, tuple) else SIZE
        ratio = tall or (TALL if usual == SIZE else usual[1] / usual[0])
        return {"size": (asked.width, asked.height or asked.width * ratio)}
    return {"width": asked.width} if "width" in known else {}


def _fitted(figure: AnyFigure, asked: Room, draw: Callable[[Room], AnyFigure]) -> tuple[AnyFigure, float]:
    """The figure in exactly its width, and its height if that is given, and how much it is reduced for that.

    It is drawn narrower while that makes it low enough, else in a larger room; what is left over becomes its margin.
    """
    inches, before = asked, np.inf
    for _ in range(TRIES):
        width, height = figure.get_size_inches().tolist()
        over = max(width / inches.width, height / asked.height if asked.height else 0.0)
        if over <= 1 + 1e-9 or over >= before:
            break
        inches, before = inches._replace(width=inches.width / over), over
        figure = draw(inches)
    width, height = figure.get_size_inches().tolist()
    more = max(1.0, height / asked.height if asked.height else 1.0)
    if more > 1:
        figure = draw(asked._replace(width=asked.width * more, height=height))
        width, height = figure.get_size_inches().tolist()
    wide, tall = asked.width * more, asked.height * more if asked.height else height
    reframe(figure, (width - wide) / 2, (height - tall) / 2, wide, tall)
    return figure, 1 / more


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
