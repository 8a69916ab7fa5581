"""The tool path seen from above and from the front; on a lathe Z to the right and the diameter X up.

Each class of moves is *one* line, broken by nan (see `strokes`), so that a million moves cost what a million points cost.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from mnclab.path.kinds import Kind
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Toolpath
from mnclab.show.felt import Felt
from mnclab.show.felt import felt as felt_of
from mnclab.show.plot import arrows as heads
from mnclab.show.plot import colours
from mnclab.show.plot.classes import Classes, classes
from mnclab.show.plot.classes import lines as lines_of
from mnclab.show.plot.colours import Line, Mark
from mnclab.show.plot.datums import Place, crosses, near, places_of, write_names
from mnclab.show.plot.felt import draw_felt, names_of
from mnclab.show.plot.lathe import (
    FINISHED,
    Lathe,
    draw_blank,
    draw_chucks,
    draw_insert,
    lathe,
    speed_strokes,
    with_blank,
)
from mnclab.show.plot.picture import SCALE, SIZE, VIEWS, Foot, View, arrange, dress, roomy, write_legend
from mnclab.show.plot.scale import write_scale
from mnclab.show.plot.strokes import Array, Strokes, corners, line_of, strokes
from mnclab.show.plot.under import draw_under
from mnclab.text.alarm import ALARM, Alarm, several
from mnclab.text.given import choice
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.workpiece import Workpiece

MARKS = {Kind.DWELL: colours.DWELL, Kind.TOOL: colours.TOOL, Kind.STOP: colours.STOP}
UNSCALED = (colours.PROGRAMMED, colours.RAPID, colours.PROBING)  # look the same whatever the colour shows
PART = "part"
INSERT = 0.09  # edges of an insert, of the greatest side of the picture
MOST = 2000  # rows of a lathe's path whose part is shown unasked
MOSTLY = 0.9  # the cosine between two directions from which on they are taken for the same
FAR = 5  # a box of all moves this many times that of the cuts is not shown whole


class Drawing(NamedTuple):
    """What is drawn of a path in every view: lines (m, 3) broken by nan, marks (m, 3), crosses with names."""

    strokes: Strokes
    classes: Classes
    lines: list[tuple[Line, Array]]
    marks: list[tuple[Mark, Array]]
    places: list[Place]
    plunges: dict[View, Array]
    plunge: Mark
    arrows: bool
    stock: Blank | None
    lathe: Lathe | None
    part: Workpiece | None
    home: bool
    felt: Felt | None


def plot_path(
    path: Toolpath,
    ax: Axes | None = None,
    view: str = "auto",
    *,
    colour: str = "kind",
    arrows: bool = True,
    marks: bool = True,
    frame: str = "auto",
    size: tuple[float, float] = SIZE,
    programmed: Toolpath | None = None,
    alarms: Sequence[Alarm] = (),
    places: Sequence[Place] = (),
    stock: Blank | None = None,
    tools: Mapping[int, Tool] = MappingProxyType({}),
    insert: bool | int = True,
    part: Workpiece | None = None,
    home: bool = False,
    felt: Felt | None = None,
) -> Figure:
    """Views of a path: rapids dashed red, cuts solid; start and end marked. Returns the figure, which Jupyter shows.

    Its data are mm; what is written counts in the unit of the program, mm or inches.

    - `ax`: draw one view into these axes of one's own, without legend and scale.
    - `view`: "XY" from above, "XZ" or "YZ" from the side, "ZX" of a lathe; "auto" takes what the path needs: the plane
      that it works in, how deep it goes, and each plane that has arcs.
    - `colour`: what the colour of the cuts shows: "kind" (all blue), "feed" (a minute), "speed" (of the spindle, rev/min;
      it follows X at constant cutting speed), "tool" (its number), "line" (of the source) or "z" (lower end of each
      stroke). Few values are named in the legend, many are put into at most 14 steps of a scale, dark to light.
      Rapids and probing look the same in all of them.
    - `arrows`: arrowheads on a few long moves; none on a path of more than 300 moves.
    - `marks`: crosses at zero points that the program selects and at poles, with their names, unless far from the
      path; only `plot_run` knows them.
    - `frame`: "all" shows every move, "cuts" the moves at feed and cuts rapids off at the border, "auto" does so when
      the rapids come from far away.
    - `size`: the greatest width and height in inches, at 100 pixels an inch.
    - `programmed`: the contour before compensation, drawn thin and grey where it differs.
    - `alarms`: the first that stopped the program is marked where the tool stands and named below.
    - `places`: the crosses (see `show.plot.datums.places_of`).
    - `stock`: a blank in the coordinates of the path: its outline, thin.
    - `tools`, `insert`: on a lathe the tool table, and after which row the insert is drawn: True for the last one,
      False for none.
    - `part`: what is left of the blank, drawn under the path.
    - `home`: the path begins where the tool arrives from home.
    - `felt`: what a probe meets, drawn behind the path (see `show.felt`).
    """
    stop = next((alarm for alarm in alarms if alarm.severity == ALARM), None)
    drawn = strokes(path)
    if colour == "speed" and len(drawn.row):
        drawn = speed_strokes(path, drawn)
    found = classes(path, drawn, colour)
    lines = lines_of(drawn, found)
    if programmed is not None and len(contour := line_of(programmed, (Kind.LINE, Kind.ARC))):
        lines.insert(0, (colours.PROGRAMMED, contour))
    low, high, beyond = _box(path, lines, frame)
    shown = near(places, low, high) if marks else []
    for place in shown:
        low, high = np.fmin(low, place.xyz), np.fmax(high, place.xyz)
    low, high = with_blank(path, stock, low, high, part)
    if path.lathe and len(path) and insert is not False and not beyond:
        room = 2.8 * INSERT * float((high - low).max())
        high = np.fmax(high, path.end[-1] + (room, 0.0, room))
    if felt is not None and frame != "cuts":
        low, high = felt.box(low, high)
    views = _views(view, path, low, high, single=ax is not None)
    if stock is not None and not path.lathe and frame != "cuts":
        low, high = np.fmin(low, stock.bounds[0]), np.fmax(high, stock.bounds[1])
    plunge = colours.PLUNGE if colour == "kind" else colours.PLUNGE._replace(colour=colours.INK)
    plunges = {each: _plunges(path, each) for each in views}
    arrows = arrows and int(path.is_motion.sum()) <= heads.MANY
    beside = lathe(path, stock, tools, insert, part) if path.lathe and views[0].diameter else None
    found_marks, outline = _marks(path, stop is not None, home), None if beside else stock
    if felt is not None and len(felt.places):
        found_marks.append((colours.TOUCH, felt.places))
    drawing = Drawing(drawn, found, lines, found_marks, shown, plunges, plunge, arrows, outline, beside, part, home, felt)
    if ax is not None:
        _draw(ax, views[0], drawing)
        dress(ax, views[0])
        if beyond:
            wide = roomy(low, high)
            right, up = views[0][:2]
            ax.set(xlim=(wide[0][right], wide[1][right]), ylim=(wide[0][up], wide[1][up]))
        else:
            ax.autoscale_view()
        ax.apply_aspect()
        _write(ax, views[0], drawing, low, high)
        return cast(Figure, ax.get_figure(root=True))
    names = [line.name for line, _ in lines if not found.scale or line in UNSCALED]
    names += [colours.BLANK.name] if drawing.stock is not None else []
    names += [mark.name for mark, _ in drawing.marks]
    if any(map(len, drawing.plunges.values())):
        names.append(colours.PLUNGE.name)
    if any(line.get_label() == colours.POLE.name for each in views for line in crosses(shown, each)):
        names.append(colours.POLE.name)
    held = beside.names + ([Patch(**FINISHED, label=PART)] if part is not None else []) if beside else []
    held += names_of(felt) if felt is not None else []
    names += [str(each.get_label()) for each in held]
    said = _in_words(path, low, high, stop)
    picture, axes = arrange(views, low, high, names, _foot(stop, beyond), said, size, found.scale is not None)
    artists: dict[str, Any] = {str(each.get_label()): each for each in held}
    for one, which in zip(axes, views):
        for artist in _draw(one, which, drawing):
            artists.setdefault(str(artist.get_label()), artist)
        _write(one, which, drawing, low, high)
    if not names:
        axes[0].text(0.5, 0.5, "no moves", transform=axes[0].transAxes, ha="center", color=colours.PROGRAMMED.colour)
    if found.scale:
        write_scale(picture, found.scale)
    write_legend(picture, [artists[name] for name in names], SCALE if found.scale else 0.0)
    return picture


def plot_run(
    run: Any, ax: Axes | None = None, view: str = "auto",
    *, marks: bool = True, stock: bool = True, part: bool = False, probed: bool = True, **options: Any,
) -> Figure:  # fmt: skip
    """Views of the path of a run, with its programmed contour, blank, zero points, poles and the place of its alarm.

    The options are those of `plot_path`; `stock=False` leaves out the blank of the setup or the program, `part=True`
    draws what the run leaves of it, as a lathe's picture does unless its path is long; `probed=False` leaves out the part
    that a probe meets, a section at the height of its touches, and their numbers. `view="unrolled"` shows what lies on a
    cylinder on its developed surface (`show.plot.unrolled`; of the options it takes `size`), and so does "auto" without other
    options where every cut lies on one. Beside a blank the first approach
    comes from home, unless the setup says from where.
    """
    cuts = (run.toolpath.kind == Kind.LINE) | (run.toolpath.kind == Kind.ARC)
    rolled = view == "auto" and options.keys() <= {"size"} and bool(cuts.any() and (run.toolpath.cylinder[cuts] >= 0).all())
    if view == "unrolled" or rolled:
        from mnclab.show.plot.unrolled import plot_unrolled

        return plot_unrolled(run.toolpath, ax, **options)
    given = {"programmed": None if run.programmed is run.toolpath else run.programmed, "alarms": run.alarms}
    given["stock"] = run.stock if stock else None
    path, insert = run.toolpath, options.get("insert", True)
    if path.lathe:
        given["tools"], numbers = run.tools_that_cut
        row = len(path) - 1 if isinstance(insert, bool) else insert
        if isinstance(row, int) and -len(path) <= row < len(path) and not path.tool[row]:
            given["tools"] |= {0: given["tools"].get(int(numbers[row]), Tool())}
    if marks:
        given["places"] = places_of(run)
    if part or (run.toolpath.lathe and stock and run.stock and len(run.toolpath) <= MOST):
        given["part"] = run.workpiece()
    if probed and "felt" not in options:
        given["felt"] = felt_of(run)
    if first := run.rows_from_home:
        path, given["home"] = path[first:], True
        if isinstance(insert, int) and not isinstance(insert, bool) and insert >= 0:
            options["insert"] = max(insert - first, 0)
    return plot_path(path, ax, view, **{**given, **options}, marks=marks)


# --- what is drawn ---------------------------------------------------------------------------------------------------


def _marks(path: Toolpath, stopped: bool, home: bool) -> list[tuple[Mark, Array]]:
    """Marks and where they stand (m, 3)."""
    found = [(mark, path.end[path.kind == kind]) for kind, mark in MARKS.items()]
    found += [(colours.HOME if home else colours.START, path.start[:1])]
    found += [(colours.ALARM if stopped else colours.END, path.end[-1:])]
    return [(mark, places) for mark, places in found if len(places)]


def _plunges(path: Toolpath, view: View) -> Array:
    """Where cuts run along the tool and the line of sight, and would be invisible (m, 2)."""
    rows = np.flatnonzero(path.start[:, view.right] == path.end[:, view.right])
    rows = rows[(path.start[rows, view.up] == path.end[rows, view.up]) & (path.kind[rows] == Kind.LINE)]
    rows = rows[(np.abs(path.axis[rows][:, [view.right, view.up]]) < 1e-9).all(axis=1)]
    return np.unique(path.end[rows][:, [view.right, view.up]], axis=0)


def _box(path: Toolpath, pieces: Sequence[tuple[Line, Array]], frame: str) -> tuple[Array, Array, bool]:
    """The corners (3,) of the box that is shown, and whether rapids go beyond it; a lathe's holds the centre line."""
    frame = choice(frame, "frame", ("auto", "all", "cuts"))
    cuts = corners([points for line, points in pieces if line is not colours.RAPID], path.lathe)
    rest = [points for line, points in pieces if line is colours.RAPID] + [path.start[:1], path.end[-1:]]
    everything = corners([*rest, np.array(cuts).reshape(-1, 3)] if cuts else rest, path.lathe)
    if everything is None:
        return np.zeros(3), np.zeros(3), False
    if cuts is None or frame == "all":
        return *everything, False
    spans = [float((high - low).max()) for low, high in (everything, cuts)]
    if frame == "cuts" or spans[0] > FAR * spans[1] > 0:
        return *cuts, spans[0] > spans[1]
    return *everything, False


