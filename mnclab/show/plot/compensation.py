"""Cutter radius compensation: the programmed contour, the tool centre beside it, and how every corner was found.

Arrows are the offset vectors, as long as the radius and square to the contour. What the tool cuts away behind the
contour because it does not fit is hatched. Several rules or radii are several runs of one program, side by side.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from mnclab.path.compensation.construction import Construction, construct
from mnclab.path.compensation.overcut import Overcut, overcuts
from mnclab.path.kinds import RULE_NAMES, Kind, Rule
from mnclab.path.toolpath import Toolpath
from mnclab.show.plot import colours
from mnclab.show.plot.colours import Line, Mark
from mnclab.show.plot.datums import Place, write_names
from mnclab.show.plot.picture import (
    ROW,
    SIZE,
    SMALL,
    VIEWS,
    Foot,
    Picture,
    View,
    columns,
    dress,
    roomy,
    write_foot,
    write_legend,
)
from mnclab.show.plot.strokes import corners, parted, strokes
from mnclab.text.alarm import Alarm

#: How rows look by their rule; rows along the contour are called after the corner at their end and look alike.
ROWS: dict[Rule, Line] = {
    Rule.NONE: colours.UNCOMPENSATED,
    Rule.SIDE: colours.ALONG,
    Rule.OUTSIDE_ARC: colours.ROUND_CORNER,
    Rule.OUTSIDE_STRAIGHT: colours.ALONG,
    Rule.INSIDE: colours.ALONG,
    Rule.ENTRY: colours.ENTRY,
    Rule.EXIT: colours.EXIT,
    Rule.CHANGE: colours.CHANGE,
}
#: How corners look by their rule.
CORNERS: dict[Rule, Line] = {
    **ROWS,
    Rule.OUTSIDE_STRAIGHT: colours.STRAIGHT_CORNER,
    Rule.INSIDE: colours.INSIDE_CORNER,
}
WIDE = (10.0, 7.0)  # several pictures side by side
NAMED = 8  # corners beyond which only the first of each rule has its name beside it
MANY = 400  # offset vectors beyond which they say nothing and are not drawn
TITLE, GAP, BELOW, RIGHT = 0.26, 0.5, 0.52, 0.16  # inches
COARSE, FINE = 90, 300  # points along the longer side of a box in which the cut-away area is looked for
SQUARE = 0.16  # of the radius: the mark of a right angle

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Panel:
    """One run of the program, and what is said above it."""

    title: str
    run: Any
    made: Construction
    view: View

    def flat(self, points: Array) -> Array:
        """Points (m, 3) as they are seen (m, 2)."""
        return np.asarray(points[:, [self.view.right, self.view.up]])

    @cached_property
    def rows(self) -> list[tuple[Line, Array]]:
        """The tool-centre path by rule, points (m, 3) broken by nan."""
        path = self.run.toolpath
        looks = [*dict.fromkeys(ROWS.values()), colours.RAPID]
        look = np.array([looks.index(ROWS[Rule(rule)]) for rule in range(len(Rule))])
        drawn = strokes(path)
        group = look[path.rule[drawn.row]] if len(drawn.row) else drawn.row
        group[(path.kind[drawn.row] == Kind.RAPID) & (group == look[Rule.NONE])] = len(looks) - 1
        group[drawn.row < 0] = -1
        return [(line, xyz) for line, xyz in zip(looks, parted(drawn.xyz, group, len(looks))) if len(xyz)]

    @cached_property
    def contour(self) -> list[tuple[Line, Array]]:
        """The programmed contour, and the programmed lines that lead to it and away."""
        if self.made.found is None:
            return []
        el, path = self.made.found.el, self.made.path
        group_of = np.full(len(path) + 1, -1)
        group_of[el.rows[el.wall]], group_of[el.rows[el.entry | el.change | el.exit]] = 0, 1
        drawn = strokes(path)
        pieces = parted(drawn.xyz, np.where(drawn.row < 0, -1, group_of[drawn.row]), 2)
        return [(line, xyz) for line, xyz in zip((colours.CONTOUR, colours.LEAD), pieces) if len(xyz)]

    @cached_property
    def overcuts(self) -> list[Overcut]:
        """The contours that the tool cuts into."""
        return list(overcuts(self.made, [gouge.step for gouge in self.run.gouges]))


def compensation(
    run: Any,
    ax: Axes | None = None,
    *,
    rules: Sequence[str] | None = None,
    radii: Sequence[float] | None = None,
    discs: bool | float | Sequence[int] = False,
    vectors: bool = True,
    names: bool = True,
    view: str = "auto",
    size: tuple[float, float] | None = None,
) -> Figure:
    """The contour of a run and the path of the tool centre; returns the figure, which Jupyter shows.

    - ``ax``: draw into these axes of one's own, without legend; one rule and one radius at most.
    - ``rules``: the program is run once for each of these ways to join outside corners ("G160", "G161", "G162";
      "programmed" leaves it as it is), whatever it says itself.
    - ``radii``: and once for each of these radii of all its tools, mm.
    - ``discs``: the tool at the end of each compensated row; a number: every so many mm; a list: where the blocks in
      these lines end.
    - ``vectors``: offset vectors at the corners; ``names``: what was done there, written beside.
    - ``view``: "XY", "XZ", "YZ" or "ZX"; "auto" is the plane of the first contour.
    - ``size``: the greatest width and height in inches.

    A run that was stopped because the tool does not fit is run again with the setting ``gouge = "mark"``, so that the
    place is seen.
    """
    panels = [_panel(again, title, view) for title, again in _runs(run, rules, radii)]
    if ax is not None:
        if len(panels) > 1:
            raise ValueError("axes of one's own have room for one rule and one radius")
        low, high = roomy(*_box(panels, discs))
        _draw(ax, panels[0], discs, vectors)
        dress(ax, panels[0].view)
        _limit(ax, panels[0].view, low, high)
        ax.apply_aspect()
        _write(ax, panels[0], names)
        figure: Any = ax.get_figure(root=True)
        return figure
    return _picture(panels, discs, vectors, names, size or (WIDE if len(panels) > 1 else SIZE))


def image(run: Any, size: tuple[float, float] = (6.4, 5.2), **options: Any) -> str:
    """The picture as HTML with a name, for those who show pictures but do not draw."""
    picture = compensation(run, size=size, **options)
    assert isinstance(picture, Picture)
    return picture.html()


# --- the runs ---------------------------------------------------------------------------------------------------------


def _runs(run: Any, rules: Sequence[str] | None, radii: Sequence[float] | None) -> list[tuple[str, Any]]:
    """What is shown, and its title: the run itself, or the program run again for each rule and radius."""
    for radius in () if radii is None else radii:
        if not math.isfinite(radius):
            raise Alarm(f"a tool radius must be a number of mm, got {radius!r}")
    found = []
    for rule, radius in product([None] if rules is None else rules, [None] if radii is None else radii):
        setup = run.setup
        if rule is not None:
            setup = setup.with_settings(outside_corners=rule)
        if radius is not None:
            setup = setup.with_radius(float(radius))
        again = run if setup is run.setup else run.again(setup)
        if again.gouges and not again.ok and "gouge" in again.settings:
            again = again.again(setup.with_settings(gouge="mark"))
        said = [rule] if rule else []
        used = np.unique(np.abs(again.programmed.radius[again.programmed.side != 0]))
        said += [f"radius {value:.4g} mm" for value in used[:3].tolist()]
        if again.gouges:
            said.append(f"largest {min(gouge.largest for gouge in again.gouges):.4g} mm")
        found.append((", ".join(said), again))
    return found


def _panel(run: Any, title: str, view: str) -> Panel:
    made = construct(run.programmed, run.control.compensation, not run.ok)
    if view != "auto":
        if view.upper() not in VIEWS:
            raise ValueError(f"view must be auto or one of {', '.join(VIEWS)}, got {view!r}")
        return Panel(title, run, made, VIEWS[view.upper()])
    if run.toolpath.lathe:
        return Panel(title, run, made, VIEWS["ZX"])
    rows = np.flatnonzero(made.compensated)
    normal = int(np.argmax(np.abs(made.path.axis[rows[0]]))) if len(rows) else 2
    return Panel(title, run, made, VIEWS[("YZ", "XZ", "XY")[normal]])


def _box(panels: Sequence[Panel], discs: Any) -> tuple[Array, Array]:
    """The corners (3,) of the box that all panels show: contours, the tool centre beside them, the discs."""
    clouds: list[Array] = []
    for panel in panels:
        beside = [xyz for line, xyz in panel.rows if line not in (colours.RAPID, colours.UNCOMPENSATED)]
        clouds += beside + [xyz for _, xyz in panel.contour]
        if discs is not False or panel.overcuts:
            reach = np.abs(panel.run.programmed.radius).max() if beside else 0.0
            clouds += [xyz + sign * reach for xyz in beside for sign in (-1, 1)]
    found = corners(clouds, False) or corners([xyz for panel in panels for _, xyz in panel.rows], False)
    return found or (np.zeros(3), np.zeros(3))


# --- the figure -------------------------------------------------------------------------------------------------------


def _picture(
    panels: Sequence[Panel], discs: Any, vectors: bool, names: bool, size: tuple[float, float]
) -> Picture:
    low, high = roomy(*_box(panels, discs))
    seen = panels[0].view
    wide, tall = float((high - low)[seen.right]), float((high - low)[seen.up])
    handles = _handles(panels)
    words = [str(handle.get_label()) for handle in handles]
    foot = _foot(panels)
    left, bottom = 0.72, BELOW + (ROW if foot else 0)

    def room(count: int) -> tuple[float, float]:
        """Inches a millimetre, and the height of the legend, for so many panels in a row."""
        lines, above = math.ceil(len(panels) / count), 0.12 + ROW * math.ceil(len(words) / columns(words, size[0]))
        free = size[0] - count * (left + RIGHT), size[1] - above - bottom - lines * TITLE - (lines - 1) * GAP
        return min(free[0] / count / wide, free[1] / lines / tall), above

    count = max(range(1, len(panels) + 1), key=lambda n: (round(room(n)[0], 6), n))
    scale = room(count)[0]
    box, height = max(scale * wide, 1.6), max(scale * tall, 1.6)
    lines, width = math.ceil(len(panels) / count), max(4.6, count * (left + RIGHT + box))
    box = width / count - left - RIGHT
    above = 0.12 + ROW * math.ceil(len(words) / columns(words, width))
    total = above + bottom + lines * (TITLE + height) + (lines - 1) * GAP
    picture = Picture((width, total), _in_words(panels))
    for k, panel in enumerate(panels):
        row, column = divmod(k, count)
        x = column * width / count + left
        y = total - above - (row + 1) * (TITLE + height) - row * GAP
        ax = picture.add_axes((x / width, y / total, box / width, height / total))
        dress(ax, panel.view, (box, height))
        _limit(ax, panel.view, low, high)
        ax.apply_aspect()
        if panel.title:
            ax.set_title(panel.title, fontsize=SMALL + 1, loc="left", pad=4)
        if column:
            ax.set_ylabel("")
        if k + count < len(panels):
            ax.set_xlabel("")
        _draw(ax, panel, discs, vectors)
        _write(ax, panel, names)
    write_legend(picture, handles)
    if foot:
        write_foot(picture, foot)
    return picture


def _limit(ax: Axes, view: View, low: Array, high: Array) -> None:
    ax.set(xlim=(low[view.right], high[view.right]), ylim=(low[view.up], high[view.up]))


def _handles(panels: Sequence[Panel]) -> list[Any]:
    """What the legend names: lines in the order of the table, corners that have no line of their own, gouges."""
    shown = {line for panel in panels for line, _ in [*panel.contour, *panel.rows]}
    for panel in panels:
        shown |= {CORNERS[Rule(rule)] for rule in np.unique(panel.made.rule).tolist()}
    order = [colours.CONTOUR, *CORNERS.values(), colours.RAPID]
    found: list[Any] = []
    for line in dict.fromkeys(order):
        if line in shown:
            marker = "o" if line in (colours.INSIDE_CORNER, colours.STRAIGHT_CORNER) else None
            found.append(Line2D([], [], **line.style(), marker=marker, markersize=3.5))
    if any(panel.run.gouges for panel in panels):
        found.append(Patch(facecolor="none", edgecolor=colours.GOUGE, hatch="/////", linewidth=0.6, label="gouge"))
    return found


def _foot(panels: Sequence[Panel]) -> Foot | None:
    """The first place that does not fit, or the alarm that stopped the program."""
    for panel in panels:
        if panel.made.found is None and len(panels) == 1 and panel.run.ok:
            return Foot("no radius compensation in this program")
        stop = next((alarm for alarm in panel.run.alarms if not panel.run.ok and alarm.severity == "alarm"), None)
        if stop is not None:
            return Foot(f"line {stop.span.line}: {stop.message}" if stop.span else stop.message, colours.GOUGE)
        for gouge in panel.run.gouges:
            return Foot(f"line {gouge.line}: {gouge.message}", colours.GOUGE)
    return None


def _in_words(panels: Sequence[Panel]) -> str:
    said = []
    for panel in panels:
        done = [Rule(rule) for rule in panel.made.rule]
        counts = [f"{done.count(rule)} {RULE_NAMES[rule]}" for rule in Rule if rule in done]
        gouges = f"; {len(panel.run.gouges)} gouges" if panel.run.gouges else ""
        said.append(f"{panel.title}: {', '.join(counts) or 'nothing compensated'}{gouges}")
    return "radius compensation: " + " | ".join(said)


# --- one view ---------------------------------------------------------------------------------------------------------


def _draw(ax: Axes, panel: Panel, discs: Any, vectors: bool) -> None:
    for line, xyz in [*panel.contour, *panel.rows]:
        ax.add_line(Line2D(*panel.flat(xyz).T, **line.style()))
    if discs is not False:
        _draw_discs(ax, panel, discs)
    if vectors and 0 < len(panel.made.of) <= MANY:
        _draw_vectors(ax, panel)
    for overcut in panel.overcuts:
        _hatch(ax, panel, overcut)
    if panel.run.gouges:
        places = panel.flat(np.array([gouge.place for gouge in panel.run.gouges]))
        ax.add_line(Line2D(*places.T, **{**colours.ALARM.style(), "markersize": 6, "label": "_gouges"}))


def _draw_vectors(ax: Axes, panel: Panel) -> None:
    """One set of arrows for each rule, and a right angle where the tool enters and leaves square to the contour."""
    made = panel.made
    foot, tip, rule = panel.flat(made.foot), panel.flat(made.tip), made.rule[made.of]
    alone = np.bincount(made.of, minlength=len(made.rule)) == 1
    for code in np.unique(rule).tolist():
        k, look = np.flatnonzero(rule == code), CORNERS[Rule(code)]
        ax.quiver(
            *foot[k].T, *(tip[k] - foot[k]).T, angles="xy", scale_units="xy", scale=1, units="inches", width=0.011,
            headwidth=5, headlength=7, headaxislength=6, minlength=0, color=look.colour, zorder=3.2,
            label=f"_{RULE_NAMES[Rule(code)]}",
        )  # fmt: skip
        if code in (Rule.INSIDE, Rule.OUTSIDE_STRAIGHT):
            path = panel.run.toolpath
            ends = panel.flat(path.end[path.rule == code])
            ax.add_line(Line2D(*ends.T, color=look.colour, linestyle="none", marker="o", markersize=3.5, zorder=3.3))
        if code in (Rule.ENTRY, Rule.EXIT, Rule.CHANGE):
            k = k[alone[made.of[k]]]
            up, on = SQUARE * (tip[k] - foot[k]), panel.flat(made.along)[made.of[k]]
            on = on * np.hypot(*up.T)[:, None]
            corner = np.stack([foot[k] + on, foot[k] + on + up, foot[k] + up, np.full_like(up, np.nan)], axis=1)
            ax.add_line(Line2D(*corner.reshape(-1, 2).T, color=look.colour, linewidth=0.7, zorder=3.1))


def _draw_discs(ax: Axes, panel: Panel, discs: Any) -> None:
    at, radius = disc_places(panel.run.toolpath, discs)
    if len(at):
        artist = EllipseCollection(
            2 * radius, 2 * radius, np.zeros(len(at)), units="xy", offsets=panel.flat(at), offset_transform=ax.transData,
            facecolors=colours.DISC + "18", edgecolors=colours.DISC, linewidths=0.6, zorder=2.0, label="_discs",
        )  # fmt: skip
        ax.add_collection(artist, autolim=False)


def disc_places(path: Toolpath, discs: bool | float | Sequence[int]) -> tuple[Array, Array]:
    """Where discs stand (m, 3), and their radii (m,): see :func:`compensation`."""
    rows = np.flatnonzero((path.rule != Rule.NONE) & path.is_motion)
    if discs is True or not isinstance(discs, int | float):
        if discs is not True:
            rows = rows[np.isin(path.line[rows], list(discs))]
        at, of = path.end[rows], rows
    else:
        if not discs > 0:
            raise ValueError(f"discs stand every so many mm, more than 0, got {discs:g}")
        drawn = strokes(path[rows])
        way = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(drawn.xyz, axis=0), axis=1) * (drawn.row[1:] >= 0)))
        stations = np.arange(0.0, way[-1] + 1e-9, discs) if len(rows) else np.empty(0)
        at = np.stack([np.interp(stations, way, column) for column in drawn.xyz.T], axis=1)
        of = rows[np.maximum(drawn.row[np.searchsorted(way, stations).clip(0, len(way) - 1)], 0)]
    radius = np.abs(path.radius[of])
    radius[path.rule[of] == Rule.EXIT] = np.abs(path.radius[np.maximum(of - 1, 0)])[path.rule[of] == Rule.EXIT]
    return at, radius


def _hatch(ax: Axes, panel: Panel, overcut: Overcut) -> None:
    """What is cut away behind the contour: looked for in coarse steps, drawn in fine ones."""
    low, high = overcut.box
    for count in (COARSE, FINE):
        step = float((high - low).max()) / (count - 1)
        u, v = np.arange(low[0], high[0] + step, step), np.arange(low[1], high[1] + step, step)
        grid = np.stack(np.meshgrid(u, v), axis=-1)
        depth = overcut.depth(grid.reshape(-1, 2)).reshape(grid.shape[:2])
        inside = grid[depth > -step]
        if not len(inside):
            return
        low, high = inside.min(axis=0) - step, inside.max(axis=0) + step
    if not (depth > 0).any():
        return
    flat = grid.reshape(-1, 2)
    rows = np.full(len(flat), overcut.row)
    seen = panel.flat(panel.made.view.to_space(rows, np.column_stack([flat, np.full(len(flat), overcut.height)])))
    x, y = seen[:, 0].reshape(depth.shape), seen[:, 1].reshape(depth.shape)
    area = ax.contourf(
        x, y, depth, levels=[0.0, np.inf], colors=[colours.GOUGE + "22"], hatches=["/////"], zorder=2.1
    )
    area.set_edgecolor(colours.GOUGE)
    area.set_linewidth(0.6)
    area.set_label("_gouge")


def _write(ax: Axes, panel: Panel, names: bool) -> None:
    """What was done at the corners, beside them."""
    made = panel.made
    if not names or not len(made.rule):
        return
    k = np.flatnonzero(made.rule != Rule.SIDE)
    if len(k) > NAMED:
        k = k[np.unique(made.rule[k], return_index=True)[1]]
    places = []
    for at in np.sort(k).tolist():
        rule = Rule(made.rule[at])
        mark = Mark(RULE_NAMES[rule], CORNERS[rule].colour, "", 0, True, 4.0)
        x, y, z = made.place[at].tolist()
        places.append(Place(mark, RULE_NAMES[rule], (x, y, z)))
    occupied = panel.flat(np.concatenate([made.place, made.tip]))
    lines = [xyz for _, xyz in [*panel.contour, *panel.rows]]
    vectors = np.stack([made.foot, made.tip, np.full_like(made.tip, np.nan)], axis=1).reshape(-1, 3)
    write_names(ax, panel.view, places, occupied, [*lines, vectors])
