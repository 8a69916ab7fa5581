"""What is seen of a workpiece: from the side and from above.

From the side: what goes down into it, the heights above it, and the feeds between them. From above: sizes of a figure, its
place, what is left at its walls, and the tool along it.
"""

from __future__ import annotations

from typing import NamedTuple

from mnclab.lab.sketches.ink import Piece, Point, Sheet, box, circle, polar, turned
from mnclab.lab.sketches.kinds import Draw, Kind

LEFT, RIGHT, BASE, SIDE = 5, 91, 62, 30  # ends and foot of the material; where heights are dimensioned


class WorkOutline(NamedTuple):
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
    "hole": WorkOutline(notch((52, 31), (52, 49), (62, 54), (72, 49), (72, 31)), 62, 10, "drill", (52, 72)),
    "bore": WorkOutline(notch((52, 31), (52, 54), (72, 54), (72, 31)), 62, 8, "mill", (52, 72)),
    "centring": WorkOutline(notch((46, 31), (62, 54), (78, 31)), 62, 5, "spot", (46, 78)),
    "thread": WorkOutline(notch(*WALL, (52, 57), (72, 57), *mirrored(WALL, 62)), 62, 8, "mill", (52, 72)),
    "outside thread": WorkOutline(notch((48, 54), *STUD, *mirrored(STUD, 58), (68, 54)), 79, 6, "mill", (48, 68)),
    "back boring": WorkOutline(((LEFT, 31), (52, 31), (52, 41), (45, 41), (45, 49), (LEFT, 49)), 62, 5, "bar", (52, 72)),
    "pocket": WorkOutline(notch((44, 31), (44, 54), (82, 54), (82, 31)), 62, 7, "mill", (44, 82)),
    "stud": WorkOutline(notch((42, 54), (42, 31), (66, 31), (66, 54)), 79, 7, "mill", (42, 66)),
    "face": WorkOutline(notch((54, 49), (54, 31)), 72, 12, "mill", (54, 91)),
    "level face": WorkOutline(notch((54, 49), (54, 31)), 72, 12, "mill", (54, 91)),  # milled to its height at once
    "engraving": WorkOutline(notch((56, 31), (62, 44), (68, 31)), 62, 4, "spot", (56, 68)),
    "cylinder": WorkOutline(((52, 61, 36, 180, 104), (43, 41), (61, 41), (52, 61, 36, 76, 0)), 52, 6, "mill", (43, 61)),
    "cylinder ridge": WorkOutline(((52, 61, 22, 180, 114), (52, 61, 36, 104, 76), (52, 61, 22, 66, 0)), 68, 5, "mill", (43, 61)),
}


def height(family: str, name: str) -> float:
    """Y of a height of a family."""
    return OTHERWISE.get(family, {}).get(name, HEIGHTS[name])


def in_section(s: Sheet, family: str) -> WorkOutline:
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
        found, feet = in_section(s, family), list[Point]()
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
        found, y = in_section(s, kind.section), height(kind.section, at)
        stands(s, kind.section, at)
        s.draw("thin", (24, min(y, 53)), (found.x - found.half, y))
        s.clock(17, min(y, 53))

    return draw


def way(*stops: str, line: str = "") -> Draw:
    """A feed from height to height where the tool goes; with three of them there is a way down and one up beside it."""

    def draw(s: Sheet, kind: Kind) -> None:
        found = in_section(s, kind.section)
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
            in_section(s, kind.section)
            stands(s, kind.section, tip)
        else:
            way(*stops)(s, kind)
        s.spin(WORKS[kind.section].x, 10)

    return draw


# --- from above ----------------------------------------------------------------------------------------------------------

