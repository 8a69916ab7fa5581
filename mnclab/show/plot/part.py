"""What is left of a blank: a milled part from above in light and shadow, with sections; of a turned one the half section."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, cast

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap, ListedColormap, to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, PathPatch, Polygon
from numpy.typing import NDArray

from mnclab.geometry.contours import Contour
from mnclab.path.inserts import as_drawn, lead_of
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Array, Mask
from mnclab.show import looks
from mnclab.show.plot import colours
from mnclab.show.plot.classes import number, ramp
from mnclab.show.plot.lathe import BAR, CHUCK, FINISHED, chucks_of, insert_patches, named_insert
from mnclab.show.plot.picture import SCALE, SIZE, SMALL, VIEWS, Foot, Picture, arrange, dress, figure_of, write_legend
from mnclab.show.plot.sections import (
    CARD,
    CHORD,
    FIXTURE,
    draw_cut,
    draw_fixtures,
    draw_section,
    held,
    mark_section,
    outline_of,
    sections_of,
)
from mnclab.show.plot.sizes import sized
from mnclab.text.alarm import Alarm
from mnclab.text.given import choice
from mnclab.workpiece.blank import depth_below
from mnclab.workpiece.collision import Collision
from mnclab.workpiece.cutting import CUTS
from mnclab.workpiece.milling.lattice import THIN, Lattice, lattice_of, rows_at
from mnclab.workpiece.turning.turned import Turned
from mnclab.workpiece.workpiece import Workpiece

if TYPE_CHECKING:
    from mnclab.workpiece.milling.milled import Milled
    from mnclab.workpiece.turning.turned import Turned


Single = NDArray[np.float32]

COLOURS = ("depth", "tool", "line")
#: Pale above and dark below, in grey print too; what nothing cut is paler still.
DEPTHS = LinearSegmentedColormap.from_list("depths", ["#f3efe2", "#cfe0cf", "#86bcc4", "#4a86b4", "#2c4f8c", "#1d2a5c"])
ROOM = 1.5  # how far the colours of depths go beyond the deepest place, within the blank: a single depth is no dark blot
BESIDE = 0.2  # of the blank's greatest side: how much of the fixtures around it is shown
FEW = 8  # tools or lines that a legend names one by one
EDGES = ((0.0, "#55524a", 0.35), (0.02, colours.INK, 0.75))  # from which part of the depth on, colour, width in points


@sized()
def plot_part(
    workpiece: Workpiece,
    ax: Axes | None = None,
    *,
    colour: str = "depth",
    section: str | Sequence[str] = (),
    at: float | Sequence[float] | None = None,
    collisions: Iterable[Collision] = (),
    size: tuple[float, float] = SIZE,
) -> Figure:
    """The part of a mill from above, lit from the upper left; of a lathe its half section.

    - `ax`: draw into these axes of one's own, without sections, legend and scale.
    - `colour` of a milled part: "depth" (mm below the top of the blank, or the round side of one that lies), the "tool" or
      the "line" that cut a place last.
    - `section`: planes "XZ", "YZ" or "XY", one or several, each at its place `at` (mm; default the middle of the
      blank): drawn hatched under the part, and where they lie in it.
    - `collisions`: those of a run, red crosses.
    - `size`: the greatest width and height in inches.
    """
    choice(colour, "colour", COLOURS)
    marks = looks.places_of(collisions)
    if workpiece.cutting.lathe:
        from mnclab.show.plot.part import plot_turned

        if section:
            raise Alarm("the picture of a turned part is its section through the axis; it has no other")
        return plot_turned(cast("Turned", workpiece), ax, marks, MARK, colour, size)
    part = cast("Milled", workpiece)
    seen, cuts = relief(part, CELLS if ax is None else _cells(ax)), sections_of(part, section, at)
    above = VIEWS["XY"]._replace(unit=part.cutting.path.unit)
    image, names, scale = _coloured(part, seen, colour)
    low, high = part.cutting.stock.bounds
    if ax is not None:
        _draw(ax, part, seen, image, marks)
        dress(ax, above)
        ax.autoscale_view()
        return figure_of(ax)
    views = [above, *(each.view for each in cuts)]
    handles: list[Any] = [Patch(facecolor=shade, edgecolor=colours.INK, linewidth=0.5, label=name) for name, shade in names]
    handles.append(Line2D([], [], **BLANK))
    if fixtures := held(part):
        handles.append(Patch(**FIXTURE, label="fixture"))
        room = BESIDE * float((high - low).max())
        low = np.maximum(np.min([low, *(each.bounds[0] for each in fixtures)], axis=0), low - room)
        high = np.minimum(np.max([high, *(each.bounds[1] for each in fixtures)], axis=0), high + room)
    handles += [Line2D([], [], **MARK)] if len(marks) else []
    labels = [str(each.get_label()) for each in handles]
    picture, axes = arrange(views, low, high, labels, Foot(told(part)), in_words(part), size, scale is not None)
    _draw(axes[0], part, seen, image, marks)
    for one, each in zip(axes[1:], cuts):
        draw_section(one, part, each)
        mark_section(axes[0], each, *part.cutting.stock.bounds)
    if scale:
        _scale(picture, *scale)
    write_legend(picture, handles, SCALE if scale else 0.0)
    return picture


BLANK = {**colours.BLANK.style(), "linestyle": (0, (6, 2)), "linewidth": 0.9}
MARK = colours.Mark("collision", looks.RED, "x", 9, True, 4.2).style()


def _draw(ax: Axes, part: Milled, seen: Relief, image: Array, marks: Array) -> None:
    draw_relief(ax, seen, image)
    draw_fixtures(ax, part, VIEWS["XY"])
    for outline in part.cutting.stock.outline(0, 1):
        ax.add_line(Line2D(outline[:, 0], outline[:, 1], **BLANK))
    if len(marks):
        ax.add_line(Line2D(marks[:, 0], marks[:, 1], **MARK))


def draw_relief(ax: Axes, seen: Relief, image: Array, order: float = 0.8) -> None:
    """Pixels, and the edges of walls as lines over them."""
    ax.imshow(image, extent=seen.box, origin="lower", interpolation="antialiased", zorder=order, aspect="auto")
    lines, high = seen.lattice.crests()
    whole = max(float(np.ptp(seen.z)), 1e-9)
    for (least, shade, width), most in zip(EDGES, (EDGES[1][0], np.inf)):
        some = lines[(high >= least * whole) & (high < most * whole)]
        ax.add_collection(LineCollection(list(some), colors=shade, linewidths=width, capstyle="round", zorder=order + 0.1))


def _coloured(part: Milled, seen: Relief, colour: str) -> tuple[Array, list[tuple[str, Any]], Any]:
    """The image (ny, nx, 4), the colours that a legend names, and a scale: title, ends and map, where there are many."""
    names: list[tuple[str, Any]] = []
    scale: Any = None
    if colour == "depth":
        depth = np.where(seen.solid, depth_below(part.cutting.stock, seen.places).reshape(seen.z.shape), 0.0)
        thick = float(np.ptp(part.cutting.stock.bounds[:, 2]))
        deepest = float(depth.max())
        beyond = max(min(ROOM * deepest, thick), 1e-9)
        shades = DEPTHS(depth / beyond)[..., :3]
        unit, shown = part.cutting.path.unit, ListedColormap(DEPTHS(np.linspace(0, deepest / beyond, 256)))
        scale = (f"depth, {unit.short}", 0.0, deepest / unit.length, shown)
        scale = scale if depth.any() else None  # nothing is deep where all holes go through
    else:
        row = seen.rows(part)
        values = part.cutting.of_rows(getattr(part.cutting.path, colour), row)
        known, index = np.unique(values[row >= 0], return_inverse=True)
        lively = LinearSegmentedColormap.from_list("lively", colormaps["viridis"](np.linspace(0.25, 0.98, 32)))
        shades = np.broadcast_to(np.array(to_rgb(looks.UNCUT)), (*row.shape, 3)).copy()
        share = index / max(len(known) - 1, 1)
        if len(known) > FEW:
            share = (known[index] - known[0]) / (known[-1] - known[0])
            scale = (colour, float(known[0]), float(known[-1]), lively)
        else:
            spread = np.arange(len(known)) / max(len(known) - 1, 1)
            names = [(f"{colour} {value}", lively(each)) for value, each in zip(known.tolist(), spread)]
        shades[row >= 0] = lively(share)[:, :3]
    image = np.clip(shades * seen.light[..., None], 0.0, 1.0)
    return np.concatenate([image, seen.solid[..., None]], axis=2), names, scale


FIGURE = 0.07  # inches, how wide a figure of a scale is


def _scale(picture: Picture, title: str, low: float, high: float, shades: Any) -> None:
    """A bar of colours above the views, with numbers."""
    width, height = picture.get_size_inches().tolist()
    long, thick = min(3.4, width - 1.9), 0.1
    ax = picture.add_axes((1.0 / width, 1 - (0.07 + thick) / height, long / width, thick / height))
    ax.imshow(np.linspace(0, 1, 256)[None], cmap=shades, extent=(low, high, 0, 1), aspect="auto")
    letter, told = FIGURE / long * (high - low), lambda value, _=None: number(round(value, 3))
    clear = [letter * (len(told(end)) + 3) for end in (low, high)]  # half of both numbers, whose inner one is short, and air
    inner = [each for each in ax.get_xticks().tolist() if low + clear[0] < each < high - clear[1]]
    ax.set(xticks=[low, *inner, high], yticks=[])  # its ends are told, and nothing stands in their way
    ax.tick_params(labelsize=SMALL, length=2, pad=1)
    ax.xaxis.set_major_formatter(told)
    ax.set_ylabel(title, fontsize=SMALL, rotation=0, ha="right", va="center", labelpad=5)
    ax.spines[:].set_linewidth(0.5)


# A milled part from above as light and shadow: pixels with their exact heights, lit from the upper left.
# A pixel takes the smaller of the slopes to its neighbours, so that an edge stays crisp; where they differ much the edge is
# drawn dark. A wall throws a short shadow.

CELLS, LEAST, PARTS = 360, 120, 3  # of the longer side, of small axes at least, and pixels of the side of a cell
LIGHT = np.array([-0.55, 0.6, 1.0])  # towards the light
LONG = 1 / 36  # of the longer side, the longest shadow
DARK, DIM, BRIGHT = 0.62, 0.72, 1.1  # the darkest slope, a shadow, the brightest slope; a level floor is 1
CREASE, LINE = 0.45, 0.6  # difference of two slopes at an edge, and how light that is
CURVED = 0.08  # of a cell: how far its corners may lie off one plane before its pixels are exact


class Relief(NamedTuple):
    """Heights (ny, nx) of pixels, mm, how light they are, where there is material; `box` x0, x1, y0, y1."""

    z: Array
    light: Array
    solid: Mask
    box: tuple[float, float, float, float]
    lattice: Lattice
    x: Array
    y: Array

    @property
    def places(self) -> Array:
        """The middle (ny nx, 3) of each pixel."""
        y, x = np.meshgrid(self.y, self.x, indexing="ij")
        return np.stack([x, y, self.z], axis=2).reshape(-1, 3)

    def rows(self, workpiece: Milled) -> NDArray[np.int64]:
        """The row that cut each pixel last (ny, nx), -1 where none did."""
        return rows_at(workpiece, *self.places.T).reshape(self.z.shape)


def _cells(ax: Axes) -> int:
    """As many as small axes show, at twice 100 pixels an inch."""
    figure: Any = ax.get_figure(root=True)
    inches = np.asarray(ax.get_window_extent().size) / figure.dpi
    return int(np.clip(200 * inches.max() / PARTS, LEAST, CELLS))


def relief(workpiece: Milled, cells: int = CELLS) -> Relief:
    """The part from above, with so many cells of the longer side."""
    low, high = workpiece.cutting.stock.bounds[:, :2]
    found = lattice_of(workpiece, float((high - low).max()) / cells)
    z, solid = _pixels(workpiece, found)
    size = np.array([found.x[1] - found.x[0], found.y[1] - found.y[0]]) / PARTS
    x, y = (ends[0] + side * (np.arange(count) + 0.5) for ends, side, count in zip((found.x, found.y), size, z.shape[::-1]))
    box = (float(low[0]), float(high[0]), float(low[1]), float(high[1]))
    return Relief(z, _lit(z, *size.tolist()), solid, box, found, x, y)


def _pixels(workpiece: Milled, found: Lattice) -> tuple[Array, Mask]:
    """Heights of pixels, and where there is material: between the nodes of a cell, and exact in a cell that a wall or an edge
    crosses."""
    ny, nx = len(found.y) - 1, len(found.x) - 1
    z, share = found.z.reshape(ny + 1, nx + 1), (np.arange(PARTS) + 0.5) / PARTS
    across = (z[:, :-1, None] * (1 - share) + z[:, 1:, None] * share).reshape(ny + 1, nx * PARTS)
    fine = across[:-1, None] * (1 - share[:, None]) + across[1:, None] * share[:, None]
    corners, edges = found.cells()
    bent, most = np.zeros(z.shape, dtype=bool), CURVED * float(found.x[1] - found.x[0])
    bent[1:-1] |= np.abs(np.diff(z, 2, axis=0)) > most
    bent[:, 1:-1] |= np.abs(np.diff(z, 2, axis=1)) > most
    broken = ((found.wall[edges] >= 0).any(axis=1) | bent.ravel()[corners].any(axis=1)).reshape(ny, nx)
    solid = found.solid.reshape(z.shape)[:-1, :-1]
    broken, solid = (np.repeat(np.repeat(each, PARTS, axis=0), PARTS, axis=1) for each in (broken, solid))
    j, i = np.nonzero(broken)
    low, side = (found.x[0], found.y[0]), (found.x[1] - found.x[0], found.y[1] - found.y[0])
    fine = fine.reshape(ny * PARTS, nx * PARTS)
    px, py = (start + (k + 0.5) / PARTS * each for start, k, each in zip(low, (i, j), side))
    top, floor = workpiece.surface.sides_at(px, py)
    fine[j, i], solid[j, i] = top, top - floor > THIN
    return fine, solid


def _lit(z: Array, dx: float, dy: float) -> Array:
    """How light pixels are: a level floor in the light is 1."""
    (across, right), (up, higher) = (_slopes(z, step, axis) for step, axis in ((dx, 1), (dy, 0)))
    east, north, _ = LIGHT / LIGHT[2]
    light = (1 - east * across - north * up) / np.sqrt(1 + across * across + up * up)
    light = np.clip(0.4 + 0.6 * light, DARK, BRIGHT)
    light[np.maximum(right, higher) > CREASE] *= LINE
    return np.asarray(light * (1 - (1 - DIM) * _shadow(z)))


def _slopes(z: Array, step: float, axis: int) -> tuple[Array, Array]:
    """The smaller of the slopes to both neighbours, and by how much they differ."""
    rise = np.diff(z, axis=axis) / step
    if not rise.size:
        return np.zeros_like(z), np.zeros_like(z)
    ends = [[(0, 0), (0, 0)], [(0, 0), (0, 0)]]
    ends[0][axis], ends[1][axis] = (1, 0), (0, 1)
    before, behind = (np.pad(rise, each, mode="edge") for each in ends)
    return np.where(np.abs(before) < np.abs(behind), before, behind), np.abs(before - behind)


def _shadow(z: Array) -> Single:
    """0 in the light to 1 in the shadow of something higher towards the light, softer farther away from it."""
    found = np.zeros(z.shape, np.float32)  # single numbers: a pixel has 256 shades
    low, high = float(z.min()), float(z.max())
    if high - low <= THIN:
        return found
    reach = min(round(LONG * max(z.shape)), *(side - 1 for side in z.shape))
    rise = (high - low) / max(reach, 1)  # a ray rises by the whole depth over the longest shadow
    stands, room = ((z - low) / rise).astype(np.float32), np.empty_like(found)
    for k in range(1, reach + 1):
        here = np.s_[: z.shape[0] - k, k:]
        above, most = room[here], 1 - 0.4 * k / reach
        np.subtract(stands[k:, : z.shape[1] - k], stands[here], out=above)  # of the pixel above it to the left
        above -= k
        above *= most / 2
        np.minimum(above, most, out=above)
        np.maximum(found[here], above, out=found[here])
    return found


# A turned part as a drawing has it: above the centre line hatched in section, below it from outside, in its chuck.
#
# Z goes to the right, the numbers beside the picture are diameters. The insert stands where the last cut leaves it.

OUTSIDE = "#e9e5d8"
JAW = (0.3, 0.55)  # length and height of a jaw that nobody gave, in radii of the bar
INSERT = 0.09  # edges of the insert, of the greatest side of the picture
BEYOND = 0.04  # of the length: how far the centre line goes on
LABELLED = 0.07  # of the length: the shortest cylinder with its diameter beside it
VIEW = VIEWS["ZX"]
FEW_CUTS = 6


def plot_turned(
    part: Turned, ax: Axes | None, marks: Array, mark: dict[str, Any], colour: str = "depth", size: tuple[float, float] = SIZE
) -> Figure:
    """Section and view of a turned part; `marks` (n, 3) are drawn as `mark`; `colour` "tool" or "line" on its outline."""
    radius, span = part.radius, part.high - part.low
    low, high = np.array([-radius, 0.0, part.low]), np.array([radius, 0.0, part.high])
    chucks = chucks_of(part.cutting.fixtures)
    known = bool(chucks) or not len(part.cutting)  # a part as drawn hangs in no chuck
    chucks = chucks if known else [_jaw(part)]
    for each in chucks:
        (z0, _), (z1, r1) = each.min(axis=0), each.max(axis=0)
        low, high = np.fmin(low, (-r1, 0, z0)), np.fmax(high, (r1, 0, z1))
    tip, tool = _last_cut(part)
    if tip is not None:
        low, high = np.fmin(low, tip), np.fmax(high, tip + 2.5 * INSERT * max(span, 2 * radius) * np.array([1.0, 0.0, 1.0]))
    names = [] if colour == "depth" else _colours(part, colour)
    handles: list[Any] = [
        Line2D([], [], **_BLANK),
        *([Patch(**CHUCK, label="chuck")] if chucks else []),
        *([named_insert()] if tip is not None else []),
        *(Line2D([], [], color=shade, linewidth=2.2, label=name) for name, shade, _ in names),
        *([Line2D([], [], **mark)] if len(marks) else []),
    ]
    unit = part.cutting.path.unit
    view = VIEW._replace(unit=unit)
    if ax is None:
        labels = [str(each.get_label()) for each in handles]
        picture, (own,) = arrange([view], low, high, labels, Foot(told(part)), in_words(part), size)
        write_legend(picture, handles)
    else:
        own = ax
        dress(own, view)
    own.yaxis.set_major_formatter(lambda value, _: number(abs(round(2 * value / unit.length, 9))))
    _draw_turned(own, part, chucks, known)
    for _, shade, lines in names:
        own.add_collection(LineCollection(lines, colors=shade, linewidths=2.2, capstyle="butt", zorder=2.6))
    if tip is not None:
        for patch in insert_patches(tool, (float(tip[2]), float(tip[0])), INSERT * max(span, 2 * radius)):
            own.add_patch(patch)
    if len(marks):
        own.add_line(Line2D(marks[:, 2], marks[:, 0] - part.axis, **mark))
    if ax is not None:
        own.autoscale_view()
    return figure_of(own)


_BLANK = {**colours.BLANK.style(), "linestyle": (0, (6, 2)), "linewidth": 0.9}


def _last_cut(part: Turned) -> tuple[Array | None, Tool]:
    """Where the tip stands after the last cut (3,), from the axis on, and its tool."""
    cutting = part.cutting
    rows = np.flatnonzero(cutting.cuts & np.isin(cutting.path.kind, CUTS))
    if not len(rows):
        return None, Tool()
    row = int(rows[-1])
    tool = as_drawn(cutting.tool(row), lead_of(cutting.path, np.arange(len(cutting)) == row))
    return cutting.path.end[row] - (part.axis, 0.0, 0.0), tool


def draw_half(ax: Axes, part: Turned) -> None:
    """The bar under a path, pale, and the finished profile in it."""
    for line in part.cutting.stock.outline(2, 0):
        line = np.maximum(line, [-np.inf, 0.0])
        ax.add_patch(Polygon(line, **BAR, zorder=0.6, label="blank"))
    if part.section:
        shape = outline_of(part.section)
        ax.add_patch(PathPatch(shape, **FINISHED, zorder=0.8, label="part"))


def _jaw(part: Turned) -> Array:
    """A jaw outside the left end of the bar, where the setup has no chuck."""
    long, high = JAW[0] * part.radius, JAW[1] * part.radius
    left, inner = part.low - long, part.grip
    return np.array([(left, inner), (part.low, inner), (part.low, inner + high), (left, inner + high)])


def _draw_turned(ax: Axes, part: Turned, chucks: list[Array], known: bool) -> None:
    for ring in chucks:
        for side in (1, -1):
            ax.add_patch(Polygon(ring * (1, side), **CHUCK, zorder=2.0, label="chuck"))
    stub = part.low - (0.0 if known else JAW[0] * part.radius)  # in a chuck that nobody gave the bar goes on
    ax.add_patch(Polygon(
        [(stub, -part.grip), (part.low, -part.grip), (part.low, part.grip), (stub, part.grip)],
        facecolor="#e6e2d6", edgecolor="#8c8778", linewidth=0.7, zorder=1.2,
    ))  # fmt: skip
    for loop in part.blank:
        points = loop.points_within(CHORD)
        for side in (1, -1):
            ax.add_line(Line2D(*(np.concatenate([points, points[:1]]) * (1, side)).T, **{**_BLANK, "label": "_blank"}))
    if part.section:
        draw_cut(ax, part.section, "part")
        _outside(ax, part)
    reach = BEYOND * (part.high - part.low)
    ends = [stub - reach, part.high + reach]
    ax.add_line(Line2D(ends, [0, 0], **{**colours.CENTRE_LINE.style(), "zorder": 2.8, "label": "_centre line"}))


def _outside(ax: Axes, part: Turned) -> None:
    """The lower half as one sees it: its outline, its edges across, and the diameters of its cylinders."""
    places = np.unique(np.concatenate([loop.points_within(CHORD)[:, 0] for loop in part.section]))
    around = np.repeat(places, 2) + np.tile([-1e-7, 1e-7], len(places))
    around = around[1:-1]
    outer = np.asarray(part.at(around))
    profile = np.concatenate([[(around[0], 0.0)], np.stack([around, -outer], axis=1), [(around[-1], 0.0)]])
    ax.add_patch(Polygon(profile, facecolor=OUTSIDE, edgecolor=colours.INK, linewidth=1.1, zorder=1.5, label="_outside"))
    edges, span, unit = [], part.high - part.low, part.cutting.path.unit
    for loop in part.section:
        ends = loop.points
        after = np.asarray(part.at(ends[:, 0] + 1e-7)), np.asarray(part.at(ends[:, 0] - 1e-7))
        for (z, r), *beside in zip(ends.tolist(), *after):
            if r > 0 and min(abs(r - each) for each in beside) < 1e-6:
                edges.append([(z, 0.0), (z, -r)])
        for (z0, r0), (z1, r1), sweep in zip(ends.tolist(), np.roll(ends, -1, axis=0).tolist(), loop.sweeps.tolist()):
            if sweep or abs(r0 - r1) > 1e-9 or abs(z1 - z0) < LABELLED * span or r0 <= 0:
                continue
            middle = (z0 + z1) / 2
            if abs(float(part.at(middle)) - r0) < 1e-6:
                text = f"⌀{number(round(2 * r0 / unit.length, unit.decimals - 1))}"
                card = CARD | {"facecolor": OUTSIDE}
                ax.annotate(text, (middle, -r0 / 2), ha="center", va="center", fontsize=SMALL, bbox=card, zorder=3.0)
    ax.add_collection(LineCollection(edges, colors=colours.INK, linewidths=0.6, zorder=1.7))


def _colours(part: Turned, colour: str) -> list[tuple[str, str, list[Array]]]:
    """Name, colour and pieces of the outline by the tool or the line that cut them."""
    column = getattr(part.cutting.path, colour)
    found: dict[int, list[Array]] = {}
    for loop, rows in zip(part.section, part.rows):
        for k, row in enumerate(rows.tolist()):
            if row >= 0:
                element = Contour([loop.starts[k], loop.ends[k]], [loop.bulge[k], 0.0], closed=False)
                found.setdefault(int(column[row]), []).append(element.points_within(CHORD))
    values = sorted(found)
    shades = ramp(len(values))
    if len(values) <= FEW_CUTS:
        return [(f"{colour} {value}", shade, found[value]) for value, shade in zip(values, shades)]
    groups = np.array_split(np.array(values), FEW_CUTS)
    return [
        (f"{colour}s {group[0]} to {group[-1]}", shade, [piece for value in group.tolist() for piece in found[value]])
        for group, shade in zip(groups, ramp(FEW_CUTS))
    ]


def told(part: Workpiece) -> str:
    """How a part was found, how exact it is, what was removed, and what is to be noted."""
    return "\n".join([f"{part.method}{part.error_told}; {_volume(part, part.removed)} removed", *part.notes])


def in_words(part: Workpiece) -> str:
    """What a person who cannot see the picture is told."""
    return f"the part: {_volume(part, part.volume)} left, {_volume(part, part.removed)} removed"


def _volume(part: Workpiece, volume: float) -> str:
    """A volume in mm³ with three decimals, or figures of a tiny one; of a program in inches in in³, with as many figures."""
    unit = part.cutting.path.unit
    if unit.length == 1:
        return f"{volume:.3g} mm³" if 0 < volume < 0.1 else f"{volume:.3f} mm³"
    return f"{volume / unit.length**3:.6g} {unit.short}³"
