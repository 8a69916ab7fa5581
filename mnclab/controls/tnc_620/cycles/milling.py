"""What the cycles for pockets, slots and studs share (chapter 6): depths, heights, what is done, and the feeds for it.

    roughing: infeeds of Q202, at most LCUTS, down to Q369 above the floor; the last one is the rest
    side finishing: infeeds of Q338, or one, down to the same level;  floor finishing: one infeed at Q203 + Q201

The parameters of the cycles have the same names. Each says where its figure lies and what shape it has.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from functools import partial
from typing import Any, ClassVar, NamedTuple

from mnclab.controls.tnc_620.cycles import addresses, planes
from mnclab.controls.tnc_620.cycles.planes import AtSurface, ParameterFault
from mnclab.machine.coordinates import MILLS, tool
from mnclab.machine.cycle import too_many
from mnclab.machine.machine import Machine
from mnclab.machining.depths import infeeds
from mnclab.machining.milling.pocket_steps import LevelFeeds, PocketWork
from mnclab.machining.steps import Go, Say, Step, moved
from mnclab.path.tool import Tool

Place = tuple[float, float]


class Figure(NamedTuple):
    """What is milled at one place: steps that count from `centre` and begin at `start`, in program coordinates."""

    start: Place
    centre: Place
    steps: Iterable[Step]


def edges(tool: Tool) -> float:
    """LCUTS; a tool without has edges all along."""
    return tool.cutting_length if tool.cutting_length > 0 else math.inf


#: Parameters as the cycles of chapter 6 have them.
PARAMETERS: dict[str, Any] = {
    "clearance": partial(addresses.clearance, predef=True),
    "second_clearance": partial(addresses.second_clearance, predef=True, example=50),
    "infeed": addresses.layer,
    "milling_type": partial(addresses.milling_type, predef=True),
    "plunging_feed": partial(addresses.plunge_feed, also=addresses.PLANE),
    "rotation_angle": partial(addresses.rotation, "Q224"),
    "first_side_length": partial(addresses.distance, "Q218", "first side length", example=80),
    "second_side_length": partial(addresses.distance, "Q219", "second side length", example=60),
    "finishing_feed": partial(addresses.finishing_feed, default=None, default_means="as Q207", example=500),
}


class MilledFigure(AtSurface):
    """A pocket, a slot or a stud; who inherits names the parameters, and says in `fits` what its shape needs."""

    does = MILLS
    about = planes.in_program_coordinates
    stands: ClassVar[bool] = False
    """Whether it is a stud, whose Q385 of 0 is the milling feed too."""
    machining_operation = side_allowance = floor_allowance = milling_feed = milling_type = plunging_feed = finishing_infeed = 0.0
    slot_width = overlap = plunging_strategy = feed_reference = rotation_angle = first_side_length = second_side_length = 0.0
    infeed: float
    finishing_feed: float | None = 0.0

    def contradictions(self) -> Iterator[ParameterFault]:
        """An infeed; not all of the depth is allowance. A depth of 0 is not executed, so nothing of it can be wrong."""
        if self.depth == 0:
            return
        yield from planes.not_zero(self, "infeed")
        yield from planes.less_than_depth(self, "floor_allowance", self.depth)
        yield from too_many("finishing_infeed", lambda: wall_levels(self))

    def check(self, m: Machine) -> Iterator[ParameterFault]:
        """The sign of the depth, a tool with a radius, feeds for all that is done, a number of levels to wait for; its shape."""
        if self.depth == 0:
            return
        yield from self.signs(m)
        yield from planes.with_radius(m)
        finishes = self.machining_operation != 1 and (self.side_allowance > 0 or self.floor_allowance > 0)
        used = {
            "milling_feed": self.machining_operation != 2 or (finishes and self.finishing_feed is None), "plunging_feed": True,
            "finishing_feed": finishes and not finishing_feed(self),
        }  # fmt: skip
        yield from planes.not_zero(self, *(name for name, needed in used.items() if needed), purpose="to mill with")
        yield from too_many("infeed", lambda: levels(self, m))
        yield from self.fits(m)


def levels(c: MilledFigure, m: Machine) -> tuple[float, ...]:
    """Of roughing."""
    return infeeds(c.surface, left_over(c), min(c.infeed, edges(tool(m))))


def left_over(c: MilledFigure) -> float:
    """Where roughing and side finishing end."""
    return float(c.surface + c.depth + c.down * c.floor_allowance)


def wall_levels(c: MilledFigure) -> tuple[float, ...]:
    """Of side finishing."""
    return infeeds(c.surface, left_over(c), c.finishing_infeed)


def work(c: MilledFigure, m: Machine, feeds: tuple[LevelFeeds, LevelFeeds, LevelFeeds]) -> PocketWork:
    """What is done of the cycle; Q351 = 0 is climb milling too."""
    roughs, finishes = c.machining_operation != 2, c.machining_operation != 1
    return PocketWork(
        surface=c.surface, left_over=left_over(c), above=c.above, lift=c.down * c.clearance, allowance=c.side_allowance,
        layers=levels(c, m) if roughs else (), walls=wall_levels(c) if finishes and c.side_allowance > 0 else (),
        floor=(c.surface + c.depth,) if finishes and c.floor_allowance > 0 else (), feeds=feeds,
        side=1 if c.milling_type >= 0 else -1,
    )  # fmt: skip


def finishing_feed(c: MilledFigure) -> float:
    """Q385, which came later than the cycles: without it the milling feed counts, for studs with 0 too."""
    if c.finishing_feed is None:
        return c.milling_feed
    return float(c.finishing_feed or (c.milling_feed if c.stands else 0.0))


def mill(
    c: MilledFigure, m: Machine, work: PocketWork, figures: Iterable[Figure], last: Iterable[Step] = (),
    why: str = "neither Q368 nor Q369 is given",
) -> Iterator[Step]:  # fmt: skip
    """Figure after figure, at rapid from the second set-up plane and back to it, and what comes `last`.

    `why` there may be nothing to do.
    """
    if work.is_nothing:
        yield Say(f"Q215=2 finishes nothing: {why}")
        return
    high = max(m.programmed[2], c.end)
    for figure in figures:
        yield Go("to the second set-up clearance", high)
        yield Go("over the start", x=figure.start[0], y=figure.start[1])
        yield Go("to the set-up clearance", c.above)
        yield from moved(figure.steps, *figure.centre)
        yield from c.leave()
        high = c.end
    yield from last


def turned(u: float, v: float, angle: float) -> Place:
    """A place turned by an angle, degrees."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    return c * u - s * v, s * u + c * v


def back(place: Place) -> Go:
    """At rapid in the plane where the tool is."""
    return Go("back", x=place[0], y=place[1])
