"""Depth over time: how a hole grows peck by peck, where the drill comes out, where it waits."""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from mnclab.path.listing import figure
from mnclab.path.toolpath import Kind
from mnclab.show.plot import colours
from mnclab.show.plot.colours import Line
from mnclab.show.plot.picture import SMALL, Picture, calm, write_legend
from mnclab.show.plot.sizes import sized
from mnclab.text.alarm import Alarm

POINTS = 24  # of a row, along which the speed changes
WAITS = Line("dwell", colours.DWELL.colour, "-", 3.2, 3.1)
OF_KIND = {Kind.RAPID: colours.RAPID, Kind.LINE: colours.FEED, Kind.ARC: colours.FEED, Kind.DWELL: WAITS}
MOST, LABELLED = 5000, 24  # rows, and depths that are written
LETTER, HIGH = 0.62 * SMALL, 1.3 * SMALL  # points: a figure of a depth, and its line
FAR = 5.0  # times the height of what is cut: rapids from beyond are cut off


@sized()
def plot_depth(
    run: Any, ax: Axes | None = None, *, line: int | None = None, pass_: int = 1, size: tuple[float, float] = (7.0, 3.6)
) -> Figure:
    """Z of the tip over time: feeds solid, rapids dashed, dwells thick; the depth of each peck beside its lowest point.

    `line` shows what one block does (its `pass_`-th execution), None the whole program. Times are those of `run.profile()`.
    An Alarm where nothing moves, or too much for a picture.
    """
    path, profile = run.toolpath, run.profile()
    rows = np.arange(len(path)) if line is None else np.arange(len(path))[run.at(line, pass_).rows]
    rows = rows[np.isin(path.kind[rows], list(OF_KIND))]
    if not len(rows) or not path.is_motion[rows].any():
        raise Alarm(f"line {line} moves nothing" if line is not None else "nothing moves")
    if len(rows) > MOST:
        raise Alarm(f"{len(rows)} rows are too many for a picture of depths", hint="run.plot_depth(line=5)")
    unit, begin = path.unit, profile.starts[rows[0]]
    picture = None
    if ax is None:
        deepest = unit.figure(path.end[rows, 2].min(), 1)
        said = f"depth over time: {figure(profile.starts[rows[-1] + 1] - begin, 2)} s, down to Z {deepest} {unit.short}"
        picture = Picture(size, said)
        ax = picture.add_axes((0.72 / size[0], 0.5 / size[1], 1 - 0.9 / size[0], 1 - 0.9 / size[1]))
    drawn: dict[str, list[Any]] = {}
    for row in rows.tolist():
        times = np.linspace(profile.starts[row], profile.starts[row + 1], POINTS)
        inside = np.clip(times, times[0] + 1e-9 * np.ptp(times), times[-1] - 1e-9 * np.ptp(times))
        heights = profile.at(inside).position[:, 2] if path.is_motion[row] else np.full(POINTS, path.end[row, 2])
        if path.is_motion[row]:  # the ends are exact
            heights[[0, -1]] = path.start[row, 2], path.end[row, 2]
        drawn.setdefault(OF_KIND[Kind(path.kind[row])].name, []).append(
            np.column_stack([[*(times - begin), np.nan], [*heights / unit.length, np.nan]])
        )
    looks = {look.name: look for look in OF_KIND.values() if look.name in drawn}
    handles = [ax.add_line(Line2D(*np.concatenate(drawn[name]).T, **look.style())) for name, look in looks.items()]
    total = max(float(profile.starts[rows[-1] + 1] - begin), 1e-9)
    low, high = (float(f(path.end[rows, 2])) / unit.length for f in (np.min, np.max))
    low, high = min(low, float(path.start[rows[0], 2]) / unit.length), max(high, float(path.start[rows[0], 2]) / unit.length)
    cut = rows[path.kind[rows] != Kind.RAPID]
    ends = np.concatenate([path.start[cut, 2], path.end[cut, 2]]) / unit.length
    if len(cut) and high - low > FAR * np.ptp(ends) > 0:
        low, high = float(ends.min()), float(ends.max())
        low, high = low - 0.1 * (high - low), high + 0.5 * (high - low)
        look: dict[str, Any] = {"ha": "right", "va": "top", "fontsize": SMALL - 1, "color": colours.RAPID.colour, "zorder": 5}
        ax.text(0.995, 0.98, "rapids from far away are cut off", transform=ax.transAxes, **look)
    room = max(high - low, 1e-6)
    ax.set(xlim=(-0.01 * total, 1.01 * total), ylim=(low - 0.16 * room, high + 0.06 * room))
    if run.stock is not None and not path.lathe:
        ax.axhline(float(run.stock.bounds[1, 2]) / unit.length, **{**colours.BLANK.style(), "label": "_top of the blank"})
    ax.set_xlabel("time, s", fontsize=SMALL + 1)
    ax.set_ylabel(f"Z, {unit.short}", fontsize=SMALL + 1)
    calm(ax)
    if picture is not None and (box := ax.get_tightbbox()) is not None:  # long numbers stand beside the axis
        left = (0.72 - min(0.0, box.x0 / picture.dpi - 0.04)) / size[0]
        ax.set_position((left, 0.5 / size[1], 1 - 0.18 / size[0] - left, 1 - 0.9 / size[1]))
    _depths(ax, path, rows, profile.starts - begin)
    if picture is None:
        return cast(Figure, ax.get_figure(root=True))
    write_legend(picture, handles)
    return picture


def _depths(ax: Axes, path: Any, rows: Any, starts: Any) -> None:
    """The depth at the end of each way down at feed that the tool leaves again."""
    down = rows[(path.kind[rows] == Kind.LINE) & (path.end[rows, 2] < path.start[rows, 2])]
    turning = down[~np.isin(down + 1, down)].tolist()
    wide, high = np.array(ax.get_window_extent().size) * 72 / cast(Figure, ax.get_figure(root=True)).dpi
    (left, right), (low, top) = ax.get_xlim(), ax.get_ylim()
    taken: list[tuple[float, float, float]] = []  # points: left, right and top of what is written
    for row in turning if len(turning) <= LABELLED else ():
        at, depth = float(starts[row + 1]), float(path.end[row, 2])
        text = path.unit.figure(depth, 1).replace("-", "\N{MINUS SIGN}")
        half = LETTER * len(text) / 2
        x, y = (at - left) / (right - left) * wide, (depth / path.unit.length - low) / (top - low) * high
        aside = min(0.0, wide - 2 - half - x)  # not beyond the border
        box = x + aside - half, x + aside + half, y
        if all(box[1] < a or box[0] > b or abs(y - each) > HIGH for a, b, each in taken):
            taken.append(box)
            ax.annotate(
                text, (at, depth / path.unit.length), (aside, -4), textcoords="offset points", ha="center", va="top",
                fontsize=SMALL, zorder=4, parse_math=False,
                bbox={"boxstyle": "square,pad=0.05", "fc": colours.PAPER, "ec": "none", "alpha": 0.8},
            )  # fmt: skip
