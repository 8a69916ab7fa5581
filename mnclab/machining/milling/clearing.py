"""What a strategy returns: passes of the tool centre in the plane, piece by piece, each with its name. Lengths in mm.

A *pass* is a contour, closed or open. Between two passes the tool either goes straight (a *link*), which never leads
it farther from what is cleared than one stepover, or it lifts. A cycle runs the passes on each of its levels.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.geometry.regions import Region
from mnclab.text.alarm import several

SLACK = 1e-6  # mm
EXACT = 1e-5  # mm, by which a tool is as wide as what it shall clear
NOWHERE = Region()
LIFTED, LINKED, HOPPED = range(3)  # the way on: up and down again, straight at the level, straight a little above it


class NoRoom(ValueError):
    """A tool finds no room for its centre in an area."""


@dataclass(frozen=True, eq=False)
class Piece:
    """A connected piece of the tool-centre area: one entry, then its passes in order.

    `linked[i]` tells whether the tool may go straight from the end of pass i to the start of pass i + 1; if not, it must lift.
    Where it cuts nothing on that way it is HOPPED: rapid, a small height above the level. `labels[i]` names pass i:
    "ring 3 of 7". `from_side`: the first pass begins beside the material, where
    the tool comes down free and cuts in from the side. `from_cleared`: so do
    all passes but entries.
    """

    centres: Region
    passes: tuple[Contour, ...]
    linked: tuple[int, ...]
    labels: tuple[str, ...]
    place: Floats | None = None
    from_side: bool = False
    from_cleared: bool = False

    def __repr__(self) -> str:
        return f"<Piece: {', '.join(self.labels)}>"

    @property
    def entry(self) -> Floats:
        """Where the tool goes down, `(2,)`: at `place`, else at the start of the first pass."""
        return begin(self.passes[0]) if self.place is None else self.place

    def begins_cleared(self, k: int) -> bool:
        """Whether pass k begins on one before it or beside the material, where the tool can come straight down."""
        if k == 0:
            return self.from_side
        if self.from_cleared:
            return not self.labels[k].startswith("entry")
        spot = begin(self.passes[k])[None]
        return any(contour.distance(spot)[0] < 1e-3 for contour in self.passes[:k])

    def reversed(self) -> Piece:
        """The same passes in the opposite order and sense; their names stay with them."""
        backwards = tuple(contour.reversed() for contour in self.passes[::-1])
        return Piece(self.centres, backwards, self.linked[::-1], self.labels[::-1])


@dataclass(frozen=True, eq=False)
class Clearing:
    """All passes of a strategy; `centres` is where the centre of a tool of `radius` may go, a `note` what one should know."""

    centres: Region
    pieces: tuple[Piece, ...]
    radius: float
    note: str = ""

    def __repr__(self) -> str:
        return f"<Clearing: {several(len(self.pieces), 'piece')}, {several(len(self.passes), 'contour')}, {self.length:.3f} mm>"

    @property
    def passes(self) -> tuple[Contour, ...]:
        return tuple(contour for piece in self.pieces for contour in piece.passes)

    @property
    def labels(self) -> tuple[str, ...]:
        return tuple(label for piece in self.pieces for label in piece.labels)

    @property
    def length(self) -> float:
        """Length of all passes, without the ways between them."""
        return sum(contour.length for contour in self.passes)

    def reversed(self) -> Clearing:
        """The same passes in the opposite order and sense, as for the way back on the next level."""
        return replace(self, pieces=tuple(piece.reversed() for piece in self.pieces[::-1]))


def begin(contour: Contour) -> Floats:
    """Where a pass begins, `(2,)`."""
    return np.asarray(contour.points[0])


def end(contour: Contour) -> Floats:
    """Where a pass ends, `(2,)`: a closed one where it began."""
    return np.asarray(contour.points[0 if contour.closed else -1])


def numbered(name: str, count: int) -> tuple[str, ...]:
    """Names of passes: "ring 1 of 3", …; one alone has no number."""
    return (name,) if count == 1 else tuple(f"{name} {k} of {count}" for k in range(1, count + 1))


def links(centres: Region, passes: Sequence[Contour], stepover: float) -> tuple[bool, ...]:
    """Which straight ways between passes stay in the tool-centre area and within a stepover of what is cleared."""
    boxes = np.array([contour.bounds for contour in passes]).reshape(-1, 2, 2)
    return tuple(
        _clear(centres, end(a), begin(b), passes[: k + 1], boxes[: k + 1], stepover)
        for k, (a, b) in enumerate(pairwise(passes))
    )


def _clear(
    centres: Region, a: Floats, b: Floats, done: Sequence[Contour], boxes: Floats, stepover: float
) -> bool:  # fmt: skip
    way = float(np.hypot(*(b - a)))
    if way > stepover + SLACK:
        share = np.linspace(0, 1, int(np.ceil(4 * way / stepover)) + 1)[:, None]
        spots = a + share * (b - a)
        low, high = np.minimum(a, b) - stepover - SLACK, np.maximum(a, b) + stepover + SLACK
        near = np.flatnonzero((boxes[:, 0] <= high).all(axis=1) & (boxes[:, 1] >= low).all(axis=1))
        for k in near[::-1]:
            spots = spots[done[k].distance(spots) > stepover + SLACK]
            if not len(spots):
                break
        else:
            return False
    return centres.holds(a, b)


def round_walls(centres: Region, passes: list[Contour], labels: list[str], climb: bool) -> None:
    """Adds passes round islands, then along walls; each begins where it comes nearest to the end of the last."""
    here = end(passes[-1]) if passes else centres.loops[0].points[0]
    for loop in sorted(centres.loops, key=lambda loop: loop.area):  # islands have areas below 0
        ring = loop.started_at(loop.nearest(here))
        passes.append(ring if climb else ring.reversed())
        labels.append("island" if loop.area < 0 else "wall")
        here = ring.points[0]


def joined(
    passes: Sequence[Contour], labels: tuple[str, ...], radius: float, centres: Region = NOWHERE,
    place: Floats | None = None, linked: bool = True,
) -> Clearing:  # fmt: skip
    """Passes that lead on to one another, the tool coming in at a place or where the first one begins."""
    links = (linked,) * max(0, len(passes) - 1)
    return Clearing(centres, (Piece(centres, tuple(passes), links, labels, place),), radius)


def piecewise(
    region: Region, radius: float, stepover: float, allowance: float, plan: Callable[[Region], Piece]
) -> Clearing:
    """A clearing planned for each piece of where the tool centre may go; a ValueError where the tool does not fit."""
    centres = tool_centres(region, radius, stepover, allowance)
    return Clearing(centres, tuple(plan(part) for part in centres.parts), radius)


def tool_centres(region: Region, radius: float, stepover: float, allowance: float) -> Region:
    """Where the tool centre may go; a ValueError where the tool does not fit, or where radius or stepover are none."""
    if not radius > 0:
        raise ValueError(f"the tool radius must be greater than 0, got {radius:g}")
    if not 0 < stepover <= 2 * radius:
        raise ValueError(f"the stepover must lie above 0 and not above twice the radius, got {stepover:g}")
    centres = region.inset(radius + allowance)
    if not centres.loops:
        raise NoRoom(unfit(region, radius, allowance))
    return centres


def unfit(region: Region, radius: float, allowance: float) -> str:
    """Why a tool finds no room for its centre in an area, in words."""
    rest = f" with an allowance of {allowance:g}" if allowance else ""
    if not region.loops:
        return "the area is empty: there is nothing to clear"
    if region.inset(radius + allowance - EXACT).loops:
        return (f"a tool of radius {radius:g}{rest} is exactly as wide as the contour, which leaves no way round: "
                "it is one stroke along the middle, as `mnclab.strategies.clear` cuts a slot, or a smaller tool")  # fmt: skip
    return f"a tool of radius {radius:g}{rest} does not fit into the contour"
