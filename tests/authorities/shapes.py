"""Random contours for generate_compensation.py: some that a tool may follow, some too narrow for it.

The tool runs on the left of a contour (side +1) or on its right (-1).
"""

import math
from itertools import pairwise

from contours import (
    UNIT,
    VECTORS,
    Element,
    angle_between,
    arc_toward,
    direction,
    line_to,
    moved,
    tangent_arc,
    tangent_line,
    turned,
)
from recording import TICKS, mm


def at(length, angle, grid=100):
    """The point in polar coordinates about the origin, on a grid of ticks."""
    return tuple(round(length * TICKS * part / grid) * grid for part in (math.cos(angle), math.sin(angle)))


# Contours that a tool may follow.


def route(rng, points, last_is_line=False):
    """Lines and arcs that lead near the given points, some with a tangential piece in between."""
    contour, here = [], points[0]
    for number, wanted in enumerate(points[1:], 2):
        along = direction(contour[-1], 1) if contour else None
        if along and rng.random() < 0.4:
            size = rng.uniform(6, 14)
            contour.append(
                tangent_line(here, along, size)
                if rng.random() < 0.4
                else tangent_arc(rng, here, along, size, rng.choice([1, -1]), most=1.3)
            )
            here = contour[-1].end
        if rng.random() < 0.5 or (last_is_line and number == len(points)):
            contour.append(line_to(here, wanted))
        else:
            contour.append(arc_toward(rng, here, wanted))
        here = contour[-1].end
    return contour


def open_contour(rng, side):
    """From left to right, up and down."""
    x, points = 0, []
    for _ in range(rng.randint(5, 9)):
        points.append((mm(x), rng.randint(-1500, 1500) * 100))
        x += rng.randint(9, 22)
    return route(rng, points)


def closed_contour(rng, side):
    """Round the origin from an outside corner back to it, the tool outside."""
    count = rng.randint(4, 8)
    angles = [side * -math.tau * (k + rng.uniform(-0.25, 0.25)) / count for k in range(count)]
    points = [at(rng.uniform(25, 45), angle) for angle in angles]
    return route(rng, [*points, points[0]], last_is_line=True)


def smooth_contour(rng, side):
    """Tangential from end to end: lines and arcs, or arcs and arcs."""
    along = rng.choice([(UNIT, 0), (0, -UNIT), (195, 260), (-300, 125)])
    contour, here = [], (0, 0)
    turn = rng.choice([1, -1])
    for number in range(rng.randint(4, 7)):
        if number % 2 == 0 and rng.random() < 0.7:
            contour.append(tangent_line(here, along, rng.uniform(5, 25)))
        else:
            contour.append(tangent_arc(rng, here, along, rng.uniform(5, 20), turn, most=1.9))
            turn = -turn
        here, along = contour[-1].end, direction(contour[-1], 1)
    return contour


def pocket(rng, side):
    """The inside of a pocket, begun and ended by a quarter circle; corners are sharp, round or pillars."""
    width, height, roll = mm(rng.randint(50, 90)), mm(rng.randint(40, 70)), mm(rng.randint(9, 14))
    gate = 0, -height // 2  # middle of the lower wall
    above = moved(gate, (0, roll))
    contour = [Element(moved(above, (-roll, 0)), gate, above, 1, wall=False)]
    here, course = gate, (UNIT, 0)  # counter-clockwise
    for x, y in [(1, -1), (1, 1), (-1, 1), (-1, -1)]:
        goal, leave = (x * width // 2, y * height // 2), turned(course)
        form, size = rng.choice(["sharp", "sharp", "round", "pillar"]), mm(rng.randint(7, 12)) // UNIT
        if form == "sharp":
            contour.append(line_to(here, goal))
        else:
            begin, end = moved(goal, course, -size), moved(goal, leave, size)
            contour.append(line_to(here, begin))
            inner = Element(begin, end, moved(begin, leave, size), 1)
            contour.append(inner if form == "round" else Element(begin, end, goal, -1))
        here, course = contour[-1].end, leave
    contour.append(line_to(here, gate))
    contour.append(Element(gate, moved(above, (roll, 0)), above, 1, wall=False))
    return contour if side > 0 else [mirrored(element) for element in contour]


def mirrored(element):
    start, end, centre = ((-p[0], p[1]) if p else None for p in element[:3])
    return Element(start, end, centre, -element.turn, element.wall)


# Contours that are too narrow for the tool.


def narrow_groove(rng, side, radius):
    """Down, over a floor shorter than the tool is wide, and up again."""
    down, up = (math.radians(rng.uniform(60, 90)) for _ in range(2))
    room = radius * (math.tan(down / 2) + math.tan(up / 2))
    floor = rng.uniform(0.3, 0.9) * room
    points = [(-60, 0), (0, 0)]
    for length, angle in ((30, -down), (floor, 0), (30, up), (60, 0)):
        x, y = points[-1]
        points.append((x + length * math.cos(angle), y + length * math.sin(angle)))
    points = [(mm(x), mm(side * y)) for x, y in points]
    return [line_to(a, b) for a, b in pairwise(points)]


def narrow_arc(rng, side, radius):
    """A line, a tangential inside arc smaller than the tool, a tangential line."""
    first = tangent_line((0, 0), (UNIT, 0), 40)
    size = rng.uniform(0.3, 0.95) * radius
    arc = tangent_arc(rng, first.end, (UNIT, 0), size, side, least=0.8, most=2)
    return [first, arc, tangent_line(arc.end, direction(arc, 1), 40)]


def narrow_corner(rng, side, radius):
    """Two inside corners with an element between them that is too short; lines or arcs all three."""
    start, end = (0, 0), at(rng.uniform(0.3, 0.8) * radius, 0)
    middle = line_to(start, end) if rng.random() < 0.4 else arc_toward(rng, start, end, most=1.2)
    before = moved(start, at(40, side * math.radians(rng.uniform(100, 130))))
    after = moved(middle.end, at(40, side * math.radians(rng.uniform(50, 80))))
    first = arc_toward(rng, before, start, most=0.8) if rng.random() < 0.5 else line_to(before, start)
    if first.end != start:  # an arc ends only near its goal: carry the rest along
        step = first.end[0] - start[0], first.end[1] - start[1]
        middle = Element(*[moved(p, step) if p else None for p in middle[:3]], middle.turn)
        after = moved(after, step)
    last = arc_toward(rng, middle.end, after, most=0.8) if rng.random() < 0.5 else line_to(middle.end, after)
    return [first, middle, last]


def narrow_bay(rng, side, radius):
    """A line or an inside arc, and behind an inside corner another inside arc; no place touches both."""
    along = rng.choice(VECTORS)
    after = rng.choice([v for v in VECTORS if 1 < side * angle_between(along, v) < 2.6])
    arc = tangent_arc(rng, (0, 0), after, rng.uniform(1.1, 3) * radius, side, least=1, most=2)
    if rng.random() < 0.5:
        return [line_to(moved((0, 0), along, -1000), (0, 0)), arc]
    back = tangent_arc(rng, (0, 0), moved((0, 0), along, -1), rng.uniform(1.1, 3) * radius, -side, least=1, most=2)
    return [Element(back.end, back.start, back.centre, side), arc]


FAMILIES = {"open": open_contour, "closed": closed_contour, "smooth": smooth_contour, "pocket": pocket}
NARROW = {"groove": narrow_groove, "small_arc": narrow_arc, "short": narrow_corner, "bay": narrow_bay}
