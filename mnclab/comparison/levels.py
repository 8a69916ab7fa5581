"""What a strategy does at one level: how hard the tool works there, and what it leaves.

Lengths in mm, feeds in mm/min; angles in rad.

    reachable = where the tool centre may go, grown by the tool radius
    rest      = reachable less what the passes cover         corners = the area less its allowance less reachable

Engagement, chips and removal are those of everything that runs at the level: passes and links. The entries clear what is below
them and are not counted.

    chip = f_z·sin φ for an engagement φ below 90°, f_z from there on         f_z = feed / (speed · teeth)
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import covered, left_over, polygons
from mnclab.machining.milling.clearing import HOPPED, Clearing, begin, end
from mnclab.machining.milling.engagement import Engagement, engagement
from mnclab.machining.milling.entries import Entry, descent


@dataclass(frozen=True, eq=False, repr=False)
class Look:
    """How hard a tool works on a clearing `step` mm deep, at places `spacing` mm apart: looked at when it is asked for."""

    clearing: Clearing
    stands: Region | None
    step: float
    entry: Entry
    climb: bool
    radius: float
    spacing: float

    @cached_property
    def found(self) -> tuple[Engagement, np.ndarray]:
        """The engagement of what is counted, and the way up to each sample without what is not."""
        moves, counted = level_moves(self.clearing, self.entry, self.step, self.climb)
        kept = np.array(counted, dtype=bool)
        found = engagement(moves, self.radius, spacing=self.spacing, stock=self.stands)
        found = found.chosen(kept[found.move])
        return found, found.way - np.cumsum([contour.length for contour in moves] * ~kept)[found.move]


@dataclass(frozen=True, eq=False, repr=False)
class Level:
    """One level of a trial: `region` is its area, `clearing` its passes, `depth` how far it lies below the surface, `step` how
    far below the level before it, mm.

    `allowance` mm; `feeds` mm/min is one feed, or that at each of the samples of the `engagement` (n,); `before` is what was
    cleared before, `tooth_rate` how many teeth cut in a minute, 0 where that is not known.
    """

    region: Region
    clearing: Clearing
    look: Look
    depth: float
    step: float
    feeds: float | np.ndarray
    allowance: float
    before: Region
    tooth_rate: float

    def __repr__(self) -> str:
        return f"<Level: {self.depth:g} mm deep, {self.clearing!r}>"

    @property
    def engagement(self) -> Engagement:
        """That of what is counted."""
        return self.look.found[0]

    @property
    def feed(self) -> np.ndarray:
        """At each sample of the engagement, mm/min `(n,)`."""
        return np.broadcast_to(self.feeds, len(self.engagement.way))

    @property
    def entries(self) -> np.ndarray:
        """Where the tool goes down into material, `(n, 2)`."""
        spots = []
        for piece in self.clearing.pieces:
            lifted = [k for k, linked in enumerate(piece.linked, 1) if not linked and not piece.begins_cleared(k)]
            spots += [*([] if piece.from_side else [piece.entry]), *(begin(piece.passes[k]) for k in lifted)]
        return np.array(spots).reshape(-1, 2)

    @cached_property
    def _areas(self) -> tuple[Any, Any, Any]:
        whole = polygons(self.region.inset(self.allowance))
        reach = polygons(self.clearing.centres.offset(self.clearing.radius)) if self.clearing.centres.loops else whole
        return whole, reach, covered(self.clearing.passes, self.clearing.radius).union(polygons(self.before))

    @cached_property
    def rest(self) -> Region:
        """What the tool could have reached and has left standing."""
        return left_over(*self._areas[1:], self.clearing.radius * 1e-3)

    @cached_property
    def corners(self) -> Region:
        """What the tool is too large for."""
        return left_over(*self._areas[:2], self.clearing.radius * 1e-3)

    @cached_property
    def covered(self) -> float:
        """The share of the reachable area that is cleared."""
        reach = self._areas[1]
        return float(1 - self.rest.area / reach.area) if reach.area else 1.0

    @property
    def removal(self) -> np.ndarray:
        """What is cut at each sample of the engagement, cm³/min."""
        return self.engagement.width * self.step * self.feed / 1000

    @property
    def chip(self) -> np.ndarray:
        """The greatest thickness of a chip at each sample of the engagement, mm `(n,)`; nan where teeth or speed is unknown."""
        return self.engagement.thickness * self.feed / (self.tooth_rate or np.nan)


def level_moves(clearing: Clearing, entry: Entry, step: float, climb: bool) -> tuple[list[Contour], list[bool]]:
    """Everything that a clearing runs at its level, in order, and which of it is counted: all but the entries."""
    moves: list[Contour] = []
    counted: list[bool] = []
    for piece in clearing.pieces:
        for k in range(max(1, len(piece.passes))):
            if not (k and piece.linked[k - 1]) and (piece.passes or piece.place is not None):
                down = descent(piece, entry, clearing.radius, 0.0, -step, climb, k)
                moves.append(down.contour if down.clears else Contour(down.contour.points[[0, 0]], closed=False))
                counted.append(False)
            if not piece.passes:
                continue
            before, contour = end(moves[-1]), piece.passes[k]
            hopped = k and piece.linked[k - 1] == HOPPED
            linked = not hopped and np.hypot(*(begin(contour) - before)) > 1e-9
            moves += [*([Contour([before, begin(contour)], closed=False)] if linked else []), contour]
            counted += [*([True] if linked else []), not piece.labels[k].startswith("entry")]
    return moves, counted
