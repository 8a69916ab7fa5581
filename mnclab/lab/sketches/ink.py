"""Paper and pen of a sketch: lines, a dimension, an angle, an arrow, and a place for the address that no line crosses.

The sheet is 96 by 64, y down; angles are in degrees, counter-clockwise from the right. A piece of a line is a point, or an arc
(x, y of its centre, radius, first angle, last angle). Lines take the colour of the text around them, so that they live on
a dark page; what is measured is thick, in one colour that is seen on both, and told by its heads in grey.
"""

from __future__ import annotations

import math
from functools import cache
from html import escape

WIDTH, HEIGHT = 96, 64
ACCENT = "#d4500c"
CELL = 2  # width of the cells in which lines are noted, so that the address stays off them
SHORT = 15  # a dimension below it has its heads outside

Point = tuple[float, float]
Piece = tuple[float, ...]

STYLES = {
    "fill": 'fill="currentColor" fill-opacity=".14" fill-rule="evenodd" stroke="none"',
    "thin": 'stroke-width=".8" stroke-opacity=".65"',
    "dash": 'stroke-width="1" stroke-opacity=".8" stroke-dasharray="3 2"',
    "edge": 'stroke-width="1.4"',
    "tool": 'stroke-width="1" stroke-opacity=".85"',
    "solid": 'fill="currentColor" stroke="none"',
    "tail": f'stroke="{ACCENT}" stroke-width="1.7"',
    "measure": f'stroke="{ACCENT}" stroke-width="1.9"',
    "head": f'fill="{ACCENT}" stroke="none"',
}


def polar(centre: Piece, radius: float, angle: float) -> Point:
    """The point so far from a centre, in that direction."""
    turn = math.radians(angle)
    return centre[0] + radius * math.cos(turn), centre[1] - radius * math.sin(turn)


def circle(centre: Piece, radius: float) -> tuple[Piece, ...]:
    """A full circle."""
    return (*centre, radius, 0, 180), (*centre, radius, 180, 360)


def box(left: float, top: float, right: float, bottom: float, radius: float = 0) -> tuple[Piece, ...]:
    """A rectangle, its corners rounded."""
    corners = ((right, top, -1, 1, 0), (left, top, 1, 1, 90), (left, bottom, 1, -1, 180), (right, bottom, -1, -1, 270))
    return tuple((x + dx * radius, y + dy * radius, radius, a, a + 90) if radius else (x, y) for x, y, dx, dy, a in corners)


def turned(pieces: tuple[Piece, ...], centre: Point, angle: float) -> tuple[Piece, ...]:
    """Pieces turned about a centre."""
    made: list[Piece] = []
    for x, y, *rest in pieces:
        far, way = math.dist((x, y), centre), math.degrees(math.atan2(centre[1] - y, x - centre[0]))
        made.append((*polar(centre, far, way + angle), *rest[:1], *(a + angle for a in rest[1:])))
    return tuple(made)


def written(*numbers: float) -> str:
    """Numbers as a path has them, to a tenth."""
    return " ".join(f"{round(number, 1):g}" for number in numbers)


@cache
def spiral() -> list[Point]:
    """Cells around a place, the nearest first; those at its sides count as nearer, since letters are wide."""
    columns, rows = WIDTH // CELL, HEIGHT // CELL
    around = ((i, j) for i in range(-columns, columns + 1) for j in range(-rows, rows + 1))
    return sorted(around, key=lambda cell: math.hypot(0.7 * cell[0], cell[1]))


