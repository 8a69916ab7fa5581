"""The tool path seen from above and from the front; on a lathe Z to the right and the diameter X up.

Each class of moves is *one* line, broken by nan where the class changes, so that a million moves cost about what one
line of a million points costs. Arcs are cut finely enough for the size of the picture.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from mnclab.path.kinds import Kind
from mnclab.path.toolpath import Toolpath
from mnclab.show.plot import colours
from mnclab.show.plot.colours import Line, Mark
from mnclab.show.plot.picture import SIZE, VIEWS, Foot, Picture, View, arrange, dress, roomy, write_legend
from mnclab.text.alarm import ALARM, Alarm

LINES = {Kind.RAPID: colours.RAPID, Kind.LINE: colours.FEED, Kind.ARC: colours.FEED, Kind.PROBE: colours.PROBING}
MARKS = {Kind.DWELL: colours.DWELL, Kind.TOOL: colours.TOOL, Kind.STOP: colours.STOP}
FINENESS = 10_000  # chord errors in the length of a path's box: about ten in a pixel
FAR = 5  # a box of all moves this many times that of the cuts is not shown whole

Array = NDArray[np.float64]


def plot_path(
    path: Toolpath,
    ax: Axes | None = None,
    view: str = "auto",
    *,
    frame: str = "auto",
    size: tuple[float, float] = SIZE,
    programmed: Toolpath | None = None,
    alarms: Sequence[Alarm] = (),
) -> Figure:
    """Views of a path: rapids dashed red, cuts blue; start and end marked. Returns the figure, which Jupyter shows.

    ``view``: "XY" from above, "XZ" or "YZ" from the side, "ZX" of a lathe; "auto" takes what the path needs. With
    ``ax`` one view is drawn into it. ``frame``: "all" shows every move, "cuts" the moves at feed and cuts rapids off at
    the border, "auto" does so when the rapids come from far away. ``size``: the greatest width and height in inches, at
    100 pixels an inch. ``programmed`` is the contour before compensation, drawn thin and grey where it differs. The
    first of ``alarms`` that stopped the program is marked where the tool stands and named below.
    """
    stop = next((alarm for alarm in alarms if alarm.severity == ALARM), None)
    pieces = _lines(path, programmed)
    low, high, beyond = _box(path, pieces, frame)
    views = _views(view, path, low, high, single=ax is not None)
    places = _places(path, stop is not None)
    if ax is not None:
        _draw(ax, views[0], path, pieces, places)
        dress(ax, views[0])
        if beyond:
            low, high = roomy(low, high)
            right, up = views[0][:2]
            ax.set(xlim=(low[right], high[right]), ylim=(low[up], high[up]))
        else:
            ax.autoscale_view()
        figure: Any = ax.get_figure(root=True)
        return figure
    names = [line.name for line, _ in pieces] + [mark.name for mark, _ in places]
    if any(len(_plunges(path, each)) for each in views):
        names.append(colours.PLUNGE.name)
    picture, axes = arrange(views, low, high, names, _foot(stop, beyond), _in_words(path, low, high, stop), size)
    artists: dict[str, Line2D] = {}
    for one, which in zip(axes, views):
        for artist in _draw(one, which, path, pieces, places):
            artists.setdefault(str(artist.get_label()), artist)
    if not names:
        axes[0].text(0.5, 0.5, "no moves", transform=axes[0].transAxes, ha="center", color=colours.PROGRAMMED.colour)
    write_legend(picture, list(artists.values()))
    return picture


def plot_run(run: Any, ax: Axes | None = None, view: str = "auto", **options: Any) -> Figure:
    """Views of the path of a run (see :func:`plot_path`), with its programmed contour and the place of its alarm."""
    programmed = None if run.programmed is run.toolpath else run.programmed
    return plot_path(run.toolpath, ax, view, **options, programmed=programmed, alarms=run.alarms)


def image(run: Any, view: str = "auto", size: tuple[float, float] = (6.4, 4.4)) -> str:
    """The views of a run as an HTML image with a name, for those who show pictures but do not draw."""
    picture = plot_run(run, view=view, size=size)
    assert isinstance(picture, Picture)
    return picture.html()


# --- what is drawn ---------------------------------------------------------------------------------------------------


def _lines(path: Toolpath, programmed: Toolpath | None) -> list[tuple[Line, Array]]:
    """For each class of moves its points (m, 3), nan between runs of moves."""
    found = _by_class(path, LINES)
    if programmed is not None:
        found = _by_class(programmed, {Kind.LINE: colours.PROGRAMMED, Kind.ARC: colours.PROGRAMMED}) + found
    return found


def _by_class(path: Toolpath, classes: Mapping[Kind, Line]) -> list[tuple[Line, Array]]:
    rows = np.flatnonzero(path.is_motion)
    if not len(rows):
        return []
    xyz, move = path.points(_size(path, rows) / FINENESS)
    lines = list(dict.fromkeys(classes.values()))
    number = np.full(max(Kind) + 1, -1)
    for kind, line in classes.items():
        number[kind] = lines.index(line)
    group = number[path.kind[move]]  # of the stroke that ends at each point
    jumps = rows[1:][(path.start[rows[1:]] != path.end[rows[:-1]]).any(axis=1)]
    if len(jumps):  # between them stands a tool change, or what was left out: the move begins elsewhere
        at = np.searchsorted(move, jumps)
        xyz, group = np.insert(xyz, at, path.start[jumps], axis=0), np.insert(group, at, -1)
    group[0] = -1
    found = [(line, _strokes(xyz, np.flatnonzero(group == k))) for k, line in enumerate(lines)]
    return [(line, points) for line, points in found if len(points)]


def _strokes(xyz: Array, ends: NDArray[np.intp]) -> Array:
    """The strokes to some of the points, each from the point before it, as one line broken by nan (m, 3)."""
    breaks = np.flatnonzero(np.diff(ends, prepend=-1) != 1)  # where a stroke does not go on from the last
    before = np.stack([np.full(len(breaks), -1), ends[breaks] - 1], axis=1)  # nan, and where the stroke begins
    order = np.insert(ends, np.repeat(breaks, 2), before.ravel())
    broken = xyz[order]
    broken[order < 0] = np.nan
    return broken[1:]


def _size(path: Toolpath, rows: NDArray[np.intp]) -> float:
    """The greatest side of a box around some rows, mm, not less than 1 µm."""
    low, high = _extremes(path.end[rows])
    begin = path.start[rows[0]]
    size = float((np.maximum(high, begin) - np.minimum(low, begin)).max())
    arc = path.kind == Kind.ARC
    if arc.any():
        radius = np.linalg.norm(path.start[arc] - path.centre[arc], axis=1)
        size += float((np.minimum(2.0, np.abs(path.sweep[arc])) * radius).max())
    return max(size, 1e-3)


def _extremes(xyz: Array) -> tuple[Array, Array]:
    """Least and greatest coordinates (3,) of points (m, 3), passing over nan; column by column, which is quicker."""
    low = np.array([np.fmin.reduce(column) for column in xyz.T])
    return low, np.array([np.fmax.reduce(column) for column in xyz.T])


def _places(path: Toolpath, stopped: bool) -> list[tuple[Mark, Array]]:
    """Marks and where they stand (m, 3)."""
    found = []
    for kind, mark in MARKS.items():
        rows = path.kind == kind
        if rows.any():
            found.append((mark, path.end[rows]))
    if len(path):
        found.append((colours.START, path.start[:1]))
        found.append((colours.ALARM if stopped else colours.END, path.end[-1:]))
    return found


def _plunges(path: Toolpath, view: View) -> Array:
    """Where cuts run along the tool and the line of sight, and would be invisible (m, 2)."""
    rows = path.kind == Kind.LINE
    for k in (view.right, view.up):
        rows &= (np.abs(path.axis[:, k]) < 1e-9) & (path.start[:, k] == path.end[:, k])
    return np.unique(path.end[rows][:, [view.right, view.up]], axis=0)


def _box(path: Toolpath, pieces: Sequence[tuple[Line, Array]], frame: str) -> tuple[Array, Array, bool]:
    """The corners (3,) of the box that is shown, and whether rapids go beyond it; a lathe's holds the centre line."""
    if frame not in ("auto", "all", "cuts"):
        raise ValueError(f"frame must be auto, all or cuts, got {frame!r}")
    everything = _corners([*(points for _, points in pieces), path.start[:1], path.end[-1:]], path.lathe)
    cuts = _corners([points for line, points in pieces if line is not colours.RAPID], path.lathe)
    if everything is None:
        return np.zeros(3), np.zeros(3), False
    if cuts is None or frame == "all":
        return *everything, False
    spans = [float((high - low).max()) for low, high in (everything, cuts)]
    if frame == "cuts" or spans[0] > FAR * spans[1] > 0:
        return *cuts, spans[0] > spans[1]
    return *everything, False


