"""Reading a contour from a label: its blocks are obeyed, but the tool does not move.

The same interpreter runs the label on a machine whose frames, rows and modal state are set aside: the frame is the
identity, corners are applied, the radius is not compensated. Afterwards everything is as before, except variables that the
label wrote; alarms keep the line they stand in.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from mnclab.geometry import frames
from mnclab.geometry.frames import FrameChain
from mnclab.path import corners
from mnclab.path.fault import PathFault
from mnclab.path.recorder import Recorder
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import Alarm, Span

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

#: What a recorded label may change for good.
_OUTLIVES = ("alarms", "variables", "measured", "tables", "step", "logs", "flow", "memory")
_NOWHERE = (float("nan"), float("nan"), 0.0)


class Recording(NamedTuple):
    """A contour as its label describes it: ``path`` in program coordinates from ``start`` on, and its side (+1 left,
    -1 right, 0 none)."""

    path: Toolpath
    side: int
    start: tuple[float, float, float]


def record(m: Machine, label: str, span: Span | None = None) -> Recording:
    """Obey a label for its contour; an Alarm when it has none or does not begin with both coordinates."""
    kept = dict(vars(m))
    m.frames, m._matrix, m._shift = FrameChain(m.control.frames), frames.IDENTITY, (0.0, 0.0, 0.0)
    m.recorder, m.programmed_pieces, m.settled = Recorder(_NOWHERE), [], []
    m.modal, m._state, m.recorded_only = dict(m.modal), None, True
    m.tip = m.programmed = _NOWHERE
    m.side, m.feed, m.exact_here = 0, m.feed or 1.0, False
    try:
        m.flow.call(label, span)
        path = corners.apply(m.recorder.take())
    except PathFault as fault:
        raise Alarm(fault.message, m.flow.span_of_step(fault.step), hint=fault.hint) from None
    finally:
        for name, value in kept.items():
            if name not in _OUTLIVES:
                setattr(m, name, value)
    path = path.motion
    if not len(path):
        raise Alarm(f"label {label} describes no contour", span)
    if np.isnan(path.end).any():
        raise Alarm(f"the contour of label {label} must begin with both coordinates of the plane", span)
    first = path[0].end.tolist()
    return Recording(path[1:], int(path.side[1] if len(path) > 1 else path.side[0]), (first[0], first[1], first[2]))