C = (50, 32)  # middle of a figure
DATUM = (11, 55)  # from where places are measured
PLACE = (62, 24)  # what has a place
HALVES = {"rectangle": (29, 20), "circle": (20, 20), "slot": (31, 10), "ridge": (31, 10), "polygon": (20, 20), "face": (31, 18)}
POINTS: dict[str, tuple[Point, ...]] = {
    "edge": ((36, 33), (72, 24)), "corner": ((50, 44), (72, 44), (34, 30), (34, 12)), "plane": ((36, 40), (80, 34), (56, 12)),
    "ruled": ((34, 42), (82, 38), (74, 10), (40, 16)), "four": ((38, 40), (80, 36), (76, 12), (42, 16)),
    "two": ((38, 38), (76, 18)), "slot": ((44, 24), (80, 24)),
}  # fmt: skip


def outline(figure: str, grow: float = 0, at: Point = C, part: float = 1) -> tuple[Piece, ...]:
    """A figure about a middle, grown on all sides."""
    wide, high = (part * half + grow for half in HALVES.get(figure, (8, 8)))
    if figure == "ring":  # a slot on a circle about (48, 56)
        return (48, 56, 42, 40, 110), (35.7, 22.2, 6, 110, 290), (48, 56, 30, 110, 40), (75.6, 32.9, 6, 220, 400)
    if figure in ("rectangle", "face", "slot", "ridge"):
        radius = {"rectangle": 6 * part, "face": 0}.get(figure, high)
        return box(at[0] - wide, at[1] - high, at[0] + wide, at[1] + high, radius)
    if figure == "polygon":
        return tuple(polar(at, wide / 0.866, 60 * k) for k in range(6))
    if figure == "contour":
        left, right, top, low, inner = 21 - grow, 79 + grow, 12 - grow, 53 + grow, 56 + grow
        return (left, top), (right, top), (right, 36 + grow), (inner, 36 + grow), (inner, low), (left, low)
    return circle(at, wide)


def from_above(s: Sheet, kind: Kind, *pieces: Piece) -> None:
    """The figure in its plate, or as what is left of it."""
    s.part(*(pieces or outline(kind.figure)))
    if kind.inside:
        s.draw("fill", *box(3, 3, 93, 61), closed=True)


def size(axis: str, grow: float = 0) -> Draw:
    """The length of a figure along X or Y; of another outline, dashed, where it is grown."""

    def draw(s: Sheet, kind: Kind) -> None:
        if kind.section == "touch" and kind.figure not in HALVES:
            kind = kind._replace(figure="circle")
        from_above(s, kind)
        if grow:
            s.draw("dash", *outline(kind.figure, grow), closed=True)
        half = HALVES[kind.figure]["xy".index(axis)] + grow
        x, y, beside = (half, 0, 0) if axis == "x" else (0, half, 14 if kind.figure == "rectangle" else 0)
        s.measure((C[0] - x + beside, C[1] + y), (C[0] + x + beside, C[1] - y))

    return draw


def rotation(s: Sheet, kind: Kind) -> None:
    """The angle of a figure from X; of a polygon that of its first corner."""
    from_above(s, kind, *turned(outline(kind.figure), C, 22))
    s.draw("dash", C, (88, C[1]))
    s.angle(C, 23, 0, 22, rays=8)


def allowance(s: Sheet, kind: Kind) -> None:
    """What is left at the wall: the finished figure, and the dashed one before it."""
    grow = -7 if kind.inside else 7
    from_above(s, kind)
    s.draw("dash", *outline(kind.figure, grow), closed=True)
    x = C[0] - HALVES.get(kind.figure, (29, 0))[0]
    s.measure((x, 31), (x - grow, 31))


