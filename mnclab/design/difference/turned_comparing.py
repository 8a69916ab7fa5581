"""A turned part against a half section: exact, along lines and arcs.

What stands in the chuck behind the end of the design is not judged; of a part that was cut off the piece that fell is compared.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mnclab.design.difference.difference import Difference, Features, Place, Worst, made_by
from mnclab.design.difference.half_target import HalfSurface, HalfTarget, Places, deepest, narrowed
from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import Region
from mnclab.path.toolpath import Array, Index, Mask
from mnclab.workpiece.turning import revolved
from mnclab.workpiece.turning.turned import Turned

SPACINGS = 1500  # places along the longest side
EDGE = 1e-4  # mm, from a corner: places lie a hair beside it
OWN = 0.5  # of the way along its normal: a face that was found nearer to the target than that is another one
LEAST = 1e-7  # mm, less is nothing
ALIKE = 1e-7  # mm, by which places that are as bad may differ
MOST = 40  # of them whose rows are looked for


class Compared:
    """The piece of a turned part that is compared: its section, and the row that made a place of it.

    `hangs`: it goes on in the chuck behind the end of the target; there it is cut off.
    """

    def __init__(self, part: Turned, target: HalfTarget) -> None:
        self.part, self.target = part, target
        low, high = target.ends
        pieces = [part.section, *_apart(part.parted)]
        shared = [sum(_common(piece, target.surface.region)) for piece in pieces]
        self.number = int(np.argmax(shared))
        self.section: Sequence[Contour] = pieces[self.number]
        region = Region(tuple(self.section))
        self.hangs = False
        if self.number == 0 and region.loops and region.bounds[0, 0] < low - LEAST:
            (z0, _), (_, r1) = region.bounds.tolist()
            behind = Contour([(z0 - 1, -1.0), (low, -1.0), (low, r1 + 1), (z0 - 1, r1 + 1)])
            region, self.hangs = region.difference(Region((behind,))), True
        self.surface = HalfSurface(region.loops)

    @cached_property
    def _rows(self) -> list[NDArray[np.int64]]:
        drawing = self.part._drawing
        return [drawing.rows_of(loop) for loop in self.section]

    def row_at(self, place: Array) -> int:
        """The row of the path that made the surface at a place (2,), -1 where the blank is untouched."""
        best, row = np.inf, -1
        for loop, rows in zip(self.section, self._rows):
            nearest = float(loop.distance(place)[0])
            if nearest < best:
                way = np.cumsum(loop.lengths)
                k = min(int(np.searchsorted(way, loop.nearest(place))), len(rows) - 1)
                best, row = nearest, int(rows[k])
        return row if best < 1e-3 else -1

    def in_space(self, place: Array) -> Place:
        """A place (z, r) of the section as (x, y, z)."""
        z, r = place.tolist()
        return self.part.axis + r, 0.0, z

    def behind(self, points: Array) -> Mask:
        """Which points (m, 2) lie where the bar was cut off in thought."""
        return np.asarray(points[:, 0] <= self.target.ends[0] + LEAST) & self.hangs


@dataclass(frozen=True, eq=False)
class Looked:
    """`places` (m, …) on the surface of the target, how far the part is off along the normal there (m,), nan where it has no
    surface or nothing is judged, and `off` (m,): the distance of what was found from the target. `gone` and `left` are the
    areas of the half section that were cut away too much, or left over, empty where nothing is off."""

    places: Places
    moved: Array
    off: Array
    gone: Region
    left: Region


def compare_turned(part: Turned, target: HalfTarget, tolerance: float) -> Difference:
    """A turned part against a target."""
    found = Compared(part, target)
    error = max(part.error if found.surface.lines else 0.0, target.error, LEAST)
    spacing = max(float(np.ptp(target.surface.region.bounds, axis=0).max()) / SPACINGS, 1e-3)
    at, off = _all_off(found, target, spacing, error)
    owner = target.owners(at)
    gone, left = (Region(()), Region(()))
    if (off < 0).any() or not found.surface.lines:
        gone = target.core.region.difference(found.surface.region) if found.surface.lines else target.core.region
    if (off > 0).any():
        left = found.surface.region.difference(target.surface.region)
    at, off, owner = _with_depths(target, gone, left, at, off, owner)
    looked = _looked(found, target, spacing, error, gone, left)
    from mnclab.design.difference.turned_measuring import rows_of

    rows = Features(list(rows_of(found, target, looked, (at, off, owner), tolerance, error)))
    return Difference(
        target.name, tolerance, error, _worst(found, target, at, off, owner, -1.0), _worst(found, target, at, off, owner, 1.0),
        revolved.volume(gone.loops), revolved.volume(left.loops), looked.places.way, np.zeros(1), looked.off[None], rows,
        tuple(_notes(found, target)), part, target, looked,
    )  # fmt: skip


def _all_off(found: Compared, target: HalfTarget, spacing: float, error: float) -> tuple[Array, Array]:
    """Places (k, 2) of the part's surface that are off, and how far (k,), the true extremes among them."""
    surface = found.surface
    if not surface.lines:
        return np.zeros((0, 2)), np.zeros(0)
    at = surface.places(spacing)

    def left(points: Array) -> Array:
        return np.where(found.behind(points) | target.toothed(points), 0.0, np.maximum(target.surface.distance(points), 0.0))

    def gone(points: Array) -> Array:
        return np.where(found.behind(points), 0.0, np.maximum(-target.core.distance(points), 0.0))

    places, values = [at.place], [left(at.place) - gone(at.place)]
    for distance, sign in ((left, 1.0), (gone, -1.0)):
        value = np.maximum(sign * values[0], 0.0)
        if value.max() > error:
            group = np.zeros(len(value), dtype=np.int64)
            group[value > error] = target.owners(at.place[value > error])
            place, far = narrowed(surface, at, value, group, distance)
            places.append(place)
            values.append(sign * far)
    place, value = np.concatenate(places), np.concatenate(values)
    some = np.abs(value) > error
    return place[some], value[some]


