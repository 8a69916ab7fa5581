"""Coordinates of a machine: from those of the program through a chain of frames to those of the machine, and back.

Two points stand for the place of the tool: `programmed`, the register in program coordinates before any compensation, and
`tip`, the same point in machine coordinates. A change of frame says which of the two it keeps.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry import frames
from mnclab.geometry.frames import IDENTITY, Matrix
from mnclab.machine.setup import Datum
from mnclab.machine.state import Place, State
from mnclab.machining.steps import Go, Step
from mnclab.path.cylinder import NONE, Cylinder
from mnclab.path.recorder import NAN
from mnclab.path.tool import Tool
from mnclab.path.toolpath import Kind
from mnclab.text.alarm import Alarm
from mnclab.text.given import LARGEST

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


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

    def select_datum(self, datum: Datum, frame: str = "datum", chosen: bool = False) -> None:
        """Count from a work offset in its turned axes; the first one is the origin of the path.

        One that is active at the start gives way to the first that a block has `chosen`, if nothing has moved before.
        """
        if self.origin is None or (chosen and not self.origin_chosen and not self.recorder.moved):
            self.origin = (datum.x, datum.y, datum.z)
        self.origin_chosen |= chosen
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


# A tool along X or Y: cycles run in a turned frame, where the tool axis is their Z and the working plane their XY.
# For controls whose working plane follows the tool axis: X stands on YZ, Y on ZX.

FRAME = "turned to the tool axis"
LOG = "tool axis"  # in the history: X, Y or Z


def tool_axis(m: Machine) -> int:
    """The axis of the program that the tool lies along: 0, 1 or 2."""
    return int(np.argmax(m.frames[FRAME][:3, 2])) if FRAME in m.frames else PLANES[m.plane][2]


def axes_of(m: Machine) -> str:
    """Which axes of the program the coordinates are just now: YZX inside a cycle with the tool axis X."""
    return "".join("XYZ"[k] for k in m.frames[FRAME][:3, :3].argmax(axis=0)) if FRAME in m.frames else "XYZ"


@contextmanager
def along_z(m: Machine) -> Iterator[None]:
    """Inside, coordinates are first axis and second axis of the plane, and the tool axis."""
    order = list(PLANES[m.plane])
    turned = np.eye(4)
    turned[:3, :3] = np.eye(3)[:, order]
    place = m.programmed
    m.set_frame(FRAME, turned, keep="programmed")
    m.set_register(place[k] for k in order)
    with m.within(plane="XY"):
        yield
    place = m.programmed
    m.set_frame(FRAME, None, keep="programmed")
    m.set_register(place[order.index(axis)] for axis in range(3))


# Rotary axes: their angles are told in the rows of a path; how they move stands in `machine.axes`.

AXES = "ABC"
Angles = tuple[float, float, float]
STILL = 1e-9  # mm or rad: what moves less does not


def angles(m: Machine) -> Angles:
    """Where A, B and C stand, degrees."""
    a, b, c = map(math.degrees, m.rotary)
    return a, b, c


def set_angles(m: Machine, to: Angles) -> None:
    """The next row arrives at these angles, degrees."""
    m.change("rotary", tuple(map(math.radians, to)))


def roll(m: Machine, cylinder: Cylinder, points: NDArray[np.float64], angles: NDArray[np.float64],
         ways: NDArray[np.float64], f: float | None) -> None:  # fmt: skip
    """Go through tips (n, 3) of the program with the axis of a cylinder of the program at angles (n,), rad.

    A row takes the time of its way (n,) mm along the developed surface at `f` mm/min; where the tip stands its feed is that of
    the axis, rad/min. Places where nothing moves are passed over.
    """
    rate, before = m.feed_of(f), list(m.rotary)
    kind, axis = (Kind.LINE if math.isfinite(rate) else Kind.RAPID), cylinder.rotary
    index = m.recorder.cylinder(cylinder.behind(m.matrix))
    size = math.hypot(*m.matrix[:3, 0].tolist())
    for point, angle, way in zip(points.tolist(), angles.tolist(), ways.tolist(), strict=True):
        tip, turn = m.to_machine(point), abs(angle - m.rotary[axis])
        if (length := math.dist(tip, m.tip)) < STILL:
            if turn < STILL:
                continue
            tip = m.tip
        m.put(cylinder=index, from_angle=m.rotary[axis])
        to = list(m.rotary)
        to[axis] = angle
        m.put(rotary=tuple(to))
        if kind == Kind.RAPID:
            m.add_row(kind, tip, feed=rate)
        else:
            seconds = 60 * way * size / rate
            m.add_row(kind, tip, feed=60 * (turn if tip is m.tip else length) / seconds, time=seconds)
        m.programmed, m.tip = (point[0], point[1], point[2]), tip
    m.put(cylinder=NONE, from_angle=NAN)
    if m.rotary != tuple(before):
        m.log("rotary", m.rotary)


# What keeps its true size under a frame: the tool, a thread, a boring bar, the direction of an oriented spindle.
# The lengths of a cycle are those of the program, so a scale makes them longer or shorter on the machine; what is not scaled
# is told in lengths of the program instead. A cycle for which that cannot be is refused before it moves.

#: What a cycle does (`Cycle.does`), as far as its frame must care.
VISITS, MILLS, TAPS, MILLS_THREADS, SHIFTS = "visits points", "mills", "taps", "mills threads", "shifts a boring bar"
NOTHING, CALLS = "moves nothing", "runs a program"
SAME = 1e-9


def faults(does: str, m: Machine) -> Iterator[str]:
    """Why a cycle that does this cannot run under the frame of the machine: the end of a sentence."""
    if m.shift is not None or does == NOTHING:
        return
    if is_upside_down(m):
        yield "cannot run under a mirror image of Z: it would work from below the table"
        return
    if does not in (MILLS, TAPS, MILLS_THREADS, SHIFTS):
        return
    if does == MILLS:
        if not is_round(m):
            yield "cannot run under unequal scales of the plane"
        return
    x, y, z = np.linalg.norm(m.matrix[:3, :3], axis=0).tolist()
    kept = "bar keeps its size" if does == SHIFTS else "thread keeps its pitch"
    if abs(z - 1) > SAME:
        yield f"cannot run under a scale of Z other than 1, got {z:g}: a {kept}"
    elif does != TAPS and max(abs(x - 1), abs(y - 1)) > SAME:
        yield f"cannot run under a scale other than 1, got {x:g} and {y:g} in the plane: a {kept}"


def is_round(m: Machine) -> bool:
    """Whether circles of the plane XY stay circles on the machine."""
    u, v = m.matrix[:3, 0], m.matrix[:3, 1]
    return bool(abs(np.linalg.norm(u) - np.linalg.norm(v)) <= SAME and abs(u @ v) <= SAME)


def is_upside_down(m: Machine) -> bool:
    """Whether one of the frames mirrors the tool axis; a tilt turns it."""
    linear, k = (frame[:3, :3] for _, frame in m.frames), tool_axis(m)
    return any(part[k, k] < 0 and not (part - np.diag(part.diagonal())).any() for part in linear)


def plane_scale(m: Machine) -> float:
    """How long 1 mm of the program in the plane XY is on the machine; 1 where that depends on the direction."""
    return math.hypot(*m.matrix[:3, 0].tolist()) if is_round(m) else 1.0


def depth_scale(m: Machine) -> float:
    """How long 1 mm of the program along Z is on the machine."""
    return math.hypot(*m.matrix[:3, 2].tolist())


def tool(m: Machine) -> Tool:
    """The tool in lengths of the program: where Z has another scale than the plane, its angles are others there, too."""
    if m.shift is not None:
        return m.tool
    plane, depth = plane_scale(m), depth_scale(m)
    own, steeper = m.tool, plane / depth
    return replace(
        own, radius=own.radius / plane, dr=own.dr / plane, corner=own.corner / plane,
        cutting_length=own.cutting_length / depth, plunge_angle=_angle(own.plunge_angle, steeper),
        angle=2 * _angle(own.angle / 2, 1 / steeper),
    )  # fmt: skip


def _angle(degrees: float, factor: float) -> float:
    """The angle (0 to 90 degrees) whose tangent is so many times as great; no angle (0) and a right one stay."""
    return math.degrees(math.atan(math.tan(math.radians(degrees)) * factor)) if 0 < degrees < 90 else degrees


def remark(m: Machine) -> str:
    """What to add to a sentence that names sizes of the tool: in which lengths they count."""
    if abs((scale := plane_scale(m)) - 1) < SAME:
        return ""
    size = 2 * m.tool.effective_radius
    return (
        f", in lengths of the program: under the scale {scale:g} the tool diameter {size:g} counts as {size / scale:g}"
    )


def with_the_spindle(m: Machine, steps: Iterable[Step], frame: Matrix = IDENTITY) -> Iterator[Step]:
    """Steps off the axis of a hole as far as they are long, in the direction of the oriented spindle.

    `frame` is the part of the frame that the direction follows; none of it: it is one of the machine.
    """
    whole = m.matrix[:3, :3]
    for step in steps:
        if isinstance(step, Go) and step.x is not None and step.y is not None and (step.x or step.y):
            way = np.linalg.solve(whole, frame[:3, :2] @ (step.x, step.y))[:2]
            way /= np.abs(way).max()  # whose square is no number where it is very short
            x, y = (way * (math.hypot(step.x, step.y) / np.linalg.norm(whole[:, :2] @ way))).tolist()
            step = step._replace(x=x, y=y)
        yield step


# Sentences about lengths in a program in inches: a cycle, a pass and a probe know theirs in mm, and say so.

KNOWN = re.compile(r"(?<![\d.])[\d.]++ mm\b|\b(?:lines?|rows?|passes|turns|teeth|strokes|T|tool) \d+")  # mm, or no lengths
LOOSE = re.compile(r"(?<![\w.])-?\d++(?:\.\d++)?+(?![\w.]*[A-Za-z])(?! *(?:degrees|°|%))")  # a number that is no part of a name
PLACES = re.compile(r"\b[XYZR]-?\d")
LENGTHS = re.compile(
    r"radi(us|i)\b|diameter|\bwid|\blong|length|deep|depth|thick|narrow|\broom\b|pitch|distance|\bway\b|apart|height|\blevel\b"
    r"|clearance|reach|infeed|stepover|allowance|\bball\b|\bside\b|beside|\bwall|\boff by\b|\bdeviation|\bstock of\b|DEPTH"
)


def in_mm(sentence: str, unit: float, length: bool = False, said: str = "") -> str:
    """A sentence whose lengths are in mm names that where a length of 1 of the program is another number of mm.

    `length`: its numbers are known to be lengths; else it must speak of one. `said`: what follows in the brackets.
    """
    if unit == 1:
        return sentence
    told = KNOWN.sub("", sentence)
    of_length = length or LENGTHS.search(told)
    return f"{sentence} (lengths in mm{said})" if PLACES.search(told) or (of_length and LOOSE.search(told)) else sentence
