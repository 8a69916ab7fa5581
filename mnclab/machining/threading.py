"""Threads cut with a single-point tool: how far it goes in a turn of the spindle. Lengths in mm."""

from __future__ import annotations

import math


def lead_along(across: float, along: float, pitch: float) -> float:
    """The way of the tool in one turn when the axis with the longer way advances ``pitch``.

    >>> lead_along(0, -43, 1.5)
    1.5
    >>> lead_along(3, 4, 2)
    2.5
    """
    return pitch * math.hypot(across, along) / max(abs(across), abs(along))
