"""What one view of a tool path shows, layer by layer: lines, marks, crosses, the part; then what depends on the scale."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, Polygon
from numpy.typing import NDArray

from mnclab.path.limits import Limits
from mnclab.path.toolpath import Kind, Mask, Toolpath
from mnclab.show import looks
from mnclab.show.plot import colours
from mnclab.show.plot.classes import Classes
from mnclab.show.plot.colours import LineStyle, Mark
from mnclab.show.plot.datums import DatumCross, crosses, segments, write_names
from mnclab.show.plot.holes import beside_holes
from mnclab.show.plot.lathe import Lathe, draw_blank, draw_chucks, draw_insert
from mnclab.show.plot.overlay import Overlay
from mnclab.show.plot.part import DEPTHS, draw_relief, relief
from mnclab.show.plot.picture import View, roomy
from mnclab.show.plot.placing import arrival, draw_arrival, draw_heads, spread
from mnclab.show.plot.probed import draw_felt
from mnclab.show.plot.strokes import Array, Strokes, line_of, parted
from mnclab.show.probed import Felt
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.workpiece import Workpiece

if TYPE_CHECKING:
    from mnclab.workpiece.milling.milled import Milled
    from mnclab.workpiece.turning.turned import Turned


MARKS = {Kind.DWELL: colours.DWELL, Kind.TOOL: colours.TOOL, Kind.STOP: colours.STOP}
MANY, SMALL, THIN = 30, 4.0, 0.7  # plunges; points of the crosses of more: those of an engraving would cover its letters
INSERT = 0.09  # edges of an insert, of the greatest side of the picture


class PathDrawing(NamedTuple):
    """What is drawn of a path in every view: lines (m, 3) broken by nan, marks (m, 3), crosses with names."""

    strokes: Strokes
    classes: Classes
    lines: list[tuple[LineStyle, Array]]
    marks: list[tuple[Mark, Array]]
    places: list[DatumCross]
    plunges: dict[View, Array]
    plunge: Mark
    arrows: bool
    stock: Blank | None
    lathe: Lathe | None
    part: Workpiece | None
    home: bool
    felt: Felt | None
    overlays: Sequence[Overlay]
    box: Box  # what is seen, margin included

    def seen(self, mark: Mark, view: View) -> Array:
        """Where a mark is seen in a view (m, 2); a hole that is seen from above needs none for its dwell."""
        axes = [view.right, view.up]
        found = np.concatenate([xyz[:, axes] for one, xyz in self.marks if one is mark])
        found = found[((found >= self.box[0][axes] - 1e-9) & (found <= self.box[1][axes] + 1e-9)).all(axis=1)]
        return beside_holes(self.overlays, view, found) if mark is colours.DWELL else found


def marks_of(path: Toolpath, stopped: bool, home: bool, gouged: Array | None = None) -> list[tuple[Mark, Array]]:
    """Marks and where they stand (m, 3); a path alone knows only in which rows it cuts into its contour."""
    found = [(mark, path.end[path.kind == kind]) for kind, mark in MARKS.items()]
    found += [(colours.GOUGED, path.end[path.gouge] if gouged is None else gouged)]
    found += [(colours.HOME if home else colours.START, path.start[:1])]
    found += [(colours.ALARM if stopped else colours.END, path.end[-1:])]
    return [(mark, places) for mark, places in found if len(places)]


def plunges_of(path: Toolpath, view: View) -> Array:
    """Where cuts go down along the tool and the line of sight, and would be invisible (m, 2)."""
    rows = np.flatnonzero(path.start[:, view.right] == path.end[:, view.right])
    rows = rows[(path.start[rows, view.up] == path.end[rows, view.up]) & (path.kind[rows] == Kind.LINE)]
    rows = rows[(np.abs(path.axis[rows][:, [view.right, view.up]]) < 1e-9).all(axis=1)]
    deep = 3 - view.right - view.up
    above = path.axis[rows, deep] if deep != 2 else 1.0  # a spindle stands above the table
    rows = rows[(path.end[rows, deep] - path.start[rows, deep]) * above < 0]
    return np.unique(path.end[rows][:, [view.right, view.up]], axis=0)


def draw_stock(ax: Axes, view: View, stock: Blank) -> list[Line2D]:
    """Fill the blank behind everything; returns its outlines, which are not added yet. A lathe's picture ends at its axis."""
    found = []
    for outline in stock.outline(view.right, view.up):
        line = np.maximum(outline, [-np.inf, 0]) if view.diameter else outline
        ax.add_patch(Polygon(line, facecolor=colours.BLANK_FACE, edgecolor="none", zorder=0.5, label="_blank"))
        found.append(Line2D(line[:, 0], line[:, 1], **colours.BLANK.style()))
    return found


