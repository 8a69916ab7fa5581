"""All strategies that clear an area, by name, and what they leave cleared as well.

Every one takes a region, the tool radius and the greatest stepover, and `allowance` (what stays at the walls) and
`climb`; it returns a `Clearing`. The rounded ones take `smallest`, the least radius of their path, too. Lengths in mm.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import length_of
from mnclab.geometry.regions import Region
from mnclab.geometry.sweeps import covered, left_over, long_axes, polygons, strip
from mnclab.machining.milling.adaptive import adaptive, peeling
from mnclab.machining.milling.clearing import (
    EXACT,
    LINKED,
    NOWHERE,
    SLACK,
    Clearing,
    NoRoom,
    Piece,
    begin,
    end,
    links,
    numbered,
)
from mnclab.machining.milling.lines import one_way, zigzag
from mnclab.machining.milling.morphed import morphed_spiral
from mnclab.machining.milling.rest import reached, touching
from mnclab.machining.milling.rings import rings
from mnclab.machining.milling.rounded import rounded_rings, rounded_zigzag
from mnclab.machining.milling.slots import strokes
from mnclab.machining.milling.spirals import spiral
from mnclab.machining.milling.trochoids import trochoidal
from mnclab.path.tool import Tool
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, plain, shown

STRATEGIES: dict[str, Callable[..., Clearing]] = {
    "rings": rings, "spiral": spiral, "zigzag": zigzag, "one way": one_way, "trochoidal": trochoidal,
    "adaptive": adaptive, "peeling": peeling, "morphed spiral": morphed_spiral, "rounded rings": rounded_rings,
    "rounded zigzag": rounded_zigzag,
}  # fmt: skip
TANGENT = ("rounded rings", "rounded zigzag", "adaptive", "peeling", "morphed spiral")  # a straight link to a rest has corners
OPEN = ("adaptive", "peeling", "morphed spiral")  # they know of a stock themselves
LEAST = 1e-3  # of the tool radius: what is narrower and still stands counts as nothing
ROUNDS = 4


def clear(
    strategy: str, region: Region, radius: float, stepover: float, *, allowance: float = 0.0, climb: bool = True,
    complete: bool = True, stock: Region | None = None, **more: Any,
) -> Clearing:  # fmt: skip
    """`region` cleared by the strategy of this name, and if `complete` what it leaves cleared as well.

    Where a `stock` is given there is material in it alone: no pass runs farther than a tool diameter from it. What is exactly
    as wide as the tool is one stroke along its middle, whatever the strategy: "slot".

    >>> pocket = mnc.area.Region.of(mnc.area.rectangle(40, 20))
    >>> print(f"{mnc.strategies.clear('rings', pocket, 4, 4, complete=False).length:.3f}")  # 32 x 12 and 24 x 4 mm
    144.000
    """
    if not isinstance(region, Region):
        raise Alarm(f"a strategy clears a Region, got {shown(region)}", hint="mnclab.area.Region.of(a contour)")
    if strategy not in STRATEGIES:
        raise ValueError(f"unknown strategy {strategy!r}; known are {', '.join(STRATEGIES)}")
    if stock is not None and strategy in OPEN:
        more["stock"] = stock
    try:
        found = STRATEGIES[strategy](region, radius, stepover, allowance=allowance, climb=climb, **more)
        lines = strokes(region, radius + allowance)
    except NoRoom:
        lines = strokes(region, radius + allowance)
        if not lines:
            raise
        found = Clearing(region.inset(radius + allowance - EXACT), (), radius)
    straight = strategy not in TANGENT
    solid = None if stock is None else polygons(stock)
    pieces = [_completed(piece, radius, stepover, straight, solid) if complete else piece for piece in found.pieces]
    for line, name in zip(lines, numbered("slot", len(lines)), strict=True):
        pieces.append(Piece(NOWHERE, (line,), (), (name,), begin(line)))
    if stock is not None:
        pieces = [part for piece in pieces for part in ([piece] if piece.from_cleared else _parted(piece, radius, stock))]
    return replace(found, pieces=tuple(pieces))


def rest(region: Region, tool: Tool | float, before: Region | None = None) -> Region:
    """What a `tool` (or one of a radius, mm) leaves of an area, or of what stands `before` it: corners and necks.

    It is the `stock` of the tool after it: `mnclab.compare(region, 3.0, stock=mnclab.strategies.rest(region, 8.0))`. Everything
    where the tool does not fit; empty where it leaves nothing.

    >>> pocket = mnc.area.Region.of(mnc.area.rectangle(40, 20))
    >>> print(f"{mnc.strategies.rest(pocket, 4).area:.2f}")  # four corners: (4 - pi) x 4 x 4
    13.73
    """
    for each in (region, *(() if before is None else (before,))):
        if not isinstance(each, Region):
            raise Alarm(f"a tool leaves something of a Region, got {shown(each)}", hint="mnclab.area.Region.of(a contour)")
    radius = plain(tool.effective_radius if isinstance(tool, Tool) else tool)
    check_number(radius, "the tool (its radius, mm, or a Tool)", above=0)
    lines = strokes(region, radius)
    slots = [strip(line, radius) if line.length else Region.of(Contour.circle(line.points[0], radius)) for line in lines]
    return (region if before is None else region.intersection(before)).without([reached(region, radius), *slots])


def _parted(piece: Piece, radius: float, stock: Region) -> list[Piece]:
    """The passes of a piece where they touch the stock, and a little before and behind, at most a tool diameter from it: a piece
    for each stretch, but for whole passes that follow one another and those that begin where one ends."""
    parts: list[Piece] = []
    whole = -1  # the last pass that is one, and was kept
    for k, contour in enumerate(piece.passes):
        for stretch in touching(contour, stock, radius, overlap=0.65 * radius, gap=radius / 2):
            follows = stretch is contour and whole == k - 1
            if parts and (follows or length_of(begin(stretch) - end(parts[-1].passes[-1])) < SLACK):
                last = parts[-1]
                last = replace(last, passes=(*last.passes, stretch), labels=(*last.labels, piece.labels[k]))
                parts[-1] = replace(last, linked=(*last.linked, piece.linked[k - 1] if follows else LINKED))
            else:
                free = not stock.contains([begin(stretch)])[0] and float(stock.distance([begin(stretch)])[0]) >= radius
                place = piece.place if k == 0 and stretch is contour else None
                parts.append(Piece(piece.centres, (stretch,), (), (piece.labels[k],), place, from_side=bool(free)))
            whole = k if stretch is contour else -1
    return parts


def _completed(piece: Piece, radius: float, stepover: float, straight: bool, stock: Any = None) -> Piece:
    """A piece with a pass through everything that the tool can reach and has left standing.

    Cores and slivers between passes more than a tool radius apart: narrower than the tool, so one pass along them does.
    `straight`: the tool may go there on a straight link.
    """
    if not piece.centres.loops:
        return piece
    reach = polygons(piece.centres).buffer(radius * (1 - LEAST), quad_segs=64)
    reach = reach if stock is None else reach.intersection(stock)
    cover, extra = covered(piece.passes, radius), []
    for _ in range(ROUNDS):
        new = _through(left_over(reach, cover, LEAST * radius), piece.centres)
        if not new:
            break
        extra += new
        cover = cover.union(covered(new, radius))
    if not extra:
        return piece
    passes = (*piece.passes, *extra)
    labels = (*piece.labels, *(f"rest {k} of {len(extra)}" for k in range(1, len(extra) + 1)))
    ways = links(piece.centres, passes, stepover)[len(piece.linked) :] if straight else (False,) * len(extra)
    return replace(piece, passes=passes, linked=(*piece.linked, *ways), labels=labels)


def _through(rest: Region, centres: Region) -> list[Contour]:
    """A pass through each piece that stands, as far as the tool centre may go."""
    found = []
    for a, b in long_axes(rest):
        if centres.holds(a, b):
            found.append(Contour([a, b], closed=False))
        else:
            found += [Contour([p, p], closed=False) for p in (a, (a + b) / 2, b) if centres.contains([p])[0]]
    return found
