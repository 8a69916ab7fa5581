"""Reading a contour from a label or another program: its blocks are obeyed, but the tool does not move.

The same interpreter runs them on a machine whose frames, rows and modal state are set aside: corners are applied,
the radius is not compensated. Afterwards everything is as before, except variables that were written; alarms keep the
line they stand in. A transformation inside replaces or adds to that of the program as it would outside; the
contour is told in the coordinates of the program that calls, and the next part of the same contour goes on with it.
An approach and a departure are no part of the contour and are told apart from it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

from mnclab.geometry import frames
from mnclab.geometry.frames import Matrix
from mnclab.machine.coordinates import PLANES, in_mm
from mnclab.machine.flow import Flow, RecordedLead, Recording, determine
from mnclab.machine.state import PUT_BACK, Place
from mnclab.path import corners
from mnclab.path.leads import Lead
from mnclab.path.toolpath import Array, PathFault, Toolpath
from mnclab.text.alarm import Alarm, Span

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine


@contextmanager
def set_aside(m: Machine, in_space: bool = False) -> Iterator[None]:
    """Inside, blocks move nothing and what they change does not stay, but for variables.

    A contour has the height 0 where it names none; `in_space` it must begin with all three coordinates.
    """
    kept = m.snapshot(PUT_BACK)
    nan, across = float("nan"), PLANES[m.plane][2]
    x, y, z = (0.0 if axis == across and not in_space else nan for axis in range(3))
    path_so_far = {"recorder": m.recorder, "programmed_pieces": m.programmed_pieces, "settled": m.settled}
    m.put(recorder=m.recorder.another((x, y, z)), programmed_pieces=[], settled=[], recorded_only=True)
    m.put(tip=(x, y, z), programmed=(x, y, z), side=0, feed=m.feed or 1.0, exact_here=False)
    m.put(modal=m.modal | {"call": ""})  # a modal call of a cycle runs it where the tool moves
    try:
        yield
    finally:
        m.put(**path_so_far)
        m.restore(kept)


def record(
    m: Machine, flow: Flow, what: str, blocks: Callable[[], None], span: Span | None = None,
    after: Recording | None = None, within: Matrix | None = None, in_space: bool = False,
) -> Recording:  # fmt: skip
    """Obey `blocks` for the contour that they describe; an Alarm when it has none or does not begin with both coordinates.

    `what` names it in alarms, `span` is the place of what asks for it; `after` is the part before it in the same contour,
    whose transformations still act. The path is told in the coordinates inside of a frame, that of now if not `within`.
    `in_space`: the contour must begin with all three coordinates; else its height is 0 where it names none.
    """
    outer = m.matrix if within is None else within
    with flow.aside(m, in_space):
        if after is not None:
            m.put(frames=after.frames, memory=after.memory)
        try:
            with m.variables.own_level():
                blocks()
                determine(m)
            path = corners.apply(m.recorder.take())
        except PathFault as fault:
            raise Alarm(in_mm(fault.message, m.variable_unit), flow.span_of_step(fault.step), hint=fault.hint) from None
        chain, memory = m.frames, m.memory
    path = _within(_placed(path.motion, m.plane), outer)
    if not len(path):
        raise Alarm(f"{what} describes no contour", span)
    begun = int(path.step[0])
    turned = (path.rotary != np.asarray(m.rotary)).any(axis=1)
    if turned.any():
        message = f"the contour of {what} turns a rotary axis, which no contour does"
        raise Alarm(message, flow.span_of_step(int(path.step[np.argmax(turned)])))
    if np.isnan(path.end).any():
        which = "X, Y and Z" if in_space else "both coordinates of the plane"
        raise Alarm(f"the contour of {what} must begin with {which}", flow.span_of_step(begun))
    approach, departure = _leads(path, flow, what)
    first = 0 if approach is None else approach.row
    whole = path[first + 1 :] if departure is None else path[first + 1 : departure.row]
    side = int(path.side[min(first + 1, len(path) - 1)])
    if len(other := np.flatnonzero(path.side[first:] == -side)) and side:
        place = flow.span_of_step(int(path.step[max(first + other[0], first + 1)]))
        raise Alarm(f"the contour of {what} changes from RL to RR or back in this block", place)
    return Recording(whole, side, _place(path.end[first]), chain, memory, begun, approach, departure)


def _placed(path: Toolpath, plane: str) -> Toolpath:
    """The path from the first move on that names a coordinate of its plane."""
    u, v, _ = PLANES[plane]
    named = ~np.isnan(path.end[:, [u, v]]).all(axis=1)
    return path[int(np.argmax(named)) :] if named.any() else path[:0]


def _leads(path: Toolpath, flow: Flow, what: str) -> tuple[RecordedLead | None, RecordedLead | None]:
    """The approach of a path, with at most its starting point before it, and the departure, with nothing behind it."""
    approach = departure = None
    for row in np.flatnonzero(path.joint >= 0).tolist():
        lead = path.joints[path.joint[row]]
        if not isinstance(lead, Lead):
            continue
        if lead.departs:
            departure = RecordedLead(lead, row, _place(path.end[row]))
            if row + 1 < len(path):
                message = f"the contour of {what} ends with {lead.name}, this block stands behind it"
                raise Alarm(message, flow.span_of_step(int(path.step[row + 1])))
        elif row > 1 or approach:
            hint = "the block with its starting point may stand before it, nothing else"
            raise Alarm(f"{lead.name} must begin the contour of {what}", flow.span_of_step(lead.step), hint=hint)
        else:
            approach = RecordedLead(lead, row, _place(path.end[row - 1]) if row else None)
    return approach, departure


def _place(point: Array) -> Place:
    x, y, z = point.tolist()
    return x, y, z


def _within(path: Toolpath, outer: Matrix) -> Toolpath:
    """A path of the machine in the coordinates inside a frame (of equal scales)."""
    back = frames.inverse(outer)
    sense = 1 if np.linalg.det(outer[:3, :3]) > 0 else -1  # a mirror turns arcs and sides over
    places = {name: frames.apply(back, getattr(path, name)) for name in ("start", "end", "centre")}
    axis = frames.apply(back, path.axis) - back[:3, 3]
    axis /= np.linalg.norm(axis, axis=-1, keepdims=True)
    return path.replace(**places, axis=axis, sweep=path.sweep * sense, side=path.side * sense)
