"""What a program measured: contours as they should be and as they were found, the ball at each touch, and the record."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Circle, Patch

from mnclab.path.listing import Unit
from mnclab.show.plot import colours
from mnclab.show.plot.colours import Line, Mark
from mnclab.show.plot.measured_panels import Panel, panels
from mnclab.show.plot.picture import LINE, SMALL, Foot, Picture, dress, write_legend
from mnclab.show.plot.placing import write_beside
from mnclab.show.plot.probed import FACE, draw_material
from mnclab.show.plot.sizes import sized
from mnclab.show.probed import part_of
from mnclab.text.alarm import Alarm, several
from mnclab.text.given import check_number, shown, whole

NOMINAL = Line("nominal", colours.INK, (0, (6, 2)), 1.0, 2.4)
ACTUAL = Line("measured", colours.FEED.colour, "-", 1.7, 2.8)
NOMINAL_MIDDLE = Mark("_nominal middle", colours.INK, "+", 9, True, 2.5)
MIDDLE = Mark("_middle", colours.FEED.colour, "x", 6, True, 2.9)
BETWEEN = "#1259a838"
APPROACH = colours.PROBING._replace(name="approach", width=1.2)
TOUCHED = Mark("touch", colours.PROBING.colour, "o", 7, False, 3.0)
OUT = "#b3261e"
MOST = 12  # panels
LEFT, RIGHT, TITLE, BELOW, GAP, TOP = 0.66, 0.14, 0.36, 0.5, 0.16, 0.34  # inches
TALL = 0.78  # of the width of a panel
WIDTH = 7.5  # inches, of a picture
WIDEST = 4.6  # inches, of a panel
HEAD = ("", "nominal", "actual", "deviation", "")
COLUMNS = (2, 3, 4, 5, 8)  # of the record
LETTER, BETWEEN_COLUMNS = 0.071, 0.14  # inches


@sized()
def plot_measured(
    run: Any, *, line: int | None = None, factor: float | None = None, part: bool = True, width: float = WIDTH
) -> Picture:
    """A panel for each cycle that measured: nominal and actual contour, the ball at each touch with its approach, its number
    and what it found, and the lines of the measuring record.

    - `line`: only what the block of this line measured; default all, 12 panels or so.
    - `factor`: by how much deviations are magnified; default a round number for each panel, so that the worst is seen. It
      stands in the title of the panel.
    - `part`: the part itself behind them, in true size, as a section at the height of the touches.
    - `width` of the picture in inches.

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
    return _picture(found, part_of(run) if part else None, width, more)


def pages(run: Any, count: int, most: int) -> tuple[list[Picture], int]:
    """Pictures of `count` panels each for a report, of about `most` panels, first of what is beyond its limits; and how many
    executions of cycles have none."""
    found, more = panels(run, None, None, most, frozenset(row.step for row in run.measurements.outside))
    part = part_of(run) if found else None
    return [_picture(found[k : k + count], part, WIDTH, 0) for k in range(0, len(found), count)], more


def _picture(found: Sequence[Panel], part: Any, width: float, more: int) -> Picture:
    """The panels row by row, each over its lines of the record."""
    texts = [_texts(panel, found[0].view.unit) for panel in found]
    count = max(1, min(len(found), int(width / max(3.3, *map(_wide, texts)))))
    box = min(width / count - LEFT - RIGHT, WIDEST)
    width = count * (box + LEFT + RIGHT)
    tall = box * TALL
    rows = [range(k, min(k + count, len(found))) for k in range(0, len(found), count)]
    under = [LINE * max(len(texts[k]) for k in row) for row in rows]
    foot = LINE if more > 0 else 0.0
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
            _record(picture, texts[k], x - LEFT + 0.1, place - BELOW)
        place -= BELOW + room + GAP
    _legend(picture, found, part)
    said = [f"{several(more, 'more cycle')}: line= chooses"] if more > 0 else []
    said += [f"no room for the numbers of {several(left_out, 'touched point')}"] if left_out else []
    if said:
        Foot("; ".join(said)).write(picture)
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
        ax.add_patch(Circle(tuple(ball.centre), ball.radius, facecolor="#7b1fa222", edgecolor=shade, linewidth=1.1, zorder=3.0))
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


def _wide(rows: Sequence[Sequence[str]]) -> float:
    """How wide a table is, inches."""
    return 0.2 + sum(LETTER * max(map(len, column)) + BETWEEN_COLUMNS for column in zip(*rows))


def _record(picture: Picture, rows: Sequence[Sequence[str]], left: float, top: float) -> None:
    """The lines of the record, numbers to the right, what is out red and bold."""
    width, height = picture.get_size_inches().tolist()
    wide = [LETTER * max(map(len, column)) + BETWEEN_COLUMNS for column in zip(*rows)]
    for line, row in enumerate(rows):
        out = line > 0 and row[-1] not in ("", "ok")
        for k, text in enumerate(row):
            numeric = 0 < k < len(row) - 1
            x = left + sum(wide[: k + 1]) - BETWEEN_COLUMNS if numeric else left + sum(wide[:k])
            picture.text(
                x / width, (top - LINE * (line + 0.2)) / height, text, fontsize=SMALL, ha="right" if numeric else "left",
                va="top", weight="bold" if out or not line else "normal", color=OUT if out else colours.INK, parse_math=False,
            )  # fmt: skip


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
