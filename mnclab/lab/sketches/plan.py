"""Seen from above: sizes of a figure, its place, what is left at its walls, and the tool along it."""

from __future__ import annotations

from mnclab.lab.sketches.ink import Piece, Point, Sheet, box, circle, polar, turned
from mnclab.lab.sketches.kinds import Draw, Kind
from mnclab.lab.sketches.sections import probe

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


def work(s: Sheet, kind: Kind, *pieces: Piece) -> None:
    """The figure in its plate, or as what is left of it."""
    s.part(*(pieces or outline(kind.figure)))
    if kind.inside:
        s.draw("fill", *box(3, 3, 93, 61), closed=True)


def size(axis: str, grow: float = 0) -> Draw:
    """The length of a figure along X or Y; of another outline, dashed, where it is grown."""

    def draw(s: Sheet, kind: Kind) -> None:
        if kind.section == "touch" and kind.figure not in HALVES:
            kind = kind._replace(figure="circle")
        work(s, kind)
        if grow:
            s.draw("dash", *outline(kind.figure, grow), closed=True)
        half = HALVES[kind.figure]["xy".index(axis)] + grow
        x, y, beside = (half, 0, 0) if axis == "x" else (0, half, 14 if kind.figure == "rectangle" else 0)
        s.measure((C[0] - x + beside, C[1] + y), (C[0] + x + beside, C[1] - y))

    return draw


def rotation(s: Sheet, kind: Kind) -> None:
    """The angle of a figure from X; of a polygon that of its first corner."""
    work(s, kind, *turned(outline(kind.figure), C, 22))
    s.draw("dash", C, (88, C[1]))
    s.angle(C, 23, 0, 22, rays=8)


def allowance(s: Sheet, kind: Kind) -> None:
    """What is left at the wall: the finished figure, and the dashed one before it."""
    grow = -7 if kind.inside else 7
    work(s, kind)
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
        work(s, kind)
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
        work(s, Kind("touch", "circle", kind.inside))
        for k in range(4):
            at = polar(C, 15.5 if kind.inside else 24.5, 20 + k * spread)
            s.draw("tool" if angles else "head", *circle(at, 4.5), closed=True)
        s.anchor = C
        if angles:
            s.angle(C, 12, angles[0], angles[1], 8)

    return draw