def _with_depths(
    target: HalfTarget, gone: Region, left: Region, at: Array, off: Array, owner: Index
) -> tuple[Array, Array, Index]:
    """With the deepest places of what is gone or left over, where they lie within it."""
    for region, surface, sign in ((gone, target.core, -1.0), (left, target.surface, 1.0)):
        most = float((sign * off).max(initial=0.0))
        inner = deepest(region, lambda points, s=surface, k=sign: k * s.distance(points), most)  # type: ignore[misc]
        if inner is not None:
            at, off = np.vstack([at, inner[0]]), np.append(off, sign * inner[1])
            owner = np.append(owner, target.owners(inner[0][None]))
    return at, off, owner


def _looked(found: Compared, target: HalfTarget, spacing: float, error: float, gone: Region, left: Region) -> Looked:
    """The part along the normals of the target."""
    at = target.surface.places(spacing * 3, EDGE)
    moved = found.surface.ways_out(at.place, at.normal)
    judged = ~target.toothed(at.place) & ~found.behind(at.place)
    moved = np.where(judged, moved, np.nan)
    there = at.place + np.nan_to_num(moved)[:, None] * at.normal
    away = np.abs(target.surface.distance(there))
    off = np.sign(moved) * np.minimum(np.abs(moved), away)
    moved = np.where(away < OWN * np.abs(moved) - error, np.nan, moved)  # another face stands there
    off = np.where(np.abs(off) <= error, np.where(np.isnan(off), np.nan, 0.0), off)
    return Looked(at, moved, off, gone, left)


def _worst(found: Compared, target: HalfTarget, at: Array, off: Array, owner: Index, sign: float) -> Worst:
    off = sign * off
    if not off.max(initial=0.0) > 0:
        return Worst()
    k, row = first_made(found, at, np.flatnonzero(off >= off.max() - ALIKE))
    made = made_by(found.part.cutting, found.in_space(at[k]), row, sign)
    return Worst(float(off.max()), feature=target.names[owner[k]], **made)


def first_made(found: Compared, at: Array, among: Index) -> tuple[int, int]:
    """Of places (k, 2) that are as bad the one that was made first, and the row that made it.

    It is -1, where nothing was cut, if that holds for most of them; a row that made but one of many, a corner, does not count.
    """
    apart = np.unique(at[among].round(6), axis=0, return_index=True)[1]  # two stretches meet in one corner
    some = among[np.sort(apart)][:: len(apart) // MOST + 1]
    rows = np.array([found.row_at(at[k]) for k in some])
    known, count = np.unique(rows, return_counts=True)
    if known[count.argmax()] < 0:
        row = -1
    else:
        cut = known[(known >= 0) & (count > min(1, len(some) // 3))]
        row = int(cut.min()) if len(cut) else int(known[known >= 0].min())
    return int(some[(rows == row).argmax()]), row


def _notes(found: Compared, target: HalfTarget) -> Iterator[str]:
    yield from found.part.notes
    low = target.ends[0]
    if found.number:
        yield "what was cut off is compared, not what is left in the chuck"
    if found.hangs:
        yield f"what stands in the chuck beyond the end of {target.name}, Z {low:g}, is not judged"
    if target.design and target.design.threads:
        yield "of a thread the diameter over its crests is measured, and that its teeth lie between core and nominal diameter"


def _apart(loops: Sequence[Contour]) -> list[list[Contour]]:
    """Loops as pieces, each with its holes."""
    found: list[list[Contour]] = []
    for loop in loops:
        if loop.area > 0 or not found:
            found.append([])
        found[-1].append(loop)
    return found


def _common(piece: Sequence[Contour], region: Region) -> Iterator[float]:
    """The area that a piece has in common with another one."""
    if piece:
        yield Region(tuple(piece)).intersection(region).area
