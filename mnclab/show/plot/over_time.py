"""Pictures over time: feed-rate profiles under one another, material taken away a minute, a hole as it grows peck by peck."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from mnclab.path.listing import MM, Unit, figure
from mnclab.path.profile import Profile
from mnclab.path.toolpath import Kind
from mnclab.show.plot import colours
from mnclab.show.plot.colours import LineStyle
from mnclab.show.plot.picture import SMALL, Picture, calm, clear, figure_of, stacked, write_cut_off, write_legend
from mnclab.show.plot.profile import curve, drawn_pieces, plot_profile, thinned
from mnclab.show.plot.side_by_side import by_name
from mnclab.show.plot.sizes import sized
from mnclab.text.alarm import Alarm
from mnclab.text.given import choice, fitting, shown

# Feed-rate profiles of several machines, limits or programs in one figure.

WIDTH, HIGH = 7.0, 1.75  # inches: of the figure, and of one profile at most
MOST = 8
LOOKS = ("#12304f", "#c26a12")  # dark and pale in turn
RAPID = "#e9c9c5"


@sized()
@fitting
def plot_profiles(profile: Any, *others: Any, names: Sequence[str] = (), over: str = "time", width: float = WIDTH) -> Picture:
    """The feed of several profiles, or runs, under one another: `plot_profiles(run.profile("small-mill"), run)`.

    They may be a list or a dict, too. All begin at 0 and have the same scales; bands stand for rapids. `names` are what they are
    called (default: program and machine), each with its time; `over` "time" (s) or "path"; `width` of the figure in inches.
    Lengths are in inches where all programs are, else in mm.

    >>> run = mnc.run("S800 M3\\nG1 X60 F3600\\n", "mnc")
    >>> mnc.plot_profiles(run.profile(mnc.Limits(acceleration=60)), names=["slow"]).alt
    'feed over time: slow: 2.00 s'
    """
    over = choice(over, "over", ("time", "path"))
    hint = 'plot_profiles(run.profile("small-mill"), run.profile("fast-mill"))'
    profiles = by_name((profile, *others), names, _profile, hint)
    if len(found := list(profiles.values())) > MOST:
        raise Alarm(f"a picture has 1 to {MOST} profiles, got {len(found)}", hint=hint)
    called = [f"{name}: {each.time:.2f} s" for name, each in profiles.items()]
    height = min(HIGH, 0.5 * width) * len(found) + 0.75
    picture = Picture((width, height), f"feed over {over}: {'; '.join(called)}")
    rows = stacked(picture, [1.0] * len(found), 0.27, left=0.72, ticks=4, one_scale=True)
    units = {each.path.unit for each in found}
    unit = units.pop() if len(units) == 1 else MM
    drawn = [_draw(ax, each, over, LOOKS[k % 2], unit) for k, (ax, each) in enumerate(zip(rows, found))]
    top = 1.3 * max(most for _, most in drawn) or 1.0
    rows[0].set(xlim=(0, max(*(end for end, _ in drawn), 1e-9)), ylim=(0, top))
    for ax, name in zip(rows, called):
        ax.text(0.005, 0.96, name, transform=ax.transAxes, va="top", fontsize=SMALL, parse_math=False,
                bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.5, "alpha": 0.85})  # fmt: skip
    rows[-1].set_xlabel("time, s" if over == "time" else f"path, {unit.short}", fontsize=SMALL + 1)
    said = f"feed, {unit.short}/min"
    picture.text(0.16 / width, 0.5 + (0.5 - 0.27) / 2 / height, said, rotation=90, va="center", ha="center", fontsize=SMALL + 1)
    notes = max((thinned(drawn_pieces(each, over)) for each in found), key=len)
    write_legend(picture, [Line2D([], [], color=LOOKS[0], label="feed"), Patch(facecolor=RAPID, label="rapid"), *notes])
    return picture


def _draw(ax: Axes, profile: Profile, over: str, shade: str, unit: Unit) -> tuple[float, float]:
    """The feed of one profile and its rapids as bands; returns where it ends and its greatest feed."""
    drawn = curve(profile, over, drawn_pieces(profile, over)).counted(unit.length)
    x, v = (drawn.t if over == "time" else drawn.s), drawn.v * 60
    if not len(x):
        return 0.0, 0.0
    rapid = profile.path.kind[profile.move[drawn.piece]] == Kind.RAPID
    feed = np.where(rapid, np.nan, v)
    ax.fill_between(x, 0, 1, where=rapid, transform=ax.get_xaxis_transform(), color=RAPID, linewidth=0.6, zorder=1)
    ax.fill_between(x, feed, color=shade, alpha=0.18, linewidth=0, zorder=2)
    ax.plot(x, feed, color=shade, linewidth=1.3, zorder=3)
    return float(x[-1]), float(np.nanmax(feed, initial=0.0))


def _profile(given: Any) -> tuple[str, Profile]:
    found = given if isinstance(given, Profile) else given.profile() if hasattr(given, "toolpath") else None
    if found is None:
        raise Alarm(f"a profile is that of a run, got {shown(given)}", hint='run.profile("small-mill")')
    return found.name or "path", found


# Removal over time as a picture: the feed, and under it how much material is taken away a minute.

SIZE = (7.0, 4.6)  # inches
SHADE = 0.28  # of the area under the rate
FAST = 2.5  # times the largest rate at feed, beyond which what rapids take away is cut off


@sized()
def plot_removal(removal: Any, *, size: tuple[float, float] = SIZE) -> Figure:
    """Feed (in the unit of the program) and removal rate (mm³/min or in³/min, the mean of each row) over time (s), the
    largest at feed marked with its line.

    `size`: width and height in inches.
    """
    most = removal.largest
    unit, rates = removal.workpiece.cutting.path.unit, removal.rate
    size_of, name, form = (1.0, "mm³", ".0f") if unit.length == 1 else (unit.length**3, "in³", ".3g")
    largest = f"{removal.at_most} {most.rate / size_of:{form}} {name}/min" if most else ""
    said = f"removal: {removal.volume / size_of:{'.1f' if name == 'mm³' else form}} {name} in {removal.profile.time:.4g} s"
    picture = Picture(size, f"{said}, {largest} in line {removal.place(most)}" if most else said)
    feed, rate = stacked(picture, (1.0, 1.0), 0.12, left=1.0)
    plot_profile(removal.profile, feed, limits=False)
    begin, end = removal.profile.starts[:-1][: len(rates)], removal.profile.starts[1:][: len(rates)]
    t, height_of = np.stack([begin, end], axis=1).ravel(), np.repeat(rates / size_of, 2)
    rate.fill_between(t, height_of, color=colours.REACHED.colour, alpha=SHADE, linewidth=0)
    rate.plot(t, height_of, color=colours.REACHED.colour, linewidth=1.2)
    high = most.rate / size_of if most else 0.0
    top = 1.25 * max(float(rates.max(initial=0.0)) / size_of, high) or 1.0
    rate.set_ylim(0, top)
    if most and top > FAST * high:  # a rapid in material takes away in no time
        rate.set_ylim(0, clear(rate, 1.1 * high))
        write_cut_off(rate, f"rapids reach {rates.max() / size_of:{form}} {name}/min")
    if most:
        middle = (begin[most.row] + end[most.row]) / 2
        rate.plot([middle], [high], **colours.SLOW_CORNER.style())
        said, wide = f"line {removal.place(most)}: {largest}", rate.get_window_extent().width * 72 / picture.dpi
        half, at = LETTER * len(said) / 2, middle / removal.profile.time * wide
        aside = max(half, min(at, wide - half)) - at  # not beyond the border
        rate.annotate(
            said, (middle, high), (aside, 5), textcoords="offset points", fontsize=SMALL, ha="center", color=colours.INK
        )
    feed.set(xlabel="", ylabel=feed.get_ylabel().replace(", ", ",\n"))
    rate.set_ylabel(f"mean of a row,\n{name}/min", fontsize=feed.yaxis.label.get_fontsize())
    rate.set_xlabel("time, s", fontsize=SMALL + 1)
    picture.align_ylabels([feed, rate])
    return picture


# Depth over time: how a hole grows peck by peck, where the drill comes out, where it waits.

POINTS = 24  # of a row, along which the speed changes
WAITS = LineStyle("dwell", colours.DWELL.colour, "-", 3.2, 3.1)
OF_KIND = {Kind.RAPID: colours.RAPID, Kind.LINE: colours.FEED, Kind.ARC: colours.FEED, Kind.DWELL: WAITS}
MOST_ROWS, LABELLED = 5000, 24  # rows, and depths that are written
LETTER, LINE_HIGH = 0.62 * SMALL, 1.3 * SMALL  # points: a figure of a depth, and its line
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
    if len(rows) > MOST_ROWS:
        raise Alarm(f"{len(rows)} rows are too many for a picture of depths", hint="run.plot_depth(line=5)")
    unit, begin = path.unit, profile.starts[rows[0]]
    picture = None
    if ax is None:
        deepest = unit.figure(path.end[rows, 2].min(), 1)
        said = f"depth over time: {figure(profile.starts[rows[-1] + 1] - begin, 2)} s, down to Z {deepest} {unit.short}"
        picture = Picture(size, said)
        (ax,) = stacked(picture, [1.0], 0.4)
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
        top = high
        low, high = float(ends.min()), float(ends.max())
        low, high = low - 0.1 * (high - low), high + 0.5 * (high - low)
        write_cut_off(ax, f"rapids go up to Z{figure(top)}")
    room = max(high - low, 1e-6)
    ax.set(xlim=(-0.01 * total, 1.01 * total), ylim=(low - 0.16 * room, high + 0.06 * room))
    if run.stock is not None and not path.lathe:
        ax.axhline(float(run.stock.bounds[1, 2]) / unit.length, **{**colours.BLANK.style(), "label": "_top of the blank"})
    ax.set_xlabel("time, s", fontsize=SMALL + 1)
    ax.set_ylabel(f"Z, {unit.short}", fontsize=SMALL + 1)
    calm(ax)
    _depths(ax, path, rows, profile.starts - begin)
    if picture is None:
        return figure_of(ax)
    write_legend(picture, handles)
    return picture


def _depths(ax: Axes, path: Any, rows: Any, starts: Any) -> None:
    """The depth at the end of each way down at feed that the tool leaves again."""
    down = rows[(path.kind[rows] == Kind.LINE) & (path.end[rows, 2] < path.start[rows, 2])]
    turning = down[~np.isin(down + 1, down)].tolist()
    wide, high = np.array(ax.get_window_extent().size) * 72 / figure_of(ax).dpi
    (left, right), (low, top) = ax.get_xlim(), ax.get_ylim()
    taken: list[tuple[float, float, float]] = []  # points: left, right and top of what is written
    for row in turning if len(turning) <= LABELLED else ():
        at, depth = float(starts[row + 1]), float(path.end[row, 2])
        text = path.unit.figure(depth, 1).replace("-", "\N{MINUS SIGN}")
        half = LETTER * len(text) / 2
        x, y = (at - left) / (right - left) * wide, (depth / path.unit.length - low) / (top - low) * high
        aside = min(0.0, wide - 2 - half - x)  # not beyond the border
        box = x + aside - half, x + aside + half, y
        if all(box[1] < a or box[0] > b or abs(y - each) > LINE_HIGH for a, b, each in taken):
            taken.append(box)
            ax.annotate(
                text, (at, depth / path.unit.length), (aside, -4), textcoords="offset points", ha="center", va="top",
                fontsize=SMALL, zorder=4, parse_math=False,
                bbox={"boxstyle": "square,pad=0.05", "fc": colours.PAPER, "ec": "none", "alpha": 0.8},
            )  # fmt: skip