class Sheet:
    """One sketch while it is drawn: the address that is written, paths by their style, and the cells that they cross."""

    def __init__(self, address: str) -> None:
        self.address = address
        self.paths: dict[str, list[str]] = {style: [] for style in STYLES}
        self.rows = [0] * (HEIGHT // CELL)
        self.anchor: Point = (WIDTH / 2, HEIGHT / 2)
        self.words: list[str] = []

    def draw(self, style: str, *pieces: Piece, closed: bool = False) -> None:
        """Pieces joined by straight lines."""
        path, points = "", list[Point]()
        for x, y, *arc in pieces:
            start = polar((x, y), *arc[:2]) if arc else (x, y)
            if not points or math.dist(start, points[-1]) > 0.05:
                path += ("L" if path else "M") + written(*start)
            points.append(start)
            if arc:
                radius, a, b = arc
                steps = max(2, math.ceil(abs(b - a) / 15))
                points += [polar((x, y), radius, a + (b - a) * k / steps) for k in range(1, steps + 1)]
                path += f"A{written(radius, radius)} 0 {int(abs(b - a) > 180)} {int(b < a)} {written(*points[-1])}"
        self.paths[style].append(path + "Z" * closed)
        if style != "fill":  # letters may stand on a tint
            self._cross([*points, points[0]] if closed else points)

    def _cross(self, points: list[Point]) -> None:
        for (x, y), (u, v) in zip(points, points[1:]):
            steps = max(1, math.ceil(math.dist((x, y), (u, v)) / CELL))
            for k in range(steps + 1):
                column, row = int((x + (u - x) * k / steps) // CELL), int((y + (v - y) * k / steps) // CELL)
                if 0 <= column < WIDTH // CELL and 0 <= row < HEIGHT // CELL:
                    self.rows[row] |= 1 << column

    def part(self, *pieces: Piece) -> None:
        """Material, or an opening in what is drawn before and after it."""
        self.draw("fill", *pieces, closed=True)
        self.draw("edge", *pieces, closed=True)

    def head(self, tip: Point, tail: Point) -> None:
        """A filled head that comes from a tail."""
        way = math.degrees(math.atan2(tip[1] - tail[1], tail[0] - tip[0]))
        self.draw("head", tip, polar(tip, 6, way - 22), polar(tip, 6, way + 22), closed=True)

    def measure(self, a: Point, b: Point, *feet: Point) -> None:
        """A dimension from `a` to `b`, thin lines from `feet` to its ends; heads from outside where it is short."""
        for foot, end in zip(feet, (a, b)):
            self.draw("thin", foot, end)
        self.draw("measure", a, b)
        for end, other in ((a, b), (b, a)):
            out = math.degrees(math.atan2(other[1] - end[1], end[0] - other[0]))
            if math.dist(a, b) < SHORT:
                self.draw("tail", polar(end, 7, out), polar(end, 4, out))
            self.head(end, other if math.dist(a, b) >= SHORT else polar(end, 7, out))
        self.anchor = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2

    def radius(self, centre: Point, radius: float, angle: float) -> None:
        """A radius: from its centre to the arc."""
        end = polar(centre, radius, angle)
        self.draw("head", *circle(centre, 1.7), closed=True)
        self.move(centre, end)
        self.anchor = (centre[0] + end[0]) / 2, (centre[1] + end[1]) / 2

    def angle(self, centre: Point, radius: float, a: float, b: float, rays: float = 6) -> None:
        """An angle from direction `a` to `b`; its legs reach `rays` beyond it."""
        for leg in (a, b):
            self.draw("thin", centre, polar(centre, radius + rays, leg))
        self.draw("measure", (*centre, radius, a, b))
        back = math.copysign(math.degrees(5.6 / radius), b - a)
        self.head(polar(centre, radius, b), polar(centre, radius, b - back))
        if abs(math.radians(b - a)) * radius >= SHORT:
            self.head(polar(centre, radius, a), polar(centre, radius, a + back))
        self.anchor = polar(centre, radius, (a + b) / 2)

    def move(self, *pieces: Piece) -> None:
        """A motion with its direction: where a feed acts."""
        self.draw("measure", *pieces)
        x, y, *arc = pieces[-1]
        if arc:
            radius, a, b = arc
            self.head(polar((x, y), radius, b), polar((x, y), radius, b - math.copysign(math.degrees(5.6 / radius), b - a)))
            self.anchor = polar((x, y), radius, (a + b) / 2)
        else:
            self.head((x, y), (pieces[-2][0], pieces[-2][1]))
            self.anchor = (x + pieces[-2][0]) / 2, (y + pieces[-2][1]) / 2

    def spin(self, x: float, y: float) -> None:
        """The spindle turns, clockwise from above."""
        self.paths["measure"].append(f"M{written(x + 8, y - 3)}A11 4 0 1 1 {written(x - 8, y - 3)}")
        self._cross([(x + 8, y - 3), (x + 11, y), (x, y + 4), (x - 11, y), (x - 8, y - 3)])
        self.head((x - 7, y - 3.4), (x - 11, y - 1))
        self.anchor = x - 11, y

    def clock(self, x: float, y: float) -> None:
        """A time that is waited."""
        self.draw("measure", *circle((x, y), 7), closed=True)
        self.draw("measure", (x, y - 5), (x, y), (x + 4, y))
        self.anchor = x, y

    def datum(self, x: float, y: float, style: str = "solid") -> None:
        """The sign of a datum: a circle with two of its quarters filled."""
        self.draw("thin" if style == "solid" else "tail", *circle((x, y), 3.6), closed=True)
        for a in (0, 180):
            self.draw(style, (x, y), (x, y, 3.6, a, a + 90), closed=True)

    def word(self, text: str, x: float, y: float) -> None:
        """A letter at a fixed place, its middle there."""
        self.words.append(f'<text x="{written(x)}" y="{written(y + 3.4)}" font-size="9">{escape(text)}</text>')
        self._cross([(x - 3, y - 3), (x + 3, y + 3), (x - 3, y + 3), (x + 3, y - 3)])

    def _label(self, high: float) -> str:
        """The address in letters of that height, at the place nearest to the anchor where no line crosses it; or nothing."""
        wide = min(high * sum(0.34 if c in "IJ·/:+ " else 0.6 if c.isdigit() else 0.68 for c in self.address), WIDTH - 8)
        columns, rows = math.ceil(wide / CELL) + 1, math.ceil(high / CELL)
        from_column, from_row = round(self.anchor[0] / CELL - columns / 2), round(self.anchor[1] / CELL - rows / 2)
        for i, j in spiral():
            column, row = int(from_column + i), int(from_row + j)
            if 1 <= column < WIDTH // CELL - columns and 0 <= row <= HEIGHT // CELL - rows:
                if not any(self.rows[row + k] >> column & (1 << columns) - 1 for k in range(rows)):
                    x, y = (column + columns / 2) * CELL, (row + rows / 2) * CELL + 0.36 * high
                    return (
                        f'<text data-style="address" x="{written(x)}" y="{written(y)}" font-size="{written(high)}" '
                        f'font-weight="700" textLength="{written(wide)}" lengthAdjust="spacingAndGlyphs">'
                        f"{escape(self.address)}</text>"
                    )
        return ""

    def svg(self, title: str) -> str:
        """The sketch as a text, the address in the largest letters that have a place."""
        drawn = "".join(f'<path data-style="{k}" {STYLES[k]} d="{"".join(paths)}"/>' for k, paths in self.paths.items() if paths)
        letters = "".join(self.words) + (self._label(12) or self._label(10) or self._label(8))
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}" '
            f'role="img"><title>{escape(title)}</title><g fill="none" stroke="currentColor" stroke-linejoin="round">{drawn}</g>'
            f'<g fill="currentColor" font-family="Arial,Helvetica,sans-serif" text-anchor="middle">{letters}</g></svg>'
        )
