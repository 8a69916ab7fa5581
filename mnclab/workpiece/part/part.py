"""The part itself: its distance, how parts combine, and where they are put.

Outside the material a distance is never too large, so that a ball is not led through material. It is exact for every
single shape, for all unions of such, and for whatever upright prisms of one common axis make together (boxes, cylinders,
holes, slots, pockets, bosses). Of other differences and intersections the faces are exact; off an edge that they make the
distance is too small, as if the edge were mitred, not rounded: such a part is not `exact`.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.geometry import frames
from mnclab.geometry.contours import SEEN
from mnclab.text.alarm import Alarm
from mnclab.text.given import check_number, check_point, refusing_class, shown
from mnclab.text.tables import svg_of
from mnclab.workpiece.part.prisms import Operation, Prisms

if TYPE_CHECKING:
    from mnclab.geometry.contours import Contour

Floats = NDArray[np.float64]
Distance = Callable[[Floats], Floats]

SHARES = (0.75, 0.25)  # of its height, where a cell shows what it is
AT_ONCE = 200  # places looked at in one go
ENDLESS = np.array([[-np.inf] * 3, [np.inf] * 3])
WHICH: dict[Operation, tuple[np.ufunc, float]] = {"|": (np.minimum, 1.0), "&": (np.maximum, 1.0), "-": (np.maximum, -1.0)}


@refusing_class
@dataclass(frozen=True)
class Part:
    """Material, given by its signed distance; `name` says what it is, `at_once` at how many places a ball is tried in
    one go. `bounds` (2, 3) are the corners of a box around it, mm, infinite where it has no end. `exact` tells whether the
    distance is so off all edges, `steep` by how much more than the way it may change along a way. `bound` tells sooner, where
    the distance takes long, one that is never larger.

    >>> corner = mnc.part.box((0, 0, 0), (5, 5, 5)) | mnc.part.ball((10, 0, 0), 2)
    >>> corner.distance(np.array([[10.0, 0, 7]]))
    array([5.])
    """

    distance: Distance
    name: str = "part"
    at_once: int = AT_ONCE
    bounds: Floats = field(default_factory=ENDLESS.copy, compare=False, repr=False)
    exact: bool = True
    steep: float = 1.0
    bound: Distance | None = field(default=None, compare=False, repr=False)

    def __repr__(self) -> str:
        return f"<Part: {self.name}>"

    def _repr_svg_(self) -> str | None:
        """What level planes cut of it, high up and low down."""
        (low, high), loops = self.bounds[:, 2], list[list[Floats]]()
        if np.isfinite(self.bounds).all():
            loops = [[loop.points_within(SEEN) for loop in self.section(low + share * (high - low))] for share in SHARES]
        return svg_of(*loops)

    def __call__(self, points: ArrayLike) -> Floats:
        """Signed distance of each of the points `(n, 3)` from the surface, `(n,)`."""
        try:
            places = np.asarray(points, dtype=float).reshape(-1, 3)
        except (TypeError, ValueError):
            raise Alarm(f"the distance of a part is that of points (x, y, z), got {shown(points)}") from None
        return self.distance(places)

    def __or__(self, other: Part) -> Part:
        return self._with("|", other)

    def __and__(self, other: Part) -> Part:
        return self._with("&", other)

    def __sub__(self, other: Part) -> Part:
        return self._with("-", other)

    def _with(self, operation: Operation, other: Part) -> Part:
        if not isinstance(other, Part):
            raise Alarm(f"a part is combined with another part, got {shown(other)}")
        name = f"({self.name} {operation} {other.name})"
        bounds = self.bounds
        if operation != "-":
            outer, inner = (np.minimum, np.maximum) if operation == "|" else (np.maximum, np.minimum)
            bounds = np.array([outer(self.bounds[0], other.bounds[0]), inner(self.bounds[1], other.bounds[1])])
        if isinstance(self.distance, Prisms) and isinstance(other.distance, Prisms):
            both = self.distance.combined(operation, other.distance)
            if both is not None:
                return Part(both, name, bounds=bounds)
        exact = operation == "|" and self.exact and other.exact
        before = self.distance.args if isinstance(self.distance, partial) and self.distance.func is _combined else (("|", self),)
        distance = partial(_combined, *before, (operation, other))
        return Part(distance, name, min(self.at_once, other.at_once), bounds, exact, max(self.steep, other.steep))

    def placed(self, frame: ArrayLike) -> Part:
        """The same part put elsewhere by a 4×4 frame that turns and shifts."""
        try:
            matrix = np.asarray(frame, dtype=float)
        except (TypeError, ValueError):
            matrix = np.empty(0)
        if matrix.shape != (4, 4) or not np.isfinite(matrix).all():
            raise Alarm(f"a part is placed by a 4×4 frame, got {shown(frame)}")
        turn, shift = matrix[:3, :3], matrix[:3, 3]
        if not np.allclose(turn @ turn.T, np.eye(3), rtol=0, atol=1e-9):
            raise Alarm("a part is placed by turning and shifting alone, not by scaling")
        distance: Distance = partial(_placed, self.distance, turn, shift)
        if isinstance(self.distance, Prisms):
            distance = self.distance.placed(matrix)
        with np.errstate(invalid="ignore"):  # 0 times infinity is left out
            ends = np.where(turn[:, None] == 0, 0.0, turn[:, None] * self.bounds)
        bounds = np.array([ends.min(axis=1).sum(axis=1), ends.max(axis=1).sum(axis=1)]) + shift
        return replace(self, distance=distance, bounds=bounds, name=f"{self.name} placed elsewhere", bound=None)

    def shifted(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Part:
        """The same part moved along the axes, mm."""
        check_point((x, y, z), "how far a part is shifted (mm)")
        return replace(self.placed(frames.shift(x, y, z)), name=f"{self.name} shifted")

    def turned(self, angle: float, about: ArrayLike = (0.0, 0.0)) -> Part:
        """The same part turned by `angle` degrees about the upright axis through (x, y), counter-clockwise from above."""
        check_number(angle, "the angle by which a part is turned (degrees)")
        check_point(about, "the point about which a part is turned (mm)", flat=True)
        x, y = np.asarray(about, dtype=float)
        return replace(self.placed(frames.turn(np.radians(angle), "z", (x, y, 0.0))), name=f"{self.name} turned")

    # What others work out of it.

    def with_errors(self, **errors: Any) -> Part:
        """The same part as it came out: `taper`, `bow`, `roughness`, `burr`; see `mnclab.workpiece.part.errors`."""
        from mnclab.workpiece.part.errors import with_errors

        return with_errors(self, **errors)

    def blocked(
        self, start: ArrayLike, end: ArrayLike, ball: float, stem: float = 0.0, length: float = 0.0,
        up: ArrayLike = (0.0, 0.0, 1.0),
    ) -> float | None:  # fmt: skip
        """How far a ball gets on its row before it, or the stem on it, meets the part, mm; None where the row is free."""
        from mnclab.workpiece.part.touching import blocked

        return blocked(self, start, end, ball, stem, length, up)

    def section(self, z: float, step: float | None = None, within: ArrayLike | None = None) -> list[Contour]:
        """What a level plane cuts, as closed contours; see `mnclab.workpiece.part.pictures`."""
        from mnclab.workpiece.part.pictures import section

        return section(self, z, step, within)

    def surface(self, step: float | None = None, within: ArrayLike | None = None) -> tuple[Floats, NDArray[np.int64]]:
        """Points (n, 3) and triangles (m, 3) of its surface; see `mnclab.workpiece.part.pictures`."""
        from mnclab.workpiece.part.pictures import surface

        return surface(self, step, within)


# Distances of points p (n, 3); functions of the file, so that a part can go from one process to another.


def _combined(*given: Any) -> Floats:
    """Of all steps from left to right, (operation, part) each, and then the points: a part of thousands nests no deeper."""
    *steps, p = given
    found = steps[0][1](p)
    for operation, other in steps[1:]:
        which, sign = WHICH[operation]
        near = _near(operation, other, found, p)
        if near.all():
            found = which(found, sign * other(p))
        elif near.any():
            found[near] = which(found[near], sign * other(p[near]))
    return np.asarray(found)


def _near(operation: str, other: Part, found: Floats, p: Floats) -> NDArray[np.bool_]:
    """For which points the other part can matter: its box tells of most that it stands too far off."""
    if operation == "&" or other.steep > 1:
        return np.ones(len(p), dtype=bool)
    off = np.linalg.norm(np.maximum(np.maximum(other.bounds[0] - p, p - other.bounds[1]), 0.0), axis=1)
    return np.asarray(off < found if operation == "|" else off <= np.maximum(-found, 0.0))


def _placed(distance: Distance, turn: Floats, shift: Floats, p: Floats) -> Floats:
    return distance((p - shift) @ turn)
