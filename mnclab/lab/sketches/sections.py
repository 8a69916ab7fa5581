"""Seen from the side: what goes down into a workpiece, the heights above it, and the feeds between them."""

from __future__ import annotations

from typing import NamedTuple

from mnclab.lab.sketches.ink import Piece, Point, Sheet, circle
from mnclab.lab.sketches.kinds import Draw, Kind

LEFT, RIGHT, BASE, SIDE = 5, 91, 62, 30  # ends and foot of the material; where heights are dimensioned


class Work(NamedTuple):
    """The outline of what is worked, between the ends of the material; the tool in it, and how wide the opening is."""

    outline: tuple[Piece, ...]
    x: float
    half: float
    kind: str
    span: Point


#: y of what is dimensioned: levels over a surface and in it; where the tip of a tool stands is among `OF_TOOL`
HEIGHTS: dict[str, float] = {
    "second": 9, "clear": 20, "surface": 31, "zero": 31, "datum": 57, "first": 43, "bottom": 54, "before last": 48,
    "rest": 46, "reached": 44, "back": 38, "low reached": 51, "low back": 45, "start": 42, "wait": 44, "end": 57, "front": 39,
    "under": 49, "counterbore": 41, "below": 58,
}  # fmt: skip
OTHERWISE: dict[str, dict[str, float]] = {
    "thread": {"bottom": 52}, "outside thread": {"bottom": 52}, "face": {"bottom": 49, "first": 40, "rest": 43},
    "level face": {"bottom": 49, "surface": 49},
    "engraving": {"bottom": 44}, "cylinder": {"surface": 25, "bottom": 41, "clear": 13, "first": 33},
    "cylinder ridge": {"surface": 25, "bottom": 40, "clear": 13, "first": 33},
}  # fmt: skip
OF_TOOL = ("second", "clear", "back", "low back", "before last", "below")
WALL = tuple((52 - 4 * (k % 2), 31 + 3.5 * k) for k in range(7))  # of a thread, three turns deep
STUD = tuple((100 - x, y) for x, y in WALL[::-1])


def notch(*points: Point) -> tuple[Point, ...]:
    """A surface with something in it or on it."""
    return ((LEFT, points[0][1]), *points, (RIGHT, points[-1][1]))


def mirrored(points: tuple[Point, ...], about: float) -> tuple[Point, ...]:
    """Points on the other side of an axis, in the other order."""
    return tuple((2 * about - x, y) for x, y in points[::-1])


WORKS = {
    "hole": Work(notch((52, 31), (52, 49), (62, 54), (72, 49), (72, 31)), 62, 10, "drill", (52, 72)),
    "bore": Work(notch((52, 31), (52, 54), (72, 54), (72, 31)), 62, 8, "mill", (52, 72)),
    "centring": Work(notch((46, 31), (62, 54), (78, 31)), 62, 5, "spot", (46, 78)),
    "thread": Work(notch(*WALL, (52, 57), (72, 57), *mirrored(WALL, 62)), 62, 8, "mill", (52, 72)),
    "outside thread": Work(notch((48, 54), *STUD, *mirrored(STUD, 58), (68, 54)), 79, 6, "mill", (48, 68)),
    "back boring": Work(((LEFT, 31), (52, 31), (52, 41), (45, 41), (45, 49), (LEFT, 49)), 62, 5, "bar", (52, 72)),
    "pocket": Work(notch((44, 31), (44, 54), (82, 54), (82, 31)), 62, 7, "mill", (44, 82)),
    "stud": Work(notch((42, 54), (42, 31), (66, 31), (66, 54)), 79, 7, "mill", (42, 66)),
    "face": Work(notch((54, 49), (54, 31)), 72, 12, "mill", (54, 91)),
    "level face": Work(notch((54, 49), (54, 31)), 72, 12, "mill", (54, 91)),  # milled to its height at once
    "engraving": Work(notch((56, 31), (62, 44), (68, 31)), 62, 4, "spot", (56, 68)),
    "cylinder": Work(((52, 61, 36, 180, 104), (43, 41), (61, 41), (52, 61, 36, 76, 0)), 52, 6, "mill", (43, 61)),
    "cylinder ridge": Work(((52, 61, 22, 180, 114), (52, 61, 36, 104, 76), (52, 61, 22, 66, 0)), 68, 5, "mill", (43, 61)),
}


