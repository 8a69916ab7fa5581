"""Cutter radius compensation: the programmed contour, the tool centre beside it, and how every corner was found.

Arrows are the offset vectors, as long as the radius and square to the contour. What the tool cuts away behind the
contour because it does not fit is hatched. Several rules or radii are several runs of one program, side by side.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import product
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from mnclab.path.compensation.construction import construct
from mnclab.path.compensation.fit import NO_TOOL
from mnclab.path.toolpath import RULE_NAMES, Rule, Toolpath
from mnclab.show.plot import colours
from mnclab.show.plot.clickable import told_by
from mnclab.show.plot.equidistant import CORNERS, Panel, draw, write
from mnclab.show.plot.layers import Box, draw_ghost, draw_stock, gone, held_box
from mnclab.show.plot.path import ROOM, with_rapids
from mnclab.show.plot.picture import (
    BELOW,
    LINE,
    ROW,
    SIZE,
    VIEWS,
    Foot,
    Picture,
    View,
    beside_ticks,
    digits_of,
    dress,
    figure_of,
    legend_height,
    legend_rows,
    roomy,
)  # fmt: skip
from mnclab.show.plot.side_by_side import BETWEEN, LOW, RIGHT, TITLE, label_outer
from mnclab.show.plot.side_by_side import panels as in_rows
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.strokes import Array, corners
from mnclab.text.alarm import Alarm, several
from mnclab.text.given import check_number, choice, shown

#: The kinds of places that do not fit, in few words.
NO_ROOM = "no room for the tool"
GOUGES = {
    "arc": "inside arc too small",
    "element": "used up by its corners",
    "neighbour": "cuts into line {other} beside it",
    "bottleneck": "too near to line {other}",
    "end": "no room beside line {other}",
    "corner": "straight corner reaches into line {other}",
    "entry": "entry cuts into line {other}",
    "exit": "exit cuts into line {other}",
}
WIDE = (12.0, 7.0)  # several pictures side by side
NAMES = 0.06  # of the greatest side: room for names above and below
LEAST = 1.6  # inches of a side of one picture
LARGER = 3.0  # a blank of so many times the size of the picture is left out


@sized()
def compensation(
    run: Any,
    ax: Axes | None = None,
    *,
    rules: Sequence[str] | None = None,
    radii: Sequence[float] | None = None,
    discs: bool | float | Sequence[int] = False,
    vectors: bool = True,
    names: bool = True,
    stock: bool = True,
    view: str = "auto",
    size: tuple[float, float] | None = None,
    under: Toolpath | None = None,
    limits: Box | None = None,
) -> Figure:
    """The contour of a run and the path of the tool centre; returns the figure, which Jupyter shows.

    - `ax`: draw into these axes of one's own, without legend; one rule and one radius at most.
    - `rules`: the program is run once for each of these ways to join outside corners ("G160", "G161", "G162";
      "programmed" leaves it as it is), whatever it says itself.
    - `radii`: and once for each of these radii of all its tools, mm.
    - `discs`: the tool at the end of each compensated row; a number: every so many mm; a list: where the blocks in
      these lines end.
    - `vectors`: offset vectors at the corners; `names`: what was done there, written beside.
    - `stock`: the blank behind the contour, where there is one that is not much larger.
    - `view`: "XY", "XZ", "YZ" or "ZX"; "auto" is the plane of the first contour.
    - `size`: the greatest width and height in inches.
    - `under`: another path, whose moves that this one has not are drawn thin and grey; `limits`: the `box` of the picture
      before, which is kept while this one fits into it.

    A run that was stopped because the tool does not fit is run again with the setting `gouge = "mark"`, so that the
    place is seen.
    """
    panels = [_panel(again, title, view) for title, again in _runs(run, rules, radii)]
    if ax is not None:
        if len(panels) > 1:
            raise Alarm("axes of one's own have room for one rule and one radius")
        low, high = roomy(*_box(panels, discs), [panels[0].view])
        outlines = draw(ax, panels[0], discs, vectors)
        _blank(ax, panels[0], low, high, stock)
        dress(ax, panels[0].view)
        _limit(ax, panels[0].view, low, high)
        ax.apply_aspect()
        write(ax, panels[0], outlines, names)
        return figure_of(ax)
    return _picture(panels, discs, vectors, names, size or (WIDE if len(panels) > 1 else SIZE), under, limits, stock)


# --- the runs ---------------------------------------------------------------------------------------------------------


def _runs(run: Any, rules: Sequence[str] | None, radii: Sequence[float] | None) -> list[tuple[str, Any]]:
    """What is shown, and its title: the run itself, or the program run again for each rule and radius."""
    rules, radii = _list("rules", rules, '("G160", "G161")'), _list("radii", radii, "(2, 5)")
    for value in radii:
        if value is not None:
            check_number(value, "a tool radius (mm)", at_least=0)
    found = []
    for rule, radius in product(rules, radii):
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
        unit = again.toolpath.unit
        said += [f"radius {unit.figure(each, 1)} {unit.short}" for each in used[:3].tolist()]
        if again.gouges:
            largest = min(gouge.largest for gouge in again.gouges)
            said.append(f"largest {unit.figure(largest, 1)} {unit.short}" if largest >= NO_TOOL else "no tool fits")
        found.append((", ".join(said), again))
    return found


def _panel(run: Any, title: str, view: str) -> Panel:
    rules = run.control.compensation
    made = construct(run.programmed, rules and rules.chosen(run.settings), not run.ok)
    view = choice(view, "view", ("auto", *VIEWS))
    if view == "auto":
        rows = np.flatnonzero(made.compensated)
        normal = int(np.argmax(np.abs(made.path.axis[rows[0]]))) if len(rows) else 2
        view = "ZX" if run.toolpath.lathe else ("YZ", "XZ", "XY")[normal]
    return Panel(title, run, made, VIEWS[view]._replace(unit=run.toolpath.unit))


def _list(name: str, given: Any, example: str) -> list[Any]:
    """What the program is run again with; None alone leaves it as it is."""
    if given is None:
        return [None]
    if isinstance(given, str) or not isinstance(given, Iterable):
        raise Alarm(f"{name} must be a list, got {shown(given)}", hint=f"{name}={example}")
    if not (found := [*given]):
        raise Alarm(f"{name} must name one at least, got none")
    return found


def _box(panels: Sequence[Panel], discs: Any) -> tuple[Array, Array]:
    """The corners (3,) of the box that all panels show: contours, the tool centre beside them, the discs; of rapids that are
    compensated as much as has room."""
    clouds: list[Array] = []
    rapids: list[Array] = []
    for panel in panels:
        (beside, rapid), contour = panel.compensated
        clouds += [beside, contour[0]]
        rapids += [rapid, contour[1]]
        if discs is not False or panel.overcuts:
            reach = np.abs(panel.run.programmed.radius).max(initial=0.0)
            clouds += [beside + sign * reach for sign in (-1, 1)]
    every = corners([*clouds, *rapids], False) or corners([xyz for panel in panels for _, xyz in panel.rows], False)
    low, high = corners(clouds, False) or every or (np.zeros(3), np.zeros(3))
    return with_rapids(low, high, every, np.stack([low, high]), ROOM)[:2]


# --- the figure -------------------------------------------------------------------------------------------------------


def _picture(
    panels: Sequence[Panel], discs: Any, vectors: bool, names: bool, size: tuple[float, float], under: Toolpath | None,
    limits: Box | None, stock: bool,
) -> Picture:  # fmt: skip
    box = held_box(*_box(panels, discs), limits)
    seen = panels[0].view
    low, high = roomy(*box, [seen])
    more = np.eye(3)[seen.up] * names * NAMES * float((high - low).max())
    low, high = low - more, high + more
    wide, tall = float((high - low)[seen.right]), float((high - low)[seen.up])
    handles = _handles(panels)
    if stock and any(_shown(panel, low, high) for panel in panels):
        handles.append(Line2D([], [], **colours.BLANK.style()))
    words = [str(handle.get_label()) for handle in handles]
    if foot := _foot(panels):
        foot = foot.within(size[0])
    left = max(0.72, beside_ticks(digits_of(low, high, [seen])))
    bottom = BELOW + (ROW + LINE * (len(foot.lines) - 1) if foot else 0)

    def best(count: int) -> float:
        """Inches a millimetre for so many panels in a row."""
        lines, above = math.ceil(len(panels) / count), 0.08 + legend_height(len(legend_rows(words, size[0])))
        free = size[0] - count * BETWEEN - left, size[1] - above - bottom - lines * TITLE - (lines - 1) * LOW
        return min(free[0] / count / wide, free[1] / lines / tall)

    full = [n for n in range(1, len(panels) + 1) if len(panels) % n == 0 or len(panels) > 4]
    count = max(full, key=lambda n: (best(n) * (1.5 if n == len(panels) < 4 and best(n) * wide > LEAST else 1.0), n))
    scale = best(count)
    across, height = max(scale * wide, LEAST), max(scale * tall, LEAST)
    width = min(size[0], max(4.6, left + RIGHT + count * across + (count - 1) * BETWEEN))
    across = (width - left - RIGHT - BETWEEN * (count - 1)) / count
    titles, ratio = [panel.title for panel in panels], height / across
    picture, axes = in_rows(titles, _in_words(panels), width, count, ratio, handles, below=bottom, left=left, tallest=height)
    picture.seen = [(ax, panel.view, path, drawn) for ax, panel in zip(axes, panels) for path, drawn in panel.drawn]
    picture.told = told_by(panels[0].run)
    for panel, ax in zip(panels, axes):
        dress(ax, panel.view, (across, height))
        _limit(ax, panel.view, low, high, (across, height))
        ax.apply_aspect()
        if under is not None:
            draw_ghost(ax, panel.view, gone(under, panel.run.toolpath))
        outlines = draw(ax, panel, discs, vectors)
        _blank(ax, panel, low, high, stock)
        write(ax, panel, outlines, names)
    label_outer(axes, *seen.labels)
    picture.box = box
    if foot:
        foot.write(picture)
    return picture


def _shown(panel: Panel, low: Array, high: Array) -> bool:
    """Whether the blank is of about the size of the picture."""
    blank = panel.run.stock
    axes = [panel.view.right, panel.view.up]
    return blank is not None and bool((np.ptp(blank.bounds, axis=0)[axes] <= LARGER * (high - low)[axes].max()).all())


def _blank(ax: Axes, panel: Panel, low: Array, high: Array, stock: bool) -> None:
    if stock and _shown(panel, low, high):
        for outline in draw_stock(ax, panel.view, panel.run.stock):
            ax.add_line(outline)


def _limit(ax: Axes, view: View, low: Array, high: Array, box: tuple[float, float] | None = None) -> None:
    """The limits of a view; in a `box` of inches as much more on both sides as it has room."""
    axes = [view.right, view.up]
    middle, half = (low + high)[axes] / 2, (high - low)[axes] / 2
    if box:
        half = np.array(box) * float((half / box).max())
    (left, bottom), (right, top) = middle - half, middle + half
    ax.set(xlim=(left, right), ylim=(bottom, top))


def _handles(panels: Sequence[Panel]) -> list[Any]:
    """What the legend names: lines in the order of the table, corners that have no line of their own, gouges."""
    shown = {line for panel in panels for line, _ in [*panel.contour, *panel.rows]}
    shown |= {CORNERS[Rule(rule)] for panel in panels for rule in np.unique(panel.made.rule).tolist()}
    order = [colours.CONTOUR, *CORNERS.values(), colours.RAPID]
    dotted = colours.INSIDE_CORNER, colours.STRAIGHT_CORNER
    looks = [(line.style(), "o" if line in dotted else None) for line in dict.fromkeys(order) if line in shown]
    found: list[Any] = [Line2D([], [], **look, marker=marker, markersize=3.5) for look, marker in looks]
    if any(panel.run.gouges for panel in panels):
        found.append(Patch(facecolor="none", edgecolor=colours.GOUGE, hatch="/////", linewidth=0.6, label="gouge"))
        found.append(Line2D([], [], **{**colours.ALARM.style(), "markersize": 6, "label": NO_ROOM}))
    return found


def _foot(panels: Sequence[Panel]) -> Foot | None:
    """The first place that does not fit, or the alarm that stopped the program."""
    for panel in panels:
        if panel.made.found is None and len(panels) == 1 and panel.run.ok:
            return Foot("no radius compensation in this program")
        stop = next((alarm for alarm in panel.run.alarms if not panel.run.ok and alarm.severity == "alarm"), None)
        if stop is not None:
            return Foot.of(stop)
        unit = panel.run.toolpath.unit
        for gouge in panel.run.gouges:
            lacks = f"{unit.figure(gouge.missing)} {unit.short} missing"
            what = f"line {gouge.line}: {GOUGES[gouge.kind].format(other=gouge.other)}, {lacks}"
            more = len(panel.run.gouges) - 1
            rest = f"; {several(more, 'more place')}" if more else ""
            largest = f"the largest radius is {unit.figure(gouge.largest, 1)} {unit.short}"
            fits = largest if gouge.largest >= NO_TOOL else "no tool fits here"
            return Foot(f"{what}; {fits}{rest}", colours.GOUGE)
    return None


def _in_words(panels: Sequence[Panel]) -> str:
    said = []
    for panel in panels:
        done = panel.made.rule.tolist()
        counts = [f"{done.count(rule)} {RULE_NAMES[rule]}" for rule in Rule if rule in done]
        gouges = f"; {len(panel.run.gouges)} gouges" if panel.run.gouges else ""
        said.append(f"{panel.title}: {', '.join(counts) or 'nothing compensated'}{gouges}")
    return "radius compensation: " + " | ".join(said)