def _corners(clouds: Sequence[Array], centre_line: bool) -> tuple[Array, Array] | None:
    """Least and greatest coordinates (3,) of some points; None if there are none."""
    found = [_extremes(points) for points in clouds if len(points)]
    if not found:
        return None
    low, high = np.min([each[0] for each in found], axis=0), np.max([each[1] for each in found], axis=0)
    if centre_line:
        low[0], high[0] = min(low[0], 0.0), max(high[0], 0.0)
    return low, high


def _foot(stop: Alarm | None, beyond: bool) -> Foot | None:
    if stop:
        return Foot(f"line {stop.span.line}: {stop.message}" if stop.span else stop.message, colours.ALARM.colour)
    return Foot('rapids from far away are cut off; frame="all" shows them') if beyond else None


def _views(view: str, path: Toolpath, low: Array, high: Array, single: bool) -> list[View]:
    if view != "auto":
        if view.upper() not in VIEWS:
            raise ValueError(f"view must be auto or one of {', '.join(VIEWS)}, got {view!r}")
        return [VIEWS[view.upper()]]
    if path.lathe:
        return [VIEWS["ZX"]]
    span = high - low
    if single or not span[2] > 0:
        return [VIEWS["XY"]]
    return [VIEWS["XY"], VIEWS["YZ"] if span[0] == 0 and span[1] > 0 else VIEWS["XZ"]]


