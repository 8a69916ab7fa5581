"""Steps at a hole or in a pocket carried out by a machine: each becomes a verb, under the name of its cycle and its own label.

The axis of the hole is where the tool stands in the plane XY, and the holes of every control lie along Z.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from mnclab.machining.steps import Along, Coolant, Go, Orient, Spin, Step, Thread, Turn, Wait
from mnclab.running.following import follow

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


def perform(m: Machine, name: str, steps: Iterable[Step], about: tuple[float, float] | None = None) -> None:
    """Carry the steps out; rows are labelled ``name`` and the label of the step.

    x and y count from ``about``, which is where the tool stands if nothing else is said.
    """
    x, y = m.programmed[:2] if about is None else about
    for step in steps:
        m.label = f"{name} {step.label}"
        match step:
            case Go():
                to = None if step.x is None else x + step.x, None if step.y is None else y + step.y, step.z
                m.line(*to, f=step.feed)
            case Along():
                with in_plane(m, "XY"):
                    follow(m, step.contour, step.feed, about=(x, y))
            case Wait():
                m.dwell(step.seconds)
            case Thread():
                with locked(m, step.pitch):
                    m.line(x=None if step.x is None else x + step.x, z=step.z)
            case Turn():
                with in_plane(m, "XY"):
                    m.turn((x + step.centre[0], y + step.centre[1]), step.angle, step.z, step.feed)
            case Spin():
                m.spindle(step.speed, step.turning)
            case Orient():
                m.orient(step.angle)
            case Coolant():
                m.coolant()


@contextmanager
def locked(m: Machine, pitch: float) -> Iterator[None]:
    """Inside, moves run at ``pitch`` mm for each revolution whatever the scale, spindle and feed locked.

    The history does not see it.
    """
    kept = m.feed, m.per_rev, m.synchronous
    m.feed, m.per_rev, m.synchronous, m._state = pitch, True, True, None
    try:
        yield
    finally:
        m.feed, m.per_rev, m.synchronous = kept
        m._state = None


@contextmanager
def in_plane(m: Machine, plane: str) -> Iterator[None]:
    """Inside, arcs lie in a plane, whatever the program has chosen."""
    kept = m.plane
    m.plane, m._state = plane, None
    try:
        yield
    finally:
        m.plane, m._state = kept, None