def height(family: str, name: str) -> float:
    """Y of a height of a family."""
    return OTHERWISE.get(family, {}).get(name, HEIGHTS[name])


def work(s: Sheet, family: str) -> Work:
    """The material in section."""
    found = WORKS[family]
    if family == "back boring":
        s.part(*found.outline)
        s.part(*((min(124 - x, RIGHT), y) for x, y, *_ in found.outline))
    else:
        ends = () if "cylinder" in family else ((RIGHT, BASE), (LEFT, BASE))
        s.draw("fill", *found.outline, *ends, closed=True)
        s.draw("edge", *found.outline)
    return found


def stands(s: Sheet, family: str, at: str) -> None:
    """The tool of a family, from above the sheet, with its tip at one of the heights."""
    _, x, half, kind, _ = WORKS[family]
    tip = height(family, at)
    point = {"drill": half / 2, "spot": half * 1.4}.get(kind, 0)
    low: list[Piece] = [(x - half, tip - point), (x, tip), (x + half, tip - point)]
    if kind == "bar":  # its edge stands out and looks up
        low += [(x + half, tip - 4), (x + half + 6, tip - 8), (x + half, tip - 8)]
    s.draw("tool", (x - half, 1), *low, (x + half, 1))


def probe(s: Sheet, at: Point, radius: float = 5) -> None:
    """A ball on its stem."""
    s.draw("tool", *circle(at, radius), closed=True)
    for x in (at[0] - 1.6, at[0] + 1.6):
        s.draw("tool", (x, at[1] - 0.95 * radius), (x, 1))


def level(a: str, b: str, tip: str = "", lines: str = "", wall: bool = False, written: str = "{}") -> Draw:
    """A dimension between two heights; the tool stands at `tip`, and heights among `lines` cross the work."""

    def draw(s: Sheet, kind: Kind) -> None:
        family = kind.section
        found, feet = work(s, family), list[Point]()
        s.address = written.format(s.address)
        if tip:
            stands(s, family, tip)
        if tip == "second":
            s.draw("dash", (SIDE + 6, height(family, "clear")), (RIGHT - 4, height(family, "clear")))
        if wall:
            s.draw("dash", *((found.span[0] + 5, height(family, end)) for end in ("surface", "bottom")))
        for line in filter(None, lines.split(",")):
            ends = (LEFT, found.span[0]) if family == "stud" else found.span
            s.draw("dash", (ends[0] + 1, height(family, line)), (ends[1] - 1, height(family, line)))
        for end in (a, b):
            pointed = end == "bottom" and found.kind in ("drill", "spot")
            feet.append((found.x if pointed or end in OF_TOOL else found.span[0], height(family, end)))
            if end in ("datum", "zero"):
                s.datum(13, feet[-1][1])
                feet[-1] = (17, feet[-1][1])
        s.measure((SIDE, feet[0][1]), (SIDE, feet[1][1]), *feet)

    return draw


def wait(at: str) -> Draw:
    """A dwell of the tool at a height."""

    def draw(s: Sheet, kind: Kind) -> None:
        found, y = work(s, kind.section), height(kind.section, at)
        stands(s, kind.section, at)
        s.draw("thin", (24, min(y, 53)), (found.x - found.half, y))
        s.clock(17, min(y, 53))

    return draw


def way(*stops: str, line: str = "") -> Draw:
    """A feed from height to height where the tool goes; with three of them there is a way down and one up beside it."""

    def draw(s: Sheet, kind: Kind) -> None:
        found = work(s, kind.section)
        x = SIDE if kind.figure == "face" else found.x
        if line:
            s.draw("dash", *((end, height(kind.section, line)) for end in found.span))
        for k, ends in enumerate(zip(stops, stops[1:])):
            beside = 4 * (2 * k - 1) if len(stops) > 2 else 0
            s.move(*((x + beside, height(kind.section, end) - 2 * (end == "bottom")) for end in ends))

    return draw


def spins(tip: str = "", *stops: str) -> Draw:
    """The spindle turns, with the tool at a height, or on its way."""

    def draw(s: Sheet, kind: Kind) -> None:
        if tip:
            work(s, kind.section)
            stands(s, kind.section, tip)
        else:
            way(*stops)(s, kind)
        s.spin(WORKS[kind.section].x, 10)

    return draw
