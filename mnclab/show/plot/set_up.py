"""The set-up of a program: the blank as it is clamped, and where the parts lie on the machine."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrowPatch, Patch, Polygon, Rectangle

from mnclab.geometry import frames
from mnclab.geometry.frames import shift
from mnclab.path.listing import Unit
from mnclab.path.toolpath import Array
from mnclab.show import looks
from mnclab.show.chains import LENGTH, ORIGINS, Chains
from mnclab.show.plot import colours
from mnclab.show.plot.datums import DatumCross, places_of, write_names
from mnclab.show.plot.overlay import line, texts
from mnclab.show.plot.picture import SIZE, SMALL, VIEWS, Picture, View, arrange, dress, figure_of, roomy, write_legend
from mnclab.show.plot.probed import draw_material
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.strokes import corners, line_of
from mnclab.text.alarm import Alarm
from mnclab.text.given import choice
from mnclab.workpiece.blank import blank
from mnclab.workpiece.part import Part

# The blank from above and from the side: its sizes, the datum as a quartered circle, what holds it.

SHEET_SIZE = (6.8, 4.6)  # inches, at most
BLANK: dict[str, Any] = {"facecolor": looks.RAW, "edgecolor": "#8c8778", "linewidth": 1.0}
FIXTURE: dict[str, Any] = {"facecolor": "#c4c7cc", "edgecolor": "#4a4a4a", "linewidth": 1.6}  # no hatching: names stand on it
ROOM = 0.2  # of the greatest side, around the blank for its dimensions
DIMENSION: dict[str, Any] = {"arrowstyle": "<|-|>", "color": colours.INK, "linewidth": 0.7, "mutation_scale": 7}
DIMENSION |= {"shrinkA": 0, "shrinkB": 0}


def zero_points(run: Any) -> list[tuple[str, Array]]:
    """The zero points of a program by name, (3,) mm in the coordinates of its path, each once; the nearest to the blank first."""
    found = [(each.name, np.array(each.xyz)) for each in places_of(run) if each.mark is colours.DATUM]
    if run.stock is not None:  # one that was active at power-on alone stands at the machine's zero, far away
        low, high = run.stock.bounds
        found.sort(key=lambda each: float(np.linalg.norm(np.fmax(np.fmax(low - each[1], each[1] - high), 0.0))))
    return found or [("zero", np.zeros(3))]


def plot_set_up(run: Any, size: tuple[float, float] = SHEET_SIZE) -> Picture:
    """Views of a blank with its fixtures and zero points; of a lathe Z to the right and the diameter up."""
    stock, lathe, origin = run.stock, run.toolpath.lathe, np.array(run.toolpath.origin)
    views = [VIEWS["ZX"]] if lathe else [VIEWS["XY"], VIEWS["XZ"]]
    views = [view._replace(unit=run.toolpath.unit) for view in views]
    low, high = (np.array(each, dtype=float) for each in stock.bounds)
    room = ROOM * float((high - low).max())
    around = low - room, high + room
    if lathe:
        around[0][0], around[0][1] = 0.0, 0.0
    near = around[0] - room, around[1] + room
    places = [(name, xyz) for name, xyz in zero_points(run) if ((xyz >= near[0]) & (xyz <= near[1])).all()]
    for _, xyz in places:
        around = np.fmin(around[0], xyz - room / 2), np.fmax(around[1], xyz + room / 2)
    if lathe:
        around[0][0] = 0.0
    names = ["blank", *(["fixture"] if run.setup.fixtures else [])]
    said = f"set-up: blank {' x '.join(f'{side:.4g}' for side in (high - low).tolist())} mm"
    said += "".join(f", {name} at {' '.join(f'{axis}{v:.4g}' for axis, v in zip('XYZ', xyz.tolist()))}" for name, xyz in places)
    picture, axes = arrange(views, *around, names, None, said, size)
    for ax, view in zip(axes, views):
        for each in run.setup.fixtures:
            _body(ax, view, each, origin, FIXTURE)
        _body(ax, view, stock, None, BLANK)
        _dimensions(ax, view, low, high)
        for name, xyz in places:
            _datum(ax, view, name if lathe else "", xyz)
        named = [DatumCross(colours.DATUM, name, tuple(xyz.tolist())) for name, xyz in places if not lathe]
        upright = np.array([low, high])  # the dimension line to the right
        upright[:, 0] = high[0] + 0.45 * room
        write_names(ax, view, named, np.empty((0, 2)), [upright])
    artists = {"blank": Patch(**BLANK, label="blank"), "fixture": Patch(**FIXTURE, label="fixture")}
    write_legend(picture, [artists[name] for name in names])
    return picture


def _body(ax: Axes, view: View, body: Any, origin: Array | None, look: dict[str, Any]) -> None:
    """The outline of a blank, or of a fixture in machine coordinates."""
    if isinstance(body, Part):
        draw_material(ax, body, view, shift(*(origin if origin is not None else np.zeros(3))), 0.0)
        return
    found = blank(body)
    if found is None:
        return
    found = found if origin is None else found.moved(-origin)
    for outline in found.outline(view.right, view.up):
        points = np.maximum(outline, [-np.inf, 0]) if view.diameter else outline
        ax.add_patch(Polygon(np.asarray(points), **look, zorder=0.8 if look is FIXTURE else 1.0))


def _dimensions(ax: Axes, view: View, low: Array, high: Array) -> None:
    """The length of the blank below it and its height to the right, with dimension lines as on drawings."""
    unit, (a, b) = view.unit, (view.right, view.up)
    off = ROOM * 0.45 * float((high - low).max())
    x0, x1, y0, y1 = low[a], high[a], max(low[b], 0.0) if view.diameter else low[b], high[b]
    across = f"{unit.figure(x1 - x0, 1)}"
    up = f"⌀{unit.figure(2 * y1, 1)}" if view.diameter else unit.figure(y1 - y0, 1)
    y = y1 + off if view.diameter else y0 - off
    thin: dict[str, Any] = {"color": colours.INK, "linewidth": 0.4}
    if view.up != 2:  # the view from the side has the same length
        ax.annotate("", (x0, y), (x1, y), arrowprops=DIMENSION, annotation_clip=False)
        ax.annotate(across, ((x0 + x1) / 2, y), (0, 2), textcoords="offset points", ha="center", va="bottom", fontsize=SMALL)
        for x in (x0, x1):
            ax.add_line(Line2D([x, x], [y1 if view.diameter else y0, y + (0.15 if view.diameter else -0.15) * off], **thin))
    ax.annotate("", (x1 + off, y0), (x1 + off, y1), arrowprops=DIMENSION, annotation_clip=False)
    ax.annotate(
        up, (x1 + off, (y0 + y1) / 2), (-2, 0), textcoords="offset points", ha="right", va="center", fontsize=SMALL, rotation=90,
    )  # fmt: skip
    for h in (y0, y1):
        ax.add_line(Line2D([x1, x1 + 1.15 * off], [h, h], **thin))


def _datum(ax: Axes, view: View, name: str, xyz: Array) -> None:
    """The symbol of a zero point: a circle with two quarters filled, and its name."""
    x, y = xyz[view.right], xyz[view.up]
    ax.add_line(Line2D([x], [y], **colours.DATUM.style()))
    card: dict[str, Any] = {"facecolor": colours.PAPER, "edgecolor": "none", "pad": 0.6, "alpha": 0.85}
    below = view.diameter and y <= 0.0  # there the blank ends, and a dimension stands to the right
    off, side = ((0, -9), "center") if below else ((8, 8), "left")
    where: dict[str, Any] = {"textcoords": "offset points", "ha": side, "va": "top" if below else "baseline"}
    ax.annotate(name, (x, y), off, fontsize=SMALL, zorder=4.2, bbox=card, **where)


# Where the parts lie on the machine: machine zero, and from it a vector to every zero point that a program selects.
# Numbers at the axes are machine coordinates. Where machine zero is so far away that the picture would be empty, the
# vectors are broken: it stands at the border then, and that is said.

FAR = 3.0  # times the size of all else: a machine zero beyond that is drawn at the border
GAP = 0.35  # of that size: how far from it the border is
ZERO_POINT = colours.DATUM._replace(name="zero point")
ARROW: dict[str, Any] = {"arrowstyle": "-|>", "mutation_scale": 11, "shrinkA": 6, "shrinkB": 6, "linewidth": 1.3}


@sized()
def plot_datums(run: Any, ax: Axes | None = None, *, view: str = "XY", size: tuple[float, float] = SIZE) -> Figure:
    """Machine zero, the zero points of a run and the cuts, in machine coordinates.

    Work offsets and presets are vectors from machine zero, what G92, G52 or a datum shift moves is a vector from the zero
    point before it; each says its name and its coordinates. `view` is "XY", "XZ" or "YZ"; on a lathe "ZX" (diameters).
    """
    path = run.toolpath
    looked = VIEWS["ZX" if path.lathe and view == "XY" else choice(view, "view", VIEWS)]._replace(unit=path.unit)
    origin = np.asarray(path.origin)
    places = [place for place in places_of(run) if place.mark is colours.DATUM and np.isfinite(place.xyz).all()]
    spots = np.array([place.xyz for place in places]).reshape(-1, 3) + origin
    cuts = line_of(path, rapids=run.rapids) + origin
    around = corners([each for each in (cuts, spots) if len(each)], False) or (np.zeros(3), np.ones(3))
    zero, broken = np.zeros(3), False
    axes = [looked.right, looked.up]
    reach, (low, high) = float((around[1] - around[0])[axes].max()), around
    away = np.fmax(np.fmax(low, 0.0) - np.fmin(high, 0.0) - (high - low), 0.0)[axes]
    if away.max() > FAR * max(reach, 1e-6):
        broken = True
        zero = np.clip(zero, low - GAP * reach, high + GAP * reach)
    low, high = np.fmin(low, zero), np.fmax(high, zero)
    said = f"zero points in machine coordinates: {'; '.join(_told(place, spot, path.unit) for place, spot in zip(places, spots))}"
    handles: list[Any] = []
    picture = None
    if ax is None:
        picture, (ax,) = arrange([looked], low, high, ["machine zero", "zero point", "cuts and rapids"], None, said, size)
    else:
        dress(ax, looked)
        wide = roomy(low, high, [looked])
        for limits, k in ((ax.set_xlim, looked.right), (ax.set_ylim, looked.up)):
            limits(wide[0][k], wide[1][k])
        ax.apply_aspect()
    if len(cuts):
        handles.append(line(ax, looked, cuts, colours.PROGRAMMED, label="cuts and rapids"))
    vectors = []
    for place, spot in zip(places, spots):
        begin = _parent(place, places, spots, zero)
        vectors.append(np.array([begin, spot]))
        _vector(ax, looked, begin, spot, broken and begin is zero)
    handles += [line(ax, looked, each, look) for each, look in ((zero[None], colours.MACHINE_ZERO), (spots, ZERO_POINT))]
    names = ["machine zero, not to scale" if broken else "machine zero"]
    middle = (low + high) / 2
    wishes = np.array([(0.7, -0.7), *(_way(spot, middle, looked) for spot in spots)])
    labels = [_told(place, spot, path.unit) for place, spot in zip(places, spots)]
    texts(ax, looked, zip([*names, *labels], np.vstack([zero[None], spots]), wishes), [cuts, *vectors], mark=7.0)
    if picture is None:
        return figure_of(ax)
    write_legend(picture, handles)
    return picture


def _way(spot: Array, middle: Array, view: View) -> tuple[float, float]:
    """Away from the middle of the picture."""
    way = (spot - middle)[[view.right, view.up]]
    size = float(np.hypot(*way))
    return (float(way[0] / size), float(way[1] / size)) if size > 1e-9 else (0.7, 0.7)


def _told(place: DatumCross, spot: Array, unit: Unit) -> str:
    """`G54 X100 Y50 Z20`, in machine coordinates."""
    return f"{place.name}  " + " ".join(f"{axis}{unit.figure(value, 1)}" for axis, value in zip("XYZ", spot))


def _parent(place: DatumCross, places: list[DatumCross], spots: Array, zero: Array) -> Array:
    """From where a zero point is shifted: the work offset before it, machine zero for a work offset itself."""
    shifts = {name for name in ORIGINS.values() if name not in ("", "preset")} | {"G52", LENGTH}
    if set(place.name.split(", ")) <= shifts:
        for k in range(places.index(place) - 1, -1, -1):
            if not set(places[k].name.split(", ")) <= shifts:
                return np.asarray(spots[k])
    return zero


def _vector(ax: Axes, view: View, begin: Array, end: Array, broken: bool) -> None:
    a, b = begin[[view.right, view.up]], end[[view.right, view.up]]
    if np.allclose(a, b):
        return
    ax.add_patch(FancyArrowPatch(tuple(a), tuple(b), color=colours.MACHINE_ZERO.colour, zorder=3.4, **ARROW))
    if broken:  # two strokes across its middle, a gap between them
        way = np.diff(ax.transData.transform([a, b]), axis=0)[0]
        way /= np.hypot(*way)
        look: dict[str, Any] = {"textcoords": "offset points", "xytext": (0, 0), "ha": "center", "va": "center", "zorder": 3.5}
        angle = float(np.degrees(np.arctan2(way[1], way[0])))
        box = {"boxstyle": "square,pad=0.02", "facecolor": colours.PAPER, "edgecolor": "none"}
        middle = a + 0.45 * (b - a)
        ax.annotate("//", tuple(middle), fontsize=9, rotation=angle, color=colours.MACHINE_ZERO.colour, bbox=box, **look)


# Spindle nose, tool and tip after a line, with their heights: what the length offset of a control does, and a wrong one.
#
# Seen from the side, Z true to scale where it lies near, machine coordinates to the left. The control thinks that the tip is as
# far below the spindle nose as the offset says; it truly is below it by the length of the tool.

SAME = 1e-3  # mm between tip and program that are no fault
UPRIGHT = 1.1  # inches of a dimension and its number
SHORT = 0.3  # of the picture's height: a dimension whose text stands above it
TOOL = "#9fb4c9"
GHOST = "#ad1457"


class Heights(NamedTuple):
    """Heights in machine coordinates, mm: spindle nose, tip, where the program wants the tip, and the program's zero."""

    nose: float
    tip: float
    wanted: float
    zero: float
    name: str
    number: int

    @property
    def length(self) -> float:
        """Of the tool."""
        return self.nose - self.tip

    @property
    def offset(self) -> float:
        """With which the control counts."""
        return self.nose - self.wanted