def _foot(stop: Alarm | None, beyond: bool) -> Foot | None:
    if stop:
        return Foot.of(stop)
    return Foot('rapids from far away are cut off; frame="all" shows them') if beyond else None


def _views(view: str, path: Toolpath, low: Array, high: Array, single: bool) -> list[View]:
    view = choice(view, "view", ("auto", *VIEWS))
    names = [view] if view != "auto" else ["ZX"] if path.lathe else _needed(path, high - low)
    return [VIEWS[name]._replace(unit=path.unit) for name in names[: 1 if single else None]]


def _needed(path: Toolpath, span: Array) -> list[str]:
    """The views of a mill's path: along the tool, from the side, and on each plane that has arcs."""
    cuts = np.flatnonzero((path.kind == Kind.LINE) | (path.kind == Kind.ARC))
    arcs = cuts[path.kind[cuts] == Kind.ARC]
    on_x, on_y = (bool((np.abs(path.axis[arcs][:, k]) > MOSTLY).any()) for k in (0, 1))
    if len(cuts) and abs(path.axis[cuts[0], 2]) < 1 - MOSTLY:
        for k, names in ((0, ["YZ", "XZ"]), (1, ["XZ", "XY"])):
            if (np.abs(path.axis[cuts][:, k]) > MOSTLY).all():
                return names if span[k] > 0 else names[:1]
    if not span[2] > 0:
        return ["XY"]
    if on_x != on_y:
        return ["XY", "YZ" if on_x else "XZ"]
    return ["XY", "XZ", "YZ"] if on_x else ["XY", "YZ" if span[0] == 0 and span[1] > 0 else "XZ"]