def draw(ax: Axes, view: View, drawing: PathDrawing) -> list[Line2D]:
    """Add lines, marks and crosses to an axes; returns those that a legend names."""
    artists = [Line2D(xyz[:, view.right], xyz[:, view.up], **line.style()) for line, xyz in drawing.lines]
    artists += draw_stock(ax, view, drawing.stock) if drawing.stock else []
    plunges = drawing.plunges[view]
    if len(plunges):
        small = {"markersize": SMALL, "markeredgewidth": THIN} if len(plunges) > MANY else {}
        artists.append(Line2D(plunges[:, 0], plunges[:, 1], **drawing.plunge.style() | small))
    artists += [Line2D(*drawing.seen(mark, view).T, **mark.style()) for mark, _ in drawing.marks]
    artists += crosses(drawing.places, view)
    for artist in artists:
        ax.add_line(artist)
    artists += [artist for over in drawing.overlays for artist in over.draw(ax, view)]
    if drawing.part is not None:
        draw_under(ax, view, drawing.part)
    elif drawing.lathe is not None:
        draw_blank(ax, drawing.lathe)
    if drawing.lathe is not None:
        draw_chucks(ax, drawing.lathe.chucks)
    if view.diameter:
        ax.axhline(0.0, **{**colours.CENTRE_LINE.style(), "label": "_centre line"})
    return artists


def write(ax: Axes, view: View, drawing: PathDrawing, low: Array, high: Array) -> None:
    """Add what depends on the scale: rapids beside cuts, symbols beside each other, arrowheads and names."""
    axes = [view.right, view.up]
    moved, divided = beside(ax, drawing.strokes, drawing.classes, axes)
    for line in ax.lines:
        if line.get_label() == colours.RAPID.name:
            line.set_data(*once(ax, moved.xyz, divided.group, axes).T)
    occupied = [xyz[:, axes] for mark, xyz in drawing.marks if mark is colours.TOUCH]
    strokes = parted(moved.xyz, np.minimum(divided.group, 0), 1)
    if drawing.home:
        strokes.append(arrival(view, drawing.strokes.xyz[0], float((high - low).max())))
    occupied.append(spread(ax, list(ax.lines), *segments(ax, view, strokes)))
    if drawing.home:
        draw_arrival(ax, view, drawing.strokes.xyz[0], float((high - low).max()))
    if drawing.felt is not None:
        draw_felt(ax, view, drawing.felt, [xyz for _, xyz in drawing.lines], [xyz for _, xyz in drawing.marks])
    if drawing.lathe is not None:
        draw_insert(ax, drawing.lathe, INSERT * float((high - low).max()))
    if drawing.arrows:
        occupied.append(draw_heads(ax, view, moved, divided, low, high))
    for over in drawing.overlays:
        over.write(ax, view, [xyz for _, xyz in drawing.lines])
    if drawing.places:
        around = np.concatenate([np.empty((0, 2)), *occupied])
        write_names(ax, view, drawing.places, around, [xyz for _, xyz in drawing.lines])


# The part under a path: pale, so that the path stays what one looks at.

PALE = 0.62  # of white in what lies under a path


def draw_under(ax: Axes, view: View, workpiece: Workpiece) -> None:
    """The part in one view: from above in light and shadow, from the side its outline, of a lathe its half section."""
    if view.diameter:
        from mnclab.show.plot.part import draw_half

        draw_half(ax, cast("Turned", workpiece))
        return
    part = cast("Milled", workpiece)
    if 2 in (view.right, view.up):
        _silhouette(ax, part, view)
        return
    seen = relief(part)
    depth = float(part.cutting.stock.bounds[1, 2]) - seen.z
    image = _pale(depth / max(float(depth[seen.solid].max(initial=0.0)), 1e-9), seen.light[..., None])
    draw_relief(ax, seen, np.concatenate([image, seen.solid[..., None]], axis=2), order=0.6)


