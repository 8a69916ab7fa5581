"""Contours out of an SVG drawing: paths with lines, arcs and Bezier curves, and the simple figures. Lengths in mm.

Circular arcs stay arcs; elliptical ones and curves become chords, nowhere farther off than the tolerance. Y runs upwards in
what is returned. A drawing with a viewBox and a width in mm, cm or in has that size; else a unit is a millimetre.

    a cubic curve cut into n pieces is off by at most 6·L / (8·n²), L = max |second difference of its points|
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from mnclab.geometry.contours import Contour, Floats, keeps_circles
from mnclab.text.alarm import Alarm
from mnclab.text.file import read
from mnclab.text.given import check_number, shown

FIGURE = re.compile(r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?")
NUMBER = re.compile(rf"\s*(?:,\s*)?({FIGURE.pattern})")
SIZE = re.compile(rf"({FIGURE.pattern})\s*([a-z]*)")
FLAG = re.compile(r"\s*(?:,\s*)?([01])")
LETTER = re.compile(r"\s*(?:,\s*)?([MmLlHhVvCcSsQqTtAaZz])")
COUNT = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
UNITS = {"": 1.0, "px": 1.0, "mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72, "pc": 25.4 / 6}
SKIPPED = {"defs", "clipPath", "mask", "symbol", "marker", "pattern"}


def contours(source: str | Path, tolerance: float = 0.01) -> list[Contour]:
    """All contours of a drawing, open and closed; `source` is its text or the path of its file.

    Raises ValueError where the text is no SVG or a path is misspelt.
    """
    if not isinstance(source, str | Path):
        raise Alarm(f"an SVG drawing is its text or the path of a file, got {shown(source)}")
    check_number(tolerance, "the tolerance (mm)")
    if not tolerance > 0:
        raise ValueError(f"the tolerance must be greater than 0, got {tolerance:g}")
    text = source if isinstance(source, str) and "<" in source else read(source, source).decode("utf-8")
    try:
        root = ElementTree.fromstring(text)
    except ElementTree.ParseError as error:
        raise ValueError(f"this is no SVG: {error}") from None
    return list(_drawn(root, _page(root), tolerance))


def _page(root: ElementTree.Element) -> Floats:
    """The 2×3 matrix from drawing units, Y down, to mm, Y up."""
    box = [float(v) for v in FIGURE.findall(root.get("viewBox", ""))]
    size = [SIZE.fullmatch(root.get(name, "").strip()) for name in ("width", "height")]
    given = [float(m[1]) * UNITS[m[2]] if m and m[2] in UNITS else None for m in size]
    x, y, wide, tall = box if len(box) == 4 else (0.0, 0.0, given[0] or 0.0, given[1] or 0.0)
    scale = next((g / side for g, side in zip(given, (wide, tall)) if g and side), 1.0)
    return np.array([[scale, 0.0, -x * scale], [0.0, -scale, (y + tall) * scale]])


def _drawn(element: ElementTree.Element, matrix: Floats, tolerance: float) -> Iterator[Contour]:
    name = element.tag.rpartition("}")[2]
    if name in SKIPPED:
        return
    matrix = _times(matrix, _transform(element.get("transform", "")))
    text = element.get("d", "") if name == "path" else _as_path(name, element)
    yield from _Pen(matrix, tolerance).contours(text)
    for child in element:
        yield from _drawn(child, matrix, tolerance)


def _as_path(name: str, element: ElementTree.Element) -> str:
    """A simple figure in the words of a path."""

    def value(key: str, default: float = 0.0) -> float:
        found = NUMBER.match(element.get(key, ""))
        return float(found[1]) if found else default

    if name in ("polygon", "polyline"):
        return f"M{element.get('points', '')}" + ("Z" if name == "polygon" else "")
    if name == "line":
        return f"M{value('x1')} {value('y1')}L{value('x2')} {value('y2')}"
    if name in ("circle", "ellipse"):
        rx, ry = (value("r"), value("r")) if name == "circle" else (value("rx"), value("ry"))
        x, y = value("cx"), value("cy")
        return f"M{x + rx} {y}A{rx} {ry} 0 1 1 {x - rx} {y}A{rx} {ry} 0 1 1 {x + rx} {y}Z" if rx and ry else ""
    if name == "rect":
        x, y, w, h = value("x"), value("y"), value("width"), value("height")
        rx = min(value("rx", value("ry")), w / 2)
        ry = min(value("ry", value("rx")), h / 2)
        if not (rx and ry):
            return f"M{x} {y}H{x + w}V{y + h}H{x}Z"
        corner = f"A{rx} {ry} 0 0 1"
        top = f"M{x + rx} {y}H{x + w - rx}{corner} {x + w} {y + ry}V{y + h - ry}{corner} {x + w - rx} {y + h}"
        return f"{top}H{x + rx}{corner} {x} {y + h - ry}V{y + ry}{corner} {x + rx} {y}Z"
    return ""


def _transform(text: str) -> Floats:
    matrix = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    for name, inside in re.findall(r"(?<!\w)(\w+)\s*\(([^()]*)\)", text):
        v = [float(number) for number in FIGURE.findall(inside)]
        if name == "matrix" and len(v) == 6:
            step = np.array([[v[0], v[2], v[4]], [v[1], v[3], v[5]]])
        elif name == "translate" and v:
            step = np.array([[1, 0, v[0]], [0, 1, v[1] if len(v) > 1 else 0.0]])
        elif name == "scale" and v:
            step = np.array([[v[0], 0, 0], [0, v[-1], 0]])
        elif name == "rotate" and len(v) in (1, 3):
            c, s = np.cos(np.radians(v[0])), np.sin(np.radians(v[0]))
            x, y = v[1:] or (0.0, 0.0)
            step = np.array([[c, -s, x - c * x + s * y], [s, c, y - s * x - c * y]])
        elif name in ("skewX", "skewY") and v:
            t = np.tan(np.radians(v[0]))
            step = np.array([[1, t if name == "skewX" else 0, 0], [t if name == "skewY" else 0, 1, 0]])
        else:
            raise ValueError(f"unknown transformation {name}({inside})")
        matrix = _times(matrix, step)
    return matrix


def _times(a: Floats, b: Floats) -> Floats:
    return np.column_stack([a[:, :2] @ b[:, :2], a[:, :2] @ b[:, 2] + a[:, 2]])


class _Pen:
    """Draws the words of one path; coordinates of the drawing as complex numbers."""

    def __init__(self, matrix: Floats, tolerance: float) -> None:
        self.matrix, self.tolerance = matrix, tolerance

    def contours(self, text: str) -> Iterator[Contour]:
        here = first = handle = 0j
        points, bulges, last = list[Floats](), list[float](), "M"
        for letter, v in _commands(text):
            upper, base = letter.upper(), here if letter.islower() else 0j
            if upper in "MZ":
                yield from self._done(points, bulges, upper == "Z")
                here = first = base + complex(*v) if upper == "M" else first
                points, bulges = [self._at(here)], []
            else:
                if upper == "H":
                    goal = complex(v[0] + base.real, here.imag)
                elif upper == "V":
                    goal = complex(here.real, v[0] + base.imag)
                else:
                    goal = base + complex(*v[-2:])
                if upper == "A":
                    added = self._arc(here, goal, v)
                elif upper in "CSQT":
                    pairs = [base + complex(*v[k : k + 2]) for k in range(0, len(v), 2)]
                    if upper in "ST":  # smooth after one of its kind
                        pairs.insert(0, 2 * here - handle if last in {"S": "CS", "T": "QT"}[upper] else here)
                    handle = pairs[-2]
                    added = self._curve([here, *pairs])
                else:
                    added = [(self._at(goal), 0.0)]
                points += [point for point, _ in added]
                bulges += [bulge for _, bulge in added]
                here = goal
            last = upper
        yield from self._done(points, bulges, False)

    def _at(self, place: complex) -> Floats:
        return self.matrix @ np.array([place.real, place.imag, 1.0])

    def _done(self, points: list[Floats], bulges: list[float], closed: bool) -> Iterator[Contour]:
        if len(points) < 2:
            return
        if closed and np.hypot(*(points[-1] - points[0])) < 1e-9 * (1 + np.abs(points[0]).max()):
            if len(points) > 2:
                yield Contour(points[:-1], bulges)
            return
        yield Contour(points, [*bulges, 0.0], closed=closed)

    def _curve(self, control: list[complex]) -> list[tuple[Floats, float]]:
        if len(control) == 3:  # a parabola is a cubic as well
            a, q, b = control
            control = [a, a + (q - a) * 2 / 3, b + (q - b) * 2 / 3, b]
        p = np.array([self._at(c) for c in control])
        bend = np.hypot(*(p[:-2] - 2 * p[1:-1] + p[2:]).T).max()
        count = max(1, int(np.ceil(np.sqrt(0.75 * bend / self.tolerance))))
        t = (np.arange(1, count + 1) / count)[:, None]
        spots = (1 - t) ** 3 * p[0] + 3 * (1 - t) ** 2 * t * p[1] + 3 * (1 - t) * t**2 * p[2] + t**3 * p[3]
        return [(spot, 0.0) for spot in spots]

    def _arc(self, here: complex, goal: complex, v: list[float]) -> list[tuple[Floats, float]]:
        """An arc by its ends (SVG 1.1, F.6.5): centre in the turned frame in which the ellipse is a unit circle."""
        rx, ry, phi = abs(v[0]), abs(v[1]), np.radians(v[2])
        if here == goal:
            return []
        if not (rx and ry):
            return [(self._at(goal), 0.0)]
        turn = np.exp(-1j * phi)

        def unit(z: complex) -> complex:
            w = z * turn
            return complex(w.real / rx, w.imag / ry)

        a, b = unit(here), unit(goal)
        size = max(1.0, abs(b - a) / 2)  # radii too small for the chord grow
        rise = np.sqrt(max(0.0, size**2 - abs(b - a) ** 2 / 4)) * 1j * (b - a) / abs(b - a)
        centre = (a + b) / 2 + (rise if bool(v[3]) != bool(v[4]) else -rise)
        sweep = float(np.angle((b - centre) / (a - centre)))
        sweep += 2 * np.pi * ((v[4] and sweep < 0) - (not v[4] and sweep > 0))
        c, s = np.cos(phi), np.sin(phi)
        shape = self.matrix[:, :2] @ np.array([[c, -s], [s, c]]) @ np.diag([rx, ry])
        is_round = keeps_circles(shape)
        largest = 4 * np.arcsin(min(1.0, np.sqrt(self.tolerance / (2 * size * np.linalg.norm(shape, 2)))))
        count = 2 if is_round else max(2, int(np.ceil(abs(sweep) / largest)))
        part = sweep / count
        bulge = np.tan(part / 4) * np.sign(np.linalg.det(shape)) if is_round else 0.0
        places = []
        for k in range(1, count + 1):
            w = centre + (a - centre) * np.exp(1j * part * k)
            spot = complex(w.real * rx, w.imag * ry) / turn if k < count else goal
            places.append((self._at(spot), float(bulge)))
        return places


def _commands(text: str) -> Iterator[tuple[str, list[float]]]:
    """The commands of a path one by one; further numbers repeat the last one, after M as L."""
    at, letter = 0, ""
    while text[at:].strip(" \t\r\n,"):
        found = LETTER.match(text, at)
        if found:
            letter, at = found[1], found.end()
        elif not letter or letter in "Zz":
            raise ValueError(f"a path cannot go on with {text[at:].strip()[:12]!r}")
        values: list[float] = []
        for k in range(COUNT[letter.upper()]):
            word = (FLAG if letter in "Aa" and k in (3, 4) else NUMBER).match(text, at)
            if not word:
                raise ValueError(f"a number is missing after {letter!r} in a path, at {text[at:].strip()[:12]!r}")
            values.append(float(word[1]))
            at = word.end()
        yield letter, values
        letter = {"M": "L", "m": "l"}.get(letter, letter)
