"""What a program measured: contours as they should be and as they were found, the ball at each touch, and the record."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Patch

from mnclab.geometry.contours import Contour
from mnclab.geometry.frames import apply, inverse
from mnclab.path.listing import Unit
from mnclab.path.toolpath import Array
from mnclab.show import looks
from mnclab.show.plot import colours
from mnclab.show.plot.colours import LineStyle, Mark
from mnclab.show.plot.picture import (
    LINE,
    SMALL,
    VIEWS,
    Foot,
    Picture,
    View,
    column_widths,
    dress,
    write_legend,
    write_table,
)
from mnclab.show.plot.placing import write_beside
from mnclab.show.plot.probed import FACE, draw_material
from mnclab.show.plot.sizes import sized
from mnclab.show.probed import part_of, touched_decimals
from mnclab.text.alarm import Alarm, several
from mnclab.text.given import check_number, shown, whole

NOMINAL = LineStyle("nominal", colours.INK, (0, (6, 2)), 1.0, 2.4)
ACTUAL = LineStyle("measured", colours.FEED.colour, "-", 1.7, 2.8)
NOMINAL_MIDDLE = Mark("_nominal middle", colours.INK, "+", 9, True, 2.5)
MIDDLE = Mark("_middle", colours.FEED.colour, "x", 6, True, 2.9)
BETWEEN, BALL = looks.BLUE + "38", looks.VIOLET + "22"
APPROACH = colours.PROBING._replace(name="approach", width=1.2)
TOUCHED = Mark("touch", colours.PROBING.colour, "o", 7, False, 3.0)
MOST = 12  # panels
LEFT, RIGHT, TITLE, BELOW, GAP, TOP = 0.66, 0.14, 0.36, 0.5, 0.16, 0.34  # inches
TALL = 0.78  # of the width of a panel
WIDTH = 7.5  # inches, of a picture
WIDEST = 4.6  # inches, of a panel
HEAD = ("", "nominal", "actual", "deviation", "")
COLUMNS = (2, 3, 4, 5, 8)  # of the record


@sized()
def plot_measured(
    run: Any, *, line: int | None = None, factor: float | None = None, part: bool = True, width: float = WIDTH,
    height: float | None = None,
) -> Picture:  # fmt: skip
    """A panel for each cycle that measured: nominal and actual contour, the ball at each touch with its approach, its number
    and what it found, and the lines of the measuring record.

    - `line`: only what the block of this line measured; default all, 12 panels or so.
    - `factor`: by how much deviations are magnified; default a round number for each panel, so that the worst is seen. It
      stands in the title of the panel.
    - `part`: the part itself behind them, in true size, as a section at the height of the touches.
    - `width` of the picture in inches; in a low `height` the record of a single panel stands beside it.

    Number 1 is `run.touches[0]`. An Alarm where no part was measured.
    """
    if line is not None:
        line = whole(line, "the line")
    if factor is not None:
        check_number(factor, "the factor of deviations", above=0)
    if not isinstance(part, bool):
        raise Alarm(f"part must be True or False, got {shown(part)}")
    check_number(width, "the width of a picture (inches)", at_least=3, at_most=40)
    if not run.touches and not run.figures:
        hint = "run.measurements has the tools" if run.measurements else "touch probe cycles measure, with Setup(part=…)"
        raise Alarm(f"nothing was measured on a part{f', {run.reach}' if run.halt else ''}", hint=hint)
    found, more = panels(run, line, factor, MOST)
    if not found:
        lines = ", ".join(map(str, sorted({each.line for each in (*run.touches, *run.figures)})[:MOST]))
        raise Alarm(f"nothing was measured in line {line}", hint=f"lines that measured: {lines}")
    if height is not None:
        check_number(height, "the height of a picture (inches)", at_least=1, at_most=40)
    return _picture(found, part_of(run) if part else None, width, more, height)


def pages(run: Any, count: int, most: int) -> tuple[list[Picture], int]:
    """Pictures of `count` panels each for a report, of about `most` panels, first of what is beyond its limits; and how many
    executions of cycles have none."""
    found, more = panels(run, None, None, most, frozenset(row.step for row in run.measurements.outside))
    part = part_of(run) if found else None
    return [_picture(found[k : k + count], part, WIDTH, 0) for k in range(0, len(found), count)], more


def _picture(found: Sequence[Panel], part: Any, width: float, more: int, height: float | None = None) -> Picture:
    """The panels row by row, each over its lines of the record; a single one beside them where the height is too low."""
    texts = [_texts(panel, found[0].view.unit) for panel in found]
    count = max(1, min(len(found), int(width / max(3.3, *(0.2 + sum(column_widths(each)) for each in texts)))))
    box, aside = min(width / count - LEFT - RIGHT, WIDEST), 0.0
    around = TOP + TITLE + BELOW + GAP + 0.06
    if len(found) == 1 and height is not None and height < around + box * TALL + LINE * len(texts[0]):
        aside = sum(column_widths(texts[0]))
        box = min(width - LEFT - RIGHT - aside, (height - around) / TALL)
    width = count * (box + LEFT + RIGHT) + aside
    tall = box * TALL
    rows = [range(k, min(k + count, len(found))) for k in range(0, len(found), count)]
    under = [0.0 if aside else LINE * max(len(texts[k]) for k in row) for row in rows]
    said = [f"{several(more, 'more cycle')}: line= chooses"] if more > 0 else []
    foot = 2 * LINE if more > 0 else 0.06
    total = TOP + sum(TITLE + tall + BELOW + each + GAP for each in under) + foot
    balls = sum(len(panel.balls) for panel in found)
    picture = Picture((width, total), f"measured: {several(len(found), 'panel')}, {several(balls, 'touched point')}")
    place, left_out = total - TOP, 0
    for row, room in zip(rows, under):
        place -= TITLE + tall
        for k in row:
            x = (k - row[0]) * (box + LEFT + RIGHT) + LEFT
            ax = picture.add_axes((x / width, place / total, box / width, tall / total))
            left_out += draw(ax, found[k], part, (box, tall))
            out = [line for line, text in enumerate(texts[k]) if line and text[-1] not in ("", "ok")]
            at = (x + box + RIGHT, place + tall) if aside else (x - LEFT + 0.1, place - BELOW)
            write_table(picture, texts[k], at[0], at[1] - LINE * len(texts[k]), range(1, len(HEAD) - 1), out)
        place -= BELOW + room + GAP
    _legend(picture, found, part)
    said += [f"no room for the numbers of {several(left_out, 'touched point')}"] if left_out else []
    if said:
        Foot("\n".join(said)).within(width).write(picture)
    return picture


def draw(ax: Axes, panel: Panel, part: Any = None, box: tuple[float, float] | None = None) -> int:
    """One panel in its axes; returns how many of its touches had no room for their number."""
    points = panel.points
    low, high = points.min(axis=0), points.max(axis=0)
    if box is None:
        box = 1.0, TALL
    wide, tall = box
    scale = max((high - low)[0] / wide, (high - low)[1] / tall, 1e-3) * 1.34
    middle = (low + high) / 2
    dress(ax, panel.view, box if box[0] > 1 else None)
    ax.set_title(panel.title, fontsize=SMALL, loc="left", pad=4, parse_math=False)
    ax.set_xlim(middle[0] - scale * wide / 2, middle[0] + scale * wide / 2)
    ax.set_ylim(middle[1] - scale * tall / 2, middle[1] + scale * tall / 2)
    if part is not None:
        draw_material(ax, part, panel.view, panel.frame, panel.level)
    for pair in panel.pairs:
        quads = np.stack([pair.nominal[:-1], pair.nominal[1:], pair.actual[1:], pair.actual[:-1]], axis=1)
        ax.add_collection(PolyCollection(list(quads), facecolors=BETWEEN, edgecolors="none", zorder=2.2), autolim=False)
        if not np.array_equal(pair.nominal, pair.actual):
            ax.add_line(Line2D(*pair.nominal.T, **NOMINAL.style()))
        ax.add_line(Line2D(*pair.actual.T, **ACTUAL.style()))
    for nominal, actual in panel.middles:
        ax.add_line(Line2D(*nominal[:, None], **NOMINAL_MIDDLE.style()))
        ax.add_line(Line2D(*actual[:, None], **MIDDLE.style()))
    return _balls(ax, panel)


def _balls(ax: Axes, panel: Panel) -> int:
    shade, lines = colours.PROBING.colour, [line for pair in panel.pairs for line in (pair.nominal, pair.actual)]
    for ball in panel.balls:
        ax.add_patch(Circle(tuple(ball.centre), ball.radius, facecolor=BALL, edgecolor=shade, linewidth=1.1, zorder=3.0))
        if ball.across:
            ax.add_line(Line2D(*ball.centre[:, None], color=shade, marker=".", markersize=4, zorder=3.1))
            continue
        arrow = {
            "arrowstyle": "-|>", "color": shade, "linewidth": APPROACH.width, "linestyle": APPROACH.dashes, "shrinkA": 0,
            "shrinkB": 0, "mutation_scale": 8,
        }  # fmt: skip
        ax.annotate("", tuple(ball.centre), tuple(ball.start), arrowprops=arrow, zorder=3.1, annotation_clip=False)
        lines.append(ball.centre + np.linspace(0, 1, 30)[:, None] * (ball.start - ball.centre))
    if not panel.balls:
        return 0
    places, starts = (np.array(each) for each in zip(*((ball.centre, ball.start) for ball in panel.balls)))
    texts = [(f"{ball.number}   {ball.text}", str(ball.number)) for ball in panel.balls]
    wishes = places - places.mean(axis=0) if len(places) > 1 else np.zeros((1, 2))
    wishes = wishes / np.maximum(np.hypot(*wishes.T), 1e-9)[:, None]
    return write_beside(ax, texts, places, [ball.radius for ball in panel.balls], wishes, lines)


def _texts(panel: Panel, unit: Unit) -> list[tuple[str, ...]]:
    """The head and the lines of the record below a panel; empty columns are left out."""
    if not panel.rows:
        return []
    rows = [[row.texts(unit)[k] for k in COLUMNS] for row in panel.rows]
    head = f"in {unit.name}", *HEAD[1:]
    return [head, *((what, *(text.replace("-", "\N{MINUS SIGN}") for text in numbers)) for what, *numbers in rows)]


def _legend(picture: Picture, found: Sequence[Panel], part: Any) -> None:
    artists: list[Any] = []
    pairs = [pair for panel in found for pair in panel.pairs]
    if any(not np.array_equal(*pair) for pair in pairs):
        artists.append(Line2D([], [], **NOMINAL.style()))
    if pairs:
        artists.append(Line2D([], [], **ACTUAL.style()))
    if any(panel.balls for panel in found):
        artists += [Line2D([], [], **APPROACH.style()), Line2D([], [], **TOUCHED.style())]
    if part is not None:
        artists.append(Patch(**FACE, label="part"))
    write_legend(picture, artists)


# What a picture of measuring holds: panels, their contours and balls, with the deviation magnified.
#
# A panel lies in the coordinates of the program as they were at its first touch, so that the numbers at its axes are those of
# the cycle. Balls move with the contour, so that they touch it where it is drawn.

SAMPLES = 48  # of an element of a contour
SHARE = 0.1  # of the greatest side of a panel: how far the worst deviation is drawn at most
GREATEST = 1000.0
NOTHING = 1e-7  # mm: deviations that are none
ALONG = 0.7  # cosine: a touch nearer to Z than this is seen from the side
AXIS = 0.999  # cosine from which on a touch goes along an axis
UNDER_FACE = 0.1  # mm under a face that was touched from above is the section that shows it
MISFIT, SLANT = 0.5, 0.3  # mm that a touch may be off its contour, and the sine of its angle to it at least
TOUCH = re.compile(" touch.*")  # what stands behind the name of a cycle where a touch is labelled
TICK = 2.2  # radii of the ball on both sides of a touched point that belongs to no figure


class Ball(NamedTuple):
    """A touch: its number, what it found (a coordinate, or how far out of the contour), and in the view (2,)
    its centre as drawn and where it came from; its radius; whether it came along the line of sight."""

    number: int
    text: str
    centre: Array
    start: Array
    radius: float
    across: bool


class Pair(NamedTuple):
    """A line as it should be (n, 2) and as it was found, magnified (n, 2)."""

    nominal: Array
    actual: Array

    def middles(self) -> Pair:
        """Of both lines (2,), each piece with the weight that it has in the nominal one."""
        weights = np.hypot(*np.diff(self.nominal, axis=0).T) + 1e-12
        return Pair(*(np.average((line[1:] + line[:-1]) / 2, axis=0, weights=weights) for line in self))


class Panel(NamedTuple):
    """One view of one execution of a cycle: of its plane `frame` (4, 4), at a `level` along the line of sight; `middles` are
    places (2,) of figures that have one."""

    title: str
    view: View
    frame: Array
    level: float
    factor: float
    pairs: list[Pair]
    middles: list[Pair]
    balls: list[Ball]
    rows: list[Any]

    @property
    def points(self) -> Array:
        """All that the picture must hold (n, 2)."""
        discs = [ball.centre + ball.radius * np.array(corner) for ball in self.balls for corner in ((-1, -1), (1, 1))]
        starts = [ball.start for ball in self.balls]
        return np.vstack([*(line for pair in self.pairs for line in (pair.nominal, pair.actual)), *discs, *starts])


def panels(
    run: Any, line: int | None, factor: float | None, most: int = 10_000, prior: frozenset[int] = frozenset()
) -> tuple[list[Panel], int]:
    """The panels of a run in the order of its blocks, or of one line, about `most` of them; without a `factor` each has its
    own. And how many executions of cycles have none: where there are too many, the steps in `prior` have theirs."""
    found: list[Panel] = []
    touches, figures, rows = _by_step([*enumerate(run.touches)]), _by_step(run.figures), _by_step(run.measurements)
    passes: dict[tuple[int, int], int] = {}
    left_out = 0
    steps = sorted({*touches, *figures})
    chosen = set(sorted(steps, key=lambda step: (step not in prior, step))[:most]) if prior else set(steps)
    for step in steps:
        first = figures[step][0] if step in figures else touches[step][0][1]
        place = first.program, first.line
        passes[place] = passes.get(place, 0) + 1
        if line is not None and first.line != line:
            continue
        if len(found) >= most or step not in chosen:
            left_out += 1
            continue
        of = touches.get(step, []), figures.get(step, []), rows.get(step, [])
        name = next((each.cycle for each in (*of[2], *of[1])), "") or TOUCH.sub("", first.label)
        where = f"line {first.line}" if len(run.programs) == 1 else run.place_of_line(first.line, first.program)
        again = f", pass {passes[place]}" if passes[place] > 1 else ""
        names = of[0][0][1].names if of[0] else "XYZ"
        found += _views(f"{where}{again}  {name}", *of, factor, names, run.toolpath.unit)
    return found, left_out


def _by_step(all_: Iterable[Any]) -> dict[int, list[Any]]:
    """What each execution of a block made; touches stand behind their numbers."""
    found: dict[int, list[Any]] = {}
    for each in all_:
        found.setdefault((each[1] if type(each) is tuple else each).step, []).append(each)
    return found


def _views(
    title: str, touches: Sequence[Any], figures: Sequence[Any], rows: list[Any], factor: float | None, names: str, unit: Unit
) -> list[Panel]:
    """From above if anything lies in the plane, from the side what was touched along the tool axis; `names` of the axes."""
    frame = np.asarray((touches[0][1] if touches else figures[0]).frame)
    into = inverse(frame)
    deep = [abs(float((into[:3, :3] @ touch.direction)[2])) > ALONG for _, touch in touches]
    below = [each for each, along in zip(touches, deep) if along]
    found = []
    if figures or not all(deep) or len(below) > 1:
        lines = [_flat(figure, into) for figure in figures]
        if not all(deep):
            height = float(apply(into, touches[deep.index(False)][1].centre)[2])
        elif figures:
            height = float(apply(into @ figures[0].frame, (0.0, 0.0, figures[0].height))[2])
        else:
            height = float(apply(into, [touch.surface for _, touch in touches])[:, 2].min()) - UNDER_FACE
        found.append(_panel(title, VIEWS["XY"]._replace(names=names, unit=unit), frame, height, touches, lines, rows, factor))
    if below:
        spots = apply(into, [touch.centre for _, touch in below])
        view = VIEWS["YZ" if np.ptp(spots[:, 1]) > np.ptp(spots[:, 0]) else "XZ"]._replace(names=names, unit=unit)
        level = float(spots[0, 3 - view.right - view.up])
        found.append(_panel(title, view, frame, level, below, [], [] if found else rows, factor, rows))
    return found


def _flat(figure: Any, into: Array) -> tuple[tuple[int, ...], Contour, Contour]:
    """The touches of a figure and its contours in the plane of the panel."""
    turn = np.eye(3)
    whole = into @ np.asarray(figure.frame)
    turn[:2, :2], turn[:2, 2] = whole[:2, :2], whole[:2, 3]
    same = np.allclose(turn, np.eye(3), atol=1e-12)
    nominal, actual = (each if same else each.transformed(turn) for each in (figure.nominal, figure.actual))
    return figure.touches, nominal, actual


def _panel(
    title: str, view: View, frame: Array, level: float, touches: Sequence[Any], figures: Sequence[Any], rows: list[Any],
    factor: float | None, known: Sequence[Any] = (),
) -> Panel:  # fmt: skip
    """One panel; `known` are rows of the record that say what a touch should have found."""
    axes, into = [view.right, view.up], inverse(frame)
    ways = {k: (into[:3, :3] @ touch.direction)[axes] for k, touch in touches}
    widths = [_width(nominal, [ways[k] for k in numbers if k in ways]) for numbers, nominal, _ in figures]
    lines = [_samples(nominal, actual) for _, nominal, actual in figures]
    feet, texts = [], []
    judged = [not np.array_equal(*line) for line in lines]
    for k, touch in touches:
        spot, way = apply(into, apply(np.asarray(touch.frame), touch.found)), into[:3, :3] @ touch.direction
        way /= np.linalg.norm(way)
        across = abs(float(way[3 - view.right - view.up])) > ALONG
        foot = spot[axes]
        on = [k in each[0] and _touches(each[2], width, foot, way[axes], touch.ball) for each, width in zip(figures, widths)]
        which = on.index(True) if any(on) else None
        owner = None if which is None else figures[which]
        if not across and (which is None or judged[which]):
            foot = _foot(owner[1], owner[2], foot) if owner else spot[axes] - _off(k, spot, way, known or rows)[axes]
        out = _outwards(spot[axes], owner[1], view.unit) if owner and not across and np.abs(way).max() < AXIS else ""
        told = _told(k, spot, known or rows)
        texts.append(out or _text(told, way, view))
        alone = not across and (which is None or widths[which]) and np.allclose(told, spot, atol=1e-6)
        feet.append((spot[axes], foot, way[axes], across, alone))
    worst = max([float(np.hypot(*(a - n).T).max()) for n, a in lines] + [math.dist(s, f) for s, f, *_ in feet], default=0.0)
    size = _size([n for n, _ in lines] + [spot[None] for spot, *_ in feet], [touch.ball for _, touch in touches])
    magnified = factor or (min(nice(SHARE * size / worst), GREATEST) if worst > NOTHING else 1.0)
    drawn = [Pair(n, n + magnified * (a - n)) for n, a in lines]
    pairs = [pair for pair, width in zip(drawn, widths) if not width]
    middles = [pair.middles() for pair, width, (_, nominal, _) in zip(drawn, widths, figures) if width or nominal.closed]
    balls = []
    for (k, touch), text, (spot, foot, way, across, lonely) in zip(touches, texts, feet):
        shown, radius = foot + magnified * (spot - foot), float(touch.ball)
        travel = math.dist(touch.start, touch.centre)
        if across:
            balls.append(Ball(k + 1, text, shown, shown, radius, True))
            continue
        if lonely:
            tick = np.outer([-TICK, TICK], radius * np.array([-way[1], way[0]]))
            pairs.append(Pair(foot + tick, shown + tick))
        balls.append(Ball(k + 1, text, shown - radius * way, shown - (radius + travel) * way, radius, False))
    said = f"{title}\n{'from above' if view.up == 1 else 'from the side'}"
    said += f", deviation × {magnified:g}" if worst > NOTHING and magnified != 1 else ""
    return Panel(said, view, frame, level, magnified, pairs, middles, balls, rows)


def nice(value: float) -> float:
    """The greatest number 1, 2 or 5 times a power of ten that is not greater, 1 at least."""
    power = 10.0 ** math.floor(math.log10(max(value, 1.0)))
    return max(step * power for step in (1.0, 2.0, 5.0) if step * power <= max(value, 1.0))


def _width(nominal: Contour, ways: Sequence[Array]) -> bool:
    """Whether a line goes from wall to wall: two touches came the opposite ways."""
    return not nominal.closed and len(nominal.starts) == 1 and any(float(way @ ways[0]) < -ALONG for way in ways[1:])


def _touches(actual: Contour, width: bool, spot: Array, way: Array, ball: float) -> bool:
    """Whether a touch is one on a contour as it was found, and not on something else, such as a hole of a bolt circle."""
    if float(actual.distance(spot)[0]) > max(MISFIT, ball / 2):
        return False
    _, along = actual.point_at(actual.nearest(spot))
    return width or abs(float(way[0] * along[1] - way[1] * along[0])) > SLANT


def _samples(nominal: Contour, actual: Contour) -> tuple[Array, Array]:
    """Places of both contours that belong together (n, 2): element by element, or where they differ by the shortest way."""
    count = len(nominal.starts)
    element = np.repeat(np.arange(len(actual.starts)), SAMPLES + 1)
    share = np.tile(np.linspace(0.0, 1.0, SAMPLES + 1), len(actual.starts))
    there = actual.at(share, element)[0]
    if count == len(actual.starts):
        return nominal.at(share, element)[0], there
    return nominal.nearest_points(there), there


def _foot(nominal: Contour, actual: Contour, spot: Array) -> Array:
    """The place of the nominal contour that belongs to a touched point."""
    if len(nominal.starts) != len(actual.starts):
        return np.asarray(nominal.nearest_points(spot)[0])
    way, ends = actual.nearest(spot), np.cumsum(actual.lengths)
    element = min(int(np.searchsorted(ends, way)), len(ends) - 1)
    share = (way - (ends[element] - actual.lengths[element])) / max(float(actual.lengths[element]), 1e-300)
    return np.asarray(nominal.at(np.array([min(max(share, 0.0), 1.0)]), np.array([element]))[0][0])


def _off(number: int, spot: Array, way: Array, rows: Sequence[Any]) -> Array:
    """By how much a single touch is off (3,), if a row of the record is about its coordinate and knows the nominal one."""
    axis = int(np.abs(way).argmax())
    for row in rows:
        if tuple(row.touches) == (number,) and abs(way[axis]) > AXIS and abs(row.actual - spot[axis]) < 1e-6:
            if not math.isnan(row.nominal):
                return np.asarray(np.eye(3)[axis] * row.deviation)
    return np.zeros(3)


def _told(number: int, spot: Array, rows: Sequence[Any]) -> Array:
    """What the record says of a single touch (3,): some cycles give the centre of the ball, or its south pole."""
    said = {row.what: row.actual for row in rows if tuple(row.touches) == (number,)}
    return np.array([said.get(axis, value) for axis, value in zip("XYZ", spot)])


def _outwards(spot: Array, nominal: Contour, unit: Unit) -> str:
    """How far a touched point lies out of a closed contour; where a touch goes along no axis this says more than X and Y."""
    if not nominal.closed:
        return ""
    out = float(nominal.distance(spot)[0]) * (-1 if nominal.winding(spot)[0] else 1)
    return f"{out / unit.length:+z.{touched_decimals(unit)}f}".replace("-", "\N{MINUS SIGN}")


def _text(spot: Array, way: Array, view: View) -> str:
    """The coordinates that a touch has found."""
    along = np.abs(way) > math.sqrt(1 - AXIS**2)
    digits = touched_decimals(view.unit)
    told = "  ".join(f"{axis} {v / view.unit.length:z.{digits}f}" for axis, v, some in zip(view.names, spot, along) if some)
    return told.replace("-", "\N{MINUS SIGN}")


def _size(lines: Sequence[Array], balls: Sequence[float]) -> float:
    points = np.vstack(lines)
    return float(max(np.ptp(points, axis=0).max(), 8 * max(balls, default=0.0)))