def _pale(depth: Array | float, light: Array | float = 1.0) -> Array:
    """The shades of what lies so deep, of the deepest, in some light."""
    return np.clip(PALE + (1 - PALE) * np.asarray(DEPTHS(0.75 * depth))[..., :3] * light, 0.0, 1.0)


def samples_of(workpiece: Workpiece, views: Sequence[View]) -> list[Patch]:
    """What a legend shows of a milled part under a path: where it is left, and what is cut, the deeper the darker."""
    if all(2 in (view.right, view.up) for view in views):
        return [Patch(facecolor=looks.METAL, edgecolor=looks.METAL_EDGE, label="part")]
    shades = {"part": 0.0, "cut": 1.0} if workpiece.removed > 0 else {"part": 0.0}
    faces = {name: to_hex(_pale(depth).tolist()) for name, depth in shades.items()}
    return [Patch(facecolor=face, edgecolor=looks.METAL_EDGE, label=name) for name, face in faces.items()]


def _silhouette(ax: Axes, part: Milled, view: View) -> None:
    """How high the part reaches behind each place that goes to the right, over the lower side of the blank."""
    along = 1 - view.right  # the axis of the map that one looks along: rows are Y, columns X
    places = (part.x, part.y)[view.right]
    axis = 0 if along == 1 else 1
    heights, floor = part.heights.max(axis=axis), part.floor.min(axis=axis)
    ends = part.cutting.stock.bounds[:, view.right]
    places = np.clip(np.repeat(places, 2) + np.tile([-0.5, 0.5], len(places)) * part.step, *ends)
    outline = np.concatenate([
        np.stack([places, np.repeat(heights, 2)], axis=1), np.stack([places, np.repeat(floor, 2)], axis=1)[::-1],
    ])  # fmt: skip
    ax.add_patch(Polygon(outline, facecolor=looks.METAL, edgecolor=looks.METAL_EDGE, linewidth=0.9, zorder=0.8, label="_part"))


# Rapids that run over one another are drawn once: two dashed lines on one line would fill each other's gaps.
# What is left would be a thin solid line, which grey print cannot tell from a cut.

RAPID = 0  # the class of rapids
LONG = 5.0  # points, of a rapid at least; pieces of a bent one are shorter
SHARED = 3.0  # points of the way over another at least
TURN, ASIDE = 1e-3, 0.15  # rad and points, by which strokes on one line may differ


def once(ax: Axes, xyz: Array, group: NDArray[np.integer], axes: list[int]) -> Array:
    """The rapids of a view, lines that end in points (n, 3) of their group (n,), as one line (k, 2) broken by nan, none of it
    over another; the limits of `ax` are final."""
    rapids = np.flatnonzero(group == RAPID)
    figure = ax.get_figure(root=True)
    flat = ax.transData.transform(xyz[:, axes]) / ((figure.dpi if figure else 72) / 72)
    rapids = rapids[np.hypot(*(flat[rapids] - flat[rapids - 1]).T) > LONG]
    if not len(rapids):
        return parted(xyz, group, 1)[0][:, axes]
    low, high, ends = _on_lines(flat, rapids)
    order = np.argsort(low)
    reached = np.maximum.accumulate(high[order])
    runs = np.split(order, np.flatnonzero(low[order][1:] > reached[:-1] - SHARED) + 1)
    group, pieces = group.copy(), []
    for run in runs:
        if len(run) > 1:
            group[rapids[run]] = -1
            whole = [ends[run[0], 0], ends[run[np.argmax(high[run])], 1]]
            pieces.append(np.concatenate([np.full((1, 2), np.nan), xyz[whole][:, axes]]))
    line = np.concatenate([parted(xyz, group, 1)[0][:, axes], *pieces])
    return line[1:] if len(line) and np.isnan(line[0]).all() else line


