"""Which moves share a colour: by kind, feed, speed, tool, step, pass, source line or height, and the scale that says it.

Rapids and probing always keep their own look; `colour` divides the cuts. Few different values are a class each, named
in the legend; many are put into at most `BINS` bins between round numbers, explained by a scale. The colours grow
lighter with the value, so that grey print keeps the order; the slower a feed, the wider its line.
"""

from __future__ import annotations

import re
from typing import Any, NamedTuple

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import to_hex
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator
from numpy.typing import NDArray

from mnclab.path.toolpath import Kind, Toolpath
from mnclab.show.plot import colours
from mnclab.show.plot.colours import Dashes, LineStyle
from mnclab.show.plot.lathe import speed_at
from mnclab.show.plot.picture import SMALL, Picture
from mnclab.show.plot.strokes import Array, Strokes, parted
from mnclab.text.given import choice

COLOURS = ("kind", "feed", "speed", "tool", "step", "pass", "line", "z")
FEW, TOOLS, BINS = 6, 10, 14  # classes that the legend names one by one, tools likewise; bins of a scale at most
LIGHTEST = 0.58  # of the map: beyond it the contrast on white falls below 3 to 1
TITLES = {"feed": "feed, {unit}/min", "speed": "spindle, rev/min", "z": "Z, {unit}"}  # of the others the name itself
NAMES = {
    "feed": "{} {unit}/min", "speed": "{} rev/min", "tool": "tool {}", "step": "{}", "pass": "pass {}", "line": "line {}",
    "z": "Z {} {unit}",
}  # fmt: skip
#: Few classes: hues far apart, dark to light.
HUES = ("#2d0a5e", "#7d1128", "#1259a8", "#2f7d32", "#bf5ab0", "#c47a00")
DASHES: tuple[Dashes, ...] = ("-", (0, (7, 1)), (0, (3, 0.8)), (0, (6, 1, 1.2, 1)), (0, (1.6, 0.7)), (0, (4, 1, 1.2, 1, 1.2, 1)))
SLOW, FAST = 4.5, 1.5  # points: how wide the slowest and the fastest feed are drawn
SINGLE = ("tool", "pass", "line")  # whole numbers
LENGTHS = ("feed", "z")  # what counts in the unit of the program

Values = NDArray[Any]


class Scale(NamedTuple):
    """Bins between round numbers: `limits` (n + 1,) and a colour for each; `single`: a bin is one number."""

    title: str
    limits: tuple[float, ...]
    colours: tuple[str, ...]
    single: bool = False


class Classes(NamedTuple):
    """Looks of the classes, in the order of drawing; `group` (m,) is the class of the stroke to each point or -1."""

    lines: list[LineStyle]
    group: NDArray[np.int16]
    scale: Scale | None = None


def number(value: float) -> str:
    """A value as a scale writes it."""
    return f"{value:.6g}".replace("-", "\N{MINUS SIGN}")


def classes(path: Toolpath, drawn: Strokes, colour: str) -> Classes:
    """The classes of the strokes of a path; an Alarm for a colour that is not one of `COLOURS`."""
    colour = choice(colour, "colour", COLOURS)
    fixed = [colours.RAPID, colours.PROBING, colours.FEED]
    of_kind = np.full(max(Kind) + 2, -1, np.int16)  # the last one is for row -1
    of_kind[[Kind.RAPID, Kind.PROBE, Kind.LINE, Kind.ARC]] = 0, 1, 2, 2
    group = of_kind[path.kind[drawn.row]] if len(drawn.row) else np.empty(0, np.int16)
    group[drawn.row < 0] = -1
    cuts = group == 2
    if colour == "kind" and path.lathe and path.synchronous.any():
        return _with_threads(path, drawn, fixed, group)
    if colour == "kind" or not cuts.any():
        return Classes(fixed, group)
    if colour == "step":
        return _by_step(path, drawn, fixed, group)
    values = _values(path, drawn, colour)
    if colour in LENGTHS and path.inches:
        values = np.round(values / path.unit.length, 9)
    every = bool(cuts.all())
    divided, looks, scale = _divide(values if every else values[cuts], colour, path.unit.short)
    if every:
        group = divided + np.int16(2)
    else:
        group[cuts] = divided + np.int16(2)
    return Classes([*fixed[:2], *looks], group, scale)


