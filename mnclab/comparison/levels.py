"""What a strategy does at one level: how hard the tool works there, what it leaves, and feeds that keep a chip thickness.

Lengths in mm, feeds in mm/min; angles in rad.

    reachable = where the tool centre may go, grown by the tool radius
    rest      = reachable less what the passes cover         corners = the area less its allowance less reachable

Engagement, chips and removal are those of everything that runs at the level: passes and links. The entries clear what is below
them and are not counted.

A tooth that feeds by f_z = feed / (speed · teeth) cuts a chip of the thickness f_z·cos θ where it stands at the angle θ from the
heading. Where the engagement φ begins at a side of the tool, θ reaches from 90° down to 90° - φ:

    greatest chip = f_z·sin φ for φ < 90°, f_z from there on
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats, counted
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import covered, left_over, polygons
from mnclab.machining.milling.clearing import HOPPED, Clearing, begin, end
from mnclab.machining.milling.engagement import Engagement, engagement
from mnclab.machining.milling.entries import Entry, descent
from mnclab.path.limits import Limits
from mnclab.path.places import divided
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Kind, Toolpath
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, plain, shown

BAND = 0.9  # of the thickness of a chip: where it changes more, a row is parted
NEAR = 1e-9  # mm


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


# Feeds that keep a chip thickness.

def tooth_rate(tool: Any, radius: float, chip: Any, spindle: Any, limits: Limits | None) -> float:
    """How many teeth of a tool cut in a minute; an Alarm where that is not known, or where the `chip` makes no sense."""
    if not isinstance(tool, Tool) or not tool.teeth:
        hint = f"mnclab.Tool(radius={radius:g}, teeth=3) in place of it"
        raise Alarm(f"the thickness of a chip (chip=, spindle=) needs a tool with teeth, got {shown(tool)}", hint=hint)
    if spindle is None:
        raise Alarm("the thickness of a chip needs the speed of the spindle", hint="spindle=8000, in rev/min")
    check_number(spindle, "the speed of the spindle (rev/min)", above=0, at_most=limits.spindle if limits else None)
    if chip is not None:
        check_number(chip, "the greatest chip (mm)", above=0)
    return float(plain(spindle) * tool.teeth)


def fed(path: Toolpath, level: float, way: Floats, thickness: Floats, most: float, rate: float) -> tuple[Toolpath, Floats]:
    """A path whose rows at a level feed by at most rate / thickness and by `most`, and the feeds (n,) at some places.

    The places stand after a `way` (n,) along those rows, entries left out, in order; `thickness` (n,) is that of the chip there
    as a share of the feed per tooth. Rows are parted at the places where it comes into another band, of two such at the thinner.
    """
    rows = np.flatnonzero(_at_level(path, level))
    upto = np.cumsum(path.lengths[rows])
    band = np.floor(np.log(np.maximum(thickness, rate / most)) / np.log(BAND))  # the higher, the thinner
    before = np.flatnonzero(np.diff(band))
    cuts = np.unique(way[before + (band[before] < band[before + 1])])
    row = np.minimum(np.searchsorted(upto, cuts), len(rows) - 1)
    share = 1 - (upto[row] - cuts) / path.lengths[rows[row]]
    row, share = row[(share > NEAR) & (share < 1 - NEAR)], share[(share > NEAR) & (share < 1 - NEAR)]
    more = np.bincount(row, minlength=len(rows))
    counts = np.ones(len(path), dtype=np.int64)
    counts[rows] += more
    until = np.ones(counts.sum())
    until[(np.cumsum(counts) - counts)[rows[row]] + counted(more)[1]] = share
    path, source = divided(path, counts, until)
    rows = np.flatnonzero(np.isin(source, rows))
    end = np.cumsum(path.lengths[rows])
    # What counts for a row is from the last place before it to the first one behind it: nothing is thicker between two places.
    first = np.maximum(np.searchsorted(way, end - path.lengths[rows] + NEAR, side="right") - 1, 0)
    last = np.minimum(np.searchsorted(way, end - NEAR) + 1, len(way))
    thickest = np.maximum.reduceat(np.append(thickness, 0.0), np.stack([first, last], axis=1).ravel())[::2]
    feeds, feed = np.minimum(most, rate / np.maximum(thickest, 1e-300)), path.feed.copy()
    feed[rows] = feeds
    return path.replace(feed=feed), feeds[np.minimum(np.searchsorted(end, way - NEAR), len(rows) - 1)]


def _at_level(path: Toolpath, level: float) -> np.ndarray:
    """Which rows run at a level, those of entries left out."""
    flat = (np.abs(path.start[:, 2] - level) < NEAR) & (np.abs(path.end[:, 2] - level) < NEAR) & (path.kind != Kind.RAPID)
    entry = np.array([label.startswith("entry") for label in path.labels])
    return np.asarray(flat & ~entry[path.label])