def _on_lines(flat: Array, rapids: NDArray[np.intp]) -> tuple[Array, Array, NDArray[np.intp]]:
    """Where each rapid (m,) begins and ends on its line, and the points (m, 2) there; each line has a range of its own."""
    begin, way = flat[rapids - 1], flat[rapids] - flat[rapids - 1]
    turn = np.arctan2(way[:, 1], way[:, 0])
    turn = (turn + TURN) % np.pi - TURN  # there and back are one line
    x, y = np.cos(turn), np.sin(turn)
    turned = _clusters(turn, np.zeros(len(turn)), TURN)
    line = _clusters(begin[:, 1] * x - begin[:, 0] * y, turned, ASIDE)
    places = np.stack([x * flat[each][:, 0] + y * flat[each][:, 1] for each in (rapids - 1, rapids)], axis=1)
    ends = np.stack([rapids - 1, rapids], axis=1)
    ends = np.where((places[:, 0] > places[:, 1])[:, None], ends[:, ::-1], ends)
    places = np.sort(places, axis=1) - places.min()
    places += (line * (places.max() + 2 * SHARED))[:, None]
    return places[:, 0], places[:, 1], ends


def _clusters(values: Array, within: NDArray[np.float64], gap: float) -> Array:
    """Numbers (m,) of values that follow one another by less than a gap, apart for each number of `within`."""
    order = np.lexsort((values, within))
    new = (np.diff(values[order]) > gap) | (np.diff(within[order]) > 0)
    found = np.empty(len(values))
    found[order] = np.concatenate([[0], np.cumsum(new)])
    return found


# Rapids that run over a cut are drawn beside it, to the right of their way, so that both are seen.
# Where several of them run the same way over one cut, each has a lane of its own, up to `LANES`.

CUTS = 1  # classes from here on are not covered by rapids
MOST, AT_ONCE = 500, 400_000  # rapids of a view that are looked at; pairs of rapid and cut looked at together
ON = 1.2  # points from line to line
OFF, NEXT, LANES = 2.4, 2.0, 2  # points from the cut to the first lane, and from lane to lane; how many lanes


def beside(ax: Axes, drawn: Strokes, found: Classes, axes: list[int]) -> tuple[Strokes, Classes]:
    """The strokes of a view whose coordinates `axes` are seen, with rapids beside the cuts; the limits of `ax` are final."""
    rapids = np.flatnonzero(found.group == RAPID)
    cuts = np.flatnonzero(found.group >= CUTS)
    figure = ax.get_figure(root=True)
    if not len(rapids) or not len(cuts) or figure is None:
        return drawn, found
    point = figure.dpi / 72
    flat = ax.transData.transform(drawn.xyz[:, axes]) / point
    rapids = rapids[np.hypot(*(flat[rapids] - flat[rapids - 1]).T) > LONG]
    if not 0 < len(rapids) <= MOST:
        return drawn, found
    over = _over(flat, rapids, cuts)
    rapids = rapids[over]
    if not len(rapids):
        return drawn, found
    off = OFF + NEXT * _lanes(flat, rapids)
    begin, way = flat[rapids - 1], flat[rapids] - flat[rapids - 1]
    length = np.hypot(*way.T)
    along = way / length[:, None]
    aside = off[:, None] * np.stack([along[:, 1], -along[:, 0]], axis=1)
    slant = np.minimum(off, length / 4)[:, None] * along
    places = np.stack([begin + aside + slant, begin + way + aside - slant], axis=1).reshape(-1, 2)
    xyz = np.repeat(drawn.xyz[rapids], 2, axis=0)
    xyz[:, axes] = ax.transData.inverted().transform(places * point)
    at = np.repeat(rapids, 2)
    moved = Strokes(np.insert(drawn.xyz, at, xyz, axis=0), np.insert(drawn.row, at, drawn.row[at]))
    return moved, found._replace(group=np.insert(found.group, at, RAPID))


