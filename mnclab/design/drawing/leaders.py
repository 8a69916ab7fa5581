"""Where a leader may go: to a note, to the diameter of a circle, to the radius of an arc.

        text of the first line
       /----------------------   reference line, the other lines below
      /
    |<  arrow
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product
from typing import NamedTuple

from mnclab.design.drawing.dimensions import Diameter, Note, Point, Radius
from mnclab.design.drawing.ink import ABOVE, ARROW, Arrow, Label, Mark
from mnclab.design.drawing.lettering import ASCENT, HEIGHT, PITCH, Block, block, value_block
from mnclab.design.drawing.placing import DIMENSION, LEADER

Called = Diameter | Radius | Note
LENGTHS = (7.0, 10.0, 14.0, 19.0, 25.0, 32.0, 40.0, 50.0, 62.0)
LONGER = (75.0, 90.0, 110.0, 130.0)  # where there was no room nearer
ACROSS = 26.0  # mm on paper: a larger circle may have its dimension line across
STEPS = 24  # directions of a full turn


class Tip(NamedTuple):
    """Where an arrow may end, in which direction its leader goes away (rad), what that costs, how long it may be."""

    at: Point
    angle: float
    cost: float


def texts_of(called: Called) -> list[Block]:
    """The lines of text."""
    if isinstance(called, Note):
        return [block(line) for line in called.lines]
    return [value_block(called.value), *(block(line) for line in called.more)]


def places(called: Called, scale: float, room: int) -> Iterator[Mark]:
    """Marks in the order of their costs; with `room` the leaders may be longer."""
    texts = texts_of(called)
    lengths = LENGTHS + LONGER[: 2 * room]
    offers = [
        (tip.cost + 0.16 * length, tip, length, right)
        for tip, length in product(_tips(called, scale), lengths)
        for right in ((True, False) if abs(math.cos(tip.angle)) < 0.2 else (math.cos(tip.angle) > 0,))
    ]
    across = list(_across(called, scale, texts)) if isinstance(called, Diameter) else []
    yield from sorted(across, key=lambda mark: mark.cost)
    for cost, tip, length, right in sorted(offers, key=lambda offer: offer[0]):
        yield _mark(called, texts, tip, length, right, cost)


def _tips(called: Called, scale: float) -> Iterator[Tip]:
    centre = called.at if isinstance(called, Note) else called.centre
    x, y, radius = centre[0] * scale, centre[1] * scale, called.radius * scale
    if isinstance(called, Radius):
        for share in (0.5, 0.3, 0.7, 0.15, 0.85):
            angle = called.start + share * called.sweep
            at = x + radius * math.cos(angle), y + radius * math.sin(angle)
            cost = 2.0 * abs(share - 0.5)
            yield Tip(at, angle, cost + _slope(angle))
            yield Tip(at, angle + math.pi, cost + _slope(angle) + 0.3)
        return
    for k in range(STEPS):
        angle = (k + 0.5) * math.tau / STEPS if radius == 0 else k * math.tau / STEPS
        yield Tip((x + radius * math.cos(angle), y + radius * math.sin(angle)), angle, _slope(angle))


def _slope(angle: float) -> float:
    """Leaders are neither level nor upright, least of all along an axis: 45° to 60° is best."""
    steep = math.degrees(math.asin(min(1.0, abs(math.sin(angle)))))
    return 0.06 * abs(steep - 52.0)


def _mark(called: Called, texts: list[Block], tip: Tip, length: float, right: bool, cost: float) -> Mark:
    knee = tip.at[0] + length * math.cos(tip.angle), tip.at[1] + length * math.sin(tip.angle)
    width = max(text.width for text in texts) + 1.0
    end = knee[0] + (width if right else -width), knee[1]
    start = min(knee[0], end[0]) + 0.5
    mark = Mark(called, cost, [(LEADER, tip.at, knee), (LEADER, knee, end)])
    mark.arrows = [Arrow(tip.at, tip.angle + math.pi)]
    lift = ABOVE - min(0.0, texts[0].low + 0.9)
    mark.labels = [Label(texts[0], (start, knee[1] + lift))]
    y = knee[1] - 1.2 - ASCENT * HEIGHT
    for text in texts[1:]:
        mark.labels.append(Label(text, (start, y)))
        y -= PITCH * HEIGHT
    mark.places = (tip.at, knee)
    return mark


def _across(called: Diameter, scale: float, texts: list[Block]) -> Iterator[Mark]:
    """The dimension line through the centre of a large circle, its text along it."""
    radius, text = called.radius * scale, texts[0]
    if 2 * radius < max(ACROSS, text.width + 2 * ARROW + 4) or len(texts) > 1:
        return
    x, y = called.centre[0] * scale, called.centre[1] * scale
    for degrees, share in product((45, -45, 30, -30, 60, -60, 15, -15, 75, -75), (0.5, -0.5, 0.3, -0.3, 0.75, -0.75)):
        angle = math.radians(degrees)
        c, s = math.cos(angle), math.sin(angle)
        first, last = (x - radius * c, y - radius * s), (x + radius * c, y + radius * s)
        u = share * (radius - ARROW) - text.width / 2
        if u < -radius + ARROW or u + text.width > radius - ARROW:
            continue
        mark = Mark(called, 1.0 + 0.06 * abs(abs(degrees) - 45) + abs(share), [(DIMENSION, first, last)])
        mark.arrows = [Arrow(first, angle + math.pi), Arrow(last, angle)]
        lift = ABOVE - min(0.0, text.low + 0.9)
        mark.labels = [Label(text, (x + u * c - lift * s, y + u * s + lift * c), angle)]
        mark.places = (first, last)
        yield mark