def _draw(ax: Axes, view: View, drawing: Drawing) -> list[Line2D]:
    """Add lines, marks and crosses to an axes; returns those that a legend names."""
    artists = [Line2D(xyz[:, view.right], xyz[:, view.up], **line.style()) for line, xyz in drawing.lines]
    for outline in drawing.stock.outline(view.right, view.up) if drawing.stock else ():
        line = np.maximum(outline, [-np.inf, 0]) if view.diameter else outline  # a lathe's picture ends at its axis
        artists.append(Line2D(line[:, 0], line[:, 1], **colours.BLANK.style()))
    plunges = drawing.plunges[view]
    if len(plunges):
        artists.append(Line2D(plunges[:, 0], plunges[:, 1], **drawing.plunge.style()))
    artists += [Line2D(xyz[:, view.right], xyz[:, view.up], **mark.style()) for mark, xyz in drawing.marks]
    artists += crosses(drawing.places, view)
    for artist in artists:
        ax.add_line(artist)
    if drawing.part is not None:
        draw_under(ax, view, drawing.part)
    elif drawing.lathe is not None:
        draw_blank(ax, drawing.lathe)
    if drawing.lathe is not None:
        draw_chucks(ax, drawing.lathe.chucks)
    if view.diameter:
        ax.axhline(0.0, **{**colours.CENTRE_LINE.style(), "label": "_centre line"})
    return artists


