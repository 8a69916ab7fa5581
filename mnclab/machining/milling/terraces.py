"""Areas whose depth differs from place to place: contour formulas of parts with depths of their own. Lengths in mm.

A formula joins areas by `&` (common), `|` (united), `^` (united without what is common) and `\\` (without). A part that
is cut counts down to its depth; a part that is taken away, right of `\\`, is an island whose top lies at its depth below the
surface. So the area that is cut is another one at every depth:

    ─┐           ┌─┐          ┌──   surface
     │           │ │island    │     terrace 1: its area counts from the surface down to its bottom
     └──┐      ┌─┴─┴──────────┘     bottom of terrace 1 = top of terrace 2
        └──────┘                    bottom of the last terrace = the milling depth
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple, TypeAlias

from mnclab.geometry.regions import Region
from mnclab.machining.depths import DRIFT, infeeds

SLIVER = 1e-6  # mm², an area that counts as none


class Part(NamedTuple):
    """An area of a formula and its own depth; 0 is as deep as the whole, or for an island up to the surface."""

    region: Region
    depth: float = 0.0


class Joined(NamedTuple):
    """Two sides of a formula and what joins them: one of `& | ^ \\`."""

    operator: str
    left: Formula
    right: Formula


Formula: TypeAlias = Part | Joined
#: Areas that were found before: a formula (kept, since its `id` is the key), and what it is at a depth.
Known: TypeAlias = dict[tuple[int, float, float, bool], tuple[Formula, Region]]


class Terrace(NamedTuple):
    """The area that is cut between two depths, counted from the surface and positive; a `solid` one stays, cut free around."""

    top: float
    bottom: float
    region: Region
    solid: bool = False


class Level(NamedTuple):
    """One level of a clearing: its coordinate along the tool axis and which terrace it clears."""

    height: float
    terrace: int


def at_depth(
    formula: Formula, depth: float, whole: float, taken_away: bool = False, known: Known | None = None
) -> Region:
    """The area that is cut at a depth, where the formula as a whole is `whole` deep.

    `known` keeps the areas of its parts, for formulas that are made of each other.
    """
    if isinstance(formula, Part):
        reach = formula.depth or (0.0 if taken_away else whole)
        return formula.region if (depth > reach) == taken_away else Region()
    known = {} if known is None else known
    key = id(formula), depth, whole, taken_away
    if key not in known:
        left = at_depth(formula.left, depth, whole, taken_away, known)
        right = at_depth(formula.right, depth, whole, taken_away != (formula.operator == "\\"), known)
        known[key] = formula, combined(formula.operator, left, right)
    return known[key][1]


def combined(operator: str, left: Region, right: Region) -> Region:
    """Two areas as an operator of a formula joins them."""
    match operator:
        case "&":
            return left.intersection(right)
        case "|":
            return left.union(right)
        case "^":
            return left.union(right).difference(left.intersection(right))
        case _:
            return left.difference(right)


def terraces(formula: Formula, whole: float) -> tuple[Terrace, ...]:
    """The terraces of a formula from the surface down, those of one area joined; `whole` > 0 is the milling depth.

    A ValueError where nothing is cut at the surface, or where the area grows with the depth, which no cutter reaches.
    """
    depths = sorted({min(part.depth, whole) for part in parts(formula)} - {0.0} | {whole})
    found: list[Terrace] = []
    top = 0.0
    for bottom in depths:
        region = at_depth(formula, (top + bottom) / 2, whole)
        if not region.loops:
            break
        if found and region.difference(found[-1].region).area > SLIVER:
            raise ValueError(f"it is wider below {top:.10g} mm than above, where no cutter gets")
        if found and found[-1].region.difference(region).area <= SLIVER:
            found[-1] = found[-1]._replace(bottom=bottom)
        else:
            found.append(Terrace(top, bottom, region))
        top = bottom
    if not found:
        raise ValueError("it encloses nothing")
    return tuple(found)


def parts(formula: Formula) -> Iterator[Part]:
    """The parts of a formula, from left to right."""
    if isinstance(formula, Part):
        yield formula
    else:
        yield from parts(formula.left)
        yield from parts(formula.right)


def levels(
    found: Sequence[Terrace], surface: float, down: int, infeed: float, allowance: float = 0.0
) -> tuple[Level, ...]:
    """The levels that clear terraces, `infeed` apart from the surface on, and one on each floor above its `allowance`.

    `down` is -1 where the depth is negative. No floor lies above the surface: an allowance as deep as a terrace is cut off.
    """
    made: list[Level] = []
    reached = 0.0
    for number, terrace in enumerate(found):
        floor = max(terrace.bottom - allowance, 0.0)
        for depth in infeeds(0.0, floor, infeed) if floor > 0 or len(found) == 1 else ():
            if depth > reached + DRIFT or len(found) == 1:
                made.append(Level(surface + down * depth, number))
        reached = max(reached, floor)
    return tuple(made)
