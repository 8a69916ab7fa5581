"""Obsolete finishing of pockets and studs, which still runs (1.2): 212 and 213 rectangular, 214 and 215 circular.

They are those of earlier manuals (TNC 426/430 8.4, iTNC 530). C is the centre Q216 Q217, R the tool radius, S the start on
the right of C, where the tool goes down from level to level; it goes once round in climb milling and comes back to S.

    212    S at Q218/2 - R - Q221, or at C where Q221 is 0 or leaves no way     214    at Q222/2 - R, or at C
    213    S at Q218/2 + Q221 + 3.5 R                                           215    at Q222/2 + 3.5 R

Readings where they are silent: the ways up to the wall and off it are half circles that end where the tool is nearest to S;
in a narrow pocket they are as wide as it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

from mnclab.controls.tnc_620.cycles import addresses
from mnclab.controls.tnc_620.cycles.addresses import coordinate, increment, length
from mnclab.controls.tnc_620.cycles.faults import SAME, Fault, at_least, at_most, not_zero, with_radius
from mnclab.controls.tnc_620.cycles.planes import AtSurface, in_program_coordinates
from mnclab.controls.tnc_620.machining.rounds import finish_rounds
from mnclab.geometry import contours
from mnclab.geometry.contours import Contour
from mnclab.machine.coordinates import MILLS
from mnclab.machine.cycle import CycleTable, too_many
from mnclab.machine.machine import Machine
from mnclab.machining.milling.finishing import half_circles
from mnclab.machining.milling.pocket_steps import Feeds
from mnclab.machining.steps import Go, Step, moved

CYCLES = CycleTable()
ASIDE = 3.5  # times R, from the blank of a stud to S


@CYCLES("CYCL DEF 212", "Pocket finishing", source="1.2")
class PocketFinishing(AtSurface):
    """Finishes the wall of a rectangular pocket on each infeed."""

    does = MILLS
    about = in_program_coordinates
    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    plunging_feed: float = addresses.plunge_feed()
    infeed: float = addresses.infeed(note="greater than 0")
    milling_feed: float = addresses.milling_feed()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(example=50)
    centre_x: float = coordinate("Q216", "centre along the first axis", example=50)
    centre_y: float = coordinate("Q217", "centre along the second axis", example=50)
    first_side_length: float = increment("Q218", "first side length", at_least=0, example=80)
    second_side_length: float = increment("Q219", "second side length", at_least=0, example=60)
    corner_radius: float = length("Q220", "corner radius", note="0: the tool radius", example=8)
    allowance: float = increment("Q221", "allowance in the first axis", note="for pre-positioning", at_least=0, example=2)

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from check(self, m)
        if not self.depth:
            return
        for name in ("first_side_length", "second_side_length"):
            yield from at_least(self, name, 3 * m.radius, "three times the tool radius")
        if 0 < self.corner_radius < m.radius - SAME:
            yield "corner_radius", f"must be 0 or at least the tool radius, {m.radius:g}, got {self.corner_radius:g}"
        yield from fitting_corner(self)

    def moves(self, m: Machine) -> Iterator[Step]:
        r, corner = m.radius, max(self.corner_radius, m.radius) - m.radius
        wall = contours.rectangle(self.first_side_length - 2 * r, self.second_side_length - 2 * r, corner)
        wide = self.first_side_length / 2 - r
        start = max(0.0, wide - self.allowance) if self.allowance else 0.0
        return finish(self, m, wall, start, min(wide - start, self.second_side_length - 2 * r))


@CYCLES("CYCL DEF 213", "Stud finishing", source="1.2")
class StudFinishing(AtSurface):
    """Finishes the side of a rectangular stud on each infeed."""

    does = MILLS
    about = in_program_coordinates
    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    plunging_feed: float = addresses.plunge_feed()
    infeed: float = addresses.infeed(note="greater than 0")
    milling_feed: float = addresses.milling_feed()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(example=50)
    centre_x: float = coordinate("Q216", "centre along the first axis", example=50)
    centre_y: float = coordinate("Q217", "centre along the second axis", example=50)
    first_side_length: float = increment("Q218", "first side length", at_least=0, example=80)
    second_side_length: float = increment("Q219", "second side length", at_least=0, example=60)
    corner_radius: float = length("Q220", "corner radius", example=5)
    allowance: float = increment("Q221", "allowance in the first axis", note="for pre-positioning", at_least=0, example=2)

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from check(self, m)
        if self.depth:
            yield from not_zero(self, "first_side_length", "second_side_length")
            yield from fitting_corner(self)

    def moves(self, m: Machine) -> Iterator[Step]:
        r = m.radius
        wall = contours.rectangle(self.first_side_length + 2 * r, self.second_side_length + 2 * r, self.corner_radius + r)
        start = self.first_side_length / 2 + self.allowance + ASIDE * r
        return finish(self, m, wall.reversed(), start, start - self.first_side_length / 2 - r)


@CYCLES("CYCL DEF 214", "Circular pocket finishing", source="1.2")
class CircularPocketFinishing(AtSurface):
    """Finishes the wall of a circular pocket on each infeed."""

    does = MILLS
    about = in_program_coordinates
    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    plunging_feed: float = addresses.plunge_feed()
    infeed: float = addresses.infeed(note="greater than 0")
    milling_feed: float = addresses.milling_feed()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(example=50)
    centre_x: float = coordinate("Q216", "centre along the first axis", example=50)
    centre_y: float = coordinate("Q217", "centre along the second axis", example=50)
    blank_diameter: float = length("Q222", "diameter of the rough pocket", note="less than Q223; 0: down at C", example=76)
    finished_diameter: float = length("Q223", "diameter of the finished pocket", example=80)

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from check(self, m)
        if not self.depth:
            return
        yield from at_least(self, "finished_diameter", 3 * m.radius, "three times the tool radius")
        if self.blank_diameter >= self.finished_diameter:
            found = f"{self.finished_diameter:g}, got {self.blank_diameter:g}"
            yield "blank_diameter", f"must be less than the diameter of the finished pocket Q223, {found}"

    def moves(self, m: Machine) -> Iterator[Step]:
        reach, start = self.finished_diameter / 2 - m.radius, max(0.0, self.blank_diameter / 2 - m.radius)
        return finish(self, m, Contour.circle((0, 0), reach), start, reach - start)


@CYCLES("CYCL DEF 215", "Circular stud finishing", source="1.2")
class CircularStudFinishing(AtSurface):
    """Finishes the side of a circular stud on each infeed."""

    does = MILLS
    about = in_program_coordinates
    clearance: float = addresses.clearance()
    depth: float = addresses.depth()
    plunging_feed: float = addresses.plunge_feed()
    infeed: float = addresses.infeed(note="greater than 0")
    milling_feed: float = addresses.milling_feed()
    surface: float = addresses.surface()
    second_clearance: float = addresses.second_clearance(example=50)
    centre_x: float = coordinate("Q216", "centre along the first axis", example=50)
    centre_y: float = coordinate("Q217", "centre along the second axis", example=50)
    blank_diameter: float = length("Q222", "diameter of the blank", note="greater than Q223", example=84)
    finished_diameter: float = length("Q223", "diameter of the finished stud", example=80)

    def check(self, m: Machine) -> Iterator[Fault]:
        yield from check(self, m)
        if not self.depth:
            return
        yield from not_zero(self, "finished_diameter")
        if self.blank_diameter <= self.finished_diameter:
            found = f"{self.finished_diameter:g}, got {self.blank_diameter:g}"
            yield "blank_diameter", f"must be greater than the diameter of the finished stud Q223, {found}"

    def moves(self, m: Machine) -> Iterator[Step]:
        reach, start = self.finished_diameter / 2 + m.radius, self.blank_diameter / 2 + ASIDE * m.radius
        return finish(self, m, Contour.circle((0, 0), reach, clockwise=True), start, start - reach)


AnyFinishing: TypeAlias = PocketFinishing | StudFinishing | CircularPocketFinishing | CircularStudFinishing

# --- what all share -------------------------------------------------------------------------------------------------


def check(c: AnyFinishing, m: Machine) -> Iterator[Fault]:
    """The sign of the depth, feeds and infeeds; a depth of 0 is not executed, so nothing of it can be wrong."""
    if not c.depth:
        return
    yield from c.signs(m)
    yield from with_radius(m)
    yield from not_zero(c, "plunging_feed", "infeed", "milling_feed", purpose="to mill with")
    yield from too_many("infeed", lambda: c.pecks(m))


def fitting_corner(c: PocketFinishing | StudFinishing) -> Iterator[Fault]:
    yield from at_most(c, "corner_radius", min(c.first_side_length, c.second_side_length) / 2, "half the shorter side")


def finish(c: AnyFinishing, m: Machine, wall: Contour, start: float, aside: float) -> Iterator[Step]:
    """By way of C to S, so far on its right, round on every level, and back over C; `aside` is as wide as the half circles."""
    if not c.down:
        yield c.left_out
        return
    x, y = c.centre_x, c.centre_y
    arcs, feeds = half_circles(wall, aside, 1), Feeds(c.milling_feed, c.plunging_feed)
    yield Go("to the second set-up clearance", max(m.programmed[2], c.end))
    yield Go("over the centre", x=x, y=y)
    yield Go("over the start", x=x + start)
    yield Go("to the set-up clearance", c.above)
    yield from moved(finish_rounds(wall, arcs, (start, 0.0), c.pecks(m), feeds), x, y)
    yield from c.leave()
    yield Go("over the centre", x=x, y=y)
