"""Reading a contour from a label or another program: its blocks are obeyed, but the tool does not move.

The same interpreter runs them on a machine whose frames, rows and modal state are set aside: corners are applied,
the radius is not compensated. Afterwards everything is as before, except variables that were written; alarms keep the
line they stand in. A transformation inside replaces or adds to that of the program as it would outside; the
contour is told in the coordinates of the program that calls, and the next part of the same contour goes on with it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

from mnclab.geometry import frames
from mnclab.geometry.frames import Matrix
from mnclab.machine.coordinates import PLANES
from mnclab.machine.flow import Flow, Recording
from mnclab.machine.state import PUT_BACK
from mnclab.machine.waiting import determine
from mnclab.path import corners
from mnclab.path.fault import PathFault
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import Alarm, Span

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


@contextmanager
def set_aside(m: Machine) -> Iterator[None]:
    """Inside, blocks move nothing and what they change does not stay, but for variables."""
    kept = m.snapshot(PUT_BACK)
    nan, across = float("nan"), PLANES[m.plane][2]
    x, y, z = (0.0 if axis == across else nan for axis in range(3))
    path_so_far = {"recorder": m.recorder, "programmed_pieces": m.programmed_pieces, "settled": m.settled}
    m.put(recorder=m.recorder.another((x, y, z)), programmed_pieces=[], settled=[], recorded_only=True)
    m.put(tip=(x, y, z), programmed=(x, y, z), side=0, feed=m.feed or 1.0, exact_here=False)
    try:
        yield
    finally:
        m.put(**path_so_far)
        m.restore(kept)


def record(
    m: Machine, flow: Flow, what: str, blocks: Callable[[], None], span: Span | None = None,
    after: Recording | None = None, within: Matrix | None = None,
) -> Recording:  # fmt: skip
    """Obey `blocks` for the contour that they describe; an Alarm when it has none or does not begin with both coordinates.

    `what` names it in alarms, `span` is the place of what asks for it; `after` is the part before it in the same contour,
    whose transformations still act. The path is told in the coordinates inside of a frame, that of now if not `within`.
    """
    outer = m.matrix if within is None else within
    with flow.aside(m):
        if after is not None:
            m.put(frames=after.frames, memory=after.memory)
        try:
            with m.variables.own_level():
                blocks()
                determine(m)
            path = corners.apply(m.recorder.take())
        except PathFault as fault:
            raise Alarm(fault.message, flow.span_of_step(fault.step), hint=fault.hint) from None
        chain, memory = m.frames, m.memory
    path = _within(path.motion, outer)
    if not len(path):
        raise Alarm(f"{what} describes no contour", span)
    first = path[0].end.tolist()
    begun = int(path.step[0])
    if np.isnan(path.end).any():
        message = f"the contour of {what} must begin with both coordinates of the plane"
        raise Alarm(message, flow.span_of_step(begun))
    side = int(path.side[1] if len(path) > 1 else path.side[0])
    return Recording(path[1:], side, (first[0], first[1], first[2]), chain, memory, begun)


def _within(path: Toolpath, outer: Matrix) -> Toolpath:
    """A path of the machine in the coordinates inside a frame (of equal scales)."""
    back = frames.inverse(outer)
    sense = 1 if np.linalg.det(outer[:3, :3]) > 0 else -1  # a mirror turns arcs and sides over
    places = {name: frames.apply(back, getattr(path, name)) for name in ("start", "end", "centre")}
    axis = frames.apply(back, path.axis) - back[:3, 3]
    axis /= np.linalg.norm(axis, axis=-1, keepdims=True)
    return path.replace(**places, axis=axis, sweep=path.sweep * sense, side=path.side * sense)
