"""Where the dimension of an angle may stand: arcs about its vertex, the text upright beside their middle."""

from __future__ import annotations

import math
from collections.abc import Iterator

from mnclab.design.drawing.dimensions import Angle, Point
from mnclab.design.drawing.ink import ABOVE, ARROW, GAP, OVERSHOOT, Arrow, Label, Mark
from mnclab.design.drawing.lettering import value_block
from mnclab.design.drawing.placing import EXTENSION
from mnclab.geometry.contours import Contour
from mnclab.text.alarm import Alarm

RADII = (12.0, 16.0, 20.0, 25.0, 30.0, 36.0, 43.0, 50.0, 60.0, 70.0)
LONGER = (85.0, 100.0, 120.0)
TAIL = 8.0  # mm of arc behind an arrowhead that stands outside


def places(angle: Angle, scale: float, room: int) -> Iterator[Mark]:
    """Marks in the order of their costs; with `room` the arcs may be larger."""
    x, y = angle.vertex[0] * scale, angle.vertex[1] * scale
    legs = [(p[0] * scale - x, p[1] * scale - y) for p in (angle.a, angle.b)]
    lengths = [math.hypot(*leg) for leg in legs]
    start, end = (math.atan2(leg[1], leg[0]) for leg in legs)
    sweep = (end - start) % math.tau
    if min(lengths) < 1e-9 or sweep < 1e-6:
        raise Alarm(f"the angle {angle.value.text} at {angle.vertex} has no opening from {angle.a} to {angle.b}")
    text, near = value_block(angle.value), angle.near * scale
    offers = []
    for radius in RADII + LONGER[: 2 * room]:
        beyond = sum(max(0.0, radius - length, near - radius) for length in lengths)
        inside = radius * sweep > 2 * ARROW + 3
        for share, out in ((0.5, 1), (0.3, 1), (0.7, 1), (0.5, -1), (-0.3, 1), (1.3, 1)):
            if inside or not 0 < share < 1:
                cost = 0.1 * radius + 0.1 * beyond + 3 * abs(share - 0.5) + (0.8 if out < 0 else 0.0)
                offers.append((cost, radius, share, out, inside))
            else:
                offers.append((0.1 * radius + 0.1 * beyond + 1.0, radius, share, out, inside))
    for cost, radius, share, out, inside in sorted(offers):
        tail = 0.0 if inside else TAIL / radius
        far = share * sweep if 0 < share < 1 else (-TAIL / radius if share < 0 else sweep + TAIL / radius)
        mark = Mark(angle, cost)
        at = start + far
        reach = radius + out * (ABOVE + abs(text.width / 2 * math.cos(at)) + abs(text.high / 2 * math.sin(at)) + 0.6)
        middle = x + reach * math.cos(at), y + reach * math.sin(at)
        mark.labels = [Label(text, (middle[0] - text.width / 2, middle[1] - (text.low + text.high) / 2))]
        mark.arc = _arc((x, y), radius, min(start - tail, at), max(start + sweep + tail, at))
        for place, sense in ((start, -1.0), (start + sweep, 1.0)):
            tip = x + radius * math.cos(place), y + radius * math.sin(place)
            # the back of the arrowhead lies on the arc: it leans by half of the angle that it takes up there
            lean = sense * (math.pi / 2 - ARROW / radius / 2) if inside else -sense * (math.pi / 2 - ARROW / radius / 2)
            mark.arrows.append(Arrow(tip, place + lean))
        for (dx, dy), length in zip(legs, lengths, strict=True):
            reaches = []
            if radius > length + GAP:
                reaches = [length + GAP, radius + OVERSHOOT]
            elif radius < near - GAP:
                reaches = [near - GAP, max(0.0, radius - OVERSHOOT)]
            if reaches:
                first, last = ((x + r * dx / length, y + r * dy / length) for r in reaches)
                mark.lines.append((EXTENSION, first, last))
        mark.places = ((x, y), *((x + dx, y + dy) for dx, dy in legs), (x + radius * math.cos(at), y + radius * math.sin(at)))
        yield mark


def _arc(centre: Point, radius: float, first: float, last: float) -> Contour:
    """An arc counter-clockwise, in two elements so that none is a full turn."""
    angles = [first, (first + last) / 2, last]
    bulge = math.tan((last - first) / 8)
    points = [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles]
    return Contour(points, [bulge, bulge, 0.0], closed=False)
