"""Contours out of an SVG drawing: paths with lines, arcs and Bezier curves, and the simple figures. Lengths in mm.

Circular arcs stay arcs; elliptical ones and curves become chords, nowhere farther off than the tolerance. Y runs upwards in
what is returned. A drawing with a viewBox and a width in mm, cm or in has that size; else a unit is a millimetre. What draws
no lines (text, pictures) or is hidden is left out, and a warning names it; copies (`use`) and drawings within the drawing
are an Alarm.

    a cubic curve cut into n pieces is off by at most 6·L / (8·n²), L = max |second difference of its points|
"""

from __future__ import annotations

import re
import warnings
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree

import numpy as np

from mnclab.geometry.contours import Contour, keeps_circles
from mnclab.geometry.curves import Floats
from mnclab.geometry.drawings import FARTHEST, MOST
from mnclab.text.alarm import Alarm
from mnclab.text.file import read
from mnclab.text.given import check_number, shown

FIGURE = re.compile(r"[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?")
NUMBER = re.compile(rf"\s*(?:,\s*)?({FIGURE.pattern})")
SIZE = re.compile(rf"({FIGURE.pattern})\s*([a-z]*)")
FLAG = re.compile(r"\s*(?:,\s*)?([01])")
LETTER = re.compile(r"\s*(?:,\s*)?([MmLlHhVvCcSsQqTtAaZz])")
REST = re.compile(r"[\s,]*")
COUNT = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
UNITS = {"": 1.0, "px": 1.0, "mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72, "pc": 25.4 / 6}
SKIPPED = {"defs", "clipPath", "mask", "symbol", "marker", "pattern"}
WRITTEN = {"text", "image", "foreignObject"}
HIDDEN = re.compile(r"(?:^|;)\s*(?:display\s*:\s*none|visibility\s*:\s*(?:hidden|collapse))\s*(?:;|$|!)")
FIT, LIKE = "xMidYMid meet", 1 + 1e-3  # how a box lies in a page of another ratio, unless it says so; ratios that are the same
LARGEST = 1e12  # of a number in a drawing, whatever its unit


def contours(source: str | Path, tolerance: float = 0.01) -> list[Contour]:
    """All contours of a drawing, open and closed; `source` is its text or the path of its file.

    An Alarm where the text is no SVG, a path is misspelt or a place is farther away than a kilometre.

    >>> drawing = '<svg xmlns="http://www.w3.org/2000/svg"><rect width="40" height="20"/></svg>'
    >>> [contour.length for contour in mnc.area.svg(drawing)]
    [120.0]
    """
    if not isinstance(source, str | Path):
        raise Alarm(f"an SVG drawing is its text or the path of a file, got {shown(source)}")
    check_number(tolerance, "the tolerance (mm)", above=0)
    text = source if isinstance(source, str) and "<" in source else read(source, source)
    try:
        root = ElementTree.fromstring(text)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise Alarm(f"this is no SVG: {error}") from None
    if (name := root.tag.rpartition("}")[2]) != "svg":
        raise Alarm(f"this is no SVG: its outermost element is <{name[:40]}>")
    left: Counter[str] = Counter()
    found = list(_drawn(root, _page(root), tolerance, left))
    if hidden := left.pop("", 0):
        told = f"{hidden} hidden element{'s' * (hidden != 1)} left out, with all in {'them' if hidden != 1 else 'it'}"
        warnings.warn(f"the drawing has {told} (display: none, visibility: hidden)", stacklevel=2)
    if left:
        names = ", ".join(f"{count} {name}" for name, count in sorted(left.items()))
        warnings.warn(f"the drawing has {names} left out, which draw no lines", stacklevel=2)
    return found


def _number(text: str, what: str) -> float:
    """A number of the drawing; an Alarm where it is none that a drawing has."""
    value = float(text)
    if not abs(value) <= LARGEST:
        raise Alarm(f"{what}: {text[:40]} is out of range, at most {LARGEST:g}")
    return value


def _page(root: ElementTree.Element) -> Floats:
    """The 2×3 matrix from drawing units, Y down, to mm, Y up."""
    written = root.get("viewBox")
    box = [_number(v, "viewBox") for v in FIGURE.findall(written or "")]
    if written is not None and (len(box) != 4 or not (box[2] > 0 and box[3] > 0)):
        raise Alarm(f"viewBox takes x, y and a width and height greater than 0, got {shown(written)}")
    size = [(name, SIZE.fullmatch(root.get(name, "").strip())) for name in ("width", "height")]
    given = [_number(m[1], name) * UNITS[m[2]] if m and m[2] in UNITS else None for name, m in size]
    x, y, wide, tall = box or (0.0, 0.0, given[0] or 0.0, given[1] or 0.0)
    scales = [g / side for g, side in zip(given, (wide, tall)) if g and side]
    scale = min(scales, default=1.0)  # the box lies in the middle of the page, as great as it may: "xMidYMid meet"
    if not (0 < scale <= LARGEST and tall * scale <= LARGEST):
        raise Alarm(f"a unit of the drawing would be {scale:g} mm")
    fit = (root.get("preserveAspectRatio") or FIT).strip()
    if max(scales, default=1.0) > scale * LIKE and fit not in (FIT, FIT.split()[0]):
        hint = "width and height in the ratio of viewBox"
        raise Alarm(f"a drawing with preserveAspectRatio={shown(fit)} is not read", hint=hint)
    aside, above = ((g - side * scale) / 2 if g and side else 0.0 for g, side in zip(given, (wide, tall)))
    return np.array([[scale, 0.0, aside - x * scale], [0.0, -scale, above + (y + tall) * scale]])


def _drawn(root: ElementTree.Element, page: Floats, tolerance: float, left: Counter[str]) -> Iterator[Contour]:
    """The contours of an element and of all in it, in their order; `left` counts what draws none."""
    stack, pen = [(root, page)], _Pen(tolerance)
    while stack:
        element, matrix = stack.pop()
        name = element.tag.rpartition("}")[2] if isinstance(element.tag, str) else ""
        if name in SKIPPED:
            continue
        if name in WRITTEN:
            left[name] += 1
            continue
        style = ";".join(f"{key}:{element.get(key, '')}" for key in ("display", "visibility")) + ";" + element.get("style", "")
        if HIDDEN.search(style):
            left[""] += 1
            continue
        if "transform" in element.get("style", ""):
            raise Alarm(f"a <{name[:40]}> is moved by its style, which is not read", hint='write transform="…"')
        if name == "use" or (name == "svg" and element is not root):
            raise Alarm(f"<{name}> within a drawing is not read", hint="write its lines there; Inkscape: Unlink Clone, Ungroup")
        if transform := element.get("transform"):
            matrix = _times(matrix, _transform(transform))
            if not (np.isfinite(matrix).all() and 0 < abs(np.linalg.det(matrix[:, :2])) < LARGEST**2):
                raise Alarm(f"the transformation {transform[:60]!r} leaves no area, or one without an end")
        text = element.get("d", "") if name == "path" else _as_path(name, element, page[0, 0])
        yield from pen.contours(text, matrix)
        stack += [(child, matrix) for child in reversed(element)]


def _as_path(name: str, element: ElementTree.Element, scale: float) -> str:
    """A simple figure in the words of a path; `scale` mm are a unit."""

    def value(key: str, default: float = 0.0, least: float = -LARGEST) -> float:
        written = element.get(key)
        if written is None or written == "auto":
            return default
        found = SIZE.fullmatch(written.strip())
        if not found or found[2] not in UNITS:
            raise Alarm(f"{key} of a {name} must be a number, got {shown(written)}")
        size = _number(found[1], f"{key} of a {name}") * (1 if found[2] in ("", "px") else UNITS[found[2]] / scale)
        if size < least:
            raise Alarm(f"{key} of a {name} must be at least {least:g}, got {size:g}")
        return size

    if name in ("polygon", "polyline"):
        points = element.get("points", "")
        return f"M{points}" + ("Z" if name == "polygon" else "") if points.strip() else ""
    if name == "line":
        return f"M{value('x1')} {value('y1')}L{value('x2')} {value('y2')}"
    if name in ("circle", "ellipse"):
        rx, ry = (value(key, least=0.0) for key in (("r", "r") if name == "circle" else ("rx", "ry")))
        x, y = value("cx"), value("cy")
        return f"M{x + rx} {y}A{rx} {ry} 0 1 1 {x - rx} {y}A{rx} {ry} 0 1 1 {x + rx} {y}Z" if rx and ry else ""
    if name == "rect":
        x, y, w, h = value("x"), value("y"), value("width", least=0.0), value("height", least=0.0)
        rx = min(value("rx", value("ry"), least=0.0), w / 2)
        ry = min(value("ry", value("rx"), least=0.0), h / 2)
        if not (rx and ry):
            return f"M{x} {y}H{x + w}V{y + h}H{x}Z"
        corner = f"A{rx} {ry} 0 0 1"
        top = f"M{x + rx} {y}H{x + w - rx}{corner} {x + w} {y + ry}V{y + h - ry}{corner} {x + w - rx} {y + h}"
        return f"{top}H{x + rx}{corner} {x} {y + h - ry}V{y + ry}{corner} {x + rx} {y}Z"
    return ""


def _transform(text: str) -> Floats:
    matrix = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    end = 0
    for found in re.finditer(r"(?<!\w)(\w+)\s*\(([^()]*)\)", text):
        name, inside = found[1], found[2]
        between, end = text[end : found.start()], found.end()
        v = [_number(number, name) for number in FIGURE.findall(inside)]
        if between.strip(" \t\r\n,") or FIGURE.sub("", inside).strip(" \t\r\n,"):
            raise Alarm(f"a transformation cannot be read: {text[:60]!r}")
        if name == "matrix" and len(v) == 6:
            step = np.array([[v[0], v[2], v[4]], [v[1], v[3], v[5]]])
        elif name == "translate" and len(v) in (1, 2):
            step = np.array([[1, 0, v[0]], [0, 1, v[1] if len(v) > 1 else 0.0]])
        elif name == "scale" and len(v) in (1, 2):
            step = np.array([[v[0], 0, 0], [0, v[-1], 0]])
        elif name == "rotate" and len(v) in (1, 3):
            c, s = np.cos(np.radians(v[0])), np.sin(np.radians(v[0]))
            x, y = v[1:] or (0.0, 0.0)
            step = np.array([[c, -s, x - c * x + s * y], [s, c, y - s * x - c * y]])
        elif name in ("skewX", "skewY") and len(v) == 1:
            t = np.tan(np.radians(v[0]))
            step = np.array([[1, t if name == "skewX" else 0, 0], [t if name == "skewY" else 0, 1, 0]])
        else:
            raise Alarm(f"unknown transformation {name}({inside[:60]})")
        matrix = _times(matrix, step)
    if text[end:].strip(" \t\r\n,"):
        raise Alarm(f"a transformation cannot be read: {text[:60]!r}")
    return matrix


def _times(a: Floats, b: Floats) -> Floats:
    return np.column_stack([a[:, :2] @ b[:, :2], a[:, :2] @ b[:, 2] + a[:, 2]])


class _Pen:
    """Draws the words of paths; coordinates of the drawing as complex numbers."""

    matrix: Floats

    def __init__(self, tolerance: float) -> None:
        self.tolerance = tolerance
        self.chords = 0

    def contours(self, text: str, matrix: Floats) -> Iterator[Contour]:
        self.matrix, self.rows = matrix, matrix.tolist()
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
        (a, b, c), (d, e, f) = self.rows
        x, y = a * place.real + b * place.imag + c, d * place.real + e * place.imag + f
        if not (abs(x) <= FARTHEST and abs(y) <= FARTHEST):
            raise Alarm(f"the drawing reaches farther than {FARTHEST / 1000:g} m: X{x:g} Y{y:g} mm")
        return np.array([x, y])

    def _done(self, points: list[Floats], bulges: list[float], closed: bool) -> Iterator[Contour]:
        if len(points) < 2:
            return
        if closed and np.hypot(*(points[-1] - points[0])) < 1e-9 * (1 + np.abs(points[0]).max()):
            if len(points) > 2:
                yield Contour(points[:-1], bulges)
            return
        yield Contour(points, [*bulges, 0.0], closed=closed)

    def _count(self, pieces: float, least: int) -> int:
        if not self.chords + pieces <= MOST:
            raise Alarm(f"curves would be more than {MOST} chords within {self.tolerance:g} mm", hint="a greater tolerance")
        count = max(least, int(np.ceil(pieces)))
        self.chords += count
        return count

    def _curve(self, control: list[complex]) -> list[tuple[Floats, float]]:
        if len(control) == 3:  # a parabola is a cubic as well
            a, q, b = control
            control = [a, a + (q - a) * 2 / 3, b + (q - b) * 2 / 3, b]
        p = np.array([self._at(c) for c in control])
        bend = np.hypot(*(p[:-2] - 2 * p[1:-1] + p[2:]).T).max()
        count = self._count(np.sqrt(0.75 * bend / self.tolerance), 1)
        t = (np.arange(1, count + 1) / count)[:, None]
        spots = (1 - t) ** 3 * p[0] + 3 * (1 - t) ** 2 * t * p[1] + 3 * (1 - t) * t**2 * p[2] + t**3 * p[3]
        return [(spot, 0.0) for spot in spots]

    def _arc(self, here: complex, goal: complex, v: list[float]) -> list[tuple[Floats, float]]:
        """An arc by its ends (SVG 1.1, F.6.5): centre in the turned frame in which the ellipse is a unit circle."""
        rx, ry, phi = abs(v[0]), abs(v[1]), np.radians(v[2])
        if here == goal:
            return []
        end = self._at(goal)
        if min(rx, ry) < 1 / LARGEST:
            return [(end, 0.0)]
        turn = np.exp(-1j * phi)

        def unit(z: complex) -> complex:
            w = z * turn
            return complex(w.real / rx, w.imag / ry)

        a, b = unit(here), unit(goal)
        if abs(b - a) < 1 / LARGEST:
            return [(end, 0.0)]
        size = max(1.0, abs(b - a) / 2)  # radii too small for the chord grow
        rise = np.sqrt(max(0.0, size**2 - abs(b - a) ** 2 / 4)) * 1j * (b - a) / abs(b - a)
        centre = (a + b) / 2 + (rise if bool(v[3]) != bool(v[4]) else -rise)
        sweep = float(np.angle((b - centre) / (a - centre)))
        sweep += 2 * np.pi * ((v[4] and sweep < 0) - (not v[4] and sweep > 0))
        c, s = np.cos(phi), np.sin(phi)
        shape = self.matrix[:, :2] @ np.array([[c, -s], [s, c]]) @ np.diag([rx, ry])
        is_round = keeps_circles(shape)
        largest = 4 * np.arcsin(min(1.0, np.sqrt(self.tolerance / (2 * size * np.linalg.norm(shape, 2)))))
        count = 2 if is_round else self._count(abs(sweep) / largest, 2)
        part = sweep / count
        bulge = np.tan(part / 4) * np.sign(np.linalg.det(shape)) if is_round else 0.0
        w = centre + (a - centre) * np.exp(1j * part * np.arange(1, count))
        spots = (w.real * rx + 1j * w.imag * ry) / turn
        return [(each, float(bulge)) for each in (*(self._at(spot) for spot in spots.tolist()), end)]


def _commands(text: str) -> Iterator[tuple[str, list[float]]]:
    """The commands of a path one by one; further numbers repeat the last one, after M as L."""
    at, letter = 0, ""
    while (start := REST.match(text, at)) and start.end() < len(text):  # it always matches
        found = LETTER.match(text, at)
        if found:
            if not letter and found[1] not in "Mm":
                raise Alarm(f"a path begins with M, got {text[at : at + 12].strip()!r}")
            letter, at = found[1], found.end()
        elif not letter or letter in "Zz":
            raise Alarm(f"a path cannot go on with {text[at : at + 12].strip()!r}")
        values: list[float] = []
        for k in range(COUNT[letter.upper()]):
            word = (FLAG if letter in "Aa" and k in (3, 4) else NUMBER).match(text, at)
            if not word:
                raise Alarm(f"a number is missing after {letter!r} in a path, at {text[at : at + 12].strip()!r}")
            values.append(_number(word[1], f"{letter} in a path"))
            at = word.end()
        yield letter, values
        letter = {"M": "L", "m": "l"}.get(letter, letter)
