"""One view of compensated contours: the path by rules, offset vectors, tool discs, gouges hatched, names of corners."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property
from numbers import Integral, Real
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import EllipseCollection
from matplotlib.lines import Line2D

from mnclab.path.compensation.construction import Construction, GougedWall, gouged_walls
from mnclab.path.toolpath import RULE_NAMES, Index, Kind, Rule, Toolpath
from mnclab.show.plot import colours
from mnclab.show.plot.colours import LineStyle
from mnclab.show.plot.picture import View
from mnclab.show.plot.placing import dense, write_beside
from mnclab.show.plot.strokes import Array, Strokes, parted, strokes
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, shown

#: How rows look by their rule; rows along the contour are called after the corner at their end and look alike.
ROWS: dict[Rule, LineStyle] = {
    Rule.NONE: colours.UNCOMPENSATED,
    Rule.SIDE: colours.ALONG,
    Rule.OUTSIDE_ARC: colours.ROUND_CORNER,
    Rule.OUTSIDE_STRAIGHT: colours.ALONG,
    Rule.INSIDE: colours.ALONG,
    Rule.ENTRY: colours.ENTRY,
    Rule.EXIT: colours.EXIT,
    Rule.CHANGE: colours.CHANGE,
}
CORNERS = ROWS | {Rule.OUTSIDE_STRAIGHT: colours.STRAIGHT_CORNER, Rule.INSIDE: colours.INSIDE_CORNER}
NAMED = 8  # corners beyond which only the first of each rule has its name beside it
MANY = 400  # offset vectors beyond which they say nothing and are not drawn
COARSE, FINE = 90, 300  # points along the longer side of a box in which the cut-away area is looked for
CLOSE = 1500  # of lines that names keep off, across a view
MOST_DISCS = 10_000  # along a path
SQUARE = 0.16  # of the radius: the mark of a right angle


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
    def drawn(self) -> list[tuple[Toolpath, Strokes]]:
        """The tool-centre path and the programmed one, with their strokes."""
        return [(path, strokes(path)) for path in (self.run.toolpath, self.made.path)]

    @cached_property
    def rows(self) -> list[tuple[LineStyle, Array]]:
        """The tool-centre path by rule, points (m, 3) broken by nan."""
        path, drawn = self.drawn[0]
        looks = [*dict.fromkeys(ROWS.values()), colours.RAPID]
        look = np.array([looks.index(ROWS[Rule(rule)]) for rule in range(len(Rule))])
        group = look[path.rule[drawn.row]] if len(drawn.row) else drawn.row
        group[(path.kind[drawn.row] == Kind.RAPID) & (group == look[Rule.NONE])] = len(looks) - 1
        group[drawn.row < 0] = -1
        found = [(line, xyz) for line, xyz in zip(looks, parted(drawn.xyz, group, len(looks))) if len(xyz)]
        return [(line, xyz) for line, xyz in found if np.nansum(np.abs(np.diff(self.flat(xyz), axis=0))) > 0]

    @cached_property
    def contour(self) -> list[tuple[LineStyle, Array]]:
        """The programmed contour, and the programmed lines that lead to it and away."""
        if self.made.found is None:
            return []
        el, (path, drawn) = self.made.found.el, self.drawn[1]
        group_of = np.full(len(path) + 1, -1)
        group_of[el.rows[el.wall]], group_of[el.rows[el.entry | el.change | el.exit]] = 0, 1
        pieces = parted(drawn.xyz, np.where(drawn.row < 0, -1, group_of[drawn.row]), 2)
        return [(line, xyz) for line, xyz in zip((colours.CONTOUR, colours.LEAD), pieces) if len(xyz)]

    @cached_property
    def compensated(self) -> list[list[Array]]:
        """Cuts and rapids of the compensated rows, points (m, 3) broken by nan: of the tool-centre path, of the contour."""
        found = []
        for (path, drawn), on in zip(self.drawn, (self.run.toolpath.rule != Rule.NONE, self.made.compensated)):
            group = np.where((drawn.row >= 0) & on[drawn.row], np.isinf(path.feed[drawn.row]), -1)
            found.append(parted(drawn.xyz, group, 2))
        return found

    @cached_property
    def overcuts(self) -> list[GougedWall]:
        return list(gouged_walls(self.made, [gouge.step for gouge in self.run.gouges]))


def draw(ax: Axes, panel: Panel, discs: Any, vectors: bool) -> list[Array]:
    """Add all but the names to an axes; returns the outlines (n, 3) of what is hatched."""
    for line, xyz in [*panel.contour, *panel.rows]:
        ax.add_line(Line2D(*panel.flat(xyz).T, **line.style()))
    if discs is not False:
        _draw_discs(ax, panel, discs)
    if vectors and 0 < len(panel.made.of) <= MANY:
        _draw_vectors(ax, panel)
    outlines = [outline for overcut in panel.overcuts for outline in _hatch(ax, panel, overcut)]
    if panel.run.gouges:
        places = panel.flat(np.array([gouge.place for gouge in panel.run.gouges]))
        ax.add_line(Line2D(*places.T, **{**colours.ALARM.style(), "markersize": 6, "label": "_gouges"}))
    return outlines


def _draw_vectors(ax: Axes, panel: Panel) -> None:
    """One set of arrows for each rule, and a right angle where the tool enters and leaves square to the contour."""
    made = panel.made
    foot, tip, rule = panel.flat(made.foot), panel.flat(made.tip), made.rule[made.of]
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
            ax.add_line(Line2D(*panel.flat(_squares(made, code)).T, color=look.colour, linewidth=0.7, zorder=3.1))


def _squares(made: Construction, *rules: int) -> Array:
    """Right angles between the contour and offset vectors that stand alone at corners of some rules, nan between."""
    alone = np.bincount(made.of, minlength=len(made.rule)) == 1
    k = np.flatnonzero(alone[made.of] & np.isin(made.rule[made.of], rules))
    up = SQUARE * (made.tip[k] - made.foot[k])
    on = made.along[made.of[k]] * np.linalg.norm(up, axis=1)[:, None]
    return _strokes(made.foot[k] + on, made.foot[k] + on + up, made.foot[k] + up)


def _draw_discs(ax: Axes, panel: Panel, discs: Any) -> None:
    at, radius = disc_places(panel.run.toolpath, discs)
    if len(at):
        artist = EllipseCollection(
            2 * radius, 2 * radius, np.zeros(len(at)), units="xy", offsets=panel.flat(at), offset_transform=ax.transData,
            facecolors=colours.DISC + "18", edgecolors=colours.DISC, linewidths=0.6, zorder=2.0, label="_discs",
        )  # fmt: skip
        ax.add_collection(artist, autolim=False)


def disc_places(path: Toolpath, discs: bool | float | Sequence[int]) -> tuple[Array, Array]:
    """Where discs stand (m, 3), and their radii (m,): see `show.plot.compensation.compensation`."""
    rows = np.flatnonzero((path.rule != Rule.NONE) & path.is_motion)
    if discs is True or not isinstance(discs, Real):
        if discs is not True:
            if not isinstance(discs, Collection) or isinstance(discs, str) or not all(isinstance(n, Integral) for n in discs):
                raise Alarm(f"discs must be True, a distance in mm or lines, got {shown(discs)}")
            rows = rows[np.isin(path.line[rows], list(discs))]
        at, of = path.end[rows], rows
    else:
        check_number(discs, "the distance of discs (mm)", above=path.length / MOST_DISCS)
        if not len(rows):
            return np.empty((0, 3)), np.empty(0)
        drawn = strokes(path[rows])
        way = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(drawn.xyz, axis=0), axis=1) * (drawn.row[1:] >= 0)))
        stations = np.arange(0.0, way[-1] + 1e-9, float(discs))
        at = np.stack([np.interp(stations, way, column) for column in drawn.xyz.T], axis=1)
        of = rows[np.maximum(drawn.row[np.searchsorted(way, stations).clip(0, len(way) - 1)], 0)]
    radius = np.abs(path.radius[of])
    radius[path.rule[of] == Rule.EXIT] = np.abs(path.radius[np.maximum(of - 1, 0)])[path.rule[of] == Rule.EXIT]
    return at, radius


def _hatch(ax: Axes, panel: Panel, overcut: GougedWall) -> list[Array]:
    """What is cut away behind the contour: looked for in coarse steps, drawn in fine ones; returns its outlines."""
    low, high = overcut.box
    for count in (COARSE, FINE):
        step = float((high - low).max()) / (count - 1)
        u, v = np.arange(low[0], high[0] + step, step), np.arange(low[1], high[1] + step, step)
        grid = np.stack(np.meshgrid(u, v), axis=-1)
        depth = overcut.depth(grid.reshape(-1, 2)).reshape(grid.shape[:2])
        inside = grid[depth > -step]
        if not len(inside):
            return []
        low, high = inside.min(axis=0) - step, inside.max(axis=0) + step
    if not (depth > 0).any():
        return []
    flat = grid.reshape(-1, 2)
    rows = np.full(len(flat), overcut.row)
    seen = panel.flat(panel.made.view.to_space(rows, np.column_stack([flat, np.full(len(flat), overcut.height)])))
    x, y = seen[:, 0].reshape(depth.shape), seen[:, 1].reshape(depth.shape)
    area = ax.contourf(x, y, depth, levels=[0.0, np.inf], colors=[colours.GOUGE + "22"], hatches=["/////"], zorder=2.1)
    area.set(edgecolor=colours.GOUGE, linewidth=0.6, label="_gouge")
    outlines = []
    for ring in (np.asarray(ring) for path in area.get_paths() for ring in path.to_polygons(closed_only=False)):
        outlines.append(np.zeros((len(ring), 3)))
        outlines[-1][:, [panel.view.right, panel.view.up]] = ring
    return outlines


def write(ax: Axes, panel: Panel, outlines: Sequence[Array], names: bool) -> None:
    """What was done at the corners, in the words that the legend does not share among them: beside the tool centre there."""
    made = panel.made
    if not names or not len(made.rule):
        return
    k = np.flatnonzero(made.rule != Rule.SIDE)
    if len(k) > NAMED:
        k = np.sort(k[np.unique(made.rule[k], return_index=True)[1]])
    places, out = _corners(made, k)
    lines = [xyz for _, xyz in [*panel.contour, *panel.rows]]
    lines += [_strokes(made.foot, made.tip), _squares(made, Rule.ENTRY, Rule.EXIT, Rule.CHANGE), *outlines]
    rules = [Rule(rule) for rule in made.rule[k]]
    texts = [(RULE_NAMES[rule].split(", ")[-1].removesuffix(" corner"),) for rule in rules]
    along = [dense(panel.flat(xyz), float(np.ptp(ax.get_xlim())) / CLOSE) for xyz in lines]
    write_beside(ax, texts, panel.flat(places), [0.0] * len(k), panel.flat(out), along, [CORNERS[rule].colour for rule in rules])


def _corners(made: Construction, k: Index) -> tuple[Array, Array]:
    """Where the tool centre turns (n, 3) at some corners, on its arc the middle, and unit vectors (n, 3) to its side."""
    at, out = made.place[k].copy(), np.zeros((len(k), 3))
    for n, corner in enumerate(k.tolist()):
        mine = made.of == corner
        vectors, rule = made.tip[mine] - made.foot[mine], made.rule[corner]
        way, radius = vectors.sum(axis=0), float(np.linalg.norm(vectors[0]))
        size = max(float(np.linalg.norm(way)), 1e-9)
        out[n] = way / size
        at[n] = made.tip[mine].mean(axis=0)
        if rule in (Rule.OUTSIDE_ARC, Rule.OUTSIDE_STRAIGHT):
            at[n] = made.place[corner] + out[n] * (radius if rule == Rule.OUTSIDE_ARC else 2 * radius**2 / size)
    return at, out


def _strokes(*points: Array) -> Array:
    """Strokes through one point (n, 3) of each kind, as one line broken by nan."""
    return np.stack([*points, np.full_like(points[0], np.nan)], axis=1).reshape(-1, 3)
