"""The tool path seen from above and from the front; on a lathe Z to the right and the diameter X up.

Each class of moves is *one* line, broken by nan (see `strokes`), so that a million moves cost what a million points cost.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from mnclab.path.limits import Limits
from mnclab.path.machines import limits_of
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Kind, Mask, Toolpath
from mnclab.show.plot import colours
from mnclab.show.plot.classes import Classes, classes, write_scale
from mnclab.show.plot.classes import lines as lines_of
from mnclab.show.plot.clickable import told_by
from mnclab.show.plot.colours import LineStyle
from mnclab.show.plot.datums import DatumCross, crosses, near, places_of
from mnclab.show.plot.holes import beside_holes, holes_of
from mnclab.show.plot.lathe import FINISHED, lathe, speed_strokes, with_blank
from mnclab.show.plot.layers import (
    BAND_NAME,
    INSERT,
    MOST_STROKES,
    THIN_BAND,
    Box,
    PathDrawing,
    around_bands,
    band_sample,
    dense,
    draw,
    draw_bands,
    draw_ghost,
    gone,
    held_box,
    marks_of,
    plunges_of,
    radii_of,
    samples_of,
    write,
)
from mnclab.show.plot.original import original_of
from mnclab.show.plot.overlay import Overlay, centres_of, polar_of
from mnclab.show.plot.picture import (
    LINE,
    SCALE,
    SIZE,
    SMALL,
    VIEWS,
    Foot,
    Picture,
    View,
    arrange,
    dress,
    figure_of,
    roomy,
    write_legend,
)
from mnclab.show.plot.placing import MANY_MOVES
from mnclab.show.plot.probed import names_of
from mnclab.show.plot.sections import fixtures_of
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.strokes import Array, Strokes, corners, line_of, strokes
from mnclab.show.plot.tilted import tilted_tool_of, tilts
from mnclab.show.probed import Felt
from mnclab.show.probed import felt as felt_of
from mnclab.text.alarm import ALARM, Alarm, several
from mnclab.text.given import choice
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.workpiece import Workpiece

UNSCALED = (colours.PROGRAMMED, colours.RAPID, colours.PROBING)  # look the same whatever the colour shows
PART = "part"
CUTS = 2  # the first class of cuts; before them rapids and probing
AROUND = 0.02  # of the greatest side: more room, for symbols that stand beside a corner
MOST = 2000  # rows of a lathe's path whose part is shown unasked


@sized()
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
    places: Sequence[DatumCross] = (),
    stock: Blank | None = None,
    tools: Mapping[int, Tool] = MappingProxyType({}),
    insert: bool | int = True,
    part: Workpiece | None = None,
    home: bool = False,
    felt: Felt | None = None,
    gouged: Array | None = None,
    rapids: Limits | str | None = None,
    under: Toolpath | None = None,
    limits: Box | None = None,
    overlays: Sequence[Overlay] = (),
    band: bool | None = None,
) -> Figure:
    """Views of a path: rapids dashed red, cuts solid; start and end marked. Returns the figure, which Jupyter shows.

    Its data are mm; what is written counts in the unit of the program, mm or inches.

    - `ax`: draw one view into these axes of one's own, without legend and scale.
    - `view`: "XY" from above, "XZ" or "YZ" from the side, "ZX" of a lathe; "auto" takes what the path needs: the plane
      that it works in, how deep it goes, and each plane that has arcs.
    - `colour`: what the colour of the cuts shows: "kind" (all blue), "feed" (a minute; the slower the wider), "speed" (of
      the spindle, rev/min; it follows X at constant cutting speed), "tool" (its number), "step" (of a cycle: roughing,
      finishing, entry, …), "pass" (what lies between two rapids, counted from 1), "line" (of the source) or "z" (lower end
      of each stroke). Few values are named in the legend, many are put into at most 14 steps of a scale, dark to light.
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
    - `felt`: what a probe meets, drawn behind the path (see `show.probed`).
    - `gouged`: the points (n, 3) of the contour that a compensated tool cuts; None: the ends of the rows that do.
    - `rapids`: limits of the machine, or its name, under which axes that do not wait for each other bend a rapid; else it is
      straight.
    - `under`: another path, whose moves that this one has not are drawn thin and grey behind it.
    - `limits`: the `box` of the picture before, which is kept while this path fits into it (see `show.plot.layers`).
    - `band`: from above, the width of the tool as a light band under a thin line of its centre; None: where the passes lie
      so close that they would run into a blot.
    - `overlays`: centres of arcs, mirror lines, holes and the like (see `show.plot.overlay`).
    """
    bent = limits_of(rapids)
    stop = next((alarm for alarm in alarms if alarm.severity == ALARM), None)
    if ax is None and stock is None and felt is None and not path.is_motion.any():
        return no_moves(stop)
    drawn = strokes(path, bent)
    if colour == "speed" and len(drawn.row):
        drawn = speed_strokes(path, drawn)
    found = classes(path, drawn, colour)
    lines = lines_of(drawn, found)
    if programmed is not None and len(contour := line_of(programmed, (Kind.LINE, Kind.ARC))):
        lines.insert(0, (colours.PROGRAMMED, contour))
    low, high, every = box_of(path, lines, frame)
    shown = near(places, low, high) if marks else []
    for place in shown:
        low, high = np.fmin(low, place.xyz), np.fmax(high, place.xyz)
    low, high = with_blank(path, stock, low, high, part)
    for over in overlays:
        low, high = over.box(low, high) if frame != "cuts" else (low, high)
    if felt is not None and frame != "cuts":
        low, high = felt.box(low, high)
    if stop is not None and len(path):
        low, high = np.fmin(low, path.end[-1]), np.fmax(high, path.end[-1])
    blank = stock.bounds if stock is not None and not path.lathe and frame != "cuts" else None
    bounds = np.stack([low, high]) if blank is None else blank
    low, high, beyond = with_rapids(low, high, every, bounds, ROOM if frame == "auto" else 0.0)
    seen = ((path.end >= low) & (path.end <= high)).all(axis=1)
    if path.lathe and insert is True and seen.any():
        insert = int(np.flatnonzero(seen)[-1])  # not beyond the border
    if path.lathe and len(path) and insert is not False:
        room = 2.8 * INSERT * float((high - low).max())
        stands = path.end[-1 if insert is True else insert]
        low = np.fmin(low, stands - (room / 2, 0.0, 0.0))  # a drill stands on both sides of the axis
        high = np.fmax(high, stands + (room, 0.0, room))
    own, (low, high) = (low, high), held_box(low, high, limits)
    box = low, high
    views = views_of(view, path, low, high, single=ax is not None)
    cut_off = bool(beyond[[axis for each in views for axis in each[:2]]].any())
    if blank is not None:
        low, high = np.fmin(low, blank[0]), np.fmax(high, blank[1])
    unseen = cut_off and goes_out(path, low, high, views)
    above = next((each for each in views if not path.lathe and (each.right, each.up) == (0, 1)), None)
    crowded = above is not None and band is not False and not tilts(path) and (band or _crowded(drawn, found, high - low, size))
    banded = above if crowded and (band or len(drawn.row) <= MOST_STROKES) else None
    if banded is not None and not cut_off:
        low, high = around_bands(low, high, path, drawn, found.group >= CUTS)
    if crowded:
        lines = [(line._replace(width=THIN_BAND * line.width) if line in found.lines[2:] else line, xyz) for line, xyz in lines]
    plunge = colours.PLUNGE if colour == "kind" else colours.PLUNGE._replace(colour=colours.INK)
    plunges = {each: beside_holes(overlays, each, plunges_of(path, each)) for each in views}
    arrows = arrows and int(path.is_motion.sum()) <= MANY_MOVES
    beside = lathe(path, stock, tools, insert, part) if path.lathe and views[0].diameter else None
    found_marks, outline = marks_of(path, stop is not None, home, gouged), None if beside else stock
    if felt is not None and len(felt.places):
        found_marks.append((colours.TOUCH, felt.places))
    arrives = home and bool(((path.start[0] >= low) & (path.start[0] <= high)).all())
    rest = (beside, part, arrives, felt, overlays, roomy(low, high, views))
    drawing = PathDrawing(drawn, found, lines, found_marks, shown, plunges, plunge, arrows, outline, *rest)
    former = None if under is None else gone(under, path)
    if ax is not None:
        if banded is not None:
            draw_bands(ax, banded, path, drawn, found.group >= CUTS)
        draw(ax, views[0], drawing)
        if former is not None:
            draw_ghost(ax, views[0], former, bent)
        dress(ax, views[0])
        if cut_off:
            wide = roomy(low, high, views)
            right, up = views[0][:2]
            ax.set(xlim=(wide[0][right], wide[1][right]), ylim=(wide[0][up], wide[1][up]))
        else:
            ax.autoscale_view()
        ax.apply_aspect()
        write(ax, views[0], drawing, low, high)
        return figure_of(ax)
    names = [line.name for line, _ in lines if not found.scale or line in UNSCALED]
    names += [colours.BLANK.name] if drawing.stock is not None else []
    names += [mark.name for mark, _ in drawing.marks if any(len(drawing.seen(mark, each)) for each in views)]
    if any(map(len, drawing.plunges.values())):
        names.append(colours.PLUNGE.name)
    if any(line.get_label() == colours.POLE.name for each in views for line in crosses(shown, each)):
        names.append(colours.POLE.name)
    held = beside.names + ([Patch(**FINISHED, label=PART)] if part is not None else []) if beside else []
    held += samples_of(part, views) if part is not None and not path.lathe else []
    held += names_of(felt) if felt is not None else []
    names += [str(each.get_label()) for each in held]
    names += [name for over in overlays for name in over.names(views)]
    names += [BAND_NAME] if banded is not None and radii_of(path, drawn, found.group >= CUTS) else []
    said = in_words(path, *(every or (own if limits else (low, high))), stop)
    more = AROUND * float((high - low).max())
    picture, axes = arrange(views, low - more, high + more, names, foot_of(stop, unseen), said, size, found.scale is not None)
    picture.box = box
    picture.seen = [(one, which, path, drawn) for one, which in zip(axes, views)]
    artists: dict[str, Any] = {str(each.get_label()): each for each in (*held, band_sample())}
    for one, which in zip(axes, views):
        if which is banded:
            draw_bands(one, which, path, drawn, found.group >= CUTS)
        if former is not None:
            draw_ghost(one, which, former, bent)
        for artist in draw(one, which, drawing):
            artists.setdefault(str(artist.get_label()), artist)
        write(one, which, drawing, low, high)
    if not names:
        axes[0].text(0.5, 0.5, "no moves", transform=axes[0].transAxes, ha="center", color=colours.PROGRAMMED.colour)
    if found.scale:
        write_scale(picture, found.scale)
    write_legend(picture, [artists[name] for name in names], SCALE if found.scale else 0.0)
    return picture


def _crowded(drawn: Strokes, found: Classes, span: Array, size: tuple[float, float]) -> bool:
    """Whether passes run into each other from above, in a picture of about this size."""
    sides = float(span[0]), float(span[1] + span[2])  # the views from above and from the side stand above one another
    scale = min(72 * inches / max(side, 1e-9) for inches, side in zip(size, sides))
    return dense(drawn.xyz[:, :2], found.group >= CUTS, 0.85 * scale)


# What is shown of it: the box, the views that it needs, and how it is told in words.

MOSTLY = 0.9  # the cosine between two directions from which on they are taken for the same
ROOM = 0.25  # of the greatest side of all else: so much further rapids are shown


def box_of(
    path: Toolpath, pieces: Sequence[tuple[LineStyle, Array]], frame: str
) -> tuple[Array, Array, tuple[Array, Array] | None]:
    """The corners (3,) of the box of the cuts, and those of all moves where they are not shown whole in any case; a lathe's
    hold the centre line."""
    frame = choice(frame, "frame", ("auto", "all", "cuts"))
    cuts = corners([points for line, points in pieces if line is not colours.RAPID], path.lathe)
    rest = [points for line, points in pieces if line is colours.RAPID] + [path.start[:1], path.end[-1:]]
    everything = corners([*rest, np.array(cuts).reshape(-1, 3)] if cuts else rest, path.lathe)
    if everything is None:
        return np.zeros(3), np.zeros(3), None
    if cuts is None or frame == "all":
        return *everything, None
    return *cuts, everything


def with_rapids(
    low: Array, high: Array, every: tuple[Array, Array] | None, bounds: Array, room: float
) -> tuple[Array, Array, Mask]:
    """The box (3,) and (3,) with `every` move in it, as far as rapids decide no scale: a share `room` of the greatest side
    beyond the box and the `bounds` (2, 3) of what is shown beside it; and along which axes (3,) they go farther."""
    if every is None:
        return low, high, np.zeros(3, bool)
    least, most = np.fmin(low, bounds[0]), np.fmax(high, bounds[1])
    more = room * float((most - least).max())
    beyond = (every[0] < least - more - 1e-9) | (every[1] > most + more + 1e-9)
    return np.fmin(low, np.fmax(every[0], least - more)), np.fmax(high, np.fmin(every[1], most + more)), beyond


def goes_out(path: Toolpath, low: Array, high: Array, views: Sequence[View]) -> bool:
    """Whether a path leaves the box of a picture sideways between two cuts; that it comes from far away, goes there at its end,
    and that mills go up, nobody needs to be told."""
    cuts = np.flatnonzero((path.kind == Kind.LINE) | (path.kind == Kind.ARC))
    axes = sorted({axis for each in views for axis in each[:2] if path.lathe or axis != 2})
    ends = path.end[cuts[0] : cuts[-1], axes] if len(cuts) else path.end[:0, axes]
    return bool(((ends < low[axes] - 1e-9) | (ends > high[axes] + 1e-9)).any())


def foot_of(stop: Alarm | None, unseen: bool) -> Foot | None:
    """What is written below: the alarm that stopped the program, or that rapids between two cuts are cut off."""
    if stop:
        return Foot.of(stop)
    return Foot("rapids between cuts go farther") if unseen else None


def views_of(view: str, path: Toolpath, low: Array, high: Array, single: bool) -> list[View]:
    """The views of a picture, a `single` one at most, that count in the unit of the path."""
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


def in_words(path: Toolpath, low: Array, high: Array, stop: Alarm | None) -> str:
    """What a person who cannot see the picture is told."""
    moves, factors = int(path.is_motion.sum()), (2 if path.lathe else 1, 1, 1)
    said = several(moves, "move") if moves else "no moves"
    ends = zip("XYZ", factors, low / path.unit.length, high / path.unit.length)
    ranges = [f"{axis}{' (diameter)' * (f == 2)} {f * a:.4g} to {f * b:.4g}" for axis, f, a, b in ends if b > a]
    said += f", {', '.join(ranges)} {path.unit.short}" if ranges and moves else ""
    return f"tool path: {said}{f'; stopped in line {stop.span.line}' if stop and stop.span else ''}"


WIDE = 4.6  # inches


def no_moves(stop: Alarm | None) -> Picture:
    """A strip with words: axes around nothing would show a scale that means nothing."""
    foot = Foot.of(stop).within(WIDE) if stop else None
    place = f"; stopped in line {stop.span.line}" if stop and stop.span else ""
    picture = Picture((WIDE, 0.4 + LINE * len(foot.lines if foot else ())), f"tool path: no moves{place}")
    picture.text(0.1 / WIDE, 1 - 0.1 / picture.get_figheight(), "no moves", fontsize=SMALL + 2, color=colours.INK, va="top")
    if foot:
        foot.write(picture)
    return picture


@sized(also=plot_path)
def plot_run(
    run: Any, ax: Axes | None = None, view: str = "auto",
    *, marks: bool = True, stock: bool = True, part: bool = False, probed: bool = True, centres: bool | None = None,
    original: bool = True, holes: bool = True, fixtures: bool = True, **options: Any,
) -> Figure:  # fmt: skip
    """Views of the path of a run, with its programmed contour, blank, zero points, poles and the place of its alarm.

    The options are those of `plot_path`; `stock=False` leaves out the blank of the setup or the program, `part=True`
    draws what the run leaves of it, as a lathe's picture does unless its path is long; `probed=False` leaves out the part
    that a probe meets, a section at the height of its touches, and their numbers. `centres` draws the centres of arcs as the
    program says them (None: where they are few), `original` the contour before it was turned, mirrored or scaled,
    `holes` those that are drilled at their diameter, `fixtures` what holds the blank; False leaves it out.
    `view="unrolled"` shows what lies on a
    cylinder on its developed surface (`show.plot.unrolled`; of the options it takes `size`), and so does "auto" without other
    options where every cut lies on one. Beside a blank the first approach
    comes from home, unless the setup says from where.
    """
    cuts = (run.toolpath.kind == Kind.LINE) | (run.toolpath.kind == Kind.ARC)
    followed = {name: options.pop(name, None) for name in ("under", "limits")}
    rolled = view == "auto" and options.keys() <= {"size"} and bool(cuts.any() and (run.toolpath.cylinder[cuts] >= 0).all())
    if view == "unrolled" or rolled:
        from mnclab.show.plot.unrolled import plot_unrolled

        return _telling(run, plot_unrolled(run.toolpath, ax, **options))
    given = {"programmed": None if run.programmed is run.toolpath else run.programmed, "alarms": run.alarms}
    given |= {"stock": run.stock if stock else None, "rapids": run.rapids}
    done = set(run.programmed.step.tolist())  # of a stopped run those that it warns of, not what it left undone
    given["gouged"] = np.array([gouge.place for gouge in run.gouges if gouge.step in done]).reshape(-1, 3)
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
    given["overlays"] = overlays_of(run, centres, original, holes, fixtures)
    if first := run.rows_from_home:
        path, given["home"] = path[first:], True
        if isinstance(insert, int) and not isinstance(insert, bool) and insert >= 0:
            options["insert"] = max(insert - first, 0)
    return _telling(run, plot_path(path, ax, view, **{**given, **options, **followed}, marks=marks))


def _telling(run: Any, figure: Figure) -> Figure:
    """The figure, whose moves name the blocks of a run."""
    if isinstance(figure, Picture):
        figure.told = told_by(run)
    return figure


def overlays_of(run: Any, centres: bool | None, original: bool, holes: bool, fixtures: bool) -> list[Overlay]:
    """Centres of arcs, the contour as written, holes, fixtures and the tilted tool of a run."""
    found: list[Overlay | None] = [fixtures_of(run) if fixtures else None, original_of(run) if original else None]
    found += [holes_of(run) if holes else None, polar_of(run), centres_of(run, centres), tilted_tool_of(run.toolpath)]
    return [each for each in found if each is not None]
