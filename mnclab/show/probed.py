"""What a probe meets in a run, for pictures, scenes and the player: the part, and what was touched.

The part of a setup is in machine coordinates, pictures count in those of the path: `origin` lies between them.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from mnclab.geometry.frames import shift
from mnclab.geometry.regions import Region
from mnclab.path.listing import MM, Unit
from mnclab.path.toolpath import Array, Kind
from mnclab.workpiece.part import Part
from mnclab.workpiece.part.part import Distance, Floats

FAR = 4.0  # times as large as the path a part may be to be shown whole
AROUND = 0.15  # of the greatest side: how far beyond the path a part without an end is shown
UNDER = 0.1  # mm below its highest place is a part cut that nothing has touched
BEHIND, ALONG = 1.0, 0.7  # mm behind a wall, of walls that were touched from one side only; the cosine of such a touch
MOVES = 2000  # beyond which what the program has cut is not worked out for a picture
TINY = 1e-9
HALVINGS = 12
PART, SETTER, BEAM = "part", "tool setter", "beam of the tool setter"  # what legends call it
REACH = 40.0  # mm to both sides of its point that a beam is shown


class Felt(NamedTuple):
    """The part (None: not known), where the zero point of the path stands in its coordinates (3,), and of each touch the
    place (n, 3) in coordinates of the path and the way (n, 3) that the ball came, the row of the path (n,), and what is written
    there: with its value, and the number alone. Number 1 is `run.touches[0]`. `name` is what the part is; `beam` are the ends
    (2, 3) of the laser beam that tools break, in coordinates of the path."""

    part: Part | None
    origin: Array
    places: Array
    ways: Array
    rows: list[int]
    texts: list[tuple[str, str]]
    name: str = PART
    beam: Array | None = None

    @property
    def found(self) -> Array:
        """The touches and the ends of the beam (n, 3)."""
        return self.places if self.beam is None else np.vstack([self.places, self.beam])

    def box(self, low: Array, high: Array) -> tuple[Array, Array]:
        """A box (3,), (3,) around the path, widened by the touches, and by the part unless it is much larger."""
        for corner in self.found:
            low, high = np.fmin(low, corner), np.fmax(high, corner)
        if self.part is None or not np.isfinite(self.part.bounds).all():
            return low, high
        ends = self.part.bounds - self.origin
        if (ends[1] - ends[0]).max() > FAR * max(float((high - low).max()), TINY):
            return low, high
        return np.fmin(low, ends[0]), np.fmax(high, ends[1])

    def ends(self, path: Array) -> Array:
        """The corners (2, 3) of the part; where it has no end, of what lies around the path's box (2, 3) and the touches."""
        around = np.vstack([path, self.found])
        low, high = around.min(axis=0), around.max(axis=0)
        more = AROUND * float((high - low).max()) + 1.0
        own = np.array([low, high]) if self.part is None else self.part.bounds - self.origin
        return np.stack([np.where(np.isfinite(own[0]), own[0], low - more), np.where(np.isfinite(own[1]), own[1], high + more)])

    def level(self, axis: int) -> float:
        """Where a section square to an axis shows what was touched."""
        if len(self.places):
            found, along = self.places[:, axis], self.ways[:, axis]
            if axis == 2:
                return float(np.median(found)) - UNDER
            walls = np.abs(along) > ALONG
            side = float(np.sign(along[walls]).mean()) if walls.any() else 0.0
            return side * (float((side * found[walls]).max()) + BEHIND) if abs(side) == 1 else float(np.median(found))
        low, high = (0.0, 0.0) if self.part is None else (self.part.bounds - self.origin)[:, axis].tolist()
        if axis == 2:
            return high - UNDER if math.isfinite(high) else 0.0
        return (low + high) / 2 if math.isfinite(high - low) else 0.0

    def heights(self, x: Array, y: Array, low: float, high: float, step: float) -> Array:
        """The top of the part at places of the plane (n,), mm; nan where there is none above `low`.

        Places `step` mm apart are looked at, so that less than a quarter of it stays unseen.
        """
        found = np.full(len(x), np.nan)
        if self.part is None:
            return found
        places = np.column_stack([x, y, np.full(len(x), high)]) + self.origin
        going = np.arange(len(x))
        before = places[:, 2] + step
        while len(going):
            gap = self.part(places[going]) / self.part.steep
            met, left = going[gap <= 0], going[gap > 0]
            found[met] = 0.0
            before[left] = places[left, 2]
            places[left, 2] -= np.maximum(gap[gap > 0], step / 4)
            going = left[places[left, 2] >= low + self.origin[2]]
        met = np.flatnonzero(np.isfinite(found))
        for _ in range(HALVINGS):  # between the last free place and the first that is not
            middle = np.column_stack([places[met, :2], (before[met] + places[met, 2]) / 2])
            inside = self.part(middle) <= 0
            places[met[inside], 2] = middle[inside, 2]
            before[met[~inside]] = middle[~inside, 2]
        found[met] = np.minimum(places[met, 2] - self.origin[2], high)
        return found


