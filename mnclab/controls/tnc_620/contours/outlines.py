"""A recorded contour as an area of its own; what is wrong with it is told where it stands, in its label or its program."""

from __future__ import annotations

from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from mnclab.geometry.contours import Contour
from mnclab.geometry.regions import CrossesItself, Region
from mnclab.machine.flow import Recording
from mnclab.machine.machine import Machine
from mnclab.path.plane import PlaneView, chain, outline
from mnclab.path.toolpath import Toolpath
from mnclab.text.alarm import Alarm

MOST_ELEMENTS = 16384  # of all contours of a cycle (8.1, 10.1)
NEAR = 1e-3  # mm from where a contour crosses itself, which is told to a thousandth


def fault(m: Machine, step: int, message: str, hint: str = "") -> NoReturn:
    """An alarm at the block of a step, in whatever program it stands."""
    raise Alarm(message, m.flow.span_of_step(step), hint=hint)


def doubt(m: Machine, step: int, message: str, hint: str = "") -> None:
    """A warning there."""
    span = m.flow.span_of_step(step)
    with m.within(**({} if span is None else {"program": span.program})):
        m.warn(message, span, hint)


def upright(path: Toolpath) -> NDArray[np.bool_]:
    """Which moves (n,) are arcs outside the plane XY, or lines where another plane is active."""
    return np.asarray(abs(path.axis[:, 2]) < 0.5)


def level(m: Machine, recording: Recording, what: str) -> None:
    """An Alarm where a contour moves along the tool axis."""
    path = recording.path
    message = f"the contour of {what} moves along the tool axis"
    if abs(recording.start[2]) > 1e-9:
        fault(m, recording.step, message)
    leaves = abs(path.end[:, 2]) > 1e-9
    if leaves.any():
        fault(m, int(path.step[np.argmax(leaves)]), message)


def enclosed(m: Machine, recording: Recording, what: str) -> tuple[Contour, Region]:
    """The contour, closed by a straight line where it is open, and what it encloses; an Alarm where it crosses itself."""
    path = recording.path
    if not len(path):
        fault(m, recording.step, f"{what} describes no contour")
    if (leaves := upright(path)).any():
        fault(m, int(path.step[np.argmax(leaves)]), f"the contour of {what} leaves the plane XY")
    path = path[PlaneView(path).moves]
    if not len(path):
        fault(m, recording.step, f"the contour of {what} encloses nothing: it is a point")
    contour = outline(path)
    if not contour.bulge.any() and np.linalg.matrix_rank(contour.points - contour.points[0], tol=1e-9) < 2:
        fault(m, recording.step, f"the contour of {what} encloses nothing")
    try:
        return contour, Region.of(contour)
    except CrossesItself as error:
        rows = chain(path).rows
        element = _last_at(contour, error.place, len(rows))
        fault(m, int(path.step[rows[element]]), f"the contour of {what}: {error}")
    except ValueError as error:
        fault(m, recording.step, f"the contour of {what}: {error}")


def _last_at(contour: Contour, place: tuple[float, float] | None, count: int) -> int:
    """The last of the first `count` elements that pass through a place."""
    if place is None:
        return 0
    x, y = place
    low = np.minimum(contour.starts, contour.ends) - contour.lengths[:, None] - NEAR
    high = np.maximum(contour.starts, contour.ends) + contour.lengths[:, None] + NEAR
    for k in np.flatnonzero(((low <= place) & (place <= high)).all(axis=1))[::-1].tolist():
        one = Contour([contour.starts[k], contour.ends[k]], [contour.bulge[k], 0.0], closed=False)
        if one.distance([(x, y)])[0] <= NEAR:
            return min(int(k), count - 1)
    return count - 1
