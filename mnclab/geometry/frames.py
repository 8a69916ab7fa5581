"""4x4 frames: shift, turn, mirror, scale; and chains of named ones.

A frame maps local coordinates to outer ones: `outer = M @ (x, y, z, 1)`. Lengths in mm, angles in radians.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import reduce
from itertools import takewhile

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mnclab.text.tables import fixed

Matrix = NDArray[np.float64]
IDENTITY = np.eye(4)
IDENTITY.flags.writeable = False


def shift(x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Matrix:
    """A translation by (x, y, z) mm."""
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def turn(angle: float, axis: str = "z", about: ArrayLike = (0.0, 0.0, 0.0)) -> Matrix:
    """A right-handed rotation by `angle` rad about an axis through `about`."""
    first, second = {"z": (0, 1), "x": (1, 2), "y": (2, 0)}[axis]
    c, s = np.cos(angle), np.sin(angle)
    matrix = np.eye(4)
    matrix[first, first] = matrix[second, second] = c
    matrix[first, second], matrix[second, first] = -s, s
    return around(matrix, about)


def scale(x: float = 1.0, y: float = 1.0, z: float = 1.0, about: ArrayLike = (0.0, 0.0, 0.0)) -> Matrix:
    """Factors along the axes, about a point; -1 is a mirror."""
    return around(np.diag([x, y, z, 1.0]), about)


def mirror(axes: str, about: ArrayLike = (0.0, 0.0, 0.0)) -> Matrix:
    """Coordinates of the named axes change their sign, about a point."""
    x, y, z = (-1.0 if axis in axes.lower() else 1.0 for axis in "xyz")
    return scale(x, y, z, about)


def around(matrix: Matrix, point: ArrayLike) -> Matrix:
    """The same map with `point` as its fixed point instead of the origin."""
    centre = np.asarray(point, dtype=np.float64)
    moved = matrix.copy()
    moved[:3, 3] += centre - matrix[:3, :3] @ centre
    return moved


def apply(matrix: Matrix, points: ArrayLike) -> NDArray[np.float64]:
    """Points (..., 3) in outer coordinates.

    Summed term by term and not as a matrix product, whose last digit depends on how many points there are: one point
    and a million give the same figures. A coordinate that is nan spoils only those that depend on it.
    """
    xyz = np.moveaxis(np.asarray(points, dtype=np.float64), -1, 0)
    rows = matrix[:3].tolist()
    return np.stack([sum(f * p for f, p in zip(row, xyz, strict=False) if f) + row[3] for row in rows], -1)


def inverse(matrix: Matrix) -> Matrix:
    """The map back from outer to local coordinates."""
    back = np.eye(4)
    back[:3, :3] = np.linalg.inv(matrix[:3, :3])
    back[:3, 3] = -back[:3, :3] @ matrix[:3, 3]
    return back


def is_shift(matrix: Matrix) -> bool:
    """Whether a frame only moves, so that directions and radii stay as they are."""
    return bool(np.array_equal(matrix[:3, :3], IDENTITY[:3, :3]))


class FrameChain:
    """Named frames in the order in which they act, the outermost first.

    A control that fixes the order names its slots once; one that keeps the order of definition appends. Setting a slot
    that exists replaces it in its place; setting it to None removes it (a named slot becomes neutral).
    """

    def __init__(self, slots: tuple[str, ...] = ()) -> None:
        self.slots = slots
        self._frames: dict[str, Matrix] = {name: IDENTITY for name in slots}

    def __getitem__(self, name: str) -> Matrix:
        return self._frames.get(name, IDENTITY)

    def __contains__(self, name: str) -> bool:
        return name in self._frames and self._frames[name] is not IDENTITY

    def __iter__(self) -> Iterator[tuple[str, Matrix]]:
        return iter(self._frames.items())

    def __repr__(self) -> str:
        return f"<FrameChain: {', '.join(name for name in self._frames if name in self) or 'no frame is active'}>"

    def set(self, name: str, matrix: Matrix | None) -> None:
        """Put a frame in its slot; None takes it away."""
        if matrix is not None:
            self._frames[name] = fixed(matrix)
        elif name in self.slots:
            self._frames[name] = IDENTITY
        else:
            self._frames.pop(name, None)

    def innermost(self, name: str) -> None:
        """Move a frame to the end of the chain, so that it acts on a point before the others."""
        self._frames[name] = self._frames.pop(name, IDENTITY)

    def rename(self, old: str, new: str) -> None:
        """Give a frame another name in its place; nothing where there is none of the old name."""
        self._frames = {new if name == old else name: frame for name, frame in self._frames.items()}

    @property
    def matrix(self) -> Matrix:
        """The product of all frames: local to outermost coordinates."""
        return reduce(np.matmul, self._frames.values(), IDENTITY)

    def before(self, name: str) -> Matrix:
        """The product of the frames outside `name`."""
        outside = takewhile(lambda item: item[0] != name, self)
        return reduce(np.matmul, (frame for _, frame in outside), IDENTITY)

    def copy(self) -> FrameChain:
        twin = FrameChain(self.slots)
        twin._frames = dict(self._frames)
        return twin


# Tilted planes: the turn that says where the axes of the tilted system lie, its columns; angles in rad.

SINGULAR = 1e-9  # directions so near to each other make no plane


def spatial(a: float, b: float, c: float) -> Matrix:
    """The turn about the fixed axes X, then Y, then Z: its columns are the axes of the tilted system."""
    return turn(c, "z") @ turn(b, "y") @ turn(a, "x")


def euler(precession: float, nutation: float, rotation: float) -> Matrix:
    """The turn about Z, then about X and Z as they lie after it."""
    return turn(precession, "z") @ turn(nutation, "x") @ turn(rotation, "z")


def projected(about_y: float, about_x: float, rotation: float) -> Matrix:
    """The plane whose traces in ZX and YZ lie X and Y turned about Y and about X; X lies along the first, turned in the plane."""
    along = (math.cos(about_y), 0.0, -math.sin(about_y))
    across = (0.0, math.cos(about_x), math.sin(about_x))
    return along_and_normal(along, np.cross(along, across)) @ turn(rotation, "z")


def along_and_normal(along: ArrayLike, normal: ArrayLike) -> Matrix:
    """Z along a normal (3,), X along what of another vector (3,) lies square to it; both must have a length, and span a plane."""
    z = np.asarray(normal, dtype=np.float64) / np.linalg.norm(normal)
    x = np.asarray(along, dtype=np.float64) / np.linalg.norm(along)
    x = x - (x @ z) * z
    x = x / np.linalg.norm(x)
    x = x - (x @ z) * z  # what a short one kept of z
    x = x / np.linalg.norm(x)
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([x, np.cross(z, x), z], axis=1)
    return matrix


def spans(one: ArrayLike, other: ArrayLike) -> bool:
    """Whether two vectors (3,) have a length, and not the same direction."""
    a, b = (np.asarray(each, dtype=np.float64) for each in (one, other))
    lengths = float(np.linalg.norm(a) * np.linalg.norm(b))
    return bool(lengths > 0 and np.linalg.norm(np.cross(a, b)) > SINGULAR * lengths)


def angles_of(axes: ArrayLike) -> tuple[float, float, float]:
    """The turns a, b, c about the fixed axes X, Y, Z that `spatial` makes axes (3, 3) of: b within a quarter turn, and a 0 where
    it is one."""
    (xx, xy, _), (yx, yy, _), (zx, zy, zz) = np.asarray(axes, dtype=np.float64)[:3, :3].tolist()
    level = math.hypot(xx, yx)
    if level < SINGULAR:
        return 0.0, math.atan2(-zx, level), math.atan2(-xy, yy)
    return math.atan2(zy, zz), math.atan2(-zx, level), math.atan2(yx, xx)