def felt(run: Any) -> Felt | None:
    """What the probe of a run meets, or the tool setter where tools are measured; None where nothing is to be touched."""
    setup, measured = run.setup, (run.toolpath.kind == Kind.PROBE).any()
    part = setup.part if isinstance(setup.part, Part) else None  # what is cut is shown as the blank is
    setter = setup.setter if setup.part is None and measured else None
    if setup.part is None and setter is None:
        return None
    origin = np.array(run.toolpath.origin, dtype=float)
    places = np.array([touch.surface for touch in run.touches], dtype=float).reshape(-1, 3) - origin
    ways = np.array([touch.direction for touch in run.touches], dtype=float).reshape(-1, 3)
    told = (SETTER, _beam(setter, origin)) if setter else (PART, None)
    return Felt(setter.part if setter else part, origin, places, ways, _rows(run, origin), _texts(run), *told)


def _beam(setter: Any, origin: Array) -> Array | None:
    """The ends (2, 3) of the beam of a tool setter where it truly is; None of a plate."""
    if not setter.axis:
        return None
    way = np.array([setter.axis == "X", setter.axis == "Y", setter.slope])
    return np.array([np.array(setter.place) + REACH * side * way for side in (-1, 1)]) - origin


def part_of(run: Any) -> Part | None:
    """What a probe meets in a run, machine coordinates; of what the program cuts as it is at the end."""
    part = run.setup.part
    if part is None or isinstance(part, Part):
        return part
    if run.stock is None or run.toolpath.lathe or int(run.toolpath.is_motion.sum()) > MOVES:
        return None
    left, origin = run.workpiece(), run.toolpath.origin
    whole: Part = left.part.shifted(*origin)
    return replace(whole, distance=Sections(whole.distance, left, tuple(origin.tolist())))


@dataclass(frozen=True)
class Sections:
    """The distance from what a program has cut, which knows its level sections: asking all places of a picture takes minutes."""

    distance: Distance
    left: Any
    origin: tuple[float, ...]

    def __call__(self, points: Floats) -> Floats:
        return self.distance(points)

    def section(self, z: float) -> Region:
        """What a level plane cuts, machine coordinates."""
        x, y, up = self.origin
        return Region(tuple(loop.transformed(shift(x, y)) for loop in self.left.cut("XY", z - up)))


def _rows(run: Any, origin: Array) -> list[int]:
    """The row of the path that made each touch: of its step the first free one that ends beside it."""
    path, found = run.toolpath, list[int]()
    probing = np.flatnonzero(path.kind == Kind.PROBE)
    for touch in run.touches:
        rows = probing[(path.step[probing] == touch.step) & (probing > (found[-1] if found else -1))]
        off = np.linalg.norm(path.end[rows] - (np.array(touch.centre) - origin), axis=1)
        near = np.flatnonzero(off < off.min(initial=math.inf) + TINY)
        found.append(int(rows[near[0]]) if len(near) else len(path) - 1)
    return found


def touched_decimals(unit: Unit) -> int:
    """How many decimals a touched coordinate has in a picture."""
    return 3 if unit is MM else 4


def _texts(run: Any) -> list[tuple[str, str]]:
    found, unit = [], run.toolpath.unit
    for k, touch in enumerate(run.touches, 1):
        way = np.abs(np.array(touch.found) - touch.programmed)
        axis = int(way.argmax())
        counts = touch.found[axis] / unit.length
        value = f"{touch.names[axis]} {counts:z.{touched_decimals(unit)}f}".replace("-", "\N{MINUS SIGN}")
        found.append((f"{k}   {value}" if way[axis] > 0.999 * np.linalg.norm(way) else str(k), str(k)))
    return found
