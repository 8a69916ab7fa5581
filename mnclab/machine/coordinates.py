"""Coordinates of a machine: from those of the program through a chain of frames to those of the machine, and back.

Two points stand for the place of the tool: `programmed`, the register in program coordinates before any compensation, and
`tip`, the same point in machine coordinates. A change of frame says which of the two it keeps.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from mnclab.geometry import frames
from mnclab.geometry.frames import Matrix
from mnclab.machine.setup import Datum
from mnclab.machine.state import Place, State
from mnclab.text.alarm import Alarm
from mnclab.text.given import LARGEST

PLANES = {"XY": (0, 1, 2), "ZX": (2, 0, 1), "YZ": (1, 2, 0), "XZ": (0, 2, 1)}  # first axis, second axis, normal

NORMALS = {"XY": (0.0, 0.0, 1.0), "ZX": (0.0, 1.0, 0.0), "YZ": (1.0, 0.0, 0.0), "XZ": (0.0, -1.0, 0.0)}


def normal(matrix: Matrix, first: int, second: int) -> Place:
    """The unit normal of a plane behind a frame, on the side that it has without a mirror image."""
    across = np.cross(matrix[:3, first], matrix[:3, second]) * (1 if np.linalg.det(matrix[:3, :3]) > 0 else -1)
    x, y, z = (across / np.linalg.norm(across)).tolist()
    return x, y, z


class Placed(State):
    """A machine as far as it knows where it is."""

    def log(self, name: str, value: Any) -> None:
        """Note a new value of a name in the history; while a contour is recorded only what outlives it."""
        if self.recorded_only and name not in self.variables:
            return
        self.logs.add(name, self.step if self.step > 0 else 0, value)

    def set_frame(self, name: str, matrix: Matrix | None, keep: str = "tip") -> None:
        """Replace one frame of the chain; `keep` "tip" (the program reads the place anew) or "programmed"."""
        self.frames.set(name, matrix)
        self.compose()
        if keep == "tip":
            self.read_position()
        self.log("frame " + name, tuple(map(tuple, (self.frames[name]).tolist())))

    def select_datum(self, datum: Datum, frame: str = "datum") -> None:
        """Count from a work offset in its turned axes; the first one selected is the origin of the path."""
        if self.origin is None:
            self.origin = (datum.x, datum.y, datum.z)
        place = frames.shift(datum.x, datum.y, datum.z)
        for angle, axis in ((datum.rotation, "z"), (datum.tilt_y, "y"), (datum.tilt_x, "x")):
            place = place @ frames.turn(math.radians(angle), axis) if angle else place
        self.set_frame(frame, place)

    def to_machine(self, point: Iterable[float]) -> Place:
        x, y, z = point
        if self.shift is not None:
            dx, dy, dz = self.shift
            return x + dx, y + dy, z + dz
        u, v, w = frames.apply(self.matrix, (x, y, z)).tolist()
        return u, v, w

    def to_program(self, point: Iterable[float]) -> Place:
        x, y, z = point
        if self.shift is not None:
            dx, dy, dz = self.shift
            return x - dx, y - dy, z - dz
        u, v, w = frames.apply(frames.inverse(self.matrix), (x, y, z)).tolist()
        return u, v, w

    def read_position(self) -> None:
        """Take the register from where the tip stands."""
        self.set_register(self.to_program(self.tip))

    def set_register(self, point: Iterable[float]) -> None:
        """Give the programmed point exact values; the tip stays where it is."""
        x, y, z = map(float, point)
        for axis, value in zip("XYZ", (x, y, z)):
            if abs(value) >= LARGEST:  # nan: not known yet, where a contour is recorded
                message = f"{axis} of the tool must be smaller than {LARGEST:g} mm, and would be {value:.7g} in this frame"
                raise Alarm(message)
        self.programmed = (x, y, z)
        self.log("position", self.programmed)

    def target(self, x: float | None, y: float | None, z: float | None) -> Place:
        """The programmed point with some coordinates replaced."""
        px, py, pz = self.programmed
        return px if x is None else x, py if y is None else y, pz if z is None else z

    # --- the plane ---------------------------------------------------------------------------------------------------

    @property
    def scale(self) -> float:
        """How long 1 mm of the program in the plane is on the machine; 1 where that depends on the direction."""
        if self.shift is not None or not self.keeps_circles:
            return 1.0
        return math.hypot(*self.matrix[:3, PLANES[self.plane][0]].tolist())

    @property
    def keeps_circles(self) -> bool:
        """Whether circles of the plane stay circles on the machine."""
        first, second, _ = PLANES[self.plane]
        u, v = self.matrix[:3, first], self.matrix[:3, second]
        return bool(abs(np.linalg.norm(u) - np.linalg.norm(v)) <= 1e-9 and abs(u @ v) <= 1e-9)

    @property
    def orientation(self) -> int:
        """-1 when the frame mirrors the plane: arcs and the side of the tool turn over; else 1."""
        if self.shift is not None:
            return 1
        first, second, _ = PLANES[self.plane]
        across = np.cross(self.matrix[:3, first], self.matrix[:3, second])
        return 1 if np.dot(across, normal(self.matrix, first, second)) > 0 else -1
