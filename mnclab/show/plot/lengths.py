"""Spindle nose, tool and tip after a line, with their heights: what the length offset of a control does, and a wrong one.

Seen from the side, Z true to scale where it lies near, machine coordinates to the left. The control thinks that the tip is as
far below the spindle nose as the offset says; it truly is below it by the length of the tool.
"""

from __future__ import annotations

from typing import Any, NamedTuple, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon, Rectangle

from mnclab.geometry import frames
from mnclab.path.listing import Unit
from mnclab.show.plot import colours
from mnclab.show.plot.datums import LENGTH, Chains
from mnclab.show.plot.picture import SMALL, Picture
from mnclab.show.plot.sizes import sized
from mnclab.text.alarm import Alarm

SAME = 1e-3  # mm between tip and program that are no fault
FAR = 3.0  # a machine zero so many times as far away as all else is high is drawn at the border
SHORT = 0.3  # of the picture's height: a dimension whose text stands above it
STEEL, TOOL = "#c9ccd1", "#9fb4c9"
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
        said = f"line {line}: spindle at {_f(unit, found.nose)}, tip at {tip} of {found.name}, {unit.short}; {told}"
        picture = Picture(size, said)
        ax = picture.add_axes((0.02, 0.1, 0.96, 0.8))
    levels = [found.nose, found.tip, found.wanted, found.zero]
    low, high = min(levels), max(levels)
    span = max(high - low, 1e-3)
    far = not low - FAR * span <= 0 <= high + FAR * span
    zero = (low - 0.3 * span if low > 0 else high + 0.3 * span) if far else 0.0
    low, high = min(low, zero), max(high, zero)
    room = high - low
    ax.set(xlim=(0, 11.2), ylim=(low - 0.1 * room, high + 0.36 * room))
    _body(ax, found, room)
    for level, name, colour, at, edge in (
        (zero, "machine zero" + (", not to scale" if far else ""), colours.MACHINE_ZERO.colour, 0.1, "left"),
        (found.zero, f"{found.name} Z0", colours.INK, 11.1, "right"),
    ):
        ax.plot([0.1, 11.1], [level, level], color=colour, linewidth=0.9, linestyle=(0, (10, 3, 1.5, 3)), zorder=1.5)
        below = level < found.nose  # on the side where no arrow stands
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
    return picture if picture is not None else cast(Figure, ax.get_figure(root=True))


def _f(unit: Unit, value: float) -> str:
    return unit.figure(value, 1).replace("-", "\N{MINUS SIGN}")


def _off(off: float, unit: Unit) -> str:
    return f"the tip is {_f(unit, abs(off))} {unit.short} too {'high' if off > 0 else 'low'}"


def _body(ax: Axes, found: Heights, room: float) -> None:
    """The nose of the spindle, and the tool below it."""
    nose = Polygon(
        [(2.9, found.nose), (5.1, found.nose), (5.5, found.nose + 0.13 * room), (2.5, found.nose + 0.13 * room)],
        facecolor=STEEL, edgecolor=colours.INK, linewidth=1.0, zorder=2.5,
    )  # fmt: skip
    ax.add_patch(nose)
    ax.annotate("spindle", (4.0, found.nose + 0.065 * room), ha="center", va="center", fontsize=SMALL, zorder=3)
    if found.length > 0:
        holder, height = 0.35 * found.length, found.length
        ax.add_patch(Rectangle((3.3, found.nose - holder), 1.4, holder, facecolor=STEEL, edgecolor=colours.INK, zorder=2.4))
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