def place(axis: str, number: int = 1, new: bool = False, middle: bool = False, inset: str = "") -> Draw:
    """Where one of the points of a figure, or its middle, lies from the datum along an axis; from a `new` one, which is set."""

    def draw(s: Sheet, kind: Kind) -> None:
        if axis == "z":
            s.draw("fill", (30, 62), (30, 34), (91, 34), (91, 62), closed=True)
            s.draw("edge", (30, 62), (30, 34), (91, 34))
            if kind.section == "touch":
                probe(s, (62, 29))
            s.datum(12, 57, "head" if new else "solid")
            return s.measure((22, 57), (22, 34), (16, 57), (62, 34))
        figure = inset or kind.figure
        spots: tuple[Point, ...] = POINTS.get(figure, (PLACE,))
        if figure in ("plane", "ruled"):
            s.part(*spots)
        elif figure in ("two", "four"):
            for spot in spots:
                s.part(*circle(spot, 7))
        elif figure == "edge":
            s.part((26, 31), (92, 15), (92, 3), (26, 3))
        elif figure == "corner":
            s.part((38, 40), (92, 40), (92, 3), (38, 3))
        elif figure == "top":
            s.part(*box(36, 7, 91, 41))
        elif figure in HALVES and figure != "face":
            s.part(*outline(figure, at=PLACE, part=0.55))
        elif figure in ("pattern", "ring", "grid", "point"):
            grid = [(PLACE[0] + 12 * k, PLACE[1] - 12 * row) for k in range(3) for row in range(2)]
            around = [polar(PLACE, 15, 60 * k) for k in range(6)]
            for hole in around if figure == "pattern" else grid if figure == "grid" else [PLACE]:
                s.draw("edge", *circle(hole, 3), closed=True)
            if figure in ("pattern", "ring"):
                s.draw("dash", *circle(PLACE, 15), closed=True)
        elif figure == "face":
            s.part(*box(PLACE[0], 6, 92, PLACE[1]))
        if middle:
            spots = ({"corner": (38, 40), "four": (59, 26)}.get(figure, PLACE),)
        elif len(spots) > 1:
            for k, spot in enumerate(spots):
                s.draw("edge" if k == number - 1 else "thin", *circle(spot, 3.6), closed=True)
        (x, y), (u, v) = DATUM, spots[number - 1]
        s.draw("thin", (x, 3), (x, y), (93, y))
        s.datum(x, y, "head" if new else "solid")
        s.draw("solid", *circle((u, v), 1.8), closed=True)
        if axis == "x":
            return s.measure((x, 47), (u, 47), (x, 47), (u, v))
        return s.measure((24, y), (24, v), (24, y), (u, v))

    return draw


def middle(axis: str) -> Draw:
    """Where the middle of a figure lies."""
    return place(axis, middle=True)


def mills(finish: bool = False) -> Draw:
    """The feed along the figure, or along its wall, by climb milling."""

    def draw(s: Sheet, kind: Kind) -> None:
        from_above(s, kind)
        wide, high = HALVES.get(kind.figure, (29, 20))
        grow = -9 if kind.inside else 6
        if finish:
            s.draw("dash", *outline(kind.figure, grow / 3), closed=True)
        if kind.figure in ("circle", "polygon"):
            start, end = (200, 340) if kind.inside else (190, 60)
            s.draw("tool", *circle(polar(C, high + grow, start), 5), closed=True)
            s.move((*C, high + grow, start, end))
        else:
            y = C[1] if kind.figure == "slot" else C[1] + high + grow if kind.inside else C[1] - high - grow
            s.draw("tool", *circle((C[0] - wide + 11, y), 5), closed=True)
            s.move((C[0] - wide + 11, y), (C[0] + wide * 0.5, y))
        s.anchor = C

    return draw


def touched(*angles: float, spread: float = 60) -> Draw:
    """Balls that touch a circle: the angle from one direction to another, or without any how many there are."""

    def draw(s: Sheet, kind: Kind) -> None:
        from_above(s, Kind("touch", "circle", kind.inside))
        for k in range(4):
            at = polar(C, 15.5 if kind.inside else 24.5, 20 + k * spread)
            s.draw("tool" if angles else "head", *circle(at, 4.5), closed=True)
        s.anchor = C
        if angles:
            s.angle(C, 12, angles[0], angles[1], 8)

    return draw
