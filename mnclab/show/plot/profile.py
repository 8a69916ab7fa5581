"""Feed-rate profiles as pictures: over time or path length, on the path, and beside the lines of the program."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from textwrap import wrap
from typing import Any, NamedTuple, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from numpy.typing import NDArray

from mnclab.path.listing import figure
from mnclab.path.places import divided
from mnclab.path.profile import Profile
from mnclab.path.toolpath import Kind
from mnclab.show.plot import colours
from mnclab.show.plot.layers import held_axes
from mnclab.show.plot.overlay import line, texts
from mnclab.show.plot.path import plot_path
from mnclab.show.plot.picture import (
    CARD,
    SHARE,
    SMALL,
    Picture,
    View,
    calm,
    clear,
    figure_of,
    legend_height,
    legend_rows,
    rows_within,
    stacked,
    write_cut_off,
    write_legend,
)
from mnclab.show.plot.sizes import sized
from mnclab.show.plot.strokes import Array, Strokes
from mnclab.text.columns import parts
from mnclab.text.given import choice

SIZE = (7.0, 6.0)  # inches
FINE, MANY = 9, 20_000  # points of a piece, as long as all of them are not more than so many
COLUMNS = 3000  # of a curve of more pieces than that: more than a page at 300 points an inch shows
BAND, FEW = 500, 60  # steps of the band that says what holds the speed; boxes of it that are hatched
LINES, LETTERS, FURTHER = 30, 36, 0.65  # of a program beside their bars, how wide each is, and rows of a further line of it
FLAT = View(0, 1)  # of points (time or path, feed), whose rows can be clicked on
RAPIDS = 3  # times the fastest cut, beyond which rapids and retractions are cut off
PARTS = 3000  # of a path that is coloured by the speed reached
HIDDEN_LIMIT = colours.LIMIT.style() | {"label": "_limit"}  # not in the legend


Some = NDArray[np.int64] | slice  # of the pieces of a profile
ALL = slice(None)


class Curve(NamedTuple):
    """Points (k,) of a profile: time, place, speed, acceleration and jerk, the piece each belongs to, and the one whose
    acceleration it has: in a brief piece, the one before it."""

    t: Array
    s: Array
    v: Array
    a: Array
    j: Array
    piece: NDArray[np.int64]
    lasting: NDArray[np.int64]

    def counted(self, length: float) -> Curve:
        """The same in units of so many mm."""
        return Curve(self.t, self.s / length, self.v / length, self.a / length, self.j / length, *self[5:])


WITHIN = 1e-9  # of a piece, from its ends
BRIEF = 1e-4  # s, less than a control counts in: a step of the feed under G96, or what rounding leaves


def drawn_pieces(profile: Profile, over: str, axes: bool = False) -> Some:
    """The pieces that a picture shows, with `axes` of X, Y and Z too. Where they are too many, those at the ends of each of its
    columns and those with the least and the greatest of each curve in it: the curves look as all of them do."""
    p, rows = profile.pieces, profile.plan.rows
    if len(p.row) <= MANY:
        return ALL
    x = p.t if over == "time" else p.s
    first = np.unique(np.searchsorted(x[:-1], np.linspace(x[0], x[-1], COLUMNS, endpoint=False)))
    wide = np.diff(first, append=len(p.row))
    kept = np.zeros(len(p.row), dtype=bool)
    kept[first] = kept[first + wide - 1] = True
    cuts, feed = _cuts(profile)[p.row], _of_pieces(profile, rows.feed)
    feed[~np.isfinite(feed)] = np.nan
    curves = (p.v[:-1], p.v[1:], p.a, p.a + np.diff(p.t) * p.j, p.j, feed, _of_pieces(profile, rows.a))
    of_cuts = (np.where(cuts, each, np.nan) for each in (p.v[1:], feed))
    for values in chain(curves, of_cuts, _of_axes(profile) if axes else ()):
        for least in (np.fmin, np.fmax):
            found = np.flatnonzero(values == np.repeat(least.reduceat(values, first), wide))
            kept[found[np.diff(np.searchsorted(first, found, "right"), prepend=0) > 0]] = True  # one in each column
    return np.flatnonzero(kept)


def _of_axes(profile: Profile) -> NDArray[np.float32]:
    """Speed and acceleration of X, Y and Z at both ends of all pieces (12, m)."""
    begin, lasts = profile.t[:-1], np.diff(profile.t)
    found = np.empty((12, len(lasts)), dtype=np.float32)
    for some in parts(len(lasts)):
        now = [profile.at(begin[some] + share * lasts[some]) for share in (WITHIN, 1 - WITHIN)]  # within the piece
        found[:, some] = np.hstack([each for one in now for each in (one.velocity, one.acceleration)]).T
    return found


THINNED = f"thinned: least and greatest in {COLUMNS} columns"


def thinned(some: Some) -> list[Line2D]:
    """What a legend says of curves that are drawn of `some` pieces."""
    return [] if isinstance(some, slice) else [Line2D([], [], linestyle="none", label=THINNED)]


def curve(profile: Profile, over: str = "path", some: Some = ALL) -> Curve:
    """Enough points of a profile, or of `some` of its pieces, for a picture: both ends of every piece, and some between."""
    p = profile.pieces
    m = len(p.row)
    straight = over == "time" and not p.j.any()
    points = 2 if straight else max(2, min(FINE, MANY // max(m, 1)))
    share = np.linspace(0, 1, points)
    lasts, piece = np.diff(p.t), np.arange(m)
    lasting = np.maximum.accumulate(np.where(lasts > BRIEF, piece, 0))[some]  # else as the piece before
    piece, dt = piece[some], lasts[some, None] * share
    a, j, v = p.a[lasting, None], p.j[lasting, None], p.v[piece, None]
    place = p.s[piece, None] + dt * (v + dt * (a / 2 + dt * j / 6))
    speed = np.maximum(v + dt * (a + dt * j / 2), 0.0)
    t, s, v, a, j = (one.ravel() for one in (p.t[piece, None] + dt, place, speed, a + dt * j, j + 0 * dt))
    return Curve(t, s, v, a, j, np.repeat(piece, points), np.repeat(lasting, points))


def holds(profile: Profile, some: Some = ALL) -> NDArray[np.int64]:
    """What holds the speed in `some` pieces (k,): an index into `colours.HOLDS`."""
    p = profile.pieces
    at = {name: k for k, name in enumerate(colours.HOLDS)}
    feed, cap = (_of_pieces(profile, values, some) for values in (profile.plan.rows.feed, np.sqrt(profile.plan.rows.cap)))
    v, kind = p.v[:-1][some], profile.path.kind[p.row[some]]
    found = np.full(len(v), at["corner"])
    found[v >= cap * (1 - 1e-9)] = at["axis speed"]
    found[(kind == Kind.ARC)] = at["turning"]
    found[(kind == Kind.RAPID)] = at["axis speed"]
    found[v >= feed * (1 - 1e-9)] = at["feed"]
    found[p.a[some] != 0] = at["acceleration"]
    found[p.j[some] != 0] = at["jerk"]
    found[(kind > Kind.PROBE)] = at["standing"]
    return found


def _cuts(profile: Profile) -> NDArray[np.bool_]:
    """Which rows (n,) are no rapids and no retractions out of the material."""
    path = profile.path
    up = path.end - path.start
    rises = (path.kind == Kind.LINE) & (up[:, 2] > 0) & ~up[:, :2].any(axis=1) & (not path.lathe)
    return ~((path.kind == Kind.RAPID) | rises)


def _of_pieces(profile: Profile, values: Array, some: Some = ALL) -> Array:
    """A value for pieces (k,) from those of planned rows: an arc, or a row at constant cutting speed, is planned in parts."""
    p, plan = profile.pieces, profile.plan
    row = p.row[some]
    if plan.row is None:
        return values[row]
    first, last = np.searchsorted(plan.row, row), np.searchsorted(plan.row, row, "right") - 1
    part = np.searchsorted(np.cumsum(plan.rows.length), ((p.s[:-1] + p.s[1:]) / 2)[some])
    return values[np.clip(part, first, last)]


@sized(tall=SIZE[1] / SIZE[0])
def plot_profile(
    profile: Profile,
    ax: Axes | None = None,
    *,
    over: str = "time",
    axes: bool = False,
    limits: bool = True,
    whole: bool = False,
    size: tuple[float, float] = SIZE,
    under: Profile | None = None,
    held: Any = None,
) -> Figure:
    """Feed, acceleration and, under a limit, jerk along the path. Returns the figure, which Jupyter shows.

    - `ax`: draw only the feed, into these axes of one's own.
    - `over`: "time" (s) or "path" (its length). Lengths count in the unit of the program.
    - `axes`: also the speed and acceleration of X, Y and Z.
    - `limits`: dotted lines at what the axes allow along the path, in a slant more than along one of them, and a band below the
      feed that says what holds the speed: the acceleration, the jerk, a corner, the turning on an arc, the speed of an axis, or
      nothing but the programmed feed.
    - `whole`: show the rapids up to their full speed. Otherwise the scale ends a little above the fastest cut where
      rapids are more than three times as fast and would flatten it, and a note says how far they go.
    - `size`: width and height in inches.
    - `under`: another profile, thin and grey behind this one; `held`: the `box` of the picture before, whose axes are kept
      while this profile fits into them.

    Bars on the time axis are stops, triangles corners that slow the tool.
    """
    over = choice(over, "over", ("time", "path"))
    length, unit = profile.path.unit.length, profile.path.unit.short
    some = drawn_pieces(profile, over, axes)
    drawn = curve(profile, over, some).counted(length)
    x, below = (drawn.t, "time, s") if over == "time" else (drawn.s, f"path, {unit}")
    if ax is not None:
        _feed(ax, profile, drawn, x, over, limits, whole)
        if thinned(some):
            ax.text(0.005, 0.98, THINNED, transform=ax.transAxes, ha="left", va="top", fontsize=SMALL - 1, bbox=CARD, zorder=5)
        ax.set_xlabel(below, fontsize=SMALL + 1)
        if not ax.get_ylabel():
            ax.set_ylabel(f"feed, {unit}/min", fontsize=SMALL + 1)
        return figure_of(ax)
    titles = [f"feed, {unit}/min", f"acceleration, {unit}/s²"]
    titles += [f"jerk, {unit}/s³"] if len(profile.plan.rows.j) else []
    titles += [f"axis speed, {unit}/min", f"axis acc., {unit}/s²"] if axes else []
    heights = [2.2 if k == 0 else 1.35 for k in range(len(titles))]  # inches, at least
    causes = ", ".join(f"{cause} {figure(seconds, 2)} s" for cause, seconds in profile.time_by("cause").items())
    said = f"feed-rate profile: {figure(profile.time, 2)} s; {causes}"
    usual = 1.2 + 1.05 * sum(heights) if size == SIZE else 0.0
    picture = Picture((size[0], max(size[1], usual, 1.2 + 0.48 * sum(heights))), said)
    rows = stacked(picture, heights, 0.7, left=0.95)
    for each, title in zip(rows, titles):
        each.set_ylabel(title.replace(", ", ",\n"), fontsize=SMALL)
    handles = _feed(rows[0], profile, drawn, x, over, limits, whole)
    standing = profile.path.kind[profile.move[drawn.lasting]] > Kind.PROBE
    any_way = profile.limits.axes("acceleration").min()
    most = np.where(standing, any_way, _of_pieces(profile, profile.plan.rows.a, drawn.lasting)) / length
    rows[1].plot(x, drawn.a, **{**colours.REACHED.style(), "label": "_a"})
    if limits:
        handles += rows[1].plot(x, most, **colours.LIMIT.style())
        rows[1].plot(x, -most, **HIDDEN_LIMIT)
    if len(profile.plan.rows.j):
        rows[2].plot(x, drawn.j, **{**colours.REACHED.style(), "label": "_j"})
    if axes:
        handles += _axes(rows[-2:], profile, drawn, x, limits)
    handles += thinned(some)
    rows[-1].set_xlabel(below, fontsize=SMALL + 1)
    if under is not None:
        before = curve(under, over, drawn_pieces(under, over)).counted(length)
        for each, values in zip(rows, (before.v * 60, before.a, before.j)[: 3 if len(profile.plan.rows.j) else 2]):
            each.plot(before.t if over == "time" else before.s, values, **colours.GHOST.style(), scaley=False)
    picture.box = held_axes(rows, held)
    picture.seen = [(rows[0], FLAT, profile.path, Strokes(np.c_[x, drawn.v * 60, 0 * x], profile.move[drawn.piece]))]
    width, height = picture.get_size_inches().tolist()
    lines = legend_rows([str(each.get_label()) for each in handles], width)
    above = 0.12 + legend_height(min(len(lines), rows_within(SHARE * height)))
    cast(GridSpec, rows[0].get_gridspec()).update(top=1 - above / height)
    write_legend(picture, handles, 0.01, 2.2)
    return picture


@sized(also=plot_path)
def plot_reached(profile: Profile, **options: Any) -> Figure:
    """The path coloured by the feed that is reached, wide where it is slow, corners marked with their feed.

    The options are those of `mnclab.show.plot.path.plot_path`.
    """
    path, drawn = profile.path, curve(profile)
    total = max(path.length, 1e-9)
    counts = np.where(np.isin(path.kind, (Kind.LINE, Kind.ARC)), np.ceil(path.lengths / total * PARTS), 1)
    parts, _ = divided(path, np.clip(counts, 1, PARTS).astype(np.int64))
    middle = np.cumsum(parts.lengths) - parts.lengths / 2
    reached = np.interp(middle, drawn.s, drawn.v) * 60 if len(drawn.s) else np.zeros(len(parts))
    cut = np.isfinite(parts.feed)
    shown = parts.replace(feed=np.where(cut, reached, parts.feed))
    return plot_path(shown, **{"colour": "feed", "arrows": False, "overlays": (slow_corners(profile),), **options})


@sized()
def plot_lost(profile: Profile, ax: Axes | None = None, *, most: int = LINES, width: float = 7.0) -> Figure:
    """Seconds of each line beside its text: what feed and rapid need, dwells and changes, and what the machine adds.

    Of a long program the `most` lines that lose the most; `width` in inches.
    """
    path = profile.path
    lost = profile.lost + np.where(path.kind == Kind.TOOL, profile.seconds, 0.0)  # a tool change cuts nothing
    own = path.program == 0
    lines, where = np.unique(path.line[own], return_inverse=True)
    extra = np.bincount(where, lost[own], len(lines))
    whole = np.bincount(where, profile.seconds[own], len(lines))
    keep = np.sort(np.argsort(-extra - 1e-9 * whole, kind="stable")[:most])
    lines, extra, whole = lines[keep], extra[keep], whole[keep]
    texts = [_text(profile, int(line)) for line in lines]
    tall = np.array([max(1.0, FURTHER * (text.count("\n") + 1)) for text in texts])  # rows of the picture
    picture = None
    if ax is None:
        room = 0.3 + 0.068 * max((len(part) for text in texts for part in text.split("\n")), default=4)
        height = 0.75 + 0.2 * max(float(tall.sum()), 2.0)
        said = f"time lost in {len(lines)} lines, {extra.sum():.3f} of {whole.sum():.3f} s"
        picture = Picture((width, height), said)
        ax = picture.add_axes((room / width, 0.45 / height, 1 - (room + 0.2) / width, 1 - 0.75 / height))
    place = np.cumsum(tall) - tall / 2
    parts = (("as programmed", whole - extra, 0.0, colours.USEFUL), ("lost", extra, whole - extra, colours.LOST))
    bars = []
    for name, values, left, (shade, hatch) in parts:
        look: dict[str, Any] = {"hatch": hatch, "edgecolor": colours.PAPER, "label": name}
        ax.barh(place, values, left=left, height=0.72, color=shade, **look)
        bars.append(Patch(facecolor=shade, **look))
    ax.set_yticks(place, texts, fontfamily="monospace", parse_math=False, multialignment="left")
    ax.set_ylim(float(tall.sum()) + 0.1, -0.1)
    ax.set_xlim(0, max(1.05 * float(whole.max(initial=0.0)), 1e-3))
    calm(ax)
    ax.grid(False, axis="y")
    ax.set_xlabel("time, s", fontsize=SMALL + 1)
    if picture is None:
        return figure_of(ax)
    write_legend(picture, bars, 0.01, 2.2)
    return picture


# --- parts of the pictures -------------------------------------------------------------------------------------------


def _feed(ax: Axes, profile: Profile, drawn: Curve, x: Array, over: str, limits: bool, whole: bool) -> list[Any]:
    """Programmed and reached feed, stops, corners, and the band of what holds the speed; returns legend entries."""
    unit = profile.path.unit
    path, row = profile.path, profile.move[drawn.piece]
    feed = _of_pieces(profile, profile.plan.rows.feed, drawn.piece) / unit.length
    known = np.isfinite(feed) & (path.kind[row] <= Kind.PROBE)
    wanted, reached = np.where(known, feed * 60, np.nan), drawn.v * 60
    lines: list[Any] = ax.plot(x, wanted, **colours.WANTED.style()) + ax.plot(x, reached, **colours.REACHED.style())
    fast, most = float(reached.max(initial=0.0)), float(np.nanmax(wanted, initial=0.0))
    rapid, cuts = path.kind[row] == Kind.RAPID, _cuts(profile)[row]
    cut = float(reached[cuts].max(initial=0.0))
    top = 1.08 * max(fast, most, 1e-3)
    if not np.isfinite(top) or top > 40 * max(fast, 1e-3):
        top = 1.08 * fast  # a feed far beyond what is reached would flatten all else
    if not whole and fast > RAPIDS * cut > 0:
        top = clear(ax, min(max(cut, float(np.nanmax(wanted[cuts], initial=0.0))), RAPIDS * cut), 0.14)
        fastest = "rapids" if rapid[np.argmax(reached)] else "retractions"
        write_cut_off(ax, f"{fastest} reach {fast:.0f} {unit.short}/min along the path")
    p = profile.pieces
    at = p.t if over == "time" else p.s / unit.length
    ax.set_xlim(0, max(float(at[-1]), 1e-9) if len(at) else 1.0)
    ax.set_ylim(-0.14 * top if limits else -0.03 * top, top)
    stops = at[np.flatnonzero(p.v <= 1e-9)]
    if len(stops) <= 300:
        lines += ax.plot(stops, 0 * stops, **colours.STANDS.style())
    turn = slow_at(profile)
    if 0 < len(turn) <= MOST:
        lines += ax.plot(at[turn], p.v[turn] * 60 / unit.length, **colours.SLOW_CORNER.style())
    if not limits or not len(p.row):
        return lines
    piece, edges = np.arange(len(p.row)), at
    if len(piece) > BAND:  # more pieces than the band can show
        edges = np.linspace(at[0], at[-1], BAND + 1)
        middle = (edges[1:] + edges[:-1]) / 2
        piece = np.clip(np.searchsorted(at, middle, "right") - 1, 0, len(p.row) - 1)
    which = holds(profile, piece)
    for k, (name, (shade, hatch)) in enumerate(colours.HOLDS.items()):
        first, last = np.flatnonzero(np.diff(which == k, prepend=False, append=False)).reshape(-1, 2).T
        if not len(first) or name == "standing":
            continue
        low, high = -0.12 * top, -0.05 * top
        boxes = [[(a, low), (b, low), (b, high), (a, high)] for a, b in zip(edges[first], edges[last])]
        looks: dict[str, Any] = {"facecolor": shade, "edgecolor": colours.PAPER, "linewidth": 0.0}
        ax.add_collection(PolyCollection(boxes, **looks, hatch=hatch if len(boxes) < FEW else "", zorder=2))
        lines.append(Patch(**looks, hatch=hatch, label=f"held by {name}"))
    return lines


def _axes(rows: list[Axes], profile: Profile, drawn: Curve, x: Array, limits: bool) -> list[Line2D]:
    begin, end = profile.t[:-1][drawn.piece], profile.t[1:][drawn.piece]
    now = profile.at(np.clip(drawn.t, begin + WITHIN * (end - begin), end - WITHIN * (end - begin)))  # within the piece
    length = profile.path.unit.length
    limit = profile.limits.axes("rapid") * 60 / length, profile.limits.axes("acceleration") / length
    handles = []
    for k, look in enumerate(colours.AXES):
        if not np.abs(now.velocity[:, k]).max(initial=0.0) > 1e-9:
            continue
        handles += rows[0].plot(x, now.velocity[:, k] * 60 / length, **look.style())
        rows[1].plot(x, now.acceleration[:, k] / length, **{**look.style(), "label": f"_{look.name}"})
        for row, most in zip(rows if limits else [], limit):
            low, high = row.get_ylim()
            for value in (most[k], -most[k]):
                if low <= value <= high:
                    row.axhline(value, **HIDDEN_LIMIT)
    return handles


def _text(profile: Profile, line: int) -> str:
    text = " ".join(profile.source.line_text(line).split()) if profile.source is not None else ""
    return f"{line:>4}  " + f"\n{6 * ' '}".join(wrap(text, LETTERS) or [""])


# Corners at which the tool is slower than before and behind, over the path: a triangle and the feed that is left.

MOST, NAMED = 60, 12  # corners that are marked; with a number


class SlowCorners(NamedTuple):
    """Places (n, 3), mm, slowest first, and what is written there."""

    places: Array
    said: Sequence[str]

    def box(self, low: Array, high: Array) -> tuple[Array, Array]:
        return low, high

    def names(self, views: Sequence[View]) -> list[str]:
        return [colours.SLOW_CORNER.name] if len(self.places) else []

    def draw(self, ax: Axes, view: View) -> list[Any]:
        return [line(ax, view, self.places, colours.SLOW_CORNER)] if len(self.places) else []

    def write(self, ax: Axes, view: View, lines: Sequence[Array]) -> None:
        """The feed at the slowest of them, in the unit of the path a minute."""
        places = self.places[: len(self.said)]
        out = (places - places.mean(axis=0))[:, [view.right, view.up]] if len(places) else np.empty((0, 2))
        texts(ax, view, zip(self.said, places, out), lines, colours.SLOW_CORNER.colour, mark=3.0)


def slow_at(profile: Profile) -> np.ndarray:
    """Nodes (k,) of the pieces at which a corner slows the tool without stopping it."""
    p = profile.pieces
    turn = np.zeros(len(p.v), dtype=bool)
    turn[1:-1] = (p.row[1:] != p.row[:-1]) & (p.v[1:-1] > 1e-9) & (p.v[1:-1] < p.v[:-2]) & (p.v[1:-1] < p.v[2:])
    return np.flatnonzero(turn)


def slow_corners(profile: Profile) -> SlowCorners:
    """The slow corners of a profile; none where they are too many to be told apart."""
    p, at = profile.pieces, slow_at(profile)
    at = at[np.argsort(p.v[at], kind="stable")] if len(at) <= MOST else at[:0]
    places = profile.path.start[p.row[at]]
    feeds = p.v[at][:NAMED] * 60 / profile.path.unit.length
    return SlowCorners(places, [f"{round(feed, 3 if feed < 10 else 0):g}" for feed in feeds.tolist()])
