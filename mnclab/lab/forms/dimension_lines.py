"""A dimension over a picture of a path, as help pictures of controls have it: line, arrows and value, large, in one colour.

Windows are the axes of the picture; coordinates on the sheet are pixels from its upper left corner. A view is chosen in
which the dimension is seen in full; its line stands beside what it measures, on the side that has more room.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from html import escape
from typing import Any, NamedTuple

import numpy as np

from mnclab.lab.forms.measuring import Angle, Length, Measured, Moves, Radius
from mnclab.path.toolpath import Array, Toolpath
from mnclab.show.plot.page_sheet import width

COLOUR = "#d4500c"
LETTERS = 17  # pixels of the letters of a value
HEAD, SHORT, TAIL = 11.0, 30.0, 16.0  # of an arrow; a dimension whose arrows stand outside; their tails
ASIDE, INSET, BEYOND = 26.0, 13.0, 5.0  # from what is measured to the line, from the border at least, of lines over it
MANY, CHORD = 400, 0.05  # lines of moves that are marked; mm, of their arcs
SEEN = 0.1  # of a way, at least
CLEAR = 5.0  # from a value to the middle of a symbol
GRID = np.array([(u, v) for u in np.linspace(0, 1, 9) for v in (0.0, 0.5, 1.0)])  # over a name or a tool
PART = 2.5  # order of what is drawn: tools lie over it
NUMBERS = (40.0, 20.0)  # pixels of the numbers beside a window and below it
ARM = 0.36  # radius of the arc of an angle, of the lesser side of a window
STYLE = (
    f'fill="none" stroke="{COLOUR}" stroke-width="2.4" stroke-linejoin="round" stroke-linecap="round" '
    f'font-family="Arial,Helvetica,sans-serif" font-size="{LETTERS}" font-weight="700"'
)


class Window(NamedTuple):
    """Axes of a picture: which coordinates go to the right and up, and the pixels of a place: x = x0 + scale * right."""

    right: int
    up: int
    box: tuple[float, float, float, float]  # left, top, right, bottom
    origin: Array  # (2,) pixels
    scale: Array  # (2,) pixels to a mm; downwards the second
    taken: Array = np.empty((0, 2))  # pixels of symbols, names and tools: what a value should not cover

    def at(self, places: Array) -> Array:
        """The pixels (n, 2) of places (n, 3)."""
        flat = np.atleast_2d(places)[:, [self.right, self.up]]
        return np.asarray(self.origin + self.scale * flat)

    @property
    def corners(self) -> Array:
        """Its corners (4, 2)."""
        left, top, right, bottom = self.box
        return np.array([(left, top), (right, top), (right, bottom), (left, bottom)])

    def inside(self, point: Array, inset: float = 0.0) -> Array:
        """The nearest points (…, 2) within the window."""
        left, top, right, bottom = self.box
        return np.clip(point, (left + inset, top + inset), (right - inset, bottom - inset))


def windows(figure: Any) -> list[Window]:
    """The axes of a figure that was drawn at 100 pixels to an inch."""
    found = []
    for ax, view, *_ in getattr(figure, "views", ()):
        tall = 100 * figure.get_figheight()
        box = ax.get_position()
        left, right = (100 * figure.get_figwidth() * each for each in (box.x0, box.x1))
        top, bottom = (tall * (1 - each) for each in (box.y1, box.y0))
        (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
        scale = np.array([(right - left) / (x1 - x0), (top - bottom) / (y1 - y0)])
        origin = np.array([left, bottom]) - scale * (x0, y0)
        over = [*(text for text in ax.texts if text.get_text()), *(patch for patch in ax.patches if patch.get_zorder() > PART)]
        names = [each.get_window_extent() for each in over]
        pixels = [ax.transData.inverted().transform(box.min + np.ptp(box, axis=0) * GRID) for box in names]
        pixels += [line.get_xydata() for line in ax.lines if line.get_marker() not in ("None", "", None)]
        taken = origin + scale * np.concatenate([np.empty((0, 2)), *pixels])
        found.append(Window(view.right, view.up, (left, top, right, bottom), origin, scale, taken))
    return found


def half_of(text: str) -> float:
    """Half the pixels of a value in the widest letters that a browser may take for it."""
    return width(text, LETTERS, bold=True) / 2


def way(points: Iterable[Any]) -> str:
    """A path through points, as SVG writes it."""
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)


class Sheet:
    """What is drawn over a picture: paths, arrow heads and one text that no line of it crosses."""

    def __init__(self, shown: Sequence[Window]) -> None:
        self.parts: list[str] = []
        self.shown = shown

    def line(self, *points: Array, thin: bool = False) -> None:
        look = ' stroke-width="1.3"' if thin else ""
        self.parts.append(f'<path d="{way(points)}"{look}/>')

    def lines(self, lines: Sequence[Array]) -> None:
        """Broad and transparent: what is below them stays visible."""
        if lines:
            path = "".join(way(line) for line in lines)
            self.parts.append(f'<path d="{path}" stroke-width="6" stroke-opacity=".75"/>')

    def head(self, tip: Array, way: Array) -> None:
        """An arrow head that points along a way (2,) of length 1."""
        side = np.array([-way[1], way[0]]) * HEAD * 0.36
        corners = [tip, tip - way * HEAD + side, tip - way * HEAD - side]
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in corners)
        self.parts.append(f'<polygon points="{points}" fill="{COLOUR}" stroke="none"/>')

    def dot(self, place: Any, radius: float = 3.5) -> None:
        self.parts.append(f'<circle cx="{place[0]:.1f}" cy="{place[1]:.1f}" r="{radius}" fill="{COLOUR}"/>')

    def write(self, text: str, place: Array, size: tuple[float, float]) -> None:
        """The value with its middle at a place, within the picture and off the numbers of its axes."""
        half, place = half_of(text) + 3, off_numbers(place, text, self.shown)
        x = min(max(float(place[0]), half), size[0] - half)
        y = min(max(float(place[1]), 0.7 * LETTERS), size[1] - 0.6 * LETTERS)
        look = f'text-anchor="middle" fill="{COLOUR}" stroke="#fff" stroke-width="5" paint-order="stroke"'
        self.parts.append(f'<text x="{x:.1f}" y="{y + 0.36 * LETTERS:.1f}" {look}>{escape(text)}</text>')

    def svg(self, title: str, size: tuple[float, float]) -> str:
        """The sheet as SVG, as large as the picture below it."""
        wide, high = size
        look = f"position:absolute;left:0;top:0;width:{wide:.0f}px;max-width:100%;height:auto;pointer-events:none"
        return (
            f'<svg class="mnclab-dimension" role="img" viewBox="0 0 {wide:.0f} {high:.0f}" style="{look}">'
            f"<title>{escape(title)}</title><g {STYLE}>{''.join(self.parts)}</g></svg>"
        )


def over(found: Measured | None, text: str, path: Toolpath, shown: Sequence[Window], size: tuple[float, float]) -> str:
    """What is drawn over a picture of `size` pixels whose axes are `shown`: a dimension of a path, or the text at its tool."""
    sheet = Sheet(shown)
    if not shown:
        sheet.write(text, np.array([size[0], 0.0]), size)
    elif isinstance(found, Length) and np.hypot(*found.way[[(each := seen_in(found.way, shown)).right, each.up]]) > SEEN:
        length(sheet, found, text, path, shown, size)
    elif isinstance(found, Radius):
        radius(sheet, found, text, shown, size)
    elif isinstance(found, Angle):
        angle(sheet, found, text, shown, size)
    else:
        moves(sheet, found if isinstance(found, Moves) else None, text, path, shown, size)
    return sheet.svg(text, size)


def length(sheet: Sheet, found: Length, text: str, path: Toolpath, shown: Sequence[Window], size: tuple[float, float]) -> None:
    """A dimension line beside the path, with lines from its feet."""
    window = seen_in(found.way, shown)
    feet = window.at(np.stack([found.begin, found.end]))
    way = window.scale * found.way[[window.right, window.up]]
    way = way / float(np.hypot(*way))
    if (feet[1] - feet[0]) @ way < 0:
        way = -way
    across = np.array([-way[1], way[0]])
    wide = half_of(text) * abs(across[0]) + LETTERS / 2 * abs(across[1])  # of the text, beside the line
    room = float(np.nan_to_num(path.radius).max(initial=0.0)) * (0.0 if path.lathe else 1.0) * np.array([1.0, 1.0, 0.0])
    motion = path.motion
    points = np.concatenate([window.at(each) for each in (motion.start - room, motion.end + room, found.begin, found.end)])
    spread, here = window.inside(points) @ across, float(feet.mean(axis=0) @ across)
    border = window.corners @ across
    free = {1: border.max() - spread.max(), -1: spread.min() - border.min()}
    near = {1: spread.max() - here, -1: here - spread.min()}
    first = max((1, -1), key=lambda each: (free[each] > ASIDE + INSET, free[each] > ASIDE + 2 * wide, -near[each], each))
    for side, off in ((first, ASIDE), (-first, ASIDE), (first, ASIDE / 2), (-first, ASIDE / 2)):
        line = (spread.max() if side > 0 else spread.min()) + side * off
        ends = feet + across * (line - feet @ across)[:, None]
        if np.abs((window.inside(ends, INSET / 2) - ends) @ across).max() < 1.0:  # along itself it may go on beyond the window
            break
    else:  # there is no room beside it
        ends = feet if within(window.inside(feet, -1.0), feet) else ends
    held = window.inside(ends)
    for foot, end, true in zip(feet, held, ends, strict=True):
        if within(end, true):  # what goes on beyond the window has no end in it
            sheet.line(window.inside(foot), end + across * side * BEYOND, thin=True)
    long = float(np.hypot(*(held[1] - held[0])))
    outside = long < SHORT
    for end, true, out in ((held[0], ends[0], -way), (held[1], ends[1], way)):
        if outside:
            sheet.line(end + out * TAIL, end)
        if within(end, true):
            sheet.head(end, -out if outside else out)
    if not outside:
        sheet.line(held[0], held[1])
    middle, off = held.mean(axis=0), across * side * (wide + 8)
    out = way * (half_of(text) * abs(way[0]) + LETTERS / 2 * abs(way[1]) + 6 + outside * (TAIL + HEAD))
    ends = sorted((held[0] - out, held[1] + out), key=lambda place: -float(np.hypot(*(points - place).T).min()))
    aside = [end + turn * 1.1 * LETTERS + one * off for end, turn in zip(held, (-way, way)) for one in (1, -1)]
    places = [place for place in (middle + off, *ends, *aside) if fits(place, text, shown, size)]  # else over what is measured
    half = np.array([half_of(text) + CLEAR, LETTERS / 2 + CLEAR])
    taken, moved = window.taken, window.at(path.points(CHORD)[0])

    def covered(at: Array) -> int:
        others = taken if not any(at is one for one in aside) else np.concatenate([taken, moved])
        return int((np.abs(others - at) < half).all(axis=1).sum())

    sheet.write(text, min([*places, middle - off], key=covered), size)


def seen_in(way: Array, shown: Sequence[Window]) -> Window:
    """The first window in which a way (3,) is seen at its longest."""
    return max(shown, key=lambda each: round(float(np.hypot(*way[[each.right, each.up]])), 3))


def within(held: Array, true: Array) -> bool:
    """Whether points stand where they were before they were held within a window."""
    return bool(np.abs(held - true).max() < 1.0)


def off_numbers(place: Array, text: str, shown: Sequence[Window]) -> Array:
    """A place (2,) beside which a text covers no numbers of axes: to the right of those beside a window, above those below it."""
    (x, y), half = place, half_of(text) + 3
    for left, _, right, bottom in (each.box for each in shown):
        if left - half < x < right + half and bottom - LETTERS / 2 < y < bottom + NUMBERS[1] + LETTERS / 2:
            y = bottom - LETTERS / 2 - 1
    for left, top, _, bottom in (each.box for each in shown):
        if left - NUMBERS[0] - half < x < left + half and top - LETTERS < y < bottom + LETTERS:
            x = left + half
    return np.array([x, y])


def fits(place: Array, text: str, shown: Sequence[Window], size: tuple[float, float]) -> bool:
    """Whether a text with its middle there stands within the picture and covers no numbers."""
    half = half_of(text)
    inside = half <= place[0] <= size[0] - half and LETTERS / 2 <= place[1] <= size[1] - LETTERS / 2
    return inside and bool((off_numbers(place, text, shown) == place).all())


def radius(sheet: Sheet, found: Radius, text: str, shown: Sequence[Window], size: tuple[float, float]) -> None:
    """An arrow from the centre of an arc."""
    way = found.end - found.centre
    window = seen_in(way, shown)
    centre, end = window.at(np.stack([found.centre, found.end]))
    sheet.dot(centre)
    long = float(np.hypot(*(end - centre)))
    along = (end - centre) / max(long, 1e-9)
    sheet.line(centre, end)
    if long < SHORT:
        sheet.line(end, end + along * 2 * TAIL)
        sheet.head(end, -along)
        place = end + along * (2 * TAIL + 6 + half_of(text) * abs(along[0]))
    else:
        sheet.head(end, along)
        place = (centre + end) / 2 + np.array([-along[1], along[0]]) * LETTERS
    sheet.write(text, place, size)


def angle(sheet: Sheet, found: Angle, text: str, shown: Sequence[Window], size: tuple[float, float]) -> None:
    """An arc between two legs."""
    window = next((each for each in shown if {each.right, each.up} == set(found.plane)), None)
    if window is None:
        return sheet.write(text, np.array([size[0], 0.0]), size)
    (centre,) = window.at(found.centre)
    box = np.array(window.box)
    far = ARM * float(min(box[2:] - box[:2]))
    first, second = found.plane
    begin = math.atan2(found.arm[second], found.arm[first])

    def point(turn: float, out: float) -> Array:
        place = np.zeros(3)
        place[first], place[second] = math.cos(begin + turn), math.sin(begin + turn)
        flat = window.scale * place[[window.right, window.up]]
        return np.asarray(centre + flat / float(np.hypot(*flat)) * out)

    sheet.dot(centre)
    for turn in (0.0, found.sweep):
        sheet.line(centre, point(turn, far + 14), thin=True)
    turns = np.linspace(0.0, found.sweep, max(2, int(abs(found.sweep) / 0.1)))
    sheet.line(*(point(turn, far) for turn in turns))
    if abs(found.sweep) * far > 1.5 * HEAD:
        tip, before = point(found.sweep, far), point(found.sweep - math.copysign(HEAD / far, found.sweep), far)
        sheet.head(tip, (tip - before) / float(np.hypot(*(tip - before))))
    place = point(found.sweep / 2, far + 12 + half_of(text))
    sheet.write(text, window.inside(place, LETTERS), size)


def moves(
    sheet: Sheet, found: Moves | None, text: str, path: Toolpath, shown: Sequence[Window], size: tuple[float, float]
) -> None:
    """The moves that a value acts in, and the value beside them; without any it stands beside the tool."""
    rows = np.flatnonzero(found.rows) if found else np.zeros(0, dtype=np.int64)
    runs = [run for run in np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1) if len(run)]  # a line each
    ways = [np.concatenate([path.start[run[:1]], path[run].points(CHORD)[0], path.end[run[-1:]]]) for run in runs[:MANY]]
    window, longest = shown[-1], 0.0
    tool = window.inside(window.at(path.end[-1:])[0]) if len(path) else window.corners[0]
    for each in reversed(shown):
        lines = [each.inside(each.at(way)) for way in ways]
        long = [float(np.ptp(line, axis=0).max()) for line in lines]
        sheet.lines([line for line, far in zip(lines, long, strict=True) if far >= 1.0])
        for line in {tuple(line[-1]) for line, far in zip(lines, long, strict=True) if far < 1.0}:
            sheet.dot(line, 5.0)
        if lines and (not longest or max(long) > longest):
            longest, window = max(*long, 1.0), each
            tool = lines[int(np.argmax(long))].mean(axis=0)
    half = half_of(text) + 12
    side = half if tool[0] + half + half < size[0] else -half
    sheet.write(text, window.inside(tool + np.array([side, -LETTERS]), LETTERS / 2), size)
