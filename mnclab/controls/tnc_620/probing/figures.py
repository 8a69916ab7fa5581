"""Figures as presetting and inspecting cycles touch them: what is found, and the contacts (TNC 620, chapters 14 to 16)."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mnclab.controls.tnc_620.probing.cycle import ProbingCycle, needed
from mnclab.machine.machine import Machine
from mnclab.machine.touching import Contact
from mnclab.machining.probing import fits
from mnclab.machining.probing.found import Circle, Rectangle
from mnclab.machining.probing.sequences import ROUND, Approach, Pair, Steps, around, from_centre, sides
from mnclab.machining.probing.sketches import sketch


def circle(c: ProbingCycle, m: Machine, contacts: Sequence[Contact]) -> Circle:
    """Of the ball's centres."""
    found: Circle = needed(fits.circle, [each.point for each in contacts], "power", m=m, code=c.code)
    return found


def ring(c: ProbingCycle, m: Machine, a: Approach, centre: Pair, leave: bool = True) -> Steps:
    """A hole or a round stud, as its angles say."""
    angles, over = (c.starting_angle, c.stepping_angle, int(c.points)), c.traverse == 1
    contacts = yield from around(a, centre, c.diameter / 2, *angles, c.inside, m.programmed[2], over, leave)
    found = circle(c, m, contacts).grown(a.ball if c.inside else -a.ball)
    yield sketch(Circle(*centre, c.diameter / 2), found, c.level, contacts)
    return found, contacts


def box(c: ProbingCycle, m: Machine, a: Approach, centre: Pair) -> Steps:
    """A pocket or a stud with straight sides along the axes."""
    contacts = yield from sides(a, centre, (c.length / 2, c.width / 2), ROUND, c.inside, m.programmed[2])
    right, back, left, front = (each.point for each in contacts)
    found = needed(fits.rectangle, [right, left, back, front], m=m, code=c.code).grown(a.ball if c.inside else -a.ball)
    yield sketch(Rectangle(*centre, c.length, c.width), found, c.level, contacts)
    return found, contacts


def holes(c: ProbingCycle, m: Machine, a: Approach, places: Sequence[Pair]) -> Steps:
    """The centres of holes, touched one after the other over the clearance height, and all contacts."""
    found, contacts = [], []
    for k, place in enumerate(places):
        touched = yield from from_centre(a, place, a.height if k else m.programmed[2])
        contacts += touched
        found.append(circle(c, m, touched).centre)
    return found, contacts


def bolt_circle(c: ProbingCycle, m: Machine, a: Approach) -> Steps:
    """The circle through three holes at their angles."""
    x, y, radius = c.middle_x, c.middle_y, c.diameter / 2
    turns = map(math.radians, (c.first_angle, c.second_angle, c.third_angle))
    places = [(x + radius * math.cos(turn), y + radius * math.sin(turn)) for turn in turns]
    centres, contacts = yield from holes(c, m, a, places)
    found = needed(fits.circle, centres, m=m, code=c.code)
    yield sketch(Circle(x, y, radius), found, c.level, contacts)
    return found, contacts