def _write(ax: Axes, view: View, drawing: Drawing, low: Array, high: Array) -> None:
    """Add what depends on the scale: arrowheads and names."""
    occupied = [xyz[:, [view.right, view.up]] for _, xyz in drawing.marks]
    if drawing.home:
        heads.draw_arrival(ax, view, drawing.strokes.xyz[0], float((high - low).max()))
    if drawing.felt is not None:
        draw_felt(ax, view, drawing.felt, [xyz for _, xyz in drawing.lines], [xyz for _, xyz in drawing.marks])
    if drawing.lathe is not None:
        draw_insert(ax, drawing.lathe, INSERT * float((high - low).max()))
    if drawing.arrows:
        occupied.append(heads.draw(ax, view, drawing.strokes, drawing.classes, low, high))
    if drawing.places:
        around = np.concatenate([np.empty((0, 2)), *occupied])
        write_names(ax, view, drawing.places, around, [xyz for _, xyz in drawing.lines])


def _in_words(path: Toolpath, low: Array, high: Array, stop: Alarm | None) -> str:
    """What a person who cannot see the picture is told."""
    moves, factors = int(path.is_motion.sum()), (2 if path.lathe else 1, 1, 1)
    said = several(moves, "move") if moves else "no moves"
    ends = zip("XYZ", factors, low / path.unit.length, high / path.unit.length)
    ranges = [f"{axis} {f * a:.4g} to {f * b:.4g}" for axis, f, a, b in ends if b > a]
    said += f", {', '.join(ranges)} {path.unit.short}" if ranges and moves else ""
    return f"tool path: {said}{f'; stopped in line {stop.span.line}' if stop and stop.span else ''}"
