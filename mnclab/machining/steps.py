"""What a cycle does, step by step: plain data, made by strategies and cycles, carried out by a machine.

A cycle yields its steps and changes nothing itself. A Touch and a Record have an answer, which `yield` returns:
`contact = yield Touch(…)`. The steps from `Each` on concern the machine and the program, no tool.

z is a coordinate along the tool axis, x and y count from the axis of the hole or the middle of the pocket; mm, mm/min,
rev/min, s, angles of turns in rad. None keeps a coordinate. A feed of inf is rapid, a feed of None the feed that is
active. `label` says what is happening, for listings and pictures.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from mnclab.geometry.contours import Contour
from mnclab.geometry.curves import Floats
from mnclab.path.cylinder import Cylinder
from mnclab.path.toolpath import Kind, Toolpath

RAPID = math.inf


class Go(NamedTuple):
    """A straight move."""

    label: str
    z: float | None = None
    feed: float | None = RAPID
    x: float | None = None
    y: float | None = None


class Turn(NamedTuple):
    """Round a centre by an angle, counter-clockwise where it is positive, by as many turns as it has; a helix with z."""

    label: str
    angle: float
    z: float | None = None
    feed: float | None = None
    centre: tuple[float, float] = (0.0, 0.0)


class Dip(NamedTuple):
    """A quarter circle of the plane ZX to x and z: it begins along Z where the tool stands, and ends along X."""

    label: str
    x: float
    z: float
    feed: float | None = None


class Along(NamedTuple):
    """Along a contour of the plane from its start, where the tool stands; level, or at the `heights` of its points.

    The contour's own coordinates count from `at`.
    """

    label: str
    contour: Contour
    feed: float | None = None
    heights: Sequence[float] | None = None
    at: tuple[float, float] = (0.0, 0.0)


class Thread(NamedTuple):
    """A straight move by `pitch` (mm of its way, positive) for each revolution of the spindle."""

    label: str
    z: float | None
    pitch: float
    x: float | None = None


class Wait(NamedTuple):
    """A dwell; none for zero seconds."""

    label: str
    seconds: float


class Spin(NamedTuple):
    """The spindle turns +1 clockwise (M3), -1 counter-clockwise (M4) or 0 not; without a speed it keeps the one it has."""

    label: str
    turning: int
    speed: float | None = None


class Orient(NamedTuple):
    """The spindle stops at an angle, degrees."""

    label: str
    angle: float


class Pause(NamedTuple):
    """The program stops, until the operator starts it again."""

    label: str


class Coolant(NamedTuple):
    """The coolant is switched."""

    label: str
    on: bool


class Touch(NamedTuple):
    """Towards a point until the ball of the probe touches the part; the answer is the contact.

    Coordinates are those of the south pole of the ball; `ball` is its radius, that of the tool if there is none.
    `miss="return"` makes no contact an answer and not an alarm.
    """

    label: str
    x: float
    y: float
    z: float
    feed: float
    ball: float | None = None
    miss: str = "alarm"


class Swivel(NamedTuple):
    """The rotary axes turn to the angles A, B and C, degrees, at degrees a minute, alone; the tip stands where it is led, and
    without the kinematics of a machine. The point that is `below` the tip, mm, stays where it is on the part, if one is named.
    """

    label: str
    angles: tuple[float, float, float]
    feed: float | None
    below: float | None = None


class Rolled(NamedTuple):
    """Moves over a cylinder, which its rotary axis turns: straight from each of the places to the next.

    `points` (n, 3) are tips as the machine has them, in coordinates of the program; `angles` (n,) rad are those
    of the axis there; `ways` (n,) mm are the lengths along the developed surface, which the feed counts along.
    """

    label: str
    cylinder: Cylinder
    points: Floats
    angles: Floats
    ways: Floats
    feed: float | None = RAPID


class Each(NamedTuple):
    """What `visit(x, y)` yields, at each of the points (n, 2); visits that are alike are made as columns."""

    points: Floats
    visit: Callable[[float, float], Iterable[Any]]
    label: str = ""


class Call(NamedTuple):
    """The cycle that the program defined last, here; `instead` are values by name in place of its own."""

    instead: Mapping[str, float]
    label: str = ""


class Blocks(NamedTuple):
    """Blocks of a program, which `run` obeys here."""

    run: Callable[[], None]
    label: str = ""


class Record(NamedTuple):
    """Read the contour of a label, nothing moves; the answer is the recording.

    The label stands in a `program` (its index), whose variables hold lengths of `unit` mm; `after` is the recording that it
    goes on from. `in_space`: it must begin with all three coordinates.
    """

    name: str
    program: int
    unit: float
    after: Any = None
    in_space: bool = False
    label: str = ""


class Measure(NamedTuple):
    """A line of the measuring record: mm, or degrees as the `unit` says; nan where there is no nominal value or no limit.

    Without a `verdict` ("ok", "rework", "scrap", "out") the limits give it. `touches` are the numbers of the contacts.
    """

    what: str
    actual: float
    nominal: float = math.nan
    lower: float = math.nan
    upper: float = math.nan
    unit: str = "mm"
    verdict: str = ""
    touches: tuple[int, ...] = ()
    label: str = ""


class Sketch(NamedTuple):
    """A figure as it should be and as it was found, contours of the plane at a height: for pictures of the measuring."""

    nominal: Contour
    actual: Contour
    height: float
    touches: tuple[int, ...] = ()
    label: str = ""


class Say(NamedTuple):
    """A warning at a word, or at the block."""

    text: str
    hint: str = ""
    word: Any = None
    label: str = ""


class Write(NamedTuple):
    """A value that stays: an attribute of the machine that rows carry ("side"), or with a `key` one of these.

    A "variable", a "measured" value, a row of "tools", "datums" or "presets", the "probe" table, the "tool" in the spindle as it
    is from now on, a whole "file" by its name (None: it is deleted) or what is "appended" to it, the "kinematics" from now on,
    the angles with which coordinates are "reckoned", a "frame", the new name of a frame ("renamed"), the "datum" as a frame, or
    as a "chosen datum", a "modal" group, "memory" of the control, what is "kept" for the next call of the cycle, a value that
    only the "history" keeps.
    """

    what: str
    value: Any
    key: Any = None
    label: str = ""


Step = (
    Go | Turn | Dip | Along | Thread | Wait | Spin | Orient | Pause | Coolant | Touch | Swivel | Rolled | Each | Call | Blocks
    | Record | Measure | Sketch | Say | Write
)


def moved(steps: Iterable[Step], x: float, y: float) -> Iterator[Step]:
    """The same straight moves, arcs and contours elsewhere in the plane, and all else as it is."""
    for step in steps:
        match step:
            case Go():
                yield step._replace(x=None if step.x is None else x + step.x, y=None if step.y is None else y + step.y)
            case Turn():
                yield step._replace(centre=(x + step.centre[0], y + step.centre[1]))
            case Dip():
                yield step._replace(x=x + step.x)
            case Along():
                yield step._replace(at=(x + step.at[0], y + step.at[1]))
            case _:
                yield step


# Steps as a tool path, without a machine: what strategies are compared by, and a path without a program.
# A contour gives as many rows as it has elements; a move that leads nowhere gives none, nor does a step that moves no axis.

SAME = 1e-9  # mm


def traced(steps: Iterable[Step], start: Sequence[float], radius: float) -> Toolpath:
    """The path of a tool of a `radius` from a place (x, y, z) on; rows are labelled as their steps."""
    ends, centres, sweeps, axes = [np.array(start, dtype=float)[None]], [], [], []
    feeds: list[Floats] = []
    marks: list[np.ndarray] = []
    labels = {"": 0}
    for step in steps:
        if not isinstance(step, Go | Along | Turn | Dip):
            continue
        here = ends[-1][-1]
        axis = np.array([0.0, 1.0, 0.0] if isinstance(step, Dip) else [0.0, 0.0, 1.0])
        if isinstance(step, Dip):
            to, sweep, middle = _dip(step, here)
        else:
            to, sweep, middle = _along(step, here) if isinstance(step, Along) else _straight_or_round(step, here)
        if not len(to):
            continue
        heights = np.vstack([here, to[:-1]])[:, 2:]
        centres.append(np.where(sweep[:, None] != 0, np.hstack([middle, heights]), np.nan))
        axes.append(np.broadcast_to(axis, to.shape))
        ends.append(to)
        sweeps.append(sweep)
        feeds.append(np.full(len(to), np.nan if step.feed is None else step.feed))
        marks.append(np.full(len(to), labels.setdefault(step.label, len(labels)), np.int16))
    sweep, feed = np.concatenate(sweeps), np.concatenate(feeds)
    straight = np.where(np.isinf(feed), np.uint8(Kind.RAPID), np.uint8(Kind.LINE))
    columns: dict[str, Any] = {
        "kind": np.where(sweep != 0, np.uint8(Kind.ARC), straight),
        "centre": np.vstack(centres),
        "axis": np.vstack(axes),
        "sweep": sweep,
        "feed": feed,
        "label": np.concatenate(marks),
        "radius": np.broadcast_to(radius, (len(sweep),)),
    }
    return Toolpath.chain(np.vstack(ends), columns, labels=tuple(labels))


def _straight_or_round(step: Go | Turn, here: Floats) -> tuple[Floats, Floats, Floats]:
    """Ends `(n, 3)`, sweeps `(n,)` and centres `(n, 2)` of the one row that the step makes, or of none."""
    goal, sweep, middle = here.copy(), 0.0, np.full(2, np.nan)
    if isinstance(step, Turn):
        middle, sweep = np.array(step.centre), step.angle
        (c, s), (x, y) = (math.cos(sweep), math.sin(sweep)), here[:2] - middle
        goal[:2] = middle + (c * x - s * y, s * x + c * y)
    else:
        goal[:2] = [old if new is None else new for old, new in zip(here[:2], (step.x, step.y), strict=True)]
    goal[2] = here[2] if step.z is None else step.z
    some = slice(bool(sweep) or bool(np.abs(goal - here).max() > SAME))
    return goal[None][some], np.array([sweep])[some], middle[None][some]


def _dip(step: Dip, here: Floats) -> tuple[Floats, Floats, Floats]:
    """The same of the quarter circle in ZX, whose centre lies beside its start and above its end."""
    sense = 1.0 if (here[0] - step.x) * (here[2] - step.z) > 0 else -1.0
    return np.array([[step.x, here[1], step.z]]), np.array([sense * math.pi / 2]), np.array([[step.x, here[1]]])


def _along(step: Along, here: Floats) -> tuple[Floats, Floats, Floats]:
    """The same of the elements of a contour that lead anywhere."""
    contour = step.contour
    levels = np.full(len(contour.points), here[2]) if step.heights is None else np.asarray(step.heights, dtype=float)
    levels = np.roll(levels, -1)[: len(contour.starts)]
    some = (contour.lengths > SAME) | (np.abs(np.diff(np.append(here[2], levels))) > SAME)
    ends = np.column_stack([contour.ends + step.at, levels])
    return ends[some], contour.sweeps[some], contour.centres[some] + step.at
