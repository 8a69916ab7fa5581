"""A tool along X or Y: cycles run in a turned frame, where the tool axis is their Z and the working plane their XY.

For controls whose working plane follows the tool axis: X stands on YZ, Y on ZX.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np

from mnclab.machine.coordinates import PLANES

if TYPE_CHECKING:
    from mnclab.machine.machine import Machine

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