def _with_threads(path: Toolpath, drawn: Strokes, fixed: list[LineStyle], group: NDArray[np.int16]) -> Classes:
    """On a lathe threads are a class for each lead (one for all if there are many)."""
    leads = np.round(path.per_rev[drawn.row], 6)
    thread = (group == 2) & path.synchronous[drawn.row]
    found = np.unique(leads[thread])
    found = found[np.isfinite(found)]
    if not 0 < len(found) <= FEW:
        group[thread] = len(fixed)
        return Classes([*fixed, colours.THREAD], group)
    looks = [colours.THREAD._replace(name=f"thread, lead {lead:.4g} mm") for lead in found]
    group[thread] = len(fixed) + np.searchsorted(found, leads[thread])
    return Classes([*fixed, *looks], group)


def _by_step(path: Toolpath, drawn: Strokes, fixed: list[LineStyle], group: NDArray[np.int16]) -> Classes:
    """What each stroke does in its cycle: the less is left to take off, the thinner."""
    numbers, names = steps_of(path)
    cuts = group == 2
    seen = np.unique(numbers[drawn.row[cuts]])
    group[cuts] = 2 + np.searchsorted(seen, numbers[drawn.row[cuts]])
    looks = [
        look._replace(name=names[k], dashes=dashes, width=1.9 if names[k] == ROUGHING else 1.5)
        for look, dashes, k in zip(_looks([""] * len(seen), "step", ""), DASHES, seen.tolist())
    ]
    return Classes([*fixed[:2], *looks], group)


def lines(drawn: Strokes, found: Classes) -> list[tuple[LineStyle, Array]]:
    """The classes that have a stroke, each with its points (k, 3), nan between."""
    pieces = parted(drawn.xyz, found.group, len(found.lines))
    return [(line, points) for line, points in zip(found.lines, pieces) if len(points)]


def _values(path: Toolpath, drawn: Strokes, colour: str) -> Values:
    """What the colour shows for the stroke to each point: the height of its lower end, the spindle speed of its middle."""
    if colour == "z":
        z = np.ascontiguousarray(drawn.xyz[:, 2])
        return np.concatenate([z[:1], np.minimum(z[1:], z[:-1])])
    if colour == "speed":
        x = np.ascontiguousarray(drawn.xyz[:, 0])
        return np.round(speed_at(path, drawn.row, (x + np.append(x[:1], x[:-1])) / 2), 6)
    if colour == "pass":  # what lies between two rapids
        after = np.cumsum(path.kind == Kind.RAPID)
        cuts = (path.kind == Kind.LINE) | (path.kind == Kind.ARC)
        return np.searchsorted(np.unique(after[cuts]), after[drawn.row]) + 1
    columns: dict[str, Values] = {"feed": path.feed, "tool": path.tool, "line": path.line}
    return columns[colour][drawn.row]


def _divide(values: Values, colour: str, unit: str) -> tuple[NDArray[np.int16], list[LineStyle], Scale | None]:
    """The class of each value, how the classes look, and a scale if they are bins."""
    few = _few(values, TOOLS if colour == "tool" else FEW)
    without = colours.FEED._replace(name=f"no {colour}", colour=colours.PROGRAMMED.colour)
    if few is not None:
        known = few[np.isfinite(few)]
        looks = _looks([number(value) for value in known], colour, unit)
        if len(known) < len(few):
            looks.append(without)
        group = np.zeros(len(values), np.int16)
        for value in known[1:]:
            group += values >= value
        group[~np.isfinite(values)] = len(known)
        return group, looks, None
    missing = ~np.isfinite(values)
    known = values[~missing] if missing.any() else values
    nice = MaxNLocator(BINS - 1, steps=[1, 2, 2.5, 5, 10], integer=colour in SINGLE)
    limits = np.asarray(nice.tick_values(float(known.min()), float(known.max())))
    if known.max() >= limits[-1]:  # a bin holds its lower limit, not its upper one
        limits = np.append(limits, 2 * limits[-1] - limits[-2])
    limits = np.round(limits, 9)
    single = colour in SINGLE and limits[1] - limits[0] == 1
    bins = [number(a) if single else f"{number(a)} to {number(b)}" for a, b in zip(limits[:-1], limits[1:])]
    looks = _looks(bins, colour, unit, few=False)
    shades = tuple(look.colour for look in looks)
    looks.append(without)
    share = (np.where(missing, limits[0], values) - limits[0]) / (limits[1] - limits[0])
    group = np.clip(share, 0, len(shades) - 1).astype(np.int16)
    group[missing] = len(shades)
    return group, looks, Scale(TITLES.get(colour, colour).format(unit=unit), tuple(limits.tolist()), shades, single)


