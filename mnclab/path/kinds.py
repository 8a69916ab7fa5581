"""The kinds of rows in a toolpath."""

from __future__ import annotations

from enum import IntEnum


class Kind(IntEnum):
    """What a row of a toolpath is. Motion rows are RAPID, LINE, ARC and PROBE; the others are events."""

    RAPID = 0
    LINE = 1
    ARC = 2
    PROBE = 3
    DWELL = 4
    TOOL = 5
    SPINDLE = 6
    COOLANT = 7
    STOP = 8


MOTION_KINDS = (Kind.RAPID, Kind.LINE, Kind.ARC, Kind.PROBE)