def _over(flat: Array, rapids: NDArray[np.intp], cuts: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Which rapids (m,) run over a cut."""
    low, high = np.minimum(flat[cuts], flat[cuts - 1]), np.maximum(flat[cuts], flat[cuts - 1])
    seen = cuts[(high - low).max(axis=1) > SHARED]
    found = np.zeros(len(rapids), bool)
    step = max(1, AT_ONCE // max(len(seen), 1))
    for k in range(0, len(rapids), step):
        found[k : k + step] = (_shared(flat, rapids[k : k + step], seen) > SHARED).any(axis=1)
    return found


def _shared(flat: Array, some: NDArray[np.intp], others: NDArray[np.intp]) -> Array:
    """How much of the way strokes share with others on the same line (m, n), points; 0 on another line."""
    begin, way = flat[some - 1], flat[some] - flat[some - 1]
    length = np.hypot(*way.T)
    x, y = (way / length[:, None]).T[:, :, None]
    ends = [flat[each] - begin[:, None] for each in (others - 1, others)]
    a, b = (x * each[..., 0] + y * each[..., 1] for each in ends)
    aside = np.maximum(*(np.abs(x * each[..., 1] - y * each[..., 0]) for each in ends))
    shared = np.minimum(np.maximum(a, b), length[:, None]) - np.maximum(np.minimum(a, b), 0.0)
    return np.where(aside < ON, np.maximum(shared, 0.0), 0.0)


def _lanes(flat: Array, rapids: NDArray[np.intp]) -> NDArray[np.int64]:
    """The lane of each rapid (m,): the first that none before it has on the same line and in the same direction."""
    way = flat[rapids] - flat[rapids - 1]
    together = (_shared(flat, rapids, rapids) > 0) & (way @ way.T > 0)
    lanes = np.zeros(len(rapids), np.int64)
    for k in range(len(rapids)):
        taken = set(lanes[:k][together[k, :k]].tolist())
        lanes[k] = next((lane for lane in range(LANES) if lane not in taken), LANES - 1)
    return lanes


# The tool's width as a light band under its path, and when a path needs it: where its passes would run into a blot.

BAND_NAME, BAND_SHADE, BAND_ORDER = "width of the tool", "#d6e3f1", 1.2
THIN_BAND = 0.45  # of the usual width of a line: where passes lie close
CELL, DENSE, SHARE = 6, 1.7, 0.11  # points; ways through a cell that is dense; share of such cells in a dense path
MOST_STROKES, SAMPLES, CELLS = 20_000, 400_000, 100_000  # strokes under which a band is drawn unasked; points and cells looked at
MANY_RADII = 12  # radii of tools that have a band each


class Band(Line2D):
    """A line as wide as the tool, in data, whatever the scale is when it is drawn."""

    def __init__(self, xy: Array, radius: float) -> None:
        look: dict[str, Any] = {"color": BAND_SHADE, "solid_capstyle": "round", "solid_joinstyle": "round", "zorder": BAND_ORDER}
        super().__init__(*xy.T, label=f"_{BAND_NAME}", **look)
        self.radius = radius

    def draw(self, renderer: Any) -> None:
        """As any line, in the width that the scale gives it now."""
        if self.axes is not None and self.figure is not None:
            (x0, _), (x1, _) = self.axes.transData.transform([(0, 0), (2 * self.radius, 0)])
            self.set_linewidth(abs(x1 - x0) * 72 / self.figure.dpi)
        super().draw(renderer)


def draw_bands(ax: Axes, view: View, path: Toolpath, drawn: Strokes, cuts: Mask) -> None:
    """Add the bands of the strokes `cuts` (m,) of one view, largest tools first."""
    radii = path.radius[drawn.row]
    for radius in radii_of(path, drawn, cuts):
        (xyz,) = parted(drawn.xyz, np.where(cuts & np.isclose(radii, radius), 0, -1), 1)
        ax.add_line(Band(xyz[:, [view.right, view.up]], radius))


def radii_of(path: Toolpath, drawn: Strokes, cuts: Mask) -> list[float]:
    """The radii of the tools that cut, mm, largest first; none where no tool has a width."""
    radii = path.radius[drawn.row[cuts]]
    found = np.unique(np.round(radii[(radii > 0) & np.isfinite(radii)], 6))[::-1][:MANY_RADII].tolist()
    return list(found)


def around_bands(low: Array, high: Array, path: Toolpath, drawn: Strokes, cuts: Mask) -> tuple[Array, Array]:
    """A box (3,), mm, with the bands in it."""
    if not cuts.any():
        return low, high
    room = np.nan_to_num(path.radius[drawn.row[cuts]])[:, None] * (1, 1, 0)
    return np.fmin(low, (drawn.xyz[cuts] - room).min(axis=0)), np.fmax(high, (drawn.xyz[cuts] + room).max(axis=0))


def band_sample() -> Patch:
    """What the legend shows."""
    return Patch(facecolor=BAND_SHADE, edgecolor="none", label=BAND_NAME)


def dense(xy: Array, cuts: Mask, scale: float) -> bool:
    """Whether strokes to points `xy` (m, 2), mm, lie so close, at `scale` points to a mm, that they run into each other.

    They are sampled a point apart; where a cell of 6 points holds the points of nearly two ways, they do.
    """
    end = np.flatnonzero(cuts)
    if not len(end):
        return False
    begin, way = xy[end - 1], xy[end] - xy[end - 1]
    count = np.ceil(np.hypot(*way.T) * scale).astype(np.int64)
    if count.sum() > SAMPLES:
        return True
    which = np.repeat(np.arange(len(end)), count)
    share = (np.arange(len(which)) - np.repeat(np.cumsum(count) - count, count)) / count[which]
    low = np.nanmin(xy, axis=0)
    wide, tall = (int(side) // CELL + 1 for side in (np.nanmax(xy, axis=0) - low) * scale)
    if wide * tall > CELLS:
        return True
    x, y = (((begin[which, k] + share * way[which, k]) - low[k]) * scale for k in (0, 1))
    ink = np.zeros((wide * CELL, tall * CELL), bool)
    ink[x.astype(np.int64), y.astype(np.int64)] = True
    held = ink.reshape(wide, CELL, tall, CELL).sum(axis=(1, 3))
    return bool((held[held > 0] > DENSE * CELL).mean() > SHARE) if held.any() else False


# What a picture that follows a number keeps of the one before: its limits, and the former path as a thin grey ghost.

Box = tuple[Array, Array]  # the corners (3,) of what is shown, mm

DIGITS = 6  # of a mm: moves that differ by less are the same
MARGIN = 0.85  # of the room around what is shown may be used before the limits grow
SHRINKS = 5  # times the size of the new picture: limits so large are those of a slip of the finger


def held_box(low: Array, high: Array, limits: Box | None) -> Box:
    """The box of a picture after one with these limits: the same while the new one fits into it, margin included, else so
    large that both fit; its own where the one before was far larger."""
    if limits is None:
        return low, high
    least, most = (kept + MARGIN * (wide - kept) for kept, wide in zip(limits, roomy(*limits)))
    size, former = float((high - low).max()), float((limits[1] - limits[0]).max())
    if former > SHRINKS * size > 0:
        return low, high
    if (least <= low).all() and (high <= most).all():
        return limits
    return np.fmin(low, limits[0]), np.fmax(high, limits[1])


def held_axes(rows: Sequence[Axes], before: Sequence[Any] | None) -> list[Any]:
    """Set axes to the limits that they had before where what is drawn fits, else so that both fit; returns the limits."""
    if before is not None and len(before) == len(rows):
        for ax, kept in zip(rows, before):
            ax.set_xlim(_both(ax.get_xlim(), kept[0]))
            ax.set_ylim(_both(ax.get_ylim(), kept[1]))
    return [(ax.get_xlim(), ax.get_ylim()) for ax in rows]


def _both(now: tuple[float, float], kept: tuple[float, float]) -> tuple[float, float]:
    """Limits that hold both, unless those before were far larger."""
    return now if kept[1] - kept[0] > SHRINKS * (now[1] - now[0]) else (min(now[0], kept[0]), max(now[1], kept[1]))


def gone(former: Toolpath, path: Toolpath) -> Toolpath:
    """The moves of a former path that are not in the present one."""
    motion = former.motion
    return motion[~np.isin(_moves(motion), _moves(path.motion))]


def draw_ghost(ax: Axes, view: View, rows: Toolpath, rapids: Limits | None = None) -> None:
    """Former moves in one view, behind everything else: cuts and rapids by their dashes, both thin and grey."""
    for look, kinds in ((colours.GHOST, (Kind.LINE, Kind.ARC, Kind.PROBE)), (colours.GHOST_RAPID, (Kind.RAPID,))):
        line = line_of(rows, kinds, rapids)
        if len(line):
            ax.add_line(Line2D(line[:, view.right], line[:, view.up], **look.style()))


def _moves(path: Toolpath) -> np.ndarray:
    """Each row (n,) as one value that can be compared: where it begins and ends, and how it bends."""
    centre = np.nan_to_num(path.centre)
    rows = np.column_stack([path.start, path.end, centre, path.sweep, path.kind]).round(DIGITS) + 0.0
    return np.ascontiguousarray(rows).view(f"V{rows.shape[1] * rows.itemsize}").ravel()