def _few(values: Values, most: int) -> Values | None:
    """The different values in rising order, nan last; None if there are more than `most`."""
    if len(np.unique(values[:: max(1, len(values) // 1000)])) > most:
        return None
    found = np.unique(values[np.append(values[1:] != values[:-1], True)])
    return found if len(found) <= most else None


def _looks(values: list[str], colour: str, unit: str, few: bool = True) -> list[LineStyle]:
    """Cuts of rising values: the greater are drawn later, but the deeper where the colour shows Z, and the slower."""
    count, base, name = len(values), colours.FEED, NAMES[colour]
    order = range(count, 0, -1) if colour in ("z", "feed") else range(count)
    shades = hues(count) if few and colour != "z" and count <= len(HUES) else ramp(count)
    wide = np.linspace(SLOW, FAST, count).tolist() if colour == "feed" and count > 1 else [base.width] * count
    return [
        base._replace(name=name.format(value, unit=unit), colour=shade, width=width, order=base.order + 0.01 * k)
        for value, shade, width, k in zip(values, shades, wide, order)
    ]


def hues(count: int) -> tuple[str, ...]:
    """As many of `HUES`, as far apart as they can be."""
    return tuple(HUES[round(k * (len(HUES) - 1) / max(count - 1, 1))] for k in range(count))


def ramp(count: int) -> tuple[str, ...]:
    """Colours from dark to light, equal steps in lightness; all of them have contrast on white."""
    return tuple(to_hex(colormaps["viridis"](LIGHTEST * k / max(count - 1, 1))) for k in range(count))


# What a row of a path does in its cycle, in a word or two, for `colour="step"`: roughing, finishing, entry, a peck.
# The names come out of the labels of the rows ("CYCL DEF 251 layer 1 of 3, ring 2"), whatever the control.

BLOCKS, OTHERS, ROUGHING, FINISHING, ENTRY = "blocks of the program", "other steps", "roughing", "finishing", "entry"
CODE = re.compile(r"(?:CYCL (?:DEF|CALL)(?: PAT| POS)?|G)\s?\d*\s*")
NUMBERS = re.compile(r" ?(?<!\d)\d++ of \d++| \d++(?=,|$)")
COARSE = ("layer", "level", "pass", "line", "opening")
FINE = ("contour", "clean-up", "finishing")
MOST = 6  # names; what makes the shortest way goes together beyond


def step_name(label: str) -> str:
    """The step of a label; what no cycle made is `BLOCKS`."""
    code = CODE.match(label)
    if code is None:
        return BLOCKS
    head, *tail = NUMBERS.sub("", label[code.end() :]).split(", ")
    if any(piece.startswith(("entry", "plunge")) for piece in (head, *tail)):
        return ENTRY
    if head in FINE or (tail and tail[0] in FINE):
        return FINISHING
    return ROUGHING if head in COARSE else head or BLOCKS


def steps_of(path: Toolpath) -> tuple[NDArray[np.int64], list[str]]:
    """A number for each row (n,) of a path, and the names of the numbers, in the order of the program."""
    names = [step_name(label) for label in path.labels]
    known = list(dict.fromkeys(names[label] for label in dict.fromkeys(path.label.tolist())))
    way = {name: 0.0 for name in known}
    for label, length in enumerate(np.bincount(path.label, path.lengths * np.isfinite(path.feed), len(names)).tolist()):
        if names[label] in way:
            way[names[label]] += length
    if len([name for name in known if way[name]]) > MOST:
        kept = sorted(known, key=lambda name: -way[name])[: MOST - 1]
        names = [name if name in kept else OTHERS for name in names]
        known = [*(name for name in known if name in kept), OTHERS]
    number = np.array([known.index(name) if name in known else 0 for name in names], dtype=np.int64)
    return number[path.label], known


# A small scale of colours above the views: steps between round numbers, named with their unit.

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
