"""What only figures of a lathe show: the blank, the insert, threads with their lead, the spindle speed.

Views have Z to the right and X up; positions are those of the path: X a radius, mm.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.patches import Patch, Polygon
from numpy.typing import NDArray

from mnclab.path.feeds import spindle_speed
from mnclab.path.inserts import as_drawn, holder, insert, lead_of
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Kind, Toolpath
from mnclab.show import looks
from mnclab.show.plot import colours
from mnclab.show.plot.picture import SMALL, Picture, stacked
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.strokes import Array, Strokes
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.part import Part
from mnclab.workpiece.turning.turned import half_section
from mnclab.workpiece.workpiece import Workpiece

CUTS = (Kind.LINE, Kind.ARC)
CHORD = 0.01  # mm, of arcs in what is filled
BAR: dict[str, Any] = {"facecolor": looks.RAW, "edgecolor": "#8c8061", "linewidth": 0.8}
FINISHED: dict[str, Any] = {"facecolor": looks.METAL, "edgecolor": "#55503f", "linewidth": 1.3}
CHUCK: dict[str, Any] = {"facecolor": looks.STEEL, "edgecolor": colours.INK, "linewidth": 0.9}
PARTS = 24  # of a row along which the speed changes


class Lathe(NamedTuple):
    """A blank (z from, z to, radius), the tool and where its tip stands (z, r), the rings (k, 2) of the chuck."""

    blank: tuple[float, float, float] | None
    tool: Tool
    tip: tuple[float, float] | None
    chucks: list[Array]

    @property
    def names(self) -> list[Patch]:
        """What a legend says of what stands beside the path."""
        found = [Patch(**BAR, label="blank")] if self.blank else []
        return found + ([Patch(**CHUCK, label="chuck")] if self.chucks else [])


def lathe(
    path: Toolpath, stock: Blank | None, tools: Mapping[int, Tool], insert: bool | int, part: Workpiece | None = None
) -> Lathe:
    """What is drawn beside the path; `stock` stands in the coordinates of the path, the insert stands after a row."""
    blank, tip, tool = _blank(stock), None, Tool()
    if len(path) and insert is not False:
        row = len(path) - 1 if insert is True else range(len(path))[int(insert)]
        number = int(path.tool[row])
        tip, tool = (float(path.end[row, 2]), float(path.end[row, 0])), tools.get(number, Tool())
        tool = as_drawn(tool, lead_of(path[: row + 1], path.tool[: row + 1] == number))
    return Lathe(blank, tool, tip, chucks_of(part.cutting.fixtures) if part else [])


def chucks_of(fixtures: Sequence[Any]) -> list[Array]:
    """The half sections of what holds a bar, rings (k, 2) of z and r; a part that only a probe knows has none."""
    loops = [loop for each in fixtures if not isinstance(each, Part) for loop in half_section(each)[0]]
    return [loop.points_within(CHORD) for loop in loops]


def _blank(stock: Blank | None) -> tuple[float, float, float] | None:
    if stock is None:
        return None
    low, high = stock.bounds
    return float(low[2]), float(high[2]), float(max(abs(low[0]), abs(high[0])))


def with_blank(
    path: Toolpath, stock: Blank | None, low: Array, high: Array, part: Workpiece | None = None
) -> tuple[Array, Array]:
    """The box (3,) and (3,) of a picture with the blank of a lathe and its chuck in it."""
    blank = _blank(stock) if path.lathe else None
    if blank is not None:
        left, right, radius = blank
        low, high = np.fmin(low, (0.0, low[1], left)), np.fmax(high, (radius, high[1], right))
    for ring in chucks_of(part.cutting.fixtures) if part and path.lathe else ():
        (z0, _), (z1, r1) = ring.min(axis=0), ring.max(axis=0)
        low, high = np.fmin(low, (0.0, low[1], z0)), np.fmax(high, (r1, high[1], z1))
    return low, high


def draw_blank(ax: Axes, found: Lathe) -> None:
    """The blank below everything else, from the centre line on."""
    if found.blank is None:
        return
    left, right, radius = found.blank
    corners = [(left, 0), (left, radius), (right, radius), (right, 0)]
    ax.add_patch(Polygon(corners, **BAR, zorder=0.6, label="blank"))


def draw_chucks(ax: Axes, rings: Sequence[Array]) -> None:
    """What holds the bar, above the centre line."""
    for ring in rings:
        ax.add_patch(Polygon(ring, **CHUCK, zorder=1.0, label="chuck"))


def draw_insert(ax: Axes, found: Lathe, size: float) -> None:
    """The insert with its tip where it stands; `size` mm is the length of its edges, 0 where nothing has moved."""
    for patch in insert_patches(found.tool, found.tip, size) if found.tip and size > 0 else ():
        ax.add_patch(patch)


def speeds(path: Toolpath, most: float = np.inf) -> tuple[Array, ...]:
    """Way along the motion, mm, spindle speed there, rev/min, and diameter, mm: (k,) each.

    At constant cutting speed it follows X, up to the limit of the program; else it is the programmed one. In no case it
    is above `most`.
    """
    rows = np.flatnonzero(path.is_motion)
    share = np.linspace(0.0, 1.0, PARTS)
    before = np.concatenate([[0.0], np.cumsum(path.lengths[rows])])
    way = before[:-1, None] + path.lengths[rows][:, None] * share
    x = path.start[rows, 0][:, None] + (path.end[rows, 0] - path.start[rows, 0])[:, None] * share
    for k in np.flatnonzero(path.kind[rows] == Kind.ARC):
        row = rows[k]
        arm = path.start[row] - path.centre[row]
        turn = share * path.sweep[row]
        x[k] = path.centre[row, 0] + arm[0] * np.cos(turn) + np.cross(path.axis[row], arm)[0] * np.sin(turn)
    speed = speed_at(path, np.repeat(rows, PARTS), x.ravel())
    return way.ravel(), np.minimum(speed, most), 2 * np.abs(x).ravel()


def speed_at(path: Toolpath, rows: NDArray[np.intp], x: Array) -> Array:
    """The spindle speed, rev/min, where the tip stands at `x` (n,) in `rows` (n,) of a path."""
    surface, told = path.surface[rows], np.abs(path.spindle[rows])
    wanted = spindle_speed(surface, x - path.spindle_x[rows], path.speed_limit[rows])
    return np.where(np.isnan(surface) | (told == 0), told, wanted)


def speed_strokes(path: Toolpath, drawn: Strokes) -> Strokes:
    """Strokes in which those at constant cutting speed are parted so that each has nearly one speed."""
    behind = np.flatnonzero(drawn.row >= 0)
    behind = behind[~np.isnan(path.surface[drawn.row[behind]]) & np.isin(path.kind[drawn.row[behind]], CUTS)]
    change = np.abs(drawn.xyz[behind, 0] - drawn.xyz[behind - 1, 0])
    behind = behind[change > 1e-9]
    share = np.arange(1, PARTS) / PARTS
    start, end = drawn.xyz[behind - 1], drawn.xyz[behind]
    between = start[:, None] + (end - start)[:, None] * share[:, None]
    places = np.repeat(behind, PARTS - 1)
    return Strokes(np.insert(drawn.xyz, places, between.reshape(-1, 3), axis=0),
                   np.insert(drawn.row, places, np.repeat(drawn.row[behind], PARTS - 1)))  # fmt: skip


@sized()
def plot_speed(path: Toolpath, most: float = np.inf, size: tuple[float, float] = (7.0, 4.2)) -> Picture:
    """Spindle speed and, on a lathe, diameter over the way of the tool; `most` is the greatest speed of the spindle, rev/min."""
    unit, (way, speed, diameter) = path.unit, speeds(path, most)
    way, diameter = way / unit.length, diameter / unit.length
    picture = Picture(size, alt="spindle speed over the path")
    shown = np.where(np.isfinite(speed), speed, np.nan)
    across = diameter, f"X (diameter),\n{unit.short}", looks.METAL_EDGE
    curves = [(shown, "spindle,\nrev/min", looks.BLUE), *([across] if path.lathe else [])]
    rows = stacked(picture, [1.0] * len(curves), 0.12)
    for ax, (values, label, shade) in zip(rows, curves):
        ax.plot(way, values, color=shade, linewidth=1.5)
        ax.set_ylabel(label, fontsize=SMALL + 1)
        ax.set(xlim=(0, max(float(way[-1]), 1e-9) if len(way) else 1), ylim=(0, None))
    if np.isfinite(most) and (speed >= most).any():
        above = picture.axes[0]
        above.axhline(most, **{**colours.LIMIT.style(), "label": "_limit"})
        above.annotate("greatest speed", (0.01, most), (0, 2), xycoords=("axes fraction", "data"),
                       textcoords="offset points", fontsize=SMALL, color=colours.LIMIT.colour)  # fmt: skip
        above.set_ylim(0, 1.18 * most)
    ax.set_xlabel(f"path, {unit.short}", fontsize=SMALL + 1)
    return picture


@sized(also=plot_speed)
def plot_speed_of(run: Any, most: float = np.inf, **options: Any) -> Picture:
    """As `plot_speed`, for a run; not above the greatest speed of the machine's limits."""
    return plot_speed(run.toolpath, min(most, run.setup.limits.spindle), **options)