def _draw(
    ax: Axes,
    view: View,
    path: Toolpath,
    pieces: Sequence[tuple[Line, Array]],
    places: Sequence[tuple[Mark, Array]],
) -> list[Line2D]:
    """Add lines and marks to an axes; returns those that a legend names."""
    artists = [Line2D(xyz[:, view.right], xyz[:, view.up], **line.style()) for line, xyz in pieces]
    plunges = _plunges(path, view)
    if len(plunges):
        artists.append(Line2D(plunges[:, 0], plunges[:, 1], **colours.PLUNGE.style()))
    artists += [Line2D(xyz[:, view.right], xyz[:, view.up], **mark.style()) for mark, xyz in places]
    for artist in artists:
        ax.add_line(artist)
    if view.diameter:
        ax.axhline(0.0, **{**colours.CENTRE_LINE.style(), "label": "_centre line"})
    return artists


def _in_words(path: Toolpath, low: Array, high: Array, stop: Alarm | None) -> str:
    """What a person who cannot see the picture is told."""
    moves = int(path.is_motion.sum())
    if not moves:
        said = "no moves"
    else:
        shown = [(axis, 2 if path.lathe and axis == "X" else 1) for axis in "XYZ"]
        ranges = [f"{axis} {f * a:.4g} to {f * b:.4g}" for (axis, f), a, b in zip(shown, low, high) if b > a]
        said = f"{moves} moves" if moves > 1 else "1 move"
        said += f", {', '.join(ranges)} mm" if ranges else ""
    return f"tool path: {said}{f'; stopped in line {stop.span.line}' if stop and stop.span else ''}"
