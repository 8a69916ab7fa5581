"""A part that was cut before as the next blank: as it stood, turned over, turned in the plane, or clamped elsewhere.

    lower and upper side in the first clamping      turned over about X
    z = top(x, y)     ___    ___                    z = -floor(x, -y)   __________
                     |   |__|   |                                      |    __    |
    z = floor(x, y)  |__________|                   z = -top(x, -y)    |___|  |___|

Nothing is sampled: the sides at a point are those of the part at the place where that point was before.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from mnclab.geometry.contours import Contour
from mnclab.path.listing import figure
from mnclab.path.toolpath import Array, Index
from mnclab.text.given import check_number, choice
from mnclab.workpiece.blank import Blank
from mnclab.workpiece.cutting import UPRIGHT

if TYPE_CHECKING:
    from mnclab.workpiece.milling.gaps import Gaps
    from mnclab.workpiece.milling.moves import Moves
    from mnclab.workpiece.workpiece import Solid, Workpiece

EDGE = 1e-9  # mm beside the box about a part that still count as its edge: what turning and shifting rounds
STEPS, HALVINGS = 96, 40  # of a line through a blank that lies on its side, and of each of its ends
PLACES = 200  # along the longer side of a view from the side that is not along an axis of the part
QUARTERS = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))  # cosine and sine of whole quarters of a turn


def _about_z(degrees: float) -> Array:
    quarters = degrees / 90
    angle = np.radians(degrees)
    whole = quarters == round(quarters)
    cos, sin = QUARTERS[int(quarters) % 4] if whole else (float(np.cos(angle)), float(np.sin(angle)))
    return np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])


OVER = {"x": np.diag([1.0, -1.0, -1.0]), "y": np.diag([-1.0, 1.0, -1.0])}


@dataclass(frozen=True, eq=False)
class Placement:
    """Where a part stands: turned by a matrix (3, 3), then shifted by (3,) mm."""

    turn: Array = field(default_factory=lambda: np.eye(3))
    shift: Array = field(default_factory=lambda: np.zeros(3))

    @property
    def over(self) -> bool:
        return bool(self.turn[2, 2] < 0)

    @property
    def leans(self) -> bool:
        """Whether it is turned otherwise than about Z or upside down."""
        return bool(abs(self.turn[2, 2]) < UPRIGHT)

    @property
    def degrees(self) -> float:
        """By how much it was turned about Z; of what was turned over, after it was so about X."""
        return float(np.degrees(np.arctan2(self.turn[1, 0], self.turn[0, 0])))

    def there(self, points: Array) -> Array:
        """Points (…, 3) of the part where it stands."""
        return np.asarray(points @ self.turn.T + self.shift)

    def back(self, points: Array) -> Array:
        """Points (…, 3) in the coordinates of the part."""
        return np.asarray((points - self.shift) @ self.turn)

    def after(self, first: Placement) -> Placement:
        """This one of what was placed before."""
        return Placement(self.turn @ first.turn, self.there(first.shift))


def turning(turn: Array, middle: Array) -> Placement:
    """A turn about a point (3,)."""
    return Placement(turn, middle - turn @ middle)


@dataclass(frozen=True, eq=False)
class Clamped:
    """What is left of a blank, as a blank: `body` where `placement` puts it. It does not change; a copy is itself.

    Its box, `bounds`, is that of the first blank: turned over, it takes up the same room.
    """

    body: Workpiece
    placement: Placement = field(default_factory=Placement)
    _seen: dict[Any, Any] = field(default_factory=dict)  # what does not depend on the shift: views, edges

    def __deepcopy__(self, memo: Any) -> Clamped:
        return self

    def __repr__(self) -> str:
        low, high = (" ".join(f"{axis}{figure(float(v))}" for axis, v in zip("XYZ", corner)) for corner in self.bounds)
        turned = f", turned {figure(self.placement.degrees)} degrees" if abs(self.placement.degrees) > 1e-9 else ""
        over = ", turned over" if self.placement.over else ""
        if over and abs(abs(self.placement.degrees) - 180) < 1e-9:  # upside down about X and half round: about Y
            turned = ""
        return f"a part cut before ({low} to {high}, {self.volume:.3f} mm³{over}{turned})"

    @cached_property
    def bounds(self) -> Array:
        """The corners with the least and the greatest coordinates (2, 3)."""
        corners = self.placement.there(np.array(np.meshgrid(*self.body.bounds.T)).reshape(3, -1).T)
        return np.stack([corners.min(axis=0), corners.max(axis=0)])

    @property
    def volume(self) -> float:
        """mm³."""
        return self.body.volume

    @property
    def notes(self) -> tuple[str, ...]:
        """What is not shown of it, as the part itself says."""
        return self.body.notes

    @property
    def error(self) -> float:
        """How far a surface may be off, mm."""
        return self.body.error

    def faces(self, x: Array, y: Array) -> tuple[Array, Array]:
        """How low and how high it reaches at points (m,); nan beside it."""
        if self.placement.leans:
            return self._faces_aslant(x, y)
        places = self.placement.back(np.stack([x, y, np.zeros_like(x)], axis=-1))
        low, high = self.body.bounds
        inside = np.clip(places, low, high)
        px, py = np.where(np.abs(places - inside) <= EDGE, inside, places)[..., :2].T
        floor, top = self.body.faces(px, py)
        z = self.placement.shift[2]
        return (z - top, z - floor) if self.placement.over else (floor + z, top + z)

    @cached_property
    def gaps(self) -> Gaps | None:
        """What tools of other directions took away between its faces; None where it has no gaps."""
        from mnclab.workpiece.milling.gaps import Gaps

        found = tuple(self.made_by())
        return Gaps(found, self.bounds) if any(self.placement.leans or each.leans for _, each in found) else None

    def _faces_aslant(self, x: Array, y: Array) -> tuple[Array, Array]:
        """The faces of the first blank on its side, less what was taken away, which `made_by` tells."""
        first, place = self.first()
        floor, top = crossed(first, place, x, y, self.bounds[:, 2])
        if self.gaps:
            top, floor = self.gaps.sides(x, y, top, floor)
        solid = top > floor + EDGE
        return np.where(solid, floor, np.nan), np.where(solid, top, np.nan)

    def first(self) -> tuple[Any, Placement]:
        """The blank of which the first clamping was cut, and where it stands now: of a turned part that itself."""
        own = self.body.cutting.stock
        if self.body.half_section() is not None:
            return Clamped(self.body), self.placement
        if not isinstance(own, Clamped):
            return own, self.placement
        found, place = own.first()
        return found, self.placement.after(place)

    # --- elsewhere ---------------------------------------------------------------------------------------------------

    def moved(self, by: ArrayLike) -> Clamped:
        """Shifted by (3,) mm."""
        return replace(self, placement=replace(self.placement, shift=self.placement.shift + np.asarray(by, dtype=np.float64)))

    def turned_over(self, axis: str = "x") -> Clamped:
        """Turned by half a turn about an axis, "x" or "y", through the middle of its box."""
        return self._turned(OVER[choice(axis, "the axis that a part is turned over about", OVER)])

    def turned(self, degrees: float) -> Clamped:
        """Turned counter-clockwise, seen from above, about the middle of its box."""
        check_number(degrees, "the angle by which a part is turned about Z (degrees)")
        return self._turned(_about_z(degrees))

    def _turned(self, turn: Array) -> Clamped:
        return Clamped(self.body, turning(turn, self.bounds.mean(axis=0)).after(self.placement))

    # --- what it is made of ------------------------------------------------------------------------------------------

    def made_by(self) -> Iterator[tuple[Moves, Placement]]:
        """The moves of a mill that cut it, the last clamping first, and where each of these clampings stands now."""
        for moves, placement in self.body.made_by():
            yield moves, self.placement.after(placement)

    def half_section(self) -> tuple[list[Contour], float] | None:
        """Of a turned part: closed contours (z, r), mm, and where its axis stands in x."""
        if (own := self.body.half_section()) is None:
            return None
        section, axis = own
        x, _, z = self.placement.there(np.array([axis, 0.0, 0.0])).tolist()
        over = self.placement.over
        placed = [Contour(loop.points * (-1 if over else 1, 1) + (z, 0), loop.bulge * (-1 if over else 1)) for loop in section]
        return [loop.reversed() for loop in placed] if over else placed, x

    def solid(self) -> Solid:
        """Its closed surface; no row cut it."""
        found = self.body.solid()
        return found._replace(points=self.placement.there(found.points), row=np.full(len(found.row), -1))

    # --- pictures ----------------------------------------------------------------------------------------------------

    def edges(self) -> list[Array]:
        """Lines (k, 3) that show it in space."""
        if "edges" not in self._seen:
            self._seen["edges"] = self.body.edges()
        return [self.placement.there(line) for line in self._seen["edges"]]

    def outline(self, right: int, up: int) -> list[Array]:
        """What a view along an axis shows: closed lines (k, 2) in the coordinates `right` and `up` (0 to 2)."""
        key = right, up
        if key not in self._seen:
            self._seen[key] = self._outline(right, up)
        return [line + self.placement.shift[[right, up]] for line in self._seen[key]]

    def _outline(self, right: int, up: int) -> list[Array]:
        """The same as if it were not shifted."""
        turn = self.placement.turn[[right, up]]
        if (np.abs(turn) == 1).any(axis=1).all():  # along an axis of the part
            own = np.abs(turn).argmax(axis=1)
            return [line * turn[[0, 1], own] for line in self.body.outline(int(own[0]), int(own[1]))]
        if {right, up} == {0, 1}:
            return [line @ turn[:, [right, up]].T for line in self.body.outline(right, up)]
        here = self.moved(-self.placement.shift)
        low, high = here.bounds
        step = float((high - low)[:2].max()) / PLACES
        x, y = (np.arange(a + step / 2, b, step) for a, b in zip(low[:2].tolist(), high[:2].tolist()))
        floor, top = (side.reshape(len(y), len(x)) for side in here.faces(*(p.ravel() for p in np.meshgrid(x, y))))
        return from_side(x, y, floor, top, right, up)


def crossed(body: Blank, place: Placement, x: Array, y: Array, ends: Array) -> tuple[Array, Array]:
    """From where to where upright lines at points (m,) cross a blank that stands there, between two heights; equal beside it.

    The ends are found by halving. What is cut off less than one of `STEPS` is not seen, nor what is hollow between both.
    """
    low, high = np.full((2, len(x)), ends[0])
    z = ends[0] + (ends[1] - ends[0]) * np.arange(STEPS + 1) / STEPS

    def inside(some: Index, height: Any) -> Array:
        points = place.back(np.stack(np.broadcast_arrays(x[some], y[some], height), axis=-1))
        floor, top = body.faces(points[:, 0], points[:, 1])
        return np.asarray((floor <= points[:, 2]) & (points[:, 2] <= top))

    every = np.arange(len(x))
    seen = np.stack([inside(every, height) for height in z])
    met = np.flatnonzero(seen.any(axis=0))
    for found, first in ((low, seen.argmax(axis=0)[met]), (high, STEPS - seen[::-1].argmax(axis=0)[met])):
        out = np.clip(first + (-1 if found is low else 1), 0, STEPS)
        within, beyond = z[first], z[out]
        for _ in range(HALVINGS):
            half = (within + beyond) / 2
            there = inside(met, half)
            within, beyond = np.where(there, half, within), np.where(there, beyond, half)
        found[met] = within
    return low, high


def from_side(x: Array, y: Array, floor: Array, top: Array, right: int, up: int) -> list[Array]:
    """The silhouette from the side, closed lines (k, 2), of sides (ny, nx) at the middles of cells; nan where nothing is.

    It is right within a cell.
    """
    along = right if right != 2 else up
    places, across = ((x, y)[along], (0, 1)[along])
    step = float(places[1] - places[0]) if len(places) > 1 else float((x, y)[1 - along][1] - (x, y)[1 - along][0])
    stands = np.isfinite(top)
    high, low = (np.where(stands, top, -np.inf).max(axis=across), np.where(stands, floor, np.inf).min(axis=across))
    some = stands.any(axis=across)
    edges = np.flatnonzero(np.diff(np.concatenate([[False], some, [False]]).astype(np.int8))).reshape(-1, 2)
    found = []
    for first, last in edges.tolist():
        at = np.repeat(places[first:last], 2) + np.tile([-step / 2, step / 2], last - first)
        upper, lower = np.repeat(high[first:last], 2), np.repeat(low[first:last], 2)
        ring = np.concatenate([np.stack([at, lower], axis=1), np.stack([at, upper], axis=1)[::-1]])
        ring = _without_steps(np.concatenate([ring, ring[:1]]))
        found.append(ring if right != 2 else ring[:, ::-1])
    return found


def _without_steps(line: Array) -> Array:
    """A line (k, 2) without the points that lie on a straight piece along an axis."""
    before, behind = np.diff(line, axis=0)[:-1], np.diff(line, axis=0)[1:]
    straight = (np.abs(before[:, 0] * behind[:, 1] - before[:, 1] * behind[:, 0]) < 1e-12)
    return line[np.concatenate([[True], ~straight, [True]])]