# The insert of a lathe tool in a view of z and r, with the holder behind it; their shapes are in `path.inserts`.
# Both are like glass: what the insert has cut, and the material beside it, is seen through them.

GLASS, CLEAR = 0.5, 0.35  # how much of an insert and of a holder is there
INSERT: dict[str, Any] = {"facecolor": to_rgba(looks.CARBIDE, GLASS), "edgecolor": colours.INK}
HOLDER: dict[str, Any] = {"facecolor": to_rgba(looks.STEEL, CLEAR), "edgecolor": "#7c828a"}
FINE = 0.01  # of the size of an insert: how far a chord of its nose may be off


def insert_patches(tool: Tool, tip: tuple[float, float], size: float, reach: float = 0.0, order: float = 4.4) -> list[Patch]:
    """Holder and insert with the tip at a place (z, r); `order` of drawing: strokes have 2.5 to 3."""
    outline = insert(tool, size, reach).points_within(FINE * size)[:-1]
    return [
        Polygon(holder(tool, size, reach) + tip, **HOLDER, linewidth=0.7, zorder=order),
        Polygon(outline + tip, **INSERT, linewidth=0.9, joinstyle="round", zorder=order + 0.1),
    ]


def named_insert() -> Patch:
    """What a legend shows of it."""
    return Patch(**INSERT, linewidth=0.9, label="insert")