def heights_of(run: Any, line: int, pass_: int = 1) -> Heights:
    """The heights after a line; an Alarm where Z is not the tool's axis, or the coordinates are turned."""
    moment, path = run.at(line, pass_), run.toolpath
    step = moment.step
    if path.lathe or (run.history.value("tool axis", step) or "Z") != "Z":
        raise Alarm("the lengths of tools are shown of a mill whose tool stands along Z")
    matrix = Chains(run).at(step).matrix
    if not np.allclose(matrix[2, :3], (0, 0, matrix[2, 2])) or not matrix[2, 2] > 0:
        raise Alarm(f"in line {line} the coordinates are tilted: Z is no height")
    tip = float(moment.point[2] + path.origin[2])
    tool = run.history.value("tool", step)
    number = int(getattr(tool, "number", tool or 0))
    known = run.tables.tools.get(number)
    length = known.effective_length if known else 0.0
    wanted = float(frames.apply(matrix, np.array(moment.position))[2])
    if f"frame {LENGTH}" not in run.history:
        wanted = tip  # a control that always counts with the length of the tool
    datum = str(run.history.value("datum", step) or "zero")
    return Heights(tip + length, tip, wanted, float(matrix[2, 3]), datum, number)


@sized()
def plot_lengths(
    run: Any, line: int, ax: Axes | None = None, *, pass_: int = 1, size: tuple[float, float] = (5.4, 5.0)
) -> Figure:
    """Spindle, tool and tip after a line: the length of the tool, the offset that the control takes for it, the Z of the
    program and that of the machine. A tip that is not where the program says is shown red, with how far it is off.

    Of a mill whose tool stands along Z; an Alarm for others.
    """
    found, unit = heights_of(run, line, pass_), run.toolpath.unit
    off = found.tip - found.wanted
    fault = abs(off) > SAME
    told = _off(off, unit) if fault else "the tip is where the program says"
    picture = None
    if ax is None:
        tip = _f(unit, found.tip - found.zero)
        said = f"line {line}: spindle at {_f(unit, found.nose)}, tip at {tip} of {found.name}; {told}"
        picture = Picture(size, said)
        ax = picture.add_axes((0.02, 0.1, 0.96, 0.8))
    levels = [found.nose, found.tip, found.wanted, found.zero]
    low, high = min(levels), max(levels)
    span = max(high - low, 1e-3)
    far = not low - FAR * span <= 0 <= high + FAR * span
    zero = (low - 0.3 * span if low > 0 else high + 0.3 * span) if far else 0.0
    low, high = min(low, zero), max(high, zero)
    room = high - low
    share = min(UPRIGHT / ax.get_window_extent().height * figure_of(ax).dpi, 0.5)  # of what stands above a short dimension
    ax.set(xlim=(0, 11.2), ylim=(low - 0.1 * room, high + max(0.36, 1.15 * share / (1 - share)) * room))
    _tool_body(ax, found, room)
    for level, name, colour, at, edge in (
        (zero, "machine zero" + (", not to scale" if far else ""), colours.MACHINE_ZERO.colour, 0.1, "left"),
        (found.zero, f"{found.name} Z0", colours.INK, 11.1, "right"),
    ):
        ax.plot([0.1, 11.1], [level, level], color=colour, linewidth=0.9, linestyle=(0, (10, 3, 1.5, 3)), zorder=1.5)
        below = level <= found.nose  # on the side where no arrow stands
        look: dict[str, Any] = {"fontsize": SMALL, "color": colour, "ha": edge, "va": "top" if below else "bottom", "zorder": 5}
        ax.annotate(name, (at, level), (0, -3 if below else 3), textcoords="offset points", parse_math=False, **look)
    _dimension(ax, 1.3, zero, found.nose, f"machine Z {_f(unit, found.nose)}", colours.MACHINE_ZERO.colour, far)
    _dimension(ax, 6.4, found.tip, found.nose, f"tool T{found.number} {_f(unit, found.length)}", colours.INK)
    _dimension(ax, 7.7, found.wanted, found.nose, f"offset {_f(unit, found.offset)}", GHOST)
    _dimension(ax, 9.0, found.zero, found.wanted, f"program Z {_f(unit, found.wanted - found.zero)}", colours.FEED.colour)
    for height, begin, end, colour in (
        (found.nose, 1.0, 8.0, colours.INK), (found.tip, 3.6, 6.7, colours.INK), (found.wanted, 3.6, 9.3, GHOST),
    ):  # fmt: skip
        ax.plot([begin, end], [height, height], color=colour, linewidth=0.6, zorder=1.8)
    if fault:
        ax.plot([4.0], [found.wanted], marker="_", markersize=26, color=GHOST, markeredgewidth=2, zorder=4)
        _dimension(ax, 2.9, found.wanted, found.tip, "", colours.ALARM.colour)
    shade = colours.ALARM.colour if fault else colours.INK
    text = ax.set_title(f"line {line}: {told}", fontsize=SMALL + 1, loc="left", color=shade)
    text.set_parse_math(False)
    ax.set_axis_off()
    return picture if picture is not None else figure_of(ax)


