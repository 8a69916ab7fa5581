"""Figures that are touched from opposite sides, +X, -X, +Y, -Y: what is found, and the contacts (MNC 12, "probe motion").

A ball that has no room before a side begins in the centre, on all sides then (MNC-PROBE-CENTRE). The middle lies between
opposite contacts; the diameter is twice the mean distance of the ball from the centre, less or more the ball (MNC-G412-FIT).
"""

from __future__ import annotations

from collections.abc import Generator, Sequence
from typing import Any

from mnclab.machine.touching import Contact
from mnclab.machining.probing.fits import circle, rectangle
from mnclab.machining.probing.found import Circle, Rectangle, Width
from mnclab.machining.probing.sequences import MINUS_X, MINUS_Y, OPPOSITE, Approach, Pair, X, Y, sides
from mnclab.machining.probing.sketches import sketch
from mnclab.machining.steps import Step

Contacts = Sequence[Contact]
PAIRS = ((X, MINUS_X), (Y, MINUS_Y))


def middle(
    a: Approach, centre: Pair, size: float, k: int, inside: bool, now: float
) -> Generator[Step, Any, tuple[float, float, Contacts]]:  # fmt: skip
    """A slot or a ridge, across the axis `k` (0 X, 1 Y): its middle along the axis, its width."""
    contacts = yield from sides(a, centre, (size / 2, size / 2), PAIRS[k], inside, now, each=False)
    ball = a.ball if inside else -a.ball
    high, low = contacts[0].point[k] + ball, contacts[1].point[k] - ball
    found = (high + low) / 2
    x, y = (centre[0], found) if k else (found, centre[1])
    yield sketch(Width(*centre, size), Width(x, y, high - low), a.level, contacts, 90 * k)
    return found, high - low, contacts


def box(
    a: Approach, centre: Pair, lengths: Pair, inside: bool, now: float
) -> Generator[Step, Any, tuple[Rectangle, Contacts]]:  # fmt: skip
    """A rectangular pocket or island, its sides along the axes."""
    contacts = yield from sides(a, centre, (lengths[0] / 2, lengths[1] / 2), OPPOSITE, inside, now, each=False)
    found = rectangle([contact.point[:2] for contact in contacts]).grown(a.ball if inside else -a.ball)
    yield sketch(Rectangle(*centre, *lengths), found, a.level, contacts)
    return found, contacts


def ring(
    a: Approach, centre: Pair, diameter: float, inside: bool, now: float
) -> Generator[Step, Any, tuple[Circle, Contacts]]:  # fmt: skip
    """A bore or a boss."""
    contacts = yield from sides(a, centre, (diameter / 2, diameter / 2), OPPOSITE, inside, now, each=False)
    found = circle([contact.point[:2] for contact in contacts], "opposite").grown(a.ball if inside else -a.ball)
    yield sketch(Circle(*centre, diameter / 2), found, a.level, contacts)
    return found, contacts