def _f(unit: Unit, value: float) -> str:
    return f"{unit.figure(value, 1)} {unit.short}".replace("-", "\N{MINUS SIGN}")


def _off(off: float, unit: Unit) -> str:
    return f"the tip is {_f(unit, abs(off))} too {'high' if off > 0 else 'low'}"


def _tool_body(ax: Axes, found: Heights, room: float) -> None:
    """The nose of the spindle, and the tool below it."""
    nose = Polygon(
        [(2.9, found.nose), (5.1, found.nose), (5.5, found.nose + 0.13 * room), (2.5, found.nose + 0.13 * room)],
        facecolor=looks.STEEL, edgecolor=colours.INK, linewidth=1.0, zorder=2.5,
    )  # fmt: skip
    ax.add_patch(nose)
    ax.annotate("spindle", (4.0, found.nose + 0.065 * room), ha="center", va="center", fontsize=SMALL, zorder=3)
    if found.length > 0:
        holder, height = 0.35 * found.length, found.length
        ax.add_patch(Rectangle((3.3, found.nose - holder), 1.4, holder, facecolor=looks.STEEL, edgecolor=colours.INK, zorder=2.4))
        ax.add_patch(Rectangle((3.7, found.tip), 0.6, height - holder, facecolor=TOOL, edgecolor=colours.INK, zorder=2.4))


def _dimension(ax: Axes, x: float, low: float, high: float, text: str, shade: str, broken: bool = False) -> None:
    """A dimension line with arrows at both ends, its text beside it; a break where it is not to scale."""
    look: dict[str, Any] = {"arrowstyle": "<|-|>", "color": shade, "linewidth": 1.0, "mutation_scale": 8}
    if abs(high - low) > 1e-9:
        ax.annotate("", (x, low), (x, high), arrowprops=look | {"shrinkA": 0, "shrinkB": 0}, zorder=3)
    said: dict[str, Any] = {"fontsize": SMALL, "color": shade, "rotation": 90, "zorder": 4, "parse_math": False}
    said["bbox"] = {"boxstyle": "square,pad=0.15", "facecolor": colours.PAPER, "edgecolor": "none"}
    words = f"{text}  //" if broken else text
    bottom, top = ax.get_ylim()
    if text and abs(high - low) > SHORT * (top - bottom):
        ax.text(x, (low + high) / 2, words, ha="center", va="center", **said)
    elif text:  # no room between the arrows: above them
        ax.text(x, max(low, high) + 0.02 * (top - bottom), words, ha="center", va="bottom", **said)
